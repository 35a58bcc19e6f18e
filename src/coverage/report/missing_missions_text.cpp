#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/report/layout.h"
#include "core/report/table.h"
#include "core/report/words.h"
#include "core/support/wording.h"
#include "coverage/report/coverage_report.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

void list_goals(const WrittenMissions& tests, const char* heading,
                const std::vector<MissingMissions::Unmet>& goals, Text& text) {
  if (goals.empty()) return;
  text.line("");
  text.line(heading);
  for (const MissingMissions::Unmet& goal : goals) {
    text.line("  " + describe(*tests.catalog, tests.goals[goal.goal]));
    text.line("    " + goal.reason);
  }
}

std::string count_tests(const MissingMissions& missing) {
  if (missing.missions.empty()) {
    return missing.unmet.empty() ? "nothing is missing" : "no test was found";
  }
  std::uint64_t events = 0;
  for (const MissingMissions::Mission& mission : missing.missions) events += mission.events;
  std::string line = fmt::format("{} with {}", quantity(missing.missions.size(), "test"),
                                 quantity(events, "event"));
  if (missing.lower_bound) {
    const std::uint64_t least = *missing.lower_bound;
    line += fmt::format("; at least {} needed, with at most {} each",
                        least == 1 ? "one is" : fmt::format("{} are", least),
                        quantity(missing.most_events, "event"));
  }
  return line;
}

}  // namespace

std::string written_missions_to_text(const WrittenMissions& tests, std::size_t columns) {
  const MissingMissions& missing = *tests.missing;
  Text text(plain_style(), columns);
  std::string beside;
  if (tests.missions) {
    beside =
        " beside " + (*tests.missions == 0 ? "no mission" : quantity(*tests.missions, "mission"));
  }
  text.add(printable(tests.catalog->file) + beside + "\n");
  text.add(assumptions_to_text(*tests.catalog, tests.assumptions, columns) + "\n");
  std::uint64_t met = 0;
  for (const MissingMissions::Mission& mission : missing.missions) met += mission.goals.size();
  Table counts(text.style(), {{{}, {}, 18}, number_column({}, 8, 0)});
  counts.add({"goals", tests.goals.size()});
  counts.add({"met before", tests.goals.size() - missing.wanted});
  counts.add({"unreachable", missing.unreachable.size()});
  counts.add({"met by tests", met});
  counts.add({"not met", missing.unmet.size()});
  text.add(counts.text());
  text.line("");
  text.line(count_tests(missing));
  Table files(text.style(), {{}, {}});
  for (std::size_t place = 0; place < missing.missions.size(); ++place) {
    const MissingMissions::Mission& mission = missing.missions[place];
    files.add({printable(tests.paths[place]),
               quantity(mission.events, "event") + "  " + quantity(mission.goals.size(), "goal")});
  }
  text.add(files.text());
  for (const GroupId group : missing.partial) {
    text.line("");
    text.line("a limit ended the exploration of group {}: what it has beyond is not known", group);
  }
  list_goals(tests, "no test shows that", missing.unmet, text);
  list_goals(tests, "under these assumptions no test can show that", missing.unreachable, text);
  if (!tests.next.empty()) {
    text.line("");
    text.line("changes of the catalog that all of these leave unnoticed, with a test for each:");
    // The command is for a shell, and stays on one line.
    text.add("  " + tests.next + "\n");
  }
  return text.take();
}

}  // namespace cbc
