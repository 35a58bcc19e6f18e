#pragma once

#include <algorithm>
#include <chrono>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "core/diagnostic/diagnostic.h"
#include "core/files/terminal.h"
#include "core/script/runner.h"
#include "runtime/coordinator/coordinator.h"

// What the program says and writes: its exit status, messages, lines of streams, files. (How texts
// look is in terminal.h.)

namespace cbc::cli {

/// What the program exits with (the same for every command).
enum ExitStatus : int {
  exit_ok = 0,
  exit_no = 1,        ///< the answer is "no": a failed expectation, a stale file
  exit_unusable = 2,  ///< wrong usage, unusable input, or output that could not be written
  exit_internal = 3   ///< a fault of cbc
};

/// Prints a message to standard error. Returns exit_unusable, which most messages lead to.
int complain(const std::string& message);
template <typename... Arguments>
int complain(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
  return complain(fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// The same for a wrong command line, with a pointer to the help of the command, or of the program
/// if the name is empty.
int usage_error(std::string_view command, const std::string& message);
template <typename... Arguments>
int usage_error(std::string_view command, fmt::format_string<Arguments...> format,
                Arguments&&... arguments) {
  return usage_error(command, fmt::format(format, std::forward<Arguments>(arguments)...));
}

/// Writes whole lines to standard output, many of them with one system call. While this object
/// lives, a closed pipe is an ordinary error.
class LineOutput {
 public:
  LineOutput();
  ~LineOutput();
  LineOutput(const LineOutput&) = delete;
  LineOutput& operator=(const LineOutput&) = delete;

  /// Takes a line, with its end. It is written by flush(), or earlier if many lines are waiting or
  /// the first of them has been waiting for some time.
  void write(std::string_view line);
  /// Writes what is waiting. Call it before the program waits for input, and at the end. Does
  /// nothing after an error, which is reported once.
  void flush();
  [[nodiscard]] bool has_failed() const { return has_failed_; }

 private:
  std::string waiting_;
  std::chrono::steady_clock::time_point waits_since_;
  bool has_failed_ = false;
};

/// If the program was started with a closed standard stream, keeps the next opened file from taking
/// its place. Reading from such a stream or writing to it fails; messages are dropped.
void hold_standard_descriptors();

/// Writes a file, as a whole or not at all, or to standard output for "-". If that fails, or the
/// file is one that was read, prints why. Returns the exit status.
[[nodiscard]] int write_output(const std::string& path, std::string_view content);

/// Writes a report there. `formats`: those of the command (see ReportFormat), one of which has the
/// name. Returns the exit status.
template <typename Formats, typename Result>
int write_report(const Formats& formats, std::string_view name, const Result& result,
                 const std::string& path) {
  const auto format = std::find_if(formats.begin(), formats.end(),
                                   [&](const auto& one) { return one.name == name; });
  return write_output(path, format->write(result, style_for(path), columns_for(path)));
}
/// Writes there that the input cannot be read, in formats for CI, which could take a missing report
/// for one without failures. Returns the exit status.
[[nodiscard]] int report_unreadable(std::string_view command, std::string_view format,
                                    const std::string& path, std::span<const Diagnostic> findings);

/// Writes what is left of standard output. If it could not all be written, prints why, and returns
/// the exit status of that, otherwise `status`.
[[nodiscard]] int finish_output(int status);

/// The same for an input, which is meant to be replaced.
[[nodiscard]] int replace_input(const std::string& path, std::string_view content);

/// The same for a file that must not exist.
[[nodiscard]] int create_output(const std::string& path, std::string_view content);

/// Makes a folder, and those above it, unless they are there. Returns the exit status, after a
/// message if it is not exit_ok.
[[nodiscard]] int make_folder(const std::string& path);

/// Whether write_output could write there now; if not, prints why. For outputs that are written
/// after long work. Call it when all inputs were read.
[[nodiscard]] bool can_write_output(const std::string& path);

/// Whether an input ("-": standard input) and another file are the same. Standard output ("-") is
/// no file.
[[nodiscard]] bool is_same_file(const std::string& input, const std::string& output);

/// Why a run ended early, or empty.
[[nodiscard]] std::string describe_end(const RunResult& result, const CoordinatorOptions& options);

/// The exit status for a run.
[[nodiscard]] int status_of(const RunResult& result);

}  // namespace cbc::cli
