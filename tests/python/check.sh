#!/bin/sh
# check.sh PYTHON types|other|ros|sanitized: runs the tests of the Python package.
python=$1
part=$2
if ! "$python" -c 'import pytest' 2>/dev/null; then
  echo "python: skipped: there is no pytest"
  exit 77
fi
if [ "$part" = ros ] && ! { "$python" -c 'import diagnostic_msgs.msg, rospy' && roscore --help; } >/dev/null 2>&1; then
  echo "python_ros: skipped: there is no ROS"
  exit 77
fi
cd "$(dirname -- "$0")" || exit 2
case $part in
  types) set -- test_types.py ;;
  ros) set -- test_ros.py ;;
  other) set -- --ignore test_types.py --ignore test_ros.py . ;;
esac
if [ "$part" = sanitized ]; then
  # Random calls, with the module built by clang with -fsanitize=address. The interpreter leaks at its end;
  # what counts is what the module has allocated.
  runtime=$(clang++ -print-file-name=libclang_rt.asan-x86_64.so)
  leaks=$(mktemp) || exit 2
  trap 'rm -f "$leaks"*' EXIT
  CBC_PYTHON_CALLS=100000 LD_PRELOAD=$runtime ASAN_OPTIONS=detect_leaks=1:log_path=$leaks LSAN_OPTIONS=exitcode=0 \
    "$python" -B -m pytest -q -p no:cacheprovider test_random_calls.py
  status=$?
  [ "$status" = 0 ] || cat "$leaks".* 2>/dev/null
  if grep -q -e 'cbc::' -e _native "$leaks".*; then
    cat "$leaks".*
    exit 1
  fi
  grep -q 'SUMMARY: AddressSanitizer' "$leaks".* || { echo "nothing has looked for leaks" && exit 1; }
  exit "$status"
fi
exec "$python" -B -m pytest -q -p no:cacheprovider "$@"
