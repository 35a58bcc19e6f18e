#include <cstddef>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "core/yaml/source.h"
#include "support/rounds.h"

namespace cbc::yaml::source_lines_test {
namespace {

/// A line for each line: its depth, whether it has content, and its comment.
std::string show_lines(std::string_view text) {
  Diagnostics errors;
  const std::unique_ptr<const Document> document = parse(text, "a.yaml", errors);
  EXPECT_NE(document, nullptr) << text;
  std::string result;
  for (const SourceLine& line : split_lines(text, document.get())) {
    result += line.depth ? std::to_string(*line.depth) : "-";
    if (line.has_content) result += " content";
    if (line.comment)
      result += " " + std::string(text.substr(*line.comment, line.end - *line.comment));
    result += "\n";
  }
  return result;
}

TEST(SourceLines, TellContentCommentsAndDepth) {
  EXPECT_EQ(show_lines(""), "");
  EXPECT_EQ(show_lines("\n\r\n"), "-\n-\n");
  EXPECT_EQ(show_lines("# one\na: # two\r\n  - b\n  -\n   -c: 'd #'   # three #\n\n   # four"),
            "- # one\n0 content # two\n5 content\n5 content\n6 content # three #\n-\n- # four\n");
  EXPECT_EQ(show_lines("--- # begins\na: |\n  # b\nc: 'd\n  e' # f\n...\n"),
            "- content # begins\n0 content\n- content\n0 content\n- content # f\n0 content\n");
}

// All that a document says, and not where.
void add_values(const Node& node, std::string& values) {
  values += std::to_string(static_cast<int>(node.kind)) + "<" + node.text;
  for (const Node* item : node.items) add_values(*item, values);
  for (const auto& [key, value] : node.entries) {
    add_values(*key, values);
    add_values(*value, values);
  }
  values += ">";
}

/// Empty if the text is no YAML.
std::string values_of(std::string_view text) {
  Diagnostics errors;
  const std::unique_ptr<const Document> document = parse(text, "a.yaml", errors);
  std::string values;
  if (document != nullptr) add_values(document->root(), values);
  return values;
}

std::string random_text(std::mt19937& random) {
  constexpr std::string_view pieces[] = {
      "a: ", "b: ",    "- ",   "'",    "\"",   "| ",   "|2",       ">-",     "# ",      "#",
      " #",  " # ",    "\n",   "\n",   "\n  ", "\n ",  "\n    # ", "\n  # ", "\n# ",    "[",
      "]",   ", ",     "x",    "it's", "é",    "\\",   "''",       "{",      "}",       "&x ",
      "*x",  "!!str ", "\r\n", "\t",   "\n\n", "--- ", "  ",       "' # '",  "\" # \"", "y"};
  std::string text;
  for (std::size_t count = random() % 24; count > 0; --count) {
    text += pieces[random() % std::size(pieces)];
  }
  return text;
}

// The parser is the judge: what is written into a comment changes no value.
TEST(SourceLines, CommentsAreWhatTheParserPassesOver) {
  std::mt19937 random(20'240'501);
  std::size_t in_comments = 0;
  std::size_t in_values = 0;
  for (int round = 0; round < test::rounds(60'000); ++round) {
    const std::string text = random_text(random);
    Diagnostics errors;
    const std::unique_ptr<const Document> document = parse(text, "a.yaml", errors);
    if (document == nullptr) continue;
    const std::string values = values_of(text);
    for (const SourceLine& line : split_lines(text, document.get())) {
      for (std::size_t at = line.begin; at < line.end; ++at) {
        const bool may_begin = at == line.begin || text[at - 1] == ' ' || text[at - 1] == '\t';
        if (text[at] != '#' || !may_begin) continue;
        std::string changed = text;
        changed.insert(at + 1, "q");
        const bool is_comment = values_of(changed) == values;
        ASSERT_EQ(line.comment && *line.comment <= at, is_comment) << at << " in\n" << text;
        ++(is_comment ? in_comments : in_values);
      }
    }
  }
  EXPECT_GT(in_comments, test::rounds(1000U));
  EXPECT_GT(in_values, test::rounds(1000U));
}

}  // namespace
}  // namespace cbc::yaml::source_lines_test
