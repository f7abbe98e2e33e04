(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second and the third stage of bump-3p: exact() of fast/laws/bump_3p.h in double-double and with numbers of 4096 bits. An answer
   that the second gives is right, however far the gap has cancelled; the third's is right, and so is every answer of the law. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants DoubleDoubleTerms Enclosures.
From Forceshade Require Import BesideTie SecondStage SecondAlong TwoPolygonsGap ThreePolygons ThreePolygonsConstants NewtonThird TopEdge.
From Forceshade Require Import ThreePolygonsRight ThreePolygonsGap.
Open Scope R_scope.

(* ---- The second stage ---- *)

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

(* ---- The third stage ---- *)

From Forceshade Require Import Separation SeparationOfBump3p SeparationOfContact BigFloat BigFloatValues BigFloatRight BigFloatTight.
From Forceshade Require Import ThirdAlong TwoPolygonsThird SineThirdStage ThreePolygonsThird.

Definition bump_3p_third (R w K x z : binary32) : evaluation :=
  let t := sine_of_third_big 4096 R w in
  if is_beside w x then along_big 4096 K (exactly 4096 (opp (to64 z))) (exactly 4096 zero64) (exactly 4096 (two_to 0))
  else if is_on_flat R w x then along_big 4096 K (top_gap_third R w z) (exactly 4096 zero64) (exactly 4096 (two_to 0))
  else along_big 4096 K (side_gap_big 4096 (tangent_big 4096 t) w x z)
    (if is_less32 x zero32 then negated (sine_big 4096 t) else sine_big 4096 t) (cosine_big 4096 t).

(* K times a gap along a direction of which the components are not above 1. *)
Lemma along_gap_is_right : forall m s R w K gap M a A b B, parameters R w K -> (2 <= m <= 926)%Z -> (29 <= s <= 3900)%Z ->
  Rabs M <= bpow radix2 (17 - m) -> (M <> 0 -> bpow radix2 (-909) <= Rabs M) -> seen 4096 2800000000000 (m - 4003) gap M ->
  tight 4096 15000000000 (-4015) a A -> tight 4096 15000000000 (-4015) b B -> A = 0 \/ bpow radix2 (-40) <= Rabs A -> Rabs A <= 1 ->
  B = 0 \/ bpow radix2 (-40) <= Rabs B -> Rabs B <= 1 ->
  (forall m, is_tie m -> (value32 K * M * A <> m -> bpow radix2 (- s) <= Rabs (value32 K * M * A - m)) /\
    (value32 K * M * B <> m -> bpow radix2 (- s) <= Rabs (value32 K * M * B - m))) ->
  is_answer (along_big 4096 K gap a b) (0 < M) (value32 K * M * A) (value32 K * M * B).
Proof.
  intros m s R w K gap M a A b B Hp Hm Hs BM SepM Sg Ta Tb LA UA LB UB Sep. pose proof Hp as (_ & _ & _ & HK).
  assert (Ta' : tight 4096 2800000000000 (m - 4003) a A) by (apply tight_more with (1 := Ta); [numbers; lia|lia]).
  assert (Tb' : tight 4096 2800000000000 (m - 4003) b B) by (apply tight_more with (1 := Tb); [numbers; lia|lia]).
  apply (along_big_is_right 4096 2800000000000 (m - 4003) (27 - m) s R w); try assumption; try lia; try (numbers; lia); try reflexivity.
  intro T. specialize (SepM ltac:(lra)). rewrite Rabs_pos_eq in SepM, BM by lra.
  assert (LM : bpow radix2 (-930) <= M) by (apply Rle_trans with (2 := SepM); apply bpow_le; lia).
  assert (one : forall n, Rabs n <= 1 -> M * Rabs n <= bpow radix2 (17 - m)).
  { intros n Hn. apply Rle_trans with (M * 1); [apply Rmult_le_compat_l; lra|lra]. }
  replace (27 - m)%Z with (17 - m + 10)%Z by ring. split; apply component_is_large; try assumption; now apply one.
Qed.

Theorem bump_3p_third_stage_answers_right : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_3p (value32 R) (value32 w) X Z in let S := slope_at (value32 R) (value32 w) X in
  is_answer (bump_3p_third R w K (quantised x) (quantised z)) (0 < M) (side_x (value32 w) (value32 K) S X M) (side_z (value32 w)
    (value32 K) S X M).
Proof.
  intros R w K x y z Hp Hv X Z M S. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx]. fold X in Vx. pose proof Hp as ((FR & Fw & _) & HR & Hw & HK).
  pose proof (coordinate_range _ _ Cx) as BX.
  pose proof (fun m H => bump_3p_is_separated R w K x y z m Hp Hv H) as Sep. cbv zeta in Sep. fold X Z M S in Sep.
  pose proof (bump_3p_contact_is_separated R w K x y z Hp Hv) as Sepc. cbv zeta in Sepc. fold X Z M in Sepc.
  unfold bump_3p_third. cbv zeta. rewrite is_beside_is by (rewrite ?Vx; assumption). rewrite (less32_is _ zero32 Fx eq_refl), Vx.
  change (value32 zero32) with 0. unfold side_x, side_z in *. destruct (Rle_lt_dec (Rabs X) (value32 w / 2)) as [Hin|Hin].
  2: { rewrite Rle_bool_false in Sep |- * by exact Hin. cbn [negb].
    assert (EM : M = - Z) by (unfold M, penetration_3p; now rewrite Rle_bool_false by exact Hin). rewrite EM, Rmult_1_r in Sep |- *.
    apply (plane_third 4096 2033 R w); try assumption; lia. }
  rewrite Rle_bool_true in Sep |- * by exact Hin. cbn [negb].
  destruct (gap_3p_third_is R w K _ X _ Z Hp Fx Vx Cx Cz Hin Sepc) as (m & Bm & BM & Sg). fold M in BM, Sg.
  unfold gap_3p_third in Sg. rewrite (is_on_flat_is R w K _ Hp Fx), Vx in Sg |- *. unfold S, slope_at in *.
  revert Sg Sep. case Rle_bool_spec; intros Htop Sg Sep.
  - destruct flat as [Fs Fc]. rewrite Fs, Fc in Sep |- *.
    replace (if Rlt_bool X 0 then - 0 else 0) with 0 in * by (destruct (Rlt_bool X 0); ring).
    rewrite Rmult_0_r, Rmult_1_r in Sep |- *.
    assert (E0 : value32 K * M * 0 = 0) by ring. assert (E1 : value32 K * M * 1 = value32 K * M) by ring.
    pose proof (two_to_is 0 ltac:(lia)) as I1. change (bpow radix2 0) with 1 in I1.
    pose proof (tight_exactly 4096 (-4015) _ _ ltac:(lia) ltac:(numbers; lia) zero_is) as T0.
    pose proof (tight_exactly 4096 (-4015) _ _ ltac:(lia) ltac:(numbers; lia) I1) as T1.
    assert (T0' : tight 4096 15000000000 (-4015) (exactly 4096 zero64) 0) by (apply tight_more with (1 := T0); [numbers; lia|lia]).
    assert (T1' : tight 4096 15000000000 (-4015) (exactly 4096 (two_to 0)) 1) by (apply tight_more with (1 := T1); [numbers; lia|lia]).
    assert (A : is_answer (along_big 4096 K (top_gap_third R w (quantised z)) (exactly 4096 zero64) (exactly 4096 (two_to 0))) (0 < M)
      (value32 K * M * 0) (value32 K * M * 1)).
    { apply (along_gap_is_right m 2033 R w); try assumption; try lia; try (rewrite ?Rabs_R0, ?Rabs_R1; lra).
      - right. rewrite Rabs_R1. apply (bpow_le radix2 (-40) 0). lia.
      - intros n Hn. rewrite E0, E1. now apply Sep. }
    rewrite E0, E1 in A. exact A.
  - destruct (shape_third R w K Hp) as (_ & Ts & Tc & _). destruct (shape_enclosed R w K Hp) as (_ & [_ Bs] & [_ Bc] & _).
    set (slope := slope_3p (value32 R) (value32 w)) in *. set (t := sine_of_third_big 4096 R w) in *.
    assert (L40 : bpow radix2 (-40) <= / 40000000) by (simpl; lra).
    assert (Tn : tight 4096 15000000000 (-4015) (if Rlt_bool X 0 then negated (sine_big 4096 t) else sine_big 4096 t)
      (if Rlt_bool X 0 then - sine_of slope else sine_of slope)) by (destruct (Rlt_bool X 0); [now apply tight_negated|exact Ts]).
    set (n := if Rlt_bool X 0 then - sine_of slope else sine_of slope) in *.
    assert (Bn : Rabs n = sine_of slope) by (unfold n; destruct (Rlt_bool X 0); rewrite ?Rabs_Ropp; apply Rabs_pos_eq; lra).
    apply (along_gap_is_right m 2033 R w); try assumption; try lia; rewrite ?Bn, ?(Rabs_pos_eq (cosine_of slope)) by lra; try lra;
      right; lra.
Qed.

(* Every answer is right, for every input of the domain. *)
Theorem bump_3p_answers_right : forall is_fused R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_3p (value32 R) (value32 w) X Z in let S := slope_at (value32 R) (value32 w) X in
  is_answer (evaluate bump_3p_window (bump_3p_of R w K (sine_of_third R w) (top_of R w) is_fused)
      (later_of (bump_3p_second R w K) (bump_3p_third R w K)) x y z) (0 < M)
    (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros is_fused R w K x y z Hp Hv X Z M S. apply three_stages_are_right with (bump_3p_third R w K (quantised x) (quantised z)).
  - now apply bump_3p_two_stages_answer_right.
  - now apply (bump_3p_third_stage_answers_right R w K x y z).
Qed.
