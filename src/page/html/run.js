// What a run was: its states, the spans of activity in it, the rows they need, and which behavior
// followed which. Nothing here touches the page.

const newState = { index: 0, time: 0, running: {}, requests: {}, suspended: {}, queue: {}, faulty: [], failed: [] };

class Run {
  /** `data`: a run of the report; `begin`: the situation before it, and the state, if there is one. Events
   * can be added later; `leftOut`: how many the page does not have. Their numbers count from 1; the index of an event is that of the report, which
   * may count events that are not here. `property`: {result, statement} of what the run is a counterexample
   * or witness of. */
  constructor(data, catalog, begin, leftOut = 0, property = null) {
    this.data = data;
    this.leftOut = leftOut;
    this.property = property;
    this.continuation = null; // in the simulator, if that is possible
    this.catalog = catalog;
    this.begin = { ...newState, time: Math.min(0, data.events[0]?.time ?? 0), ...begin };
    this.events = [];
    this.failures = new Map(); // of each number: the failed expectations
    this.problems = []; // numbers of events that were rejected or after which an expectation failed
    this.mostAtOnce = 1; // events at one moment
    this.story = new Story(this);
    this.setUpSituations();
    this.setUpWaiting();
    this.setUpSpans();
    this.links = [];
    this.linksOf = [[]];
    this.setUpShown();
    for (const failure of data.expectations.failures) this.noteFailure(failure);
    this.append(data.events);
  }

  append(events) {
    for (const event of events) {
      this.events.push(event);
      const number = this.size;
      this.readSituations(number);
      this.readWaiting(number);
      this.readSpans(number);
      this.readLinks(number);
      this.readShown(event);
      this.countSimultaneous(number);
      if (this.isRejected(number) || this.isFailed(number)) this.problems.push(number);
    }
  }

  /** An expectation failed after the last event, or after one that is added later. */
  noteFailure(failure) {
    const number = this.numberOf(failure.index);
    this.failures.set(number, [...(this.failures.get(number) ?? []), failure]);
    if (number >= 1 && number <= this.size && this.problems.at(-1) !== number) this.problems.push(number);
  }

  /** Whether the mission failed: an expectation did, or the run ended early, or it violates a property. */
  get hasFailed() {
    return this.data.expectations.failed > 0 || this.data.error !== undefined || this.isViolation;
  }

  get isViolation() {
    return this.property?.result === 'violated';
  }

  isRejected(number) {
    return this.event(number).outcome === 'rejected';
  }

  /** Whether an expectation about the state after an event failed. */
  isFailed(number) {
    return this.failures.has(number);
  }

  /** How many events of each kind there are, in words: by their outcomes; those that ask for nothing by what
   * they are. */
  counts() {
    const kinds = [['accepted', 'accepted'], ['rejected', 'rejected'], ['unchanged', 'without effect'],
                   ['situation', 'situation change'], ['fault', 'fault'], ['repair', 'repair'], ['wait', 'wait']];
    const counts = new Map(kinds.map(([kind]) => [kind, 0]));
    for (const event of this.events) {
      const kind = isAsked(event) ? event.outcome : event.verb;
      counts.set(kind, counts.get(kind) + 1);
    }
    return kinds.filter(([kind], place) => place < 2 || counts.get(kind) > 0).map(([kind, name], place) =>
      (place < 2 || kind === 'unchanged' ? `${counts.get(kind)} ${name}` : quantity(counts.get(kind), name)));
  }

  /** The event to look at first: the first failure, or what the script leads to, or the first event. */
  get firstOfInterest() {
    if (this.failures.size > 0) return Math.max(1, Math.min(...this.failures.keys()));
    return this.data.error === undefined && this.property === null ? 1 : Math.max(1, this.size);
  }

  get size() {
    return this.events.length;
  }

  event(number) {
    return this.events[number - 1];
  }

  /** The number of the event with an index. */
  numberOf(index) {
    return index - this.begin.index;
  }

  /** The index of an event, by which people know it. */
  indexOf(number) {
    return this.begin.index + number;
  }

  /** What is known after an event; number 0 is before all. */
  stateAt(number) {
    return number === 0 ? this.begin : this.event(number);
  }

  timeAt(number) {
    return this.stateAt(number).time;
  }

  /** Task -> behavior after an event. */
  running(number) {
    return this.stateAt(number).running;
  }

  requests(number) {
    return this.stateAt(number).requests;
  }

  /** The values of the situation variables, and the behaviors that a script made unavailable, that do
   * not fit, and that are faulty, after each event; and when that was so. */
  setUpSituations() {
    const { variables, behaviors } = this.catalog;
    this.outages = []; // {behavior, kind, from, to}: numbers of events, `to` null at the end
    this.openOutages = { unavailable: new Map(), 'does not fit': new Map(), faulty: new Map(), 'not tried again': new Map() };
    this.conditional = [...behaviors.keys()].filter((name) => Object.keys(behaviors.get(name).situation).length > 0);
    this.present = new Map([...variables].map(([name, known]) => [name, known[0]]));
    this.values = []; // of each event: variable -> value
    this.valueSpans = []; // {variable, value, from, to}
    this.lastValues = new Map(); // of each variable: its span
    this.unavailable = [];
    this.misfits = [];
    this.faulty = [];
    this.untried = []; // have failed, and are not tried again at any event
    this.readSituation(this.begin.situation, 0);
    for (const behavior of this.begin.faulty) this.setOutage('faulty', behavior, true, 0);
    this.readFailures(0);
    this.noteOutages();
  }

  setOutage(kind, behavior, isOut, number) {
    const open = this.openOutages[kind];
    const outage = open.get(behavior);
    if (isOut && outage === undefined) {
      const begun = { behavior, kind, from: number, to: null };
      open.set(behavior, begun);
      this.outages.push(begun);
    } else if (!isOut && outage !== undefined) {
      outage.to = number;
      open.delete(behavior);
    }
  }

  readSituation(situation, number) {
    for (const [name, value] of Object.entries(situation)) {
      if (this.catalog.variables.has(name)) {
        this.present.set(name, value);
      } else {
        this.setOutage('unavailable', name, !value, number);
      }
    }
    for (const [variable, value] of this.present) {
      const span = this.lastValues.get(variable);
      if (span?.value === value) continue;
      if (span !== undefined) span.to = number;
      this.lastValues.set(variable, { variable, value, from: number, to: null });
      this.valueSpans.push(this.lastValues.get(variable));
    }
    for (const name of this.conditional) {
      this.setOutage('does not fit', name, this.catalog.findMisfit(name, this.present) !== undefined, number);
    }
    this.values.push(new Map(this.present));
  }

  readFailures(number) {
    const failed = new Set(this.stateAt(number).failed ?? []);
    for (const behavior of [...this.openOutages['not tried again'].keys(), ...failed]) {
      this.setOutage('not tried again', behavior, failed.has(behavior), number);
    }
  }

  noteOutages() {
    const { unavailable, faulty, 'does not fit': misfits, 'not tried again': untried } = this.openOutages;
    this.untried.push(this.catalog.sortBehaviors(untried.keys()));
    this.unavailable.push(this.catalog.sortBehaviors(unavailable.keys()));
    this.misfits.push(this.catalog.sortBehaviors(misfits.keys()));
    this.faulty.push(this.catalog.sortBehaviors(faulty.keys()));
  }

  readSituations(number) {
    const event = this.event(number);
    if (event.verb === 'situation') {
      this.readSituation(event.situation ?? {}, number);
    } else {
      this.values.push(this.values.at(-1));
    }
    if (event.verb === 'fault') this.setOutage('faulty', event.name, true, number);
    if (event.verb === 'repair') this.setOutage('faulty', event.name, false, number);
    this.readFailures(number);
    this.noteOutages();
  }

  /** Which reactive tasks wait for a change of their group after each event, and which requests are suspended. */
  setUpWaiting() {
    this.waitings = []; // {task, kind, from, to}: from the rejected start on, or from the event that suspended it
    this.waiting = []; // of each event: tasks
    this.openWaitings = new Map();
    this.readWaiting(0);
  }

  readWaiting(number) {
    const { queue } = this.stateAt(number);
    const suspended = this.suspended(number);
    const begin = (task, kind) => {
      if (this.openWaitings.has(task)) return;
      this.openWaitings.set(task, { task, kind, from: number, to: null });
      this.waitings.push(this.openWaitings.get(task));
    };
    for (const [task, due] of Object.entries(queue)) if (due === null) begin(task, 'waiting');
    for (const task of Object.keys(suspended)) begin(task, 'suspended');
    for (const [task, wait] of this.openWaitings) {
      if (get(queue, task) !== undefined || get(suspended, task) !== undefined) continue;
      wait.to = number;
      this.openWaitings.delete(task);
    }
    const reactive = [...this.openWaitings.keys()].filter((task) => get(suspended, task) === undefined);
    this.waiting.push(this.catalog.sortTasks(reactive));
  }

  /** Task -> priority of the requests that are suspended after an event. */
  suspended(number) {
    return this.stateAt(number).suspended ?? {};
  }

  /** Whether the reactive start of a task was rejected by an event, so that it waits from then on. */
  beginsToWait(number) {
    const event = this.event(number);
    return event.origin === 'reactive' && event.outcome === 'rejected' && this.waiting[number].includes(event.name);
  }

  /** When each task was performed by which behavior, and why: a span for each stretch of both. */
  setUpSpans() {
    this.spans = [];
    this.openSpans = new Map();
    this.reactions = new Set(); // running tasks that started by themselves, and were not asked for since
    this.readSpans(0);
  }

  readSpans(number) {
    const { running, requests, changes = [] } = this.stateAt(number);
    if (number > 0) this.readReactions(this.event(number));
    const restarted = (task) => changes.some((change) =>
      change.cause === 'restarted' && change.op === 'activate' && change.tasks.includes(task));
    for (const [task, span] of this.openSpans) {
      if (span.behavior === get(running, task) && span.priority === get(requests, task) && !restarted(task)) {
        this.noteRequirers(span, number);
        this.noteFaults(span, number);
        continue;
      }
      span.to = number;
      this.openSpans.delete(task);
    }
    for (const [task, behavior] of Object.entries(running)) {
      if (this.openSpans.has(task)) continue;
      const priority = get(requests, task);
      const span = { task, behavior, priority, cause: this.causeOf(task, priority), from: number, to: null };
      span.requirers = []; // {from, names}: each from an event on
      span.faults = []; // {from, to}: while its behavior was faulty; `to` null until the span ends
      this.noteRequirers(span, number);
      this.noteFaults(span, number);
      span.isRestart = restarted(task);
      this.openSpans.set(task, span);
      this.spans.push(span);
    }
  }

  readReactions(event) {
    if (event.outcome === 'accepted' && event.verb === 'start') {
      if (event.origin === 'reactive') this.reactions.add(event.name);
      else this.reactions.delete(event.name);
    }
    for (const task of this.reactions) if (get(event.running, task) === undefined) this.reactions.delete(task);
  }

  /** Why a task runs, as in the changes: by its request. */
  causeOf(task, priority) {
    if (priority === undefined) return 'required';
    return priority === 0 || this.reactions.has(task) ? 'reactive' : 'requested';
  }

  /** The span of a task that runs after an event. */
  spanAt(number, task) {
    return this.spans.findLast((span) => span.task === task && span.from <= number && (span.to === null || span.to > number));
  }

  noteRequirers(span, number) {
    const names = this.requirers(number, span.task);
    const last = span.requirers.at(-1);
    if (last === undefined || last.names.join('\0') !== names.join('\0')) span.requirers.push({ from: number, names });
  }

  /** An active behavior that becomes faulty goes on. */
  noteFaults(span, number) {
    const isFaulty = this.openOutages.faulty.has(span.behavior);
    const last = span.faults.at(-1);
    if (isFaulty && last?.to !== null) span.faults.push({ from: number, to: null });
    if (!isFaulty && last?.to === null) last.to = number;
  }

  /** Running tasks whose behaviors require a task, after an event. */
  requirers(number, task) {
    return Object.entries(this.running(number))
      .filter(([, behavior]) => this.catalog.requires(behavior, task))
      .map(([requirer]) => requirer);
  }

  /** Which behavior follows which at an event: in the same task, or in one that excludes it. */
  readLinks(number) {
    const before = this.running(number - 1);
    const after = this.running(number);
    const links = [];
    const begun = Object.keys(after).filter((task) => get(before, task) === undefined);
    for (const [task, behavior] of Object.entries(before)) {
      const next = get(after, task);
      const from = { task, behavior };
      if (next !== undefined && next !== behavior) {
        links.push({ number, kind: 'replaced', from, to: { task, behavior: next } });
      }
      if (next !== undefined) continue;
      for (const other of begun.filter((name) => this.catalog.excludes(task, name))) {
        links.push({ number, kind: 'way', from, to: { task: other, behavior: after[other] } });
      }
    }
    this.linksOf.push(links);
    this.links.push(...links);
  }

  /** The tasks and behaviors that were active or asked for. */
  setUpShown() {
    this.shown = new Map(); // task -> behaviors
    this.shownCount = 0;
    for (const [task, behavior] of Object.entries(this.begin.running)) this.noteShown(task, behavior);
    for (const task of Object.keys(this.begin.queue)) if (this.begin.queue[task] === null) this.noteShown(task);
    for (const task of Object.keys(this.suspended(0))) this.noteShown(task);
  }

  noteShown(task, behavior) {
    if (!this.catalog.taskPlace.has(task)) return;
    let behaviors = this.shown.get(task);
    if (behaviors === undefined) {
      behaviors = new Set();
      this.shown.set(task, behaviors);
      ++this.shownCount;
    }
    if (behavior === undefined || behaviors.has(behavior)) return;
    behaviors.add(behavior);
    ++this.shownCount;
  }

  readShown(event) {
    for (const [task, behavior] of Object.entries(event.running)) this.noteShown(task, behavior);
    for (const [task, due] of Object.entries(event.queue)) if (due === null) this.noteShown(task);
    if (event.verb === 'start' || event.verb === 'stop') this.noteShown(event.name);
    for (const change of event.changes) {
      for (const task of change.tasks) this.noteShown(task, change.behavior);
    }
  }

  /** The tasks with their behaviors that have rows: those that were active or asked for, or all. */
  rows(wantsAll) {
    const tasks = wantsAll ? this.catalog.performers : this.shown;
    return this.catalog.sortTasks(tasks.keys())
      .map((task) => ({ task, behaviors: this.catalog.sortBehaviors(tasks.get(task)) }));
  }

  countSimultaneous(number) {
    this.atOnce = number > 1 && this.timeAt(number - 1) === this.timeAt(number) ? this.atOnce + 1 : 1;
    this.mostAtOnce = Math.max(this.mostAtOnce, this.atOnce);
  }
}

function readRuns(data) {
  const catalogs = data.catalogs.map((catalog) => new Catalog(catalog));
  return data.report.runs.map((run, place) => {
    const { catalog, situation, state, mission, left_out: leftOut } = data.runs[place];
    const property = data.properties?.find((one) => one.run === place);
    const shown = new Run(run, catalogs[catalog], { situation, ...state }, leftOut, property);
    shown.continuation = continuationOf(run, data.catalogs[catalog].text, mission, data.simulator);
    return shown;
  });
}
