#!/usr/bin/env bash
# check_dev.sh FOLDER: the last line of ./dev says how it ended, and the demo writes a page and says what is next.
# What it calls is replaced by programs in FOLDER: nothing is installed or built.
set -euo pipefail

source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")
rm -rf -- "$1"
mkdir -p -- "$1"
bin=$(realpath -- "$1")

# replace PROGRAM: by a script on standard input
replace() {
  { echo '#!/bin/sh' && cat; } >"$bin/$1"
  chmod +x -- "$bin/$1"
}

# expect STATUS LINE: of ./dev format, and its last line
expect() {
  local status=0 output
  output=$(PATH=$bin:$PATH "$source/dev" format 2>&1) || status=$?
  output=$(sed 's/ \[[0-9]* s\]$//' <<<"$output" | tail -n 1)
  if [[ $status != "$1" || $output != "$2" ]]; then
    echo "check_dev.sh: FAILED: expected status $1 and '$2', found status $status and '$output'"
    exit 1
  fi
}

replace dpkg-query <<<'for package; do echo "install ok installed $package"; done'
replace clang-format <<<'echo "clang-format version 14.0.6"'
replace xargs <<<'cat >/dev/null; exit 0'
expect 0 'dev format: passed'
replace xargs <<<'cat >/dev/null; exit 3'
expect 3 'dev format: FAILED at: format (exit status 3)'
replace xargs <<<'cat >/dev/null; kill -TERM $PPID; sleep 0.1'
expect 143 'dev format: INTERRUPTED at: format'

# A copy of ./dev, with a program that was built before.
replace cmake <<<'exit 0'
project="$bin/a project"
mkdir -p -- "$project/"{build/release,include,src,tests}
cp -- "$source/dev" "$project"

# A failed test does not hide why others were skipped.
replace xargs <<<'cat >/dev/null'
replace ctest <<<'exit 8'
mkdir -p -- "$project/build/release/Testing/Temporary"
cat >"$project/build/release/Testing/Temporary/LastTest.log" <<'END'
tests/golden/some_test.cpp:12: Skipped
there is no tool
1/2 Test: examples
cbc-solve.1:12: skipped: there is no fish
END
status=0
output=$(PATH=$bin:$PATH "$project/dev" test 2>&1) || status=$?
for reason in "there is no tool" "there is no fish"; do
  if [[ $status != 8 || $output != *"skipped: 1, since $reason"* ]]; then
    echo "check_dev.sh: FAILED: status $status, and '$reason' is not among the reasons of skipped tests in '$output'"
    exit 1
  fi
done

replace 'a project/build/release/cbc' <<<'for page; do :; done; echo "$@" >"$page"'
output=$(PATH=$bin:$PATH "$project/dev" demo)
[[ $(<"$project/build/mission.html") == "solve catalogs/quadrotor.yaml "*" --html build/mission.html" ]]
for line in "  export PATH=\"$project/build/release:\$PATH\"" "  cbc init " "  cbc solve missions/delivery.yaml"; do
  [[ $'\n'$output$'\n' == *$'\n'"$line"* ]] || {
    echo "check_dev.sh: FAILED: the demo does not say: $line"
    exit 1
  }
done
