#include "support/rich_catalog.h"

namespace cbc::test {

const std::string_view rich_catalog = R"(
default_values:
  tasks: {start_on_request: FALSE}
tasks:
- {task: GO, start_on_request: TRUE, timeout: 5, resume: TRUE, improve: at_once}
- {task: LOOK, parameters: [{parameter: speed, allowed_values: [0, 30]}, {parameter: to}]}
- {task: MOVE, minimum_performance: 40, execution_goal: keep_running}
- {task: REST, reactive_start: TRUE, reactive_priority: 2, execution_goal: keep_running}
- {task: TALK, parameters: [{parameter: text, allowed_values: string}]}
behaviors:
- {behavior: go, task: GO, package: drive, requires: [{task: MOVE, minimum_performance: 60}]}
- {behavior: go_slowly, task: GO, suitability: 70, requires: [{task: MOVE}, {task: LOOK}]}
- {behavior: look, task: LOOK, suitability: 95, retry: when_started}
- {behavior: both, package: drive, tasks: [{task: LOOK, suitability: 50}, {task: MOVE}]}
- {behavior: move, task: MOVE, suitability: 80.5, timeout: 9}
- {behavior: rest, task: REST}
- {behavior: talk, task: TALK, package: voice, situation: {PEOPLE: [few, many], NIGHT: false}}
exclusivity_constraints:
- mutually_exclusive: [REST, GO, TALK]
- mutually_exclusive: [REST, LOOK]
- {mutually_exclusive: [GO, LOOK, MOVE], at_most: 2}
situation:
- {variable: PEOPLE, values: [none, few, many]}
- {variable: NIGHT}
)";

}  // namespace cbc::test
