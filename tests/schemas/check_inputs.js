// check_inputs.js PROGRAM SAMPLES: validates catalogs, scripts and property files with the schemas, and
// compares with what lint finds in them; see check.sh.
//
// A schema may refuse only what lint reports as an error, or an unknown key, which is a warning in a
// catalog. And it has to refuse what breaks one of the rules below, except where a mistake is listed
// that no schema can see.
'use strict';

const {spawnSync} = require('child_process');
const path = require('path');
const {catalog, edges} = require('./edges');
const {filesOfRepository} = require('./input_files');
const {Linter} = require('./linter');
const {inputs, idOf, makeValidator, readSchemas} = require('./validator');
const {readYaml} = require('./yaml');

const root = path.join(__dirname, '..', '..');
const [program, samples] = process.argv.slice(2).map((argument) => path.resolve(argument));

const expressible = new Set([
  'duplicate-key',
  'invalid-value',
  'missing-key',
  'on-request-and-reactive',
  'unknown-key',
  'wrong-type',
  'yaml-syntax',
]);

/** Mistakes that break these rules, by sample or file, and why a schema may not see them. */
const unseen = {
  'on request and reactive by default': 'the task says only one of the two',
  'tests/golden/cases/catalog_both_flags_by_default/catalog.yaml': 'the task says only one of the two',
  'tests/golden/cases/catalog_deep_nesting/catalog.yaml': 'a reader may bear more',
  'bad value': 'readers of YAML differ in what they refuse',
  'percentage too precise': 'a fraction has no exact value in binary',
  'performed twice': 'two entries with one name need not be equal',
  'tests/golden/cases/lint_rule_on_request_and_reactive/catalog.yaml': 'the task says only one of the two',
  'timeout out of range': 'one that is too precise is reported as such',
};

function refuse(reason) {
  console.error(`check_inputs.js: ${reason}`);
  process.exit(1);
}

const schemas = readSchemas(root);
const ajv = makeValidator([...inputs].map((name) => schemas.get(name)));
const linter = new Linter(program);

/** Why an editor with the schema refuses a text; empty if it does not. */
function refusal(schema, text) {
  const {refused, document} = readYaml(text);
  if (refused !== undefined) return `YAML: ${refused}`;
  const validate = ajv.getSchema(idOf(schema));
  return validate(document) ? '' : ajv.errorsText(validate.errors.slice(0, 3));
}

function mayBeRefused(findings) {
  return findings.some(([rule, severity]) => severity === 'error' || rule === 'unknown-key');
}

function checkSample({kind, text, rules, findings}) {
  const reason = refusal('catalog', text);
  if (reason && !mayBeRefused(findings)) {
    refuse(`a catalog of kind '${kind}' is refused (${reason}), but lint is content:\n${text}`);
  }
  if (!reason && rules.some((rule) => expressible.has(rule)) && !(kind in unseen)) {
    refuse(`a catalog of kind '${kind}' is accepted, which breaks ${rules}:\n${text}`);
  }
  return Boolean(reason);
}

function checkSamples() {
  const {status, stdout} = spawnSync(samples, [], {encoding: 'utf8', maxBuffer: 1 << 28});
  if (status !== 0) refuse(`${samples}: status ${status}`);
  const refused = {};
  const all = stdout
    .split('\n')
    .filter(Boolean)
    .map((line) => JSON.parse(line));
  for (const sample of all) (refused[sample.kind] ??= []).push(checkSample(sample));
  for (const kind of Object.keys(unseen)) {
    if (refused[kind]?.every(Boolean)) refuse(`the schema does see '${kind}'`);
  }
  return {samples: all.length, refused: Object.values(refused).flat().filter(Boolean).length};
}

function checkFiles() {
  const counts = {catalog: 0, script: 0, properties: 0, refused: 0};
  const broken = new Set();
  for (const {source, schema, text, findings} of filesOfRepository(root, linter)) {
    const reason = refusal(schema, text);
    if (reason && !mayBeRefused(findings)) {
      refuse(`${source} is refused (${reason}), but lint is content`);
    }
    const rules = findings
      .filter(([rule, severity]) => expressible.has(rule) && severity !== 'note')
      .map(([rule]) => rule);
    if (!reason && rules.length > 0 && !(source in unseen)) {
      refuse(`${source} is accepted, which breaks ${rules}`);
    }
    for (const rule of rules) broken.add(rule);
    ++counts[schema];
    if (reason) ++counts.refused;
  }
  if (counts.catalog < 300 || counts.script < 100 || counts.properties < 9 || broken.size < expressible.size) {
    refuse(`few files were found: ${JSON.stringify(counts)}, which break ${[...broken]}`);
  }
  return counts;
}

/** Of the lists `good`, `bad` and `unseen`: what lint and the schema have to say. */
const verdicts = {good: [false, false], bad: [true, true], unseen: [true, false]};

function checkEdge(schema, text, findings, [byLint, bySchema]) {
  if (mayBeRefused(findings) !== byLint) refuse(`lint finds '${findings}' in:\n${text}`);
  const reason = refusal(schema, text);
  if (Boolean(reason) !== bySchema) refuse(`${schema}.json says '${reason}' of:\n${text}`);
}

function checkEdges() {
  let count = 0;
  for (const [list, verdict] of Object.entries(verdicts)) {
    const catalogs = edges.catalog[list];
    const findings = linter.ofCatalogs(catalogs);
    catalogs.forEach((text, place) => checkEdge('catalog', text, findings[place], verdict));
    for (const schema of ['script', 'properties']) {
      for (const text of edges[schema][list]) {
        checkEdge(schema, text, linter.ofScript(text, catalog), verdict);
      }
      count += edges[schema][list].length;
    }
    count += catalogs.length;
  }
  return count;
}

const edgeCount = checkEdges();
const made = checkSamples();
const files = checkFiles();
console.log(
  `as lint has it: ${files.catalog} catalogs, ${files.script} scripts and ${files.properties} property files ` +
    `(${files.refused} refused), ` +
    `${made.samples} random catalogs (${made.refused} refused), ${edgeCount} around what is allowed`
);
