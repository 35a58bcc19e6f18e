// Puts the parts of the simulator together: texts on the left, the robot, and the picture below.

const pauseOfTyping = 300; // milliseconds
const slowAnswer = 1000; // milliseconds, after which the work can be ended
const tickOfClock = 100; // milliseconds of a running clock

class Play {
  constructor() {
    this.engine = new Engine();
    this.simulation = new Simulation(this.engine, {
      onState: () => this.showState(), onText: () => this.recordSoon(),
      onNote: (text, isBad) => this.note(text, isBad),
      onFindings: (kind, findings) => this.showFindings(kind, findings),
      onCatalog: (catalog, requestable) => this.robot.build(catalog, requestable),
    });
    this.robot = new Robot({ onAsk: (entry) => this.ask(entry), onPreview: (entry) => this.preview(entry),
                             onWhy: (task) => this.explain(task).catch((error) => this.note(error.message, true)) });
    this.catalog = new TextEditor(byId('text-catalog'), 'Catalog', debounced((text) => this.openCatalog(text)));
    this.mission = new TextEditor(byId('text-mission'), 'Mission', debounced((text) => this.simulation.load(text)));
    this.properties = new TextEditor(byId('text-properties'), 'Properties', () => {});
    this.prover = new Prover(
      { begin: byId('prove'), end: byId('prove-end'), limit: byId('prove-limit'), progress: byId('prove-progress'), list: byId('proofs') },
      { texts: () => ({ catalog: this.catalog.text, properties: this.properties.text }), onScript: (text) => this.openMission(text) });
    const onNote = (text, isBad) => this.note(text, isBad);
    this.savers = {
      catalog: new FileSaver('catalog', this.catalog, { onNote, load: (text) => this.openCatalog(text) }),
      mission: new FileSaver('mission', this.mission, { onNote, load: (text) => this.simulation.load(text) }),
      properties: new FileSaver('properties', this.properties, { onNote, load: () => {} }),
    };
    this.clock = null;
    this.setUpBar();
    this.setUpTabs();
    this.setUpClock();
    this.setUpMission();
    this.watchWork();
    document.addEventListener('keydown', (event) => this.onKey(event));
    addEventListener('hashchange', () => this.start());
  }

  // Texts -----------------------------------------------------------------------------------------

  /** What the address or the page has, or else the first example: "#s=SESSION" or "#example=ID". */
  async start() {
    document.body.classList.toggle('is-embedded', new URLSearchParams(location.search).has('embed'));
    const address = new URLSearchParams(location.hash.slice(1));
    const shared = address.get('s');
    const [first] = examples.sessions;
    try {
      const saved = JSON.parse(partOf('saved-session'));
      if (shared !== null) return await this.openSession({ ...(await unpackSession(shared)), files: {} });
      if (saved !== null) return await this.openSession(checkSession(saved));
      if (address.has('example')) {
        return await this.openExample(address.get('example'), Number.parseInt(address.get('event') ?? '', 10));
      }
    } catch (error) {
      await this.openExample(first.id);
      this.note(error.message, true);
      return undefined;
    }
    await this.openExample(first.id);
    return this.welcome(first.tries);
  }

  /** `index`: of the event to go to; NaN: to the last one. */
  async openExample(id, index = NaN) {
    const found = examples.sessions.find((session) => session.id === id);
    if (found === undefined) throw new Error(`there is no example "${id}"`);
    const { texts } = examples;
    const textOf = (name) => (name === undefined ? '' : texts[name]);
    await this.openSession({ catalog: texts[found.catalog], name: found.catalog, mission: textOf(found.mission),
                             properties: textOf(found.properties), index: Number.isNaN(index) ? undefined : index });
  }

  /** `files`: where its texts come from, if that is known. */
  async openSession({ catalog, mission = '', properties = '', name = 'robot.yaml', index, files = {} }) {
    byId('welcome').hidden = true;
    this.stopClock();
    this.note('', false);
    this.simulation.catalogName = name;
    this.catalog.text = catalog;
    this.properties.text = properties;
    this.mission.text = mission;
    byId('proofs').replaceChildren();
    for (const [role, text] of Object.entries({ catalog, mission, properties })) this.savers[role].open(files[role], text);
    await this.simulation.open(catalog, mission === '' ? null : mission);
    if (index !== undefined && this.simulation.isOpen) await this.simulation.goTo(Math.min(index, this.simulation.page.run.size));
  }

  /** The robot has changed; what was done so far is done with the new one. */
  openCatalog(text) {
    const { simulation } = this;
    return simulation.do(async () => {
      const mission = simulation.isOpen && simulation.page.run.size > 0 ? await simulation.mission() : null;
      // What came of it is what is asked now.
      const events = mission === null ? null : withoutExpectations(mission);
      simulation.open(text, events, events === mission);
    });
  }

  openMission(text) {
    this.mission.text = text;
    this.chooseTab('mission');
    return this.simulation.load(text);
  }

  /** What was done, as a mission; the text is only written while it is in view. */
  recordSoon() {
    clearTimeout(this.recording);
    this.recording = setTimeout(() => this.record(), 150);
  }

  async record() {
    if (!byId('pane-mission').hidden && this.simulation.isOpen) {
      this.mission.text = await this.simulation.mission();
      this.showFindings('mission', []);
    }
  }

  showFindings(kind, findings) {
    const editor = kind === 'catalog' ? this.catalog : this.mission;
    editor.findings = findings;
    const list = byId(`findings-${kind}`);
    const shown = findings.slice(0, 50).map((finding) => {
      const sign = { error: '\u00d7', warning: '!', note: 'i' }[finding.severity];
      const button = buttonElement(`${sign} line ${finding.line}: ${finding.message}`, () => editor.show(finding.line));
      button.className = `finding ${finding.severity}`;
      return html('li', '', button);
    });
    const rest = findings.length - shown.length;
    if (rest > 0) shown.push(html('li', '', `and ${rest} more`));
    list.replaceChildren(...(shown.length === 0 ? [] : [html('ul', '', ...shown)]));
  }

  // The robot -------------------------------------------------------------------------------------

  ask(entry) {
    byId('preview').textContent = '';
    return this.simulation.apply(entry);
  }

  async preview(entry) {
    const line = byId('preview');
    this.previewed = entry;
    if (entry === null || !this.simulation.isOpen || this.engine.isBusy) {
      line.textContent = '';
      return;
    }
    try {
      const { move, error } = await this.simulation.whatIf(entry);
      if (this.previewed !== entry) return; // the pointer has gone on
      line.textContent = error ?? describeMove(move);
      line.className = error !== undefined || move.outcome === 'rejected' ? 'bad' : '';
    } catch {
      line.textContent = '';
    }
  }

  showState() {
    const { simulation } = this;
    const { run } = simulation.page;
    this.robot.show(run, simulation.index, simulation.due);
    byId('now').textContent = `${formatTime(simulation.due.now)} s`;
    byId('to-next').disabled = simulation.due.next === null;
    byId('to-next').textContent = simulation.due.next === null ? 'nothing due' : `next due (in ${inSeconds(simulation.due.next - simulation.due.now)})`;
    byId('undo').disabled = !simulation.canUndo;
    byId('redo').disabled = !simulation.canRedo;
    byId('restart').disabled = run.size === 0;
    const later = run.size - simulation.index;
    document.body.classList.toggle('is-past', later > 0);
    byId('later').textContent = later > 0 ? `In the past: what you do now takes the place of ${quantity(later, 'later event')}.` : '';
  }

  /** Why a task runs as it does, or does not. */
  async explain(task) {
    const event = await this.simulation.why(task);
    const { catalog } = this.simulation;
    const parts = [html('h2', '', `Why is ${task} as it is?`)];
    if (event === null) {
      parts.push(html('p', '', 'No event has asked for anything that bears on it.'));
    } else {
      parts.push(html('p', 'hint', `Decided by event ${event.index}, ${describeEvent(event, catalog)}: ${event.outcome ?? ''}`),
                 ...(event.why ?? []).flatMap((why) => whyElements(why, catalog)),
                 ...(event.conflict.length === 0 ? [] : [html('h3', '', 'Reasons: without any one of them it would be possible'),
                   html('ul', '', ...event.conflict.map(({ message }) => html('li', '', message)))]));
    }
    byId('why-body').replaceChildren(...parts);
    byId('why').showModal();
  }

  // The clock -------------------------------------------------------------------------------------

  setUpClock() {
    const on = (id, action) => byId(id).addEventListener('click', action);
    on('step', () => this.simulation.advance(this.simulation.due.now + 1));
    on('to-next', () => this.simulation.advance());
    on('run', () => (this.clock === null ? this.startClock() : this.stopClock()));
  }

  /** The clock of the robot follows that of the wall; the session hears of it when something falls due. */
  startClock() {
    if (!this.simulation.isOpen) return;
    byId('run').setAttribute('aria-pressed', 'true');
    byId('run').textContent = 'pause';
    let last = performance.now();
    this.clock = setInterval(() => {
      const { due } = this.simulation;
      const seconds = (performance.now() - last) / 1000;
      last = performance.now();
      if (this.engine.isBusy) return;
      this.clockTime = Math.max(this.clockTime ?? 0, due.now) + seconds;
      byId('now').textContent = `${this.clockTime.toFixed(1)} s`;
      this.robot.show(this.simulation.page.run, this.simulation.index, { ...due, now: this.clockTime });
      if (due.next !== null && this.clockTime >= due.next) this.simulation.advance(due.next);
    }, tickOfClock);
  }

  stopClock() {
    clearInterval(this.clock);
    this.clock = null;
    byId('run').setAttribute('aria-pressed', 'false');
    byId('run').textContent = 'run';
    const { clockTime, simulation } = this;
    this.clockTime = undefined;
    if (clockTime !== undefined && simulation.isOpen && clockTime > simulation.due.now) simulation.advance(clockTime);
  }

  // Controls --------------------------------------------------------------------------------------

  setUpBar() {
    const on = (id, action) => byId(id).addEventListener('click', () => Promise.resolve(action()).catch((error) => this.note(error.message, true)));
    const list = byId('examples');
    for (const { id, title } of examples.sessions) {
      list.append(Object.assign(document.createElement('option'), { value: id, textContent: title }));
    }
    list.addEventListener('change', () => {
      if (list.value !== '') this.openExample(list.value);
      list.value = '';
    });
    on('undo', () => this.undo());
    on('redo', () => this.redo());
    on('restart', () => this.simulation.open(this.catalog.text).then(() => this.recordSoon()));
    on('end-work', () => this.endWork());
    on('copy-link', async () => this.copy(await this.link(), 'The link is copied'));
    on('copy-frame', async () => {
      const address = (await this.link()).replace('#', '?embed#').replaceAll('&', '&amp;');
      return this.copy(`<iframe src="${address}" width="100%" height="720" title="cbc play"></iframe>`, 'The HTML is copied');
    });
    on('save-page', async () => {
      saveFile(await pageWith(await this.sessionNow()), `${this.simulation.catalogName.replace(/\.\w+$/, '')}.html`, 'text/html');
    });
  }

  async sessionNow() {
    const { mission, index } = await this.simulation.whole();
    return { catalog: this.catalog.text, name: this.simulation.catalogName, mission, properties: this.properties.text,
             ...(mission === '' ? {} : { index }) };
  }

  async link() {
    const packed = await packSession(await this.sessionNow());
    return `${location.href.replace(/[?#].*$/, '')}#s=${packed}`;
  }

  async copy(text, done) {
    try {
      await navigator.clipboard.writeText(text);
      this.note(`${done}.`, false);
    } catch {
      // A page from the disk may not write there.
      const area = html('textarea', '', text);
      document.body.append(area);
      area.select();
      const isCopied = document.execCommand('copy');
      area.remove();
      this.note(isCopied ? `${done}.` : 'The browser does not let this page copy.', !isCopied);
    }
  }

  undo() {
    return this.simulation.canUndo ? this.simulation.undo() : undefined;
  }

  redo() {
    return this.simulation.canRedo ? this.simulation.goTo(this.simulation.index + 1) : undefined;
  }

  setUpTabs() {
    const names = ['catalog', 'mission', 'properties'];
    for (const [place, name] of names.entries()) {
      const tab = byId(`tab-${name}`);
      tab.addEventListener('click', () => this.chooseTab(name));
      tab.addEventListener('keydown', ({ key }) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[key];
        if (step === undefined) return;
        const next = names[(place + step + names.length) % names.length];
        this.chooseTab(next);
        byId(`tab-${next}`).focus();
      });
    }
  }

  chooseTab(wanted) {
    for (const name of ['catalog', 'mission', 'properties']) {
      const tab = byId(`tab-${name}`);
      tab.setAttribute('aria-selected', `${name === wanted}`);
      tab.tabIndex = name === wanted ? 0 : -1;
      byId(`pane-${name}`).hidden = name !== wanted;
    }
    if (wanted === 'mission' && this.simulation.isOpen && this.simulation.page.run.size > 0) this.recordSoon();
  }

  setUpMission() {
    const file = byId('mission-file');
    byId('open-mission').addEventListener('click', () => file.click());
    file.addEventListener('change', async () => {
      if (file.files.length > 0) await this.openMission(await file.files[0].text());
      file.value = '';
    });
    byId('copy-mission').addEventListener('click', async () => this.copy(await this.missionText(), 'The mission is copied'));
    byId('save-mission').addEventListener('click', async () =>
      saveFile(await this.missionText(), `${this.simulation.catalogName.replace(/\.\w+$/, '')}.mission.yaml`));
  }

  /** With the name of its catalog, as a file has it. */
  async missionText() {
    const mission = await this.simulation.mission();
    return /^catalog:/m.test(mission) ? mission : `catalog: ${this.simulation.catalogName}\n${mission}`;
  }

  /** Whatever takes long can be ended. */
  watchWork() {
    let since = null;
    setInterval(() => {
      if (!this.engine.isBusy) since = null;
      else since ??= performance.now();
      byId('end-work').hidden = since === null || performance.now() - since < slowAnswer;
    }, 200);
  }

  async endWork() {
    this.engine.end();
    await this.simulation.work;
    const { page } = this.simulation;
    if (page !== null) await this.simulation.open(this.catalog.text);
    this.note('It was ended. The robot begins anew.', true);
  }

  note(text, isBad) {
    const note = byId('note');
    note.textContent = text;
    note.className = isBad ? 'bad' : '';
  }

  onKey(event) {
    const { target, key } = event;
    if (target.closest?.('input, select, textarea, [contenteditable]')) return;
    if ((event.ctrlKey || event.metaKey) && !event.altKey && ['z', 'y', 'Z'].includes(key)) {
      event.preventDefault();
      (key === 'z' ? this.undo() : this.redo());
      return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const buttons = { t: 'step', d: 'to-next', r: 'run' };
    if (Object.hasOwn(buttons, key)) byId(buttons[key]).click();
  }

  /** What a first visit may try. */
  welcome(tries) {
    const list = html('ol', '', ...tries.map(({ text, entries }) => {
      const item = html('li', '', `${text} `);
      item.append(buttonElement('show me', async () => {
        for (const entry of entries) await this.ask(entry);
      }));
      return item;
    }));
    byId('welcome').replaceChildren(html('strong', '', 'Things to try'), list,
                                    buttonElement('close', () => { byId('welcome').hidden = true; }));
    byId('welcome').hidden = false;
  }
}

/** A mission that only says what happens. Entries that expect are lines of their own, as they are written. */
const withoutExpectations = (mission) => mission.replace(/^- \{at: [\d.]+, expect: .*\}\n/gm, '');

function debounced(action) {
  let timer;
  return (text) => {
    clearTimeout(timer);
    timer = setTimeout(() => action(text), pauseOfTyping);
  };
}

const play = new Play();
play.start();
