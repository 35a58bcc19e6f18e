#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "core/words/explanation_words.h"
#include "core/words/move_words.h"
#include "core/words/words.h"
#include "runtime/base/text.h"
#include "tune/report/tune_report.h"
#include "versions/runs/run_comparison.h"

namespace cbc {
namespace {

std::string lines_of(const std::vector<std::uint32_t>& lines) {
  return join(lines, ", ", [](std::uint32_t line) { return std::to_string(line); });
}

/// "the numbers in lines 6, 12"; line 0 stands for the default that is written nowhere.
std::string numbers_in(const std::vector<std::uint32_t>& lines) {
  if (lines == std::vector<std::uint32_t>{0}) return "the default suitability";
  if (lines.back() == 0) {
    return numbers_in({lines.begin(), lines.end() - 1}) + " and the default suitability";
  }
  return (lines.size() == 1 ? "the number in line " : "the numbers in lines ") + lines_of(lines);
}

/// What is decided in place of what, "in the words of solve".
std::string describe_instead(const TuneResult& result, const RunDifference& difference) {
  if (!difference.before) return "it happens";
  if (!difference.now) return "it does not happen";
  const auto& [before, now] = std::pair(*difference.before, *difference.now);
  const auto what = [](const EventRecord& of) {
    return std::tuple(of.time, of.origin, of.verb, of.task, of.behavior);
  };
  if (what(before) != what(now)) return "in place of " + place_of(result.catalog, before);
  std::vector<std::string> parts;
  if (before.outcome != now.outcome) {
    parts.push_back(in_place_of(name_of(now.outcome), name_of(before.outcome)));
  }
  const auto name = [&](BehaviorId behavior) {
    return behavior == none ? std::string_view() : result.catalog.name_of_behavior(behavior);
  };
  constexpr std::size_t most_shown = 3;
  const std::size_t shown = std::min(difference.moves.size(), most_shown);
  for (const ValueChange& move : std::span(difference.moves).first(shown)) {
    parts.push_back(task_in_place_of(result.catalog.name_of_task(move.task), name(move.now),
                                     name(move.before)));
  }
  if (parts.empty()) return "other changes on the way to the same";
  const std::size_t others = difference.moves.size() - shown;
  return join(parts, ", ") + (others > 0 ? fmt::format(" and {} more", others) : "");
}

/// The event, after the moves that lead to it, and what it does in place of what.
std::string describe_of_state(const TuneResult& result, const RunDifference& difference) {
  std::string text =
      join(moves_to(result, difference), ", then ") + ": " + describe_instead(result, difference);
  if (!difference.broken_property) return text;
  const PropertyFile& file = result.states->file;
  return text + fmt::format("; then the property in {}:{} does not hold", printable(file.path),
                            file.properties[*difference.broken_property].line);
}

/// "mission.yaml:3, 8; other.yaml:12": what a repair changes.
std::string describe_changed(const TuneResult& result, const NumberRepair& repair) {
  std::vector<std::string> parts;
  for (std::size_t mission = 0; mission < repair.changed.size(); ++mission) {
    if (repair.changed[mission].empty()) continue;
    parts.push_back(fmt::format("{}:{}", printable(result.missions[mission]),
                                lines_of(repair.changed[mission])));
  }
  return join(parts, "; ");
}

}  // namespace

std::vector<std::string> moves_to(const TuneResult& result, const RunDifference& difference) {
  std::vector<std::string> moves;
  if (const auto& path = difference.path) {
    describe_moves(result.catalog, path->script, path->due, moves);
  }
  return moves;
}

std::string describe(const Interval& values) {
  const std::string low = format_decimal(values.low, 4);
  return values.low == values.high ? low : low + " to " + format_decimal(values.high, 4);
}

std::string describe(const TuneResult& result, const RunDifference& difference) {
  if (difference.path) return describe_of_state(result, difference);
  const auto place = [&](std::size_t mission, std::uint32_t line) {
    const std::string file = printable(result.missions[mission]);
    return line == 0 ? file : fmt::format("{}:{}", file, line);
  };
  const EventRecord& event = difference.now ? *difference.now : *difference.before;
  std::string text =
      fmt::format("{}: {}: {}", place(difference.mission, difference.line),
                  place_of(result.catalog, event), describe_instead(result, difference));
  if (const auto& failure = difference.failure) {
    text += fmt::format("; then the expectation in {} fails",
                        place(failure->mission, failure->expectation.range.begin.line));
  }
  return text;
}

std::string describe(const TuneResult& result, const Recording::Failure& failure) {
  return fmt::format(
      "{}: {}",
      format_place(printable(result.missions[failure.mission]), failure.expectation.range.begin),
      failure.expectation.message);
}

std::vector<FoundRepair> nearest_repairs(const TuneResult& result) {
  std::vector<FoundRepair> found;
  for (std::size_t number = 0; number < result.numbers.size(); ++number) {
    const Millionths value = result.numbers[number].value;
    const auto change = [&](const NumberRepair& repair) {
      return std::max(value, repair.nearest) - std::min(value, repair.nearest);
    };
    const auto& intervals = result.tuned[number].repairs.intervals;
    const auto nearest = std::min_element(
        intervals.begin(), intervals.end(),
        [&](const NumberRepair& a, const NumberRepair& b) { return change(a) < change(b); });
    if (nearest != intervals.end()) found.push_back({number, &*nearest, change(*nearest)});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const FoundRepair& a, const FoundRepair& b) { return a.change < b.change; });
  return found;
}

std::string line_of(const TunableNumber& number) {
  return number.range ? std::to_string(number.line()) : "-";
}

std::string describe_repairs(const TuneResult& result) {
  if (!nearest_repairs(result).empty()) {
    return "each of these numbers alone makes all expectations hold";
  }
  const bool is_complete =
      std::all_of(result.tuned.begin(), result.tuned.end(),
                  [](const TunedNumber& one) { return one.repairs.is_complete; });
  return is_complete ? "no number alone makes all expectations hold, whatever its value"
                     : "none was found, but the numbers were not searched to the end";
}

Table repairs_table(const TuneResult& result, const Style& style, std::size_t columns) {
  Table table(style,
              {number_column("line", 4),
               {"number"},
               number_column("value"),
               number_column("nearest"),
               {"of"},
               {"changes"}},
              {.columns = columns});
  for (const auto& [number, repair, change] : nearest_repairs(result)) {
    const TunableNumber& of = result.numbers[number];
    table.add({line_of(of),
               describe(of, result.source),
               format_decimal(of.value, 4),
               {format_decimal(repair->nearest, 4), style.good},
               join(result.tuned[number].repairs.intervals, "; ",
                    [](const NumberRepair& one) { return describe(one.values); }),
               describe_changed(result, *repair)});
  }
  return table;
}

std::vector<std::string> describe_unaffected(const TuneResult& result) {
  std::size_t unaffected = 0;
  std::vector<std::uint32_t> unused;
  std::vector<std::uint32_t> undecisive;
  for (std::size_t number = 0; number < result.numbers.size(); ++number) {
    const TunableNumber& of = result.numbers[number];
    if (of.uses.empty()) {
      unused.push_back(of.line());
    } else if (!result.tuned[number].is_used) {
      undecisive.push_back(of.line());
    } else if (!result.tuned[number].tolerance.distance(of.value)) {
      ++unaffected;
    }
  }
  std::vector<std::string> lines;
  if (unaffected > 0) {
    lines.push_back(
        fmt::format("{} may have any value from 0 to 100", quantity(unaffected, "number")));
  }
  if (!unused.empty()) lines.push_back("nothing has " + numbers_in(unused));
  if (!undecisive.empty()) {
    lines.push_back("no decision of any state uses " + numbers_in(undecisive));
  }
  return lines;
}

std::vector<std::size_t> fragile_first(const TuneResult& result) {
  std::vector<std::pair<Millionths, std::size_t>> found;
  for (std::size_t number = 0; number < result.numbers.size(); ++number) {
    const auto distance = result.tuned[number].tolerance.distance(result.numbers[number].value);
    if (distance) found.emplace_back(*distance, number);
  }
  std::sort(found.begin(), found.end());
  std::vector<std::size_t> numbers;
  numbers.reserve(found.size());
  for (const auto& [distance, number] : found) numbers.push_back(number);
  return numbers;
}

}  // namespace cbc
