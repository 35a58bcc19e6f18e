#!/usr/bin/env bash
# run.sh BUILD [TARGET [SECONDS]]: feeds TARGET, or all, changed inputs for SECONDS (default: 60), with the
# fuzzer in the folder BUILD, which keeps corpora and logs. Without TARGET lists the targets. Makes a finding
# as small as it can, and keeps it in regressions/TARGET, next to this script.
set -euo pipefail

folder=$(realpath -- "$(dirname -- "${BASH_SOURCE[0]}")")
build=$(realpath -- "$1")
wanted=${2:-}
seconds=${3:-60}
jobs=$(nproc)

# fuzzer TARGET [ARGUMENT…]: runs libFuzzer, whose entropic schedule would take most of the time, as
# an input reaches tens of thousands of edges.
fuzzer() {
  CBC_FUZZ_TARGET=$1 UBSAN_OPTIONS=print_stacktrace=1 \
    "$build/tests/cbc_fuzz" -entropic=0 -close_fd_mask=3 "${@:2}" 2>&1
}

# edges_of TARGET: how many edges of the program its corpus reaches.
edges_of() {
  fuzzer "$1" -runs=0 "$build/corpus/$1" | sed -n 's/.*INITED cov: \([0-9]*\) .*/\1/p'
}

# fuzz_target TARGET LONGEST SECONDS: false after findings.
fuzz_target() {
  local target=$1 longest=$2 seconds=$3
  local corpus=$build/corpus/$target findings=$build/findings/$target
  local log=$build/logs/$target kept=$folder/regressions/$target
  local before after executions finding name status=0
  rm -rf "$findings" "$log"
  mkdir -p "$corpus" "$findings" "$log"
  CBC_FUZZ_SEEDS=$corpus fuzzer "$target"
  if [[ -d $kept ]]; then cp "$kept"/* "$corpus"; fi
  before=$(edges_of "$target")
  # A process for each processor; they share the corpus. What is slow or takes much memory is a
  # finding, too.
  local limits=(-timeout=20 -rss_limit_mb=2048 -malloc_limit_mb=512 -max_len="$longest")
  (
    cd "$log"
    fuzzer "$target" "${limits[@]}" -jobs="$jobs" -workers="$jobs" -reload=5 -max_total_time="$seconds" \
      -print_final_stats=1 -dict="$folder/dictionary.txt" -artifact_prefix="$findings/" "$corpus" \
      >all.log || true
  )
  after=$(edges_of "$target")
  executions=$(awk '/^stat::number_of_executed_units/ { sum += $2 } END { print sum + 0 }' "$log"/fuzz-*.log)
  printf '%-10s %12d executions, edges: %6d at the start, %6d at the end\n' \
    "$target" "$executions" "$before" "$after"
  for finding in "$findings"/*; do
    [[ -e $finding ]] || continue
    status=1
    name=$(basename "$finding")
    mkdir -p "$kept"
    fuzzer "$target" "${limits[@]}" -minimize_crash=1 -max_total_time=60 \
      -exact_artifact_path="$kept/$name" "$finding" >"$log/minimize.log" || true
    [[ -e $kept/$name ]] || cp "$finding" "$kept/$name" # what is slow is not made smaller
    echo "finding: $kept/$name; $log says what it does"
  done
  return "$status"
}

# Reads its lines through a descriptor of its own: the fuzzer might read standard input.
status=0 is_known=
while read -r target longest what <&3; do
  if [[ ! $wanted ]]; then
    printf '%-10s %s\n' "$target" "$what"
  elif [[ $wanted == all || $wanted == "$target" ]]; then
    is_known=yes
    fuzz_target "$target" "$longest" "$seconds" || status=1
  fi
done 3< <("$build/tests/cbc_fuzz")
if [[ $wanted && ! $is_known ]]; then
  echo "./dev fuzz: unknown target: $wanted" >&2
  exit 2
fi
exit "$status"
