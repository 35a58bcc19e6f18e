#include <algorithm>
#include <cmath>
#include <memory>

#include "lint_mutations.h"

namespace cbc::mutation {
namespace {

using Result = std::optional<Mutation>;

constexpr int attempts = 20;

struct RequirementPlace {
  std::size_t behavior;
  std::size_t requirement;
};

std::vector<RequirementPlace> all_requirements(const CatalogOutline& catalog) {
  std::vector<RequirementPlace> places;
  for (std::size_t behavior = 0; behavior < catalog.behaviors().size(); ++behavior) {
    const std::size_t count = catalog.behaviors()[behavior].requirements.size();
    for (std::size_t each = 0; each < count; ++each) places.push_back({behavior, each});
  }
  return places;
}

Expected at_value(const CatalogOutline& mutated, std::string_view rule, const Field& field,
                  std::string says = {}) {
  return at(mutated.lines(), rule, field.value.line, field.value.column, std::move(says));
}

/// Whether the behavior would require one of its own tasks, directly or indirectly.
bool closes_cycle(const CatalogOutline& catalog, const Behavior& behavior, std::size_t required) {
  return std::any_of(
      behavior.performs.begin(), behavior.performs.end(), [&](const Performance& performance) {
        return performance.task == required || catalog.reaches(required, performance.task);
      });
}

/// The catalog with another requirement at the end of those of a behavior.
std::unique_ptr<CatalogOutline> with_requirement(const CatalogOutline& catalog,
                                                 std::size_t behavior, const std::string& name) {
  Lines lines = catalog.lines();
  const Item& entry = *catalog.behaviors()[behavior].entry;
  if (const Field* list = entry.find("requires")) {
    if (list->value.kind != Item::Kind::list || list->value.flow) return nullptr;
    lines.insert_after(list->last_line, spaces(list->value.column) + "- task: " + name);
  } else {
    const std::size_t line = add_field(lines, entry, "requires:");
    lines.insert_after(line, spaces(entry.column) + "- task: " + name);
  }
  return CatalogOutline::read(lines);
}

/// The catalog with a list of two tasks that exclude one another.
std::unique_ptr<CatalogOutline> with_exclusion(const CatalogOutline& catalog, std::size_t task,
                                               std::size_t other) {
  Lines lines = catalog.lines();
  const Field* section = catalog.root().find("exclusivity_constraints");
  std::size_t after = lines.count();
  std::size_t column = 0;
  if (section == nullptr) {
    lines.insert_after(after++, "exclusivity_constraints:");
  } else {
    after = section->last_line;
    column = section->value.column;
  }
  lines.insert_after(after, spaces(column) + "- mutually_exclusive: [" +
                                catalog.tasks()[task].name + ", " + catalog.tasks()[other].name +
                                "]");
  return CatalogOutline::read(lines);
}

/// Gives a task an attribute, under its present name.
std::unique_ptr<CatalogOutline> with_attribute(const CatalogOutline& catalog, const Task& task,
                                               const std::string& key, const std::string& older_key,
                                               const std::string& value) {
  Lines lines = catalog.lines();
  if (const Field* own = task.entry->find(key)) {
    set_value(lines, *own, value);
  } else {
    add_field(lines, *task.entry, key + ": " + value);
    if (task.entry->find(older_key) != nullptr) return nullptr;
  }
  return CatalogOutline::read(lines);
}

/// Where fewer assignments are left, requirements may be satisfied anyway, and more has to be
/// requested.
const std::set<std::string_view> fewer_assignments{"redundant-requirement", "requires-on-request",
                                                   "unreachable-performance"};

/// Findings that a new exclusion may also cause, on higher levels than its own.
const std::set<std::string_view> also_of_exclusion{
    "conflicting-requirements", "dead-behavior",         "dead-task",
    "duplicate-exclusion",      "redundant-requirement", "requires-on-request",
    "unreachable-performance"};

/// Findings that a new requirement may also cause.
std::set<std::string_view> also_of_requirement(const CatalogOutline& catalog, std::size_t task) {
  std::set<std::string_view> also = fewer_assignments;
  if (!catalog.tasks()[task].keeps_running) also.insert("required-goal");
  return also;
}

/// Where a task cannot run at all, its behaviors are not reported each; a mistake that explains one
/// of them changes that.
bool can_all_run(const CatalogOutline& catalog) {
  for (std::size_t task = 0; task < catalog.tasks().size(); ++task) {
    if (!catalog.can_run(task)) return false;
  }
  return true;
}

Result cycle(const CatalogOutline& catalog, Random& random) {
  for (int i = 0; i < attempts; ++i) {
    const std::size_t index = random.below(catalog.behaviors().size());
    const std::size_t task = random.below(catalog.tasks().size());
    const Behavior& behavior = catalog.behaviors()[index];
    if (!closes_cycle(catalog, behavior, task) || catalog.requires_task(behavior, task)) continue;
    const auto mutated = with_requirement(catalog, index, catalog.tasks()[task].name);
    if (mutated == nullptr || mutated->count_exclusive_requirements() > 0) continue;
    return Mutation{mutated->lines().text(),
                    {{"requirement-cycle", mutated->lines_of_first_steps(), std::nullopt}},
                    also_of_requirement(catalog, task)};
  }
  return std::nullopt;
}

Result requires_what_excludes_it(const CatalogOutline& catalog, Random& random) {
  if (!can_all_run(catalog)) return std::nullopt;
  for (int i = 0; i < attempts; ++i) {
    const std::size_t index = random.below(catalog.behaviors().size());
    const std::size_t task = random.below(catalog.tasks().size());
    const Behavior& behavior = catalog.behaviors()[index];
    if (!catalog.is_exclusive(behavior, task) || closes_cycle(catalog, behavior, task)) continue;
    const auto mutated = with_requirement(catalog, index, catalog.tasks()[task].name);
    if (mutated == nullptr) continue;
    const Field& name = *mutated->behaviors()[index].requirements.back().name;
    return Mutation{mutated->lines().text(),
                    {at_value(*mutated, "exclusive-requirement", name,
                              "behavior " + in_quotes(behavior.name) + " requires " +
                                  in_quotes(catalog.tasks()[task].name))},
                    also_of_requirement(catalog, task)};
  }
  return std::nullopt;
}

Result excludes_what_is_required(const CatalogOutline& catalog, Random& random) {
  const std::vector<RequirementPlace> places = all_requirements(catalog);
  if (places.empty()) return std::nullopt;
  const auto [index, place] = random.pick(places);
  const Behavior& behavior = catalog.behaviors()[index];
  const auto mutated =
      with_exclusion(catalog, behavior.performs.front().task, behavior.requirements[place].task);
  if (mutated == nullptr || mutated->count_exclusive_requirements() != 1 ||
      !mutated->is_exclusive(mutated->behaviors()[index], behavior.requirements[place].task)) {
    return std::nullopt;
  }
  const Field& name = *mutated->behaviors()[index].requirements[place].name;
  return Mutation{mutated->lines().text(),
                  {at_value(*mutated, "exclusive-requirement", name)},
                  also_of_exclusion};
}

Result requires_what_conflicts(const CatalogOutline& catalog, Random& random) {
  if (!can_all_run(catalog)) return std::nullopt;
  for (int i = 0; i < attempts; ++i) {
    const std::size_t index = random.below(catalog.behaviors().size());
    const std::size_t task = random.below(catalog.tasks().size());
    const Behavior& behavior = catalog.behaviors()[index];
    const auto& required = behavior.requirements;
    const bool conflicts = std::any_of(
        required.begin(), required.end(),
        [&](const Requirement& requirement) { return catalog.excludes(requirement.task, task); });
    if (!conflicts || closes_cycle(catalog, behavior, task) ||
        catalog.is_exclusive(behavior, task) || catalog.requires_task(behavior, task)) {
      continue;
    }
    const auto mutated = with_requirement(catalog, index, catalog.tasks()[task].name);
    if (mutated == nullptr) continue;
    const Field& name = *mutated->behaviors()[index].requirements.back().name;
    return Mutation{
        mutated->lines().text(),
        {at_value(*mutated, "conflicting-requirements", name, in_quotes(behavior.name))},
        also_of_requirement(catalog, task)};
  }
  return std::nullopt;
}

Result conflict_of_what_is_required(const CatalogOutline& catalog, Random& random) {
  const std::vector<RequirementPlace> places = all_requirements(catalog);
  if (places.empty()) return std::nullopt;
  const Behavior& behavior = catalog.behaviors()[random.pick(places).behavior];
  const std::size_t one = random.pick(behavior.requirements).task;
  const std::size_t other = random.pick(behavior.requirements).task;
  if (one == other || catalog.excludes(one, other)) return std::nullopt;
  const auto mutated = with_exclusion(catalog, one, other);
  if (mutated == nullptr || mutated->count_exclusive_requirements() > 0) return std::nullopt;
  // What is required one level further down may conflict, too.
  Mutation mutation{mutated->lines().text(), {}, also_of_exclusion};
  for (const Behavior& each : mutated->behaviors()) {
    const Field* later = nullptr;
    for (const Requirement& requirement : each.requirements) {
      if (requirement.task == one || requirement.task == other) later = requirement.name;
    }
    if (!mutated->requires_task(each, one) || !mutated->requires_task(each, other)) continue;
    mutation.expected.push_back(
        at_value(*mutated, "conflicting-requirements", *later, in_quotes(each.name)));
  }
  return mutation;
}

/// Requirements of a behavior that conflict only through what they require in turn.
Result conflict_further_down(const CatalogOutline& catalog, Random& random) {
  if (!can_all_run(catalog)) return std::nullopt;
  for (int i = 0; i < 20 * attempts; ++i) {
    const std::size_t index = random.below(catalog.behaviors().size());
    const Behavior& behavior = catalog.behaviors()[index];
    if (behavior.requirements.size() < 2 || behavior.performs.size() != 1) continue;
    const std::size_t first = random.pick(behavior.requirements).task;
    const std::size_t second = random.pick(behavior.requirements).task;
    const std::size_t below = random.below(catalog.tasks().size());
    const bool has_minimum =
        std::any_of(behavior.requirements.begin(), behavior.requirements.end(),
                    [](const Requirement& requirement) { return requirement.minimum > 0; });
    if (has_minimum || first == second || first == below || catalog.requires_task(behavior, below))
      continue;
    bool is_needed = true;
    for (const Behavior& each : catalog.behaviors()) {
      is_needed &= !performs(each, second) || catalog.requires_task(each, below);
      is_needed &= !catalog.requires_task(each, first) || !catalog.requires_task(each, below);
    }
    if (!is_needed || !catalog.is_live(index)) continue;
    const auto mutated = with_exclusion(catalog, first, below);
    if (mutated == nullptr || mutated->count_exclusive_requirements() > 0) continue;
    // What is dead below would explain it.
    const std::size_t own = behavior.performs.front().task;
    const bool is_first_fault = std::all_of(
        mutated->behaviors().begin(), mutated->behaviors().end(), [&](const Behavior& each) {
          const bool is_below = std::any_of(each.performs.begin(), each.performs.end(),
                                            [&](const Performance& performance) {
                                              return catalog.reaches(own, performance.task);
                                            });
          return !is_below || mutated->is_live(each);
        });
    if (!is_first_fault || !mutated->can_run(first) || !mutated->can_run(second)) continue;
    const auto others = std::count_if(catalog.behaviors().begin(), catalog.behaviors().end(),
                                      [own](const Behavior& each) { return performs(each, own); });
    Mutation mutation{mutated->lines().text(), {}, also_of_exclusion};
    if (mutated->can_run(own)) {
      mutation.expected.push_back(at_value(*mutated, "dead-behavior",
                                           *mutated->behaviors()[index].entry->find("behavior"),
                                           in_quotes(behavior.name)));
    } else if (others == 1) {
      mutation.expected.push_back({"dead-task",
                                   {mutated->tasks()[own].name_line},
                                   std::nullopt,
                                   in_quotes(mutated->tasks()[own].name)});
    } else {
      continue;
    }
    return mutation;
  }
  return std::nullopt;
}

Result on_request_and_reactive(const CatalogOutline& catalog, Random& random) {
  const Task* task = pick_if(catalog.tasks(), random, [](const Task& each) {
    return each.entry != nullptr && !says(each, "reactive_start", "default");
  });
  if (task == nullptr) return std::nullopt;
  Lines lines = catalog.lines();
  if (says(*task, "start_on_request", "automatic_activation")) {
    if (!task->start_on_request) return std::nullopt;
  } else {
    add_field(lines, *task->entry, "start_on_request: TRUE");
  }
  // The later one is the mistake.
  const std::size_t added = lines.count() - catalog.lines().count();
  const std::size_t line = task->entry->last_line + added + 1;
  lines.insert_after(line - 1, spaces(task->entry->column) + "reactive_start: TRUE");
  return Mutation{
      lines.text(),
      {at(lines, "on-request-and-reactive", line, task->entry->column, in_quotes(task->name))},
      {"reactive-timeout", "requires-on-request"}};
}

/// The same in the defaults; reported there, and once.
Result on_request_and_reactive_by_default(const CatalogOutline& catalog, Random& random) {
  const Mapping* defaults = pick_if(catalog.mappings(), random, [](const Mapping& each) {
    return each.shape->name == "task defaults" && each.item->find("reactive_start") == nullptr;
  });
  if (defaults == nullptr) return std::nullopt;
  bool concerns_any = false;
  for (const Task& task : catalog.tasks()) {
    if (says(task, "reactive_start", "default")) return std::nullopt;
    if (!task.start_on_request) continue;
    if (says(task, "start_on_request", "automatic_activation")) return std::nullopt;
    concerns_any = true;
  }
  if (!concerns_any) return std::nullopt;
  Lines lines = catalog.lines();
  const std::size_t line = add_field(lines, *defaults->item, "reactive_start: TRUE");
  return Mutation{lines.text(),
                  {at(lines, "on-request-and-reactive", line, defaults->item->column)},
                  {"reactive-timeout"}};
}

/// A percentage over what the task can reach.
std::optional<std::string> unreachable(const CatalogOutline& catalog, std::size_t task,
                                       Random& random) {
  constexpr double rounding = 1e-9;
  if (!can_all_run(catalog)) return std::nullopt;
  const auto most =
      static_cast<std::int64_t>(std::floor(catalog.most_performance(task) * 100 + rounding));
  if (most + 1 > 100) return std::nullopt;
  return std::to_string(random.between(most + 1, 100));
}

std::unique_ptr<CatalogOutline> with_minimum(const CatalogOutline& catalog, const Item& entry,
                                             const std::string& percent) {
  Lines lines = catalog.lines();
  if (const Field* own = entry.find("minimum_performance")) {
    set_value(lines, *own, percent);
  } else {
    add_field(lines, entry, "minimum_performance: " + percent);
  }
  return CatalogOutline::read(lines);
}

Result requires_too_much(const CatalogOutline& catalog, Random& random) {
  const std::vector<RequirementPlace> places = all_requirements(catalog);
  if (places.empty()) return std::nullopt;
  const auto [index, place] = random.pick(places);
  const Requirement& requirement = catalog.behaviors()[index].requirements[place];
  const auto percent = unreachable(catalog, requirement.task, random);
  if (!percent) return std::nullopt;
  const auto mutated = with_minimum(catalog, *requirement.entry, *percent);
  if (mutated == nullptr) return std::nullopt;
  const Item& entry = *mutated->behaviors()[index].requirements[place].entry;
  return Mutation{mutated->lines().text(),
                  {at_value(*mutated, "unreachable-performance", *entry.find("minimum_performance"),
                            "at least " + *percent + " %")},
                  fewer_assignments};
}

Result demands_too_much(const CatalogOutline& catalog, Random& random) {
  const Task* task =
      pick_if(catalog.tasks(), random, [](const Task& each) { return each.entry != nullptr; });
  if (task == nullptr) return std::nullopt;
  const auto index = static_cast<std::size_t>(task - catalog.tasks().data());
  const auto percent = unreachable(catalog, index, random);
  if (!percent) return std::nullopt;
  const auto mutated = with_minimum(catalog, *task->entry, *percent);
  if (mutated == nullptr) return std::nullopt;
  const Item& entry = *mutated->tasks()[index].entry;
  return Mutation{mutated->lines().text(),
                  {at_value(*mutated, "unreachable-performance", *entry.find("minimum_performance"),
                            "at least " + *percent + " %")},
                  fewer_assignments};
}

/// A suitability that counts somewhere.
Result fraction_as_suitability(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    if (each.field->key != "suitability" && each.field->key != "efficacy") return false;
    return each.shape->name == "performance" ||
           (each.shape->name == "behavior" && each.mapping->find("task") != nullptr);
  });
  if (placed == nullptr) return std::nullopt;
  static const std::vector<std::string> fractions{"0.9", "1", "0.25", "0", "0.0001"};
  const std::string& fraction = random.pick(fractions);
  Lines lines = catalog.lines();
  set_value(lines, *placed->field, fraction);
  const Item& value = placed->field->value;
  return Mutation{lines.text(),
                  {at(lines, "suspicious-suitability", value.line, value.column,
                      "suitability of " + fraction + " %")},
                  {"unreachable-performance", "dead-behavior", "dead-task", "redundant-requirement",
                   "requires-on-request"}};
}

Result fraction_as_minimum(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return each.shape->name == "requirement" || each.shape->name == "task";
  });
  if (placed == nullptr) return std::nullopt;
  static const std::vector<std::string> fractions{"0.7", "1", "0.95"};
  const std::string& fraction = random.pick(fractions);
  const auto mutated = with_minimum(catalog, *placed->mapping, fraction);
  if (mutated == nullptr) return std::nullopt;
  const Field* own = placed->mapping->find("minimum_performance");
  const std::size_t line = own == nullptr ? placed->mapping->last_line + 1 : own->line;
  const std::size_t column =
      own == nullptr ? placed->mapping->column + std::string_view("minimum_performance: ").size()
                     : own->value.column;
  return Mutation{mutated->lines().text(),
                  {at(mutated->lines(), "suspicious-minimum", line, column, fraction + " %")},
                  {"unreachable-performance", "dead-behavior", "dead-task", "redundant-requirement",
                   "requires-on-request"}};
}

Result timeout_without_effect(const CatalogOutline& catalog, Random& random) {
  std::vector<const Item*> entries;
  for (const Task& task : catalog.tasks()) {
    if (task.entry != nullptr && task.keeps_running && task.entry->find("timeout") == nullptr) {
      entries.push_back(task.entry);
    }
  }
  for (const Behavior& behavior : catalog.behaviors()) {
    const bool keeps_running = std::all_of(
        behavior.performs.begin(), behavior.performs.end(),
        [&](const Performance& each) { return catalog.tasks()[each.task].keeps_running; });
    if (keeps_running && !behavior.has_timeout) entries.push_back(behavior.entry);
  }
  if (entries.empty()) return std::nullopt;
  const Item& entry = *random.pick(entries);
  Lines lines = catalog.lines();
  const std::size_t line = add_field(lines, entry, "timeout: 20");
  return Mutation{lines.text(), {at(lines, "no-timeout-effect", line, entry.column + 9)}};
}

Result requirement_twice(const CatalogOutline& catalog, Random& random) {
  const std::vector<RequirementPlace> places = all_requirements(catalog);
  if (places.empty()) return std::nullopt;
  const auto [index, place] = random.pick(places);
  if (!catalog.is_live(index)) return std::nullopt;
  const Requirement& requirement = catalog.behaviors()[index].requirements[place];
  const std::string& name = catalog.tasks()[requirement.task].name;
  auto mutated = with_requirement(catalog, index, name);
  if (mutated == nullptr) return std::nullopt;
  const Field* minimum = requirement.entry->find("minimum_performance");
  if (minimum != nullptr && random.percent(50)) {
    mutated = with_minimum(*mutated, *mutated->behaviors()[index].requirements.back().entry,
                           minimum->value.text);
  }
  return Mutation{
      mutated->lines().text(),
      {at_value(*mutated, "redundant-requirement",
                *mutated->behaviors()[index].requirements.back().name, in_quotes(name))}};
}

/// A listed task that something requires, and that fulfils a condition.
template <typename Condition>
const Task* pick_required(const CatalogOutline& catalog, Random& random, Condition condition) {
  return pick_if(catalog.tasks(), random, [&](const Task& task) {
    const auto index = static_cast<std::size_t>(&task - catalog.tasks().data());
    const auto& behaviors = catalog.behaviors();
    return task.entry != nullptr && condition(task) &&
           std::any_of(behaviors.begin(), behaviors.end(), [&](const Behavior& behavior) {
             return catalog.requires_task(behavior, index);
           });
  });
}

Result required_on_request(const CatalogOutline& catalog, Random& random) {
  const Task* task = pick_required(catalog, random, [](const Task& each) {
    return !each.start_on_request && !each.reactive_start;
  });
  if (task == nullptr) return std::nullopt;
  const auto index = static_cast<std::size_t>(task - catalog.tasks().data());
  const auto mutated =
      with_attribute(catalog, *task, "start_on_request", "automatic_activation", "TRUE");
  if (mutated == nullptr) return std::nullopt;
  Mutation mutation{mutated->lines().text(), {}};
  for (const Behavior& behavior : mutated->behaviors()) {
    for (const Requirement& requirement : behavior.requirements) {
      if (requirement.task != index || !mutated->is_live(behavior)) continue;
      mutation.expected.push_back(
          at_value(*mutated, "requires-on-request", *requirement.name,
                   in_quotes(behavior.name) + " requires " + in_quotes(task->name)));
    }
  }
  // Behaviors of the tasks above have more to request first now.
  mutation.also = {"requires-on-request"};
  return mutation.expected.empty() ? std::nullopt : std::optional(mutation);
}

Result required_goal(const CatalogOutline& catalog, Random& random) {
  const Task* task =
      pick_required(catalog, random, [](const Task& each) { return each.keeps_running; });
  if (task == nullptr) return std::nullopt;
  const auto mutated = with_attribute(catalog, *task, "execution_goal", "category", "achieve_goal");
  if (mutated == nullptr) return std::nullopt;
  const auto index = static_cast<std::size_t>(task - catalog.tasks().data());
  return Mutation{mutated->lines().text(),
                  {at_value(*mutated, "required-goal", *mutated->tasks()[index].entry->find("task"),
                            in_quotes(task->name))}};
}

Result starts_for_ever(const CatalogOutline& catalog, Random& random) {
  const Task* task = pick_if(catalog.tasks(), random, [](const Task& each) {
    return each.entry != nullptr && !each.keeps_running && !each.timeout.empty() &&
           !each.reactive_start && !says(each, "reactive_start", "default") &&
           (!each.start_on_request || !says(each, "start_on_request", "automatic_activation"));
  });
  if (task == nullptr) return std::nullopt;
  const auto mutated = with_attribute(catalog, *task, "reactive_start", "default", "TRUE");
  if (mutated == nullptr) return std::nullopt;
  const auto index = static_cast<std::size_t>(task - catalog.tasks().data());
  return Mutation{
      mutated->lines().text(),
      {at_value(
          *mutated, "reactive-timeout", *mutated->tasks()[index].entry->find("task"),
          in_quotes(task->name) + " starts reactively and is ended after " + task->timeout + " s")},
      {"requires-on-request"}};  // less has to be requested
}

}  // namespace

std::vector<MistakeKind> meaning_mistakes() {
  return {{"cycle", cycle},
          {"requires what excludes it", requires_what_excludes_it},
          {"excludes what is required", excludes_what_is_required},
          {"requires what conflicts", requires_what_conflicts},
          {"conflict of what is required", conflict_of_what_is_required},
          {"conflict further down", conflict_further_down},
          {"on request and reactive", on_request_and_reactive},
          {"on request and reactive by default", on_request_and_reactive_by_default},
          {"requirement of too much", requires_too_much},
          {"minimum of too much", demands_too_much},
          {"fraction as suitability", fraction_as_suitability},
          {"fraction as minimum", fraction_as_minimum},
          {"timeout without effect", timeout_without_effect},
          {"requirement twice", requirement_twice},
          {"required on request", required_on_request},
          {"required goal", required_goal},
          {"starts for ever", starts_for_ever}};
}

}  // namespace cbc::mutation
