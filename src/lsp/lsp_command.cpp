#include <cstdio>
#include <unistd.h>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "lsp/server.h"

namespace cbc::cli {
namespace {

constexpr const char* lsp_examples =
    "  cbc lsp     started by an editor, which talks to it on its input and output\n";

constexpr const char* lsp_footer =
    "An editor shows the findings of 'cbc lint' while you type, completes and explains names and "
    "keys, goes to definitions, renames, and shows what each event of a mission does.\n"
    "\n"
    "Exit status: 0 the editor has ended it, 1 the editor is gone, 2 the usage is wrong.\n"
    "\n"
    "Read more: man cbc-lsp, docs/editors.md (how to set up an editor)";

int serve() {
  if (::isatty(STDIN_FILENO) != 0) {
    return usage_error("lsp", "an editor starts this command; there is nothing to type here");
  }
  lsp::Server server(stdout);
  return server.run(STDIN_FILENO);
}

}  // namespace

void add_lsp_command(Program& program) {
  Command& command = program.add_command("lsp", "Serves editors by the Language Server Protocol.",
                                         {{"[OPTION...]"}, lsp_examples, lsp_footer});
  command.add_confinement();
  command.action([] { return serve(); });
}

}  // namespace cbc::cli
