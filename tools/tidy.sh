#!/usr/bin/env bash
# usage: tools/tidy.sh BUILD FOLDER...
# clang-tidy over our sources in the folders, with the flags of the build; fails on any finding.
set -euo pipefail
build=$1
shift
git ls-files -- "${@/%//*.cpp}" | xargs -P "$(nproc)" -n 4 clang-tidy -p "$build" --quiet 2> >(grep -v 'warnings generated' >&2)
echo "tidy: fine"
