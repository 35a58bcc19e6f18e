#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "cbc/units.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"

// Objectives as numbers for reports.

namespace cbc {

/// The suitability objective of a state: the product of the suitabilities of all running tasks, as
/// the nearest double (docs/semantics.md, "Objectives").
[[nodiscard]] double total_suitability(const CompiledCatalog& catalog, const State& state);

/// The same, with another configuration of one group.
[[nodiscard]] double total_suitability(const CompiledCatalog& catalog, const State& state,
                                       GroupId group, const Assignment& places);

/// The same, as an exact decimal number. If a suitability outside the group is 0, only the group
/// counts, since the product could not tell its configurations apart.
[[nodiscard]] std::string exact_suitability(const CompiledCatalog& catalog, const State& state,
                                            GroupId group, const Assignment& places);

/// The product of some suitabilities, from 0 to 1, as the nearest double.
[[nodiscard]] double product_of(std::span<const Millionths> suitabilities);

/// The same, as an exact decimal number.
[[nodiscard]] std::string exact_product(std::span<const Millionths> suitabilities);

/// The product of some suitabilities, in percent, with up to 4 decimals; the rest is cut off, so
/// that a number below a limit does not look as if it reached it.
[[nodiscard]] std::string percent_of_product(std::span<const Millionths> suitabilities);

/// An exact number, shortened.
[[nodiscard]] std::string shorten_number(const std::string& number);
/// Two exact numbers, shortened as far as one can still see which is the larger one.
[[nodiscard]] std::pair<std::string, std::string> shorten_both(const std::string& a,
                                                               const std::string& b);

/// The idle objective: of the supporting tasks, which are those without start_on_request, the share
/// that does not run.
[[nodiscard]] double idle_share(const ObjectiveValues& objective);

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
