#!/bin/sh
# check.sh: tests that tests/tidy/tidy.py finds what clang-tidy finds, and where.
#
# Exit status: 0 all is well, 1 it is not, 77 skipped: a tool is missing.
set -u
here=$(CDPATH='' cd -- "$(dirname -- "$0")" && pwd)

for tool in clang++ clang-tidy python3; do
  command -v "$tool" >/dev/null || {
    echo "check.sh: skipped: there is no $tool (Debian packages clang, clang-tidy, python3)" >&2
    exit 77
  }
done

folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
cd "$folder" && mkdir src src/inner tests build || exit 1

cat >.clang-tidy <<'END'
Checks: -*,clang-analyzer-core.*,readability-duplicate-include,readability-identifier-naming
WarningsAsErrors: '*'
HeaderFilterRegex: '/src/'
CheckOptions: [{key: readability-identifier-naming.FunctionCase, value: lower_case}]
END
cat >tests/.clang-tidy <<'END'
InheritParentConfig: true
Checks: -clang-analyzer-core.*
CheckOptions: [{key: readability-identifier-naming.FunctionCase, value: CamelCase}]
END
cat >src/inner/shared.h <<'END'
#pragma once
inline int Shared(int number) { return number + 1; }
END
cat >src/inner/first.cpp <<'END'
#include "shared.h"
namespace {
int helper(int number) { return Shared(number); }
}
int first(int number) { return helper(number); }
END
# Includes what first.cpp includes, under another name, and nothing twice.
cat >src/second.cpp <<'END'
#include "inner/shared.h"
int second(const int* number) {
  if (number != nullptr) return Shared(*number);
  return *number;
}
END
# Its helper is that of first.cpp once more; a header is included twice.
cat >src/third.cpp <<'END'
#include "inner/shared.h"
#include <cstddef>
#include "inner/shared.h"
namespace {
int helper(int number) { return 2 * number; }
}
int Third(int number) { return helper(number); }
END
# Joins what is left over, and is right.
echo 'int fourth() { return 4; }' >src/fourth.cpp
# Has a configuration of its own.
cat >tests/fifth.cpp <<'END'
int fifth(const int* number) {
  if (number != nullptr) return 1;
  return *number;
}
END

{
  echo '['
  separator=
  for source in src/inner/first src/second src/third src/fourth tests/fifth; do
    echo "$separator{\"directory\": \"$folder/build\", \"file\": \"$folder/$source.cpp\","
    echo "\"command\": \"clang++ -std=c++20 -o $source.o -c $folder/$source.cpp\"}"
    separator=,
  done
  echo ']'
} >build/compile_commands.json

python3 -B "$here/tidy.py" build >output 2>errors
status=$?
grep -oE '^([0-9]+ sources in .*|/[^ ]*: [a-z]+:.*\[[a-z-]*[a-zA-Z.]*)' output |
  sed -E "s|^$folder/||; s|: error: .*\[|: |" | LC_ALL=C sort >found
cat >expected <<'END'
5 sources in 3 translation units
src/inner/shared.h:2:12: readability-identifier-naming
src/second.cpp:4:10: clang-analyzer-core.NullDereference
src/third.cpp:3:1: readability-duplicate-include
src/third.cpp:7:5: readability-identifier-naming
tests/fifth.cpp:1:5: readability-identifier-naming
END
if [ "$status" -ne 1 ] || [ -s errors ] || ! diff -u expected found; then
  echo "check.sh: exit status $status (1 expected); the output was:" >&2
  cat output errors >&2
  exit 1
fi

# Without findings.
echo 'Checks: -*,clang-analyzer-core.CallAndMessage,misc-static-assert' >.clang-tidy
python3 -B "$here/tidy.py" build >output 2>&1 || {
  echo "check.sh: exit status $? without findings; the output was:" >&2
  cat output >&2
  exit 1
}
