#include "cli/line_output.h"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <poll.h>
#include <unistd.h>

#include <fmt/format.h>

#include "cli/input.h"

namespace cbc::cli {

LineOutput::LineOutput() { std::signal(SIGPIPE, SIG_IGN); }

LineOutput::~LineOutput() { std::signal(SIGPIPE, SIG_DFL); }

void LineOutput::write(std::string_view line) {
  while (!line.empty() && !has_failed_) {
    const ssize_t count = ::write(STDOUT_FILENO, line.data(), line.size());
    if (count >= 0) {
      line.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno == EAGAIN) {
      // Whoever shares the pipe may have asked not to wait for its reader.
      pollfd reader{STDOUT_FILENO, POLLOUT, 0};
      static_cast<void>(::poll(&reader, 1, -1));
    } else if (errno != EINTR) {
      has_failed_ = true;
      complain(fmt::format("cannot write the output: {}", std::strerror(errno)));
    }
  }
}

}  // namespace cbc::cli
