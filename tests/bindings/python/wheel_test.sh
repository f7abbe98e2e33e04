#!/bin/sh
# A wheel, the sources and the source distribution, made offline with what Debian has and installed by pip in virtual environments of
# their own: wheel_test.sh PYTHON SOURCES BUILD
set -eu
python=$1 sources=$2 build=$3
for module in ensurepip venv pip setuptools wheel; do
  "$python" -c "import $module" 2> /dev/null || { echo "skipped: Python's module $module is not installed"; exit 77; }
done
command -v patchelf > /dev/null || { echo "skipped: patchelf is not installed"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export FORCESHADE_BUILD="$build"
unset PYTHONPATH || true
listed() { ls -R "$sources/bindings/python"; ls -A "$sources"; }
before=$(listed)
works() {
  cd "$scratch"
  "$1/bin/python" -c "
import pathlib, re, numpy
def loaded(): return set(re.findall(r'/\S+\.so\S*', open('/proc/self/maps').read()))
before = loaded()
import forceshade
assert pathlib.Path(forceshade.__file__).is_relative_to('$1'), forceshade.__file__
assert (pathlib.Path(forceshade.__file__).parent / 'py.typed').exists()
bump = forceshade.Law('bump-2p', radius=15.24, width=25.4, stiffness=0.5)
assert bump.force(3, 0, -0.5) == (1.3490643501281738, 0.0, 2.5137453079223633), bump.force(3, 0, -0.5)
assert bump.forces(numpy.zeros((4, 3), numpy.float32)).shape == (4, 3)
# It loads libraries of its own alone, but for what each system with a Python has, and for Python's own modules.
others = [path for path in loaded() - before if not path.startswith('$1') and 'lib-dynload' not in path]
assert all(pathlib.Path(path).name.startswith(('libstdc++.', 'libgcc_s.')) for path in others), others
assert any('/libs/libgmp-' in path for path in loaded()), 'expected that it carries GMP'
assert list((pathlib.Path(forceshade.__file__).parent / 'libs').glob('libgmp*.copyright'))
"
}
installs() {  # NAME WHAT: in a virtual environment of this name
  "$python" -m venv --system-site-packages "$scratch/$1"
  (cd "$sources" && "$scratch/$1/bin/pip" install --no-build-isolation --no-index "$2")
  works "$scratch/$1"
}

installs of_sources .
(cd "$sources" && "$scratch/of_sources/bin/pip" wheel --no-build-isolation --no-index --no-deps --wheel-dir "$scratch/wheels" .)
installs of_wheel "$(ls "$scratch"/wheels/forceshade-*.whl)"
(cd "$sources" && "$python" -c "import setuptools.build_meta as backend, sys; backend.build_sdist(sys.argv[1])" "$scratch/dist")
installs of_distribution "$(ls "$scratch"/dist/forceshade-*.tar.gz)"

# The source distribution has every file that CMake looks for.
mkdir "$scratch/unpacked"
tar -xzf "$scratch"/dist/forceshade-*.tar.gz --strip-components 1 -C "$scratch/unpacked"
if git -C "$sources" rev-parse > /dev/null 2>&1; then
  for file in $(git -C "$sources" ls-files | grep -v '/node_modules/'); do
    case $file in .*) continue ;; esac
    [ -e "$scratch/unpacked/$file" ] || { echo "expected $file in the source distribution"; exit 1; }
  done
fi
cmake -S "$scratch/unpacked" -B "$scratch/compiled" -G Ninja -DBUILD_TESTING=OFF -DPython3_EXECUTABLE="$python" > "$scratch/configured"
ninja -C "$scratch/compiled" -n forceshade_python | tail -n 1

# The files that cmake --install puts below its prefix.
cmake --install "$build" --component python3-forceshade --prefix "$scratch/prefix"
PYTHONPATH=$(dirname "$(dirname "$(find "$scratch/prefix" -name 'py.typed')")")
export PYTHONPATH
cd "$scratch"
"$python" -c "import forceshade; assert forceshade.__file__.startswith('$scratch/prefix'); print(forceshade.Law('wall', stiffness=1))"
[ "$before" = "$(listed)" ] || { echo "expected nothing new among the sources"; exit 1; }
