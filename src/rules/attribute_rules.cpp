#include "rules/topics.h"

namespace cbc {
namespace {

constexpr Rule attribute_table[] = {
    {.name = rule::on_request_and_reactive,
     .severity = Severity::error,
     .is_fixed = true,
     .summary = "A task is to start on request only, and also by itself.",
     .explanation =
         "With start_on_request TRUE the coordinator starts a task only when it is requested; with "
         "reactive_start TRUE it starts the task by itself whenever that is possible. A task "
         "cannot have both, so the catalog is neither compiled nor solved.\n\n"
         "A task that itself says 'reactive_start: TRUE' and nothing about start_on_request has "
         "start_on_request FALSE, whatever default_values says. In all other cases in which both "
         "are TRUE, by the task itself or by default, the rule is broken.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
tasks:
- task: HOVER
  execution_goal: keep_running
  reactive_start: TRUE
  start_on_request: TRUE
)",
     .mending =
         "Remove the one that is not meant, or set it to FALSE. A reactive task can be requested "
         "all the same.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
tasks:
- task: HOVER
  execution_goal: keep_running
  reactive_start: TRUE
)"},

    {.name = rule::reactive_timeout,
     .severity = Severity::warning,
     .summary = "A reactive task is ended by a timeout, only to start again.",
     .explanation =
         "A reactive task is to run whenever nothing speaks against it. With execution_goal "
         "achieve_goal and a timeout its behavior fails each time that the timeout is over. Then "
         "another behavior of the task goes on, if there is one, and they take turns for ever; or "
         "the task stops, and starts again at the next occasion, for example when a task stops "
         "that excludes it.\n\n"
         "It does not matter where the timeout comes from: the task, default_values, or a behavior "
         "that performs the task.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
tasks:
- task: HOVER
  reactive_start: TRUE
  timeout: 60
)",
     .mending = "Give the task 'execution_goal: keep_running', and remove its timeout.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
tasks:
- task: HOVER
  reactive_start: TRUE
  execution_goal: keep_running
)"},

    {.name = rule::no_timeout_effect,
     .severity = Severity::note,
     .summary = "A timeout has no effect, since the task is to keep running.",
     .explanation =
         "A timeout ends a behavior that does not achieve the goal of its task in time. A task "
         "with execution_goal keep_running has no goal to achieve, so the coordinator sets no "
         "timer: the task runs on, whatever its timeout says.\n\n"
         "The rule is about the timeout of such a task itself, and about that of a behavior all of "
         "whose tasks are such. A timeout in default_values is for the other tasks, and is not "
         "reported.",
     .example = R"(behaviors:
- behavior: GPS
  task: LOCALIZE
tasks:
- task: LOCALIZE
  execution_goal: keep_running
  timeout: 30
)",
     .mending =
         "Remove the timeout, or, if the task is to end, give it 'execution_goal: achieve_goal'.",
     .mended = R"(behaviors:
- behavior: GPS
  task: LOCALIZE
tasks:
- task: LOCALIZE
  execution_goal: keep_running
)"},

    {.name = rule::suspicious_suitability,
     .severity = Severity::warning,
     .summary = "A suitability is 1 percent or less.",
     .explanation =
         "Suitabilities are given in percent, from 0 to 100. One that is at most 1 is probably a "
         "fraction: 0.9 means 0.9 percent, not 90. Of the configurations that serve the same "
         "requests the coordinator takes the one with the highest product of suitabilities, so it "
         "avoids such a behavior where it can, and no minimum_performance worth the name is "
         "reached with it.\n\n"
         "A suitability of 0 makes the whole product 0, however suitable all other behaviors are, "
         "so that they no longer count.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 0.9
tasks:
- task: HOVER
)",
     .mending =
         "Give the suitability in percent. If a last resort is meant, which is chosen only where "
         "nothing else will do, keep it and allow the rule there.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  suitability: 90
tasks:
- task: HOVER
)"},

    {.name = rule::suspicious_minimum,
     .severity = Severity::warning,
     .summary = "A minimum performance is over 0, but 1 percent or less.",
     .explanation =
         "A minimum_performance, of a requirement or of a task, is given in percent, from 0 to "
         "100. One that is over 0 and at most 1 is probably a fraction: 0.8 means 0.8 percent, not "
         "80. Nearly every choice of behaviors reaches it, so the coordinator accepts ones that "
         "the author of the catalog wanted to rule out.",
     .example = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires:
  - task: LOCALIZE
    minimum_performance: 0.8
- behavior: GPS
  task: LOCALIZE
  suitability: 90
tasks:
- task: HOVER
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)",
     .mending = "Give the minimum in percent.",
     .mended = R"(behaviors:
- behavior: HOVER_WITH_PID
  task: HOVER
  requires:
  - task: LOCALIZE
    minimum_performance: 80
- behavior: GPS
  task: LOCALIZE
  suitability: 90
tasks:
- task: HOVER
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
)"},
};

}  // namespace

std::span<const Rule> attribute_rules() { return attribute_table; }

}  // namespace cbc
