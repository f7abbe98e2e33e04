(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second stage of bump-2p in double-double: exact() of fast/laws/bump_2p.h. An answer that it gives is right, however far the gap
   has cancelled. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants DoubleDoubleTerms Enclosures.
From Forceshade Require Import EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondStage SecondAlong Bump1pShadedSecond
  TwoPolygonsGap.
Open Scope R_scope.

Definition bump_2p_second (R w K x z : binary32) : option evaluation :=
  if is_beside w x then decide_along K (exactly64 (opp (to64 z))) (exactly64 zero64) (exactly64 (two_to 0))
  else decide_along K (side_gap_2p R w x z) (if is_less32 x zero32 then negated (face_sine_2p R w) else face_sine_2p R w)
    (face_cosine_2p R w).

Lemma less32_is : forall a b, is_finite 24 128 a = true -> is_finite 24 128 b = true -> is_less32 a b = Rlt_bool (value32 a) (value32 b).
Proof.
  intros a b Fa Fb. unfold is_less32. rewrite Bcompare_correct by assumption.
    case Rcompare_spec; case Rlt_bool_spec; intros; trivial; exfalso; lra.
Qed.

Lemma is_answer_same : forall answer p q Fx Fz, (p <-> q) -> is_answer answer p Fx Fz -> is_answer answer q Fx Fz.
Proof. intros answer p q Fx Fz E [[H1 H2]|[H1 H2]]; [left; split; [tauto|exact H2]|right; split; [tauto|exact H2]]. Qed.

(* On a face, of which sine and cosine are enclosed. *)
Lemma on_face_is_right : forall R w K gap M slope s sine c cosine is_left answer, parameters R w K -> settled gap M ->
  encloses s sine (sine_of slope) -> 0 <= s <= / 1000 -> / 40000000 <= sine_of slope <= 1 ->
  encloses c cosine (cosine_of slope) -> 0 <= c <= / 1000 -> / 40000000 <= cosine_of slope <= 1 ->
  decide_along K gap (if is_left : bool then negated sine else sine) cosine = Some answer ->
  is_answer answer (0 < M) (value32 K * M * (if is_left then - sine_of slope else sine_of slope)) (value32 K * M * cosine_of slope).
Proof.
  intros R w K gap M slope s sine c cosine is_left answer Hp Sg Es Hs Bs Ec Hc Bc H.
  assert (En : encloses s (if is_left then negated sine else sine) (if is_left then - sine_of slope else sine_of slope))
    by (destruct is_left; [now apply encloses_negated|exact Es]).
  refine (along_is_right R w K gap M _ _ _ _ _ _ _ answer Hp (proj1 Sg) (iff_refl _) En Hs Ec Hc _ H). intros Pos _.
  split; [apply (settled_is_directed gap M _ _ s Sg Pos En Hs)|apply (settled_is_directed gap M _ _ c Sg Pos Ec Hc)]; right.
  - destruct is_left; rewrite ?Rabs_Ropp, Rabs_pos_eq; lra.
  - rewrite Rabs_pos_eq; lra.
Qed.

Lemma second_2p_is : forall R w K x X z, is_finite 24 128 w = true -> is_finite 24 128 x = true -> value32 x = X -> Rabs X <= 10000 ->
  bump_2p_second R w K x z =
    if Rle_bool (Rabs X) (value32 w / 2)
    then decide_along K (side_gap_2p R w x z) (if Rlt_bool X 0 then negated (face_sine_2p R w) else face_sine_2p R w) (face_cosine_2p R w)
    else decide_along K (exactly64 (opp (to64 z))) (exactly64 zero64) (exactly64 (two_to 0)).
Proof.
  intros R w K x X z Fw Fx Vx BX. unfold bump_2p_second. rewrite is_beside_is by (rewrite ?Vx; assumption).
  rewrite (less32_is x zero32 Fx eq_refl), Vx. destruct (Rle_bool (Rabs X) (value32 w / 2)); reflexivity.
Qed.

Lemma bump_2p_second_is_right : forall R w K x X z Z answer, parameters R w K -> is_finite 24 128 x = true -> value32 x = X ->
  coordinate (to64 x) X -> coordinate (to64 z) Z ->
  let M := penetration_2p (value32 R) (value32 w) X Z in let S := slope_2p (value32 R) (value32 w) in
  bump_2p_second R w K x z = Some answer ->
  is_answer answer (0 < M) (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros R w K x X z Z answer Hp Fx Vx Cx Cz M S H. pose proof (coordinate_range _ _ Cx) as BX. pose proof Hp as ((_ & Fw & _) & _).
  rewrite (second_2p_is R w K x X z Fw Fx Vx BX) in H. destruct (Rle_lt_dec (Rabs X) (value32 w / 2)) as [Hin|Hin].
  - pose proof (side_gap_is R w K x X z Z Hp Fx Vx Cx Cz Hin) as Sg. unfold side_x, side_z.
    rewrite Rle_bool_true in H |- * by exact Hin. destruct (face_enclosed R w K Hp) as (_ & [Es Bs] & [Ec Bc]).
    pose proof share_is_small as Hsh. fold S in Es, Bs, Ec, Bc.
    refine (on_face_is_right R w K _ M S _ _ _ _ _ answer Hp Sg Es _ Bs Ec _ _ H); lra.
  - assert (EM : M = - Z) by (unfold M, penetration_2p; now rewrite Rle_bool_false by exact Hin). unfold side_x, side_z. rewrite EM.
    rewrite Rle_bool_false in H |- * by exact Hin. rewrite Rmult_1_r.
    apply is_answer_same with (Z < 0); [split; lra|]. exact (on_plane_is_right R w K _ Z answer Hp Cz H).
Qed.

Theorem bump_2p_second_stage_answers_right : forall R w K x y z answer, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_2p (value32 R) (value32 w) X Z in let S := slope_2p (value32 R) (value32 w) in
  bump_2p_second R w K (quantised x) (quantised z) = Some answer ->
  is_answer answer (0 < M) (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros R w K x y z answer Hp Hv.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx], (valid_coordinates _ _ _ Hv) as [Cx Cz].
  exact (bump_2p_second_is_right R w K _ _ _ _ answer Hp Fx Vx Cx Cz).
Qed.

(* Every answer of the first two stages is right, for every input of the domain. *)
Theorem bump_2p_two_stages_answer_right : forall is_fused R w K third x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_2p (value32 R) (value32 w) X Z in let S := slope_2p (value32 R) (value32 w) in
  right_or_later (evaluate bump_2p_window (bump_2p_of R w K is_fused) (later_of (bump_2p_second R w K) third) x y z)
    (third (quantised x) (quantised z)) (0 < M) (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros is_fused R w K third x y z Hp Hv X Z M S. apply two_stages_are_right with (second := bump_2p_second R w K).
  - now apply bump_2p_first_stage_answers_right_for_all.
  - intros found H. now apply (bump_2p_second_stage_answers_right R w K x y z found).
Qed.
