// Marks of events with their numbers: side by side, one above the other, or folded into counts where
// they would overlap.

const mostLanes = 6; // if these suffice for all; otherwise marks fold, and fewer are enough
const lanesOfFolded = 2;
const markGap = 3;
const foldWidth = 68;

/** A mark is {numbers, lane, x, width, text, look}: of one event, or of several that are folded. */
class Marks {
  constructor(run) {
    this.run = run;
    this.others = [];
    this.problems = [];
    this.grow();
  }

  /** Makes the marks of further events. */
  grow() {
    const { run, others, problems } = this;
    for (let number = others.length + problems.length + 1; number <= run.size; ++number) {
      (run.isRejected(number) || run.isFailed(number) ? problems : others).push(this.single(number));
    }
    this.lanesKey = null;
  }

  /** An expectation after the last event failed. */
  noteFailure(number) {
    for (const list of [this.others, this.problems]) if (list.at(-1)?.numbers[0] === number) list.pop();
    this.grow();
  }

  single(number) {
    const event = this.run.event(number);
    const suffix = { timeout: ' t', reactive: ' r', situation: ' s', fault: ' f', repair: ' p' }[event.origin] ?? '';
    const isFailed = this.run.isFailed(number);
    const sign = isFailed ? '! ' : event.outcome === 'rejected' ? '\u00d7 ' : '';
    const text = `${sign}${this.run.indexOf(number)}${suffix}`;
    const look = isFailed ? 'failed' : event.outcome;
    return { numbers: [number], text, look, width: Math.max(17, measure(text, looks[`${look}-text`].style) + 9) };
  }

  /** Lanes that marks take: the same at any zoom, so that rows stay where they are. */
  lanes(view) {
    const key = `${view.scale} ${view.width}`;
    if (this.lanesKey === key) return this.laneCount;
    const edges = [0];
    const left = (item) => padding + view.places[item.numbers[0]] * view.inner - item.width / 2 - markGap;
    for (const item of this.others) {
      const free = edges.findIndex((edge) => edge < left(item));
      edges[free === -1 ? edges.length : free] = left(item) + item.width + markGap;
      if (edges.length > mostLanes) break;
    }
    this.lanesKey = key;
    this.laneCount = edges.length <= mostLanes ? edges.length : Math.min(lanesOfFolded, this.run.mostAtOnce);
    return this.laneCount;
  }

  place(view) {
    const lanes = this.lanes(view);
    const marks = this.placeLane(view, this.others, lanes, 0);
    if (this.problems.length > 0) marks.push(...this.placeLane(view, this.problems, 1, lanes));
    return marks;
  }

  /** Places marks in lanes from `top` on. What is folded depends on the zoom only, not on what is in view. */
  placeLane({ xs, whole, offset }, items, lanes, top) {
    const placed = [];
    const end = padding + whole + endRoom - offset; // of the run
    let edge = -Infinity; // of what is placed
    const add = (mark) => {
      placed.push(mark);
      edge = Math.max(edge, mark.x + mark.width);
    };
    const xOf = (place) => xs[items[place].numbers[0]];
    for (let place = 0; place < items.length;) {
      const chain = this.findChain(xOf, items, place, lanes);
      if (chain !== null) {
        chain.forEach((lane, index) => {
          const item = items[place + index];
          add({ ...item, lane: top + lane, x: xOf(place + index) - item.width / 2 });
        });
        place += chain.length;
        continue;
      }
      const begin = place;
      const x = xOf(place);
      while (place < items.length && xOf(place) < x + foldWidth + 20) ++place;
      const left = Math.min(x - 9, Math.max(edge + markGap, end - foldWidth));
      const width = Math.min(foldWidth, end - left);
      add(this.fold(items.slice(begin, place), { x, left, width, lane: top, last: xOf(place - 1) }));
    }
    return placed;
  }

  /** The lanes of the marks that begin at a place and would overlap without lanes; null if these do not
   * suffice. */
  findChain(xOf, items, begin, lanes) {
    const edges = [];
    const chain = [];
    for (let place = begin; place < items.length; ++place) {
      const left = xOf(place) - items[place].width / 2 - markGap;
      if (edges.every((edge) => edge < left)) {
        if (place > begin) return chain;
        edges.length = 0;
      }
      const free = edges.findIndex((edge) => edge < left);
      const lane = free === -1 ? edges.length : free;
      if (lane === lanes) return null;
      edges[lane] = xOf(place) + items[place].width / 2;
      chain.push(lane);
    }
    return chain;
  }

  /** `left`, `width`: the room for the mark; `x`, `last`: where its first and its last event are. */
  fold(items, { x, left, width, lane, last }) {
    const numbers = items.map((item) => item.numbers[0]);
    if (numbers.length === 1) return { ...items[0], lane, x: x - items[0].width / 2 };
    const failed = numbers.filter((number) => this.run.isFailed(number)).length;
    const rejected = numbers.length - failed; // of problems
    const isBad = this.run.isRejected(numbers[0]) || failed > 0;
    const texts = !isBad ? [`${numbers.length} events`, `${numbers.length}`]
      : failed === 0 ? [`${rejected} rejected`, `${rejected} rej.`, `${rejected}`]
        : rejected === 0 ? [`${failed} failed`, `! ${failed}`]
          : [`${failed} failed, ${rejected} rej.`, `${failed} failed +${rejected}`, `! ${failed} +${rejected}`];
    const text = fitting(texts, width - 6) ?? texts.at(-1);
    return { numbers, text, texts, lane, look: isBad ? 'fold-bad' : 'fold', x: left, width, from: x, to: last };
  }
}
