#include "core/support/budget.h"

#include <cstddef>
#include <string_view>

#include <fmt/format.h>

namespace cbc {
namespace {

/// As --max-memory takes it: "512M".
std::string memory_with_unit(std::uint64_t bytes) {
  constexpr std::string_view units = " KMGT";
  std::size_t unit = 0;
  while (bytes % 1024 == 0 && unit + 1 < units.size()) {
    bytes /= 1024;
    ++unit;
  }
  return std::to_string(bytes) + std::string(unit > 0 ? units.substr(unit, 1) : "");
}

Budget::Clock::duration to_duration(double seconds) {
  return std::chrono::duration_cast<Budget::Clock::duration>(
      std::chrono::duration<double>(seconds));
}

}  // namespace

Budget Budget::started() const {
  Budget budget = *this;
  if (seconds > 0 && !deadline_) budget.deadline_ = Clock::now() + to_duration(seconds);
  return budget;
}

Budget Budget::until(double share) const {
  Budget budget = *this;
  if (deadline_) *budget.deadline_ -= to_duration((1 - share) * seconds);
  return budget;
}

std::optional<Budget::End> Budget::find_end(std::uint64_t states, std::uint64_t bytes) const {
  if (max_states > 0 && states >= max_states) return End::max_states;
  if (max_memory > 0 && bytes >= max_memory) return End::max_memory;
  if (deadline_ && Clock::now() >= *deadline_) return End::time_limit;
  if (is_stopped && is_stopped()) return End::stopped;
  return std::nullopt;
}

std::string Budget::describe(End end) const {
  switch (end) {
    case End::max_states:
      return fmt::format("ended by --max-states {}", max_states);
    case End::max_memory:
      return fmt::format("ended by --max-memory {}", memory_with_unit(max_memory));
    case End::time_limit:
      return fmt::format("ended by --time-limit {}", seconds);
    case End::too_many:
      return "ended, as there are more states than can be counted";
    case End::stopped:
      break;
  }
  return "interrupted";
}

}  // namespace cbc
