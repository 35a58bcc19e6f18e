#include <algorithm>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "base/disjoint_sets.h"
#include "base/text.h"
#include "compiled/compiled_catalog.h"
#include "compiled/compiled_file.h"

/// The parts of find_fault(), in their order: each takes for granted what those before it ensure.
namespace cbc::verify {

/// What is wrong, for people; or nothing.
using Fault = std::optional<std::string>;

/// That all arrays fit each other and that rows lie in their arrays.
[[nodiscard]] Fault find_size_fault(const CompiledCatalog& catalog);

/// Texts, names and their order, packages, parameters.
[[nodiscard]] Fault find_text_fault(const CompiledCatalog& catalog);

/// Groups and the order of all that is in them, and what tasks and behaviors say of themselves but
/// for levels and has_performance_rules.
[[nodiscard]] Fault find_group_fault(const CompiledCatalog& catalog);

/// Values, domain words, `performs`.
[[nodiscard]] Fault find_value_fault(const CompiledCatalog& catalog);

/// Requirements and the levels of behaviors.
[[nodiscard]] Fault find_requirement_fault(const CompiledCatalog& catalog);

/// Arcs, masks, has_performance_rules, the levels and the order of tasks.
[[nodiscard]] Fault find_graph_fault(const CompiledCatalog& catalog);

/// Cliques, `task_cliques`.
[[nodiscard]] Fault find_clique_fault(const CompiledCatalog& catalog);

/// That each group is connected: a suitability of 0 in what should be another group would decide.
[[nodiscard]] Fault find_connection_fault(const CompiledCatalog& catalog);

namespace {

/// Without a jump for each number, so that many are compared at once.
bool is_ascending(std::span<const std::uint32_t> numbers) {
  unsigned descents = 0;
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    descents |= static_cast<unsigned>(numbers[i] < numbers[i - 1]);
  }
  return descents == 0;
}

/// `rows` of them in an array of `items`.
Fault find_row_fault(std::string_view what, std::span<const std::uint32_t> begin, std::size_t rows,
                     std::size_t items) {
  if (begin.size() != rows + 1) {
    return concat("'", what, "' has ", begin.size(), " begins of rows, expected ", rows + 1);
  }
  if (begin.front() != 0) {
    return concat("the first row of '", what, "' begins at ", begin.front(), ", expected 0");
  }
  if (!is_ascending(begin)) return concat("a row of '", what, "' ends before it begins");
  if (begin.back() != items) {
    return concat("the last row of '", what, "' ends at ", begin.back(), ", expected ", items);
  }
  return std::nullopt;
}

}  // namespace

Fault find_size_fault(const CompiledCatalog& catalog) {
  const std::size_t tasks = catalog.tasks.size();
  const std::size_t behaviors = catalog.behaviors.size();
  const std::size_t cliques = catalog.clique_lines.size();
  const Rows<char>& texts = catalog.texts.rows();

  struct Count {
    std::string_view what;
    std::size_t count;
  };
  // 32 bits count all that has a place; `none` is no place.
  const Count counts[] = {
      {"tasks", tasks},
      {"behaviors", behaviors},
      {"texts", texts.begin.size()},
      {"characters of texts", texts.items.size()},
      {"parameters", catalog.parameters.items.size()},
      {"allowed_values", catalog.allowed_values.size()},
      {"values", catalog.values.items.size()},
      {"arcs", catalog.arcs.items.size()},
      {"requirements", catalog.requirements.items.size()},
      {"cliques", cliques},
      {"tasks of cliques", catalog.cliques.items.size()},
      {"masks", catalog.masks.size()},
  };
  for (const auto& [what, count] : counts) {
    if (count >= none) return concat("there are ", count, " ", what, ", expected less than ", none);
  }

  struct Size {
    std::string_view what;
    std::size_t found;
    std::size_t expected;
  };
  const Size sizes[] = {
      {"task_ids", catalog.task_ids.size(), tasks},
      {"behavior_ids", catalog.behavior_ids.size(), behaviors},
      {"behavior_packages", catalog.behavior_packages.size(), behaviors},
      {"tasks_by_name", catalog.tasks_by_name.size(), tasks},
      {"behaviors_by_name", catalog.behaviors_by_name.size(), behaviors},
      {"topological_order", catalog.topological_order.size(), tasks},
      {"value_tasks", catalog.value_tasks.size(), catalog.values.items.size()},
      {"words", catalog.words.size(), tasks + 1},
      {"requirement_lines", catalog.requirement_lines.size(), catalog.requirements.items.size()},
      {"group_behaviors", catalog.group_behaviors.size(), catalog.group_tasks.size()},
  };
  for (const auto& [what, found, expected] : sizes) {
    if (found != expected) {
      return concat("'", what, "' has ", found, " entries, expected ", expected);
    }
  }
  if (texts.begin.size() < tasks + behaviors + 1) {
    return concat("there are ", texts.begin.size(), " begins of texts, expected ",
                  tasks + behaviors + 1, " for the names");
  }
  if (catalog.group_tasks.empty()) return "'group_tasks' is empty";

  struct RowArray {
    std::string_view what;
    std::span<const std::uint32_t> begin;
    std::size_t rows;
    std::size_t items;
  };
  const std::size_t groups = catalog.group_count();
  const RowArray arrays[] = {
      {"texts", texts.begin, texts.begin.size() - 1, texts.items.size()},
      {"group_tasks", catalog.group_tasks, groups, tasks},
      {"group_behaviors", catalog.group_behaviors, groups, behaviors},
      {"parameters", catalog.parameters.begin, tasks, catalog.parameters.items.size()},
      {"values", catalog.values.begin, tasks, catalog.values.items.size()},
      {"arcs", catalog.arcs.begin, tasks, catalog.arcs.items.size()},
      {"incoming", catalog.incoming.begin, tasks, catalog.incoming.items.size()},
      {"task_cliques", catalog.task_cliques.begin, tasks, catalog.task_cliques.items.size()},
      {"requirements", catalog.requirements.begin, behaviors, catalog.requirements.items.size()},
      {"performs", catalog.performs.begin, behaviors, catalog.performs.items.size()},
      {"cliques", catalog.cliques.begin, cliques, catalog.cliques.items.size()},
      // What is an inverse of another array has as many items.
      {"performs", catalog.performs.begin, behaviors, catalog.values.items.size()},
      {"incoming", catalog.incoming.begin, tasks, catalog.arcs.items.size()},
      {"task_cliques", catalog.task_cliques.begin, tasks, catalog.cliques.items.size()},
  };
  for (const auto& [what, begin, rows, items] : arrays) {
    if (auto fault = find_row_fault(what, begin, rows, items)) return fault;
  }
  return std::nullopt;
}

namespace {

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
Fault find_encoding_fault(const CompiledCatalog& catalog) {
  constexpr std::size_t block = 256;  // texts that are looked at at once, as most are ASCII
  const Rows<char>& texts = catalog.texts.rows();
  for (std::size_t first = 0; first < texts.size(); first += block) {
    const std::size_t end = std::min(first + block, texts.size());
    if (is_ascii(
            {texts.items.data() + texts.begin[first], texts.items.data() + texts.begin[end]})) {
      continue;
    }
    for (std::size_t text = first; text < end; ++text) {
      const std::string_view characters = catalog.texts[text];
      const bool is_file =
          characters.data() == catalog.file.data() && characters.size() == catalog.file.size();
      if (!is_file && utf8::find_invalid(characters)) {
        return concat("text ", text, ", ", quote(characters), ", is not UTF-8");
      }
    }
  }
  return std::nullopt;
}

bool is_same(const Rows<char>& a, const Rows<char>& b) {
  return a.items.data() == b.items.data() && a.items.size() == b.items.size() &&
         std::equal(a.begin.begin(), a.begin.end(), b.begin.begin(), b.begin.end());
}

/// `names` are those of the texts from `first` on, one for each of `by_name`. No two are equal, as
/// they ascend.
Fault find_name_fault(std::string_view kind, const CompiledCatalog& catalog, const Texts& names,
                      std::size_t first, std::span<const std::uint32_t> by_name) {
  const std::size_t count = by_name.size();
  if (!is_same(names.rows(), catalog.texts.part(first, count).rows())) {
    return concat("the names of the ", kind, "s are not texts ", first, " to ", first + count);
  }
  for (std::size_t place = 0; place < count; ++place) {
    if (names[place].empty()) return concat("the name of ", kind, " ", place, " is empty");
  }
  std::string_view before;
  for (const std::uint32_t place : by_name) {
    if (place >= count) return concat("'", kind, "s_by_name' has ", place, " of ", count);
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
  if (next == catalog.allowed_values.size()) return std::nullopt;
  return concat("'allowed_values' has ", catalog.allowed_values.size(), " entries, expected ",
                next);
}

}  // namespace

Fault find_text_fault(const CompiledCatalog& catalog) {
  const std::size_t tasks = catalog.tasks.size();
  const std::size_t texts = catalog.texts.size();
  if (auto fault = find_encoding_fault(catalog)) return fault;
  if (auto fault = find_name_fault("task", catalog, catalog.task_names, 0, catalog.tasks_by_name)) {
    return fault;
  }
  if (auto fault = find_name_fault("behavior", catalog, catalog.behavior_names, tasks,
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

namespace {

/// `ids` gives the place of each entry by its place in the catalog, `entries` the inverse; `begin`
/// those of the groups. Within a group the catalog order is kept.
template <typename Entry>
Fault find_order_fault(std::string_view kind, std::span<const Entry> entries,
                       std::span<const std::uint32_t> ids, std::span<const std::uint32_t> begin) {
  for (std::size_t group = 0; group + 1 < begin.size(); ++group) {
    for (std::uint32_t id = begin[group]; id < begin[group + 1]; ++id) {
      const std::uint32_t index = entries[id].catalog_index;
      if (index >= ids.size()) {
        return concat(kind, " ", id, ": its place in the catalog is ", index, " of ", ids.size());
      }
      if (ids[index] != id) {
        return concat(kind, " ", id, ": place ", index, " of the catalog is that of ", kind, " ",
                      ids[index]);
      }
      if (id > begin[group] && index < entries[id - 1].catalog_index) {
        return concat(kind, "s ", id - 1, " and ", id, " are not in catalog order");
      }
    }
  }
  return std::nullopt;
}

bool is_timeout(Microseconds timeout) { return timeout >= 0 && timeout <= longest_time; }

Fault find_attribute_fault(const CompiledTask& task, TaskId id) {
  const auto is_flag = [](std::uint8_t flag) { return flag <= 1; };
  if (!is_flag(task.start_on_request) || !is_flag(task.reactive_start) ||
      !is_flag(task.keep_running) || !is_flag(task.has_performance_rules)) {
    return concat("task ", id, ": a flag is neither 0 nor 1");
  }
  if (task.start_on_request != 0 && task.reactive_start != 0) {
    return concat("task ", id, " has both reactive_start and start_on_request");
  }
  if (!is_timeout(task.timeout)) {
    return concat("task ", id, ": its timeout of ", task.timeout, " us is out of range");
  }
  if (task.minimum_performance > one_million) {
    return concat("task ", id, ": its minimum performance of ", task.minimum_performance,
                  " millionths is over 1");
  }
  return std::nullopt;
}

Fault find_task_fault(const CompiledCatalog& catalog) {
  KnownCosts costs;
  for (std::size_t group = 0; group < catalog.group_count(); ++group) {
    const TaskId first = catalog.group_tasks[group];
    if (first == catalog.group_tasks[group + 1]) return concat("group ", group, " has no task");
    if (group > 0 && catalog.tasks[first].catalog_index <
                         catalog.tasks[catalog.group_tasks[group - 1]].catalog_index) {
      return concat("groups ", group - 1, " and ", group,
                    " are not in the order of their first tasks");
    }
    for (TaskId id = first; id < catalog.group_tasks[group + 1]; ++id) {
      const CompiledTask& task = catalog.tasks[id];
      if (task.group != group) {
        return concat("task ", id, ": its group is ", task.group, ", expected ", group);
      }
      if (auto fault = find_attribute_fault(task, id)) return fault;
      if (task.minimum_cost != costs.of(task.minimum_performance)) {
        return concat("task ", id, ": the cost of its minimum performance is wrong");
      }
    }
  }
  return std::nullopt;
}

}  // namespace

Fault find_group_fault(const CompiledCatalog& catalog) {
  if (auto fault = find_order_fault("task", catalog.tasks, catalog.task_ids, catalog.group_tasks)) {
    return fault;
  }
  if (auto fault = find_order_fault("behavior", catalog.behaviors, catalog.behavior_ids,
                                    catalog.group_behaviors)) {
    return fault;
  }
  if (auto fault = find_task_fault(catalog)) return fault;
  for (BehaviorId id = 0; id < catalog.behaviors.size(); ++id) {
    if (is_timeout(catalog.behaviors[id].timeout)) continue;
    return concat("behavior ", id, ": its timeout of ", catalog.behaviors[id].timeout,
                  " us is out of range");
  }
  return std::nullopt;
}

namespace {

/// In rank order, and in the arrays of the group.
Fault find_value_fault(const CompiledCatalog& catalog, TaskId task, ValueId id, KnownCosts& costs) {
  const Value& value = catalog.values.items[id];
  const std::uint32_t group = catalog.tasks[task].group;
  if (value.behavior < catalog.group_behaviors[group] ||
      value.behavior >= catalog.group_behaviors[group + 1]) {
    return concat("value ", id, " of task ", task, ": its behavior ", value.behavior,
                  " is none of group ", group);
  }
  if (value.suitability > one_million) {
    return concat("value ", id, " of task ", task, ": its suitability of ", value.suitability,
                  " millionths is over 1");
  }
  if (value.cost != costs.of(value.suitability)) {
    return concat("value ", id, " of task ", task, ": the cost of its suitability is wrong");
  }
  if (catalog.value_tasks[id] != task) {
    return concat("value ", id, " of task ", task, ": 'value_tasks' says task ",
                  catalog.value_tasks[id]);
  }
  if (id == catalog.values.begin[task]) return std::nullopt;
  const Value& before = catalog.values.items[id - 1];
  if (before.suitability < value.suitability ||
      (before.suitability == value.suitability && before.behavior >= value.behavior)) {
    return concat("the values of task ", task, " are not in rank order");
  }
  return std::nullopt;
}

/// There are as many places in `performs` as values, so each value has one if none has two.
Fault find_performs_fault(const CompiledCatalog& catalog) {
  for (BehaviorId behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    const auto row = catalog.performs[behavior];
    if (row.empty()) return concat("behavior ", behavior, " performs no task");
    for (std::size_t i = 0; i < row.size(); ++i) {
      const ValueId value = row[i];
      if (value >= catalog.values.items.size()) {
        return concat("behavior ", behavior, " performs value ", value, " of ",
                      catalog.values.items.size());
      }
      if (catalog.values.items[value].behavior != behavior) {
        return concat("behavior ", behavior, " performs value ", value, ", which is of behavior ",
                      catalog.values.items[value].behavior);
      }
      if (i > 0 && catalog.value_tasks[row[i - 1]] >= catalog.value_tasks[value]) {
        return concat("the tasks that behavior ", behavior, " performs do not ascend");
      }
    }
  }
  return std::nullopt;
}

Fault find_requirement_fault(const CompiledCatalog& catalog, std::uint32_t group, BehaviorId id,
                             KnownCosts& costs) {
  std::uint64_t level = 0;  // one more than a level may not fit in 32 bits
  TaskId next = catalog.group_tasks[group];
  for (const CompiledRequirement& requirement : catalog.requirements[id]) {
    const TaskId task = requirement.task;
    if (task < catalog.group_tasks[group] || task >= catalog.group_tasks[group + 1]) {
      return concat("behavior ", id, " requires task ", task, ", which is none of its group ",
                    group);
    }
    if (task < next) return concat("the tasks that behavior ", id, " requires do not ascend");
    next = task + 1;
    if (requirement.minimum_performance > one_million) {
      return concat("behavior ", id, " requires ", requirement.minimum_performance,
                    " millionths of task ", task, ", which is over 1");
    }
    if (requirement.minimum_cost != costs.of(requirement.minimum_performance)) {
      return concat("behavior ", id, ": the cost of what it requires of task ", task, " is wrong");
    }
    level = std::max(level, std::uint64_t{catalog.tasks[task].level} + 1);
  }
  if (catalog.behaviors[id].level == level) return std::nullopt;
  return concat("behavior ", id, ": its level is ", catalog.behaviors[id].level, ", expected ",
                level);
}

}  // namespace

Fault find_value_fault(const CompiledCatalog& catalog) {
  KnownCosts costs;
  std::uint64_t words = 0;
  for (TaskId task = 0; task < catalog.tasks.size(); ++task) {
    if (catalog.words[task] != words) {
      return concat("task ", task, ": its first domain word is ", catalog.words[task],
                    ", expected ", words);
    }
    const std::uint32_t end = catalog.values.begin[task + 1];
    for (ValueId id = catalog.values.begin[task]; id < end; ++id) {
      if (auto fault = find_value_fault(catalog, task, id, costs)) return fault;
    }
    words += (catalog.values[task].size() + 63) / 64;
  }
  if (catalog.words.back() != words) {
    return concat("there are ", catalog.words.back(), " domain words, expected ", words);
  }
  return find_performs_fault(catalog);
}

/// That levels of tasks are the highest of their behaviors is find_graph_fault's. Both together
/// make levels fall along every requirement, so there is no cycle, and only these levels will do.
Fault find_requirement_fault(const CompiledCatalog& catalog) {
  KnownCosts costs;
  for (std::uint32_t group = 0; group < catalog.group_count(); ++group) {
    const BehaviorId end = catalog.group_behaviors[group + 1];
    for (BehaviorId id = catalog.group_behaviors[group]; id < end; ++id) {
      if (auto fault = find_requirement_fault(catalog, group, id, costs)) return fault;
    }
  }
  return std::nullopt;
}

namespace {

Fault find_member_fault(const CompiledCatalog& catalog, std::uint32_t clique) {
  const auto members = catalog.cliques[clique];
  if (members.size() < 2) {
    return concat("clique ", clique, " has ", members.size(), " tasks, expected at least 2");
  }
  if (members.front() >= catalog.tasks.size()) {
    return concat("clique ", clique, " has task ", members.front(), " of ", catalog.tasks.size());
  }
  for (std::size_t i = 1; i < members.size(); ++i) {
    if (members[i] <= members[i - 1]) {
      return concat("the tasks of clique ", clique, " do not ascend");
    }
  }
  const std::uint32_t group = catalog.tasks[members.front()].group;
  if (members.back() >= catalog.group_tasks[group + 1]) {
    return concat("clique ", clique, " has task ", members.back(), ", which is none of its group ",
                  group);
  }
  return std::nullopt;
}

}  // namespace

Fault find_clique_fault(const CompiledCatalog& catalog) {
  // By task: the first of its places in task_cliques that no clique has come to yet. There are as
  // many places as tasks in cliques.
  std::vector<std::uint32_t> next(catalog.task_cliques.begin.begin(),
                                  catalog.task_cliques.begin.end());
  for (std::uint32_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    if (auto fault = find_member_fault(catalog, clique)) return fault;
    const auto members = catalog.cliques[clique];
    if (clique > 0) {
      const auto before = catalog.cliques[clique - 1];
      if (!std::lexicographical_compare(before.begin(), before.end(), members.begin(),
                                        members.end())) {
        return concat("cliques ", clique - 1, " and ", clique, " are not in order");
      }
    }
    for (const TaskId task : members) {
      if (next[task] == catalog.task_cliques.begin[task + 1] ||
          catalog.task_cliques.items[next[task]] != clique) {
        return concat("'task_cliques' of task ", task, " is not what the cliques say");
      }
      ++next[task];
    }
  }
  return std::nullopt;
}

Fault find_connection_fault(const CompiledCatalog& catalog) {
  DisjointSets sets(catalog.tasks.size());
  for (const Arc& arc : catalog.arcs.items) sets.join(arc.source, arc.target);
  for (std::uint32_t clique = 0; clique < catalog.cliques.size(); ++clique) {
    const auto members = catalog.cliques[clique];
    for (const TaskId task : members) sets.join(members.front(), task);
  }
  for (BehaviorId behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    const auto values = catalog.performs[behavior];
    if (values.size() == 1) continue;
    for (const ValueId value : values) {
      sets.join(catalog.task_of(values.front()), catalog.task_of(value));
    }
  }
  // Components are counted by their first task, and so are groups.
  const std::vector<std::uint32_t> components = sets.numbers();
  for (TaskId task = 0; task < catalog.tasks.size(); ++task) {
    if (components[task] == catalog.tasks[task].group) continue;
    return concat("task ", task, " is not connected with the first task of its group ",
                  catalog.tasks[task].group);
  }
  return std::nullopt;
}

namespace {

/// What the tasks have from the requirements of their values: built for one task after the other,
/// and compared.
class Arcs {
 public:
  explicit Arcs(const CompiledCatalog& catalog)
      : catalog_(catalog), arc_to_(most_in_a_group(catalog.group_tasks), 0) {}

  /// To be called for each task in turn. The work is at most that of reading each bit of its masks.
  Fault find_fault(TaskId id) {
    const CompiledTask& task = catalog_.tasks[id];
    const std::size_t words = catalog_.words[id + 1] - catalog_.words[id];
    const std::size_t arcs = catalog_.arcs[id].size();
    if (arcs * words > catalog_.masks.size() - first_mask_) {
      return concat("task ", id, " has ", arcs, " arcs, more than there are masks for");
    }
    masks_.assign(arcs * words, 0);
    const Summary summary = build(id, words);
    if (!summary.has_these_arcs) {
      return concat("the arcs of task ", id, " are not those of its values");
    }
    if (!std::equal(masks_.begin(), masks_.end(), catalog_.masks.subspan(first_mask_).begin())) {
      return concat("the masks of task ", id, " are not those of its values");
    }
    first_mask_ += masks_.size();
    if (task.level != summary.level) {
      return concat("task ", id, ": its level is ", task.level, ", expected ", summary.level);
    }
    if (task.has_performance_rules != summary.has_performance_rules) {
      return concat("task ", id, ": has_performance_rules is ", task.has_performance_rules,
                    ", expected ", summary.has_performance_rules);
    }
    return std::nullopt;
  }

  [[nodiscard]] std::size_t mask_count() const { return first_mask_; }

 private:
  struct Summary {
    bool has_these_arcs = false;  ///< if not, nothing else counts
    std::uint32_t level = 0;
    std::uint8_t has_performance_rules = 0;
  };

  /// Builds the masks of a task.
  Summary build(TaskId id, std::size_t words) {
    const CompiledTask& task = catalog_.tasks[id];
    const std::span<std::uint32_t> arc_to(arc_to_);
    const std::span<std::uint64_t> masks(masks_);
    const std::size_t first_mask = first_mask_;
    const TaskId first_task = catalog_.group_tasks[task.group];
    const std::uint32_t first = catalog_.arcs.begin[id];
    const std::uint32_t end = catalog_.arcs.begin[id + 1];
    std::uint32_t next = first;
    Summary summary;
    bool has_rules = task.minimum_performance > 0;
    const auto values = catalog_.values[id];
    for (std::size_t place = 0; place < values.size(); ++place) {
      const BehaviorId behavior = values[place].behavior;
      summary.level = std::max(summary.level, catalog_.behaviors[behavior].level);
      for (const CompiledRequirement& requirement : catalog_.requirements[behavior]) {
        has_rules |= requirement.minimum_performance > 0;
        std::uint32_t& arc_end = arc_to[requirement.task - first_task];
        if (arc_end <= first) {
          if (next == end) return {};
          const Arc& arc = catalog_.arcs.items[next];
          if (arc.source != id || arc.target != requirement.task ||
              arc.mask != first_mask + (next - first) * words) {
            return {};
          }
          arc_end = ++next;
        }
        masks[(arc_end - 1 - first) * words + place / 64] |= std::uint64_t{1} << (place % 64);
      }
    }
    summary.has_these_arcs = next == end;
    summary.has_performance_rules = has_rules ? 1 : 0;
    return summary;
  }

  const CompiledCatalog& catalog_;
  std::vector<std::uint32_t> arc_to_;  ///< by task of the group: 1 + the last arc to it, or 0
  std::vector<std::uint64_t> masks_;   ///< of one task
  std::size_t first_mask_ = 0;         ///< of the next task
};

/// There are as many places in `incoming` as arcs, so each arc has one if none has two.
Fault find_incoming_fault(const CompiledCatalog& catalog) {
  for (TaskId task = 0; task < catalog.tasks.size(); ++task) {
    std::uint32_t next = 0;
    for (const std::uint32_t arc : catalog.incoming[task]) {
      if (arc >= catalog.arcs.items.size() || catalog.arcs.items[arc].target != task) {
        return concat("'incoming' has arc ", arc, " at task ", task, ", where it does not end");
      }
      if (arc < next) return concat("the incoming arcs of task ", task, " do not ascend");
      next = arc + 1;
    }
  }
  return std::nullopt;
}

/// The tasks of a group are there, each once, as they ascend and are as many as the group has.
Fault find_order_fault(const CompiledCatalog& catalog) {
  for (std::size_t group = 0; group < catalog.group_count(); ++group) {
    const TaskId first = catalog.group_tasks[group];
    const TaskId end = catalog.group_tasks[group + 1];
    for (std::uint32_t place = first; place < end; ++place) {
      const TaskId task = catalog.topological_order[place];
      if (task < first || task >= end) {
        return concat("'topological_order' has task ", task, " among those of group ", group);
      }
      if (place == first) continue;
      const TaskId before = catalog.topological_order[place - 1];
      const std::uint32_t level = catalog.tasks[task].level;
      const std::uint32_t level_before = catalog.tasks[before].level;
      if (level < level_before || (level == level_before && task <= before)) {
        return concat("'topological_order' has task ", task, " after task ", before);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

Fault find_graph_fault(const CompiledCatalog& catalog) {
  Arcs arcs(catalog);
  for (TaskId task = 0; task < catalog.tasks.size(); ++task) {
    if (auto fault = arcs.find_fault(task)) return fault;
  }
  if (arcs.mask_count() != catalog.masks.size()) {
    return concat("there are ", catalog.masks.size(), " masks, expected ", arcs.mask_count());
  }
  if (auto fault = find_incoming_fault(catalog)) return fault;
  return find_order_fault(catalog);
}

}  // namespace cbc::verify

namespace cbc {

std::optional<std::string> find_fault(const CompiledCatalog& catalog) {
  for (const auto find_fault_of_part :
       {verify::find_size_fault, verify::find_text_fault, verify::find_group_fault,
        verify::find_value_fault, verify::find_requirement_fault, verify::find_graph_fault,
        verify::find_clique_fault, verify::find_connection_fault}) {
    if (auto fault = find_fault_of_part(catalog)) return fault;
  }
  return std::nullopt;
}

}  // namespace cbc
