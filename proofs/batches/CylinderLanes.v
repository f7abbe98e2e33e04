(* SPDX-License-Identifier: BSD-3-Clause *)
(* The forms of a batch of cylinder and bump-cylinder: what the watch lets pass is right, for all inputs of the domain. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Relative BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Wall Gap Polygons DoubleDouble Depth Split
  ErrorFree.
From Forceshade Require Import CylinderForce CylinderFirst CylinderAnswers CylinderConstants SecondAlong.
From Forceshade Require Import Lanes RecordedForms LaneAnswers BumpLanes Batch PolygonLanes CylinderLaneSums CylinderLaneV
  CylinderLaneRough CylinderLaneRoughForm CylinderLaneStep CylinderLaneScale CylinderLaneForce CylinderLaneParts.
Import ListNotations.
Open Scope R_scope.

Section Lane.
Context (set : instruction_set) (R w K x z : binary32) (anchor anchored rest d_head d_tail axis : binary64) (Hp : parameters R w K)
  (Dp : depth R w anchor anchored rest d_head d_tail axis) (Ax : is32 (to32 axis) (value64 axis)).
Local Notation X := (value32 x).
Local Notation Z := (value32 z).
Local Notation half := (square_root (plus (minus anchored anchor) rest)).
Local Notation v := (v_form half d_head d_tail (to64 x) (to64 z)).
Local Notation S := (larger (scale_form K R v (to64 (rough_form R (to32 v)))) zero64).
Local Notation rho := (distance_from_axis (value32 R) (value32 w) X Z).
Local Notation least := (greatest32 quantum (to32 (times (two_to (-27)) (greatest half d_head)))).

Lemma cylinder_coordinates :
  (forall a, In a [absolute32 z; absolute32 x] -> is_large a = false) ->
  (forall a, In a [absolute32 z; absolute32 x] -> is_tiny set least a = false) ->
  in_range x /\ in_range z /\ coordinate (to64 x) X /\ coordinate (to64 z) Z /\ read X = X /\ read Z = Z /\
  watched (value32 w / 2) (value64 d_head) X /\ watched (value32 w / 2) (value64 d_head) Z.
Proof.
  intros A B. pose proof (half_from_depth R w K _ _ _ _ _ _ Hp Dp) as Ic. pose proof Hp as (_ & HR & Hw & _).
  destruct Dp as [(_ & _ & Fh & _) _ _ _ _ Rh _ _ _].
  destruct (least_of_depth half d_head _ _ Ic (conj eq_refl Fh) ltac:(lra) Rh) as (l & Il & L1 & L2).
  destruct (watched_coordinate set least l x Il L1 (A (absolute32 x) ltac:(in_list)) (B (absolute32 x) ltac:(in_list))) as (Hx & Cx & Ex &
    Tx).
  destruct (watched_coordinate set least l z Il L1 (A (absolute32 z) ltac:(in_list)) (B (absolute32 z) ltac:(in_list))) as (Hz & Cz & Ez &
    Tz).
  repeat (split; [assumption|]).
  split; [destruct Tx as [T|T]|destruct Tz as [T|T]]; try (now left); right; intros k Hk Hb; apply Rle_trans with (2 := T); now apply L2.
Qed.

Lemma off_axis : coordinate (to64 z) Z -> Z <> value64 axis -> 0 < rho /\
  let L := Z + axis_depth (value32 R) (value32 w) in computes (cylinder_l d_head d_tail (to64 z)) (201 / 100) L (-60) 15.
Proof.
  intros Cz Hne. split; [|now apply (cylinder_l_is_near R w K _ _ _ _ _ _ _ Z Hp Dp Cz Hne)].
  destruct (distance_squared (value32 R) (value32 w) X Z) as [r0 r2]. destruct Dp as [_ _ _ _ _ _ _ _ D].
  destruct (D Z (coordinate_format _ _ Cz) (coordinate_not_tiny _ _ Cz) Hne) as (_ & L60 & _). pose proof (bpow_gt_0 radix2 (-60)).
  destruct r0 as [r0|r0]; [exact r0|exfalso]. rewrite <- r0, Rmult_0_l in r2. set (L := Z + _) in *.
  assert (L0 : L <> 0) by (intro E; rewrite E, Rabs_R0 in L60; lra).
  pose proof (Rle_0_sqr X) as X2. pose proof (Rlt_0_sqr L L0) as L2. unfold Rsqr in *. lra.
Qed.

Lemma in_cylinder : 0 < rho -> rho < value32 R -> let F := value32 K * (value32 R - rho) / rho in
  cylinder_x (value32 R) (value32 w) (value32 K) X Z = F * X /\
  cylinder_z (value32 R) (value32 w) (value32 K) X Z = F * (Z + axis_depth (value32 R) (value32 w)).
Proof.
  intros H0 H F. unfold cylinder_x, cylinder_z. cbv zeta. rewrite !Rlt_bool_true, !Req_bool_false by lra. unfold F. split; field; lra.
Qed.

Lemma z_from_axis : in_range z -> is_equal32 z (to32 axis) = Req_bool Z (value64 axis) /\
  is_at_most32 z (to32 axis) = Rle_bool Z (value64 axis).
Proof.
  intros [Fz _]. split; [now apply (equal32_is z (to32 axis) Z _ (conj eq_refl Fz))|].
  rewrite is_at_most32_is_right; [now rewrite (proj1 Ax)|exact Fz|apply Ax].
Qed.

Theorem cylinder_lane : right_where_free set (cylinder_form (to64 K) (to64 R) anchor anchored rest d_head d_tail axis x z)
  (exact_cylinder (value32 R) (value32 w) (value32 K)) x z.
Proof.
  intro H. destruct (free_lane _ _ H) as (A & B & C & D & E). clear H. unfold cylinder_form in *. cbv zeta in *. revert A B C D E.
    lane_fields.
  intros A B C D E. destruct (cylinder_coordinates A B) as (Hx & Hz & Cx & Cz & Ex & Ez & Wx & Wz).
  pose proof (E _ (or_introl eq_refl)) as E1. pose proof (E _ (or_intror (or_introl eq_refl))) as E2.
  pose proof (C _ (or_introl eq_refl)) as C1. pose proof (D _ (or_introl eq_refl)) as D1. clear A B C D E.
  apply orb_false_elim in D1. destruct D1 as [D1 D2]. rewrite (proj1 (z_from_axis Hz)) in D2.
  assert (Hne : Z <> value64 axis) by (revert D2; case Req_bool_spec; [discriminate|trivial]).
  destruct (off_axis Cz Hne) as [rho0 Nl]. cbv zeta in Nl. unfold cylinder_l in Nl.
  destruct (cylinder_scale_is R w K _ _ _ _ _ _ (to64 x) X (to64 z) Z Hp Dp Cx Cz Wx Wz C1 D1 (fun _ _ => rho0)) as [In Out].
  split; [exact Hx|]. split; [exact Hz|]. rewrite Ex, Ez. cbv zeta. unfold exact_cylinder. cbn [force in_contact exact_x exact_z]. split;
    intro T.
  - destruct (In T) as (_ & s & F & Is & Es & BF & _ & EF). destruct (in_cylinder rho0 T) as [-> ->]. rewrite <- EF. clear In Out.
    destruct (x_component_is _ s F _ X Is Es BF Cx) as [Gx Nx].
    destruct (z_component_is _ s F _ _ zero64 0 Is Es BF Nl zero_is ltac:(lra) ltac:(lra)) as [Gz Nz]. rewrite Rplus_0_r in Gz.
    split; [exact (component_is_nearest 2560 _ _ ltac:(lia) Gx E1 Nx)|exact (component_is_nearest 2560 _ _ ltac:(lia) Gz E2 (or_intror
      Nz))].
  - rewrite (Out ltac:(lra)). clear In Out E1 E2. destruct Nl as (lv & Il & _). split.
    + rewrite (fused_with_zero zero64 (to64 x) 0 X zero_is (coordinate_is _ _ Cx) ltac:(ring)). reflexivity.
    + rewrite (fused_with_zero zero64 _ 0 lv zero_is Il ltac:(ring)). reflexivity.
Qed.

Theorem bump_cylinder_lane : right_where_free set (bump_cylinder_form (to64 K) (to64 R) anchor anchored rest d_head d_tail axis x z)
  (exact_bump_cylinder (value32 R) (value32 w) (value32 K)) x z.
Proof.
  intro H. destruct (free_lane _ _ H) as (A & B & C & D & E). clear H. unfold bump_cylinder_form in *. cbv zeta in *.
  revert A B C D E. lane_fields.
  intros A B C D E. destruct (cylinder_coordinates A B) as (Hx & Hz & Cx & Cz & Ex & Ez & Wx & Wz).
  pose proof (E _ (or_introl eq_refl)) as E1. pose proof (E _ (or_intror (or_introl eq_refl))) as E2.
  pose proof (C _ (or_introl eq_refl)) as C1. pose proof (D _ (or_introl eq_refl)) as D1. clear A B C D E.
  apply orb_false_elim in D1. destruct D1 as [D1 D2]. rewrite (proj2 (z_from_axis Hz)) in D2. change (to32 zero64) with zero32 in D2.
  assert (above : is_less32 zero32 (to32 v) = true -> value64 axis < Z).
  { intro P. rewrite P in D2. cbn [andb] in D2. revert D2. case Rle_bool_spec; [discriminate|trivial]. }
  destruct (cylinder_scale_is R w K _ _ _ _ _ _ (to64 x) X (to64 z) Z Hp Dp Cx Cz Wx Wz C1 D1) as [In Out].
  { intros _ P. apply off_axis; [exact Cz|]. specialize (above P). lra. }
  pose proof Hp as ((_ & _ & FK) & HR & Hw & HK).
  pose proof (wall_force_is K _ _ FK HK Cz) as Iw. set (W := Rmax (- value32 K * Z) 0) in *.
  pose proof (coordinate_range _ _ Cz) as Rz. apply Rabs_le_inv in Rz.
  assert (BW : 0 <= W <= 10000000).
  { split; [apply Rmax_r|apply Rmax_lub; [|lra]]. replace (- value32 K * Z) with (value32 K * - Z) by ring.
    apply Rle_trans with (value32 K * 10000); [apply Rmult_le_compat_l; lra|lra]. }
  split; [exact Hx|]. split; [exact Hz|]. rewrite Ex, Ez. cbv zeta. unfold exact_bump_cylinder. cbn [force in_contact exact_x exact_z].
  fold W. destruct (Rlt_or_le rho (value32 R)) as [T|T].
  - split; [intros _|intro N; exfalso; apply N; now left]. destruct (In T) as (P & s & F & Is & Es & BF & rho0 & EF). specialize (above P).
    destruct (off_axis Cz ltac:(lra)) as [_ Nl]. cbv zeta in Nl. unfold cylinder_l in Nl.
    destruct (in_cylinder rho0 T) as [-> ->]. rewrite <- EF. clear In Out.
    assert (HL : 0 < Z + axis_depth (value32 R) (value32 w)).
    { destruct Dp as [_ _ _ _ _ _ _ _ DA]. apply (DA Z (coordinate_format _ _ Cz) (coordinate_not_tiny _ _ Cz)); lra. }
    destruct (x_component_is _ s F _ X Is Es BF Cx) as [Gx Nx].
    destruct (z_component_is _ s F _ _ _ W Is Es BF Nl Iw BW (fun _ => HL)) as [Gz Nz].
    split; [exact (component_is_nearest 2560 _ _ ltac:(lia) Gx E1 Nx)|exact (component_is_nearest 2560 _ _ ltac:(lia) Gz E2 (or_intror
      Nz))].
  - rewrite (Out T) in *. clear In Out.
    assert (Il : exists lv, is64 (plus (plus (to64 z) d_head) d_tail) lv).
    { destruct Dp as [(_ & _ & Fh & Ft & _) _ _ _ _ Rh Rt _ _].
      assert (Bt : Rabs (value64 d_tail) <= 1) by (apply Rle_trans with (1 := Rt); unfold tail_share; lra).
      assert (big : forall a, Rabs a <= 1000000 -> Rabs a <= bpow radix2 1000).
      { intros a Ha. apply Rle_trans with (bpow radix2 20); [simpl; lra|apply bpow_le; lia]. }
      assert (B1 : Rabs (Z + value64 d_head) <= 30000) by (apply Rabs_le; lra).
      pose proof (plus_is _ _ _ _ (coordinate_is _ _ Cz) (conj eq_refl Fh : is64 d_head _) ltac:(apply big; lra)) as I1.
      pose proof (product_is_close (Z + value64 d_head)) as Q1. pose proof (Rabs_triang_inv (nearest64 (Z + value64 d_head)) (Z + value64
        d_head)).
      pose proof tiny_is_tiny. eexists. apply plus_is; [exact I1|exact (conj eq_refl Ft)|].
      apply big. apply Rle_trans with (1 := Rabs_triang _ _). unfold unit53 in *. lra. }
    destruct Il as (lv & Il). rewrite (fused_with_zero zero64 (to64 x) 0 X zero_is (coordinate_is _ _ Cx) ltac:(ring)) in *.
    assert (Cxz : cylinder_x (value32 R) (value32 w) (value32 K) X Z = 0 /\ cylinder_z (value32 R) (value32 w) (value32 K) X Z = 0).
    { unfold cylinder_x, cylinder_z. cbv zeta. rewrite (Rlt_bool_false rho (value32 R) T). split; reflexivity. }
    destruct Cxz as [-> ->]. rewrite Rplus_0_l. split.
    + intros [N|N]; [lra|]. split; [now apply zero_is_nearest|].
      destruct (coordinate_not_tiny _ _ Cz) as [Z0|Z30]; [lra|]. rewrite Rabs_left in Z30 by exact N.
      assert (LW : bpow radix2 (-40) <= W).
      { apply Rle_trans with (2 := Rmax_l _ _). replace (- value32 K * Z) with (value32 K * - Z) by ring.
        replace (-40)%Z with (-10 + -30)%Z by reflexivity. rewrite bpow_plus. apply Rmult_le_compat; try apply bpow_ge_0; [simpl;
          lra|exact Z30]. }
      pose proof (bpow_gt_0 radix2 (-40)) as P40.
      assert (If : is64 (fused zero64 (plus (plus (to64 z) d_head) d_tail) (larger (times (opp (to64 K)) (to64 z)) zero64)) W).
      { replace W with (nearest64 (0 * lv + W)).
        - apply fused_is; [exact zero_is|exact Il|exact Iw|]. rewrite Rmult_0_l, Rplus_0_l, Rabs_pos_eq by lra.
          apply Rle_trans with (bpow radix2 24); [simpl; lra|apply bpow_le; lia].
        - rewrite Rmult_0_l, Rplus_0_l. apply round_generic; auto with typeclass_instances. now apply format_of in Iw. }
      apply (component_is_nearest 2560 _ _ ltac:(lia)); [|exact E2|right; rewrite (proj1 If); lra].
      apply exact_is_good; [lia|exact If| |].
      * right. rewrite Rabs_pos_eq by lra. apply Rle_trans with (2 := LW). apply bpow_le. lia.
      * rewrite Rabs_pos_eq by lra. apply Rle_lt_trans with (bpow radix2 24); [simpl; lra|apply bpow_lt; lia].
    + intro N. split; [reflexivity|]. assert (Z0 : 0 <= Z) by (apply Rnot_lt_le; intro; apply N; now right).
      assert (Ip : is64 (times (opp (to64 K)) (to64 z)) (nearest64 (- value32 K * Z))).
      { apply times_is; [now apply opp_is, to64_is_exact|exact (coordinate_is _ _ Cz)|].
        rewrite Rabs_mult, Rabs_Ropp, !Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 24); [|apply bpow_le; lia].
        apply Rle_trans with (1000 * 10000); [apply Rmult_le_compat; lra|simpl; lra]. }
      rewrite (larger_is_zero _ _ Ip).
      * rewrite (fused_with_zero zero64 _ 0 lv zero_is Il ltac:(ring)). reflexivity.
      * rewrite <- (round_0 radix2 fexp64 ZnearestE). apply round_le; auto with typeclass_instances.
        assert (0 <= value32 K * Z) by (apply Rmult_le_pos; lra). lra.
Qed.
End Lane.

Theorem cylinder_lane_is_right : forall set R w K x z, parameters R w K ->
  right_where_free set (form_of_cylinder R w K x z) (exact_cylinder (value32 R) (value32 w) (value32 K)) x z.
Proof.
  intros set R w K x z Hp. pose proof (cylinder_constants_are_right R w K Hp) as D.
  exact (cylinder_lane set R w K x z _ _ _ _ _ _ Hp D (axis_is R w (proj2 (proj2 (proj2 (proj2 (depth_finite _ _ _ _ _ _ _ _ D))))))).
Qed.

Theorem bump_cylinder_lane_is_right : forall set R w K x z, parameters R w K ->
  right_where_free set (form_of_bump_cylinder R w K x z) (exact_bump_cylinder (value32 R) (value32 w) (value32 K)) x z.
Proof.
  intros set R w K x z Hp. pose proof (cylinder_constants_are_right R w K Hp) as D.
  exact (bump_cylinder_lane set R w K x z _ _ _ _ _ _ Hp D (axis_is R w (proj2 (proj2 (proj2 (proj2 (depth_finite _ _ _ _ _ _ _ _ D))))))).
Qed.
