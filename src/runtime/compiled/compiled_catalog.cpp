#include "compiled/compiled_catalog.h"

#include <algorithm>
#include <bit>

#include "base/fixed_point.h"

namespace cbc {
namespace {

/// ln(m) = 2 artanh(z) = 2 (z + z^3 / 3 + z^5 / 5 + ...) with z = (m - 1) / (m + 1), for
/// n = m * 2^exponent and m in [1, 2), so that z is at most 1/3.
std::int64_t log_of_prime(Millionths prime) {
  const auto exponent = static_cast<unsigned>(std::bit_width(prime)) - 1;
  const std::uint64_t m = std::uint64_t{prime} << (fixed::bits - exponent);
  const auto z =
      static_cast<std::uint64_t>((fixed::Wide{m - fixed::one} << fixed::bits) / (m + fixed::one));
  const std::uint64_t square = fixed::multiply(z, z);
  std::uint64_t sum = 0;
  std::uint64_t divisor = 1;
  for (std::uint64_t power = z; power > 0; power = fixed::multiply(power, square)) {
    sum += power / divisor;
    divisor += 2;
  }
  const fixed::Wide log = fixed::Wide{exponent} * fixed::log_of_two + 2 * fixed::Wide{sum};
  constexpr unsigned surplus = fixed::bits - 40;
  return static_cast<std::int64_t>((log + (fixed::Wide{1} << (surplus - 1))) >> surplus);
}

std::int64_t sum_of_prime_logs(Millionths number) {
  std::int64_t sum = 0;
  for (Millionths divisor = 2; divisor * divisor <= number; ++divisor) {
    if (number % divisor != 0) continue;
    const std::int64_t log = log_of_prime(divisor);
    for (; number % divisor == 0; number /= divisor) sum += log;
  }
  return number > 1 ? sum + log_of_prime(number) : sum;
}

}  // namespace

std::int64_t log_cost(Millionths degree) {
  if (degree == 0) return 0;
  return sum_of_prime_logs(one_million) - sum_of_prime_logs(degree);
}

namespace {

std::optional<std::uint32_t> find(const Texts& names, std::span<const std::uint32_t> by_name,
                                  std::string_view name) {
  const auto found = std::lower_bound(
      by_name.begin(), by_name.end(), name,
      [&](std::uint32_t place, std::string_view wanted) { return names[place] < wanted; });
  if (found == by_name.end() || names[*found] != name) return std::nullopt;
  return *found;
}

}  // namespace

std::optional<std::uint32_t> CompiledCatalog::find_task(std::string_view name) const {
  return find(task_names, tasks_by_name, name);
}

std::optional<std::uint32_t> CompiledCatalog::find_behavior(std::string_view name) const {
  return find(behavior_names, behaviors_by_name, name);
}

std::optional<std::uint32_t> CompiledCatalog::find_variable(std::string_view name) const {
  for (std::uint32_t variable = 0; variable < variables.size(); ++variable) {
    if (name_of_variable(variable) == name) return variable;
  }
  return std::nullopt;
}

std::optional<std::uint32_t> CompiledCatalog::find_value(std::uint32_t variable,
                                                         std::string_view text) const {
  for (std::uint32_t value = 0; value < variables[variable].value_count; ++value) {
    if (name_of_value({variable, value}) == text) return value;
  }
  return std::nullopt;
}

std::span<const FittingValue> CompiledCatalog::fitting_values_of(BehaviorId behavior) const {
  const auto [first, end] = std::equal_range(
      fitting_values.begin(), fitting_values.end(), FittingValue{behavior, 0, 0},
      [](const FittingValue& a, const FittingValue& b) { return a.behavior < b.behavior; });
  return {first, end};
}

std::optional<std::uint32_t> CompiledCatalog::find_misfit(std::span<const FittingValue> fitting,
                                                          std::span<const std::uint32_t> present) {
  for (auto next = fitting.begin(); next != fitting.end();) {
    const std::uint32_t variable = next->variable;
    bool is_fitting = false;
    for (; next != fitting.end() && next->variable == variable; ++next) {
      is_fitting |= next->value == present[variable];
    }
    if (!is_fitting) return variable;
  }
  return std::nullopt;
}

}  // namespace cbc
