"""Do the examples of the pages of the manual, and the tutorial, do what they say?

Each page has a folder of its own, in which its literal blocks are gone through in order:

    .\\" file: NAME    the block is the file NAME
    .\\" needs: TOOL   the commands of the block are left out where there is no TOOL

The tutorial is Markdown: a line <!-- file: NAME --> comes before a file, and commands are in blocks
of the language "console"; other blocks are only to be read.

In all other blocks a line that begins with "$ " is a command for the shell, with the lines that
begin with "> " right below it; what follows is what it prints, with "..." for any number of lines.
A command that fails must be followed by `echo $?`. The commands after `cd FOLDER` run in that folder.
"""

import difflib
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pages

program = Path(sys.argv[1]).resolve()
TUTORIAL = pages.FOLDER.parent / "docs" / "tutorial.md"


class Block:
    def __init__(self, line):
        self.line = line  # of the first line of its text
        self.file = None
        self.needs = None
        self.text = []


def blocks_of(page):
    yield from blocks_of_markdown(page) if page.suffix == ".md" else blocks_of_roff(page)


def blocks_of_markdown(page):
    block = None
    file = None
    for number, line in enumerate(page.read_text().splitlines(), start=1):
        note = re.fullmatch(r"<!-- file: (\S+) -->", line)
        if note:
            file = note[1]
        elif block is None and line.startswith("```"):
            block = Block(number + 1)
            block.file = file
            is_to_run = file or line == "```console"
            file = None
        elif block is not None and line == "```":
            if is_to_run:
                yield block
            block = None
        elif block is not None:
            block.text.append(line)


def blocks_of_roff(page):
    block = Block(0)
    is_open = False
    for number, line in enumerate(page.read_text().splitlines(), start=1):
        if line.startswith(pages.WRITTEN_BY_TEST):
            return  # examples of the table of rules, which has tests of its own
        note = re.fullmatch(r'\.\\" (file|needs): (\S+)', line)
        if note:
            setattr(block, note[1], note[2])
        elif line.startswith(".Bd -literal"):
            block.line = number + 1
            is_open = True
        elif is_open and line == ".Ed":
            yield block
            block = Block(0)
            is_open = False
        elif is_open:
            block.text.append(pages.plain(line))


def commands_of(block):
    """Pairs of a command and the lines that it is to print."""
    commands = []
    for line in block.text:
        if line.startswith("$ "):
            commands.append((line[2:], []))
        elif line.startswith("> ") and commands and not commands[-1][1]:
            commands[-1] = (f"{commands[-1][0]}\n{line[2:]}", [])
        elif commands:
            commands[-1][1].append(line)
        else:
            raise ValueError(f"line {block.line}: neither a file nor a command: {line}")
    return commands


def matches(expected, found):
    pattern = "".join(
        r"(?:.*\n)*?" if line == "..." else re.escape(line) + r"\n" for line in expected
    )
    return re.fullmatch(pattern, found) is not None


class Folder:
    """Of a page; what commands change to stays for the next ones."""

    def __init__(self, path):
        self.path = path
        self.current = path

    def enter(self, name):
        self.current = self.current / name


def run_block(block, folder, environment, where):
    status = 0
    commands = commands_of(block)
    for place, (command, expected) in enumerate(commands):
        if re.fullmatch(r"cd \S+", command):
            folder.enter(command[3:])
            continue
        result = subprocess.run(
            ["sh", "-c", f"(exit {status}); {command}"],
            cwd=folder.current,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
            timeout=60,
        )
        status = result.returncode
        if not matches(expected, result.stdout):
            difference = difflib.unified_diff(
                expected, result.stdout.splitlines(), "the page", "the program", lineterm=""
            )
            yield "\n".join([f"{where}: {command}", *difference])
        is_told = place + 1 < len(commands) and commands[place + 1][0] == "echo $?"
        if status != 0 and not is_told:
            yield f"{where}: {command}: exit status {status}, which the page does not tell"


def unused_files(files, commands):
    """A file may be named itself, or a folder that it is in."""
    for file in files:
        names = [Path(file).name, *(f"{folder}/" for folder in Path(file).parents[:-1])]
        if not file.endswith(".cbc.yaml") and not any(name in commands for name in names):
            yield file


def run_page(page, folder, environment):
    files = []
    commands = ""
    for block in blocks_of(page):
        where = f"{page.name}:{block.line}"
        if block.file:
            (folder.path / block.file).parent.mkdir(parents=True, exist_ok=True)
            (folder.path / block.file).write_text("\n".join(block.text) + "\n")
            files.append(block.file)
            continue
        commands += "\n".join(command for command, _ in commands_of(block))
        if block.needs and shutil.which(block.needs) is None:
            print(f"{where}: skipped: there is no {block.needs}", file=sys.stderr)
            continue
        yield from run_block(block, folder, environment, where)
    for file in unused_files(files, commands):
        yield f"{page.name}: no command uses the file {file}"


def main():
    faults = []
    for page in [*pages.all_pages(), TUTORIAL]:
        with tempfile.TemporaryDirectory() as scratch:
            folder = Path(scratch)
            (folder / "bin").mkdir()
            (folder / "bin" / "cbc").symlink_to(program)
            work = folder / "work"
            work.mkdir()
            path = f"{folder / 'bin'}:{os.environ['PATH']}"
            environment = {"PATH": path, "LC_ALL": "C.UTF-8", "HOME": str(folder)}
            faults += run_page(page, Folder(work), environment)
    pages.finish(faults)


main()
