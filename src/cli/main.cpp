#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cbc/version.h"
#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/input.h"
#include "cli/output.h"

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

namespace {

constexpr const char* description =
    "Checks and compiles behavior catalogs, and solves them offline: which behaviors of a robot "
    "should be active, proven best, on every event.";

constexpr const char* program_examples =
    "  cbc lint robot.yaml                 every mistake, with its reason\n"
    "  cbc solve robot.yaml mission.yaml   what the robot would do, event by event\n"
    "  cbc graph robot.yaml -o robot.svg   a picture of the catalog\n";

constexpr const char* program_footer =
    "Exit status: 0 all is well, 1 lint found an error, a compiled catalog is stale, two "
    "catalogs differ, or an expectation failed, 2 the input or the usage is wrong, 3 an internal "
    "error.\n"
    "\n"
    "Read more: 'cbc COMMAND --help', man cbc, man cbc-catalog (how to write a catalog)";

/// The arguments of a command without "--", behind which CLI11 gives what follows to the program,
/// if the command has a file already: all of it are files, so a path that does not look like an
/// option does.
std::vector<std::string> without_separator(std::vector<std::string> arguments) {
  const auto separator = std::find(arguments.begin(), arguments.end(), "--");
  if (separator == arguments.end()) return arguments;
  for (auto file = separator + 1; file != arguments.end(); ++file) {
    if (file->size() > 1 && file->front() == '-') file->insert(0, "./");
  }
  arguments.erase(separator);
  return arguments;
}

int run(int argc, char** argv) {
  using namespace cbc::cli;
  CLI::App program(description, "cbc");
  program.option_defaults()->disable_flag_override();  // else --strict=0 would be a way to say no
  program.set_help_flag("-h,--help", "Print this help and exit");
  program.set_version_flag("--version", "cbc " + std::string(cbc::version),
                           "Print the version and exit");
  program.require_subcommand(1);
  int status = exit_ok;
  add_lint_command(program, status);
  add_compile_command(program, status);
  add_solve_command(program, status);
  add_graph_command(program, status);
  add_schema_command(program, status);
  add_completion_command(program, argc > 0 ? argv[0] : "", status);
  set_help(program, {{"COMMAND [OPTION...] FILE...", "--version", "COMMAND --help"},
                     program_examples,
                     program_footer});  // commands would inherit it

  const std::vector<std::string> arguments(argv + std::min(argc, 1), argv + argc);
  program.failure_message([&](const CLI::App*, const CLI::Error& error) {
    const auto* const parse_error = dynamic_cast<const CLI::ParseError*>(&error);
    return fmt::format("cbc: {}\nSee '{} --help'.\n",
                       parse_error == nullptr
                           ? error.what()
                           : describe_usage_error(program, *parse_error, arguments),
                       full_name(program));
  });

  if (!arguments.empty() && arguments.front() == complete_argument) {
    reply_to_shell(program, {arguments.begin() + 1, arguments.end()});
    return exit_ok;
  }
  if (!arguments.empty()) {
    if (const std::string unknown = find_unknown_command(program, arguments.front());
        !unknown.empty()) {
      complain(unknown + "\nSee 'cbc --help'.");
      return exit_unusable;
    }
    if (const std::string misuse = find_bad_equals(program, arguments); !misuse.empty()) {
      return usage_error(arguments.front(), misuse);
    }
  }
  try {
    std::vector<std::string> left = without_separator(arguments);
    std::reverse(left.begin(), left.end());  // so CLI11 wants them
    program.parse(std::move(left));
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
