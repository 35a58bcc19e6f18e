// The session: a catalog, the events so far, and where among them the robot is now. The event that is chosen on the
// timeline is the present one: what is asked for next happens after it, and what came later is gone.

class Simulation {
  /** `view`: {onState(), onText(), onNote(text, isBad), onFindings(kind, findings)}. */
  constructor(engine, view) {
    this.engine = engine;
    this.view = view;
    this.page = null;
    this.catalogText = '';
    this.catalogName = 'robot.yaml';
    this.isOpen = false;
    this.due = { timeouts: {}, next: null, now: 0 };
    this.work = Promise.resolve(); // what was asked for is done one after the other
    this.index = 0; // of the present event
    this.loaded = null; // the mission, as long as nothing else was done
  }

  /** One thing after the other. What fails is told, and the next one goes on. */
  do(action) {
    const done = this.work.then(action);
    this.work = done.catch((error) => this.fail(error));
    return this.work;
  }

  fail(error) {
    this.view.onNote(error.message, true);
    if (error instanceof Ended || error instanceof Failed) this.isOpen = false;
  }

  /** A catalog; `mission`, if not null, is run with it. `isWritten`: somebody wants its text as it is. */
  open(text, mission = null, isWritten = true) {
    return this.do(async () => {
      this.catalogText = text;
      const answer = await this.engine.ask({ do: 'open', catalog: text, name: this.catalogName });
      this.view.onFindings('catalog', findingsOf(answer));
      if (answer.catalog === undefined) {
        if (this.isOpen) this.view.onNote('The catalog has errors. The robot is the last one that had none.', true);
        return;
      }
      this.view.onNote('', false);
      this.isOpen = true;
      this.catalog = new Catalog(answer.catalog);
      const moves = (await this.engine.ask({ do: 'what_if' })).report.moves;
      this.view.onCatalog(this.catalog, new Set(moves.filter((move) => move.verb === 'start').map((move) => move.name)));
      this.loaded = null;
      this.showRun(answer.begin, [], []);
      if (mission !== null) await this.loadNow(mission, isWritten);
      else await this.arrive();
    });
  }

  load(mission) {
    return this.do(() => this.loadNow(mission));
  }

  async loadNow(mission, isWritten = true) {
    const answer = await this.engine.ask({ do: 'load', mission, name: 'mission.yaml' });
    const findings = findingsOf(answer);
    this.view.onFindings('mission', findings);
    if (answer.begin === undefined) {
      const [first] = findings;
      if (first !== undefined) this.view.onNote(`the mission does not fit: line ${first.line}: ${first.message}`, true);
      return this.arrive();
    }
    this.loaded = isWritten ? mission : null;
    this.showRun(answer.begin, answer.events, answer.failures);
    await this.arrive();
  }

  /** An entry of a mission, at the present state. */
  apply(entry) {
    return this.do(() => this.take({ do: 'apply', event: JSON.stringify(entry) }));
  }

  /** Lets the clock go on: to a time in seconds, or to what is due next. */
  advance(to) {
    return this.do(() => this.take({ do: 'advance', ...(to === undefined ? {} : { to }) }));
  }

  async take(request) {
    if (!this.isOpen) throw new Error('there is no robot yet: the catalog has errors');
    const answer = await this.engine.ask(request);
    const { first, events, failures, warnings = [] } = answer;
    this.loaded = null;
    const { run } = this.page;
    if (first > run.size) {
      this.page.growRun(events, failures);
    } else {
      const kept = run.events.slice(0, first - 1);
      const keptFailures = run.data.expectations.failures.filter((failure) => failure.index < first);
      this.showRun(run.begin, [...kept, ...events], [...keptFailures, ...failures]);
    }
    await this.arrive(answer);
    const rejected = events.find((event) => event.outcome === 'rejected');
    const reasons = rejected?.conflict.map(({ message }) => message).join('; ');
    const notes = [...(rejected === undefined ? [] : [`${describeEvent(rejected, this.catalog)} was rejected: ${reasons}`]), ...warnings];
    this.view.onNote(notes.join('; '), notes.length > 0);
    this.view.onText();
  }

  /** What an entry would do: a move of cbc.what-if/1, or an error. */
  async whatIf(entry) {
    const { report, errors } = await this.engine.ask({ do: 'what_if', events: [JSON.stringify(entry)] });
    return errors.length > 0 ? { error: errors[0] } : { move: report.moves[0] };
  }

  /** Another event was chosen; see Page. */
  onChoice(number) {
    const index = this.page.run.size === 0 ? 0 : number;
    if (!this.isArriving && index !== this.index) this.goTo(index);
  }

  refusalTexts() {
    return [];
  }

  goTo(index) {
    return this.do(async () => {
      const answer = await this.engine.ask({ do: 'goto', index });
      await this.arrive(answer);
      this.view.onText();
    });
  }

  /** To before the last thing that was done, with all that followed it at once. */
  undo() {
    return this.do(async () => {
      const present = this.index;
      let answer = { index: present };
      for (let wanted = present - 1; wanted >= 0 && answer.index >= present; --wanted) {
        answer = await this.engine.ask({ do: 'goto', index: wanted });
      }
      await this.arrive(answer);
      this.view.onText();
    });
  }

  /** The present state is that after the event of an answer, or after the last one. */
  async arrive(answer = { index: this.page.run.size }) {
    this.index = answer.index;
    const state = await this.engine.ask({ do: 'state' });
    this.due = { timeouts: state.timeouts, next: state.next_due, now: answer.time ?? state.report.time };
    this.isArriving = true;
    this.page.choose(Math.max(1, this.index), true);
    this.isArriving = false;
    this.view.onState();
  }

  /** The mission up to the present event: its text as it was written, until something else is done. */
  async mission() {
    if (!this.isOpen) return '';
    if (this.loaded !== null && this.index === this.page.run.size) return this.loaded;
    return (await this.engine.ask({ do: 'mission' })).mission;
  }

  /** The mission with all events, also those after the present one, and the index of that: {mission, index}. */
  async whole() {
    let whole = { mission: '', index: 0 };
    await this.do(async () => {
      if (!this.isOpen || this.page.run.size === 0) return;
      const { index } = this;
      if (this.canRedo) await this.engine.ask({ do: 'goto', index: this.page.run.size });
      whole = { mission: await this.mission(), index };
      if (this.canRedo) await this.engine.ask({ do: 'goto', index });
    });
    return whole;
  }

  async why(subject) {
    return (await this.engine.ask({ do: 'why', subject, index: this.index })).event;
  }

  showRun(begin, events, failures) {
    const data = { catalog: this.catalogName, script: 'session', events,
                   expectations: { passed: 0, failed: failures.length, failures, successes: [] } };
    const run = new Run(data, this.catalog, begin);
    if (this.page === null) {
      this.page = new Page([run], null, false);
      this.page.live = this;
    } else {
      this.page.replaceRun(run);
    }
  }

  get canUndo() {
    return this.index > 0;
  }

  get canRedo() {
    return this.page !== null && this.index < this.page.run.size;
  }
}

const findingsOf = ({ lint }) => lint.files.flatMap((file) => file.diagnostics);
