#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <sys/types.h>
#include <vector>

namespace cbc::golden {

/// How to call the program.
struct Call {
  std::vector<std::string> arguments;
  std::filesystem::path folder{};  ///< working directory
  std::filesystem::path standard_input = "/dev/null";
  std::filesystem::path standard_output{};  ///< a file, or empty: a pipe
  int standard_output_flags = 0;            ///< of the file, as O_NONBLOCK
  /// Added to the environment of the test, from which NO_COLOR is taken.
  std::map<std::string, std::string> environment = {{"TERM", "xterm"}};
};

/// What came of it.
struct Result {
  int status = 0;   ///< the exit status; 128 and more: the number of a signal was added
  std::string out;  ///< standard output
  std::string err;  ///< standard error
};

/// Runs the program with pipes for its output.
[[nodiscard]] Result run(const Call& call);

/// The same; `meanwhile` is called with the process, which is not waited for before.
[[nodiscard]] Result run(const Call& call, const std::function<void(pid_t)>& meanwhile);

/// Runs the program with its output, that is both of its streams, on a terminal. The result has all
/// of it in `out`, with the line ends of a terminal ("\r\n"). Throws std::system_error where there
/// are no terminals.
[[nodiscard]] Result run_on_terminal(const Call& call);

/// The same, until the output has this text: then the program is interrupted.
[[nodiscard]] Result run_on_terminal_until(const Call& call, const std::string& text);

}  // namespace cbc::golden
