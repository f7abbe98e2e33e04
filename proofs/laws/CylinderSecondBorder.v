(* SPDX-License-Identifier: BSD-3-Clause *)
(* v = R^2 - rho^2, whose sign says whether the cylinder is touched, as the second stage of cylinder computes it in double-double:
   exact() of fast/laws/cylinder.h. It may cancel, however far. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import CylinderFirst.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts.
From Forceshade Require Import EnclosedQuotients BesideTie EnclosedSums SecondAlong TwoPolygonsGap Contained CylinderSecondParts.
Open Scope R_scope.

Definition second_squares (w : binary32) (xv : binary64) : double_double :=
  multiply (add (exactly64 (half_width w)) (negated (exactly64 xv))) (add (exactly64 (half_width w)) (exactly64 xv)).
Definition second_v (R w : binary32) (xv zv : binary64) : double_double :=
  add (second_squares w xv) (negated (multiply (exactly64 zv) (second_m R w zv))).

(* ---- (w/2 - x) (w/2 + x) ---- *)

Lemma squares_enclosed : forall R w K xv X, parameters R w K -> coordinate xv X ->
  let A := (value32 w / 2 - X) * (value32 w / 2 + X) in
  encloses (21 * share101) (second_squares w xv) A /\ charged (second_squares w xv) /\
  (A = 0 \/ / 20000000000000000000 <= Rabs A) /\ Rabs A <= 400000000.
Proof.
  intros R w K xv X Hp Cx A. pose proof share_is_small as Hsh. pose proof (half_width_coordinate _ _ _ Hp) as Cc.
  pose proof Hp as (_ & HR & Hw & _). pose proof (coordinate_range _ _ Cx) as BX. set (c := value32 w / 2) in *.
  assert (Hc : / 2000 <= c <= 10000) by (unfold c; lra). pose proof (exactly_is _ _ (coordinate_is _ _ Cc)) as Ic.
  pose proof (exactly_is _ _ (coordinate_is _ _ Cx)) as Ix. set (u := c + - X). set (t := c + X).
  assert (apart : forall Y, in_binary32 Y -> Y = 0 \/ bpow radix2 (-30) <= Rabs Y -> c - Y = 0 \/ / 10000000000000000 <= Rabs (c - Y)).
  { intros Y GY TY. destruct (Req_dec (c - Y) 0) as [E|E]; [now left|right]. apply Rle_trans with (bpow radix2 (-53)); [simpl; lra|].
    apply difference_is_not_tiny; trivial; [exact (coordinate_format _ _ Cc)|]. right. rewrite Rabs_pos_eq by lra. simpl. lra. }
  pose proof (coordinate_format _ _ Cx) as GX. pose proof (coordinate_not_tiny _ _ Cx) as TX.
  assert (Bu : u = 0 \/ / 10000000000000000 <= Rabs u) by exact (apart X GX TX).
  assert (Bt : t = 0 \/ / 10000000000000000 <= Rabs t).
  { unfold t. replace (c + X) with (c - - X) by ring. apply apart; [now apply generic_format_opp|].
    rewrite Rabs_Ropp. destruct TX as [->|TX]; [left; ring|now right]. }
  pose proof (Rabs_triang c (- X)) as Tu. pose proof (Rabs_triang c X) as Tt. fold u in Tu. fold t in Tt.
  rewrite Rabs_Ropp in Tu. rewrite (Rabs_pos_eq c) in Tu, Tt by lra.
  pose proof (Rabs_triang u t) as T2. replace (u + t) with (2 * c) in T2 by (unfold u, t; ring). rewrite (Rabs_pos_eq (2 * c)) in T2 by lra.
  assert (Eu : encloses (3 * share101) (add (exactly64 (half_width w)) (negated (exactly64 xv))) u).
  { apply encloses_sum_of_either_sign; trivial; [now apply negated_is|rewrite Rabs_pos_eq; lra|rewrite Rabs_Ropp; lra|].
    fold u. destruct Bu; [now left|right; lra]. }
  assert (Et : encloses (3 * share101) (add (exactly64 (half_width w)) (exactly64 xv)) t).
  { apply encloses_sum_of_either_sign; trivial; [rewrite Rabs_pos_eq; lra|lra|]. fold t. destruct Bt; [now left|right; lra]. }
  pose proof (first_size _ _ _ Eu ltac:(lra)) as Su. pose proof (first_size _ _ _ Et ltac:(lra)) as St.
  assert (EA : A = u * t) by (unfold A, u, t; ring). pose proof (Rabs_pos u) as Pu. pose proof (Rabs_pos t) as Pt.
  assert (LA : A = 0 \/ / 20000000000000000000 <= Rabs u * Rabs t).
  { destruct Bu as [Bu|Bu]; [left; rewrite EA, Bu; ring|]. destruct Bt as [Bt|Bt]; [left; rewrite EA, Bt; ring|right].
    destruct (Rle_lt_dec (/ 2000) (Rabs u)) as [H|H].
    - apply Rle_trans with (/ 2000 * / 10000000000000000); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with (/ 10000000000000000 * / 2000); [lra|apply Rmult_le_compat; lra]. }
  assert (BA : Rabs u * Rabs t <= 20000 * 20000) by (apply Rmult_le_compat; lra).
  assert (Hs : 3 * share101 * (3 * share101) <= / 1000 * (3 * share101 + 3 * share101)).
  { apply Rle_trans with (3 * share101 * / 1000); [apply Rmult_le_compat_l; lra|lra]. }
  destruct (multiply_encloses _ _ _ _ _ _ Eu Et ltac:(lra) ltac:(lra) Hs) as (Ea & Ca & _).
  { set (p := Rabs (value64 (hi (add _ (negated _))))) in *. set (q := Rabs (value64 (hi (add _ (exactly64 xv))))) in *.
    destruct Bu as [Bu|Bu]; [left; rewrite Bu, Rabs_R0 in Su; replace p with 0 by lra; ring|].
    destruct Bt as [Bt|Bt]; [left; rewrite Bt, Rabs_R0 in St; replace q with 0 by lra; ring|right]. split.
    - apply Rle_trans with (/ 100000000000000000 * / 100000000000000000); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with (30000 * 30000); [apply Rmult_le_compat; lra|lra]. }
  fold (second_squares w xv) in Ea, Ca. rewrite <- EA in Ea. split; [apply encloses_more with (1 := Ea); lra|]. split; [exact Ca|].
  rewrite EA in *. rewrite Rabs_mult. split; [exact LA|lra].
Qed.

(* ---- z (z + 2d) ---- *)

Lemma z_part_is : forall R w K zv Z, parameters R w K -> coordinate zv Z -> let d := axis_depth (value32 R) (value32 w) in
  let M := Z + d + d in let B := Z * M in let b := multiply (exactly64 zv) (second_m R w zv) in
  contains b B /\ Rabs (value64 (hi b)) <= 400000000 /\
  value64 (error b) <= 1500 * (share101 * (Rabs Z * (d + Rabs M))) + 100000000 * tiny /\
  (B = 0 -> value64 (hi b) = 0) /\
  (B = 0 \/ / 25000000000000000000000000000000000000 <= Rabs B /\ 98 / 100 * Rabs B <= Rabs (value64 (hi b)) /\
    value64 (error b) <= / 100 * Rabs B).
Proof.
  intros R w K zv Z Hp Cz d M B b. pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  destruct (m_is_near R w K zv Z Hp Cz) as [[Cm Em Nm Am] BM]. fold d in Cm, Em, Nm, Am, BM. fold M in Cm, Em, Nm, Am, BM.
  pose proof Hp as (_ & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 _]. fold d in Hd0.
  destruct (depth_enclosed R w K Hp) as [_ Bd]. fold d in Bd. assert (Bd2 : 0 <= d <= 10000) by lra. clear Bd.
  pose proof (coordinate_range _ _ Cz) as BZ. pose proof (coordinate_is _ _ Cz) as Iz. pose proof (Rabs_pos Z) as PZ.
  pose proof (Rabs_pos M) as PM.
  assert (LZ : Z = 0 \/ / 1100000000 <= Rabs Z).
  { destruct (coordinate_not_tiny _ _ Cz) as [L|L]; [now left|right]. simpl in L. lra. }
  assert (Ez : encloses 0 (exactly64 zv) Z) by now apply encloses_exact, exactly_is.
  assert (Czz : contains (exactly64 zv) Z) by (apply (enclosed_is_contained 0); [exact Ez|lra|lra]).
  assert (EZM : share101 * (Rabs Z * (d + Rabs M)) = Rabs Z * (share101 * d) + Rabs Z * (share101 * Rabs M)) by ring.
  assert (Bsd : 0 <= share101 * d <= / 1000000).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (/ 10000000000 * 10000); [apply Rmult_le_compat; lra|lra]. }
  assert (BsM : 0 <= share101 * Rabs M <= / 1000000 * Rabs M) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (P1 : 0 <= Rabs Z * (share101 * d)) by (apply Rmult_le_pos; lra).
  assert (P2 : 0 <= Rabs Z * (share101 * Rabs M)) by (apply Rmult_le_pos; lra).
  assert (P3 : 0 <= Rabs Z * tiny <= 10000 * tiny) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  set (g := 450 * (share101 * d + tiny) + 10 * (share101 * Rabs M)) in *.
  assert (EZg : Rabs Z * g = 450 * (Rabs Z * (share101 * d)) + 450 * (Rabs Z * tiny) + 10 * (Rabs Z * (share101 * Rabs M))) by
    (unfold g; ring).
  destruct (Req_dec M 0) as [M0|M0].
  - assert (B0 : B = 0) by (unfold B; rewrite M0; ring). specialize (Nm M0).
    assert (Rabs M = 0) as RM0 by (rewrite M0; apply Rabs_R0).
    destruct (multiply_nothing (exactly64 zv) _ Z 0 0 Iz zero_is zero_is ltac:(lra) ltac:(lra) Nm
      ltac:(unfold g in Em; rewrite RM0 in Em; lra)) as [Nb Eb].
    fold b in Nb, Eb. rewrite Rplus_0_r in Eb.
    assert (Rabs Z * value64 (error (second_m R w zv)) <= Rabs Z * g) by (apply Rmult_le_compat_l; lra).
    rewrite B0. split; [exact (nothing_contains _ Nb)|]. destruct Nb as ([Hb _] & _). rewrite Hb, Rabs_R0. split; [lra|].
    split; [lra|]. split; [reflexivity|now left].
  - destruct Am as [Am|[Am1 Am2]]; [contradiction|]. assert (Hg : g <= / 2000 * Rabs M) by (unfold g; lra).
    assert (Hg0 : 0 <= g) by (unfold g; lra).
    pose proof (contained_is_enclosed _ _ g Cm M0 Em Hg) as Ee. set (t := 102 / 100 * (g / Rabs M)) in *.
    assert (tM : t * Rabs M = 102 / 100 * g) by (unfold t; field; lra).
    assert (Ht : 0 <= t <= / 1000).
    { unfold t. split; [apply Rmult_le_pos; [lra|apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]]|].
      assert (g / Rabs M <= / 2000); [|lra]. apply Rmult_le_reg_r with (Rabs M); [lra|]. unfold Rdiv.
      rewrite Rmult_assoc, Rinv_l, Rmult_1_r; lra. }
    pose proof (first_size _ _ _ Ee Ht) as Sm. set (h := Rabs (value64 (hi (second_m R w zv)))) in *.
    assert (EM : Rabs (value64 (hi (exactly64 zv))) * h = Rabs Z * h) by (cbn [exactly64 hi]; now rewrite (proj1 Iz)).
    assert (SZh : 99 / 100 * (Rabs Z * Rabs M) <= Rabs Z * h <= 101 / 100 * (Rabs Z * Rabs M)).
    { split; [replace (99 / 100 * (Rabs Z * Rabs M)) with (Rabs Z * (99 / 100 * Rabs M)) by ring|
        replace (101 / 100 * (Rabs Z * Rabs M)) with (Rabs Z * (101 / 100 * Rabs M)) by ring]; apply Rmult_le_compat_l; lra. }
    assert (BZM : 0 <= Rabs Z * Rabs M <= 10000 * 30000) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
    assert (LB : Rabs Z * Rabs M = 0 \/ / 25000000000000000000000000000000000000 <= Rabs Z * Rabs M).
    { destruct LZ as [LZ|LZ]; [left; rewrite LZ, Rabs_R0; ring|right].
      apply Rle_trans with (/ 1100000000 * / 20000000000000000000000000000); [lra|apply Rmult_le_compat; lra]. }
    destruct (multiply_encloses 0 t _ _ _ _ Ez Ee ltac:(lra) ltac:(lra) ltac:(lra)) as (Eb & _ & Sb).
    { fold h. rewrite EM. destruct LB; [left; lra|right; lra]. }
    fold h b in Eb, Sb. fold B in Eb. rewrite EM in Sb. destruct (enclosed_is_bounded _ _ _ 400000000 Eb ltac:(lra) ltac:(lra) ltac:(lra))
        as [Cb _].
    pose proof (enclosed_error _ _ _ Eb) as Db. set (k := Rabs (value64 (hi b))) in *.
    assert (Db2 : value64 (error b) <= (3 * (0 + t) + 3 * share101) * (10202 / 10000 * (Rabs Z * Rabs M))).
    { apply Rle_trans with (1 := Db). apply Rmult_le_compat_l; lra. }
    assert (EB : Rabs B = Rabs Z * Rabs M) by apply Rabs_mult.
    assert (E2 : (3 * (0 + t) + 3 * share101) * (10202 / 10000 * (Rabs Z * Rabs M)) =
      10202 / 10000 * (3 * (Rabs Z * (t * Rabs M)) + 3 * (Rabs Z * (share101 * Rabs M)))) by ring.
    split; [exact Cb|]. split; [lra|]. split; [rewrite E2, tM in Db2;
        replace (Rabs Z * (102 / 100 * g)) with (102 / 100 * (Rabs Z * g)) in Db2 by ring; lra|].
    split.
    + intro B0. rewrite B0, Rabs_R0 in EB. apply no_size. fold k. lra.
    + destruct LB as [LB|LB]; [left; apply no_size; lra|right]. rewrite EB. split; [exact LB|]. split; [lra|].
      apply Rle_trans with (1 := Db2). assert ((3 * (0 + t) + 3 * share101) * (10202 / 10000 * (Rabs Z * Rabs M)) <= / 300 *
        (10202 / 10000 * (Rabs Z * Rabs M))) by (apply Rmult_le_compat_r; lra). lra.
Qed.

(* ---- v ---- *)

Theorem second_v_is : forall R w K xv X zv Z, parameters R w K -> coordinate xv X -> coordinate zv Z ->
  let d := axis_depth (value32 R) (value32 w) in let M := Z + d + d in
  let A := (value32 w / 2 - X) * (value32 w / 2 + X) in let v := second_v R w xv zv in
  contains v (A - Z * M) /\
  value64 (error v) <= 50 * (share101 * Rabs A) + 3200 * (share101 * (Rabs Z * (d + Rabs M))) + 300000000 * tiny /\
  (sign_of v = is_positive -> / 100000000000000000000000000000000000000000000000000 <= value64 (hi v)).
Proof.
  intros R w K xv X zv Z Hp Cx Cz d M A v. pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  destruct (squares_enclosed R w K xv X Hp Cx) as (Ea & Ha & LA & BA). fold A in Ea, LA, BA.
  destruct (z_part_is R w K zv Z Hp Cz) as (Cb & Bb & Db & Zb & Lb). fold d in Cb, Db, Zb, Lb. fold M in Cb, Db, Zb, Lb.
  set (B := Z * M) in *. set (b := multiply (exactly64 zv) (second_m R w zv)) in *. set (a := second_squares w xv) in *.
  pose proof (first_size _ _ _ Ea ltac:(lra)) as Sa. pose proof (enclosed_error _ _ _ Ea) as Da.
  assert (Ca : contains a A) by (apply (enclosed_is_contained _ _ _ Ea); lra).
  assert (Cn : contains (negated b) (- B) /\ value64 (hi (negated b)) = - value64 (hi b)).
  { destruct Cb as (h & l & e & H & L & E & Bl & He & D & Bh). pose proof (opp_is _ _ H) as Hn. pose proof (opp_is _ _ L) as Ln. split.
    - exists (- h), (- l), e. split; [exact Hn|]. split; [exact Ln|]. split; [exact E|]. rewrite !Rabs_Ropp. split; [exact Bl|].
    split; [exact He|].
      split; [|exact Bh]. replace (- h + - l - - B) with (- (h + l - B)) by ring. now rewrite Rabs_Ropp.
    - cbn [negated hi]. rewrite (proj1 Hn), (proj1 H). reflexivity. }
  destruct Cn as [Cn En]. change (error b) with (error (negated b)) in Db, Lb.
  set (p := Rabs (value64 (hi a))) in *. pose proof (Rabs_pos A) as PA.
  assert (Bsp : 0 <= share101 * p <= 1).
  { split; [apply Rmult_le_pos; [lra|apply Rabs_pos]|]. apply Rle_trans with (/ 1000000000 * 1000000000); [apply Rmult_le_compat; try lra;
      apply Rabs_pos|lra]. }
  assert (Bsa : share101 * p <= 101 / 100 * (share101 * Rabs A)).
  { replace (101 / 100 * (share101 * Rabs A)) with (share101 * (101 / 100 * Rabs A)) by ring. apply Rmult_le_compat_l; lra. }
  assert (Bd : 0 <= d <= 10000).
  { destruct (depth_enclosed R w K Hp) as [_ Bd]. fold d in Bd. lra. }
  destruct (m_is_near R w K zv Z Hp Cz) as [_ BM]. fold d in BM. fold M in BM. pose proof (coordinate_range _ _ Cz) as BZ.
  pose proof (Rabs_pos Z) as PZ. pose proof (Rabs_pos M) as PM.
  set (W := Rabs Z * (d + Rabs M)) in *. assert (BW : 0 <= W <= 10000 * 40000) by (unfold W; split; [apply Rmult_le_pos;
      lra|apply Rmult_le_compat; lra]).
  assert (BsW : 0 <= share101 * W <= 1).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (/ 1000000000 * 1000000000); [apply Rmult_le_compat; lra|lra]. }
  assert (BB : Rabs B <= W).
  { unfold B, W. rewrite Rabs_mult. apply Rmult_le_compat_l; lra. }
  assert (Cv : contains v (A - B)).
  { apply (sum_of_contained a (negated b) A (- B)); trivial; try lra.
    - fold p. lra.
    - rewrite En, Rabs_Ropp. lra.
    - rewrite En, Rabs_Ropp. destruct LA as [LA|LA]; [|right; left; fold p; lra]. destruct Lb as [Lb|Lb]; [|right; right; lra].
      left. split; [|rewrite (Zb Lb); ring]. apply no_size. fold p. rewrite LA, Rabs_R0 in Sa. lra. }
  split; [exact Cv|]. pose proof (sum_error _ _ _ _ _ Ca Cn Cv ltac:(lra) ltac:(lra)) as Er. cbv zeta in Er.
  change (add a (negated b)) with v in Er. destruct (contained_size _ _ Cv) as (Pe & Sv & Sv2 & _).
  destruct (contained_size _ _ Cn) as (Pb & _ & _ & _).
  set (h := Rabs (value64 (hi v))) in *. set (e := value64 (error v)) in *.
  pose proof (minus_size A B) as TV.
  assert (Bsh : share101 * h <= 1001 / 1000 * (share101 * Rabs A + share101 * W) + / 1000 * e).
  { apply Rle_trans with (share101 * (1001 / 1000 * (Rabs A + W + e))); [apply Rmult_le_compat_l; lra|].
    assert (share101 * e <= / 2000 * e) by (apply Rmult_le_compat_r; lra). lra. }
  split.
  - assert (0 <= share101 * Rabs A) by (apply Rmult_le_pos; lra). lra.
  - intro Pos. destruct (positive_is _ _ Cv Pos) as (q & m & f & Q & _ & F & _ & Hf & Dm & _). pose proof (Rabs_pos m) as Pm.
    assert (Eh : h = q) by (unfold h; rewrite (proj1 Q); apply Rabs_pos_eq; lra). assert (Ef : e = f) by exact (proj1 F). rewrite (proj1 Q).
    unfold charged in Ha. fold p in Ha. destruct LA as [LA|LA].
    + destruct (enclosed_zero _ a ltac:(rewrite <- LA; exact Ea) ltac:(lra)) as (_ & _ & [E0 _]). rewrite E0 in Er.
      destruct Lb as [Lb|(Lb1 & Lb2 & Lb3)].
      * pose proof (sign_is_right _ _ Cv) as S. rewrite Pos, LA, Lb in S. lra.
      * assert (EV : Rabs (A - B) = Rabs B) by (rewrite LA; replace (0 - B) with (- B) by ring; apply Rabs_Ropp).
        assert (share101 * h <= / 1000 * h) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
        pose proof (unit_times h ltac:(apply Rabs_pos)). rewrite EV in *. lra.
    + assert (98 / 100 * (share101 * (99 / 100 * / 20000000000000000000)) <= 98 / 100 * (share101 * p)).
      { apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; lra. }
      unfold share101 in *. lra.
Qed.
