// The session: a catalog, what was done so far, and where among it the robot is now. The event that is chosen on the
// timeline is the present one: what is asked for next happens after it, and what came later is gone.
//
// What was done is kept here as well as in the program: a mission that was loaded, and the requests after it. With
// another catalog, or after the program was lost, all of it is done again.

const beginning = { index: 0, time: 0, entry: 0, entries: 0 };

class Simulation {
  /** `view`: {onCatalog(catalog, requestable), onState(), onText(), onEvent(), onNote(text, isBad),
   * onFindings(kind, findings), onLeave()}. */
  constructor(engine, view) {
    this.engine = engine;
    this.view = view;
    this.page = null;
    this.names = { catalog: 'robot.yaml', mission: 'robot.mission.yaml' }; // of files
    this.catalogText = null; // of the robot; null: there has been none
    this.isOpen = false;
    this.isStale = false; // the last text has errors, and the robot is an earlier one
    this.work = Promise.resolve(); // what was asked for is done one after the other
    this.place = beginning; // the present state, see session.h
    this.due = { timeouts: {}, next: null, now: 0 };
    this.forget();
  }

  forget() {
    this.mission = ''; // that was loaded
    this.missionEntries = 0; // of it, in the program
    this.done = []; // requests after it
    this.lost = null; // if not all could be done again: {count} of these, and the whole and the place before
  }

  /** One thing after the other. What fails is told, and the next one goes on. */
  do(action) {
    const done = this.work.then(action);
    this.work = done.catch((error) => this.fail(error));
    return this.work;
  }

  fail(error) {
    this.view.onNote(error.message, true);
    if (isEnd(error)) this.isOpen = false;
  }

  /** Another session. */
  open(text, mission = '') {
    return this.do(async () => {
      this.forget();
      this.mission = mission;
      this.isOpen = false; // until its catalog is right
      this.place = beginning;
      await this.openNow(text);
    });
  }

  /** The robot has changed: what was done is done with the new one, as far as it has errors no more. */
  change(text) {
    return this.do(() => this.openNow(text));
  }

  /** After the program was lost. */
  recover() {
    return this.do(async () => {
      if (this.catalogText !== null) await this.openNow(this.catalogText);
    });
  }

  async openNow(text) {
    const before = this.lost?.before ?? await this.wholeNow();
    const answer = await this.engine.ask({ do: 'open', catalog: text, name: this.names.catalog });
    this.view.onFindings('catalog', findingsOf(answer));
    this.isStale = answer.catalog === undefined;
    if (this.isStale) {
      if (this.isOpen) this.view.onState();
      else this.view.onNote('The catalog has errors, so there is no robot yet.', true);
      return;
    }
    this.catalogText = text;
    this.catalog = new Catalog(answer.catalog);
    this.view.onCatalog(this.catalog, new Set(answer.requestable));
    this.isOpen = true;
    await this.repeat(answer.begin, before);
  }

  /** Does again what was done, and goes where the session was. What does not fit is kept until something else is done. */
  async repeat(begin, before) {
    const place = this.lost?.place ?? this.place;
    const news = { begin, events: [], failures: [], expectations: 0 };
    let note = '';
    this.lost = null;
    this.missionEntries = 0;
    this.view.onFindings('mission', []);
    let last = beginning;
    if (this.mission !== '') {
      const { answer, fault } = await this.askLoad(this.mission);
      if (fault !== null) {
        note = `The mission does not fit this robot: ${fault}`;
        this.lost = { count: 0, place, before };
      } else {
        Object.assign(news, answer);
        last = answer;
        this.missionEntries = answer.entries;
        note = answer.stopped ?? '';
      }
    }
    for (let count = 0; this.lost === null && count < this.done.length; ++count) {
      try {
        last = await this.engine.ask(this.done[count]);
        news.events.push(...last.events);
        news.failures.push(...last.failures);
        news.expectations = last.expectations;
      } catch (error) {
        if (isEnd(error)) throw error;
        note = `What you did does not fit this robot from step ${count + 1} on: ${error.message}`;
        this.lost = { count, place, before };
      }
    }
    this.showRun(news);
    if (this.lost === null) last = await this.goToSame(place, last, news.events);
    await this.arrive(last);
    this.view.onNote(note, note !== '');
    this.view.onText();
  }

  /** Goes where the session was, which may be an event that the clock made on its way. */
  async goToSame({ entry, entries, time }, last, events) {
    if (entry >= entries || entry > last.entries) return last;
    const answer = await this.engine.ask({ do: 'goto', entry });
    const index = events.filter((event) => event.time <= time).length;
    return time > answer.time && index > answer.index ? this.engine.ask({ do: 'goto', index }) : answer;
  }

  /** A mission, in place of what was done. Returns whether it could be used. */
  async load(mission) {
    await this.do(async () => {
      this.needRobot();
      const { answer, fault } = await this.askLoad(mission);
      if (fault !== null) {
        this.view.onNote(`The mission has errors: ${fault}`, true);
        return;
      }
      this.forget();
      this.mission = mission;
      this.missionEntries = answer.entries;
      this.showRun(answer);
      await this.arrive(answer);
      this.view.onNote(answer.stopped ?? '', answer.stopped !== undefined);
    });
    return this.mission === mission;
  }

  /** Runs a mission: the answer, and where it is wrong, or null. */
  async askLoad(mission) {
    const answer = await this.engine.ask({ do: 'load', mission, name: 'mission.yaml' });
    const findings = findingsOf(answer);
    this.view.onFindings('mission', findings);
    const [first] = findings;
    return { answer, fault: answer.begin === undefined ? `line ${first?.line}: ${first?.message}` : null };
  }

  checkProperties(properties) {
    return this.do(async () => {
      if (!this.isOpen) return;
      this.view.onFindings('properties', findingsOf(await this.engine.ask({ do: 'properties', properties })));
    });
  }

  needRobot() {
    if (!this.isOpen) throw new Error('there is no robot yet: the catalog has errors');
  }

  /** An entry of a mission, at the present state; `clock`: seconds until then, if the clock has run. */
  apply(entry, clock = null) {
    return this.do(async () => {
      if (clock !== null && clock > this.place.time) await this.take({ do: 'advance', to: clock });
      await this.take({ do: 'apply', event: JSON.stringify(entry) });
    });
  }

  /** Lets the clock go on: to a time in seconds, or to what is due next. */
  advance(to) {
    return this.do(async () => {
      if (to === undefined || to > this.place.time) await this.take({ do: 'advance', ...(to === undefined ? {} : { to }) });
    });
  }

  step(seconds) {
    return this.do(() => this.take({ do: 'advance', to: this.place.time + seconds }));
  }

  async take(request) {
    this.needRobot();
    const before = this.place;
    const isForked = before.entry < this.missionEntries;
    const missionUntilNow = isForked ? (await this.engine.ask({ do: 'mission' })).mission : this.mission;
    const answer = await this.engine.ask(request);
    const done = Math.min(this.lost?.count ?? Infinity, Math.max(0, before.entry - this.missionEntries));
    this.done.length = Math.min(this.done.length, done);
    if (this.lost !== null && this.missionEntries === 0) this.mission = '';
    else this.mission = missionUntilNow;
    if (isForked) this.missionEntries = before.entry;
    this.lost = null;
    // The clock had made only a part of what it had been asked for.
    if (answer.entry === before.entry + 2) this.done.push({ do: 'advance', to: before.time });
    this.done.push(request.do === 'advance' ? { do: 'advance', to: answer.time } : request);

    const { first, events, failures, expectations, warnings = [] } = answer;
    const { run } = this.page;
    if (first > run.size) {
      const failed = run.data.expectations.failures.length + failures.length;
      Object.assign(run.data.expectations, { passed: expectations - failed, failed });
      this.page.growRun(events, failures);
    } else {
      const kept = run.data.expectations.failures.filter((failure) => failure.index < first);
      this.showRun({ begin: run.begin, events: [...run.events.slice(0, first - 1), ...events],
                     failures: [...kept, ...failures], expectations });
    }
    await this.arrive(answer);
    const rejected = events.find((event) => event.outcome === 'rejected');
    const reasons = rejected?.conflict.map(({ message }) => message).join('; ');
    const notes = [...(rejected === undefined ? [] : [`Rejected: ${describeEvent(rejected, this.catalog)}: ${reasons}`]), ...warnings];
    this.view.onNote(notes.join('; '), notes.length > 0);
    this.view.onText();
    this.view.onEvent();
  }

  /** What an entry would do: a move of cbc.what-if/1, or {error}; undefined if the program was lost meanwhile. */
  async whatIf(entry) {
    let found;
    await this.do(async () => {
      if (!this.isOpen) return;
      try {
        const { report } = await this.engine.ask({ do: 'what_if', event: JSON.stringify(entry) });
        [found] = report.moves;
      } catch (error) {
        if (isEnd(error)) throw error;
        found = { error: error.message };
      }
    });
    return found;
  }

  /** Another event was chosen; see Page. */
  onChoice(number) {
    const index = this.page.run.size === 0 ? 0 : number;
    if (this.isArriving || index === this.place.index) return;
    this.view.onLeave();
    this.goTo(index);
  }

  refusalTexts() {
    return [];
  }

  goTo(index) {
    return this.do(async () => {
      const wanted = Math.max(0, Math.min(index, this.page.run.size));
      await this.arrive(await this.engine.ask({ do: 'goto', index: wanted }));
    });
  }

  undo() {
    return this.go(-1);
  }

  redo() {
    return this.go(1);
  }

  /** To the next entry, in one direction, with which something differs: expectations change nothing. */
  go(step) {
    return this.do(async () => {
      const { index, time, entry, entries } = this.place;
      let answer = this.place;
      // The present state may be amid the entry after this one.
      for (let wanted = step > 0 ? entry + 1 : entry; wanted >= 0 && wanted <= entries; wanted += step) {
        answer = await this.engine.ask({ do: 'goto', entry: wanted });
        if (answer.index !== index || answer.time !== time) break;
      }
      await this.arrive(answer);
    });
  }

  /** The present state is that of an answer. */
  async arrive({ index, time, entry, entries }) {
    this.place = { index, time, entry, entries };
    const state = await this.engine.ask({ do: 'state' });
    this.due = { timeouts: state.timeouts, next: state.next_due, now: time };
    this.view.onState(); // first, as the page makes the browser lay it out
    this.isArriving = true;
    this.page.choose(Math.max(1, index), true);
    this.isArriving = false;
  }

  /** The mission with all that was done, as it was loaded if nothing was done since, and the index of the present
   * event: {mission, index}. What the robot cannot do any more is a part of it. */
  async whole() {
    let whole = null;
    await this.do(async () => {
      whole = this.lost?.before ?? await this.wholeNow();
    });
    return whole ?? { mission: this.mission, index: this.place.index };
  }

  async wholeNow() {
    const { index, entry, entries } = this.place;
    if (!this.isOpen || this.done.length === 0) return { mission: this.mission, index };
    if (entry < entries) await this.engine.ask({ do: 'goto', entry: entries });
    const { mission } = await this.engine.ask({ do: 'mission' });
    if (entry < entries) {
      const back = await this.engine.ask({ do: 'goto', entry });
      if (back.index !== index) await this.engine.ask({ do: 'goto', index }); // the clock made it
    }
    return { mission, index };
  }

  async why(task) {
    let event = null;
    await this.do(async () => {
      event = (await this.engine.ask({ do: 'why', task, index: this.place.index })).event;
    });
    return event;
  }

  showRun({ begin, events, failures, expectations }) {
    const data = { catalog: this.names.catalog, script: this.names.mission, events,
                   expectations: { passed: expectations - failures.length, failed: failures.length, failures, successes: [] } };
    const run = new Run(data, this.catalog, begin);
    if (this.page === null) {
      this.page = new Page([run], null, false);
      this.page.live = this;
    } else {
      this.page.replaceRun(run);
    }
  }

  /** The behaviors that are active now. */
  get performed() {
    return new Set(Object.values(this.page.run.running(this.place.index)));
  }

  get canUndo() {
    return this.place.index > 0 || this.place.entry > 0;
  }

  get canRedo() {
    return this.place.entry < this.place.entries;
  }
}

const findingsOf = ({ lint }) => lint.files.flatMap((file) => file.diagnostics);
