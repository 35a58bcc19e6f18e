#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/command_line/values.h"
#include "core/support/wording.h"

/// Declares a command line: the commands of a program, their options and arguments, which values
/// these accept, and what does not go together. Parsing, --help, the complaints about a wrong
/// command line, and completion all follow from the declarations.
namespace cbc::cli {

/// A file of the source tree that is part of the program; embed_files.cmake makes tables of them.
struct EmbeddedFile {
  std::string_view name;  ///< its path in its folder
  std::string_view text;
};

/// An option, a flag or an argument of a command. `others` below are names of options ("--script")
/// or arguments ("CATALOG"), or an option with one of its values ("--format json").
struct Option {
  std::vector<std::string> names;  ///< with their dashes; of an argument its only name
  std::string help;                ///< what it means, in a sentence without a period
  std::string default_value;       ///< what counts without it; empty: there is nothing to say
  std::string group;
  Values values;  ///< of a flag empty, but for `kind`: what the flag makes of the arguments
  bool is_flag = false;
  bool is_argument = false;
  bool is_repeatable = false;
  bool is_required = false;
  char separator = '\0';  ///< between the values of a list
  /// What stands for a value that is missing, at the end of the line or before another option;
  /// empty: it may not be missing.
  std::string missing_value;
  std::function<void(const std::string& value)> store;

  /// The longest one, which messages use.
  [[nodiscard]] const std::string& name() const { return names.back(); }
  /// Its help, with what the other members say.
  [[nodiscard]] std::string meaning() const;

  Option& required();
  /// Lets the value be missing, which is then this one.
  Option& value_or(std::string value);
  /// Says what counts without it, where the target does not.
  Option& without(std::string value);
  /// Lets several values be given at once.
  Option& separated_by(char character);
  /// Refuses it beside any of the others. The reason follows a colon; it may be empty.
  Option& not_with(std::vector<std::string> others, std::string reason = {});
  /// Refuses it unless one of the others is there, too.
  Option& only_with(std::vector<std::string> others);
  /// Refuses it beside other values of an option; the option may be missing.
  Option& only_with_values(std::string other, std::vector<std::string> accepted);

  struct Exclusion {
    std::vector<std::string> others;
    std::string reason;
  };
  struct AcceptedValues {
    std::string other;
    std::vector<std::string> values;
  };
  std::vector<Exclusion> exclusions;
  std::vector<std::vector<std::string>> requirements;
  std::vector<AcceptedValues> accepted_values;
};

/// What --help shows of a command beside its options.
struct HelpText {
  std::vector<std::string> usages;  ///< what follows the name of the command, a line each
  std::string examples;             ///< the most common ones: whole lines, indented
  /// Paragraphs, which are wrapped; lines that begin with a blank are left alone.
  std::string footer;
};

/// Sets a target to a value that its check has accepted.
inline void assign(std::string& target, const std::string& value) { target = value; }
inline void assign(std::vector<std::string>& target, const std::string& value) {
  target.push_back(value);
}
template <typename Number>
requires std::is_integral_v<Number>
void assign(Number& target, const std::string& value) {
  std::from_chars(value.data(), value.data() + value.size(), target);
}
template <typename Value>
void assign(std::optional<Value>& target, const std::string& value) {
  assign(target.emplace(), value);
}

/// What a target holds before any value is assigned; empty if that means nothing.
template <typename Target>
std::string default_of(const Target& target) {
  if constexpr (std::is_integral_v<Target>) {
    return target == 0 ? std::string() : std::to_string(target);
  } else if constexpr (std::is_same_v<Target, std::string>) {
    return target;
  } else {
    return {};
  }
}

class Command {
 public:
  Command(std::string name, std::string description, HelpText text);

  /// The targets must live as long as `action`, and begin with the default values. A vector takes
  /// all values of a repeatable option.
  template <typename Target>
  Option& option(const char* names, Target& target, Values values, std::string help) {
    Option& added = add(names, std::move(values), std::move(help));
    added.is_repeatable = std::is_same_v<Target, std::vector<std::string>>;
    added.default_value = default_of(target);
    added.store = [&target](const std::string& value) { assign(target, value); };
    return added;
  }
  /// --format, which takes one of some names; the first one becomes the default.
  Option& format_option(std::string& target, const std::vector<std::string>& formats);
  template <typename Target>
  Option& output_option(Target& target) {
    return option("-o,--output", target, output("OUT"), "The file to write")
        .without("-, standard output");
  }
  /// --jobs; `help` says what N of them do.
  Option& jobs_option(std::optional<std::uint64_t>& target, const std::string& help);
  Option& flag(const char* names, bool& target, std::string help);
  Option& flag(const char* names, std::string help);
  template <typename Target>
  Option& argument(const char* name, Target& target, Values values, std::string help) {
    Option& added = option(name, target, std::move(values), std::move(help));
    added.is_argument = true;
    return added;
  }
  /// --confine, for commands that read files.
  void add_confinement();
  /// The heading in --help of the options declared next.
  void group(std::string title) { group_ = std::move(title); }
  /// What the command does. Returns the exit status.
  void action(std::function<int()> run) { run_ = std::move(run); }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& description() const { return description_; }
  [[nodiscard]] const HelpText& text() const { return text_; }
  [[nodiscard]] const std::deque<Option>& options() const { return options_; }
  /// Null if it has none of this name.
  [[nodiscard]] const Option* find(std::string_view name) const;
  [[nodiscard]] int run() const { return run_(); }

 private:
  Option& add(std::string_view names, Values values, std::string help);

  std::string name_;
  std::string description_;
  HelpText text_;
  std::string group_ = "Options";
  std::deque<Option> options_;  ///< a deque, as references to them are handed out
  std::function<int()> run_;
};

class Program {
 public:
  /// `version`: what --version prints. `called_as`: the path or name under which the program was
  /// called, which its completion scripts complete.
  Program(std::string description, std::string version, std::string called_as, HelpText text);

  Command& add_command(std::string name, std::string description, HelpText text);

  /// Does what a command line says, or complains of it. Returns the exit status.
  [[nodiscard]] int run(const std::vector<std::string>& words) const;

  [[nodiscard]] const std::string& called_as() const { return called_as_; }
  /// With the options that need no command.
  [[nodiscard]] const Command& itself() const { return itself_; }
  /// In the order of --help.
  [[nodiscard]] const std::deque<Command>& commands() const { return commands_; }
  /// Null if there is none of this name.
  [[nodiscard]] const Command* find(std::string_view name) const;

 private:
  Command itself_;
  std::deque<Command> commands_;
  std::string version_;
  std::string called_as_;
};

/// The text that --help prints of a command, or of the program itself.
[[nodiscard]] std::string help_of(const Program& program, const Command& command);

/// What is printed where there is no command: the form of a command line, and all commands.
[[nodiscard]] std::string usage_of(const Program& program);

/// The complaint about a name that no command has.
[[nodiscard]] std::string describe_unknown_command(const Program& program, const std::string& name);

/// The first argument by which the scripts of `cbc completion` call the program.
inline constexpr const char* complete_argument = "__complete";

/// Answers such a call with the words that fit where a word is being typed.
///
/// The arguments are the shell; the part of the typed word that the shell does not replace (bash
/// replaces what follows '=' or ':', or begins with '@'); the number of the typed word; and all
/// words after the name of the program. The typed word has the quotes of the shell; for bash all
/// words do.
///
/// The first line of the answer is "words" or "files". After "words" each line has a candidate,
/// with a tab before its help; for bash, which shows no help, the candidate is quoted for
/// insertion. "files" is followed on its line by the accepted suffixes; two more lines have the
/// beginning of the path, and the part of it that the shell does not replace. Names with line
/// breaks or with characters that could harm a terminal are left out.
void reply_to_shell(const Program& program, const std::vector<std::string>& arguments);

}  // namespace cbc::cli
