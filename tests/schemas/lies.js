// What no document may say, although each member by itself is of the right form. By schema: what it
// is, which part of a document it can be said of (a function that finds it, or nothing), and the
// members that say it, or a function that makes the part say it.
'use strict';

const of =
  (find, ...more) =>
  (item) =>
    more.reduce((part, next) => part && next(part), find(item));

// Lines of a stream.
const lineWith = (member) => (line) => member in line && line;
const eventWhere = (fits) => (line) => 'index' in line && fits(line) && line;
const outcome = (word) => eventWhere((line) => line.outcome === word);
const verb = (word) => eventWhere((line) => line.verb === word && line.origin === 'script');
const origin = (word) => eventWhere((line) => line.origin === word);
const searched = of(outcome('rejected'), (line) => line.search && line);
const notSearched = of(outcome('rejected'), (line) => !line.search && line);

// Parts of an event.
const objective = of(outcome('accepted'), (line) => line.objective);
const search = (word) => of(outcome(word), (line) => line.search);
const change = (op, cause) => (line) =>
  (line.changes ?? []).find((item) => item.op === op && (!cause || item.cause === cause));
const stoppedTask = (cause) => (line) =>
  (line.stopped_tasks ?? []).find((item) => item.cause === cause);
const reason = (kind) => (line) =>
  [line, ...(line.why ?? [])]
    .flatMap((item) => item.conflict ?? [])
    .find((item) => item.kind === kind);
const why = (fits) => (line) => (line.why ?? []).find(fits);
const whyTask = why((item) => 'task' in item);
const whyAlternative = why((item) => item.alternative);
const whyNone = why((item) => item.conflict.length > 0);
const loss = (word) =>
  of(
    why((item) => item.loses?.objective === word),
    (item) => item.loses
  );

// Parts of the other documents.
const whole = (document) => document;
const success = (report) => report.runs[0].expectations.successes[0];
const failure = (report) => report.runs[0].expectations.failures[0];
const kindOfTotals = of(lineWith('totals'), (line) => line.totals.kinds[0]);
const goal = (kind) => (report) =>
  report.catalogs[0].goals.find((item) => item.kind === kind);
const moveWith = (word) => (report) =>
  report.moves.find((item) => item.outcome === word && item.conflict.length === (word === 'rejected' ? 1 : 0));
const moveOf = (word) => (report) => report.moves.find((item) => item.verb === word);
const mutant = (result) => (report) => report.mutants.find((item) => item.result === result);
const exclusion = (sweep) => sweep.reasons.find((item) => item.kind === 'exclusive');
const histogram = (sweep) => sweep.nodes.histogram;
const request = (state) => state.running[0]?.request;
const nodeOf = (kind) => (graph) => graph.nodes.find((item) => item.kind === kind);
const changeOf =
  (subject, kind) =>
  ({changes}) =>
    changes.find((item) => item.subject === subject && (kind === undefined || item.kind === kind));
const attributeOf = (name) => ({changes}) => {
  const attributes = changes.flatMap((change) => change.attributes);
  return attributes.find((attribute) => attribute.name === name);
};
const propertyWhere =
  (result, kind) =>
  ({properties}) =>
    properties.find((item) => item.result === result && (!kind || item.kind === kind));
const effect = ({effects}) => effects && effects.tasks[0].effects[0];
const edgeOf = (kind) => (graph) => graph.edges.find((item) => item.kind === kind);
const finding = ({files}) => files[0].diagnostics[0];
const summary = ({files}) => files[0].summary;
const group = ({groups}) => groups[0];
const task = of(group, ({tasks}) => tasks[0]);
const withMinimum = of(group, ({tasks}) => tasks.find((item) => item.minimum_performance !== null));
const noMinimum = of(group, ({tasks}) => tasks.find((item) => item.minimum_performance === null));
const exclusivity = of(group, (item) => item.exclusivity[0]);

// What is said.
const faulty = {kind: 'faulty', behavior: 'GPS', message: 'GPS is faulty'};
const priority = {kind: 'priority', task: 'HOVER', priority: 2, message: 'HOVER has priority 2'};
const performer = {task: 'LOCALIZE', behavior: 'GPS', suitability: 90};
const stopped = {task: 'HOVER', cause: 'released'};
const activation = {
  op: 'activate',
  behavior: 'GPS',
  tasks: ['LOCALIZE'],
  cause: 'required',
  priority: null,
  success: true,
};
const noAnswer = {
  task: 'HOVER',
  chosen: null,
  limit_reached: true,
  alternative: null,
  loses: null,
  conflict: [],
  message: 'it would have taken too long to find out',
};

const lies = {
  events: [
    ['a reactive delay of 0', lineWith('schema'), {reactive_delay: 0}],
    ['timeouts that are mentioned but on', lineWith('schema'), {timeouts: true}],
    ['a digest in capitals', lineWith('schema'), {digest: 'F'.repeat(32)}],
    ['an error in line 0', lineWith('error'), {line: 0}],
    ['totals of no event', kindOfTotals, {events: 0}],
    ['totals of repairs', kindOfTotals, {verb: 'repair'}],

    ['an index of 0', lineWith('index'), {index: 0}],
    ['a start with priority 0', verb('start'), {priority: 0}],
    ['a priority that is too large', verb('start'), {priority: 2 ** 31}],
    ['a stop with a cause', verb('stop'), {cause: 'interrupted'}],
    ['a stop with parameters', verb('stop'), {parameters: {}}],
    ['a finish with a situation', verb('finish'), {situation: {}}],
    ['a fault with a priority', verb('fault'), {priority: 1}],
    ['a wait with a name', verb('wait'), {name: 'HOVER'}],
    ['a timeout with success', origin('timeout'), {cause: 'goal_achieved'}],
    ['a lost behavior that timed out', origin('fault'), {cause: 'time_out'}],
    ['a reactive start with priority 1', origin('reactive'), {priority: 1}],
    ['a start by a timeout', origin('reactive'), {origin: 'timeout'}],
    ['a start by a fault', origin('reactive'), {origin: 'fault'}],
    ['a reactive finish', origin('timeout'), {origin: 'reactive'}],

    ['an accepted event without an objective', outcome('accepted'), {objective: null}],
    ['an accepted event without a search', outcome('accepted'), {search: null}],
    ['an accepted event that is infeasible', search('accepted'), {status: 'infeasible'}],
    ['a proven answer with a bound', search('accepted'), {bound: {satisfied: 1, suitability: 1}}],
    ['a feasible answer without a bound', search('accepted'), {status: 'feasible'}],
    ['an accepted event with a conflict', outcome('accepted'), {conflict: [faulty]}],
    [
      'an accepted wait',
      of(outcome('accepted'), verb('stop')),
      (line) => delete line.name && delete line.priority && Object.assign(line, {verb: 'wait'}),
    ],
    ['a rejected event that stopped a task', outcome('rejected'), {stopped_tasks: [stopped]}],
    ['a task that was stopped and undone', stoppedTask('released'), {cause: 'undone'}],
    ['a released task with reasons', stoppedTask('released'), {conflict: []}],
    ['a released task that tells why', stoppedTask('released'), {message: 'it stops'}],
    ['a stop on request that tells why', stoppedTask('requested'), {message: 'it stops'}],
    ['a rejected event that is optimal', search('rejected'), {status: 'optimal'}],
    ['a rejected event that is explained', outcome('rejected'), {why: [noAnswer]}],
    ['a rejection after a search by priority', searched, {conflict: [priority]}],
    ['a rejection without search by a fault', notSearched, {conflict: [faulty]}],
    ['a rejection without search for two reasons', notSearched, {conflict: [priority, priority]}],
    ['a rejection without search or reason', notSearched, {conflict: []}],
    ['an unchanged event with a change', outcome('unchanged'), {changes: [activation]}],
    ['an unchanged event with a conflict', outcome('unchanged'), {conflict: [faulty]}],

    ['a change for no task', change('activate'), {tasks: []}],
    ['a change for a task twice', change('activate'), {tasks: ['HOVER', 'HOVER']}],
    ['an activation that replaces', change('activate'), {cause: 'replaced'}],
    ['a requested activation without priority', change('activate', 'requested'), {priority: null}],
    ['a requested activation with priority 0', change('activate', 'requested'), {priority: 0}],
    ['a reactive activation with priority 2', change('activate', 'reactive'), {priority: 2}],
    ['a required activation with a priority', change('activate', 'required'), {priority: 1}],
    ['a taking back with a priority', change('activate', 'undone'), {priority: 1}],
    ['a deactivation that failed', change('deactivate'), {success: false}],
    ['a deactivation that is required', change('deactivate', 'released'), {cause: 'required'}],
    ['a displaced task without a request', change('deactivate', 'displaced'), {priority: null}],

    ['a suitability over 1', objective, {suitability: 1.5}],
    ['an idle share over 1', objective, {idle: 1.5}],

    ['a task that excludes nothing', reason('exclusive'), {tasks: ['A']}],
    ['a task that excludes itself', reason('exclusive'), {tasks: ['A', 'A']}],
    ['three tasks that exclude one another', reason('exclusive'), {tasks: ['A', 'B', 'C']}],
    ['an unavailable behavior of a task', reason('unavailable'), {task: 'HOVER'}],
    ['a requirement with a priority', reason('requires'), {priority: 1}],
    ['a protected behavior', reason('protected'), {behavior: 'GPS'}],
    ['a requirement that does best', reason('requires'), {best: [performer]}],
    ['a best performance of nothing', reason('performance'), {best: []}],
    [
      'a best performance beyond 100 %',
      reason('performance'),
      {best: [{...performer, suitability: 101}]},
    ],
    [
      'a rejection because a behavior finished',
      (line) => line.conflict?.find((item) => item.kind === 'faulty'),
      {kind: 'finished'},
    ],

    ['an answer about a task and a behavior', whyTask, {behavior: 'GPS', active: true}],
    ['a task that is active', whyTask, {active: true}],
    ['an alternative that does not lose', whyAlternative, {loses: null}],
    ['a loss without an alternative', whyAlternative, {alternative: null}],
    ['an alternative that was not found', whyAlternative, {limit_reached: true}],
    ['an alternative that cannot be', whyAlternative, {conflict: [faulty]}],
    ['an alternative that a priority rules out', whyNone, {conflict: [priority]}],
    ['reasons that were not found', whyNone, {limit_reached: true}],
    ['a number of requests in words', loss('requests'), {chosen: 'two'}],
    ['a suitability that is rounded', loss('suitability'), {chosen: 0.9}],
    ['an exact suitability over 1', loss('suitability'), {chosen: '1.5'}],
    ['an idle share that is rounded', loss('idle'), {chosen: '0.5'}],
  ],

  coverage: [
    ['no catalog', whole, {catalogs: []}],
    ['more than all', whole, {percent: 101}],
    ['a goal in line 0', goal('task_ran'), {lines: [0]}],
    ['a task of a behavior', goal('behavior_active'), {task: 'A'}],
    ['a timeout of both', goal('timeout_fired'), {task: 'A', behavior: 'B'}],
    ['an unreachable goal that is reachable', goal('task_ran'), {unreachable: false}],
    ['an unreachable goal without a reason', goal('task_ran'), {unreachable: true}],
    ['a reason of a goal that is reachable', goal('task_ran'), {reason: 'it never runs'}],
    ['a proof that is incomplete or not', ({catalogs}) => catalogs[0], {incomplete: false}],
  ],

  mutants: [
    ['no mission', whole, {missions: []}],
    ['more than all', whole, {percent: 101}],
    ['a mutant in line 0', mutant('noticed'), {lines: [0]}],
    ['a survivor that was noticed', mutant('noticed'), {result: 'survived'}],
    ['a noticed mutant that nobody noticed', mutant('survived'), {result: 'noticed'}],
    ['an equivalent mutant with a script', mutant('equivalent'), {script: 'events: []'}],
    ['an undecided mutant without a reason', mutant('equivalent'), {result: 'undecided'}],
    ['a reason for doubt about an equivalent one', mutant('equivalent'), {reason: 'limit'}],
    ['a mission in line 0', mutant('noticed'), ({noticed_by}) => (noticed_by.line = 0)],
  ],

  solve: [
    ['no run', whole, {runs: []}],
    ['a success in line 0', success, {line: 0}],
    ['a failure in line 0', failure, {line: 0}],
    [
      'totals of the runs only',
      (report) => 'totals' in report && report,
      (report) => delete report.totals && delete report.process,
    ],
  ],

  sweep: [
    ['kinds of events in another order', whole, ({events}) => events.reverse()],
    ['a kind of event too few', whole, ({events}) => events.pop()],
    ['a kind of event too many', whole, ({events}) => events.push(events[0])],
    ['a task that never ran twice', whole, {never_ran: ['A', 'A']}],
    ['a share over 1', (sweep) => sweep.options, {faults: 1.5}],
    ['a part from sequence 0', whole, {first_sequence: 0}],
    ['a reason without rejections', (sweep) => sweep.reasons[0], {count: 0}],
    ['a task that excludes nothing', exclusion, {tasks: ['A']}],
    ['three tasks that exclude one another', exclusion, {tasks: ['A', 'B', 'C']}],
    ['a number that did not occur', histogram, (numbers) => numbers.push([9999, 0])],
    ['a histogram of single numbers', histogram, (numbers) => numbers.push([9999])],
    ['a histogram of triples', histogram, (numbers) => numbers.push([9999, 1, 1])],
  ],

  tune: [
    ['no mission', whole, {missions: []}],
    ['a number in line 0', ({numbers}) => numbers[0], {line: 0}],
    ['a way of no moves', ({numbers}) => numbers.find((item) => item.below?.moves)?.below, {moves: []}],
    ['a property in line 0', ({numbers}) => numbers.find((item) => item.below?.breaks)?.below.breaks, {line: 0}],
    ['a difference at event 0', (tuning) => tuning.numbers.find((item) => item.below)?.below, {event: 0}],
    ['a failure in line 0', ({expectations}) => expectations.failures[0], {line: 0}],
    ['a search that is incomplete or not', ({numbers}) => numbers[0], {incomplete: false}],
  ],

  verify: [
    ['an undecided property with a script', propertyWhere('undecided'), {length: 1, script: ''}],
    ['a violated property without a script', propertyWhere('violated', 'never'), {script: null}],
    ['a witness without a length', propertyWhere('proved', 'reachable'), {length: null}],
    ['a proved property with a script', propertyWhere('proved', 'can_start'), {length: 1, script: ''}],
    ['a refused start without reasons', propertyWhere('violated', 'can_start'), {conflict: []}],
    ['a property in line 0', ({properties}) => properties[0], {line: 0}],
    ['an exploration without states', group, {states: 0}],
    ['one group explored together', group, {groups: [0]}],
    ['a pair of three tasks', of(group, (item) => item.together[0]), (pair) => pair.push('A')],
    ['effects of no fault', ({effects}) => effects, {order: 0}],
    ['an effect of another kind', effect, {effect: 'worse'}],
    ['a suitability in percent', effect, {suitability: 80}],
    ['a fault twice', effect, {faults: ['A', 'A']}],
  ],

  state: [
    ['a reactive delay of 0', whole, {reactive_delay_us: 0}],
    ['timeouts that are mentioned but on', whole, {timeouts: true}],
    ['a time in seconds', whole, {time_us: 0.5}],
    ['a behavior that is faulty twice', whole, {faulty: ['GPS', 'GPS']}],
    ['a request of event 0', request, {event: 0}],
    ['a priority that is too large', request, {priority: 2 ** 31}],
  ],

  lint: [
    ['a finding in column 0', finding, {column: 0}],
    ['a search space of nothing', summary, {search_space: '0'}],
    ['a group without tasks', of(summary, group), {tasks: []}],
    ['a task twice in a group', of(summary, group), {tasks: ['A', 'A']}],
  ],

  graph: [
    ['a task without a name', nodeOf('task'), {name: null}],
    ['a task of a package', nodeOf('task'), {package: 'a'}],
    ['a behavior that is not defined', nodeOf('behavior'), {defined: false}],
    ['a hub with a name', nodeOf('hub'), {name: 'A'}],
    ['a node of another kind', nodeOf('task'), {kind: 'behavior'}],
    ['a suitability over 100', edgeOf('performed_by'), {suitability: 100.5}],
    ['a performed task with a minimum', edgeOf('performed_by'), {minimum_performance: 80}],
    ['a minimum over 100', edgeOf('requirement'), {minimum_performance: 100.5}],
    ['an exclusion with a minimum', edgeOf('exclusion'), {minimum_performance: null}],
    ['an edge from an edge', edgeOf('exclusion'), {from: 'edge:1'}],
    ['a priority of a behavior', nodeOf('behavior'), {priority: 1}],
    ['an event before the first', ({state}) => state, {index: -1}],
  ],

  diff: [
    ['a task with a behavior', changeOf('task'), {behavior: 'A'}],
    ['a behavior that is a task', changeOf('behavior'), {task: 'A'}],
    ['a changed exclusion', changeOf('exclusion'), {kind: 'changed'}],
    ['a change of nothing', changeOf('task', 'changed'), {attributes: []}],
    ['a time for a truth', attributeOf('timeout'), {after: true}],
    ['a number for a truth', attributeOf('start_on_request'), {after: 1}],
    ['an unknown goal', attributeOf('execution_goal'), {after: 'odd'}],
  ],

  'what-if': [
    ['an accepted move with a conflict', moveWith('rejected'), {outcome: 'accepted'}],
    ['an accepted fault', moveOf('fault'), {outcome: 'accepted'}],
    ['a task that stops twice', moveWith('accepted'), {stopped: ['A', 'A']}],
    ['a task that starts with nothing', moveWith('accepted'), {started: {A: null}}],
    ['a task that was due at the beginning', moveWith('accepted'), {queued: {A: 0}}],
  ],

  'catalog-dump': [
    ['a group without tasks', group, {tasks: []}],
    ['a timeout of 0', task, {timeout: 0}],
    ['a suitability over 100', of(task, ({behaviors}) => behaviors[0]), {suitability: 100.5}],
    ['a minimum over 100', withMinimum, {minimum_performance: 100.5}],
    ['a minimum without a line', withMinimum, {line: null}],
    ['a minimum in line 0', withMinimum, {line: 0}],
    ['the line of no minimum', noMinimum, {line: 7}],
    ['a task that excludes nothing', exclusivity, {tasks: ['A']}],
    ['a task that excludes itself', exclusivity, {tasks: ['A', 'A']}],
  ],
};

module.exports = {lies};
