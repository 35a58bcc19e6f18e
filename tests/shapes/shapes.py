#!/usr/bin/env python3
"""Runs the commands on large catalogs of many shapes, and lists what crashes, or takes more time, memory or output than
a user would wait for, store or read. Shapes that people do not write are among them: strangers do."""

import argparse
import dataclasses
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

MISSION = "events:\n- start: T0\n- stop: T0\n- {start: T0, priority: 3}\n"
TIME_LIMIT = 3  # seconds, of the commands that have one


@dataclasses.dataclass
class Catalog:
    behaviors: list
    lists: list = dataclasses.field(default_factory=list)  # of exclusive tasks
    tasks: list = dataclasses.field(default_factory=list)
    variables: list = dataclasses.field(default_factory=list)
    starts_by_itself: bool = False  # tasks also start where others require them, without a request

    def text(self):
        defaults = "default_values: {tasks: {start_on_request: false}}\n" if self.starts_by_itself else ""
        sections = {"situation": self.variables, "behaviors": self.behaviors, "tasks": self.tasks,
                    "exclusivity_constraints": [f"mutually_exclusive: [{', '.join(each)}]" for each in self.lists]}
        return defaults + "".join(f"{key}:\n" + "".join(f"- {entry}\n" for entry in entries)
                       for key, entries in sections.items() if entries)


# Shapes --------------------------------------------------------------------------------------------

def names(count, first=0):
    return [f"T{number}" for number in range(first, count)]


def plain(count):
    """A behavior for each task."""
    return [f"{{behavior: B{number}, task: T{number}}}" for number in range(count)]


def loose(count):
    return Catalog(plain(count))


def star(count):
    return Catalog(plain(count), [["T0", task] for task in names(count, 1)])


def clique(count):
    return Catalog(plain(count), [names(count)])


def grid(count):
    side = int(count ** 0.5)
    rows = [[f"T{row * side + column}" for column in range(side)] for row in range(side)]
    return Catalog(plain(side * side), rows + [list(column) for column in zip(*rows)])


def one_pair_again_and_again(count):
    return Catalog(plain(3), [["T0", "T1"]] * count)


def many_behaviors(count):
    return Catalog([f"{{behavior: B{number}, task: T0, suitability: {number % 100}.{number // 100 % 100:02}}}"
                    for number in range(count)])


def chain(count, variants="B", rule="", more=""):
    """Each task requires the next one."""
    return Catalog([f"{{behavior: {variant}{number}, task: T{number}{more}" +
                    (f", requires: [{{task: T{number + 1}{rule}}}]" if number + 1 < count else "") + "}"
                    for number in range(count) for variant in variants])


def chain_of_alternatives(count):
    return chain(count, variants="AB")


def chain_of_minimums(count):
    return chain(count, rule=", minimum_performance: 1", more=", suitability: 99.9")


def started_chain_of_alternatives(count):
    return dataclasses.replace(chain(count, variants="AB"), starts_by_itself=True)


def alike(count):
    """Tasks with very many behaviors that are equally suitable, and require different tasks."""
    tasks = 20
    return Catalog([f"{{behavior: B{number}, task: T{number % tasks}, requires: [" +
                    ", ".join(f"{{task: T{target}}}" for target in
                              {number % tasks + 1 + number // tasks * step % 7 for step in (1, 3)}
                              if target < tasks) + "]}"
                    for number in range(count)], starts_by_itself=True)


def cycle(count):
    return Catalog([f"{{behavior: B{number}, task: T{number}, requires: [{{task: T{(number + 1) % count}}}]}}"
                    for number in range(count)])


def requires_all(count):
    required = ", ".join(f"{{task: {task}}}" for task in names(count, 1))
    return Catalog([f"{{behavior: B0, task: T0, requires: [{required}]}}", *plain(count)[1:]])


def behaviors_of_100_tasks(count):
    return Catalog([f"{{behavior: B{number}, tasks: [" +
                    ", ".join(f"{{task: T{(number * 50 + place) % count}}}" for place in range(100)) + "]}"
                    for number in range(count // 50)])


def reactive_clique(count):
    return Catalog(plain(count), [names(count)],
                   [f"{{task: {task}, reactive_start: true}}" for task in names(count, 1)])


def reactive_star(count):
    return Catalog(plain(count), [["T0", task] for task in names(count, 1)],
                   [f"{{task: {task}, reactive_start: true}}" for task in names(count, 1)])


def timeouts(count):
    return Catalog([f"{{behavior: B{number}, task: T{number}, timeout: {number + 1}}}" for number in range(count)])


def variables(count):
    return Catalog([f"{{behavior: {value}{number}, task: T{number}, situation: {{V{number}: {value}}}" +
                    (f", requires: [{{task: T{number + 1}}}]" if number % 10 and number + 1 < count else "") + "}"
                    for number in range(count) for value in "ab"],
                   variables=[f"{{variable: V{number}, values: [a, b, c]}}" for number in range(count)])


def values(count):
    listed = ", ".join(f"x{number}" for number in range(count))
    return Catalog([f"{{behavior: B{number}, task: T0, situation: {{V{number % 10}: x{number}}}}}"
                    for number in range(count)],
                   variables=[f"{{variable: V{number}, values: [{listed}]}}" for number in range(10)])


def conditions(count):
    return Catalog([f"{{behavior: B{value}, task: T0, situation: {{" +
                    ", ".join(f"V{number}: {value}" for number in range(count)) + "}}" for value in ("true", "false")],
                   variables=[f"{{variable: V{number}}}" for number in range(count)])


def parameters(count):
    listed = ", ".join(f"{{parameter: p{number}, allowed_values: [0, {number}]}}" for number in range(count))
    return Catalog(plain(1), tasks=[f"{{task: T0, parameters: [{listed}]}}"])


# Where a command has a smaller catalog, as its work grows with the square of the size: coverage asks for each requirement
# what the answer to an event would be without it, and each time the whole chain runs; a sweep makes a hundred events of
# which each is hard; a mutant of many conditions takes as long as the catalog.
SMALLER = {(started_chain_of_alternatives, "coverage"): 4, (alike, "sweep"): 4, (values, "sweep"): 4,
           (conditions, "coverage"): 4}
# What is known to take minutes: thousands of behaviors that are alike, and for each requirement the question what would
# be without it.
KNOWN = {(alike, "coverage")}

SHAPES = [loose, star, clique, grid, one_pair_again_and_again, many_behaviors, chain, chain_of_alternatives,
          chain_of_minimums, started_chain_of_alternatives, alike, cycle, requires_all, behaviors_of_100_tasks,
          reactive_clique, reactive_star, timeouts, variables, values, conditions, parameters]


# Commands ------------------------------------------------------------------------------------------

def commands(catalog, missions, folder):
    limit = ["--time-limit", str(TIME_LIMIT)]
    solve, verify = ["solve", catalog, missions], ["verify", catalog, *limit]
    graph = ["graph", catalog, "-o", f"{folder}/out.dot"]
    return [["lint", catalog], ["lint", catalog, "--summary", "--format", "json"],
            ["compile", catalog, "-o", f"{folder}/out.cbc"],
            solve, [*solve, "--why", "T0"], [*solve, "--alternatives", "5"], [*solve, "--html", f"{folder}/out.html"],
            ["coverage", catalog, missions], ["sweep", "--sequences", "1", catalog],
            graph, [*graph, "--view", "tasks", "--reduce"], [*graph, "--view", "constraints", "--exclusivity", "pairs"],
            [*graph, "--view", "behaviors"], ["graph", catalog, "--view", "situation"],
            ["graph", catalog, "--view", "together"], ["graph", "--diff", catalog, catalog, "--format", "text"],
            [*verify, "--max-states", "200"], [*verify, "--cut-sets", "T0", "--order", "2"],
            ["coverage", catalog, missions, "--mutants", *limit],
            ["coverage", catalog, "--write-missing", f"{folder}/tests", *limit]]


@dataclasses.dataclass
class Run:
    seconds: float
    mebibytes: int
    written: int  # MiB, to standard output
    end: str  # what is wrong with how it ended; empty: nothing

    def faults(self, options):
        over = [f"{self.seconds:.1f} s" if self.seconds > options.seconds else "",
                f"{self.mebibytes} MiB of memory" if self.mebibytes > options.memory else "",
                f"{self.written} MiB of output" if self.written > options.output else "", self.end]
        return ", ".join(each for each in over if each)


def run(program, arguments, folder, options):
    most = 4 * options.memory << 20  # a stop for what gets out of hand
    out = folder / "stdout"
    begin = time.monotonic()
    with out.open("w") as file, (folder / "stderr").open("w") as errors:
        process = subprocess.Popen([program, *arguments], stdin=subprocess.DEVNULL, stdout=file, stderr=errors,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (most, most)))
    while True:
        ended, status, usage = os.wait4(process.pid, os.WNOHANG)
        if ended:
            break
        if time.monotonic() - begin > 2 * options.seconds:
            process.kill()
        time.sleep(0.01)
    process.returncode = os.waitstatus_to_exitcode(status)
    end = "" if process.returncode in (0, 1, 2) else f"exit status {process.returncode}"
    if "out of memory" in (folder / "stderr").read_text(errors="replace"):
        end = "out of memory"
    return Run(time.monotonic() - begin, usage.ru_maxrss >> 10, out.stat().st_size >> 20, end)


def read_options():
    parser = argparse.ArgumentParser(prog="./dev shapes", description=__doc__)
    known = {shape.__name__: shape for shape in SHAPES}
    parser.add_argument("shapes", nargs="*", metavar="SHAPE", help=f"only these: {', '.join(known)}")
    parser.add_argument("--size", type=int, default=3000, metavar="N",
                        help="tasks, behaviors or values (default: 3000)")
    parser.add_argument("--seconds", type=float, default=15, help="that a command may take (default: 15)")
    parser.add_argument("--memory", type=int, default=2048, metavar="MIB", help="that it may take (default: 2048)")
    parser.add_argument("--output", type=int, default=64, metavar="MIB", help="that it may write (default: 64)")
    parser.add_argument("--program", required=True, help=argparse.SUPPRESS)
    options = parser.parse_args()
    for shape in options.shapes:
        if shape not in known:
            parser.error(f"there is no shape '{shape}'; expected one of {', '.join(known)}")
    options.shapes = [known[shape] for shape in options.shapes or known]
    return options


def main():
    options = read_options()
    is_good = True
    for shape in options.shapes:
        print(f"{shape.__name__}, {options.size}", flush=True)
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "missions").mkdir()
            (folder / "missions/mission.yaml").write_text(MISSION)
            catalog = folder / f"{shape.__name__}.yaml"
            for arguments in commands(str(catalog), str(folder / "missions"), folder):
                catalog.write_text(shape(options.size // SMALLER.get((shape, arguments[0]), 1)).text())
                faults = run(options.program, arguments, folder, options).faults(options)
                if not faults:
                    continue
                is_known = (shape, arguments[0]) in KNOWN
                is_good = is_good and is_known
                shown = " ".join(arguments).replace(f"{folder}/", "")
                print(f"  {'known: ' if is_known else ''}cbc {shown}: {faults}", flush=True)
    sys.exit(0 if is_good else 1)


if __name__ == "__main__":
    main()
