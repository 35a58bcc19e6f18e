#include <algorithm>

#include "core/diagnostic/rules.h"
#include "lsp/features/features.h"
#include "lsp/protocol/uri.h"

namespace cbc::lsp {

Json to_json(const Place& place) { return {{"line", place.line}, {"character", place.character}}; }

Json to_json(const PlaceRange& range) {
  return {{"start", to_json(range.begin)}, {"end", to_json(range.end)}};
}

Json range_json(const Text& text, std::size_t begin, std::size_t end) {
  return to_json(PlaceRange{text.place_of(begin), text.place_of(end)});
}

Json location_json(const File& file, std::size_t begin, std::size_t end) {
  return {{"uri", file.uri}, {"range", range_json(*file.text, begin, end)}};
}

Json edits_json(const File& file, std::string_view changed) {
  Json edits = Json::array();
  for (const TextChange& change : changes_between(file.text->content(), changed)) {
    edits.push_back(
        {{"range", range_json(*file.text, change.begin, change.end)}, {"newText", change.text}});
  }
  return edits;
}

namespace {

int severity_number(Severity severity) {
  switch (severity) {
    case Severity::error:
      return 1;
    case Severity::warning:
      return 2;
    case Severity::note:
      break;
  }
  return 3;
}

/// A place in a file that the server may not have read.
Json note_location(const Workspace& workspace, const Note& note) {
  const File* const file = workspace.find(note.file);
  if (file != nullptr && file->text != nullptr) {
    return {{"uri", file->uri}, {"range", to_json(file->text->range_of(note.range))}};
  }
  return {{"uri", uri_of_path(note.file)}, {"range", to_json(PlaceRange{})}};
}

}  // namespace

Json diagnostics_json(const Workspace& workspace, const File& file) {
  Json diagnostics = Json::array();
  for (const Diagnostic& finding : file.findings) {
    Json diagnostic = {{"range", to_json(file.text->range_of(finding.range))},
                       {"severity", severity_number(finding.severity)},
                       {"code", finding.rule},
                       {"source", "cbc"},
                       {"message", finding.message}};
    for (const Note& note : finding.notes) {
      diagnostic["relatedInformation"].push_back(
          {{"location", note_location(workspace, note)}, {"message", note.message}});
    }
    diagnostics.push_back(std::move(diagnostic));
  }
  return diagnostics;
}

}  // namespace cbc::lsp
