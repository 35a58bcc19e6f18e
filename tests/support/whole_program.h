#pragma once

#include "commands.h"
#include "core/command_line/command_line.h"

namespace cbc::test {

/// The command lines of all commands, declared as main() does it.
struct WholeProgram : cli::Program {
  WholeProgram() : Program("The program.", "cbc", "cbc", {{"COMMAND"}, "", ""}) {
    using namespace cli;
#define CBC_ADD(name) add_##name##_command(*this);
    CBC_COMMANDS(CBC_ADD)
#undef CBC_ADD
  }
};

}  // namespace cbc::test
