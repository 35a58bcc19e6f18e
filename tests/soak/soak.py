"""Hours of random cases against the brute force of tests/property, and a stream of ten million events, in which neither
memory nor descriptors may grow. Prints what was covered, also of cases that an interrupt ends.

The cases of a seed are the same everywhere, so the work can be shared out: each machine takes its own range of seeds.
"""

import argparse
import collections
import datetime
import itertools
import json
import os
import pathlib
import platform
import random
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
CATALOG = ROOT / "catalogs/quadrotor.yaml"
CASES = 400  # of one process; tests/property demands rare events only of more, and these are counted over all
ALLOWED_GROWTH = 1 << 20  # in bytes, of the resident memory


def processor():
    found = re.search(r"^model name\s*: (.*)$", pathlib.Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return f"{found[1] if found else platform.machine()}, {os.cpu_count()} cores"


# Random cases ---------------------------------------------------------------------------------------


def run_cases(tests, first, count):
    """Compares `count` cases from a seed on. Returns what happened in them, and a report of what differs."""
    environment = {**os.environ, "CBC_SEED": str(first), "CBC_PROPERTY_CASES": str(count)}
    done = subprocess.run([tests, "--gtest_filter=Property.SameEventsAsTheOracle"], env=environment, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    counts = {what: int(times) for times, what in re.findall(r"^ +(\d+)  (.*)$", done.stdout, re.MULTILINE)}
    return counts, "" if done.returncode == 0 else done.stdout


def compare(tests, seeds, hours):
    """Compares cases until the seeds or the hours are over. Returns whether all agree."""
    begin = time.monotonic()
    totals = collections.Counter()
    first, last = seeds
    seed = first
    is_interrupted = False
    while seed <= last and time.monotonic() - begin < hours * 3600 and not is_interrupted:
        count = min(CASES, last - seed + 1)
        try:
            counts, report = run_cases(tests, seed, count)
        except KeyboardInterrupt:
            is_interrupted = True
            continue
        if report:
            print(report)
            print(f"Seeds {seed} to {seed + count - 1} differ; CBC_SEED and CBC_PROPERTY_CASES repeat them.")
            return False
        totals.update(counts)
        seed += count
        if sys.stderr.isatty():
            print(f"\r{seed - first:,} cases", end="\x1b[K", file=sys.stderr)
    if sys.stderr.isatty():
        print("\r\x1b[K", end="", file=sys.stderr)
    seconds = time.monotonic() - begin
    print(f"{seed - first:,} cases, seeds {first} to {seed - 1}, in {seconds / 60:.1f} minutes: all agree. What happened:")
    for what, times in sorted(totals.items()):
        print(f"{times:14,}  {what}")
    if seed <= last:
        print(f"The next ones: --seeds {seed}")
    if is_interrupted:
        sys.exit(130)
    return True


# A long stream ---------------------------------------------------------------------------------------


def random_lines(count):
    """Lines of a stream, the same each time. They can be repeated, as none has an absolute time."""
    choose = random.Random(21)
    text = CATALOG.read_text()
    tasks = re.findall(r"^- task: (\w+)", text, re.MULTILINE)
    behaviors = re.findall(r"^- behavior: (\w+)", text, re.MULTILINE)
    lines = []
    for _ in range(count):
        verb = choose.choice(["start", "start", "start", "stop", "finish", "finish", "situation", "fault"])
        subject = choose.choice(tasks if verb in ("start", "stop") else behaviors)
        event = {verb: {subject: choose.random() < 0.9} if verb == "situation" else subject}
        if verb == "start":
            event["priority"] = choose.choice([1, 2, 2, 3])
        if verb == "finish":
            event["cause"] = choose.choice(["goal_achieved", "process_failure", "wrong_progress"])
        lines.append(json.dumps({**event, "wait": choose.choice([0, 0.5, 3])}) + "\n")
    return lines


def resources(process):
    """The resident memory in bytes, and the number of open descriptors."""
    folder = pathlib.Path(f"/proc/{process.pid}")
    pages = int((folder / "statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE"), len(list((folder / "fd").iterdir()))


def watch_stream(program, events):
    """Sends events to a stream, and looks at what it holds. Returns whether that stays the same."""
    block = "".join(random_lines(10_000)).encode()
    begin = time.monotonic()
    process = subprocess.Popen([program, "solve", CATALOG, "-", "--format", "jsonl"], stdin=subprocess.PIPE,
                               stdout=subprocess.DEVNULL)
    samples = []
    for sent in itertools.count(10_000, 10_000):
        process.stdin.write(block)
        process.stdin.flush()
        samples.append((sent, *resources(process)))
        if sent >= events:
            break
    process.stdin.close()
    status = process.wait()
    seconds = time.monotonic() - begin
    print(f"\na stream of {sent:,} events in {seconds:.0f} s: {sent / seconds:,.0f} per second")
    for place in sorted({0, *(len(samples) * tenth // 10 for tenth in range(1, 10)), len(samples) - 1}):
        sent, memory, descriptors = samples[place]
        print(f"{sent:14,} events  {memory / (1 << 20):8.2f} MiB  {descriptors} descriptors")
    early = samples[:max(1, len(samples) // 10)]
    growth = max(memory for _, memory, _ in samples) - max(memory for _, memory, _ in early)
    descriptors = {count for _, _, count in samples}
    print(f"memory after the first tenth: {growth / 1024:+.0f} KiB; descriptors: {', '.join(map(str, sorted(descriptors)))}")
    return status == 0 and growth <= ALLOWED_GROWTH and len(descriptors) == 1


def seed_range(text):
    first, _, last = text.partition("-")
    return int(first), int(last) if last else sys.maxsize


def main():
    parser = argparse.ArgumentParser(prog="./dev soak")
    parser.add_argument("hours", metavar="HOURS", nargs="?", type=float, default=1, help="of random cases (default: 1)")
    parser.add_argument("--seeds", metavar="FIRST[-LAST]", type=seed_range, default=(1, sys.maxsize),
                        help="seeds of the cases, to go on, or to share the work out (default: 1)")
    parser.add_argument("--events", metavar="N", type=int, default=10_000_000,
                        help="of the stream (default: 10000000; 0: no stream)")
    parser.add_argument("--tests", required=True, help=argparse.SUPPRESS)
    parser.add_argument("--program", required=True, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    print(f"{datetime.date.today()}, {processor()}")
    is_good = True
    if arguments.hours > 0:
        is_good = compare(arguments.tests, arguments.seeds, arguments.hours)
    if arguments.events > 0:
        is_good &= watch_stream(arguments.program, arguments.events)
    print("passed" if is_good else "FAILED")
    return 0 if is_good else 1


if __name__ == "__main__":
    sys.exit(main())
