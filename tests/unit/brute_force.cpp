#include "unit/brute_force.h"

#include <algorithm>
#include <set>
#include <utility>

namespace cbc::test {
namespace {

__extension__ using Wide = unsigned __int128;

}  // namespace

BruteForce::BruteForce(const CompiledCatalog& catalog, const Problem& problem,
                       std::vector<std::uint32_t> ranks)
    : catalog_(catalog),
      problem_(problem),
      ranks_(std::move(ranks)),
      first_(catalog.group_tasks[problem.group]),
      tasks_(catalog.group_tasks[problem.group + 1] - first_),
      present_(tasks_, none) {
  for (std::uint32_t task = 0; task < tasks_; ++task) ordered_.push_back(ordered_domain(task));
  enumerate(0);
}

void BruteForce::enumerate(std::uint32_t task) {
  if (task == tasks_) {
    if (is_valid(present_)) solutions_.push_back(present_);
    return;
  }
  for (const std::uint32_t place : ordered_[task]) {
    present_[task] = place;
    enumerate(task + 1);
  }
}

std::vector<std::uint32_t> BruteForce::ordered_domain(std::uint32_t task) const {
  const auto values = catalog_.values[first_ + task];
  std::vector<std::uint32_t> order;
  for (std::uint32_t place = 0; place < values.size(); ++place) {
    if (has(task, place)) order.push_back(place);
  }
  const auto rank = [&](std::uint32_t place) {
    return ranks_.empty() ? place : ranks_[catalog_.values.begin[first_ + task] + place];
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (values[a].suitability != values[b].suitability) {
      return values[a].suitability > values[b].suitability;
    }
    return rank(a) < rank(b);
  });
  const std::uint32_t before = problem_.present[task];
  const auto kept = std::find(order.begin(), order.end(), before);
  if (before != none && kept != order.end() &&
      values[before].suitability == values[order.front()].suitability) {
    order.erase(kept);
    order.insert(order.begin(), before);
  }
  if (problem_.may_stop[task] != 0) {
    order.insert(before == none ? order.begin() : order.end(), none);
  }
  return order;
}

bool BruteForce::has(std::uint32_t task, std::uint32_t place) const {
  const std::uint32_t word = catalog_.words[first_ + task] - catalog_.words[first_] + place / 64;
  return ((problem_.domains[word] >> (place % 64)) & 1) != 0;
}

BehaviorId BruteForce::behavior(const Assignment& answer, std::uint32_t task) const {
  return answer[task] == none ? none : catalog_.values[first_ + task][answer[task]].behavior;
}

bool BruteForce::is_in_domains(const Assignment& answer) const {
  for (std::uint32_t task = 0; task < tasks_; ++task) {
    if (answer[task] == none ? problem_.may_stop[task] == 0 : !has(task, answer[task])) {
      return false;
    }
  }
  return true;
}

bool BruteForce::is_valid(const Assignment& answer) const {
  for (std::size_t clique = 0; clique < catalog_.cliques.size(); ++clique) {
    int running = 0;
    for (const TaskId task : catalog_.cliques[clique]) {
      if (catalog_.tasks[task].group == problem_.group && answer[task - first_] != none) ++running;
    }
    if (running > 1) return false;
  }
  for (std::uint32_t task = 0; task < tasks_; ++task) {
    if (answer[task] == none) continue;
    if (!performs(answer, task, catalog_.tasks[first_ + task].minimum_performance)) return false;
    for (const CompiledRequirement& rule : catalog_.requirements[behavior(answer, task)]) {
      if (answer[rule.task - first_] == none) return false;
      if (!performs(answer, rule.task - first_, rule.minimum_performance)) return false;
    }
  }
  return true;
}

bool BruteForce::performs(const Assignment& answer, std::uint32_t task, Millionths minimum) const {
  std::set<std::uint32_t> closure{task};
  for (std::size_t before = 0; before != closure.size();) {
    before = closure.size();
    for (const std::uint32_t member : std::set<std::uint32_t>(closure)) {
      if (answer[member] == none) return minimum == 0;
      for (const CompiledRequirement& rule : catalog_.requirements[behavior(answer, member)]) {
        closure.insert(rule.task - first_);
      }
    }
  }
  Wide product = 1;
  Wide bound = minimum;
  for (const std::uint32_t member : closure) {
    product *= catalog_.values[first_ + member][answer[member]].suitability;
    if (member != task) bound *= one_million;
  }
  return product >= bound;
}

std::uint32_t BruteForce::count_changes(const Assignment& answer) const {
  const std::set<BehaviorId> before(problem_.active.begin(), problem_.active.end());
  std::set<BehaviorId> after;
  for (std::uint32_t task = 0; task < tasks_; ++task) {
    if (answer[task] != none) after.insert(behavior(answer, task));
  }
  std::uint32_t changes = 0;
  for (const BehaviorId one : after) changes += before.contains(one) ? 0U : 1U;
  for (const BehaviorId one : before) changes += after.contains(one) ? 0U : 1U;
  return changes;
}

bool BruteForce::is_better(const Assignment& a, const Assignment& b) const {
  const auto satisfied = [&](const Assignment& answer) {
    return std::count_if(problem_.requests.begin(), problem_.requests.end(),
                         [&](std::uint32_t task) { return answer[task] != none; });
  };
  if (satisfied(a) != satisfied(b)) return satisfied(a) > satisfied(b);
  for (const std::uint32_t task : problem_.requests) {
    if ((a[task] != none) != (b[task] != none)) return a[task] != none;
  }
  const auto suitability = [&](const Assignment& answer) {
    Wide product = 1;
    for (std::uint32_t task = 0; task < tasks_; ++task) {
      product *= answer[task] == none ? one_million
                                      : catalog_.values[first_ + task][answer[task]].suitability;
    }
    return product;
  };
  const Wide suitability_a = suitability(a);
  const Wide suitability_b = suitability(b);
  if (suitability_a != suitability_b) return suitability_a > suitability_b;
  const auto idle = [&](const Assignment& answer) {
    std::uint32_t count = 0;
    for (std::uint32_t task = 0; task < tasks_; ++task) {
      if (answer[task] != none && !catalog_.tasks[first_ + task].start_on_request) ++count;
    }
    return count;
  };
  if (idle(a) != idle(b)) return idle(a) < idle(b);
  if (count_changes(a) != count_changes(b)) return count_changes(a) < count_changes(b);
  for (std::uint32_t task = 0; task < tasks_; ++task) {
    const auto rank = [&](std::uint32_t place) {
      return std::find(ordered_[task].begin(), ordered_[task].end(), place);
    };
    if (a[task] != b[task]) return rank(a[task]) < rank(b[task]);
  }
  return false;
}

std::optional<Assignment> BruteForce::best(std::size_t among) const {
  if (solutions_.empty()) return std::nullopt;
  const std::size_t count = std::min(among, solutions_.size());
  const Assignment* best = &solutions_.front();
  for (std::size_t place = 1; place < count; ++place) {
    if (is_better(solutions_[place], *best)) best = &solutions_[place];
  }
  return *best;
}

}  // namespace cbc::test
