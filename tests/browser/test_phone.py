"""The page of `cbc solve --html` on a phone: little room, and fingers."""

import unittest

from page_case import OUT, QUADROTOR, PageCase, long_script, solve, write


class Phone(PageCase):
    def emulate_phone(self):
        self.browser.call("Emulation.setDeviceMetricsOverride", width=390, height=844, deviceScaleFactor=2, mobile=True)
        self.browser.call("Emulation.setTouchEmulationEnabled", enabled=True)
        self.addCleanup(self.browser.call, "Emulation.setTouchEmulationEnabled", enabled=False)

    def test_phone_has_room_for_fingers(self):
        self.emulate_phone()
        self.open(solve("phone", QUADROTOR, "catalogs/quadrotor.mission.yaml", long_script(60)))
        self.assertTrue(self.browser.ask("matchMedia('(pointer: coarse)').matches"))
        self.click("#more")
        self.browser.ask("document.querySelectorAll('details').forEach((one) => (one.open = true))")
        self.browser.settle()
        small = self.browser.ask(
            "[...document.querySelectorAll('button, select, input:not([type=checkbox]), label, summary')]"
            ".map((one) => [one, one.getBoundingClientRect()]).filter(([, box]) => box.width > 0 && (box.height < 40 || box.width < 40))"
            ".map(([one, box]) => [one.id || one.textContent, box.width, box.height])")
        self.assertEqual(small, [])
        self.assertEqual(self.browser.ask("document.documentElement.scrollWidth"), 390)
        self.browser.screenshot(OUT / "fingers.png")

    def test_phone_shows_all_of_the_table(self):
        self.emulate_phone()
        self.open(solve("phone", QUADROTOR, "catalogs/quadrotor.mission.yaml", long_script(60)))
        self.browser.ask("document.querySelector('#log').scrollIntoView()")
        self.browser.settle()
        cells = self.browser.ask("[...document.querySelectorAll('#events > tbody > tr')].slice(0, 5).map((row) =>"
                                 " [...row.cells].map((cell) => [cell.getBoundingClientRect(), cell.innerText])"
                                 ".map(([box, text]) => [box.left, box.right, box.width, text]))")
        self.assertEqual(len(cells), 5)
        for row, event in zip(cells, self.run_of(self.quadrotor)["events"]):
            self.assertEqual(len(row), 5)
            self.assertIn(event["verb"], row[2][3])
            for left, right, width, text in row:
                self.assertGreaterEqual(left, 0)
                self.assertLessEqual(right, 390)
                if text:
                    self.assertGreater(width, 20)
            self.assertGreater(row[4][2], 200)  # what happened, and why
        self.assertEqual(self.browser.ask("['#log-scroll', '#dock', 'body'].map((one) => document.querySelector(one))"
                                          ".filter((one) => one.scrollWidth > one.clientWidth).length"), 0)
        self.browser.screenshot(OUT / "phone-table.png")

    def test_phone(self):
        self.browser.set_size(390, 844)
        names = [f"ROTATE_WITH_{kind}_MOTION_CONTROL" for kind in ("PID", "MPC", "GEOMETRIC")]
        catalog = write("alike.yaml", {"behaviors": [
            {"behavior": name, "task": "ROTATE", "suitability": 90 - place} for place, name in enumerate(names)]})
        mission = write("alike.mission.yaml", {"events": [
            {"start": "ROTATE"}, {"situation": {names[0]: False}}, {"situation": {names[1]: False}},
            {"start": "ROTATE"}, {"expect": {"stopped": ["ROTATE"]}}]})
        other = write("other-alike.mission.yaml", {"events": [{"start": "ROTATE"}]})
        self.open(solve("alike", catalog, mission, other))
        self.browser.ask("document.querySelector('#all-rows').click()")
        self.browser.settle()
        shown = self.browser.ask("[...document.querySelectorAll('#labels .behavior')].map((one) => one.textContent)")
        self.assertEqual(len(shown), 3)
        self.assertEqual(len(set(shown)), 3, shown)
        for text, kind in zip(sorted(shown), sorted(["PID", "MPC", "GEOMETRIC"])):
            self.assertIn(kind[:3], text)
        self.assertRegex(self.status(), r"^Event \d+ of \d+ ! ")
        self.browser.screenshot(OUT / "alike.png")
        self.browser.ask("document.querySelector('#overview').open = true")
        widths = self.browser.ask("[document.querySelector('#missions').scrollWidth,"
                                  " document.querySelector('#overview .scroll').clientWidth]")
        self.assertLessEqual(widths[0], widths[1])


if __name__ == "__main__":
    unittest.main()
