#include "core/report/answer_bound.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/report/suitability.h"

namespace cbc {

AnswerBound bound_of_answer(const CompiledCatalog& catalog, const EventRecord& record,
                            const State& state) {
  const std::uint32_t group = record.search->group;
  const SearchBound& bound = record.search->result.bound;
  const Assignment nothing(catalog.group_tasks[group + 1] - catalog.group_tasks[group], none);
  const double elsewhere = total_suitability(catalog, state, group, nothing);
  // Up by more than the rounding of both factors and of the product.
  constexpr double above_rounding = 1 + 1e-15;
  const double product = std::min(1.0, elsewhere * bound.suitability * above_rounding);
  return {record.objective->satisfied + bound.more_requests,
          std::max(product, total_suitability(catalog, state))};
}

std::string describe_bound(const CompiledCatalog& catalog, const EventRecord& record,
                           const State& state) {
  const SearchBound& bound = record.search->result.bound;
  if (bound.more_requests > 0) {
    return fmt::format("the best may serve {} more {}", bound.more_requests,
                       bound.more_requests == 1 ? "request" : "requests");
  }
  if (!bound.same_requests) return "the best may serve other requests";
  const double suitability = total_suitability(catalog, state);
  if (suitability == 0) return {};
  const double best = bound_of_answer(catalog, record, state).suitability;
  if (best <= suitability) return "no suitability is higher";
  // Less than a percent is one, as percentages are rounded up.
  return fmt::format("within {} % of the best", std::ceil(100 * (best - suitability) / best));
}

}  // namespace cbc
