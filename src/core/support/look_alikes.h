#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace cbc {

/// The first character of a name that cannot be seen, "character 5 is U+200B", or nothing.
[[nodiscard]] std::optional<std::string> invisible_part_of(std::string_view name);

/// Finds names that people take for one another. They differ only in upper and lower case, in what
/// separates their words, in characters that look alike in many fonts ('0' and 'O'; '1', 'l' and
/// 'I'; a Latin letter and what looks like it; two ways to write an accent), or in characters that
/// cannot be seen.
class LookAlikes {
 public:
  /// Returns the place of the first name so far that looks like this one, but is another; places
  /// count from 0, by call.
  std::optional<std::size_t> add(std::string_view name);

 private:
  struct First {
    std::string name;
    std::size_t place = 0;
  };
  using Names = std::unordered_map<std::u32string, First>;

  Names by_case_;   ///< by the name in small letters
  Names by_shape_;  ///< by the name in basic shapes
  Names by_both_;   ///< by the name in small letters of basic shapes
  std::size_t count_ = 0;
};

/// How two names that look alike differ: "they differ only in upper and lower case".
[[nodiscard]] std::string difference_of(std::string_view name, std::string_view other);

}  // namespace cbc
