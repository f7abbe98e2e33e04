(* SPDX-License-Identifier: BSD-3-Clause *)
(* The bound of a root of a number of the third stage is narrow, if what Newton's method gave for the inverse of the root is good to
   half of the bits: fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core.
From Forceshade Require Import BigFloat BigFloatValues.
From Forceshade Require Import BigFloatSums BigFloatProducts BigFloatQuotients BigFloatNarrow BigFloatNarrowQuotient.
Open Scope R_scope.

Lemma product_at_most : forall x y a b, Rabs x <= a -> Rabs y <= b -> Rabs (x * y) <= a * b.
Proof. intros x y a b X Y. rewrite Rabs_mult. apply Rmult_le_compat; try assumption; apply Rabs_pos. Qed.

(* f, P and r: the first root, the correction times 2 and the root. *)
Lemma root_remainder_in_reals : forall e n A i f S D P r, 0 <= e <= / 1000 -> 0 <= n <= / 1000 -> n * n <= e -> 0 < A -> 0 < i ->
  Rabs (1 - A * (i * i)) <= n -> Rabs (f - A * i) <= e * Rabs (A * i) -> Rabs (S - f * f) <= e * Rabs (f * f) ->
  Rabs (D - (A + - S)) <= e * (Rabs A + Rabs (- S)) -> Rabs (P - D * i) <= e * Rabs (D * i) ->
  Rabs (r - (f + P / 2)) <= e * (Rabs f + Rabs (P / 2)) -> Rabs (A - r * r) <= 11 * (e * A).
Proof.
  intros e n A i f S D P r E N NN PA Pi U Hf HS HD HP Hr. set (T := A * i) in *. assert (PT : 0 < T) by (now apply Rmult_lt_0_compat).
  set (h := 1 - A * (i * i)) in *. assert (h1 : Rabs h <= / 1000) by lra. pose proof (Rabs_le_inv _ _ h1) as h2.
  assert (Ti : T * i = 1 - h) by (unfold T, h; ring). assert (TT : T * T = A * (1 - h)) by (unfold T, h; ring).
  assert (Ah : Rabs (A * h) <= A / 1000) by (rewrite Rabs_mult, (Rabs_pos_eq A) by lra;
    pose proof (Rmult_le_compat_l A _ _ ltac:(lra) h1); lra).
  pose proof (Rabs_le_inv _ _ Ah) as Ah'. set (q := T * T) in *. assert (Q : 999 / 1000 * A <= q <= 1001 / 1000 * A) by lra.
  set (t := e * T). assert (Et : 0 <= t <= T / 1000).
  { unfold t. split; [apply Rmult_le_pos; lra|]. pose proof (Rmult_le_compat_r T _ _ ltac:(lra) (proj2 E)). lra. }
  set (c := t * T). assert (C0 : 0 <= c) by (unfold c; apply Rmult_le_pos; lra). assert (Cq : e * q = c) by (unfold c, t, q; ring).
  assert (C1 : c <= q / 1000) by (rewrite <- Cq; pose proof (Rmult_le_compat_r q _ _ ltac:(lra) (proj2 E)); lra).
  assert (CA : c <= 1001 / 1000 * (e * A)) by (rewrite <- Cq; pose proof (Rmult_le_compat_l e _ _ (proj1 E) (proj2 Q)); lra).
  assert (AC : e * A <= 1002 / 1000 * c) by (rewrite <- Cq; pose proof (Rmult_le_compat_l e (999 / 1000 * A) _ (proj1 E) (proj1 Q)); lra).
  rewrite (Rabs_pos_eq T) in Hf by lra. fold t in Hf. set (p := f - T) in *.
  assert (tt : Rabs (p * (2 * T + p)) <= 2001 / 1000 * c).
  { apply Rle_trans with (t * (2001 / 1000 * T)); [|unfold c; lra]. apply product_at_most; [exact Hf|].
    apply Rabs_le_inv in Hf. apply Rabs_le. lra. }
  assert (ff : f * f = q + p * (2 * T + p)) by (unfold p, q; ring).
  assert (F2 : Rabs (f * f) <= 1003 / 1000 * q) by (rewrite ff; apply Rabs_le; apply Rabs_le_inv in tt; lra).
  pose proof (share_times e _ _ _ (proj1 E) F2) as HS'. rewrite Cq in HS'.
  assert (S1 : Rabs (S - q) <= 3005 / 1000 * c).
  { replace (S - q) with ((S - f * f) + p * (2 * T + p)) by (rewrite ff; ring). apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  assert (S2 : Rabs (- S) <= 1004 / 1000 * q) by (rewrite Rabs_Ropp; apply Rabs_le; apply Rabs_le_inv in S1; lra).
  pose proof (share_times e _ _ _ (proj1 E) S2) as HD'. rewrite Cq in HD'. rewrite Rmult_plus_distr_l, (Rabs_pos_eq A) in HD by lra.
  set (d := D - (A - q)). assert (Hd : Rabs d <= 5020 / 1000 * c).
  { unfold d. replace (D - (A - q)) with ((D - (A + - S)) - (S - q)) by ring. apply Rle_trans with (1 := minus_triangle _ _). lra. }
  assert (D1 : Rabs D <= 8 / 1000 * q).
  { replace D with (A * h + d) by (unfold d; rewrite TT; ring). apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  assert (qi : q * i = T * (1 - h)) by (rewrite <- Ti; unfold q; ring).
  assert (ci : c * i <= 1001 / 1000 * t).
  { replace (c * i) with (t * (T * i)) by (unfold c; ring). rewrite Ti, (Rmult_comm _ t). apply Rmult_le_compat_l; lra. }
  assert (times_i : forall x b, Rabs x <= b -> Rabs (x * i) <= b * i).
  { intros x b H. apply product_at_most; [exact H|]. rewrite Rabs_pos_eq; lra. }
  pose proof (times_i _ _ Hd) as Hdi. pose proof (times_i _ _ D1) as D2.
  assert (D3 : Rabs (D * i) <= 9 / 1000 * T).
  { apply Rle_trans with (1 := D2). rewrite Rmult_assoc, qi. pose proof
    (Rmult_le_compat_l T (1 - h) (1001 / 1000) ltac:(lra) ltac:(lra)). lra. }
  pose proof (share_times e _ _ _ (proj1 E) D3) as HP'. fold t in HP'.
  assert (P1 : Rabs (P / 2) <= 6 / 1000 * T).
  { apply Rabs_le. apply Rabs_le_inv in HP, D3. lra. }
  assert (F1 : Rabs f <= 1001 / 1000 * T) by (apply Rabs_le; apply Rabs_le_inv in Hf; unfold p in Hf; lra).
  pose proof (share_times e _ _ _ (proj1 E) P1) as Hr1. pose proof (share_times e _ _ _ (proj1 E) F1) as Hr2. fold t in Hr1, Hr2.
  rewrite Rmult_plus_distr_l in Hr. set (s := T * (1 + h / 2)).
  assert (R1 : Rabs (r - s) <= 4600 / 1000 * t).
  { replace (r - s) with ((r - (f + P / 2)) + p + (d * i) / 2 + (P - D * i) / 2).
    - apply Rabs_le_inv in Hr, Hf, Hdi, HP. apply Rabs_le. lra.
    - unfold p, d, s. rewrite TT. replace (T * (1 + h / 2)) with (T + A * i * h / 2) by (unfold T; field). field. }
  assert (R2 : Rabs (r + s) <= 2010 / 1000 * T).
  { assert (Sb : Rabs s <= 1001 / 1000 * T).
    { unfold s. rewrite Rmult_comm. rewrite Rabs_mult, (Rabs_pos_eq T) by lra. apply Rmult_le_compat_r; [lra|]. apply Rabs_le. lra. }
    replace (r + s) with ((r - s) + 2 * s) by ring. apply Rabs_le_inv in Sb, R1. apply Rabs_le. lra. }
  pose proof (product_at_most _ _ _ _ R1 R2) as R3.
  replace (4600 / 1000 * t * (2010 / 1000 * T)) with (9246 / 1000 * c) in R3 by (unfold c; field).
  assert (hh : Rabs (h * h) <= e).
  { apply Rle_trans with (2 := NN). now apply product_at_most. }
  assert (H3 : Rabs (A * (h * h) * (3 / 4 + h / 4)) <= A * e * 1).
  { apply product_at_most; [apply product_at_most; [rewrite Rabs_pos_eq; lra|exact hh]|]. apply Rabs_le. lra. }
  replace (A - r * r) with (A * (h * h) * (3 / 4 + h / 4) - (r - s) * (r + s)).
  - apply Rle_trans with (1 := minus_triangle _ _). lra.
  - replace ((r - s) * (r + s)) with (r * r - q * ((1 + h / 2) * (1 + h / 2))) by (unfold s, q; ring). rewrite TT. field.
Qed.

Lemma value_of_positive : forall width a, (0 < width)%Z -> normal width a -> is_zero a = false -> negative a = false ->
  bpow radix2 (exponent a - 1) <= value width a.
Proof.
  intros width a W N Z S. pose proof (value_above width a W N Z) as A. rewrite Rabs_pos_eq in A; [exact A|].
  unfold value, signed. rewrite S. apply Rmult_le_pos; [|apply bpow_ge_0]. apply IZR_le. now apply (normal_digits width a W N).
Qed.

Lemma root_exponent : forall width x a e, (0 < width)%Z -> normal width x -> bpow radix2 (e - 1) <= a < bpow radix2 e ->
  Rabs (a - value width x * value width x) <= a / 4 -> is_zero x = false /\ (e - 1 <= 2 * exponent x <= e + 2)%Z.
Proof.
  intros width x a e W N [A1 A2] H. pose proof (bpow_gt_0 radix2 (e - 1)) as G. apply Rabs_le_inv in H.
  assert (Z : is_zero x = false) by (destruct (is_zero x) eqn:Z; [rewrite (value_of_zero width x Z) in H; lra|reflexivity]).
  split; [exact Z|]. pose proof (value_above width x W N Z) as X1. pose proof (value_below width x W N) as X2.
  assert (Q : value width x * value width x = Rabs (value width x) * Rabs (value width x)) 
    by (rewrite <- Rabs_mult; symmetry; apply Rabs_pos_eq; lra).
  pose proof (Rabs_pos (value width x)) as P. split.
  - assert (L : (e - 2 < exponent x + exponent x)%Z); [|lia]. apply (lt_bpow radix2). rewrite (bpow_plus radix2 (exponent x)).
    pose proof (bpow_double (e - 2)) as D. replace (e - 2 + 1)%Z with (e - 1)%Z in D by ring.
    pose proof (Rmult_le_0_lt_compat _ _ _ _ P P X2 X2). lra.
  - assert (L : (exponent x - 1 + (exponent x - 1) < e + 1)%Z); [|lia]. apply (lt_bpow radix2). rewrite bpow_plus, bpow_double.
    pose proof (bpow_ge_0 radix2 (exponent x - 1)) as B. pose proof (Rmult_le_compat _ _ _ _ B B X1 X1). lra.
Qed.

(* What the bound of a root is made of: of the root's own remainder, which is some units in the last place, and of the operand's. *)
Theorem big_root_is_narrow : forall width k j a inverse, (14 <= width)%Z -> (60 * (k + width + 10) <= range)%Z ->
  (10 <= j)%Z -> (width - 4 <= 2 * j)%Z -> normal width a -> normal width inverse -> fits k a -> fits k inverse ->
  may_be_zero a = false -> negative a = false -> 0 < value width inverse ->
  Rabs (1 - value width a * (value width inverse * value width inverse)) <= bpow radix2 (- j) ->
  let r := square_root width a inverse in
  is_zero r = false /\ (exponent a - 1 <= 2 * exponent r <= exponent a + 2)%Z /\
  (error r = none \/ (error r - exponent r <= Z.max (error a - exponent a + 4) (13 - width))%Z).
Proof.
  intros width k j a inverse W Hr J J2 Na Ni Fa Fi Zm Zn Pi U r. assert (K : (0 <= k)%Z) by (destruct Fa; lia).
  assert (W0 : (0 < width)%Z) by lia. unfold r, square_root.
  assert (Za : is_zero a = false) by (now apply orb_false_iff in Zm). unfold is_exact_zero. rewrite Za, Zm, Zn. cbn [andb orb].
  pose proof (value_of_positive width a W0 Na Za Zn) as A1. pose proof (bpow_gt_0 radix2 (exponent a - 1)) as G.
  pose proof (value_below width a W0 Na) as A2. rewrite Rabs_pos_eq in A2 by lra.
  set (square := midpoint a). unfold root_of_midpoint. set (first := midpoint (multiply width square inverse)).
  assert (Fs : fits k square) by now apply midpoint_fits.
  destruct (big_product_contains width k square inverse W0 ltac:(lia) Na Ni Fs Fi) as (N1 & F1 & _).
  apply midpoint_fits in F1. fold first in F1. change (normal width first) in N1.
  destruct (big_product_contains width (2 * k + width + 4) first first W0 ltac:(lia) N1 N1 F1 F1) as (N2 & F2 & _).
  assert (F2' : fits (4 * k + 3 * width + 12) (multiply width first first)) by (apply fits_le with (2 := F2); lia).
  assert (Fs' : fits (4 * k + 3 * width + 12) square) by (apply fits_le with (2 := Fs); lia).
  destruct (big_difference_contains width (4 * k + 3 * width + 12) square _ W0 ltac:(lia) Na N2 Fs' F2') as (N3 & F3 & _).
  set (rough := subtract width square (multiply width first first)) in *.
  assert (F3' : fits (4 * k + 4 * width + 15) rough) by (apply fits_le with (2 := F3); lia).
  destruct (big_product_contains width (4 * k + 4 * width + 15) rough inverse W0 ltac:(lia) N3 Ni F3') as (N4 & F4 & _);
    [apply fits_le with (2 := Fi); lia|].
  apply (scaled_fits _ (-1)) in F4; [|lia].
  assert (F4' : fits (8 * k + 9 * width + 35) (scaled (multiply width rough inverse) (-1))) by (apply fits_le with (2 := F4); lia).
  assert (F1' : fits (8 * k + 9 * width + 35) first) by (apply fits_le with (2 := F1); lia).
  destruct (big_sum_contains width (8 * k + 9 * width + 35) first (scaled (multiply width rough inverse) (-1)) W0 ltac:(lia) N1
    N4 F1' F4') as
    (N5 & F5 & _).
  pose proof (sum_rounds width (8 * k + 9 * width + 35) first (scaled (multiply width rough inverse) (-1)) W0 ltac:(lia) N1 N4
    F1' F4') as R5.
  rewrite value_halved in R5. apply midpoint_fits in F5.
  change (value width (add width first (scaled (multiply width rough inverse) (-1)))) with
    (value width (midpoint (add width first (scaled (multiply width rough inverse) (-1))))) in R5.
  set (root := midpoint (add width first (scaled (multiply width rough inverse) (-1)))) in *. change (normal width root) in N5.
  destruct (big_product_contains width (8 * k + 10 * width + 38) root root W0 ltac:(lia) N5 N5) as (N6 & F6 & _);
    [apply fits_le with (2 := F5); lia|apply fits_le with (2 := F5); lia|].
  assert (F6' : fits (16 * k + 21 * width + 80) (multiply width root root)) by (apply fits_le with (2 := F6); lia).
  assert (Fs6 : fits (16 * k + 21 * width + 80) square) by (apply fits_le with (2 := Fs); lia).
  destruct (big_difference_contains width (16 * k + 21 * width + 80) square _ W0 ltac:(lia) Na N6 Fs6 F6') as (N7 & _ & _).
  pose proof (product_rounds width rough inverse W0 N3 Ni) as R4.
  pose proof (sum_rounds width (4 * k + 3 * width + 12) square (negated (multiply width first first)) W0 ltac:(lia) Na N2 Fs' F2') as R3.
  rewrite value_negated in R3. fold (subtract width square (multiply width first first)) in R3. fold rough in R3.
  pose proof (product_rounds width first first W0 N1 N1) as R2. pose proof (product_rounds width square inverse W0 Na Ni) as R1.
  change (value width (multiply width square inverse)) with (value width first) in R1.
  pose proof (product_rounds width root root W0 N5 N5) as R6.
  pose proof (sum_rounds width (16 * k + 21 * width + 80) square (negated (multiply width root root)) W0 ltac:(lia) Na N6 Fs6 F6') as R7.
  rewrite value_negated in R7. set (back := multiply width root root) in *. fold (subtract width square back) in R7.
  set (rest := subtract width square back) in *. change (value width square) with (value width a) in *.
  set (A := value width a) in *. set (i := value width inverse) in *. set (e := bpow radix2 (4 - width)) in *.
  assert (E : 0 <= e <= / 1000).
  { split; [apply bpow_ge_0|]. apply Rle_trans with (bpow radix2 (-10)); [apply bpow_le; lia|]. simpl. lra. }
  assert (PA : 0 < A) by lra.
  assert (Q : Rabs (A - value width root * value width root) <= 11 * (e * A)).
  { apply (root_remainder_in_reals e (bpow radix2 (- j)) A i (value width first) (value width (multiply width first first))
      (value width rough) (value width (multiply width rough inverse))); try assumption.
    - split; [apply bpow_ge_0|]. apply Rle_trans with (bpow radix2 (-10)); [apply bpow_le; lia|]. simpl. lra.
    - unfold e. rewrite <- bpow_plus. apply bpow_le. lia. }
  assert (T : 0 <= e * A <= A / 1000).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (/ 1000 * A); [apply Rmult_le_compat_r; lra|lra]. }
  destruct (root_exponent width root A (exponent a) W0 N5 (conj A1 A2) ltac:(lra)) as [Zr X].
  split; [exact Zr|]. split; [exact X|].
  set (R := value width root * value width root) in *.
  assert (QB : Rabs R <= 1012 / 1000 * A) by (apply Rabs_le_inv in Q; apply Rabs_le; lra).
  pose proof (share_times e _ _ _ (proj1 E) QB) as R6'. pose proof (off_by_share _ _ _ R6) as V6.
  assert (V6' : Rabs (- value width back) <= 1020 / 1000 * A) by (rewrite Rabs_Ropp; lra).
  pose proof (share_times e _ _ _ (proj1 E) V6') as R7'. rewrite Rmult_plus_distr_l, (Rabs_pos_eq A) in R7 by lra.
  assert (Zk : is_zero back = false).
  { destruct (is_zero back) eqn:Z; [exfalso|reflexivity]. rewrite (value_of_zero width back Z) in R6.
    apply Rabs_le_inv in R6, Q. lra. }
  assert (Ek : (exponent back <= exponent a + 2)%Z).
  { apply (exponent_below width back (exponent a + 1)) in Zk; try assumption; [lia|]. rewrite bpow_double. rewrite Rabs_Ropp in V6'. lra. }
  assert (V7 : Rabs (value width rest) <= bpow radix2 (exponent a + 8 - width)).
  { replace (exponent a + 8 - width)%Z with (4 - width + exponent a + 1 + 1 + 1 + 1)%Z by ring. rewrite !bpow_double, bpow_plus. fold e.
    assert (S : e * A <= e * bpow radix2 (exponent a)) by (apply Rmult_le_compat_l; lra).
    apply Rabs_le_inv in R6, R7, Q. apply Rabs_le. lra. }
  assert (Xk : (error back = none \/ error back <= exponent back - width + 4)%Z).
  { unfold back, multiply. destruct (is_zero root || is_zero root) eqn:Z.
    { exfalso. unfold back, multiply in Zk. rewrite Z in Zk. discriminate. }
    cbn [error exponent with_error]. set (part := (if _ <? _ then 1 else 0)%Z).
    assert (P : (0 <= part <= 1)%Z) by (unfold part; destruct (_ <? _)%Z; lia). unfold propagated_by_product.
    change (error root) with none. destruct F5 as [E5 _]. clear - E5 P Hr W K. destruct (negb _).
    - apply clamp_at_most. numbers. lia.
    - left. unfold clamp. rewrite (proj2 (Z.ltb_lt _ _)); [reflexivity|]. numbers. lia. }
  pose proof (big_sum_is_narrow width square (negated back) Za Zk) as S. cbv zeta in S. fold (subtract width square back) in S.
    fold rest in S.
  change (error square) with none in S. change (error (negated back)) with (error back) in S.
  change (exponent (negated back)) with (exponent back) in S. change (exponent square) with (exponent a) in S.
  assert (M : (magnitude rest <= exponent a + 10 - width)%Z).
  { unfold magnitude. destruct Fa as [Ea _]. destruct (is_zero rest) eqn:Z.
    - clear - S Xk Ek Ea Hr K W. numbers. lia.
    - apply (exponent_below width rest _ W0 N7) in V7; [|exact Z]. clear - S Xk Ek V7 Ea Hr K W. numbers. lia. }
  set (total := (Z.max (magnitude rest - exponent root + 1) (error a - exponent root + 2) + 1)%Z).
  change (error (with_error root total)) with (clamp total). change (exponent (with_error root total)) with (exponent root).
  destruct (clamp_at_most total total (Z.le_refl _)) as [N|N]; [now left|right]. unfold total in *. clear - N M X. lia.
Qed.
