// The sessions that the simulator offers: a first robot, and all catalogs of the project with their missions.

import { readFileSync, readdirSync } from 'node:fs';
import path from 'node:path';

/** What a first visit may try. */
const tries = [
  { text: 'Something breaks: the robot drives, then it can no longer match landmarks. Who takes over?',
    entries: [{ start: 'DRIVE' }, { fault: 'MATCH_LANDMARKS' }, { finish: 'MATCH_LANDMARKS', cause: 'process_failure' }] },
  { text: 'Two requests conflict: the one with the higher priority wins, and the other is rejected.',
    entries: [{ start: 'CHARGE', priority: 2 }, { start: 'DRIVE' }] },
  { text: 'It gets dark while the robot drives.',
    entries: [{ start: 'DRIVE', priority: 3 }, { situation: { LIGHT: 'dark' } }] },
];

/**
 * {texts, sessions}: texts by file, and [{id, title, catalog, mission, properties}], which name files; there need be no
 * mission and no properties. The first session also has `tries`.
 */
export function listExamples(root) {
  const folder = path.join(root, 'catalogs');
  const texts = { 'robot.yaml': readFileSync(path.join(root, 'src/page/play/first.yaml'), 'utf8') };
  for (const at of ['', 'missions']) {
    for (const name of readdirSync(path.join(folder, at)).filter((one) => one.endsWith('.yaml'))) {
      texts[name] = readFileSync(path.join(folder, at, name), 'utf8');
    }
  }
  const known = (name) => (Object.hasOwn(texts, name) ? name : undefined);
  const sessions = [{ id: 'robot', title: 'a first robot', catalog: 'robot.yaml', tries }];
  for (const file of readdirSync(folder).filter((name) => /^[\w-]+\.yaml$/.test(name))) {
    const id = file.replace(/\.yaml$/, '');
    const properties = known(`${id}.properties.yaml`);
    sessions.push({ id, title: id, catalog: file, mission: known(`${id}.mission.yaml`), properties });
    for (const mission of readdirSync(path.join(folder, 'missions')).filter((name) => name.startsWith(`${id}-`))) {
      const part = mission.replace(/\.yaml$/, '');
      sessions.push({ id: part, title: `${id}: ${part.slice(id.length + 1)}`, catalog: file, mission, properties });
    }
  }
  return { texts, sessions };
}
