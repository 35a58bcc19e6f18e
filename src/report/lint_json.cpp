#include "report/lint_json.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "text/json_text.h"

namespace cbc {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Note& note) {
  return {{"file", note.file},
          {"line", note.range.begin.line},
          {"column", note.range.begin.column},
          {"message", note.message}};
}

Json to_json(const Diagnostic& finding) {
  Json related = Json::array();
  for (const Note& note : finding.notes) related.push_back(to_json(note));
  return {{"rule", finding.rule},
          {"severity", name_of(finding.severity)},
          {"message", finding.message},
          {"line", finding.range.begin.line},
          {"column", finding.range.begin.column},
          {"end_line", finding.range.end.line},
          {"end_column", finding.range.end.column},
          {"related", std::move(related)}};
}

Json to_json(const Summary& summary) {
  Json groups = Json::array();
  for (const Summary::Group& group : summary.groups) {
    groups.push_back({{"tasks", group.tasks}, {"constraints", group.constraints}});
  }
  return {{"tasks", summary.tasks},
          {"behaviors", summary.behaviors},
          {"constraints",
           {{"exclusive_pairs", summary.constraints.exclusive_pairs},
            {"requirements", summary.constraints.requirements},
            {"task_minimums", summary.constraints.task_minimums},
            {"total", summary.constraints.total()}}},
          {"groups", std::move(groups)},
          {"search_space", summary.search_space}};
}

std::string file_to_text(const LintedFile& file) {
  std::string text = "{\"file\":" + to_text(file.file) + ",\"diagnostics\":[";
  for (const Diagnostic& finding : file.findings) append_item(text, to_text(to_json(finding)));
  return text + "],\"summary\":" + (file.summary ? to_text(to_json(*file.summary)) : "null") + "}";
}

}  // namespace

std::string lint_json(const std::vector<LintedFile>& files) {
  std::string text = R"({"schema":"cbc.lint/1","files":[)";
  for (const LintedFile& file : files) append_item(text, file_to_text(file));
  text += "],\n\"errors\":" + std::to_string(count(files, Severity::error));
  text += ",\"warnings\":" + std::to_string(count(files, Severity::warning));
  text += ",\"notes\":" + std::to_string(count(files, Severity::note));
  return text + "}\n";
}

}  // namespace cbc
