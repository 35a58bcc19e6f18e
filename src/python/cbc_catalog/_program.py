"""Runs the program cbc for what takes long.

A process of its own ends at once on Ctrl-C, keeps no lock of Python, and cannot take its caller along
if it crashes or lacks memory. And what comes of it is what the command line gives.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
import signal
import subprocess
import tempfile
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Tuple, Union

from . import _build
from ._errors import CatalogError, Error, Finding, UsageError
from ._native import Catalog
from ._records import Report

_FINDING = re.compile(r"(.*?):(\d+):(\d+): (error|warning|note): (.*) \[([a-z-]+)\]")
_INPUT: Tuple[Any, ...] = (str, os.PathLike, Catalog)


def program() -> str:
    """The program of this version; the environment variable CBC_PROGRAM names another one."""
    return os.environ.get("CBC_PROGRAM") or _build.PROGRAM


class _Files:
    """The names of inputs on a command line. Catalogs without a file get one, which `folder` keeps."""

    def __init__(self, folder: contextlib.ExitStack) -> None:
        self._folder = folder
        self._renamed: List[Tuple[str, str]] = []

    def name_of(self, file: Any) -> str:
        if not isinstance(file, _INPUT):
            raise TypeError(f"expected a Catalog or a path, found {type(file).__name__}")
        name = self._name_of_catalog(file) if isinstance(file, Catalog) else os.fspath(file)
        if not isinstance(name, str):
            raise TypeError("expected a path as a str, found bytes")
        if "\0" in name:
            raise UsageError("expected a path, found a NUL character in it")
        return f"./{name}" if name.startswith("-") else name

    def _name_of_catalog(self, catalog: Catalog) -> str:
        if catalog.path is None:
            folder = self._folder.enter_context(tempfile.TemporaryDirectory(prefix="cbc-"))
            file = Path(folder, "catalog.yaml")
            file.write_bytes(catalog.source)
            self._renamed.append((str(file), catalog.name))
            return str(file)
        try:
            is_same = Path(catalog.path).read_bytes() == catalog.source
        except OSError as error:
            raise CatalogError(f"cannot read {catalog.path} any more: {error.strerror}") from error
        if not is_same:
            raise CatalogError(f"{catalog.path} has changed since it was loaded; load it again")
        return catalog.name if os.path.abspath(catalog.name) == catalog.path else catalog.path

    def restore_names(self, text: str, written: Callable[[str], str] = lambda name: json.dumps(name)[1:-1]) -> str:
        """`written`: a name as the text has it, by default in JSON."""
        for file, name in self._renamed:
            text = text.replace(file, written(name))
        return text


def _values_of(option: str, value: Any, files: _Files) -> Iterator[Optional[str]]:
    """The values of an option; None for one that has none."""
    if value is None or value is False:
        return
    if value is True:
        yield None
    elif isinstance(value, dict):
        for name, item in value.items():
            word = str(item).lower() if isinstance(item, bool) else str(item)
            yield f"{name}={word}"
    elif isinstance(value, (list, tuple)):
        for item in value:
            yield from _values_of(option, item, files)
    elif isinstance(value, _INPUT):
        yield value if isinstance(value, str) else files.name_of(value)
    elif isinstance(value, (int, float)):
        yield repr(value)
    else:
        raise TypeError(f"{option}: expected a value of an option, found {type(value).__name__}")


def _command_line(command: str, inputs: Sequence[Any], options: Dict[str, Any],
                  files: _Files) -> List[str]:
    line = [program(), command, "--format=json"]
    for option, value in options.items():
        name = "--" + option.replace("_", "-")
        for text in _values_of(option, value, files):
            if text is not None and "\0" in text:
                raise UsageError(f"{option}: expected a text, found a NUL character in it")
            line.append(name if text is None else f"{name}={text}")
    return line + [files.name_of(file) for file in inputs]


@contextlib.contextmanager
def _interrupts_held() -> Iterator[List[Tuple[Any, Any]]]:
    """Collects what Ctrl-C would call, with its arguments. Raised between the start of a process and the
    moment when that is known here, it would leave the process alone."""
    is_main = threading.current_thread() is threading.main_thread()
    handler = signal.getsignal(signal.SIGINT) if is_main else None
    held: List[Tuple[Any, Any]] = []
    if not callable(handler):
        yield held
        return
    signal.signal(signal.SIGINT, lambda *arguments: held.append((handler, arguments)))
    try:
        yield held
    finally:
        signal.signal(signal.SIGINT, handler)


def execute(line: Sequence[str]) -> Tuple[int, str, str]:
    """Exit status, output and messages."""
    process: Optional["subprocess.Popen[bytes]"] = None
    with tempfile.TemporaryFile() as messages:
        try:
            with _interrupts_held() as held:
                process = subprocess.Popen(line, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                           stderr=messages)
            for handler, arguments in held:
                handler(*arguments)
            assert process.stdout is not None
            with process.stdout:
                # Unlike communicate(), this does not wait for the process after Ctrl-C.
                output = process.stdout.read()
        except OSError as error:
            raise Error(f"cannot run the program {line[0]}: {error.strerror}") from error
        except BaseException:
            if process is not None:
                process.kill()
            raise
        finally:
            if process is not None:
                process.wait()
        messages.seek(0)
        said = messages.read()
    return process.returncode, output.decode("utf-8", "replace"), said.decode("utf-8", "replace")


def findings_in(text: str) -> List[Finding]:
    found = map(_FINDING.fullmatch, text.splitlines())
    return [
        Finding(part[1], int(part[2]), int(part[3]), part[4], part[6], part[5])
        for part in found if part
    ]


def run(command: str, inputs: Sequence[Union[str, "os.PathLike[str]", Catalog]],
        options: Dict[str, Any]) -> Report:
    """Runs a command of the program, and returns what it writes as JSON."""
    with contextlib.ExitStack() as folder:
        files = _Files(folder)
        status, output, messages = execute(_command_line(command, inputs, options, files))
        output, messages = files.restore_names(output), files.restore_names(messages, str)
    if status in (0, 1) and output:
        file = options.get("html")
        page = None if file is None or not Path(file).is_file() else Path(file).read_text(encoding="utf-8")
        return Report(json.loads(output), status == 0, page)
    if status == 2:
        raise error_of(messages)
    raise Error(f"the program cbc ended with status {status}: {messages.strip()}")


def error_of(messages: str) -> Error:
    """Why a call of the program was refused: by errors in files, or else by how it was called. Then
    warnings about files, which stand before that, are no reason."""
    findings = findings_in(messages)
    if any(finding.severity == "error" for finding in findings):
        return CatalogError(messages.strip(), findings)
    complaints = [line[len("cbc: "):] for line in messages.splitlines() if line.startswith("cbc: ")]
    return UsageError("\n".join(complaints) or messages.strip())


def picture(catalog: Catalog) -> Optional[str]:
    """The catalog as SVG; None without Graphviz."""
    with contextlib.ExitStack() as folder:
        name = _Files(folder).name_of(catalog)
        status, output, _ = execute([program(), "graph", "--format=svg", name])
    return output if status == 0 else None
