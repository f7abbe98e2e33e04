(* SPDX-License-Identifier: BSD-3-Clause *)
(* The components of a batch of the cylinders from its scale: right to 2560 units, and never -0. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Relative BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Wall Gap Polygons DoubleDouble Depth Split
  ErrorFree.
From Forceshade Require Import CylinderForce CylinderFirst CylinderAnswers CylinderConstants SecondAlong.
From Forceshade Require Import Lanes RecordedForms LaneAnswers BumpLanes Batch PolygonLanes CylinderLaneSums CylinderLaneV
  CylinderLaneRough CylinderLaneRoughForm CylinderLaneStep CylinderLaneScale.
Import ListNotations.
Open Scope R_scope.

(* A component that is 0 as it should be, or is not, is never -0. *)
Lemma component_is_nearest : forall k v E, (0 < k <= 2 ^ 20)%Z -> good k v E -> is_beside_tie (k + 1) v = false ->
  v = zero64 \/ value64 v <> 0 -> is_nearest32 (to32 v) E.
Proof.
  intros k v E Hk G T Hv. destruct (rounded_component k v E Hk G T) as [V F]. split; [exact V|]. split; [exact F|]. intro H0.
  destruct Hv as [->|Hv]; [reflexivity|exfalso]. destruct G as (Fv & _ & [Z0|L] & B); [contradiction|].
  rewrite H0 in V. destruct (to32_rounds_once v Fv) as [V2 _].
  { apply Rle_lt_trans with (bpow radix2 127); [|now apply bpow_lt]. apply abs_round_le_generic; auto with typeclass_instances; [|lra].
    apply generic_format_bpow. unfold FLT_exp. lia. }
  rewrite V in V2. assert (bpow radix2 (-126) <= Rabs (nearest32 (value64 v))).
  { apply abs_round_ge_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia. }
  rewrite <- V2, Rabs_R0 in H. pose proof (bpow_gt_0 radix2 (-126)). lra.
Qed.

(* The scale times a coordinate, with the force of the plane, rounded once. *)
Lemma cylinder_component : forall S s F l lv L plane W, is64 S s -> Rabs (s - F) <= 2492 * unit53 * F -> 0 < F -> bpow radix2 (-120) <= F
  <= bpow radix2 60 ->
  is64 l lv -> Rabs (lv - L) <= 3 * unit53 * Rabs L -> bpow radix2 (-120) <= F * Rabs L <= bpow radix2 100 -> Rabs L <= bpow radix2 40 ->
  is64 plane W -> 0 <= W <= bpow radix2 60 -> (0 < W -> 0 < L) ->
  good 2560 (fused S l plane) (F * L + W) /\ value64 (fused S l plane) <> 0.
Proof.
  intros S s F l lv L plane W Is Hs HF BF Il Hl BFL BL Ip HW HL. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Ht.
  assert (a1 : Rabs (s * lv - F * L) <= 2496 * unit53 * (F * Rabs L)).
  { replace (s * lv - F * L) with ((s - F) * lv + F * (lv - L)) by ring.
    assert (Rabs lv <= 10001 / 10000 * Rabs L) by (pose proof (Rabs_triang_inv lv L); pose proof (Rabs_pos L); unfold unit53 in *; lra).
    apply Rle_trans with (2492 * unit53 * F * (10001 / 10000 * Rabs L) + F * (3 * unit53 * Rabs L)).
    - apply bound_sum; [now apply bound_product|]. apply bound_product; [rewrite Rabs_pos_eq; lra|exact Hl].
    - assert (0 <= unit53 * (F * Rabs L)) by (repeat apply Rmult_le_pos; try lra; apply Rabs_pos). lra. }
  set (x := F * Rabs L) in *. assert (x0 : 0 < x) by (pose proof (bpow_gt_0 radix2 (-120)); lra).
  set (G := F * L + W). assert (EG : Rabs G = x + W).
  { unfold G, x. destruct (Rle_lt_or_eq_dec 0 W (proj1 HW)) as [H|H].
    - specialize (HL H). rewrite (Rabs_pos_eq L) by lra. apply Rabs_pos_eq. assert (0 <= F * L) by (apply Rmult_le_pos; lra). lra.
    - rewrite <- H, !Rplus_0_r, Rabs_mult, (Rabs_pos_eq F) by lra. reflexivity. }
  set (p := s * lv + W). assert (Ep : Rabs (p - G) <= 2496 * unit53 * x).
  { replace (p - G) with (s * lv - F * L) by (unfold p, G; ring). exact a1. }
  assert (Bp : 99 / 100 * Rabs G <= Rabs p <= 101 / 100 * Rabs G).
  { pose proof (Rabs_triang_inv p G) as T1. pose proof (Rabs_triang_inv G p) as T2. rewrite (Rabs_minus_sym G p) in T2.
    assert (2496 * unit53 * x <= / 100 * Rabs G) by (rewrite EG; unfold unit53; lra). lra. }
  assert (Gl : bpow radix2 (-120) <= Rabs G) by (rewrite EG; lra).
  assert (Gu : Rabs G <= bpow radix2 101).
  { rewrite EG. replace 101%Z with (1 + 100)%Z by reflexivity. rewrite (bpow_plus radix2 1). change (bpow radix2 1) with 2.
    assert (bpow radix2 60 <= bpow radix2 100) by (apply bpow_le; lia). lra. }
  assert (pu : Rabs p <= bpow radix2 110).
  { replace 110%Z with (101 + 9)%Z by reflexivity. rewrite bpow_plus. change (bpow radix2 9) with 512. pose proof (bpow_ge_0 radix2 101).
    lra. }
  assert (pl : bpow radix2 (-122) <= Rabs p).
  { replace (-122)%Z with (-120 + -2)%Z by reflexivity. rewrite bpow_plus. change (bpow radix2 (-2)) with (/ 4). lra. }
  destruct (rounding_factor p) as (d & Ed & Hd); [apply Rle_trans with (2 := pl); apply bpow_le; lia|].
  assert (If : is64 (fused S l plane) (nearest64 p)).
  { unfold p. apply fused_is; try assumption. fold p. apply Rle_trans with (1 := pu). apply bpow_le. lia. }
  assert (v1 : bpow radix2 (-122) <= Rabs (nearest64 p)).
  { apply abs_round_ge_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia. }
  assert (v2 : Rabs (nearest64 p) <= bpow radix2 110).
  { apply abs_round_le_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia. }
  destruct If as [Vf Ff]. split.
  - split; [exact Ff|]. rewrite Vf. split; [|split].
    + fold G. change (bpow radix2 (-53)) with unit53 || replace (bpow radix2 (-53)) with unit53 by (unfold unit53; simpl; lra).
      replace (nearest64 p - G) with ((nearest64 p - p) + (p - G)) by ring. apply Rle_trans with (unit53 * Rabs p + 2496 * unit53 * x).
      * apply bound_sum; [|exact Ep]. rewrite Ed. replace (p * (1 + d) - p) with (d * p) by ring. rewrite Rabs_mult.
        apply Rmult_le_compat_r; [apply Rabs_pos|exact Hd].
      * rewrite EG in *. assert (unit53 * Rabs p <= unit53 * (101 / 100 * (x + W))) by (apply Rmult_le_compat_l; lra).
        assert (0 <= unit53 * x) by (apply Rmult_le_pos; lra). assert (0 <= unit53 * W) by (apply Rmult_le_pos; lra). lra.
    + right. apply Rle_trans with (2 := v1). apply bpow_le. lia.
    + apply Rle_lt_trans with (1 := v2). apply bpow_lt. lia.
  - rewrite Vf. intro H0. rewrite H0, Rabs_R0 in v1. pose proof (bpow_gt_0 radix2 (-122)). lra.
Qed.
