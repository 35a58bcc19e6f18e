#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>

namespace cbc {

/// What questions may still cost, counted in steps and not in seconds, so that every machine has
/// the same answers. Several searches share one; when it is over, all further answers are unknown.
class Effort {
 public:
  explicit Effort(std::uint64_t most = UINT64_MAX, std::function<bool()> is_stopped = {})
      : left_(most), is_stopped_(std::move(is_stopped)) {}

  [[nodiscard]] std::uint64_t left() const { return left_; }
  /// Whether it is used up, or somebody stopped it, who is asked now.
  [[nodiscard]] bool is_over() {
    if (is_stopped_ && is_stopped_()) left_ = 0;
    return left_ == 0;
  }
  void spend(std::uint64_t effort) { left_ -= std::min(effort, left_); }

 private:
  std::uint64_t left_;
  std::function<bool()> is_stopped_;
};

}  // namespace cbc
