#include "report/rule_text.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

namespace cbc {
namespace {

constexpr std::size_t line_width = 80;

/// Cuts off what is before the first `separator`, and the separator; all if there is none.
std::string_view take_until(std::string_view separator, std::string_view& rest) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view taken = rest.substr(0, end);
  rest.remove_prefix(std::min(end + separator.size(), rest.size()));
  return taken;
}

/// A paragraph in lines of at most 80 line_width, if no word is longer. The texts are ASCII.
std::string wrap(std::string_view paragraph) {
  std::string text;
  std::size_t used = 0;
  while (!paragraph.empty()) {
    const std::string_view word = take_until(" ", paragraph);
    if (used > 0 && used + 1 + word.size() > line_width) {
      text += '\n';
      used = 0;
    }
    if (used > 0) {
      text += ' ';
      ++used;
    }
    text += word;
    used += word.size();
  }
  return text + '\n';
}

std::string indent(std::string_view lines) {
  std::string text;
  while (!lines.empty()) text += fmt::format("    {}\n", take_until("\n", lines));
  return text;
}

std::string example_text(std::string_view heading, std::string_view example, const Style& style) {
  return fmt::format("\n{}{}:{}\n\n{}", style.strong, heading, style.reset, indent(example));
}

}  // namespace

std::string rule_text(const Rule& rule, const Style& style) {
  std::string text =
      fmt::format("{}{}{} ({}{})\n\n", style.strong, rule.name, style.reset, name_of(rule.severity),
                  rule.is_fixed ? "; settings cannot change it" : "");
  text += wrap(rule.summary);
  for (std::string_view rest = rule.explanation; !rest.empty();) {
    text += '\n' + wrap(take_until("\n\n", rest));
  }
  text += example_text(rule.is_of_scripts ? "Example, a script for the catalog below" : "Example",
                       rule.example, style);
  text += fmt::format("\n{}To mend it:{}\n\n{}", style.strong, style.reset, wrap(rule.mending));
  text += example_text("Mended", rule.mended, style);
  if (rule.is_of_scripts) text += example_text("The catalog", example_catalog(), style);
  return text;
}

std::string rule_list(const Style& style) {
  std::size_t width = 0;
  for (const Rule& rule : all_rules()) width = std::max(width, rule.name.size());
  std::string text;
  for (const Severity severity : {Severity::error, Severity::warning, Severity::note}) {
    for (const Rule& rule : all_rules()) {
      if (rule.severity != severity) continue;
      text += fmt::format("{}{:<{}}{}  {:<7}  {}\n", style.strong, rule.name, width, style.reset,
                          name_of(severity), rule.summary);
    }
  }
  return text;
}

}  // namespace cbc
