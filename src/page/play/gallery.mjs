// The gallery: each catalog and mission of the project as a session of the simulator.

import { documentOf } from './document.mjs';

const style = `
body { max-width: 46em; margin: 2em auto; padding: 0 1em; font: 15px/1.5 system-ui, sans-serif; }
li { margin: 0.5em 0; }
`;

const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');

/** The first paragraph of the comment at the beginning of a text. */
function summaryOf(text) {
  const lines = text.split('\n').filter((line) => !line.startsWith('# yaml-language-server'));
  const end = lines.findIndex((line) => !/^# ./.test(line));
  return lines.slice(0, end).map((line) => line.slice(2)).join(' ');
}

/** A page, beside which cbc-play.html is. `examples`: see listExamples. */
export function galleryPage({ texts, sessions }) {
  const items = sessions.map(({ id, title, catalog, mission }) => {
    const isOfMission = mission !== undefined && id !== catalog.replace(/\.yaml$/, '');
    const summary = summaryOf(texts[isOfMission ? mission : catalog]);
    return `<li><a href="cbc-play.html#example=${encodeURIComponent(id)}">${escaped(title)}</a> &ndash; ${escaped(summary)}</li>`;
  });
  return documentOf({
    title: 'Example robots and missions \u2013 cbc play', style,
    policy: ["default-src 'none'", "style-src 'unsafe-inline'", 'img-src data:'],
    body: `<body>
<main>
<h1>Example robots and missions</h1>
<p>A catalog opens at the end of its mission; its other missions follow it here. <a href="index.html">The simulator</a> lists them as examples, too.</p>
<ul>
${items.join('\n')}
</ul>
</main>
</body>`,
  });
}
