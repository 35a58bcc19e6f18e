// What the timeline is drawn with: on a canvas for the screen, which is quick, and as SVG for files and
// paper. Both draw the same shapes in the same looks, with the colors of the style sheet.

/** Colors are names of custom properties of the style sheet. `halo` keeps texts readable on lines. */
const looks = {
  paper: { fill: 'paper' },
  band: { fill: 'panel' },
  rule: { stroke: 'grid' },
  grid: { stroke: 'grid' },
  edge: { stroke: 'line' },
  'tick-text': { fill: 'muted' },
  'event-line': { stroke: 'line' },
  'end-line': { stroke: 'muted', dash: [1, 3] },
  cursor: { stroke: 'accent', width: 2 },
  ring: { stroke: 'accent', width: 2.2 },
  selection: { fill: 'accent', alpha: 0.18 },
  requested: { fill: 'requested', stroke: 'requested' },
  required: { fill: 'required', stroke: 'required-edge' },
  reactive: { pattern: 'hatch', stroke: 'reactive-edge' },
  'requested-thin': { fill: 'requested' },
  'required-thin': { fill: 'required-edge' },
  'reactive-thin': { fill: 'reactive-edge' },
  'requested-text': { fill: 'requested-ink' },
  'required-text': { fill: 'required-ink' },
  'reactive-text': { fill: 'reactive-ink', halo: 'reactive' },
  value: { fill: 'panel', stroke: 'muted' },
  'value-text': { fill: 'ink' },
  waiting: { stroke: 'reactive-edge', width: 2, dash: [2, 4] },
  suspended: { stroke: 'requested', width: 2, dash: [2, 4] },
  unavailable: { pattern: 'unavailable' },
  misfit: { pattern: 'misfit' },
  faulty: { pattern: 'faulty' },
  untried: { pattern: 'untried' },
  'faulty-bar': { fill: 'bad', stroke: 'paper' },
  'off-text': { fill: 'muted', halo: 'paper', style: 'italic' },
  link: { stroke: 'link', width: 1.6 },
  way: { stroke: 'link', width: 1.6, dash: [4, 2.5] },
  'link-end': { fill: 'link' },
  'glyph-ground': { fill: 'paper', stroke: 'ink', width: 1.2 },
  'glyph-ground-good': { fill: 'paper', stroke: 'good', width: 1.2 },
  'glyph-ground-bad': { fill: 'paper', stroke: 'bad', width: 1.2 },
  glyph: { stroke: 'ink', width: 1.5 },
  'glyph-good': { stroke: 'good', width: 1.5 },
  'glyph-bad': { stroke: 'bad', width: 1.5 },
  'bad-text': { fill: 'bad', halo: 'paper', style: '600' },
  accepted: { fill: 'ink', stroke: 'ink', width: 1.2 },
  unchanged: { fill: 'paper', stroke: 'muted', width: 1.2 },
  rejected: { fill: 'bad', stroke: 'bad', width: 1.2 },
  failed: { fill: 'bad', stroke: 'ink', width: 2 },
  fold: { fill: 'panel', stroke: 'muted' },
  'fold-bad': { fill: 'bad-paper', stroke: 'bad' },
  'accepted-text': { fill: 'paper' },
  'unchanged-text': { fill: 'ink' },
  'rejected-text': { fill: 'paper', style: '700' },
  'failed-text': { fill: 'paper', style: '700' },
  'fold-text': { fill: 'ink' },
  'fold-bad-text': { fill: 'bad', style: '600' },
  'mark-text': { fill: 'ink', halo: 'paper' },
  'unchanged-mark-text': { fill: 'muted', halo: 'paper' },
  'rejected-mark-text': { fill: 'bad', halo: 'paper' },
  tick: { stroke: 'muted', width: 1.4 },
  'rejected-tick': { stroke: 'bad', width: 2 },
  density: { fill: 'muted' },
  'density-bad': { fill: 'bad' },
  window: { stroke: 'accent', width: 1.6 },
  dimmed: { fill: 'paper', alpha: 0.72 },
  task: { fill: 'ink', style: '600' },
  behavior: { fill: 'ink' },
  variable: { fill: 'ink', style: 'italic' },
  'lane-name': { fill: 'muted' },
  'bad-lane-name': { fill: 'bad', style: '600' },
};

const patternPaths = {
  hatch: { size: 6, path: 'M-1 7 L7 -1 M-1 1 L1 -1 M5 7 L7 5', stroke: 'reactive-edge', alpha: 0.45, ground: 'reactive' },
  unavailable: { size: 5, path: 'M-1 -1 L6 6 M-1 4 L1 6 M4 -1 L6 1', stroke: 'muted', alpha: 0.5 },
  misfit: { size: 4, path: 'M0.5 1.5 h2 M0.5 2.5 h2', stroke: 'muted', alpha: 0.5 },
  faulty: { size: 6, path: 'M-1 -1 L7 7 M-1 7 L7 -1', stroke: 'bad', alpha: 0.7 },
  untried: { size: 6, path: 'M-1 -1 L7 7', stroke: 'bad', alpha: 0.5 },
};

/** The colors of the scheme that is in use now. */
function readColors() {
  const style = getComputedStyle(document.documentElement);
  const colors = new Map();
  for (const look of [...Object.values(looks), ...Object.values(patternPaths)]) {
    for (const name of [look.fill, look.stroke, look.halo, look.ground]) {
      if (name !== undefined) colors.set(name, style.getPropertyValue(`--${name}`).trim());
    }
  }
  return colors;
}

const pathOf = (() => {
  const paths = new Map();
  return (text) => {
    if (!paths.has(text)) paths.set(text, new Path2D(text));
    return paths.get(text);
  };
})();

class CanvasInk {
  constructor(canvas) {
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.readColors();
  }

  readColors() {
    this.colors = readColors();
    this.patterns = new Map(Object.entries(patternPaths).map(([name, pattern]) => [name, this.makePattern(pattern)]));
  }

  makePattern({ size, path, stroke, alpha, ground }) {
    const tile = document.createElement('canvas');
    tile.width = tile.height = size;
    const context = tile.getContext('2d');
    if (ground !== undefined) {
      context.fillStyle = this.colors.get(ground);
      context.fillRect(0, 0, size, size);
    }
    context.globalAlpha = alpha;
    context.strokeStyle = this.colors.get(stroke);
    context.stroke(new Path2D(path));
    return this.context.createPattern(tile, 'repeat');
  }

  /** Begins a picture of a size in CSS pixels. */
  begin(width, height) {
    const ratio = devicePixelRatio || 1;
    const [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== wide || this.canvas.height !== high) {
      this.canvas.width = wide;
      this.canvas.height = high;
    }
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, width, height);
    this.context.lineCap = 'butt';
    this.look = undefined;
  }

  /** Sets a look, and tells it. */
  take(name) {
    const look = looks[name];
    if (this.look === name) return look;
    this.look = name;
    const { context, colors } = this;
    if (look.fill !== undefined) context.fillStyle = colors.get(look.fill);
    if (look.pattern !== undefined) context.fillStyle = this.patterns.get(look.pattern);
    if (look.stroke !== undefined) context.strokeStyle = colors.get(look.stroke);
    context.lineWidth = look.width ?? 1;
    context.globalAlpha = look.alpha ?? 1;
    context.setLineDash(look.dash ?? []);
    return look;
  }

  rect(name, x, y, width, height, radius = 0) {
    const { context } = this;
    const look = this.take(name);
    const isFilled = look.fill !== undefined || look.pattern !== undefined;
    if (radius === 0 && isFilled) {
      context.fillRect(x, y, width, height);
      if (look.stroke !== undefined) context.strokeRect(x, y, width, height);
      return;
    }
    context.beginPath();
    context.roundRect(x, y, width, height, Math.min(radius, width / 2, height / 2));
    if (isFilled) context.fill();
    if (look.stroke !== undefined) context.stroke();
  }

  line(name, x1, y1, x2, y2) {
    this.take(name);
    this.context.beginPath();
    this.context.moveTo(x1, y1);
    this.context.lineTo(x2, y2);
    this.context.stroke();
  }

  circle(name, x, y, radius) {
    const look = this.take(name);
    this.context.beginPath();
    this.context.arc(x, y, radius, 0, 2 * Math.PI);
    if (look.fill !== undefined) this.context.fill();
    if (look.stroke !== undefined) this.context.stroke();
  }

  /** A path as in SVG, moved to a place. */
  path(name, path, x, y) {
    const look = this.take(name);
    this.context.translate(x, y);
    if (look.fill !== undefined) this.context.fill(pathOf(path));
    if (look.stroke !== undefined) this.context.stroke(pathOf(path));
    this.context.translate(-x, -y);
  }

  /** `anchor`: "start", "middle", "end". */
  text(name, x, y, text, anchor = 'start') {
    const { context } = this;
    const look = this.take(name);
    context.font = `${look.style ?? ''} 11px ${pageFont()}`;
    context.textAlign = anchor === 'middle' ? 'center' : anchor;
    if (look.halo !== undefined) {
      context.strokeStyle = this.colors.get(look.halo);
      context.lineWidth = 4;
      context.lineJoin = 'round';
      context.strokeText(text, x, y);
      context.lineJoin = 'miter';
      this.look = undefined;
    }
    context.fillText(text, x, y);
  }

  /** Draws within a rectangle only. */
  clip(x, y, width, height, draw) {
    this.context.save();
    this.context.beginPath();
    this.context.rect(x, y, width, height);
    this.context.clip();
    draw();
    this.context.restore();
    this.look = undefined;
  }
}

class SvgInk {
  static count = 0;

  /** `isLive`: on this page, where the colors follow the scheme; otherwise they are those of now. */
  constructor(isLive) {
    const colors = isLive ? null : readColors();
    this.colorOf = (name) => colors?.get(name) ?? `var(--${name})`;
    this.id = `ink-${++SvgInk.count}`;
    this.clips = 0;
  }

  begin(width, height) {
    this.svg = svgElement('svg', {
      xmlns: 'http://www.w3.org/2000/svg', width, height, viewBox: `0 0 ${width} ${height}`,
      'font-family': pageFont(), 'font-size': 11,
    });
    this.definitions = svgElement('defs');
    for (const [name, { size, path, stroke, alpha, ground }] of Object.entries(patternPaths)) {
      const square = { width: size, height: size };
      const pattern = svgElement('pattern', { id: `${this.id}-${name}`, ...square, patternUnits: 'userSpaceOnUse' });
      if (ground !== undefined) pattern.append(svgElement('rect', { ...square, fill: this.colorOf(ground) }));
      pattern.append(svgElement('path', { d: path, stroke: this.colorOf(stroke), opacity: alpha }));
      this.definitions.append(pattern);
    }
    this.svg.append(this.definitions);
    this.group = this.svg;
  }

  add(name, look, attributes, text) {
    const { fill, pattern, stroke, width, dash, alpha } = looks[look];
    const element = svgElement(name, { ...attributes, fill: 'none' }, text);
    const set = (key, value) => value !== undefined && element.setAttribute(key, value);
    if (fill !== undefined) set('fill', this.colorOf(fill));
    if (pattern !== undefined) set('fill', `url(#${this.id}-${pattern})`);
    if (stroke !== undefined) set('stroke', this.colorOf(stroke));
    set('stroke-width', width);
    set('stroke-dasharray', dash?.join(' '));
    set('opacity', alpha);
    element.setAttribute('class', look);
    this.group.append(element);
    return element;
  }

  rect(look, x, y, width, height, radius = 0) {
    this.add('rect', look, { x, y, width, height, rx: radius });
  }

  line(look, x1, y1, x2, y2) {
    this.add('line', look, { x1, y1, x2, y2 });
  }

  circle(look, cx, cy, r) {
    this.add('circle', look, { cx, cy, r });
  }

  path(look, path, x, y) {
    this.add('path', look, { d: path, transform: `translate(${x} ${y})` });
  }

  text(look, x, y, text, anchor = 'start') {
    const element = this.add('text', look, { x, y, 'text-anchor': anchor }, text.replace(/\p{Cc}/gu, '\ufffd'));
    const { style, halo } = looks[look];
    if (style === 'italic') element.setAttribute('font-style', style);
    else if (style !== undefined) element.setAttribute('font-weight', style);
    if (halo === undefined) return;
    for (const [key, value] of [['paint-order', 'stroke'], ['stroke', this.colorOf(halo)], ['stroke-width', 4],
                                ['stroke-linejoin', 'round']]) {
      element.setAttribute(key, value);
    }
  }

  clip(x, y, width, height, draw) {
    const id = `${this.id}-clip-${++this.clips}`;
    const path = svgElement('clipPath', { id });
    path.append(svgElement('rect', { x, y, width, height }));
    this.definitions.append(path);
    const outer = this.group;
    this.group = svgElement('g', { 'clip-path': `url(#${id})` });
    outer.append(this.group);
    draw();
    this.group = outer;
  }
}
