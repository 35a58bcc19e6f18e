#include "explain/alternatives.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

#include "explain/reasons.h"

namespace cbc {
namespace {

/// Searches and their decisions, times tasks of the group, for one answer.
constexpr std::uint64_t most_effort = 50'000'000;

SearchOptions search_options() {
  SearchOptions options;
  options.max_nodes = 100'000;
  return options;
}

}  // namespace

ConfigurationSearch::ConfigurationSearch(const CompiledCatalog& catalog,
                                         const std::vector<std::uint32_t>& ranks)
    : catalog_(catalog), solver_(catalog, search_options(), ranks), comparison_(catalog, ranks) {}

void ConfigurationSearch::load(const Problem& problem, const ObjectiveValues& elsewhere) {
  whole_ = &problem;
  comparison_.load(problem, elsewhere);
}

void ConfigurationSearch::begin() {
  effort_ = 0;
  is_cut_ = false;
}

std::optional<Configuration> ConfigurationSearch::solve(const Problem& part) {
  Assignment places;
  const SearchResult result = solver_.solve(part, places);
  effort_ += (1 + result.nodes) * part.may_stop.size();
  if (result.status == SearchStatus::infeasible) return std::nullopt;
  if (result.status != SearchStatus::optimal || effort_ > most_effort) {
    is_cut_ = true;
    return std::nullopt;
  }
  return comparison_.evaluate(std::move(places));
}

std::optional<Configuration> ConfigurationSearch::find_best(std::span<const Demands> ways) {
  begin();
  std::optional<Configuration> best;
  for (const Demands& demands : ways) {
    Problem part = *whole_;
    part.part_of = whole_;
    for (const Demand& demand : demands) narrow(catalog_, demand, part);
    std::optional<Configuration> found = solve(part);
    if (is_cut_) return std::nullopt;
    if (!found) continue;
    // Two ways may have the same best.
    const bool is_better = !best || (found->places != best->places &&
                                     comparison_.compare(*found, *best).first_is_better);
    if (is_better) best = std::move(found);
  }
  return best;
}

/// Lawler's partition: of all parts, the one with the best solution gives the next one, and what is
/// left of it falls into parts again: one for each task, in which those before it have the values
/// of that solution, and it has another.
std::vector<Configuration> ConfigurationSearch::list_best(const Assignment& best,
                                                          std::size_t count) {
  begin();
  std::vector<Configuration> list;
  std::vector<Part> parts;  // the best comes last
  parts.push_back({*whole_, comparison_.evaluate(best)});
  parts.back().problem.part_of = whole_;
  while (list.size() < count && !parts.empty()) {
    Part part = std::move(parts.back());
    parts.pop_back();
    list.push_back(part.best);
    if (list.size() < count) split(std::move(part), count - list.size(), parts);
    if (is_cut_) break;
  }
  return list;
}

void ConfigurationSearch::split(Part part, std::size_t most, std::vector<Part>& parts) {
  const TaskId first = catalog_.group_tasks[part.problem.group];
  for (std::uint32_t task = 0; task < part.best.places.size(); ++task) {
    if (!is_open(catalog_, part.problem, first + task)) continue;
    const std::uint32_t place = part.best.places[task];
    Part other;
    other.problem = part.problem;
    Demand demand;
    demand.task = first + task;
    demand.place = place;
    demand.kind = place == none ? Demand::Kind::run : Demand::Kind::has_not;
    narrow(catalog_, demand, other.problem);
    std::optional<Configuration> found = solve(other.problem);
    if (is_cut_) return;
    if (found) {
      other.best = std::move(*found);
      insert(std::move(other), most, parts);
    }
    demand.kind = place == none ? Demand::Kind::stop : Demand::Kind::has;
    narrow(catalog_, demand, part.problem);
  }
}

/// Keeps the `most` best parts: no others can come to be looked at.
void ConfigurationSearch::insert(Part part, std::size_t most, std::vector<Part>& parts) {
  const auto place =
      std::lower_bound(parts.begin(), parts.end(), part, [&](const Part& a, const Part& b) {
        return comparison_.compare(b.best, a.best).first_is_better;
      });
  parts.insert(place, std::move(part));
  if (parts.size() > most) parts.erase(parts.begin());
}

std::string_view name_of(Criterion criterion) {
  static constexpr std::array<std::string_view, 6> names{"requests", "request_order", "suitability",
                                                         "idle",     "changes",       "canonical"};
  return names[static_cast<std::size_t>(criterion)];
}

void Comparison::load(const Problem& problem, const ObjectiveValues& elsewhere) {
  problem_ = &problem;
  elsewhere_ = elsewhere;
  first_task_ = catalog_.group_tasks[problem.group];
  order_.load(problem);
}

Configuration Comparison::evaluate(Assignment places) const {
  Configuration configuration;
  ObjectiveValues& objective = configuration.objective;
  objective = elsewhere_;
  objective.requests += static_cast<std::uint32_t>(problem_->requests.size());
  for (const std::uint32_t task : problem_->requests) {
    if (places[task] != none) ++objective.satisfied;
  }
  for (std::uint32_t task = 0; task < places.size(); ++task) {
    if (places[task] != none && catalog_.tasks[first_task_ + task].start_on_request == 0) {
      ++objective.idle_running;
    }
  }
  objective.changes = count_changes(places);
  configuration.places = std::move(places);
  return configuration;
}

std::uint32_t Comparison::count_changes(const Assignment& places) const {
  std::vector<BehaviorId> active;
  for (std::uint32_t task = 0; task < places.size(); ++task) {
    if (places[task] != none) {
      active.push_back(catalog_.values[first_task_ + task][places[task]].behavior);
    }
  }
  std::sort(active.begin(), active.end());
  active.erase(std::unique(active.begin(), active.end()), active.end());
  std::vector<BehaviorId> changed;
  std::set_symmetric_difference(active.begin(), active.end(), problem_->active.begin(),
                                problem_->active.end(), std::back_inserter(changed));
  return static_cast<std::uint32_t>(changed.size());
}

Difference Comparison::compare(const Configuration& a, const Configuration& b) {
  Difference difference;
  const auto decide = [&](Criterion criterion, bool first_is_better) {
    difference.criterion = criterion;
    difference.first_is_better = first_is_better;
    return difference;
  };
  // Of all requests, in order: those that only one of the two satisfies.
  TaskId only_first = none;
  TaskId only_second = none;
  for (const std::uint32_t task : problem_->requests) {
    const bool first_runs = a.places[task] != none;
    const bool second_runs = b.places[task] != none;
    if (first_runs && !second_runs && only_first == none) only_first = first_task_ + task;
    if (second_runs && !first_runs && only_second == none) only_second = first_task_ + task;
    if (difference.task == none && first_runs != second_runs) difference.task = first_task_ + task;
  }
  if (a.objective.satisfied != b.objective.satisfied) {
    difference.task = none;
    return decide(Criterion::requests, a.objective.satisfied > b.objective.satisfied);
  }
  if (difference.task != none) {
    const bool first_is_better = difference.task == only_first;
    difference.other_task = first_is_better ? only_second : only_first;
    return decide(Criterion::request_order, first_is_better);
  }
  if (const auto order = compare_suitability(a.places, b.places); order != 0) {
    return decide(Criterion::suitability, order > 0);
  }
  if (a.objective.idle_running != b.objective.idle_running) {
    return decide(Criterion::idle, a.objective.idle_running < b.objective.idle_running);
  }
  if (a.objective.changes != b.objective.changes) {
    return decide(Criterion::changes, a.objective.changes < b.objective.changes);
  }
  std::uint32_t task = 0;
  while (a.places[task] == b.places[task]) ++task;
  difference.task = first_task_ + task;
  return decide(Criterion::canonical,
                order_.key(task, a.places[task]) < order_.key(task, b.places[task]));
}

std::strong_ordering Comparison::compare_suitability(const Assignment& a, const Assignment& b) {
  const auto suitability = [&](std::size_t task, std::uint32_t place) {
    const auto values = catalog_.values[first_task_ + task];
    return place == none ? one_million : values[place].suitability;
  };
  // Equal factors may be left out unless they are zero.
  first_.clear();
  second_.clear();
  for (std::size_t task = 0; task < a.size(); ++task) {
    const Millionths ours = suitability(task, a[task]);
    const Millionths theirs = suitability(task, b[task]);
    if (ours == theirs && ours != 0) continue;
    first_.multiply(ours);
    second_.multiply(theirs);
  }
  return ExactProduct::compare(first_, second_);
}

}  // namespace cbc
