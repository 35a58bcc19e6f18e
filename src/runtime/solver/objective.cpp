#include "runtime/solver/objective.h"

#include <algorithm>

#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/derive.h"

namespace cbc {

void ExactProduct::reserve(std::size_t factors) {
  constexpr std::size_t bits_of_factor = 20;
  numerator_.reserve(factors * bits_of_factor);
}

void ExactProduct::clear() {
  numerator_.set_to_one();
  factors_ = 0;
}

void ExactProduct::multiply(Millionths degree) {
  numerator_.multiply(degree);
  ++factors_;
}

std::strong_ordering ExactProduct::compare(ExactProduct& a, ExactProduct& b) {
  while (a.factors_ < b.factors_) a.multiply(one_million);
  while (b.factors_ < a.factors_) b.multiply(one_million);
  return a.numerator_ <=> b.numerator_;
}

namespace {

/// One activation; the least common multiple of 1 to 8, so that few shares are rounded.
constexpr std::uint32_t whole_share = 840;

}  // namespace

CanonicalOrder::CanonicalOrder(const CompiledCatalog& catalog) : catalog_(catalog) {
  const std::size_t tasks = most_in_a_group(catalog.group_tasks);
  empty_first_.reserve(tasks);
  kept_first_.reserve(tasks);
}

void CanonicalOrder::load(const Problem& problem) {
  const Problem& whole = problem.subproblem_of != nullptr ? *problem.subproblem_of : problem;
  const TaskId first_task = catalog_.group_tasks[whole.group];
  const auto tasks = static_cast<std::uint32_t>(whole.present.size());
  empty_first_.resize(tasks);
  kept_first_.resize(tasks);
  for (LocalTask task(0); task < tasks; ++task) {
    const TaskId id = first_task + task;
    const std::uint64_t* const words =
        whole.domains.data() + (catalog_.words[id] - catalog_.words[first_task]);
    const std::uint32_t present = whole.present[task];
    empty_first_[task] = present == none && whole.may_stop[task] != 0;
    const auto values = catalog_.values[id];
    const auto count = static_cast<std::uint32_t>(values.size());
    const bool is_best = present != none && has_bit(words, present) &&
                         values[present].suitability == values[*Bits(words, count)].suitability;
    kept_first_[task] = is_best ? present : none;
  }
}

AskedProduct::AskedProduct(const CompiledCatalog& catalog) : catalog_(catalog) {
  const std::size_t tasks = most_in_a_group(catalog.group_tasks);
  closure_.reserve(tasks);
  in_closure_.resize(tasks, 0);
  factors_.degrees.reserve(tasks);
  present_.degrees.reserve(tasks);
  ours_.reserve(tasks);
  theirs_.reserve(tasks);
}

const AskedProduct::Factors& AskedProduct::bound(const Domains& domains,
                                                 std::span<const LocalTask> requests) {
  clear();
  const auto add_best = [&](LocalTask task) {
    if (domains.count(task) > 0) add(task, domains.value(task, domains.best(task)));
  };
  for (const LocalTask task : requests) {
    if (domains.needed(task)) add_best(task);
  }
  // NOLINTNEXTLINE(modernize-loop-convert): the list grows
  for (std::size_t next = 0; next < closure_.size(); ++next) {
    const LocalTask task = closure_[next];
    for (const Arc& arc : catalog_.arcs[domains.first_task() + task]) {
      if (domains.all_within(task, &catalog_.masks[arc.mask])) {
        add_best(arc.target - domains.first_task());
      }
    }
  }
  return factors_;
}

const AskedProduct::Factors& AskedProduct::of(TaskId first_task, const Assignment& assignment,
                                              std::span<const LocalTask> requests) {
  clear();
  const auto add_value = [&](LocalTask task) {
    const std::uint32_t index = assignment[task];
    if (index != none) add(task, catalog_.values[first_task + task][index]);
  };
  for (const LocalTask task : requests) add_value(task);
  // NOLINTNEXTLINE(modernize-loop-convert): the list grows
  for (std::size_t next = 0; next < closure_.size(); ++next) {
    const LocalTask task = closure_[next];
    const Value& value = catalog_.values[first_task + task][assignment[task]];
    for (const CompiledRequirement& rule : catalog_.requirements[value.behavior]) {
      add_value(rule.task - first_task);
    }
  }
  return factors_;
}

void AskedProduct::clear() {
  ++number_;
  closure_.clear();
  factors_.degrees.clear();
  factors_.cost = 0;
  factors_.is_zero = false;
}

void AskedProduct::add(LocalTask task, const Value& value) {
  if (in_closure_[task] == number_) return;
  in_closure_[task] = number_;
  closure_.push_back(task);
  factors_.cost += value.cost;
  factors_.is_zero |= value.suitability == 0;
  if (value.suitability != one_million) factors_.degrees.push_back(value.suitability);
}

std::strong_ordering AskedProduct::compare(const Factors& ours, const Factors& theirs) {
  if (ours.is_zero || theirs.is_zero) return ours.is_zero <=> theirs.is_zero;
  const auto slack =
      log_cost_error * static_cast<std::int64_t>(ours.degrees.size() + theirs.degrees.size());
  if (ours.cost > theirs.cost + slack) return std::strong_ordering::greater;
  if (ours.cost < theirs.cost - slack) return std::strong_ordering::less;
  ours_.clear();
  for (const Millionths degree : ours.degrees) ours_.multiply(degree);
  theirs_.clear();
  for (const Millionths degree : theirs.degrees) theirs_.multiply(degree);
  return ExactProduct::compare(theirs_, ours_);
}

bool AskedProduct::is_worse(TaskId first_task, const Problem& problem, const Assignment& answer) {
  const auto asked = problem.asked_requests();
  present_ = of(first_task, problem.present, asked);
  return compare(of(first_task, answer, asked), present_) > 0;
}

Objective::Objective(const CompiledCatalog& catalog, const Domains& domains,
                     const Components& components)
    : catalog_(catalog),
      domains_(domains),
      components_(components),
      order_(catalog),
      asked_(catalog) {
  const std::size_t tasks = most_in_a_group(catalog.group_tasks);
  const std::size_t behaviors = most_in_a_group(catalog.group_behaviors);
  is_request_.reserve(tasks);
  active_.reserve(behaviors);
  free_.reserve(tasks + most_values_in_a_group(catalog) / 64);
  counted_.resize(behaviors, 0);
  ours_.reserve(tasks);
  theirs_.reserve(tasks);
}

void Objective::load(const Problem& problem, bool has_all_answers) {
  problem_ = &problem;
  compares_asked_ = has_all_answers || problem.unasked > 0;
  order_.load(problem);
  const std::uint32_t tasks = domains_.task_count();
  const BehaviorId first_behavior = domains_.first_behavior();
  const std::uint32_t behaviors = catalog_.group_behaviors[problem.group + 1] - first_behavior;

  is_request_.assign(tasks, 0);
  for (const LocalTask task : problem.requests) is_request_[task] = 1;
  active_.assign(behaviors, 0);
  for (const BehaviorId behavior : problem.active) active_[behavior - first_behavior] = 1;

  free_.assign(problem.domains.size(), 0);
  for (LocalTask task(0); task < tasks; ++task) {
    const auto values = domains_.values(task);
    for (std::uint32_t index = 0; index < values.size(); ++index) {
      const BehaviorId behavior = values[index].behavior;
      if (was_active(behavior) || catalog_.performs[behavior].size() > 1) {
        free_[domains_.word_begin(task) + index / 64] |= std::uint64_t{1} << (index % 64);
      }
    }
  }
}

bool Objective::is_free(LocalTask task, std::uint32_t index) const {
  return has_bit(&free_[domains_.word_begin(task)], index);
}

Objective::Comparison Objective::compare(const Incumbent& incumbent, std::uint32_t depth) {
  if (const auto order = compare_requests(incumbent); order != 0) {
    return {order, Decider::requests};
  }
  if (const Comparison comparison = compare_unasked(incumbent); comparison.order != 0) {
    return comparison;
  }
  if (const auto order = compare_suitability(incumbent); order != 0) {
    return {order, Decider::suitability};
  }
  if (const auto order = domains_.sums().idle <=> incumbent.sums.idle; order != 0) {
    return {order, Decider::idle};
  }
  if (const auto order = least_changes() <=> incumbent.changes; order != 0) {
    return {order, Decider::changes};
  }
  return {compare_keys(incumbent, depth), Decider::order};
}

std::strong_ordering Objective::compare_requests(const Incumbent& incumbent) const {
  std::uint32_t possible = 0;
  auto order = std::strong_ordering::equal;
  const auto compare = [&](LocalTask task) {
    const bool ours = domains_.count(task) > 0;
    const bool theirs = incumbent.assignment[task] != none;
    if (order == 0 && ours != theirs) {
      order = ours ? std::strong_ordering::less : std::strong_ordering::greater;
    }
    return ours;
  };
  const auto counted = problem_->counted_requests();
  for (const LocalTask task : counted) {
    if (compare(task)) ++possible;
  }
  if (possible != incumbent.satisfied) return incumbent.satisfied <=> possible;
  for (const LocalTask task : problem_->asked_requests().subspan(counted.size())) compare(task);
  return order;
}

/// The product of what was asked for, then the requests of priority 0, the most recent one first.
/// Where there are none, f2 says the same, as then nothing runs in the best answers that nobody
/// asked for.
Objective::Comparison Objective::compare_unasked(const Incumbent& incumbent) {
  if (!compares_asked_) return {};
  const AskedProduct::Factors& ours = asked_.bound(domains_, problem_->asked_requests());
  if (const auto order = asked_.compare(ours, incumbent.asked); order != 0) {
    return {order, Decider::asked};
  }
  for (const LocalTask task : problem_->unasked_requests()) {
    const bool may_run = domains_.count(task) > 0;
    if (may_run == (incumbent.assignment[task] != none)) continue;
    return {may_run ? std::strong_ordering::less : std::strong_ordering::greater, Decider::unasked};
  }
  return {};
}

/// f2. "less" is better.
std::strong_ordering Objective::compare_suitability(const Incumbent& incumbent) {
  const Domains::Sums& ours = domains_.sums();
  const Domains::Sums& theirs = incumbent.sums;
  const bool is_zero = ours.zeros > 0;
  const bool incumbent_is_zero = theirs.zeros > 0;
  if (is_zero || incumbent_is_zero) return is_zero <=> incumbent_is_zero;
  const std::int64_t slack =
      log_cost_error * (std::int64_t{ours.factors} + std::int64_t{theirs.factors});
  if (ours.cost > theirs.cost + slack) return std::strong_ordering::greater;
  if (ours.cost < theirs.cost - slack) return std::strong_ordering::less;
  if (slack == 0) return std::strong_ordering::equal;
  return compare_exactly(incumbent);
}

std::strong_ordering Objective::compare_exactly(const Incumbent& incumbent) {
  ours_.clear();
  theirs_.clear();
  for (const LocalTask task : domains_.needed_tasks()) {
    const std::uint32_t index = incumbent.assignment[task];
    const Millionths ours = domains_.value(task, domains_.best(task)).suitability;
    const Millionths theirs = index == none ? one_million : domains_.value(task, index).suitability;
    if (ours == theirs) continue;
    ours_.multiply(ours);
    theirs_.multiply(theirs);
  }
  for (const LocalTask task : incumbent.running) {
    if (!domains_.needed(task)) {
      theirs_.multiply(domains_.value(task, incumbent.assignment[task]).suitability);
    }
  }
  return ExactProduct::compare(theirs_, ours_);
}

/// f4: the fewest changes of any solution that ties with the incumbent on f1 to f3. In such a
/// solution only needed tasks and requests run.
std::uint32_t Objective::least_changes() { return least_activations() + least_deactivations(); }

std::uint32_t Objective::least_activations() {
  ++count_number_;
  std::uint32_t activations = 0;
  bool has_open_tasks = false;
  for (const LocalTask task : domains_.needed_tasks()) {
    if (!has_free_value(task)) {
      ++activations;
    } else if (domains_.count(task) > 1) {
      has_open_tasks = true;
    } else {
      const BehaviorId behavior = domains_.value(task, domains_.best(task)).behavior;
      if (was_active(behavior) || is_counted(behavior)) continue;
      counted_[behavior - domains_.first_behavior()] = count_number_;
      ++activations;
    }
  }
  return has_open_tasks ? activations + least_activations_of_open_tasks() : activations;
}

/// Activations beyond the counted ones. Each task takes at least its least share of one.
std::uint32_t Objective::least_activations_of_open_tasks() const {
  std::uint32_t shares = 0;
  for (const LocalTask task : domains_.needed_tasks()) {
    if (domains_.count(task) > 1 && has_free_value(task)) shares += least_share(task);
  }
  return (shares + whole_share - 1) / whole_share;
}

/// The least share of an activation that a value of the task has. Tasks that may have one behavior
/// share its activation; none is needed for a behavior that was active, or is counted.
std::uint32_t Objective::least_share(LocalTask task) const {
  std::uint32_t most_tasks = 1;
  for (const std::uint32_t index : domains_.indices(task)) {
    if (!is_free(task, index)) continue;
    const BehaviorId behavior = domains_.value(task, index).behavior;
    if (was_active(behavior) || is_counted(behavior)) return 0;
    const auto of_tasks = catalog_.performs[behavior];
    const auto tasks = std::count_if(of_tasks.begin(), of_tasks.end(),
                                     [this](ValueId value) { return may_have(value); });
    most_tasks = std::max(most_tasks, static_cast<std::uint32_t>(tasks));
  }
  return whole_share / most_tasks;
}

std::uint32_t Objective::least_deactivations() const {
  return static_cast<std::uint32_t>(
      std::count_if(problem_->active.begin(), problem_->active.end(),
                    [this](BehaviorId behavior) { return !may_stay(behavior); }));
}

/// Whether a behavior that was active may stay so in a solution that ties on f1 to f3.
bool Objective::may_stay(BehaviorId behavior) const {
  const auto values = catalog_.performs[behavior];
  return std::any_of(values.begin(), values.end(),
                     [this](ValueId value) { return may_have(value); });
}

bool Objective::may_have(ValueId value) const {
  const TaskId task = catalog_.task_of(value);
  const LocalTask local = task - domains_.first_task();
  return may_run(local) && domains_.has(local, value - catalog_.values.begin[task]);
}

/// The canonical order: compares the lowest ranks that are left, task by task. "less" is better.
std::strong_ordering Objective::compare_keys(const Incumbent& incumbent,
                                             std::uint32_t depth) const {
  for (LocalTask task(0); task < domains_.task_count(); ++task) {
    if (!components_.contains(task, depth)) continue;
    std::uint32_t least = domains_.needed(task) ? none : key(task, none);
    if (may_run(task)) {
      for (const std::uint32_t index : domains_.indices(task)) {
        least = std::min(least, key(task, index));
      }
    }
    const std::uint32_t theirs = key(task, incumbent.assignment[task]);
    if (least != theirs) return least <=> theirs;
  }
  return std::strong_ordering::equal;
}

void Objective::record(Incumbent& incumbent) {
  incumbent.exists = true;
  incumbent.assignment.assign(domains_.task_count(), none);
  incumbent.running.assign(domains_.needed_tasks().begin(), domains_.needed_tasks().end());
  for (const LocalTask task : incumbent.running) {
    incumbent.assignment[task] = domains_.best(task);
  }
  incumbent.satisfied = 0;
  for (const LocalTask task : problem_->counted_requests()) {
    if (domains_.count(task) > 0) ++incumbent.satisfied;
  }
  if (compares_asked_) incumbent.asked = asked_.bound(domains_, problem_->asked_requests());
  incumbent.sums = domains_.sums();
  incumbent.changes = least_changes();
}

}  // namespace cbc
