// Small catalogs and scripts around what is allowed. With `good` and `bad` lint and the schema agree;
// `unseen` is what lint reports and the schema lets pass, since YAML 1.2, JSON, or a single entry do not
// show it.
'use strict';

const catalog = `behaviors:
- behavior: HOVER_WITH_MPC
  task: HOVER
  requires: [{task: LOCALIZE}]
- behavior: GPS
  task: LOCALIZE
tasks:
- task: HOVER
  parameters: [{parameter: height, allowed_values: [0, 30]}]
- task: LOCALIZE
  execution_goal: keep_running
  start_on_request: FALSE
`;

const behavior = (text) => `behaviors: [{behavior: GPS, task: LOCALIZE, ${text}}]`;
const task = (text) => `tasks: [{task: LOCALIZE, ${text}}]\nbehaviors: []`;
const defaults = (text) => `default_values: ${text}\nbehaviors: []`;
const lists = (text) => `exclusivity_constraints: ${text}\nbehaviors: []`;
const event = (text) => `[{start: HOVER}, {${text}}]`;

const catalogs = {
  good: [
    'behaviors: []',
    'behaviors: []\nx-note: {any: [thing]}',
    'behaviors: []\ntasks:\ndefault_values: ~\nexclusivity_constraints: null',
    'behaviors: [{behavior: 1.5, task: true}, {behavior: "GPS", task: 2024-01-01, package: 3}]',
    behavior('suitability: 1e2'),
    behavior('suitability: .5'),
    behavior('suitability: +5.'),
    behavior('suitability: -0'),
    behavior('suitability: 0005.2500'),
    behavior('suitability: !!int 50'),
    behavior('timeout: 0.000001, package: ""'),
    behavior('timeout: 1000000000, requires: []'),
    behavior('suitability: ~, efficacy: 80, timeout: null, requires: ~, package:'),
    behavior('tasks: ~'),
    'behaviors: [{behavior: GPS, task: ~, tasks: [{task: LOCALIZE}]}]',
    'behaviors: [{behavior: GPS, tasks: [{task: A, efficacy: 1, suitability: ~}, {task: B}]}]',
    'x-a: &a {task: A}\nbehaviors: [{behavior: GPS, <<: *a}]',
    task('start_on_request: true'),
    task('start_on_request: FALSE, reactive_start: True'),
    task('start_on_request: yes'),
    task('start_on_request: Off'),
    task('start_on_request: n, x-why: because'),
    task('execution_goal: "keep_running"'),
    task('category: recurrent, automatic_activation: no, default: OFF'),
    task('minimum_performance: 100, parameters: []'),
    task('parameters: [{parameter: 7, allowed_values: []}, {parameter: b, allowed_values: ""}]'),
    task('parameters: [{parameter: a, allowed_values: [1, b, true, ""]}, {parameter: b}]'),
    defaults('{}'),
    defaults('[]'),
    defaults('[{tasks: [{timeout: 15}, {start_on_request: TRUE}]}, {behaviors: {suitability: 9}}]'),
    defaults('{tasks: ~, behaviors: [{package: a}, {efficacy: 9}], x-own: 1}'),
    lists('[]'),
    lists('[{mutually_exclusive: []}]'),
  ],
  bad: [
    '',
    'HOVER',
    '[HOVER]',
    'tasks: []',
    'behaviors:',
    'behaviors: GPS',
    'behaviors: {}',
    'behaviors: [GPS]',
    'behaviors: [~]',
    'behaviors: []\nbehavior: []',
    'behaviors: []\nX-note: 1',
    'behaviors: [{behavior: GPS}]',
    'behaviors: [{behavior: GPS, task: ~}]',
    'behaviors: [{behavior: "", task: LOCALIZE}]',
    'behaviors: [{behavior: ~, task: LOCALIZE}]',
    'behaviors: [{behavior: GPS, task: [LOCALIZE]}]',
    'behaviors: [{behavior: GPS, tasks: []}]',
    'behaviors: [{behavior: GPS, tasks: {task: LOCALIZE}}]',
    'behaviors: [{behavior: GPS, tasks: [LOCALIZE]}]',
    'behaviors: [{behavior: GPS, tasks: [{suitability: 80}]}]',
    `behaviors: [{behavior: GPS, tasks: [${Array.from({length: 101}, (_, i) => `{task: T${i}}`)}]}]`,
    behavior('tasks: [{task: HOVER}]'),
    behavior('tasks: []'),
    behavior('task: HOVER'),
    behavior('suitabilty: 80'),
    behavior('minimum_performance: 80'),
    behavior('suitability: 80, efficacy: 80'),
    behavior('suitability: "80"'),
    behavior('suitability: 80 %'),
    behavior('suitability: 1_0'),
    behavior('suitability: .inf'),
    behavior('suitability: .nan'),
    behavior('suitability: -1'),
    behavior('suitability: 100.0001'),
    behavior('suitability: 1e400'),
    behavior('suitability: [80]'),
    behavior('suitability: true'),
    behavior('timeout: 0'),
    behavior('timeout: -0'),
    behavior('timeout: 1000000001'),
    behavior('package: [a]'),
    behavior('requires: LOCALIZE'),
    behavior('requires: [LOCALIZE]'),
    behavior('requires: [{minimum_performance: 80}]'),
    behavior('requires: [{task: LOCALIZE, suitability: 80}]'),
    'tasks: [LOCALIZE]\nbehaviors: []',
    'tasks: [{timeout: 5}]\nbehaviors: []',
    task('timout: 5'),
    task('requires: []'),
    task('start_on_request: 1'),
    task('start_on_request: maybe'),
    task('start_on_request: "true"'),
    task('execution_goal: recurrent'),
    task('category: keep_running'),
    task('execution_goal: achieve_goal, category: recurrent'),
    task('start_on_request: yes, automatic_activation: yes'),
    task('reactive_start: no, default: no'),
    task('parameters: {parameter: a}'),
    task('parameters: [a]'),
    task('parameters: [{allowed_values: string}]'),
    task('parameters: [{parameter: a, allowed_values: {a: b}}]'),
    task('parameters: [{parameter: a, allowed_values: [[1, 2]]}]'),
    task('parameters: [{parameter: a, allowed_values: [~]}]'),
    task('parameters: [{parameter: a, values: []}]'),
    defaults('1'),
    defaults('[tasks]'),
    defaults('{task: {timeout: 5}}'),
    defaults('{timeout: 5}'),
    defaults('[[{tasks: {timeout: 5}}]]'),
    defaults('{tasks: {minimum_performance: 5}}'),
    defaults('{behaviors: [{timeout: 5}]}'),
    defaults('{behaviors: {suitability: 80, efficacy: 80}}'),
    defaults('{tasks: {category: goal_based, execution_goal: achieve_goal}}'),
    lists('{mutually_exclusive: []}'),
    lists('[{mutually_exclusive: A}]'),
    lists('[{mutually_exclusive: }]'),
    lists('[{mutually_exclusive: [~]}]'),
    lists('[{mutualy_exclusive: [A]}]'),
    lists('[[A, B]]'),
    'behaviors: []\nbehaviors: []',
    'behaviors: []\n---\nbehaviors: []',
    'behaviors: [',
  ],
  unseen: [
    behavior('suitability: 0x10'), // 16 to YAML 1.2
    behavior('suitability: 0o17'),
    behavior('suitability: 33.33333'), // too precise
    behavior('timeout: 0.0000001'),
    task('start_on_request: "yes"'), // a text, as yes without quotes is to YAML 1.2
    task('start_on_request: true, reactive_start: true'), // the defaults have a say in it, too
    'behaviors: [{behavior: GPS, tasks: [{task: A}, {task: A}]}]',
    'behaviors: [{behavior: GPS, task: A}, {behavior: GPS, task: B}]',
    behavior('requires: [{task: HOVER}]'), // not defined
    behavior('requires: [{task: LOCALIZE}]'), // a cycle
    defaults('{tasks: [{timeout: 5}, {timeout: 6}]}'), // the same key twice
  ],
};

const scripts = {
  good: [
    '[]',
    'events: []',
    'events: []\nx-note: 1\ncatalog: ~\nreactive_delay:\nsituation: ~',
    'events: []\ncatalog: 7\nreactive_delay: 1e-1\nsituation: {GPS: no}',
    event('start: HOVER, priority: 2147483647, at: 0'),
    event('start: HOVER, parameters: {height: 7}, wait: 1e3'),
    event('start: HOVER, parameters: {}, priority: ~, cause: ~'),
    event('start: HOVER, stop: ~, x-why: because'),
    event('stop: HOVER, priority: 0, at: ~, wait: 5'),
    event('stop: "HOVER", parameters: ~'),
    event('finish: GPS'),
    event('finish: GPS, cause: time_out'),
    event('fault: GPS'),
    event('repair: GPS, at: 1000000000'),
    event('situation: {}'),
    event('situation: {GPS: Off, HOVER_WITH_MPC: TRUE}'),
    event('at: 5'),
    event('wait: 0'),
    event('expect: {}'),
    event(
      'expect: {outcome: accepted, running: {HOVER: any, LOCALIZE: GPS}, stopped: [], active: []}'
    ),
    event('expect: {outcome: ~, running: ~, stopped: ~, active: ~}, at: 5'),
  ],
  bad: [
    '',
    'HOVER',
    '{}',
    'events:',
    'events: {start: HOVER}',
    'event: []\nevents: []',
    'events: []\ncatalog: ""',
    'events: []\ncatalog: [a]',
    'events: []\nreactive_delay: 0',
    'events: []\nreactive_delay: soon',
    'events: []\nsituation: [GPS]',
    'events: []\nsituation: {GPS: ~}',
    '[HOVER]',
    '[~]',
    event(''),
    event('x-why: because'),
    event('start: ~'),
    event('start: ~, at: 5'),
    event('start: ""'),
    event('start: [HOVER]'),
    event('stat: HOVER'),
    event('start: HOVER, stop: HOVER'),
    event('fault: GPS, repair: GPS'),
    event('finish: GPS, expect: {}'),
    event('start: HOVER, priority: 0'),
    event('start: HOVER, priority: 1.5'),
    event('start: HOVER, priority: high'),
    event('start: HOVER, priority: "2"'),
    event('start: HOVER, priority: 2147483648'),
    event('stop: HOVER, priority: -1'),
    event('finish: GPS, priority: 1'),
    event('at: 5, priority: 1'),
    event('stop: HOVER, parameters: {}'),
    event('start: HOVER, parameters: [7]'),
    event('start: HOVER, cause: time_out'),
    event('finish: GPS, cause: timeout'),
    event('finish: GPS, cause: [time_out]'),
    event('fault: GPS, cause: process_failure'),
    event('situation: GPS'),
    event('situation: {GPS: 0}'),
    event('at: 5, wait: 5'),
    event('start: HOVER, at: 5, wait: 5'),
    event('at: -1'),
    event('at: 1000000001'),
    event('at: "5"'),
    event('wait: soon'),
    event('expect: ~'),
    event('expect: HOVER'),
    event('expect: {outcom: accepted}'),
    event('expect: {outcome: ok}'),
    event('expect: {running: [HOVER]}'),
    event('expect: {running: {HOVER: ~}}'),
    event('expect: {running: {HOVER: [any]}}'),
    event('expect: {stopped: HOVER}'),
    event('expect: {active: [~]}'),
    event('expect: {active: {GPS: true}}'),
  ],
  unseen: [
    event('start: LAND'), // not defined
    event('finish: HOVER'),
    event('start: HOVER, priority: 1.0'), // an integer to JSON
    event('start: HOVER, priority: 0x10'),
    event('start: HOVER, parameters: {height: 50}'), // the catalog does not allow it
    event('start: HOVER, at: 0.0000001'), // too precise
    '[{at: 5}, {at: 4}]',
  ],
};

module.exports = {catalog, edges: {catalog: catalogs, script: scripts}};
