#!/usr/bin/env bash
# proofs_test.sh GAPPA SOURCE_DIR [store | SCRIPT...]: runs every Gappa script in fast/, or those named. Each interval that Gappa prints
# must be the one stored beside the script, and must imply the constant in the header: neither exceed it nor leave it idle by more than 4.
# A script holds definitions and then pieces; a piece ("#! piece NAME") is a proposition of its own over the definitions.
# A piece whose name begins with sign_ proves no more than a sign: its relative error must be below 1. One whose name begins with
# share_ compares a part of an error with what the header charges for it: below 1, less the few roundings of their sum. One whose name
# begins with part_ is only for other pieces to use.
# "# from FILE PREFIX" after a hypothesis: it follows from the bounds of those pieces, and that is checked too.
# A rewriting of a script must be proved too: see prove below, and tests/fast/coq_test.sh.
# With "store" the intervals are written instead of compared.
set -euo pipefail
. "$(dirname "$0")/gappa_pieces.sh"
gappa=$1
fast=$2/fast
store=
only=("${@:3}")
[ "${3:-}" != store ] || store=store only=()
failures=0
out=$(mktemp)
trap 'rm "$out"' EXIT

fail() { echo "FAILED: $*"; failures=$((failures + 1)); }

# The lines of all pieces, and what Gappa took for granted: that a denominator is not 0 (the conditions of a rewriting stand in braces
# behind it, and Gappa then proves them; that they suffice is for Coq to say), or that a rewriting is an identity which it could not
# see to be one (marked "# by Coq").
prove() {  # script
  local name
  pieces_of "$1" | while read -r name; do
    piece "$1" "$name" | "$gappa" >"$out" 2>&1
    intervals "$name" <"$out"
    sed -n "s/^Warning: the expression \(.*\) has been assumed to be nonzero.*/$name: Assumed: \1 is not 0/p" "$out"
    [ "$(grep -c 'not trivially equal' "$out")" = "$(piece_text "$1" "$name" | grep -c '# by Coq$')" ] ||
      sed -n "s/^Warning: \(.*\) are not trivially equal.*/$name: Assumed: \1 are equal/p" "$out"
  done
}

# The largest size of the ends of the intervals of pieces that match.
largest() {  # stored file, regular expression
  awk -v pieces="^$2" '
    $0 ~ pieces && /: .* in \[/ {
      sub(/.* in \[/, ""); gsub(/[\] ]/, "")
      count = split($0, ends, ",")
      for (i = 1; i <= count; ++i) {
        size = ends[i] + 0
        if (size < 0) size = -size
        if (size > most) most = size
      }
      found = 1
    }
    END { if (found) printf "%g\n", most; else print "none" }' "$1"
}

constant() {  # header, name
  local value
  value=$(sed -n "s/.*constexpr double $2 = \([^;]*\);.*/\1/p" "$1")
  case $value in
    "Cylinder::"*) constant "$fast/laws/cylinder.h" "$2" ;;
    "2 * Cylinder::"*) awk -v c="$(constant "$fast/laws/cylinder.h" "$2")" 'BEGIN {printf "%.17g\n", 2 * c}' ;;
    "") constant "$fast/laws/wall.h" "$2" ;;  # bump-1p is the wall
    *) printf '%.17g\n' "$value" ;;
  esac
}

at_most() { awk -v a="$1" -v b="$2" 'BEGIN {exit !(a != "none" && a * (1 + 1e-5) <= b)}'; }

check() {  # script's basename, bound that its intervals must imply, or "" if only others use it
  local script stored proved bound=$2 most line
  [ ${#only[@]} = 0 ] || [[ " ${only[*]} " == *" $1 "* ]] || return 0
  script=$(echo "$fast"/*/"$1.g") stored=${script%.g}.gappa-expected
  [ -f "$script" ] || { fail "$1: no proof, $1.g is missing in fast/"; return; }
  proved=$(prove "$script")
  [ -z "$store" ] || printf '%s\n' "$proved" >"$stored"
  [ "$(printf '%s\n' "$proved" | cut -d: -f1 | sort -u)" = "$(pieces_of "$script" | sort)" ] ||
    fail "$1: a piece proved nothing"
  ! grep ': Assumed: ' <<<"$proved" || fail "$1: Gappa took for granted what is printed above"
  [ "$proved" = "$(cat "$stored")" ] ||
    { fail "$1: the proved intervals are not the stored ones"; diff <(printf '%s\n' "$proved") "$stored" || true; }
  while read -r line; do
    read -r from prefix <<<"${line##*# from }"
    line=$(sed 's/.*<= \([^ ]*\) .*/\1/' <<<"$line")
    at_most "$(largest "$(echo "$fast"/*/"$from.gappa-expected")" "$prefix")" "$(printf '%.17g' "$line")" ||
      fail "$1: the hypothesis $line is not proved by $from $prefix"
  done < <(grep '# from ' "$script" | grep -v '^#')
  at_most "$(grep -q '^sign_' "$stored" && largest "$stored" sign_ || echo 0)" 0.999 || fail "$1: a sign is not proved"
  at_most "$(grep -q '^share_' "$stored" && largest "$stored" share_ || echo 0)" 0.9999 || fail "$1: a part of an error is not covered"
  most=$(largest <(grep -Ev '^(sign|share|part)_' "$stored") "")
  if [ -z "$bound" ]; then
    echo "$1: proved $most"
  elif ! at_most "$most" "$bound"; then
    fail "$1: proved $most, which does not imply the header's $bound"
  elif ! at_most "$bound" "$(awk -v most="$most" 'BEGIN {printf "%.17g", 4.1 * most}')"; then
    fail "$1: the header's $bound is idle, $most is proved"
  else
    echo "$1: proved $most, header $bound"
  fi
}

check polygon_gap ""
check bump_form ""
check cylinder_form "$(constant "$fast/simd/cylinder_form.inl" kErrorBound)"
check double_double "$(constant "$fast/numbers/double_double.h" kRelativeError)"
check spline "$(constant "$fast/heights/spline.h" kSplineError)"
check decide ""
check grid_parameters ""
check damping "$(constant "$fast/damping/filter.h" kDampingError)"
check force "$(constant "$fast/heights/force.h" kHeightForceError)"
laws=$(sed -n 's/.*{LawId::[a-z0-9_]*, "[^"]*", "\([a-z0-9_]*\)"},/\1/p' "$2/include/forceshade/law.h")
[ "$(wc -w <<<"$laws")" -ge 9 ] || fail "only $(wc -w <<<"$laws") laws found in include/forceshade/law.h"
for law in $laws; do check "$law" "$(constant "$fast/laws/$law.h" kErrorBound)"; done
[ "$failures" = 0 ]
