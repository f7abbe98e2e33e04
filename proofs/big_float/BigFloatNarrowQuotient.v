(* SPDX-License-Identifier: BSD-3-Clause *)
(* The bound of a quotient of two numbers of the third stage is narrow, if what Newton's method gave for the inverse is good to half of
   the bits: fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core.
From Forceshade Require Import BigFloat BigFloatValues.
From Forceshade Require Import BigFloatSums BigFloatProducts BigFloatQuotients BigFloatNarrow.
Open Scope R_scope.

Lemma share_times : forall e x c a, 0 <= e -> Rabs x <= c * a -> e * Rabs x <= c * (e * a).
Proof. intros e x c a E H. replace (c * (e * a)) with (e * (c * a)) by ring. now apply Rmult_le_compat_l. Qed.

Lemma off_by_share : forall x y b, Rabs (x - y) <= b -> Rabs x <= Rabs y + b.
Proof. intros x y b H. pose proof (Rabs_triang_inv x y). lra. Qed.

Lemma minus_triangle : forall x y, Rabs (x - y) <= Rabs x + Rabs y.
Proof. intros x y. unfold Rminus. rewrite <- (Rabs_Ropp y). apply Rabs_triang. Qed.

(* F, p and Q: the first quotient, the correction and the quotient, times B; g: F as it is rounded; u = B i. *)
Lemma remainder_in_reals : forall e n A u F g D p Q, 0 <= e <= / 1000 -> 0 <= n <= / 1000 -> n * n <= e -> Rabs (1 - u) <= n ->
  Rabs (F - A * u) <= e * Rabs (A * u) -> Rabs (g - F) <= e * Rabs F -> Rabs (D - (A + - g)) <= e * (Rabs A + Rabs (- g)) ->
  Rabs (p - D * u) <= e * Rabs (D * u) -> Rabs (Q - (F + p)) <= e * (Rabs F + Rabs p) -> Rabs (A - Q) <= 8 * (e * Rabs A).
Proof.
  intros e n A u F g D p Q E N NN U HF Hg HD Hp HQ. set (a := Rabs A) in *. pose proof (Rabs_pos A) as P. fold a in P. set (t := e * a).
  assert (T : 0 <= t <= a / 1000).
  { unfold t. split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (/ 1000 * a); [apply Rmult_le_compat_r; lra|lra]. }
  assert (NA : 0 <= n * a <= a / 1000).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (/ 1000 * a); [apply Rmult_le_compat_r; lra|lra]. }
  assert (NNA : n * (n * a) <= t) by (unfold t; rewrite <- Rmult_assoc; apply Rmult_le_compat_r; lra).
  assert (NT : n * t <= t / 1000) by (apply Rle_trans with (/ 1000 * t); [apply Rmult_le_compat_r; lra|lra]).
  assert (U1 : Rabs u <= 1001 / 1000) by (apply Rabs_le; apply Rabs_le_inv in U; lra).
  assert (times_u : forall x c, Rabs x <= c -> Rabs (x * u) <= 1001 / 1000 * c).
  { intros x c H. rewrite Rabs_mult, Rmult_comm. pose proof (Rabs_pos x). apply Rmult_le_compat; try assumption; apply Rabs_pos. }
  pose proof (times_u A a (Rle_refl _)) as Au. pose proof (share_times e (A * u) _ a ltac:(lra) Au) as HF'. fold t in HF'.
  pose proof (off_by_share F (A * u) _ HF) as F1. assert (F2 : Rabs F <= 1003 / 1000 * a) by lra.
  pose proof (share_times e F _ a ltac:(lra) F2) as Hg'. fold t in Hg'. pose proof (off_by_share g F _ Hg) as G1.
  assert (G2 : Rabs (- g) <= 1005 / 1000 * a) by (rewrite Rabs_Ropp; lra).
  pose proof (share_times e (- g) _ a ltac:(lra) G2) as HD'. fold t in HD'. rewrite Rmult_plus_distr_l in HD. fold t in HD.
  assert (AF : Rabs (A - F) <= n * a + 1001 / 1000 * t).
  { replace (A - F) with (A * (1 - u) + (A * u - F)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    rewrite (Rabs_minus_sym (A * u) F), Rabs_mult. fold a. pose proof (Rmult_le_compat_l a _ _ P U). lra. }
  set (d := D - (A - F)).
  assert (Hd : Rabs d <= 3010 / 1000 * t).
  { unfold d. replace (D - (A - F)) with ((D - (A + - g)) + (F - g)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    rewrite (Rabs_minus_sym F g). lra. }
  assert (D1 : Rabs D <= 6 / 1000 * a).
  { replace D with ((A - F) + d) by (unfold d; ring). apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  pose proof (times_u D _ D1) as Du. assert (Du' : Rabs (D * u) <= 7 / 1000 * a) by lra.
  pose proof (share_times e (D * u) _ a ltac:(lra) Du') as Hp'. fold t in Hp'. pose proof (off_by_share p (D * u) _ Hp) as P1.
  assert (P2 : Rabs p <= 8 / 1000 * a) by lra. pose proof (share_times e p _ a ltac:(lra) P2) as HQ'. fold t in HQ'.
  rewrite Rmult_plus_distr_l in HQ. pose proof (times_u d _ Hd) as Hdu.
  assert (R1 : Rabs ((A - F) * (1 - u)) <= 1002 / 1000 * t + t / 1000).
  { rewrite Rabs_mult. apply Rle_trans with ((n * a + 1001 / 1000 * t) * n); [apply Rmult_le_compat; try assumption; apply Rabs_pos|].
    replace ((n * a + 1001 / 1000 * t) * n) with (n * (n * a) + 1001 / 1000 * (n * t)) by ring. lra. }
  replace (A - Q) with ((A - F) * (1 - u) - d * u - (p - D * u) - (Q - (F + p))) by (unfold d; ring).
  apply Rabs_le_inv in R1, Hdu, Hp, HQ. apply Rabs_le. lra.
Qed.

Lemma exponent_below : forall width a e, (0 < width)%Z -> normal width a -> is_zero a = false -> Rabs (value width a) <= bpow radix2 e ->
  (exponent a <= e + 1)%Z.
Proof.
  intros width a e W N Z H. pose proof (value_above width a W N Z) as A. assert (exponent a - 1 <= e)%Z; [|lia].
  apply (le_bpow radix2). lra.
Qed.

Theorem big_quotient_is_narrow : forall width k j a b inverse, (14 <= width)%Z -> (50 * (k + width + 10) <= range)%Z ->
  (10 <= j)%Z -> (width - 4 <= 2 * j)%Z -> normal width a -> normal width b -> normal width inverse -> fits k a -> fits k b ->
  fits k inverse -> is_zero a = false -> may_be_zero b = false -> Rabs (1 - value width b * value width inverse) <= bpow radix2 (- j) ->
  let r := divide width a b inverse in
  error r = none \/ (error r <= Z.max (Z.max none (exponent a + 10 - width) - exponent b + 2)
    (Z.max (error a - exponent b) (exponent a + error b - 2 * exponent b) + 4) + 1)%Z.
Proof.
  intros width k j a b inverse W Hr J J2 Na Nb Ni Fa Fb Fi Za Zb U r. assert (K : (0 <= k)%Z) by (destruct Fa; lia).
  assert (W0 : (0 < width)%Z) by lia. unfold r, divide. rewrite Za, Zb.
  set (divisor := midpoint b). set (dividend := midpoint a). set (first := midpoint (multiply width dividend inverse)).
  assert (Fd : fits k divisor) by now apply midpoint_fits. assert (Fn : fits k dividend) by now apply midpoint_fits.
  destruct (big_product_contains width k dividend inverse W0 ltac:(lia) Na Ni Fn Fi) as (N1 & F1 & _).
  apply midpoint_fits in F1. fold first in F1. change (normal width first) in N1.
  destruct (big_product_contains width (2 * k + width + 4) first divisor W0 ltac:(lia) N1 Nb F1) as (N2 & F2 & _);
    [apply fits_le with k; [lia|exact Fd]|].
  assert (F2' : fits (4 * k + 3 * width + 12) (multiply width first divisor)) by (apply fits_le with (2 := F2); lia).
  assert (Fn' : fits (4 * k + 3 * width + 12) dividend) by (apply fits_le with (2 := Fn); lia).
  destruct (big_difference_contains width (4 * k + 3 * width + 12) dividend _ W0 ltac:(lia) Na N2 Fn' F2') as (N3 & F3 & _).
  destruct (big_product_contains width (4 * k + 4 * width + 15) _ inverse W0 ltac:(lia) N3 Ni) as (N4 & F4 & _);
    [apply fits_le with (2 := F3); lia|apply fits_le with k; [lia|exact Fi]|].
  set (rough := subtract width dividend (multiply width first divisor)) in *.
  assert (F1' : fits (8 * k + 9 * width + 34) first) by (apply fits_le with (2 := F1); lia).
  assert (F4' : fits (8 * k + 9 * width + 34) (multiply width rough inverse)) by (apply fits_le with (2 := F4); lia).
  destruct (big_sum_contains width (8 * k + 9 * width + 34) first _ W0 ltac:(lia) N1 N4 F1' F4') as (N5 & F5 & _).
  apply midpoint_fits in F5. set (quotient := midpoint (add width first (multiply width rough inverse))) in *. change (normal width
      quotient) in N5.
  destruct (big_product_contains width (8 * k + 10 * width + 37) quotient divisor W0 ltac:(lia) N5 Nb) as (N6 & F6 & _);
    [apply fits_le with (2 := F5); lia|apply fits_le with k; [lia|exact Fd]|].
  assert (F6' : fits (16 * k + 21 * width + 78) (multiply width quotient divisor)) by (apply fits_le with (2 := F6); lia).
  assert (Fn6 : fits (16 * k + 21 * width + 78) dividend) by (apply fits_le with (2 := Fn); lia).
  destruct (big_difference_contains width (16 * k + 21 * width + 78) dividend _ W0 ltac:(lia) Na N6 Fn6 F6') as (N7 & _ & _).
  set (back := multiply width quotient divisor) in *. set (rest := subtract width dividend back) in *.
  set (A := value width a). set (B := value width b) in *. set (i := value width inverse) in *.
  set (e := bpow radix2 (4 - width)).
  assert (E : 0 <= e <= / 1000).
  { split; [apply bpow_ge_0|]. apply Rle_trans with (bpow radix2 (-10)); [apply bpow_le; lia|]. simpl. lra. }
  assert (scale : forall x y z, Rabs (x - y) <= e * z -> Rabs (x * B - y * B) <= e * (z * Rabs B)).
  { intros x y z H. rewrite <- Rmult_minus_distr_r, Rabs_mult, <- Rmult_assoc. apply Rmult_le_compat_r; [apply Rabs_pos|exact H]. }
  pose proof (scale _ _ _ (product_rounds width dividend inverse W0 Na Ni)) as R1.
  pose proof (product_rounds width first divisor W0 N1 Nb) as R2.
  pose proof (sum_rounds width (4 * k + 3 * width + 12) dividend (negated (multiply width first divisor)) W0 ltac:(lia) Na N2 Fn' F2') as
      R3.
  rewrite value_negated in R3.
  pose proof (scale _ _ _ (product_rounds width rough inverse W0 N3 Ni)) as R4.
  pose proof (scale _ _ _ (sum_rounds width (8 * k + 9 * width + 34) first (multiply width rough inverse) W0 ltac:(lia) N1 N4 F1' F4')) as
      R5.
  pose proof (product_rounds width quotient divisor W0 N5 Nb) as R6.
  pose proof (sum_rounds width (16 * k + 21 * width + 78) dividend (negated back) W0 ltac:(lia) Na N6 Fn6 F6') as R7. rewrite value_negated
      in R7.
  fold back in R6. change (value width divisor) with B in *. change (value width dividend) with A in *. fold i e in R1, R2, R3, R4, R6, R7.
  assert (Q : Rabs (A - value width quotient * B) <= 8 * (e * Rabs A)).
  { apply (remainder_in_reals e (bpow radix2 (- j)) A (B * i) (value width first * B) (value width (multiply width first divisor))
      (value width rough) (value width (multiply width rough inverse) * B)); try assumption.
    - split; [apply bpow_ge_0|]. apply Rle_trans with (bpow radix2 (-10)); [apply bpow_le; lia|]. simpl. lra.
    - unfold e. rewrite <- bpow_plus. apply bpow_le. lia.
    - replace (A * (B * i)) with (A * i * B) by ring. rewrite (Rabs_mult (A * i) B). exact R1.
    - replace (value width rough * (B * i)) with (value width rough * i * B) by ring. rewrite (Rabs_mult (value width rough * i) B). exact
        R4.
    - rewrite (Rabs_mult (value width first)), (Rabs_mult (value width (multiply width rough inverse))), <- Rmult_plus_distr_r, <-
        Rmult_plus_distr_r.
      exact R5. }
  pose proof (value_above width a W0 Na Za) as A1. fold A in A1. pose proof (bpow_gt_0 radix2 (exponent a - 1)) as G.
  assert (T : 0 <= e * Rabs A <= Rabs A / 1000).
  { pose proof (Rabs_pos A). split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (/ 1000 * Rabs A); [apply Rmult_le_compat_r; lra|lra].
      }
  assert (QB : Rabs (value width quotient * B) <= 1010 / 1000 * Rabs A).
  { rewrite Rabs_minus_sym in Q. pose proof (off_by_share _ _ _ Q). lra. }
  pose proof (share_times e _ _ _ (proj1 E) QB) as R6'. pose proof (off_by_share _ _ _ R6) as V6.
  assert (V6' : Rabs (- value width back) <= 1020 / 1000 * Rabs A) by (rewrite Rabs_Ropp; lra).
  pose proof (share_times e _ _ _ (proj1 E) V6') as R7'. rewrite Rmult_plus_distr_l in R7.
  pose proof (value_below width a W0 Na) as A2. fold A in A2.
  assert (Zk : is_zero back = false).
  { destruct (is_zero back) eqn:Z; [exfalso|reflexivity]. rewrite (value_of_zero width back Z) in R6.
    pose proof (Rabs_triang (A - value width quotient * B) (value width quotient * B)) as S.
    replace (A - value width quotient * B + value width quotient * B) with A in S by ring.
    replace (0 - value width quotient * B) with (- (value width quotient * B)) in R6 by ring. rewrite Rabs_Ropp in R6. lra. }
  assert (Ek : (exponent back <= exponent a + 2)%Z).
  { apply (exponent_below width back (exponent a + 1)) in Zk; try assumption; [lia|]. rewrite bpow_double. rewrite Rabs_Ropp in V6'. lra. }
  assert (V7 : Rabs (value width rest) <= bpow radix2 (exponent a + 8 - width)).
  { replace (exponent a + 8 - width)%Z with (4 - width + exponent a + 1 + 1 + 1 + 1)%Z by ring. rewrite !bpow_double, bpow_plus. fold e.
    assert (S : e * Rabs A <= e * bpow radix2 (exponent a)) by (apply Rmult_le_compat_l; lra).
    replace (value width rest) with ((value width rest - (A + - value width back)) + ((A - value width quotient * B) -
      (value width back - value width quotient * B))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). change (value width (add width dividend (negated back))) with (value width rest) in R7.
    pose proof (minus_triangle (A - value width quotient * B) (value width back - value width quotient * B)). lra. }
  assert (Xk : (error back = none \/ error back <= exponent back - width + 4)%Z).
  { unfold back, multiply. destruct (is_zero quotient || is_zero divisor) eqn:Z.
    { exfalso. unfold back, multiply in Zk. rewrite Z in Zk. discriminate. }
    cbn [error exponent with_error]. set (part := (if _ <? _ then 1 else 0)%Z).
    assert (P : (0 <= part <= 1)%Z) by (unfold part; destruct (_ <? _)%Z; lia). unfold propagated_by_product.
    change (error quotient) with none. change (error divisor) with none. destruct F5 as [E5 _], Fb as [Eb _].
    change (exponent divisor) with (exponent b) in *. clear - E5 Eb P Hr W K. destruct (negb _).
    - apply clamp_at_most. numbers. lia.
    - left. unfold clamp. rewrite (proj2 (Z.ltb_lt _ _)); [reflexivity|]. numbers. lia. }
  pose proof (big_sum_is_narrow width dividend (negated back) Za Zk) as S. cbv zeta in S. fold (subtract width dividend back) in S. fold
      rest in S.
  change (error dividend) with none in S. change (error (negated back)) with (error back) in S. change (exponent (negated back)) with
      (exponent back) in S.
  change (exponent dividend) with (exponent a) in S.
  assert (M : (magnitude rest <= Z.max none (exponent a + 10 - width))%Z).
  { unfold magnitude. destruct Fa as [Ea _]. destruct (is_zero rest) eqn:Z.
    - clear - S Xk Ek Ea Hr K W. numbers. lia.
    - apply (exponent_below width rest _ W0 N7) in V7; [|exact Z]. clear - S Xk Ek V7 Ea Hr K W. numbers. lia. }
  cbn [error with_error]. apply clamp_at_most. lia.
Qed.
