#!/bin/sh
# check.sh PYTHON types|other|ros: runs the tests of the Python package.
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
exec "$python" -B -m pytest -q -p no:cacheprovider "$@"
