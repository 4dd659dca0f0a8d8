#!/usr/bin/env bash
# usage: tools/install_packages.sh PACKAGES_FILE
# Installs the Debian packages of the list that are missing.  Where nothing is missing it does nothing, not even refresh the
# package list.  Without root it uses sudo; without sudo it prints what an administrator must install and ends with 1.
set -euo pipefail
list=$1
missing=()
while read -r name; do
  [[ -z $name || $name == \#* ]] && continue
  # Debian's npm conflicts with a nodejs from elsewhere: what counts is that the programs are there.
  case $name in
    nodejs) command -v node >/dev/null && continue ;;
    npm) command -v npm >/dev/null && continue ;;
  esac
  [[ $(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null || true) == installed ]] || missing+=("$name")
done <"$list"
if ((${#missing[@]} == 0)); then
  echo "packages: all there"
  exit 0
fi
echo "packages: installing ${missing[*]}"
run=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "packages: not root and no sudo; as an administrator run:" >&2
    echo "  apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
  run=(sudo)
fi
"${run[@]}" apt-get update -q
"${run[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
