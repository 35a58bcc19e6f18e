"""Runs tests: once with no mutant, to see which mutants each test reaches, then with one mutant at a time."""

import collections
import dataclasses
import os
import re
import resource
import signal
import subprocess
import time

from schemata import BUILD, PROGRAMS

MEMORY = 4 << 30  # bytes of address space for each process
QUICK = 0.5  # seconds of processor time that the first tests of a mutant take in all
PAST_KILLERS = 10  # so many tests, those that killed the most mutants of the file and of all files, run first
ALL = ""  # beside the paths of files
STARTED = re.compile(r"^\[ RUN      \] (\S+)", re.MULTILINE)


@dataclasses.dataclass(frozen=True)
class Test:
    program: str  # a key of PROGRAMS
    name: str
    seconds: float  # of processor time, with no mutant
    reached: int  # bit N: mutant N


@dataclasses.dataclass(frozen=True)
class Result:
    verdict: str  # killed, survived, or not-reached
    by: str = ""  # the test that failed, or how it ended
    seconds: float = 0


def record(count, environment):
    """The tests that pass with no mutant; the names of those that do not."""
    reached, lines = BUILD / "reached", BUILD / "record.tsv"
    tests, failed = [], []
    for program, target in PROGRAMS.items():
        reached.write_bytes(bytes(count + 1))
        lines.unlink(missing_ok=True)
        recording = {"CBC_MUTANT": "0", "CBC_MUTANTS_REACHED": str(reached), "CBC_MUTANTS_RECORD": str(lines)}
        subprocess.run([str(BUILD / "tests" / target), "--gtest_brief=1"], cwd=BUILD / "tests",
                       env={**os.environ, **environment, **recording}, stdout=subprocess.DEVNULL, check=False)
        for line in lines.read_text().splitlines():
            name, outcome, seconds, digits = line.split("\t")
            # The first digit has the first four mutants.
            test = Test(program, name, float(seconds), int(digits[::-1], 16))
            if outcome == "passed":
                tests.append(test)
            else:
                failed.append(name)
    return tests, failed


class Trials:
    """Tries mutants one after the other. `killers`: how often each test killed a mutant, by file."""

    def __init__(self, tests, environment):
        self.tests = sorted(tests, key=lambda test: test.seconds)
        self.environment = environment
        self.killers = collections.defaultdict(collections.Counter)

    def try_mutant(self, mutant):
        start = time.monotonic()
        reaching = [test for test in self.tests if test.reached >> mutant.number & 1]
        if not reaching:
            return Result("not-reached")
        for batch in self.batches(reaching, mutant.path):
            by = self.run(batch, mutant.number)
            if by:
                self.killers[mutant.path][by] += 1
                self.killers[ALL][by] += 1
                return Result("killed", by, time.monotonic() - start)
        return Result("survived", f"{len(reaching)} tests", time.monotonic() - start)

    def batches(self, tests, path):
        """Tests of one program each, in the order in which to run them: what killed others in this file, what is
        quick, then the rest."""
        likely = {name for counts in (self.killers[path], self.killers[ALL])
                  for name, _ in counts.most_common(PAST_KILLERS)}
        left = list(tests)
        for choose in (lambda test, _: test.name in likely, lambda _, total: total <= QUICK, lambda *_: True):
            total, chosen = 0, []
            for test in left:
                total += test.seconds
                if choose(test, total):
                    chosen.append(test)
            left = [test for test in left if test not in chosen]
            for program in PROGRAMS:
                batch = [test for test in chosen if test.program == program]
                if batch:
                    yield batch

    def run(self, batch, number):
        """The name of the first test that fails, or the way in which the program ended; empty if all pass."""
        usual = sum(test.seconds for test in batch)
        limit = int(5 + 10 * usual)

        def set_limits():
            resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        command = [str(BUILD / "tests" / PROGRAMS[batch[0].program]),
                   "--gtest_filter=" + ":".join(test.name for test in batch)]
        environment = {**os.environ, **self.environment, "CBC_MUTANT": str(number), "GTEST_FAIL_FAST": "1"}
        with subprocess.Popen(command, cwd=BUILD / "tests", env=environment, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, start_new_session=True, preexec_fn=set_limits) as process:
            try:
                # On a busy machine; what waits for ever uses no processor time.
                output = process.communicate(timeout=30 + 10 * limit)[0].decode("utf-8", "replace")
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                output = process.communicate()[0].decode("utf-8", "replace")
        if process.returncode == 0:
            return ""
        # With GTEST_FAIL_FAST, what began last has failed, or ended the program.
        started = STARTED.findall(output)
        return started[-1] if started else f"signal {-process.returncode}"
