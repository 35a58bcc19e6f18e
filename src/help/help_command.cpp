#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/output.h"

namespace cbc::cli {
namespace {

constexpr const char* help_examples =
    "  cbc help         all commands\n"
    "  cbc help lint    the same as cbc lint --help\n";

constexpr const char* help_footer =
    "Exit status: 0 the help is printed, 2 there is no such command, or the usage is wrong.\n"
    "\n"
    "Read more: man cbc";

}  // namespace

void add_help_command(Program& program) {
  const auto name = std::make_shared<std::optional<std::string>>();
  Command& command = program.add_command("help", "Prints the help of a command.",
                                         {{"[COMMAND]"}, help_examples, help_footer});
  const auto names = [&program] {
    std::vector<NameWithHelp> all;
    for (const Command& known : program.commands()) {
      all.push_back({known.name(), known.description()});
    }
    return all;
  };
  command.argument("COMMAND", *name, {"", "a command", {}, names},
                   "The command; without it, the program itself");
  command.action([name, &program] {
    const Command* const asked = *name ? program.find(**name) : &program.itself();
    if (asked == nullptr) return usage_error("", describe_unknown_command(program, **name));
    fmt::print("{}", help_of(program, *asked));
    return int{exit_ok};
  });
}

}  // namespace cbc::cli
