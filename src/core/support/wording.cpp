#include "core/support/wording.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <numeric>
#include <utility>

#include "runtime/base/text.h"

namespace cbc {

namespace {

// Nobody types longer names, so it is not worth the time to compare them.
constexpr std::size_t longest_compared = 200;
// What shorter names have in common is no reason for a suggestion.
constexpr std::size_t shortest_part = 3;
// Two names that are divided into words in different ways are compared as a whole from here on.
constexpr std::size_t shortest_whole = 6;

// Costs of a suggestion: an edit is worse than another order, and that worse than another case.
constexpr std::size_t edit_cost = 4;
constexpr std::size_t order_cost = 2;
constexpr std::size_t case_cost = 1;

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool joins_words(char c) { return std::string_view(" _-./").find(c) != std::string_view::npos; }

char fold(char c) { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }

/// Whether a word of CamelCase begins at a place, as at the 'C' of "PIDControl".
bool begins_word(std::string_view name, std::size_t place) {
  if (place == 0 || !is_upper(name[place])) return false;
  const bool is_before_lower = place + 1 < name.size() && is_lower(name[place + 1]);
  return is_lower(name[place - 1]) || (is_upper(name[place - 1]) && is_before_lower);
}

std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words;
  bool is_new = true;
  for (std::size_t place = 0; place < name.size(); ++place) {
    if (joins_words(name[place])) {
      is_new = true;
      continue;
    }
    if (is_new || begins_word(name, place)) words.emplace_back();
    is_new = false;
    words.back() += fold(name[place]);
  }
  return words;
}

/// The digits of a word, with a blank after each number.
std::string numbers_of(std::string_view word) {
  std::string numbers;
  for (std::size_t place = 0; place < word.size(); ++place) {
    if (!is_digit(word[place])) continue;
    numbers += word[place];
    if (place + 1 == word.size() || !is_digit(word[place + 1])) numbers += ' ';
  }
  return numbers;
}

/// How many letters of a word may be wrong. In one of two letters, one may be missing, or they may
/// be in the wrong order; with another letter it is another word.
std::size_t most_edits(std::string_view word, std::string_view other) {
  const std::size_t length = std::max(word.size(), other.size());
  if (length > 2) return length < 6 ? 1 : 2;
  if (length < 2) return 0;
  const bool is_shorter = word.size() != other.size();
  return is_shorter || (word[0] == other[1] && word[1] == other[0]) ? 1 : 0;
}

/// Edit distance with transpositions of neighbors (optimal string alignment), or `limit + 1` if it
/// is more than `limit`. Adds its work to `work`.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit,
                          std::size_t& work) {
  const std::size_t beyond = limit + 1;
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) > limit) return beyond;
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> previous(b.size() + 1);
  std::vector<std::size_t> current(b.size() + 1);
  std::iota(previous.begin(), previous.end(), 0);
  std::size_t smallest_before = 0;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        current[j] = std::min(current[j], before[j - 2] + 1);
      }
    }
    work += b.size();
    const std::size_t smallest = *std::min_element(current.begin(), current.end());
    // A transposition looks two rows back.
    if (smallest > limit && smallest_before > limit) return beyond;
    smallest_before = smallest;
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return std::min(previous[b.size()], beyond);
}

/// A name that is sought, and how others differ from it.
class Wanted {
 public:
  explicit Wanted(std::string_view name)
      : name_(name), words_(words_of(name)), joined_(join(words_, "")) {}

  /// The cost of a suggestion that has the same words, one of them perhaps misspelt. Adds its work
  /// to `work`.
  std::optional<std::size_t> cost_of(std::string_view name, const std::vector<std::string>& words,
                                     std::size_t& work) const {
    work += name.size();
    const std::string joined = join(words, "");
    if (joined == joined_) return name.size() == name_.size() ? case_cost : order_cost;
    return words.size() == words_.size() ? cost_of_words(words, work) : cost_of_whole(joined, work);
  }

  /// Letters of the words that this name and another one have in common, if all words of one of
  /// them begin or end the other; 0 otherwise.
  [[nodiscard]] std::size_t common_part(const std::vector<std::string>& words) const {
    const auto& part = words.size() < words_.size() ? words : words_;
    const auto& whole = words.size() < words_.size() ? words_ : words;
    if (part.size() == whole.size()) return 0;
    const bool is_part = std::equal(part.begin(), part.end(), whole.begin()) ||
                         std::equal(part.rbegin(), part.rend(), whole.rbegin());
    const std::size_t length = is_part ? join(part, "").size() : 0;
    return length < shortest_part ? 0 : length;
  }

 private:
  /// The number of wrong letters of a word; nothing if it is another word.
  static std::optional<std::size_t> find_edits(const std::string& word, const std::string& other,
                                               std::size_t limit, std::size_t& work) {
    const std::string numbers = numbers_of(word);
    const std::string other_numbers = numbers_of(other);
    // "H0VER" is misspelt, "CAMERA1" is not.
    if (!numbers.empty() && !other_numbers.empty() && numbers != other_numbers) return std::nullopt;
    const std::size_t edits = edit_distance(word, other, limit, work);
    return edits > limit ? std::nullopt : std::optional(edits);
  }

  [[nodiscard]] std::optional<std::size_t> cost_of_words(const std::vector<std::string>& words,
                                                         std::size_t& work) const {
    std::vector<std::size_t> left;  // words of the other name that this one lacks
    std::vector<bool> is_used(words_.size());
    bool is_in_order = true;
    for (std::size_t place = 0; place < words.size(); ++place) {
      // The same word at the same place comes first.
      std::size_t own = place;
      if (is_used[own] || words_[own] != words[place]) {
        own = 0;
        while (own < words_.size() && (is_used[own] || words_[own] != words[place])) ++own;
      }
      if (own == words_.size()) {
        left.push_back(place);
        continue;
      }
      is_used[own] = true;
      is_in_order = is_in_order && own == place;
    }
    const std::size_t order = is_in_order ? 0 : order_cost;
    if (left.empty()) return order;
    // A letter that moved to a neighboring word is one wrong letter of the whole.
    if (left.size() > 1) return cost_of_whole(join(words, ""), work);
    const auto own = static_cast<std::size_t>(std::find(is_used.begin(), is_used.end(), false) -
                                              is_used.begin());
    const std::string& word = words_[own];
    const std::string& other = words[left.front()];
    const auto edits = find_edits(word, other, most_edits(word, other), work);
    if (!edits) return std::nullopt;
    return *edits * edit_cost + order;
  }

  /// For names that are divided into words in different ways.
  [[nodiscard]] std::optional<std::size_t> cost_of_whole(const std::string& joined,
                                                         std::size_t& work) const {
    if (joined.size() < shortest_whole || numbers_of(joined) != numbers_of(joined_)) {
      return std::nullopt;
    }
    const auto edits = find_edits(joined_, joined, 1, work);
    return edits ? std::optional(edit_cost + order_cost) : std::nullopt;
  }

  std::string_view name_;
  std::vector<std::string> words_;
  std::string joined_;
};

std::optional<std::string_view> search(std::string_view name,
                                       std::span<const std::string_view> names,
                                       std::span<const std::vector<std::string>> words,
                                       const Suggestions::IsTaken& is_taken,
                                       std::size_t& work_left) {
  if (name.empty() || name.size() > longest_compared || work_left == 0) return std::nullopt;

  const Wanted wanted(name);
  std::optional<std::string_view> best;
  std::size_t best_cost = 0;
  std::optional<std::string_view> best_part;
  std::size_t best_part_length = 0;
  std::size_t work = names.size();
  for (std::size_t place = 0; place < names.size(); ++place) {
    const std::string_view candidate = names[place];
    if (words[place].empty() || candidate.size() > longest_compared || candidate == name) continue;
    const auto cost = wanted.cost_of(candidate, words[place], work);
    const std::size_t part = cost || best ? 0 : wanted.common_part(words[place]);
    const bool is_better = cost ? !best || *cost < best_cost : part > best_part_length;
    if (!is_better || (is_taken && is_taken(candidate))) continue;
    if (cost) {
      best = candidate;
      best_cost = *cost;
    } else {
      best_part = candidate;
      best_part_length = part;
    }
  }
  work_left -= std::min(work, work_left);
  return best ? best : best_part;
}

}  // namespace

std::optional<std::string_view> Suggestions::nearest(std::string_view name,
                                                     const IsTaken& is_taken) {
  if (words_.empty()) {
    words_.reserve(names_.size());
    for (const std::string_view known : names_) words_.push_back(words_of(known));
  }
  return search(name, names_, words_, is_taken, work_left_);
}

std::optional<std::string_view> nearest(std::string_view name,
                                        std::span<const std::string_view> names,
                                        const Suggestions::IsTaken& is_taken) {
  return Suggestions({names.begin(), names.end()}).nearest(name, is_taken);
}

std::string did_you_mean(std::optional<std::string_view> suggestion) {
  return suggestion ? "; did you mean " + quote(*suggestion) + "?" : std::string();
}

namespace {

/// Whether a line may end before this byte.
bool can_break(std::string_view name, std::size_t place) {
  const char before = name[place - 1];
  const char after = name[place];
  if (joins_words(before)) return !joins_words(after);
  return (is_lower(before) || is_digit(before)) && is_upper(after);
}

/// The end of the first line: the break that makes it nearest to the length.
std::size_t end_of_first_line(std::string_view name, std::size_t length) {
  std::size_t best = name.size();
  std::size_t best_distance = utf8::count_characters(name) - length;
  for (std::size_t place = 1; place < name.size(); ++place) {
    if (!can_break(name, place)) continue;
    const std::size_t line = utf8::count_characters(name.substr(0, place));
    const std::size_t distance = line > length ? line - length : length - line;
    if (distance < best_distance) {
      best = place;
      best_distance = distance;
    }
    if (line > length) break;
  }
  return best;
}

}  // namespace

std::vector<std::string_view> wrap_name(std::string_view name, std::size_t width) {
  std::vector<std::string_view> lines;
  const std::size_t length = utf8::count_characters(name);
  // A few more characters are better than another line.
  const std::size_t count = (length - std::min(length, width / 3) + width - 1) / width;
  for (std::size_t left = count; left > 1 && !name.empty(); --left) {
    const std::size_t line = utf8::count_characters(name) / left;
    const std::size_t end = end_of_first_line(name, line);
    lines.push_back(name.substr(0, end));
    name.remove_prefix(end);
  }
  if (!name.empty() || lines.empty()) lines.push_back(name);
  return lines;
}

namespace {

bool stands_for_itself(char byte) {
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') ||
         (byte >= '0' && byte <= '9') || byte == '-' || byte == '.' || byte == '_' || byte == '~' ||
         byte == '/';
}

/// "day, dusk LAST night"
std::string list_words(std::span<const std::string> words, std::string_view last) {
  if (words.size() < 2) return join(words, "");
  return concat(join(words.first(words.size() - 1), ", "), " ", last, " ", words.back());
}

}  // namespace

std::string list_with_or(std::span<const std::string> words) { return list_words(words, "or"); }
std::string list_with_and(std::span<const std::string> words) { return list_words(words, "and"); }

std::string in_place_of(std::string_view now, std::string_view before) {
  const auto name = [](std::string_view text) {
    return text.empty() ? "nothing" : printable(text);
  };
  return concat(name(now), " in place of ", name(before));
}

std::string in_shell(const std::string& word) {
  const bool is_plain = std::all_of(word.begin(), word.end(), [](char character) {
    return std::isalnum(static_cast<unsigned char>(character)) != 0 ||
           std::string_view("_./-+").find(character) != std::string_view::npos;
  });
  if (is_plain && !word.empty()) return word;
  std::string quoted = "'";
  for (const char character : printable(word)) {
    if (character == '\'') {
      quoted += "'\\''";
    } else {
      quoted += character;
    }
  }
  return quoted + "'";
}

std::string percent_encode(std::string_view path) {
  std::string encoded;
  for (const char byte : path) {
    if (stands_for_itself(byte)) {
      encoded += byte;
    } else {
      append_percent_encoded(encoded, byte);
    }
  }
  return encoded;
}

void append_percent_encoded(std::string& text, char byte) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  const unsigned value = static_cast<unsigned char>(byte);
  text += '%';
  text += digits[value / 16];
  text += digits[value % 16];
}

namespace {

/// As a character reference: parsers turn a plain line end in an attribute into a blank.
constexpr std::string_view line_end = "&#10;";

std::string escape(std::string_view character, char32_t code) {
  switch (code) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\n':
      return std::string(line_end);
    case 0xFFFE:
      return "\\ufffe";
    case 0xFFFF:
      return "\\uffff";
    default:
      return printable(character);
  }
}

}  // namespace

std::string xml_text(std::string_view text) {
  std::string escaped;
  for (std::size_t offset = 0; offset < text.size();) {
    const utf8::Decoded decoded = utf8::decode(text, offset);
    escaped += escape(text.substr(offset, decoded.bytes), decoded.character);
    offset += decoded.bytes;
  }
  return escaped;
}

}  // namespace cbc
