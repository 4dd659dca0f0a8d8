#!/usr/bin/env bash
# Exit statuses and messages of `cupola` on right and wrong input: command_line_test.sh CUPOLA SOURCE_DIR
set -uo pipefail
cupola=$1
source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# expect STATUS TEXT COMMAND...: the command's exit status, and a text in what it says.
expect() {
  local status=$1 text=$2 said code
  shift 2
  said=$("$@" 2>&1)
  code=$?
  if [[ $code -ne $status || $said != *"$text"* ]]; then
    printf 'FAILED %s\n  status %s, expected %s; expected to say: %s\n  said: %s\n' "$*" "$code" "$status" "$text" "$said"
    failures=$((failures + 1))
  fi
}

tiny=$source/cases/tiny/campaign.yaml
expect 0 "cupola 0." "$cupola" --version
expect 65 "say what to do" "$cupola"
expect 65 "did you mean \`validate\`" "$cupola" valdate
for campaign in tiny slot_quick slot_paper; do
  expect 0 "is valid" "$cupola" validate "$source/cases/$campaign/campaign.yaml"
done
expect 0 '"ok": true' "$cupola" validate "$tiny" --json

expect 74 "nowhere.yaml" "$cupola" validate "$work/nowhere.yaml"
sed 's/descent_rate: 2 mm\/s/descent_rat: 2 mm\/s/; s/duration: 0.5 h/duration: 5 m/' "$tiny" > "$work/wrong.yaml"
expect 65 "descent_rate" "$cupola" validate "$work/wrong.yaml"
expect 65 "tracer.duration" "$cupola" validate "$work/wrong.yaml"
expect 65 "$work/wrong.yaml:" "$cupola" validate "$work/wrong.yaml"
expect 65 '"ok": false' "$cupola" validate "$work/wrong.yaml" --json
expect 65 "tracer.duration" "$cupola" run "$work/wrong.yaml" --run-dir "$work/run"
# What the plan refuses is refused by both, and explained all the same.
sed -e 's/size: \[0.13 m, 0.13 m\]/size: [0.03 m, 0.03 m]/' "$tiny" > "$work/choked.yaml"
expect 65 "tuyere-left" "$cupola" run "$work/choked.yaml" --run-dir "$work/run"
expect 65 "This cannot be run" "$cupola" explain "$work/choked.yaml"
expect 65 '"refusals"' "$cupola" explain "$work/choked.yaml" --json
# A chain of jobs needs a cluster.
expect 65 "--submit needs to know the cluster" "$cupola" run "$tiny" --run-dir "$work/chain" --submit
[[ ! -e $work/run ]] || { echo "FAILED: a wrong campaign made a run folder"; failures=$((failures + 1)); }
: > "$work/empty.yaml"
expect 65 "" "$cupola" validate "$work/empty.yaml"
head -c 200 /dev/urandom > "$work/noise.yaml"
expect 65 "" "$cupola" validate "$work/noise.yaml"

expect 65 "not a run folder" "$cupola" resume "$work"
expect 65 "not a run folder" "$cupola" status "$work/nowhere"
expect 0 "cupola validate" "$cupola" init "$work/new furnace"
expect 0 "is valid" "$cupola" validate "$work/new furnace/campaign.yaml"
expect 65 "is there already" "$cupola" init "$work/new furnace"
mkdir "$work/thesis" && echo x > "$work/thesis/chapter.tex"
expect 65 "not a run" "$cupola" run "$tiny" --run-dir "$work/thesis"

[[ $failures -eq 0 ]] && echo "all as expected"
exit "$failures"
