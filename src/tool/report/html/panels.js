// Texts beside the picture: the table of events, the details of one, the state after it.

/** An element with a class and children; texts stay texts. */
function html(name, look = '', ...children) {
  const element = document.createElement(name);
  if (look !== '') element.className = look;
  element.append(...children);
  return element;
}

/** A name that a line may break within: after an underscore, before a capital. */
function breakable(name) {
  const parts = name.split(/(?<=_)|(?<=[\p{Ll}\d])(?=\p{Lu})/u);
  return html('span', '', ...parts.flatMap((part, place) => (place === 0 ? [part] : [html('wbr'), part])));
}

const outcomeSigns = { accepted: '\u2713', rejected: '\u00d7', unchanged: '\u2013' };

function outcomeElement(event) {
  if (!isAsked(event)) return html('span', 'outcome unchanged', '');
  return html('span', `outcome ${event.outcome}`, `${outcomeSigns[event.outcome]} ${event.outcome}`);
}

const reasonElements = (event) =>
  event.conflict.map((reason) => html('p', 'failed', breakable(reason.message)));

function sentenceElements(run, number) {
  const list = run.sentences(number).map(({ text, why, isBad }) => {
    const line = html('p', isBad ? 'failed' : '', breakable(text));
    if (why !== '') line.append(html('span', 'why', breakable(` \u2013 ${why}`)));
    return line;
  });
  for (const failure of run.failures.get(number) ?? []) list.push(failureElement(run, failure));
  return list;
}

function failureElement(run, failure) {
  const place = `${run.data.script}:${failure.line}`;
  return html('p', 'alarm', `failed expectation: ${failure.message} (${place})`);
}

/** A row for each event. */
function fillTable(body, run) {
  const rows = run.events.map((event, place) => {
    const number = place + 1;
    const button = html('button', '', `${number}`);
    button.type = 'button';
    button.tabIndex = -1;
    button.setAttribute('aria-label', `Event ${number}`);
    const row = html('tr', event.outcome === 'rejected' ? 'rejected' : '',
      html('td', '', button),
      html('td', '', formatTime(event.time)),
      html('td', '', breakable(nameEvent(event, run.catalog))),
      html('td', '', outcomeElement(event)),
      html('td', '', ...reasonElements(event), ...sentenceElements(run, number)));
    row.dataset.event = number;
    return row;
  });
  body.replaceChildren(...rows);
}

/** A row of P, T, S, behavior (and who replaced it, or whom it replaced), task, cause. */
function changeRow(run, number, change) {
  const behavior = html('td', '', breakable(change.behavior));
  const note = run.note(number, change);
  if (note !== '') behavior.append(html('div', 'why', breakable(note)));
  return html('tr', change.success ? '' : 'failed',
    html('td', 'sign', change.priority === null ? '.' : `${change.priority}`),
    html('td', 'sign', change.op === 'activate' ? '+' : '\u2212'),
    html('td', 'sign', change.success ? 'Y' : 'N'),
    behavior, html('td', '', breakable(change.tasks.join(', '))), html('td', 'cause', change.cause));
}

/** All changes of all events, for paper. */
function addPrintedChanges(body, run) {
  for (const row of body.rows) {
    const number = Number(row.dataset.event);
    const { changes } = run.event(number);
    if (changes.length === 0) continue;
    const table = html('table', '', html('tbody', '', ...changes.map((change) => changeRow(run, number, change))));
    row.lastElementChild.append(html('div', 'for-print', table));
  }
}

function removePrintedChanges(body) {
  for (const element of body.querySelectorAll('.for-print')) element.remove();
}

function changeTable(run, number) {
  const head = html('tr');
  const titles = { P: 'priority of the request behind it', T: '+ activation, \u2212 deactivation', S: 'success: Y or N' };
  for (const name of ['P', 'T', 'S', 'behavior', 'task', 'cause']) {
    const cell = html('th', titles[name] !== undefined ? 'sign' : name, name);
    cell.scope = 'col';
    if (titles[name] !== undefined) cell.title = titles[name];
    head.append(cell);
  }
  const rows = run.event(number).changes.map((change) => changeRow(run, number, change));
  return html('table', 'changes', html('thead', '', head), html('tbody', '', ...rows));
}

function pairs(entries) {
  return html('dl', '', ...entries.flatMap(([name, value]) => [html('dt', '', name), html('dd', '', value)]));
}

function objectivePairs(objective) {
  return pairs([
    ['requests satisfied', `${objective.satisfied} of ${objective.requests}`],
    ['suitability, product', formatPercent(objective.suitability)],
    ['supporting tasks idle', formatPercent(objective.idle)],
    ['behaviors changed', `${objective.changes}`],
  ]);
}

function searchPairs(search) {
  return pairs(Object.entries(search).map(([name, value]) => [words(name), `${value}`]));
}

/** The details of an event. `elements` of the page: title, body, numbers. */
function fillDetail(elements, run, number) {
  const event = run.event(number);
  elements.title.textContent = `Event ${number} at ${formatTime(event.time)} s`;
  const parts = [html('p', 'headline', nameEvent(event, run.catalog)), outcomeElement(event)];
  parts.push(...sentenceElements(run, number));
  const add = (title, element) => parts.push(html('h3', '', title), element);
  if (event.conflict.length > 0) {
    add('Reasons: without any one of them it would be possible', html('ul', '', ...event.conflict.map(
      (reason) => html('li', '', `${reason.message} `, html('span', 'why', `[${words(reason.kind)}]`)))));
  }
  if (event.changes.length > 0) add('Changes, in order', changeTable(run, number));
  if (event.stopped_tasks.length > 0) {
    add('Stopped tasks', html('p', '', event.stopped_tasks
      .map((stopped) => `${stopped.task} (${words(stopped.cause)})`).join(', ')));
  }
  elements.body.replaceChildren(...parts);
  const numbers = [];
  if (event.objective !== null) {
    numbers.push(html('div', '', html('h3', '', 'Objectives'), objectivePairs(event.objective)));
  }
  if (event.search !== null) {
    numbers.push(html('div', '', html('h3', '', 'Search'), searchPairs(event.search)));
  }
  elements.numbers.replaceChildren(...numbers);
}

/** The state after an event. */
function fillState(body, run, number) {
  const event = run.event(number);
  const rows = run.catalog.sortTasks(Object.keys(event.running)).map((task) => html('tr', '',
    html('td', '', breakable(task)), html('td', '', breakable(event.running[task])),
    html('td', '', breakable(run.whyRuns(number, task)))));
  const parts = [];
  if (rows.length === 0) {
    parts.push(html('p', '', 'No task runs.'));
  } else {
    const head = ['task', 'behavior', 'because'].map((name) => {
      const cell = html('th', '', name);
      cell.scope = 'col';
      return cell;
    });
    parts.push(html('table', '', html('thead', '', html('tr', '', ...head)), html('tbody', '', ...rows)));
  }
  const queue = Object.entries(event.queue).filter(([, due]) => due !== null)
    .map(([task, due]) => `${task} at ${formatTime(due)} s`);
  const more = [];
  if (run.values[number].size > 0) {
    more.push(['situation', [...run.values[number]].map(([name, value]) => describeValue(name, value)).join(', ')]);
  }
  if (queue.length > 0) more.push(['reactive starts due', queue.join(', ')]);
  if (run.waiting[number].length > 0) more.push(['waiting reactive tasks', run.waiting[number].join(', ')]);
  if (run.misfits[number].length > 0) more.push(['do not fit', run.misfits[number].join(', ')]);
  if (run.unavailable[number].length > 0) more.push(['unavailable', run.unavailable[number].join(', ')]);
  if (run.faulty[number].length > 0) more.push(['faulty', run.faulty[number].join(', ')]);
  if (more.length > 0) parts.push(pairs(more));
  body.replaceChildren(...parts);
}

/** What is shown beside the pointer: an event, or a span with its begin and its end. */
function tipContent(run, span, number) {
  const event = run.event(number);
  if (span === null) {
    return [html('strong', '', `${number} \u00b7 ${formatTime(event.time)} s \u00b7 ${nameEvent(event, run.catalog)} `),
            outcomeElement(event), ...reasonElements(event), ...sentenceElements(run, number)];
  }
  const end = span.to === null ? 'the end of the run' : `${formatTime(run.event(span.to).time)} s (event ${span.to})`;
  const parts = [
    html('strong', '', span.behavior),
    html('p', '', `performs ${span.task}, ${run.whyRuns(span.from, span.task) || span.cause}`),
    html('p', '', `from ${formatTime(event.time)} s (event ${span.from}) to ${end}`),
  ];
  const nameOf = { replaced: ['replaces', 'replaced by'], way: ['in place of', 'gives way to'] };
  for (const link of run.linksOf[span.from]) {
    if (link.to.task === span.task) parts.push(html('p', '', `begin: ${nameOf[link.kind][0]} ${link.from.behavior}`));
  }
  if (span.to !== null) {
    const why = run.linksOf[span.to].filter((link) => link.from.task === span.task)
      .map((link) => `${nameOf[link.kind][1]} ${link.to.behavior}`);
    const last = run.event(span.to);
    if (last.verb === 'finish' && last.name === span.behavior) why.unshift(`finished: ${words(last.cause)}`);
    if (why.length > 0) parts.push(html('p', '', `end: ${why.join('; ')}`));
  }
  return parts;
}

/** Signs and what they mean; situations and waiting tasks only if a run has them. */
function fillLegend(legend, runs) {
  const item = (width, draw, text) => {
    const picture = svgElement('svg', { width, height: 16, 'aria-hidden': 'true' });
    draw(picture);
    legend.append(html('span', '', picture, text));
  };
  const span = (cause, text) => item(26, (picture) => picture.append(
    svgElement('rect', { x: 1, y: 2, width: 24, height: 12, class: `span ${cause}` })), text);
  const glyph = (shape, look, text) => item(14, (picture) => {
    const group = svgElement('g', { transform: 'translate(7 8)', class: `glyph ${look}` });
    group.append(svgElement('circle', { r: 5.6 }), svgElement('path', { d: shape }));
    picture.append(group);
  }, text);
  const mark = (outcome, sign, text) => item(26, (picture) => {
    const group = svgElement('g', { class: `mark ${outcome}` });
    group.append(svgElement('rect', { x: 1, y: 1, width: 24, height: 14, rx: outcome === 'rejected' ? 2 : 7, class: 'pill' }),
                 svgElement('text', { x: 13, y: 12 }, sign));
    picture.append(group);
  }, text);
  const link = (look, text) => item(22, (picture) => picture.append(
    svgElement('path', { d: 'M2 3 H13 V9', class: `link ${look}` }),
    svgElement('circle', { cx: 3, cy: 3, r: 2.4, class: 'link-foot' }),
    svgElement('path', { d: 'M9.4 8 h7.2 L13 15 Z', class: 'link-head' })), text);
  legend.replaceChildren();
  span('requested', 'active: its task is requested');
  span('required', 'active: required by another task');
  span('reactive', 'active: reactive start');
  item(26, (picture) => picture.append(svgElement('rect', { x: 1, y: 5, width: 24, height: 6, class: 'off' })),
       'cannot be activated');
  const hasVariables = runs.some((run) => run.catalog.variables.size > 0);
  if (hasVariables) {
    item(26, (picture) => picture.append(svgElement('rect', { x: 1, y: 2, width: 24, height: 12, class: 'value' })),
         'value of a situation variable');
  }
  if (runs.some((run) => run.waitings.length > 0)) {
    item(26, (picture) => picture.append(svgElement('line', { x1: 1, x2: 25, y1: 8, y2: 8, class: 'waiting' })),
         'reactive task that waits');
  }
  link('replaced', 'replaced in the same task');
  link('way', 'its task gives way to one that excludes it');
  glyph(glyphs.good, 'good', 'goal achieved');
  glyph(glyphs.change, '', 'situation change');
  glyph(glyphs.clock, 'bad', 'time out');
  glyph(glyphs.bad, 'bad', 'failed or rejected');
  mark('accepted', '1', 'event, accepted');
  mark('rejected', '\u00d7 1', 'rejected');
  mark('unchanged', '1', 'changes no behavior');
  legend.append(html('span', '', hasVariables
    ? 't, r, s, f after the number: made by a timeout, a reactive start, the situation, a fault'
    : 't, r, f after the number: made by a timeout, a reactive start, a fault'));
}
