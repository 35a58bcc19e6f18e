
#include <fmt/core.h>

#include "core/command_line/command_line.h"
#include "core/files/missions.h"
#include "core/files/output.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "tune/engine/tuner.h"
#include "tune/report/tune_report.h"
#include "tune/tune.h"
#include "tune/tune_steps.h"
#include "tune/write_number.h"

namespace cbc::cli {
namespace {

/// Whether there is one catalog, with numbers to change.
bool can_tune(const std::vector<Mission>& missions) {
  const Mission& first = missions.front();
  for (const Mission& mission : missions) {
    if (mission.catalog == first.catalog) continue;
    complain("the scripts have the catalogs {} and {}; tune one at a time",
             quote(first.catalog->file), quote(mission.catalog->file));
    return false;
  }
  return has_numbers(*first.source);
}

/// Writes the repair that changes least.
int write_repair(const TuneResult& result, const CheckedCatalog& source, const Missions& missions) {
  const std::vector<FoundRepair> found = nearest_repairs(result);
  if (found.empty()) {
    fmt::print("nothing is written: no number makes all expectations hold\n");
    return exit_no;
  }
  const TunableNumber& number = result.numbers[found.front().number];
  const Millionths value = found.front().repair->nearest;
  const int status = write_number(source, number, value, missions);
  if (status != exit_ok) return status;
  fmt::print("{}:{}: {} is now {}; all expectations hold\n", printable(result.source.file),
             number.line(), describe(number, result.source), format_decimal(value, 4));
  return exit_ok;
}

}  // namespace

int tune(const TuneOptions& options) {
  if (options.all_states) return tune_states(options);
  if (options.paths.empty()) return usage_error("tune", "expected a catalog and a script");
  MissionLoader loader;
  const std::optional<std::vector<Mission>> missions = loader.load(options.paths);
  if (!missions) return report_unreadable("cbc tune", options.format, "-", loader.findings());
  if (!can_tune(*missions)) return exit_unusable;
  const CheckedCatalog& source = *missions->front().source;
  const auto numbers = choose_numbers(source.reading, options.only);
  if (!numbers || (options.html && !can_write_output(*options.html))) return exit_unusable;
  Missions scripts;
  for (const Mission& mission : *missions) scripts.push_back(&mission.script);
  const Tuner tuner(source.reading.catalog, *numbers, scripts, degree_of(options.margin));
  if (tuner.present().status != Coordinator::Status::ok) {
    return complain("{}: the clock made more than {} events",
                    quote(scripts[tuner.present().events.size() - 1]->file), most_clock_events);
  }
  TuneResult result = begin_result(source, *numbers, tuner.present(), options);
  for (const Script* const script : scripts) result.missions.push_back(script->file);
  result.tuned = for_each_number("tuning", result, options, [&](std::size_t number) {
    return TunedNumber{tuner.tolerance(number), tuner.repairs(number),
                       !(*numbers)[number].uses.empty()};
  });
  if (const int status = write_reports(result, options); status != exit_ok) return status;
  const bool is_to_be_repaired = options.write && !result.present.failures.empty();
  return is_to_be_repaired ? write_repair(result, source, scripts) : status_of(result);
}

}  // namespace cbc::cli
