(* SPDX-License-Identifier: BSD-3-Clause *)
(* Products of two numbers of the third stage, and the signs that it takes: fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core.
From Forceshade Require Import BigFloat BigFloatValues Intervals.
From Forceshade Require Import BigFloatSums.
Open Scope R_scope.

Lemma exact_zero_is : forall width k a x, fits k a -> (k <= range)%Z -> is_exact_zero a = true -> contains width a x -> x = 0.
Proof.
  intros width k a x [_ F] K Z H. apply andb_prop in Z. destruct Z as [Z E]. apply Z.ltb_lt in E. unfold contains in H.
  rewrite (value_of_zero width a Z), Rminus_0_r in H. destruct H as [H|H]; [numbers; lia|]. rewrite (size_none _ E) in H.
  apply Rabs_eq_R0. pose proof (Rabs_pos x). lra.
Qed.

Lemma zero_contains : forall width e d, within e (Rabs d) -> contains width (with_error zero e) d.
Proof. intros width e d H. apply contains_with_error. now rewrite (value_of_zero width zero eq_refl), Rminus_0_r. Qed.

(* What the errors of both factors make, at most. *)
Lemma propagated_by_product_is : forall width k a b x y, (0 < width)%Z -> (2 * k <= range)%Z -> fits k a -> fits k b ->
  Rabs (value width a) <= bpow radix2 (exponent a) -> Rabs (value width b) <= bpow radix2 (exponent b) ->
  contains width a x -> contains width b y ->
  let e := propagated_by_product a b in (boundless <= e)%Z \/ Rabs (x * y - value width a * value width b) <= 3 * size e.
Proof.
  intros width k a b x y W Hr [Ea Fa] [Eb Fb] Ba Bb Hx Hy e.
  destruct (Z.le_gt_cases boundless (error a)) as [Ia|Ia]; [left; unfold e, propagated_by_product; numbers; lia|].
  destruct (Z.le_gt_cases boundless (error b)) as [Ib|Ib]; [left; unfold e, propagated_by_product; numbers; lia|right].
  destruct Hx as [Hx|Hx]; [lia|]. destruct Hy as [Hy|Hy]; [lia|].
  pose proof (product_is_off_by _ _ _ _ _ _ Hx Hy) as H. apply Rle_trans with (1 := H). clear H Hx Hy.
  pose proof (size_pos (error a)) as Pa. pose proof (size_pos (error b)) as Pb.
  assert (Rabs (value width a) * size (error b) <= size e).
  { apply Rle_trans with (size (error b) * bpow radix2 (exponent a)); [rewrite Rmult_comm; now apply Rmult_le_compat_l|].
    apply Rle_trans with (size (error b + exponent a)); [apply size_times; numbers; lia|apply size_le; unfold e, propagated_by_product;
        lia]. }
  assert (Rabs (value width b) * size (error a) <= size e).
  { apply Rle_trans with (size (error a) * bpow radix2 (exponent b)); [rewrite Rmult_comm; now apply Rmult_le_compat_l|].
    apply Rle_trans with (size (error a + exponent b)); [apply size_times; numbers; lia|apply size_le; unfold e, propagated_by_product;
        lia]. }
  assert (size (error b) * size (error a) <= size e); [|lra].
  apply Rle_trans with (size (error b + error a)); [apply size_product; numbers; lia|apply size_le; unfold e, propagated_by_product; lia].
Qed.

Lemma value_at_most : forall width a, (0 < width)%Z -> normal width a -> Rabs (value width a) <= bpow radix2 (exponent a).
Proof. intros width a W N. now apply Rlt_le, value_below. Qed.

Lemma propagated_by_product_fits : forall k c a b, (0 <= c <= range)%Z -> (2 * k + c <= range)%Z -> fits k a -> fits k b ->
  error_fits (2 * k + c) (clamp (propagated_by_product a b + c)).
Proof. intros k c a b C Hr [Ea Fa] [Eb Fb]. apply clamp_fits; [lia|]. unfold propagated_by_product. numbers. lia. Qed.

Lemma product_of_digits : forall width a b, (0 < width)%Z -> normal width a -> normal width b -> is_zero a = false -> is_zero b = false ->
  let product := (digits a * digits b)%Z in let part := (if product <? 2 ^ (2 * width - 1) then 1 else 0)%Z in
  let rest := (2 ^ (width - part))%Z in let e := (exponent a + exponent b - part)%Z in
  let v := value width (Big (xorb (negative a) (negative b)) (product / rest) e none) in
  (0 <= part <= 1)%Z /\ (2 ^ (width - 1) <= product / rest < 2 ^ width)%Z /\
  Rabs (value width a * value width b - v) <= bpow radix2 (e - width) /\
  ((product mod rest = 0)%Z -> value width a * value width b = v).
Proof.
  intros width a b W Na Nb Za Zb product part rest e v. destruct (top_of_normal _ _ Na Za) as [La Ua].
  destruct (top_of_normal _ _ Nb Zb) as [Lb Ub]. pose proof (power_pos (width - 1) ltac:(lia)) as P1.
  assert (L : (2 ^ (width - 1) * 2 ^ (width - 1) <= product)%Z) by (apply Z.mul_le_mono_nonneg; lia).
  assert (U : (product < 2 ^ width * 2 ^ width)%Z) by (apply Z.mul_lt_mono_nonneg; lia).
  assert (B : (0 <= part <= 1)%Z) by (unfold part; destruct (product <? 2 ^ (2 * width - 1))%Z; lia).
  pose proof (power_pos (width - part) ltac:(lia)) as P. fold rest in P. pose proof (Z.div_mod product rest ltac:(lia)) as DM.
  pose proof (Z.mod_pos_bound product rest P) as M. split; [exact B|]. split.
  - unfold rest, part. destruct (Z.ltb_spec product (2 ^ (2 * width - 1))) as [H|H].
    + replace (2 * width - 1)%Z with (width - 1 + width)%Z in H by ring. rewrite power_split in H by lia.
      split; [apply Z.div_le_lower_bound; lia|apply Z.div_lt_upper_bound; lia].
    + replace (2 * width - 1)%Z with (width - 1 + width)%Z in H by ring. rewrite power_split in H by lia.
      rewrite Z.sub_0_r. pose proof (power_pos width ltac:(lia)).
      split; [apply Z.div_le_lower_bound; lia|apply Z.div_lt_upper_bound; lia].
  - unfold v. clear v L U. set (q := (product / rest)%Z) in *. set (r := (product mod rest)%Z) in *.
    assert (V : Rabs (value width a * value width b - value width (Big (xorb (negative a) (negative b)) q e none)) =
      IZR r * bpow radix2 (exponent a + exponent b - 2 * width)).
    { assert (E : value width a * value width b = IZR (if xorb (negative a) (negative b) then - product else product) *
        bpow radix2 (exponent a + exponent b - 2 * width)).
      { unfold value, signed. replace (exponent a + exponent b - 2 * width)%Z with (exponent a - width + (exponent b - width))%Z by ring.
        rewrite bpow_plus. unfold product. destruct (negative a), (negative b); cbn [xorb]; rewrite ?opp_IZR, mult_IZR; ring. }
      rewrite E. unfold value, signed. cbn [negative digits exponent]. unfold e.
      replace (exponent a + exponent b - part - width)%Z with (width - part + (exponent a + exponent b - 2 * width))%Z by ring.
      rewrite bpow_plus, <- (IZR_power (width - part)) by lia. fold rest.
      rewrite <- (Rabs_pos_eq (IZR r * _)) by (apply Rmult_le_pos; [apply IZR_le; lia|apply bpow_ge_0]).
      destruct (xorb (negative a) (negative b)); [rewrite <- Rabs_Ropp|]; f_equal; rewrite ?opp_IZR, DM, plus_IZR, mult_IZR; ring. }
    split.
    + rewrite V. unfold e. replace (exponent a + exponent b - part - width)%Z with (width - part + (exponent a + exponent b - 2 * width))%Z
        by ring.
      rewrite bpow_plus, <- (IZR_power (width - part)) by lia. apply Rmult_le_compat_r; [apply bpow_ge_0|apply IZR_le; fold rest; lia].
    + intro H. rewrite H, Rmult_0_l in V. apply Rminus_diag_uniq.
      destruct (Req_dec (value width a * value width b - value width (Big (xorb (negative a) (negative b)) q e none)) 0) as [Q|Q]; [exact
          Q|].
      now apply Rabs_no_R0 in Q.
Qed.

Theorem big_product_contains : forall width k a b, (0 < width)%Z -> (2 * k + width + 4 <= range)%Z -> normal width a -> normal width b ->
  fits k a -> fits k b -> let r := multiply width a b in
  normal width r /\ fits (2 * k + width + 4) r /\ forall x y, contains width a x -> contains width b y -> contains width r (x * y).
Proof.
  intros width k a b W Hr Na Nb Fa Fb r. pose proof (value_at_most _ _ W Na) as Ba. pose proof (value_at_most _ _ W Nb) as Bb.
  assert (K : (0 <= k)%Z) by (destruct Fa; lia). unfold r, multiply. destruct (is_zero a || is_zero b) eqn:Z.
  - split; [now left|]. split.
    + split; [cbn [exponent with_error zero]; lia|]. cbn [error with_error]. destruct (is_exact_zero a || is_exact_zero b);
        [apply clamp_fits; numbers; lia|]. pose proof (propagated_by_product_fits k 2 a b ltac:(numbers; lia) ltac:(lia) Fa Fb) as H.
      numbers. lia.
    + intros x y Hx Hy. apply zero_contains. destruct (is_exact_zero a || is_exact_zero b) eqn:E.
      * right. replace (x * y) with 0; [rewrite Rabs_R0; apply size_pos|]. apply orb_prop in E. destruct E as [E|E].
        { rewrite (exact_zero_is width k a x Fa ltac:(lia) E Hx). ring. }
        { rewrite (exact_zero_is width k b y Fb ltac:(lia) E Hy). ring. }
      * destruct (propagated_by_product_is width k a b x y W ltac:(lia) Fa Fb Ba Bb Hx Hy) as [H|H]; [left; lia|right].
        replace (value width a * value width b) with 0 in H.
        { rewrite Rminus_0_r in H. pose proof (size_four (propagated_by_product a b)). pose proof (size_pos (propagated_by_product a b)).
            lra. }
        apply orb_prop in Z. destruct Z as [Z|Z]; rewrite (value_of_zero _ _ Z); ring.
  - apply orb_false_iff in Z. destruct Z as [Za Zb]. destruct (product_of_digits width a b W Na Nb Za Zb) as (P & Q & V & V0).
    set (product := (digits a * digits b)%Z) in *. set (part := (if product <? 2 ^ (2 * width - 1) then 1 else 0)%Z) in *.
    set (rest := (2 ^ (width - part))%Z) in *. set (e := (exponent a + exponent b - part)%Z) in *.
    set (c := Big (xorb (negative a) (negative b)) (product / rest) e none) in *.
    assert (Ec : (- (2 * k) - 1 <= e <= 2 * k)%Z) by (destruct Fa, Fb; unfold e; lia).
    set (rounding := if negb (product mod rest =? 0)%Z then (e - width + 2)%Z else none).
    assert (B : 4 * Rabs (value width a * value width b - value width c) <= size rounding).
    { unfold rounding. destruct (Z.eqb_spec (product mod rest) 0) as [H|H]; cbn [negb].
      - rewrite (V0 H). unfold Rminus. rewrite Rplus_opp_r, Rabs_R0, Rmult_0_r. apply size_pos.
      - rewrite size_some by (numbers; lia). replace (e - width + 2)%Z with (e - width + 1 + 1)%Z by ring. rewrite !bpow_double. lra. }
    assert (Fr : rounding = none \/ (rounding = e - width + 2)%Z) by (unfold rounding; destruct (negb _); auto).
    clearbody rounding. set (m := Z.max (propagated_by_product a b) rounding). split; [right; exact Q|]. split.
    + split; [cbn [exponent with_error c]; lia|]. apply clamp_fits; [lia|]. unfold m, propagated_by_product.
      destruct Fa as [Ea Fa], Fb as [Eb Fb]. clear - Ea Fa Eb Fb Ec Fr Hr W K. destruct Fr as [-> | ->]; numbers; lia.
    + intros x y Hx Hy. apply contains_with_error.
      destruct (propagated_by_product_is width k a b x y W ltac:(lia) Fa Fb Ba Bb Hx Hy) as [H|H]; [left; lia|right].
      pose proof (size_four m). pose proof (size_pos m). pose proof (size_le (propagated_by_product a b) m ltac:(lia)).
      pose proof (size_le rounding m ltac:(lia)).
      replace (x * y - value width c) with ((x * y - value width a * value width b) + (value width a * value width b - value width c)) by
          ring.
      pose proof (Rabs_triang (x * y - value width a * value width b) (value width a * value width b - value width c)). lra.
Qed.

(* ---- Signs ---- *)

(* `sign` and `proved_sign` of the code; None: unknown. *)
Definition sign_of_big (a : big) : comparison := if may_be_zero a then Eq else if negative a then Lt else Gt.
Definition proved_sign_of_big (a : big) : option comparison :=
  if may_be_zero a && negb (is_exact_zero a) then None else Some (sign_of_big a).

Definition is_sign (s : comparison) (x : R) : Prop := match s with Lt => x < 0 | Eq => x = 0 | Gt => 0 < x end.

(* A number that is not taken for 0 has the sign of its value. *)
Lemma surely_not_zero : forall width k a x, (0 < width)%Z -> (k <= range)%Z -> normal width a -> fits k a -> contains width a x ->
  may_be_zero a = false -> is_zero a = false /\ bpow radix2 (exponent a - 1) <= Rabs (value width a) /\
  Rabs (x - value width a) <= bpow radix2 (exponent a - 2) /\ is_sign (if negative a then Lt else Gt) x.
Proof.
  intros width k a x W K N [E F] H Z. apply orb_false_iff in Z. destruct Z as [Z0 Z1]. apply Z.ltb_ge in Z1.
  pose proof (value_above width a W N Z0) as A. split; [exact Z0|]. split; [exact A|].
  assert (D : Rabs (x - value width a) <= bpow radix2 (exponent a - 2)).
  { destruct H as [H|H]; [numbers; lia|]. apply Rle_trans with (1 := H). rewrite <- size_some by (numbers; lia). now apply size_le. }
  split; [exact D|]. pose proof (bpow_double (exponent a - 2)) as P. replace (exponent a - 2 + 1)%Z with (exponent a - 1)%Z in P by ring.
  pose proof (bpow_gt_0 radix2 (exponent a - 2)) as G. apply Rabs_le_inv in D.
  assert (S : if negative a then value width a <= 0 else 0 <= value width a).
  { unfold value, signed. pose proof (bpow_ge_0 radix2 (exponent a - width)) as B. pose proof (normal_digits _ _ W N) as [L _].
    apply IZR_le in L. destruct (negative a); rewrite ?opp_IZR; [|now apply Rmult_le_pos].
    rewrite Ropp_mult_distr_l_reverse. apply Ropp_le_cancel. rewrite Ropp_0, Ropp_involutive. now apply Rmult_le_pos. }
  destruct (negative a); cbn [is_sign]; [rewrite Rabs_left1 in A by exact S|rewrite Rabs_pos_eq in A by exact S]; lra.
Qed.

(* sign: the true number is 0 or at least 2^-s, and the error is below a fourth of that. *)
Theorem big_sign_is_right : forall width k a x s, (0 < width)%Z -> (k <= range)%Z -> normal width a -> fits k a -> contains width a x ->
  (x = 0 \/ bpow radix2 (- s) <= Rabs x) -> (error a < - s - 1)%Z -> (- range <= - s <= range)%Z -> is_sign (sign_of_big a) x.
Proof.
  intros width k a x s W K N F H [X|X] B S; unfold sign_of_big; destruct (may_be_zero a) eqn:Z; cbn [is_sign]; try exact X;
    try apply (surely_not_zero width k a x W K N F H Z).
  exfalso. destruct H as [H|H]; [numbers; lia|]. pose proof (size_le (error a) (- s - 2) ltac:(lia)) as D. rewrite (size_some (- s - 2)) in
      D by (numbers; lia).
  pose proof (bpow_double (- s - 2)) as P1. pose proof (bpow_double (- s - 1)) as P2. replace (- s - 2 + 1)%Z with (- s - 1)%Z in P1 by
      ring.
  replace (- s - 1 + 1)%Z with (- s)%Z in P2 by ring. pose proof (bpow_gt_0 radix2 (- s - 2)) as G.
  assert (V : Rabs (value width a) < bpow radix2 (- s - 1)).
  { apply orb_prop in Z. destruct Z as [Z|Z]; [rewrite (value_of_zero _ _ Z), Rabs_R0; lra|]. apply Z.ltb_lt in Z.
    apply Rlt_le_trans with (1 := value_below width a W N). apply bpow_le. destruct F. numbers. lia. }
  pose proof (Rabs_triang (x - value width a) (value width a)) as T. replace (x - value width a + value width a) with x in T by ring. lra.
Qed.

Theorem big_proved_sign_is_right : forall width k a x s, (0 < width)%Z -> (k <= range)%Z -> normal width a -> fits k a ->
  contains width a x -> proved_sign_of_big a = Some s -> is_sign s x.
Proof.
  intros width k a x s W K N F H P. unfold proved_sign_of_big in P. destruct (may_be_zero a && negb (is_exact_zero a)) eqn:Z;
      [discriminate|].
  injection P as <-. unfold sign_of_big. destruct (may_be_zero a) eqn:M.
  - cbn [andb] in Z. apply negb_false_iff in Z. now apply (exact_zero_is width k a x F K).
  - apply (surely_not_zero width k a x W K N F H M).
Qed.
