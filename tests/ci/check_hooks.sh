#!/usr/bin/env bash
# check_hooks.sh PROGRAM: runs the hooks of .pre-commit-hooks.yaml with pre-commit, in a repository with a
# sound catalog, settings of lint, a catalog with an error, and one that can be fixed. Then the same with
# the example of docs/ci.md.
#
# Exit status: 0 all is well, 1 it is not, 77 skipped: a tool is missing.
set -euo pipefail

for tool in git pre-commit; do
  command -v "$tool" >/dev/null || {
    echo "check_hooks.sh: skipped: there is no $tool" >&2
    exit 77
  }
done

source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
mkdir "$work/bin" "$work/home" "$work/hooks" "$work/robot" "$work/robot/catalogs"
ln -s -- "$(realpath -- "$1")" "$work/bin/cbc"
export PATH="$work/bin:$PATH" HOME="$work/home" PRE_COMMIT_COLOR=never
export GIT_CONFIG_NOSYSTEM=1 GIT_AUTHOR_NAME=a GIT_AUTHOR_EMAIL=a@b GIT_COMMITTER_NAME=a GIT_COMMITTER_EMAIL=a@b
unset GIT_DIR GIT_INDEX_FILE GIT_WORK_TREE

fail() {
  printf 'check_hooks.sh: FAILED: %s\n%s\n' "$1" "$output" >&2
  exit 1
}

# hook ID: sets `output` and `status`.
hook() {
  status=0
  git add .
  output=$(pre-commit try-repo "$work/hooks" "$1" --all-files --verbose 2>&1) || status=$?
}

cd -- "$work/hooks"
cp -- "$source/.pre-commit-hooks.yaml" .
git init -q
git add .
git commit -q -m hooks

cd -- "$work/robot"
git init -q
cp -- "$source/catalogs/quadrotor.yaml" catalogs
echo 'this: [is no catalog' >settings.yaml # of another folder, so of no concern
echo 'strict: true' >catalogs/.cbc.yaml    # no catalog either
hook cbc-lint-fix
[[ $status == 0 && $output == *"fix behavior catalogs"*Passed* ]] || fail "a sound catalog to be fixed"
hook cbc-lint
[[ $status == 0 && $output == *"check behavior catalogs"*Passed*"no findings in 1 catalog"* ]] || fail "a sound catalog"

printf 'catalog: /etc/passwd\nevents: [{start: A}]\n' >catalogs/outside.yaml
hook cbc-lint
[[ $status == 1 && $output == *"outside of"*"(--confine)"* && $output != *root:* ]] || fail "a script that names a file outside"
rm catalogs/outside.yaml

printf 'behaviors:\n- behavior: A\n  tasc: B\n' >catalogs/wrong.yaml
hook cbc-lint
[[ $status == 1 && $output == *Failed*"catalogs/wrong.yaml:3:3: "*"did you mean 'task'?"* ]] || fail "a wrong catalog"

printf 'behaviors:\n- behavior: A\n  task: B\ntasks:\n- task: B\n  category: recurrent\n' >catalogs/wrong.yaml
hook cbc-lint-fix
[[ $status == 1 && $output == *"files were modified by this hook"* ]] || fail "a catalog to be fixed"
hook cbc-lint-fix
[[ $status == 0 && $(<catalogs/wrong.yaml) == *"execution_goal: keep_running"* ]] || fail "a fixed catalog"

# The example, but for the address.
awk '/^```/ { if (inside) exit; inside = /yaml/; next } inside' "$source/docs/ci.md" |
  sed "s|https://example.org/cbc|$work/hooks|" >.pre-commit-config.yaml
git -C "$work/hooks" tag "$(sed -n 's/^ *rev: *//p' .pre-commit-config.yaml)"

# example: sets `output` and `status`.
example() {
  status=0
  git add .
  output=$(pre-commit run --all-files --verbose 2>&1) || status=$?
}

mkdir robot
cp -- catalogs/.cbc.yaml "$source/catalogs/quadrotor.yaml" robot
example
[[ $status == 0 && $output == *"no findings in 1 catalog"* ]] || fail "the example, with a sound catalog"
printf 'behaviors:\n- behavior: A\n  task: B\ntasks:\n- task: B\n  category: recurrent\n' >robot/older.yaml
example
[[ $status == 1 && $output == *"fix behavior catalogs"*Failed*"check behavior catalogs"*Passed* ]] ||
  fail "the example, with a catalog to be fixed"
example
[[ $status == 0 ]] || fail "the example, with a fixed catalog"
echo "check_hooks.sh: all is well"
