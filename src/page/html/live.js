// A run that goes on while the page shows it: its events come from the server, over server-sent events.
// The page keeps the last ones only. The server says from time to time what the state is, so that the
// page can begin there.

const mostKept = 10_000; // events; if there are more, the older half goes
const mostRefusals = 5; // that are shown
const pauseOfUpdates = 100; // milliseconds
const longestSilence = 30_000; // milliseconds, after which the connection counts as lost

const liveTexts = {
  begin: 'Connecting\u2026',
  live: 'Live',
  lost: 'Connection lost. Trying again\u2026',
  ended: 'Ended. This page keeps its events until it is closed or reloaded.',
  other: 'This run is over. The server shows another one, or none: reload the page to see.',
};

class Live {
  /** `run`: the run of the page, which is empty. `elements`: {bar, state, note, newest}. `wanted`: the index
   * of the event to show, or null for the newest. */
  constructor(page, run, token, elements, wanted) {
    Object.assign(this, elements);
    this.page = page;
    this.catalog = run.catalog;
    this.data = run.data;
    this.address = `events?${new URLSearchParams({ run: token })}`;
    this.parts = [{ begin: run.begin, events: [], failures: [] }]; // all that is kept
    this.lastIndex = run.begin.index;
    this.lastId = 0;
    this.waiting = { events: [], failures: [] }; // what the page does not show yet
    this.refusals = []; // the last ones
    this.refusalCount = 0;
    this.mustRebuild = false;
    this.timer = null;
    this.wanted = wanted;
    this.follows = wanted === null;
    this.bar.hidden = false;
    this.newest.addEventListener('click', () => page.choose(page.run.size));
    this.tell('begin');
    this.connect();
    this.watch = setInterval(() => this.look(), 5000);
  }

  connect() {
    this.source?.close();
    this.source = new EventSource(this.address);
    this.heard = Date.now();
    const on = (type, action) => this.source.addEventListener(type, (message) => {
      this.heard = Date.now();
      action(message);
    });
    const onNew = (type, action) => on(type, (message) => {
      const id = Number(message.lastEventId);
      if (id <= this.lastId) return; // it came before the connection was lost
      this.lastId = id;
      action(JSON.parse(showEscapes(message.data)));
      this.updateSoon();
    });
    on('open', () => this.tell('live'));
    on('alive', () => {});
    on('state', (message) => this.takeState(JSON.parse(showEscapes(message.data))));
    onNew('message', (event) => this.takeEvent(event));
    onNew('failure', (failure) => this.takeFailure(failure));
    onNew('refusal', (refusal) => this.takeRefusal(refusal));
    onNew('end', (end) => this.takeEnd(end));
    this.source.addEventListener('error', () =>
      this.tell(this.source.readyState === EventSource.CLOSED ? 'other' : 'lost'));
  }

  /** A browser does not notice by itself that nothing comes any more. */
  look() {
    if (Date.now() - this.heard < longestSilence || this.source.readyState === EventSource.CLOSED) return;
    this.tell('lost');
    this.connect();
  }

  takeState(begin) {
    if (begin.index < this.lastIndex) return; // known
    const part = { begin, events: [], failures: [] };
    if (begin.index > this.lastIndex) { // events between are lost: this page was too slow, or away
      this.parts = [part];
      this.lastIndex = begin.index;
      this.rebuild();
      return;
    }
    this.parts.push(part);
    let kept = this.parts.reduce((sum, one) => sum + one.events.length, 0);
    if (kept < mostKept) return;
    while (kept > mostKept / 2) kept -= this.parts.shift().events.length;
    this.rebuild();
  }

  rebuild() {
    this.mustRebuild = true;
    this.updateSoon();
  }

  takeEvent(event) {
    this.lastIndex = event.index;
    this.parts.at(-1).events.push(event);
    this.waiting.events.push(event);
    if (this.waiting.events.length > mostKept) this.mustRebuild = true;
    if (this.mustRebuild) this.waiting.events = [];
  }

  takeFailure(failure) {
    ++this.data.expectations.failed;
    this.parts.at(-1).failures.push(failure);
    this.waiting.failures.push(failure);
  }

  takeRefusal(refusal) {
    ++this.refusalCount;
    this.refusals.push(refusal);
    if (this.refusals.length > mostRefusals) this.refusals.shift();
  }

  takeEnd({ passed, failed, error }) {
    Object.assign(this.data.expectations, { passed, failed });
    if (error !== undefined) this.data.error = error;
    clearInterval(this.watch);
    this.source.close();
    this.tell('ended');
  }

  updateSoon() {
    this.timer ??= setTimeout(() => {
      this.timer = null;
      this.update();
    }, pauseOfUpdates);
  }

  update() {
    const { page } = this;
    const { events, failures } = this.waiting;
    this.waiting = { events: [], failures: [] };
    if (this.mustRebuild) {
      this.mustRebuild = false;
      page.replaceRun(this.makeRun());
    } else {
      page.growRun(events, failures);
    }
    const { run } = page;
    if (this.wanted !== null && run.indexOf(run.size) >= this.wanted) {
      page.choose(run.numberOf(this.wanted));
      this.wanted = null;
    }
    if (this.follows) page.chooseNewest();
    this.describe();
  }

  makeRun() {
    const failures = this.parts.flatMap((part) => part.failures);
    const data = {
      ...this.data,
      events: this.parts.flatMap((part) => part.events),
      expectations: { ...this.data.expectations, failures },
    };
    this.data = data;
    return new Run(data, this.catalog, this.parts[0].begin);
  }

  /** An event was chosen, and not by this object: only from the newest one on newer ones are shown. */
  onChoice(number) {
    this.follows = number === this.page.run.size;
    this.wanted = null;
    this.describe();
  }

  describe() {
    const { run, number } = this.page;
    this.newest.hidden = this.follows || run.size === 0;
    this.newest.textContent = `newest event (${quantity(run.size - number, 'event')} later)`;
    const left = run.begin.index;
    this.note.textContent = left === 0 ? '' : `The ${quantity(left, 'event')} before are not on this page.`;
  }

  /** What is announced to screen readers: not each event, which would be too much. */
  tell(state) {
    if (this.bar.dataset.state === state) return;
    this.bar.dataset.state = state;
    this.state.textContent = liveTexts[state];
  }

  /** The lines that were refused, last first. */
  refusalTexts() {
    const texts = this.refusals.map(({ line, error }) => `line ${line} of the stream was refused: ${error}`).reverse();
    const others = this.refusalCount - texts.length;
    return others > 0 ? [...texts, `and ${quantity(others, 'line')} before`] : texts;
  }
}
