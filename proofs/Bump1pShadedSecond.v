(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second stage of bump-1p-shaded in double-double: exact() of fast/laws/bump_1p_shaded.h with along() and along_shaded() of
   fast/laws/outcome.h. An answer that it gives is right. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts
  EnclosedQuotients.
From Forceshade Require Import BesideTie SecondStage SecondAlong Separation.
Open Scope R_scope.

Definition bump_1p_shaded_second (R w K x z : binary32) : option evaluation :=
  let gap := exactly64 (opp (to64 z)) in
  if is_beside w x then decide_along K gap (exactly64 zero64) (exactly64 (two_to 0))
  else
    let radius := exactly64 (to64 R) in
    let X := exactly64 (to64 x) in
    decide_along K (divide gap radius) X (root_of (multiply (add radius (negated X)) (add radius X))).

(* x is on the circle, or a little off it. *)
Lemma inside_of_circle : forall R w K xv X, parameters R w K -> coordinate xv X -> Rabs X <= value32 R ->
  value32 R - X = 0 \/ / 1000000000 <= value32 R - X.
Proof.
  intros R w K xv X Hp Hx HX. pose proof (multiple_of_radius _ _ _ Hp) as MR. destruct Hp as (_ & HR & _). apply Rabs_le_inv in HX.
  destruct (Rle_lt_dec X (value32 R / 2)) as [H|H]; [right; lra|]. destruct (Req_dec (value32 R - X) 0) as [|Hne]; [now left|right].
  assert (MX : multiple 28 X).
  { apply (multiple_of_binary32 (-5)); [lia|exact (coordinate_format _ _ Hx)|]. rewrite Rabs_pos_eq by lra. simpl. lra. }
  assert (M : multiple 28 (value32 R - X)) by multiple. pose proof (multiple_not_0 _ _ M Hne) as D. rewrite Rabs_pos_eq in D by lra.
  simpl in D. lra.
Qed.

Lemma coordinate_opp : forall xv X, coordinate xv X -> coordinate (opp xv) (- X).
Proof.
  intros xv X [H F B S]. split; [now apply opp_is|now apply generic_format_opp|now rewrite Rabs_Ropp|].
  destruct S as [->|S]; [left; ring|right]. unfold size in *. now rewrite Rabs_Ropp.
Qed.

(* The root of (R - x)(R + x), which may be 0. *)
Lemma shading_root_enclosed : forall R w K xv X, parameters R w K -> coordinate xv X -> Rabs X <= value32 R ->
  let radius := exactly64 (to64 R) in let P := (value32 R - X) * (value32 R + X) in
  encloses (66 * share101) (root_of (multiply (add radius (negated (exactly64 xv))) (add radius (exactly64 xv)))) (sqrt P) /\
  (sqrt P = 0 \/ / 1000000 <= sqrt P <= 10000).
Proof.
  intros R w K xv X Hp Hx HX radius P. pose proof share_is_small as Hsh.
  pose proof (inside_of_circle R w K _ X Hp Hx HX) as Low. pose proof (inside_of_circle R w K _ (- X) Hp (coordinate_opp _ _ Hx) ltac:(now
    rewrite Rabs_Ropp)) as High.
  replace (value32 R - - X) with (value32 R + X) in High by ring.
  destruct Hp as ((FR & _) & HR & _). destruct Hx as [Ix _ Bx _]. pose proof (Rabs_le_inv _ _ HX) as HX2.
  assert (IR : is_exactly radius (value32 R)) by (apply exactly_is; now apply to64_is_exact).
  assert (IX : is_exactly (exactly64 xv) X) by now apply exactly_is.
  pose proof (encloses_sum _ _ _ _ IR (negated_is _ _ IX) ltac:(rewrite Rabs_pos_eq; lra) ltac:(rewrite Rabs_Ropp; lra) ltac:(lra)) as E1.
  pose proof (encloses_sum _ _ _ _ IR IX ltac:(rewrite Rabs_pos_eq; lra) ltac:(lra) ltac:(lra)) as E2.
  change (value32 R + - X) with (value32 R - X) in E1.
  assert (BP : P = 0 \/ / 100000000000 <= P <= 100000000).
  { destruct Low as [Low|Low]; [left; unfold P; rewrite Low; ring|]. destruct High as [High|High]; [left; unfold P; rewrite High;
    ring|right].
    split.
    - unfold P. destruct (Rle_lt_dec 0 X).
      + apply Rle_trans with (/ 1000000000 * / 10); [lra|apply Rmult_le_compat; lra].
      + apply Rle_trans with (/ 10 * / 1000000000); [lra|apply Rmult_le_compat; lra].
    - replace P with (value32 R * value32 R - X * X) by (unfold P; ring). pose proof (Rle_0_sqr X) as S. unfold Rsqr in S.
      assert (value32 R * value32 R <= 10000 * 10000) by (apply Rmult_le_compat; lra). lra. }
  pose proof (encloses_multiply _ _ _ _ _ _ E1 E2 ltac:(lra) ltac:(lra)) as E3. fold P in E3.
  assert (E3' : encloses (3 * (3 * share101 + 3 * share101) + 3 * share101) (multiply (add radius (negated (exactly64 xv))) (add radius
    (exactly64 xv))) P).
  { apply E3. destruct BP as [BP|BP]; [|right; right; rewrite Rabs_pos_eq; lra]. unfold P in BP. apply Rmult_integral in BP. tauto. }
  split.
  - apply encloses_more with (3 * (3 * (3 * share101 + 3 * share101) + 3 * share101) + 3 * share101); [|lra].
    apply encloses_root; [exact E3'|lra|]. destruct BP as [BP|BP]; [now left|right; lra].
  - destruct BP as [->|BP]; [left; apply sqrt_0|right]. split.
    + replace (/ 1000000) with (sqrt (/ 1000000 * / 1000000)) by (apply sqrt_square; lra). apply sqrt_le_1_alt. lra.
    + replace 10000 with (sqrt (10000 * 10000)) by (apply sqrt_square; lra). apply sqrt_le_1_alt. lra.
Qed.

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
