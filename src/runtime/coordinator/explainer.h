#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/problem_builder.h"
#include "coordinator/record.h"
#include "coordinator/state.h"
#include "explain/alternatives.h"
#include "explain/reasons.h"
#include "solver/problem.h"

namespace cbc {

/// An event and what was found out about it.
struct Circumstances {
  const State& state;  ///< before the event
  const Trigger& trigger;
  std::int32_t protection = 0;         ///< the level that was tried last
  std::span<const BehaviorId> failed;  ///< may not be chosen any more in this event
};

/// A minimal set of reasons why the event allows for none of the `ways`: together they leave no
/// solution, and with any one of them left out there is one. Empty if the event alone leaves none,
/// nothing where the set is beyond reach (a group with very many constraints).
[[nodiscard]] std::optional<std::vector<Reason>> find_reasons(const CompiledCatalog& catalog,
                                                              const Circumstances& circumstances,
                                                              std::span<const Demands> ways);

/// The same for a start or stop that has no solution at all. Empty where the set is beyond reach.
[[nodiscard]] std::vector<Reason> find_conflict(const CompiledCatalog& catalog,
                                                const Circumstances& circumstances);

/// Explains accepted answers, by searching for the best alternatives. Allocates on every event.
class Explainer {
 public:
  /// `ranks`: those of the solver. All but the options must outlive the explainer.
  Explainer(const CompiledCatalog& catalog, const std::vector<std::uint32_t>& ranks,
            ExplanationOptions options);

  /// `circumstances`: before the answer is taken over into the state. `solution` is proven best.
  void explain(const Circumstances& circumstances, const Problem& problem,
               const Assignment& solution, Explanation& explanation);

 private:
  [[nodiscard]] bool is_in_group(const Subject& subject, std::uint32_t group) const;
  [[nodiscard]] ObjectiveValues elsewhere(const State& state, std::uint32_t group) const;
  void explain_displaced(const Circumstances& circumstances, const Problem& problem,
                         Explanation& explanation);
  void explain_task(const Circumstances& circumstances, TaskId task, Explanation& explanation);
  void explain_behavior(const Circumstances& circumstances, BehaviorId behavior,
                        Explanation& explanation);
  [[nodiscard]] WhyNot why_not(const Circumstances& circumstances, const Configuration& chosen,
                               std::span<const Demands> ways);

  const CompiledCatalog& catalog_;
  const ExplanationOptions options_;
  ConfigurationSearch search_;
};

}  // namespace cbc
