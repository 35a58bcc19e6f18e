#include "graph/report/situation_report.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/report/catalog_json.h"
#include "core/report/catalog_words.h"
#include "core/report/table.h"
#include "core/report/table_parts.h"
#include "core/support/json.h"
#include "core/support/wording.h"
#include "graph/engine/diagram.h"
#include "graph/report/palette.h"
#include "runtime/base/text.h"

namespace cbc {
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
    const std::string names = join(table.tasks_without_behavior(value), ", ", [&](TaskId task) {
      return draw::label_of(catalog.name_of_task(task));
    });
    if (!names.empty()) lines.push_back(describe_value(catalog, value) + ": " + names);
  }
  return lines;
}

constexpr std::string_view gaps_title = "tasks without a behavior that fits";

constexpr std::string_view column_gap = "  ";

/// The rows and columns as text, in as many parts as it takes for the columns to fit. A part has
/// the rows of the behaviors that name one of its variables.
class TextTable {
 public:
  TextTable(const CompiledCatalog& catalog, const SituationTable& table, const Style& style)
      : catalog_(catalog), table_(table), style_(style) {
    for (const BehaviorId behavior : table.behaviors()) {
      names_.push_back(draw::label_of(catalog.name_of_behavior(behavior)));
    }
    names_ = shorten(std::move(names_));
    for (const std::string& name : names_) left_ = std::max(left_, width_of(name));
    left_ += column_gap.size();
    for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
      variables_.push_back(draw::label_of(catalog.name_of_variable(variable)));
      std::vector<std::string>& titles = titles_.emplace_back();
      for (std::uint32_t value = 0; value < catalog.variables[variable].value_count; ++value) {
        titles.push_back(draw::label_of(catalog.name_of_value({variable, value})));
      }
      titles = shorten(std::move(titles));
    }
    variables_ = shorten(std::move(variables_));
  }

  std::string write() && {
    std::size_t width = left_;
    for (std::uint32_t variable = 0; variable < catalog_.variables.size(); ++variable) {
      const std::vector<VariableValue> values = table_.values_of(variable);
      std::size_t together = 0;
      for (const VariableValue value : values) {
        together += column_gap.size() + width_of(title_of(value));
      }
      together = std::max(together, column_gap.size() + width_of(name_of(variable)));
      // A variable stays in one part if it can.
      if (width + together > text_width) flush(width);
      for (const VariableValue value : values) {
        std::size_t column = width_of(title_of(value));
        if (width + column_gap.size() + column > text_width) flush(width);
        // The name of the variable stands above its first value.
        if (values_.empty() || values_.back().variable != variable) {
          name_end_ = width + column_gap.size() + width_of(name_of(variable));
        }
        if (value == values.back() && width + column_gap.size() + column < name_end_) {
          column = name_end_ - width - column_gap.size();
        }
        values_.push_back(value);
        widths_.push_back(column);
        width += column_gap.size() + column;
      }
    }
    flush(width);
    return std::move(text_);
  }

 private:
  [[nodiscard]] const std::string& name_of(std::uint32_t variable) const {
    return variables_[variable];
  }
  [[nodiscard]] const std::string& title_of(VariableValue value) const {
    return titles_[value.variable][value.value];
  }

  /// Writes the columns that have been collected.
  void flush(std::size_t& width) {
    if (!values_.empty()) add_part();
    values_.clear();
    widths_.clear();
    width = left_;
  }

  void add_part() {
    std::vector<Table::Column> columns = {{{}, {}, left_ - column_gap.size()}};
    Table::Row variables = {""};
    Table::Row titles = {""};
    for (std::size_t column = 0; column < values_.size(); ++column) {
      const VariableValue value = values_[column];
      const bool is_first = column == 0 || values_[column - 1].variable != value.variable;
      columns.push_back({{}, {}, widths_[column]});
      variables.emplace_back(is_first ? name_of(value.variable) : std::string());
      titles.emplace_back(title_of(value));
    }
    const Table table(style_, std::move(columns));
    text_ += "\n" + table.line(variables, style_.strong) + table.line(titles, style_.faint);
    for (std::size_t row = 0; row < names_.size(); ++row) {
      Table::Row cells = {names_[row]};
      bool names_any = false;
      for (const VariableValue value : values_) {
        const Fit fit = table_.fit(table_.behaviors()[row], value);
        names_any = names_any || fit != Fit::in_any;
        cells.emplace_back(std::string(1, sign_of(fit)), color_of(fit));
      }
      if (names_any) text_ += table.line(cells);
    }
  }

  [[nodiscard]] std::string_view color_of(Fit fit) const {
    if (fit == Fit::in_any) return style_.faint;
    return fit == Fit::fits ? style_.good : style_.bad;
  }

  const CompiledCatalog& catalog_;
  const SituationTable& table_;
  const Style& style_;
  std::vector<std::string> names_;
  std::vector<std::string> variables_;            ///< their names
  std::vector<std::vector<std::string>> titles_;  ///< of their values
  std::size_t left_ = 0;                          ///< width of the names
  std::vector<VariableValue> values_;
  std::vector<std::size_t> widths_;
  std::size_t name_end_ = 0;
  std::string text_;
};

}  // namespace

std::optional<std::string> find_too_large_situation(const CompiledCatalog& catalog) {
  constexpr std::uint64_t most_cells = 4'000'000;
  const SituationTable table(catalog);
  std::uint64_t values = 0;
  for (const CompiledVariable& variable : catalog.variables) values += variable.value_count;
  const std::uint64_t behaviors = table.behaviors().size();
  if (behaviors * values <= most_cells) return std::nullopt;
  return fmt::format(
      "catalog {} is too large for a table of its situation: {} behaviors by {} values; expected "
      "at most {} places",
      quote(catalog.file), behaviors, values, most_cells);
}

std::string situation_text(const CompiledCatalog& catalog, const Style& style) {
  const SituationTable table(catalog);
  std::string text = style.paint(style.strong, printable(catalog.file)) + "\n";
  text += "  " + describe_size(catalog, table) + "\n";
  if (table.behaviors().empty()) return text;
  for (const std::string_view line : legend) text += fmt::format("    {}\n", line);
  text += TextTable(catalog, table, style).write();
  const std::vector<std::string> gaps = describe_gaps(catalog, table);
  if (gaps.empty()) return text;
  text += fmt::format("\n{}\n", style.paint(style.strong, gaps_title));
  for (const std::string& line : gaps) text += "  " + line + "\n";
  return text;
}

std::string situation_json(const CompiledCatalog& catalog) {
  const SituationTable table(catalog);
  return json_line([&](JsonWriter& json) {
    const auto write_behavior = [&](BehaviorId behavior) {
      json.write(catalog.name_of_behavior(behavior));
    };
    json.write_members({{"schema", "cbc.situation/1"}, {"catalog", catalog.file}});
    json.open("variables", '[');
    for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
      json.on_new_line().open('{');
      json.write("variable", catalog.name_of_variable(variable));
      json.write_list("values", table.values_of(variable), [&](VariableValue value) {
        json.on_new_line().open('{');
        json.key("value");
        write_plain_value(json, catalog, value);
        json.write_list("fit", table.behaviors_with(Fit::fits, value), write_behavior);
        json.write_list("do_not_fit", table.behaviors_with(Fit::does_not_fit, value),
                        write_behavior);
        json.write_list("tasks_without_behavior", table.tasks_without_behavior(value),
                        [&](TaskId task) { json.write(catalog.name_of_task(task)); });
        json.close('}');
      });
      json.close('}');
    }
    json.close(']');
    json.write_list("behaviors", table.behaviors(), [&](BehaviorId behavior) {
      json.on_new_line().open('{');
      json.write("behavior", catalog.name_of_behavior(behavior));
      write_conditions(json, conditions_of(catalog, behavior));
      json.close('}');
    });
    json.write("unconditional", table.unconditional());
  });
}

namespace {

std::string_view color_of(Fit fit) {
  switch (fit) {
    case Fit::fits:
      return palette::groups[1].fill;  // bluish green
    case Fit::does_not_fit:
      return palette::groups[0].fill;  // orange
    case Fit::in_any:
      break;
  }
  return palette::paper;
}

/// A text that the catalog gives.
std::string html_label(std::string_view text) { return escape_html(draw::label_of(text)); }

/// The rows and columns for DotTable.
std::vector<std::string> matrix_of(const CompiledCatalog& catalog, const SituationTable& table) {
  std::string variables = "<TD></TD>";
  for (std::uint32_t variable = 0; variable < catalog.variables.size(); ++variable) {
    variables +=
        fmt::format("<TD COLSPAN=\"{}\"><B>{}</B></TD>", catalog.variables[variable].value_count,
                    html_label(catalog.name_of_variable(variable)));
  }
  std::string titles = "<TD></TD>";
  const std::vector<VariableValue> values = table.values();
  for (const VariableValue value : values) {
    titles += fmt::format("<TD>{}</TD>", html_label(catalog.name_of_value(value)));
  }
  std::vector<std::string> rows = {variables, titles};
  for (const BehaviorId behavior : table.behaviors()) {
    std::string& row =
        rows.emplace_back(DotTable::name_cell(html_label(catalog.name_of_behavior(behavior))));
    for (const VariableValue value : values) {
      const Fit fit = table.fit(behavior, value);
      row += DotTable::color_cell(color_of(fit), sign_of(fit));
    }
  }
  return rows;
}

}  // namespace

std::string situation_dot(const CompiledCatalog& catalog) {
  const SituationTable table(catalog);
  DotTable dot("situation", catalog, describe_size(catalog, table));
  if (!table.behaviors().empty()) {
    dot.add_matrix(3, matrix_of(catalog, table));
    for (const std::string_view line : legend) dot.add_line(escape_html(line));
  }
  const std::vector<std::string> gaps = describe_gaps(catalog, table);
  if (!gaps.empty()) dot.add_line(fmt::format("<B>{}</B>", gaps_title));
  for (const std::string& line : gaps) dot.add_line(escape_html(line));
  return std::move(dot).finish();
}

std::span<const SituationFormat> situation_formats() {
  constexpr auto as_dot = [](const CompiledCatalog& catalog, const Style& /*style*/) {
    return situation_dot(catalog);
  };
  static constexpr SituationFormat formats[] = {
      {"text", situation_text},
      {"json", [](const CompiledCatalog& catalog,
                  const Style& /*style*/) { return situation_json(catalog); }},
      {"dot", as_dot},
      {"svg", as_dot},
      {"png", as_dot},
      {"pdf", as_dot},
  };
  return formats;
}

}  // namespace cbc
