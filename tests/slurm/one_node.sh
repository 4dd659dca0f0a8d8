# Sourced by the tests: a Slurm cluster of one node on loopback, in a folder of its own, with its own munge.
#   start_slurm FOLDER   begins it and sets SLURM_CONF; leaves with 77 and a sentence where it cannot be started
#   stop_slurm           ends its daemons, by their process ids; to be called on every way out
slurm_skip() { echo "SKIPPED: Slurm cannot be started here: $*" >&2; exit 77; }

free_port() {
  local port
  while :; do
    port=$((20000 + RANDOM % 20000))
    (exec 3<> "/dev/tcp/127.0.0.1/$port") 2> /dev/null || { echo "$port"; return; }
  done
}

start_slurm() {
  slurm_folder=$1
  local host user program key
  for program in munged slurmctld slurmd sbatch scontrol squeue scancel; do
    PATH=$PATH:/usr/sbin:/sbin command -v "$program" > /dev/null || slurm_skip "$program is not installed (Debian: slurm-wlm, munge)"
  done
  export PATH=$PATH:/usr/sbin:/sbin
  host=$(hostname -s)
  user=$(id -un)
  mkdir -p "$slurm_folder"/{munge,state,spool}
  slurm_folder=$(cd "$slurm_folder" && pwd)
  # A socket's path may be 107 letters long: the one of munge goes where paths are short.
  munge_folder=$(mktemp -d /tmp/cupola-munge-XXXXXX)
  chmod 711 "$munge_folder"
  key=$munge_folder/munge.key
  (umask 077; head -c 1024 /dev/urandom > "$key")
  munged --force --num-threads=2 --key-file="$key" --socket="$munge_folder/socket" --pid-file="$munge_folder/munged.pid" \
    --log-file="$slurm_folder/munge/munged.log" --seed-file="$munge_folder/seed" 2> "$slurm_folder/munge/stderr" \
    || slurm_skip "munged: $(cat "$slurm_folder/munge/stderr")"
  cat > "$slurm_folder/slurm.conf" <<EOF
ClusterName=cupola-test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$munge_folder/socket,cred_expire=5
CredType=cred/munge
MpiDefault=pmix
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,bf_interval=1,sched_interval=2,sched_min_interval=0
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc=$slurm_folder/jobs.txt
StateSaveLocation=$slurm_folder/state
SlurmdSpoolDir=$slurm_folder/spool
SlurmctldPidFile=$slurm_folder/slurmctld.pid
SlurmdPidFile=$slurm_folder/slurmd.pid
SlurmctldLogFile=$slurm_folder/slurmctld.log
SlurmdLogFile=$slurm_folder/slurmd.log
ReturnToService=2
KillWait=20
MinJobAge=300
InactiveLimit=0
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=batch Nodes=$host Default=YES MaxTime=INFINITE State=UP PriorityTier=1
PartitionName=urgent Nodes=$host MaxTime=INFINITE State=UP PriorityTier=10
EOF
  export SLURM_CONF=$slurm_folder/slurm.conf
  slurmctld > "$slurm_folder/slurmctld.out" 2>&1 || slurm_skip "slurmctld: $(tail -n 3 "$slurm_folder/slurmctld.out")"
  slurmd > "$slurm_folder/slurmd.out" 2>&1 || slurm_skip "slurmd: $(tail -n 3 "$slurm_folder/slurmd.out")"
  for ((tenths = 0; tenths < 300; ++tenths)); do
    [[ $(sinfo --noheader --format=%T --partition=batch 2> /dev/null) == idle ]] && return
    sleep 0.1
  done
  slurm_skip "its node does not become idle: $(tail -n 3 "$slurm_folder/slurmctld.log")"
}

stop_slurm() {
  local file process ended=()
  if [[ -n ${SLURM_CONF:-} ]]; then
    scancel --quiet --user="$(id -un)" 2> /dev/null
    # Without its controller a job would never be cleared away.
    for ((tenths = 0; tenths < 300; ++tenths)); do
      [[ -z $(squeue --noheader 2> /dev/null) ]] && break
      sleep 0.1
    done
  fi
  for file in "${slurm_folder:-/nonexistent}"/{slurmd,slurmctld}.pid "${munge_folder:-/nonexistent}/munged.pid"; do
    [[ -f $file ]] || continue
    process=$(cat "$file")
    kill "$process" 2> /dev/null && ended+=("$process")
  done
  for process in "${ended[@]}"; do
    for ((tenths = 0; tenths < 100; ++tenths)); do
      kill -0 "$process" 2> /dev/null || break
      sleep 0.1
    done
  done
  [[ -n ${munge_folder:-} ]] && rm -rf "$munge_folder"
}
