#!/usr/bin/env bash
# Sets the output `found` of the step: whether the cbc on the PATH is this program. COIN-OR's solver has
# the same name.
set -euo pipefail

found=false
if [[ $(cbc schema lint 2>/dev/null </dev/null) == *'"cbc.lint/'* ]]; then
  found=true
fi
echo "found=$found" >>"$GITHUB_OUTPUT"
