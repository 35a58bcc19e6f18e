// check.js PROGRAM CASES: validates what the program writes as JSON with the schemas; see check.sh.
'use strict';

const path = require('path');
const {damages} = require('./damages');
const {lies} = require('./lies');
const {takeSamples} = require('./samples');
const {goldenTexts, programTexts} = require('./texts');
const {idOf, inputs, makeValidator, readSchemas} = require('./validator');

const root = path.join(__dirname, '..', '..');
const [program, cases] = process.argv.slice(2).map((name) => path.resolve(name));

function refuse(reason) {
  console.error(`check.js: ${reason}`);
  process.exit(1);
}

const schemas = readSchemas(root);
const written = [...schemas.keys()].filter((name) => !inputs.has(name));
const ajv = makeValidator(schemas.values());

/** Of a schema, or of the part of it that a JSON pointer leads to. */
function validatorOf(name, pointer = '') {
  const id = idOf(name);
  const validate = ajv.getSchema(pointer ? `${id}#${pointer}` : id);
  return validate ?? refuse(`${name}.json has not the $id ${id}`);
}

/** The examples in a schema, each with the validator of the part that it is an example of. */
function* examplesIn(name, part, pointer = '') {
  for (const document of part.examples ?? []) {
    const source = `an example in ${name}.json${pointer}`;
    yield {schema: name, source, document, validate: validatorOf(name, pointer)};
  }
  for (const [key, value] of Object.entries(part)) {
    if (key === 'examples' || value === null || typeof value !== 'object') continue;
    yield* examplesIn(name, value, `${pointer}/${key}`);
  }
}

/** The documents in a text: the lines of a stream, or the whole. */
function documentsIn({schema, source, text}) {
  const validate = validatorOf(schema);
  const parts = schema === 'events' ? text.split('\n').filter(Boolean) : [text];
  return parts.map((part, place) => ({
    schema,
    source: `document ${place + 1} of ${source}`,
    size: part.length,
    document: JSON.parse(part),
    validate,
  }));
}

function checkValid(items) {
  for (const {source, document, validate} of items) {
    if (validate(document)) continue;
    const errors = ajv.errorsText(validate.errors, {separator: '\n'});
    refuse(`not valid: ${source}:\n${errors.slice(0, 4000)}`);
  }
}

/** A schema that accepts everything would find no fault: each damage must be refused. */
function checkDamages(items) {
  let count = 0;
  for (const {schema, source, document, validate} of items) {
    for (const damage of damages(document)) {
      if (validate(document)) refuse(`${schema}.json accepts ${source} where ${damage}`);
      ++count;
    }
  }
  return count;
}

/** Each lie is told in the first document that has occasion for it. */
function checkLies(documents) {
  let count = 0;
  for (const [schema, list] of Object.entries(lies)) {
    const validate = validatorOf(schema);
    for (const [what, find, say] of list) {
      const source = documents.find((item) => item.schema === schema && find(item.document));
      if (source === undefined) refuse(`no document has occasion for ${what}`);
      const document = structuredClone(source.document);
      const part = find(document);
      if (typeof say === 'function') say(part);
      else Object.assign(part, say);
      if (validate(document)) refuse(`${schema}.json accepts ${what}`);
      ++count;
    }
  }
  return count;
}

const examples = [...schemas].flatMap(([name, schema]) => [...examplesIn(name, schema)]);
checkValid(examples);

const documents = [...goldenTexts(cases), ...programTexts(root, cases, program)].flatMap(documentsIn);
checkValid(documents);
const least = {
  'catalog-dump': 100,
  coverage: 3,
  diff: 10,
  events: 500,
  graph: 20,
  lint: 5,
  mutants: 1,
  situation: 3,
  solve: 60,
  state: 40,
  sweep: 10,
  together: 3,
  tune: 20,
  verify: 15,
  'what-if': 50,
};
for (const name of written) {
  const found = documents.filter((item) => item.schema === name).length;
  if (!(found >= least[name])) refuse(`only ${found} documents of ${name}.json were found`);
}

const samples = takeSamples(documents);
const damaged = checkDamages(samples);
const told = checkLies(documents);
console.log(
  `valid: ${schemas.size} schemas, ${examples.length} examples, ${documents.length} documents; ` +
    `refused: ${damaged} damaged ones, ${told} that contradict themselves`
);
