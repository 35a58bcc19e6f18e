#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace cbc::cli {

/// The number of threads that may work at once, at least 1. `jobs`: what --jobs says.
[[nodiscard]] inline unsigned thread_count(std::optional<std::uint64_t> jobs) {
  constexpr std::uint64_t most_threads = 256;  // more would only cost memory
  if (jobs) return static_cast<unsigned>(std::min(*jobs, most_threads));
  return std::max(1U, std::thread::hardware_concurrency());
}

/// Makes items on several threads and hands them out in order. No thread runs far ahead of the
/// items handed out, so there are never more than a few items per thread. For one thread none is
/// started, nor where the system has none: each item is then made when it is taken.
template <typename Item>
class OrderedWork {
 public:
  /// Makes items 0 to count - 1 with `make`, which is called on up to `threads` threads at once:
  /// fewer if the system cannot start more.
  OrderedWork(std::size_t count, std::size_t threads, std::function<Item(std::size_t)> make)
      : make_(std::move(make)), count_(count), slots_(threads * items_per_thread) {
    if (threads < 2) return;
    threads_.reserve(threads);
    try {
      while (threads_.size() < threads) threads_.emplace_back([this] { make_items(); });
    } catch (const std::exception&) {
      // There are no more threads, or there is no memory for them: those that exist do the work.
    }
  }
  /// Waits for the items that are being made; no others are begun.
  ~OrderedWork() {
    {
      const std::lock_guard lock(mutex_);
      begun_ = count_;
    }
    has_room_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  OrderedWork(const OrderedWork&) = delete;
  OrderedWork& operator=(const OrderedWork&) = delete;

  /// Whether the next item is ready within the time, or is made when it is taken.
  [[nodiscard]] bool wait_for(std::chrono::milliseconds time) {
    if (threads_.empty()) return true;
    std::unique_lock lock(mutex_);
    return has_item_.wait_for(lock, time, [this] { return next_slot().is_ready; });
  }

  /// Waits for the next item. If making it threw an exception, throws that.
  [[nodiscard]] Item take() {
    if (threads_.empty()) return make_(taken_++);
    Slot slot;
    {
      std::unique_lock lock(mutex_);
      has_item_.wait(lock, [this] { return next_slot().is_ready; });
      slot = std::exchange(next_slot(), {});
      ++taken_;
    }
    has_room_.notify_one();
    if (slot.error) std::rethrow_exception(slot.error);
    return std::move(*slot.item);
  }

 private:
  static constexpr std::size_t items_per_thread = 4;

  struct Slot {
    bool is_ready = false;
    std::optional<Item> item;
    std::exception_ptr error;
  };

  [[nodiscard]] Slot& next_slot() { return slots_[taken_ % slots_.size()]; }

  void make_items() {
    std::unique_lock lock(mutex_);
    for (;;) {
      has_room_.wait(lock, [this] { return begun_ == count_ || begun_ < taken_ + slots_.size(); });
      if (begun_ == count_) return;
      const std::size_t number = begun_++;
      lock.unlock();
      Slot slot = make(number);
      lock.lock();
      slots_[number % slots_.size()] = std::move(slot);
      has_item_.notify_one();
    }
  }

  [[nodiscard]] Slot make(std::size_t number) {
    Slot slot;
    slot.is_ready = true;
    try {
      slot.item.emplace(make_(number));
    } catch (...) {
      slot.error = std::current_exception();
    }
    return slot;
  }

  const std::function<Item(std::size_t)> make_;
  const std::size_t count_;
  std::mutex mutex_;
  std::condition_variable has_item_;
  std::condition_variable has_room_;
  std::size_t begun_ = 0;
  std::size_t taken_ = 0;
  std::vector<Slot> slots_;
  std::vector<std::thread> threads_;
};

}  // namespace cbc::cli
