// The parts of the search that learns, on random branches: each inference and each no-good against
// all solutions, or the best one, and what is inferred against the propagator of branch and bound.
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/compile/compile.h"
#include "runtime/coordinator/problem_builder.h"
#include "runtime/solver/components.h"
#include "runtime/solver/conflict_analysis.h"
#include "runtime/solver/domains.h"
#include "runtime/solver/learning_search.h"
#include "runtime/solver/objective.h"
#include "runtime/solver/propagation.h"
#include "runtime/solver/trail.h"
#include "support/rounds.h"
#include "unit/brute_force.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc::reasons_test {
namespace {

using test::Random;

/// Whether a literal holds in a solution.
bool holds(const CatalogTrail& trail, const Assignment& solution, Literal literal) {
  const LocalTask task = trail.task_of(variable_of(literal));
  const std::uint32_t index = solution[task];
  const Literal variable = literal & ~Literal{1};
  const bool is_true =
      index != none && (variable == Trail::runs(task) || variable == trail.has_value(task, index));
  return is_true != is_negated(literal);
}

bool hold_all(const CatalogTrail& trail, const Assignment& solution,
              std::span<const Literal> literals) {
  return std::all_of(literals.begin(), literals.end(),
                     [&](Literal literal) { return holds(trail, solution, literal); });
}

bool holds_any(const CatalogTrail& trail, const Assignment& solution,
               std::span<const Literal> literals) {
  return std::any_of(literals.begin(), literals.end(),
                     [&](Literal literal) { return holds(trail, solution, literal); });
}

/// Decisions and inferences in the group of a problem, and all its solutions.
class Branch {
 public:
  Branch(const CompiledCatalog& catalog, const Problem& problem)
      : domains_(catalog),
        trail_(catalog, domains_),
        performance_(catalog, domains_, trail_),
        brute_force_(catalog, problem) {
    domains_.load(problem);
    performance_.load();
    is_consistent_ = trail_.load(problem) && propagate();
    analysis_.resize(trail_.variable_count());
  }

  [[nodiscard]] bool is_consistent() const { return is_consistent_; }
  [[nodiscard]] const Domains& domains() const { return domains_; }
  [[nodiscard]] const CatalogTrail& trail() const { return trail_; }
  [[nodiscard]] const std::vector<Assignment>& solutions() const {
    return brute_force_.solutions();
  }

  /// A literal to decide: that a task runs, or a value of one that does. None is left: `none`.
  [[nodiscard]] Literal choose(Random& random) const {
    std::vector<Literal> choices;
    for (LocalTask task(0); task < domains_.task_count(); ++task) {
      const Literal runs = Trail::runs(task);
      if (!trail_.is_true(runs) && !trail_.is_false(runs)) choices.push_back(runs);
      if (!domains_.needed(task) || domains_.count(task) < 2) continue;
      for (std::uint32_t index = 0; index < domains_.values(task).size(); ++index) {
        if (domains_.has(task, index)) choices.push_back(trail_.has_value(task, index));
      }
    }
    return choices.empty() ? none : choices[random.below(choices.size())];
  }
  void decide(Literal literal) {
    trail_.decide(literal);
    is_consistent_ = propagate();
  }
  void restart() { trail_.backtrack_to(0); }
  /// Nobody asks for reasons of facts then, as they may be gone.
  void forget_half_of_the_nogoods() {
    if (trail_.nogoods().size() == 0) return;
    trail_.nogoods().forget_half();
    has_forgotten_ = true;
  }

  /// After a conflict: learns a no-good from it, and goes on. False if there is no solution.
  bool learn() {
    const std::uint32_t level = ConflictAnalysis::level_of(trail_.conflict(), trail_);
    if (level == 0) return false;
    trail_.backtrack_to(level);
    analysis_.analyze(trail_.conflict(), trail_);
    expect_learned_is_right(level);
    trail_.backtrack_to(analysis_.back_level());
    is_consistent_ = trail_.learn(analysis_.learned(), analysis_.level_count()) && propagate();
    return true;
  }

  /// Of each inference: its reason held before, and leaves nothing else.
  void expect_reasons_suffice() const {
    std::vector<Literal> reason;
    for (const Literal literal : trail_.literals()) {
      if (trail_.is_given(literal) || (has_forgotten_ && trail_.level_of(literal) == 0)) continue;
      reason.clear();
      trail_.append_reason(literal, reason);
      for (const Literal other : reason) {
        EXPECT_TRUE(trail_.is_true(other));
        EXPECT_LT(trail_.place_of(other), trail_.place_of(literal));
      }
      for (const Assignment& solution : solutions()) {
        EXPECT_TRUE(!hold_all(trail_, solution, reason) || holds(trail_, solution, literal));
      }
    }
  }
  /// What does not hold together is no part of a solution.
  void expect_conflict_is_right() const {
    for (const Literal literal : trail_.conflict()) EXPECT_TRUE(trail_.is_true(literal));
    for (const Assignment& solution : solutions()) {
      EXPECT_FALSE(hold_all(trail_, solution, trail_.conflict()));
    }
  }

 private:
  bool propagate() {
    for (;;) {
      if (!trail_.propagate()) return false;
      const std::size_t before = trail_.literals().size();
      if (!performance_.propagate()) return false;
      if (trail_.literals().size() == before) return true;
    }
  }

  void expect_learned_is_right(std::uint32_t conflict_level) const {
    const std::span<const Literal> learned = analysis_.learned();
    std::vector<std::uint32_t> levels;
    for (const Literal literal : learned) {
      EXPECT_TRUE(trail_.is_false(literal));
      levels.push_back(trail_.level_of(literal));
    }
    // One literal of the conflict level, the first; the second is of the level to go back to.
    EXPECT_EQ(levels.front(), conflict_level);
    EXPECT_EQ(std::count(levels.begin(), levels.end(), conflict_level), 1);
    EXPECT_EQ(std::count(levels.begin(), levels.end(), 0U), 0);
    const std::uint32_t back_level =
        learned.size() == 1 ? 0 : *std::max_element(levels.begin() + 1, levels.end());
    EXPECT_EQ(analysis_.back_level(), back_level);
    EXPECT_TRUE(learned.size() == 1 || levels[1] == back_level);
    std::sort(levels.begin(), levels.end());
    levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
    EXPECT_EQ(analysis_.level_count(), levels.size());
    for (const Literal literal : learned.subspan(1)) EXPECT_FALSE(follows_from_others(literal));
    for (const Assignment& solution : solutions()) {
      EXPECT_TRUE(holds_any(trail_, solution, learned));
    }
  }

  /// Whether a literal of the learned no-good is false because others are, so that it is not
  /// needed.
  [[nodiscard]] bool follows_from_others(Literal literal) const {
    if (trail_.is_given(negate(literal))) return false;
    std::vector<Literal> reason;
    trail_.append_reason(negate(literal), reason);
    const std::span<const Literal> learned = analysis_.learned();
    return std::all_of(reason.begin(), reason.end(), [&](Literal other) {
      return trail_.level_of(other) == 0 ||
             std::find(learned.begin(), learned.end(), negate(other)) != learned.end();
    });
  }

  Domains domains_;
  CatalogTrail trail_;
  PerformanceReasons performance_;
  ConflictAnalysis analysis_;
  const test::BruteForce brute_force_;
  bool is_consistent_ = false;
  bool has_forgotten_ = false;
};

test::Shape random_shape(Random& random) {
  test::Shape shape;
  shape.tasks = 6 + static_cast<std::uint32_t>(random.below(3));
  shape.exclusivity_lists = 2 + static_cast<std::uint32_t>(random.below(3));
  shape.most_exclusive = 4;
  shape.minimum = random.below(2) == 0 ? 0 : 60;
  shape.is_deep = random.below(4) != 0;
  shape.on_request = 10;
  return shape;
}

/// What happened on branches.
struct Counts {
  int conflicts = 0;
  int inferences = 0;
  int without_solution = 0;
};

/// Decides, infers and learns at random, and compares each step with all solutions.
void follow_random_branch(Random& random, const test::Shape& shape, int moves, Counts& counts) {
  const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
  const Problem problem = test::random_problem(random, catalog, test::largest_group(catalog));
  Branch branch(catalog, problem);
  for (int move = 0; move < moves; ++move) {
    branch.expect_reasons_suffice();
    counts.inferences += static_cast<int>(branch.trail().literals().size());
    if (!branch.is_consistent()) {
      ++counts.conflicts;
      branch.expect_conflict_is_right();
      if (branch.learn()) continue;
      ++counts.without_solution;
      EXPECT_TRUE(branch.solutions().empty());
      return;
    }
    if (const Literal literal = branch.choose(random); literal != none) {
      branch.decide(literal);
    } else {
      branch.restart();
      if (random.below(3) == 0) branch.forget_half_of_the_nogoods();
    }
  }
}

TEST(Reasons, LeaveNoOtherSolutionOnRandomBranches) {
  Random random(1);
  Counts counts;
  for (int round = 0; round < test::rounds(1'000) && !HasFailure(); ++round) {
    SCOPED_TRACE(round);
    follow_random_branch(random, random_shape(random), 60, counts);
  }
  EXPECT_GE(counts.conflicts, test::rounds(400));
  EXPECT_GE(counts.inferences, test::rounds(50'000));
  EXPECT_GE(counts.without_solution, test::rounds(20));
}

constexpr std::uint32_t many = 129;

bool requires_b(std::uint32_t index) { return index % 3 == 1; }

/// That many behaviors of A, of which each third one requires B.
std::string many_behaviors() {
  std::string text = "behaviors:\n";
  for (std::uint32_t i = 0; i < many; ++i) {
    const char* const requirement = requires_b(i) ? ", requires: [{task: B}]" : "";
    text += fmt::format("- {{behavior: a{}, task: A{}}}\n", i, requirement);
  }
  return text;
}

TEST(Reasons, NameEachRemovalOfMoreThanSixtyFourValues) {
  const CompiledCatalog catalog =
      test::compile_text(many_behaviors() + "- {behavior: b, task: B}\n");
  const Problem problem = test::open_problem(catalog);
  const LocalTask task = test::local_task(catalog, "A");
  Branch branch(catalog, problem);
  const LocalTask required = test::local_task(catalog, "B");
  branch.decide(Trail::runs(task));
  for (std::uint32_t index = 0; index < many; ++index) {
    EXPECT_FALSE(branch.domains().needed(required));
    if (!requires_b(index)) branch.decide(negate(branch.trail().has_value(task, index)));
  }
  EXPECT_TRUE(branch.domains().needed(required));
  branch.expect_reasons_suffice();
  Branch other(catalog, problem);
  other.decide(negate(Trail::runs(required)));
  for (std::uint32_t index = 0; index < many; ++index) {
    EXPECT_EQ(other.trail().is_true(negate(other.trail().has_value(task, index))),
              requires_b(index));
  }
}

/// M requires a performance of A that A reaches only without B, as B requires C.
TEST(Reasons, OfPerformancesNameEachRemovalOfMoreThanSixtyFourValues) {
  const CompiledCatalog catalog = test::compile_text(
      many_behaviors() +
      "- {behavior: m, task: M, requires: [{task: A, minimum_performance: 90}]}\n"
      "- {behavior: b, task: B, requires: [{task: C}]}\n"
      "- {behavior: c, task: C, suitability: 50}\n");
  const Problem problem = test::open_problem(catalog);
  const LocalTask task = test::local_task(catalog, "A");
  Branch branch(catalog, problem);
  branch.decide(Trail::runs(test::local_task(catalog, "M")));
  for (std::uint32_t index = 0; index < many; ++index) {
    if (requires_b(index)) continue;
    ASSERT_TRUE(branch.is_consistent());
    branch.expect_reasons_suffice();
    branch.decide(negate(branch.trail().has_value(task, index)));
  }
  EXPECT_FALSE(branch.is_consistent());
  branch.expect_conflict_is_right();
}

std::string describe(const Domains& domains) {
  std::string text;
  for (LocalTask task(0); task < domains.task_count(); ++task) {
    text += domains.needed(task) ? " " : " ?";
    for (std::uint32_t index = 0; index < domains.values(task).size(); ++index) {
      if (domains.has(task, index)) text += std::to_string(index) + ",";
    }
  }
  return text;
}

TEST(Reasons, ComeWithAllThatThePropagatorInfers) {
  Random random(2);
  int nodes = 0;
  int conflicts = 0;
  for (int round = 0; round < test::rounds(1'000); ++round) {
    SCOPED_TRACE(round);
    const CompiledCatalog catalog = compile(test::random_catalog(random, random_shape(random)));
    const Problem problem = test::random_problem(random, catalog, test::largest_group(catalog));
    Branch branch(catalog, problem);
    Domains domains(catalog);
    Propagator propagator(catalog, domains);
    domains.load(problem);
    propagator.load(problem);
    bool is_consistent = true;
    for (LocalTask task(0); task < domains.task_count() && is_consistent; ++task) {
      if (problem.may_stop[task] == 0) is_consistent = domains.need(task);
    }
    is_consistent = is_consistent && propagator.propagate();
    for (;;) {
      ++nodes;
      ASSERT_EQ(branch.is_consistent(), is_consistent);
      if (!is_consistent) break;
      ASSERT_EQ(describe(branch.domains()), describe(domains));
      const Literal literal = branch.choose(random);
      if (literal == none) break;
      const LocalTask task = branch.trail().task_of(variable_of(literal));
      is_consistent = domains.need(task);
      for (std::uint32_t index = 0; index < domains.values(task).size(); ++index) {
        if (literal != branch.trail().has_value(task, index)) continue;
        is_consistent = is_consistent && domains.keep_only(task, index);
      }
      is_consistent = is_consistent && propagator.propagate();
      branch.decide(literal);
    }
    conflicts += is_consistent ? 0 : 1;
  }
  EXPECT_GE(nodes, test::rounds(1'000));
  EXPECT_GE(conflicts, test::rounds(50));
}

/// A search for the best solution that decides at random. Until it has found it, nothing that it
/// infers may rule it out.
class RandomSearch {
 public:
  RandomSearch(const CompiledCatalog& catalog, const Problem& problem, const Assignment& optimum)
      : optimum_(optimum),
        domains_(catalog),
        components_(catalog, domains_),
        objective_(catalog, domains_, components_),
        trail_(catalog, domains_),
        bound_(catalog, domains_, trail_),
        performance_(catalog, domains_, trail_),
        objectives_(domains_, objective_, bound_, trail_) {
    trail_.set_lazy_reasons(objectives_);
    domains_.load(problem);
    components_.load(problem);
    objective_.load(problem);
    performance_.load();
    objectives_.load(problem);
    is_consistent_ = trail_.load(problem);
    bound_.load();
    analysis_.resize(trail_.variable_count());
  }

  /// False if it does not end.
  [[nodiscard]] bool run(Random& random) {
    for (int move = 0; move < 2'000 && !testing::Test::HasFailure(); ++move) {
      is_consistent_ = is_consistent_ && propagate();
      expect_optimum_is_possible();
      if (!is_consistent_) {
        if (!learn()) return true;
      } else if (random.below(10) == 0) {
        backtrack_to(0);
      } else if (const Literal decision = choose(random); decision == none) {
        objective_.record(best_);
      } else {
        bound_.begin_level();
        trail_.decide(decision);
      }
    }
    return false;
  }

  [[nodiscard]] const Assignment& best() const { return best_.assignment; }
  [[nodiscard]] int conflicts() const { return conflicts_; }

 private:
  [[nodiscard]] bool has_found_optimum() const {
    return best_.exists && best_.assignment == optimum_;
  }

  [[nodiscard]] bool propagate() {
    for (;;) {
      if (!trail_.propagate()) return false;
      const std::size_t before = trail_.literals().size();
      if (!performance_.propagate()) return false;
      if (trail_.literals().size() > before) continue;
      if (best_.exists && !objectives_.propagate(best_)) return false;
      if (trail_.literals().size() == before) return true;
    }
  }

  [[nodiscard]] bool learn() {
    ++conflicts_;
    const std::uint32_t level = ConflictAnalysis::level_of(trail_.conflict(), trail_);
    if (level == 0) return false;
    backtrack_to(level);
    analysis_.analyze(trail_.conflict(), trail_);
    EXPECT_TRUE(has_found_optimum() || holds_any(trail_, optimum_, analysis_.learned()));
    backtrack_to(analysis_.back_level());
    is_consistent_ = trail_.learn(analysis_.learned(), analysis_.level_count());
    return true;
  }

  void backtrack_to(std::uint32_t level) {
    trail_.backtrack_to(level);
    bound_.backtrack_to(level);
  }

  /// Requests first, then values; none if all is decided.
  [[nodiscard]] Literal choose(Random& random) const {
    std::vector<Literal> choices;
    for (const LocalTask task : trail_.requests()) {
      const Literal runs = Trail::runs(task);
      if (!trail_.is_true(runs) && !trail_.is_false(runs)) choices.push_back(runs);
    }
    if (choices.empty()) {
      for (const LocalTask task : domains_.needed_tasks()) {
        if (domains_.count(task) < 2) continue;
        for (std::uint32_t index = 0; index < domains_.values(task).size(); ++index) {
          if (domains_.has(task, index)) choices.push_back(trail_.has_value(task, index));
        }
      }
    }
    if (choices.empty()) return none;
    const Literal chosen = choices[random.below(choices.size())];
    return random.below(4) == 0 ? negate(chosen) : chosen;
  }

  void expect_optimum_is_possible() const {
    if (has_found_optimum()) return;
    EXPECT_TRUE(is_consistent_ || !hold_all(trail_, optimum_, trail_.conflict()));
    std::vector<Literal> reason;
    for (const Literal literal : trail_.literals()) {
      if (trail_.is_given(literal)) continue;
      reason.clear();
      if (trail_.level_of(literal) > 0) trail_.append_reason(literal, reason);
      EXPECT_TRUE(!hold_all(trail_, optimum_, reason) || holds(trail_, optimum_, literal));
    }
  }

  const Assignment& optimum_;
  Domains domains_;
  Components components_;
  Objective objective_;
  CatalogTrail trail_;
  LandmarkBound bound_;
  PerformanceReasons performance_;
  ObjectiveReasons objectives_;
  ConflictAnalysis analysis_;
  Incumbent best_;
  bool is_consistent_ = false;
  int conflicts_ = 0;
};

/// Also where all behaviors are equally suitable, so that f3, f4 and the canonical order decide.
TEST(Reasons, NeverRuleOutTheBestSolution) {
  Random random(3);
  int conflicts = 0;
  for (int round = 0; round < test::rounds(4'000) && !HasFailure(); ++round) {
    SCOPED_TRACE(round);
    test::Shape shape = random_shape(random);
    shape.on_request = 50;
    shape.several_tasks = random.percent(50) ? 50 : 15;
    Catalog written = test::random_catalog(random, shape);
    if (random.percent(50)) test::make_perfect(written);
    const CompiledCatalog catalog = compile(written);
    const Problem problem = test::random_problem(random, catalog, test::largest_group(catalog));
    const auto optimum = test::BruteForce(catalog, problem).best();
    if (!optimum) continue;
    RandomSearch search(catalog, problem, *optimum);
    EXPECT_TRUE(search.run(random));
    EXPECT_EQ(search.best(), *optimum);
    conflicts += search.conflicts();
  }
  EXPECT_GE(conflicts, test::rounds(5'000));
}

/// The products of (999,999 - n) / 1,000,000 over `first` and over `second` are equal but for
/// 1e-31, since the sums of their powers up to the fifth are. No cost tells them apart, only exact
/// arithmetic.
TEST(Reasons, OfAnAlmostEqualSuitabilityHoldOnlyWhereItIs) {
  constexpr int first[] = {0, 5, 6, 16, 17, 22};
  constexpr int second[] = {1, 2, 10, 12, 20, 21};
  std::string text = "behaviors:\n";
  const auto add = [&text](std::string_view name, std::span<const int> missing, int more) {
    std::string required;
    std::string required_behaviors;
    for (std::size_t place = 0; place < missing.size(); ++place) {
      const int suitability = 999'999 - missing[place] + (place == 1 ? more : 0);
      required += fmt::format("{}{{task: {}{}}}", place == 0 ? "" : ", ", name, place);
      required_behaviors +=
          fmt::format("- {{behavior: {0}{1}, task: {0}{1}, suitability: {2}.{3:04}}}\n", name,
                      place, suitability / 10'000, suitability % 10'000);
    }
    text += fmt::format("- {{behavior: by_{0}, task: MISSION, requires: [{1}]}}\n{2}", name,
                        required, required_behaviors);
  };
  add("a", first, 0);
  add("b", second, 0);
  add("c", second, 1);
  const CompiledCatalog catalog = test::compile_text(text);
  Problem problem = test::open_problem(catalog);
  test::request(problem, catalog, "MISSION");
  const auto optimum = test::BruteForce(catalog, problem).best();
  ASSERT_TRUE(optimum);
  Random random(4);
  for (int round = 0; round < 50; ++round) {
    RandomSearch search(catalog, problem, *optimum);
    EXPECT_TRUE(search.run(random));
    EXPECT_EQ(search.best(), *optimum) << "round " << round;
  }
}

}  // namespace
}  // namespace cbc::reasons_test
