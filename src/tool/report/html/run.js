// What a run was: its states, the spans of activity in it, the rows they need, and which behavior
// followed which. Nothing here touches the page.

/** Causes of spans, as in the changes: by the request of the task. */
function causeOf(priority) {
  if (priority === undefined) return 'required';
  return priority === 0 ? 'reactive' : 'requested';
}

class Run {
  /** `data`: a run of the report; `extra`: the situation before it. */
  constructor(data, catalog, extra) {
    this.data = data;
    this.catalog = catalog;
    this.events = data.events;
    this.situation = extra.situation;
    this.leftOut = extra.left_out; // events that the page does not have
    this.failures = new Map(); // of each index: the messages
    for (const failure of data.expectations.failures) {
      this.failures.set(failure.index, [...(this.failures.get(failure.index) ?? []), failure]);
    }
    this.readSituations();
    this.readWaiting();
    this.readSpans();
    this.readLinks();
    this.story = new Story(this);
  }

  /** Whether the mission failed: an expectation did, or the run ended early. */
  get hasFailed() {
    return this.data.expectations.failed > 0 || this.data.error !== undefined;
  }

  isRejected(number) {
    return this.event(number).outcome === 'rejected';
  }

  /** Whether an expectation about the state after an event failed. */
  isFailed(number) {
    return this.failures.has(number);
  }

  /** The events that were rejected or after which an expectation failed, in order. */
  get problems() {
    this.problemList ??= this.events.map((_, place) => place + 1)
      .filter((number) => this.isRejected(number) || this.isFailed(number));
    return this.problemList;
  }

  /** The event to look at first: the first failure, or the first event. */
  get firstOfInterest() {
    const failed = this.data.expectations.failures.map((failure) => failure.index);
    if (failed.length > 0) return Math.max(1, Math.min(...failed));
    return this.data.error === undefined ? 1 : Math.max(1, this.size);
  }

  get size() {
    return this.events.length;
  }

  event(number) {
    return this.events[number - 1];
  }

  /** Task -> behavior after an event; number 0 is the state before all. */
  running(number) {
    return number === 0 ? {} : this.event(number).running;
  }

  requests(number) {
    return number === 0 ? {} : this.event(number).requests;
  }

  /** The values of the situation variables, and the behaviors that a script made unavailable, that do
   * not fit, and that are faulty, after each event; and when that was so. */
  readSituations() {
    this.outages = []; // {behavior, kind, from, to}: numbers of events, `to` null at the end
    const open = { unavailable: new Map(), 'does not fit': new Map(), faulty: new Map() };
    const set = (kind, behavior, isOut, number) => {
      const outage = open[kind].get(behavior);
      if (isOut && outage === undefined) {
        const begun = { behavior, kind, from: number, to: null };
        open[kind].set(behavior, begun);
        this.outages.push(begun);
      } else if (!isOut && outage !== undefined) {
        outage.to = number;
        open[kind].delete(behavior);
      }
    };
    const { variables, behaviors } = this.catalog;
    const conditional = [...behaviors.keys()].filter((name) => Object.keys(behaviors.get(name).situation).length > 0);
    const values = new Map([...variables].map(([name, known]) => [name, known[0]]));
    this.values = []; // of each event: variable -> value
    this.valueSpans = []; // {variable, value, from, to}
    const last = new Map(); // of each variable: its span
    const readSituation = (situation, number) => {
      for (const [name, value] of Object.entries(situation)) {
        if (variables.has(name)) {
          values.set(name, value);
        } else {
          set('unavailable', name, !value, number);
        }
      }
      for (const [variable, value] of values) {
        const span = last.get(variable);
        if (span?.value === value) continue;
        if (span !== undefined) span.to = number;
        last.set(variable, { variable, value, from: number, to: null });
        this.valueSpans.push(last.get(variable));
      }
      for (const name of conditional) {
        set('does not fit', name, this.catalog.findMisfit(name, values) !== undefined, number);
      }
      this.values.push(new Map(values));
    };
    readSituation(this.situation, 0);
    this.unavailable = [];
    this.misfits = [];
    this.faulty = [];
    for (let number = 0; number <= this.size; ++number) {
      const event = this.event(number) ?? {};
      if (event.verb === 'situation') {
        readSituation(event.situation ?? {}, number);
      } else if (number > 0) {
        this.values.push(this.values.at(-1));
      }
      if (event.verb === 'fault') set('faulty', event.name, true, number);
      if (event.verb === 'repair') set('faulty', event.name, false, number);
      this.unavailable.push(this.catalog.sortBehaviors(open.unavailable.keys()));
      this.misfits.push(this.catalog.sortBehaviors(open['does not fit'].keys()));
      this.faulty.push(this.catalog.sortBehaviors(open.faulty.keys()));
    }
  }

  /** Which reactive tasks wait for a change of their group after each event; when, and why. */
  readWaiting() {
    this.waitings = []; // {task, from, to}: from the rejected start on
    this.waiting = [[]];
    const open = new Map();
    for (let number = 1; number <= this.size; ++number) {
      const event = this.event(number);
      for (const [task, due] of Object.entries(event.queue)) {
        if (due !== null || open.has(task)) continue;
        open.set(task, { task, from: number, to: null });
        this.waitings.push(open.get(task));
      }
      for (const [task, wait] of open) {
        if (get(event.queue, task) !== undefined) continue;
        wait.to = number;
        open.delete(task);
      }
      this.waiting.push(this.catalog.sortTasks(open.keys()));
    }
  }

  /** Whether the reactive start of a task was rejected by an event, so that it waits from then on. */
  beginsToWait(number) {
    const event = this.event(number);
    return event.origin === 'reactive' && event.outcome === 'rejected' && this.waiting[number].includes(event.name);
  }

  /** When each task was performed by which behavior, and why: a span for each stretch of both. */
  readSpans() {
    this.spans = [];
    const open = new Map();
    const restarted = (event, task) =>
      event.changes.some((change) => change.cause === 'restarted' && change.op === 'activate' &&
                                     change.tasks.includes(task));
    for (let number = 1; number <= this.size; ++number) {
      const event = this.event(number);
      for (const [task, span] of open) {
        const behavior = get(event.running, task);
        const priority = get(event.requests, task);
        if (span.behavior === behavior && span.priority === priority && !restarted(event, task)) {
          this.noteRequirers(span, number);
          continue;
        }
        span.to = number;
        open.delete(task);
      }
      for (const [task, behavior] of Object.entries(event.running)) {
        if (open.has(task)) continue;
        const priority = get(event.requests, task);
        const span = { task, behavior, priority, cause: causeOf(priority), from: number, to: null };
        span.requirers = []; // {from, names}: each from an event on
        this.noteRequirers(span, number);
        span.isRestart = restarted(event, task);
        open.set(task, span);
        this.spans.push(span);
      }
    }
  }

  noteRequirers(span, number) {
    const names = this.requirers(number, span.task);
    const last = span.requirers.at(-1);
    if (last === undefined || last.names.join('\0') !== names.join('\0')) span.requirers.push({ from: number, names });
  }

  /** Running tasks whose behaviors require a task, after an event. */
  requirers(number, task) {
    return Object.entries(this.running(number))
      .filter(([, behavior]) => this.catalog.requires(behavior, task))
      .map(([requirer]) => requirer);
  }

  /** Which behavior follows which at an event: in the same task, or in one that excludes it. */
  readLinks() {
    this.links = [];
    this.linksOf = [[]];
    for (let number = 1; number <= this.size; ++number) {
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
  }

  /** The tasks with their behaviors that have rows: those that were active or asked for, or all. */
  rows(wantsAll) {
    const tasks = new Map();
    const add = (task, behavior) => {
      if (!this.catalog.taskPlace.has(task)) return;
      if (!tasks.has(task)) tasks.set(task, new Set());
      if (behavior !== undefined) tasks.get(task).add(behavior);
    };
    for (const span of this.spans) add(span.task, span.behavior);
    for (const wait of this.waitings) add(wait.task);
    for (const event of this.events) {
      if (event.verb === 'start' || event.verb === 'stop') add(event.name);
      for (const change of event.changes) {
        for (const task of change.tasks) add(task, change.behavior);
      }
    }
    if (wantsAll) {
      for (const [task, behaviors] of this.catalog.performers) {
        add(task);
        for (const behavior of behaviors) add(task, behavior);
      }
    }
    return this.catalog.sortTasks(tasks.keys())
      .map((task) => ({ task, behaviors: this.catalog.sortBehaviors(tasks.get(task)) }));
  }

  /** How many events happen at one moment, at most. */
  get mostAtOnce() {
    if (this.most !== undefined) return this.most;
    let most = 1;
    let begin = 1;
    for (let number = 1; number <= this.size; ++number) {
      if (this.event(number).time !== this.event(begin).time) begin = number;
      most = Math.max(most, number - begin + 1);
    }
    this.most = most;
    return most;
  }
}

function readRuns(data) {
  const catalogs = data.catalogs.map((catalog) => new Catalog(catalog));
  return data.report.runs.map(
    (run, place) => new Run(run, catalogs[data.runs[place].catalog], data.runs[place]));
}
