#!/usr/bin/python3
"""A ROS node that decides which behaviors are active.

Topics, below the name of the node:

  events   std_msgs/String, in: what happened, in JSON, as an event of a script: {"start": "DRIVE", "priority": 2}
  changes  std_msgs/String, out: each event with what to activate and deactivate, as `cbc solve --format jsonl` has it
  state    std_msgs/String, out, latched: what runs after the last event

The reasons are on /diagnostics. Parameters of the node: see coordinator.launch.
"""

import json
import queue
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from std_msgs.msg import String

import cbc_catalog as cbc

VERBS = ("start", "stop", "finish", "situation", "fault", "repair")
CLOCK_ERROR = 1e-6  # seconds: a double has no more digits of a date
LONGEST_WAIT = 0.1  # seconds: the clock of a simulation may run faster than that of the computer


def parse(text):
    """The verb of an event, what it is about, and the details."""
    details = json.loads(text)
    verbs = [verb for verb in VERBS if verb in details] if isinstance(details, dict) else []
    if len(verbs) != 1:
        raise ValueError(f"expected an object with one of {', '.join(VERBS)}")
    return verbs[0], details.pop(verbs[0]), details


class Coordinator:
    """The robot of a catalog; its clock is that of ROS since the node began."""

    def __init__(self):
        self.robot = cbc.Coordinator(
            cbc.Catalog(rospy.get_param("~catalog")),
            situation=rospy.get_param("~situation", {}),
            reactive_delay=rospy.get_param("~reactive_delay", 0.08),
            time_limit=rospy.get_param("~time_limit", 0.1),
        )
        while not rospy.Time.now() and not rospy.is_shutdown():
            time.sleep(0.01)  # a simulation has not begun
        self.begin = rospy.Time.now()
        self.problem = None
        self.reported = 0.0
        self.messages = queue.Queue()
        self.changes = rospy.Publisher("~changes", String, queue_size=1000)
        self.state = rospy.Publisher("~state", String, queue_size=1, latch=True)
        self.diagnostics = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=10)
        self.publish_state()
        rospy.Subscriber("~events", String, self.messages.put, queue_size=1000)

    def since_begin(self, seconds):
        """What is late happens now, as the clock of the coordinator never goes back."""
        return max(self.robot.now, seconds - self.begin.to_sec())

    def run(self):
        """Handles one event after another, and those of the clock when they are due."""
        while not rospy.is_shutdown():
            try:
                self.handle(self.messages.get(timeout=self.time_to_wait()).data)
            except queue.Empty:
                if self.time_to_wait() < CLOCK_ERROR:
                    self.publish(self.robot.advance(self.robot.next_due))
            if time.monotonic() - self.reported > 1:
                self.report()

    def time_to_wait(self):
        """Seconds until something is due, or until the clock is to be read again."""
        due = self.robot.next_due
        wait = LONGEST_WAIT if due is None else due - self.since_begin(rospy.get_time())
        return min(max(wait, 0), LONGEST_WAIT)

    def handle(self, text):
        """A message like {"start": "DRIVE", "priority": 2, "at": 1754300000.5}; the time is that of ROS."""
        try:
            verb, subject, details = parse(text)
            at = self.since_begin(details.pop("at", rospy.get_time()))
            event = getattr(self.robot, verb)(subject, at=at, **details)
        except (ValueError, TypeError, cbc.Error) as error:
            rospy.logerr("%s: %s", text, error)
            self.problem = f"{text}: {error}"
            self.report()
        else:
            self.problem = event.why() if event.outcome == "rejected" else None
            self.publish([*event.before, event, *event.after])

    def publish(self, events):
        for event in events:
            self.changes.publish(json.dumps(event.to_json()))
        self.publish_state()
        self.report()

    def publish_state(self):
        robot = self.robot
        self.state.publish(json.dumps({
            "time": robot.now,
            "running": robot.running,
            "requests": robot.requests,
            "queue": robot.queue,
            "faulty": robot.faulty,
            "variables": robot.variables,
        }))

    def report(self):
        """Why each task runs as it does, and what was wrong with the last event."""
        self.reported = time.monotonic()
        status = DiagnosticStatus(name=f"{rospy.get_name()}: behaviors", level=DiagnosticStatus.OK)
        status.message = self.problem or f"{len(self.robot.running)} tasks run"
        if self.problem:
            status.level = DiagnosticStatus.WARN
        for task in self.robot.running:
            status.values.append(KeyValue(task, self.robot.why(task)))
        message = DiagnosticArray(status=[status])
        message.header.stamp = rospy.Time.now()
        self.diagnostics.publish(message)


if __name__ == "__main__":
    rospy.init_node("coordinator")
    try:
        Coordinator().run()
    except (cbc.Error, OSError, TypeError) as error:
        rospy.logfatal("%s", error)
        raise SystemExit(1) from None
