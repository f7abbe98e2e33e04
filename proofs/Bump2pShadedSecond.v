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

(* The gap of a bump, which at its foot is that of the plane. *)
Lemma gap_or_foot_is : forall R w K x X z Z gap M, parameters R w K -> is_finite 24 128 x = true -> value32 x = X ->
  Rabs X <= 10000 -> coordinate (to64 z) Z -> settled gap M -> (Rabs X = value32 w / 2 -> M = - Z) ->
  settled (if is_at_foot w x then exactly64 (opp (to64 z)) else gap) M.
Proof.
  intros R w K x X z Z gap M Hp Fx Vx BX Cz Sg Foot. pose proof Hp as ((_ & Fw & _) & _).
  rewrite (is_at_foot_is w x Fw Fx), Vx by (rewrite Vx; exact BX). case Req_bool_spec; intro E; [|exact Sg].
  rewrite (Foot E). now apply depth_is_settled.
Qed.

(* A shaded bump of any shape: M is its penetration, and that of the plane beside it. *)
Lemma shaded_second_is_right : forall R w K x X z Z gap M answer, parameters R w K -> is_finite 24 128 x = true -> value32 x = X ->
  coordinate (to64 x) X -> coordinate (to64 z) Z ->
  (Rabs X <= value32 w / 2 -> settled gap M) -> (value32 w / 2 < Rabs X -> M = - Z) ->
  (if is_beside w x then decide_along K (exactly64 (opp (to64 z))) (exactly64 zero64) (exactly64 (two_to 0)) else along_shaded R K x gap) =
    Some answer ->
  is_answer answer (0 < M) (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros R w K x X z Z gap M answer Hp Fx Vx Cx Cz Sg Beside H. pose proof (coordinate_range _ _ Cx) as BX.
    pose proof Hp as ((_ & Fw & _) & _).
  rewrite is_beside_is in H by (rewrite ?Vx; assumption). rewrite Vx in H.
  destruct (Rle_lt_dec (Rabs X) (value32 w / 2)) as [Hin|Hin].
  - rewrite Rle_bool_true in H by exact Hin. exact (along_shaded_is_right R w K x X gap M answer Hp Cx Hin (Sg Hin) H).
  - rewrite Rle_bool_false in H by exact Hin. cbn [negb] in H. rewrite (Beside Hin). unfold shaded_x, shaded_z.
    rewrite Rle_bool_false by exact Hin. rewrite Rmult_1_r. apply is_answer_same with (Z < 0); [split; lra|].
    exact (on_plane_is_right R w K _ Z answer Hp Cz H).
Qed.

Theorem bump_2p_shaded_second_stage_answers_right : forall R w K x y z answer, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_2p (value32 R) (value32 w) X Z in
  bump_2p_shaded_second R w K (quantised x) (quantised z) = Some answer ->
  is_answer answer (0 < M) (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros R w K x y z answer Hp Hv X Z M H. destruct (quantised_x_is _ _ _ Hv) as [Vx Fx], (valid_coordinates _ _ _ Hv) as [Cx Cz].
  fold X in Vx, Cx. fold Z in Cz. refine (shaded_second_is_right R w K _ X _ Z _ M answer Hp Fx Vx Cx Cz _ _ H); intro Hin.
  - apply (gap_or_foot_is R w K _ X _ Z); try assumption; [exact (coordinate_range _ _ Cx)|now apply (side_gap_is R w K)|].
    intro E. unfold M, penetration_2p. rewrite Rle_bool_true by exact Hin. rewrite E. pose proof Hp as (_ & _ & Hw & _). field. lra.
  - unfold M, penetration_2p. now rewrite Rle_bool_false by exact Hin.
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
