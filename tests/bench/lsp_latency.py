"""Prints how fast `cbc lsp` answers: CBC_PROGRAM=build/release/cbc python3 tests/bench/lsp_latency.py

On a catalog of 300 tasks, in a workspace of 2,000 files, and on a catalog of 10 MB. Nothing here fails if it is slow.
"""

import pathlib
import random
import statistics
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "lsp"))

from client import Client, span  # pylint: disable=wrong-import-position

ROUNDS = 100


def catalog(tasks, draw):
    """Each task has three behaviors, which require some of the tasks after it."""
    lines = ["behaviors:"]
    for task in range(tasks):
        for behavior in range(3):
            later = range(task + 1, min(task + 20, tasks))
            required = draw.sample(later, min(len(later), draw.randrange(3)))
            requires = ", ".join(f"{{task: TASK_{other}}}" for other in sorted(required))
            lines.append(f"- {{behavior: B_{task}_{behavior}, task: TASK_{task}, "
                         f"suitability: {draw.randrange(50, 101)}, requires: [{requires}]}}")
    lines.append("tasks:")
    lines += [f"- {{task: TASK_{task}}}" for task in range(tasks)]
    return "\n".join(lines) + "\n"


def report(what, seconds):
    ordered = sorted(1000 * value for value in seconds)
    tail = f", 95 %: {ordered[int(0.95 * len(ordered))]:.1f} ms, most: {ordered[-1]:.1f} ms" if len(ordered) > 1 else ""
    print(f"  {what}: {statistics.median(ordered):.1f} ms{tail}")


def seconds_of(work):
    begin = time.perf_counter()
    work()
    return time.perf_counter() - begin


def receive_findings(client, path, version):
    while client.versions.get(str(path)) != version:
        client.receive()


def measure(client, path, text, rounds, draw):
    """Types a letter at the end of a name, asks there, and takes it back."""
    lines = text.split("\n")
    places = [line for line, words in enumerate(lines) if words.startswith("- {behavior")]
    typing, names = {"completion": [], "hover": []}, {"documentSymbol": [], "definition": []}
    found = []
    version = 1
    for _ in range(rounds):
        line = draw.choice(places)
        name = lines[line].index("TASK_")
        end = lines[line].index(",", name)
        version += 1
        client.change(path, version, {"range": span(line, end, line, end), "text": "x"})
        for method, times in typing.items():
            times.append(seconds_of(lambda m=method: client.at(m, path, line, end)))
        found.append(seconds_of(lambda v=version: receive_findings(client, path, v)))
        version += 1
        client.change(path, version, {"range": span(line, end, line, end + 1), "text": ""})
        receive_findings(client, path, version)
        for method, times in names.items():
            at = {"position": {"line": line, "character": end}} if method == "definition" else {}
            times.append(seconds_of(lambda m=method, a=at: client.of(m, path, **a)))
    for method, times in typing.items():
        report(f"{method} after a key", times)
    report("findings, with the pause of 100 ms", found)
    for method, times in names.items():
        report(method, times)


def main():
    draw = random.Random(1)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        text = catalog(300, draw)
        path = folder / "robot.yaml"
        path.write_text(text)
        print(f"A catalog of 300 tasks ({len(text)} bytes)")
        with Client(folder) as client:
            client.open(path)
            client.settle()
            measure(client, path, text, ROUNDS, draw)

        print("2,000 files")
        for number in range(2000):
            (folder / f"m{number}.yaml").write_text(
                f"catalog: robot.yaml\nevents:\n- start: TASK_{number % 300}\n- expect: {{stopped: [TASK_X]}}\n")
        mission = folder / "m1999.yaml"
        begin = time.perf_counter()
        with Client(folder) as client:
            client.open(mission)
            receive_findings(client, mission, 1)
            others = len(client.findings) - 1
            report(f"findings of the open one from the start on (after those of {others} others)",
                   [time.perf_counter() - begin])
            client.settle()
            report(f"findings of all {len(client.findings)}, with proofs", [time.perf_counter() - begin])
            report("references", [seconds_of(lambda: client.at(
                "references", mission, 2, 10, context={"includeDeclaration": True}))])
            client.open(path)
            receive_findings(client, path, 1)
            client.change(path, 2, {"range": span(0, 0, 0, 0), "text": "# one more line\n"})
            begin = time.perf_counter()
            receive_findings(client, path, 2)
            report("findings of the catalog after a key, with the pause of 100 ms", [time.perf_counter() - begin])

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name).resolve()
        path = folder / "large.yaml"
        text = catalog(34000, draw)
        path.write_text(text)
        print(f"A catalog of {len(text) / 1e6:.1f} MB")
        with Client(folder) as client:
            begin = time.perf_counter()
            client.open(path)
            receive_findings(client, path, 1)
            report("first findings", [time.perf_counter() - begin])
            measure(client, path, text, 1, draw)


if __name__ == "__main__":
    main()
