#include "question_generator.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <utility>

#include "demand.h"
#include "plain_model.h"

namespace cbc::plain {

using oracle::contains;
using oracle::Random;

namespace {

class QuestionGenerator {
 public:
  QuestionGenerator(Random& random, const CompiledCatalog& catalog)
      : random_(random), catalog_(catalog) {}

  Question generate() {
    choose_groups();
    question_.assumptions = default_assumptions(catalog_);
    if (random_.percent(85)) choose_assumptions();
    find_far_state();
    if (random_.percent(12)) {
      add_scoped();
      return std::move(question_);
    }
    const std::size_t wanted = 3 + random_.below(5);
    while (question_.properties.size() < wanted) {
      random_.percent(20) ? add_lasting() : add_property();
    }
    return std::move(question_);
  }

 private:
  using Kind = StateCondition::Kind;

  /// Most often the largest group, which is the first of those.
  void choose_groups() {
    std::vector<GroupId> groups(catalog_.group_count());
    for (GroupId group(0); group < groups.size(); ++group) groups[group] = group;
    const auto size = [&](GroupId group) {
      return catalog_.group_tasks[group + 1] - catalog_.group_tasks[group];
    };
    random_.shuffle(groups);
    if (random_.percent(80)) {
      std::stable_sort(groups.begin(), groups.end(),
                       [&](GroupId a, GroupId b) { return size(a) > size(b); });
    }
    groups.resize(std::min<std::size_t>(groups.size(), random_.percent(50) ? 1 : 2));
    std::sort(groups.begin(), groups.end());
    question_.groups = groups;
    const auto has = [&](GroupId group) { return contains(groups, group); };
    for (const TaskId task : catalog_.task_ids) {
      if (has(catalog_.tasks[task].group)) tasks_.push_back(task);
    }
    for (const BehaviorId behavior : catalog_.behavior_ids) {
      if (!has(catalog_.group_of(behavior))) continue;
      behaviors_.push_back(behavior);
      for (const FittingValue& fitting : catalog_.fitting_values_of(behavior)) {
        if (!contains(variables_, fitting.variable)) variables_.push_back(fitting.variable);
      }
    }
  }

  template <typename Item>
  void keep_some(std::vector<Item>& items, std::size_t percent) {
    erase_if(items, [&](const Item&) { return !random_.percent(percent); });
  }

  void choose_assumptions() {
    static const std::vector<std::vector<std::int32_t>> priorities = {
        {1}, {1}, {1}, {2}, {1, 2}, {2, 1}, {3, 1}, {1, 3, 2}};
    Assumptions& assumptions = question_.assumptions;
    assumptions.start.clear();
    for (const TaskId task : catalog_.task_ids) {
      const bool is_usual = catalog_.tasks[task].start_on_request != 0;
      if (!random_.percent(is_usual ? 85 : 12)) continue;
      if (catalog_.rules_of(task).requestable == 0) continue;
      assumptions.start.push_back({task, random_.pick(priorities)});
    }
    assumptions.stop.clear();
    for (const TaskId task : catalog_.task_ids) {
      if (random_.percent(65)) assumptions.stop.push_back(task);
    }
    assumptions.successes = random_.percent(80);
    assumptions.failures = random_.percent(80);
    if (catalog_.has_further_keys()) {
      static const std::vector<std::uint32_t> most = {0, 1, 1, 2, 3};
      if (random_.percent(40)) assumptions.most_failed = random_.pick(most);
      if (random_.percent(30)) assumptions.most_suspended = random_.pick(most);
    }
    static const std::vector<std::uint32_t> faults = {0, 0, 0, 1, 1, 2};
    assumptions.faults = random_.pick(faults);
    if (random_.percent(30)) {
      assumptions.only_listed_fail = random_.percent(50);
      assumptions.listed_for_faults.assign(catalog_.behavior_ids.begin(),
                                           catalog_.behavior_ids.end());
      keep_some(assumptions.listed_for_faults, 40);
    }
    keep_some(assumptions.variables, 85);
    if (random_.percent(45)) {
      for (const BehaviorId behavior : catalog_.behavior_ids) {
        if (random_.percent(20)) assumptions.behaviors.push_back(behavior);
      }
    }
    if (random_.percent(40)) {
      const std::size_t wanted = 1 + random_.below(2);
      for (std::size_t i = 0; i < wanted; ++i) add_never();
    }
    if (random_.percent(25)) add_coupling();
    if (random_.percent(40)) {
      const std::size_t wanted = 1 + random_.below(2);
      for (std::size_t i = 0; i < wanted; ++i) add_together();
    }
    if (random_.percent(35)) {
      const std::size_t wanted = 1 + random_.below(2);
      for (std::size_t i = 0; i < wanted; ++i) add_initial();
    }
  }

  /// Finds a state far from the first one, so that properties can ask for it.
  void find_far_state() {
    constexpr std::size_t most_states = 150;
    const PlainModel model(catalog_, question_.groups, question_.assumptions);
    state_ = model.first_state();
    if (model.is_excluded(state_)) {
      if (random_.percent(20)) return;
      question_.assumptions.never.clear();
    }
    std::vector<Snapshot> found = {state_};
    std::set<std::string> seen = {model.key(state_)};
    for (std::size_t place = 0; place < found.size() && found.size() < most_states; ++place) {
      const Snapshot state = found[place];
      for (const Move& move : model.moves(state)) {
        Step step = model.step(state, move);
        if (!step.exists) continue;
        if (seen.insert(model.key(step.next)).second) found.push_back(std::move(step.next));
      }
    }
    state_ = random_.percent(60) ? found.back() : random_.pick(found);
  }

  VariableValue draw_value(std::uint32_t variable) {
    return {variable,
            static_cast<std::uint32_t>(random_.below(catalog_.variables[variable].value_count))};
  }

  /// About variables and behaviors of the whole catalog.
  void add_never() {
    SituationPart part;
    const std::size_t wanted = 1 + random_.below(2);
    for (std::size_t i = 0; i < wanted; ++i) {
      const std::size_t variables = catalog_.variables.size();
      if (variables > 0 && random_.percent(70)) {
        add_value(part, draw_value(static_cast<std::uint32_t>(random_.below(variables))));
      } else if (!question_.assumptions.behaviors.empty() && random_.percent(80)) {
        add_own(part, random_.pick(question_.assumptions.behaviors), random_.percent(30));
      } else if (!catalog_.behavior_ids.empty()) {
        add_own(part, catalog_.behavior_ids[random_.below(catalog_.behavior_ids.size())],
                random_.percent(30));
      }
    }
    if (!part.variables.empty() || !part.behaviors.empty()) {
      question_.assumptions.never.push_back(part);
    }
  }

  /// Variables of the whole catalog, in catalog order; none if too few may change.
  std::vector<std::uint32_t> draw_variables(std::size_t count) {
    std::vector<std::uint32_t> variables = question_.assumptions.variables;
    if (variables.size() < count) return {};
    random_.shuffle(variables);
    variables.resize(count);
    std::sort(variables.begin(), variables.end());
    return variables;
  }

  /// Two variables that have their first values at the same time only.
  void add_coupling() {
    const std::vector<std::uint32_t> variables = draw_variables(2);
    if (variables.empty()) return;
    for (std::uint32_t a = 0; a < catalog_.variables[variables[0]].value_count; ++a) {
      for (std::uint32_t b = 0; b < catalog_.variables[variables[1]].value_count; ++b) {
        if ((a == 0) == (b == 0)) continue;
        question_.assumptions.never.push_back({{{variables[0], a}, {variables[1], b}}, {}});
      }
    }
    if (random_.percent(50)) question_.assumptions.together.push_back(variables);
  }

  void add_together() {
    std::vector<std::uint32_t> variables = draw_variables(2 + random_.below(2));
    if (!variables.empty()) question_.assumptions.together.push_back(std::move(variables));
  }

  void add_initial() {
    SituationPart& part = question_.assumptions.initially;
    const std::size_t variables = catalog_.variables.size();
    if (variables > 0 && random_.percent(60)) {
      add_value(part, draw_value(static_cast<std::uint32_t>(random_.below(variables))));
    } else if (!behaviors_.empty()) {
      add_own(part, random_.pick(behaviors_), random_.percent(25));
    }
  }

  static void add_value(SituationPart& part, VariableValue value) {
    for (const VariableValue& entry : part.variables) {
      if (entry.variable == value.variable) return;
    }
    part.variables.push_back(value);
  }

  static void add_own(SituationPart& part, BehaviorId behavior, bool available) {
    for (const SituationPart::Own& entry : part.behaviors) {
      if (entry.behavior == behavior) return;
    }
    part.behaviors.push_back({behavior, available});
  }

  void add_property() {
    static const std::vector<Property::Kind> kinds = {Property::Kind::can_start,
                                                      Property::Kind::always, Property::Kind::never,
                                                      Property::Kind::reachable};
    Property property;
    property.kind = random_.pick(kinds);
    property.name = "P" + std::to_string(question_.properties.size());
    const TaskId task = random_.pick(tasks_);
    const bool is_requestable = catalog_.rules_of(task).requestable != 0;
    if (property.kind == Property::Kind::can_start && !is_requestable) {
      property.kind = Property::Kind::reachable;
    }
    if (property.kind == Property::Kind::can_start) {
      property.task = task;
      property.priority = static_cast<std::int32_t>(random_.between(1, 3));
      if (random_.percent(70)) property.when = draw_nested(1 + random_.below(2));
    } else {
      const bool is_always = property.kind == Property::Kind::always;
      if (is_always) {
        property.condition = draw_nested(1);
        if (random_.percent(80)) {
          property.when = random_.percent(50) ? describe_state(1 + random_.below(3))
                                              : draw_nested(1 + random_.below(2));
        }
      } else {
        property.condition = random_.percent(60) ? describe_state(2 + random_.below(11))
                                                 : draw_nested(1 + random_.below(3));
      }
      property.settled = random_.percent(35);
    }
    question_.properties.push_back(std::move(property));
  }

  /// What goes on, and what stays possible.
  void add_lasting() {
    Property property;
    property.name = "P" + std::to_string(question_.properties.size());
    if (random_.percent(50)) {
      property.kind = Property::Kind::keeps_running;
      property.task = random_.pick(tasks_);
    } else {
      property.kind = Property::Kind::always_possible;
      property.condition = random_.percent(70) ? describe_state(1 + random_.below(3))
                                               : draw_nested(1 + random_.below(2));
      property.settled = random_.percent(25);
      if (random_.percent(40)) property.within = static_cast<std::uint32_t>(random_.below(5));
    }
    if (random_.percent(40)) {
      property.when = random_.percent(50) ? describe_state(1 + random_.below(2))
                                          : draw_nested(1 + random_.below(2));
    }
    if (random_.percent(60)) property.by = draw_kinds();
    question_.properties.push_back(std::move(property));
  }

  MoveKinds draw_kinds() {
    MoveKinds kinds;
    for (const MoveKindWord& known : move_kind_words) kinds.*known.kind = random_.percent(65);
    for (const TaskId task : tasks_) {
      if (kinds.start && random_.percent(15)) kinds.start_only.push_back(task);
      if (kinds.stop && random_.percent(15)) kinds.stop_only.push_back(task);
    }
    return kinds;
  }

  /// A promise for a part of each path, whose states are its own.
  void add_scoped() {
    Property property;
    property.name = "P";
    property.kind = random_.percent(50) ? Property::Kind::always : Property::Kind::never;
    property.condition = property.kind == Property::Kind::never
                             ? describe_state(1 + random_.below(5))
                             : draw_nested(1);
    if (property.kind == Property::Kind::always && random_.percent(30)) {
      property.when = draw_nested(1);
    }
    property.after = random_.percent(50) ? describe_state(1 + random_.below(3))
                                         : draw_nested(1 + random_.below(2));
    if (random_.percent(70)) {
      property.until = random_.percent(50) ? describe_state(1 + random_.below(2))
                                           : draw_nested(1 + random_.below(2));
    }
    property.settled = random_.percent(20);
    question_.properties.push_back(std::move(property));
  }

  StateCondition draw_condition(std::size_t parts) {
    StateCondition condition;
    for (std::size_t i = 0; i < parts; ++i) add_part(condition);
    return condition;
  }

  /// With others in it, up to three deep.
  StateCondition draw_nested(std::size_t parts, std::size_t depth = 0) {
    const bool is_nested = depth < 3 && random_.percent(depth == 0 ? 65 : 40);
    if (!is_nested) return draw_condition(parts);
    StateCondition condition = draw_condition(random_.below(parts + 1));
    const auto add_inner = [&](Kind kind, std::size_t most) {
      StateCondition joined{kind};
      const std::size_t wanted = 1 + random_.below(most);
      for (std::size_t i = 0; i < wanted; ++i) {
        add(joined, random_.percent(25) ? describe_state(1 + random_.below(3))
                                        : draw_nested(1 + random_.below(2), depth + 1));
      }
      add(condition, std::move(joined));
    };
    const std::size_t kind = random_.below(100);
    if (kind < 45) add_inner(Kind::negated, 1);
    if (kind >= 30 && kind < 80) add_inner(Kind::any, 3);
    if (kind >= 70) add_inner(Kind::all, 2);
    return condition;
  }

  /// Parts that the state far away satisfies.
  StateCondition describe_state(std::size_t parts) {
    StateCondition condition;
    for (std::size_t i = 0; i < parts; ++i) add_fact(condition);
    return condition;
  }

  /// Some others besides.
  template <typename Number>
  std::vector<Number> with_others(Number one, const std::vector<Number>& others) {
    std::vector<Number> some;
    for (const Number other : others) {
      if (other == one || random_.percent(35)) some.push_back(other);
    }
    return some;
  }

  void add_values(StateCondition& condition, VariableValue value) {
    for (const StateCondition& part : condition.parts) {
      if (part.variable == value.variable) return;
    }
    std::vector<std::uint32_t> all(catalog_.variables[value.variable].value_count);
    for (std::uint32_t place = 0; place < all.size(); ++place) all[place] = place;
    add(condition, StateCondition::of_variable(
                       value.variable, random_.percent(50) ? std::vector{value.value}
                                                           : with_others(value.value, all)));
  }

  static void add_own(StateCondition& condition, BehaviorId behavior, bool available) {
    for (const StateCondition& part : condition.parts) {
      if (part.kind == Kind::own && part.behavior == behavior) return;
    }
    add(condition, StateCondition::own(behavior, available));
  }

  static void add(StateCondition& condition, StateCondition part) {
    condition.parts.push_back(std::move(part));
  }

  /// A part that lists all active behaviors, or null.
  static StateCondition* find_only(StateCondition& condition) {
    for (StateCondition& part : condition.parts) {
      if (part.kind == Kind::only_active) return &part;
    }
    return nullptr;
  }

  static void add_active(StateCondition& condition, BehaviorId behavior) {
    StateCondition* const only = find_only(condition);
    add(only == nullptr ? condition : *only, StateCondition::of_behavior(Kind::active, behavior));
  }

  /// No other behavior is active.
  static void make_only(StateCondition& condition) {
    if (find_only(condition) != nullptr) return;
    StateCondition only{Kind::only_active};
    std::vector<StateCondition> others;
    for (StateCondition& part : condition.parts) {
      (part.kind == Kind::active ? only.parts : others).push_back(std::move(part));
    }
    others.push_back(std::move(only));
    condition.parts = std::move(others);
  }

  void add_running(StateCondition& condition, TaskId task, BehaviorId behavior) {
    std::vector<BehaviorId> performers;
    for (const Value& value : catalog_.values[task]) performers.push_back(value.behavior);
    add(condition,
        StateCondition::of_task(
            Kind::running, task,
            random_.percent(60) ? std::vector{behavior} : with_others(behavior, performers)));
  }

  void add_fact(StateCondition& condition) {
    const TaskId task = random_.pick(tasks_);
    const std::size_t kind = random_.below(100);
    if (!state_.failed.empty() && random_.percent(20)) {
      return add(condition,
                 StateCondition::of_behavior(Kind::failed, random_.pick(state_.failed).first));
    }
    if (!state_.suspended.empty() && random_.percent(20)) {
      return add(condition,
                 StateCondition::of_task(Kind::suspended, random_.pick(state_.suspended).first));
    }
    if (kind < 15 && !state_.faulty.empty()) {
      add(condition, StateCondition::of_behavior(Kind::faulty, random_.pick(state_.faulty)));
    } else if (kind < 25 && !variables_.empty()) {
      const std::uint32_t variable = random_.pick(variables_);
      add_values(condition, {variable, state_.variables[variable]});
    } else if (kind < 32 && !behaviors_.empty()) {
      const BehaviorId behavior = random_.pick(behaviors_);
      add_own(condition, behavior, !contains(state_.denied, behavior));
    } else if (kind < 38 && state_.faulty.empty()) {
      add(condition, StateCondition{Kind::none_faulty});
    } else if (const auto* const entry = find_running(state_, task); entry == nullptr) {
      add(condition, StateCondition::of_task(Kind::stopped, task));
    } else if (const BehaviorId behavior = catalog_.values[task][entry->value_index].behavior;
               entry->request && entry->request->priority > 0 && random_.percent(40)) {
      add(condition, StateCondition::requested(task, entry->request->priority));
    } else if (random_.percent(15)) {
      add_active(condition, behavior);
    } else if (random_.percent(15)) {
      std::erase_if(condition.parts, [](const StateCondition& part) {
        return part.kind == Kind::active || part.kind == Kind::only_active;
      });
      make_only(condition);
      for (const auto& [active, time] : state_.active) add_active(condition, active);
    } else {
      random_.percent(60) ? add_running(condition, task, behavior)
                          : add(condition, StateCondition::of_task(Kind::running, task));
    }
  }

  void add_part(StateCondition& condition) {
    static const std::vector<std::int32_t> priorities = {1, 1, 2, 3};
    const TaskId task = random_.pick(tasks_);
    const std::size_t kind = random_.below(100);
    if (catalog_.has_further_keys() && !behaviors_.empty() && random_.percent(20)) {
      return random_.percent(50) ? add(condition, StateCondition::of_behavior(
                                                      Kind::failed, random_.pick(behaviors_)))
                                 : add(condition, StateCondition::of_task(Kind::suspended, task));
    }
    if (kind < 25 || behaviors_.empty()) {
      const auto values = catalog_.values[task];
      const bool is_any = values.empty() || random_.percent(50);
      if (is_any) {
        add(condition, StateCondition::of_task(Kind::running, task));
      } else {
        add_running(condition, task, values[random_.below(values.size())].behavior);
      }
    } else if (kind < 42) {
      add(condition, StateCondition::of_task(Kind::stopped, task));
    } else if (kind < 46) {
      add(condition, StateCondition{Kind::none_faulty});
    } else if (kind < 58) {
      add_active(condition, random_.pick(behaviors_));
      if (random_.percent(30)) make_only(condition);
    } else if (kind < 66) {
      add(condition, StateCondition::of_behavior(Kind::faulty, random_.pick(behaviors_)));
    } else if (kind < 74) {
      add(condition, StateCondition::of_behavior(Kind::available, random_.pick(behaviors_)));
    } else if (kind < 87) {
      add(condition, StateCondition::requested(task, random_.pick(priorities)));
    } else if (kind < 95 && !variables_.empty()) {
      add_values(condition, draw_value(random_.pick(variables_)));
    } else if (kind < 97 && !catalog_.variables.empty()) {
      const std::size_t variable = random_.below(catalog_.variables.size());
      add_values(condition, draw_value(static_cast<std::uint32_t>(variable)));
    } else {
      add_own(condition, random_.pick(behaviors_), random_.percent(40));
    }
  }

  Random& random_;
  const CompiledCatalog& catalog_;
  Question question_;
  Snapshot state_;  ///< one to ask for
  // Of the groups.
  std::vector<TaskId> tasks_;
  std::vector<BehaviorId> behaviors_;
  std::vector<std::uint32_t> variables_;
};

}  // namespace

Question generate_question(Random& random, const CompiledCatalog& catalog) {
  return QuestionGenerator(random, catalog).generate();
}

}  // namespace cbc::plain
