(* SPDX-License-Identifier: BSD-3-Clause *)
(* The bounds of sums and products of numbers of the third stage are narrow, and a root is positive if what Newton's method gave for
   its inverse is: fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core.
From Forceshade Require Import BigFloat BigFloatValues.
From Forceshade Require Import BigFloatSums BigFloatProducts BigFloatQuotients.
Open Scope R_scope.

Lemma clamp_at_most : forall e f, (e <= f)%Z -> clamp e = none \/ (clamp e <= f)%Z.
Proof. intros e f H. unfold clamp. destruct (Z.ltb_spec e least); [now left|right]. destruct (Z.ltb_spec infinite e); lia. Qed.

(* A sum: two bits more than the larger of both errors and of two units in the last place of the larger operand. *)
Theorem big_sum_is_narrow : forall width a b, is_zero a = false -> is_zero b = false ->
  let r := add width a b in
  error r = none \/
  (error r <= Z.max (Z.max (error a) (error b)) (Z.max none (Z.max (exponent a) (exponent b) - width + 1)) + 2)%Z.
Proof.
  assert (H : forall width a b, (exponent b <= exponent a)%Z -> let r := add_smaller width a b in error r = none \/
    (error r <= Z.max (Z.max (error a) (error b)) (Z.max none (exponent a - width + 1)) + 2)%Z).
  { intros width a b E r. unfold r, add_smaller. cbn [error with_error]. apply clamp_at_most.
    set (shifted := (digits b / 2 ^ (exponent a - exponent b))%Z).
    assert (L : (error (if eqb (negative a) (negative b) then add_limbs width a shifted else subtract_limbs width a shifted) <=
      Z.max (error a) (exponent a + 1 - width))%Z).
    { destruct (eqb _ _); [unfold add_limbs; destruct (_ <? _)%Z; cbn [error]; [lia|destruct (_ =? 0)%Z; lia]|].
      unfold subtract_limbs, normalised. destruct (is_zero _); cbn [error]; lia. }
    destruct (negb _); lia. }
  intros width a b Za Zb r. unfold r, add. rewrite Za, Zb. destruct (is_larger a b) eqn:L.
  - assert (E : (exponent b <= exponent a)%Z) by (unfold is_larger in L; destruct (Z.eqb_spec (exponent a) (exponent b)); lia).
    destruct (H width a b E) as [N|N]; [now left|right]. lia.
  - apply is_larger_total in L.
    assert (E : (exponent a <= exponent b)%Z) by (unfold is_larger in L; destruct (Z.eqb_spec (exponent b) (exponent a)); lia).
    destruct (H width b a E) as [N|N]; [now left|right]. lia.
Qed.

(* A product: three bits more than the larger of both relative errors and of two units in the last place. *)
Theorem big_product_is_narrow : forall width a b, is_zero a = false -> is_zero b = false ->
  (error a <= exponent a)%Z -> (error b <= exponent b)%Z ->
  (- range <= exponent a <= range)%Z -> (- range <= exponent b <= range)%Z -> let r := multiply width a b in
  error r = none \/
  (error r - exponent r <= Z.max (Z.max (error a - exponent a) (error b - exponent b)) (1 - width) + 3)%Z.
Proof.
  intros width a b Za Zb Ea Eb Ra Rb r. unfold r, multiply in *. rewrite Za, Zb in *. cbn [orb] in *.
  set (product := (digits a * digits b)%Z) in *. set (part := (if product <? 2 ^ (2 * width - 1) then 1 else 0)%Z) in *.
  assert (P : (0 <= part <= 1)%Z) by (unfold part; destruct (_ <? _)%Z; lia). cbn [error exponent with_error] in *.
  set (propagated := propagated_by_product a b). assert (B : (propagated <= exponent a + exponent b +
    Z.max (error a - exponent a) (error b - exponent b))%Z) by (unfold propagated, propagated_by_product; lia).
  destruct (clamp_at_most (Z.max propagated (if negb (product mod 2 ^ (width - part) =? 0)%Z then
    exponent a + exponent b - part - width + 2 else none) + 2) _ (Z.le_refl _)) as [N|N]; [now left|].
  destruct (negb _); [right; lia|]. unfold clamp in *. destruct (Z.ltb_spec (Z.max propagated none + 2) least); [now left|right].
  numbers. lia.
Qed.

(* ---- What a sum and a product round ---- *)

Lemma sum_of_midpoints : forall width a b, value width (add width a b) = value width (add width (midpoint a) (midpoint b)).
Proof.
  intros width a b. unfold add. change (is_zero (midpoint a)) with (is_zero a). change (is_zero (midpoint b)) with (is_zero b).
  change (is_larger (midpoint a) (midpoint b)) with (is_larger a b).
  assert (H : forall c d, value width (add_smaller width c d) = value width (add_smaller width (midpoint c) (midpoint d))).
  { intros c d. unfold add_smaller, value, signed. cbn [negative digits exponent with_error midpoint].
    destruct (eqb (negative c) (negative d)).
    - unfold add_limbs. cbn [negative digits exponent midpoint]. destruct (_ <? _)%Z; reflexivity.
    - unfold subtract_limbs, normalised. cbn [negative digits exponent midpoint].
      unfold is_zero. cbn [digits]. destruct (_ =? 0)%Z; reflexivity. }
  destruct (is_zero a), (is_zero b), (is_larger a b); try reflexivity; apply H.
Qed.

Lemma exponent_and_value : forall width a, (0 < width)%Z -> normal width a -> is_zero a = false ->
  bpow radix2 (exponent a) <= 2 * Rabs (value width a).
Proof.
  intros width a W N Z. pose proof (value_above width a W N Z). pose proof (bpow_double (exponent a - 1)) as D.
  replace (exponent a - 1 + 1)%Z with (exponent a) in D by ring. lra.
Qed.

Lemma sum_rounds : forall width k a b, (0 < width)%Z -> (k + width + 3 <= range)%Z -> normal width a -> normal width b ->
  fits k a -> fits k b ->
  Rabs (value width (add width a b) - (value width a + value width b)) <= bpow radix2 (4 - width) * (Rabs (value width a) + Rabs (value
      width b)).
Proof.
  intros width k a b W Hr Na Nb Fa Fb. pose proof (bpow_gt_0 radix2 (4 - width)) as P.
  pose proof (Rabs_pos (value width a)) as Pa. pose proof (Rabs_pos (value width b)) as Pb.
  assert (T : 0 <= bpow radix2 (4 - width) * (Rabs (value width a) + Rabs (value width b))) by (apply Rmult_le_pos; lra).
  destruct (is_zero a) eqn:Za.
  { unfold add. rewrite Za. change (value width (with_error b ?e)) with (value width b). rewrite (value_of_zero width a Za) in *.
    replace (value width b - (0 + value width b)) with 0 by ring. apply Rle_trans with (2 := T); rewrite Rabs_R0; lra. }
  destruct (is_zero b) eqn:Zb.
  { unfold add. rewrite Za, Zb. change (value width (with_error a ?e)) with (value width a). rewrite (value_of_zero width b Zb) in *.
    replace (value width a - (value width a + 0)) with 0 by ring. apply Rle_trans with (2 := T); rewrite Rabs_R0; lra. }
  rewrite sum_of_midpoints. apply midpoint_fits in Fa, Fb.
  destruct (big_sum_contains width k (midpoint a) (midpoint b) W Hr Na Nb Fa Fb) as (_ & [_ Fr] & C).
  specialize (C _ _ (big_midpoint_contains width a) (big_midpoint_contains width b)).
  pose proof (big_sum_is_narrow width (midpoint a) (midpoint b) Za Zb) as B. cbv zeta in B.
  set (r := add width (midpoint a) (midpoint b)) in *. cbn [error exponent midpoint] in B. rewrite <- Rabs_Ropp.
  replace (- (value width r - (value width a + value width b))) with (value width a + value width b - value width r) by ring.
  set (e := Z.max (exponent a) (exponent b)) in *. assert (Be : (- k <= e <= k)%Z) by (destruct Fa as [Fa _], Fb as [Fb _]; cbn [exponent
      midpoint] in *; lia).
  apply Rle_trans with (bpow radix2 (e - width + 3)).
  - destruct C as [C|C]; [numbers; lia|]. apply Rle_trans with (1 := C). rewrite <- size_some by (numbers; lia). apply size_le. numbers.
      lia.
  - replace (e - width + 3)%Z with (4 - width + (e - 1))%Z by ring. rewrite bpow_plus. apply Rmult_le_compat_l; [lra|].
    pose proof (value_above width a W Na Za). pose proof (value_above width b W Nb Zb).
    destruct (Z.max_spec (exponent a) (exponent b)) as [[_ E]|[_ E]]; fold e in E; rewrite E; lra.
Qed.

Lemma product_rounds : forall width a b, (0 < width)%Z -> normal width a -> normal width b ->
  Rabs (value width (multiply width a b) - value width a * value width b) <= bpow radix2 (4 - width) * Rabs (value width a * value width b).
Proof.
  intros width a b W Na Nb. pose proof (bpow_gt_0 radix2 (4 - width)) as P.
  assert (T : 0 <= bpow radix2 (4 - width) * Rabs (value width a * value width b)) by (apply Rmult_le_pos; [lra|apply Rabs_pos]).
  destruct (is_zero a || is_zero b) eqn:Z.
  { unfold multiply. rewrite Z. rewrite value_with_error, (value_of_zero width zero eq_refl).
    replace (value width a * value width b) with 0 in *; [replace (0 - 0) with 0 by ring; apply Rle_trans with (2 := T); rewrite Rabs_R0;
        lra|].
    apply orb_prop in Z. destruct Z as [Z|Z]; rewrite (value_of_zero _ _ Z); ring. }
  pose proof Z as Z'. apply orb_false_iff in Z'. destruct Z' as [Za Zb].
  destruct (product_of_digits width a b W Na Nb Za Zb) as (P1 & _ & V & _). unfold multiply. rewrite Z, value_with_error.
  set (part := (if digits a * digits b <? 2 ^ (2 * width - 1) then 1 else 0)%Z) in *. rewrite <- Rabs_Ropp.
  match goal with |- Rabs (- (?v - ?p)) <= _ => replace (- (v - p)) with (p - v) by ring end. apply Rle_trans with (1 := V).
  rewrite Rabs_mult. pose proof (value_above width a W Na Za). pose proof (value_above width b W Nb Zb).
  apply Rle_trans with (bpow radix2 (4 - width) * (bpow radix2 (exponent a - 1) * bpow radix2 (exponent b - 1))).
  - rewrite <- !bpow_plus. apply bpow_le. lia.
  - apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat; try assumption; apply bpow_ge_0.
Qed.

(* ---- The root is positive ---- *)

Lemma share_of : forall e x b, 0 <= e <= / 1000 -> Rabs x <= b -> e * Rabs x <= b / 1000.
Proof.
  intros e x b E B. pose proof (Rabs_pos x) as P. apply Rle_trans with (/ 1000 * b); [apply Rmult_le_compat; lra|lra].
Qed.

Lemma positive_root_in_reals : forall e A i f S D P r, 0 <= e <= / 1000 -> 0 < A -> 0 < i -> A * (i * i) <= 2 ->
  Rabs (f - A * i) <= e * Rabs (A * i) -> Rabs (S - f * f) <= e * Rabs (f * f) -> Rabs (D - (A + - S)) <= e * (Rabs A + Rabs (- S)) ->
  Rabs (P - D * i) <= e * Rabs (D * i) -> Rabs (r - (f + P / 2)) <= e * (Rabs f + Rabs (P / 2)) -> 0 < r.
Proof.
  intros e A i f S D P r E PA Pi H Hf HS HD HP Hr. set (T := A * i) in *. assert (PT : 0 < T) by (now apply Rmult_lt_0_compat).
  assert (TT : T * T <= 2 * A) by (replace (T * T) with (A * (A * (i * i))) by (unfold T; ring); rewrite (Rmult_comm 2); apply
      Rmult_le_compat_l; lra).
  pose proof (share_of e T T E ltac:(rewrite Rabs_pos_eq; lra)) as B1. apply Rabs_le_inv in Hf.
  assert (F : 999 / 1000 * T <= f <= 1001 / 1000 * T) by lra.
  assert (FF : 0 <= f * f <= 1003 / 1000 * (T * T)).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (1001 / 1000 * T * (1001 / 1000 * T)); [apply Rmult_le_compat; lra|].
    pose proof (Rmult_lt_0_compat _ _ PT PT). lra. }
  pose proof (share_of e (f * f) (3 * A) E ltac:(rewrite Rabs_pos_eq; lra)) as B2. apply Rabs_le_inv in HS.
  assert (S3 : - (A / 300) <= S <= 2010 / 1000 * A) by lra.
  assert (B3 : e * (Rabs A + Rabs (- S)) <= A * 4 / 1000).
  { rewrite Rmult_plus_distr_l. pose proof (share_of e A A E ltac:(rewrite Rabs_pos_eq; lra)).
    pose proof (share_of e (- S) (3 * A) E ltac:(apply Rabs_le; lra)). lra. }
  apply Rabs_le_inv in HD. assert (BD : Rabs D <= 1020 / 1000 * A) by (apply Rabs_le; lra).
  assert (BDi : Rabs (D * i) <= 1020 / 1000 * T).
  { rewrite Rabs_mult, (Rabs_pos_eq i) by lra. unfold T. rewrite <- Rmult_assoc. apply Rmult_le_compat_r; lra. }
  pose proof (share_of e (D * i) _ E BDi) as B4. apply Rabs_le_inv in HP. apply Rabs_le_inv in BDi.
  assert (BP : Rabs (P / 2) <= 520 / 1000 * T) by (apply Rabs_le; lra).
  assert (B5 : e * (Rabs f + Rabs (P / 2)) <= T * 2 / 1000).
  { rewrite Rmult_plus_distr_l. pose proof (share_of e f (1001 / 1000 * T) E ltac:(rewrite Rabs_pos_eq; lra)).
    pose proof (share_of e (P / 2) _ E BP). lra. }
  apply Rabs_le_inv in Hr. apply Rabs_le_inv in BP. lra.
Qed.

Lemma value_negated : forall width a, value width (negated a) = - value width a.
Proof. intros width a. unfold value, signed, negated. cbn [negative digits exponent]. destruct (negative a); simpl negb; cbv iota; rewrite
    ?opp_IZR; ring. Qed.

Lemma value_halved : forall width a, value width (scaled a (-1)) = value width a / 2.
Proof.
  intros width a. pose proof (bpow_double (exponent a + -1 - width)) as D. replace (exponent a + -1 - width + 1)%Z with (exponent a -
      width)%Z in D by ring.
  unfold value. rewrite D. change (signed (scaled a (-1))) with (signed a). change (exponent (scaled a (-1))) with (exponent a + -1)%Z.
      field.
Qed.

Lemma root_is_positive : forall width k a inverse, (14 <= width)%Z -> (60 * (k + width + 10) <= range)%Z -> normal width a ->
  normal width inverse -> fits k a -> fits k inverse -> 0 < value width a -> 0 < value width inverse ->
  value width a * (value width inverse * value width inverse) <= 2 ->
  let root := root_of_midpoint width (midpoint a) inverse in normal width root /\ 0 < value width root.
Proof.
  intros width k a inverse W Hr Na Ni Fa Fi PA Pi H root. assert (W0 : (0 < width)%Z) by lia.
  assert (K : (0 <= k)%Z) by (destruct Fa; lia). unfold root, root_of_midpoint. set (square := midpoint a). set (first := midpoint
      (multiply width square inverse)).
  assert (Fs : fits k square) by now apply midpoint_fits.
  destruct (big_product_contains width k square inverse W0 ltac:(lia) Na Ni Fs Fi) as (N1 & F1 & _).
  apply midpoint_fits in F1. fold first in F1. change (normal width first) in N1.
  destruct (big_product_contains width (2 * k + width + 4) first first W0 ltac:(lia) N1 N1 F1 F1) as (N2 & F2 & _).
  assert (F2' : fits (4 * k + 3 * width + 12) (multiply width first first)) by (apply fits_le with (2 := F2); lia).
  assert (Fs' : fits (4 * k + 3 * width + 12) square) by (apply fits_le with (2 := Fs); lia).
  destruct (big_difference_contains width (4 * k + 3 * width + 12) square (multiply width first first) W0 ltac:(lia) Na N2 Fs' F2') as (N3
      & F3 & _).
  assert (F3' : fits (4 * k + 4 * width + 15) (subtract width square (multiply width first first))) by (apply fits_le with (2 := F3); lia).
  destruct (big_product_contains width (4 * k + 4 * width + 15) _ inverse W0 ltac:(lia) N3 Ni F3') as (N4 & F4 & _);
    [apply fits_le with (2 := Fi); lia|].
  apply (scaled_fits _ (-1)) in F4; [|lia].
  assert (F4' : fits (8 * k + 9 * width + 35) (scaled (multiply width (subtract width square (multiply width first first)) inverse) (-1)))
    by (apply fits_le with (2 := F4); lia).
  assert (F1' : fits (8 * k + 9 * width + 35) first) by (apply fits_le with (2 := F1); lia).
  split.
  { destruct (big_sum_contains width (8 * k + 9 * width + 35) first (scaled (multiply width (subtract width square (multiply width first
      first)) inverse) (-1)) W0
      ltac:(lia) N1 N4 F1' F4') as (N5 & _). exact N5. }
  change (value width (midpoint ?r)) with (value width r).
  pose proof (sum_rounds width (8 * k + 9 * width + 35) first (scaled (multiply width (subtract width square (multiply width first first))
      inverse) (-1)) W0
    ltac:(lia) N1 N4 F1' F4') as R5. rewrite value_halved in R5.
  pose proof (product_rounds width _ _ W0 N3 Ni) as R4.
  pose proof (sum_rounds width (4 * k + 3 * width + 12) square (negated (multiply width first first)) W0 ltac:(lia) Na N2 Fs' F2') as R3.
      rewrite value_negated in R3.
  pose proof (product_rounds width _ _ W0 N1 N1) as R2. pose proof (product_rounds width square inverse W0 Na Ni) as R1.
  apply (positive_root_in_reals (bpow radix2 (4 - width)) (value width a) (value width inverse) (value width first)
    (value width (multiply width first first)) (value width (subtract width square (multiply width first first)))
    (value width (multiply width (subtract width square (multiply width first first)) inverse))); [|exact PA|exact Pi|exact H|exact
        R1|exact R2|exact R3|exact R4|exact R5].
  split; [apply bpow_ge_0|]. apply Rle_trans with (bpow radix2 (-10)); [apply bpow_le; lia|]. simpl. lra.
Qed.

(* So the root's bound is one for whatever Newton's method gave that is positive and no larger than the root of 2 times what it is to
   give. *)
Theorem big_root_contains_for : forall width k a inverse, (14 <= width)%Z -> (60 * (k + width + 10) <= range)%Z -> normal width a ->
  normal width inverse -> fits k a -> fits k inverse -> (error a < boundless)%Z ->
  (may_be_zero a = false -> negative a = false ->
    0 < value width inverse /\ value width a * (value width inverse * value width inverse) <= 2) ->
  forall x, contains width a x -> contains width (square_root width a inverse) (sqrt x).
Proof.
  intros width k a inverse W Hr Na Ni Fa Fi Hb Hp. assert (W0 : (0 < width)%Z) by lia.
  apply (big_root_contains width k a inverse); try assumption. intros Zm Zn. destruct (Hp Zm Zn) as [Pi H].
  assert (Za : is_zero a = false) by (now apply orb_false_iff in Zm). pose proof (value_above width a W0 Na Za) as A.
  pose proof (bpow_gt_0 radix2 (exponent a - 1)) as G.
  assert (PA : 0 < value width a).
  { rewrite Rabs_pos_eq in A; [lra|]. unfold value, signed. rewrite Zn. apply Rmult_le_pos; [|apply bpow_ge_0].
    apply IZR_le. now apply (normal_digits width a W0 Na). }
  pose proof (root_is_positive width k a inverse W Hr Na Ni Fa Fi PA Pi H) as R. cbv zeta in R.
  set (root := root_of_midpoint width (midpoint a) inverse) in *.
  destruct R as [Nr R]. split; [destruct (is_zero root) eqn:Z; [rewrite (value_of_zero width root Z) in R; lra|reflexivity]|].
  destruct (negative root) eqn:Z; [exfalso|reflexivity]. revert R. apply Rle_not_lt. unfold value, signed. rewrite Z, opp_IZR.
  rewrite Ropp_mult_distr_l_reverse. apply Ropp_le_cancel. rewrite Ropp_0, Ropp_involutive.
  apply Rmult_le_pos; [|apply bpow_ge_0]. apply IZR_le. now apply (normal_digits width root W0 Nr).
Qed.
