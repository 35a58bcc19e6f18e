// Signs and what they mean. Situations and waiting tasks are explained only if a run has them.

/** `goesOn`: whatever may come is explained. */
function fillLegend(legend, runs, goesOn = false) {
  const item = (width, draw, text) => {
    const ink = new SvgInk(true);
    ink.begin(width, 18);
    draw(ink);
    ink.svg.setAttribute('aria-hidden', 'true');
    legend.append(html('span', '', ink.svg, text));
  };
  const span = (cause, text) => item(26, (ink) => ink.rect(cause, 1, 2, 24, 12), text);
  const glyph = (shape, look, text) => item(14, (ink) => drawGlyph(ink, 7, 8, shape, look), text);
  const mark = (look, sign, width, text) =>
    item(width + 5, (ink) => drawMark(ink, { x: 1, width, text: sign, look }, 1), text);
  const link = (look, text) => item(22, (ink) => {
    ink.path(look, 'M2 3 H13 V9', 0, 0);
    ink.circle('link-end', 3, 3, 2.4);
    ink.path('link-end', 'M9.4 8 h7.2 L13 15 Z', 0, 0);
  }, text);
  legend.replaceChildren();
  span('requested', 'active: its task is requested');
  span('required', 'active: required by another task');
  span('reactive', 'active: reactive start');
  item(26, (ink) => ink.rect('off', 1, 5, 24, 6), 'cannot be activated');
  const hasVariables = runs.some((run) => run.catalog.variables.size > 0);
  if (hasVariables) item(26, (ink) => ink.rect('value', 1, 2, 24, 12), 'value of a situation variable');
  if (goesOn || runs.some((run) => run.waitings.length > 0)) {
    item(26, (ink) => ink.line('waiting', 1, 8, 25, 8), 'reactive task that waits');
  }
  link('link', 'replaced in the same task');
  link('way', 'its task gives way to one that excludes it');
  glyph(glyphs.good, '-good', 'goal achieved');
  glyph(glyphs.change, '', 'situation change');
  glyph(glyphs.clock, '-bad', 'time out');
  glyph(glyphs.bad, '-bad', 'failed or rejected');
  mark('accepted', '1', 24, 'event, accepted');
  mark('rejected', '\u00d7 1', 24, 'rejected');
  if (goesOn || runs.some((run) => run.failures.size > 0)) mark('failed', '! 1', 24, 'an expectation failed after it');
  mark('unchanged', '1', 24, 'changes no behavior');
  mark('fold', '9 events', 58, 'folded: zoom in, or click');
  legend.append(html('span', '', hasVariables
    ? 't, r, s, f after the number: made by a timeout, a reactive start, the situation, a fault'
    : 't, r, f after the number: made by a timeout, a reactive start, a fault'));
}
