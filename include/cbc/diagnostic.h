#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cbc {

/// How much a finding matters: an error makes the input unusable, a warning is a clear meaning that
/// is surely not meant, a note is advice.
enum class Severity : std::uint8_t { note, warning, error };

/// "note", "warning", "error".
[[nodiscard]] std::string_view name_of(Severity severity);

/// A place in a text. Lines and columns count from 1; columns count characters, not bytes.
struct Position {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
  auto operator<=>(const Position&) const = default;
};

/// A stretch of text; `end` is one past the last character.
struct Range {
  Position begin;
  Position end;
  auto operator<=>(const Range&) const = default;
};

/// Another place that belongs to a finding ("first defined here").
struct Note {
  std::string file;
  Range range;
  std::string message;
};

/// A change of the text that mends a finding without changing what the file means.
struct Edit {
  enum class Kind : std::uint8_t {
    replace,      ///< the range by `text`
    remove_entry  ///< the entry of a list that begins at the range
  };
  Kind kind = Kind::replace;
  Range range;
  std::string text;
};

/// One finding about an input file.
struct Diagnostic {
  std::string_view rule;  ///< name of the rule, one of those in cbc/rules.h
  Severity severity = Severity::error;
  std::string file;
  Range range;
  std::string message;
  std::vector<Note> notes;
  std::vector<Edit> edits = {};  ///< all of them together mend it; empty: a person has to
};

/// Collects the findings of one or several files. Readers add to it and go on; nothing is thrown.
class Diagnostics {
 public:
  void add(Diagnostic diagnostic);

  /// Orders the findings by file, line, column, rule.
  void sort();

  [[nodiscard]] const std::vector<Diagnostic>& all() const { return all_; }
  /// Gives the findings away.
  [[nodiscard]] std::vector<Diagnostic> release() { return std::exchange(all_, {}); }
  [[nodiscard]] std::size_t count(Severity severity) const;
  [[nodiscard]] bool has_errors() const { return count(Severity::error) > 0; }

 private:
  std::vector<Diagnostic> all_;
};

}  // namespace cbc
