#!/usr/bin/env bash
# try.sh FOLDER: applies each patch of this folder to a copy of the sources, builds the program and the
# tests that look at what the patch adds, and runs them. FOLDER keeps the copy and what was built.
#
# Help texts and lists of rules follow from the tables that a patch extends. Their expectations are
# not part of the patches, but written anew here; the case that a patch brings must pass as it is.
set -euo pipefail

origin=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")
mkdir -p -- "$1"
folder=$(realpath -- "$1")
source=$folder/source
build=$folder/build
cbc=$build/cbc
tests=$build/tests/cbc_growing_tests

fail() {
  echo "try.sh: FAILED: $1" >&2
  exit 1
}

# expect TEXT COMMAND…: in what the command prints, whatever its exit status
expect() {
  local text=$1 output
  shift
  output=$("$@" 2>&1) || true
  grep -F -m 1 -- "$text" <<<"$output" || fail "expected '$text' from: $*"$'\n'"$output"
}

# Copies the sources with their times, so that only what a patch changes is built again; what the
# patches change counts as new, since FOLDER may have it as an earlier run left it.
copy_sources() {
  rm -rf -- "$source"
  mkdir -- "$source"
  tar -C "$origin" --exclude=./.git --exclude=./build -c . | tar -C "$source" -x
  local file
  while read -r file; do
    if [[ -e $source/$file ]]; then touch -- "$source/$file"; fi
  done < <(sed -nE 's|^\+\+\+ [^/]*/([^[:space:]]*).*|\1|p' "$origin"/tests/growing/*.patch | sort -u)
}

# try_patch NAME CASE: builds and tests the copy with the patch. CASE is the golden case that it brings.
try_patch() {
  local patch=$origin/tests/growing/$1.patch check
  printf '\n-- %s.patch [%d s]\n' "$1" "$SECONDS"
  patch --quiet --batch --forward --strip=1 --directory="$source" --input="$patch"
  cmake --build "$build" --target cbc cbc_growing_tests --parallel "$(nproc)" >"$folder/$1.log" ||
    fail "building with $1.patch"$'\n'"$(tail -n 30 "$folder/$1.log")"

  "$tests" --gtest_brief=1 --gtest_filter="*Golden.Matches/$2"
  CBC_UPDATE_GOLDEN=1 "$tests" --gtest_brief=1 --gtest_filter='*Golden.*' >/dev/null
  { diff -rq "$origin/tests/golden/cases" "$source/tests/golden/cases" || true; } |
    sed -nE 's|^Files .*/cases/([^/]*)/.*|follows: \1|p'
  "$tests" --gtest_brief=1
  for check in form options; do
    sh "$source/tests/manual/check.sh" "$check" "$cbc" || (($? == 77)) || fail "manual: $check"
  done
}

# Keeps the times of what the patch did not change.
take_back() {
  patch --quiet --batch --reverse --strip=1 --directory="$source" \
    --input="$origin/tests/growing/$1.patch"
  rm -rf -- "$source/tests/golden/cases"
  cp -a -- "$origin/tests/golden/cases" "$source/tests/golden"
}

# Not optimized, which takes a fraction of the time.
launcher=()
if type ccache >/dev/null 2>&1; then launcher=(-D CMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
copy_sources
cmake -S "$source" -B "$build" -G Ninja "${launcher[@]}" -D CMAKE_BUILD_TYPE=Release \
  -D CMAKE_CXX_FLAGS_RELEASE=-O0 -D CBC_WERROR=ON -D CBC_BUILD_BENCHMARKS=OFF \
  -D CBC_DISCOVER_TESTS=OFF -D CBC_TEST_CONSUMER=OFF >"$folder/cmake.log"
cd -- "$source/tests/golden/cases"

try_patch rule lint_rule_long_name
cd -- "$source/tests/golden/cases"
expect 'long-name                 note' "$cbc" lint --list-rules
expect '[long-name]' "$cbc" lint lint_rule_long_name/catalog.yaml
expect 'no findings in 1 catalog' "$cbc" lint --allow long-name lint_rule_long_name/catalog.yaml
cd -- "$folder"
take_back rule

try_patch format lint_format_csv
cd -- "$source/tests/golden/cases"
expect '"lint_format_gcc/catalog.yaml",10,' "$cbc" lint --format csv lint_format_gcc/catalog.yaml
expect 'csv' "$cbc" __complete bash '' 3 lint --format ''
cd -- "$folder"
take_back format

try_patch verb retry
cd -- "$source/tests/golden/cases/retry"
expect '"retry"' "$cbc" solve --format json catalog.yaml script.yaml
expect "did you mean 'HOVER'" "$cbc" lint --script <(echo '- {retry: HOVERR}') catalog.yaml
printf '%s\n' '{"stop": "HOVER", "at": 1}' '{"retry": "HOVER", "at": 5}' '{"at": 6}' |
  "$cbc" solve --format jsonl catalog.yaml - >"$folder/log.jsonl"
expect '"verb":"retry"' cat "$folder/log.jsonl"
"$cbc" solve --replay "$folder/log.jsonl" catalog.yaml | diff "$folder/log.jsonl" -
printf '\nThe examples work [%d s]\n' "$SECONDS"
