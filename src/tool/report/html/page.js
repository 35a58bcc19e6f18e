// Puts the parts of the page together: which run and which event are shown, keys, and paper.

const byId = (id) => document.getElementById(id);

class Page {
  constructor(runs) {
    this.runs = runs;
    this.body = byId('events').tBodies[0];
    this.picture = new Picture(
      { labels: byId('labels'), plot: byId('plot'), extent: byId('extent'), svg: byId('svg') },
      (number) => this.choose(number), (event, span, number) => this.hover(event, span, number));
    fillLegend(byId('legend'), runs);
    this.setUpRuns();
    this.setUpControls();
    this.setUpPaper();
    if (runs.length > 0) this.show(0);
  }

  setUpRuns() {
    const choice = byId('run');
    this.runs.forEach((run, place) => {
      const option = html('option', '', run.data.script + (this.hasFailed(run) ? ' (failed)' : ''));
      option.value = place;
      choice.append(option);
    });
    byId('run-choice').hidden = this.runs.length < 2;
    choice.addEventListener('change', () => this.show(Number(choice.value)));
  }

  hasFailed(run) {
    return run.data.expectations.failed > 0 || run.data.error !== undefined;
  }

  setUpControls() {
    const { picture } = this;
    const onClick = (id, action) => byId(id).addEventListener('click', action);
    this.slider = byId('slider');
    this.slider.addEventListener('input', () => this.choose(Number(this.slider.value)));
    onClick('first', () => this.choose(1));
    onClick('back', () => this.choose(this.number - 1));
    onClick('next', () => this.choose(this.number + 1));
    onClick('last', () => this.choose(this.run.size));
    onClick('zoom-in', () => picture.zoomBy(1.6));
    onClick('zoom-out', () => picture.zoomBy(1 / 1.6));
    onClick('fit', () => picture.fit());
    byId('scale').addEventListener('change', (event) => {
      picture.scale = event.target.value;
      picture.layOut();
      picture.choose(this.number);
    });
    byId('all-rows').addEventListener('change', (event) => {
      picture.wantsAll = event.target.checked;
      picture.setUpRows();
      picture.layOut();
    });
    this.body.addEventListener('click', (event) => {
      const row = event.target.closest('tr[data-event]');
      if (row !== null) this.choose(Number(row.dataset.event));
    });
    byId('plot').addEventListener('wheel', (event) => {
      if (!event.ctrlKey) return;
      event.preventDefault();
      picture.zoomBy(event.deltaY < 0 ? 1.25 : 0.8);
    }, { passive: false });
    document.addEventListener('keydown', (event) => this.onKey(event));
  }

  onKey(event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === 'Escape') this.hover(null);
    const { target } = event;
    if (target.closest?.('input, select')) return; // they have keys of their own
    const isInTable = this.body.contains(target);
    const steps = {
      ArrowLeft: this.number - 1, ArrowRight: this.number + 1, Home: 1, End: this.run?.size,
      ...(isInTable ? { ArrowUp: this.number - 1, ArrowDown: this.number + 1 } : {}),
    };
    if (steps[event.key] !== undefined) {
      event.preventDefault();
      this.choose(steps[event.key]);
      if (isInTable) this.body.rows[this.number - 1]?.querySelector('button').focus();
    } else if (byId('plot').contains(target)) {
      if (event.key === '+' || event.key === '=') this.picture.zoomBy(1.6);
      if (event.key === '-') this.picture.zoomBy(1 / 1.6);
      if (event.key === '0') this.picture.fit();
    }
  }

  show(place) {
    const run = this.runs[place];
    this.run = run;
    this.number = 0;
    const { script, catalog, expectations, error } = run.data;
    document.title = `${script} \u2013 cbc solve`;
    byId('title').textContent = script;
    byId('subtitle').textContent = `catalog ${catalog}`;
    const count = (outcome) => run.events.filter((event) => isAsked(event) && event.outcome === outcome).length;
    const [accepted, rejected] = [count('accepted'), count('rejected')];
    const others = run.size - accepted - rejected;
    byId('counts').textContent = `${run.size} events: ${accepted} accepted, ${rejected} rejected` +
      (others > 0 ? `, ${others} neither` : '') + ` \u00b7 expectations: ${expectations.passed} passed, ${expectations.failed} failed`;
    const alarms = [...expectations.failures.map((failure) => this.alarm(failure)),
                    ...(error === undefined ? [] : [html('p', 'alarm', `the run ended early: ${error}`)])];
    byId('alarms').replaceChildren(...alarms);
    byId('alarms').hidden = alarms.length === 0;
    this.slider.max = Math.max(1, run.size);
    fillTable(this.body, run);
    this.picture.show(run, Math.min(1, run.size));
    byId('scale').value = this.picture.scale;
    this.choose(1);
  }

  alarm(failure) {
    const line = failureElement(this.run, failure);
    if (failure.index > 0) {
      const button = html('button', '', `event ${failure.index}`);
      button.type = 'button';
      button.addEventListener('click', () => this.choose(failure.index));
      line.append(' after ', button);
    }
    return line;
  }

  choose(wanted) {
    const { run } = this;
    for (const id of ['first', 'back', 'next', 'last', 'slider']) byId(id).disabled = run.size === 0;
    if (run.size === 0) {
      byId('status').textContent = 'No events.';
      for (const id of ['detail-body', 'state-body', 'numbers']) byId(id).replaceChildren();
      return;
    }
    const number = Math.min(run.size, Math.max(1, wanted));
    if (number === this.number) return;
    this.mark(this.number, false);
    this.number = number;
    this.mark(number, true);
    const event = run.event(number);
    const outcome = isAsked(event) ? ` \u00b7 ${event.outcome}` : '';
    const text = `Event ${number} of ${run.size} \u00b7 ${formatTime(event.time)} s \u00b7 ${describeEvent(event, run.catalog)}${outcome}`;
    byId('status').textContent = text;
    this.slider.value = number;
    this.slider.setAttribute('aria-valuetext', text);
    fillDetail({ title: byId('detail-title'), body: byId('detail-body'), numbers: byId('numbers') }, run, number);
    fillState(byId('state-body'), run, number);
    this.picture.choose(number);
  }

  /** Shows in the table which event is chosen, without scrolling the page. */
  mark(number, isChosen) {
    const row = this.body.rows[number - 1];
    if (row === undefined) return;
    row.querySelector('button').tabIndex = isChosen ? 0 : -1;
    if (!isChosen) return row.removeAttribute('aria-current');
    row.setAttribute('aria-current', 'true');
    const view = byId('log-scroll');
    const head = this.body.offsetTop;
    if (row.offsetTop < view.scrollTop + head || row.offsetTop + row.offsetHeight > view.scrollTop + view.clientHeight) {
      view.scrollTop = row.offsetTop - head - view.clientHeight / 3;
    }
  }

  hover(event, span = null, number = null) {
    const tip = byId('tip');
    tip.hidden = event === null;
    if (event === null) return;
    tip.replaceChildren(...tipContent(this.run, span, number));
    const { width, height } = tip.getBoundingClientRect();
    const x = event.clientX + 14 + width > innerWidth ? event.clientX - 14 - width : event.clientX + 14;
    const y = event.clientY + 16 + height > innerHeight ? event.clientY - 12 - height : event.clientY + 16;
    tip.style.left = `${Math.max(4, x)}px`;
    tip.style.top = `${Math.max(4, y)}px`;
  }

  /** On paper the whole run is in the picture, and the table has all changes. */
  setUpPaper() {
    const pageWidth = 1030; // of A4, landscape, within its margins
    const pageHeight = 600;
    let zoom = 1;
    addEventListener('beforeprint', () => {
      const { picture } = this;
      if (picture.run === undefined) return;
      zoom = picture.zoom;
      picture.zoom = 1;
      picture.layOut(pageWidth);
      const shrink = Math.min(1, pageHeight / picture.height);
      picture.layOut(pageWidth / shrink - byId('labels').offsetWidth - 4);
      byId('picture').style.zoom = shrink;
      addPrintedChanges(this.body, this.run);
    });
    addEventListener('afterprint', () => {
      if (this.picture.run === undefined) return;
      byId('picture').style.zoom = '';
      this.picture.zoom = zoom;
      this.picture.layOut();
      removePrintedChanges(this.body);
    });
  }
}

new Page(readRuns(JSON.parse(byId('data').textContent)));
