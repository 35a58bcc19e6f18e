"""A compiled catalog shrinks while it is mapped into memory. The program is held for a moment after it has mapped it,
which strace does."""

import contextlib
import pathlib
import subprocess
import time
import unittest

import system_calls
from commands import PROGRAM, ROOT
from fault_case import FaultCase

# With "robot.cbc", which is mapped, and "robot.yaml", of which it was made.
COMMANDS = [
    "solve robot.cbc mission.yaml --html page.html",
    "sweep robot.cbc --sequences 3 -j 1 --slowest slow.yaml",
    "graph robot.cbc -o robot.dot",
    "graph --diff robot.cbc robot.yaml --format text -o diff.txt",
    "verify robot.cbc -j 1 --max-states 100 -o result.txt",
    "compile --check robot.yaml -o robot.cbc",
    "compile --dump robot.cbc",
]


@unittest.skipIf(system_calls.why_not(), system_calls.why_not())
class ShrinkingFiles(FaultCase):

    def check(self, job, folder):
        arguments, size = job
        folder.mkdir()
        (folder / "robot.yaml").write_bytes((ROOT / "catalogs/quadrotor.yaml").read_bytes())
        (folder / "mission.yaml").write_bytes((ROOT / "catalogs/quadrotor.mission.yaml").read_bytes())
        subprocess.run([PROGRAM, "compile", "robot.yaml", "-o", "robot.cbc"], cwd=folder, check=True)
        before = {path.name for path in folder.iterdir()}
        line = [PROGRAM, *arguments.split()]
        trace = folder.with_suffix(".trace")
        subprocess.run([*system_calls.trace_options(trace), *line], cwd=folder, check=False, capture_output=True)
        for path in folder.iterdir():
            if path.name not in before:
                path.unlink()
        mapped = [call for call in system_calls.read_calls(trace) if call.name == "mmap" and "robot.cbc" in call.arguments]
        self.assertEqual(len(mapped), 1, arguments)
        held = system_calls.with_fault(mapped[0], "delay_exit=2000000")
        process = subprocess.Popen([*held, *line], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.wait_until_mapped(process.pid)
        with open(folder / "robot.cbc", "r+b") as file:
            file.truncate(size)
        _, errors = process.communicate()
        # What is left of its last page is zero: for --check, that is another catalog.
        if "--check" not in arguments or process.returncode != 1:
            self.assertEqual(process.returncode, 2, errors)
            self.assertRegex(errors.decode(), "compiled catalog|it is damaged")
        self.assertEqual({path.name for path in folder.iterdir()}, before)

    def wait_until_mapped(self, tracer):
        deadline = time.monotonic() + 60
        children = pathlib.Path(f"/proc/{tracer}/task/{tracer}/children")
        while time.monotonic() < deadline:
            for child in children.read_text().split():
                # strace first tries what it can do, with children that end at once.
                with contextlib.suppress(FileNotFoundError, ProcessLookupError):
                    if "robot.cbc" in pathlib.Path(f"/proc/{child}/maps").read_text():
                        return
            time.sleep(0.01)
        self.fail("robot.cbc is not mapped")

    def test_compiled_catalogs(self):
        self.each(self.check, ((arguments, size) for arguments in COMMANDS for size in (0, 4096, 5000)))


if __name__ == "__main__":
    unittest.main()
