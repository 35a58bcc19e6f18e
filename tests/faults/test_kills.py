"""A command is killed at each of its system calls that change something. Then it runs again."""

import signal
import unittest

import system_calls
from commands import COMMANDS
from fault_case import FaultCase, Run

CHANGES = {"fchmod", "fchown", "fsync", "link", "mkdir", "rename", "renameat2", "unlink", "write", "writev"}


def changes_something(call):
    return call.name in CHANGES or (call.name == "openat" and "O_CREAT" in call.arguments)


@unittest.skipIf(system_calls.why_not(), system_calls.why_not())
class Kills(FaultCase):

    def check(self, job, folder):
        """The call at which it is killed does not happen any more."""
        command, has_old, call = job
        run = Run(command, folder, has_old, system_calls.with_fault(call, "signal=KILL"))
        self.assertEqual(run.status, -signal.SIGKILL, run.err)
        self.assert_whole(run, may_leave_temporary=True)
        # Between two files of a rename, the old name is in one of them alone: a backup has to help.
        if command.name != "rename":
            self.assert_recovers(run, may_leave_temporary=True)

    def jobs(self):
        for command in COMMANDS:
            # All but init write by the same function, so one of them is enough without an old output.
            for has_old in (False, True) if command.name == "compile" else (command.replaces,):
                trace = self.work / "trace"
                Run(command, self.work / f"traced-{command}-{has_old}", has_old, system_calls.trace_options(trace))
                calls = [call for call in system_calls.read_calls(trace) if changes_something(call)]
                self.assertTrue(any("rename" in call.name or call.name == "link" for call in calls), command)
                yield from ((command, has_old, call) for call in calls)

    def test_old_or_new_file(self):
        self.each(self.check, self.jobs())


if __name__ == "__main__":
    unittest.main()
