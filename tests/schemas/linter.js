// What `cbc lint` finds in texts.
'use strict';

const {spawnSync} = require('child_process');
const fs = require('fs');
const os = require('os');
const path = require('path');

/** Findings are not to be allowed by comments: no schema knows these. */
function withoutAllowances(text) {
  return text.replaceAll('cbc: allow', 'cbc could allow');
}

/** Findings as [rule, severity], by the name of the file. */
function findingsIn(report) {
  if (report === '') return new Map(); // there was nothing to look at
  return new Map(
    JSON.parse(report).files.map(({file, diagnostics}) => [
      file,
      diagnostics.map(({rule, severity}) => [rule, severity]),
    ])
  );
}

class Linter {
  constructor(program) {
    this.program = program;
  }

  run(...args) {
    // The root has no settings for lint.
    const options = {cwd: '/', encoding: 'utf8', maxBuffer: 1 << 28};
    const {status, stdout, stderr} = spawnSync(this.program, ['lint', ...args], options);
    if (status === 0 || status === 1 || status === 2) return stdout;
    throw new Error(`cbc lint ${args.join(' ')}: status ${status}: ${stderr}`);
  }

  /** What `use` makes of files with the texts. */
  withFiles(texts, use) {
    const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'cbc-schemas-'));
    try {
      return use(
        texts.map((text, place) => {
          const file = path.join(folder, `${place}.yaml`);
          fs.writeFileSync(file, withoutAllowances(text));
          return file;
        })
      );
    } finally {
      fs.rmSync(folder, {recursive: true});
    }
  }

  /** [rule, severity] of all findings, for each of the texts; nothing for what is no catalog. */
  ofCatalogs(texts) {
    return this.withFiles(texts, (files) => {
      const found = findingsIn(this.run('--format', 'json', ...files));
      return files.map((file) => found.get(file));
    });
  }

  /** The same for a script or a property file; nothing if there is no good catalog for it. */
  ofScript(text, catalog) {
    return this.withFiles([text, catalog], ([script, file]) =>
      findingsIn(this.run('--format', 'json', '--script', script, file)).get(script)
    );
  }
}

module.exports = {Linter};
