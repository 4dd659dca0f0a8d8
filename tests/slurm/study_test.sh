#!/usr/bin/env bash
# A study queued in a real Slurm as arrays of jobs: two DEM stages at once, then a tracer stage behind each, then the page; it
# gives the figures of the same study run here.
#   study_test.sh CUPOLA SOURCE_DIR WORK_DIR
. "$(dirname "$(realpath "$0")")/begin.sh"

cat > "$work/study.yaml" <<EOF
study: arrays
scene: $source/cases/tiny/campaign.yaml
stage: episode
change:
  launch: {slurm: {ranks: 1, time: 10 min}}
  tracer.duration: 100 s
vary:
  - tracer.time_step: [5 s, 20 s]
seeds: 2
reference: {setting: {tracer.time_step: 5 s}}
metrics: [temperature, cohesive_zone]
jobs: 2
EOF
sed '/launch/s/.*/  launch.ranks: 1/' "$work/study.yaml" > "$work/here.yaml"

[[ $(status_of "$cupola" study "$work/study.yaml" --study-dir "$work/queued" --submit) == 0 ]] || fail "the study was not queued"
jobs=$(squeue --noheader --array --format=%i | wc -l)
[[ $jobs -ge 7 ]] || fail "not two DEM stages, four tracer stages and a page, but $jobs jobs are queued"
[[ $(status_of "$cupola" study "$work/here.yaml" --study-dir "$work/here") == 0 ]] || fail "the study did not run here"
wait_for 600 eval '[[ -z $(squeue --noheader) ]]' || fail "the jobs do not end"
[[ -s $work/queued/index.html ]] || fail "the last job made no page"
node - "$work/here/study.json" "$work/queued/study.json" <<'EOF' || fail "arrays give other figures"
const { readFileSync } = require('node:fs');
const [here, queued] = process.argv.slice(2).map((file) =>
  JSON.parse(readFileSync(file, 'utf8')).settings.map(({ errors, figures, runs }) =>
    JSON.stringify({ errors, figures, runs: runs.map(({ seed, state, errors }) => ({ seed, state, errors })) })));
if (here.length !== 2 || !here[0].includes('finished')) throw new Error(`no figures: ${here[0]}`);
here.forEach((text, i) => { if (text !== queued[i]) throw new Error(`${text}\n${queued[i]}`); });
EOF
echo "slurm study test passed"
