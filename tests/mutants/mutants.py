#!/usr/bin/env python3
"""Mutates sources of the project, and runs the tests with each mutant: those that survive show what no test looks at.

All mutants are in one build: the mutated sources ask for the number of the one that is active. A mutant is tried with
the tests that reach it, unit tests first, and stops at the first that fails; it is killed as well if a test crashes,
takes 10 times its usual processor time (and 5 s more), or 4 GiB. Results are added to build/mutants/results.tsv,
and what is there already is not tried again, unless the source has changed.
"""

import argparse
import os
import pathlib
import random
import sys

import report
import schemata
import trials

DEFAULT_PATHS = ["src/runtime/solver", "src/runtime/coordinator", "src/why", "src/runtime/compiled/log_cost.cpp",
                 "src/runtime/compiled/verify.cpp"]
SEED = 1
PROPERTY_CASES = 150
RANDOM_PERCENT = 20
RESULTS = schemata.BUILD / "results.tsv"


def main():
    options = read_options()
    paths = list_sources(options.paths)
    print(f"Reading {len(paths)} sources", flush=True)
    schemata.prepare()
    mutants, texts, skipped = schemata.find_mutants(paths, options.jobs)
    chosen = choose(mutants, options)
    places = ", ".join(f"{times} {reason}" for reason, times in sorted(skipped.items()))
    print(f"{len(mutants)} mutants; left out as they cannot be selected at run time: {places or 'none'}", flush=True)
    if not options.report:
        schemata.build(texts, options.jobs)
        try_all(len(mutants), chosen, options)
    report.print_report(chosen, read_results(), sys.stdout)


def read_options():
    parser = argparse.ArgumentParser(prog="./dev mutants", description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("paths", nargs="*", metavar="FILE", default=[schemata.ROOT / path for path in DEFAULT_PATHS],
                        help="sources and folders in src (default: the solver, the coordinator, the verification of "
                             "compiled files, and costs)")
    parser.add_argument("--sample", type=read_count, metavar="N", help="N of the mutants, always the same ones")
    parser.add_argument("--shard", type=read_shard, metavar="I/N", default=(1, 1),
                        help="the I-th of N parts; concatenate their results.tsv")
    parser.add_argument("--again", action="store_true", help="try those that survived once more, after adding tests")
    parser.add_argument("--report", action="store_true", help="print the results that are there, and try nothing")
    parser.add_argument("--jobs", type=read_count, metavar="N", default=len(os.sched_getaffinity(0)),
                        help="compile N sources at a time")
    return parser.parse_args()


def read_count(text):
    if not text.isdecimal() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"expected a number from 1 on, found '{text}'")
    return int(text)


def read_shard(text):
    part, slash, parts = text.partition("/")
    if not (slash and part.isdecimal() and parts.isdecimal() and 1 <= int(part) <= int(parts)):
        raise argparse.ArgumentTypeError(f"expected I/N with I from 1 to N, found '{text}'")
    return int(part), int(parts)


def list_sources(paths):
    sources = []
    for path in paths:
        full = pathlib.Path(path).resolve()
        files = sorted(full.rglob("*")) if full.is_dir() else [full]
        found = [file for file in files if file.suffix in (".h", ".cpp") and (schemata.ROOT / "src") in file.parents]
        if not found or not full.exists():
            sys.exit(f"mutants: {path}: expected a source or a folder in src/ of the project")
        sources += [str(file.relative_to(schemata.ROOT)) for file in found]
    return sources


def choose(mutants, options):
    chosen = mutants
    if options.sample and options.sample < len(mutants):
        chosen = sorted(random.Random(SEED).sample(mutants, options.sample), key=lambda mutant: mutant.number)
    part, parts = options.shard
    return chosen[part - 1::parts]


def read_results():
    """The last result of each mutant, by its key."""
    results = {}
    if RESULTS.exists():
        for line in RESULTS.read_text().splitlines():
            key, verdict, by, seconds = line.split("\t")
            results[key] = trials.Result(verdict, by, float(seconds))
    return results


def try_all(count, chosen, options):
    results = read_results()
    open_mutants = [mutant for mutant in chosen if mutant.key not in results or
                    (options.again and results[mutant.key].verdict != "killed")]
    if not open_mutants:
        return
    environment = {"CBC_PROPERTY_CASES": str(PROPERTY_CASES), "CBC_RANDOM_PERCENT": str(RANDOM_PERCENT)}
    print("Running the tests without mutants", flush=True)
    tests, failed = trials.record(count, environment)
    print(f"{len(tests)} tests, {sum(test.seconds for test in tests):.0f} s of processor time; left out, as they fail "
          f"without mutants: {', '.join(failed) or 'none'}", flush=True)
    random.Random(SEED).shuffle(open_mutants)  # so that a part of a run is a sample
    runner = trials.Trials(tests, environment)
    with RESULTS.open("a") as file:
        for tried, mutant in enumerate(open_mutants, 1):
            result = runner.try_mutant(mutant)
            print(mutant.key, result.verdict, result.by, f"{result.seconds:.1f}", sep="\t", file=file, flush=True)
            print(f"{tried}/{len(open_mutants)} {mutant.path}:{mutant.line}:{mutant.column} {mutant.kind}: "
                  f"{result.verdict} ({result.by})", flush=True)


if __name__ == "__main__":
    main()
