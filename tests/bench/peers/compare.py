"""cbc, clasp, toulbar2 and Gecode on the same events; `./dev bench-peers` runs it.

Compares all answers, and ends with status 1 if two differ. The table goes to standard output and, unless
options change what is measured, into docs/peers.md, which says what it means.
"""

import argparse
import csv
import datetime
import json
import os
import re
import statistics
import subprocess
import sys
from pathlib import Path

import missions
import solvers
from model import Model
from question import Catalog, Question

ROOT = Path(__file__).resolve().parents[3]
DOCUMENT = ROOT / "docs" / "peers.md"
BEGIN, END = "<!-- table: begin -->\n", "<!-- table: end -->\n"
# Of a size: tasks of a level, behaviors, requirements, levels, and exclusivity lists of a level.
SHAPES = {100: (20, 4, 3, 5, 4), 300: (50, 5, 4, 6, 5), 800: (100, 5, 4, 8, 5)}
SEEDS = (11, 12)  # of the catalogs of a size
SETTINGS = "warn: [exclusive-requirement, conflicting-requirements]\n"


class Settings:
    def __init__(self, arguments):
        self.__dict__.update(vars(arguments))
        self.cbc = os.path.abspath(self.cbc)
        self.folder = ROOT / "build" / "peers"
        self.peers = {"clasp": solvers.solve_with_clasp, "toulbar2": solvers.solve_with_toulbar2,
                      "Gecode": solvers.solve_with_gecode(os.path.abspath(self.gecode))}


class Result:
    """One event: the answers of all solvers that it was given to."""

    def __init__(self, kind, size, name, answers, exactness):
        self.kind, self.size, self.name = kind, size, name
        self.answers, self.exactness = answers, exactness

    def ratio(self, peer):
        """How many times as long the peer took; a solver that was stopped counts with the limit.
        None if both were."""
        ours, theirs = self.answers["cbc"], self.answers[peer]
        return None if ours.is_cut and theirs.is_cut else theirs.search / ours.search


class Mismatch(Exception):
    pass


def compare(question, ours, theirs):
    """"same", "rounded" or "cut". Rounded logarithms may take a product for another that is a little
    larger."""
    if theirs.is_cut or (ours.is_cut and ours.values is None):
        return "cut"
    if ours.values is None or theirs.values is None:
        if ours.values is not theirs.values:
            raise Mismatch("only one of them has a solution")
        return "same"
    best, other = question.evaluate(ours.values), question.evaluate(theirs.values)
    if best is None or other is None:
        raise Mismatch("not a solution")
    if ours.is_cut:
        if best.requests() > other.requests():
            raise Mismatch("the peer serves less than a stopped search")
        return "cut"
    if best.requests() != other.requests():
        raise Mismatch(f"requests: {best.requests()} and {other.requests()}")
    if best.suitability == other.suitability:
        if best.rest() != other.rest():
            raise Mismatch(f"f3, f4: {best.rest()} and {other.rest()}")
        return "same"
    tolerance = len(question.domains) * 1e-5
    if not 0 < best.suitability - other.suitability <= tolerance * best.suitability:
        raise Mismatch(f"f2: {float(best.suitability)} and {float(other.suitability)}")
    return "rounded"


def measure(settings, cbc, catalog, state, event, place, peers):
    """The answers, how they compare with that of cbc, and the state after the event."""
    question = Question(catalog, state, event)
    ours, record, following = cbc.solve(catalog, state, event, settings.limit)
    if ours.values is not None:
        value = question.evaluate(ours.values)
        if value is None or not value.agrees_with(record["objective"]):
            raise Mismatch(f"{place}: cbc says {record['objective']}")
    answers, exactness = {"cbc": ours}, {}
    model = Model(question)
    for name in peers:
        answers[name] = settings.peers[name](model, cbc.folder, settings.limit)
        if answers[name].search > settings.limit:  # the limit of the process is in whole seconds
            answers[name] = solvers.Answer(None, settings.limit, answers[name].process, True)
        try:
            exactness[name] = compare(question, ours, answers[name])
        except Mismatch as mismatch:
            raise Mismatch(f"{place}: cbc and {name} disagree: {mismatch}") from None
    return answers, exactness, following


def prepare(settings, size, seed):
    """A generated catalog, its compiled file, and a program that runs it."""
    folder = settings.folder / f"group{size}-{seed}"
    folder.mkdir(parents=True, exist_ok=True)
    shape = [str(number) for number in (*SHAPES[size], seed)]
    text = subprocess.run([settings.generator, *shape], check=True, capture_output=True).stdout
    (folder / "catalog.yaml").write_bytes(text)
    return load(settings, folder)


def load(settings, folder):
    (folder / ".cbc.yaml").write_text(SETTINGS, encoding="utf-8")
    compiled = str(folder / "catalog.cbc")
    subprocess.run([settings.cbc, "compile", str(folder / "catalog.yaml"), "-o", compiled], check=True,
                   capture_output=True)
    dump = subprocess.run([settings.cbc, "compile", "--dump", compiled], check=True,
                          capture_output=True, text=True).stdout
    catalog = Catalog(dump)
    if not catalog.is_plain():
        sys.exit(f"{folder}: the models have no minimums and no behaviors of several tasks")
    return solvers.Cbc(settings.cbc, compiled, str(folder)), catalog


def measure_kind(settings, kind, size, seed, count, with_gecode):
    cbc, catalog = prepare(settings, size, seed)
    mixed = missions.Mixed(cbc, catalog, seed)
    drawn = missions.from_idle(cbc, catalog, seed, count) if kind == "idle" else mixed.events(count)
    for number, (state, event) in enumerate(skip_decided(catalog, drawn, mixed)):
        name = f"{kind}-{size}-{seed}-{number}"
        peers = ["clasp", "toulbar2"] + (["Gecode"] if number < with_gecode else [])
        answers, exactness, following = measure(settings, cbc, catalog, state, event, name, peers)
        if kind == "mixed":
            mixed.take(following)
        result = Result(kind, size, name, answers, exactness)
        if settings.lost:
            keep_if_lost(settings, result, cbc, state, event)
        print(line_of(result), file=sys.stderr, flush=True)
        yield result


def skip_decided(catalog, drawn, mixed):
    """An event that needs no search is no event here; another one is drawn for it."""
    for state, event in drawn:
        while Question(catalog, state, event).decided:
            event = mixed.draw()
        yield state, event


def keep_if_lost(settings, result, cbc, state, event):
    ratios = [result.ratio(peer) for peer in result.answers if peer != "cbc"]
    if not result.answers["cbc"].is_cut and all(ratio >= 1 for ratio in ratios):
        return
    folder = Path(settings.lost)
    folder.mkdir(parents=True, exist_ok=True)
    catalog = Path(cbc.folder).name + ".yaml"
    (folder / catalog).write_bytes((Path(cbc.folder) / "catalog.yaml").read_bytes())
    (folder / ".cbc.yaml").write_text(SETTINGS, encoding="utf-8")
    (folder / (result.name + ".state.json")).write_text(json.dumps(state), encoding="utf-8")
    (folder / (result.name + ".event")).write_text(json.dumps(event) + "\n", encoding="utf-8")
    with open(folder / "LIST.txt", "a", encoding="utf-8") as file:
        file.write(f"{line_of(result)}  {catalog}  {json.dumps(event)}\n")


def line_of(result):
    parts = [f"{result.name:<18}"]
    for name, answer in result.answers.items():
        outcome = "stopped" if answer.is_cut else f"{answer.search * 1e3:.3f} ms"
        note = "" if result.exactness.get(name, "same") != "rounded" else " (rounded)"
        parts.append(f"{name} {outcome}{note}")
    return "  ".join(parts)


def check_hard_events(settings):
    """Events with answers that others have proven, if they are there."""
    shared = Path(os.environ.get("CBC_SHARED", ROOT.parent / "shared")) / "generated" / "hard"
    if not (shared / "expected.tsv").exists():
        print("no proven hard events: CBC_SHARED has none, skipped", file=sys.stderr)
        return
    with open(shared / "expected.tsv", encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file, delimiter="\t"))[1:]
    for name, outcome, *numbers in rows:
        stem = "group" + name[1:].rsplit("-", 1)[0]
        folder = settings.folder / stem
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "catalog.yaml").write_bytes((shared / (stem + ".yaml")).read_bytes())
        cbc, catalog = load(settings, folder)
        state = json.loads((shared / (name + ".state.json")).read_text(encoding="utf-8"))
        state["digest"] = cbc.initial_state()["digest"]
        event = json.loads((shared / (name + ".event")).read_text(encoding="utf-8"))
        answers, exactness, _ = measure(settings, cbc, catalog, state, event, name,
                                        ["clasp", "toulbar2"])
        print(line_of(Result("hard", 300, name, answers, exactness)), file=sys.stderr, flush=True)
        for solver, answer in answers.items():
            check_proven(f"{name}, {solver}", Question(catalog, state, event), answer, outcome, numbers)


def check_proven(place, question, answer, outcome, numbers):
    if answer.is_cut:
        return
    if (answer.values is None) != (outcome == "rejected"):
        raise Mismatch(f"{place}: not {outcome}")
    if answer.values is not None:
        value = question.evaluate(answer.values)
        proven = [int(numbers[0]), float(numbers[1]), int(numbers[2]), int(numbers[3])]
        found = [sum(value.served), float(value.suitability), value.idle_running, value.changes]
        if found != proven and abs(found[1] - proven[1]) > 1e-3 * proven[1]:
            raise Mismatch(f"{place}: {found}, not {proven}")


def number(value):
    return f"{value:.2f}" if value < 1 else f"{value:.3g}" if value < 100 else f"{value:,.0f}"


def median_of_ratios(ratios, is_lower_bound):
    if not ratios:
        return "–"
    return ("> " if is_lower_bound else "") + number(statistics.median(ratios))


def row(results, solver):
    """A row of the table, for the events that the solver was given."""
    mine = [result for result in results if solver in result.answers]
    answers = [result.answers[solver] for result in mine]
    searches = [answer.search * 1e3 for answer in answers]
    median = statistics.median(searches)
    cut = sum(answer.is_cut for answer in answers)
    cells = [results[0].kind, str(results[0].size), solver, str(len(mine)),
             ("> " if cut * 2 > len(mine) else "") + number(median),
             number(statistics.median(answer.process * 1e3 for answer in answers)), str(cut)]
    if solver == "cbc":
        cells += ["", "", ""]
    else:
        ratios = [ratio for ratio in (result.ratio(solver) for result in mine) if ratio is not None]
        ahead = sum(ratio >= 1 for ratio in ratios)
        cells += [median_of_ratios(ratios, cut * 2 > len(mine)),
                  f"{100 * ahead / len(ratios):.0f} % of {len(ratios)}" if ratios else "–",
                  number(min(ratios)) if ratios else "–"]
    return "| " + " | ".join(cells) + " |"


def table(results):
    lines = ["| events | tasks | solver | number | search [ms] | process [ms] | stopped | ratio | cbc ahead |"
             " worst ratio |",
             "| --- | ---: | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"]
    for kind in ("idle", "mixed"):
        for size in SHAPES:
            some = [r for r in results if (r.kind, r.size) == (kind, size)]
            lines += [row(some, solver) for solver in ("cbc", "clasp", "toulbar2", "Gecode")
                      if any(solver in r.answers for r in some)]
    return "\n".join(lines) + "\n"


def conditions(settings, results):
    """A paragraph: when, where, with which versions, and how exactly the answers agree."""
    pairs = [word for result in results for word in result.exactness.values()]
    agree = pairs.count("same")
    text = (f"{datetime.date.today():%B %-d, %Y}, on {processor()}; {versions(settings)}. "
            f"{settings.limit:g} s for each event; load average {os.getloadavg()[2]:.0f}. Of {len(pairs)} "
            f"answers of peers, {agree} are equal to that of cbc down to f4, {pairs.count('rounded')} differ from it by rounded logarithms (cbc's "
            f"is better), and {pairs.count('cut')} could not be compared since a solver was stopped.")
    return fill(text) + "\n"


def fill(text, width=118):
    lines, line = [], ""
    for word in text.split():
        if line and len(line) + 1 + len(word) > width:
            lines.append(line)
            line = ""
        line += (" " if line else "") + word
    return "\n".join([*lines, line])


def processor():
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return "an unknown processor"
    found = re.search(r"model name\s*: (.*)", text)
    return f"{found[1] if found else 'an unknown processor'}, {os.cpu_count()} processors"


def versions(settings):
    def ask(command, pattern):
        found = re.search(pattern, solvers.Run(command, "/", 10).output)
        return found[1] if found else "?"

    package = ask(["dpkg-query", "-W", "-f=${Version}", "libgecode-dev"], r"([\d.]+)")
    return ", ".join([f"cbc {ask([settings.cbc, '--version'], r'cbc ([0-9.]+)')}",
                      f"clasp {ask(['clasp', '--version'], r'version ([0-9.]+)')}",
                      f"gringo {ask(['gringo', '--version'], r'version ([0-9.]+)')}",
                      f"toulbar2 {ask(['toulbar2', '--help'], r'version : ([0-9.]+)')}",
                      f"Gecode {package}"])


def write_document(text):
    document = DOCUMENT.read_text(encoding="utf-8")
    before, _, rest = document.partition(BEGIN)
    _, _, after = rest.partition(END)
    DOCUMENT.write_text(before + BEGIN + text + END + after, encoding="utf-8")


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--cbc", required=True, help="the program")
    parser.add_argument("--generator", required=True, help="the program cbc_generate_catalog")
    parser.add_argument("--gecode", required=True, help="the program cbc_gecode_peer")
    parser.add_argument("--events", type=int, default=12, help="of each kind and size (12)")
    parser.add_argument("--gecode-events", type=int, help="of these, how many Gecode gets (all)")
    parser.add_argument("--limit", type=float, default=5, help="seconds for each event (5)")
    parser.add_argument("--sizes", type=int, nargs="+", default=list(SHAPES), choices=list(SHAPES))
    parser.add_argument("--kinds", nargs="+", default=["idle", "mixed"], choices=["idle", "mixed"])
    parser.add_argument("--seeds", type=int, nargs="+", default=list(SEEDS), help="of the catalogs")
    parser.add_argument("--lost", metavar="FOLDER", 
                        help="write events on which cbc is behind, or stopped, to it")
    arguments = parser.parse_args()
    if arguments.gecode_events is None:
        arguments.gecode_events = arguments.events
    return arguments


def main():
    arguments = parse_arguments()
    settings = Settings(arguments)
    results = []
    check_hard_events(settings)
    for kind in settings.kinds:
        for size in settings.sizes:
            for seed in settings.seeds:
                share = len(settings.seeds)
                results += measure_kind(settings, kind, size, seed, settings.events // share,
                                        settings.gecode_events // share)
    text = "\n" + conditions(settings, results) + "\n" + table(results) + "\n"
    print(text)
    is_whole = settings.kinds == ["idle", "mixed"] and settings.sizes == list(SHAPES)
    if is_whole and DOCUMENT.exists():
        write_document(text)


if __name__ == "__main__":
    try:
        main()
    except Mismatch as mismatch:
        sys.exit(f"MISMATCH: {mismatch}")
