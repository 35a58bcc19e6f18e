#!/bin/sh
# check.sh PYTHON types|other: runs the tests of the Python package.
python=$1
part=$2
if ! "$python" -c 'import pytest' 2>/dev/null; then
  echo "python: skipped: there is no pytest"
  exit 77
fi
cd "$(dirname -- "$0")" || exit 2
case $part in
  types) set -- test_types.py ;;
  other) set -- --ignore test_types.py . ;;
esac
exec "$python" -B -m pytest -q -p no:cacheprovider "$@"
