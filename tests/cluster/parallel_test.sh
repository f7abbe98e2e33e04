#!/usr/bin/env bash
# parallel_test.sh FORCESHADE SCRIPTS: GNU parallel starts a worker on each host, here on this machine by two names, one of which
# is reached through a stand-in for ssh; the first worker is killed and started again.
scripts=$(realpath "$2")
command -v parallel > /dev/null && parallel --version 2> /dev/null | grep -q "GNU parallel" ||
  { echo "skipped: no GNU parallel; apt-get install parallel"; exit 77; }
. "$(dirname "$0")/../apps/expect.sh"

export PARALLEL_HOME=$scratch/.parallel FORCESHADE=$scratch/worker
mkdir "$PARALLEL_HOME"
# As ssh does it, a shell on the host runs the words behind its name.
cat > .bin/ssh << END
#!/bin/sh
while [ "\$1" != elsewhere ]; do shift; done
shift
[ "\$1" = -- ] && shift
echo ssh >> $scratch/ssh.txt
exec sh -c "\$*"
END
printf '#!/bin/sh\nmkdir "%s/first" 2> /dev/null && kill -9 $$\nexec "%s" "$@"\n' "$scratch" "$forceshade" > worker
chmod +x .bin/ssh worker
export PATH=$scratch/.bin:$PATH
what=(--law wall --points 100000 --cases 50 --units 20 --lease 2)
"$forceshade" certify plan "${what[@]}" --out one > /dev/null && "$forceshade" certify work one > /dev/null &&
  "$forceshade" certify merge one --out one-merged > /dev/null || exit 1
"$forceshade" certify plan "${what[@]}" --out many > /dev/null
expect 0 "the plan is complete" -- "$scripts/over_ssh" many : elsewhere
[ -s ssh.txt ] || { echo "FAILED: no worker was started over ssh"; exit 1; }
expect 0 "held" -- "$forceshade" certify merge many --out many-merged
same "" "$(cmp many-merged/evidence.json one-merged/evidence.json 2>&1)"
echo "$checks checks"
