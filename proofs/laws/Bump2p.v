(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second and the third stage of bump-2p: exact() of fast/laws/bump_2p.h in double-double and with numbers of 2048 bits. An answer
   that the second gives is right, however far the gap has cancelled; the third's is right, and so is every answer of the law. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants DoubleDoubleTerms Enclosures.
From Forceshade Require Import EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondStage SecondAlong TwoPolygonsGap.
From Forceshade Require Import ShadingRoot.
Open Scope R_scope.

(* ---- The second stage ---- *)

Definition bump_2p_second (R w K x z : binary32) : option evaluation :=
  if is_beside w x then decide_along K (exactly64 (opp (to64 z))) (exactly64 zero64) (exactly64 (two_to 0))
  else decide_along K (side_gap_2p R w x z) (if is_less32 x zero32 then negated (face_sine_2p R w) else face_sine_2p R w)
    (face_cosine_2p R w).

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

(* ---- The third stage ---- *)

From Forceshade Require Import Separation SeparationOfBump2p SeparationOfContact BigFloat BigFloatValues BigFloatRight BigFloatTight.
From Forceshade Require Import ThirdAlong TwoPolygonsThird.

Definition bump_2p_third (R w K x z : binary32) : evaluation :=
  if is_beside w x then along_big 2048 K (number (opp (to64 z))) (number zero64) (number (two_to 0))
  else along_big 2048 K (side_gap_third R w x z) (if is_less32 x zero32 then negated (sine_third R w) else sine_third R w)
    (cosine_third R w).

Theorem bump_2p_third_stage_answers_right : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_2p (value32 R) (value32 w) X Z in let S := slope_2p (value32 R) (value32 w) in
  is_answer (bump_2p_third R w K (quantised x) (quantised z)) (0 < M) (side_x (value32 w) (value32 K) S X M) (side_z (value32 w)
    (value32 K) S X M).
Proof.
  intros R w K x y z Hp Hv X Z M S. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx]. fold X in Vx. pose proof Hp as ((FR & Fw & _) & HR & Hw & HK).
  pose proof (coordinate_range _ _ Cx) as BX.
  pose proof (fun m H => bump_2p_is_separated R w K x y z m Hp Hv H) as Sep. cbv zeta in Sep. fold X Z M S in Sep.
  pose proof (bump_2p_contact_is_separated R w K x y z Hp Hv) as Sepc. cbv zeta in Sepc. fold X Z M in Sepc.
  unfold bump_2p_third. rewrite is_beside_is by (rewrite ?Vx; assumption). rewrite (less32_is _ zero32 Fx eq_refl), Vx.
  change (value32 zero32) with 0. unfold side_x, side_z in *. destruct (Rle_lt_dec (Rabs X) (value32 w / 2)) as [Hin|Hin].
  2: { rewrite Rle_bool_false in Sep |- * by exact Hin. cbn [negb].
    assert (EM : M = - Z) by (unfold M, penetration_2p; now rewrite Rle_bool_false by exact Hin). rewrite EM, Rmult_1_r in Sep |- *.
    apply (plane_third 2048 859 R w); try assumption; lia. }
  rewrite Rle_bool_true in Sep |- * by exact Hin. cbn [negb].
  destruct (side_gap_third_is R w K _ X _ Z Hp Fx Vx Cx Cz Hin Sepc) as [Sg UM]. fold M in Sg, UM.
  destruct (face_third R w K Hp) as (_ & Ts & Tc). destruct (face_enclosed R w K Hp) as (_ & [_ Bs] & [_ Bc]). fold S in Ts, Tc, Bs, Bc.
  assert (Sg' : seen 2048 2000000000000 (-1723) (side_gap_third R w (quantised x) (quantised z)) M) by (apply seen_more with
    (1 := Sg); [numbers; lia|lia]).
  assert (Tn : tight 2048 2000000000000 (-1723) (if Rlt_bool X 0 then negated (sine_third R w) else sine_third R w)
    (if Rlt_bool X 0 then - sine_of S else sine_of S)).
  { destruct (Rlt_bool X 0); [apply tight_negated|]; apply tight_more with (1 := Ts); try (numbers; lia); lia. }
  assert (Tc' : tight 2048 2000000000000 (-1723) (cosine_third R w) (cosine_of S)) by (apply tight_more with (1 := Tc); [numbers; lia|lia]).
  set (n := if Rlt_bool X 0 then - sine_of S else sine_of S) in *.
  assert (Bn : Rabs n = sine_of S) by (unfold n; destruct (Rlt_bool X 0); rewrite ?Rabs_Ropp; apply Rabs_pos_eq; lra).
  apply (along_big_is_right 2048 2000000000000 (-1723) 25 859 R w); try assumption; try lia; try (numbers; lia); try reflexivity.
  intro T. specialize (Sepc ltac:(lra)). rewrite Rabs_pos_eq in Sepc by lra.
  assert (LM : bpow radix2 (-300) <= M) by (apply Rle_trans with (2 := Sepc); apply bpow_le; lia).
  assert (L40 : bpow radix2 (-40) <= / 40000000) by (simpl; lra).
  assert (along : forall c, 0 <= c <= 1 -> M * c <= 20000).
  { intros c Hc. apply Rle_trans with (20000 * 1); [apply Rmult_le_compat; lra|lra]. }
  split; apply large_component; try assumption; rewrite ?Bn, ?(Rabs_pos_eq (cosine_of S)) by lra; try (right; lra); apply along; lra.
Qed.

(* Every answer is right, for every input of the domain. *)
Theorem bump_2p_answers_right : forall is_fused R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_2p (value32 R) (value32 w) X Z in let S := slope_2p (value32 R) (value32 w) in
  is_answer (evaluate bump_2p_window (bump_2p_of R w K is_fused) (later_of (bump_2p_second R w K) (bump_2p_third R w K)) x y z) (0 < M)
    (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros is_fused R w K x y z Hp Hv X Z M S. apply three_stages_are_right with (bump_2p_third R w K (quantised x) (quantised z)).
  - now apply bump_2p_two_stages_answer_right.
  - now apply (bump_2p_third_stage_answers_right R w K x y z).
Qed.
