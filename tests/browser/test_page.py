"""The page of `cbc solve --html` in a headless Chromium.

    ./dev test-browser

Screenshots go to build/browser; look at them after a change of the page. questions.md has what
somebody who has never seen the page should find out from one of them.
"""

import json
import random
import re
import time
import unittest
import urllib.parse

from chromium import BrowserError
from page_case import (
    AXE, HOSTILE_BEHAVIORS, HOSTILE_TASK, OUT, QUADROTOR, PageCase, hostile_files, long_script,
    shown, solve, write)


class Page(PageCase):
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
        for event in data["report"]["runs"][0]["events"]:
            event.pop("note", None)  # for the page alone
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

    def test_hostile_names(self):
        made = solve("hostile", *hostile_files())
        self.open(made)
        self.browser.key("Home")
        self.events = self.run_of(made)["events"]
        data = self.browser.ask("JSON.parse(document.querySelector('#data').textContent)")
        for run in data["report"]["runs"]:
            for event in run["events"]:
                event.pop("note", None)  # for the page alone
        self.assertEqual(data["report"], made[1])
        for number in range(1, len(self.events) + 1):
            self.assert_shows(number)
            self.browser.key("ArrowRight")
        labels = self.browser.ask("[...document.querySelectorAll('#labels .task, #labels .behavior')]"
                                  ".map((label) => label.title.replace(/^(task|behavior) /, ''))")
        for name in [HOSTILE_TASK, *HOSTILE_BEHAVIORS]:
            self.assertIn(shown(name), labels)
        self.assertEqual(self.browser.ask("document.querySelectorAll('img, b, body script').length"), 2)
        self.assert_saved_picture_is_xml()
        self.browser.screenshot(OUT / "hostile.png")

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

    def test_a_fault_that_explains_a_failure_is_told_there(self):
        case = "tests/golden/shared/fault_of_active_expected/mission.yaml"
        self.open(solve("late-fault", case))
        self.assertEqual(self.number(), 2)
        detail = self.text("#detail-body")
        self.assertIn("LOCALIZE", self.text("#detail-body table.differences"))
        self.assertIn("the fault takes effect at its next activation", detail)

    def test_events_that_change_nothing_say_why(self):
        mission = write("quiet.mission.yaml", {"events": [
            {"start": "HOVER"}, {"start": "HOVER"}, {"fault": "FOLLOW_PATH_WITH_PID_CONTROL"},
            {"finish": "FOLLOW_PATH_WITH_PID_CONTROL"}]})
        made = solve("quiet", QUADROTOR, mission)
        self.open(made)
        hover = self.run_of(made)["events"][0]["running"]["HOVER"]
        texts = []
        for _ in range(4):
            texts.append(self.text("#detail-body"))
            self.browser.key("ArrowRight")
        self.assertIn(f"{hover} goes on performing HOVER", texts[1])
        self.assertIn("FOLLOW_PATH_WITH_PID_CONTROL is faulty: it cannot be activated", texts[2])
        self.assertIn("FOLLOW_PATH_WITH_PID_CONTROL is not active: nothing performs FOLLOW_PATH", texts[3])

    def test_heads_of_changes_fit(self):
        self.browser.click(*self.mark(6))
        heads = self.browser.ask("[...document.querySelectorAll('.changes th')]"
                                 ".map((one) => [one.textContent, one.scrollWidth - one.clientWidth, one.clientHeight])")
        self.assertEqual(heads[0][0], "priority")
        for name, excess, height in heads:
            with self.subTest(head=name):
                self.assertLessEqual(excess, 0)
                self.assertLess(height, 30)  # one line

    def test_chosen_event_of_a_long_run_is_in_view(self):
        self.open(solve("far", QUADROTOR, long_script(5000)))
        choose = random.Random(7)
        size = self.browser.ask("page.run.size")
        self.assertGreaterEqual(size, 5000)
        for _ in range(50):
            number = choose.randint(1, size)
            self.browser.ask(f"page.choose({number})")
            for _ in range(8):
                self.browser.settle()
            top, bottom, head, low = self.browser.ask(
                "(() => { const row = document.querySelector('#events tr[aria-current]').getBoundingClientRect(),"
                "head = document.querySelector('#events thead').getBoundingClientRect(),"
                "view = document.querySelector('#log-scroll').getBoundingClientRect();"
                "return [row.top, row.bottom, head.bottom, view.bottom]; })()")
            with self.subTest(number=number):
                self.assertGreaterEqual(top, head - 1)
                self.assertLessEqual(bottom, low + 1)

    def test_paper_says_why_expectations_failed(self):
        self.open(solve("late-fault", "tests/golden/shared/fault_of_active_expected/mission.yaml"))
        self.browser.call("Emulation.setEmulatedMedia", media="print")
        self.browser.ask("dispatchEvent(new Event('beforeprint'))")
        printed = self.browser.ask("[...document.querySelectorAll('.for-print')].map((one) => one.innerText).join()")
        self.assertIn("Why not as expected", printed)
        self.assertIn("the fault takes effect at its next activation", printed)
        self.browser.ask("dispatchEvent(new Event('afterprint'))")
        self.browser.call("Emulation.setEmulatedMedia", media="")

    def test_cut_stories_say_so(self):
        self.browser.set_size(1300, 800)
        self.open(self.target)
        self.browser.ask("page.table.fillAll()")
        for _ in range(8):
            self.browser.settle()  # until the table no longer scrolls to the chosen row
        cut = "[...document.querySelectorAll('#events tbody tr:not([aria-current]) .story')].filter((one) =>" \
              " one.scrollHeight > one.clientHeight + 1)"
        self.assertGreater(self.browser.ask(f"{cut}.length"), 0)
        self.assertEqual(self.browser.ask(f"{cut}.filter((one) => getComputedStyle(one).webkitLineClamp !== '3').length"), 0)
        number = self.browser.ask(f"Number({cut}[0].closest('tr').dataset.event)")
        story = f"#events tr[data-event='{number}'] .story"
        self.browser.ask(f"document.querySelector(\"{story}\").scrollIntoView({{ block: 'center' }})")
        self.browser.settle()
        self.browser.move(*self.place(story))
        self.assertEqual(self.browser.ask(f"document.querySelector(\"{story}\").title"),
                         self.browser.ask(f"document.querySelector(\"{story}\").innerText"))
        self.focus(f"#events tr[data-event='{number}'] button")
        self.assertTrue(self.browser.ask(f"(({{ scrollHeight, clientHeight }}) => scrollHeight <= clientHeight + 1)"
                                         f"(document.querySelector(\"{story}\"))"))

    def test_counts_say_what_they_count(self):
        mission = write("counts.mission.yaml", {"events": [
            {"start": "HOVER"}, {"stop": "LAND"}, {"wait": 1},
            {"fault": "FOLLOW_PATH_WITH_PID_CONTROL"}, {"repair": "FOLLOW_PATH_WITH_PID_CONTROL"},
            {"situation": {"FOLLOW_PATH_WITH_PID_CONTROL": False}}, {"situation": {"FOLLOW_PATH_WITH_PID_CONTROL": True}}]})
        made = solve("counts", QUADROTOR, mission)
        self.open(made)
        outcomes = [event["outcome"] for event in self.run_of(made)["events"] if event["verb"] in ("start", "stop")]
        self.assertEqual(outcomes, ["accepted", "unchanged"])
        self.assertEqual(self.text("#counts"),
                         "7 events: 1 accepted, 0 rejected, 1 without effect, 2 situation changes, 1 fault, 1 repair, 1 wait")

    def test_placeholder_of_the_search_fits(self):
        for size in ((1600, 1250), (1280, 800), (390, 844)):
            self.browser.set_size(*size)
            self.browser.ask("document.querySelector('#more').setAttribute('aria-expanded', 'true')")
            self.browser.settle()
            room, text = self.browser.ask(
                "(() => { const one = document.querySelector('#search'), style = getComputedStyle(one),"
                "context = document.createElement('canvas').getContext('2d'); context.font = style.font;"
                "return [one.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) - 34,"  # the arrow of the list
                " context.measureText(one.placeholder).width]; })()")
            self.assertGreater(room, text)
        for word in ("tasks", "behaviors", "variables", "verbs"):
            self.assertIn(word, self.browser.ask("document.querySelector('#search').title"))

    def test_why_of_events_and_of_failed_expectations(self):
        fast = "<i>FAST</i>"
        catalog = write("why.yaml", {"behaviors": [
            {"behavior": fast, "task": "DRIVE", "suitability": 90, "requires": [{"task": "LOCALIZE"}]},
            {"behavior": "SLOW", "task": "DRIVE", "suitability": 80},
            {"behavior": "SLAM", "task": "LOCALIZE", "suitability": 70},
            {"behavior": "LAMP", "task": "LIGHT"}],
            "tasks": [{"task": "DRIVE"}, {"task": "LOCALIZE", "start_on_request": False}]})
        mission = write("why.mission.yaml", {"events": [
            {"start": "DRIVE"}, {"start": "LIGHT", "at": 5}, {"expect": {"running": {"DRIVE": fast}}}]})
        self.open(solve("why", catalog, mission, "--why", "DRIVE", "--alternatives", "2"))
        self.assertEqual(self.number(), 2)
        text = self.text("#detail-body")
        self.assertIn("decided at event 1 at 0.000 s (start DRIVE, priority 1) by the suitability", text)
        self.assertNotIn("instead of", text)  # the table has it
        self.assertIn("supporting tasks running0 of 1", text)
        rows = self.browser.ask("[...document.querySelectorAll('.differences tbody tr')]"
                                ".map((row) => [...row.cells].map((cell) => cell.textContent))")
        self.assertEqual(rows, [["DRIVE", "SLOW, 80 %", f"{fast}, 90 %"],
                                ["LOCALIZE", "does not run", "SLAM, 70 %"],
                                ["product of all that runs", "80 %", "63 %"]])
        self.browser.screenshot(OUT / "why.png")
        self.click("#detail-body button")
        self.assertEqual(self.number(), 1)
        text = self.text("#detail-body")
        for part in ("why DRIVE has SLOW", f"DRIVE: {fast}", "Requests come first"):
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

    def test_names_that_a_task_and_a_behavior_share(self):
        case = "tests/golden/shared/solve_same_names/"
        self.open(solve("same-names", case + "catalog.yaml", case + "script.yaml"))
        rows = [self.text(f"#events > tbody > tr:nth-child({number})") for number in range(1, 5)]
        self.assertIn("behavior LAND (LAND) takes the place of HOVER_WITH_PID (HOVER)", rows[1])
        self.assertIn("task LAND was started with priority 1; task LAND excludes HOVER", rows[1])
        self.assertIn("finish behavior LAND: goal achieved", rows[2])
        self.assertIn("behavior LAND stops (LAND)", rows[2])
        self.assertIn("fault behavior LAND", rows[3])
        self.open(self.target)

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
