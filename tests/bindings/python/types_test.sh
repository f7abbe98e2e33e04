#!/bin/sh
# The package's types by mypy --strict, and those of a program that uses it: types_test.sh PYTHON FOLDER
set -eu
python=$1 folder=$2
"$python" -m mypy --version > /dev/null 2>&1 || { echo "skipped: mypy is not installed"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$python" -m mypy --strict --cache-dir "$scratch/cache" "$folder/forceshade"
cat > "$scratch/program.py" << 'END'
import numpy as np
import forceshade

law: forceshade.Law = forceshade.Law("wall", stiffness=0.5)
force: tuple[float, float, float] = law.force(0, np.float32(0.1), -1.5)
forces = law.forces(np.zeros((5, 3), np.float32), out=np.empty((5, 3), np.float32))
status: forceshade.Status = forceshade.Session(law).status
END
cd "$scratch"
MYPYPATH=$folder "$python" -m mypy --strict --cache-dir cache program.py
# A mistake is one: a keyword that does not exist, a law that does not exist.
for mistake in 's/stiffness=0.5/stifness=0.5/' 's/"wall"/"walls"/'; do
  sed "$mistake" program.py > mistake.py
  if MYPYPATH=$folder "$python" -m mypy --strict --cache-dir cache mistake.py; then
    echo "expected mypy to find the mistake of $mistake"
    exit 1
  fi
done
