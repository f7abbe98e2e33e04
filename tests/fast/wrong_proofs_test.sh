#!/usr/bin/env bash
# wrong_proofs_test.sh GAPPA SOURCE_DIR [coq]: proofs_test.sh refuses wrong scripts, stored intervals and constants, and coq_test.sh
# what is not proved: each time one line is changed in a copy, and the test must fail there with the message that belongs to it.
set -euo pipefail
gappa=$1
sources=$(cd "$2" && pwd)
copy=$(mktemp -d)
trap 'rm -r "$copy"' EXIT
mkdir -p "$copy"/{tests,docs,include/forceshade}
cp -R "$sources/fast" "$copy"
cp -R "$sources/tests/fast" "$copy/tests"
cp "$sources/include/forceshade/law.h" "$copy/include/forceshade"
failures=0

# file, sed's command for the change, message, test and its further arguments
refuses() {
  local file=$copy/$1 change=$2 message=$3 test=$4 status=0
  cp "$file" "$copy/original"
  sed -E -i "$change" "$file"
  if cmp -s "$file" "$copy/original"; then
    echo "FAILED: $1 has nothing that $change changes"
    failures=1
    return
  fi
  "$copy/tests/fast/$test" "$gappa" "$copy" "${@:5}" >"$copy/output" 2>&1 || status=$?
  if [ "$status" = 77 ]; then
    cat "$copy/output"
    exit 77
  elif [ "$status" = 0 ] || ! grep -qF "$message" "$copy/output"; then
    echo "FAILED: $test with $change in $1: exit code $status, expected one other than 0 and the message: $message"
    cat "$copy/output"
    failures=1
  else
    echo "refused: $1: $change"
  fi
  cp "$copy/original" "$file"
}

if [ "${3:-}" = coq ]; then
  # Rewritings that are left as the hypotheses that Gappa makes of them, that an axiom proves, that nothing proves; one that is false
  # and that Gappa cannot see to be so, and one with a denominator that may be 0, of which Gappa warns only where a rewriting has no
  # condition at all.
  refuses tests/fast/coq_test.sh "s/-e 's.\^Hypothesis[^']*'//" 'it is assumed, not proved' coq_test.sh numbers/double_double
  refuses tests/fast/gappa_rewritings.v 's/^Ltac rewriting := .*/Axiom all : forall p : Prop, p. Ltac rewriting := apply all./' \
    'it assumes all' coq_test.sh numbers/double_double
  refuses tests/fast/coq_test.sh 's/Proof\. rewriting\. Qed\./Admitted./' 'it is assumed, not proved' coq_test.sh numbers/double_double
  refuses fast/numbers/double_double.g 's/^r_high -> -\(/r_high -> (/' 'Coq refuses the proof' coq_test.sh numbers/double_double
  refuses fast/numbers/double_double.g 's/\{ b_hi <> 0, B <> 0 \}/{ b_hi <> 0 }/' 'Coq refuses the proof' coq_test.sh numbers/double_double
  refuses fast/laws/wall.gappa-expected 's/in \[0, 0\]/in [0, 1e-99]/' 'the intervals are not the stored ones' coq_test.sh laws/wall
  refuses tests/fast/coq_test.sh 's/^most_seconds=[0-9]+/most_seconds=1/' 'needs more than 1 s' coq_test.sh laws/cylinder
  # The page's list, with one script that is left.
  find "$copy/fast" -name '*.g' ! -name wall.g -delete
  echo 'Coq accepts 1 of the 1 pieces, with 0 rewritings proved. Those it does not accept: none.' >"$copy/docs/proofs.md"
  "$copy/tests/fast/coq_test.sh" "$gappa" "$copy"
  refuses docs/proofs.md 's/none/laws\/wall force/' 'FAILED: expected this in' coq_test.sh
  refuses docs/proofs.md 's/1 of the 1/2 of the 2/' 'FAILED: expected this in' coq_test.sh
else
  refuses fast/laws/polygon_gap.g 's/\|dH\| <= 1b-94/|dH| <= 1b-70/' \
    'the proved intervals are not the stored ones' proofs_test.sh polygon_gap
  refuses fast/damping/damping.g 's/0x1\.001p-52  # from/0x1.001p-54  # from/' \
    'the hypothesis 0x1.001p-54 is not proved by damping part_sum' proofs_test.sh damping
  refuses fast/laws/bump_2p.gappa-expected 's/5\.96745/5.96744/' 'the proved intervals are not the stored ones' proofs_test.sh bump_2p
  refuses fast/laws/bump_2p.g 's/0x1\.bp-52 # from polygon_gap/0x1.8p-52 # from polygon_gap/' \
    'the hypothesis 0x1.8p-52 is not proved by polygon_gap' proofs_test.sh bump_2p
  refuses fast/laws/bump_2p.h 's/kErrorBound = 0x1p-50/kErrorBound = 0x1p-52/' "does not imply the header's" proofs_test.sh bump_2p
  refuses fast/laws/bump_2p.h 's/kErrorBound = 0x1p-50/kErrorBound = 0x1p-47/' 'is idle' proofs_test.sh bump_2p
  # A denominator that may be 0, and an identity that is none.
  refuses fast/numbers/double_double.g 's/ \{ b_hi <> 0, B <> 0 \}//' 'Gappa took for granted' proofs_test.sh double_double
  refuses fast/numbers/double_double.g 's/^q_high -> -\(/q_high -> (/' 'Gappa took for granted' proofs_test.sh double_double
  refuses tests/fast/gappa_pieces.sh 's/1b-53 \/\\\\\\n/1b-52 \/\\\\\\n/' 'the proved intervals are not the stored ones' proofs_test.sh \
    decide
fi
[ "$failures" = 0 ]
