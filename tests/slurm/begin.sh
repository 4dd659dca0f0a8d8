# Sourced first by the tests, which are called with CUPOLA SOURCE_DIR WORK_DIR: an empty work folder, a Slurm of one node in it,
# and an end at which nothing that was started is left.
set -uo pipefail
cupola=$1
source=$2
work=$3
here=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
. "$here/one_node.sh"
. "$here/looks.sh"
rm -rf "$work"
mkdir -p "$work"
orchestrator=
clean_up() {
  [[ -n $orchestrator ]] && kill -KILL "$orchestrator" 2> /dev/null
  stop_slurm
}
trap clean_up EXIT
start_slurm "$work/slurm"

fail() {
  echo "FAILED: $*"
  tail -n 30 "$work/out"
  squeue
  tail -n 5 "$slurm_folder"/slurmctld.log
  exit 1
}
