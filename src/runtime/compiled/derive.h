#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cbc/units.h"
#include "runtime/base/disjoint_sets.h"
#include "runtime/compiled/compiled_catalog.h"

/// Compiled catalogs while they are made: their arrays as vectors, and how most of these arrays
/// follow from the others. The compiler fills them in with these functions, and the verification of
/// a file compares them with what the functions make of the rest.

namespace cbc {

// Suitabilities and performances as costs, so that products become sums: their logarithms, and
// back. Computed with integers, as the functions of a math library may differ in the last bit from
// machine to machine, and compiled catalogs must not.

/// -ln(degree / 10^6) in units of 2^-40, for degree in [1, 10^6]; 0 for degree 0, which callers
/// handle separately.
///
/// It is built from the rounded logarithms of the prime factors, so equal products of degrees have
/// equal sums of costs, to the bit; sums of different products that are further apart than
/// log_cost_error for each factor other than 1 are in the right order. Closer sums are compared by
/// exact products; see docs/semantics.md, "Performance".
[[nodiscard]] std::int64_t log_cost(Millionths degree);

/// Bound on the error of one log_cost: at most 19 + 12 prime factors, each half a unit off.
inline constexpr std::int64_t log_cost_error = 16;

/// At least the product of up to `factors` suitabilities whose costs, by log_cost, have a sum of
/// `cost` or more. The same on all machines.
[[nodiscard]] double highest_product(std::int64_t cost, std::uint32_t factors);

/// Rows that are being made.
template <typename T>
struct GrowingRows {
  std::vector<std::uint32_t> begin{0};
  std::vector<T> items;

  [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
  [[nodiscard]] std::span<const T> operator[](std::size_t row) const {
    return {items.data() + begin[row], items.data() + begin[row + 1]};
  }
  void close_row() { begin.push_back(static_cast<std::uint32_t>(items.size())); }
  template <typename Row>
  void add_row(const Row& row) {
    items.insert(items.end(), row.begin(), row.end());
    close_row();
  }
};

template <typename T>
using Vector = std::vector<T>;

/// A catalog that is being made.
using GrowingCatalog = CatalogArrays<Vector, GrowingRows>;

/// A catalog that uses these arrays, and keeps them. The texts have all names and the source.
[[nodiscard]] CompiledCatalog to_catalog(GrowingCatalog made);

/// Derives the groups and all ids: group_tasks, group_behaviors, task_ids and behavior_ids.
/// `connected` has the tasks, by their place in the catalog; `tasks_of_behaviors` has, for each
/// behavior in catalog order, one of the tasks that it performs.
void derive_groups(GrowingCatalog& catalog, const DisjointSets& connected,
                   std::span<const std::uint32_t> tasks_of_behaviors);

/// Derives everything else but costs, from the groups and
/// - of tasks: minimum_performance;
/// - values, in rank order: behavior and suitability;
/// - requirements, by ascending task: task and minimum_performance;
/// - cliques and limited, with ascending tasks.
///
/// The requirements are not cyclic.
void derive_rest(GrowingCatalog& catalog);

/// The same from arrays that lie elsewhere, apart from `out`, which has the groups, and copies of
/// the tasks and behaviors.
///
/// Fails, and says why, if requirements are cyclic, or if more masks than the given ones are
/// needed, of which there may be far more than of anything else. So it takes time linear in the
/// size of all arrays.
[[nodiscard]] std::optional<std::string> derive_rest(const CatalogArrays<View, Rows>& given,
                                                     GrowingCatalog& out);

/// log_cost with a small memory: catalogs have few different degrees.
class KnownCosts {
 public:
  std::int64_t of(Millionths degree) {
    Entry& entry = entries_[(degree * 2654435769U) >> 24U];
    if (entry.degree != degree) entry = {degree, log_cost(degree)};
    return entry.cost;
  }

 private:
  struct Entry {
    Millionths degree = 0;  ///< an entry that is not in use says what is true of 0
    std::int64_t cost = 0;
  };
  std::array<Entry, 256> entries_{};
};

}  // namespace cbc
