// Finds names that people take for one another.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/check/check.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

char32_t to_small(char32_t c) {
  const bool is_latin = (c >= U'A' && c <= U'Z') || (c >= 0xC0 && c <= 0xDE && c != 0xD7);
  const bool is_greek = c >= 0x391 && c <= 0x3A9;
  const bool is_cyrillic = c >= 0x410 && c <= 0x42F;
  if (is_latin || is_greek || is_cyrillic) return c + 0x20;
  return c >= 0x400 && c <= 0x40F ? c + 0x50 : c;
}

char32_t keep(char32_t c) { return c; }

char32_t to_shape(char32_t c) {
  if (c == U'0') return U'O';
  return c == U'1' || c == U'I' || c == U'|' ? U'l' : c;
}

/// Letters that look alike in the other case only, such as '1' and 'L', stay different.
char32_t to_small_shape(char32_t c) { return c == U'0' ? U'o' : to_small(c); }

/// A way to spell a character.
using Spelling = char32_t (*)(char32_t);

/// The characters of a name that are seen, but for blanks around it.
std::u32string visible_part_of(std::string_view name) {
  std::u32string text;
  for (std::size_t offset = 0; offset < name.size();) {
    const utf8::Decoded decoded = utf8::decode(name, offset);
    offset += decoded.bytes;
    const char32_t c = decoded.character;
    if (!is_invisible(c) && (c != U' ' || !text.empty())) text += c;
  }
  while (!text.empty() && text.back() == U' ') text.pop_back();
  return text;
}

constexpr std::u32string_view separators = U" _-./";

/// Each character spelled in a certain way. If `joins`, whatever separates two words is '_'.
std::u32string spelled(std::u32string_view text, Spelling spell, bool joins) {
  std::u32string result;
  bool follows_separator = false;
  for (const char32_t c : text) {
    const bool joint = joins && separators.find(c) != std::u32string_view::npos;
    if (!joint) result += spell(c);
    if (joint && !follows_separator) result += U'_';
    follows_separator = joint;
  }
  return result;
}

/// "U+041E".
std::string code_point(char32_t character) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string text;
  for (std::uint32_t rest = character; rest > 0 || text.size() < 4; rest >>= 4U) {
    text.insert(text.begin(), digits[rest & 0xFU]);
  }
  return "U+" + text;
}

enum class Script : std::uint8_t { none, latin, greek, cyrillic };
constexpr std::array<std::string_view, 4> script_names = {"", "Latin", "Greek", "Cyrillic"};

Script script_of(char32_t c) {
  const char32_t small = to_small(c);
  if ((small >= U'a' && small <= U'z') || (c >= 0xC0 && c <= 0x24F)) return Script::latin;
  if (c >= 0x370 && c <= 0x3FF) return Script::greek;
  return c >= 0x400 && c <= 0x52F ? Script::cyrillic : Script::none;
}

/// What makes a name deceive by itself: a character that cannot be seen, or letters of two scripts
/// in one word. Or nothing.
std::string deceit_of(std::string_view name) {
  Script script = Script::none;
  std::size_t number = 1;
  for (std::size_t offset = 0; offset < name.size(); ++number) {
    const utf8::Decoded decoded = utf8::decode(name, offset);
    const char32_t c = decoded.character;
    const auto place = [&] {
      return "character " + std::to_string(number) + " is " + code_point(c);
    };
    if (decoded.valid && is_invisible(c)) {
      return " has a character that cannot be seen: " + place();
    }
    const Script found = script_of(c);
    if (found != Script::none && script != Script::none && found != script) {
      return concat(" mixes ", script_names[static_cast<std::size_t>(script)], " and ",
                    script_names[static_cast<std::size_t>(found)], " letters in a word: ", place());
    }
    if (found != Script::none) script = found;
    if (separators.find(c) != std::u32string_view::npos) script = Script::none;
    offset += decoded.bytes;
  }
  return {};
}

/// How two names that look alike differ: "they differ only in upper and lower case".
std::string difference_of(std::string_view name, std::string_view other) {
  const auto are_same = [text = visible_part_of(name), other_text = visible_part_of(other)](
                            Spelling spell, bool joins) {
    return spelled(text, spell, joins) == spelled(other_text, spell, joins);
  };
  if (!are_same(keep, false)) {
    if (are_same(to_small, false)) return "they differ only in upper and lower case";
    if (are_same(keep, true)) return "they differ only in what separates the words";
    if (are_same(to_small, true)) return "they differ only in case and in what separates the words";
    if (!are_same(to_shape, true)) {
      return "they differ only in case and in characters that look alike";
    }
  }
  std::size_t place = 0;
  std::size_t number = 1;
  for (; place < std::min(name.size(), other.size()); ++number) {
    const utf8::Decoded own = utf8::decode(name, place);
    if (own.character != utf8::decode(other, place).character) break;
    place += own.bytes;
  }
  const auto shown = [place](std::string_view text) {
    return place < text.size() ? code_point(utf8::decode(text, place).character)
                               : std::string("missing");
  };
  return "character " + std::to_string(number) + " is " + shown(name) + " in the one and " +
         shown(other) + " in the other";
}

/// Reports names of one kind that people take for one another. They differ only in upper and lower
/// case, in what separates their words, in characters that look alike in many fonts ('0' and 'O';
/// '1', 'l' and 'I'), or in characters that cannot be seen. Which letters of two scripts look alike
/// is a matter of fonts; a word with letters of both is reported, whatever it looks like.
class NameCheck {
 public:
  explicit NameCheck(Reporter& reporter) : reporter_(reporter) {}

  /// `kind`: what the name is of, as in messages. An empty name is not known.
  void add(const std::string& kind, const std::string& name, const Range& range) {
    if (name.empty()) return;
    const std::optional<std::size_t> found = find_like(name);
    names_.push_back({kind + " " + quote(name), name, range});
    if (!found) {
      if (const std::string deceit = deceit_of(name); !deceit.empty()) {
        reporter_.report(rule::confusable_name, range, names_.back().shown + deceit);
      }
      return;
    }
    const Name& first = names_[*found];
    std::vector<Note> notes;
    if (first.range != range)
      notes.push_back(reporter_.note(first.range, first.shown + " is here"));
    reporter_.report(rule::confusable_name, range,
                     names_.back().shown + " is easily taken for " + first.shown + ": " +
                         difference_of(name, first.name),
                     std::move(notes));
  }

 private:
  struct Name {
    std::string shown;
    std::string name;
    Range range;
  };

  /// The first name so far that looks like this one, but is another.
  std::optional<std::size_t> find_like(const std::string& name) {
    const std::u32string text = visible_part_of(name);
    std::optional<std::size_t> found;
    for (std::size_t way = 0; way < spellings.size(); ++way) {
      std::u32string key = spelled(text, spellings[way], true);
      const std::size_t first =
          firsts_[way].try_emplace(std::move(key), names_.size()).first->second;
      if (!found && first < names_.size() && names_[first].name != name) found = first;
    }
    return found;
  }

  static constexpr std::array<Spelling, 3> spellings = {to_small, to_shape, to_small_shape};

  Reporter& reporter_;
  std::vector<Name> names_;
  /// For each spelling: by the name in it, the first one of names_.
  std::array<std::unordered_map<std::u32string, std::size_t>, spellings.size()> firsts_;
};

}  // namespace

void check_names(const Catalog& catalog, Reporter& reporter) {
  NameCheck tasks(reporter);
  for (const Task& task : catalog.tasks) {
    tasks.add("task", task.name, task.range);
    NameCheck parameters(reporter);
    for (const Parameter& parameter : task.parameters) {
      parameters.add("parameter", parameter.name, parameter.range);
      if (!parameter.allowed_is_list) continue;
      NameCheck values(reporter);
      for (const std::string& value : parameter.allowed_values) {
        values.add("value", value, parameter.allowed_range);
      }
    }
  }
  NameCheck in_situations(reporter);
  for (const Behavior& behavior : catalog.behaviors) {
    in_situations.add("behavior", behavior.name, behavior.range);
  }
  for (const Variable& variable : catalog.variables) {
    in_situations.add("situation variable", variable.name, variable.range);
    NameCheck values(reporter);
    for (const std::string& value : variable.values) values.add("value", value, variable.range);
  }
}

}  // namespace cbc
