#!/bin/sh
# The package's types by mypy --strict, and those of a program that uses it: types_test.sh PYTHON FOLDER
# CACHE, in which mypy keeps what it knows of other packages.
set -eu
python=$1 folder=$2 cache=$3
"$python" -m mypy --version > /dev/null 2>&1 || { echo "skipped: mypy is not installed"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
cat > program.py << 'END'
import numpy as np
import forceshade

law: forceshade.Law = forceshade.Law("wall", stiffness=0.5)
force: tuple[float, float, float] = law.force(0, np.float32(0.1), -1.5)
forces = law.forces(np.zeros((5, 3), np.float32), out=np.empty((5, 3), np.float32))
oil: forceshade.Damping = forceshade.Damping(rate=1000, damping=0.002, time=0.001)
status: forceshade.Status = forceshade.Session(law, damping=oil).status
damped = oil.steps(np.zeros((5, 3), np.float32), forces, periods=[1, 2, 1, 1, 1])
END
# A mistake is one: a keyword that does not exist, a law that does not exist.
sed 's/stiffness=0.5/stifness=0.5/' program.py > misspelt.py
sed 's/"wall"/"walls"/' program.py > no_law.py
MYPYPATH=$folder "$python" -m mypy --strict --cache-dir "$cache" -p forceshade -m program -m misspelt -m no_law > found && status=0 ||
  status=$?
cat found
for mistake in misspelt no_law; do
  [ $status = 1 ] && grep -q "^$mistake.py:4: error" found || { echo "expected mypy to find the mistake of $mistake.py"; exit 1; }
done
[ "$(grep -c error: found)" = 2 ] || { echo "expected mypy to find these two alone"; exit 1; }
