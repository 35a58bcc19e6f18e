#!/bin/sh
# check.sh FOLDER [FILE]: validates a SARIF log, of standard input if there is no FILE, with the
# published schema of SARIF 2.1.0. The schema and the validator come from npm, and go to FOLDER.
#
# Exit status: 0 valid, 1 not valid, 77 skipped: no Node.js, or no way to the packages.
set -u

source=$(cd -- "$(dirname -- "$0")" && pwd)
folder=$1
log=${2:--}

skip() {
  echo "check.sh: skipped: $1" >&2
  if [ "$log" = - ]; then cat >/dev/null; fi # so that the writer of the log gets rid of it
  exit 77
}

for program in node npm; do
  command -v $program >/dev/null || skip "there is no $program"
done

mkdir -p "$folder" || exit 1
if ! cmp -s "$source/package-lock.json" "$folder/installed"; then
  cp "$source/package.json" "$source/package-lock.json" "$folder" || exit 1
  npm ci --prefix "$folder" --ignore-scripts --no-audit --no-fund --prefer-offline \
    --fetch-retries=1 --fetch-retry-mintimeout=1000 --fetch-timeout=20000 \
    >"$folder/npm.log" 2>&1 </dev/null || skip "npm cannot install the schema, see $folder/npm.log"
  cp "$source/package-lock.json" "$folder/installed"
fi

cp "$source/check.js" "$folder" || exit 1 # where it finds the packages
if [ "$log" = - ]; then
  exec node "$folder/check.js"
else
  exec node "$folder/check.js" <"$log"
fi
