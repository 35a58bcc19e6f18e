// Rules that a search decides.
#include "core/diagnostic/rules.h"

namespace cbc::rule {

const Rule dead_behavior = {
    .name = "dead-behavior",
    .severity = Severity::warning,
    .needs_search = true,
    .summary = "A behavior can never be active, though its task can run.",
    .explanation =
        "No assignment of behaviors to tasks that satisfies all constraints has this behavior, "
        "even if all behaviors are available. The coordinator never chooses it: where only this "
        "behavior would do, it rejects the request. Whether tasks start on request does not matter "
        "here. The same holds for a behavior that fits, with what it requires, in no situation.\n\n"
        "The finding is proven by a search through all assignments. It gives a minimal set of "
        "constraints that together are the reason: without any one of them, such an assignment "
        "exists.\n\n"
        "A fault is reported once, where it is: there is no finding for a behavior that is dead "
        "only because of another finding, such as conflicting-requirements or a dead-task. If all "
        "behaviors of a task are dead, the finding is dead-task.",
    .example = R"(default_values:
  tasks: {execution_goal: keep_running, start_on_request: FALSE}
behaviors:
- behavior: LAND_ON_MARKER
  task: LAND
  requires:
  - task: TRACK_MARKER
  - task: LOOK_AHEAD
- {behavior: LAND_SLOWLY, task: LAND, suitability: 60}
- behavior: MARKER_TRACKER
  task: TRACK_MARKER
  requires:
  - task: LOOK_DOWN
- {behavior: CAMERA, tasks: [{task: LOOK_AHEAD}, {task: LOOK_DOWN}]}
tasks:
- {task: LAND, execution_goal: achieve_goal, start_on_request: TRUE}
- task: TRACK_MARKER
- task: LOOK_AHEAD
- task: LOOK_DOWN
exclusivity_constraints:
- mutually_exclusive: [LOOK_AHEAD, LOOK_DOWN]
)",
    .mending = "Relax one of the constraints that the finding names, or remove the behavior.",
    .mended = R"(default_values:
  tasks: {execution_goal: keep_running, start_on_request: FALSE}
behaviors:
- {behavior: LAND_ON_MARKER, task: LAND, requires: [{task: TRACK_MARKER}]}
- {behavior: LAND_SLOWLY, task: LAND, suitability: 60}
- behavior: MARKER_TRACKER
  task: TRACK_MARKER
  requires:
  - task: LOOK_DOWN
- {behavior: CAMERA, tasks: [{task: LOOK_AHEAD}, {task: LOOK_DOWN}]}
tasks:
- {task: LAND, execution_goal: achieve_goal, start_on_request: TRUE}
- task: TRACK_MARKER
- {task: LOOK_AHEAD, start_on_request: TRUE}
- task: LOOK_DOWN
exclusivity_constraints:
- mutually_exclusive: [LOOK_AHEAD, LOOK_DOWN]
)",
};

const Rule dead_task = {
    .name = "dead-task",
    .severity = Severity::warning,
    .needs_search = true,
    .summary = "A task can never run, though behaviors perform it.",
    .explanation =
        "No assignment of behaviors to tasks that satisfies all constraints has the task running, "
        "even if all behaviors are available. The coordinator rejects every request for it. "
        "Whether "
        "tasks start on request does not matter here. The same holds for a task whose behaviors, "
        "with what they require, fit in no "
        "common situation.\n\n"
        "The finding is proven by a search through all assignments. It gives a minimal set of "
        "constraints that together are the reason: without any one of them, such an assignment "
        "exists.\n\n"
        "A fault is reported once, where it is: there is no finding for each behavior of the task, "
        "nor for what requires it. For a task that is dead only because of another finding, such "
        "as exclusive-requirement or unreachable-performance, there is none either.",
    .example = R"(default_values:
  tasks: {execution_goal: keep_running, start_on_request: FALSE}
behaviors:
- behavior: INSPECT_WITH_CAMERA
  task: INSPECT_BRIDGE
  requires:
  - task: FOLLOW_PATH
  - task: DETECT_CRACKS
- {behavior: FOLLOW_PATH_WITH_PID, task: FOLLOW_PATH}
- {behavior: CRACK_DETECTOR, task: DETECT_CRACKS, requires: [{task: HOVER}]}
- {behavior: HOVER_WITH_PID, task: HOVER}
tasks:
- task: INSPECT_BRIDGE
  execution_goal: achieve_goal
  start_on_request: TRUE
- task: FOLLOW_PATH
- task: DETECT_CRACKS
- task: HOVER
exclusivity_constraints:
- mutually_exclusive: [FOLLOW_PATH, HOVER]
)",
    .mending =
        "Relax one of the constraints that the finding names, or add a behavior that does without "
        "it.",
    .mended = R"(default_values:
  tasks: {execution_goal: keep_running, start_on_request: FALSE}
behaviors:
- behavior: INSPECT_WITH_CAMERA
  task: INSPECT_BRIDGE
  requires:
  - task: DETECT_CRACKS
- {behavior: FOLLOW_PATH_WITH_PID, task: FOLLOW_PATH}
- {behavior: CRACK_DETECTOR, task: DETECT_CRACKS, requires: [{task: HOVER}]}
- {behavior: HOVER_WITH_PID, task: HOVER}
tasks:
- task: INSPECT_BRIDGE
  execution_goal: achieve_goal
  start_on_request: TRUE
- {task: FOLLOW_PATH, start_on_request: TRUE}
- task: DETECT_CRACKS
- task: HOVER
exclusivity_constraints:
- mutually_exclusive: [FOLLOW_PATH, HOVER]
)",
};

const Rule unreachable_performance = {
    .name = "unreachable-performance",
    .severity = Severity::warning,
    .needs_search = true,
    .summary = "No choice of behaviors reaches a minimum performance.",
    .explanation =
        "The performance of a task is the suitability of its behavior times the suitabilities of "
        "the behaviors of all tasks that it requires, directly or through others, each task once. "
        "No choice of behaviors that satisfies the other constraints brings it up to this "
        "minimum_performance. If the minimum stands in a requirement, the behavior that has it can "
        "never be active; if it is that of a task, the task can never run.\n\n"
        "The message gives the best performance that can be reached. It is exact, as suitabilities "
        "are decimals and are multiplied as such.",
    .example = R"(behaviors:
- behavior: FOLLOW_PATH_WITH_PID
  task: FOLLOW_PATH
  requires:
  - task: LOCALIZE
    minimum_performance: 90
- behavior: VISUAL_ODOMETRY
  task: LOCALIZE
  suitability: 95
  requires:
  - task: PROVIDE_IMAGES
- {behavior: FRONT_CAMERA, task: PROVIDE_IMAGES, suitability: 80}
tasks:
- task: FOLLOW_PATH
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
- task: PROVIDE_IMAGES
  execution_goal: keep_running
  start_on_request: FALSE
)",
    .mending =
        "Lower the minimum to what can be reached, here 95 % times 80 %, or add a better behavior.",
    .mended = R"(behaviors:
- behavior: FOLLOW_PATH_WITH_PID
  task: FOLLOW_PATH
  requires:
  - task: LOCALIZE
    minimum_performance: 76
- behavior: VISUAL_ODOMETRY
  task: LOCALIZE
  suitability: 95
  requires:
  - task: PROVIDE_IMAGES
- {behavior: FRONT_CAMERA, task: PROVIDE_IMAGES, suitability: 80}
tasks:
- task: FOLLOW_PATH
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
- task: PROVIDE_IMAGES
  execution_goal: keep_running
  start_on_request: FALSE
)",
};

const Rule blocked_reactive = {
    .name = "blocked-reactive",
    .severity = Severity::note,
    .needs_search = true,
    .summary = "A reactive task cannot run beside a task on request, though no list has both.",
    .explanation =
        "A reactive task starts by itself whenever the constraints allow it. While the task that "
        "the message names is running, they do not, and it waits: what the two tasks require is "
        "mutually exclusive, or not as good as it must be. The exclusivity lists do not show this, "
        "as none of them has both tasks.\n\n"
        "That may be intended. But a robot that is to hover whenever it does nothing else will not "
        "hover then.\n\n"
        "The finding is proven by a search through all assignments, with every behavior available. "
        "It gives the chain of requirements and exclusions between the tasks; of many tasks it "
        "names the first five. Only tasks with start_on_request count. 'cbc graph --view "
        "together' shows which of these can run together.",
    .example = R"(default_values:
  tasks: {execution_goal: keep_running, start_on_request: FALSE}
behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, requires: [{task: PID_CONTROL}]}
- {behavior: TAKE_OFF_BY_MODE, task: TAKE_OFF, requires: [{task: MODE}]}
- {behavior: PID_CONTROLLER, task: PID_CONTROL}
- {behavior: MODE_SWITCH, task: MODE}
tasks:
- {task: HOVER, reactive_start: TRUE}
- {task: TAKE_OFF, start_on_request: TRUE, execution_goal: achieve_goal}
- task: PID_CONTROL
- task: MODE
exclusivity_constraints:
- mutually_exclusive: [PID_CONTROL, MODE]
)",
    .mending =
        "If it is intended, list the two tasks as mutually exclusive, or allow the finding. "
        "Otherwise add a behavior that does without what is excluded, or relax a constraint of the "
        "chain.",
    .mended = R"(default_values:
  tasks: {execution_goal: keep_running, start_on_request: FALSE}
behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, requires: [{task: PID_CONTROL}]}
- {behavior: TAKE_OFF_BY_MODE, task: TAKE_OFF, requires: [{task: MODE}]}
- {behavior: PID_CONTROLLER, task: PID_CONTROL}
- {behavior: MODE_SWITCH, task: MODE}
tasks:
- {task: HOVER, reactive_start: TRUE}
- {task: TAKE_OFF, start_on_request: TRUE, execution_goal: achieve_goal}
- task: PID_CONTROL
- task: MODE
exclusivity_constraints:
- mutually_exclusive: [PID_CONTROL, MODE]
- mutually_exclusive: [HOVER, TAKE_OFF]
)",
};

const Rule can_run_together = {
    .name = "can-run-together",
    .severity = Severity::error,
    .needs_search = true,
    .summary = "Two tasks can run at the same time, but the settings say that they never do.",
    .explanation =
        "The key 'never_together' of the settings file, .cbc.yaml, has lists of tasks of which no "
        "two may run at the same time. Some assignment that satisfies all constraints runs both of "
        "these tasks; the message names behaviors with which they run. So the constraints of the "
        "catalog do not say what the settings demand.\n\n"
        "If there is no finding, this is proven by search: the tasks exclude one another, or what "
        "they require does, whatever behaviors are available. A list may have names that only "
        "another catalog with the same settings has.",
    .settings = R"(never_together:
- [LAND, FOLLOW_PATH]
)",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: LAND_WITH_PID, task: LAND}
- {behavior: FOLLOW_PATH_WITH_PID, task: FOLLOW_PATH}
tasks: [{task: HOVER}, {task: LAND}, {task: FOLLOW_PATH}]
exclusivity_constraints:
- mutually_exclusive: [HOVER, LAND]
- mutually_exclusive: [HOVER, FOLLOW_PATH]
)",
    .mending =
        "Add the missing exclusion to the catalog, or remove the tasks from the settings if they "
        "may run together.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: LAND_WITH_PID, task: LAND}
- {behavior: FOLLOW_PATH_WITH_PID, task: FOLLOW_PATH}
tasks: [{task: HOVER}, {task: LAND}, {task: FOLLOW_PATH}]
exclusivity_constraints:
- mutually_exclusive: [HOVER, LAND, FOLLOW_PATH]
)",
};

const Rule undecided = {
    .name = "undecided",
    .severity = Severity::note,
    .needs_search = true,
    .summary = "The search for a proof reached its limit, so a rule is left undecided.",
    .explanation =
        "Rules such as dead-behavior and redundant-requirement hold if there is no assignment of "
        "behaviors to tasks of a certain kind, which takes a search to prove. This search took as "
        "many decisions as --max-nodes allows before it came to an end. So the catalog may break "
        "the rule that the message names, or may not.\n\n"
        "The example shows it only with a low limit, as in 'cbc lint --max-nodes 1'. With the "
        "usual one, nothing is wrong with it: of two neighboring sensors at most one is on, and "
        "each task that needs a sensor has a behavior that does not.",
    .example = R"(default_values:
  tasks: {execution_goal: keep_running, start_on_request: FALSE}
behaviors:
- behavior: DELIVERY
  task: DELIVER
  requires: [{task: LOCALIZE}, {task: AVOID}, {task: MAP}, {task: TRACK}]
- behavior: LOCALIZE_BY_LIDAR
  task: LOCALIZE
  requires: [{task: LIDAR}]
- {behavior: LOCALIZE_BY_WHEELS, task: LOCALIZE, suitability: 60}
- behavior: AVOID_BY_SONAR
  task: AVOID
  requires: [{task: SONAR}]
- {behavior: AVOID_BY_BUMPER, task: AVOID, suitability: 60}
- behavior: MAP_BY_RADAR
  task: MAP
  requires: [{task: RADAR}]
- {behavior: MAP_BY_PLAN, task: MAP, suitability: 60}
- behavior: TRACK_BY_CAMERA
  task: TRACK
  requires: [{task: CAMERA}]
- {behavior: TRACK_BY_SOUND, task: TRACK, suitability: 60}
- behavior: SENSOR_DRIVER
  tasks: [{task: LIDAR}, {task: SONAR}, {task: RADAR}, {task: CAMERA}]
tasks:
- {task: DELIVER, execution_goal: achieve_goal, start_on_request: TRUE}
- task: LOCALIZE
- task: AVOID
- task: MAP
- task: TRACK
- task: LIDAR
- task: SONAR
- task: RADAR
- task: CAMERA
exclusivity_constraints:
- mutually_exclusive: [LIDAR, SONAR]
- mutually_exclusive: [SONAR, RADAR]
- mutually_exclusive: [RADAR, CAMERA]
)",
    .mending =
        "Raise the limit with --max-nodes. Where that does not help, the catalog has more choices "
        "than it needs: leave out alternatives that do not differ in what matters, and list all "
        "tasks that exclude one another in one list.",
    .mended = R"(default_values:
  tasks: {execution_goal: keep_running, start_on_request: FALSE}
behaviors:
- behavior: DELIVERY
  task: DELIVER
  requires: [{task: LOCALIZE}, {task: AVOID}, {task: MAP}, {task: TRACK}]
- {behavior: LOCALIZE_BY_WHEELS, task: LOCALIZE}
- {behavior: AVOID_BY_BUMPER, task: AVOID}
- {behavior: MAP_BY_PLAN, task: MAP}
- {behavior: TRACK_BY_SOUND, task: TRACK}
tasks:
- {task: DELIVER, execution_goal: achieve_goal, start_on_request: TRUE}
- task: LOCALIZE
- task: AVOID
- task: MAP
- task: TRACK
)",
};

}  // namespace cbc::rule
