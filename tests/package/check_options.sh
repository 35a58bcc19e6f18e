#!/usr/bin/env bash
# check_options.sh WORK: configures the project with a shared library and an absolute folder for data, and
# checks what CMake makes of that.
set -euo pipefail

work=$1
source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")

fail() {
  echo "check_options.sh: FAILED: $*" >&2
  exit 1
}

rm -rf -- "$work"
cmake -S "$source" -B "$work" -D CBC_BUILD_BENCHMARKS=OFF -D CBC_BUILD_TESTS=OFF \
  -D BUILD_SHARED_LIBS=ON -D CMAKE_INSTALL_PREFIX=/opt/robot -D CMAKE_INSTALL_DATADIR=/srv/data >/dev/null

# The examples name the schemas of the folder for data.
count=0
for example in "$work"/examples/*.yaml; do
  schema=$(sed -n 's/.*\$schema=//p' "$example")
  folder=$(realpath -m -- "/opt/robot/share/doc/behavior-catalog-compiler/examples/$(dirname -- "$schema")")
  [[ $folder == /srv/data/cbc/schemas ]] || fail "$example names the schema $schema"
  [[ -f $source/schemas/$(basename -- "$schema") ]] || fail "$example names the schema $schema"
  count=$((count + 1))
done
((count > 0)) || fail "no examples"

# There is no Debian package of it.
if printed=$(cpack --config "$work/CPackConfig.cmake" -B "$work/package" 2>&1); then
  fail "cpack makes a package of a shared library"
fi
[[ $printed == *"BUILD_SHARED_LIBS=OFF"* ]] || fail "cpack says: $printed"
echo "check_options.sh: all is well"
