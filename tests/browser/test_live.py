"""The page of `cbc solve --format jsonl --serve`, which grows while events come."""

import json
import os
import pathlib
import re
import signal
import subprocess
import time
import unittest

from page_case import AXE, OUT, PROGRAM, QUADROTOR, ROOT, PageCase, long_script

# What a page knows about a run, however it came to know it.
KNOWLEDGE = r"""(() => {
  const { run, timeline } = page;
  const marks = timeline.marker;
  page.table.fillAll();
  return {
    size: run.size, spans: run.spans, links: run.links, linksOf: run.linksOf, outages: run.outages,
    valueSpans: run.valueSpans, values: run.values.map((one) => [...one]), waitings: run.waitings,
    waiting: run.waiting, unavailable: run.unavailable, misfits: run.misfits, faulty: run.faulty,
    problems: run.problems, mostAtOnce: run.mostAtOnce, rows: run.rows(false),
    marks: [marks.others, marks.problems].map((list) => list.map(({ numbers, text, look }) => [numbers, text, look])),
    lanes: marks.lanes(timeline.view), places: [...timeline.view.places], head: timeline.head,
    names: [...document.querySelectorAll('#labels div')].map((one) => one.textContent),
    table: [...document.querySelectorAll('#events > tbody > tr')].map((row) => row.textContent),
    counts: document.querySelector('#counts').textContent, picture: page.svgText().replaceAll(/ink-\d+/g, 'ink'),
  };
})()"""


class Stream:
    """A running program whose page is served."""

    def __init__(self, *arguments, address="127.0.0.1:0", log=os.devnull):
        with open(log, "w") as out:
            self.process = subprocess.Popen(
                [PROGRAM, "solve", QUADROTOR, "-", "--format", "jsonl", "--serve", address, *arguments],
                cwd=ROOT, stdin=subprocess.PIPE, stdout=out, stderr=subprocess.PIPE, text=True)
        self.url = re.search(r"http\S+", self.process.stderr.readline()).group()
        self.address = self.url.removeprefix("http://").rstrip("/")

        self.lines = 0

    def feed(self, events):
        for event in events:
            self.process.stdin.write((event if isinstance(event, str) else json.dumps(event)) + "\n")
        self.process.stdin.flush()
        self.lines += len(events)

    def end(self):
        self.process.stdin.close()
        self.process.wait(20)
        self.process.stderr.close()

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.end()


class Live(PageCase):
    def setUp(self):
        super().setUp()
        self.script = json.loads(pathlib.Path(long_script(400)).read_text())["events"]
        self.log = OUT / "live.jsonl"
        self.stream = Stream(log=self.log)
        self.addCleanup(lambda: self.stream.process.stdin.closed or self.stream.end())
        self.open((self.stream.url,))

    def requests(self):
        """What the page asks for from its server counts as the page."""
        urls = super().requests()
        return urls[:1] + [url for url in urls[1:] if not url.startswith(self.url + "events?run=")]

    def wait_for(self, condition):
        deadline = time.monotonic() + 30
        while not self.browser.ask(condition):
            self.assertLess(time.monotonic(), deadline, condition)
            time.sleep(0.02)
        self.browser.settle()

    def feed(self, events):
        """Feeds the stream, and waits until the page has all of it."""
        self.stream.feed([*events, "last"])  # which is refused
        self.wait_for(f"page.live.refusals.at(-1)?.line === {self.stream.lines} && page.live.timer === null")

    def size(self):
        return self.browser.ask("page.run.size")

    def live(self):
        return self.text("#live-state")

    def test_follows_the_newest_event(self):
        self.wait_for("document.querySelector('#live').dataset.state === 'live'")
        self.assertEqual(self.live(), "Live")
        self.assertEqual(self.status(), "No events.")
        self.assertTrue(self.browser.ask("document.querySelector('#next').disabled"))
        self.feed(self.script[:10])
        self.assertEqual(self.number(), self.size())
        self.feed(self.script[10:60])
        self.assertEqual(self.number(), self.size())
        self.assertEqual(self.browser.ask("location.hash"), "")
        self.browser.screenshot(OUT / "live.png")
        self.assertFalse(self.browser.ask("document.querySelector('#newest').checkVisibility()"))

    def test_stays_at_a_chosen_event_until_the_newest_is_wanted(self):
        self.feed(self.script[:20])
        self.browser.key("Home")
        self.browser.key("ArrowRight")
        self.feed(self.script[20:40])
        self.assertEqual(self.number(), 2)
        size = self.size()
        self.assertEqual(self.text("#newest"), f"newest event ({size - 2} events later)")
        self.assertTrue(self.status().startswith(f"Event 2 of {size} "))
        time.sleep(0.2)
        self.assertIn("event=2", self.browser.ask("location.hash"))
        self.click("#newest")
        self.feed(self.script[40:50])
        self.assertEqual(self.number(), self.size())
        self.browser.key("ArrowLeft")
        self.browser.key("End")
        self.feed(self.script[50:60])
        self.assertEqual(self.number(), self.size())
        self.browser.key("ArrowLeft")
        time.sleep(0.2)
        number = self.number()
        self.browser.reload()  # the address says which event is wanted
        self.wait_for(f"page.run.size > {number}")
        self.assertEqual(self.number(), number)

    def test_grows_to_the_page_of_the_log(self):
        faults = [{"fault": "HOVER_WITH_MPC_CONTROL"}, {"repair": "HOVER_WITH_MPC_CONTROL", "wait": 40}]
        for begin in range(0, 150, 10):
            self.feed(self.script[begin:begin + 10] + faults[begin // 10 % 2:][:1])
            self.browser.key("-" if begin % 20 else "+", "-" if begin % 20 else "+")
        self.stream.end()
        self.wait_for("document.querySelector('#live').dataset.state === 'ended'")
        self.browser.ask("page.choose(1), page.timeline.fit(), document.querySelector('#live').hidden = true")
        self.browser.settle()
        without_graph = "page.graph.want(false)"  # its width depends on the events that were shown before
        self.browser.ask(without_graph)
        self.browser.settle()
        grown = self.browser.ask(KNOWLEDGE)
        drawn = OUT / "live.html"
        subprocess.run([PROGRAM, "solve", QUADROTOR, self.log, "--html", drawn], cwd=ROOT,
                       stdout=subprocess.DEVNULL, check=True)
        self.open((drawn.as_uri(),))
        self.browser.ask("document.querySelector('#alarms').hidden = false")  # as high as before
        self.browser.ask(without_graph)
        self.browser.settle()
        whole = self.browser.ask(KNOWLEDGE)
        self.assertGreater(len(whole["outages"]), 5)
        for name, value in whole.items():
            with self.subTest(knowledge=name):
                self.assertEqual(grown[name], value)

    def test_what_is_zoomed_stays_where_it_is(self):
        self.feed(self.script[:100])
        self.browser.key("Home")
        self.click("#zoom-in")
        self.click("#zoom-in")
        before = self.browser.ask("[...page.timeline.view.xs].slice(1, 20)")
        self.feed(self.script[100:200])
        after = self.browser.ask("[...page.timeline.view.xs].slice(1, 20)")
        for one, other in zip(before, after):
            self.assertAlmostEqual(one, other, delta=0.01)

    def test_failures_and_refused_lines(self):
        self.stream.feed([{"start": "HOVER"}, {"expect": {"running": {"LAND": "any"}}}])
        self.wait_for("page.run.failures.size === 1 && page.run.size === 1")
        self.assertIn("failed expectation", self.status())
        self.assertIn("failed expectation", self.text("#alarms"))
        self.assertTrue(self.browser.ask("document.title").startswith("\u00d7 "))
        self.assertEqual(self.mark_text(1), "! 1")
        self.assertEqual(self.browser.ask("document.querySelectorAll('#events .is-failed').length"), 1)
        self.feed([{"start": "LAND"}] + ["bad"] * 6)
        self.assertEqual(self.browser.ask("page.run.problems"), [1])
        alarms = self.browser.ask("[...document.querySelectorAll('#alarms p')].map((one) => one.textContent)")
        self.assertEqual(len(alarms), 1 + 5 + 1)
        self.assertIn("line 10 of the stream was refused: ", alarms[1])
        self.assertEqual(alarms[-1], "and 2 lines before")
        self.stream.feed([{"expect": {"outcome": "rejected"}}, {"start": "HOVER"}])
        self.stream.end()
        self.wait_for("document.querySelector('#live').dataset.state === 'ended'")
        self.wait_for("page.run.size === 3")
        self.assertEqual(self.browser.ask("page.run.problems"), [1, 2])
        self.assertIn("expectations: 0 passed, 2 failed", self.text("#counts"))

    def test_the_last_events_of_a_long_stream_are_kept(self):
        events = json.loads(pathlib.Path(long_script(13_000)).read_text())["events"]
        self.feed(events[:4000])
        self.browser.key("Home")
        for begin in range(4000, 13_000, 1000):
            self.feed(events[begin:begin + 1000])
        size, left = self.browser.ask("[page.run.size, page.run.begin.index]")
        self.assertLessEqual(size, 10_000)
        self.assertGreater(left, 4000)
        last = json.loads(self.log.read_text().splitlines()[-2])
        self.assertEqual(last["index"], left + size)
        self.assertEqual(self.text("#live-note"), f"The {left} events before are not on this page.")
        self.assertEqual(self.number(), left + 1)  # the chosen one is gone
        self.browser.key("End")
        self.assertEqual(self.number(), left + size)
        self.assertEqual(self.shown_state(), last["running"])
        state = self.browser.ask("[page.run.unavailable.at(-1), page.run.faulty.at(-1)]")
        unavailable = {}
        for line in self.log.read_text().splitlines()[1:]:
            unavailable.update(json.loads(line).get("situation", {}))
        self.assertEqual(sorted(state[0]), sorted(name for name, value in unavailable.items() if not value))
        # A page that is opened now begins where it can.
        self.open((self.url,))
        self.wait_for(f"page.live.lastIndex === {left + size} && page.live.timer === null")
        self.assertGreater(self.browser.ask("page.run.begin.index"), left)
        self.assertEqual(self.number(), left + size)
        self.assertEqual(self.shown_state(), last["running"])
        self.assertEqual(self.browser.ask("[page.run.unavailable.at(-1), page.run.faulty.at(-1)]"), state)
        self.browser.screenshot(OUT / "live-long.png")

    def test_end_loss_and_another_run(self):
        self.feed(self.script[:20])
        size = self.size()
        self.stream.kill()
        self.wait_for("document.querySelector('#live').dataset.state === 'lost'")
        self.assertIn("Connection lost", self.live())
        self.assertEqual(self.size(), size)
        self.stream = Stream(address=self.stream.address)
        self.wait_for("document.querySelector('#live').dataset.state === 'other'")
        self.assertIn("reload the page", self.live())
        self.browser.reload()
        self.feed(self.script[:5])
        self.stream.end()
        self.wait_for("document.querySelector('#live').dataset.state === 'ended'")
        self.assertIn("Ended", self.live())
        self.browser.screenshot(OUT / "live-ended.png")
        self.click("#first")
        self.assertEqual(self.number(), 1)

    def noises(self):
        """Chromium itself reports that a connection is lost."""
        return [noise for noise in super().noises()
                if noise["params"].get("entry", {}).get("source") != "network"]

    def test_a_silent_connection_counts_as_lost(self):
        self.feed(self.script[:5])
        size = self.size()
        self.browser.ask("page.live.heard = 0, page.live.look()")
        self.wait_for("document.querySelector('#live').dataset.state === 'live'")
        self.feed(self.script[5:10])
        self.assertGreater(self.size(), size)
        indices = self.browser.ask("page.run.events.map((event) => event.index)")
        self.assertEqual(indices, list(range(1, len(indices) + 1)))

    def test_what_is_announced(self):
        """The state of the connection is, and events that somebody chooses; not each event that comes."""
        politeness = "document.querySelector('#status').getAttribute('aria-live')"
        self.assertEqual(self.browser.ask("document.querySelector('#live-state').getAttribute('role')"), "status")
        self.feed(self.script[:10])
        self.assertEqual(self.browser.ask(politeness), "off")
        self.browser.key("Home")
        self.assertEqual(self.browser.ask(politeness), "polite")
        self.feed(self.script[10:20])
        self.assertEqual(self.browser.ask(politeness), "off")

    @unittest.skipUnless(AXE.exists(), "axe-core is not installed")
    def test_axe_finds_nothing(self):
        self.feed(self.script[:30])
        self.browser.key("Home")
        self.feed(self.script[30:40])
        for scheme in ("light", "dark"):
            self.browser.set_scheme(scheme)
            self.assert_no_findings_of_axe(f"live, {scheme}")
        self.browser.screenshot(OUT / "live-dark.png")
        self.browser.set_size(420, 900)
        self.browser.screenshot(OUT / "live-phone.png")
        self.assert_no_findings_of_axe("live, phone")
