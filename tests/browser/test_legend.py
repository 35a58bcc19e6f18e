"""The legend of the page of `cbc solve --html`: it explains the signs that occur, and no others."""

import unittest

from page_case import OUT, QUADROTOR, PageCase, long_script, solve, write

SITUATIONS = "tests/golden/shared/graph_situation/catalog.yaml"


class Legend(PageCase):
    def items(self):
        return self.browser.ask("[...document.querySelectorAll('#legend span')].map((one) => one.lastChild.textContent)")

    def legend_of(self, name, catalog, events, **script):
        self.open(solve(name, catalog, write(f"{name}.mission.yaml", {"events": events, **script})))
        return self.items()

    def test_it_has_what_occurs_and_no_more(self):
        few = self.legend_of("legend-few", QUADROTOR, [{"start": "HOVER"}])
        self.assertIn("active: its task is requested", few)
        self.assertIn("accepted", few)
        self.assertIn("end of the mission", few)
        for absent in ("rejected", "faulty", "unavailable", "fit the situation", "window", "folded", "waits",
                       "gives way", "expectation", "situation variable", "stopped by", "time out", "after the number"):
            self.assertFalse([item for item in few if absent in item], absent)
        many = self.items_of_target()
        for present in ("rejected", "goal achieved", "finished: situation change", "replaced in the same task"):
            self.assertIn(present, " / ".join(many))
        self.assertGreater(len(many), len(few))

    def items_of_target(self):
        self.open(self.target)
        return self.items()

    def test_why_behaviors_cannot_be_activated(self):
        events = [{"start": "TAKE_OFF"}, {"situation": {"PID_CONTROL": False}}]
        once = self.legend_of("legend-off", SITUATIONS, events)
        self.assertIn("unavailable: cannot be activated", once)
        self.assertIn("does not fit the situation: cannot be activated", once)
        self.assertNotIn("faulty: cannot be activated", once)
        all_of_them = self.legend_of("legend-all-off", SITUATIONS, events + [{"fault": "RECOGNIZE_FAR"}])
        self.assertIn("faulty: cannot be activated", all_of_them)
        fills = self.browser.ask("[...document.querySelectorAll('#legend span')].filter((one) =>"
                                 " one.textContent.includes('cannot be activated')).map((one) => {"
                                 " const name = one.querySelector('rect.unavailable, rect.misfit, rect.faulty').getAttribute('fill');"
                                 " return one.querySelector(name.slice(4, -1) + ' path').getAttribute('d') +"
                                 " one.querySelector(name.slice(4, -1) + ' path').getAttribute('stroke'); })")
        self.assertEqual(len(set(fills)), 3)
        # They look the same in the rows.
        self.browser.ask("document.querySelector('#all-rows').click()")
        self.browser.settle()
        for look in ("unavailable", "misfit", "faulty"):
            self.assertGreater(self.drawn(look), 0, look)

    def test_signs_of_the_graph(self):
        self.open(self.target)
        self.assertTrue(self.browser.ask("document.querySelector('#wants-graph').checked"))
        # Each class that the graph of any event uses is in the legend, and no other.
        used = set(self.browser.ask("(() => { const used = new Set(); for (let number = 1; number <= page.run.size; ++number) {"
                                    " page.choose(number);"
                                    " for (const one of document.querySelectorAll('#graph .node, #graph .edge'))"
                                    " for (const name of one.classList) used.add(name); } return [...used]; })()"))
        told = set(self.browser.ask("[...document.querySelectorAll('#legend .node, #legend .edge')]"
                                    ".flatMap((one) => [...one.classList])"))
        self.assertEqual(told, used)
        self.assertIn("replaced", used)
        self.assertIn("requires", self.items())
        self.browser.key("g")
        self.assertNotIn("requires", self.items())
        self.assertEqual(self.browser.ask("document.querySelectorAll('#legend .node').length"), 0)

    def test_minimap_and_folds(self):
        self.open(solve("folded", QUADROTOR, long_script(210)))
        for name in ("folded: zoom in, or click", "the whole run; in the window what is in view, if zoomed in"):
            self.assertIn(name, self.items())
        for _ in range(6):
            self.click("#zoom-in")  # it does not change while one zooms
        self.assertIn("folded: zoom in, or click", self.items())
        self.browser.screenshot(OUT / "legend.png")

    def test_fault_of_an_active_behavior(self):
        self.legend_of("active", QUADROTOR, [{"start": "HOVER"}])
        behavior = self.browser.ask("page.run.running(1).HOVER")
        items = self.legend_of("active-fault", QUADROTOR, [
            {"start": "HOVER"}, {"wait": 2}, {"fault": behavior}, {"wait": 2}, {"repair": behavior}, {"wait": 2}])
        self.assertIn("fault of an active behavior, which goes on", items)
        self.assertEqual(self.drawn("faulty-bar"), 1)
        # It is on the bar, from the fault to the repair.
        x, width = self.browser.ask("(() => { const one = page.timeline.toSvg().querySelector('.faulty-bar');"
                                    " return ['x', 'width'].map((name) => Number(one.getAttribute(name))); })()")
        fault, repair = self.browser.ask("[3, 5].map((number) => page.timeline.view.xs[number])")
        self.assertAlmostEqual(x, fault, delta=1)
        self.assertAlmostEqual(x + width, repair, delta=1)
        signs = self.browser.ask("[...page.timeline.toSvg().querySelectorAll('path.glyph-bad')]"
                                 ".filter((one) => one.getAttribute('d') === glyphs.fault)"
                                 ".map((one) => one.getAttribute('transform'))")
        self.assertEqual(len(signs), 1)
        self.assertAlmostEqual(float(signs[0].split("(")[1].split()[0]), fault, delta=7)
        self.browser.screenshot(OUT / "active-fault.png")
        self.assertNotIn("fault of an active behavior, which goes on", self.items_of_target())


if __name__ == "__main__":
    unittest.main()
