// build.mjs ROOT PROGRAM MODULES OUTPUT: makes the simulator in the folder OUTPUT.
//
// ROOT: of the sources. PROGRAM: the folder with play.js and play.wasm. MODULES: the folder with node_modules.
//
// index.html has files beside it, for a server; cbc-play.html has all of them in itself, and opens from a disk.
// gallery.html links the sessions that they offer.

import { createHash } from 'node:crypto';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { gzipSync } from 'node:zlib';
import { documentOf } from './document.mjs';
import { listExamples } from './examples.mjs';
import { galleryPage } from './gallery.mjs';
import { listLicenses } from './licenses.mjs';

const [root, program, modules, output] = process.argv.slice(2).map((folder) => path.resolve(folder));
const esbuild = createRequire(path.join(modules, 'package.json'))('esbuild');
const source = (...names) => readFileSync(path.join(root, 'src', ...names), 'utf8');

// The page of --html, whose parts are used again: what it lists in embed.cmake, without its beginning.
const listOf = (name) => new RegExp(`set\\(${name} ?([^)]*)\\)`).exec(source('page', 'html', 'embed.cmake'))[1]
  .replaceAll(/#.*$/gm, '').split(/\s+/).filter((word) => word !== '');
const pageScripts = listOf('scripts').filter((name) => !['address.js', 'live.js', 'start.js'].includes(name));
const ownScripts = ['engine.js', 'session.js', 'robot.js', 'clock.js', 'prove.js', 'share.js', 'files.js', 'play.js'];
const between = (text, begin, end) => text.slice(text.indexOf(begin), text.indexOf(end) + end.length);

const bundled = await esbuild.build({
  entryPoints: [path.join(root, 'src/page/play/editor.js')], bundle: true, minify: true, format: 'iife', write: false, metafile: true,
  globalName: 'editorBundle', nodePaths: [path.join(modules, 'node_modules')], charset: 'utf8', legalComments: 'none',
});
const minified = (text) => esbuild.transformSync(text, { minifyWhitespace: true, minifySyntax: true, charset: 'utf8' }).code;

const listed = listExamples(root);
const examples = JSON.stringify(listed).replaceAll('<', '\\u003c');
const script = [
  bundled.outputFiles[0].text, 'const { TextEditor } = editorBundle;', `const examples = ${examples};`,
  minified([...pageScripts.map((name) => source('page', 'html', name)), ...ownScripts.map((name) => source('page', 'play', name))].join('\n')),
].join('\n').replaceAll('</script', '<\\/script');
const worker = minified([source('wasm', 'cbc.js'), source('page', 'play', 'worker.js')].join('\n'));
const workerScript = `${readFileSync(path.join(program, 'play.js'), 'utf8')}\n${worker}`.replaceAll('</script', '<\\/script');
const wasm = readFileSync(path.join(program, 'play.wasm'));
const licenses = listLicenses(bundled.metafile.inputs, modules);

const style = [...listOf('styles').map((name) => source('page', 'html', name)), source('page', 'play', 'play.css')].join('\n');
const hash = (text) => `'sha256-${createHash('sha256').update(text).digest('base64')}'`;

/** `parts`: what goes before the script. */
function pageOf({ scriptTag, scriptSource, connect, workers, parts }) {
  const page = source('page', 'html', 'page.html');
  const policy = ["default-src 'none'", "style-src 'unsafe-inline'", `script-src ${scriptSource} 'wasm-unsafe-eval'`,
                  `worker-src ${workers}`, `connect-src ${connect}`, 'img-src data:', "base-uri 'none'", "form-action 'none'"];
  return documentOf({ title: 'cbc play', policy, style, body: `<body class="play">
${source('page', 'play', 'play.html')}
<div id="run-page">
${between(page, '<header>', '</header>')}
${between(page, '<main>', '</main>')}
</div>
${between(page, '<dialog', '</dialog>')}
<div id="tip" role="tooltip" hidden></div>
<script type="application/json" id="saved-session">null</script>
${parts}${scriptTag}
</body>` });
}

mkdirSync(output, { recursive: true });
const write = (name, content) => writeFileSync(path.join(output, name), content);
write('play.wasm', wasm);
write('worker.js', workerScript);
write('play.js', script);
write('licenses.txt', licenses);
write('gallery.html', galleryPage(listed));
write('index.html', pageOf({
  scriptTag: '<script src="play.js"></script>', scriptSource: "'self'", connect: "'self'", workers: "'self'", parts: '',
}));
const packed = gzipSync(wasm, { level: 9 });
write('cbc-play.html', pageOf({
  // A worker that is made of a text has the rules of its page.
  scriptTag: `<script>${script}</script>`, scriptSource: `${hash(script)} blob:`, connect: "'none'", workers: 'blob:',
  parts: `<script type="text/plain" id="worker-script">${workerScript}</script>\n` +
    `<script type="text/plain" id="program">${packed.toString('base64')}</script>\n` +
    `<script type="text/plain" id="licenses">${licenses.replaceAll('<', '&lt;')}</script>\n`,
}));
const sizes = [wasm, script, workerScript, style, licenses].map((part) => gzipSync(part, { level: 9 }).length);
const sum = sizes.reduce((all, size) => all + size, 0);
console.log(`${output}: ${(sum / 1e6).toFixed(2)} MB compressed ` +
            `(program ${(sizes[0] / 1e6).toFixed(2)}, page ${((sum - sizes[0]) / 1e6).toFixed(2)})`);
