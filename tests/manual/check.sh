#!/bin/sh
# check.sh NAME PROGRAM: runs NAME.py, a check of the pages in man/ against PROGRAM.
#
# Exit status: 0 all is well, 1 it is not, 77 skipped: a tool is missing.
set -u

command -v python3 >/dev/null || {
  echo "check.sh: skipped: there is no python3" >&2
  exit 77
}
exec python3 -B "$(dirname -- "$0")/$1.py" "$2"
