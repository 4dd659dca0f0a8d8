#!/usr/bin/env bash
# usage: install_packages_test.sh SOURCE_DIR: tools/install_packages.sh where all is there, as root, with sudo and with neither.
# The package tools are put in front of the real ones; they only write down what they were asked.
set -uo pipefail
script=$1/tools/install_packages.sh
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
mkdir "$work/bin"
printf '# a comment\nthere\n\nmissing-one\nmissing-two\n' > "$work/some.txt"
echo there > "$work/all.txt"

# tool NAME TEXT: a program of that name.
tool() {
  printf '#!/bin/sh\n%s\n' "$2" > "$work/bin/$1"
  chmod +x "$work/bin/$1"
}
# expect NAME STATUS SAID ASKED LIST: exit status, a text in what is said, and what apt-get was asked for.
expect() {
  local said status asked
  : > "$work/asked"
  said=$(PATH=$work/bin:/usr/bin:/bin ASKED=$work/asked "$script" "$work/$5" 2>&1)
  status=$?
  asked=$(tr '\n' ';' < "$work/asked")
  if [[ $status != "$2" || $said != *"$3"* || $asked != "$4" ]]; then
    printf 'FAILED %s\n  status %s, expected %s\n  said %s\n  asked %s\n' "$1" "$status" "$2" "$said" "$asked"
    failures=$((failures + 1))
  fi
}
install='update -q;install -y -q --no-install-recommends missing-one missing-two;'

tool dpkg-query 'for name; do :; done; [ "$name" = there ] && echo installed'
tool apt-get 'echo "$@" >> "$ASKED"'
tool sudo 'echo sudo >> "$ASKED"; exec "$@"'
tool id 'echo 0'
expect 'all there, as root' 0 'all there' '' all.txt
expect 'as root' 0 'installing missing-one missing-two' "$install" some.txt
tool id 'echo 1000'
expect 'all there, as somebody' 0 'all there' '' all.txt
expect 'with sudo' 0 'installing missing-one missing-two' "sudo;${install/;install/;sudo;install}" some.txt
if [[ ! -x /usr/bin/sudo && ! -x /bin/sudo ]]; then
  rm "$work/bin/sudo"
  expect 'with neither' 1 'apt-get install --no-install-recommends missing-one missing-two' '' some.txt
fi
[[ $failures -eq 0 ]] && echo "all as expected"
exit "$failures"
