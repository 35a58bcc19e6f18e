// Loads the program as a page does: scripts in one scope, and bytes.
'use strict';

const fs = require('node:fs');
const path = require('node:path');
const vm = require('node:vm');

/** `folder`: with play.js and play.wasm. */
async function loadProgram(folder) {
  const script = fs.readFileSync(path.join(folder, 'play.js'), 'utf8');
  const Cbc = vm.runInThisContext(`(function (require, __filename, __dirname) {${script}\nreturn Cbc;})`)(
    require, path.join(folder, 'play.js'), folder);
  return Cbc.load(fs.readFileSync(path.join(folder, 'play.wasm')));
}

module.exports = { loadProgram };
