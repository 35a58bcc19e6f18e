// The search for events.

/** The events of a run that have to do with names, and that have an outcome. */
class Search {
  constructor(run) {
    this.run = run;
    this.texts = []; // of each event: its names in small letters
  }

  textOf(number) {
    if (this.texts[number] === undefined) {
      const event = this.run.event(number);
      const names = [describeEvent(event, this.run.catalog)];
      for (const change of event.changes) names.push(change.behavior, ...change.tasks);
      for (const stopped of event.stopped_tasks) names.push(stopped.task);
      this.texts[number] = names.join('\n').toLowerCase();
    }
    return this.texts[number];
  }

  hasOutcome(number, outcome) {
    const event = this.run.event(number);
    switch (outcome) {
      case '': return true;
      case 'failed': return this.run.isFailed(number);
      case 'changes': return event.changes.length > 0;
      case 'itself': return event.origin !== 'script';
      default: return isAsked(event) && event.outcome === outcome;
    }
  }

  /** The numbers of the events found, or null if nothing is searched for. */
  find(text, outcome) {
    const wanted = text.trim().toLowerCase();
    if (wanted === '' && outcome === '') return null;
    const found = new Set();
    for (let number = 1; number <= this.run.size; ++number) {
      if (this.hasOutcome(number, outcome) && this.textOf(number).includes(wanted)) found.add(number);
    }
    return found;
  }
}
