#!/bin/sh
# sources.sh FOLDER: puts the source of Debian's yaml-cpp into FOLDER/yaml-cpp, of the version of the installed
# libyaml-cpp-dev. Lists and downloads of apt stay in FOLDER; nothing of the system is changed.
set -eu
version=$(dpkg-query -W -f '${source:Version}' libyaml-cpp-dev)
mkdir -p "$1"
cd "$1"
folder=$PWD
[ ! -e yaml-cpp/version ] || [ "$(cat yaml-cpp/version)" != "$version" ] || exit 0
. /etc/os-release
mkdir -p apt/lists/partial apt/cache/archives/partial apt/download
echo "deb-src http://deb.debian.org/debian $VERSION_CODENAME main" > apt/sources.list
quiet_apt() {
  apt-get -qq -o Dir::Etc::SourceList="$folder/apt/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o Dir::State::Lists="$folder/apt/lists" -o Dir::Cache="$folder/apt/cache" -o APT::Sandbox::User="$(id -un)" "$@"
}
quiet_apt update
cd apt/download
quiet_apt source --download-only "yaml-cpp=$version"
rm -rf "$folder/yaml-cpp"
# apt has checked it by the signed lists.
dpkg-source --no-check -x yaml-cpp_*.dsc "$folder/yaml-cpp" > /dev/null
echo "$version" > "$folder/yaml-cpp/version"
