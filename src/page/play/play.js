// Puts the parts of the simulator together: texts on the left, the robot, and the picture below.

const pauseOfTyping = 300; // milliseconds
const slowAnswer = 1000; // milliseconds, after which the work can be ended
const roles = ['catalog', 'mission', 'properties']; // of the texts

const fileName = (path) => path.replace(/^.*\//, '');

class Play {
  constructor() {
    this.engine = new Engine();
    this.simulation = new Simulation(this.engine, {
      onState: () => this.showState(), onText: () => this.recordSoon(), onEvent: () => this.noteEvent(),
      onNote: (text, isBad) => this.note(text, isBad),
      onFindings: (kind, findings) => this.showFindings(kind, findings),
      onCatalog: (catalog, requestable) => {
        this.robot.build(catalog, requestable);
        this.simulation.checkProperties(this.properties.text);
      },
      onLeave: () => this.clock.halt(),
    });
    this.robot = new Robot({ onAsk: (entry) => this.ask(entry), onPreview: (entry) => this.preview(entry),
                             onWhy: (task) => this.explain(task).catch((error) => this.note(error.message, true)) });
    this.unsaved = new Set(); // texts that somebody has edited
    this.savers = {};
    this.setUpText('catalog', 'Catalog', (text) => this.openCatalog(text));
    this.setUpText('mission', 'Mission', (text) => this.loadMission(text));
    this.setUpText('properties', 'Properties', (text) => this.simulation.checkProperties(text));
    this.prover = new Prover(
      { begin: byId('prove'), end: byId('prove-end'), limit: byId('prove-limit'), progress: byId('prove-progress'), list: byId('proofs') },
      { texts: () => ({ catalog: this.catalog.text, properties: this.properties.text }), onScript: (text) => this.openMission(text) });
    this.clock = new Clock(this.simulation, this.engine, (time) => this.showTime(time));
    this.setUpBar();
    this.setUpTabs();
    this.setUpFiles();
    this.watchWork();
    document.addEventListener('keydown', (event) => this.onKey(event));
    addEventListener('hashchange', () => (this.mayReplace() ? this.start() : undefined));
    addEventListener('beforeunload', (event) => {
      if (this.unsaved.size > 0) event.preventDefault();
    });
  }

  // Texts -----------------------------------------------------------------------------------------

  /** `use(text)`: what is done with a text that was typed, or that is in its file by now. */
  setUpText(role, label, use) {
    const useSoon = debounced(use);
    this[role] = new TextEditor(byId(`text-${role}`), label, (text) => {
      this.markEdited(role);
      useSoon(text);
    });
    this.savers[role] = new FileSaver(role, this[role], {
      load: use, onNote: (text, isBad) => this.note(text, isBad), onSaved: () => this.markSaved(role),
    });
  }

  /** What the address or the page has, or else the first example: "#s=SESSION" or "#example=ID". */
  async start() {
    document.body.classList.toggle('is-embedded', new URLSearchParams(location.search).has('embed'));
    const address = new URLSearchParams(location.hash.slice(1));
    const shared = address.get('s');
    const [first] = examples.sessions;
    try {
      const saved = JSON.parse(partOf('saved-session'));
      if (shared !== null) return await this.openSession({ ...(await unpackSession(shared)), files: {} });
      if (saved !== null) return await this.openSession(checkSession(saved, 'this page'));
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
                             missionName: found.mission, properties: textOf(found.properties),
                             index: Number.isNaN(index) ? undefined : index });
  }

  /** `files`: where its texts come from, if that is known. */
  async openSession({ catalog, mission = '', properties = '', name = 'robot.yaml', missionName, index, files = {} }) {
    byId('welcome').hidden = true;
    this.clock.halt();
    this.prover.stop();
    this.hasDraft = false;
    this.markSaved();
    this.note('', false);
    this.simulation.names = {
      catalog: files.catalog?.name ?? name,
      mission: files.mission?.name ?? missionName ?? name.replace(/\.\w+$/, '.mission.yaml'),
    };
    this.catalog.text = catalog;
    this.properties.text = properties;
    this.mission.text = mission;
    byId('proofs').replaceChildren();
    for (const [role, text] of Object.entries({ catalog, mission, properties })) this.savers[role].open(files[role], text);
    await this.simulation.open(catalog, mission);
    if (index !== undefined && this.simulation.isOpen) await this.simulation.goTo(index);
  }

  /** Whether something else may take the place of a text, or of all of them (`role` undefined), if it was edited. */
  mayReplace(role) {
    const isEdited = role === undefined ? this.unsaved.size > 0 : this.unsaved.has(role);
    return !isEdited ||
      confirm(`What you have edited is not saved: ${[...this.unsaved].join(', ')}. Open something else all the same?`);
  }

  openCatalog(text) {
    this.prover.age();
    return this.simulation.change(text);
  }

  openMission(text, name = this.simulation.names.mission) {
    if (!this.mayReplace('mission')) return undefined;
    this.markSaved('mission');
    this.simulation.names.mission = name;
    this.mission.text = text;
    this.chooseTab('mission');
    return this.loadMission(text);
  }

  async loadMission(text) {
    this.clock.halt();
    this.hasDraft = !await this.simulation.load(text);
    if (this.simulation.isOpen) this.showState();
  }

  markEdited(role) {
    this.unsaved.add(role);
    this.showEdited();
  }

  /** `role`: undefined for all of them. */
  markSaved(role) {
    if (role === undefined) this.unsaved.clear();
    else this.unsaved.delete(role);
    this.showEdited();
  }

  showEdited() {
    for (const role of roles) byId(`edited-${role}`).hidden = !this.unsaved.has(role);
  }

  /** Something was done, of which the file of the mission does not know. */
  noteEvent() {
    if (this.savers.mission.file !== undefined) this.markEdited('mission');
  }

  /** What was done, as a mission; the text is only written while it is in view, and nobody writes there. */
  recordSoon() {
    clearTimeout(this.recording);
    this.recording = setTimeout(() => this.record(), 150);
  }

  async record() {
    const isWanted = () => !byId('pane-mission').hidden && !this.mission.hasFocus && !this.hasDraft;
    if (!isWanted() || this.simulation.lost !== null) return;
    const { mission } = await this.simulation.whole();
    if (isWanted()) this.mission.write(mission);
  }

  showFindings(kind, findings) {
    const editor = this[kind];
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
    return this.simulation.apply(entry, this.clock.time);
  }

  /** Says what an entry would do, while the pointer or the focus is on its control; null: on none. */
  preview(entry) {
    this.previewed = entry;
    if (entry === null) byId('preview').textContent = '';
    else this.previewNow();
  }

  async previewNow() {
    if (this.isPreviewing) return; // then it asks once more
    this.isPreviewing = true;
    for (let shown = null; this.previewed !== null && this.previewed !== shown;) {
      shown = this.previewed;
      const found = await this.simulation.whatIf(shown);
      if (this.previewed !== shown || found === undefined) continue;
      byId('preview').textContent = found.error ?? describeMove(found, this.simulation.performed.has(found.name));
      byId('preview').className = found.error !== undefined || found.outcome === 'rejected' ? 'bad' : '';
    }
    this.isPreviewing = false;
  }

  showTime(time) {
    const { page, place, due } = this.simulation;
    byId('now').textContent = `${time === place.time ? formatTime(time) : time.toFixed(1)} s`;
    byId('to-next').textContent = due.next === null ? 'nothing due' : `next due (in ${inSeconds(Math.max(0, due.next - time))})`;
    this.robot.show(page.run, place.index, { ...due, now: time });
  }

  showState() {
    const { simulation } = this;
    const { page, place } = simulation;
    this.showTime(this.clock.time === null ? place.time : Math.max(this.clock.time, place.time));
    byId('to-next').disabled = simulation.due.next === null;
    byId('undo').disabled = !simulation.canUndo;
    byId('redo').disabled = !simulation.canRedo;
    byId('restart').disabled = !simulation.canUndo;
    const later = page.run.size - place.index;
    const hints = [simulation.isStale ? 'The catalog has errors: this is the last robot that had none.' : '',
                   this.hasDraft ? 'The mission has errors: what you do is not recorded in its text.' : '',
                   later > 0 ? `In the past: what you do now replaces ${quantity(later, 'later event')}.` : ''];
    byId('later').textContent = hints.filter((hint) => hint !== '').join(' ');
    document.title = `${simulation.names.catalog} \u2013 cbc play`;
    if (this.previewed) this.previewAgain();
  }

  /** The state has changed under the pointer. */
  previewAgain() {
    this.previewed = { ...this.previewed };
    this.previewNow();
  }

  /** Why a task runs as it does, or does not. */
  async explain(task) {
    const event = await this.simulation.why(task);
    const { catalog } = this.simulation;
    const parts = [html('h2', '', `Why ${task} ${get(this.simulation.page.run.running(this.simulation.place.index), task) === undefined ? 'does not run' : 'runs'}`)];
    if (event === null) {
      parts.push(html('p', '', 'No event has asked for anything that bears on it.'));
    } else {
      parts.push(html('p', 'hint', `Decided by event ${event.index}, ${describeEvent(event, catalog)}${event.outcome === undefined ? '' : `: ${event.outcome}`}.`),
                 ...(event.why ?? []).flatMap((why) => whyElements(why, catalog)),
                 ...(event.conflict.length === 0 ? [] : [html('h3', '', 'Reasons: without any one of them it would be possible'),
                   html('ul', '', ...event.conflict.map(({ message }) => html('li', '', message)))]));
    }
    byId('why-body').replaceChildren(...parts);
    byId('why').showModal();
  }

  // Controls --------------------------------------------------------------------------------------

  setUpBar() {
    const on = (id, action) => byId(id).addEventListener('click', () => Promise.resolve(action()).catch((error) => this.note(error.message, true)));
    const list = byId('examples');
    for (const { id, title } of examples.sessions) {
      list.append(Object.assign(document.createElement('option'), { value: id, textContent: title }));
    }
    list.addEventListener('change', () => {
      if (list.value !== '' && this.mayReplace()) this.openExample(list.value);
      list.value = '';
    });
    byId('help').querySelector('dl').prepend(...[
      ['Ctrl+Z', 'undo'], ['Ctrl+Y', 'redo'], ['t', 'one second on'], ['d', 'to what is due next'], ['r', 'let the clock run, or pause it'],
    ].flatMap(([key, meaning]) => [html('dt', '', html('kbd', '', key)), html('dd', '', meaning)]));
    on('undo', () => this.undo());
    on('redo', () => this.redo());
    on('restart', () => this.restart());
    on('end-work', () => this.endWork());
    on('copy-link', async () => {
      const link = await this.link();
      this.markSaved();
      return this.copy(link, `The link is copied.${doubtOf(link)}`);
    });
    on('copy-frame', async () => {
      const address = (await this.link()).replace('#', '?embed#').replaceAll('&', '&amp;');
      return this.copy(`<iframe src="${address}" width="100%" height="720" title="cbc play"></iframe>`, `The HTML is copied.${doubtOf(address)}`);
    });
    on('save-page', async () => {
      this.markSaved();
      saveFile(await pageWith(await this.sessionNow()), `${this.stem}.html`, 'text/html');
    });
  }

  /** What files of this robot begin with. */
  get stem() {
    return fileName(this.simulation.names.catalog).replace(/\.\w+$/, '');
  }

  async sessionNow() {
    const { mission, index } = await this.simulation.whole();
    return { catalog: this.catalog.text, name: fileName(this.simulation.names.catalog), mission, properties: this.properties.text,
             ...(mission === '' ? {} : { index }) };
  }

  async link() {
    const packed = await packSession(await this.sessionNow());
    return `${location.href.replace(/[?#].*$/, '')}#s=${packed}`;
  }

  async copy(text, done) {
    try {
      await navigator.clipboard.writeText(text);
      this.note(done, false);
    } catch {
      // A page from the disk may not write there.
      const area = html('textarea', '', text);
      document.body.append(area);
      area.select();
      const isCopied = document.execCommand('copy');
      area.remove();
      this.note(isCopied ? done : 'The browser does not let this page copy.', !isCopied);
    }
  }

  undo() {
    this.clock.halt();
    return this.simulation.undo();
  }

  redo() {
    this.clock.halt();
    return this.simulation.redo();
  }

  /** To where nothing was done yet, from where one can come back until something else is done. */
  restart() {
    this.clock.halt();
    return this.simulation.goTo(0);
  }

  setUpTabs() {
    for (const [place, name] of roles.entries()) {
      const tab = byId(`tab-${name}`);
      tab.addEventListener('click', () => this.chooseTab(name));
      tab.addEventListener('keydown', ({ key }) => {
        const step = { ArrowRight: 1, ArrowLeft: -1 }[key];
        if (step === undefined) return;
        const next = roles[(place + step + roles.length) % roles.length];
        this.chooseTab(next);
        byId(`tab-${next}`).focus();
      });
    }
  }

  chooseTab(wanted) {
    for (const name of roles) {
      const tab = byId(`tab-${name}`);
      tab.setAttribute('aria-selected', `${name === wanted}`);
      tab.tabIndex = name === wanted ? 0 : -1;
      byId(`pane-${name}`).hidden = name !== wanted;
    }
    if (wanted === 'mission') this.recordSoon();
  }

  setUpFiles() {
    const setUp = (what, open, textOf, nameOf) => {
      const file = byId(`${what}-file`);
      byId(`open-${what}`).addEventListener('click', () => file.click());
      file.addEventListener('change', async () => {
        const [chosen] = file.files;
        if (chosen !== undefined) await open(await chosen.text(), chosen.name);
        file.value = '';
      });
      byId(`copy-${what}`).addEventListener('click', async () => this.copy(await textOf(), `Copied: ${what}.`));
      byId(`save-${what}`).addEventListener('click', async () => {
        this.markSaved(what);
        saveFile(await textOf(), fileName(nameOf()));
      });
    };
    setUp('catalog', (catalog, name) => (this.mayReplace() ? this.openSession({ catalog, name }) : undefined),
      () => this.catalog.text, () => this.simulation.names.catalog);
    setUp('mission', (text, name) => this.openMission(text, name), () => this.missionText(), () => this.simulation.names.mission);
    setUp('properties', (text) => {
      if (!this.mayReplace('properties')) return;
      this.properties.text = text;
      this.markSaved('properties');
      this.simulation.checkProperties(text);
    }, () => this.properties.text, () => `${this.stem}.properties.yaml`);
  }

  /** With the name of its catalog, as a file has it. */
  async missionText() {
    const { mission } = await this.simulation.whole();
    if (/^\s*[[{]/.test(mission)) return mission; // JSON, as it was loaded
    const line = `catalog: ${JSON.stringify(fileName(this.simulation.names.catalog))}`;
    return /^catalog:/m.test(mission) ? mission.replace(/^catalog:.*$/m, () => line) : `${line}\n${mission || 'events: []\n'}`;
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

  /** The last robot takes the place of what took too long, with all that was done. */
  async endWork() {
    this.clock.halt();
    this.engine.end();
    await this.simulation.work;
    await this.simulation.recover();
    const isEarlier = this.simulation.catalogText !== this.catalog.text;
    if (isEarlier) this.showFindings('catalog', []); // they are about the other text
    this.note(isEarlier ? 'Stopped. The robot is the last one that was ready.' : 'Stopped.', true);
  }

  note(text, isBad) {
    const note = byId('note');
    note.textContent = text;
    note.className = isBad ? 'bad' : '';
  }

  onKey(event) {
    const { target, key } = event;
    if (target.closest?.('input, select, textarea, .cm-editor') || document.querySelector('dialog[open]')) return;
    if ((event.ctrlKey || event.metaKey) && !event.altKey && ['z', 'y', 'Z'].includes(key)) {
      event.preventDefault();
      (key === 'z' ? this.undo() : this.redo());
      return;
    }
    if (event.ctrlKey || event.metaKey || event.altKey || isCharacterOff(key)) return;
    const buttons = { t: 'step', d: 'to-next', r: 'run' };
    if (Object.hasOwn(buttons, key)) byId(buttons[key]).click();
  }

  /** What a first visit may try. */
  welcome(tries) {
    const list = html('ol', '', ...tries.map(({ text, entries }) => {
      const item = html('li', '', `${text} `);
      item.append(buttonElement('show me', async () => {
        await this.restart();
        for (const entry of entries) await this.ask(entry);
      }));
      return item;
    }));
    byId('welcome').replaceChildren(html('strong', '', 'Things to try'), list,
                                    buttonElement('close', () => { byId('welcome').hidden = true; }));
    byId('welcome').hidden = false;
  }
}

function debounced(action) {
  let timer;
  return (text) => {
    clearTimeout(timer);
    timer = setTimeout(() => action(text), pauseOfTyping);
  };
}

const play = new Play();
play.start();
