#include "graph/report/together_report.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/report/event_json.h"
#include "core/report/reason_words.h"
#include "core/report/table.h"
#include "core/report/table_parts.h"
#include "core/support/json.h"
#include "core/support/wording.h"
#include "graph/engine/diagram.h"
#include "graph/report/palette.h"
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

/// The answer for two tasks, by their places in the table; `row` is greater than `column`.
class Matrix {
 public:
  explicit Matrix(const TogetherTable& table) : table_(table) {}

  [[nodiscard]] std::size_t size() const { return table_.tasks.size(); }
  [[nodiscard]] const TaskPair& at(std::size_t row, std::size_t column) const {
    // Before the pairs of a column come those of all columns before.
    const std::size_t before = column * (2 * size() - column - 1) / 2;
    return table_.pairs[before + row - column - 1];
  }

 private:
  const TogetherTable& table_;
};

/// Why a pair does not run together: sentences that lead from one task to the other.
std::vector<std::string> reasons_of(const CompiledCatalog& catalog, const TaskPair& pair) {
  if (pair.reasons.empty()) return {"the reasons would have taken too long to find"};
  std::vector<std::string> sentences;
  for (const Reason& reason : pair.reasons) {
    sentences.push_back(describe_reason(catalog, EventRecord(), reason));
  }
  return sentences;
}

/// The pairs whose exclusion no list says.
template <typename Action>
void for_each_indirect(const TogetherTable& table, const Action& action) {
  for (const TaskPair& pair : table.pairs) {
    if (pair.together != Together::possible && pair.together != Together::excluded &&
        pair.together != Together::undecided) {
      action(pair);
    }
  }
}

std::string list_names(const CompiledCatalog& catalog, const std::vector<TaskId>& tasks) {
  return join(tasks, ", ", [&](TaskId task) { return draw::label_of(catalog.name_of_task(task)); });
}

constexpr std::size_t columns_in_a_block = 5;

/// The matrix as text, in as many parts as it takes for its columns to fit.
class TextMatrix {
 public:
  TextMatrix(const CompiledCatalog& catalog, const TogetherTable& table, const Style& style)
      : matrix_(table), style_(style), digits_(std::to_string(table.tasks.size()).size()) {
    for (const TaskId task : table.tasks) {
      names_.push_back(draw::label_of(catalog.name_of_task(task)));
    }
    names_ = shorten(std::move(names_));
    for (const std::string& name : names_) name_width_ = std::max(name_width_, width_of(name));
  }

  std::string write() && {
    const std::size_t left = 2 + digits_ + 1 + name_width_ + 1;
    const std::size_t width = std::max(text_width, left + columns_in_a_block) - left;
    const std::size_t columns = matrix_.size() - 1;
    // A blank stands between each two blocks.
    std::size_t most = (width + 1) / (columns_in_a_block + 1) * columns_in_a_block;
    if (columns + (columns - 1) / columns_in_a_block <= width) most = columns;
    for (std::size_t first = 0; first + 1 < matrix_.size(); first += most) {
      add_part(first, std::min(first + most, matrix_.size() - 1));
    }
    return std::move(text_);
  }

 private:
  void add_part(std::size_t first, std::size_t end) {
    std::vector<Table::Column> columns = {number_column({}, digits_), {{}, {}, name_width_, 1}};
    for (std::size_t column = first; column < end; ++column) {
      const bool begins_block = (column - first) % columns_in_a_block == 0;
      columns.push_back({{}, {}, 1, begins_block ? std::size_t{1} : 0});
    }
    const Table table(style_, std::move(columns));
    text_ += '\n';
    for (std::size_t digit = 0; digit < digits_; ++digit) {
      Table::Row row = {"", ""};
      for (std::size_t column = first; column < end; ++column) {
        const std::string number = fmt::format("{:>{}}", column + 1, digits_);
        row.emplace_back(number[digit] == ' ' ? "" : number.substr(digit, 1));
      }
      text_ += table.line(row, style_.faint);
    }
    for (std::size_t row = first; row < matrix_.size(); ++row) {
      Table::Row cells = {row + 1, names_[row]};
      for (std::size_t column = first; column < std::min(row, end); ++column) {
        cells.push_back(cell(matrix_.at(row, column)));
      }
      text_ += table.line(cells);
    }
  }

  [[nodiscard]] Table::Cell cell(const TaskPair& pair) const {
    const std::string sign(1, sign_of(pair));
    if (pair.is_forbidden) return {sign, style_.error};
    switch (pair.together) {
      case Together::possible:
        return {sign, style_.good};
      case Together::undecided:
        return {sign, style_.warning};
      case Together::excluded:
        return {sign, style_.faint};
      default:
        return sign;
    }
  }

  const Matrix matrix_;
  const Style& style_;
  std::vector<std::string> names_;
  std::size_t name_width_ = 0;
  std::size_t digits_;
  std::string text_;
};

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
  if (table.tasks.size() > 1) text += TextMatrix(catalog, table, style).write();
  for_each_indirect(table, [&](const TaskPair& pair) {
    text += "\n" + style.paint(style.strong, list_names(catalog, {pair.first, pair.second})) + "\n";
    for (const std::string& reason : reasons_of(catalog, pair)) text += "  " + reason + "\n";
  });
  return text;
}

std::string together_json(const CompiledCatalog& catalog, const TogetherTable& table) {
  const auto write_names = [&](JsonWriter& json, std::string_view name, const auto& tasks) {
    json.write_list(name, tasks, [&](TaskId task) { json.write(catalog.name_of_task(task)); });
  };
  return json_line([&](JsonWriter& json) {
    json.write_members({{"schema", "cbc.together/1"}, {"catalog", catalog.file}});
    json.write("all_tasks", table.is_of_all_tasks);
    write_names(json, "tasks", table.tasks);
    write_names(json, "never_run", table.never_run);
    for (const Together together : answers) json.write(name_of(together), table.count(together));
    json.write("forbidden", table.count_forbidden());
    json.write_list("pairs", table.pairs, [&](const TaskPair& pair) {
      json.on_new_line().open('{');
      write_names(json, "tasks", std::array{pair.first, pair.second});
      json.write("together", name_of(pair.together));
      json.write("forbidden", pair.is_forbidden);
      json.write_list("reasons", pair.reasons, [&](const Reason& reason) {
        write_reason(json, catalog, EventRecord(), reason);
      });
      json.close('}');
    });
  });
}

namespace {

std::string_view color_of(const TaskPair& pair) {
  if (pair.is_forbidden) return palette::groups[2].fill;  // reddish purple
  switch (pair.together) {
    case Together::possible:
      return palette::groups[1].fill;  // bluish green
    case Together::excluded:
      return "#EEEEEE";
    case Together::excluded_indirectly:
      return palette::groups[0].fill;  // orange
    case Together::excluded_in_each_situation:
    case Together::excluded_by_situation:
      return palette::groups[3].fill;  // yellow
    case Together::undecided:
      break;
  }
  return palette::paper;
}

/// The matrix for DotTable.
std::vector<std::string> rows_of(const CompiledCatalog& catalog, const TogetherTable& table) {
  const Matrix matrix(table);
  std::vector<std::string> rows = {"<TD></TD>"};
  for (std::size_t column = 0; column + 1 < matrix.size(); ++column) {
    rows.front() += fmt::format("<TD>{}</TD>", column + 1);
  }
  for (std::size_t row = 0; row < matrix.size(); ++row) {
    std::string& cells = rows.emplace_back(DotTable::name_cell(fmt::format(
        "{} {}", row + 1, escape_html(draw::label_of(catalog.name_of_task(table.tasks[row]))))));
    for (std::size_t column = 0; column < row; ++column) {
      const TaskPair& pair = matrix.at(row, column);
      cells += DotTable::color_cell(color_of(pair), sign_of(pair));
    }
  }
  return rows;
}

}  // namespace

std::string together_dot(const CompiledCatalog& catalog, const TogetherTable& table) {
  DotTable dot("together", catalog, "which tasks can run together");
  if (table.tasks.size() > 1) dot.add_matrix(2, rows_of(catalog, table));
  if (table.is_of_all_tasks) dot.add_line(escape_html(size_of(table)));
  for (const std::string& line : legend_of(table)) dot.add_line(escape_html(line));
  if (!table.never_run.empty()) {
    dot.add_line(escape_html("can never run: " + list_names(catalog, table.never_run)));
  }
  for_each_indirect(table, [&](const TaskPair& pair) {
    std::string line =
        fmt::format("<B>{}</B>", escape_html(list_names(catalog, {pair.first, pair.second})));
    for (const std::string& reason : reasons_of(catalog, pair)) {
      line += "<BR ALIGN=\"LEFT\"/>   " + escape_html(reason);
    }
    dot.add_line(line + "<BR ALIGN=\"LEFT\"/>");
  });
  return std::move(dot).finish();
}

std::span<const TogetherFormat> together_formats() {
  using Compiled = const CompiledCatalog&;
  using Pairs = const TogetherTable&;
  constexpr auto as_dot = [](Compiled catalog, Pairs table, const Style& /*style*/) {
    return together_dot(catalog, table);
  };
  static constexpr TogetherFormat formats[] = {
      {"text", together_text},
      {"json", [](Compiled catalog, Pairs table,
                  const Style& /*style*/) { return together_json(catalog, table); }},
      {"dot", as_dot},
      {"svg", as_dot},
      {"png", as_dot},
      {"pdf", as_dot},
  };
  return formats;
}

}  // namespace cbc
