"""What comes of it when somebody types a part of a command, presses the tab key, and then enter?

A program that takes the place of cbc notes its arguments; completion asks the true one.
"""

import os
import pty
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

shell, folder = sys.argv[1], Path(sys.argv[2])
home = Path(os.environ["HOME"])

# What is typed before the tab key, and the arguments that cbc must get. No name is typed in full. The
# cursor goes back to where a | stands.
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
    # bash breaks words here.
    (r"cbc lint arm@2", ["lint", "arm@2.yaml"]),
    (r"cbc lint arm@", ["lint", "arm@2.yaml"]),
    (r"cbc lint x:y", ["lint", "x:y=z.yaml"]),
    (r"cbc lint x:y=", ["lint", "x:y=z.yaml"]),
    (r"cbc lint x:", ["lint", "x:y=z.yaml"]),
    (r"cbc graph robot.yaml --task T@h", ["graph", "robot.yaml", "--task", "T@home"]),
    (r"cbc graph robot.yaml --task=T@", ["graph", "robot.yaml", "--task=T@home"]),
    (r"cbc graph arm@2.yaml --task GR", ["graph", "arm@2.yaml", "--task", "GRASP"]),
    # Values with blanks behind an equals sign.
    (r"cbc graph robot.yaml --task='x t", ["graph", "robot.yaml", "--task=x two words"]),
    (r"cbc graph --script='my dir/third.yaml' --task HOV",
     ["graph", "--script=my dir/third.yaml", "--task", "HOVER"]),
    # A script names the catalog.
    (r"cbc solve missions/third.yaml --why HOVER_",
     ["solve", "missions/third.yaml", "--why", "HOVER_WITH_MPC"]),
    (r"cbc graph --script missions/third.yaml --task HOV",
     ["graph", "--script", "missions/third.yaml", "--task", "HOVER"]),
    # What is no file and no name stays as it is; short options take no '='.
    (r"cbc compile robot.yaml uni", ["compile", "robot.yaml", "uni"]),
    (r"cbc compile robot.yaml --uni", ["compile", "robot.yaml", "--uni"]),
    (r"cbc graph arm@2.yaml --task task", ["graph", "arm@2.yaml", "--task", "task"]),
    (r"cbc graph robot.yaml -o=rob", ["graph", "robot.yaml", "-o=rob"]),
    # Scripts may be JSON.
    (r"cbc solve robot.yaml missions/se", ["solve", "robot.yaml", "missions/second.json"]),
    (r"cbc graph robot.yaml --script missions/se",
     ["graph", "robot.yaml", "--script", "missions/second.json"]),
]

# The catalog is behind the cursor; fish does not tell its scripts what is there.
BEHIND_LINES = [
    (r"cbc graph --task HOV| robot.yaml", ["graph", "--task", "HOVER", "robot.yaml"]),
    (r"cbc graph --task=HOV| my\ dir/robot.yaml", ["graph", "--task=HOVER", "my dir/robot.yaml"]),
    (r"cbc graph --task | 'arm@2.yaml'", ["graph", "--task", "GRASP", "arm@2.yaml"]),
    (r"cbc graph --task T@h| --depth 1 robot.yaml",
     ["graph", "--task", "T@home", "--depth", "1", "robot.yaml"]),
    (r"cbc graph --task HOV| --script=missions/third.yaml",
     ["graph", "--task", "HOVER", "--script=missions/third.yaml"]),
    (r"cbc gra| robot.yaml", ["graph", "robot.yaml"]),
    (r"cbc graph --task |  arm@2.yaml", ["graph", "--task", "GRASP", "arm@2.yaml"]),
]

# In a folder with a file that would be taken for an option.
DASH_LINES = [
    (r"cbc lint ", ["lint", "robot.yaml"]),
    (r"cbc lint -- -d", ["lint", "--", "-dash.yaml"]),
]

# The same for a shell that finds the script itself.
INSTALLED_LINES = [
    (r"cbc lint rob", ["lint", "robot.yaml"]),
    (r"cbc graph robot.yaml --task 'x t", ["graph", "robot.yaml", "--task", "x two words"]),
]

# How the shells start: with the script sourced, or for zsh on its path; and with it installed as
# 'cbc completion --help' says.
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
BASH_COMPLETION = Path("/usr/share/bash-completion/bash_completion")
INSTALLED_COMMANDS = {"bash": COMMANDS["bash"], "zsh": ["zsh", "-i"], "fish": ["fish", "-i"]}
INSTALLED_STARTS = {
    "bash": (folder / "start", f"PS1='ready> '\n. '{BASH_COMPLETION}'\n"),
    "zsh": (home / ".zshrc",
            "PS1='ready> '; fpath+=(~/.zfunc); autoload -U compinit; compinit -u -D\n"),
    "fish": (home / ".config/fish/config.fish", "function fish_prompt; echo 'ready> '; end\n"),
}
BACK = "\x02"  # Ctrl-B
LONGEST_WAIT = 30  # seconds: only a shell that hangs takes as long


class Terminal:
    def __init__(self, command, environment, place):
        # fish wants a terminal that it controls.
        self.process, self.master = pty.fork()
        if self.process == 0:
            os.chdir(place)
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


def install():
    """Does what the help says."""
    help_text = subprocess.run(["cbc", "completion", "--help"], check=True, capture_output=True, text=True)
    for line in help_text.stdout.splitlines():
        if line.startswith(("    mkdir -p ~/", f"    cbc completion {shell} > ~/")):
            subprocess.run(["sh", "-c", line], check=True)


def call(terminal, typed_start, typed, notes):
    """The arguments that cbc gets (none: it is not called), and the terminal then."""
    notes.unlink(missing_ok=True)
    if typed_start:
        terminal.type(typed_start)
        terminal.read_until(lambda: terminal.shown.count(b"ready> ") >= 2)
    else:
        terminal.read_until(lambda: b"ready> " in terminal.shown)
    before, _, behind = typed.partition("|")
    # An open quote is closed by the shell, together with the word.
    terminal.type(before + behind + BACK * len(behind) + "\t\n")
    is_called = terminal.read_until(notes.exists)
    terminal.close()
    return notes.read_bytes().decode().split("\0")[:-1] if is_called else None, terminal.shown


def main():
    notes = folder / "called"
    fake = folder / "typed"
    fake.mkdir()
    write_program(fake / "cbc", notes)
    environment = dict(os.environ, PATH=f"{fake}:{os.environ['PATH']}", HISTFILE="/dev/null")
    faults = []

    def check(command, typed_start, lines, place="."):
        for typed, expected in lines:
            terminal = Terminal(command, environment, place)
            found, shown = call(terminal, typed_start, typed, notes)
            if found != expected:
                faults.append(f"{typed}: expected {expected}, found {found}")
                faults.append(f"  on the terminal: {shown[-300:]!r}")

    start = STARTS[shell].format(folder=folder, script=folder / "_cbc")
    (folder / "start").write_text(start)
    typed_start = start if shell == "zsh" else ""
    check(COMMANDS[shell], typed_start, LINES)
    if shell != "fish":
        check(COMMANDS[shell], typed_start, BEHIND_LINES)
    check(COMMANDS[shell], typed_start, DASH_LINES, "dash")
    if shell == "bash" and not BASH_COMPLETION.exists():
        print("typing.py: bash: an installed script is not tested: there is no bash-completion",
              file=sys.stderr)
    else:
        install()
        path, text = INSTALLED_STARTS[shell]
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        check(INSTALLED_COMMANDS[shell], "", INSTALLED_LINES)
    for fault in faults:
        print(f"typing.py: {shell}: {fault}", file=sys.stderr)
    sys.exit(1 if faults else 0)


main()
