"""The disk becomes full while a command writes. The disk is a tmpfs, for which the tests need a mount namespace of
their own, or an administrator; `./dev test-faults` makes one if it can."""

import contextlib
import errno
import os
import shutil
import subprocess
import unittest

from commands import COMMANDS, contents
from fault_case import FaultCase, Run

PAGE = 4096
SIZE = 4 << 20


def mount(folder):
    """Mounts a disk with SIZE bytes. Returns why that is not possible, or nothing."""
    folder.mkdir()
    done = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={SIZE},nr_inodes=100", "none", str(folder)],
                          stderr=subprocess.PIPE, check=False)
    return done.stderr.decode().strip() if done.returncode != 0 else ""


class FullDisk(FaultCase):

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        problem = mount(cls.work / "trial")
        if problem:
            raise unittest.SkipTest(f"no tmpfs can be mounted ({problem}); test_limits.py limits the size of files")
        subprocess.run(["umount", str(cls.work / "trial")], check=True)

    def check(self, job, folder):
        command, free_pages, free_inodes = job
        self.assertEqual(mount(folder), "")
        try:
            run = Run(command, folder / "run")
            self.assertEqual(run.status, command.status, run.err)
            for name in command.outputs:  # they are old outputs now; those of init must not exist
                (folder / "run" / name).unlink()
                if command.replaces:
                    (folder / "run" / name).write_bytes(run.before.get(name, b"an old output\n"))
            run.before = contents(run.folder)
            with self.filled(folder, free_pages, free_inodes):
                run.again()
            self.assertGreaterEqual(run.status, 0, f"ended by signal {-run.status}: {run.err}")
            self.assert_whole(run)
            if run.status == command.status:
                self.assert_complete(run)
            else:
                names = [name.rsplit("/", 1)[-1] for name in command.outputs]
                self.assert_refused(run, (os.strerror(errno.ENOSPC),), names)
            self.assert_recovers(run)  # there is space again
        finally:
            # Lazily: another thread that starts a process may hold a file of it for a moment.
            subprocess.run(["umount", "--lazy", str(folder)], check=True)

    @contextlib.contextmanager
    def filled(self, folder, free_pages, free_inodes):
        filler = folder / "filler"
        filler.mkdir()
        state = os.statvfs(folder)
        for number in range(state.f_favail - 1 - free_inodes):
            (filler / str(number)).touch()
        (filler / "content").write_bytes(bytes((os.statvfs(folder).f_bavail - free_pages) * PAGE))
        yield
        shutil.rmtree(filler)

    def test_each_command(self):
        jobs = []
        for command in COMMANDS:
            size = sum(len(self.good[command].after[name]) for name in command.outputs)
            pages = size // PAGE + 2 * len(command.outputs)
            jobs += [(command, free, 50) for free in sorted({0, 1, 2, pages // 2, pages - 1, pages})]
            jobs += [(command, pages, free) for free in (0, 1)]
        self.each(self.check, jobs)


if __name__ == "__main__":
    unittest.main()
