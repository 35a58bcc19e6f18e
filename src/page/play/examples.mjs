// The sessions that the simulator offers: a first robot, and all catalogs of the project with their missions.

import { existsSync, readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';

const tries = [
  { text: 'Something breaks: drive, then landmarks cannot be seen. Who takes over?',
    entries: [{ start: 'DRIVE' }, { fault: 'MATCH_LANDMARKS' }, { finish: 'MATCH_LANDMARKS', cause: 'process_failure' }] },
  { text: 'Two requests that exclude one another: the higher priority wins, and the other one is told why.',
    entries: [{ start: 'CHARGE', priority: 2 }, { start: 'DRIVE' }] },
  { text: 'It becomes dark while the robot drives.',
    entries: [{ situation: { LIGHT: 'bright' } }, { start: 'DRIVE', priority: 3 }, { situation: { LIGHT: 'dark' } }] },
];

export function listExamples(root) {
  const folder = path.join(root, 'catalogs');
  const read = (name) => (existsSync(path.join(folder, name)) ? readFileSync(path.join(folder, name), 'utf8') : '');
  const names = readdirSync(folder).filter((name) => /^[\w-]+\.yaml$/.test(name)).map((name) => name.replace(/\.yaml$/, ''));
  const first = { title: 'a first robot', name: 'robot.yaml', tries,
                  catalog: readFileSync(path.join(root, 'src/page/play/first.yaml'), 'utf8') };
  return [first, ...names.map((name) => ({
    title: name.replaceAll('-', ' '), name: `${name}.yaml`, catalog: read(`${name}.yaml`),
    mission: read(`${name}.mission.yaml`), properties: read(`${name}.properties.yaml`),
  }))];
}
