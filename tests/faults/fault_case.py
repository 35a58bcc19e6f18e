"""What is the same in all tests of faults: how a command is run, and what may come of it."""

import concurrent.futures
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import commands

TEMPORARY = re.compile(r"(.*/)?\.cbc-[0-9a-f]{16}\.tmp")  # what a killed run may leave
UNUSABLE = 2  # the exit status of all faults


class Run:
    """A command that was run in a folder of its own, and what was in the folder before and after."""

    def __init__(self, command, folder, has_old=False, prefix=()):
        self.command = command
        commands.fill(folder, command, has_old)
        self.folder = folder
        self.before = commands.contents(folder)
        self.again(prefix)

    def again(self, prefix=()):
        """Runs the command in the folder as it is."""
        with open(self.folder / self.command.stdin, "rb") as stdin:
            done = subprocess.run([*prefix, *self.command.line()], cwd=self.folder, stdin=stdin, check=False,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=300)
        self.status, self.out, self.err = done.returncode, done.stdout, done.stderr.decode()
        self.after = commands.contents(self.folder)
        return self


class FaultCase(unittest.TestCase):
    """Has a folder to work in, and the run of each command in which nothing goes wrong."""

    COMMANDS = commands.COMMANDS

    @classmethod
    def setUpClass(cls):
        cls.work = pathlib.Path(tempfile.mkdtemp(prefix="cbc-faults-"))
        cls.addClassCleanup(shutil.rmtree, cls.work, ignore_errors=True)
        cls.good = {}
        for command in cls.COMMANDS:
            run = Run(command, cls.work / f"good-{command.name}")
            assert run.status == command.status, f"{command.name}: {run.status}\n{run.err}"
            changed = {name for name, content in run.after.items() if run.before.get(name) != content}
            assert changed == set(command.outputs), f"{command.name} writes {changed}"
            cls.good[command] = run

    def each(self, what, jobs):
        """Calls what(job, folder) for each job, some at the same time, and shows the first that fail."""
        shown = 5
        failures = []

        def attempt(number, job):
            folder = self.work / f"{self.id().rsplit('.', 1)[1]}-{number}"
            try:
                if len(failures) < shown:
                    what(job, folder)
            except (AssertionError, subprocess.TimeoutExpired) as error:
                failures.append((job, error))
            finally:
                shutil.rmtree(folder, ignore_errors=True)

        jobs = list(jobs)
        self.assertGreater(len(jobs), 0)
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            list(pool.map(attempt, range(len(jobs)), jobs))
        for job, error in failures[:shown]:
            with self.subTest(fault=" ".join(map(str, job))):
                raise error
        print(f"{self.id().rsplit('.', 1)[1]}: {len(jobs)} runs")

    def assert_whole(self, run, may_leave_temporary=False):
        """Each output is the old or the new one as a whole, nothing else has changed, and nothing is left."""
        good = self.good[run.command]
        for name in run.command.outputs:
            content = run.after.get(name)
            if content not in (run.before.get(name), good.after[name]):
                self.assertTrue(run.command.ends_early and run.status == UNUSABLE, f"a part of {name}: {run.err}")
                self.assertEqual(json.loads(content)["schema"], json.loads(good.after[name])["schema"])
        expected = {*run.before, *run.command.outputs}
        left = {name for name in {*run.after} - expected if not (may_leave_temporary and TEMPORARY.fullmatch(name))}
        self.assertEqual(left, set(), run.err)
        for name, content in run.before.items():
            if name not in run.command.outputs:
                self.assertEqual(run.after.get(name), content, name)

    def assert_complete(self, run):
        """Nothing went wrong, or it does not show."""
        good = self.good[run.command]
        self.assertEqual((run.status, run.err), (good.status, good.err))
        self.assertEqual(run.out, good.out)
        for name in run.command.outputs:
            self.assertEqual(run.after.get(name), good.after[name], name)

    def assert_recovers(self, run, may_leave_temporary=False):
        """The next run makes what this one has left undone, and nothing else is left."""
        good = self.good[run.command].after
        is_done = all(run.after.get(name) == good[name] for name in run.command.outputs)
        run.again()
        # init refuses where all is there already, and rename where the old name is gone.
        status = UNUSABLE if is_done and not run.command.repeats else run.command.status
        self.assertEqual(run.status, status, run.err)
        for name in run.command.outputs:
            self.assertEqual(run.after.get(name), good[name], name)
        expected = {*run.before, *run.command.outputs}
        left = {name for name in {*run.after} - expected if not (may_leave_temporary and TEMPORARY.fullmatch(name))}
        self.assertEqual(left, set())

    def assert_refused(self, run, reasons, names=()):
        """The command says which file is the matter, and why."""
        self.assertEqual(run.status, UNUSABLE, run.err)
        self.assertTrue(any(reason in run.err for reason in reasons), f"{reasons} in {run.err!r}")
        if names and "out of memory" not in run.err:
            self.assertTrue(any(name in run.err for name in names), f"{names} in {run.err!r}")
