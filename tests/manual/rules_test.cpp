// cbc-rules(7) has the rules that 'cbc lint --explain' has. After a change of the rules this writes
// it anew:
//
//   CBC_UPDATE_GOLDEN=1 build/release/tests/cbc_manual_tests
#include "core/diagnostic/rules.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "manual/page.h"
#include "support/read_file.h"

namespace cbc::manual::rules_test {
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
         (rule.is_off ? ", which is off unless settings ask for it" : "") +
         (rule.is_of_scripts ? "; in event scripts.\n" : ".\n");
}

std::string section_of(const Rule& rule) {
  std::string text = ".Ss " + escape(rule.name) + '\n';
  text += describe_severity(rule) + prose(rule.summary);
  for (std::string_view rest = rule.explanation; !rest.empty();) {
    text += ".Pp\n" + prose(take_until("\n\n", rest));
  }
  if (!rule.settings.empty()) text += ".Pp\n.Sy The settings .\n" + literal(rule.settings);
  text += ".Pp\n.Sy Example .\n" + literal(rule.example);
  text += ".Pp\n.Sy How to fix it .\n" + prose(rule.mending) + literal(rule.mended);
  return text;
}

std::string all_sections() {
  std::string text;
  for (const Rule& rule : all_rules()) text += section_of(rule);
  return text + ".Ss The catalog of the examples that are event scripts\n" +
         literal(example_catalog());
}

/// What stands between two lines of a text is as expected, or is replaced by it. Whether it was
/// replaced.
bool check_or_update(std::string& text, std::string_view first, std::string_view last,
                     const std::string& expected) {
  const std::string_view written = between(text, first, last);
  const char* const update = std::getenv("CBC_UPDATE_GOLDEN");
  if (update == nullptr || std::string_view(update) != "1" || written.data() == nullptr) {
    EXPECT_EQ(written, expected);
    return false;
  }
  text.replace(static_cast<std::size_t>(written.data() - text.data()), written.size(), expected);
  return true;
}

TEST(ManualTest, HasTheRules) {
  std::string page = read_page(page_name);
  if (check_or_update(page, first_line, last_line, all_sections())) write_page(page_name, page);
}

}  // namespace
}  // namespace cbc::manual::rules_test
