#include "core/command_line/command_line.h"

#include <algorithm>

#include <fmt/core.h>

#include "core/command_line/parsed_line.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {

Option& Option::required() {
  is_required = true;
  return *this;
}

Option& Option::value_or(std::string value) {
  missing_value = std::move(value);
  return *this;
}

Option& Option::without(std::string value) {
  default_value = std::move(value);
  return *this;
}

Option& Option::separated_by(char character) {
  separator = character;
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

std::string Option::meaning() const {
  std::string text = help;
  if (is_repeatable && !is_argument && separator == '\0') text += "; repeatable";
  return default_value.empty() ? text : fmt::format("{} (default: {})", text, default_value);
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
  target = formats.front();
  return option("--format", target, one_of("FORMAT", formats), join_with_or(formats));
}

Option& Command::jobs_option(std::optional<std::uint64_t>& target, const std::string& help) {
  return option("-j,--jobs", target, whole_number("N", 1), help).without("all processors");
}

Option& Command::flag(const char* names, bool& target, std::string help) {
  Option& added = flag(names, std::move(help));
  added.store = [&target](const std::string&) { target = true; };
  return added;
}

void Command::add_confinement() {
  Option& added =
      add("--confine", existing_folder(), "Read no file outside DIR, whatever files name");
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
    return std::find(option.names.begin(), option.names.end(), name) != option.names.end();
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

std::string describe_unknown_command(const Program& program, const std::string& name) {
  if (name == "version") {  // a command of many other programs
    return fmt::format("unknown command {}{}", quote(name), did_you_mean("--version"));
  }
  std::vector<std::string> names;
  for (const Command& command : program.commands()) names.push_back(command.name());
  return fmt::format("unknown command {}{}", quote(name), suggest(name, names));
}

int Program::run(const std::vector<std::string>& words) const {
  const ParsedLine line = parse(*this, words);
  const Command& used = line.command == nullptr ? itself_ : *line.command;
  const auto refuse = [&](const std::string& fault) { return usage_error(used.name(), fault); };
  if (line.has(itself_, "--help") || line.has(used, "--help")) {
    fmt::print("{}", help_of(*this, used));
    return exit_ok;
  }
  if (line.has(itself_, "--version")) {
    fmt::print("{}\n", version_);
    return exit_ok;
  }
  if (!line.fault.empty()) return refuse(line.fault);
  if (line.command == nullptr) {
    fmt::print(stderr, "{}", usage_of(*this));
    return refuse("expected a command");
  }
  if (line.pending != nullptr && line.pending->missing_value.empty()) {
    return refuse(needs_value(*line.pending, line.pending->name()));
  }
  if (const std::string fault = find_misuse(used, line); !fault.empty()) return refuse(fault);
  for (const auto& [option, values] : line.given) {
    for (const std::string& value : values) {
      if (option->store) option->store(value);
    }
  }
  return used.run();
}

}  // namespace cbc::cli
