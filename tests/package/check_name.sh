#!/usr/bin/env bash
# check_name.sh PROGRAM WORK: configures the project for a program of another name. No page of the manual
# may refer to the usual one. Then PROGRAM, built with the usual name, and the library beside it stand in
# for what would be built: they are installed, and a project compiles a catalog with them.
set -euo pipefail

program=$1
work=$2
source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")

fail() {
  echo "check_name.sh: FAILED: $*" >&2
  exit 1
}

rm -rf -- "$work"
cmake -S "$source" -B "$work" -D CBC_BUILD_BENCHMARKS=OFF -D CBC_BUILD_TESTS=OFF -D CBC_PROGRAM_NAME=other-name >/dev/null

for page in "$source"/man/*.[1-9]; do
  name=other-name$(basename -- "$page" | sed 's/^cbc//')
  [[ $(grep -cF 'other-name' "$work/share/man/man${page##*.}/$name") -gt 1 ]] || fail "$name does not name the program"
  # Nothing but names is different.
  diff <(sed -E 's/other-name/cbc/; s/OTHER-NAME/CBC/' "$work/share/man/man${page##*.}/$name") "$page"
done
if grep -nE '^(\.(Nm|Xr|Dt) |\$ )(cbc|CBC)($|[- ])' "$work"/share/man/man?/*; then
  fail "these lines have the usual name"
fi
sed -n '/^\.Sh CAVEATS/,$p' "$work/share/man/man1/other-name.1" | grep -qxF '.Ql cbc' || fail "COIN-OR's program is called cbc"

cp -- "$program" "$work/other-name"
cp -- "$(dirname -- "$program")/libcbc_catalog.a" "$work"
"$work/other-name" completion bash >"$work/completions/other-name"
"$work/other-name" completion zsh >"$work/completions/_other-name"
"$work/other-name" completion fish >"$work/completions/other-name.fish"
prefix=$work/installed
cmake --install "$work" --prefix "$prefix" >/dev/null
[[ $("$prefix/bin/other-name" --version) == "cbc "* ]] || fail "the installed program"
[[ $(find "$prefix" -name 'other-name*.[1-9]' | wc -l) == $(find "$source/man" -name '*.[1-9]' | wc -l) ]] ||
  fail "the installed manual"
grep -q '^complete .*other-name$' "$prefix/share/bash-completion/completions/other-name" || fail "the installed completion"
# What has the name cbc belongs to the library and to the schemas.
found=$(cd "$prefix" && find . -name 'cbc*' -o -name '_cbc*' | grep -vE '^\./(include|lib[^/]*)/|^\./share/cbc(/|$)' || true)
[[ -z $found ]] || fail "these files have the usual name: $found"

mkdir "$work/project"
cat >"$work/project/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.21)
project(robot LANGUAGES NONE)
find_package(cbc_catalog REQUIRED)
cbc_add_catalog(catalogs "$source/catalogs/quadrotor.yaml")
END
cmake -S "$work/project" -B "$work/project/build" -D CMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build "$work/project/build" >/dev/null
[[ -f $work/project/build/quadrotor.cbc ]] || fail "the project's catalog"
echo "check_name.sh: all is well"
