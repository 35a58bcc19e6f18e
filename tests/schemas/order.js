// The order of members, which no schema can demand: it is that of the properties in the schemas.
'use strict';

const {isFree, isMapByName} = require('./vocabulary');

/**
 * The kinds of objects in a schema: what is required, and the names of members in order; where a
 * kind shares members with others, its own, and those.
 */
function* kindsIn(part, schema = part) {
  if (part.required && part.properties) {
    const shared = schema.$defs[part.$ref?.replace('#/$defs/', '')];
    const orders = [part, shared ?? part].map(({properties}) => Object.keys(properties));
    yield {required: part.required, orders};
  }
  for (const value of Object.values(part)) {
    if (value !== null && typeof value === 'object') yield* kindsIn(value, schema);
  }
}

/** Whether an object with members of these names is of the kind, and has them in order. */
function fits(names, {required, orders}) {
  const isInOrder = (order) => {
    const places = names.map((name) => order.indexOf(name)).filter((place) => place >= 0);
    return places.every((place, i) => i === 0 || place > places[i - 1]);
  };
  return (
    required.every((name) => names.includes(name)) &&
    names.every((name) => orders.flat().includes(name)) &&
    orders.every(isInOrder)
  );
}

/** The objects in a document whose members are not names of tasks or behaviors, nor free. */
function* objectsIn(node, place = '') {
  if (node === null || typeof node !== 'object' || isFree(place.split('/').at(-1), node)) return;
  if (!Array.isArray(node) && !isMapByName(place)) yield node;
  for (const [name, value] of Object.entries(node)) yield* objectsIn(value, `${place}/${name}`);
}

/** The first object in a document whose members are not in the order of any kind of object. */
function findDisorder(document, kinds) {
  for (const object of objectsIn(document)) {
    const names = Object.keys(object);
    if (!kinds.some((kind) => fits(names, kind))) return object;
  }
  return undefined;
}

module.exports = {findDisorder, kindsIn};
