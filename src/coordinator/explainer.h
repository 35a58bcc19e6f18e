#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/conflict.h"
#include "coordinator/explanation.h"
#include "coordinator/state.h"
#include "explain/configuration_search.h"
#include "explain/demand.h"
#include "solver/problem.h"

namespace cbc {

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
