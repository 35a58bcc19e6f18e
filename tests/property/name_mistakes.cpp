#include <algorithm>
#include <stdexcept>
#include <string>

#include "lint_mutations.h"

namespace cbc::mutation {
namespace {

using Result = std::optional<Mutation>;

std::vector<std::string_view> task_names(const CatalogOutline& catalog) {
  std::vector<std::string_view> names;
  for (const Task& task : catalog.tasks()) names.push_back(task.name);
  return names;
}

/// What may follow where requirements and exclusions have changed.
const std::set<std::string_view> changes_of_meaning{
    "redundant-requirement", "required-goal", "requires-on-request",
    "dead-behavior",         "dead-task",     "unreachable-performance"};

struct Place {
  std::size_t line;
  std::size_t column;
  std::string name;
};

/// Where tasks are named that have to be defined elsewhere.
std::vector<Place> uses(const CatalogOutline& catalog, bool in_lists) {
  std::vector<Place> places;
  if (in_lists) {
    for (const Item* entry : catalog.list_entries()) {
      for (const Item& name : entry->find("mutually_exclusive")->value.items) {
        places.push_back({name.line, name.column, name.text});
      }
    }
  } else {
    for (const Behavior& behavior : catalog.behaviors()) {
      for (const Requirement& requirement : behavior.requirements) {
        const Item& value = requirement.name->value;
        places.push_back({value.line, value.column, value.text});
      }
    }
  }
  return places;
}

Result rename_use(const CatalogOutline& catalog, Random& random, bool in_lists, bool is_strange) {
  const std::vector<Place> places = uses(catalog, in_lists);
  if (places.empty()) return std::nullopt;
  const Place place = random.pick(places);
  std::string wrong = "xqzwvjkqxz";
  std::string says = in_quotes(wrong);
  if (!is_strange) {
    wrong = misspell(place.name, random);
    if (!is_clear_misspelling(wrong, place.name, task_names(catalog))) return std::nullopt;
    says = "did you mean " + in_quotes(place.name) + "?";
  }
  Lines lines = catalog.lines();
  lines.replace(place.line, place.column, place.name.size(), wrong);
  return Mutation{lines.text(),
                  {at(lines, "undefined-task", place.line, place.column, says)},
                  {"duplicate-exclusion"}};  // says of which list
}

Result requirement_misspelt(const CatalogOutline& catalog, Random& random) {
  return rename_use(catalog, random, false, false);
}
Result requirement_dangles(const CatalogOutline& catalog, Random& random) {
  return rename_use(catalog, random, false, true);
}
Result exclusion_misspelt(const CatalogOutline& catalog, Random& random) {
  return rename_use(catalog, random, true, false);
}
Result exclusion_dangles(const CatalogOutline& catalog, Random& random) {
  return rename_use(catalog, random, true, true);
}

void insert(Lines& lines, std::size_t after, const std::vector<std::string>& added) {
  for (const std::string& line : added) lines.insert_after(after++, line);
}

Result behavior_twice(const CatalogOutline& catalog, Random& random) {
  const Item& list = catalog.root().find("behaviors")->value;
  const Item& entry = random.pick(list.items);
  const Item& after = random.pick(list.items);
  Lines lines = catalog.lines();
  insert(lines, after.last_line, copy_entry(lines, list, entry));
  const Field& name = *entry.find("behavior");
  const std::size_t line = after.last_line < entry.line
                               ? name.line + (entry.last_line - entry.line + 1)
                               : after.last_line + 1 + (name.line - entry.line);
  return Mutation{
      lines.text(),
      {at(lines, "duplicate-behavior", line, name.value.column, in_quotes(name.value.text))}};
}

Result behavior_named_as_another(const CatalogOutline& catalog, Random& random) {
  const Item& list = catalog.root().find("behaviors")->value;
  if (list.items.size() < 2) return std::nullopt;
  const std::size_t first = random.below(list.items.size() - 1);
  const std::size_t second = first + 1 + random.below(list.items.size() - first - 1);
  const Field& taken = *list.items[first].find("behavior");
  const Field& later = *list.items[second].find("behavior");
  const bool renames_first = random.percent(50);
  Lines lines = catalog.lines();
  set_value(lines, renames_first ? taken : later, (renames_first ? later : taken).value.text);
  return Mutation{lines.text(),
                  {at(lines, "duplicate-behavior", later.line, later.value.column,
                      in_quotes((renames_first ? later : taken).value.text))},
                  {"no-timeout-effect"}};  // it names the behavior
}

const Task* pick_listed(const CatalogOutline& catalog, Random& random) {
  return pick_if(catalog.tasks(), random, [](const Task& task) { return task.entry != nullptr; });
}

Result task_twice(const CatalogOutline& catalog, Random& random) {
  const Task* task = pick_listed(catalog, random);
  if (task == nullptr) return std::nullopt;
  const Item& list = catalog.root().find("tasks")->value;
  Lines lines = catalog.lines();
  insert(lines, list.last_line, copy_entry(lines, list, *task->entry));
  const Field& name = *task->entry->find("task");
  const std::size_t line = list.last_line + 1 + (name.line - task->entry->line);
  return Mutation{
      lines.text(),
      {at(lines, "duplicate-task", line, name.value.column,
          "task " + in_quotes(task->name) + " is listed twice, with the same attributes")},
      {"deprecated-key"}};
}

/// Of both entries the last counts.
Result task_twice_with_other_timeout(const CatalogOutline& catalog, Random& random) {
  const Task* task = pick_if(catalog.tasks(), random, [](const Task& each) {
    return each.entry != nullptr && !each.keeps_running && !each.reactive_start;
  });
  if (task == nullptr) return std::nullopt;
  const Item& list = catalog.root().find("tasks")->value;
  Lines lines = catalog.lines();
  std::vector<std::string> copy = copy_entry(lines, list, *task->entry);
  if (const Field* own = task->entry->find("timeout")) {
    copy[own->line - task->entry->line] = spaces(own->column) + "timeout: 77";
    if (own == task->entry->fields.data()) return std::nullopt;
  } else {
    copy.push_back(spaces(task->entry->column) + "timeout: 77");
  }
  insert(lines, list.last_line, copy);
  const Field& name = *task->entry->find("task");
  const std::size_t line = list.last_line + 1 + (name.line - task->entry->line);
  const std::string before = task->timeout.empty() ? "none" : task->timeout + " s";
  return Mutation{lines.text(),
                  {at(lines, "duplicate-task", line, name.value.column,
                      "the last entry counts: timeout 77 s, was " + before)},
                  {"deprecated-key"}};
}

Result parameter_twice(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return each.field->key == "parameters" && !each.field->value.items.empty();
  });
  if (placed == nullptr) return std::nullopt;
  const Item& list = placed->field->value;
  const Item& entry = random.pick(list.items);
  Lines lines = catalog.lines();
  insert(lines, list.last_line, copy_entry(lines, list, entry));
  const Field& name = *entry.find("parameter");
  return Mutation{lines.text(),
                  {at(lines, "duplicate-parameter", list.last_line + 1 + (name.line - entry.line),
                      name.value.column, in_quotes(name.value.text))}};
}

Result performed_twice(const CatalogOutline& catalog, Random& random) {
  const std::vector<PlacedField> fields = all_fields(catalog);
  const PlacedField* placed = pick_if(fields, random, [](const PlacedField& each) {
    return each.field->key == "tasks" && each.shape->name == "behavior";
  });
  if (placed == nullptr) return std::nullopt;
  const Item& list = placed->field->value;
  const Item& entry = random.pick(list.items);
  Lines lines = catalog.lines();
  insert(lines, list.last_line, copy_entry(lines, list, entry));
  const Field& name = *entry.find("task");
  return Mutation{lines.text(),
                  {at(lines, "invalid-value", list.last_line + 1 + (name.line - entry.line),
                      name.value.column, in_quotes(name.value.text))},
                  {"deprecated-key"}};
}

/// Adds a name to the end of a list of names. Returns its place.
Place add_name(Lines& lines, const Item& list, const std::string& name) {
  const Item& last = list.items.back();
  if (!list.flow) {
    lines.insert_after(last.line, spaces(list.column) + "- " + name);
    return {last.line + 1, list.column + 2, name};
  }
  const std::size_t end = last.column + last.text.size();
  lines.replace(last.line, end, 0, ", " + name);
  return {last.line, end + 2, name};
}

const Item* pick_list(const CatalogOutline& catalog, Random& random) {
  const Item* const* entry = pick_if(catalog.list_entries(), random, [](const Item* each) {
    return each->find("mutually_exclusive")->value.items.size() > 1;
  });
  return entry == nullptr ? nullptr : *entry;
}

Result excludes_itself(const CatalogOutline& catalog, Random& random) {
  const Item* entry = pick_list(catalog, random);
  if (entry == nullptr) return std::nullopt;
  const Item& list = entry->find("mutually_exclusive")->value;
  Lines lines = catalog.lines();
  const Place place = add_name(lines, list, random.pick(list.items).text);
  return Mutation{lines.text(),
                  {at(lines, "self-exclusion", place.line, place.column, in_quotes(place.name))}};
}

/// Appends a list of names to the exclusivity constraints. Returns its line and column.
Place add_list(Lines& lines, const CatalogOutline& catalog, const std::string& names) {
  const Field* section = catalog.root().find("exclusivity_constraints");
  std::size_t after = lines.count();
  std::size_t column = 0;
  if (section == nullptr) {
    lines.insert_after(after++, "exclusivity_constraints:");
  } else {
    after = section->last_line;
    column = section->value.column;
  }
  lines.insert_after(after, spaces(column) + "- mutually_exclusive: [" + names + "]");
  return {after + 1, column + 2, {}};
}

Result excludes_nothing(const CatalogOutline& catalog, Random& random) {
  Lines lines = catalog.lines();
  const bool is_empty = random.percent(30);
  const Place place = add_list(lines, catalog, is_empty ? "" : random.pick(catalog.tasks()).name);
  return Mutation{lines.text(),
                  {at(lines, "trivial-exclusion", place.line, place.column,
                      is_empty ? "no task" : "one task")}};
}

/// A new list of which all tasks are in another one.
Result excludes_again(const CatalogOutline& catalog, Random& random) {
  const Item* entry = pick_list(catalog, random);
  if (entry == nullptr) return std::nullopt;
  std::set<std::string> distinct;
  std::vector<std::string> names;
  for (const Item& item : entry->find("mutually_exclusive")->value.items) {
    if (distinct.insert(item.text).second) names.push_back(item.text);
  }
  random.shuffle(names);
  names.resize(
      static_cast<std::size_t>(random.between(2, static_cast<std::int64_t>(names.size()))));
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  Lines lines = catalog.lines();
  const Place place = add_list(lines, catalog, text);
  return Mutation{lines.text(), {at(lines, "duplicate-exclusion", place.line, place.column)}};
}

Result task_of_no_behavior(const CatalogOutline& catalog, Random& random) {
  const Field* section = catalog.root().find("tasks");
  if (section == nullptr) return std::nullopt;
  const Item& before = random.pick(section->value.items);
  Lines lines = catalog.lines();
  const std::size_t column = section->value.column;
  lines.insert_after(before.last_line, spaces(column) + "- task: UNHEARD_OF");
  return Mutation{
      lines.text(),
      {at(lines, "task-without-behavior", before.last_line + 1, column + 8, "'UNHEARD_OF'")}};
}

/// Adds a task whose name differs from that of another task in upper and lower case only.
Result task_in_other_case(const CatalogOutline& catalog, Random& random) {
  if (catalog.root().find("tasks") == nullptr) return std::nullopt;
  const Task* task = pick_listed(catalog, random);
  if (task == nullptr) return std::nullopt;
  std::string name = task->name;
  for (char& c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (is_letter) c = static_cast<char>(c ^ 0x20);
  }
  const bool is_known = std::any_of(catalog.tasks().begin(), catalog.tasks().end(),
                                    [&name](const Task& other) { return other.name == name; });
  if (is_known) return std::nullopt;
  Lines lines = catalog.lines();
  const std::size_t column = catalog.root().find("tasks")->value.column;
  const std::size_t line = task->entry->last_line + 1;
  lines.insert_after(line - 1, spaces(column) + "- task: " + name);
  return Mutation{lines.text(),
                  {at(lines, "task-without-behavior", line, column + 8, in_quotes(name)),
                   at(lines, "confusable-name", line, column + 8, in_quotes(name))}};
}

/// Where the entry of a behavior names a task that it performs.
const Field& task_named(const Item& entry, const std::string& task) {
  if (const Field* only = entry.find("task")) return *only;
  for (const Item& item : entry.find("tasks")->value.items) {
    const Field* name = item.find("task");
    if (name->value.text == task) return *name;
  }
  throw std::logic_error("the behavior does not perform " + task);
}

/// Takes the entry of a task away, so that only behaviors name it.
Result task_not_listed(const CatalogOutline& catalog, Random& random) {
  const Field* section = catalog.root().find("tasks");
  if (section == nullptr || section->value.items.size() < 2) return std::nullopt;
  const Task* task = pick_listed(catalog, random);
  const auto index = static_cast<std::size_t>(task - catalog.tasks().data());
  Lines lines = catalog.lines();
  lines.erase(task->entry->line, task->entry->last_line);
  const std::size_t removed = task->entry->last_line - task->entry->line + 1;
  for (const Behavior& behavior : catalog.behaviors()) {
    for (const Performance& performance : behavior.performs) {
      if (performance.task != index) continue;
      // The first behavior that performs it.
      const Field& name = task_named(*behavior.entry, task->name);
      const std::size_t line = name.line > task->entry->line ? name.line - removed : name.line;
      return Mutation{
          lines.text(),
          {at(lines, "implicit-task", line, name.value.column, in_quotes(task->name))},
          {"required-goal", "requires-on-request", "no-timeout-effect", "redundant-requirement"}};
    }
  }
  return std::nullopt;
}

/// A behavior of a task that is not listed, and that nothing else names.
Result performed_task_misspelt(const CatalogOutline& catalog, Random& random) {
  if (catalog.root().find("tasks") == nullptr) return std::nullopt;
  const Behavior* behavior = pick_if(catalog.behaviors(), random, [&](const Behavior& each) {
    return each.entry->find("task") != nullptr &&
           catalog.tasks()[each.performs.front().task].entry != nullptr;
  });
  if (behavior == nullptr) return std::nullopt;
  const Field& field = *behavior->entry->find("task");
  const std::string wrong = misspell(field.value.text, random);
  if (!is_clear_misspelling(wrong, field.value.text, task_names(catalog))) return std::nullopt;
  Lines lines = catalog.lines();
  set_value(lines, field, wrong);
  std::set<std::string_view> also = changes_of_meaning;
  also.insert({"task-without-behavior", "no-timeout-effect", "confusable-name"});
  return Mutation{lines.text(),
                  {at(lines, "implicit-task", field.line, field.value.column, in_quotes(wrong))},
                  also};
}

}  // namespace

std::vector<MistakeKind> name_mistakes() {
  return {{"requirement misspelt", requirement_misspelt},
          {"requirement dangles", requirement_dangles},
          {"exclusion misspelt", exclusion_misspelt},
          {"exclusion dangles", exclusion_dangles},
          {"behavior twice", behavior_twice},
          {"behavior named as another", behavior_named_as_another},
          {"task twice", task_twice},
          {"task twice with another timeout", task_twice_with_other_timeout},
          {"parameter twice", parameter_twice},
          {"performed twice", performed_twice},
          {"exclusion of itself", excludes_itself},
          {"exclusion of nothing", excludes_nothing},
          {"exclusion given again", excludes_again},
          {"task of no behavior", task_of_no_behavior},
          {"task in other case", task_in_other_case},
          {"task not listed", task_not_listed},
          {"performed task misspelt", performed_task_misspelt}};
}

}  // namespace cbc::mutation
