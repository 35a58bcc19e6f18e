#!/bin/sh
# check.sh SHELL PROGRAM FOLDER: completes command lines of PROGRAM in a real shell, in a new FOLDER
# with a catalog whose names are traps. What is offered must be what expected.txt has (list.SHELL
# asks for it), and what a person gets who presses the tab key must be what typing.py says, also with
# the script installed as 'cbc completion --help' has it.
#
# Exit status: 0 all is well, 1 it is not, 77 skipped: a tool is missing.
set -eu

shell=$1
program=$2
folder=$3
here=$(cd -- "$(dirname -- "$0")" && pwd)
for tool in "$shell" python3; do
  command -v "$tool" >/dev/null || {
    echo "check.sh: skipped: there is no $tool" >&2
    exit 77
  }
done

python3 -c 'import os; os.openpty()' 2>/dev/null || {
  echo "check.sh: skipped: there is no terminal: is /dev/pts mounted?" >&2
  exit 77
}

rm -rf -- "$folder"
mkdir -p -- "$folder/bin" "$folder/home"
ln -s -- "$program" "$folder/bin/cbc"
cp -R -- "$here/files" "$folder/files"
cp -- "$here/files/robot.yaml" "$folder/files/my dir/"
# Names that not every checkout could hold.
mkdir -- "$folder/files/dash"
cp -- "$here/files/arm@2.yaml" "$folder/files/x:y=z.yaml"
cp -- "$here/files/arm@2.yaml" "$folder/files/dash/-dash.yaml"
cp -- "$here/files/arm@2.yaml" "$folder/files/dash/robot.yaml"
export PATH="$folder/bin:$PATH" HOME="$folder/home" LC_ALL=C.UTF-8 TERM=dumb
unset XDG_CONFIG_HOME XDG_DATA_HOME ZDOTDIR BASH_ENV ENV
cbc completion "$shell" >"$folder/_cbc"
cd -- "$folder/files"

sed -n 's/^\$ //p' "$here/expected.txt" | while IFS= read -r line; do
  printf '$ %s\n' "$line"
  "$shell" "$here/list.$shell" "$folder/_cbc" "$line" | LC_ALL=C sort
done >"$folder/offered.txt"
diff -u -- "$here/expected.txt" "$folder/offered.txt"
python3 -B "$here/typing.py" "$shell" "$folder"

# Under another name its script completes that name.
ln -s -- "$program" "$folder/bin/other-name"
other-name completion "$shell" >"$folder/_other-name"
offered=$("$shell" "$here/list.$shell" "$folder/_other-name" 'other-name lint --expl')
if [ "$offered" != --explain ]; then
  echo "check.sh: for other-name, $shell offers: $offered" >&2
  exit 1
fi

if [ -e pwned ]; then
  echo "check.sh: a name was executed" >&2
  exit 1
fi
