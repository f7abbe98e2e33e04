#!/usr/bin/env bash
# abi_test.sh LIBRARY DESCRIPTION STRUCT FUNCTION OFFSET: the functions and types of the shared library are those of the committed
# description, but for functions that were added. scripts/abi writes the description again, which a change of the major version alone
# may need. STRUCT and FUNCTION are some of the library, and OFFSET is that of a member, in bits: a change of each has to be seen.
set -eu
library=$1 description=$2 struct=$3 function=$4 offset=$5
command -v abidiff > /dev/null || { echo "skipped: abidiff is not there (Debian package abigail-tools)"; exit 77; }
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
compare() {  # 0 where it is the same, 4 to 15 where it is not (abidiff(1)); other numbers are no answer
  local code=0
  abidiff --exported-interfaces-only --no-added-syms "$1" "$library" > "$scratch/said" 2>&1 || code=$?
  [ $code -eq 0 ] || { [ $code -ge 4 ] && [ $code -le 15 ]; } || { echo "abidiff failed ($code) on $2:"; cat "$scratch/said"; exit 1; }
  return $code
}
compare "$description" "the library" || { echo "the binary interface has changed:"; cat "$scratch/said"; exit 1; }
# A change is a type of a parameter, a member that a struct loses, a function that is gone.
changed() {  # what, the sed expression
  sed "$2" "$description" > "$scratch/changed.abi"
  ! cmp -s "$description" "$scratch/changed.abi" || { echo "nothing was changed: $1"; exit 1; }
  ! compare "$scratch/changed.abi" "$1" || { echo "abidiff does not see $1"; exit 1; }
}
changed "that a struct was smaller" "/class-decl name='$struct'/s/size-in-bits='[0-9]*'/size-in-bits='64'/"
changed "that a function was there" "s/$function/${function}_no_more/"
changed "that a member lay elsewhere" "s/layout-offset-in-bits='$offset'/layout-offset-in-bits='$((offset + 32))'/"
float=$(sed -n "s/.*<type-decl name='float' .* id='\([^']*\)'.*/\1/p" "$description")
changed "that a status was a float" "/<typedef-decl name='forceshade_status'/s/type-id='[^']*'/type-id='$float'/"
