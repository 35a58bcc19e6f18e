"""What an event costs more through Python than in C++: compare.py LIVE_EVENTS [EVENTS]

Prints microseconds for one event, with all changes carried out by nobody, and with a look at them.
Exits with 1 if Python adds more than 5 microseconds."""

import pathlib
import subprocess
import sys
import tempfile
import time

import cbc_catalog as cbc
from cbc_catalog import _program

MOST = 5.0
CATALOGS = {
    "quadrotor": ["TAKE_OFF", "FOLLOW_PATH"],
    "hospital": ["DELIVER", "DOCK"],
    "autoware": [],
}
FOLDER = pathlib.Path(__file__).resolve().parents[3] / "catalogs"


def in_python(catalog, tasks, count, looks):
    robot = cbc.Coordinator(catalog)
    calls = [(robot.start, task) for task in tasks] + [(robot.stop, task) for task in tasks]
    begin = time.perf_counter()
    for _ in range(count // len(calls)):
        for call, task in calls:
            event = call(task)
            if looks and event.accepted:
                for change in event.changes:
                    change.op, change.behavior
    return (time.perf_counter() - begin) / (count // len(calls) * len(calls)) * 1e6


def in_cpp(program, catalog, tasks, count):
    with tempfile.TemporaryDirectory() as folder:
        compiled = f"{folder}/catalog.cbc"
        subprocess.run([_program.program(), "compile", catalog.path, "-o", compiled], check=True,
                       stdout=subprocess.DEVNULL)
        done = subprocess.run([program, compiled, str(count), *tasks], check=True, stdout=subprocess.PIPE)
    return float(done.stdout) / 1000


def main():
    program = sys.argv[1]
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 1_000_000
    print(f"{count} events; microseconds for one")
    print(f"{'catalog':<12} {'C++':>8} {'Python':>8} {'more':>8} {'with a look':>12}")
    is_met = True
    for name, tasks in CATALOGS.items():
        catalog = cbc.Catalog(FOLDER / f"{name}.yaml")
        tasks = tasks or list(catalog.tasks)[:2]
        cpp = in_cpp(program, catalog, tasks, count)
        python = in_python(catalog, tasks, count, False)
        looking = in_python(catalog, tasks, count, True)
        is_met &= python - cpp <= MOST
        print(f"{name:<12} {cpp:8.2f} {python:8.2f} {python - cpp:8.2f} {looking:12.2f}")
    return 0 if is_met else 1


if __name__ == "__main__":
    sys.exit(main())
