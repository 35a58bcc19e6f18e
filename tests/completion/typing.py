"""What comes of it when somebody types a part of a command, presses the tab key, and then enter?

A program that takes the place of cbc notes its arguments; completion asks the true one.
"""

import os
import pty
import select
import signal
import sys
import time
from pathlib import Path

shell, folder = sys.argv[1], Path(sys.argv[2])

# What is typed before the tab key, and the arguments that cbc must get. No name is typed in full.
LINES = [
    (r"cbc gra", ["graph"]),
    (r"cbc lint --exp", ["lint", "--explain"]),
    (r"cbc lint --format=sar", ["lint", "--format=sarif"]),
    (r"cbc lint --explain dead-t", ["lint", "--explain", "dead-task"]),
    (r"cbc lint rob", ["lint", "robot.yaml"]),
    (r"cbc graph my\ dir/ro", ["graph", "my dir/robot.yaml"]),
    (r"cbc lint --script=missions/f", ["lint", "--script=missions/first.yaml"]),
    (r"cbc graph robot.yaml --task HOV", ["graph", "robot.yaml", "--task", "HOVER"]),
    (r"cbc graph my\ dir/robot.yaml --task HOV", ["graph", "my dir/robot.yaml", "--task", "HOVER"]),
    (r"cbc graph robot.yaml --task A:B", ["graph", "robot.yaml", "--task", "A:B=C"]),
    (r"cbc graph robot.yaml --task x\ t", ["graph", "robot.yaml", "--task", "x two words"]),
    (r"cbc graph robot.yaml --task 'x t", ["graph", "robot.yaml", "--task", "x two words"]),
    (r"cbc graph robot.yaml --task x\;", ["graph", "robot.yaml", "--task", "x;touch pwned"]),
    (r"cbc graph robot.yaml --task \`", ["graph", "robot.yaml", "--task", "`touch pwned`"]),
    (r"cbc graph robot.yaml --task \$\{", ["graph", "robot.yaml", "--task", "${HOME}"]),
    (r"cbc solve robot.yaml m --why \$\(", ["solve", "robot.yaml", "m", "--why", "$(touch pwned)"]),
    (r"cbc graph robot.yaml --task \~", ["graph", "robot.yaml", "--task", "~"]),
    (r"cbc graph robot.yaml --task '`", ["graph", "robot.yaml", "--task", "`touch pwned`"]),
    (r'cbc graph robot.yaml --task "x t', ["graph", "robot.yaml", "--task", "x two words"]),
    (r'cbc solve robot.yaml m --why "\$(t', ["solve", "robot.yaml", "m", "--why", "$(touch pwned)"]),
    (r"cbc solve robot.yaml m --why -d", ["solve", "robot.yaml", "m", "--why", "-dash"]),
    (r"cbc solve robot.yaml m --why back", ["solve", "robot.yaml", "m", "--why", r"back\slash*?"]),
    (r"cbc solve robot.yaml m --why it\'s\ ", ["solve", "robot.yaml", "m", "--why", "it's \"two words\""]),
]

COMMANDS = {
    "bash": ["bash", "--noprofile", "--rcfile", folder / "start", "-i"],
    "zsh": ["zsh", "-f", "-i"],
    "fish": ["fish", "--no-config", "-i", "--init-command", f"source '{folder}/start'"],
}
STARTS = {
    "bash": "PS1='ready> '\n. '{script}'\n",
    "zsh": "PS1='ready> '; fpath+=('{folder}'); autoload -U compinit; compinit -u -D\n",
    "fish": "function fish_prompt; echo 'ready> '; end\nsource '{script}'\n",
}
LONGEST_WAIT = 30  # seconds: only a shell that hangs takes as long


class Terminal:
    def __init__(self, command, environment):
        # fish wants a terminal that it controls.
        self.process, self.master = pty.fork()
        if self.process == 0:
            os.execvpe(command[0], command, environment)
        self.shown = b""

    def read_until(self, is_done):
        end = time.monotonic() + LONGEST_WAIT
        while not is_done():
            if time.monotonic() > end:
                return False
            if select.select([self.master], [], [], 0.05)[0]:
                try:
                    self.shown += os.read(self.master, 4096)
                except OSError:
                    return is_done()
        return True

    def type(self, text):
        os.write(self.master, text.encode())

    def close(self):
        os.kill(self.process, signal.SIGKILL)
        os.waitpid(self.process, 0)
        os.close(self.master)


def write_program(path, notes):
    true_program = folder / "bin" / "cbc"
    path.write_text(
        "#!/bin/sh\n"
        f'[ "$1" = __complete ] && exec \'{true_program}\' "$@"\n'
        f"printf '%s\\0' \"$@\" >'{notes}.part' && mv '{notes}.part' '{notes}'\n")
    path.chmod(0o755)


def main():
    notes = folder / "called"
    fake = folder / "typed"
    fake.mkdir()
    write_program(fake / "cbc", notes)
    start = STARTS[shell].format(folder=folder, script=folder / "_cbc")
    (folder / "start").write_text(start)
    environment = dict(os.environ, PATH=f"{fake}:{os.environ['PATH']}", HISTFILE="/dev/null")
    faults = []
    for typed, expected in LINES:
        notes.unlink(missing_ok=True)
        terminal = Terminal(COMMANDS[shell], environment)
        if shell == "zsh":
            terminal.type(start)
            terminal.read_until(lambda: terminal.shown.count(b"ready> ") >= 2)
        else:
            terminal.read_until(lambda: b"ready> " in terminal.shown)
        # An open quote is closed by the shell, together with the word.
        terminal.type(typed + "\t\n")
        called = terminal.read_until(notes.exists)
        terminal.close()
        found = notes.read_bytes().decode().split("\0")[:-1] if called else None
        if found != expected:
            faults.append(f"{typed}: expected {expected}, found {found}")
            if not called:
                faults.append(f"  on the terminal: {terminal.shown[-300:]!r}")
    for fault in faults:
        print(f"typing.py: {shell}: {fault}", file=sys.stderr)
    sys.exit(1 if faults else 0)


main()
