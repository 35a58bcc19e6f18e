#include "core/command_line/command_line.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "core/files/output.h"
#include "core/files/read.h"
#include "core/support/system.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

/// An option with a value, in a sentence.
std::string quote_if_split(const std::string& text) {
  return text.find(' ') == std::string::npos ? text : quote(text);
}

bool contains(const std::vector<std::string>& texts, std::string_view text) {
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}

std::string suggest(std::string_view name, const std::vector<std::string>& known) {
  const std::vector<std::string_view> names(known.begin(), known.end());
  return did_you_mean(nearest(name, names));
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size(); begin += parts.back().size() + 1) {
    parts.push_back(text.substr(begin, text.find(separator, begin) - begin));
  }
  return parts;
}

std::string join_with_or(const std::vector<std::string>& words) {
  std::vector<std::string> quoted;
  quoted.reserve(words.size());
  for (const std::string& word : words) quoted.push_back(quote_if_split(word));
  return list_with_or(quoted);
}

Values pair_of_words(const std::string& placeholder, std::string expected,
                     const std::string& example) {
  Values values;
  values.placeholder = placeholder;
  values.expected = std::move(expected);
  values.check = [placeholder, example](const std::string& text) -> std::string {
    const std::size_t equals = text.find('=');
    if (equals != 0 && equals != std::string::npos && equals + 1 < text.size()) return {};
    return fmt::format("expected {}, such as {}, found {}", placeholder, example, quote(text));
  };
  return values;
}

Values old_and_new_name() {
  return pair_of_words("OLD=NEW", "the names of a task, behavior or variable in both catalogs",
                       "LAND=DESCEND");
}

Values name_of(std::string placeholder, ValueKind kind) {
  // In the order of the enumerators.
  static constexpr std::array<const char*, 8> expected = {"a value",
                                                          "a catalog",
                                                          "a script",
                                                          "a catalog or a script",
                                                          "the result of a shard",
                                                          "a file",
                                                          "a task",
                                                          "a task or a behavior"};
  Values values;
  values.placeholder = std::move(placeholder);
  values.expected = expected.at(static_cast<std::size_t>(kind));
  values.kind = kind;
  return values;
}

Values input(std::string placeholder, ValueKind kind) {
  Values values = name_of(std::move(placeholder), kind);
  values.is_input = true;
  return values;
}

Values output(std::string placeholder) {
  Values values = name_of(std::move(placeholder), ValueKind::file);
  values.is_output = true;
  values.check = [](const std::string& text) {
    return std::string(text.empty() ? "expected the name of a file" : "");
  };
  return values;
}

Values further_output(std::string placeholder) {
  Values values = output(std::move(placeholder));
  values.check = [is_name = values.check](const std::string& text) {
    return text == "-" ? "expected a file, as standard output has the report" : is_name(text);
  };
  return values;
}

Values folder() {
  Values values = name_of("DIR", ValueKind::file);
  values.expected = "a folder";
  values.check = [](const std::string& text) {
    return std::string(text.empty() || text == "-" ? "expected the name of a folder" : "");
  };
  return values;
}

Values one_of(std::string placeholder, std::vector<std::string> choices) {
  Values values;
  values.placeholder = std::move(placeholder);
  values.expected = "a value: " + join_with_or(choices);
  values.check = [choices](const std::string& text) -> std::string {
    if (contains(choices, text)) return {};
    return fmt::format("expected {}, found {}{}", join_with_or(choices), quote(text),
                       suggest(text, choices));
  };
  values.choices = std::move(choices);
  return values;
}

Values whole_number(std::string placeholder, std::int64_t least, std::int64_t most) {
  Values values;
  values.placeholder = std::move(placeholder);
  values.expected = "a number";
  values.check = [least, most](const std::string& text) -> std::string {
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
      return fmt::format("expected a whole number of at least {}, found {}", least, quote(text));
    }
    return fmt::format("expected a whole number from {} to {}, found {}", least, most, quote(text));
  };
  return values;
}

Values seconds(Microseconds least) {
  Values values;
  values.placeholder = "SECONDS";
  values.expected = "a time in seconds";
  values.check = [least](const std::string& text) -> std::string {
    const Decimal time = parse_seconds(text);
    if (time.error == DecimalError::no_error && time.value >= least) return {};
    return fmt::format("expected seconds, from {} to 1000000000, found {}",
                       format_decimal(least, 6), quote(text));
  };
  return values;
}

namespace {

Decimal parse_percent(const std::string& text) { return parse_decimal(text, 1, 0, 1000); }

}  // namespace

Values percent() {
  Values values;
  values.placeholder = "PERCENT";
  values.expected = "a number from 0 to 100";
  values.check = [](const std::string& text) -> std::string {
    if (parse_percent(text).error == DecimalError::no_error) return {};
    return fmt::format("expected a number from 0 to 100, with at most one decimal, found {}",
                       quote(text));
  };
  return values;
}

std::uint64_t tenths_in(const std::string& percent) {
  return static_cast<std::uint64_t>(parse_percent(percent).value);
}

std::string describe_percent(const std::string& percent) {
  return format_decimal(parse_percent(percent).value, 1) + " %";
}

Option& Option::required() {
  is_required = true;
  return *this;
}

Option& Option::value_or(std::string value) {
  missing_value = std::move(value);
  return *this;
}

Option& Option::separated_by(char character) {
  separator = character;
  return *this;
}

Option& Option::makes_arguments(ValueKind kind) {
  values.kind = kind;
  return *this;
}

Option& Option::not_with(std::vector<std::string> others, std::string reason) {
  exclusions.push_back({std::move(others), std::move(reason)});
  return *this;
}

Option& Option::only_with(std::vector<std::string> others) {
  requirements.push_back(std::move(others));
  return *this;
}

Option& Option::only_with_values(std::string other, std::vector<std::string> accepted) {
  accepted_values.push_back({std::move(other), std::move(accepted)});
  return *this;
}

Command::Command(std::string name, std::string description, HelpText text)
    : name_(std::move(name)), description_(std::move(description)), text_(std::move(text)) {
  flag("-h,--help", "Print this help and exit");
}

Option& Command::flag(const char* names, std::string help) {
  Option& added = add(names, {}, std::move(help));
  added.is_flag = true;
  return added;
}

Option& Command::format_option(std::string& target, const std::vector<std::string>& formats) {
  return option("--format", target, one_of("FORMAT", formats),
                fmt::format("{} (default: {})", join_with_or(formats), formats.front()));
}

Option& Command::flag(const char* names, bool& target, std::string help) {
  Option& added = flag(names, std::move(help));
  added.store = [&target](const std::string&) { target = true; };
  return added;
}

void Command::add_confinement() {
  Values folder;
  folder.placeholder = "DIR";
  folder.expected = "a folder";
  folder.kind = ValueKind::file;
  folder.check = [](const std::string& value) -> std::string {
    return is_folder(value) ? "" : fmt::format("there is no folder {}", quote(value));
  };
  Option& added =
      add("--confine", std::move(folder), "Read no file outside DIR, whatever files name");
  added.store = [](const std::string& value) { confine_reading(value); };
}

Option& Command::add(std::string_view names, Values values, std::string help) {
  Option& added = options_.emplace_back();
  for (const std::string_view name : split(names, ',')) added.names.emplace_back(name);
  added.values = std::move(values);
  added.help = std::move(help);
  added.group = group_;
  return added;
}

const Option* Command::find(std::string_view name) const {
  const auto found = std::find_if(options_.begin(), options_.end(), [&](const Option& option) {
    return contains(option.names, name);
  });
  return found == options_.end() ? nullptr : &*found;
}

Program::Program(std::string description, std::string version, std::string called_as, HelpText text)
    : itself_({}, std::move(description), std::move(text)),
      version_(std::move(version)),
      called_as_(std::move(called_as)) {
  itself_.flag("-V,--version", "Print the version and exit");
}

Command& Program::add_command(std::string name, std::string description, HelpText text) {
  return commands_.emplace_back(std::move(name), std::move(description), std::move(text));
}

const Command* Program::find(std::string_view name) const {
  const auto found = std::find_if(commands_.begin(), commands_.end(),
                                  [&](const Command& command) { return command.name() == name; });
  return found == commands_.end() ? nullptr : &*found;
}

namespace {

// Parsing -----------------------------------------------------------------------------------------

// CLI11 takes the arguments apart, and accepts them all: whether they are right is looked at here,
// where the messages are.

using Given = std::map<const Option*, std::vector<std::string>>;

/// A command line, taken apart.
struct Parsed {
  const Command* command = nullptr;          ///< null: none is given
  Given given;                               ///< what was given has at least one value
  std::vector<std::string> left_of_program;  ///< that nothing could take; with "--"
  std::vector<std::string> left_of_command;
  const Option* unfinished = nullptr;  ///< the line ends where its value should be
};

void declare(CLI::App& app, const Command& command,
             std::map<const Option*, CLI::Option*>& declared) {
  constexpr int any_number = 1 << 24;
  app.set_help_flag();  // it has one like all others
  app.allow_extras();
  for (const Option& option : command.options()) {
    const std::string names = join(option.names, ",");
    CLI::Option* const added = option.is_flag ? app.add_flag(names) : app.add_option(names);
    if (!option.is_flag) {
      added->expected(option.is_argument && option.is_repeatable ? any_number : 1);
      if (!option.missing_value.empty()) added->expected(0, 1);
      added->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }
    declared[&option] = added;
  }
}

Parsed parse(const Program& program, const std::vector<std::string>& arguments) {
  CLI::App app;
  app.require_subcommand(0, 1);
  std::map<const Option*, CLI::Option*> declared;
  declare(app, program.itself(), declared);
  for (const Command& command : program.commands()) {
    declare(*app.add_subcommand(command.name()), command, declared);
  }
  Parsed parsed;
  bool is_unfinished = false;
  try {
    // CLI11 wants them backwards.
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ArgumentMismatch&) {
    is_unfinished = true;  // as nothing else is expected in a certain number
  }
  parsed.left_of_program = app.remaining();
  if (!app.get_subcommands().empty()) {
    const CLI::App& used = *app.get_subcommands().front();
    parsed.command = program.find(used.get_name());
    parsed.left_of_command = used.remaining();
  }
  for (const auto& [option, as_declared] : declared) {
    if (as_declared->count() == 0) continue;
    const CLI::results_t& values = as_declared->results();
    std::vector<std::string>& given = parsed.given[option];
    if (option->separator == '\0') given = values;
    if (!option->missing_value.empty()) {
      std::replace(given.begin(), given.end(), std::string(), option->missing_value);
    }
    for (const std::string& list : values) {
      if (option->separator == '\0') break;
      for (const std::string_view item : split(list, option->separator)) {
        if (!item.empty()) given.emplace_back(item);
      }
    }
    if (!option->is_argument || !option->values.is_input) continue;
    for (std::string& path : given) {
      // It came after "--"; messages name it in a way that needs none.
      if (path.size() > 1 && path.front() == '-') path.insert(0, "./");
    }
  }
  if (is_unfinished && parsed.command != nullptr) {
    const std::string& last = arguments.back();
    parsed.unfinished = parsed.command->find(last);
    // Short options may stand together.
    if (parsed.unfinished == nullptr)
      parsed.unfinished = parsed.command->find(std::string{'-', last.back()});
  }
  return parsed;
}

// Complaints --------------------------------------------------------------------------------------

/// About a first argument that is no command; empty if it is one, or an option.
std::string find_unknown_command(const Program& program, const std::string& argument) {
  if (argument.starts_with('-') || program.find(argument) != nullptr) return {};
  return describe_unknown_command(program, argument);
}

/// About an equals sign: behind a flag; behind a short option, whose value it would begin; or with
/// no value behind it, where CLI11 would take the next argument. Empty if there is none.
std::string find_bad_equals(const Command& command, const std::vector<std::string>& arguments) {
  for (std::size_t i = 1; i < arguments.size() && arguments[i] != "--"; ++i) {
    const std::string& argument = arguments[i];
    const std::string name = argument.substr(0, argument.find('='));
    const Option* const option = name.starts_with('-') ? command.find(name) : nullptr;
    if (option == nullptr) continue;
    if (name == argument) {
      if (!option->is_flag && option->missing_value.empty()) ++i;  // its value may be anything
    } else if (option->is_flag) {
      return fmt::format("{} takes no value", option->name());
    } else if (name.size() + 1 == argument.size()) {
      return fmt::format("{} needs {}", name, option->values.expected);
    } else if (!name.starts_with("--")) {
      const std::string value = argument.substr(name.size() + 1);
      return fmt::format("expected {} or {}, found {}", quote(fmt::format("{} {}", name, value)),
                         quote(fmt::format("{}={}", option->name(), value)), quote(argument));
    }
  }
  return {};
}

std::string describe_unknown_option(const Command& command, const std::string& name) {
  if (const auto moved = command.moved().find(name); moved != command.moved().end()) {
    return fmt::format("{} has moved: use {}", name, moved->second);
  }
  std::vector<std::string> names;
  for (const Option& option : command.options()) {
    if (option.name().starts_with("--")) names.push_back(option.name());
  }
  return fmt::format("unknown option {}{}", quote(name), suggest(name, names));
}

/// The name of the first of these arguments that is meant as an option; empty if none is.
std::string first_option(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument == "--") break;
    if (argument.size() > 1 && argument.front() == '-')
      return argument.substr(0, argument.find('='));
  }
  return {};
}

/// About what nothing could take; empty if all was taken.
std::string find_left_over(const Program& program, const Parsed& parsed,
                           const std::vector<std::string>& arguments) {
  const Command* const command = parsed.command;
  const auto called = command == nullptr
                          ? arguments.begin()
                          : std::find(arguments.begin(), arguments.end(), command->name());
  if (command == nullptr) {
    const std::string name = first_option(parsed.left_of_program);
    if (!name.empty()) return describe_unknown_option(program.itself(), name);
  } else if (const std::string unknown = first_option(parsed.left_of_command); !unknown.empty()) {
    return describe_unknown_option(*command, unknown);
  } else if (const std::string name = first_option({arguments.begin(), called}); !name.empty()) {
    if (command->find(name) == nullptr) return describe_unknown_option(*command, name);
    return fmt::format("{} goes after the command {}", name, quote(command->name()));
  }
  for (const auto* const left : {&parsed.left_of_command, &parsed.left_of_program}) {
    for (const std::string& argument : *left) {
      if (argument != "--") return fmt::format("unexpected argument {}", quote(argument));
    }
  }
  return {};
}

/// A file that an option names.
struct NamedFile {
  const Option* option = nullptr;
  std::string path;
};

/// About files that are read or written; empty if all go together.
std::string find_bad_file(const std::vector<NamedFile>& inputs,
                          const std::vector<NamedFile>& outputs) {
  const auto is_standard = [](const NamedFile& file) { return file.path == "-"; };
  if (std::count_if(inputs.begin(), inputs.end(), is_standard) > 1) {
    return "standard input can be read only once, but is given several times";
  }
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    const auto is_lost = [&](const NamedFile& input) {
      const bool may_be =
          !is_standard(input) && input.option->values.replaced_by == output->option->name();
      return !may_be && is_same_file(input.path, output->path);
    };
    if (std::any_of(inputs.begin(), inputs.end(), is_lost)) {
      return fmt::format("the output {} is also an input", quote(output->path));
    }
    const auto is_again = [&](const NamedFile& other) {
      return other.path == output->path ||
             (!is_standard(other) && !is_standard(*output) &&
              target_of(other.path) == target_of(output->path)) ||
             is_same_file(other.path, output->path);
    };
    if (std::any_of(outputs.begin(), output, is_again)) {
      return fmt::format("{} would be written twice", quote(output->path));
    }
  }
  return {};
}

/// About the values that were given; empty if all are right.
std::string find_bad_value(const Command& command, const Given& given) {
  std::vector<NamedFile> inputs;
  std::vector<NamedFile> outputs;
  for (const Option& option : command.options()) {
    const auto found = given.find(&option);
    if (found == given.end()) continue;
    const std::vector<std::string>& values = found->second;
    if (values.size() > 1 && !option.is_repeatable && !option.is_flag) {
      return option.name() + " is given more than once";
    }
    for (const std::string& value : values) {
      const std::string fault = option.values.check ? option.values.check(value) : std::string();
      if (!fault.empty()) return fmt::format("{}: {}", option.name(), fault);
      if (option.values.is_input) inputs.push_back({&option, value});
      if (option.values.is_output) outputs.push_back({&option, value});
    }
  }
  return find_bad_file(inputs, outputs);
}

/// Whether an option is given, as `others` of an Option name it.
bool is_given(const Command& command, const Given& given, const std::string& other) {
  const std::size_t blank = other.find(' ');
  const auto found = given.find(command.find(other.substr(0, blank)));
  return found != given.end() &&
         (blank == std::string::npos || contains(found->second, other.substr(blank + 1)));
}

/// About an option that does not go with the others; empty if it does.
std::string find_clash(const Option& option, const Command& command, const Given& given) {
  const auto is_there = [&](const std::string& other) { return is_given(command, given, other); };
  for (const auto& [others, reason] : option.exclusions) {
    const auto other = std::find_if(others.begin(), others.end(), is_there);
    if (other == others.end()) continue;
    if (reason.empty())
      return fmt::format("{} and {} cannot be used together", option.name(),
                         quote_if_split(*other));
    return fmt::format("{} cannot be used with {}: {}", option.name(), quote_if_split(*other),
                       reason);
  }
  for (const std::vector<std::string>& others : option.requirements) {
    if (std::any_of(others.begin(), others.end(), is_there)) continue;
    return fmt::format("{} can only be used with {}", option.name(), join_with_or(others));
  }
  for (const auto& [other, accepted] : option.accepted_values) {
    const auto found = given.find(command.find(other));
    if (found == given.end() || contains(accepted, found->second.front())) continue;
    return fmt::format("{} can only be used with {} {}, not {}", option.name(), other,
                       join_with_or(accepted), found->second.front());
  }
  return {};
}

/// About what was given to a command, or is missing; empty if all is well.
std::string find_misuse(const Command& command, const Given& given) {
  if (std::string fault = find_bad_value(command, given); !fault.empty()) return fault;
  for (const Option& option : command.options()) {
    if (given.contains(&option)) {
      if (std::string clash = find_clash(option, command, given); !clash.empty()) return clash;
    } else if (option.is_required) {
      return "expected " + option.values.expected;
    }
  }
  return {};
}

}  // namespace

std::string describe_unknown_command(const Program& program, const std::string& name) {
  if (name == "version") {  // a command of many other programs
    return fmt::format("unknown command {}{}", quote(name), did_you_mean("--version"));
  }
  std::vector<std::string> names;
  for (const Command& command : program.commands()) names.push_back(command.name());
  return fmt::format("unknown command {}{}", quote(name), suggest(name, names));
}

int Program::run(const std::vector<std::string>& arguments) const {
  const Command* const first = arguments.empty() ? nullptr : find(arguments.front());
  if (!arguments.empty()) {
    std::string fault = first == nullptr ? find_unknown_command(*this, arguments.front())
                                         : find_bad_equals(*first, arguments);
    if (!fault.empty()) return usage_error(first == nullptr ? "" : first->name(), fault);
  }
  const Parsed parsed = parse(*this, arguments);
  const Command& used = parsed.command == nullptr ? itself_ : *parsed.command;
  const auto refuse = [&](const std::string& fault) { return usage_error(used.name(), fault); };
  const bool wants_help =
      is_given(itself_, parsed.given, "--help") || is_given(used, parsed.given, "--help");
  if (wants_help && parsed.unfinished == nullptr) {
    fmt::print("{}", help_of(*this, used));
    return exit_ok;
  }
  if (is_given(itself_, parsed.given, "--version")) {
    fmt::print("{}\n", version_);
    return exit_ok;
  }
  if (const std::string fault = find_left_over(*this, parsed, arguments); !fault.empty())
    return refuse(fault);
  if (parsed.command == nullptr) {
    fmt::print(stderr, "{}", usage_of(*this));
    return refuse("expected a command");
  }
  if (parsed.unfinished != nullptr) {
    return refuse(
        fmt::format("{} needs {}", parsed.unfinished->name(), parsed.unfinished->values.expected));
  }
  if (const std::string fault = find_misuse(used, parsed.given); !fault.empty()) {
    return refuse(fault);
  }
  for (const auto& [option, values] : parsed.given) {
    for (const std::string& value : values) {
      if (option->store) option->store(value);
    }
  }
  return used.run();
}

}  // namespace cbc::cli
