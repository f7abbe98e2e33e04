(* SPDX-License-Identifier: BSD-3-Clause *)
(* A step of Newton's method for a number of the third stage, in real numbers: it squares the error and adds some units in the last
   place. fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients.
From Forceshade Require Import BigFloatNarrow BigFloatNarrowQuotient BigFloatNarrowRoot BigFloatNewton BigFloatNewtonStart.
Open Scope R_scope.

(* ---- A step in real numbers ---- *)

(* u = B i; Q and S: the correction and the new inverse, times B. *)
Lemma inverse_step_in_reals : forall e n u p d Q S, 0 <= e <= / 1000 -> 0 <= n <= / 1000 -> Rabs (1 - u) <= n ->
  Rabs (p - u) <= e * Rabs u -> Rabs (d - (1 + - p)) <= e * (Rabs 1 + Rabs (- p)) -> Rabs (Q - u * d) <= e * Rabs (u * d) ->
  Rabs (S - (u + Q)) <= e * (Rabs u + Rabs Q) -> Rabs (1 - S) <= n * n + 6 * e.
Proof.
  intros e n u p d Q S E N H Hp Hd HQ HS. set (h := 1 - u) in *.
  assert (U : Rabs u <= 1001 / 1000) by (unfold h in H; apply Rabs_le; apply Rabs_le_inv in H; lra).
  pose proof (share_times e u _ 1 (proj1 E) ltac:(rewrite Rmult_1_r; exact U)) as U'. rewrite Rmult_1_r in U'.
  assert (P : Rabs (- p) <= 1003 / 1000) by (rewrite Rabs_Ropp; pose proof (off_by_share _ _ _ Hp); lra).
  pose proof (share_times e (- p) _ 1 (proj1 E) ltac:(rewrite Rmult_1_r; exact P)) as P'. rewrite Rmult_1_r in P'.
  rewrite Rmult_plus_distr_l, Rabs_R1, Rmult_1_r in Hd. set (w := d - h).
  assert (W : Rabs w <= 3010 / 1000 * e).
  { unfold w, h. apply Rabs_le. apply Rabs_le_inv in Hd, Hp. lra. }
  assert (D : Rabs d <= 5 / 1000).
  { replace d with (h + w) by (unfold w; ring). apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  pose proof (product_at_most _ _ _ _ U D) as UD. assert (UD' : Rabs (u * d) <= 6 / 1000) by lra.
  pose proof (share_times e (u * d) _ 1 (proj1 E) ltac:(rewrite Rmult_1_r; exact UD')) as Q'. rewrite Rmult_1_r in Q'.
  assert (Q1 : Rabs Q <= 7 / 1000) by (pose proof (off_by_share _ _ _ HQ); lra).
  pose proof (share_times e Q _ 1 (proj1 E) ltac:(rewrite Rmult_1_r; exact Q1)) as Q2. rewrite Rmult_1_r in Q2.
  rewrite Rmult_plus_distr_l in HS. pose proof (product_at_most _ _ _ _ U W) as UW. pose proof (product_at_most _ _ _ _ H H) as HH.
  replace (1 - S) with (h * h - u * w - (Q - u * d) - (S - (u + Q))) by (unfold w, h; ring).
  apply Rabs_le_inv in HH, UW, HQ, HS. apply Rabs_le. lra.
Qed.

(* m, p: the square of the inverse and what it gives; q: the correction times 2. *)
Lemma inverse_root_step_in_reals : forall e n A i m p d q s, 0 <= e <= / 1000 -> 0 <= n <= / 1000 -> 0 < A -> 0 < i ->
  Rabs (1 - A * (i * i)) <= n -> Rabs (m - i * i) <= e * Rabs (i * i) -> Rabs (p - A * m) <= e * Rabs (A * m) ->
  Rabs (d - (1 + - p)) <= e * (Rabs 1 + Rabs (- p)) -> Rabs (q - i * d) <= e * Rabs (i * d) ->
  Rabs (s - (i + q / 2)) <= e * (Rabs i + Rabs (q / 2)) -> 0 < s /\ Rabs (1 - A * (s * s)) <= n * n + 7 * e.
Proof.
  intros e n A i m p d q s E N PA Pi H Hm Hp Hd Hq Hs. set (v := A * (i * i)) in *. set (h := 1 - v) in *.
  assert (V : Rabs v <= 1001 / 1000) by (unfold h in H; apply Rabs_le; apply Rabs_le_inv in H; lra).
  pose proof (share_times e v _ 1 (proj1 E) ltac:(rewrite Rmult_1_r; exact V)) as V'. rewrite Rmult_1_r in V'.
  assert (M : Rabs (A * m - v) <= 1001 / 1000 * e).
  { replace (A * m - v) with (A * (m - i * i)) by (unfold v; ring). rewrite Rabs_mult, (Rabs_pos_eq A) by lra.
    apply Rle_trans with (A * (e * Rabs (i * i))); [apply Rmult_le_compat_l; lra|].
    replace (A * (e * Rabs (i * i))) with (e * (Rabs A * Rabs (i * i))) by (rewrite (Rabs_pos_eq A) by lra; ring).
    rewrite <- Rabs_mult. exact V'. }
  assert (M2 : Rabs (A * m) <= 1003 / 1000) by (pose proof (off_by_share _ _ _ M); lra).
  pose proof (share_times e (A * m) _ 1 (proj1 E) ltac:(rewrite Rmult_1_r; exact M2)) as M3. rewrite Rmult_1_r in M3.
  assert (P : Rabs (- p) <= 1005 / 1000) by (rewrite Rabs_Ropp; pose proof (off_by_share _ _ _ Hp); lra).
  pose proof (share_times e (- p) _ 1 (proj1 E) ltac:(rewrite Rmult_1_r; exact P)) as P'. rewrite Rmult_1_r in P'.
  rewrite Rmult_plus_distr_l, Rabs_R1, Rmult_1_r in Hd. set (w := d - h).
  assert (W : Rabs w <= 4020 / 1000 * e).
  { unfold w, h. apply Rabs_le. apply Rabs_le_inv in Hd, Hp, M. lra. }
  assert (D : Rabs d <= 6 / 1000).
  { replace d with (h + w) by (unfold w; ring). apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  set (t := e * i). assert (T : 0 <= t <= i / 1000).
  { unfold t. split; [apply Rmult_le_pos; lra|]. pose proof (Rmult_le_compat_r i _ _ ltac:(lra) (proj2 E)). lra. }
  assert (I : Rabs i <= i) by (rewrite Rabs_pos_eq; lra).
  pose proof (product_at_most _ _ _ _ I D) as ID. rewrite (Rmult_comm i (6 / 1000)) in ID.
  pose proof (share_times e (i * d) _ _ (proj1 E) ID) as Q'. fold t in Q'.
  assert (Q1 : Rabs (q / 2) <= 4 / 1000 * i).
  { pose proof (off_by_share _ _ _ Hq) as O. unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ 2)) by lra. lra. }
  pose proof (share_times e _ _ _ (proj1 E) Q1) as Q2. fold t in Q2. rewrite Rmult_plus_distr_l, (Rabs_pos_eq i) in Hs by lra. fold t in Hs.
  pose proof (product_at_most _ _ _ _ I W) as IW. replace (i * (4020 / 1000 * e)) with (4020 / 1000 * t) in IW by (unfold t; ring).
  set (r := i * (1 + h / 2)). set (z := s - r).
  assert (Z : Rabs z <= 3030 / 1000 * t).
  { replace z with ((s - (i + q / 2)) + (q - i * d) / 2 + (i * w) / 2) by (unfold z, r, w; field).
    apply Rabs_le_inv in Hs, Hq, IW. apply Rabs_le. lra. }
  assert (h1 : Rabs h <= / 1000) by lra. pose proof (Rabs_le_inv _ _ h1) as h2.
  assert (R : 999 / 1000 * i <= r <= 1001 / 1000 * i).
  { unfold r. rewrite (Rmult_comm i). split; apply Rmult_le_compat_r; lra. }
  split; [unfold z in Z; apply Rabs_le_inv in Z; lra|].
  assert (Z2 : Rabs (2 * r + z) <= 2010 / 1000 * i) by (apply Rabs_le_inv in Z; apply Rabs_le; lra).
  assert (X : Rabs (A * (z * (2 * r + z))) <= 6100 / 1000 * e).
  { rewrite Rabs_mult, (Rabs_pos_eq A) by lra. apply Rle_trans with (A * (3030 / 1000 * t * (2010 / 1000 * i))).
    - apply Rmult_le_compat_l; [lra|]. now apply product_at_most.
    - replace (A * (3030 / 1000 * t * (2010 / 1000 * i))) with (60903 / 10000 * (e * v)) by (unfold t, v; field).
      assert (e * v <= e * (1001 / 1000)); [|lra]. apply Rmult_le_compat_l; [lra|]. apply Rle_trans with (2 := V). apply Rle_abs. }
  pose proof (product_at_most _ _ _ _ H H) as HH.
  assert (H3 : Rabs (h * h * (3 / 4 + h / 4)) <= n * n * 1) by (apply product_at_most; [exact HH|apply Rabs_le; lra]).
  replace (1 - A * (s * s)) with (h * h * (3 / 4 + h / 4) - A * (z * (2 * r + z))).
  - apply Rle_trans with (1 := minus_triangle _ _). lra.
  - replace (A * (z * (2 * r + z))) with (A * (s * s) - v * ((1 + h / 2) * (1 + h / 2))) by (unfold z, r, v; ring).
    replace v with (1 - h) by (unfold h; ring). field.
Qed.
