#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace cbc::cli {

/// Reads a file, a pipe or a terminal line by line, as the lines come.
class LineInput {
 public:
  enum class Status : std::uint8_t {
    line,      ///< see line() and number()
    too_long,  ///< a line longer than allowed was passed over; see number()
    end,
    stopped,  ///< a signal has come
    failed    ///< see error()
  };

  /// `descriptor` is not closed. `stop`: a descriptor that can be read from when it is time to
  /// stop, or -1.
  LineInput(int descriptor, int stop, std::size_t longest_line)
      : descriptor_(descriptor), stop_(stop), longest_line_(longest_line) {}

  [[nodiscard]] Status next();
  /// Without its end; valid until the next call.
  [[nodiscard]] std::string_view line() const { return line_; }
  /// Counts lines from 1.
  [[nodiscard]] std::uint64_t number() const { return number_; }
  [[nodiscard]] const std::string& error() const { return error_; }

 private:
  [[nodiscard]] Status fill();

  int descriptor_;
  int stop_;
  std::size_t longest_line_;
  std::string buffer_;
  std::size_t begin_ = 0;    ///< of the next line
  std::size_t scanned_ = 0;  ///< up to here there is no end of a line
  bool has_ended_ = false;
  bool skips_ = false;  ///< in a line that is too long
  std::string_view line_;
  std::uint64_t number_ = 0;
  std::string error_;
};

}  // namespace cbc::cli
