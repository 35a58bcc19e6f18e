#include "versions/names/translation.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/disjoint_sets.h"
#include "runtime/base/text.h"
#include "runtime/coordinator/record.h"

namespace cbc {

namespace {

template <typename Number>
using Pairs = std::vector<std::pair<Number, Number>>;

/// Both directions for the numbers of one kind: those of the pairs, and equal names of the others.
template <typename Number, typename Called, typename NameOf>
void translate_names(const CompiledCatalog& old_catalog, std::size_t old_count,
                     const CompiledCatalog& new_catalog, std::size_t new_count,
                     const Pairs<Number>& pairs, Called called, NameOf name_of,
                     std::vector<Number>& to_new, std::vector<Number>& to_old) {
  to_new.assign(old_count, none);
  to_old.assign(new_count, none);
  for (const auto& [of_old, of_new] : pairs) {
    to_new[of_old] = of_new;
    to_old[of_new] = of_old;
  }
  for (Number of_old(0); of_old < old_count; ++of_old) {
    if (to_new[of_old] != none) continue;
    const std::optional<Number> of_new = called(new_catalog, name_of(old_catalog, of_old));
    if (!of_new || to_old[*of_new] != none) continue;
    to_new[of_old] = *of_new;
    to_old[*of_new] = of_old;
  }
}

void translate_values(const CompiledCatalog& from, const CompiledCatalog& to,
                      Translation& translation) {
  for (std::uint32_t variable = 0; variable < from.variables.size(); ++variable) {
    auto& values = translation.values.emplace_back(from.variables[variable].value_count, none);
    const std::uint32_t known = translation.variables[variable];
    for (std::uint32_t value = 0; known != none && value < values.size(); ++value) {
      values[value] = to.find_value(known, from.name_of_value({variable, value})).value_or(none);
    }
  }
}

void list_missing(const CompiledCatalog& catalog, const Translation& translation,
                  std::vector<std::string>& names) {
  for (const TaskId task : catalog.task_ids) {
    if (translation.tasks[task] == none) {
      names.push_back(fmt::format("task {}", printable(catalog.name_of_task(task))));
    }
  }
  for (const BehaviorId behavior : catalog.behavior_ids) {
    if (translation.behaviors[behavior] == none) {
      names.push_back(fmt::format("behavior {}", printable(catalog.name_of_behavior(behavior))));
    }
  }
  for (std::uint32_t variable = 0; variable < translation.variables.size(); ++variable) {
    const std::string name = printable(catalog.name_of_variable(variable));
    if (translation.variables[variable] == none) {
      names.push_back(fmt::format("variable {}", name));
      continue;
    }
    for (std::uint32_t value = 0; value < translation.values[variable].size(); ++value) {
      if (translation.values[variable][value] != none) continue;
      names.push_back(
          fmt::format("value {} of {}", printable(catalog.name_of_value({variable, value})), name));
    }
  }
}

SituationPart translate(const SituationPart& part, const Translation& to, bool& is_whole) {
  SituationPart result;
  for (const VariableValue& value : part.variables) {
    const std::uint32_t variable = to.variables[value.variable];
    const std::uint32_t translated =
        variable == none ? none : to.values[value.variable][value.value];
    if (translated == none) {
      is_whole = false;
    } else {
      result.variables.push_back({variable, translated});
    }
  }
  for (const SituationPart::Own& own : part.behaviors) {
    if (to.behaviors[own.behavior] == none) {
      is_whole = false;
    } else {
      result.behaviors.push_back({to.behaviors[own.behavior], own.available});
    }
  }
  return result;
}

/// The numbers of another catalog for those of a list, without what it does not have.
template <typename Number>
std::vector<Number> translate(const std::vector<Number>& from, const std::vector<Number>& to) {
  std::vector<Number> result;
  for (const Number number : from) {
    if (to[number] != none) result.push_back(to[number]);
  }
  return result;
}

Situation translate(const Situation& situation, const CompiledCatalog& from,
                    const CompiledCatalog& to, const Translation& translation) {
  SituationPart part{situation.variables, {}};
  for (const Availability& entry : situation.availability) {
    part.behaviors.push_back({from.behavior_ids[entry.behavior], entry.available});
  }
  bool is_whole = true;
  part = translate(part, translation, is_whole);
  Situation result{{}, part.variables};
  for (const SituationPart::Own& own : part.behaviors) {
    result.availability.push_back({to.behaviors[own.behavior].catalog_index, own.available});
  }
  return result;
}

}  // namespace

TranslationPair::TranslationPair(const CompiledCatalog& old_catalog,
                                 const CompiledCatalog& new_catalog, const Renames& renames) {
  translate_names(
      old_catalog, old_catalog.tasks.size(), new_catalog, new_catalog.tasks.size(), renames.tasks,
      task_called, [](const CompiledCatalog& in, TaskId task) { return in.name_of_task(task); },
      to_new.tasks, to_old.tasks);
  translate_names(
      old_catalog, old_catalog.behaviors.size(), new_catalog, new_catalog.behaviors.size(),
      renames.behaviors, behavior_called,
      [](const CompiledCatalog& in, BehaviorId behavior) { return in.name_of_behavior(behavior); },
      to_new.behaviors, to_old.behaviors);
  translate_names(
      old_catalog, old_catalog.variables.size(), new_catalog, new_catalog.variables.size(),
      renames.variables, variable_called,
      [](const CompiledCatalog& in, std::uint32_t variable) {
        return in.name_of_variable(variable);
      },
      to_new.variables, to_old.variables);
  translate_values(old_catalog, new_catalog, to_new);
  translate_values(new_catalog, old_catalog, to_old);
}

CatalogNames names_of(const CompiledCatalog& old_catalog, const CompiledCatalog& new_catalog,
                      const TranslationPair& translations, const Renames& renames) {
  CatalogNames names;
  list_missing(old_catalog, translations.to_new, names.only_old);
  list_missing(new_catalog, translations.to_old, names.only_new);
  const auto add = [&](std::string_view kind, std::string_view from, std::string_view to) {
    names.renamed.push_back(fmt::format("{} {}: {}", kind, printable(from), printable(to)));
  };
  for (const auto& [from, to] : renames.tasks) {
    add("task", old_catalog.name_of_task(from), new_catalog.name_of_task(to));
  }
  for (const auto& [from, to] : renames.behaviors) {
    add("behavior", old_catalog.name_of_behavior(from), new_catalog.name_of_behavior(to));
  }
  for (const auto& [from, to] : renames.variables) {
    add("variable", old_catalog.name_of_variable(from), new_catalog.name_of_variable(to));
  }
  return names;
}

Assumptions translate(const Assumptions& from, const Translation& to) {
  Assumptions result = from;
  result.start.clear();
  for (const Assumptions::Start& start : from.start) {
    if (to.tasks[start.task] == none) continue;
    result.start.push_back({to.tasks[start.task], start.priorities});
  }
  result.stop = translate(from.stop, to.tasks);
  result.variables = translate(from.variables, to.variables);
  result.behaviors = translate(from.behaviors, to.behaviors);
  result.listed_for_faults = translate(from.listed_for_faults, to.behaviors);
  result.never.clear();
  for (const SituationPart& part : from.never) {
    bool is_whole = true;
    SituationPart translated = translate(part, to, is_whole);
    if (is_whole) result.never.push_back(std::move(translated));
  }
  result.frozen = translate(from.frozen, to.variables);
  // Moves count the lists.
  for (std::vector<std::uint32_t>& list : result.together) {
    list = translate(list, to.variables);
    std::sort(list.begin(), list.end());
  }
  bool is_whole = true;
  result.initially = translate(from.initially, to, is_whole);
  return result;
}

Step translate(const Step& step, const CompiledCatalog& from, const CompiledCatalog& to,
               const Translation& translation) {
  const auto task = [&](std::uint32_t index) {
    return to.tasks[translation.tasks[from.task_ids[index]]].catalog_index;
  };
  const auto behavior = [&](std::uint32_t index) {
    return to.behaviors[translation.behaviors[from.behavior_ids[index]]].catalog_index;
  };
  Step result = step;
  if (result.expect) {
    for (auto& running : result.expect->running) {
      running.task = task(running.task);
      for (std::uint32_t& one : running.behaviors) one = behavior(one);
    }
    for (std::uint32_t& stopped : result.expect->stopped) stopped = task(stopped);
    if (auto& waiting = result.expect->suspended) {
      for (std::uint32_t& one : *waiting) one = task(one);
    }
    if (auto& failed = result.expect->failed) {
      for (std::uint32_t& one : *failed) one = behavior(one);
    }
    return result;
  }
  switch (form_of(result.verb).subject) {
    case VerbForm::SubjectKind::nothing:
      break;
    case VerbForm::SubjectKind::task:
      result.subject = task(result.subject);
      break;
    case VerbForm::SubjectKind::behavior:
      result.subject = behavior(result.subject);
      break;
    case VerbForm::SubjectKind::situation:
      result.situation = translate(result.situation, from, to, translation);
      break;
  }
  return result;
}

Script translate(const Script& script, const CompiledCatalog& from, const CompiledCatalog& to,
                 const Translation& translation) {
  Script result = script;
  result.situation = translate(script.situation, from, to, translation);
  for (Step& step : result.steps) step = translate(step, from, to, translation);
  return result;
}

void leave_out_missing(const CompiledCatalog& catalog, const Translation& to_other,
                       Expectation& expectation) {
  const auto is_missing = [&](std::uint32_t task) {
    return to_other.tasks[catalog.task_ids[task]] == none;
  };
  std::erase_if(expectation.stopped, is_missing);
  std::erase_if(expectation.running, [&](const auto& running) { return is_missing(running.task); });
  for (auto& running : expectation.running) {
    // Without one of the behaviors, the others alone would be a stronger demand.
    const bool lacks_one = std::any_of(
        running.behaviors.begin(), running.behaviors.end(), [&](std::uint32_t behavior) {
          return to_other.behaviors[catalog.behavior_ids[behavior]] == none;
        });
    if (lacks_one) running.behaviors.clear();
  }
}

std::vector<GroupPair> join_groups(const CompiledCatalog& old_catalog,
                                   const CompiledCatalog& new_catalog, const Translation& to_old) {
  const auto count = static_cast<std::uint32_t>(new_catalog.group_count());
  const auto old_count = static_cast<std::uint32_t>(old_catalog.group_count());
  DisjointSets sets(std::size_t{count} + old_count);
  for (TaskId task(0); task < new_catalog.tasks.size(); ++task) {
    if (to_old.tasks[task] == none) continue;
    sets.join(new_catalog.tasks[task].group, count + old_catalog.tasks[to_old.tasks[task]].group);
  }
  for (BehaviorId behavior(0); behavior < new_catalog.behaviors.size(); ++behavior) {
    if (to_old.behaviors[behavior] == none) continue;
    sets.join(new_catalog.group_of(behavior),
              count + old_catalog.group_of(to_old.behaviors[behavior]));
  }
  const std::vector<std::uint32_t> numbers = sets.numbers();
  std::map<std::uint32_t, GroupPair> pairs;
  for (std::uint32_t place = 0; place < numbers.size(); ++place) {
    GroupPair& pair = pairs[numbers[place]];
    place < count ? pair.new_groups.emplace_back(place)
                  : pair.old_groups.emplace_back(place - count);
  }
  std::vector<GroupPair> result;
  result.reserve(pairs.size());
  for (auto& [number, pair] : pairs) result.push_back(std::move(pair));
  return result;
}

CompiledCatalog without_reactive_starts(const CompiledCatalog& catalog,
                                        const std::function<bool(TaskId)>& is_left_out) {
  struct Storage {
    std::shared_ptr<const void> of_catalog;
    std::vector<CompiledTask> tasks;
  };
  const auto storage = std::make_shared<Storage>();
  storage->of_catalog = catalog.storage;
  storage->tasks.assign(catalog.tasks.begin(), catalog.tasks.end());
  for (TaskId task(0); task < storage->tasks.size(); ++task) {
    if (is_left_out(task)) storage->tasks[task].reactive_start = 0;
  }
  CompiledCatalog result = catalog;
  result.tasks = storage->tasks;
  result.storage = storage;
  return result;
}

CompiledCatalog without_missing_starts(const CompiledCatalog& catalog,
                                       const Translation& to_other) {
  return without_reactive_starts(catalog,
                                 [&](TaskId task) { return to_other.tasks[task] == none; });
}

void CatalogNames::add_to(Blocks& report, const std::string& old_catalog,
                          const std::string& new_catalog) const {
  const auto add = [&](const std::string& label, const std::vector<std::string>& names) {
    if (names.empty()) return;
    Table table(report.style(), {{}, {}}, {.columns = text_width, .breaks = Breaks::after_commas});
    table.add({label, join(names, ", ")});
    report.table(table);
  };
  add("renamed", renamed);
  add("only " + old_catalog + " has", only_old);
  add("only " + new_catalog + " has", only_new);
}

}  // namespace cbc
