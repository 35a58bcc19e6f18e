// Runs the cases of tests/golden through the program in WebAssembly: status and all output are those of the native one.
//
//   node golden.js FOLDER CASES [PART]   FOLDER has play.js and play.wasm, CASES the cases, unpacked; PART: of the
//                                        names of the cases to run
'use strict';

const fs = require('node:fs');
const path = require('node:path');
const { loadProgram } = require('./program.js');

const commands = ['lint', 'compile', 'solve', 'verify', 'graph']; // that the program for browsers has

/** Why a case cannot run where there is nothing but files, or undefined. */
const obstacles = [
  ['a device', (words, { redirection }) => [...words, redirection].some((word) => /^\/(dev|proc)\//.test(word))],
  ['standard input to be one of the files', (words, { stdin }) => words.includes(stdin)],
  ['a file of another command', (words, command, others) => others.length > 0],
  ['a server', (words) => words.some((word) => word.startsWith('--serve'))],
  ['the address of the working directory', (words) => words.includes('sarif')],
  ['Graphviz', (words) => words.some((word) => /\.(svg|png|pdf)$/.test(word)) || words.includes('svg')],
];

/** The files of a folder, by their paths in the program. */
function filesOf(folder, place) {
  const files = {};
  for (const name of fs.readdirSync(folder)) {
    const whole = path.join(folder, name);
    if (fs.statSync(whole).isDirectory()) Object.assign(files, filesOf(whole, `${place}/${name}`));
    else files[`${place}/${name}`] = fs.readFileSync(whole);
  }
  return files;
}

function firstDifference(wanted, found) {
  const [left, right] = [wanted, found].map((text) => text.split('\n'));
  const line = left.findIndex((text, place) => text !== right[place]);
  const place = line < 0 ? left.length : line;
  return `line ${place + 1}: expected\n    ${left[place]}\n  but found\n    ${right[place]}`;
}

async function problemOf(program, cases, name, { arguments: words, stdin, stdout, stderr, status }) {
  const files = filesOf(path.join(cases, name), `/${name}`);
  const input = stdin === '' ? Buffer.alloc(0) : files[`/${name}/${stdin}`];
  const result = await program.run(words, files, { folder: `/${name}`, stdin: input });
  for (const [stream, wanted] of Object.entries({ stdout, stderr })) {
    const found = Buffer.from(result[stream]).toString();
    if (found !== wanted) return `${stream}, ${firstDifference(wanted, found)}`;
  }
  return status === result.status ? undefined : `expected status ${status}, found ${result.status}`;
}

async function main(built, cases, only) {
  const program = await loadProgram(path.resolve(built));
  const leftOut = new Map();
  let count = 0;
  let failures = 0;
  for (const { case: name, commands: [command, ...others] } of JSON.parse(fs.readFileSync(path.join(cases, 'cases.json')))) {
    if (only !== undefined && !name.includes(only)) continue;
    const words = command.arguments;
    if (!commands.includes(words[0])) continue;
    const why = obstacles.find(([, has]) => has(words, command, others));
    if (why !== undefined) {
      leftOut.set(why[0], (leftOut.get(why[0]) ?? 0) + 1);
      continue;
    }
    ++count;
    const problem = await problemOf(program, cases, name, command).catch((error) => error.stack);
    if (problem === undefined) continue;
    ++failures;
    console.log(`${name}: ${problem}`);
  }
  console.log(`${count} cases, ${failures} failed`);
  for (const [why, number] of leftOut) console.log(`left out: ${number}, which need ${why}`);
  if (count === 0 || failures > 0) process.exitCode = 1;
}

main(...process.argv.slice(2));
