#!/bin/sh
# check.sh FOLDER PROGRAM: whether all that `cbc lsp` says in its tests has the types of the protocol, as the
# TypeScript library of VS Code has them; and whether the extension for VS Code can be packed. What that needs comes
# from npm, and goes to FOLDER.
#
# Exit status: 0 all is right, 1 not, 77 skipped: no Python or Node.js, or no way to the packages.
set -eu

source=$(cd -- "$(dirname -- "$0")" && pwd)
folder=$1
program=$2

python3 -c '' || exit 77
sh "$source/../../npm_install.sh" "$source" "$folder"

rm -f "$folder/said.json"
(cd "$source/.." && CBC_PROGRAM=$program CBC_LSP_RECORD=$folder/said.json python3 -B -m unittest -q test_server)
cp "$source/check_types.js" "$folder" # where it finds the packages
node "$folder/check_types.js" "$folder/said.json"

extension=$folder/extension
rm -rf "$extension"
sh "$source/../../npm_install.sh" "$source/../../../src/lsp/vscode" "$extension"
cp -R "$source/../../../src/lsp/vscode/." "$extension"
rm -f "$extension/installed" "$extension/npm.log"
# As docs/editors.md packs it. The packages that vsce needs are many more than all others.
(cd "$extension" && npx --yes @vscode/vsce@2 package --allow-missing-repository --out cbc.vsix)
python3 -B "$source/check_extension.py" "$extension/cbc.vsix"
