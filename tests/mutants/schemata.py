"""Writes sources in which each mutant can be selected at run time, and builds the tests with them."""

import concurrent.futures
import dataclasses
import hashlib
import itertools
import pathlib
import re
import subprocess

import points

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = ROOT / "build" / "mutants"
PROGRAMS = {"unit": "cbc_unit_tests", "commands": "cbc_command_tests", "property": "cbc_property_tests",
            "golden": "cbc_golden_tests"}
FLAGS = ["-std=c++20", *(f"-I{folder}" for folder in (ROOT / "include", ROOT / "src", BUILD / "include", BUILD / "generated"))]
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)


@dataclasses.dataclass(frozen=True)
class Mutant:
    number: int  # from 1
    path: str  # from the root
    line: int
    column: int
    kind: str
    before: str  # its lines in the source
    after: str
    key: str  # the same for the same change of the same source


def find_mutants(paths, jobs):
    """All mutants of these sources, the mutated sources by path, and what was skipped, by reason."""
    mutants, texts, skipped = [], {}, {}
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        trees = pool.map(points.find_points, (ROOT / path for path in paths), itertools.repeat(FLAGS))
    for path, (found, reasons) in zip(paths, trees):
        source = (ROOT / path).read_bytes().decode("latin-1")
        first = len(mutants) + 1
        digest = hashlib.sha1(source.encode("latin-1")).hexdigest()[:8]
        for point in found:
            for change in point.changes:
                mutants.append(describe(source, path, digest, len(mutants) + 1, change))
        texts[path] = '#include "mutant.h"\n#line 1\n' + points.write_mutated(source, found, first)
        for reason, times in reasons.items():
            skipped[reason] = skipped.get(reason, 0) + times
    return mutants, texts, skipped


def describe(source, path, digest, number, change):
    line = source.count("\n", 0, change.begin) + 1
    start = source.rfind("\n", 0, change.begin) + 1
    end = source.find("\n", change.end)
    column = change.begin - start + 1
    before = source[start:end]
    after = source[start:change.begin] + change.text + source[change.end:end]
    key = f"{path}:{line}:{column}:{change.kind}:{' '.join(change.text.split())}:{digest}"
    return Mutant(number, path, line, column, change.kind, before, after, key)


def find_affected(mutated):
    """The sources (.cpp) that are compiled with the mutated ones: these, and what includes a mutated header."""
    texts = {str(path.relative_to(ROOT)): path.read_text() for path in (ROOT / "src").rglob("*")
             if path.suffix in (".h", ".cpp")}
    affected = set(mutated)
    while True:
        more = {path for path, text in texts.items() if path not in affected and any(
            "src/" + name in affected for name in INCLUDE.findall(text))}
        if not more:
            return sorted(path for path in affected if path.endswith(".cpp"))
        affected |= more


def write_if_new(path, text):
    """Keeps the time of a file that has this text already, so that it is not compiled again."""
    data = text.encode("latin-1")
    if not path.exists() or path.read_bytes() != data:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def prepare():
    """What the compiler needs to read the sources."""
    subprocess.run(["cmake", "--preset", "mutants"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--build", str(BUILD), "--target", "generated/catalog_generated.h"], check=True,
                   stdout=subprocess.DEVNULL)


def build(texts, jobs):
    """Builds the tests with these mutated sources, by path, and with no others."""
    for old in (BUILD / "mutated").rglob("*.*"):
        if old.is_file() and str(old.relative_to(BUILD / "mutated")) not in texts:
            old.unlink()
    for path, text in texts.items():
        write_if_new(BUILD / "mutated" / path, text)
    mutated = [path for path in texts if path.endswith(".cpp")]
    write_if_new(BUILD / "mutated.cmake", f"set(mutated_sources {' '.join(mutated)})\n"
                                          f"set(affected_sources {' '.join(find_affected(texts))})\n")
    subprocess.run(["cmake", "--preset", "mutants"], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    command = ["cmake", "--build", str(BUILD), "--parallel", str(jobs), "--target", *PROGRAMS.values()]
    subprocess.run(command, check=True)
