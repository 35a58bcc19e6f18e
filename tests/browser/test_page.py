"""The page of `cbc solve --html` in a headless Chromium.

    ./dev test-browser

Screenshots go to build/browser; look at them after a change of the page. questions.md has what
somebody who has never seen the page should find out from one of them.
"""

import json
import os
import pathlib
import random
import re
import subprocess
import time
import unittest
import urllib.parse
import xml.etree.ElementTree

from chromium import BrowserError, Chromium

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("CBC_PROGRAM", str(ROOT / "build/release/cbc"))
OUT = ROOT / "build/browser"
AXE = ROOT / "build/browser-npm/node_modules/axe-core/axe.min.js"  # where ./dev test-browser puts it
QUADROTOR = "catalogs/quadrotor.yaml"

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


def changed(name, made, change):
    """A page with changed data."""
    page = OUT / (name + ".html")
    before, begin, rest = pathlib.Path(made[0].removeprefix("file://")).read_text().partition('id="data">')
    text, end, after = rest.partition("</script>")
    data = json.loads(text)
    change(data)
    page.write_text(before + begin + json.dumps(data).replace("<", "\\u003c") + end + after)
    return page.as_uri(), data["report"]


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


class Page(unittest.TestCase):
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
        self.assertEqual(self.shown_state(), event["running"])
        chosen = self.browser.ask("[...document.querySelectorAll('#events [aria-current]')]"
                                  ".map((row) => row.dataset.event)")
        self.assertEqual(chosen, [str(number)])

    # Tests ----------------------------------------------------------------------------------------

    def test_noises_and_requests_are_seen(self):
        self.browser.ask("console.error('one')")
        self.browser.ask("fetch('file:///two').catch(() => {}).then(() => true)")
        self.browser.ask("setTimeout(() => { throw new Error('three'); })")
        self.browser.settle()
        methods = {noise["method"] for noise in self.noises()}
        self.assertLessEqual({"Runtime.consoleAPICalled", "Runtime.exceptionThrown"}, methods)
        self.assertTrue(methods & {"Log.entryAdded"} or len(self.requests()) > 1)
        with self.assertRaises(BrowserError):
            self.browser.ask("nothing_of_this_name")
        self.open(self.target)

    def test_data_are_those_of_the_json_report(self):
        data = self.browser.ask("JSON.parse(document.querySelector('#data').textContent)")
        self.assertEqual(data["report"], self.target[1])

    def test_table_has_all_events(self):
        rows = self.browser.ask("page.table.fillAll(), [...document.querySelectorAll('#events > tbody > tr')]"
                                ".map((row) => [...row.cells].map((cell) => cell.textContent))")
        self.assertEqual(len(rows), len(self.events))
        for row, event in zip(rows, self.events):
            self.assertEqual(row[0], str(event["index"]))
            self.assertEqual(float(row[1]), event["time"])
            if event["verb"] in ("start", "stop", "finish"):
                self.assertTrue(row[3].endswith(event["outcome"]), row)
            for reason in event["conflict"]:
                self.assertIn(reason["message"], row[4])

    def test_keys_step_through_the_events(self):
        self.assert_shows(1)
        for key, number in [("ArrowRight", 2), ("ArrowRight", 3), ("ArrowLeft", 2), ("End", 9),
                            ("ArrowRight", 9), ("Home", 1), ("ArrowLeft", 1)]:
            self.browser.key(key)
            self.assert_shows(number)

    def test_every_state_is_that_of_the_report(self):
        self.open(self.quadrotor)
        self.events = self.run_of(self.quadrotor)["events"]
        for number in range(1, len(self.events) + 1):
            self.assert_shows(number)
            self.browser.key("ArrowRight")

    def test_slider(self):
        self.focus("#slider")
        self.browser.key("ArrowRight")
        self.assert_shows(2)
        self.browser.key("End")
        self.assert_shows(len(self.events))
        x, y = self.place("#slider")
        self.browser.drag(x + self.browser.ask("document.querySelector('#slider').offsetWidth") / 2
                          - 8, y, x, y)
        self.assert_shows(5)
        self.assertEqual(self.browser.ask(
            "document.querySelector('#slider').getAttribute('aria-valuetext')"), self.status())

    def test_buttons(self):
        for selector, number in [("#next", 2), ("#last", 9), ("#back", 8), ("#first", 1)]:
            self.click(selector)
            self.assert_shows(number)

    def test_keys_in_the_table(self):
        self.focus("#events tbody tr:nth-child(1) button")
        self.browser.key("ArrowDown")
        self.browser.key("ArrowDown")
        self.assert_shows(3)
        self.assertEqual(self.browser.ask("document.activeElement.textContent"), "3")
        self.browser.key("ArrowUp")
        self.assert_shows(2)

    def test_click_in_the_table(self):
        self.click("#events tbody tr:nth-child(2) td:nth-child(5)")
        self.assert_shows(2)

    def test_click_in_the_picture(self):
        self.browser.click(*self.mark(7))
        self.assert_shows(7)
        self.browser.click(*self.span("requested"))
        self.assert_shows(1)
        x, y = self.mark(8)
        self.browser.click(x + 3, self.row("LocalizeTarget"))  # no bar: the nearest event
        self.assert_shows(8)

    def test_hover_tells_about_events_and_spans(self):
        self.browser.move(*self.mark(7))
        self.assertTrue(self.browser.ask("!document.querySelector('#tip').hidden"))
        self.assertIn("stop ApproachTarget, priority 1", self.text("#tip"))
        self.assertIn(self.events[6]["conflict"][0]["message"], self.text("#tip"))
        self.browser.move(*self.span("requested"))
        tip = self.text("#tip")
        self.assertIn("MotionPlannerDistantTarget", tip)
        self.assertIn("finished: situation change", tip)
        self.assertIn("replaced by MotionPlannerCloseTarget", tip)
        self.browser.key("Escape")
        self.assertTrue(self.browser.ask("document.querySelector('#tip').hidden"))
        self.browser.move(*self.span("requested"))
        self.browser.move(*self.place("#title"))
        self.assertTrue(self.browser.ask("document.querySelector('#tip').hidden"))

    def test_details_tell_who_replaced_whom(self):
        self.browser.click(*self.mark(6))
        text = self.text("#detail-body")
        self.assertIn("MotionPlannerCloseTarget replaces MotionPlannerDistantTarget", text)
        self.assertIn("finish MotionPlannerDistantTarget: situation change (it no longer fits)", text)
        shown = self.browser.ask("[...document.querySelectorAll('.changes tbody tr')].map((row) => "
                                 "[0, 1, 2, 4, 5].map((cell) => row.cells[cell].textContent))")
        expected = [["." if change["priority"] is None else str(change["priority"]),
                     "+" if change["op"] == "activate" else "\u2212",
                     "Y" if change["success"] else "N", ", ".join(change["tasks"]),
                     change["cause"]] for change in self.events[5]["changes"]]
        self.assertEqual(shown, expected)

    def test_rejected_events_are_in_the_picture(self):
        for number in (2, 7):
            self.assertIn("\u00d7", self.mark_text(number))
            self.browser.click(*self.mark(number))
            for reason in self.events[number - 1]["conflict"]:
                self.assertIn(reason["message"], self.text("#detail-body"))
        self.assertIn("rejected: ApproachTarget has a request of priority 2, higher than 1",
                      self.drawing())
        lanes = self.browser.ask("page.timeline.scene().marks.map((mark) => [mark.look, mark.lane])")
        others = {lane for look, lane in lanes if look != "rejected"}
        self.assertTrue(others.isdisjoint(lane for look, lane in lanes if look == "rejected"))

    def zoom(self):
        return self.browser.ask("page.timeline.view.zoom")

    def test_zoom_and_scale(self):
        self.assertEqual(self.zoom(), 1)
        self.click("#zoom-in")
        self.assertGreater(self.zoom(), 1)
        self.click("#fit")
        self.assertEqual(self.zoom(), 1)
        self.focus("#plot")
        self.browser.key("+", "+")
        self.assertGreater(self.zoom(), 1)
        self.browser.key("0", "0")
        self.assertEqual(self.zoom(), 1)
        x = [self.mark(number)[0] for number in (3, 4)]
        self.assertAlmostEqual(x[0], x[1])
        self.browser.ask("(() => { const scale = document.querySelector('#scale');"
                         "scale.value = 'event'; scale.dispatchEvent(new Event('change')); })()")
        self.browser.settle()
        x = [self.mark(number)[0] for number in (3, 4)]
        self.assertGreater(x[1], x[0] + 20)
        self.browser.screenshot(OUT / "target-following-events.png")

    def test_wheel_zooms_at_the_pointer_and_dragging_pans(self):
        x, y = map(round, self.mark(8))
        self.browser.wheel(x, y, -600)
        self.assertGreater(self.zoom(), 2)
        self.assertAlmostEqual(self.mark(8)[0], x, delta=2)
        self.browser.drag(x, y, x - 200, y)
        self.assertAlmostEqual(self.mark(8)[0], x - 200, delta=3)
        self.assert_shows(1)  # a drag chooses nothing
        self.browser.wheel(x, y, 5000)
        self.assertEqual(self.zoom(), 1)
        self.browser.drag(x - 60, y, x + 60, y, modifiers=8)  # with Shift: a stretch
        self.assertGreater(self.zoom(), 3)

    def test_minimap(self):
        self.assertTrue(self.browser.ask("document.querySelector('#minimap').hidden"))
        self.open(solve("folded", QUADROTOR, long_script(210)))
        self.click("#zoom-in")
        self.browser.key("End")
        begin = self.browser.ask("page.timeline.view.offset")
        self.browser.drag(*self.place("#minimap"), self.place("#minimap")[0] - 100,
                          self.place("#minimap")[1])
        self.assertLess(self.browser.ask("page.timeline.view.offset"), begin)

    def boxes_of_marks(self):
        return self.browser.ask("page.timeline.scene().marks"
                                ".map((mark) => [mark.x, mark.lane, mark.x + mark.width, mark.numbers])")

    def assert_no_overlap(self, boxes):
        by_lane = {}
        for left, lane, right, _ in sorted(boxes):
            self.assertGreaterEqual(left, by_lane.get(lane, -1e9))
            by_lane[lane] = right

    def test_simultaneous_marks_do_not_overlap(self):
        boxes = self.boxes_of_marks()
        self.assertEqual(len(boxes), len(self.events))
        self.assert_no_overlap(boxes)

    def test_marks_fold_where_they_would_overlap(self):
        made = solve("folded", QUADROTOR, long_script(210))
        self.open(made)
        self.events = self.run_of(made)["events"]
        counts = []
        for _ in range(12):
            boxes = self.boxes_of_marks()
            self.assert_no_overlap(boxes)
            self.assertEqual(sorted(number for box in boxes for number in box[3]),
                             list(range(1, len(self.events) + 1)))
            counts.append(len(boxes))
            self.click("#zoom-in")
        self.assertLess(counts[0], len(self.events) / 4)
        self.assertGreater(counts[-1], 2 * counts[0])
        self.click("#fit")
        fold = self.browser.ask("page.timeline.scene().marks.find((mark) => mark.numbers.length > 1).numbers")
        self.browser.click(*self.mark(fold[0]))  # comes apart
        self.assertGreater(self.zoom(), 1)
        self.assert_shows(fold[0])

    def test_arrows_are_those_of_the_chosen_event(self):
        self.assertEqual(self.drawn("link-end"), 0)
        self.browser.key("n")
        for _ in range(4):
            self.browser.key("ArrowRight")
        self.assert_shows(6)
        self.assertEqual(self.drawn("link") + self.drawn("way"), 2)
        self.click("#all-links")
        self.assertGreater(self.drawn("link") + self.drawn("way"), 2)

    def test_arrows_end_on_bars(self):
        self.open(solve("folded", QUADROTOR, long_script(210)))
        self.click("#all-links")
        for _ in range(4):
            tips = self.browser.ask(
                "[...page.timeline.toSvg().querySelectorAll('path.link-end')].map((path) => ["
                "path.getAttribute('transform'), path.getAttribute('d')].map((text) =>"
                "Number(text.match(/-?\\d[\\d.e-]*/)[0])))")
            bars = self.browser.ask("page.run.spans.map((span) => [page.timeline.view.xs[span.from],"
                                    " page.timeline.view.endOf(span)])")
            self.assertGreater(len(tips), 0)
            for x, left in tips:
                tip = x + left + 3.6
                ends = [end for begin, end in bars if abs(begin - x) < 1e-6]
                self.assertTrue(any(x <= tip <= max(end, x + 1.5) for end in ends), (x, tip, ends))
            self.click("#zoom-in")

    def test_names_are_shortened_in_the_middle(self):
        self.browser.set_size(420, 900)
        names = self.browser.ask("[...document.querySelectorAll('#labels .behavior')]"
                                 ".map((one) => [one.title.replace('behavior ', ''), one.textContent])")
        cut = [(name, text) for name, text in names if name != text]
        self.assertGreater(len(cut), 3)
        for name, text in cut:
            begin, end = text.split("\u2026")
            self.assertTrue(name.startswith(begin) and name.endswith(end) and begin and end, text)
        width = "page.timeline.names.clientWidth"
        self.assertTrue(self.browser.ask("[...document.querySelectorAll('#labels .names-rows div')]"
                                         f".every((one) => one.scrollWidth <= {width})"))

    def test_whole_catalog(self):
        self.open(self.quadrotor)
        rows = "document.querySelectorAll('#labels .behavior').length"
        few = self.browser.ask(rows)
        self.click("#all-rows")
        self.assertGreater(self.browser.ask(rows), few)

    def test_light_and_dark(self):
        pairs = [("ink", "paper"), ("muted", "paper"), ("muted", "panel"), ("bad", "paper"),
                 ("bad", "bad-paper"), ("good", "paper"), ("requested-ink", "requested"),
                 ("required-ink", "required"), ("reactive-ink", "reactive")]
        backgrounds = set()
        for scheme in ("light", "dark"):
            self.browser.set_scheme(scheme)
            backgrounds.add(self.browser.ask("getComputedStyle(document.body).backgroundColor"))
            for text, ground in pairs:
                with self.subTest(scheme=scheme, text=text, ground=ground):
                    self.assertGreaterEqual(self.contrast(text, ground), 4.5)  # WCAG, level AA
        self.assertEqual(len(backgrounds), 2)

    def contrast(self, *names):
        def luminance(color):
            parts = [int(color[place:place + 2], 16) / 255 for place in (1, 3, 5)]
            parts = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4
                     for part in parts]
            return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2]

        light = sorted(luminance(self.browser.ask(
            f"getComputedStyle(document.documentElement).getPropertyValue('--{name}').trim()"))
            for name in names)
        return (light[1] + 0.05) / (light[0] + 0.05)

    def assert_no_findings_of_axe(self, name):
        self.browser.ask(AXE.read_text() + ";0")
        findings = self.browser.ask("axe.run().then(({ violations }) => violations.map((one) => [one.id, one.help,"
                                    " one.nodes.map((node) => node.html + node.failureSummary)]))")
        with self.subTest(page=name):
            self.assertEqual(findings, [])

    @unittest.skipUnless(AXE.exists(), "axe-core is not installed")
    def test_axe_finds_nothing(self):
        failed = solve("axe", QUADROTOR, write("axe.mission.yaml", {"events": [
            {"start": "HOVER"}, {"expect": {"running": {"LAND": "any"}}}]}), long_script(60))
        for scheme in ("light", "dark"):
            self.browser.set_scheme(scheme)
            for name, made in [("short", self.target), ("several", failed)]:
                self.open(made)
                self.browser.key("ArrowRight")
                self.assert_no_findings_of_axe(f"{name}, {scheme}")
        self.browser.key("?", "?")
        self.assert_no_findings_of_axe("help")
        self.browser.key("Escape")
        self.browser.set_size(420, 900)
        self.click("#more")
        self.assert_no_findings_of_axe("phone")
        # It does find what is wrong.
        self.browser.ask("document.querySelector('#slider').removeAttribute('aria-label')")
        found = self.browser.ask("axe.run().then(({ violations }) => violations.map((one) => one.id))")
        self.assertEqual(found, ["label"])

    def test_names_for_assistive_technology(self):
        self.browser.call("Accessibility.enable")
        tree = self.browser.call("Accessibility.getFullAXTree")["nodes"]
        self.browser.call("Accessibility.disable")
        controls = [node for node in tree if node.get("role", {}).get("value") in
                    ("button", "slider", "combobox", "checkbox", "image", "region", "group", "searchbox")]
        roles = {node["role"]["value"] for node in controls}
        self.assertLessEqual({"button", "slider", "combobox", "checkbox", "image"}, roles)
        for node in controls:
            self.assertTrue(node["name"].get("value"), node)
        ids = self.browser.ask("[...document.querySelectorAll('[id]')].map((one) => one.id)")
        self.assertEqual(len(ids), len(set(ids)))

    def test_focus_is_visible_on_the_way_through_the_page(self):
        seen = []
        for _ in range(30):
            self.browser.key("Tab")
            focused = self.browser.ask(
                "(() => { const one = document.activeElement, style = getComputedStyle(one);"
                "return [one.id || one.tagName, style.outlineStyle, parseFloat(style.outlineWidth)]; })()")
            if focused[0] == "BODY":
                break
            seen.append(focused[0])
            self.assertNotEqual(focused[1], "none", focused)
            self.assertGreaterEqual(focused[2], 1, focused)
        for name in ("slider", "problem-next", "search", "outcome", "scale", "zoom-in", "all-rows",
                     "save", "help-open", "plot"):
            self.assertIn(name, seen)

    def test_paper(self):
        self.open(self.quadrotor)
        paper = self.browser.pdf()
        self.assertTrue(paper.startswith(b"%PDF"))
        self.assertGreater(len(re.findall(rb"/Type\s*/Page\b", paper)), 1)
        (OUT / "quadrotor.pdf").write_bytes(paper)
        self.assertEqual(self.browser.ask("document.querySelectorAll('.for-print').length"), 0)
        self.browser.call("Emulation.setEmulatedMedia", media="print")
        self.browser.set_size(1030, 1400)
        self.browser.ask("dispatchEvent(new Event('beforeprint'))")
        self.assertEqual(self.browser.ask("document.querySelectorAll('#paper svg').length"), 1)
        rows = self.browser.ask("[...document.querySelectorAll('#events > tbody > tr')]"
                                ".map((row) => row.textContent)")
        for row, event in zip(rows, self.run_of(self.quadrotor)["events"]):
            for change in event["changes"]:
                self.assertIn(change["behavior"], row)
                self.assertIn(change["cause"], row)
        self.browser.screenshot(OUT / "print.png", whole=True)
        self.browser.ask("dispatchEvent(new Event('afterprint'))")
        self.assertEqual(self.browser.ask("document.querySelectorAll('#paper svg').length"), 0)
        self.browser.call("Emulation.setEmulatedMedia", media="")

    def test_two_thousand_events(self):
        made = solve("long", QUADROTOR, long_script(2000))
        self.events = self.run_of(made)["events"]
        self.assertGreaterEqual(len(self.events), 2000)
        begin = time.monotonic()
        self.open(made)
        for _ in range(100):
            self.browser.key("ArrowRight")
        self.assert_shows(101)
        self.browser.key("End")
        self.assert_shows(len(self.events))
        self.browser.screenshot(OUT / "long.png")
        for _ in range(8):
            self.click("#zoom-in")
        self.browser.key("Home")
        self.assert_shows(1)
        self.browser.screenshot(OUT / "long-zoomed.png")
        # Not how fast it is, but that it can be used at all.
        self.assertLess(time.monotonic() - begin, 30)

    def test_hostile_names(self):
        made = solve("hostile", *hostile_files())
        self.open(made)
        self.browser.key("Home")
        self.events = self.run_of(made)["events"]
        data = self.browser.ask("JSON.parse(document.querySelector('#data').textContent)")
        self.assertEqual(data["report"], made[1])
        for number in range(1, len(self.events) + 1):
            self.assert_shows(number)
            self.browser.key("ArrowRight")
        labels = self.browser.ask("[...document.querySelectorAll('#labels .task, #labels .behavior')]"
                                  ".map((label) => label.title.replace(/^(task|behavior) /, ''))")
        for name in [HOSTILE_TASK, *HOSTILE_BEHAVIORS]:
            self.assertIn(name, labels)
        self.assertEqual(self.browser.ask("document.querySelectorAll('img, b, body script').length"), 2)
        self.assert_saved_picture_is_xml()
        self.browser.screenshot(OUT / "hostile.png")

    def assert_saved_picture_is_xml(self):
        text = self.browser.ask("page.svgText()")
        picture = xml.etree.ElementTree.fromstring(text)
        self.assertEqual(picture.tag, "{http://www.w3.org/2000/svg}svg")
        names = {"".join(one.itertext()) for one in picture.iter("{http://www.w3.org/2000/svg}text")}
        self.assertIn(self.browser.ask("Rows.nameOf(page.timeline.rows.list[0])"), names)
        self.assertNotIn("var(", text)
        return text

    def test_saved_picture(self):
        for _ in range(3):
            self.click("#zoom-in")
        text = self.assert_saved_picture_is_xml()
        (OUT / "saved.svg").write_text(text)
        self.assertIn("MotionPlannerCloseTarget", text)

    def test_several_runs_and_failed_expectations(self):
        wrong = write("wrong.mission.yaml", {"events": [
            {"start": "HOVER"}, {"start": "LAND", "priority": 3, "at": 2},
            {"expect": {"running": {"HOVER": "any"}}}, {"start": "HOVER", "at": 4}]})
        empty = write("empty.mission.yaml", {"events": []})
        made = solve("several", QUADROTOR, "catalogs/quadrotor.mission.yaml", wrong, empty)
        self.open(made)
        rows = self.browser.ask("[...document.querySelectorAll('#missions tbody tr')]"
                                ".map((row) => [...row.cells].map((cell) => cell.textContent))")
        for row, run in zip(rows, made[1]["runs"], strict=True):
            rejected = sum(event["outcome"] == "rejected" for event in run["events"])
            self.assertTrue(run["script"].endswith(row[0]))
            self.assertEqual(row[2:5], [str(len(run["events"])), str(rejected),
                                        str(run["expectations"]["failed"])])
        self.assertEqual([row[1][2:] for row in rows], ["passed", "failed", "passed"])
        self.assertIn("3 missions: 1 failed", self.text("#overview-summary"))
        self.assertEqual(self.browser.ask("document.querySelectorAll('.strip-failed').length"), 1)
        # It opens at the first failure.
        self.assertEqual(self.text("#title"), wrong)
        self.events = self.run_of(made, 1)["events"]
        self.assert_shows(2)
        failure = self.run_of(made, 1)["expectations"]["failures"][0]["message"]
        self.assertIn(failure, self.text("#alarms"))
        self.assertIn(failure, self.text("#events tbody tr:nth-child(2)"))
        self.assertIn(failure, self.text("#detail-body"))
        self.browser.key("Home")
        self.click("#alarms button")
        self.assertEqual(self.number(), 2)
        self.browser.screenshot(OUT / "failed.png")
        # The next rejected or failed one, and around.
        for key, number in [("n", 3), ("n", 2), ("p", 3), ("p", 2)]:
            self.browser.key(key)
            self.assertEqual(self.number(), number)
        self.choose_run(0)
        self.events = self.run_of(made)["events"]
        self.assert_shows(1)
        self.assertTrue(self.browser.ask("document.querySelector('#alarms').hidden"))
        for key, title in [("]", wrong), ("]", empty), ("]", empty), ("[", wrong)]:
            self.browser.key(key)
            self.assertEqual(self.text("#title"), title)
        self.choose_run(2)
        self.assertEqual(self.status(), "No events.")
        for key in ("ArrowRight", "n", "+", "s"):
            self.browser.key(key)
        self.assertEqual(self.status(), "No events.")

    def test_links_survive_a_reload(self):
        other = write("other.mission.yaml", {"events": [{"start": "HOVER"}]})
        made = solve("links", QUADROTOR, other, "catalogs/quadrotor.mission.yaml")
        self.open(made)
        self.choose_run(1)
        self.events = self.run_of(made, 1)["events"]
        for _ in range(4):
            self.browser.key("ArrowRight")
        time.sleep(0.2)  # the address is written after a moment
        link = self.browser.ask("location.hash")
        self.assertEqual(urllib.parse.parse_qs(link[1:]), {
            "mission": ["catalogs/quadrotor.mission.yaml"], "event": ["5"]})
        self.browser.reload()
        self.assert_shows(5)
        self.assertEqual(self.text("#title"), "catalogs/quadrotor.mission.yaml")
        self.browser.ask(f"location.hash = '{link.replace('event=5', 'event=7')}'")
        self.browser.settle()
        self.assert_shows(7)
        self.browser.ask("location.hash = '#mission=missing&event=1'")
        self.browser.settle()
        self.assert_shows(7)

    def test_search(self):
        made = solve("quadrotor", QUADROTOR, "catalogs/quadrotor.mission.yaml")
        self.open(made)
        self.events = self.run_of(made)["events"]
        shown = "[...document.querySelectorAll('#events > tbody > tr')].filter((row) => !row.hidden)" \
                ".map((row) => Number(row.dataset.event))"
        self.browser.key("/")
        self.browser.write("hover")
        found = self.browser.ask(shown)
        self.assertLess(len(found), len(self.events))
        expected = [number for number, event in enumerate(self.events, 1) if "hover" in json.dumps(
            [event.get("name"), event.get("situation"), event["changes"], event["stopped_tasks"]]).lower()]
        self.assertEqual(found, expected)
        self.assertEqual(self.text("#found"), f"{len(found)} of {len(self.events)}")
        self.browser.key("Enter")
        self.assertIn(self.number(), found)
        self.open(solve("folded", QUADROTOR, long_script(210)))
        self.browser.key("/")
        self.browser.write("hover")
        count = self.browser.ask("page.found.size")
        parts = [re.fullmatch(r"(\d+) of \d+", text) for text in self.drawing()]
        self.assertLessEqual(sum(int(part.group(1)) for part in parts if part), count)
        self.assertGreater(sum(part is not None for part in parts), 3)
        self.open(made)
        self.browser.key("/")
        self.browser.write("hover")
        names = self.browser.ask("[...document.querySelectorAll('#labels .task')].map((one) => one.title)")
        self.assertEqual(names, ["task HOVER"])
        self.browser.key("Escape")
        self.assertEqual(len(self.browser.ask(shown)), len(self.events))
        self.browser.ask("(() => { const one = document.querySelector('#outcome'); one.value = 'rejected';"
                         "one.dispatchEvent(new Event('change')); })()")
        self.assertEqual(self.browser.ask(shown), [event["index"] for event in self.events
                                                   if event["outcome"] == "rejected"])

    def test_why_of_events_and_of_failed_expectations(self):
        def explain(data):
            run = data["report"]["runs"][0]
            why = {"limit_reached": False, "conflict": [], "alternative": {
                "running": {"ApproachTarget": "<i>Other</i>"},
                "objective": {"satisfied": 1, "requests": 1, "suitability": 0.6498, "idle": 0, "changes": 1}}}
            run["expectations"] = {"passed": 4, "failed": 1, "failures": [{
                "index": 4, "line": 12, "message": "expected another behavior", "why": [{
                    **why, "event": 2, "tasks": ["ApproachTarget"], "message": "event 2 at 15.000 s decided it",
                    "loses": {"objective": "suitability", "chosen": "0.684", "alternative": "0.6498"},
                    "differences": [{"task": "ApproachTarget", "chosen": {"behavior": "Slow", "suitability": 80},
                                     "alternative": {"behavior": "<i>Other</i>", "suitability": 95}},
                                    {"task": "LocalizeTarget", "chosen": None,
                                     "alternative": {"behavior": "Far", "suitability": 68.4}}]}]}]}
            run["events"][0]["why"] = [{
                **why, "task": "LocalizeTarget", "chosen": "Far", "message": "why LocalizeTarget has Far",
                "loses": {"objective": "idle", "chosen": "3/7", "alternative": "5/7"}, "differences": []}]
            run["events"][0]["alternatives"] = {"limit_reached": False, "configurations": [why["alternative"]]}

        self.open(changed("why", self.target, explain))
        self.assertEqual(self.number(), 4)
        text = self.text("#detail-body")
        self.assertIn("event 2 at 15.000 s decided it", text)
        rows = self.browser.ask("[...document.querySelectorAll('.differences tbody tr')]"
                                ".map((row) => [...row.cells].map((cell) => cell.textContent))")
        self.assertEqual(rows, [["ApproachTarget", "Slow, 80 %", "<i>Other</i>, 95 %"],
                                ["LocalizeTarget", "does not run", "Far, 68.4 %"],
                                ["product of all that runs", "0.684", "0.6498"]])
        self.browser.screenshot(OUT / "why.png")
        self.click("#detail-body button")
        self.assertEqual(self.number(), 2)
        self.browser.key("Home")
        text = self.text("#detail-body")
        for part in ("why LocalizeTarget has Far", "ApproachTarget: <i>Other</i>", "Requests come first"):
            self.assertIn(part, text)

    def test_policy_allows_nothing_but_the_page(self):
        policy = self.browser.ask("document.querySelector('meta[http-equiv]').content")
        self.assertIn("default-src 'none'", policy)
        self.assertNotIn("unsafe", policy)
        self.browser.ask("document.body.append(Object.assign(document.createElement('script'),"
                         "{ textContent: 'window.isRun = true' }))")
        self.browser.settle()
        self.assertFalse(self.browser.ask("window.isRun === true"))
        self.assertEqual([noise["method"] for noise in self.noises()], ["Log.entryAdded"])
        self.open(self.target)

    def test_help(self):
        self.browser.key("?", "?")
        self.assertTrue(self.browser.ask("document.querySelector('#help').open"))
        self.assertIn("highest product of the suitabilities", self.text("#help"))
        self.browser.key("ArrowRight")
        self.browser.key("Escape")
        self.assertFalse(self.browser.ask("document.querySelector('#help').open"))
        self.assert_shows(1)

    def test_graph_of_the_state(self):
        for number, event in enumerate(self.events, 1):
            self.browser.ask(f"page.choose({number})")
            nodes = self.browser.ask(
                "[...document.querySelectorAll('#graph .node:not(.stopped) title')]"
                ".map((title) => title.textContent.split('\\n')[0].split(': '))")
            self.assertEqual(dict(nodes), event["running"])
            stopped = self.browser.ask("[...document.querySelectorAll('#graph .node.stopped')].length")
            before = self.events[number - 2]["running"] if number > 1 else {}
            self.assertEqual(stopped, len(before.keys() - event["running"].keys()))
        self.browser.ask("page.choose(1)")
        self.assertEqual(self.browser.ask("document.querySelectorAll('#graph .edge').length"), 3)
        self.browser.key("g")
        self.assertTrue(self.browser.ask("document.querySelector('#graph').hidden"))
        self.open(solve("large-graph", "catalogs/autoware.yaml", "catalogs/autoware.mission.yaml"))
        self.browser.ask("page.choose(12)")
        self.assertGreater(self.browser.ask("document.querySelectorAll('#graph .node').length"), 30)
        self.assertLess(self.browser.ask("document.querySelector('#graph').clientWidth"), 600)
        inner, outer = self.browser.ask(
            "['#graph .node.started', '#graph-body'].map((one) => document.querySelector(one)"
            ".getBoundingClientRect()).map((box) => [box.left, box.top, box.right, box.bottom])")
        for place in range(4):
            self.assertGreaterEqual(inner[place], outer[place % 2])
            self.assertLessEqual(inner[place], outer[place % 2 + 2])
        self.browser.screenshot(OUT / "large-graph.png")

    def test_details_stay_in_view(self):
        self.open(self.quadrotor)
        places = set()
        for size in ((1600, 1000), (1200, 760), (420, 900)):
            self.browser.set_size(*size)
            self.browser.key("Home")
            for _ in range(8):
                self.browser.key("ArrowRight")
                box = self.browser.ask(
                    "[...['#status', '#detail-body .headline'].map((one) => document.querySelector(one)"
                    ".getBoundingClientRect())].map((box) => [box.top, box.bottom])")
                places.add((size, *box[0]))
                self.assertGreaterEqual(box[1][0], 0)
                self.assertLessEqual(box[1][1], size[1])
        self.assertEqual(len(places), 3)  # the status is always at the same place

    def test_reactive_starts_timeouts_and_restarts(self):
        case = "tests/golden/cases/"
        made = solve("reactive", case + "reactive_queue/catalog.yaml",
                     case + "reactive_queue/script.yaml")
        self.open(made)
        self.browser.ask("page.timeline.setScale('event')")
        events = self.run_of(made)["events"]
        started = [event for event in events
                   if event["origin"] == "reactive" and event["outcome"] == "accepted"]
        self.assertGreater(len(started), 0)
        for event in started:
            self.assertEqual(self.mark_text(event["index"]), f"{event['index']} r")
        self.assertGreaterEqual(self.drawn("reactive"), 1)
        self.browser.screenshot(OUT / "reactive.png")
        made = solve("timeouts", case + "timeouts/catalog.yaml", case + "timeouts/script.yaml")
        self.open(made)
        for event in self.run_of(made)["events"]:
            mark = self.mark_text(event["index"])
            self.assertEqual(mark.endswith(" t"), event["origin"] == "timeout")
        made = solve("restart", case + "restart/catalog.yaml", case + "restart/script.yaml")
        self.open(made)
        restarts = [event["index"] for event in self.run_of(made)["events"]
                    if any(change["cause"] == "restarted" for change in event["changes"])]
        self.assertGreater(len(restarts), 0)
        for number in restarts:
            row = self.text(f"#events > tbody > tr:nth-child({number})")
            self.assertIn("restarts \u2013 its parameters changed", row)
        self.browser.screenshot(OUT / "restart.png")

    def test_names_that_a_task_and_a_behavior_share(self):
        case = "tests/golden/cases/solve_same_names/"
        self.open(solve("same-names", case + "catalog.yaml", case + "script.yaml"))
        rows = [self.text(f"#events > tbody > tr:nth-child({number})") for number in range(1, 5)]
        self.assertIn("behavior LAND (LAND) takes the place of HOVER_WITH_PID (HOVER)", rows[1])
        self.assertIn("task LAND was started with priority 1; task LAND excludes HOVER", rows[1])
        self.assertIn("finish behavior LAND: goal achieved", rows[2])
        self.assertIn("behavior LAND stops (LAND)", rows[2])
        self.assertIn("fault behavior LAND", rows[3])
        self.open(self.target)

    def test_situations_and_waiting_tasks(self):
        catalog = "tests/golden/cases/graph_situation/catalog.yaml"
        script = write("situations.mission.yaml", {
            "situation": {"GPS_SIGNAL": False},
            "events": [
                {"start": "TAKE_OFF", "priority": 2},
                {"start": "FOLLOW_TARGET", "priority": 2, "at": 1},
                {"situation": {"TARGET": "near"}, "at": 2},
                {"finish": {"task": "TAKE_OFF"}, "at": 5},
                {"situation": {"GPS_SIGNAL": True, "PID_CONTROL": False}, "at": 6},
                {"finish": {"task": "TAKE_OFF"}},
                {"situation": {"TARGET": "lost"}, "at": 7},
                {"wait": 3}]})
        made = solve("situations", catalog, script)
        self.open(made)
        self.events = self.run_of(made)["events"]
        values = {"TARGET": "far", "GPS_SIGNAL": False}
        lanes = self.browser.ask("[...page.timeline.toSvg().querySelectorAll('.value-text')]"
                                 ".map((text) => text.textContent)")
        self.assertEqual(sorted(lanes), ["false", "far", "lost", "near", "true"])
        labels = self.browser.ask("[...document.querySelectorAll('#labels .variable')]"
                                  ".map((label) => label.textContent)")
        self.assertEqual(labels, ["TARGET", "GPS_SIGNAL"])
        waited = []
        for number, event in enumerate(self.events, 1):
            self.assert_shows(number)
            values.update(event.get("variables", {}))
            state = self.text("#state-body")
            shown = f"TARGET is {values['TARGET']}, GPS_SIGNAL is {str(values['GPS_SIGNAL']).lower()}"
            self.assertIn(shown, state)
            is_waiting = "waiting reactive tasks" in state
            self.assertEqual(is_waiting, event["outcome"] == "rejected" or
                             (len(waited) > 0 and "HOVER" in event["queue"]), number)
            if event["queue"].get("HOVER", 0) is None:
                self.assertTrue(is_waiting, number)
            self.assertEqual("RECOGNIZE_FAR" in state.partition("do not fit")[2],
                             values["TARGET"] != "far", number)
            row = self.text(f"#events > tbody > tr:nth-child({number})")
            if "waits, and tries again" in row:
                waited.append(number)
                for reason in event["conflict"]:
                    self.assertIn(reason["message"], row)
            if event["origin"] == "situation":
                self.assertEqual(self.mark_text(number), f"{number} s")
                self.assertIn(f"{event['name']} does not fit: ", row)
            if event.get("name", "") is None:
                self.assertIn("finish task TAKE_OFF, which nothing performs", row)
            self.browser.key("ArrowRight")
        self.assertEqual(len(waited), 1)
        self.assertEqual(self.events[waited[0] - 1]["origin"], "reactive")
        self.assertEqual(self.drawn("waiting"), 1)
        self.assertGreater(self.drawing().count("does not fit"), 1)
        self.assertIn("reactive task that waits", self.text("#legend"))
        self.browser.screenshot(OUT / "situations.png")
        self.open(self.target)
        self.assertNotIn("reactive task that waits", self.text("#legend"))
        self.events = self.run_of(self.target)["events"]

    def choose_run(self, place):
        self.click(f"#missions tbody tr:nth-child({place + 1}) td:nth-child(3)")

    def test_pictures_to_look_at(self):
        for scheme in ("light", "dark"):
            self.browser.set_scheme(scheme)
            self.open(self.target)
            for _ in range(5):
                self.browser.key("ArrowRight")
            self.browser.set_size(1600, 2000)
            self.browser.screenshot(OUT / f"target-following-{scheme}.png")
            self.open(self.quadrotor)
            self.browser.screenshot(OUT / f"quadrotor-{scheme}.png")
        self.browser.set_size(420, 900)
        self.browser.screenshot(OUT / "narrow.png", whole=True)
        self.open(self.quadrotor)
        self.browser.screenshot(OUT / "phone.png")

    def test_picture_of_the_readme(self):
        """docs/figures/timeline.png is this one, with fewer colors; see CONTRIBUTING.md."""
        self.browser.set_scheme("light")
        self.browser.set_size(1280, 860, scale=1.5)
        self.open(solve("timeline", "catalogs/target-following.yaml",
                        "catalogs/target-following.mission.yaml"))
        for _ in range(9):
            self.browser.key("ArrowRight")
        self.browser.screenshot(OUT / "timeline.png")


if __name__ == "__main__":
    unittest.main(verbosity=2)
