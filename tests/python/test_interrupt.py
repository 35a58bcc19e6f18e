"""Ctrl-C in long events, and threads beside them."""

import os
import random
import signal
import threading
import time

import pytest

import cbc_catalog as cbc
from conftest import run_python

# Two behaviors that time out in turn, for ever: a second of it are a thousand events of the clock.
CYCLE = """
behaviors:
- {behavior: A, task: GO}
- {behavior: B, task: GO}
tasks:
- {task: GO, timeout: 0.001}
"""


def endless_robot():
    robot = cbc.Coordinator(cbc.Catalog.from_text(CYCLE))
    robot.start("GO")
    return robot


def interrupt_after(seconds):
    threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT)).start()


def hard_catalog():
    """A random constraint problem at the point where most are hard: JOB needs all parts, each part has six
    ways, and of some pairs of parts a part of the ways exclude one another. To find the best answer takes very long."""
    draw = random.Random(3)
    parts, ways = range(100), range(6)
    behaviors = ["- {behavior: DO, task: JOB, requires: [" + ", ".join(f"{{task: P{part}}}" for part in parts) + "]}"]
    tasks = ["- {task: JOB}"]
    for part in parts:
        tasks.append(f"- {{task: P{part}, start_on_request: false, execution_goal: keep_running}}")
        for way in ways:
            name = f"{part}_{way}"
            behaviors.append(f"- {{behavior: B{name}, task: P{part}, suitability: {draw.randrange(30, 100)}, "
                             f"requires: [{{task: W{name}}}]}}")
            behaviors.append(f"- {{behavior: V{name}, task: W{name}}}")
            tasks.append(f"- {{task: W{name}, start_on_request: false, execution_goal: keep_running}}")
    pairs = [(one, other, a, b) for one, other in [draw.sample(parts, 2) for _ in range(500)] for a in ways
             for b in ways if draw.random() < 0.22]
    lists = [f"- mutually_exclusive: [W{one}_{a}, W{other}_{b}]" for one, other, a, b in pairs]
    return cbc.Catalog.from_text("\n".join(["behaviors:", *behaviors, "tasks:", *tasks,
                                            "exclusivity_constraints:", *lists]))


def check_interrupted(robot, call):
    before = robot.save()
    interrupt_after(0.3)
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        call()
    assert time.monotonic() - begin < 10  # it takes 0.4 s; a test does not depend on that
    assert robot.save() == before


def test_ctrl_c_while_the_clock_runs():
    robot = endless_robot()
    check_interrupted(robot, lambda: robot.advance(1e6))
    assert len(robot.advance(1)) > 10


def test_ctrl_c_in_a_search():
    robot = cbc.Coordinator(hard_catalog())
    check_interrupted(robot, lambda: robot.start("JOB"))
    assert robot.fault("B0_0").outcome == "unchanged"


def test_ctrl_c_in_questions():
    robot = cbc.Coordinator(hard_catalog(), max_nodes=15000)  # seconds of search, which questions repeat
    check_interrupted(robot, robot.options)
    event = robot.start("JOB")
    assert event.accepted
    for question in (lambda: robot.why("JOB"), event.why, event.to_json):
        check_interrupted(robot, question)


def test_a_limit_ends_a_search():
    robot = cbc.Coordinator(hard_catalog(), time_limit=0.1)
    event = robot.start("JOB")
    assert event.accepted and not event.proven


def test_what_a_limit_of_time_left_is_what_is_told():
    """To search again would end elsewhere."""
    robot = cbc.Coordinator(hard_catalog(), time_limit=0.05)
    event = robot.start("JOB")
    assert event.to_json()["running"] == robot.running
    assert "time limit" in event.why()
    assert "time limit" in robot.why("JOB")


def test_too_many_events_of_the_clock():
    robot = endless_robot()
    why = robot.why("GO")
    with pytest.raises(cbc.Error, match="more than 1000000 events in one call"):
        robot.advance(1e6)
    assert robot.now == 0
    assert robot.why("GO") == why


def test_ctrl_c_while_another_thread_has_the_turn():
    robot = endless_robot()
    began = threading.Event()

    def work():
        began.set()
        with pytest.raises(cbc.Error):
            robot.advance(1e6)

    thread = threading.Thread(target=work)
    thread.start()
    began.wait()
    time.sleep(0.05)
    interrupt_after(0.1)
    with pytest.raises(KeyboardInterrupt):
        for _ in range(1000):
            robot.now
    thread.join()


EXIT = """
import sys, threading, time
sys.path.insert(0, {folder!r})
from test_interrupt import endless_robot
robot = endless_robot()
threading.Thread(target=lambda: robot.advance(1e6), daemon=True).start()
time.sleep(0.2)
"""


def test_the_process_may_end_while_a_thread_is_in_a_call():
    status, output = run_python("-c", EXIT.format(folder=os.path.dirname(__file__)))
    assert (status, output) == (0, "")


def test_other_threads_go_on_while_a_call_is_long():
    robot = endless_robot()
    counted = [0]
    is_done = threading.Event()

    def count():
        while not is_done.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    robot.advance(300)
    made = counted[0] - before
    is_done.set()
    thread.join()
    assert made > 1000


def test_a_signal_handler_cannot_use_the_robot_in_a_call():
    robot = endless_robot()
    said = []

    def handler(*_):
        try:
            robot.advance(robot.now)
        except cbc.Error as error:
            said.append(str(error))
        raise KeyboardInterrupt

    previous = signal.signal(signal.SIGINT, handler)
    try:
        check_interrupted(robot, lambda: robot.advance(1e6))
    finally:
        signal.signal(signal.SIGINT, previous)
    assert said and "while it handles an event" in said[0]
