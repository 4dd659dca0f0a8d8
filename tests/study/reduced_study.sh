#!/usr/bin/env bash
# A committed study at its reduced size: its figures are still those that were committed with it.
#   reduced_study.sh CUPOLA STUDY_YAML FOLDER [--accept]
set -euo pipefail
cupola="$1" file="$2" folder="$3"
here="$(cd "$(dirname "$0")" && pwd)"
rm -rf "$folder" && mkdir -p "$(dirname "$folder")"
"$cupola" study "$file" --reduced --study-dir "$folder"
node "$here/compare_figures.mjs" "$folder/study.json" "${file%.yaml}.figures.json" "${@:4}"
