#!/usr/bin/env bash
# try.sh FOLDER: applies the patches of this folder to a copy of the sources, builds the program and the
# tests that look at what the patches add, and runs them. FOLDER keeps the copy and what was built.
#
# Help texts and lists of rules follow from the tables that a patch extends. Their expectations are
# not part of the patches, but written anew here; the case that a patch brings must pass as it is.
#
# Each source is compiled alone and without precompiled headers, which no other build does, so that it is
# seen whether it includes what it uses.
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

# Copies the sources with their times, so that only what has changed is built again; what the
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

# apply NAME
apply() {
  patch --quiet --batch --forward --strip=1 --no-backup-if-mismatch --directory="$source" \
    --input="$origin/tests/growing/$1.patch"
}

copy_sources
apply rule
apply format
apply verb

# Not optimized, which takes a fraction of the time.
launcher=()
if type ccache >/dev/null 2>&1; then launcher=(-D CMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
cmake -S "$source" -B "$build" -G Ninja "${launcher[@]}" -D CMAKE_BUILD_TYPE=Release \
  -D CMAKE_CXX_FLAGS_RELEASE=-O0 -D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON -D CBC_WERROR=ON \
  -D CBC_BUILD_BENCHMARKS=OFF -D CBC_DISCOVER_TESTS=OFF -D CBC_TEST_CONSUMER=OFF >"$folder/cmake.log"
cmake --build "$build" --target cbc cbc_growing_tests --parallel "$(nproc)" >"$folder/build.log" ||
  fail "building"$'\n'"$(tail -n 30 "$folder/build.log")"
printf -- '-- built [%d s]\n' "$SECONDS"

cases=$source/tests/golden/cases
cd -- "$cases"
for case in lint_rule_long_name lint_format_csv retry; do
  "$tests" --gtest_brief=1 --gtest_filter="*Golden.Matches/$case"
done
CBC_UPDATE_GOLDEN=1 "$tests" --gtest_brief=1 --gtest_filter='*Golden.*' >/dev/null
{ diff -rq "$origin/tests/golden/cases" "$cases" || true; } |
  sed -nE 's|^Files .*/cases/([^/]*)/.*|follows: \1|p'
"$tests" --gtest_brief=1
for check in form options; do
  sh "$source/tests/manual/check.sh" "$check" "$cbc" || (($? == 77)) || fail "manual: $check"
done

printf -- '-- rule.patch\n'
expect 'long-name                 note' "$cbc" lint --list-rules
expect '[long-name]' "$cbc" lint lint_rule_long_name/catalog.yaml
expect 'no findings in 1 catalog' "$cbc" lint --allow long-name lint_rule_long_name/catalog.yaml

printf -- '-- format.patch\n'
expect '"lint_format_gcc/catalog.yaml",10,' "$cbc" lint --format csv lint_format_gcc/catalog.yaml
expect 'csv' "$cbc" __complete bash '' 3 lint --format ''

printf -- '-- verb.patch\n'
cd -- retry
expect '"retry"' "$cbc" solve --format json catalog.yaml script.yaml
expect "did you mean 'HOVER'" "$cbc" lint --script <(echo '- {retry: HOVERR}') catalog.yaml
printf '%s\n' '{"stop": "HOVER", "at": 1}' '{"retry": "HOVER", "at": 5}' '{"at": 6}' |
  "$cbc" solve --format jsonl catalog.yaml - >"$folder/log.jsonl"
expect '"verb":"retry"' cat "$folder/log.jsonl"
"$cbc" solve --replay "$folder/log.jsonl" catalog.yaml | diff "$folder/log.jsonl" -
printf '\nThe examples work [%d s]\n' "$SECONDS"
