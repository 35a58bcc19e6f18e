// All missions of the page: how many events each has, how many were rejected or failed, and a strip of its
// outcomes; or all properties, with their verdicts and what they state.

const stripWidth = 240;
const stripHeight = 12;

class Overview {
  /** `elements`: {section, summary, body}. `properties`: of the page, or null. */
  constructor(elements, runs, properties, onChoose) {
    Object.assign(this, elements);
    this.runs = runs;
    this.section.hidden = properties === null && runs.length < 2;
    this.section.open = innerWidth > 900 || runs.length === 0; // a phone has no room to spare
    if (this.section.hidden) return;
    if (properties === null) this.fillMissions();
    else this.fillProperties(properties);
    this.body.addEventListener('click', (event) => {
      const row = event.target.closest('tr[data-run]');
      if (row !== null) onChoose(Number(row.dataset.run));
    });
  }

  fillMissions() {
    const { runs } = this;
    const folder = commonFolder(runs.map((run) => run.data.script));
    this.body.replaceChildren(...runs.map((run, place) => {
      const cells = [html('td', '', nameButton(run.data.script, folder)), verdictCell(verdictOf(run), run.hasFailed)];
      return missionRow(run, place, [...cells, ...this.runCells(run)]);
    }));
    const failed = runs.filter((run) => run.hasFailed).length;
    this.summarize(`${runs.length} missions: ${failed > 0 ? failed : 'none'} failed`, failed > 0);
  }

  fillProperties(properties) {
    this.body.parentElement.tHead.rows[0].cells[0].textContent = 'property';
    const folder = properties.length === 0 ? '' : commonFolder(properties.map(({ title }) => title.replace(/:\d+: .*$/s, '')));
    this.body.replaceChildren(...properties.map(({ title, statement, result, description, run: place }) => {
      const run = this.runs[place];
      const name = html('td', '', run === undefined ? html('span', '', title.slice(folder.length)) : nameButton(title, folder));
      if (!title.endsWith(`: ${statement}`)) name.append(html('div', 'why', statement));
      const verdict = verdictCell(result, result === 'violated', result === 'undecided');
      verdict.append(' ', html('span', 'why', description.replace(result, '').replace(/^:? /, '')));
      if (run !== undefined) return missionRow(run, place, [name, verdict, ...this.runCells(run)]);
      verdict.colSpan = 5;
      return missionRow(null, null, [name, verdict]);
    }));
    const count = (wanted) => properties.filter(({ result }) => result === wanted).length;
    const counts = ['violated', 'undecided', 'proved'].map((result) => [count(result), result]).filter(([number]) => number > 0);
    const isBad = count('violated') + count('undecided') > 0;
    const sum = properties.length === 1 ? '1 property' : `${properties.length} properties`;
    this.summarize(properties.length === 0 ? 'No properties were asked for'
      : `${sum}: ${counts.map((pair) => pair.join(' ')).join(', ')}`, isBad);
  }

  summarize(text, isBad) {
    const { runs } = this;
    const rejected = runs.reduce((sum, run) => sum + rejectedOf(run), 0);
    const events = quantity(runs.reduce((sum, run) => sum + run.size, 0), 'event');
    this.summary.textContent = runs.length === 0 ? text : `${text} \u00b7 ${events}, ${rejected} rejected`;
    this.summary.className = isBad ? 'failed' : '';
  }

  /** The counts of a run, and its strip. */
  runCells(run) {
    const count = (value, unit, isBad) => {
      const cell = html('td', isBad && value > 0 ? 'number failed' : 'number', `${value}`);
      cell.dataset.unit = unit; // shown where there is no room for a head
      return cell;
    };
    return [count(run.size, 'events', false), count(rejectedOf(run), 'rejected', true),
            count(run.data.expectations.failed, 'failed', true), html('td', 'strip', outcomeStrip(run))];
  }

  choose(place) {
    if (this.section.hidden) return;
    for (const row of this.body.rows) row.removeAttribute('aria-current');
    const row = this.body.querySelector(`tr[data-run="${place}"]`);
    row.setAttribute('aria-current', 'true');
    const view = this.body.closest('.scroll');
    const head = this.body.offsetTop;
    if (row.offsetTop < view.scrollTop + head || row.offsetTop + row.offsetHeight > view.scrollTop + view.clientHeight) {
      view.scrollTop = row.offsetTop - head - view.clientHeight / 2;
    }
  }
}

/** How a mission ended. */
function verdictOf(run) {
  if (run.data.error !== undefined) return 'ended early';
  return run.data.expectations.failed > 0 ? 'failed' : 'passed';
}

const rejectedOf = (run) => run.events.filter((event) => event.outcome === 'rejected').length;

function verdictCell(verdict, isBad, isOpen = false) {
  const [look, sign] = isOpen ? ['open', '?'] : isBad ? ['rejected', '\u00d7'] : ['accepted', '\u2713'];
  return html('td', `outcome ${look}`, `${sign} ${verdict}`);
}

function nameButton(name, folder) {
  const button = buttonElement(name.slice(folder.length), () => {}); // the row takes the click
  button.title = name;
  return button;
}

/** `run`: what the row leads to, or null. */
function missionRow(run, place, cells) {
  const row = html('tr', run?.hasFailed ? 'is-failed' : '', ...cells);
  // A row is no row of a table to a screen reader where the style sheet lays it out by itself.
  row.setAttribute('role', 'row');
  for (const cell of row.cells) cell.setAttribute('role', 'cell');
  if (run !== null) row.dataset.run = place;
  return row;
}

/** The folder that all paths are in, with its slash. */
function commonFolder(paths) {
  let folder = paths[0].replace(/[^/]*$/, '');
  while (!paths.every((path) => path.startsWith(folder))) folder = folder.replace(/[^/]*\/$/, '');
  return folder;
}

const shapes = {
  unchanged: (x) => `M${x} 5h.8v2h-.8z`,
  accepted: (x) => `M${x} 3h.8v6h-.8z`,
  rejected: (x) => `M${x} 1h.8v10h-.8z`,
  failed: (x) => `M${x} 0h1v12h-1z`,
};

/** The outcomes in order, from left to right; of several in one place the worst. */
function outcomeStrip(run) {
  const kinds = ['unchanged', 'accepted', 'rejected', 'failed'];
  const columns = Math.min(run.size, stripWidth / 2);
  const width = Math.min(stripWidth, run.size * 8);
  const worst = new Array(columns).fill(0);
  for (let number = 1; number <= run.size; ++number) {
    const event = run.event(number);
    const kind = run.isFailed(number) ? 'failed' : isAsked(event) ? event.outcome : 'unchanged';
    const column = Math.floor((number - 1) / run.size * columns);
    worst[column] = Math.max(worst[column], kinds.indexOf(kind));
  }
  const strip = svgElement('svg', { width, height: stripHeight, viewBox: `0 0 ${columns || 1} ${stripHeight}`,
                                    preserveAspectRatio: 'none', 'aria-hidden': 'true' });
  for (const kind of kinds) { // one path for all of a kind
    const path = worst.map((one, x) => (kinds[one] === kind ? shapes[kind](x) : '')).join('');
    if (path !== '') strip.append(svgElement('path', { d: path, class: `strip-${kind}` }));
  }
  return strip;
}
