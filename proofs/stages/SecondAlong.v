(* SPDX-License-Identifier: BSD-3-Clause *)
(* K times a gap along a direction, in double-double: along() and on_plane() of fast/laws/outcome.h. The gap may have cancelled so far
   that the bound of its error is as large as the gap itself. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts
  EnclosedQuotients.
From Forceshade Require Import BesideTie SecondStage.
Open Scope R_scope.

(* a < b of C++. *)
Definition is_less32 (a b : binary32) : bool := match Bcompare 24 128 a b with Some Lt => true | _ => false end.
Definition two32 : binary32 := B754_finite 24 128 false 8388608 (-22) eq_refl.

(* 2|x| > w *)
Definition is_beside (w x : binary32) : bool := is_less32 w (b32_mult mode_NE two32 (b32_abs x)).

(* 2|x| == w *)
Definition is_at_foot (w x : binary32) : bool :=
  match Bcompare 24 128 (b32_mult mode_NE two32 (b32_abs x)) w with Some Eq => true | _ => false end.

(* along(gap, K, normal_x, normal_z), where the second stage can decide. *)
Definition decide_along (K : binary32) (gap normal_x normal_z : double_double) : option evaluation :=
  let magnitude := multiply (exactly64 (to64 K)) gap in decide (sign_of gap) (multiply magnitude normal_x) (multiply magnitude normal_z).

Lemma less32_is : forall a b, is_finite 24 128 a = true -> is_finite 24 128 b = true -> is_less32 a b = Rlt_bool (value32 a) (value32 b).
Proof.
  intros a b Fa Fb. unfold is_less32. rewrite Bcompare_correct by assumption.
    case Rcompare_spec; case Rlt_bool_spec; intros; trivial; exfalso; lra.
Qed.

Lemma is_answer_same : forall answer p q Fx Fz, (p <-> q) -> is_answer answer p Fx Fz -> is_answer answer q Fx Fz.
Proof. intros answer p q Fx Fz E [[H1 H2]|[H1 H2]]; [left; split; [tauto|exact H2]|right; split; [tauto|exact H2]]. Qed.

(* What the second stage of a valid position begins with, beside valid_coordinates. *)
Lemma quantised_x_is : forall x y z, valid x y z = true ->
  value32 (quantised x) = read (value32 x) /\ is_finite 24 128 (quantised x) = true.
Proof.
  intros x y z H. unfold valid in H. destruct (andb_prop _ _ H) as [Hxy _]. destruct (andb_prop _ _ Hxy) as [Hx _].
  apply in_domain_is_right in Hx. apply quantised_is_right, Hx.
Qed.

Lemma twice_is : forall x, Rabs (value32 x) <= 10000 -> is_finite 24 128 x = true ->
  value32 (b32_mult mode_NE two32 (b32_abs x)) = 2 * Rabs (value32 x) /\ is_finite 24 128 (b32_mult mode_NE two32 (b32_abs x)) = true.
Proof.
  intros x Bx Fx. set (a := b32_abs x).
  assert (Ea : value32 a = Rabs (value32 x)) by apply B2R_Babs.
  assert (Fa : is_finite 24 128 a = true) by (unfold a, b32_abs; now rewrite is_finite_Babs).
  assert (E2 : value32 two32 = 2) by (unfold two32, B2R, F2R; simpl; lra).
  unfold b32_mult. match goal with |- context [Bmult _ _ ?p ?q ?nan _ _ _] => pose proof (Bmult_correct 24 128 p q nan mode_NE two32 a)
  as C end.
  cbv zeta in C. change (round radix2 (SpecFloat.fexp 24 128) (round_mode mode_NE)) with nearest32 in C. rewrite E2, Ea in C.
  rewrite round_generic in C.
  - rewrite Rlt_bool_true in C.
    + destruct C as (C1 & C2 & _). rewrite Fa in C2. now split.
    + rewrite Rabs_pos_eq by (pose proof (Rabs_pos (value32 x)); lra). apply Rle_lt_trans with (bpow radix2 20); [simpl; lra|apply
      bpow_lt; lia].
  - auto with typeclass_instances.
  - replace (2 * Rabs (value32 x)) with (Rabs (value32 x) * bpow radix2 1) by (change (bpow radix2 1) with 2; ring).
    apply Mult_error.mult_bpow_pos_exact_FLT; [apply generic_format_abs, (generic_format_B2R 24 128)|lia].
Qed.

Lemma is_beside_is : forall w x, is_finite 24 128 w = true -> is_finite 24 128 x = true -> Rabs (value32 x) <= 10000 ->
  is_beside w x = negb (Rle_bool (Rabs (value32 x)) (value32 w / 2)).
Proof.
  intros w x Fw Fx Bx. destruct (twice_is x Bx Fx) as [P1 P2]. unfold is_beside, is_less32.
    rewrite Bcompare_correct by assumption. rewrite P1.
  case Rcompare_spec; case Rle_bool_spec; intros; try reflexivity; exfalso; lra.
Qed.

Lemma is_at_foot_is : forall w x, is_finite 24 128 w = true -> is_finite 24 128 x = true -> Rabs (value32 x) <= 10000 ->
  is_at_foot w x = Req_bool (Rabs (value32 x)) (value32 w / 2).
Proof.
  intros w x Fw Fx Bx. destruct (twice_is x Bx Fx) as [P1 P2]. unfold is_at_foot. rewrite Bcompare_correct by assumption. rewrite P1.
  case Rcompare_spec; case Req_bool_spec; intros; try reflexivity; exfalso; lra.
Qed.

Lemma share_is_small : 0 < share101 <= / 1000000000000000000000000000000.
Proof. unfold share101. lra. Qed.

(* ---- A gap that is found positive ---- *)

Lemma positive_is : forall a x, contains a x -> sign_of a = is_positive -> exists h l e, is64 (hi a) h /\ is64 (lo a) l /\
  is64 (error a) e /\
  Rabs l <= unit53 * Rabs h /\ 0 <= e /\ e + Rabs l < h /\ Rabs (h + l - x) <= e.
Proof.
  intros a x (h & l & e & H & L & E & Bl & He & B & Bh) Hs. unfold sign_of in Hs.
  destruct (is_equal (hi a) zero64 && is_equal (error a) zero64); [discriminate|].
  pose proof (unit_times _ (Rabs_pos h)) as Uh. assert (Ea : Rabs h * (1 - 8 * unit53) = Rabs h - 8 * (unit53 * Rabs h)) by ring.
  pose proof (times_is _ _ _ _ (absolute_is _ _ H) almost_one_is ltac:(apply big_enough; rewrite Ea, Rabs_pos_eq; pose proof (Rabs_pos h);
    lra)) as I.
  rewrite (less_is _ _ _ _ E I) in Hs. revert Hs. case Rlt_bool_spec; intros Hless Hs; cbn [negb] in Hs; [|discriminate].
  pose proof (bound_below_size h l e (format_of _ _ H) (format_of _ _ L) Bl He Hless) as D. rewrite (less_is _ _ _ _ zero_is H) in Hs.
  revert Hs. case Rlt_bool_spec; intros Hh Hs; [|discriminate]. rewrite (Rabs_pos_eq h) in D by lra. exists h, l, e.
  repeat (split; [assumption|]). exact B.
Qed.

(* Its bound is no larger than it is. *)
Lemma positive_encloses : forall a x, contains a x -> sign_of a = is_positive -> encloses 1 a x /\ 0 < value64 (hi a).
Proof.
  intros a x C S. destruct (positive_is a x C S) as (h & l & e & H & L & E & Bl & He & D & B). pose proof (Rabs_pos l).
  split; [|rewrite (proj1 H); lra]. exists h, l, e. repeat (split; [assumption|]). split; [|exact B]. rewrite (Rabs_pos_eq h) by lra. lra.
Qed.

(* Sizes of the first terms of a gap and of a component of the direction. *)
Definition directed (gap n : double_double) : Prop := let h := value64 (hi gap) in let c := Rabs (value64 (hi n)) in
  / 1000000000000000000000000000000000000000000000000 <= h <= 1000000 /\ (c = 0 \/ / 1000000000000 <= c <= 100000 /\ h * c <= 25000).

Theorem along_is_right : forall R w K gap G nx NX t nz NZ u touches answer, parameters R w K -> contains gap G -> (0 < G <-> touches) ->
  encloses t nx NX -> 0 <= t <= / 1000 -> encloses u nz NZ -> 0 <= u <= / 1000 ->
  (sign_of gap = is_positive -> touches -> directed gap nx /\ directed gap nz) ->
  decide_along K gap nx nz = Some answer -> is_answer answer touches (value32 K * G * NX) (value32 K * G * NZ).
Proof.
  intros R w K gap G nx NX t nz NZ u touches answer Hp Cgap Htouch Ex Ht Ez Hu Hsize H. pose proof share_is_small as Hsh.
  destruct Hp as ((_ & _ & FK) & _ & _ & HK). pose proof (to64_is_exact K FK) as VK.
  assert (IK : encloses 0 (exactly64 (to64 K)) (value32 K)) by now apply encloses_exact, exactly_is.
  apply (decided_is_right gap G (multiply (multiply (exactly64 (to64 K)) gap) nx) (multiply (multiply (exactly64 (to64 K)) gap) nz) 100);
    [exact Cgap|exact Htouch|lra| |exact H]. clear H.
  intros S T. destruct (Hsize S T) as [Dx Dz]. clear Hsize. destruct (positive_encloses gap G Cgap S) as [Egap _].
  assert (one : forall n N v, encloses v n N -> 0 <= v <= / 1000 -> directed gap n ->
    encloses 100 (multiply (multiply (exactly64 (to64 K)) gap) n) (value32 K * G * N) /\
      fits (multiply (multiply (exactly64 (to64 K)) gap) n)).
  { intros n N v En Hv D. unfold directed in D. cbv zeta in D. set (h := value64 (hi gap)) in *. set (c := Rabs (value64 (hi n))) in *.
    destruct D as [Hh Hc].
    assert (BKh : / 1000 * / 1000000000000000000000000000000000000000000000000 <= value32 K * h <= 1000 * 1000000) by (split;
      apply Rmult_le_compat; lra).
    assert (EM : Rabs (value64 (hi (exactly64 (to64 K)))) * Rabs (value64 (hi gap)) = value32 K * h).
    { cbn [exactly64 hi]. rewrite (proj1 VK). fold h. rewrite !Rabs_pos_eq by lra. reflexivity. }
    destruct (multiply_encloses 0 1 _ _ _ _ IK Egap ltac:(lra) ltac:(lra) ltac:(lra) ltac:(right; rewrite EM; lra)) as (Em & _ & Sm).
    rewrite EM in Sm. set (m := multiply (exactly64 (to64 K)) gap) in *. set (g := Rabs (value64 (hi m))) in *.
    assert (Bgc : g * c = 0 \/ / 10000000000000000000000000000000000000000000000000000000000000000000000 <= g * c <= 25502500).
    { destruct Hc as [Hc|[Hc Hhc]]; [left; rewrite Hc; ring|right]. split.
      - apply Rle_trans with ((99 / 100 * (value32 K * h)) * / 1000000000000); [lra|apply Rmult_le_compat; lra].
      - apply Rle_trans with ((101 / 100 * (value32 K * h)) * c); [apply Rmult_le_compat_r; lra|].
        replace (101 / 100 * (value32 K * h) * c) with (101 / 100 * (value32 K * (h * c))) by ring.
        assert (0 <= h * c) by (apply Rmult_le_pos; lra). assert (value32 K * (h * c) <= 1000 * 25000) by (apply Rmult_le_compat;
          lra). lra. }
    assert (Hv2 : (3 * (0 + 1) + 3 * share101) * v <= / 1000 * (3 * (0 + 1) + 3 * share101 + v)).
    { apply Rle_trans with ((3 * (0 + 1) + 3 * share101) * / 1000); [apply Rmult_le_compat_l; lra|lra]. }
    destruct (multiply_encloses _ _ _ _ _ _ Em En ltac:(lra) ltac:(lra) Hv2 ltac:(fold g c; destruct Bgc; [now left|right; lra])) as
      (Ef & _ & Sf).
    fold g c in Sf. split; [apply encloses_more with (1 := Ef); lra|]. unfold fits. destruct Bgc; lra. }
  split; [now apply (one nx NX t)|now apply (one nz NZ u)].
Qed.

(* A gap that is good is positive only where it is not tiny. *)
Lemma enclosed_is_directed : forall s gap G t n N, encloses s gap G -> 0 <= s <= / 1000 -> encloses t n N -> 0 <= t <= / 1000 ->
  / 1000000000000000000000000000000 <= G <= 900000 -> N = 0 \/ / 100000000000 <= Rabs N <= 90000 -> G * Rabs N <= 21000 -> directed gap n.
Proof.
  intros s gap G t n N Eg Hs En Ht BG BN BGN. pose proof (first_size _ _ _ Eg Hs) as Sg. pose proof (first_size _ _ _ En Ht) as Sn.
  destruct Eg as (h & l & e & H & L & E & Bl & Be & B). rewrite (proj1 H) in Sg. rewrite (Rabs_pos_eq G) in Sg by lra.
  pose proof (enclosed_size _ _ _ _ _ Bl Be B Hs) as Sh. pose proof (unit_times _ (Rabs_pos h)) as Uh.
  assert (s * Rabs h <= / 1000 * Rabs h) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
  assert (Hh : 0 <= h).
  { destruct (Rle_lt_dec 0 h) as [|Hn]; [assumption|]. exfalso. rewrite (Rabs_left h) in * by assumption. absolute_values. lra. }
  rewrite (Rabs_pos_eq h) in * by exact Hh. unfold directed. cbv zeta. rewrite (proj1 H). split; [lra|].
  destruct BN as [->|BN]; [left; rewrite Rabs_R0 in Sn; pose proof (Rabs_pos (value64 (hi n))); lra|right]. split; [lra|].
  apply Rle_trans with ((101 / 100 * G) * (101 / 100 * Rabs N)); [apply Rmult_le_compat; try lra; apply Rabs_pos|lra].
Qed.

(* ---- Beside the bump ---- *)

Theorem on_plane_is_right : forall R w K zv Z answer, parameters R w K -> coordinate zv Z ->
  decide_along K (exactly64 (opp zv)) (exactly64 zero64) (exactly64 (two_to 0)) = Some answer ->
  is_answer answer (Z < 0) 0 (value32 K * - Z).
Proof.
  intros R w K zv Z answer Hp Cz H. pose proof (encloses_exact _ _ (exactly_is _ _ (opp_is _ _ (coordinate_is _ _ Cz)))) as Eg.
  pose proof (encloses_exact _ _ (exactly_is _ _ zero_is)) as E0. pose proof
    (encloses_exact _ _ (exactly_is _ _ (two_to_is 0 ltac:(lia)))) as E1.
  change (bpow radix2 0) with 1 in E1. pose proof (coordinate_range _ _ Cz) as BZ. apply Rabs_le_inv in BZ.
  enough (A : is_answer answer (Z < 0) (value32 K * - Z * 0) (value32 K * - Z * 1)) by (rewrite Rmult_0_r, Rmult_1_r in A; exact A).
  refine (along_is_right R w K _ (- Z) _ 0 0 _ 1 0 (Z < 0) answer Hp _ _ E0 _ E1 _ _ H); try lra.
  - apply (enclosed_is_contained 0); [exact Eg|lra|apply Rabs_le; lra].
  - intros _ T. assert (LZ : / 2000000000 <= - Z).
    { destruct (coordinate_not_tiny _ _ Cz) as [L|L]; [lra|]. rewrite Rabs_left in L by exact T. simpl in L. lra. }
    split; [apply (enclosed_is_directed 0 _ (- Z) 0 _ 0)|apply (enclosed_is_directed 0 _ (- Z) 0 _ 1)]; trivial;
      rewrite ?Rabs_R0, ?Rabs_R1; lra.
Qed.
