#include "cli/graph_state.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "cli/exit_status.h"
#include "cli/input.h"
#include "cli/mission.h"
#include "cli/run_end.h"
#include "cli/validators.h"
#include "cli/value_kind.h"
#include "draw/state_marks.h"
#include "report/state_recorder.h"
#include "script/runner.h"
#include "text/decimal.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

/// The one script, with its catalog.
std::optional<Mission> load_mission(const std::string& catalog, const std::string& script) {
  std::vector<std::string> paths;
  if (!catalog.empty()) paths.push_back(catalog);
  paths.push_back(script);
  for (const std::string& path : paths) {
    if (!is_folder(path)) continue;
    complain(fmt::format("cannot read {}: it is a folder", quote(path)));
    return std::nullopt;
  }
  std::optional<std::vector<Mission>> missions = MissionLoader().load(paths);
  if (!missions) return std::nullopt;
  if (missions->size() > 1) {
    complain(fmt::format("{} is a script; expected a catalog here (a script goes after --script)",
                         quote(display_name(catalog))));
    return std::nullopt;
  }
  return std::move(missions->front());
}

Microseconds end_of(const Script& script) {
  Microseconds end = 0;
  for (const Step& step : script.steps) end = step.time.value_or(end);
  return end;
}

WantedState wanted_state(const StateOptions& options) {
  WantedState wanted;
  wanted.index = options.after;
  if (!options.at.empty()) wanted.time = parse_seconds(options.at).value;
  return wanted;
}

/// Why a run that came to its end has no such state, or empty.
std::string find_miss(const Script& script, const WantedState& wanted, std::uint64_t events) {
  if (wanted.index && *wanted.index > events) {
    return fmt::format("--after: script {} makes {} {} in all", quote(script.file), events,
                       events == 1 ? "event" : "events");
  }
  if (wanted.time && *wanted.time > end_of(script)) {
    return fmt::format("--at: script {} ends at {} s", quote(script.file),
                       format_decimal(end_of(script), 6));
  }
  return {};
}

}  // namespace

void add_state_options(CLI::App& command, StateOptions& options) {
  command
      .add_option("--script", options.script,
                  "Run this event script, and mark what runs at its end: running tasks and active "
                  "behaviors, and what the last event changed. It may name the catalog (catalog: "
                  "FILE)")
      ->option_text("SCRIPT")
      ->check(stands_for(ValueKind::script));
  command
      .add_option("--after", options.after,
                  "Of --script: mark what runs after the Nth event that 'cbc solve' lists (0: "
                  "before the first)")
      ->option_text("N")
      ->check(whole_number(0));
  command.add_option("--at", options.at, "Of --script: mark what runs after this time")
      ->option_text("SECONDS")
      ->check(seconds(0));
}

std::string find_misuse(const StateOptions& options) {
  if (options.after && !options.at.empty()) return "--after and --at do not go together";
  if (options.script) return {};
  if (options.after) return "--after goes with --script only";
  if (!options.at.empty()) return "--at goes with --script only";
  return {};
}

std::unique_ptr<Drawable> read_state(const std::string& catalog, const StateOptions& options,
                                     int& status) {
  status = exit_unusable;
  std::optional<Mission> mission = load_mission(catalog, *options.script);
  if (!mission) return nullptr;
  const WantedState wanted = wanted_state(options);
  CoordinatorOptions coordination;
  coordination.find_conflicts = false;
  StateRecorder recorder(*mission->catalog, mission->script, wanted);
  const RunResult result = run_script(*mission->catalog, mission->script, coordination, recorder);
  if (!recorder.has_passed()) {
    std::string problem = describe_end(result, coordination);
    if (problem.empty()) problem = find_miss(mission->script, wanted, recorder.events());
    if (!problem.empty()) {
      complain(problem);
      status = std::max<int>(exit_unusable, status_of(result));
      return nullptr;
    }
  }
  auto state = std::make_unique<Drawable>();
  state->graph = draw::to_graph(*mission->catalog);
  draw::mark_state(state->graph, recorder.state());
  state->moment = recorder.moment();
  state->named_catalog = std::move(mission->named_catalog);
  state->compiled = std::move(mission->catalog);
  return state;
}

}  // namespace cbc::cli
