// Few documents that have all that there is.
'use strict';

const {isFree, isMapByName, words} = require('./vocabulary');

/** What a document has: members, types of values, and words. */
function* features(node, place = '') {
  const isMap = isMapByName(place);
  for (const [name, value] of Object.entries(node)) {
    const here = `${place}/${isMap || Array.isArray(node) ? '*' : name}`;
    const kind = node.kind ?? node.objective; // members of one name mean different things
    yield `${here} ${value === null ? 'null' : typeof value} ${words.has(name) ? value : kind}`;
    if (value !== null && typeof value === 'object' && !isFree(name, value)) {
      yield* features(value, here);
    }
  }
}

/** The small documents with something that none before them has. */
function takeSamples(documents) {
  const largest = 10000; // in characters
  const seen = new Set();
  return documents.filter(({schema, size, document}) => {
    if (size > largest) return false;
    const before = seen.size;
    for (const feature of features(document)) seen.add(`${schema} ${feature}`);
    return seen.size > before;
  });
}

module.exports = {takeSamples};
