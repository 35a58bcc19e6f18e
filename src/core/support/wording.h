#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

/// Words for people: suggestions for unknown names, names that look alike, plurals, line breaks in
/// names; and, for programs, URIs.

namespace cbc {

/// Suggests known names for unknown ones. Names are compared word by word, whatever separates the
/// words and in whatever case they are: a suggestion has the same words in any order, of which one
/// may be misspelt. Words with different numbers are different words. If there is no such name, it
/// is the longest one whose words begin or end the unknown name, or the other way around. Of
/// equally near names, the first wins.
///
/// The work of one object is bounded, so that a file full of unknown names stays cheap: after that,
/// there are no more suggestions.
class Suggestions {
 public:
  /// Tells whether a name stands beside the unknown one already, so that it cannot be meant.
  using IsTaken = std::function<bool(std::string_view)>;

  /// `names` are views of texts that must outlive this object.
  explicit Suggestions(std::vector<std::string_view> names) : names_(std::move(names)) {}

  [[nodiscard]] std::optional<std::string_view> nearest(std::string_view name,
                                                        const IsTaken& is_taken = {});

 private:
  /// The words of a name, in small letters.
  using Words = std::vector<std::string>;

  std::vector<std::string_view> names_;
  std::vector<Words> words_;  ///< by name, since the first search
  std::size_t work_left_ = 100'000'000;
};

/// One search in a few names.
[[nodiscard]] std::optional<std::string_view> nearest(std::string_view name,
                                                      std::span<const std::string_view> names,
                                                      const Suggestions::IsTaken& is_taken = {});

/// How a message about an unknown name ends: "; did you mean 'HOVER'?", or nothing.
[[nodiscard]] std::string did_you_mean(std::optional<std::string_view> suggestion);

/// "1 task", "2 tasks", "0 tasks".
[[nodiscard]] inline std::string quantity(std::uint64_t number, std::string_view noun) {
  return std::to_string(number) + " " + std::string(noun) + (number == 1 ? "" : "s");
}

/// The texts of some things, with a separator between each two.
template <typename Things, typename ToText = std::identity>
[[nodiscard]] std::string join(const Things& things, std::string_view separator,
                               const ToText& to_text = {}) {
  std::string text;
  bool is_first = true;
  for (const auto& thing : things) {
    if (!is_first) text += separator;
    text += to_text(thing);
    is_first = false;
  }
  return text;
}

/// "day, dusk or night"; no words make an empty text.
[[nodiscard]] std::string list_with_or(std::span<const std::string> words);
/// "day, dusk and night"
[[nodiscard]] std::string list_with_and(std::span<const std::string> words);

/// Breaks a long name into lines of about equal length, after a blank or one of "_-./" and before
/// the capitals of CamelCase. A line may be longer than `width` characters if it has no such place.
/// The lines, joined, are the name.
[[nodiscard]] std::vector<std::string_view> wrap_name(std::string_view name, std::size_t width);

/// "LIDAR in place of GPS": what there is now, and what there was. Empty: "nothing".
[[nodiscard]] std::string in_place_of(std::string_view now, std::string_view before);

/// A word of a command line, in quotes where a shell would not take it as it is.
[[nodiscard]] std::string in_shell(const std::string& word);

/// The path of a URI (RFC 3986) for the path of a file: every byte but letters, digits, "-._~" and
/// "/" is percent-encoded.
[[nodiscard]] std::string percent_encode(std::string_view path);

/// Appends a byte as "%2F".
void append_percent_encoded(std::string& text, char byte);

/// Escapes a text as content of an XML or HTML element or as a quoted attribute value. Line ends
/// are kept; other control characters, invalid UTF-8 and characters that XML 1.0 does not allow
/// become printable.
[[nodiscard]] std::string xml_text(std::string_view text);

}  // namespace cbc
