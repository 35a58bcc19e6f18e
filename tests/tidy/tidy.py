#!/usr/bin/env python3
"""clang-tidy over all sources of a CMake build, many of them in one translation unit.

Nearly all of the time of clang-tidy goes to the headers of libraries, which it examines once for each translation unit.
So sources with the same flags and the same configuration are joined. What cannot be joined, as two sources define the
same name, waits for the next unit. Sources are joined as text, not included: some checks look only at the main file.
"""

import argparse
import concurrent.futures
import dataclasses
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

SOURCES = 16  # joined at most; with more, the unit that is analyzed last takes long alone
INCLUDE = re.compile(r'\s*#\s*include\s+(["<])([^">]+)[">]')
PLACE = re.compile(r"^(?P<path>/[^:\n]+):(?P<line>\d+):(?P<column>\d+): (?P<kind>[a-z ]+):", re.MULTILINE)


def main():
    options = read_options()
    commands = json.loads((options.build / "compile_commands.json").read_text())
    units_dir = options.build / "tidy"
    shutil.rmtree(units_dir, ignore_errors=True)
    units_dir.mkdir()
    groups, known = {}, set()
    for command in commands:
        path = pathlib.Path(command["file"])
        if options.build not in path.parents and path not in known:
            known.add(path)  # it may belong to several programs
            groups.setdefault((flags_of(command), configuration_of(path)), {})[path] = None
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        units = [unit for units in pool.map(lambda group: join(*group, units_dir), enumerate(groups.items()))
                 for unit in units]
        sources = sum(len(unit.sources) for unit in units)
        print(f"{sources} sources in {len(units)} translation units", flush=True)
        seen = set()
        for findings in pool.map(examine, units):
            for finding in findings:
                if finding not in seen:  # one in a header is found by each unit
                    seen.add(finding)
                    print(finding, flush=True)
    sys.exit(1 if seen else 0)


def read_options():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("build", type=lambda path: pathlib.Path(path).resolve(),
                        help="folder of a build with compile_commands.json, without precompiled headers")
    return parser.parse_args()


def flags_of(command):
    """The command that compiles a source, without the source and the output."""
    words = shlex.split(command["command"])
    output = words.index("-o")
    del words[output:output + 2]
    words.remove("-c")
    words.remove(command["file"])
    return tuple(words)


def configuration_of(source):
    """The file that decides what clang-tidy says about a source."""
    return next(path for path in (folder / ".clang-tidy" for folder in source.parents) if path.exists())


@dataclasses.dataclass(frozen=True)
class Unit:
    path: pathlib.Path
    flags: tuple
    configuration: pathlib.Path
    sources: tuple
    starts: tuple  # by source: how many lines are before it

    def place(self, match):
        """A place in a source instead of the one in the unit."""
        if match["path"] != str(self.path):
            return match[0]
        line = int(match["line"])
        index = max(i for i, start in enumerate(self.starts) if start < line)
        return f"{self.sources[index]}:{line - self.starts[index]}:{match['column']}: {match['kind']}:"


def join(number, group, folder):
    """The units of the sources that have these flags and this configuration."""
    settings, left = group[0], list(group[1])
    units = []
    while left:
        chosen, left = left[:SOURCES], left[SOURCES:]
        while True:
            unit = write_unit(folder / f"{number}_{len(units)}.cpp", settings, chosen)
            wrong = find_wrong(unit) - {chosen[0]}
            if not wrong:
                break
            left = [source for source in chosen if source in wrong] + left
            chosen = [source for source in chosen if source not in wrong]
        units.append(unit)
    return units


def write_unit(path, settings, sources):
    lines, starts, included = [], [], set()
    for source in sources:
        starts.append(len(lines))
        here = set()
        for line in source.read_text().splitlines():
            include = INCLUDE.match(line)
            if include:
                name = include[2]
                if include[1] == '"' and (source.parent / name).exists():
                    name = str((source.parent / name).resolve())
                # What an earlier source includes must not count as included twice.
                line = "" if name in included and name not in here else line.replace(include[2], name)
                here.add(name)
            lines.append(line)
        included |= here
    path.write_text("\n".join(lines) + "\n")
    return Unit(path, *settings, tuple(sources), tuple(starts))


def find_wrong(unit):
    """The sources that do not compile behind those before them."""
    command = [*unit.flags, "-fsyntax-only", "-w", "-ferror-limit=0", str(unit.path)]
    output = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False).stderr
    places = [PLACE.match(unit.place(match)) for match in PLACE.finditer(output)]
    wrong = {pathlib.Path(place["path"]) for place in places if place["kind"].endswith("error")}
    if wrong and not wrong & set(unit.sources):
        return set(unit.sources[len(unit.sources) // 2:])  # an error in a header
    return wrong & set(unit.sources)


def examine(unit):
    """The findings, each with its notes."""
    command = ["clang-tidy", "--quiet", f"--config-file={unit.configuration}", str(unit.path), "--", *unit.flags[1:]]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    findings = []
    for part in re.split(r"^(?=/[^:\n]+:\d+:\d+: (?:warning|error|fatal error):)", done.stdout, flags=re.MULTILINE):
        if part.strip():
            findings.append(PLACE.sub(unit.place, part).rstrip("\n"))
    if done.returncode != 0 and not findings:
        findings.append(f"{unit.path}: clang-tidy ended with status {done.returncode}:\n{done.stderr.strip()}")
    return findings


if __name__ == "__main__":
    main()
