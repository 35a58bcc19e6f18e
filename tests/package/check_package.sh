#!/usr/bin/env bash
# check_package.sh PACKAGE WORK: installs the Debian package in a new root, which has nothing but apt and
# what apt needs, uses it there as a person would, and removes it again. WORK is a folder to write in.
#
# Exit status: 0 all is well, 1 it is not, 77 skipped: there can be no new root here.
set -euo pipefail

package=$(realpath -- "$1")
mkdir -p -- "$2"
work=$(realpath -- "$2")
source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")
root=$work/root
name=$(dpkg-deb -f "$package" Package)
version=$(dpkg-deb -f "$package" Version)
version=${version%-*}
examples=/usr/share/doc/$name/examples

say() { printf -- '-- %s\n' "$*"; }

skip() {
  echo "check_package.sh: skipped: $*" >&2
  exit 77
}

fail() {
  echo "check_package.sh: FAILED: $*" >&2
  exit 1
}

# In the new root, as its administrator.
inside() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"
}

# In the new root, as somebody without any rights, in a folder to write in.
use() {
  chroot --userspec=65534:65534 "$root" env -i -C /tmp/use PATH=/usr/bin:/bin LC_ALL=C.UTF-8 "$@"
}

# All files, but for the records and caches that apt and dpkg keep.
list_files() {
  (cd "$root" && find . -xdev \( -path ./proc -o -path ./sys -o -path ./dev -o -path ./tmp \
    -o -path ./var/lib/dpkg -o -path ./var/lib/apt -o -path ./var/cache -o -path ./var/log \) \
    -prune -o -print) | sort
}

((EUID == 0)) || skip "only root can make a new root"
command -v mmdebstrap >/dev/null || skip "there is no mmdebstrap"

say "lintian"
lintian --allow-root --fail-on error "$package"

say "a new root"
trap 'rm -rf --one-file-system -- "$root"' EXIT
rm -rf --one-file-system -- "$root"
suite=$(. /etc/os-release && echo "${VERSION_CODENAME:-}")
mmdebstrap --variant=apt --skip=cleanup/apt/lists "$suite" "$root" >"$work/root.log" 2>&1 ||
  skip "mmdebstrap failed: $(grep -m 3 '^[EW]' "$work/root.log" || cat "$work/root.log")"
mkdir -m 777 "$root/tmp/use"
list_files >"$work/before"

say "install"
cp -- "$package" "$root/tmp/package.deb"
inside apt-get install -qq -y --no-install-recommends /tmp/package.deb >"$work/install.log" 2>&1 ||
  fail "apt: $(tail -n 5 "$work/install.log")"

say "use"
[[ $(use cbc --version) == "cbc $version" ]] || fail "cbc --version says $(use cbc --version)"
use cbc lint --strict "$examples"
for mission in "$root$examples"/*.mission.yaml; do
  catalog=$(basename -- "$mission" .mission.yaml)
  use cbc compile "$examples/$catalog.yaml" -o "$catalog.cbc"
  use cbc solve "$catalog.cbc" "$examples/$catalog.mission.yaml" | grep '^expectations: .* 0 failed$' ||
    fail "cbc solve $catalog.cbc"
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

say "a project in C++, with CMake and with pkg-config"
cmake -S "$source/tests/consumer" -B "$work/consumer" -D CMAKE_PREFIX_PATH="$root/usr" >"$work/consumer.log"
cmake --build "$work/consumer" >>"$work/consumer.log"
"$work/consumer/consumer" "$work/consumer/quadrotor.cbc" | tail -n +2 | diff "$source/tests/consumer/expected.txt" -
pkgconfig=$(dirname -- "$(find "$root/usr" -name cbc-catalog.pc)")
[[ $(PKG_CONFIG_PATH=$pkgconfig pkg-config --modversion cbc-catalog) == "$version" ]] || fail "pkg-config"

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
echo "check_package.sh: $(basename -- "$package"): all is well"
