// What the names of members say about their values, in all documents.
'use strict';

/** Objects whose members have the names of tasks, behaviors or situation variables. */
const mapsByName = new Set([
  'active',
  'changed',
  'initially',
  'queue',
  'queued',
  'requested',
  'requests',
  'running',
  'runs',
  'situation',
  'start',
  'start_refused',
  'started',
  'variables',
]);

/** Whether the object at a place is one of them; those in the list `never` have no name. */
function isMapByName(place) {
  const names = place.split('/');
  return mapsByName.has(names.at(-1)) || names.at(-2) === 'never';
}

/** Texts of which there are few. */
const words = new Set([
  'cause',
  'effect',
  'execution_goal',
  'kind',
  'mark',
  'op',
  'origin',
  'outcome',
  'result',
  'rule',
  'schema',
  'severity',
  'status',
  'subject',
  'verb',
  'view',
]);

/** Texts that have a pattern. */
const hasPattern = new Set([
  'content_digest',
  'digest',
  'from',
  'id',
  'search_space',
  'space',
  'to',
  'version',
  'written_by',
]);

/** Texts that may be empty. */
const mayBeEmpty = new Set([
  'after',
  'allowed_values',
  'before',
  'catalog',
  'file',
  'package',
  'parameters',
  'script',
]);

/** What type the value has depends on what it is the value of. */
const mayBeOfAnyType = new Set(['after', 'before']);

/** Whether the value is what a user gave, of any form. */
function isFree(name, value) {
  return name === 'parameters' && !Array.isArray(value);
}

/** Whether what lies there is a text or a boolean, as values of situation variables are. */
function mayBeTruth(place, object) {
  const isInSituation = place
    .split('/')
    .some((name) => ['initially', 'never', 'situation', 'variables'].includes(name));
  return isInSituation || (object.name ?? '').toString().startsWith('situation ');
}

/** Whether the object says why a task stopped. */
function isStop(object) {
  return 'task' in object && 'cause' in object && !('verb' in object);
}

/** Whether the object may be without this member. */
function isOptional(object, name) {
  if (name === 'task') return 'verb' in object; // of a finish; not of what is about tasks
  if (['conflict', 'message'].includes(name)) return isStop(object);
  if (name === 'states') return 'numbers' in object; // of a tuning; not of others
  if (['breaks', 'moves'].includes(name)) return 'instead' in object; // of a tuning
  if (name === 'together') return 'constraints' in object || 'never' in object; // not of a pair
  if (name === 'situation') return object.kind === 'behavior' || 'event' in object;
  if (name === 'variables') return !('groups' in object) && !('unconditional' in object);
  if (name === 'behavior') return ['minimum_decided', 'minimum_removed', 'performance'].includes(object.kind);
  if (['effects', 'overrides'].includes(name)) return 'groups' in object; // of a report; not of a task
  if (name === 'script') return 'change' in object; // of a mutant; not of a property
  const ofExplorations = ['file', 'groups', 'decided', 'states_at_depth', 'outcomes'];
  if (ofExplorations.includes(name)) return 'group' in object;
  if (name === 'error') return 'events' in object; // of a run; not of a line
  if (name === 'notes') return 'conflict' in object; // of a failed expectation; not of a report of lint
  const others = [
    'against',
    'alternatives',
    'assumptions',
    'best',
    'by_constraints',
    'complete_order',
    'due',
    'faults_except',
    'faults_of',
    'frozen',
    'in_some_situation',
    'missions',
    'incomplete',
    'parameters',
    'priority',
    'state',
    'stats',
    'timeouts',
    'waiting',
    'why',
  ];
  return others.includes(name);
}

module.exports = {
  hasPattern,
  isFree,
  isMapByName,
  isOptional,
  mayBeEmpty,
  mayBeOfAnyType,
  mayBeTruth,
  words,
};
