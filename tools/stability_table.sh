#!/usr/bin/env bash
# The table of docs/stability.md: runs every stability case of a build and gathers the rows they print.
# Usage: tools/stability_table.sh BUILD [--write]   (--write: into docs/stability.md, below its marker)
set -euo pipefail
build="${1:?usage: tools/stability_table.sh BUILD [--write]}"
page="$(dirname "$0")/../docs/stability.md"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
table=$(mktemp)
trap 'rm -f "$table"' EXIT
{
  echo "| stage | what is extreme | outcome | error or conservation | steps or step | wall s |"
  echo "|---|---|---|---|---|---|"
  for program in stability_dem stability_tracer stability_column; do
    "$build/bin/$program" 2> /dev/null | grep '^|' || { echo "$program printed no row" >&2; exit 1; }
  done
} > "$table"
if [[ ${2:-} == --write ]]; then
  marker='<!-- below: made by tools/stability_table.sh -->'
  grep -qxF "$marker" "$page"
  head=$(sed "\\|^$marker\$|q" "$page")
  printf '%s\n\n%s\n' "$head" "$(cat "$table")" > "$page"
  echo "$(($(wc -l < "$table") - 2)) cases in $page"
else
  cat "$table"
fi
