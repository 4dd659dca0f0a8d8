# Sourced by the tests of whole campaigns: running things and waiting for them; $work is the test's folder, $run the campaign's.

# status_of COMMAND...: runs it, its words into the log, and prints its exit status.
status_of() {
  echo "== $*" >> "$work/out"
  "$@" >> "$work/out" 2>&1
  echo $?
}

# wait_for SECONDS COMMAND...: until the command succeeds.
wait_for() {
  local until=$((SECONDS + $1))
  shift
  until "$@" > /dev/null 2>&1; do
    [[ $SECONDS -lt $until ]] || return 1
    sleep 0.03
  done
}

# The process of mpirun of the stage that was started last.
stage_process() { grep '"event":"stage-started"' "$run/journal.jsonl" | tail -n 1 | sed 's/.*"pid":\([0-9]*\).*/\1/'; }

fail() {
  echo "FAILED: $*"
  [[ -f $work/out ]] && tail -n 20 "$work/out"
  exit 1
}
