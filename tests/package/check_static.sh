#!/usr/bin/env bash
# check_static.sh PROGRAM: checks the static program; as root, where there is no other file.
set -euo pipefail

program=$1
here=$(dirname -- "${BASH_SOURCE[0]}")
catalogs=$here/../../catalogs
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

[[ $(file -b "$program") == *"static-pie linked"*" stripped"* ]]
bash "$here/check_hardening.sh" "$program"

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
