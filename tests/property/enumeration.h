// The solver of the oracle: it looks at every assignment of a group, and compares the solutions by
// the objectives. No pruning, no bounds; exact arithmetic.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

#include "model.h"
#include "statistics.h"

namespace cbc::oracle {

using Integer = boost::multiprecision::cpp_int;

// The value of every task of the catalog: none or a behavior.
using Assignment = std::vector<std::size_t>;

// What follows from a catalog alone.
struct CatalogFacts {
  explicit CatalogFacts(Catalog source);

  Millionths suitability(std::size_t behavior, std::size_t task) const;
  std::size_t group_of_behavior(std::size_t behavior) const;

  // Whether the behavior fits the values of the situation variables.
  bool fits(std::size_t behavior, const std::vector<std::size_t>& variables) const;

  Catalog catalog;
  std::vector<std::vector<std::size_t>> behaviors_of;  // of each task, in catalog order
  std::vector<std::set<std::size_t>> excludes;     // tasks that share a list of one with each task
  std::vector<std::vector<std::size_t>> lists_of;  // of each task: the lists that have it
  std::vector<std::vector<std::size_t>> groups;    // tasks, in catalog order
  std::vector<std::size_t> group_of;               // of each task
  std::vector<std::size_t> level_of;               // of each behavior
};

// Performance(task) is `product` / 10^(6 * `factors`).
struct ExactPerformance {
  Integer product;
  std::size_t factors = 0;
  std::size_t factors_below_one = 0;
};

ExactPerformance performance(const CatalogFacts& facts, const Assignment& values, std::size_t task);

Integer power_of_million(std::size_t exponent);

// The double nearest to numerator / denominator, ties to even; both are non-negative.
double nearest_double(const Integer& numerator, const Integer& denominator);

struct ActiveRequest {
  std::size_t task = 0;
  int priority = 0;
  std::int64_t set_by = 0;  // a later event has a higher number
};

struct Problem {
  std::size_t group = 0;
  // Of the tasks of the group; may include none. Ranks of equally suitable behaviors follow its
  // order.
  std::vector<std::vector<std::size_t>> domains;
  // Of the group, each sorted; see sort_requests.
  std::vector<ActiveRequest> requests;  // of priority 1 or more
  std::vector<ActiveRequest> suspended;
  std::vector<ActiveRequest> unasked;  // of priority 0
  Assignment before;             // values before the event, a finished behavior still included
  std::set<std::size_t> active;  // behaviors active just before the event, a finished one not
};

struct Solution {
  Assignment values;                // of all tasks
  std::vector<bool> satisfied;      // of the requests of the problem, in their order
  std::size_t satisfied_count = 0;  // f1
  std::vector<bool> resumed;        // of the suspended requests
  Integer asked;                    // what was asked for, times 10^(6 * tasks of the group)
  std::vector<bool> unasked;        // of the requests of priority 0: whether the task runs
  Integer suitability;              // f2, times 10^(6 * tasks of the group)
  std::size_t running_unasked = 0;  // f3: running tasks that are not start_on_request
  std::size_t changes = 0;          // f4
  std::vector<std::size_t> ranks;   // canonical order: of the value of each task of the group
};

// The product of the suitabilities of the tasks with a request of priority 1 or more that run, and
// of what they require, each once; times 10^(6 * tasks of the group).
Integer asked_product(const CatalogFacts& facts, const Problem& problem, const Assignment& values);

// What tells two solutions apart, in order.
enum class Criterion {
  satisfied,
  request_order,
  suspended,
  asked,
  unasked,
  suitability,
  idle,
  changes,
  ranks,
  nothing
};

// The first criterion in which the two differ.
Criterion first_difference(const Solution& a, const Solution& b);
bool is_better(const Solution& a, const Solution& b);

// From the highest priority to the lowest, within one from the most recent to the oldest.
void sort_requests(std::vector<ActiveRequest>& requests);

Integer search_space(const Problem& problem);

// All solutions, depth first: tasks in catalog order, values by rank.
std::vector<Solution> enumerate(const CatalogFacts& facts, const Problem& problem);

// All solutions, the best first.
std::vector<Solution> solve_all(const CatalogFacts& facts, const Problem& problem);

// The best solution, or nothing if there is none.
std::optional<Solution> solve(const CatalogFacts& facts, const Problem& problem,
                              Statistics* statistics);

}  // namespace cbc::oracle
