#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <unistd.h>
#include <vector>

#include "cbc/version.h"
#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "core/files/signals.h"

namespace {

constexpr const char* description =
    "Checks and compiles behavior catalogs, and computes offline which behaviors of a robot should "
    "be active after each event, proven to be the best choice.";

constexpr const char* program_examples =
    "  cbc init robot                      a first catalog and mission\n"
    "  cbc lint robot.yaml                 every mistake, with its reason\n"
    "  cbc solve robot.yaml mission.yaml   what the robot would do, event by event\n"
    "  cbc verify robot.yaml               what it can do at all, and what it cannot\n"
    "  cbc graph robot.yaml -o robot.svg   a picture of the catalog\n";

constexpr const char* program_footer =
    "Exit status: 0 success, 1 the answer is no (lint found an error, a compiled catalog is not up "
    "to date, two catalogs or a replay differ, an expectation failed, a property is not proved, or "
    "--fail-under was missed), 2 the input or the usage is wrong, 3 an internal error.\n"
    "\n"
    "Read more: 'cbc help COMMAND', man cbc, man cbc-catalog (how to write a catalog)";

int run(int argc, char** argv) {
  using namespace cbc::cli;
  Program program(description, "cbc " + std::string(cbc::version), argc > 0 ? argv[0] : "",
                  {{"COMMAND [OPTION...] FILE...", "--version", "help [COMMAND]"},
                   program_examples,
                   program_footer});
#define CBC_ADD(name) add_##name##_command(program);
  CBC_COMMANDS(CBC_ADD)
#undef CBC_ADD

  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  if (!arguments.empty() && arguments.front() == complete_argument) {
    reply_to_shell(program, {arguments.begin() + 1, arguments.end()});
    return exit_ok;
  }
  return finish_output(program.run(arguments));
}

/// Handles SIGBUS. Compiled catalogs are mapped into memory, and the system sends this signal to
/// who reads one that is truncated meanwhile, or that the disk does not deliver. That never happens
/// within the memory management or the output, so it may use both.
void end_without_file(int signal, siginfo_t* info, void* /*context*/) {
  if (info->si_code <= 0) {  // another process sent it
    std::signal(signal, SIG_DFL);
    std::raise(signal);
    return;
  }
  cbc::cli::complain("a compiled catalog was truncated or became unreadable while it was in use");
  _exit(cbc::cli::exit_unusable);
}

void handle_lost_files() {
  struct sigaction action = {};
  action.sa_sigaction = end_without_file;
  action.sa_flags = SA_SIGINFO;
  sigemptyset(&action.sa_mask);
  sigaction(SIGBUS, &action, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  // Reaching a limit of the file size is an error of writing; it does not end the program.
  std::signal(SIGXFSZ, SIG_IGN);
  handle_lost_files();
  cbc::cli::hold_standard_descriptors();
  try {
    return run(argc, argv);
  } catch (const std::system_error& error) {
    // Only printing throws it.
    std::fprintf(stderr, "cbc: cannot write the output: %s\n", error.code().message().c_str());
    return cbc::cli::exit_unusable;
  } catch (const cbc::cli::SystemRefusal& refusal) {
    return cbc::cli::complain(refusal.what());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "cbc: out of memory\n");
    return cbc::cli::exit_unusable;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cbc: internal error: %s\n", error.what());
    return cbc::cli::exit_internal;
  }
}
