// The bound of the search that learns: answers alone show neither how strong it is, nor whether its
// grounds suffice.
#include "runtime/solver/landmark_bound.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/compile/compile.h"
#include "runtime/solver/cost_bound.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/propagation.h"
#include "support/rounds.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc::landmark_bound_test {
namespace {

using test::Random;
using Measure = LandmarkBound::Measure;

constexpr std::int64_t one_nat = std::int64_t{1} << 40;  // -log of f2 = 1/e

/// Random decisions in a random group.
class Branch {
 public:
  Branch(const CompiledCatalog& catalog, const Problem& problem)
      : catalog_(catalog), domains_(catalog), trail_(catalog, domains_) {
    domains_.load(problem);
    is_consistent_ = trail_.load(problem) && trail_.propagate();
    if (is_consistent_) remember_root();
  }

  [[nodiscard]] bool is_consistent() const { return is_consistent_; }
  [[nodiscard]] const Domains& domains() const { return domains_; }
  [[nodiscard]] const CatalogTrail& trail() const { return trail_; }

  /// Decides for a value of a needed task, or for a request. False if nothing is left to decide, or
  /// what is left has no solution.
  bool decide(Random& random, LandmarkBound& bound) {
    std::vector<Literal> choices;
    for (const LocalTask task : domains_.needed_tasks()) {
      if (domains_.count(task) < 2) continue;
      for (std::uint32_t index = 0; index < domains_.values(task).size(); ++index) {
        if (domains_.has(task, index)) choices.push_back(trail_.has_value(task, index));
      }
    }
    for (const LocalTask task : trail_.requests()) {
      const Literal runs = Trail::runs(task);
      if (!trail_.is_true(runs) && !trail_.is_false(runs)) choices.push_back(runs);
    }
    if (choices.empty()) return false;
    bound.begin_level();
    trail_.decide(choices[random.below(choices.size())]);
    is_consistent_ = trail_.propagate();
    return is_consistent_;
  }
  void backtrack_to(std::uint32_t level, LandmarkBound& bound) {
    trail_.backtrack_to(level);
    bound.backtrack_to(level);
    is_consistent_ = true;
  }

  // Plain references. An assignment has the index of a value for each task, or none. Exclusivity
  // and minimum performances do not count.

  /// Calls `use` with each assignment of the domains of level 0 that meets all requirements.
  template <typename Use>
  void for_each_assignment(Use use) const {
    Assignment assignment(root_.size(), none);
    visit(assignment, LocalTask(0), use);
  }
  [[nodiscard]] bool is_possible_now(const Assignment& assignment) const {
    for (LocalTask task(0); task < assignment.size(); ++task) {
      const std::uint32_t index = assignment[task];
      if (index == none ? domains_.needed(task) : !domains_.has(task, index)) return false;
    }
    return true;
  }
  [[nodiscard]] bool holds(const Assignment& assignment, Literal literal) const {
    for (LocalTask task(0); task < assignment.size(); ++task) {
      if (literal == Trail::runs(task)) return assignment[task] != none;
      for (std::uint32_t index = 0; index < domains_.values(task).size(); ++index) {
        if (literal == trail_.has_value(task, index)) return assignment[task] == index;
        if (literal == negate(trail_.has_value(task, index))) return assignment[task] != index;
      }
    }
    ADD_FAILURE() << "grounds say that a task does not run";
    return false;
  }
  [[nodiscard]] std::int64_t cost(LocalTask task, std::uint32_t index, Measure measure) const {
    const Value& value = domains_.value(task, index);
    if (measure == Measure::log) return value.suitability == 0 ? prohibitive_cost : value.cost;
    if (value.cost > 0 || value.suitability == 0) return prohibitive_cost;
    return catalog_.tasks[domains_.first_task() + task].start_on_request == 0 ? 1 : 0;
  }
  [[nodiscard]] std::int64_t cost(const Assignment& assignment, Measure measure) const {
    std::int64_t sum = 0;
    for (LocalTask task(0); task < assignment.size(); ++task) {
      if (assignment[task] == none) continue;
      sum = std::min(prohibitive_cost, sum + cost(task, assignment[task], measure));
    }
    return sum;
  }
  /// By task: the costliest chain of requirements that it cannot avoid, without needed tasks below
  /// it: h^max in planning.
  [[nodiscard]] std::vector<std::int64_t> heights(Measure measure) const {
    std::vector<std::int64_t> heights(domains_.task_count(), unknown);
    for (LocalTask task(0); task < heights.size(); ++task) find_height(task, measure, heights);
    return heights;
  }

 private:
  static constexpr std::int64_t unknown = -1;

  std::int64_t find_height(LocalTask task, Measure measure,
                           std::vector<std::int64_t>& heights) const {
    if (heights[task] != unknown) return heights[task];
    std::int64_t least = prohibitive_cost;
    for (std::uint32_t index = 0; index < domains_.values(task).size(); ++index) {
      if (!domains_.has(task, index)) continue;
      std::int64_t highest = 0;
      for (const LocalTask required : required_by(task, index)) {
        if (domains_.needed(required)) continue;
        highest = std::max(highest, find_height(required, measure, heights));
      }
      least = std::min(least, cost(task, index, measure) + highest);
    }
    return heights[task] = least;
  }

  void remember_root() {
    for (LocalTask task(0); task < domains_.task_count(); ++task) {
      std::vector<std::uint32_t>& values = root_.emplace_back();
      if (!domains_.needed(task)) values.push_back(none);
      for (std::uint32_t index = 0; index < domains_.values(task).size(); ++index) {
        if (domains_.has(task, index)) values.push_back(index);
      }
    }
  }

  [[nodiscard]] std::vector<LocalTask> required_by(LocalTask task, std::uint32_t index) const {
    std::vector<LocalTask> tasks;
    for (const CompiledRequirement& one :
         catalog_.requirements[domains_.value(task, index).behavior]) {
      tasks.push_back(one.task - domains_.first_task());
    }
    return tasks;
  }

  template <typename Use>
  void visit(Assignment& assignment, LocalTask task, Use& use) const {
    if (task == assignment.size()) {
      if (meets_requirements(assignment)) use(assignment);
      return;
    }
    for (const std::uint32_t value : root_[task]) {
      assignment[task] = value;
      visit(assignment, LocalTask(task + 1), use);
    }
  }
  [[nodiscard]] bool meets_requirements(const Assignment& assignment) const {
    for (LocalTask task(0); task < assignment.size(); ++task) {
      if (assignment[task] == none) continue;
      for (const LocalTask required : required_by(task, assignment[task])) {
        if (assignment[required] == none) return false;
      }
    }
    return true;
  }

  const CompiledCatalog& catalog_;
  Domains domains_;
  CatalogTrail trail_;
  bool is_consistent_ = false;
  std::vector<std::vector<std::uint32_t>> root_;  ///< by task: its domain at level 0
};

struct Tally {
  int bounds = 0;
  int above_heights = 0;
  int grounds = 0;
  int prohibitive = 0;
};

/// A raised bound reaches the heights.
void check_heights(const Branch& branch, LandmarkBound& bound, Measure measure, Tally& tally) {
  const std::int64_t value = bound.raise(INT64_MAX);
  const std::vector<std::int64_t> heights = branch.heights(measure);
  std::int64_t highest = 0;
  for (const LocalTask task : branch.domains().needed_tasks()) {
    highest = std::max(highest, heights[task]);
  }
  ++tally.bounds;
  if (highest >= prohibitive_cost) ++tally.prohibitive;
  if (value > highest) ++tally.above_heights;
  EXPECT_GE(value, std::min(highest, prohibitive_cost));
}

/// What a raised bound says must hold for each assignment.
void check_bound(const Branch& branch, LandmarkBound& bound, Measure measure) {
  const std::int64_t value = bound.raise(INT64_MAX);
  branch.for_each_assignment([&](const Assignment& assignment) {
    const std::int64_t cost = branch.cost(assignment, measure);
    if (cost >= prohibitive_cost || !branch.is_possible_now(assignment)) return;
    std::int64_t with_residuals = value;
    for (LocalTask task(0); task < assignment.size(); ++task) {
      const std::uint32_t index = assignment[task];
      if (index != none) with_residuals += bound.residual(task, index);
    }
    ASSERT_GE(cost, with_residuals);
  });
}

void check_grounds(const Branch& branch, const std::vector<Literal>& grounds, std::int64_t least,
                   Measure measure, Tally& tally) {
  for (const Literal literal : grounds) EXPECT_TRUE(branch.trail().is_true(literal));
  ++tally.grounds;
  branch.for_each_assignment([&](const Assignment& assignment) {
    const auto holds = [&](Literal literal) { return branch.holds(assignment, literal); };
    if (!std::all_of(grounds.begin(), grounds.end(), holds)) return;
    ASSERT_GE(branch.cost(assignment, measure), least);
  });
}

class LandmarkBoundTest : public testing::Test {
 protected:
  /// Follows branches of a random problem down and up again, and checks the bound of each node.
  void follow(Random& random, const test::Shape& shape, Measure measure) {
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    const Problem problem = test::random_problem(random, catalog, test::largest_group(catalog));
    Branch branch(catalog, problem);
    if (!branch.is_consistent()) return;
    LandmarkBound bound(catalog, branch.domains(), branch.trail());
    bound.load();
    bound.set_measure(measure);
    for (int move = 0; move < 8; ++move) {
      check_heights(branch, bound, measure, tally_);
      check_bound(branch, bound, measure);
      const std::int64_t value = bound.raise(INT64_MAX);
      if (branch.trail().level() > 0) {
        const std::int64_t most = std::min(value, 8 * one_nat);
        const std::int64_t slack = random.below(2) == 0 ? 0 : random.between(0, most);
        std::vector<Literal> grounds;
        bound.append_grounds(slack, grounds);
        check_grounds(branch, grounds, value - slack, measure, tally_);
        const std::uint32_t saved = bound.save_grounds(slack);
        std::vector<Literal> later;
        bound.append_saved_grounds(saved, later);
        EXPECT_EQ(later, grounds);
      }
      expect_same_as_anew(catalog, branch, bound, measure);
      const std::uint32_t level = branch.trail().level();
      if (!branch.decide(random, bound)) {
        if (level == 0) return;
        branch.backtrack_to(static_cast<std::uint32_t>(random.below(level)), bound);
        EXPECT_TRUE(bound.level() == none || bound.level() <= branch.trail().level());
      }
    }
  }

  /// Another object, which has seen nothing else, has the same bound and residuals.
  void expect_same_as_anew(const CompiledCatalog& catalog, const Branch& branch,
                           LandmarkBound& bound, Measure measure) {
    LandmarkBound anew(catalog, branch.domains(), branch.trail());
    anew.load();
    anew.set_measure(measure);
    EXPECT_EQ(bound.raise(INT64_MAX), anew.raise(INT64_MAX));
    EXPECT_EQ(bound.level(), branch.trail().level());
    for (LocalTask task(0); task < branch.domains().task_count(); ++task) {
      for (std::uint32_t index = 0; index < branch.domains().values(task).size(); ++index) {
        EXPECT_EQ(bound.residual(task, index), anew.residual(task, index));
      }
    }
  }

  Tally tally_;
};

TEST_F(LandmarkBoundTest, LiesBetweenHeightsAndCostsOnRandomBranches) {
  Random random(1);
  for (int round = 0; round < test::rounds(600); ++round) {
    SCOPED_TRACE(round);
    test::Shape shape;
    shape.tasks = 4 + static_cast<std::uint32_t>(random.below(3));
    shape.exclusivity_lists = static_cast<std::uint32_t>(random.below(2));
    shape.is_deep = random.below(2) == 0;
    shape.on_request = 10;
    shape.zero = random.below(3) == 0 ? 10 : 0;
    shape.any_percent = random.below(2) == 0 ? 80 : 0;
    follow(random, shape, random.below(4) == 0 ? Measure::idle : Measure::log);
    if (HasFailure()) return;
  }
  EXPECT_GE(tally_.bounds, test::rounds(1'000));
  EXPECT_GE(tally_.above_heights, test::rounds(300));
  EXPECT_GE(tally_.grounds, test::rounds(500));
  EXPECT_GE(tally_.prohibitive, test::rounds(10));
}

TEST_F(LandmarkBoundTest, ReachesTheHeightsInLargeGroups) {
  Random random(2);
  for (int round = 0; round < test::rounds(60); ++round) {
    SCOPED_TRACE(round);
    test::Shape shape;
    shape.tasks = 150;
    shape.exclusivity_lists = 0;
    shape.minimum = 0;
    shape.is_deep = true;
    shape.on_request = 0;
    shape.zero = 0;
    shape.any_percent = 80;
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    const Problem problem = test::random_problem(random, catalog, test::largest_group(catalog));
    Branch branch(catalog, problem);
    if (!branch.is_consistent()) continue;
    LandmarkBound bound(catalog, branch.domains(), branch.trail());
    bound.load();
    for (int level = 0; level < 5; ++level) {
      check_heights(branch, bound, Measure::log, tally_);
      expect_same_as_anew(catalog, branch, bound, Measure::log);
      if (!branch.decide(random, bound)) break;
    }
  }
  EXPECT_GE(tally_.bounds, test::rounds(100));
}

TEST_F(LandmarkBoundTest, AnAscentEndsWhenNoTimeIsLeftAndCanGoOn) {
  const CompiledCatalog catalog = test::compile_text(test::chain_of_alternatives(300));
  Problem problem = test::open_problem(catalog);
  test::demand(problem, catalog, "T0");
  const Branch branch(catalog, problem);
  LandmarkBound bound(catalog, branch.domains(), branch.trail());
  bound.load();
  SearchBudget budget;
  budget.deadline = std::chrono::steady_clock::now();
  const std::int64_t first = bound.raise(INT64_MAX, budget);
  EXPECT_LT(first, branch.heights(Measure::log)[test::local_task(catalog, "T0")]);
  budget.deadline = std::chrono::steady_clock::now() + std::chrono::hours(1);
  check_heights(branch, bound, Measure::log, tally_);
  expect_same_as_anew(catalog, branch, bound, Measure::log);
  EXPECT_EQ(bound.raise(INT64_MAX, budget), bound.raise(INT64_MAX));
}

TEST_F(LandmarkBoundTest, TheBoundOfAReportHoldsInAVeryLargeGroup) {
  const CompiledCatalog catalog = test::compile_text(test::chain_of_alternatives(6'000));
  Problem problem = test::open_problem(catalog);
  test::demand(problem, catalog, "T0");
  const Branch branch(catalog, problem);
  LandmarkBound bound(catalog, branch.domains(), branch.trail());
  bound.load();
  const std::int64_t lower = bound.bound_again();
  EXPECT_GT(lower, 0);
  EXPECT_LT(lower, branch.heights(Measure::log)[test::local_task(catalog, "T0")])
      << "all of it takes 18 million steps";
}

}  // namespace
}  // namespace cbc::landmark_bound_test
