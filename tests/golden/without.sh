#!/bin/sh
# without.sh COMMAND PROGRAM CATALOG: does PROGRAM lack this COMMAND, and nothing else?
set -eu
help=$("$2" --help)
if echo "$help" | grep -q "^  $1 "; then
  echo "without.sh: --help has $1" >&2
  exit 1
fi
if "$2" "$1" "$3" 2>/dev/null; then
  echo "without.sh: $1 is known" >&2
  exit 1
fi
for other in sweep coverage; do
  [ "$other" = "$1" ] || "$2" "$other" --help >/dev/null
done
"$2" lint --strict "$3"
