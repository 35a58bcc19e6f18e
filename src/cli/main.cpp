#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cbc/version.h"
#include "cli/compile_command.h"
#include "cli/exit_status.h"
#include "cli/graph_command.h"
#include "cli/lint_command.h"
#include "cli/schema_command.h"
#include "cli/solve_command.h"
#include "cli/standard_descriptors.h"
#include "text/nearest.h"
#include "text/quote.h"

namespace {

constexpr const char* description =
    "Checks and compiles behavior catalogs, and solves them offline: which behaviors of a robot\n"
    "should be active, proven best, on every event.";

constexpr const char* program_footer =
    "Examples:\n"
    "  cbc lint quadrotor.yaml\n"
    "  cbc compile quadrotor.yaml -o quadrotor.cbc\n"
    "  cbc solve quadrotor.yaml mission.yaml\n"
    "  cbc solve quadrotor.yaml mission.yaml --format json | jq .\n"
    "  cbc graph quadrotor.yaml -o quadrotor.svg\n"
    "  cbc schema catalog > catalog.json\n"
    "\n"
    "Exit status: 0 all is well, 1 lint found an error, a compiled catalog is stale, or an\n"
    "expectation failed, 2 the input or the usage is wrong, 3 an internal error.";

std::string full_name(const CLI::App& app) {
  const CLI::App* const used = app.get_subcommands().empty() ? &app : app.get_subcommands().front();
  return used == &app ? "cbc" : "cbc " + used->get_name();
}

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

bool is_command(const CLI::App& program, const std::string& name) {
  const std::vector<std::string> names = command_names(program);
  return std::find(names.begin(), names.end(), name) != names.end();
}

void complain_of_command(const CLI::App& program, const std::string& name) {
  const std::vector<std::string> names = command_names(program);
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::optional<std::string_view> meant = cbc::nearest(name, views);
  fmt::print(stderr, "cbc: unknown command {}{}\nSee 'cbc --help'.\n", cbc::quote(name),
             meant ? fmt::format("; did you mean {}?", cbc::quote(*meant)) : "");
}

int run(int argc, char** argv) {
  using namespace cbc::cli;
  CLI::App program(description, "cbc");
  program.set_version_flag("--version", "cbc " + std::string(cbc::version));
  program.require_subcommand(1);
  program.footer(program_footer);
  int status = exit_ok;
  add_lint_command(program, status);
  add_compile_command(program, status);
  add_solve_command(program, status);
  add_graph_command(program, status);
  add_schema_command(program, status);

  program.failure_message([](const CLI::App* app, const CLI::Error& error) {
    return "cbc: " + std::string(error.what()) + "\nSee '" + full_name(*app) + " --help'.\n";
  });

  if (argc > 1 && argv[1][0] != '-' && !is_command(program, argv[1])) {
    complain_of_command(program, argv[1]);
    return exit_unusable;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::cout
        << std::unitbuf;  // help is written here, and must have arrived before the check below
    status = program.exit(error) == 0 ? exit_ok : exit_unusable;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) {
    std::fprintf(stderr, "cbc: cannot write the output\n");
    return exit_unusable;
  }
  return status;
}

/// Compiled catalogs are read where they lie in the file: this is how the system tells that it was
/// cut off meanwhile.
void end_without_file(int /*signal*/) {
  constexpr std::string_view message = "cbc: a compiled catalog was cut off while it was in use\n";
  const auto ignored = write(STDERR_FILENO, message.data(), message.size());
  static_cast<void>(ignored);
  _exit(cbc::cli::exit_unusable);
}

}  // namespace

int main(int argc, char** argv) {
  // A file that may not grow any more is an output that cannot be written, not the end.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGBUS, end_without_file);
  cbc::cli::hold_standard_descriptors();
  try {
    return run(argc, argv);
  } catch (const std::system_error& error) {
    // Of all that is called, only the printing throws it.
    std::fprintf(stderr, "cbc: cannot write the output: %s\n", error.code().message().c_str());
    return cbc::cli::exit_unusable;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "cbc: out of memory\n");
    return cbc::cli::exit_unusable;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cbc: internal error: %s\n", error.what());
    return cbc::cli::exit_internal;
  }
}
