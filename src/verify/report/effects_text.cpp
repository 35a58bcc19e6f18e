// The effects of faults, cut sets among them, for people, as CSV and as a page.

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "ask/together.h"
#include "core/report/table.h"
#include "core/support/wording.h"
#include "core/words/suitability.h"
#include "core/words/words.h"
#include "page/table_page.h"
#include "runtime/base/text.h"
#include "verify/report/verify_report.h"

namespace cbc {

bool ReportedEffects::is_complete() const {
  return std::all_of(tasks.begin(), tasks.end(), [](const TaskEffects& of) { return of.complete; });
}

std::size_t ReportedEffects::count_failing(const CompiledCatalog& catalog) const {
  if (!limit) return 0;
  std::size_t count = 0;
  for (const TaskEffects& of : tasks) {
    const auto fails = [&](const Effect& effect) {
      if (effect.kind == Effect::Kind::lost) return true;
      return is_below(suitabilities_of(catalog, of.task, *effect.best),
                      suitabilities_of(catalog, of.task, *of.best), limit->thousandths);
    };
    count += static_cast<std::size_t>(std::count_if(of.effects.begin(), of.effects.end(), fails));
  }
  return count;
}

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

std::vector<Effect> ReportedEffects::all_of(const CompiledCatalog& catalog,
                                            const TaskEffects& of_task) const {
  if (are_cut_sets || !of_task.best || !of_task.complete) return of_task.effects;
  std::map<BehaviorId, const Effect*> of_single_faults;
  std::map<std::pair<std::uint32_t, std::uint32_t>, const Effect*> of_changes;
  const auto key_of = [](const VariableValue& change) {
    return std::pair(change.variable, change.value);
  };
  std::vector<Effect> of_sets;
  for (const Effect& effect : of_task.effects) {
    if (!effect.situation.empty()) {
      of_changes[key_of(effect.situation.front())] = &effect;
    } else if (effect.faults.size() == 1) {
      of_single_faults[effect.faults.front()] = &effect;
    } else {
      of_sets.push_back(effect);
    }
  }
  std::vector<Effect> all;
  for (const BehaviorId behavior : catalog.behavior_ids) {
    const auto found = of_single_faults.find(behavior);
    all.push_back(found != of_single_faults.end()
                      ? *found->second
                      : Effect{Effect::Kind::unchanged, {behavior}, {}, of_task.best});
  }
  std::move(of_sets.begin(), of_sets.end(), std::back_inserter(all));
  for (const VariableValue& change : changes) {
    const auto found = of_changes.find(key_of(change));
    all.push_back(found != of_changes.end()
                      ? *found->second
                      : Effect{Effect::Kind::unchanged, {}, {change}, of_task.best});
  }
  return all;
}

namespace {

/// "45.1 %", cut off.
std::string percent_text(const std::vector<Millionths>& suitabilities) {
  std::string percent = percent_of_product(suitabilities);
  const std::size_t point = percent.find('.');
  if (point == std::string::npos) return percent + ".0 %";
  percent.resize(point + 2);
  return percent + " %";
}

/// How much of a suitability is left: "71.3 %", cut off; empty if there was none.
std::string describe_rest(const std::vector<Millionths>& now,
                          const std::vector<Millionths>& before) {
  const double whole = product_of(before);
  if (whole <= 0) return "";
  auto thousandths = static_cast<std::uint32_t>(1000 * product_of(now) / whole);
  // What is below a limit shall not look as if it reached it.
  while (is_below(now, before, thousandths)) --thousandths;
  while (!is_below(now, before, thousandths + 1)) ++thousandths;
  return fmt::format("{}.{} %", thousandths / 10, thousandths % 10);
}

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

std::string title_of(const CompiledCatalog& catalog, const ReportedEffects& effects) {
  const std::string place = describe_part(catalog, effects.situation);
  return fmt::format("effects of {}{}{}{}",
                     effects.order == 1 ? "single faults"
                                        : fmt::format("at most {} faults together", effects.order),
                     effects.changes.empty() ? "" : " and of single changes of the situation",
                     place.empty() ? "" : " where ", place);
}

std::string title_of(const VerifyResult& result, const TaskEffects& of) {
  const CompiledCatalog& catalog = *result.catalog;
  const ReportedEffects& effects = *result.effects;
  std::string name = printable(catalog.name_of_task(of.task));
  if (effects.are_cut_sets) {
    return fmt::format(
        "minimal sets of at most {} whose faults together end {}{}",
        quantity(effects.order, "behavior"), name,
        which_situations(result, {of.task},
                         effects.in_some_situation ? "in some situation" : "in every situation"));
  }
  if (!of.best) return name;
  const BehaviorSet active = behaviors_of(catalog, of.task, *of.best);
  return fmt::format("{}: {} with {}", name,
                     percent_text(suitabilities_of(catalog, of.task, *of.best)),
                     join(names_of_behaviors(catalog, active), ", "));
}

/// "GPS, RADAR"; "LIGHT is dark" of a change.
std::string describe_cause(const CompiledCatalog& catalog, const ReportedEffects& effects,
                           const Effect& effect) {
  if (!effect.faults.empty()) return join(names_of_behaviors(catalog, effect.faults), ", ");
  if (!effect.situation.empty() && !effects.are_cut_sets) {
    return describe_part(catalog, {effect.situation, {}});
  }
  const bool is_everywhere = effects.are_cut_sets && effect.situation.empty();
  return fmt::format("none is needed: it {} run", is_everywhere ? "can never" : "cannot");
}

/// The behaviors that are active with an effect, and were not without it.
std::string describe_substitutes(const CompiledCatalog& catalog, const TaskEffects& of,
                                 const Effect& effect) {
  if (!effect.best) return "";
  const BehaviorSet before = behaviors_of(catalog, of.task, *of.best);
  const BehaviorSet now = behaviors_of(catalog, of.task, *effect.best);
  BehaviorSet added;
  std::set_difference(now.begin(), now.end(), before.begin(), before.end(),
                      std::back_inserter(added));
  return added.empty() ? "nothing" : join(names_of_behaviors(catalog, added), ", ");
}

/// The worst first; of equal ones the smaller sets, as they are.
std::vector<const Effect*> by_severity(const CompiledCatalog& catalog, const TaskEffects& of) {
  std::vector<const Effect*> effects;
  for (const Effect& effect : of.effects) effects.push_back(&effect);
  std::stable_sort(effects.begin(), effects.end(), [&](const Effect* a, const Effect* b) {
    if (a->kind != b->kind) return a->kind < b->kind;
    return a->best && is_below(suitabilities_of(catalog, of.task, *a->best),
                               suitabilities_of(catalog, of.task, *b->best), 1000);
  });
  return effects;
}

/// Cut sets have no columns of what is the same in all of them. In a terminal two columns are one,
/// so that long lists fit.
Table table_of(const CompiledCatalog& catalog, const ReportedEffects& effects,
               const TaskEffects& of, const Style& style, bool is_page) {
  std::vector<Table::Column> columns;
  if (!effects.are_cut_sets) {
    columns = {{"effect"}, number_column("suitability"), number_column("left")};
  }
  columns.push_back({effects.are_cut_sets ? "" : is_page ? "by" : "by -> instead"});
  if (is_page) columns.push_back({"instead"});
  if (effects.in_some_situation) columns.emplace_back();
  Table table(style, columns, {.columns = text_width, .breaks = Breaks::after_commas});
  for (const Effect* const effect : by_severity(catalog, of)) {
    Table::Row row;
    if (!effects.are_cut_sets) {
      row = {{name_of(effect->kind), effect->best ? style.warning : style.bad}, "", ""};
    }
    std::string cause = describe_cause(catalog, effects, *effect);
    if (effect->best) {
      const auto now = suitabilities_of(catalog, of.task, *effect->best);
      row[1] = percent_text(now);
      row[2] = describe_rest(now, suitabilities_of(catalog, of.task, *of.best));
    }
    const std::string substitutes = describe_substitutes(catalog, of, *effect);
    if (!is_page && effect->best) cause += " -> " + substitutes;
    row.emplace_back(cause);
    if (is_page) row.emplace_back(substitutes);
    if (effects.in_some_situation) {
      const std::string values = describe_part(catalog, {effect->situation, {}});
      row.emplace_back(values.empty() ? "in every situation" : "where " + values);
    }
    table.add(std::move(row));
  }
  return table;
}

std::string describe_end(const ReportedEffects& effects, const TaskEffects& of) {
  if (of.complete) return "";
  const std::uint32_t size = of.incomplete_size;
  if (!effects.are_cut_sets) return "a limit ended the search, so effects are missing";
  if (size == 0) return "a limit ended the search at its beginning";
  return fmt::format("a limit ended the search: all sets of fewer than {}{} are there",
                     quantity(size, "behavior"), effects.in_some_situation ? " and values" : "");
}

/// How many cut sets there are; empty of a single one.
std::string describe_count(const VerifyResult& result, const TaskEffects& of) {
  const CompiledCatalog& catalog = *result.catalog;
  if (of.effects.empty()) {
    if (!of.complete) return "none found so far";
    const bool has_more = !result.effects->in_some_situation && is_about_several(result, {of.task});
    return has_more ? "none (--in-some-situation lists those that suffice in some)" : "none";
  }
  if (of.effects.size() == 1) return "";
  // A behavior that requires nothing is a part of the robot, as a sensor is.
  const auto requires_nothing = [&](const Effect& effect) {
    return !effect.faults.empty() &&
           std::all_of(effect.faults.begin(), effect.faults.end(),
                       [&](BehaviorId behavior) { return catalog.behaviors[behavior].level == 0; });
  };
  return fmt::format("{}, {} of them of behaviors that require nothing",
                     quantity(of.effects.size(), "set"),
                     std::count_if(of.effects.begin(), of.effects.end(), requires_nothing));
}

std::string describe_failing(const CompiledCatalog& catalog, const ReportedEffects& effects) {
  if (!effects.limit) return "";
  const std::size_t count = effects.count_failing(catalog);
  return fmt::format("{} {} as bad as --fail-on {}", quantity(count, "effect"),
                     count == 1 ? "is" : "are", effects.limit->text);
}

}  // namespace

void add_effects(const VerifyResult& result, Text& text) {
  const CompiledCatalog& catalog = *result.catalog;
  const ReportedEffects& effects = *result.effects;
  if (!effects.are_cut_sets) text.add(wrap_line(title_of(catalog, effects), text_width, 2) + "\n");
  for (const TaskEffects& of : effects.tasks) {
    text.title(wrap_line(title_of(result, of), text_width, effects.are_cut_sets ? 2 : 4));
    if (!of.effects.empty()) text.add(table_of(catalog, effects, of, text.style(), false).text());
    if (effects.are_cut_sets) {
      const std::string count = describe_count(result, of);
      if (!count.empty()) text.line("  {}", count);
    }
    if (!of.complete) text.painted(text.style().warning, "  {}", describe_end(effects, of));
  }
  if (!effects.limit) return;
  text.line("");
  text.painted(effects.count_failing(catalog) == 0 ? text.style().good : text.style().bad,
               std::string_view(describe_failing(catalog, effects)));
}

void add_single_faults(const VerifyResult& result, Text& text) {
  const CompiledCatalog& catalog = *result.catalog;
  std::vector<TaskId> tasks;
  for (const TaskEffects& of : result.single_faults) tasks.push_back(of.task);
  text.title(wrap_line("behaviors without which a task cannot run" +
                           which_situations(result, tasks, "in any situation"),
                       text_width, 2));
  Table table(text.style(), {{}, {}}, {.columns = text_width, .breaks = Breaks::after_commas});
  for (const TaskEffects& of : result.single_faults) {
    std::vector<std::string> names;
    for (const Effect& lost : of.effects) {
      names.push_back(lost.faults.empty()
                          ? std::string("it can never run")
                          : printable(catalog.name_of_behavior(lost.faults.front())));
    }
    if (names.empty()) names.emplace_back(of.complete ? "none" : "none found so far");
    table.add({printable(catalog.name_of_task(of.task)), join(names, ", ")});
  }
  text.add(table.text());
}

std::string effects_to_html(const VerifyResult& result) {
  const CompiledCatalog& catalog = *result.catalog;
  const ReportedEffects& effects = *result.effects;
  std::string html = fmt::format("<p>{}</p>\n", xml_text(title_of(catalog, effects)));
  for (const TaskEffects& of : effects.tasks) {
    html += fmt::format("<h2>{}</h2>\n", xml_text(title_of(result, of)));
    if (!of.effects.empty())
      html += table_of(catalog, effects, of, plain_style(), true).html("effects");
    if (!of.complete) html += fmt::format("<p>{}</p>\n", describe_end(effects, of));
  }
  if (effects.limit) html += fmt::format("<p>{}</p>\n", describe_failing(catalog, effects));
  return table_page(fmt::format("Effects of faults: {}", catalog.file), html);
}

namespace {

/// A field of CSV, in quotes where it has to be.
std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string field = "\"";
  for (const char character : text) {
    field += character;
    if (character == '"') field += character;
  }
  return field + '"';
}

/// The names, with semicolons between them.
std::string csv_names(const CompiledCatalog& catalog, const BehaviorSet& behaviors) {
  return csv_field(join(behaviors, ";", [&](BehaviorId behavior) {
    return std::string(catalog.name_of_behavior(behavior));
  }));
}

}  // namespace

std::string effects_to_csv(const VerifyResult& result, const Style& /*style*/) {
  const CompiledCatalog& catalog = *result.catalog;
  std::string csv = "task,faults,situation,effect,suitability_before,suitability,behaviors\n";
  for (const TaskEffects& of : result.effects->tasks) {
    const auto suitability_of = [&](const BestAssignment& best) {
      return best ? fmt::format("{}", product_of(suitabilities_of(catalog, of.task, *best))) : "";
    };
    for (const Effect& effect : result.effects->all_of(catalog, of)) {
      std::string change;
      for (const VariableValue& value : effect.situation) {
        change = csv_field(
            concat(catalog.name_of_variable(value.variable), "=", catalog.name_of_value(value)));
      }
      const BehaviorSet now =
          effect.best ? behaviors_of(catalog, of.task, *effect.best) : BehaviorSet{};
      csv += fmt::format("{},{},{},{},{},{},{}\n", csv_field(catalog.name_of_task(of.task)),
                         csv_names(catalog, effect.faults), change, name_of(effect.kind),
                         suitability_of(of.best), suitability_of(effect.best),
                         csv_names(catalog, now));
    }
  }
  return csv;
}

}  // namespace cbc
