(* SPDX-License-Identifier: BSD-3-Clause *)
(* Sums and differences of two numbers of the third stage: fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core.
From Forceshade Require Import BigFloat BigFloatValues.
Open Scope R_scope.

Definition with_digits (a : big) (d : Z) : big := Big (negative a) d (exponent a) (error a).

Lemma value_with_digits : forall width a d,
  value width (with_digits a d) = IZR (if negative a then - d else d) * bpow radix2 (exponent a - width).
Proof. reflexivity. Qed.

Lemma normalised_is : forall width a, (0 < width)%Z -> (0 <= digits a < 2 ^ width)%Z ->
  normal width (normalised width a) /\ value width (normalised width a) = value width a /\ error (normalised width a) = error a /\
  (exponent (normalised width a) = 0 \/ exponent a - width < exponent (normalised width a) <= exponent a)%Z.
Proof.
  intros width a W [L U]. unfold normalised. destruct (is_zero a) eqn:Z.
  - split; [now left|]. split; [|split; [reflexivity|now left]].
    rewrite (value_of_zero width a Z). now apply value_of_zero.
  - apply Z.eqb_neq in Z. pose proof (Z.log2_nonneg (digits a)) as L0. destruct (Z.log2_spec (digits a)) as [S T]; [lia|].
    assert (Z.log2 (digits a) < width)%Z as L1 by (apply Z.log2_lt_pow2; lia). set (g := Z.log2 (digits a)) in *.
    pose proof (power_pos (width - 1 - g) ltac:(lia)) as P. cbn [error exponent].
    split; [right; cbn [digits]|split; [|split; [reflexivity|right; lia]]].
    + rewrite (power_part width (Z.succ g)), (power_part (width - 1) g) by lia. replace (width - Z.succ g)%Z with (width - 1 - g)%Z by ring.
      split; [apply Z.mul_le_mono_nonneg_r; lia|apply Z.mul_lt_mono_pos_r; lia].
    + unfold value, signed. cbn [negative digits exponent].
      replace (if negative a then (- (digits a * 2 ^ (width - 1 - g)))%Z else (digits a * 2 ^ (width - 1 - g))%Z) with
        ((if negative a then - digits a else digits a) * 2 ^ (width - 1 - g))%Z by (destruct (negative a); ring).
      rewrite mult_IZR, IZR_power, Rmult_assoc, <- bpow_plus by lia. do 2 f_equal. ring.
Qed.

Lemma top_of_normal : forall width a, normal width a -> is_zero a = false -> (2 ^ (width - 1) <= digits a < 2 ^ width)%Z.
Proof. intros width a [N|N] Z; [unfold is_zero in Z; rewrite N in Z; discriminate|exact N]. Qed.

Lemma double_power : forall width, (0 < width)%Z -> (2 ^ width = 2 * 2 ^ (width - 1))%Z.
Proof. intros width W. rewrite (power_part width 1) by lia. reflexivity. Qed.

(* What add_limbs drops is charged to its own bound of the error. *)
Lemma add_limbs_is : forall width a q, (0 < width)%Z -> normal width a -> is_zero a = false -> (0 <= q < 2 ^ width)%Z ->
  (least <= exponent a + 1 - width)%Z -> let r := add_limbs width a q in
  normal width r /\ (exponent a <= exponent r <= exponent a + 1)%Z /\ negative r = negative a /\
  (error r = error a \/ error r = Z.max (error a) (exponent a + 1 - width)) /\
  2 * Rabs (value width (with_digits a (digits a + q)) - value width r) <= size (error r).
Proof.
  intros width a q W N Z Q E r. destruct (top_of_normal _ _ N Z) as [L U]. pose proof (double_power width W) as D. unfold r, add_limbs.
  destruct (Z.ltb_spec (digits a + q) (2 ^ width)) as [S|S].
  - cbn [exponent negative error]. split; [right; cbn [digits]; lia|]. split; [lia|]. split; [reflexivity|]. split; [now left|].
    change (2 * Rabs (value width (with_digits a (digits a + q)) - value width (with_digits a (digits a + q))) <= size (error a)).
    unfold Rminus. rewrite Rplus_opp_r, Rabs_R0, Rmult_0_r. apply size_pos.
  - pose proof (Z.div_mod (digits a + q) 2 ltac:(lia)) as DM. pose proof (Z.mod_pos_bound (digits a + q) 2 ltac:(lia)) as M.
    set (h := ((digits a + q) / 2)%Z) in *. set (b := ((digits a + q) mod 2)%Z) in *. cbn [exponent negative error].
    split; [right; cbn [digits]; lia|]. split; [lia|]. split; [reflexivity|]. split; [destruct (b =? 0)%Z; auto|].
    assert (V : Rabs (value width (with_digits a (digits a + q)) - value width (Big (negative a) h (exponent a + 1)
      (if (b =? 0)%Z then error a else Z.max (error a) (exponent a + 1 - width)))) = IZR b * bpow radix2 (exponent a - width)).
    { unfold value, signed, with_digits. cbn [negative digits exponent].
      replace (exponent a + 1 - width)%Z with (exponent a - width + 1)%Z by ring. rewrite bpow_double, DM.
      rewrite <- (Rabs_pos_eq (IZR b * _)) by (apply Rmult_le_pos; [apply IZR_le; lia|apply bpow_ge_0]).
      destruct (negative a); [rewrite <- Rabs_Ropp|]; f_equal; rewrite ?opp_IZR, ?plus_IZR, ?mult_IZR; ring. }
    rewrite V. clear V. destruct (Z.eqb_spec b 0) as [->|B]; [rewrite Rmult_0_l, Rmult_0_r; apply size_pos|].
    replace b with 1%Z by lia. rewrite Rmult_1_l, <- bpow_double. replace (exponent a - width + 1)%Z with (exponent a + 1 - width)%Z by
        ring.
    rewrite <- (size_some (exponent a + 1 - width)) by exact E. apply size_le. lia.
Qed.

(* The smaller number, moved to the place of the larger: what is lost is below one unit there. *)
Lemma shifted_is : forall width e a, (0 < width)%Z -> normal width a -> (exponent a <= e)%Z ->
  let shift := (2 ^ (e - exponent a))%Z in
  let v := IZR (if negative a then - (digits a / shift) else digits a / shift) * bpow radix2 (e - width) in
  (0 <= digits a / shift <= digits a)%Z /\ ((exponent a < e)%Z -> 2 * (digits a / shift) <= digits a)%Z /\
  Rabs (value width a - v) <= bpow radix2 (e - width) /\ ((digits a mod shift = 0)%Z -> value width a = v).
Proof.
  intros width e a W N E shift v. pose proof (normal_digits _ _ W N) as [L U]. pose proof (power_pos (e - exponent a) ltac:(lia)) as P.
  fold shift in P. pose proof (Z.div_mod (digits a) shift ltac:(lia)) as DM. pose proof (Z.mod_pos_bound (digits a) shift P) as M.
  pose proof (Z.div_pos (digits a) shift L P) as Q0. subst v. set (q := (digits a / shift)%Z) in *. set (r := (digits a mod shift)%Z) in *.
  assert (V : Rabs (value width a - IZR (if negative a then - q else q) * bpow radix2 (e - width)) = IZR r * bpow radix2 (exponent a -
      width)).
  { unfold value, signed. replace (e - width)%Z with (e - exponent a + (exponent a - width))%Z by ring.
    rewrite bpow_plus, <- (IZR_power (e - exponent a)) by lia. fold shift.
    rewrite <- (Rabs_pos_eq (IZR r * _)) by (apply Rmult_le_pos; [apply IZR_le; lia|apply bpow_ge_0]).
    destruct (negative a); [rewrite <- Rabs_Ropp|]; f_equal; rewrite ?opp_IZR, DM, plus_IZR, mult_IZR; ring. }
  split; [split; [lia|]|split; [|split]].
  - apply Z.le_trans with (1 * q)%Z; [lia|]. apply Z.le_trans with (shift * q)%Z; [apply Z.mul_le_mono_nonneg_r; lia|lia].
  - intro H. assert (2 <= shift)%Z by (unfold shift; apply (Z.pow_le_mono_r 2 1); lia).
    apply Z.le_trans with (shift * q)%Z; [apply Z.mul_le_mono_nonneg_r; lia|lia].
  - rewrite V. replace (e - width)%Z with (e - exponent a + (exponent a - width))%Z by ring. rewrite bpow_plus, <- (IZR_power (e - exponent
      a)) by lia.
    apply Rmult_le_compat_r; [apply bpow_ge_0|apply IZR_le; fold shift; lia].
  - intro H. rewrite H, Rmult_0_l in V. apply Rminus_diag_uniq. destruct (Req_dec (value width a -
      IZR (if negative a then - q else q) * bpow radix2 (e - width)) 0) as [Q|Q]; [exact Q|]. now apply Rabs_no_R0 in Q.
Qed.

Definition is_bound_of_sum (width k : Z) (a b r : big) : Prop :=
  normal width r /\ fits (k + width + 3) r /\ forall x y, contains width a x -> contains width b y -> contains width r (x + y).

Lemma add_smaller_contains : forall width k a b, (0 < width)%Z -> (k + width + 3 <= range)%Z -> normal width a -> normal width b ->
  fits k a -> fits k b -> is_zero a = false -> is_zero b = false -> is_larger a b = true ->
  is_bound_of_sum width k a b (add_smaller width a b).
Proof.
  intros width k a b W Hr Na Nb [Ea Fa] [Eb Fb] Za Zb Hl. destruct (top_of_normal _ _ Na Za) as [La Ua].
  destruct (top_of_normal _ _ Nb Zb) as [Lb Ub]. pose proof (double_power width W) as D.
  assert (E : (exponent b <= exponent a)%Z) by (unfold is_larger in Hl; destruct (Z.eqb_spec (exponent a) (exponent b)); lia).
  destruct (shifted_is width (exponent a) b W Nb E) as (Q0 & Q1 & V & V0). unfold add_smaller.
  set (shift := (2 ^ (exponent a - exponent b))%Z) in *. set (q := (digits b / shift)%Z) in *. set (lost := negb (digits b mod shift =?
      0)%Z).
  set (rounding := if lost then (exponent a - width + 1)%Z else none).
  set (s := IZR (if negative b then - q else q) * bpow radix2 (exponent a - width)) in *.
  assert (B : 2 * Rabs (value width b - s) <= size rounding).
  { unfold rounding, lost. destruct (Z.eqb_spec (digits b mod shift) 0) as [H|H]; cbn [negb].
    - rewrite (V0 H). unfold Rminus. rewrite Rplus_opp_r, Rabs_R0, Rmult_0_r. apply size_pos.
    - rewrite size_some, bpow_double by (numbers; lia). lra. }
  clearbody lost. clear V V0.
  set (result := if eqb (negative a) (negative b) then add_limbs width a q else subtract_limbs width a q).
  assert (R : normal width result /\ (- (k + width) <= exponent result <= k + width)%Z /\
    (error result = error a \/ error result = Z.max (error a) (exponent a + 1 - width)) /\
    2 * Rabs (value width a + s - value width result) <= size (error result)).
  { unfold result. destruct (eqb (negative a) (negative b)) eqn:S.
    - apply eqb_prop in S. destruct (add_limbs_is width a q W Na Za) as (N & X & _ & Er & H); [lia|numbers; lia|].
      split; [exact N|]. split; [lia|]. split; [exact Er|].
      replace (value width a + s) with (value width (with_digits a (digits a + q))); [exact H|].
      rewrite value_with_digits. unfold value, signed, s. rewrite <- S. destruct (negative a); rewrite ?opp_IZR, plus_IZR, ?opp_IZR; ring.
    - apply eqb_false_iff in S. assert (Q2 : (0 <= digits a - q < 2 ^ width)%Z).
      { unfold is_larger in Hl. destruct (Z.eqb_spec (exponent a) (exponent b)) as [Q|Q]; [apply Z.leb_le in Hl|apply Z.ltb_lt in Hl]; lia.
          }
      destruct (normalised_is width (with_digits a (digits a - q)) W Q2) as (N & X & Er & H). unfold subtract_limbs.
      change (Big (negative a) (digits a - q) (exponent a) (error a)) with (with_digits a (digits a - q)).
      split; [exact N|]. split; [cbn [exponent with_digits] in H; lia|]. split; [left; exact Er|]. rewrite X.
      replace (value width a + s) with (value width (with_digits a (digits a - q))).
      + unfold Rminus. rewrite Rplus_opp_r, Rabs_R0, Rmult_0_r. apply size_pos.
      + rewrite value_with_digits. unfold value, signed, s. replace (negative b) with (negb (negative a)) by (destruct (negative a),
          (negative b); auto; congruence).
        destruct (negative a); cbn [negb]; rewrite ?opp_IZR, minus_IZR, ?opp_IZR; ring. }
  destruct R as (N & X & Er & H). split; [exact N|]. split.
  - split; [cbn [exponent with_error]; lia|]. apply clamp_fits; [numbers; lia|]. clear - Fa Fb Ea Er Hr W. unfold rounding.
    destruct lost, Er as [-> | ->]; numbers; lia.
  - intros x y [Hx|Hx] Hy; apply contains_with_error; [left; lia|]. destruct Hy as [Hy|Hy]; [left; lia|right].
    set (m := Z.max (Z.max (error result) (error b)) rounding).
    pose proof (size_four m) as M. pose proof (size_pos m). pose proof (size_le (error a) m ltac:(lia)). pose proof (size_le (error b) m
        ltac:(lia)).
    pose proof (size_le (error result) m ltac:(lia)). pose proof (size_le rounding m ltac:(lia)).
    replace (x + y - value width result) with ((x - value width a) + (y - value width b) + ((value width b - s) +
      (value width a + s - value width result))) by ring.
    pose proof (Rabs_triang (x - value width a + (y - value width b)) (value width b - s + (value width a + s - value width result))).
    pose proof (Rabs_triang (x - value width a) (y - value width b)).
    pose proof (Rabs_triang (value width b - s) (value width a + s - value width result)). lra.
Qed.

Lemma is_larger_total : forall a b, is_larger a b = false -> is_larger b a = true.
Proof.
  intros a b H. unfold is_larger in *. rewrite (Z.eqb_sym (exponent b)). destruct (Z.eqb_spec (exponent a) (exponent b)); [apply Z.leb_gt
      in H;
    apply Z.leb_le|apply Z.ltb_ge in H; apply Z.ltb_lt]; lia.
Qed.

(* Where one of the two is 0. *)
Lemma add_zero_contains : forall width k a b, (0 < width)%Z -> (k + width + 3 <= range)%Z -> normal width b -> fits k a -> fits k b ->
  is_zero a = true -> is_bound_of_sum width k a b (with_error b (Z.max (error a) (error b) + 1)).
Proof.
  intros width k a b W Hr Nb [Ea Fa] [Eb Fb] Za. split; [exact Nb|]. split.
  - split; [cbn [exponent with_error]; lia|]. apply clamp_fits; numbers; lia.
  - intros x y [Hx|Hx] Hy; apply contains_with_error; [left; lia|]. destruct Hy as [Hy|Hy]; [left; lia|right].
    rewrite (value_of_zero width a Za), Rminus_0_r in Hx. set (m := Z.max (error a) (error b)).
    pose proof (size_double m). pose proof (size_le (error a) m ltac:(lia)). pose proof (size_le (error b) m ltac:(lia)).
    replace (x + y - value width b) with (x + (y - value width b)) by ring. pose proof (Rabs_triang x (y - value width b)). lra.
Qed.

Lemma bound_of_sum_sym : forall width k a b r, is_bound_of_sum width k a b r -> is_bound_of_sum width k b a r.
Proof. intros width k a b r (N & F & H). split; [exact N|]. split; [exact F|]. intros x y Hx Hy. rewrite Rplus_comm. now apply H. Qed.

Theorem big_sum_contains : forall width k a b, (0 < width)%Z -> (k + width + 3 <= range)%Z -> normal width a -> normal width b ->
  fits k a -> fits k b -> is_bound_of_sum width k a b (add width a b).
Proof.
  intros width k a b W Hr Na Nb Fa Fb. unfold add. destruct (is_zero a) eqn:Za; [now apply add_zero_contains|].
  destruct (is_zero b) eqn:Zb; [rewrite Z.max_comm; apply bound_of_sum_sym; now apply add_zero_contains|].
  destruct (is_larger a b) eqn:L; [now apply add_smaller_contains|]. apply bound_of_sum_sym, add_smaller_contains; try assumption.
  now apply is_larger_total.
Qed.

Theorem big_difference_contains : forall width k a b, (0 < width)%Z -> (k + width + 3 <= range)%Z -> normal width a -> normal width b ->
  fits k a -> fits k b -> let r := subtract width a b in
  normal width r /\ fits (k + width + 3) r /\ forall x y, contains width a x -> contains width b y -> contains width r (x - y).
Proof.
  intros width k a b W Hr Na Nb Fa Fb r. destruct (big_sum_contains width k a (negated b) W Hr Na Nb Fa Fb) as (N & F & H).
  split; [exact N|]. split; [exact F|]. intros x y Hx Hy. apply H; [exact Hx|now apply big_negated_contains].
Qed.
