(* SPDX-License-Identifier: BSD-3-Clause *)
(* The first stages of bump-3p and bump-3p-shaded with sin(alpha / 3) and half_top as the code computes them. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded Gap Polygons.
From Forceshade Require Import DoubleDouble Depth Split DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms TwoPolygonsConstants.
From Forceshade Require Import ThreePolygons ThreePolygonsFace ThreePolygonsConstants NewtonRounded NewtonThird SineOfThird TopEdge.
Open Scope R_scope.

(* half_top of the laws. *)
Definition top_of (R w : binary32) : binary64 := to64 (largest_on_top R w (half_top_3p R (sine_of_third R w))).

Theorem top_is_right : forall R w K, parameters R w K -> decides_top R w (top_of R w).
Proof.
  intros R w K Hp. pose proof (sine_of_third_is R w K Hp) as Ht. pose proof (third_sine_range _ _ _ Hp) as Bt.
  pose proof Hp as ((FR & _) & HR & Hw & _). destruct (third_sine_is (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as ((Hlow & _) & _).
  set (t := third_sine _ _) in *.
  assert (BT : / 10000 <= value32 R * t <= 10000).
  { split.
    - apply Rle_trans with (value32 R * (value32 w / (6 * value32 R))); [|apply Rmult_le_compat_l; lra].
      replace (value32 R * (value32 w / (6 * value32 R))) with (value32 w / 6) by (field; lra). lra.
    - apply Rle_trans with (value32 R * / 2); [apply Rmult_le_compat_l; lra|lra]. }
  pose proof (holds_multiply _ _ _ _ _ _ _ _ (holds_exactly _ _ (to64_is_exact R FR) ltac:(lra)) Ht ltac:(lra) ltac:(lra) ltac:(lra)
    ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as M. fold (half_top_3p R (sine_of_third R w)) in M.
  destruct (holds_close _ _ _ _ M ltac:(lra) ltac:(lra)) as (y & z & e & Y & _ & _ & _ & Bz & C & By).
  apply (largest_on_top_is_right R w K _ y Hp Y). fold t. set (T := value32 R * t) in *.
  pose proof (unit_times y ltac:(lra)) as Uy. pose proof unit_is_small as Hu.
  assert (UU : unit53 * unit53 <= / 1000000000000 * / 1000000000000) by (apply Rmult_le_compat; lra).
  assert (C2 : (0 + 70 + 8) * (101 / 100) * (unit53 * unit53) * T <= / 100000000000 * T) by (apply Rmult_le_compat_r; lra).
  absolute_values. apply Rabs_le. lra.
Qed.

(* Every answer of the first stage of bump-3p is right, for every input of the domain. Nothing is assumed of constants. *)
Theorem bump_3p_first_stage_answers_right_for_all : forall is_fused R w K later x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_3p (value32 R) (value32 w) X Z in
  let S := slope_at (value32 R) (value32 w) X in
  right_or_later (evaluate bump_3p_window (bump_3p_of R w K (sine_of_third R w) (top_of R w) is_fused) later x y z)
    (later (quantised x) (quantised z)) (0 < M)
    (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros is_fused R w K later x y z Hp Hv. apply bump_3p_first_stage_answers_right_given_t; try assumption.
  - exact (sine_of_third_is R w K Hp).
  - exact (top_is_right R w K Hp).
Qed.

Theorem bump_3p_shaded_first_stage_answers_right_for_all : forall is_fused R w K later x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_3p (value32 R) (value32 w) X Z in
  right_or_later (evaluate bump_3p_shaded_window (bump_3p_shaded_of R w K (sine_of_third R w) (top_of R w) is_fused) later x y z)
    (later (quantised x) (quantised z)) (0 < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros is_fused R w K later x y z Hp Hv. apply bump_3p_shaded_first_stage_answers_right_given_t; try assumption.
  - exact (sine_of_third_is R w K Hp).
  - exact (top_is_right R w K Hp).
Qed.
