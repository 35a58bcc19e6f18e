"""One event, solved by cbc and by general solvers: how long each takes.

    build/release/cbc compile catalogs/quadrotor.yaml -o /tmp/quadrotor.cbc
    python3 tests/bench/other_solvers.py build/release/cbc /tmp/quadrotor.cbc FOLLOW_PATH

The event is the start of a task while nothing runs. Its group is written as a model for MiniZinc
(solved by Gecode) and one for clingo, by the rules of cbc-solve(1). All have to choose the same
behaviors, and to prove it. The models are simpler than what cbc does: suitabilities are
logarithms, rounded to 1e-5, and nothing decides between configurations that are equally good.

"process" is from the start of a program to its end. "search" is what the program itself says of its
search alone; clingo says it to 10 ms only.

Needs the packages minizinc and gringo (which has clingo) of Debian.
"""

import json
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

ROUNDS = 50


def run(*command):
    begin = time.perf_counter()
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    return result.stdout + result.stderr, (time.perf_counter() - begin) * 1000


def cost(percent):
    return 10**7 if percent == 0 else round(-math.log(percent / 100) * 1e5)


def group_of(dump, task):
    return next(g for g in dump["groups"] if any(t["task"] == task for t in g["tasks"]))


class Group:
    """Tasks and behaviors by number. Value 0 of a task: it does not run; from 1: its behaviors."""

    def __init__(self, group, started):
        if any(task["minimum_performance"] is not None for task in group["tasks"]):
            sys.exit("minimum performances of tasks are not modelled")
        self.number = {task["task"]: i for i, task in enumerate(group["tasks"], 1)}
        self.started = self.number[started]
        requires = {b["behavior"]: b["requires"] for b in group["behaviors"]}
        self.domains = []  # of each task: the cost of each behavior that may be chosen
        self.names = []
        self.requirements = []  # (task, value, required task, highest cost of its performance)
        for x, task in enumerate(group["tasks"], 1):
            is_open = x == self.started or not task["start_on_request"]
            behaviors = task["behaviors"] if is_open else []
            self.domains.append([cost(b["suitability"]) for b in behaviors])
            self.names.append([b["behavior"] for b in behaviors])
            for value, behavior in enumerate(behaviors, 1):
                for needed in requires[behavior["behavior"]]:
                    minimum = needed["minimum_performance"]
                    limit = -1 if minimum is None else cost(minimum)
                    self.requirements.append((x, value, self.number[needed["task"]], limit))
        self.exclusive = [[self.number[t] for t in e["tasks"]] for e in group["exclusivity"]]
        self.idle = [x for x, task in enumerate(group["tasks"], 1) if not task["start_on_request"]]

    def behaviors(self, values):
        return sorted(self.names[x - 1][value - 1] for x, value in values.items() if value > 0)


def minizinc_model(group):
    tasks = range(1, len(group.domains) + 1)
    lines = [f"var {int(x == group.started)}..{len(group.domains[x - 1])}: x{x};" for x in tasks]
    lines += [f"array[0..{len(c)}] of int: c{x} = array1d(0..{len(c)}, {[0] + c});"
              for x, c in zip(tasks, group.domains)]
    running = [f"bool2int(x{x} > 0)" for x in tasks]
    lines += [f"constraint {' + '.join(running[x - 1] for x in exclusive)} <= 1;"
              for exclusive in group.exclusive]
    lines += [f"constraint x{x} = {v} -> x{t} > 0;" for x, v, t, _ in group.requirements]
    needing = sorted({x for x, _, _, limit in group.requirements if limit >= 0} |
                     {t for _, _, t, limit in group.requirements if limit >= 0})
    below = closure(group, needing)
    for x, ts in below.items():  # x needs t: directly, or by way of u
        for t in ts:
            ways = [f"x{x} = {v}" if u == t else f"(x{x} = {v} /\\ n{u}_{t})"
                    for a, v, u, _ in group.requirements if a == x and (u == t or t in below[u])]
            lines.append(f"var bool: n{x}_{t};")
            lines.append(f"constraint n{x}_{t} <-> (" + " \\/ ".join(ways) + ");")
    for x, v, t, limit in group.requirements:
        if limit >= 0:
            costs = [f"c{t}[x{t}]"] + [f"bool2int(n{t}_{u}) * c{u}[x{u}]" for u in below[t]]
            lines.append(f"constraint x{x} = {v} -> {' + '.join(costs)} <= {limit};")
    lines.append("var int: suitability = %s;" % " + ".join(f"c{x}[x{x}]" for x in tasks))
    lines.append("var int: idle = %s;" % " + ".join(running[x - 1] for x in group.idle))
    lines.append("var int: changes = %s;" % " + ".join(running))
    lines.append("solve minimize 10000 * suitability + 100 * idle + changes;")
    lines.append("output [%s];" % ", ".join(f'"{x}=\\(x{x}) "' for x in tasks))
    return "\n".join(lines) + "\n"


def closure(group, roots):
    """The tasks below each of some tasks, and below all of those."""
    below = {}

    def visit(x):
        if x not in below:
            direct = {t for a, _, t, _ in group.requirements if a == x}
            below[x] = sorted(direct.union(*(visit(t) for t in direct)))
        return below[x]

    for root in roots:
        visit(root)
    return below


def clingo_model(group):
    lines = []
    for x, costs in enumerate(group.domains, 1):
        lines.append(f"task({x}).")
        lines += [f"value({x},{v},{c})." for v, c in enumerate(costs, 1)]
    lines += [f"idle({x})." for x in group.idle]
    for i, exclusive in enumerate(group.exclusive):
        lines += [f"exclusive({i},{x})." for x in exclusive]
    lines += [f"requires({x},{v},{t})." for x, v, t, _ in group.requirements]
    lines += [f"limit({x},{v},{t},{limit})." for x, v, t, limit in group.requirements if limit >= 0]
    return "\n".join(lines) + f"""
{{ is(X,V) : value(X,V,_) }} 1 :- task(X).
runs(X) :- is(X,_).
:- not runs({group.started}).
:- exclusive(I,X), exclusive(I,Y), X < Y, runs(X), runs(Y).
:- is(X,V), requires(X,V,T), not runs(T).
needs(X,T) :- is(X,V), requires(X,V,T).
needs(X,T) :- needs(X,U), needs(U,T).
part(T,T) :- limit(_,_,T,_).
part(T,U) :- limit(_,_,T,_), needs(T,U).
:- is(X,V), limit(X,V,T,L), #sum {{ C,U : part(T,U), is(U,W), value(U,W,C) }} > L.
#minimize {{ C@3,X : is(X,V), value(X,V,C) }}.
#minimize {{ 1@2,X : runs(X), idle(X) }}.
#minimize {{ 1@1,X : runs(X) }}.
#show is/2.
"""


def check(group, values, expected, is_proven):
    chosen = group.behaviors({int(task): int(value) for task, value in values})
    if chosen != expected or not is_proven:
        sys.exit(f"another answer: {chosen}")


def report(name, version, program, rounds, solve_time):
    """`solve_time` finds, in what the program prints, how long the search took, in milliseconds."""
    whole = statistics.median(milliseconds for _, milliseconds in rounds)
    search = "?"
    if solve_time:
        search = f"{statistics.median(solve_time(text) for text, _ in rounds):.4f}"
    number = re.search(version, run(program, "--version")[0])[1]
    print(f"{name:<28}{number:<12}{whole:>12.1f}{search:>14}")


def require_programs():
    missing = [name for name in ("minizinc", "clingo") if shutil.which(name) is None]
    if missing:
        sys.exit(f"there is no {' and no '.join(missing)}: install the packages minizinc and gringo")
    if len(sys.argv) != 4 or not os.path.exists(sys.argv[2]):
        sys.exit("expected the program, a catalog and a task, as in\n" + __doc__.split("\n\n")[1])


def main():
    require_programs()
    program, catalog, task = sys.argv[1:]
    dump = json.loads(run(program, "compile", "--dump", "--format", "json", catalog)[0])
    group = Group(group_of(dump, task), task)
    with tempfile.TemporaryDirectory() as folder:
        script, mzn, lp = (os.path.join(folder, name) for name in
                           ("script.json", "event.mzn", "event.lp"))
        for path, text in ((script, json.dumps([{"start": task}])), (mzn, minizinc_model(group)),
                           (lp, clingo_model(group))):
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)

        solve = [program, "solve", "--stats", "--format", "json", catalog, script]
        event = json.loads(run(*solve)[0])["runs"][0]["events"][0]
        expected = sorted({change["behavior"] for change in event["changes"]})
        print(f"start {task} chooses {', '.join(expected)}\n")
        title = f"median of {ROUNDS}"
        print(f"{title:<28}{'version':<12}{'process [ms]':>12}{'search [ms]':>14}")
        report("cbc", r"cbc ([\d.]+)", program, [run(*solve) for _ in range(ROUNDS)],
               lambda text: json.loads(text)["runs"][0]["events"][0]["search"]["elapsed_us"] / 1000)

        command = ["minizinc", "--solver", "gecode", "--statistics", mzn]
        rounds = [run(*command) for _ in range(ROUNDS)]
        for text, _ in rounds:
            last = text.rpartition("----------")[0].rpartition("----------")[2]
            check(group, re.findall(r"(\d+)=(\d+) ", last), expected, "==========" in text)
        report("MiniZinc with Gecode", r"version ([\d.]+)", "minizinc", rounds,
               lambda text: float(re.search(r"solveTime=([\d.e-]+)", text)[1]) * 1000)

        rounds = [run("clingo", lp) for _ in range(ROUNDS)]
        for text, _ in rounds:
            last = text.rpartition("Answer:")[2]
            check(group, re.findall(r"is\((\d+),(\d+)\)", last), expected, "OPTIMUM FOUND" in text)
        report("clingo", r"version ([\d.]+)", "clingo", rounds, None)


if __name__ == "__main__":
    main()
