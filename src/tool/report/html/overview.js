// All missions of the page, or what breaks or shows properties: how many events each has, how many were rejected or failed, and a strip of
// its outcomes.

const stripWidth = 240;
const stripHeight = 12;

class Overview {
  /** `elements`: {section, summary, body}. */
  constructor(elements, runs, onChoose) {
    Object.assign(this, elements);
    this.runs = runs;
    this.section.hidden = runs.length < 2;
    this.section.open = innerWidth > 900; // a phone has no room to spare
    if (this.section.hidden) return;
    this.folder = commonFolder(runs.map((run) => run.data.script));
    this.body.replaceChildren(...runs.map((run, place) => this.row(run, place)));
    const failed = runs.filter((run) => run.hasFailed).length;
    const rejected = runs.reduce((sum, run) => sum + run.events.filter((event) => event.outcome === 'rejected').length, 0);
    const areProperties = runs.every((run) => run.property !== null);
    const [what, bad] = areProperties ? ['properties', 'violated'] : ['missions', 'failed'];
    if (areProperties) this.body.parentElement.tHead.rows[0].cells[0].textContent = 'property';
    this.summary.textContent = `${runs.length} ${what}: ` + (failed > 0 ? `${failed} ${bad}` : `none ${bad}`) +
      ` \u00b7 ${quantity(runs.reduce((sum, run) => sum + run.size, 0), 'event')}, ${rejected} rejected`;
    this.summary.className = failed > 0 ? 'failed' : '';
    this.body.addEventListener('click', (event) => {
      const row = event.target.closest('tr[data-run]');
      if (row !== null) onChoose(Number(row.dataset.run));
    });
  }

  row(run, place) {
    const rejected = run.events.filter((event) => event.outcome === 'rejected').length;
    const { failed } = run.data.expectations;
    const button = buttonElement(run.data.script.slice(this.folder.length), () => {}); // the row takes the click
    button.title = run.data.script;
    const count = (value, unit, isBad) => {
      const cell = html('td', isBad && value > 0 ? 'number failed' : 'number', `${value}`);
      cell.dataset.unit = unit; // shown where there is no room for a head
      return cell;
    };
    const row = html('tr', run.hasFailed ? 'is-failed' : '',
      html('td', '', button),
      html('td', `outcome ${run.hasFailed ? 'rejected' : 'accepted'}`, `${run.hasFailed ? '\u00d7' : '\u2713'} ${verdictOf(run)}`),
      count(run.size, 'events', false),
      count(rejected, 'rejected', true),
      count(failed, 'failed', true),
      html('td', 'strip', outcomeStrip(run)));
    // A row is no row of a table to a screen reader where the style sheet lays it out by itself.
    row.setAttribute('role', 'row');
    for (const cell of row.cells) cell.setAttribute('role', 'cell');
    row.dataset.run = place;
    return row;
  }

  choose(place) {
    if (this.section.hidden) return;
    for (const row of this.body.rows) {
      if (Number(row.dataset.run) === place) row.setAttribute('aria-current', 'true');
      else row.removeAttribute('aria-current');
    }
    const row = this.body.rows[place];
    const view = this.body.closest('.scroll');
    const head = this.body.offsetTop;
    if (row.offsetTop < view.scrollTop + head || row.offsetTop + row.offsetHeight > view.scrollTop + view.clientHeight) {
      view.scrollTop = row.offsetTop - head - view.clientHeight / 2;
    }
  }
}

/** How a mission ended, or what it shows of a property. */
function verdictOf(run) {
  if (run.data.error !== undefined) return 'ended early';
  if (run.property !== null) return run.isViolation ? 'violated' : `${run.property.result} (witness)`;
  return run.data.expectations.failed > 0 ? 'failed' : 'passed';
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
