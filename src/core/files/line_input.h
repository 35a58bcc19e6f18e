#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

namespace cbc::cli {

/// Reads a file, a pipe or a terminal line by line, as soon as a line is complete.
class LineInput {
 public:
  enum class Status : std::uint8_t {
    line,      ///< see line() and number()
    waiting,   ///< nothing has come in the given time
    too_long,  ///< a line was skipped because it is too long; see number()
    end,
    stopped,  ///< a signal has come
    failed    ///< see error()
  };

  /// `descriptor` is not closed. `stop`: a descriptor that becomes readable when it is time to
  /// stop, or -1. `before_reading` is called when all complete lines were handed out, before the
  /// next ones are read or waited for.
  LineInput(int descriptor, int stop, std::size_t longest_line,
            std::function<void()> before_reading)
      : descriptor_(descriptor),
        stop_(stop),
        longest_line_(longest_line),
        before_reading_(std::move(before_reading)) {}

  /// Waits for the next line, at most `longest_wait` milliseconds if that is not negative.
  [[nodiscard]] Status next(int longest_wait = -1);
  /// Without its end; valid until the next call.
  [[nodiscard]] std::string_view line() const { return line_; }
  /// Counts lines from 1.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  [[nodiscard]] Status fill(int longest_wait);

  int descriptor_;
  int stop_;
  std::size_t longest_line_;
  std::function<void()> before_reading_;
  std::string buffer_;
  std::size_t begin_ = 0;    ///< of the next line
  std::size_t scanned_ = 0;  ///< there is no line end before this
  bool has_ended_ = false;
  bool skips_ = false;  ///< in a line that is too long
  std::string_view line_;
  std::uint64_t number_ = 0;
  std::string error_;
};

}  // namespace cbc::cli
