#include "core/files/output.h"

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <string_view>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/core.h>

#include "core/files/read.h"
#include "core/report/test_report.h"
#include "core/support/system.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {

int complain(const std::string& message) {
  const std::string line = "cbc: " + message + "\n";
  // If it cannot be written, the exit status still tells; a stream goes on.
  static_cast<void>(std::fwrite(line.data(), 1, line.size(), stderr));
  return exit_unusable;
}

int usage_error(std::string_view command, const std::string& message) {
  return complain("{}\nSee 'cbc{}{} --help'.", message, command.empty() ? "" : " ", command);
}

LineOutput::LineOutput() { std::signal(SIGPIPE, SIG_IGN); }

LineOutput::~LineOutput() { std::signal(SIGPIPE, SIG_DFL); }

void LineOutput::write(std::string_view line) {
  constexpr std::size_t enough = std::size_t{1} << 16;   // more would not be faster
  constexpr std::chrono::milliseconds longest_wait(10);  // nobody notices it
  if (has_failed_) return;
  const auto now = std::chrono::steady_clock::now();
  if (waiting_.empty()) waits_since_ = now;
  waiting_ += line;
  if (waiting_.size() >= enough || now - waits_since_ >= longest_wait) flush();
}

void LineOutput::flush() {
  std::string_view rest = waiting_;
  while (!rest.empty() && !has_failed_) {
    const ssize_t count = ::write(STDOUT_FILENO, rest.data(), rest.size());
    if (count >= 0) {
      rest.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN) {
      // Another process that shares the pipe may have made it non-blocking.
      pollfd reader{STDOUT_FILENO, POLLOUT, 0};
      static_cast<void>(::poll(&reader, 1, -1));
    } else if (errno != EINTR) {
      has_failed_ = true;
      complain("cannot write the output: {}", std::strerror(errno));
    }
  }
  waiting_.clear();
}

void hold_standard_descriptors() {
  // In this order, as an opened file takes the lowest free descriptor.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(descriptor, F_GETFD) >= 0) continue;
    // Opened for the direction that is not used, so that using it fails. Messages may be dropped.
    const int mode = descriptor == STDOUT_FILENO ? O_RDONLY : O_WRONLY;
    if (::open("/dev/null", mode) < 0) return;
  }
}

namespace {

/// The error of the first write_output to standard output that failed. The stream only knows that
/// one did, and nothing of a long content is left in it to be written again.
int error_of_output = 0;

}  // namespace

int finish_output(int status) {
  // After an earlier error, what is left is tried again, which gives the reason.
  errno = error_of_output;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
  const char* const reason = errno != 0 ? std::strerror(errno) : "a part of it is missing";
  return complain("cannot write the output: {}", reason);
}

int write_output(const std::string& path, std::string_view content) {
  if (path == "-") {
    const bool is_whole = std::fwrite(content.data(), 1, content.size(), stdout) == content.size();
    if (!is_whole && error_of_output == 0) error_of_output = errno;
    return exit_ok;  // finish_output reports it
  }
  if (const auto refusal = find_read_file(path)) return complain(*refusal);
  return replace_input(path, content);
}

int report_unreadable(std::string_view command, std::string_view format, const std::string& path,
                      std::span<const Diagnostic> findings) {
  const std::string report = unreadable_to_text(format, command, findings);
  if (!report.empty()) static_cast<void>(write_output(path, report));
  return exit_unusable;
}

int replace_input(const std::string& path, std::string_view content) {
  if (const auto error = write_atomically(path, content)) {
    return complain("cannot write {}: {}", quote(path), *error);
  }
  return exit_ok;
}

int create_output(const std::string& path, std::string_view content) {
  if (const auto error = create_atomically(path, content)) {
    return complain("cannot write {}: {}", quote(path), *error);
  }
  return exit_ok;
}

int make_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  // Not every library says so.
  if (std::error_code unknown; std::filesystem::exists(path, unknown) &&
                               !std::filesystem::is_directory(path, unknown) && !unknown) {
    error = std::make_error_code(std::errc::not_a_directory);
  }
  if (error) return complain("cannot make the folder {}: {}", quote(path), error.message());
  return exit_ok;
}

bool can_write_output(const std::string& path) {
  if (path == "-") return true;
  if (const auto refusal = find_read_file(path)) {
    complain(*refusal);
    return false;
  }
  const auto obstacle = find_obstacle(path);
  if (obstacle) complain("cannot write {}: {}", quote(path), *obstacle);
  return !obstacle;
}

bool is_same_file(const std::string& input, const std::string& output) {
  if (output == "-") return false;
  struct stat in {};
  struct stat out {};
  const int status = input == "-" ? ::fstat(STDIN_FILENO, &in) : ::stat(input.c_str(), &in);
  return status == 0 && ::stat(output.c_str(), &out) == 0 && in.st_dev == out.st_dev &&
         in.st_ino == out.st_ino;
}

std::string describe_end(const RunResult& result, const CoordinatorOptions& options) {
  switch (result.status) {
    case Coordinator::Status::ok:
      return {};
    case Coordinator::Status::too_many_clock_events:
      return fmt::format("the clock made more than {} events (--max-clock-events)",
                         options.max_clock_events);
    case Coordinator::Status::stopped:
      return "stopped by a signal, before the event that the clock moved on to";
    case Coordinator::Status::refused_answer:
      return "the checker rejects an answer of the solver: " + result.internal_error;
  }
  return {};
}

int status_of(const RunResult& result) {
  if (result.status == Coordinator::Status::refused_answer) return exit_internal;
  if (result.status == Coordinator::Status::too_many_clock_events) return exit_unusable;
  return result.failed > 0 || !result.was_run ? exit_no : exit_ok;
}

}  // namespace cbc::cli
