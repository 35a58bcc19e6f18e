#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include <CLI/CLI.hpp>

#include "cbc/version.h"
#include "cli/exit_status.h"
#include "cli/solve_command.h"

namespace {

constexpr const char* description =
    "Checks, compiles and solves behavior catalogs: which behaviors of a robot should be active,\n"
    "proven best, on every event.";

constexpr const char* footer =
    "Examples:\n"
    "  cbc solve quadrotor.yaml mission.yaml\n"
    "  cbc solve quadrotor.yaml mission.yaml --format json | jq .\n"
    "\n"
    "Exit status: 0 all is well, 1 an expectation failed, 2 the input or the usage is wrong,\n"
    "3 an internal error.";

int run(int argc, char** argv) {
  using namespace cbc::cli;
  CLI::App program(description, "cbc");
  program.set_version_flag("--version", "cbc " + std::string(cbc::version));
  program.require_subcommand(1);
  program.footer(footer);
  int status = exit_ok;
  add_solve_command(program, status);

  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? exit_ok : exit_unusable;
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::fprintf(stderr, "cbc: cannot write the output\n");
    return exit_unusable;
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "cbc: out of memory\n");
    return cbc::cli::exit_unusable;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cbc: internal error: %s\n", error.what());
    return cbc::cli::exit_internal;
  }
}
