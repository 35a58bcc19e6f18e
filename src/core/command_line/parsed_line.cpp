#include "core/command_line/parsed_line.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/core.h>

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

class Parser {
 public:
  explicit Parser(const Program& program) : program_(program) {}

  void take(const std::string& word) {
    if (line_.has_unknown_command) return;  // which options it has is unknown, too
    const Option* const before = std::exchange(line_.pending, nullptr);
    if (is_value_of(before, word)) return give(*before, word);
    if (before != nullptr) give(*before, before->missing_value);
    if (line_.has_separator || !is_option(word)) {
      line_.command == nullptr ? take_command(word) : take_argument(word);
    } else if (word == "--") {
      line_.has_separator = true;
    } else {
      take_option(word);
    }
  }

  ParsedLine finish() {
    const Option* const last = line_.pending;
    if (last != nullptr && !last->missing_value.empty()) give(*last, last->missing_value);
    return std::move(line_);
  }

 private:
  [[nodiscard]] const Command& command() const {
    return line_.command == nullptr ? program_.itself() : *line_.command;
  }

  void complain_of(std::string fault) {
    if (line_.fault.empty()) line_.fault = std::move(fault);
  }

  void give(const Option& option, const std::string& value) {
    std::vector<std::string>& values = line_.given[&option];
    if (option.separator == '\0') return values.push_back(value);
    for (const std::string_view item : split(value, option.separator)) {
      if (!item.empty()) values.emplace_back(item);
    }
  }

  void take_command(const std::string& word) {
    line_.command = program_.find(word);
    line_.has_unknown_command = line_.command == nullptr;
    if (line_.has_unknown_command) complain_of(describe_unknown_command(program_, word));
  }

  void take_argument(const std::string& word) {
    const Option* const argument = next_argument(command(), line_.arguments.size());
    line_.arguments.push_back(word);
    if (argument == nullptr) {
      return complain_of(fmt::format("unexpected argument {}", quote(word)));
    }
    // It came after "--"; messages name it in a way that needs none.
    const bool is_like_option = argument->values.is_input && is_option(word);
    give(*argument, is_like_option ? "./" + word : word);
  }

  /// "--name", "--name=value", "-n" or "-nvalue".
  void take_option(const std::string& word) {
    const bool is_long = word[1] == '-';
    const std::string name = word.substr(0, is_long ? word.find('=') : 2);
    const std::string value = word.substr(name.size());
    const Option* const option = command().find(name);
    if (option == nullptr) {
      complain_of(describe_unknown_option(program_, line_.command, word.substr(0, word.find('='))));
    } else if (value.empty()) {
      option->is_flag ? give(*option, {}) : static_cast<void>(line_.pending = option);
    } else if (option->is_flag) {
      complain_of(option->name() + " takes no value");
    } else if (value == "=") {
      complain_of(needs_value(*option, name));
    } else if (!is_long && value.starts_with('=')) {
      complain_of(fmt::format("expected {} or {}, found {}", quote(name + " " + value.substr(1)),
                              quote(option->name() + value), quote(word)));
    } else {
      give(*option, is_long ? value.substr(1) : value);
    }
  }

  const Program& program_;
  ParsedLine line_;
};

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
  Parser parser(program);
  for (const std::string& word : words) parser.take(word);
  return parser.finish();
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
