// Drives a session in WebAssembly, and prints how long an event takes late in a long one.
//
//   node session.js FOLDER   FOLDER has play.js and play.wasm
'use strict';

const assert = require('node:assert');
const fs = require('node:fs');
const path = require('node:path');
const { loadProgram } = require('./program.js');

const catalogFile = path.join(__dirname, '..', '..', 'catalogs', 'hospital.yaml');

/** Numbers that are the same in each run. */
function makeRandom(seed) {
  let state = seed;
  return (bound) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * bound);
  };
}

async function main(built) {
  const program = await loadProgram(path.resolve(built));
  const ask = await program.openSession();
  const text = fs.readFileSync(catalogFile, 'utf8');
  const { catalog } = ask({ do: 'open', catalog: text, name: 'hospital.yaml' });
  const below = makeRandom(1);
  const any = (list) => list[below(list.length)];
  const events = [];
  const times = [];
  const timed = (request) => {
    const begin = performance.now();
    const answer = ask(request);
    if (events.length >= 300) times.push(performance.now() - begin);
    return answer;
  };
  while (events.length < 400) {
    const choices = [() => ({ do: 'apply', event: `start: ${any(catalog.tasks)}` }),
                     () => ({ do: 'apply', event: `stop: ${any(catalog.tasks)}` }),
                     () => ({ do: 'apply', event: `finish: ${any(catalog.behaviors).name}` }),
                     () => ({ do: 'advance' })];
    const answer = timed(any(choices)());
    if (answer.error !== undefined) continue;
    assert.equal(answer.first, events.length + 1);
    events.push(...answer.events);
  }
  const report = (what, list) => {
    const sorted = [...list].sort((one, other) => one - other);
    console.log(`${what}: median ${sorted[sorted.length >> 1].toFixed(1)} ms, most ${sorted.at(-1).toFixed(1)} ms`);
  };
  report('an event after 300', times);
  for (const [what, request] of [['what_if', { do: 'what_if', event: `start: ${catalog.tasks[0]}` }], ['state', { do: 'state' }],
                                 ['goto', { do: 'goto', index: 300 }], ['mission', { do: 'mission' }]]) {
    const begin = performance.now();
    const answer = ask(request);
    assert.equal(answer.error, undefined);
    console.log(`${what}: ${(performance.now() - begin).toFixed(1)} ms`);
  }
  // The mission gives the same events in a run of the program.
  ask({ do: 'goto', index: events.length });
  const { mission } = ask({ do: 'mission' });
  const result = await program.run(['solve', 'hospital.yaml', 'mission.yaml', '--format', 'json'],
    { 'hospital.yaml': text, 'mission.yaml': mission });
  const [run] = JSON.parse(new TextDecoder().decode(result.stdout)).runs;
  assert.equal(result.status, 0);
  assert.deepEqual(run.events, events.map(({ note, ...event }) => event));
  console.log(`${run.events.length} events as 'cbc solve' has them, ${run.expectations.passed} expectations`);
}

main(...process.argv.slice(2));
