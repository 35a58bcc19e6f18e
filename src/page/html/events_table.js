// The table of events.

const chunkSize = 50; // rows that the browser lays out together
const mostFrames = 12; // in which the chosen row may move

/** A row for each event, in chunks. What happened is written into a chunk when it comes near the part in
 * view. */
class EventsTable {
  constructor(table, view, onChoose) {
    this.table = table;
    this.view = view;
    this.observer = new IntersectionObserver((entries) => {
      for (const entry of entries) if (entry.isIntersecting) this.fill(entry.target);
    }, { root: view, rootMargin: '400px' });
    table.addEventListener('click', (event) => {
      const row = event.target.closest('tr[data-event]');
      if (row !== null) onChoose(Number(row.dataset.event));
    });
    table.addEventListener('mouseover', (event) => this.showCutText(event.target.closest('.story')));
  }

  /** What is cut off is shown at the pointer. */
  showCutText(story) {
    if (story !== null && story.scrollHeight > story.clientHeight + 1) story.title = story.innerText;
  }

  show(run) {
    this.run = run;
    this.chosen = 0;
    this.rows = [];
    this.observer.disconnect();
    for (const body of [...this.table.tBodies]) body.remove();
    this.unfilled = new Set();
    this.grow();
  }

  /** Adds the rows of further events. */
  grow() {
    this.fitColumns();
    while (this.rows.length < this.run.size) {
      let body = this.table.tBodies[this.table.tBodies.length - 1];
      if (body === undefined || body.rows.length >= chunkSize) body = this.makeBody();
      const row = this.makeRow(this.rows.length + 1);
      this.rows.push(row);
      body.append(row);
      if (!this.unfilled.has(body)) this.fillRow(row);
    }
  }

  /** An expectation after an event failed. */
  noteFailure(number) {
    const old = this.rows[number - 1];
    const row = this.makeRow(number);
    this.rows[number - 1] = row;
    old.replaceWith(row);
    if (!this.unfilled.has(row.parentElement)) this.fillRow(row);
    if (this.chosen === number) this.mark(number, true);
  }

  /** Gives numbers and times the room that the last ones need, which are the longest. */
  fitColumns() {
    const { run, table } = this;
    const time = run.size === 0 ? '' : formatTime(run.timeAt(run.size));
    const widthOf = (text, least) => `${Math.max(least, 1.4 + 0.65 * text.length)}em`;
    table.style.setProperty('--number-width', widthOf(`${run.indexOf(run.size)}`, 3.8));
    table.style.setProperty('--time-width', widthOf(time, 6.6));
  }

  makeBody() {
    const body = html('tbody');
    body.setAttribute('role', 'rowgroup');
    this.unfilled.add(body);
    this.table.append(body);
    this.observer.observe(body);
    return body;
  }

  makeRow(number) {
    const event = this.run.event(number);
    const index = this.run.indexOf(number);
    const button = html('button', '', `${index}`);
    button.type = 'button';
    button.tabIndex = -1;
    button.setAttribute('aria-label', `Event ${index}`);
    const look = this.run.isFailed(number) ? 'is-failed' : this.run.isRejected(number) ? 'rejected' : '';
    const row = html('tr', look,
      html('td', '', button),
      html('td', '', formatTime(event.time)),
      html('td', '', nameEvent(event, this.run.catalog)),
      html('td', '', outcomeElement(event)),
      html('td', '', html('div', 'story')));
    row.dataset.event = number;
    // A row is no row of a table to a screen reader where the style sheet lays it out by itself.
    row.setAttribute('role', 'row');
    for (const cell of row.cells) cell.setAttribute('role', 'cell');
    return row;
  }

  fill(body) {
    if (!this.unfilled.delete(body)) return;
    this.observer.unobserve(body);
    for (const row of body.rows) this.fillRow(row);
  }

  fillRow(row) {
    const number = Number(row.dataset.event);
    row.cells[2].replaceChildren(breakable(row.cells[2].textContent));
    row.querySelector('.story').append(...reasonElements(this.run.event(number)), ...sentenceElements(this.run, number));
  }

  fillAll() {
    for (const body of this.unfilled) this.fill(body);
  }

  contains(element) {
    return element.closest?.('#events tbody') !== null && this.table.contains(element);
  }

  focus(number) {
    this.rows[number - 1]?.querySelector('button').focus();
  }

  /** Shows which event is chosen, and scrolls the table to it, not the page. */
  choose(number) {
    this.mark(this.chosen, false);
    this.chosen = number;
    this.mark(number, true);
  }

  mark(number, isChosen) {
    const row = this.rows[number - 1];
    if (row === undefined) return;
    row.querySelector('button').tabIndex = isChosen ? 0 : -1;
    if (!isChosen) return row.removeAttribute('aria-current');
    row.setAttribute('aria-current', 'true');
    this.fill(row.parentElement);
    this.scrollTo(row, mostFrames);
  }

  /** Chunks that come into view get their real height, which may move the row out of view again. */
  scrollTo(row, left) {
    const { view } = this;
    if (getComputedStyle(view).overflowY === 'visible' || this.rows[this.chosen - 1] !== row) return;
    const [outer, inner] = [view.getBoundingClientRect(), row.getBoundingClientRect()];
    const head = this.table.tHead.offsetHeight;
    if (inner.top < outer.top + head || inner.bottom > outer.bottom) {
      const room = Math.max(0, view.clientHeight - head - inner.height);
      view.scrollTop += inner.top - outer.top - head - Math.min(room, view.clientHeight / 3);
    }
    if (left > 0) requestAnimationFrame(() => this.scrollTo(row, left - 1));
  }

  /** Hides the events that a search has not found; null shows all. */
  filter(found) {
    for (const row of this.rows) row.hidden = found !== null && !found.has(Number(row.dataset.event));
    for (const body of this.table.tBodies) body.hidden = [...body.rows].every((row) => row.hidden);
  }

  /** All changes of all events, and the explanations that are there, for paper. */
  addPrintedChanges() {
    this.fillAll();
    for (const row of this.rows) {
      const number = Number(row.dataset.event);
      const { changes } = this.run.event(number);
      const parts = explanationElements(this.run, number, () => {});
      if (changes.length > 0) {
        parts.push(html('table', '', html('tbody', '', ...changes.map((change) => changeRow(this.run, number, change)))));
      }
      if (parts.length > 0) row.lastElementChild.append(html('div', 'for-print', ...parts));
    }
  }

  removePrintedChanges() {
    for (const element of this.table.querySelectorAll('.for-print')) element.remove();
  }
}
