#!/usr/bin/env bash
# model_test.sh CODE_ROWS ROWS [LAWS SEED]: makes the model of Coq's definitions (proofs/code/Model.v) and has it answer the positions of
# ROWS again; with LAWS, also 16 new positions of each of so many laws, which the code must answer in the model's bits.
#   model_test.sh CODE_ROWS ROWS write LAWS SEED > NEW    prints the rows of such positions by the model, as ROWS has them.
# FORCESHADE_PROOFS names the folder in which scripts/proofs left what Coq read (build/proofs). Exits 77 without Coq, OCaml or Zarith.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
code_rows=$(realpath "$1") rows=$(realpath "$2") proofs=$(realpath "${FORCESHADE_PROOFS:-build/proofs}")
for tool in coqc ocamlfind; do command -v $tool > /dev/null || { echo "skipped: $tool is not installed"; exit 77; }; done
ocamlfind query zarith > /dev/null 2>&1 || { echo "skipped: Zarith is not installed (Debian package libzarith-ocaml-dev)"; exit 77; }
[ -e "$proofs/model.ml" ] || { echo "skipped: expected $proofs/model.ml, which scripts/proofs makes"; exit 77; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$proofs"/model.ml "$proofs"/model.mli "$here/model_rows.ml" "$work"
echo 'include Z' > "$work/zarith.ml"
(cd "$work" &&
  ocamlfind ocamlopt -inline 100 -package zarith -linkpkg zarith.ml model.mli model.ml model_rows.ml -o model_rows > log 2>&1) ||
  { cat "$work/log"; exit 1; }
written() {
  /usr/bin/python3 "$here/positions.py" "$1" "$2" > "$work/positions"
  "$work/model_rows" < "$work/positions"
  grep '^#' "$work/positions"
}
if [ "${3-}" = write ]; then
  written "$4" "$5"
  exit
fi
sed -E 's/ =.*//' "$rows" | "$work/model_rows" | diff <(grep -v '^#' "$rows") - | head -20
echo "the model answers as it did when $rows was written"
if [ $# -ge 4 ]; then
  written "$3" "$4" > "$work/new"
  "$here/stored_test.sh" "$code_rows" "$work/new"
fi
