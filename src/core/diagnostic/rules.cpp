#include "core/diagnostic/rules.h"

#include <algorithm>

namespace cbc {

namespace rule {

// Rules about any file, and about comments and settings that control findings.

const Rule yaml_syntax = {
    .name = "yaml-syntax",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "The file is not one valid YAML document.",
    .explanation =
        "A file that is not YAML cannot be read at all: this is its only finding, and the file is "
        "neither compiled nor solved. The finding is at the place where reading had to stop. The "
        "mistake may be a little before that place: an indentation that differs from that of the "
        "line above, a bracket or a quote that is not closed, a tab that indents, a text with ': ' "
        "in it that is not in quotes.\n\n"
        "The rule also covers a text that is not UTF-8 or has control characters, a second "
        "document in the file, tags of other programs, lists and mappings that are nested too "
        "deeply, and aliases that stand for too many values.",
    .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
 suitability: 90
tasks:
- task: HOVER
)",
    .mending =
        "Look at the place of the finding and at the lines just above it. Give all keys of one "
        "mapping the same indentation, indent with spaces, and close what was opened.",
    .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 90
tasks:
- task: HOVER
)",
};

const Rule unknown_key = {
    .name = "unknown-key",
    .severity = Severity::warning,
    .summary = "A key is not known at this place.",
    .explanation =
        "An unknown key has no effect. With a misspelled 'suitability' a behavior has the default "
        "one; with a misspelled 'requires' it requires nothing, and the coordinator runs it "
        "without what it needs. The message gives the key that is probably meant, or the level of "
        "the file at which the key belongs.\n\n"
        "In a catalog it is an error if a known key of this place is probably meant, and a "
        "warning otherwise. In "
        "an event script or a property file it is an error that settings cannot change. Keys that "
        "begin with 'x-' are the user's own, and are ignored. If a required key is misspelled, the "
        "finding is missing-key.",
    .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitabilty: 80
tasks:
- task: HOVER
)",
    .mending =
        "Correct the key, move it to where it belongs, or remove it. Keys for other programs must "
        "begin with 'x-'.",
    .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 80
tasks:
- task: HOVER
)",
};

const Rule missing_key = {
    .name = "missing-key",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "A mapping lacks a required key.",
    .explanation =
        "A catalog must have 'behaviors'; a behavior its name, 'behavior', and 'task' or 'tasks'; "
        "a task, a requirement and each task of a behavior 'task'; a parameter 'parameter'; a "
        "situation variable 'variable'; an exclusivity constraint 'mutually_exclusive'. A script "
        "must have 'events', unless it is just a list of events, and an event must have a verb or "
        "a time. A property must have a kind, such as 'can_start', and a condition at least one "
        "part; without 'properties' a property file has nothing but assumptions, which is a "
        "note.\n\n"
        "A key with a null value counts as absent. A key that resembles the missing one is taken "
        "in its place, so that the rest can be checked; the message then names both. Since a "
        "missing value cannot be guessed, such a file is neither compiled nor solved.",
    .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  package: motion_control
tasks:
- task: HOVER
)",
    .mending = "Add the key, or correct the one that is misspelled.",
    .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  package: motion_control
  task: HOVER
tasks:
- task: HOVER
)",
};

const Rule older_format = {
    .name = "older-format",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "The catalog has an older format that is not supported.",
    .explanation =
        "In catalogs for the first versions of the coordinator, behaviors have 'capabilities' and "
        "'incompatible_lists' in place of tasks and requirements; the sections are called "
        "'behavior_descriptors', 'capability_descriptors' or 'basic_behaviors'. What such a "
        "catalog means differs, so it is neither compiled nor solved, and nothing else of it is "
        "checked.\n\n"
        "Catalogs that have tasks, but older names for some keys, are understood: see "
        "deprecated-key.",
    .example = R"(behavior_descriptors:
- behavior: GO_TO_POINT
  timeout: 30
  incompatible_lists: [motion_behaviors]
  capabilities: [PATH_PLANNING]
- behavior: KEEP_HOVERING
  category: recurrent
  incompatible_lists: [motion_behaviors]
capability_descriptors:
- capability: PATH_PLANNING
  process_sequence: [planner]
)",
    .mending =
        "Write the catalog anew: a behavior performs a task; what was a capability is a task of "
        "its own that the behavior requires, and what was an incompatible list is a list of tasks "
        "under 'mutually_exclusive'.",
    .mended = R"(behaviors:
- {behavior: GO_TO_POINT, task: MOVE, requires: [{task: PLAN_PATH}]}
- {behavior: KEEP_HOVERING, task: HOVER}
- {behavior: PLANNER, task: PLAN_PATH}
tasks:
- {task: MOVE, timeout: 30}
- {task: HOVER, execution_goal: keep_running}
- {task: PLAN_PATH, execution_goal: keep_running, start_on_request: FALSE}
exclusivity_constraints:
- mutually_exclusive: [MOVE, HOVER]
)",
};

const Rule wrong_type = {
    .name = "wrong-type",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "A value has the wrong type for its key.",
    .explanation =
        "A list, a mapping, a number, a boolean or a text stands where something else is expected; "
        "the message says what. Often it is a name where a list is expected, a bare name in the "
        "place of 'task: NAME', a number with a unit ('90 %', '15 s'), or a number or a boolean in "
        "quotes, which make it a text.\n\n"
        "cbc does not guess what is meant: such a file is neither compiled nor solved.",
    .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires: LOCALIZE
- behavior: GPS
  task: LOCALIZE
tasks:
- task: HOVER
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)",
    .mending = "Write the value as the message says.",
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
)",
};

const Rule invalid_value = {
    .name = "invalid-value",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "A value has the right type, but is not allowed.",
    .explanation =
        "Percentages go from 0 to 100 and have at most four decimals. Times are in seconds and "
        "have at most six, and a timeout is greater than 0. execution_goal is achieve_goal or "
        "keep_running. A name is not empty, and a behavior performs at least one task, each of "
        "them once. In a script, an event has one verb and not both 'at' and 'wait', a priority is "
        "an integer, at least 1 for a start and 0 for a stop, and causes and outcomes are known "
        "words. In a property file, a property is of one kind, a list has each name once, and "
        "'never' of 'assume' excludes neither every situation nor the one at the beginning.\n\n"
        "A value is never rounded or cut to an allowed one, since the file would then mean "
        "something that nobody wrote: it is neither compiled nor solved.",
    .example = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, suitability: 120}
tasks: [{task: HOVER}]
)",
    .mending = "Give one of the values that the message names.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, suitability: 100}
tasks: [{task: HOVER}]
)",
};

const Rule duplicate_key = {
    .name = "duplicate-key",
    .severity = Severity::error,
    .is_fixed = true,
    .summary = "A key is given twice in one mapping.",
    .explanation =
        "Programs that read YAML differ in which of the two values they take, so what the file "
        "means is unclear, and it is neither compiled nor solved.\n\n"
        "An older name and the name that replaced it are one key given twice, and so are 'task' "
        "and 'tasks' of a behavior. default_values may be written as lists of mappings, which "
        "count as one mapping.",
    .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 90
  suitability: 80
tasks:
- task: HOVER
)",
    .mending =
        "Remove the one that is not meant. If the second was meant to begin another list entry, "
        "add the missing '- ' before it.",
    .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 80
tasks:
- task: HOVER
)",
};

const Rule deprecated_key = {
    .name = "deprecated-key",
    .severity = Severity::warning,
    .summary = "A key has an older name.",
    .explanation =
        "Catalogs for earlier versions of the coordinator have other names for some keys. cbc "
        "understands them, but a reader of the catalog has to know both. 'efficacy' is now "
        "'suitability'; 'default' is 'reactive_start'; 'category: goal_based' is 'execution_goal: "
        "achieve_goal', and 'category: recurrent' is 'execution_goal: keep_running'; "
        "'automatic_activation' is the opposite of 'start_on_request', so TRUE becomes FALSE.",
    .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  efficacy: 80
  requires:
  - task: LOCALIZE
- {behavior: GPS, task: LOCALIZE}
tasks:
- task: HOVER
- {task: LOCALIZE, category: recurrent, automatic_activation: TRUE}
)",
    .mending = "Use the current name, which the message gives; 'cbc lint --fix' does this.",
    .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 80
  requires:
  - task: LOCALIZE
- {behavior: GPS, task: LOCALIZE}
tasks:
- task: HOVER
- {task: LOCALIZE, execution_goal: keep_running, start_on_request: FALSE}
)",
};

const Rule unused_allow = {
    .name = "unused-allow",
    .severity = Severity::warning,
    .needs_search = true,
    .summary = "A comment allows a rule that is not broken there.",
    .explanation =
        "A comment '# cbc: allow RULE' at the end of a line allows the rule on this line; alone "
        "above an entry, on the whole entry. Several rules are separated by commas, and a reason "
        "may follow after ' -- '. Here there is no finding of the rule: the mistake was fixed, or "
        "is on another line.\n\n"
        "Left behind, the comment would hide the next mistake of its kind.",
    .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 90  # cbc: allow suspicious-suitability -- a last resort
tasks: [{task: HOVER}]
)",
    .mending =
        "Remove the comment, or the rule from it, or move the comment to the line of the finding.",
    .mended = R"(behaviors:
- {behavior: HOVER_WITH_PID, task: HOVER, suitability: 90}
tasks: [{task: HOVER}]
)",
};

const Rule unknown_rule = {
    .name = "unknown-rule",
    .severity = Severity::warning,
    .summary = "A setting names a rule that does not exist.",
    .explanation =
        "A comment '# cbc: allow RULE' in a file, or a setting in .cbc.yaml, names a rule that cbc "
        "does not have, so it has no effect: what it should allow is still reported. The message "
        "gives the nearest known name; 'cbc lint --list-rules' shows all of them. A reason has to "
        "follow ' -- '; otherwise its words are taken for names of rules.",
    .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 1  # cbc: allow suspicious-suitability, last-resort
tasks: [{task: HOVER}]
)",
    .mending = "Correct the name, or remove it.",
    .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 1  # cbc: allow suspicious-suitability -- a last resort
tasks: [{task: HOVER}]
)",
};

// Rules about event scripts.

const Rule undefined_behavior = {
    .name = "undefined-behavior",
    .severity = Severity::error,
    .is_fixed = true,
    .is_of_scripts = true,
    .summary = "A script or a property file names a behavior that the catalog does not have.",
    .explanation =
        "finish, fault and repair, the keys of situation, and the expectations about running and "
        "active behaviors name behaviors, and so do the conditions of property files. Without such "
        "a behavior the event or the condition has no meaning, so the file is not used. The "
        "message gives the nearest known name, and says so if there is a task of this name.",
    .example = R"(events:
- start: ROTATE
- finish: GSP
  cause: process_failure
  at: 5
)",
    .mending = "Correct the name, or give the catalog that the script is for.",
    .mended = R"(events:
- start: ROTATE
- finish: GPS
  cause: process_failure
  at: 5
)",
};

const Rule time_order = {
    .name = "time-order",
    .severity = Severity::error,
    .is_fixed = true,
    .is_of_scripts = true,
    .summary = "A script goes back in time.",
    .explanation =
        "'at' is the time of an event in seconds since the beginning of the script, and each event "
        "happens at the time of the one before it or later. Here it is earlier. The clock of the "
        "coordinator only goes forward, and what was due by then has already happened, so the "
        "script is not run.",
    .example = R"(events:
- start: ROTATE
  at: 8
- finish: ROTATE_WITH_PID
  at: 3
)",
    .mending =
        "Correct the time, or put the events in the order of their times. 'wait' gives the time "
        "since the event before.",
    .mended = R"(events:
- start: ROTATE
  at: 3
- finish: ROTATE_WITH_PID
  at: 8
)",
};

const Rule undeclared_parameter = {
    .name = "undeclared-parameter",
    .severity = Severity::error,
    .is_of_scripts = true,
    .summary = "A start gives a parameter that its task does not declare.",
    .explanation =
        "The coordinator hands parameters on to the behavior as they are. It does not notice a "
        "misspelled name: the behavior runs without the intended value, or fails on the robot. The "
        "message gives the nearest declared name.\n\n"
        "'cbc solve' reports it as a warning and continues, since the choice of behaviors does not "
        "depend on parameters.",
    .example = R"(events:
- start: ROTATE
  parameters: {angel: 90}
)",
    .mending = "Correct the name, or declare the parameter in the catalog.",
    .mended = R"(events:
- start: ROTATE
  parameters: {angle: 90}
)",
};

const Rule parameter_value = {
    .name = "parameter-value",
    .severity = Severity::error,
    .is_of_scripts = true,
    .summary = "A start gives a parameter a value that its task does not allow.",
    .explanation =
        "In the catalog, allowed_values says what the parameter may be: a number in a range, a "
        "word from a list, or any value of a type, such as string or point_list. This value is not "
        "allowed. On the robot the behavior would refuse it, or do something that nobody wants.\n\n"
        "'cbc solve' reports it as a warning and continues, since the choice of behaviors does not "
        "depend on parameters.",
    .example = R"(events:
- start: ROTATE
  parameters: {angle: 720}
)",
    .mending = "Give an allowed value, or allow this one in the catalog.",
    .mended = R"(events:
- start: ROTATE
  parameters: {angle: 360}
)",
};

const Rule still_available = {
    .name = "still-available",
    .severity = Severity::warning,
    .is_of_scripts = true,
    .summary = "A behavior ends because of the situation, but stays available.",
    .explanation =
        "A finish with cause situation_change says that the behavior stopped because the situation "
        "no longer allows it. That alone does not make the behavior unavailable; an event "
        "'situation' does. As long as it is available, the coordinator may choose it again at this "
        "very event, and usually does, since it was the best choice just before. On a robot, the "
        "behavior would already have reported that its situation does not hold.",
    .example = R"(events:
- start: ROTATE
- finish: GPS
  cause: situation_change
  at: 12.5
)",
    .mending =
        "Add 'situation: {BEHAVIOR: false}' before the behavior finishes. If the behavior depends "
        "on situation variables, set one of them to a value in which it does not fit, in place of "
        "the finish: the behavior then finishes by itself.",
    .mended = R"(events:
- start: ROTATE
- situation: {GPS: false}
  at: 12.5
- finish: GPS
  cause: situation_change
)",
};

const Rule impossible_expectation = {
    .name = "impossible-expectation",
    .severity = Severity::warning,
    .is_of_scripts = true,
    .summary = "A script or a property file names a state that can never be.",
    .explanation =
        "A behavior is expected to run a task that it does not perform; a task is expected both to "
        "run and to be stopped; an active behavior has no task left, or a task that runs no active "
        "behavior; or requirements and exclusions of the catalog do not allow all of it together. "
        "Whatever happens before, the expectation of a script fails.\n\n"
        "In a condition of a property file such a contradiction is an error, which settings cannot "
        "change: 'never' with that condition would be proved, and say nothing. It is a warning if "
        "the catalog rules the condition out, as with two tasks that exclude each other, a "
        "required task that is stopped or a behavior that does not fit the situation, or if the "
        "assumptions do, as with a faulty behavior where 'faults' is 0. Under 'never' it is a "
        "note, "
        "since that is what the property says.",
    .example = R"(events:
- start: ROTATE
- expect: {running: {ROTATE: GPS}}
)",
    .mending =
        "Name a behavior that performs the task, or leave out one of the things that contradict "
        "each other.",
    .mended = R"(events:
- start: ROTATE
- expect: {running: {ROTATE: ROTATE_WITH_PID}}
)",
};

}  // namespace rule

std::string_view example_catalog() {
  return R"(behaviors:
- behavior: ROTATE_WITH_PID
  task: ROTATE
  requires:
  - task: LOCALIZE
- behavior: GPS
  task: LOCALIZE
- behavior: VISUAL_ODOMETRY
  task: LOCALIZE
  suitability: 80
tasks:
- task: ROTATE
  parameters:
  - parameter: angle
    allowed_values: [-360, 360]
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)";
}

std::span<const Rule> all_rules() {
#define CBC_COPY_RULE(name) rule::name,
  static const Rule rules[] = {CBC_RULES(CBC_COPY_RULE)};
#undef CBC_COPY_RULE
  return rules;
}

const Rule* find_rule(std::string_view name) {
  const std::span<const Rule> rules = all_rules();
  const auto found = std::lower_bound(
      rules.begin(), rules.end(), name,
      [](const Rule& rule, std::string_view wanted) { return rule.name < wanted; });
  return found == rules.end() || found->name != name ? nullptr : &*found;
}

}  // namespace cbc
