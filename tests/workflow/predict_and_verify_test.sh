#!/usr/bin/env bash
# A tiny campaign that predicts and verifies: left alone, and killed and resumed inside its stages; both must end the same.
#   predict_and_verify_test.sh CUPOLA SOURCE_DIR WORK_DIR
set -uo pipefail
cupola=$1
source=$2
work=$3
rm -rf "$work"
mkdir -p "$work"
{
  sed -e 's/^converged:.*/converged: {at_most: 2 episodes}/' -e 's/^launch:.*/launch: {ranks: 1}/' "$source/cases/tiny/campaign.yaml"
  echo 'strategy: predict-and-verify'
  echo 'predict_and_verify: {windows: 4}'
} > "$work/campaign.yaml"
run=$work/disturbed

. "$(dirname "$0")/../support/looks.sh"

# number KEY...: what report.json of the run left alone says, `null` where it says nothing.
number() { node -e 'let v = JSON.parse(require("fs").readFileSync(process.argv[1])); for (const k of process.argv.slice(2)) v = v?.[k]; console.log(v ?? null)' "$work/alone/report/report.json" "$@"; }

echo "-- left alone"
expected=$(status_of "$cupola" run "$work/campaign.yaml" --run-dir "$work/alone")
[[ $expected == 75 || $expected == 0 ]] || fail "the undisturbed campaign ended with $expected"
for stage in prediction episodes/001/{dem,predict,tracer,correct}/attempt-1 episodes/002/{dem,predict,tracer,correct}/attempt-1; do
  [[ -f $work/alone/$stage/manifest.json ]] || fail "$stage has not ended"
done
[[ $(status_of "$cupola" status "$work/alone") == 0 ]] || fail "status of a finished run"
[[ $(status_of "$cupola" verify "$work/alone") == 0 ]] || fail "verify of a finished run"
[[ $(number predict_and_verify dem_stages) == 2 ]] || fail "the report does not know two DEM stages"
[[ $(number predict_and_verify steps length) == 9 ]] || fail "the report does not list nine steps"
[[ $(number predict_and_verify remaining_error estimate) != null ]] || fail "no estimate of the remaining error"

echo "-- killed in each kind of stage, and resumed"
begin() {
  touch "$work/begun"
  "$cupola" "$@" >> "$work/out" 2>&1 &
  orchestrator=$!
}
# killed_in STAGE FOLDER: the orchestrator and its stage are killed once the stage has been started.
killed_in() {
  local until=$((SECONDS + 120))
  until grep -q "\"event\":\"stage-started\".*\"stage\":\"$1\"" "$run/journal.jsonl" 2> /dev/null; do
    kill -0 "$orchestrator" 2> /dev/null || fail "ended before its $1 stage"
    [[ $SECONDS -lt $until ]] || fail "no $1 stage"
    sleep 0.02
  done
  local mpirun
  mpirun=$(stage_process)
  kill -KILL "$orchestrator" "$mpirun" $(pgrep -P "$mpirun") 2> /dev/null
  wait "$orchestrator" 2> /dev/null
}
begin run "$work/campaign.yaml" --run-dir "$run"
killed_in predict
begin resume "$run"
killed_in tracer
begin resume "$run"
killed_in correct
status=$(status_of "$cupola" resume "$run")
[[ $status == "$expected" ]] || fail "ended with $status, left alone with $expected"
node "$(dirname "$0")/compare_reports.mjs" "$work/alone/report/report.json" "$run/report/report.json" || fail "the ends differ"
echo "the disturbed campaign ended as the one left alone"
