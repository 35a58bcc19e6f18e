#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/files/missions.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "solve/engine/what_if.h"
#include "solve/report/what_if_report.h"
#include "solve/solve.h"

namespace cbc::cli {
namespace {

/// The mission has no such event, or its run ended before it. Returns the exit status.
int complain_of_event(const Mission& mission, const MomentSearch& search,
                      const CoordinatorOptions& options) {
  const std::string reason = describe_end(search.result, options);
  if (reason.empty()) {
    return complain("--after: script {} makes {} in all", quote(display_name(mission.script.file)),
                    quantity(search.result.events, "event"));
  }
  complain_of_run(mission, search.result, reason);
  return status_of(search.result);
}

}  // namespace

int solve_what_if(const SolveOptions& options) {
  for (const std::string& path : options.paths) {
    if (is_folder(path)) {
      return usage_error("solve", "--what-if: expected one mission, found the folder {}",
                         quote(path));
    }
  }
  MissionLoader loader;
  const std::optional<std::vector<Mission>> missions = loader.load(options.paths);
  if (!missions) return exit_unusable;
  if (missions->size() != 1) {
    return usage_error("solve", "--what-if: expected one mission, found {}", missions->size());
  }
  const Mission& mission = missions->front();
  const CompiledCatalog& catalog = *mission.catalog;
  CoordinatorOptions coordination = coordinator_options(options);
  coordination = options_of(mission.script, std::move(coordination));
  const MomentSearch search =
      find_moment(catalog, mission.script, coordination, options.what_if.after);
  if (!search.moment) return complain_of_event(mission, search, coordination);
  State state(catalog);
  state.restore(search.moment->snapshot);
  const WhatIfState of{catalog, mission.script, *search.moment, state};
  std::unique_ptr<WhatIfReport> report;
  if (options.format == "json") {
    report = std::make_unique<WhatIfJson>(of);
  } else {
    report = std::make_unique<WhatIfText>(of, style_for(stdout), columns_for(stdout));
  }
  const std::vector<Step> steps = list_moves(catalog, state, choice_of(catalog, mission.script));
  const RunResult result = try_moves(catalog, coordination, search.moment->snapshot, steps,
                                     [&report](const PossibleMove& move) { report->add(move); });
  if (const std::string reason = describe_end(result, coordination); !reason.empty()) {
    complain_of_run(mission, result, reason);
    return status_of(result);
  }
  fmt::print("{}", report->finish());
  return exit_ok;
}

}  // namespace cbc::cli
