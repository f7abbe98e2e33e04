(* SPDX-License-Identifier: BSD-3-Clause *)
(* Laws that have a potential, everywhere or off the axis of the cylinder, through which a path may go: over a closed path they give no
   energy. docs/energy.md. *)
From Coq Require Import Reals Lra.
From Flocq Require Import Core.
From Forceshade Require Import Laws Work.
Open Scope R_scope.

Definition everywhere (X Z : R) : Prop := True.
Definition off_axis (Rad w X Z : R) : Prop := distance_from_axis Rad w X Z <> 0.
Definition cylinder_energy (Rad w K X Z : R) : R := K * half_square (Rad - distance_from_axis Rad w X Z).
Definition bump_cylinder_energy (Rad w K X Z : R) : R := cylinder_energy Rad w K X Z + plane_energy K 0 X Z.

Theorem wall_is_conservative : forall K, has_potential (exact_wall K) everywhere (plane_energy K 0).
Proof.
  intros K. apply is_potential, plane_has_slope. intros X Z Fx Fz _ A.
  acting A; [rewrite Rmax_left by lra | rewrite Rmax_right by lra]; lra.
Qed.

Theorem bump_1p_is_conservative : forall Rad w K, has_potential (exact_bump_1p Rad w K) everywhere (plane_energy K 0).
Proof. intros Rad w K. exact (wall_is_conservative K). Qed.

Lemma slope_of_distance : forall Rad w p t dx dz, derivable_pt_lim (at_x p) t dx -> derivable_pt_lim (at_z p) t dz ->
  off_axis Rad w (at_x p t) (at_z p t) ->
  derivable_pt_lim (fun t => distance_from_axis Rad w (at_x p t) (at_z p t)) t
    ((at_x p t * dx + (at_z p t + axis_depth Rad w) * dz) / distance_from_axis Rad w (at_x p t) (at_z p t)).
Proof.
  intros Rad w p t dx dz Dx Dz O. unfold off_axis, distance_from_axis in *.
  set (d := axis_depth Rad w) in *.
  set (square := fun t => at_x p t * at_x p t + (at_z p t + d) * (at_z p t + d)).
  assert (S : derivable_pt_lim square t (2 * (at_x p t * dx + (at_z p t + d) * dz))).
  { assert (L : derivable_pt_lim (fun t => at_z p t + d) t (dz + 0))
      by (apply (derivable_pt_lim_plus (at_z p) (fun _ => d)); [exact Dz | apply derivable_pt_lim_const]).
    replace (2 * _) with ((dx * at_x p t + at_x p t * dx) + ((dz + 0) * (at_z p t + d) + (at_z p t + d) * (dz + 0))) by ring.
    apply (derivable_pt_lim_plus (fun t => at_x p t * at_x p t) (fun t => (at_z p t + d) * (at_z p t + d))).
    - apply (derivable_pt_lim_mult (at_x p) (at_x p)); exact Dx.
    - apply (derivable_pt_lim_mult (fun t => at_z p t + d) (fun t => at_z p t + d)); exact L. }
  assert (P : 0 < square t).
  { unfold square. pose proof (Rle_0_sqr (at_x p t)) as A. pose proof (Rle_0_sqr (at_z p t + d)) as B. unfold Rsqr in A, B.
    destruct (Rplus_le_le_0_compat _ _ A B) as [H|H]; [exact H|]. exfalso. apply O. rewrite <- H. apply sqrt_0. }
  apply sqrt_lt_R0 in P as Q.
  replace ((at_x p t * dx + (at_z p t + d) * dz) / _) with (/ (2 * sqrt (square t)) * (2 * (at_x p t * dx + (at_z p t + d) * dz))).
  - apply (derivable_pt_lim_comp square sqrt); [exact S | apply derivable_pt_lim_sqrt; exact P].
  - fold (square t). field. lra.
Qed.

Lemma continuity_of_distance : forall Rad w p, continuity (at_x p) -> continuity (at_z p) ->
  continuity (fun t => distance_from_axis Rad w (at_x p t) (at_z p t)).
Proof.
  intros Rad w p Cx Cz. unfold distance_from_axis. set (d := axis_depth Rad w).
  intros t. apply (continuity_pt_comp (fun t => at_x p t * at_x p t + (at_z p t + d) * (at_z p t + d)) sqrt).
  - assert (L : continuity (fun t => at_z p t + d))
      by (apply (continuity_plus (at_z p) (fun _ => d)); [exact Cz | apply continuity_const; intros u v; reflexivity]).
    apply (continuity_plus (fun t => at_x p t * at_x p t) (fun t => (at_z p t + d) * (at_z p t + d))).
    + apply (continuity_mult (at_x p) (at_x p)); exact Cx.
    + apply (continuity_mult (fun t => at_z p t + d) (fun t => at_z p t + d)); exact L.
  - apply continuity_pt_sqrt. apply Rplus_le_le_0_compat; apply Rle_0_sqr.
Qed.

Lemma continuity_of_cylinder : forall Rad w K p, continuity (at_x p) -> continuity (at_z p) ->
  continuity (fun t => cylinder_energy Rad w K (at_x p t) (at_z p t)).
Proof.
  intros Rad w K p Cx Cz. apply (continuity_of_scaled K (fun t => Rad - distance_from_axis Rad w (at_x p t) (at_z p t))).
  apply (continuity_minus (fun _ => Rad) (fun t => distance_from_axis Rad w (at_x p t) (at_z p t))).
  - apply continuity_const. intros u v. reflexivity.
  - apply continuity_of_distance; assumption.
Qed.

Lemma slope_of_cylinder : forall Rad w K p t dx dz, derivable_pt_lim (at_x p) t dx -> derivable_pt_lim (at_z p) t dz ->
  off_axis Rad w (at_x p t) (at_z p t) ->
  derivable_pt_lim (fun t => cylinder_energy Rad w K (at_x p t) (at_z p t)) t
    (- (cylinder_x Rad w K (at_x p t) (at_z p t) * dx + cylinder_z Rad w K (at_x p t) (at_z p t) * dz)).
Proof.
  intros Rad w K p t dx dz Dx Dz O. pose proof (slope_of_distance Rad w p t dx dz Dx Dz O) as D.
  set (rho := fun t => distance_from_axis Rad w (at_x p t) (at_z p t)) in *.
  set (slope := (at_x p t * dx + (at_z p t + axis_depth Rad w) * dz) / _) in *.
  replace (- _) with (K * (Rmax (Rad - rho t) 0 * (0 - slope))).
  - apply (slope_of_scaled K (fun t => Rad - rho t)).
    apply (derivable_pt_lim_minus (fun _ => Rad) rho); [apply derivable_pt_lim_const | exact D].
  - unfold cylinder_x, cylinder_z, slope. unfold off_axis in O. change (distance_from_axis Rad w (at_x p t) (at_z p t)) with (rho t) in *.
    rewrite Req_bool_false by exact O. destruct (Rlt_dec (rho t) Rad) as [L|L].
    + rewrite Rlt_bool_true, Rmax_left by lra. field. exact O.
    + rewrite Rlt_bool_false, Rmax_right by lra. ring.
Qed.

Lemma cylinder_acts : forall Rad w K X Z Fx Fz, acts (exact_cylinder Rad w K X Z) Fx Fz ->
  Fx = cylinder_x Rad w K X Z /\ Fz = cylinder_z Rad w K X Z.
Proof.
  intros Rad w K X Z Fx Fz [[C [-> ->]]|[C [-> ->]]]; [split; reflexivity|].
  simpl in C. unfold cylinder_x, cylinder_z. rewrite Rlt_bool_false by lra. split; reflexivity.
Qed.

Theorem cylinder_is_conservative : forall Rad w K,
  has_potential (exact_cylinder Rad w K) (off_axis Rad w) (cylinder_energy Rad w K).
Proof.
  intros Rad w K. apply is_potential. split.
  - intros p Cx Cz. apply continuity_of_cylinder; assumption.
  - intros p t dx dz Fx Fz Dx Dz O A. destruct (cylinder_acts Rad w K _ _ _ _ A) as [-> ->]. apply slope_of_cylinder; assumption.
Qed.

Theorem bump_cylinder_is_conservative : forall Rad w K, 0 <= K ->
  has_potential (exact_bump_cylinder Rad w K) (off_axis Rad w) (bump_cylinder_energy Rad w K).
Proof.
  intros Rad w K HK. apply is_potential. split.
  - intros p Cx Cz.
    apply (continuity_plus (fun t => cylinder_energy Rad w K (at_x p t) (at_z p t))
      (fun t => plane_energy K 0 (at_x p t) (at_z p t))).
    + apply continuity_of_cylinder; assumption.
    + apply (continuity_of_plane K 0 (at_z p)). exact Cz.
  - intros p t dx dz Fx Fz Dx Dz O A.
    assert (E : Fx = cylinder_x Rad w K (at_x p t) (at_z p t) /\
      Fz = cylinder_z Rad w K (at_x p t) (at_z p t) + K * Rmax (0 - at_z p t) 0).
    { assert (S : Rmax (- K * at_z p t) 0 = K * Rmax (0 - at_z p t) 0)
        by (rewrite <- RmaxRmult by exact HK; f_equal; ring).
      destruct A as [[C [-> ->]]|[C [-> ->]]]; simpl in C |- *; [rewrite S; split; reflexivity|].
      unfold cylinder_x, cylinder_z. rewrite Rlt_bool_false, Rmax_right by lra. split; ring. }
    destruct E as [-> ->].
    replace (- _) with (- (cylinder_x Rad w K (at_x p t) (at_z p t) * dx + cylinder_z Rad w K (at_x p t) (at_z p t) * dz)
      + - (K * Rmax (0 - at_z p t) 0 * dz)) by ring.
    apply (derivable_pt_lim_plus (fun t => cylinder_energy Rad w K (at_x p t) (at_z p t))
      (fun t => plane_energy K 0 (at_x p t) (at_z p t))).
    + apply slope_of_cylinder; assumption.
    + apply (slope_of_plane K 0 (at_z p)). exact Dz.
Qed.
