#pragma once

#include <cstdint>

namespace cbc {

/// How good the best solution of a problem may be at most, where a limit ended the search before
/// the proof (docs/semantics.md, "Search limits").
struct SearchBound {
  std::uint32_t more_requests = 0;  ///< that it may serve beyond as many as the answer serves
  /// Whether it serves the same requests as the answer, so that f2 is the first to be better.
  bool same_requests = false;
  /// Of its f2 within the group; by rounding and by the search, that of the answer may be higher.
  double suitability = 1;
};

/// At least the product of up to `factors` suitabilities whose costs, by log_cost, have a sum of
/// `cost` or more. The same on all machines.
[[nodiscard]] double highest_product(std::int64_t cost, std::uint32_t factors);

}  // namespace cbc
