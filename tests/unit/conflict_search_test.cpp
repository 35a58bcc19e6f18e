// Problems with only some reasons in force, against a search through all assignments.

#include "ask/conflict/conflict_search.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ask/conflict/reasons.h"
#include "core/compile/compile.h"
#include "support/rounds.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc::conflict_search_test {
namespace {

__extension__ using Wide = unsigned __int128;

struct Low {
  TaskId task = none;
  Millionths minimum = 0;
};

/// A random search for conflicts, and its answer by trying everything. Groups have up to 6 tasks,
/// so that products are exact.
class RandomSearch {
 public:
  RandomSearch(const CompiledCatalog& catalog, test::Random& random)
      : catalog_(catalog), group_(test::largest_group(catalog)), random_(random) {
    for (TaskId task = first(); task < end(); ++task) {
      tasks_.push_back(task);
      present.push_back(random.percent(50) ? any_value(task) : none);
    }
    draw_demands();
    draw_reasons();
    if (random.percent(20)) low = Low{random.pick(tasks_), 720'000};
  }

  Feasibility solve(const std::vector<Reason>& some) {
    ConflictSearch problem(catalog_, group_, present, demands);
    if (low) problem.keep_below(low->task, low->minimum);
    Effort effort;
    const Feasibility answer = problem.solve(some, effort);
    used.clear();
    for (std::size_t index = 0; index < some.size(); ++index) {
      if (problem.is_used()[index] != 0) used.push_back(some[index]);
    }
    return answer;
  }

  bool has_solution(const std::vector<Reason>& some) {
    assignment_.assign(tasks_.size(), none);
    return try_from(0, some);
  }

  std::vector<std::uint32_t> present;
  Demands demands;
  std::vector<Reason> reasons;
  std::vector<Reason> used;  ///< of the last answer
  std::optional<Low> low;

 private:
  [[nodiscard]] TaskId first() const { return catalog_.group_tasks[group_]; }
  [[nodiscard]] TaskId end() const { return catalog_.group_tasks[group_ + 1]; }
  [[nodiscard]] std::uint32_t any_value(TaskId task) {
    const std::size_t count = catalog_.values[task].size();
    return count == 0 ? none : static_cast<std::uint32_t>(random_.below(count));
  }

  void draw_demands() {
    for (std::size_t count = 1 + random_.below(5); count > 0; --count) {
      const TaskId task = random_.pick(tasks_);
      const std::uint32_t index = any_value(task);
      Demand demand{Demand::Kind::run, task, none};
      if (index != none && random_.percent(40)) {
        demand = {random_.percent(60) ? Demand::Kind::has : Demand::Kind::has_not, task, index};
      } else if (random_.percent(20)) {
        demand.kind = Demand::Kind::stop;
      }
      demands.push_back(demand);
    }
  }

  void draw_reasons() {
    RelevantTasks all(catalog_, group_);
    for (const TaskId task : tasks_) all.add(task);
    all.close();
    for (const TaskId task : tasks_) {
      add_exclusions(catalog_, task, all, SIZE_MAX, reasons);
      add_minimum(catalog_, task, reasons);
      Reason reason;
      reason.kind = random_.percent(40) ? Reason::Kind::is_protected : Reason::Kind::on_request;
      reason.task = task;
      if (random_.percent(15)) reasons.push_back(reason);
    }
    for (const BehaviorId behavior : all.behaviors()) {
      add_requirements(catalog_, behavior, reasons);
      Reason reason;
      reason.kind = random_.percent(50) ? Reason::Kind::unavailable : Reason::Kind::faulty;
      reason.behavior = behavior;
      if (random_.percent(10)) reasons.push_back(reason);
    }
    random_.shuffle(reasons);
  }

  bool try_from(std::size_t index, const std::vector<Reason>& some) {
    if (index == tasks_.size()) return holds(some);
    for (std::uint32_t value = 0; value < catalog_.values[tasks_[index]].size(); ++value) {
      assignment_[index] = value;
      if (try_from(index + 1, some)) return true;
    }
    assignment_[index] = none;
    return try_from(index + 1, some);
  }

  [[nodiscard]] std::uint32_t value_index(TaskId task) const { return assignment_[task - first()]; }
  [[nodiscard]] bool runs(TaskId task) const { return value_index(task) != none; }
  [[nodiscard]] BehaviorId behavior_of(TaskId task) const {
    return runs(task) ? catalog_.values[task][value_index(task)].behavior : none;
  }
  [[nodiscard]] bool is_active(BehaviorId behavior) const {
    return std::any_of(tasks_.begin(), tasks_.end(),
                       [&](TaskId task) { return behavior_of(task) == behavior; });
  }

  [[nodiscard]] bool holds(const std::vector<Reason>& some) const {
    return std::all_of(demands.begin(), demands.end(),
                       [this](const Demand& demand) { return holds(demand); }) &&
           std::all_of(some.begin(), some.end(),
                       [this](const Reason& reason) { return holds(reason); }) &&
           (!low || (runs(low->task) && !performs(low->task, low->minimum)));
  }

  [[nodiscard]] bool holds(const Demand& demand) const {
    switch (demand.kind) {
      case Demand::Kind::run:
        return runs(demand.task);
      case Demand::Kind::stop:
        return !runs(demand.task);
      case Demand::Kind::has:
        return value_index(demand.task) == demand.value_index;
      case Demand::Kind::has_not:
        return value_index(demand.task) != demand.value_index;
    }
    return false;
  }

  [[nodiscard]] bool holds(const Reason& reason) const {
    switch (reason.kind) {
      case Reason::Kind::is_protected:
        return runs(reason.task);
      case Reason::Kind::on_request:
        return !runs(reason.task);
      case Reason::Kind::exclusive:
        return !runs(reason.task) || !runs(reason.other_task);
      case Reason::Kind::requires_task:
        return !is_active(reason.behavior) || runs(reason.task);
      case Reason::Kind::performance:
        if (reason.behavior != none && !is_active(reason.behavior)) return true;
        return !runs(reason.task) || performs(reason.task, reason.minimum_performance);
      case Reason::Kind::unavailable:
        return std::none_of(tasks_.begin(), tasks_.end(), [&](TaskId task) {
          return behavior_of(task) == reason.behavior &&
                 value_index(task) != present[task - first()];
        });
      default:
        return !is_active(reason.behavior);
    }
  }

  [[nodiscard]] bool performs(TaskId task, Millionths minimum) const {
    std::vector<TaskId> closure{task};
    Wide product = 1;
    Wide least = minimum;
    for (std::size_t next = 0; next < closure.size(); ++next) {
      const TaskId one = closure[next];
      product *= catalog_.values[one][value_index(one)].suitability;
      if (next > 0) least *= one_million;
      for (const CompiledRequirement& requirement : catalog_.requirements[behavior_of(one)]) {
        if (!runs(requirement.task)) continue;
        if (std::count(closure.begin(), closure.end(), requirement.task) == 0) {
          closure.push_back(requirement.task);
        }
      }
    }
    return product >= least;
  }

  const CompiledCatalog& catalog_;
  const GroupId group_;
  test::Random& random_;
  std::vector<TaskId> tasks_;
  std::vector<std::uint32_t> assignment_;
};

test::Shape shape_for(test::Random& random) {
  test::Shape shape;
  shape.tasks = static_cast<std::uint32_t>(random.between(3, 6));
  shape.most_behaviors = static_cast<std::uint32_t>(random.between(2, 4));
  shape.most_requirements = 3;
  shape.exclusivity_lists = static_cast<std::uint32_t>(random.between(0, 6));
  shape.most_exclusive = 2;
  return shape;
}

TEST(ConflictSearch, AnswersAsASearchThroughAllAssignments) {
  test::Random random(20);
  std::size_t answers[2] = {};
  std::size_t narrowed = 0;
  for (int round = 0; round < test::rounds(20'000); ++round) {
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape_for(random)));
    RandomSearch random_search(catalog, random);
    const bool expected = random_search.has_solution(random_search.reasons);
    ASSERT_EQ(random_search.solve(random_search.reasons),
              expected ? Feasibility::yes : Feasibility::no)
        << round;
    ++answers[expected ? 1 : 0];
    if (expected) continue;
    const std::vector<Reason> used = random_search.used;
    ASSERT_FALSE(random_search.has_solution(used)) << round << ": not all that matters is noted";
    ASSERT_EQ(random_search.solve(used), Feasibility::no);
    if (used.size() * 2 < random_search.reasons.size()) ++narrowed;
  }
  EXPECT_GT(answers[0], test::rounds(500U));
  EXPECT_GT(answers[1], test::rounds(500U));
  EXPECT_GT(narrowed, test::rounds(300U)) << "what does not matter is noted";
}

/// A task that requires others. Some of them run in two ways each, whatever else runs; the rest
/// need one of several places each, and each place has room for one of them.
std::string crowded_catalog(int free_tasks, int crowded_tasks, int places) {
  std::string text = "behaviors:\n";
  const auto add = [&text](const std::string& behavior, const std::string& task,
                           const std::string& required) {
    text += fmt::format("- {{behavior: {}, task: {}, requires: [{}]}}\n", behavior, task, required);
  };
  std::string all;
  for (int task = 0; task < free_tasks; ++task) {
    const std::string name = fmt::format("A{}", task);
    for (const char* const way : {"x", "y"}) add(name + way, name, "");
    all += fmt::format("{{task: {}}}, ", name);
  }
  std::string lists;
  for (int place = 0; place < places; ++place) {
    std::string list;
    for (int task = 0; task < crowded_tasks; ++task) {
      const std::string at_place = fmt::format("B{}at{}", task, place);
      add(fmt::format("B{}to{}", task, place), fmt::format("B{}", task),
          fmt::format("{{task: {}}}", at_place));
      add(at_place, at_place, "");
      list += at_place + ", ";
    }
    lists += fmt::format("- mutually_exclusive: [{}]\n", list);
  }
  for (int task = 0; task < crowded_tasks; ++task) all += fmt::format("{{task: B{}}}, ", task);
  add("all", "ALL", all);
  return text + "exclusivity_constraints:\n" + lists;
}

/// That all of these tasks run, under all constraints.
class CrowdedSearch {
 public:
  explicit CrowdedSearch(const std::string& text)
      : catalog_(test::compile_text(text)),
        present_(catalog_.tasks.size(), none),
        task_(catalog_.task_ids[*catalog_.find_task("ALL")]),
        search_(catalog_, GroupId(), present_, {{Demand::Kind::run, task_, none}}) {
    RelevantTasks relevant(catalog_, GroupId());
    relevant.add(task_);
    relevant.close();
    for (const TaskId one : relevant.tasks()) {
      add_exclusions(catalog_, one, relevant, SIZE_MAX, reasons_);
    }
    for (const BehaviorId one : relevant.behaviors()) add_requirements(catalog_, one, reasons_);
  }

  Feasibility solve(Effort effort) { return search_.solve(reasons_, effort); }

 private:
  CompiledCatalog catalog_;
  std::vector<std::uint32_t> present_;
  TaskId task_;
  ConflictSearch search_;
  std::vector<Reason> reasons_;
};

/// One task too many for the places: that takes a search. The free tasks are decided on before.
TEST(ConflictSearch, DoesNotSearchWhatHasNoPartInAFailure) {
  CrowdedSearch crowded(crowded_catalog(30, 4, 3));
  EXPECT_EQ(crowded.solve(Effort(100'000)), Feasibility::no);
}

/// A search that does not learn refutes the same again and again here.
TEST(ConflictSearch, LearnsFromFailures) {
  CrowdedSearch crowded(crowded_catalog(10, 8, 7));
  EXPECT_EQ(crowded.solve(Effort(100'000'000)), Feasibility::no);
  EXPECT_EQ(crowded.solve(Effort(1'000'000)), Feasibility::unknown);
}

TEST(ConflictSearch, StopsWhenItIsTold) {
  CrowdedSearch crowded(crowded_catalog(10, 8, 7));
  std::uint64_t asked = 0;
  const Effort effort(UINT64_MAX, [&asked] { return ++asked == 100; });
  EXPECT_EQ(crowded.solve(effort), Feasibility::unknown);
  EXPECT_EQ(asked, 100U);
}

}  // namespace
}  // namespace cbc::conflict_search_test
