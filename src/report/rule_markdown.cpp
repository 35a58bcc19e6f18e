#include "report/rule_markdown.h"

#include <fmt/format.h>

namespace cbc {
namespace {

std::string code(std::string_view text) { return fmt::format("```yaml\n{}```\n", text); }

}  // namespace

std::string rule_markdown(const Rule& rule) {
  std::string text =
      fmt::format("{}\n\n## Example\n\n{}\n## How to mend it\n\n{}\n\n{}", rule.explanation,
                  code(rule.example), rule.mending, code(rule.mended));
  if (rule.is_of_scripts) {
    text += fmt::format("\n## The catalog of these scripts\n\n{}", code(example_catalog()));
  }
  return text;
}

}  // namespace cbc
