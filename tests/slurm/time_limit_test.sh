#!/usr/bin/env bash
# A stage that is longer than its job on a real Slurm: the time limit ends the job with a checkpoint and the next job goes on;
# a node that fails puts the job back into the queue.
#   time_limit_test.sh CUPOLA SOURCE_DIR WORK_DIR
. "$(dirname "$(realpath "$0")")/begin.sh"

sed -e 's/^launch:.*/launch: {slurm: {ranks: 2, time: 90 s, checkpoint_before: 45 s}}/' \
  -e 's/^dem:.*/dem: {relaxation: 1 s, window: 999 s, stop: {at_most: 1000 s}}/' "$source/cases/tiny/campaign.yaml" > "$work/campaign.yaml"
run=$work/run
step() { grep -o '"step": *[0-9]*' "$run/episodes/001/dem/attempt-1/progress.json" | grep -o '[0-9]*$'; }
further_than() { [[ $(step) -gt $1 ]]; }

echo "-- the time limit"
"$cupola" run "$work/campaign.yaml" --run-dir "$run" >> "$work/out" 2>&1 &
orchestrator=$!
wait_for 3000 eval '[[ $(events "$run" job-submitted) == 2 ]]' || fail "no second job after the first one's time was up"
[[ $(events "$run" job-ended '"status":75') == 1 ]] || fail "the first job did not end with a checkpoint"
reached=$(step)
wait_for 300 further_than "$reached" || fail "the second job does not go on"
second=$(job_of "$run")

echo "-- the node fails and comes back"
node=$(hostname -s)
scontrol update "NodeName=$node" State=DOWN Reason=test
wait_for 30 eval '! job_running "$second"' || fail "the job still runs on a node that is down"
scontrol update "NodeName=$node" State=RESUME
wait_for 300 job_running "$second" || fail "the job was not put back"
reached=$(step)
wait_for 300 further_than "$reached" || fail "the job that was put back does not go on"

echo "-- a request to stop reaches the job"
kill -TERM "$orchestrator"
wait "$orchestrator"
status=$?
orchestrator=
[[ $status == 75 ]] || fail "SIGTERM: left with $status"
[[ -z $(squeue --noheader) ]] || fail "the job is still there"
compgen -G "$run/episodes/001/dem/attempt-1/checkpoint-*.h5" > /dev/null || fail "no checkpoint"
echo "checkpoints before the limit, after a node failure and on request"
