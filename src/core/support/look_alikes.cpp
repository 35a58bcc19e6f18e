#include "core/support/look_alikes.h"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <utility>

#include "core/support/look_alikes_table.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

using Parts = std::unordered_map<char32_t, std::u32string>;

/// The letters and marks that composed characters consist of.
const Parts& accented_letters() {
  static const Parts parts = [] {
    Parts all;
    for (const look_alikes::Accent& accent : look_alikes::accents) {
      for (std::size_t place = 0; place < accent.letters.size(); ++place) {
        std::u32string letter(1, accent.letters[place]);
        all.emplace(accent.composed[place], letter += accent.marks);
      }
    }
    for (const look_alikes::Marks& like : look_alikes::marks) {
      for (const char32_t c : like.characters) all.emplace(c, like.marks);
    }
    return all;
  }();
  return parts;
}

/// What characters outside of ASCII look like in it.
const Parts& shapes() {
  static const Parts parts = [] {
    Parts all;
    for (const look_alikes::Shape& like : look_alikes::shapes) {
      for (const char32_t c : like.characters) all.emplace(c, std::u32string(1, like.shape));
    }
    for (const look_alikes::Ligature& ligature : look_alikes::ligatures) {
      all.emplace(ligature.character,
                  std::u32string(ligature.letters.begin(), ligature.letters.end()));
    }
    return all;
  }();
  return parts;
}

/// Spaces and dashes are blanks and hyphens; full-width forms, and the letters and digits of
/// mathematical alphabets, are those of ASCII.
char32_t to_plain(char32_t c) {
  constexpr std::u32string_view letters = U"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  if (c >= 0xFF01 && c <= 0xFF5E) return c - 0xFF01 + U'!';
  if ((c >= 0x2010 && c <= 0x2015) || c == 0x2212) return U'-';
  if (c == 0x00A0 || (c >= 0x2000 && c <= 0x200A) || c == 0x202F || c == 0x3000) return U' ';
  if (c >= 0x1D400 && c <= 0x1D6A3) return letters[(c - 0x1D400) % letters.size()];
  if (c >= 0x1D7CE && c <= 0x1D7FF) return U'0' + (c - 0x1D7CE) % 10;
  return c;
}

using Spelling = void (*)(char32_t, std::u32string&);

void keep(char32_t c, std::u32string& text) { text += c; }

char32_t small_letter(char32_t c) {
  const bool is_latin = (c >= U'A' && c <= U'Z') || (c >= 0xC0 && c <= 0xDE && c != 0xD7);
  const bool is_greek = c >= 0x391 && c <= 0x3A9;
  const bool is_cyrillic = c >= 0x410 && c <= 0x42F;
  if (is_latin || is_greek || is_cyrillic) return c + 0x20;
  return c >= 0x400 && c <= 0x40F ? c + 0x50 : c;
}

void to_small(char32_t c, std::u32string& text) { text += small_letter(c); }

void to_ascii(char32_t c, std::u32string& text) {
  const auto found = c < 0x80 ? shapes().end() : shapes().find(c);
  if (found == shapes().end()) {
    text += c;
  } else {
    text += found->second;
  }
}

/// What separates two words, or looks like it.
bool is_separator(char32_t c) {
  std::u32string shape;
  to_ascii(c, shape);
  return shape.size() == 1 &&
         std::u32string_view(U" _-./").find(shape[0]) != std::u32string_view::npos;
}

void to_shape(char32_t c, std::u32string& text) {
  if (c == U'0') {
    text += U'O';
  } else if (c == U'1' || c == U'I' || c == U'|') {
    text += U'l';
  } else {
    to_ascii(c, text);
  }
}

/// Letters that look alike in the other case only, such as '1' and 'L', stay different.
void to_small_shape(char32_t c, std::u32string& text) {
  const std::size_t before = text.size();
  to_ascii(c == U'0' ? U'o' : c, text);
  for (std::size_t place = before; place < text.size(); ++place) {
    text[place] = small_letter(text[place]);
  }
}

/// The characters of a name that are seen, letters and accents one by one.
std::u32string visible_part_of(std::string_view name) {
  std::u32string text;
  for (std::size_t offset = 0; offset < name.size();) {
    const utf8::Decoded decoded = utf8::decode(name, offset);
    offset += decoded.bytes;
    const char32_t c = to_plain(decoded.character);
    if (is_invisible(c) || (c == U' ' && text.empty())) continue;
    const auto parts = c < 0x80 ? accented_letters().end() : accented_letters().find(c);
    if (parts == accented_letters().end()) {
      text += c;
    } else {
      text += parts->second;
    }
  }
  while (!text.empty() && text.back() == U' ') text.pop_back();
  return text;
}

/// Characters that are seen, each spelled in a certain way. If `joins`, whatever separates two
/// words is '_'.
std::u32string seen(const std::u32string& text, Spelling spell, bool joins) {
  std::u32string spelled;
  bool follows_separator = false;
  for (const char32_t c : text) {
    const bool joint = joins && is_separator(c);
    if (joint && follows_separator) continue;
    follows_separator = joint;
    if (joint) {
      spelled += U'_';
    } else {
      spell(c, spelled);
    }
  }
  return spelled;
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

}  // namespace

std::optional<std::size_t> LookAlikes::add(std::string_view name) {
  const std::size_t place = count_++;
  const std::u32string text = visible_part_of(name);
  const std::initializer_list<std::pair<Names&, Spelling>> ways = {
      {by_case_, to_small}, {by_shape_, to_shape}, {by_both_, to_small_shape}};
  std::optional<std::size_t> found;
  for (const auto& [names, spell] : ways) {
    const First& first =
        names.try_emplace(seen(text, spell, true), First{std::string(name), place}).first->second;
    if (!found && first.name != name) found = first.place;
  }
  return found;
}

std::optional<std::string> invisible_part_of(std::string_view name) {
  std::size_t number = 1;
  for (std::size_t offset = 0; offset < name.size(); ++number) {
    const utf8::Decoded decoded = utf8::decode(name, offset);
    if (decoded.valid && is_invisible(decoded.character)) {
      return "character " + std::to_string(number) + " is " + code_point(decoded.character);
    }
    offset += decoded.bytes;
  }
  return std::nullopt;
}

std::string difference_of(std::string_view name, std::string_view other) {
  const auto are_same = [text = visible_part_of(name), other_text = visible_part_of(other)](
                            Spelling spell, bool joins) {
    return seen(text, spell, joins) == seen(other_text, spell, joins);
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

}  // namespace cbc
