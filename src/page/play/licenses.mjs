// The licenses of what is in the simulator besides cbc itself: they go with it, wherever it is copied to.

import { readFileSync } from 'node:fs';
import path from 'node:path';

// Debian's packages of what is compiled into the program. That of Boost demands nothing for compiled code.
const debianPackages = ['emscripten', 'libcli11-dev', 'libflatbuffers-dev', 'libfmt-dev', 'libxxhash-dev', 'libyaml-cpp-dev'];

const rule = '-'.repeat(78);

/** `inputs`: what esbuild has bundled. `modules`: the folder with node_modules. */
export function listLicenses(inputs, modules) {
  const names = new Set(Object.keys(inputs).map((file) => /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1]).filter(Boolean));
  const byText = new Map(); // many are of the same people
  for (const name of [...names].sort()) {
    const folder = path.join(modules, 'node_modules', name);
    const { version } = JSON.parse(readFileSync(path.join(folder, 'package.json'), 'utf8'));
    const text = readFileSync(path.join(folder, 'LICENSE'), 'utf8').trim();
    byText.set(text, [...(byText.get(text) ?? []), `${name} ${version}`]);
  }
  for (const name of debianPackages) {
    byText.set(readFileSync(`/usr/share/doc/${name}/copyright`, 'utf8').trim(), [`${name}, a package of Debian`]);
  }
  const parts = [...byText].map(([text, owners]) => `${rule}\n${owners.join('\n')}\n${rule}\n\n${text}\n`);
  return `The simulator has these parts of others in it:\n\n${parts.join('\n')}`;
}
