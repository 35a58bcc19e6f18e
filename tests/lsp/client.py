"""A client of the Language Server Protocol that follows a script."""

import json
import os
import pathlib
import queue
import subprocess
import threading
import time
import urllib.parse

PROGRAM = os.environ["CBC_PROGRAM"]
SOURCE = pathlib.Path(__file__).resolve().parents[2]
CASES = pathlib.Path(os.environ["CBC_CASES"])  # of tests/golden, unpacked
PATIENCE = 60  # seconds of a busy machine
RECORD = os.environ.get("CBC_LSP_RECORD")  # a file that takes what servers say, for check_types.py
# What editors can do.
EDITOR = {
    "textDocument": {"completion": {"completionItem": {"snippetSupport": True}},
                     "documentSymbol": {"hierarchicalDocumentSymbolSupport": True}},
    "workspace": {"workspaceEdit": {"documentChanges": True, "resourceOperations": ["create"]},
                  "didChangeWatchedFiles": {"dynamicRegistration": True},
                  "inlayHint": {"refreshSupport": True}, "codeLens": {"refreshSupport": True}}}


def uri_of(path):
    if str(path).startswith("untitled:"):
        return path
    return "file://" + urllib.parse.quote(str(path))


def path_of(uri):
    return urllib.parse.unquote(uri.removeprefix("file://"))


class Client:
    """Talks to a server. Findings that come are kept, by path."""

    def __init__(self, *folders, capabilities=None, begin=True, options=()):
        self.process = subprocess.Popen([PROGRAM, "lsp", *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.inbox = queue.Queue()
        self.methods = {}  # of requests, by number
        self.findings = {}
        self.versions = {}
        self.requests = []  # of the server
        self.asked = 0
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()
        if begin:
            self.capabilities = self.ask("initialize", {
                "processId": os.getpid(), "rootUri": None, "capabilities": EDITOR if capabilities is None else capabilities,
                "workspaceFolders": [{"uri": uri_of(folder), "name": "folder"} for folder in folders]})["capabilities"]
            self.tell("initialized", {})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.reader.join()
        self.process.stdin.close()
        self.process.stdout.close()

    def _read(self):
        stream = self.process.stdout
        while True:
            header = stream.readline()
            if not header:
                break
            name, length = header.split(b": ")
            assert name == b"Content-Length" and stream.readline() == b"\r\n"
            message = json.loads(stream.read(int(length)))
            if RECORD:
                method = message.get("method") or self.methods.get(message["id"])
                with open(RECORD, "a", encoding="utf-8") as record:
                    record.write(json.dumps([method, message]) + "\n")
            self.inbox.put(message)
        self.inbox.put(None)

    def write(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        data = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self.write(b"Content-Length: %d\r\n\r\n" % len(data) + data)

    def tell(self, method, params):
        self.send({"method": method, "params": params})

    def receive(self):
        """The next message; None at the end."""
        message = self.inbox.get(timeout=PATIENCE)
        if message is None:
            return None
        if message.get("method") == "textDocument/publishDiagnostics":
            params = message["params"]
            self.findings[path_of(params["uri"])] = params["diagnostics"]
            self.versions[path_of(params["uri"])] = params.get("version")
        elif "method" in message:
            self.requests.append(message)
        return message

    def answer(self, identity):
        while True:
            message = self.receive()
            assert message is not None, "the server is gone"
            if message.get("id") == identity and "method" not in message:
                return message

    def try_ask(self, method, params):
        """The whole answer, which may be an error."""
        self.asked += 1
        self.methods[self.asked] = method
        self.send({"id": self.asked, "method": method, "params": params})
        return self.answer(self.asked)

    def ask(self, method, params):
        answer = self.try_ask(method, params)
        assert "error" not in answer, answer["error"]
        return answer["result"]

    def settle(self):
        """Until there is nothing more to find."""
        while self.ask("cbc/isIdle", {}) is not True:
            time.sleep(0.002)

    def open(self, path, text=None, version=1):
        text = pathlib.Path(path).read_bytes().decode() if text is None else text
        self.tell("textDocument/didOpen", {"textDocument": {
            "uri": uri_of(path), "languageId": "yaml", "version": version, "text": text}})

    def change(self, path, version, *changes):
        self.tell("textDocument/didChange", {"textDocument": {"uri": uri_of(path), "version": version},
                                             "contentChanges": list(changes)})

    def close(self, path):
        self.tell("textDocument/didClose", {"textDocument": {"uri": uri_of(path)}})

    def at(self, method, path, line, character, **more):
        return self.ask("textDocument/" + method, {
            "textDocument": {"uri": uri_of(path)}, "position": {"line": line, "character": character}, **more})

    def of(self, method, path, **more):
        return self.ask("textDocument/" + method, {"textDocument": {"uri": uri_of(path)}, **more})


def span(line, begin, end_line, end):
    return {"start": {"line": line, "character": begin}, "end": {"line": end_line, "character": end}}


def run_cbc(*arguments, cwd=SOURCE):
    done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, check=False, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    return done.returncode, done.stdout.decode(), done.stderr.decode()
