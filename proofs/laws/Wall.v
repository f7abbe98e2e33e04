(* SPDX-License-Identifier: BSD-3-Clause *)
(* The laws wall and bump-1p, whole: their first stage is exact and never in doubt. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded RoundingTest Computed Evaluate Inputs.
Open Scope R_scope.

(* -K z, where it is positive. *)
Lemma wall_force_is : forall K zv Z, is_finite 24 128 K = true -> / 1000 <= value32 K <= 1000 -> coordinate zv Z ->
  is64 (larger (times (opp (to64 K)) zv) zero64) (Rmax (- value32 K * Z) 0).
Proof.
  intros K zv Z FK RK [Hz Fz Rz _]. apply larger_is; [|apply zero_is].
  replace (- value32 K * Z) with (nearest64 (- value32 K * Z)).
  - apply times_is; [now apply opp_is, to64_is_exact|assumption|]. rewrite Rabs_mult, Rabs_Ropp, (Rabs_pos_eq (value32 K)) by lra.
    apply Rle_trans with (bpow radix2 24); [|apply bpow_le; lia]. apply Rle_trans with (1000 * 10000); [|simpl; lra].
    apply Rmult_le_compat; try lra. apply Rabs_pos.
  - apply round_generic; auto with typeclass_instances. apply product_is_binary64; [|assumption].
    apply generic_format_opp, (generic_format_B2R 24 128).
Qed.

(* F = -K z in the direction of z where z < 0. x, y and z are any bits, K any number of its domain; no later stage is asked. *)
Theorem wall_answers_right : forall is_fused later (K x y z : binary32), stiffness K -> valid x y z = true ->
  let Z := read (value32 z) in
  is_answer (evaluate wall_window (wall is_fused (to64 K)) later x y z) (Z < 0) 0 (- value32 K * Z).
Proof.
  intros is_fused later K x y z [HK RK] Hvalid Z. destruct (valid_coordinates _ _ _ Hvalid) as [_ Hz]. fold Z in Hz.
  unfold evaluate, wall. cbv zeta. cbn [first_x first_z first_contact first_doubt]. rewrite Hvalid. cbn [negb].
  rewrite (less_is _ _ _ _ (coordinate_is _ _ Hz) zero_is). case Rlt_bool_spec; intro Hsign; [right|left; split; [lra|reflexivity]].
  split; [exact Hsign|]. cbn [negb]. change (wall_window) with 0%Z. unfold in_doubt. cbn [Z.eqb andb negb].
  pose proof (wall_force_is K _ _ HK RK Hz) as [F1 F2].
  exists zero32, (returned (larger (times (opp (to64 K)) (to64 (quantised z))) zero64)). split; [reflexivity|]. split.
  { split; [symmetry; apply round_0; auto with typeclass_instances|now split]. }
  pose proof (coordinate_range _ _ Hz) as Rz.
  assert (Hsize : 0 < - value32 K * Z <= 10000000).
  { rewrite (Rabs_left Z) in Rz by assumption. replace (- value32 K * Z) with (value32 K * - Z) by ring.
    split; [apply Rmult_lt_0_compat; lra|]. replace 10000000 with (1000 * 10000) by ring. apply Rmult_le_compat; lra. }
  rewrite Rmax_left in F1 by lra. rewrite <- F1. apply returned_is_nearest; [assumption|].
  rewrite F1, Rabs_pos_eq by lra. apply Rle_lt_trans with (bpow radix2 24); [simpl; lra|now apply bpow_lt].
Qed.

Lemma bump_1p_is_wall : bump_1p = wall /\ bump_1p_window = wall_window.
Proof. now split. Qed.
