// Signs and what they mean: only those that occur in the run that is shown.

class Legend {
  /** `element`: what the legend is written into. */
  constructor(element) {
    this.element = element;
    this.key = '';
  }

  /** `parts`: {hasFolds, hasMinimap, hasGraph}: what the page shows of the run. */
  show(run, parts) {
    if (run !== this.signs?.run) {
      this.signs = new Signs(run);
      this.hasFolds = false;
    }
    this.hasFolds ||= parts.hasFolds; // it stays when one zooms in
    const names = this.signs.update();
    const key = [...names, this.hasFolds, parts.hasMinimap, parts.hasGraph].join();
    if (key === this.key) return;
    this.key = key;
    this.has = (name) => names.has(name);
    this.groups = [['Rows', this.rowItems()], ['Events', this.eventItems(parts)]];
    if (parts.hasGraph) this.groups.push(['Graph', this.graphItems()]);
    this.element.replaceChildren(...this.groups.filter(([, items]) => items.length > 0)
      .map(([title, items]) => html('p', '', html('strong', '', title), ...items)));
  }

  rowItems() {
    const { has } = this;
    const items = [];
    const add = (name, ...item) => has(name) && items.push(signItem(...item));
    const glyph = (shape, look, text) => add(shape, 14, (ink) => drawGlyph(ink, 7, 8, shape, look), text);
    for (const [name, text] of [['requested', 'active: its task is requested'], ['required', 'active: required by another task'],
                                ['reactive', 'active: reactive start']]) {
      add(name, 26, (ink) => ink.rect(name, 1, 2, 24, 12), text);
    }
    for (const [kind, text] of [['unavailable', 'unavailable'], ['does not fit', 'does not fit the situation'],
                                ['faulty', 'faulty'], ['not tried again', 'has failed, and is not tried again']]) {
      add(kind, 26, (ink) => ink.rect(outageLooks[kind], 1, 5, 24, 6), `${text}: cannot be activated`);
    }
    add('fault of active', 34, (ink) => {
      const bar = ['requested', 'required', 'reactive'].find(has);
      ink.rect(bar, 1, 2, 32, spanHeight);
      ink.rect('faulty-bar', 7, 2 + spanHeight - 4, 26, 4);
      drawGlyph(ink, 8, 9, glyphs.fault, '-bad');
    }, 'fault of an active behavior, which goes on');
    add('value', 26, (ink) => ink.rect('value', 1, 2, 24, 12), 'value of a situation variable');
    add('waiting', 26, (ink) => ink.line('waiting', 1, 8, 25, 8), 'reactive task that waits');
    add('suspended', 26, (ink) => ink.line('suspended', 1, 8, 25, 8), 'request that is suspended');
    for (const [kind, look, text] of [['replaced', 'link', 'replaced in the same task'],
                                      ['way', 'way', 'its task gives way to one that excludes it']]) {
      add(kind, 22, (ink) => {
        ink.path(look, 'M2 3 H13 V9', 0, 0);
        ink.circle('link-end', 3, 3, 2.4);
        ink.path('link-end', 'M9.4 8 h7.2 L13 15 Z', 0, 0);
      }, text);
    }
    glyph(glyphs.good, '-good', 'goal achieved');
    glyph(glyphs.change, '', 'finished: situation change');
    glyph(glyphs.clock, '-bad', 'time out');
    const bad = [has(glyphs.bad) ? 'failed' : '', has('rejected') ? 'rejected' : ''];
    if (bad.join('') !== '') {
      items.push(signItem(14, (ink) => drawGlyph(ink, 7, 8, glyphs.bad, '-bad'), bad.filter((word) => word !== '').join(' or ')));
    }
    if (this.signs.run.size > 0) items.push(signItem(10, (ink) => ink.line('end-line', 5, 0, 5, 18), 'end of the mission'));
    return items;
  }

  eventItems({ hasMinimap }) {
    const { has } = this;
    const items = [];
    const mark = (isThere, look, sign, width, text) => isThere &&
      items.push(signItem(width + 6, (ink) => drawMark(ink, { x: 1, width, text: sign, look }, 1), text));
    mark(has('accepted'), 'accepted', '1', 24, 'accepted');
    mark(has('rejected'), 'rejected', '\u00d7 1', 24, 'rejected');
    mark(has('failed'), 'failed', '! 1', 24, 'an expectation failed after it');
    mark(has('unchanged'), 'unchanged', '1', 24, 'changes no behavior');
    mark(this.hasFolds, 'fold', '9 events', 58, 'folded: zoom in, or click');
    const origins = [['timeout', 't', 'a timeout'], ['reactive', 'r', 'a reactive start'], ['situation', 's', 'the situation'],
                     ['fault', 'f', 'a fault'], ['repair', 'p', 'a repair']].filter(([origin]) => has(`by ${origin}`));
    if (origins.length > 0) {
      items.push(html('span', '', `${origins.map(([, letter]) => letter).join(', ')} after the number: made by ` +
        origins.map(([, , text]) => text).join(', ')));
    }
    if (hasMinimap) {
      items.push(signItem(44, (ink) => {
        ink.rect('band', 0, 0, 44, 17);
        [5, 9, 7, 12, 6, 10, 8, 5].forEach((height, place) => ink.rect('density', 3 + place * 5, 17 - height, 2, height));
        ink.rect('dimmed', 0, 0, 12, 17);
        ink.rect('dimmed', 30, 0, 14, 17);
        ink.rect('window', 12, 1, 18, 15, 2);
      }, 'the whole run; in the window what is in view, if zoomed in'));
    }
    return items;
  }

  graphItems() {
    const { has } = this;
    const items = [];
    const add = (isThere, ...item) => isThere && items.push(signItem(...item));
    const drawn = (...elements) => (ink) => ink.svg.append(...elements);
    const line = (look) => drawn(svgElement('path', { d: 'M1 8 H20', class: look }),
                                 svgElement('path', { d: 'M18 4 L26 8 L18 12 Z', class: 'edge-head' }));
    const group = (look, ...elements) => {
      const node = svgElement('g', { class: `node ${look}` });
      node.append(...elements);
      return node;
    };
    const box = (look) => drawn(group(look, svgElement('rect', { x: 1, y: 2, width: 24, height: 13, rx: 4 })));
    for (const [cause, text] of [['requested', 'requested task, P and its priority'], ['required', 'required task'],
                                 ['reactive', 'reactive task']]) {
      add(has(cause), 26, box(cause), text);
    }
    const sign = (name, change, text) => add(has(name), 18, drawn(group(change, ...nodeSign(9, 9, changeSigns[change]))), text);
    sign('started task', 'started', 'started by this event');
    sign('replaced behavior', 'replaced', 'another behavior by this event');
    add(has('stopped task'), 26, box('stopped'), 'stopped by this event');
    add(has('requirement'), 27, line('edge'), 'requires');
    add(has('ended requirement'), 27, line('edge stopped'), 'required, until this event');
    return items;
  }
}

/** A sign of the picture with its meaning. */
function signItem(width, draw, text) {
  const ink = new SvgInk(true);
  ink.begin(width, 18);
  draw(ink);
  ink.svg.setAttribute('aria-hidden', 'true');
  return html('span', '', ink.svg, text);
}
