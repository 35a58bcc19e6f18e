// What the wheel, the pointer and fingers do to the timeline: the wheel zooms at the pointer; dragging
// pans, and with Shift selects a stretch to zoom to; two fingers zoom.

const dragDistance = 4; // pixels until a press becomes a drag

class Gestures {
  /** `handlers`: {onChoose(number), onHover(event, target)}; the target is null where there is none. */
  constructor(timeline, handlers) {
    this.timeline = timeline;
    this.handlers = handlers;
    this.pointers = new Map(); // of each pressed pointer: where it is
    this.drag = null;
    const { plot } = timeline;
    plot.addEventListener('wheel', (event) => this.onWheel(event), { passive: false });
    plot.addEventListener('pointerdown', (event) => this.onDown(event));
    plot.addEventListener('pointermove', (event) => this.onMove(event));
    plot.addEventListener('pointerup', (event) => this.onUp(event));
    plot.addEventListener('pointercancel', (event) => this.forget(event));
    plot.addEventListener('pointerleave', () => this.handlers.onHover(null, null));
  }

  placeOf(event) {
    const box = this.timeline.canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  onWheel(event) {
    const { timeline } = this;
    if (timeline.run.size === 0) return;
    const pixels = event.deltaMode === 1 ? 16 : event.deltaMode === 2 ? 400 : 1;
    const isAcross = event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY);
    if (isAcross) {
      event.preventDefault();
      timeline.panBy((event.deltaX || event.deltaY) * pixels);
      return;
    }
    // Where nothing is left to zoom out of, the wheel scrolls.
    if (event.deltaY > 0 && timeline.view.zoom === 1 && !event.ctrlKey) return;
    event.preventDefault();
    timeline.zoomBy(Math.exp(-event.deltaY * pixels * (event.ctrlKey ? 0.01 : 0.002)), this.placeOf(event).x);
    this.handlers.onHover(null, null);
  }

  onDown(event) {
    if (event.button !== 0 || this.timeline.run.size === 0) return;
    const place = this.placeOf(event);
    this.pointers.set(event.pointerId, place);
    this.timeline.plot.setPointerCapture(event.pointerId);
    this.drag = { begin: place, last: place, isMoved: false, isRange: event.shiftKey };
  }

  onMove(event) {
    const { timeline, drag } = this;
    const place = this.placeOf(event);
    if (!this.pointers.has(event.pointerId)) {
      const target = timeline.targetAt(place.x, place.y);
      timeline.plot.classList.toggle('is-over', target !== undefined);
      this.handlers.onHover(event, target ?? null);
      return;
    }
    const before = this.pointers.get(event.pointerId);
    this.pointers.set(event.pointerId, place);
    if (this.pointers.size === 2) {
      this.pinch(event.pointerId, before, place);
      return;
    }
    if (Math.hypot(place.x - drag.begin.x, place.y - drag.begin.y) > dragDistance) drag.isMoved = true;
    if (!drag.isMoved) return;
    this.handlers.onHover(null, null);
    timeline.plot.classList.add('is-dragged');
    if (drag.isRange) {
      timeline.selection = [drag.begin.x, place.x];
      timeline.drawSoon();
    } else {
      timeline.panBy(drag.last.x - place.x);
      timeline.picture.scrollTop += drag.last.y - place.y;
    }
    drag.last = place;
  }

  /** Two fingers: the distance between them zooms, their middle pans. */
  pinch(id, before, place) {
    this.drag.isMoved = true;
    const [, other] = [...this.pointers].find(([pointer]) => pointer !== id);
    const [was, is] = [Math.abs(before.x - other.x), Math.abs(place.x - other.x)];
    if (was < 10 || is < 10) return;
    this.timeline.zoomBy(is / was, (place.x + other.x) / 2);
    this.timeline.panBy((before.x - place.x) / 2);
  }

  onUp(event) {
    const { timeline, drag } = this;
    if (!this.pointers.has(event.pointerId)) return;
    this.forget(event);
    if (drag.isMoved && drag.isRange) {
      const [from, to] = [drag.begin.x, drag.last.x].map((x) => timeline.view.placeAt(x)).sort((a, b) => a - b);
      timeline.view.showRange(from, to);
      timeline.drawSoon();
    }
    if (drag.isMoved) return;
    const target = timeline.targetAt(drag.begin.x, drag.begin.y);
    if (target?.mark !== undefined && target.numbers.length > 1) {
      timeline.spread(target.mark);
      if (target.numbers.includes(timeline.chosen)) return;
    }
    this.handlers.onChoose(numberOfTarget(target) ?? timeline.view.nearest(drag.begin.x));
  }

  forget(event) {
    this.pointers.delete(event.pointerId);
    if (this.pointers.size > 0) return;
    this.timeline.plot.classList.remove('is-dragged');
    this.timeline.selection = null;
    this.timeline.drawSoon();
  }
}

/** The event that a target stands for. */
const numberOfTarget = (target) => target?.span?.from ?? target?.numbers?.[0];
