#!/usr/bin/env bash
# coq_test.sh GAPPA SOURCE_DIR: has Coq check, piece by piece, the proofs that Gappa finds for the scripts in fast/. Needs the
# packages coq, libcoq-gappa and libcoq-flocq; built with -DFORCESHADE_COQ=ON.
set -euo pipefail
. "$(dirname "$0")/gappa_pieces.sh"
gappa=$1
fast=$2/fast
out=$(mktemp -d)
trap 'rm -r "$out"' EXIT
pieces=0

for script in "$fast"/*/*.g; do
  while read -r name; do
    piece "$script" "$name" > "$out/piece.g"
    "$gappa" -Wno-null-denominator -Bcoq "$out/piece.g" > "$out/piece.v" 2> "$out/gappa.log"
    grep ' in \[' "$out/gappa.log" > "$out/proved" || { echo "FAILED: $script, $name: Gappa proves nothing"; exit 1; }
    (cd "$out" && coqc piece.v > coq.log 2>&1) || { echo "FAILED: $script, $name: Coq refuses the proof"; cat "$out/coq.log"; exit 1; }
    echo "$(basename "$script" .g), $name: Coq agrees: $(sed -E 's/ \{[^}]*\}//g' "$out/proved" | tr -s ' ' | tr '\n' ';')"
    pieces=$((pieces + 1))
  done < <(pieces_of "$script")
done
[ "$pieces" -gt 0 ] || { echo "FAILED: no piece was found"; exit 1; }
echo "$pieces proofs checked"
