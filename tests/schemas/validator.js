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

/**
 * Validates the schemas, too, and refuses keywords that are unknown or have no effect. Conditions
 * require what others describe.
 */
function makeValidator(schemas) {
  const ajv = new Ajv({strict: true, strictRequired: false, allowUnionTypes: true});
  ajv.addVocabulary(['deprecationMessage', 'patternErrorMessage']); // for editors
  ajv.addSchema([...schemas]);
  return ajv;
}

function idOf(name) {
  return `urn:cbc:schema:${name}:1`;
}

module.exports = {idOf, inputs, makeValidator, readSchemas};
