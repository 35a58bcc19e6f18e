"""The system calls of a command, by strace, and commands in which one of these calls fails or kills."""

import collections
import dataclasses
import pathlib
import re
import subprocess

# What begins main(); what comes before belongs to the loader.
FIRST = "rt_sigaction(SIGXFSZ"
LINE = re.compile(r"(\w+)\((.*)\) += (.*)")


@dataclasses.dataclass(frozen=True)
class Call:
    """The call `number`, counted from 1, of those with this name."""
    name: str
    number: int
    arguments: str

    def __str__(self):
        return f"{self.name} {self.number}: {self.arguments}"

    def paths(self):
        """The names of the files that it is about."""
        return re.findall(r'"((?:[^"\\]|\\.)*)"', self.arguments) + re.findall(r"\d<([^>]*)>", self.arguments)

    def descriptor(self):
        found = re.match(r"(\d+)<", self.arguments)
        return int(found[1]) if found else None


def trace_options(output):
    return ["strace", "-qq", "-y", "-s", "60", "-o", str(output)]


def why_not():
    """Why no program can be traced here, or nothing."""
    try:
        done = subprocess.run([*trace_options("/dev/null"), "true"], stderr=subprocess.PIPE, check=False)
    except FileNotFoundError:
        return "there is no strace"
    return "" if done.returncode == 0 else "strace: " + done.stderr.decode().strip()


def read_calls(trace):
    """The calls of main() in a trace."""
    calls, numbers, has_begun = [], collections.Counter(), False
    for line in pathlib.Path(trace).read_text(errors="replace").splitlines():
        found = LINE.match(line)
        if not found:
            continue
        numbers[found[1]] += 1
        has_begun |= line.startswith(FIRST)
        if has_begun:
            calls.append(Call(found[1], numbers[found[1]], found[2]))
    return calls


def with_fault(call, effect, output="/dev/null"):
    """What to put before a command, so that this call of it has an effect, such as `error=EIO`."""
    return [*trace_options(output), "-e", f"trace={call.name}", "-e", f"inject={call.name}:{effect}:when={call.number}"]
