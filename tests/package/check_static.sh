#!/usr/bin/env bash
# check_static.sh PROGRAM: checks the static program; as root, where there is no other file.
set -euo pipefail

program=$1
catalogs=$(dirname -- "${BASH_SOURCE[0]}")/../../catalogs
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

# ldd reports it on either output, with an exit status of its own.
[[ $(ldd "$program" 2>&1 || true) == *"not a dynamic executable"* ]]
[[ $(file -b "$program") == *" stripped"* ]]

cp -- "$program" "$work/program"
cp -- "$catalogs"/*.yaml "$work"
cd -- "$work"
run=(./program)
if ((EUID == 0)); then
  run=(chroot . /program)
fi
"${run[@]}" --version
"${run[@]}" lint --strict .
"${run[@]}" init robot
"${run[@]}" solve robot/missions | grep '^expectations: .* 0 failed$'
"${run[@]}" compile quadrotor.yaml
"${run[@]}" solve quadrotor.cbc quadrotor.mission.yaml | grep '^expectations: .* 0 failed$'
[[ $("${run[@]}" graph quadrotor.cbc) == "digraph "* ]]
echo "check_static.sh: all is well"
