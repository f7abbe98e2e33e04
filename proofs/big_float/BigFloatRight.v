(* SPDX-License-Identifier: BSD-3-Clause *)
(* Quotients and roots of the third stage's numbers with Newton's method in them: fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core.
From Forceshade Require Import BigFloat BigFloatValues BigFloatProducts BigFloatQuotients BigFloatNarrow BigFloatNarrowQuotient.
From Forceshade Require Import BigFloatNarrowRoot BigFloatNewton BigFloatNewtonLoop.
Open Scope R_scope.

Definition divide_newton (width : Z) (a b : big) : big := divide width a b (newton_inverse width b).
Definition square_root_newton (width : Z) (a : big) : big := square_root width a (newton_inverse_root width a).

Lemma zero_is_fine : forall width k, (0 <= k)%Z -> normal width zero /\ fits k zero.
Proof. intros width k K. split; [now left|]. split; [cbn [exponent zero]; lia|now left]. Qed.

(* ---- Quotients ---- *)

Lemma value_of_quotient : forall width a b i, is_zero a = false -> may_be_zero b = false -> may_be_zero (midpoint b) = false ->
  value width (divide width a b i) = value width (divide width (midpoint a) (midpoint b) i) /\
  exponent (divide width a b i) = exponent (divide width (midpoint a) (midpoint b) i) /\
  is_zero (divide width a b i) = is_zero (divide width (midpoint a) (midpoint b) i).
Proof.
  intros width a b i Za Zb Zm. unfold divide. change (is_zero (midpoint a)) with (is_zero a). rewrite Za, Zb, Zm.
  split; [reflexivity|]. split; reflexivity.
Qed.

Lemma quotient_exponent : forall width k j a b i, (30 <= width)%Z -> (50 * (k + width + 10) <= range)%Z ->
  (10 <= j)%Z -> (width - 4 <= 2 * j)%Z -> normal width a -> normal width b -> normal width i -> fits k a -> fits k b -> fits k i ->
  is_zero a = false -> may_be_zero b = false -> Rabs (1 - value width b * value width i) <= bpow radix2 (- j) ->
  let r := divide width a b i in
  is_zero r = false /\ (exponent a - exponent b - 1 <= exponent r <= exponent a - exponent b + 2)%Z.
Proof.
  intros width k j a b i W Hr J J2 Na Nb Ni Fa Fb Fi Za Zb U r. assert (K : (0 <= k)%Z) by (destruct Fa; lia).
  assert (W0 : (0 < width)%Z) by lia. assert (Zb0 : is_zero b = false) by (now apply orb_false_iff in Zb).
  assert (Zm : may_be_zero (midpoint b) = false).
  { unfold may_be_zero. change (is_zero (midpoint b)) with (is_zero b). rewrite Zb0. cbn [orb error exponent midpoint].
    destruct Fb as [Eb _]. apply Z.ltb_ge. numbers. lia. }
  destruct (value_of_quotient width a b i Za Zb Zm) as (V & X & Zr). fold r in V, X, Zr.
  assert (Fa' : fits k (midpoint a)) by now apply midpoint_fits. assert (Fb' : fits k (midpoint b)) by now apply midpoint_fits.
  destruct (big_quotient_contains width k (midpoint a) (midpoint b) i W0 Hr Na Nb Ni Fa' Fb' Fi) as (N & _ & C).
  specialize (C _ _ (big_midpoint_contains width a) (big_midpoint_contains width b)).
  pose proof (big_quotient_is_narrow width k j (midpoint a) (midpoint b) i ltac:(lia) Hr J J2 Na Nb Ni Fa' Fb' Fi Za Zm U) as B.
  cbv zeta in B. set (m := divide width (midpoint a) (midpoint b) i) in *. cbn [error exponent midpoint] in B. rewrite X, Zr.
    clear V X Zr r.
  pose proof (value_above width a W0 Na Za) as A1. pose proof (value_below width a W0 Na) as A2.
  pose proof (value_above width b W0 Nb Zb0) as B1. pose proof (value_below width b W0 Nb) as B2.
  pose proof (bpow_gt_0 radix2 (exponent a - 1)) as G1. pose proof (bpow_gt_0 radix2 (exponent b - 1)) as G2.
  set (A := value width a) in *. set (D := value width b) in *.
  set (g := (exponent a - exponent b)%Z). destruct Fa as [Ea _], Fb as [Eb _].
  assert (E : Rabs (A / D - value width m) <= bpow radix2 (g - 10)).
  { destruct C as [C|C].
    - exfalso. destruct B as [B|B]; [rewrite B in C|]; clear - C B Ea Eb Hr K W; numbers; lia.
    - apply Rle_trans with (1 := C). rewrite <- size_some by (unfold g; numbers; lia). apply size_le. unfold g. clear - B Ea Eb Hr K W.
      destruct B as [B|B]; [rewrite B|]; numbers; lia. }
  assert (Q : Rabs (A / D) = Rabs A / Rabs D) by (unfold Rdiv; now rewrite Rabs_mult, Rabs_inv).
  assert (Q1 : bpow radix2 (g - 1) <= Rabs (A / D)).
  { rewrite Q. replace (g - 1)%Z with (exponent a - 1 + - exponent b)%Z by (unfold g; ring). rewrite bpow_plus, bpow_opp.
    apply Rmult_le_compat; [apply bpow_ge_0|apply Rlt_le, Rinv_0_lt_compat, bpow_gt_0|exact A1|]. apply Rinv_le; lra. }
  assert (Q2 : Rabs (A / D) <= bpow radix2 (g + 1)).
  { rewrite Q. replace (g + 1)%Z with (exponent a + - (exponent b - 1))%Z by (unfold g; ring). rewrite bpow_plus, bpow_opp.
    apply Rmult_le_compat; [apply Rabs_pos|apply Rlt_le, Rinv_0_lt_compat; lra|lra|]. apply Rinv_le; lra. }
  pose proof (Rabs_triang_inv (A / D) (A / D - value width m)) as T1. pose proof (Rabs_triang_inv (A / D) (value width m)) as T2.
  replace (A / D - (A / D - value width m)) with (value width m) in T1 by ring.
  pose proof (Rabs_triang_inv (value width m) (A / D)) as T3. rewrite Rabs_minus_sym in T3.
  assert (P1 : bpow radix2 (g - 10) <= bpow radix2 (g - 3)) by (apply bpow_le; lia).
  pose proof (bpow_double (g - 3)) as P2. replace (g - 3 + 1)%Z with (g - 2)%Z in P2 by ring.
  pose proof (bpow_double (g - 2)) as P3. replace (g - 2 + 1)%Z with (g - 1)%Z in P3 by ring.
  pose proof (bpow_double (g - 1)) as P4. replace (g - 1 + 1)%Z with g in P4 by ring.
  pose proof (bpow_double g) as P5. pose proof (bpow_double (g + 1)) as P6. replace (g + 1 + 1)%Z with (g + 2)%Z in P6 by ring.
  pose proof (bpow_gt_0 radix2 (g - 3)) as G3.
  assert (Zm0 : is_zero m = false) by (destruct (is_zero m) eqn:Z; [|reflexivity];
    rewrite (value_of_zero width m Z) in T1, E; rewrite Rabs_R0 in T1; lra).
  split; [exact Zm0|]. pose proof (value_above width m W0 N Zm0) as M1. pose proof (value_below width m W0 N) as M2.
  assert (L1 : (g - 2 < exponent m)%Z) by (apply (lt_bpow radix2); lra).
  assert (L2 : (exponent m - 1 < g + 2)%Z) by (apply (lt_bpow radix2); lra). unfold g in *. lia.
Qed.

(* The quotient's bound is one. Relative to the quotient it is 6 bits above the larger of both operands' at most, or 2^14 units of the
   last bit. Nothing is supposed of Newton's method. *)
Theorem big_quotient_is_right : forall width k a b, (128 <= width)%Z -> (60 * (k + width + 1110) <= range)%Z ->
  normal width a -> normal width b -> fits k a -> fits k b -> let r := divide_newton width a b in
  normal width r /\ fits (60 * (k + width + 1110)) r /\
  (forall x y, contains width a x -> contains width b y -> contains width r (x / y)) /\
  (is_zero a = false -> may_be_zero b = false ->
    is_zero r = false /\ (exponent a - exponent b - 1 <= exponent r <= exponent a - exponent b + 2)%Z /\
    (error r = none \/
      (error r - exponent r <= Z.max (Z.max (error a - exponent a) (error b - exponent b) + 6) (14 - width))%Z)).
Proof.
  intros width k a b W Hr Na Nb Fa Fb r. assert (K : (0 <= k)%Z) by (destruct Fa; lia).
  assert (Fa' : fits (k + 3) a) by (apply fits_le with (2 := Fa); lia).
    assert (Fb' : fits (k + 3) b) by (apply fits_le with (2 := Fb); lia).
  destruct (may_be_zero b) eqn:Zb.
  - destruct (zero_is_fine width (k + 3) ltac:(lia)) as [Nz Fz].
    assert (R : r = divide width a b zero) by (unfold r, divide_newton, divide; now rewrite Zb). rewrite R.
    destruct (big_quotient_contains width (k + 3) a b zero ltac:(lia) ltac:(lia) Na Nb Nz Fa' Fb' Fz) as (N & F & C).
    split; [exact N|]. split; [apply fits_le with (2 := F); lia|]. split; [exact C|discriminate].
  - assert (Zb0 : is_zero b = false) by (now apply orb_false_iff in Zb).
    destruct (newton_inverse_is_good width k b W ltac:(lia) Nb Zb0 Fb) as (Ni & Fi & H). unfold r, divide_newton.
    set (i := newton_inverse width b) in *.
    destruct (big_quotient_contains width (k + 3) a b i ltac:(lia) ltac:(lia) Na Nb Ni Fa' Fb' Fi) as (N & F & C).
    split; [exact N|]. split; [apply fits_le with (2 := F); lia|]. split; [exact C|]. intros Za _.
    destruct (quotient_exponent width (k + 3) (width - 8) a b i ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lia) Na Nb Ni Fa' Fb' Fi Za Zb H) as
      (Zr & X).
    split; [exact Zr|]. split; [exact X|].
    pose proof (big_quotient_is_narrow width (k + 3) (width - 8) a b i ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lia) Na Nb Ni Fa' Fb' Fi
      Za Zb H) as B.
    cbv zeta in B. set (q := divide width a b i) in *. destruct B as [B|B]; [now left|right]. destruct Fa as [Ea _], Fb as [Eb _].
    clear - B X Ea Eb Hr K W. numbers. lia.
Qed.

(* ---- Roots ---- *)

(* The root's bound is one. Relative to the root it is 4 bits above the operand's at most, or 2^13 units of the last bit. Nothing is
   supposed of Newton's method. Of a number of which nothing is known, nothing is said. *)
Theorem big_root_is_right : forall width k a, (128 <= width)%Z -> (60 * (k + width + 1110) <= range)%Z ->
  normal width a -> fits k a -> (error a < boundless)%Z -> let r := square_root_newton width a in
  normal width r /\ fits (60 * (k + width + 1110)) r /\ (forall x, contains width a x -> contains width r (sqrt x)) /\
  (may_be_zero a = false -> negative a = false ->
    is_zero r = false /\ (exponent a - 1 <= 2 * exponent r <= exponent a + 2)%Z /\
    (error r = none \/ (error r - exponent r <= Z.max (error a - exponent a + 4) (13 - width))%Z)).
Proof.
  intros width k a W Hr Na Fa Hb r. assert (K : (0 <= k)%Z) by (destruct Fa; lia).
  assert (Fa' : fits (k + 3) a) by (apply fits_le with (2 := Fa); lia). destruct (may_be_zero a || negative a) eqn:Z.
  - destruct (zero_is_fine width (k + 3) ltac:(lia)) as [Nz Fz].
    assert (R : r = square_root width a zero) by (unfold r, square_root_newton, square_root; now rewrite Z). rewrite R.
    assert (No : may_be_zero a = false -> negative a = false -> False) by (intros Z1 Z2; rewrite Z1, Z2 in Z; discriminate Z).
    destruct (big_root_contains width (k + 3) a zero ltac:(lia) ltac:(lia) Na Nz Fa' Fz Hb) as (N & F & C).
    + intros Z1 Z2. destruct (No Z1 Z2).
    + split; [exact N|]. split; [apply fits_le with (2 := F); lia|]. split; [exact C|]. intros Z1 Z2. destruct (No Z1 Z2).
  - apply orb_false_iff in Z. destruct Z as [Zm Zn]. assert (Za : is_zero a = false) by (now apply orb_false_iff in Zm).
    destruct (newton_inverse_root_is_good width k a W ltac:(lia) Na Za Zn Fa) as (Ni & Fi & Pi & H). unfold r, square_root_newton.
    set (i := newton_inverse_root width a) in *.
    pose proof (value_of_positive width a ltac:(lia) Na Za Zn) as PA. pose proof (bpow_gt_0 radix2 (exponent a - 1)) as G.
    assert (H2 : value width a * (value width i * value width i) <= 2).
    { assert (B : bpow radix2 (- (width - 8)) <= bpow radix2 0) by (apply bpow_le; lia). change (bpow radix2 0) with 1 in B.
      apply Rabs_le_inv in H. lra. }
    destruct (big_root_contains width (k + 3) a i ltac:(lia) ltac:(lia) Na Ni Fa' Fi Hb) as (N & F & C).
    + intros _ _. pose proof (root_is_positive width (k + 3) a i ltac:(lia) ltac:(lia) Na Ni Fa' Fi ltac:(lra) Pi H2) as R. cbv zeta in R.
      set (root := root_of_midpoint width (midpoint a) i) in *. destruct R as [Nr R].
      split; [destruct (is_zero root) eqn:Z; [rewrite (value_of_zero width root Z) in R; lra|reflexivity]|].
      destruct (negative root) eqn:Z; [exfalso|reflexivity]. revert R. apply Rle_not_lt. unfold value, signed. rewrite Z, opp_IZR.
      rewrite Ropp_mult_distr_l_reverse. apply Ropp_le_cancel. rewrite Ropp_0, Ropp_involutive.
      apply Rmult_le_pos; [|apply bpow_ge_0]. apply IZR_le. now apply (normal_digits width root ltac:(lia) Nr).
    + split; [exact N|]. split; [apply fits_le with (2 := F); lia|]. split; [exact C|]. intros _ _.
      exact (big_root_is_narrow width (k + 3) (width - 8) a i ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lia) Na Ni Fa' Fi Zm Zn Pi H).
Qed.
