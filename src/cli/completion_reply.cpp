#include "cli/completion_reply.h"

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "cli/completion.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

/// What a shell makes of a word, that may not be finished, without expanding anything.
std::string unquote(std::string_view word) {
  std::string plain;
  char quote_mark = '\0';
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char character = word[i];
    if (quote_mark == '\0' && (character == '\'' || character == '"')) {
      quote_mark = character;
    } else if (character == quote_mark) {
      quote_mark = '\0';
    } else if (character == '\\' && quote_mark != '\'') {
      if (i + 1 == word.size()) break;
      const bool is_literal =
          quote_mark == '"' && std::string_view("$`\"\\").find(word[i + 1]) == std::string::npos;
      if (is_literal) plain += character;
      plain += word[++i];
    } else {
      plain += character;
    }
  }
  return plain;
}

bool is_harmless(char character) {
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
         (character >= '0' && character <= '9') ||
         std::string_view("_-./+,@%:=").find(character) != std::string_view::npos ||
         static_cast<unsigned char>(character) >= 0x80;
}

/// A text as bash has to find it behind an opening quote, or behind none. Empty if it cannot be
/// there.
std::optional<std::string> quote_for_bash(std::string_view text, char quote_mark) {
  std::string quoted;
  for (const char character : text) {
    if (quote_mark == '\'') {
      quoted += character == '\'' ? R"('\'')" : std::string(1, character);
    } else if (quote_mark == '"') {
      if (character == '!') return std::nullopt;  // the history is expanded here, too
      if (std::string_view("$`\"\\").find(character) != std::string_view::npos) quoted += '\\';
      quoted += character;
    } else {
      if (!is_harmless(character)) quoted += '\\';
      quoted += character;
    }
  }
  return quoted;
}

/// A word that is being typed.
struct TypedWord {
  std::string plain;       ///< all of it, without quotes
  std::string kept;        ///< what the shell does not replace, without quotes
  char quote_mark = '\0';  ///< that opens what it does replace
};

TypedWord typed_word(const std::string& word, const std::string& kept) {
  TypedWord typed{unquote(word), unquote(kept), '\0'};
  if (word.size() > kept.size() && (word[kept.size()] == '"' || word[kept.size()] == '\'')) {
    typed.quote_mark = word[kept.size()];
  }
  return typed;
}

char to_lower(char character) {
  return character >= 'A' && character <= 'Z' ? static_cast<char>(character - 'A' + 'a')
                                              : character;
}

/// Whether a candidate has all letters of what is typed, in this order and in any case. fish takes
/// it then, if it is the only one; it would find nearly all letters in the help, too.
bool has_letters_of(std::string_view candidate, std::string_view typed) {
  for (const char character : candidate) {
    if (!typed.empty() && to_lower(character) == to_lower(typed.front())) typed.remove_prefix(1);
  }
  return typed.empty();
}

void print_words(const Completion& completion, const TypedWord& typed, std::string_view shell) {
  fmt::print("words\n");
  for (const auto& [text, help] : completion.candidates) {
    const std::string whole = completion.prefix + text;
    if (text.empty() || printable(whole) != whole) continue;
    if (shell == "bash") {
      if (!whole.starts_with(typed.plain) || !whole.starts_with(typed.kept)) continue;
      const auto quoted = quote_for_bash(whole.substr(typed.kept.size()), typed.quote_mark);
      if (quoted) fmt::print("{}\n", *quoted);
    } else if (shell == "zsh" || has_letters_of(whole, typed.plain)) {
      fmt::print("{}\t{}\n", whole, printable(help));
    }
  }
}

void print_files(const Completion& completion, const TypedWord& typed) {
  fmt::print("files");
  for (const std::string_view suffix : completion.suffixes) fmt::print(" {}", suffix);
  const std::size_t skipped = completion.prefix.size();
  const std::string kept = typed.kept.size() > skipped ? typed.kept.substr(skipped) : "";
  fmt::print("\n{}\n{}\n", printable(typed.plain.substr(skipped)), printable(kept));
}

/// 0 if it is no number.
std::size_t parse_place(std::string_view text) {
  std::size_t place = 0;
  std::from_chars(text.data(), text.data() + text.size(), place);
  return place;
}

}  // namespace

void reply_to_shell(CLI::App& program, const std::vector<std::string>& arguments) {
  constexpr std::size_t first_word = 3;
  if (arguments.size() <= first_word) return;
  const std::size_t place = parse_place(arguments[2]);
  if (place == 0 || place > arguments.size() - first_word) return;
  const std::string& shell = arguments[0];
  std::vector<std::string> words(arguments.begin() + first_word, arguments.end());
  const TypedWord typed = typed_word(words[place - 1], arguments[1]);
  if (shell == "bash") {
    for (std::string& word : words) word = unquote(word);
  }
  const auto behind = words.begin() + static_cast<std::ptrdiff_t>(place);
  words[place - 1] = typed.plain;
  const Completion completion = complete(program, {words.begin(), behind}, {behind, words.end()});
  completion.is_file ? print_files(completion, typed) : print_words(completion, typed, shell);
}

}  // namespace cbc::cli
