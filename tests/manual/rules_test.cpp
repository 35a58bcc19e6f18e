// The rules in cbc-rules(7) are those of the table that 'cbc lint --explain' reads. After a change
// of the table this writes them anew:
//
//   CBC_UPDATE_GOLDEN=1 build/release/tests/cbc_manual_tests
#include "diagnostic/rules.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "manual/page.h"

namespace cbc::manual {
namespace {

const std::string page_name = "cbc-rules.7";
constexpr std::string_view first_line =
    R"(.\" From here on written by a test from the table of rules, see tests/manual/rules_test.cpp.)";
constexpr std::string_view last_line = R"(.\" The end of what the test writes.)";

/// groff prints these characters as other ones, that no program understands.
std::string escape(std::string_view text) {
  std::string escaped;
  for (const char character : text) {
    switch (character) {
      case '-':
        escaped += "\\-";
        break;
      case '\\':
        escaped += "\\e";
        break;
      case '\'':
        escaped += "\\(aq";
        break;
      case '`':
        escaped += "\\(ga";
        break;
      case '^':
        escaped += "\\(ha";
        break;
      case '~':
        escaped += "\\(ti";
        break;
      default:
        escaped += character;
    }
  }
  // A period would begin a request.
  return escaped.starts_with('.') ? "\\&" + escaped : escaped;
}

std::string_view take_until(std::string_view separator, std::string_view& rest) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  const std::string_view taken = rest.substr(0, end);
  rest.remove_prefix(std::min(end + separator.size(), rest.size()));
  return taken;
}

/// A paragraph, each sentence of it on lines of its own.
std::string prose(std::string_view paragraph) {
  constexpr std::size_t columns = 80;
  std::string text;
  std::string line;
  while (!paragraph.empty()) {
    const std::string_view word = take_until(" ", paragraph);
    if (!line.empty() && line.size() + 1 + escape(word).size() > columns) {
      text += line + '\n';
      line.clear();
    }
    // What begins no line needs no protection of its period.
    line += line.empty() ? escape(word) : ' ' + escape("x" + std::string(word)).substr(1);
    if (word.ends_with('.')) {
      text += line + '\n';
      line.clear();
    }
  }
  return line.empty() ? text : text + line + '\n';
}

std::string literal(std::string_view lines) {
  std::string text = ".Bd -literal -offset indent\n";
  while (!lines.empty()) text += escape(take_until("\n", lines)) + '\n';
  return text + ".Ed\n";
}

std::string describe_severity(const Rule& rule) {
  const std::string name(name_of(rule.severity));
  const std::string article = rule.severity == Severity::error ? "An " : "A ";
  return article + name + (rule.is_fixed ? ", which settings cannot change" : "") +
         (rule.is_of_scripts ? "; in event scripts.\n" : ".\n");
}

std::string section_of(const Rule& rule) {
  std::string text = ".Ss " + escape(rule.name) + '\n';
  text += describe_severity(rule) + prose(rule.summary);
  for (std::string_view rest = rule.explanation; !rest.empty();) {
    text += ".Pp\n" + prose(take_until("\n\n", rest));
  }
  text += ".Pp\n.Sy Example .\n" + literal(rule.example);
  text += ".Pp\n.Sy To mend it .\n" + prose(rule.mending) + literal(rule.mended);
  return text;
}

std::string all_sections() {
  std::string text;
  for (const Rule& rule : all_rules()) text += section_of(rule);
  return text + ".Ss The catalog of the examples that are event scripts\n" +
         literal(example_catalog());
}

TEST(ManualTest, HasTheRulesOfTheTable) {
  const std::string page = read_page(page_name);
  const std::string_view written = between(page, first_line, last_line);
  const std::string expected = all_sections();
  const char* const update = std::getenv("CBC_UPDATE_GOLDEN");
  if (update != nullptr && std::string_view(update) == "1" && written.data() != nullptr) {
    std::string updated = page;
    updated.replace(static_cast<std::size_t>(written.data() - page.data()), written.size(),
                    expected);
    write_page(page_name, updated);
  } else {
    EXPECT_EQ(written, expected);
  }
}

}  // namespace
}  // namespace cbc::manual
