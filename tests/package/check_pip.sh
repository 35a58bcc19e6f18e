#!/usr/bin/env bash
# check_pip.sh WORK: builds the Python package as pip does, from a source distribution, with the tools that the system
# has; then installs it in a new virtual environment and uses it there. WORK is a folder to write in.
set -euo pipefail

mkdir -p -- "$1"
work=$(realpath -- "$1")
source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")
rm -rf -- "${work:?}"/*

fail() {
  echo "check_pip.sh: FAILED: $*" >&2
  exit 1
}

python3 -m build --sdist --no-isolation --outdir "$work" "$source" >"$work/sdist.log" 2>&1 ||
  fail "$(tail -n 20 "$work/sdist.log")"
python3 -m pip wheel --no-build-isolation --no-index --no-deps --wheel-dir "$work" "$work"/cbc_catalog-*.tar.gz \
  >"$work/wheel.log" 2>&1 || fail "$(tail -n 20 "$work/wheel.log")"

# Nothing but the package: what it needs is in it.
python3 -m venv "$work/alone"
"$work/alone/bin/pip" install --quiet --no-index "$work"/cbc_catalog-*.whl
cd -- "$work"
[[ $(PATH=$work/alone/bin:$PATH command -v cbc) == "$work/alone/bin/cbc" ]] || fail "cbc is not in the path"
version=$(alone/bin/cbc --version)
alone/bin/cbc init robot
alone/bin/python - "$version" <<'END'
import importlib.metadata, sys
import cbc_catalog as cbc

assert sys.argv[1] == "cbc " + cbc.__version__ == "cbc " + importlib.metadata.version("cbc-catalog")
robot = cbc.Coordinator(cbc.Catalog("robot/robot.yaml"))
assert robot.start("DRIVE").accepted and robot.running["DRIVE"] == "DRIVE_FAST", robot.why("DRIVE")
assert cbc.verify("robot/robot.yaml").passed # by the program beside it
END
ls "$work/alone/lib"/python3.*/site-packages/cbc_catalog/{py.typed,__init__.pyi,_native.pyi} >/dev/null

# The plugin, and the types, for the pytest and mypy of the system.
python3 -m venv --system-site-packages "$work/beside"
"$work/beside/bin/pip" install --quiet --no-index "$work"/cbc_catalog-*.whl
printf '[pytest]\ncbc_paths = missions\ncbc_catalog = robot.yaml\n' >robot/pytest.ini
printf 'import cbc_catalog as cbc\n\ndef test_drive(robot: cbc.Coordinator) -> None:\n    assert robot.start("DRIVE").accepted\n' \
  >robot/test_robot.py
(cd robot && "$work/beside/bin/python" -m pytest -q -p no:cacheprovider --cbc-coverage)
(cd robot && "$work/beside/bin/python" -m mypy --strict test_robot.py)
echo "check_pip.sh: $(basename -- "$work"/*.whl): all is well"
