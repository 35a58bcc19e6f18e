// What the YAML language server makes of the catalogs of the repository: see check.sh.
'use strict';

const assert = require('assert');
const fs = require('fs');
const path = require('path');
const {fileURLToPath, pathToFileURL} = require('url');
const {TextDocument} = require('vscode-languageserver-textdocument');
const {getLanguageService} = require('yaml-language-server');

const folder = path.join(__dirname, '..', '..', 'catalogs');

function makeService() {
  const service = getLanguageService({
    schemaRequestService: async (uri) => fs.readFileSync(fileURLToPath(uri), 'utf8'),
    workspaceContext: {resolveRelativePath: (to, from) => new URL(to, from).toString()},
  });
  service.configure({completion: true, hover: true, validate: true, schemas: []});
  return service;
}

const service = makeService();

let version = 0;

/** A file of the folder with another text. */
function edit(file, text) {
  const uri = pathToFileURL(path.join(folder, file)).toString();
  return TextDocument.create(uri, 'yaml', ++version, text);
}

function read(file) {
  return fs.readFileSync(path.join(folder, file), 'utf8');
}

/** "LINE: MESSAGE" of all that is marked, lines from 1. */
async function diagnostics(document) {
  const found = await service.doValidation(document, false);
  return found.map(({range, message}) => `${range.start.line + 1}: ${message}`);
}

/** Replaces a text that is there once. */
function replace(text, before, now) {
  assert.strictEqual(text.split(before).length, 2, `'${before}' is not there once`);
  return text.replace(before, now);
}

function lineOf(text, part) {
  return text.slice(0, text.indexOf(part)).split('\n').length;
}

/** Marks the mistake, on its line, and nothing else. */
async function expectMistake(file, before, now, says) {
  const text = replace(read(file), before, now);
  const found = await diagnostics(edit(file, text));
  const line = lineOf(text, now.trimStart());
  assert.strictEqual(found.length, 1, `${now}: ${found}`);
  assert.ok(found[0].startsWith(`${line}: `) && found[0].includes(says), `${now}: ${found}`);
}

async function checkGallery() {
  const files = fs.readdirSync(folder).filter((file) => file.endsWith('.yaml'));
  assert.ok(files.length > 1);
  for (const file of files) {
    const schemas = {mission: 'script', properties: 'properties'};
    const schema = schemas[file.split('.').at(-2)] ?? 'catalog';
    const modeline = `# yaml-language-server: $schema=../schemas/${schema}.json\n`;
    assert.ok(read(file).startsWith(modeline), file);
    assert.deepStrictEqual(await diagnostics(edit(file, read(file))), [], file);
  }
  return files.length;
}

async function checkMistakes() {
  const catalog = 'target-following.yaml';
  const task = '  timeout: 900\n';
  const key = 'Property timout is not allowed.';
  await expectMistake(catalog, task, '  timout: 900\n', key);
  await expectMistake(catalog, task, '  timeout: 0\n', 'exclusive minimum of 0');
  await expectMistake(catalog, task, '  timeout: "900"\n', 'number');
  await expectMistake(catalog, task, '  reactive_start: maybe\n', 'expected true or false');
  await expectMistake(catalog, task, '  default: false\n', "write 'reactive_start'");
  const script = 'target-following.mission.yaml';
  const priority = '  priority: 1\n  at: 0\n';
  await expectMistake(script, priority, '  prio: 1\n  at: 0\n', 'Property prio is not allowed.');
  await expectMistake(script, '  at: 0\n', '  at: zero\n', 'Expected "number"');
  const properties = 'target-following.properties.yaml';
  const name = '- name: high accelerations';
  await expectMistake(properties, name, '- nam: high accelerations', 'Property nam is not allowed.');
  const catalogKey = 'catalog: target-following.yaml\n';
  await expectMistake(properties, catalogKey, 'catalog: [target-following.yaml]\n', 'Expected "string"');
}

/** Where the text ends before a mark, as the language server counts. */
function positionOf(document, mark) {
  return document.positionAt(document.getText().indexOf(mark) + mark.length);
}

async function checkHelp() {
  const file = 'target-following.yaml';
  const document = edit(file, read(file));
  const hover = await service.doHover(document, positionOf(document, '\n  start_on_req'));
  assert.match(JSON.stringify(hover), /starts only when it is requested/);
  const name = await service.doHover(document, positionOf(document, '\n- behav'));
  assert.match(JSON.stringify(name), /as scripts and the robot use it/);

  const offered = async (file, before, begun) => {
    const open = edit(file, replace(read(file), before, begun));
    const {items} = await service.doComplete(open, positionOf(open, begun), false);
    return items.map((item) => item.label).sort();
  };
  // No older names, and none that are there.
  assert.deepStrictEqual(await offered(file, '  timeout: 900', '  ti'), [
    'minimum_performance',
    'parameters',
    'reactive_start',
    'timeout',
  ]);
  const causes = await offered('quadrotor.mission.yaml', '  cause: process_failure', '  cause: ');
  assert.ok(causes.includes('wrong_progress'), `${causes}`);
  const land = 'basic_quadrotor_behaviors\n  task: ';
  const tasks = await offered('quadrotor.yaml', `${land}LAND`, land.replace('basic', 'Basic'));
  assert.deepStrictEqual(tasks, [], 'of names: no true, no false');
}

/** Where each key of a file is first, and where its value begins. */
function keysOf(text) {
  const keys = new Map();
  let begin = 0;
  for (const line of text.split('\n')) {
    const match = /^([ -]*)([a-z_]+):/.exec(line);
    if (match && !keys.has(match[2])) {
      keys.set(match[2], {hover: begin + match[1].length + 1, value: begin + match[0].length});
    }
    begin += line.length + 1;
  }
  return keys;
}

/** Each key is explained in a sentence, and no value is offered that says nothing. */
async function checkKeys() {
  const known = new Set();
  for (const file of fs.readdirSync(folder).filter((name) => name.endsWith('.yaml'))) {
    const text = read(file);
    const kind = text.slice(0, text.indexOf('\n'));
    for (const [key, {hover, value}] of keysOf(text)) {
      if (known.has(kind + key)) continue;
      known.add(kind + key);
      const document = edit(file, text);
      const shown = (await service.doHover(document, document.positionAt(hover))).contents.value;
      const [title, explanation] = shown.split('\n\n');
      assert.ok(!title.includes('||') && explanation.split(' ').length > 3, `${file}: ${key}: ${shown}`);
      const end = text.indexOf('\n', value);
      const open = edit(file, `${text.slice(0, value)} ${text.slice(end)}`);
      const {items} = await service.doComplete(open, open.positionAt(value + 1), false);
      assert.ok(!items.some((item) => item.label === 'null'), `${file}: ${key}: null is offered`);
    }
  }
  assert.ok(known.size > 40, `${known.size} keys`);
}

async function main() {
  const count = await checkGallery();
  await checkMistakes();
  await checkHelp();
  await checkKeys();
  console.log(`${count} files are good, and mistakes are marked where they are made`);
}

main().catch((error) => {
  console.error(`check.js: ${error.message}`);
  process.exit(1);
});
