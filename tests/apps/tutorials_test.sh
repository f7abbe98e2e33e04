#!/usr/bin/env bash
# tutorials_test.sh FORCESHADE SOURCE [PYTHON PACKAGES]: a reader can type each page of docs/tutorials/ in the folder of the sources,
# and sees what the page prints. PYTHON finds the package forceshade in the folder PACKAGES; without them the page that needs it is left
# out. Nothing is built: blocks of the language console show what a changed build printed. Loops do not wait for the clock, but that of
# the mouse, which ends after a second. Where no display can be had, a device at rest takes its place.
set -u
. "$(dirname "$0")/page.sh"
forceshade=$(realpath "$1") source=$(realpath "$2") python=${3:-} packages=${4:+$(realpath "$4")}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
if [ -n "$python" ]; then
  PATH=$(dirname "$python"):$PATH
elif ! python3 -c 'import numpy' 2> /dev/null; then
  PATH=/usr/bin:$PATH  # Debian's, which has NumPy
fi
display=$source/tests/window/under_xvfb.sh device=mouse pages=0
"$display" true || { display= device=null; }

for page in "$source"/docs/tutorials/*.md; do
  name=$(basename "$page")
  if [ -z "$packages" ] && grep -q PYTHONPATH "$page"; then
    echo "skipped: $name, because this build has no package for Python"
    continue
  fi
  mkdir -p "$scratch/$name/build/release/apps"
  cd "$scratch/$name"
  ln -s "$forceshade" build/release/apps/forceshade
  [ -z "$packages" ] || ln -s "$packages" build/release/python
  ln -s "$source/examples" examples
  cp -r "$source/fast" .
  sed -e '/^scripts\//d' -e "s|^forceshade drive .* --device mouse .*|$display & --seconds 1|" -e "s| --device mouse | --device $device |" \
    -e 's/^forceshade drive /&--pace none /' "$page" > page
  what=$(type_page page) || { echo "$name: $what"; exit 1; }
  echo "$name: $what"
  case $what in *", "[0-2]" blocks "*) echo "FAILED: $name has hardly a command"; exit 1 ;; esac
  pages=$((pages + 1))
done
[ "$pages" -ge 4 ] || { echo "FAILED: found only $pages pages"; exit 1; }
