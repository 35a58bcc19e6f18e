// The side of the worker: takes one message after the other. `Cbc` and `unpack` are those of cbc.js.

const decoded = (bytes) => new TextDecoder().decode(bytes);

const bytesOf = ({ packed, address }) =>
  (packed === undefined ? fetch(address).then((response) => {
    if (!response.ok) throw new Error(`${address}: ${response.status} ${response.statusText}`);
    return response.arrayBuffer();
  }) : unpack(packed));

let program = null; // a promise of it
let session = null;

async function answerTo({ id, request, words, files }) {
  const cbc = await program;
  if (words === undefined) return (session ??= await cbc.openSession())(request);
  const { status, stdout, stderr, files: written } = await cbc.run(words, files,
    { onProgress: (progress) => self.postMessage({ id, progress }) });
  const texts = Object.fromEntries(Object.entries(written).map(([name, bytes]) => [name, decoded(bytes)]));
  return { status, stdout: decoded(stdout), stderr: decoded(stderr), files: texts };
}

self.addEventListener('message', async ({ data }) => {
  if (data.program !== undefined) {
    program = Cbc.load(bytesOf(data.program));
    program.catch(() => {}); // whoever asks is told
    return;
  }
  const { id } = data;
  try {
    self.postMessage({ id, answer: await answerTo(data) });
  } catch (error) {
    session = null; // a program that has failed is not asked again
    self.postMessage({ id, error: String(error.message ?? error) });
  }
});
