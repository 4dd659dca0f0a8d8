# Shared by the tests of messages: sourced, with CUPOLA SOURCE_DIR WORK [--accept] as arguments.
# What the programs say to wrong input, against tests/messages/<name of the test>.txt: every sentence and exit status, in a folder with
# blanks and letters beyond ASCII in its name.  Nothing that was there may be changed.  --accept takes what was said for what is
# expected.
programs=$(cd "$(dirname "$1")" && pwd)
cupola=$programs/cupola
tiny=$(realpath "$2")/cases/tiny/campaign.yaml
work=$(realpath -m "$3")
expected=$(realpath -m "${0%.sh}.txt")
rm -rf "$work"
mkdir -p "$work/Öfen und Kamine"
cd "$work/Öfen und Kamine" || exit 1
said=$work/said.txt
: > "$said"
failures=0
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

# What must stay as it is: everything but what a start may add to.
contents() {
  find . -type f ! -name '*.log' ! -name 'log.*' ! -name lock ! -name failure.json ! -name progress.json ! -path '*/report/*' \
    ! -path '*/fields/*' ! -name ro-crate-metadata.json ! -name journal.jsonl -exec md5sum {} + | LC_ALL=C sort
}

# says NAME COMMAND...: its words and its exit status go to the file; without what depends on the place and the day.
says() {
  local name=$1 before after status
  shift
  before=$(contents)
  "$@" > "$work/words" 2>&1 < /dev/null
  status=$?
  after=$(contents)
  # Files may come, none may change or go.
  LC_ALL=C comm -23 <(echo "$before") <(echo "$after") | grep . && fail "$name: changed a file"
  {
    echo "== $name: $status"
    # Of mpirun's own words nothing is kept, of LIGGGHTS and OpenFOAM only our sentence.
    sed -E -e "s|$work|WORK|g; s|$programs|BIN|g" -e 's/\x1b\[[0-9;]*m//g; s/^[0-9-]{10} [0-9:]{8} (error|warning): //; s/^\[[0-9. :-]*\] \[(error|warning)\] //' \
      -e 's/xxh3:[0-9a-f]{32}/HASH/g; s/pid [0-9]+ on [^ ]+ since [^;]*;/pid N on HOST since TIME;/' \
      "$work/words" | grep -vE '^-+$|MPI_ABORT|errorcode|NOTE: invoking|You may or may not|exactly when Open MPI|^$|the job to be terminated|^note: |Primary job|mpirun detected|prterun|Process name|Exit code|a non-zero'
  } >> "$said"
}

# with NAME OLD NEW: the tiny campaign with a piece of text replaced, as a file of that name.
with() {
  local text
  text=$(< "$tiny")
  [[ $text == *"$2"* ]] || fail "$1: \"$2\" does not stand in the tiny campaign"
  printf '%s\n' "${text/"$2"/"$3"}" > "$1.yaml"
}
# mistake NAME OLD NEW: what `cupola validate` says to that.
mistake() {
  with "$@"
  says "$1" "$cupola" validate "$1.yaml"
}


# finish [--accept]: compares.
finish() {
  if [[ ${1:-} == --accept ]]; then
    cp "$said" "$expected" || fail "$expected cannot be written"
  elif ! diff -u "$expected" "$said"; then
    fail "the messages are not those of $expected; where the new ones are better: run it again with --accept"
  fi
  echo "$(grep -c '^== ' "$said") messages"
  exit "$((failures > 0))"
}
