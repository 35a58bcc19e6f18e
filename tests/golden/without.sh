#!/bin/sh
# without.sh PROGRAM CATALOG COMMAND...: does PROGRAM lack these COMMANDs, and nothing else?
set -eu
program=$1
catalog=$2
shift 2
help=$("$program" --help)
for command in "$@"; do
  if echo "$help" | grep -q "^  $command "; then
    echo "without.sh: --help has $command" >&2
    exit 1
  fi
  if "$program" "$command" "$catalog" 2>/dev/null; then
    echo "without.sh: $command is known" >&2
    exit 1
  fi
done
"$program" lint --strict "$catalog"
