(* SPDX-License-Identifier: BSD-3-Clause *)
(* Loops about an edge exist that give the whole term of docs/energy.md: ellipses about a point of the edge, D high. *)
From Coq Require Import Reals Lra.
From Forceshade Require Import Laws ThreePolygonsFace Work Paths EdgeLoops.
Open Scope R_scope.

Lemma loop_exists : forall law inner outer U V e r H D, has_slope law inner U -> has_slope law outer V -> 0 < r ->
  (forall X Z, e - r <= X < e -> inner X Z) -> (forall X Z, e < X <= e + r -> outer X Z) ->
  exists p a b c, follows law inner p a b /\ follows law outer p b c /\ at_x p a = e /\ at_x p b = e /\ at_x p c = e /\
    at_z p a = H /\ at_z p b = H - D /\ at_z p c = H.
Proof.
  intros law inner outer U V e r H D SU SV Hr I O. pose proof PI_RGT_0 as P.
  set (x := fun t => e - r * sin t). set (z := fun t => H - D / 2 * (1 - cos t)).
  assert (Dx : forall t, derivable_pt_lim x t (0 - r * cos t)).
  { intros t. apply (derivable_pt_lim_minus (fun _ => e) (fun t => r * sin t)); [apply derivable_pt_lim_const|].
    apply (derivable_pt_lim_scal sin). apply derivable_pt_lim_sin. }
  assert (Dz : forall t, derivable_pt_lim z t (0 - D / 2 * (0 - - sin t))).
  { intros t. apply (derivable_pt_lim_minus (fun _ => H) (fun t => D / 2 * (1 - cos t))); [apply derivable_pt_lim_const|].
    apply (derivable_pt_lim_scal (fun t => 1 - cos t)).
    apply (derivable_pt_lim_minus (fun _ => 1) cos); [apply derivable_pt_lim_const | apply derivable_pt_lim_cos]. }
  assert (A : follows law inner (way U x z) 0 PI).
  { apply (way_follows _ _ U _ _ _ _ 0 PI SU ltac:(lra) Dx Dz). intros t T. apply I. unfold x.
    pose proof (sin_gt_0 t ltac:(lra) ltac:(lra)). pose proof (SIN_bound t). nra. }
  assert (B : follows law outer (way V x z) PI (2 * PI)).
  { apply (way_follows _ _ V _ _ _ _ PI (2 * PI) SV ltac:(lra) Dx Dz). intros t T. apply O. unfold x.
    pose proof (sin_lt_0 t ltac:(lra) ltac:(lra)). pose proof (SIN_bound t). nra. }
  exists (joined PI (way U x z) (way V x z)), 0, PI, (2 * PI).
  split; [apply joined_before; [lra | exact (proj1 (proj2 B)) | exact A]|].
  split; [apply joined_after; [lra | exact (proj1 (proj2 A)) | split; reflexivity | exact B]|].
  cbn [at_x at_z joined way]. rewrite !then_same.
  unfold x, z. rewrite sin_0, cos_0, sin_PI, cos_PI, sin_2PI, cos_2PI. repeat split; field.
Qed.

Theorem bump_2p_loop_gives_all : forall Rad w K D, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= K -> 0 <= D ->
  exists p a b c, loops_about (exact_bump_2p Rad w K) (w / 2) (on_bump w) (beside_bump w) 0 D p a b c /\
    work p c - work p a = most_2p Rad w K D.
Proof.
  intros Rad w K D HR Hw HK HD.
  destruct (loop_exists _ _ _ _ _ (w / 2) (w / 4) 0 D (bump_2p_on_bump Rad w K ltac:(lra)) (bump_2p_beside Rad w K))
    as (p & a & b & c & A & B & Xa & Xb & Xc & Za & Zb & Zc); [lra | | |].
  - intros X Z I. split; [lra | rewrite Rabs_pos_eq by lra; lra].
  - intros X Z O. split; [lra | rewrite Rabs_pos_eq by lra; lra].
  - exists p, a, b, c. assert (L : loops_about (exact_bump_2p Rad w K) (w / 2) (on_bump w) (beside_bump w) 0 D p a b c).
    { unfold loops_about. rewrite Xa, Xb, Xc, Za, Zb, Zc, Rabs_pos_eq by lra. repeat (split; [assumption || lra|]). lra. }
    split; [exact L|]. apply (bump_2p_loop_gives_at_most Rad w K D p a b c HR Hw HK HD L); lra.
Qed.

(* At the edge of the top it is taken away, since the side is steeper. *)
Theorem bump_3p_loop_gives_all : forall Rad w K D, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= K -> 0 <= D ->
  (exists p a b c, loops_about (exact_bump_3p Rad w K) (w / 2) (on_side Rad w) (beside_bump w) 0 D p a b c /\
    work p c - work p a = most_3p Rad w K D) /\
  (exists p a b c,
    loops_about (exact_bump_3p Rad w K) (top_width Rad w / 2) (on_top Rad w) (on_side Rad w) (top_height Rad w) D p a b c /\
    work p c - work p a = - most_3p Rad w K D).
Proof.
  intros Rad w K D HR Hw HK HD. pose proof (top_is_narrower Rad w HR Hw) as N.
  assert (T : 0 < top_width Rad w).
  { destruct (third_sine_is Rad w HR Hw) as ([L _] & _ & W & _).
    assert (0 < Rad * third_sine Rad w)
      by (apply Rmult_lt_0_compat; [exact HR | apply Rlt_le_trans with (2 := L); apply Rdiv_lt_0_compat; lra]). lra. }
  split.
  - destruct (loop_exists _ _ _ _ _ (w / 2) ((w - top_width Rad w) / 4) 0 D (bump_3p_on_side Rad w K) (bump_3p_beside Rad w K))
      as (p & a & b & c & A & B & Xa & Xb & Xc & Za & Zb & Zc); [lra | | |].
    + intros X Z I. unfold on_side. rewrite Rabs_pos_eq by lra. lra.
    + intros X Z O. unfold beside_bump. rewrite Rabs_pos_eq by lra. lra.
    + exists p, a, b, c. assert (L : loops_about (exact_bump_3p Rad w K) (w / 2) (on_side Rad w) (beside_bump w) 0 D p a b c).
      { unfold loops_about. rewrite Xa, Xb, Xc, Za, Zb, Zc, Rabs_pos_eq by lra. repeat (split; [assumption || lra|]). lra. }
      split; [exact L|]. apply (proj1 (bump_3p_loop_gives_at_most Rad w K D p a b c HR Hw HK HD) L); lra.
  - set (r := Rmin (top_width Rad w) (w - top_width Rad w) / 4).
    assert (R : 0 < r /\ r <= top_width Rad w / 4 /\ r <= (w - top_width Rad w) / 4)
      by (unfold r, Rmin; destruct (Rle_dec _ _); lra).
    destruct (loop_exists _ _ _ _ _ (top_width Rad w / 2) r (top_height Rad w) D (bump_3p_on_top Rad w K) (bump_3p_on_side Rad w K))
      as (p & a & b & c & A & B & Xa & Xb & Xc & Za & Zb & Zc); [lra | | |].
    + intros X Z I. unfold on_top. rewrite Rabs_pos_eq by lra. lra.
    + intros X Z O. unfold on_side. rewrite Rabs_pos_eq by lra. lra.
    + exists p, a, b, c.
      assert (L : loops_about (exact_bump_3p Rad w K) (top_width Rad w / 2) (on_top Rad w) (on_side Rad w) (top_height Rad w) D p a b c).
      { unfold loops_about. rewrite Xa, Xb, Xc, Za, Zb, Zc, Rabs_pos_eq by lra. repeat (split; [assumption || lra|]). lra. }
      split; [exact L|]. apply (proj2 (bump_3p_loop_gives_at_most Rad w K D p a b c HR Hw HK HD) L); lra.
Qed.
