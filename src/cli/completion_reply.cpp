#include "cli/completion_reply.h"

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

void print_words(const Completion& completion, const TypedWord& typed, bool is_bash) {
  fmt::print("words\n");
  for (const auto& [text, help] : completion.candidates) {
    const std::string whole = completion.prefix + text;
    if (text.empty() || printable(whole) != whole) continue;
    if (!is_bash) {
      fmt::print("{}\t{}\n", whole, printable(help));
    } else if (whole.starts_with(typed.plain)) {
      const auto quoted = quote_for_bash(whole.substr(typed.kept.size()), typed.quote_mark);
      if (quoted) fmt::print("{}\n", *quoted);
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

}  // namespace

void reply_to_shell(CLI::App& program, const std::vector<std::string>& arguments) {
  if (arguments.size() < 3) return;
  const bool is_bash = arguments[0] == "bash";
  const TypedWord typed = typed_word(arguments.back(), arguments[1]);
  std::vector<std::string> words(arguments.begin() + 2, arguments.end() - 1);
  if (is_bash) {
    for (std::string& word : words) word = unquote(word);
  }
  words.push_back(typed.plain);
  const Completion completion = complete(program, words);
  completion.is_file ? print_files(completion, typed) : print_words(completion, typed, is_bash);
}

}  // namespace cbc::cli
