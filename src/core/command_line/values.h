#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "cbc/units.h"

// The values that options and arguments take: what --help calls them, which are right, and what
// completion offers. A command has a function of this kind for values of its own.
namespace cbc::cli {

/// What completion offers for a value.
enum class ValueKind : std::uint8_t {
  text,               ///< its choices or names, if it has any
  catalog,            ///< a file with a catalog, or a folder of them
  script,             ///< a file with a script
  catalog_or_script,  ///< either, or a folder of scripts
  file,               ///< any file
  task,               ///< the name of a task of the catalog on the line
  task_or_behavior,   ///< the name of either
};

struct NameWithHelp {
  std::string name;
  std::string help;  ///< on one line; may be empty
};

/// The values that an option or an argument accepts.
struct Values {
  std::string placeholder = {};  ///< in --help: "FILE"
  std::string expected = {};     ///< "a file", for complaints
  /// Says what is wrong with a value, empty if nothing is. Null: all are right.
  std::function<std::string(const std::string& value)> check = {};
  /// Names that completion offers; may be null.
  std::function<std::vector<NameWithHelp>()> names = {};
  ValueKind kind = ValueKind::text;
  bool is_input = false;         ///< names a file to read, "-" being standard input
  bool is_output = false;        ///< names a file to write, "-" being standard output
  std::string replaced_by = {};  ///< the option whose output may replace this input, or none
  std::vector<std::string> choices = {};  ///< if not empty, no other value is accepted
};

/// Of a file to read.
[[nodiscard]] Values input(std::string placeholder, ValueKind kind);
/// Of a file to write, "-" being standard output.
[[nodiscard]] Values output(std::string placeholder);
/// Of a file to write beside the report, which has standard output.
[[nodiscard]] Values further_output(std::string placeholder);
/// Of a folder, which need not exist.
[[nodiscard]] Values folder(std::string placeholder = "DIR");
/// Of a folder that is there.
[[nodiscard]] Values existing_folder();
/// Of a task or behavior, or of a file that need not exist.
[[nodiscard]] Values name_of(std::string placeholder, ValueKind kind);
/// Of two words with an equals sign between them, which `placeholder` shows; for complaints, what
/// they are, and an example.
[[nodiscard]] Values pair_of_words(const std::string& placeholder, std::string expected,
                                   const std::string& example);
/// Of OLD=NEW, where a newer catalog has another name for the same.
[[nodiscard]] Values old_and_new_name();
[[nodiscard]] Values one_of(std::string placeholder, std::vector<std::string> choices);
[[nodiscard]] Values whole_number(std::string placeholder, std::int64_t least,
                                  std::int64_t most = std::numeric_limits<std::int64_t>::max());
/// Of a time of at least so many microseconds, written in seconds.
[[nodiscard]] Values seconds(Microseconds least = 1);
/// Of a part of a whole, from 0 to 100, with at most one decimal.
[[nodiscard]] Values percent();
/// The tenths of a percent in such a value.
[[nodiscard]] std::uint64_t tenths_in(const std::string& percent);
/// Such a value as it is written: "50 %", "99.5 %".
[[nodiscard]] std::string describe_percent(const std::string& percent);

/// The parts between separators; at least one, which may be empty.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);
/// The known name that is nearest to a wrong one, as a question; empty if none is near.
[[nodiscard]] std::string suggest(std::string_view name, const std::vector<std::string>& known);
/// In a sentence: with quotes if it has a blank.
[[nodiscard]] std::string quote_if_split(const std::string& text);
/// "text, json or gcc"; words with blanks are quoted.
[[nodiscard]] std::string join_with_or(const std::vector<std::string>& words);

/// The names in a table, such as that of the formats of a report.
template <typename Table>
[[nodiscard]] std::vector<std::string> names_in(const Table& table) {
  std::vector<std::string> names;
  for (const auto& row : table) names.emplace_back(row.name);
  return names;
}
/// Null if the table has no such name.
template <typename Table>
[[nodiscard]] auto* find_named(const Table& table, std::string_view name) {
  for (const auto& row : table) {
    if (row.name == name) return &row;
  }
  return static_cast<decltype(&*table.begin())>(nullptr);
}

}  // namespace cbc::cli
