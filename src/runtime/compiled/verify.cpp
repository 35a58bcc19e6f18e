#include <algorithm>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/disjoint_sets.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/compiled/compiled_file.h"
#include "runtime/compiled/derive.h"

// A compiled file may hold anything. First all arrays are checked from which the others follow:
// that indexes are in range, and orders and values as the compiler makes them. Then the other
// arrays are derived, as the compiler does it, and compared.

namespace cbc {
namespace {

/// What is wrong, for people; or nothing.
using Fault = std::optional<std::string>;

// Sizes ------------------------------------------------------------------------------------------

/// Without a jump for each number, so that many are compared at once.
bool is_ascending(std::span<const std::uint32_t> numbers) {
  unsigned descents = 0;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    descents |= static_cast<unsigned>(numbers[i] < numbers[i - 1]);
  }
  return descents == 0;
}

Fault find_count_fault(std::string_view what, std::size_t found, std::uint64_t expected) {
  if (found == expected) return std::nullopt;
  return concat("'", what, "' has ", found, " entries, expected ", expected);
}

/// There should be `count` rows.
template <typename T>
Fault find_row_fault(std::string_view what, const Rows<T>& rows, std::size_t count) {
  const auto begin = rows.begin;
  if (begin.size() != count + 1) {
    return concat("'", what, "' has ", begin.size(), " begins of rows, expected ", count + 1);
  }
  if (begin.front() != 0) {
    return concat("the first row of '", what, "' begins at ", begin.front(), ", expected 0");
  }
  if (!is_ascending(begin)) return concat("a row of '", what, "' ends before it begins");
  if (begin.back() != rows.items.size()) {
    return concat("the last row of '", what, "' ends at ", begin.back(), ", expected ",
                  rows.items.size());
  }
  return std::nullopt;
}

/// Without limits nothing is said of them.
Fault find_rows_of_limits_fault(const CompiledCatalog& catalog) {
  if (!catalog.limits.empty()) {
    return find_row_fault("limited", catalog.limited, catalog.limits.size());
  }
  return find_count_fault("limited_begin", catalog.limited.begin.size(), 0);
}

/// That rows lie in their arrays, and that there are as many entries as there is something to say
/// of.
Fault find_size_fault(const CompiledCatalog& catalog) {
  const std::size_t tasks = catalog.tasks.size();
  const std::size_t behaviors = catalog.behaviors.size();
  const std::size_t named = tasks + behaviors + 1;
  if (catalog.texts.begin.size() < named + 1) {
    return concat("there are ", catalog.texts.begin.size(), " begins of texts, expected ",
                  named + 1, " for the names and the source");
  }
  for (const Fault& fault :
       {find_row_fault("texts", catalog.texts, catalog.texts.size()),
        find_row_fault("parameters", catalog.parameters, tasks),
        find_row_fault("values", catalog.values, tasks),
        find_row_fault("requirements", catalog.requirements, behaviors),
        find_row_fault("cliques", catalog.cliques, catalog.clique_lines.size()),
        find_rows_of_limits_fault(catalog),
        find_count_fault("task_rules", catalog.task_rules.size(),
                         catalog.task_rules.empty() ? 0 : tasks),
        find_count_fault("retries", catalog.retries.size(),
                         catalog.retries.empty() ? 0 : behaviors),
        find_count_fault("improve_lines", catalog.improve_lines.size(), catalog.task_rules.size()),
        find_count_fault("retry_lines", catalog.retry_lines.size(), catalog.retries.size()),
        find_count_fault("behavior_packages", catalog.behavior_packages.size(), behaviors),
        find_count_fault("tasks_by_name", catalog.tasks_by_name.size(), tasks),
        find_count_fault("behaviors_by_name", catalog.behaviors_by_name.size(), behaviors),
        find_count_fault("requirement_lines", catalog.requirement_lines.size(),
                         catalog.requirements.items.size())}) {
    if (fault) return fault;
  }
  return std::nullopt;
}

// Texts ------------------------------------------------------------------------------------------

bool is_ascii(std::span<const char> characters) {
  std::uint64_t bits = 0;
  std::size_t i = 0;
  for (; i + sizeof(bits) <= characters.size(); i += sizeof(bits)) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, characters.data() + i, sizeof(eight));
    bits |= eight;
  }
  for (; i < characters.size(); ++i) bits |= static_cast<unsigned char>(characters[i]);
  return (bits & 0x8080808080808080U) == 0;
}

/// The source is exempt: its name is what the operating system says.
Fault find_encoding_fault(const Rows<char>& texts, std::size_t source) {
  constexpr std::size_t block = 256;  // texts that are checked together, as most are ASCII
  for (std::size_t first = 0; first < texts.size(); first += block) {
    const std::size_t end = std::min(first + block, texts.size());
    if (is_ascii(texts.items.subspan(texts.begin[first], texts.begin[end] - texts.begin[first]))) {
      continue;
    }
    for (std::size_t text = first; text < end; ++text) {
      if (text != source && utf8::find_invalid(texts[text])) {
        return concat("text ", text, ", ", quote(texts[text]), ", is not UTF-8");
      }
    }
  }
  return std::nullopt;
}

/// No two names are equal, as they ascend.
Fault find_name_fault(std::string_view kind, const Texts& names,
                      std::span<const std::uint32_t> by_name) {
  for (std::size_t place = 0; place < names.size(); ++place) {
    if (names[place].empty()) return concat("the name of ", kind, " ", place, " is empty");
  }
  std::string_view before;
  for (const std::uint32_t place : by_name) {
    if (place >= names.size()) {
      return concat("'", kind, "s_by_name' has ", place, " of ", names.size());
    }
    const std::string_view name = names[place];
    if (before >= name) {
      return before == name
                 ? concat("two ", kind, "s have the name ", quote(name))
                 : concat("'", kind, "s_by_name' has ", quote(before), " before ", quote(name));
    }
    before = name;
  }
  return std::nullopt;
}

Fault find_text_id_fault(std::string_view what, std::span<const TextId> ids, std::size_t texts) {
  TextId highest = 0;
  for (const TextId id : ids) highest = std::max(highest, id);
  if (ids.empty() || highest < texts) return std::nullopt;
  return concat("'", what, "' has text ", highest, " of ", texts);
}

/// The allowed values stand in the order of the parameters, without gaps.
Fault find_parameter_fault(const CompiledCatalog& catalog) {
  std::uint64_t next = 0;
  for (std::size_t place = 0; place < catalog.parameters.items.size(); ++place) {
    const CompiledParameter& parameter = catalog.parameters.items[place];
    if (parameter.name >= catalog.texts.size()) {
      return concat("the name of parameter ", place, " is text ", parameter.name, " of ",
                    catalog.texts.size());
    }
    if (catalog.texts[parameter.name].empty()) {
      return concat("the name of parameter ", place, " is empty");
    }
    if (parameter.allowed_is_list > 1) {
      return concat("allowed_is_list of parameter ", place, " is ", parameter.allowed_is_list,
                    ", expected 0 or 1");
    }
    if (parameter.allowed_is_list == 0 && parameter.allowed_count > 1) {
      return concat("parameter ", place, " has ", parameter.allowed_count,
                    " types, expected at most one");
    }
    if (parameter.first_allowed != next) {
      return concat("the allowed values of parameter ", place, " begin at ",
                    parameter.first_allowed, ", expected ", next);
    }
    next += parameter.allowed_count;
  }
  return find_count_fault("allowed_values", catalog.allowed_values.size(), next);
}

Fault find_text_fault(const CompiledCatalog& catalog) {
  const std::size_t tasks = catalog.tasks.size();
  const std::size_t behaviors = catalog.behaviors.size();
  const std::size_t texts = catalog.texts.size();
  if (auto fault = find_encoding_fault(catalog.texts, tasks + behaviors)) return fault;
  if (auto fault = find_name_fault("task", Texts(catalog.texts, 0, tasks), catalog.tasks_by_name)) {
    return fault;
  }
  if (auto fault = find_name_fault("behavior", Texts(catalog.texts, tasks, behaviors),
                                   catalog.behaviors_by_name)) {
    return fault;
  }
  if (auto fault = find_text_id_fault("behavior_packages", catalog.behavior_packages, texts)) {
    return fault;
  }
  if (auto fault = find_text_id_fault("allowed_values", catalog.allowed_values, texts)) {
    return fault;
  }
  return find_parameter_fault(catalog);
}

// What else is not derived -----------------------------------------------------------------------

Fault find_timeout_fault(std::string_view kind, std::uint32_t id, Microseconds timeout) {
  if (timeout >= 0 && timeout <= longest_time) return std::nullopt;
  return concat(kind, " ", id, ": its timeout of ", timeout, " us is out of range");
}

Fault find_index_fault(std::string_view kind, std::uint32_t id, std::uint32_t index,
                       std::size_t count) {
  if (index < count) return std::nullopt;
  return concat(kind, " ", id, ": its place in the catalog is ", index, " of ", count);
}

Fault find_task_fault(const CompiledCatalog& catalog) {
  KnownCosts costs;
  for (TaskId id(0); id < catalog.tasks.size(); ++id) {
    const CompiledTask& task = catalog.tasks[id];
    if (auto fault = find_index_fault("task", id, task.catalog_index, catalog.tasks.size())) {
      return fault;
    }
    if (task.start_on_request > 1 || task.reactive_start > 1 || task.keep_running > 1) {
      return concat("task ", id, ": a flag is neither 0 nor 1");
    }
    if (task.start_on_request != 0 && task.reactive_start != 0) {
      return concat("task ", id, " has both reactive_start and start_on_request");
    }
    if (auto fault = find_timeout_fault("task", id, task.timeout)) return fault;
    if (task.minimum_performance > one_million) {
      return concat("task ", id, ": its minimum performance of ", task.minimum_performance,
                    " millionths is over 1");
    }
    if (task.minimum_cost != costs.of(task.minimum_performance)) {
      return concat("task ", id, ": the cost of its minimum performance is wrong");
    }
  }
  return std::nullopt;
}

/// Best suitability first, equal ones in the order of the behaviors.
Fault find_value_fault(const CompiledCatalog& catalog) {
  KnownCosts costs;
  for (TaskId task(0); task < catalog.tasks.size(); ++task) {
    const Value* before = nullptr;
    for (const Value& value : catalog.values[task]) {
      if (value.behavior >= catalog.behaviors.size()) {
        return concat("task ", task, " has a value with behavior ", value.behavior, " of ",
                      catalog.behaviors.size());
      }
      if (value.suitability > one_million) {
        return concat("task ", task, " has a value with a suitability of ", value.suitability,
                      " millionths, which is over 1");
      }
      if (value.cost != costs.of(value.suitability)) {
        return concat("task ", task, " has a value with a wrong cost");
      }
      if (before != nullptr &&
          (before->suitability < value.suitability ||
           (before->suitability == value.suitability && before->behavior >= value.behavior))) {
        return concat("the values of task ", task, " are not in rank order");
      }
      before = &value;
    }
  }
  return std::nullopt;
}

Fault find_behavior_fault(const CompiledCatalog& catalog) {
  KnownCosts costs;
  for (BehaviorId id(0); id < catalog.behaviors.size(); ++id) {
    const CompiledBehavior& behavior = catalog.behaviors[id];
    if (auto fault =
            find_index_fault("behavior", id, behavior.catalog_index, catalog.behaviors.size())) {
      return fault;
    }
    if (auto fault = find_timeout_fault("behavior", id, behavior.timeout)) return fault;
    TaskId next;
    for (const CompiledRequirement& requirement : catalog.requirements[id]) {
      if (requirement.task >= catalog.tasks.size()) {
        return concat("behavior ", id, " requires task ", requirement.task, " of ",
                      catalog.tasks.size());
      }
      if (requirement.task < next) {
        return concat("the tasks that behavior ", id, " requires do not ascend");
      }
      next = TaskId(requirement.task + 1);
      if (requirement.minimum_performance > one_million) {
        return concat("behavior ", id, " requires ", requirement.minimum_performance,
                      " millionths of task ", requirement.task, ", which is over 1");
      }
      if (requirement.minimum_cost != costs.of(requirement.minimum_performance)) {
        return concat("behavior ", id, ": the cost of what it requires of task ", requirement.task,
                      " is wrong");
      }
    }
  }
  return std::nullopt;
}

/// Of the tasks of a list.
Fault find_members_fault(const CompiledCatalog& catalog, std::string_view list,
                         std::uint32_t number, std::span<const TaskId> members) {
  if (members.size() < 2) {
    return concat(list, " ", number, " has ", members.size(), " tasks, expected at least 2");
  }
  if (std::adjacent_find(members.begin(), members.end(), std::greater_equal()) != members.end()) {
    return concat("the tasks of ", list, " ", number, " do not ascend");
  }
  if (members.back() >= catalog.tasks.size()) {
    return concat(list, " ", number, " has task ", members.back(), " of ", catalog.tasks.size());
  }
  return std::nullopt;
}

Fault find_limit_fault(const CompiledCatalog& catalog) {
  for (std::uint32_t number = 0; number < catalog.limits.size(); ++number) {
    const std::uint32_t most = catalog.limits[number].most;
    if (most < 2) return concat("limit ", number, " is ", most, ", expected 2 or more");
    if (auto fault = find_members_fault(catalog, "limit", number, catalog.limited[number])) {
      return fault;
    }
  }
  return std::nullopt;
}

Fault find_rules_fault(const CompiledCatalog& catalog) {
  const auto is_default = [](const TaskRules& rules) { return rules == TaskRules(); };
  const auto is_idle = [](Retry retry) { return retry == Retry::at_events; };
  if (!catalog.task_rules.empty() &&
      std::all_of(catalog.task_rules.begin(), catalog.task_rules.end(), is_default)) {
    return "the rules of tasks say nothing";
  }
  if (!catalog.retries.empty() &&
      std::all_of(catalog.retries.begin(), catalog.retries.end(), is_idle)) {
    return "the retries of behaviors say nothing";
  }
  for (TaskId id(0); id < catalog.task_rules.size(); ++id) {
    const TaskRules& rules = catalog.task_rules[id];
    if (rules.reactive_priority < 0 || rules.requestable > 1 || rules.resume > 1 ||
        rules.unused != 0 || rules.improve > Improve::when_started) {
      return concat("the rules of task ", id, " are out of range");
    }
    const CompiledTask& task = catalog.tasks[id];
    if (rules.requestable == 0 && task.start_on_request != 0) {
      return concat("task ", id, " starts only on request, which nobody can make");
    }
    if (rules.reactive_priority > 0 && task.reactive_start == 0) {
      return concat("task ", id, " has a reactive priority, but does not start reactively");
    }
    if (rules.resume != 0 && (rules.requestable == 0 || task.reactive_start != 0 ||
                              rules.improve == Improve::when_started)) {
      return concat("task ", id, " cannot resume");
    }
  }
  for (BehaviorId id(0); id < catalog.retries.size(); ++id) {
    if (catalog.retries[id] > Retry::after_repair) {
      return concat("behavior ", id, ": its retry is out of range");
    }
  }
  return std::nullopt;
}

Fault find_clique_fault(const CompiledCatalog& catalog) {
  std::span<const TaskId> before;
  for (std::uint32_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    const auto members = catalog.cliques[clique];
    if (auto fault = find_members_fault(catalog, "clique", clique, members)) return fault;
    if (!std::lexicographical_compare(before.begin(), before.end(), members.begin(),
                                      members.end())) {
      return concat("cliques ", clique - 1, " and ", clique, " are not in order");
    }
    before = members;
  }
  return std::nullopt;
}

// Situation variables ----------------------------------------------------------------------------

/// The values of one variable. Two values of a flag are "true" and "false".
Fault find_values_fault(const CompiledCatalog& catalog, std::uint32_t number) {
  const CompiledVariable& variable = catalog.variables[number];
  if (variable.value_count < 2) {
    return concat("variable ", number, " has ", variable.value_count,
                  " values, expected 2 or more");
  }
  if (variable.is_boolean > 1) return concat("variable ", number, ": a flag is neither 0 nor 1");
  std::vector<std::string_view> texts;
  for (std::uint32_t value = 0; value < variable.value_count; ++value) {
    texts.push_back(catalog.name_of_value({number, value}));
  }
  if (variable.is_boolean != 0 && texts != std::vector<std::string_view>{"true", "false"}) {
    return concat("variable ", number, " is a flag, but its values are not true and false");
  }
  std::sort(texts.begin(), texts.end());
  if (std::adjacent_find(texts.begin(), texts.end()) != texts.end()) {
    return concat("variable ", number, " has a value twice");
  }
  return std::nullopt;
}

Fault find_fitting_fault(const CompiledCatalog& catalog) {
  const FittingValue* before = nullptr;
  for (const FittingValue& fitting : catalog.fitting_values) {
    if (fitting.behavior >= catalog.behaviors.size() ||
        fitting.variable >= catalog.variables.size() ||
        fitting.value >= catalog.variables[fitting.variable].value_count) {
      return concat("behavior ", fitting.behavior, " fits value ", fitting.value, " of variable ",
                    fitting.variable, ", but there is no such behavior, variable or value");
    }
    if (before != nullptr && *before >= fitting) return "'fitting_values' do not ascend";
    before = &fitting;
  }
  return std::nullopt;
}

/// The values stand in the order of the variables, without gaps. A variable and a behavior have
/// different names, as events name both in the same place.
Fault find_variable_fault(const CompiledCatalog& catalog) {
  const std::size_t texts = catalog.texts.size();
  if (auto fault = find_text_id_fault("variable_values", catalog.variable_values, texts)) {
    return fault;
  }
  std::uint64_t next = 0;
  std::vector<std::string_view> names;
  for (std::uint32_t number = 0; number < catalog.variables.size(); ++number) {
    const CompiledVariable& variable = catalog.variables[number];
    if (variable.name >= texts || catalog.texts[variable.name].empty()) {
      return concat("variable ", number, " has no name");
    }
    names.push_back(catalog.texts[variable.name]);
    if (variable.first_value != next) {
      return concat("the values of variable ", number, " begin at ", variable.first_value,
                    ", expected ", next);
    }
    next += variable.value_count;
  }
  if (auto fault = find_count_fault("variable_values", catalog.variable_values.size(), next)) {
    return fault;
  }
  for (std::uint32_t number = 0; number < catalog.variables.size(); ++number) {
    if (auto fault = find_values_fault(catalog, number)) return fault;
  }
  const Texts behaviors(catalog.texts, catalog.tasks.size(), catalog.behaviors.size());
  std::sort(names.begin(), names.end());
  for (std::size_t place = 0; place < names.size(); ++place) {
    const auto found = std::lower_bound(
        catalog.behaviors_by_name.begin(), catalog.behaviors_by_name.end(), names[place],
        [&](std::uint32_t index, std::string_view name) { return behaviors[index] < name; });
    const bool is_behavior =
        found != catalog.behaviors_by_name.end() && behaviors[*found] == names[place];
    if (is_behavior || (place > 0 && names[place - 1] == names[place])) {
      return concat("the name ", quote(names[place]), " of a variable is not unique");
    }
  }
  return find_fitting_fault(catalog);
}

// What is derived --------------------------------------------------------------------------------

template <typename T>
Fault find_difference(std::string_view what, std::span<const T> found,
                      const std::vector<T>& expected) {
  static_assert(std::has_unique_object_representations_v<T>);
  if (auto fault = find_count_fault(what, found.size(), expected.size())) return fault;
  if (found.empty() || std::memcmp(found.data(), expected.data(), found.size_bytes()) == 0) {
    return std::nullopt;
  }
  std::size_t place = 0;
  while (std::memcmp(&found[place], &expected[place], sizeof(T)) == 0) ++place;
  return concat("entry ", place, " of '", what, "' does not follow from the other arrays");
}

template <typename T>
Fault find_difference(const std::string& what, const Rows<T>& found,
                      const GrowingRows<T>& expected) {
  if (auto fault = find_difference<std::uint32_t>(what + "_begin", found.begin, expected.begin)) {
    return fault;
  }
  return find_difference(what, found.items, expected.items);
}

/// Tasks are connected by the behaviors that perform or require them, and by lists.
Fault find_group_fault(const CompiledCatalog& catalog, GrowingCatalog& derived) {
  DisjointSets connected(catalog.tasks.size());
  const auto index_of = [&](TaskId task) { return catalog.tasks[task].catalog_index; };
  std::vector<std::uint32_t> task_of(catalog.behaviors.size(), none);  // by behavior id
  for (TaskId task(0); task < catalog.tasks.size(); ++task) {
    for (const Value& value : catalog.values[task]) {
      std::uint32_t& first = task_of[value.behavior];
      if (first == none) first = index_of(task);
      connected.join(first, index_of(task));
    }
  }
  std::vector<std::uint32_t> tasks_of_behaviors(catalog.behaviors.size());
  for (BehaviorId id(0); id < catalog.behaviors.size(); ++id) {
    if (task_of[id] == none) return concat("behavior ", id, " performs no task");
    tasks_of_behaviors[catalog.behaviors[id].catalog_index] = task_of[id];
    for (const CompiledRequirement& requirement : catalog.requirements[id]) {
      connected.join(task_of[id], index_of(requirement.task));
    }
  }
  for (std::uint32_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    const auto members = catalog.cliques[clique];
    for (const TaskId task : members) connected.join(index_of(members.front()), index_of(task));
  }
  for (std::uint32_t limit = 0; limit < catalog.limits.size(); ++limit) {
    const auto members = catalog.limited[limit];
    for (const TaskId task : members) connected.join(index_of(members.front()), index_of(task));
  }
  derive_groups(derived, connected, tasks_of_behaviors);
  for (const Fault& fault :
       {find_difference("task_ids", catalog.task_ids, derived.task_ids),
        find_difference("behavior_ids", catalog.behavior_ids, derived.behavior_ids),
        find_difference("group_tasks", catalog.group_tasks, derived.group_tasks),
        find_difference("group_behaviors", catalog.group_behaviors, derived.group_behaviors)}) {
    if (fault) return fault;
  }
  return std::nullopt;
}

Fault find_derived_fault(const CompiledCatalog& catalog) {
  GrowingCatalog derived;
  if (auto fault = find_group_fault(catalog, derived)) return fault;
  derived.tasks.assign(catalog.tasks.begin(), catalog.tasks.end());
  derived.behaviors.assign(catalog.behaviors.begin(), catalog.behaviors.end());
  if (auto fault = derive_rest(catalog, derived)) return fault;
  for (BehaviorId id(0); id < catalog.behaviors.size(); ++id) {
    const auto values = derived.performs[id];
    for (std::size_t i = 1; i < values.size(); ++i) {
      const TaskId task = derived.value_tasks[values[i]];
      if (derived.value_tasks[values[i - 1]] != task) continue;
      return concat("behavior ", id, " performs task ", task, " twice");
    }
  }
  for (const Fault& fault :
       {find_difference("tasks", catalog.tasks, derived.tasks),
        find_difference("behaviors", catalog.behaviors, derived.behaviors),
        find_difference("value_tasks", catalog.value_tasks, derived.value_tasks),
        find_difference("words", catalog.words, derived.words),
        find_difference("performs", catalog.performs, derived.performs),
        find_difference("arcs", catalog.arcs, derived.arcs),
        find_difference("masks", catalog.masks, derived.masks),
        find_difference("incoming", catalog.incoming, derived.incoming),
        find_difference("topological_order", catalog.topological_order, derived.topological_order),
        find_difference("task_cliques", catalog.task_cliques, derived.task_cliques),
        find_difference("task_limits", catalog.task_limits, derived.task_limits)}) {
    if (fault) return fault;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> find_fault(const CompiledCatalog& catalog) {
  for (const auto find_fault_of_part :
       {find_size_fault, find_text_fault, find_task_fault, find_value_fault, find_behavior_fault,
        find_clique_fault, find_limit_fault, find_rules_fault, find_variable_fault,
        find_derived_fault}) {
    if (auto fault = find_fault_of_part(catalog)) return fault;
  }
  return std::nullopt;
}

}  // namespace cbc
