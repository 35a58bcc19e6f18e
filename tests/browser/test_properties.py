"""The page of `cbc verify --html`: all properties, with a timeline of those that have a script."""

import json
import subprocess
import unittest

from page_case import AXE, OUT, PROGRAM, ROOT, PageCase, write

CELLS = "[...document.querySelectorAll('#missions tbody tr')].map((row) => [...row.cells].map((cell) => cell.innerText))"


class Properties(PageCase):
    def verify(self, name, properties, *arguments, catalog="catalogs/warehouse.yaml"):
        """Opens the page of some properties. Returns what JSON says of them."""
        page = OUT / f"{name}.html"
        file = write(f"{name}.properties.yaml", {"catalog": str(ROOT / catalog), "properties": properties})
        result = subprocess.run([PROGRAM, "verify", file, "--html", str(page), "--format", "json", *arguments],
                                cwd=ROOT, stdout=subprocess.PIPE, check=False)
        self.assertIn(result.returncode, (0, 1))
        self.url = page.as_uri()
        self.browser.load(self.url)
        return json.loads(result.stdout)["properties"]

    def test_what_breaks_a_property_is_shown_at_its_end(self):
        self.verify("broken", [{"never": {"active_includes": ["SONAR_GUARD"]}}])
        self.assertGreater(self.browser.ask("page.run.size"), 1)
        self.assertEqual(self.number(), self.browser.ask("page.run.size"))
        self.assertIn("SONAR_GUARD", self.text("#state-body"))

    def test_violated_properties_are_not_told_as_passed(self):
        answers = self.verify("violated", [{"reachable": {"active_includes": ["SONAR_GUARD"]}},
                                           {"never": {"active_includes": ["SONAR_GUARD"]}},
                                           {"always": {"stopped": ["NAVIGATE"]}, "name": "it stays"}])
        self.assertEqual([one["result"] for one in answers], ["proved", "violated", "violated"])
        self.assertIn("3 properties: 2 violated, 1 proved", self.text("#overview-summary"))
        cells = "[...document.querySelectorAll('#missions tbody tr')].map((row) => [row.cells[1].textContent," \
                "getComputedStyle(row.cells[1]).color === getComputedStyle(document.querySelector('.alarm')).color])"
        self.assertEqual(self.browser.ask(cells), [["\u2713 proved after 2 events", False], ["\u00d7 violated after 2 events", True],
                                                   ["\u00d7 violated after 1 event", True]])
        # It opens at the first violated one, and says what that is.
        self.assertEqual(self.browser.ask("page.place"), 1)
        self.assertIn("SONAR_GUARD", self.text("#alarms .alarm"))
        self.assertEqual(self.browser.ask("document.title[0]"), "\u00d7")
        self.assertTrue(self.browser.ask("document.title").endswith("cbc verify"))
        self.choose_run(2)
        self.assertIn("NAVIGATE", self.text("#alarms .alarm"))  # what it states, not only its name
        self.choose_run(0)
        self.assertTrue(self.browser.ask("document.querySelector('#alarms').hidden"))

    def test_properties_without_a_script_are_listed(self):
        answers = self.verify("all-properties", [
            {"never": {"running": ["FETCH_SHELF"], "active_includes": ["SONAR_GUARD"]}, "name": "no sonar there"},
            {"never": {"active_includes": ["SONAR_GUARD"]}},
            {"reachable": {"running": ["FETCH_SHELF"], "active_includes": ["SONAR_GUARD"]}, "name": "sonar there"},
            {"reachable": {"running": ["CHARGE"]}}])
        rows = self.browser.ask(CELLS)
        self.assertEqual(len(rows), len(answers))
        for row, answer in zip(rows, answers):
            self.assertIn(f"{answer['line']}: ", row[0])
            self.assertEqual(row[1].split()[1], answer["result"])
            self.assertEqual(len(row), 2 if answer["script"] is None else 6)
        self.assertEqual([(answer["result"], answer["script"] is None) for answer in answers],
                         [("proved", True), ("violated", False), ("violated", True), ("proved", False)])
        self.assertIn("there is none among", rows[2][1])
        self.assertIn("SONAR_GUARD", rows[0][0])  # what it states, beside its name
        self.choose_run(1)
        self.assertIn("SONAR_GUARD", self.text("#state-body"))
        self.click("#missions tbody tr:nth-child(3) td:nth-child(2)")  # leads nowhere
        self.assertIn("SONAR_GUARD", self.text("#state-body"))
        self.click("#missions tbody tr:nth-child(4) button")
        self.assertIn("CHARGE", self.text("#state-body"))
        self.browser.screenshot(OUT / "properties.png")

    def test_none_has_a_script(self):
        answers = self.verify("proved", [
            {"never": {"running": ["FETCH_SHELF"], "active_includes": ["SONAR_GUARD"]}, "name": "no sonar there"},
            {"always_possible": {"stopped": ["FETCH_SHELF"]}}])
        self.assertEqual([(one["result"], one["script"]) for one in answers], [("proved", None)] * 2)
        (name, verdict), (_, of_states) = self.browser.ask(CELLS)
        self.assertIn("no sonar there", name)
        self.assertIn("FETCH_SHELF", name)  # what it states
        self.assertEqual(verdict, "\u2713 proved by the constraints alone, without any state")
        self.assertRegex(of_states, "^\u2713 proved for \\d+ reachable states$")
        self.assertEqual(self.text("#overview-summary"), "2 properties: 2 proved")
        for hidden in ("#stage", "#dock", ".controls"):
            self.assertEqual(self.browser.ask(f"document.querySelector('{hidden}').offsetHeight"), 0)
        self.browser.screenshot(OUT / "proved.png")
        if AXE.exists():
            self.assert_no_findings_of_axe("proved")

    def test_undecided_properties_say_how_far_it_came(self):
        answers = self.verify("undecided", [{"always_possible": {"stopped": ["FETCH_SHELF"]}}], "--max-states", "5")
        self.assertEqual([one["result"] for one in answers], ["undecided"])
        (_, verdict), = self.browser.ask(CELLS)
        self.assertTrue(verdict.startswith("? undecided ended by --max-states 5"), verdict)
        self.assertEqual(self.text("#overview-summary"), "1 property: 1 undecided")
        self.assertEqual(self.browser.ask("document.querySelector('#overview-summary').className"), "failed")


if __name__ == "__main__":
    unittest.main()
