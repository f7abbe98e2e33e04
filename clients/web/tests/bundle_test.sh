#!/usr/bin/env bash
# bundle_test.sh SCRIPT, which is bundle.py: the same inputs give the same bytes; an end of a script within a script is escaped; a page
# that is too large is refused, and so is a missing argument.
set -eu
bundle=$1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
fail() { echo "$1"; exit 1; }
echo 'const tail = "</script>", head = "<!-- \u2028 é";' > "$scratch/library.js"
"$bundle" "$scratch/library.js" "$scratch/one.html" > "$scratch/said"
"$bundle" "$scratch/library.js" "$scratch/two.html" > /dev/null
cmp "$scratch/one.html" "$scratch/two.html"
grep -qx "$scratch/one.html: $(stat -c %s "$scratch/one.html") bytes" "$scratch/said" || fail "the size is not told: $(cat "$scratch/said")"
grep -qF 'const tail = "\x3c/script>", head = "\x3c!-- \u2028 é";' "$scratch/one.html" || fail "the end of a script is not escaped"
[ "$(grep -c '^<script>$' "$scratch/one.html")" = 8 ] || fail "there are not eight scripts"
[ "$(grep -c '</script>$' "$scratch/one.html")" = 8 ] || fail "there are not eight ends of scripts"
! grep -E '@(scripts|page\.css)@' "$scratch/one.html" || fail "a mark is not replaced"
! grep -E '(src|href)="?[^"d]' "$scratch/one.html" || fail "the page names another file"
head -c 1000000 /dev/zero | tr '\0' ' ' > "$scratch/large.js"
! "$bundle" "$scratch/large.js" "$scratch/large.html" 2> "$scratch/said" || fail "a page of more than 1 MB is written"
grep -q 'expected at most 1000000$' "$scratch/said" || fail "$(cat "$scratch/said")"
[ ! -e "$scratch/large.html" ] || fail "a page of more than 1 MB is there"
! "$bundle" "$scratch/library.js" 2> "$scratch/said" || fail "a missing argument is not refused"
grep -qx 'bundle.py: 1 arguments; expected FORCESHADE.js OUT.html' "$scratch/said" || fail "$(cat "$scratch/said")"
