#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <cxxabi.h>
#include <mutex>
#include <pybind11/pybind11.h>
#include <thread>
#include <unistd.h>

// How events get along with threads and with Ctrl-C.

namespace cbc::python {

/// Takes the GIL again. While the interpreter ends, a thread that wants it is to end, which
/// Python 3.11 does by unwinding its stack, through what must not throw; so it waits here for the
/// end of the process instead, as in Python 3.14.
inline void restore_gil(PyThreadState* state) {
  try {
    PyEval_RestoreThread(state);
  } catch (abi::__forced_unwind&) {
    for (;;) ::pause();
  }
}

/// Most events take microseconds, in which the GIL is kept: to give it away and to wait for it
/// again would take longer, and much longer while other threads compute. After a millisecond other
/// threads go on, and every 50 ms Python looks for signals.
class LongCall {
 public:
  LongCall() : begin_(Clock::now()), looked_(begin_) {}
  LongCall(const LongCall&) = delete;
  LongCall& operator=(const LongCall&) = delete;
  ~LongCall() { take_gil(); }

  /// Asked again and again by the thread of the call; true ends it: a signal handler has raised.
  bool is_stopped() {
    constexpr std::uint32_t asked_between_looks = 8;
    if (was_interrupted_ || ++asked_ % asked_between_looks != 0) return was_interrupted_;
    const Clock::time_point now = Clock::now();
    if (now - looked_ >= std::chrono::milliseconds(50)) {
      looked_ = now;
      take_gil();
      was_interrupted_ = PyErr_CheckSignals() != 0;
    } else if (released_ == nullptr && now - begin_ >= std::chrono::milliseconds(1)) {
      released_ = PyEval_SaveThread();
    }
    return was_interrupted_;
  }

  [[nodiscard]] bool was_interrupted() const { return was_interrupted_; }

  /// To be called before anything of Python.
  void take_gil() {
    if (released_ != nullptr) restore_gil(released_);
    released_ = nullptr;
  }

 private:
  using Clock = std::chrono::steady_clock;

  const Clock::time_point begin_;
  Clock::time_point looked_;
  std::uint32_t asked_ = 0;
  PyThreadState* released_ = nullptr;
  bool was_interrupted_ = false;
};

/// What `use` returns, which takes an IsStopped. Throws what a signal handler has raised.
template <typename Use>
auto call_long(const Use& use) {
  LongCall call;
  auto result = use([&call] { return call.is_stopped(); });
  call.take_gil();
  if (call.was_interrupted()) throw pybind11::error_already_set();
  return result;
}

/// Lets one thread at a time use an object. Whoever waits for it does not keep the GIL, which the
/// other one may need, and looks for signals.
class Turn {
 public:
  class Lock {
   public:
    explicit Lock(Turn& turn) : turn_(turn) {
      while (!turn_.mutex_.try_lock()) {
        PyThreadState* const released = PyEval_SaveThread();
        const bool has_turn = turn_.mutex_.try_lock_for(std::chrono::milliseconds(50));
        restore_gil(released);
        if (has_turn) break;
        if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
      }
      turn_.owner_ = std::this_thread::get_id();
    }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
    ~Lock() {
      turn_.owner_ = std::thread::id();
      turn_.mutex_.unlock();
    }

   private:
    Turn& turn_;
  };

  /// Whether this thread has the turn, so that it must not wait for it: a signal handler runs
  /// within a call.
  [[nodiscard]] bool is_mine() const { return owner_ == std::this_thread::get_id(); }

 private:
  std::timed_mutex mutex_;
  std::atomic<std::thread::id> owner_{};
};

}  // namespace cbc::python
