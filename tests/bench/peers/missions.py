"""Events to compare solvers on, each with the state before it.

From idle: the start of a task of the highest level while nothing runs. Mixed: starts, stops and finishes of
a running system with 20 to 30 requests, drawn in the shares of `cbc sweep`. The searches that bring
the system there are limited by a number of decisions, and need not be optimal.
"""

import random

FEWEST, MOST = 20, 30
FILL_LIMIT = ["--max-nodes", "500"]
FAILURES = ["wrong_progress", "process_failure", "interrupted"]


def from_idle(cbc, catalog, seed, count):
    """Pairs of a state and an event."""
    tasks = [task for task, level in zip(catalog.tasks, catalog.level) if level == max(catalog.level)]
    state = cbc.initial_state()
    for task in random.Random(seed).sample(tasks, count):
        yield state, {"start": task, "priority": 1}


class Mixed:
    def __init__(self, cbc, catalog, seed):
        self.cbc, self.catalog, self.random = cbc, catalog, random.Random(seed)
        self.state = cbc.initial_state()

    def events(self, count):
        """Pairs of a state and an event. `take` has to follow each."""
        for _ in range(count):
            self.fill()
            yield self.state, self.draw()

    def take(self, following):
        self.state = following

    def requests(self):
        return sum(one["request"] is not None for one in self.state["running"])

    def fill(self):
        """Starts tasks, or lets some end, until there are enough requests, and not too many."""
        for _ in range(20 * MOST):
            if FEWEST <= self.requests() <= MOST:
                return
            event = self.draw_start() if self.requests() < FEWEST else self.draw_finish()
            self.state = self.cbc.run(self.state, event, *FILL_LIMIT)[2]
        raise RuntimeError(f"the catalog has no room for {FEWEST} requests")

    def draw(self):
        choice = self.random.randrange(16)
        if choice < 8:
            return self.draw_start()
        return self.draw_finish() if choice < 14 else self.draw_stop()

    def draw_priority(self):
        return self.random.randint(1, 3)

    def draw_start(self):
        tasks = [task for task in self.catalog.tasks if task != "empty"]
        return {"start": self.random.choice(tasks), "priority": self.draw_priority()}

    def draw_stop(self):
        running = self.random.choice(self.state["running"])
        return {"stop": running["task"], "priority": self.draw_priority()}

    def draw_finish(self):
        running = self.random.choice(self.state["running"])
        choice = self.random.random()
        cause = ("goal_achieved" if choice < 0.55 else
                 "situation_change" if choice < 0.7 else self.random.choice(FAILURES))
        return {"finish": running["behavior"], "cause": cause}
