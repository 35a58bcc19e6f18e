// What the page knows about a run, made of the data once: states, spans of activity, rows, links
// between what follows each other, and sentences. Nothing here touches the page.

// Names of a catalog may be anything, even "__proto__": look-ups are maps, or ask for own members.
const get = (object, name) => (Object.hasOwn(object, name) ? object[name] : undefined);

const words = (name) => name.replaceAll('_', ' ');

/** Seconds to the millisecond, or to the microsecond where it takes that. */
function formatTime(seconds) {
  return seconds.toFixed(Math.round(seconds * 1e6) % 1000 === 0 ? 3 : 6);
}

function formatPercent(share) {
  return `${Number((share * 100).toPrecision(6))} %`;
}

/** A catalog with look-ups. */
class Catalog {
  constructor(data) {
    this.variables = new Map(data.variables.map(({ variable, values }) => [variable, values]));
    this.taskPlace = new Map(data.tasks.map((name, place) => [name, place]));
    this.behaviorPlace = new Map(data.behaviors.map((behavior, place) => [behavior.name, place]));
    this.behaviors = new Map(data.behaviors.map((behavior) => [behavior.name, behavior]));
    this.performers = new Map(data.tasks.map((name) => [name, []]));
    for (const behavior of data.behaviors) {
      for (const entry of behavior.performs) this.performers.get(entry.task).push(behavior.name);
    }
    this.lists = new Map(); // of each task: the exclusivity lists it is in
    for (const list of data.exclusive) {
      for (const task of list) this.lists.set(task, [...(this.lists.get(task) ?? []), list]);
    }
  }

  excludes(task, other) {
    return (this.lists.get(task) ?? []).some((list) => list.includes(other));
  }

  requires(behavior, task) {
    return (this.behaviors.get(behavior)?.requires ?? []).includes(task);
  }

  /** The first variable that a behavior names and whose value is none that it names, or undefined. */
  findMisfit(behavior, values) {
    return Object.entries(this.behaviors.get(behavior)?.situation ?? {})
      .find(([variable, fitting]) => !fitting.includes(values.get(variable)))?.[0];
  }

  suitability(behavior, task) {
    return this.behaviors.get(behavior)?.performs.find((entry) => entry.task === task)?.suitability;
  }

  /** Names in sentences: a task and a behavior may have the same one. */
  task(name) {
    return this.behaviors.has(name) ? `task ${name}` : name;
  }

  behavior(name) {
    return this.performers.has(name) ? `behavior ${name}` : name;
  }

  taskList(names) {
    return names.map((name) => this.task(name)).join(', ');
  }

  sortTasks(names) {
    return [...names].sort((a, b) => this.taskPlace.get(a) - this.taskPlace.get(b));
  }

  sortBehaviors(names) {
    return [...names].sort((a, b) => this.behaviorPlace.get(a) - this.behaviorPlace.get(b));
  }
}

/** Whether an event is one that is accepted or rejected. */
const isAsked = (event) => ['start', 'stop', 'finish'].includes(event.verb);

const describeValue = (variable, value) => `${variable} is ${value}`;

/** Of `situation`, the names of `variables` have values, all others are behaviors. */
const describeSituation = (situation, variables) =>
  Object.entries(situation)
    .map(([name, value]) => {
      if (get(variables, name) !== undefined) return describeValue(name, value);
      return `${name} ${value ? 'available' : 'unavailable'}`;
    })
    .join(', ');

/** The same of an event. */
const situationOf = (event) => describeSituation(event.situation ?? {}, event.variables ?? {});

/** An event in a line, without its outcome. */
function describeEvent(event, catalog) {
  let text = event.verb;
  if (event.verb === 'wait') return 'wait';
  if (event.verb === 'situation') return `situation: ${situationOf(event)}`;
  if (event.task !== undefined) {
    text += ` task ${event.task}` + (event.name === null ? ', which nothing performs' : ` (${event.name})`);
  } else if (event.name !== undefined) {
    const isOfTask = event.verb === 'start' || event.verb === 'stop';
    text += ` ${isOfTask ? event.name : catalog.behavior(event.name)}`;
  }
  if (event.priority !== undefined) text += `, priority ${event.priority}`;
  if (event.verb === 'finish') text += `: ${words(event.cause)}`;
  if (event.parameters !== undefined) text += ` ${JSON.stringify(event.parameters)}`;
  if (event.origin === 'timeout') text += ' (by the clock)';
  if (event.origin === 'reactive') text += ' (reactive start)';
  if (event.origin === 'situation') text += ' (it no longer fits)';
  if (event.origin === 'fault') text += ' (its activation could not be taken back)';
  return text;
}

/** The same for a place where it says elsewhere what the situation is. */
const nameEvent = (event, catalog) => (event.verb === 'situation' ? 'situation' : describeEvent(event, catalog));

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
    this.failures = new Map(); // of each index: the messages
    for (const failure of data.expectations.failures) {
      this.failures.set(failure.index, [...(this.failures.get(failure.index) ?? []), failure]);
    }
    this.readSituations();
    this.readWaiting();
    this.readSpans();
    this.readLinks();
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

  /** Why a behavior was replaced in its task, as far as the data tells. */
  whyReplaced(number, link) {
    const event = this.event(number);
    const { task, behavior } = link.from;
    const named = this.catalog.behavior(behavior);
    if (event.verb === 'finish' && event.name === behavior) {
      return event.origin === 'situation' ? '' : `${named} finished: ${words(event.cause)}`;
    }
    const lost = (this.catalog.behaviors.get(behavior)?.requires ?? [])
      .filter((name) => get(event.running, name) === undefined);
    if (lost.length > 0) return `${named} requires ${this.catalog.taskList(lost)}, which no longer runs`;
    const old = this.catalog.suitability(behavior, task);
    const present = this.catalog.suitability(link.to.behavior, task);
    if (present > old) return `it suits ${this.catalog.task(task)} better, ${present} % instead of ${old} %`;
    return '';
  }

  /** Why a task gave way to one that excludes it. */
  whyGaveWay(number, link) {
    const event = this.event(number);
    const { task, behavior } = link.from;
    const reasons = [];
    if (event.verb === 'finish' && event.name === behavior) {
      reasons.push(`${this.catalog.behavior(behavior)} finished: ${words(event.cause)}`);
    }
    const requirers = this.requirers(number, link.to.task);
    const follower = this.catalog.task(link.to.task);
    if (event.verb === 'start' && event.name === link.to.task) {
      reasons.push(`${follower} was started with priority ${event.priority}`);
    } else if (requirers.length > 0) {
      reasons.push(`${follower} is now required by ${this.catalog.taskList(requirers)}`);
    }
    reasons.push(`${follower} excludes ${this.catalog.task(task)}`);
    return reasons.join('; ');
  }

  /** What an event did, in sentences: [{text, why, isBad}]; the reasons of its rejection are its own. */
  sentences(number) {
    const event = this.event(number);
    const before = this.running(number - 1);
    const after = event.running;
    const list = [];
    const nameOf = (behavior) => this.catalog.behavior(behavior);
    const say = (text, why = '', isBad = false) => list.push({ text, why, isBad });
    if (event.verb === 'situation') say(situationOf(event));
    if (event.origin === 'situation') say(this.describeMisfit(number, event.name));
    if (event.search?.status === 'unknown') {
      say('a search limit was reached before the first solution', '', true);
    } else if (event.outcome === 'rejected' && event.conflict.length === 0) {
      say('no consistent set of behaviors; finding the reasons would have taken too long', '', true);
    }
    if (this.beginsToWait(number)) {
      say(`${this.catalog.task(event.name)} waits, and tries again after each accepted event of its group`);
    }
    for (const change of event.changes) {
      if (!change.success) say(`${nameOf(change.behavior)} could not be ${change.op}d`, '', true);
    }
    const told = new Set();
    for (const link of this.linksOf[number]) {
      told.add(link.from.task).add(link.to.task);
      if (link.kind === 'replaced') {
        say(`${nameOf(link.to.behavior)} replaces ${nameOf(link.from.behavior)} (${link.from.task})`,
            this.whyReplaced(number, link));
      } else if (link.from.behavior === link.to.behavior) {
        say(`${nameOf(link.from.behavior)} passes from ${this.catalog.task(link.from.task)} to ${this.catalog.task(link.to.task)}`,
            this.whyGaveWay(number, link));
      } else {
        say(`${nameOf(link.to.behavior)} (${link.to.task}) takes the place of ` +
            `${nameOf(link.from.behavior)} (${link.from.task})`, this.whyGaveWay(number, link));
      }
    }
    for (const [task, behavior] of Object.entries(after)) {
      const was = get(before, task);
      if (was === undefined && !told.has(task)) {
        say(`${nameOf(behavior)} starts (${task})`, this.whyRuns(number, task));
      } else if (was === behavior) {
        this.tellRequest(number, task, say);
      }
    }
    const causes = new Map(event.stopped_tasks.map((stopped) => [stopped.task, stopped.cause]));
    for (const [task, behavior] of Object.entries(before)) {
      if (get(after, task) !== undefined || told.has(task)) continue;
      say(`${nameOf(behavior)} stops (${task})`, this.whyStopped(number, task, causes.get(task)));
    }
    for (const change of event.changes) {
      if (change.cause === 'restarted' && change.op === 'activate' && change.success) {
        say(`${nameOf(change.behavior)} restarts`, 'its parameters changed');
      }
    }
    return list;
  }

  /** Why a behavior does not fit after an event. */
  describeMisfit(number, behavior) {
    const values = this.values[number];
    const variable = this.catalog.findMisfit(behavior, values);
    return `${this.catalog.behavior(behavior)} does not fit: ${describeValue(variable, values.get(variable))}`;
  }

  whyRuns(number, task) {
    const priority = get(this.requests(number), task);
    if (priority !== undefined) return priority === 0 ? 'reactive' : `requested, priority ${priority}`;
    const requirers = this.requirers(number, task);
    return requirers.length > 0 ? `required by ${this.catalog.taskList(requirers)}` : '';
  }

  tellRequest(number, task, say) {
    const old = get(this.requests(number - 1), task);
    const present = get(this.requests(number), task);
    if (old === present) return;
    if (present === undefined) {
      say(`${this.catalog.task(task)} has no request any more`);
    } else {
      say(`${this.catalog.task(task)}, which runs already, is requested with priority ${present}`);
    }
  }

  whyStopped(number, task, cause) {
    const event = this.event(number);
    if (cause !== undefined && cause !== 'interrupted') return words(cause);
    if (event.verb === 'stop' && event.name === task) return 'stopped by this event';
    const behavior = get(this.running(number - 1), task);
    const lost = (this.catalog.behaviors.get(behavior)?.requires ?? [])
      .filter((name) => get(event.running, name) === undefined);
    if (get(this.requests(number - 1), task) === undefined) return 'nothing requires it any more';
    return lost.length > 0 ? `it requires ${this.catalog.taskList(lost)}, which does not run` : 'displaced';
  }

  /** What became of the behavior of a change: who replaced it, or whom it replaced. */
  note(number, change) {
    const notes = [];
    for (const link of this.linksOf[number]) {
      const isReplaced = link.kind === 'replaced';
      if (change.op === 'deactivate' && link.from.behavior === change.behavior) {
        notes.push(`${isReplaced ? 'replaced by' : 'gives way to'} ${link.to.behavior}`);
      }
      if (change.op === 'activate' && change.success && link.to.behavior === change.behavior) {
        notes.push(`${isReplaced ? 'replaces' : 'in place of'} ${link.from.behavior}`);
      }
    }
    return [...new Set(notes)].join(', ');
  }
}

function readRuns(data) {
  const catalogs = data.catalogs.map((catalog) => new Catalog(catalog));
  return data.report.runs.map(
    (run, place) => new Run(run, catalogs[data.runs[place].catalog], data.runs[place]));
}
