#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "lsp/features/features.h"
#include "lsp/language/completion.h"
#include "lsp/language/context.h"
#include "lsp/language/hover.h"

namespace cbc::lsp {
namespace {

// CompletionItemKind of the protocol.
int kind_number(Completion::Kind kind) {
  switch (kind) {
    case Completion::Kind::key:
      return 10;
    case Completion::Kind::task:
      return 7;
    case Completion::Kind::behavior:
      return 3;
    case Completion::Kind::variable:
      return 6;
    case Completion::Kind::value:
      return 12;
    case Completion::Kind::snippet:
      break;
  }
  return 15;
}

}  // namespace

Json list_completions(const Cursor& cursor, const Client& client) {
  const std::string& text = cursor.file.text->content();
  const Context context = context_at(text, cursor.offset);
  const std::size_t begin = std::min(context.begin, cursor.offset);
  const std::size_t end = std::max(context.end, cursor.offset);
  Json items = Json::array();
  const std::string_view replaced = std::string_view(text).substr(begin, end - begin);
  // The protocol wants one line.
  if (replaced.find('\n') != std::string_view::npos)
    return {{"isIncomplete", false}, {"items", items}};
  const bool is_quoted = replaced.starts_with('"') || replaced.starts_with('\'');
  for (const Completion& found :
       complete(context, cursor.file.kind, cursor.workspace.known_catalog(cursor.file))) {
    if (found.is_snippet && !client.has_snippets) continue;
    Json item = {
        {"label", found.label},
        {"kind", kind_number(found.kind)},
        {"insertTextFormat", found.is_snippet ? 2 : 1},
        {"textEdit",
         {{"range", range_json(*cursor.file.text, begin, end)}, {"newText", found.insert}}}};
    if (is_quoted) item["filterText"] = std::string(replaced.substr(0, 1)) + found.label;
    if (!found.detail.empty()) item["detail"] = found.detail;
    if (!found.documentation.empty()) item["documentation"] = found.documentation;
    items.push_back(std::move(item));
  }
  return {{"isIncomplete", false}, {"items", std::move(items)}};
}

Json find_hover(const Cursor& cursor) {
  const Text& text = *cursor.file.text;
  const Context context = context_at(text.content(), cursor.offset);
  std::string said =
      describe(context, cursor.file.kind, cursor.workspace.known_catalog(cursor.file));
  for (const Diagnostic& finding : cursor.file.findings) {
    if (!cursor.file.is_parsed) break;  // they are about an older text
    const bool is_here = text.offset_of(finding.range.begin) <= cursor.offset &&
                         cursor.offset <= text.offset_of(finding.range.end);
    if (!is_here) continue;
    if (!said.empty()) said += "\n\n---\n\n";
    said += describe_rule(finding.rule);
  }
  if (said.empty()) return nullptr;
  Json hover = {{"contents", {{"kind", "markdown"}, {"value", said}}}};
  if (context.begin < context.end) hover["range"] = range_json(text, context.begin, context.end);
  return hover;
}

}  // namespace cbc::lsp
