// Catalogs with look-ups, and events in words.

/** A catalog with look-ups. */
class Catalog {
  constructor(data) {
    this.supporting = data.supporting; // tasks that do not start on request
    this.variables = new Map(data.variables.map(({ variable, values }) => [variable, values]));
    this.taskPlace = new Map(data.tasks.map((name, place) => [name, place]));
    this.behaviorPlace = new Map(data.behaviors.map((behavior, place) => [behavior.name, place]));
    this.behaviors = new Map(data.behaviors.map((behavior) => [behavior.name, behavior]));
    this.performers = new Map(data.tasks.map((name) => [name, []]));
    for (const behavior of data.behaviors) {
      for (const entry of behavior.performs) this.performers.get(entry.task).push(behavior.name);
    }
    this.lists = new Map(); // of each task: the exclusivity lists it is in
    for (const list of data.exclusive) {
      for (const task of list) this.lists.set(task, [...(this.lists.get(task) ?? []), list]);
    }
  }

  excludes(task, other) {
    return (this.lists.get(task) ?? []).some((list) => list.includes(other));
  }

  requires(behavior, task) {
    return (this.behaviors.get(behavior)?.requires ?? []).includes(task);
  }

  /** The first variable that a behavior names and whose value is none that it names, or undefined. */
  findMisfit(behavior, values) {
    return Object.entries(this.behaviors.get(behavior)?.situation ?? {})
      .find(([variable, fitting]) => !fitting.includes(values.get(variable)))?.[0];
  }

  suitability(behavior, task) {
    return this.behaviors.get(behavior)?.performs.find((entry) => entry.task === task)?.suitability;
  }

  /** Names in sentences: a task and a behavior may have the same one. */
  task(name) {
    return this.behaviors.has(name) ? `task ${name}` : name;
  }

  behavior(name) {
    return this.performers.has(name) ? `behavior ${name}` : name;
  }

  taskList(names) {
    return names.map((name) => this.task(name)).join(', ');
  }

  sortTasks(names) {
    return [...names].sort((a, b) => this.taskPlace.get(a) - this.taskPlace.get(b));
  }

  sortBehaviors(names) {
    return [...names].sort((a, b) => this.behaviorPlace.get(a) - this.behaviorPlace.get(b));
  }
}

/** Whether an event is one that is accepted or rejected. */
const isAsked = (event) => ['start', 'stop', 'finish', 'reconsider'].includes(event.verb);

const describeValue = (variable, value) => `${variable} is ${value}`;

/** Of `situation`, the names of `variables` have values, all others are behaviors. */
const describeSituation = (situation, variables) =>
  Object.entries(situation)
    .map(([name, value]) => {
      if (get(variables, name) !== undefined) return describeValue(name, value);
      return `${name} ${value ? 'available' : 'unavailable'}`;
    })
    .join(', ');

/** The same of an event. */
const situationOf = (event) => describeSituation(event.situation ?? {}, event.variables ?? {});

/** An event in a line, without its outcome. */
function describeEvent(event, catalog) {
  let text = event.verb;
  if (event.verb === 'wait') return 'wait';
  if (event.verb === 'situation') return `situation: ${situationOf(event)}`;
  if (event.task !== undefined) {
    text += ` task ${event.task}` + (event.name === null ? ', which nothing performs' : ` (${event.name})`);
  } else if (event.name !== undefined) {
    const isOfTask = event.verb === 'start' || event.verb === 'stop';
    text += ` ${isOfTask ? event.name : catalog.behavior(event.name)}`;
  }
  if (event.priority !== undefined) text += `, priority ${event.priority}`;
  if (event.verb === 'finish') text += `: ${words(event.cause)}`;
  if (event.parameters !== undefined) text += ` ${JSON.stringify(event.parameters)}`;
  if (event.origin === 'timeout') text += ' (by the clock)';
  if (event.origin === 'reactive') text += ' (reactive start)';
  if (event.verb === 'reconsider') return `${text} (after the ${event.origin})`;
  if (event.origin === 'situation') text += ' (it no longer fits)';
  if (event.origin === 'fault') text += ' (its activation could not be taken back)';
  return text;
}

/** The same for a place where it says elsewhere what the situation is. */
const nameEvent = (event, catalog) => (event.verb === 'situation' ? 'situation' : describeEvent(event, catalog));
