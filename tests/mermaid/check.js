// Has Mermaid read the pictures on standard input, one on a line; see check.sh and main.cpp.
'use strict';

const fs = require('fs');
const {JSDOM} = require('jsdom');

const {window} = new JSDOM('<body></body>');
Object.assign(globalThis, {window, document: window.document});

// Mermaid keeps its entities encoded until it has drawn them, and hard spaces, too. It trims what is
// around a label.
function decode(text) {
  const decoded = text
    .replaceAll('ﬂ°°', '&#')
    .replaceAll('¶ß', ';')
    .replaceAll('<br>', '')
    .replaceAll('&nbsp;', '\u00a0');
  return decoded.replace(/&#(\d+);/g, (_, code) => String.fromCodePoint(Number(code))).trim();
}

function differences(sample, vertices, edges) {
  const found = [];
  if (vertices.length !== sample.nodes) found.push(`${vertices.length} nodes, not ${sample.nodes}`);
  if (edges.length !== sample.edges) found.push(`${edges.length} edges, not ${sample.edges}`);
  if (sample.labels.length > 0) {
    const labels = vertices.map((vertex) => decode(vertex.text)).sort();
    const expected = sample.labels.map((label) => label.trim()).sort();
    for (const [place, label] of expected.entries()) {
      if (labels[place] === label) continue;
      found.push(`label ${JSON.stringify(labels[place])}, not ${JSON.stringify(label)}`);
    }
  }
  return found;
}

async function main() {
  const mermaid = (await import('mermaid')).default;
  mermaid.initialize({startOnLoad: false, maxEdges: 10000, maxTextSize: 10000000});
  const samples = fs.readFileSync(0, 'utf8').trim().split('\n').map((line) => JSON.parse(line));
  let bad = 0;
  for (const sample of samples) {
    let found;
    try {
      const {db} = await mermaid.mermaidAPI.getDiagramFromText(sample.mermaid);
      found = differences(sample, [...db.getVertices().values()], db.getEdges());
    } catch (error) {
      found = [error.message];
    }
    if (found.length === 0) continue;
    if (++bad <= 5) console.error(`${sample.name}: ${found.join('; ')}\n${sample.mermaid}`);
  }
  // What Mermaid must refuse, so that its silence means something.
  const isRefused = await mermaid.parse('flowchart LR\n  a[" b').then(() => false, () => true);
  if (!isRefused) throw new Error('Mermaid does not see damage');
  if (samples.length < 500) throw new Error(`only ${samples.length} pictures`);
  console.log(`${samples.length} pictures, ${bad} of them bad`);
  process.exitCode = bad > 0 ? 1 : 0;
}

main().catch((error) => {
  console.error(`check.js: ${error.stack}`);
  process.exitCode = 1;
});
