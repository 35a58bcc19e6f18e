// The timeline. Only what is in view is drawn, so that long runs stay quick.

const taskHeight = 21;
const behaviorHeight = 20;
const spanHeight = 14;
const axisHeight = 22;
const laneHeight = 20;
const tickHeight = 9;
const mostLanes = 6;
const padding = 18;
const endRoom = 34; // for what is still active at the end
const mostLinks = 300; // in view; more than these would hide the rest
const widest = 1_000_000; // of the whole, in pixels
const boldness = 1.12; // how much wider bold texts are than measured

const svgElement = (name, attributes = {}, text = undefined) => {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
};

const measure = (() => {
  const context = document.createElement('canvas').getContext('2d');
  const widths = new Map();
  return (text) => {
    if (!widths.has(text)) {
      context.font = `11px ${getComputedStyle(document.body).fontFamily}`;
      widths.set(text, context.measureText(text).width);
    }
    return widths.get(text);
  };
})();

/** The first of some texts that fits into a width, or null. */
const fitting = (texts, width) => texts.find((text) => measure(text) <= width) ?? null;

/** A distance of ticks, in seconds: 1, 2 or 5 times a power of ten, and at least `least`. */
function tickDistance(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((factor) => factor * power).find((distance) => distance >= least);
}

const glyphs = {
  good: 'M-2.6 0.2 L-0.7 2.2 L2.7 -2.1',
  bad: 'M-2.1 -2.1 L2.1 2.1 M2.1 -2.1 L-2.1 2.1',
  clock: 'M0 -2.8 V0.2 H2.2',
  change: 'M-2.8 0.8 C-1.6 -2.4 -0.6 -0.6 0 0 S1.6 2.4 2.8 -0.8',
};

/** A sign at the end of a span, by the cause of its finish. */
function glyphOf(cause) {
  if (cause === 'goal_achieved') return { shape: glyphs.good, look: 'good' };
  if (cause === 'situation_change') return { shape: glyphs.change, look: '' };
  if (cause === 'time_out') return { shape: glyphs.clock, look: 'bad' };
  return { shape: glyphs.bad, look: 'bad' };
}

class Picture {
  constructor(elements, onChoose, onHover) {
    Object.assign(this, elements); // labels, plot, extent, svg
    this.zoom = 1;
    this.scale = 'time';
    this.wantsAll = false;
    this.chosen = 1;
    this.isWaiting = false;
    this.plot.addEventListener('scroll', () => this.drawSoon());
    new ResizeObserver(() => this.layOut()).observe(this.plot);
    const targetOf = (event) => event.target.closest?.('[data-event], [data-span]') ?? null;
    this.svg.addEventListener('click', (event) => {
      const target = targetOf(event);
      const number = target === null ? this.nearest(event) : this.numberOf(target);
      if (number !== null) onChoose(number);
    });
    this.svg.addEventListener('mousemove', (event) => {
      const target = targetOf(event);
      if (target === null) return onHover(null);
      const span = target.dataset.span;
      onHover(event, span === undefined ? null : this.run.spans[span], this.numberOf(target));
    });
    this.svg.addEventListener('mouseleave', () => onHover(null));
  }

  numberOf(target) {
    return target.dataset.span === undefined ? Number(target.dataset.event)
                                             : this.run.spans[target.dataset.span].from;
  }

  show(run, chosen) {
    this.run = run;
    this.chosen = chosen;
    this.zoom = 1;
    const span = run.size === 0 ? 0 : run.event(run.size).time - run.event(1).time;
    this.scale = span > 0 ? 'time' : 'event';
    this.nextRejected = new Map(); // of each rejected event: the next one of the same task
    const last = new Map();
    for (const [place, event] of run.events.entries()) {
      if (event.outcome !== 'rejected') continue;
      if (last.has(event.name)) this.nextRejected.set(last.get(event.name), place + 1);
      last.set(event.name, place + 1);
    }
    this.setUpRows();
    this.layOut();
  }

  setUpRows() {
    this.rows = [];
    this.rowOf = new Map(); // by task, and by task and behavior
    let y = 0;
    const key = (...names) => JSON.stringify(names);
    this.rowOfVariable = new Map();
    for (const variable of this.run.catalog.variables.keys()) {
      this.rowOfVariable.set(variable, { variable, y, height: behaviorHeight });
      this.rows.push(this.rowOfVariable.get(variable));
      y += behaviorHeight;
    }
    if (y > 0) y += 5;
    for (const { task, behaviors } of this.run.rows(this.wantsAll)) {
      const row = { task, y, height: taskHeight };
      this.rowOf.set(key(task), row);
      this.rows.push(row);
      y += taskHeight;
      for (const behavior of behaviors) {
        const below = { task, behavior, y, height: behaviorHeight };
        this.rowOf.set(key(task, behavior), below);
        this.rows.push(below);
        y += behaviorHeight;
      }
      y += 3;
    }
    this.rowsHeight = y;
    this.row = (...names) => this.rowOf.get(key(...names));
    for (const row of this.rows) row.spans = [];
    for (const span of this.run.spans) this.row(span.task, span.behavior).spans.push(span);
  }

  /** Computes all places. `width` is that of the plot. */
  layOut(width = this.plot.clientWidth) {
    if (this.run === undefined || width === 0) return;
    this.viewWidth = width;
    this.width = Math.min(widest, Math.max(width, width * this.zoom));
    const { run } = this;
    const inner = this.width - padding - endRoom;
    const start = run.size > 0 ? run.event(1).time : 0;
    this.start = Math.min(0, start);
    this.duration = run.size > 0 ? Math.max(run.event(run.size).time - this.start, 1e-6) : 1;
    this.xOfTime = (time) => padding + ((time - this.start) / this.duration) * inner;
    this.xs = [padding];
    for (let number = 1; number <= run.size; ++number) {
      this.xs.push(this.scale === 'time' ? this.xOfTime(run.event(number).time)
                                         : padding + ((number - 0.5) / run.size) * inner);
    }
    this.endX = this.scale === 'time' ? this.xOfTime(this.start + this.duration) : padding + inner;
    this.placeMarks();
    this.top = axisHeight + this.lanes * laneHeight + (this.hasRejected ? laneHeight : 0) + tickHeight + 3;
    this.height = this.top + this.rowsHeight + 4;
    this.extent.style.width = `${this.width}px`;
    this.extent.style.height = `${this.height}px`;
    this.drawLabels();
    this.draw();
  }

  /** Events get marks with their numbers, beside or below each other where they fit. */
  placeMarks() {
    const right = [];
    this.hasRejected = this.run.events.some((event) => event.outcome === 'rejected');
    this.lanes = 1;
    let rejectedRight = -Infinity;
    this.marks = this.run.events.map((event, place) => {
      const number = place + 1;
      const suffix = { timeout: ' t', reactive: ' r', situation: ' s', fault: ' f' }[event.origin] ?? '';
      const sign = event.outcome === 'rejected' ? '\u00d7 ' : '';
      const text = `${sign}${number}${suffix}`;
      const width = Math.max(17, measure(text) + 9);
      const x = this.xs[number] - width / 2;
      const mark = { number, text, width, x, lane: null };
      if (event.outcome === 'rejected') {
        if (x > rejectedRight + 2) {
          mark.lane = 'rejected';
          rejectedRight = x + width;
        }
        return mark;
      }
      let lane = right.findIndex((edge) => x > edge + 2);
      if (lane === -1 && right.length < mostLanes) lane = right.length;
      if (lane !== -1) {
        mark.lane = lane;
        right[lane] = x + width;
        this.lanes = Math.max(this.lanes, lane + 1);
      }
      return mark;
    });
  }

  yOfLane(lane) {
    return axisHeight + (lane === 'rejected' ? this.lanes : lane) * laneHeight;
  }

  drawLabels() {
    const label = (text, height, look, title = text) => {
      const element = document.createElement('div');
      element.className = look;
      element.textContent = text;
      element.title = title;
      element.style.height = element.style.lineHeight = `${height}px`;
      return element;
    };
    const items = [
      label(this.scale === 'time' ? 'time [s]' : 'time [s], events evenly spaced', axisHeight, 'lane'),
      label('events', this.lanes * laneHeight, 'lane'),
    ];
    if (this.hasRejected) items.push(label('rejected', laneHeight, 'lane has-bad'));
    items.push(label('', tickHeight + 3, 'lane'));
    let y = 0;
    for (const row of this.rows) {
      const item = label(...this.labelOf(row));
      item.style.marginTop = `${row.y - y}px`;
      y = row.y + row.height;
      items.push(item);
    }
    this.labels.replaceChildren(...items);
  }

  /** Of a row: the text, its height, its look, its title. */
  labelOf({ variable, task, behavior, height }) {
    if (variable !== undefined) return [variable, height, 'variable', `situation variable ${variable}`];
    if (behavior !== undefined) return [behavior, height, 'behavior', `behavior ${behavior}`];
    return [task, height, 'task', `task ${task}`];
  }

  drawSoon() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.draw();
    });
  }

  draw() {
    if (this.run === undefined || this.xs === undefined) return;
    this.left = Math.min(this.plot.scrollLeft, this.width - this.viewWidth);
    this.right = this.left + this.viewWidth;
    const { svg, viewWidth, height } = this;
    svg.setAttribute('width', viewWidth);
    svg.setAttribute('height', height);
    this.ink = svgElement('g', { transform: `translate(${-this.left} 0)` });
    this.drawRows();
    this.drawOutages();
    this.drawAxis();
    this.drawEventLines();
    this.drawValues();
    this.drawWaiting();
    this.drawSpans();
    this.cursor = this.add('g', {});
    this.drawLinks();
    this.drawSigns();
    this.drawRejected();
    this.drawMarks();
    this.ring = this.add('g', {});
    this.drawChosen();
    svg.replaceChildren(this.definitions(), this.ink);
  }

  definitions() {
    const definitions = svgElement('defs');
    const pattern = (id, size, path, look, ground) => {
      const element = svgElement('pattern', { id, width: size, height: size, patternUnits: 'userSpaceOnUse' });
      if (ground) element.append(svgElement('rect', { width: size, height: size, class: ground }));
      element.append(svgElement('path', { d: path, class: look }));
      return element;
    };
    definitions.append(
      pattern('hatch', 6, 'M-1 7 L7 -1 M-1 1 L1 -1 M5 7 L7 5', 'hatch-stroke', 'hatch-ground'),
      pattern('off', 5, 'M-1 -1 L6 6 M-1 4 L1 6 M4 -1 L6 1', 'off-stroke'));
    return definitions;
  }

  add(name, attributes, text) {
    const element = svgElement(name, attributes, text);
    this.ink.append(element);
    return element;
  }

  isInView(from, to) {
    return to >= this.left - 40 && from <= this.right + 40;
  }

  drawRows() {
    for (const row of this.rows) {
      const y = this.top + row.y;
      if (row.task !== undefined && row.behavior === undefined) {
        this.add('rect', { x: this.left, y, width: this.viewWidth, height: row.height, class: 'task-band' });
      } else {
        const below = y + row.height;
        this.add('line', { x1: this.left, x2: this.right, y1: below, y2: below, class: 'row-line' });
      }
    }
  }

  drawOutages() {
    const rows = new Map();
    for (const row of this.rows) {
      if (row.behavior !== undefined) rows.set(row.behavior, [...(rows.get(row.behavior) ?? []), row]);
    }
    for (const outage of this.run.outages) {
      const x = this.xs[outage.from];
      const end = outage.to === null ? this.endX + endRoom - 8 : this.xs[outage.to];
      if (!this.isInView(x, end)) continue;
      for (const row of rows.get(outage.behavior) ?? []) {
        const y = this.top + row.y;
        this.add('rect', { x, y: y + 7, width: Math.max(1, end - x), height: 6, class: 'off' });
        const begin = Math.max(x, this.left) + 16;
        if (measure(outage.kind) + 12 < end - begin && !this.isBusy(row, begin, begin + measure(outage.kind))) {
          this.add('text', { x: begin, y: y + 14, class: 'off-text' }, outage.kind);
        }
      }
    }
  }

  /** The value of each situation variable over time. */
  drawValues() {
    const edges = new Map(); // of each variable: the right edge of what was drawn last
    for (const span of this.run.valueSpans) {
      const x = this.xs[span.from];
      const end = span.to === null ? this.endX + endRoom - 12 : this.xs[span.to];
      if (!this.isInView(x, end)) continue;
      if (end - x < 1 && x - (edges.get(span.variable) ?? -Infinity) < 1) continue;
      edges.set(span.variable, end);
      const row = this.rowOfVariable.get(span.variable);
      const y = this.top + row.y + (row.height - spanHeight) / 2;
      const from = Math.max(x, this.left - 50);
      const width = Math.max(Math.min(end, this.right + 50) - from, 1);
      const target = this.run.size > 0 ? { 'data-event': Math.max(span.from, 1) } : {};
      this.add('rect', { x: from, y, width, height: spanHeight, class: 'value', ...target });
      const begin = Math.max(x, this.left) + 6;
      const text = fitting([`${span.value}`], Math.min(end, this.right) - begin - 4);
      if (text !== null) this.add('text', { x: begin, y: y + 11, class: 'value-text' }, text);
    }
  }

  /** A line in the row of a reactive task, from the rejected start until the task runs or gives up. */
  drawWaiting() {
    for (const wait of this.run.waitings) {
      const x = this.xs[wait.from];
      const end = wait.to === null ? this.endX + endRoom - 12 : this.xs[wait.to];
      if (!this.isInView(x, end)) continue;
      const row = this.row(wait.task);
      const y = this.top + row.y + row.height - 2;
      this.add('line', { x1: x, x2: end, y1: y, y2: y, class: 'waiting' });
    }
  }

  isBusy(row, from, to) {
    return row.spans.some((span) => this.xs[span.from] <= to &&
      (span.to === null ? this.endX : this.xs[span.to]) >= from);
  }

  drawAxis() {
    const y = axisHeight - 7;
    if (this.scale === 'time') {
      const perPixel = this.duration / (this.width - padding - endRoom);
      const distance = tickDistance(perPixel * 80);
      const decimals = Math.max(0, -Math.floor(Math.log10(distance)));
      const first = Math.max(this.start, this.start + (this.left - padding) * perPixel);
      const last = Math.min(this.start + this.duration, this.start + (this.right - padding) * perPixel);
      for (let step = Math.ceil(first / distance - 1e-9); step * distance <= last + distance * 1e-9; ++step) {
        const x = this.xOfTime(step * distance);
        this.add('line', { x1: x, x2: x, y1: axisHeight - 4, y2: this.height, class: 'grid' });
        this.add('text', { x, y, 'text-anchor': 'middle', class: 'tick-text' }, (step * distance).toFixed(decimals));
      }
      return;
    }
    let free = -Infinity;
    for (let number = 1; number <= this.run.size; ++number) {
      const x = this.xs[number];
      const text = formatTime(this.run.event(number).time);
      const width = measure(text);
      if (x - width / 2 < free || !this.isInView(x, x)) continue;
      free = x + width / 2 + 8;
      this.add('text', { x, y, 'text-anchor': 'middle', class: 'tick-text' }, text);
    }
  }

  /** Faint lines at all events, where they are not too many. */
  drawEventLines() {
    const top = this.top - tickHeight - 1;
    const isClear = this.run.size * 4 < this.width;
    let drawn = -Infinity;
    let rejected = -Infinity;
    for (const mark of this.marks) {
      const x = this.xs[mark.number];
      if (!this.isInView(x, x)) continue;
      const { outcome } = this.run.event(mark.number);
      if (outcome === 'rejected') {
        if (x - rejected < 0.75) continue;
        const isClose = x - rejected < 12;
        rejected = x;
        if (!isClose) this.add('line', { x1: x, x2: x, y1: top, y2: this.height, class: 'rejected-line' });
      } else if (x - drawn >= 0.75) {
        drawn = x;
        if (isClear) this.add('line', { x1: x, x2: x, y1: top, y2: this.height, class: 'event-line' });
      } else {
        continue;
      }
      this.add('line', { x1: x, x2: x, y1: top, y2: top + tickHeight, class: `tick ${outcome}` });
    }
    this.add('line', { x1: this.endX, x2: this.endX, y1: top, y2: this.height, class: 'end-line' });
  }

  drawSpans() {
    const drawn = new Map(); // of each row: the right edge and the cause of what was drawn last
    this.run.spans.forEach((span, place) => {
      const x = this.xs[span.from];
      const end = span.to === null ? this.endX + endRoom - 12 : this.xs[span.to];
      if (!this.isInView(x, end)) return;
      const row = this.row(span.task, span.behavior);
      const last = drawn.get(row);
      const width = Math.max(end - x, 3);
      if (width < 4 && last?.cause === span.cause && x - last.edge < 0.5) return;
      drawn.set(row, { edge: x + width, cause: span.cause });
      const y = this.top + row.y + (row.height - spanHeight) / 2;
      const from = Math.max(x, this.left - 50);
      const to = Math.min(x + width, this.right + 50);
      const look = `span ${span.cause}`;
      // An arrow says that it goes on.
      const shape = span.to === null
        ? `M${from} ${y} H${to} l8 ${spanHeight / 2} l-8 ${spanHeight / 2} H${from} Z`
        : `M${from} ${y} H${to} v${spanHeight} H${from} Z`;
      this.add('path', { d: shape, class: look, 'data-span': place });
      this.drawSpanTexts(span, y, end);
    });
  }

  drawSpanTexts(span, y, end) {
    const parts = span.cause === 'required' ? span.requirers : [{ from: span.from }];
    parts.forEach(({ from, names }, place) => {
      const next = parts[place + 1];
      const limit = Math.min(next === undefined ? end : this.xs[next.from], this.right);
      const begin = Math.max(this.xs[from] + 14, this.left + 6);
      const text = fitting(this.spanTexts(span, names), limit - begin - 10);
      if (text !== null && (place === 0 || text !== 'required')) this.add('text', { x: begin, y: y + 11, class: `span-text ${span.cause}` }, text);
    });
  }

  /** From long to short; `requirers` of a required one. */
  spanTexts(span, requirers) {
    const again = span.isRestart ? 'restarted, ' : '';
    if (span.cause === 'requested') {
      return [`${again}requested, priority ${span.priority}`, `priority ${span.priority}`, `${span.priority}`];
    }
    if (span.cause === 'reactive') return ['reactive start, priority 0', 'reactive', '0'];
    const by = requirers.length > 0 ? [`required by ${requirers.join(', ')}`] : [];
    return [...by, 'required'];
  }

  /** Arrows from a behavior to the one that follows it. */
  drawLinks() {
    const links = this.run.links.filter((link) => this.isInView(this.xs[link.number], this.xs[link.number]));
    if (links.length > mostLinks) return;
    let previous = null;
    let shift = 0;
    for (const link of links) {
      const from = this.row(link.from.task, link.from.behavior);
      const to = this.row(link.to.task, link.to.behavior);
      if (from === undefined || to === undefined || from === to) continue;
      shift = previous === link.number ? shift + 4 : 8;
      previous = link.number;
      const x = this.xs[link.number];
      const elbow = x + shift;
      const y1 = this.top + from.y + from.height / 2;
      const down = to.y > from.y ? 1 : -1;
      const y2 = this.top + to.y + to.height / 2 - down * (spanHeight / 2);
      this.add('path', { d: `M${x} ${y1} H${elbow} V${y2 - down * 4}`, class: `link ${link.kind}` });
      this.add('path', { d: `M${elbow - 3.6} ${y2 - down * 6} h7.2 L${elbow} ${y2 + down} Z`, class: 'link-head' });
      this.add('circle', { cx: x, cy: y1, r: 2.4, class: 'link-foot' });
    }
  }

  sign(x, row, number, { shape, look }) {
    const group = this.add('g', {
      transform: `translate(${x} ${this.top + row.y + row.height / 2})`,
      class: `glyph ${look}`,
      'data-event': number,
    });
    group.append(svgElement('circle', { r: 5.6 }), svgElement('path', { d: shape }));
  }

  /** How behaviors finished, and which could not be activated. */
  drawSigns() {
    const isClear = this.run.size * 3 < this.width * 2;
    for (let number = 1; number <= this.run.size; ++number) {
      const x = this.xs[number];
      if (!this.isInView(x, x)) continue;
      const event = this.run.event(number);
      if (event.verb === 'finish' && event.outcome === 'accepted' && isClear) {
        for (const [task, behavior] of Object.entries(this.run.running(number - 1))) {
          if (behavior === event.name) this.sign(x, this.row(task, behavior), number, glyphOf(event.cause));
        }
      }
      for (const change of event.changes) {
        if (change.success) continue;
        for (const task of change.tasks) {
          const row = this.row(task, change.behavior);
          this.sign(x, row, number, { shape: glyphs.bad, look: 'bad' });
          const text = `failed to ${change.op}`;
          const end = x + 9 + measure(text) * boldness;
          if (end < this.width && !this.isBusy(row, x + 9, end)) {
            this.add('text', { x: x + 9, y: this.top + row.y + 14, class: 'bad-text' }, text);
          }
        }
      }
    }
  }

  /** A rejected event stands in the row of its task, too, with the reason. */
  drawRejected() {
    const free = new Map(); // of each row: the right edge of what stands there
    for (let number = 1; number <= this.run.size; ++number) {
      const event = this.run.event(number);
      const x = this.xs[number];
      if (event.outcome !== 'rejected' || !this.isInView(x - 600, x + 600)) continue;
      const row = this.row(event.name);
      const taken = (free.get(row) ?? -Infinity) + 6;
      if (row === undefined || x < taken) continue;
      this.sign(x, row, number, { shape: glyphs.bad, look: 'bad' });
      free.set(row, x + 6);
      const next = this.nextRejected.get(number);
      const limit = Math.min(this.width - 4, next === undefined ? Infinity : this.xs[next] - 10);
      const texts = this.rejectionTexts(event);
      const y = this.top + row.y + 14.5;
      const right = fitting(texts, (limit - x - 10) / boldness);
      const left = fitting(texts, (x - 14 - Math.max(taken, 0)) / boldness);
      if (right !== null && (left === null || texts.indexOf(right) <= texts.indexOf(left))) {
        this.add('text', { x: x + 10, y, class: 'bad-text' }, right);
        free.set(row, x + 10 + measure(right) * boldness);
      } else if (left !== null) {
        this.add('text', { x: x - 10, y, 'text-anchor': 'end', class: 'bad-text' }, left);
      }
    }
  }

  /** From long to short. */
  rejectionTexts(event) {
    const messages = event.conflict.map((reason) => reason.message);
    const outcome = this.run.beginsToWait(event.index) ? 'waits' : 'rejected';
    if (messages.length < 2) return [`${outcome}: ${messages[0] ?? 'no solution found'}`, outcome];
    const main = event.conflict.find((reason) => reason.kind === 'protected')?.message ?? messages[0];
    return [`${outcome}: ${messages.join('; ')}`, `${outcome}: ${main} (${messages.length} reasons together)`, outcome];
  }

  /** The event in words, between its mark and the next one beside it. */
  drawMarkText(mark, limit) {
    const event = this.run.event(mark.number);
    const begin = Math.max(mark.x + mark.width + 6, this.left + 4);
    const text = fitting([describeEvent(event, this.run.catalog), [event.verb, event.name ?? ''].join(' ')], Math.min(limit, this.width) - begin - 6);
    if (text === null) return;
    const y = this.yOfLane(mark.lane) + 13;
    this.add('text', { x: begin, y, class: `mark-text ${event.outcome}`, 'data-event': mark.number }, text);
  }

  drawMarks() {
    const next = new Map(); // of each lane: where the next mark begins
    for (const mark of [...this.marks].reverse()) {
      if (mark.lane === null) continue;
      const limit = next.get(mark.lane) ?? Infinity;
      next.set(mark.lane, mark.x);
      if (this.isInView(mark.x, limit)) this.drawMarkText(mark, limit);
    }
    for (const mark of this.marks) {
      if (mark.lane === null || !this.isInView(mark.x, mark.x + mark.width)) continue;
      const { outcome } = this.run.event(mark.number);
      const y = this.yOfLane(mark.lane) + 1;
      const group = this.add('g', { class: `mark ${outcome}`, 'data-event': mark.number });
      const box = { x: mark.x, y, width: mark.width, height: 16, rx: outcome === 'rejected' ? 2 : 8 };
      group.append(svgElement('rect', { ...box, class: 'pill' }),
                   svgElement('text', { x: mark.x + mark.width / 2, y: y + 12 }, mark.text));
    }
  }

  /** The line and the ring of the chosen event: all that changes from step to step. */
  drawChosen() {
    if (this.run.size === 0 || this.cursor === undefined) return;
    const x = this.xs[this.chosen];
    const mark = this.marks[this.chosen - 1];
    const y1 = mark.lane === null ? axisHeight : this.yOfLane(mark.lane) + 19;
    this.cursor.replaceChildren(svgElement('line', { x1: x, x2: x, y1, y2: this.height, class: 'cursor' }));
    this.ring.replaceChildren();
    if (mark.lane === null) return;
    this.ring.append(svgElement('rect', {
      x: mark.x - 2, y: this.yOfLane(mark.lane) - 1, width: mark.width + 4, height: 20, rx: 9, class: 'ring',
    }));
  }

  /** The event whose place is nearest to the pointer. */
  nearest(event) {
    if (this.run.size === 0) return null;
    const x = event.clientX - this.svg.getBoundingClientRect().left + this.left;
    let best = 1;
    for (let number = 2; number <= this.run.size; ++number) {
      if (Math.abs(this.xs[number] - x) < Math.abs(this.xs[best] - x)) best = number;
    }
    return best;
  }

  choose(number) {
    this.chosen = number;
    const x = this.xs?.[number];
    if (x === undefined) return;
    if (x < this.plot.scrollLeft + 30 || x > this.plot.scrollLeft + this.viewWidth - 30) {
      this.plot.scrollLeft = x - this.viewWidth / 2; // and that draws
    }
    this.drawChosen();
  }

  /** Zooms by a factor; the chosen event stays where it is. */
  zoomBy(factor) {
    if (this.run.size === 0) return;
    const seen = this.xs[this.chosen] - this.plot.scrollLeft;
    const place = seen >= 0 && seen <= this.viewWidth ? seen : this.viewWidth / 2;
    this.zoom = Math.min(widest / this.viewWidth, Math.max(1, this.zoom * factor));
    this.layOut();
    this.plot.scrollLeft = this.xs[this.chosen] - place;
    this.draw();
  }

  fit() {
    this.zoom = 1;
    this.layOut();
  }
}
