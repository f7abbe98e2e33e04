(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second stage of bump-2p-shaded in double-double: exact() of fast/laws/bump_2p_shaded.h. An answer that it gives is right, however
   far the gap has cancelled. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants DoubleDoubleTerms Enclosures.
From Forceshade Require Import BesideTie SecondStage SecondAlong Bump1pShadedSecond TwoPolygonsGap Bump2pSecond ShadedAlong.
Open Scope R_scope.

Definition bump_2p_shaded_second (R w K x z : binary32) : option evaluation :=
  let foot := exactly64 (opp (to64 z)) in
  if is_beside w x then decide_along K foot (exactly64 zero64) (exactly64 (two_to 0))
  else along_shaded R K x (if is_at_foot w x then foot else side_gap_2p R w x z).

(* The plane beside a bump, whatever the penetration of the bump is. *)
Lemma beside_shaded_is_right : forall R w K X zv Z M answer, parameters R w K -> coordinate zv Z -> value32 w / 2 < Rabs X -> M = - Z ->
  decide_along K (exactly64 (opp zv)) (exactly64 zero64) (exactly64 (two_to 0)) = Some answer ->
  is_answer answer (0 < M) (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros R w K X zv Z M answer Hp Cz Hin -> H. unfold shaded_x, shaded_z. rewrite Rle_bool_false by exact Hin. rewrite Rmult_1_r.
  apply is_answer_same with (Z < 0); [split; lra|]. exact (on_plane_is_right R w K _ Z answer Hp Cz H).
Qed.

Lemma gap_2p_shaded_is : forall R w K x X z Z, parameters R w K -> is_finite 24 128 x = true -> value32 x = X -> coordinate (to64 x) X ->
  coordinate (to64 z) Z -> Rabs X <= value32 w / 2 ->
  settled (if is_at_foot w x then exactly64 (opp (to64 z)) else side_gap_2p R w x z) (penetration_2p (value32 R) (value32 w) X Z).
Proof.
  intros R w K x X z Z Hp Fx Vx Cx Cz Hin. pose proof (coordinate_range _ _ Cx) as BX. pose proof Hp as ((_ & Fw & _) & _ & Hw & _).
  rewrite (is_at_foot_is w x Fw Fx) by (rewrite Vx; exact BX). rewrite Vx.
  case Req_bool_spec; intro E; [|now apply (side_gap_is R w K)].
  replace (penetration_2p (value32 R) (value32 w) X Z) with (- Z); [now apply depth_is_settled|].
  unfold penetration_2p. rewrite Rle_bool_true by exact Hin. rewrite E. field. lra.
Qed.

Lemma bump_2p_shaded_second_is_right : forall R w K x X z Z answer, parameters R w K -> is_finite 24 128 x = true -> value32 x = X ->
  coordinate (to64 x) X -> coordinate (to64 z) Z ->
  let M := penetration_2p (value32 R) (value32 w) X Z in bump_2p_shaded_second R w K x z = Some answer ->
  is_answer answer (0 < M) (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros R w K x X z Z answer Hp Fx Vx Cx Cz M H. pose proof (coordinate_range _ _ Cx) as BX. pose proof Hp as ((_ & Fw & _) & _).
  unfold bump_2p_shaded_second in H. cbv zeta in H. rewrite is_beside_is in H by (rewrite ?Vx; assumption). rewrite Vx in H.
  destruct (Rle_lt_dec (Rabs X) (value32 w / 2)) as [Hin|Hin].
  - rewrite Rle_bool_true in H by exact Hin. cbn [negb] in H.
    exact (along_shaded_is_right R w K x X _ M answer Hp Cx Hin (gap_2p_shaded_is R w K x X z Z Hp Fx Vx Cx Cz Hin) H).
  - rewrite Rle_bool_false in H by exact Hin. cbn [negb] in H. apply (beside_shaded_is_right R w K X _ Z M answer Hp Cz Hin); [|exact H].
    unfold M, penetration_2p. now rewrite Rle_bool_false by exact Hin.
Qed.

Theorem bump_2p_shaded_second_stage_answers_right : forall R w K x y z answer, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_2p (value32 R) (value32 w) X Z in
  bump_2p_shaded_second R w K (quantised x) (quantised z) = Some answer ->
  is_answer answer (0 < M) (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros R w K x y z answer Hp Hv.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx], (valid_coordinates _ _ _ Hv) as [Cx Cz].
  exact (bump_2p_shaded_second_is_right R w K _ _ _ _ answer Hp Fx Vx Cx Cz).
Qed.

(* Every answer of the first two stages is right, for every input of the domain. *)
Theorem bump_2p_shaded_two_stages_answer_right : forall is_fused R w K third x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_2p (value32 R) (value32 w) X Z in
  right_or_later (evaluate bump_2p_shaded_window (bump_2p_shaded_of R w K is_fused) (later_of (bump_2p_shaded_second R w K) third) x y z)
    (third (quantised x) (quantised z)) (0 < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros is_fused R w K third x y z Hp Hv X Z M. apply two_stages_are_right with (second := bump_2p_shaded_second R w K).
  - now apply bump_2p_shaded_first_stage_answers_right_for_all.
  - intros found H. now apply (bump_2p_shaded_second_stage_answers_right R w K x y z found).
Qed.
