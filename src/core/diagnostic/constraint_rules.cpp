// Rules about exclusivity lists and requirements.
#include "core/diagnostic/rules.h"

namespace cbc::rule {

const Rule self_exclusion = {
    .name = "self-exclusion",
    .severity = Severity::warning,
    .summary = "A task is listed twice in one exclusivity list.",
    .explanation =
        "A task does not exclude itself, so its second place in the list has no effect. Usually "
        "another task is meant there, which can now run together with the tasks that it should "
        "exclude.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: ROTATE_WITH_PID, task: ROTATE}
- {behavior: LAND_WITH_PID, task: LAND}
tasks: [{task: HOVER}, {task: ROTATE}, {task: LAND}]
exclusivity_constraints:
- mutually_exclusive: [HOVER, ROTATE, HOVER]
)",
    .mending = "Name the intended task, or remove the second entry.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: ROTATE_WITH_PID, task: ROTATE}
- {behavior: LAND_WITH_PID, task: LAND}
tasks: [{task: HOVER}, {task: ROTATE}, {task: LAND}]
exclusivity_constraints:
- mutually_exclusive: [HOVER, ROTATE, LAND]
)",
};

const Rule trivial_exclusion = {
    .name = "trivial-exclusion",
    .severity = Severity::note,
    .summary = "An exclusivity list has fewer than two tasks.",
    .explanation =
        "At most one task of a list runs at a time. A list with no task, or with only one, "
        "excludes nothing, and the coordinator ignores it. Perhaps a task is missing from it.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: LAND_WITH_PID, task: LAND}
tasks: [{task: HOVER}, {task: LAND}]
exclusivity_constraints:
- mutually_exclusive: [HOVER]
)",
    .mending = "Add the task that is missing, or remove the list.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: LAND_WITH_PID, task: LAND}
tasks: [{task: HOVER}, {task: LAND}]
exclusivity_constraints:
- mutually_exclusive: [HOVER, LAND]
)",
};

const Rule duplicate_exclusion = {
    .name = "duplicate-exclusion",
    .severity = Severity::note,
    .summary = "Another exclusivity list has all tasks of this one.",
    .explanation =
        "Everything that this list excludes is already excluded by the other one, so the "
        "coordinator chooses the same without it. It does no harm by itself, but whoever later "
        "removes a task from one of the lists will wonder why nothing changes. If two lists have "
        "the same tasks, the later one is reported.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: ROTATE_WITH_PID, task: ROTATE}
- {behavior: LAND_WITH_PID, task: LAND}
tasks: [{task: HOVER}, {task: ROTATE}, {task: LAND}]
exclusivity_constraints:
- mutually_exclusive: [HOVER, ROTATE, LAND]
- mutually_exclusive: [LAND, HOVER]
)",
    .mending = "Remove the list.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: ROTATE_WITH_PID, task: ROTATE}
- {behavior: LAND_WITH_PID, task: LAND}
tasks: [{task: HOVER}, {task: ROTATE}, {task: LAND}]
exclusivity_constraints:
- mutually_exclusive: [HOVER, ROTATE, LAND]
)",
};

const Rule requirement_cycle = {
    .name = "requirement-cycle",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "Tasks require one another in a cycle.",
    .explanation =
        "The coordinator activates what is required before what requires it, and the performance "
        "of a task depends on the tasks that it requires. In a cycle nothing comes first, so the "
        "catalog has no meaning, and is neither compiled nor solved.\n\n"
        "A cycle leads from a task to a behavior that performs it, from there to a task that this "
        "behavior requires, and so on back to the first task. All behaviors count, even ones that "
        "could never be active at the same time. Of several connected cycles, only a shortest one "
        "is reported, with its behaviors.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, requires: [{task: LOCALIZE}]}
- {behavior: VISUAL_ODOMETRY, task: LOCALIZE, requires: [{task: HOVER}]}
tasks:
- {task: HOVER, execution_goal: keep_running, start_on_request: FALSE}
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
)",
    .mending =
        "Remove one of the requirements, or turn what two tasks need from one another into a task "
        "of its own.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, requires: [{task: LOCALIZE}]}
- {behavior: VISUAL_ODOMETRY, task: LOCALIZE}
tasks:
- {task: HOVER, execution_goal: keep_running}
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
)",
};

const Rule exclusive_requirement = {
    .name = "exclusive-requirement",
    .severity = Severity::error,
    .summary = "A behavior requires a task that excludes its own.",
    .explanation =
        "While a behavior is active its task runs, and while its task runs no other task of the "
        "same mutually_exclusive list does. So the requirement can never be met: the behavior can "
        "never be active, and the coordinator never chooses it. A behavior that performs several "
        "tasks breaks the rule if the required task excludes every one of them.\n\n"
        "Nobody wants such a behavior, so this is an error. But the meaning of the catalog is "
        "clear, so settings may lower the severity.",
    .example = R"(behaviors:
- behavior: MPC_CONTROLLER
  task: MPC_CONTROL
  requires:
  - task: THRUST_CONTROL
- {behavior: THRUST_CONTROLLER, task: THRUST_CONTROL}
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
- {behavior: MPC_CONTROLLER, task: MPC_CONTROL}
- {behavior: THRUST_CONTROLLER, task: THRUST_CONTROL}
tasks:
- task: MPC_CONTROL
- {task: THRUST_CONTROL, execution_goal: keep_running}
exclusivity_constraints:
- mutually_exclusive: [MPC_CONTROL, THRUST_CONTROL]
)",
};

const Rule conflicting_requirements = {
    .name = "conflicting-requirements",
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
- {behavior: MPC_CONTROLLER, task: MPC_CONTROL}
- {behavior: THRUST_CONTROLLER, task: THRUST_CONTROL}
tasks:
- task: FOLLOW_PATH
- {task: MPC_CONTROL, execution_goal: keep_running, start_on_request: FALSE}
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
- {behavior: MPC_CONTROLLER, task: MPC_CONTROL}
- {behavior: THRUST_CONTROLLER, task: THRUST_CONTROL}
tasks:
- task: FOLLOW_PATH
- {task: MPC_CONTROL, execution_goal: keep_running, start_on_request: FALSE}
- {task: THRUST_CONTROL, execution_goal: keep_running}
exclusivity_constraints:
- mutually_exclusive: [MPC_CONTROL, THRUST_CONTROL]
)",
};

const Rule redundant_requirement = {
    .name = "redundant-requirement",
    .severity = Severity::note,
    .needs_search = true,
    .summary = "A requirement is always met because of other constraints.",
    .explanation =
        "Every assignment of behaviors to tasks that has this behavior and satisfies the other "
        "constraints satisfies this requirement, too. So the coordinator chooses the same with it "
        "and without it. Usually another task that the behavior requires always requires this one "
        "as well, or the behavior requires it twice. A minimum_performance is part of its "
        "requirement: other constraints must ensure both the task and its minimum. A minimum that "
        "the present behaviors reach by themselves is a margin, which the requirement is there "
        "for: see redundant-minimum.\n\n"
        "It does no harm, but it is one more thing to maintain when the catalog changes.",
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
- {behavior: GPS, task: LOCALIZE}
tasks:
- task: FOLLOW_PATH
- {task: PID_CONTROL, execution_goal: keep_running, start_on_request: FALSE}
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
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
- {behavior: GPS, task: LOCALIZE}
tasks:
- task: FOLLOW_PATH
- {task: PID_CONTROL, execution_goal: keep_running, start_on_request: FALSE}
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
)",
};

const Rule redundant_minimum = {
    .name = "redundant-minimum",
    .severity = Severity::note,
    .is_off = true,
    .needs_search = true,
    .summary = "A minimum performance is reached whatever the coordinator chooses.",
    .explanation =
        "In every assignment of behaviors to tasks that satisfies the other constraints, the task "
        "performs well enough. So the coordinator chooses the same with this minimum_performance "
        "and without it.\n\n"
        "Usually that is no mistake: the minimum is a margin for behaviors that are added later, "
        "or for suitabilities that are measured anew. So the rule is off. Turn it on with 'cbc "
        "lint --note redundant-minimum' to see which minimums decide something today.",
    .example = R"(behaviors:
- behavior: FOLLOW_PATH_WITH_PID
  task: FOLLOW_PATH
  requires:
  - task: LOCALIZE
    minimum_performance: 70
- {behavior: GPS, task: LOCALIZE, suitability: 90}
- {behavior: VISUAL_ODOMETRY, task: LOCALIZE, suitability: 80}
tasks:
- {task: FOLLOW_PATH, execution_goal: achieve_goal}
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
)",
    .mending =
        "Keep the minimum if it is a margin. Raise it if a behavior is not good enough; remove it "
        "if any will do.",
    .mended = R"(behaviors:
- behavior: FOLLOW_PATH_WITH_PID
  task: FOLLOW_PATH
  requires:
  - task: LOCALIZE
    minimum_performance: 85
- {behavior: GPS, task: LOCALIZE, suitability: 90}
- {behavior: VISUAL_ODOMETRY, task: LOCALIZE, suitability: 80}
tasks:
- {task: FOLLOW_PATH, execution_goal: achieve_goal}
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
)",
};

const Rule requires_on_request = {
    .name = "requires-on-request",
    .severity = Severity::warning,
    .needs_search = true,
    .summary = "A behavior requires a task that starts only on request.",
    .explanation =
        "A task with start_on_request TRUE, which is the default, starts only when it is "
        "requested; the coordinator never starts it merely because something requires it. So the "
        "behavior can be chosen only while that task already runs: unless it was requested before, "
        "a request that needs the behavior is rejected. The message says what must be requested "
        "first, and in which order.",
    .example = R"(behaviors:
- behavior: PHOTOGRAPH_WITH_CAMERA
  task: PHOTOGRAPH
  requires:
  - task: HOVER
- {behavior: HOVER_WITH_PID, task: HOVER}
tasks:
- task: PHOTOGRAPH
- {task: HOVER, execution_goal: keep_running}
)",
    .mending =
        "Give the required task 'start_on_request: FALSE'; it can still be requested. If somebody "
        "should decide about each of its starts, keep it and allow the rule there.",
    .mended = R"(behaviors:
- behavior: PHOTOGRAPH_WITH_CAMERA
  task: PHOTOGRAPH
  requires:
  - task: HOVER
- {behavior: HOVER_WITH_PID, task: HOVER}
tasks:
- task: PHOTOGRAPH
- {task: HOVER, execution_goal: keep_running, start_on_request: FALSE}
)",
};

const Rule required_goal = {
    .name = "required-goal",
    .severity = Severity::warning,
    .summary = "A required task ends when its goal is achieved.",
    .explanation =
        "A task with execution_goal achieve_goal, which is the default, stops when its behavior "
        "has achieved the goal. What requires it then cannot go on: the coordinator stops that, "
        "too, unless there is another behavior for it that does not need this task. This happens "
        "in the middle of a mission, and looks like a failure.\n\n"
        "A task that others rely on is nearly always one that runs as long as it is needed.\n\n"
        "Where a catalog gives no execution_goal at all, neither for a task nor in default_values, "
        "as in generated catalogs, the rule is off unless settings ask for it ('cbc lint --warn "
        "required-goal').",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, requires: [{task: LOCALIZE}]}
- {behavior: GPS, task: LOCALIZE}
tasks:
- {task: HOVER, execution_goal: keep_running}
- {task: LOCALIZE, start_on_request: FALSE}
)",
    .mending = "Give the required task 'execution_goal: keep_running'.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, requires: [{task: LOCALIZE}]}
- {behavior: GPS, task: LOCALIZE}
tasks:
- {task: HOVER, execution_goal: keep_running}
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
)",
};

}  // namespace cbc::rule
