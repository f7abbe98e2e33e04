(* SPDX-License-Identifier: BSD-3-Clause *)
(* Newton's method for the inverse of a number of the third stage and for the inverse of its root: what it starts with, from the
   number's highest limb in binary64, and its steps. fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations Nearness BigFloat BigFloatValues BigFloatProducts BigFloatQuotients.
Open Scope R_scope.

(* static_cast<double>(std::uint64_t) and std::ldexp(double, int). *)
Definition double_of (n : Z) : binary64 := binary_normalize 53 1024 (eq_refl _) (eq_refl _) mode_NE n 0 false.
Definition ldexp (v : binary64) (k : Z) : binary64 := Bldexp 53 1024 (eq_refl _) (eq_refl _) mode_NE v k.

(* The number's highest limb as a fraction. *)
Definition fraction (width : Z) (a : big) : binary64 := ldexp (double_of (digits a / 2 ^ (width - 64))) (-64).

(* The number cut down to the limbs that hold `bits` bits. *)
Definition truncated (width : Z) (a : big) (bits : Z) : big :=
  let dropped := (2 ^ (64 * Z.max 0 (width / 64 - (bits / 64 + 2))))%Z in
  Big (negative a) (digits a / dropped * dropped) (exponent a) none.

Definition one_of (width : Z) : big := exactly width (two_to 0).

(* `fuel` is no less than the number of steps: see loop_ends in proofs/big_float/BigFloatNewtonLoop.v. *)
Fixpoint newton_loop (fuel : nat) (step : big -> big) (width bits : Z) (inverse : big) : big :=
  match fuel with
  | O => inverse
  | S rest =>
      if (bits <? width)%Z then newton_loop rest step width (2 * bits) (truncated width (step inverse) (2 * bits)) else inverse
  end.
Definition newton_fuel (width : Z) : nat := Z.to_nat (Z.log2_up width).

Definition inverse_start (width : Z) (b : big) : big :=
  scaled (exactly width (over (if negative b then opp (two_to 0) else two_to 0) (fraction width b))) (- exponent b).
Definition inverse_step (width : Z) (b inverse : big) : big :=
  add width inverse (multiply width inverse (subtract width (one_of width) (multiply width (midpoint b) inverse))).
Definition newton_inverse (width : Z) (b : big) : big :=
  newton_loop (newton_fuel width) (inverse_step width b) width 50 (inverse_start width b).

Definition half_exponent (a : big) : Z := if (0 <=? exponent a)%Z then Z.quot (exponent a) 2 else (- Z.quot (1 - exponent a) 2)%Z.
Definition inverse_root_start (width : Z) (a : big) : big :=
  let half := half_exponent a in let reduced := ldexp (fraction width a) (exponent a - 2 * half) in
  scaled (exactly width (over (two_to 0) (Operations.square_root reduced))) (- half).
Definition inverse_root_step (width : Z) (a inverse : big) : big :=
  add width inverse (scaled (multiply width inverse (subtract width (one_of width)
    (multiply width (midpoint a) (multiply width inverse inverse)))) (-1)).
Definition newton_inverse_root (width : Z) (a : big) : big :=
  newton_loop (newton_fuel width) (inverse_root_step width a) width 49 (inverse_root_start width a).

(* ---- The highest limb in binary64 ---- *)

Lemma exactly_is : forall width v, (53 <= width)%Z -> value width (exactly width v) = value64 v.
Proof.
  intros width v W. destruct (big_exactly_contains width v W) as (C & _). unfold contains in C.
  replace (error (exactly width v)) with none in C by (destruct v; reflexivity). destruct C as [C|C]; [numbers; lia|].
  rewrite size_none in C by (numbers; lia). pose proof (Rabs_pos (value64 v - value width (exactly width v))) as P.
  destruct (Req_dec (value64 v - value width (exactly width v)) 0) as [Q|Q]; [lra|]. apply Rabs_pos_lt in Q. lra.
Qed.

Lemma double_of_is : forall n, (0 <= n <= 2 ^ 64)%Z -> is64 (double_of n) (nearest64 (IZR n)).
Proof.
  intros n N. unfold double_of. pose proof (binary_normalize_correct 53 1024 (eq_refl _) (eq_refl _) mode_NE n 0 false) as C.
  replace (F2R (Float radix2 n 0)) with (IZR n) in C by (unfold F2R; cbn [Fnum Fexp bpow]; ring).
  assert (Hsize : Rabs (IZR n) <= bpow radix2 1000).
  { rewrite Rabs_pos_eq by (apply IZR_le; lia). apply Rle_trans with (bpow radix2 64); [|apply bpow_le; lia].
    rewrite <- IZR_power by lia. apply IZR_le. lia. }
  operation C. destruct C as (C1 & C2 & _). now split.
Qed.

Lemma ldexp_is : forall v a k, is64 v a -> bpow radix2 (-1000) <= Rabs (a * bpow radix2 k) <= bpow radix2 1000 ->
  is64 (ldexp v k) (a * bpow radix2 k).
Proof.
  intros v a k Hv S. pose proof (format_of _ _ Hv) as G. destruct Hv as [<- Fv]. unfold ldexp.
  pose proof (Bldexp_correct 53 1024 (eq_refl _) (eq_refl _) mode_NE v k) as C.
  assert (Hsize : Rabs (value64 v * bpow radix2 k) <= bpow radix2 1000) by lra.
  operation C. destruct C as (C1 & C2 & _). split; [|now rewrite C2]. rewrite C1. apply round_generic; auto with typeclass_instances.
  destruct (FLT_format_generic radix2 (-1074) 53 _ G) as [f F1 F2 F3].
  assert (K : F2R (Float radix2 (Fnum f) (Fexp f + k)) = value64 v * bpow radix2 k).
  { rewrite F1. unfold F2R. cbn [Fnum Fexp]. rewrite bpow_plus. ring. }
  set (x := value64 v * bpow radix2 k) in *. apply generic_format_F2R' with (Float radix2 (Fnum f) (Fexp f + k)); [exact K|]. intro X0.
  cbn [Fexp]. assert (M : (-999 <= mag radix2 x)%Z) by (apply mag_ge_bpow; apply S).
  assert (V0 : value64 v <> 0) by (intro V0; apply X0; unfold x; rewrite V0; ring).
  assert (Mx : (mag radix2 x = mag radix2 (value64 v) + k :> Z)%Z) by (unfold x; now apply mag_mult_bpow).
  unfold cexp, FLT_exp. assert (Mf : (mag radix2 (value64 v) <= 53 + Fexp f)%Z); [|lia].
  apply mag_le_bpow; [exact V0|]. rewrite F1. unfold F2R. rewrite Rabs_mult, (Rabs_pos_eq (bpow _ _)) by apply bpow_ge_0.
  rewrite bpow_plus. apply Rmult_lt_compat_r; [apply bpow_gt_0|]. rewrite <- abs_IZR, <- IZR_power by lia. now apply IZR_lt.
Qed.

(* The digits as a fraction. *)
Definition share_of_one (width : Z) (a : big) : R := IZR (digits a) * bpow radix2 (- width).

Lemma value_is_share : forall width a,
  value width a = (if negative a then -1 else 1) * share_of_one width a * bpow radix2 (exponent a).
Proof.
  intros width a. unfold value, share_of_one, signed, Z.sub. rewrite bpow_plus. destruct (negative a); rewrite ?opp_IZR; ring.
Qed.

Lemma share_is : forall width a, (64 <= width)%Z -> normal width a -> is_zero a = false -> / 2 <= share_of_one width a <= 1.
Proof.
  intros width a W [N|[L U]] Z; [unfold is_zero in Z; rewrite N in Z; discriminate|]. unfold share_of_one.
  assert (H : forall k, (0 <= k)%Z -> bpow radix2 (k - width) = IZR (2 ^ k) * bpow radix2 (- width)).
  { intros k K. rewrite IZR_power by exact K. rewrite <- bpow_plus. reflexivity. }
  pose proof (H (width - 1)%Z ltac:(lia)) as H1. pose proof (H width ltac:(lia)) as H2.
  replace (width - 1 - width)%Z with (-1)%Z in H1 by ring. replace (width - width)%Z with 0%Z in H2 by ring.
  change (bpow radix2 (-1)) with (/ 2) in H1. change (bpow radix2 0) with 1 in H2. rewrite H1, H2.
  split; apply Rmult_le_compat_r; try apply bpow_ge_0; apply IZR_le; lia.
Qed.

Lemma power_numbers : bpow radix2 (-64) = / 18446744073709551616 /\ bpow radix2 64 = 18446744073709551616.
Proof. split; reflexivity. Qed.

Lemma fraction_is : forall width a, (64 <= width)%Z -> normal width a -> is_zero a = false ->
  exists f, is64 (fraction width a) f /\ near (11 / 10) f (share_of_one width a).
Proof.
  intros width a W N Z. pose proof (share_is width a W N Z) as F. destruct N as [N|[L U]];
    [unfold is_zero in Z; rewrite N in Z; discriminate|].
  pose proof (power_pos (width - 64) ltac:(lia)) as P. set (s := (2 ^ (width - 64))%Z) in *.
  pose proof (Z.div_mod (digits a) s ltac:(lia)) as DM. pose proof (Z.mod_pos_bound (digits a) s P) as M.
  assert (T : (2 ^ 63 <= digits a / s < 2 ^ 64)%Z).
  { split; [apply Z.div_le_lower_bound; [exact P|]|apply Z.div_lt_upper_bound; [exact P|]].
    - unfold s. rewrite <- power_split by lia. replace (width - 64 + 63)%Z with (width - 1)%Z by ring. exact L.
    - unfold s. rewrite <- power_split by lia. replace (width - 64 + 64)%Z with width by ring. exact U. }
  unfold fraction. fold s. set (t := (digits a / s)%Z) in *. pose proof (double_of_is t ltac:(lia)) as D.
  destruct power_numbers as [B1 B2].
  assert (T' : 9223372036854775808 <= IZR t <= 18446744073709551616).
  { destruct T as [T1 T2]. split; apply IZR_le; [exact T1|]. apply Z.lt_le_incl, T2. }
  assert (R : near one (nearest64 (IZR t)) (IZR t)).
  { apply rounding_is_near. right. rewrite Rabs_pos_eq by lra. apply Rle_trans with 1; [|lra]. apply (bpow_le radix2 (-1022) 0). lia. }
  pose proof (near_size one _ _ R ltac:(unfold one; lra)) as S. rewrite (Rabs_pos_eq (IZR t)) in S by lra.
  exists (nearest64 (IZR t) * bpow radix2 (-64)). split.
  - apply ldexp_is; [exact D|]. rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 (-64))) by apply bpow_ge_0. split.
    + apply Rle_trans with (bpow radix2 (-3)); [apply bpow_le; lia|]. change (bpow radix2 (-3)) with (/ 8). rewrite B1. lra.
    + apply Rle_trans with (bpow radix2 2); [|apply bpow_le; lia]. change (bpow radix2 2) with 4. rewrite B1. lra.
  - assert (E : near (/ 100) (IZR t * bpow radix2 (-64)) (share_of_one width a)).
    { apply near_more with (/ 9000000000000000000 * (1 + / 1000) / unit53); [|unfold unit53; lra]. apply close_is_near; [|lra].
      set (F0 := share_of_one width a) in *. rewrite (Rabs_pos_eq F0) by lra.
      assert (K : F0 = (IZR t + IZR (digits a mod s) * bpow radix2 (64 - width)) * bpow radix2 (-64)).
      { assert (E1 : bpow radix2 (width - 64) * bpow radix2 (- width) = bpow radix2 (-64)) by (rewrite <- bpow_plus; f_equal; ring).
        assert (E2 : bpow radix2 (64 - width) * bpow radix2 (-64) = bpow radix2 (- width)) by (rewrite <- bpow_plus; f_equal; ring).
        unfold F0, share_of_one. rewrite DM at 1. rewrite plus_IZR, mult_IZR. unfold s at 1. rewrite IZR_power by lia.
        rewrite Rmult_plus_distr_r, (Rmult_plus_distr_r (IZR t)), (Rmult_assoc (IZR (digits a mod s))), E2, <- E1. ring. }
      assert (V : 0 <= IZR (digits a mod s) * bpow radix2 (64 - width) <= 1).
      { split; [apply Rmult_le_pos; [apply IZR_le; lia|apply bpow_ge_0]|].
        apply Rle_trans with (IZR s * bpow radix2 (64 - width)); [apply Rmult_le_compat_r; [apply bpow_ge_0|apply IZR_le; lia]|].
        unfold s. rewrite IZR_power, <- bpow_plus by lia. replace (width - 64 + (64 - width))%Z with 0%Z by ring. right. reflexivity. }
      rewrite B1 in *. apply Rabs_le. lra. }
    replace (11 / 10) with (one + (11 / 10 - one)) by ring. apply near_then with (IZR t * bpow radix2 (-64)).
    + replace one with (one + 0) by ring. apply near_times; [exact R|apply near_exactly].
    + apply near_more with (1 := E). unfold one. lra.
Qed.
