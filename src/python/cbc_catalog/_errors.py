"""What cbc_catalog raises, apart from TypeError and OSError."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, List, Optional, Tuple


@dataclass(frozen=True)
class Finding:
    """What is wrong at a place of a file. Lines and columns count from 1."""

    file: str
    line: int
    column: int
    severity: str
    rule: str
    message: str

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}"
        return f"{place}: {self.severity}: {self.message} [{self.rule}]"


class Error(Exception):
    """The base of all errors of cbc_catalog."""


class UsageError(Error):
    """A value that makes no sense, such as a time that goes back."""


class UnknownName(Error):
    """A name that the catalog lacks, and the nearest one that it has, or None."""

    name: str
    nearest: Optional[str]

    def __init__(self, message: str, name: str, nearest: Optional[str] = None) -> None:
        super().__init__(message)
        self.name = name
        self.nearest = nearest

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (str(self), self.name, self.nearest)


class CatalogError(Error):
    """A catalog, script or property file that cannot be used, and the findings that say why."""

    findings: List[Finding]

    def __init__(self, message: str, findings: Sequence[Finding] = ()) -> None:
        self._message = message
        self.findings = list(findings)
        errors = [finding for finding in self.findings if finding.severity == "error"]
        super().__init__("\n".join(map(str, errors or self.findings)) or message)

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (self._message, self.findings)


for _class in (Finding, Error, UsageError, UnknownName, CatalogError):
    _class.__module__ = "cbc_catalog"  # where people know them from
del _class
