#include "unit/random_problems.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "unit/compiled_fixture.h"

namespace cbc::test {
namespace {

Millionths random_suitability(Random& random, const Shape& shape) {
  static const std::vector<Millionths> common{1'000'000, 1'000'000, 900'000, 800'000,
                                              720'000,   1'000'000, 500'000, 600'000};
  // 0.999999 * 0.999999 and 1 * 0.999998 differ by one in 10^12.
  static const std::vector<Millionths> close{1'000'000, 999'999, 999'998, 500'000, 250'000};
  if (random.percent(shape.zero)) return 0;
  if (random.percent(shape.any_percent)) {
    return static_cast<Millionths>(random.between(51, 100)) * 10'000;
  }
  return random.pick(random.percent(80) ? common : close);
}

Millionths random_minimum(Random& random, const Shape& shape) {
  static const std::vector<Millionths> minimums{720'000, 720'001, 810'000, 648'000, 999'998,
                                                500'000, 900'000, 360'000, 1};
  return random.percent(shape.minimum) ? random.pick(minimums) : 0;
}

bool exclude_one_another(const Catalog& catalog, TaskIndex a, TaskIndex b) {
  return std::any_of(
      catalog.exclusivity.begin(), catalog.exclusivity.end(), [&](const ExclusivityList& list) {
        const auto has = [&](TaskIndex task) {
          return std::find(list.tasks.begin(), list.tasks.end(), task) != list.tasks.end();
        };
        return has(a) && has(b);
      });
}

void add_exclusivity(Catalog& catalog, Random& random, const Shape& shape) {
  for (std::uint32_t list = 0; list < shape.exclusivity_lists; ++list) {
    ExclusivityList& to = catalog.exclusivity.emplace_back();
    const std::size_t size = 2 + random.below(shape.most_exclusive - 1);
    for (std::size_t i = 0; i < size; ++i) {
      to.tasks.push_back(static_cast<TaskIndex>(random.below(shape.tasks)));
    }
  }
}

/// `order` is a topological order: tasks only require later ones.
void add_behavior(Catalog& catalog, const std::vector<TaskIndex>& order, std::uint32_t position,
                  Random& random, const Shape& shape) {
  Behavior& behavior = catalog.behaviors.emplace_back();
  behavior.name = "b" + std::to_string(catalog.behaviors.size());
  Performance performance;
  performance.task = order[position];
  performance.suitability = random_suitability(random, shape);
  behavior.performs.push_back(performance);
  std::size_t last = position;
  if (position + 1 < order.size() && random.percent(shape.several_tasks)) {
    last = position + 1 + random.below(order.size() - position - 1);
    performance.task = order[last];
    performance.suitability = random_suitability(random, shape);
    behavior.performs.push_back(performance);
  }
  if (last + 1 == order.size()) return;
  const std::size_t later = order.size() - last - 1;
  const std::size_t requirements =
      shape.is_deep ? shape.most_requirements : random.below(shape.most_requirements + 1);
  for (std::size_t i = 0; i < requirements; ++i) {
    Requirement requirement;
    requirement.task =
        order[last + 1 + random.below(shape.is_deep ? std::min<std::size_t>(later, 8) : later)];
    requirement.minimum_performance = random_minimum(random, shape);
    const bool is_impossible = std::any_of(
        behavior.performs.begin(), behavior.performs.end(),
        [&](const auto& one) { return exclude_one_another(catalog, one.task, requirement.task); });
    if (!is_impossible) behavior.requirements.push_back(requirement);
  }
}

void list_once(std::vector<BehaviorId>& behaviors) {
  std::sort(behaviors.begin(), behaviors.end());
  behaviors.erase(std::unique(behaviors.begin(), behaviors.end()), behaviors.end());
}

}  // namespace

Catalog random_catalog(Random& random, const Shape& shape) {
  Catalog catalog;
  for (std::uint32_t index = 0; index < shape.tasks; ++index) {
    Task& task = catalog.tasks.emplace_back();
    task.name = "T" + std::to_string(index);
    task.start_on_request = random.percent(shape.on_request);
    if (random.percent(10)) task.minimum_performance = random_minimum(random, shape);
  }
  add_exclusivity(catalog, random, shape);
  std::vector<TaskIndex> order(shape.tasks);
  std::iota(order.begin(), order.end(), 0U);
  random.shuffle(order);
  for (std::uint32_t position = 0; position < shape.tasks; ++position) {
    const std::size_t behaviors = random.percent(3) ? 0 : 1 + random.below(shape.most_behaviors);
    for (std::size_t i = 0; i < behaviors; ++i) {
      add_behavior(catalog, order, position, random, shape);
    }
  }
  random.shuffle(catalog.behaviors);
  return catalog;
}

void make_perfect(Catalog& catalog) {
  for (Behavior& behavior : catalog.behaviors) {
    for (Performance& performance : behavior.performs) performance.suitability = one_million;
  }
}

GroupId largest_group(const CompiledCatalog& catalog) {
  GroupId largest;
  const auto size = [&](GroupId group) {
    return catalog.group_tasks[group + 1] - catalog.group_tasks[group];
  };
  for (GroupId group(1); group < catalog.group_count(); ++group) {
    if (size(group) > size(largest)) largest = group;
  }
  return largest;
}

Problem random_problem(Random& random, const CompiledCatalog& catalog, GroupId group) {
  const TaskId first = catalog.group_tasks[group];
  const std::uint32_t tasks = catalog.group_tasks[group + 1] - first;
  Problem problem;
  problem.group = group;
  problem.domains.assign(catalog.words[first + tasks] - catalog.words[first], 0);
  problem.may_stop.assign(tasks, 1);
  problem.present.assign(tasks, none);

  enum class Kind : std::uint8_t { start, stop, finish };
  const Kind kind = random.percent(70)   ? Kind::start
                    : random.percent(50) ? Kind::stop
                                         : Kind::finish;
  const LocalTask subject(random.below(tasks));
  const std::size_t running = random.below(100);
  for (LocalTask task(0); task < tasks; ++task) {
    const std::size_t values = catalog.values[first + task].size();
    if (values > 0 && random.percent(running)) {
      problem.present[task] = static_cast<std::uint32_t>(random.below(values));
    }
  }
  const auto behavior_before = [&](LocalTask task) {
    return problem.present[task] == none
               ? none
               : catalog.values[first + task][problem.present[task]].behavior;
  };
  const BehaviorId finished = kind == Kind::finish ? behavior_before(subject) : none;
  const bool is_success = random.percent(50);
  const std::size_t available = 50 + random.below(51);
  const std::size_t is_protected = random.below(40);

  for (LocalTask task(0); task < tasks; ++task) {
    const BehaviorId before = behavior_before(task);
    const bool on_request = catalog.tasks[first + task].start_on_request;
    const bool has_finished = before != none && before == finished;
    const bool is_start = kind == Kind::start && task == subject;
    const bool is_stop = kind == Kind::stop && task == subject;
    const bool is_done = has_finished && is_success;
    const bool has_request = before != none && (on_request || random.percent(40));
    if (is_start || (has_request && !is_stop && !is_done)) problem.requests.push_back(task);
    if (before != none && !has_finished) problem.active.push_back(before);
    if (is_stop || is_done || (!is_start && before == none && on_request)) continue;
    for (std::uint32_t index = 0; index < catalog.values[first + task].size(); ++index) {
      const bool is_kept = index == problem.present[task] && !has_finished;
      const bool is_excluded = catalog.values[first + task][index].behavior == finished;
      if (!is_kept && (is_excluded || !random.percent(available))) continue;
      const std::uint32_t word = catalog.words[first + task] - catalog.words[first] + index / 64;
      problem.domains[word] |= std::uint64_t{1} << (index % 64);
    }
    if (is_start || (has_request && !has_finished && random.percent(is_protected))) {
      problem.may_stop[task] = 0;
    }
  }
  random.shuffle(problem.requests);
  list_once(problem.active);
  return problem;
}

CompiledCatalog random_nested_components(Random& random) {
  constexpr int inner = 7;
  constexpr int tasks = 15;
  std::string text = "default_values: {tasks: {start_on_request: false}}\nbehaviors:\n";
  int number = 0;
  const auto add = [&](int task, const std::string& required) {
    text += fmt::format("- {{behavior: b{}, task: T{}, suitability: {}, requires: [{}]}}\n",
                        number++, task, random.between(50, 99), required);
  };
  for (int task = 0; task < tasks; ++task) {
    add(task, "");
    if (task < inner) {
      const std::string left = fmt::format("{{task: T{}}}", 2 * task + 1);
      const std::string right = fmt::format("{{task: T{}}}", 2 * task + 2);
      for (int i = 0; i < 2; ++i) add(task, left + ", " + right);
      add(task, random.percent(50) ? left : right);
    } else {
      for (int i = 0; i < 2; ++i) add(task, "");
    }
  }
  std::string lists;
  for (int leaf = inner; leaf + 1 < tasks; ++leaf) {
    if (random.percent(80)) continue;
    lists += fmt::format("- mutually_exclusive: [T{}, T{}]\n", leaf, leaf + 1);
  }
  return compile_text(lists.empty() ? text : text + "exclusivity_constraints:\n" + lists);
}

void run_some(Random& random, const CompiledCatalog& catalog, Problem& problem) {
  const TaskId first = catalog.group_tasks[problem.group];
  for (LocalTask task(0); task < problem.present.size(); ++task) {
    const auto values = catalog.values[first + task];
    if (values.empty() || !random.percent(40)) continue;
    problem.present[task] = static_cast<std::uint32_t>(random.below(values.size()));
    problem.active.push_back(values[problem.present[task]].behavior);
  }
  list_once(problem.active);
}

Problem random_open_problem(Random& random, const CompiledCatalog& catalog) {
  Problem problem = open_problem(catalog, largest_group(catalog));
  run_some(random, catalog, problem);
  const std::size_t tasks = problem.may_stop.size();
  const std::size_t requests = 2 + random.below(6);
  for (std::size_t i = 0; i < requests; ++i) {
    const LocalTask task(random.below(tasks));
    if (std::count(problem.requests.begin(), problem.requests.end(), task) > 0) continue;
    problem.requests.push_back(task);
    if (random.percent(30) || i == 0) problem.may_stop[task] = 0;
  }
  return problem;
}

}  // namespace cbc::test
