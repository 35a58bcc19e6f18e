#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ask/conflict/reasons.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/problem.h"
#include "runtime/solver/solver.h"

namespace cbc {

/// A solution of the problem of a group, with its objectives.
struct Configuration {
  Assignment assignment;
  ObjectiveValues objective;
  /// The suitabilities of what was asked for, apart from 1, where something runs unasked.
  AskedProduct::Factors asked;
};

/// What decides between two solutions, in order.
enum class Criterion : std::uint8_t {
  requests,       ///< f1
  request_order,  ///< the first request that only one of them satisfies
  asked,          ///< the suitability of what was asked for, where something runs unasked
  suitability,    ///< f2
  idle,           ///< f3
  changes,        ///< f4
  canonical       ///< the first task with different values
};

[[nodiscard]] std::string_view name_of(Criterion criterion);

/// How two solutions compare.
struct Difference {
  Criterion criterion = Criterion::canonical;
  bool first_is_better = false;
  TaskId task = none;        ///< of request_order: satisfied by the better one; of canonical
  TaskId other_task = none;  ///< of request_order: the first satisfied by the worse one only
};

/// Compares solutions of one problem by the objectives, exactly. It shares nothing with the search
/// but the canonical order.
class Comparison {
 public:
  explicit Comparison(const CompiledCatalog& catalog)
      : catalog_(catalog), order_(catalog), asked_(catalog) {}

  /// Sets the problem, which must outlive its use. `elsewhere`: the objectives of all other
  /// groups, but for idle_total, which is that of the whole catalog.
  void load(const Problem& problem, const ObjectiveValues& elsewhere);

  [[nodiscard]] Configuration evaluate(Assignment assignment);

  /// The two must differ.
  [[nodiscard]] Difference compare(const Configuration& a, const Configuration& b);

 private:
  [[nodiscard]] std::uint32_t count_changes(const Assignment& assignment) const;
  [[nodiscard]] bool decide_by_order(const Configuration& a, const Configuration& b,
                                     std::span<const LocalTask> requests, Difference& difference);
  [[nodiscard]] std::strong_ordering compare_suitability(const Assignment& a, const Assignment& b);

  const CompiledCatalog& catalog_;
  CanonicalOrder order_;
  AskedProduct asked_;
  const Problem* problem_ = nullptr;
  ObjectiveValues elsewhere_;
  TaskId first_task_;
  ExactProduct first_;
  ExactProduct second_;
};

/// Finds the best solutions of a problem, under demands too, within a limit of effort that does not
/// depend on the clock.
class ConfigurationSearch {
 public:
  /// The catalog must outlive the search.
  explicit ConfigurationSearch(const CompiledCatalog& catalog);

  /// Sets the problem, which must outlive its use. See Comparison for `elsewhere`.
  void load(const Problem& problem, const ObjectiveValues& elsewhere);

  /// The best of the solutions that meet the demands of one of the `ways`; none if there is none.
  /// Meaningless if is_cut().
  [[nodiscard]] std::optional<Configuration> find_best(std::span<const Demands> ways);

  /// The `count` best solutions, or all if there are fewer, `best` first. Left out are those in
  /// which a supporting task runs for nothing: that nobody requested, and nothing requires. If
  /// is_cut(), only those that are certain.
  [[nodiscard]] std::vector<Configuration> list_best(const Assignment& best, std::size_t count);

  /// Whether the last answer is incomplete: the limit of effort came first.
  [[nodiscard]] bool is_cut() const { return is_cut_; }

  [[nodiscard]] Comparison& comparison() { return comparison_; }

 private:
  /// A subproblem, and its best solution.
  struct Subproblem {
    Problem problem;
    Configuration best;
  };

  void begin();
  [[nodiscard]] std::optional<Configuration> solve(const Problem& problem);
  void split(Subproblem subproblem, std::size_t most, std::vector<Subproblem>& open);
  void add(Problem problem, std::size_t most, std::vector<Subproblem>& open);
  [[nodiscard]] TaskId find_needless(const Assignment& assignment) const;
  void insert(Subproblem subproblem, std::size_t most, std::vector<Subproblem>& open);

  const CompiledCatalog& catalog_;
  Solver solver_;
  Comparison comparison_;
  const Problem* whole_ = nullptr;
  std::uint64_t effort_ = 0;
  bool is_cut_ = false;
};

}  // namespace cbc
