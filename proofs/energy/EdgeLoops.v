(* SPDX-License-Identifier: BSD-3-Clause *)
(* Energy of the unshaded polygons: each face has a potential, so energy is given only where a path crosses an edge. A loop about an edge,
   out over one face and back over the other, gives the term of docs/energy.md at most, and reaches it. *)
From Coq Require Import Reals Lra.
From Flocq Require Import Core.
From Forceshade Require Import Laws ThreePolygons TwoPolygonsConstants ThreePolygonsFace Work.
Open Scope R_scope.

(* Potential of K (height - slope |x| - z) along the normal of a face: that of a plane, times the cosine. *)
Definition face_energy (K slope height X Z : R) : R := K * cosine_of slope * half_square (height - slope * Rabs X - Z).

Lemma slope_of_face : forall K slope height p t dx dz, derivable_pt_lim (at_x p) t dx -> derivable_pt_lim (at_z p) t dz ->
  at_x p t <> 0 ->
  derivable_pt_lim (fun t => face_energy K slope height (at_x p t) (at_z p t)) t
    (- (K * Rmax (height - slope * Rabs (at_x p t) - at_z p t) 0 *
       ((if Rlt_bool (at_x p t) 0 then - sine_of slope else sine_of slope) * dx + cosine_of slope * dz))).
Proof.
  intros K s h p t dx dz Dx Dz N.
  set (sign := if Rlt_bool (at_x p t) 0 then -1 else 1).
  assert (A : derivable_pt_lim (fun t => Rabs (at_x p t)) t (sign * dx)).
  { apply (derivable_pt_lim_comp (at_x p) Rabs); [exact Dx|]. unfold sign.
    destruct (Rlt_dec (at_x p t) 0) as [L|L];
      [rewrite Rlt_bool_true by lra; apply Rabs_derive_2 | rewrite Rlt_bool_false by lra; apply Rabs_derive_1]; lra. }
  assert (G : derivable_pt_lim (fun t => h - s * Rabs (at_x p t) - at_z p t) t (0 - s * (sign * dx) - dz)).
  { apply (derivable_pt_lim_minus (fun t => h - s * Rabs (at_x p t)) (at_z p)); [|exact Dz].
    apply (derivable_pt_lim_minus (fun _ => h) (fun t => s * Rabs (at_x p t))); [apply derivable_pt_lim_const|].
    apply (derivable_pt_lim_scal (fun t => Rabs (at_x p t))). exact A. }
  replace (- _) with (K * cosine_of s * (Rmax (h - s * Rabs (at_x p t) - at_z p t) 0 * (0 - s * (sign * dx) - dz))).
  - apply (slope_of_scaled (K * cosine_of s) (fun t => h - s * Rabs (at_x p t) - at_z p t)). exact G.
  - unfold sine_of, cosine_of, sign, Rdiv. destruct (Rlt_bool (at_x p t) 0); ring.
Qed.

Lemma continuity_of_face : forall K slope height p, continuity (at_x p) -> continuity (at_z p) ->
  continuity (fun t => face_energy K slope height (at_x p t) (at_z p t)).
Proof.
  intros K s h p Cx Cz. apply (continuity_of_scaled (K * cosine_of s) (fun t => h - s * Rabs (at_x p t) - at_z p t)).
  apply (continuity_minus (fun t => h - s * Rabs (at_x p t)) (at_z p)); [|exact Cz].
  apply (continuity_minus (fun _ => h) (fun t => s * Rabs (at_x p t))); [apply continuity_const; intros u v; reflexivity|].
  apply (continuity_scal (fun t => Rabs (at_x p t))). apply (continuity_comp (at_x p) Rabs); [exact Cx | exact Rcontinuity_abs].
Qed.

(* Laws that are K M along the normal of a face of this slope, M the depth below it. *)
Lemma face_has_slope : forall law K slope height (place : R -> R -> Prop),
  (forall X Z, place X Z -> X <> 0) ->
  (forall X Z Fx Fz, place X Z -> acts (law X Z) Fx Fz -> let M := Rmax (height - slope * Rabs X - Z) 0 in
    Fx = K * M * (if Rlt_bool X 0 then - sine_of slope else sine_of slope) /\ Fz = K * M * cosine_of slope) ->
  has_slope law place (face_energy K slope height).
Proof.
  intros law K s h place N L. split.
  - intros p Cx Cz. apply continuity_of_face; assumption.
  - intros p t dx dz Fx Fz Dx Dz P A. destruct (L _ _ _ _ P A) as [-> ->].
    set (M := Rmax (h - s * Rabs (at_x p t) - at_z p t) 0). set (S := if Rlt_bool (at_x p t) 0 then _ else _).
    replace (- (K * M * S * dx + K * M * cosine_of s * dz)) with (- (K * M * (S * dx + cosine_of s * dz))) by ring.
    apply (slope_of_face K s h p t dx dz Dx Dz). apply (N _ (at_z p t)). exact P.
Qed.

Definition on_bump (w X Z : R) : Prop := X <> 0 /\ Rabs X <= w / 2.
Definition beside_bump (w X Z : R) : Prop := X <> 0 /\ w / 2 < Rabs X.
Definition on_top (Rad w X Z : R) : Prop := X <> 0 /\ Rabs X <= w / 2 /\ Rabs X <= top_width Rad w / 2.
Definition on_side (Rad w X Z : R) : Prop := X <> 0 /\ Rabs X <= w / 2 /\ top_width Rad w / 2 < Rabs X.

Lemma bump_2p_on_bump : forall Rad w K, 0 < w ->
  has_slope (exact_bump_2p Rad w K) (on_bump w) (face_energy K (slope_2p Rad w) (bump_height Rad w)).
Proof.
  intros Rad w K Hw. apply face_has_slope; [intros X Z [N _]; exact N|].
  intros X Z Fx Fz [N I] A M. subst M.
  assert (E : penetration_2p Rad w X Z = bump_height Rad w - slope_2p Rad w * Rabs X - Z)
    by (unfold penetration_2p, slope_2p; rewrite Rle_bool_true by exact I; field; lra).
  acting A; rewrite E in C; rewrite ?E; unfold side_x, side_z; rewrite ?Rle_bool_true by exact I;
    [rewrite Rmax_left by lra | rewrite Rmax_right by lra]; split; ring.
Qed.

Lemma bump_3p_on_side : forall Rad w K, has_slope (exact_bump_3p Rad w K) (on_side Rad w)
  (face_energy K (slope_3p Rad w) (slope_3p Rad w * (w / 2))).
Proof.
  intros Rad w K. apply face_has_slope; [intros X Z [N _]; exact N|].
  intros X Z Fx Fz [N [I T]] A M. subst M.
  assert (E : penetration_3p Rad w X Z = slope_3p Rad w * (w / 2) - slope_3p Rad w * Rabs X - Z)
    by (unfold penetration_3p, slope_3p; rewrite Rle_bool_true by exact I; rewrite Rle_bool_false by exact T; field; lra).
  assert (S : slope_at Rad w X = slope_3p Rad w) by (unfold slope_at; rewrite Rle_bool_false by exact T; reflexivity).
  acting A; rewrite E in C; rewrite ?S, ?E; unfold side_x, side_z; rewrite ?Rle_bool_true by exact I;
    [rewrite Rmax_left by lra | rewrite Rmax_right by lra]; split; ring.
Qed.

Ltac level := destruct flat as [-> ->]; rewrite ?Ropp_0.

Lemma bump_2p_beside : forall Rad w K, has_slope (exact_bump_2p Rad w K) (beside_bump w) (face_energy K 0 0).
Proof.
  intros Rad w K. apply face_has_slope; [intros X Z [N _]; exact N|].
  intros X Z Fx Fz [N O] A M. subst M. level.
  acting A; unfold side_x, side_z, penetration_2p in *; rewrite Rle_bool_false in C by exact O; rewrite ?Rle_bool_false by exact O;
    [rewrite Rmax_left by lra | rewrite Rmax_right by lra]; destruct (Rlt_bool X 0); split; ring.
Qed.

Lemma bump_3p_beside : forall Rad w K, has_slope (exact_bump_3p Rad w K) (beside_bump w) (face_energy K 0 0).
Proof.
  intros Rad w K. apply face_has_slope; [intros X Z [N _]; exact N|].
  intros X Z Fx Fz [N O] A M. subst M. level.
  acting A; unfold side_x, side_z, penetration_3p in *; rewrite Rle_bool_false in C by exact O; rewrite ?Rle_bool_false by exact O;
    [rewrite Rmax_left by lra | rewrite Rmax_right by lra]; destruct (Rlt_bool X 0); split; ring.
Qed.

Lemma bump_3p_on_top : forall Rad w K,
  has_slope (exact_bump_3p Rad w K) (on_top Rad w) (face_energy K 0 (top_height Rad w)).
Proof.
  intros Rad w K. apply face_has_slope; [intros X Z [N _]; exact N|].
  intros X Z Fx Fz [N [I T]] A M. subst M.
  assert (E : penetration_3p Rad w X Z = top_height Rad w - Z)
    by (unfold penetration_3p; rewrite !Rle_bool_true by assumption; reflexivity).
  assert (S : slope_at Rad w X = 0) by (unfold slope_at; rewrite Rle_bool_true by exact T; reflexivity).
  acting A; rewrite E in C; rewrite ?S, ?E; unfold side_x, side_z; rewrite ?Rle_bool_true by exact I; level;
    [rewrite Rmax_left by lra | rewrite Rmax_right by lra]; destruct (Rlt_bool X 0); split; ring.
Qed.

(* Loop about an edge |x| = e: from the edge over one face back to the edge, and over the other to where it began. *)
Lemma loop_about_an_edge : forall law K inner s h outer t k e H p a b c,
  has_slope law inner (face_energy K s h) -> has_slope law outer (face_energy K t k) -> h - s * e = H -> k - t * e = H ->
  follows law inner p a b -> follows law outer p b c -> Rabs (at_x p a) = e -> Rabs (at_x p b) = e ->
  at_x p c = at_x p a -> at_z p c = at_z p a ->
  work p c - work p a = K * (cosine_of t - cosine_of s) * (half_square (H - at_z p b) - half_square (H - at_z p a)).
Proof.
  intros law K inner s h outer t k e H p a b c P Q Eh Ek A B Xa Xb Xc Zc.
  apply (is_potential _ _ _ P) in A. apply (is_potential _ _ _ Q) in B. unfold face_energy in A, B.
  rewrite Xc, Zc in B. rewrite Xa, Xb in A, B. rewrite Eh in A. rewrite Ek in B.
  replace (work p c - work p a) with ((work p b - work p a) + (work p c - work p b)) by ring. rewrite A, B. ring.
Qed.

Lemma depths_give_at_most : forall f D u v, 0 <= f -> u <= D -> v <= D -> 0 <= D ->
  Rabs (f * (half_square u - half_square v)) <= f * (D * D / 2).
Proof.
  assert (B : forall D u, u <= D -> 0 <= D -> 0 <= half_square u <= D * D / 2).
  { intros D u L N. unfold half_square, Rsqr, Rmax. destruct (Rle_dec u 0); split; nra. }
  intros f D u v Hf Hu Hv HD. pose proof (B D u Hu HD). pose proof (B D v Hv HD).
  rewrite Rabs_mult, (Rabs_pos_eq f) by exact Hf. apply Rmult_le_compat_l; [exact Hf|]. apply Rabs_le. lra.
Qed.

(* A+ of docs/energy.md. *)
Definition most_2p (Rad w K D : R) : R := K * (D * D) / 2 * (1 - sqrt ((Rad + axis_depth Rad w) / (2 * Rad))).
Definition most_3p (Rad w K D : R) : R := K * (D * D) / 2 * (top_width Rad w * top_width Rad w / (2 * (Rad * Rad))).

Lemma cosine_2p : forall Rad w, 0 < Rad -> 0 < w <= 2 * Rad ->
  cosine_of (slope_2p Rad w) = sqrt ((Rad + axis_depth Rad w) / (2 * Rad)) /\ cosine_of (slope_2p Rad w) <= 1.
Proof.
  intros Rad w HR Hw. destruct (face_2p Rad w HR Hw) as (HS & _ & _ & _ & E & _). split; [exact E|]. rewrite E, <- sqrt_1 at 1.
  apply sqrt_le_1_alt. apply Rmult_le_reg_r with (2 * Rad); [lra|]. rewrite Rmult_1_l. unfold Rdiv. rewrite Rmult_assoc, Rinv_l; lra.
Qed.

Lemma cosine_3p : forall Rad w, 0 < Rad -> 0 < w <= 2 * Rad ->
  1 - cosine_of (slope_3p Rad w) = top_width Rad w * top_width Rad w / (2 * (Rad * Rad)) /\ cosine_of (slope_3p Rad w) <= 1.
Proof.
  intros Rad w HR Hw. destruct (third_sine_is Rad w HR Hw) as (_ & _ & W & _ & _ & _ & ->). unfold side_cosine.
  set (t := third_sine Rad w) in *. replace (top_width Rad w) with (2 * (Rad * t)) by lra. split; [field; lra | nra].
Qed.

Lemma top_is_narrower : forall Rad w, 0 < Rad -> 0 < w <= 2 * Rad -> top_width Rad w < w.
Proof.
  intros Rad w HR Hw. destruct (third_sine_is Rad w HR Hw) as ([L U] & E & W & _). set (t := third_sine Rad w) in *.
  assert (T : 0 < t) by (apply Rlt_le_trans with (2 := L); apply Rdiv_lt_0_compat; lra).
  assert (V : w = 2 * Rad * (w / (2 * Rad))) by (field; lra). replace (w / (2 * Rad)) with (3 * t - 4 * (t * t * t)) in V by lra.
  assert (P : 0 < Rad * t) by (apply Rmult_lt_0_compat; assumption).
  assert (Q : t * t <= / 2 * / 2) by (apply Rmult_le_compat; lra). apply (Rmult_le_compat_l (Rad * t)) in Q; [|lra].
  replace (2 * Rad * (3 * t - 4 * (t * t * t))) with (6 * (Rad * t) - 8 * (Rad * t * (t * t))) in V by ring. lra.
Qed.

(* The same with no point of the edge deeper than D below the height H. *)
Definition loops_about (law : R -> R -> exact_force) (e : R) (inner outer : R -> R -> Prop) (H D : R) (p : path) (a b c : R) : Prop :=
  follows law inner p a b /\ follows law outer p b c /\ Rabs (at_x p a) = e /\ Rabs (at_x p b) = e /\
  at_x p c = at_x p a /\ at_z p c = at_z p a /\ H - at_z p a <= D /\ H - at_z p b <= D.

Theorem bump_2p_loop_gives_at_most : forall Rad w K D p a b c, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= K -> 0 <= D ->
  loops_about (exact_bump_2p Rad w K) (w / 2) (on_bump w) (beside_bump w) 0 D p a b c ->
  Rabs (work p c - work p a) <= most_2p Rad w K D /\
  (0 <= at_z p a -> at_z p b = - D -> work p c - work p a = most_2p Rad w K D).
Proof.
  intros Rad w K D p a b c HR Hw HK HD (A & B & Xa & Xb & Xc & Zc & Da & Db).
  destruct (cosine_2p Rad w HR Hw) as [E L]. destruct flat as [_ F].
  rewrite (loop_about_an_edge _ K _ _ _ _ _ _ (w / 2) 0 p a b c (bump_2p_on_bump Rad w K ltac:(lra)) (bump_2p_beside Rad w K))
    by (trivial; unfold slope_2p; field; lra).
  unfold most_2p. rewrite F, <- E. split.
  - eapply Rle_trans; [apply (depths_give_at_most _ D); try lra; apply Rmult_le_pos; lra | apply Req_le; field].
  - intros Za Zb. rewrite Zb. unfold half_square. rewrite (Rmax_right (0 - at_z p a)), Rmax_left by lra. unfold Rsqr. field.
Qed.

Theorem bump_3p_loop_gives_at_most : forall Rad w K D p a b c, 0 < Rad -> 0 < w <= 2 * Rad -> 0 <= K -> 0 <= D ->
  (loops_about (exact_bump_3p Rad w K) (w / 2) (on_side Rad w) (beside_bump w) 0 D p a b c ->
   Rabs (work p c - work p a) <= most_3p Rad w K D /\
   (0 <= at_z p a -> at_z p b = - D -> work p c - work p a = most_3p Rad w K D)) /\
  (loops_about (exact_bump_3p Rad w K) (top_width Rad w / 2) (on_top Rad w) (on_side Rad w) (top_height Rad w) D p a b c ->
   Rabs (work p c - work p a) <= most_3p Rad w K D /\
   (top_height Rad w <= at_z p a -> at_z p b = top_height Rad w - D -> work p c - work p a = - most_3p Rad w K D)).
Proof.
  intros Rad w K D p a b c HR Hw HK HD. destruct (cosine_3p Rad w HR Hw) as [E L]. destruct flat as [_ F]. unfold most_3p. rewrite <- E.
  split; intros (A & B & Xa & Xb & Xc & Zc & Da & Db).
  - rewrite (loop_about_an_edge _ K _ _ _ _ _ _ (w / 2) 0 p a b c (bump_3p_on_side Rad w K) (bump_3p_beside Rad w K))
      by (trivial; field). rewrite F. split.
    + eapply Rle_trans; [apply (depths_give_at_most _ D); try lra; apply Rmult_le_pos; lra | apply Req_le; field].
    + intros Za Zb. rewrite Zb. unfold half_square. rewrite (Rmax_right (0 - at_z p a)), Rmax_left by lra. unfold Rsqr. field.
  - assert (G : slope_3p Rad w * (w / 2) - slope_3p Rad w * (top_width Rad w / 2) = top_height Rad w).
    { pose proof (top_is_narrower Rad w HR Hw). unfold slope_3p. field. lra. }
    rewrite (loop_about_an_edge _ K _ _ _ _ _ _ (top_width Rad w / 2) (top_height Rad w) p a b c (bump_3p_on_top Rad w K)
      (bump_3p_on_side Rad w K)) by (trivial; ring). rewrite F. split.
    + set (u := half_square (top_height Rad w - at_z p b)). set (v := half_square (top_height Rad w - at_z p a)).
      set (k := cosine_of (slope_3p Rad w)) in *. replace (K * (k - 1) * (u - v)) with (K * (1 - k) * (v - u)) by ring. subst u v.
      eapply Rle_trans; [apply (depths_give_at_most _ D); try lra; apply Rmult_le_pos; lra | apply Req_le; field].
    + intros Za Zb. rewrite Zb. unfold half_square. rewrite (Rmax_right (_ - at_z p a)), Rmax_left by lra. unfold Rsqr. field.
Qed.
