// The robot to drive: what can be asked of it, and what it does. Each control stands for an entry of a mission.

/** What an event would do, in a line: from a move of cbc.what-if/1. `isActive`: the behavior that it is about. */
function describeMove(move, isActive) {
  const started = Object.entries(move.started).map(([task, behavior]) => (task === behavior ? `+${task}` : `+${task} (${behavior})`));
  const changed = Object.entries(move.changed).map(([task, behavior]) => `${task} \u2192 ${nameOfChange(behavior)}`);
  const stopped = move.stopped.map((task) => `\u2212${task}`);
  const failed = move.failed.map((name) => `${typeof name === 'string' ? name : name.behavior} would fail`);
  const effects = [...started, ...changed, ...stopped, ...failed];
  if (move.outcome === 'rejected') {
    return `\u00d7 would be rejected: ${move.conflict.map(({ message }) => message).join('; ')}`;
  }
  if (effects.length > 0) return `would do: ${effects.join(', ')}`;
  return move.verb === 'fault' && isActive ? `would change nothing yet: ${move.name} goes on until it fails (press "fail" of its task)`
    : 'would change no behavior';
}

const nameOfChange = (change) => (typeof change === 'string' ? change : change.to ?? change.behavior);

const mostRows = 200; // of tasks or behaviors at once; the filter reaches the others

/** A control that is off keeps the focus, so that keys go on from there. */
const isOff = (button) => button.getAttribute('aria-disabled') === 'true';
const setOff = (button, isOffNow) => setState(button, 'aria-disabled', isOffNow);

/** Only what has changed is laid out again. */
function setState(button, name, value) {
  if (button.getAttribute(name) !== `${value}`) button.setAttribute(name, value);
}

/** A control that asks for an event, and says before what it would do. */
function eventButton(text, label, entry, { onAsk, onPreview }) {
  const button = buttonElement(text, () => (isOff(button) ? undefined : onAsk(entry())));
  button.setAttribute('aria-label', label);
  for (const name of ['pointerenter', 'focus']) button.addEventListener(name, () => onPreview(entry()));
  for (const name of ['pointerleave', 'blur']) button.addEventListener(name, () => onPreview(null));
  return button;
}

const inSeconds = (seconds) => `${seconds.toFixed(seconds < 10 ? 1 : 0)} s`;

class Robot {
  /** `asks`: {onAsk(entry), onPreview(entry or null), onWhy(task)}. */
  constructor(asks) {
    this.asks = asks;
    byId('filter').addEventListener('input', () => this.filter());
    byId('columns').addEventListener('keydown', (event) => this.moveFocus(event));
  }

  /** Another catalog. `requestable`: the tasks that a mission can start. */
  build(catalog, requestable) {
    this.catalog = catalog;
    this.requestable = requestable;
    this.shown = null;
    byId('situation').hidden = catalog.variables.size === 0;
    this.filter();
  }

  /** Makes the rows of the names that the filter leaves. */
  filter() {
    if (this.catalog === undefined) return;
    const wanted = byId('filter').value.trim().toLowerCase();
    const { taskPlace, behaviors, variables } = this.catalog;
    const fill = (id, names, makeRow) => {
      const found = [...names].filter((name) => name.toLowerCase().includes(wanted));
      const rows = new Map(found.slice(0, mostRows).map((name) => [name, makeRow(name)]));
      const rest = found.length - rows.size;
      const more = rest === 0 ? [] : [html('li', 'hint', `and ${rest} more: filter by name`)];
      byId(id).replaceChildren(...[...rows.values()].map((row) => row.item), ...more);
      return rows;
    };
    this.tasks = fill('tasks', taskPlace.keys(), (name) => this.taskRow(name, this.requestable.has(name)));
    this.behaviors = fill('behaviors', behaviors.keys(), (name) => this.behaviorRow(name));
    this.variables = fill('variables', variables.keys(), (name) => this.variableRow(name, variables.get(name)));
    if (this.shown !== null) this.show(...this.shown);
  }

  row(name) {
    const state = html('span', 'state');
    const buttons = html('span', 'buttons');
    const item = html('li', '', html('span', 'name', breakable(name)), state, buttons);
    return { item, state, buttons };
  }

  taskRow(name, isRequestable) {
    const row = this.row(name);
    const priority = () => Number(byId('priority').value) || 1;
    const start = eventButton('start', `start ${name}`, () => ({ start: name, ...(priority() === 1 ? {} : { priority: priority() }) }), this.asks);
    const stop = eventButton('stop', `stop ${name}`, () => ({ stop: name }), this.asks);
    const finish = eventButton('finish', `finish ${name}`, () => ({ finish: { task: name } }), this.asks);
    const fail = eventButton('fail', `fail ${name}`, () => ({ finish: { task: name }, cause: 'process_failure' }), this.asks);
    const why = buttonElement('why?', () => this.asks.onWhy(name));
    why.setAttribute('aria-label', `why ${name} runs or not`);
    setOff(start, !isRequestable);
    if (!isRequestable) start.title = 'Nobody may ask for it: it runs for a behavior that requires it, or starts by itself';
    row.buttons.append(start, stop, finish, fail, why);
    return { ...row, stop, finish, fail };
  }

  behaviorRow(name) {
    const row = this.row(name);
    const fault = eventButton('fault', `fault of ${name}`, () => ({ fault: name }), this.asks);
    const repair = eventButton('repair', `repair ${name}`, () => ({ repair: name }), this.asks);
    row.buttons.append(fault, repair);
    return { ...row, fault, repair };
  }

  variableRow(name, values) {
    const row = this.row(name);
    const choices = new Map(values.map((value) => {
      const written = values.join() === 'true,false' || values.join() === 'false,true' ? value === 'true' : value;
      const button = eventButton(`${value}`, `${name} is ${value}`, () => ({ situation: { [name]: written } }), this.asks);
      return [`${value}`, button];
    }));
    row.buttons.append(...choices.values());
    row.buttons.setAttribute('role', 'group');
    row.buttons.setAttribute('aria-label', name);
    return { ...row, choices };
  }

  /** What the controls say after an event of a run. `due`: {timeouts, queue, now}, in seconds. */
  show(run, number, due) {
    this.shown = [run, number, due];
    const { running, requests, queue } = run.stateAt(number);
    const values = run.values[number];
    for (const [name, row] of this.tasks) {
      const behavior = get(running, name);
      const request = get(requests, name);
      const waits = get(queue, name);
      const suspended = get(run.suspended(number), name);
      const timeout = get(due.timeouts, name);
      const parts = [
        behavior === undefined ? '' : behavior === name ? 'runs' : `runs: ${behavior}`,
        request === undefined ? '' : `requested${request === 1 ? '' : `, priority ${request}`}`,
        suspended === undefined ? '' : `suspended, priority ${suspended}`,
        waits === undefined ? '' : waits === null ? 'waits for a change' : `starts by itself in ${inSeconds(waits - due.now)}`,
        timeout === undefined ? '' : `times out in ${inSeconds(timeout - due.now)}`,
      ];
      this.say(row, parts, behavior === undefined ? '' : request === undefined ? 'required' : 'requested');
      setOff(row.stop, behavior === undefined && request === undefined && waits === undefined && suspended === undefined);
      setOff(row.finish, behavior === undefined);
      setOff(row.fail, behavior === undefined);
    }
    const [faulty, untried, unavailable, misfits] = ['faulty', 'untried', 'unavailable', 'misfits'].map((kind) => new Set(run[kind][number]));
    const performed = new Map();
    for (const [task, behavior] of Object.entries(running)) performed.set(behavior, [...(performed.get(behavior) ?? []), task]);
    for (const [name, row] of this.behaviors) {
      const parts = [
        performed.has(name) ? `active for ${performed.get(name).join(', ')}` : '',
        faulty.has(name) ? 'faulty' : '', untried.has(name) ? 'has failed, is not tried again' : '', unavailable.has(name) ? 'unavailable' : '',
        misfits.has(name) ? 'does not fit the situation' : '',
      ];
      this.say(row, parts, performed.has(name) ? 'requested' : faulty.has(name) ? 'faulty' : '');
      setOff(row.fault, faulty.has(name));
      setOff(row.repair, !faulty.has(name) && !untried.has(name));
    }
    for (const [name, row] of this.variables) {
      for (const [value, button] of row.choices) {
        setState(button, 'aria-pressed', `${values.get(name)}` === value);
      }
    }
  }

  /** Arrow keys go from button to button, and from row to row, so that one need not pass all of them. */
  moveFocus(event) {
    const row = event.target.closest('li');
    const rowStep = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    const buttonStep = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (row === null || (rowStep ?? buttonStep) === undefined) return;
    event.preventDefault();
    event.stopPropagation(); // to the page they mean other events
    const buttons = [...row.querySelectorAll('button')];
    const place = buttons.indexOf(event.target);
    if (buttonStep !== undefined) {
      const others = buttonStep > 0 ? buttons.slice(place + 1) : buttons.slice(0, place).reverse();
      others[0]?.focus();
      return;
    }
    const next = rowStep > 0 ? row.nextElementSibling : row.previousElementSibling;
    const there = next?.querySelectorAll('button') ?? [];
    there[Math.min(place, there.length - 1)]?.focus();
  }

  say(row, parts, look) {
    const text = parts.filter((part) => part !== '').join(' \u00b7 ');
    if (row.state.textContent !== text) row.state.textContent = text;
    if (row.item.dataset.look !== look) row.item.dataset.look = look;
  }
}
