#!/usr/bin/env bash
# check_release.sh: the workflow that builds a release calls what is there, and attaches what that makes. GitHub
# itself is not asked; the commands of ./dev have tests of their own.
set -euo pipefail

source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")
workflow=$source/.github/workflows/release.yml
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
cd -- "$work"

fail() {
  echo "check_release.sh: FAILED: $1" >&2
  exit 1
}

# step TEXT: the only command of the workflow that has this text, on one line.
step() {
  local lines
  lines=$(sed -n 's/^ *\(- \)\?run: *//p' "$workflow" | grep -F -- "$1") || fail "no step has $1"
  (($(wc -l <<<"$lines") == 1)) || fail "several steps have $1"
  printf '%s\n' "$lines"
}

for command in package static; do
  [[ $(step "./dev $command") == "./dev $command" ]] || fail "./dev $command is not called"
  grep -q "^  $command " <<<"$("$source/dev" help)" || fail "./dev has no command $command"
done

# The tag is compared with the version.
version=$(sed -n 's/^  VERSION //p' "$source/CMakeLists.txt")
cp -- "$source/CMakeLists.txt" .
check=$(step VERSION)
GITHUB_REF_NAME=v$version bash -c "$check" || fail "the tag v$version is refused"
! GITHUB_REF_NAME=v9$version bash -c "$check" || fail "the tag v9$version is accepted"

# What the commands of ./dev make is found under the names of the workflow.
mkdir -p build/package build/static
touch build/package/behavior-catalog-compiler_"$version"-1~debian12_amd64.deb build/static/cbc
grep -q 'build/static/cbc' "$source/dev" || fail "./dev static makes another file"
GITHUB_REF_NAME=v$version bash -c "$(step 'cp build/static/cbc')"
[[ -f build/cbc-$version-linux-$(uname -m) ]] || fail "the program has no name of its own"
mapfile -t patterns < <(sed -n 's/^ *\(build\/[^ ]*\)$/\1/p' "$workflow")
((${#patterns[@]} == 2)) || fail "expected two patterns of files"
for pattern in "${patterns[@]}"; do
  compgen -G "$pattern" >/dev/null || fail "$pattern fits no file"
done

# The artifact has the files by their paths below build.
cd build
bash -c "$(step SHA256SUMS)"
(($(wc -l <SHA256SUMS) == 2)) || fail "SHA256SUMS: $(<SHA256SUMS)"
# Users have all files in one folder.
mkdir download
cp -- *.deb cbc-*-linux-* SHA256SUMS download
(cd download && sha256sum --check --quiet SHA256SUMS) || fail "SHA256SUMS is not for the files of a release"
echo "check_release.sh: all is well"
