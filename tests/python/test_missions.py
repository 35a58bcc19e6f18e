"""Missions through Python and through `cbc solve`: each event is the same."""

import json
import os
import pathlib

import pytest

import cbc_catalog as cbc
from conftest import SOURCE, run_cbc


def find_missions():
    """Folder, catalog and script of all missions of catalogs/ and of the golden cases that are run."""
    for script in sorted(SOURCE.glob("catalogs/*.mission.yaml")):
        yield SOURCE, [str(script.relative_to(SOURCE))]
    for script in sorted(SOURCE.glob("catalogs/missions/*.yaml")):
        yield SOURCE, [str(script.relative_to(SOURCE))]
    seen = set()
    cases = pathlib.Path(os.environ["CBC_CASES"])
    for case in json.loads((cases / "cases.json").read_text()):
        folder = cases / case["case"]
        # A number in Python is not 0.50 and 0.5, which these tell apart.
        if folder.name in ("restart", "restart_text"):
            continue
        for words in (command["arguments"] for command in case["commands"]):
            files = [word for word in words[1:] if (folder / word).is_file()]
            key = tuple((folder / file).read_bytes() for file in files)  # of several cases, it is run once
            if words[:1] == ["solve"] and files and key not in seen and "--state-in" not in words:
                seen.add(key)
                at = (folder / files[0]).parent  # a compiled catalog names the one beside it
                yield at, [os.path.relpath(folder / file, at) for file in files]


def lines_of(folder, files):
    """The header and the events of a mission; None: it cannot be run by itself."""
    status, output, _ = run_cbc("solve", "--format", "jsonl", "--max-clock-events", 2000, *files, cwd=folder)
    if status not in (0, 1):
        return None
    lines = [json.loads(line) for line in output.splitlines()]
    return lines[0], [line for line in lines[1:] if "verb" in line]


def call(robot, event):
    """Does in Python what an event of a script says."""
    at = event["time"]
    verb = event["verb"]
    if verb == "start":
        return robot.start(event["name"], event["priority"], at=at, parameters=event.get("parameters"))
    if verb == "stop":
        return robot.stop(event["name"], priority=event["priority"], at=at)
    if verb == "finish":
        return robot.finish(event.get("task", event["name"]), event["cause"], at=at)
    if verb == "situation":
        return robot.situation(event["situation"], at=at)
    return getattr(robot, verb)(event["name"], at=at)


def replay(header, events, catalog):
    robot = cbc.Coordinator(catalog, situation=header["situation"], timeouts=header.get("timeouts", True),
                            reactive_delay=header["reactive_delay"])
    made = []
    for event in events:
        if event["origin"] == "script" and event["verb"] != "wait":
            done = call(robot, event)
            made += [*done.before, done, *done.after]
    state = robot.running, robot.requests
    rest = robot.advance(max(events[-1]["time"] if events else 0, robot.now))
    return made + list(rest), (robot.running, robot.requests) if rest else state


def comparable(event):
    """Without what counts events, since waits are none in Python."""
    event = json.loads(json.dumps(event))
    for name in ("index", "variables", "parameters"):
        event.pop(name, None)
    if event.get("task") == event.get("name"):
        event.pop("task", None)  # of a name that a task and a behavior have, Python takes the behavior
    for stopped in event["stopped_tasks"]:
        stopped.pop("message", None)
        stopped.pop("conflict", None)
    return event


MISSIONS = list(find_missions())
COMPARED = []


@pytest.mark.parametrize("folder, files", MISSIONS, ids=[f"{m[0].name}-{m[1][-1]}" for m in MISSIONS])
def test_same_as_solve(folder, files, monkeypatch):
    lines = lines_of(folder, files)
    if lines is None:
        return
    COMPARED.append(files)
    header, events = lines
    monkeypatch.chdir(folder)
    try:
        made, state = replay(header, events, cbc.Catalog(header["catalog"]))
    except cbc.UsageError as error:
        # In a script it is a warning.
        assert str(error) in run_cbc("solve", *files, cwd=folder)[2]
        return
    expected = [comparable(event) for event in events if event["verb"] != "wait"]
    assert [comparable(event.to_json()) for event in made] == expected
    # The members of an event say the same as its JSON.
    for event, written in zip(made, expected):
        assert (event.outcome, event.verb, event.origin) == (
            written["outcome"], written["verb"], written["origin"])
        assert [(c.op, c.behavior, list(c.tasks), c.cause, c.priority, c.success)
                for c in event.changes] == [tuple(c.values()) for c in written["changes"]]
        assert [(s.task, s.cause) for s in event.stopped] == [
            (s["task"], s["cause"]) for s in written["stopped_tasks"]]
        assert event.time == written["time"]
    if expected:
        assert state == (expected[-1]["running"], expected[-1]["requests"])


def test_enough_missions_are_compared():
    """Of all; where some run elsewhere, as with xdist, of these."""
    assert len(MISSIONS) >= 160
    assert not COMPARED or len(COMPARED) > 80 or "PYTEST_XDIST_WORKER" in os.environ
