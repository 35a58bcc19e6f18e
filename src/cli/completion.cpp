#include "cli/completion.h"

#include <algorithm>
#include <cstddef>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/completion_names.h"
#include "cli/value_kind.h"

namespace cbc::cli {
namespace {

/// The words before the last one, understood as far as they can be.
struct TypedLine {
  CLI::App* command = nullptr;           ///< null: it comes next
  bool is_unknown = false;               ///< there is no such command
  CLI::Option* pending = nullptr;        ///< the last word is its value
  bool has_separator = false;            ///< "--": no options come any more
  std::vector<std::string> positionals;  ///< of the command
};

bool is_option(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

TypedLine parse_words(CLI::App& program, const std::vector<std::string>& words) {
  TypedLine line;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const std::string& word = words[i];
    if (line.command == nullptr) {
      if (is_option(word)) continue;
      line.command = find_command(program, word);
      line.is_unknown = line.command == nullptr;
      if (line.is_unknown) return line;
    } else if (line.has_separator || !is_option(word)) {
      line.positionals.push_back(word);
    } else if (word == "--") {
      line.has_separator = true;
    } else if (CLI::Option* const option = line.command->get_option_no_throw(word);
               option != nullptr && takes_value(*option)) {
      if (i + 2 == words.size()) line.pending = option;
      ++i;  // its value
    }
  }
  return line;
}

/// What an option or a command does, in a few words of its help.
std::string first_words(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::size_t end = text.size();
  for (const char* const stop : {". ", "; ", ": ", " ("}) end = std::min(end, text.find(stop));
  text.resize(end);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

void offer_commands(CLI::App& program, Completion& completion) {
  for (const CLI::App* command : commands_of(program)) {
    completion.candidates.push_back({command->get_name(), first_words(command->get_description())});
  }
}

void offer_options(CLI::App& app, Completion& completion) {
  for (CLI::Option* option : app.get_options()) {
    const std::vector<std::string> choices = choices_of(*option);
    const std::string help = choices.empty() ? first_words(option->get_description())
                                             : fmt::format("{}", fmt::join(choices, ", "));
    for (const std::string& name : option->get_lnames()) {
      completion.candidates.push_back({"--" + name, help});
    }
    for (const std::string& name : option->get_snames()) {
      completion.candidates.push_back({"-" + name, help});
    }
  }
}

void offer_names(std::vector<CompletionName> names, Completion& completion) {
  for (CompletionName& name : names) {
    completion.candidates.push_back({std::move(name.name), std::move(name.help)});
  }
}

void offer_files(std::vector<std::string_view> suffixes, Completion& completion) {
  completion.is_file = true;
  completion.suffixes = std::move(suffixes);
}

void offer_values(CLI::Option& option, const TypedLine& line, const std::string& typed,
                  Completion& completion) {
  if (option.get_delimiter() != '\0') {
    const std::size_t last = typed.rfind(option.get_delimiter());
    if (last != std::string::npos) completion.prefix += typed.substr(0, last + 1);
  }
  for (const std::string& choice : choices_of(option))
    completion.candidates.push_back({choice, ""});
  const std::optional<ValueKind> kind = kind_of(option);
  if (!kind) return;
  switch (*kind) {
    case ValueKind::catalog:
      return offer_files({"yaml", "yml", "cbc"}, completion);
    case ValueKind::script:
      return offer_files({"yaml", "yml"}, completion);
    case ValueKind::file:
      return offer_files({}, completion);
    case ValueKind::rule:
      return offer_names(rule_names_with_help(), completion);
    case ValueKind::schema:
      return offer_names(schema_names_with_help(), completion);
    case ValueKind::task:
      return offer_names(names_of_catalog(line.positionals, false), completion);
    case ValueKind::task_or_behavior:
      return offer_names(names_of_catalog(line.positionals, true), completion);
  }
}

/// The positional argument that comes next; null if all are there.
CLI::Option* next_positional(CLI::App& command, std::size_t given) {
  for (CLI::Option* option :
       command.get_options([](const CLI::Option* one) { return one->get_positional(); })) {
    const auto most = static_cast<std::size_t>(option->get_items_expected_max());
    if (given < most) return option;
    given -= most;
  }
  return nullptr;
}

}  // namespace

Completion complete(CLI::App& program, const std::vector<std::string>& words) {
  Completion completion;
  if (words.empty()) return completion;
  const std::string& last = words.back();
  const TypedLine line = parse_words(program, words);
  if (line.is_unknown) return completion;
  const bool is_dash = last.starts_with('-') && !line.has_separator;
  if (line.command == nullptr) {
    is_dash ? offer_options(program, completion) : offer_commands(program, completion);
    return completion;
  }
  if (line.pending != nullptr) {
    offer_values(*line.pending, line, last, completion);
    return completion;
  }
  const std::size_t equals = last.find('=');
  if (is_dash && equals != std::string::npos) {
    CLI::Option* const option = line.command->get_option_no_throw(last.substr(0, equals));
    if (option == nullptr || !takes_value(*option)) return completion;
    completion.prefix = last.substr(0, equals + 1);
    offer_values(*option, line, last.substr(equals + 1), completion);
    return completion;
  }
  CLI::Option* const positional = next_positional(*line.command, line.positionals.size());
  if (is_dash || (positional == nullptr && !line.has_separator)) {
    offer_options(*line.command, completion);
  } else if (positional != nullptr) {
    offer_values(*positional, line, last, completion);
  }
  return completion;
}

}  // namespace cbc::cli
