(* SPDX-License-Identifier: BSD-3-Clause *)
(* The first stage of cylinder where the force acts, rho < R. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Polygons CylinderForce Cylinder.
Open Scope R_scope.

Definition distance_from_axis (Rad w X Z : R) : R := sqrt (X * X + (Z + axis_depth Rad w) * (Z + axis_depth Rad w)).

(* Inside of the cylinder every answer of the first stage is right, given what the law holds of its depth. *)
Theorem cylinder_first_stage_answers_right_inside :
  forall is_fused R w K anchor anchored rest d_head d_tail axis later x y z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let rho := distance_from_axis (value32 R) (value32 w) X Z in
  rho < value32 R ->
  right_or_later
    (evaluate cylinder_window (cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis) later x y z)
    (later (quantised x) (quantised z)) True
    (value32 K * (value32 R - rho) * (X / rho)) (value32 K * (value32 R - rho) * ((Z + axis_depth (value32 R) (value32 w)) / rho)).
Proof.
  intros is_fused R w K anchor anchored rest d_head d_tail axis later x y z Hp Hd Hv X Z rho Hin.
  destruct (valid_coordinates _ _ _ Hv) as [Hx Hz]. fold X in Hx. fold Z in Hz.
  apply (right_first_stage_gives_right_answers 18); [lia|assumption|]. unfold is_right. intro Hclear.
  unfold cylinder in Hclear. cbv zeta in Hclear. cbn [first_doubt] in Hclear. apply orb_false_elim in Hclear. destruct Hclear as [C1 C2].
  assert (Hne : Z <> value64 axis).
  { destruct Hd as [(_ & _ & _ & _ & Fa) _ _ _ _ _ _ _ _]. rewrite (equal_is _ _ _ _ (coordinate_is _ _ Hz) (conj eq_refl Fa)) in C2.
    revert C2. case Req_bool_spec; [discriminate|trivial]. }
  set (L := Z + axis_depth (value32 R) (value32 w)) in *.
  assert (Hrho2 : rho * rho = X * X + L * L) by (unfold rho, distance_from_axis; fold L; apply sqrt_sqrt; nra).
  assert (Hrho0 : 0 <= rho) by apply sqrt_pos.
  assert (HV : 0 < value32 R * value32 R - (X * X + L * L)) by nra.
  destruct (cylinder_v_is_near is_fused R w K _ _ _ _ _ _ _ X _ Z Hp Hd Hx Hz HV C1) as [Nv Bv].
  pose proof (cylinder_l_is_near R w K _ _ _ _ _ _ _ Z Hp Hd Hz Hne) as Nl. cbv zeta in Nl. fold L in Nl, Nv, Bv.
  rewrite <- Hrho2 in Nv, Bv.
  destruct (cylinder_force_is_near is_fused R w K anchor anchored rest d_head d_tail axis _ X _ L Hp Hx Nv Bv Nl) as (T1 & T2 & T3).
  split; [split; [trivial|intros _; exact T1]|]. intros _. split; assumption.
Qed.
