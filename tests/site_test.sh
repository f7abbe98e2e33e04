#!/usr/bin/env bash
# site_test.sh SOURCE BUILD: the site is built without a warning, and every link within it leads somewhere; it has the public names of C,
# and those of Python where the package for Python is in the build folder; it loads nothing from elsewhere, and its search finds a name.
set -eu
source=$1 build=$2
for needed in doxygen:doxygen mkdocs:mkdocs-material linkchecker:linkchecker; do
  command -v "${needed%:*}" > /dev/null || { echo "skipped: ${needed%:*} is not there (Debian package ${needed#*:})"; exit 77; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$source/scripts/site" "$scratch/site" "$build"
chmod -R a+rX "$scratch"  # linkchecker gives up the rights of root
linkchecker --no-status --output csv "$scratch/site/index.html" > "$scratch/links" 2> "$scratch/errors" ||
  { grep -v '^#' "$scratch/links" | cut -d';' -f1,2,4; exit 1; }
# A check that cannot fail shows nothing: a link that leads nowhere is found.
sed 's|href="docs/index.html"|href="docs/nowhere.html"|' "$scratch/site/index.html" > "$scratch/site/broken.html"
! linkchecker --no-status "$scratch/site/broken.html" > /dev/null 2>&1 || { echo "a broken link is not found"; exit 1; }
grep -q 'forceshade_certificate_covers' "$scratch/site/api/forceshade_8h.html" || { echo "a function lacks in the reference"; exit 1; }
! grep -rEl '<(script|img|link|iframe)[^>]* (src|href)="(https?:)?//' "$scratch/site" --include='*.html' ||
  { echo "a page loads a file from elsewhere"; exit 1; }

ls "$build"/python/forceshade/_forceshade*.so > /dev/null 2>&1 || { echo "this build has no package for Python"; exit 0; }
grep -q 'id="Session.resume"' "$scratch/site/docs/python-reference.html" || { echo "a method of Python lacks"; exit 1; }
if command -v chromium > /dev/null; then
  chromium --headless --no-sandbox --disable-gpu --user-data-dir="$scratch/browser" --virtual-time-budget=10000 --dump-dom \
    "file://$scratch/site/index.html?q=read_recording" > "$scratch/found" 2> /dev/null
  grep -q '<a href="[^"]*/docs/python-reference.html' "$scratch/found" || { echo "the search finds no name of Python"; exit 1; }
else
  echo "skipped: the search of the site, since chromium is not there (Debian package chromium)"
fi
# A check that cannot fail shows nothing: a method without a docstring is refused.
mkdir "$scratch/build"
cp -rL "$build/python" "$scratch/build"
sed -i '/"""Goes back to the beginning of a path."""/d' "$scratch/build/python/forceshade/_sessions.py"
! "$source/scripts/site" "$scratch/undocumented" "$scratch/build" > "$scratch/said" 2>&1 ||
  { echo "a method without a docstring is not found"; exit 1; }
grep -qx 'Session.reset has no docstring' "$scratch/said" || { cat "$scratch/said"; exit 1; }
# If the package is not built, its page is left out.
"$source/scripts/site" "$scratch/without" "$scratch/nowhere" | grep -q '^no reference of the package for Python'
! grep -rl python-reference "$scratch/without" || { echo "there are links to a page that is left out"; exit 1; }
