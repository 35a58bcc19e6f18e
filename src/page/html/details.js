// The details of an event: what it did, why, which answer was chosen; the state after it; and what is
// shown beside the pointer.

const outcomeSigns = { accepted: '\u2713', rejected: '\u00d7', unchanged: '\u2013' };

function outcomeElement(event) {
  if (!isAsked(event)) return html('span', 'outcome unchanged', '');
  return html('span', `outcome ${event.outcome}`, `${outcomeSigns[event.outcome]} ${event.outcome}`);
}

const reasonElements = (event) =>
  event.conflict.map((reason) => html('p', 'failed', breakable(reason.message)));

function sentenceElements(run, number) {
  const failures = (run.failures.get(number) ?? []).map((failure) => failureElement(run, failure));
  return failures.concat(run.story.sentences(number).map(({ text, why, isBad }) => {
    const line = html('p', isBad ? 'failed' : '', breakable(text));
    if (why !== '') line.append(html('span', 'why', breakable(` \u2013 ${why}`)));
    return line;
  }));
}

function failureElement(run, failure) {
  const place = `${run.data.script}:${failure.line}`;
  const line = html('p', 'alarm', `failed expectation: ${failure.message} (${place})`);
  const command = `cbc tune ${run.data.catalog} ${run.data.script}`;
  line.append(html('span', 'why', breakable(` \u2013 which number of the catalog would have to change: ${command}`)));
  return line;
}

/** A row of P, T, S, behavior (and who replaced it, or whom it replaced), task, cause. */
function changeRow(run, number, change) {
  const behavior = html('td', '', breakable(change.behavior));
  const note = run.story.note(number, change);
  if (note !== '') behavior.append(html('div', 'why', breakable(note)));
  return html('tr', change.success ? '' : 'failed',
    html('td', 'sign', change.priority === null ? '.' : `${change.priority}`),
    html('td', 'sign', change.op === 'activate' ? '+' : '\u2212'),
    html('td', 'sign', change.success ? 'Y' : 'N'),
    behavior, html('td', '', breakable(change.tasks.join(', '))), html('td', 'cause', change.cause));
}

function changeTable(run, number) {
  const head = headRow('priority', '\u00b1', 'ok', 'behavior', 'task', 'cause');
  const titles = ['priority of the request behind it', '+ activation, \u2212 deactivation', 'success: Y or N'];
  titles.forEach((title, place) => {
    head.rows[0].cells[place].title = title;
    head.rows[0].cells[place].className = 'sign';
  });
  const rows = run.event(number).changes.map((change) => changeRow(run, number, change));
  return html('table', 'changes', head, html('tbody', '', ...rows));
}

// Why an answer was chosen ---------------------------------------------------------------------------

function objectivePairs(objective, { supporting }) {
  return pairs([
    ['requests satisfied', `${objective.satisfied} of ${objective.requests}`],
    ['suitability, product', formatPercent(objective.suitability)],
    ['supporting tasks running', `${Math.round((1 - objective.idle) * supporting)} of ${supporting}`],
    ['behaviors changed', `${objective.changes}`],
  ]);
}

const performerOf = (one) => (one === null ? 'does not run' : `${one.behavior}, ${one.suitability} %`);

/** A share as the report writes it, an exact decimal, with all of its digits: "0.625" is "62.5 %". */
function percentOfDecimal(text) {
  const [whole, digits = ''] = text.split('.');
  const shifted = `${whole}${digits.slice(0, 2).padEnd(2, '0')}`.replace(/^0+(?=\d)/, '');
  return `${shifted}${digits.length > 2 ? `.${digits.slice(2)}` : ''} %`;
}

/** The tasks that have another behavior in an answer that was not chosen, factor by factor, and the
 * products if these decided. */
function differenceTable(differences, loses) {
  const rows = differences.map(({ task, chosen, alternative }) => html('tr', '',
    html('td', '', breakable(task)), html('td', '', breakable(performerOf(chosen))),
    html('td', '', breakable(performerOf(alternative)))));
  if (loses?.objective === 'suitability') {
    rows.push(html('tr', 'product', html('td', '', 'product of all that runs'),
      html('td', '', percentOfDecimal(loses.chosen)), html('td', '', percentOfDecimal(loses.alternative))));
  }
  return html('table', 'differences', headRow('task', 'chosen', 'instead'), html('tbody', '', ...rows));
}

/** The explanation of a choice: its message, which says what decided, and where the alternative differs. */
function whyElements({ message, differences = [], loses, notes = [] }, catalog) {
  if (differences.length === 0) return [html('p', 'message', breakable(message))];
  const [decision] = message.split(` ${catalog.task(differences[0].task)}: `); // the table has the rest
  return [html('p', 'message', breakable(decision)), differenceTable(differences, loses),
          ...notes.map((note) => html('p', 'message', breakable(note)))];
}

function alternativeElement({ running, objective }) {
  const performers = Object.entries(running).map(([task, behavior]) => `${task}: ${behavior}`).join(', ');
  const value = `suitability ${formatPercent(objective.suitability)}, ${quantity(objective.changes, 'change')}`;
  return html('li', '', breakable(performers), html('span', 'why', ` \u2013 ${value}`));
}

/** Of an event: why its failed expectations failed, and what --why and --alternatives asked for. */
function explanationElements(run, number, onChoose) {
  const parts = [];
  const add = (title, elements) => {
    if (elements.length > 0) parts.push(html('h3', '', title), ...elements);
  };
  for (const failure of run.failures.get(number) ?? []) {
    for (const why of failure.why ?? []) {
      const elements = whyElements(why, run.catalog);
      const decider = why.event === null ? 0 : run.numberOf(why.event);
      if (decider >= 1 && decider !== number) {
        elements.push(buttonElement(`to event ${why.event}, which decided it`, () => onChoose(decider)));
      }
      add(`Why not as expected (line ${failure.line})`, elements);
    }
  }
  const event = run.event(number);
  add('Why', (event.why ?? []).flatMap((why) => whyElements(why, run.catalog)));
  const configurations = event.alternatives?.configurations ?? [];
  if (configurations.length > 0) {
    add('Alternatives, the best one first', [html('ol', '', ...configurations.map(alternativeElement))]);
  }
  return parts;
}

/** How any answer is chosen, in two sentences. */
function choiceElement() {
  const element = html('details', 'choice', html('summary', '', 'How an answer is chosen'),
    html('p', '', 'Requests come first: as many as possible are satisfied, those with higher priorities before others. ' +
      'Among the answers that do so, the one with the highest product of the suitabilities of all that runs is chosen, ' +
      'then the one with the fewest supporting tasks, then the one with the fewest changes.'));
  element.setAttribute('aria-label', 'How an answer is chosen');
  return element;
}

/** The details of an event. `elements`: {title, body}. */
function fillDetail(elements, run, number, onChoose) {
  const event = run.event(number);
  elements.title.textContent = `Event ${run.indexOf(number)} at ${formatTime(event.time)} s`;
  const parts = [html('p', 'headline', breakable(nameEvent(event, run.catalog)), ' ', outcomeElement(event))];
  parts.push(...sentenceElements(run, number));
  const add = (title, element) => parts.push(html('h3', '', title), element);
  if (event.conflict.length > 0) {
    add('Reasons: without any one of them it would be possible', html('ul', '', ...event.conflict.map(
      (reason) => html('li', '', `${reason.message} `, html('span', 'why', `[${words(reason.kind)}]`)))));
  }
  parts.push(...explanationElements(run, number, onChoose));
  if (event.changes.length > 0) add('Changes, in order', changeTable(run, number));
  if (event.stopped_tasks.length > 0) {
    add('Stopped tasks', html('ul', '', ...event.stopped_tasks.map(({task, cause, message}) =>
      html('li', '', `${task} (${words(cause)})`, message === undefined ? '' : html('p', '', message)))));
  }
  const numbers = html('div', 'numbers');
  if (event.objective !== null) {
    numbers.append(html('div', '', html('h3', '', 'The answer'), objectivePairs(event.objective, run.catalog), choiceElement()));
  }
  if (event.search !== null) {
    const search = Object.entries(event.search).map(([name, value]) => [words(name), `${value}`]);
    numbers.append(html('div', '', html('h3', '', 'Search'), pairs(search)));
  }
  elements.body.replaceChildren(...parts, numbers);
}

/** The state after an event. */
function fillState(body, run, number) {
  const event = run.event(number);
  const rows = run.catalog.sortTasks(Object.keys(event.running)).map((task) => html('tr', '',
    html('td', '', breakable(task)), html('td', '', breakable(event.running[task])),
    html('td', '', breakable(run.story.whyRuns(number, task)))));
  const parts = [];
  if (rows.length === 0) {
    parts.push(html('p', '', 'No task runs.'));
  } else {
    parts.push(html('table', '', headRow('task', 'behavior', 'because'), html('tbody', '', ...rows)));
  }
  const queue = Object.entries(event.queue).filter(([, due]) => due !== null)
    .map(([task, due]) => `${task} at ${formatTime(due)} s`);
  const more = [];
  if (run.values[number].size > 0) {
    more.push(['situation', [...run.values[number]].map(([name, value]) => describeValue(name, value)).join(', ')]);
  }
  if (queue.length > 0) more.push(['reactive starts due', queue.join(', ')]);
  if (run.waiting[number].length > 0) more.push(['waiting reactive tasks', run.waiting[number].join(', ')]);
  const suspended = Object.entries(run.suspended(number)).map(([task, priority]) => `${task}, priority ${priority}`);
  if (suspended.length > 0) more.push(['suspended requests', suspended.join(', ')]);
  if (run.misfits[number].length > 0) more.push(['do not fit', run.misfits[number].join(', ')]);
  if (run.unavailable[number].length > 0) more.push(['unavailable', run.unavailable[number].join(', ')]);
  if (run.faulty[number].length > 0) more.push(['faulty', run.faulty[number].join(', ')]);
  if (run.untried[number].length > 0) more.push(['failed, not tried again', run.untried[number].join(', ')]);
  if (more.length > 0) parts.push(pairs(more));
  body.replaceChildren(...parts);
}

/** What is shown beside the pointer: an event, several that are folded, or a span. */
function tipContent(run, target) {
  if (target.span !== undefined) return spanTip(run, target.span);
  const [number] = target.numbers;
  const event = run.event(number);
  if (target.numbers.length > 1) return foldTip(run, target.numbers);
  return [html('strong', '', `${run.indexOf(number)} \u00b7 ${formatTime(event.time)} s \u00b7 ${nameEvent(event, run.catalog)} `),
          outcomeElement(event), ...reasonElements(event), ...sentenceElements(run, number)];
}

function foldTip(run, numbers) {
  const most = 6;
  const lines = numbers.slice(0, most).map((number) => {
    const event = run.event(number);
    return html('p', '', `${run.indexOf(number)} \u00b7 ${formatTime(event.time)} s \u00b7 ${describeEvent(event, run.catalog)}`);
  });
  if (numbers.length > most) lines.push(html('p', 'why', `and ${numbers.length - most} more`));
  return [html('strong', '', `${numbers.length} events; a click zooms to them`), ...lines];
}

function spanTip(run, span) {
  const placeOf = (number) =>
    number === 0 ? 'an event before these' : `${formatTime(run.timeAt(number))} s (event ${run.indexOf(number)})`;
  const end = span.to === null ? 'the end of the run' : placeOf(span.to);
  const parts = [
    html('strong', '', span.behavior),
    html('p', '', `performs ${span.task}, ${run.story.whyRuns(span.from, span.task) || span.cause}`),
    html('p', '', `from ${placeOf(span.from)} to ${end}`),
  ];
  for (const { from } of span.faults) parts.push(html('p', 'failed', `faulty from ${placeOf(from)} on: it goes on until it ends`));
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
