"""Each system call of a command fails once: the disk does not read or write, there are no descriptors left, or no
memory. strace makes them fail, so that those count as well that the C library makes for itself."""

import errno
import os
import pathlib
import unittest

import system_calls
from commands import COMMANDS, ROOT, Command
from fault_case import FaultCase, Run

# Calls that may fail, and how.
ERRORS = {
    "access": "EIO", "clone": "EAGAIN", "clone3": "EAGAIN", "close": "EIO", "faccessat2": "EIO",
    "fchmod": "EPERM", "fchown": "EPERM", "fsync": "EIO", "getcwd": "ENOENT", "getdents64": "EIO",
    "getrandom": "ENOSYS", "link": "EIO", "lseek": "EIO", "memfd_create": "EMFILE", "mkdir": "ENOSPC", "mmap": "ENOMEM", "newfstatat": "EIO",
    "openat": "EIO", "pipe2": "EMFILE", "poll": "ENOMEM", "pread64": "EIO", "read": "EIO", "readlink": "EIO",
    "readv": "EIO", "rename": "EIO", "renameat2": "EIO", "unlink": "EIO", "vfork": "EAGAIN", "wait4": "ECHILD",
    "write": "ENOSPC", "writev": "ENOSPC",
}
# Calls that do not fail, or whose failure says something else: not a terminal, for example. A failing brk returns no
# error, which strace cannot imitate; test_limits.py takes memory away.
OTHERS = {
    "brk", "clock_gettime", "exit_group", "fcntl", "futex", "getegid", "geteuid", "getgid", "gettid", "getpid", "getuid",
    "ioctl", "madvise", "mprotect", "mremap", "munmap", "prlimit64", "rseq", "rt_sigaction", "rt_sigprocmask",
    "sched_getaffinity", "set_robust_list", "sysinfo", "umask", "uname",
}
REASONS = {name: os.strerror(getattr(errno, name)) for name in ERRORS.values()}


@unittest.skipIf(system_calls.why_not(), system_calls.why_not())
class FailingCalls(FaultCase):

    def check(self, job, folder):
        command, has_old, call = job
        error = ERRORS[call.name]
        run = Run(command, folder, has_old, system_calls.with_fault(call, f"error={error}"))
        self.assertGreaterEqual(run.status, 0, f"ended by signal {-run.status}: {run.err}")
        # What cannot be removed is left.
        self.assert_whole(run, may_leave_temporary=call.name == "unlink")
        if call.name in ("write", "writev") and call.descriptor() == 2:
            self.assertIn(run.status, (run.command.status, 2))
        elif run.status == run.command.status:
            self.assert_complete(run)
        else:
            reasons = [REASONS[error], "out of memory"]
            if call.name == "newfstatat" and "S_IFDIR" in call.arguments:
                reasons.append(os.strerror(errno.EISDIR))  # it is then taken for a file, which says the rest
            self.assert_refused(run, reasons, self.names(call, command))

    @staticmethod
    def names(call, command):
        """How a message may name what the call was about."""
        if call.name in ("pipe2", "memfd_create", "vfork", "clone", "clone3", "mmap", "poll", "wait4"):
            return ()
        if call.descriptor() in (0, 1):
            return ("standard input", "<stdin>") if call.descriptor() == 0 else ("the output",)
        if "memfd:" in call.arguments:
            return ("Graphviz",)
        names = [pathlib.Path(path).name for path in call.paths()]
        # A temporary file and a folder are there for an output.
        return [*names, *(pathlib.Path(output).name for output in command.outputs)]

    def jobs_of(self, command):
        # All but init write by the same function, so one of them is enough without an old output.
        for has_old in (False, True) if command.name == "compile" else (command.replaces,):
            trace = self.work / "trace"
            folder = self.work / f"traced-{command.name}-{has_old}"
            Run(command, folder, has_old, system_calls.trace_options(trace))
            calls = system_calls.read_calls(trace)
            self.assertEqual({call.name for call in calls} - {*ERRORS} - OTHERS, set(), "expected calls that are known")
            for call in calls:
                # strace would leave a pipe open, which close does not, whatever it returns.
                if call.name in ERRORS and not (call.name == "close" and "<pipe:" in call.arguments):
                    yield command, has_old, call


for one in COMMANDS:
    setattr(FailingCalls, f"test_{one.name}", lambda self, one=one: self.each(self.check, self.jobs_of(one)))


@unittest.skipIf(system_calls.why_not(), system_calls.why_not())
class FailingThreads(FaultCase):
    """With fewer threads than wanted, or without a single one, the answer is the same."""

    COMMANDS = [
        Command("solve", "solve robot.yaml missions -j 4", ()),
        Command("sweep", "sweep robot.yaml --sequences 50 -j 4 --slowest slow.yaml", ("slow.yaml",)),
        # With enough states for several threads, which it starts several times.
        Command("verify", f"verify {ROOT}/catalogs/px4.yaml -j 4 --format json -o result.json", ("result.json",)),
    ]
    STARTED = {"solve": 2, "sweep": 3, "verify": 5}  # threads, at the least

    def check(self, job, folder):
        command, number = job
        trace = folder.with_suffix(".trace")
        call = system_calls.Call("clone3", number, "")
        run = Run(command, folder, True, system_calls.with_fault(call, "error=EAGAIN", trace))
        self.assertIn("(INJECTED)", trace.read_text())
        self.assert_whole(run)
        self.assert_complete(run)

    def test_all(self):
        self.each(self.check, ((command, number) for command in self.COMMANDS
                               for number in range(1, self.STARTED[command.name] + 1)))


if __name__ == "__main__":
    unittest.main()
