# Sourced: a Slurm of two nodes on the loopback in a folder of its own, with a munge of its own.
#   slurm_start FOLDER; slurm_kill_node NAME; slurm_start_node NAME; slurm_stop
# SLURM_CONF then names its configuration. Needs to be root.

slurm_missing() { # prints the first program that is not installed
  local program
  for program in munged slurmctld slurmd sbatch scontrol squeue; do
    command -v "$program" >/dev/null || { echo "$program"; return; }
  done
}

slurm_free_port() { # a port that nobody listens on
  local port
  while :; do
    port=$((20000 + RANDOM % 20000))
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || { echo "$port"; return; }
  done
}

slurm_start_node() {
  slurmd -D -N "$1" -f "$SLURM_CONF" >"$SLURM_FOLDER/slurmd-$1.out" 2>&1 &
  echo $! >"$SLURM_FOLDER/$1.pid"
}

slurm_start() {
  export SLURM_FOLDER=$1 SLURM_CONF=$1/slurm.conf
  mkdir -p "$SLURM_FOLDER"/{state,spool-n1,spool-n2,munge}
  chmod 755 "$SLURM_FOLDER" "$SLURM_FOLDER/munge"
  (umask 077 && head -c 1024 /dev/urandom >"$SLURM_FOLDER/munge/key")
  munged --foreground --force --key-file="$SLURM_FOLDER/munge/key" --socket="$SLURM_FOLDER/munge/socket" \
    --pid-file="$SLURM_FOLDER/munge/pid" --log-file="$SLURM_FOLDER/munge/log" \
    --seed-file="$SLURM_FOLDER/munge/seed" >"$SLURM_FOLDER/munge/out" 2>&1 &
  SLURM_MUNGE=$!
  local name
  name=$(hostname -s)
  cat >"$SLURM_CONF" <<EOF
ClusterName=loop
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=$(slurm_free_port)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$SLURM_FOLDER/munge/socket
CredType=cred/munge
MpiDefault=none
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
StateSaveLocation=$SLURM_FOLDER/state
SlurmdSpoolDir=$SLURM_FOLDER/spool-%n
SlurmctldPidFile=$SLURM_FOLDER/slurmctld.pid
SlurmdPidFile=$SLURM_FOLDER/slurmd-%n.pid
SlurmctldLogFile=$SLURM_FOLDER/slurmctld.log
SlurmdLogFile=$SLURM_FOLDER/slurmd-%n.log
SlurmdTimeout=10
InactiveLimit=0
KillWait=2
MinJobAge=300
ReturnToService=2
JobRequeue=1
SchedulerParameters=sched_interval=2,batch_sched_delay=1,bf_interval=2
NodeName=n1 NodeHostname=$name NodeAddr=127.0.0.1 Port=$(slurm_free_port) CPUs=1
NodeName=n2 NodeHostname=$name NodeAddr=127.0.0.1 Port=$(slurm_free_port) CPUs=1
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
EOF
  local tenth
  for tenth in {1..100}; do [[ -S $SLURM_FOLDER/munge/socket ]] && break; sleep 0.1; done
  slurmctld -D -f "$SLURM_CONF" >"$SLURM_FOLDER/slurmctld.out" 2>&1 &
  SLURM_CONTROL=$!
  slurm_start_node n1
  slurm_start_node n2
  for tenth in {1..300}; do
    kill -0 "$SLURM_CONTROL" 2>/dev/null || break # as where the only network is the loopback
    [[ $(sinfo --noheader --format=%T --nodes=n1,n2 2>/dev/null | sort -u) == idle ]] && return 0
    sleep 0.1
  done
  echo "the nodes do not come up:" >&2
  tail -n 5 "$SLURM_FOLDER"/*.out "$SLURM_FOLDER"/*.log >&2
  return 1
}

slurm_kill_node() { # the node with all that runs on it, as a power cut would
  local daemon
  daemon=$(cat "$SLURM_FOLDER/$1.pid")
  local step
  for step in $(pgrep -f "slurmstepd.*\[.*\]|slurmstepd" || true); do
    grep -qz "SLURMD_NODENAME=$1" "/proc/$step/environ" 2>/dev/null && kill -KILL "$step" 2>/dev/null
  done
  local process
  for process in /proc/[0-9]*; do
    if grep -qzx "SLURMD_NODENAME=$1" "$process/environ" 2>/dev/null; then
      kill -KILL "${process#/proc/}" 2>/dev/null || true
    fi
  done
  kill -KILL "$daemon" 2>/dev/null || true
}

slurm_stop() {
  kill "$SLURM_CONTROL" $(cat "$SLURM_FOLDER"/n?.pid) 2>/dev/null
  sleep 1
  kill -KILL "$SLURM_CONTROL" $(cat "$SLURM_FOLDER"/n?.pid) 2>/dev/null
  kill "$SLURM_MUNGE" 2>/dev/null
  wait 2>/dev/null
  return 0
}
