#!/usr/bin/env bash
# usage: links_what_it_uses.sh PROGRAM: fails where the program names a library of which it calls nothing.
set -euo pipefail
[[ -x $1 ]] || { echo "$1 is not there"; exit 1; }
needed=$(readelf -d "$1" | grep -c NEEDED)
# ldd's status says whether there are unused ones; what counts here is the list.
unused=$(LC_ALL=C ldd -u -r "$1" | grep -v 'Unused direct dependencies' | grep -v '^$' || true)
if [[ -n $unused ]]; then
  printf '%s names libraries that it does not use:\n%s\n' "$1" "$unused"
  exit 1
fi
echo "$1: $needed libraries, all of them used"
