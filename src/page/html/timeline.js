// The timeline on the page: its size, the names beside it, what the pointer is at, and its picture as SVG.

class Timeline {
  /** `elements`: {picture, sheet, names, plot, canvas}. */
  constructor(elements) {
    Object.assign(this, elements);
    this.ink = new CanvasInk(this.canvas);
    this.wantsAll = false;
    this.wantsLinks = false;
    this.wanted = null;
    this.filter = null;
    this.selection = null;
    this.chosen = 0;
    this.targets = [];
    this.onDraw = () => {};
    this.isWaiting = false;
    this.picture.addEventListener('scroll', () => this.drawSoon());
    new ResizeObserver(() => this.layOut()).observe(this.picture);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => {
      this.ink.readColors();
      this.drawSoon();
    });
  }

  show(run, chosen) {
    this.run = run;
    this.chosen = chosen;
    this.filter = null;
    this.wanted = null;
    this.isScaleWanted = false;
    this.view = new View(run, View.scaleFor(run), this.plot.clientWidth);
    this.marker = new Marks(run);
    this.picture.scrollTop = 0;
    this.setUpRows();
  }

  /** The run has grown. */
  grow() {
    const { run, view } = this;
    if (!this.isScaleWanted) view.scale = View.scaleFor(run);
    view.grow();
    this.marker.grow();
    if (run.shownCount !== this.shownCount) return this.setUpRows();
    this.rows.addSpans();
    if (this.headKey() === this.filledHead) this.drawSoon();
    else this.layOut();
  }

  /** Shows the same stretch of time as another view, if that did not show all. */
  keepView({ scale, zoom, offset, whole, inner, start, duration }) {
    const { view } = this;
    if (scale !== 'time' || view.scale !== 'time' || zoom <= 1) return;
    const shareOf = (pixels) => (start + pixels / whole * duration - view.start) / view.duration;
    view.showRange(shareOf(offset), shareOf(offset + inner));
    this.drawSoon();
  }

  /** An expectation after an event failed. */
  noteFailure(number) {
    this.marker.noteFailure(number);
    this.layOut();
  }

  setUpRows() {
    this.shownCount = this.run.shownCount;
    this.rows = new Rows(this.run, this.wantsAll, this.wanted);
    this.layOut();
  }

  setScale(scale) {
    this.isScaleWanted = true;
    this.view.setScale(scale);
    this.view.reveal(this.chosen);
    this.layOut();
  }

  /** Shows which events a search has found; `wanted`: whether a name is searched for, or null. */
  setFilter(filter, wanted) {
    this.filter = filter;
    this.wanted = wanted;
    this.setUpRows();
  }

  scene() {
    const { run, view, rows, chosen, wantsLinks, filter, selection } = this;
    return {
      run, view, rows, chosen, wantsLinks, filter, selection,
      marks: this.marker.place(view),
      lanes: this.marker.lanes(view),
      hasProblems: this.marker.problems.length > 0,
    };
  }

  /** Fits everything into the present size of the page. */
  layOut() {
    if (this.run === undefined || this.picture.clientWidth === 0) return;
    const width = this.picture.clientWidth;
    const nameWidth = this.rows.nameWidth(Math.max(110, width * (width < 700 ? 0.36 : 0.3)));
    this.names.style.width = `${nameWidth}px`;
    this.view.resize(Math.max(80, width - nameWidth));
    this.head = this.headHeight();
    this.sheet.style.height = `${this.pictureHeight()}px`;
    this.fillNames(nameWidth);
    this.draw();
  }

  headHeight() {
    return Painter.headHeight({ lanes: this.marker.lanes(this.view), hasProblems: this.marker.problems.length > 0 });
  }

  /** What the names of the head depend on. */
  headKey() {
    return `${this.view.scale} ${this.headHeight()} ${this.problemTitle()}`;
  }

  fillNames(width) {
    this.filledHead = this.headKey();
    const item = (text, look, height, top = 0) => {
      const element = html('div', look, text);
      element.style.height = element.style.lineHeight = `${height}px`;
      element.style.marginTop = `${top}px`;
      return element;
    };
    const { view } = this;
    const axisName = view.scale === 'time' || width < 170 ? 'time [s]' : 'time [s], events evenly spaced';
    const head = html('div', 'names-head', item(axisName, 'lane', axisHeight),
      item('events', 'lane', laneHeight * this.marker.lanes(view)));
    if (this.marker.problems.length > 0) head.append(item(this.problemTitle(), 'lane has-bad', laneHeight));
    head.style.height = `${this.head}px`;
    let y = 0;
    const texts = this.rows.fittingNames(width - 10, 12);
    const rows = this.rows.list.map((row, place) => {
      const name = Rows.nameOf(row);
      const kind = Rows.kindOf(row);
      const text = texts[place];
      const element = item(text, kind, row.height, row.y - y);
      y = row.y + row.height;
      element.title = kind === 'variable' ? `situation variable ${name}` : `${kind} ${name}`;
      if (text !== name) element.setAttribute('aria-label', element.title);
      if (text !== name) element.setAttribute('role', 'img');
      return element;
    });
    this.nameRows = html('div', 'names-rows', ...rows);
    this.names.replaceChildren(head, this.nameRows);
  }

  problemTitle() {
    const { run } = this;
    if (run.problems.every((number) => run.isFailed(number))) return 'failed';
    return run.failures.size === 0 ? 'rejected' : 'rejected, failed';
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
    if (this.run === undefined || this.nameRows === undefined) return;
    const height = this.picture.clientHeight;
    const scroll = this.picture.scrollTop;
    const { width } = this.view;
    this.canvas.style.width = `${width}px`;
    this.canvas.style.height = `${height}px`;
    this.ink.begin(width, height);
    const scene = this.scene();
    this.hasFolds = scene.marks.some((mark) => mark.numbers.length > 1);
    const painter = new Painter(scene, this.ink);
    painter.paint(width, height, scroll);
    this.targets = painter.targets;
    this.nameRows.style.transform = `translateY(${-scroll}px)`;
    this.onDraw();
  }

  choose(number) {
    this.chosen = number;
    if (this.run.size > 0) this.view.reveal(number);
    this.drawSoon();
  }

  /** Zooms by a factor around an `x`, or around the chosen event if it is in view. */
  zoomBy(factor, x) {
    const { view } = this;
    const chosen = view.xs[this.chosen];
    const middle = chosen >= 0 && chosen <= view.width ? chosen : view.width / 2;
    view.zoomAt(factor, x ?? middle);
    this.drawSoon();
  }

  panBy(pixels) {
    this.view.panBy(pixels);
    this.drawSoon();
  }

  fit() {
    this.view.showAll();
    this.drawSoon();
  }

  /** Zooms to the events of a mark, so that they come apart. */
  spread({ numbers }) {
    const places = numbers.map((number) => this.view.places[number]);
    const [from, to] = [Math.min(...places), Math.max(...places)];
    const margin = Math.max((to - from) * 0.15, this.view.least);
    if (to > from) this.view.showRange(from - margin, to + margin);
    this.drawSoon();
  }

  /** What is at a place of the canvas, or undefined. */
  targetAt(x, y) {
    return this.targets.findLast((target) => x >= target.x && x <= target.x + target.width &&
                                             y >= target.y && y <= target.y + target.height);
  }

  /** The timeline as SVG, with its names: the part of the time that is in view, and all rows. */
  toSvg() {
    return this.paintSvg(new SvgInk(false), this.rows.nameWidth(400), this.scene());
  }

  /** The whole run as SVG for paper of a size: as wide as the paper, and not higher. */
  wholeSvg(width, height) {
    const nameWidth = this.rows.nameWidth(400);
    const paint = (wide) => {
      const view = new View(this.run, this.view.scale, wide - nameWidth);
      const scene = { ...this.scene(), view, chosen: 0, marks: this.marker.place(view) };
      return this.paintSvg(new SvgInk(true), nameWidth, scene);
    };
    const shrink = Math.min(1, height / this.pictureHeight());
    const svg = paint(width / shrink);
    svg.setAttribute('width', width);
    svg.setAttribute('height', this.pictureHeight() * shrink);
    return svg;
  }

  pictureHeight() {
    return this.head + this.rows.height + 4;
  }

  paintSvg(ink, nameWidth, scene) {
    const { width } = scene.view;
    const height = this.pictureHeight();
    ink.begin(nameWidth + width, height);
    ink.rect('paper', 0, 0, nameWidth + width, height);
    this.drawNames(ink, nameWidth, height);
    const names = ink.group;
    ink.group = svgElement('g', { transform: `translate(${nameWidth} 0)` });
    names.append(ink.group);
    ink.clip(0, 0, width, height, () => new Painter(scene, ink).paint(width, height, 0));
    return ink.svg;
  }

  drawNames(ink, width, height) {
    ink.line('edge', width - 0.5, 0, width - 0.5, height);
    const lanes = this.marker.lanes(this.view);
    ink.text('lane-name', width - 10, axisHeight - 7, 'time [s]', 'end');
    ink.text('lane-name', width - 10, axisHeight + 14, 'events', 'end');
    if (this.marker.problems.length > 0) {
      ink.text('bad-lane-name', width - 10, axisHeight + lanes * laneHeight + 14, this.problemTitle(), 'end');
    }
    const names = this.rows.fittingNames(width - 6, 11);
    this.rows.list.forEach((row, place) =>
      ink.text(Rows.kindOf(row), Rows.indentOf(row), this.head + row.y + row.height / 2 + 4, names[place]));
  }
}
