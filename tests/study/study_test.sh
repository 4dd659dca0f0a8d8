#!/usr/bin/env bash
# A real study from its file to its page: killed and resumed, with rows that fail, sharing what its settings share.
#   study_test.sh CUPOLA SOURCE FOLDER
set -euo pipefail
cupola="$1" source="$2" folder="$3"
fail() { echo "FAILED: $*" >&2; exit 1; }
rm -rf "$folder" && mkdir -p "$folder"
file="$source/tests/study/study.yaml"

# Nothing is run by --check.
"$cupola" study "$file" --study-dir "$folder/study" --check > "$folder/check.txt"
[[ $(grep -c '^  dem.limits' "$folder/check.txt") -eq 6 ]] || fail "--check does not list six settings"
[[ ! -e "$folder/study" ]] || fail "--check made a folder"

# Asked to stop once a stage has ended: what is done stays done.
"$cupola" study "$file" --study-dir "$folder/study" > "$folder/first.txt" 2>&1 &
pid=$!
for _ in $(seq 3000); do
  grep -q ': finished' "$folder/first.txt" && break
  kill -0 "$pid" 2> /dev/null || break
  sleep 0.1
done
kill -TERM "$pid" 2> /dev/null || true
status=0; wait "$pid" || status=$?
[[ $status -eq 75 ]] || fail "a stopped study leaves with 75, not $status: $(cat "$folder/first.txt")"
[[ -s "$folder/study/study.json" && -s "$folder/study/index.html" ]] || fail "no page while it is under way"
first=$(grep -l . "$folder"/study/stages/dem-*/manifest.json | head -1)
before=$(stat -c %Y "$first")

"$cupola" study "$file" --study-dir "$folder/study" > "$folder/second.txt" 2>&1 || fail "the study: $(cat "$folder/second.txt")"
[[ $(stat -c %Y "$first") -eq $before ]] || fail "a finished stage was run again"
# A DEM stage a seed for the packing, one a seed and limit: the tracer steps share them. Six tracer stages, none where it failed.
[[ $(ls -d "$folder"/study/stages/dem-* | wc -l) -eq 6 ]] || fail "the settings do not share their DEM stages"
[[ $(ls "$folder"/study/stages/tracer-*/manifest.json | wc -l) -eq 6 ]] || fail "not six tracer stages"

node "$source/tests/study/look_at_study.mjs" "$folder/study/study.json"

# Nothing is left to do: the same command only tells it again.
"$cupola" study "$file" --study-dir "$folder/study" > "$folder/third.txt" 2>&1 || fail "again: $(cat "$folder/third.txt")"
grep -q ': finished' "$folder/third.txt" && fail "something was run again"
echo "study test passed"
