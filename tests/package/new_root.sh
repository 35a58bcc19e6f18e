# For tests that need a Debian of their own: to be read by a script that has set `work`, a folder to write in. The root
# is in the folder root of it.
# shellcheck shell=bash

mkdir -p -- "$work"
work=$(realpath -- "$work")
root=$work/root
script=${0##*/}
source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../..")

say() { printf -- '-- %s\n' "$*"; }

# Exit status 77: there is nothing that could be tested here.
skip() {
  echo "$script: skipped: $*" >&2
  exit 77
}

fail() {
  echo "$script: FAILED: $*" >&2
  exit 1
}

can_have_root() {
  ((EUID == 0)) || skip "only root can make a new root"
  command -v mmdebstrap >/dev/null || skip "there is no mmdebstrap"
}

# make_root SUITE [ARG…]: a new root, which has nothing but apt and what apt needs; ARG… goes to mmdebstrap.
make_root() {
  say "a new root: $*"
  rm -rf --one-file-system -- "$root"
  mmdebstrap --variant=apt --skip=cleanup/apt/lists "${@:2}" "$1" "$root" >"$work/root.log" 2>&1 ||
    skip "mmdebstrap failed: $(grep -m 3 '^[EW]' "$work/root.log" || cat "$work/root.log")"
  # A proxy on the way to npm's packages may have a certificate that only this machine knows.
  [[ ! -e /etc/ssl/certs/ca-certificates.crt ]] || cp /etc/ssl/certs/ca-certificates.crt "$root/root/certificates.crt"
}

remove_root() { rm -rf --one-file-system -- "$root"; }

# The suite of this Debian.
own_suite() { (. /etc/os-release && echo "${VERSION_CODENAME:-}"); }

# In the new root, as its administrator.
inside() {
  chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"
}

# In the new root, as somebody without any rights, in a folder to write in.
use() {
  mkdir -p -m 777 "$root/tmp/use"
  chroot --userspec=65534:65534 "$root" env -i -C /tmp/use PATH=/usr/bin:/bin LC_ALL=C.UTF-8 "$@"
}

# Puts the sources of this project, as they are now, into /root/cbc of the new root. Tests want a repository of git.
copy_sources() {
  mkdir -p -- "$root/root/cbc"
  git -C "$source" ls-files -z --cached --others --exclude-standard |
    (cd -- "$source" && xargs -0 -r sh -c 'for file; do [ ! -e "$file" ] || printf "%s\0" "$file"; done' sh) |
    tar -C "$source" --null -T - -cf - | tar -C "$root/root/cbc" --no-same-owner -xf -
  git -C "$root/root/cbc" init --quiet
  git -C "$root/root/cbc" add --all
  git -C "$root/root/cbc" -c user.name=test -c user.email=test@example.org commit --quiet -m "Under test"
}

# at_sources COMMAND…: as `inside`, in the folder of the sources, and with devices and processes, which builds and
# browsers need. The mounts are gone when the command has ended.
at_sources() {
  unshare --mount --propagation private sh -euc '
    root=$1
    shift
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount --rbind /sys "$root/sys"
    exec chroot "$root" env -i -C /root/cbc PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 \
      NODE_EXTRA_CA_CERTS=/root/certificates.crt "$@"' \
    sh "$root" "$@"
}
