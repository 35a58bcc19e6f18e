#!/usr/bin/env bash
# check_name.sh WORK: configures the project for a program of another name, and checks that no page of
# the manual to be installed refers to the usual one.
set -euo pipefail

work=$1
source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")
rm -rf -- "$work"
cmake -S "$source" -B "$work" -D CBC_BUILD_BENCHMARKS=OFF -D CBC_BUILD_TESTS=OFF -D CBC_PROGRAM_NAME=other-name >/dev/null

for page in "$source"/man/*.[1-9]; do
  name=other-name$(basename -- "$page" | sed 's/^cbc//')
  [[ $(grep -cF 'other-name' "$work/share/man/man${page##*.}/$name") -gt 1 ]]
  # Nothing but names is different.
  diff <(sed -E 's/other-name/cbc/; s/OTHER-NAME/CBC/' "$work/share/man/man${page##*.}/$name") "$page"
done
if grep -nE '^(\.(Nm|Xr|Dt) |\$ )(cbc|CBC)($|[- ])' "$work"/share/man/man?/*; then
  echo "check_name.sh: FAILED: these lines have the usual name"
  exit 1
fi
