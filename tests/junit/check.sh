#!/bin/sh
# check.sh PROGRAM CASES: validates what `cbc solve --format junit` and `cbc verify --format junit` print of
# the golden cases with the schema, and that the counts of each suite are those of its test cases.
#
# Exit status: 0 valid, 1 not valid, 77 skipped: no xmllint.
set -u

schema=$(cd -- "$(dirname -- "$0")" && pwd)/junit.xsd
program=$1
cases=$2
shared=$(cd -- "$(dirname -- "$0")/../golden/shared" && pwd)

command -v xmllint >/dev/null || {
  echo "check.sh: skipped: there is no xmllint" >&2
  exit 77
}

report=$(mktemp) || exit 1
broken=$(mktemp) || exit 1
trap 'rm -f "$report" "$broken"' EXIT

fail() {
  echo "check.sh: $1" >&2
  exit 1
}

# count XPATH: how many nodes of the report it finds
count() { xmllint --xpath "count($1)" "$report"; }

# write_report FOLDER ARGUMENT...: of one suite
write_report() {
  folder=$1
  shift
  (cd "$folder" && "$program" "$@" --format junit) >"$report" 2>/dev/null
}

check_report() {
  write_report "$@"
  xmllint --noout --schema "$schema" "$report" 2>"$broken" || fail "$folder: $(cat "$broken")"
  for kind in failure error skipped; do
    counted=$(xmllint --xpath "string(//testsuite/@${kind}s | //testsuite/@$kind)" "$report")
    [ "$counted" = "$(count "//testcase/$kind")" ] || fail "$folder: $kind: the count is wrong"
  done
  [ "$(xmllint --xpath 'string(//testsuite/@tests)' "$report")" = "$(count //testcase)" ] ||
    fail "$folder: tests: the count is wrong"
  checked=$((checked + 1))
}

checked=0
for case in "$cases"/*/ "$shared"/*/; do
  [ -f "$case/catalog.yaml" ] && [ -f "$case/script.yaml" ] || continue
  check_report "$case" solve catalog.yaml script.yaml --max-clock-events 100
done
check_report "$shared/verify_properties" verify robot.properties.yaml
check_report "$shared/verify_properties" verify robot.properties.yaml --max-states 30
check_report "$cases/verify_bad_properties" verify bad.yaml
[ "$checked" -gt 50 ] || fail "only $checked reports were checked"

# The check itself: what is not in the schema is found.
write_report "$shared/expectation_fails" solve catalog.yaml script.yaml
sed 's/ failures="[0-9]*"//' "$report" >"$broken"
xmllint --noout --schema "$schema" "$broken" 2>/dev/null && fail "a missing attribute is not found"
sed 's/<testcase /<testcase line="1" /' "$report" >"$broken"
xmllint --noout --schema "$schema" "$broken" 2>/dev/null && fail "a foreign attribute is not found"
echo "check.sh: $checked reports are valid"
