// The program in WebAssembly. `createCbc` is what Emscripten makes, in the same file.

/** Decodes base64 of gzip, as a page has it that can fetch nothing. */
async function unpack(base64) {
  const packed = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

/** Makes a terminal of an instance. Lines of progress, which would be written over, go to `onProgress`. */
function addTerminal(FS, path, onProgress) {
  const device = FS.makedev(64, 0);
  let text = '';
  FS.registerDevice(device, {
    open: (stream) => Object.assign(stream, { tty: {}, seekable: false }),
    write: (stream, buffer, offset, length) => {
      const written = new TextDecoder().decode(buffer.slice(offset, offset + length));
      text += written.replace(/\r([^\n\x1b]*)\x1b\[K/g, (all, line) => {
        onProgress(line);
        return '';
      });
      return length;
    },
  });
  FS.mkdev(path, 0o600, device);
  return { bytes: () => new TextEncoder().encode(text) };
}

class Cbc {
  /** `bytes`: of play.wasm, or a promise of them. */
  static async load(bytes) {
    return new Cbc(await WebAssembly.compile(await bytes));
  }

  constructor(module) {
    this.module = module;
  }

  /** An instance with memory and files of its own. `environment`: variables -> values. */
  instantiate(environment = {}) {
    return createCbc({
      thisProgram: 'cbc',
      preRun: ({ ENV }) => Object.assign(ENV, environment),
      instantiateWasm: (imports, take) => {
        WebAssembly.instantiate(this.module, imports).then((instance) => take(instance, this.module));
        return {};
      },
    });
  }

  /**
   * Runs a command line as the program does, in an instance of its own, so that no run knows of another one.
   * `files`: path -> text or bytes, below the working directory `folder`. Returns {status, stdout, stderr, files}:
   * bytes of what it wrote; `files`: path -> bytes of those that are new or have changed, relative to `folder`.
   * `onProgress(line)`: takes what the program tells of its progress, as on a terminal.
   */
  async run(programArguments, files = {}, { stdin = '', folder = '/work', onProgress = null } = {}) {
    const { FS, callMain } = await this.instantiate(onProgress === null ? {} : { TERM: 'xterm', NO_COLOR: '1' });
    const write = (path, content) => {
      FS.mkdirTree(path.slice(0, path.lastIndexOf('/')));
      FS.writeFile(path, content);
    };
    FS.mkdirTree(folder);
    FS.chdir(folder);
    const before = new Map();
    for (const [path, content] of Object.entries(files)) {
      const whole = path.startsWith('/') ? path : `${folder}/${path}`;
      write(whole, content);
      before.set(whole, FS.readFile(whole));
    }
    // In this order, as an opened file takes the lowest free descriptor.
    write('/dev/shm/stdin', stdin);
    const terminal = onProgress === null ? null : addTerminal(FS, '/dev/shm/stderr', onProgress);
    for (const descriptor of [0, 1, 2]) FS.close(FS.streams[descriptor]);
    for (const [name, mode] of [['stdin', 'r'], ['stdout', 'w+'], ['stderr', 'w+']]) {
      FS.open(`/dev/shm/${name}`, mode);
    }
    const status = callMain([...programArguments]);
    const written = {};
    const visit = (at) => {
      for (const name of FS.readdir(at).filter((one) => one !== '.' && one !== '..')) {
        const path = `${at}/${name}`;
        if (FS.isDir(FS.stat(path).mode)) {
          visit(path);
        } else {
          const content = FS.readFile(path);
          if (!isSame(before.get(path), content)) written[path.slice(folder.length + 1)] = content;
        }
      }
    };
    visit(folder);
    const stderr = terminal === null ? FS.readFile('/dev/shm/stderr') : terminal.bytes();
    return { status, stdout: FS.readFile('/dev/shm/stdout'), stderr, files: written };
  }

  /** A session of the simulator: a function that takes a request and returns the answer; see session.h. */
  async openSession() {
    const program = await this.instantiate();
    return (request) => {
      // A text of any length; what ccall passes has to fit on the stack.
      const text = JSON.stringify(request);
      const size = program.lengthBytesUTF8(text) + 1;
      const place = program._malloc(size);
      program.stringToUTF8(text, place, size);
      const answer = program.UTF8ToString(program._cbc_session(place));
      program._free(place);
      return JSON.parse(answer);
    };
  }
}

function isSame(one, other) {
  return one !== undefined && one.length === other.length && one.every((byte, place) => byte === other[place]);
}
