#!/bin/bash
# A sweep of 48 flights by GNU parallel over ssh to two servers, one of which dies in the middle.
here=$(dirname "$0")
. "$here/common.sh"
for program in parallel ssh ssh-keygen /usr/sbin/sshd; do
  command -v "$program" >/dev/null || { echo "SKIPPED: $program is not installed"; exit 0; }
done
[[ $(id -u) -eq 0 ]] || { echo "SKIPPED: sshd needs root"; exit 0; }
servers=()
trap 'kill "${servers[@]}" 2>/dev/null; rm -rf "$scratch"' EXIT

# A server in a session of its own, so that it dies with its connections. Its shells find no start-up
# files of the user: a home of their own, and as a second level of shell no bashrc either, which bash
# reads under ssh. Such a file may wait long for a lock that a shell which was killed has left.
start_server() { # PORT
  setsid /usr/sbin/sshd -D -e -f /dev/null -p "$1" -h "$scratch/key" -o StrictModes=no -o UsePAM=no \
    -o PermitRootLogin=yes -o AuthorizedKeysFile="$scratch/key.pub" -o PidFile=none \
    -o MaxStartups=100 -o PermitUserRC=no -o SetEnv="HOME=$scratch/home SHLVL=1" >"$scratch/sshd-$1.out" 2>&1 &
  servers+=($!)
}

kill_server() { # PID with all its connections and what they run
  local child
  for child in $(pgrep -P "$1"); do kill_server "$child"; done
  kill -KILL "$1" 2>/dev/null
}

free_port() {
  local port
  while :; do
    port=$((20000 + RANDOM % 20000))
    (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null || { echo "$port"; return; }
  done
}

write_sweep
fly_locally
mkdir -p /run/sshd "$scratch/home"
ssh-keygen -q -t ed25519 -N "" -f "$scratch/key"
login="ssh -F none -i $scratch/key -o BatchMode=yes -o StrictHostKeyChecking=no -o UserKnownHostsFile=/dev/null -o LogLevel=ERROR"
one=$(free_port)
two=$(free_port)
start_server "$one"
start_server "$two"
printf '%s\n' "1/$login -p $one 127.0.0.1" "1/$login -p $two 127.0.0.1" >"$scratch/machines.txt"
for tenth in {1..100}; do
  $login -p "$one" 127.0.0.1 true && $login -p "$two" 127.0.0.1 true && break
  sleep 0.1
done 2>/dev/null
"$octant" sweep "$scratch/many.toml" --out "$scratch/parallel-runs" --on parallel \
  --batch "hosts=$scratch/machines.txt,retries=3" --quiet &
sweep=$!
wait_for_done "$scratch/parallel-runs" 8 "$sweep"
kill_server "${servers[1]}"
echo "a machine died after $(done_in "$scratch/parallel-runs") flights"
wait "$sweep" || fail "the sweep by GNU parallel ended with $?: $(tail -n 5 "$scratch"/parallel-runs/logs/parallel.log)"
compare_with_local "$scratch/parallel-runs"
head -n 1 "$scratch/machines.txt" >"$scratch/machine.txt"
end_by_signal "$scratch/parallel-ended" --on parallel --batch "hosts=$scratch/machine.txt"
grep -lq '"stopped"' "$scratch"/parallel-ended/runs/*/run.json || fail "no flight ended in order"
echo "48 of 48 flights, each as locally; a signal ends a sweep in order"
