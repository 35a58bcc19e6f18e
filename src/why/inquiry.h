#pragma once

#include <optional>
#include <span>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/coordinator/record.h"
#include "runtime/coordinator/state.h"
#include "runtime/solver/problem.h"
#include "why/explainer.h"
#include "why/explanation.h"
#include "why/moment.h"
#include "why/unmet.h"

namespace cbc {

/// Asks questions about each event of a coordinator where it is decided, since the state before it
/// is there then, and no time is lost to keep it; and tells of the event with the answers. Whoever
/// listens to the coordinator passes on what it says.
class Inquiry {
 public:
  /// The catalog must outlive it.
  Inquiry(const CompiledCatalog& catalog, Questions questions);

  void on_decision(const EventRecord& record, const Circumstances& circumstances,
                   const Assignment* solution);
  /// The event with the answers, valid until the next one. `state`: after the event.
  [[nodiscard]] const ExplainedRecord& on_event(const EventRecord& record, const State& state);

  /// Whether the questions include those that come later.
  [[nodiscard]] bool keeps_moments() const { return journal_.has_value(); }
  /// Why the values of a group in the present state meet the demands of none of the `ways`. Only if
  /// it keeps moments.
  [[nodiscard]] WhyUnmet why_unmet(const State& present, GroupId group,
                                   std::span<const Demands> ways);

 private:
  [[nodiscard]] bool has_answers(const Problem& problem, const Assignment& solution) const;
  [[nodiscard]] Explainer& explainer();

  const CompiledCatalog& catalog_;
  const Questions questions_;
  std::optional<Explainer> explainer_;  ///< once there is something to explain: it takes memory
  std::optional<Journal> journal_;
  ExplainedRecord record_;
  bool is_decided_ = false;  ///< the next event has been, and the answers are in the record
};

}  // namespace cbc
