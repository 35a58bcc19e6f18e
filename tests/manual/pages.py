"""The pages of the manual, as the checks read them."""

import re
import shutil
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parents[2] / "man"
WRITTEN_BY_TEST = r'.\" From here on written by a test'


def all_pages():
    pages = sorted(FOLDER.glob("*.[157]"))
    if not pages:
        sys.exit(f"there are no pages in {FOLDER}")
    return pages


def plain(line):
    """A line of a literal block as it is printed."""
    line = line.removeprefix("\\&")
    special = {"-": "-", "e": "\\", "(aq": "'", "(ga": "`", "(ha": "^", "(ti": "~", "(>=": "≥"}
    return re.sub(r"\\(-|e|\(..)", lambda found: special[found[1]], line)


def skip(reason):
    print(f"{Path(sys.argv[0]).name}: skipped: {reason}", file=sys.stderr)
    sys.exit(77)


def require(*tools):
    for tool in tools:
        if shutil.which(tool) is None:
            skip(f"there is no {tool}")


def finish(faults):
    for fault in faults:
        print(fault)
    sys.exit(1 if faults else 0)
