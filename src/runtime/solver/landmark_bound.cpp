#include "solver/landmark_bound.h"

#include <algorithm>
#include <bit>

#include "solver/cost_bound.h"

namespace cbc {
namespace {

/// In place of a supporter.
constexpr std::uint32_t removed = none - 1;

std::int64_t add(std::int64_t a, std::int64_t b) { return std::min(prohibitive_cost, a + b); }

}  // namespace

LandmarkBound::LandmarkBound(const CompiledCatalog& catalog, const Domains& domains,
                             const ReasonTrail& trail)
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
  for (std::uint32_t task = 0; task < tasks; ++task) {
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
  // Each row is filled from its end, which leaves its begin.
  requiring_begin_.assign(tasks + 1, 0);
  for (const std::uint32_t target : requirements_) ++requiring_begin_[target];
  for (std::uint32_t task = 0; task < tasks; ++task) {
    requiring_begin_[task + 1] += requiring_begin_[task];
  }
  requiring_.resize(requirements_.size());
  for (auto value = static_cast<std::uint32_t>(requirement_begin_.size() - 1); value-- > 0;) {
    for (std::uint32_t at = requirement_begin_[value]; at < requirement_begin_[value + 1]; ++at) {
      requiring_[--requiring_begin_[requirements_[at]]] = value;
    }
  }
  tasks_.clear();
  for (std::uint32_t task = 0; task < tasks; ++task) {
    tasks_.insert(tasks_.end(), value_begin_[task + 1] - value_begin_[task], task);
  }
  supporters_.assign(tasks_.size(), none);
  is_reached_.assign(tasks, 0);
  heights_.assign(tasks, 0);
  seen_heights_.assign(tasks, 0);
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
  for (std::uint32_t task = 0; task < domains_.task_count(); ++task) {
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
  const auto add_task = [this](std::uint32_t task) {
    if (in_cut_[task] == cut_number_) return;
    in_cut_[task] = cut_number_;
    relevant_.push_back(task);
  };
  for (const std::uint32_t task : domains_.needed_tasks()) add_task(task);
  for (const std::uint32_t task : trail_.requests()) add_task(task);
  for (std::size_t next = 0; next < relevant_.size(); ++next) {
    for (const cbc::Arc& arc : catalog_.arcs[first + relevant_[next]]) add_task(arc.target - first);
  }
  order_.clear();
  for (std::uint32_t place = 0; place < domains_.task_count(); ++place) {
    const std::uint32_t task = catalog_.topological_order[first + place] - first;
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
  find_reached_tasks();
  for (const std::uint32_t task : order_) {
    if (is_reached_[task] == 0) {
      std::fill(supporters_.begin() + value_begin_[task],
                supporters_.begin() + value_begin_[task + 1], removed);
      continue;
    }
    const std::uint32_t begin = value_begin_[task];
    const std::uint32_t end = value_begin_[task + 1];
    std::int64_t height = prohibitive_cost;
    for (std::uint32_t value = begin; value < end; ++value) {
      if (!domains_.has(task, value - begin)) {
        supporters_[value] = removed;
        continue;
      }
      supporters_[value] = highest_requirement(value);
      height = std::min(height, height_of_value(value));
    }
    heights_[task] = height;
    const bool is_needed = domains_.needed(task);
    seen_heights_[task] = is_needed ? 0 : height;
    if (is_needed && height > 0) unsettled_.push_back(task);
  }
}

/// The tasks that the needed ones may still require.
void LandmarkBound::find_reached_tasks() {
  std::fill(is_reached_.begin(), is_reached_.end(), std::uint8_t{0});
  for (const std::uint32_t task : domains_.needed_tasks()) is_reached_[task] = 1;
  for (auto at = order_.rbegin(); at != order_.rend(); ++at) {
    const std::uint32_t task = *at;
    if (is_reached_[task] == 0) continue;
    for (std::uint32_t value = value_begin_[task]; value < value_begin_[task + 1]; ++value) {
      if (!domains_.has(task, value - value_begin_[task])) continue;
      for (std::uint32_t r = requirement_begin_[value]; r < requirement_begin_[value + 1]; ++r) {
        is_reached_[requirements_[r]] = 1;
      }
    }
  }
}

std::int64_t LandmarkBound::raise(std::int64_t threshold) {
  if (version_ != trail_.version()) start_ascent();
  version_ = trail_.version();
  while (bound_ <= threshold) {
    const std::uint32_t root = highest_root();
    if (root == none) break;
    find_cut(root);
    subtract_cut(root);
    update_heights();
  }
  return bound_;
}

std::int64_t LandmarkBound::bound_again() {
  set_measure(Measure::log);
  version_ = 0;
  return raise(INT64_MAX);
}

void LandmarkBound::mark(std::uint32_t task) {
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
      const std::uint32_t task = order_[64 * word + bit];
      if (domains_.needed(task)) continue;
      seen_heights_[task] = heights_[task];
      for (std::uint32_t at = requiring_begin_[task]; at < requiring_begin_[task + 1]; ++at) {
        const std::uint32_t value = requiring_[at];
        if (supporters_[value] != task) continue;
        supporters_[value] = highest_requirement(value);
        lower(value);
      }
    }
  }
  first_marked_ = SIZE_MAX;
}

/// Lowers the height of the value's task to that of the value.
void LandmarkBound::lower(std::uint32_t value) {
  const std::int64_t height = height_of_value(value);
  const std::uint32_t task = tasks_[value];
  if (height >= heights_[task]) return;
  heights_[task] = height;
  mark(task);
}

/// The highest of the required tasks; none if all can run at no residual cost.
std::uint32_t LandmarkBound::highest_requirement(std::uint32_t value) const {
  std::uint32_t highest = none;
  std::int64_t height = 0;
  for (std::uint32_t at = requirement_begin_[value]; at < requirement_begin_[value + 1]; ++at) {
    const std::uint32_t target = requirements_[at];
    if (seen_heights_[target] <= height) continue;
    highest = target;
    height = seen_heights_[target];
  }
  return highest;
}

std::int64_t LandmarkBound::estimate(std::uint32_t task, std::uint32_t index) const {
  const std::uint32_t value = value_begin_[task] + index;
  std::int64_t cost = residuals_[value];
  for (std::uint32_t at = requirement_begin_[value]; at < requirement_begin_[value + 1]; ++at) {
    cost = add(cost, seen_heights_[requirements_[at]]);
  }
  return cost;
}

/// The highest needed task; none if all can run at no residual cost.
std::uint32_t LandmarkBound::highest_root() {
  std::uint32_t highest = none;
  std::int64_t height = 0;
  for (const std::uint32_t task : unsettled_) {
    if (heights_[task] <= height) continue;
    highest = task;
    height = heights_[task];
  }
  return highest;
}

/// Collects the tasks that keep the root from running at no residual cost.
void LandmarkBound::find_cut(std::uint32_t root) {
  ++cut_number_;
  cut_.assign(1, root);
  in_cut_[root] = cut_number_;
  for (std::size_t next = 0; next < cut_.size(); ++next) {
    const std::uint32_t task = cut_[next];
    const std::uint32_t begin = value_begin_[task];
    const std::uint32_t end = value_begin_[task + 1];
    for (std::uint32_t value = begin; value < end; ++value) {
      if (residuals_[value] > 0 || !domains_.has(task, value - begin) || requires_cut(value)) {
        continue;
      }
      // There is one: the task has a height.
      const std::uint32_t highest = highest_requirement(value);
      in_cut_[highest] = cut_number_;
      cut_.push_back(highest);
    }
  }
}

bool LandmarkBound::requires_cut(std::uint32_t value) const {
  for (std::uint32_t at = requirement_begin_[value]; at < requirement_begin_[value + 1]; ++at) {
    if (in_cut_[requirements_[at]] == cut_number_) return true;
  }
  return false;
}

/// Subtracts the cut's minimum from its arcs, and adds it to the bound. A removed value that costs
/// no less than the minimum might as well be there; otherwise the minimum rests on its removal.
void LandmarkBound::subtract_cut(std::uint32_t root) {
  arcs_.clear();
  std::int64_t amount = prohibitive_cost;
  for (const std::uint32_t task : cut_) {
    const std::uint32_t begin = value_begin_[task];
    const std::uint32_t end = value_begin_[task + 1];
    for (std::uint32_t value = begin; value < end; ++value) {
      if (requires_cut(value)) continue;
      const bool has = domains_.has(task, value - begin);
      arcs_.push_back({value, task, !has});
      if (has) amount = std::min(amount, residuals_[value]);
    }
  }
  const std::size_t first_ground = grounds_.size();
  std::uint32_t level = trail_.level_of(ReasonTrail::runs(root));
  for (const Arc& arc : arcs_) {
    if (residuals_[arc.value] >= amount) {
      residuals_[arc.value] -= amount;
      if (!arc.is_removed) lower(arc.value);
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
    reason.push_back(ReasonTrail::runs(cut.root));
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
