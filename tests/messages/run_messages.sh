#!/usr/bin/env bash
# usage: CUPOLA_FAULT_RUN=RUN run_messages.sh CUPOLA SOURCE_DIR WORK [--accept]
# What the programs say to run folders that were damaged, changed, swapped or are of another campaign; RUN is a whole one.
set -uo pipefail
# shellcheck source=messages.sh
source "$(dirname "$0")/messages.sh"
whole=$(realpath "${CUPOLA_FAULT_RUN:?names the run folder of a campaign that has ended}")
dem=episodes/001/dem/attempt-1
tracer=episodes/002/tracer/attempt-1

# damaged NAME: a copy of the whole run in the folder NAME.
damaged() { cp -r "$whole" "$1"; }
# flip FILE: one bit.
flip() {
  local byte
  byte=$(od -An -tu1 -j 60 -N 1 "$1")
  printf "\\x$(printf %x $((byte ^ 4)))" | dd of="$1" bs=1 seek=60 conv=notrunc status=none
}
# resumed NAME: what resume says to the damaged copy, which then goes.
resumed() {
  says "$1" "$cupola" resume "$1"
  rm -rf "${1:?}"
}

# ---- files of the run
for file in journal.jsonl run.json campaign.yaml resolved.yaml; do
  damaged "a bit of $file"
  flip "a bit of $file/$file"
  resumed "a bit of $file"
  damaged "no $file"
  rm "no $file/$file"
  resumed "no $file"
done
damaged 'a line of the journal is gone'
sed -i 5d 'a line of the journal is gone/journal.jsonl'
resumed 'a line of the journal is gone'
damaged 'the journal lost its beginning'
sed -i 1,3d 'the journal lost its beginning/journal.jsonl'
resumed 'the journal lost its beginning'
damaged 'campaign changed'
sed -i 's/2 mm\/s/3 mm\/s/' 'campaign changed/campaign.yaml'
resumed 'campaign changed'

damaged 'no journal at all'
rm 'no journal at all/journal.jsonl'
says 'no journal at all: verify' "$cupola" verify 'no journal at all'
says 'no journal at all: status' "$cupola" status 'no journal at all'
rm -rf 'no journal at all'

# ---- results
damaged 'a bit of a result'
flip "a bit of a result/$dem/result.hdf"
says 'a bit of a result: verify' "$cupola" verify 'a bit of a result'
says 'a bit of a result: report' "$cupola" report 'a bit of a result'
resumed 'a bit of a result'
damaged 'a bit of a manifest'
flip "a bit of a manifest/$dem/manifest.json"
resumed 'a bit of a manifest'
damaged 'a result is gone'
rm "a result is gone/$tracer/result.hdf"
resumed 'a result is gone'
damaged 'half a result'
truncate -s 100000 "half a result/$dem/result.hdf"
resumed 'half a result'
damaged 'results swapped'
mv "results swapped/$dem" 'results swapped/here'
mv "results swapped/episodes/002/dem/attempt-1" "results swapped/$dem"
mv 'results swapped/here' 'results swapped/episodes/002/dem/attempt-1'
resumed 'results swapped'
damaged 'a bit of a mesh'
flip "a bit of a mesh/$tracer/foam/mesh.hdf"
says 'a bit of a mesh: verify' "$cupola" verify 'a bit of a mesh'
rm -rf 'a bit of a mesh'

# ---- stages by themselves
damaged stages
says 'a tracer task for cupola-dem' "$programs/cupola-dem" stages/episodes/001/tracer/attempt-1
says 'no task' "$programs/cupola-dem" stages/report
printf 'schema: 1\nkind: dem\n' > stages/report/task.yaml
says 'half a task' "$programs/cupola-tracer" stages/report
rm -rf stages

# ---- another campaign
damaged 'of another campaign'
with 'another' '2 mm/s' '3 mm/s'
says 'of another campaign' "$cupola" run another.yaml --run-dir 'of another campaign'
says 'fewer episodes than there are' "$cupola" resume 'of another campaign' --at-most 1
finish "${4:-}"
