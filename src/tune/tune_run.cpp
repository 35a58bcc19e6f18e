#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/core.h>

#include "core/command_line/command_line.h"
#include "core/files/missions.h"
#include "core/files/ordered_work.h"
#include "core/files/output.h"
#include "core/report/test_report.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "tune/engine/numbers.h"
#include "tune/engine/tuner.h"
#include "tune/report/tune_report.h"
#include "tune/tune.h"
#include "tune/write_number.h"

namespace cbc::cli {
namespace {

Millionths degree_of(const std::string& percentage) {
  constexpr Millionths tenth_of_a_percent = 1000;
  return static_cast<Millionths>(tenths_in(percentage)) * tenth_of_a_percent;
}

/// Whether there is one catalog, with numbers to change.
bool can_tune(const std::vector<Mission>& missions) {
  const Mission& first = missions.front();
  for (const Mission& mission : missions) {
    if (mission.catalog == first.catalog) continue;
    complain("the scripts have the catalogs {} and {}; tune one at a time",
             quote(first.catalog->file), quote(mission.catalog->file));
    return false;
  }
  if (first.source->text != nullptr) return true;
  complain("the catalog {} was compiled; expected the YAML, which has the numbers",
           quote(first.catalog->file));
  return false;
}

/// The numbers that --only names. Empty if it names something else, which is printed.
std::optional<std::vector<TunableNumber>> choose_numbers(const CatalogReading& reading,
                                                         const std::vector<std::string>& only) {
  std::vector<TunableNumber> numbers = find_numbers(reading);
  if (only.empty()) return numbers;
  const Catalog& catalog = reading.catalog;
  std::vector<std::string> known;
  std::vector<std::string_view> names;
  std::vector<TunableNumber> chosen;
  for (TunableNumber& number : numbers) {
    bool is_chosen = false;
    for (const TunableNumber::Use& use : number.uses) {
      if (use.behavior == none) continue;
      known.push_back(catalog.behaviors[use.behavior].name + ":" + catalog.tasks[use.task].name);
      is_chosen |= std::find(only.begin(), only.end(), known.back()) != only.end();
    }
    if (is_chosen) chosen.push_back(std::move(number));
  }
  for (const std::string& name : known) names.push_back(name);
  for (const std::string& name : only) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    complain("--only: catalog {} has no number of {}{}", quote(catalog.file), quote(name),
             did_you_mean(nearest(name, names)));
    return std::nullopt;
  }
  return chosen;
}

/// Makes an item for each number, several at once. A terminal shows the progress.
template <typename Make>
auto for_each_number(std::string what, const TuneResult& result, const TuneOptions& options,
                     const Make& make) {
  using Item = decltype(make(0));
  constexpr std::chrono::milliseconds between_looks(100);
  std::vector<Item> items;
  Progress progress(std::move(what), result.numbers.size());
  OrderedWork<Item> work(result.numbers.size(), thread_count(options.jobs), make);
  for (const TunableNumber& number : result.numbers) {
    progress.begin(describe(number, result.source));
    while (!work.wait_for(between_looks)) progress.show();
    items.push_back(work.take());
  }
  return items;
}

void try_pairs(const Tuner& tuner, const TuneOptions& options, TuneResult& result) {
  std::vector<PairRepair>& pairs = result.pairs.emplace();
  const auto found = for_each_number("trying pairs with", result, options, [&](std::size_t number) {
    return tuner.repairs_of_pairs(number);
  });
  for (const auto& of_number : found) pairs.insert(pairs.end(), of_number.begin(), of_number.end());
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const PairRepair& a, const PairRepair& b) { return a.change < b.change; });
  std::set<std::pair<std::size_t, std::size_t>> known;
  std::erase_if(pairs, [&](const PairRepair& pair) {
    return !known.insert(std::minmax(pair.first, pair.second)).second;
  });
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

int status_of(const TuneResult& result) {
  std::size_t fragile = 0;
  for (std::size_t number = 0; number < result.numbers.size(); ++number) {
    if (result.is_fragile(number)) ++fragile;
  }
  if (fragile > 0) {
    complain("{} may be wrong by less than {} (--fail-under)", quantity(fragile, "number"),
             format_decimal(*result.fail_under, 4));
  }
  return fragile > 0 || !result.present.failures.empty() ? exit_no : exit_ok;
}

}  // namespace

int tune(const TuneOptions& options) {
  if (options.paths.empty()) return usage_error("tune", "expected a catalog and a script");
  MissionLoader loader;
  const std::optional<std::vector<Mission>> missions = loader.load(options.paths);
  if (!missions) {
    if (options.format == "junit") {  // a missing report could be taken for one without failures
      fmt::print("{}", unreadable_to_text(junit_format, "cbc tune", loader.findings()));
    }
    return exit_unusable;
  }
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
  TuneResult result{
      source.reading.catalog, *source.compiled, *numbers, tuner.present(), {}, {}, {}, {}};
  for (const Script* const script : scripts) result.missions.push_back(script->file);
  if (!options.fail_under.empty()) result.fail_under = degree_of(options.fail_under);
  result.tuned = for_each_number("tuning", result, options, [&](std::size_t number) {
    return TunedNumber{tuner.tolerance(number), tuner.repairs(number)};
  });
  if (options.pairs && !tuner.present().failures.empty() && nearest_repairs(result).empty()) {
    try_pairs(tuner, options, result);
  }
  const TuneFormat& format = *find_named(tune_formats(), options.format);
  int status = write_output("-", format.write(result, style_for(stdout), columns_for(stdout)));
  if (status == exit_ok && options.html) status = write_output(*options.html, tune_to_html(result));
  if (status != exit_ok) return status;
  const bool is_to_be_repaired = options.write && !result.present.failures.empty();
  return is_to_be_repaired ? write_repair(result, source, scripts) : status_of(result);
}

}  // namespace cbc::cli
