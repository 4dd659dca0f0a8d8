#!/usr/bin/env bash
# Prints the table of docs/stability.md: runs every stability case of a build and gathers the rows they print.
# Usage: tools/stability_table.sh BUILD
set -euo pipefail
build="${1:?usage: tools/stability_table.sh BUILD}"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
echo "| stage | what is extreme | outcome | figure | steps or step | wall s |"
echo "|---|---|---|---|---|---|"
for program in stability_dem stability_tracer; do
  "$build/bin/$program" 2> /dev/null | grep '^|' || { echo "$program printed no row" >&2; exit 1; }
done
