#include "core/files/signals.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <fcntl.h>
#include <unistd.h>

namespace cbc::cli {

namespace {

constexpr std::array stop_signals = {SIGINT, SIGTERM, SIGHUP};

// Signal handlers may access only such variables.
volatile std::sig_atomic_t stop = 0;
volatile std::sig_atomic_t asked_at = 0;  ///< in seconds
std::array<int, 2> ends{-1, -1};

std::sig_atomic_t seconds_now() {
  timespec time{};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<std::sig_atomic_t>(time.tv_sec);
}

extern "C" void ask_to_stop(int signal) {
  const int error = errno;
  if (stop == 0) {
    stop = 1;
    asked_at = seconds_now();
    static_cast<void>(!::write(ends[1], "", 1));
  } else if (seconds_now() - asked_at > 1) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  errno = error;
}

}  // namespace

StopSignals::StopSignals() {
  if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) {
    throw SystemRefusal("cannot open a pipe", errno);
  }
  stop = 0;
  struct sigaction action = {};
  action.sa_handler = ask_to_stop;
  action.sa_flags = SA_RESTART;  // resumes interrupted writes
  sigemptyset(&action.sa_mask);
  for (const int signal : stop_signals) sigaddset(&action.sa_mask, signal);
  for (const int signal : stop_signals) {
    struct sigaction before = {};
    ::sigaction(signal, &action, &before);
    // Under nohup the end of a connection must not stop the program.
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  }
}

StopSignals::~StopSignals() {
  // All is saved; a signal now must not make the run look interrupted.
  for (const int signal : stop_signals) std::signal(signal, SIG_IGN);
  ::close(ends[0]);
  ::close(ends[1]);
}

bool StopSignals::have_come() const { return stop != 0; }

int StopSignals::descriptor() const { return ends[0]; }

}  // namespace cbc::cli
