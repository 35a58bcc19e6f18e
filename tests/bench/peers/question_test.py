"""The questions for other solvers against the answers of cbc, without any other solver.

    question_test.py CBC

In random missions on catalogs of the project, every answer of cbc has to be a solution of the question, of
the value that cbc reports. On a small catalog it has to be the best of all solutions, which are enumerated;
so has the best one among those that the models of the peers leave.
"""

import itertools
import json
import os
import random
import subprocess
import sys
import tempfile

from missions import Mixed
from model import Model
from question import Catalog, Question
from solvers import Cbc

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
SMALL = """
default_values: {tasks: {start_on_request: false}}
behaviors:
- {behavior: A0, task: A, suitability: 90, requires: [{task: C}, {task: D}]}
- {behavior: A1, task: A, suitability: 70, requires: [{task: E}]}
- {behavior: B0, task: B, suitability: 80, requires: [{task: D}]}
- {behavior: B1, task: B, suitability: 65, requires: [{task: C}, {task: F}]}
- {behavior: C0, task: C, suitability: 95, requires: [{task: F}]}
- {behavior: C1, task: C, suitability: 60}
- {behavior: D0, task: D, suitability: 85}
- {behavior: D1, task: D, suitability: 75, requires: [{task: F}]}
- {behavior: E0, task: E, suitability: 88}
- {behavior: F0, task: F, suitability: 77}
- {behavior: F1, task: F, suitability: 66}
exclusivity_constraints:
- mutually_exclusive: [A, B]
- mutually_exclusive: [A, F]
- mutually_exclusive: [D, E]
"""


def load(program, catalog, folder):
    compiled = os.path.join(folder, "catalog.cbc")
    subprocess.run([program, "compile", catalog, "-o", compiled], check=True, capture_output=True)
    dump = subprocess.run([program, "compile", "--dump", compiled], check=True,
                          capture_output=True, text=True).stdout
    return Cbc(program, compiled, folder), Catalog(dump)


def mission(cbc, catalog, seed, count, check):
    """Runs random events, and checks each that needs a search and comes from no clock."""
    mixed = Mixed(cbc, catalog, seed)
    checked = 0
    while checked < count:
        event = mixed.draw() if mixed.state["running"] else mixed.draw_start()
        record, _, following = cbc.run(mixed.state, event)
        question = Question(catalog, mixed.state, event)
        place = f"{json.dumps(mixed.state)}, {event}"
        if question.decided:
            assert record["outcome"] == question.decided, place
        else:
            check(question, record, place)
            checked += 1
        following["queue"] = {}  # reactive starts are not modeled
        following["waiting"] = []
        mixed.take(following)


def check_value(question, record, place):
    if record["outcome"] == "accepted":
        value = question.evaluate(question.catalog.values(record["running"]))
        assert value is not None and value.agrees_with(record["objective"]), place


def key(value):
    return (value.requests(), value.suitability, value.rest())


def best_of(question, domains):
    values = (question.evaluate(list(one)) for one in itertools.product(*domains))
    return max((key(value) for value in values if value is not None), default=None)


def check_best(question, record, place):
    check_value(question, record, place)
    best = best_of(question, question.domains)
    assert (record["outcome"] == "accepted") == (best is not None), place
    if best is not None:
        chosen = question.evaluate(question.catalog.values(record["running"]))
        assert key(chosen) == best, place
    model = Model(question)
    inside = [([0] if x not in model.forced else []) + model.values.get(x, [])
              for x in range(len(question.domains))]
    assert best_of(question, inside) == best, place


def main():
    program = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "small.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(SMALL)
        mission(*load(program, path, folder), 1, 150, check_best)
        for name in ("quadrotor", "mobile-manipulator", "target-following"):
            catalog = os.path.join(ROOT, "catalogs", name + ".yaml")
            mission(*load(program, catalog, folder), random.Random(name).randrange(100), 60, check_value)


if __name__ == "__main__":
    main()
