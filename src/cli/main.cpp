#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <vector>

#include "cbc/version.h"
#include "cli/command_line.h"
#include "cli/output.h"

namespace {

constexpr const char* description =
    "Checks and compiles behavior catalogs, and solves them offline: which behaviors of a robot "
    "should be active, proven best, on every event.";

constexpr const char* program_examples =
    "  cbc init robot                      a first catalog and mission\n"
    "  cbc lint robot.yaml                 every mistake, with its reason\n"
    "  cbc solve robot.yaml mission.yaml   what the robot would do, event by event\n"
    "  cbc verify robot.yaml               what it can do at all, and what it cannot\n"
    "  cbc graph robot.yaml -o robot.svg   a picture of the catalog\n";

constexpr const char* program_footer =
    "Exit status: 0 success, 1 lint found an error, a compiled catalog is not up to date, two "
    "catalogs differ, an expectation failed, or a property is not proved, 2 the input or the usage "
    "is wrong, 3 an internal "
    "error.\n"
    "\n"
    "Read more: 'cbc help COMMAND', man cbc, man cbc-catalog (how to write a catalog)";

int run(int argc, char** argv) {
  using namespace cbc::cli;
  Program program(description, "cbc " + std::string(cbc::version),
                  {{"COMMAND [OPTION...] FILE...", "--version", "help [COMMAND]"},
                   program_examples,
                   program_footer});
  add_init_command(program);
  add_lint_command(program);
  add_compile_command(program);
  add_solve_command(program);
  add_verify_command(program);
  add_graph_command(program);
  add_schema_command(program);
  add_help_command(program);
  add_completion_command(program, argc > 0 ? argv[0] : "");

  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  if (!arguments.empty() && arguments.front() == complete_argument) {
    reply_to_shell(program, {arguments.begin() + 1, arguments.end()});
    return exit_ok;
  }
  const int status = program.run(arguments);
  // After an earlier error, what could not be written is tried again, which gives the reason.
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    const char* const reason = errno != 0 ? std::strerror(errno) : "a part of it is missing";
    return complain("cannot write the output: {}", reason);
  }
  return status;
}

/// Handles SIGBUS. Compiled catalogs are mapped into memory, and the system sends this signal if
/// the file is truncated meanwhile.
void end_without_file(int /*signal*/) {
  constexpr std::string_view message =
      "cbc: a compiled catalog was truncated while it was in use\n";
  const auto ignored = write(STDERR_FILENO, message.data(), message.size());
  static_cast<void>(ignored);
  _exit(cbc::cli::exit_unusable);
}

}  // namespace

int main(int argc, char** argv) {
  // Reaching a limit of the file size is an error of writing; it does not end the program.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGBUS, end_without_file);
  cbc::cli::hold_standard_descriptors();
  try {
    return run(argc, argv);
  } catch (const std::system_error& error) {
    // Only printing throws it.
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
