(* SPDX-License-Identifier: BSD-3-Clause *)
(* Newton's method for a number of the third stage ends with all bits but eight right: fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients.
From Forceshade Require Import BigFloatNarrow BigFloatNarrowQuotient BigFloatNarrowRoot BigFloatNewton BigFloatNewtonStart
  BigFloatNewtonSteps.
Open Scope R_scope.

(* ---- The limbs that are cut off ---- *)

Lemma truncated_is : forall width a bits, (0 <= bits)%Z -> (128 <= width)%Z -> normal width a ->
  normal width (truncated width a bits) /\
  Rabs (value width (truncated width a bits) - value width a) <= bpow radix2 (- (bits + 64)) * Rabs (value width a).
Proof.
  intros width a bits B W N. unfold truncated. set (c := (64 * Z.max 0 (width / 64 - (bits / 64 + 2)))%Z).
  pose proof (Z.div_mod width 64 ltac:(lia)) as DW. pose proof (Z.mod_pos_bound width 64 ltac:(lia)) as MW.
  pose proof (Z.div_mod bits 64 ltac:(lia)) as DB. pose proof (Z.mod_pos_bound bits 64 ltac:(lia)) as MB.
  pose proof (Z.div_pos bits 64 B ltac:(lia)) as PB.
  assert (C : (0 <= c)%Z /\ (c = 0 \/ c <= width - bits - 65)%Z) by (unfold c; lia). destruct C as [C0 C].
  assert (C2 : (c <= width - 1)%Z) by lia. pose proof (power_pos c C0) as P. set (s := (2 ^ c)%Z) in *.
  pose proof (Z.div_mod (digits a) s ltac:(lia)) as DM. pose proof (Z.mod_pos_bound (digits a) s P) as M.
  set (q := (digits a / s)%Z) in *. set (r := (digits a mod s)%Z) in *. split.
  - destruct N as [N|[L U]]; [left|right]; cbn [digits].
    + unfold q. rewrite N, Z.div_0_l by lia. reflexivity.
    + split; [|nia]. rewrite (power_part (width - 1) c) in L by lia. fold s in L. rewrite (power_part (width - 1) c) by lia. fold s.
      rewrite (Z.mul_comm q). apply Z.mul_le_mono_nonneg_l; [lia|]. apply Z.div_le_lower_bound; [exact P|exact L].
  - assert (V : Rabs (value width (Big (negative a) (q * s) (exponent a) none) - value width a) = IZR r * bpow radix2 (exponent a - width)).
    { unfold value, signed. cbn [negative digits exponent].
      rewrite <- (Rabs_pos_eq (IZR r * _)) by (apply Rmult_le_pos; [apply IZR_le; lia|apply bpow_ge_0]).
      destruct (negative a); [|rewrite <- Rabs_Ropp]; f_equal; rewrite ?opp_IZR, DM, ?plus_IZR, !mult_IZR; ring. }
    rewrite V. clear V. destruct (is_zero a) eqn:Z.
    { apply Z.eqb_eq in Z. unfold r. rewrite Z, Z.mod_0_l by lia. rewrite Rmult_0_l. apply Rmult_le_pos; [apply bpow_ge_0|apply Rabs_pos]. }
    destruct C as [C|C].
    { assert (s = 1%Z) by (unfold s; now rewrite C). replace r with 0%Z by lia. rewrite Rmult_0_l.
      apply Rmult_le_pos; [apply bpow_ge_0|apply Rabs_pos]. }
    pose proof (value_above width a ltac:(lia) N Z) as A.
    apply Rle_trans with (bpow radix2 (- (bits + 64)) * bpow radix2 (exponent a - 1));
      [|apply Rmult_le_compat_l; [apply bpow_ge_0|exact A]].
    apply Rle_trans with (IZR s * bpow radix2 (exponent a - width)); [apply Rmult_le_compat_r; [apply bpow_ge_0|apply IZR_le; lia]|].
    unfold s. rewrite IZR_power, <- !bpow_plus by lia. apply bpow_le. lia.
Qed.

(* ---- A step of the model ---- *)

Lemma one_of_is : forall width k, (64 <= width)%Z -> (1074 <= k <= range)%Z ->
  normal width (one_of width) /\ fits k (one_of width) /\ value width (one_of width) = 1.
Proof.
  intros width k W K. unfold one_of. destruct (big_exactly_contains width (two_to 0) ltac:(lia)) as (_ & N & F).
  split; [exact N|]. split; [apply fits_le with (2 := F); lia|]. rewrite exactly_is by lia. exact (proj1 (two_to_is 0 ltac:(lia))).
Qed.

Lemma inverse_step_is : forall width k n b i, (64 <= width)%Z -> (20 * (k + width + 1100) <= range)%Z -> normal width b -> normal width i ->
  fits k b -> fits k i -> 0 <= n <= / 1000 -> Rabs (1 - value width b * value width i) <= n ->
  normal width (inverse_step width b i) /\
  Rabs (1 - value width b * value width (inverse_step width b i)) <= n * n + 6 * bpow radix2 (4 - width).
Proof.
  intros width k n b i W Hr Nb Ni Fb Fi N H. assert (K : (0 <= k)%Z) by (destruct Fb; lia). assert (W0 : (0 < width)%Z) by lia.
  assert (Fd : fits k (midpoint b)) by now apply midpoint_fits. unfold inverse_step.
  destruct (big_product_contains width k (midpoint b) i W0 ltac:(lia) Nb Ni Fd Fi) as (N1 & F1 & _).
  pose proof (product_rounds width (midpoint b) i W0 Nb Ni) as R1. set (p := multiply width (midpoint b) i) in *.
  assert (F1' : fits (2 * k + width + 1074) p) by (apply fits_le with (2 := F1); lia).
  destruct (one_of_is width (2 * k + width + 1074) ltac:(lia) ltac:(lia)) as (N0 & F0 & V0).
  destruct (big_difference_contains width (2 * k + width + 1074) (one_of width) p W0 ltac:(lia) N0 N1 F0 F1') as (N2 & F2 & _).
  pose proof (sum_rounds width (2 * k + width + 1074) (one_of width) (negated p) W0 ltac:(lia) N0 N1 F0 F1') as R2.
  rewrite value_negated, V0 in R2. fold (subtract width (one_of width) p) in R2. set (d := subtract width (one_of width) p) in *.
  assert (Fi' : fits (2 * k + 2 * width + 1077) i) by (apply fits_le with (2 := Fi); lia).
  assert (F2' : fits (2 * k + 2 * width + 1077) d) by (apply fits_le with (2 := F2); lia).
  destruct (big_product_contains width (2 * k + 2 * width + 1077) i d W0 ltac:(lia) Ni N2 Fi' F2') as (N3 & F3 & _).
  pose proof (product_rounds width i d W0 Ni N2) as R3. set (q := multiply width i d) in *.
  assert (Fi3 : fits (2 * (2 * k + 2 * width + 1077) + width + 4) i) by (apply fits_le with (2 := Fi); lia).
  destruct (big_sum_contains width (2 * (2 * k + 2 * width + 1077) + width + 4) i q W0 ltac:(lia) Ni N3 Fi3 F3) as (N4 & _ & _).
  pose proof (sum_rounds width (2 * (2 * k + 2 * width + 1077) + width + 4) i q W0 ltac:(lia) Ni N3 Fi3 F3) as R4. split; [exact N4|].
  change (value width (midpoint b)) with (value width b) in R1. set (B := value width b) in *. set (I := value width i) in *.
  set (e := bpow radix2 (4 - width)) in *.
  assert (E : 0 <= e <= / 1000).
  { split; [apply bpow_ge_0|]. apply Rle_trans with (bpow radix2 (-10)); [apply bpow_le; lia|]. simpl. lra. }
  assert (scale : forall x y z, Rabs (x - y) <= e * z -> Rabs (B * x - B * y) <= e * (Rabs B * z)).
  { intros x y z S. rewrite <- Rmult_minus_distr_l, Rabs_mult. replace (e * (Rabs B * z)) with (Rabs B * (e * z)) by ring.
    apply Rmult_le_compat_l; [apply Rabs_pos|exact S]. }
  apply scale in R3, R4. rewrite <- Rabs_mult in R3.
  assert (R4' : Rabs (B * value width (add width i q) - (B * I + B * value width q)) <= e * (Rabs (B * I) + Rabs (B * value width q))).
  { rewrite (Rabs_mult B I), (Rabs_mult B (value width q)), <- !Rmult_plus_distr_l. exact R4. }
  replace (B * (I * value width d)) with (B * I * value width d) in R3 by ring.
  exact (inverse_step_in_reals e n (B * I) _ _ _ _ E N H R1 R2 R3 R4').
Qed.

Lemma inverse_root_step_is : forall width k n a i, (64 <= width)%Z -> (20 * (k + width + 1100) <= range)%Z -> normal width a ->
  normal width i -> fits k a -> fits k i -> 0 <= n <= / 1000 -> 0 < value width a -> 0 < value width i ->
  Rabs (1 - value width a * (value width i * value width i)) <= n -> let s := inverse_root_step width a i in
  normal width s /\ 0 < value width s /\ Rabs (1 - value width a * (value width s * value width s)) <= n * n + 7 * bpow radix2 (4 - width).
Proof.
  intros width k n a i W Hr Na Ni Fa Fi N PA Pi H s. assert (K : (0 <= k)%Z) by (destruct Fa; lia). assert (W0 : (0 < width)%Z) by lia.
  assert (Fs : fits (2 * k + width + 4) (midpoint a)) by (apply midpoint_fits, fits_le with (2 := Fa); lia).
  unfold s, inverse_root_step.
  destruct (big_product_contains width k i i W0 ltac:(lia) Ni Ni Fi Fi) as (N0 & F0 & _).
  pose proof (product_rounds width i i W0 Ni Ni) as R0. set (m := multiply width i i) in *.
  destruct (big_product_contains width (2 * k + width + 4) (midpoint a) m W0 ltac:(lia) Na N0 Fs F0) as (N1 & F1 & _).
  pose proof (product_rounds width (midpoint a) m W0 Na N0) as R1. set (p := multiply width (midpoint a) m) in *.
  assert (F1' : fits (4 * k + 3 * width + 1074) p) by (apply fits_le with (2 := F1); lia).
  destruct (one_of_is width (4 * k + 3 * width + 1074) ltac:(lia) ltac:(lia)) as (No & Fo & Vo).
  destruct (big_difference_contains width (4 * k + 3 * width + 1074) (one_of width) p W0 ltac:(lia) No N1 Fo F1') as (N2 & F2 & _).
  pose proof (sum_rounds width (4 * k + 3 * width + 1074) (one_of width) (negated p) W0 ltac:(lia) No N1 Fo F1') as R2.
  rewrite value_negated, Vo in R2. fold (subtract width (one_of width) p) in R2. set (d := subtract width (one_of width) p) in *.
  assert (Fi' : fits (4 * k + 4 * width + 1077) i) by (apply fits_le with (2 := Fi); lia).
  assert (F2' : fits (4 * k + 4 * width + 1077) d) by (apply fits_le with (2 := F2); lia).
  destruct (big_product_contains width (4 * k + 4 * width + 1077) i d W0 ltac:(lia) Ni N2 Fi' F2') as (N3 & F3 & _).
  pose proof (product_rounds width i d W0 Ni N2) as R3. set (q := multiply width i d) in *. apply (scaled_fits _ (-1)) in F3; [|lia].
  assert (F3' : fits (8 * k + 9 * width + 2159) (scaled q (-1))) by (apply fits_le with (2 := F3); lia).
  assert (Fi3 : fits (8 * k + 9 * width + 2159) i) by (apply fits_le with (2 := Fi); lia).
  destruct (big_sum_contains width (8 * k + 9 * width + 2159) i (scaled q (-1)) W0 ltac:(lia) Ni N3 Fi3 F3') as (N4 & _ & _).
  pose proof (sum_rounds width (8 * k + 9 * width + 2159) i (scaled q (-1)) W0 ltac:(lia) Ni N3 Fi3 F3') as R4.
  rewrite value_halved in R4. split; [exact N4|].
  assert (E : 0 <= bpow radix2 (4 - width) <= / 1000).
  { split; [apply bpow_ge_0|]. apply Rle_trans with (bpow radix2 (-10)); [apply bpow_le; lia|]. simpl. lra. }
  exact (inverse_root_step_in_reals (bpow radix2 (4 - width)) n (value width a) (value width i) _ _ _ _ _ E N PA Pi H R0 R1 R2 R3 R4).
Qed.

(* ---- The loop ---- *)

(* More steps would not be taken. *)
Lemma loop_ends : forall more fuel step width bits i, (width <= bits * 2 ^ Z.of_nat fuel)%Z ->
  newton_loop (fuel + more) step width bits i = newton_loop fuel step width bits i.
Proof.
  intros more fuel. induction fuel as [|fuel IH]; intros step width bits i H.
  - change (2 ^ Z.of_nat 0)%Z with 1%Z in H. destruct more as [|more]; [reflexivity|]. cbn [Nat.add newton_loop].
    now rewrite (proj2 (Z.ltb_ge bits width)) by lia.
  - cbn [Nat.add newton_loop]. destruct (bits <? width)%Z; [|reflexivity]. apply IH.
    rewrite Nat2Z.inj_succ, Z.pow_succ_r in H by lia. lia.
Qed.

Lemma fuel_is_enough : forall width bits, (1 <= bits)%Z -> (1 < width)%Z -> (width <= bits * 2 ^ Z.of_nat (newton_fuel width))%Z.
Proof.
  intros width bits B W. unfold newton_fuel. pose proof (Z.log2_up_nonneg width). rewrite Z2Nat.id by lia.
  pose proof (proj2 (Z.log2_up_spec width W)). nia.
Qed.

Lemma loop_keeps : forall (good : Z -> big -> Prop) step width,
  (forall bits i, (49 <= bits < width)%Z -> good bits i -> good (2 * bits)%Z (truncated width (step i) (2 * bits))) ->
  forall fuel bits i, (49 <= bits)%Z -> (width <= bits * 2 ^ Z.of_nat fuel)%Z -> good bits i ->
  exists last, (width <= last)%Z /\ good last (newton_loop fuel step width bits i).
Proof.
  intros good step width S fuel. induction fuel as [|fuel IH]; intros bits i B H G.
  - exists bits. change (2 ^ Z.of_nat 0)%Z with 1%Z in H. split; [lia|exact G].
  - cbn [newton_loop]. destruct (Z.ltb_spec bits width) as [L|L].
    + apply IH; [lia| |apply S; [lia|exact G]]. rewrite Nat2Z.inj_succ, Z.pow_succ_r in H by lia. lia.
    + exists bits. now split.
Qed.

(* ---- What it ends with ---- *)

(* The bits that are right after a step that was to gain `bits` of them. *)
Definition right_bits (width bits : Z) : Z := Z.min (bits + 1) (width - 8).

Definition good_inverse (width : Z) (b : big) (bits : Z) (i : big) : Prop :=
  normal width i /\ error i = none /\ Rabs (1 - value width b * value width i) <= bpow radix2 (- right_bits width bits).

Definition good_inverse_root (width : Z) (a : big) (bits : Z) (i : big) : Prop :=
  normal width i /\ error i = none /\ 0 < value width i /\
  Rabs (1 - value width a * (value width i * value width i)) <= bpow radix2 (- right_bits width bits).

Lemma right_bits_are : forall width bits, (128 <= width)%Z -> (49 <= bits)%Z ->
  let n := bpow radix2 (- right_bits width bits) in let m := bpow radix2 (- right_bits width (2 * bits)) in
  0 < m /\ 0 <= n <= / 1000 /\ n * n <= m / 2 /\ 0 < bpow radix2 (4 - width) <= m / 16 /\ m <= / 1000 /\
  0 < bpow radix2 (- (2 * bits + 64)) <= m / 128.
Proof.
  intros width bits W B n m. unfold n, m, right_bits.
  assert (H : forall j e, (e <= - Z.min (2 * bits + 1) (width - 8) - j)%Z -> (0 <= j)%Z ->
    bpow radix2 e <= bpow radix2 (- Z.min (2 * bits + 1) (width - 8)) * bpow radix2 (- j)).
  { intros j e E J. rewrite <- bpow_plus. apply bpow_le. lia. }
  assert (T : forall e, (e <= -10)%Z -> bpow radix2 e <= / 1000).
  { intros e E. apply Rle_trans with (bpow radix2 (-10)); [now apply bpow_le|]. change (bpow radix2 (-10)) with (/ 1024). lra. }
  split; [apply bpow_gt_0|]. split; [split; [apply bpow_ge_0|apply T; lia]|]. split; [|split; [|split; [apply T; lia|]]].
  - rewrite <- bpow_plus. apply (H 1%Z); lia.
  - split; [apply bpow_gt_0|]. apply (H 4%Z); lia.
  - split; [apply bpow_gt_0|]. apply (H 7%Z); lia.
Qed.

Lemma inverse_fits : forall width k b i, (0 < width)%Z -> (k + 3 <= range)%Z -> normal width b -> is_zero b = false -> fits k b ->
  normal width i -> error i = none -> Rabs (1 - value width b * value width i) <= / 1000 -> fits (k + 3) i.
Proof.
  intros width k b i W Hr Nb Zb [Eb _] Ni Ei H. split; [|now left]. apply Rabs_le_inv in H.
  assert (Zi : is_zero i = false) by (destruct (is_zero i) eqn:Z; [rewrite (value_of_zero width i Z) in H; lra|reflexivity]).
  pose proof (value_above width b W Nb Zb) as B1. pose proof (value_below width b W Nb) as B2.
  pose proof (value_above width i W Ni Zi) as I1. pose proof (value_below width i W Ni) as I2.
  assert (P : Rabs (value width b) * Rabs (value width i) = value width b * value width i) by (rewrite <- Rabs_mult;
    apply Rabs_pos_eq; lra).
  pose proof (Rabs_pos (value width b)). pose proof (Rabs_pos (value width i)).
  assert (L : (-1 < exponent b + exponent i)%Z).
  { apply (lt_bpow radix2). change (bpow radix2 (-1)) with (/ 2). rewrite bpow_plus.
    assert (Rabs (value width b) * Rabs (value width i) <= bpow radix2 (exponent b) * bpow radix2 (exponent i)); [|lra].
    apply Rmult_le_compat; lra. }
  assert (U : (exponent b - 1 + (exponent i - 1) < 1)%Z).
  { apply (lt_bpow radix2). change (bpow radix2 1) with 2. rewrite bpow_plus.
    assert (bpow radix2 (exponent b - 1) * bpow radix2 (exponent i - 1) <= Rabs (value width b) * Rabs (value width i)); [|lra].
    apply Rmult_le_compat; try apply bpow_ge_0; assumption. }
  lia.
Qed.

Lemma inverse_root_fits : forall width k a i, (0 < width)%Z -> (k + 3 <= range)%Z -> normal width a -> is_zero a = false -> fits k a ->
  normal width i -> error i = none -> Rabs (1 - value width a * (value width i * value width i)) <= / 1000 -> fits (k + 3) i.
Proof.
  intros width k a i W Hr Na Za [Ea _] Ni Ei H. split; [|now left]. apply Rabs_le_inv in H.
  assert (Zi : is_zero i = false) by (destruct (is_zero i) eqn:Z; [rewrite (value_of_zero width i Z) in H; lra|reflexivity]).
  pose proof (value_above width a W Na Za) as A1. pose proof (value_below width a W Na) as A2.
  pose proof (value_above width i W Ni Zi) as I1. pose proof (value_below width i W Ni) as I2.
  assert (P : Rabs (value width a) * (Rabs (value width i) * Rabs (value width i)) = value width a * (value width i * value width i)).
  { rewrite <- !Rabs_mult. apply Rabs_pos_eq. lra. }
  pose proof (Rabs_pos (value width a)). pose proof (Rabs_pos (value width i)).
  assert (L : (-1 < exponent a + (exponent i + exponent i))%Z).
  { apply (lt_bpow radix2). change (bpow radix2 (-1)) with (/ 2). rewrite !bpow_plus.
    assert (Rabs (value width a) * (Rabs (value width i) * Rabs (value width i)) <=
      bpow radix2 (exponent a) * (bpow radix2 (exponent i) * bpow radix2 (exponent i))); [|lra].
    apply Rmult_le_compat; try lra; [apply Rmult_le_pos; lra|]. apply Rmult_le_compat; lra. }
  assert (U : (exponent a - 1 + (exponent i - 1 + (exponent i - 1)) < 1)%Z).
  { apply (lt_bpow radix2). change (bpow radix2 1) with 2. rewrite !bpow_plus.
    assert (bpow radix2 (exponent a - 1) * (bpow radix2 (exponent i - 1) * bpow radix2 (exponent i - 1)) <=
      Rabs (value width a) * (Rabs (value width i) * Rabs (value width i))); [|lra].
    pose proof (bpow_ge_0 radix2 (exponent i - 1)).
    apply Rmult_le_compat; try assumption; [apply bpow_ge_0|now apply Rmult_le_pos|]. now apply Rmult_le_compat. }
  lia.
Qed.

Lemma inverse_keeps_good : forall width k b bits i, (128 <= width)%Z -> (20 * (k + 3 + width + 1100) <= range)%Z -> normal width b ->
  is_zero b = false -> fits k b -> (49 <= bits < width)%Z -> good_inverse width b bits i ->
  good_inverse width b (2 * bits) (truncated width (inverse_step width b i) (2 * bits)).
Proof.
  intros width k b bits i W Hr Nb Zb Fb B (Ni & Ei & H). assert (K : (0 <= k)%Z) by (destruct Fb; lia).
  destruct (right_bits_are width bits W ltac:(lia)) as (M0 & N & NN & E & M1 & T).
  assert (Fi : fits (k + 3) i) by (apply (inverse_fits width k b); try assumption; [lia|lia|lra]).
  assert (Fb' : fits (k + 3) b) by (apply fits_le with (2 := Fb); lia).
  destruct (inverse_step_is width (k + 3) _ b i ltac:(lia) Hr Nb Ni Fb' Fi N H) as (Ns & Hs).
  set (s := inverse_step width b i) in *. destruct (truncated_is width s (2 * bits) ltac:(lia) W Ns) as (Nt & Ht).
  split; [exact Nt|]. split; [reflexivity|]. set (t := truncated width s (2 * bits)) in *.
  set (m := bpow radix2 (- right_bits width (2 * bits))) in *. set (c := bpow radix2 (- (2 * bits + 64))) in *.
  assert (S1 : Rabs (1 - value width b * value width s) <= 14 / 16 * m) by lra.
  assert (S2 : Rabs (value width b * value width s) <= 2).
  { apply Rabs_le_inv in S1. apply Rabs_le. lra. }
  assert (D : Rabs (value width b * value width t - value width b * value width s) <= c * 2).
  { rewrite <- Rmult_minus_distr_l, Rabs_mult. apply Rle_trans with (Rabs (value width b) * (c * Rabs (value width s))).
    - apply Rmult_le_compat_l; [apply Rabs_pos|exact Ht].
    - replace (Rabs (value width b) * (c * Rabs (value width s))) with (c * (Rabs (value width b) * Rabs (value width s))) by ring.
      rewrite <- Rabs_mult. apply Rmult_le_compat_l; [lra|exact S2]. }
  apply Rabs_le_inv in S1, D. apply Rabs_le. lra.
Qed.

Lemma inverse_root_keeps_good : forall width k a bits i, (128 <= width)%Z -> (20 * (k + 3 + width + 1100) <= range)%Z -> normal width a ->
  is_zero a = false -> 0 < value width a -> fits k a -> (49 <= bits < width)%Z -> good_inverse_root width a bits i ->
  good_inverse_root width a (2 * bits) (truncated width (inverse_root_step width a i) (2 * bits)).
Proof.
  intros width k a bits i W Hr Na Za PA Fa B (Ni & Ei & Pi & H). assert (K : (0 <= k)%Z) by (destruct Fa; lia).
  destruct (right_bits_are width bits W ltac:(lia)) as (M0 & N & NN & E & M1 & T).
  assert (Fi : fits (k + 3) i) by (apply (inverse_root_fits width k a); try assumption; [lia|lia|lra]).
  assert (Fa' : fits (k + 3) a) by (apply fits_le with (2 := Fa); lia).
  destruct (inverse_root_step_is width (k + 3) _ a i ltac:(lia) Hr Na Ni Fa' Fi N PA Pi H) as (Ns & Ps & Hs).
  set (s := inverse_root_step width a i) in *. destruct (truncated_is width s (2 * bits) ltac:(lia) W Ns) as (Nt & Ht).
  split; [exact Nt|]. split; [reflexivity|]. set (t := truncated width s (2 * bits)) in *.
  set (m := bpow radix2 (- right_bits width (2 * bits))) in *. set (c := bpow radix2 (- (2 * bits + 64))) in *.
  set (A := value width a) in *. set (S := value width s) in *. set (T0 := value width t) in *.
  rewrite (Rabs_pos_eq S) in Ht by lra. assert (cS : 0 <= c * S <= S / 1000).
  { split; [apply Rmult_le_pos; lra|]. pose proof (Rmult_le_compat_r S c (/ 1000) ltac:(lra) ltac:(lra)). lra. }
  pose proof (Rabs_le_inv _ _ Ht) as Ht'. split; [lra|].
  assert (S1 : Rabs (1 - A * (S * S)) <= 15 / 16 * m) by lra. pose proof (Rabs_le_inv _ _ S1) as S1'.
  assert (D : Rabs (A * (T0 * T0) - A * (S * S)) <= c * 5).
  { replace (A * (T0 * T0) - A * (S * S)) with (A * ((T0 - S) * (T0 + S))) by ring. rewrite Rabs_mult, (Rabs_pos_eq A) by lra.
    apply Rle_trans with (A * (c * S * (2001 / 1000 * S))).
    - apply Rmult_le_compat_l; [lra|]. apply product_at_most; [exact Ht|]. apply Rabs_le. lra.
    - replace (A * (c * S * (2001 / 1000 * S))) with (c * (2001 / 1000 * (A * (S * S)))) by ring. apply Rmult_le_compat_l; lra. }
  apply Rabs_le_inv in D. apply Rabs_le. lra.
Qed.

(* All bits but eight. *)
Theorem newton_inverse_is_good : forall width k b, (128 <= width)%Z -> (20 * (k + 3 + width + 1100) <= range)%Z -> normal width b ->
  is_zero b = false -> fits k b -> let i := newton_inverse width b in
  normal width i /\ fits (k + 3) i /\ Rabs (1 - value width b * value width i) <= bpow radix2 (- (width - 8)).
Proof.
  intros width k b W Hr Nb Zb Fb i. assert (K : (0 <= k)%Z) by (destruct Fb; lia). unfold i, newton_inverse.
  destruct (inverse_start_is_good width b ltac:(lia) Nb Zb) as (N0 & E0 & H0); [destruct Fb as [Eb _]; lia|].
  destruct (loop_keeps (good_inverse width b) (inverse_step width b) width) with (fuel := newton_fuel width) (bits := 50%Z)
    (i := inverse_start width b) as (last & L & N & E & H); try lia.
  - intros bits j B G. now apply (inverse_keeps_good width k).
  - apply fuel_is_enough; lia.
  - split; [exact N0|]. split; [exact E0|]. apply Rle_trans with (1 := H0). apply bpow_le. unfold right_bits. lia.
  - unfold right_bits in H. rewrite Z.min_r in H by lia. split; [exact N|]. split; [|exact H].
    apply (inverse_fits width k b); try assumption; [lia|lia|]. apply Rle_trans with (1 := H).
    apply Rle_trans with (bpow radix2 (-10)); [apply bpow_le; lia|]. change (bpow radix2 (-10)) with (/ 1024). lra.
Qed.

Theorem newton_inverse_root_is_good : forall width k a, (128 <= width)%Z -> (20 * (k + 3 + width + 1100) <= range)%Z -> normal width a ->
  is_zero a = false -> negative a = false -> fits k a -> let i := newton_inverse_root width a in
  normal width i /\ fits (k + 3) i /\ 0 < value width i /\
  Rabs (1 - value width a * (value width i * value width i)) <= bpow radix2 (- (width - 8)).
Proof.
  intros width k a W Hr Na Za Sa Fa i. assert (K : (0 <= k)%Z) by (destruct Fa; lia). unfold i, newton_inverse_root.
  destruct (inverse_root_start_is_good width a ltac:(lia) Na Za Sa) as (N0 & E0 & P0 & H0); [destruct Fa as [Ea _]; lia|].
  pose proof (value_of_positive width a ltac:(lia) Na Za Sa) as PA. pose proof (bpow_gt_0 radix2 (exponent a - 1)) as G0.
  destruct (loop_keeps (good_inverse_root width a) (inverse_root_step width a) width) with (fuel := newton_fuel width) (bits := 49%Z)
    (i := inverse_root_start width a) as (last & L & N & E & P & H); try lia.
  - intros bits j B G. apply (inverse_root_keeps_good width k); try assumption. lra.
  - apply fuel_is_enough; lia.
  - split; [exact N0|]. split; [exact E0|]. split; [exact P0|]. apply Rle_trans with (1 := H0). apply bpow_le. unfold right_bits. lia.
  - unfold right_bits in H. rewrite Z.min_r in H by lia. split; [exact N|]. split; [|now split].
    apply (inverse_root_fits width k a); try assumption; [lia|lia|]. apply Rle_trans with (1 := H).
    apply Rle_trans with (bpow radix2 (-10)); [apply bpow_le; lia|]. change (bpow radix2 (-10)) with (/ 1024). lra.
Qed.
