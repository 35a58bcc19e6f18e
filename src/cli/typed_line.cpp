#include "cli/typed_line.h"

#include <utility>

#include "cli/commands.h"

namespace cbc::cli {
namespace {

bool is_option(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

void add_value(CLI::Option& option, const std::string& value, TypedLine& line) {
  if (kind_of(option) == ValueKind::script) line.scripts.push_back(value);
}

void add_option(const std::string& word, TypedLine& line) {
  const std::size_t equals = word.find('=');
  CLI::Option* const option = line.command->get_option_no_throw(word.substr(0, equals));
  if (option == nullptr) return;
  if (!takes_value(*option)) {
    if (const auto kind = kind_of(*option)) line.argument = kind;
  } else if (equals == std::string::npos) {
    line.pending = option;
  } else {
    add_value(*option, word.substr(equals + 1), line);
  }
}

void add_word(const std::string& word, TypedLine& line) {
  if (line.pending != nullptr) {
    add_value(*std::exchange(line.pending, nullptr), word, line);
  } else if (line.has_separator || !is_option(word)) {
    line.files.push_back(word);
  } else if (word == "--") {
    line.has_separator = true;
  } else {
    add_option(word, line);
  }
}

}  // namespace

TypedLine understand_line(CLI::App& program, const std::vector<std::string>& words,
                          const std::vector<std::string>& behind) {
  TypedLine line;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    if (line.command != nullptr) {
      add_word(words[i], line);
    } else if (!is_option(words[i])) {
      line.command = find_command(program, words[i]);
      line.is_unknown = line.command == nullptr;
      if (line.is_unknown) return line;
    }
  }
  if (line.command == nullptr) return line;
  line.positionals = line.files.size();
  TypedLine whole = line;
  whole.pending = nullptr;
  for (const std::string& word : behind) add_word(word, whole);
  line.files = std::move(whole.files);
  line.scripts = std::move(whole.scripts);
  line.argument = whole.argument;
  return line;
}

}  // namespace cbc::cli
