#include "core/command_line/parsed_line.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

/// About an option that is unknown where it stands; `command` is null before there is one.
std::string describe_unknown_option(const Program& program, const Command* command,
                                    const std::string& name) {
  std::vector<std::string> owners;
  for (const Command& other : program.commands()) {
    if (other.find(name) != nullptr) owners.push_back(quote("cbc " + other.name()));
  }
  if (command == nullptr && !owners.empty()) return name + " goes after the command";
  std::vector<std::string> names;
  for (const Option& option : (command == nullptr ? program.itself() : *command).options()) {
    if (!option.is_argument) names.push_back(option.name());
  }
  std::string hint = suggest(name, names);
  if (owners.size() == 1 || owners.size() == 2) {
    hint = fmt::format("; {} {} it", list_with_and(owners), owners.size() == 1 ? "has" : "have");
  }
  return fmt::format("unknown option {}{}", quote(name), hint);
}

/// The declarations as CLI11 knows them. It accepts all words, also of a line that is wrong or
/// unfinished: the words that it cannot place are left over.
class Splitter {
 public:
  /// For lines of these words. Options of commands that they do not name are left out.
  Splitter(const Program& program, const std::vector<std::string>& words) {
    app_.require_subcommand(0, 1);
    declare(program.itself(), app_);
    for (const Command& command : program.commands()) {
      CLI::App& app = *app_.add_subcommand(command.name());
      if (std::find(words.begin(), words.end(), command.name()) != words.end()) {
        declare(command, app);
      }
    }
  }

  /// Returns whether the last word lacks its value.
  bool split(const std::vector<std::string>& words) {
    try {
      app_.parse(
          std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 wants them backwards
    } catch (const CLI::ArgumentMismatch&) {
      return true;
    }
    return false;
  }

  [[nodiscard]] const CLI::App& find(const Command& command) const {
    return command.name().empty() ? app_ : *app_.get_subcommand(command.name());
  }
  [[nodiscard]] const CLI::Option& find(const Option& option) const {
    return *options_.at(&option);
  }

 private:
  void declare(const Command& command, CLI::App& app) {
    app.set_help_flag();
    app.allow_extras();
    for (const Option& option : command.options()) {
      // CLI11 takes no blanks in the names of arguments, and never shows them here.
      const std::string names = option.is_argument
                                    ? fmt::format("ARGUMENT{}", options_.size())
                                    : fmt::format("{}", fmt::join(option.names, ","));
      CLI::Option* const added = option.is_flag ? app.add_flag(names) : app.add_option(names);
      added->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
      if (option.is_argument && option.is_repeatable) added->expected(-1);
      if (!option.missing_value.empty()) added->expected(0, 1)->default_str(option.missing_value);
      options_[&option] = added;
    }
  }

  CLI::App app_;
  std::map<const Option*, CLI::Option*> options_;
};

/// Whether the next word is its value, whatever it looks like.
bool takes_next(const Option* option) {
  return option != nullptr && !option->is_flag && option->missing_value.empty();
}

/// About words that CLI11 would take in another way than they are meant; empty if there are none.
std::string find_bad_form(const Command& command, const std::vector<std::string>& words) {
  bool is_value = false;
  for (const std::string& word : words) {
    if (std::exchange(is_value, !is_value && takes_next(command.find(word)))) continue;
    const bool is_long = word.starts_with("--");
    const std::size_t equals = word.find('=');
    if (!is_option(word) || equals == std::string::npos) continue;
    const std::string name = word.substr(0, equals);
    const Option* const option = command.find(name);
    if (option == nullptr) continue;
    if (option->is_flag) return option->name() + " takes no value";
    if (equals + 1 == word.size()) return needs_value(*option, name);
    if (is_long) continue;
    return fmt::format("expected {} or {}, found {}", quote(name + " " + word.substr(equals + 1)),
                       quote(option->name() + word.substr(equals)), quote(word));
  }
  return {};
}

/// The values of an option, as they count.
std::vector<std::string> values_of(const Option& option, const std::vector<std::string>& results) {
  std::vector<std::string> values;
  for (const std::string& result : results) {
    if (option.is_flag) {
      if (result == "true") values.emplace_back();  // as CLI11 has it without a value
    } else if (option.separator == '\0') {
      values.push_back(result);
    } else {
      for (const std::string_view item : split(result, option.separator)) {
        if (!item.empty()) values.emplace_back(item);
      }
    }
  }
  return values;
}

/// The option at the end of a line whose value may follow; null if there is none.
const Option* find_pending(const Command& command, const std::vector<std::string>& words,
                           bool lacks_value) {
  const auto option_at_end = [&](std::size_t place) {
    return words.size() < place ? nullptr : command.find(words[words.size() - place]);
  };
  const Option* const last = option_at_end(1);
  if (last == nullptr || last->is_flag) return nullptr;
  if (lacks_value) return last;
  return takes_next(option_at_end(2)) || takes_next(last) ? nullptr : last;
}

std::string unexpected_argument(const std::string& word) {
  return fmt::format("unexpected argument {}", quote(word));
}

/// What CLI11 has left over of the words of the program or of a command.
void take_rest(const Program& program, const CLI::App& app, ParsedLine& line) {
  for (const std::string& word : app.remaining()) {
    std::string fault;
    if (is_option(word)) {
      fault = describe_unknown_option(program, line.command, word.substr(0, word.find('=')));
    } else if (line.command == nullptr) {
      line.has_unknown_command = true;
      fault = describe_unknown_command(program, word);
    } else {
      line.arguments.push_back(word);
      fault = unexpected_argument(word);
    }
    if (line.fault.empty()) line.fault = fault;
  }
}

/// What follows "--".
void take_argument(const Command& command, const std::string& word, ParsedLine& line) {
  const Option* const argument = next_argument(command, line.arguments.size());
  line.arguments.push_back(word);
  if (argument != nullptr) {
    // Messages name a file in a way that needs no "--".
    const bool is_like_option = argument->values.is_input && is_option(word);
    line.given[argument].push_back(is_like_option ? "./" + word : word);
  } else if (line.fault.empty()) {
    line.fault = unexpected_argument(word);
  }
}

}  // namespace

std::string needs_value(const Option& option, const std::string& name) {
  return fmt::format("{} needs {}", name, option.values.expected);
}

bool ParsedLine::has(const Command& of, const std::string& other) const {
  const std::size_t blank = other.find(' ');
  const auto found = given.find(of.find(other.substr(0, blank)));
  if (found == given.end()) return false;
  const std::vector<std::string>& values = found->second;
  return blank == std::string::npos ||
         std::find(values.begin(), values.end(), other.substr(blank + 1)) != values.end();
}

ParsedLine parse(const Program& program, const std::vector<std::string>& words) {
  const auto separator = std::find(words.begin(), words.end(), "--");
  const std::vector<std::string> before(words.begin(), separator);
  Splitter splitter(program, before);
  const bool lacks_value = splitter.split(before);
  ParsedLine line;
  line.has_separator = separator != words.end();
  take_rest(program, splitter.find(program.itself()), line);
  if (line.has_unknown_command) return line;  // which options it has is unknown, too
  for (const Command& command : program.commands()) {
    if (splitter.find(command).parsed()) line.command = &command;
  }
  const Command& command = line.command == nullptr ? program.itself() : *line.command;
  for (const Option& option : command.options()) {
    const std::vector<std::string>& results = splitter.find(option).results();
    std::vector<std::string> values = values_of(option, results);
    if (!values.empty()) line.given[&option] = std::move(values);
    if (option.is_argument) {
      line.arguments.insert(line.arguments.end(), results.begin(), results.end());
    }
  }
  if (line.command != nullptr) take_rest(program, splitter.find(command), line);
  if (std::string fault = find_bad_form(command, before); !fault.empty()) line.fault = fault;
  line.pending = find_pending(command, before, lacks_value);
  if (line.has_separator) {
    std::for_each(std::next(separator), words.end(),
                  [&](const std::string& word) { take_argument(command, word, line); });
  }
  return line;
}

bool is_option(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

bool is_value_of(const Option* option, const std::string& word) {
  return option != nullptr && (option->missing_value.empty() || !is_option(word));
}

const Option* next_argument(const Command& command, std::size_t given) {
  for (const Option& option : command.options()) {
    if (option.is_argument && (option.is_repeatable || given-- == 0)) return &option;
  }
  return nullptr;
}

}  // namespace cbc::cli
