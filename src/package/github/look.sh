#!/usr/bin/env bash
# Writes the output `found` of the step: whether there is a cbc on the PATH that checks catalogs. COIN-OR's
# solver has the same name.
set -euo pipefail

found=false
if [[ $(cbc schema lint 2>/dev/null </dev/null) == *'"cbc.lint/'* ]]; then
  found=true
fi
echo "found=$found" >>"$GITHUB_OUTPUT"
