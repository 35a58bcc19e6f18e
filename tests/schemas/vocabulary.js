// What the names of members say about their values, in all documents.
'use strict';

/** Objects whose members have the names of tasks or behaviors. */
const mapsByName = new Set(['active', 'queue', 'requests', 'running', 'situation']);

/** Texts of which there are few. */
const words = new Set([
  'cause',
  'execution_goal',
  'kind',
  'mark',
  'op',
  'origin',
  'outcome',
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

/** Whether the object may be without this member. */
function isOptional(object, name) {
  if (name === 'behavior') return object.kind === 'performance';
  if (name === 'error') return 'events' in object; // of a run; not of a line
  return ['alternatives', 'parameters', 'priority', 'state', 'stats', 'why'].includes(name);
}

module.exports = {hasPattern, isFree, isOptional, mapsByName, mayBeEmpty, mayBeOfAnyType, words};
