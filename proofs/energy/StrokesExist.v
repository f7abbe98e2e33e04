(* SPDX-License-Identifier: BSD-3-Clause *)
(* Strokes over each shaded bump exist, and end where they began: straight ways do. *)
From Coq Require Import Reals Lra.
From Flocq Require Import Core.
From Forceshade Require Import Laws Work Paths TwoPolygonsConstants ThreePolygonsFace EdgeLoops Strokes.
Open Scope R_scope.

(* Stroke around a way q from (0, H - D) to (w/2, -D). *)
Lemma stroke_exists : forall law K w H D q c, 0 < w -> 0 <= H -> has_slope law (fun X _ => X = 0) (plane_energy K H) ->
  has_slope law (fun X _ => w / 2 < Rabs X) (plane_energy K 0) -> (forall X, ~ in_contact (law X H)) ->
  continuous q -> 1 <= c -> at_x q 1 = 0 -> at_z q 1 = H - D -> at_x q c = w / 2 -> at_z q c = - D ->
  exists p, stroke law w H D p 0 1 c (c + 1) (c + 1 + 1) /\ at_x p (c + 1 + 1) = at_x p 0 /\ at_z p (c + 1 + 1) = at_z p 0 /\
    (forall place a b, 1 <= a -> b <= c -> follows law place q a b -> follows law place p a b) /\
    (forall t, 1 <= t <= c -> at_x p t = at_x q t /\ at_z p t = at_z q t).
Proof.
  intros law K w H D q c Hw HH M B N Q L X1 Z1 Xc Zc.
  set (down := line (plane_energy K H) 0 0 H 0 (H - D)). set (up := line (plane_energy K 0) c (w / 2) (- D) (w / 2 + 1) H).
  set (back := line (fun _ _ => 0) (c + 1) (w / 2 + 1) H 0 H).
  assert (Fd : follows law (fun X _ => X = 0) down 0 (0 + 1)) by (apply line_follows; [exact M | intros; lra]).
  assert (Fu : follows law (fun X _ => w / 2 < Rabs X) up c (c + 1))
    by (apply line_follows; [exact B | intros s T; rewrite Rabs_pos_eq by lra; lra]).
  assert (Fb : follows law (fun X Z => ~ in_contact (law X Z)) back (c + 1) (c + 1 + 1)).
  { apply line_follows; [apply no_contact_gives_nothing|]. intros s T. replace (H + s * (H - H)) with H by ring. apply N. }
  rewrite Rplus_0_l in Fd.
  set (p1 := joined 1 down q). set (p2 := joined c p1 up).
  assert (C1 : continuous p1) by (apply continuous_joined; [exact (proj1 (proj2 Fd)) | exact Q]).
  assert (C2 : continuous p2) by (apply continuous_joined; [exact C1 | exact (proj1 (proj2 Fu))]).
  assert (Eq : at_x down 1 = at_x q 1 /\ at_z down 1 = at_z q 1) by (cbn; split; lra).
  assert (E1 : forall t, 1 <= t -> at_x p1 t = at_x q t /\ at_z p1 t = at_z q t)
    by (intros t T; cbn [p1 joined at_x at_z]; rewrite !then_after by (trivial; lra || tauto); split; reflexivity).
  assert (Eu : meet c p1 up) by (destruct (E1 c L) as [X Z]; split; [rewrite X, Xc | rewrite Z, Zc]; cbn; lra).
  assert (E2 : at_x p2 (c + 1) = w / 2 + 1 /\ at_z p2 (c + 1) = H)
    by (destruct Eu as [X Z]; cbn [p2 joined at_x at_z]; rewrite !then_after by (trivial; lra); cbn; split; lra).
  assert (Eb : meet (c + 1) p2 back) by (destruct E2 as [X Z]; split; [rewrite X | rewrite Z]; cbn; lra).
  exists (joined (c + 1) p2 back).
  assert (E : forall t, 1 <= t <= c ->
    at_x (joined (c + 1) p2 back) t = at_x q t /\ at_z (joined (c + 1) p2 back) t = at_z q t).
  { intros t T. destruct (E1 t (proj1 T)) as [X Z]. cbn [joined at_x at_z]. rewrite !(then_before (c + 1)) by lra.
    cbn [p2 joined at_x at_z]. rewrite !(then_before c) by lra. split; assumption. }
  assert (start : at_x (joined (c + 1) p2 back) 0 = 0 /\ at_z (joined (c + 1) p2 back) 0 = H).
  { cbn [joined at_x at_z]. rewrite !(then_before (c + 1)) by lra. cbn [p2 joined at_x at_z]. rewrite !(then_before c) by lra.
    cbn [p1 joined at_x at_z]. rewrite !(then_before 1) by lra. cbn. split; lra. }
  assert (finish : at_x (joined (c + 1) p2 back) (c + 1 + 1) = 0 /\ at_z (joined (c + 1) p2 back) (c + 1 + 1) = H).
  { destruct Eb as [X Z]. cbn [joined at_x at_z]. rewrite !then_after by (trivial; lra). cbn. split; lra. }
  assert (Fp : forall place a b, 1 <= a -> b <= c -> follows law place q a b -> follows law place (joined (c + 1) p2 back) a b).
  { intros place a b A G F. apply joined_before; [lra | exact (proj1 (proj2 Fb))|].
    apply joined_before; [lra | exact (proj1 (proj2 Fu))|].
    apply joined_after; [exact A | exact (proj1 (proj2 Fd)) | exact Eq | exact F]. }
  split; [|split; [|split; [|split; [exact Fp | exact E]]]]; [|destruct start, finish; congruence | destruct start, finish; congruence].
  destruct (E 1 ltac:(lra)) as [Xb Zb]. destruct (E c ltac:(lra)) as [Xe Ze].
  split; [|split; [|split]].
  - apply joined_before; [lra | exact (proj1 (proj2 Fb))|]. apply joined_before; [lra | exact (proj1 (proj2 Fu))|].
    apply joined_before; [lra | exact Q | exact Fd].
  - apply joined_before; [lra | exact (proj1 (proj2 Fb))|]. apply joined_after; [lra | exact C1 | exact Eu | exact Fu].
  - apply joined_after; [lra | exact C2 | exact Eb | exact Fb].
  - rewrite Xb, Zb, Xe, Ze, (proj2 start). cbn [joined at_z]. rewrite then_before by lra. rewrite (proj2 E2). repeat split; trivial; lra.
Qed.

Lemma height_is_not_negative : forall Rad w, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= bump_height Rad w.
Proof.
  intros Rad w HR Hw. destruct (face_2p Rad w HR Hw) as (HS & _ & _ & -> & _).
  apply Rmult_le_pos; [|lra]. apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra].
Qed.

Theorem bump_1p_shaded_stroke_exists : forall Rad w K D, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= D ->
  let law := exact_bump_1p_shaded Rad w K in
  exists p a b c d e, stroke law w 0 D p a b c d e /\ follows law (along 0 (w / 2) 0 0 D) p b c /\
    at_x p e = at_x p a /\ at_z p e = at_z p a.
Proof.
  intros Rad w K D HR Hw HD law.
  destruct (shaded_acts law Rad w K (fun _ Z => Z < 0) (fun _ Z => - Z)) as (over & middle & beside); [reflexivity | intros; lra|].
  set (q := line (along_energy Rad K 0 0 D) 1 0 (0 - D) (w / 2) (- D)).
  assert (F : follows law (along 0 (w / 2) 0 0 D) q 1 (1 + 1)).
  { apply line_follows; [|intros s T; unfold along; split; [nra | ring]]. apply along_has_slope; [lra | lra|].
    intros X Z Fx Fz [I E]. apply over; [rewrite Rabs_pos_eq by lra; lra | lra | exact HD]. }
  destruct (stroke_exists law K w 0 D q (1 + 1)) as (p & S & X & Z & A & _); try (cbn; lra).
  - apply middle; [lra | lra | intros; lra].
  - apply beside. reflexivity.
  - intros X. cbn. lra.
  - exact (proj1 (proj2 F)).
  - exists p, 0, 1, (1 + 1), (1 + 1 + 1), (1 + 1 + 1 + 1). split; [exact S | split; [|split; assumption]].
    apply A; [lra | lra | exact F].
Qed.

Theorem bump_2p_shaded_stroke_exists : forall Rad w K D, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= D ->
  let law := exact_bump_2p_shaded Rad w K in let h := bump_height Rad w in
  exists p a b c d e, stroke law w h D p a b c d e /\ follows law (along 0 (w / 2) h (slope_2p Rad w) D) p b c /\
    at_x p e = at_x p a /\ at_z p e = at_z p a.
Proof.
  intros Rad w K D HR Hw HD law h. pose proof (height_is_not_negative Rad w HR Hw) as Hh. fold h in Hh.
  destruct (shaded_acts law Rad w K (fun X Z => 0 < penetration_2p Rad w X Z) (penetration_2p Rad w)) as (over & middle & beside);
    [reflexivity | reflexivity|].
  assert (P : forall X Z, 0 <= X <= w / 2 -> penetration_2p Rad w X Z = h - slope_2p Rad w * X - Z).
  { intros X Z I. unfold penetration_2p, slope_2p. fold h. rewrite Rabs_pos_eq, Rle_bool_true by lra. field. lra. }
  set (q := line (along_energy Rad K h (slope_2p Rad w) D) 1 0 (h - D) (w / 2) (- D)).
  assert (F : follows law (along 0 (w / 2) h (slope_2p Rad w) D) q 1 (1 + 1)).
  { apply line_follows; [|intros s T; unfold along; split; [nra | unfold slope_2p; fold h; field; lra]].
    apply along_has_slope; [lra | lra|].
    intros X Z Fx Fz [I E]. apply over; [rewrite Rabs_pos_eq by lra; lra | rewrite P by lra; lra | exact HD]. }
  destruct (stroke_exists law K w h D q (1 + 1)) as (p & S & X & Z & A & _); try (cbn; lra).
  - apply middle; [lra | lra | intros; rewrite P by lra; ring].
  - apply beside. intros X Z O. unfold penetration_2p. rewrite Rle_bool_false by exact O. reflexivity.
  - intros X. cbn. unfold penetration_2p. fold h. case Rle_bool_spec; intros I; [|lra].
    replace (h * (1 - 2 * Rabs X / w) - h) with (- (h * Rabs X * (2 / w))) by (field; lra).
    assert (0 <= h * Rabs X * (2 / w)); [|lra].
    apply Rmult_le_pos; [apply Rmult_le_pos; [exact Hh | apply Rabs_pos]|].
    apply Rmult_le_pos; [lra | apply Rlt_le, Rinv_0_lt_compat; lra].
  - exact (proj1 (proj2 F)).
  - exists p, 0, 1, (1 + 1), (1 + 1 + 1), (1 + 1 + 1 + 1). split; [exact S | split; [|split; assumption]].
    apply A; [lra | lra | exact F].
Qed.

Theorem bump_3p_shaded_stroke_exists : forall Rad w K D, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= D ->
  let law := exact_bump_3p_shaded Rad w K in let half_top := top_width Rad w / 2 in let h := top_height Rad w in
  exists p a b m c d e, stroke law w h D p a b c d e /\ follows law (along 0 half_top h 0 D) p b m /\
    at_x p m = half_top /\ at_z p m = h - D /\
    follows law (along half_top (w / 2) (slope_3p Rad w * (w / 2)) (slope_3p Rad w) D) p m c /\
    at_x p e = at_x p a /\ at_z p e = at_z p a.
Proof.
  intros Rad w K D HR Hw HD law half_top h.
  destruct (shaded_acts law Rad w K (fun X Z => 0 < penetration_3p Rad w X Z) (penetration_3p Rad w)) as (over & middle & beside);
    [reflexivity | reflexivity|].
  pose proof (top_is_narrower Rad w HR Hw) as N.
  destruct (third_sine_is Rad w HR Hw) as ([L U] & _ & W & Eh & Es & _). fold half_top in W.
  set (t := third_sine Rad w) in *.
  assert (T0 : 0 < t) by (apply Rlt_le_trans with (2 := L); apply Rdiv_lt_0_compat; lra).
  assert (P0 : 0 < half_top) by (rewrite W; apply Rmult_lt_0_compat; assumption).
  assert (Ss : 0 <= side_sine t) by (unfold side_sine; apply Rmult_le_pos; [lra | apply sqrt_pos]).
  assert (Sl : 0 <= slope_3p Rad w).
  { rewrite Es. apply Rmult_le_pos; [exact Ss|]. apply Rlt_le, Rinv_0_lt_compat. unfold side_cosine. nra. }
  assert (edge : slope_3p Rad w * (w / 2) - slope_3p Rad w * half_top = h)
    by (unfold slope_3p; fold half_top; fold h; field; unfold half_top in *; lra).
  assert (Hh : 0 <= h) by (unfold half_top in *; nra).
  assert (on_the_top : forall X Z, 0 <= X <= half_top -> penetration_3p Rad w X Z = h - Z).
  { intros X Z I. unfold penetration_3p. fold half_top h. rewrite Rabs_pos_eq, !Rle_bool_true by (unfold half_top in *; lra). reflexivity. }
  assert (on_the_side : forall X Z, half_top < Rabs X <= w / 2 ->
    penetration_3p Rad w X Z = slope_3p Rad w * (w / 2) - slope_3p Rad w * Rabs X - Z).
  { intros X Z I. unfold penetration_3p, slope_3p. fold half_top. rewrite Rle_bool_true, Rle_bool_false by lra.
    field. unfold half_top in *. lra. }
  set (q1 := line (along_energy Rad K h 0 D) 1 0 (h - D) half_top (h - D)).
  set (q2 := line (along_energy Rad K (slope_3p Rad w * (w / 2)) (slope_3p Rad w) D) (1 + 1) half_top (h - D) (w / 2) (- D)).
  assert (F1 : follows law (along 0 half_top h 0 D) q1 1 (1 + 1)).
  { apply line_follows; [|intros s T; unfold along; split; [nra | ring]]. apply along_has_slope; [lra | unfold half_top in *; lra|].
    intros X Z Fx Fz [I E].
    apply over; [rewrite Rabs_pos_eq by lra; unfold half_top in *; lra | rewrite on_the_top by lra; lra | exact HD]. }
  assert (F2 : follows law (along half_top (w / 2) (slope_3p Rad w * (w / 2)) (slope_3p Rad w) D) q2 (1 + 1) (1 + 1 + 1)).
  { apply line_follows; [|intros s T; unfold along; split; [unfold half_top in *; nra | rewrite <- edge; ring]].
    apply along_has_slope; [lra | lra|]. intros X Z Fx Fz [I E].
    apply over; [rewrite Rabs_pos_eq by lra; lra | rewrite on_the_side by (rewrite Rabs_pos_eq by lra; lra) | exact HD].
    rewrite Rabs_pos_eq by lra. lra. }
  assert (M : meet (1 + 1) q1 q2) by (split; cbn; lra).
  set (q := joined (1 + 1) q1 q2).
  assert (E1 : at_x q 1 = 0 /\ at_z q 1 = h - D) by (cbn [q joined at_x at_z]; rewrite !then_before by lra; cbn; split; lra).
  assert (E2 : at_x q (1 + 1) = half_top /\ at_z q (1 + 1) = h - D)
    by (cbn [q joined at_x at_z]; rewrite !then_before by lra; cbn; split; lra).
  assert (E3 : at_x q (1 + 1 + 1) = w / 2 /\ at_z q (1 + 1 + 1) = - D)
    by (destruct M as [X Z]; cbn [q joined at_x at_z]; rewrite !then_after by (trivial; lra); cbn; split; lra).
  destruct (stroke_exists law K w h D q (1 + 1 + 1)) as (p & S & X & Z & A & B); try tauto; try lra.
  - apply middle; [lra | lra | intros; rewrite on_the_top by lra; ring].
  - apply beside. intros X Z O. unfold penetration_3p. rewrite Rle_bool_false by exact O. reflexivity.
  - intros X. cbn. destruct (Rle_dec (Rabs X) half_top) as [I|I]; [|destruct (Rle_dec (Rabs X) (w / 2)) as [J|J]].
    + unfold penetration_3p. fold half_top h. rewrite !Rle_bool_true by (unfold half_top in *; lra). lra.
    + rewrite on_the_side by lra.
      assert (slope_3p Rad w * half_top <= slope_3p Rad w * Rabs X) by (apply Rmult_le_compat_l; lra). lra.
    + unfold penetration_3p. rewrite Rle_bool_false by lra. lra.
  - apply continuous_joined; [exact (proj1 (proj2 F1)) | exact (proj1 (proj2 F2))].
  - exists p, 0, 1, (1 + 1), (1 + 1 + 1), (1 + 1 + 1 + 1), (1 + 1 + 1 + 1 + 1). destruct (B (1 + 1) ltac:(lra)) as [Xm Zm].
    split; [exact S|]. split; [apply A; [lra | lra|]; apply joined_before; [lra | exact (proj1 (proj2 F2)) | exact F1]|].
    split; [rewrite Xm; tauto|]. split; [rewrite Zm; tauto|].
    split; [apply A; [lra | lra|]; apply joined_after; [lra | exact (proj1 (proj2 F1)) | exact M | exact F2] | split; assumption].
Qed.
