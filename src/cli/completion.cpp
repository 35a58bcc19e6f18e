#include "cli/completion.h"

#include <algorithm>
#include <cstddef>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/completion_names.h"
#include "cli/typed_line.h"
#include "cli/value_kind.h"

namespace cbc::cli {
namespace {

/// What an option or a command does, in a few words of its help.
std::string first_words(std::string text) {
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

/// The names come out of a catalog on the line, or of one that a script there names.
void offer_names_of(const TypedLine& line, bool with_behaviors, Completion& completion) {
  const std::vector<std::string>& paths = line.files.empty() ? line.scripts : line.files;
  if (!paths.empty()) offer_names(names_of_file(paths.front(), with_behaviors), completion);
}

void offer_kind(ValueKind kind, const TypedLine& line, Completion& completion) {
  switch (kind) {
    case ValueKind::catalog:
      return offer_files({"yaml", "yml", "cbc"}, completion);
    case ValueKind::script:
      return offer_files({"yaml", "yml", "json"}, completion);
    case ValueKind::catalog_or_script:
      return offer_files({"yaml", "yml", "json", "cbc"}, completion);
    case ValueKind::shard:
      return offer_files({"json"}, completion);
    case ValueKind::file:
      return offer_files({}, completion);
    case ValueKind::rule:
      return offer_names(rule_names_with_help(), completion);
    case ValueKind::schema:
      return offer_names(schema_names_with_help(), completion);
    case ValueKind::task:
      return offer_names_of(line, false, completion);
    case ValueKind::task_or_behavior:
      return offer_names_of(line, true, completion);
  }
}

void offer_values(CLI::Option& option, const TypedLine& line, const std::string& typed,
                  Completion& completion) {
  if (option.get_delimiter() != '\0') {
    const std::size_t last = typed.rfind(option.get_delimiter());
    if (last != std::string::npos) completion.prefix += typed.substr(0, last + 1);
  }
  for (const std::string& choice : choices_of(option))
    completion.candidates.push_back({choice, ""});
  if (const auto kind = kind_of(option)) offer_kind(*kind, line, completion);
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

Completion complete(CLI::App& program, const std::vector<std::string>& words,
                    const std::vector<std::string>& behind) {
  Completion completion;
  if (words.empty()) return completion;
  const std::string& last = words.back();
  const TypedLine line = understand_line(program, words, behind);
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
    if (!last.starts_with("--")) return completion;  // short options take no '='
    CLI::Option* const option = line.command->get_option_no_throw(last.substr(0, equals));
    if (option == nullptr || !takes_value(*option)) return completion;
    completion.prefix = last.substr(0, equals + 1);
    offer_values(*option, line, last.substr(equals + 1), completion);
    return completion;
  }
  CLI::Option* const positional = next_positional(*line.command, line.positionals);
  if (is_dash || (positional == nullptr && last.empty() && !line.has_separator)) {
    offer_options(*line.command, completion);
  } else if (positional != nullptr && line.argument) {
    offer_kind(*line.argument, line, completion);
  } else if (positional != nullptr) {
    offer_values(*positional, line, last, completion);
  }
  return completion;
}

}  // namespace cbc::cli
