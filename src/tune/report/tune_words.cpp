#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/support/wording.h"
#include "core/words/explanation_words.h"
#include "core/words/move_words.h"
#include "runtime/base/text.h"
#include "tune/report/tune_report.h"
#include "versions/runs/run_comparison.h"

namespace cbc {
namespace {

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
  if (!difference.in_state->broken_property) return text;
  const PropertyFile& file = result.states->file;
  return text + fmt::format("; then the property in {}:{} does not hold", printable(file.path),
                            file.properties[*difference.in_state->broken_property].line);
}

}  // namespace

std::vector<std::string> moves_to(const TuneResult& result, const RunDifference& difference) {
  std::vector<std::string> moves;
  if (difference.in_state) {
    const Witness& path = difference.in_state->path;
    describe_moves(result.catalog, path.script, path.due, moves);
  }
  return moves;
}

std::string describe(const TuneResult& result, const RunDifference& difference) {
  if (difference.in_state) return describe_of_state(result, difference);
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

}  // namespace cbc
