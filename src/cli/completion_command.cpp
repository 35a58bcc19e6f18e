#include "cli/completion_command.h"

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/completion_scripts.h"
#include "cli/exit_status.h"
#include "cli/help_format.h"
#include "cli/value_kind.h"

namespace cbc::cli {
namespace {

constexpr const char* completion_examples =
    "  source <(cbc completion bash)             try it in this bash\n"
    "  cbc completion zsh > ~/.zfunc/_cbc        install it for zsh\n"
    "  cbc completion fish | source              try it in this fish\n";

constexpr const char* completion_footer =
    "To install it for yourself:\n"
    "  bash (with the package bash-completion), one of\n"
    "    mkdir -p ~/.local/share/bash-completion/completions\n"
    "    cbc completion bash > ~/.local/share/bash-completion/completions/cbc\n"
    "    echo 'source <(cbc completion bash)' >> ~/.bashrc    without that package\n"
    "  zsh, with 'fpath+=(~/.zfunc)' before 'compinit' in ~/.zshrc\n"
    "    mkdir -p ~/.zfunc\n"
    "    cbc completion zsh > ~/.zfunc/_cbc\n"
    "  fish\n"
    "    mkdir -p ~/.config/fish/completions\n"
    "    cbc completion fish > ~/.config/fish/completions/cbc.fish\n"
    "\n"
    "The script asks cbc itself what can follow: commands, options and their values, files, "
    "rules, schemas, and the tasks and behaviors of the catalog on the line.\n"
    "\n"
    "Exit status: 0 the script is printed, 2 the usage is wrong.\n"
    "\n"
    "Read more: man cbc";

}  // namespace

void add_completion_command(CLI::App& program, std::string_view called_as, int& status) {
  const auto shell = std::make_shared<std::string>();
  CLI::App* const command = program.add_subcommand(
      "completion", "Prints a script that completes command lines of cbc in a shell.");
  set_help(*command, {{"bash|zsh|fish"}, completion_examples, completion_footer});
  command->add_option("SHELL", *shell, "The shell: bash, zsh or fish")
      ->option_text(" ")
      ->required()
      ->check(one_of({"bash", "zsh", "fish"}));
  command->callback([shell, name = name_to_complete(called_as), &status] {
    fmt::print("{}", completion_script(*shell, name));
    status = exit_ok;
  });
}

}  // namespace cbc::cli
