(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second and the third stage of bump-1p-shaded: exact() of fast/laws/bump_1p_shaded.h in double-double and with numbers of 768
   bits. An answer that the second gives is right; the third's is right, and so is every answer of the law. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts.
From Forceshade Require Import EnclosedQuotients BesideTie SecondStage SecondAlong Separation ShadingRoot.
Open Scope R_scope.

(* ---- The second stage ---- *)

Definition bump_1p_shaded_second (R w K x z : binary32) : option evaluation :=
  let gap := exactly64 (opp (to64 z)) in
  if is_beside w x then decide_along K gap (exactly64 zero64) (exactly64 (two_to 0))
  else
    let radius := exactly64 (to64 R) in
    let X := exactly64 (to64 x) in
    decide_along K (divide gap radius) X (root_of (multiply (add radius (negated X)) (add radius X))).

Theorem bump_1p_shaded_second_stage_answers_right : forall R w K x y z answer, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  bump_1p_shaded_second R w K (quantised x) (quantised z) = Some answer ->
  is_answer answer (Z < 0) (shaded_x (value32 R) (value32 w) (value32 K) X (- Z)) (shaded_z (value32 R) (value32 w) (value32 K) X (- Z)).
Proof.
  intros R w K x y z answer Hp Hv X Z H. pose proof share_is_small as Hsh. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx.
    fold Z in Cz.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx]. fold X in Vx. pose proof Hp as ((FR & Fw & _) & HR & Hw & HK).
    pose proof (coordinate_range _ _ Cx) as BX. pose proof
    (coordinate_range _ _ Cz) as BZ.
  assert (LZ : Z = 0 \/ / 2000000000 <= Rabs Z).
  { destruct (coordinate_not_tiny _ _ Cz) as [L|L]; [now left|right]. simpl in L. lra. }
  assert (LX : X = 0 \/ / 10000000000 <= Rabs X).
  { destruct (coordinate_not_tiny _ _ Cx) as [L|L]; [now left|right]. simpl in L. lra. }
  pose proof (exactly_is _ _ (opp_is _ _ (coordinate_is _ _ Cz))) as Igap. pose proof (coordinate_is _ _ Cx) as Ix.
  unfold bump_1p_shaded_second in H. cbv zeta in H. rewrite is_beside_is in H by (rewrite ?Vx; assumption). rewrite Vx in H.
  unfold shaded_x, shaded_z. revert H. case Rle_bool_spec; intros Hin H; cbn [negb] in H.
  2: { enough (A : is_answer answer (Z < 0) 0 (value32 K * - Z)) by (rewrite Rmult_1_r; exact A).
    exact (on_plane_is_right R w K _ Z answer Hp Cz H). }
  assert (HXR : Rabs X <= value32 R) by lra. apply Rabs_le_inv in BZ.
  destruct (shading_root_enclosed R w K _ X Hp Cx HXR) as [Er Lr]. set (P := (value32 R - X) * (value32 R + X)) in *.
  assert (EP : Rsqr (value32 R) - Rsqr X = P) by (unfold P, Rsqr; ring). rewrite EP.
  assert (EX : value32 K * (- Z / value32 R) * X = value32 K * - Z * (X / value32 R)) by (field; lra).
  assert (EZ : value32 K * (- Z / value32 R) * sqrt P = value32 K * - Z * (sqrt P / value32 R)) by (field; lra).
  rewrite <- EX, <- EZ. clear EX EZ.
  assert (IR : encloses 0 (exactly64 (to64 R)) (value32 R)) by (apply encloses_exact, exactly_is; now apply to64_is_exact).
  assert (HRinv : / 10000 <= / value32 R <= 10) by (split; [apply Rinv_le; lra|replace 10 with (/ (/ 10)) by field; apply Rinv_le; lra]).
  set (M := - Z / value32 R). assert (BM : Rabs M <= 100000).
  { unfold M, Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ value32 R)), Rabs_Ropp by lra. replace 100000 with (10000 * 10) by ring.
    apply Rmult_le_compat; try lra; [apply Rabs_pos|apply Rabs_le; lra]. }
  assert (Egap : encloses (3 * (0 + 0) + 3 * share101) (divide (exactly64 (opp (to64 (quantised z)))) (exactly64 (to64 R))) M).
  { apply encloses_divide; try lra; [now apply encloses_exact|exact IR| | |].
    - destruct LZ as [LZ|LZ]; [left; rewrite LZ; ring|right]. rewrite Rabs_Ropp. split; [lra|apply Rabs_le; lra].
    - rewrite Rabs_pos_eq; lra.
    - fold M. lra. }
  assert (Htouch : 0 < M <-> Z < 0).
  { unfold M. split; intro T; [|unfold Rdiv; apply Rmult_lt_0_compat; lra].
    apply Rmult_lt_reg_r with (/ value32 R); [lra|]. unfold Rdiv in T. lra. }
  assert (BP : 0 <= sqrt P <= value32 R).
  { split; [apply sqrt_pos|]. rewrite <- (sqrt_square (value32 R)) by lra. apply sqrt_le_1_alt. unfold P.
    pose proof (Rle_0_sqr X) as S. unfold Rsqr in S. lra. }
  assert (along : forall n, 0 <= n <= value32 R -> Z < 0 -> M * n <= 10000).
  { intros n Hn T. unfold M. replace (- Z / value32 R * n) with (- Z * (n / value32 R)) by (field; lra).
    assert (0 <= n / value32 R <= 1).
    { split; [apply Rmult_le_pos; lra|]. apply Rmult_le_reg_r with (value32 R); [lra|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. lra. }
    apply Rle_trans with (10000 * 1); [apply Rmult_le_compat; lra|lra]. }
  refine (along_is_right R w K _ M _ X 0 _ (sqrt P) (66 * share101) (Z < 0) answer Hp _ Htouch (encloses_exact _ _ (exactly_is _ _ Ix))
    _ Er _ _ H);
    try lra.
  - apply (enclosed_is_contained (3 * (0 + 0) + 3 * share101)); [exact Egap|lra|lra].
  - intros _ T. assert (HM : / 100000000000000 <= M).
    { unfold M, Rdiv. apply Rle_trans with (/ 2000000000 * / 10000); [lra|apply Rmult_le_compat; try lra].
      destruct LZ as [LZ|LZ]; [lra|rewrite Rabs_left in LZ; lra]. }
    rewrite (Rabs_pos_eq M) in BM by lra. split.
    + eapply (enclosed_is_directed _ _ M 0 _ X Egap); [lra|now apply encloses_exact, exactly_is|lra|lra| |].
      * destruct LX as [LX|LX]; [now left|right; lra].
      * apply Rle_trans with 10000; [apply along; [pose proof (Rabs_pos X); lra|exact T]|lra].
    + eapply (enclosed_is_directed _ _ M _ _ (sqrt P) Egap); [lra|exact Er|lra|lra| |].
      * rewrite (Rabs_pos_eq (sqrt P)) by lra. destruct Lr as [Lr|Lr]; [now left|right; lra].
      * rewrite (Rabs_pos_eq (sqrt P)) by lra. apply Rle_trans with 10000; [now apply along|lra].
Qed.

(* Every answer of the first two stages is right, for every input of the domain. *)
Theorem bump_1p_shaded_two_stages_answer_right : forall is_fused R w K third x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  right_or_later (evaluate bump_1p_shaded_window (bump_1p_shaded_of R w K is_fused) (later_of (bump_1p_shaded_second R w K) third) x y z)
    (third (quantised x) (quantised z)) (Z < 0)
    (shaded_x (value32 R) (value32 w) (value32 K) X (- Z)) (shaded_z (value32 R) (value32 w) (value32 K) X (- Z)).
Proof.
  intros is_fused R w K third x y z Hp Hv X Z. apply two_stages_are_right with (second := bump_1p_shaded_second R w K).
  - now apply bump_1p_shaded_first_stage_answers_right.
  - intros found H. now apply (bump_1p_shaded_second_stage_answers_right R w K x y z found).
Qed.

(* ---- The third stage ---- *)

From Forceshade Require Import BigFloat BigFloatValues BigFloatTight BigFloatRight ThirdAlong.

Definition bump_1p_shaded_third (R w K x z : binary32) : evaluation :=
  let gap := exactly 768 (opp (to64 z)) in
  if is_beside w x then along_big 768 K gap (exactly 768 zero64) (exactly 768 (two_to 0)) else along_shaded_big 768 K R x gap.

(* The sizes of a component that is not 0. *)
Lemma component_size : forall K g n, / 1000 <= K <= 1000 -> 0 < g -> (n = 0 \/ / 10000000000 <= Rabs n) -> / 100000000000000 <= g ->
  g * Rabs n <= 10000 -> K * g * n = 0 \/ bpow radix2 (-990) <= Rabs (K * g * n) <= bpow radix2 25.
Proof.
  intros K g n HK Hg Hn Lg U. destruct Hn as [->|Hn]; [left; ring|right]. rewrite Rmult_assoc, Rabs_mult, (Rabs_pos_eq K) by lra.
  rewrite Rabs_mult, (Rabs_pos_eq g) by lra. split.
  - apply Rle_trans with (bpow radix2 (-90)); [apply bpow_le; lia|].
    apply Rle_trans with (/ 1000 * (/ 100000000000000 * / 10000000000)); [simpl; lra|]. apply Rmult_le_compat; try lra.
    apply Rmult_le_compat; lra.
  - apply Rle_trans with (1000 * 10000); [|simpl; lra]. apply Rmult_le_compat; try lra. apply Rmult_le_pos; lra.
Qed.

Theorem bump_1p_shaded_third_stage_answers_right : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  is_answer (bump_1p_shaded_third R w K (quantised x) (quantised z)) (Z < 0)
    (shaded_x (value32 R) (value32 w) (value32 K) X (- Z)) (shaded_z (value32 R) (value32 w) (value32 K) X (- Z)).
Proof.
  intros R w K x y z Hp Hv X Z. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx]. fold X in Vx. pose proof Hp as ((FR & Fw & _) & HR & Hw & HK).
  pose proof (coordinate_range _ _ Cx) as BX. pose proof (coordinate_range _ _ Cz) as BZ.
  assert (LX : X = 0 \/ / 10000000000 <= Rabs X).
  { destruct (coordinate_not_tiny _ _ Cx) as [L|L]; [now left|right]. simpl in L. lra. }
  assert (LZ : Z < 0 -> / 2000000000 <= - Z).
  { intro T. destruct (coordinate_not_tiny _ _ Cz) as [L|L]; [lra|]. rewrite Rabs_left in L by exact T. simpl in L. lra. }
  pose proof (fun m H => bump_1p_shaded_is_separated R w K x y z m Hp Hv H) as Sep. cbv zeta in Sep. fold X Z in Sep.
  set (t := (-768)%Z). assert (Ht : (- BigFloat.range <= t <= -3)%Z) by (unfold t; numbers; lia).
  pose proof (tight_exactly 768 t _ _ ltac:(lia) Ht (opp_is _ _ (coordinate_is _ _ Cz))) as Tg.
  pose proof (tight_exactly 768 t _ _ ltac:(lia) Ht (coordinate_is _ _ Cx)) as Tx.
  unfold bump_1p_shaded_third. cbv zeta. rewrite is_beside_is by (rewrite ?Vx; assumption). rewrite Vx.
  unfold shaded_x, shaded_z in *. revert Sep. case Rle_bool_spec; intros Hin Sep; cbn [negb]; apply Rabs_le_inv in BZ.
  2: { pose proof (tight_exactly 768 t _ _ ltac:(lia) Ht zero_is) as T0.
    pose proof (tight_exactly 768 t _ _ ltac:(lia) Ht (two_to_is 0 ltac:(lia))) as T1. change (bpow radix2 0) with 1 in T1.
    assert (E0 : value32 K * - Z * 0 = 0) by ring.
    enough (A : is_answer (along_big 768 K (exactly 768 (opp (to64 (quantised z)))) (exactly 768 zero64) (exactly 768 (two_to 0))) (Z < 0)
      (value32 K * - Z * 0) (value32 K * - Z * 1)) by (rewrite E0 in A; exact A).
    refine (along_big_is_right 768 1074 t 25 406 R w K _ (- Z) _ 0 _ 1 (Z < 0) _ _ _ Hp (tight_is_seen _ _ _ _ _ Tg) T0 T1 _ _ _
      _ _ _ _ _ _);
      try (unfold t; numbers; lia); try lra.
    - intro T. specialize (LZ T). split; apply component_size; rewrite ?Rabs_R0, ?Rabs_R1; lra.
    - intros m Hm. destruct (Sep m Hm) as [S1 S2]. rewrite E0. now split. }
  assert (HXR : Rabs X <= value32 R) by lra. destruct (shading_root_enclosed R w K _ X Hp Cx HXR) as [_ Lr]. cbv zeta in Lr.
  pose proof (shading_root_tight 768 R w K _ X ltac:(lia) ltac:(numbers; lia) Hp Cx HXR) as Tr. cbv zeta in Tr.
  set (P := (value32 R - X) * (value32 R + X)) in *. assert (EP : Rsqr (value32 R) - Rsqr X = P) by (unfold P, Rsqr; ring).
  rewrite EP in Sep |- *.
  assert (EX : value32 K * (- Z / value32 R) * X = value32 K * - Z * (X / value32 R)) by (field; lra).
  assert (EZ : value32 K * (- Z / value32 R) * sqrt P = value32 K * - Z * (sqrt P / value32 R)) by (field; lra).
  rewrite <- EX, <- EZ in Sep |- *. clear EX EZ EP.
  pose proof (tight_exactly 768 t _ _ ltac:(lia) Ht (to64_is_exact R FR)) as TR.
  pose proof (tight_divide 768 1074 t t _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(unfold t; lia) ltac:(unfold t; lia) Tg TR
    ltac:(lra)) as Td.
  set (M := - Z / value32 R) in *. set (k := (60 * (3268 + 4 * 768))%Z) in *. set (u := (56 - 768)%Z) in *.
  assert (Hk : (177120 <= k <= BigFloat.range)%Z) by (unfold k; numbers; lia).
  assert (Hu : u = (-712)%Z) by reflexivity. unfold along_shaded_big. cbv zeta.
  assert (Tg' : tight 768 k u (divide_newton 768 (exactly 768 (opp (to64 (quantised z)))) (exactly 768 (to64 R))) M).
  { apply tight_more with (1 := Td); unfold t; lia. }
  assert (Tx' : tight 768 k u (exactly 768 (to64 (quantised x))) X) by (apply tight_more with (1 := Tx); unfold t; lia).
  assert (HRinv : / 10000 <= / value32 R) by (apply Rinv_le; lra).
  assert (Hc : 0 < M <-> Z < 0).
  { unfold M. split; intro T; [|unfold Rdiv; apply Rmult_lt_0_compat; lra].
    apply Rmult_lt_reg_r with (/ value32 R); [lra|]. unfold Rdiv in T. lra. }
  assert (along : forall n, 0 <= n <= value32 R -> Z < 0 -> M * n <= 10000).
  { intros n Hn T. unfold M. replace (- Z / value32 R * n) with (- Z * (n / value32 R)) by (field; lra).
    assert (0 <= n / value32 R <= 1).
    { split; [apply Rmult_le_pos; lra|]. apply Rmult_le_reg_r with (value32 R); [lra|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l by lra. lra. }
    apply Rle_trans with (10000 * 1); [apply Rmult_le_compat; lra|lra]. }
  assert (BP : 0 <= sqrt P <= value32 R).
  { split; [apply sqrt_pos|]. rewrite <- (sqrt_square (value32 R)) by lra. apply sqrt_le_1_alt. unfold P.
    pose proof (Rle_0_sqr X) as S. unfold Rsqr in S. lra. }
  apply (along_big_is_right 768 k u 25 406 R w K _ M _ X _ (sqrt P) (Z < 0)); try assumption; try lia; try now apply tight_is_seen.
  - numbers. unfold k. lia.
  - intro T. specialize (LZ T). assert (LM : / 100000000000000 <= M).
    { unfold M, Rdiv. apply Rle_trans with (/ 2000000000 * / 10000); [lra|apply Rmult_le_compat; lra]. }
    split; apply component_size; try lra.
    + apply along; [pose proof (Rabs_pos X); lra|exact T].
    + rewrite Rabs_pos_eq by lra. destruct Lr as [Lr|Lr]; [now left|right; lra].
    + rewrite Rabs_pos_eq by lra. now apply along.
Qed.

(* Every answer is right, for every input of the domain. *)
Theorem bump_1p_shaded_answers_right : forall is_fused R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  is_answer (evaluate bump_1p_shaded_window (bump_1p_shaded_of R w K is_fused)
      (later_of (bump_1p_shaded_second R w K) (bump_1p_shaded_third R w K)) x y z) (Z < 0)
    (shaded_x (value32 R) (value32 w) (value32 K) X (- Z)) (shaded_z (value32 R) (value32 w) (value32 K) X (- Z)).
Proof.
  intros is_fused R w K x y z Hp Hv X Z. apply three_stages_are_right with (bump_1p_shaded_third R w K (quantised x) (quantised z)).
  - now apply bump_1p_shaded_two_stages_answer_right.
  - now apply (bump_1p_shaded_third_stage_answers_right R w K x y z).
Qed.
