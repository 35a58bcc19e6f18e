// A session of the simulator, as text in its address, and the button that opens it with a run.
//
// The address has "s=", the version, a dot, and base64url of deflated JSON: {catalog, name, mission, properties, index}.

const shareVersion = 1;

async function throughStream(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

async function packSession(session) {
  const bytes = await throughStream(new TextEncoder().encode(JSON.stringify(session)), new CompressionStream('deflate-raw'));
  const text = [...bytes].map((byte) => String.fromCharCode(byte)).join('');
  return `${shareVersion}.${btoa(text).replaceAll('+', '-').replaceAll('/', '_').replace(/=+$/, '')}`;
}

/** Where a run goes on: null unless the simulator is on the same disk as this page, which has the texts. */
function continuationOf(run, catalog, mission, simulator) {
  if (simulator === undefined || mission === undefined || location.protocol !== 'file:') return null;
  return { simulator, session: { catalog, name: run.catalog.replace(/^.*\//, ''), mission } };
}

/** Opens the simulator after an event of a run; `index` undefined: after the last one. */
async function openSimulator({ simulator, session }, index) {
  open(`${simulator}#s=${await packSession({ ...session, index })}`, '_blank', 'noopener');
}
