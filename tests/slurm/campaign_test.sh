#!/usr/bin/env bash
# A tiny campaign on a real Slurm of one node: in an allocation, as one job a stage, and as a chain of jobs; all must end the
# same, whatever happens to orchestrator and jobs on the way.
#   campaign_test.sh CUPOLA SOURCE_DIR WORK_DIR
. "$(dirname "$(realpath "$0")")/begin.sh"

# campaign FILE LAUNCH: the tiny campaign, its stages long enough to be caught at work.
campaign() {
  sed -e "s/^launch:.*/launch: {slurm: {ranks: 2, $2}}/" -e 's/^tracer:.*/tracer: {duration: 0.3 h, accuracy: 5 %}/' \
    -e 's/^dem:.*/dem: {relaxation: 0.2 s, window: 6.0 s, stop: {at_most: 6.2 s}}/' "$source/cases/tiny/campaign.yaml" > "$1"
}

# same_end RUN [KEYS]: as the run in the allocation, to the last bit, whatever is said of these keys.
same_end() {
  node "$here/../workflow/compare_reports.mjs" "$work/allocation/report/report.json" "$1/report/report.json" 0 "${2:-}" \
    || fail "$1 ended otherwise"
}

campaign "$work/campaign.yaml" "time: 60 min, partition: batch"
campaign "$work/srun.yaml" "time: 60 min, starter: srun"
campaign "$work/nowhere.yaml" "time: 60 min, partition: nowhere"

echo "-- refused by Slurm: says why and which key"
[[ $(status_of "$cupola" run "$work/nowhere.yaml" --run-dir "$work/nowhere") == 65 ]] || fail "an unknown partition was taken"
grep -q "invalid partition specified: nowhere" "$work/out" || fail "sbatch's sentence is missing"

echo "-- inside an allocation"
expected=$(status_of salloc --quiet --ntasks=2 --time=60 "$cupola" run "$work/campaign.yaml" --run-dir "$work/allocation")
[[ $expected == 75 || $expected == 0 ]] || fail "the campaign in an allocation ended with $expected"
[[ $(events "$work/allocation" job-submitted) == 0 ]] || fail "a job was submitted from inside an allocation"

echo "-- one job a stage; the orchestrator is killed, its job goes on and is found again"
run=$work/jobs
"$cupola" run "$work/campaign.yaml" --run-dir "$run" >> "$work/out" 2>&1 &
orchestrator=$!
wait_for 600 works_in "$run" 001 dem || fail "the first job does not begin"
"$cupola" status "$run" >> "$work/out" || fail "status beside a job"
kill -KILL "$orchestrator"
wait "$orchestrator" 2> /dev/null
job_running "$(job_of "$run")" || fail "the job ended with its orchestrator"
"$cupola" resume "$run" >> "$work/out" 2>&1 &
orchestrator=$!
wait_for 600 works_in "$run" 001 dem 5 || fail "the first job does not go on"

echo "-- the signal before the time limit: checkpoint, and the next job goes on"
scancel --batch --signal=USR1 "$(job_of "$run")"
wait_for 600 eval '[[ $(events "$run" job-submitted "\"stage\":\"dem\"") == 2 ]]' || fail "no second job after the first was cut off"
[[ $(events "$run" job-ended '"status":75') == 1 ]] || fail "the job that was cut off did not end with 75"

echo "-- preempted by a job that is more urgent: put back by Slurm, and goes on"
wait_for 600 works_in "$run" 002 dem || fail "the second DEM stage does not begin"
preempted=$(job_of "$run")
sbatch --quiet --partition=urgent --ntasks=2 --time=1 --output=/dev/null --wrap "sleep 1"
wait "$orchestrator"
status=$?
orchestrator=
[[ $status == "$expected" ]] || fail "as jobs it ended with $status, in an allocation with $expected"
[[ $(events "$run" job-ended "\"job\":\"$preempted\"" '"restarts":1') == 1 ]] || fail "job $preempted was not put back"
same_end "$run"

echo "-- the whole campaign as a chain, no orchestrator left, ranks by srun; a link is cut off and goes back into the queue"
run=$work/chain
[[ $(status_of "$cupola" run "$work/srun.yaml" --run-dir "$run" --submit) == 0 ]] || fail "the chain was not submitted"
[[ $(events "$run" chain-submitted) == 1 ]] || fail "the journal does not know of the chain"
[[ $(status_of "$cupola" resume "$run") == 73 ]] || fail "an orchestrator was let in beside the chain"
wait_for 600 works_in "$run" 001 dem || fail "the first link does not begin"
link=$(squeue --noheader --states=RUNNING --format=%A)
scancel --batch --signal=USR1 "$link"
wait_for 900 eval '[[ $(events "$run" campaign-ended) == 1 && -z $(squeue --noheader) ]]' || fail "the chain does not come to its end"
[[ $(events "$run" stage-stopped) == 1 ]] || fail "the link that was cut off did not stop its stage"
[[ $(scontrol --oneliner show job "$link") == *Restarts=1* ]] || fail "link $link was not put back"
same_end "$run" campaign_hash,mesh_hash,campaign_text
[[ $(status_of "$cupola" resume "$run") == "$expected" ]] || fail "resume after the chain"
echo "all three ended the same"
