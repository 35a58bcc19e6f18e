#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

/// Findings about input files: what they are, how they are collected, and how they look in a
/// terminal.
namespace cbc {

struct Rule;  // diagnostic/rules.h

/// How much a finding matters: an error makes the input unusable; with a warning its meaning is
/// clear, but hardly intended; a note is advice.
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

/// "file:line:column", as compilers write places and editors read them. The file's name is written
/// as it is given.
[[nodiscard]] std::string format_place(std::string_view file, const Position& place);

/// Another place that a finding is about ("first defined here").
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
  std::string_view rule;  ///< the name of one in diagnostic/rules.h
  Severity severity = Severity::error;
  std::string file;
  Range range;
  std::string message;
  std::vector<Note> notes;
  std::vector<Edit> edits = {};  ///< together they mend it; empty: it takes a person
  bool is_fixed = false;         ///< settings cannot change its severity
  bool is_off = false;           ///< it is reported only if settings ask for its rule
};

/// How a finding counts, where that is not as its rule says.
struct Standing {
  Severity severity = Severity::error;
  bool is_fixed = false;  ///< settings cannot change the severity
  bool is_off = false;    ///< it is reported only if settings ask for the rule
};

/// Collects the findings of one or several files. Readers add to it and go on; nothing is thrown.
class Diagnostics {
 public:
  void add(Diagnostic diagnostic);

  /// Orders the findings by file, line, column, rule.
  void sort();

  [[nodiscard]] const std::vector<Diagnostic>& all() const { return all_; }
  /// Hands the findings over and keeps none.
  [[nodiscard]] std::vector<Diagnostic> release() { return std::exchange(all_, {}); }
  [[nodiscard]] std::size_t count(Severity severity) const;
  [[nodiscard]] bool has_errors() const { return count(Severity::error) > 0; }

 private:
  std::vector<Diagnostic> all_;
};

/// Reports findings about one file. The same finding is reported once, even if aliases make a piece
/// of the file be read several times.
class Reporter {
 public:
  Reporter(std::string file, Diagnostics& diagnostics)
      : file_(std::move(file)), diagnostics_(diagnostics) {}

  /// Reports with the severity of the rule.
  void report(const Rule& rule, const Range& range, std::string message,
              std::vector<Note> notes = {}, std::vector<Edit> edits = {});

  /// The same for a finding that counts in another way than its rule.
  void report_as(const Standing& standing, const Rule& rule, const Range& range,
                 std::string message, std::vector<Note> notes = {}, std::vector<Edit> edits = {});

  /// A note about another place of this file.
  [[nodiscard]] Note note(const Range& range, std::string message) const {
    return {file_, range, std::move(message)};
  }

  [[nodiscard]] std::size_t errors() const { return errors_; }
  /// The number of errors of one rule.
  [[nodiscard]] std::size_t errors(const Rule& rule) const;

 private:
  std::string file_;
  Diagnostics& diagnostics_;
  std::size_t errors_ = 0;
  std::unordered_map<std::string_view, std::size_t> errors_of_;
  std::unordered_set<std::string> reported_;
};

/// Lines of a text, and the line and column of any byte of it in (nearly) constant time, however
/// long the lines are. Refers to the text, which must outlive it.
class PositionMap {
 public:
  explicit PositionMap(std::string_view text);

  /// The place of the character that begins at `offset`; offsets past the end count as the end.
  [[nodiscard]] Position at(std::size_t offset) const;

  /// The byte at which the character of a place begins. A place past the end of its line counts as
  /// the line break, one past the last line as the end of the text.
  [[nodiscard]] std::size_t offset(const Position& place) const;

  /// The text of a line, which counts from 1, without its line break; empty if there is none.
  [[nodiscard]] std::string_view line(std::uint32_t number) const;

  /// A piece of a line.
  struct Excerpt {
    std::string_view text;
    std::size_t characters_before = 0;  ///< of the line, left out
    bool is_cut_after = false;
  };
  /// The line of a place, at most about `radius` characters to either side of it, however long the
  /// line is.
  [[nodiscard]] Excerpt excerpt(const Position& place, std::size_t radius) const;

 private:
  [[nodiscard]] std::size_t characters_before(std::size_t offset) const;
  [[nodiscard]] std::size_t characters_between(std::size_t begin, std::size_t end) const;
  [[nodiscard]] std::size_t offset_of(std::size_t begin, std::size_t end,
                                      std::size_t characters) const;

  std::string_view text_;
  std::vector<std::size_t> line_starts_;
  // Characters that begin before every 256th byte; columns are differences of such counts.
  std::vector<std::size_t> checkpoints_;
};

/// Escape sequences for a terminal, or empty texts elsewhere.
struct Style {
  std::string_view good;
  std::string_view bad;
  std::string_view strong;
  std::string_view faint;
  std::string_view error;
  std::string_view warning;
  std::string_view note;
  std::string_view caret;
  std::string_view reset;

  [[nodiscard]] constexpr std::string_view of(Severity severity) const {
    switch (severity) {
      case Severity::error:
        return error;
      case Severity::warning:
        return warning;
      case Severity::note:
        break;
    }
    return note;
  }

  /// `text` between `sequence`, which is one of the above, and the reset.
  [[nodiscard]] std::string paint(std::string_view sequence, std::string_view text) const {
    std::string painted(sequence);
    painted += text;
    return painted += reset;
  }
};

[[nodiscard]] constexpr Style plain_style() { return {}; }
[[nodiscard]] constexpr Style color_style() {
  return {.good = "\x1b[32m",
          .bad = "\x1b[31m",
          .strong = "\x1b[1m",
          .faint = "\x1b[2m",
          .error = "\x1b[1;31m",
          .warning = "\x1b[1;35m",
          .note = "\x1b[1;36m",
          .caret = "\x1b[1;32m",
          .reset = "\x1b[0m"};
}

/// The texts that findings are about, by file name.
class SourceTexts {
 public:
  /// `text` must outlive this object. The first text of a name counts.
  void add(std::string file, std::string_view text);

  /// See PositionMap::excerpt; empty if the file or the line is not known.
  [[nodiscard]] PositionMap::Excerpt excerpt(std::string_view file, const Position& place,
                                             std::size_t radius) const;

 private:
  std::map<std::string, PositionMap, std::less<>> texts_;
};

/// A finding for people to read; every line ends with a line break:
///
///     a.yaml:3:9: error: task 'HOVR' is not defined; did you mean 'HOVER'? [undefined-task]
///       task: HOVR
///             ^~~~
///
/// Its notes follow in the same form. Unknown lines are left out; control characters are made
/// harmless.
[[nodiscard]] std::string render(const Diagnostic& diagnostic, const SourceTexts& sources,
                                 const Style& style);

}  // namespace cbc
