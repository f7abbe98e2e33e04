(* SPDX-License-Identifier: BSD-3-Clause *)
(* The values of the third stage's numbers, and what takes one of them: fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats BigFloat.
Open Scope R_scope.

Lemma power_pos : forall k, (0 <= k)%Z -> (0 < 2 ^ k)%Z.
Proof. intros k H. apply Z.pow_pos_nonneg; lia. Qed.

Lemma power_split : forall a b, (0 <= a)%Z -> (0 <= b)%Z -> (2 ^ (a + b) = 2 ^ a * 2 ^ b)%Z.
Proof. intros a b A B. now apply Z.pow_add_r. Qed.

Lemma power_part : forall j k, (0 <= k <= j)%Z -> (2 ^ j = 2 ^ k * 2 ^ (j - k))%Z.
Proof. intros j k H. rewrite <- power_split by lia. f_equal. ring. Qed.

Lemma IZR_power : forall k, (0 <= k)%Z -> IZR (2 ^ k) = bpow radix2 k.
Proof. intros k H. exact (IZR_Zpower radix2 k H). Qed.

(* ---- The size of a value ---- *)

Lemma value_abs : forall width a, (0 <= digits a)%Z -> Rabs (value width a) = IZR (digits a) * bpow radix2 (exponent a - width).
Proof.
  intros width a H. unfold value, signed. rewrite Rabs_mult, (Rabs_pos_eq (bpow _ _)) by apply bpow_ge_0. f_equal.
  destruct (negative a); rewrite ?opp_IZR, ?Rabs_Ropp; apply Rabs_pos_eq, IZR_le, H.
Qed.

Lemma normal_digits : forall width a, (0 < width)%Z -> normal width a -> (0 <= digits a < 2 ^ width)%Z.
Proof. intros width a W [->|[L U]]; [pose proof (power_pos width); lia|pose proof (power_pos (width - 1)); lia]. Qed.

Lemma value_below : forall width a, (0 < width)%Z -> normal width a -> Rabs (value width a) < bpow radix2 (exponent a).
Proof.
  intros width a W N. pose proof (normal_digits _ _ W N) as [L U]. rewrite value_abs by exact L.
  replace (exponent a) with (width + (exponent a - width))%Z at 2 by ring. rewrite bpow_plus.
  apply Rmult_lt_compat_r; [apply bpow_gt_0|]. rewrite <- IZR_power by lia. now apply IZR_lt.
Qed.

Lemma value_above : forall width a, (0 < width)%Z -> normal width a -> is_zero a = false ->
  bpow radix2 (exponent a - 1) <= Rabs (value width a).
Proof.
  intros width a W [N|[L U]] Z; [unfold is_zero in Z; rewrite N in Z; discriminate|]. pose proof (power_pos (width - 1)).
  rewrite value_abs by lia. replace (exponent a - 1)%Z with (width - 1 + (exponent a - width))%Z by ring. rewrite bpow_plus.
  apply Rmult_le_compat_r; [apply bpow_ge_0|]. rewrite <- IZR_power by lia. now apply IZR_le.
Qed.

Lemma value_of_zero : forall width a, is_zero a = true -> value width a = 0.
Proof.
  intros width a H. apply Z.eqb_eq in H. unfold value, signed. rewrite H. destruct (negative a); simpl (- 0)%Z; apply Rmult_0_l.
Qed.

(* ---- One number ---- *)

Theorem big_negated_contains : forall width a x, contains width a x -> contains width (negated a) (- x).
Proof.
  intros width a x H. unfold contains in *. cbn [error negated]. replace (value width (negated a)) with (- value width a).
  - replace (- x - - value width a) with (- (x - value width a)) by ring. now rewrite Rabs_Ropp.
  - unfold value, signed, negated. cbn [negative digits exponent]. destruct (negative a); simpl negb; cbv iota;
      rewrite ?opp_IZR; ring.
Qed.

Theorem big_scaled_contains : forall width k j a x, (k + Z.abs j <= range)%Z -> fits k a ->
  contains width a x -> contains width (scaled a j) (x * bpow radix2 j).
Proof.
  intros width k j a x Hr [_ F] H. apply contains_with_error. unfold value. cbn [signed digits negative exponent].
  replace (exponent a + j - width)%Z with (exponent a - width + j)%Z by ring. rewrite bpow_plus.
  change (signed (Big (negative a) (digits a) (exponent a + j) (error a))) with (signed a).
  replace (x * bpow radix2 j - IZR (signed a) * (bpow radix2 (exponent a - width) * bpow radix2 j)) with
    ((x - value width a) * bpow radix2 j) by (unfold value; ring).
  rewrite Rabs_mult, (Rabs_pos_eq (bpow _ _)) by apply bpow_ge_0. destruct H as [H|H]; [left; numbers; lia|right].
  apply Rle_trans with (size (error a) * bpow radix2 j); [apply Rmult_le_compat_r; [apply bpow_ge_0|exact H]|].
  apply size_times. numbers. lia.
Qed.

Theorem big_midpoint_contains : forall width a, contains width (midpoint a) (value width a).
Proof.
  intros width a. right. change (value width (midpoint a)) with (value width a). unfold Rminus. rewrite Rplus_opp_r, Rabs_R0. apply
      size_pos.
Qed.

Theorem big_widened_contains : forall width k a x j, (0 < width)%Z -> normal width a -> fits k a -> (k + Z.abs j <= range)%Z ->
  Rabs (x - value width a) <= bpow radix2 j * Rabs (value width a) -> contains width (widened a j) x.
Proof.
  intros width k a x j W N [E _] Hr H. apply contains_with_error. right. apply Rle_trans with (1 := H). rewrite size_some by (numbers; lia).
  rewrite (Z.add_comm (exponent a)), bpow_plus. apply Rmult_le_compat_l; [apply bpow_ge_0|]. apply Rlt_le. now apply value_below.
Qed.

(* frexp and ldexp of the code: the significand moved up until its leading one is the top bit. *)
Definition exactly (width : Z) (v : binary64) : big :=
  match v with
  | B754_finite _ _ s m e _ =>
      let bits := (Z.log2 (Zpos m) + 1)%Z in Big s (Zpos m * 2 ^ (width - bits)) (e + bits) none
  | _ => zero
  end.

Lemma significand_bits : forall m e, SpecFloat.bounded 53 1024 m e = true -> (Z.log2 (Zpos m) + 1 <= 53)%Z /\ (-1074 <= e <= 971)%Z.
Proof.
  intros m e H. split.
  - apply andb_prop in H. destruct H as [H _].
    apply Zeq_bool_eq in H. unfold SpecFloat.fexp, SpecFloat.emin in H. rewrite Digits.Zpos_digits2_pos in H.
    assert (Zdigits radix2 (Zpos m) <= 53)%Z by lia.
    assert (Z.log2 (Zpos m) < 53)%Z; [|lia]. apply Z.log2_lt_pow2; [lia|].
    pose proof (Zdigits_correct radix2 (Zpos m)) as [_ U]. change (Zpower radix2) with (Z.pow 2) in U. rewrite Z.abs_eq in U by lia.
    apply Z.lt_le_trans with (1 := U). apply Z.pow_le_mono_r; lia.
  - apply andb_prop in H. destruct H as [H B].
    apply Zeq_bool_eq in H. apply Zle_bool_imp_le in B. unfold SpecFloat.fexp, SpecFloat.emin in H. lia.
Qed.

Theorem big_exactly_contains : forall width v, (53 <= width)%Z ->
  contains width (exactly width v) (value64 v) /\ normal width (exactly width v) /\ fits 1074 (exactly width v).
Proof.
  intros width v W.
  assert (Z0 : contains width zero 0 /\ normal width zero /\ fits 1074 zero).
  { split; [right; rewrite (value_of_zero width zero eq_refl), Rminus_0_r, Rabs_R0; apply size_pos|]. split; [now left|].
    split; [cbn; lia|now left]. }
  destruct v as [s|s|s p q|s m e H]; try exact Z0. clear Z0. destruct (significand_bits m e H) as (B & E).
  pose proof (Z.log2_nonneg (Zpos m)) as L0. destruct (Z.log2_spec (Zpos m)) as [L U]; [lia|]. cbn [exactly].
  set (b := (Z.log2 (Zpos m) + 1)%Z) in *. replace (Z.succ (Z.log2 (Zpos m))) with b in U by (unfold b; lia).
  replace (Z.log2 (Zpos m)) with (b - 1)%Z in L by (unfold b; lia). pose proof (power_pos (width - b) ltac:(lia)) as P. split; [|split].
  - right. apply Rle_trans with 0; [|apply size_pos]. apply Req_le. rewrite <- Rabs_R0. f_equal. unfold value, signed. cbn [negative digits
      exponent].
    unfold B2R, F2R. cbn [Fnum Fexp]. apply Rminus_diag_eq.
    replace (if s then (- (Z.pos m * 2 ^ (width - b)))%Z else (Z.pos m * 2 ^ (width - b))%Z) with
      (SpecFloat.cond_Zopp s (Zpos m) * 2 ^ (width - b))%Z by (destruct s; cbn [SpecFloat.cond_Zopp]; lia).
    rewrite mult_IZR, IZR_power, Rmult_assoc, <- bpow_plus by lia. do 2 f_equal. ring.
  - right. cbn [digits]. rewrite (power_part width b), (power_part (width - 1) (b - 1)) by lia.
    replace (width - 1 - (b - 1))%Z with (width - b)%Z by ring. split; [apply Z.mul_le_mono_nonneg_r; lia|apply Z.mul_lt_mono_pos_r; lia].
  - split; [cbn [exponent]; lia|now left].
Qed.

Theorem big_converted_contains : forall width other k a x, (0 < width)%Z -> (0 < other)%Z -> normal other a -> fits k a ->
  (k + width <= range)%Z -> contains other a x -> contains width (converted width other a) x /\ normal width (converted width other a).
Proof.
  intros width other k a x W O N [E F] Hr H. pose proof (normal_digits _ _ O N) as [D0 D1]. unfold converted.
  destruct (Z.leb_spec other width) as [Hw|Hw]; cbn [negb andb].
  - split.
    + unfold contains. cbn [error]. replace (value width _) with (value other a); [exact H|]. unfold value, signed. cbn [negative digits
        exponent].
      replace (if negative a then (- (digits a * 2 ^ (width - other)))%Z else (digits a * 2 ^ (width - other))%Z) with
        ((if negative a then - digits a else digits a) * 2 ^ (width - other))%Z by (destruct (negative a); lia).
      rewrite mult_IZR, IZR_power, Rmult_assoc, <- bpow_plus by lia. do 2 f_equal. ring.
    + destruct N as [N|[L U]]; [left|right]; cbn [digits]; [rewrite N; apply Z.mul_0_l|].
      pose proof (power_pos (width - other)). rewrite (power_part width other), (power_part (width - 1) (other - 1)) by lia.
      replace (width - 1 - (other - 1))%Z with (width - other)%Z by ring. split; [apply Z.mul_le_mono_nonneg_r; lia|apply
          Z.mul_lt_mono_pos_r; lia].
  - pose proof (power_pos (other - width) ltac:(lia)) as P. set (s := (2 ^ (other - width))%Z) in *.
    pose proof (Z.div_mod (digits a) s ltac:(lia)) as DM. pose proof (Z.mod_pos_bound (digits a) s P) as M.
    set (q := (digits a / s)%Z) in *. set (r := (digits a mod s)%Z) in *.
    assert (V : Rabs (value other a - value width (Big (negative a) q (exponent a) 0)) = IZR r * bpow radix2 (exponent a - other)).
    { unfold value, signed. cbn [negative digits exponent]. replace (exponent a - width)%Z with (other - width + (exponent a - other))%Z by
        ring.
      rewrite bpow_plus, <- (IZR_power (other - width)) by lia. fold s.
      rewrite <- (Rabs_pos_eq (IZR r * _)) by (apply Rmult_le_pos; [apply IZR_le; lia|apply bpow_ge_0]).
      destruct (negative a); [rewrite <- Rabs_Ropp|]; f_equal; rewrite ?opp_IZR, DM, plus_IZR, mult_IZR; ring. }
    split.
    + unfold contains. cbn [error].
      assert (same : forall e, value width (Big (negative a) q (exponent a) e) = value width (Big (negative a) q (exponent a) 0)) by
          reflexivity.
      rewrite same. clear same. set (v := value width (Big (negative a) q (exponent a) 0)) in *.
      replace (x - v) with ((x - value other a) + (value other a - v)) by ring. pose proof (Rabs_triang (x - value other a) (value other a
          - v)) as T.
      destruct (Z.eqb_spec r 0) as [R0|R0]; cbn [negb].
      * rewrite R0, Rmult_0_l in V. destruct H as [H|H]; [now left|right; lra].
      * destruct H as [H|H]; [left; lia|right]. set (e := Z.max (error a) (exponent a - width + 1)).
        pose proof (size_double e). pose proof (size_le (error a) e ltac:(lia)).
        assert (bpow radix2 (exponent a - width) <= size e); [|].
        { rewrite <- (size_some (exponent a - width)) by (numbers; lia). apply size_le. lia. }
        assert (IZR r * bpow radix2 (exponent a - other) <= bpow radix2 (exponent a - width)); [|lra].
        replace (exponent a - width)%Z with (other - width + (exponent a - other))%Z by ring. rewrite bpow_plus, <- (IZR_power (other -
            width)) by lia.
        apply Rmult_le_compat_r; [apply bpow_ge_0|apply IZR_le; lia].
    + destruct N as [N|[L U]]; [left|right]; cbn [digits].
      * unfold q. rewrite N. apply Z.div_0_l. lia.
      * rewrite (power_part other width) in U by lia. rewrite (power_part (other - 1) (width - 1)) in L by lia.
        replace (other - 1 - (width - 1))%Z with (other - width)%Z in L by ring. fold s in L, U. split; [apply Z.div_le_lower_bound;
            lia|apply Z.div_lt_upper_bound; lia].
Qed.
