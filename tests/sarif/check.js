// Validates the SARIF log on standard input; see check.sh.
'use strict';

const Ajv = require('ajv');
const fs = require('fs');
const schema = require('@microsoft/jest-sarif/lib/schemas/sarif-2.1.0-rtm.5.json');

const ajv = new Ajv({allErrors: true, schemaId: 'auto'});
ajv.addMetaSchema(require('ajv/lib/refs/json-schema-draft-04.json'));
const validate = ajv.compile(schema);

function refuse(reason) {
  console.error(`check.js: ${reason}`);
  process.exit(1);
}

// An example of a log that the schema must refuse, so that its silence means something.
function damage(log) {
  const damaged = structuredClone(log);
  damaged.runs[0].tool.driver.rules[0].defaultConfiguration.level = 'fatal';
  return damaged;
}

const log = JSON.parse(fs.readFileSync(0, 'utf8'));
if (!validate(log)) {
  refuse(`not valid:\n${ajv.errorsText(validate.errors, {dataVar: 'log', separator: '\n'})}`);
}
if (validate(damage(log))) refuse('the schema does not see damage');
const [run] = log.runs;
console.log(`valid: ${run.tool.driver.rules.length} rules, ${run.results.length} results`);
