// The dual ascent of CostBound, but with reasons, and with cuts that are chosen more carefully, as
// which cut comes next decides how strong the bound is. As in LM-cut, a cut follows the *heights*:
// the height of a task (h^max in planning) is the least sum of the residual cost of one of its
// behaviors and of the height of the highest task that this behavior requires. Each behavior of no
// residual cost leads on to the highest task that it requires, its supporter. An ascent goes in
// rounds: each needed task is the root of a cut, the highest one first, and then the heights are
// updated. They only sink, so only those that depend on an arc of a cut change.
//
// To update them after each cut makes bounds slightly stronger, but takes longer than it saves.
// Every ascent begins anew: to continue that of the node above is ten times faster, but gives so
// much weaker bounds that searches take far more than ten times as many nodes.
#include "runtime/solver/landmark_bound.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "runtime/solver/cost_bound.h"

namespace cbc {
namespace {

std::int64_t add(std::int64_t a, std::int64_t b) { return std::min(prohibitive_cost, a + b); }

}  // namespace

LandmarkBound::LandmarkBound(const CompiledCatalog& catalog, const Domains& domains,
                             const CatalogTrail& trail)
    : catalog_(catalog), domains_(domains), trail_(trail) {
  const std::size_t most_tasks = most_in_a_group(catalog.group_tasks);
  in_cut_.resize(most_tasks, 0);
  places_.resize(most_tasks, 0);
}

void LandmarkBound::load() {
  const TaskId first = domains_.first_task();
  const std::uint32_t tasks = domains_.task_count();
  value_begin_.clear();
  requirement_begin_.clear();
  requirements_.clear();
  for (LocalTask task(0); task < tasks; ++task) {
    value_begin_.push_back(static_cast<std::uint32_t>(requirement_begin_.size()));
    for (const Value& value : domains_.values(task)) {
      requirement_begin_.push_back(static_cast<std::uint32_t>(requirements_.size()));
      for (const CompiledRequirement& requirement : catalog_.requirements[value.behavior]) {
        requirements_.push_back(requirement.task - first);
      }
    }
  }
  value_begin_.push_back(static_cast<std::uint32_t>(requirement_begin_.size()));
  requirement_begin_.push_back(static_cast<std::uint32_t>(requirements_.size()));
  is_reached_.assign(tasks, 0);
  heights_.assign(tasks, 0);
  seen_heights_.assign(tasks, 0);
  candidates_begin_.assign(tasks, 0);
  candidates_end_.assign(tasks, 0);
  first_supported_.assign(tasks, none);
  cuts_.clear();
  grounds_.clear();
  saved_.clear();
  marks_.clear();
  find_relevant_tasks();
  marked_.assign((order_.size() + 63) / 64, 0);
  first_marked_ = SIZE_MAX;
  measure_ = Measure::idle;
  set_measure(Measure::log);
}

void LandmarkBound::set_measure(Measure measure) {
  if (measure == measure_) return;
  measure_ = measure;
  costs_.clear();
  highest_cost_ = 0;
  for (LocalTask task(0); task < domains_.task_count(); ++task) {
    const bool is_idle = catalog_.tasks[domains_.first_task() + task].start_on_request == 0;
    for (const Value& value : domains_.values(task)) {
      std::int64_t cost = value.suitability == 0 ? prohibitive_cost : value.cost;
      if (measure == Measure::idle) cost = cost > 0 ? prohibitive_cost : is_idle ? 1 : 0;
      costs_.push_back(cost);
      highest_cost_ = std::max(highest_cost_, cost);
    }
  }
  version_ = 0;
  level_ = none;
}

void LandmarkBound::find_relevant_tasks() {
  const TaskId first = domains_.first_task();
  ++cut_number_;
  relevant_.clear();
  const auto add_task = [this](LocalTask task) {
    if (in_cut_[task] == cut_number_) return;
    in_cut_[task] = cut_number_;
    relevant_.push_back(task);
  };
  for (const LocalTask task : domains_.needed_tasks()) add_task(task);
  for (const LocalTask task : trail_.requests()) add_task(task);
  // NOLINTNEXTLINE(modernize-loop-convert): the list grows
  for (std::size_t next = 0; next < relevant_.size(); ++next) {
    for (const cbc::Arc& arc : catalog_.arcs[first + relevant_[next]]) add_task(arc.target - first);
  }
  order_.clear();
  for (std::uint32_t place = 0; place < domains_.task_count(); ++place) {
    const LocalTask task = catalog_.topological_order[first + place] - first;
    if (in_cut_[task] != cut_number_) continue;
    places_[task] = static_cast<std::uint32_t>(order_.size());
    order_.push_back(task);
  }
}

void LandmarkBound::begin_level() {
  marks_.push_back({cuts_.size(), grounds_.size(), saved_.size()});
}

void LandmarkBound::backtrack_to(std::uint32_t level) {
  if (level >= marks_.size()) return;
  version_ = 0;
  if (level_ != none && level_ > level) level_ = none;
  cuts_.resize(marks_[level].cuts);
  grounds_.resize(marks_[level].grounds);
  saved_.resize(marks_[level].saved);
  marks_.resize(level);
}

void LandmarkBound::start_ascent() {
  bound_ = 0;
  level_ = trail_.level();
  first_cut_ = static_cast<std::uint32_t>(cuts_.size());
  residuals_ = costs_;
  unsettled_.clear();
  candidates_.clear();
  targets_.clear();
  find_reached_tasks();
  for (const LocalTask task : order_) {
    if (is_reached_[task] != 0) add_candidates(task);
  }
}

/// Finds the height of a task from those of the tasks that it may require.
void LandmarkBound::add_candidates(LocalTask task) {
  const auto first = static_cast<std::uint32_t>(candidates_.size());
  const std::uint32_t begin = value_begin_[task];
  const std::uint32_t end = value_begin_[task + 1];
  std::int64_t height = prohibitive_cost;
  first_supported_[task] = none;
  for (std::uint32_t value = begin; value < end; ++value) {
    Candidate candidate;
    candidate.value = value;
    candidate.task = task;
    candidate.first_target = static_cast<std::uint32_t>(targets_.size());
    for (std::uint32_t at = requirement_begin_[value]; at < requirement_begin_[value + 1]; ++at) {
      const LocalTask target = requirements_[at];
      if (seen_heights_[target] > 0) targets_.push_back(target);
    }
    candidate.end_target = static_cast<std::uint32_t>(targets_.size());
    candidate.is_removed = !domains_.has(task, value - begin);
    candidates_.push_back(candidate);
    if (candidate.is_removed) continue;
    find_supporter(static_cast<std::uint32_t>(candidates_.size() - 1));
    height = std::min(height, height_of(candidates_.back()));
  }
  heights_[task] = height;
  const bool is_needed = domains_.needed(task);
  seen_heights_[task] = is_needed ? 0 : height;
  candidates_begin_[task] = first;
  candidates_end_[task] = static_cast<std::uint32_t>(candidates_.size());
  if (is_needed && height > 0) unsettled_.push_back(task);
}

/// The tasks that the needed ones may still require.
void LandmarkBound::find_reached_tasks() {
  std::fill(is_reached_.begin(), is_reached_.end(), std::uint8_t{0});
  for (const LocalTask task : domains_.needed_tasks()) is_reached_[task] = 1;
  for (auto at = order_.rbegin(); at != order_.rend(); ++at) {
    const LocalTask task = *at;
    if (is_reached_[task] == 0) continue;
    for (const std::uint32_t index : domains_.indices(task)) {
      const std::uint32_t value = value_begin_[task] + index;
      for (std::uint32_t r = requirement_begin_[value]; r < requirement_begin_[value + 1]; ++r) {
        is_reached_[requirements_[r]] = 1;
      }
    }
  }
}

std::int64_t LandmarkBound::ascend(std::int64_t threshold, const SearchBudget& budget,
                                   std::uint64_t steps) {
  const std::uint64_t last_step = steps == UINT64_MAX ? UINT64_MAX : steps_ + steps;
  if (version_ != trail_.version()) start_ascent();
  version_ = trail_.version();
  next_check_ = steps_;
  bool must_end = false;
  while (bound_ <= threshold && !must_end && sort_unsettled()) {
    for (const LocalTask root : unsettled_) {
      must_end = has_to_end(budget, last_step);
      if (bound_ > threshold || must_end) break;
      if (find_cut(root)) subtract_cut(root);
    }
    update_heights();
  }
  return bound_;
}

bool LandmarkBound::has_to_end(const SearchBudget& budget, std::uint64_t last_step) {
  constexpr std::uint64_t steps_between_checks = 10'000;
  if (steps_ < next_check_) return false;
  next_check_ = steps_ + steps_between_checks;
  return steps_ > last_step || budget.is_out_of_time();
}

std::int64_t LandmarkBound::bound_again() {
  set_measure(Measure::log);
  version_ = 0;
  return ascend(INT64_MAX, {}, most_steps);
}

void LandmarkBound::mark(LocalTask task) {
  const std::uint32_t place = places_[task];
  marked_[place / 64] |= std::uint64_t{1} << (place % 64);
  first_marked_ = std::min<std::size_t>(first_marked_, place / 64);
}

/// In topological order: what a task requires comes before it. Heights only sink.
void LandmarkBound::update_heights() {
  for (std::size_t word = first_marked_; word < marked_.size(); ++word) {
    while (marked_[word] != 0) {
      const auto bit = static_cast<std::size_t>(std::countr_zero(marked_[word]));
      marked_[word] &= marked_[word] - 1;
      const LocalTask task = order_[64 * word + bit];
      if (domains_.needed(task)) continue;
      seen_heights_[task] = heights_[task];
      std::uint32_t number = std::exchange(first_supported_[task], none);
      while (number != none) {
        const std::uint32_t next = candidates_[number].next;
        find_supporter(number);
        lower(candidates_[number]);
        number = next;
      }
    }
  }
  first_marked_ = SIZE_MAX;
}

/// Lowers the height of the candidate's task to that of the candidate.
void LandmarkBound::lower(const Candidate& candidate) {
  const std::int64_t height = height_of(candidate);
  if (height >= heights_[candidate.task]) return;
  heights_[candidate.task] = height;
  mark(candidate.task);
}

void LandmarkBound::find_supporter(std::uint32_t number) {
  Candidate& candidate = candidates_[number];
  LocalTask highest = none;
  std::int64_t height = 0;
  for (std::uint32_t at = candidate.first_target; at < candidate.end_target; ++at) {
    const LocalTask target = targets_[at];
    if (seen_heights_[target] <= height) continue;
    highest = target;
    height = seen_heights_[target];
  }
  candidate.supporter = highest;
  if (highest == none) return;
  candidate.next = first_supported_[highest];
  first_supported_[highest] = number;
}

std::int64_t LandmarkBound::estimate(LocalTask task, std::uint32_t index) const {
  const std::uint32_t value = value_begin_[task] + index;
  std::int64_t cost = residuals_[value];
  for (std::uint32_t at = requirement_begin_[value]; at < requirement_begin_[value + 1]; ++at) {
    cost = add(cost, seen_heights_[requirements_[at]]);
  }
  return cost;
}

/// The highest comes first. False if all needed tasks can run at no residual cost.
bool LandmarkBound::sort_unsettled() {
  std::erase_if(unsettled_, [this](LocalTask task) { return heights_[task] == 0; });
  std::sort(unsettled_.begin(), unsettled_.end(), [this](std::uint32_t a, std::uint32_t b) {
    return heights_[a] != heights_[b] ? heights_[a] > heights_[b] : a < b;
  });
  steps_ += unsettled_.size();
  return !unsettled_.empty();
}

/// Collects the tasks that keep the root from running at no residual cost. False if, after earlier
/// cuts of the round, nothing does.
bool LandmarkBound::find_cut(LocalTask root) {
  ++cut_number_;
  cut_.assign(1, root);
  in_cut_[root] = cut_number_;
  for (std::size_t next = 0; next < cut_.size(); ++next) {
    const LocalTask task = cut_[next];
    ++steps_;
    for (std::uint32_t number = candidates_begin_[task]; number < candidates_end_[task]; ++number) {
      const Candidate& candidate = candidates_[number];
      if (residuals_[candidate.value] > 0 || candidate.is_removed || requires_cut(candidate)) {
        continue;
      }
      if (candidate.supporter == none) return false;
      in_cut_[candidate.supporter] = cut_number_;
      cut_.push_back(candidate.supporter);
    }
  }
  return true;
}

bool LandmarkBound::requires_cut(const Candidate& candidate) const {
  for (std::uint32_t at = candidate.first_target; at < candidate.end_target; ++at) {
    if (in_cut_[targets_[at]] == cut_number_) return true;
  }
  return false;
}

/// Subtracts the cut's minimum from its arcs, and adds it to the bound. A removed value that costs
/// no less than the minimum might as well be there; otherwise the minimum rests on its removal.
void LandmarkBound::subtract_cut(LocalTask root) {
  arcs_.clear();
  std::int64_t amount = prohibitive_cost;
  for (const LocalTask task : cut_) {
    for (std::uint32_t number = candidates_begin_[task]; number < candidates_end_[task]; ++number) {
      const Candidate& candidate = candidates_[number];
      if (requires_cut(candidate)) continue;
      arcs_.push_back(number);
      if (!candidate.is_removed) amount = std::min(amount, residuals_[candidate.value]);
    }
  }
  const std::size_t first_ground = grounds_.size();
  std::uint32_t level = trail_.level_of(Trail::runs(root));
  for (const std::uint32_t number : arcs_) {
    const Candidate& arc = candidates_[number];
    if (residuals_[arc.value] >= amount) {
      residuals_[arc.value] -= amount;
      if (!arc.is_removed) lower(arc);
    } else {
      const Literal removal =
          negate(trail_.has_value(arc.task, arc.value - value_begin_[arc.task]));
      const std::uint32_t level_of_removal = trail_.level_of(removal);
      level = std::max(level, level_of_removal);
      if (level_of_removal > 0) grounds_.push_back(removal);
    }
  }
  bound_ = add(bound_, amount);
  if (!marks_.empty()) cuts_.push_back({amount, root, level, first_ground});
}

/// Leaves out cuts of the highest levels, as far as the slack allows, so that the search goes back
/// further.
void LandmarkBound::append_grounds(const Grounds& grounds, std::vector<Literal>& reason) const {
  std::int64_t slack = grounds.slack;
  sorted_cuts_.clear();
  for (std::uint32_t number = grounds.first_cut; number < grounds.end_cut; ++number) {
    if (cuts_[number].level > 0) sorted_cuts_.push_back(number);
  }
  std::sort(sorted_cuts_.begin(), sorted_cuts_.end(), [this](std::uint32_t a, std::uint32_t b) {
    const Cut& cut = cuts_[a];
    const Cut& other = cuts_[b];
    if (cut.level != other.level) return cut.level > other.level;
    return cut.amount != other.amount ? cut.amount < other.amount : a < b;
  });
  for (const std::uint32_t number : sorted_cuts_) {
    const Cut& cut = cuts_[number];
    if (cut.amount <= slack) {
      slack -= cut.amount;
      continue;
    }
    const std::size_t end =
        number + 1 < cuts_.size() ? cuts_[number + 1].first_ground : grounds_.size();
    reason.push_back(Trail::runs(cut.root));
    for (std::size_t ground = cut.first_ground; ground < end; ++ground) {
      reason.push_back(grounds_[ground]);
    }
  }
}

std::uint32_t LandmarkBound::save_grounds(std::int64_t slack) {
  saved_.push_back(present_grounds(slack));
  return static_cast<std::uint32_t>(saved_.size() - 1);
}

}  // namespace cbc
