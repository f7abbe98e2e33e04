#!/usr/bin/env bash
# Installs the build into a fresh prefix and uses it as strangers would: with find_package, with pkg-config, header by header.
set -eu
build=$1 compiler=$2 flags=$3
source=$(cd "$(dirname "$0")" && pwd)
examples=$(cd "$source/../../examples" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
prefix=$scratch/prefix
cmake --install "$build" --prefix "$prefix" > "$scratch/install.log"
fail() { echo "$1" >&2; exit 1; }

use() {  # the four consumers of a folder
  "$1/consumer"
  "$1/heights_consumer" "$examples/leather.toml"
  "$1/meshes_consumer" "$scratch/tetrahedron.off" > "$scratch/meshes.log" 2>&1 || { cat "$scratch/meshes.log"; exit 1; }
  "$1/properties_consumer" > "$scratch/properties.log" 2>&1 || { cat "$scratch/properties.log"; exit 1; }
}

printf 'OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' > "$scratch/tetrahedron.off"

echo "== find_package"
cmake -S "$source" -B "$scratch/build" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_BUILD_TYPE=Release > "$scratch/configure.log"
cmake --build "$scratch/build" > "$scratch/build.log" || { cat "$scratch/build.log"; exit 1; }
use "$scratch/build"

echo "== pkg-config"
pc=$(dirname "$(find "$prefix" -name forceshade.pc)")
mkdir "$scratch/by-pc"
for consumer in consumer:forceshade heights_consumer:forceshade-heights "meshes_consumer:forceshade-meshes forceshade-properties" \
  properties_consumer:forceshade-properties; do
  # shellcheck disable=SC2086  # names are words
  needed=$(PKG_CONFIG_PATH=$pc pkg-config --cflags --libs ${consumer#*:})
  # shellcheck disable=SC2086  # flags are words
  "$compiler" -std=c++20 -O1 $flags "$source/${consumer%:*}.cpp" -o "$scratch/by-pc/${consumer%:*}" $needed
done
use "$scratch/by-pc"

echo "== examples/programs"
cmake -S "$examples/programs" -B "$scratch/programs" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_BUILD_TYPE=Release > "$scratch/configure.log"
cmake --build "$scratch/programs" > "$scratch/build.log" || { cat "$scratch/build.log"; exit 1; }
"$scratch/programs/certify" "$scratch/wall.json"
said=$("$prefix/bin/forceshade" drive --law wall --stiffness 0.5N/mm --certificate "$scratch/wall.json" --device null --seconds 0.1 2>&1) &&
  fail "the library's wall was driven with the certificate of a program's"
case $said in *"is of a program's own renderer for wall"*) ;; *) fail "expected whose renderer it is, got: $said" ;; esac
"$prefix/bin/forceshade" certify --law bump-2p --radius 15.24mm --width 25.4mm --stiffness 0.5N/mm --out "$scratch/bump" \
  > "$scratch/certify.log"
refusal=$("$scratch/programs/drive" "$scratch/wall.json" null "$scratch/refused.fsr") && fail "a bump was driven with a wall's certificate"
case $refusal in "refused: "*) ;; *) fail "expected a refusal, got: $refusal" ;; esac
"$scratch/programs/drive" "$scratch/bump/certificate.json" "replay:$examples/recordings/strokes.csv" "$scratch/run.fsr"
"$prefix/bin/forceshade" recording check "$scratch/run.fsr" > "$scratch/verify.log" || { cat "$scratch/verify.log"; exit 1; }
# A program that drives a device links nothing of the exact side.
! ldd "$scratch/programs/drive" | grep -E 'gmp|mpfr|mpfi|CGAL' || fail "the program that drives links a library of the exact side"
! nm -C "$scratch/programs/drive" | grep -E 'CGAL::|rc::|forceshade::reference' || fail "the program that drives holds exact code"

echo "== C"
# shellcheck disable=SC2046  # flags are words
cc -std=c11 -Wall -Wextra -Wpedantic -Werror "$source/../bindings/c_program.c" -o "$scratch/c_program" \
  $(PKG_CONFIG_PATH=$pc pkg-config --cflags --libs forceshade-c)
[ "$(LD_LIBRARY_PATH=$(dirname "$pc") "$scratch/c_program")" = "2.51375 N, contact" ] || fail "the program in C gives another force"
cmake -S "$source/c" -B "$scratch/c" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release > "$scratch/configure.log"
cmake --build "$scratch/c" > "$scratch/build.log" || { cat "$scratch/build.log"; exit 1; }
"$scratch/c/c_program" > "$scratch/log" || { cat "$scratch/log"; exit 1; }
# shellcheck disable=SC2046  # flags are words
cc -std=c11 -Wall -Wextra -Wpedantic -Werror "$source/../bindings/reference_program.c" -o "$scratch/reference_program" \
  $(PKG_CONFIG_PATH=$pc pkg-config --cflags --libs forceshade-reference)
for program in "env LD_LIBRARY_PATH=$(dirname "$pc") $scratch/reference_program" "$scratch/c/reference_program"; do
  $program "$scratch/exact.json" > "$scratch/log" || { cat "$scratch/log"; fail "the program of the exact side fails"; }
  grep -q '^1.3490643153346555443 0 2.5137452088061372488 N$' "$scratch/log" || { cat "$scratch/log"; fail "it gives another force"; }
done

echo "== shared object"
# Every object of these libraries has to be position independent, not only those that the plugin calls.
libraries=$(dirname "$pc")
# shellcheck disable=SC2046,SC2086  # flags are words
"$compiler" -std=c++20 -O1 $flags -shared -fPIC "$source/plugin.cpp" -o "$scratch/plugin.so" \
  $(PKG_CONFIG_PATH=$pc pkg-config --cflags forceshade) -Wl,-z,defs -Wl,--whole-archive \
  "$libraries"/libforceshade_{fast,files,toml,device,heights,meshes,subjects,identity,renderer}.a \
  "$libraries"/libforceshade_{certificate,recorder,run,reference,properties,certify}.a -Wl,--no-whole-archive \
  $(PKG_CONFIG_PATH=$pc pkg-config --libs forceshade-subjects forceshade-properties)
# shellcheck disable=SC2086
"$compiler" -std=c++20 $flags "$source/plugin_loader.cpp" -o "$scratch/plugin_loader" -ldl
"$scratch/plugin_loader" "$scratch/plugin.so"
# The rest are templates of the C++ library with types of this one.
! nm -D -C --defined-only "$scratch/plugin.so" | grep -E '^[0-9a-f]+ . ((vtable|typeinfo|typeinfo name) for )?forceshade::' ||
  fail "the plugin shows functions of the libraries in it"

echo "== the sources inside another project, which has them twice and compiles its own files together"
cmake -S "$source/inside" -B "$scratch/inside" -G Ninja -DCMAKE_UNITY_BUILD=ON \
  -DFORCESHADE_SOURCES="$source/../.." -DCMAKE_CXX_COMPILER="$compiler" \
  -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_BUILD_TYPE=Release > "$scratch/configure.log" 2>&1 || { cat "$scratch/configure.log"; exit 1; }
! grep -E '^(BUILD_TESTING|CMAKE_INSTALL_LIBDIR|CPACK_[A-Z_]*):' "$scratch/inside/CMakeCache.txt" ||
  fail "it sets what belongs to the other project"
! ninja -C "$scratch/inside" -t commands all | grep -E '/tests/[a-z_]*/CMakeFiles|/apps/|/python/' ||
  fail "the other project builds more than it links"
ninja -C "$scratch/inside" -t targets all | grep -q 'fast_objects.dir/law.cpp.o:' ||
  fail "the objects that a certificate counts are compiled together"
object=$(ninja -C "$scratch/inside" -t targets all | sed -n 's/^\([^ ]*consumer\.cpp\.o\):.*/\1/p')
# The last command compiles the consumer; those before it compile the libraries, once more.
mkdir -p "$(dirname "$scratch/inside/$object")"
ninja -C "$scratch/inside" -t commands "$object" | tail -n 1 > "$scratch/command"
(cd "$scratch/inside" && sh "$scratch/command") > "$scratch/log" 2>&1 || { cat "$scratch/log"; fail "its headers are not found"; }
[ -s "$scratch/inside/$object" ] || fail "the consumer was not compiled"
# shellcheck disable=SC2046  # flags are words
echo '#include <forceshade/fast.h>' | "$compiler" -std=c++17 -fsyntax-only \
  $(PKG_CONFIG_PATH=$pc pkg-config --cflags forceshade) -x c++ - 2>&1 |
  grep -q 'forceshade is in C++20: expected -std=c++20 or later' || fail "a program in C++17 gets no reason"

echo "== headers"
# The public headers and nothing else are installed, but for the clients' kit; each compiles by itself from the installed tree, and so
# does its example.
include=$(dirname "$(find "$prefix" -type d -name forceshade -path '*include*')")
(cd "$source/../../include" && find forceshade -type f) | LC_ALL=C sort > "$scratch/public"
(cd "$include" && find ./forceshade -type f -not -path "./forceshade/kit/*") | sed 's|^./||' | LC_ALL=C sort > "$scratch/installed"
diff "$scratch/public" "$scratch/installed" || fail "installed headers (>) are not those of include/ (<)"
[ "$(wc -l < "$scratch/public")" -ge 12 ] || fail "expected 12 public headers or more"
eigen=$(pkg-config --cflags eigen3)
while read -r header; do
  echo "#include <$header>" > "$scratch/alone.cpp"
  # shellcheck disable=SC2086
  "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Werror ${eigen//-I/-isystem} -I"$include" "$scratch/alone.cpp" ||
    fail "$header does not compile by itself"
  {
    for other in $(cat "$scratch/public") algorithm cstdio; do echo "#include <$other>"; done
    echo "using namespace forceshade; void example() {"
    sed -n '/^$/q; s|^//   |  |p' "$include/$header"
    echo "}"
  } > "$scratch/example.cpp"
  [ "$(wc -l < "$scratch/example.cpp")" -ge $(($(wc -l < "$scratch/public") + 7)) ] || fail "$header does not begin with an example"
  # shellcheck disable=SC2086
  "$compiler" -std=c++20 -fsyntax-only -Wall -Wextra -Werror -Wno-unused ${eigen//-I/-isystem} -I"$include" "$scratch/example.cpp" ||
    fail "the example of $header does not compile"
done < "$scratch/public"

echo "== uninstall"
mkdir "$scratch/uninstall"
find "$scratch/by-pc" -type f > "$scratch/uninstall/install_manifest.txt"
(cd "$scratch/uninstall" && cmake -P "$source/../../cmake/uninstall.cmake") > "$scratch/log" 2>&1 || { cat "$scratch/log"; exit 1; }
[ -z "$(find "$scratch/by-pc" -type f)" ] || fail "uninstall leaves files"
! (cd "$scratch/uninstall" && cmake -P "$source/../../cmake/uninstall.cmake") > "$scratch/log" 2>&1 ||
  fail "nothing was installed, and uninstall does not say so"
grep -q 'expected install_manifest.txt in the build folder' "$scratch/log" || { cat "$scratch/log"; fail "uninstall does not say why"; }

echo "== the rest"
[ -s "$prefix/share/doc/forceshade/LICENSE" ] || fail "no licence file is installed"
[ "$("$prefix/bin/forceshade" --version)" = "$("$build/apps/forceshade" --version)" ] || fail "the installed command has another digest"
for file in man/man1/forceshade.1 man/man1/forceshade-device-check.1 bash-completion/completions/forceshade; do
  [ -s "$prefix/share/$file" ] || fail "share/$file was not installed"
done
