// Damage that every schema must see, wherever it is.
'use strict';

const {
  hasPattern,
  isFree,
  isMapByName,
  isOptional,
  mayBeEmpty,
  mayBeOfAnyType,
  mayBeTruth,
  words,
} = require('./vocabulary');

function wrongValues(name, value, isTruth) {
  if (mayBeOfAnyType.has(name) && value === null) return [];
  const wrong = [typeof value === 'boolean' || isTruth ? 7 : true];
  if (typeof value === 'number') wrong.push(-1);
  if (typeof value === 'string' && !mayBeEmpty.has(name)) wrong.push('');
  if (words.has(name) || hasPattern.has(name)) wrong.push('odd one');
  return wrong;
}

/**
 * Damages the document in one place after the other, and says how: a member is missing, or one too
 * many, a value is of a wrong type, below 0, empty, or an unknown word.
 */
function* damages(node, place = '') {
  const ownName = place.split('/').at(-1);
  const isTruth = mayBeTruth(place, node);
  const hasFixedMembers = !Array.isArray(node) && !isMapByName(place);
  for (const [name, value] of Object.entries(node)) {
    const here = `${place}/${name}`;
    if (hasFixedMembers && !isOptional(node, name)) {
      delete node[name];
      yield `${here} is missing`;
    }
    for (const wrong of wrongValues(Array.isArray(node) ? ownName : name, value, isTruth)) {
      node[name] = wrong;
      yield `${here} is ${JSON.stringify(wrong)}`;
    }
    node[name] = value;
    if (value !== null && typeof value === 'object' && !isFree(name, value)) {
      yield* damages(value, here);
    }
  }
  if (hasFixedMembers) {
    node.foreign = 1;
    yield `${place}/foreign is one too many`;
    delete node.foreign;
  }
}

module.exports = {damages};
