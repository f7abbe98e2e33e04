#!/usr/bin/env bash
# same_page_test.sh BUILT.html STORED.html: the stored page has the bytes of the one that was built. Exits 77 where emscripten is not the
# version that has made the stored one.
set -eu
made_with=3.1.6
installed=$(em++ --version | sed -n '1s/.*) \([0-9.]*\).*/\1/p')
[ "$installed" = $made_with ] || { echo "skipped: emscripten is $installed; the page is made with $made_with"; exit 77; }
cmp "$1" "$2" || { echo "To renew it: cp $1 $2"; exit 1; }
