#include "enumeration.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace cbc::oracle {
namespace {

// Sets of tasks that are connected, as a forest: each set is known by its root.
std::size_t root_of(const std::vector<std::size_t>& parent, std::size_t task) {
  while (parent[task] != task) {
    task = parent[task];
  }
  return task;
}

void join(std::vector<std::size_t>& parent, std::size_t a, std::size_t b) {
  parent[root_of(parent, a)] = root_of(parent, b);
}

// The level of a behavior; the catalog is acyclic.
std::size_t compute_level(const CatalogFacts& facts, std::size_t behavior) {
  std::size_t level = 0;
  for (const Requirement& requirement : facts.catalog.behaviors[behavior].requirements) {
    std::size_t level_of_task = 0;
    for (const std::size_t other : facts.behaviors_of[requirement.task]) {
      level_of_task = std::max(level_of_task, compute_level(facts, other));
    }
    level = std::max(level, level_of_task + 1);
  }
  return level;
}

// Adds R(task) to `required`.
void collect_required(const CatalogFacts& facts, const Assignment& values, std::size_t task,
                      std::vector<bool>& required) {
  if (values[task] == none) {
    return;
  }
  for (const Requirement& requirement : facts.catalog.behaviors[values[task]].requirements) {
    if (!required[requirement.task]) {
      required[requirement.task] = true;
      collect_required(facts, values, requirement.task, required);
    }
  }
}

Integer scaled_minimum(const ExactPerformance& reached, Millionths minimum) {
  return power_of_million(reached.factors - 1) * minimum;
}

bool reaches(const CatalogFacts& facts, const Assignment& values, std::size_t task,
             Millionths minimum) {
  if (minimum == 0) {
    return true;
  }
  const ExactPerformance reached = performance(facts, values, task);
  return reached.product >= scaled_minimum(reached, minimum);
}

bool exclusivity_holds(const CatalogFacts& facts, const Assignment& values,
                       const std::vector<std::size_t>& tasks) {
  for (const std::size_t task : tasks) {
    if (values[task] == none) {
      continue;
    }
    for (const std::size_t other : facts.excludes[task]) {
      if (values[other] != none) {
        return false;
      }
    }
  }
  return true;
}

bool limits_hold(const CatalogFacts& facts, const Assignment& values) {
  for (std::size_t list = 0; list < facts.catalog.exclusivity.size(); ++list) {
    if (facts.catalog.most(list) == 1) {
      continue;
    }
    std::set<std::size_t> running;
    for (const std::size_t task : facts.catalog.exclusivity[list]) {
      if (values[task] != none) {
        running.insert(task);
      }
    }
    if (running.size() > facts.catalog.most(list)) {
      return false;
    }
  }
  return true;
}

bool required_tasks_run(const CatalogFacts& facts, const Assignment& values,
                        const std::vector<std::size_t>& tasks) {
  for (const std::size_t task : tasks) {
    if (values[task] == none) {
      continue;
    }
    for (const Requirement& requirement : facts.catalog.behaviors[values[task]].requirements) {
      if (values[requirement.task] == none) {
        return false;
      }
    }
  }
  return true;
}

bool performances_suffice(const CatalogFacts& facts, const Assignment& values,
                          const std::vector<std::size_t>& tasks) {
  for (const std::size_t task : tasks) {
    if (values[task] == none) {
      continue;
    }
    if (!reaches(facts, values, task, facts.catalog.tasks[task].minimum)) {
      return false;
    }
    for (const Requirement& requirement : facts.catalog.behaviors[values[task]].requirements) {
      if (!reaches(facts, values, requirement.task, requirement.minimum)) {
        return false;
      }
    }
  }
  return true;
}

bool satisfies_constraints(const CatalogFacts& facts, const Assignment& values,
                           const std::vector<std::size_t>& tasks) {
  return exclusivity_holds(facts, values, tasks) && limits_hold(facts, values) &&
         required_tasks_run(facts, values, tasks) && performances_suffice(facts, values, tasks);
}

// The values of a domain by rank in the canonical order.
std::vector<std::size_t> ranked_domain(const CatalogFacts& facts, const Problem& problem,
                                       std::size_t task, std::vector<std::size_t> domain) {
  const std::size_t before = problem.before[task];
  const auto suitability = [&](std::size_t behavior) { return facts.suitability(behavior, task); };
  const bool may_stop = std::find(domain.begin(), domain.end(), none) != domain.end();
  domain.erase(std::remove(domain.begin(), domain.end(), none), domain.end());
  std::stable_sort(domain.begin(), domain.end(),
                   [&](std::size_t a, std::size_t b) { return suitability(a) > suitability(b); });
  if (before == none) {
    if (may_stop) {
      domain.insert(domain.begin(), none);
    }
    return domain;
  }
  const auto own = std::find(domain.begin(), domain.end(), before);
  if (own != domain.end() && suitability(before) == suitability(domain.front())) {
    std::rotate(domain.begin(), own, own + 1);
  }
  if (may_stop) {
    domain.push_back(none);
  }
  return domain;
}

Solution evaluate(const CatalogFacts& facts, const Problem& problem, const Assignment& values,
                  std::vector<std::size_t> ranks) {
  Solution solution;
  solution.values = values;
  solution.ranks = std::move(ranks);
  for (const ActiveRequest& request : problem.requests) {
    const bool runs = values[request.task] != none;
    solution.satisfied.push_back(runs);
    solution.satisfied_count += runs ? 1U : 0U;
  }
  for (const ActiveRequest& request : problem.suspended) {
    solution.resumed.push_back(values[request.task] != none);
  }
  for (const ActiveRequest& request : problem.unasked) {
    solution.unasked.push_back(values[request.task] != none);
  }
  solution.asked = asked_product(facts, problem, values);
  solution.suitability = 1;
  std::set<std::size_t> active;
  for (const std::size_t task : facts.groups[problem.group]) {
    if (values[task] == none) {
      solution.suitability *= whole_degree;
      continue;
    }
    active.insert(values[task]);
    solution.suitability *= facts.suitability(values[task], task);
    solution.running_unasked += facts.catalog.tasks[task].start_on_request ? 0U : 1U;
  }
  for (const std::size_t behavior : active) {
    solution.changes += problem.active.contains(behavior) ? 0U : 1U;
  }
  for (const std::size_t behavior : problem.active) {
    solution.changes += active.contains(behavior) ? 0U : 1U;
  }
  return solution;
}

const char* to_string(Criterion criterion) {
  switch (criterion) {
    case Criterion::satisfied:
      return "f1, number of requests";
    case Criterion::request_order:
      return "f1, order of requests";
    case Criterion::suspended:
      return "f1, suspended requests";
    case Criterion::asked:
      return "f1, product of what was asked for";
    case Criterion::unasked:
      return "f1, what nobody asked for";
    case Criterion::suitability:
      return "f2, suitability";
    case Criterion::idle:
      return "f3, idle tasks";
    case Criterion::changes:
      return "f4, changes";
    case Criterion::ranks:
      return "canonical order";
    case Criterion::nothing:
      return "nothing";
  }
  return "";
}

struct Comparison {
  bool first_is_better = false;
  Criterion decided_by = Criterion::nothing;
};

// Compares two solutions of one problem by the objectives, in their order.
Comparison compare(const Solution& a, const Solution& b) {
  if (a.satisfied_count != b.satisfied_count) {
    return {a.satisfied_count > b.satisfied_count, Criterion::satisfied};
  }
  for (std::size_t i = 0; i < a.satisfied.size(); ++i) {
    if (a.satisfied[i] != b.satisfied[i]) {
      return {a.satisfied[i], Criterion::request_order};
    }
  }
  for (std::size_t i = 0; i < a.resumed.size(); ++i) {
    if (a.resumed[i] != b.resumed[i]) {
      return {a.resumed[i], Criterion::suspended};
    }
  }
  if (a.asked != b.asked) {
    return {a.asked > b.asked, Criterion::asked};
  }
  for (std::size_t i = 0; i < a.unasked.size(); ++i) {
    if (a.unasked[i] != b.unasked[i]) {
      return {a.unasked[i], Criterion::unasked};
    }
  }
  if (a.suitability != b.suitability) {
    return {a.suitability > b.suitability, Criterion::suitability};
  }
  if (a.running_unasked != b.running_unasked) {
    return {a.running_unasked < b.running_unasked, Criterion::idle};
  }
  if (a.changes != b.changes) {
    return {a.changes < b.changes, Criterion::changes};
  }
  if (a.ranks != b.ranks) {
    return {a.ranks < b.ranks, Criterion::ranks};
  }
  return {};
}

void count_boundaries(const CatalogFacts& facts, const Problem& problem, const Assignment& values,
                      Statistics& statistics) {
  bool exact = false;
  bool exact_product = false;
  const auto look_at = [&](std::size_t task, Millionths minimum) {
    if (minimum == 0) {
      return;
    }
    const ExactPerformance reached = performance(facts, values, task);
    if (reached.product == scaled_minimum(reached, minimum)) {
      exact = true;
      exact_product = exact_product || reached.factors_below_one >= 2;
    }
  };
  for (const std::size_t task : facts.groups[problem.group]) {
    if (values[task] == none) {
      continue;
    }
    look_at(task, facts.catalog.tasks[task].minimum);
    for (const Requirement& requirement : facts.catalog.behaviors[values[task]].requirements) {
      look_at(requirement.task, requirement.minimum);
    }
  }
  if (exact) {
    statistics.count("performance: exactly its minimum");
  }
  if (exact_product) {
    statistics.count("performance: exactly its minimum, a true product");
  }
}

// Which criteria told the best solution from at least one other.
void count_criteria(const Solution& best, const std::vector<Solution>& solutions,
                    Statistics& statistics) {
  std::set<Criterion> decisive;
  for (const Solution& solution : solutions) {
    decisive.insert(compare(best, solution).decided_by);
  }
  decisive.erase(Criterion::nothing);
  for (const Criterion criterion : decisive) {
    statistics.count(std::string("decided by: ") + to_string(criterion));
  }
}

}  // namespace

CatalogFacts::CatalogFacts(Catalog source) : catalog(std::move(source)) {
  const std::size_t tasks = catalog.tasks.size();
  behaviors_of.resize(tasks);
  excludes.resize(tasks);
  group_of.resize(tasks);
  std::vector<std::size_t> parent(tasks);
  for (std::size_t task = 0; task < tasks; ++task) {
    parent[task] = task;
  }

  for (std::size_t b = 0; b < catalog.behaviors.size(); ++b) {
    const Behavior& behavior = catalog.behaviors[b];
    for (const Performance& performed : behavior.performs) {
      behaviors_of[performed.task].push_back(b);
      join(parent, performed.task, behavior.performs.front().task);
    }
    for (const Requirement& requirement : behavior.requirements) {
      join(parent, requirement.task, behavior.performs.front().task);
    }
  }
  lists_of.resize(tasks);
  for (std::size_t place = 0; place < catalog.exclusivity.size(); ++place) {
    const std::vector<std::size_t>& list = catalog.exclusivity[place];
    for (const std::size_t a : list) {
      join(parent, a, list.front());
      if (lists_of[a].empty() || lists_of[a].back() != place) {
        lists_of[a].push_back(place);
      }
      for (const std::size_t b : list) {
        if (a != b && catalog.most(place) == 1) {
          excludes[a].insert(b);
        }
      }
    }
  }

  std::vector<std::size_t> group_of_root(tasks, none);
  for (std::size_t task = 0; task < tasks; ++task) {
    std::size_t& group = group_of_root[root_of(parent, task)];
    if (group == none) {
      group = groups.size();
      groups.emplace_back();
    }
    group_of[task] = group;
    groups[group].push_back(task);
  }
  for (std::size_t b = 0; b < catalog.behaviors.size(); ++b) {
    level_of.push_back(compute_level(*this, b));
  }
}

Millionths CatalogFacts::suitability(std::size_t behavior, std::size_t task) const {
  for (const Performance& performed : catalog.behaviors[behavior].performs) {
    if (performed.task == task) {
      return performed.suitability;
    }
  }
  return 0;
}

std::size_t CatalogFacts::group_of_behavior(std::size_t behavior) const {
  return group_of[catalog.behaviors[behavior].performs.front().task];
}

bool CatalogFacts::fits(std::size_t behavior, const std::vector<std::size_t>& variables) const {
  const std::vector<Condition>& conditions = catalog.behaviors[behavior].situation;
  return std::all_of(conditions.begin(), conditions.end(), [&](const Condition& condition) {
    return std::find(condition.values.begin(), condition.values.end(),
                     variables[condition.variable]) != condition.values.end();
  });
}

ExactPerformance performance(const CatalogFacts& facts, const Assignment& values,
                             std::size_t task) {
  std::vector<bool> required(values.size(), false);
  collect_required(facts, values, task, required);
  required[task] = true;
  ExactPerformance result;
  result.product = 1;
  for (std::size_t t = 0; t < values.size(); ++t) {
    if (required[t]) {
      const Millionths suitability = facts.suitability(values[t], t);
      result.product *= suitability;
      ++result.factors;
      result.factors_below_one += suitability < whole_degree ? 1U : 0U;
    }
  }
  return result;
}

Integer power_of_million(std::size_t exponent) {
  Integer result = 1;
  for (std::size_t i = 0; i < exponent; ++i) {
    result *= whole_degree;
  }
  return result;
}

double nearest_double(const Integer& numerator, const Integer& denominator) {
  if (numerator == 0) {
    return 0.0;
  }
  // Scale the quotient so that it has at least 64 bits, then round it to the 53 of a double.
  const auto bits = [](const Integer& value) { return static_cast<int>(msb(value)) + 1; };
  const int shift = std::max(0, 65 + bits(denominator) - bits(numerator));
  Integer quotient;
  Integer remainder;
  divide_qr(Integer(numerator << shift), denominator, quotient, remainder);
  const int dropped = bits(quotient) - 53;
  Integer kept = quotient >> dropped;
  const Integer half = Integer(1) << (dropped - 1);
  const Integer rest = quotient - (kept << dropped);
  const bool above_half = rest > half || (rest == half && remainder != 0);
  const bool tie = rest == half && remainder == 0;
  if (above_half || (tie && (kept & 1) != 0)) {
    ++kept;
  }
  return std::ldexp(static_cast<double>(kept.convert_to<std::uint64_t>()), dropped - shift);
}

void sort_requests(std::vector<ActiveRequest>& requests) {
  std::sort(requests.begin(), requests.end(), [](const ActiveRequest& a, const ActiveRequest& b) {
    return a.priority != b.priority ? a.priority > b.priority : a.set_by > b.set_by;
  });
}

Integer asked_product(const CatalogFacts& facts, const Problem& problem, const Assignment& values) {
  std::vector<bool> counts(values.size(), false);
  for (const std::vector<ActiveRequest>* requests : {&problem.requests, &problem.suspended}) {
    for (const ActiveRequest& request : *requests) {
      if (values[request.task] != none) {
        counts[request.task] = true;
        collect_required(facts, values, request.task, counts);
      }
    }
  }
  Integer product = 1;
  for (const std::size_t task : facts.groups[problem.group]) {
    product *= counts[task] ? facts.suitability(values[task], task) : whole_degree;
  }
  return product;
}

Integer search_space(const Problem& problem) {
  Integer space = 1;
  for (const std::vector<std::size_t>& domain : problem.domains) {
    space *= domain.size();
  }
  return space;
}

std::vector<Solution> enumerate(const CatalogFacts& facts, const Problem& problem) {
  const std::vector<std::size_t>& tasks = facts.groups[problem.group];
  std::vector<std::vector<std::size_t>> ranked;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    ranked.push_back(ranked_domain(facts, problem, tasks[i], problem.domains[i]));
    if (ranked.back().empty()) {
      return {};
    }
  }

  // Count through all assignments, as an odometer does; ranks are its digits, the last one first.
  std::vector<Solution> solutions;
  std::vector<std::size_t> ranks(tasks.size(), 0);
  Assignment values = problem.before;
  bool more = true;
  while (more) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      values[tasks[i]] = ranked[i][ranks[i]];
    }
    if (satisfies_constraints(facts, values, tasks)) {
      solutions.push_back(evaluate(facts, problem, values, ranks));
    }
    more = false;
    for (std::size_t i = tasks.size(); i-- > 0 && !more;) {
      ++ranks[i];
      more = ranks[i] < ranked[i].size();
      if (!more) {
        ranks[i] = 0;
      }
    }
  }
  return solutions;
}

Criterion first_difference(const Solution& a, const Solution& b) {
  return compare(a, b).decided_by;
}

bool is_better(const Solution& a, const Solution& b) { return compare(a, b).first_is_better; }

std::vector<Solution> solve_all(const CatalogFacts& facts, const Problem& problem) {
  std::vector<Solution> solutions = enumerate(facts, problem);
  // Of the best answer f2 says the same then, and lists of alternatives are told apart without it.
  for (Solution& solution : solutions) {
    if (problem.unasked.empty()) solution.asked = 0;
  }
  std::sort(solutions.begin(), solutions.end(), is_better);
  return solutions;
}

std::optional<Solution> solve(const CatalogFacts& facts, const Problem& problem,
                              Statistics* statistics) {
  const std::vector<Solution> solutions = enumerate(facts, problem);
  if (solutions.empty()) {
    return std::nullopt;
  }
  const Solution best = *std::min_element(solutions.begin(), solutions.end(), is_better);
  if (statistics != nullptr) {
    count_criteria(best, solutions, *statistics);
    count_boundaries(facts, problem, best.values, *statistics);
  }
  return best;
}

}  // namespace cbc::oracle
