(* SPDX-License-Identifier: BSD-3-Clause *)
(* The bump of three polygons in real numbers, by t = sin(alpha / 3) with sin alpha = w / 2R: docs/laws.md and three_polygons of
   fast/laws/bump_geometry.h agree. *)
From Coq Require Import ZArith Reals Lia Lra.
From Forceshade Require Import Laws Polygons ThreePolygons.
Open Scope R_scope.

Definition third_angle (Rad w : R) : R := asin (w / (2 * Rad)) / 3.
Definition third_sine (Rad w : R) : R := sin (third_angle Rad w).
Definition side_sine (t : R) : R := 2 * t * sqrt ((1 - t) * (1 + t)).
Definition side_cosine (t : R) : R := 1 - 2 * t * t.

(* The sine and cosine of a slope that is their quotient. *)
Lemma sine_and_cosine_of : forall s c, 0 < c -> s * s + c * c = 1 -> sine_of (s / c) = s /\ cosine_of (s / c) = c.
Proof.
  intros s c Hc H. unfold sine_of, cosine_of.
  assert (E : sqrt (1 + Rsqr (s / c)) = / c).
  { replace (1 + Rsqr (s / c)) with (/ c * / c).
    - apply sqrt_square. apply Rlt_le, Rinv_0_lt_compat. assumption.
    - unfold Rsqr. replace (/ c * / c) with ((s * s + c * c) / (c * c)) by (rewrite H; field; lra). field. lra. }
  rewrite E. split; field; lra.
Qed.

Lemma third_sine_is : forall Rad w, 0 < Rad -> 0 < w <= 2 * Rad -> let t := third_sine Rad w in
  w / (6 * Rad) <= t <= / 2 /\ 4 * (t * t * t) - 3 * t + w / (2 * Rad) = 0 /\ top_width Rad w / 2 = Rad * t /\
  top_height Rad w = 2 * (Rad * t) * side_sine t /\ slope_3p Rad w = side_sine t / side_cosine t /\
  sine_of (slope_3p Rad w) = side_sine t /\ cosine_of (slope_3p Rad w) = side_cosine t.
Proof.
  intros Rad w HR Hw t. set (s := w / (2 * Rad)).
  assert (Hs : 0 < s <= 1).
  { unfold s. split; [apply Rdiv_lt_0_compat; lra|]. apply Rmult_le_reg_r with (2 * Rad); [lra|].
    replace (w / (2 * Rad) * (2 * Rad)) with w by (field; lra). lra. }
  assert (Ew : w / 2 = Rad * s) by (unfold s; field; lra).
  set (a := third_angle Rad w). assert (E3 : asin s = 3 * a) by (unfold a, third_angle; fold s; field).
  assert (Hs3 : sin (3 * a) = s) by (rewrite <- E3; apply sin_asin; lra).
  assert (Ha3 : 0 < 3 * a <= PI / 2).
  { rewrite <- E3. split; [|apply asin_bound]. destruct (Rle_or_lt (asin s) 0) as [H|H]; [exfalso|exact H].
    assert (sin (asin s) <= 0); [|rewrite sin_asin in H0; lra]. pose proof (asin_bound s). pose proof PI_RGT_0.
    rewrite <- sin_0. apply sin_incr_1; lra. }
  pose proof PI_RGT_0 as HPI.
  assert (Hc3 : 0 <= cos (3 * a)) by (apply cos_ge_0; lra).
  assert (Hd : axis_depth Rad w = Rad * cos (3 * a)).
  { unfold axis_depth. rewrite Ew. replace (Rsqr Rad - Rsqr (Rad * s)) with ((Rad * cos (3 * a)) * (Rad * cos (3 * a))).
    - apply sqrt_square. apply Rmult_le_pos; lra.
    - pose proof (sin2_cos2 (3 * a)) as E. rewrite Hs3 in E. unfold Rsqr in *.
      replace (Rad * cos (3 * a) * (Rad * cos (3 * a))) with (Rad * Rad * (cos (3 * a) * cos (3 * a))) by ring.
      replace (cos (3 * a) * cos (3 * a)) with (1 - s * s) by lra. ring. }
  assert (Et : t = sin a) by reflexivity. set (k := cos a).
  assert (Ha6 : 0 < a <= PI / 6) by lra.
  assert (Ht : 0 < t <= / 2).
  { rewrite Et. split; [apply sin_gt_0; lra|]. replace (/ 2) with (sin (PI / 6)) by (rewrite sin_PI6; field). apply sin_incr_1; lra. }
  assert (Hk : 0 < k) by (apply cos_gt_0; lra).
  assert (Htk : t * t + k * k = 1) by (rewrite Et; exact (sin2_cos2 a)).
  assert (Ek : sqrt ((1 - t) * (1 + t)) = k).
  { replace ((1 - t) * (1 + t)) with (k * k) by lra. apply sqrt_square. lra. }
  assert (S2 : sin (2 * a) = 2 * t * k) by (rewrite sin_2a, Et; reflexivity).
  assert (C2 : cos (2 * a) = 1 - 2 * t * t) by (rewrite cos_2a_sin, Et; reflexivity).
  assert (S3 : sin (3 * a) = 3 * t - 4 * (t * t * t)).
  { replace (3 * a) with (2 * a + a) by ring. rewrite sin_plus, S2, C2. fold k. rewrite <- Et.
    replace (2 * t * k * k) with (2 * t * (k * k)) by ring. replace (k * k) with (1 - t * t) by lra. ring. }
  assert (C3 : cos (3 * a) = k * (1 - 4 * (t * t))).
  { replace (3 * a) with (2 * a + a) by ring. rewrite cos_plus, S2, C2. fold k. rewrite <- Et. ring. }
  assert (Eth : theta Rad w = 2 * a) by (unfold theta, a, third_angle; field).
  assert (Ess : side_sine t = 2 * t * k) by (unfold side_sine; rewrite Ek; reflexivity).
  assert (Hw2 : top_width Rad w / 2 = Rad * t).
  { unfold top_width. rewrite Eth, Ew, Hd, <- Hs3. replace t with (sin (3 * a - 2 * a)) by (rewrite Et; f_equal; ring).
    rewrite sin_minus. field. }
  assert (Hh : top_height Rad w = 2 * (Rad * t) * side_sine t).
  { unfold top_height. rewrite Eth, Ew, Hd, <- Hs3.
    replace (Rad * sin (3 * a) * sin (2 * a) + Rad * cos (3 * a) * cos (2 * a) - Rad * cos (3 * a)) with
      (Rad * (cos (3 * a - 2 * a) - cos (3 * a))) by (rewrite cos_minus; ring).
    replace (3 * a - 2 * a) with a by ring. fold k. rewrite C3, Ess. ring. }
  assert (Htt : t * t <= / 4) by (replace (/ 4) with (/ 2 * / 2) by field; apply Rmult_le_compat; lra).
  assert (Hsc : 0 < side_cosine t) by (unfold side_cosine; lra).
  assert (Hsl : slope_3p Rad w = side_sine t / side_cosine t).
  { unfold slope_3p. rewrite Hw2, Hh, Ew, <- Hs3, S3. unfold side_cosine in *. field. repeat split; try lra.
    replace (Rad * (3 * t - 4 * (t * t * t)) - Rad * t) with (2 * (Rad * t) * (1 - 2 * t * t)) by ring.
    apply Rgt_not_eq. apply Rmult_lt_0_compat; [|lra]. apply Rmult_lt_0_compat; [lra|apply Rmult_lt_0_compat; lra]. }
  destruct (sine_and_cosine_of (side_sine t) (side_cosine t) Hsc) as [H1 H2].
  { rewrite Ess. unfold side_cosine. replace (2 * t * k * (2 * t * k)) with (4 * (t * t) * (k * k)) by ring.
    replace (k * k) with (1 - t * t) by lra. ring. }
  rewrite <- Hsl in H1, H2.
  split; [|split; [|repeat (split; [assumption|]); assumption]].
  - split; [|lra]. assert (Ht3 : 0 < t * t * t) by (repeat apply Rmult_lt_0_compat; lra).
    replace (w / (6 * Rad)) with (s / 3) by (unfold s; field; lra). rewrite <- Hs3, S3. lra.
  - fold s. rewrite <- Hs3, S3. ring.
Qed.

(* is_on_top of fast/laws/top_edge.h, in real numbers. *)
Definition is_on_top (Rad w c : R) : Prop := 2 * c <= Rad /\ 0 <= 4 * (c * c * c) - 3 * (Rad * Rad * c) + Rad * Rad * (w / 2).

Theorem is_on_top_is_right : forall Rad w c, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= c ->
  is_on_top Rad w c <-> c <= Rad * third_sine Rad w.
Proof.
  intros Rad w c HR Hw Hc. destruct (third_sine_is Rad w HR Hw) as ((Hlow & Ht) & Hroot & _). set (t := third_sine Rad w) in *.
  assert (Ht0 : 0 < t) by (apply Rlt_le_trans with (2 := Hlow); apply Rdiv_lt_0_compat; lra). clear Hlow.
  set (y := c / Rad). assert (Ec : c = Rad * y) by (unfold y; field; lra).
  assert (Hy : 0 <= y) by (unfold y; apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]). clearbody y. rewrite Ec.
  assert (P3 : 0 < Rad * Rad * Rad) by (repeat apply Rmult_lt_0_compat; assumption).
  assert (Ep : 4 * (Rad * y * (Rad * y) * (Rad * y)) - 3 * (Rad * Rad * (Rad * y)) + Rad * Rad * (w / 2) =
    Rad * Rad * Rad * ((t - y) * (3 - 4 * (y * y + y * t + t * t)))).
  { replace (Rad * Rad * (w / 2)) with (Rad * Rad * Rad * (w / (2 * Rad))) by (field; lra).
    replace (w / (2 * Rad)) with (3 * t - 4 * (t * t * t)) by lra. ring. }
  unfold is_on_top. rewrite Ep. clear Ep Hroot. split.
  - intros [H1 H2]. apply Rmult_le_compat_l; [lra|]. assert (Hy2 : y <= / 2) by (apply Rmult_le_reg_l with Rad; lra).
    destruct (Rle_or_lt y t) as [H|H]; [exact H|exfalso].
    assert (0 < (y - t) * (3 - 4 * (y * y + y * t + t * t))).
    { apply Rmult_lt_0_compat; [lra|].
      assert (y * y <= / 2 * / 2) by (apply Rmult_le_compat; lra). assert (y * t <= / 2 * t) by (apply Rmult_le_compat_r; lra).
      assert (t * t <= / 2 * t) by (apply Rmult_le_compat_r; lra). lra. }
    assert (0 < Rad * Rad * Rad * ((y - t) * (3 - 4 * (y * y + y * t + t * t)))) by now apply Rmult_lt_0_compat. lra.
  - intro H. assert (Hyt : y <= t) by (apply Rmult_le_reg_l with Rad; assumption). split.
    + replace (2 * (Rad * y)) with (Rad * (2 * y)) by ring. rewrite <- (Rmult_1_r Rad) at 2. apply Rmult_le_compat_l; lra.
    + apply Rmult_le_pos; [lra|]. apply Rmult_le_pos; [lra|].
      assert (y * y <= / 2 * / 2) by (apply Rmult_le_compat; lra). assert (y * t <= / 2 * / 2) by (apply Rmult_le_compat; lra).
      assert (t * t <= / 2 * / 2) by (apply Rmult_le_compat; lra). lra.
Qed.
