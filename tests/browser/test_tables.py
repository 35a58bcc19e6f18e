"""The pages that are tables: of `cbc tune` and `cbc verify --effects`."""

import subprocess
import unittest

from chromium import Chromium
from page_case import AXE, OUT, PROGRAM, ROOT


def make(name, *arguments):
    page = OUT / (name + ".html")
    done = subprocess.run([PROGRAM, *arguments, "--html", str(page)], cwd=ROOT, stdout=subprocess.DEVNULL, check=False)
    assert done.returncode in (0, 1), done.returncode
    return page.as_uri()


class Tables(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        OUT.mkdir(parents=True, exist_ok=True)
        cls.browser = Chromium().__enter__()
        cls.addClassCleanup(cls.browser.close)
        cls.tune = make("tune", "tune", "docs/sonar.mission.yaml")
        cls.pages = [cls.tune, make("tune-states", "tune", "--all-states", "catalogs/px4.yaml"),
                     make("effects", "verify", "--effects", "catalogs/warehouse.yaml")]

    def load(self, url, width, scheme="light"):
        self.browser.set_size(width, 900)
        self.browser.set_scheme(scheme)
        self.browser.load(url)

    def test_axe_finds_nothing(self):
        for url in self.pages:
            for scheme in ("light", "dark"):
                with self.subTest(page=url, scheme=scheme):
                    self.load(url, 1400, scheme)
                    # Not by a script element, which the policy of the page forbids.
                    self.browser.ask(AXE.read_text() + ";0")
                    self.assertEqual(self.browser.ask(
                        "axe.run().then(({ violations }) => violations.map((one) =>"
                        " [one.id, one.nodes.map((node) => node.html + node.failureSummary)]))"), [])

    def test_phone_reaches_all_of_a_table(self):
        for url in self.pages:
            with self.subTest(page=url):
                self.load(url, 390)
                self.assertEqual(self.browser.ask("document.documentElement.scrollWidth"), 390)
                self.assertEqual(self.browser.ask(
                    "[...document.querySelectorAll('table')].filter((one) => {"
                    " one.scrollLeft = 10000; const last = [...one.rows[0].cells].at(-1).getBoundingClientRect();"
                    " return last.right > 390; }).length"), 0)

    def test_bars_are_where_the_numbers_are(self):
        self.load(self.tune, 1400)
        rows = self.browser.ask(
            "[...document.querySelectorAll('.tune tr')].slice(1).map((row) => {"
            " const [scale, same, dot] = ['.scale', '.same', '.value'].map((one) =>"
            "   row.querySelector(one).getBoundingClientRect());"
            " const at = (x) => (x - scale.left) / scale.width * 100;"
            " return [row.cells[2].textContent, row.cells[4].textContent, at(dot.left + dot.width / 2), at(same.left),"
            "   at(same.right)]; })")
        self.assertGreater(len(rows), 1)
        for value, same, dot, left, right in rows:
            low, high = (float(end) for end in same.split(" to "))
            self.assertAlmostEqual(dot, float(value), delta=0.5)
            self.assertAlmostEqual(left, low, delta=0.5)
            self.assertAlmostEqual(right, high, delta=0.5)
        self.browser.screenshot(OUT / "tune.png")


if __name__ == "__main__":
    unittest.main()
