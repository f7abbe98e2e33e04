(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second stage of bump-3p-shaded in double-double: exact() of fast/laws/bump_3p_shaded.h. An answer that it gives is right, however
   far the gap has cancelled. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants DoubleDoubleTerms Enclosures.
From Forceshade Require Import BesideTie SecondStage SecondAlong Bump1pShadedSecond TwoPolygonsGap Bump2pSecond ShadedAlong
  Bump2pShadedSecond.
From Forceshade Require Import ThreePolygons ThreePolygonsFace ThreePolygonsConstants NewtonThird TopEdge ThreePolygonsRight
  ThreePolygonsGap.
Open Scope R_scope.

Definition bump_3p_shaded_second (R w K x z : binary32) : option evaluation :=
  let foot := exactly64 (opp (to64 z)) in
  if is_beside w x then decide_along K foot (exactly64 zero64) (exactly64 (two_to 0))
  else along_shaded R K x (if is_at_foot w x then foot else if is_on_flat R w x then top_gap_3p R w z else side_gap_3p R w x z).

(* The foot is not on the top. *)
Lemma top_is_narrower : forall R w K, parameters R w K -> top_width (value32 R) (value32 w) / 2 < value32 w / 2.
Proof.
  intros R w K Hp. pose proof (third_sine_range R w K Hp) as Bt. destruct Hp as (_ & HR & Hw & _).
  destruct (third_sine_is (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (_ & E & -> & _). set (t := third_sine _ _) in *.
  assert (Ew : value32 w / 2 = value32 R * (3 * t - 4 * (t * t * t))).
  { replace (3 * t - 4 * (t * t * t)) with (value32 w / (2 * value32 R)) by lra. field. lra. }
  rewrite Ew. apply Rmult_lt_compat_l; [lra|].
  assert (t * t * t <= / 2 * / 2 * t); [|lra]. apply Rmult_le_compat_r; [lra|apply Rmult_le_compat; lra].
Qed.

Theorem bump_3p_shaded_second_stage_answers_right : forall R w K x y z answer, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_3p (value32 R) (value32 w) X Z in
  bump_3p_shaded_second R w K (quantised x) (quantised z) = Some answer ->
  is_answer answer (0 < M) (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros R w K x y z answer Hp Hv X Z M H. destruct (quantised_x_is _ _ _ Hv) as [Vx Fx], (valid_coordinates _ _ _ Hv) as [Cx Cz].
  fold X in Vx, Cx. fold Z in Cz. refine (shaded_second_is_right R w K _ X _ Z _ M answer Hp Fx Vx Cx Cz _ _ H); intro Hin.
  - apply (gap_or_foot_is R w K _ X _ Z); try assumption; [exact (coordinate_range _ _ Cx)|now apply (gap_3p_is_settled R w K)|].
    intro E. pose proof (top_is_narrower R w K Hp) as Hnarrow. pose proof Hp as (_ & _ & Hw & _). unfold M, penetration_3p.
    rewrite (Rle_bool_true (Rabs X) (value32 w / 2)) by exact Hin. rewrite Rle_bool_false by lra. rewrite E. field. lra.
  - unfold M, penetration_3p. now rewrite Rle_bool_false by exact Hin.
Qed.

(* Every answer of the first two stages is right, for every input of the domain. *)
Theorem bump_3p_shaded_two_stages_answer_right : forall is_fused R w K third x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_3p (value32 R) (value32 w) X Z in
  right_or_later
    (evaluate bump_3p_shaded_window (bump_3p_shaded_of R w K (sine_of_third R w) (top_of R w) is_fused)
       (later_of (bump_3p_shaded_second R w K) third) x y z)
    (third (quantised x) (quantised z)) (0 < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros is_fused R w K third x y z Hp Hv X Z M. apply two_stages_are_right with (second := bump_3p_shaded_second R w K).
  - now apply bump_3p_shaded_first_stage_answers_right_for_all.
  - intros found H. now apply (bump_3p_shaded_second_stage_answers_right R w K x y z found).
Qed.
