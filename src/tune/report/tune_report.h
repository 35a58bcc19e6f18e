#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/property/properties.h"
#include "core/report/blocks.h"
#include "tune/engine/tuner.h"

// The reports of `cbc tune`.

namespace cbc {

struct TunedNumber {
  Tolerance tolerance;
  Repairs repairs;
  bool is_used = true;  ///< something has the number, and some decision of a state uses it
};

/// Where all reachable states were looked at in place of missions.
struct TunedStates {
  std::uint64_t states = 0;
  std::uint64_t transitions = 0;
  std::size_t decisions = 0;  ///< different ones
  const PropertyFile& file;
};

struct TuneResult {
  const Catalog& source;
  const CompiledCatalog& catalog;  ///< of the source
  const std::vector<TunableNumber>& numbers;
  const Recording& present;           ///< of no missions, if all states were looked at
  std::vector<std::string> missions;  ///< their files
  std::vector<TunedNumber> tuned;     ///< by number
  std::optional<Millionths> fail_under;
  std::optional<TunedStates> states;

  [[nodiscard]] bool is_fragile(std::size_t number) const {
    const auto distance = tuned[number].tolerance.distance(numbers[number].value);
    return fail_under && distance && *distance < *fail_under;
  }
};

/// A number, by its place, and one of its repairs.
struct FoundRepair {
  std::size_t number = 0;
  const NumberRepair* repair = nullptr;
  Millionths change = 0;
};
/// The nearest repair of each number that has one, the smallest change first.
[[nodiscard]] std::vector<FoundRepair> nearest_repairs(const TuneResult& result);

// Parts of reports in words.

/// The difference, with its place, and the expectation that then fails, if there is one.
[[nodiscard]] std::string describe(const TuneResult& result, const RunDifference& difference);
/// Of a state: the moves that lead to it, the last of which is different.
[[nodiscard]] std::vector<std::string> moves_to(const TuneResult& result,
                                                const RunDifference& difference);
/// "mission.yaml:4:3: expected ..."
[[nodiscard]] std::string describe(const TuneResult& result, const Recording::Failure& failure);
/// The first one is the default.
[[nodiscard]] std::span<const ReportFormat<TuneResult>> tune_formats();

[[nodiscard]] std::string tune_to_json(const TuneResult& result);
[[nodiscard]] std::string tune_schema();
/// A page with each number as a bar.
[[nodiscard]] std::string tune_to_html(const TuneResult& result);

}  // namespace cbc
