#!/bin/sh
# check.sh FOLDER PROGRAM CASES: validates the JSON of PROGRAM, and that of the golden cases, which are unpacked
# in CASES, with the schemas of the repository; then its catalogs, scripts and property files, good ones and bad ones. The packages come
# from npm, and go to FOLDER.
#
# Exit status: 0 valid, 1 not valid, 77 skipped: no Node.js, or no way to the packages.
set -u

source=$(cd -- "$(dirname -- "$0")" && pwd)
folder=$1
program=$2
cases=$3

sh "$source/../npm_install.sh" "$source" "$folder" || exit
export NODE_PATH="$folder/node_modules"
node "$source/check.js" "$program" "$cases" && exec node "$source/check_inputs.js" "$program" "$cases"
