#!/usr/bin/env bash
# page_test.sh BROWSER PAGE.html FOLDER: runs page_test.js on the page in chromium, firefox or webkit. npm brings what drives the first
# two to FOLDER/npm, by the hashes of package-lock.json; pictures go to FOLDER/pictures.
set -eu
browser=$1 page=$(realpath -m "$2") folder=$3
here=$(cd "$(dirname "$0")" && pwd)
skip() { echo "skipped: $1"; exit 77; }
needs() { command -v "$1" > /dev/null || skip "$1 is not there (Debian package $2)"; }
[ -f "$page" ] || skip "$page is not built: cmake --preset wasm && cmake --build --preset wasm makes it"
needs node nodejs
node -e 'process.exit(Number(process.versions.node.split(".")[0]) < 18 ? 1 : 0)' || skip "node $(node --version) is older than 18"
case $browser in
  chromium) needs chromium chromium ;;
  firefox) needs firefox-esr firefox-esr ;;
  webkit) needs WebKitWebDriver webkit2gtk-driver; needs xvfb-run xvfb ;;
  *) echo "page_test.sh: the browser is $browser; expected chromium, firefox or webkit"; exit 2 ;;
esac
mkdir -p "$folder/pictures"
folder=$(cd "$folder" && pwd)
under=
if [ "$browser" = webkit ]; then
  under="xvfb-run -a"
else
  needs npm npm
  (
    flock 9
    mkdir -p "$folder/npm"
    cd "$folder/npm"
    cmp -s "$here/package-lock.json" installed-lock.json && exit 0
    cp "$here/package.json" "$here/package-lock.json" .
    npm ci --ignore-scripts --no-audit --no-fund > npm.log 2>&1 || exit 1
    cp package-lock.json installed-lock.json
  ) 9> "$folder/npm.lock" || skip "npm cannot bring the packages of package-lock.json: $(tail -n 1 "$folder/npm/npm.log")"
fi
NODE_PATH=$folder/npm/node_modules $under node "$here/page_test.js" "$browser" "$page" "$here/../golden/bump_forces.csv" "$folder/pictures"
