#!/bin/sh
# no_terminal.sh GOLDEN_TESTS PROGRAM: where /dev/pts is missing, tests that need a terminal are skipped and say so.
#
# Exit status: 0 they do, 1 they do not, 77 skipped: /dev/pts cannot be hidden here.
set -u

hidden() {
  # shellcheck disable=SC2016 # the inner shell expands it
  unshare --map-root-user --mount sh -c 'mount -t tmpfs none /dev/pts && exec "$@"' sh "$@"
}

if ! hidden true 2>/dev/null; then
  echo "no_terminal.sh: skipped: /dev/pts cannot be hidden: no mount namespace may be created" >&2
  exit 77
fi
output=$(hidden "$1" --gtest_filter='Terminal.*') || {
  echo "no_terminal.sh: tests fail: $output" >&2
  exit 1
}
case $output in
  *"is /dev/pts mounted?"*) ;;
  *)
    echo "no_terminal.sh: no reason is given: $output" >&2
    exit 1
    ;;
esac
case $output in
  *"[       OK ]"*)
    echo "no_terminal.sh: a test had a terminal: $output" >&2
    exit 1
    ;;
esac
completion=$(hidden sh "$(dirname -- "$0")/../completion/check.sh" bash "$2" /nonexistent 2>&1)
status=$?
case $status,$completion in
  77,*"is /dev/pts mounted?"*) ;;
  *)
    echo "no_terminal.sh: completion/check.sh: exit status $status: $completion" >&2
    exit 1
    ;;
esac
