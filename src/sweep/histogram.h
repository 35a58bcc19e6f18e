#pragma once

#include <cstdint>
#include <map>

namespace cbc {

/// How often numbers occurred. Those below 1024 are counted exactly; larger ones are rounded down
/// to their first 10 binary digits (less than 0.2 % off), so that memory is bounded.
class Histogram {
 public:
  void add(std::uint64_t number) { add_rounded(round_down(number), 1); }
  void add(const Histogram& other) {
    for (const auto& [number, count] : other.counts_) add_rounded(number, count);
  }
  /// `number` is one that round_down returns.
  void add_rounded(std::uint64_t number, std::uint64_t count) {
    counts_[number] += count;
    total_ += count;
  }

  [[nodiscard]] static std::uint64_t round_down(std::uint64_t number);

  [[nodiscard]] std::uint64_t total() const { return total_; }
  [[nodiscard]] const std::map<std::uint64_t, std::uint64_t>& counts() const { return counts_; }
  /// The least number that is not below half of those counted, not below 99 % of them, and the
  /// largest; 0 if there are none.
  [[nodiscard]] std::uint64_t median() const { return at_rank(total_ - total_ / 2); }
  [[nodiscard]] std::uint64_t percentile_99() const { return at_rank(total_ - total_ / 100); }
  [[nodiscard]] std::uint64_t maximum() const {
    return counts_.empty() ? 0 : counts_.rbegin()->first;
  }

 private:
  [[nodiscard]] std::uint64_t at_rank(std::uint64_t rank) const;

  std::map<std::uint64_t, std::uint64_t> counts_;
  std::uint64_t total_ = 0;
};

}  // namespace cbc
