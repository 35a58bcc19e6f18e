#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/catalog/catalog.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/derive.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/solver.h"
#include "tune/engine/numbers.h"
#include "tune/engine/solved_problems.h"

namespace cbc {

/// Answers recorded questions with another value of a number, so that no mission has to run again
/// to see whether it matters. The values of a task may be in another order than in the recorded
/// catalog.
class ChangedSolver {
 public:
  /// `catalog` has the other value already. All but `catalog` and `costs` must outlive the solver.
  ChangedSolver(const CompiledCatalog& recorded, const Catalog& catalog,
                const TunableNumber& number, KnownCosts& costs);

  /// Whether the answer is the recorded one.
  [[nodiscard]] bool keeps(const SolvedProblem& decision);
  /// Whether an assignment that is possible with this suitability might be as good as the recorded
  /// answer with a lower one, although it has the number less often, but not never. False is
  /// certain.
  [[nodiscard]] bool may_be_beaten(const SolvedProblem& decision, Millionths lower);

 private:
  [[nodiscard]] std::uint32_t place(TaskId task, std::uint32_t recorded) const {
    return recorded == none ? none : places_[recorded_.values.begin[task] + recorded];
  }
  [[nodiscard]] bool has_number(TaskId task, std::uint32_t index) const {
    return index != none && has_number_[catalog_.values.begin[task] + index] != 0;
  }
  void translate(const SolvedProblem& decision);
  [[nodiscard]] bool may_be_beaten(Millionths lower, std::size_t next, std::size_t chosen);
  [[nodiscard]] bool is_worse(Millionths lower, std::size_t chosen);

  const CompiledCatalog& recorded_;
  const CompiledCatalog catalog_;
  Solver solver_;
  std::vector<std::uint32_t>
      places_;  ///< by value of the recorded catalog: where it is in its task
  std::vector<std::uint8_t> has_number_;  ///< by value
  // Of the present decision:
  TaskId first_;
  Problem problem_;
  Assignment answer_;  ///< the recorded one
  Assignment solution_;
  Millionths value_ = 0;          ///< of the number
  std::vector<LocalTask> tasks_;  ///< that may have the number
  std::size_t count_ = 0;         ///< of them in the answer
  std::size_t searches_ = 0;
  ExactProduct ours_;
  ExactProduct theirs_;
};

}  // namespace cbc
