#include <cstddef>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "core/words/layout.h"

// What --help prints, and the command that prints the same.
namespace cbc::cli {
namespace {

constexpr std::size_t line_width = 80;
constexpr std::size_t column = 26;  ///< where the descriptions of options and commands begin

std::string wrap_lines(std::string_view text) {
  std::string wrapped;
  for (const std::string_view line : split(text, '\n')) {
    wrapped += (line.starts_with(' ') ? std::string(line) : wrap_line(line, line_width, 0)) + '\n';
  }
  return wrapped;
}

std::string entry(const std::string& name, const std::string& text) {
  std::string above;
  std::string before = "  " + name;
  if (before.size() + 2 > column) {
    above = before + '\n';
    before.clear();
  }
  before.resize(column, ' ');
  return above + wrap_line(before + text, line_width, column) + '\n';
}

std::string entry(const Option& option) {
  const std::string& placeholder = option.values.placeholder;
  return entry(
      fmt::format("{}{}{}", join(option.names, ","), placeholder.empty() ? "" : " ", placeholder),
      option.meaning());
}

/// The command as it is called: "cbc lint", or "cbc".
std::string full_name(const Command& command) {
  return command.name().empty() ? "cbc" : "cbc " + command.name();
}

}  // namespace

std::string help_of(const Program& program, const Command& command) {
  const HelpText& text = command.text();
  std::string help = wrap_line(command.description(), line_width, 0) + "\n\n";
  for (const std::string& usage : text.usages) {
    help += fmt::format("{}{} {}\n", &usage == &text.usages.front() ? "Usage: " : "       ",
                        full_name(command), usage);
  }
  help += "\nExamples:\n" + text.examples;
  std::string group;
  const auto add = [&](const std::string& title, const std::string& line) {
    if (title != group) help += fmt::format("\n{}:\n", title);
    group = title;
    help += line;
  };
  for (const Option& option : command.options()) {
    if (option.is_argument) add("Positionals", entry(option));
  }
  for (const Option& option : command.options()) {
    if (!option.is_argument) add(option.group, entry(option));
  }
  for (const Command& subcommand : program.commands()) {
    if (&command != &program.itself()) break;
    add("Commands", entry(subcommand.name(), subcommand.description()));
  }
  return help + "\n" + wrap_lines(text.footer);
}

std::string usage_of(const Program& program) {
  std::string text = "Usage: cbc " + program.itself().text().usages.front() + "\n\nCommands:\n";
  for (const Command& command : program.commands()) {
    text += entry(command.name(), command.description());
  }
  return text + "\n";
}

}  // namespace cbc::cli
