#!/usr/bin/env bash
# A tiny campaign through the real stages: left alone, and stopped, killed and resumed at every place; both must end the same.
#   campaign_test.sh CUPOLA SOURCE_DIR WORK_DIR RANKS
set -uo pipefail
cupola=$1
source=$2
work=$3
ranks=$4
rm -rf "$work"
mkdir -p "$work"
# Stages long enough to be caught at work.
sed -e "s/^launch:.*/launch: {ranks: $ranks}/" -e 's/^dem:.*/dem: {relaxation: 0.4 s, window: 1.6 s, stop: {at_most: 2 s}}/' \
  -e 's/^tracer:.*/tracer: {duration: 1 h, accuracy: 5 %}/' "$source/cases/tiny/campaign.yaml" > "$work/campaign.yaml"
run=$work/disturbed

. "$(dirname "$0")/../support/looks.sh"

# begin: goes on with the disturbed run in the background.
begin() {
  touch "$work/begun"
  "$cupola" resume "$run" >> "$work/out" 2>&1 &
  orchestrator=$!
}

# in_stage EPISODE STAGE: its program has written to its history since `begin`.
in_stage() {
  local history=$run/episodes/$1/$2/attempt-1/history.jsonl
  [[ -s $history && $history -nt $work/begun ]]
}

# events WHAT...: how many lines of the journal hold all of these.
events() {
  local lines
  lines=$(cat "$run/journal.jsonl")
  for what in "$@"; do lines=$(grep -- "$what" <<< "$lines"); done
  grep -c . <<< "$lines"
}

echo "-- left alone"
expected=$(status_of "$cupola" run "$work/campaign.yaml" --run-dir "$work/alone")
[[ $expected == 75 || $expected == 0 ]] || fail "the undisturbed campaign ended with $expected"
[[ $(status_of "$cupola" status "$work/alone") == 0 ]] || fail "status of a finished run"

echo "-- SIGKILL of the orchestrator inside the first DEM stage; the stage runs on and is found"
touch "$work/begun"
"$cupola" run "$work/campaign.yaml" --run-dir "$run" >> "$work/out" 2>&1 &
orchestrator=$!
wait_for 120 in_stage 001 dem || fail "the first DEM stage does not begin"
[[ $(status_of "$cupola" resume "$run") == 73 ]] || fail "a second orchestrator was let in"
kill -KILL "$orchestrator"
wait "$orchestrator" 2> /dev/null
kill -0 "$(stage_process)" || fail "the stage died with its orchestrator"
[[ $(status_of "$cupola" resume "$run" --until-episode 1) == 75 ]] || fail "resume beside an orphan"
[[ $(events orphan-found) -ge 1 ]] || fail "the orphan was not found"
[[ $(events stage-started '"stage":"dem"') == 1 ]] || fail "a second DEM stage was started beside the orphan"

echo "-- a line of the journal changed, then put back"
cp "$run/journal.jsonl" "$work/journal.jsonl"
sed -i '1s/tiny/tany/' "$run/journal.jsonl"
[[ $(status_of "$cupola" resume "$run") == 65 ]] || fail "a changed journal was accepted"
cp "$work/journal.jsonl" "$run/journal.jsonl"

echo "-- a result truncated, then put back"
result=$run/episodes/001/dem/attempt-1/result.hdf
cp "$result" "$work/result.hdf"
truncate -s -100 "$result"
[[ $(status_of "$cupola" resume "$run") == 74 ]] || fail "a truncated result was accepted"
cp "$work/result.hdf" "$result"

echo "-- SIGTERM inside the second DEM stage, then Ctrl-C twice"
for signals in TERM "INT INT"; do
  begin
  wait_for 120 in_stage 002 dem || fail "the second DEM stage does not begin"
  for signal in $signals; do
    kill "-$signal" "$orchestrator"
    sleep 0.1
  done
  wait "$orchestrator"
  status=$?
  [[ $status == 75 ]] || fail "$signals: left with $status"
done

echo "-- a rank that cannot answer: the stage is killed once --stop-within is over"
touch "$work/begun"
"$cupola" resume "$run" --stop-within 2 >> "$work/out" 2>&1 &
orchestrator=$!
wait_for 120 in_stage 002 dem || fail "the second DEM stage does not go on"
mpirun=$(stage_process)
rank=$(pgrep -P "$mpirun" | head -n 1)
kill -STOP "$rank"
kill -TERM "$orchestrator"
wait_for 60 sh -c "! kill -0 $orchestrator 2> /dev/null" || fail "--stop-within 2 does not end a stage that hangs"
wait "$orchestrator"
status=$?
[[ $status == 75 ]] || fail "a stage that hangs: left with $status"
grep -q "is killed, and goes on from its last checkpoint" "$work/out" || fail "the kill of a stage that hangs is not told"
wait_for 10 sh -c "! kill -0 $rank 2> /dev/null" || fail "a rank outlives its stage"

echo "-- SIGKILL of mpirun, of its ranks and of the orchestrator inside the second DEM stage"
begin
wait_for 120 in_stage 002 dem || fail "the second DEM stage does not go on"
mpirun=$(stage_process)
kill -KILL "$orchestrator" "$mpirun" $(pgrep -P "$mpirun") 2> /dev/null
wait "$orchestrator" 2> /dev/null

echo "-- SIGKILL of one rank of the second tracer stage: the orchestrator starts it again; then SIGUSR1 to the stage itself"
begin
wait_for 240 in_stage 002 tracer || fail "the second tracer stage does not begin"
kill -KILL "$(pgrep -P "$(stage_process)" | head -n 1)"
wait_for 60 grep -q stage-died "$run/journal.jsonl" || fail "the death of a rank was not seen"
touch "$work/begun"
wait_for 120 in_stage 002 tracer || fail "the second tracer stage was not started again"
kill -USR1 "$(stage_process)"
wait "$orchestrator"
status=$?
[[ $status == 75 ]] || fail "SIGUSR1 to a stage: left with $status"

echo "-- to the end"
status=$(status_of "$cupola" resume "$run")
[[ $status == "$expected" ]] || fail "ended with $status, left alone with $expected"
node "$(dirname "$0")/compare_reports.mjs" "$work/alone/report/report.json" "$run/report/report.json" || fail "the ends differ"
[[ $(status_of "$cupola" resume "$run") == "$expected" ]] || fail "resume of a finished run"
echo "the disturbed campaign ended as the one left alone"
