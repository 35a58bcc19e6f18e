#include "cli/command_line.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "base/text.h"
#include "cli/commands.h"
#include "support/wording.h"

namespace cbc::cli {
namespace {

// A validator is what CLI11 lets one attach to an option. Its name says what it is.
constexpr const char* choice_name = "choice";
constexpr std::array<std::pair<ValueKind, const char*>, 9> kind_names = {
    {{ValueKind::catalog, "a catalog"},
     {ValueKind::script, "a script"},
     {ValueKind::catalog_or_script, "a catalog or a script"},
     {ValueKind::shard, "the result of a shard"},
     {ValueKind::file, "a file"},
     {ValueKind::rule, "a rule"},
     {ValueKind::schema, "a schema"},
     {ValueKind::task, "a task"},
     {ValueKind::task_or_behavior, "a task or a behavior"}}};

const CLI::Validator* find_validator(CLI::Option& option, const std::string& name) {
  try {
    return option.get_validator(name);
  } catch (const CLI::OptionNotFound&) {
    return nullptr;
  }
}

}  // namespace

std::string describe(ValueKind kind) {
  const auto* const named = std::find_if(kind_names.begin(), kind_names.end(),
                                         [&](const auto& known) { return known.first == kind; });
  return named->second;
}

CLI::Validator stands_for(ValueKind kind) {
  return {[](const std::string&) { return std::string(); }, "", describe(kind)};
}

std::optional<ValueKind> kind_of(CLI::Option& option) {
  for (const auto& [kind, name] : kind_names) {
    if (find_validator(option, name) != nullptr) return kind;
  }
  return std::nullopt;
}

CLI::Validator one_of(const std::vector<std::string>& choices) {
  const auto check = [choices](const std::string& text) -> std::string {
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) return {};
    const std::vector<std::string_view> names(choices.begin(), choices.end());
    return fmt::format("expected {}, found {}{}", list_choices(choices), quote(text),
                       did_you_mean(nearest(text, names)));
  };
  return {check, fmt::format("{}", fmt::join(choices, ",")), choice_name};
}

std::vector<std::string> choices_of(CLI::Option& option) {
  const CLI::Validator* const choice = find_validator(option, choice_name);
  if (choice == nullptr) return {};
  return CLI::detail::split(choice->get_description(), ',');
}

std::string list_choices(const std::vector<std::string>& choices) {
  std::string list = choices.front();
  for (std::size_t i = 1; i < choices.size(); ++i) {
    list += (i + 1 < choices.size() ? ", " : " or ") + choices[i];
  }
  return list;
}

bool takes_value(const CLI::Option& option) { return option.get_items_expected_min() > 0; }

CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
  const auto check = [least, most](const std::string& text) -> std::string {
    std::int64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    if (error == std::errc() && stop == end && number >= least && number <= most) {
      return {};
    }
    if (stop != end || error == std::errc::invalid_argument) {
      return fmt::format("expected a whole number, found {}", quote(text));
    }
    if (error == std::errc() && most == std::numeric_limits<std::int64_t>::max()) {
      return fmt::format("expected a whole number from {} on, found {}", least, quote(text));
    }
    return fmt::format("expected a whole number from {} to {}, found {}", least, most, quote(text));
  };
  return {check, ""};
}

CLI::Validator seconds(Microseconds least) {
  const auto check = [least](const std::string& text) -> std::string {
    const Decimal time = parse_seconds(text);
    if (time.error == DecimalError::no_error && time.value >= least) return {};
    return fmt::format("expected seconds, from {} to 1000000000, found {}",
                       format_decimal(least, 6), quote(text));
  };
  return {check, ""};
}

namespace {

constexpr std::size_t line_width = 80;
constexpr std::size_t column = 26;  ///< where the descriptions of options and commands begin

/// Breaks a text between words into lines that fit. All but the first begin with `indent` blanks;
/// the first one follows on as many characters.
std::string wrap(std::string_view text, std::size_t indent) {
  std::string wrapped;
  std::size_t used = indent;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::string_view word = text.substr(begin, text.find(' ', begin) - begin);
    if (begin > 0 && used + 1 + word.size() > line_width) {
      wrapped += '\n' + std::string(indent, ' ');
      used = indent;
    } else if (begin > 0) {
      wrapped += ' ';
      ++used;
    }
    wrapped += word;
    used += word.size();
    begin += word.size() + 1;
  }
  return wrapped;
}

std::string wrap_lines(std::string_view text) {
  std::string wrapped;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
    wrapped += (line.starts_with(' ') ? std::string(line) : wrap(line, 0)) + '\n';
    begin += line.size() + 1;
  }
  return wrapped;
}

std::string entry(const std::string& name, const std::string& text) {
  std::string line = "  " + name;
  line += line.size() + 2 <= column ? std::string(column - line.size(), ' ')
                                    : '\n' + std::string(column, ' ');
  return line + wrap(text, column) + '\n';
}

class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat(std::vector<std::string> usages, std::string examples)
      : usages_(std::move(usages)), examples_(std::move(examples)) {}

  std::string make_description(const CLI::App* app) const override {
    return wrap(app->get_description(), 0) + "\n\n";
  }

  std::string make_usage(const CLI::App* /*app*/, std::string name) const override {
    std::string text;
    for (const std::string& usage : usages_) {
      text += fmt::format("{}{} {}\n", text.empty() ? "Usage: " : "       ", name, usage);
    }
    return text + "\nExamples:\n" + examples_;
  }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    // It writes two empty lines between groups.
    return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, std::move(name), mode),
                                         "\n\n\n", "\n\n");
  }

  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return entry(make_option_name(option, is_positional) + make_option_opts(option),
                 make_option_desc(option));
  }

  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_name(), command->get_description());
  }

  std::string make_footer(const CLI::App* app) const override {
    return wrap_lines(app->get_footer());
  }

 private:
  std::vector<std::string> usages_;
  std::string examples_;
};

}  // namespace

void set_help(CLI::App& command, HelpText text) {
  command.formatter(std::make_shared<HelpFormat>(std::move(text.usages), std::move(text.examples)));
  command.footer(std::move(text.footer));
}

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
