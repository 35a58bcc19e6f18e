#include "diagnostic/rules.h"

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

namespace {

constexpr Rule requirement_table[] = {
    {.name = rule::requirement_cycle,
     .severity = Severity::error,
     .is_fixed = true,
     .summary = "Tasks require one another in a cycle.",
     .explanation =
         "The coordinator activates what is required before what requires it, and the performance "
         "of a task depends on the tasks that it requires. In a cycle nothing comes first, so the "
         "catalog has no meaning, and is neither compiled nor solved.\n\n"
         "A cycle leads from a task to a behavior that performs it, from there to a task that this "
         "behavior requires, and so on back to the first task. All behaviors count, even ones that "
         "could never be active at the same time. Of cycles that hang together one is reported, a "
         "shortest one, with its behaviors.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires:
  - task: LOCALIZE
- behavior: VISUAL_ODOMETRY
  task: LOCALIZE
  requires:
  - task: HOVER
tasks:
- task: HOVER
  execution_goal: keep_running
  start_on_request: FALSE
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)",
     .mending =
         "Remove one of the requirements, or make a task of its own of what two tasks need of one "
         "another.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires:
  - task: LOCALIZE
- behavior: VISUAL_ODOMETRY
  task: LOCALIZE
tasks:
- task: HOVER
  execution_goal: keep_running
  start_on_request: FALSE
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)"},

    {.name = rule::exclusive_requirement,
     .severity = Severity::error,
     .summary = "A behavior requires a task that excludes its own.",
     .explanation =
         "While a behavior is active its task runs, and while its task runs no other task of the "
         "same mutually_exclusive list does. So the requirement can never be met: the behavior can "
         "never be active, and the coordinator never chooses it. A behavior that performs several "
         "tasks breaks the rule if the required task excludes every one of them.\n\n"
         "Such a behavior is never meant, so this is an error. But the meaning of the catalog is "
         "clear, so settings may lower it.",
     .example = R"(behaviors:
- behavior: MPC_CONTROLLER
  task: MPC_CONTROL
  requires:
  - task: THRUST_CONTROL
- behavior: THRUST_CONTROLLER
  task: THRUST_CONTROL
tasks:
- task: MPC_CONTROL
- task: THRUST_CONTROL
  execution_goal: keep_running
  start_on_request: FALSE
exclusivity_constraints:
- mutually_exclusive: [MPC_CONTROL, THRUST_CONTROL]
)",
     .mending = "Remove the requirement, or take one of the two tasks out of the list.",
     .mended = R"(behaviors:
- behavior: MPC_CONTROLLER
  task: MPC_CONTROL
- behavior: THRUST_CONTROLLER
  task: THRUST_CONTROL
tasks:
- task: MPC_CONTROL
- task: THRUST_CONTROL
  execution_goal: keep_running
  start_on_request: FALSE
exclusivity_constraints:
- mutually_exclusive: [MPC_CONTROL, THRUST_CONTROL]
)"},

    {.name = rule::conflicting_requirements,
     .severity = Severity::warning,
     .summary = "A behavior requires two tasks that exclude one another.",
     .explanation =
         "Both tasks would have to run whenever the behavior is active, but as they share a "
         "mutually_exclusive list at most one of them does. So the behavior can never be active, "
         "and the coordinator never chooses it.\n\n"
         "The rule is about two tasks that the behavior itself requires. Where the conflict comes "
         "from what these tasks require in turn, the finding is dead-behavior or dead-task.",
     .example = R"(behaviors:
- behavior: FOLLOW_PATH_WITH_MPC
  task: FOLLOW_PATH
  requires:
  - task: MPC_CONTROL
  - task: THRUST_CONTROL
- behavior: MPC_CONTROLLER
  task: MPC_CONTROL
- behavior: THRUST_CONTROLLER
  task: THRUST_CONTROL
tasks:
- task: FOLLOW_PATH
- task: MPC_CONTROL
  execution_goal: keep_running
  start_on_request: FALSE
- task: THRUST_CONTROL
  execution_goal: keep_running
  start_on_request: FALSE
exclusivity_constraints:
- mutually_exclusive: [MPC_CONTROL, THRUST_CONTROL]
)",
     .mending = "Remove one of the two requirements, or take one of the two tasks out of the list.",
     .mended = R"(behaviors:
- behavior: FOLLOW_PATH_WITH_MPC
  task: FOLLOW_PATH
  requires:
  - task: MPC_CONTROL
- behavior: MPC_CONTROLLER
  task: MPC_CONTROL
- behavior: THRUST_CONTROLLER
  task: THRUST_CONTROL
tasks:
- task: FOLLOW_PATH
- task: MPC_CONTROL
  execution_goal: keep_running
  start_on_request: FALSE
- task: THRUST_CONTROL
  execution_goal: keep_running
  start_on_request: FALSE
exclusivity_constraints:
- mutually_exclusive: [MPC_CONTROL, THRUST_CONTROL]
)"},

    {.name = rule::redundant_requirement,
     .severity = Severity::note,
     .summary = "A requirement is always met because of other constraints.",
     .explanation =
         "Every assignment of behaviors to tasks that has this behavior and satisfies the other "
         "constraints satisfies this requirement, too. So the coordinator chooses the same with it "
         "and without it. Mostly another task that the behavior requires always requires this one "
         "as well, or the behavior requires it twice. A minimum_performance belongs to its "
         "requirement: both the task and its minimum must be assured otherwise.\n\n"
         "It does no harm, but it is one more thing to keep right when the catalog changes.",
     .example = R"(behaviors:
- behavior: FOLLOW_PATH_WITH_PID
  task: FOLLOW_PATH
  requires:
  - task: PID_CONTROL
  - task: LOCALIZE
- behavior: PID_CONTROLLER
  task: PID_CONTROL
  requires:
  - task: LOCALIZE
- behavior: GPS
  task: LOCALIZE
tasks:
- task: FOLLOW_PATH
- task: PID_CONTROL
  execution_goal: keep_running
  start_on_request: FALSE
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)",
     .mending =
         "Remove the requirement. If the behavior needs the task itself, and not only by way of "
         "another one, keep it and allow the rule there.",
     .mended = R"(behaviors:
- behavior: FOLLOW_PATH_WITH_PID
  task: FOLLOW_PATH
  requires:
  - task: PID_CONTROL
- behavior: PID_CONTROLLER
  task: PID_CONTROL
  requires:
  - task: LOCALIZE
- behavior: GPS
  task: LOCALIZE
tasks:
- task: FOLLOW_PATH
- task: PID_CONTROL
  execution_goal: keep_running
  start_on_request: FALSE
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)"},

    {.name = rule::requires_on_request,
     .severity = Severity::warning,
     .summary = "A behavior requires a task that starts on request only.",
     .explanation =
         "A task with start_on_request TRUE, which is the default, starts only when it is "
         "requested; the coordinator never starts it because something requires it. So the "
         "behavior can be chosen only while that task already runs: unless it was requested "
         "before, a request that needs the behavior is rejected. The message says what must be "
         "requested first, and in which order.",
     .example = R"(behaviors:
- behavior: PHOTOGRAPH_WITH_CAMERA
  task: PHOTOGRAPH
  requires:
  - task: HOVER
- behavior: HOVER_WITH_PID
  task: HOVER
tasks:
- task: PHOTOGRAPH
- task: HOVER
  execution_goal: keep_running
)",
     .mending =
         "Give the required task 'start_on_request: FALSE'; it can be requested all the same. If "
         "somebody is to decide about each start of it, keep it and allow the rule there.",
     .mended = R"(behaviors:
- behavior: PHOTOGRAPH_WITH_CAMERA
  task: PHOTOGRAPH
  requires:
  - task: HOVER
- behavior: HOVER_WITH_PID
  task: HOVER
tasks:
- task: PHOTOGRAPH
- task: HOVER
  execution_goal: keep_running
  start_on_request: FALSE
)"},

    {.name = rule::required_goal,
     .severity = Severity::warning,
     .summary = "A required task ends when its goal is achieved.",
     .explanation =
         "A task with execution_goal achieve_goal, which is the default, stops when its behavior "
         "has achieved the goal. What requires it can then not go on: the coordinator stops it, "
         "too, unless there is another behavior for it that does without. This happens in the "
         "middle of a mission, and looks like a failure.\n\n"
         "A task that others rely on is nearly always one that runs as long as it is needed.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires:
  - task: LOCALIZE
- behavior: GPS
  task: LOCALIZE
tasks:
- task: HOVER
- task: LOCALIZE
  start_on_request: FALSE
)",
     .mending = "Give the required task 'execution_goal: keep_running'.",
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
};

}  // namespace

std::span<const Rule> requirement_rules() { return requirement_table; }

}  // namespace cbc
