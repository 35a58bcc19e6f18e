// Draws a scene of the timeline with an ink: the axis and the marks of events above, the rows below.
// Only what is in view is drawn, and of what is narrower than a pixel only as much as can be seen.

const axisHeight = 22;
const laneHeight = 20;
const tickHeight = 9;
const spanHeight = 14;
const mostLinks = 300; // in view; more than these would hide the rest
const signRadius = 6.5; // with its line
const boldness = 1.12; // how much wider bold texts are than measured

const glyphs = {
  good: 'M-2.6 0.2 L-0.7 2.2 L2.7 -2.1',
  bad: 'M-2.1 -2.1 L2.1 2.1 M2.1 -2.1 L-2.1 2.1',
  clock: 'M0 -2.8 V0.2 H2.2',
  fault: 'M0.8 -3.2 L-1.8 0.5 H1.6 L-0.8 3.2',
  change: 'M-2.8 0.8 C-1.6 -2.4 -0.6 -0.6 0 0 S1.6 2.4 2.8 -0.8',
};

/** A sign at the end of a span, by the cause of its finish: [shape, look]. */
function glyphOf(cause) {
  if (cause === 'goal_achieved') return [glyphs.good, '-good'];
  if (cause === 'situation_change') return [glyphs.change, ''];
  return [cause === 'time_out' ? glyphs.clock : glyphs.bad, '-bad'];
}

/** How the stretches in which a behavior cannot be activated look, by the kind of their outage. */
const outageLooks = { unavailable: 'unavailable', 'does not fit': 'misfit', faulty: 'faulty', 'not tried again': 'untried' };

function drawGlyph(ink, x, y, shape, look) {
  ink.circle(`glyph-ground${look}`, x, y, 5.6);
  ink.path(`glyph${look}`, shape, x, y);
}

function drawMark(ink, { x, width, text, look }, y) {
  const isFold = look.startsWith('fold');
  const radius = isFold ? 3 : look === 'rejected' || look === 'failed' ? 2 : 8;
  if (isFold) ink.rect(look, x + 2.5, y + 2.5, width, 14, radius);
  ink.rect(look, x, y, width, isFold ? 14 : 16, radius);
  ink.text(`${look}-text`, x + width / 2, y + (isFold ? 11 : 12), text, 'middle');
}

const crisp = (x) => Math.round(x) + 0.5;

class Painter {
  /** `scene`: {run, view, rows, marks, lanes, hasProblems, chosen, wantsLinks, filter, selection}. */
  constructor(scene, ink) {
    Object.assign(this, scene);
    this.ink = ink;
    this.targets = []; // what can be pointed at: {x, y, width, height, numbers | span}
  }

  static headHeight({ lanes, hasProblems }) {
    return axisHeight + (lanes + (hasProblems ? 1 : 0)) * laneHeight + tickHeight + 3;
  }

  /** Draws what is in an area whose rows are scrolled by `scroll` pixels. */
  paint(width, height, scroll) {
    this.width = width;
    this.height = height;
    this.head = Painter.headHeight(this);
    this.top = this.head - scroll;
    const { ink, head } = this;
    ink.rect('paper', 0, 0, width, height);
    this.drawAxis();
    ink.clip(0, head, width, height - head, () => this.drawBody());
    this.drawTicks();
    this.drawMarks();
    if (this.selection !== null) {
      const [from, to] = this.selection;
      ink.rect('selection', Math.min(from, to), axisHeight, Math.abs(to - from), height - axisHeight);
    }
  }

  drawBody() {
    this.drawRows();
    this.drawEventLines();
    this.drawOutages();
    this.drawValues();
    this.drawWaiting();
    this.drawSpans();
    this.drawCursor();
    this.drawLinks();
    this.drawSigns();
    this.drawRejected();
  }

  isRowInView(row) {
    const y = this.top + row.y;
    return y + row.height >= this.head && y <= this.height;
  }

  middleOf(row) {
    return this.top + row.y + row.height / 2;
  }

  addTarget(x, y, width, height, target) {
    this.targets.push({ x, y, width, height, ...target });
  }

  /** The first event in view, and the one after the last. */
  range() {
    const first = this.view.firstFrom(-40);
    return [first, this.view.firstFrom(this.width + 40)];
  }

  drawAxis() {
    for (const { x, text } of this.view.ticks()) {
      if (this.view.scale === 'time') this.ink.line('grid', crisp(x), axisHeight - 4, crisp(x), this.height);
      const half = measure(text) / 2 + 2;
      if (x >= half && x <= this.width - half) this.ink.text('tick-text', x, axisHeight - 7, text, 'middle');
    }
  }

  drawRows() {
    for (const row of this.rows.list) {
      if (!this.isRowInView(row)) continue;
      const y = this.top + row.y;
      if (Rows.kindOf(row) === 'task') this.ink.rect('band', 0, y, this.width, row.height);
      else this.ink.line('rule', 0, y + row.height - 0.5, this.width, y + row.height - 0.5);
    }
  }

  /** Faint lines at the events, where there is room between them. */
  drawEventLines() {
    const [first, end] = this.range();
    const x = crisp(this.view.endX);
    this.ink.line('end-line', x, this.head, x, this.height);
    if ((end - first) * 14 > this.width) return;
    for (let number = first; number < end; ++number) {
      if (this.run.isRejected(number)) continue;
      const at = crisp(this.view.xs[number]);
      this.ink.line('event-line', at, this.head, at, this.height);
    }
  }

  drawOutages() {
    const labels = new Map(); // of each row: the right edge of what was written last
    for (const outage of this.run.outages) {
      const x = this.view.xs[outage.from];
      const end = this.view.endOf(outage);
      if (!this.view.isInView(x, end)) continue;
      for (const row of this.rows.ofBehavior.get(outage.behavior) ?? []) {
        if (!this.isRowInView(row)) continue;
        const y = this.top + row.y;
        const from = Math.max(x, -10);
        this.ink.rect(outageLooks[outage.kind], from, y + 7, Math.max(1, Math.min(end, this.width + 10) - from), 6);
        const begin = Math.max(x + 16, 16, (labels.get(row) ?? 0) + 8);
        const width = measure(outage.kind, 'italic');
        if (begin + width + 12 > Math.min(end, this.width) || this.isBusy(row, begin, begin + width)) continue;
        this.ink.text('off-text', begin, y + 14, outage.kind);
        labels.set(row, begin + width);
      }
    }
  }

  /** The value of each situation variable over time. */
  drawValues() {
    const edges = new Map(); // of each variable: the right edge of what was drawn last
    for (const span of this.run.valueSpans) {
      const x = this.view.xs[span.from];
      const end = this.view.endOf(span);
      if (!this.view.isInView(x, end)) continue;
      if (end - x < 1 && x - (edges.get(span.variable) ?? -Infinity) < 1) continue;
      edges.set(span.variable, end);
      const row = this.rows.ofVariable(span.variable);
      const y = this.middleOf(row) - spanHeight / 2;
      const from = Math.max(x, -50);
      const width = Math.max(Math.min(end, this.width + 50) - from, 1);
      this.ink.rect('value', from, y, width, spanHeight);
      if (this.run.size > 0) this.addTarget(from, y, width, spanHeight, { numbers: [Math.max(span.from, 1)] });
      const begin = Math.max(x, 0) + 6;
      const text = fitting([`${span.value}`], Math.min(end, this.width) - begin - 4);
      if (text !== null) this.ink.text('value-text', begin, y + 11, text);
    }
  }

  /** A line in the row of a task that waits, until it runs or gives up. */
  drawWaiting() {
    for (const wait of this.run.waitings) {
      const row = this.rows.find(wait.task);
      const x = this.view.xs[wait.from];
      const end = this.view.endOf(wait);
      if (row === undefined || !this.view.isInView(x, end)) continue;
      const y = this.top + row.y + row.height - 2;
      this.ink.line(wait.kind, x, y, end, y);
    }
  }

  isBusy(row, from, to) {
    return row.spans.some((span) => this.view.xs[span.from] <= to && this.view.endOf(span) >= from);
  }

  drawSpans() {
    const drawn = new Map(); // of each row: the right edge of what was drawn last
    this.run.spans.forEach((span, place) => {
      const x = this.view.xs[span.from];
      const end = this.view.endOf(span);
      const row = this.rows.ofSpan[place];
      if (row === undefined || end < -40 || x > this.width + 40 || !this.isRowInView(row)) return;
      const edge = drawn.get(row) ?? -Infinity;
      const y = this.middleOf(row) - spanHeight / 2;
      if (end - x < 4) { // stretches too narrow to tell apart are drawn as one
        const from = Math.max(x, edge);
        if (end - edge < 0.5) return;
        const width = Math.max(end - from, x > edge ? 1.5 : 0.5);
        this.ink.rect(`${span.cause}-thin`, from, y, width, spanHeight);
        this.addTarget(from - 2, y, width + 4, spanHeight, { span });
        drawn.set(row, from + width);
        return;
      }
      drawn.set(row, end);
      this.drawSpan(span, x, end, y);
    });
  }

  drawSpan(span, x, end, y) {
    const from = Math.max(x, -50);
    const to = Math.min(end, this.width + 50);
    if (span.to === null) { // an arrow says that it goes on
      this.ink.path(span.cause, `M0 0 H${to - from} l8 ${spanHeight / 2} l-8 ${spanHeight / 2} H0 Z`, from, y);
    } else {
      this.ink.rect(span.cause, from, y, to - from, spanHeight);
    }
    this.addTarget(from, y, to - from + (span.to === null ? 8 : 0), spanHeight, { span });
    for (const fault of span.faults) {
      const begin = Math.max(this.view.xs[fault.from], from);
      const limit = Math.min(fault.to === null ? to : this.view.xs[fault.to], to);
      if (limit > begin) this.ink.rect('faulty-bar', begin, y + spanHeight - 4, limit - begin, 4);
    }
    this.drawSpanTexts(span, y, end);
  }

  drawSpanTexts(span, y, end) {
    const parts = span.cause === 'required' ? span.requirers : [{ from: span.from }];
    parts.forEach(({ from, names }, place) => {
      const next = parts[place + 1];
      const fault = span.faults.find((one) => one.from > from); // whose sign would hide the text
      const limit = Math.min(next === undefined ? end : this.view.xs[next.from], this.width,
                             fault === undefined ? Infinity : this.view.xs[fault.from] - 4);
      const begin = Math.max(this.view.xs[from] + (place === 0 && this.hasSignAt(span) ? 14 : 8), 6);
      if (limit - begin < 16) return;
      const text = fitting(this.spanTexts(span, names), limit - begin - 10);
      if (text !== null && (place === 0 || text !== 'required')) this.ink.text(`${span.cause}-text`, begin, y + 11, text);
    });
  }

  /** Whether a sign or an arrow stands at the begin of a span. */
  hasSignAt(span) {
    return this.run.linksOf[span.from].some((link) => link.to.task === span.task);
  }

  /** From long to short; `requirers` of a required one. */
  spanTexts(span, requirers) {
    const again = span.isRestart ? 'restarted, ' : '';
    if (span.cause === 'requested') {
      return [`${again}requested, priority ${span.priority}`, `priority ${span.priority}`, `${span.priority}`];
    }
    if (span.cause === 'reactive') return [`reactive start, priority ${span.priority}`, 'reactive', `${span.priority}`];
    const by = requirers.length > 0 ? [`required by ${requirers.join(', ')}`] : [];
    return [...by, 'required'];
  }

  drawCursor() {
    if (this.chosen === 0) return;
    const x = this.view.xs[this.chosen];
    this.ink.line('cursor', x, this.head, x, this.height);
  }

  /** Arrows from a behavior to the one that follows it: of the chosen event, or of all. They end on the
   * bar of the follower, however narrow it is. */
  drawLinks() {
    let links = this.run.linksOf[this.chosen];
    if (this.wantsLinks) {
      const inView = this.run.links.filter((link) => this.view.isInView(this.view.xs[link.number]));
      if (inView.length <= mostLinks) links = inView;
    }
    let previous = null;
    let shift = 0;
    for (const link of links) {
      const from = this.rows.find(link.from.task, link.from.behavior);
      const to = this.rows.find(link.to.task, link.to.behavior);
      if (from === undefined || to === undefined || from === to) continue;
      shift = previous === link.number ? shift + 4 : 6;
      previous = link.number;
      this.drawLink(link, from, to, shift);
    }
  }

  drawLink(link, from, to, shift) {
    const x = this.view.xs[link.number];
    const span = to.spans.find((one) => one.from === link.number);
    const width = span === undefined ? 0 : Math.max(1.5, this.view.endOf(span) - x);
    const elbow = Math.min(shift, width / 2);
    const begin = this.middleOf(from);
    const isDown = to.y > from.y;
    const end = this.middleOf(to) + (isDown ? -spanHeight / 2 : spanHeight / 2) - begin;
    const tip = isDown ? 1 : -1;
    this.ink.path(link.kind === 'way' ? 'way' : 'link', `M-2 0 H${elbow} V${end - tip * 3}`, x, begin);
    this.ink.path('link-end', `M${elbow - 3.6} ${end - tip * 5} h7.2 L${elbow} ${end + tip * 2} Z`, x, begin);
    this.ink.circle('link-end', x - 2, begin, 2.4);
  }

  /** At the edges it is moved in, so that all of it can be seen. */
  sign(at, row, number, [shape, look]) {
    const y = this.middleOf(row);
    const isNear = at >= 0 && at <= this.width;
    const x = isNear ? Math.min(Math.max(at, signRadius), this.width - signRadius) : at;
    drawGlyph(this.ink, x, y, shape, look);
    this.addTarget(x - 6, y - 6, 12, 12, { numbers: [number] });
  }

  /** How behaviors finished, and which could not be activated, where there is room for it. */
  drawSigns() {
    const edges = new Map(); // of each row: the right edge of the last sign
    const [first, end] = this.range();
    if ((end - first) * 5 > this.width) return;
    const signAt = (x, row, number, glyph) => {
      if (row === undefined || x < (edges.get(row) ?? -Infinity) || !this.isRowInView(row)) return false;
      edges.set(row, x + 14);
      this.sign(x, row, number, glyph);
      return true;
    };
    for (let number = first; number < end; ++number) {
      const event = this.run.event(number);
      const x = this.view.xs[number];
      if (event.verb === 'finish' && event.outcome === 'accepted') {
        for (const [task, behavior] of Object.entries(this.run.running(number - 1))) {
          if (behavior === event.name) signAt(x, this.rows.find(task, behavior), number, glyphOf(event.cause));
        }
      }
      if (event.verb === 'fault') {
        for (const [task, behavior] of Object.entries(event.running)) {
          if (behavior === event.name) signAt(x, this.rows.find(task, behavior), number, [glyphs.fault, '-bad']);
        }
      }
      for (const change of event.changes) {
        if (change.success) continue;
        for (const task of change.tasks) {
          const row = this.rows.find(task, change.behavior);
          if (!signAt(x, row, number, [glyphs.bad, '-bad'])) continue;
          const text = `failed to ${change.op}`;
          const right = x + 9 + measure(text) * boldness;
          if (right > this.width || this.isBusy(row, x + 9, right)) continue;
          this.ink.text('bad-text', x + 9, this.top + row.y + 14, text);
          edges.set(row, right);
        }
      }
    }
  }

  /** A rejected event stands in the row of its task, too: as a sign, with the reason where there is room,
   * and as a tick where there are too many. */
  drawRejected() {
    const last = new Map(); // of each row: the right edge of what stands there
    const numbers = this.run.problems.filter((number) =>
      this.run.isRejected(number) && this.view.isInView(this.view.xs[number]));
    const areMany = numbers.length * 25 > this.width;
    const followers = new Map(); // of each of them: the next one of the same row
    numbers.forEach((number) => followers.set(this.run.event(number).name, []));
    numbers.forEach((number) => followers.get(this.run.event(number).name).push(number));
    for (const number of numbers) {
      const event = this.run.event(number);
      const row = this.rows.find(event.name);
      const x = this.view.xs[number];
      if (row === undefined || !this.isRowInView(row)) continue;
      const taken = (last.get(row) ?? -Infinity) + 8;
      if (areMany) {
        if (x < taken - 6) continue;
        this.ink.line('rejected-tick', x, this.top + row.y + 6, x, this.top + row.y + row.height - 6);
        last.set(row, x);
        continue;
      }
      if (x < taken) continue;
      this.sign(x, row, number, [glyphs.bad, '-bad']);
      last.set(row, x + 6);
      const list = followers.get(event.name);
      const next = list[list.indexOf(number) + 1];
      const limit = Math.min(this.width - 4, next === undefined ? Infinity : this.view.xs[next] - 10);
      if (limit - x < 50 && x - taken < 50) continue;
      const texts = this.rejectionTexts(event);
      const y = this.top + row.y + 14.5;
      const right = fitting(texts, (limit - x - 10) / boldness);
      const left = fitting(texts, (x - 14 - Math.max(taken, 0)) / boldness);
      if (right !== null && (left === null || texts.indexOf(right) <= texts.indexOf(left))) {
        this.ink.text('bad-text', x + 10, y, right);
        last.set(row, x + 10 + measure(right) * boldness);
      } else if (left !== null) {
        this.ink.text('bad-text', x - 10, y, left, 'end');
      }
    }
  }

  /** From long to short. */
  rejectionTexts(event) {
    const messages = event.conflict.map((reason) => reason.message);
    const outcome = this.run.beginsToWait(this.run.numberOf(event.index)) ? 'waits' : 'rejected';
    if (messages.length < 2) return [`${outcome}: ${messages[0] ?? 'no solution found'}`];
    const main = event.conflict.find((reason) => reason.kind === 'protected')?.message ?? messages[0];
    return [`${outcome}: ${messages.join('; ')}`, `${outcome}: ${main} (${messages.length} reasons together)`];
  }

  /** A tick for each event, at the lower end of the head. */
  drawTicks() {
    const y = this.head - tickHeight - 1;
    const [first, end] = this.range();
    let [drawn, rejected] = [-Infinity, -Infinity];
    for (let number = first; number < end; ++number) {
      const x = this.view.xs[number];
      if (this.run.isRejected(number) || this.run.isFailed(number)) {
        if (x - rejected < 1) continue;
        rejected = x;
        this.ink.line('rejected-tick', x, y, x, y + tickHeight);
      } else if (x - drawn >= 0.75) {
        drawn = x;
        this.ink.line('tick', x, y, x, y + tickHeight);
      }
    }
    this.ink.line('edge', 0, this.head - 0.5, this.width, this.head - 0.5);
  }

  drawMarks() {
    const lanes = new Map();
    for (const mark of this.marks) {
      if (!lanes.has(mark.lane)) lanes.set(mark.lane, []);
      lanes.get(mark.lane).push(mark);
    }
    for (const lane of lanes.values()) {
      for (let place = lane.length - 1; place >= 0; --place) this.drawMarkOf(lane, place);
    }
  }

  drawMarkOf(lane, place) {
    const [before, after] = [lane[place - 1], lane[place + 1]];
    const limit = after === undefined ? Infinity : after.x;
    const whole = lane[place];
    const isSingle = whole.numbers.length === 1;
    if (!this.view.isInView(whole.x, isSingle ? limit : whole.x + whole.width)) return;
    const mark = this.fitMark(whole, before === undefined ? -Infinity : before.x + before.width, limit);
    const y = axisHeight + whole.lane * laneHeight + 1;
    if (isSingle) this.drawMarkText(mark ?? whole, limit, y); // even if its mark is left of the picture
    if (mark === null) return;
    const { ink } = this;
    const found = this.filter === null ? null : mark.numbers.filter((number) => this.filter.has(number)).length;
    const isPart = found > 0 && !isSingle;
    drawMark(ink, isPart ? { ...mark, text: `${found} of ${mark.numbers.length}` } : mark, y);
    if (found === 0) ink.rect('dimmed', mark.x - 1, y - 1, mark.width + 5, 19);
    this.addTarget(mark.x, y, mark.width, 16, { numbers: mark.numbers, mark });
    if (mark.numbers.includes(this.chosen)) ink.rect('ring', mark.x - 2, y - 2, mark.width + 4, 20, 9);
  }

  /** A mark that the edge of the picture would cut is moved in if there is room beside it, or left out: half a
   * number is another number. Of a fold the part in view is drawn. */
  fitMark(mark, least, most) {
    const [left, right] = [2, this.width - 2];
    if (mark.x >= left && mark.x + mark.width <= right) return mark;
    if (mark.numbers.length > 1) {
      const x = Math.max(mark.x, left);
      const width = Math.min(mark.x + mark.width, right) - x;
      const text = fitting(mark.texts, width - 6);
      return text === null ? null : { ...mark, x, width, text };
    }
    const at = this.view.xs[mark.numbers[0]];
    const x = Math.min(Math.max(mark.x, left), right - mark.width);
    const isFree = x > least && x + mark.width < most;
    return at >= 0 && at <= this.width && isFree ? { ...mark, x } : null;
  }

  /** The event in words, between its mark and the next one beside it. */
  drawMarkText(mark, limit, y) {
    const begin = Math.max(mark.x + mark.width + 6, 4);
    const room = Math.min(limit, this.width) - begin - 6;
    if (room < 24) return;
    const event = this.run.event(mark.numbers[0]);
    const text = fitting([describeEvent(event, this.run.catalog), [event.verb, event.name ?? ''].join(' ')], room);
    if (text === null) return;
    const look = { unchanged: 'unchanged-', rejected: 'rejected-' }[event.outcome] ?? '';
    this.ink.text(`${look}mark-text`, begin, y + 12, text);
    this.addTarget(begin, y, measure(text), 16, { numbers: mark.numbers });
  }
}
