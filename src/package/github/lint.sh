#!/usr/bin/env bash
# Lints for GitHub: annotations on standard output; with SARIF=true also a file, whose path becomes the
# output `sarif` of the step. CATALOGS and ARGUMENTS are separated by white space.
set -euo pipefail

# Each word is an argument; none is a pattern of file names.
set -f
# shellcheck disable=SC2206
arguments=($ARGUMENTS -- $CATALOGS)

if [[ $SARIF == true ]]; then
  status=0
  cbc lint --format sarif "${arguments[@]}" >"$RUNNER_TEMP/cbc.sarif" 2>/dev/null || status=$?
  if ((status <= 1)); then # else the run below says what is wrong
    echo "sarif=$RUNNER_TEMP/cbc.sarif" >>"$GITHUB_OUTPUT"
  fi
fi
cbc lint --format github "${arguments[@]}"
