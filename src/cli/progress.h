#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace cbc::cli {

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

}  // namespace cbc::cli
