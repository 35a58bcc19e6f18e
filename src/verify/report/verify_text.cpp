#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "ask/together.h"
#include "core/report/table.h"
#include "core/support/wording.h"
#include "core/words/words.h"
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
  return std::all_of(parts.begin(), parts.end(),
                     [](const VerifyPart& part) {
                       return part.is_about_groups() ? part.verification.is_complete()
                                                     : is_proved(part);
                     }) &&
         std::all_of(single_faults.begin(), single_faults.end(),
                     [](const TaskEffects& of) { return of.complete; }) &&
         (!overrides || overrides->matrix.complete) &&
         (!effects || (effects->is_complete() && effects->count_failing(*catalog) == 0)) &&
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

/// The exploration that decided a property.
const Exploration& exploration_of(const VerifyPart& part, const PropertyAnswer& answer) {
  return part.verification.explorations[*answer.exploration];
}

/// How a property is violated: "violated after 4 events".
std::string describe_violation(const PropertyAnswer& answer, const Exploration& exploration) {
  if (!answer.witness) {
    return fmt::format("violated: there is none among {}", quantity(exploration.states, "state"));
  }
  const std::size_t events = answer.verdict.script.size();
  return events == 0 ? "violated in the first state"
                     : "violated after " + quantity(events, "event");
}

bool has_higher_limit(Budget::End end) {
  return end == Budget::End::max_states || end == Budget::End::max_memory ||
         end == Budget::End::time_limit;
}

}  // namespace

std::string describe_limit(const VerifyResult& result, const Exploration& exploration) {
  const Budget::End end = exploration.end.value_or(Budget::End::stopped);
  const std::string counts = join(exploration.states_at_depth, ", ",
                                  [](std::uint64_t count) { return std::to_string(count); });
  return fmt::format("{}; every state up to depth {} was visited{}; states at each depth: {}",
                     result.limits.describe(end), exploration.depth,
                     has_higher_limit(end) ? " (a higher limit goes on)" : "", counts);
}

std::string describe_vacuity(const Property& property) {
  if (!property.after) return "'when' holds in no reachable state";
  return property.when ? "'when' holds in no reachable state after 'after'"
                       : "no reachable state comes after 'after'";
}

std::string describe_answer(const VerifyResult& result, const VerifyPart& part,
                            const PropertyAnswer& answer) {
  const std::string vacuity =
      answer.verdict.is_vacuous ? ", but only since " + describe_vacuity(*answer.property) : "";
  if (answer.verdict.by_constraints) {
    return "proved by the constraints alone, without any state" + vacuity;
  }
  const Exploration& exploration = exploration_of(part, answer);
  switch (answer.verdict.result) {
    case Verdict::Result::undecided:
      return "undecided: " + describe_limit(result, exploration);
    case Verdict::Result::violated:
      return describe_violation(answer, exploration);
    case Verdict::Result::proved:
      break;
  }
  if (!answer.witness) {
    return fmt::format("proved for {}{}", quantity(exploration.states, "reachable state"), vacuity);
  }
  const std::size_t events = answer.verdict.script.size();
  return events == 0 ? "proved in the first state" : "proved after " + quantity(events, "event");
}

namespace {

/// What was found out about the groups of a catalog.
class GroupText {
 public:
  GroupText(const VerifyResult& result, const VerifyPart& part, const Assumptions& assumptions,
            Text& text)
      : result_(result),
        catalog_(*result.catalog),
        part_(part),
        assumptions_(assumptions),
        text_(text) {
    for (const Assumptions::Start& start : assumptions.start) {
      requested_.insert(catalog_.tasks[start.task].catalog_index);
    }
  }

  void write() && {
    if (requested_.empty()) {
      text_.add(
          "\nno task starts on request, so only reactive starts were explored; a property file\n"
          "can assume others (assume: {start: {TASK: 1}})\n");
    }
    const auto& explorations = part_.verification.explorations;
    for (std::size_t place = 0; place < explorations.size(); ++place) {
      add_group(explorations[place]);
      if (part_.outcomes.empty()) {
        add_facts(explorations[place]);
      } else {
        add_outcomes(catalog_, assumptions_, part_.outcomes[place], text_);
      }
    }
    if (!part_.outcomes.empty()) add_how_to_read_outcomes(text_);
    if (!result_.single_faults.empty()) add_single_faults(result_, text_);
  }

 private:
  /// By their places in the catalog.
  [[nodiscard]] std::vector<std::uint32_t> tasks_of(const Exploration& exploration) const {
    const GroupId group = exploration.groups.front();
    std::vector<std::uint32_t> tasks;
    for (TaskId id = catalog_.group_tasks[group]; id < catalog_.group_tasks[group + 1]; ++id) {
      tasks.push_back(catalog_.tasks[id].catalog_index);
    }
    std::sort(tasks.begin(), tasks.end());
    return tasks;
  }

  void add_group(const Exploration& exploration) {
    text_.title(fmt::format("group {}", exploration.groups.front()));
    add_row("tasks", names_of(tasks_of(exploration)));
    add_row("explored",
            {quantity(exploration.states, "state"), quantity(exploration.transitions, "transition"),
             fmt::format("depth {}", exploration.depth)});
    if (!exploration.complete) {
      const Table table(text_.style(), row_columns(), {.columns = text_width});
      text_.add(
          table.line({"incomplete", describe_limit(result_, exploration)}, text_.style().warning));
    }
  }

  void add_facts(const Exploration& exploration) {
    const std::vector<std::uint32_t> tasks = tasks_of(exploration);
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
    const GroupId group = exploration.groups.front();
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

  /// The pairs of tasks that may be requested, of which both run, but never at the same time: a few
  /// as a list, more of them as a matrix.
  void add_apart(const Exploration& exploration, const std::vector<std::uint32_t>& tasks,
                 const std::string& never) {
    std::vector<std::uint32_t> candidates;
    for (const std::uint32_t task : tasks) {
      if (requested_.contains(task) && has_first(exploration.runs, task)) {
        candidates.push_back(task);
      }
    }
    const std::string label = never + " run together";
    if (candidates.size() > most_tasks_in_pairs) {
      add_row(label,
              {fmt::format("(pairs of more than {} tasks are not listed)", most_tasks_in_pairs)});
      return;
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> together;
    for (const auto& pair : exploration.together) together.emplace(pair.a, pair.b);
    std::vector<std::string> apart;
    for (auto a = candidates.begin(); a != candidates.end(); ++a) {
      for (auto b = a + 1; b != candidates.end(); ++b) {
        if (together.contains({*a, *b})) continue;
        apart.push_back(fmt::format("{} with {}", name_of_task(*a), name_of_task(*b)));
      }
    }
    if (candidates.size() > 2 && apart.size() == candidates.size() * (candidates.size() - 1) / 2) {
      add_row(label, {"any two of " + list_with_and(names_of(candidates))});
      return;
    }
    if (apart.size() <= most_pairs_in_list) {
      add_row(label, apart);
      return;
    }
    if (candidates.size() > most_tasks_in_matrix) {
      add_row(label,
              {fmt::format("{} (--format json lists the others)", quantity(apart.size(), "pair"))});
      return;
    }
    add_row(label, {fmt::format("{}, marked -", quantity(apart.size(), "pair"))});
    text_.add(pair_matrix(
        names_of(candidates), text_.style(),
        [&](std::size_t row, std::size_t column) -> Table::Cell {
          const bool is_possible = together.contains({candidates[column], candidates[row]});
          if (is_possible) return {"+", text_.style().good};
          return {"-", text_.style().faint};
        }));
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
    names.reserve(tasks.size());
    for (const std::uint32_t task : tasks) names.push_back(name_of_task(task));
    return names;
  }

  static constexpr std::size_t label_width = 24;
  static constexpr std::size_t most_pairs_in_list = 6;
  static constexpr std::size_t most_tasks_in_matrix = 80;

  const VerifyResult& result_;
  const CompiledCatalog& catalog_;
  const VerifyPart& part_;
  const Assumptions& assumptions_;
  std::set<std::uint32_t> requested_;  ///< tasks, by their places in the catalog
  Text& text_;
};

std::string_view color_of(Verdict::Result result, const Style& style) {
  if (result == Verdict::Result::undecided) return style.warning;
  return result == Verdict::Result::proved ? style.good : style.bad;
}

void add_table(const VerifyResult& result, const VerifyPart& part, Text& text) {
  Table table(text.style(), {number_column("line"),
                             {"result"},
                             number_column("states"),
                             number_column("transitions"),
                             number_column("depth"),
                             number_column("events"),
                             {"property"}});
  for (const ReportedAnswer& reported : part.answers) {
    const PropertyAnswer& answer = *reported.answer;
    const Verdict::Result found = answer.verdict.result;
    const auto count = [&](auto Exploration::*number) {
      return answer.exploration ? std::to_string(exploration_of(part, answer).*number) : "";
    };
    table.add({answer.property->line,
               {name_of(found), color_of(found, text.style())},
               count(&Exploration::states),
               count(&Exploration::transitions),
               count(&Exploration::depth),
               answer.witness ? std::to_string(answer.verdict.script.size()) : "",
               title_of(*result.catalog, *answer.property)});
  }
  text.line("");
  text.add(table.text());
  std::vector<std::size_t> lines;
  for (const ReportedAnswer& reported : part.answers) {
    if (reported.answer->verdict.by_constraints) lines.push_back(reported.answer->property->line);
  }
  if (lines.empty()) return;
  text.line("");
  text.line(fmt::format("{} {}: proved by the constraints alone, without any state",
                        lines.size() == 1 ? "line" : "lines",
                        join(lines, ", ", [](std::size_t line) { return std::to_string(line); })));
}

/// A promise that says nothing.
void add_vacuity(const VerifyPart& part, const Property& property, Text& text) {
  text.line("");
  text.line(fmt::format("{}:{}: {}: proved only since {}", printable(part.file->path),
                        property.line, text.style().paint(text.style().warning, "warning"),
                        describe_vacuity(property)));
}

void add_violation(const VerifyResult& result, const VerifyPart& part,
                   const ReportedAnswer& reported, Text& text) {
  const PropertyAnswer& answer = *reported.answer;
  const Property& property = *answer.property;
  text.title(fmt::format("{}:{}: {}", printable(part.file->path), property.line,
                         title_of(*result.catalog, property)));
  if (!property.name.empty()) text.line(describe_property(*result.catalog, property));
  const Exploration& exploration = exploration_of(part, answer);
  text.line(text.style().paint(text.style().bad, describe_violation(answer, exploration)) +
            (reported.script_path ? "; see " + printable(*reported.script_path) : ""));
  if (!answer.verdict.script.empty()) text.add("\n" + reported.replay->text);
}

/// "exploration of groups 0, 2"
std::string title_of(const Exploration& exploration) {
  const std::string groups =
      join(exploration.groups, ", ", [](GroupId group) { return std::to_string(group); });
  return groups.empty() ? "exploration of the situation alone"
                        : fmt::format("exploration of {} {}",
                                      exploration.groups.size() == 1 ? "group" : "groups", groups);
}

/// That an exploration did not make all moves.
void add_left_out(const Exploration& exploration, Text& text) {
  text.line("");
  text.line(text.style().paint(text.style().warning, title_of(exploration)) +
            ": moves after which more requests would be suspended than 'assume' lets are left out");
}

/// What ended an exploration before all states were visited.
void add_end(const VerifyResult& result, const Exploration& exploration, Text& text) {
  const std::string_view color = exploration.decided ? text.style().faint : text.style().warning;
  text.line("");
  text.line(text.style().paint(color, title_of(exploration)) + ": " +
            (exploration.decided
                 ? "ended as all its properties were decided; it counts what it visited"
                 : describe_limit(result, exploration)));
}

/// The properties of a file: a table, then what is behind those that are not proved.
void add_properties(const VerifyResult& result, const VerifyPart& part, Text& text) {
  add_table(result, part, text);
  for (const ReportedAnswer& reported : part.answers) {
    if (reported.answer->verdict.is_vacuous) add_vacuity(part, *reported.answer->property, text);
    if (reported.answer->verdict.result == Verdict::Result::violated) {
      add_violation(result, part, reported, text);
    }
  }
  for (const Exploration& exploration : part.verification.explorations) {
    if (!exploration.complete) add_end(result, exploration, text);
    if (exploration.has_left_out) add_left_out(exploration, text);
  }
}

/// What was found out about the events of two catalogs.
void add_compared_events(const VerifyResult& result, Text& text) {
  const ReportedComparison& reported = *result.same_as;
  const CatalogComparison& comparison = reported.comparison;
  const Style& style = text.style();
  const std::string counts =
      fmt::format("{} of states, {} transitions, depth {}", quantity(comparison.states, "pair"),
                  comparison.transitions, comparison.depth);
  const auto add = [&](std::string_view color, std::string_view words, const std::string& more) {
    text.add("  " + style.paint(color, words) + more + "\n");
  };
  if (comparison.explored == Verdict::Result::violated) {
    std::vector<std::string> tasks;
    for (const ReportedDifference& each : reported.differences) {
      for (const TaskDifference& task : each.difference->tasks) {
        tasks.push_back(printable(task.task));
      }
    }
    const Table table(style, {{{}, {}, 20}, {}},
                      {.columns = text_width, .breaks = Breaks::after_commas});
    text.add(table.line({{"decided differently", style.bad}, join(tasks, ", ")}));
    if (comparison.end) {
      add(style.warning, "incomplete",
          ": " + result.limits.describe(*comparison.end) + "; there may be further differences");
    }
    return;
  }
  if (comparison.explored == Verdict::Result::undecided) {
    return add(
        style.warning, "undecided",
        fmt::format(": {}; no difference in {}", result.limits.describe(*comparison.end), counts));
  }
  if (!comparison.is_compared) {
    return add(style.bad, "nothing was compared", ": no start, stop or finish comes in both");
  }
  add(style.good,
      comparison.direct.empty() ? "every reachable event is decided alike"
                                : "the events of both are decided alike",
      ": " + counts);
}

/// What differs, then the events before it, and the last one with either catalog.
void add_difference(const VerifyResult& result, const ReportedDifference& reported, Text& text) {
  const EventDifference& difference = *reported.difference;
  text.line("");
  for (const TaskDifference& task : difference.tasks) {
    text.painted(text.style().strong, task.line);
  }
  std::string scripts;
  if (reported.script_path) scripts += "; see " + printable(*reported.script_path);
  if (reported.old_script_path) scripts += " and " + printable(*reported.old_script_path);
  text.line("the last of {}{}", quantity(difference.moves.size(), "event"), scripts);
  const Replay& with_new = reported.with_new;
  const Replay& with_old = reported.with_old;
  const std::string_view new_end = std::string_view(with_new.text).substr(with_new.last_move);
  const std::string_view old_end = std::string_view(with_old.text).substr(with_old.last_move);
  if (new_end == old_end) return text.add("\n" + with_new.text);
  const bool has_events_before = difference.moves.size() > 1;
  if (has_events_before) text.add("\n" + with_new.text.substr(0, with_new.last_move));
  text.title("with " + printable(result.same_as->old_catalog->file));
  text.add(fmt::format("\n{}", has_events_before ? old_end : std::string_view(with_old.text)));
  text.title("with " + printable(result.catalog->file));
  text.add(fmt::format("\n{}", has_events_before ? new_end : std::string_view(with_new.text)));
}

/// How the catalog compares with an older one.
void add_comparison(const VerifyResult& result, Text& text) {
  const ReportedComparison& reported = *result.same_as;
  const CatalogComparison& comparison = reported.comparison;
  const Style& style = text.style();
  const std::string old_name = printable(reported.old_catalog->file);
  const std::string new_name = printable(result.catalog->file);
  const std::string title = style.paint(style.strong, new_name + " against " + old_name);
  text.add((text.is_empty() ? "" : "\n") + title + "\n");
  if (result.parts.empty()) {
    text.paragraph(describe_assumptions(*result.catalog, {reported.assumptions, {}}));
  }
  comparison.names.add_to(text, old_name, new_name);
  bool is_any_missing = false;
  for (const DirectDifference& difference : comparison.direct) {
    text.line("  {} {}", style.paint(style.bad, "different:"), difference.line);
    is_any_missing = is_any_missing || difference.kind <= DirectDifference::Kind::value;
  }
  if (is_any_missing) {
    text.line("  (--renamed OLD=NEW pairs two names, --allow-missing ignores what only one has)");
  }
  add_compared_events(result, text);
  for (const ReportedDifference& difference : reported.differences) {
    add_difference(result, difference, text);
  }
}

void add_totals(const VerifyResult& result, Text& text) {
  std::array<std::size_t, 3> counts{};
  for (const VerifyPart& part : result.parts) {
    for (const ReportedAnswer& reported : part.answers) {
      ++counts[static_cast<std::size_t>(reported.answer->verdict.result)];
    }
  }
  if (counts == std::array<std::size_t, 3>{}) return;
  text.line("");
  text.painted(counts[1] + counts[2] == 0 ? text.style().good : text.style().bad,
               "properties: {} proved, {} violated, {} undecided", counts[0], counts[1], counts[2]);
}

void add_part(const VerifyResult& result, const VerifyPart& part, Text& text) {
  const CompiledCatalog& catalog = *result.catalog;
  const auto strong = [&](std::string_view file) {
    return text.style().paint(text.style().strong, printable(file));
  };
  if (!text.is_empty()) text.line("");
  text.line(part.file == nullptr ? strong(catalog.file)
                                 : strong(part.file->path) + " with " + printable(catalog.file));
  const StatedAssumptions stated = part.file == nullptr
                                       ? StatedAssumptions{default_assumptions(catalog), {}}
                                       : StatedAssumptions{part.file->assumptions, part.file->path};
  text.paragraph(describe_assumptions(catalog, stated));
  if (part.is_about_groups()) {
    GroupText(result, part, stated.assumptions, text).write();
  } else {
    add_properties(result, part, text);
  }
}

}  // namespace

std::string verify_to_text(const VerifyResult& result, const Style& style) {
  Text text(style);
  for (const VerifyPart& part : result.parts) add_part(result, part, text);
  if (text.is_empty() && !result.same_as) {
    text.painted(style.strong, printable(result.catalog->file));
  }
  if (result.same_as) add_comparison(result, text);
  if (result.effects) add_effects(result, text);
  if (result.overrides) add_overrides(result, text);
  add_totals(result, text);
  return text.take();
}

}  // namespace cbc
