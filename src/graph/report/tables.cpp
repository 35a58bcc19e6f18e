#include "graph/report/tables.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/compile/catalog_json.h"
#include "core/report/table.h"
#include "core/support/json_description.h"
#include "core/support/wording.h"
#include "core/words/reason_words.h"
#include "core/words/words.h"
#include "graph/engine/diagram.h"
#include "runtime/base/text.h"
#include "runtime/coordinator/record.h"

namespace cbc {
namespace {

constexpr std::array answers = {Together::possible,
                                Together::excluded,
                                Together::excluded_indirectly,
                                Together::excluded_in_each_situation,
                                Together::excluded_by_situation,
                                Together::undecided};

char sign_of(Together together) {
  constexpr char signs[] = {'+', '-', 'x', 'X', 's', '?'};
  return signs[static_cast<std::size_t>(together)];
}

constexpr char forbidden_sign = '!';

char sign_of(const TaskPair& pair) {
  return pair.is_forbidden ? forbidden_sign : sign_of(pair.together);
}

std::string_view meaning_of(Together together) {
  switch (together) {
    case Together::possible:
      return "can run together";
    case Together::excluded:
      return "excluded by a list";
    case Together::excluded_indirectly:
      return "excluded by what they require";
    case Together::excluded_in_each_situation:
      return "excluded in each situation, by what fits in it";
    case Together::excluded_by_situation:
      return "fit in no common situation";
    case Together::undecided:
      break;
  }
  return "not decided: there is too much to search";
}

/// Why a pair does not run together: sentences that lead from one task to the other.
std::vector<std::string> reasons_of(const CompiledCatalog& catalog, const TaskPair& pair) {
  if (pair.reasons.empty()) return {"the reasons would have taken too long to find"};
  std::vector<std::string> sentences;
  for (const Reason& reason : pair.reasons) {
    sentences.push_back(describe_reason(catalog, EventRecord(), reason));
  }
  return sentences;
}

std::string list_names(const CompiledCatalog& catalog, const std::vector<TaskId>& tasks) {
  return join(tasks, ", ", [&](TaskId task) { return draw::label_of(catalog.name_of_task(task)); });
}

Table::Cell cell_of(const TaskPair& pair, const Style& style) {
  const std::string sign(1, sign_of(pair));
  if (pair.is_forbidden) return {sign, style.error};
  switch (pair.together) {
    case Together::possible:
      return {sign, style.good};
    case Together::undecided:
      return {sign, style.warning};
    case Together::excluded:
      return {sign, style.faint};
    default:
      return sign;
  }
}

std::string matrix_of(const CompiledCatalog& catalog, const TogetherTable& table,
                      const Style& style) {
  std::vector<std::string> names;
  names.reserve(table.tasks.size());
  for (const TaskId task : table.tasks) {
    names.push_back(draw::label_of(catalog.name_of_task(task)));
  }
  return pair_matrix(std::move(names), style, [&](std::size_t row, std::size_t column) {
    // Before the pairs of a column come those of all columns before.
    const std::size_t before = column * (2 * table.tasks.size() - column - 1) / 2;
    return cell_of(table.pairs[before + row - column - 1], style);
  });
}

/// What each sign of the table means, and how often it stands there.
std::vector<std::string> legend_of(const TogetherTable& table) {
  std::vector<std::string> lines;
  const auto add = [&lines](char sign, std::string_view meaning, std::size_t count) {
    if (count > 0) lines.push_back(fmt::format("{} {}: {}", sign, meaning, count));
  };
  const std::size_t forbidden = table.count_forbidden();
  for (const Together together : answers) {
    const std::size_t count = table.count(together);
    const bool is_possible = together == Together::possible;
    add(sign_of(together), meaning_of(together), is_possible ? count - forbidden : count);
    if (is_possible) add(forbidden_sign, "can run together, which the settings forbid", forbidden);
  }
  return lines;
}

/// "4 tasks on request, 6 pairs"
std::string size_of(const TogetherTable& table) {
  return quantity(table.tasks.size(), "task") + (table.is_of_all_tasks ? ", " : " on request, ") +
         quantity(table.pairs.size(), "pair") +
         (table.is_of_all_tasks ? "; no task has start_on_request, so all tasks are here" : "");
}

}  // namespace

std::string together_text(const CompiledCatalog& catalog, const TogetherTable& table,
                          const Style& style) {
  std::string text = style.paint(style.strong, printable(catalog.file)) + "\n";
  text += "  " + size_of(table) + "\n";
  for (const std::string& line : legend_of(table)) text += "    " + line + "\n";
  if (!table.never_run.empty()) {
    text += "  left out, since they can never run: " + list_names(catalog, table.never_run) + "\n";
  }
  if (table.tasks.size() > 1) text += matrix_of(catalog, table, style);
  for (const TaskPair& pair : table.pairs) {
    const bool is_told = pair.together == Together::possible ||
                         pair.together == Together::excluded ||
                         pair.together == Together::undecided;
    if (is_told) continue;
    text += "\n" + style.paint(style.strong, list_names(catalog, {pair.first, pair.second})) + "\n";
    for (const std::string& reason : reasons_of(catalog, pair)) text += "  " + reason + "\n";
  }
  return text;
}

namespace {

/// Whether a behavior fits in a value of a variable.
enum class Fit : std::uint8_t {
  fits,
  does_not_fit,
  in_any  ///< the behavior does not name the variable
};

char sign_of(Fit fit) {
  constexpr char signs[] = {'+', '-', '.'};
  return signs[static_cast<std::size_t>(fit)];
}

constexpr std::string_view legend[] = {"+ fits", "- does not fit",
                                       ". fits in any value of the variable"};

/// The table without its layout.
class SituationTable {
 public:
  explicit SituationTable(const CompiledCatalog& catalog) : catalog_(catalog) {
    for (const BehaviorId behavior : catalog.behavior_ids) {
      if (!catalog.fitting_values_of(behavior).empty()) behaviors_.push_back(behavior);
    }
  }

  [[nodiscard]] const CompiledCatalog& catalog() const { return catalog_; }
  /// Those that name a variable, in catalog order.
  [[nodiscard]] const std::vector<BehaviorId>& behaviors() const { return behaviors_; }
  [[nodiscard]] std::size_t unconditional() const {
    return catalog_.behaviors.size() - behaviors_.size();
  }

  [[nodiscard]] std::vector<VariableValue> values_of(std::uint32_t variable) const {
    std::vector<VariableValue> values;
    for (std::uint32_t value = 0; value < catalog_.variables[variable].value_count; ++value) {
      values.push_back({variable, value});
    }
    return values;
  }
  [[nodiscard]] std::vector<VariableValue> values() const {
    std::vector<VariableValue> values;
    for (std::uint32_t variable = 0; variable < catalog_.variables.size(); ++variable) {
      for (const VariableValue value : values_of(variable)) values.push_back(value);
    }
    return values;
  }

  [[nodiscard]] Fit fit(BehaviorId behavior, VariableValue value) const {
    const auto fitting = catalog_.fitting_values_of(behavior);
    const FittingValue wanted{behavior, value.variable, value.value};
    const auto next = std::lower_bound(fitting.begin(), fitting.end(), wanted);
    if (next != fitting.end() && *next == wanted) return Fit::fits;
    const auto names_it = [&](const FittingValue& one) { return one.variable == value.variable; };
    const bool is_named = (next != fitting.end() && names_it(*next)) ||
                          (next != fitting.begin() && names_it(*std::prev(next)));
    return is_named ? Fit::does_not_fit : Fit::in_any;
  }

  [[nodiscard]] std::vector<BehaviorId> behaviors_with(Fit wanted, VariableValue value) const {
    std::vector<BehaviorId> found;
    std::copy_if(behaviors_.begin(), behaviors_.end(), std::back_inserter(found),
                 [&](BehaviorId behavior) { return fit(behavior, value) == wanted; });
    return found;
  }

  /// The tasks that have behaviors of which none fits, in catalog order.
  [[nodiscard]] std::vector<TaskId> tasks_without_behavior(VariableValue value) const {
    std::vector<TaskId> tasks;
    for (const TaskId task : catalog_.task_ids) {
      const auto behaviors = catalog_.values[task];
      const bool is_without = !behaviors.empty() &&
                              std::all_of(behaviors.begin(), behaviors.end(), [&](const Value& of) {
                                return fit(of.behavior, value) == Fit::does_not_fit;
                              });
      if (is_without) tasks.push_back(task);
    }
    return tasks;
  }

 private:
  const CompiledCatalog& catalog_;
  std::vector<BehaviorId> behaviors_;
};

std::string describe_size(const CompiledCatalog& catalog, const SituationTable& table) {
  if (catalog.variables.empty()) return "no situation variables";
  const std::size_t behaviors = table.behaviors().size();
  return fmt::format("{}, named by {} of {}",
                     quantity(catalog.variables.size(), "situation variable"), behaviors,
                     quantity(catalog.behaviors.size(), "behavior"));
}

/// "TARGET is lost: RECOGNIZE, FOLLOW"
std::vector<std::string> describe_gaps(const CompiledCatalog& catalog,
                                       const SituationTable& table) {
  std::vector<std::string> lines;
  for (const VariableValue value : table.values()) {
    const std::string names = list_names(catalog, table.tasks_without_behavior(value));
    if (!names.empty()) lines.push_back(describe_value(catalog, value) + ": " + names);
  }
  return lines;
}

Table::Cell cell_of(Fit fit, const Style& style) {
  return {std::string(1, sign_of(fit)), fit == Fit::in_any ? style.faint
                                        : fit == Fit::fits ? style.good
                                                           : style.bad};
}

/// The rows and columns. A variable stays in one part if it can, and its name above its first
/// value.
std::string matrix_of(const CompiledCatalog& catalog, const SituationTable& table,
                      const Style& style) {
  std::vector<std::string> variables;
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    variables.push_back(draw::label_of(catalog.name_of_variable(variable)));
  }
  variables = shorten(std::move(variables));
  std::vector<Table::Column> columns(1);
  for (std::uint32_t variable = 0; variable < variables.size(); ++variable) {
    std::vector<std::string> values;
    for (const VariableValue value : table.values_of(variable)) {
      values.push_back(draw::label_of(catalog.name_of_value(value)));
    }
    values = shorten(std::move(values));
    std::size_t width = 0;
    for (std::size_t value = 0; value < values.size(); ++value) {
      const std::string above = value == 0 ? variables[variable] : "";
      columns.push_back({.title = above + "\n" + values[value], .belongs_to_last = value > 0});
      width += columns.back().gap + width_of(values[value]);
    }
    const std::size_t of_name = columns.back().gap + width_of(variables[variable]);
    if (of_name > width) columns.back().width = width_of(values.back()) + of_name - width;
  }
  Table matrix(style, std::move(columns));
  std::vector<std::string> names;
  for (const BehaviorId behavior : table.behaviors()) {
    names.push_back(draw::label_of(catalog.name_of_behavior(behavior)));
  }
  names = shorten(std::move(names));
  for (std::size_t row = 0; row < names.size(); ++row) {
    Table::Row cells = {names[row]};
    for (const VariableValue value : table.values()) {
      cells.push_back(cell_of(table.fit(table.behaviors()[row], value), style));
    }
    matrix.add(std::move(cells));
  }
  return matrix.text_in_parts(1, std::string(1, sign_of(Fit::in_any)));
}

}  // namespace

std::string situation_text(const CompiledCatalog& catalog, const Style& style) {
  const SituationTable table(catalog);
  std::string text = style.paint(style.strong, printable(catalog.file)) + "\n";
  text += "  " + describe_size(catalog, table) + "\n";
  if (table.behaviors().empty()) return text;
  for (const std::string_view line : legend) text += fmt::format("    {}\n", line);
  text += matrix_of(catalog, table, style);
  const std::vector<std::string> gaps = describe_gaps(catalog, table);
  if (gaps.empty()) return text;
  text += fmt::format("\n{}\n", style.paint(style.strong, "tasks without a behavior that fits"));
  for (const std::string& line : gaps) text += "  " + line + "\n";
  return text;
}

namespace json::situation_view {

/// The table is the context.
constexpr auto value = object(
    "value", "",
    member("value", plain_value, "true and false for a variable that is declared without values.",
           std::identity()),
    member("fit", behaviors, "The behaviors that name the variable, and fit in this value.",
           [](VariableValue of, const SituationTable& table) {
             return table.behaviors_with(Fit::fits, of);
           }),
    member("do_not_fit", behaviors,
           "The behaviors that name the variable, and do not fit in this value.",
           [](VariableValue of, const SituationTable& table) {
             return table.behaviors_with(Fit::does_not_fit, of);
           }),
    member("tasks_without_behavior", tasks,
           "The tasks that have behaviors of which none fits in this value, whatever the other "
           "variables are.",
           [](VariableValue of, const SituationTable& table) {
             return table.tasks_without_behavior(of);
           }));

constexpr auto report = object(
    "",
    "The output of `cbc graph --view situation --format json` (schema cbc.situation/1): which "
    "behaviors fit in which values of the situation variables.",
    schema_member("cbc.situation/1"),
    member("catalog", any_text, "The catalog, as given.",
           [](const SituationTable& of) { return of.catalog().file; }),
    member("variables",
           list(object("variable", "", member("variable", variable, "", std::identity()),
                       member("values", list(value).at_least(2).on_lines(),
                              "The first one is the initial value.",
                              [](std::uint32_t of, const SituationTable& table) {
                                return table.values_of(of);
                              })))
               .on_lines(),
           "The situation variables, in catalog order.",
           [](const SituationTable& of) {
             return places_below(static_cast<std::uint32_t>(of.catalog().variables.size()));
           }),
    member("behaviors",
           list(object("behavior", "", member("behavior", behavior, "", std::identity()),
                       member("situation", conditions.not_empty(),
                              "For each variable that it names, the values in which it fits.",
                              [](BehaviorId of, const SituationTable& table) {
                                return by_variable(conditions_of(table.catalog(), of));
                              })))
               .on_lines(),
           "The behaviors that name situation variables, in catalog order.",
           &SituationTable::behaviors),
    member("unconditional", count,
           "Number of the behaviors that name no variable, and so fit in every situation.",
           &SituationTable::unconditional));

}  // namespace json::situation_view

std::string situation_json(const CompiledCatalog& catalog) {
  const SituationTable table(catalog);
  return json::document(json::situation_view::report, table, table);
}

std::string situation_schema() {
  return json::schema("situation", "Behaviors and situations", json::situation_view::report);
}

}  // namespace cbc
