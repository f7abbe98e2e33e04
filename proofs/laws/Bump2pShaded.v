(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second and the third stage of bump-2p-shaded: exact() of fast/laws/bump_2p_shaded.h in double-double and with numbers of 2048
   bits. An answer that the second gives is right, however far the gap has cancelled; the third's is right, and so is every answer of
   the law. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants DoubleDoubleTerms Enclosures.
From Forceshade Require Import BesideTie SecondStage SecondAlong TwoPolygonsGap ShadedAlong ShadingRoot.
Open Scope R_scope.

(* ---- The second stage ---- *)

Definition bump_2p_shaded_second (R w K x z : binary32) : option evaluation :=
  let foot := exactly64 (opp (to64 z)) in
  if is_beside w x then decide_along K foot (exactly64 zero64) (exactly64 (two_to 0))
  else along_shaded R K x (if is_at_foot w x then foot else side_gap_2p R w x z).

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

(* ---- The third stage ---- *)

From Forceshade Require Import Separation SeparationOfBump2pShaded SeparationOfContact BigFloat BigFloatValues BigFloatRight.
From Forceshade Require Import BigFloatTight ThirdAlong TwoPolygonsThird.

Definition bump_2p_shaded_third (R w K x z : binary32) : evaluation :=
  let foot := number (opp (to64 z)) in
  if is_beside w x then along_big 2048 K foot (number zero64) (number (two_to 0))
  else along_shaded_big 2048 K R x (if is_at_foot w x then foot else side_gap_third R w x z).

Theorem bump_2p_shaded_third_stage_answers_right : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_2p (value32 R) (value32 w) X Z in
  is_answer (bump_2p_shaded_third R w K (quantised x) (quantised z)) (0 < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros R w K x y z Hp Hv X Z M. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx]. fold X in Vx. pose proof Hp as ((FR & Fw & _) & HR & Hw & HK).
  pose proof (coordinate_range _ _ Cx) as BX. pose proof (coordinate_range _ _ Cz) as BZ.
  pose proof (fun m H => bump_2p_shaded_is_separated R w K x y z m Hp Hv H) as Sep. cbv zeta in Sep. fold X Z M in Sep.
  pose proof (bump_2p_contact_is_separated R w K x y z Hp Hv) as Sepc. cbv zeta in Sepc. fold X Z M in Sepc.
  unfold bump_2p_shaded_third. cbv zeta. rewrite is_beside_is by (rewrite ?Vx; assumption). rewrite Vx.
  rewrite (is_at_foot_is w _ Fw Fx) by (rewrite Vx; exact BX). rewrite Vx. unfold shaded_x, shaded_z in *.
  destruct (Rle_lt_dec (Rabs X) (value32 w / 2)) as [Hin|Hin].
  2: { rewrite Rle_bool_false in Sep |- * by exact Hin. cbn [negb].
    assert (EM : M = - Z) by (unfold M, penetration_2p; now rewrite Rle_bool_false by exact Hin). rewrite EM, Rmult_1_r in Sep |- *.
    apply (plane_third 2048 1031 R w); try assumption; lia. }
  rewrite Rle_bool_true in Sep |- * by exact Hin. cbn [negb].
  assert (HXR : Rabs X <= value32 R) by lra. destruct (shading_root_enclosed R w K _ X Hp Cx HXR) as [_ Lr]. cbv zeta in Lr.
  pose proof (shading_root_tight 2048 R w K _ X ltac:(lia) ltac:(numbers; lia) Hp Cx HXR) as Tr. cbv zeta in Tr.
  set (P := (value32 R - X) * (value32 R + X)) in *. assert (EP : Rsqr (value32 R) - Rsqr X = P) by (unfold P, Rsqr; ring).
  rewrite EP in Sep |- *. set (gap := if Req_bool (Rabs X) (value32 w / 2) then _ else _).
  assert (Sg : seen 2048 400000000 (-1723) gap M /\ M <= 20000).
  { unfold gap. case Req_bool_spec; intro E; [|now apply (side_gap_third_is R w K _ X)].
    assert (EM : M = - Z) by (unfold M, penetration_2p; rewrite Rle_bool_true by exact Hin; rewrite E; field; lra).
    rewrite EM. apply Rabs_le_inv in BZ. split; [|lra]. apply tight_is_seen.
    apply tight_more with (1 := exact_third _ _ (opp_is _ _ (coordinate_is _ _ Cz))); [numbers; lia|lia]. }
  clearbody gap. destruct Sg as [Sg UM].
  assert (EX : value32 K * (M / value32 R) * X = value32 K * M * (X / value32 R)) by (field; lra).
  assert (EZ : value32 K * (M / value32 R) * sqrt P = value32 K * M * (sqrt P / value32 R)) by (field; lra).
  rewrite <- EX, <- EZ in Sep |- *. clear EX EZ EP.
  assert (TR : tight 2048 400000000 (-2048) (number (to64 R)) (value32 R))
    by (apply tight_more with (1 := exact_third _ _ (to64_is_exact R FR)); [numbers; lia|lia]).
  pose proof (seen_divide 2048 400000000 (-1723) (-2048) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) Sg TR
    ltac:(lra)) as Sd.
  assert (Sd' : seen 2048 30000000000 (-1717) (divide_newton 2048 gap (number (to64 R))) (M / value32 R))
    by (apply seen_more with (1 := Sd); [numbers; lia|lia]).
  assert (Tx : tight 2048 30000000000 (-1717) (number (to64 (quantised x))) X)
    by (apply tight_more with (1 := exact_third _ _ (coordinate_is _ _ Cx)); [numbers; lia|lia]).
  assert (Tr' : tight 2048 30000000000 (-1717) (square_root_newton 2048 (multiply 2048 (subtract 2048 (number (to64 R)) (number (to64
    (quantised x))))
    (add 2048 (number (to64 R)) (number (to64 (quantised x)))))) (sqrt P)) by (apply tight_more with (1 := Tr); [numbers; lia|lia]).
  set (G := M / value32 R) in *. assert (HRinv : bpow radix2 (-14) <= / value32 R).
  { apply Rle_trans with (/ 10000); [simpl; lra|apply Rinv_le; lra]. }
  pose proof (bpow_gt_0 radix2 (-14)) as P14. assert (Hc : 0 < G <-> 0 < M).
  { unfold G. split; intro T; [|unfold Rdiv; apply Rmult_lt_0_compat; lra].
    replace M with (M / value32 R * value32 R) by (field; lra). apply Rmult_lt_0_compat; lra. }
  assert (along : forall n, 0 <= n <= value32 R -> 0 < M -> G * n <= 20000).
  { intros n Hn T. unfold G. replace (M / value32 R * n) with (M * (n / value32 R)) by (field; lra).
    assert (0 <= n / value32 R <= 1).
    { split; [apply Rmult_le_pos; lra|]. apply Rmult_le_reg_r with (value32 R); [lra|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. lra. }
    apply Rle_trans with (20000 * 1); [apply Rmult_le_compat; lra|lra]. }
  assert (BP : 0 <= sqrt P <= value32 R).
  { split; [apply sqrt_pos|]. rewrite <- (sqrt_square (value32 R)) by lra. apply sqrt_le_1_alt. unfold P.
    pose proof (Rle_0_sqr X) as S. unfold Rsqr in S. lra. }
  unfold along_shaded_big. cbv zeta. apply (along_big_is_right 2048 30000000000 (-1717) 25 1031 R w); try assumption; try lia;
    try (numbers; lia).
  intro T. specialize (Sepc ltac:(lra)). rewrite Rabs_pos_eq in Sepc by lra.
  assert (LG : bpow radix2 (-300) <= G).
  { apply Rle_trans with (bpow radix2 (-218) * bpow radix2 (-14)); [rewrite <- bpow_plus; apply bpow_le; lia|].
    unfold G, Rdiv. apply Rmult_le_compat; try apply bpow_ge_0; assumption. }
  split; apply large_component; try assumption.
  - destruct (coordinate_not_tiny _ _ Cx) as [L|L]; [now left|right]. apply Rle_trans with (2 := L). apply bpow_le. lia.
  - apply along; [pose proof (Rabs_pos X); lra|exact T].
  - rewrite Rabs_pos_eq by lra. destruct Lr as [Lr|Lr]; [now left|right]. apply Rle_trans with (/ 1000000); [simpl; lra|lra].
  - rewrite Rabs_pos_eq by lra. now apply along.
Qed.

(* Every answer is right, for every input of the domain. *)
Theorem bump_2p_shaded_answers_right : forall is_fused R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_2p (value32 R) (value32 w) X Z in
  is_answer (evaluate bump_2p_shaded_window (bump_2p_shaded_of R w K is_fused)
      (later_of (bump_2p_shaded_second R w K) (bump_2p_shaded_third R w K)) x y z) (0 < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros is_fused R w K x y z Hp Hv X Z M. apply three_stages_are_right with (bump_2p_shaded_third R w K (quantised x) (quantised z)).
  - now apply bump_2p_shaded_two_stages_answer_right.
  - now apply (bump_2p_shaded_third_stage_answers_right R w K x y z).
Qed.
