(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second stage of bump-3p in double-double: exact() of fast/laws/bump_3p.h. An answer that it gives is right, however far the gap
   has cancelled. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants DoubleDoubleTerms Enclosures.
From Forceshade Require Import BesideTie SecondStage SecondAlong TwoPolygonsGap Bump2pSecond ThreePolygons ThreePolygonsConstants
  NewtonThird.
From Forceshade Require Import TopEdge ThreePolygonsRight ThreePolygonsGap.
Open Scope R_scope.

Definition bump_3p_second (R w K x z : binary32) : option evaluation :=
  let t := sine_of_third R w in
  if is_beside w x then decide_along K (exactly64 (opp (to64 z))) (exactly64 zero64) (exactly64 (two_to 0))
  else if is_on_flat R w x then decide_along K (top_gap_3p R w z) (exactly64 zero64) (exactly64 (two_to 0))
  else decide_along K (side_gap_3p R w x z) (if is_less32 x zero32 then negated (sine_3p_of t) else sine_3p_of t) (cosine_3p_of t).

(* On the flat top. *)
Lemma on_flat_is_right : forall R w K gap M answer, parameters R w K -> settled gap M ->
  decide_along K gap (exactly64 zero64) (exactly64 (two_to 0)) = Some answer -> is_answer answer (0 < M) 0 (value32 K * M).
Proof.
  intros R w K gap M answer Hp Sg H. pose proof (encloses_exact _ _ (exactly_is _ _ zero_is)) as E0.
  pose proof (encloses_exact _ _ (exactly_is _ _ (two_to_is 0 ltac:(lia)))) as E1. change (bpow radix2 0) with 1 in E1.
  enough (A : is_answer answer (0 < M) (value32 K * M * 0) (value32 K * M * 1)) by (rewrite Rmult_0_r, Rmult_1_r in A; exact A).
  refine (along_is_right R w K gap M _ 0 0 _ 1 0 (0 < M) answer Hp (proj1 Sg) (iff_refl _) E0 _ E1 _ _ H); [lra|lra|]. intros Pos _.
  split; [apply (settled_is_directed gap M _ 0 0 Sg Pos E0)|apply (settled_is_directed gap M _ 1 0 Sg Pos E1)]; rewrite ?Rabs_R1; lra.
Qed.

Lemma bump_3p_second_is_right : forall R w K x X z Z answer, parameters R w K -> is_finite 24 128 x = true -> value32 x = X ->
  coordinate (to64 x) X -> coordinate (to64 z) Z ->
  let M := penetration_3p (value32 R) (value32 w) X Z in let S := slope_at (value32 R) (value32 w) X in
  bump_3p_second R w K x z = Some answer ->
  is_answer answer (0 < M) (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros R w K x X z Z answer Hp Fx Vx Cx Cz M S H. pose proof (coordinate_range _ _ Cx) as BX. pose proof Hp as ((_ & Fw & _) & _).
  unfold bump_3p_second in H. cbv zeta in H. rewrite is_beside_is in H by (rewrite ?Vx; assumption). rewrite Vx in H.
  destruct (Rle_lt_dec (Rabs X) (value32 w / 2)) as [Hin|Hin].
  - pose proof (gap_3p_is_settled R w K x X z Z Hp Fx Vx Cx Cz Hin) as Sg. fold M in Sg. unfold side_x, side_z.
    rewrite Rle_bool_true in H |- * by exact Hin. cbn [negb] in H. rewrite (is_on_flat_is R w K x Hp Fx), Vx in H, Sg.
    unfold S, slope_at. revert H Sg. case Rle_bool_spec; intros Htop H Sg.
    + destruct flat as [-> ->]. rewrite Rmult_1_r. replace (if Rlt_bool X 0 then - 0 else 0) with 0 by (destruct (Rlt_bool X 0); ring).
      rewrite Rmult_0_r. exact (on_flat_is_right R w K _ M answer Hp Sg H).
    + rewrite (less32_is x zero32 Fx eq_refl), Vx in H. change (value32 zero32) with 0 in H.
      destruct (shape_enclosed R w K Hp) as (_ & [Es Bs] & [Ec Bc] & _).
      refine (on_face_is_right R w K _ M _ _ _ _ _ _ answer Hp Sg Es _ Bs Ec _ _ H); lra.
  - assert (EM : M = - Z) by (unfold M, penetration_3p; now rewrite Rle_bool_false by exact Hin). unfold side_x, side_z. rewrite EM.
    rewrite Rle_bool_false in H |- * by exact Hin. rewrite Rmult_1_r.
    apply is_answer_same with (Z < 0); [split; lra|]. exact (on_plane_is_right R w K _ Z answer Hp Cz H).
Qed.

Theorem bump_3p_second_stage_answers_right : forall R w K x y z answer, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_3p (value32 R) (value32 w) X Z in let S := slope_at (value32 R) (value32 w) X in
  bump_3p_second R w K (quantised x) (quantised z) = Some answer ->
  is_answer answer (0 < M) (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros R w K x y z answer Hp Hv.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx], (valid_coordinates _ _ _ Hv) as [Cx Cz].
  exact (bump_3p_second_is_right R w K _ _ _ _ answer Hp Fx Vx Cx Cz).
Qed.

(* Every answer of the first two stages is right, for every input of the domain. *)
Theorem bump_3p_two_stages_answer_right : forall is_fused R w K third x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_3p (value32 R) (value32 w) X Z in let S := slope_at (value32 R) (value32 w) X in
  right_or_later
    (evaluate bump_3p_window (bump_3p_of R w K (sine_of_third R w) (top_of R w) is_fused) (later_of (bump_3p_second R w K) third) x y z)
    (third (quantised x) (quantised z)) (0 < M) (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros is_fused R w K third x y z Hp Hv X Z M S. apply two_stages_are_right with (second := bump_3p_second R w K).
  - now apply bump_3p_first_stage_answers_right_for_all.
  - intros found H. now apply (bump_3p_second_stage_answers_right R w K x y z found).
Qed.
