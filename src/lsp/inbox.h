#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace cbc::lsp {

/// What other threads have for one that takes it in order.
template <typename Item>
class Inbox {
 public:
  void put(Item item) {
    {
      const std::lock_guard lock(mutex_);
      items_.push_back(std::move(item));
    }
    changed_.notify_one();
  }

  /// The next one; empty if there is none until then.
  [[nodiscard]] std::optional<Item> take(std::chrono::steady_clock::time_point until) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_until(lock, until, [this] { return !items_.empty(); })) return std::nullopt;
    Item item = std::move(items_.front());
    items_.pop_front();
    return item;
  }

  /// Whether one of those that wait is of a kind.
  template <typename IsOfKind>
  [[nodiscard]] bool has(const IsOfKind& is_of_kind) const {
    const std::lock_guard lock(mutex_);
    for (const Item& item : items_) {
      if (is_of_kind(item)) return true;
    }
    return false;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> items_;
};

}  // namespace cbc::lsp
