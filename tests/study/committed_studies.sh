#!/usr/bin/env bash
# The committed studies: each file is one that the program takes, and the results beside it are that file's.
#   committed_studies.sh CUPOLA SOURCE
set -euo pipefail
cupola="$1" source="$2"
cd "$source/cases/studies"
count=0
for file in *.yaml; do
  "$cupola" study "$file" --check > /dev/null || { echo "$file is no longer a study that can be run" >&2; exit 1; }
  [[ -e ${file%.yaml}.json ]] || continue
  node -e '
    const { readFileSync } = require("node:fs");
    const [file, results] = [process.argv[1], JSON.parse(readFileSync(process.argv[2], "utf8"))];
    // The section `reduced`, the last of a file, has no part in them.
    const asked = (text) => text.split(/^reduced:$/m)[0];
    if (asked(results.study_text) !== asked(readFileSync(file, "utf8"))) throw new Error(`${process.argv[2]} are the results of another ${file}: run it again`);
    const scene = /^scene: *(.*?) *(#.*)?$/m.exec(results.study_text)[1];
    // Results of before the scene was kept with them have none.
    if (results.scene_text !== undefined && results.scene_text !== readFileSync(scene, "utf8")) throw new Error(`${process.argv[2]} are results of another ${scene}: run the study again`);
    if (!results.settings.every(({ runs }) => runs.every(({ state }) => state === "finished" || state === "failed"))) throw new Error(`${process.argv[2]} is not complete`);
  ' "$file" "${file%.yaml}.json"
  count=$((count + 1))
done
[[ $count -ge 2 ]] || { echo "only $count committed results" >&2; exit 1; }
echo "$count committed studies"
