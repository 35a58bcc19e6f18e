"""`cbc lsp` as an editor sees it, by a client that follows scripts."""

import html
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import tempfile
import unittest

from client import CASES, PATIENCE, SOURCE, Client, run_cbc, span, uri_of

ROBOT = """\
situation:
- {variable: AIR, values: [clear, dusty]}
behaviors:
- {behavior: DRIVE_FAST, task: DRIVE, suitability: 90, requires: [{task: LOCALIZE}], situation: {AIR: clear}}
- {behavior: DRIVE_SLOWLY, task: DRIVE, suitability: 50}
- {behavior: LIDAR, task: LOCALIZE}
tasks:
- {task: DRIVE}
- {task: LOCALIZE, start_on_request: false}
"""
MISSION = """\
catalog: robot.yaml
events:
- start: DRIVE
- expect: {active: [DRIVE_FAST, LIDAR]}
- situation: {AIR: dusty}
- expect: {running: {DRIVE: DRIVE_FAST}}
"""
PROPERTIES = """\
catalog: robot.yaml
properties:
- {name: drives somehow, can_start: DRIVE}
"""
SETTINGS = "warn: [can-run-together]\nnever_together:\n- [DRIVE, LOCALIZE]\n"


def units(text):
    return len(text.encode("utf-16-le")) // 2


class LspTest(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, self.folder)
        self.robot = self.write("robot.yaml", ROBOT)
        self.mission = self.write("mission.yaml", MISSION)
        self.properties = self.write("robot.properties.yaml", PROPERTIES)

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text.encode())
        return path

    def start(self, **options):
        client = Client(self.folder, **options)
        self.addCleanup(client.__exit__)
        return client

    def messages(self, client, path):
        return [finding["message"] for finding in client.findings.get(str(path), [])]

    def of_lint(self, folder):
        """Rule, level, message and range of each finding, by file, as the protocol has them."""
        _, output, complaints = run_cbc("lint", "--format", "json", folder)
        levels = {"error": 1, "warning": 2, "note": 3}
        findings = {}
        for file in json.loads(output or '{"files": []}')["files"]:
            path = os.path.normpath(file["file"])
            lines = pathlib.Path(path).read_bytes().decode(errors="replace").split("\n")
            mark = lines[0].startswith("\ufeff")

            def place(line, column):
                text = lines[line - 1] if line <= len(lines) else ""
                return line - 1, units(text[:column - 1 + (mark and line == 1)])

            for found in file["diagnostics"]:
                findings.setdefault(path, []).append((
                    found["rule"], levels[found["severity"]], found["message"],
                    place(found["line"], found["column"]), place(found["end_line"], found["end_column"])))
        return {path: sorted(found) for path, found in findings.items()}, complaints

    def of_server(self, client):
        client.settle()
        place = lambda at: (at["line"], at["character"])
        return {path: sorted((found["code"], found["severity"], found["message"],
                              place(found["range"]["start"]), place(found["range"]["end"])) for found in findings)
                for path, findings in client.findings.items() if findings}

    def check_equal(self, client, folder):
        expected, complaints = self.of_lint(folder)
        found = self.of_server(client)
        # What is not checked has no findings in a report, but a complaint.
        unchecked = re.findall(r"^cbc: (.*):(\d+):(\d+): this .* is not checked, .* cannot be used(?!; correct)",
                               complaints, re.MULTILINE)
        for path, line, column in unchecked:
            (finding,) = found.pop(os.path.normpath(path))
            self.assertEqual(finding[3], (int(line) - 1, int(column) - 1), path)
        for path in sorted(expected.keys() | found.keys()):
            if path.endswith(".cbc.yaml") and path not in expected:
                # Those of settings that cannot be used are complaints, too.
                said = re.findall(rf"^{re.escape(path)}:(\d+):(\d+): error: (.*) \[(.*)\]$", complaints, re.MULTILINE)
                self.assertEqual(sorted((str(line + 1), str(column + 1), message, rule)
                                        for rule, _, message, (line, column), _ in found[path]), sorted(set(said)), path)
                continue
            self.assertEqual(found.get(path), expected.get(path), path)
        return len(unchecked)


class Protocol(LspTest):
    def test_errors(self):
        client = self.start(begin=False)
        self.assertEqual(client.try_ask("textDocument/hover", {})["error"]["code"], -32002)
        client.tell("textDocument/didOpen", {})  # too early, and no answer
        client.ask("initialize", {"processId": None, "rootUri": uri_of(self.folder), "capabilities": {}})
        for method, params, code in (("no/such", {}, -32601), ("textDocument/hover", {}, -32602),
                                     ("textDocument/hover", None, -32602), ("textDocument/hover", [1], -32602),
                                     ("initialize", {}, -32803)):
            self.assertEqual(client.try_ask(method, params)["error"]["code"], code, method)
        client.write(b"Content-Length: 3\r\n\r\n[1,")
        self.assertEqual(client.answer(None)["error"]["code"], -32700)
        client.write(b"content-length:2\r\nContent-Type: x\r\n\r\n{}")
        self.assertEqual(client.answer(None)["error"]["code"], -32600)
        client.tell("no/such", {})
        client.tell("$/setTrace", {"value": "off"})
        self.assertIsNone(client.ask("shutdown", None))
        self.assertEqual(client.try_ask("textDocument/hover", {})["error"]["code"], -32600)
        client.tell("exit", None)
        self.assertEqual(client.process.wait(PATIENCE), 0)

    def test_what_no_client_should_send(self):
        client = self.start()
        deep = b'{"jsonrpc": "2.0", "id": ' + b"[" * 100000 + b"]" * 100000 + b', "method": "x"}'
        client.write(b"Content-Length: %d\r\n\r\n" % len(deep) + deep)
        self.assertEqual(client.answer(None)["error"]["code"], -32600)
        for identity in (True, 1.5, {}, [1]):
            client.send({"id": identity, "method": "shutdown"})
            self.assertEqual(client.answer(None)["error"]["code"], -32600)
        hover = {"textDocument": {"uri": uri_of(self.robot)}}
        for place in ({"line": -1, "character": 0}, {"line": 1e300, "character": 0}, {"line": 0}):
            answer = client.try_ask("textDocument/hover", {**hover, "position": place})
            self.assertEqual(answer["error"]["code"], -32602, place)
        client.ask("textDocument/hover", {**hover, "position": {"line": 2**64 - 1, "character": 2**40}})
        # Half of a character, and a range that is null.
        client.open(self.robot)
        client.change(self.robot, 2, {"range": None, "text": ROBOT + "# \ud83d"})
        client.change(self.robot, 3, {"range": span(9, 0, 9, 3), "text": "- {task: MORE}"})
        self.assertEqual(client.of("documentSymbol", self.robot)[2]["children"][-1]["name"], "MORE")

    def test_requests_that_were_cancelled(self):
        client = self.start()
        client.send({"id": "a", "method": "textDocument/documentSymbol",
                     "params": {"textDocument": {"uri": uri_of(self.robot)}}})
        client.tell("$/cancelRequest", {"id": "a"})
        answer = client.answer("a")
        self.assertIn(answer.get("error", {}).get("code"), (None, -32800))

    def test_the_end(self):
        for end in ("exit", "close", "garbage"):
            client = self.start()
            if end == "exit":
                client.tell("exit", None)
            elif end == "close":
                client.process.stdin.close()
            else:
                client.write(b"What is this?\r\n\r\n")
            self.assertEqual(client.process.wait(PATIENCE), 1)

    def test_a_client_that_is_gone(self):
        parent = subprocess.Popen(["sleep", "600"])
        client = self.start(begin=False)
        client.ask("initialize", {"processId": parent.pid, "rootUri": None, "capabilities": {}})
        parent.send_signal(signal.SIGKILL)
        parent.wait()
        self.assertEqual(client.process.wait(PATIENCE), 1)

    def test_places_with_characters_of_any_length(self):
        text = ROBOT.replace("DRIVE_SLOWLY", "\U0001F422_é").replace("\n", "\r\n")
        line = next(at for at, words in enumerate(text.splitlines()) if "\U0001F422" in words)
        column = text.splitlines()[line].index("\U0001F422")
        for encodings, end in ((["utf-16"], column + 4), (["utf-8", "utf-16"], column + 7)):
            client = self.start(capabilities={"general": {"positionEncodings": encodings}})
            self.assertEqual(client.capabilities["positionEncoding"], encodings[0])
            client.open(self.robot, text)
            found = client.at("documentHighlight", self.robot, line, end)
            self.assertEqual([item["range"] for item in found], [span(line, column, line, end)])
            # An edit behind the name, and one that takes it away.
            client.change(self.robot, 2, {"range": span(line, end, line, end), "text": "x"})
            found = client.at("documentHighlight", self.robot, line, end)
            self.assertEqual(found[0]["range"], span(line, column, line, end + 1))
            client.change(self.robot, 3, {"range": span(line, column, line, end + 1), "text": "SLOW"},
                          {"range": span(line, column, line, column), "text": "VERY_"})
            found = client.at("documentHighlight", self.robot, line, column)
            self.assertEqual(found[0]["range"], span(line, column, line, column + 9))


    def test_one_long_line(self):
        tasks = [f"T{number}_\U0001F422" for number in range(3000)]
        text = json.dumps({"behaviors": [{"behavior": "B_" + task, "task": task} for task in tasks]},
                          ensure_ascii=False)
        client = self.start()
        client.open(self.robot, text)
        for task in (tasks[0], tasks[1], tasks[1999], tasks[-1]):
            begin = units(text[:text.index(f'"{task}"')])
            end = begin + units(task) + 2
            for column in (begin, end - 1):
                found = client.at("documentHighlight", self.robot, 0, column)
                self.assertEqual([item["range"] for item in found], [span(0, begin, 0, end)])

    def test_a_client_that_can_do_little(self):
        client = self.start(capabilities={})
        symbols = {(symbol["name"], symbol.get("containerName")) for symbol in client.of("documentSymbol", self.robot)}
        self.assertTrue({("behaviors", None), ("LIDAR", "behaviors")} <= symbols)
        edit = client.at("rename", self.mission, *Names.place_of(self, MISSION, "LIDAR]", "LIDAR"), newName="RADAR")
        self.assertEqual(edit.keys(), {"changes"})
        self.assertEqual(edit["changes"].keys(), {uri_of(self.robot), uri_of(self.mission)})
        client.open(self.mission, MISSION + "- ")
        for item in client.at("completion", self.mission, MISSION.count("\n"), 2)["items"]:
            self.assertNotIn("${", item["textEdit"]["newText"])
            self.assertEqual(item["insertTextFormat"], 1)
        client.open(self.robot, ROBOT.replace("- {task: LOCALIZE", "- {task: EXTRA}\n- {task: LOCALIZE"))
        client.settle()
        found = client.findings[str(self.robot)][0]
        fixes = client.of("codeAction", self.robot, range=found["range"], context={"diagnostics": []})
        self.assertTrue(fixes)
        self.assertTrue(all("changes" in fix["edit"] for fix in fixes))
        self.assertEqual(client.requests, [])
        # Without word of the client, the server looks at the disk itself.
        self.write("robot.yaml", ROBOT)
        self.write("robot.properties.yaml", PROPERTIES.replace("can_start: DRIVE", "can_start: DIVE"))
        while not client.findings.get(str(self.properties)):
            client.receive()

    def test_hints_are_asked_for_again(self):
        client = self.start()
        client.open(self.mission)
        client.settle()
        client.requests.clear()
        client.open(self.mission, MISSION + "- start: LOCALIZE\n", 2)
        client.settle()
        self.assertEqual(client.requests, [])
        client.open(self.robot, ROBOT.replace("suitability: 50", "suitability: 60"))
        client.settle()
        renewed = {"workspace/inlayHint/refresh", "workspace/codeLens/refresh"}
        self.assertEqual({request["method"] for request in client.requests}, renewed)
        client.requests.clear()
        self.robot.unlink()
        client.close(self.robot)
        client.settle()
        self.assertEqual({request["method"] for request in client.requests}, renewed)


class Findings(LspTest):
    def test_the_corpus(self):
        for folder in (SOURCE / "catalogs", SOURCE / "docs", CASES):
            with Client(folder) as client:
                self.check_equal(client, folder)

    def test_versions_and_closed_files(self):
        client = self.start()
        client.open(self.robot, ROBOT.replace("task: LOCALIZE}]", "task: LOCALISE}]"), version=7)
        client.settle()
        self.assertIn("did you mean 'LOCALIZE'?", self.messages(client, self.robot)[0])
        self.assertEqual(client.versions[str(self.robot)], 7)
        client.close(self.robot)
        client.settle()
        self.assertEqual(self.messages(client, self.robot), [])
        outside = pathlib.Path(tempfile.mkdtemp()).resolve() / "other.yaml"
        client.open(outside, "behaviors: 5\n")
        client.settle()
        self.assertEqual(len(self.messages(client, outside)), 1)
        client.close(outside)
        client.settle()
        self.assertEqual(self.messages(client, outside), [])

    def test_no_finding_is_of_another_version(self):
        client = self.start()
        client.open(self.robot)
        client.settle()
        client.change(self.robot, 2, {"text": "behaviors: 5\n"})
        client.of("codeLens", self.robot)  # which looks for findings
        client.change(self.robot, 3, {"text": ROBOT})
        client.settle()
        self.assertEqual((client.versions[str(self.robot)], self.messages(client, self.robot)), (3, []))

    def test_folder_with_a_slash_at_its_end(self):
        self.write("bad.yaml", "behaviors: 5\n")
        with Client(str(self.folder) + "/") as client:
            client.settle()
            self.assertEqual(len(self.messages(client, self.folder / "bad.yaml")), 1)

    def test_settings_that_are_half_written(self):
        client = self.start()
        settings = self.write(".cbc.yaml", SETTINGS)
        client.open(settings)
        client.settle()
        before = self.messages(client, self.robot)
        client.change(settings, 2, {"text": SETTINGS + "strict: tru"})
        client.settle()
        self.assertEqual((self.messages(client, self.robot), len(self.messages(client, settings))), (before, 1))

    def test_what_depends_on_a_catalog(self):
        client = self.start()
        client.open(self.robot)
        client.settle()
        self.assertEqual(self.messages(client, self.mission), [])
        client.change(self.robot, 2, {"text": ROBOT.replace("DRIVE", "DRIVING")})
        client.settle()
        self.assertIn("DRIVE", self.messages(client, self.mission)[0])
        self.assertIn("DRIVE", self.messages(client, self.properties)[0])
        client.change(self.robot, 3, {"text": "behaviors: [{\n"})
        client.settle()
        self.assertEqual(len(self.messages(client, self.robot)), 1)
        client.change(self.robot, 4, {"text": ROBOT})
        client.settle()
        self.assertEqual(self.messages(client, self.mission), [])

    def test_a_catalog_that_cannot_be_used(self):
        client = self.start()
        client.open(self.mission)
        client.open(self.properties)
        said = {}

        def check(name, reason, line=1):
            client.settle()
            for path, what in ((self.mission, "script"), (self.properties, "property file")):
                (found,) = client.findings[str(path)]
                self.assertEqual((found["message"], found["severity"], found["range"]),
                                 (f"this {what} is not checked: {reason}", 1, span(0, 9, 0, 9 + len(name))))
                self.assertIn(f"{path}:1:10: this {what} is not checked", run_cbc("lint", path)[2])
                said[what] = client.at("hover", path, 0, 12)
                self.assertEqual(client.of("inlayHint", path, range=span(0, 0, 99, 0)), [])
                client.of("codeAction", path, range=span(0, 0, 99, 0), context={"diagnostics": []})

        self.robot.unlink()
        gone = {"changes": [{"uri": uri_of(self.robot), "type": 3}]}
        client.tell("workspace/didChangeWatchedFiles", gone)
        check("robot.yaml", "cannot read 'robot.yaml': No such file or directory")
        for text, reason in (("", "'robot.yaml' is not a catalog"),
                             (MISSION, "'robot.yaml' is a script; expected a catalog here")):
            self.write("robot.yaml", text)
            client.tell("workspace/didChangeWatchedFiles", gone)
            check("robot.yaml", reason)
        # Its own errors say enough.
        for text in ("behaviors: [{\n", ROBOT):
            self.write("robot.yaml", text)
            client.tell("workspace/didChangeWatchedFiles", gone)
            client.settle()
            self.assertEqual(self.messages(client, self.mission) + self.messages(client, self.properties), [])
        # Where they are not shown, they do not.
        elsewhere = pathlib.Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, elsewhere)
        other = elsewhere / "robot.yaml"
        other.write_text("behaviors: [{\n")
        for version, path in enumerate((self.mission, self.properties), 2):
            text = path.read_text().replace("robot.yaml", str(other))
            self.write(path.name, text)
            client.change(path, version, {"text": text})
        check(str(other), f"the catalog '{other}' cannot be used; 'cbc lint' says why")

    def test_files_that_come_and_go(self):
        client = self.start(capabilities={"workspace": {"didChangeWatchedFiles": {"dynamicRegistration": True}}})
        client.settle()
        self.assertEqual(client.requests[0]["method"], "client/registerCapability")
        bad = self.write("bad.yaml", "behaviors: 5\n")
        changed = {"uri": uri_of(bad), "type": 1}
        client.tell("workspace/didChangeWatchedFiles", {"changes": [changed]})
        client.settle()
        self.assertEqual(len(self.messages(client, bad)), 1)
        bad.unlink()
        client.tell("workspace/didChangeWatchedFiles", {"changes": [{**changed, "type": 3}]})
        client.settle()
        self.assertEqual(self.messages(client, bad), [])

    def test_settings(self):
        client = self.start()
        settings = self.write(".cbc.yaml", SETTINGS)
        client.open(settings)
        client.settle()
        self.assertIn("DRIVE", " ".join(self.messages(client, self.robot)))
        client.change(settings, 2, {"text": SETTINGS.replace("LOCALIZE]", "LOCALISE]")})
        client.settle()
        self.assertIn("LOCALISE", self.messages(client, settings)[0])

    def test_settings_that_are_not_saved(self):
        client = self.start()
        client.open(self.folder / ".cbc.yaml", SETTINGS)
        client.settle()
        self.assertEqual([found["code"] for found in client.findings[str(self.robot)]], ["can-run-together"])
        client.close(self.folder / ".cbc.yaml")
        client.settle()
        self.assertEqual(self.messages(client, self.robot), [])

    def test_a_catalog_elsewhere(self):
        elsewhere = pathlib.Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, elsewhere)
        robot = elsewhere / "robot.yaml"
        mission = self.write("far.mission.yaml", MISSION.replace("robot.yaml", str(robot)))
        client = self.start()
        client.open(mission)
        client.settle()
        self.assertEqual(client.of("inlayHint", mission, range=span(0, 0, 99, 0)), [])
        for text, has_findings in ((ROBOT, False), (ROBOT.replace("LIDAR", "RADAR"), True), (ROBOT, False)):
            robot.write_text(text)
            while bool(self.messages(client, mission)) != has_findings:
                client.receive()
        # It is no catalog of the folder, which has one.
        self.assertEqual(client.of("codeLens", self.write("plain.yaml", MISSION.split("\n", 1)[1])), [])

    def test_a_text_without_a_file(self):
        client = self.start()
        name = "untitled:Untitled-1"
        client.open(name, ROBOT.replace("requires: [{task: LOCALIZE", "requires: [{task: LOCALISE"))
        client.settle()
        self.assertEqual([found["code"] for found in client.findings[name]], ["undefined-task"])
        client.open(name, ROBOT, 2)
        client.settle()
        self.assertEqual(self.messages(client, name), [])

    def test_folders(self):
        other = pathlib.Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, other)
        (other / "bad.yaml").write_text("behaviors: 5\n")
        client = self.start()
        folder = {"uri": uri_of(other), "name": "other"}
        client.tell("workspace/didChangeWorkspaceFolders", {"event": {"added": [folder], "removed": []}})
        client.settle()
        self.assertEqual(len(self.messages(client, other / "bad.yaml")), 1)
        client.tell("workspace/didChangeWorkspaceFolders", {"event": {"added": [], "removed": [folder]}})
        client.settle()
        self.assertEqual(self.messages(client, other / "bad.yaml"), [])

    def test_names_in_a_folder_that_was_removed(self):
        other = pathlib.Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, other)
        (other / "far.yaml").write_text(MISSION.replace("robot.yaml", str(self.robot)))
        client = self.start()
        folder = {"uri": uri_of(other), "name": "other"}
        place = Names.place_of(self, ROBOT, "- {task: DRIVE", "DRIVE")
        for added, removed, count in (([folder], [], 4), ([], [folder], 3)):
            client.tell("workspace/didChangeWorkspaceFolders", {"event": {"added": added, "removed": removed}})
            found = client.at("references", self.robot, *place, context={"includeDeclaration": True})
            self.assertEqual(len({item["uri"] for item in found}), count)
            edit = client.at("rename", self.robot, *place, newName="GO")
            self.assertEqual(len(edit["documentChanges"]), count)

    def test_random_edits_end_as_a_fresh_lint(self):
        draw = random.Random(5)
        client = self.start()
        texts = {path: path.read_text() for path in (self.robot, self.mission, self.properties)}
        for path in texts:
            client.open(path)
        pieces = ["\n", "- ", "{", "}", "[", "]", ": ", "\"", "'", "#", "task", "DRIVE", "é\U0001F422", "\t", "  ", "x"]
        edits = int(os.environ.get("CBC_LSP_EDITS", "1000000" if os.environ.get("CBC_NIGHT") else "300"))
        memory = {}  # KiB, after edits
        for version in range(2, edits):
            if version in (edits // 3, edits - 1):
                memory[version] = int(re.search(r"VmRSS:\s*(\d+)", pathlib.Path(
                    f"/proc/{client.process.pid}/status").read_text())[1])
            path = draw.choice(list(texts))
            text = texts[path]
            begin = draw.randrange(len(text) + 1)
            end = min(len(text), begin + draw.choice([0, 0, 1, 5, 40]))
            piece = draw.choice(pieces)
            place = lambda at: {"line": text.count("\n", 0, at),
                                "character": units(text[text.rfind("\n", 0, at) + 1:at])}
            client.change(path, version, {"range": {"start": place(begin), "end": place(end)}, "text": piece})
            texts[path] = text[:begin] + piece + text[end:]
            if draw.random() < 0.2:
                method = draw.choice(["hover", "completion", "definition", "documentHighlight", "references"])
                client.at(method, path, draw.randrange(12), draw.randrange(30), context={"includeDeclaration": True})
            if draw.random() < 0.1:
                client.of(draw.choice(["documentSymbol", "foldingRange"]), path)
                client.of(draw.choice(["codeAction", "inlayHint"]), path, range=span(0, 0, 99, 0), context={})
            if draw.random() < 0.02:
                texts[path] = {self.robot: ROBOT, self.mission: MISSION, self.properties: PROPERTIES}[path]
                client.change(path, version, {"text": texts[path]})
        for path, text in texts.items():
            path.write_bytes(text.encode())
            client.close(path)
        self.check_equal(client, self.folder)
        if edits >= 100000:
            self.assertLess(memory[edits - 1], memory[edits // 3] + 1024)


class Names(LspTest):
    def place_of(self, text, words, behind):
        offset = text.index(words) + words.index(behind)
        return text.count("\n", 0, offset), offset - text.rfind("\n", 0, offset) - 1

    def test_definitions(self):
        client = self.start()
        task = self.place_of(ROBOT, "- {task: DRIVE}", "DRIVE")
        behavior = self.place_of(ROBOT, "behavior: LIDAR", "LIDAR")
        variable = self.place_of(ROBOT, "variable: AIR", "AIR")
        for path, text, words, behind, place in (
                (self.robot, ROBOT, "task: DRIVE, suitability: 90", "DRIVE", task),
                (self.robot, ROBOT, "requires: [{task: LOCALIZE", "LOCALIZE",
                 self.place_of(ROBOT, "- {task: LOCALIZE", "LOCALIZE")),
                (self.mission, MISSION, "start: DRIVE", "DRIVE", task),
                (self.mission, MISSION, "LIDAR]", "LIDAR", behavior),
                (self.mission, MISSION, "{AIR: dusty", "AIR", variable),
                (self.properties, PROPERTIES, "can_start: DRIVE", "DRIVE", task)):
            found = client.at("definition", path, *self.place_of(text, words, behind))
            self.assertEqual((found["uri"], found["range"]["start"]),
                             (uri_of(self.robot), {"line": place[0], "character": place[1]}), words)
        value = client.at("definition", self.mission, *self.place_of(MISSION, "AIR: dusty", "dusty"))
        self.assertEqual(value["range"]["start"]["character"], self.place_of(ROBOT, "dusty", "dusty")[1])
        robot = ROBOT.replace("{task: DRIVE}", "{task: DRIVE, parameters: [{parameter: speed, allowed_values: [0, 3]}]}")
        mission = MISSION.replace("start: DRIVE", "start: DRIVE\n  parameters: {speed: 2}")
        client.open(self.robot, robot)
        client.open(self.mission, mission)
        for words in ("{speed", "speed: 2"):
            parameter = client.at("definition", self.mission, *self.place_of(mission, words, words.strip("{")))
            place = self.place_of(robot, "parameter: speed", "speed")
            self.assertEqual(parameter["range"]["start"], {"line": place[0], "character": place[1]})
        self.assertEqual(client.at("definition", self.mission, 0, 12)["uri"], uri_of(self.robot))
        self.assertIsNone(client.at("definition", self.mission, 1, 2))

    def test_references(self):
        client = self.start()
        found = client.at("references", self.mission, *self.place_of(MISSION, "start: DRIVE", "DRIVE"),
                          context={"includeDeclaration": True})
        counts = {path: sum(item["uri"] == uri_of(path) for item in found)
                  for path in (self.robot, self.mission, self.properties)}
        self.assertEqual(counts, {self.robot: 3, self.mission: 2, self.properties: 1})
        fewer = client.at("references", self.mission, *self.place_of(MISSION, "start: DRIVE", "DRIVE"),
                          context={"includeDeclaration": False})
        self.assertEqual(len(fewer), len(found) - 1)

    def apply(self, text, edits):
        lines = text.splitlines(keepends=True)
        offset = lambda place: sum(map(len, lines[:place["line"]])) + place["character"]
        for edit in sorted(edits, key=lambda edit: -offset(edit["range"]["start"])):
            begin, end = offset(edit["range"]["start"]), offset(edit["range"]["end"])
            text = text[:begin] + edit["newText"] + text[end:]
        return text

    def test_rename_does_what_the_command_does(self):
        self.write(".cbc.yaml", SETTINGS)
        client = self.start()
        client.open(self.mission, version=3)
        for kind, old, new, path, text, words in (
                ("task", "DRIVE", "GO", self.mission, MISSION, "start: DRIVE"),
                ("behavior", "LIDAR", "a: b", self.mission, MISSION, "LIDAR]"),
                ("variable", "AIR", "DUST", self.robot, ROBOT, "variable: AIR")):
            place = self.place_of(text, words, old)
            self.assertEqual(client.at("prepareRename", path, *place)["placeholder"], old)
            changes = client.at("rename", path, *place, newName=new)["documentChanges"]
            folder = pathlib.Path(tempfile.mkdtemp())
            shutil.copytree(self.folder, folder / "copy")
            status, _, said = run_cbc("rename", kind, old, new, folder / "copy")
            self.assertEqual(status, 0, said)
            changed = {change["textDocument"]["uri"]: change for change in changes}
            for name in ("robot.yaml", "mission.yaml", "robot.properties.yaml", ".cbc.yaml"):
                before = (self.folder / name).read_text()
                edits = changed.get(uri_of(self.folder / name), {"edits": []})["edits"]
                self.assertEqual(self.apply(before, edits), (folder / "copy" / name).read_text(), name)
            shutil.rmtree(folder)
            mission = changed.get(uri_of(self.mission))
            if mission:
                self.assertEqual(mission["textDocument"]["version"], 3)

    def test_names_that_nothing_can_get(self):
        client = self.start()
        place = self.place_of(MISSION, "start: DRIVE", "DRIVE")
        for new, reason in (("", "empty"), ("LOCALIZE", "already"), ("DRIVE", "old name"), ("a\n", "printable")):
            answer = client.try_ask("textDocument/rename", {
                "textDocument": {"uri": uri_of(self.mission)}, "newName": new,
                "position": {"line": place[0], "character": place[1]}})
            self.assertIn(reason, answer["error"]["message"])
        client.open(self.properties, "catalog: robot.yaml\nproperties: [{can_start: DRIVE\n")
        answer = client.try_ask("textDocument/rename", {
            "textDocument": {"uri": uri_of(self.mission)}, "newName": "GO",
            "position": {"line": place[0], "character": place[1]}})
        self.assertIn("not valid YAML", answer["error"]["message"])


    def test_names_where_the_catalog_has_errors(self):
        client = self.start()
        client.open(self.robot, ROBOT.replace("task: LOCALIZE}]", "task: LOCALISE}]"))
        client.settle()
        line, column = self.place_of(MISSION, "start: DRIVE", "DRIVE")
        found = client.at("references", self.mission, line, column, context={"includeDeclaration": False})
        self.assertEqual({item["uri"] for item in found}, {*map(uri_of, (self.robot, self.mission, self.properties))})
        answer = client.try_ask("textDocument/rename", {
            "textDocument": {"uri": uri_of(self.mission)}, "newName": "GO",
            "position": {"line": line, "character": column}})
        self.assertIn("the catalog has errors", answer["error"]["message"])


class HalfWritten(LspTest):
    def labels(self, client, path, text, version):
        """What is offered at the end of the text."""
        client.change(path, version, {"text": text})
        line = text.count("\n")
        found = client.at("completion", path, line, len(text) - text.rfind("\n") - 1)
        return {item["label"]: item for item in found["items"]}

    def test_completion_and_hover(self):
        client = self.start()
        client.open(self.mission)
        offered = self.labels(client, self.mission, MISSION + "- start: DR", 2)
        self.assertEqual(offered["DRIVE"]["textEdit"], {"range": span(6, 9, 6, 11), "newText": "DRIVE"})
        self.assertNotIn("LIDAR", offered)
        self.assertIn("dusty", self.labels(client, self.mission, MISSION + "- situation: {AIR: ", 3))
        self.assertIn("LIDAR", self.labels(client, self.mission, MISSION + "- fault: ", 4))
        offered = self.labels(client, self.mission, MISSION + "- start: DRIVE\n  ", 5)
        self.assertIn("priority", offered)
        self.assertNotIn("start", offered)
        said = client.at("hover", self.mission, 2, 10)
        self.assertIn("DRIVE_FAST", said["contents"]["value"])
        self.assertEqual(said["range"], span(2, 9, 2, 14))
        # The same while the catalog itself does not parse.
        client.open(self.robot, ROBOT + "- {task: [", 1)
        self.assertIn("DRIVE_FAST", client.at("hover", self.mission, 2, 10)["contents"]["value"])
        self.assertIn("DRIVE", self.labels(client, self.robot, ROBOT.replace("tasks:", "- {behavior: X, task: "), 2)
                      | self.labels(client, self.robot, ROBOT[:ROBOT.index("tasks:")] + "- {behavior: X, task: ", 3))

    def test_names(self):
        """In a text that does not parse they are where that text has them."""
        client = self.start()
        client.open(self.robot)
        client.open(self.mission)
        before = {method: client.of(method, self.robot) for method in ("documentSymbol",)}
        task = Names.place_of(self, ROBOT, "- {task: DRIVE", "DRIVE")
        asked = {"includeDeclaration": True}
        lines = lambda found: [(item["range"]["start"]["line"], item["range"]["start"]["character"]) for item in found]
        highlights = lines(client.at("documentHighlight", self.robot, *task))
        references = client.at("references", self.robot, *task, context=asked)
        moved = "# \U0001F422\n" + ROBOT
        for version, (text, shift) in enumerate(((ROBOT + "- {task: X, ", 0), (moved + "- {task: X, ", 1),
                                                 (moved.replace("task: DRIVE, suit", "task: DIVE, suit") + "'", 1)), 2):
            client.change(self.robot, version, {"text": text})
            place = (task[0] + shift, task[1])
            kept = [(line + shift, column) for line, column in highlights
                    if text.splitlines()[line + shift][column:].startswith("DRIVE")]
            self.assertEqual(len(kept), 3 - text.count("DIVE"))
            self.assertEqual(lines(client.at("documentHighlight", self.robot, *place)), kept)
            for path, at in ((self.robot, place), (self.mission, Names.place_of(self, MISSION, "start: DRIVE", "DRIVE"))):
                found = client.at("definition", path, *at)
                self.assertEqual((found["uri"], lines([found])), (uri_of(self.robot), [place]))
                found = client.at("references", path, *at, context=asked)
                self.assertEqual(lines(item for item in found if item["uri"] == uri_of(self.robot)), kept)
                self.assertEqual([item for item in found if item["uri"] != uri_of(self.robot)],
                                 [item for item in references if item["uri"] != uri_of(self.robot)])
                answer = client.try_ask("textDocument/rename", {
                    "textDocument": {"uri": uri_of(path)}, "newName": "GO",
                    "position": {"line": at[0], "character": at[1]}})
                self.assertRegex(answer["error"]["message"], "not valid YAML|the catalog has errors")
            value = client.at("definition", self.mission, *Names.place_of(self, MISSION, "AIR: dusty", "dusty"))
            self.assertEqual(lines([value]), [(1 + shift, ROBOT.splitlines()[1].index("dusty"))])
            symbols = client.of("documentSymbol", self.robot)
            self.assertEqual([symbol["name"] for symbol in symbols], ["situation", "behaviors", "tasks"])
            names = [[child["name"] for child in symbol["children"]] for symbol in symbols]
            self.assertEqual(names[:2], [["AIR"], ["DRIVE_FAST", "DRIVE_SLOWLY", "LIDAR"]])
            self.assertEqual(names[2][:2], ["DRIVE", "LOCALIZE"])
            self.assertEqual(lines(symbols[1]["children"]),
                             [(line + shift, column) for line, column in lines(before["documentSymbol"][1]["children"])])
        # A half-written mission.
        text = MISSION + "- start: DRIVE\n  parameters: {"
        client.change(self.mission, 2, {"text": text})
        self.assertEqual(lines(client.at("documentHighlight", self.mission, 6, 9)), [(2, 9), (5, 21), (6, 9)])
        self.assertEqual(client.of("documentSymbol", self.mission)[1]["children"][-1]["name"], "start: DRIVE")

    def test_names_in_what_nobody_writes(self):
        client = self.start()
        client.open(self.robot)
        long, many = "K" * 1000000, ", ".join(["a"] * 200000)
        for version, text in enumerate((f"tasks:\n- {long}: [{many}\n", "tasks: " + "[" * 150 + many,
                                        f"tasks: [{{x: [{many}]}}, "), 2):
            client.change(self.robot, version, {"text": text})
            symbols = client.of("documentSymbol", self.robot)
            self.assertEqual(symbols[0]["name"], "tasks")
            for method in ("definition", "documentHighlight"):
                self.assertFalse(client.at(method, self.robot, 0, len(text) // 2))

    def test_hover_explains_the_rule(self):
        client = self.start()
        client.open(self.robot, ROBOT.replace("task: LOCALIZE}]", "task: LOCALISE}]"))
        client.settle()
        line, column = Names.place_of(self, ROBOT, "requires: [{task: LOCALIZE", "LOCALIZE")
        self.assertIn("undefined-task", client.at("hover", self.robot, line, column + 1)["contents"]["value"])

    def test_prefixes(self):
        """As if somebody wrote them, beside their catalogs: each prefix has findings, and answers at its end and at
        some place before. In a night all of them."""
        step = 1 if os.environ.get("CBC_NIGHT") else 307
        draw = random.Random(7)
        folder = self.folder / "corpus"
        for source in sorted((SOURCE / "catalogs").glob("*.yaml")) + sorted((SOURCE / "catalogs" / "missions").glob("*.yaml")):
            text = source.read_text()
            path = folder / source.relative_to(SOURCE / "catalogs")
            path.parent.mkdir(parents=True)
            named = re.match("catalog: (.*)", text)
            if named:
                shutil.copy(source.parent / named[1], path.parent / named[1])
            path.write_text("")
            with Client(folder) as client:
                client.open(path, "")
                for version, end in enumerate(range(0, len(text), step), 2):
                    self.labels(client, path, text[:end], version)
                    self.ask_all(client, path, text[:end], draw.randrange(end + 1))
                path.write_text(text)
                client.change(path, 10**6, {"text": text})
                if named:
                    self.ask_all(client, path, text, text.index(named[1]))
                    self.assertTrue(client.of("inlayHint", path, range=span(0, 0, 9999, 0)) or "properties:" in text)
                self.check_equal(client, folder)
            shutil.rmtree(folder)

    def ask_all(self, client, path, text, offset):
        line, column = text.count("\n", 0, offset), units(text[text.rfind("\n", 0, offset) + 1:offset])
        lines = text.split("\n")
        client.at("definition", path, line, column)
        client.of("documentSymbol", path)
        client.of("inlayHint", path, range=span(0, 0, 9999, 0))
        references = client.at("references", path, line, column, context={"includeDeclaration": True})
        found = client.at("documentHighlight", path, line, column)
        found += [item for item in references if item["uri"] == uri_of(path)]
        words = {lines[at["start"]["line"]][at["start"]["character"]:at["end"]["character"]].strip("\"'")
                 for at in (item["range"] for item in found)}
        self.assertLessEqual(len(words), 1)


class WholeFiles(LspTest):
    def test_symbols(self):
        client = self.start()
        found = {symbol["name"]: [child["name"] for child in symbol["children"]]
                 for symbol in client.of("documentSymbol", self.robot)}
        self.assertEqual(found, {"situation": ["AIR"], "behaviors": ["DRIVE_FAST", "DRIVE_SLOWLY", "LIDAR"],
                                 "tasks": ["DRIVE", "LOCALIZE"]})
        events = client.of("documentSymbol", self.mission)[1]["children"]
        self.assertEqual(events[0]["name"], "start: DRIVE")

    def test_folds(self):
        client = self.start()
        folds = [(fold["startLine"], fold["endLine"]) for fold in client.of("foldingRange", self.robot)]
        self.assertEqual(sorted(folds), [(0, 1), (2, 5), (6, 8)])

    def test_hints(self):
        client = self.start()
        hints = client.of("inlayHint", self.mission, range=span(0, 0, 99, 0))
        labels = [(hint["position"]["line"], hint["label"]) for hint in hints]
        self.assertEqual([line for line, _ in labels], [2, 3, 4, 5])
        self.assertEqual(labels[0][1], "+LIDAR +DRIVE_FAST")
        self.assertEqual(labels[1][1], "✓")
        self.assertTrue(labels[3][1].startswith("✗"))
        self.assertNotIn("tooltip", hints[1])
        # Why it fails, as the command says it.
        said = html.unescape(run_cbc("solve", "--format", "junit", self.mission)[1])
        self.assertGreater(hints[3]["tooltip"].count("\n"), 1)
        self.assertIn(hints[3]["tooltip"], said)
        self.assertIn("AIR is dusty", hints[3]["tooltip"])

    def test_hints_of_what_is_rejected(self):
        client = self.start()
        client.open(self.mission, MISSION.replace("start: DRIVE", "fault: LIDAR\n- start: LOCALIZE"))
        hint = client.of("inlayHint", self.mission, range=span(3, 0, 4, 0))[0]
        self.assertTrue(hint["label"].startswith("rejected"), hint["label"])
        self.assertIn("LIDAR is faulty", hint["tooltip"])

    def test_hints_are_short(self):
        client = self.start()
        name = "D" * 5000
        robot = ROBOT.replace("- {task: DRIVE}", "- {task: DRIVE, timeout: 30}").replace("DRIVE_FAST", name)
        client.open(self.robot, robot + "exclusivity_constraints: []\n")
        events = "".join(f"- {{at: {at}, start: DRIVE}}\n" for at in range(100, 100000, 100))
        client.open(self.mission, "catalog: robot.yaml\nevents:\n- start: DRIVE\n"
                    f"- expect: {{active: []}}\n{events}- expect: {{active: []}}\n")
        hints = client.of("inlayHint", self.mission, range=span(0, 0, 9999, 0))
        self.assertGreater(len(hints), 100)
        for hint in hints:
            self.assertLess(len(hint["label"]), 500)
            self.assertLessEqual(len(hint.get("tooltip", "").splitlines()), 21)
        # One event after which many others happen by themselves.
        catalog = (SOURCE / "src" / "page" / "play" / "first.yaml").read_text()
        client.open(self.robot, catalog, 2)
        client.open(self.mission, "catalog: robot.yaml\nevents:\n- start: DRIVE\n- {at: 999999999, start: CHARGE}\n", 2)
        hints = client.of("inlayHint", self.mission, range=span(0, 0, 99, 0))
        self.assertTrue(any(re.search("; and [0-9]+ more$", hint["label"]) for hint in hints))
        self.assertLess(max(len(hint["label"]) for hint in hints), 500)

    def test_lenses(self):
        client = self.start()
        lenses = client.of("codeLens", self.mission)
        titles = [lens["command"]["title"] for lens in lenses]
        self.assertEqual(titles, ["run: cbc solve mission.yaml", "why: cbc solve mission.yaml --why DRIVE_FAST",
                                  "why: cbc solve mission.yaml --why DRIVE"])
        for lens, part in ((lenses[0], "expectations: 1 passed, 1 failed"),
                           (client.of("codeLens", self.properties)[0], "properties: 1 proved, 0 violated, 0 undecided")):
            client.ask("workspace/executeCommand", {"command": lens["command"]["command"],
                                                    "arguments": lens["command"]["arguments"]})
            while client.receive().get("method") != "window/showMessage":
                pass
            log, message = client.requests[-2:]
            words = lens["command"]["arguments"][0]
            output = run_cbc(*words)[1]
            self.assertEqual(log["params"]["message"].split("\n", 1)[1], output)
            self.assertEqual(message["params"]["message"], part)
        words = lenses[0]["command"]["arguments"][0]
        for wrong in ({"command": "cbc.run", "arguments": [words + ["--html", "page.html"]]}, {"command": "rm", "arguments": [["solve"]]}, {"command": "cbc.run", "arguments": [["graph"]]}):
            self.assertIn("error", client.try_ask("workspace/executeCommand", wrong))

    def test_lenses_of_odd_names(self):
        client = self.start()
        client.open("untitled:Untitled-1", MISSION)
        self.assertEqual(client.of("codeLens", "untitled:Untitled-1"), [])
        mission = self.write("-m.yaml", MISSION.split("\n", 1)[1])
        client.open(mission)
        lens = client.of("codeLens", mission)[0]["command"]
        self.assertEqual(lens["title"], "run: cbc solve robot.yaml ./-m.yaml")
        self.assertIn("expectations: 1 passed, 1 failed", run_cbc(*lens["title"].split()[2:], cwd=self.folder)[1])

    def test_what_runs_ends_with_the_server(self):
        long = self.write("long.properties.yaml", f"catalog: {SOURCE}/catalogs/hospital.yaml\n"
                          "assume: {faults: 2}\nproperties:\n- {name: long, can_start: DELIVER}\n")
        client = self.start()
        lens = client.of("codeLens", long)[0]["command"]
        children = pathlib.Path(f"/proc/{client.process.pid}/task")
        running = lambda: [int(child) for thread in children.iterdir()
                           for child in (thread / "children").read_text().split()]
        for _ in range(2):  # the second one takes the place of the first
            client.ask("workspace/executeCommand", {"command": lens["command"], "arguments": lens["arguments"]})
        while len(running()) != 1:
            client.ask("cbc/isIdle", {})
        (child,) = running()
        client.ask("shutdown", None)
        client.tell("exit", None)
        self.assertEqual(client.process.wait(PATIENCE), 0)
        self.assertFalse(os.path.exists(f"/proc/{child}"))
        self.assertFalse([request for request in client.requests if request["method"].startswith("window/")])

    def test_lenses_are_confined(self):
        elsewhere = pathlib.Path(tempfile.mkdtemp()).resolve()
        self.addCleanup(shutil.rmtree, elsewhere)
        (elsewhere / "robot.yaml").write_text(ROBOT)
        mission = self.write("other.yaml", MISSION.replace("robot.yaml", str(elsewhere / "robot.yaml")))
        client = self.start(options=["--confine", str(self.folder)])
        lens = client.of("codeLens", mission)[0]["command"]
        client.ask("workspace/executeCommand", {"command": lens["command"], "arguments": lens["arguments"]})
        while client.receive().get("method") != "window/showMessage":
            pass
        self.assertNotIn("DRIVE", client.requests[-2]["params"]["message"])

    def test_fixes(self):
        client = self.start()
        text = ROBOT.replace("requires: [{task: LOCALIZE}]", "requires: [{task: LOCALISE}]")
        client.open(self.robot, text)
        client.settle()
        (found,) = client.findings[str(self.robot)]
        fixes = client.of("codeAction", self.robot, range=found["range"], context={"diagnostics": [found]})
        titles = [fix["title"] for fix in fixes]
        self.assertIn("Change to 'LOCALIZE'", titles)
        fix = fixes[titles.index("Change to 'LOCALIZE'")]["edit"]["changes"][uri_of(self.robot)]
        self.assertEqual(Names.apply(self, text, fix), ROBOT)
        for only, is_meant in ((["quickfix"], True), (["refactor", "source.organizeImports"], False)):
            asked = {"diagnostics": [found], "only": only}
            self.assertEqual(bool(client.of("codeAction", self.robot, range=found["range"], context=asked)), is_meant)

    def test_older_format(self):
        old = (SOURCE / "tests" / "golden" / "shared" / "graph_older_format" / "catalog.yaml").read_text()
        client = self.start()
        client.open(self.robot, old)
        client.settle()
        found = client.findings[str(self.robot)][0]
        fixes = client.of("codeAction", self.robot, range=found["range"], context={"diagnostics": [found]})
        fix = next(fix["edit"] for fix in fixes if fix["title"] == "Convert to the present format")
        converted = Names.apply(self, old, fix["changes"][uri_of(self.robot)])
        by_command = self.write("old.yaml", old)
        run_cbc("lint", "--fix", by_command)
        self.assertEqual(converted, by_command.read_text())

    def test_allowing_in_settings(self):
        client = self.start()
        text = ROBOT.replace("- {task: LOCALIZE", "- {task: EXTRA}\n- {task: LOCALIZE")
        client.open(self.robot, text)
        for version, before in enumerate((None, "", "strict: false", "allow: [never-started]\n",
                                          "allow:\n  # why\n  - never-started\n"), 1):
            if before is not None:
                client.open(self.write(".cbc.yaml", before), before, version)
            client.settle()
            found = client.findings[str(self.robot)][0]
            fixes = client.of("codeAction", self.robot, range=found["range"], context={"diagnostics": []})
            fix = next(fix["edit"] for fix in fixes if fix["title"] == f"Allow {found['code']} in .cbc.yaml")
            if before is None:
                create, edit = fix["documentChanges"]
                self.assertEqual((create["kind"], create["uri"]), ("create", uri_of(self.folder / ".cbc.yaml")))
                after = Names.apply(self, "", edit["edits"])
            else:
                after = Names.apply(self, before, fix["changes"][uri_of(self.folder / ".cbc.yaml")])
            self.write(".cbc.yaml", after)
            self.assertNotIn(found["code"], run_cbc("lint", self.write("robot.yaml", text))[1], after)
            (self.folder / ".cbc.yaml").unlink()

    def test_allowing(self):
        client = self.start()
        text = ROBOT.replace("- {task: LOCALIZE", "- {task: EXTRA}\n- {task: LOCALIZE")
        for version in (1, 2, 3, 4):
            client.open(self.robot, text, version)
            client.settle()
            found = client.findings[str(self.robot)]
            if not found:
                break
            fixes = client.of("codeAction", self.robot, range=found[0]["range"], context={"diagnostics": []})
            fix = next(fix for fix in fixes if fix["title"].startswith("Allow"))
            text = Names.apply(self, text, fix["edit"]["changes"][uri_of(self.robot)])
        self.assertEqual(found, [])
        self.assertIn("# cbc: allow ", text)


if __name__ == "__main__":
    unittest.main()
