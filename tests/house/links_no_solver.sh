#!/usr/bin/env bash
# usage: links_no_solver.sh PROGRAM: fails where the program links OpenFOAM, LIGGGHTS or MPI.
set -euo pipefail
[[ -x $1 ]] || { echo "$1 is not there"; exit 1; }
if ldd "$1" | grep -iE 'OpenFOAM|finiteVolume|meshTools|Pstream|liggghts|libmpi'; then
  echo "$1 must not link these"
  exit 1
fi
