// Numbers, names and elements: how the page writes them.

// Names of a catalog may be anything, even "__proto__": look-ups are maps, or ask for own members.
const get = (object, name) => (Object.hasOwn(object, name) ? object[name] : undefined);

/** JSON whose escapes of characters that cannot be seen stand for themselves, so that names show them. */
const showEscapes = (json) =>
  json.replaceAll(/\\(?:u([\da-f]{4})|.)/g, (escape, code) => (code !== undefined && parseInt(code, 16) > 0x7e ? `\\${escape}` : escape));

const words = (name) => name.replaceAll('_', ' ');

/** Seconds to the millisecond, or to the microsecond where it takes that. */
function formatTime(seconds) {
  return seconds.toFixed(Math.round(seconds * 1e6) % 1000 === 0 ? 3 : 6);
}

function formatPercent(share) {
  return `${Number((share * 100).toPrecision(6))} %`;
}

const quantity = (count, name) => `${count} ${name}${count === 1 ? '' : 's'}`;

const byId = (id) => document.getElementById(id);

/** An element with a class and children; texts stay texts. */
function html(name, look = '', ...children) {
  const element = document.createElement(name);
  if (look !== '') element.className = look;
  element.append(...children);
  return element;
}

function buttonElement(text, action) {
  const button = html('button', '', text);
  button.type = 'button';
  button.addEventListener('click', action);
  return button;
}

/** A row of a table's head. */
function headRow(...names) {
  return html('thead', '', html('tr', '', ...names.map((name) => {
    const cell = html('th', '', name);
    cell.scope = 'col';
    return cell;
  })));
}

const pairs = (entries) =>
  html('dl', '', ...entries.flatMap(([name, value]) => [html('dt', '', name), html('dd', '', value)]));

function svgElement(name, attributes = {}, text = undefined) {
  const element = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
}

/** A name that a line may break within: after an underscore or a separator, before a capital. */
function breakable(name) {
  const parts = name.split(/(?<=[_/:.](?=\S))|(?<=[\p{Ll}\d])(?=\p{Lu})/u);
  return html('span', '', ...parts.flatMap((part, place) => (place === 0 ? [part] : [html('wbr'), part])));
}

/** The width of a text in pixels; `style` as in CSS: "bold", "italic". */
const measure = (() => {
  const context = document.createElement('canvas').getContext('2d');
  const widths = new Map();
  return (text, style = '', size = 11) => {
    const key = `${style}\0${size}\0${text}`;
    if (!widths.has(key)) {
      context.font = `${style} ${size}px ${pageFont()}`;
      widths.set(key, context.measureText(text).width);
    }
    return widths.get(key);
  };
})();

const pageFont = (() => {
  let font;
  return () => (font ??= getComputedStyle(document.body).fontFamily);
})();

/** The first of some texts that fits into a width, or null. */
const fitting = (texts, width, style = '') => texts.find((text) => measure(text, style) <= width) ?? null;

/** A name shortened in its middle to a width: the ends of names tell them apart. */
function shortenMiddle(name, width, style = '', size = 11) {
  if (measure(name, style, size) <= width) return name;
  const letters = [...name];
  let [least, most] = [0, letters.length - 1]; // letters that are kept
  while (least < most) {
    const kept = Math.ceil((least + most) / 2);
    if (measure(joinEnds(letters, kept), style, size) <= width) least = kept;
    else most = kept - 1;
  }
  return joinEnds(letters, least);
}

/** What different names do not begin or end with together, with an ellipsis for what they do; null for a
 * name of which nothing is left. */
function distinctParts(names) {
  const [first] = names;
  let begin = 0;
  while (names.every((name) => name.length > begin && name[begin] === first[begin])) ++begin;
  const rests = names.map((name) => name.slice(begin));
  let end = 0;
  while (rests.every((rest) => rest.length > end && rest.at(-1 - end) === rests[0].at(-1 - end))) ++end;
  const cut = (rest) => `${begin > 0 ? '\u2026' : ''}${rest.slice(0, rest.length - end)}${end > 0 ? '\u2026' : ''}`;
  return rests.map((rest) => (rest.length > end ? cut(rest) : null));
}

const joinEnds = (letters, kept) =>
  `${letters.slice(0, Math.ceil(kept / 2)).join('')}\u2026${kept > 1 ? letters.slice(-Math.floor(kept / 2)).join('') : ''}`;
