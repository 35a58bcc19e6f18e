// Runs the cases of tests/golden through the program in WebAssembly: status and all output are those of the native one.
//
//   node golden.js FOLDER [PART]   FOLDER has play.js and play.wasm; PART: of the names of the cases to run
'use strict';

const fs = require('node:fs');
const path = require('node:path');
const { loadProgram } = require('./program.js');

const root = path.join(__dirname, '..', '..');
const cases = path.join(root, 'tests', 'golden', 'cases');

const commands = ['lint', 'compile', 'solve', 'verify', 'graph']; // that the program for browsers has

/** Why a case cannot run where there is nothing but files, or undefined. */
const obstacles = [
  ['a device', (words) => words.some((word) => word.startsWith('/dev/') || word.startsWith('/proc/'))],
  ['standard input to be one of the files', (words) => words.includes('stdin')],
  ['a server', (words) => words.some((word) => word.startsWith('--serve'))],
  ['the address of the working directory', (words) => words.includes('sarif')],
  ['Graphviz', (words) => words.some((word) => /\.(svg|png|pdf)$/.test(word)) || words.includes('svg')],
];

function split(line) {
  const words = [];
  for (const [, quoted, plain] of line.trim().matchAll(/((?:[^ ']*'[^']*')+[^ ']*)|([^ ]+)/g)) {
    words.push((quoted ?? plain).replaceAll("'", ''));
  }
  return words;
}

/** The files of a folder of the sources, by their paths there. */
function filesOf(folder) {
  const files = {};
  for (const entry of fs.readdirSync(path.join(root, folder), { withFileTypes: true, recursive: true })) {
    const whole = path.join(entry.parentPath ?? entry.path, entry.name);
    if (fs.statSync(whole, { throwIfNoEntry: false })?.isFile()) {
      files[`/${path.relative(root, whole)}`] = fs.readFileSync(whole);
    }
  }
  return files;
}

/** The files of a case, with those of the folders that its command and they name. */
function inputsOf(folder) {
  const files = filesOf(folder);
  const folders = new Set([folder]);
  for (const at of folders) { // which grows meanwhile
    for (const content of Object.values(filesOf(at))) {
      for (const [name] of content.toString('latin1').matchAll(/(\.\.\/)+[A-Za-z0-9_]+/g)) {
        const other = path.join(at, name);
        const isFolder = !other.startsWith('..') && fs.statSync(path.join(root, other), { throwIfNoEntry: false })?.isDirectory();
        if (!isFolder || folders.has(other)) continue;
        folders.add(other);
        Object.assign(files, filesOf(other));
      }
    }
  }
  return files;
}

function expected(name, file) {
  const place = path.join(cases, name, file);
  return fs.existsSync(place) ? fs.readFileSync(place) : Buffer.alloc(0);
}

function firstDifference(wanted, found) {
  const [left, right] = [wanted, found].map((bytes) => Buffer.from(bytes).toString().split('\n'));
  const line = left.findIndex((text, place) => text !== right[place]);
  const place = line < 0 ? left.length : line;
  return `line ${place + 1}: expected\n    ${left[place]}\n  but found\n    ${right[place]}`;
}

async function main(built, only) {
  const program = await loadProgram(path.resolve(built));
  const leftOut = new Map();
  let count = 0;
  let failures = 0;
  for (const name of fs.readdirSync(cases).sort()) {
    if (only !== undefined && !name.includes(only)) continue;
    const words = split(fs.readFileSync(path.join(cases, name, 'command'), 'utf8'));
    if (!commands.includes(words[0])) continue;
    const why = obstacles.find(([, has]) => has(words));
    if (why !== undefined) {
      leftOut.set(why[0], (leftOut.get(why[0]) ?? 0) + 1);
      continue;
    }
    ++count;
    let problem;
    try {
      const folder = `tests/golden/cases/${name}`;
      const result = await program.run(words, inputsOf(folder), { folder: `/${folder}`, stdin: expected(name, 'stdin') });
      const differs = ['stdout', 'stderr'].find((file) => !expected(name, file).equals(result[file]));
      if (differs !== undefined) problem = `${differs}, ${firstDifference(expected(name, differs), result[differs])}`;
      const status = Number(expected(name, 'status'));
      if (status !== result.status) problem = `${problem ?? ''} expected status ${status}, found ${result.status}`;
    } catch (error) {
      problem = error.stack;
    }
    if (problem === undefined) continue;
    ++failures;
    console.log(`${name}: ${problem}`);
  }
  console.log(`${count} cases, ${failures} failed`);
  for (const [why, number] of leftOut) console.log(`left out: ${number}, which need ${why}`);
  if (count === 0 || failures > 0) process.exitCode = 1;
}

main(...process.argv.slice(2));
