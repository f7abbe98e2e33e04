(* SPDX-License-Identifier: BSD-3-Clause *)
(* Sums and products with their rounding errors: two_sum, fast_two_sum and two_product of fast/numbers/double_double.h, in real numbers
   that the operations of binary64 round, without overflow. *)
From Coq Require Import ZArith Reals Lia Lra.
From Flocq Require Import Core Mult_error Pff2Flocq.
From Forceshade Require Import Formats.
Open Scope R_scope.

Notation in_binary64 := (generic_format radix2 fexp64).

Lemma ties_are_symmetric : forall n, negb (Z.even n) = negb (negb (Z.even (- (n + 1)))).
Proof. intro n. rewrite Z.even_opp, Z.even_add. now destruct (Z.even n). Qed.

(* Knuth. *)
Theorem two_sum_is_exact : forall a b, in_binary64 a -> in_binary64 b ->
  let s := nearest64 (a + b) in
  let t := nearest64 (s - a) in
  s + nearest64 (nearest64 (a - nearest64 (s - t)) + nearest64 (b - t)) = a + b.
Proof.
  intros a b Ha Hb. apply (TwoSum_correct (-1074) 53 (fun n => negb (Z.even n))); try assumption; try lia. apply ties_are_symmetric.
Qed.

(* Dekker. *)
Theorem fast_two_sum_is_exact : forall a b, in_binary64 a -> in_binary64 b -> Rabs b <= Rabs a \/ a = 0 ->
  let s := nearest64 (a + b) in s + nearest64 (b - nearest64 (s - a)) = a + b.
Proof.
  intros a b Ha Hb [Hsize| ->] s; unfold s.
  - replace (b - nearest64 (nearest64 (a + b) - a)) with (b + nearest64 (a - nearest64 (a + b))).
    + apply (Fast2Sum_correct (-1074) 53 (fun n => negb (Z.even n))); try assumption; try lia. apply ties_are_symmetric.
    + replace (a - nearest64 (a + b)) with (- (nearest64 (a + b) - a)) by ring. rewrite round_NE_opp. ring.
  - rewrite Rplus_0_l, Rminus_0_r. rewrite !(round_generic radix2 fexp64 ZnearestE b) by assumption.
    rewrite Rminus_diag_eq, round_0 by (reflexivity || auto with typeclass_instances). ring.
Qed.

(* The fused a b - p, where the product is 0 or so large that its last bit is above 2^-1074. *)
Theorem two_product_is_exact : forall a b, in_binary64 a -> in_binary64 b ->
  a * b = 0 \/ bpow radix2 (-1074 + 2 * 53 - 1) <= Rabs (a * b) ->
  let p := nearest64 (a * b) in p + nearest64 (a * b - p) = a * b.
Proof.
  intros a b Ha Hb Hlarge p. rewrite (round_generic radix2 fexp64 ZnearestE (a * b - p)); [ring| ].
  replace (a * b - p) with (- (p - a * b)) by ring. apply generic_format_opp.
  apply mult_error_FLT; auto with typeclass_instances. intro Hnot. now destruct Hlarge.
Qed.
