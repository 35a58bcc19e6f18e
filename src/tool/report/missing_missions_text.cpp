#include <algorithm>
#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "base/text.h"
#include "report/missing_missions_report.h"
#include "support/wording.h"

namespace cbc {

std::string written_tests_to_text(const WrittenTests& tests) {
  const MissingMissions& missing = *tests.missing;
  std::string text = printable(tests.catalog->file);
  if (tests.missions > 0) text += fmt::format(" beside {}", quantity(tests.missions, "mission"));
  std::uint64_t met = 0;
  std::uint64_t events = 0;
  std::size_t width = 0;
  for (const std::string& path : tests.paths) width = std::max(width, printable(path).size());
  for (const MissingMissions::Mission& mission : missing.missions) {
    met += mission.goals.size();
    events += mission.events;
  }
  text += "\n\n";
  const auto row = [&](const char* what, std::uint64_t count) {
    text += fmt::format("  {:<18}{:>8}\n", what, count);
  };
  row("goals", tests.goals.size());
  row("met before", tests.goals.size() - missing.wanted);
  row("unreachable", missing.unreachable);
  row("met by tests", met);
  row("not met", missing.unmet.size());
  text += fmt::format("\n{} with {}", quantity(missing.missions.size(), "test"),
                      quantity(events, "event"));
  if (missing.lower_bound && !missing.missions.empty()) {
    text += fmt::format("; no fewer than {} can do, with at most {} each", *missing.lower_bound,
                        quantity(missing.most_events, "event"));
  }
  text += "\n";
  for (std::size_t place = 0; place < missing.missions.size(); ++place) {
    const MissingMissions::Mission& mission = missing.missions[place];
    text += fmt::format("  {:<{}}  {:>3}  {:>3}\n", printable(tests.paths[place]), width,
                        quantity(mission.events, "event"), quantity(mission.goals.size(), "goal"));
  }
  for (const std::uint32_t group : missing.partial) {
    text += fmt::format(
        "\na limit ended the exploration of group {}: what it has beyond is not known\n", group);
  }
  if (missing.unmet.empty()) return text;
  text += "\nno test shows that\n";
  for (const MissingMissions::Unmet& unmet : missing.unmet) {
    text +=
        fmt::format("  {}: {}\n", describe(*tests.catalog, tests.goals[unmet.goal]), unmet.reason);
  }
  return text;
}

}  // namespace cbc
