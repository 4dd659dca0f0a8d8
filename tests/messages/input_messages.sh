#!/usr/bin/env bash
# usage: input_messages.sh CUPOLA SOURCE_DIR WORK [--accept]
# What `cupola` says to wrong campaign files, command lines and folders.
set -uo pipefail
# shellcheck source=messages.sh
source "$(dirname "$0")/messages.sh"

# ---- the campaign file
mistake 'misspelt key' 'mass_flow: 0.22' 'mas_flow: 0.22'
mistake 'misspelt section' 'descent_rate:' 'descent_rat:'
mistake 'key in the wrong section' 'launch: {ranks: 2}' 'ranks: 2'
mistake 'key of nowhere' 'heat_loss: {' 'heat_loss: {colour: red, '
mistake 'length for a time' 'duration: 0.5 h' 'duration: 5 m'
mistake 'unknown unit' '2 mm/s' '2 mm/fortnite'
mistake 'decimal comma' '2 mm/s' '"2,5 mm/s"'
mistake 'coulomb' '1475 K' '1200 C'
mistake 'word for a number' '2 mm/s' 'fast'
mistake 'not a number' '2 mm/s' '.nan'
mistake 'nothing for a number' '2 mm/s' ''
mistake 'denormal' '2 mm/s' '1e-310 m/s'
mistake 'huge' 'total_temperature: 2400 K' 'total_temperature: 1e300 K'
mistake 'not positive' 'diameter: 44 mm' 'diameter: -44 mm'
mistake 'missing key' 'heat_capacity: 850 J/kg/K, ' ''
mistake 'missing section' 'descent_rate: 2 mm/s' ''
mistake 'unknown choice' 'side: left' 'side: leeft'
mistake 'half an episode' '1 episode,' '1.5 episodes,'
mistake 'ore melts before it softens' 'melted: 1675 K' 'melted: 1400 K'
mistake 'layer of no species' '{ore: 60 kg}' '{orr: 60 kg}'
mistake 'pair of no species' 'ore-ore:' 'ore-oer:'
mistake 'inlet outside the wall' 'name: tuyere-left, side: left, z: 0.25 m' 'name: tuyere-left, side: left, z: 3.25 m'
mistake 'inlet over a corner' 'name: tuyere-left, side: left, z: 0.25 m' 'name: tuyere-left, side: left, z: 0.5 m'
mistake 'inlet twice' 'name: tuyere-right' 'name: tuyere-left'
mistake 'unknown gas' 'species: blast' 'species: nitrogn'
mistake 'stock line outside' 'stock_line: 2.1 m' 'stock_line: 9 m'
mistake 'raceway outside' 'x: [0.2 m, 0.4 m]' 'x: [0.2 m, 0.9 m]'
mistake 'profile does not rise' '[0.5, 0.4]' '[3, 0.4]'
mistake 'too shallow for periodic sides' 'depth: 0.4 m' 'depth: 0.2 m'
mistake 'window longer than the stage' 'at_most: 0.6 s' 'at_most: 0.5 s'
mistake 'repeated key' 'descent_rate: 2 mm/s' $'descent_rate: 2 mm/s\ndescent_rate: 3 mm/s'
mistake 'tab' '  mesh:' $'\tmesh:'
mistake 'open bracket' 'launch: {ranks: 2}' 'launch: {ranks: 2'
mistake 'alias' 'launch: {ranks: 2}' 'launch: &a [*a]'
with 'several mistakes' 'mass_flow: 0.22' 'mas_flow: 0.22'
sed -i 's/2 mm\/s/fast/; s/melted: 1675/melted: 1400/' 'several mistakes.yaml'
says 'several mistakes' "$cupola" validate 'several mistakes.yaml'
: > empty.yaml
says 'empty file' "$cupola" validate empty.yaml
printf '\x89PNG\r\n\x1a\n\x00\x00' > picture.yaml
says 'a picture' "$cupola" validate picture.yaml
head -c 2000000 /dev/zero | tr '\0' ' ' > huge.yaml
says 'too large a file' "$cupola" validate huge.yaml
says 'no such campaign' "$cupola" validate 'nirgends/ofen.yaml'
says 'a folder as campaign' "$cupola" validate .

# ---- what cannot be run
refused() {
  with "$@"
  says "$1" "$cupola" run "$1.yaml" --run-dir never
  [[ ! -e never ]] || fail "$1: left a run folder"
}
refused 'mesh cannot hold the tuyere' 'mesh: {cell: 0.13 m}' 'mesh: {cells: {half_width: 4, depth: 3, heights: [1, 12]}}'
refused 'blast chokes' 'size: [0.13 m, 0.13 m], mass_flow: 0.22' 'size: [0.01 m, 0.01 m], mass_flow: 0.22'
refused 'step above the stable one' 'dem: {' 'dem: {time_step: 2 ms, '
refused 'wrong campaign' 'descent_rate:' 'descent_rat:'
says 'no command' "$cupola"
says 'unknown command' "$cupola" rum campaign.yaml
says 'unknown option' "$cupola" run campaign.yaml --run-drr there
says 'bad option value' "$cupola" run campaign.yaml --at-most none
says 'misspelt command' "$cupola" valdate campaign.yaml

# ---- the run folder
mkdir thesis && echo x > thesis/chapter.tex
says 'resume of what is no run' "$cupola" resume thesis
says 'status of what is not there' "$cupola" status nirgends
says 'report of what is no run' "$cupola" report thesis
says 'run into a folder of other things' "$cupola" run "$tiny" --run-dir thesis
says 'run below a file' "$cupola" run "$tiny" --run-dir thesis/chapter.tex/run
says 'init where something is' "$cupola" init thesis/chapter.tex
finish "${4:-}"
