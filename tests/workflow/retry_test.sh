#!/usr/bin/env bash
# A DEM stage that diverges, once and for good: the retry with the advice, the report of it, the end with 70.
# The real programs run; the divergence itself is put in front of cupola-dem.
#   retry_test.sh CUPOLA SOURCE_DIR WORK_DIR
set -uo pipefail
programs=$(dirname "$1")
source=$2
work=$3
rm -rf "$work"
mkdir -p "$work/bin"
run=$work/run

fail() {
  echo "FAILED: $*"
  cat "$work/out"
  exit 1
}

# diverges_in PATTERN: cupola-dem says 70 in the task folders that fit.
diverges_in() {
  cat > "$work/bin/cupola-dem" << END
#!/bin/sh
case "\$*" in
prepare* | --versions) ;;
$1)
  echo '{"code": 70, "sentence": "overlap too large", "where": {"step": "12"}, "advice": {"dem.time_step": "1e-4", "contacts.youngs_modulus": "1e+07 Pa"}}' > "\$1/failure.json"
  exit 70 ;;
esac
exec $programs/cupola-dem "\$@"
END
  chmod +x "$work/bin/cupola-dem"
}

# The programs are found beside cupola itself.
cp "$programs/cupola" "$work/bin/"
ln -s "$programs/cupola-tracer" "$work/bin/cupola-tracer"
sed 's/^launch:.*/launch: {ranks: 1}/' "$source/cases/tiny/campaign.yaml" > "$work/campaign.yaml"

diverges_in '*001/dem/attempt-[12]'
"$work/bin/cupola" run "$work/campaign.yaml" --run-dir "$run" > "$work/out" 2>&1
[[ $? == 70 ]] || fail "a stage that diverges twice must end with 70"
grep -q 'try dem.time_step: 1e-4' "$work/out" || fail "the advice is not said"
grep -q 'time_step: 0.0001' "$run/episodes/001/dem/attempt-2/task.yaml" || fail "the advice was not taken"
grep -q '"state": "failed"' <("$work/bin/cupola" status "$run" --json) || fail "status does not say so"
[[ -f $run/report/index.html ]] || fail "no report of the failure"
# What happened, where and all that can be tried: at the end of `run`, in `status`, in the report and on its page.
grep -q 'try contacts.youngs_modulus: 1e+07 Pa' "$work/out" || fail "not all of the advice is said"
if grep -q 'youngs_modulus' <(grep '"event":"advice-taken"' "$run/journal.jsonl"); then fail "the bed was changed unasked"; fi
told='overlap too large (step 12). Try contacts.youngs_modulus: 1e+07 Pa or dem.time_step: 1e-4.'
"$work/bin/cupola" status "$run" --json > "$work/status"
node -e '
  const [statusFile, run, told] = process.argv.slice(1);
  const text = (file) => require("fs").readFileSync(file, "utf8");
  const report = JSON.parse(text(`${run}/report/report.json`));
  const places = [JSON.parse(text(statusFile)).message, report.description, report.answers.converged.detail,
    report.warnings.join(), report.results[0].sentence, text(`${run}/report/index.html`)];
  const without = places.findIndex((place) => !place.includes(told));
  if (without >= 0) throw new Error(`place ${without} does not say what happened, where and what to try: ${places[without].slice(0, 300)}`);
' "$work/status" "$run" "$told" || fail "the report of the failure is not whole"

diverges_in '*001/dem/attempt-3'
"$work/bin/cupola" resume "$run" --until-episode 1 > "$work/out" 2>&1
[[ $? == 70 ]] || fail "one attempt more at each resume"

diverges_in 'never'
"$work/bin/cupola" resume "$run" --until-episode 1 > "$work/out" 2>&1
[[ $? == 75 ]] || fail "the attempt after it works must go on"
grep -q 'tried again with dem.time_step = 1e-4' "$run/report/report.json" || fail "the report does not mention the retry"
grep -q 'time_step: 0.0001' "$run/episodes/001/dem/attempt-4/task.yaml" || fail "the change was not kept"
# A stage that diverges in its middle goes on from its last good checkpoint.
cat > "$work/bin/cupola-dem" << END
#!/bin/sh
case "\$*" in
prepare* | --versions) ;;
*001/dem/attempt-1)
  CUPOLA_CHECKPOINT_SECONDS=0 $programs/cupola-dem "\$1" &
  until [ -f "\$1/checkpoint-B.hash" ]; do sleep 0.05; done
  kill -KILL \$!
  wait
  echo '{"code": 70, "sentence": "overlap too large", "where": {"step": "12"}, "advice": {"dem.time_step": "1e-4"}}' > "\$1/failure.json"
  exit 70 ;;
esac
exec $programs/cupola-dem "\$@"
END
middle=$work/middle
"$work/bin/cupola" run "$work/campaign.yaml" --run-dir "$middle" --until-episode 1 > "$work/out" 2>&1
[[ $? == 75 ]] || fail "a stage that diverged in its middle must go on"
grep -q 'tried again from its checkpoint at step [0-9]*, with dem.time_step = 1e-4' "$work/out" || fail "that it goes on from the checkpoint is not said"
grep -q 'going on from the checkpoint' "$middle/episodes/001/dem/attempt-2/stage.log" || fail "the checkpoint was not taken over"
[[ -f $middle/episodes/001/dem/attempt-1/checkpoint-B.h5 ]] || fail "what the first attempt left is gone"
node -e '
  const lines = require("fs").readFileSync(process.argv[1], "utf8").trim().split("\n").map((line) => JSON.parse(line));
  if (lines.some((line, i) => i > 0 && line.time <= lines[i - 1].time)) process.exit(1);
' "$middle/episodes/001/dem/attempt-2/history.jsonl" || fail "the history of the retry has holes or repeats"
"$work/bin/cupola" verify "$middle" > "$work/out" 2>&1 || fail "verify of a retried run"
echo "retries, refusals and the report of them are as promised"
