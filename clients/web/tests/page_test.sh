#!/usr/bin/env bash
# page_test.sh BROWSER PAGE.html FOLDER: runs page_test.js on the page in chromium, firefox or webkit. Pictures go to FOLDER/pictures.
set -eu
browser=$1 page=$(realpath "$2") folder=$3
here=$(cd "$(dirname "$0")" && pwd)
forces=$here/../../../tests/golden/bump_forces.csv
needs() { command -v "$1" > /dev/null || { echo "skipped: $1 is not there (Debian package $2)"; exit 77; }; }
under=()
case $browser in
  chromium) needs chromium chromium ;;
  firefox) needs firefox-esr firefox-esr ;;
  webkit) needs WebKitWebDriver webkit2gtk-driver; needs xvfb-run xvfb; under=(xvfb-run -a) ;;
  *) echo "page_test.sh: the browser is $browser; expected chromium, firefox or webkit"; exit 2 ;;
esac
mkdir -p "$folder/pictures"
exec "$here/../../with_npm.sh" "$here" "$folder" "${under[@]}" node "$here/page_test.js" "$browser" "$page" "$forces" "$folder/pictures"
