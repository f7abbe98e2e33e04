(* SPDX-License-Identifier: BSD-3-Clause *)
(* The third stage's numbers with bounds that are small, however small the numbers are: what is left of a sum that has cancelled.
   fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients BigFloatNarrow.
From Forceshade Require Import BigFloatNarrowQuotient BigFloatNewtonStart BigFloatRight BigFloatTight BigFloatDecide.
Open Scope R_scope.

(* The number holds x, the exponent of its bound is at most e, and its own is at most b. *)
Definition bounded (width k e b : Z) (a : big) (x : R) : Prop :=
  normal width a /\ fits k a /\ contains width a x /\ (error a <= e)%Z /\ (exponent a <= b)%Z.

Lemma bounded_more : forall width k e b a x j f c, bounded width k e b a x -> (k <= j <= range)%Z -> (e <= f)%Z -> (b <= c)%Z ->
  bounded width j f c a x.
Proof.
  intros width k e b a x j f c (N & F & C & E & B) J HE HB. split; [exact N|]. split; [now apply fits_le with k|]. split; [exact C|]. lia.
Qed.

(* How far the true number is from the value. *)
Lemma bounded_is_near : forall width k e b a x, bounded width k e b a x -> (least <= e <= range)%Z ->
  Rabs (x - value width a) <= bpow radix2 e.
Proof.
  intros width k e b a x (_ & _ & C & E & _) He. destruct C as [C|C]; [numbers; lia|]. apply Rle_trans with (1 := C).
  rewrite <- (size_some e) by lia. now apply size_le.
Qed.

(* ---- Exponents ---- *)

Lemma sum_exponent : forall width a b, (0 < width)%Z -> normal width a -> normal width b ->
  (exponent (add width a b) <= Z.max 0 (Z.max (exponent a) (exponent b) + 1))%Z.
Proof.
  assert (H : forall width a b, (0 < width)%Z -> normal width a -> normal width b -> (exponent (add_smaller width a b) <=
    Z.max 0 (exponent a + 1))%Z).
  { intros width a b W Na Nb. pose proof (normal_digits _ _ W Na) as [A0 A1]. pose proof (normal_digits _ _ W Nb) as [B0 _].
    unfold add_smaller. cbn [exponent with_error]. set (shifted := (digits b / 2 ^ (exponent a - exponent b))%Z).
    assert (S : (0 <= shifted)%Z).
    { unfold shifted. destruct (Z.le_gt_cases 0 (exponent a - exponent b)) as [P|P].
      - apply Z.div_pos; [exact B0|now apply power_pos].
      - rewrite Z.pow_neg_r by exact P. now rewrite Zdiv_0_r. }
    destruct (eqb _ _); [unfold add_limbs; destruct (_ <? _)%Z; cbn [exponent]; lia|].
    unfold subtract_limbs, normalised. destruct (is_zero _); cbn [exponent digits]; [lia|].
    assert (L : (Z.log2 (digits a - shifted) <= width - 1)%Z); [|lia].
    destruct (Z.le_gt_cases (digits a - shifted) 0) as [P|P]; [rewrite Z.log2_nonpos by exact P; lia|].
    assert (Z.log2 (digits a - shifted) < width)%Z; [|lia]. apply Z.log2_lt_pow2; [exact P|lia]. }
  intros width a b W Na Nb. unfold add. destruct (is_zero a); [cbn [exponent with_error]; lia|].
  destruct (is_zero b); [cbn [exponent with_error]; lia|].
  destruct (is_larger a b); [pose proof (H width a b W Na Nb)|pose proof (H width b a W Nb Na)]; lia.
Qed.

Lemma product_exponent : forall width a b, (exponent (multiply width a b) <= Z.max 0 (exponent a + exponent b))%Z.
Proof.
  intros width a b. unfold multiply. destruct (is_zero a || is_zero b); cbn [exponent with_error zero]; [lia|]. destruct (_ <? _)%Z; lia.
Qed.

Lemma zero_of_product : forall width a b, (64 <= width)%Z -> normal width a -> normal width b -> is_zero (multiply width a b) = true ->
  exponent (multiply width a b) = 0%Z.
Proof.
  intros width a b W Na Nb Z. destruct (is_zero a || is_zero b) eqn:Zab.
  - unfold multiply. rewrite Zab. reflexivity.
  - exfalso. apply orb_false_iff in Zab. destruct Zab as [Za Zb]. pose proof (product_rounds width a b ltac:(lia) Na Nb) as P.
    pose proof (value_above width a ltac:(lia) Na Za) as A. pose proof (value_above width b ltac:(lia) Nb Zb) as B.
    pose proof (bpow_gt_0 radix2 (exponent a - 1)). pose proof (bpow_gt_0 radix2 (exponent b - 1)).
    assert (V : 0 < Rabs (value width a * value width b)) by (rewrite Rabs_mult; apply Rmult_lt_0_compat; lra).
    assert (E : bpow radix2 (4 - width) * Rabs (value width a * value width b) <= / 2 * Rabs (value width a * value width b)).
    { apply Rmult_le_compat_r; [lra|]. change (/ 2) with (bpow radix2 (-1)). apply bpow_le. lia. }
    rewrite (value_of_zero _ _ Z) in P. replace (0 - value width a * value width b) with (- (value width a * value width b)) in P by ring.
    rewrite Rabs_Ropp in P. lra.
Qed.

(* ---- Operations ---- *)

Lemma bounded_exactly : forall width v a b, (53 <= width)%Z -> is64 v a -> Rabs a <= bpow radix2 b -> (0 <= b)%Z ->
  bounded width 1074 none (b + 1) (exactly width v) a.
Proof.
  intros width v a b W I B Hb. destruct (big_exactly_contains width v W) as (C & N & F). rewrite (proj1 I) in C.
  split; [exact N|]. split; [exact F|]. split; [exact C|]. split; [destruct v; cbn [exactly error zero]; lia|].
  destruct (is_zero (exactly width v)) eqn:Z; [|now apply (exactly_exponent width v a)].
  destruct v as [s|s|s p q|s m e H]; try (cbn [exactly exponent zero]; lia). exfalso.
  apply Z.eqb_eq in Z. cbn [exactly digits] in Z. pose proof (Z.log2_nonneg (Zpos m)). destruct (significand_bits m e H) as [S _].
  pose proof (power_pos (width - (Z.log2 (Zpos m) + 1)) ltac:(lia)). nia.
Qed.

Lemma bounded_negated : forall width k e b a x, bounded width k e b a x -> bounded width k e b (negated a) (- x).
Proof.
  intros width k e b a x (N & F & C & E & B). split; [exact N|]. split; [exact F|]. split; [now apply big_negated_contains|]. now split.
Qed.

Lemma bounded_add : forall width k e b a c x y, (0 < width)%Z -> (k + width + 3 <= range)%Z -> (none <= e)%Z -> (0 <= b)%Z ->
  bounded width k e b a x -> bounded width k e b c y ->
  bounded width (k + width + 3) (Z.max e (b - width + 1) + 2) (b + 1) (add width a c) (x + y).
Proof.
  intros width k e b a c x y W Hr He Hb (Na & Fa & Ca & Ea & Ba) (Nc & Fc & Cc & Ec & Bc).
  destruct (big_sum_contains width k a c W Hr Na Nc Fa Fc) as (N & F & C). split; [exact N|]. split; [exact F|]. split; [now apply C|].
  split; [|pose proof (sum_exponent width a c W Na Nc); lia].
  destruct (error_of_sum width a c) as [E|E]; [rewrite E; lia|]. destruct (is_zero a || is_zero c); lia.
Qed.

Lemma bounded_subtract : forall width k e b a c x y, (0 < width)%Z -> (k + width + 3 <= range)%Z -> (none <= e)%Z -> (0 <= b)%Z ->
  bounded width k e b a x -> bounded width k e b c y ->
  bounded width (k + width + 3) (Z.max e (b - width + 1) + 2) (b + 1) (subtract width a c) (x - y).
Proof.
  intros width k e b a c x y W Hr He Hb Ha Hc. apply bounded_add; try assumption. now apply bounded_negated.
Qed.

Lemma bounded_multiply : forall width k e b f c a d x y, (0 < width)%Z -> (2 * k + width + 4 <= range)%Z -> (none <= c + e)%Z ->
  (0 <= b + c)%Z -> (e <= b)%Z ->
  bounded width k e b a x -> bounded width k f c d y ->
  bounded width (2 * k + width + 4) (Z.max (Z.max (b + f) (c + e)) (b + c - width + 2) + 2) (b + c) (multiply width a d) (x * y).
Proof.
  intros width k e b f c a d x y W Hr He Hb Hf (Na & Fa & Ca & Ea & Ba) (Nd & Fd & Cd & Ed & Bd).
  destruct (big_product_contains width k a d W Hr Na Nd Fa Fd) as (N & F & C). split; [exact N|]. split; [exact F|]. split; [now apply C|].
  split; [|pose proof (product_exponent width a d); lia].
  assert (P : (propagated_by_product a d <= Z.max (b + f) (c + e))%Z) by (unfold propagated_by_product; lia).
  unfold multiply. destruct (is_zero a || is_zero d).
  - cbn [error with_error].
    destruct (clamp_at_most (if is_exact_zero a || is_exact_zero d then none else propagated_by_product a d + 2)%Z
      (Z.max (Z.max (b + f) (c + e)) (b + c - width + 2) + 2)) as [E|E]; [destruct (_ || _); lia|rewrite E; lia|exact E].
  - cbn [error with_error exponent].
    match goal with |- (clamp ?g <= ?h)%Z => destruct (clamp_at_most g h) as [E|E] end; [|rewrite E; lia|exact E].
    destruct (_ <? _)%Z; destruct (negb _); lia.
Qed.

(* ---- Bounds beside the numbers ---- *)

Lemma bounded_is_tight : forall width k e b m a x, (0 < width)%Z -> (k <= range)%Z -> bounded width k e b a x ->
  bpow radix2 m <= Rabs x -> (least <= e)%Z -> (- range <= e - m <= -3)%Z -> (Z.abs m <= range)%Z -> tight width k (e - m) a x.
Proof.
  intros width k e b m a x W Hk Hb Hm He Ht Hr. pose proof (bounded_is_near width k e b a x Hb ltac:(numbers; lia)) as D.
  destruct Hb as (N & F & C & E & _). pose proof (bpow_gt_0 radix2 (m - 1)) as G.
  assert (D2 : bpow radix2 e <= bpow radix2 (m - 1)) by (apply bpow_le; lia).
  pose proof (bpow_double (m - 1)) as P. replace (m - 1 + 1)%Z with m in P by ring.
  pose proof (Rabs_triang_inv x (x - value width a)) as T. replace (x - (x - value width a)) with (value width a) in T by ring.
  assert (Z : is_zero a = false) by (apply (nonzero_value width); intro V; rewrite V in T, D; rewrite Rabs_R0 in T; lra).
  pose proof (value_below width a W N) as V. assert (L : (m - 1 < exponent a)%Z) by (apply (lt_bpow radix2); lra).
  split; [exact N|]. split; [exact F|]. split; [exact C|]. split; [exact Ht|]. right. split; [exact Z|]. right. lia.
Qed.

Lemma tight_is_bounded : forall width k t b a x, (0 < width)%Z -> (k <= range)%Z -> tight width k t a x -> Rabs x <= bpow radix2 b ->
  x <> 0 \/ (exponent a <= b + 2)%Z -> (none <= b + 2 + t)%Z -> bounded width k (b + 2 + t) (b + 2) a x.
Proof.
  intros width k t b a x W Hk T Bx H0 Hn. pose proof T as (N & F & C & _). split; [exact N|]. split; [exact F|]. split; [exact C|].
  destruct (tight_cases width k t a x W Hk T) as [[X0 X]|(_ & _ & _ & _ & E & P & _)].
  - destruct (exact_zero_parts k a Hk F X0) as [_ E]. destruct H0 as [H0|H0]; [contradiction|]. rewrite E. lia.
  - assert (exponent a - 2 <= b)%Z by (apply (le_bpow radix2); lra). lia.
Qed.

(* The sign, by a separation from 0. *)
Lemma sign_of_bounded : forall width k e b s a x, (0 < width)%Z -> (k <= range)%Z -> bounded width k e b a x ->
  (x <> 0 -> bpow radix2 (- s) <= Rabs x) -> (e < - s - 1)%Z -> (- range <= - s <= range)%Z -> is_sign (sign_of_big a) x.
Proof.
  intros width k e b s a x W Hk (N & F & C & E & _) Sep He Hs. apply (big_sign_is_right width k a x s); try assumption; [|lia].
  destruct (Req_dec x 0) as [X|X]; [now left|right; now apply Sep].
Qed.
