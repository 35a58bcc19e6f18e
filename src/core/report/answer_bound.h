#pragma once

#include <cstdint>
#include <string>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"

namespace cbc {

/// What the best answer to an event reaches at most, over the whole catalog: of an answer that is
/// not proven (docs/semantics.md, "Search limits").
struct AnswerBound {
  std::uint32_t satisfied = 0;  ///< requests, for f1
  double suitability = 1;       ///< for f2; never below that of the answer
};

/// `record`: of an event with a feasible answer; `state`: after it.
[[nodiscard]] AnswerBound bound_of_answer(const CompiledCatalog& catalog, const EventRecord& record,
                                          const State& state);

/// The same in words: "within 3 % of the best". Empty if there is nothing to compare, as the
/// suitability of the answer is 0.
[[nodiscard]] std::string describe_bound(const CompiledCatalog& catalog, const EventRecord& record,
                                         const State& state);

}  // namespace cbc
