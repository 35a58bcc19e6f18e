#include "cli/usage_errors.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/value_kind.h"
#include "text/nearest.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

std::string suggestion(std::string_view name, const std::vector<std::string>& known) {
  const std::vector<std::string_view> names(known.begin(), known.end());
  return did_you_mean(nearest(name, names));
}

std::vector<std::string> command_names(CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(program)) {
    names.push_back(command->get_name());
  }
  return names;
}

CLI::App& used_app(CLI::App& program) {
  const std::vector<CLI::App*> used = program.get_subcommands();
  return used.empty() ? program : *used.front();
}

std::string describe_unknown_option(CLI::App& app, const std::string& argument) {
  const std::string name = argument.substr(0, argument.find('='));
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& known : option->get_lnames()) names.push_back("--" + known);
  }
  return fmt::format("unknown option {}{}", quote(name), suggestion(name, names));
}

/// Of arguments that nothing could take, the first that is meant as an option; null if none is.
const std::string* find_option_of(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument == "--") break;
    if (argument.size() > 1 && argument.front() == '-') return &argument;
  }
  return nullptr;
}

bool is_before(const std::string& first, const std::string& second,
               const std::vector<std::string>& arguments) {
  return std::find(arguments.begin(), arguments.end(), first) <
         std::find(arguments.begin(), arguments.end(), second);
}

/// The argument to complain of, of those that nothing could take; empty if there is none.
std::string describe_left_over(CLI::App& program, CLI::App& used,
                               const std::vector<std::string>& arguments) {
  if (&used != &program) {
    const std::vector<std::string> of_command = used.remaining();
    if (const auto* const option = find_option_of(of_command)) {
      return describe_unknown_option(used, *option);
    }
  }
  const std::vector<std::string> of_program = program.remaining();
  const auto* const option = find_option_of(of_program);
  if (option != nullptr && &used == &program) return describe_unknown_option(program, *option);
  if (option != nullptr && is_before(*option, used.get_name(), arguments)) {
    const std::string name = option->substr(0, option->find('='));
    if (used.get_option_no_throw(name) == nullptr) return describe_unknown_option(program, name);
    return fmt::format("{} goes after the command {}", name, quote(used.get_name()));
  }
  for (const std::string& argument : program.remaining(true)) {
    if (argument != "--") return fmt::format("unexpected argument {}", quote(argument));
  }
  return {};
}

/// What the value of an option has to be, as "a rule".
std::string describe_value(CLI::Option& option) {
  if (const std::vector<std::string> choices = choices_of(option); !choices.empty()) {
    return "a value: " + list_choices(choices);
  }
  if (const std::optional<ValueKind> kind = kind_of(option)) return describe(*kind);
  // The others are numbers. How --help shows the value tells which.
  const std::string& text = option.get_option_text();
  if (text == "SECONDS") return "a time in seconds";
  if (text == "SHARE") return "a number from 0 to 1";
  if (text == "I/N") return "a share, such as 1/8";
  return "a number";
}

/// What is wrong with the values of one option; empty if it is not an option's fault.
std::string describe_values_of(CLI::Option& option) {
  const std::string name = option.get_name();
  if (!takes_value(option)) return name + " takes no value";
  if (option.count() == 0) return fmt::format("{} needs {}", name, describe_value(option));
  if (option.get_items_expected_max() == 1) return name + " is given more than once";
  return {};
}

/// The two options that a message of CLI11 joins with a verb; empty if it does not.
std::optional<std::pair<std::string, std::string>> split_at(const std::string& message,
                                                            std::string_view verb) {
  const std::size_t place = message.find(verb);
  if (place == std::string::npos) return std::nullopt;
  return std::pair(message.substr(0, place), message.substr(place + verb.size()));
}

/// The option that a message of CLI11 is about; null if it is about none.
CLI::Option* find_subject(CLI::App& app, const std::string& message) {
  constexpr std::string_view conversion = "Could not convert: ";
  const std::size_t first = message.starts_with(conversion) ? conversion.size() : 0;
  const std::string name = message.substr(first, message.find_first_of(": ", first) - first);
  CLI::Option* const option = app.get_option_no_throw(name);
  if (option != nullptr) return option;
  return app.get_option_no_throw("--" + name);  // it names flags without their dashes
}

}  // namespace

std::string describe_usage_error(CLI::App& program, const CLI::ParseError& error,
                                 const std::vector<std::string>& arguments) {
  CLI::App& used = used_app(program);
  if (std::string left_over = describe_left_over(program, used, arguments); !left_over.empty())
    return left_over;
  std::string message = error.what();
  const std::string kind = error.get_name();
  if (kind == "RequiredError") {
    if (&used == &program) return "expected a command";
    if (CLI::Option* const option = find_subject(used, message)) {
      return "expected " + describe_value(*option);
    }
  }
  if (kind == "RequiresError") {
    if (const auto options = split_at(message, " requires ")) {
      return fmt::format("{} goes with {} only", options->first, options->second);
    }
  }
  if (kind == "ExcludesError") {
    if (const auto options = split_at(message, " excludes ")) {
      return fmt::format("{} and {} do not go together", options->first, options->second);
    }
  }
  if (kind == "ArgumentMismatch" || kind == "ConversionError" || kind == "InvalidError") {
    CLI::Option* const option = find_subject(used, message);
    std::string values = option == nullptr ? std::string() : describe_values_of(*option);
    if (!values.empty()) return values;
  }
  return message;
}

std::string find_unknown_command(CLI::App& program, const std::string& argument) {
  if (argument.starts_with('-') || find_command(program, argument) != nullptr) return {};
  std::string meant = suggestion(argument, command_names(program));
  // These are commands of many other programs.
  if (argument == "help" || argument == "version") meant = did_you_mean("--" + argument);
  return fmt::format("unknown command {}{}", quote(argument), meant);
}

std::string find_bad_equals(CLI::App& program, const std::vector<std::string>& arguments) {
  CLI::App* const command = arguments.empty() ? nullptr : find_command(program, arguments.front());
  if (command == nullptr) return {};
  for (std::size_t i = 1; i < arguments.size() && arguments[i] != "--"; ++i) {
    const std::string& argument = arguments[i];
    const std::string name = argument.substr(0, argument.find('='));
    CLI::Option* const option =
        name.starts_with('-') ? command->get_option_no_throw(name) : nullptr;
    if (option == nullptr || !takes_value(*option)) continue;
    if (name == argument) {
      ++i;  // its value, which may be anything
    } else if (name.size() + 1 == argument.size()) {
      return fmt::format("{} needs {}", name, describe_value(*option));
    } else if (!name.starts_with("--")) {
      const std::string value = argument.substr(name.size() + 1);
      return fmt::format("expected {} or {}, found {}", quote(fmt::format("{} {}", name, value)),
                         quote(fmt::format("{}={}", option->get_name(), value)), quote(argument));
    }
  }
  return {};
}

std::string full_name(const CLI::App& program) {
  const std::vector<CLI::App*> used = program.get_subcommands();
  return used.empty() ? "cbc" : "cbc " + used.front()->get_name();
}

}  // namespace cbc::cli
