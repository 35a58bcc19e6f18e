// Which signs occur in a run, for the legend: it explains no others.

class Signs {
  constructor(run) {
    this.run = run;
    this.names = new Set();
    this.read = { events: 0, spans: 0, outages: 0, waitings: 0, links: 0 };
  }

  /** Reads what the run has had since the last call. */
  update() {
    const { run, names } = this;
    const readNew = (kind, action) => {
      for (const list = run[kind]; this.read[kind] < list.length; ++this.read[kind]) action(list[this.read[kind]]);
    };
    readNew('spans', (span) => names.add(span.cause));
    readNew('outages', (outage) => names.add(outage.kind));
    readNew('waitings', (wait) => names.add(wait.kind));
    readNew('links', (link) => names.add(link.kind));
    readNew('events', (event) => this.readEvent(event, this.read.events + 1));
    if (run.failures.size > 0) names.add('failed');
    if (run.catalog.variables.size > 0) names.add('value');
    return names;
  }

  readEvent(event, number) {
    const { run, names } = this;
    const [before, after] = [run.running(number - 1), event.running];
    names.add(event.outcome);
    names.add(`by ${event.origin}`);
    if (event.changes.some((change) => !change.success)) names.add(glyphs.bad);
    const isActive = (running) => Object.values(running).includes(event.name);
    if (event.verb === 'finish' && event.outcome === 'accepted' && isActive(before)) names.add(glyphOf(event.cause)[0]);
    if (event.verb === 'fault' && isActive(after)) names.add('fault of active');
    for (const [task, behavior] of Object.entries(after)) {
      const was = get(before, task);
      if (was !== behavior) names.add(was === undefined ? 'started task' : 'replaced behavior');
      if (!names.has('requirement') && run.requirers(number, task).length > 0) names.add('requirement');
    }
    for (const [task, behavior] of Object.entries(before)) {
      if (get(after, task) !== undefined) continue;
      names.add('stopped task');
      if (Object.keys(before).some((other) => run.catalog.requires(behavior, other))) names.add('ended requirement');
    }
  }
}
