#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/check/together.h"
#include "core/report/catalog_words.h"
#include "core/report/property_words.h"
#include "core/report/table.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "verify/report/verify_report.h"

namespace cbc {

namespace {

bool is_proved(const VerifyPart& part) {
  return std::all_of(part.answers.begin(), part.answers.end(), [](const ReportedAnswer& reported) {
    return reported.answer->verdict.result == Verdict::Result::proved;
  });
}

}  // namespace

bool VerifyResult::is_answered() const {
  const auto is_found = [](const TaskCutSets& sets) { return sets.found.complete; };
  return std::all_of(parts.begin(), parts.end(),
                     [](const VerifyPart& part) {
                       return part.is_about_groups() ? part.verification.is_complete()
                                                     : is_proved(part);
                     }) &&
         std::all_of(single_faults.begin(), single_faults.end(), is_found) &&
         std::all_of(cut_sets.begin(), cut_sets.end(), is_found) &&
         (!same_as || same_as->comparison.result == Verdict::Result::proved);
}

std::string_view name_of(Verdict::Result result) {
  constexpr std::array<std::string_view, 3> names = {"proved", "violated", "undecided"};
  return names[static_cast<std::size_t>(result)];
}

std::string title_of(const CompiledCatalog& catalog, const Property& property) {
  return property.name.empty() ? describe_property(catalog, property) : printable(property.name);
}

namespace {

/// As --max-memory takes it: "512M".
std::string memory_with_unit(std::uint64_t bytes) {
  constexpr std::string_view units = " KMGT";
  std::size_t unit = 0;
  while (bytes % 1024 == 0 && unit + 1 < units.size()) {
    bytes /= 1024;
    ++unit;
  }
  return std::to_string(bytes) + std::string(unit > 0 ? units.substr(unit, 1) : "");
}

}  // namespace

std::string describe_violation(const Answer& answer, const Exploration& exploration) {
  if (!answer.witness) {
    return fmt::format("violated: there is none among {}", quantity(exploration.states, "state"));
  }
  const std::size_t events = answer.verdict.script.size();
  return events == 0 ? "violated in the first state"
                     : "violated after " + quantity(events, "event");
}

namespace {

std::string describe_exploration_end(ExplorationEnd end, const ExplorationLimits& limits) {
  switch (end) {
    case ExplorationEnd::max_states:
      return fmt::format("ended by --max-states {}", limits.max_states);
    case ExplorationEnd::max_memory:
      return fmt::format("ended by --max-memory {}", memory_with_unit(limits.max_memory));
    case ExplorationEnd::time_limit:
      return fmt::format("ended by --time-limit {}", limits.seconds);
    case ExplorationEnd::too_many:
      return "ended, as there are more states than can be counted";
    case ExplorationEnd::stopped:
      break;
  }
  return "interrupted";
}

bool has_higher_limit(ExplorationEnd end) {
  return end == ExplorationEnd::max_states || end == ExplorationEnd::max_memory ||
         end == ExplorationEnd::time_limit;
}

}  // namespace

std::string describe_limit(const VerifyResult& result, const Exploration& exploration) {
  const ExplorationEnd end = exploration.end.value_or(ExplorationEnd::stopped);
  const std::string counts = join(exploration.states_at_depth, ", ",
                                  [](std::uint64_t count) { return std::to_string(count); });
  return fmt::format("{}; every state up to depth {} was visited{}; states at each depth: {}",
                     describe_exploration_end(end, result.limits), exploration.depth,
                     has_higher_limit(end) ? " (a higher limit goes on)" : "", counts);
}

std::string describe_answer(const VerifyResult& result, const VerifyPart& part,
                            const Answer& answer) {
  const Exploration& exploration = part.verification.explorations[answer.exploration];
  switch (answer.verdict.result) {
    case Verdict::Result::undecided:
      return "undecided: " + describe_limit(result, exploration);
    case Verdict::Result::violated:
      return describe_violation(answer, exploration);
    case Verdict::Result::proved:
      break;
  }
  if (!answer.witness) {
    return fmt::format("proved for {}", quantity(exploration.states, "reachable state"));
  }
  const std::size_t events = answer.verdict.script.size();
  return events == 0 ? "proved in the first state" : "proved after " + quantity(events, "event");
}

namespace {

/// What was found out about the groups of a catalog.
class GroupText {
 public:
  GroupText(const VerifyResult& result, const VerifyPart& part, const Assumptions& assumptions,
            const Style& style)
      : result_(result), catalog_(*result.catalog), part_(part), text_(style) {
    for (const Assumptions::Start& start : assumptions.start) {
      requested_.insert(catalog_.tasks[start.task].catalog_index);
    }
  }

  std::string write() && {
    if (requested_.empty()) {
      text_.add(
          "\nno task starts on request, so only reactive starts were explored; a property file\n"
          "can assume others (assume: {start: {TASK: 1}})\n");
    }
    for (const Exploration& exploration : part_.verification.explorations) add_group(exploration);
    if (!result_.single_faults.empty()) add_single_faults();
    return text_.take();
  }

 private:
  void add_group(const Exploration& exploration) {
    const std::uint32_t group = exploration.groups.front();
    std::vector<std::uint32_t> tasks;  // by their places in the catalog
    for (TaskId id = catalog_.group_tasks[group]; id < catalog_.group_tasks[group + 1]; ++id) {
      tasks.push_back(catalog_.tasks[id].catalog_index);
    }
    std::sort(tasks.begin(), tasks.end());
    text_.title(fmt::format("group {}", group));
    add_row("tasks", names_of(tasks));
    add_row(
        "explored",
        {quantity(exploration.states, "state"), quantity(exploration.transitions, "transition"),
         fmt::format("depth {}{}", exploration.depth, exploration.reduced ? " (reduced)" : "")});
    if (!exploration.complete) {
      const Table table(text_.style(), row_columns(), {.columns = text_width});
      text_.add(
          table.line({"incomplete", describe_limit(result_, exploration)}, text_.style().warning));
    }
    const std::string never = exploration.complete ? "never" : "not seen to";
    add_never(exploration, tasks, never);
    add_starts(exploration, tasks);
    add_apart(exploration, tasks, never);
  }

  void add_never(const Exploration& exploration, const std::vector<std::uint32_t>& tasks,
                 const std::string& never) {
    std::vector<std::uint32_t> idle;
    for (const std::uint32_t task : tasks) {
      if (!has_first(exploration.runs, task)) idle.push_back(task);
    }
    add_row(never + " run", names_of(idle));
    const std::uint32_t group = exploration.groups.front();
    std::vector<std::uint32_t> behaviors;  // not active
    for (BehaviorId id = catalog_.group_behaviors[group]; id < catalog_.group_behaviors[group + 1];
         ++id) {
      const std::uint32_t index = catalog_.behaviors[id].catalog_index;
      if (!has_first(exploration.active, index)) behaviors.push_back(index);
    }
    std::sort(behaviors.begin(), behaviors.end());
    std::vector<std::string> inactive;
    inactive.reserve(behaviors.size());
    for (const std::uint32_t index : behaviors) {
      inactive.push_back(printable(catalog_.behavior_names[index]));
    }
    add_row(fmt::format("{} active", exploration.complete ? "never" : "not seen"), inactive);
  }

  void add_starts(const Exploration& exploration, const std::vector<std::uint32_t>& tasks) {
    std::vector<std::string> refused;
    std::set<std::uint32_t> known;
    for (const auto& [task, depth] : exploration.start_refused) {
      known.insert(task);
      refused.push_back(fmt::format("{} after {}", name_of_task(task), quantity(depth, "event")));
    }
    std::vector<std::uint32_t> startable;
    for (const std::uint32_t task : tasks) {
      const bool is_on_request = catalog_.tasks[catalog_.task_ids[task]].start_on_request != 0;
      if (is_on_request && !known.contains(task)) startable.push_back(task);
    }
    add_row(exploration.complete ? "can always start" : "start never seen refused",
            names_of(startable));
    add_row("start can be refused", refused);
  }

  /// The pairs of tasks that may be requested, of which both run, but never at the same time.
  void add_apart(const Exploration& exploration, const std::vector<std::uint32_t>& tasks,
                 const std::string& never) {
    std::vector<std::uint32_t> candidates;
    for (const std::uint32_t task : tasks) {
      if (requested_.contains(task) && has_first(exploration.runs, task)) {
        candidates.push_back(task);
      }
    }
    std::string label = never + " run together";
    if (candidates.size() > most_tasks_in_pairs) {
      add_row(label,
              {fmt::format("(pairs of more than {} tasks are not listed)", most_tasks_in_pairs)});
      return;
    }
    auto pair = exploration.together.begin();  // these, too, are in catalog order
    for (auto a = candidates.begin(); a != candidates.end(); ++a) {
      std::vector<std::uint32_t> apart;
      for (auto b = a + 1; b != candidates.end(); ++b) {
        while (pair != exploration.together.end() &&
               std::tie(pair->a, pair->b) < std::tie(*a, *b)) {
          ++pair;
        }
        const bool run_together =
            pair != exploration.together.end() && pair->a == *a && pair->b == *b;
        if (!run_together) apart.push_back(*b);
      }
      if (apart.empty()) continue;
      const std::string first = name_of_task(*a) + " with";
      const Table table(text_.style(),
                        {{{}, {}, label_width}, {{}, {}, width_of(first)}, {{}, {}, 0, 1}},
                        {.columns = text_width, .breaks = Breaks::after_commas});
      text_.add(table.line({std::exchange(label, {}), first, join(names_of(apart), ", ")}));
    }
  }

  void add_single_faults() {
    text_.title("behaviors without which a task cannot run");
    Table table(text_.style(), {{}, {}}, {.columns = text_width, .breaks = Breaks::after_commas});
    for (const TaskCutSets& sets : result_.single_faults) {
      std::vector<std::string> names;
      for (const std::vector<BehaviorId>& set : sets.found.sets) {
        names.push_back(set.empty() ? std::string("it can never run")
                                    : printable(catalog_.name_of_behavior(set.front())));
      }
      if (names.empty()) names.emplace_back(sets.found.complete ? "none" : "none found so far");
      table.add({printable(catalog_.name_of_task(sets.task)), join(names, ", ")});
    }
    text_.add(table.text());
  }

  void add_row(const std::string& label, const std::vector<std::string>& items) {
    if (items.empty()) return;
    const Table table(text_.style(), row_columns(),
                      {.columns = text_width, .breaks = Breaks::after_commas});
    text_.add(table.line({label, join(items, ", ")}));
  }
  [[nodiscard]] static std::vector<Table::Column> row_columns() {
    return {{{}, {}, label_width}, {}};
  }

  /// Whether an entry, of which there is one each in ascending order, is about this place.
  [[nodiscard]] static bool has_first(
      const std::vector<std::pair<std::uint32_t, std::uint32_t>>& entries, std::uint32_t place) {
    const auto found = std::lower_bound(entries.begin(), entries.end(), std::pair(place, 0U));
    return found != entries.end() && found->first == place;
  }

  [[nodiscard]] std::string name_of_task(std::uint32_t index) const {
    return printable(catalog_.task_names[index]);
  }
  [[nodiscard]] std::vector<std::string> names_of(const std::vector<std::uint32_t>& tasks) const {
    std::vector<std::string> names;
    for (const std::uint32_t task : tasks) names.push_back(name_of_task(task));
    return names;
  }

  static constexpr std::size_t label_width = 24;

  const VerifyResult& result_;
  const CompiledCatalog& catalog_;
  const VerifyPart& part_;
  std::set<std::uint32_t> requested_;  ///< tasks, by their places in the catalog
  Text text_;
};

/// The properties of a file: a table, then what is behind those that are not proved.
class PropertyText {
 public:
  PropertyText(const VerifyResult& result, const VerifyPart& part, const Style& style)
      : result_(result), catalog_(*result.catalog), part_(part), style_(style) {}

  std::string write() && {
    add_table();
    for (const ReportedAnswer& reported : part_.answers) {
      if (reported.answer->verdict.result == Verdict::Result::violated) add_violation(reported);
    }
    for (const Exploration& exploration : part_.verification.explorations) {
      if (!exploration.complete) add_limit(exploration);
    }
    return std::move(text_);
  }

 private:
  void add_table() {
    Table table(style_, {number_column("line"),
                         {"result"},
                         number_column("states"),
                         number_column("transitions"),
                         number_column("depth"),
                         number_column("events"),
                         {"property"}});
    for (const ReportedAnswer& reported : part_.answers) {
      const Answer& answer = *reported.answer;
      const Exploration& exploration = part_.verification.explorations[answer.exploration];
      table.add({answer.property->line,
                 {name_of(answer.verdict.result), color_of(reported)},
                 exploration.states,
                 exploration.transitions,
                 exploration.depth,
                 answer.witness ? std::to_string(answer.verdict.script.size()) : "",
                 title_of(catalog_, *answer.property)});
    }
    text_ += "\n" + table.text();
  }

  [[nodiscard]] std::string_view color_of(const ReportedAnswer& reported) const {
    switch (reported.answer->verdict.result) {
      case Verdict::Result::proved:
        return style_.good;
      case Verdict::Result::violated:
        return style_.bad;
      case Verdict::Result::undecided:
        break;
    }
    return style_.warning;
  }

  void add_violation(const ReportedAnswer& reported) {
    const Property& property = *reported.answer->property;
    text_ += fmt::format("\n{}{}:{}: {}{}\n", style_.strong, printable(part_.file->path),
                         property.line, title_of(catalog_, property), style_.reset);
    if (!property.name.empty()) text_ += describe_property(catalog_, property) + "\n";
    const Answer& answer = *reported.answer;
    const Exploration& exploration = part_.verification.explorations[answer.exploration];
    text_ += style_.paint(style_.bad, describe_violation(answer, exploration));
    if (reported.script_path) text_ += fmt::format("; see {}", printable(*reported.script_path));
    text_ += "\n";
    if (!answer.verdict.script.empty()) text_ += "\n" + reported.replay->text;
  }

  void add_limit(const Exploration& exploration) {
    text_ += fmt::format("\n{}exploration of {}{}: {}\n", style_.warning,
                         names_of_groups(exploration.groups), style_.reset,
                         describe_limit(result_, exploration));
  }

  [[nodiscard]] static std::string names_of_groups(const std::vector<std::uint32_t>& groups) {
    return (groups.size() == 1 ? "group " : "groups ") +
           join(groups, ", ", [](std::uint32_t group) { return std::to_string(group); });
  }

  const VerifyResult& result_;
  const CompiledCatalog& catalog_;
  const VerifyPart& part_;
  const Style& style_;
  std::string text_;
};

std::string cut_sets_text(const CompiledCatalog& catalog, const TaskCutSets& of_task,
                          const Style& style) {
  const std::string task = printable(catalog.name_of_task(of_task.task));
  const CutSets& found = of_task.found;
  std::string text =
      fmt::format("\n{}minimal sets of at most {} whose faults together end {}{}\n", style.strong,
                  quantity(of_task.order, "behavior"), task, style.reset);
  for (const std::vector<BehaviorId>& set : found.sets) {
    const std::vector<std::string> names = names_of_behaviors(catalog, set);
    const std::string line =
        "  " +
        (names.empty() ? "none is needed: it cannot run even without a fault" : join(names, ", "));
    text += wrap_line(line, text_width, 2, Breaks::after_commas) + "\n";
  }
  if (found.sets.empty()) text += found.complete ? "  none\n" : "  none found so far\n";
  const std::size_t count = found.sets.size();
  // A behavior that requires nothing is a part of the robot, as a sensor is.
  const auto requires_nothing = [&](const std::vector<BehaviorId>& set) {
    return std::all_of(set.begin(), set.end(),
                       [&](BehaviorId behavior) { return catalog.behaviors[behavior].level == 0; });
  };
  if (count > 1) {
    text +=
        fmt::format("  {}, {} of them of behaviors that require nothing\n", quantity(count, "set"),
                    std::count_if(found.sets.begin(), found.sets.end(), requires_nothing));
  }
  if (!found.complete) {
    const std::uint32_t size = found.incomplete_size;
    text += style.paint(
        style.warning, size == 0 ? std::string("  a limit ended the search at its beginning\n")
                                 : fmt::format("  a limit ended the search: all sets of fewer than "
                                               "{} are there\n",
                                               quantity(size, "behavior")));
  }
  return text;
}

/// How the catalog compares with an older one.
std::string comparison_text(const VerifyResult& result, const Style& style) {
  const ReportedComparison& reported = *result.same_as;
  const CatalogComparison& comparison = reported.comparison;
  const std::string old_name = printable(reported.old_catalog->file);
  const std::string new_name = printable(result.catalog->file);
  std::string text =
      fmt::format("\n{}{} against {}{}\n", style.strong, new_name, old_name, style.reset);
  const auto add_names = [&](const std::string& file, const std::vector<std::string>& names) {
    const Table table(style, {{}, {}}, {.columns = text_width, .breaks = Breaks::after_commas});
    if (!names.empty()) text += table.line({fmt::format("only {} has", file), join(names, ", ")});
  };
  if (result.parts.empty()) {
    const CompiledCatalog& catalog = *result.catalog;
    text += assumptions_to_text(catalog, {common_assumptions(*reported.old_catalog, catalog), {}});
  }
  add_names(old_name, comparison.names.only_old);
  add_names(new_name, comparison.names.only_new);
  const std::string counts =
      fmt::format("{} of states, {} transitions, depth {}", quantity(comparison.states, "pair"),
                  comparison.transitions, comparison.depth);
  switch (comparison.result) {
    case Verdict::Result::proved:
      return text + fmt::format("  {}every reachable event is decided alike{}: {}\n", style.good,
                                style.reset, counts);
    case Verdict::Result::undecided:
      return text + fmt::format("  {}undecided{}: {}; no difference in {}\n", style.warning,
                                style.reset,
                                describe_exploration_end(*comparison.end, result.limits), counts);
    case Verdict::Result::violated:
      break;
  }
  text += fmt::format("  {}decided differently{}: the last of {}\n", style.bad, style.reset,
                      quantity(comparison.moves.size(), "event"));
  text += fmt::format("\n{}with {}{}\n\n{}", style.strong, old_name, style.reset,
                      reported.with_old->text);
  text += fmt::format("\n{}with {}{}\n\n{}", style.strong, new_name, style.reset,
                      reported.with_new->text);
  return text;
}

std::string total_of(const VerifyResult& result, const Style& style) {
  std::array<std::size_t, 3> counts{};
  for (const VerifyPart& part : result.parts) {
    for (const ReportedAnswer& reported : part.answers) {
      ++counts[static_cast<std::size_t>(reported.answer->verdict.result)];
    }
  }
  if (counts == std::array<std::size_t, 3>{}) return {};
  return fmt::format("\n{}properties: {} proved, {} violated, {} undecided{}\n",
                     counts[1] + counts[2] == 0 ? style.good : style.bad, counts[0], counts[1],
                     counts[2], style.reset);
}

StatedAssumptions assumptions_of(const CompiledCatalog& catalog, const VerifyPart& part) {
  if (part.file == nullptr) return {default_assumptions(catalog), {}};
  return {part.file->assumptions, part.file->path};
}

}  // namespace

std::string verify_to_text(const VerifyResult& result, const Style& style) {
  std::string text;
  const CompiledCatalog& catalog = *result.catalog;
  for (const VerifyPart& part : result.parts) {
    if (!text.empty()) text += "\n";
    text += style.strong;
    text += part.file == nullptr ? printable(catalog.file) : printable(part.file->path);
    text += style.reset;
    if (part.file != nullptr) text += " with " + printable(catalog.file);
    text += "\n";
    const StatedAssumptions stated = assumptions_of(catalog, part);
    text += assumptions_to_text(catalog, stated);
    if (part.is_about_groups()) {
      text += GroupText(result, part, stated.assumptions, style).write();
    } else {
      text += PropertyText(result, part, style).write();
    }
  }
  if (text.empty() && !result.same_as) {
    text = style.paint(style.strong, printable(catalog.file)) + "\n";
  }
  if (result.same_as) {
    const std::string comparison = comparison_text(result, style);
    text += text.empty() ? comparison.substr(1) : comparison;
  }
  for (const TaskCutSets& of_task : result.cut_sets) text += cut_sets_text(catalog, of_task, style);
  return text + total_of(result, style);
}

}  // namespace cbc
