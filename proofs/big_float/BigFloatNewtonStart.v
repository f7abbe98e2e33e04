(* SPDX-License-Identifier: BSD-3-Clause *)
(* What Newton's method starts with for a number of the third stage is good to 50 bits: fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations Nearness BigFloat BigFloatValues BigFloatProducts BigFloatQuotients BigFloatNewton.
Open Scope R_scope.

Lemma value_scaled : forall width a k, value width (scaled a k) = value width a * bpow radix2 k.
Proof.
  intros width a k. unfold value. change (signed (scaled a k)) with (signed a). change (exponent (scaled a k)) with (exponent a + k)%Z.
  rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. ring.
Qed.

Lemma start_is_normal : forall width v k, (53 <= width)%Z -> (- range <= k <= range)%Z ->
  normal width (scaled (exactly width v) k) /\ error (scaled (exactly width v) k) = none /\
  value width (scaled (exactly width v) k) = value64 v * bpow radix2 k.
Proof.
  intros width v k W K. destruct (big_exactly_contains width v W) as (_ & N & _). split; [exact N|]. split.
  - change (error (scaled (exactly width v) k)) with (clamp (error (exactly width v) + k)).
    replace (error (exactly width v)) with none by (destruct v; reflexivity). unfold clamp.
    rewrite (proj2 (Z.ltb_lt _ _)); [reflexivity|]. numbers. lia.
  - rewrite value_scaled. f_equal. now apply exactly_is.
Qed.

Lemma nonzero_of_near : forall n a A, near n a A -> 0 < A -> 0 < a.
Proof. intros n a A H. apply (near_sign n a A H). Qed.

Lemma inverse_start_is_good : forall width b, (64 <= width)%Z -> normal width b -> is_zero b = false ->
  (- range <= exponent b <= range)%Z -> let i := inverse_start width b in
  normal width i /\ error i = none /\ Rabs (1 - value width b * value width i) <= bpow radix2 (-51).
Proof.
  intros width b W N Z E i. unfold i, inverse_start. destruct (fraction_is width b W N Z) as (f & Hf & Nf).
  pose proof (share_is width b W N Z) as F. rewrite (value_is_share width b). set (s := share_of_one width b) in *.
  set (g := if negative b then -1 else 1).
  assert (G : Rabs g = 1) by (unfold g; destruct (negative b); [rewrite Rabs_left|rewrite Rabs_pos_eq]; lra).
  assert (G2 : g * g = 1) by (unfold g; destruct (negative b); ring).
  assert (Hg : is64 (if negative b then opp (two_to 0) else two_to 0) g).
  { pose proof (two_to_is 0 ltac:(lia)) as T. change (bpow radix2 0) with 1 in T. unfold g. destruct (negative b); [|exact T].
    replace (-1) with (- (1)) by ring. now apply opp_is. }
  pose proof (near_size _ _ _ Nf ltac:(lra)) as S. pose proof (nonzero_of_near _ _ _ Nf ltac:(lra)) as Pf.
  rewrite (Rabs_pos_eq s), (Rabs_pos_eq f) in S by lra.
  assert (Gf : / 2 <= Rabs (g / f) <= 4).
  { unfold Rdiv. rewrite Rabs_mult, G, Rmult_1_l, Rabs_pos_eq by (apply Rlt_le, Rinv_0_lt_compat; lra).
    split; [apply Rinv_le; lra|]. replace 4 with (/ / 4) by (field). apply Rinv_le; lra. }
  assert (D : is64 (over (if negative b then opp (two_to 0) else two_to 0) (fraction width b)) (nearest64 (g / f))).
  { apply over_is; try assumption; [lra|]. apply Rle_trans with (bpow radix2 2); [|apply bpow_le; lia].
    change (bpow radix2 2) with 4. lra. }
  set (v := over _ _) in *. destruct D as [Dv _].
  destruct (start_is_normal width v (- exponent b) ltac:(lia) ltac:(lia)) as (N1 & N2 & N3). split; [exact N1|]. split; [exact N2|].
  rewrite N3, Dv. assert (C : near (22 / 10) (nearest64 (g / f)) (g / s)).
  { replace (22 / 10) with (one + (22 / 10 - one)) by ring. apply near_then with (g / f).
    - apply rounding_is_near. right. apply Rle_trans with (bpow radix2 (-1)); [apply bpow_le; lia|].
      change (bpow radix2 (-1)) with (/ 2). lra.
    - apply near_more with (0 + 11 / 10); [|unfold one; lra]. apply near_over; [apply near_exactly|exact Nf|lra]. }
  set (q := nearest64 (g / f)) in *.
  replace (g * s * bpow radix2 (exponent b) * (q * bpow radix2 (- exponent b))) with (g * s * q).
  2: { assert (B : bpow radix2 (exponent b) * bpow radix2 (- exponent b) = 1)
         by (rewrite <- bpow_plus; now replace (exponent b + - exponent b)%Z with 0%Z by ring).
       transitivity (g * s * q * (bpow radix2 (exponent b) * bpow radix2 (- exponent b))); [rewrite B|]; ring. }
  assert (H : near (22 / 10) (g * s * q) 1).
  { replace 1 with (g * s * (g / s)) by (field_simplify; [lra|lra]). replace (22 / 10) with (0 + 22 / 10) by ring.
    apply near_times; [apply near_exactly|exact C]. }
  apply near_is_close in H; [|lra]. rewrite Rabs_minus_sym. apply Rle_trans with (1 := H). rewrite Rabs_R1. unfold unit53.
  change (bpow radix2 (-51)) with (/ 2251799813685248). lra.
Qed.

Lemma half_exponent_is : forall a, (0 <= exponent a - 2 * half_exponent a <= 1)%Z.
Proof.
  intro a. unfold half_exponent. destruct (Z.leb_spec 0 (exponent a)) as [H|H].
  - rewrite Z.quot_div_nonneg by lia. pose proof (Z.div_mod (exponent a) 2 ltac:(lia)).
    pose proof (Z.mod_pos_bound (exponent a) 2 ltac:(lia)). lia.
  - rewrite Z.quot_div_nonneg by lia. pose proof (Z.div_mod (1 - exponent a) 2 ltac:(lia)).
    pose proof (Z.mod_pos_bound (1 - exponent a) 2 ltac:(lia)). lia.
Qed.

Lemma inverse_root_start_is_good : forall width a, (64 <= width)%Z -> normal width a -> is_zero a = false -> negative a = false ->
  (- range <= exponent a <= range)%Z -> let i := inverse_root_start width a in
  normal width i /\ error i = none /\ 0 < value width i /\
  Rabs (1 - value width a * (value width i * value width i)) <= bpow radix2 (-50).
Proof.
  intros width a W N Z Sg E i. unfold i, inverse_root_start. cbv zeta. destruct (fraction_is width a W N Z) as (f & Hf & Nf).
  pose proof (share_is width a W N Z) as F. rewrite (value_is_share width a), Sg. set (s := share_of_one width a) in *.
  pose proof (half_exponent_is a) as Hh. set (h := half_exponent a) in *. set (d := (exponent a - 2 * h)%Z) in *.
  pose proof (near_size _ _ _ Nf ltac:(lra)) as S. pose proof (nonzero_of_near _ _ _ Nf ltac:(lra)) as Pf.
  rewrite (Rabs_pos_eq s), (Rabs_pos_eq f) in S by lra.
  assert (B : 1 <= bpow radix2 d <= 2) by (assert (d = 0 \/ d = 1)%Z as [-> | ->] by lia; cbn; lra).
  assert (R : is64 (ldexp (fraction width a) d) (f * bpow radix2 d)).
  { apply ldexp_is; [exact Hf|]. rewrite Rabs_pos_eq by (apply Rmult_le_pos; lra). split.
    - apply Rle_trans with (bpow radix2 (-2)); [apply bpow_le; lia|]. change (bpow radix2 (-2)) with (/ 4).
      apply Rle_trans with (/ 4 * 1); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with (bpow radix2 2); [|apply bpow_le; lia]. change (bpow radix2 2) with 4.
      apply Rle_trans with (2 * 2); [apply Rmult_le_compat; lra|lra]. }
  set (v := ldexp (fraction width a) d) in *. set (x := f * bpow radix2 d) in *. set (X := s * bpow radix2 d).
  assert (NX : near (11 / 10) x X).
  { replace (11 / 10) with (11 / 10 + 0) by ring. apply near_times; [exact Nf|apply near_exactly]. }
  assert (Xb : / 2 <= X <= 2).
  { unfold X. split; [apply Rle_trans with (/ 2 * 1)|apply Rle_trans with (1 * 2)]; try lra; apply Rmult_le_compat; lra. }
  pose proof (nonzero_of_near _ _ _ NX ltac:(lra)) as Px. pose proof (near_size _ _ _ NX ltac:(lra)) as Sx.
  rewrite (Rabs_pos_eq X), (Rabs_pos_eq x) in Sx by lra.
  pose proof (square_root_is v x R ltac:(lra)) as Q. set (w := Operations.square_root v) in *.
  assert (Rx : / 2 <= sqrt x <= 2).
  { split; [apply Rle_trans with (sqrt (/ 2 * / 2))|apply Rle_trans with (sqrt (2 * 2))]; try (apply sqrt_le_1_alt; lra);
      rewrite sqrt_square; lra. }
  assert (NQ : near (156 / 100) (nearest64 (sqrt x)) (sqrt X)).
  { replace (156 / 100) with (one + (156 / 100 - one)) by ring. apply near_then with (sqrt x).
    - apply rounding_is_near. right. rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 (-1)); [apply bpow_le; lia|].
      change (bpow radix2 (-1)) with (/ 2). lra.
    - apply near_more with (11 / 10 / 2); [|unfold one; lra]. apply near_root; [exact NX|lra]. }
  set (y := nearest64 (sqrt x)) in *. assert (RX : 0 < sqrt X) by (apply sqrt_lt_R0; lra).
  assert (Yb : / 4 <= y <= 4).
  { assert (N1 : near one y (sqrt x)).
    { apply rounding_is_near. right. rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 (-1)); [apply bpow_le; lia|].
      change (bpow radix2 (-1)) with (/ 2). lra. }
    pose proof (nonzero_of_near _ _ _ N1 ltac:(lra)). pose proof (near_size _ _ _ N1 ltac:(unfold one; lra)) as Sy.
    rewrite (Rabs_pos_eq y), (Rabs_pos_eq (sqrt x)) in Sy by lra. lra. }
  assert (Ib : / 4 <= 1 / y <= 4).
  { unfold Rdiv. rewrite Rmult_1_l. split; [|replace 4 with (/ / 4) by field]; apply Rinv_le; lra. }
  assert (D : is64 (over (two_to 0) w) (nearest64 (1 / y))).
  { apply over_is; try assumption; [exact (two_to_is 0 ltac:(lia))|lra|]. rewrite Rabs_pos_eq by lra.
    apply Rle_trans with (bpow radix2 2); [|apply bpow_le; lia]. change (bpow radix2 2) with 4. lra. }
  destruct D as [Dv _]. destruct (start_is_normal width (over (two_to 0) w) (- h) ltac:(lia) ltac:(lia)) as (N1 & N2 & N3).
  split; [exact N1|]. split; [exact N2|]. rewrite N3, Dv.
  assert (C : near (257 / 100) (nearest64 (1 / y)) (1 / sqrt X)).
  { replace (257 / 100) with (one + (257 / 100 - one)) by ring. apply near_then with (1 / y).
    - apply rounding_is_near. right. rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 (-2)); [apply bpow_le; lia|].
      change (bpow radix2 (-2)) with (/ 4). lra.
    - apply near_more with (0 + 156 / 100); [|unfold one; lra]. apply near_over; [apply near_exactly|exact NQ|lra]. }
  set (q := nearest64 (1 / y)) in *. assert (Pq : 0 < q) by (apply (nonzero_of_near _ _ _ C); apply Rdiv_lt_0_compat; lra).
  split; [apply Rmult_lt_0_compat; [exact Pq|apply bpow_gt_0]|].
  replace (1 * s * bpow radix2 (exponent a) * (q * bpow radix2 (- h) * (q * bpow radix2 (- h)))) with (X * (q * q)).
  2: { assert (B2 : bpow radix2 d = bpow radix2 (exponent a) * (bpow radix2 (- h) * bpow radix2 (- h))).
       { rewrite <- !bpow_plus. f_equal. unfold d. ring. }
       unfold X. rewrite B2. ring. }
  assert (H : near (6) (X * (q * q)) 1).
  { replace 1 with (X * (1 / sqrt X * (1 / sqrt X))).
    - apply near_more with (0 + (257 / 100 + 257 / 100)); [|lra]. apply near_times; [apply near_exactly|now apply near_times].
    - rewrite <- (sqrt_sqrt X) at 1 by lra. field. lra. }
  apply near_is_close in H; [|lra]. rewrite Rabs_minus_sym. apply Rle_trans with (1 := H). rewrite Rabs_R1. unfold unit53.
  change (bpow radix2 (-50)) with (/ 1125899906842624). lra.
Qed.
