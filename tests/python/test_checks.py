"""The commands of the program: the same results as on the command line, and how they end."""

import collections.abc
import copy
import html
import inspect
import json
import os
import pickle
import re
import signal
import subprocess
import sys
import time

import pytest

import cbc_catalog as cbc
from conftest import ROBOT, SOURCE, run_cbc

FETCH = ["docs/fetch.yaml", "docs/fetch.mission.yaml"]
CALLS = [
    (cbc.lint, ["docs/fetch.yaml"], {}, []),
    (cbc.lint, ["docs/faulty.yaml"], {"allow": ["dead-task"]}, ["--allow=dead-task"]),
    (cbc.solve, FETCH, {"why": ["SLAM", "DRIVE"], "jobs": 1}, ["--why=SLAM", "--why=DRIVE", "--jobs=1"]),
    (cbc.verify, ["docs/recipes/heartbeat.properties.yaml"], {}, []),
    (cbc.verify, ["catalogs/quadrotor.yaml"], {"cut_sets": "LAND", "order": 1}, ["--cut-sets=LAND", "--order=1"]),
    (cbc.coverage, FETCH, {"prove": True}, ["--prove"]),
    (cbc.sweep, ["docs/fetch.yaml"], {"sequences": 5, "seed": 7}, ["--sequences=5", "--seed=7"]),
    (cbc.tune, FETCH, {}, []),
]


@pytest.mark.parametrize("check, files, options, arguments", CALLS,
                         ids=[f"{c[0].__name__}-{c[1][0]}" for c in CALLS])
def test_same_as_the_command_line(check, files, options, arguments, monkeypatch):
    monkeypatch.chdir(SOURCE)
    report = check(*files, **options)
    status, output, _ = run_cbc(check.__name__, "--format=json", *arguments, *files)
    expected = json.loads(output)
    assert report.to_json() == expected
    assert report.passed == (status == 0)
    assert report.schema == expected["schema"]
    again = pickle.loads(pickle.dumps(report))
    assert again == report and hash(again) == hash(report) and copy.deepcopy(report) is report
    assert len(repr(report)) < 200


def test_records(monkeypatch):
    monkeypatch.chdir(SOURCE)
    report = cbc.solve(*FETCH)
    (event,) = report.runs[0].events
    assert event.running["DRIVE"] == event["running"].DRIVE == "DRIVE_SLOWLY"
    assert list(event.running) == ["DRIVE"] and "DRIVE" in event.running and len(event.running) == 1
    assert not report.passed
    with pytest.raises(cbc.UnknownName, match="did you mean 'events'"):
        report.runs[0]["event"]
    with pytest.raises(AttributeError, match="did you mean 'events'"):
        report.runs[0].event
    with pytest.raises(AttributeError, match="never change"):
        event.time = 3
    assert not hasattr(event, "tyme")
    event.to_json()["running"]["DRIVE"] = "changed"
    assert event.running.DRIVE == "DRIVE_SLOWLY"
    assert report != cbc.solve(*FETCH, why="SLAM")


def test_catalogs_as_arguments(tmp_path):
    text = cbc.Catalog.from_text(ROBOT, name="my robot.yaml")
    report = cbc.lint(text)
    assert report.files[0].file == "my robot.yaml"
    assert "cbc-" not in json.dumps(report.to_json())
    file = tmp_path / "robot.yaml"
    file.write_text(ROBOT)
    catalog = cbc.Catalog(file)
    assert cbc.verify(catalog, same_as=text).passed
    file.write_text(ROBOT + "\n")
    with pytest.raises(cbc.CatalogError, match="has changed since it was loaded"):
        cbc.lint(catalog)
    file.unlink()
    with pytest.raises(cbc.CatalogError, match="cannot read .* any more"):
        cbc.lint(catalog)


def test_what_cannot_be_used(tmp_path):
    with pytest.raises(cbc.CatalogError) as caught:
        cbc.solve(SOURCE / "docs/faulty.yaml", SOURCE / "docs/fetch.mission.yaml")
    assert caught.value.findings[0].rule == "unknown-key"
    with pytest.raises(cbc.UsageError, match="none.yaml"):
        cbc.verify(tmp_path / "none.yaml")
    with pytest.raises(cbc.UsageError, match="--jobs"):
        cbc.solve(*[SOURCE / file for file in FETCH], jobs=-1)
    with pytest.raises(cbc.UsageError):
        cbc.sweep()
    with pytest.raises(cbc.UsageError, match="NUL"):
        cbc.lint("a\0b")
    for wrong in (1, None, b"robot.yaml", ["a"]):
        with pytest.raises(TypeError):
            cbc.lint(wrong)
    with pytest.raises(TypeError, match="time_limits"):
        cbc.verify("robot.yaml", time_limits=3)
    with pytest.raises(TypeError, match="max_states"):
        cbc.verify("robot.yaml", max_states=object())


def test_a_file_that_looks_like_an_option(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "--strict").write_text(ROBOT)
    assert cbc.lint("--strict").files[0].file == "./--strict"


def test_no_program(monkeypatch):
    monkeypatch.setenv("CBC_PROGRAM", "/nonexistent/cbc")
    with pytest.raises(cbc.Error, match="cannot run the program /nonexistent/cbc"):
        cbc.lint("robot.yaml")
    monkeypatch.setenv("CBC_PROGRAM", "/bin/false")
    with pytest.raises(cbc.Error):
        cbc.lint("robot.yaml")


# What is not an option of a function: output goes to Python, and these are other commands.
LEFT_OUT = {"help", "format", "output", "brief", "fix", "diff", "stdin_filename", "explain", "list_rules",
            "write", "write_missing", "state_out", "state_in", "clock", "serve", "replay", "to_script"}


@pytest.mark.parametrize("check", [cbc.lint, cbc.solve, cbc.verify, cbc.coverage, cbc.sweep, cbc.tune])
def test_all_options_of_the_command_line(check):
    helped = run_cbc(check.__name__, "--help")[1]
    options = {name.replace("-", "_") for name in re.findall(r"^  (?:-\w,)?--([a-z-]+)", helped, re.M)}
    known = set(inspect.signature(check).parameters) - {"files"}
    assert known <= options
    assert options - known <= LEFT_OUT


SLEEP = "#!/bin/sh\necho $$ > \"$0.pid\"\nexec sleep 60\n"
INTERRUPTED = """
import cbc_catalog as cbc
try:
    cbc.verify("robot.yaml")
except KeyboardInterrupt:
    print("interrupted")
"""


def test_ctrl_c_ends_a_check_at_once(tmp_path):
    slow = tmp_path / "cbc"
    slow.write_text(SLEEP)
    slow.chmod(0o755)
    with subprocess.Popen([sys.executable, "-c", INTERRUPTED], stdout=subprocess.PIPE,
                          env={**os.environ, "CBC_PROGRAM": str(slow)}) as process:
        pid = tmp_path / "cbc.pid"
        deadline = time.monotonic() + 30
        while not (pid.exists() and pid.read_text().strip()) and time.monotonic() < deadline:
            time.sleep(0.01)
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=30)
    assert output == b"interrupted\n"
    with pytest.raises(ProcessLookupError):
        os.kill(int(pid.read_text()), 0)


def test_ctrl_c_while_a_check_begins(tmp_path, monkeypatch):
    slow = tmp_path / "cbc"
    slow.write_text(SLEEP)
    slow.chmod(0o755)
    monkeypatch.setenv("CBC_PROGRAM", str(slow))
    started = []
    popen = subprocess.Popen

    def interrupted(*arguments, **named):
        started.append(popen(*arguments, **named))
        os.kill(os.getpid(), signal.SIGINT)
        return started[0]

    monkeypatch.setattr(subprocess, "Popen", interrupted)
    handler = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        cbc.lint("robot.yaml")
    assert started[0].returncode == -signal.SIGKILL
    assert signal.getsignal(signal.SIGINT) is handler


def test_a_notebook_shows_the_page(tmp_path):
    page = tmp_path / "mission.html"
    report = cbc.solve(SOURCE / "catalogs" / "quadrotor.yaml", SOURCE / "catalogs" / "quadrotor.mission.yaml",
                       html=page)
    shown = report._repr_html_()
    assert html.unescape(shown.split('srcdoc="')[1].split('"')[0]) == page.read_text(encoding="utf-8")
    assert pickle.loads(pickle.dumps(report))._repr_html_() == shown
    assert cbc.lint(SOURCE / "catalogs" / "quadrotor.yaml")._repr_html_() is None


def test_a_warning_is_not_the_reason(tmp_path):
    catalog = tmp_path / "robot.yaml"
    catalog.write_text("situation:\n- variable: UNUSED\nbehaviors:\n- {behavior: GO_FAST, task: GO}\n")
    assert "UNUSED" in run_cbc("solve", catalog, tmp_path / "none.yaml")[2]
    for call, reason in ((lambda: cbc.solve(catalog, tmp_path / "none.yaml"), "none.yaml"),
                         (lambda: cbc.solve(catalog), "no event script"),
                         (lambda: cbc.verify(catalog, cut_sets=["GOO"]), "did you mean 'GO'")):
        with pytest.raises(cbc.UsageError, match=reason) as found:
            call()
        assert "UNUSED" not in str(found.value)


def test_records_are_mappings():
    report = cbc.solve(SOURCE / "catalogs" / "quadrotor.yaml", SOURCE / "catalogs" / "quadrotor.mission.yaml")
    event = report.runs[0].events[0]
    assert isinstance(event, collections.abc.Mapping)
    assert event.running == event.to_json()["running"] == dict(event.running)
    assert event.running != {"HOVER": "LAND"}
    assert event.get("outcome") == "accepted" and event.get("nothing", 5) == 5
    assert set(event.keys()) == set(event)
