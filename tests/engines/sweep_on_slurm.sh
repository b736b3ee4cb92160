#!/bin/bash
# A sweep of 48 flights on a real Slurm of two nodes, one of which dies in the middle.
here=$(dirname "$0")
. "$here/common.sh"
. "$here/slurm_nodes.sh"
missing=$(slurm_missing)
[[ -z $missing ]] || { echo "SKIPPED: $missing is not installed"; exit 0; }
[[ $(id -u) -eq 0 ]] || { echo "SKIPPED: slurmd needs root"; exit 0; }
trap 'slurm_stop; rm -rf "$scratch"' EXIT
write_sweep
fly_locally
slurm_start "$scratch/slurm" || fail "Slurm does not start"
"$octant" sweep "$scratch/many.toml" --out "$scratch/slurm-runs" --on slurm --batch minutes=5 --quiet &
sweep=$!
wait_for_done "$scratch/slurm-runs" 8 "$sweep"
slurm_kill_node n2
echo "node n2 died after $(done_in "$scratch/slurm-runs") flights"
sleep 12 # longer than SlurmdTimeout, so that its tasks are given up
slurm_start_node n2
wait "$sweep" || fail "the sweep on Slurm ended with $?: $(tail -n 3 "$scratch"/slurm-runs/logs/*.log)"
compare_with_local "$scratch/slurm-runs"
end_by_signal "$scratch/slurm-ended" --on slurm --batch minutes=5
[[ -z $(squeue --noheader --name=octant-long) ]] || fail "tasks are left in the queue"
echo "48 of 48 flights, each as locally; a signal empties the queue"
