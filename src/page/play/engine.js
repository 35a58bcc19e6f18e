// The program, in a worker: the page stays alive whatever it is asked, and what takes too long can be ended.

/** Texts of the page that the build puts in place; null where they are files beside it. */
const partOf = (id) => document.getElementById(id)?.textContent ?? null;

/** Where a worker finds the program: its text, and the bytes or the address of the WebAssembly. */
const programParts = (() => {
  let parts;
  return () => {
    const script = partOf('worker-script');
    parts ??= script === null
      ? { worker: new URL('worker.js', location.href), program: { address: new URL('play.wasm', location.href).href } }
      : { worker: URL.createObjectURL(new Blob([script], { type: 'text/javascript' })),
          program: { packed: partOf('program').trim() } };
    return parts;
  };
})();

/** Why there is no answer: the work was ended, by the user or by a limit. */
class Ended extends Error {}

/** The program itself has failed, which knows of nothing from then on. */
class Failed extends Error {}

/** Whether the program is lost. */
const isEnd = (error) => error instanceof Ended || error instanceof Failed;

class Engine {
  constructor() {
    this.waiting = new Map(); // of each question: how to answer it
    this.count = 0;
    this.begin();
  }

  begin() {
    const { worker, program } = programParts();
    try {
      this.worker = new Worker(worker);
    } catch {
      this.worker = null; // a browser lets no page from a disk use a file beside it
      return;
    }
    this.worker.addEventListener('message', ({ data }) => this.take(data));
    this.worker.addEventListener('error', (event) => {
      event.preventDefault();
      this.end(new Failed(`the program has failed: ${event.message ?? 'it could not be loaded'}`));
    });
    this.worker.postMessage({ program });
  }

  take({ id, progress, answer, error }) {
    const { resolve, reject, onProgress } = this.waiting.get(id);
    if (progress !== undefined) return onProgress(progress);
    this.waiting.delete(id);
    if (error === undefined) return resolve(answer);
    return reject(new Failed(`the program has failed: ${error}`));
  }

  send(message, onProgress) {
    if (this.worker === null) {
      return Promise.reject(new Failed('this page needs a web server: open cbc-play.html beside it, which needs none'));
    }
    return new Promise((resolve, reject) => {
      const id = ++this.count;
      this.waiting.set(id, { resolve, reject, onProgress });
      this.worker.postMessage({ id, ...message });
    });
  }

  /** A request of the session, see session.h. */
  async ask(request) {
    const answer = await this.send({ request });
    if (answer.error !== undefined) throw new Error(answer.error);
    return answer;
  }

  /** A command line: {status, stdout, stderr, files}, all as texts. `onProgress(line)`: what is being done. */
  run(words, files, onProgress) {
    return this.send({ words, files }, onProgress);
  }

  get isBusy() {
    return this.waiting.size > 0;
  }

  /** Ends whatever is being done; a new program takes its place, which knows of nothing. */
  end(reason = new Ended('It was stopped.')) {
    this.close(reason);
    this.begin();
  }

  /** The same, for good. */
  close(reason = new Ended('It was stopped.')) {
    this.worker?.terminate();
    const waiting = [...this.waiting.values()];
    this.waiting.clear();
    for (const { reject } of waiting) reject(reason);
  }
}
