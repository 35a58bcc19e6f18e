#pragma once

#include <string_view>

namespace cbc::cli {

/// Writes lines to standard output, each at once and as a whole. A reader that has gone away is an
/// error like any other, for the life of this object.
class LineOutput {
 public:
  LineOutput();
  ~LineOutput();
  LineOutput(const LineOutput&) = delete;
  LineOutput& operator=(const LineOutput&) = delete;

  /// Does nothing after an error, which is complained of once.
  void write(std::string_view line);
  [[nodiscard]] bool has_failed() const { return has_failed_; }

 private:
  bool has_failed_ = false;
};

}  // namespace cbc::cli
