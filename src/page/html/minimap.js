// The whole run in a strip: how many events are where, which were rejected or failed, and what part is
// in view. Dragging in it moves the view.

const longRun = 20; // events of a run that has a strip; at any zoom, so that nothing moves

class Minimap {
  constructor(canvas, timeline) {
    this.canvas = canvas;
    this.timeline = timeline;
    this.ink = new CanvasInk(canvas);
    this.isPressed = false;
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.ink.readColors());
    canvas.addEventListener('pointerdown', (event) => {
      this.isPressed = true;
      canvas.setPointerCapture(event.pointerId);
      this.center(event);
    });
    canvas.addEventListener('pointermove', (event) => this.isPressed && this.center(event));
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, () => (this.isPressed = false));
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      timeline.zoomBy(Math.exp(-event.deltaY * 0.002), timeline.view.width / 2);
    }, { passive: false });
  }

  /** Moves the view so that its middle is where the pointer is. */
  center(event) {
    const { view } = this.timeline;
    const x = event.clientX - this.canvas.getBoundingClientRect().left;
    this.timeline.panBy((x - padding) * view.zoom - view.inner / 2 - view.offset);
  }

  draw() {
    const { run, view, names } = this.timeline;
    this.canvas.hidden = run.size < longRun;
    if (this.canvas.hidden) return;
    this.canvas.style.marginLeft = names.style.width;
    const height = 30;
    const { ink } = this;
    ink.begin(view.width, height);
    ink.rect('band', 0, 0, view.width, height);
    this.drawDensity(run, view, height);
    const xOf = (offset) => padding + offset / view.zoom;
    const chosen = padding + view.places[this.timeline.chosen] * view.inner;
    ink.line('cursor', chosen, 0, chosen, height);
    if (view.zoom === 1) return;
    const [from, to] = [xOf(view.offset), xOf(view.offset + view.inner)];
    ink.rect('dimmed', 0, 0, from, height);
    ink.rect('dimmed', to, 0, view.width - to, height);
    ink.rect('window', from, 1, Math.max(3, to - from), height - 2, 2);
  }

  drawDensity(run, view, height) {
    const columns = this.count(run, view);
    const most = Math.log1p(columns.most);
    for (const [x, { all, bad }] of columns.list) {
      const share = Math.log1p(all) / most * (height - 6);
      this.column('density', x, height, share);
      if (bad > 0) this.column('density-bad', x, height, Math.max(6, share * bad / all));
    }
  }

  /** The events in each column of three pixels; kept until something changes. */
  count(run, view) {
    const key = `${run.size} ${view.scale} ${view.width}`;
    if (this.counted?.run === run && this.counted.key === key) return this.counted;
    const list = new Map();
    for (let number = 1; number <= run.size; ++number) {
      const x = Math.floor((padding + view.places[number] * view.inner) / 3) * 3;
      const column = list.get(x) ?? { all: 0, bad: 0 };
      list.set(x, column);
      ++column.all;
      if (run.isRejected(number) || run.isFailed(number)) ++column.bad;
    }
    const most = Math.max(1, ...[...list.values()].map((column) => column.all));
    this.counted = { run, key, list, most };
    return this.counted;
  }

  column(look, x, bottom, height) {
    this.ink.rect(look, x, bottom - height, 2, height);
  }
}
