"""The model of a question that all peers get, and how it is written for each of them.

A model has only the tasks that the best solution may need. It knows no minimum performances and no
behaviors of several tasks, and nothing decides between solutions that are equal down to f4. Costs are
logarithms of suitabilities, as integers.
"""

import math

SCALE = 10**6  # of logarithms


class Model:
    def __init__(self, question):
        catalog = question.catalog
        self.question = question
        self.tasks = sorted(question.may_run(*question.roots()), key=lambda x: (-catalog.level[x], x))
        inside = set(self.tasks)
        self.values = {x: [v for v in question.domains[x] if v] for x in self.tasks}
        self.forced = question.forced()
        self.droppable = question.droppable()
        self.roots = question.roots()
        self.requires = [(x, v, t) for x in self.tasks for v in self.values[x]
                         for t, _ in catalog.requires[catalog.names[x][v]]]
        lists = {tuple(t for t in tasks if t in inside) for tasks in catalog.exclusive}
        self.exclusive = sorted(tasks for tasks in lists if len(tasks) > 1)
        self.not_on_request = [x for x in self.tasks if not catalog.on_request[x]]
        # By level above the first: the tasks whose stop takes it, from the lowest.
        self.escalation = {}
        if question.escalates:
            for x in self.droppable:
                level = question.protectable.get(x, 0)
                if level > question.first_level:
                    self.escalation.setdefault(level, []).append(x)
        self.levels = sorted(self.escalation)

    def cost(self, x, v):
        return round(-math.log(self.question.catalog.suitability[x][v]) * SCALE) if v else 0

    def changes(self, x, v):
        present = self.question.present[x]
        return 0 if v == present else int(v > 0) + int(present > 0)

    def all_values(self, chosen):
        """The values of all tasks of the catalog, from those of the tasks that run."""
        return [chosen.get(x, 0) for x in range(len(self.question.domains))]


def answer_set_program(model):
    """For gringo: what is not requested runs only if something requires it."""
    lines = [f"r({x})." for x in model.forced]
    forced = set(model.forced)
    lines += [f"{{r({x})}}." for x in model.roots if x not in forced]
    for x in model.tasks:
        values = "; ".join(f"b({x},{v})" for v in model.values[x])
        lines.append(f"1 {{{values}}} 1 :- r({x})." if values else f":- r({x}).")
    lines += [f"r({t}) :- b({x},{v})." for x, v, t in model.requires]
    lines += [":- 2 {" + "; ".join(f"r({x})" for x in tasks) + "}." for tasks in model.exclusive]
    last = model.question.first_level
    for i, level in enumerate(model.levels):
        lines += [f"level({level}) :- not r({x})." for x in model.escalation[level]]
        if i:
            lines.append(f"level({model.levels[i - 1]}) :- level({level}).")
        lines.append(f":~ level({level}). [{level - last}@99,{level}]")
        last = level
    count = len(model.droppable)
    lines += [f":~ not r({x}). [1@98,{x}]" for x in model.droppable]
    for i, x in enumerate(model.droppable if count > 1 else []):
        # Weights have 32 bits.
        lines.append(f":~ not r({x}). [{1 << (count - 1 - i) % 30}@{10 + (count - 1 - i) // 30},{x}]")
    for x in model.tasks:
        lines += [f":~ b({x},{v}). [{model.cost(x, v)}@3,{x}]" for v in model.values[x]
                  if model.cost(x, v)]
    lines += [f":~ r({x}). [1@2,{x}]" for x in model.not_on_request]
    for x in model.tasks:
        present = model.question.present[x]
        lines += [f":~ b({x},{v}). [1@1,{x},1]" for v in model.values[x] if v != present]
        if present:
            kept = f"not b({x},{present})" if present in model.values[x] else ""
            lines += [f":~ {kept}. [1@1,{x},0]"] if kept else []
    lines.append("#show b/2.")
    return "\n".join(lines) + "\n"


class Weighted:
    """A weighted CSP for toulbar2, with one value for each task, and the level as another variable.

    All objectives are one sum where this fits into its numbers. Otherwise there are two problems: the
    first has only the escalation and f1, and the second only solutions that are best in that.
    """

    TOP = 10**17
    SCALE = 10**5

    def __init__(self, model):
        self.model = model
        self.variable = {x: i for i, x in enumerate(model.tasks)}
        self.domain = {x: [0] + model.values[x] for x in model.tasks}
        count = len(model.tasks) + 1
        self.forced = set(model.forced)
        self.change_weight = 1
        self.idle_weight = 2 * count
        self.cost_weight = self.idle_weight * count
        worst = sum(max([model.cost(x, v) for v in model.values[x]], default=0) for x in model.tasks)
        self.request_weight = self.cost_weight * (worst * self.SCALE // SCALE + count + 1)
        drops = len(model.droppable)
        self.drop = {x: (1 << drops) + (1 << (drops - 1 - i)) for i, x in enumerate(model.droppable)}
        total = sum(self.drop.values())
        self.level_weight = total + 1
        rise = model.levels[-1] - model.question.first_level if model.levels else 0
        self.fits_one = (total + self.level_weight * rise) * self.request_weight < self.TOP

    def stages(self):
        return ["all"] if self.fits_one or not self.model.droppable else ["requests", "rest"]

    def text(self, stage, served=None, level=None):
        """The file; in the stage "rest" the droppable tasks that are served and the level are given."""
        model = self.model
        names = [len(self.domain[x]) for x in model.tasks]
        functions = []
        if model.levels:
            self.add_level(functions, stage, level)
            names.append(len(model.levels) + 1)
        for x in model.tasks:
            costs = [self.unary(stage, x, v, served) for v in self.domain[x]]
            functions.append(([self.variable[x]], [((i,), c) for i, c in enumerate(costs) if c]))
        self.add_constraints(functions)
        lines = [f"question {len(names)} {max(names)} {len(functions)} {self.TOP}",
                 " ".join(str(n) for n in names)]
        for scope, tuples in functions:
            lines.append(" ".join(map(str, [len(scope), *scope, 0, len(tuples)])))
            lines += [" ".join(map(str, [*places, cost])) for places, cost in tuples]
        return "\n".join(lines) + "\n"

    def with_contradiction(self, text):
        """The same with one more cost function, which rules out everything."""
        first, rest = text.split("\n", 1)
        *head, count, top = first.split()
        return f"{' '.join(head)} {int(count) + 1} {top}\n{rest}0 {self.TOP} 0\n"

    def values(self, places):
        """Of all tasks, from the solution that toulbar2 writes."""
        return self.model.all_values({x: self.domain[x][int(place)]
                                      for x, place in zip(self.model.tasks, places)})

    def unary(self, stage, x, v, served):
        if v == 0 and x in self.forced:
            return self.TOP
        if served is not None and x in self.drop and (v > 0) != (x in served):
            return self.TOP
        cost = 0
        if stage != "rest" and v == 0:
            cost += self.drop.get(x, 0) * (self.request_weight if stage == "all" else 1)
        if stage != "requests":
            idle = int(v > 0 and not self.model.question.catalog.on_request[x])
            cost += self.cost_weight * round(self.model.cost(x, v) * self.SCALE / SCALE)
            cost += self.idle_weight * idle + self.change_weight * self.model.changes(x, v)
        return cost

    def add_level(self, functions, stage, level):
        model = self.model
        variable = len(model.tasks)
        levels = [model.question.first_level, *model.levels]
        weight = self.level_weight * (self.request_weight if stage == "all" else 1)
        costs = [weight * (one - levels[0]) if level is None else 0 if one == level else self.TOP
                 for one in levels]
        functions.append(([variable], [((i,), c) for i, c in enumerate(costs) if c]))
        for i, one in enumerate(levels[1:], 1):
            for x in model.escalation[one]:
                functions.append(([self.variable[x], variable], [((0, j), self.TOP) for j in range(i)]))

    def add_constraints(self, functions):
        pairs = {}
        for x, v, t in self.model.requires:
            key = (self.variable[x], self.variable[t])
            pairs.setdefault(key, set()).add((self.domain[x].index(v), 0))
        for tasks in self.model.exclusive:
            for i, x in enumerate(tasks):
                for y in tasks[i + 1:]:
                    key = (self.variable[x], self.variable[y])
                    if (key[1], key[0]) in pairs:
                        key, x, y = (key[1], key[0]), y, x
                    pairs.setdefault(key, set()).update(
                        (a, b) for a in range(1, len(self.domain[x]))
                        for b in range(1, len(self.domain[y])))
        for scope, tuples in pairs.items():
            functions.append((list(scope), [(places, self.TOP) for places in sorted(tuples)]))


def numbers_for_gecode(model):
    """What gecode_peer.cpp reads: tasks in an order from the highest level, by place."""
    place = {x: i for i, x in enumerate(model.tasks)}
    forced, roots = set(model.forced), set(model.roots)
    rows = [[len(model.tasks)]]
    for x in model.tasks:
        rows.append([int(x in forced), int(x in roots),
                     int(not model.question.catalog.on_request[x]), model.changes(x, 0),
                     len(model.values[x])])
        for v in model.values[x]:
            needed = [place[t] for a, b, t in model.requires if a == x and b == v]
            rows.append([round(model.cost(x, v) / 10), model.changes(x, v), len(needed), *needed])
    rows.append([len(model.exclusive)])
    rows += [[len(tasks), *(place[x] for x in tasks)] for tasks in model.exclusive]
    rows.append([len(model.droppable)])
    first = model.question.first_level
    for x in model.droppable:
        rows.append([place[x], max(model.question.protectable.get(x, 0) - first, 0)
                     if model.question.escalates else 0])
    return "\n".join(" ".join(map(str, row)) for row in rows) + "\n"
