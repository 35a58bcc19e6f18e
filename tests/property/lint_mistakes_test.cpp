// Single mistakes, made wherever catalogs of the project have room for them: lint must find each
// where it was made, and no other error.
#include <cstddef>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"
#include "support/lines.h"
#include "support/read_file.h"

namespace cbc::lint_mistakes_test {
namespace {

using Lines = std::vector<std::string>;
using Keys = std::set<std::string_view>;

/// A key with a scalar behind it. Lines count from 0, columns from 0 and in bytes.
struct Place {
  std::size_t line = 0;
  std::size_t column = 0;
  std::size_t value_column = 0;
  std::string key;
  std::string value;
  std::string parent;          ///< the key that the mapping or its list belongs to
  bool is_of_section = false;  ///< that key is one of the catalog itself
  bool begins_entry = false;   ///< there is a dash before it
  bool has_next = false;       ///< the next line is the next key of the mapping
  bool follows_value = false;  ///< the line before is a key of the mapping with a scalar
};

/// The key of a line, in block style: its column, or nothing.
std::optional<std::size_t> column_of_key(std::string_view line) {
  const std::size_t column = line.find_first_not_of(" -");
  if (column == std::string_view::npos) return std::nullopt;
  const std::size_t end = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", column);
  if (end == column || end == std::string_view::npos || line[end] != ':') return std::nullopt;
  return column;
}

std::vector<Place> places_in(const Lines& lines) {
  struct Open {
    std::size_t column;
    std::string key;
  };
  std::vector<Place> places;
  std::vector<Open> open;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto column = column_of_key(lines[i]);
    if (!column) continue;
    Place place;
    place.line = i;
    place.column = *column;
    const std::size_t colon = lines[i].find(':', *column);
    place.key = lines[i].substr(*column, colon - *column);
    while (!open.empty() && open.back().column >= *column) open.pop_back();
    if (!open.empty()) place.parent = open.back().key;
    place.is_of_section = open.size() == 1;
    open.push_back({*column, place.key});
    place.begins_entry = lines[i].find('-') < *column;
    place.has_next = i + 1 < lines.size() && column_of_key(lines[i + 1]) == column &&
                     lines[i + 1].find('-') > *column;
    place.follows_value = !place.begins_entry && !places.empty() && places.back().line + 1 == i &&
                          places.back().column == *column;
    place.value_column = lines[i].find_first_not_of(' ', colon + 1);
    if (place.value_column == std::string::npos) continue;
    place.value = lines[i].substr(place.value_column, lines[i].find(" #") - place.value_column);
    place.value.erase(place.value.find_last_not_of(' ') + 1);
    if (std::string_view("[{#").find(place.value.front()) == std::string_view::npos) {
      places.push_back(place);
    }
  }
  return places;
}

/// What lint has to say, at a line from 0 and a column from 0.
struct Expected {
  std::string_view rule;
  std::size_t line;
  std::optional<std::size_t> column;
  std::string says = {};  ///< part of the message
};

/// Makes the mistake at a place; nothing if there is no room for it.
using Mistake = std::optional<Expected> (*)(Lines& lines, const Place& place);

std::optional<Expected> at_value(Lines& lines, const Place& place, std::string_view now,
                                 std::string_view rule, std::string says = {}) {
  lines[place.line].replace(place.value_column, place.value.size(), now);
  return Expected{rule, place.line, place.value_column, std::move(says)};
}

std::string with_last_letter_twice(const std::string& word) { return word + word.back(); }

const Keys names{"task", "behavior", "parameter"};
const Keys flags{"start_on_request", "reactive_start"};
const Keys percentages{"suitability", "minimum_performance"};

std::optional<Expected> no_colon(Lines& lines, const Place& place) {
  if (!place.has_next && !place.follows_value) return std::nullopt;
  lines[place.line].erase(place.column + place.key.size(), 1);
  return Expected{"yaml-syntax", place.line, place.column, "':' missing"};
}

std::optional<Expected> open_quote(Lines& lines, const Place& place) {
  for (std::size_t i = place.line; i < lines.size(); ++i) {
    if (lines[i].find('"') != std::string::npos) return std::nullopt;
  }
  return at_value(lines, place, '"' + place.value, "yaml-syntax");
}

std::optional<Expected> tab_indents(Lines& lines, const Place& place) {
  if (place.begins_entry || place.column < 2) return std::nullopt;
  lines[place.line].replace(0, place.column, "\t");
  return Expected{"yaml-syntax", place.line, 0, "tab"};
}

std::optional<Expected> indented_too_far(Lines& lines, const Place& place) {
  if (!place.follows_value) return std::nullopt;
  lines[place.line].insert(0, " ");
  return Expected{"yaml-syntax", place.line, std::nullopt};
}

std::optional<Expected> key_twice(Lines& lines, const Place& place) {
  if (place.begins_entry) return std::nullopt;  // it would begin another entry
  const auto next = lines.begin() + static_cast<std::ptrdiff_t>(place.line) + 1;
  lines.insert(next, std::string(place.column, ' ') + place.key + ": " + place.value);
  return Expected{"duplicate-key", place.line + 1, place.column, "'" + place.key + "'"};
}

std::optional<Expected> strange_key(Lines& lines, const Place& place) {
  const auto next = lines.begin() + static_cast<std::ptrdiff_t>(place.line) + 1;
  lines.insert(next, std::string(place.column, ' ') + "quaternion: 7");
  return Expected{"unknown-key", place.line + 1, place.column, "'quaternion'"};
}

std::optional<Expected> key_misspelt(Lines& lines, const Place& place) {
  lines[place.line].replace(place.column, place.key.size(), with_last_letter_twice(place.key));
  const bool is_required = names.contains(place.key);
  return Expected{is_required ? "missing-key" : "unknown-key", place.line, place.column,
                  "did you mean '" + place.key + "'?"};
}

std::optional<Expected> no_value(Lines& lines, const Place& place) {
  if (!names.contains(place.key)) return std::nullopt;
  lines[place.line].replace(place.value_column, place.value.size(), "~");
  return Expected{"missing-key", place.line, place.column, "'" + place.key + "' has no value"};
}

std::optional<Expected> wrong_type(Lines& lines, const Place& place) {
  if (names.contains(place.key)) {
    return at_value(lines, place, "[" + place.value + "]", "wrong-type");
  }
  if (flags.contains(place.key)) return at_value(lines, place, "maybe", "wrong-type", "true or");
  if (percentages.contains(place.key)) return at_value(lines, place, "80 %", "wrong-type");
  if (place.key == "timeout") return at_value(lines, place, "15s", "wrong-type");
  return std::nullopt;
}

std::optional<Expected> out_of_range(Lines& lines, const Place& place) {
  if (percentages.contains(place.key)) {
    return at_value(lines, place, "100.5", "invalid-value", "0 to 100");
  }
  if (place.key == "timeout") return at_value(lines, place, "0", "invalid-value");
  if (place.key == "execution_goal") {
    return at_value(lines, place, "keep_runing", "invalid-value", "mean 'keep_running'?");
  }
  return std::nullopt;
}

std::optional<Expected> required_task_misspelt(Lines& lines, const Place& place) {
  if (place.parent != "requires" || place.key != "task") return std::nullopt;
  return at_value(lines, place, with_last_letter_twice(place.value), "undefined-task",
                  "did you mean '" + place.value + "'?");
}

std::optional<Expected> behavior_twice(Lines& lines, const Place& place) {
  if (place.key != "behavior") return std::nullopt;
  const std::string& line = lines[place.line];
  const std::string name = line.substr(0, place.value_column + place.value.size());
  const auto next = lines.begin() + static_cast<std::ptrdiff_t>(place.line);
  const std::string other = std::string(place.column, ' ') + "task: SOME_TASK";
  lines.insert(next, {name, other});
  return Expected{"duplicate-behavior", place.line + 2, place.value_column,
                  "'" + place.value + "'"};
}

/// An entry of a list with a copy of its name before it.
std::optional<Expected> entry_twice(Lines& lines, const Place& place) {
  std::string_view rule;
  if (place.parent == "parameters") rule = "duplicate-parameter";
  if (place.parent == "requires" && !place.has_next) rule = "redundant-requirement";
  if (place.parent == "tasks" && place.is_of_section) rule = "duplicate-task";
  if (rule.empty() || !place.begins_entry) return std::nullopt;
  const std::string copy = lines[place.line];
  lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(place.line), copy);
  return Expected{rule, place.line + 1, place.value_column, "'" + place.value + "'"};
}

std::optional<Expected> fraction(Lines& lines, const Place& place) {
  if (!percentages.contains(place.key)) return std::nullopt;
  const bool is_suitability = place.key == "suitability";
  return at_value(lines, place, "0.8",
                  is_suitability ? "suspicious-suitability" : "suspicious-minimum", "80 %");
}

std::optional<Expected> older_name(Lines& lines, const Place& place) {
  if (place.key != "suitability") return std::nullopt;
  lines[place.line].replace(place.column, place.key.size(), "efficacy");
  return Expected{"deprecated-key", place.line, place.column, "write 'suitability"};
}

struct Kind {
  const char* name;
  Mistake make;
};

constexpr Kind kinds[] = {
    {"no colon", no_colon},
    {"open quote", open_quote},
    {"tab indents", tab_indents},
    {"indented too far", indented_too_far},
    {"key twice", key_twice},
    {"strange key", strange_key},
    {"key misspelt", key_misspelt},
    {"no value", no_value},
    {"wrong type", wrong_type},
    {"out of range", out_of_range},
    {"required task misspelt", required_task_misspelt},
    {"behavior twice", behavior_twice},
    {"entry twice", entry_twice},
    {"fraction", fraction},
    {"older name", older_name},
};

/// `line_break`: Windows has its own.
std::vector<Diagnostic> lint(const Lines& lines, std::string_view line_break) {
  std::string text;
  for (const std::string& line : lines) text.append(line).append(line_break);
  Diagnostics diagnostics;
  if (const auto document = yaml::parse(text, "catalog.yaml", diagnostics)) {
    static_cast<void>(lint_catalog(*document, {}, diagnostics));
  }
  return diagnostics.release();
}

bool fits(const Diagnostic& finding, const Expected& expected) {
  const Position& begin = finding.range.begin;
  return finding.rule == expected.rule && begin.line == expected.line + 1 &&
         (!expected.column || begin.column == *expected.column + 1) &&
         finding.message.find(expected.says) != std::string::npos;
}

/// What is wrong with the findings; empty if nothing is.
std::string find_fault(const std::vector<Diagnostic>& findings, const Expected& expected) {
  bool is_found = false;
  std::ostringstream wrong;
  for (const Diagnostic& finding : findings) {
    const bool is_it = fits(finding, expected);
    is_found = is_found || is_it;
    if (is_it || finding.severity != Severity::error) continue;
    wrong << finding.range.begin.line << ":" << finding.range.begin.column << " " << finding.rule
          << ": " << finding.message << "\n";
  }
  if (!is_found) {
    wrong << "not found: " << expected.line + 1 << ": " << expected.rule << ": " << expected.says
          << "\n";
  }
  return wrong.str();
}

TEST(LintMistakes, AreFoundWhereTheyWereMade) {
  for (const Kind& kind : kinds) {
    std::size_t made = 0;
    for (const std::string name : {"quadrotor", "mobile-manipulator", "inspection"}) {
      const Lines good =
          test::lines_of(test::read_file(CBC_SOURCE_DIR "/catalogs/" + name + ".yaml"));
      for (const Place& place : places_in(good)) {
        Lines bad = good;
        const auto expected = kind.make(bad, place);
        if (!expected) continue;
        ++made;
        EXPECT_EQ(find_fault(lint(bad, made % 5 == 0 ? "\r\n" : "\n"), *expected), "")
            << kind.name << " in " << name << ", line " << place.line + 1;
      }
    }
    EXPECT_GE(made, 5U) << kind.name;
  }
}

}  // namespace
}  // namespace cbc::lint_mistakes_test
