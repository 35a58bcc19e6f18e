#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

#include "core/support/budget.h"

namespace cbc::cli {

/// A line on the terminal that shows the progress of a long command. Nothing is shown in the first
/// second, or if standard error is not a terminal.
class Progress {
 public:
  /// `what` is being done to `total` things: "linting".
  Progress(std::string what, std::size_t total);
  ~Progress();

  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begins the next thing.
  void begin(const std::string& name);
  /// Shows the line, with `detail` at its end. May be called often: the terminal is updated a few
  /// times per second.
  void show(const std::string& detail = "");
  /// Shows what a budget is told; each thing that is new begins. This object must outlive it.
  [[nodiscard]] decltype(Budget::tell) listener();
  /// Removes the line, until it is shown again.
  void clear();

 private:
  [[nodiscard]] bool is_due() const;

  const std::string what_;
  const std::size_t total_;
  const bool is_wanted_;
  const std::chrono::steady_clock::time_point start_;
  std::size_t begun_ = 0;
  std::string name_;  ///< of the thing that was begun last
  std::mutex listening_;
  bool is_shown_ = false;
  std::chrono::steady_clock::time_point shown_;  ///< last
};

}  // namespace cbc::cli
