#include "core/files/line_input.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <poll.h>
#include <unistd.h>

namespace cbc::cli {

LineInput::Status LineInput::next(int longest_wait) {
  for (;;) {
    const std::size_t end = buffer_.find('\n', scanned_);
    const bool is_last = end == std::string::npos && has_ended_;
    if (is_last && begin_ == buffer_.size() && !skips_) return Status::end;
    if (end != std::string::npos || is_last) {
      line_ = std::string_view(buffer_).substr(begin_, std::min(end, buffer_.size()) - begin_);
      begin_ = scanned_ = is_last ? buffer_.size() : end + 1;
      ++number_;
      const bool is_too_long = skips_ || line_.size() > longest_line_;
      skips_ = false;
      return is_too_long ? Status::too_long : Status::line;
    }
    scanned_ = buffer_.size();
    if (skips_ || scanned_ - begin_ > longest_line_) {
      skips_ = true;
      begin_ = scanned_;
    }
    if (const Status status = fill(longest_wait); status != Status::line) return status;
  }
}

/// Reads more input. Returns `line` if there may be one now.
LineInput::Status LineInput::fill(int longest_wait) {
  before_reading_();
  buffer_.erase(0, begin_);
  scanned_ -= begin_;
  begin_ = 0;
  constexpr std::size_t block_size = std::size_t{1} << 16;
  for (;;) {
    std::array<pollfd, 2> waiting{{{descriptor_, POLLIN, 0}, {stop_, POLLIN, 0}}};
    const int ready = ::poll(waiting.data(), waiting.size(), longest_wait);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) return Status::waiting;
    if (waiting[1].revents != 0) return Status::stopped;
    const std::size_t size = buffer_.size();
    buffer_.resize(size + block_size);
    const ssize_t count = ::read(descriptor_, buffer_.data() + size, block_size);
    buffer_.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count > 0) return Status::line;
    if (count == 0) {
      has_ended_ = true;
      return Status::line;
    }
    if (errno == EINTR || errno == EAGAIN) continue;
    error_ = std::strerror(errno);
    return Status::failed;
  }
}

}  // namespace cbc::cli
