#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/catalog/reader.h"
#include "runtime/compiled/compiled_catalog.h"

namespace cbc {

/// A number that somebody estimated: a place of the file with a suitability or a minimum
/// performance. It may stand for several of them, or for none; an alias that is one here and the
/// other there makes two numbers of its place.
struct TunableNumber {
  using Kind = NumberPlace::Kind;
  /// What has the number: the pair of a behavior and a task that it performs or requires, or a
  /// task.
  struct Use {
    std::uint32_t behavior = none;  ///< none: it is the minimum of the task itself
    std::uint32_t entry = 0;        ///< among what the behavior performs, or requires
    TaskIndex task = 0;
  };

  Kind kind = Kind::suitability;
  bool is_default = false;
  Millionths value = 0;
  std::optional<Range>
      range;  ///< of the scalar; empty: the default of suitabilities, written nowhere
  std::vector<Use> uses;

  [[nodiscard]] std::uint32_t line() const { return range ? range->begin.line : 0; }
};

/// All numbers of a catalog without errors, in the order of the file.
[[nodiscard]] std::vector<TunableNumber> find_numbers(const CatalogReading& reading);

/// The behavior, the task that all pairs with the number share; none if there is no such one.
[[nodiscard]] std::uint32_t behavior_of(const TunableNumber& number);
[[nodiscard]] std::uint32_t task_of(const TunableNumber& number);

/// "suitability of DRIVE_FAST for DRIVE", "minimum of LOCALIZE for DRIVE_FAST"
[[nodiscard]] std::string describe(const TunableNumber& number, const Catalog& catalog);

/// Gives a number another value, in memory.
void set_number(Catalog& catalog, const TunableNumber& number, Millionths value);

}  // namespace cbc
