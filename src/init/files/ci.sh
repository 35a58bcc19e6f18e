#!/bin/sh
# Checks all files and runs the missions, for continuous integration and before commits:
#
#   sh ci.sh
#
# On GitHub, in .github/workflows/robot.yml (OWNER: where the repository of cbc is):
#
#   on: [push, pull_request]
#   jobs:
#     catalogs:
#       runs-on: ubuntu-latest
#       steps:
#       - uses: actions/checkout@v4
#       - uses: OWNER/cbc@v0.2.0    # puts cbc on the PATH, and checks all catalogs
#       - run: sh ci.sh
#
# On GitLab, in .gitlab-ci.yml, with an image that has cbc:
#
#   missions:
#     script: sh ci.sh
set -eu
cd -- "$(dirname -- "$0")"

format=text
if [ "${GITHUB_ACTIONS-}" = true ]; then
  format=github                    # failures become annotations at their lines
fi
# Nothing outside of this folder is read.
cbc lint --confine . --format "$format" .
cbc solve --confine . --format "$format" missions/
