#include <algorithm>
#include <cstddef>
#include <string>

#include <fmt/format.h>

#include "core/report/table_parts.h"
#include "core/report/wrap.h"
#include "core/support/wording.h"
#include "coverage/report/missing_missions_report.h"
#include "runtime/base/text.h"

namespace cbc {

namespace {

std::string list_goals(const WrittenMissions& tests, const char* heading,
                       const std::vector<MissingMissions::Unmet>& goals, std::size_t columns) {
  if (goals.empty()) return {};
  std::string text = "\n" + wrap_line(heading, columns, 2) + "\n";
  for (const MissingMissions::Unmet& goal : goals) {
    text += wrap_line("  " + describe(*tests.catalog, tests.goals[goal.goal]), columns, 4) + "\n";
    text += wrap_line("    " + goal.reason, columns, 6) + "\n";
  }
  return text;
}

}  // namespace

std::string written_missions_to_text(const WrittenMissions& tests, std::size_t columns) {
  const MissingMissions& missing = *tests.missing;
  std::string text = printable(tests.catalog->file);
  if (tests.missions == 0U) {
    text += " beside no mission";
  } else if (tests.missions) {
    text += fmt::format(" beside {}", quantity(*tests.missions, "mission"));
  }
  text += "\n" + assumptions_to_text(*tests.catalog, tests.assumptions, columns) + "\n";
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
    std::string line = fmt::format("{} with {}", quantity(missing.missions.size(), "test"),
                                   quantity(events, "event"));
    if (missing.lower_bound) {
      const std::uint64_t least = *missing.lower_bound;
      line += fmt::format("; at least {} needed, with at most {} each",
                          least == 1 ? "one is" : fmt::format("{} are", least),
                          quantity(missing.most_events, "event"));
    }
    text += "\n" + wrap_line(line, columns, 2) + "\n";
  } else {
    text += missing.unmet.empty() ? "\nnothing is missing\n" : "\nno test was found\n";
  }
  for (std::size_t place = 0; place < missing.missions.size(); ++place) {
    const MissingMissions::Mission& mission = missing.missions[place];
    text += fmt::format("  {:<{}}  {:>3}  {:>3}\n", printable(tests.paths[place]), width,
                        quantity(mission.events, "event"), quantity(mission.goals.size(), "goal"));
  }
  for (const std::uint32_t group : missing.partial) {
    const std::string line = fmt::format(
        "a limit ended the exploration of group {}: what it has beyond is not known", group);
    text += "\n" + wrap_line(line, columns, 2) + "\n";
  }
  text += list_goals(tests, "no test shows that", missing.unmet, columns);
  text += list_goals(tests, "under these assumptions no test can show that", missing.unreachable,
                     columns);
  if (!tests.next.empty()) {
    // The command is for a shell, and stays on one line.
    text += "\n" +
            wrap_line(
                "changes of the catalog that all of these leave unnoticed, with a test for "
                "each:",
                columns, 2) +
            "\n  " + tests.next + "\n";
  }
  return text;
}

}  // namespace cbc
