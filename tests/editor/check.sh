#!/bin/sh
# check.sh FOLDER: edits the catalogs of the repository, and their missions, with the YAML language server.
# It comes from npm, and goes to FOLDER.
#
# Exit status: 0 it does what it should, 1 it does not, 77 skipped: no Node.js, or no way to the packages.
set -u

source=$(cd -- "$(dirname -- "$0")" && pwd)
folder=$1

sh "$source/../npm_install.sh" "$source" "$folder" || exit
NODE_PATH=$folder/node_modules exec node "$source/check.js"
