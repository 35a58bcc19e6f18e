#!/usr/bin/env bash
# check_debian.sh SUITE WORK: what a person does with a clone of this project, in a new root of a Debian (trixie, …) that
# has nothing but apt and what apt needs: the demo, the packages, all fast tests, the simulator; then pip. WORK is a
# folder to write in.
#
# Exit status: 0 all is well, 1 it is not, 77 skipped: there can be no new root here.
set -euo pipefail

suite=$1
work=$2
. "$(dirname -- "${BASH_SOURCE[0]}")/new_root.sh"

can_have_root
trap remove_root EXIT
make_root "$suite"
copy_sources
inside g++ --version >/dev/null 2>&1 && fail "the root has a compiler, so a need for it would not be noticed"
for command in demo package play test; do
  at_sources ./dev "$command" || fail "./dev $command"
done

say "the packages"
at_sources sh -c 'apt-get install -qq -y --no-install-recommends ./build/package/*.deb' >"$work/install.log" 2>&1 ||
  fail "apt: $(tail -n 5 "$work/install.log")"
use cbc init robot
use cbc solve robot/missions | grep '^expectations: .* 0 failed$' || fail "cbc init"
use python3 -c 'import cbc_catalog; assert cbc_catalog.verify("robot/robot.yaml").passed'

say "pip"
inside apt-get install -qq -y --no-install-recommends python3-build python3-pip python3-pybind11 \
  python3-scikit-build-core python3-venv >"$work/pip.log" 2>&1 || fail "apt: $(tail -n 5 "$work/pip.log")"
at_sources bash tests/package/check_pip.sh build/pip
echo "check_debian.sh: $suite ($(inside cat /etc/debian_version), $(inside g++ -dumpfullversion)): all is well"
