#include <algorithm>
#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "base/text.h"
#include "report/missing_missions_report.h"
#include "report/table_parts.h"
#include "support/wording.h"

namespace cbc {

namespace {

std::string list_goals(const WrittenTests& tests, const char* heading,
                       const std::vector<MissingMissions::Unmet>& goals) {
  if (goals.empty()) return {};
  std::string text = fmt::format("\n{}\n", heading);
  for (const MissingMissions::Unmet& goal : goals) {
    text += fmt::format("  {}\n    {}\n", describe(*tests.catalog, tests.goals[goal.goal]),
                        goal.reason);
  }
  return text;
}

}  // namespace

std::string written_tests_to_text(const WrittenTests& tests) {
  const MissingMissions& missing = *tests.missing;
  std::string text = printable(tests.catalog->file);
  if (tests.missions == 0U) {
    text += " beside no mission";
  } else if (tests.missions) {
    text += fmt::format(" beside {}", quantity(*tests.missions, "mission"));
  }
  text += "\n" + assumptions_to_text(tests.assumptions) + "\n";
  std::uint64_t met = 0;
  std::uint64_t events = 0;
  std::size_t width = 0;
  for (const std::string& path : tests.paths) width = std::max(width, printable(path).size());
  for (const MissingMissions::Mission& mission : missing.missions) {
    met += mission.goals.size();
    events += mission.events;
  }
  const auto row = [&](const char* what, std::uint64_t count) {
    text += fmt::format("  {:<18}{:>8}\n", what, count);
  };
  row("goals", tests.goals.size());
  row("met before", tests.goals.size() - missing.wanted);
  row("unreachable", missing.unreachable.size());
  row("met by tests", met);
  row("not met", missing.unmet.size());
  if (!missing.missions.empty()) {
    text += fmt::format("\n{} with {}", quantity(missing.missions.size(), "test"),
                        quantity(events, "event"));
    if (missing.lower_bound) {
      text += fmt::format("; at least {} are needed, with at most {} each", *missing.lower_bound,
                          quantity(missing.most_events, "event"));
    }
    text += "\n";
  } else {
    text += missing.unmet.empty() ? "\nnothing is missing\n" : "\nno test was found\n";
  }
  for (std::size_t place = 0; place < missing.missions.size(); ++place) {
    const MissingMissions::Mission& mission = missing.missions[place];
    text += fmt::format("  {:<{}}  {:>3}  {:>3}\n", printable(tests.paths[place]), width,
                        quantity(mission.events, "event"), quantity(mission.goals.size(), "goal"));
  }
  for (const std::uint32_t group : missing.partial) {
    text += fmt::format(
        "\na limit ended the exploration of group {}: what it has beyond is not known\n", group);
  }
  text += list_goals(tests, "no test shows that", missing.unmet);
  text += list_goals(tests, "under these assumptions no test can show that", missing.unreachable);
  if (!tests.next.empty()) {
    text += fmt::format(
        "\nchanges of the catalog that all of these leave unnoticed, with a test for "
        "each:\n  {}\n",
        tests.next);
  }
  return text;
}

}  // namespace cbc
