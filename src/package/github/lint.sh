#!/usr/bin/env bash
# Lints for GitHub. Annotations go to standard output. With SARIF=true, it also writes a file, whose path
# becomes the output `sarif` of the step. CATALOGS and ARGUMENTS are lists separated by white space.
# No file outside of the folder CONFINE is read.
set -euo pipefail

# Each word is an argument; none is a file name pattern.
set -f
# shellcheck disable=SC2206
arguments=(--confine "$CONFINE" $ARGUMENTS -- $CATALOGS)

if [[ $SARIF == true ]]; then
  status=0
  cbc lint --format sarif "${arguments[@]}" >"$RUNNER_TEMP/cbc.sarif" 2>/dev/null || status=$?
  if ((status <= 1)); then # otherwise the run below reports the error
    echo "sarif=$RUNNER_TEMP/cbc.sarif" >>"$GITHUB_OUTPUT"
  fi
fi
cbc lint --format github "${arguments[@]}"
