from os import PathLike
from typing import Any, Literal, Mapping, Optional, Sequence, Union

from ._errors import CatalogError as CatalogError
from ._errors import Error as Error
from ._errors import Finding as Finding
from ._errors import UnknownName as UnknownName
from ._errors import UsageError as UsageError
from ._records import Record as Record
from ._records import Report as Report

__version__: str

__all__ = [
    "Catalog",
    "CatalogError",
    "Change",
    "Coordinator",
    "Error",
    "Event",
    "Finding",
    "Option",
    "Record",
    "Report",
    "StoppedTask",
    "UnknownName",
    "UsageError",
    "coverage",
    "lint",
    "solve",
    "sweep",
    "tune",
    "verify",
]

_Path = Union[str, PathLike[str]]
_Input = Union[_Path, Catalog]
_Names = Union[str, Sequence[str]]
_Cause = Literal[
    "goal_achieved", "time_out", "wrong_progress", "situation_change", "process_failure", "interrupted"
]
_Value = Union[bool, str]

class Catalog:
    def __init__(self, path: _Path) -> None: ...
    @staticmethod
    def from_text(text: Union[str, bytes], *, name: str = "<text>") -> Catalog: ...
    @property
    def name(self) -> str: ...
    @property
    def path(self) -> Optional[str]: ...
    @property
    def source(self) -> bytes: ...
    @property
    def tasks(self) -> dict[str, tuple[str, ...]]: ...
    @property
    def behaviors(self) -> tuple[str, ...]: ...
    @property
    def variables(self) -> dict[str, tuple[_Value, ...]]: ...
    @property
    def findings(self) -> list[Finding]: ...
    @property
    def digest(self) -> str: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Catalog: ...
    def __deepcopy__(self, memo: Any) -> Catalog: ...
    def __getstate__(self) -> tuple[bytes, bytes, bytes]: ...
    def __setstate__(self, state: tuple[bytes, bytes, bytes]) -> None: ...
    def _repr_svg_(self) -> Optional[str]: ...

class Change:
    @property
    def op(self) -> Literal["activate", "deactivate"]: ...
    @property
    def behavior(self) -> str: ...
    @property
    def tasks(self) -> tuple[str, ...]: ...
    @property
    def cause(self) -> str: ...
    @property
    def priority(self) -> Optional[int]: ...
    @property
    def success(self) -> bool: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Change: ...
    def __deepcopy__(self, memo: Any) -> Change: ...

class StoppedTask:
    @property
    def task(self) -> str: ...
    @property
    def cause(self) -> str: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> StoppedTask: ...
    def __deepcopy__(self, memo: Any) -> StoppedTask: ...

class Event:
    @property
    def accepted(self) -> bool: ...
    @property
    def outcome(self) -> Literal["accepted", "rejected", "unchanged"]: ...
    @property
    def proven(self) -> bool: ...
    @property
    def time(self) -> float: ...
    @property
    def index(self) -> int: ...
    @property
    def origin(self) -> Literal["script", "timeout", "reactive", "fault", "situation"]: ...
    @property
    def verb(self) -> Literal["start", "stop", "finish", "situation", "fault", "repair"]: ...
    @property
    def name(self) -> Optional[str]: ...
    @property
    def priority(self) -> Optional[int]: ...
    @property
    def cause(self) -> Optional[_Cause]: ...
    @property
    def changes(self) -> tuple[Change, ...]: ...
    @property
    def stopped(self) -> tuple[StoppedTask, ...]: ...
    @property
    def before(self) -> tuple[Event, ...]: ...
    @property
    def after(self) -> tuple[Event, ...]: ...
    def why(self) -> str: ...
    def to_json(self) -> dict[str, Any]: ...
    def __copy__(self) -> Event: ...
    def __deepcopy__(self, memo: Any) -> Event: ...

class Option:
    @property
    def event(self) -> Event: ...
    @property
    def started(self) -> dict[str, str]: ...
    @property
    def changed(self) -> dict[str, str]: ...
    @property
    def stopped(self) -> tuple[str, ...]: ...
    @property
    def requested(self) -> dict[str, int]: ...
    @property
    def failed(self) -> tuple[str, ...]: ...
    @property
    def queued(self) -> dict[str, float]: ...
    def __copy__(self) -> Option: ...
    def __deepcopy__(self, memo: Any) -> Option: ...

class Coordinator:
    def __init__(
        self,
        catalog: Catalog,
        *,
        situation: Optional[Mapping[str, _Value]] = None,
        reactive_delay: float = 0.08,
        timeouts: bool = True,
        max_nodes: int = 0,
        time_limit: float = 0.0,
    ) -> None: ...
    def start(
        self,
        task: str,
        priority: int = 1,
        *,
        at: Optional[float] = None,
        parameters: Optional[Mapping[str, Any]] = None,
    ) -> Event: ...
    def stop(self, task: str, *, priority: Optional[int] = None, at: Optional[float] = None) -> Event: ...
    def finish(self, name: str, cause: _Cause = "goal_achieved", *, at: Optional[float] = None) -> Event: ...
    def fault(self, behavior: str, *, at: Optional[float] = None) -> Event: ...
    def repair(self, behavior: str, *, at: Optional[float] = None) -> Event: ...
    def situation(
        self,
        values: Optional[Mapping[str, _Value]] = None,
        /,
        *,
        at: Optional[float] = None,
        **named: _Value,
    ) -> Event: ...
    def advance(self, to: float) -> tuple[Event, ...]: ...
    @property
    def catalog(self) -> Catalog: ...
    @property
    def now(self) -> float: ...
    @property
    def next_due(self) -> Optional[float]: ...
    @property
    def running(self) -> dict[str, str]: ...
    @property
    def requests(self) -> dict[str, int]: ...
    @property
    def queue(self) -> dict[str, Optional[float]]: ...
    @property
    def active(self) -> tuple[str, ...]: ...
    @property
    def faulty(self) -> tuple[str, ...]: ...
    @property
    def unavailable(self) -> tuple[str, ...]: ...
    @property
    def variables(self) -> dict[str, _Value]: ...
    def why(self, name: str) -> str: ...
    def options(self, *, priorities: Sequence[int] = (1,)) -> list[Option]: ...
    def save(self) -> bytes: ...
    def restore(self, state: Union[bytes, str]) -> None: ...
    def __copy__(self) -> Coordinator: ...
    def __deepcopy__(self, memo: Any) -> Coordinator: ...
    def __getstate__(self) -> tuple[Catalog, int, int, bytes]: ...
    def __setstate__(self, state: tuple[Catalog, int, int, bytes]) -> None: ...
    def _repr_html_(self) -> str: ...

def lint(
    *files: _Input,
    script: Optional[Union[_Path, Sequence[_Path]]] = None,
    summary: bool = False,
    max_nodes: Optional[int] = None,
    confine: Optional[_Path] = None,
    error: Optional[_Names] = None,
    warn: Optional[_Names] = None,
    note: Optional[_Names] = None,
    allow: Optional[_Names] = None,
    strict: bool = False,
) -> Report: ...
def solve(
    *files: _Input,
    html: Optional[_Path] = None,
    jobs: Optional[int] = None,
    stats: bool = False,
    confine: Optional[_Path] = None,
    why: Optional[_Names] = None,
    alternatives: Optional[int] = None,
    what_if: bool = False,
    after: Optional[int] = None,
    max_solutions: Optional[int] = None,
    max_nodes: Optional[int] = None,
    max_clock_events: Optional[int] = None,
    time_limit: Optional[float] = None,
) -> Report: ...
def verify(
    *files: _Input,
    scripts: Optional[_Path] = None,
    html: Optional[_Path] = None,
    jobs: Optional[int] = None,
    confine: Optional[_Path] = None,
    refused: Optional[_Names] = None,
    outcomes: bool = False,
    same_as: Optional[_Input] = None,
    renamed: Optional[Union[_Names, Mapping[str, str]]] = None,
    allow_missing: bool = False,
    max_states: Optional[int] = None,
    max_memory: Optional[str] = None,
    time_limit: Optional[float] = None,
    cut_sets: Optional[_Names] = None,
    order: Optional[int] = None,
    in_some_situation: bool = False,
    situation: Optional[Mapping[str, _Value]] = None,
    effects: bool = False,
    situations: bool = False,
    fail_on: Optional[_Names] = None,
    overrides: bool = False,
) -> Report: ...
def coverage(
    *files: _Input,
    fail_under: Optional[float] = None,
    jobs: Optional[int] = None,
    confine: Optional[_Path] = None,
    prove: bool = False,
    mutants: bool = False,
    scripts: Optional[_Path] = None,
    assume: Optional[_Path] = None,
    max_states: Optional[int] = None,
    max_memory: Optional[str] = None,
    time_limit: Optional[float] = None,
    max_solutions: Optional[int] = None,
    max_nodes: Optional[int] = None,
    max_clock_events: Optional[int] = None,
) -> Report: ...
def sweep(
    *files: _Input,
    jobs: Optional[int] = None,
    stats: bool = False,
    slowest: Optional[_Path] = None,
    slowest_by_time: Optional[_Path] = None,
    confine: Optional[_Path] = None,
    against: Optional[_Input] = None,
    renamed: Optional[Union[_Names, Mapping[str, str]]] = None,
    allow_missing: bool = False,
    scripts: Optional[_Path] = None,
    sequences: Optional[Union[int, str]] = None,
    seed: Optional[int] = None,
    events: Optional[int] = None,
    priorities: Optional[int] = None,
    failures: Optional[float] = None,
    faults: Optional[float] = None,
    max_solutions: Optional[int] = None,
    max_nodes: Optional[int] = None,
    max_clock_events: Optional[int] = None,
) -> Report: ...
def tune(
    *files: _Input,
    html: Optional[_Path] = None,
    only: Optional[_Names] = None,
    fail_under: Optional[float] = None,
    jobs: Optional[int] = None,
    confine: Optional[_Path] = None,
    all_states: bool = False,
    max_states: Optional[int] = None,
    max_memory: Optional[str] = None,
    time_limit: Optional[float] = None,
    margin: Optional[float] = None,
) -> Report: ...
