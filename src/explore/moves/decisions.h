#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "explore/model/model.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/solver.h"

namespace cbc {

/// What the answer of one event in one group depends on, and nothing else. Bit sets are those of
/// the model; only bits of the group are set.
struct GroupQuestion {
  std::uint32_t group = 0;                  ///< place in Model::groups
  std::uint32_t finished = none;            ///< the behavior that has just finished
  const Word* domains = nullptr;            ///< values
  const Word* must_run = nullptr;           ///< tasks that may not stop
  const Word* present = nullptr;            ///< values
  std::span<const std::uint16_t> requests;  ///< tasks, as in Problem
  std::uint32_t suspended = 0;              ///< as in Problem
  std::uint32_t unasked = 0;                ///< as in Problem
  /// Whether a solution with which what was asked for runs worse than now is none.
  bool must_not_make_worse = false;
};

/// Told of each question that the solver was asked, and of its answer; null: there is none.
using DecisionListener = std::function<void(const Problem& problem, const Assignment* answer)>;

/// Answers questions, and remembers the answers: the moves of an exploration ask few different
/// ones, so almost all are looked up. Where all requests are satisfied, or there is no solution,
/// their order decides nothing: such an answer holds for all orders. Not for use by several
/// threads.
class Decisions {
 public:
  /// Beyond `most_bytes` of answers, all are forgotten. `listener` may be empty.
  explicit Decisions(const Model& model, std::size_t most_bytes = std::size_t{256} << 20U,
                     DecisionListener listener = {})
      : Decisions(model, model.catalog(), most_bytes, std::move(listener)) {}
  /// About a catalog that has the tasks, behaviors and values of the model, and no constraint that
  /// its catalog has not. It must outlive this object, as the model must.
  Decisions(const Model& model, const CompiledCatalog& catalog, std::size_t most_bytes,
            DecisionListener listener = {});
  Decisions(const Decisions&) = delete;
  Decisions& operator=(const Decisions&) = delete;

  /// The values of the best solution; null: there is none. Valid until the next call.
  [[nodiscard]] const Word* find(const GroupQuestion& question);

  [[nodiscard]] std::uint64_t remembered() const { return remembered_; }
  [[nodiscard]] std::uint64_t computed() const { return computed_; }

 private:
  /// What is remembered of a question: there is no solution, there is one, or it depends on the
  /// order of the requests.
  enum Memory : Word { infeasible, solved, ordered };

  void write_key(const GroupQuestion& question, bool is_ordered);
  void sort_by_class(std::uint16_t* begin, std::uint16_t* end) const;
  [[nodiscard]] std::uint64_t hash() const;
  /// The entry of the key, or null; and the slot where it is or belongs.
  [[nodiscard]] const Word* look_up(std::uint64_t hash, std::size_t& slot) const;
  const Word* remember(Memory memory);
  [[nodiscard]] bool satisfies_all(const GroupQuestion& question) const;
  void load_problem(const GroupQuestion& question);
  void grow();
  void forget();

  const Model& model_;
  const std::size_t most_bytes_;
  const DecisionListener listener_;
  Solver solver_;
  AskedProduct asked_;
  Problem problem_;
  Assignment solution_;
  std::size_t value_words_;
  std::size_t task_words_;
  std::size_t key_words_;
  std::size_t entry_words_;  ///< the key, the Memory, and the values of the solution
  std::vector<Word> key_;
  std::vector<std::uint16_t> sorted_;
  std::vector<Word> entries_;
  std::vector<std::uint64_t>
      slots_;  ///< the number of an entry + 1, below the high bits of its hash
  std::uint64_t remembered_ = 0;
  std::uint64_t computed_ = 0;
};

/// A hash of some words.
[[nodiscard]] inline std::uint64_t mix_hash(std::uint64_t hash, std::uint64_t word) {
  constexpr std::uint64_t factor = 0x9e3779b97f4a7c15U;
  hash = (hash ^ word) * factor;
  return hash ^ (hash >> 32U);
}

}  // namespace cbc
