#include "explore/model/model.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "runtime/base/disjoint_sets.h"

namespace cbc {

namespace {

/// The most words of Variable::misfits, of all variables.
constexpr std::size_t most_misfit_words = std::size_t{1} << 24U;

/// By number below a count: whether a list has it.
template <typename Number>
std::vector<bool> members_of(const std::vector<Number>& list, std::size_t count) {
  std::vector<bool> members(count, false);
  for (const Number number : list) members[number] = true;
  return members;
}

}  // namespace

Model::Model(const CompiledCatalog& catalog, const std::vector<GroupId>& groups,
             const Assumptions& assumptions, const std::set<std::uint32_t>& variables)
    : catalog_(catalog), assumptions_(assumptions) {
  add_groups(groups);
  rank_priorities();
  const StateSituation situation = situation_of_states(catalog, groups, assumptions, variables);
  if (!add_variables(situation) || !fits_into_cells()) {
    is_too_large_ = true;
    return;
  }
  add_rivals();
  find_interactions();
  add_own_flags(situation);
  add_faults();
  add_failures();
  lay_out();
  add_never();
  add_moves();
}

void Model::add_groups(const std::vector<GroupId>& groups) {
  for (const GroupId number : groups) {
    Group group;
    group.number = number;
    group.tasks.begin = static_cast<std::uint32_t>(tasks_.size());
    group.values.begin = static_cast<std::uint32_t>(task_of_.size());
    for (TaskId id = catalog_.group_tasks[number]; id < catalog_.group_tasks[number + 1]; ++id) {
      const auto place = static_cast<std::uint32_t>(tasks_.size());
      const CompiledTask& compiled = catalog_.tasks[id];
      Task& task = tasks_.emplace_back();
      task.id = id;
      task.group = static_cast<std::uint32_t>(groups_.size());
      task.start_on_request = compiled.start_on_request != 0;
      task.achieves_goal = compiled.keep_running == 0;
      const TaskRules rules = catalog_.rules_of(id);
      task.improve = rules.improve;
      task.resumes = rules.resume != 0;
      group.is_reconsidered |= task.resumes || task.improve == Improve::at_once;
      task.values.begin = static_cast<std::uint32_t>(task_of_.size());
      task_of_.resize(task_of_.size() + catalog_.values[id].size(), place);
      task.values.end = static_cast<std::uint32_t>(task_of_.size());
      if (compiled.reactive_start != 0) {
        task.reactive = static_cast<std::uint32_t>(reactive_.size());
        group.reactive.push_back(task.reactive);
        reactive_.push_back(place);
      }
    }
    group.tasks.end = static_cast<std::uint32_t>(tasks_.size());
    group.values.end = static_cast<std::uint32_t>(task_of_.size());
    add_behaviors(group);
    groups_.push_back(std::move(group));
  }
  for (std::uint32_t task = 0; task < tasks_.size(); ++task) tasks_in_order_.push_back(task);
  std::sort(tasks_in_order_.begin(), tasks_in_order_.end(), [&](auto a, auto b) {
    return catalog_.tasks[tasks_[a].id].catalog_index < catalog_.tasks[tasks_[b].id].catalog_index;
  });
  for (std::uint32_t place = 0; place < behaviors_.size(); ++place) {
    behaviors_in_order_.push_back(place);
  }
  const auto index_of = [&](std::uint32_t behavior) {
    return catalog_.behaviors[behaviors_[behavior].id].catalog_index;
  };
  std::sort(behaviors_in_order_.begin(), behaviors_in_order_.end(),
            [&](auto a, auto b) { return index_of(a) < index_of(b); });
}

bool Model::fits_into_cells() const {
  return tasks_.size() <= most_in_cell && priorities_.size() <= most_in_cell &&
         std::all_of(variables_.begin(), variables_.end(),
                     [](const Variable& variable) { return variable.values <= most_in_cell; }) &&
         std::all_of(tasks_.begin(), tasks_.end(),
                     [](const Task& task) { return task.values.size() <= most_in_cell; });
}

/// By level, so that the first of some behaviors is the one that is activated first.
void Model::add_behaviors(Group& group) {
  group.behaviors.begin = static_cast<std::uint32_t>(behaviors_.size());
  std::vector<BehaviorId> ids;
  for (BehaviorId id = catalog_.group_behaviors[group.number];
       id < catalog_.group_behaviors[group.number + 1]; ++id) {
    ids.push_back(id);
  }
  std::stable_sort(ids.begin(), ids.end(), [&](BehaviorId a, BehaviorId b) {
    return catalog_.behaviors[a].level < catalog_.behaviors[b].level;
  });
  behavior_of_.resize(task_of_.size(), none);
  for (const BehaviorId id : ids) {
    const auto place = static_cast<std::uint32_t>(behaviors_.size());
    Behavior& behavior = behaviors_.emplace_back();
    behavior.id = id;
    behavior.group = static_cast<std::uint32_t>(groups_.size());
    behavior.retry = catalog_.retry_of(id);
    for (const ValueId value : catalog_.performs[id]) {
      const TaskId task = catalog_.task_of(value);
      const std::uint32_t local = group.tasks.begin + (task - catalog_.group_tasks[group.number]);
      const std::uint32_t number =
          tasks_[local].values.begin + (value - catalog_.values.begin[task]);
      behavior.values.push_back(number);
      behavior_of_[number] = place;
    }
  }
  group.behaviors.end = static_cast<std::uint32_t>(behaviors_.size());
}

void Model::add_rivals() {
  std::vector<std::uint32_t> last_rival_of(tasks_.size(), none);
  std::vector<std::uint32_t> numbers(catalog_.limits.size(), none);
  for (std::uint32_t place = 0; place < tasks_.size(); ++place) {
    Task& task = tasks_[place];
    last_rival_of[place] = place;
    const auto add = [&](std::span<const TaskId> list, bool is_alone) {
      for (const TaskId other : list) {
        const std::uint32_t rival = place + other - task.id;
        if (is_alone && rival != place && task.reactive != none) task.rivals.push_back(rival);
        if (std::exchange(last_rival_of[rival], place) == place) continue;
        if (tasks_[rival].reactive != none) task.reactive_rivals.push_back(tasks_[rival].reactive);
      }
    };
    for (const std::uint32_t clique : catalog_.task_cliques[task.id]) {
      add(catalog_.cliques[clique], true);
    }
    for (const std::uint32_t limit : catalog_.limits_of(task.id)) {
      add(catalog_.limited[limit], false);
      if (task.reactive == none) continue;
      if (numbers[limit] == none) {
        numbers[limit] = static_cast<std::uint32_t>(limits_.size());
        Limit& added = limits_.emplace_back();
        added.most = catalog_.limits[limit].most;
        for (const TaskId other : catalog_.limited[limit]) {
          added.tasks.push_back(place + other - task.id);
        }
      }
      task.limits.push_back(numbers[limit]);
    }
    std::sort(task.rivals.begin(), task.rivals.end());
    task.rivals.erase(std::unique(task.rivals.begin(), task.rivals.end()), task.rivals.end());
    std::sort(task.reactive_rivals.begin(), task.reactive_rivals.end());
  }
}

void Model::find_interactions() {
  const std::size_t count = tasks_.size();
  const std::size_t words = words_for(count);
  // What each task may need, itself included, and whether a minimum performance is among it.
  std::vector<std::vector<Word>> needs(count, std::vector<Word>(words, 0));
  std::vector<std::vector<Word>> rivals = needs;  // of what it may need
  std::vector<bool> has_minimum(count, false);
  for (const Group& group : groups_) {
    const auto order =
        catalog_.topological_order.subspan(catalog_.group_tasks[group.number], group.tasks.size());
    for (const TaskId id : order) {
      const std::uint32_t task = group.tasks.begin + (id - catalog_.group_tasks[group.number]);
      set_bit(needs[task].data(), task);
      for (const std::uint32_t clique : catalog_.task_cliques[id]) {
        for (const TaskId rival : catalog_.cliques[clique]) {
          if (rival != id) set_bit(rivals[task].data(), task + rival - id);
        }
      }
      for (const std::uint32_t limit : catalog_.limits_of(id)) {
        for (const TaskId rival : catalog_.limited[limit]) {
          if (rival != id) set_bit(rivals[task].data(), task + rival - id);
        }
      }
      has_minimum[task] = catalog_.tasks[id].has_performance_rules != 0;
      for (const Arc& arc : catalog_.arcs[id]) {
        const std::uint32_t target =
            group.tasks.begin + (arc.target - catalog_.group_tasks[group.number]);
        for (std::size_t word = 0; word < words; ++word) {
          needs[task][word] |= needs[target][word];
          rivals[task][word] |= rivals[target][word];
        }
        has_minimum[task] = has_minimum[task] || has_minimum[target];
      }
    }
  }
  DisjointSets classes(count);
  std::vector<std::uint32_t> requestable = reactive_;
  for (const Assumptions::Start& start : assumptions_.start) {
    const std::uint32_t task = find_task(start.task);
    if (task != none) requestable.push_back(task);
  }
  // Two tasks interact by way of a task that both need, if either has a minimum, and of one that
  // the one needs and that is a rival of what the other needs. So all that need a task interact
  // with each other if one of them has a minimum, and with all of which it is a rival.
  std::vector<std::uint32_t> first_needing(count, none);
  std::vector<std::uint32_t> first_excluding(count, none);
  std::vector<bool> is_minimum_near(count, false);
  for (const std::uint32_t task : requestable) {
    for_each_bit(needs[task].data(), words, [&](std::uint32_t needed) {
      if (first_needing[needed] == none) first_needing[needed] = task;
      if (has_minimum[task]) is_minimum_near[needed] = true;
    });
    for_each_bit(rivals[task].data(), words, [&](std::uint32_t excluded) {
      if (first_excluding[excluded] == none) first_excluding[excluded] = task;
    });
  }
  for (const std::uint32_t task : requestable) {
    for_each_bit(needs[task].data(), words, [&](std::uint32_t needed) {
      if (is_minimum_near[needed]) classes.join(task, first_needing[needed]);
      if (first_excluding[needed] != none) classes.join(task, first_excluding[needed]);
    });
    for_each_bit(rivals[task].data(), words, [&](std::uint32_t excluded) {
      if (first_needing[excluded] != none) classes.join(task, first_needing[excluded]);
    });
  }
  const std::vector<std::uint32_t> numbers = classes.numbers();
  classes_.assign(count, none);
  for (const std::uint32_t task : requestable) classes_[task] = numbers[task];
}

/// False if the table of the behaviors that do not fit is too large.
bool Model::add_variables(const StateSituation& situation) {
  denied_.assign(words_for(behaviors_.size()), 0);
  for (std::uint32_t place = 0; place < behaviors_.size(); ++place) {
    if (!is_available_at_first(assumptions_, behaviors_[place].id)) set_bit(denied_.data(), place);
  }
  std::size_t values = 0;
  for (const std::uint32_t id : situation.variables) values += catalog_.variables[id].value_count;
  if (values * denied_.size() > most_misfit_words) return false;
  for (const std::uint32_t id : situation.variables) {
    Variable& variable = variables_.emplace_back();
    variable.id = id;
    variable.values = catalog_.variables[id].value_count;
    variable.initial = initial_value(assumptions_, id);
    variable.misfits.assign(variable.values, std::vector<Word>(denied_.size(), 0));
  }
  for (std::uint32_t behavior = 0; behavior < behaviors_.size(); ++behavior) {
    const auto fitting = catalog_.fitting_values_of(behaviors_[behavior].id);
    for (auto next = fitting.begin(); next != fitting.end();) {
      const std::uint32_t id = next->variable;
      Variable& variable = variables_[find_variable(id)];
      for (std::vector<Word>& misfits : variable.misfits) set_bit(misfits.data(), behavior);
      for (; next != fitting.end() && next->variable == id; ++next) {
        clear_bit(variable.misfits[next->value].data(), behavior);
      }
    }
  }
  return true;
}

/// Those of the groups first, in the order of behaviors.
void Model::add_own_flags(const StateSituation& situation) {
  std::set<BehaviorId> left = situation.behaviors;
  for (std::uint32_t place = 0; place < behaviors_.size(); ++place) {
    if (left.erase(behaviors_[place].id) == 0) continue;
    behaviors_[place].own = static_cast<std::uint32_t>(own_flags_.size());
    own_flags_.push_back({behaviors_[place].id, place});
  }
  for (const BehaviorId behavior : left) own_flags_.push_back({behavior, none});
}

void Model::add_faults() {
  if (assumptions_.faults == 0) return;
  const std::vector<bool> is_listed =
      members_of(assumptions_.listed_for_faults, catalog_.behaviors.size());
  for (Behavior& behavior : behaviors_) {
    if (is_listed[behavior.id] != assumptions_.only_listed_fail) continue;
    behavior.fault = layout_.faulty_count++;
    groups_[behavior.group].has_faults = true;
  }
}

void Model::add_failures() {
  for (Behavior& behavior : behaviors_) {
    const bool can_fail = assumptions_.failures || behavior.fault != none;
    if (can_fail && behavior.retry != Retry::at_events) behavior.failed = layout_.failed_count++;
  }
}

bool Model::has_repairs_that_decide() const {
  return layout_.failed_count > 0 ||
         (layout_.faulty_count > 0 &&
          std::any_of(groups_.begin(), groups_.end(),
                      [](const Group& group) { return group.is_reconsidered; }));
}

void Model::rank_priorities() {
  std::set<std::int32_t> priorities{0};
  for (const Assumptions::Start& start : assumptions_.start) {
    priorities.insert(start.priorities.begin(), start.priorities.end());
  }
  const auto priority_of = [this](const Task& task) {
    return catalog_.rules_of(task.id).reactive_priority;
  };
  for (const std::uint32_t task : reactive_) priorities.insert(priority_of(tasks_[task]));
  priorities_.assign(priorities.begin(), priorities.end());
  for (const std::uint32_t task : reactive_) {
    tasks_[task].reactive_rank = rank_of(priority_of(tasks_[task]));
  }
}

Model::Rank Model::ranks_up_to(std::int32_t priority) const {
  return static_cast<Rank>(std::upper_bound(priorities_.begin(), priorities_.end(), priority) -
                           priorities_.begin());
}

Model::Rank Model::rank_of(std::int32_t priority) const {
  return static_cast<Rank>(std::lower_bound(priorities_.begin(), priorities_.end(), priority) -
                           priorities_.begin());
}

std::uint32_t Model::find_task(TaskId task) const {
  const GroupId group = catalog_.tasks[task].group;
  const auto found =
      std::lower_bound(groups_.begin(), groups_.end(), group,
                       [](const Group& one, GroupId other) { return one.number < other; });
  if (found == groups_.end() || found->number != group) return none;
  return found->tasks.begin + (task - catalog_.group_tasks[group]);
}
std::uint32_t Model::find_behavior(BehaviorId behavior) const {
  const auto found = std::find_if(behaviors_.begin(), behaviors_.end(),
                                  [behavior](const Behavior& one) { return one.id == behavior; });
  return found == behaviors_.end() ? none : static_cast<std::uint32_t>(found - behaviors_.begin());
}
std::uint32_t Model::find_variable(std::uint32_t variable) const {
  const auto found =
      std::lower_bound(variables_.begin(), variables_.end(), variable,
                       [](const Variable& one, std::uint32_t other) { return one.id < other; });
  if (found == variables_.end() || found->id != variable) return none;
  return static_cast<std::uint32_t>(found - variables_.begin());
}

/// A bound on the requests at one time: of the tasks that an exclusivity list names, one runs. What
/// resumes may have one beside it.
std::uint32_t Model::most_requests() const {
  std::set<TaskId> left;
  for (const Assumptions::Start& start : assumptions_.start) {
    if (find_task(start.task) != none) left.insert(start.task);
  }
  for (const std::uint32_t task : reactive_) left.insert(tasks_[task].id);
  std::uint32_t count = 0;
  for (; !left.empty(); ++count) {
    const TaskId task = *left.begin();
    std::uint32_t best = none;
    std::size_t most = 0;
    const auto is_left = [&](TaskId member) { return left.contains(member); };
    for (const std::uint32_t clique : catalog_.task_cliques[task]) {
      const auto members = catalog_.cliques[clique];
      const auto size =
          static_cast<std::size_t>(std::count_if(members.begin(), members.end(), is_left));
      if (size > most) {
        most = size;
        best = clique;
      }
    }
    left.erase(task);
    if (best == none || catalog_.rules_of(task).resume != 0) continue;
    for (const TaskId member : catalog_.cliques[best]) {
      if (catalog_.rules_of(member).resume == 0) left.erase(member);
    }
  }
  return count;
}

void Model::lay_out() {
  std::size_t bits = 0;
  const auto add = [&](std::size_t most) {
    const auto width = static_cast<std::uint8_t>(std::bit_width(most));
    if (width == 0) {
      fields_.push_back({});
      return;
    }
    if (bits % 32 + width > 32) bits += 32 - bits % 32;
    // A field counts words in as many bits as a cell has.
    is_too_large_ = is_too_large_ || bits / 32 > most_in_cell;
    fields_.push_back(
        {static_cast<std::uint16_t>(bits / 32), static_cast<std::uint8_t>(bits % 32), width});
    bits += width;
  };
  const auto here = [&] { return static_cast<std::uint32_t>(fields_.size()); };
  for (const Task& task : tasks_) add(task.values.size());
  layout_.requests = here();
  layout_.request_count = most_requests();
  for (std::uint32_t request = 0; request < layout_.request_count; ++request) add(tasks_.size());
  layout_.ranks = here();
  for (std::uint32_t request = 0; request < layout_.request_count; ++request) {
    add(priorities_.size() - 1);
  }
  layout_.reactive_count = static_cast<std::uint32_t>(reactive_.size());
  layout_.queue = here();
  for (std::uint32_t task = 0; task < layout_.reactive_count; ++task) add(layout_.reactive_count);
  layout_.waiting = here();
  for (std::uint32_t task = 0; task < layout_.reactive_count; ++task) add(1);
  layout_.variables = here();
  const std::vector<bool> may_change =
      members_of(assumptions_.variables, catalog_.variables.size());
  for (Variable& variable : variables_) {
    if (!may_change[variable.id]) continue;
    variable.cell = here();
    add(variable.values - 1);
  }
  layout_.own = here();
  layout_.own_count = static_cast<std::uint32_t>(own_flags_.size());
  for (std::uint32_t flag = 0; flag < layout_.own_count; ++flag) add(1);
  layout_.faulty = here();
  for (std::uint32_t fault = 0; fault < layout_.faulty_count; ++fault) add(1);
  layout_.cells = here();
  packed_words_ = std::max<std::size_t>(1, (bits + 31) / 32);
}

/// Entries of `never` as conditions on cells. What cannot change is compared once. Of an entry all
/// that may change is part of the state, or nothing; then it is about other states.
void Model::add_never() {
  if (assumptions_.never.empty()) return;
  const std::vector<bool> may_change =
      members_of(assumptions_.variables, catalog_.variables.size());
  const std::vector<bool> may_own_change =
      members_of(assumptions_.behaviors, catalog_.behaviors.size());
  const auto find_flag = [&](BehaviorId behavior) {
    const auto found = std::find_if(own_flags_.begin(), own_flags_.end(),
                                    [&](const OwnFlag& flag) { return flag.id == behavior; });
    return found == own_flags_.end() ? none
                                     : static_cast<std::uint32_t>(found - own_flags_.begin());
  };
  for (const SituationPart& part : assumptions_.never) {
    Excluded excluded;
    bool occurs = true;
    for (const VariableValue& value : part.variables) {
      if (!may_change[value.variable]) {
        occurs = occurs && initial_value(assumptions_, value.variable) == value.value;
        continue;
      }
      const std::uint32_t place = find_variable(value.variable);
      occurs = occurs && place != none;
      if (occurs) excluded.emplace_back(variables_[place].cell, value.value);
    }
    for (const SituationPart::Own& own : part.behaviors) {
      if (!may_own_change[own.behavior]) {
        occurs = occurs && is_available_at_first(assumptions_, own.behavior) == own.available;
        continue;
      }
      const std::uint32_t flag = find_flag(own.behavior);
      occurs = occurs && flag != none;
      if (occurs) excluded.emplace_back(layout_.own + flag, own.available ? 0 : 1);
    }
    if (occurs) excluded_.push_back(std::move(excluded));
  }
}

void Model::add_moves() {
  const auto index_of_task = [&](std::uint32_t task) {
    return catalog_.tasks[tasks_[task].id].catalog_index;
  };
  const auto index_of_behavior = [&](std::uint32_t behavior) {
    return catalog_.behaviors[behaviors_[behavior].id].catalog_index;
  };
  std::vector<const Assumptions::Start*> starts(tasks_.size(), nullptr);
  for (const Assumptions::Start& start : assumptions_.start) {
    const std::uint32_t task = find_task(start.task);
    if (task != none) starts[task] = &start;
  }
  for (const std::uint32_t task : tasks_in_order_) {
    if (starts[task] == nullptr) continue;
    for (const std::int32_t priority : starts[task]->priorities) {
      moves_.push_back(
          {{Move::Kind::start, index_of_task(task), priority}, task, rank_of(priority)});
    }
  }
  const std::vector<bool> may_stop = members_of(assumptions_.stop, catalog_.tasks.size());
  for (const std::uint32_t task : tasks_in_order_) {
    if (!may_stop[tasks_[task].id]) continue;
    moves_.push_back({{Move::Kind::stop, index_of_task(task), 0}, task, 0});
  }
  const auto add_for_behaviors = [&](Move::Kind kind) {
    for (const std::uint32_t behavior : behaviors_in_order_) {
      moves_.push_back({{kind, index_of_behavior(behavior), 0}, behavior, 0});
    }
  };
  if (assumptions_.successes) add_for_behaviors(Move::Kind::success);
  if (assumptions_.failures) add_for_behaviors(Move::Kind::failure);
  for (const std::uint32_t behavior : behaviors_in_order_) {
    const bool is_denied = has_bit(denied_.data(), behavior);
    if (!is_denied && behaviors_[behavior].own == none) continue;
    moves_.push_back({{Move::Kind::situation_change, index_of_behavior(behavior), 0}, behavior, 0});
  }
  for (const Move::Kind kind : {Move::Kind::fault, Move::Kind::repair}) {
    for (const std::uint32_t behavior : behaviors_in_order_) {
      const bool has_failed = kind == Move::Kind::repair && behaviors_[behavior].failed != none;
      if (behaviors_[behavior].fault == none && !has_failed) continue;
      moves_.push_back({{kind, index_of_behavior(behavior), 0}, behavior, 0});
    }
  }
  add_situation_moves();
  if (!reactive_.empty()) moves_.push_back({{Move::Kind::due, 0, 0}, 0, 0});
}

void Model::add_situation_moves() {
  for (std::uint32_t variable = 0; variable < variables_.size(); ++variable) {
    if (variables_[variable].cell == none) continue;
    for (std::uint32_t value = 0; value < variables_[variable].values; ++value) {
      moves_.push_back(
          {{Move::Kind::variable, variables_[variable].id, static_cast<std::int32_t>(value)},
           variable,
           value});
    }
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> flags;
  for (std::uint32_t flag = 0; flag < own_flags_.size(); ++flag) {
    flags.emplace_back(catalog_.behaviors[own_flags_[flag].id].catalog_index, flag);
  }
  std::sort(flags.begin(), flags.end());
  for (const auto& [index, flag] : flags) {
    // Which of the two it becomes is filled in where the move is taken.
    moves_.push_back({{Move::Kind::own, index, 0}, flag, 0});
  }
  for (std::uint32_t list = 0; list < assumptions_.together.size(); ++list) {
    add_joint_changes(list);
  }
}

/// Those of its variables that are not part of the state do not matter, and keep their first value.
void Model::add_joint_changes(std::uint32_t list) {
  const std::vector<std::uint32_t>& variables = assumptions_.together[list];
  const std::uint32_t count = count_combinations(catalog_, variables);
  is_too_large_ = is_too_large_ || count > most_values_together;
  for (std::uint32_t number = 0; number < count && !is_too_large_; ++number) {
    JointChange change;
    bool is_possible = true;
    for (const VariableValue& value : combination_of(catalog_, variables, number)) {
      const std::uint32_t place = find_variable(value.variable);
      if (place != none && variables_[place].cell != none) {
        change.values.emplace_back(place, value.value);
      } else {
        is_possible = is_possible && value.value == initial_value(assumptions_, value.variable);
      }
    }
    if (!is_possible || change.values.size() < 2) continue;
    moves_.push_back({{Move::Kind::together, list, static_cast<std::int32_t>(number)},
                      static_cast<std::uint32_t>(joint_changes_.size()),
                      0});
    joint_changes_.push_back(std::move(change));
  }
}

std::vector<std::uint16_t> Model::first_state() const {
  std::vector<std::uint16_t> cells(layout_.cells, 0);
  for (std::uint32_t task = 0; task < layout_.reactive_count; ++task) {
    cells[layout_.queue + task] = 1;
  }
  for (const Variable& variable : variables_) {
    if (variable.cell != none) cells[variable.cell] = static_cast<std::uint16_t>(variable.initial);
  }
  for (std::uint32_t flag = 0; flag < layout_.own_count; ++flag) {
    const bool is_available = is_available_at_first(assumptions_, own_flags_[flag].id);
    cells[layout_.own + flag] = is_available ? 0 : 1;
  }
  return cells;
}

std::optional<std::string> Model::find_obstacle() const {
  if (is_too_large_) {
    return fmt::format(
        "too large to explore: the tasks of a group, the behaviors of a task, the values of a "
        "variable and the priorities may be {} each, the behaviors of a group times the values of "
        "its variables {}, the values of variables that change together {}, and a state may take "
        "{} "
        "bytes",
        most_in_cell, most_misfit_words * 64, most_values_together, 4 * most_in_cell);
  }
  if (is_excluded(first_state().data())) {
    return "the first state is in a situation that 'never' excludes";
  }
  return std::nullopt;
}

bool Model::is_excluded(const std::uint16_t* cells) const {
  return std::any_of(excluded_.begin(), excluded_.end(), [&](const Excluded& excluded) {
    return std::all_of(excluded.begin(), excluded.end(),
                       [&](const auto& part) { return cells[part.first] == part.second; });
  });
}

}  // namespace cbc
