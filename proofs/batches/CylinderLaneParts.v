(* SPDX-License-Identifier: BSD-3-Clause *)
(* The scale and the components of a lane of the cylinders that the watch lets pass. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Relative BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Wall Gap Polygons DoubleDouble Depth Split
  ErrorFree.
From Forceshade Require Import CylinderForce CylinderFirst CylinderAnswers CylinderConstants SecondAlong.
From Forceshade Require Import Lanes RecordedForms LaneAnswers BumpLanes Batch PolygonLanes CylinderLaneSums CylinderLaneV
  CylinderLaneRough CylinderLaneRoughForm CylinderLaneStep CylinderLaneScale CylinderLaneForce.
Import ListNotations.
Open Scope R_scope.

Lemma equal32_is : forall a b x y, is32 a x -> is32 b y -> is_equal32 a b = Req_bool x y.
Proof.
  intros a b x y [<- Fa] [<- Fb]. unfold is_equal32. rewrite Bcompare_correct by assumption. unfold Req_bool.
  destruct (Rcompare _ _); reflexivity.
Qed.

Local Strategy -10 [axis_of].  (* it is unfolded before numbers of binary32 are *)
Lemma axis_is : forall R w, is_finite 53 1024 (axis_of R w) = true -> is32 (to32 (axis_of R w)) (value64 (axis_of R w)).
Proof.
  intros R w F. unfold axis_of in *. set (b := to32 (hi (computed_depth R w))) in *. clearbody b.
  assert (Fb : is_finite 24 128 b = true) by (destruct b; try discriminate F; reflexivity).
  pose proof (opp_is _ _ (to64_is_exact b Fb)) as Io. destruct Io as [V F2]. rewrite V.
  assert (E : nearest32 (- value32 b) = - value32 b).
  { apply round_generic; auto with typeclass_instances. apply generic_format_opp, (generic_format_B2R 24 128). }
  assert (B : Rabs (nearest32 (value64 (opp (to64 b)))) < bpow radix2 128).
  { rewrite V, E, Rabs_Ropp. apply abs_B2R_lt_emax. }
  destruct (to32_rounds_once _ F2 B) as [V2 F3]. rewrite V, E in V2. now split.
Qed.

(* The scale of a lane that the watch lets pass: K (R - rho) / rho inside of the cylinder, and 0 outside. *)
Lemma cylinder_scale_is : forall R w K anchor anchored rest d_head d_tail axis xv X zv Z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> coordinate xv X -> coordinate zv Z ->
  watched (value32 w / 2) (value64 d_head) X -> watched (value32 w / 2) (value64 d_head) Z ->
  let v := v_form (square_root (plus (minus anchored anchor) rest)) d_head d_tail xv zv in
  let S := larger (scale_form K R v (to64 (rough_form R (to32 v)))) zero64 in
  let rho := distance_from_axis (value32 R) (value32 w) X Z in
  is_near (times (times (two_to (-24)) (to64 R)) (to64 R)) v = false ->
  is_less32 (rho_squared_form R (to32 v)) (least_form R) = false ->
  (rho < value32 R -> is_less32 zero32 (to32 v) = true -> 0 < rho) ->
  (rho < value32 R -> is_less32 zero32 (to32 v) = true /\ exists s F, is64 S s /\ Rabs (s - F) <= 2492 * unit53 * F /\
     bpow radix2 (-40) <= F <= bpow radix2 20 /\ 0 < rho /\ F = value32 K * (value32 R - rho) / rho) /\
  (value32 R <= rho -> S = zero64).
Proof.
  intros R w K anchor anchored rest d_head d_tail axis xv X zv Z Hp Dp Cx Cz Wx Wz v S rho Near Doubt Off.
  destruct (v_form_is_near R w K _ _ _ _ _ _ _ X _ Z Hp Dp Cx Cz Wx Wz) as (vv & Iv & Hv). fold v in Iv.
  clearbody v. pose proof Hp as ((FR & _ & FK) & HR & Hw & HK). pose proof (to64_is_exact R FR) as IR.
  destruct (distance_squared (value32 R) (value32 w) X Z) as [rho0 rho2]. fold rho in rho0, rho2.
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  set (L := Z + axis_depth (value32 R) (value32 w)) in *. set (Rad := value32 R) in *. set (Q := Rad * Rad) in *.
  set (V := Q - (X * X + L * L)) in *. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Hti.
  assert (HQ : / 100 <= Q <= 100000000) by (unfold Q; clear -HR; nra).
  (* the watch *)
  assert (I24 : is64 (times (two_to (-24)) (to64 R)) (bpow radix2 (-24) * Rad)).
  { apply scaled_is; [lia|exact IR| |].
    - apply product_is_binary64; [apply generic_format_bpow; unfold FLT_exp; lia|apply (generic_format_B2R 24 128)].
    - change (bpow radix2 (-24)) with (/ 16777216). rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 0); [simpl; lra|apply
      bpow_le; lia]. }
  change (bpow radix2 (-24)) with (/ 16777216) in I24.
  assert (El : / 16777216 * Rad * Rad = / 16777216 * Q) by (unfold Q; ring).
  assert (Il : is64 (times (times (two_to (-24)) (to64 R)) (to64 R)) (nearest64 (/ 16777216 * Q))).
  { rewrite <- El. apply times_is; try assumption. rewrite El, Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 40); [simpl;
    lra|apply bpow_le; lia]. }
  pose proof (product_is_close (/ 16777216 * Q)) as Cl. rewrite (Rabs_pos_eq (/ 16777216 * Q)) in Cl by lra. apply Rabs_le_inv in Cl.
  assert (Ll : / 16777300 * Q < nearest64 (/ 16777216 * Q)) by (unfold unit53 in *; lra).
  pose proof (not_near_is _ _ _ (proj2 Iv) Il ltac:(lra) Near) as Large. rewrite (proj1 Iv) in Large.
  destruct (Hv ltac:(lra)) as [Ev Ev4].
  assert (Vabs : / 16777400 * Q <= Rabs V) by (pose proof (Rabs_triang_inv vv V); unfold unit53 in *; lra).
  assert (EP : rho * rho = Q - V) by (rewrite rho2; unfold V; ring).
  assert (UP : Q - V <= 510000000).
  { replace (Q - V) with (X * X + L * L) by (unfold V; ring). pose proof (coordinate_range _ _ Cx) as Rx. pose proof (coordinate_range _ _
    Cz) as Rz.
    apply Rabs_le_inv in Rx. apply Rabs_le_inv in Rz. assert (HdR : axis_depth Rad (value32 w) <= 10000).
    { destruct (Rle_or_lt (axis_depth Rad (value32 w)) 10000) as [H|H]; [exact H|exfalso].
      assert (10000 * 10000 < axis_depth Rad (value32 w) * axis_depth Rad (value32 w)) by (apply Rmult_le_0_lt_compat; lra).
      assert (0 <= value32 w / 2 * (value32 w / 2)) by (apply Rle_0_sqr). unfold Q in *. lra. }
    pose proof (square_within X 10000 Rx). pose proof (square_within L 20000 ltac:(unfold L; lra)). lra. }
  assert (sign : (rho < Rad -> 0 < V) /\ (Rad <= rho -> V < 0)).
  { split; intro H.
    - assert (rho * rho < Rad * Rad) by (apply Rmult_le_0_lt_compat; lra). unfold Q in *. lra.
    - assert (Rad * Rad <= rho * rho) by (apply Rmult_le_compat; lra). destruct (Req_dec V 0) as [V0|V0]; [rewrite V0, Rabs_R0 in Vabs;
      lra|].
      unfold Q in *. lra. }
  destruct sign as [In Out].
  assert (core : 0 < rho -> (0 < V -> exists s, is64 S s /\ Rabs (s - value32 K * (Rad / rho - 1)) <= 2492 * unit53 * (value32 K * (Rad /
    rho - 1))) /\
      (V < 0 -> S = zero64) /\ Rad / rho <= 25002 / 10000).
  { intro Hrho. destruct (rough_form_is R w K v vv V (Q - V) rho Hp Iv Ev ltac:(fold Rad; fold Q; lra) eq_refl Hrho EP ltac:(lra) Doubt)
    as (Hr & t & It & Et).
    fold Rad in Hr, Et. destruct (scale_form_is R w K v vv V (Q - V) rho _ t Hp Iv Ev Ev4 ltac:(fold Rad; fold Q; lra) eq_refl Hrho EP UP
      (proj2 Hr) It Et) as [S1 S2].
    split; [intro HV; now apply S1|]. split; [exact S2|apply Hr]. }
  split; intro H.
  - specialize (In H). assert (Pos : is_less32 zero32 (to32 v) = true).
    { assert (B : Rabs vv <= bpow radix2 100).
      { pose proof (Rabs_triang_inv vv V). rewrite (Rabs_pos_eq V) in * by lra. assert (0 <= rho * rho) by (apply Rle_0_sqr).
        apply Rle_trans with (bpow radix2 40); [|apply bpow_le; lia]. change (bpow radix2 40) with 1099511627776. unfold unit53 in *. lra. }
      pose proof (to32_is _ _ Iv B) as I32. rewrite (less32_is zero32 _ eq_refl (proj2 I32)), (proj1 I32). change (value32 zero32) with 0.
      apply Rlt_bool_true. apply Rlt_le_trans with (bpow radix2 (-100)); [apply bpow_gt_0|].
      apply round_ge_generic; auto with typeclass_instances; [apply generic_format_bpow; unfold FLT_exp; lia|].
      specialize (Ev4 In). rewrite (Rabs_pos_eq V) in * by lra. apply Rabs_le_inv in Ev4.
      apply Rle_trans with (bpow radix2 (-40)); [apply bpow_le; lia|]. change (bpow radix2 (-40)) with (/ 1099511627776). unfold unit53 in
        *. lra. }
    split; [exact Pos|]. specialize (Off H Pos). destruct (core Off) as (C1 & _ & Hr). destruct (C1 In) as (s & Is & Es).
    set (r := Rad / rho) in *. exists s, (value32 K * (r - 1)). split; [exact Is|]. split; [exact Es|].
    assert (ER : Rad = r * rho) by (unfold r; field; lra).
    assert (EV : V = rho * rho * ((r - 1) * (r + 1))) by (replace V with (Q - rho * rho) by lra; unfold Q; rewrite ER; ring).
    assert (r1 : 1 <= r).
    { destruct (Rle_or_lt 1 r) as [Hr1|Hr1]; [exact Hr1|exfalso]. assert (r * rho < 1 * rho) by (apply Rmult_lt_compat_r; lra). lra. }
    assert (rr : 0 < rho * rho) by now apply Rmult_lt_0_compat.
    assert (T1 : / 60000000 <= r - 1).
    { rewrite (Rabs_pos_eq V) in Vabs by lra. rewrite EV in Vabs. assert (EQ : Q = rho * rho * (r * r)) by (unfold Q; rewrite ER; ring).
      rewrite EQ in Vabs. assert (X1 : / 16777400 * (r * r) <= (r - 1) * (r + 1)).
      { apply Rmult_le_reg_l with (rho * rho); [exact rr|]. lra. }
      assert (1 * 1 <= r * r) by (apply Rmult_le_compat; lra).
      assert ((r - 1) * (r + 1) <= (r - 1) * (35002 / 10000)) by (apply Rmult_le_compat_l; lra). lra. }
    split; [split|].
    + change (bpow radix2 (-40)) with (/ 1099511627776). apply Rle_trans with (/ 1000 * / 60000000); [lra|apply Rmult_le_compat; lra].
    + change (bpow radix2 20) with 1048576. apply Rle_trans with (1000 * 2); [apply Rmult_le_compat; lra|lra].
    + split; [exact Off|]. unfold r. field. lra.
  - specialize (Out H). apply core; [lra|exact Out].
Qed.

(* The components where the scale is F, and where it is 0. *)
Lemma x_component_is : forall S s F x X, is64 S s -> Rabs (s - F) <= 2492 * unit53 * F -> bpow radix2 (-40) <= F <= bpow radix2 20 ->
  coordinate x X -> let c := fused S x zero64 in good 2560 c (F * X) /\ (c = zero64 \/ value64 c <> 0).
Proof.
  intros S s F x X Is Es BF [Ix _ Rx Sx] c. pose proof (bpow_gt_0 radix2 (-40)) as F0. destruct Sx as [->|[LX UX]].
  - rewrite Rmult_0_r. assert (E : c = zero64) by (apply fused_with_zero with s 0; [exact Is|exact Ix|ring]).
    split; [|now left]. rewrite E. apply zero_is_good, zero_is.
  - replace (F * X) with (F * X + 0) by ring. destruct (cylinder_component S s F x X X zero64 0 Is Es) as [G N]; try assumption; try lra.
    + split; [apply Rle_trans with (2 := proj1 BF)|apply Rle_trans with (1 := proj2 BF)]; apply bpow_le; lia.
    + rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. pose proof (Rabs_pos X). pose proof unit_is_small. apply Rmult_le_pos; lra.
    + split.
      * apply Rle_trans with (bpow radix2 (-40) * bpow radix2 (-30)); [rewrite <- bpow_plus; apply bpow_le; lia|].
        apply Rmult_le_compat; try apply bpow_ge_0; [apply BF|exact LX].
      * apply Rle_trans with (bpow radix2 20 * bpow radix2 14); [|rewrite <- bpow_plus; apply bpow_le; lia].
        apply Rmult_le_compat; try apply Rabs_pos; try lra.
    + apply Rle_trans with (1 := UX). apply bpow_le. lia.
    + exact zero_is.
    + split; [lra|apply bpow_ge_0].
    + split; [exact G|now right].
Qed.

Lemma z_component_is : forall S s F l L plane W, is64 S s -> Rabs (s - F) <= 2492 * unit53 * F -> bpow radix2 (-40) <= F <= bpow radix2 20
  ->
  computes l (201 / 100) L (-60) 15 -> is64 plane W -> 0 <= W <= 10000000 -> (0 < W -> 0 < L) ->
  good 2560 (fused S l plane) (F * L + W) /\ value64 (fused S l plane) <> 0.
Proof.
  intros S s F l L plane W Is Es BF (lv & Il & Nl & [LL UL]) Ip HW HL. pose proof (bpow_gt_0 radix2 (-40)) as F0.
  apply cylinder_component with s lv; try assumption; try lra.
  - split; [apply Rle_trans with (2 := proj1 BF)|apply Rle_trans with (1 := proj2 BF)]; apply bpow_le; lia.
  - apply Rle_trans with (1 := near_is_close _ _ _ Nl ltac:(lra)). apply Rmult_le_compat_r; [apply Rabs_pos|]. pose proof unit_is_small.
    lra.
  - split.
    + apply Rle_trans with (bpow radix2 (-40) * bpow radix2 (-60)); [rewrite <- bpow_plus; apply bpow_le; lia|].
      apply Rmult_le_compat; try apply bpow_ge_0; [apply BF|exact LL].
    + apply Rle_trans with (bpow radix2 20 * bpow radix2 15); [|rewrite <- bpow_plus; apply bpow_le; lia].
      apply Rmult_le_compat; try apply Rabs_pos; try lra.
  - apply Rle_trans with (1 := UL). apply bpow_le. lia.
  - split; [lra|]. apply Rle_trans with (bpow radix2 24); [simpl; lra|apply bpow_le; lia].
Qed.
