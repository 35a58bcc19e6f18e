// node pack.js SOURCES BUILT OUTPUT: makes the files of the page, which need nothing else.
//
//   index.html, play.js, play.wasm   for a server
//   play.html                        all of it in one file, also for a browser that opens it from a disk,
//                                    where a page can fetch nothing
'use strict';

const fs = require('node:fs');
const path = require('node:path');
const zlib = require('node:zlib');

const [sources, built, output] = process.argv.slice(2);
const wasm = fs.readFileSync(path.join(built, 'play.wasm'));
const packed = zlib.gzipSync(wasm, { level: 9 });
const script = [path.join(built, 'play.js'), path.join(sources, 'cbc.js'), path.join(sources, 'start.js')]
  .map((file) => fs.readFileSync(file, 'utf8')).join('\n');
const page = fs.readFileSync(path.join(sources, 'index.html'), 'utf8');
const pageWith = (program) => page.replace('PROGRAM', () => program);

fs.rmSync(output, { recursive: true, force: true });
fs.mkdirSync(output, { recursive: true });
const write = (name, content) => fs.writeFileSync(path.join(output, name), content);
write('play.wasm', wasm);
write('play.js', script);
write('index.html', pageWith('<script src="play.js"></script>\n'
  + "<script>start(fetch('play.wasm').then((answer) => answer.arrayBuffer()));</script>"));
// In a script element, "</script" would end it.
write('play.html', pageWith(`<script>${script.replaceAll('</script', '<\\/script')}\n`
  + `start(unpack('${packed.toString('base64')}'));</script>`));

const compressed = packed.length + zlib.gzipSync(script, { level: 9 }).length;
const { size } = fs.statSync(path.join(output, 'play.html'));
console.log(`play.wasm and play.js: ${compressed} bytes compressed; play.html: ${size} bytes`);
const most = 1.5e6;
if (compressed > most) {
  console.error(`expected at most ${most} bytes`);
  process.exitCode = 1;
}
