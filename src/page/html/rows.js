// The rows of the timeline: situation variables, then tasks with their behaviors; and their names.

const taskHeight = 21;
const behaviorHeight = 20;

const rowKey = (...names) => JSON.stringify(names);

class Rows {
  /** `wantsAll`: those of the whole catalog, not only of what occurs. `wanted`: whether a name is asked
   * for, or null; if any is, tasks without such a name have no rows. */
  constructor(run, wantsAll, wanted) {
    this.run = run;
    this.list = []; // {variable | task [, behavior], y, height}
    this.places = new Map();
    let y = 0;
    const add = (row, key, height) => {
      Object.assign(row, { y, height, spans: [] });
      this.list.push(row);
      this.places.set(key, row);
      y += height;
    };
    for (const variable of run.catalog.variables.keys()) add({ variable }, rowKey('', variable, ''), behaviorHeight);
    if (y > 0) y += 5;
    for (const { task, behaviors } of this.chosenTasks(run.rows(wantsAll), wanted)) {
      add({ task }, rowKey(task), taskHeight);
      for (const behavior of behaviors) add({ task, behavior }, rowKey(task, behavior), behaviorHeight);
      y += 3;
    }
    this.height = y;
    this.ofBehavior = new Map();
    for (const row of this.list) {
      if (row.behavior !== undefined) this.ofBehavior.set(row.behavior, [...(this.ofBehavior.get(row.behavior) ?? []), row]);
    }
    this.ofSpan = []; // undefined: not shown
    this.addSpans();
  }

  /** Finds the rows of further spans. */
  addSpans() {
    const { spans } = this.run;
    for (let place = this.ofSpan.length; place < spans.length; ++place) {
      const row = this.find(spans[place].task, spans[place].behavior);
      this.ofSpan.push(row);
      row?.spans.push(spans[place]);
    }
  }

  chosenTasks(tasks, wanted) {
    if (wanted === null) return tasks;
    const chosen = tasks.filter(({ task, behaviors }) => wanted(task) || behaviors.some(wanted));
    return chosen.length > 0 ? chosen : tasks;
  }

  /** The row of a task, or of a task and a behavior. */
  find(...names) {
    return this.places.get(rowKey(...names));
  }

  ofVariable(variable) {
    return this.places.get(rowKey('', variable, ''));
  }

  static nameOf({ variable, task, behavior }) {
    return variable ?? behavior ?? task;
  }

  static kindOf({ variable, behavior }) {
    if (variable !== undefined) return 'variable';
    return behavior !== undefined ? 'behavior' : 'task';
  }

  static indentOf(row) {
    return Rows.kindOf(row) === 'behavior' ? 24 : 10;
  }

  /** The names in order, shortened to a width. Behaviors of a task whose names would be the same then
   * show what tells them apart. */
  fittingNames(width, size) {
    const texts = this.list.map((row) =>
      shortenMiddle(Rows.nameOf(row), width - Rows.indentOf(row), looks[Rows.kindOf(row)].style, size));
    const places = new Map(); // of each text
    this.list.forEach((row, place) => {
      if (row.behavior === undefined) return;
      const key = rowKey(row.task, texts[place]);
      places.set(key, [...(places.get(key) ?? []), place]);
    });
    for (const same of places.values()) {
      if (same.length === 1) continue;
      const parts = distinctParts(same.map((place) => this.list[place].behavior));
      same.forEach((place, index) => {
        const room = width - Rows.indentOf(this.list[place]);
        if (parts[index] !== null) texts[place] = shortenMiddle(parts[index], room, looks.behavior.style, size);
      });
    }
    return texts;
  }

  /** The width that the names take, at most `most`. */
  nameWidth(most) {
    const widths = this.list.map((row) =>
      measure(Rows.nameOf(row), looks[Rows.kindOf(row)].style, 12) + Rows.indentOf(row) + 12);
    return Math.ceil(Math.min(most, Math.max(110, ...widths)));
  }
}
