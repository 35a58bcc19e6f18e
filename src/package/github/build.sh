#!/usr/bin/env bash
# Builds cbc on a Debian or Ubuntu runner, and puts it on the PATH of the following steps.
set -euo pipefail

source=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")/../../..")
sudo apt-get -qq update
sudo apt-get -qq install -y --no-install-recommends \
  cmake flatbuffers-compiler flatbuffers-compiler-dev g++ ninja-build libboost-dev libcli11-dev \
  libflatbuffers-dev libfmt-dev libxxhash-dev libyaml-cpp-dev nlohmann-json3-dev
cmake -S "$source" -B "$RUNNER_TEMP/cbc" -G Ninja \
  -D CBC_BUILD_BENCHMARKS=OFF -D CBC_BUILD_TESTS=OFF
cmake --build "$RUNNER_TEMP/cbc" --target cbc
echo "$RUNNER_TEMP/cbc" >>"$GITHUB_PATH"
