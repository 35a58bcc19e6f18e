#!/bin/sh
# check.sh FOLDER PROGRAM: has Mermaid read the pictures that PROGRAM prints. Mermaid comes from npm,
# and goes to FOLDER.
#
# Exit status: 0 all are read, 1 not all, 77 skipped: no Node.js, or no way to the packages.
set -u

source=$(cd -- "$(dirname -- "$0")" && pwd)
folder=$1
program=$2

sh "$source/../npm_install.sh" "$source" "$folder" || exit
cp "$source/check.js" "$folder" || exit 1 # where it finds the packages
"$program" >"$folder/pictures" || exit 1
exec node "$folder/check.js" <"$folder/pictures"
