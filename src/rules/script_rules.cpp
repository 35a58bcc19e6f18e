#include "rules/topics.h"

namespace cbc {
namespace {

constexpr std::string_view catalog_text = R"(behaviors:
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

constexpr Rule script_table[] = {
    {.name = rule::undefined_behavior,
     .severity = Severity::error,
     .is_fixed = true,
     .is_of_scripts = true,
     .summary = "A script names a behavior that the catalog does not have.",
     .explanation =
         "finish, fault and repair, the keys of situation, and the expectations about running and "
         "active behaviors name behaviors. Without such a behavior the event has no meaning, so "
         "the script is not run. The message gives the nearest known name, and says so if there is "
         "a task of this name.",
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
)"},

    {.name = rule::time_order,
     .severity = Severity::error,
     .is_fixed = true,
     .is_of_scripts = true,
     .summary = "A script goes back in time.",
     .explanation =
         "'at' is the time of an event in seconds since the beginning of the script, and each "
         "event happens at the time of the one before it or later. Here it is earlier. The clock "
         "of the coordinator only goes forward, and what was due by then has already happened, so "
         "the script is not run.",
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
)"},

    {.name = rule::undeclared_parameter,
     .severity = Severity::error,
     .is_of_scripts = true,
     .summary = "A start gives a parameter that its task does not declare.",
     .explanation =
         "The coordinator hands parameters on to the behavior as they are. A misspelt one stops "
         "nothing: the behavior runs without the value that is meant for it, or fails on the "
         "robot. The message gives the nearest declared name.\n\n"
         "'cbc solve' reports it as a warning and goes on, since the choice of behaviors does not "
         "depend on parameters.",
     .example = R"(events:
- start: ROTATE
  parameters: {angel: 90}
)",
     .mending = "Correct the name, or declare the parameter in the catalog.",
     .mended = R"(events:
- start: ROTATE
  parameters: {angle: 90}
)"},

    {.name = rule::parameter_value,
     .severity = Severity::error,
     .is_of_scripts = true,
     .summary = "A start gives a parameter a value that its task does not allow.",
     .explanation =
         "The catalog says by allowed_values what the parameter may be: a number from the first to "
         "the second of two, one of a list of words, or anything of a type, such as string or "
         "point_list. The value is none of these. On the robot the behavior would refuse it, or do "
         "something that nobody wants.\n\n"
         "'cbc solve' reports it as a warning and goes on, since the choice of behaviors does not "
         "depend on parameters.",
     .example = R"(events:
- start: ROTATE
  parameters: {angle: 720}
)",
     .mending = "Give an allowed value, or allow this one in the catalog.",
     .mended = R"(events:
- start: ROTATE
  parameters: {angle: 360}
)"},

    {.name = rule::still_available,
     .severity = Severity::warning,
     .is_of_scripts = true,
     .summary = "A behavior ends because of the situation, but stays available.",
     .explanation =
         "A finish with cause situation_change says that the behavior stopped because the "
         "situation does not allow it any more. That it may not be activated is another thing to "
         "say, by situation. As long as the behavior is available the coordinator may choose it "
         "again at this very event, and mostly does, since it was the best choice just before. On "
         "a robot, the behavior would say by then that its situation does not hold.",
     .example = R"(events:
- start: ROTATE
- finish: GPS
  cause: situation_change
  at: 12.5
)",
     .mending = "Say 'situation: {BEHAVIOR: false}' before the behavior finishes.",
     .mended = R"(events:
- start: ROTATE
- situation: {GPS: false}
  at: 12.5
- finish: GPS
  cause: situation_change
)"},

    {.name = rule::impossible_expectation,
     .severity = Severity::warning,
     .is_of_scripts = true,
     .summary = "A script expects what can never be.",
     .explanation =
         "A behavior is expected to run a task that it does not perform, or a task is expected "
         "both to run and to be stopped. Whatever happens before, this expect fails.",
     .example = R"(events:
- start: ROTATE
- expect: {running: {ROTATE: GPS}}
)",
     .mending =
         "Name a behavior that performs the task, or leave the task out of one of the two lists.",
     .mended = R"(events:
- start: ROTATE
- expect: {running: {ROTATE: ROTATE_WITH_PID}}
)"},
};

}  // namespace

std::span<const Rule> script_rules() { return script_table; }

std::string_view example_catalog() { return catalog_text; }

}  // namespace cbc
