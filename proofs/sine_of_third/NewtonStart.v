(* SPDX-License-Identifier: BSD-3-Clause *)
(* Newton's method for t = sin(alpha / 3) in sine_of_third of fast/laws/bump_geometry.h, in real numbers: where it starts, and what one
   step leaves of a relative error. Towards s = 1 it finds u = 1/2 - t instead. *)
From Coq Require Import Reals Lra.
From Flocq Require Import Core.
Open Scope R_scope.

Lemma third_is_small : forall s t, s <= 5001 / 10000 -> 0 < t <= / 2 -> 4 * (t * t * t) - 3 * t + s = 0 -> t <= 1737 / 10000.
Proof.
  intros s t Hs Ht E. destruct (Rle_or_lt t (1737 / 10000)) as [H|H]; [exact H|exfalso].
  assert (t * t <= / 2 * / 2) by (apply Rmult_le_compat; lra).
  assert (0 < (t - 1737 / 10000) * (3 - 4 * (t * t + t * (1737 / 10000) + 1737 / 10000 * (1737 / 10000)))) by
    (apply Rmult_lt_0_compat; lra).
  lra.
Qed.

Theorem newton_for_third_starts : forall s t, s <= 5001 / 10000 -> 0 < t <= / 2 -> 4 * (t * t * t) - 3 * t + s = 0 ->
  Rabs (s / 3 - t) <= 41 / 1000 * t.
Proof.
  intros s t Hs Ht E. pose proof (third_is_small s t Hs Ht E) as Hsmall. replace (s / 3 - t) with (- (4 / 3 * (t * t) * t)) by lra.
  assert (Htt : 0 <= t * t <= 1737 / 10000 * (1737 / 10000)) by (split; [apply Rle_0_sqr|apply Rmult_le_compat; lra]).
  rewrite Rabs_Ropp, Rabs_pos_eq by (apply Rmult_le_pos; lra). apply Rmult_le_compat_r; lra.
Qed.

Theorem newton_for_third_converges : forall s t y rho, s <= 5001 / 10000 -> 0 < t <= / 2 -> 4 * (t * t * t) - 3 * t + s = 0 ->
  rho <= 42 / 1000 -> Rabs (y - t) <= rho * t ->
  Rabs (y - (4 * (y * y * y) - 3 * y + s) / (12 * (y * y) - 3) - t) <= 15 / 100 * (rho * rho) * t.
Proof.
  intros s t y rho Hs Ht E Hrho Hy. pose proof (third_is_small s t Hs Ht E) as Hsmall.
  assert (Hr : rho * t <= 42 / 1000 * t) by (apply Rmult_le_compat_r; lra). pose proof (Rabs_le_inv _ _ Hy) as Hy2.
  assert (Htt : 0 <= t * t <= 30172 / 1000000).
  { split; [apply Rle_0_sqr|]. apply Rle_trans with (1737 / 10000 * (1737 / 10000)); [apply Rmult_le_compat; lra|lra]. }
  assert (Hyy : y * y <= 1810 / 10000 * (1810 / 10000)) by (apply Rmult_le_compat; lra).
  set (D := 3 - 12 * (y * y)). assert (HD : 2606 / 1000 <= D) by (unfold D; lra).
  assert (He : (y - t) * (y - t) <= rho * rho * (t * t)).
  { replace ((y - t) * (y - t)) with (Rabs (y - t) * Rabs (y - t)) by (rewrite <- Rabs_mult; apply Rabs_pos_eq, Rle_0_sqr).
    replace (rho * rho * (t * t)) with (rho * t * (rho * t)) by ring. apply Rmult_le_compat; try assumption; apply Rabs_pos. }
  replace (y - (4 * (y * y * y) - 3 * y + s) / (12 * (y * y) - 3) - t) with (- (4 * ((y - t) * (y - t)) * (2 * y + t) / D)).
  2: { replace s with (3 * t - 4 * (t * t * t)) by lra. unfold D in *. field. split; lra. }
  assert (Hpos : 0 <= 4 * ((y - t) * (y - t)) * (2 * y + t) / D).
  { apply Rmult_le_pos; [|apply Rlt_le, Rinv_0_lt_compat; lra]. apply Rmult_le_pos; [|lra].
    apply Rmult_le_pos; [lra|apply Rle_0_sqr]. }
  rewrite Rabs_Ropp, Rabs_pos_eq by exact Hpos. apply Rmult_le_reg_r with D; [lra|].
  replace (4 * ((y - t) * (y - t)) * (2 * y + t) / D * D) with (4 * ((y - t) * (y - t)) * (2 * y + t)) by (field; lra).
  assert (Hrr : 0 <= rho * rho * t) by (apply Rmult_le_pos; [apply Rle_0_sqr|lra]).
  apply Rle_trans with (4 * (rho * rho * (t * t)) * (3084 / 1000 * t));
    [apply Rmult_le_compat; try lra; pose proof (Rle_0_sqr (y - t)) as P;
    unfold Rsqr in P; lra|].
  apply Rle_trans with (15 / 100 * (rho * rho) * t * (2606 / 1000)); [|apply Rmult_le_compat_l; lra].
  replace (4 * (rho * rho * (t * t)) * (3084 / 1000 * t)) with (rho * rho * t * (12336 / 1000 * (t * t))) by field.
  replace (15 / 100 * (rho * rho) * t * (2606 / 1000)) with (rho * rho * t * (15 / 100 * (2606 / 1000))) by field.
  apply Rmult_le_compat_l; lra.
Qed.

(* ---- u = 1/2 - t: 6 u^2 - 4 u^3 = r, r = 1 - s ---- *)

Lemma rest_is_small : forall r u, r <= 5001 / 10000 -> 0 < u <= / 2 -> 6 * (u * u) - 4 * (u * u * u) = r -> u <= 3265 / 10000.
Proof.
  intros r u Hr Hu E. destruct (Rle_or_lt u (3265 / 10000)) as [H|H]; [exact H|exfalso].
  assert (u * u <= / 2 * / 2) by (apply Rmult_le_compat; lra). set (a := 3265 / 10000) in *.
  assert (0 < (u - a) * (6 * (u + a) - 4 * (u * u + u * a + a * a))).
  { apply Rmult_lt_0_compat; [lra|]. unfold a in *. lra. }
  unfold a in *. lra.
Qed.

Theorem newton_for_rest_starts : forall r u, r <= 5001 / 10000 -> 0 < u <= / 2 -> 6 * (u * u) - 4 * (u * u * u) = r ->
  Rabs (sqrt (r / 5) - u) <= 96 / 1000 * u.
Proof.
  intros r u Hr Hu E. pose proof (rest_is_small r u Hr Hu E) as Hsmall.
  assert (Huu : 0 < u * u) by (apply Rmult_lt_0_compat; lra).
  assert (E5 : r / 5 = u * u * ((6 - 4 * u) / 5)) by (rewrite <- E; field).
  assert (Hlow : sqrt (904 / 1000 * u * (904 / 1000 * u)) <= sqrt (r / 5)).
  { apply sqrt_le_1_alt. rewrite E5. replace (904 / 1000 * u * (904 / 1000 * u)) with (u * u * (904 / 1000 * (904 / 1000))) by field.
    apply Rmult_le_compat_l; lra. }
  assert (Hhigh : sqrt (r / 5) <= sqrt (1096 / 1000 * u * (1096 / 1000 * u))).
  { apply sqrt_le_1_alt. rewrite E5. replace (1096 / 1000 * u * (1096 / 1000 * u)) with (u * u * (1096 / 1000 * (1096 / 1000))) by field.
    apply Rmult_le_compat_l; lra. }
  rewrite sqrt_square in Hlow, Hhigh by lra. apply Rabs_le. lra.
Qed.

Theorem newton_for_rest_converges : forall r u y rho, r <= 5001 / 10000 -> 0 < u <= / 2 -> 6 * (u * u) - 4 * (u * u * u) = r ->
  rho <= 97 / 1000 -> Rabs (y - u) <= rho * u ->
  Rabs (y - (6 * (y * y) - 4 * (y * y * y) - r) / (12 * y * (1 - y)) - u) <= 56 / 100 * (rho * rho) * u.
Proof.
  intros r u y rho Hr Hu E Hrho Hy. pose proof (rest_is_small r u Hr Hu E) as Hsmall.
  assert (Hru : rho * u <= 97 / 1000 * u) by (apply Rmult_le_compat_r; lra). pose proof (Rabs_le_inv _ _ Hy) as Hy2.
  assert (He : 0 <= (y - u) * (y - u) <= rho * rho * (u * u)).
  { split; [apply Rle_0_sqr|].
    replace ((y - u) * (y - u)) with (Rabs (y - u) * Rabs (y - u)) by (rewrite <- Rabs_mult; apply Rabs_pos_eq, Rle_0_sqr).
    replace (rho * rho * (u * u)) with (rho * u * (rho * u)) by ring. apply Rmult_le_compat; try assumption; apply Rabs_pos. }
  assert (Hy3 : 903 / 1000 * u <= y <= 36 / 100) by lra. set (D := 12 * y * (1 - y)).
  assert (HD : 0 < D) by (unfold D; apply Rmult_lt_0_compat; lra).
  replace (y - (6 * (y * y) - 4 * (y * y * y) - r) / D - u) with ((y - u) * (y - u) * (6 - 8 * y - 4 * u) / D).
  2: { rewrite <- E. unfold D. field. split; lra. }
  assert (Hn : 0 <= 6 - 8 * y - 4 * u <= 6 * (1 - y)) by lra.
  assert (Hpos : 0 <= (y - u) * (y - u) * (6 - 8 * y - 4 * u) / D).
  { apply Rmult_le_pos; [|apply Rlt_le, Rinv_0_lt_compat; lra]. apply Rmult_le_pos; lra. }
  rewrite Rabs_pos_eq by exact Hpos. apply Rmult_le_reg_r with D; [lra|].
  replace ((y - u) * (y - u) * (6 - 8 * y - 4 * u) / D * D) with ((y - u) * (y - u) * (6 - 8 * y - 4 * u)) by (field; lra).
  apply Rle_trans with (rho * rho * (u * u) * (6 * (1 - y))); [apply Rmult_le_compat; lra|].
  replace (rho * rho * (u * u) * (6 * (1 - y))) with (rho * rho * u * (6 * u * (1 - y))) by ring.
  replace (56 / 100 * (rho * rho) * u * D) with (rho * rho * u * (56 / 100 * 12 * y * (1 - y))) by (unfold D; ring).
  apply Rmult_le_compat_l; [apply Rmult_le_pos; [apply Rle_0_sqr|lra]|]. apply Rmult_le_compat_r; lra.
Qed.
