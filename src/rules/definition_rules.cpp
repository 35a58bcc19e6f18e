#include "rules/topics.h"

namespace cbc {
namespace {

constexpr Rule definition_table[] = {
    {.name = rule::duplicate_behavior,
     .severity = Severity::error,
     .is_fixed = true,
     .summary = "A behavior is defined twice.",
     .explanation =
         "A behavior is known by its name alone: a script says which behavior finishes, fails or "
         "is available, and the coordinator which one it activates. With two definitions it is "
         "unclear what the behavior performs, how well, and what it requires, so the catalog is "
         "neither compiled nor solved. This holds even for two definitions that are equal. A task "
         "and a behavior may have the same name.",
     .example = R"(behaviors:
- behavior: PID_CONTROL
  task: HOVER
- behavior: PID_CONTROL
  task: ROTATE
tasks:
- task: HOVER
- task: ROTATE
)",
     .mending =
         "Remove one of the definitions, or give it another name. A behavior that performs several "
         "tasks is defined once, with 'tasks' in place of 'task'.",
     .mended = R"(behaviors:
- behavior: PID_CONTROL
  tasks:
  - task: HOVER
  - task: ROTATE
tasks:
- task: HOVER
- task: ROTATE
)"},

    {.name = rule::undefined_task,
     .severity = Severity::error,
     .is_fixed = true,
     .summary = "A task is named that is not defined.",
     .explanation =
         "An entry of the section 'tasks' defines a task, and so does a behavior that performs it. "
         "A name that stands only in a requirement, in an exclusivity list or in a script defines "
         "none. Usually it is misspelt; the message gives the nearest known name.\n\n"
         "A requirement of such a task could never be met, and an exclusivity list with it would "
         "let tasks run together that are meant to exclude one another. So such a file is neither "
         "compiled nor solved.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires:
  - task: LOCALISE
- behavior: GPS
  task: LOCALIZE
tasks:
- task: HOVER
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)",
     .mending = "Correct the name, or define the task.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires:
  - task: LOCALIZE
- behavior: GPS
  task: LOCALIZE
tasks:
- task: HOVER
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)"},

    {.name = rule::task_without_behavior,
     .severity = Severity::warning,
     .summary = "No behavior performs a task.",
     .explanation =
         "The task is listed in the section 'tasks', but no behavior can perform it, so it can "
         "never run. The coordinator rejects every request of it, and never chooses a behavior "
         "that requires it; such a behavior is not reported again.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
tasks:
- task: HOVER
- task: LAND
)",
     .mending =
         "Add a behavior that performs the task, correct the name that differs between the task "
         "and its behavior, or remove the task.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
- behavior: LAND_WITH_PID
  task: LAND
tasks:
- task: HOVER
- task: LAND
)"},

    {.name = rule::implicit_task,
     .severity = Severity::note,
     .summary = "A task is named by a behavior only.",
     .explanation =
         "A behavior performs the task, but the section 'tasks' does not list it. It is a task all "
         "the same, with the default attributes and without parameters.\n\n"
         "This is allowed, but a misspelt name looks just like it: it makes one more task, and the "
         "task that is meant has one behavior fewer. In a catalog without a section 'tasks' there "
         "is one finding for all of them, at the first.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
- behavior: LAND_WITH_PID
  task: LAND
tasks:
- task: HOVER
)",
     .mending = "List the task, or correct its name in the behavior.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
- behavior: LAND_WITH_PID
  task: LAND
tasks:
- task: HOVER
- task: LAND
)"},

    {.name = rule::duplicate_task,
     .severity = Severity::warning,
     .summary = "A task is listed twice.",
     .explanation =
         "The task keeps the place of its first entry, but has all attributes of the last one. "
         "What the last entry does not mention has its default, whatever the earlier ones say: so "
         "a timeout or parameters of an earlier entry are lost without a sign. The message says "
         "which attributes the later entry changes.",
     .example = R"(behaviors:
- behavior: ROTATE_WITH_PID
  task: ROTATE
tasks:
- task: ROTATE
  timeout: 30
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
)",
     .mending = "Make one entry of the two, or correct the name of one of them.",
     .mended = R"(behaviors:
- behavior: ROTATE_WITH_PID
  task: ROTATE
tasks:
- task: ROTATE
  timeout: 30
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
)"},
};

}  // namespace

std::span<const Rule> definition_rules() { return definition_table; }

}  // namespace cbc
