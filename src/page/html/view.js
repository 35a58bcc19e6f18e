// Which part of a run is in view: places of events in pixels, zoom and ticks.

const padding = 18;
const endRoom = 34; // for what is still active at the end
const closest = 160; // pixels between the closest events at the highest zoom

/** A distance of ticks, in seconds: 1, 2 or 5 times a power of ten, and at least `least`. */
function tickDistance(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((factor) => factor * power).find((distance) => distance >= least);
}

class View {
  /** `scale`: "time", or "event" for events that are evenly spaced. */
  constructor(run, scale, width) {
    this.run = run;
    this.zoom = 1;
    this.offset = 0; // pixels left of what is in view
    this.width = width;
    this.setScale(scale);
  }

  /** "time" if there is any between the events. */
  static scaleFor(run) {
    return run.size > 0 && run.timeAt(run.size) > run.timeAt(1) ? 'time' : 'event';
  }

  setScale(scale) {
    const { run } = this;
    this.scale = scale;
    this.start = run.begin.time;
    this.duration = run.size > 0 ? Math.max(run.timeAt(run.size) - this.start, 1e-6) : 1;
    this.places = new Float64Array(run.size + 1); // shares of the whole
    let least = 1;
    for (let number = 1; number <= run.size; ++number) {
      this.places[number] = scale === 'time' ? (run.event(number).time - this.start) / this.duration
                                             : (number - 0.5) / run.size;
      const distance = this.places[number] - this.places[number - 1];
      if (distance > 0) least = Math.min(least, distance);
    }
    this.least = least;
    this.update();
  }

  /** The run has grown. What is zoomed stays as wide as it is, and where it is. */
  grow() {
    const lengthOf = () => (this.scale === 'time' ? this.duration : this.places.length - 1);
    const unit = this.whole / lengthOf();
    const isZoomed = this.zoom > 1;
    this.setScale(this.scale);
    if (!isZoomed) return;
    this.zoom = unit * lengthOf() / this.inner;
    this.update();
  }

  resize(width) {
    const place = this.placeAt(this.width / 2);
    this.width = width;
    this.offset = this.zoom > 1 ? padding + place * this.whole - width / 2 : 0;
    this.update();
  }

  /** Pixels that a whole run without zoom has. */
  get inner() {
    return Math.max(50, this.width - padding - endRoom);
  }

  /** Pixels of the whole run. */
  get whole() {
    return this.inner * this.zoom;
  }

  get mostZoom() {
    return Math.min(1e7, Math.max(1, closest / (this.least * this.inner)));
  }

  /** Computes the places in pixels. */
  update() {
    this.zoom = Math.min(this.mostZoom, Math.max(1, this.zoom));
    this.offset = Math.min(this.whole - this.inner, Math.max(0, this.offset));
    const { places, whole } = this;
    if (this.xs?.length !== places.length) this.xs = new Float64Array(places.length);
    const left = padding - this.offset;
    for (let number = 0; number < places.length; ++number) this.xs[number] = left + places[number] * whole;
    this.endX = left + whole;
  }

  xOfTime(time) {
    return padding - this.offset + ((time - this.start) / this.duration) * this.whole;
  }

  placeAt(x) {
    return (x - padding + this.offset) / this.whole;
  }

  /** Where a span ends that goes on at the end of the run, too. */
  endOf(span) {
    return span.to === null ? this.endX + endRoom - 12 : this.xs[span.to];
  }

  isInView(from, to = from) {
    return to >= -40 && from <= this.width + 40;
  }

  /** Zooms by a factor; what is at `x` stays there. */
  zoomAt(factor, x) {
    const place = this.placeAt(x);
    this.zoom = Math.min(this.mostZoom, Math.max(1, this.zoom * factor));
    this.offset = padding + place * this.whole - x;
    this.update();
  }

  panBy(pixels) {
    this.offset += pixels;
    this.update();
  }

  /** Shows a stretch of the whole, from a share to a share. */
  showRange(from, to) {
    this.zoom = 1 / Math.max(to - from, 1 / this.mostZoom);
    this.zoom = Math.min(this.mostZoom, Math.max(1, this.zoom));
    this.offset = (from + to) / 2 * this.whole - this.inner / 2;
    this.update();
  }

  showAll() {
    this.zoom = 1;
    this.update();
  }

  /** Brings an event into view, if it is not. */
  reveal(number) {
    const margin = Math.min(40, this.width / 4);
    const x = this.xs[number];
    if (x >= Math.min(margin, padding) && x <= this.width - margin) return;
    this.panBy(x - this.width / 2);
  }

  /** The number of the first event at or right of an `x`. */
  firstFrom(x) {
    let [least, most] = [1, this.run.size + 1];
    while (least < most) {
      const middle = (least + most) >> 1;
      if (this.xs[middle] < x) least = middle + 1;
      else most = middle;
    }
    return least;
  }

  /** The event nearest to an `x`, or null. */
  nearest(x) {
    if (this.run.size === 0) return null;
    const right = this.firstFrom(x);
    if (right > this.run.size) return this.run.size;
    return right > 1 && x - this.xs[right - 1] < this.xs[right] - x ? right - 1 : right;
  }

  /** [{x, text}] of the axis. */
  ticks() {
    if (this.scale === 'time') return this.timeTicks();
    const ticks = [];
    let free = -Infinity;
    for (let number = this.firstFrom(-40); number <= this.run.size && this.xs[number] < this.width + 40; ++number) {
      const x = this.xs[number];
      const text = formatTime(this.run.event(number).time);
      const width = measure(text);
      if (x - width / 2 < free) continue;
      free = x + width / 2 + 8;
      ticks.push({ x, text });
    }
    return ticks;
  }

  timeTicks() {
    const perPixel = this.duration / this.whole;
    const distance = tickDistance(perPixel * 80);
    const decimals = Math.max(0, -Math.floor(Math.log10(distance)));
    const first = Math.max(this.start, this.start + (this.offset - padding - 40) * perPixel);
    const last = Math.min(this.start + this.duration, this.start + (this.offset + this.width + 40) * perPixel);
    const ticks = [];
    for (let step = Math.ceil(first / distance - 1e-9); step * distance <= last + distance * 1e-9; ++step) {
      ticks.push({ x: this.xOfTime(step * distance), text: (step * distance).toFixed(decimals) });
    }
    return ticks;
  }
}
