#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "coordinator/coordinator.h"
#include "diagnostic/diagnostic.h"
#include "script/runner.h"

namespace cbc::cli {

/// What the program exits with (the same for every command).
enum ExitStatus : int {
  exit_ok = 0,
  exit_no = 1,        ///< the answer is "no": an expectation failed, a file is stale
  exit_unusable = 2,  ///< usage, unreadable or invalid input, output that could not be written
  exit_internal = 3   ///< an answer that the checker refuses
};

/// Prints a complaint to standard error.
void complain(const std::string& message);

/// The same about the command line of a command, whose help it points to; without a name, of the
/// program. Returns the exit status.
int usage_error(std::string_view command, const std::string& message);

/// Whether a stream is a terminal that can do more than print.
[[nodiscard]] bool is_terminal(std::FILE* stream);

/// How many characters a line of a terminal has; 80 where it does not say.
[[nodiscard]] std::size_t columns_of(std::FILE* stream);

/// Whether to write colors to a stream: it is such a terminal, and NO_COLOR (https://no-color.org)
/// is not set.
[[nodiscard]] bool wants_color(std::FILE* stream);

[[nodiscard]] Style style_for(std::FILE* stream);

/// A line on a terminal that tells how far a long command is; nothing is shown in the first second,
/// nor where standard error is no terminal.
class Progress {
 public:
  /// `what` is done to `total` things: "linting".
  Progress(std::string what, std::size_t total);
  ~Progress();

  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Says that the next thing is begun.
  void begin(const std::string& name);
  /// Shows the line, also where it was taken away; `detail` goes on its end. May be called as often
  /// as there is something to tell.
  void show(const std::string& detail = "");
  /// Takes the line away.
  void clear();

 private:
  const std::string what_;
  const std::size_t total_;
  const bool is_wanted_;
  const std::chrono::steady_clock::time_point start_;
  std::size_t begun_ = 0;
  std::string name_;  ///< of what was begun last
  bool is_shown_ = false;
  std::chrono::steady_clock::time_point shown_;  ///< last
};

/// While it exists, SIGINT, SIGTERM and SIGHUP do not end the program but ask it to stop. Many send
/// them twice at once, to the program and to its group (timeout of GNU, terminals), so only one
/// that comes over a second after the first ends it. One at a time; when it is gone, the program is
/// about to end, and no signal is heard.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  [[nodiscard]] bool have_come() const;
  /// A descriptor that can be read from once a signal has come, for poll.
  [[nodiscard]] int descriptor() const;
};

/// Where the program was started with a standard stream closed, keeps the next file that it opens
/// from taking its place: reading from it or writing to it fails, as it should, and messages go
/// nowhere.
void hold_standard_descriptors();

/// Writes a file, as a whole or not at all, or to standard output for "-". Prints why it could not.
/// Returns the exit status.
[[nodiscard]] int write_output(const std::string& path, std::string_view content);

/// Whether an input ("-": standard input) is the file that an output ("-": standard output, which
/// is none) would replace.
/// See overwrites_input for the complaint.
[[nodiscard]] bool is_same_file(const std::string& input, const std::string& output);

inline constexpr const char* overwrites_input = "the output {} is an input, too";

/// How runs end, whatever their events come from.

/// Why a run ended early, or empty.
[[nodiscard]] std::string describe_end(const RunResult& result, const CoordinatorOptions& options);

/// The exit status that a run gives.
[[nodiscard]] int status_of(const RunResult& result);

}  // namespace cbc::cli
