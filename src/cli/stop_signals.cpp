#include "cli/stop_signals.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

namespace cbc::cli {
namespace {

// What a signal handler may touch.
volatile std::sig_atomic_t stop = 0;
std::array<int, 2> ends{-1, -1};

extern "C" void ask_to_stop(int /*signal*/) {
  const int error = errno;
  stop = 1;
  static_cast<void>(!::write(ends[1], "", 1));
  errno = error;
}

}  // namespace

StopSignals::StopSignals() {
  if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) {
    throw std::system_error(errno, std::generic_category());
  }
  stop = 0;
  struct sigaction action = {};
  action.sa_handler = ask_to_stop;
  // Writing goes on where it was; whoever is in a hurry sends a second one.
  action.sa_flags = static_cast<int>(SA_RESTART | static_cast<int>(SA_RESETHAND));
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

StopSignals::~StopSignals() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  ::close(ends[0]);
  ::close(ends[1]);
}

bool StopSignals::have_come() const { return stop != 0; }

int StopSignals::descriptor() const { return ends[0]; }

}  // namespace cbc::cli
