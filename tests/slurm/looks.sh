# Sourced by the tests: starting things and looking how far they are; $work is the test's folder.

. "$here/../support/looks.sh"

# events RUN WHAT...: how many lines of the journal hold all of these.
events() {
  local lines
  lines=$(cat "$1/journal.jsonl")
  shift
  for what in "$@"; do lines=$(grep -- "$what" <<< "$lines"); done
  grep -c . <<< "$lines"
}

# works_in RUN EPISODE STAGE [LINES]: its program has got so far.
works_in() { [[ $(wc -l < "$1/episodes/$2/$3/attempt-1/history.jsonl") -ge ${4:-2} ]]; }
job_running() { [[ $(squeue --noheader --jobs="$1" --format=%T) == RUNNING ]]; }
job_of() { grep '"event":"job-submitted"' "$1/journal.jsonl" | tail -n 1 | sed 's/.*"job":"\([0-9]*\)".*/\1/'; }
