#!/usr/bin/env bash
# check.sh: CONTRIBUTING.md tells how to add a rule, an event verb, and an output format. The patches
# in this folder do so; here is checked that they still apply, that each changes few files besides
# its tests, and that CONTRIBUTING.md lists exactly those.
#
# Exit status: 0 good, 1 not good, 77 skipped: no patch(1).
set -euo pipefail

source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")
status=0

if ! type patch >/dev/null 2>&1; then
  echo "growing_text: skipped: patch is missing"
  exit 77
fi

fail() {
  echo "check.sh: $1"
  status=1
}

# changed_files PATCH: without tests, which are as many as it takes
changed_files() {
  sed -n 's|^+++ b/||p' "$1" | grep -v '^tests/' | sort
}

# listed_files TITLE: the files that the steps of a section begin with
listed_files() {
  awk -v title="## $1" '/^## / { inside = $0 == title } inside' "$source/CONTRIBUTING.md" |
    sed -nE 's/^[0-9]+\. `([^`]*)`.*/\1/p' | grep -v '^tests/' | sort
}

# check NAME LIMIT TITLE
check() {
  local patch=$source/tests/growing/$1.patch changed
  changed=$(changed_files "$patch")
  if (($(wc -l <<<"$changed") > $2)); then
    fail "$1.patch changes more than $2 files besides its tests:"$'\n'"$changed"
  fi
  if ! diff -u --label CONTRIBUTING.md <(listed_files "$3") --label "$1.patch" - <<<"$changed"; then
    fail "the section \"$3\" lists other files than $1.patch changes"
  fi
  if ! grep -qF "(tests/growing/$1.patch)" "$source/CONTRIBUTING.md"; then
    fail "CONTRIBUTING.md does not link to $1.patch"
  fi
  if ! patch --dry-run --batch --forward --strip=1 --directory="$source" --input="$patch"; then
    fail "$1.patch does not apply any more; CONTRIBUTING.md says how to make it anew"
  fi
}

check rule 4 'Add a rule'
check verb 8 'Add an event verb'
check format 3 'Add an output format'
exit "$status"
