#!/usr/bin/env bash
# refused_test.sh SOURCE: scripts/proofs must refuse a wrong line of the code, a wrong constant in a definition, a wrong statement, a
# proof that is missing, and an axiom. Each is planted in a copy. Exits 77 where scripts/proofs does.
set -euo pipefail
source=$(realpath "$1")
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
mkdir "$copy/scripts"
cp "$source/scripts/proofs" "$copy/scripts"
cp -r "$source/proofs" "$source/fast" "$copy"
code=0
"$copy/scripts/proofs" "$copy/build" > "$copy/said" 2>&1 || code=$?
[ "$code" = 0 ] || { cat "$copy/said"; exit "$code"; }

wrong=0 planted=0
refuses() {  # file, what stands there, what is planted, words of the refusal
  planted=$((planted + 1))
  cp "$copy/$1" "$copy/kept"
  python3 - "$copy/$1" "$2" "$3" <<'EOF'
import sys
path, old, new = sys.argv[1:]
with open(path) as file:
    text = file.read()
assert text.count(old) == 1, f"{path}: {text.count(old)} times: {old}"
with open(path, "w") as file:
    file.write(text.replace(old, new))
EOF
  rm -rf "$copy/tried"
  cp -a "$copy/build" "$copy/tried"
  if "$copy/scripts/proofs" "$copy/tried" > "$copy/said" 2>&1 || ! grep -q "$4" "$copy/said"; then
    echo "NOT REFUSED: $1: \"$3\" in the place of \"$2\""
    tail -n 5 "$copy/said"
    wrong=$((wrong + 1))
  fi
  cp "$copy/kept" "$copy/$1"
}
refuses fast/numbers/first_stage.h "kDroppedMask - 2 * kWindow" "kDroppedMask - kWindow" "proofs/code.txt"
refuses fast/domain.h "kPositionQuantum = 0x1p-30F" "kPositionQuantum = 0x1p-29F" "proofs/code.txt"
refuses fast/laws/wall.h "larger(Real(-K) * z, Real(0))" "larger(Real(K) * z, Real(0))" "proofs/code.txt"
refuses proofs/RoundingTest.v "(2 ^ 29 - 1 - 2 * W <=?" "(2 ^ 29 - 2 * W <=?" "Error"
refuses proofs/RoundingTest.v "((2 ^ 29 - 1) / 2 - W)) mod 2 ^ 64)" "((2 ^ 29 - 1) / 2 + W)) mod 2 ^ 64)" "Error"
refuses proofs/RoundingTest.v "(0 < k <= 2 ^ 20)%Z ->" "(0 <= k <= 2 ^ 20)%Z ->" "Error"
refuses proofs/RoundingTest.v "in_doubt (k + 1) (bits_of_b64 v) = false -> is" "in_doubt k (bits_of_b64 v) = false -> is" "Error"
refuses proofs/Comparisons.v "false 8388608 (-53) eq_refl" "false 8388608 (-52) eq_refl" "Error"
refuses proofs/Comparisons.v "if is_at_most quantum (b32_abs x) then x else zero32" "if is_at_most quantum x then x else zero32" "Error"
refuses proofs/Wall.v "b64_mult mode_NE (b64_opp (to64 K)) z) zero64." "b64_mult mode_NE (to64 K) z) zero64." "Error"
refuses proofs/Wall.v "/\\ is_nearest32 F (- value32 K * Z))." "/\\ is_nearest32 F (value32 K * Z))." "Error"
refuses proofs/Wall.v "-> 0 <= Z -> evaluate K x y z = no_force free)" "-> evaluate K x y z = no_force free)" "Error"
refuses proofs/Wall.v "Theorem product_is_exact : forall a b : binary32, generic" "Axiom product_is_exact : forall a b : binary32, generic" "no proofs"
refuses proofs/Formats.v "Definition is_nearest32" "Lemma lost : 1 = 2. Admitted.
Definition is_nearest32" "no proofs"
refuses proofs/ErrorFree.v "nearest64 (nearest64 (a - nearest64 (s - t)) + nearest64 (b - t)) = a + b." "nearest64 (nearest64 (a - s) + nearest64 (b - t)) = a + b." "Error"
refuses proofs/ErrorFree.v "Rabs b <= Rabs a \\/ a = 0 ->" "Rabs a <= Rabs b \\/ a = 0 ->" "Error"
refuses proofs/ErrorFree.v "bpow radix2 (-1074 + 2 * 53 - 1) <=" "bpow radix2 (-1074 + 53) <=" "Error"
refuses proofs/Acceptance.v "exact = up /\\ is_even c = true ->" "exact = up ->" "Error"
refuses proofs/Acceptance.v ": bool := Z.even (bits_of_b32 c)." ": bool := Z.odd (bits_of_b32 c)." "Error"
refuses fast/numbers/ball.h "up == Sign::zero && !candidate_is_even" "up == Sign::zero" "proofs/code.txt"
refuses fast/numbers/double_double.h "return {s, (a - (s - t)) + (b - t)};" "return {s, (a - (s - t)) - (b - t)};" "proofs/code.txt"
echo "$planted planted, $wrong not refused"
[ "$wrong" = 0 ]
