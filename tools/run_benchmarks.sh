#!/usr/bin/env bash
# usage: tools/run_benchmarks.sh BUILD
# Runs every benchmark program; each prints a table and leaves BUILD/bench/<name>.json, a list of
# {bench, setting, metric, value, unit, ranks, cells, parcels}.  BUILD/bench.json is all of them in one list.
set -euo pipefail
build=$1
mkdir -p "$build/bench"
for program in "$build"/bin/bench_*; do
  name=$(basename "$program")
  echo "== $name"
  "$program" --json "$build/bench/$name.json"
done
node -e 'const fs=require("fs"),d=process.argv[1]+"/bench";
fs.writeFileSync(process.argv[1]+"/bench.json",JSON.stringify(fs.readdirSync(d).flatMap(f=>JSON.parse(fs.readFileSync(d+"/"+f))),null,1))' "$build"
echo "== $build/bench.json"
