"""Ctrl-C in long events, and threads beside them."""

import os
import signal
import threading
import time

import pytest

import cbc_catalog as cbc

# A task that starts by itself again and again: the clock has a million events, which take a second.
CYCLE = """
behaviors:
- {behavior: BLINK, task: LIGHT, suitability: 50, timeout: 0.001}
tasks:
- {task: LIGHT, start_on_request: false, reactive_start: true}
"""


def interrupt_after(seconds):
    threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT)).start()


def hard_catalog():
    """A catalog in which many requests of equal priority compete: a search that takes very long."""
    import random
    draw = random.Random(3)
    tasks = [f"T{number}" for number in range(90)]
    behaviors = []
    for task in tasks:
        for way in range(4):
            needs = draw.sample([other for other in tasks[:45] if other != task], 3) if task in tasks[45:] else []
            requires = ", ".join(f"{{task: {need}, minimum_performance: {draw.choice([0, 40, 60])}}}" for need in needs)
            behaviors.append(f"- {{behavior: B{task}_{way}, task: {task}, suitability: {draw.randrange(30, 100)}, "
                             f"requires: [{requires}]}}")
    pairs = [draw.sample(tasks[:45], 2) for _ in range(160)]
    return cbc.Catalog.from_text("behaviors:\n" + "\n".join(behaviors) + "\ntasks:\n" +
                                 "\n".join(f"- {{task: {task}}}" for task in tasks) + "\nexclusivity_constraints:\n" + "\n".join(
                                     f"- mutually_exclusive: [{', '.join(pair)}]" for pair in pairs))


def check_interrupted(robot, call):
    before = robot.save()
    interrupt_after(0.3)
    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        call()
    assert time.monotonic() - begin < 10  # 0.5 on a machine that is not busy
    assert robot.save() == before


def test_ctrl_c_while_the_clock_runs():
    robot = cbc.Coordinator(cbc.Catalog.from_text(CYCLE))
    check_interrupted(robot, lambda: robot.advance(1e6))
    assert len(robot.advance(1)) > 10


def test_too_many_events_of_the_clock():
    robot = cbc.Coordinator(cbc.Catalog.from_text(CYCLE))
    with pytest.raises(cbc.Error, match="more than 1000000 events in one call"):
        robot.advance(1e6)
    assert robot.now == 0


def test_other_threads_go_on_while_a_call_is_long():
    robot = cbc.Coordinator(cbc.Catalog.from_text(CYCLE))
    counted = [0]
    is_done = threading.Event()

    def count():
        while not is_done.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    robot.advance(2000)
    made = counted[0] - before
    is_done.set()
    thread.join()
    assert made > 1000


def test_a_signal_handler_cannot_use_the_robot_in_a_call():
    robot = cbc.Coordinator(cbc.Catalog.from_text(CYCLE))
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
