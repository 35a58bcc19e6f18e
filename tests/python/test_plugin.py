"""The plugin for pytest, in projects of its own."""

import xml.etree.ElementTree

import pytest

from conftest import ROBOT, run_python

pytest.importorskip("pytest")

GOOD = """
catalog: ../robot.yaml
events:
- start: DRIVE
- expect: {outcome: accepted, running: {DRIVE: DRIVE_FAST}}
"""
BAD = """
catalog: ../robot.yaml
events:
- start: DRIVE
- situation: {PEOPLE: near}
- expect: {running: {DRIVE: DRIVE_FAST}}
"""
PROPERTIES = """
catalog: ../robot.yaml
properties:
- name: never both
  never: {running: [DRIVE, LIFT]}
- name: never a signal
  never: {running: [SIGNAL]}
"""
INI = """
[pytest]
cbc_paths = missions properties
cbc_catalog = robot.yaml
"""
TESTS = """
def test_of_python(robot):
    assert robot.start("DRIVE").accepted

def test_is_fresh(robot):
    assert robot.now == 0 and not robot.running
"""


@pytest.fixture
def project(tmp_path):
    for name, text in {
            "robot.yaml": ROBOT, "missions/good.yaml": GOOD, "missions/bad.yaml": BAD,
            "missions/notes.yaml": "a: b", "properties/robot.properties.yaml": PROPERTIES,
            "other/good.yaml": GOOD, "pytest.ini": INI, "tests/test_robot.py": TESTS}.items():
        file = tmp_path / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)

    def run(*arguments):
        return run_python("-m", "pytest", "-p", "no:cacheprovider", *arguments, cwd=tmp_path)

    run.folder = tmp_path
    return run


def test_collects(project):
    status, output = project("--collect-only", "-q")
    assert status == 0, output
    listed = [line for line in output.splitlines() if "::" in line]
    assert listed == ["missions/bad.yaml::bad", "missions/good.yaml::good",
                      "properties/robot.properties.yaml::never both",
                      "properties/robot.properties.yaml::never a signal",
                      "tests/test_robot.py::test_of_python", "tests/test_robot.py::test_is_fresh"]


def test_explains(project):
    status, output = project("-v")
    assert status == 1
    assert "2 failed, 4 passed" in output
    assert "expected task 'DRIVE' to run with 'DRIVE_FAST', but it runs with 'DRIVE_SLOWLY'" in output
    assert "DRIVE_FAST does not fit: PEOPLE is near" in output
    assert "# Counterexample: never a signal" in output
    assert "Traceback" not in output


def test_options_of_pytest(project):
    assert "1 passed" in project("-k", "good")[1]
    assert "1 passed" in project("missions/good.yaml")[1]
    assert "1 passed" in project("properties/robot.properties.yaml::never both")[1]
    assert "1 failed" in project("-x")[1] and "stopping after 1 failures" in project("-x")[1]


def test_junit(project):
    project("--junitxml", "out.xml")
    cases = {case.get("name"): case
             for case in xml.etree.ElementTree.parse(project.folder / "out.xml").iter("testcase")}
    assert set(cases) == {"bad", "good", "never both", "never a signal", "test_of_python", "test_is_fresh"}
    assert "PEOPLE is near" in cases["bad"].find("failure").text
    assert cases["good"].find("failure") is None


def test_testpaths(project):
    (project.folder / "pytest.ini").write_text(INI + "testpaths = tests\n")
    assert "2 failed, 4 passed" in project()[1]


def test_coverage(project):
    status, output = project("-k", "good", "--cbc-coverage")
    assert status == 0, output
    assert "coverage of behavior catalogs" in output and "robot.yaml" in output
    status, output = project("-k", "good", "--cbc-coverage-fail-under", "99.5")
    assert status == 1
    assert "of the goals are met; expected at least 99.5 %" in output
    assert project("-k", "good", "--cbc-coverage-fail-under", "1")[0] == 0
    assert "coverage of behavior catalogs" not in project("-k", "good")[1]


def test_xdist(project):
    pytest.importorskip("xdist")
    status, output = project("-n", "2", "--cbc-coverage")
    assert status == 1
    assert "2 failed, 4 passed" in output, output
    assert output.count("coverage of behavior catalogs") == 1


def test_files_with_mistakes(project):
    (project.folder / "missions" / "bad.yaml").write_text(BAD.replace("DRIVE_FAST", "DRIVE_FST"))
    status, output = project("missions/bad.yaml")
    assert status == 1 and "did you mean 'DRIVE_FAST'?" in output, output
    (project.folder / "properties" / "robot.properties.yaml").write_text(PROPERTIES.replace("LIFT", "LIFTS"))
    status, output = project("properties")
    assert status == 2 and "did you mean 'LIFT'?" in output, output


def test_files_without_catalog(project):
    for name in ("missions/good.yaml", "properties/robot.properties.yaml"):
        file = project.folder / name
        file.write_text(file.read_text().replace("catalog: ../robot.yaml\n", ""))
    assert "1 passed" in project("-k", "good")[1]
    assert "1 passed" in project("-k", "both")[1]


@pytest.mark.parametrize("paths", ["missions propz", "missions/none.yaml"])
def test_paths_that_do_not_exist(project, paths):
    (project.folder / "pytest.ini").write_text(INI.replace("missions properties", paths))
    status, output = project()
    assert status == 4 and "there is no file or folder" in output


def test_folders_that_pytest_leaves_out(project):
    (project.folder / "missions").rename(project.folder / "build")
    (project.folder / "pytest.ini").write_text(INI.replace("missions properties", "build"))
    output = project("-v")[1]
    assert "good" in output and "bad" in output


def test_coverage_without_a_script(project):
    status, output = project("--cbc-coverage-fail-under", "5", "-k", "is_fresh")
    assert status == 1 and "no script was run" in output


def test_no_settings(project):
    (project.folder / "pytest.ini").write_text("[pytest]\n")
    status, output = project()
    assert status == 1 and "needs cbc_catalog in the settings" in output
    assert "good.yaml" not in output
