"""Runs the peers and cbc on a question, and says what they answer and how long it takes.

All times are CPU seconds. "search" leaves out the start of the program and the reading of its file:
gecode_peer measures that itself. Clasp and toulbar2 print milliseconds, which is too coarse, so the CPU
time of a run on the same file with a contradiction at its end, which needs no search, is subtracted.
cbc reports the time of its search by the wall clock. Where that is more than the CPU time of its
process without that of a process with no event, the latter counts. Of several runs the fastest counts.
"""

import json
import os
import re
import resource
import signal
import subprocess

from model import Weighted, answer_set_program, numbers_for_gecode

ROUNDS = 5
QUICK = 0.5  # seconds; what takes longer is not repeated
RESOLUTION = 0.001  # seconds; what a difference between the CPU times of two processes can say
# The second one is tried where the first one takes longer than SLOW, and the faster counts.
CLASP = [["clasp", "--outf=2", "--opt-strategy=usc,oll,stratify"],
         ["clasp", "--outf=2", "--opt-strategy=usc,oll,stratify", "--opt-usc-shrink=min"]]
SLOW = 0.1  # seconds
TOULBAR2 = ["toulbar2", "-s=0", "-w=solution"]


class Run:
    """A process that has ended, or was ended by its limit of CPU time. A process with a limit may see
    a coarse clock of its own CPU time, so one that measures itself has none."""

    def __init__(self, command, folder, limit, text=None):
        process = subprocess.Popen(command, cwd=folder, text=True, stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                                   preexec_fn=None if limit is None else lambda: limit_cpu(limit))
        if text is not None:
            process.stdin.write(text)
        process.stdin.close()
        self.output = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        self.cpu = usage.ru_utime + usage.ru_stime
        self.is_cut = -process.returncode in (signal.SIGXCPU, signal.SIGKILL)


def limit_cpu(limit):
    seconds = int(limit) + 1
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))


class Answer:
    """`values` of all tasks; None if there is no solution, or none was found in time."""

    def __init__(self, values, search, process, is_cut=False):
        self.values, self.search, self.process, self.is_cut = values, search, process, is_cut


def fastest(run):
    """The fastest of a few runs, by the time of their search."""
    best = run()
    for _ in range(ROUNDS - 1):
        if best.is_cut or best.process > QUICK:
            break
        other = run()
        if other.search < best.search:
            best = other
    return best


def least_cpu(command, folder, limit):
    """How long reading takes; at least twice as many runs, as this is subtracted."""
    return min(Run(command, folder, limit).cpu for _ in range(2 * ROUNDS))


def after_reading(run, reading):
    return max(run.cpu - reading, RESOLUTION / 100)


def solve_with_clasp(model, folder, limit):
    write(folder, "question.lp", answer_set_program(model))
    grounder = Run(["gringo", "question.lp"], folder, 60)
    write(folder, "question.aspif", grounder.output)
    write(folder, "reading.aspif", grounder.output.rpartition("0\n")[0] + "1 0 0 0 0\n0\n")
    answer = run_clasp(CLASP[0], model, grounder.cpu, folder, limit)
    if answer.search <= SLOW:
        return answer
    return min(answer, run_clasp(CLASP[1], model, grounder.cpu, folder, limit), key=lambda a: a.search)


def run_clasp(command, model, grounding, folder, limit):
    reading = least_cpu([*command, "reading.aspif"], folder, limit)

    def once():
        run = Run([*command, "question.aspif"], folder, limit)
        result = {} if run.is_cut else json.loads(run.output)
        outcome = result.get("Result")
        if outcome not in ("OPTIMUM FOUND", "UNSATISFIABLE"):
            return Answer(None, limit, run.cpu, True)
        values = None
        if outcome == "OPTIMUM FOUND":
            atoms = result["Call"][0]["Witnesses"][-1].get("Value", [])
            pairs = (re.fullmatch(r"b\((\d+),(\d+)\)", atom) for atom in atoms)
            values = model.all_values({int(pair[1]): int(pair[2]) for pair in pairs})
        return Answer(values, after_reading(run, reading), run.cpu + grounding)

    return fastest(once)


def solve_with_toulbar2(model, folder, limit):
    problem = Weighted(model)
    search, process, served, level = 0, 0, None, None
    for stage in problem.stages():
        part = solve_stage(problem, stage, served, level, folder, limit)
        search, process = search + part.search, process + part.process
        if part.is_cut or part.values is None:
            return Answer(None, limit if part.is_cut else search, process, part.is_cut)
        value = model.question.evaluate(part.values)
        if value is None:
            return Answer(part.values, search, process)  # wrong, as the comparison will find
        served = {x for x in model.droppable if part.values[x]}
        level = value.level
    return Answer(part.values, search, process)


def solve_stage(problem, stage, served, level, folder, limit):
    text = problem.text(stage, served, level)
    write(folder, "question.wcsp", text)
    write(folder, "reading.wcsp", problem.with_contradiction(text))
    reading = least_cpu([*TOULBAR2, "reading.wcsp"], folder, limit)

    def once():
        run = Run([*TOULBAR2, "question.wcsp"], folder, limit)
        if run.is_cut:
            return Answer(None, limit, run.cpu, True)
        values = None
        if "No solution" not in run.output:
            if "Optimum:" not in run.output:
                raise RuntimeError("toulbar2: " + run.output)
            with open(os.path.join(folder, "solution"), encoding="utf-8") as file:
                values = problem.values(file.read().split())
        return Answer(values, after_reading(run, reading), run.cpu)

    return fastest(once)


def solve_with_gecode(program):
    def solve(model, folder, limit):
        write(folder, "question.txt", numbers_for_gecode(model))

        def once():
            run = Run([program, "question.txt", str(limit)], folder, None)
            lines = run.output.splitlines()
            if run.is_cut or not lines:
                return Answer(None, limit, run.cpu, True)
            word, seconds = lines[0].split()
            if word == "timeout":
                return Answer(None, limit, run.cpu, True)
            values = None
            if word == "optimal":
                places = [int(place) for place in lines[1].split()]
                values = model.all_values({x: model.values[x][place - 1]
                                           for x, place in zip(model.tasks, places) if place})
            return Answer(values, float(seconds), run.cpu)

        return fastest(once)

    return solve


class Cbc:
    """`catalog` is a compiled one. States are passed on by files of --state-in and --state-out."""

    def __init__(self, program, catalog, folder):
        self.program, self.catalog, self.folder = program, catalog, folder

    def run(self, state, event, *options):
        """What is reported of the event, if there is one, its process, and the next state."""
        write(self.folder, "state.json", json.dumps(state))
        run = Run([self.program, "solve", "--stats", "--format", "jsonl", *options, "--state-in",
                   "state.json", "--state-out", "next.json", self.catalog, "-"],
                  self.folder, 60, "" if event is None else json.dumps(event) + "\n")
        lines = run.output.splitlines()
        if run.is_cut or len(lines) != (2 if event is None else 3):
            raise RuntimeError(f"cbc: no answer to {event}")
        with open(os.path.join(self.folder, "next.json"), encoding="utf-8") as file:
            return json.loads(lines[1]), run, json.load(file)

    def initial_state(self):
        Run([self.program, "solve", "--format", "jsonl", "--state-out", "next.json", self.catalog,
             "-"], self.folder, 60, "")
        with open(os.path.join(self.folder, "next.json"), encoding="utf-8") as file:
            return json.load(file)

    def run_for(self, limit, state, event):
        """The limit is one of wall time; on a busy machine it is raised once."""
        record, run, following = self.run(state, event, "--time-limit", str(limit))
        if is_cut(record) and run.cpu < 0.9 * limit:
            longer = limit * limit / run.cpu
            record, run, following = self.run(state, event, "--time-limit", f"{longer:.3f}")
        return record, run, following

    def solve(self, catalog, state, event, limit):
        """Its answer, what it reports of it, and the next state."""
        seen = []
        reading = min(self.run(state, None)[1].cpu for _ in range(2 * ROUNDS))

        def once():
            record, run, following = self.run_for(limit, state, event)
            seen[:] = [record, following]
            values = None
            if record["outcome"] == "accepted":
                values = catalog.values(record["running"])
            search = limit if is_cut(record) else min(elapsed(run), max(run.cpu - reading, RESOLUTION))
            return Answer(values, search, run.cpu, is_cut(record))

        return fastest(once), seen[0], seen[1]


def is_cut(record):
    return record["search"]["status"] in ("feasible", "unknown")


def elapsed(run):
    """The seconds of the searches, from the statistics at the end."""
    return json.loads(run.output.splitlines()[-1])["totals"]["elapsed_us"]["sum"] / 1e6


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)
