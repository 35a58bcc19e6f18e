#!/usr/bin/env bash
# check_action.sh PROGRAM: runs what action.yml runs to find cbc, and to lint.
set -euo pipefail

source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
mkdir "$work/bin" "$work/catalogs"
ln -s -- "$(realpath -- "$1")" "$work/bin/cbc"
tools=$work/tools # of all programs, what the script needs
mkdir "$tools"
ln -s -- "$(command -v bash)" "$tools/bash"
export PATH="$work/bin:$PATH" RUNNER_TEMP="$work" GITHUB_OUTPUT="$work/output"
cd -- "$work"
cp -- "$source/catalogs/quadrotor.yaml" catalogs
printf 'behaviors:\n- behavior: A\n  task: B\n  color: red\n' >catalogs/typo.yaml

# What action.yml names is there.
for script in $(sed -n 's/.*GITHUB_ACTION_PATH\/\([^"]*\)".*/\1/p' "$source/action.yml"); do
  bash -n "$source/$script"
done

# lint CATALOGS ARGUMENTS SARIF: sets `annotations`, `outputs` and `status`.
lint() {
  status=0
  : >"$GITHUB_OUTPUT"
  annotations=$(CATALOGS=$1 ARGUMENTS=$2 SARIF=$3 CONFINE=. bash "$source/src/package/github/lint.sh" 2>errors) || status=$?
  outputs=$(<"$GITHUB_OUTPUT")
}

fail() {
  printf 'check_action.sh: FAILED: %s\nstatus %s\n%s\n%s\n' "$1" "$status" "$annotations" "$outputs" >&2
  exit 1
}

# look PATH: sets `outputs` and `status`.
look() {
  status=0 annotations=
  : >"$GITHUB_OUTPUT"
  PATH=$1 bash "$source/src/package/github/look.sh" || status=$?
  outputs=$(<"$GITHUB_OUTPUT")
}

# COIN-OR's program takes what it does not know for the name of a file, and ends well.
mkdir "$work/coinor" "$work/failing"
printf '#!/bin/sh\necho "Welcome to the CBC MILP Solver"; echo "No match for $1 - ? for list of commands"\n' >"$work/coinor/cbc"
printf '#!/bin/sh\nexit 1\n' >"$work/failing/cbc"
chmod +x "$work"/{coinor,failing}/cbc
look "$PATH"
[[ $status == 0 && $outputs == found=true ]] || fail "cbc is there"
look "$work/coinor:$PATH"
[[ $status == 0 && $outputs == found=false ]] || fail "another cbc is there"
look "$work/failing:$PATH"
[[ $status == 0 && $outputs == found=false ]] || fail "another cbc is there, which fails"
look "$tools"
[[ $status == 0 && $outputs == found=false ]] || fail "no cbc is there"

lint catalogs/quadrotor.yaml --strict false
[[ $status == 0 && -z $outputs ]] || fail "a sound catalog"

lint catalogs "" false
[[ $status == 0 && $annotations == *"::warning "*"file=catalogs/typo.yaml,line=4,"* ]] || fail "a warning"

printf 'catalog: /etc/passwd\nevents: [{start: A}]\n' >catalogs/stranger.yaml
lint catalogs/stranger.yaml "" false
[[ $status == 2 && $(<errors) == *"outside of"*"(--confine)"* && $annotations$(<errors) != *root:* ]] || fail "a script that names a file outside"
rm catalogs/stranger.yaml

lint . "" false # the default
[[ $status == 0 && $annotations == *"::warning "*"file=catalogs/typo.yaml,line=4,"* ]] || fail "the folder itself"

lint "catalogs/quadrotor.yaml
catalogs/typo.yaml" "--error unknown-key" true
[[ $status == 1 && $annotations == *"::error "*"file=catalogs/typo.yaml,line=4,"* ]] || fail "an error"
[[ $outputs == "sarif=$work/cbc.sarif" ]] || fail "the output of the step"
grep -q '"ruleId":"unknown-key"' "$work/cbc.sarif" || fail "SARIF: $(<"$work/cbc.sarif")"

lint nowhere.yaml "" true
[[ $status == 2 && -z $outputs && $(<errors) == *nowhere.yaml* ]] || fail "no catalog"
echo "check_action.sh: all is well"
