"""The graph of the state on the page of `cbc solve --html`: where its nodes and edges are, and how much room it takes."""

import unittest

from page_case import OUT, QUADROTOR, ROOT, PageCase, solve, write

# What is wrong with what is drawn: pairs of nodes that overlap, and edges that pass nodes which are none of their ends.
# Told are also the edges and those that pass a layer.
FAULTS = """(() => {
  const svg = document.querySelector('#graph-body svg');
  const faults = [], counts = { edges: 0, long: 0 };
  if (svg === null || document.querySelector('#graph').hidden) return { faults, counts };
  const nodes = [...svg.querySelectorAll('.node')].map((node) => {
    const { e: x, f: y } = node.transform.baseVal.consolidate().matrix;
    const { width, height } = node.querySelector('rect').getBBox();
    return { task: node.querySelector('title').textContent.split(': ')[0], x, y, width, height };
  });
  nodes.forEach((one, place) => {
    for (const other of nodes.slice(place + 1)) {
      if (one.x < other.x + other.width && other.x < one.x + one.width &&
          one.y < other.y + other.height && other.y < one.y + one.height) faults.push([one.task, other.task]);
    }
  });
  const box = svg.viewBox.baseVal;
  for (const edge of svg.querySelectorAll('.edge')) {
    const [from, to] = edge.querySelector('title').textContent.split(' requires ');
    const length = edge.getTotalLength();
    ++counts.edges;
    if (edge.getAttribute('d').includes('L')) ++counts.long;
    for (let at = 0; at <= length; at += 4) {
      const { x, y } = edge.getPointAtLength(at);
      if (x < 0 || y < 0 || x > box.width || y > box.height) faults.push([from, to, 'leaves the picture']);
      for (const node of nodes) {
        const isEnd = node.task === from || node.task === to;
        if (!isEnd && x > node.x - 2 && x < node.x + node.width + 2 && y > node.y - 2 && y < node.y + node.height + 2) {
          faults.push([from, to, node.task]);
        }
      }
    }
    // Its ends are at the nodes that it names.
    [from, to].forEach((task, place) => {
      const { x, y } = edge.getPointAtLength(place * length), node = nodes.find((one) => one.task === task);
      if (x < node.x - 6 || x > node.x + node.width + 6 || y < node.y - 6 || y > node.y + node.height + 6) {
        faults.push([from, to, 'does not reach', task]);
      }
    });
  }
  return { faults, counts };
})()"""

ALL_EVENTS = """(() => {
  const faults = [], counts = { edges: 0, long: 0 };
  for (let number = 1; number <= page.run.size; ++number) {
    page.graph.show(page.run, number);
    const found = %s;
    faults.push(...found.faults.map((fault) => [number, ...fault]));
    for (const name of Object.keys(counts)) counts[name] += found.counts[name];
  }
  return { faults, counts };
})()""" % FAULTS


def chain_files():
    """Tasks of which each requires all that come after it."""
    names = [f"TASK_{letter}" for letter in "ABCDEF"]
    behaviors = [{"behavior": name.lower(), "task": name,
                  "requires": [{"task": other} for other in names[place + 1:]]}
                 for place, name in enumerate(names)]
    tasks = [{"task": name, "start_on_request": place in (0, 2)} for place, name in enumerate(names)]
    events = [{"start": names[0]}, {"start": names[2]}, {"stop": names[0]}, {"stop": names[2]}]
    return write("chain.yaml", {"tasks": tasks, "behaviors": behaviors}), write("chain.mission.yaml", {"events": events})


class Graph(PageCase):
    def check(self, made, long):
        """Returns how many edges pass a layer."""
        self.open(made)
        found = self.browser.ask(ALL_EVENTS)
        self.assertEqual(found["faults"], [])
        self.assertGreaterEqual(found["counts"]["long"], long)
        return found["counts"]

    def test_no_edge_passes_a_node_in_the_gallery(self):
        catalogs = sorted(ROOT.glob("catalogs/*.mission.yaml"))
        self.assertGreater(len(catalogs), 8)
        pages = [solve(f"graph-{path.name.split('.')[0]}", str(path).replace(".mission", ""), str(path))
                 for path in catalogs]
        for size in ((1600, 1250), (1000, 700), (390, 844)):
            self.browser.set_size(*size)
            edges = long = 0
            for made in pages:
                self.open(made)
                self.browser.ask("document.querySelector('#wants-graph').checked || page.onKey({ key: 'g', target: document.body,"
                                 " preventDefault() {} })")
                with self.subTest(size=size, page=made[0]):
                    found = self.browser.ask(ALL_EVENTS)
                    self.assertEqual(found["faults"], [])
                    edges += found["counts"]["edges"]
                    long += found["counts"]["long"]
            self.assertGreater(edges, 300)
            self.assertGreater(long, 20)

    def test_long_edges_have_lanes_of_their_own(self):
        made = solve("chain", *chain_files())
        self.check(made, 9)
        self.browser.ask("page.choose(1)")
        self.browser.screenshot(OUT / "chain.png")
        self.browser.set_size(1400, 2000)
        self.check(made, 9)

    def width(self):
        return self.browser.ask("document.querySelector('#graph').offsetWidth")

    def test_it_takes_the_width_it_needs(self):
        self.browser.set_size(1400, 900)
        mission = write("narrow-graph.mission.yaml", {"events": [
            {"start": "HOVER"}, {"stop": "HOVER"}, {"wait": 1}, {"start": "FOLLOW_PATH"}, {"start": "HOVER", "priority": 3}]})
        self.open(solve("narrow-graph", QUADROTOR, mission))
        stage = self.browser.ask("document.querySelector('#stage').clientWidth")
        one = self.width()
        self.assertGreater(one, 100)
        self.assertLess(one, stage / 4)
        chart = "document.querySelector('#chart').offsetWidth"
        self.assertGreater(self.browser.ask(chart), 0.7 * stage)
        self.browser.ask("page.choose(3)")  # nothing runs
        self.assertEqual(self.width(), 0)
        self.assertEqual(self.browser.ask(chart), stage)
        self.browser.ask("page.choose(4)")
        several = self.width()
        self.browser.ask("page.choose(1)")  # the timeline beside it does not move
        self.assertEqual(self.width(), several)
        picture, body = self.browser.ask("['#graph svg', '#graph-body'].map((one) =>"
                                         " document.querySelector(one).getBoundingClientRect().width)")
        self.assertLessEqual(picture, body)
        self.open(solve("large-graph", "catalogs/autoware.yaml", "catalogs/autoware.mission.yaml"))
        self.browser.ask("page.choose(12)")
        self.assertLessEqual(self.width(), 0.34 * stage + 1)


if __name__ == "__main__":
    unittest.main()
