#!/usr/bin/env bash
# same_packages_test.sh SOURCE: two builds of the same sources in two folders give the same packages, byte for byte.
set -eu
source=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export SOURCE_DATE_EPOCH=1790000000 CCACHE_DISABLE=1
for folder in one another/with/a/longer/name; do
  mkdir -p "$scratch/$folder"
  git -C "$source" ls-files -z | (cd "$source" && xargs -0 cp -p --parents -t "$scratch/$folder")
  cmake -S "$scratch/$folder" -B "$scratch/$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O3 \
    -DBUILD_TESTING=OFF > "$scratch/log"
  cmake --build "$scratch/$folder/build" > "$scratch/log" || { tail -30 "$scratch/log"; exit 1; }
  (cd "$scratch/$folder/build" && cpack -G DEB -B packages > "$scratch/log" 2>&1) || { cat "$scratch/log"; exit 1; }
  rm -rf "$scratch/$folder/build/packages/_CPack_Packages"
  (cd "$scratch/$folder/build/packages" && sha256sum ./*.deb) > "$scratch/sums-${folder%%/*}"
done
cat "$scratch/sums-one"
diff "$scratch/sums-one" "$scratch/sums-another"
