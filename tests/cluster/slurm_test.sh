#!/usr/bin/env bash
# slurm_test.sh FORCESHADE SCRIPTS: an array job of 8 tasks on a Slurm cluster in software that the test starts: one controller and
# two nodes. One node is lost, one task is requeued, the controller is restarted and one task is killed by its time limit; the
# evidence has the bytes of one process's. Skipped without root or without Debian's slurm-wlm.
scripts=$(realpath "$2")
[ "$(id -u)" = 0 ] || { echo "skipped: slurmd needs root"; exit 77; }
for program in slurmctld slurmd sbatch scontrol squeue; do
  command -v $program > /dev/null || PATH=$PATH:/usr/sbin
  command -v $program > /dev/null || { echo "skipped: no $program; apt-get install slurm-wlm"; exit 77; }
done
unshare -pf --kill-child --mount-proc true 2> /dev/null || { echo "skipped: no process namespaces here"; exit 77; }
. "$(dirname "$0")/../apps/expect.sh"

export SLURM_CONF=$scratch/slurm.conf
port=$((20000 + RANDOM % 20000))
mkdir state spool
cat > slurm.conf << END
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=$port
AuthType=auth/none
AuthInfo=cred_expire=5
CredType=cred/none
SlurmUser=root
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool/%n
SlurmdPidFile=$scratch/%n.pid
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmctldLogFile=$scratch/slurmctld.log
SlurmdLogFile=$scratch/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
SlurmdTimeout=5
SlurmctldTimeout=5
KillWait=2
MpiDefault=none
NodeName=n1 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=4 State=UNKNOWN
NodeName=n2 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=4 State=UNKNOWN
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
END
declare -A daemons
# A node in a namespace of processes: when its first one is killed, everything on the node is.
node() { unshare -pf --kill-child --mount-proc slurmd -D -N "$1" > "$1.out" 2>&1 & daemons[$1]=$!; }
controller() { slurmctld -D > slurmctld.out 2>&1 & daemons[controller]=$!; }
clean_up() {
  scancel --me 2> /dev/null
  for name in "${!daemons[@]}"; do kill -9 "${daemons[$name]}" 2> /dev/null; done
  wait
  rm -rf "$scratch"
}
trap clean_up EXIT
started=$SECONDS
say() { printf '%4d s  %s\n' $((SECONDS - started)) "$*"; }
fail() { echo "FAILED: $*"; tail -n 20 slurmctld.log n1.log n2.log; squeue -a; exit 1; }
# until_so SECONDS WHAT COMMAND...: waits for a state of the cluster, not for a time.
until_so() {
  local end=$((SECONDS + $1)) what=$2; shift 2
  until "$@" > /dev/null 2>&1; do [ $SECONDS -lt $end ] || fail "it did not happen: $what"; sleep 0.3; done
  say "$what"
}

what=(--law wall,bump-2p-shaded --points 400000 --cases 200 --units 80 --lease 5)
"$forceshade" certify plan "${what[@]}" --out one > /dev/null && "$forceshade" certify work one > /dev/null &&
  "$forceshade" certify merge one --out one-merged > /dev/null || fail "one process"
"$forceshade" certify plan "${what[@]}" --out many > /dev/null
# Somebody holds the last unit, so that no task ends before everything below has happened.
echo test > many/claims/worker-test; ln many/claims/worker-test many/claims/83
(while touch many/claims/worker-test 2> /dev/null; do sleep 1; done) & daemons[holder]=$!

controller; node n1; node n2
is_idle() { [ "$(sinfo -h -p all -t idle -o %D)" = 2 ]; }
until_so 60 "controller and two nodes are up" is_idle
job=$(FORCESHADE=$forceshade sbatch --parsable --array=1-8 --signal=B:CONT@1 --chdir="$scratch" -o task-%a.txt \
  "$scripts/plan.sbatch" "$scratch/many") || fail "sbatch"
state_of() { scontrol show job "${job}_$1" -o | grep -o 'JobState=[A-Z_]*' | cut -d= -f2; }
running() { [ "$(squeue -h -t R -r | wc -l)" = "$1" ]; }
until_so 30 "an array of 8 tasks runs on two nodes" running 8
task_on() { squeue -h -r -t R -w "$1" -o %K | sort -n | sed -n "$2p"; }
limited=$(task_on n1 1) requeued=$(task_on n1 2)
scontrol update jobid="${job}_$limited" timelimit=1 || fail "time limit"
some_results() { [ "$(find many/results -name '[0-9]*.json' | wc -l)" -gt 5 ]; }
until_so 60 "the first units are done" some_results
kill -9 "${daemons[n2]}"; say "node n2 is killed with its tasks"
scontrol requeue "${job}_$requeued" || fail "requeue"
restarted() { scontrol show job "${job}_$requeued" -o | grep -q "Restarts=[1-9]"; }
until_so 30 "task $requeued is requeued" restarted
kill "${daemons[controller]}"; wait "${daemons[controller]}" 2> /dev/null
controller; say "the controller is ended and started again"
is_down() { sinfo -h -n n2 -o %T | grep -q down && [ "$(squeue -h -t PD -r | wc -l)" -ge 4 ]; }
until_so 90 "the controller has found that n2 is down, and its four tasks wait again" is_down
timed_out() { [ "$(state_of "$limited")" = TIMEOUT ]; }
until_so 180 "task $limited was killed by its time limit" timed_out
kill "${daemons[holder]}"; rm many/claims/83 many/claims/worker-test
node n2
is_over() { [ -z "$(squeue -h)" ]; }
until_so 180 "no task is left" is_over
for task in 1 2 3 4 5 6 7 8; do
  [ "$task" = "$limited" ] || [ "$(state_of $task)" = COMPLETED ] || fail "task $task: $(state_of $task): $(cat task-$task.txt)"
done
"$forceshade" certify merge many || fail "status"
"$forceshade" certify merge many --out many-merged > /dev/null || fail "merge"
cmp many-merged/evidence.json one-merged/evidence.json || fail "another evidence"
diff -r -x '.*' one/results many/results || fail "other results"
say "the evidence is that of one process: sha256 $(sha256sum < many-merged/evidence.json | cut -c1-16)"
