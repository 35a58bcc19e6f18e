#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/support/system.h"

namespace cbc::lsp {

/// Runs command lines of this program beside everything else, one at a time.
class CommandRuns {
 public:
  using Words = std::vector<std::string>;
  /// Called on the other thread, also when the command took too long.
  using Done = std::function<void(const Words& words, Filtered said)>;

  explicit CommandRuns(Done done) : done_(std::move(done)) {}
  CommandRuns(const CommandRuns&) = delete;
  CommandRuns& operator=(const CommandRuns&) = delete;
  ~CommandRuns() { stop(); }

  /// Begins with this one; the present one ends without an answer.
  void begin(Words words);
  /// Returns when none runs any more.
  void stop();

 private:
  const Done done_;
  std::atomic<bool> is_stopped_ = false;
  std::thread thread_;
};

}  // namespace cbc::lsp
