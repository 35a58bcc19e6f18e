"""The node of docs/ros with a real roscore: missions through topics, and through `cbc solve`."""

import json
import os
import queue
import random
import re
import signal
import socket
import subprocess
import sys
import time
from xmlrpc.client import ServerProxy

import pytest

import cbc_catalog as cbc
from conftest import SOURCE, run_cbc
from test_missions import comparable, lines_of

rospy = pytest.importorskip("rospy", reason="there is no rospy")
import rosgraph  # noqa: E402
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus  # noqa: E402
from rosgraph_msgs.msg import Clock  # noqa: E402
from std_msgs.msg import String  # noqa: E402

PAGE = (SOURCE / "docs" / "ros.md").read_text(encoding="utf-8")
BEGIN = 1000  # seconds of the simulated clock
PATIENCE = 60  # seconds of a busy machine
MISSIONS = sorted(SOURCE.glob("catalogs/*.mission.yaml")) + sorted(SOURCE.glob("catalogs/missions/*.yaml"))


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def wait_for(what, condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end, f"no {what}"
        time.sleep(0.01)


def stop(process):
    process.send_signal(signal.SIGINT)
    process.wait(PATIENCE)


@pytest.fixture(scope="module")
def master(tmp_path_factory):
    """A roscore with a simulated clock, and this process as a node."""
    port = free_port()
    os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{port}", ROS_IP="127.0.0.1",
                      ROS_HOME=str(tmp_path_factory.mktemp("ros")),
                      ROS_PACKAGE_PATH=os.pathsep.join([str(SOURCE / "docs" / "ros"),
                                                        os.environ.get("ROS_PACKAGE_PATH", "/usr/share")]))
    core = subprocess.Popen(["roscore", "-p", str(port)], stdout=subprocess.DEVNULL)

    def is_up():
        with socket.socket() as probe:
            return probe.connect_ex(("127.0.0.1", port)) == 0

    wait_for("roscore", is_up)
    rospy.set_param("/use_sim_time", True)
    rospy.init_node("test", disable_signals=True)
    yield
    rospy.signal_shutdown("done")
    stop(core)


class Robot:
    """The node, and what it publishes."""

    def __init__(self, clock, catalog, situation="{}", reactive_delay=0.08):
        self.clock = clock
        self.changes = queue.Queue()
        self.states = queue.Queue()
        self.diagnostics = queue.Queue()
        self.subscribers = [rospy.Subscriber("/coordinator/changes", String, self.changes.put),
                            rospy.Subscriber("/diagnostics", DiagnosticArray, self.diagnostics.put)]
        self.events = rospy.Publisher("/coordinator/events", String, queue_size=10000)
        self.process = subprocess.Popen(
            ["roslaunch", "cbc_coordinator", "coordinator.launch", f"catalog:={catalog}",
             f"situation:={situation}", f"reactive_delay:={reactive_delay}"],
            stdout=subprocess.DEVNULL, stderr=subprocess.STDOUT)
        self.set_clock(0)
        wait_for("node", self.is_connected)

    def is_connected(self):
        assert self.process.poll() is None, "the launch has ended"
        try:
            node = ServerProxy(rosgraph.Master("/test").lookupNode("/coordinator"))
            topics = {topic for _, _, _, _, topic, *_ in node.getBusInfo("/test")[2]}
        except (OSError, rosgraph.MasterError):
            return False
        # The node's side of a connection is the later one.
        return topics >= {"/coordinator/events", "/coordinator/changes", "/diagnostics"}

    def set_clock(self, seconds):
        self.clock.publish(Clock(rospy.Time.from_sec(BEGIN + seconds)))

    def send(self, verb, subject, at=None, **details):
        event = {verb: subject, **details}
        if at is not None:
            event["at"] = BEGIN + at
        self.events.publish(json.dumps(event))

    def receive(self, count):
        return [json.loads(self.changes.get(timeout=PATIENCE).data) for _ in range(count)]

    def last_state(self):
        """Which a new subscriber gets, as it is latched."""
        return json.loads(rospy.wait_for_message("/coordinator/state", String, PATIENCE).data)

    def status(self, condition):
        while True:
            (status,) = self.diagnostics.get(timeout=PATIENCE).status
            if condition(status):
                return status

    def wait_for_stamp(self, seconds):
        """Until the node has seen the clock."""
        while self.diagnostics.get(timeout=PATIENCE).header.stamp.to_sec() != BEGIN + seconds:
            pass

    def close(self):
        for subscriber in self.subscribers:
            subscriber.unregister()
        self.events.unregister()
        stop(self.process)


@pytest.fixture
def launch(master):
    clock = rospy.Publisher("/clock", Clock, queue_size=1, latch=True)
    robots = []

    def start(*arguments):
        robots.append(Robot(clock, *arguments))
        return robots[-1]

    yield start
    for robot in robots:
        robot.close()
    clock.unregister()


def details_of(event):
    """What a message says of an event of `cbc solve`."""
    verb = event["verb"]
    if verb == "start":
        named = {"parameters": event["parameters"]} if event.get("parameters") else {}
        return event["name"], {"priority": event["priority"], **named}
    if verb == "stop":
        return event["name"], {"priority": event["priority"]}
    if verb == "finish":
        return event.get("task", event["name"]), {"cause": event["cause"]}
    return event["situation"] if verb == "situation" else event["name"], {}


@pytest.mark.parametrize("mission", MISSIONS, ids=lambda mission: mission.name)
def test_same_as_solve(launch, mission):
    header, events = lines_of(SOURCE, [mission])
    if not header.get("timeouts", True):
        pytest.skip("the node has timeouts")
    robot = launch(header["catalog"], json.dumps(header["situation"]), header["reactive_delay"])
    expected = [comparable(event) for event in events if event["verb"] != "wait"]
    times = sorted({event["time"] for event in events})
    place = dict(zip(times, random.Random(1).sample(times, len(times))))
    for event in sorted(events, key=lambda event: place[event["time"]]):
        if event["origin"] == "script" and event["verb"] != "wait":
            subject, details = details_of(event)
            robot.send(event["verb"], subject, event["time"], **details)
    # The events are handled at their times; until the clock comes, they wait, in any order.
    robot.events.publish("the last one")
    robot.status(lambda status: status.message.startswith("the last one"))
    robot.set_clock(events[-1]["time"])
    assert [comparable(event) for event in robot.receive(len(expected))] == expected
    state = robot.last_state()
    assert (state["running"], state["requests"]) == (expected[-1]["running"], expected[-1]["requests"])


@pytest.fixture
def started(launch, tmp_path):
    """The robot of `cbc init`."""
    assert run_cbc("init", tmp_path / "robot")[0] == 0
    return launch(tmp_path / "robot" / "robot.yaml")


def test_reasons_are_diagnostics(started):
    started.send("start", "CHARGE", priority=2)
    started.send("start", "DRIVE")
    assert [event["outcome"] for event in started.receive(2)] == ["accepted", "rejected"]
    status = started.status(lambda status: status.level == DiagnosticStatus.WARN)
    assert "CHARGE" in status.message
    assert [value.key for value in status.values] == ["CHARGE"]
    assert "why" in status.values[0].value


@pytest.mark.parametrize("message, problem", [
    ("{", "quotes"), ("5", "one of start"), ('{"start": "DRIVE", "stop": "DRIVE"}', "one of start"),
    ('{"start": "DRIV"}', "DRIVE"), ('{"start": "DRIVE", "prio": 2}', "prio"), ('{"fault": 1}', "str"),
    ('{"start": "DRIVE", "at": "x"}', "seconds"), ('{"start": "DRIVE", "at": NaN}', "seconds"),
    ('{"start": "DRIVE", "priority": 1' + 400 * "0" + "}", "expected"), ("[" * 100000, "recursion"),
    ('{"start": "DRIVE", "at": 1' + 400 * "0" + "}", "too large")])
def test_wrong_messages_change_nothing(started, message, problem):
    started.events.publish(message)
    status = started.status(lambda status: status.level == DiagnosticStatus.WARN)
    begin = message[:200]
    assert status.message.startswith(begin) and problem in status.message.removeprefix(begin)
    started.send("start", "DRIVE")
    assert started.receive(1)[0]["outcome"] == "accepted"
    assert started.status(lambda status: status.level == DiagnosticStatus.OK).message


def test_the_commands_of_the_page(started):
    commands = re.findall(r"^rostopic pub .*", PAGE, re.M)
    assert len(commands) == 2
    for command in commands:
        subprocess.run(command, shell=True, check=True, stdout=subprocess.DEVNULL, timeout=PATIENCE)
    start, situation, finish = started.receive(3)
    assert start["running"] == {"DRIVE": "DRIVE_FAST", "LOCALIZE": "LIDAR"}
    assert (situation["origin"], finish["origin"]) == ("script", "situation")
    assert finish["running"] == {"DRIVE": "DRIVE_SLOWLY"}


def test_the_node_for_behaviors_of_the_page(started):
    (example,) = re.findall(r"^```python\n(.*?)^```$", PAGE, re.M | re.S)
    calls = queue.Queue()
    names = {"begin": lambda behavior, on_end: calls.put((behavior, on_end)),
             "cancel": lambda behavior: calls.put((behavior, None))}
    exec(example, names)  # pylint: disable=exec-used
    wait_for("connection", lambda: names["events"].get_num_connections() == 1)
    started.send("start", "DRIVE")
    begun = dict(calls.get(timeout=PATIENCE) for _ in range(2))
    begun["DRIVE_FAST"]("goal_achieved")
    assert calls.get(timeout=PATIENCE) == ("LIDAR", None)
    assert [event["verb"] for event in started.receive(2)] == ["start", "finish"]
    names["events"].unregister()


def test_the_clock_makes_events(launch, tmp_path):
    catalog = tmp_path / "lift.yaml"
    catalog.write_text("behaviors:\n- {behavior: LIFT_UP, task: LIFT, timeout: 5}\n")
    robot = launch(catalog)
    robot.send("start", "LIFT")
    assert robot.receive(1)[0]["running"] == {"LIFT": "LIFT_UP"}
    robot.set_clock(4.5)
    robot.set_clock(7)
    (event,) = robot.receive(1)
    assert (event["origin"], event["time"]) == ("timeout", 5)
    robot.send("start", "LIFT", at=3)  # late: it happens now
    (event,) = robot.receive(1)
    assert event["outcome"] == "accepted" and 5 <= event["time"] <= 7
    # A simulation that begins anew: time goes on from where it was.
    robot.wait_for_stamp(7)
    robot.set_clock(0)
    robot.wait_for_stamp(0)
    robot.set_clock(8)
    (end,) = robot.receive(1)
    assert (end["origin"], end["time"]) == ("timeout", event["time"] + 5)


def test_what_only_the_task_is_known_of(started):
    started.send("start", "CHARGE")
    started.send("finish", {"task": "CHARGE"})
    assert [event["outcome"] for event in started.receive(2)] == ["accepted", "accepted"]


def test_a_wrong_catalog_ends_the_launch(master, tmp_path):
    catalog = tmp_path / "wrong.yaml"
    catalog.write_text("behaviors: 5\n")
    done = subprocess.run(["roslaunch", "cbc_coordinator", "coordinator.launch", f"catalog:={catalog}"],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=PATIENCE, check=False)
    assert "wrong.yaml:1" in done.stdout.decode()


def test_catkin_takes_the_package(tmp_path):
    if not os.path.isfile("/usr/share/catkin/cmake/catkinConfig.cmake"):
        pytest.skip("there is no catkin")
    subprocess.run(["cmake", "-S", SOURCE / "docs" / "ros", "-B", tmp_path / "build", "--install-prefix",
                    tmp_path / "installed", f"-DPYTHON_EXECUTABLE={sys.executable}"],
                   check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["cmake", "--install", tmp_path / "build"], check=True, stdout=subprocess.DEVNULL)
    assert (tmp_path / "installed" / "lib" / "cbc_coordinator" / "coordinator_node.py").is_file()
