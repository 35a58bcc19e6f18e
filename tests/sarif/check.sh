#!/bin/sh
# check.sh FOLDER [FILE]: validates a SARIF log, of standard input if there is no FILE, with the
# published schema of SARIF 2.1.0. The schema and the validator come from npm, and go to FOLDER.
#
# Exit status: 0 valid, 1 not valid, 77 skipped: no Node.js, or no way to the packages.
set -u

source=$(cd -- "$(dirname -- "$0")" && pwd)
folder=$1
log=${2:--}

sh "$source/../npm_install.sh" "$source" "$folder" || {
  status=$?
  if [ "$log" = - ]; then cat >/dev/null; fi # so that the writer of the log gets rid of it
  exit $status
}

cp "$source/check.js" "$folder" || exit 1 # where it finds the packages
if [ "$log" = - ]; then
  exec node "$folder/check.js"
else
  exec node "$folder/check.js" <"$log"
fi
