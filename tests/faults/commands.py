"""The commands that write files, with small inputs: each fault is tried with each of them."""

import dataclasses
import os
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("CBC_PROGRAM", str(ROOT / "build/release/cbc"))

# robot.yaml has a warning that the settings allow, so that a run without the settings shows.
INPUTS = {
    ".cbc.yaml": "allow: [duplicate-exclusion]\n",
    "robot.yaml": """\
tasks: [{task: DRIVE}, {task: DOCK}]
behaviors:
- {behavior: WHEELS, task: DRIVE, suitability: 80, timeout: 5}
- {behavior: TRACKS, task: DRIVE, suitability: 60}
- {behavior: CABLE, task: DOCK}
exclusivity_constraints:
- mutually_exclusive: [DRIVE, DOCK]
- mutually_exclusive: [DOCK, DRIVE]
""",
    "older/old.yaml": "tasks: [{task: DRIVE}]\nbehaviors: [{behavior: WHEELS, task: DRIVE, efficacy: 80}]\n",
    "missions/first.yaml": "- {fault: WHEELS}\n- {start: DRIVE}\n- expect: {running: {DRIVE: TRACKS}}\n",
    "missions/second.yaml": "- {start: DOCK}\n- expect: {running: {DOCK: CABLE}}\n",
    "robot.properties.yaml": "catalog: robot.yaml\nproperties: [{never: {running: [DOCK]}}]\n",
    "stream.jsonl": '{"start": "DRIVE", "at": 1}\n{"start": "DOCK", "at": 2, "priority": 2}\n',
}
OLD = "an old output\n"  # which a run replaces


@dataclasses.dataclass(frozen=True)
class Command:
    """A command line, and the files that it writes. Its input is a file of the folder."""
    name: str
    arguments: str
    outputs: tuple
    status: int = 0
    stdin: str = os.devnull
    replaces: bool = True  # an output that exists already
    repeats: bool = True  # it can be run again
    ends_early: bool = False  # if it fails, the output has what was done until then, in JSON

    def __str__(self):
        return self.name

    def line(self):
        return [PROGRAM, *self.arguments.split()]


COMMANDS = [
    Command("compile", "compile robot.yaml -o robot.cbc", ("robot.cbc",)),
    Command("solve_html", "solve robot.yaml missions -j 1 --html page.html", ("page.html",)),
    Command("coverage", "coverage robot.yaml missions -j 1 --format html -o coverage.html", ("coverage.html",)),
    Command("solve_state", "solve robot.yaml - --format jsonl --state-out state.json", ("state.json",),
            stdin="stream.jsonl", ends_early=True),
    Command("sweep", "sweep robot.yaml --sequences 5 -j 1 --slowest slow.yaml", ("slow.yaml",)),
    Command("graph_dot", "graph robot.yaml -o robot.dot", ("robot.dot",)),
    Command("graph_svg", "graph robot.yaml -o robot.svg", ("robot.svg",)),
    Command("lint_fix", "lint --fix older", ("older/old.yaml",)),
    Command("rename", "rename task DRIVE RIDE robot.yaml missions", ("robot.yaml", "missions/first.yaml"),
            repeats=False),
    Command("init", "init project", tuple("project/" + name for name in (
        "robot.yaml", "missions/delivery.yaml", ".cbc.yaml", "ci.sh", ".cbc/catalog.json", ".cbc/script.json",
        ".cbc/settings.json")), replaces=False, repeats=False),
    Command("verify", "verify robot.properties.yaml -j 1 --format json -o result.json --html page.html --scripts scripts",
            ("result.json", "page.html", "scripts/robot.2.mission.yaml"), status=1),
    Command("effects", "verify robot.yaml --effects --format csv -o effects.csv --html page.html",
            ("effects.csv", "page.html")),
    Command("cut_sets", "verify robot.yaml -j 1 --cut-sets DRIVE -o sets.txt", ("sets.txt",)),
]


def fill(folder, command, has_old):
    """Puts the inputs into a folder and, if `has_old`, files that the command is to replace."""
    folder.mkdir()
    for name, text in INPUTS.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(text)
    if has_old and command.replaces:
        for name in command.outputs:
            if name not in INPUTS:
                (folder / name).parent.mkdir(exist_ok=True)
                (folder / name).write_text(OLD)


def contents(folder):
    """All regular files of a folder, by their names in it."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
