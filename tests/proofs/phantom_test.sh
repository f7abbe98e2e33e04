#!/usr/bin/env bash
# phantom_test.sh ENDING_TABLE MODEL: spin shows the claims of the model, and finds what is wrong in models that are.
# Exit code 77 without spin.
set -euo pipefail
table=$1 model=$2
command -v spin > /dev/null && command -v gcc > /dev/null ||
  { echo "skipped: spin (Debian's package spin) or gcc is not installed"; exit 77; }
there=$(mktemp -d)
trap 'rm -rf "$there"' EXIT
cd "$there"
cp "$model" model.pml

"$table" > ending.pml
spin -a model.pml > spin.log 2>&1 && gcc -O0 -w -o pan pan.c || { cat spin.log; exit 1; }
# found CLAIM: the number of errors that the checker finds.
found() {
  ./pan -a -f -m100000 -N "$1" > pan.log 2>&1
  sed -n 's/.*errors: \([0-9]*\)$/\1/p' pan.log
}
failed=0
expect() {  # CLAIM SHOWN|REFUSED WORDS
  local errors states
  errors=$(found "$1")
  states=$(sed -n 's/^ *\([0-9]*\) states, stored.*/\1/p' pan.log)
  grep -q "max search depth too small" pan.log && errors=unknown
  echo "$3: $1: $errors errors, $states states"
  if [ "$2" = SHOWN ] && [ "$errors" != 0 ] || [ "$2" = REFUSED ] && ! [ "$errors" -gt 0 ]; then
    echo "  FAILED: expected to be ${2,,}"
    failed=1
  fi
}

for claim in gone soon after; do expect $claim SHOWN "the model"; done
expect still_is_zero REFUSED "what no software does"
WRONG=1 expect soon REFUSED "an order is obeyed for ever"
WRONG=2 expect after REFUSED "the port stays open at the end"
WRONG=3 expect gone REFUSED "nobody watches"
WRONG=4 expect gone REFUSED "nobody is interrupted"
WRONG=5 expect gone REFUSED "no way out for a call that no signal ends"
exit $failed
