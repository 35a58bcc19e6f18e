"""The question that an event asks, for solvers that know nothing of catalogs, and the value of an answer.

The reading of docs/semantics.md here is its own: nothing is taken from the program but its dump of a
catalog and the states that it saves. A catalog counts as one group. Timeouts, reactive starts,
situations and faults are no questions of their own.

Tasks are numbers in catalog order. Value 0 of a task: it does not run; from 1: its behaviors, the
most suitable first.
"""

from fractions import Fraction
import json


class Catalog:
    """What `cbc compile --dump` says of a catalog."""

    def __init__(self, dump):
        data = json.loads(dump, parse_float=Fraction)
        tasks = [task for group in data["groups"] for task in group["tasks"]]
        behaviors = {b["behavior"]: b for group in data["groups"] for b in group["behaviors"]}
        self.tasks = [task["task"] for task in tasks]
        self.number = {name: i for i, name in enumerate(self.tasks)}
        self.on_request = [task["start_on_request"] for task in tasks]
        self.level = [task["level"] for task in tasks]
        self.minimum = [percent(task["minimum_performance"]) for task in tasks]
        self.names = [[None] + [b["behavior"] for b in task["behaviors"]] for task in tasks]
        self.suitability = [[Fraction(1)] + [percent(b["suitability"]) for b in task["behaviors"]]
                            for task in tasks]
        self.requires = {name: [(self.number[r["task"]], percent(r["minimum_performance"]))
                                for r in b["requires"]] for name, b in behaviors.items()}
        self.situation = {name: b["situation"] for name, b in behaviors.items()}
        self.exclusive = [[self.number[t] for t in e["tasks"]]
                          for group in data["groups"] for e in group["exclusivity"]]

    def values(self, running):
        """The values of all tasks, from a mapping of running tasks to behaviors."""
        return [self.names[x].index(running.get(name)) for x, name in enumerate(self.tasks)]

    def is_plain(self):
        """Whether there are no minimums, and each behavior performs one task: what the models know."""
        behaviors = [name for names in self.names for name in names[1:]]
        return (len(set(behaviors)) == len(behaviors) and not any(self.minimum) and
                not any(k for needed in self.requires.values() for _, k in needed))


def percent(number):
    return Fraction(0 if number is None else number) / 100


class Request:
    def __init__(self, task, priority, event):
        self.task, self.priority, self.event = task, priority, event


class Question:
    """An event in a state: the domains of all tasks, and what decides between solutions.

    `domains`: of each task its values. `first_level` is the first protection level. Until there is a
    solution it goes up where `escalates`. `protectable`: running tasks that must go on, and the
    priorities of their requests; a level protects those of higher ones. `requests`: tasks with an
    active request, the most important first. `present`: the values before the event; 0 for what has
    finished.
    """

    def __init__(self, catalog, state, event):
        self.catalog = catalog
        self.state = state
        running = {one["task"]: one["behavior"] for one in state["running"]}
        requests = {catalog.number[one["task"]]: one["request"] for one in state["running"]
                    if one["request"] is not None}
        self.requested = {x: r["priority"] for x, r in requests.items()}
        self.present = catalog.values(running)
        self.escalates = "finish" in event
        self.decided = None  # the outcome, where no search is needed
        self.domains = [[0] + self.selectable(x) if self.present[x] or not catalog.on_request[x] else [0]
                        for x in range(len(catalog.tasks))]
        own = self.read_event(event)
        self.protectable = {x: p for x, p in self.requested.items() if x not in own}
        active = [Request(x, r["priority"], r["event"]) for x, r in requests.items()
                  if x not in own or self.keeps_requests]
        if "start" in event:
            active.append(Request(own[0], self.first_level, state["events"] + 1))
        active.sort(key=lambda r: (-r.priority, -r.event))
        self.requests = [r.task for r in active]

    def read_event(self, event):
        """Fixes the domains of the tasks of the event, and returns these."""
        catalog = self.catalog
        self.keeps_requests = False
        if "finish" in event:
            return self.read_finish(event["finish"], event.get("cause", "goal_achieved"))
        verb = "start" if "start" in event else "stop"
        x = catalog.number[event[verb]]
        present = self.requested.get(x, 0)
        self.first_level = event.get("priority", 1 if verb == "start" else present)
        if verb == "stop" and not self.present[x]:
            self.decided = "unchanged"
        elif present > self.first_level:
            self.decided = "rejected"
        self.domains[x] = self.selectable(x) if verb == "start" else [0]
        return [x]

    def read_finish(self, behavior, cause):
        own = [x for x, value in enumerate(self.present)
               if value and self.catalog.names[x][value] == behavior]
        self.first_level = max((self.requested.get(x, 0) for x in own), default=0)
        if not own:
            self.decided = "unchanged"
        for x in own:
            self.present[x] = 0
        self.keeps_requests = cause != "goal_achieved"
        for x in own:
            self.domains[x] = [0] + self.selectable(x) if self.keeps_requests else [0]
        if cause not in ("goal_achieved", "situation_change"):
            for x, names in enumerate(self.catalog.names):
                self.domains[x] = [v for v in self.domains[x] if names[v] != behavior]
        return own

    def selectable(self, x):
        names = self.catalog.names[x]
        return [v for v in range(1, len(names)) if self.fits(names[v]) and
                (v == self.present[x] or names[v] not in self.state["unavailable"])]

    def fits(self, behavior):
        variables = self.state.get("variables", {})
        return all(variables[name] in (values if isinstance(values, list) else [values])
                   for name, values in self.catalog.situation[behavior].items())

    def droppable(self):
        """Tasks whose requests a solution may leave unserved, the most important first."""
        return [x for x in self.requests if 0 in self.domains[x] and
                (self.escalates or self.protectable.get(x, 0) <= self.first_level)]

    def forced(self):
        """Tasks that run in any solution."""
        return [x for x in range(len(self.domains)) if 0 not in self.domains[x] or
                (not self.escalates and self.protectable.get(x, 0) > self.first_level)]

    def may_run(self, *roots):
        """What the tasks may need, these included: nothing else runs in the best solution, as it
        would lower f2 or f3."""
        found, todo = set(), list(roots)
        while todo:
            x = todo.pop()
            if x in found:
                continue
            found.add(x)
            for v in self.domains[x]:
                if v:
                    todo += [t for t, _ in self.catalog.requires[self.catalog.names[x][v]]]
        return found

    def roots(self):
        """Tasks that may run though nothing requires them."""
        going_on = [x for x, v in enumerate(self.present) if v and self.catalog.on_request[x]]
        return sorted({*self.forced(), *self.droppable(), *going_on})

    def evaluate(self, values):
        """The value of a solution, the larger the better; None if it is not one."""
        catalog = self.catalog
        if any(v not in domain for v, domain in zip(values, self.domains)):
            return None
        if any(sum(values[x] > 0 for x in tasks) > 1 for tasks in catalog.exclusive):
            return None
        if not self.meets_requirements(values):
            return None
        level = max([p for x, p in self.protectable.items() if not values[x]], default=0)
        if level > self.first_level and not self.escalates:
            return None
        return Value(self, values, max(level, self.first_level))

    def meets_requirements(self, values):
        catalog, below = self.catalog, {}

        def needs(x):
            if x not in below:
                direct = [t for t, _ in catalog.requires[catalog.names[x][values[x]]]]
                below[x] = set(direct).union(*(needs(t) for t in direct))
            return below[x]

        def performance(x):
            product = catalog.suitability[x][values[x]]
            for y in needs(x):
                product *= catalog.suitability[y][values[y]]
            return product

        running = [x for x, v in enumerate(values) if v]
        needed = [one for x in running for one in catalog.requires[catalog.names[x][values[x]]]]
        if not all(values[t] for t, _ in needed):
            return False
        minimums = [(x, catalog.minimum[x]) for x in running] + needed
        return all(k == 0 or performance(t) >= k for t, k in minimums)


class Value:
    """What decides between solutions, down to f4: the level, the requests served, f2, f3 and f4."""

    def __init__(self, question, values, level):
        catalog = question.catalog
        self.level = level
        self.served = [int(values[x] > 0) for x in question.requests]
        self.suitability = Fraction(1)
        for x, v in enumerate(values):
            self.suitability *= catalog.suitability[x][v]
        self.idle_tasks = sum(not on_request for on_request in catalog.on_request)
        self.idle_running = sum(v > 0 and not catalog.on_request[x] for x, v in enumerate(values))
        before = {catalog.names[x][v] for x, v in enumerate(question.present) if v}
        after = {catalog.names[x][v] for x, v in enumerate(values) if v}
        self.changes = len(before ^ after)

    def requests(self):
        """Escalation, f1, and which requests are served."""
        return (-self.level, sum(self.served), self.served)

    def rest(self):
        """f3 and f4."""
        return (-self.idle_running, -self.changes)

    def agrees_with(self, objective):
        """Whether it is what cbc reports as `objective`."""
        tasks = self.idle_tasks
        idle = (tasks - self.idle_running) / tasks if tasks else 1
        suitability = float(self.suitability)
        return (objective["satisfied"] == sum(self.served) and
                objective["requests"] == len(self.served) and
                abs(objective["suitability"] - suitability) <= 1e-12 * suitability and
                abs(objective["idle"] - idle) <= 1e-12 and objective["changes"] == self.changes)
