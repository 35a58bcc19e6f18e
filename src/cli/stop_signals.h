#pragma once

namespace cbc::cli {

/// While it exists, the first SIGINT or SIGTERM does not end the program but asks it to stop; the
/// next one ends it. One at a time.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  [[nodiscard]] bool have_come() const;
  /// A descriptor that can be read from once a signal has come, for poll.
  [[nodiscard]] int descriptor() const;
};

}  // namespace cbc::cli
