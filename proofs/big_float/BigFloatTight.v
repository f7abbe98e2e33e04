(* SPDX-License-Identifier: BSD-3-Clause *)
(* The third stage's numbers with bounds that are small beside them, or exactly 0: what a law's third stage is made of.
   fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients BigFloatNarrow.
From Forceshade Require Import BigFloatNarrowQuotient BigFloatNarrowRoot BigFloatNewton BigFloatNewtonStart BigFloatNewtonLoop
  BigFloatRight.
Open Scope R_scope.

(* The number holds x, and its bound is at most 2^t times it. *)
Definition tight (width k t : Z) (a : big) (x : R) : Prop :=
  normal width a /\ fits k a /\ contains width a x /\ (- range <= t <= -3)%Z /\
  (is_exact_zero a = true \/ is_zero a = false /\ (error a = none \/ (error a - exponent a <= t)%Z)).

Lemma tight_more : forall width k t a x j u, tight width k t a x -> (k <= j <= range)%Z -> (t <= u <= -3)%Z -> tight width j u a x.
Proof.
  intros width k t a x j u (N & F & C & T & S) J U. split; [exact N|]. split; [now apply fits_le with k|]. split; [exact C|]. split; [lia|].
  destruct S as [S|[S1 S2]]; [now left|right]. split; [exact S1|]. destruct S2; [now left|right; lia].
Qed.

Lemma exact_zero_parts : forall k a, (k <= range)%Z -> fits k a -> is_exact_zero a = true -> is_zero a = true /\ error a = none.
Proof.
  intros k a K [_ F] H. apply andb_prop in H. destruct H as [Z E]. split; [exact Z|]. apply Z.ltb_lt in E. numbers. lia.
Qed.

(* What is tight is 0 exactly, or surely not 0. *)
Lemma tight_cases : forall width k t a x, (0 < width)%Z -> (k <= range)%Z -> tight width k t a x ->
  (is_exact_zero a = true /\ x = 0) \/
  (is_exact_zero a = false /\ is_zero a = false /\ may_be_zero a = false /\ x <> 0 /\ (error a <= exponent a + t)%Z /\
    bpow radix2 (exponent a - 2) <= Rabs x /\ is_sign (if negative a then Lt else Gt) x).
Proof.
  intros width k t a x W K (N & F & C & T & S). destruct (is_exact_zero a) eqn:X.
  { left. split; [reflexivity|]. exact (exact_zero_is width k a x F K X C). }
  destruct S as [S|[Z S]]; [discriminate|right]. split; [reflexivity|]. split; [exact Z|].
  assert (M : may_be_zero a = false).
  { unfold may_be_zero. rewrite Z. cbn [orb]. apply Z.ltb_ge. destruct S as [S|S]; [|lia]. rewrite S. destruct F. numbers. lia. }
  split; [exact M|]. destruct (surely_not_zero width k a x W K N F C M) as (_ & A & D & Sx).
  assert (P : bpow radix2 (exponent a - 2) <= Rabs x).
  { pose proof (Rabs_triang_inv (value width a) (value width a - x)) as R.
    replace (value width a - (value width a - x)) with x in R by ring.
    rewrite (Rabs_minus_sym (value width a) x) in R. pose proof (bpow_double (exponent a - 2)) as B.
    replace (exponent a - 2 + 1)%Z with (exponent a - 1)%Z in B by ring. lra. }
  split; [intro X0; rewrite X0, Rabs_R0 in P; pose proof (bpow_gt_0 radix2 (exponent a - 2)); lra|].
  split; [|now split]. destruct S as [S|S]; [|lia]. rewrite S. destruct F. numbers. lia.
Qed.

(* What is 0 exactly. *)
Lemma tight_zero : forall width k t a x, (0 <= k)%Z -> (- range <= t <= -3)%Z -> a = with_error zero none -> x = 0 -> tight width k t a x.
Proof.
  intros width k t a x K T -> ->. split; [now left|]. split; [split; [cbn [exponent with_error zero]; lia|now left]|].
  split; [apply zero_contains; right; rewrite Rabs_R0; apply size_pos|]. split; [exact T|now left].
Qed.

Lemma tight_exactly : forall width t v a, (53 <= width)%Z -> (- range <= t <= -3)%Z -> is64 v a -> tight width 1074 t (exactly width v) a.
Proof.
  intros width t v a W T [<- _]. destruct (big_exactly_contains width v W) as (C & N & F). split; [exact N|]. split; [exact F|].
  split; [exact C|]. split; [exact T|]. destruct v as [s|s|s p q|s m e H]; try (now left). right. split; [|now left].
  unfold is_zero. cbn [exactly digits]. apply Z.eqb_neq. pose proof (Z.log2_nonneg (Zpos m)). destruct (significand_bits m e H) as [B _].
  pose proof (power_pos (width - (Z.log2 (Zpos m) + 1)) ltac:(lia)). nia.
Qed.

Lemma tight_negated : forall width k t a x, tight width k t a x -> tight width k t (negated a) (- x).
Proof.
  intros width k t a x (N & F & C & T & S). split; [exact N|]. split; [exact F|]. split; [now apply big_negated_contains|]. now split.
Qed.

Lemma nonzero_value : forall width a, value width a <> 0 -> is_zero a = false.
Proof. intros width a H. destruct (is_zero a) eqn:Z; [destruct H; now apply value_of_zero|reflexivity]. Qed.

Lemma tight_multiply : forall width k t u a b x y, (64 <= width)%Z -> (2 * k + width + 4 <= range)%Z -> (t <= -6)%Z -> (u <= -6)%Z ->
  tight width k t a x -> tight width k u b y ->
  tight width (2 * k + width + 4) (Z.max (Z.max t u) (1 - width) + 3) (multiply width a b) (x * y).
Proof.
  intros width k t u a b x y W Hr Ht Hu Ta Tb. pose proof Ta as (Na & Fa & Ca & Bt & _). pose proof Tb as (Nb & Fb & Cb & Bu & _).
  assert (K : (0 <= k)%Z) by (destruct Fa; lia).
  destruct (tight_cases width k t a x ltac:(lia) ltac:(lia) Ta) as [[Xa ->]|(Xa & Za & _ & _ & Ea & _)].
  { apply tight_zero; [lia|numbers; lia| |ring]. unfold multiply. rewrite Xa. apply andb_prop in Xa. destruct Xa as [Z _]. now rewrite Z. }
  destruct (tight_cases width k u b y ltac:(lia) ltac:(lia) Tb) as [[Xb ->]|(Xb & Zb & _ & _ & Eb & _)].
  { apply tight_zero; [lia|numbers; lia| |ring]. unfold multiply. rewrite Xb, orb_true_r. apply andb_prop in Xb. destruct Xb as [Z _].
    now rewrite Z, orb_true_r. }
  destruct (big_product_contains width k a b ltac:(lia) Hr Na Nb Fa Fb) as (N & F & C). split; [exact N|]. split; [exact F|].
  split; [now apply C|]. split; [numbers; lia|]. right. split.
  - apply (nonzero_value width). pose proof (product_rounds width a b ltac:(lia) Na Nb) as P.
    pose proof (value_above width a ltac:(lia) Na Za) as A. pose proof (value_above width b ltac:(lia) Nb Zb) as B.
    pose proof (bpow_gt_0 radix2 (exponent a - 1)). pose proof (bpow_gt_0 radix2 (exponent b - 1)).
    assert (V : 0 < Rabs (value width a * value width b)) by (rewrite Rabs_mult; apply Rmult_lt_0_compat; lra).
    assert (E : bpow radix2 (4 - width) * Rabs (value width a * value width b) <= / 2 * Rabs (value width a * value width b)).
    { apply Rmult_le_compat_r; [lra|]. change (/ 2) with (bpow radix2 (-1)). apply bpow_le. lia. }
    intro V0. rewrite V0 in P. replace (0 - value width a * value width b) with (- (value width a * value width b)) in P by ring.
    rewrite Rabs_Ropp in P. lra.
  - destruct (big_product_is_narrow width a b Za Zb ltac:(lia) ltac:(lia)) as [B|B]; [destruct Fa; lia|destruct Fb; lia|now left|right].
    apply Z.le_trans with (1 := B). lia.
Qed.

Lemma tight_divide : forall width k t u a b x y, (128 <= width)%Z -> (60 * (k + width + 1110) <= range)%Z -> (t <= -10)%Z -> (u <= -10)%Z ->
  tight width k t a x -> tight width k u b y -> y <> 0 ->
  tight width (60 * (k + width + 1110)) (Z.max (Z.max t u + 6) (14 - width)) (divide_newton width a b) (x / y).
Proof.
  intros width k t u a b x y W Hr Ht Hu Ta Tb Y. pose proof Ta as (Na & Fa & Ca & Bt & _). pose proof Tb as (Nb & Fb & Cb & Bu & _).
  assert (K : (0 <= k)%Z) by (destruct Fa; lia).
  destruct (tight_cases width k u b y ltac:(lia) ltac:(lia) Tb) as [[Xb Y0]|(Xb & Zb & Mb & _ & Eb & _)]; [easy|].
  destruct (tight_cases width k t a x ltac:(lia) ltac:(lia) Ta) as [[Xa ->]|(Xa & Za & _ & _ & Ea & _)].
  { apply tight_zero; [lia|numbers; lia| |unfold Rdiv; ring]. unfold divide_newton, divide. rewrite Mb, Xa. apply andb_prop in Xa.
    destruct Xa as [Z _]. now rewrite Z. }
  destruct (big_quotient_is_right width k a b W Hr Na Nb Fa Fb) as (N & F & C & S). destruct (S Za Mb) as (Zr & _ & B).
  split; [exact N|]. split; [exact F|]. split; [now apply C|]. split; [numbers; lia|]. right. split; [exact Zr|].
  destruct B as [B|B]; [now left|right]. apply Z.le_trans with (1 := B). lia.
Qed.

Lemma tight_root : forall width k t a x, (128 <= width)%Z -> (60 * (k + width + 1110) <= range)%Z -> (t <= -10)%Z ->
  tight width k t a x -> 0 <= x ->
  tight width (60 * (k + width + 1110)) (Z.max (t + 4) (13 - width)) (square_root_newton width a) (sqrt x).
Proof.
  intros width k t a x W Hr Ht Ta X. pose proof Ta as (Na & Fa & Ca & Bt & _). assert (K : (0 <= k)%Z) by (destruct Fa; lia).
  destruct (tight_cases width k t a x ltac:(lia) ltac:(lia) Ta) as [[Xa ->]|(Xa & Za & Ma & X0 & Ea & _ & Sx)].
  { assert (E : square_root_newton width a = a) by (unfold square_root_newton, square_root; now rewrite Xa). rewrite E, sqrt_0.
    split; [exact Na|]. split; [apply fits_le with (2 := Fa); lia|]. split; [exact Ca|]. split; [numbers; lia|now left]. }
  assert (Sa : negative a = false) by (destruct (negative a); [cbn [is_sign] in Sx; lra|reflexivity]).
  assert (Hb : (error a < boundless)%Z) by (destruct Fa; numbers; lia).
  destruct (big_root_is_right width k a W Hr Na Fa Hb) as (N & F & C & S). destruct (S Ma Sa) as (Zr & _ & B).
  split; [exact N|]. split; [exact F|]. split; [now apply C|]. split; [numbers; lia|]. right. split; [exact Zr|].
  destruct B as [B|B]; [now left|right]. apply Z.le_trans with (1 := B). lia.
Qed.

(* A sum may cancel, but not so far that its bound becomes as large as it is: m bits below the larger operand. *)
Lemma tight_sum : forall width k t u m a b x y, (64 <= width)%Z -> (k + width + 3 <= range)%Z ->
  tight width k t a x -> tight width k u b y -> (0 <= m)%Z -> (Z.max (Z.max t u) (1 - width) + m + 3 <= -3)%Z ->
  is_exact_zero a = false -> is_exact_zero b = false -> bpow radix2 (Z.max (exponent a) (exponent b) - m) <= Rabs (x + y) ->
  tight width (k + width + 3) (Z.max (Z.max t u) (1 - width) + m + 3) (add width a b) (x + y).
Proof.
  intros width k t u m a b x y W Hr Ta Tb M T Xa Xb S. pose proof Ta as (Na & Fa & Ca & Bt & _). pose proof Tb as (Nb & Fb & Cb & Bu & _).
  assert (K : (0 <= k)%Z) by (destruct Fa; lia).
  destruct (tight_cases width k t a x ltac:(lia) ltac:(lia) Ta) as [[Xa' _]|(_ & Za & _ & _ & Ea & _)]; [congruence|].
  destruct (tight_cases width k u b y ltac:(lia) ltac:(lia) Tb) as [[Xb' _]|(_ & Zb & _ & _ & Eb & _)]; [congruence|].
  destruct (big_sum_contains width k a b ltac:(lia) Hr Na Nb Fa Fb) as (N & F & C). specialize (C x y Ca Cb).
  pose proof (big_sum_is_narrow width a b Za Zb) as B. cbv zeta in B. set (r := add width a b) in *.
  set (e := Z.max (exponent a) (exponent b)) in *. set (w := (Z.max (Z.max t u) (1 - width) + 2)%Z).
  assert (Be : (- k <= e <= k)%Z) by (destruct Fa as [Fa _], Fb as [Fb _]; unfold e; lia).
  assert (B' : error r = none \/ (error r <= e + w)%Z).
  { destruct B as [B|B]; [now left|right]. apply Z.le_trans with (1 := B). unfold w, e in *. numbers. lia. }
  assert (D : Rabs (x + y - value width r) <= bpow radix2 (e + w)).
  { destruct C as [C|C]; [destruct B' as [B'|B']; unfold w in *; numbers; lia|]. apply Rle_trans with (1 := C).
    rewrite <- (size_some (e + w)) by (unfold w; numbers; lia). apply size_le. destruct B' as [B'|B']; [|exact B'].
    rewrite B'. unfold w. numbers. lia. }
  assert (P : bpow radix2 (e + w) <= bpow radix2 (e - m - 1 - 1)) by (apply bpow_le; unfold w; lia).
  pose proof (bpow_double (e - m - 1)) as D1. pose proof (bpow_double (e - m - 1 - 1)) as D2.
  replace (e - m - 1 + 1)%Z with (e - m)%Z in D1 by ring. replace (e - m - 1 - 1 + 1)%Z with (e - m - 1)%Z in D2 by ring.
  pose proof (bpow_gt_0 radix2 (e - m - 1 - 1)) as G. pose proof (Rabs_triang_inv (x + y) (x + y - value width r)) as R.
  replace (x + y - (x + y - value width r)) with (value width r) in R by ring.
  assert (Zr : is_zero r = false) by (apply (nonzero_value width); intro V; rewrite V, Rabs_R0 in R; rewrite V in D; lra).
  pose proof (value_below width r ltac:(lia) N) as V. assert (L : (e - m - 1 < exponent r)%Z) by (apply (lt_bpow radix2); lra).
  split; [exact N|]. split; [exact F|]. split; [exact C|]. split; [unfold w; numbers; lia|]. right. split; [exact Zr|].
  destruct B' as [B'|B']; [now left|right]. unfold w in B'. lia.
Qed.
