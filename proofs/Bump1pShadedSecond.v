(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second stage of bump-1p-shaded in double-double: exact() of fast/laws/bump_1p_shaded.h with along() and along_shaded() of
   fast/laws/outcome.h. An answer that it gives is right. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts
  EnclosedQuotients.
From Forceshade Require Import BesideTie SecondStage Separation.
Open Scope R_scope.

(* a < b of C++. *)
Definition is_less32 (a b : binary32) : bool := match Bcompare 24 128 a b with Some Lt => true | _ => false end.
Definition two32 : binary32 := B754_finite 24 128 false 8388608 (-22) eq_refl.

(* 2|x| > w *)
Definition is_beside (w x : binary32) : bool := is_less32 w (b32_mult mode_NE two32 (b32_abs x)).

(* along(gap, K, normal_x, normal_z), where the second stage can decide. *)
Definition decide_along (K : binary32) (gap normal_x normal_z : double_double) : option evaluation :=
  let magnitude := multiply (exactly64 (to64 K)) gap in decide (sign_of gap) (multiply magnitude normal_x) (multiply magnitude normal_z).

Definition bump_1p_shaded_second (R w K x z : binary32) : option evaluation :=
  let gap := exactly64 (opp (to64 z)) in
  if is_beside w x then decide_along K gap (exactly64 zero64) (exactly64 (two_to 0))
  else
    let radius := exactly64 (to64 R) in
    let X := exactly64 (to64 x) in
    decide_along K (divide gap radius) X (root_of (multiply (add radius (negated X)) (add radius X))).

Lemma is_beside_is : forall w x, is_finite 24 128 w = true -> is_finite 24 128 x = true -> Rabs (value32 x) <= 10000 ->
  is_beside w x = negb (Rle_bool (Rabs (value32 x)) (value32 w / 2)).
Proof.
  intros w x Fw Fx Bx. unfold is_beside. set (a := b32_abs x).
  assert (Ea : value32 a = Rabs (value32 x)) by apply B2R_Babs. assert (Fa : is_finite 24 128 a = true) by (unfold a, b32_abs; now rewrite
    is_finite_Babs).
  assert (E2 : value32 two32 = 2) by (unfold two32, B2R, F2R; simpl; lra).
  assert (P : value32 (b32_mult mode_NE two32 a) = 2 * Rabs (value32 x) /\ is_finite 24 128 (b32_mult mode_NE two32 a) = true).
  { unfold b32_mult. match goal with |- context [Bmult _ _ ?p ?q ?nan _ _ _] => pose proof (Bmult_correct 24 128 p q nan mode_NE two32 a)
    as C end.
    cbv zeta in C. change (round radix2 (SpecFloat.fexp 24 128) (round_mode mode_NE)) with nearest32 in C. rewrite E2, Ea in C.
    rewrite round_generic in C.
    - rewrite Rlt_bool_true in C.
      + destruct C as (C1 & C2 & _). rewrite Fa in C2. now split.
      + rewrite Rabs_pos_eq by (pose proof (Rabs_pos (value32 x)); lra). apply Rle_lt_trans with (bpow radix2 20); [simpl; lra|apply
        bpow_lt; lia].
    - auto with typeclass_instances.
    - replace (2 * Rabs (value32 x)) with (Rabs (value32 x) * bpow radix2 1) by (change (bpow radix2 1) with 2; ring).
      apply Mult_error.mult_bpow_pos_exact_FLT; [apply generic_format_abs, (generic_format_B2R 24 128)|lia]. }
  destruct P as [P1 P2]. unfold is_less32. rewrite Bcompare_correct by assumption. rewrite P1.
  case Rcompare_spec; case Rle_bool_spec; intros; try reflexivity; exfalso; lra.
Qed.

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

Lemma share_is_small : 0 < share101 <= / 1000000000000000000000000000000.
Proof. unfold share101. lra. Qed.

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

(* K M (normal_x, normal_z) from a gap M that is enclosed. *)
Lemma along_is_right : forall R w K gap M s nx NX t nz NZ u touches answer, parameters R w K -> encloses s gap M -> 0 <= s <= 10 * share101
  ->
  (0 < M <-> touches) -> Rabs M <= 100000000 -> (touches -> / 100000000000000 <= M <= 100000) ->
  encloses t nx NX -> 0 <= t <= 70 * share101 -> encloses u nz NZ -> 0 <= u <= 70 * share101 ->
  NX = 0 \/ / 10000000000 <= Rabs NX -> NZ = 0 \/ / 10000000000 <= Rabs NZ ->
  (touches -> Rabs (value32 K * M * NX) <= 20000000 /\ Rabs (value32 K * M * NZ) <= 20000000) ->
  decide_along K gap nx nz = Some answer -> is_answer answer touches (value32 K * M * NX) (value32 K * M * NZ).
Proof.
  intros R w K gap M s nx NX t nz NZ u touches answer Hp Egap Hs Htouch BM HM Ex Ht Ez Hu LX LZ Bforce H. pose proof share_is_small as Hsh.
  destruct Hp as ((_ & _ & FK) & _ & _ & HK). assert (IK : encloses 0 (exactly64 (to64 K)) (value32 K)).
  { apply encloses_exact, exactly_is. now apply to64_is_exact. }
  apply (decided_is_right gap M (multiply (multiply (exactly64 (to64 K)) gap) nx) (multiply (multiply (exactly64 (to64 K)) gap) nz) (400 *
    share101));
    [apply (enclosed_is_contained s); [exact Egap|lra|lra]|exact Htouch|lra| |exact H].
  intro T. specialize (HM T). destruct (Bforce T) as [Fx Fz]. clear Bforce H.
  assert (BKM : / 100000000000000000 <= value32 K * M <= 100000000).
  { split; [apply Rle_trans with (/ 1000 * / 100000000000000); [lra|]|apply Rle_trans with (1000 * 100000); [|lra]]; apply Rmult_le_compat;
    lra. }
  pose proof (encloses_multiply _ _ _ _ _ _ IK Egap ltac:(lra) ltac:(lra) ltac:(right; right; rewrite Rabs_pos_eq; lra)) as Em.
  assert (one : forall n N v, encloses v n N -> 0 <= v <= 70 * share101 -> N = 0 \/ / 10000000000 <= Rabs N -> Rabs (value32 K * M * N) <=
    20000000 ->
    encloses (400 * share101) (multiply (multiply (exactly64 (to64 K)) gap) n) (value32 K * M * N) /\ component (value32 K * M * N)).
  { intros n N v En Hv LN BN.
    assert (Size : N = 0 \/ / 1000000000000000000000000000000 <= Rabs (value32 K * M * N)).
    { destruct LN as [LN|LN]; [now left|right]. rewrite Rabs_mult, (Rabs_pos_eq (value32 K * M)) by lra.
      apply Rle_trans with (/ 100000000000000000 * / 10000000000); [lra|apply Rmult_le_compat; lra]. }
    split.
    - apply encloses_more with (3 * ((3 * (0 + s) + 3 * share101) + v) + 3 * share101); [|lra].
      apply encloses_multiply; [exact Em|exact En|lra|lra|]. destruct Size as [Size|Size]; [right; now left|right; right; lra].
    - destruct Size as [->|Size]; [left; ring|right; lra]. }
  split; [now apply (one nx NX t)|now apply (one nz NZ u)].
Qed.

Theorem bump_1p_shaded_second_stage_answers_right : forall R w K x y z answer, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  bump_1p_shaded_second R w K (quantised x) (quantised z) = Some answer ->
  is_answer answer (Z < 0) (shaded_x (value32 R) (value32 w) (value32 K) X (- Z)) (shaded_z (value32 R) (value32 w) (value32 K) X (- Z)).
Proof.
  intros R w K x y z answer Hp Hv X Z H. pose proof share_is_small as Hsh. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx.
    fold Z in Cz.
  assert (Qx : value32 (quantised x) = X /\ is_finite 24 128 (quantised x) = true).
  { unfold valid in Hv. destruct (andb_prop _ _ Hv) as [Hxy _]. destruct (andb_prop _ _ Hxy) as [Hx _]. apply in_domain_is_right in Hx.
    now apply quantised_is_right. }
  destruct Qx as [Vx Fx]. pose proof Hp as ((FR & Fw & _) & HR & Hw & HK). pose proof (coordinate_range _ _ Cx) as BX. pose proof
    (coordinate_range _ _ Cz) as BZ.
  destruct (bump_1p_shaded_size (value32 R) (value32 w) (value32 K) X Z ltac:(lra) ltac:(lra) ltac:(lra) BZ) as [Sx Sz].
  assert (LZ : Z = 0 \/ / 2000000000 <= Rabs Z).
  { destruct (coordinate_not_tiny _ _ Cz) as [L|L]; [now left|right]. simpl in L. lra. }
  assert (LX : X = 0 \/ / 10000000000 <= Rabs X).
  { destruct (coordinate_not_tiny _ _ Cx) as [L|L]; [now left|right]. simpl in L. lra. }
  pose proof (exactly_is _ _ (opp_is _ _ (coordinate_is _ _ Cz))) as Igap. pose proof (coordinate_is _ _ Cx) as Ix.
  unfold bump_1p_shaded_second in H. cbv zeta in H. rewrite is_beside_is in H by (rewrite ?Vx; assumption). rewrite Vx in H.
  unfold shaded_x, shaded_z in *. apply Rabs_le_inv in BZ.
  set (gap := exactly64 (opp (to64 (quantised z)))) in *. set (xv := to64 (quantised x)) in *. revert H Sx Sz. case Rle_bool_spec; intros
    Hin H Sx Sz.
  - (* over the bump *)
    cbn [negb] in H. assert (HXR : Rabs X <= value32 R) by lra.
    destruct (shading_root_enclosed R w K _ X Hp Cx HXR) as [Er Lr]. fold xv in Er. set (P := (value32 R - X) * (value32 R + X)) in *.
    assert (EP : Rsqr (value32 R) - Rsqr X = P) by (unfold P, Rsqr; ring). rewrite EP in *.
    assert (EX : value32 K * (- Z / value32 R) * X = value32 K * - Z * (X / value32 R)) by (field; lra).
    assert (EZ : value32 K * (- Z / value32 R) * sqrt P = value32 K * - Z * (sqrt P / value32 R)) by (field; lra).
    rewrite <- EX, <- EZ in *.
    assert (IR : encloses 0 (exactly64 (to64 R)) (value32 R)) by (apply encloses_exact, exactly_is; now apply to64_is_exact).
    assert (HRinv : / 10000 <= / value32 R <= 10) by (split; [apply Rinv_le; lra|replace 10 with (/ (/ 10)) by field; apply Rinv_le; lra]).
    assert (BM : Rabs (- Z / value32 R) <= 100000).
    { unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ value32 R)), Rabs_Ropp by lra. replace 100000 with (10000 * 10) by ring.
      apply Rmult_le_compat; try lra; [apply Rabs_pos|apply Rabs_le; lra]. }
    assert (Egap : encloses (3 * (0 + 0) + 3 * share101) (divide gap (exactly64 (to64 R))) (- Z / value32 R)).
    { apply encloses_divide; try lra; [now apply encloses_exact|exact IR| |rewrite Rabs_pos_eq; lra].
      destruct LZ as [LZ|LZ]; [left; rewrite LZ; ring|right]. rewrite Rabs_Ropp. split; [lra|apply Rabs_le; lra]. }
    assert (Htouch : 0 < - Z / value32 R <-> Z < 0).
    { split; intro T; [|unfold Rdiv; apply Rmult_lt_0_compat; lra]. apply Rmult_lt_reg_r with (/ value32 R); [lra|]. unfold Rdiv in T. lra.
      }
    assert (HM : Z < 0 -> / 100000000000000 <= - Z / value32 R <= 100000).
    { intro T. assert (Hz : / 2000000000 <= - Z) by (destruct LZ as [LZ|LZ]; [lra|rewrite Rabs_left in LZ; lra]). unfold Rdiv. split.
      - apply Rle_trans with (/ 2000000000 * / 10000); [lra|apply Rmult_le_compat; lra].
      - apply Rle_trans with (10000 * 10); [apply Rmult_le_compat; lra|lra]. }
    assert (LP : sqrt P = 0 \/ / 10000000000 <= Rabs (sqrt P)) by (destruct Lr as [Lr|Lr]; [now left|right; rewrite Rabs_pos_eq; lra]).
    assert (HB : Z < 0 -> Rabs (value32 K * (- Z / value32 R) * X) <= 20000000 /\ Rabs (value32 K * (- Z / value32 R) * sqrt P) <=
      20000000).
    { intros _. clear -Sx Sz. split; [apply Rle_trans with (1 := Sx)|apply Rle_trans with (1 := Sz)]; lra. }
    exact (along_is_right R w K _ (- Z / value32 R) _ _ X 0 _ (sqrt P) (66 * share101) (Z < 0) answer Hp Egap ltac:(lra) Htouch ltac:(lra)
      HM
      (encloses_exact _ _ (exactly_is _ _ Ix)) ltac:(lra) Er ltac:(lra) LX LP HB H).
  - (* beside it *)
    cbn [negb] in H.
    assert (E0 : 0 = value32 K * - Z * 0) by ring. rewrite E0 in Sx.
    assert (I1 : is64 (two_to 0) 1) by (apply (two_to_is 0); lia).
    assert (HM : Z < 0 -> / 100000000000000 <= - Z <= 100000).
    { intro T. assert (Hz : / 2000000000 <= - Z) by (destruct LZ as [LZ|LZ]; [lra|rewrite Rabs_left in LZ; lra]). split; lra. }
    assert (HB : Z < 0 -> Rabs (value32 K * - Z * 0) <= 20000000 /\ Rabs (value32 K * - Z * 1) <= 20000000).
    { intros _. clear -Sx Sz. split; [apply Rle_trans with (1 := Sx)|apply Rle_trans with (1 := Sz)]; lra. }
    pose proof (along_is_right R w K gap (- Z) 0 _ 0 0 _ 1 0 (Z < 0) answer Hp (encloses_exact _ _ Igap) ltac:(lra) ltac:(split; lra)
      ltac:(apply Rabs_le; lra) HM (encloses_exact _ _ (exactly_is _ _ zero_is)) ltac:(lra) (encloses_exact _ _ (exactly_is _ _ I1))
        ltac:(lra)
      ltac:(now left) ltac:(right; rewrite Rabs_R1; lra) HB H) as A.
    rewrite <- E0 in A. exact A.
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
