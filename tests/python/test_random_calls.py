"""Random calls with wrong types, wrong names, threads, forks, pickles and copies: each returns, or raises
what it may raise. CBC_PYTHON_CALLS says how many (2,000)."""

import copy
import math
import os
import pickle
import random
import threading

import cbc_catalog as cbc
from conftest import ROBOT

CALLS = int(os.environ.get("CBC_PYTHON_CALLS", "2000"))
ALLOWED = (cbc.Error, TypeError, UnicodeError)
CATALOG = cbc.Catalog.from_text(ROBOT)

ODD = [None, True, 0, 1, 2, -1, 10**40, 1.5, math.nan, math.inf, "", "DRIVE", "LIFT", "SLAM", "DRIVE_FAST",
       "PEOPLE", "near", "RAIN", "A\0", "\ud800", "ü" * 1000, b"DRIVE", [], {}, {"speed": 1}, {"PEOPLE": "far"},
       {"RAIN": True}, {"SLAM": False}, {1: 2}, (), (1, 2), object(), CATALOG, "goal_achieved",
       "process_failure", 1j, lambda: None]
NAMES = ["DRIVE", "LIFT", "LOCALIZE", "SIGNAL", *CATALOG.behaviors]
VERBS = ["start", "stop", "finish", "fault", "repair", "why"]


def call_with_names(robot, draw):
    """A call that may well succeed."""
    verb = draw.choice([*VERBS, "advance", "situation", "options"])
    at = draw.choice([None, robot.now + draw.random() * 3])
    if verb == "advance":
        return robot.advance(robot.now + draw.random())
    if verb == "situation":
        return robot.situation(PEOPLE=draw.choice(["none", "near", "far"]), RAIN=draw.random() < 0.5, at=at)
    if verb == "options":
        return robot.options()
    if verb == "why":
        return robot.why(draw.choice(NAMES))
    return getattr(robot, verb)(draw.choice(NAMES), at=at)


def call_with_anything(robot, draw):
    verb = draw.choice([*VERBS, "advance", "situation", "restore", "options", "save", "__setstate__", "__init__", "from_text"])
    arguments = [draw.choice(ODD) for _ in range(draw.randrange(3))]
    named = {name: draw.choice(ODD) for name in ("at", "priority", "parameters", "cause", "PEOPLE")
             if draw.random() < 0.2}
    if verb == "__init__":
        return cbc.Coordinator(*arguments, **named)
    if verb == "from_text":
        return cbc.Catalog.from_text(*arguments)
    if verb == "__setstate__":
        return cbc.Coordinator.__new__(cbc.Coordinator).__setstate__(tuple(draw.choices(ODD, k=4)))
    return getattr(robot, verb)(*arguments, **named)


def look(robot, event):
    """All that can be asked of what a call returned."""
    for value in event if isinstance(event, (tuple, list)) else [event]:
        if isinstance(value, cbc.Option):
            value = value.event
        if isinstance(value, cbc.Event):
            assert value.why()
            assert value.to_json()["outcome"] == value.outcome
            repr((value, value.changes, value.stopped, value.before, value.after))
            assert copy.copy(value) is value
    repr(robot)
    assert set(robot.requests) <= set(robot.running)
    assert robot.next_due is None or robot.next_due >= robot.now


def duplicate(robot, draw):
    kind = draw.randrange(3)
    if kind == 0:
        return copy.deepcopy(robot)
    if kind == 1:
        return pickle.loads(pickle.dumps(robot))
    other = cbc.Coordinator(CATALOG)
    other.restore(robot.save())
    return other


def use_in_threads(robot):
    """One robot, from several threads at once."""
    unexpected = []

    def use(seed):
        draw = random.Random(seed)
        for _ in range(20):
            try:
                call_with_names(robot, draw)
            except cbc.UsageError:
                pass  # the clock has moved on
            except ALLOWED:
                pass
            except BaseException as error:  # pylint: disable=broad-except
                unexpected.append(error)

    threads = [threading.Thread(target=use, args=(seed,)) for seed in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not unexpected


def use_in_fork(robot, draw):
    child = os.fork()
    if child == 0:
        status = 1
        try:
            look(robot, robot.start("DRIVE"))
            copy.deepcopy(robot)
            status = 0
        finally:
            os._exit(status)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


def test_random_calls():
    draw = random.Random(int(os.environ.get("CBC_PYTHON_SEED", "1")))
    robot = cbc.Coordinator(CATALOG)
    succeeded = 0
    for number in range(CALLS):
        state = robot.save() if number % 7 == 0 else None
        try:
            call = call_with_names if draw.random() < 0.5 else call_with_anything
            event = call(robot, draw)
            succeeded += 1
            if draw.random() < 0.3:
                look(robot, event)
        except ALLOWED:
            assert state is None or robot.save() == state  # nothing has changed
        if draw.random() < 0.05:
            robot = duplicate(robot, draw)
        if robot.now > 10**8:
            robot = cbc.Coordinator(CATALOG)
        if number % 500 == 250:
            use_in_threads(robot)
        if number % 1000 == 750:
            use_in_fork(robot, draw)
    assert succeeded > CALLS / 4
