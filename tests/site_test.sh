#!/usr/bin/env bash
# site_test.sh SOURCE: the site is built without a warning, and every link within it leads somewhere.
set -eu
source=$1
for needed in doxygen:doxygen mkdocs:mkdocs-material linkchecker:linkchecker; do
  command -v "${needed%:*}" > /dev/null || { echo "skipped: ${needed%:*} is not there (Debian package ${needed#*:})"; exit 77; }
done
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$source/scripts/site" "$scratch/site"
chmod -R a+rX "$scratch"  # linkchecker gives up the rights of root
linkchecker --no-status --output csv "$scratch/site/index.html" > "$scratch/links" 2> "$scratch/errors" ||
  { grep -v '^#' "$scratch/links" | cut -d';' -f1,2,4; exit 1; }
# What cannot fail shows nothing: a link that leads nowhere is found.
sed 's|href="docs/index.html"|href="docs/nowhere.html"|' "$scratch/site/index.html" > "$scratch/site/broken.html"
! linkchecker --no-status "$scratch/site/broken.html" > /dev/null 2>&1 || { echo "a broken link is not found"; exit 1; }
grep -q 'forceshade_certificate_covers' "$scratch/site/api/forceshade_8h.html" || { echo "a function lacks in the reference"; exit 1; }
