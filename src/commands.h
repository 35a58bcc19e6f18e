#pragma once

#include "core/command_line/command_line.h"

/// The commands of the program, in the order of --help. Each is a folder of this name in src/,
/// which defines add_NAME_command; without the folder and its row here the program lacks the
/// command.
// clang-format off
#define CBC_COMMANDS(row) \
  row(init) \
  row(lint) \
  row(compile) \
  row(solve) \
  row(verify) \
  row(coverage) \
  row(sweep) \
  row(tune) \
  row(graph) \
  row(rename) \
  row(play) \
  row(lsp) \
  row(schema) \
  row(help) \
  row(completion)
// clang-format on

namespace cbc::cli {

/// `program` must outlive the actions of its commands.
#define CBC_DECLARE(name) void add_##name##_command(Program& program);
CBC_COMMANDS(CBC_DECLARE)
#undef CBC_DECLARE

}  // namespace cbc::cli
