(* SPDX-License-Identifier: BSD-3-Clause *)
(* Energy of shaded bumps: what a stroke gives that goes down in the middle, out at one depth below the nominal surface, up beyond the
   bump, and back above it. It is A+ less A- of docs/energy.md, in closed form, as reference/energy/bounds.md has it. *)
From Coq Require Import Reals Lra.
From Flocq Require Import Core.
From Forceshade Require Import Laws Work TwoPolygonsConstants ThreePolygonsFace EdgeLoops.
Open Scope R_scope.

(* ---- The area below a circle ---- *)

(* Root in Coq, which is 0 of a negative number. *)
Lemma continuity_of_root : continuity sqrt.
Proof.
  intros x. destruct (Rle_or_lt 0 x) as [P|N]; [apply continuity_pt_sqrt; exact P|].
  apply (continuity_pt_locally_ext (fun _ => 0) sqrt (- x)); [lra | | apply continuity_const; intros u v; reflexivity].
  intros y H. unfold R_dist in H. apply Rabs_def2 in H. symmetry. apply sqrt_neg_0. lra.
Qed.

(* Arcsine, continued by a function that is continuous everywhere. *)
Definition arc (s : R) : R := 2 * atan (s / (1 + sqrt (1 - Rsqr s))).

Lemma arc_is_asin : forall s, -1 <= s <= 1 -> arc s = asin s.
Proof.
  intros s H. unfold arc. rewrite <- cos_asin by exact H. set (a := asin s).
  replace s with (sin a) by (apply sin_asin; exact H). pose proof (asin_bound s) as B. fold a in B. pose proof PI_RGT_0 as P.
  assert (C : 0 < cos (a / 2)) by (apply cos_gt_0; lra).
  replace (sin a / (1 + cos a)) with (tan (a / 2)); [rewrite atan_tan by lra; field|].
  replace (sin a) with (2 * sin (a / 2) * cos (a / 2)) by (rewrite <- sin_2a; f_equal; field).
  replace (1 + cos a) with (2 * cos (a / 2) * cos (a / 2)).
  - unfold tan. field. lra.
  - replace (cos a) with (2 * cos (a / 2) * cos (a / 2) - 1) by (rewrite <- cos_2a_cos; f_equal; field). ring.
Qed.

Lemma slope_of_arc : forall s, -1 < s < 1 -> derivable_pt_lim arc s (1 / sqrt (1 - Rsqr s)).
Proof.
  intros s H. apply (derivable_pt_lim_locally_ext asin arc s (-1) 1); [exact H | intros u U; symmetry; apply arc_is_asin; lra|].
  rewrite <- (derive_pt_asin s H). destruct (derivable_pt_asin s H) as [l D]. exact D.
Qed.

Lemma continuity_of_arc : continuity arc.
Proof.
  apply (continuity_scal (fun s => atan (s / (1 + sqrt (1 - Rsqr s))))).
  apply (continuity_comp (fun s => s / (1 + sqrt (1 - Rsqr s))) atan); [|exact (derivable_continuous atan derivable_pt_atan)].
  apply (continuity_div (fun s => s) (fun s => 1 + sqrt (1 - Rsqr s))).
  - apply derivable_continuous, derivable_id.
  - apply (continuity_plus (fun _ => 1)); [apply continuity_const; intros u v; reflexivity|].
    apply (continuity_comp (fun s => 1 - Rsqr s) sqrt); [|exact continuity_of_root].
    apply (continuity_minus (fun _ => 1) Rsqr); [apply continuity_const; intros u v; reflexivity|].
    apply derivable_continuous. exact derivable_Rsqr.
  - intros s. pose proof (sqrt_pos (1 - Rsqr s)). lra.
Qed.

Definition half_chord (Rad X : R) : R := sqrt (Rsqr Rad - Rsqr X).
(* Area from 0 to X below the circle. *)
Definition area_below (Rad X : R) : R := (X * half_chord Rad X + Rsqr Rad * arc (X / Rad)) / 2.

Lemma continuity_of_chord : forall Rad, continuity (half_chord Rad).
Proof.
  intros Rad. apply (continuity_comp (fun X => Rsqr Rad - Rsqr X) sqrt); [|exact continuity_of_root].
  apply (continuity_minus (fun _ => Rsqr Rad) Rsqr); [apply continuity_const; intros u v; reflexivity|].
  apply derivable_continuous. exact derivable_Rsqr.
Qed.

Lemma continuity_of_area : forall Rad, continuity (area_below Rad).
Proof.
  intros Rad. assert (constant : forall c, continuity (fun _ => c)) by (intros c; apply continuity_const; intros u v; reflexivity).
  assert (id : continuity (fun X => X)) by (apply derivable_continuous, derivable_id).
  apply (continuity_mult (fun X => X * half_chord Rad X + Rsqr Rad * arc (X / Rad)) (fun _ => / 2)); [|apply constant].
  apply (continuity_plus (fun X => X * half_chord Rad X) (fun X => Rsqr Rad * arc (X / Rad))).
  - apply (continuity_mult (fun X => X) (half_chord Rad)); [exact id | apply continuity_of_chord].
  - apply (continuity_scal (fun X => arc (X / Rad))). apply (continuity_comp (fun X => X / Rad) arc); [|exact continuity_of_arc].
    apply (continuity_mult (fun X => X) (fun _ => / Rad)); auto.
Qed.

Lemma chord_is_positive : forall Rad X, - Rad < X < Rad -> 0 < Rsqr Rad - Rsqr X.
Proof. intros Rad X H. unfold Rsqr. assert (0 < (Rad - X) * (Rad + X)) by (apply Rmult_lt_0_compat; lra). lra. Qed.

Lemma slope_of_chord : forall Rad X, - Rad < X < Rad -> derivable_pt_lim (half_chord Rad) X (- X / half_chord Rad X).
Proof.
  intros Rad X H. pose proof (chord_is_positive Rad X H) as P.
  replace (- X / half_chord Rad X) with (/ (2 * sqrt (Rsqr Rad - Rsqr X)) * (0 - 2 * X))
    by (unfold half_chord; field; apply Rgt_not_eq, sqrt_lt_R0; exact P).
  apply (derivable_pt_lim_comp (fun X => Rsqr Rad - Rsqr X) sqrt); [|apply derivable_pt_lim_sqrt; exact P].
  apply (derivable_pt_lim_minus (fun _ => Rsqr Rad) Rsqr); [apply derivable_pt_lim_const | apply derivable_pt_lim_Rsqr].
Qed.

Lemma slope_of_area : forall Rad X, - Rad < X < Rad -> derivable_pt_lim (area_below Rad) X (half_chord Rad X).
Proof.
  intros Rad X H. pose proof (chord_is_positive Rad X H) as P. apply sqrt_lt_R0 in P. fold (half_chord Rad X) in P.
  assert (B : -1 < X / Rad < 1).
  { split; apply Rmult_lt_reg_r with Rad; try lra; unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra; lra. }
  assert (Q : sqrt (1 - Rsqr (X / Rad)) = half_chord Rad X / Rad).
  { unfold half_chord. replace (1 - Rsqr (X / Rad)) with ((Rsqr Rad - Rsqr X) / Rsqr Rad) by (unfold Rsqr; field; lra).
    rewrite sqrt_div_alt by (apply Rlt_0_sqr; lra). rewrite sqrt_Rsqr by lra. reflexivity. }
  assert (square : half_chord Rad X * half_chord Rad X = Rsqr Rad - Rsqr X).
  { apply sqrt_sqrt. apply Rlt_le, chord_is_positive. exact H. }
  pose proof (derivable_pt_lim_mult _ _ _ _ _ (derivable_pt_lim_id X) (slope_of_chord Rad X H)) as M.
  assert (A : derivable_pt_lim (fun X => arc (X / Rad)) X (1 / (half_chord Rad X / Rad) * / Rad)).
  { apply (derivable_pt_lim_comp (fun X => X / Rad) arc); [|rewrite <- Q; apply slope_of_arc; exact B].
    replace (/ Rad) with (1 * / Rad + X * 0) by ring.
    apply (derivable_pt_lim_mult (fun X => X) (fun _ => / Rad)); [apply derivable_pt_lim_id | apply derivable_pt_lim_const]. }
  pose proof (derivable_pt_lim_scal _ (Rsqr Rad) _ _ A) as N.
  pose proof (derivable_pt_lim_scal _ (/ 2) _ _ (derivable_pt_lim_plus _ _ _ _ _ M N)) as E.
  replace (half_chord Rad X) with (/ 2 * (1 * half_chord Rad X + id X * (- X / half_chord Rad X) +
    Rsqr Rad * (1 / (half_chord Rad X / Rad) * / Rad))) at 1.
  - eapply derivable_pt_lim_ext; [|exact E]. intros u. unfold mult_real_fct, plus_fct, mult_fct, id, area_below. field.
  - unfold id. replace (Rsqr Rad) with (half_chord Rad X * half_chord Rad X + X * X) by (rewrite square; unfold Rsqr; ring).
    field. split; lra.
Qed.

(* ---- A way at one depth below a face ---- *)

(* Positions between lo and hi at the depth D below height - slope X. *)
Definition along (lo hi height slope D X Z : R) : Prop := lo < X < hi /\ Z = height - slope * X - D.
Definition along_energy (Rad K height slope D X Z : R) : R :=
  K * D / Rad * (slope * area_below Rad X - X * X / 2) - (Z - (height - slope * X - D)) * (K * D / Rad * half_chord Rad X).

Lemma slope_of_along : forall Rad K height slope D p t dx dz, derivable_pt_lim (at_x p) t dx -> derivable_pt_lim (at_z p) t dz ->
  - Rad < at_x p t < Rad -> at_z p t = height - slope * at_x p t - D ->
  derivable_pt_lim (fun t => along_energy Rad K height slope D (at_x p t) (at_z p t)) t
    (- (K * D * (at_x p t / Rad) * dx + K * D * (half_chord Rad (at_x p t) / Rad) * dz)).
Proof.
  intros Rad K h s D p t dx dz Dx Dz I Z. set (x := at_x p) in *. set (z := at_z p) in *.
  assert (A : derivable_pt_lim (fun t => area_below Rad (x t)) t (half_chord Rad (x t) * dx))
    by (apply (derivable_pt_lim_comp x (area_below Rad)); [exact Dx | apply slope_of_area; exact I]).
  assert (C : derivable_pt_lim (fun t => half_chord Rad (x t)) t (- x t / half_chord Rad (x t) * dx))
    by (apply (derivable_pt_lim_comp x (half_chord Rad)); [exact Dx | apply slope_of_chord; exact I]).
  assert (Q : derivable_pt_lim (fun t => x t * x t) t (dx * x t + x t * dx)) by (apply (derivable_pt_lim_mult x x); exact Dx).
  assert (L : derivable_pt_lim (fun t => z t - (h - s * x t - D)) t (dz - (0 - s * dx - 0))).
  { apply (derivable_pt_lim_minus z); [exact Dz|]. apply (derivable_pt_lim_minus (fun t => h - s * x t) (fun _ => D));
      [|apply derivable_pt_lim_const].
    apply (derivable_pt_lim_minus (fun _ => h) (fun t => s * x t)); [apply derivable_pt_lim_const|].
    apply (derivable_pt_lim_scal x). exact Dx. }
  pose proof (derivable_pt_lim_minus _ _ _ _ _ (derivable_pt_lim_scal _ s _ _ A) (derivable_pt_lim_scal _ (/ 2) _ _ Q)) as U.
  pose proof (derivable_pt_lim_mult _ _ _ _ _ L (derivable_pt_lim_scal _ (K * D / Rad) _ _ C)) as V.
  pose proof (derivable_pt_lim_minus _ _ _ _ _ (derivable_pt_lim_scal _ (K * D / Rad) _ _ U) V) as E.
  match type of E with derivable_pt_lim _ _ ?l => replace (- _) with l end.
  - eapply derivable_pt_lim_ext; [|exact E]. intros u. unfold mult_real_fct, minus_fct, mult_fct, along_energy. field. lra.
  - assert (half_chord Rad (x t) <> 0) by (apply Rgt_not_eq, sqrt_lt_R0, chord_is_positive; exact I).
    unfold mult_real_fct. rewrite Z. field. split; first [assumption | lra].
Qed.

Lemma along_has_slope : forall law Rad K lo hi height slope D, 0 <= lo -> hi <= Rad ->
  (forall X Z Fx Fz, along lo hi height slope D X Z -> acts (law X Z) Fx Fz ->
    Fx = K * D * (X / Rad) /\ Fz = K * D * (half_chord Rad X / Rad)) ->
  has_slope law (along lo hi height slope D) (along_energy Rad K height slope D).
Proof.
  intros law Rad K lo hi h s D Hlo Hhi L. split.
  - intros p Cx Cz.
    assert (constant : forall c, continuity (fun _ => c)) by (intros c; apply continuity_const; intros u v; reflexivity).
    apply (continuity_minus (fun t => K * D / Rad * (s * area_below Rad (at_x p t) - at_x p t * at_x p t / 2))
      (fun t => (at_z p t - (h - s * at_x p t - D)) * (K * D / Rad * half_chord Rad (at_x p t)))).
    + apply (continuity_scal (fun t => s * area_below Rad (at_x p t) - at_x p t * at_x p t / 2)).
      apply (continuity_minus (fun t => s * area_below Rad (at_x p t)) (fun t => at_x p t * at_x p t / 2)).
      * apply (continuity_scal (fun t => area_below Rad (at_x p t))).
        apply (continuity_comp (at_x p)); [exact Cx | apply continuity_of_area].
      * apply (continuity_mult (fun t => at_x p t * at_x p t) (fun _ => / 2)); [|apply constant].
        apply (continuity_mult (at_x p) (at_x p)); exact Cx.
    + apply (continuity_mult (fun t => at_z p t - (h - s * at_x p t - D))).
      * apply (continuity_minus (at_z p)); [exact Cz|]. apply (continuity_minus (fun t => h - s * at_x p t)); [|apply constant].
        apply (continuity_minus (fun _ => h)); [apply constant|]. apply (continuity_scal (at_x p)). exact Cx.
      * apply (continuity_scal (fun t => half_chord Rad (at_x p t))).
        apply (continuity_comp (at_x p)); [exact Cx | apply continuity_of_chord].
  - intros p t dx dz Fx Fz Dx Dz P A. destruct (L _ _ _ _ P A) as [-> ->]. destruct P as [I Z].
    apply slope_of_along; try assumption. lra.
Qed.

(* ---- The stroke ---- *)

(* Way down at x = 0 from above the height H to the depth D, then somehow to the edge at the depth D, up beyond the edge to above the
   plane, and on without contact, as back to the beginning. *)
Definition stroke (law : R -> R -> exact_force) (w H D : R) (p : path) (a b c d e : R) : Prop :=
  follows law (fun X _ => X = 0) p a b /\ follows law (fun X _ => w / 2 < Rabs X) p c d /\
  follows law (fun X Z => ~ in_contact (law X Z)) p d e /\
  H <= at_z p a /\ at_x p b = 0 /\ at_z p b = H - D /\ at_x p c = w / 2 /\ at_z p c = - D /\ 0 <= at_z p d.

Lemma stroke_gives : forall law K w H D p a b c d e,
  has_slope law (fun X _ => X = 0) (plane_energy K H) -> has_slope law (fun X _ => w / 2 < Rabs X) (plane_energy K 0) ->
  0 <= D -> stroke law w H D p a b c d e -> work p e - work p a = work p c - work p b.
Proof.
  intros law K w H D p a b c d e M B HD (A & C & E & Za & Xb & Zb & Xc & Zc & Zd).
  apply (is_potential _ _ _ M) in A. apply (is_potential _ _ _ B) in C.
  apply (is_potential _ _ _ (no_contact_gives_nothing law)) in E.
  replace (work p e - work p a)
    with (work p b - work p a + (work p c - work p b) + (work p d - work p c) + (work p e - work p d)) by ring.
  rewrite A, C, E, Zb, Zc. unfold plane_energy, half_square.
  rewrite (Rmax_right (H - at_z p a)), (Rmax_right (0 - at_z p d)), !Rmax_left by lra. unfold Rsqr. field.
Qed.

(* Shaded laws over the bump, in its middle, and beside it. *)
Lemma shaded_acts : forall law Rad w K (touches : R -> R -> Prop) penetration,
  (forall X Z, law X Z = let M := penetration X Z in force (touches X Z) (shaded_x Rad w K X M) (shaded_z Rad w K X M)) ->
  (forall X Z, touches X Z <-> 0 < penetration X Z) ->
  (forall X Z D Fx Fz, Rabs X <= w / 2 -> penetration X Z = D -> 0 <= D -> acts (law X Z) Fx Fz ->
    Fx = K * D * (X / Rad) /\ Fz = K * D * (half_chord Rad X / Rad)) /\
  (forall H, 0 < Rad -> 0 < w -> (forall Z, penetration 0 Z = H - Z) ->
    has_slope law (fun X _ => X = 0) (plane_energy K H)) /\
  ((forall X Z, w / 2 < Rabs X -> penetration X Z = - Z) -> has_slope law (fun X _ => w / 2 < Rabs X) (plane_energy K 0)).
Proof.
  intros law Rad w K touches penetration L T. split; [|split].
  - intros X Z D Fx Fz I M HD A. rewrite L in A. acting A; rewrite T in C; rewrite M in *.
    + unfold shaded_x, shaded_z. rewrite Rle_bool_true by exact I. split; reflexivity.
    + replace D with 0 by lra. split; ring.
  - intros H HR Hw P. apply plane_has_slope. intros X Z Fx Fz -> A. rewrite L in A. acting A; rewrite T in C; rewrite P in *.
    + unfold shaded_x, shaded_z. rewrite Rabs_R0, Rle_bool_true, Rmax_left by lra.
      replace (Rsqr Rad - Rsqr 0) with (Rsqr Rad) by (unfold Rsqr; ring). rewrite sqrt_Rsqr by lra. split; field; lra.
    + rewrite Rmax_right by lra. lra.
  - intros P. apply plane_has_slope. intros X Z Fx Fz O A. rewrite L in A.
    acting A; rewrite T, P in C by exact O; rewrite ?P by exact O.
    + unfold shaded_x, shaded_z. rewrite Rle_bool_false, Rmax_left by lra. lra.
    + rewrite Rmax_right by lra. lra.
Qed.

(* Angle alpha of docs/laws.md. *)
Definition half_angle (Rad w : R) : R := asin (w / (2 * Rad)).

Lemma area_to_edge : forall Rad w, 0 < Rad -> 0 < w <= 2 * Rad ->
  area_below Rad (w / 2) = (w / 2 * axis_depth Rad w + Rsqr Rad * half_angle Rad w) / 2.
Proof.
  intros Rad w HR Hw. unfold area_below, half_angle, axis_depth, half_chord. rewrite arc_is_asin.
  - replace (w / 2 / Rad) with (w / (2 * Rad)) by (field; lra). reflexivity.
  - split; apply Rmult_le_reg_r with Rad; try lra; replace (w / 2 / Rad * Rad) with (w / 2) by (field; lra); lra.
Qed.

Lemma area_to_middle : forall Rad, 0 < Rad -> area_below Rad 0 = 0.
Proof.
  intros Rad HR. unfold area_below. rewrite arc_is_asin; replace (0 / Rad) with 0 by (field; lra); [rewrite asin_0; field | lra].
Qed.

Theorem bump_1p_shaded_stroke_gives : forall Rad w K D p a b c d e, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= D ->
  let law := exact_bump_1p_shaded Rad w K in
  stroke law w 0 D p a b c d e -> follows law (along 0 (w / 2) 0 0 D) p b c ->
  work p e - work p a = K * D / Rad * (w * w / 8).
Proof.
  intros Rad w K D p a b c d e HR Hw HD law S A.
  destruct (shaded_acts law Rad w K (fun _ Z => Z < 0) (fun _ Z => - Z)) as (over & middle & beside); [reflexivity | intros; lra|].
  rewrite (stroke_gives law K w 0 D p a b c d e); [| | | exact HD | exact S].
  - destruct S as (_ & _ & _ & _ & Xb & Zb & Xc & Zc & _).
    apply (is_potential _ _ (along_energy Rad K 0 0 D)) in A; [|apply along_has_slope; [lra | lra|]].
    + rewrite A, Xb, Zb, Xc, Zc. unfold along_energy. rewrite area_to_middle by lra. field. lra.
    + intros X Z Fx Fz [I E]. apply over; [rewrite Rabs_pos_eq by lra; lra | lra | exact HD].
  - apply middle; [lra | lra | intros; lra].
  - apply beside. reflexivity.
Qed.

Theorem bump_2p_shaded_stroke_gives : forall Rad w K D p a b c d e, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= D ->
  let law := exact_bump_2p_shaded Rad w K in
  stroke law w (bump_height Rad w) D p a b c d e -> follows law (along 0 (w / 2) (bump_height Rad w) (slope_2p Rad w) D) p b c ->
  work p e - work p a = K * D / Rad *
    (w * w / 8 - slope_2p Rad w / 2 * (w / 2 * axis_depth Rad w + Rsqr Rad * half_angle Rad w)).
Proof.
  intros Rad w K D p a b c d e HR Hw HD law S A.
  destruct (shaded_acts law Rad w K (fun X Z => 0 < penetration_2p Rad w X Z) (penetration_2p Rad w)) as (over & middle & beside);
    [reflexivity | reflexivity|].
  assert (F : forall X Z, 0 <= X <= w / 2 -> penetration_2p Rad w X Z = bump_height Rad w - slope_2p Rad w * X - Z).
  { intros X Z I. unfold penetration_2p, slope_2p. rewrite Rabs_pos_eq, Rle_bool_true by lra. field. lra. }
  rewrite (stroke_gives law K w (bump_height Rad w) D p a b c d e); [| | | exact HD | exact S].
  - destruct S as (_ & _ & _ & _ & Xb & Zb & Xc & Zc & _).
    apply (is_potential _ _ (along_energy Rad K (bump_height Rad w) (slope_2p Rad w) D)) in A;
      [|apply along_has_slope; [lra | lra|]].
    + rewrite A, Xb, Zb, Xc, Zc. unfold along_energy. rewrite area_to_middle, area_to_edge by lra. unfold slope_2p. field. lra.
    + intros X Z Fx Fz [I E]. apply over; [rewrite Rabs_pos_eq by lra; lra | rewrite F by lra; lra | exact HD].
  - apply middle; [lra | lra | intros; rewrite F by lra; ring].
  - apply beside. intros X Z O. unfold penetration_2p. rewrite Rle_bool_false by exact O. reflexivity.
Qed.

(* Two parts of the way, on the top and on the side: at m it is at the edge of the top. *)
Theorem bump_3p_shaded_stroke_gives : forall Rad w K D p a b m c d e, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= D ->
  let law := exact_bump_3p_shaded Rad w K in let half_top := top_width Rad w / 2 in
  stroke law w (top_height Rad w) D p a b c d e -> follows law (along 0 half_top (top_height Rad w) 0 D) p b m ->
  at_x p m = half_top -> at_z p m = top_height Rad w - D ->
  follows law (along half_top (w / 2) (slope_3p Rad w * (w / 2)) (slope_3p Rad w) D) p m c ->
  work p e - work p a = K * D / Rad * (w * w / 8 - slope_3p Rad w / 2 *
    (w / 2 * axis_depth Rad w + Rsqr Rad * theta Rad w - half_top * sqrt (Rsqr Rad - Rsqr half_top))).
Proof.
  intros Rad w K D p a b m c d e HR Hw HD law half_top S T Xm Zm A.
  destruct (shaded_acts law Rad w K (fun X Z => 0 < penetration_3p Rad w X Z) (penetration_3p Rad w)) as (over & middle & beside);
    [reflexivity | reflexivity|].
  pose proof (top_is_narrower Rad w HR Hw) as N.
  destruct (third_sine_is Rad w HR Hw) as ([L U] & _ & W & _). fold half_top in W.
  assert (P : 0 < half_top).
  { rewrite W. apply Rmult_lt_0_compat; [exact HR|]. apply Rlt_le_trans with (2 := L). apply Rdiv_lt_0_compat; lra. }
  assert (on_the_top : forall X Z, 0 <= X <= half_top -> penetration_3p Rad w X Z = top_height Rad w - Z).
  { intros X Z I. unfold penetration_3p. fold half_top. rewrite Rabs_pos_eq, !Rle_bool_true by (unfold half_top in *; lra). reflexivity. }
  assert (on_the_side : forall X Z, half_top < X <= w / 2 ->
    penetration_3p Rad w X Z = slope_3p Rad w * (w / 2) - slope_3p Rad w * X - Z).
  { intros X Z I. unfold penetration_3p, slope_3p. fold half_top. rewrite Rabs_pos_eq by lra.
    rewrite Rle_bool_true, Rle_bool_false by lra. field. unfold half_top in *. lra. }
  assert (edge : slope_3p Rad w * (w / 2) - slope_3p Rad w * half_top = top_height Rad w)
    by (unfold slope_3p; fold half_top; field; unfold half_top in *; lra).
  rewrite (stroke_gives law K w (top_height Rad w) D p a b c d e); [| | | exact HD | exact S].
  - destruct S as (_ & _ & _ & _ & Xb & Zb & Xc & Zc & _).
    apply (is_potential _ _ (along_energy Rad K (top_height Rad w) 0 D)) in T;
      [|apply along_has_slope; [lra | unfold half_top in *; lra|]].
    apply (is_potential _ _ (along_energy Rad K (slope_3p Rad w * (w / 2)) (slope_3p Rad w) D)) in A;
      [|apply along_has_slope; [lra | lra|]].
    + replace (work p c - work p b) with (work p m - work p b + (work p c - work p m)) by ring.
      rewrite T, A, Xb, Zb, Xc, Zc, Xm, Zm. unfold along_energy. rewrite area_to_middle, area_to_edge by lra.
      rewrite <- edge. unfold area_below at 2, half_chord.
      assert (Q : arc (half_top / Rad) = half_angle Rad w - theta Rad w).
      { rewrite W. replace (Rad * third_sine Rad w / Rad) with (third_sine Rad w) by (field; lra).
        assert (B : 0 < third_sine Rad w) by (apply Rlt_le_trans with (2 := L); apply Rdiv_lt_0_compat; lra).
        rewrite arc_is_asin by lra. pose proof (asin_bound (w / (2 * Rad))). pose proof PI_RGT_0.
        unfold third_sine, third_angle. rewrite asin_sin by lra. unfold half_angle, theta. field. }
      rewrite Q. field. lra.
    + intros X Z Fx Fz [I E]. apply over; [rewrite Rabs_pos_eq by lra; lra | rewrite on_the_side by lra; lra | exact HD].
    + intros X Z Fx Fz [I E].
      apply over; [rewrite Rabs_pos_eq by lra; unfold half_top in *; lra | rewrite on_the_top by lra; lra | exact HD].
  - apply middle; [lra | lra | intros; rewrite on_the_top by lra; ring].
  - apply beside. intros X Z O. unfold penetration_3p. rewrite Rle_bool_false by exact O. reflexivity.
Qed.
