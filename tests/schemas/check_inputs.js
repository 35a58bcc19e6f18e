// check_inputs.js PROGRAM CASES: validates catalogs, scripts and property files with the schemas, and
// compares with what lint finds in them; see check.sh.
//
// A schema may refuse only what lint reports as an error, or an unknown key, which is a warning in a
// catalog. And it has to refuse what breaks one of the rules below, except where a mistake is listed
// that no schema can see.
'use strict';

const path = require('path');
const {catalog, edges} = require('./edges');
const {filesOfRepository} = require('./input_files');
const {Linter} = require('./linter');
const {inputs, idOf, makeValidator, readSchemas} = require('./validator');
const {readYaml} = require('./yaml');

const root = path.join(__dirname, '..', '..');
const [program, cases] = process.argv.slice(2).map((name) => path.resolve(name));

const expressible = new Set([
  'duplicate-key',
  'invalid-value',
  'missing-key',
  'on-request-and-reactive',
  'unknown-key',
  'wrong-type',
  'yaml-syntax',
]);

/** Mistakes that break these rules, by file, and why a schema may not see them. */
const unseen = {
  'cases/catalog_both_flags_by_default/catalog.yaml': 'the task says only one of the two',
  'cases/catalog_deep_nesting/catalog.yaml': 'a reader may bear more',
  'cases/lint_no_property/empty.yaml': 'a list to be filled is a warning',
  'cases/verify_no_property/empty.yaml': 'a list to be filled is a warning',
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

function checkFiles() {
  const counts = {catalog: 0, script: 0, properties: 0, refused: 0};
  const broken = new Set();
  for (const {source, schema, text, findings} of filesOfRepository(root, cases, linter)) {
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
const files = checkFiles();
console.log(
  `as lint has it: ${files.catalog} catalogs, ${files.script} scripts and ${files.properties} property files ` +
    `(${files.refused} refused), ` +
    `${edgeCount} around what is allowed`
);
