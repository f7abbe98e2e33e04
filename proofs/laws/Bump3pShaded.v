(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second and the third stage of bump-3p-shaded: exact() of fast/laws/bump_3p_shaded.h in double-double and with numbers of 4096
   bits. An answer that the second gives is right, however far the gap has cancelled; the third's is right, and so is every answer of
   the law. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants DoubleDoubleTerms Enclosures.
From Forceshade Require Import BesideTie SecondStage SecondAlong TwoPolygonsGap ShadedAlong ThreePolygons ThreePolygonsFace.
From Forceshade Require Import ThreePolygonsConstants NewtonThird TopEdge ThreePolygonsRight ThreePolygonsGap ShadingRoot.
Open Scope R_scope.

(* ---- The second stage ---- *)

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

(* ---- The third stage ---- *)

From Forceshade Require Import Separation SeparationOfBump3pShaded SeparationOfContact BigFloat BigFloatValues BigFloatRight.
From Forceshade Require Import BigFloatTight ThirdAlong TwoPolygonsThird SineThirdStage ThreePolygonsThird.

Definition bump_3p_shaded_third (R w K x z : binary32) : evaluation :=
  let foot := exactly 4096 (opp (to64 z)) in
  if is_beside w x then along_big 4096 K foot (exactly 4096 zero64) (exactly 4096 (two_to 0))
  else along_shaded_big 4096 K R x (if is_at_foot w x then foot else gap_3p_third R w x z).

(* K times a gap, force shaded. *)
Lemma along_shaded_gap_is_right : forall m R w K x X gap M, parameters R w K -> coordinate (to64 x) X -> Rabs X <= value32 R ->
  (2 <= m <= 926)%Z -> Rabs M <= bpow radix2 (17 - m) -> (M <> 0 -> bpow radix2 (-909) <= Rabs M) ->
  seen 4096 2800000000000 (m - 4003) gap M -> let P := (value32 R - X) * (value32 R + X) in
  (forall n, is_tie n -> (value32 K * M * (X / value32 R) <> n -> bpow radix2 (-3598) <= Rabs (value32 K * M * (X / value32 R) - n)) /\
    (value32 K * M * (sqrt P / value32 R) <> n -> bpow radix2 (-3598) <= Rabs (value32 K * M * (sqrt P / value32 R) - n))) ->
  is_answer (along_shaded_big 4096 K R x gap) (0 < M) (value32 K * M * (X / value32 R)) (value32 K * M * (sqrt P / value32 R)).
Proof.
  intros m R w K x X gap M Hp Cx HXR Bm BM SepM Sg P Sep. pose proof Hp as ((FR & Fw & _) & HR & Hw & HK).
  destruct (shading_root_enclosed R w K _ X Hp Cx HXR) as [_ Lr]. cbv zeta in Lr.
  pose proof (shading_root_tight 4096 R w K _ X ltac:(lia) ltac:(numbers; lia) Hp Cx HXR) as Tr. cbv zeta in Tr. fold P in Lr, Tr.
  assert (EX : value32 K * (M / value32 R) * X = value32 K * M * (X / value32 R)) by (field; lra).
  assert (EZ : value32 K * (M / value32 R) * sqrt P = value32 K * M * (sqrt P / value32 R)) by (field; lra).
  rewrite <- EX, <- EZ in Sep |- *. clear EX EZ.
  pose proof (tight_exactly 4096 (-4096) _ _ ltac:(lia) ltac:(numbers; lia) (to64_is_exact R FR)) as TR0.
  assert (TR : tight 4096 2800000000000 (-4096) (exactly 4096 (to64 R)) (value32 R)) by (apply tight_more with (1 := TR0);
    [numbers; lia|lia]).
  pose proof (seen_divide 4096 2800000000000 (m - 4003) (-4096) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) Sg
    TR ltac:(lra))
    as Sd.
  assert (Sd' : seen 4096 170000000000000 (m - 3997) (divide_newton 4096 gap (exactly 4096 (to64 R))) (M / value32 R))
    by (apply seen_more with (1 := Sd); [numbers; lia|lia]).
  pose proof (tight_exactly 4096 (-4096) _ _ ltac:(lia) ltac:(numbers; lia) (coordinate_is _ _ Cx)) as Tx0.
  assert (Tx : tight 4096 170000000000000 (m - 3997) (exactly 4096 (to64 x)) X) by (apply tight_more with (1 := Tx0); [numbers; lia|lia]).
  assert (Tr' : tight 4096 170000000000000 (m - 3997) (square_root_newton 4096 (multiply 4096 (subtract 4096 (exactly 4096 (to64 R))
    (exactly 4096 (to64 x))) (add 4096 (exactly 4096 (to64 R)) (exactly 4096 (to64 x))))) (sqrt P))
    by (apply tight_more with (1 := Tr); [numbers; lia|lia]).
  set (G := M / value32 R) in *. assert (HRinv : bpow radix2 (-14) <= / value32 R).
  { apply Rle_trans with (/ 10000); [simpl; lra|apply Rinv_le; lra]. }
  pose proof (bpow_gt_0 radix2 (-14)) as P14. assert (Hc : 0 < G <-> 0 < M).
  { unfold G. split; intro T; [|unfold Rdiv; apply Rmult_lt_0_compat; lra].
    replace M with (M / value32 R * value32 R) by (field; lra). apply Rmult_lt_0_compat; lra. }
  assert (along : forall n, 0 <= n <= value32 R -> 0 < M -> G * n <= bpow radix2 (17 - m)).
  { intros n Hn T. unfold G. replace (M / value32 R * n) with (M * (n / value32 R)) by (field; lra). rewrite Rabs_pos_eq in BM by lra.
    assert (0 <= n / value32 R <= 1).
    { split; [apply Rmult_le_pos; lra|]. apply Rmult_le_reg_r with (value32 R); [lra|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. lra. }
    apply Rle_trans with (M * 1); [apply Rmult_le_compat; lra|lra]. }
  assert (BP : 0 <= sqrt P <= value32 R).
  { split; [apply sqrt_pos|]. rewrite <- (sqrt_square (value32 R)) by lra. apply sqrt_le_1_alt. unfold P.
    pose proof (Rle_0_sqr X) as S. unfold Rsqr in S. lra. }
  unfold along_shaded_big. cbv zeta.
  apply (along_big_is_right 4096 170000000000000 (m - 3997) (27 - m) 3598 R w); try assumption; try lia; try (numbers; lia).
  intro T. specialize (SepM ltac:(lra)). rewrite Rabs_pos_eq in SepM by lra.
  assert (LG : bpow radix2 (-930) <= G).
  { apply Rle_trans with (bpow radix2 (-909) * bpow radix2 (-14)); [rewrite <- bpow_plus; apply bpow_le; lia|].
    unfold G, Rdiv. apply Rmult_le_compat; try apply bpow_ge_0; assumption. }
  replace (27 - m)%Z with (17 - m + 10)%Z by ring. split; apply component_is_large; try assumption.
  - destruct (coordinate_not_tiny _ _ Cx) as [L|L]; [now left|right]. apply Rle_trans with (2 := L). apply bpow_le. lia.
  - apply along; [pose proof (Rabs_pos X); lra|exact T].
  - rewrite Rabs_pos_eq by lra. destruct Lr as [Lr|Lr]; [now left|right]. apply Rle_trans with (/ 1000000); [simpl; lra|lra].
  - rewrite Rabs_pos_eq by lra. now apply along.
Qed.

Theorem bump_3p_shaded_third_stage_answers_right : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_3p (value32 R) (value32 w) X Z in
  is_answer (bump_3p_shaded_third R w K (quantised x) (quantised z)) (0 < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros R w K x y z Hp Hv X Z M. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx]. fold X in Vx. pose proof Hp as ((FR & Fw & _) & HR & Hw & HK).
  pose proof (coordinate_range _ _ Cx) as BX. pose proof (coordinate_range _ _ Cz) as BZ.
  pose proof (fun m H => bump_3p_shaded_is_separated R w K x y z m Hp Hv H) as Sep. cbv zeta in Sep. fold X Z M in Sep.
  pose proof (bump_3p_contact_is_separated R w K x y z Hp Hv) as Sepc. cbv zeta in Sepc. fold X Z M in Sepc.
  unfold bump_3p_shaded_third. cbv zeta. rewrite is_beside_is by (rewrite ?Vx; assumption). rewrite Vx.
  rewrite (is_at_foot_is w _ Fw Fx) by (rewrite Vx; exact BX). rewrite Vx. unfold shaded_x, shaded_z in *.
  destruct (Rle_lt_dec (Rabs X) (value32 w / 2)) as [Hin|Hin].
  2: { rewrite Rle_bool_false in Sep |- * by exact Hin. cbn [negb].
    assert (EM : M = - Z) by (unfold M, penetration_3p; now rewrite Rle_bool_false by exact Hin). rewrite EM, Rmult_1_r in Sep |- *.
    apply (plane_third 4096 3598 R w); try assumption; lia. }
  rewrite Rle_bool_true in Sep |- * by exact Hin. cbn [negb].
  replace (Rsqr (value32 R) - Rsqr X) with ((value32 R - X) * (value32 R + X)) in Sep |- * by (unfold Rsqr; ring).
  assert (Sg : exists m, (2 <= m <= 926)%Z /\ Rabs M <= bpow radix2 (17 - m) /\ seen 4096 2800000000000 (m - 4003)
    (if Req_bool (Rabs X) (value32 w / 2) then exactly 4096 (opp (to64 (quantised z))) else gap_3p_third R w (quantised x)
      (quantised z)) M).
  { case Req_bool_spec; intro E; [|now apply (gap_3p_third_is R w K _ X)].
    assert (EM : M = - Z).
    { pose proof (top_is_narrower R w K Hp) as Hnarrow. unfold M, penetration_3p.
      rewrite (Rle_bool_true (Rabs X) (value32 w / 2)) by exact Hin.
      rewrite Rle_bool_false by lra. rewrite E. field. lra. }
    destruct (cancelled_bits M ltac:(rewrite EM, Rabs_Ropp; lra) Sepc) as (m & Bm & BM & _).
    exists m. split; [exact Bm|]. split; [exact BM|]. rewrite EM. apply tight_is_seen.
    pose proof (tight_exactly 4096 (-4096) _ _ ltac:(lia) ltac:(numbers; lia) (opp_is _ _ (coordinate_is _ _ Cz))) as T.
    apply tight_more with (1 := T); [numbers; lia|lia]. }
  destruct Sg as (m & Bm & BM & Sg). apply (along_shaded_gap_is_right m R w); try assumption. lra.
Qed.

(* Every answer is right, for every input of the domain. *)
Theorem bump_3p_shaded_answers_right : forall is_fused R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_3p (value32 R) (value32 w) X Z in
  is_answer (evaluate bump_3p_shaded_window (bump_3p_shaded_of R w K (sine_of_third R w) (top_of R w) is_fused)
      (later_of (bump_3p_shaded_second R w K) (bump_3p_shaded_third R w K)) x y z) (0 < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros is_fused R w K x y z Hp Hv X Z M. apply three_stages_are_right with (bump_3p_shaded_third R w K (quantised x) (quantised z)).
  - now apply bump_3p_shaded_two_stages_answer_right.
  - now apply (bump_3p_shaded_third_stage_answers_right R w K x y z).
Qed.
