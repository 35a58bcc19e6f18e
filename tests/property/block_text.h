// A second, simple reader of the usual block style, with the places of everything, by which the
// mutation test knows what it edits. It shares nothing with the reader under test.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cbc::mutation {

struct Field;

/// A value. Lines count from 1, columns from 0 and in bytes, as edits need them.
struct Item {
  enum class Kind { null, scalar, list, mapping };
  Kind kind = Kind::null;
  bool flow = false;  ///< a list in brackets
  std::string text;   ///< of a scalar, without quotes
  std::size_t line = 0;
  std::size_t column = 0;     ///< of the value; of a block list the dashes, of a mapping the keys
  std::size_t last_line = 0;  ///< the last one with content of it
  std::vector<Item> items;    ///< of a list
  std::vector<Field> fields;  ///< of a mapping

  [[nodiscard]] const Field* find(std::string_view key) const;
};

struct Field {
  std::string key;
  std::size_t line = 0;
  std::size_t column = 0;
  std::size_t last_line = 0;  ///< of its value
  Item value;
};

/// Lines that are edited. The numbers of lines are those of the moment.
class Lines {
 public:
  explicit Lines(std::string_view text);

  [[nodiscard]] std::size_t count() const { return lines_.size(); }
  [[nodiscard]] const std::string& operator[](std::size_t line) const { return lines_[line - 1]; }
  [[nodiscard]] std::string text() const;

  void insert_after(std::size_t line, const std::string& added);
  void erase(std::size_t first, std::size_t last);
  void set(std::size_t line, const std::string& now) { lines_[line - 1] = now; }
  /// Puts a text in the place of `length` bytes.
  void replace(std::size_t line, std::size_t column, std::size_t length, std::string_view now);

  /// The column as findings count it: from 1, in characters.
  [[nodiscard]] std::size_t shown_column(std::size_t line, std::size_t column) const;

  /// Whether there is more in the line than blanks and a comment.
  [[nodiscard]] bool has_content(std::size_t line) const;

 private:
  std::vector<std::string> lines_;
};

/// Nothing if the text is not in the simple style that is understood here.
[[nodiscard]] std::optional<Item> read_block_text(const Lines& lines);

}  // namespace cbc::mutation
