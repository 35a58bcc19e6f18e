// Puts the parts of the page together: which run and which event are shown, keys, files and paper.

/** Whether a key does nothing by itself: those who speak to their computer can turn letters off. */
const isCharacterOff = (key) => key.length === 1 && !byId('takes-characters').checked;

class Page {
  /** `properties`: of a page of properties; null on one of missions. `hasAddress`: whether the address of the
   * page says what is shown. */
  constructor(runs, properties, hasAddress = true) {
    this.runs = runs;
    this.timeline = new Timeline({
      picture: byId('picture'), sheet: byId('sheet'), names: byId('labels'), plot: byId('plot'), canvas: byId('canvas'),
    });
    this.minimap = new Minimap(byId('minimap'), this.timeline);
    this.timeline.onDraw = () => {
      this.minimap.draw();
      this.fillLegend();
    };
    this.legend = new Legend(byId('legend'));
    this.graph = new GraphPane(byId('graph'), byId('graph-body'));
    this.gestures = new Gestures(this.timeline, {
      onChoose: (number) => this.choose(number),
      onHover: (event, target) => this.hover(event, target),
    });
    this.table = new EventsTable(byId('events'), byId('log-scroll'), (number) => this.choose(number));
    this.overview = new Overview(
      { section: byId('overview'), summary: byId('overview-summary'), body: byId('missions').tBodies[0] }, runs,
      properties, (place) => this.show(place));
    this.address = hasAddress
      ? new Address(runs, ({ place, index }) => this.show(place, this.numberAt(place, index))) : null;
    byId('legend-fold').open = innerWidth >= 900 && innerHeight >= 1100;
    byId('wants-graph').checked = innerWidth >= 1400;
    this.graph.want(byId('wants-graph').checked);
    byId('help-choice').append(...choiceElement().querySelectorAll('p'));
    this.setUpControls();
    this.setUpPaper();
    if (runs.length > 0) this.showFirst();
    else this.showList();
  }

  /** There are properties, but none of them has a script to step through. */
  showList() {
    document.body.classList.add('is-list');
    byId('title').textContent = 'Properties';
    document.title = 'Properties \u2013 cbc verify';
  }

  /** Opens at what the address asks for, or at the first failure. */
  showFirst() {
    const wanted = this.address?.read();
    const failed = this.runs.findIndex((run) => run.hasFailed);
    const place = wanted?.place ?? Math.max(0, failed);
    this.show(place, this.numberAt(place, wanted?.index));
  }

  numberAt(place, index) {
    return index === undefined || index === null ? null : this.runs[place].numberOf(index);
  }

  setUpControls() {
    const { timeline } = this;
    const on = (id, name, action) => byId(id).addEventListener(name, action);
    this.slider = byId('slider');
    on('slider', 'input', () => this.choose(Number(this.slider.value)));
    on('first', 'click', () => this.choose(1));
    on('back', 'click', () => this.choose(this.number - 1));
    on('next', 'click', () => this.choose(this.number + 1));
    on('last', 'click', () => this.choose(this.run.size));
    on('problem-back', 'click', () => this.stepIn(this.run.problems, -1));
    on('problem-next', 'click', () => this.stepIn(this.run.problems, 1));
    on('zoom-in', 'click', () => timeline.zoomBy(1.6));
    on('zoom-out', 'click', () => timeline.zoomBy(1 / 1.6));
    on('fit', 'click', () => timeline.fit());
    on('save', 'click', () => this.save());
    // Events of other parts of the robot are not on a page of properties, so their numbers are others.
    on('continue', 'click', () => openSimulator(this.run.continuation, this.run.property === null ? this.number : undefined));
    on('help-open', 'click', () => byId('help').showModal());
    on('search', 'input', () => this.search());
    on('outcome', 'change', () => this.search());
    on('search', 'keydown', (event) => this.onSearchKey(event));
    on('more', 'click', () => {
      const isOpen = byId('more').getAttribute('aria-expanded') === 'true';
      byId('more').setAttribute('aria-expanded', `${!isOpen}`);
    });
    on('scale', 'change', (event) => timeline.setScale(event.target.value));
    on('wants-graph', 'change', (event) => {
      this.graph.want(event.target.checked);
      this.fillLegend();
    });
    on('all-links', 'change', (event) => {
      timeline.wantsLinks = event.target.checked;
      timeline.drawSoon();
    });
    on('all-rows', 'change', (event) => {
      timeline.wantsAll = event.target.checked;
      timeline.setUpRows();
    });
    document.addEventListener('keydown', (event) => this.onKey(event));
  }

  onKey(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || byId('help').open || this.run === undefined) return;
    if (event.key === 'Escape') this.hover(null, null);
    const { target } = event;
    if (target.closest?.('input:not([type=checkbox]), select, .cm-editor')) return; // they have keys of their own
    if (isCharacterOff(event.key)) return;
    const isInTable = this.table.contains(target);
    const actions = {
      ArrowLeft: () => this.choose(this.number - 1),
      ArrowRight: () => this.choose(this.number + 1),
      Home: () => this.choose(1),
      End: () => this.choose(this.run.size),
      ...(isInTable ? { ArrowUp: () => this.choose(this.number - 1), ArrowDown: () => this.choose(this.number + 1) } : {}),
      p: () => this.stepIn(this.run.problems, -1),
      n: () => this.stepIn(this.run.problems, 1),
      '[': () => this.show(Math.max(0, this.place - 1)),
      ']': () => this.show(Math.min(this.runs.length - 1, this.place + 1)),
      '/': () => this.openSearch(),
      '+': () => this.timeline.zoomBy(1.6),
      '=': () => this.timeline.zoomBy(1.6),
      '-': () => this.timeline.zoomBy(1 / 1.6),
      0: () => this.timeline.fit(),
      a: () => byId('all-links').click(),
      g: () => byId('wants-graph').click(),
      s: () => this.save(),
      '?': () => byId('help').showModal(),
    };
    if (!Object.hasOwn(actions, event.key)) return;
    event.preventDefault();
    actions[event.key]();
    if (isInTable && /^(Arrow|Home|End)/.test(event.key)) this.table.focus(this.number);
  }

  openSearch() {
    byId('more').setAttribute('aria-expanded', 'true'); // where there is little room
    byId('search').focus();
  }

  onSearchKey(event) {
    if (event.key === 'Enter' && this.found !== null) this.stepIn([...this.found], event.shiftKey ? -1 : 1);
    if (event.key !== 'Escape') return;
    byId('search').value = '';
    this.search();
    byId('plot').focus();
  }

  /** Shows a mission, at an event or at what is of interest first. */
  show(place, number = null) {
    const run = this.runs[place];
    const isNew = run !== this.run;
    this.run = run;
    this.place = place;
    if (isNew) this.fillRun(run);
    this.overview.choose(place);
    this.choose(number ?? run.firstOfInterest);
  }

  fillRun(run) {
    this.number = 0;
    this.finder = new Search(run);
    this.found = null;
    for (const id of ['search', 'outcome']) byId(id).value = '';
    byId('found').textContent = '';
    byId('title').textContent = run.data.script;
    byId('subtitle').textContent = `catalog ${run.data.catalog}`;
    byId('names').replaceChildren(...[...run.catalog.taskPlace.keys(), ...run.catalog.behaviors.keys()]
      .map((name) => Object.assign(document.createElement('option'), { value: name })));
    byId('continue').hidden = run.continuation === null;
    this.fillCounts();
    this.table.show(run);
    this.timeline.show(run, Math.min(1, run.size));
    byId('scale').value = this.timeline.view.scale;
  }

  /** What changes with further events, but for the picture and the table. */
  fillCounts() {
    const { run } = this;
    const { script, expectations, error } = run.data;
    document.title = `${run.hasFailed ? '\u00d7 ' : ''}${script} \u2013 cbc ${run.property === null ? 'solve' : 'verify'}`;
    byId('counts').textContent = `${quantity(run.size, 'event')}: ${run.counts().join(', ')}` +
      (expectations.passed + expectations.failed === 0 ? ''
        : ` \u00b7 expectations: ${expectations.passed} passed, ${expectations.failed} failed`);
    const alarms = [...(run.leftOut === 0 ? [] : [html('p', 'alarm', this.limit(run))]),
                    ...(run.isViolation ? [html('p', 'alarm', `violated property: ${run.property.statement}`)] : []),
                    ...expectations.failures.map((failure) => this.alarm(failure)),
                    ...(this.live?.refusalTexts() ?? []).map((text) => html('p', 'alarm', text)),
                    ...(error === undefined ? [] : [html('p', 'alarm', `the run ended early: ${error}`)])];
    byId('alarms').replaceChildren(...alarms);
    byId('alarms').hidden = alarms.length === 0;
    for (const id of ['problem-back', 'problem-next']) byId(id).disabled = run.problems.length === 0;
    this.slider.max = Math.max(1, run.size);
    for (const id of ['first', 'back', 'next', 'last', 'slider']) byId(id).disabled = run.size === 0;
  }

  /** Shows the run that goes on at the server. */
  follow(token) {
    this.live = new Live(this, this.run, token, {
      bar: byId('live'), state: byId('live-state'), note: byId('live-note'), newest: byId('newest'),
    }, this.address.read()?.index || null);
    this.fillCounts();
  }

  /** Adds events to the run that is shown, and what failed after these or after those that are there. */
  growRun(events, failures) {
    const { run, table, timeline } = this;
    for (const failure of failures) {
      run.noteFailure(failure);
      run.data.expectations.failures.push(failure);
      const number = run.numberOf(failure.index);
      if (number < 1 || number > run.size) continue;
      table.noteFailure(number);
      timeline.noteFailure(number);
      if (number === this.number) this.fillEvent();
    }
    if (events.length > 0) {
      run.append(events);
      table.grow();
      timeline.grow();
      byId('scale').value = timeline.view.scale;
      if (this.found !== null) this.search();
      byId('status').setAttribute('aria-live', 'off'); // only the number of events has changed
      if (this.number > 0) this.tellEvent();
    }
    this.fillCounts();
  }

  /** Shows another run in place of the one that is shown, with what they have in common. */
  replaceRun(run) {
    const index = this.run.indexOf(this.number);
    const [text, outcome] = ['search', 'outcome'].map((id) => byId(id).value);
    this.runs[this.place] = run;
    this.run = run;
    const before = this.timeline.view;
    this.fillRun(run);
    this.timeline.keepView(before);
    [byId('search').value, byId('outcome').value] = [text, outcome];
    this.search();
    this.choose(run.numberOf(index), true);
  }

  chooseNewest() {
    this.choose(this.run.size, true);
    this.address?.clear();
  }

  limit(run) {
    return `the page shows the first ${quantity(run.size, 'event')} of this run; ` +
      `${run.leftOut} more are left out, as they would make it too large`;
  }

  alarm(failure) {
    const line = failureElement(this.run, failure);
    const { index } = failure;
    const number = this.run.numberOf(index);
    if (number > 0 && number <= this.run.size) line.append(' after ', buttonElement(`event ${index}`, () => this.choose(number)));
    return line;
  }

  /** `isAutomatic`: nobody asked for it, so the address does not change, and nothing is announced. */
  choose(wanted, isAutomatic = false) {
    const { run } = this;
    const number = Math.min(run.size, Math.max(1, wanted));
    byId('status').setAttribute('aria-live', isAutomatic ? 'off' : 'polite');
    if (!isAutomatic) {
      this.address?.write(this.place, number === 0 ? 0 : run.indexOf(number));
      this.live?.onChoice(number);
    }
    if (run.size === 0) {
      this.tell('No events.');
      byId('detail-title').textContent = 'Event';
      for (const id of ['detail-body', 'state-body']) byId(id).replaceChildren();
      this.graph.show(run, 0);
      return;
    }
    if (number === this.number) return;
    this.number = number;
    this.fillEvent();
    // To scroll makes the browser lay out the page: once, after all texts are there.
    this.table.choose(number);
    byId('detail').scrollTop = 0;
    this.timeline.choose(number);
  }

  tellEvent() {
    const { run, number } = this;
    const event = run.event(number);
    const outcome = isAsked(event) ? ` \u00b7 ${event.outcome}` : '';
    const failed = run.isFailed(number) ? ' \u00b7 failed expectation' : '';
    // The end of the line is cut off where there is little room.
    const sign = run.isFailed(number) ? ' !' : isAsked(event) ? ` ${outcomeSigns[event.outcome]}` : '';
    this.tell(`Event ${run.indexOf(number)} of ${run.indexOf(run.size)}${sign} \u00b7 ${formatTime(event.time)} s \u00b7 ` +
      `${describeEvent(event, run.catalog)}${outcome}${failed}`);
    this.slider.value = number;
    this.slider.setAttribute('aria-valuetext', byId('status').textContent);
  }

  fillEvent() {
    const { run, number } = this;
    this.tellEvent();
    fillDetail({ title: byId('detail-title'), body: byId('detail-body') }, run, number, (other) => this.choose(other));
    fillState(byId('state-body'), run, number);
    this.graph.show(run, number);
  }

  tell(text) {
    byId('status').textContent = text;
    byId('status').title = text;
  }

  fillLegend() {
    this.legend.show(this.run, {
      hasFolds: this.timeline.hasFolds, hasMinimap: !byId('minimap').hidden, hasGraph: byId('wants-graph').checked,
    });
  }

  /** Chooses the next event of a list of numbers, or the previous one; at its end, the first again. */
  stepIn(numbers, step) {
    if (numbers.length === 0) return;
    const next = step > 0 ? numbers.find((number) => number > this.number) ?? numbers[0]
                          : numbers.findLast((number) => number < this.number) ?? numbers.at(-1);
    this.choose(next);
  }

  search() {
    const text = byId('search').value;
    this.found = this.finder.find(text, byId('outcome').value);
    byId('found').textContent = this.found === null ? '' : `${this.found.size} of ${this.run.size}`;
    this.table.filter(this.found);
    const wanted = text.trim().toLowerCase();
    this.timeline.setFilter(this.found, wanted === '' ? null : (name) => name.toLowerCase().includes(wanted));
  }

  hover(event, target) {
    const tip = byId('tip');
    tip.hidden = target === null;
    if (target === null) return;
    tip.replaceChildren(...tipContent(this.run, target));
    const { width, height } = tip.getBoundingClientRect();
    const x = event.clientX + 14 + width > innerWidth ? event.clientX - 14 - width : event.clientX + 14;
    const y = event.clientY + 16 + height > innerHeight ? event.clientY - 12 - height : event.clientY + 16;
    tip.style.left = `${Math.max(4, x)}px`;
    tip.style.top = `${Math.max(4, y)}px`;
  }

  /** The part of the timeline that is in view, as the text of an SVG file. */
  svgText() {
    return new XMLSerializer().serializeToString(this.timeline.toSvg());
  }

  save() {
    if (this.run.size === 0) return;
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([this.svgText()], { type: 'image/svg+xml' }));
    link.download = `${this.run.data.script.replace(/^.*\//, '').replace(/\.ya?ml$/, '')}.svg`;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
  }

  /** On paper the whole run is in the picture, and the table has all changes. */
  setUpPaper() {
    const pageWidth = 1030; // of A4, landscape, within its margins
    const pageHeight = 600;
    addEventListener('beforeprint', () => {
      if (this.run === undefined) return;
      const svg = this.timeline.wholeSvg(pageWidth, pageHeight);
      byId('paper').replaceChildren(svg);
      this.table.addPrintedChanges();
    });
    addEventListener('afterprint', () => {
      byId('paper').replaceChildren();
      this.table.removePrintedChanges();
    });
  }
}
