#include "rules/topics.h"

namespace cbc {
namespace {

constexpr Rule exclusivity_table[] = {
    {.name = rule::self_exclusion,
     .severity = Severity::warning,
     .summary = "A task stands twice in one exclusivity list.",
     .explanation =
         "A task does not exclude itself, so its second place in the list has no effect. Mostly "
         "another task is meant there; this one is then free to run together with those that it is "
         "meant to exclude.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
- behavior: ROTATE_WITH_PID
  task: ROTATE
- behavior: LAND_WITH_PID
  task: LAND
tasks:
- task: HOVER
- task: ROTATE
- task: LAND
exclusivity_constraints:
- mutually_exclusive: [HOVER, ROTATE, HOVER]
)",
     .mending = "Write the task that is meant, or remove the second one.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
- behavior: ROTATE_WITH_PID
  task: ROTATE
- behavior: LAND_WITH_PID
  task: LAND
tasks:
- task: HOVER
- task: ROTATE
- task: LAND
exclusivity_constraints:
- mutually_exclusive: [HOVER, ROTATE, LAND]
)"},

    {.name = rule::trivial_exclusion,
     .severity = Severity::note,
     .summary = "An exclusivity list has fewer than two tasks.",
     .explanation =
         "Of the tasks of a list at most one runs. With no task in it, or only one, the list "
         "excludes nothing, and the coordinator does as if it were not there. Perhaps a task is "
         "missing in it.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
- behavior: LAND_WITH_PID
  task: LAND
tasks:
- task: HOVER
- task: LAND
exclusivity_constraints:
- mutually_exclusive: [HOVER]
)",
     .mending = "Add the task that is missing, or remove the list.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
- behavior: LAND_WITH_PID
  task: LAND
tasks:
- task: HOVER
- task: LAND
exclusivity_constraints:
- mutually_exclusive: [HOVER, LAND]
)"},

    {.name = rule::duplicate_exclusion,
     .severity = Severity::note,
     .summary = "Another exclusivity list has all tasks of this one.",
     .explanation =
         "All that this list excludes is excluded by the other one already, so it can be left out, "
         "and the coordinator chooses the same. It does no harm by itself, but whoever later takes "
         "a task out of one of the lists will wonder why nothing changes. Of two lists with the "
         "same tasks the later one is reported.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
- behavior: ROTATE_WITH_PID
  task: ROTATE
- behavior: LAND_WITH_PID
  task: LAND
tasks:
- task: HOVER
- task: ROTATE
- task: LAND
exclusivity_constraints:
- mutually_exclusive: [HOVER, ROTATE, LAND]
- mutually_exclusive: [LAND, HOVER]
)",
     .mending = "Remove the list.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
- behavior: ROTATE_WITH_PID
  task: ROTATE
- behavior: LAND_WITH_PID
  task: LAND
tasks:
- task: HOVER
- task: ROTATE
- task: LAND
exclusivity_constraints:
- mutually_exclusive: [HOVER, ROTATE, LAND]
)"},
};

}  // namespace

std::span<const Rule> exclusivity_rules() { return exclusivity_table; }

}  // namespace cbc
