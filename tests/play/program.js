// Loads the program as the worker of a page does: scripts in one scope, and bytes.
'use strict';

const fs = require('node:fs');
const path = require('node:path');
const vm = require('node:vm');

/** `folder`: what ./dev play makes. */
async function loadProgram(folder) {
  const script = fs.readFileSync(path.join(folder, 'worker.js'), 'utf8');
  const Cbc = vm.runInThisContext(`(function (self, require, __filename, __dirname) {${script}\nreturn Cbc;})`)(
    { addEventListener() {} }, require, path.join(folder, 'worker.js'), folder);
  return Cbc.load(fs.readFileSync(path.join(folder, 'play.wasm')));
}

module.exports = { loadProgram };
