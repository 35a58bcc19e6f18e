// Cut sets for people.

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "ask/together.h"
#include "core/report/table.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "runtime/base/text.h"
#include "verify/report/verify_report.h"

namespace cbc {

std::string describe_part(const CompiledCatalog& catalog, const SituationPart& part) {
  std::vector<std::string> words;
  for (const VariableValue& value : part.variables) {
    words.push_back(describe_value(catalog, value));
  }
  for (const SituationPart::Own& own : part.behaviors) {
    if (own.available) continue;
    words.push_back(behavior_name(catalog, own.behavior) + " is unavailable");
  }
  return list_with_and(words);
}

namespace {

/// What of the situation is given, as far as it matters to some tasks.
SituationPart given_for(const VerifyResult& result, const std::vector<TaskId>& tasks) {
  const CompiledCatalog& catalog = *result.catalog;
  const std::vector<std::uint32_t> variables = variables_of(catalog, tasks);
  SituationPart part;
  for (const VariableValue& value : result.situation.variables) {
    if (std::binary_search(variables.begin(), variables.end(), value.variable)) {
      part.variables.push_back(value);
    }
  }
  for (const SituationPart::Own& own : result.situation.behaviors) {
    const bool matters = std::any_of(tasks.begin(), tasks.end(), [&](TaskId task) {
      return catalog.tasks[task].group == catalog.group_of(own.behavior);
    });
    if (matters) part.behaviors.push_back(own);
  }
  return part;
}

/// Whether the situation is left open in what matters to some tasks.
bool is_about_several(const VerifyResult& result, const std::vector<TaskId>& tasks) {
  return variables_of(*result.catalog, tasks).size() > given_for(result, tasks).variables.size();
}

/// Which situations are meant: " in every situation where LIGHT is night"; empty where situations
/// do not matter to the tasks. `every`: the words for all of them.
std::string which_situations(const VerifyResult& result, const std::vector<TaskId>& tasks,
                             const std::string& every) {
  const SituationPart given = given_for(result, tasks);
  std::string words;
  if (is_about_several(result, tasks)) {
    words = " " + every;
    if (!result.never.empty()) words += " that 'never' allows";
  }
  const std::string part = describe_part(*result.catalog, given);
  return part.empty() ? words : words + " where " + part;
}

/// "LIGHT is night" of a set that does not suffice in every situation.
std::string describe_values(const CompiledCatalog& catalog, const CutSet& set) {
  std::vector<std::string> words;
  words.reserve(set.values.size());
  for (const VariableValue& value : set.values) words.push_back(describe_value(catalog, value));
  return words.empty() ? "in every situation" : "where " + list_with_and(words);
}

std::string describe_behaviors(const CompiledCatalog& catalog, const CutSet& set) {
  if (!set.behaviors.empty()) return join(names_of_behaviors(catalog, set.behaviors), ", ");
  return set.values.empty() ? "none is needed: it can never run" : "none is needed: it cannot run";
}

void add_sets(const CompiledCatalog& catalog, const TaskCutSets& of_task, Text& text) {
  if (of_task.in_some_situation) {
    Table table(text.style(), {{}, {}}, {.columns = text_width});
    for (const CutSet& set : of_task.found.sets) {
      table.add({describe_behaviors(catalog, set), describe_values(catalog, set)});
    }
    return text.add(table.text());
  }
  Table table(text.style(), {{}}, {.columns = text_width, .breaks = Breaks::after_commas});
  for (const CutSet& set : of_task.found.sets) table.add({describe_behaviors(catalog, set)});
  text.add(table.text());
}

void add_end(const TaskCutSets& of_task, Text& text) {
  const std::uint32_t size = of_task.found.incomplete_size;
  if (size == 0) {
    return text.painted(text.style().warning, "  a limit ended the search at its beginning");
  }
  text.painted(text.style().warning,
               "  a limit ended the search: all sets of fewer than {}{} are there",
               quantity(size, "behavior"), of_task.in_some_situation ? " and values" : "");
}

}  // namespace

void add_cut_sets(const VerifyResult& result, const TaskCutSets& of_task, Text& text) {
  const CompiledCatalog& catalog = *result.catalog;
  const CutSets& found = of_task.found;
  text.title(wrap_line(
      fmt::format(
          "minimal sets of at most {} whose faults together end {}{}",
          quantity(of_task.order, "behavior"), printable(catalog.name_of_task(of_task.task)),
          which_situations(result, {of_task.task},
                           of_task.in_some_situation ? "in some situation" : "in every situation")),
      text_width, 2));
  add_sets(catalog, of_task, text);
  if (found.sets.empty()) {
    const bool has_more = !of_task.in_some_situation && is_about_several(result, {of_task.task});
    text.line(!found.complete ? "  none found so far"
              : has_more      ? "  none (--in-some-situation lists those that suffice in some)"
                              : "  none");
  }
  const std::size_t count = found.sets.size();
  // A behavior that requires nothing is a part of the robot, as a sensor is.
  const auto requires_nothing = [&](const CutSet& set) {
    return !set.behaviors.empty() &&
           std::all_of(set.behaviors.begin(), set.behaviors.end(),
                       [&](BehaviorId behavior) { return catalog.behaviors[behavior].level == 0; });
  };
  if (count > 1) {
    text.line("  {}, {} of them of behaviors that require nothing", quantity(count, "set"),
              std::count_if(found.sets.begin(), found.sets.end(), requires_nothing));
  }
  if (!found.complete) add_end(of_task, text);
}

void add_single_faults(const VerifyResult& result, Text& text) {
  const CompiledCatalog& catalog = *result.catalog;
  std::vector<TaskId> tasks;
  for (const TaskCutSets& sets : result.single_faults) tasks.push_back(sets.task);
  text.title(wrap_line("behaviors without which a task cannot run" +
                           which_situations(result, tasks, "in any situation"),
                       text_width, 2));
  Table table(text.style(), {{}, {}}, {.columns = text_width, .breaks = Breaks::after_commas});
  for (const TaskCutSets& sets : result.single_faults) {
    std::vector<std::string> names;
    for (const BehaviorSet& set : sets.found.in_every_situation()) {
      names.push_back(set.empty() ? std::string("it can never run")
                                  : printable(catalog.name_of_behavior(set.front())));
    }
    if (names.empty()) names.emplace_back(sets.found.complete ? "none" : "none found so far");
    table.add({printable(catalog.name_of_task(sets.task)), join(names, ", ")});
  }
  text.add(table.text());
}

}  // namespace cbc
