#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ask/conflict/reasons.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"
#include "why/alternatives.h"
#include "why/explanation.h"

namespace cbc {

/// Explains answers that are proven best, by a search for the best alternatives. All that it needs
/// to know of an event are the circumstances, with the state before it: whether they are those of
/// the present event or of one that was kept (Moment) makes no difference. Allocates on every
/// event.
class Explainer {
 public:
  /// The catalog must outlive the explainer.
  explicit Explainer(const CompiledCatalog& catalog) : catalog_(catalog), search_(catalog) {}

  /// Answers the questions about accepted events.
  void explain(const Circumstances& circumstances, const Assignment& solution,
               const Questions& questions, Explanation& explanation);

  /// Why the answer meets the demands of none of the `ways`. `chosen` receives the answer with its
  /// objectives.
  [[nodiscard]] WhyNot ask(const Circumstances& circumstances, const Assignment& solution,
                           std::span<const Demands> ways, Configuration& chosen);

  /// For tasks that do not run, but are in the queue after the event, and for their behaviors:
  /// replaces the explanation by what hinders their start, if anything does. `state`: after the
  /// event.
  void explain_queued(const State& state, Explanation& explanation) const;

 private:
  void load(const Circumstances& circumstances, const Assignment& solution, Configuration& chosen);
  [[nodiscard]] TaskId queued_task(const State& state, BehaviorId behavior) const;
  [[nodiscard]] bool is_in_group(const Subject& subject, GroupId group) const;
  void explain_displaced(const Circumstances& circumstances, Explanation& explanation);
  void explain_task(const Circumstances& circumstances, TaskId task, Explanation& explanation);
  void explain_behavior(const Circumstances& circumstances, BehaviorId behavior,
                        Explanation& explanation);
  void explain_better(const Circumstances& circumstances, TaskId task, std::uint32_t index,
                      const Configuration& chosen, std::vector<BetterBehavior>& better);
  [[nodiscard]] WhyNot why_not(const Circumstances& circumstances, const Configuration& chosen,
                               std::span<const Demands> ways);

  const CompiledCatalog& catalog_;
  ConfigurationSearch search_;
};

}  // namespace cbc
