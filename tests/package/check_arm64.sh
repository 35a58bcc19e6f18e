#!/usr/bin/env bash
# check_arm64.sh make|test PACKAGE…: builds for arm64, in a new root with Debian's cross compiler and these packages, which
# must not change the machine. It leaves the Debian package, and the program that needs no shared library, in build/arm64.
#
# test: in the root, programs for arm64 then run in an emulator: what has just been made, and the tests of the library, of
# the commands, and of the program from outside. What that program and build/release/cbc compile is the same, byte for byte,
# and each decides the same with what the other one has compiled.
#
# Exit status: 0 all is well, 1 it is not, 77 skipped: there can be no new root, or no emulator, here.
set -euo pipefail

goal=$1
packages=$(IFS=, && echo "${*:2}")
work=build/arm64
. "$(dirname -- "${BASH_SOURCE[0]}")/new_root.sh"
copy=$root/root/cbc

# emulate COMMAND…: as at_sources, where the emulator of the root runs programs for arm64. The kernel knows that in a name
# space of this command alone, or it is told so for all of this machine by somebody else.
emulate() {
  # shellcheck disable=SC2016 # the inner shell expands it
  unshare --user --map-root-user --mount --propagation private sh -euc '
    root=$1
    shift
    for folder in proc dev sys; do mount --rbind "/$folder" "$root/$folder"; done
    if mount -t binfmt_misc binfmt_misc "$root/mnt" 2>/dev/null; then
      program="\x7fELF\x02\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x02\x00\xb7\x00"
      mask="\xff\xff\xff\xff\xff\xff\xff\x00\xff\xff\xff\xff\xff\xff\xff\xff\xfe\xff\xff\xff"
      printf %s ":arm64:M:0:$program:$mask:$root/usr/bin/qemu-aarch64-static:F" >"$root/mnt/register"
    fi
    exec chroot "$root" env -i -C /root/cbc PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 "$@"' \
    sh "$root" "$@"
}

# build PRESET TARGET…
build() {
  say "build: $*"
  at_sources cmake --preset "$1" >"$work/$1.log" || fail "cmake: $(tail -n 20 "$work/$1.log")"
  at_sources cmake --build --preset "$1" --parallel "$(nproc)" --target "${@:2}" >>"$work/$1.log" ||
    fail "$(tail -n 40 "$work/$1.log")"
}

can_have_root
[[ $(dpkg --print-architecture) == amd64 ]] || skip "only amd64 builds for arm64"
rm -rf -- "$work/Testing" # its log is only there if the tests have run
trap remove_root EXIT
make_root "$(own_suite)" --architectures=amd64,arm64 --include="$packages"
copy_sources
[[ $goal == make ]] || emulate /lib/ld-linux-aarch64.so.1 --version >/dev/null 2>&1 ||
  skip "no program for arm64 can run here: binfmt_misc in a name space needs Linux 6.7"
mkdir -p "$copy/build"
[[ ! -e $source/build/play ]] || cp -R -- "$source/build/play" "$copy/build" # a part of the package

targets=(cbc)
[[ $goal == make ]] || targets+=(cbc_unit_tests cbc_command_tests cbc_golden_tests cbc_cases cbc_without_commands)
build arm64 "${targets[@]}"
build static-arm64 cbc
say "make the package"
at_sources SOURCE_DATE_EPOCH="$SOURCE_DATE_EPOCH" cpack --config build/arm64/CPackConfig.cmake -B build/package \
  >"$work/package.log" 2>&1 || fail "cpack: $(tail -n 20 "$work/package.log")"
rm -f -- "$work"/*.deb
cp -- "$copy"/build/package/*_arm64.deb "$copy/build/static-arm64/cbc" "$work"
package=$(realpath -- "$work"/*_arm64.deb)
[[ $goal == test ]] || exit 0

say "one file"
emulate bash tests/package/check_static.sh build/static-arm64/cbc

say "package"
[[ $(dpkg-deb -f "$package" Architecture) == arm64 ]] || fail "the package is for another architecture"
emulate bash tests/package/check_hardening.sh "/root/cbc/build/package/$(basename -- "$package")"
emulate python3 -B tests/package/check_sbom.py "build/package/$(basename -- "$package")"
cp -- "$package" "$root/tmp/package.deb"
inside apt-get install -qq -y --no-install-recommends /tmp/package.deb >"$work/install.log" 2>&1 ||
  fail "apt: $(tail -n 5 "$work/install.log")"
for completion in bash-completion/completions/cbc zsh/vendor-completions/_cbc fish/vendor_completions.d/cbc.fish; do
  [[ -s $root/usr/share/$completion ]] || fail "there is no $completion"
done

say "a program for the robot, with a catalog that was compiled here"
(cd -- "$copy" && "$source/build/release/cbc" compile catalogs/quadrotor.yaml -o build/quadrotor.cbc)
at_sources aarch64-linux-gnu-g++ -std=c++20 tests/consumer/main.cpp -lcbc_catalog -o build/consumer
emulate build/consumer build/quadrotor.cbc | diff <(emulate cbc --version && cat "$source/tests/consumer/expected.txt") - ||
  fail "the program for the robot"

say "the same compiled catalogs"
# Large ones, too. PROGRAM FOLDER OTHER: what PROGRAM compiles goes to FOLDER, and it uses what is in OTHER.
at_sources python3 -B -c '
import pathlib, sys
sys.path.append("tests/shapes")
import shapes
folder = pathlib.Path("build/shapes")
folder.mkdir()
for shape in shapes.SHAPES:
    (folder / f"{shape.__name__}.yaml").write_text(shape(300).text())
    (folder / f"{shape.__name__}.mission.yaml").write_text(shapes.MISSION)'
# shellcheck disable=SC2016 # the inner shell expands it
compile='find catalogs tests build/shapes -name "*.yaml" | while read -r catalog; do
  mkdir -p "build/$2/$(dirname "$catalog")"
  "$1" compile "$catalog" -o "build/$2/${catalog%.yaml}.cbc" </dev/null >/dev/null 2>&1 || true # a script, or not valid
done'
# shellcheck disable=SC2016
use='cd "build/$3"
find . -name "*.cbc" | while read -r catalog; do
  mkdir -p "../of_$2/$(dirname "$catalog")"
  mission=../../${catalog%.cbc}.mission.yaml
  { "$1" graph "$catalog"; [ ! -f "$mission" ] || "$1" solve "$catalog" "$mission"; } </dev/null >"../of_$2/$catalog.txt" 2>&1
done'
for both in "$compile" "$use"; do
  emulate sh -c "$both" sh /root/cbc/build/arm64/cbc arm64-files amd64-files
  (cd -- "$copy" && sh -c "$both" sh "$source/build/release/cbc" amd64-files arm64-files)
  diff -r "$copy/build/amd64-files" "$copy/build/arm64-files" || fail "the compiled catalogs differ"
done
diff -r "$copy/build/of_amd64-files" "$copy/build/of_arm64-files" || fail "the answers differ"
say "$(find "$copy/build/arm64-files" -name '*.cbc' | wc -l) compiled catalogs, and the answers to" \
  "$(grep -rl '^  events  ' "$copy/build/of_arm64-files" | wc -l) missions, are the same"

# In the name space there is no other user to become; a start takes longer than tests with a clock of their own wait; one test
# takes a quarter of an hour.
left_out="AtomicFile.LeavesReadOnlyFilesAndFoldersAlone:StreamTest.*RealClock*:NestedConditions.AreJudgedInBoundedTime"
say "tests, but for $left_out"
status=0
# Of thousands of programs that are started in the emulator, one may hang before it begins.
emulate GTEST_FILTER="-$left_out" ctest --preset arm64 --parallel "$(nproc)" --repeat after-timeout:2 || status=$?
mkdir -p "$work/Testing/Temporary"
cp -- "$copy/build/arm64/Testing/Temporary/LastTest.log" "$work/Testing/Temporary"
((status == 0)) || fail "tests"
echo "check_arm64.sh: all is well"
