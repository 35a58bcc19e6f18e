#!/usr/bin/env bash
# check_python_package.sh PACKAGE PROGRAM_PACKAGE WORK: installs the Debian package for Python in a new root beside that
# of the program, uses it there as somebody without any rights, and removes it again. WORK is a folder to write in.
#
# Exit status: 0 all is well, 1 it is not, 77 skipped: there can be no new root here.
set -euo pipefail

package=$(realpath -- "$1")
program_package=$(realpath -- "$2")
work=$3
. "$(dirname -- "${BASH_SOURCE[0]}")/new_root.sh"
name=$(dpkg-deb -f "$package" Package)

list_files() {
  (cd "$root" && find . -xdev \( -path ./proc -o -path ./sys -o -path ./dev -o -path ./tmp -o -path ./var \) \
    -prune -o -print) | sort
}

version=$(dpkg-deb -f "$program_package" Version)
[[ $(dpkg-deb -f "$package" Depends) == *"$(dpkg-deb -f "$program_package" Package) (= $version)"* ]] ||
  fail "it does not depend on the program of just this version: $(dpkg-deb -f "$package" Depends)"

can_have_root

say "lintian"
# It is not uploaded to Debian.
lintian --allow-root --fail-on error,warning --suppress-tags initial-upload-closes-no-bugs "$package"

trap remove_root EXIT
make_root "$(own_suite)" --include=python3-pytest
cp -- "$program_package" "$root/tmp/program.deb"
cp -- "$package" "$root/tmp/python.deb"

say "install and use"
inside apt-get install -qq -y --no-install-recommends /tmp/program.deb >"$work/program.log" 2>&1 ||
  fail "apt: $(tail -n 5 "$work/program.log")"
list_files >"$work/before"
inside apt-get install -qq -y --no-install-recommends /tmp/python.deb >"$work/install.log" 2>&1 ||
  fail "apt: $(tail -n 5 "$work/install.log")"
use cbc init robot
printf '[pytest]\ncbc_paths = missions\ncbc_catalog = robot.yaml\n' >"$root/tmp/use/robot/pytest.ini"
cat >"$root/tmp/use/robot/test_robot.py" <<'END'
import cbc_catalog as cbc

def test_drive(robot):
    assert robot.start("DRIVE").accepted
    assert robot.running["DRIVE"] == "DRIVE_FAST", robot.why("DRIVE")

def test_checks():
    assert cbc.verify("robot.yaml").passed
END
use env -C /tmp/use/robot python3 -m pytest -p no:cacheprovider --cbc-coverage >"$work/pytest.log" 2>&1 ||
  fail "pytest: $(tail -n 20 "$work/pytest.log")"
grep -q ' 3 passed' "$work/pytest.log" || fail "pytest: $(tail -n 20 "$work/pytest.log")"
use python3 -c 'import cbc_catalog, importlib.metadata as m; assert m.version("cbc-catalog") == cbc_catalog.__version__'
if inside apt-get remove -qq -y --simulate behavior-catalog-compiler | grep -q "^Remv $name"; then :; else
  fail "the program can be removed, and $name stays"
fi

say "remove"
inside python3 -c 'import cbc_catalog' # as root, who may write beside it
inside apt-get purge -qq -y "$name" >"$work/remove.log" 2>&1 || fail "apt: $(tail -n 5 "$work/remove.log")"
list_files | diff "$work/before" - || fail "the package leaves these files"
echo "check_python_package.sh: $(basename -- "$package"): all is well"
