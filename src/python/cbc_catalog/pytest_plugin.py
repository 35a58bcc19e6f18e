"""Runs event scripts and property files as tests of pytest.

In the settings of the project (pytest.ini, pyproject.toml, ...):

    [pytest]
    cbc_paths = missions properties   # folders and files
    cbc_catalog = robot.yaml          # for the fixture `robot`, and files that name no catalog

A script is one test, and each property of a property file is one.
"""

from __future__ import annotations

import fnmatch
import os
import xml.etree.ElementTree
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple, Union

import pytest

from . import _native, _program
from ._errors import Error
from ._native import Catalog, Coordinator

_catalog_key = pytest.StashKey[Catalog]()
_coverage_key = pytest.StashKey["_Coverage"]()
_SUFFIXES = (".yaml", ".yml", ".json")


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addini("cbc_paths", "Folders and files with event scripts and property files.",
                  type="paths", default=[])
    parser.addini("cbc_catalog", "The catalog of the fixture `robot`, and of files that name none.")
    group = parser.getgroup("cbc", "behavior catalogs")
    group.addoption("--cbc-coverage", action="store_true",
                    help="Report what the scripts test of their catalogs.")
    group.addoption("--cbc-coverage-fail-under", type=float, metavar="PERCENT",
                    help="Fail if they meet fewer of its goals than this; implies --cbc-coverage.")


def pytest_configure(config: pytest.Config) -> None:
    config.stash[_coverage_key] = _Coverage(config)
    missing = [str(path) for path in _paths(config) if not path.exists()]
    if missing:
        raise pytest.UsageError(f"cbc_paths: there is no file or folder {', '.join(missing)}")
    if config.args_source == pytest.Config.ArgsSource.ARGS:
        return
    # Without arguments all tests are run, so these, too, also in folders that pytest leaves out.
    given = [Path(arg).absolute() for arg in config.args]
    left_out = config.getini("norecursedirs")
    for path in _paths(config):
        above = [folder for folder in given if folder == path or folder in path.parents]
        is_seen = any(
            not any(fnmatch.fnmatch(part, pattern) for part in path.relative_to(folder).parts for pattern in left_out)
            for folder in above)
        if not is_seen:
            config.args.append(str(path))


def _paths(config: pytest.Config) -> List[Path]:
    paths: List[Path] = config.getini("cbc_paths")
    return paths


def _catalog_path(config: pytest.Config) -> Optional[Path]:
    name = config.getini("cbc_catalog")
    if not name:
        return None
    return Path(config.inipath.parent if config.inipath else config.rootpath, name)


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> Optional[pytest.Collector]:
    paths = _paths(parent.config)
    is_meant = any(path == file_path or path in file_path.parents for path in paths)
    if not is_meant or file_path.suffix not in _SUFFIXES:
        return None
    kind, _ = _look_at(file_path)
    if kind == "script":
        made: pytest.Collector = ScriptFile.from_parent(parent, path=file_path)
        return made
    if kind == "properties":
        made = PropertiesFile.from_parent(parent, path=file_path)
        return made
    return None


class Failed(Exception):
    """The explanation of a script that failed, or of a property that is violated."""


class _Item(pytest.Item):
    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        if isinstance(excinfo.value, (Failed, Error)):
            return str(excinfo.value)
        return super().repr_failure(excinfo)


class _File(pytest.File):
    def repr_failure(self, excinfo: Any, style: Any = None) -> Any:
        if isinstance(excinfo.value, Error):
            return str(excinfo.value)
        return super().repr_failure(excinfo)

    def inputs(self) -> List[str]:
        """The catalog, unless the file names it, and the file."""
        catalog = _catalog_path(self.config)
        _, has_catalog = _look_at(self.path)
        return [str(self.path)] if has_catalog or catalog is None else [str(catalog), str(self.path)]


def _look_at(path: Path) -> Tuple[str, bool]:
    """What kind of file it is, and whether it names its catalog."""
    return _native.kind_of(os.fsencode(path), path.read_bytes())


class ScriptFile(_File):
    """A file with an event script."""

    def collect(self) -> Iterator[pytest.Item]:
        yield Script.from_parent(self, name=self.path.stem)


class Script(_Item):
    """All expectations of a script."""

    parent: ScriptFile

    def runtest(self) -> None:
        failures = _run_junit("solve", self.parent.inputs())
        explanations = [text for _, text in failures if text]
        if explanations:
            raise Failed("\n".join(explanations))

    def reportinfo(self) -> Tuple[Union["os.PathLike[str]", str], Optional[int], str]:
        return self.path, 0, self.name


class PropertiesFile(_File):
    """A property file, which is verified as a whole when the first of its properties is tested."""

    _answers: Optional[List[Tuple[str, str]]] = None

    def collect(self) -> Iterator[pytest.Item]:
        catalog = _catalog_path(self.config)
        listed = _native.list_properties(os.fsencode(self.path), os.fsencode(catalog or ""))
        names: Dict[str, int] = {}
        for place, (line, title) in enumerate(listed):
            names[title] = names.get(title, 0) + 1
            name = title if names[title] == 1 else f"{title} ({names[title]})"
            yield Property.from_parent(self, name=name, place=place, line=line)

    def answer(self, place: int) -> str:
        """Why a property is not proved; empty: it is."""
        if self._answers is None:
            self._answers = _run_junit("verify", self.inputs())
        return self._answers[place][1]


class Property(_Item):
    """One property of a file."""

    parent: PropertiesFile

    def __init__(self, *, place: int, line: int, **others: Any) -> None:
        super().__init__(**others)
        self._place = place
        self._line = line

    def runtest(self) -> None:
        explanation = self.parent.answer(self._place)
        if explanation:
            raise Failed(explanation)

    def reportinfo(self) -> Tuple[Union["os.PathLike[str]", str], Optional[int], str]:
        return self.path, self._line - 1, self.name


def _run_junit(command: str, inputs: List[str]) -> List[Tuple[str, str]]:
    """Names and explanations of the test cases of a command; no explanation: it passed."""
    line = [_program.program(), command, "--format=junit", *inputs]
    status, output, messages = _program.execute(line)
    if status not in (0, 1):
        raise _program.error_of(messages)
    cases = xml.etree.ElementTree.fromstring(output).iter("testcase")
    return [(case.get("name", ""), _explanation_in(case)) for case in cases]


def _explanation_in(case: xml.etree.ElementTree.Element) -> str:
    for kind in ("failure", "error"):
        found = case.find(kind)
        if found is not None:
            parts = [found.get("message", ""), (found.text or "").rstrip()]
            # The text of an expectation has the message with its place.
            return parts[1] if parts[0] in parts[1] else "\n".join(filter(None, parts))
    return ""


@pytest.hookimpl(hookwrapper=True)  # type: ignore[misc]
def pytest_runtest_makereport(item: pytest.Item) -> Iterator[None]:
    outcome = yield
    if isinstance(item, Script):
        # Of the report, since only reports come from the processes of xdist.
        outcome.get_result().cbc_inputs = item.parent.inputs()  # type: ignore[attr-defined]


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    _scripts_run.update({tuple(inputs): None for inputs in [getattr(report, "cbc_inputs", ())] if inputs})


_scripts_run: Dict[Tuple[str, ...], None] = {}


class _Coverage:
    """The coverage of all scripts that were run."""

    def __init__(self, config: pytest.Config) -> None:
        self._least: Optional[float] = config.getoption("--cbc-coverage-fail-under")
        is_wanted = config.getoption("--cbc-coverage") or self._least is not None
        self._is_wanted = is_wanted and not hasattr(config, "workerinput")
        self._text = ""
        _scripts_run.clear()

    def measure(self) -> bool:
        """Returns whether it is as high as it has to be."""
        if not self._is_wanted:
            return True
        if not _scripts_run:
            self._text = "cbc: no script was run, so there is no coverage\n"
            return not self._least
        inputs = list(dict.fromkeys(name for inputs in _scripts_run for name in inputs))
        run = [_program.program(), "coverage"]
        status, self._text, messages = _program.execute([*run, "--format=text", *inputs])
        if status not in (0, 1):
            self._text = messages
            return False
        if self._least is None:
            return True
        percent = _program.run("coverage", inputs, {})["percent"]
        if percent >= self._least:
            return True
        self._text += f"cbc: {percent} % of the goals are met; expected at least {self._least} %\n"
        return False

    def report(self, terminal: Any) -> None:
        if self._text:
            terminal.section("coverage of behavior catalogs")
            terminal.write(self._text)


def pytest_sessionfinish(session: pytest.Session) -> None:
    if not session.config.stash[_coverage_key].measure() and session.exitstatus == 0:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    config.stash[_coverage_key].report(terminalreporter)


@pytest.fixture
def robot(request: pytest.FixtureRequest) -> Coordinator:
    """A coordinator in its first state, of the catalog that cbc_catalog in the settings names."""
    config = request.config
    if _catalog_key not in config.stash:
        path = _catalog_path(config)
        if path is None:
            raise pytest.UsageError("the fixture `robot` needs cbc_catalog in the settings of pytest")
        config.stash[_catalog_key] = Catalog(path)
    return Coordinator(config.stash[_catalog_key])
