#!/usr/bin/python3
"""A ROS node that decides which behaviors are active.

Topics, below the name of the node:

  events   std_msgs/String, in: what happened, in JSON, as an event of a script: {"start": "DRIVE", "priority": 2}
  changes  std_msgs/String, out: each event with what to activate and deactivate, as `cbc solve --format jsonl` has it
  state    std_msgs/String, out, latched: what runs after the last event

The reasons are on /diagnostics. Parameters of the node: see coordinator.launch.
"""

import heapq
import json
import math
import queue
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from std_msgs.msg import String

import cbc_catalog as cbc

VERBS = ("start", "stop", "finish", "situation", "fault", "repair")
CLOCK_ERROR = 1e-6  # seconds: a double has no more digits of a date
LONGEST_WAIT = 0.1  # seconds: the clock of a simulation may run faster than that of the computer
LONGEST_REASONING = 0.05  # seconds: for a reason the search of an event is repeated


def parse(text):
    """The verb of an event, what it is about, its time or None, and the details."""
    details = json.loads(text)
    verbs = [verb for verb in VERBS if verb in details] if isinstance(details, dict) else []
    if len(verbs) != 1:
        raise ValueError(f"expected an object with one of {', '.join(VERBS)}")
    subject = details.pop(verbs[0])
    if verbs[0] == "finish" and isinstance(subject, dict):
        (subject,) = subject.values()  # {"finish": {"task": "DRIVE"}}
    at = details.pop("at", None)
    if at is not None and not (isinstance(at, (int, float)) and math.isfinite(at)):
        raise ValueError(f"at: expected seconds of the clock of ROS, found {at!r}")
    return verbs[0], subject, at, details


class Coordinator:
    """The robot of a catalog; its clock is that of ROS since the node began."""

    def __init__(self):
        self.robot = cbc.Coordinator(
            cbc.Catalog(rospy.get_param("~catalog", "(parameter ~catalog is missing)")),
            situation=rospy.get_param("~situation", {}),
            reactive_delay=rospy.get_param("~reactive_delay", 0.08),
            time_limit=rospy.get_param("~time_limit", 0.1),
        )
        while not rospy.get_time() and not rospy.is_shutdown():
            time.sleep(0.01)  # a simulation has not begun
        self.begin = self.seen = rospy.get_time()
        self.problem = None
        self.reasons = {}  # by running task
        self.reported = 0.0
        self.messages = queue.Queue()
        self.later = []  # a heap of messages whose time has not come
        self.received = 0
        self.changes = rospy.Publisher("~changes", String, queue_size=1000)
        self.state = rospy.Publisher("~state", String, queue_size=1, latch=True)
        self.diagnostics = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=10)
        self.publish_state()
        rospy.Subscriber("~events", String, self.messages.put, queue_size=1000)

    def now(self):
        """Seconds of the clock of ROS. If it goes back, as a simulation begins anew, the robot goes on."""
        seconds = rospy.get_time()
        if seconds < self.seen:
            rospy.logwarn("the clock went back by %.3f s", self.seen - seconds)
            self.begin -= self.seen - seconds
        self.seen = seconds
        return seconds

    def run(self):
        """Handles one event after another, and those of the clock when they are due."""
        while not rospy.is_shutdown():
            try:
                self.receive(self.messages.get(timeout=self.time_to_wait()).data)
            except queue.Empty:
                self.go_on()
            if time.monotonic() - self.reported > 1:
                self.report()

    def time_to_wait(self):
        """Seconds until something is due, or until the clock is to be read again."""
        now = self.now()
        due = [] if self.robot.next_due is None else [self.robot.next_due + self.begin - now]
        due += [self.later[0][0] - now] if self.later else []
        return min(max(min(due, default=LONGEST_WAIT), 0), LONGEST_WAIT)

    def receive(self, text):
        """A message like {"start": "DRIVE", "priority": 2, "at": 1754300000.5}; the time is that of ROS."""
        try:
            verb, subject, at, details = parse(text)
        except (ValueError, OverflowError, RecursionError) as error:
            return self.complain(text, error)
        now = self.now()
        self.received += 1  # of messages with one time, the first comes first
        item = (now if at is None else at, self.received, text, verb, subject, details)
        if item[0] <= now + CLOCK_ERROR:
            self.handle(item)
        else:
            heapq.heappush(self.later, item)

    def go_on(self):
        """Handles what has become due."""
        now = self.now() + CLOCK_ERROR
        if self.later and self.later[0][0] <= now:
            self.handle(heapq.heappop(self.later))
        elif self.robot.next_due is not None and self.robot.next_due + self.begin <= now:
            self.publish(self.robot.advance(self.robot.next_due))

    def handle(self, item):
        """What is late happens now, as the clock of the coordinator never goes back."""
        seconds, _, text, verb, subject, details = item
        try:
            at = max(self.robot.now, seconds - self.begin)
            event = getattr(self.robot, verb)(subject, at=at, **details)
        except (TypeError, cbc.Error) as error:
            return self.complain(text, error)
        self.problem = None
        if event.outcome == "rejected":
            self.problem = event.why()
        elif not event.proven:
            self.problem = f"{event!r}: the search ended at the time limit, so the answer may not be the best"
        self.publish([*event.before, event, *event.after])

    def complain(self, text, error):
        rospy.logerr("%.200s: %s", text, error)
        self.problem = f"{text:.200}: {error}"
        self.report()

    def publish(self, events):
        for event in events:
            self.changes.publish(json.dumps(event.to_json()))
        self.publish_state()
        self.find_reasons(events)
        self.report()

    def find_reasons(self, events):
        """Of tasks whose behaviors have changed; of the others they have been found before."""
        running = self.robot.running
        changed = {task for event in events for change in event.changes for task in change.tasks}
        self.reasons = {task: why for task, why in self.reasons.items() if task in running}
        end = time.monotonic() + LONGEST_REASONING
        for task in running:
            if task in changed or task not in self.reasons:
                is_late = time.monotonic() > end
                self.reasons[task] = "there was no time to find the reason" if is_late else self.robot.why(task)

    def publish_state(self):
        robot = self.robot
        self.state.publish(json.dumps({
            "time": robot.now,
            "running": robot.running,
            "requests": robot.requests,
            "suspended": robot.suspended,
            "queue": robot.queue,
            "active": robot.active,
            "faulty": robot.faulty,
            "failed": robot.failed,
            "unavailable": robot.unavailable,
            "variables": robot.variables,
        }))

    def report(self):
        """Why each task runs as it does, and what is to be said of the last event."""
        self.reported = time.monotonic()
        status = DiagnosticStatus(name=f"{rospy.get_name()}: behaviors", level=DiagnosticStatus.OK)
        status.message = self.problem or f"{len(self.robot.running)} tasks run"
        if self.problem:
            status.level = DiagnosticStatus.WARN
        for task, why in self.reasons.items():
            status.values.append(KeyValue(task, why))
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
