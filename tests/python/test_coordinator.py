import copy
import pickle

import pytest

import cbc_catalog as cbc
from conftest import ROBOT, SOURCE, run_cbc


@pytest.fixture(scope="module")
def small():
    return cbc.Catalog.from_text(ROBOT, name="robot.yaml")


@pytest.fixture
def cart(small):
    return cbc.Coordinator(small)


def test_an_event(cart):
    event = cart.start("DRIVE", priority=2, at=1.0)
    assert event.accepted and event.outcome == "accepted" and event.proven
    assert (event.verb, event.name, event.priority, event.time) == ("start", "DRIVE", 2, 1.0)
    assert cart.running["DRIVE"] == "DRIVE_FAST"
    assert {change.behavior for change in event.changes} == {"SLAM", "DRIVE_FAST"}
    assert all(change.op == "activate" and change.success for change in event.changes)
    assert cart.requests["DRIVE"] == 2
    assert "start DRIVE" in repr(event)
    assert event.why().startswith("start DRIVE, priority 2: accepted")


def test_a_rejected_event_is_a_value(cart):
    cart.start("DRIVE", priority=3)
    before = cart.running
    event = cart.start("LIFT")
    assert not event.accepted
    assert event.outcome == "rejected"
    assert "was rejected:" in event.why() and "DRIVE" in event.why()
    assert cart.running == before
    assert cart.why("LIFT") == event.why()


def test_the_clock(cart):
    assert cart.now == 0 and cart.next_due == 0.08
    assert cart.queue == {"SIGNAL": 0.08}
    (started,) = cart.advance(1)
    assert (started.origin, started.name, started.time) == ("reactive", "SIGNAL", 0.08)
    cart.start("LIFT", at=2)
    event = cart.start("DRIVE", at=10.5)
    assert [earlier.cause for earlier in event.before] == ["time_out"]
    assert event.before[0].time == 7.0
    assert event.before[0].name == "LIFT_UP"
    assert cart.now == 10.5


def test_the_situation(cart):
    cart.start("DRIVE")
    event = cart.situation(PEOPLE="near", RAIN=True)
    assert cart.variables == {"PEOPLE": "near", "RAIN": True}
    assert cart.running["DRIVE"] == "DRIVE_SLOWLY"
    assert [later.origin for later in event.after] == ["situation"]
    assert any(change.behavior == "DRIVE_SLOWLY" for change in event.after[0].changes)
    cart.situation({"DRIVE_SLOWLY": False}, at=1)
    assert cart.unavailable == ("DRIVE_SLOWLY",)
    assert cbc.Coordinator(cart.catalog, situation={"PEOPLE": "far"}).variables["PEOPLE"] == "far"


def test_faults(cart):
    cart.fault("DRIVE_FAST")
    assert cart.faulty == ("DRIVE_FAST",)
    event = cart.start("DRIVE")
    assert [change.behavior for change in event.changes if not change.success] == ["DRIVE_FAST"]
    assert cart.active == ("DRIVE_SLOWLY",)
    cart.repair("DRIVE_FAST")
    assert cart.faulty == ()


def test_finish_by_behavior_and_by_task(cart):
    cart.start("DRIVE")
    assert cart.finish("DRIVE_FAST", cause="goal_achieved").name == "DRIVE_FAST"
    assert "DRIVE" not in cart.running
    cart.start("DRIVE")
    event = cart.finish("DRIVE")
    assert (event.name, event.cause) == ("DRIVE_FAST", "goal_achieved")
    assert [(stopped.task, stopped.cause) for stopped in event.stopped][0] == ("DRIVE", "goal_achieved")
    assert cart.finish("DRIVE").outcome == "unchanged"
    assert cart.finish("DRIVE").name is None


def test_why_in_the_words_of_solve(tmp_path):
    """Of each task and behavior after each event of a mission, the line that `cbc solve --why` has."""
    catalog = cbc.Catalog(SOURCE / "docs" / "fetch.yaml")
    robot = cbc.Coordinator(catalog)
    robot.start("DRIVE")
    for name in ("DRIVE", "DRIVE_FAST", "DRIVE_SLOWLY", "SLAM", "LOCALIZE"):
        _, output, _ = run_cbc("solve", "docs/fetch.yaml", "docs/fetch.mission.yaml", "--why", name)
        told = robot.why(name).splitlines()[1:]
        assert told, name
        for line in told:
            assert line.strip() in [written.strip() for written in output.splitlines()], name


def test_why_before_any_event(cart):
    assert cart.why("DRIVE") == "no event so far has started DRIVE, or what requires it"
    assert cart.why("SIGNAL") == "SIGNAL is due to start by itself at 0.080 s"


def test_what_if(cart):
    cart.start("DRIVE")
    options = cart.options()
    lift = next(option for option in options
                if (option.event.verb, option.event.name) == ("start", "LIFT"))
    assert lift.started == {"LIFT": "LIFT_UP"} and "DRIVE" in lift.stopped
    near = [option for option in options if option.event.verb == "situation"
            and option.changed == {"DRIVE": "DRIVE_SLOWLY"}]
    assert len(near) == 1
    assert options[-1].event.origin == "reactive"
    assert cart.running["DRIVE"] == "DRIVE_FAST"
    starts = [option.event.priority for option in cart.options(priorities=(1, 2))
              if option.event.verb == "start" and option.event.origin == "script"]
    assert starts == [1, 2, 1, 2]
    assert lift.event.why().startswith("start LIFT, priority 1: accepted")


def test_what_if_is_that_of_solve():
    robot = cbc.Coordinator(cbc.Catalog(SOURCE / "docs" / "fetch.yaml"))
    robot.start("DRIVE")
    report = cbc.solve(SOURCE / "docs/fetch.yaml", SOURCE / "docs/fetch.mission.yaml", what_if=True)
    options = robot.options()
    assert len(options) == len(report.moves)
    for option, move in zip(options, report.moves):
        assert (option.event.verb, option.event.outcome) == (move.verb, move.outcome)
        assert option.started == move.started.to_json()
        assert list(option.stopped) == list(move.stopped)
        assert option.changed == move.changed.to_json()
        assert option.queued == move.queued.to_json()


def test_save_and_restore(cart):
    cart.start("DRIVE", parameters={"speed": 3})
    cart.fault("BEACON", at=0.05)
    state = cart.save()
    other = cbc.Coordinator(cart.catalog)
    other.restore(state)
    assert other.save() == state
    assert other.advance(9)[0].to_json()["changes"] == cart.advance(9)[0].to_json()["changes"]
    with pytest.raises(cbc.UsageError, match="cannot use the state"):
        other.restore(b"{}")
    with pytest.raises(cbc.UsageError, match="another catalog"):
        cbc.Coordinator(cbc.Catalog(SOURCE / "docs/fetch.yaml")).restore(state)


def test_a_saved_state_continues_in_solve(cart, tmp_path):
    (tmp_path / "robot.yaml").write_text(ROBOT)
    cart.start("DRIVE", priority=2)
    (tmp_path / "state.json").write_bytes(cart.save())
    (tmp_path / "rest.yaml").write_text("events:\n- {at: 2, stop: DRIVE}\n")
    status, output, messages = run_cbc("solve", "--format", "jsonl", "--state-in", "state.json",
                                       "robot.yaml", "rest.yaml", cwd=tmp_path)
    assert status == 0, messages
    assert '"outcome":"accepted"' in output


@pytest.mark.parametrize("duplicate", [copy.copy, copy.deepcopy,
                                       lambda robot: pickle.loads(pickle.dumps(robot))])
def test_copies_go_their_own_way(cart, duplicate):
    cart.start("DRIVE", priority=2, at=0.01)
    other = duplicate(cart)
    assert other.save() == cart.save()
    other.stop("DRIVE", at=5)
    assert "DRIVE" in cart.running and "DRIVE" not in other.running
    assert cart.now == 0.01


def test_values_outlive_the_robot(small):
    robot = cbc.Coordinator(small)
    event = robot.start("DRIVE")
    running = robot.running
    changes = event.changes
    options = robot.options()
    robot.stop("DRIVE")
    del robot
    assert running["DRIVE"] == "DRIVE_FAST" and changes[0].behavior in ("SLAM", "DRIVE_FAST")
    assert event.to_json()["running"]["DRIVE"] == "DRIVE_FAST"
    assert options[0].event.why()
    assert copy.deepcopy(event) is event
    assert changes == event.changes and hash(changes) == hash(event.changes)


def test_parameters(cart):
    assert cart.start("DRIVE", parameters={"speed": 1}).changes
    assert not cart.start("DRIVE", parameters={"speed": 1}).changes
    assert [change.cause for change in cart.start("DRIVE", parameters={"speed": 2}).changes] == [
        "restarted", "restarted"]


def test_limits(small):
    assert cbc.Coordinator(small, max_nodes=1, time_limit=0.5).start("DRIVE").outcome
    with pytest.raises(cbc.UsageError, match="reactive_delay"):
        cbc.Coordinator(small, reactive_delay=0)


def test_repr(cart):
    cart.start("DRIVE", at=0.02)
    assert repr(cart) == "<Coordinator of 'robot.yaml' at 0.020 s: 2 tasks run>"
