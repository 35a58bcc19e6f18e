#include "cli/commands.h"

namespace cbc::cli {

std::vector<CLI::App*> commands_of(CLI::App& program) {
  return program.get_subcommands([](const CLI::App*) { return true; });
}

CLI::App* find_command(CLI::App& program, const std::string& name) {
  for (CLI::App* command : commands_of(program)) {
    if (command->get_name() == name) return command;
  }
  return nullptr;
}

}  // namespace cbc::cli
