// What the program writes as JSON: {schema, source, text}, by the name of the schema's file.
'use strict';

const {spawnSync} = require('child_process');
const fs = require('fs');
const os = require('os');
const path = require('path');

const schemaOf = {
  'cbc.catalog/1': 'catalog-dump',
  'cbc.diff/1': 'diff',
  'cbc.events/1': 'events',
  'cbc.graph/1': 'graph',
  'cbc.lint/1': 'lint',
  'cbc.situation/1': 'situation',
  'cbc.solve/1': 'solve',
  'cbc.state/1': 'state',
  'cbc.coverage/1': 'coverage',
  'cbc.mutants/1': 'mutants',
  'cbc.sweep/1': 'sweep',
  'cbc.together/1': 'together',
  'cbc.tune/1': 'tune',
  'cbc.verify/1': 'verify',
  'cbc.what-if/1': 'what-if',
};

/** A text that names its schema at its beginning, or nothing if it does not. */
function label(source, text) {
  const found = /^\{\s*"schema":\s*"([^"]*)"/.exec(text);
  return found && found[1] in schemaOf ? [{schema: schemaOf[found[1]], source, text}] : [];
}

/** The expected output of the golden cases. */
function* goldenTexts(cases) {
  for (const {case: name, commands} of JSON.parse(fs.readFileSync(path.join(cases, 'cases.json'), 'utf8'))) {
    for (const {stdout} of commands) yield* label(`case ${name}`, stdout);
  }
}

class Runs {
  constructor(root, program, scratch) {
    this.root = root;
    this.program = program;
    this.scratch = scratch;
  }

  /** Standard output; empty if the program cannot make anything of its input. */
  run(...args) {
    const {status, error, stdout, stderr} = spawnSync(this.program, args, {
      cwd: this.root,
      encoding: 'utf8',
      maxBuffer: 1 << 28,
    });
    if (status === 0 || status === 1 || status === 2) return stdout;
    throw new Error(`cbc ${args.join(' ')}: ${error ?? `status ${status}: ${stderr}`}`);
  }

  *labelled(...args) {
    yield* label(`cbc ${args.join(' ')}`, this.run(...args));
  }

  *graph(catalog) {
    for (const view of ['full', 'tasks', 'constraints', 'behaviors']) {
      const graph = ['graph', catalog, '--format', 'json', '--view', view];
      yield* this.labelled(...graph);
      yield* this.labelled(...graph, '--exclusivity', 'hubs');
    }
    yield* this.labelled('graph', catalog, '--format', 'json', '--view', 'together');
    yield* this.labelled('lint', catalog, '--format', 'json', '--summary');
    yield* this.labelled('graph', catalog, '--format', 'json', '--view', 'situation');
  }

  *verify(catalog) {
    const limits = ['--max-states', '3000', '--format', 'json'];
    yield* this.labelled('verify', catalog, ...limits);
    const properties = catalog.replace(/yaml$/, 'properties.yaml');
    if (fs.existsSync(path.resolve(this.root, properties))) {
      yield* this.labelled('verify', properties, ...limits);
      yield* this.labelled('tune', '--all-states', properties, ...limits);
    }
  }

  /** A state of a mission, and what the catalog has in common with another one. */
  *marks(catalog, script) {
    yield* this.labelled('graph', catalog, '--format', 'json', '--script', script);
    const other = 'catalogs/quadrotor.yaml';
    yield* this.labelled('graph', '--diff', other, catalog, '--format', 'json');
  }

  *solve(catalog, script, names) {
    const limits = ['--max-clock-events', '100'];
    const reasons = [...names.flatMap((name) => ['--why', name]), '--alternatives', '3'];
    const all = ['solve', catalog, script, ...limits, ...reasons, '--stats', '--format'];
    yield* this.labelled(...all, 'json');
    yield* this.labelled('solve', catalog, script, ...limits, '--what-if', '--format', 'json');
    const state = path.join(this.scratch, 'state.json');
    fs.rmSync(state, {force: true});
    yield* this.labelled(...all, 'jsonl', '--state-out', state);
    if (fs.existsSync(state)) yield* label(`state of ${script}`, fs.readFileSync(state, 'utf8'));
  }

  *tune(catalog, script) {
    yield* this.labelled('tune', catalog, script, '--format', 'json');
  }

  *sweep(catalog) {
    const sweep = ['sweep', catalog, '--sequences', '5', '--events', '20', '--format', 'json'];
    yield* this.labelled(...sweep);
    yield* this.labelled(...sweep, '--stats', '--max-nodes', '1');
    yield* this.labelled(...sweep, '--sequences', '6-7');
  }
}

/** The first few names of tasks and behaviors, to ask about. */
function namesIn(dump) {
  const [group] = JSON.parse(dump).groups;
  if (group === undefined) return [];
  const tasks = group.tasks.slice(0, 3).map((item) => item.task);
  const behaviors = group.behaviors.slice(0, 3).map((item) => item.behavior);
  return [...tasks, ...behaviors];
}

// The last one has minimum performances, which reject events.
const swept = new Set([
  'catalogs/quadrotor.yaml',
  'catalogs/target-following.yaml',
  'tests/golden/shared/rejected/catalog.yaml',
]);

/** What the program makes of a catalog, and of the scripts that belong to it. */
function* textsOfCatalog(runs, file) {
  const [dump] = runs.labelled('compile', '--dump', file);
  if (dump === undefined) return; // it has errors
  yield dump;
  const folder = path.dirname(file);
  for (const script of [file.replace(/yaml$/, 'mission.yaml'), `${folder}/script.yaml`]) {
    if (fs.existsSync(path.resolve(runs.root, script))) {
      yield* runs.solve(file, script, namesIn(dump.text));
      yield* runs.marks(file, script);
      yield* runs.tune(file, script);
    }
  }
  if (file.startsWith('catalogs/')) yield* runs.verify(file);
  if (swept.has(file)) {
    yield* runs.sweep(file);
    yield* runs.graph(file);
  }
}

/** What the program makes of all catalogs in the repository. */
function* programTexts(root, cases, program) {
  const scratch = fs.mkdtempSync(path.join(os.tmpdir(), 'cbc-schemas-'));
  try {
    const runs = new Runs(root, program, scratch);
    const [lint] = runs.labelled('lint', '--format', 'json', 'catalogs', 'tests/golden/shared', cases);
    yield lint;
    const catalogs = JSON.parse(lint.text).files.filter((file) => file.summary !== null);
    for (const {file} of catalogs) yield* textsOfCatalog(runs, file);
  } finally {
    fs.rmSync(scratch, {recursive: true});
  }
}

module.exports = {goldenTexts, programTexts};
