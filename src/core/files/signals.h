#pragma once

#include <cstring>
#include <stdexcept>
#include <string>

namespace cbc::cli {

/// The system refuses what a run cannot do without, such as a thread. main() prints it.
class SystemRefusal : public std::runtime_error {
 public:
  /// `error` is a value of errno.
  SystemRefusal(const std::string& what, int error)
      : std::runtime_error(what + ": " + std::strerror(error)) {}
};

/// While it exists, SIGINT, SIGTERM and SIGHUP ask the program to stop instead of ending it. GNU
/// timeout and terminals may send them twice at once, to the program and to its group, so only a
/// signal that comes more than a second after the first one ends the program. There can be only one
/// such object. After it is destroyed these signals are ignored, as the program is about to end.
class StopSignals {
 public:
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  [[nodiscard]] bool have_come() const;
  /// A descriptor for poll, which is readable once a signal has come.
  [[nodiscard]] int descriptor() const;
};

}  // namespace cbc::cli
