#!/bin/sh
# npm_install.sh SOURCE FOLDER: installs the packages of SOURCE/package-lock.json into FOLDER,
# unless they are there.
#
# Exit status: 0 they are there, 77 skipped: no Node.js, or no way to the packages.
set -u

source=$1
folder=$2

skip() {
  echo "npm_install.sh: skipped: $1" >&2
  exit 77
}

for program in node npm; do
  command -v $program >/dev/null || skip "there is no $program"
done

mkdir -p "$folder" || exit 1
cmp -s "$source/package-lock.json" "$folder/installed" && exit 0
cp "$source/package.json" "$source/package-lock.json" "$folder" || exit 1
npm ci --prefix "$folder" --ignore-scripts --no-audit --no-fund --prefer-offline \
  --fetch-retries=1 --fetch-retry-mintimeout=1000 --fetch-timeout=20000 \
  >"$folder/npm.log" 2>&1 </dev/null || skip "npm cannot install the packages, see $folder/npm.log"
cp "$source/package-lock.json" "$folder/installed"
