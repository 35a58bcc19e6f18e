#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "explain/configuration.h"
#include "solver/canonical_order.h"
#include "solver/exact_product.h"
#include "solver/problem.h"

namespace cbc {

/// What decides between two solutions, in order.
enum class Criterion : std::uint8_t {
  requests,       ///< f1
  request_order,  ///< the first request that only one of them satisfies
  suitability,    ///< f2
  idle,           ///< f3
  changes,        ///< f4
  canonical       ///< the first task with different values
};

[[nodiscard]] std::string_view name_of(Criterion criterion);

/// How two solutions compare.
struct Difference {
  Criterion criterion = Criterion::canonical;
  bool first_is_better = false;
  TaskId task = none;        ///< of request_order: satisfied by the better one; of canonical
  TaskId other_task = none;  ///< of request_order: the first satisfied by the worse one only
};

/// Compares solutions of one problem by the objectives, exactly. It shares nothing with the search
/// but the canonical order.
class Comparison {
 public:
  Comparison(const CompiledCatalog& catalog, const std::vector<std::uint32_t>& ranks)
      : catalog_(catalog), order_(catalog, ranks) {}

  /// Takes up a problem, which must outlive its use. `elsewhere`: the objectives of all that is
  /// outside the group; idle_total is that of the whole catalog.
  void load(const Problem& problem, const ObjectiveValues& elsewhere);

  [[nodiscard]] Configuration evaluate(Assignment places) const;

  /// The two differ.
  [[nodiscard]] Difference compare(const Configuration& a, const Configuration& b);

 private:
  [[nodiscard]] std::uint32_t count_changes(const Assignment& places) const;
  [[nodiscard]] std::strong_ordering compare_suitability(const Assignment& a, const Assignment& b);

  const CompiledCatalog& catalog_;
  CanonicalOrder order_;
  const Problem* problem_ = nullptr;
  ObjectiveValues elsewhere_;
  TaskId first_task_ = 0;
  ExactProduct first_;
  ExactProduct second_;
};

}  // namespace cbc
