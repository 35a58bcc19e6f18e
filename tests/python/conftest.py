"""What the tests of cbc_catalog share."""

import os
import pathlib
import subprocess
import sys

import pytest

import cbc_catalog as cbc
from cbc_catalog import _program

SOURCE = pathlib.Path(__file__).resolve().parents[2]

# The robot of most tests: a variable of each kind, a reactive task, a timeout, parameters.
ROBOT = """
situation:
- {variable: PEOPLE, values: [none, near, far]}
- variable: RAIN
behaviors:
- {behavior: DRIVE_FAST, task: DRIVE, suitability: 90, requires: [{task: LOCALIZE}], situation: {PEOPLE: [none, far]}}
- {behavior: DRIVE_SLOWLY, task: DRIVE, suitability: 80}
- {behavior: LIFT_UP, task: LIFT, suitability: 70, timeout: 5}
- {behavior: SLAM, task: LOCALIZE, suitability: 100}
- {behavior: BEACON, task: SIGNAL, suitability: 60}
tasks:
- {task: DRIVE, parameters: [{parameter: speed}]}
- {task: LIFT}
- {task: LOCALIZE, start_on_request: false, execution_goal: keep_running}
- {task: SIGNAL, start_on_request: false, reactive_start: true}
exclusivity_constraints:
- mutually_exclusive: [DRIVE, LIFT]
"""


@pytest.fixture(scope="session")
def catalog():
    return cbc.Catalog(SOURCE / "catalogs" / "quadrotor.yaml")


@pytest.fixture
def robot(catalog):
    return cbc.Coordinator(catalog)


def run_cbc(*arguments, cwd=SOURCE):
    """Exit status and output of the program."""
    done = subprocess.run([_program.program(), *map(str, arguments)], cwd=cwd, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


def run_python(*arguments, cwd=None, **variables):
    """Exit status and all that a Python of its own writes."""
    done = subprocess.run([sys.executable, "-B", *map(str, arguments)], cwd=cwd, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          stdin=subprocess.DEVNULL, env={**os.environ, **variables})
    return done.returncode, done.stdout.decode()
