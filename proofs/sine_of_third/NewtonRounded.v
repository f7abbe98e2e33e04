(* SPDX-License-Identifier: BSD-3-Clause *)
(* What rounding does to Newton's method in binary64: sine_of_third of fast/laws/bump_geometry.h up to the number that double-double
   starts from. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs ErrorFree Gap DoubleDouble Depth.
From Forceshade Require Import DoubleDoubleNear ThreePolygonsFace NewtonStart.
Open Scope R_scope.

Definition whole (n : Z) : binary64 := constant n 0.

Lemma whole_is : forall n, (Z.abs n < 2 ^ 53)%Z -> is64 (whole n) (IZR n).
Proof. intros n H. rewrite <- (Rmult_1_r (IZR n)). change 1 with (bpow radix2 0). apply constant_is; [exact H|lia]. Qed.

(* t -= ((4 t t - 3) t + s) / (12 t t - 3) *)
Definition third_step (s t : binary64) : binary64 :=
  minus t (over (plus (times (minus (times (times (whole 4) t) t) (whole 3)) t) s)
    (minus (times (times (whole 12) t) t) (whole 3))).
(* u -= ((6 - 4 u) u u - rest) / (12 u (1 - u)) *)
Definition rest_step (rest u : binary64) : binary64 :=
  minus u (over (minus (times (times (minus (whole 6) (times (whole 4) u)) u) u) rest)
    (times (times (whole 12) u) (minus (whole 1) u))).

(* v is a number that is at most e off A. *)
Definition off (v : binary64) (A e : R) : Prop := exists a, is64 v a /\ Rabs (a - A) <= e.

Lemma off_exactly : forall v a, is64 v a -> off v a 0.
Proof. intros v a H. exists a. split; [exact H|]. rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. lra. Qed.

(* One rounding more: a is e off A, which is no larger than m. *)
Lemma off_rounded : forall a A e m e', Rabs (a - A) <= e -> Rabs A <= m -> 1000001 / 1000000 * e + unit53 * m + tiny <= e' ->
  Rabs (nearest64 a - A) <= e'.
Proof.
  intros a A e m e' H Hm He. pose proof (product_is_close a) as C. pose proof unit_is_small as Hu.
  replace (nearest64 a - A) with ((nearest64 a - a) + (a - A)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
  assert (Rabs a <= m + e).
  { replace a with ((a - A) + A) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  assert (unit53 * Rabs a <= unit53 * (m + e)) by (apply Rmult_le_compat_l; lra).
  assert (unit53 * e <= / 1000000 * e); [|lra]. apply Rmult_le_compat_r; [|lra]. pose proof (Rabs_pos (a - A)). lra.
Qed.

Lemma off_is_small : forall a A e m, Rabs (a - A) <= e -> Rabs A <= m -> m <= 1000000 -> e <= 1000000 -> not_too_large a.
Proof. intros a A e m H Hm Hm2 He. apply big_enough. absolute_values. apply Rabs_le. lra. Qed.

Lemma off_plus : forall v w A B e f m e', off v A e -> off w B f -> Rabs (A + B) <= m -> m <= 1000000 -> e + f <= 1000000 ->
  1000001 / 1000000 * (e + f) + unit53 * m + tiny <= e' -> off (plus v w) (A + B) e'.
Proof.
  intros v w A B e f m e' (a & Ia & Ha) (b & Ib & Hb) Hm Hm2 Hef He.
  assert (H : Rabs (a + b - (A + B)) <= e + f) by (absolute_values; apply Rabs_le; lra).
  exists (nearest64 (a + b)). split; [|now apply off_rounded with (e + f) m].
  apply plus_is; try assumption. now apply off_is_small with (A + B) (e + f) m.
Qed.

Lemma off_minus : forall v w A B e f m e', off v A e -> off w B f -> Rabs (A - B) <= m -> m <= 1000000 -> e + f <= 1000000 ->
  1000001 / 1000000 * (e + f) + unit53 * m + tiny <= e' -> off (minus v w) (A - B) e'.
Proof.
  intros v w A B e f m e' (a & Ia & Ha) (b & Ib & Hb) Hm Hm2 Hef He.
  assert (H : Rabs (a - b - (A - B)) <= e + f) by (absolute_values; apply Rabs_le; lra).
  exists (nearest64 (a - b)). split; [|now apply off_rounded with (e + f) m].
  apply minus_is; try assumption. now apply off_is_small with (A - B) (e + f) m.
Qed.

(* The second factor is no larger than b, the first off by e, and no larger than c. *)
Lemma off_times : forall v w A B e f b c m e', off v A e -> off w B f -> Rabs A <= c -> Rabs B <= b -> Rabs (A * B) <= m ->
  m <= 1000000 -> f <= / 1000000 * b -> e * b * (1000001 / 1000000) + c * f <= 900000 ->
  1000001 / 1000000 * (e * b * (1000001 / 1000000) + c * f) + unit53 * m + tiny <= e' -> off (times v w) (A * B) e'.
Proof.
  intros v w A B e f b c m e' (x & Ix & Hx) (y & Iy & Hy) Hc Hb Hm Hm2 Hf Hef He.
  assert (H : Rabs (x * y - A * B) <= e * b * (1000001 / 1000000) + c * f).
  { replace (x * y - A * B) with ((x - A) * y + A * (y - B)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    rewrite !Rabs_mult. assert (Rabs y <= b * (1000001 / 1000000)).
    { replace y with ((y - B) + B) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    assert (Rabs (x - A) * Rabs y <= e * (b * (1000001 / 1000000))) by (apply Rmult_le_compat; try apply Rabs_pos; assumption).
    assert (Rabs A * Rabs (y - B) <= c * f) by (apply Rmult_le_compat; try apply Rabs_pos; assumption). lra. }
  exists (nearest64 (x * y)). split; [|apply (off_rounded _ _ _ m _ H); assumption].
  apply times_is; try assumption. apply (off_is_small _ _ _ m H); lra.
Qed.

(* The quotient is no larger than q, the divisor no smaller than d. *)
Lemma off_over : forall v w F D e g d q e', off v F e -> off w D g -> 0 < d -> d <= Rabs D - g -> Rabs (F / D) <= q -> q <= 1000000 ->
  1000001 / 1000000 * (e + q * g) + unit53 * (q * d) + tiny * d <= e' * d -> e' <= 1000000 -> off (over v w) (F / D) e'.
Proof.
  intros v w F D e g d q e' (a & Ia & Ha) (b & Ib & Hb) Hd Hdb Hq Hq2 He He2.
  assert (Bb : d <= Rabs b).
  { pose proof (Rabs_triang (D - b) b) as T. replace (D - b + b) with D in T by ring. rewrite Rabs_minus_sym in Hb. lra. }
  assert (Hb0 : b <> 0) by (intros ->; rewrite Rabs_R0 in Bb; lra).
  assert (HD0 : D <> 0). { intros ->. rewrite Rabs_R0 in Hdb. pose proof (Rabs_pos (b - 0)). lra. }
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny. pose proof (Rabs_pos (F / D)) as PQ.
  set (E := (e + q * g) / d). assert (HE : E * d = e + q * g) by (unfold E; field; lra).
  assert (H : Rabs (a / b - F / D) <= E).
  { apply Rmult_le_reg_r with d; [exact Hd|]. rewrite HE.
    apply Rle_trans with (Rabs (a / b - F / D) * Rabs b); [apply Rmult_le_compat_l; [apply Rabs_pos|exact Bb]|].
    rewrite <- Rabs_mult. replace ((a / b - F / D) * b) with ((a - F) + F / D * (D - b)) by (field; split; assumption).
    apply Rle_trans with (1 := Rabs_triang _ _). rewrite (Rabs_mult (F / D)), (Rabs_minus_sym D).
    assert (Rabs (F / D) * Rabs (b - D) <= q * g) by (apply Rmult_le_compat; try apply Rabs_pos; assumption). lra. }
  assert (B : 1000001 / 1000000 * E + unit53 * q + tiny <= e').
  { apply Rmult_le_reg_r with d; [exact Hd|].
    replace ((1000001 / 1000000 * E + unit53 * q + tiny) * d) with (1000001 / 1000000 * (E * d) + unit53 * (q * d) + tiny * d) by ring.
    rewrite HE. exact He. }
  assert (P : 0 <= unit53 * q) by (apply Rmult_le_pos; lra).
  exists (nearest64 (a / b)). split; [|apply (off_rounded _ _ _ q _ H); assumption].
  apply over_is; try assumption. apply (off_is_small _ _ _ q H); lra.
Qed.

Ltac bound := first [lra | apply Rabs_le; lra].

Theorem third_step_is : forall sv tv s0 s t y rho, is64 sv s0 -> is64 tv y -> s <= 5001 / 10000 -> / 60000000 <= t <= / 2 ->
  4 * (t * t * t) - 3 * t + s = 0 -> Rabs (s0 - s) <= 101 / 100 * unit53 * s -> 0 <= rho <= 42 / 1000 -> Rabs (y - t) <= rho * t ->
  exists y', is64 (third_step sv tv) y' /\ Rabs (y' - t) <= (15 / 100 * (rho * rho) + 5 * unit53) * t.
Proof.
  intros sv tv s0 s t y rho Hs0 Hy Hs Ht E Es Hrho Hr. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  pose proof (newton_for_third_converges s t y rho Hs ltac:(lra) E ltac:(lra) Hr) as N.
  pose proof (third_is_small s t Hs ltac:(lra) E) as Hsmall.
  assert (Hrt : 0 <= rho * t <= 42 / 1000 * t) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  pose proof (Rabs_le_inv _ _ Hr) as Hr2. assert (By : 958 / 1000 * t <= y <= 1042 / 1000 * t) by lra.
  assert (Byy : 0 <= y * y <= 1810 / 10000 * (1810 / 10000)) by (split; [apply Rle_0_sqr|apply Rmult_le_compat; lra]).
  assert (Byyy : 0 <= y * y * y <= 4 / 100 * y) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Btt : 0 <= t * t <= 1737 / 10000 * (1737 / 10000)) by (split; [apply Rle_0_sqr|apply Rmult_le_compat; lra]).
  assert (Bs : 0 < s <= 3 * t).
  { assert (0 <= t * t * t) by (apply Rmult_le_pos; lra). assert (t * t * t <= / 4 * t) by (apply Rmult_le_compat_r; lra). lra. }
  assert (Bf : Rabs (4 * (y * y * y) - 3 * y + s) <= 130 / 1000 * t).
  { replace (4 * (y * y * y) - 3 * y + s) with ((y - t) * (4 * (y * y + y * t + t * t) - 3)) by lra. rewrite Rabs_mult.
    assert (0 <= y * t <= 181 / 1000 * (1737 / 10000)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
    apply Rle_trans with (42 / 1000 * t * 3); [|lra]. apply Rmult_le_compat; try apply Rabs_pos; bound. }
  pose proof (Rabs_le_inv _ _ Bf) as Bf2. set (u := unit53) in *. set (U := u * t).
  assert (Ut : u * t = U) by reflexivity.
  assert (BU : 0 < U <= 1737 / 10000 * u).
  { unfold U. split; [apply Rmult_lt_0_compat; lra|]. rewrite (Rmult_comm (1737 / 10000)). apply Rmult_le_compat_l; lra. }
  assert (TU : tiny <= / 10000 * U).
  { apply Rle_trans with (/ 10000 * (u * / 60000000)); [unfold u, unit53; lra|]. apply Rmult_le_compat_l; [lra|].
    apply Rmult_le_compat_l; lra. }
  assert (uy : 0 <= u * y <= 1042 / 1000 * U).
  { unfold U. replace (1042 / 1000 * (u * t)) with (u * (1042 / 1000 * t)) by ring. split; [apply Rmult_le_pos; lra|].
    apply Rmult_le_compat_l; lra. }
  assert (Uy : 0 <= U * y <= 1810 / 10000 * U).
  { split; [apply Rmult_le_pos; lra|]. rewrite (Rmult_comm U). apply Rmult_le_compat_r; lra. }
  assert (us : u * s <= 3 * U) by (unfold U; replace (3 * (u * t)) with (u * (3 * t)) by ring; apply Rmult_le_compat_l; lra).
  unfold third_step.
  pose proof (off_exactly _ _ (whole_is 4 ltac:(lia))) as W4. pose proof (off_exactly _ _ (whole_is 3 ltac:(lia))) as W3.
  pose proof (off_exactly _ _ (whole_is 12 ltac:(lia))) as W12. pose proof (off_exactly _ _ Hy) as Y.
  pose proof (off_times _ _ _ _ _ _ y 4 (4 * y) (42 / 10 * U) W4 Y ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(fold u; lra)) as C1.
  pose proof (off_times _ _ _ _ _ _ y 4 (1312 / 10000) (265 / 1000 * u) C1 Y ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(bound) ltac:(fold u; lra)) as C2.
  pose proof (off_minus _ _ _ _ _ _ 3 (327 / 100 * u) C2 W3 ltac:(bound) ltac:(bound) ltac:(bound) ltac:(fold u; lra)) as C3.
  pose proof (off_times _ _ _ _ _ _ y 3 (3 * y) (654 / 100 * U) C3 Y ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(fold u; lra)) as C4.
  pose proof (off_plus _ _ _ _ _ _ (130 / 1000 * t) (98 / 10 * U) C4 (ex_intro _ s0 (conj Hs0 Es)) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(fold u; lra)) as C5.
  pose proof (off_times _ _ _ _ _ _ y 12 (12 * y) (126 / 10 * U) W12 Y ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(fold u; lra)) as D1.
  pose proof (off_times _ _ _ _ _ _ y 3 (3932 / 10000) (80 / 100 * u) D1 Y ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(bound) ltac:(fold u; lra)) as D2.
  pose proof (off_minus _ _ _ _ _ _ 3 (381 / 100 * u) D2 W3 ltac:(bound) ltac:(bound) ltac:(bound) ltac:(fold u; lra)) as D3.
  set (F := (4 * y * y - 3) * y + s) in *. set (D := 12 * y * y - 3) in *.
  assert (BD : 2606 / 1000 <= - D) by (unfold D; lra).
  assert (BQ : Rabs (F / D) <= / 20 * t).
  { unfold Rdiv. rewrite Rabs_mult, Rabs_inv. rewrite (Rabs_left D) by lra. apply Rmult_le_reg_r with (- D); [lra|].
    rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. apply Rle_trans with (130 / 1000 * t); [unfold F; apply Rabs_le; lra|].
    replace (/ 20 * t * - D) with (/ 20 * t * (- D)) by ring. apply Rle_trans with (/ 20 * t * (2606 / 1000)); [lra|].
    apply Rmult_le_compat_l; lra. }
  assert (BD2 : 26059 / 10000 <= Rabs D - 381 / 100 * u) by (rewrite (Rabs_left D); lra).
  pose proof (off_over _ _ _ _ _ _ (26059 / 10000) (/ 20 * t) (39 / 10 * U) C5 D3 ltac:(lra) BD2 BQ ltac:(lra) ltac:(fold u; lra)
    ltac:(lra)) as C6.
  replace (y - (4 * (y * y * y) - 3 * y + s) / (12 * (y * y) - 3) - t) with (y - F / D - t) in N
    by (unfold F, D; do 2 f_equal; f_equal; ring).
  assert (Hrr : 0 <= rho * rho * t <= 42 / 1000 * (42 / 1000) * t).
  { split; [apply Rmult_le_pos; [apply Rle_0_sqr|lra]|]. apply Rmult_le_compat_r; [lra|apply Rmult_le_compat; lra]. }
  pose proof (Rabs_le_inv _ _ N) as N2.
  destruct (off_minus _ _ _ _ _ _ (101 / 100 * t) (495 / 100 * U) Y C6 ltac:(bound) ltac:(lra) ltac:(lra) ltac:(fold u; lra))
    as (y' & I & C).
  exists y'. split; [exact I|]. absolute_values. unfold U in *. apply Rabs_le. lra.
Qed.

Theorem rest_step_is : forall rv uv r0 r t y rho, is64 rv r0 -> is64 uv y -> r <= 5001 / 10000 -> / 100000000 <= t <= / 2 ->
  6 * (t * t) - 4 * (t * t * t) = r -> Rabs (r0 - r) <= 101 / 100 * unit53 * r -> 0 <= rho <= 97 / 1000 -> Rabs (y - t) <= rho * t ->
  exists y', is64 (rest_step rv uv) y' /\ Rabs (y' - t) <= (56 / 100 * (rho * rho) + 7 * unit53) * t.
Proof.
  intros rv uv r0 r t y rho Hr0 Hy Hr Ht E Er Hrho Hrt. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  pose proof (newton_for_rest_converges r t y rho Hr ltac:(lra) E ltac:(lra) Hrt) as N.
  pose proof (rest_is_small r t Hr ltac:(lra) E) as Hsmall.
  assert (Hrt1 : 0 <= rho * t <= 97 / 1000 * t) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  pose proof (Rabs_le_inv _ _ Hrt) as Hrt2. assert (By : 903 / 1000 * t <= y <= 1097 / 1000 * t) by lra.
  assert (Btt : 0 < t * t) by (apply Rmult_lt_0_compat; lra).
  assert (Bty : 903 / 1000 * (t * t) <= t * y <= 1097 / 1000 * (t * t)).
  { replace (903 / 1000 * (t * t)) with (t * (903 / 1000 * t)) by ring. replace (1097 / 1000 * (t * t)) with (t * (1097 / 1000 * t))
      by ring. split; apply Rmult_le_compat_l; lra. }
  assert (Byy : 815 / 1000 * (t * t) <= y * y <= 1204 / 1000 * (t * t)).
  { split.
    - apply Rle_trans with (903 / 1000 * t * (903 / 1000 * t)); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with (1097 / 1000 * t * (1097 / 1000 * t)); [apply Rmult_le_compat; lra|lra]. }
  assert (Byyy : 0 <= y * y * y <= 36 / 100 * (y * y)).
  { split; [apply Rmult_le_pos; lra|]. rewrite (Rmult_comm (36 / 100)). apply Rmult_le_compat_l; lra. }
  assert (Bt2 : t * t <= 3265 / 10000 * t) by (apply Rmult_le_compat_r; lra).
  assert (Bttt : 0 <= t * t * t <= 3265 / 10000 * (t * t)).
  { split; [apply Rmult_le_pos; lra|]. rewrite (Rmult_comm (3265 / 10000)). apply Rmult_le_compat_l; lra. }
  assert (Bf : Rabs (6 * (y * y) - 4 * (y * y * y) - r) <= 123 / 100 * (t * t)).
  { replace (6 * (y * y) - 4 * (y * y * y) - r) with ((y - t) * (6 * (y + t) - 4 * (y * y + t * y + t * t))) by (rewrite <- E; ring).
    rewrite Rabs_mult. apply Rle_trans with (97 / 1000 * t * (6 * (2097 / 1000 * t))); [|lra].
    apply Rmult_le_compat; try apply Rabs_pos; bound. }
  pose proof (Rabs_le_inv _ _ Bf) as Bf2. set (u := unit53) in *. set (U := u * t).
  assert (Ut : u * t = U) by reflexivity.
  assert (BU : 0 < U <= 3265 / 10000 * u).
  { unfold U. split; [apply Rmult_lt_0_compat; lra|]. rewrite (Rmult_comm (3265 / 10000)). apply Rmult_le_compat_l; lra. }
  set (V := U * t).
  assert (UV : U * t = V) by reflexivity.
  assert (BV : 0 < V <= 3265 / 10000 * U).
  { unfold V. split; [apply Rmult_lt_0_compat; lra|]. rewrite (Rmult_comm (3265 / 10000)). apply Rmult_le_compat_l; lra. }
  assert (TV : tiny <= / 10000 * V).
  { apply Rle_trans with (/ 10000 * (u * / 100000000 * / 100000000)); [unfold u, unit53; lra|]. apply Rmult_le_compat_l; [lra|].
    unfold V, U. apply Rmult_le_compat; try lra. apply Rmult_le_compat_l; lra. }
  assert (uy : 0 <= u * y <= 1097 / 1000 * U).
  { unfold U. replace (1097 / 1000 * (u * t)) with (u * (1097 / 1000 * t)) by ring. split; [apply Rmult_le_pos; lra|].
    apply Rmult_le_compat_l; lra. }
  assert (Uy : 0 <= U * y <= 1097 / 1000 * V).
  { unfold V. replace (1097 / 1000 * (U * t)) with (U * (1097 / 1000 * t)) by ring. split; [apply Rmult_le_pos; lra|].
    apply Rmult_le_compat_l; lra. }
  assert (utt : u * (t * t) = V) by (unfold V, U; ring).
  assert (uyy : u * (y * y) <= 1204 / 1000 * V).
  { rewrite <- utt. replace (1204 / 1000 * (u * (t * t))) with (u * (1204 / 1000 * (t * t))) by ring. apply Rmult_le_compat_l; lra. }
  assert (ur : u * r <= 6 * V).
  { rewrite <- utt. replace (6 * (u * (t * t))) with (u * (6 * (t * t))) by ring. apply Rmult_le_compat_l; lra. }
  unfold rest_step.
  pose proof (off_exactly _ _ (whole_is 4 ltac:(lia))) as W4. pose proof (off_exactly _ _ (whole_is 6 ltac:(lia))) as W6.
  pose proof (off_exactly _ _ (whole_is 1 ltac:(lia))) as W1.
  pose proof (off_exactly _ _ (whole_is 12 ltac:(lia))) as W12. pose proof (off_exactly _ _ Hy) as Y.
  pose proof (off_times _ _ _ _ _ _ y 4 (4 * y) (44 / 10 * U) W4 Y ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(fold u; lra)) as C1.
  pose proof (off_minus _ _ _ _ _ _ 6 (745 / 100 * u) W6 C1 ltac:(bound) ltac:(bound) ltac:(bound) ltac:(fold u; lra)) as C2.
  pose proof (off_times _ _ _ _ _ _ y 6 (6 * y) (1477 / 100 * U) C2 Y ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(bound) ltac:(fold u; lra)) as C3.
  pose proof (off_times _ _ _ _ _ _ y (6 * y) (6 * (y * y)) (2344 / 100 * V) C3 Y ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(bound) ltac:(fold u; lra)) as C4.
  pose proof (off_minus _ _ _ _ _ _ (123 / 100 * (t * t)) (308 / 10 * V) C4 (ex_intro _ r0 (conj Hr0 Er)) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(fold u; lra)) as C5.
  pose proof (off_times _ _ _ _ _ _ y 12 (12 * y) (1318 / 100 * U) W12 Y ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(bound) ltac:(fold u; lra)) as D1.
  pose proof (off_minus _ _ _ _ _ _ 1 (1001 / 1000 * u) W1 Y ltac:(bound) ltac:(bound) ltac:(bound) ltac:(fold u; lra)) as D2.
  pose proof (off_times _ _ _ _ _ _ 1 (12 * y) (12 * y) (398 / 10 * U) D1 D2 ltac:(bound) ltac:(bound) ltac:(bound) ltac:(bound)
    ltac:(bound) ltac:(bound) ltac:(fold u; lra)) as D3.
  replace (6 * (y * y) - 4 * (y * y * y) - r) with ((6 - 4 * y) * y * y - r) in N by ring.
  set (F := (6 - 4 * y) * y * y - r) in *. set (D := 12 * y * (1 - y)) in *.
  assert (BD : 6954 / 1000 * t <= D).
  { unfold D. apply Rle_trans with (12 * (903 / 1000 * t) * (6418 / 10000)); [lra|]. apply Rmult_le_compat; lra. }
  assert (BQ : Rabs (F / D) <= 177 / 1000 * t).
  { unfold Rdiv. rewrite Rabs_mult, Rabs_inv. rewrite (Rabs_pos_eq D) by lra. apply Rmult_le_reg_r with D; [lra|].
    rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. apply Rle_trans with (123 / 100 * (t * t)); [unfold F; apply Rabs_le; lra|].
    apply Rle_trans with (177 / 1000 * t * (6954 / 1000 * t)); [lra|]. apply Rmult_le_compat_l; lra. }
  assert (BD2 : 6953 / 1000 * t <= Rabs D - 398 / 10 * U).
  { rewrite (Rabs_pos_eq D) by lra. assert (U <= / 1000000000000 * t) by (unfold U; apply Rmult_le_compat_r; lra). lra. }
  assert (Tt : tiny * t <= tiny) by (rewrite <- (Rmult_1_r tiny) at 2; apply Rmult_le_compat_l; lra).
  pose proof (off_over _ _ _ _ _ _ (6953 / 1000 * t) (177 / 1000 * t) (563 / 100 * U) C5 D3 ltac:(lra) BD2 BQ ltac:(lra)
    ltac:(fold u; lra) ltac:(lra)) as C6.
  assert (Hrr : 0 <= rho * rho * t <= 97 / 1000 * (97 / 1000) * t).
  { split; [apply Rmult_le_pos; [apply Rle_0_sqr|lra]|]. apply Rmult_le_compat_r; [lra|apply Rmult_le_compat; lra]. }
  pose proof (Rabs_le_inv _ _ N) as N2.
  destruct (off_minus _ _ _ _ _ _ (101 / 100 * t) (67 / 10 * U) Y C6 ltac:(bound) ltac:(lra) ltac:(lra) ltac:(fold u; lra))
    as (y' & I & C).
  exists y'. split; [exact I|]. absolute_values. unfold U in *. apply Rabs_le. lra.
Qed.

(* ---- All steps ---- *)

Definition half_over_radius (R w : binary32) : binary64 := over (half_width w) (to64 R).
Definition rest_over_radius (R w : binary32) : binary64 := over (minus (to64 R) (half_width w)) (to64 R).
Definition third_start (R w : binary32) : binary64 :=
  let s := half_over_radius R w in
  third_step s (third_step s (third_step s (third_step s (over s (whole 3))))).
Definition rest_start (R w : binary32) : binary64 :=
  let r := rest_over_radius R w in
  rest_step r (rest_step r (rest_step r (rest_step r (rest_step r (square_root (over r (whole 5))))))).

Lemma third_sine_of_half : forall R w K, parameters R w K -> let s := value32 w / 2 / value32 R in let t :=
  third_sine (value32 R) (value32 w) in
  / 60000000 <= t <= / 2 /\ 4 * (t * t * t) - 3 * t + s = 0 /\ / 20000000 <= s <= 1.
Proof.
  intros R w K (_ & HR & Hw & _) s t. destruct (third_sine_is (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as ((H1 & H2) & E & _).
  fold t in H1, H2, E. replace (value32 w / (2 * value32 R)) with s in E by (unfold s; field; lra).
  assert (Bs : / 20000000 <= s <= 1).
  { unfold s. split; apply Rmult_le_reg_r with (value32 R); try lra; replace (value32 w / 2 / value32 R * value32 R) with (value32 w / 2)
      by (field; lra); lra. }
  split; [|split; [exact E|exact Bs]]. split; [|exact H2]. apply Rle_trans with (2 := H1).
  replace (value32 w / (6 * value32 R)) with (s / 3) by (unfold s; field; lra). lra.
Qed.

Lemma half_over_radius_is : forall R w K, parameters R w K -> let s := value32 w / 2 / value32 R in
  is64 (half_over_radius R w) (nearest64 s) /\ Rabs (nearest64 s - s) <= 101 / 100 * unit53 * s.
Proof.
  intros R w K Hp s. destruct (third_sine_of_half R w K Hp) as (_ & _ & Bs). fold s in Bs. pose proof (half_width_is R w K Hp) as Ih.
  destruct Hp as ((FR & _) & HR & _). pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny. split.
  - apply over_is; try assumption; [now apply to64_is_exact|lra|]. fold s. apply big_enough. rewrite Rabs_pos_eq; lra.
  - pose proof (product_is_close s) as C. rewrite (Rabs_pos_eq s) in C by lra.
    assert (tiny <= / 100 * unit53 * s) by (unfold unit53; lra). lra.
Qed.

(* A start good to 2^-50. *)
Theorem third_start_is : forall R w K, parameters R w K -> value32 w / 2 / value32 R <= 5001 / 10000 ->
  let t := third_sine (value32 R) (value32 w) in
  exists y, is64 (third_start R w) y /\ Rabs (y - t) <= 6 * unit53 * t.
Proof.
  intros R w K Hp Hs t. destruct (third_sine_of_half R w K Hp) as (Ht & E & Bs). fold t in Ht, E.
  destruct (half_over_radius_is R w K Hp) as [I0 C0]. set (s := value32 w / 2 / value32 R) in *. set (s0 := nearest64 s) in *.
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  pose proof (newton_for_third_starts s t Hs ltac:(lra) E) as N.
  assert (Bst : s <= 3 * t).
  { assert (0 <= t * t * t) by (apply Rmult_le_pos; [apply Rle_0_sqr|lra]). lra. }
  assert (Us : unit53 * s <= / 1000000000000 * s) by (apply Rmult_le_compat_r; lra).
  pose proof (product_is_close (s0 / 3)) as C. absolute_values. rewrite (Rabs_pos_eq (s0 / 3)) in C by lra.
  pose proof (over_is _ _ _ _ I0 (whole_is 3 ltac:(lia)) ltac:(lra) ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as I1.
  set (y0 := nearest64 (s0 / 3)) in *.
  assert (Us0 : unit53 * (s0 / 3) <= / 1000000000000 * (s0 / 3)) by (apply Rmult_le_compat_r; lra).
  assert (C1 : Rabs (y0 - t) <= 42 / 1000 * t) by (absolute_values; apply Rabs_le; lra).
  assert (C0' : Rabs (s0 - s) <= 101 / 100 * unit53 * s) by (apply Rabs_le; lra).
  destruct (third_step_is _ _ _ _ _ _ (42 / 1000) I0 I1 Hs Ht E C0' ltac:(lra) C1) as (y1 & J1 & D1).
  destruct (third_step_is _ _ _ _ _ _ (3 / 10000) I0 J1 Hs Ht E C0' ltac:(lra)) as (y2 & J2 & D2).
  { apply Rle_trans with (1 := D1). apply Rmult_le_compat_r; lra. }
  destruct (third_step_is _ _ _ _ _ _ (/ 10000000) I0 J2 Hs Ht E C0' ltac:(lra)) as (y3 & J3 & D3).
  { apply Rle_trans with (1 := D2). apply Rmult_le_compat_r; lra. }
  destruct (third_step_is _ _ _ _ _ _ (/ 10000000000) I0 J3 Hs Ht E C0' ltac:(lra)) as (y4 & J4 & D4).
  { apply Rle_trans with (1 := D3). apply Rmult_le_compat_r; lra. }
  exists y4. split; [exact J4|]. apply Rle_trans with (1 := D4). apply Rmult_le_compat_r; [lra|]. unfold unit53. lra.
Qed.

Lemma rest_of_third : forall R w K, parameters R w K -> value32 w / 2 <> value32 R ->
  let r := (value32 R - value32 w / 2) / value32 R in let v := / 2 - third_sine (value32 R) (value32 w) in
  / 100000000 <= v <= / 2 /\ 6 * (v * v) - 4 * (v * v * v) = r /\ bpow radix2 (-48) <= r <= 1 /\ r = 1 - value32 w / 2 / value32 R.
Proof.
  intros R w K Hp Hne r v. destruct (third_sine_of_half R w K Hp) as (Ht & E & Bs).
  destruct (half_chord_is_binary64 R w K Hp) as (_ & _ & [H|H]); [lra|]. destruct Hp as (_ & HR & Hw & _).
  assert (Er : r = 1 - value32 w / 2 / value32 R) by (unfold r; field; lra).
  set (t := third_sine _ _) in *. set (s := value32 w / 2 / value32 R) in *.
  assert (Ev : 6 * (v * v) - 4 * (v * v * v) = r).
  { rewrite Er. replace s with (3 * t - 4 * (t * t * t)) by lra. unfold v. field. }
  assert (Br : bpow radix2 (-48) <= r).
  { unfold r. apply Rmult_le_reg_r with (value32 R); [lra|].
    replace ((value32 R - value32 w / 2) / value32 R * value32 R) with (value32 R - value32 w / 2) by (field; lra).
    apply Rle_trans with (2 := H). replace (bpow radix2 (-34)) with (bpow radix2 (-48) * 16384) by (simpl; lra).
    apply Rmult_le_compat_l; [apply bpow_ge_0|lra]. }
  split; [|split; [exact Ev|split; [lra|exact Er]]].
  assert (Bv : 0 <= v <= / 2) by (unfold v; lra). split; [|lra].
  destruct (Rle_or_lt (/ 100000000) v) as [L|L]; [exact L|exfalso].
  assert (v * v <= / 100000000 * / 100000000) by (apply Rmult_le_compat; lra).
  assert (0 <= v * v * v) by (apply Rmult_le_pos; [apply Rle_0_sqr|lra]).
  change (bpow radix2 (-48)) with (/ 281474976710656) in Br. lra.
Qed.

Theorem rest_start_is : forall R w K, parameters R w K -> value32 w / 2 <> value32 R -> 4999 / 10000 <= value32 w / 2 / value32 R ->
  let v := / 2 - third_sine (value32 R) (value32 w) in
  exists y, is64 (rest_start R w) y /\ Rabs (y - v) <= 8 * unit53 * v.
Proof.
  intros R w K Hp Hne Hs v. destruct (rest_of_third R w K Hp Hne) as (Hv & E & Br & Er). fold v in Hv, E.
  pose proof (half_width_is R w K Hp) as Ih. destruct (half_chord_is_binary64 R w K Hp) as (Gm & _ & Hm).
  destruct Hp as ((FR & _) & HR & Hw & _). pose proof (to64_is_exact R FR) as IR.
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  assert (Bm : bpow radix2 (-34) <= value32 R - value32 w / 2) by (destruct Hm as [H|H]; [lra|exact H]).
  assert (Im : is64 (minus (to64 R) (half_width w)) (value32 R - value32 w / 2)).
  { apply (minus_exact _ _ _ _ _ IR Ih); [reflexivity|exact Gm|]. apply big_enough. rewrite Rabs_pos_eq; lra. }
  pose proof (exactly _ _ (-34) 14 Im (size_of (-34) 14 _ Bm ltac:(change (bpow radix2 14) with 16384; lra))) as M0.
  pose proof (exactly _ _ (-4) 14 IR (size_of_radius _ HR)) as M1.
  pose proof (computes_over _ _ _ _ _ _ _ _ _ _ M0 M1 ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as M2. fold (rest_over_radius R w) in M2.
  change (-34 - 14)%Z with (-48)%Z in M2. change (14 - -4)%Z with 18%Z in M2.
  pose proof (exactly _ _ 2 3 (whole_is 5 ltac:(lia)) ltac:(apply size_of; simpl; lra)) as M3.
  pose proof (computes_over _ _ _ _ _ _ _ _ _ _ M2 M3 ltac:(unfold one; lra) ltac:(lra) ltac:(lia) ltac:(lia)) as M4.
  set (r := (value32 R - value32 w / 2) / value32 R) in *.
  assert (Hr0 : 0 < r) by (apply Rlt_le_trans with (2 := proj1 Br); apply bpow_gt_0).
  assert (M5 : computes (over (rest_over_radius R w) (whole 5)) (0 + 0 + one + 0 + one) (r / 5) (2 * -26) (2 * 9)).
  { apply (computes_more _ _ _ _ _ _ _ _ M4); [apply Rle_refl|lia|lia]. }
  destruct (computes_root _ _ _ (-26) 9 M5 ltac:(lra) ltac:(unfold one; lra) ltac:(lia)) as (y0 & I1 & N1 & _).
  destruct M2 as (r0 & I0 & N0 & _).
  pose proof (near_is_close _ _ _ N0 ltac:(unfold one; lra)) as C0. rewrite (Rabs_pos_eq r) in C0 by lra.
  assert (C0' : Rabs (r0 - r) <= 101 / 100 * unit53 * r).
  { apply Rle_trans with (1 := C0). apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_r; [lra|]. unfold one. lra. }
  assert (Hr : r <= 5001 / 10000) by lra.
  pose proof (newton_for_rest_starts r v Hr ltac:(lra) E) as N. pose proof (near_is_close _ _ _ N1 ltac:(unfold one; lra)) as C1.
  rewrite (Rabs_pos_eq (sqrt (r / 5))) in C1 by apply sqrt_pos. set (q := sqrt (r / 5)) in *.
  assert (Cy : Rabs (y0 - v) <= 97 / 1000 * v).
  { assert (Rabs (y0 - q) <= / 1000000 * q).
    { apply Rle_trans with (1 := C1). apply Rmult_le_compat_r; [apply sqrt_pos|]. unfold one. lra. }
    absolute_values. apply Rabs_le. lra. }
  destruct (rest_step_is _ _ _ _ _ _ (97 / 1000) I0 I1 Hr Hv E C0' ltac:(lra) Cy) as (y1 & J1 & D1).
  destruct (rest_step_is _ _ _ _ _ _ (6 / 1000) I0 J1 Hr Hv E C0' ltac:(lra)) as (y2 & J2 & D2).
  { apply Rle_trans with (1 := D1). apply Rmult_le_compat_r; lra. }
  destruct (rest_step_is _ _ _ _ _ _ (3 / 100000) I0 J2 Hr Hv E C0' ltac:(lra)) as (y3 & J3 & D3).
  { apply Rle_trans with (1 := D2). apply Rmult_le_compat_r; lra. }
  destruct (rest_step_is _ _ _ _ _ _ (/ 1000000000) I0 J3 Hr Hv E C0' ltac:(lra)) as (y4 & J4 & D4).
  { apply Rle_trans with (1 := D3). apply Rmult_le_compat_r; lra. }
  destruct (rest_step_is _ _ _ _ _ _ (/ 100000000000) I0 J4 Hr Hv E C0' ltac:(lra)) as (y5 & J5 & D5).
  { apply Rle_trans with (1 := D4). apply Rmult_le_compat_r; lra. }
  exists y5. split; [exact J5|]. apply Rle_trans with (1 := D5). apply Rmult_le_compat_r; [lra|]. unfold unit53. lra.
Qed.
