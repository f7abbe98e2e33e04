#!/usr/bin/env bash
# packages_test.sh BUILD SOURCE: the Debian packages of this build are accepted by lintian, where it is installed; unpacked, they
# serve the command and programs in C and C++, and have the site, where the tools for it are installed; they name no folder of this
# machine, and are the same bytes when made again.
set -eu
build=$1 source=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "$1"; cat "$scratch/said" 2> /dev/null; exit 1; }
export SOURCE_DATE_EPOCH=1790000000
for made in first second; do
  mkdir "$scratch/$made"
  (cd "$build" && cpack -G DEB -B "$scratch/$made" > "$scratch/said" 2>&1) || fail "cpack failed"
  cp "$scratch/said" "$scratch/cpack_said"
  rm -rf "$scratch/$made/_CPack_Packages"
done
diff -r "$scratch/first" "$scratch/second" || fail "made again, the packages are other bytes"

if command -v lintian > /dev/null; then
  lintian --allow-root --fail-on error,warning "$scratch"/first/*.deb > "$scratch/said" 2>&1 || fail "lintian refuses the packages"
  echo "lintian: no error and no warning but those overridden"
else
  echo "skipped: lintian is not there (Debian package lintian)"
fi

root=$scratch/root
for package in "$scratch"/first/*.deb; do
  dpkg-deb -x "$package" "$root"
  name=$(dpkg-deb -f "$package" Package)
  [ -s "$root/usr/share/doc/$name/copyright" ] || fail "$name has no copyright file"
done
! grep -rl -e "$source" -e "$build" "$root" > "$scratch/said" || fail "files name a folder of this machine"
if grep -q '^no package forceshade-doc' "$scratch/cpack_said"; then
  echo "skipped: the package of the site, since doxygen or mkdocs-material is not there"
else
  [ "$(dpkg-deb -f "$scratch"/first/forceshade-doc_*.deb Architecture)" = all ] || fail "the site is of one architecture"
  index=$(sed -n 's/^Index: //p' "$root/usr/share/doc-base/forceshade-doc.forceshade")
  [ -s "$root$index" ] || fail "the site is not where doc-base looks for it"
fi

"$root/usr/bin/forceshade" certify --law bump-2p --radius 15.24mm --width 25.4mm --stiffness 0.5N/mm --out "$scratch/bump" \
  > "$scratch/said" ||
  fail "the command does not certify"
zcat "$root/usr/share/man/man1/forceshade-certify.1.gz" | grep -q '^\.SH EXAMPLES' || fail "a page of the manual has no examples"
lib=$(dirname "$(find "$root" -name libforceshade.so.0)")
export PKG_CONFIG_PATH=$lib/pkgconfig LD_LIBRARY_PATH=$lib
# The programs of docs/in-your-program.md.
program() {  # the language, and which of its programs
  awk -v fence="\`\`\`$1" -v which="$2" '$0 == fence { on = ++found == which; next } /^```/ { on = 0 } on' "$source/docs/in-your-program.md"
}
program c 1 > "$scratch/force.c"
program c 2 > "$scratch/exact.c"
program cpp 1 > "$scratch/force.cpp"
# shellcheck disable=SC2046  # flags are words
cc -std=c11 -Wall -Wextra -Werror "$scratch/force.c" -o "$scratch/in_c" $(pkg-config --cflags --libs forceshade-c)
# shellcheck disable=SC2046
cc -std=c11 -Wall -Wextra -Werror "$scratch/exact.c" -o "$scratch/exact" $(pkg-config --cflags --libs forceshade-reference)
[ "$("$scratch/exact")" = "1.3490643153346555443 0 2.5137452088061372488 N" ] || fail "the exact force is another"
# shellcheck disable=SC2046
c++ -std=c++20 -Wall -Wextra -Werror "$scratch/force.cpp" -o "$scratch/in_cpp" $(pkg-config --cflags --libs forceshade)
mkdir "$scratch/cmake"
{ echo 'cmake_minimum_required(VERSION 3.25)'; echo 'project(force LANGUAGES CXX)'; program cmake 1; } > "$scratch/cmake/CMakeLists.txt"
cp "$scratch/force.cpp" "$scratch/cmake"
{ cmake -S "$scratch/cmake" -B "$scratch/cmake/build" -DCMAKE_PREFIX_PATH="$root/usr" && cmake --build "$scratch/cmake/build"; } \
  > "$scratch/said" 2>&1 || fail "the program is not built by CMake"
for made in in_c in_cpp cmake/build/force; do
  [ "$("$scratch/$made")" = "2.51375 N" ] || fail "$made gives another force"
done
site=$root/usr/lib/python3/dist-packages
if [ -d "$site" ]; then
  PYTHONPATH=$site PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 -c 'import forceshade
bump = forceshade.Law("bump-2p", radius=15.24, width=25.4, stiffness=0.5)
print("%g N" % bump.force(3, 0, -0.5)[2])' > "$scratch/said" 2>&1 || fail "the package for Python is not loaded"
  [ "$(cat "$scratch/said")" = "2.51375 N" ] || fail "Python gives another force"
else
  echo "this build has no package for Python"
fi
