#!/bin/sh
# check.sh: tests the mutator of ./dev mutants.
#
# Exit status: 0 all is well, 1 it is not, 77 skipped: a tool is missing.
set -u

# Debian's packages for Python are for this one.
/usr/bin/python3 -c 'import clang.cindex; clang.cindex.Index.create()' 2>/dev/null || {
  echo "check.sh: skipped: there is no libclang for Python (Debian package python3-clang)" >&2
  exit 77
}
exec /usr/bin/python3 -B "$(dirname -- "$0")/points_test.py"
