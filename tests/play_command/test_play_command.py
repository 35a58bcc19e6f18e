"""`cbc play`, spoken to as its page does, and as others might: what is saved, and what is refused.

CBC_PROGRAM: the program."""

import concurrent.futures
import html.parser
import http.client
import json
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import unittest

PROGRAM = os.environ["CBC_PROGRAM"]
# What the program looks for in the page of ./dev play, which this test does without.
PAGE = """<!DOCTYPE html><meta http-equiv="Content-Security-Policy" content="connect-src 'none'; base-uri 'none'">
<script type="application/json" id="saved-session">null</script><p>null, connect-src 'none'</p>
"""
CATALOG = "behaviors:\n- {behavior: FLY, task: MOVE, suitability: 50}\n"
MISSION = "catalog: robot.yaml\nevents:\n- start: MOVE  # </script><!-- é\n"
PROPERTIES = "properties:\n- {name: moves, can_start: MOVE}\n"
PATIENCE = 60  # seconds of a busy machine


class SessionOf(html.parser.HTMLParser):
    """What a browser finds in the script element of a page."""

    def __init__(self, page):
        super().__init__()
        self.session = ""
        self.is_inside = False
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.is_inside = tag == "script" and dict(attrs).get("id") == "saved-session"

    def handle_endtag(self, tag):
        self.is_inside = False

    def handle_data(self, data):
        if self.is_inside:
            self.session += data


class PlayCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "bin").mkdir()
        self.program = self.folder / "bin/cbc"
        try:
            os.link(PROGRAM, self.program)
        except OSError:  # on another disk
            shutil.copy(PROGRAM, self.program)
        self.page = self.folder / "share/cbc/play/cbc-play.html"
        self.page.parent.mkdir(parents=True)
        self.page.write_text(PAGE)
        self.catalog = self.write("robot.yaml", CATALOG)

    def write(self, name, text):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    def start(self, *arguments):
        self.process = subprocess.Popen([self.program, "play", *arguments, "--address", "127.0.0.1:0"], cwd=self.folder,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        self.addCleanup(self.end)
        line = self.process.stderr.readline()
        self.assertRegex(line, r"^cbc: simulator: http://127\.0\.0\.1:\d+/[0-9a-f]{32}/ \(Ctrl-C ends it\)\n$")
        self.port = int(re.search(r":(\d+)/", line)[1])
        self.path = re.search(r":\d+(/\w+/)", line)[1]

    def end(self, number=signal.SIGINT):
        """The exit status, and what else was printed."""
        if self.process.poll() is None:
            self.process.send_signal(number)
        output, errors = self.process.communicate(timeout=PATIENCE)
        return self.process.returncode, output + errors

    def ask(self, method, path, body=None, **headers):
        """Status and text of an answer. Underscores in names of headers are dashes; None leaves one out."""
        fields = {"Host": f"127.0.0.1:{self.port}"}
        if method == "PUT":
            fields["Origin"] = f"http://{headers.get('Host', fields['Host'])}"
        fields |= headers
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        connection.putrequest(method, path, skip_host=True)
        for name, value in fields.items():
            if value is not None:
                connection.putheader(name.replace("_", "-"), value)
        data = (body or "").encode() if not isinstance(body, bytes) else body
        if body is not None and "Content_Length" not in headers and "Transfer_Encoding" not in headers:
            connection.putheader("Content-Length", len(data))
        connection.endheaders()
        try:
            if data:
                connection.send(data)
        except OSError:
            pass  # it has been refused already
        answer = connection.getresponse()
        text = answer.read().decode()
        connection.close()
        return answer.status, text

    def session(self):
        status, page = self.ask("GET", self.path)
        self.assertEqual(status, 200)
        return json.loads(SessionOf(page).session)

    def save(self, text, version, role="catalog", **headers):
        status, answer = self.ask("PUT", f"{self.path}{role}?version={version}", text, **headers)
        return status, json.loads(answer) if answer.startswith("{") else answer


class Page(PlayCase):
    def test_has_the_files(self):
        self.write("m.yaml", MISSION)
        self.write("p.yaml", PROPERTIES)
        self.start("p.yaml", "m.yaml", "./robot.yaml")
        self.assertEqual(self.session(), {
            "name": "robot.yaml", "catalog": CATALOG, "mission": MISSION, "properties": PROPERTIES,
            "files": {"catalog": {"name": "./robot.yaml", "version": 1}, "mission": {"name": "m.yaml", "version": 1},
                      "properties": {"name": "p.yaml", "version": 1}}})
        _, page = self.ask("GET", self.path)
        self.assertIn("content=\"connect-src 'self'; base-uri 'none'\"", page)
        self.assertTrue(page.endswith("</script><p>null, connect-src 'none'</p>\n"))

    def test_has_a_catalog_with_errors(self):
        self.write("robot.yaml", "behaviors: [\n")
        self.start("robot.yaml")
        self.assertEqual(self.session()["catalog"], "behaviors: [\n")

    def test_has_what_is_in_the_files_when_it_is_opened(self):
        self.start("robot.yaml")
        self.catalog.write_text(CATALOG + "# by another program\n")
        self.assertEqual(self.session()["catalog"], CATALOG + "# by another program\n")
        self.assertEqual(self.session()["files"]["catalog"]["version"], 2)

    def test_is_at_an_address_that_nobody_can_guess(self):
        self.start("robot.yaml")
        for path in ("/", "/catalog", "/" + "0" * 32 + "/", self.path[:-2], self.path + "robot.yaml", self.path + "events?run=",
                     self.path + "../" * 20 + "etc/passwd"):
            status, text = self.ask("GET", path)
            self.assertEqual(status, 404, path)
            self.assertNotIn(self.path.strip("/"), text)
            self.assertNotIn("FLY", text)
        first = self.path
        self.end()
        self.start("robot.yaml")
        self.assertNotEqual(self.path, first)

    def test_ends_by_signals(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.start("robot.yaml")
            silent = socket.create_connection(("127.0.0.1", self.port))  # nobody waits for it
            self.assertEqual(self.end(number), (0, ""))
            silent.close()


class Saving(PlayCase):
    def test_writes_the_file(self):
        mission = self.write("m.yaml", MISSION)
        os.chmod(self.catalog, 0o640)
        self.start("robot.yaml", "m.yaml")
        changed = CATALOG.replace("50", "60") + "# é\r\n"
        self.assertEqual(self.save(changed, 1), (200, {"version": 2}))
        self.assertEqual(self.catalog.read_bytes(), changed.encode())
        self.assertEqual(self.catalog.stat().st_mode & 0o777, 0o640)
        self.assertEqual(self.session()["catalog"], changed)
        self.assertEqual(self.save("", 2), (200, {"version": 3}))
        self.assertEqual(self.catalog.read_bytes(), b"")
        self.assertEqual(mission.read_text(), MISSION)
        self.assertEqual(self.save("events: []\n", 1, "mission"), (200, {"version": 2}))
        self.assertEqual(mission.read_text(), "events: []\n")
        self.assertEqual(sorted(path.name for path in self.folder.iterdir()), ["bin", "m.yaml", "robot.yaml", "share"])

    def test_a_text_as_long_as_may_be(self):
        self.start("robot.yaml")
        most = 20 << 20
        self.assertEqual(self.save("#" * most, 1), (200, {"version": 2}))
        self.assertEqual(self.catalog.stat().st_size, most)
        status, answer = self.save("#" * (most + 1), 2)
        self.assertEqual((status, answer), (413, "The text is larger than 20 MiB.\n"))
        chunk = b"%x\r\n%s\r\n" % (most + 1, b"x" * (most + 1)) + b"0\r\n\r\n"
        self.assertEqual(self.save(chunk, 2, Transfer_Encoding="chunked")[0], 413)
        self.assertEqual(self.catalog.stat().st_size, most)

    def test_another_text_in_the_file_is_a_conflict(self):
        self.start("robot.yaml")
        other = CATALOG + "# by another program\n"
        self.catalog.write_text(other)
        conflict = (409, {"version": 2, "text": other})
        self.assertEqual(self.save("mine", 1), conflict)
        self.assertEqual(self.save("mine", 1), conflict)
        self.assertEqual(self.catalog.read_text(), other)
        self.assertEqual(self.save("mine", 2), (200, {"version": 3}))
        self.assertEqual(self.catalog.read_text(), "mine")

    def test_two_pages_do_not_overwrite_each_other(self):
        self.start("robot.yaml")
        with concurrent.futures.ThreadPoolExecutor(8) as pool:
            answers = list(pool.map(lambda number: self.save(f"# {number}\n", 1), range(8)))
        saved = [number for number, (status, _) in enumerate(answers) if status == 200]
        self.assertEqual(len(saved), 1)
        self.assertEqual(self.catalog.read_text(), f"# {saved[0]}\n")
        self.assertEqual([answer for status, answer in answers if status != 200],
                         [{"version": 2, "text": f"# {saved[0]}\n"}] * 7)

    def test_a_file_that_is_gone_is_a_conflict(self):
        self.start("robot.yaml")
        self.catalog.unlink()
        self.assertEqual(self.save("mine", 1), (409, {"version": 2, "text": None}))
        self.assertFalse(self.catalog.exists())
        self.assertEqual(self.session()["catalog"], CATALOG)  # nothing is lost
        self.assertEqual(self.save("mine", 2), (200, {"version": 3}))
        self.assertEqual(self.catalog.read_text(), "mine")

    def test_a_pipe_in_the_place_of_the_file(self):
        self.start("robot.yaml")
        self.catalog.unlink()
        os.mkfifo(self.catalog)
        self.assertEqual(self.save("mine", 1), (409, {"version": 2, "text": None}))  # and nobody waits for it

    def test_an_error_of_writing_is_told(self):
        folder = self.folder / "full"
        folder.mkdir()
        self.write("full/robot.yaml", CATALOG)
        self.start("full/robot.yaml")
        shutil.move(folder, self.folder / "elsewhere")
        self.assertEqual(self.save("mine", 1), (409, {"version": 2, "text": None}))
        status, answer = self.save("mine", 2)
        self.assertEqual((status, list(answer)), (500, ["error"]))
        self.assertIn("No such file or directory", answer["error"])


class Refusals(PlayCase):
    def setUp(self):
        super().setUp()
        self.start("robot.yaml")

    def tearDown(self):
        self.assertEqual(self.catalog.read_text(), CATALOG)
        self.assertEqual(self.save("saved", 1), (200, {"version": 2}))  # the right page still can

    def test_names_of_others(self):
        """The name of a page from elsewhere may be made to mean 127.0.0.1."""
        for host in ("evil.example", f"evil.example:{self.port}", "127.0.0.1.evil.example", ""):
            self.assertEqual(self.ask("GET", self.path, Host=host)[0], 403, host)
            self.assertEqual(self.save("x", 1, Host=host)[0], 403, host)
        self.assertEqual(self.save("x", 1, Host=None)[0], 400)

    def test_pages_of_others(self):
        own = f"127.0.0.1:{self.port}"
        for origin in (None, "", "null", "https://evil.example", f"https://{own}", own, f"http://{own}/",
                       f"http://127.0.0.1:{self.port + 1}", f"http://localhost:{self.port}", f"http://{own}.evil.example"):
            self.assertEqual(self.save("x", 1, Origin=origin)[0], 403, origin)

    def test_a_forwarded_port(self):
        self.assertEqual(self.ask("PUT", self.path + "catalog?version=9", "x", Host="localhost:9999",
                                  Origin="http://localhost:9999")[0], 409)

    def test_other_places(self):
        for path in ("/catalog?version=1", "/" + "0" * 32 + "/catalog?version=1", self.path, self.path + "?version=1",
                     self.path + "mission?version=1", self.path + "robot.yaml?version=1",
                     self.path + "../robot.yaml?version=1", self.path + "catalog/?version=1"):
            self.assertEqual(self.ask("PUT", path, "x")[0], 404, path)

    def test_versions_that_are_none(self):
        for query in ("", "?", "?version=", "?version=x", "?version=-1", "?version=01x", "?version=2", "?version=0",
                      "?version=99999999999999999999999", "?VERSION=1"):
            self.assertEqual(self.ask("PUT", f"{self.path}catalog{query}", "x")[0], 409, query)

    def test_texts_that_are_none(self):
        status, answer = self.save(b"\xff", 1)
        self.assertEqual((status, answer), (422, {"error": "expected UTF-8, found another encoding at byte 1"}))

    def test_other_methods(self):
        for method in ("POST", "DELETE", "HEAD", "OPTIONS", "PATCH"):
            self.assertEqual(self.ask(method, self.path + "catalog?version=1", "x")[0], 405, method)

    def test_a_text_that_ends_early(self):
        client = socket.create_connection(("127.0.0.1", self.port))
        client.sendall(f"PUT {self.path}catalog?version=1 HTTP/1.1\r\nHost: localhost\r\nOrigin: http://localhost\r\n"
                       "Content-Length: 9\r\n\r\nhalf".encode())
        client.close()


class Files(PlayCase):
    def refuse(self, message, *arguments):
        done = subprocess.run([self.program, "play", *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=PATIENCE, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, f"cbc: {message}\n"))

    def test_that_are_too_large(self):
        self.catalog.write_text(CATALOG + "#" * (20 << 20))
        self.refuse("cannot read 'robot.yaml': it has more than 20 MiB, which is too much for a page", "robot.yaml")

    def test_that_are_compiled(self):
        subprocess.run([self.program, "compile", "robot.yaml"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        self.refuse("'robot.cbc' is a compiled catalog, which has no text; expected one in YAML", "robot.cbc")

    def test_without_the_page(self):
        self.page.unlink()
        self.refuse("the page of the simulator, cbc-play.html, is not there: expected it in ../share/cbc/play or ../play "
                    "from the folder of this program; './dev play' makes it in the sources of cbc", "robot.yaml")

    def test_with_the_page_of_a_build(self):
        place = self.folder / "play/cbc-play.html"
        place.parent.mkdir()
        self.page.rename(place)
        self.start("robot.yaml")
        self.assertEqual(self.session()["catalog"], CATALOG)

    def test_with_another_page(self):
        self.page.write_text("<!DOCTYPE html>")
        self.refuse(f"'{self.page}' is no page of this version of the simulator; './dev play' makes it anew", "robot.yaml")

    def test_at_an_address_that_is_taken(self):
        self.start("robot.yaml")
        address = f"127.0.0.1:{self.port}"
        self.refuse(f"cannot serve a page at '{address}': Address already in use; '--address 127.0.0.1:0' takes a free port",
                    "robot.yaml", "--address", address)


if __name__ == "__main__":
    unittest.main()
