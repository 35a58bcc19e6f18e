// Rules about single entries: how tasks and behaviors are defined, their attributes and parameters.
#include "core/diagnostic/rules.h"

namespace cbc::rule {

const Rule duplicate_behavior = {
    .name = "duplicate-behavior",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "A behavior is defined twice.",
    .explanation =
        "A behavior is known by its name alone: a script says which behavior finishes, fails or is "
        "available, and the coordinator which one it activates. With two definitions it is unclear "
        "what the behavior performs, how well, and what it requires, so the catalog is neither "
        "compiled nor solved. This holds even if the two definitions are equal. A task and a "
        "behavior may have the same name.",
    .example = R"(behaviors:
- {behavior: PID_CONTROL, task: HOVER}
- {behavior: PID_CONTROL, task: ROTATE}
tasks: [{task: HOVER}, {task: ROTATE}]
)",
    .mending =
        "Remove one of the definitions, or give it another name. A behavior that performs several "
        "tasks is defined once, with 'tasks' in place of 'task'.",
    .mended = R"(behaviors:
- {behavior: PID_CONTROL, tasks: [{task: HOVER}, {task: ROTATE}]}
tasks: [{task: HOVER}, {task: ROTATE}]
)",
};

const Rule undefined_task = {
    .name = "undefined-task",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "A name refers to a task that is not defined.",
    .explanation =
        "An entry of the section 'tasks' defines a task, and so does a behavior that performs it. "
        "A name that appears only in a requirement, an exclusivity list or a script does not "
        "define a task. Usually it is misspelled; the message gives the nearest known name.\n\n"
        "A requirement of such a task could never be met, and an exclusivity list with it would "
        "let tasks run together that are meant to exclude one another. So such a file is neither "
        "compiled nor solved.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, requires: [{task: LOCALISE}]}
- {behavior: GPS, task: LOCALIZE}
tasks:
- task: HOVER
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
)",
    .mending = "Correct the name, or define the task.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, requires: [{task: LOCALIZE}]}
- {behavior: GPS, task: LOCALIZE}
tasks:
- task: HOVER
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
)",
};

const Rule task_without_behavior = {
    .name = "task-without-behavior",
    .severity = Severity::warning,
    .summary = "No behavior performs a task.",
    .explanation =
        "The task is listed in the section 'tasks', but no behavior can perform it, so it can "
        "never run. The coordinator rejects every request for it, and never chooses a behavior "
        "that "
        "requires it; such a behavior is not reported again.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
tasks: [{task: HOVER}, {task: LAND}]
)",
    .mending =
        "Add a behavior that performs the task, correct the name that differs between the task and "
        "its behavior, or remove the task.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: LAND_WITH_PID, task: LAND}
tasks: [{task: HOVER}, {task: LAND}]
)",
};

const Rule implicit_task = {
    .name = "implicit-task",
    .severity = Severity::note,
    .summary = "A task is named only by a behavior.",
    .explanation =
        "A behavior performs the task, but the section 'tasks' does not list it. It is still a "
        "task, with the default attributes and without parameters.\n\n"
        "This is allowed, but a misspelled name looks just like it: it adds a task, and the "
        "intended task has one behavior fewer. In a catalog without a section 'tasks' there is one "
        "finding for all of them, at the first.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: LAND_WITH_PID, task: LAND}
tasks: [{task: HOVER}]
)",
    .mending = "List the task, or correct its name in the behavior.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: LAND_WITH_PID, task: LAND}
tasks: [{task: HOVER}, {task: LAND}]
)",
};

const Rule duplicate_task = {
    .name = "duplicate-task",
    .severity = Severity::warning,
    .summary = "A task is listed twice.",
    .explanation =
        "The task keeps the place of its first entry, but has all attributes of the last one. What "
        "the last entry does not mention has its default, whatever the earlier ones say: so a "
        "timeout or parameters of an earlier entry are lost silently. The message says which "
        "attributes the later entry changes.",
    .example = R"(behaviors:
- {behavior: ROTATE_WITH_PID, task: ROTATE}
tasks:
- {task: ROTATE, timeout: 30}
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
)",
    .mending = "Merge the two entries, or correct the name of one of them.",
    .mended = R"(behaviors:
- {behavior: ROTATE_WITH_PID, task: ROTATE}
tasks:
- task: ROTATE
  timeout: 30
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
)",
};

const Rule on_request_and_reactive = {
    .name = "on-request-and-reactive",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "A task is set to start only on request, and also by itself.",
    .explanation =
        "With start_on_request TRUE the coordinator starts a task only when it is requested; with "
        "reactive_start TRUE it starts the task by itself whenever that is possible. A task cannot "
        "have both, so the catalog is neither compiled nor solved.\n\n"
        "A task that itself says 'reactive_start: TRUE' and nothing about start_on_request has "
        "start_on_request FALSE, whatever default_values says. In all other cases in which both "
        "are TRUE, by the task itself or by default, the rule is broken.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
tasks:
- task: HOVER
  execution_goal: keep_running
  reactive_start: TRUE
  start_on_request: TRUE
)",
    .mending =
        "Remove the one that is not meant, or set it to FALSE. A reactive task can still be "
        "requested.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
tasks:
- {task: HOVER, execution_goal: keep_running, reactive_start: TRUE}
)",
};

const Rule never_started = {
    .name = "never-started",
    .severity = Severity::warning,
    .summary = "Only a request starts a task, though its start_on_request is false.",
    .explanation =
        "A task with start_on_request false is one that may start without a request: because a "
        "behavior requires it, or by itself if it has reactive_start. This task has no "
        "reactive_start, and no behavior requires it. So it runs only if somebody requests it, "
        "like "
        "a task with start_on_request true.\n\n"
        "Catalogs that were upgraded by hand have lost reactive_start in this way: the older key "
        "'default: TRUE' says the same. 'cbc graph --diff OLD NEW' shows what an upgrade has "
        "changed.\n\n"
        "In a catalog in which no task starts on request or by itself, one finding stands for all "
        "such tasks.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: LAND_WITH_PID, task: LAND}
tasks:
- {task: HOVER, execution_goal: keep_running, start_on_request: FALSE}
- task: LAND
exclusivity_constraints:
- mutually_exclusive: [HOVER, LAND]
)",
    .mending =
        "Add 'reactive_start: TRUE' if the task is to start by itself, or let a behavior require "
        "it. If it is meant to be requested, write 'start_on_request: TRUE'.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
- {behavior: LAND_WITH_PID, task: LAND}
tasks:
- {task: HOVER, execution_goal: keep_running, reactive_start: TRUE}
- task: LAND
exclusivity_constraints:
- mutually_exclusive: [HOVER, LAND]
)",
};

const Rule reactive_timeout = {
    .name = "reactive-timeout",
    .severity = Severity::warning,
    .summary = "A reactive task is ended by a timeout, only to start again.",
    .explanation =
        "A reactive task is meant to run whenever nothing prevents it. With execution_goal "
        "achieve_goal and a timeout, its behavior fails each time the timeout expires. Then "
        "another behavior of the task takes over, if there is one, and they take turns forever; or "
        "the task stops, and starts again at the next opportunity, for example when a task that "
        "excludes it stops.\n\n"
        "It does not matter where the timeout comes from: the task, default_values, or a behavior "
        "that performs the task.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
tasks:
- {task: HOVER, reactive_start: TRUE, timeout: 60}
)",
    .mending = "Give the task 'execution_goal: keep_running', and remove its timeout.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER}
tasks:
- {task: HOVER, reactive_start: TRUE, execution_goal: keep_running}
)",
};

const Rule no_timeout_effect = {
    .name = "no-timeout-effect",
    .severity = Severity::note,
    .summary = "A timeout has no effect, since the task keeps running.",
    .explanation =
        "A timeout ends a behavior that does not achieve the goal of its task in time. A task with "
        "execution_goal keep_running has no goal to achieve, so the coordinator sets no timer: the "
        "task runs on, whatever its timeout says.\n\n"
        "The rule is about the timeout of such a task itself, and about the timeout of a behavior "
        "all of whose tasks keep running. A timeout in default_values is meant for other tasks, "
        "and is not reported.",
    .example = R"(behaviors:
- {behavior: GPS, task: LOCALIZE}
tasks:
- {task: LOCALIZE, execution_goal: keep_running, timeout: 30}
)",
    .mending =
        "Remove the timeout, or, if the task is to end, give it 'execution_goal: achieve_goal'.",
    .mended = R"(behaviors:
- {behavior: GPS, task: LOCALIZE}
tasks:
- {task: LOCALIZE, execution_goal: keep_running}
)",
};

const Rule confusable_name = {
    .name = "confusable-name",
    .severity = Severity::warning,
    .summary = "A name is easily taken for another one, or has an invisible character.",
    .explanation =
        "Two names differ only in upper and lower case, in what separates the words ('_', '-', "
        "'.', '/' or blanks), in characters that look alike (0 and O; 1, l and I; a Latin letter "
        "and a Cyrillic or Greek one that looks like it), or in "
        "characters that cannot be seen. To the coordinator they are different names, so it goes "
        "unnoticed where one stands in place of the other. A name with a character that cannot be "
        "seen is reported also if there is no other one.\n\n"
        "Tasks are compared with tasks, the parameters of one task and the values of one parameter "
        "or situation variable with one another, and behaviors also with situation variables. A "
        "task and a behavior are not compared; they may even have the same name.",
    .example = R"(behaviors:
- {behavior: FOLLOW_PATH_WITH_PID, task: FOLLOW_PATH}
- {behavior: FOLLOW_PATH_WITH_MPC, task: Follow_Path}
tasks:
- task: FOLLOW_PATH
- task: Follow_Path
)",
    .mending =
        "If both names mean the same, use one of them; otherwise rename one. "
        "Remove invisible characters.",
    .mended = R"(behaviors:
- {behavior: FOLLOW_PATH_WITH_PID, task: FOLLOW_PATH}
- {behavior: FOLLOW_PATH_WITH_MPC, task: FOLLOW_PATH}
tasks:
- task: FOLLOW_PATH
)",
};

const Rule suspicious_suitability = {
    .name = "suspicious-suitability",
    .severity = Severity::warning,
    .summary = "A suitability is 1 percent or less.",
    .explanation =
        "Suitabilities are given in percent, from 0 to 100. One that is at most 1 is probably a "
        "fraction: 0.9 means 0.9 percent, not 90. Of the configurations that serve the same "
        "requests the coordinator takes the one with the highest product of suitabilities, so it "
        "avoids such a behavior where it can, and it reaches no useful minimum_performance.\n\n"
        "A suitability of 0 makes the whole product 0, however suitable all other behaviors are, "
        "so that they no longer count.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, suitability: 0.9}
tasks: [{task: HOVER}]
)",
    .mending =
        "Give the suitability in percent. If the behavior is a last resort, chosen only where "
        "nothing else is possible, keep the value and allow the rule there.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, suitability: 90}
tasks: [{task: HOVER}]
)",
};

const Rule suspicious_minimum = {
    .name = "suspicious-minimum",
    .severity = Severity::warning,
    .summary = "A minimum performance is above 0, but 1 percent or less.",
    .explanation =
        "A minimum_performance, of a requirement or of a task, is given in percent, from 0 to 100. "
        "One that is above 0 and at most 1 is probably a fraction: 0.8 means 0.8 percent, not 80. "
        "Nearly every choice of behaviors reaches it, so the coordinator accepts choices that the "
        "author of the catalog wanted to rule out.",
    .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires:
  - task: LOCALIZE
    minimum_performance: 0.8
- {behavior: GPS, task: LOCALIZE, suitability: 90}
tasks:
- task: HOVER
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
)",
    .mending = "Give the minimum in percent.",
    .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires:
  - task: LOCALIZE
    minimum_performance: 80
- {behavior: GPS, task: LOCALIZE, suitability: 90}
tasks:
- task: HOVER
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
)",
};

const Rule duplicate_parameter = {
    .name = "duplicate-parameter",
    .severity = Severity::warning,
    .summary = "A parameter is listed twice in one task.",
    .explanation =
        "Two entries with the same name both define the allowed values, perhaps differently. Often "
        "the second one was copied and not renamed: then the parameter that was meant is not "
        "declared, and a request that gives it breaks undeclared-parameter.",
    .example = R"(behaviors:
- {behavior: ROTATE_WITH_PID, task: ROTATE}
tasks:
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
  - parameter: angle
    allowed_values: [0, 90]
)",
    .mending = "Give the second entry the intended name, or remove one of the two.",
    .mended = R"(behaviors:
- {behavior: ROTATE_WITH_PID, task: ROTATE}
tasks:
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
  - parameter: speed
    allowed_values: [0, 90]
)",
};

const Rule empty_range = {
    .name = "empty-range",
    .severity = Severity::warning,
    .summary = "A range of allowed values is empty.",
    .explanation =
        "Two numbers as allowed_values are a range: from the first to the second, both of them "
        "included. Here the first is greater than the second, so no value is allowed, and every "
        "request that gives the parameter breaks parameter-value.",
    .example = R"(behaviors:
- {behavior: ROTATE_WITH_PID, task: ROTATE}
tasks:
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [360, -360]
)",
    .mending = "Give the lowest value first.",
    .mended = R"(behaviors:
- {behavior: ROTATE_WITH_PID, task: ROTATE}
tasks:
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
)",
};

const Rule unknown_type = {
    .name = "unknown-type",
    .severity = Severity::note,
    .summary = "Allowed values name an unknown type.",
    .explanation =
        "allowed_values is a range of numbers, a list of words, or a single word, which is the "
        "name of a type. The types that cbc knows are string, boolean, integer, number and point, "
        "and lists of them, such as list_of_strings and point_list. With any other name every "
        "value is accepted, as there is nothing to check it against; the robot may still refuse "
        "it.",
    .example = R"(behaviors:
- {behavior: SPEAK_WITH_LOUDSPEAKER, task: SPEAK}
tasks:
- task: SPEAK
  parameters:
  - parameter: message
    allowed_values: sentence
)",
    .mending =
        "Name a known type. A single allowed word is written as a list, in brackets. If the type "
        "is one of your own, keep it and allow the rule there.",
    .mended = R"(behaviors:
- {behavior: SPEAK_WITH_LOUDSPEAKER, task: SPEAK}
tasks:
- task: SPEAK
  parameters:
  - parameter: message
    allowed_values: string
)",
};

}  // namespace cbc::rule
