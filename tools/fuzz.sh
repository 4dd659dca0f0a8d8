#!/usr/bin/env bash
# Replays the kept corpus of each fuzzer, then fuzzes on from it.
#   fuzz.sh BUILD_DIR SECONDS
# No crash, no hang (25 s on one input), no allocation of more than 32 MB at once (inputs are at most 256 kB).  What is found new stays in
# BUILD_DIR/fuzz/NAME; an input that breaks a rule in BUILD_DIR/fuzz/NAME-broken-*, and the script leaves with 1.
set -euo pipefail
build=$1
seconds=$2
here=$(cd "$(dirname "$0")/.." && pwd)
mkdir -p "$build/fuzz"
failed=0
export LSAN_OPTIONS="suppressions=$here/tests/fuzz/leaks_of_libraries.txt:print_suppressions=0"
seed=${FUZZ_SEED:-$((RANDOM * 32768 + RANDOM + 1))}
echo "seed $seed (FUZZ_SEED=$seed repeats it)"
for name in campaign fields; do
  mkdir -p "$build/fuzz/$name"
  limits=(-timeout=25 -malloc_limit_mb=32 -rss_limit_mb=2048 -max_len=262144 -artifact_prefix="$build/fuzz/$name-broken-")
  [[ -f $here/tests/fuzz/$name.dictionary ]] && limits+=(-dict="$here/tests/fuzz/$name.dictionary")
  if [[ $name == campaign ]]; then
    for file in "$here"/cases/*/campaign.yaml; do cp "$file" "$build/fuzz/$name/$(basename "$(dirname "$file")").yaml"; done
  fi
  # HDF5 is not instrumented: without these whole files would not be kept as a beginning.
  [[ $name == fields ]] && limits+=(-keep_seed=1 -len_control=0)
  log=$build/fuzz/$name.log
  begin=$SECONDS
  files=("$here/tests/fuzz/corpus/$name"/*)
  if ! "$build/bin/fuzz_$name" "${limits[@]}" "${files[@]}" > "$log" 2>&1 \
    || ! "$build/bin/fuzz_$name" "${limits[@]}" -seed="$seed" -max_total_time="$seconds" -print_final_stats=1 "$build/fuzz/$name" \
      "$here/tests/fuzz/corpus/$name" >> "$log" 2>&1; then
    tail -n 60 "$log"
    echo "FAILED: fuzz_$name; its input: $build/fuzz/$name-broken-*"
    failed=1
    continue
  fi
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  echo "fuzz_$name: ${#files[@]} kept inputs replayed, $executions executions in $((SECONDS - begin)) s, no crash, no hang"
done
exit "$failed"
