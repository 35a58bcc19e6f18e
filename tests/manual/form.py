"""Are the pages well-formed? man (with groff) and mandoc must have nothing to say about them."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pages

# mandoc looks for other pages where they are installed; those of this manual are not, or not these.
OF_INSTALLED_PAGES = re.compile(r"STYLE: referenced manual not found|outdated mandoc.db lacks")


def lost_references():
    known = {page.name for page in pages.all_pages()}
    for page in pages.all_pages():
        for name, section in re.findall(r"^\.Xr (cbc\S*) (\d)", page.read_text(), re.MULTILINE):
            if f"{name}.{section}" not in known:
                yield f"{page.name}: there is no page {name}({section})"


def is_man_db():
    result = subprocess.run(["man", "--version"], capture_output=True, text=True)
    return result.stdout.startswith("man ")


def complaints_of_man(page):
    command = ["man", "--warnings=all", "-E", "UTF-8", "-l", "-Tutf8", "-Z", str(page)]
    environment = {**os.environ, "LC_ALL": "C.UTF-8", "MANROFFSEQ": "", "MANWIDTH": "80"}
    result = subprocess.run(command, env=environment, capture_output=True, text=True)
    complaints = result.stderr.splitlines()
    if result.returncode != 0 or not result.stdout:
        complaints.append(f"man cannot print it: exit status {result.returncode}")
    return complaints


def complaints_of_mandoc(page):
    command = ["mandoc", "-mdoc", "-Tlint", "-Wall", str(page)]
    result = subprocess.run(command, capture_output=True, text=True)
    lines = (result.stdout + result.stderr).splitlines()
    return [line for line in lines if not OF_INSTALLED_PAGES.search(line)]


def characters_not_as_typed(page):
    """In a literal block groff prints these as other characters, which no shell understands; and
    what is not ASCII has a name in roff, which all printers of pages know."""
    is_literal = False
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), start=1):
        if not line.isascii():
            yield f"{page.name}:{number}: not ASCII: {line}"
        if line.startswith(".Bd -literal"):
            is_literal = True
        elif line.startswith(".Ed"):
            is_literal = False
        elif is_literal and re.search(r"(?<!\\)-|['`^~]", line):
            yield f"{page.name}:{number}: escape - ' ` ^ ~ in a literal block: {line}"


def found_by_man(page):
    """With the program of the build on the PATH."""
    path = f"{Path(sys.argv[1]).parent}:{os.environ['PATH']}"
    environment = {name: value for name, value in os.environ.items() if name != "MANPATH"}
    command = ["man", "-w", page.suffix[1:], page.stem]
    result = subprocess.run(command, env={**environment, "PATH": path}, capture_output=True, text=True)
    return result.returncode == 0 and Path(result.stdout.strip()).samefile(page)


def main():
    pages.require("man", "mandoc")
    if not is_man_db():
        pages.skip("man is not that of man-db, which has --warnings")
    faults = list(lost_references())
    for page in pages.all_pages():
        faults += [f"{page.name}: man: {line}" for line in complaints_of_man(page)]
        faults += complaints_of_mandoc(page)
        faults += characters_not_as_typed(page)
        if not found_by_man(page):
            faults.append(f"{page.name}: man does not find it beside the program")
    pages.finish(faults)


main()
