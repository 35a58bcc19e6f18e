#pragma once

namespace cbc::cli {

/// While it exists, SIGINT, SIGTERM and SIGHUP do not end the program but ask it to stop. Many send
/// them twice at once, to the program and to its group (timeout of GNU, terminals), so only one
/// that comes over a second after the first ends it. One at a time; when it is gone, the program is
/// about to end, and no signal is heard.
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
