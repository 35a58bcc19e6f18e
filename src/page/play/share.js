// A session as text: in the address after "#", see packSession, and in a page that is saved.

const mostUnpacked = 20 << 20; // bytes
const longestLink = 30_000; // characters, more than which some programs do not pass on

/** What somebody should know before sending a link; empty: nothing. */
function doubtOf(link) {
  if (link.length > longestLink) {
    return ` It has ${quantity(link.length, 'character')}, more than some programs pass on: "save page" makes a file instead.`;
  }
  if (location.protocol === 'file:') return ' It opens only where this page is at the same path: "save page" makes a file for others.';
  // A page of `cbc play` has a session with files in it.
  const isServed = JSON.parse(partOf('saved-session'))?.files !== undefined;
  if (isServed) return ' It opens only on this machine, while "cbc play" runs: "save page" makes a file for others.';
  return '';
}

/** Throws an Error that says what is wrong with the text. */
async function unpackSession(text) {
  const [, version, packed] = /^(\d+)\.([\w-]*)$/.exec(text) ?? [];
  if (version === undefined) throw new Error('this link is damaged: a part of it may be missing');
  if (Number(version) > shareVersion) {
    throw new Error(`this link is of a newer version (${version}) of this page, which knows up to ${shareVersion}: open it where it came from`);
  }
  let session;
  try {
    const bytes = Uint8Array.from(atob(packed.replaceAll('-', '+').replaceAll('_', '/')), (letter) => letter.charCodeAt(0));
    const unpacked = await readAtMost(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate-raw')), mostUnpacked);
    session = JSON.parse(unpacked);
  } catch (error) {
    throw new Error(error instanceof RangeError ? error.message : 'this link is damaged: a part of it may be missing');
  }
  return checkSession(session, 'this link');
}

async function readAtMost(stream, most) {
  const reader = stream.getReader();
  const decoder = new TextDecoder();
  let text = '';
  for (let size = 0; ;) {
    const { done, value } = await reader.read();
    if (done) return text;
    size += value.length;
    if (size > most) throw new RangeError('this link has a session of more than 20 MB');
    text += decoder.decode(value, { stream: true });
  }
}

/** `what` the session comes from. */
function checkSession(session, what) {
  const isText = (value) => value === undefined || typeof value === 'string';
  const isRight = session !== null && typeof session === 'object' && typeof session.catalog === 'string' &&
    isText(session.mission) && isText(session.properties) && isText(session.name) &&
    (session.index === undefined || Number.isInteger(session.index));
  if (!isRight) throw new Error(`${what} is damaged: it has no catalog`);
  return session;
}

/** This page, before anything on it has changed. */
const pristinePage = `<!DOCTYPE html>\n${document.documentElement.outerHTML}`;
const emptySession = '<script type="application/json" id="saved-session">null</' + 'script>';

/** The page as one file that needs no other one, with a session in it. */
async function pageWith(session) {
  let text = pristinePage;
  if (partOf('worker-script') === null) {
    const response = await fetch(new URL('cbc-play.html', location.href));
    if (!response.ok) throw new Error('the page cannot be saved: cbc-play.html is not beside it');
    text = await response.text();
  }
  const json = JSON.stringify(session).replaceAll('<', '\\u003c');
  if (!text.includes(emptySession)) text = text.replace(/<script type="application\/json" id="saved-session">[^<]*<\/script>/, () => emptySession);
  return text.replace(emptySession, () => emptySession.replace('null', () => json));
}

function saveFile(text, name, type = 'text/plain') {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
