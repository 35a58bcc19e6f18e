#!/usr/bin/env bash
# check_reproducible.sh PACKAGE WORK: makes the Debian package again, from a copy of the sources in a folder of another
# name, at another time, with another umask, locale and time zone: it has the same bytes. WORK is a folder to write in.
set -euo pipefail

package=$(realpath -- "$1")
rm -rf -- "$2"
mkdir -p -- "$2"
copy=$(realpath -- "$2")/"elsewhere, with a longer name"
source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")

mkdir -- "$copy"
tar -C "$source" --exclude=./build --exclude=./.git -cf - . | tar -C "$copy" --touch -xf -
# The page of the simulator is a part of the package if it was made before.
if [[ -e $source/build/play ]]; then mkdir -- "$copy/build" && cp -R -- "$source/build/play" "$copy/build"; fi
made="$copy/build/package/$(basename -- "$package")"
umask 077
LC_ALL=C.UTF-8 TZ=Pacific/Auckland "$copy/dev" package
if ! cmp -- "$package" "$made"; then
  number=0
  for one in "$package" "$made"; do
    dpkg-deb --fsys-tarfile "$one" | tar -tvf - >"$copy/list"
    dpkg-deb -R "$one" "$copy/files"
    (cat "$copy/list" && cd "$copy/files" && find . -type f -exec sha256sum {} + | sort -k 2) >"$copy/$((++number)).sums"
    rm -rf -- "$copy/files"
  done
  diff "$copy"/*.sums || true
  echo "check_reproducible.sh: FAILED: the package depends on where, when or how it is built" >&2
  exit 1
fi
echo "check_reproducible.sh: $(sha256sum <"$package" | cut -d ' ' -f 1), twice"
