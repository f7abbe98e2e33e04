(* SPDX-License-Identifier: BSD-3-Clause *)
(* The depth d of the cylinder's axis, l = z + d and z + 2d, as the second stage of cylinder computes them in double-double: exact()
   of fast/laws/cylinder.h. Where they cancel, their bounds remain small shares of them, or they are 0 and so are both terms. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Mult_error.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import CylinderFirst.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Separation Enclosures.
From Forceshade Require Import EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondAlong TwoPolygonsGap Contained
  CylinderNearness.
Open Scope R_scope.

Lemma root_of_square : forall a a_lo d, is64 a (d * d) -> is64 a_lo 0 -> in_binary64 d -> 0 < d <= 100000 ->
  is64 (fst (square_root_of a a_lo)) d /\ is64 (snd (square_root_of a a_lo)) 0.
Proof.
  intros a a_lo d Ha Hl Gd Hd. unfold square_root_of. cbv zeta. cbn [fst snd].
  assert (Hdd : 0 <= d * d) by (apply Rmult_le_pos; lra).
  pose proof (square_root_is _ _ Ha Hdd) as I1. rewrite sqrt_square, round_generic in I1 by (auto with typeclass_instances; lra).
  set (t1 := square_root a) in *. pose proof (opp_is _ _ I1) as I2. set (t2 := opp t1) in *.
  assert (I3 : is64 (fused t2 t1 a) 0).
  { apply (fused_exact _ _ _ (- d) d (d * d)); trivial; [ring|apply generic_format_0|apply zero_is_not_too_large]. }
  set (t3 := fused t2 t1 a) in *. assert (I4 : is64 (plus t3 a_lo) 0) by exact_step plus_exact. set (t4 := plus t3 a_lo) in *.
  assert (I5 : is64 (plus t1 t1) (2 * d)).
  { apply (plus_exact _ _ d d); trivial; [ring| |apply big_enough; rewrite Rabs_pos_eq; lra].
    replace (2 * d) with (d * bpow radix2 1) by (change (bpow radix2 1) with 2; ring). apply mult_bpow_pos_exact_FLT; [exact Gd|lia]. }
  set (t5 := plus t1 t1) in *. pose proof (over_zero _ _ _ I4 I5 ltac:(lra)) as I6. set (t6 := over t4 t5) in *.
  assert (I7 : is64 (plus t1 t6) d) by (apply (plus_exact _ _ d 0); trivial; [ring|apply big_enough; rewrite Rabs_pos_eq; lra]).
  set (t7 := plus t1 t6) in *. assert (I8 : is64 (minus t7 t1) 0) by exact_step minus_exact. set (t8 := minus t7 t1) in *.
  split; [exact I7|]. exact_step minus_exact.
Qed.

(* Where d is a number of binary32, both terms are those of d. *)
Lemma exact_depth : forall R w K, parameters R w K -> let d := axis_depth (value32 R) (value32 w) in in_binary32 d ->
  is64 (hi (computed_depth R w)) d /\ is64 (lo (computed_depth R w)) 0.
Proof.
  intros R w K Hp d Gd. destruct (depth_enclosed R w K Hp) as [Ed Bd]. fold d in Ed, Bd. pose proof share_is_small as Hsh.
  destruct Bd as [Bd|Bd].
  { rewrite Bd in *. destruct (enclosed_zero _ _ Ed ltac:(lra)) as (H & L & _). now split. }
  pose proof (first_size _ _ _ Ed ltac:(lra)) as Sd. rewrite (Rabs_pos_eq d) in Sd by lra.
  pose proof (half_width_is _ _ _ Hp) as Ic. pose proof (half_chord_is_binary64 _ _ _ Hp) as F. cbv zeta in F.
  destruct F as (Gm & Gp & _). destruct Hp as ((FR & _ & _) & HR & Hw & _).
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [_ Hd2]. fold d in Hd2.
  pose proof (to64_is_exact R FR) as IR. set (r := value32 R) in *. set (c := value32 w / 2) in *.
  destruct (add_is _ _ _ _ (exactly_is _ _ IR) (negated_is _ _ (exactly_is _ _ Ic)) Gm ltac:(rewrite Rabs_pos_eq; lra)
    ltac:(rewrite Rabs_Ropp, Rabs_pos_eq; unfold c; lra)) as (e & A1 & A2 & _).
  destruct (add_is _ _ _ _ (exactly_is _ _ IR) (exactly_is _ _ Ic) Gp ltac:(rewrite Rabs_pos_eq; lra)
    ltac:(rewrite Rabs_pos_eq; unfold c; lra)) as (f & B1 & B2 & _).
  change (r + - c) with (r - c) in A1. assert (E : (r - c) * (r + c) = d * d) by (rewrite Hd2; ring).
  assert (Ldd : / 1000000 * / 1000000 <= d * d) by (apply Rmult_le_compat; lra).
  assert (Bdd : d * d <= 10000 * 10000) by (apply Rmult_le_compat; lra).
  assert (Gdd : in_binary64 (d * d)) by now apply product_is_binary64.
  destruct (product_of_exact _ _ _ _ _ _ A1 A2 B1 B2) as [C1 C2].
  { right. rewrite E, Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 (-60)); [apply bpow_le; lia|simpl; lra]. }
  { rewrite E, Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 40); [simpl; lra|apply bpow_le; lia]. }
  rewrite E, round_generic in C1, C2 by auto with typeclass_instances. replace (d * d - d * d) with 0 in C2 by ring.
  assert (T1 : is64 (hi (depth_square R w)) (d * d)) by exact C1. assert (T2 : is64 (lo (depth_square R w)) 0) by exact C2.
  revert Sd. unfold computed_depth, root_of. rewrite (equal_is _ _ _ _ T1 zero_is), (Req_bool_false (d * d) 0) by lra. cbn [andb].
  destruct (negb _); cbn [hi lo].
  - change (value64 zero64) with 0. rewrite Rabs_R0. lra.
  - intros _. cbv zeta. unfold rounded. cbn [hi lo]. apply root_of_square; trivial; [|lra].
    apply generic_inclusion_mag with fexp32; [intros _; unfold FLT_exp; lia|exact Gd].
Qed.

Definition second_l (R w : binary32) (zv : binary64) : double_double := add (exactly64 zv) (computed_depth R w).
Definition second_m (R w : binary32) (zv : binary64) : double_double := add (second_l R w zv) (computed_depth R w).

Lemma exact_l : forall R w K zv Z, parameters R w K -> let d := axis_depth (value32 R) (value32 w) in is64 zv Z -> in_binary32 d ->
  in_binary64 (Z + d) -> Rabs Z <= 10000 -> Rabs d <= 10000 -> is64 (hi (second_l R w zv)) (Z + d) /\ is64 (lo (second_l R w zv)) 0.
Proof.
  intros R w K zv Z Hp d Hz Gd Gl BZ Bd. destruct (exact_depth R w K Hp Gd) as [H L]. fold d in H. pose proof (Rabs_triang Z d) as T.
  assert (big : forall a, Rabs a <= 1000000 -> Rabs a <= bpow radix2 1000) by (intros a Ha; apply big_enough; lra).
  exact (sum_of_exact _ _ _ _ Z d Hz zero_is H L Gl (big Z ltac:(lra)) (big d ltac:(lra)) (big (Z + d) ltac:(lra))).
Qed.

(* What is known of l = z + d and of z + 2d, of which x is one. *)
Record near_axis (a : double_double) (x d k j : R) : Prop := {
  axis_contains : contains a x;
  axis_error : value64 (error a) <= k * (share101 * d + tiny) + j * (share101 * Rabs x);
  axis_nothing : x = 0 -> nothing a;
  axis_apart : x = 0 \/ 134217728 * (share101 * d) <= Rabs x /\ / 20000000000000000000000000000 <= Rabs x
}.

Lemma share_power : bpow radix2 (-74) = 134217728 * share101.
Proof. unfold share101. simpl. lra. Qed.

Lemma half_format : forall a, in_binary32 a -> a = 0 \/ / 2000000000 <= Rabs a -> in_binary32 (a / 2).
Proof.
  intros a Ga Ha. replace (a / 2) with (a * bpow radix2 (-1)) by (change (bpow radix2 (-1)) with (/ 2); field).
  destruct Ha as [->|Ha]; [rewrite Rmult_0_l; apply generic_format_0|]. apply mult_bpow_exact_FLT; [exact Ga|].
  assert (-31 < mag radix2 a)%Z; [|lia]. apply mag_gt_bpow. apply Rle_trans with (2 := Ha). simpl. lra.
Qed.

(* The depth of the axis with its bound of the error. *)
Lemma depth_is_near : forall R w K, parameters R w K -> let d := axis_depth (value32 R) (value32 w) in
  contains (computed_depth R w) d /\ 99 / 100 * d <= Rabs (value64 (hi (computed_depth R w))) <= 101 / 100 * d /\
  value64 (error (computed_depth R w)) <= 667 / 10 * (share101 * d) /\ 0 <= share101 * d <= 1.
Proof.
  intros R w K Hp d. pose proof share_is_small as Hsh. destruct (depth_enclosed R w K Hp) as [Ed Bd]. fold d in Ed, Bd.
  pose proof Hp as (_ & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
    fold d in Hd0, Hd2.
  assert (Bd2 : 0 <= d <= 10000) by lra. pose proof (first_size _ _ _ Ed ltac:(lra)) as Sd. rewrite (Rabs_pos_eq d) in Sd by lra.
  split; [apply (enclosed_is_contained _ _ _ Ed); [lra|rewrite Rabs_pos_eq; lra]|]. split; [lra|]. split.
  - apply Rle_trans with (1 := enclosed_error _ _ _ Ed). replace (667 / 10 * (share101 * d)) with
    (66 * share101 * (667 / 660 * d)) by field.
    apply Rmult_le_compat_l; lra.
  - split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (/ 10000 * 10000); [apply Rmult_le_compat; lra|lra].
Qed.

Lemma l_is_near : forall R w K zv Z, parameters R w K -> coordinate zv Z -> let d := axis_depth (value32 R) (value32 w) in
  near_axis (second_l R w zv) (Z + d) d 141 3 /\ Rabs (Z + d) <= 20000.
Proof.
  intros R w K zv Z Hp Cz d. pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  destruct (depth_enclosed R w K Hp) as [Ed Bd]. fold d in Ed, Bd. pose proof (half_width_coordinate _ _ _ Hp) as Cc.
  pose proof Hp as (_ & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
    fold d in Hd0, Hd2.
  assert (Bd2 : 0 <= d <= 10000) by lra. pose proof (coordinate_range _ _ Cz) as BZ. pose proof (coordinate_is _ _ Cz) as Iz.
  assert (LZ : Z = 0 \/ / 1100000000 <= Rabs Z).
  { destruct (coordinate_not_tiny _ _ Cz) as [L|L]; [now left|right]. simpl in L. lra. }
  pose proof (Rabs_triang Z d) as TL. rewrite (Rabs_pos_eq d) in TL by lra. split; [|lra].
  pose proof (exactly_is _ _ Iz) as Ez.
  assert (C : contains (second_l R w zv) (Z + d)).
  { apply (sum_contains 0 (66 * share101)); trivial; try lra; [now apply encloses_exact|].
    destruct Bd as [Bd|Bd]; [now left|right; rewrite Rabs_pos_eq; lra]. }
  assert (Czz : contains (exactly64 zv) Z) by (apply (enclosed_is_contained 0); [now apply encloses_exact|lra|lra]).
  destruct (depth_is_near R w K Hp) as (Cd & Sd & Dd2 & Bsd). fold d in Cd, Sd, Dd2, Bsd.
  pose proof (sum_error _ _ _ _ _ Czz Cd C ltac:(cbn [exactly64 error]; change (value64 zero64) with 0; lra) ltac:(lra)) as Er.
    cbv zeta in Er.
  change (add (exactly64 zv) (computed_depth R w)) with (second_l R w zv) in Er. cbn [exactly64 error] in Er.
  change (value64 zero64) with 0 in Er.
  destruct (contained_size _ _ C) as (_ & Sl & _ & _).
  split; [exact C| | |].
  - set (h := Rabs (value64 (hi (second_l R w zv)))) in *. set (e := value64 (error (second_l R w zv))) in *.
    assert (share101 * h <= 1001 / 1000 * (share101 * Rabs (Z + d)) + / 1000 * e).
    { apply Rle_trans with (share101 * (1001 / 1000 * (Rabs (Z + d) + e))); [apply Rmult_le_compat_l; lra|].
      assert (0 <= e) by (unfold e; destruct (contained_size _ _ C); assumption).
      assert (share101 * e <= / 2000 * e) by (apply Rmult_le_compat_r; lra). lra. }
    pose proof (Rabs_pos (Z + d)). assert (0 <= share101 * Rabs (Z + d)) by (apply Rmult_le_pos; lra). lra.
  - intro L0. assert (Gd : in_binary32 d) by (replace d with (- Z) by lra; apply generic_format_opp; exact (coordinate_format _ _ Cz)).
    destruct (exact_l R w K zv Z Hp Iz Gd) as [H L]; [fold d; rewrite L0; apply generic_format_0|exact BZ|fold d;
      rewrite Rabs_pos_eq; lra|].
    fold d in H. rewrite L0 in H. split; [exact H|]. split; [exact L|]. destruct C as (_ & _ & f & _ & _ & F & _ & Hf & _). now exists f.
  - destruct (Req_dec (Z + d) 0) as [L0|L0]; [now left|right]. destruct Bd as [Bd|Bd].
    + rewrite Bd, Rplus_0_r, Rmult_0_r in *. destruct LZ as [LZ|LZ]; [contradiction|]. lra.
    + pose proof (beside_a_root (value32 R) (value32 w / 2) d (- Z) (generic_format_B2R 24 128 R) (coordinate_format _ _ Cc)
        (generic_format_opp _ _ _ (coordinate_format _ _ Cz)) ltac:(lra) ltac:(lra) ltac:(lra) Hd2 ltac:(intro; apply L0; lra)) as N.
      replace (d - - Z) with (Z + d) in N by ring. rewrite share_power in N. split; [lra|].
      apply Rle_trans with (134217728 * share101 * / 1000000); [unfold share101; lra|].
      apply Rle_trans with (134217728 * share101 * d); [apply Rmult_le_compat_l; lra|exact N].
Qed.

Lemma m_is_near : forall R w K zv Z, parameters R w K -> coordinate zv Z -> let d := axis_depth (value32 R) (value32 w) in
  near_axis (second_m R w zv) (Z + d + d) d 450 10 /\ Rabs (Z + d + d) <= 30000.
Proof.
  intros R w K zv Z Hp Cz d. pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  destruct (l_is_near R w K zv Z Hp Cz) as [[Cl El _ _] BL]. fold d in Cl, El, BL.
  destruct (depth_enclosed R w K Hp) as [Ed Bd]. fold d in Ed, Bd.
  pose proof Hp as (_ & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
    fold d in Hd0, Hd2.
  assert (Bd2 : 0 <= d <= 10000) by lra. pose proof (coordinate_range _ _ Cz) as BZ. pose proof (coordinate_is _ _ Cz) as Iz.
  assert (LZ : Z = 0 \/ / 1100000000 <= Rabs Z).
  { destruct (coordinate_not_tiny _ _ Cz) as [L|L]; [now left|right]. simpl in L. lra. }
  set (L := Z + d) in *. set (M := L + d) in *. pose proof (Rabs_triang L d) as TM. rewrite (Rabs_pos_eq d) in TM by lra. fold M in TM.
  pose proof (size_by L M) as TL. replace (L - M) with (- d) in TL by (unfold M; ring). rewrite Rabs_Ropp, (Rabs_pos_eq d) in TL by lra.
  split; [|lra].
  destruct (depth_is_near R w K Hp) as (Cd & Sd & Dd2 & Bsd). fold d in Cd, Sd, Dd2, Bsd.
  assert (BsL : share101 * Rabs L <= share101 * Rabs M + share101 * d) by (rewrite <- Rmult_plus_distr_l; apply Rmult_le_compat_l; lra).
  pose proof (Rabs_pos M) as PM. assert (BsM : 0 <= share101 * Rabs M <= 3).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (/ 10000 * 30000); [apply Rmult_le_compat; lra|lra]. }
  destruct (contained_size _ _ Cl) as (_ & Sl & _ & _). destruct (contained_size _ _ Cd) as (Pd & _ & _ & _).
  assert (C : contains (second_m R w zv) M).
  { apply sum_of_contained; trivial; try lra. destruct Bd as [Bd|Bd].
    - destruct LZ as [LZ|LZ].
      + left. assert (Gd : in_binary32 d) by (rewrite Bd; apply generic_format_0).
        assert (L0 : L = 0) by (unfold L; rewrite Bd, LZ; ring).
        destruct (exact_l R w K zv Z Hp Iz Gd) as [[H _] _]; [fold d L; rewrite L0; apply generic_format_0|exact BZ|fold d;
            rewrite Rabs_pos_eq; lra|].
        destruct (exact_depth R w K Hp Gd) as [[H2 _] _]. fold d in H, H2. rewrite H, H2. split; [exact L0|exact Bd].
      + right. left. destruct (contained_size _ _ Cl) as (_ & _ & S & _). unfold L in S, Sl. rewrite Bd, Rplus_0_r in S.
        assert (E0 : share101 * d = 0) by (rewrite Bd; ring). rewrite E0 in *.
        assert (Rabs L <= 20000 /\ share101 * Rabs L <= / 1000 * Rabs L) as [_ B3].
        { split; [exact BL|]. apply Rmult_le_compat_r; [apply Rabs_pos|lra]. }
        assert (ELZ : Rabs L = Rabs Z) by (unfold L; rewrite Bd, Rplus_0_r; reflexivity).
        pose proof (unit_times _ (Rabs_pos (value64 (hi (second_l R w zv))))). lra.
    - right. right. lra. }
  pose proof (sum_error _ _ _ _ _ Cl Cd C ltac:(lra) ltac:(lra)) as Er. cbv zeta in Er.
  change (add (second_l R w zv) (computed_depth R w)) with (second_m R w zv) in Er.
  destruct (contained_size _ _ C) as (Pe & Sm & _ & _).
  split; [exact C| | |].
  - set (h := Rabs (value64 (hi (second_m R w zv)))) in *. set (e := value64 (error (second_m R w zv))) in *.
    assert (share101 * h <= 1001 / 1000 * (share101 * Rabs M) + / 1000 * e).
    { apply Rle_trans with (share101 * (1001 / 1000 * (Rabs M + e))); [apply Rmult_le_compat_l; lra|].
      assert (share101 * e <= / 2000 * e) by (apply Rmult_le_compat_r; lra). lra. }
    lra.
  - intro M0. assert (Gd : in_binary32 d).
    { replace d with (- Z / 2) by (unfold M, L in M0; lra). apply half_format;
      [apply generic_format_opp; exact (coordinate_format _ _ Cz)|].
      rewrite Rabs_Ropp. destruct LZ as [LZ|LZ]; [left; rewrite LZ; ring|right; lra]. }
    assert (EL : L = - d) by (unfold M in M0; lra).
    assert (Gd64 : in_binary64 d) by (apply generic_inclusion_mag with fexp32; [intros _; unfold FLT_exp; lia|exact Gd]).
    destruct (exact_l R w K zv Z Hp Iz Gd) as [H Lo]; [fold d L; rewrite EL; now apply generic_format_opp|exact BZ|fold d;
        rewrite Rabs_pos_eq; lra|].
    destruct (exact_depth R w K Hp Gd) as [H2 Lo2]. fold d in H, H2. fold L in H.
    assert (big : forall a, Rabs a <= 1000000 -> Rabs a <= bpow radix2 1000) by (intros a Ha; apply big_enough; lra).
    destruct (sum_of_exact _ _ _ _ L d H Lo H2 Lo2 ltac:(fold M; rewrite M0; apply generic_format_0) (big L ltac:(lra))
      (big d ltac:(rewrite Rabs_pos_eq; lra)) (big M ltac:(lra))) as [P Q]. fold M in P. rewrite M0 in P.
    split; [exact P|]. split; [exact Q|]. destruct C as (_ & _ & f & _ & _ & F & _ & Hf & _). now exists f.
  - destruct (Req_dec M 0) as [M0|M0]; [now left|right]. destruct Bd as [Bd|Bd].
    + assert (E0 : share101 * d = 0) by (rewrite Bd; ring). rewrite E0, Rmult_0_r.
      assert (EM : M = Z) by (unfold M, L; rewrite Bd; ring). rewrite EM in *. destruct LZ as [LZ|LZ]; [contradiction|]. lra.
    + assert (twice_format : forall a, in_binary32 a -> in_binary32 (2 * a)).
      { intros a Ga. replace (2 * a) with (a * bpow radix2 1) by (change (bpow radix2 1) with 2; ring).
        apply mult_bpow_pos_exact_FLT; [exact Ga|lia]. }
      pose proof (beside_a_root (2 * value32 R) (value32 w) (2 * d) (- Z) (twice_format _ (generic_format_B2R 24 128 R))
        (generic_format_B2R 24 128 w) (generic_format_opp _ _ _ (coordinate_format _ _ Cz)) ltac:(lra) ltac:(lra) ltac:(lra)
        ltac:(replace (2 * d * (2 * d)) with (4 * (d * d)) by ring; rewrite Hd2; field) ltac:(intro; apply M0; unfold M, L; lra)) as N.
      replace (2 * d - - Z) with M in N by (unfold M, L; ring). rewrite share_power in N. split; [lra|].
      apply Rle_trans with (134217728 * share101 * / 1000000); [unfold share101; lra|].
      apply Rle_trans with (134217728 * share101 * (2 * d)); [apply Rmult_le_compat_l; lra|exact N].
Qed.
