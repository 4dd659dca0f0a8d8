#!/usr/bin/env bash
# usage: links_what_it_uses.sh PROGRAM: fails where the program names a library of which nothing is called: neither by itself nor
# by a library that it calls and that would bring it along anyway (as OpenFOAM's finiteVolume does with those below it).
set -euo pipefail
[[ -x $1 ]] || { echo "$1 is not there"; exit 1; }
named() { readelf -d "$1" | sed -n 's/.*NEEDED.*\[\(.*\)\]/\1/p' | sed 's|.*/||'; }
# ldd's status says whether there are unused ones; what counts here is the list.
unused=$(LC_ALL=C ldd -u -r "$1" | grep -v 'Unused direct dependencies' | sed '/^$/d; s/^\s*//' || true)
bad=0
for library in $unused; do
  brought=no
  for used in $(ldd "$1" | awk '/=>/ {print $3} /^\t\// {print $1}'); do
    grep -xF "$used" <<< "$unused" > /dev/null && continue
    if named "$used" | grep -xF "$(basename "$library")" > /dev/null; then brought=yes; fi
  done
  [[ $brought == yes ]] || { echo "$1 names $library and calls nothing of it"; bad=1; }
done
echo "$1: $(named "$1" | wc -l) libraries; OpenFOAM: $(named "$1" | grep -E 'OpenFOAM|finiteVolume|meshTools|surfMesh|fileFormats|Pstream|specie|blockMesh' | tr '\n' ' ')"
exit $bad
