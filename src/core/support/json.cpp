#include "core/support/json.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include <nlohmann/json.hpp>

#include "runtime/base/text.h"

namespace cbc {

std::optional<double> read_double(std::string_view text) {
#ifdef __cpp_lib_to_chars
  double value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || end != last) return std::nullopt;
#else
  // A libc++ that has from_chars for integers only, as in WebAssembly, where the locale is always
  // "C". strtod also takes blanks, plus signs and hexadecimal numbers.
  if (text.starts_with('+') || text.find_first_not_of("+-.0123456789Ee") != text.npos) {
    return std::nullopt;
  }
  const std::string copy(text);
  char* end = nullptr;
  errno = 0;
  const double value = std::strtod(copy.c_str(), &end);
  if (copy.empty() || end != copy.c_str() + copy.size()) return std::nullopt;
  if (std::isinf(value) || (value == 0 && errno == ERANGE)) return std::nullopt;
#endif
  return value;
}

namespace {

/// Copies a few characters of a text. Returns 0 if all of them stand for themselves in JSON: they
/// are printable ASCII, and neither a quote nor a backslash. Each of the others sets the
/// highest bit of its byte.
template <std::unsigned_integral Word>
Word copy_word(char* to, const char* from) {
  constexpr Word ones = std::numeric_limits<Word>::max() / 0xFF;
  constexpr auto all = [](unsigned char character) { return static_cast<Word>(ones * character); };
  Word word = 0;
  std::memcpy(&word, from, sizeof word);
  std::memcpy(to, &word, sizeof word);
  return static_cast<Word>((word | (word - all(' ')) | ((word ^ all('"')) - ones) |
                            ((word ^ all('\\')) - ones) | ((word ^ all(0x7F)) - ones)) &
                           all(0x80));
}

/// Copies a text that is no shorter than a word. Returns whether all of it stands for itself.
template <std::unsigned_integral Word>
bool copy_words(char* to, std::string_view text) {
  const std::size_t last = text.size() - sizeof(Word);
  Word special = copy_word<Word>(to + last, text.data() + last);
  for (std::size_t place = 0; place < last; place += sizeof(Word)) {
    const Word found = copy_word<Word>(to + place, text.data() + place);
    special = static_cast<Word>(special | found);
  }
  return special == 0;
}

bool copy_plain(char* to, std::string_view text) {
  if (text.size() >= sizeof(std::uint64_t)) return copy_words<std::uint64_t>(to, text);
  if (text.size() >= sizeof(std::uint32_t)) return copy_words<std::uint32_t>(to, text);
  return text.empty() || copy_words<std::uint8_t>(to, text);
}

bool is_digit(char character) { return character >= '0' && character <= '9'; }

/// Whether a text is a number of JSON. One that no double can hold is none here, as many readers of
/// JSON refuse it.
bool is_number(std::string_view text) {
  if (!read_double(text)) return false;
  // These are not numbers in JSON: .5, 05, 5., inf
  if (text.starts_with('-')) text.remove_prefix(1);
  if (!is_digit(text.front())) return false;
  if (text.size() > 1 && text.front() == '0' && is_digit(text[1])) return false;
  const std::size_t point = text.find('.');
  return point == std::string_view::npos || (point + 1 < text.size() && is_digit(text[point + 1]));
}

void append_escape(std::string& json, char32_t unit) {
  constexpr std::string_view digits = "0123456789abcdef";
  json += "\\u";
  for (unsigned shift = 16; shift > 0;) {
    shift -= 4;
    json += digits[(unit >> shift) & 0xFU];
  }
}

std::string dump(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// A text as JSON. Characters that do not show, or would turn the direction of a line that people
/// read, are escaped.
std::string dump_text(std::string_view text) {
  const std::string json = dump(text);
  std::string escaped;
  for (std::size_t offset = 0; offset < json.size();) {
    const utf8::Decoded decoded = utf8::decode(json, offset);
    const char32_t character = decoded.character;
    if (!is_control(character)) {
      escaped += json.substr(offset, decoded.bytes);
    } else if (character < 0x10000) {
      append_escape(escaped, character);
    } else {
      append_escape(escaped, 0xD7C0 + (character >> 10U));
      append_escape(escaped, 0xDC00 + (character & 0x3FFU));
    }
    offset += decoded.bytes;
  }
  return escaped;
}

}  // namespace

void JsonBuffer::put(std::string_view json) {
  make_room(json.size());
  if (json.size() > block_.size()) {
    text_ += json;
  } else {
    std::memcpy(block_.data() + used_, json.data(), json.size());
    used_ += json.size();
  }
}

void JsonBuffer::put_text(std::string_view text) {
  make_room(text.size() + 2);
  char* const begin = block_.data() + used_;
  if (text.size() + 2 > block_.size() || !copy_plain(begin + 1, text)) {
    put(dump_text(text));
    return;
  }
  begin[0] = '"';
  begin[text.size() + 1] = '"';
  used_ += text.size() + 2;
}

void JsonBuffer::put_name(std::string_view name, bool has_comma) {
  make_room(name.size() + 4);
  char* end = block_.data() + used_;
  if (has_comma) *end++ = ',';
  if (name.size() + 4 > block_.size() || !copy_plain(end + 1, name)) {
    if (has_comma) put(',');
    put(dump_text(name));
    put(':');
    return;
  }
  *end = '"';
  end += name.size() + 1;
  *end++ = '"';
  *end++ = ':';
  used_ = static_cast<std::size_t>(end - block_.data());
}

void JsonBuffer::put_number(double number) {
  // Whole numbers and thousandths, which are many, need no search for the fewest digits.
  constexpr double few_digits = 1e9;
  if (std::abs(number) < few_digits && std::trunc(number) == number && !std::signbit(number)) {
    put_integer(static_cast<std::int64_t>(number));
    put(std::string_view(".0"));
    return;
  }
  if (number > 0 && number < 1) {
    constexpr double thousand = 1000;
    const std::int64_t thousandths = std::lround(number * thousand);
    if (static_cast<double>(thousandths) / thousand == number) {
      put_millionths(thousandths * 1000);
      return;
    }
  }
  put(dump(number));
}

void JsonBuffer::put_millionths(std::int64_t number) {
  constexpr std::int64_t million = 1'000'000;
  put_integer(number / million);
  std::array<char, 7> fraction{'.'};
  auto rest = static_cast<std::uint32_t>(number % million);
  std::size_t size = 2;
  for (std::size_t place = fraction.size() - 1; place > 0; --place, rest /= 10) {
    fraction[place] = static_cast<char>('0' + rest % 10);
    if (rest % 10 != 0) size = std::max(size, place + 1);
  }
  put({fraction.data(), size});
}

void append_as_written(std::string& json, std::string_view text) {
  if (is_number(text)) {
    json += text;
  } else {
    append_text(json, text);
  }
}

void append_shortest(std::string& json, std::string_view text) {
  const auto number = nlohmann::json::parse(text, nullptr, false);
  json += number.is_number() ? dump(number) : dump_text(text);
}

void JsonWriter::put_percent(Millionths degree) {
  if (degree % one_percent == 0) {
    put(degree / one_percent);
  } else {
    put(in_percent(degree));
  }
}

}  // namespace cbc
