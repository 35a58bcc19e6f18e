"""The timeline of the page of `cbc solve --html`, its gestures, and the graph of the state."""

import re
import time
import unittest

from page_case import OUT, QUADROTOR, PageCase, long_script, solve, write


class Timeline(PageCase):
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

    def test_folded_marks_stay_in_the_picture(self):
        made = solve("folded", QUADROTOR, long_script(210))
        for width in range(1100, 1600, 70):
            self.browser.set_size(width, 900)
            self.open(made)
            ends = self.browser.ask("page.timeline.scene().marks.map((mark) => mark.x + mark.width)")
            self.assertLessEqual(max(ends), self.browser.ask("page.timeline.view.width"))
            self.assert_no_overlap(self.boxes_of_marks())

    def test_rejected_events_beside_failed_ones_are_counted(self):
        events = [{"start": "LAND", "priority": 3}, {"expect": {"stopped": ["LAND"]}}]
        for place in range(300):
            events += [{"start": "HOVER", "at": 1 + place}, {"start": "HOVER", "at": 1 + place}]
        events += [{"expect": {"stopped": ["LAND"]}}]
        self.open(solve("beside", QUADROTOR, write("beside.mission.yaml", {"events": events})))
        marks = self.browser.ask("page.timeline.scene().marks.filter((mark) => mark.look === 'fold-bad').map((mark) =>"
                                 " [mark.text, mark.numbers.filter((one) => page.run.isFailed(one)).length,"
                                 " mark.numbers.length])")
        mixed = [mark for mark in marks if 0 < mark[1] < mark[2]]
        self.assertGreater(len(mixed), 0)
        for text, failed, count in mixed:
            self.assertIn(f"+{count - failed}", text.replace(", ", " +"))

    def test_nothing_is_cut_at_the_edges(self):
        self.open(solve("folded", QUADROTOR, long_script(210)))
        counts = {"marks": 0, "ticks": 0, "moved": 0}
        for scale in ("time", "event"):
            self.browser.ask(f"page.timeline.setScale('{scale}'); page.timeline.fit()")
            for _ in range(9):
                self.browser.ask("page.timeline.zoomBy(1.7, 400)")
                for _ in range(12):
                    self.browser.ask("page.timeline.panBy(37)")
                    self.browser.settle()
                    found = self.browser.ask(
                        "(() => { const { width, xs } = page.timeline.view, svg = page.timeline.toSvg();"
                        "const marks = page.timeline.targets.filter(({ mark }) => mark !== undefined);"
                        "return { width, marks: marks.map(({ x, width, numbers }) => [x, x + width,"
                        "   numbers.length === 1 ? x + width / 2 - xs[numbers[0]] : 0, numbers]),"
                        " ticks: [...svg.querySelectorAll('.tick-text')].map((one) => [Number(one.getAttribute('x')),"
                        "   measure(one.textContent) / 2]) }; })()")
                    for left, right, shift, _ in found["marks"]:
                        self.assertGreaterEqual(left, 0)
                        self.assertLessEqual(right, found["width"])
                        counts["marks"] += 1
                        counts["moved"] += abs(shift) > 0.5
                    for x, half in found["ticks"]:
                        self.assertGreaterEqual(x - half, 0)
                        self.assertLessEqual(x + half, found["width"])
                        counts["ticks"] += 1
                    lanes = self.browser.ask("page.timeline.targets.filter(({ mark }) => mark !== undefined).map(({ mark }) =>"
                                             " [mark.x, mark.lane, mark.x + mark.width, mark.numbers])")
                    self.assert_no_overlap(lanes)
        for name, least in (("marks", 500), ("ticks", 500), ("moved", 10)):
            self.assertGreater(counts[name], least)

    def test_slider_takes_the_room_that_is_there(self):
        width = "document.querySelector('#slider').offsetWidth"
        wide = self.browser.ask(width)
        self.assertGreater(wide, 240)
        self.browser.set_size(2400, 1250)
        self.assertGreater(self.browser.ask(width), wide + 600)
        for narrow in ((1440, 900), (1280, 800), (1000, 700), (390, 844)):
            self.browser.set_size(*narrow)
            self.assertGreater(self.browser.ask(width), 150)

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
            parts = text.split("\u2026")
            self.assertRegex(name, "^" + ".+".join(map(re.escape, parts)) + "$")
            self.assertTrue(parts[0] and parts[-1] or parts[1], text)  # what tells siblings apart is in the middle
        width = "page.timeline.names.clientWidth"
        self.assertTrue(self.browser.ask("[...document.querySelectorAll('#labels .names-rows div')]"
                                         f".every((one) => one.scrollWidth <= {width})"))

    def test_whole_catalog(self):
        self.open(self.quadrotor)
        rows = "document.querySelectorAll('#labels .behavior').length"
        few = self.browser.ask(rows)
        self.click("#all-rows")
        self.assertGreater(self.browser.ask(rows), few)

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

    def test_saved_picture(self):
        for _ in range(3):
            self.click("#zoom-in")
        text = self.assert_saved_picture_is_xml()
        (OUT / "saved.svg").write_text(text)
        self.assertIn("MotionPlannerCloseTarget", text)

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

    def test_reactive_starts_timeouts_and_restarts(self):
        case = "tests/golden/shared/"
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

    def test_situations_and_waiting_tasks(self):
        catalog = "tests/golden/shared/graph_situation/catalog.yaml"
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


if __name__ == "__main__":
    unittest.main(verbosity=2)
