#!/usr/bin/env bash
# minimal_root_test.sh BUILD SOURCE: the packages are installed by apt into a new Debian that has nothing else, and serve there. Skipped
# without mmdebstrap, or where it cannot make a root (it needs to be root, and a Debian mirror).
set -eu
build=$1 source=$2
skip() { echo "skipped: $1"; exit 77; }
command -v mmdebstrap > /dev/null || skip "mmdebstrap is not there (Debian package mmdebstrap)"
[ "$(id -u)" = 0 ] || skip "only root can change into another root"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
(cd "$build" && cpack -G DEB -B "$scratch/packages" > "$scratch/said" 2>&1) || { cat "$scratch/said"; exit 1; }
mmdebstrap --variant=minbase --include=ca-certificates bookworm "$scratch/root" > "$scratch/said" 2>&1 ||
  { tail -5 "$scratch/said"; skip "no root could be made"; }
mkdir "$scratch/root/work"
cp "$scratch"/packages/*.deb "$source/tests/bindings/c_program.c" "$source/tests/install/consumer.cpp" \
  "$source/tests/install/CMakeLists.txt" "$scratch/root/work"
cp "$source"/tests/install/{heights,meshes,properties}_consumer.cpp "$scratch/root/work"
cp /etc/resolv.conf "$scratch/root/etc/" 2> /dev/null || true
inside() { chroot "$scratch/root" /bin/sh -ec "cd /work; export DEBIAN_FRONTEND=noninteractive; $1"; }
inside 'apt-get update -qq; apt-get install -y -qq --no-install-recommends ./*.deb > said 2>&1 || { tail said; exit 1; }'
inside 'forceshade certify --law all --out certificate > said || { cat said; exit 1; }; tail -1 said'
[ ! -d "$scratch/root/usr/lib/python3/dist-packages/forceshade" ] ||
  inside 'python3 -c "import forceshade; print(forceshade.Law(\"bump-2p\", radius=15.24, width=25.4, stiffness=0.5).force(3, 0, -0.5))"'
inside 'apt-get install -y -qq --no-install-recommends g++ gcc cmake make pkgconf > said 2>&1 || { tail said; exit 1; }'
inside 'cc -std=c11 c_program.c -o c_program $(pkg-config --cflags --libs forceshade-c); [ "$(./c_program)" = "2.51375 N, contact" ]'
inside 'c++ -std=c++20 consumer.cpp -o consumer $(pkg-config --cflags --libs forceshade); ./consumer > said'
inside 'cmake -S . -B build > said 2>&1 && cmake --build build >> said 2>&1 || { tail -20 said; exit 1; }; ./build/consumer'
