"""What is wrong is said, in errors of our own, and changes nothing."""

import math
import copy
import pickle
import types

import pytest

import cbc_catalog as cbc
from conftest import ROBOT

CATALOG = cbc.Catalog.from_text(ROBOT)


@pytest.mark.parametrize("call, name, nearest, message", [
    (lambda r: r.start("DRIV"), "DRIV", "DRIVE", "there is no task 'DRIV'; did you mean 'DRIVE'?"),
    (lambda r: r.start("DRIVE_FAST"), "DRIVE_FAST", None, "there is no task 'DRIVE_FAST': it is a behavior"),
    (lambda r: r.fault("DRIVE"), "DRIVE", None, "there is no behavior 'DRIVE': it is a task"),
    (lambda r: r.stop("drive"), "drive", "DRIVE", "there is no task 'drive'"),
    (lambda r: r.finish("NOTHING"), "NOTHING", None, "there is no behavior or task 'NOTHING'"),
    (lambda r: r.situation(PEPLE="near"), "PEPLE", "PEOPLE",
     "there is no behavior or situation variable 'PEPLE'; did you mean 'PEOPLE'?"),
    (lambda r: r.situation(PEOPLE="near by"), "near by", None, "situation variable 'PEOPLE' has no value"),
    (lambda r: r.why("SIGNL"), "SIGNL", "SIGNAL", "did you mean 'SIGNAL'?"),
    (lambda r: r.start("A\ud800"), "A?", None, "there is no task"),
    (lambda r: r.start("A\0B"), "A\0B", None, "there is no task"),
])
def test_unknown_names(call, name, nearest, message):
    robot = cbc.Coordinator(CATALOG)
    before = robot.save()
    with pytest.raises(cbc.UnknownName) as caught:
        call(robot)
    assert message in str(caught.value)
    assert caught.value.name == name
    if nearest is not None:
        assert caught.value.nearest == nearest
    assert isinstance(caught.value, cbc.Error) and not isinstance(caught.value, KeyError)
    assert pickle.loads(pickle.dumps(caught.value)).name == name
    assert robot.save() == before


@pytest.mark.parametrize("call, message", [
    (lambda r: r.start("DRIVE", priority=0), "expected an integer from 1"),
    (lambda r: r.start("DRIVE", priority=10**30), "more than 63 bits"),
    (lambda r: r.stop("DRIVE", priority=-1), "expected an integer from 0"),
    (lambda r: r.start("DRIVE", at=0.5), "which is now, or later, found 0.5 s; time never goes back"),
    (lambda r: r.start("DRIVE", at=-1), "expected 0 to"),
    (lambda r: r.start("DRIVE", at=math.nan), "expected 0 to"),
    (lambda r: r.start("DRIVE", at=math.inf), "expected 0 to"),
    (lambda r: r.start("DRIVE", at=10**400), "expected 0 to"),
    (lambda r: r.advance(0.5), "time never goes back"),
    (lambda r: r.finish("DRIVE", cause="goal_achievd"), "did you mean 'goal_achieved'?"),
    (lambda r: r.start("DRIVE", parameters={"sped": 1}), "declares no parameter 'sped'"),
    (lambda r: r.start("DRIVE", parameters={"speed": math.nan}), "parameters: "),
    (lambda r: r.options(priorities=(0,)), "expected an integer from 1"),
])
def test_wrong_values(call, message):
    robot = cbc.Coordinator(CATALOG)
    robot.advance(1)
    before = robot.save()
    with pytest.raises(cbc.UsageError) as caught:
        call(robot)
    assert message in str(caught.value)
    assert robot.save() == before


@pytest.mark.parametrize("call", [
    lambda r: r.start(1),
    lambda r: r.start(b"DRIVE"),
    lambda r: r.start(),
    lambda r: r.start("DRIVE", priority=1.5),
    lambda r: r.start("DRIVE", priority=True),
    lambda r: r.start("DRIVE", at="1"),
    lambda r: r.start("DRIVE", at=True),
    lambda r: r.start("DRIVE", at=1j),
    lambda r: r.start("DRIVE", parameters=[1]),
    lambda r: r.start("DRIVE", parameters={"speed": object()}),
    lambda r: r.start("DRIVE", whatever=1),
    lambda r: r.situation(PEOPLE=1),
    lambda r: r.situation(RAIN="yes"),
    lambda r: r.situation(SLAM=None),
    lambda r: r.situation([("RAIN", True)]),
    lambda r: r.situation({1: True}),
    lambda r: r.finish("DRIVE", cause=None),
    lambda r: r.advance(None),
    lambda r: r.restore(None),
    lambda r: cbc.Coordinator(None),
    lambda r: cbc.Coordinator("robot.yaml"),
    lambda r: pickle.dumps(r.start("DRIVE")),
])
def test_wrong_types(call):
    robot = cbc.Coordinator(CATALOG)
    with pytest.raises(TypeError):
        call(robot)


def test_nothing_can_be_changed_from_outside():
    robot = cbc.Coordinator(CATALOG)
    event = robot.start("DRIVE")
    for value, name in ((event, "outcome"), (event.changes[0], "behavior"), (robot, "now"),
                        (CATALOG, "name"), (robot, "anything")):
        with pytest.raises(AttributeError):
            setattr(value, name, 1)
    robot.running.clear()
    assert "DRIVE" in robot.running


class Own(cbc.Coordinator):
    """One that forgets to begin."""

    def __init__(self, catalog=None):
        if catalog is not None:
            super().__init__(catalog, situation={"NO_SUCH": True})


@pytest.mark.parametrize("call", [
    lambda: repr(cbc.Coordinator.__new__(cbc.Coordinator)),
    lambda: cbc.Coordinator.__new__(cbc.Coordinator).start("DRIVE"),
    lambda: cbc.Coordinator(cbc.Catalog.__new__(cbc.Catalog)),
    lambda: repr(cbc.Catalog.__new__(cbc.Catalog)),
    lambda: cbc.Event.__new__(cbc.Event),
    lambda: cbc.Change.__new__(cbc.Change),
    lambda: cbc.Option.__new__(cbc.Option),
    lambda: cbc.StoppedTask.__new__(cbc.StoppedTask),
    lambda: Own(),
])
def test_objects_without_a_value(call):
    with pytest.raises(TypeError):
        call()


def test_an_object_whose_begin_has_failed():
    robots = []

    class Kept(Own):
        def __init__(self):
            robots.append(self)
            super().__init__(CATALOG)

    with pytest.raises(cbc.UnknownName):
        Kept()
    with pytest.raises(TypeError, match="__init__"):
        repr(robots[0])


def test_mappings_and_sequences():
    robot = cbc.Coordinator(CATALOG, situation=types.MappingProxyType({"RAIN": True}))
    assert robot.variables["RAIN"]
    robot.situation(types.MappingProxyType({"RAIN": False}))
    assert not robot.variables["RAIN"]
    assert robot.options(priorities=[1, 2])
    with pytest.raises(TypeError):
        robot.options(priorities=5)
    with pytest.raises(cbc.UsageError, match="twice"):
        robot.situation({"RAIN": True}, RAIN=False)
    with pytest.raises(cbc.UsageError, match="NUL"):
        cbc.Catalog("a\0b")


def test_options_can_be_copied():
    option = cbc.Coordinator(CATALOG).options()[0]
    assert copy.copy(option) is option and copy.deepcopy(option) is option
