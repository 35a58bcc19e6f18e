// What happened in a run and why, in sentences.

class Story {
  constructor(run) {
    this.run = run;
    this.catalog = run.catalog;
  }

  /** Why a behavior was replaced in its task, as far as the data tells. */
  whyReplaced(number, link) {
    const event = this.run.event(number);
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
    const event = this.run.event(number);
    const { task, behavior } = link.from;
    const reasons = [];
    if (event.verb === 'finish' && event.name === behavior) {
      reasons.push(`${this.catalog.behavior(behavior)} finished: ${words(event.cause)}`);
    }
    const requirers = this.run.requirers(number, link.to.task);
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
    const event = this.run.event(number);
    const before = this.run.running(number - 1);
    const after = event.running;
    const list = [];
    const nameOf = (behavior) => this.catalog.behavior(behavior);
    const say = (text, why = '', isBad = false) => list.push({ text, why, isBad });
    if (event.verb === 'situation') say(situationOf(event));
    if (event.note !== undefined) say(event.note);
    if (event.verb === 'fault' && event.note === undefined) say(`${nameOf(event.name)} is faulty: it cannot be activated`);
    if (event.verb === 'reconsider') {
      say(`${event.origin === 'repair' ? 'the repair' : 'the situation'} makes more possible, so a group is decided anew`);
    } else if (event.origin === 'situation') {
      say(this.describeMisfit(number, event.name));
    }
    if (event.search?.status === 'unknown') {
      say('a search limit was reached before the first solution', '', true);
    } else if (event.outcome === 'rejected' && event.conflict.length === 0) {
      say('no consistent set of behaviors; finding the reasons would have taken too long', '', true);
    }
    if (this.run.beginsToWait(number)) {
      say(`${this.catalog.task(event.name)} waits, and tries again after each accepted event of its group`);
    }
    for (const change of event.changes) {
      if (!change.success) say(`${nameOf(change.behavior)} could not be ${change.op}d`, '', true);
    }
    for (const behavior of this.run.untried[number]) {
      if (!this.run.untried[number - 1].includes(behavior)) say(`${nameOf(behavior)} has failed, and is not tried again at the next events`);
    }
    const told = new Set();
    for (const link of this.run.linksOf[number]) {
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
    if (list.length === 0 && event.outcome === 'accepted') {
      const behavior = get(after, event.name);
      say(event.verb === 'start' && behavior !== undefined
        ? `${this.catalog.task(event.name)} runs already, with ${nameOf(behavior)}; nothing changes` : 'nothing changes');
    }
    return list;
  }

  /** Why a behavior does not fit after an event. */
  describeMisfit(number, behavior) {
    const values = this.run.values[number];
    const variable = this.catalog.findMisfit(behavior, values);
    return `${this.catalog.behavior(behavior)} does not fit: ${describeValue(variable, values.get(variable))}`;
  }

  whyRuns(number, task) {
    const priority = get(this.run.requests(number), task);
    const event = this.run.event(number);
    const isStarted = event?.verb === 'start' && event.name === task;
    if (number > 0 && !isStarted && get(this.run.suspended(number - 1), task) !== undefined) {
      return `its request is resumed, priority ${priority}`;
    }
    if (priority !== undefined) {
      const cause = this.run.spanAt(number, task)?.cause ?? 'requested';
      return priority === 0 ? cause : `${cause}, priority ${priority}`;
    }
    const requirers = this.run.requirers(number, task);
    return requirers.length > 0 ? `required by ${this.catalog.taskList(requirers)}` : '';
  }

  tellRequest(number, task, say) {
    const old = get(this.run.requests(number - 1), task);
    const present = get(this.run.requests(number), task);
    if (old === present) return;
    if (present === undefined) {
      say(`${this.catalog.task(task)} has no request any more`);
    } else {
      say(`${this.catalog.task(task)}, which runs already, is requested with priority ${present}`);
    }
  }

  whyStopped(number, task, cause) {
    if (cause === 'requested') return 'stopped by this event';
    if (cause === 'released') return 'nothing requires it any more';
    if (cause !== 'displaced') return words(cause);
    const event = this.run.event(number);
    const behavior = get(this.run.running(number - 1), task);
    const lost = (this.catalog.behaviors.get(behavior)?.requires ?? [])
      .filter((name) => get(event.running, name) === undefined);
    return lost.length > 0 ? `it requires ${this.catalog.taskList(lost)}, which does not run` : 'displaced';
  }

  /** What became of the behavior of a change: who replaced it, or whom it replaced. */
  note(number, change) {
    const notes = [];
    for (const link of this.run.linksOf[number]) {
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
