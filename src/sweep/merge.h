#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "sweep/result.h"

namespace cbc {

/// A sweep may have this many shards at most, so that sums of their numbers fit.
inline constexpr std::uint64_t most_shards = 1000;
/// No number of a shard is larger.
inline constexpr std::uint64_t largest_count = std::uint64_t{1} << 53U;

/// Puts the shards of a sweep together, in any order, to the result of one run.
class SweepMerger {
 public:
  /// Takes a shard, which was read from `file`. Returns why it does not belong to the others, for
  /// people, or nothing.
  [[nodiscard]] std::optional<std::string> add(SweepResult shard, const std::string& file);
  /// Which shards are missing, for people, or nothing if all are there.
  [[nodiscard]] std::optional<std::string> find_missing() const;
  /// The result. All shards are there.
  [[nodiscard]] SweepResult take();

 private:
  [[nodiscard]] std::optional<std::string> find_difference(const SweepResult& shard) const;

  SweepResult merged_;
  std::map<std::uint64_t, std::string> files_;  ///< by index of the shard
};

}  // namespace cbc
