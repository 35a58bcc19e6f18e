"""The page of `cbc solve --html` in a headless Chromium: pages of missions, and what one can ask them."""

import json
import os
import pathlib
import random
import re
import subprocess
import unittest
import xml.etree.ElementTree

from chromium import Chromium

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("CBC_PROGRAM", str(ROOT / "build/release/cbc"))
OUT = ROOT / "build/browser"
QUADROTOR = "catalogs/quadrotor.yaml"
AXE = ROOT / "build/browser-npm/node_modules/axe-core/axe.min.js"  # where ./dev test-browser puts it

HOSTILE_TASK = "</script><script>alert(1)</script>"
HOSTILE_BEHAVIORS = ["<img src=x onerror=alert(2)>", "__proto__", "\"quotes' & <!-- <b>bold</b>",
                     "line\u2028and\u2029paragraph", "constructor"]


def solve(name, *arguments):
    """Makes a page, and returns where it is and the same report as JSON."""
    page = OUT / (name + ".html")
    result = subprocess.run([PROGRAM, "solve", *arguments, "--format", "json", "--html", str(page)],
                            cwd=ROOT, stdout=subprocess.PIPE, check=False)
    assert result.returncode in (0, 1), result.returncode
    return page.as_uri(), json.loads(result.stdout)


def write(name, data):
    path = OUT / name
    path.write_text(json.dumps(data))  # JSON is YAML, too
    return str(path)


def hostile_files():
    catalog = {
        "tasks": [{"task": HOSTILE_TASK}, {"task": "2"}, {"task": "1"}],
        "behaviors": [{"behavior": name, "task": HOSTILE_TASK} for name in HOSTILE_BEHAVIORS] +
                     [{"behavior": "toString", "task": "2"}, {"behavior": "valueOf", "task": "1"}],
        "exclusivity_constraints": [{"mutually_exclusive": ["1", "2"]}],
    }
    events = [{"start": HOSTILE_TASK, "parameters": {"</script>": ["<b>", "\u2028", "'\""]}}]
    for name in HOSTILE_BEHAVIORS[:-1]:
        events += [{"fault": name}, {"finish": name, "cause": "process_failure", "wait": 1}]
    events += [{"start": "2", "priority": 2}, {"start": "1"}, {"expect": {"stopped": ["2"]}}]
    return write("hostile.yaml", catalog), write("hostile.mission.yaml", {"events": events})


def long_script(count):
    """A mission of `count` scripted events, the same each time."""
    choose = random.Random(4)
    tasks = ["HOVER", "ROTATE", "FOLLOW_PATH", "TAKE_OFF", "LAND", "INFORM_POSITION_TO_ROBOTS"]
    behaviors = re.findall(r"^- behavior: (\w+)", (ROOT / QUADROTOR).read_text(), re.MULTILINE)
    events = []
    for _ in range(count):
        verb = choose.choice(["start", "start", "start", "stop", "finish", "finish", "situation"])
        if verb in ("start", "stop"):
            event = {verb: choose.choice(tasks)}
            if verb == "start":
                event["priority"] = choose.choice([1, 2, 2, 2])
        elif verb == "finish":
            event = {verb: choose.choice(behaviors),
                     "cause": choose.choice(["goal_achieved", "process_failure"])}
        else:
            event = {verb: {choose.choice(behaviors): choose.random() < 0.8}}
        events.append({**event, "wait": choose.choice([0, 0.5, 3])})
    return write("long.mission.yaml", {"events": events})


def shown(name):
    """Line separators cannot be seen, so names show their escapes."""
    return re.sub("[\u2028\u2029]", lambda found: f"\\u{ord(found[0]):04x}", name)


class PageCase(unittest.TestCase):
    """Opens the page of a short mission before each test; nothing on it may go wrong, or leave it."""

    @classmethod
    def setUpClass(cls):
        OUT.mkdir(parents=True, exist_ok=True)
        cls.browser = Chromium().__enter__()
        cls.addClassCleanup(cls.browser.close)
        cls.target = solve("target-following", "tests/browser/target-following.mission.yaml")
        cls.quadrotor = solve("quadrotor", QUADROTOR, "catalogs/quadrotor.mission.yaml")

    def setUp(self):
        self.browser.set_size(1600, 1250)
        self.browser.set_scheme("light")
        self.open(self.target)
        self.events = self.run_of(self.target)["events"]

    def tearDown(self):
        self.assertEqual(self.noises(), [])
        self.assertEqual(self.requests(), [self.url])

    # What the page does besides -------------------------------------------------------------------

    def noises(self):
        names = ("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded",
                 "Page.javascriptDialogOpening")
        return [event for event in self.browser.events if event["method"] in names]

    def requests(self):
        """All but those that lie in their own address (the empty icon)."""
        urls = [event["params"]["request"]["url"] for event in self.browser.events
                if event["method"] == "Network.requestWillBeSent"]
        return [url for url in urls if not url.startswith("data:")]

    # Helpers --------------------------------------------------------------------------------------

    def open(self, made):
        self.url = made[0]
        self.browser.load(self.url)

    @staticmethod
    def run_of(made, place=0):
        return made[1]["runs"][place]

    def text(self, selector):
        return self.browser.ask(f"document.querySelector({json.dumps(selector)}).textContent")

    def status(self):
        return self.text("#status")

    def place(self, selector):
        """The middle of an element that is in view."""
        box = self.browser.ask(
            f"(() => {{ const box = document.querySelector({json.dumps(selector)})"
            ".getBoundingClientRect(); return [box.x, box.y, box.width, box.height]; })()")
        return box[0] + box[2] / 2, box[1] + box[3] / 2

    def click(self, selector):
        self.browser.click(*self.place(selector))

    def mark(self, number):
        """Where the mark of an event is."""
        return self.browser.ask(
            "(() => { const box = page.timeline.canvas.getBoundingClientRect(), one = "
            f"page.timeline.targets.find(({{ mark }}) => mark?.numbers.includes({number}));"
            "return [box.x + one.x + one.width / 2, box.y + one.y + one.height / 2]; })()")

    def mark_text(self, number):
        return self.browser.ask("page.timeline.scene().marks"
                                f".find((mark) => mark.numbers.includes({number})).text")

    def row(self, *names):
        """The middle of a row: its y."""
        return self.browser.ask("page.timeline.canvas.getBoundingClientRect().y + page.timeline.head + 10"
                                f" + page.timeline.rows.find(...{json.dumps(names)}).y")

    def span(self, cause, place=0):
        """Where a span with a cause is: the first one."""
        return self.browser.ask(
            "(() => { const box = page.timeline.canvas.getBoundingClientRect(), one = "
            f"page.timeline.targets.filter(({{ span }}) => span?.cause === '{cause}')[{place}];"
            "return [box.x + one.x + one.width / 2, box.y + one.y + one.height / 2]; })()")

    def drawing(self):
        """All texts of the picture, drawn as SVG."""
        return self.browser.ask("[...page.timeline.toSvg().querySelectorAll('text')]"
                                ".map((text) => text.textContent)")

    def drawn(self, look):
        return self.browser.ask(f"page.timeline.toSvg().querySelectorAll('.{look}').length")

    def focus(self, selector):
        self.browser.ask(f"document.querySelector({json.dumps(selector)}).focus()")

    def number(self):
        return int(re.match(r"Event (\d+) of", self.status()).group(1))

    def shown_state(self):
        return self.browser.ask(
            "Object.fromEntries([...document.querySelectorAll('#state-body tbody tr')]"
            ".map((row) => [row.cells[0].textContent, row.cells[1].textContent]))")

    def assert_shows(self, number):
        """That everything agrees on which event is shown, and with the report."""
        event = self.events[number - 1]
        self.assertEqual(self.number(), number)
        self.assertEqual(self.browser.ask("document.querySelector('#slider').value"), str(number))
        self.assertIn(event["verb"], self.text("#detail-body .headline"))
        self.assertEqual(self.shown_state(), {shown(task): shown(one) for task, one in event["running"].items()})
        chosen = self.browser.ask("[...document.querySelectorAll('#events [aria-current]')]"
                                  ".map((row) => row.dataset.event)")
        self.assertEqual(chosen, [str(number)])

    def assert_saved_picture_is_xml(self):
        text = self.browser.ask("page.svgText()")
        picture = xml.etree.ElementTree.fromstring(text)
        self.assertEqual(picture.tag, "{http://www.w3.org/2000/svg}svg")
        names = {"".join(one.itertext()) for one in picture.iter("{http://www.w3.org/2000/svg}text")}
        self.assertIn(self.browser.ask("Rows.nameOf(page.timeline.rows.list[0])"), names)
        self.assertNotIn("var(", text)
        return text

    def choose_run(self, place):
        self.click(f"#missions tbody tr:nth-child({place + 1}) td:nth-child(3)")

    def assert_no_findings_of_axe(self, name):
        self.browser.ask(AXE.read_text() + ";0")
        findings = self.browser.ask("axe.run().then(({ violations }) => violations.map((one) => [one.id, one.help,"
                                    " one.nodes.map((node) => node.html + node.failureSummary)]))")
        with self.subTest(page=name):
            self.assertEqual(findings, [])
