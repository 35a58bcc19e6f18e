"""What a notebook shows of a robot."""

from __future__ import annotations

import html
from collections.abc import Iterable

from ._native import Coordinator


def _row(cells: Iterable[object], kind: str = "td") -> str:
    return "<tr>" + "".join(f"<{kind}>{html.escape(str(cell))}</{kind}>" for cell in cells) + "</tr>"


def table_of(robot: Coordinator) -> str:
    """What runs, and all else that is not as at the beginning, as HTML."""
    requests, reasons = robot.requests, robot.why
    rows = [_row(("task", "behavior", "requested", "why"), "th")]
    rows += [
        _row((task, behavior, requests.get(task, ""), reasons(task).splitlines()[-1].strip()))
        for task, behavior in robot.running.items()
    ]
    about = {
        "situation": ", ".join(f"{name}: {value}" for name, value in robot.variables.items()),
        "cannot be activated": ", ".join(robot.unavailable),
        "faulty": ", ".join(robot.faulty),
        "failed, not tried again": ", ".join(robot.failed),
        "suspended requests": ", ".join(robot.suspended),
        "will start": ", ".join(robot.queue),
        "next event of the clock": "" if robot.next_due is None else f"{robot.next_due:.3f} s",
    }
    lines = "".join(f"<br>{name}: {html.escape(text)}" for name, text in about.items() if text)
    return f"<p>{html.escape(repr(robot)[1:-1])}{lines}</p><table>{''.join(rows)}</table>"
