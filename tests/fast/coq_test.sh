#!/usr/bin/env bash
# coq_test.sh GAPPA SOURCE_DIR [SCRIPT...]: has Coq check, piece by piece, the proofs that Gappa finds for the scripts in fast/ (or for
# the scripts named, as laws/cylinder). Needs the packages coq, libcoq-gappa and libcoq-flocq; exit code 77 without them.
#
# Gappa writes a proof for Coq, but a rewriting of the script becomes a hypothesis there. Here each becomes a lemma, which
# gappa_rewritings.v proves. A piece is accepted only if Coq then accepts all of it, nothing in it is assumed but the axioms of Coq's
# real numbers, and the intervals are the stored ones. docs/proofs.md says how many pieces there are and which of them Coq does not
# accept; a run of all scripts compares both.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
. "$here/gappa_pieces.sh"
gappa=$1
fast=$(cd "$2" && pwd)/fast
page=$fast/../docs/proofs.md
most_seconds=120  # of processor time for one piece; the slowest takes 3
most_memory=4000000  # KiB
axioms='ClassicalDedekindReals.sig_forall_dec ClassicalDedekindReals.sig_not_dec
FunctionalExtensionality.functional_extensionality_dep Classical_Prop.classic'

out=$(mktemp -d)
trap 'rm -r "$out"' EXIT
cd "$out"
if ! command -v coqc >no_output || ! echo 'From Gappa Require Import Gappa_library.' >probe.v || ! coqc probe.v >no_output 2>&1; then
  echo "skipped: the packages coq, libcoq-gappa and libcoq-flocq are not installed"
  exit 77
fi
cp "$here/gappa_rewritings.v" .
coqc gappa_rewritings.v || { echo "FAILED: $here/gappa_rewritings.v"; exit 1; }

# The ends of Gappa's intervals as its proof for Coq has them.
ends() { sed -nE 's/ \{[^}]*\}//g; s/^  .* in \[(.*), (.*)\]$/\1\n\2/p' "$1"; }

# The reason why a piece is not accepted; nothing if it is.
refusal() {  # script without its ending, piece
  local end rest
  piece "$fast/$1.g" "$2" | "$gappa" -Bcoq >proof.v 2>gappa.log || true
  grep -qx 'Lemma l1 : s1 -> False\.' proof.v || { echo "Gappa proves nothing"; return; }
  [ "$(intervals "$2" <gappa.log)" = "$(grep "^$2: " "$fast/$1.gappa-expected")" ] ||
    { echo "the intervals are not the stored ones"; return; }
  # With a condition that a number is not negative Gappa 1.4.1 writes $ for the argument that Coq finds by itself.
  { echo 'Require Import gappa_rewritings.'
    sed -E -e 's/^Hypothesis (a[0-9]+) : (.*)\.$/Lemma \1 : \2.\nProof. rewriting. Qed./' -e 's/ \$\) ; finalize\.$/ _) ; finalize./' \
      proof.v
    echo 'Print Assumptions l1.'; } >checked.v
  while read -r end; do
    rest=0
    [[ $end != *b* ]] || rest=${end#*b}
    [ "$end" = 0 ] || grep -qF "Float2 (${end%b*}) ($rest)" checked.v || { echo "the end $end is not in Gappa's proof for Coq"; return; }
  done < <(ends gappa.log)
  if grep -nE '^[[:space:]]*(Hypothes[ei]s|Axioms?|Parameters?|Conjectures?|Context|Admitted|Admit)|admit' checked.v; then
    echo "it is assumed, not proved"
    return
  fi
  ! grep '^Variable' checked.v | grep -v ' : R\.$' || { echo "what is assumed of all variables is not only that they are numbers"; return; }
  (ulimit -t "$most_seconds" -v "$most_memory"; coqc checked.v) >coq.log 2>&1 || {
    cat coq.log
    echo "Coq refuses the proof, or needs more than $most_seconds s or $most_memory KiB for it"
    return
  }
  grep -q '^Axioms:\|^Closed under the global context' coq.log || { echo "Coq does not say what the proof assumes"; return; }
  sed -nE 's/^([A-Za-z_.0-9]+) *(:.*)?$/\1/p' coq.log | grep -v '^Axioms$' | grep -vxF "$(tr ' ' '\n' <<<"$axioms")" |
    sed 's/^/it assumes /' || true
}

TIMEFORMAT=%1U
failures=0 accepted=0 all=0 rewritings=0 refused=''
scripts=("${@:3}")
[ $# -gt 2 ] || mapfile -t scripts < <(cd "$fast" && ls -- */*.g | sed 's/\.g$//')
for script in "${scripts[@]}"; do
  for name in $(pieces_of "$fast/$script.g"); do
    all=$((all + 1))
    seconds=$({ time refusal "$script" "$name" >why 2>&1; } 2>&1)  # of the processor
    why=$(<why)
    if [ -z "$why" ]; then
      accepted=$((accepted + 1))
      proved=$(grep -c '^Proof. rewriting. Qed.' checked.v || true)
      rewritings=$((rewritings + proved))
      echo "$script, $name: Coq agrees, $seconds s, $(wc -l <checked.v) lines, $proved rewritings"
    else
      refused+="${refused:+, }$script $name"
      echo "$script, $name: not accepted, $seconds s: $why"
    fi
  done
done
[ "$all" -gt 0 ] || { echo "FAILED: no piece was found"; exit 1; }
if [ $# -gt 2 ]; then
  [ -z "$refused" ] || { echo "FAILED: $refused"; exit 1; }
else
  line="Coq accepts $accepted of the $all pieces, with $rewritings rewritings proved. Those it does not accept: ${refused:-none}."
  grep -qF "$line" "$page" || { echo "FAILED: expected this in $page: $line"; failures=1; }
fi
echo "Coq accepts $accepted of $all pieces"
[ "$failures" = 0 ]
