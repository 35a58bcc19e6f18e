// Proofs, by `cbc verify` in a worker of their own, so that the robot can be driven meanwhile.

class Prover {
  /** `elements`: {begin, end, limit, progress, list}. `onScript(text)`: opens a script that was found. */
  constructor(elements, { texts, onScript }) {
    Object.assign(this, elements);
    this.texts = texts;
    this.onScript = onScript;
    this.engine = null;
    this.begin.addEventListener('click', () => this.prove());
    this.end.addEventListener('click', () => this.stop());
  }

  stop() {
    this.engine?.close();
  }

  /** The catalog has changed. */
  age() {
    const isNew = this.list.childElementCount > 0 && this.engine === null && !this.list.classList.contains('is-old');
    if (isNew) this.list.prepend(html('p', 'hint', 'These results are about an earlier catalog.'));
    this.list.classList.toggle('is-old', this.list.childElementCount > 0);
  }

  async prove() {
    const { catalog, properties } = this.texts();
    const limit = Math.min(3600, Math.max(1, Math.round(Number(this.limit.value)) || 1));
    this.limit.value = limit;
    this.show(limit);
    this.list.classList.remove('is-old');
    try {
      this.tell(catalog, properties, await this.run(catalog, properties, limit));
    } catch (error) {
      this.list.replaceChildren(html('p', 'alarm', error instanceof Ended ? 'The proof was stopped.' : error.message));
    }
    clearInterval(this.timer);
    this.engine.close();
    this.engine = null;
    for (const element of [this.end, this.progress]) element.hidden = true;
    this.begin.disabled = false;
  }

  show(limit) {
    const started = performance.now();
    this.engine = new Engine();
    this.done = 'exploring states';
    this.begin.disabled = true;
    for (const element of [this.end, this.progress]) element.hidden = false;
    const tick = () => {
      const seconds = (performance.now() - started) / 1000;
      this.progress.value = Math.min(1, seconds / limit);
      this.list.replaceChildren(html('p', 'hint', `${this.done}: ${seconds.toFixed(0)} s of at most ${limit} s`));
    };
    tick();
    this.timer = setInterval(tick, 250);
  }

  run(catalog, properties, limit) {
    const limits = ['--time-limit', `${limit}`, '--max-memory', '1G'];
    const verify = (words, files) => this.engine.run(['verify', ...words, ...limits], files, (line) => {
      if (line !== '') this.done = line;
    });
    if (properties.trim() === '') return verify(['robot.yaml'], { 'robot.yaml': catalog });
    // A property file may name its catalog, as whatever it is called where it comes from.
    const found = /^catalog:[ \t]*(["']?)([^"'#\n]+?)\1[ \t]*(#.*)?$/m.exec(properties)?.[2].replace(/^.*\//, '');
    const named = ['robot.properties.yaml', '.', '..', ''].includes(found) ? 'robot.yaml' : found;
    const own = properties.replace(/^catalog:.*$/m, `catalog: ${JSON.stringify(named ?? '')}`);
    return verify(
      [...(named === undefined ? ['robot.yaml'] : []), 'robot.properties.yaml', '--format', 'json', '--scripts', 'scripts'],
      { [named ?? 'robot.yaml']: catalog, 'robot.properties.yaml': named === undefined ? properties : own });
  }

  tell(catalog, properties, { status, stdout, stderr, files }) {
    if (properties.trim() === '' || status > 1 || !stdout.startsWith('{')) {
      this.list.replaceChildren(...(stderr === '' ? [] : [html('pre', status > 1 ? 'alarm' : '', stderr)]),
                                html('pre', '', stdout));
      return;
    }
    const report = JSON.parse(showEscapes(stdout));
    const states = report.groups.reduce((sum, group) => sum + group.states, 0);
    const items = report.properties.map((property) => this.itemOf(property, files));
    this.list.replaceChildren(
      html('p', 'hint', `${quantity(states, 'state')} visited${report.groups.every((group) => group.complete) ? '' : ', not all'}`),
      html('ul', 'proofs', ...items));
  }

  itemOf({ name, kind, line, result, script }, files) {
    const look = { proved: 'accepted', violated: 'rejected' }[result] ?? 'open';
    const sign = { proved: '\u2713', violated: '\u00d7' }[result] ?? '?';
    const item = html('li', '', html('span', `outcome ${look}`, `${sign} ${result}`), ` ${name ?? kind} (line ${line}) `);
    const text = script === null ? undefined : files[script];
    if (text !== undefined) {
      item.append(buttonElement(result === 'violated' ? 'open counterexample' : 'open witness', () => this.onScript(text)));
    }
    return item;
  }
}
