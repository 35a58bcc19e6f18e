// A validator that knows all schemas of the repository.
'use strict';

const Ajv = require('ajv/dist/2020');
const fs = require('fs');
const path = require('path');

/** What cbc reads; all others are of what it writes. */
const inputs = new Set(['catalog', 'properties', 'script', 'settings']);

/** All schemas, by name. */
function readSchemas(root) {
  const folder = path.join(root, 'schemas');
  const files = fs.readdirSync(folder).filter((file) => file.endsWith('.json'));
  return new Map(
    files.map((file) => [
      path.basename(file, '.json'),
      JSON.parse(fs.readFileSync(path.join(folder, file), 'utf8')),
    ])
  );
}

/** Refuses keywords that are unknown or have no effect. Conditions require what others describe. */
function makeStrict(schemas, options) {
  const ajv = new Ajv({strict: true, strictRequired: false, allowUnionTypes: true, ...options});
  ajv.addVocabulary(['deprecationMessage', 'patternErrorMessage']); // for editors
  ajv.addSchema(schemas);
  return ajv;
}

function idOf(name) {
  return `urn:cbc:schema:${name}:1`;
}

/** Validates the schemas, too. In those for editors, types are in alternatives beside the keywords for them. */
function makeValidator(schemas) {
  const all = [...schemas];
  const forEditors = new Set([...inputs].map(idOf));
  const written = all.filter(({$id}) => !forEditors.has($id));
  const strict = makeStrict(written, {});
  for (const {$id} of written) strict.getSchema($id);
  return makeStrict(all, {strictTypes: false});
}

module.exports = {idOf, inputs, makeValidator, readSchemas};
