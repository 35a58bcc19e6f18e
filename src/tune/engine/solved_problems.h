#pragma once

#include <optional>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/problem.h"
#include "tune/engine/numbers.h"

namespace cbc {

/// A question to the solver, and its answer; empty: there is none.
struct SolvedProblem {
  Problem problem;
  std::optional<Assignment> answer;
};

/// Questions and answers, each once, in the order in which they came: as long as all answers stay,
/// so does all that was decided.
class SolvedProblems {
 public:
  /// `answer`: null: there is none.
  void add(const Problem& problem, const Assignment* answer);
  [[nodiscard]] std::vector<SolvedProblem> take() { return std::move(list_); }

 private:
  std::unordered_set<std::string> known_;
  std::vector<SolvedProblem> list_;
};

/// Whether a task of the catalog may run, with this behavior if there is one, as the domains of a
/// problem say.
[[nodiscard]] bool may_run(const CompiledCatalog& catalog, const Problem& problem, TaskId task,
                           BehaviorId behavior = none);

/// Whether a number plays a part in the decision: what has it may be chosen.
[[nodiscard]] bool uses(const CompiledCatalog& catalog, const Problem& problem,
                        const TunableNumber& number);

}  // namespace cbc
