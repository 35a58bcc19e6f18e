"""Commands with too little memory, too few descriptors, and a limit on the size of files, by prlimit(1); and outputs
on /dev/full."""

import dataclasses
import subprocess
import unittest

from commands import COMMANDS, PROGRAM
from fault_case import FaultCase, Run

PAGE = 4096
NO_LOADER = 127  # the exit status of the loader, before the program begins


def limited(**limits):
    return ["prlimit", *(f"--{name}={value}" for name, value in limits.items())]


class Limits(FaultCase):

    def check(self, job, folder, reasons, names=()):
        command, limits = job
        run = Run(command, folder, command.replaces, limited(**limits))
        if run.status == NO_LOADER:
            return False
        self.assertGreaterEqual(run.status, 0, f"ended by signal {-run.status}: {run.err}")
        self.assert_whole(run)
        if run.status == command.status:
            self.assert_complete(run)
            return True
        self.assert_refused(run, reasons, names)
        return False

    def lowest(self, name, command, highest):
        """The lowest limit with which a command line starts and ends."""
        lowest = 0
        while highest - lowest > PAGE:
            middle = (lowest + highest) // 2
            done = subprocess.run([*limited(**{name: middle}), *command], cwd=self.good_folder, check=False,
                                  stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            lowest, highest = (lowest, middle) if done.returncode in (0, 1) else (middle, highest)
        return highest

    def test_memory(self):
        self.good_folder = self.work
        start = self.lowest("as", [PROGRAM, "--version"], 1 << 30)
        jobs = []
        # With little memory Graphviz draws with other fonts, or not at all.
        for command in (one for one in COMMANDS if one.name != "graph_svg"):
            self.good_folder = self.good[command].folder
            # Not for init, which has nothing to do there.
            end = self.lowest("as", command.line(), 1 << 30) if command.replaces else start + (1 << 20)
            steps = 25
            jobs += [(command, {"as": start + (end - start) * step // steps}) for step in range(1, steps + 2)]
        reasons = ("out of memory", "Cannot allocate memory")
        self.each(lambda job, folder: self.check(job, folder, reasons), jobs)

    def test_descriptors(self):
        done = set()

        def check(job, folder):
            if self.check(job, folder, ("Too many open files",)):
                done.add(job[0])

        self.each(check, ((command, {"nofile": count}) for command in COMMANDS for count in range(4, 14)))
        self.assertEqual(done, {*COMMANDS})

    def test_size_of_files(self):
        jobs = []
        # Graphviz writes into a file in memory, whose size is limited, too.
        for command in (one for one in COMMANDS if one.name != "graph_svg"):
            sizes = [len(self.good[command].after[name]) for name in command.outputs]
            jobs += [(command, {"fsize": size}) for size in {0, 1, min(sizes) - 1, max(sizes) // 2, max(sizes) - 1}]
            jobs.append((command, {"fsize": max(sizes)}))

        def check(job, folder):
            command, limits = job
            sizes = [len(self.good[command].after[name]) for name in command.outputs]
            fits = limits["fsize"] >= max(sizes)
            names = [name.rsplit("/", 1)[-1] for name in command.outputs]
            self.assertEqual(self.check(job, folder, ("File too large",), names), fits)

        self.each(check, jobs)

    def test_full_device(self):
        """An output that is /dev/full, by a link, and standard output there."""

        def check(command, folder):
            name = command.outputs[0]
            run = Run(command, folder)
            (folder / name).unlink()
            (folder / name).symlink_to("/dev/full")
            run.again()
            self.assert_refused(run, ("it is not a regular file",), (name,))
            full = dataclasses.replace(command, arguments=command.arguments.replace(name, "-"))
            with open("/dev/full", "wb") as device:
                done = subprocess.run(full.line(), cwd=folder, stdout=device, stderr=subprocess.PIPE, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertIn(b"cannot write the output: No space left on device", done.stderr)

        self.each(check, [command for command in COMMANDS if command.name in ("compile", "graph_dot", "verify")])


if __name__ == "__main__":
    unittest.main()
