// What events can come to, for people.

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/report/table.h"
#include "core/support/wording.h"
#include "core/words/words.h"
#include "runtime/base/text.h"
#include "verify/report/verify_report.h"

namespace cbc {
namespace {

/// "DRIVE: CREEP, WATCH: CAMERA"
std::string name_running(const CompiledCatalog& catalog, const ReachableOutcome& outcome) {
  if (outcome.running.empty()) return "nothing";
  return join(outcome.running, ", ", [&](const auto& running) {
    return fmt::format("{}: {}", printable(catalog.task_names[running.first]),
                       printable(catalog.behavior_names[running.second]));
  });
}

/// What is not as it was at first: "PEOPLE is near and LIDAR is faulty". Empty: there is nothing.
std::string describe_change(const CompiledCatalog& catalog, const Assumptions& assumptions,
                            const ReachableOutcome& outcome) {
  std::vector<std::string> words;
  for (const VariableValue& value : outcome.situation.variables) {
    if (value.value == initial_value(assumptions, value.variable)) continue;
    words.push_back(describe_value(catalog, value));
  }
  for (const auto& [behavior, available] : outcome.situation.behaviors) {
    if (available == is_available_at_first(assumptions, behavior)) continue;
    words.push_back(fmt::format("{} is {}", behavior_name(catalog, behavior),
                                available ? "available" : "unavailable"));
  }
  for (const BehaviorId behavior : outcome.faulty) {
    words.push_back(behavior_name(catalog, behavior) + " is faulty");
  }
  return list_with_and(words);
}

}  // namespace

void add_outcomes(const CompiledCatalog& catalog, const Assumptions& assumptions,
                  const std::vector<ReportedOutcome>& outcomes, Text& text) {
  if (outcomes.empty()) {
    text.line("");
    return text.line("  none: reactive tasks are about to start in every state that was visited");
  }
  Table table(text.style(), {number_column("outcome"), number_column("events"), {"what runs"}},
              {.columns = text_width, .breaks = Breaks::after_commas});
  for (const ReportedOutcome& reported : outcomes) {
    const ReachableOutcome& outcome = *reported.outcome;
    table.add({reported.number,
               outcome.script.size(),
               {name_running(catalog, outcome), text.style().strong}});
    const std::string change = describe_change(catalog, assumptions, outcome);
    if (!change.empty()) table.add({"", "", "where " + change});
    if (!reported.moves.empty()) {
      table.add({"", "", {"after " + join(reported.moves, ", then "), text.style().faint}});
    }
  }
  text.line("");
  text.add(table.text());
  const auto& first = outcomes.front().script_path;
  if (!first) return;
  const auto& last = outcomes.back().script_path;
  text.line("");
  text.line("scripts: {}{}", printable(*first), first == last ? "" : " to " + printable(*last));
}

void add_how_to_read_outcomes(Text& text) {
  constexpr std::string_view how_to_read =
      "An outcome is shown with the first of the shortest sequences of events that lead to it; "
      "'where' names what is not as at first then.";
  text.line("");
  text.paragraph(how_to_read);
}

}  // namespace cbc
