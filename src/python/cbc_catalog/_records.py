"""Results in JSON as values that never change."""

from __future__ import annotations

import difflib
import html
from collections.abc import Iterator, Mapping
from typing import Any, Dict, Optional, Tuple

from ._errors import UnknownName


def freeze(value: Any) -> Any:
    """A JSON value with records for objects, and tuples for lists."""
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list):
        return tuple(freeze(item) for item in value)
    return value


def thaw(value: Any) -> Any:
    """What freeze() made it of."""
    if isinstance(value, Record):
        return value.to_json()
    if isinstance(value, tuple):
        return [thaw(item) for item in value]
    return value


class Record(Mapping[str, Any]):
    """A JSON object: record.name or record["name"], and equal to a mapping with the same members. Lists
    are tuples. Where a member has the name of a method (keys, items, values, get, to_json), record["name"]
    gets it."""

    __slots__ = ("_members",)
    _members: Dict[str, Any]

    def __init__(self, members: Dict[str, Any]) -> None:
        frozen = {name: freeze(value) for name, value in members.items()}
        object.__setattr__(self, "_members", frozen)

    def __getitem__(self, name: str) -> Any:
        if name in self._members:
            return self._members[name]
        if not isinstance(name, str):
            raise TypeError(f"expected the name of a member as a str, found {type(name).__name__}")
        near = next(iter(difflib.get_close_matches(name, self._members, 1)), None)
        hint = f"; did you mean {near!r}?" if near else f", only {', '.join(self._members)}"
        raise UnknownName(f"there is no member {name!r}{hint}", name, near)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):  # Python asks for many of these
            raise AttributeError(name)
        try:
            return self[name]
        except UnknownName as error:
            raise AttributeError(str(error)) from None

    def __setattr__(self, name: str, value: Any) -> None:
        raise AttributeError("records never change")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("records never change")

    def __iter__(self) -> Iterator[str]:
        return iter(self._members)

    def __len__(self) -> int:
        return len(self._members)

    def get(self, name: str, default: Any = None) -> Any:
        return self._members.get(name, default)

    def __contains__(self, name: object) -> bool:
        return name in self._members

    def __dir__(self) -> Any:
        return [*super().__dir__(), *filter(str.isidentifier, self._members)]

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Record):
            return type(self) is type(other) and self._key() == other._key()
        if not isinstance(other, Mapping):
            return NotImplemented
        return bool(self.to_json() == thaw(freeze(dict(other))))

    def __hash__(self) -> int:
        return hash(frozenset(self._members.items()))

    def _key(self) -> Tuple[Any, ...]:
        return (self._members,)

    def __copy__(self) -> Record:
        return self

    def __deepcopy__(self, memo: Any) -> Record:
        return self

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (self.to_json(),)

    def __repr__(self) -> str:
        shown = []
        for name, value in self._members.items():
            if isinstance(value, (tuple, Record)):
                shown.append(f"{name}=[{len(value)}]" if isinstance(value, tuple) else f"{name}=...")
            else:
                text = repr(value)
                shown.append(f"{name}={text if len(text) < 40 else text[:36] + '...'}")
        more = ", ..." if len(shown) > 6 else ""
        return f"<Record {', '.join(shown[:6])}{more}>"

    def to_json(self) -> Dict[str, Any]:
        """The object as dicts and lists of its own."""
        return {name: thaw(value) for name, value in self._members.items()}


class Report(Record):
    """The result of a check: what `--format json` writes, and whether the exit status was 0. A notebook
    shows the page that `html` asked for."""

    __slots__ = ("passed", "_page")
    passed: bool
    _page: Optional[str]

    def __init__(self, members: Dict[str, Any], passed: bool, page: Optional[str] = None) -> None:
        super().__init__(members)
        object.__setattr__(self, "passed", passed)
        object.__setattr__(self, "_page", page)

    def _key(self) -> Tuple[Any, ...]:
        return self._members, self.passed

    __hash__ = Record.__hash__

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(self), (self.to_json(), self.passed, self._page)

    def _repr_html_(self) -> Optional[str]:
        if self._page is None:
            return None
        return f'<iframe width="100%" height="700" srcdoc="{html.escape(self._page)}"></iframe>'

    def __repr__(self) -> str:
        return f"<Report {self._members.get('schema')}: {'passed' if self.passed else 'not passed'}>"


for _class in (Record, Report):
    _class.__module__ = "cbc_catalog"  # where people know them from
del _class
