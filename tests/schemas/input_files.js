// The catalogs, scripts and property files of the repository, with what lint finds in them.
'use strict';

const fs = require('fs');
const path = require('path');
const {readYaml} = require('./yaml');

const catalogKeys = ['behaviors', 'tasks', 'exclusivity_constraints', 'default_values'];
const propertyKeys = ['properties', 'assume'];
const scriptKeys = ['events', 'reactive_delay', 'timeouts', 'situation', 'catalog'];

/** The schema that a text is for, told by its content, or by its name if it is not YAML. */
function schemaOf(file, text) {
  const {document} = readYaml(text);
  const has = (keys) => keys.some((key) => key in document);
  if (document !== null && typeof document === 'object') {
    if (Array.isArray(document)) return 'script';
    if (has(catalogKeys)) return 'catalog';
    if (has(propertyKeys)) return 'properties';
    if (has(scriptKeys)) return 'script';
  }
  return /script|mission/.test(path.basename(file)) ? 'script' : 'catalog';
}

/** All files with one of the suffixes in a folder, and below. */
function filesIn(folder, ...suffixes) {
  return fs
    .readdirSync(folder, {recursive: true})
    .filter((file) => suffixes.some((suffix) => file.endsWith(suffix)))
    .map((file) => path.join(folder, file))
    .filter((file) => !path.basename(file).startsWith('.') && fs.statSync(file).isFile())
    .sort();
}

/** The catalog that a script or a property file is for, if it can be told. */
function catalogOf(file, text) {
  const folder = path.dirname(file);
  const names = [
    readYaml(text).document?.catalog,
    path.basename(file).replace(/\.(mission|properties)\.yaml$/, '.yaml'),
    'catalog.yaml',
  ];
  const found = names
    .filter((name) => typeof name === 'string')
    .map((name) => path.join(folder, name))
    .find((name) => name !== file && fs.existsSync(name) && fs.statSync(name).isFile());
  return found === undefined ? undefined : fs.readFileSync(found, 'utf8');
}

function isUtf8(file) {
  const bytes = fs.readFileSync(file);
  return Buffer.from(bytes.toString('utf8')).equals(bytes);
}

/** Those in the folders with catalogs, scripts and property files. */
function* yamlFiles(root, cases) {
  for (const folder of [path.join(root, 'catalogs'), path.join(root, 'tests/browser'), cases]) {
    for (const file of filesIn(folder, '.yaml', '.yml').filter(isUtf8)) {
      const text = fs.readFileSync(file, 'utf8');
      const schema = schemaOf(file, text);
      yield {source: path.relative(path.dirname(folder), file), schema, text, catalog: catalogOf(file, text)};
    }
  }
}

/** The example of a rule, or what it is when it is fixed: the lines that are set in. */
function exampleIn(explanation, heading) {
  const place = new RegExp(`^${heading}[^\\n]*:\\n\\n((?:    [^\\n]*\\n|\\n)+)`, 'm');
  return place.exec(explanation)?.[1].replace(/^ {4}/gm, '');
}

/** The examples that `cbc lint --explain` gives. */
function* examples(linter) {
  for (const line of linter.run('--list-rules').trim().split('\n')) {
    const [rule] = line.split(' ');
    const explanation = linter.run('--explain', rule);
    const catalog = exampleIn(explanation, 'The catalog');
    const schema = catalog === undefined ? 'catalog' : 'script';
    for (const heading of ['Example', 'Fixed']) {
      const text = exampleIn(explanation, heading);
      yield {source: `${heading} of rule ${rule}`, schema, text, catalog};
    }
  }
}

/** The parts of README.md that are catalogs or scripts; all of them are good. */
function* excerpts(root) {
  const page = fs.readFileSync(path.join(root, 'README.md'), 'utf8');
  for (const [, text] of page.matchAll(/^```yaml\n(.*?)^```$/gms)) {
    if (!/^(behaviors|events):/m.test(text)) continue;
    yield {source: 'an excerpt of README.md', schema: schemaOf('', text), text, findings: []};
  }
}

/** {source, schema, text, findings} of all that there is, but for what lint cannot look at. */
function filesOfRepository(root, cases, linter) {
  const items = [...yamlFiles(root, cases), ...examples(linter)];
  const catalogs = items.filter((item) => item.schema === 'catalog');
  const findings = linter.ofCatalogs(catalogs.map((item) => item.text));
  catalogs.forEach((item, place) => (item.findings = findings[place]));
  for (const item of items.filter(({schema, catalog}) => schema !== 'catalog' && catalog)) {
    item.findings = linter.ofScript(item.text, item.catalog);
  }
  return [...items.filter((item) => item.findings !== undefined), ...excerpts(root)];
}

module.exports = {filesOfRepository};
