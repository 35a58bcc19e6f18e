#!/usr/bin/env bash
# check_package.sh PACKAGE WORK: installs the Debian package in a new root, which has nothing but apt and
# what apt needs, uses it there as a person would, and removes it again. Then it is installed once more, for
# projects with catalogs and in C++, with the packages that they need, and no others, added step by step. WORK
# is a folder to write in.
#
# Exit status: 0 all is well, 1 it is not, 77 skipped: there can be no new root here.
set -euo pipefail

package=$(realpath -- "$1")
work=$2
. "$(dirname -- "${BASH_SOURCE[0]}")/new_root.sh"
name=$(dpkg-deb -f "$package" Package)
version=$(dpkg-deb -f "$package" Version)
version=${version%-*}
examples=/usr/share/doc/$name/examples

# install LOG PACKAGE...: installs in the new root.
install() {
  inside apt-get install -qq -y --no-install-recommends "${@:2}" >"$work/$1.log" 2>&1 ||
    fail "apt: $(tail -n 5 "$work/$1.log")"
}

# All files, but for the records and caches that apt and dpkg keep.
list_files() {
  (cd "$root" && find . -xdev \( -path ./proc -o -path ./sys -o -path ./dev -o -path ./tmp \
    -o -path ./var/lib/dpkg -o -path ./var/lib/apt -o -path ./var/cache -o -path ./var/log \) \
    -prune -o -print) | sort
}

[[ $(dpkg-deb -f "$package" Recommends) == *man-db* ]] || fail "without man, nobody can read the manual"

can_have_root

say "lintian"
# It is not uploaded to Debian, and the folder of libraries is that of the build, for all architectures.
lintian --allow-root --fail-on error,warning \
  --suppress-tags initial-upload-closes-no-bugs,pkg-config-unavailable-for-cross-compilation "$package"

trap remove_root EXIT
make_root "$(own_suite)"
use true
list_files >"$work/before"

say "install"
cp -- "$package" "$root/tmp/package.deb"
install install /tmp/package.deb

say "use"
[[ $(use cbc --version) == "cbc $version" ]] || fail "cbc --version says $(use cbc --version)"
use cbc lint --strict "$examples"
use cbc init first
use cbc solve first/missions | grep '^expectations: .* 0 failed$' || fail "cbc init"
for mission in "$root$examples"/*.mission.yaml; do
  catalog=$(basename -- "$mission" .mission.yaml)
  use cbc compile "$examples/$catalog.yaml" -o "$catalog.cbc"
  use cbc solve "$catalog.cbc" "$examples/$catalog.mission.yaml" | grep '^expectations: .* 0 failed$' ||
    fail "cbc solve $catalog.cbc"
  use cbc lint --strict "$examples/$catalog.properties.yaml"
  [[ $(use cbc graph "$catalog.cbc") == "digraph "* ]] || fail "cbc graph $catalog.cbc"
  schema=$(sed -n '1s/.*\$schema=//p' "$root$examples/$catalog.yaml")
  [[ -f $root$examples/$schema ]] || fail "$catalog.yaml names the schema $schema, which is not there"
done

say "manual"
for page in "$source"/man/*.[1-9]; do
  page=$(basename -- "$page")
  [[ $(man -M "$root/usr/share/man" "${page##*.}" "${page%.*}") == *$'\nNAME\n'* ]] || fail "man ${page%.*}"
done

say "completion"
for installed in bash:bash-completion/completions/cbc zsh:zsh/vendor-completions/_cbc \
  fish:fish/vendor_completions.d/cbc.fish; do
  use cbc completion "${installed%%:*}" | diff - "$root/usr/share/${installed#*:}" || fail "${installed#*:}"
done

say "conflict with coinor-cbc"
(cd "$root/tmp" && inside env -C /tmp apt-get -qq download coinor-cbc) >"$work/coinor.log" 2>&1 ||
  fail "apt: $(tail -n 2 "$work/coinor.log")"
if inside sh -c 'dpkg -i /tmp/coinor-cbc*.deb' >"$work/coinor.log" 2>&1; then
  fail "dpkg installs coinor-cbc beside $name"
fi
grep "$name conflicts with coinor-cbc" "$work/coinor.log" || fail "$(cat "$work/coinor.log")"
[[ $(use cbc --version) == "cbc $version" ]] || fail "cbc is not itself any more"

say "remove"
inside apt-get purge -qq -y --autoremove "$name" >"$work/remove.log" 2>&1 ||
  fail "apt: $(tail -n 5 "$work/remove.log")"
list_files | diff "$work/before" - || fail "the package leaves these files"

say "a project with catalogs"
install catalogs /tmp/package.deb cmake make
mkdir "$root/tmp/use/robot"
cp -- "$source/catalogs/quadrotor.yaml" "$root/tmp/use/robot"
cat >"$root/tmp/use/robot/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.21)
project(robot LANGUAGES NONE)
find_package(cbc_catalog REQUIRED)
cbc_add_catalog(robot_catalogs quadrotor.yaml)
END
use cmake -S robot -B robot-build >"$work/robot.log"
use cmake --build robot-build >>"$work/robot.log"
[[ $(use cbc graph robot-build/quadrotor.cbc) == "digraph "* ]] || fail "cbc_add_catalog: $(<"$work/robot.log")"

say "a project in C++, with CMake and with pkg-config"
install develop g++ pkg-config
for header in CLI/CLI.hpp boost/version.hpp flatbuffers/flatbuffers.h fmt/format.h nlohmann/json.hpp xxhash.h \
  yaml-cpp/yaml.h; do
  [[ ! -e $root/usr/include/$header ]] || fail "$header is installed, so a need for it would not be noticed"
done
mkdir -p "$root/tmp/use/cpp/tests"
cp -r -- "$source/tests/consumer" "$root/tmp/use/cpp/tests"
cp -r -- "$source/catalogs" "$root/tmp/use/cpp"
use cmake -S cpp/tests/consumer -B consumer >"$work/consumer.log"
use cmake --build consumer >>"$work/consumer.log"
use sh -c 'g++ -std=c++20 cpp/tests/consumer/main.cpp -o consumer-pkg $(pkg-config --cflags --libs cbc-catalog)'
for consumer in consumer/consumer ./consumer-pkg; do
  use "$consumer" consumer/quadrotor.cbc | diff <(echo "cbc $version" && cat "$source/tests/consumer/expected.txt") - ||
    fail "$consumer"
  if use ldd "$consumer" | grep -vE '^\s*(linux-vdso|/lib.*/ld-linux|lib(c|gcc_s|m|stdc\+\+)\.so)'; then
    fail "$consumer needs these shared libraries"
  fi
done
[[ $(use pkg-config --modversion cbc-catalog) == "$version" ]] || fail "pkg-config"
echo "check_package.sh: $(basename -- "$package"): all is well"
