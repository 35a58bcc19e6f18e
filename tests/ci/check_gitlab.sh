#!/usr/bin/env bash
# check_gitlab.sh PROGRAM CASES: runs the script of the example for GitLab in docs/ci.md, as it stands there, and
# compares its report with what lint prints in another format.
#
# Exit status: 0 all is well, 1 it is not, 77 skipped: a tool is missing.
set -euo pipefail

for tool in jq python3; do
  command -v "$tool" >/dev/null || {
    echo "check_gitlab.sh: skipped: there is no $tool" >&2
    exit 77
  }
done

source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
mkdir "$work/bin" "$work/catalogs"
ln -s -- "$(realpath -- "$1")" "$work/bin/cbc"
export PATH="$work/bin:$PATH"
cd -- "$work"

fail() {
  echo "check_gitlab.sh: FAILED: $*" >&2
  exit 1
}

# Each line of the example is one of the script, but for what YAML needs.
sed -n '/^catalogs:$/,/^  artifacts:$/{ s/^  - >-$//; s/^  - //; /^catalogs:$/d; /^  [a-z]*:$/d; p }' \
  "$source/docs/ci.md" >script
[[ $(<script) == *jq*code-quality.json* ]] || fail "the script is $(<script)"

# run STATUS: runs it as GitLab does, with a shell that ends at the first error.
run() {
  local status=0
  rm -f code-quality.json
  sh -e script >output 2>&1 || status=$?
  [[ $status == "$1" ]] || fail "the script ends with $status: $(<output)"
}

cp -- "$source/catalogs/quadrotor.yaml" catalogs
run 0
[[ $(<code-quality.json) == "[]" ]] || fail "a sound catalog: $(<code-quality.json)"

# Files with all kinds of findings, two of one kind at one place, and a name with quotes.
for case in "$2"/*/; do
  if [[ -f $case/catalog.yaml ]]; then
    cp -- "$case/catalog.yaml" "catalogs/$(basename -- "$case").yaml"
  fi
done
printf 'behaviors:\n- suitability: 50\n' >'catalogs/a "name" \(1).yaml'
run 1
cbc lint --strict --format gcc catalogs >lint.txt || true
python3 - <<'END' || fail "see above"
import collections, json, re

report = json.load(open("code-quality.json"))
found = collections.Counter(
    (item["location"]["path"], item["location"]["lines"]["begin"], item["severity"], item["check_name"])
    for item in report)
severities = {"error": "major", "warning": "minor", "note": "info"}
expected = collections.Counter()
for line in open("lint.txt"):
    match = re.fullmatch(r"(.*?):(\d+):\d+: (error|warning|note): .* \[([a-z-]+)\]\n", line)
    if match:
        expected[match[1], int(match[2]), severities[match[3]], match[4]] += 1
if len(expected) < 100:
    exit(f"only {len(expected)} findings")
if found != expected:
    exit(f"missing: {expected - found}\nnot expected: {found - expected}")
fingerprints = collections.Counter(item["fingerprint"] for item in report)
if len(fingerprints) != len(report):
    exit(f"these are not unique: {[text for text, count in fingerprints.items() if count > 1]}")
if not all(item["description"] for item in report):
    exit("findings without a description")
END

# Nothing is reported of what could not be read.
rm -r catalogs
run 2
[[ ! -e code-quality.json ]] || fail "a report, although there are no catalogs"
echo "check_gitlab.sh: all is well"
