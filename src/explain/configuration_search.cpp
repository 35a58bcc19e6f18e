#include "explain/configuration_search.h"

#include <algorithm>
#include <utility>

#include "explain/narrow.h"

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

}  // namespace cbc
