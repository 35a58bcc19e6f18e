#!/usr/bin/env bash
# check_hardening.sh PROGRAM|PACKAGE…: checks that each program, be it that of a Debian package, is position-independent,
# cannot change its tables of functions once it is loaded, has no executable stack, and, where it names functions of
# libraries, was compiled with checks of the stack and of the sizes of buffers.
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

fail() {
  echo "check_hardening.sh: FAILED: $*" >&2
  exit 1
}

# expect PROGRAM WHAT PATTERN OPTIONS…: what readelf prints has a line with a pattern
expect() {
  LC_ALL=C readelf -W "${@:4}" "$1" | grep -E "$3" >/dev/null || fail "$1: $2"
}

for program in "$@"; do
  if [[ $program == *.deb ]]; then
    dpkg-deb -x "$program" "$work"
    program=$work/usr/bin/cbc
  fi
  expect "$program" "position-independent" 'Type: +DYN \(Position-Independent Executable' --file-header
  expect "$program" "relocations are read-only" '^ +GNU_RELRO ' --program-headers
  expect "$program" "functions are bound at the start" 'FLAGS_1.* NOW' --dynamic
  expect "$program" "stack without code" '^ +GNU_STACK .* RW +0x' --program-headers
  if LC_ALL=C readelf -W --program-headers "$program" | grep -E '^ +INTERP ' >/dev/null; then # not static
    expect "$program" "stack protector" ' __stack_chk_fail@' --dyn-syms
    expect "$program" "fortified functions" ' __(memcpy|snprintf|fprintf|read)_chk@' --dyn-syms
  fi
  if LC_ALL=C readelf -W --program-headers "$program" | grep -E '^ +[A-Z_]+ .* (RWE|WE)'; then
    fail "$program: memory that is writable and executable"
  fi
  if LC_ALL=C readelf -W --dynamic "$program" | grep -E 'RPATH|RUNPATH|TEXTREL'; then
    fail "$program: looks for libraries elsewhere, or changes its code"
  fi
done
echo "check_hardening.sh: all is well"
