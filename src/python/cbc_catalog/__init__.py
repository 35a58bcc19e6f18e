"""Behavior catalogs of robots: the coordinator, and the checks of the program cbc.

    import cbc_catalog as cbc

    robot = cbc.Coordinator(cbc.Catalog("robot.yaml"))
    event = robot.start("DELIVER", priority=2, at=1.0)
    assert event.accepted, event.why()
    assert robot.running["DRIVE"] == "DRIVE_SLOWLY", robot.why("DRIVE")

All times are seconds. All that is returned is a copy, which nothing changes later. See docs/python.md.
"""

from ._build import VERSION as __version__
from ._checks import coverage, lint, solve, sweep, tune, verify
from ._errors import CatalogError, Error, Finding, UnknownName, UsageError
from ._native import Catalog, Change, Coordinator, Event, Option, StoppedTask
from ._notebook import table_of as _table_of
from ._program import picture as _picture
from ._records import Record, Report

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

Catalog._repr_svg_ = lambda self: _picture(self)
Coordinator._repr_html_ = lambda self: _table_of(self)
