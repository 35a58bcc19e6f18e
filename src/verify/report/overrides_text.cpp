// Who gives way to whom, for people.

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/report/table.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "verify/report/verify_report.h"

namespace cbc {
namespace {

/// By Override::Kind: its sign in the matrix, and what it says.
constexpr std::array<std::pair<char, std::string_view>, 6> legend = {{
    {'+', "both run, each with the behavior that it has alone"},
    {'o', "both run, one with another behavior than alone, none with a worse one"},
    {'w', "both run, one with a worse behavior than alone"},
    {'s', "the first one stops"},
    {'r', "the second one is rejected"},
    {'.', "the first one cannot start, or both are the same"},
}};

constexpr std::string_view how_to_read =
    "The task of the row is requested first, from idle, then that of the column: with the same, a "
    "higher, a lower priority.";

std::string title_of(const VerifyResult& result) {
  const std::string place = describe_part(*result.catalog, result.overrides->situation);
  return "who gives way to whom" + (place.empty() ? "" : " where " + place);
}

/// "ssr": a sign for each priority of the second request.
std::string signs_of(const OverrideMatrix::Cell& cell) {
  std::string signs;
  for (const Override& one : cell) signs += legend[static_cast<std::size_t>(one.kind)].first;
  return signs;
}

/// "SURVEY with WIDE in place of NARROW, LAND with ..."
std::string describe_changes(const CompiledCatalog& catalog, const Override& of) {
  return join(of.changes, ", ", [&](const Override::Change& change) {
    return fmt::format(
        "{} with {}", task_name(catalog, change.task),
        in_place_of(behavior_name(catalog, change.now), behavior_name(catalog, change.alone)));
  });
}

/// What changes in a cell, each with the priorities of the second request: "SURVEY with WIDE in
/// place of NARROW (same, higher)".
std::vector<std::string> changes_in(const CompiledCatalog& catalog,
                                    const OverrideMatrix::Cell& cell) {
  std::vector<std::pair<std::string, std::string>> found;  // changes and priorities
  for (std::size_t place = 0; place < cell.size(); ++place) {
    if (cell[place].changes.empty()) continue;
    const std::string changes = describe_changes(catalog, cell[place]);
    const std::string priority(name_of(static_cast<PriorityOfSecond>(place)));
    const auto known = std::find_if(found.begin(), found.end(),
                                    [&](const auto& one) { return one.first == changes; });
    if (known == found.end()) {
      found.emplace_back(changes, priority);
    } else {
      known->second += ", " + priority;
    }
  }
  std::vector<std::string> lines;
  lines.reserve(found.size());
  for (const auto& [changes, priorities] : found) {
    lines.push_back(fmt::format("{} ({})", changes, priorities));
  }
  return lines;
}

/// A line for each change of behaviors: "SURVEY, then LAND", and what changes.
Table table_of_changes(const VerifyResult& result, const Style& style) {
  const CompiledCatalog& catalog = *result.catalog;
  const OverrideMatrix& matrix = result.overrides->matrix;
  Table table(style, {{}, {}}, {.columns = text_width});
  for (std::size_t row = 0; row < matrix.row_count(); ++row) {
    for (std::size_t column = 0; column < matrix.tasks.size(); ++column) {
      for (const std::string& line : changes_in(catalog, matrix.at(row, column))) {
        table.add({fmt::format("{}, then {}", task_name(catalog, matrix.tasks[row]),
                               task_name(catalog, matrix.tasks[column])),
                   line});
      }
    }
  }
  return table;
}

/// The columns from `first` up to `end`, numbered as the rows are.
std::string part_of_matrix(const OverrideMatrix& matrix, const std::vector<std::string>& names,
                           std::size_t first, std::size_t end, const Style& style) {
  const std::size_t digits = std::to_string(names.size()).size();
  std::vector<Table::Column> columns = {number_column({}, digits), {{}, {}, 0, 1}};
  for (std::size_t column = first; column < end; ++column) {
    columns.push_back({std::to_string(column + 1), {}, priorities_of_second, 1});
  }
  Table table(style, std::move(columns));
  for (std::size_t row = 0; row < matrix.row_count(); ++row) {
    Table::Row cells = {row + 1, names[row]};
    for (std::size_t column = first; column < end; ++column) {
      cells.emplace_back(signs_of(matrix.at(row, column)));
    }
    table.add(std::move(cells));
  }
  return table.text();
}

void add_matrix(const VerifyResult& result, Text& text) {
  const OverrideMatrix& matrix = result.overrides->matrix;
  const auto names = shorten(names_of_tasks(*result.catalog, matrix.tasks));
  std::size_t width = 0;
  for (const std::string& name : names) width = std::max(width, width_of(name));
  const std::size_t digits = std::to_string(names.size()).size();
  const std::size_t of_column = 1 + std::max(priorities_of_second, digits);
  const std::size_t left = 2 + digits + 1 + width;
  const std::size_t most = left + of_column > text_width ? 1 : (text_width - left) / of_column;
  for (std::size_t first = 0; first < names.size(); first += most) {
    text.line("");
    text.add(
        part_of_matrix(matrix, names, first, std::min(first + most, names.size()), text.style()));
  }
}

}  // namespace

void add_overrides(const VerifyResult& result, Text& text) {
  text.add(wrap_line(title_of(result), text_width, 2) + "\n");
  add_matrix(result, text);
  if (!result.overrides->matrix.complete) {
    text.painted(text.style().warning, "a limit ended the search, so rows are missing");
  }
  text.line("");
  text.add(wrap_line(how_to_read, text_width, 0) + "\n");
  for (const auto& [sign, meaning] : legend) text.line("  {}  {}", sign, meaning);
  const std::string changes = table_of_changes(result, text.style()).text();
  if (changes.empty()) return;
  text.title("other behaviors");
  text.add(changes);
}

}  // namespace cbc
