#!/bin/sh
# A wheel, made offline with what Debian has, and the sources, installed by pip in virtual environments of their own:
# wheel_test.sh PYTHON SOURCES BUILD
set -eu
python=$1 sources=$2 build=$3
for module in build venv pip setuptools wheel; do
  "$python" -c "import $module" 2> /dev/null || { echo "skipped: Python's module $module is not installed"; exit 77; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export FORCESHADE_BUILD="$build"
unset PYTHONPATH || true
before=$(ls -R "$sources/bindings/python")
works() {
  cd "$scratch"
  "$1/bin/python" -c "
import forceshade, numpy, pathlib
assert pathlib.Path(forceshade.__file__).is_relative_to('$1'), forceshade.__file__
assert (pathlib.Path(forceshade.__file__).parent / 'py.typed').exists()
bump = forceshade.Law('bump-2p', radius=15.24, width=25.4, stiffness=0.5)
assert bump.force(3, 0, -0.5) == (1.3490643501281738, 0.0, 2.5137453079223633), bump.force(3, 0, -0.5)
assert bump.forces(numpy.zeros((4, 3), numpy.float32)).shape == (4, 3)
"
}

(cd "$sources/bindings/python" && "$python" -m build --no-isolation --wheel --outdir "$scratch/wheels" .)
ls "$scratch/wheels"
"$python" -m venv --system-site-packages "$scratch/of_wheel"
"$scratch/of_wheel/bin/pip" install --no-index "$scratch"/wheels/forceshade-*.whl
works "$scratch/of_wheel"

"$python" -m venv --system-site-packages "$scratch/of_sources"
(cd "$sources/bindings/python" && "$scratch/of_sources/bin/pip" install --no-build-isolation --no-index .)
works "$scratch/of_sources"

# What cmake --install puts below its prefix.
cmake --install "$build" --component python3-forceshade --prefix "$scratch/prefix"
PYTHONPATH=$(dirname "$(dirname "$(find "$scratch/prefix" -name 'py.typed')")")
export PYTHONPATH
cd "$scratch"
"$python" -c "import forceshade; assert forceshade.__file__.startswith('$scratch/prefix'); print(forceshade.Law('wall', stiffness=1))"
[ "$before" = "$(ls -R "$sources/bindings/python")" ] || { echo "expected nothing new among the sources"; exit 1; }
