#!/usr/bin/env bash
# stored_test.sh CODE_ROWS ROWS: the code must answer each position of ROWS, which the model of Coq's definitions wrote, in its bits.
set -euo pipefail
differing=$(diff <(grep -v '^#' "$2") <("$1" < "$2") || true)
[ -z "$differing" ] || { printf '%s\n' "< the model of proofs/, > the code:" "$differing" | head -40; exit 1; }
echo "$(grep -c '^law' "$2") laws and $(grep -c ' | ' "$2") positions have the bits of the model"
