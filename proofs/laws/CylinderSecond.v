(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second stage of cylinder in double-double: exact() of fast/laws/cylinder.h. An answer that it gives is right, however far l and
   v have cancelled. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import CylinderFirst.
From Forceshade Require Import CylinderAnswers CylinderConstants DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms.
From Forceshade Require Import Enclosures EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondStage SecondAlong TwoPolygonsGap.
From Forceshade Require Import Contained CylinderSecondParts CylinderSecondBorder CylinderSecondForce.
Open Scope R_scope.

(* x != 0 *)
Definition is_nonzero (x : binary32) : bool := match Bcompare 24 128 x zero32 with Some Eq => false | _ => true end.

(* The sign of the contact and the components along x and z. *)
Definition outcome : Type := Sign * double_double * double_double.
Definition cylinder_outcome (R w K x z : binary32) : outcome :=
  let l := second_l R w (to64 z) in
  match (if is_nonzero x then is_positive else sign_of l) with
  | is_unknown => (is_unknown, exactly64 (to64 R), exactly64 (to64 R))
  | is_zero => (is_positive, exactly64 zero64, multiply (exactly64 (to64 K)) (exactly64 (to64 R)))
  | _ =>
    let scale := second_scale R w K (to64 x) (to64 z) in
    (sign_of (second_v R w (to64 x) (to64 z)), multiply scale (exactly64 (to64 x)), multiply scale l)
  end.

Definition decide_outcome (o : outcome) : option evaluation := let '(contact_sign, fx, fz) := o in decide contact_sign fx fz.
Definition cylinder_second (R w K x z : binary32) : option evaluation := decide_outcome (cylinder_outcome R w K x z).

Lemma is_nonzero_is : forall x, is_finite 24 128 x = true -> is_nonzero x = negb (Req_bool (value32 x) 0).
Proof.
  intros x Fx. unfold is_nonzero. rewrite Bcompare_correct by (trivial; reflexivity). change (value32 zero32) with 0.
  case Rcompare_spec; case Req_bool_spec; intros; try reflexivity; exfalso; lra.
Qed.

(* A component that another may be added to before it is rounded. *)
Definition component (value : double_double) (x : R) : Prop :=
  contains value x /\ value64 (error value) <= 10000000000 /\ Rabs (value64 (hi value)) <= 12000000.

Lemma component_is_acceptable : forall value x, component value x -> acceptable value x.
Proof. intros value x (C & E & B). split; [exact C|]. split; [lra|unfold fits; lra]. Qed.

Lemma enclosed_component : forall s value x, encloses s value x -> 0 <= s <= 100 -> Rabs (value64 (hi value)) <= 12000000 ->
  component value x.
Proof.
  intros s value x E Hs B. destruct (enclosed_is_bounded s value x _ E Hs B ltac:(lra)) as [C Be]. split; [exact C|]. split; [|exact B].
  assert (s * 12000000 <= 100 * 12000000) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Lemma force_components : forall R w K xv X zv Z, parameters R w K -> coordinate xv X -> coordinate zv Z ->
  let L := Z + axis_depth (value32 R) (value32 w) in let rho := distance_from_axis (value32 R) (value32 w) X Z in
  let scale := second_scale R w K xv zv in X <> 0 \/ L <> 0 -> rho < value32 R -> sign_of (second_v R w xv zv) = is_positive ->
  component (multiply scale (exactly64 xv)) (cylinder_x (value32 R) (value32 w) (value32 K) X Z) /\
  component (multiply scale (second_l R w zv)) (cylinder_z (value32 R) (value32 w) (value32 K) X Z).
Proof.
  intros R w K xv X zv Z Hp Cx Cz L rho scale Hne Hin Pos. pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  destruct (scale_enclosed R w K xv X zv Z Hp Cx Cz Hne Hin Pos) as (Es & Low & High). fold scale in Es, Low, High. fold rho in Es, High.
  destruct (rho_enclosed R w K xv X zv Z Hp Cx Cz Hne) as (_ & SX & SL & Br). fold rho in SX, SL, Br. fold L in SL.
  destruct (l_is R w K zv Z Hp Cz) as [BL Hl]. fold L in BL, Hl.
  unfold cylinder_x, cylinder_z. cbv zeta. fold rho L. rewrite !Rlt_bool_true by exact Hin. rewrite !Req_bool_false by lra.
  set (s := value32 K * (value32 R - rho) / rho) in *. clearbody scale. set (q := Rabs (value64 (hi scale))) in *.
  assert (E : forall Y, value32 K * (value32 R - rho) * (Y / rho) = s * Y) by (intro Y; unfold s; field; lra). rewrite !E.
  pose proof (coordinate_is _ _ Cx) as Ix. split.
  - assert (Ex : encloses 0 (exactly64 xv) X) by now apply encloses_exact, exactly_is.
    assert (EX : Rabs (value64 (hi (exactly64 xv))) = Rabs X) by (cbn [exactly64 hi]; now rewrite (proj1 Ix)).
    assert (BqX : q * Rabs X <= 11000000) by (apply Rle_trans with (2 := High); apply Rmult_le_compat_l; [apply Rabs_pos|exact SX]).
    destruct (multiply_encloses (19 / 2) 0 _ _ _ _ Es Ex ltac:(lra) ltac:(lra) ltac:(lra)) as (Ef & _ & Sf).
    { rewrite EX. fold q. destruct (coordinate_not_tiny _ _ Cx) as [H|H]; [left; rewrite H, Rabs_R0; ring|right]. split; [|lra].
      simpl in H. apply Rle_trans with (/ 100000000000000000000000000000000000000000000000000000000000000 * / 1073741824); [lra|].
      apply Rmult_le_compat; lra. }
    rewrite EX in Sf. fold q in Sf. apply (enclosed_component _ _ _ Ef); lra.
  - destruct Hl as [(L0 & Nl & El)|(LL & t & Ht & Et)].
    + rewrite L0, Rmult_0_r. destruct Hne as [HX|HL]; [|contradiction].
      destruct (coordinate_not_tiny _ _ Cx) as [H|H]; [contradiction|]. simpl in H.
      assert (Bq : q <= 100000000000000000).
      { apply Rmult_le_reg_r with rho; [lra|]. apply Rle_trans with (1 := High). lra. }
      pose proof (enclosed_error _ _ _ Es) as De. fold q in De. destruct Es as (h & l & e & H1 & L1 & E1 & _ & Be & _).
      unfold q in Bq, De. rewrite (proj1 H1) in Bq, De. rewrite (proj1 E1) in De. clear q Low High.
      destruct (multiply_nothing scale (second_l R w zv) h l e H1 L1 E1 ltac:(lra) ltac:(lra) Nl ltac:(lra)) as [Nf Ef].
      assert (Rabs h + e <= 10000000000000000000) by lra.
      assert ((Rabs h + e) * value64 (error (second_l R w zv)) <= 10000000000000000000 * / 100000000000000000000000).
      { pose proof (Rabs_pos h). apply Rmult_le_compat; try lra. destruct Nl as (_ & _ & f & [F _] & Hf). rewrite F. exact Hf. }
      split; [exact (nothing_contains _ Nf)|]. destruct Nf as ([Hf _] & _). rewrite Hf, Rabs_R0. split; lra.
    + pose proof (first_size _ _ _ Et ltac:(lra)) as Sl. set (y := Rabs (value64 (hi (second_l R w zv)))) in *.
      pose proof (Rabs_pos L) as PL. pose proof (Rabs_pos (value64 (hi scale))) as Pq. fold q in Pq.
      assert (Bqy : / 100000000000000000000000000000000000000000000000000000000000000 * / 30000000000000000000000000000 <= q * y <=
        101 / 100 * 11000000).
      { split; [apply Rmult_le_compat; lra|]. apply Rle_trans with (q * (101 / 100 * rho)); [apply Rmult_le_compat_l; lra|].
        replace (q * (101 / 100 * rho)) with (101 / 100 * (q * rho)) by ring. lra. }
      destruct (multiply_encloses (19 / 2) t _ _ _ _ Es Et ltac:(lra) ltac:(lra) ltac:(lra)) as (Ef & _ & Sf).
      { fold q y. right. lra. }
      fold q y in Sf. apply (enclosed_component _ _ _ Ef); lra.
Qed.

(* What exact() finds is right, where it finds something. *)
Theorem cylinder_outcome_is : forall R w K x X z Z, parameters R w K -> is_finite 24 128 x = true -> value32 x = X ->
  coordinate (to64 x) X -> coordinate (to64 z) Z ->
  let touches := distance_from_axis (value32 R) (value32 w) X Z < value32 R in let o := cylinder_outcome R w K x z in
  match fst (fst o) with
  | is_unknown => True
  | is_positive => touches /\ component (snd (fst o)) (cylinder_x (value32 R) (value32 w) (value32 K) X Z) /\
    component (snd o) (cylinder_z (value32 R) (value32 w) (value32 K) X Z)
  | _ => ~ touches
  end.
Proof.
  intros R w K x X z Z Hp Fx Vx Cx Cz touches o. pose proof share_is_small as Hsh.
  destruct (l_is_near R w K _ Z Hp Cz) as [[Cl _ _ _] _]. pose proof (sign_is_right _ _ Cl) as Sl.
  destruct (distance_squared (value32 R) (value32 w) X Z) as [P Q]. set (L := Z + axis_depth (value32 R) (value32 w)) in *.
  set (computed := (sign_of (second_v R w (to64 x) (to64 z)), multiply (second_scale R w K (to64 x) (to64 z)) (exactly64 (to64 x)),
    multiply (second_scale R w K (to64 x) (to64 z)) (second_l R w (to64 z)))).
  assert (off_axis : X <> 0 \/ L <> 0 -> match fst (fst computed) with
  | is_unknown => True
  | is_positive => touches /\ component (snd (fst computed)) (cylinder_x (value32 R) (value32 w) (value32 K) X Z) /\
    component (snd computed) (cylinder_z (value32 R) (value32 w) (value32 K) X Z)
  | _ => ~ touches
  end).
  { intro Hne. unfold computed. cbn [fst snd]. clear o computed.
    pose proof (force_components R w K _ X _ Z Hp Cx Cz Hne) as F.
    destruct (second_v_is R w K _ X _ Z Hp Cx Cz) as (Cv & _ & _). cbv zeta in Cv. pose proof (sign_is_right _ _ Cv) as S.
    pose proof Hp as (_ & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [_ Hd2].
    set (rho := distance_from_axis (value32 R) (value32 w) X Z) in *. unfold touches.
    assert (EV : (value32 w / 2 - X) * (value32 w / 2 + X) - Z * (Z + axis_depth (value32 R) (value32 w) + axis_depth (value32 R)
      (value32 w))
      = value32 R * value32 R - rho * rho).
    { rewrite Q. replace (value32 R * value32 R) with (axis_depth (value32 R) (value32 w) * axis_depth (value32 R) (value32 w) +
        value32 w / 2 * (value32 w / 2)) by lra. unfold L. ring. }
    rewrite EV in S. assert (outside : value32 R * value32 R - rho * rho <= 0 -> ~ rho < value32 R).
    { intros H T. assert (rho * rho < value32 R * value32 R) by (apply Rmult_le_0_lt_compat; lra). lra. }
    destruct (sign_of (second_v R w (to64 x) (to64 z))); [apply outside; lra|apply outside; lra| |exact Logic.I].
    assert (Hin : rho < value32 R).
    { destruct (Rlt_le_dec rho (value32 R)) as [|H]; [assumption|]. exfalso.
      assert (value32 R * value32 R <= rho * rho) by (apply Rmult_le_compat; lra). lra. }
    split; [exact Hin|]. exact (F Hin eq_refl). }
  unfold o, cylinder_outcome. clear o. cbv zeta. rewrite (is_nonzero_is x Fx), Vx. fold computed. clearbody computed.
  case Req_bool_spec; intro X0; cbn [negb]; [|exact (off_axis (or_introl X0))].
  destruct (sign_of (second_l R w (to64 z))); [apply off_axis; right; lra| |apply off_axis; right; lra|exact Logic.I].
  (* on the axis *)
  clear off_axis. cbn [fst snd]. unfold touches, cylinder_x, cylinder_z. cbv zeta. fold L.
  set (rho := distance_from_axis (value32 R) (value32 w) X Z) in *.
  assert (R0 : rho = 0).
  { rewrite X0, Sl in Q. apply Rsqr_0_uniq. unfold Rsqr. lra. }
  destruct Hp as ((FR & _ & FK) & HR & Hw & HK). rewrite R0. rewrite !Rlt_bool_true by lra. rewrite !Req_bool_true by reflexivity.
  split; [lra|]. replace (value32 K * (value32 R - 0) * 0) with 0 by ring.
  replace (value32 K * (value32 R - 0) * 1) with (value32 K * value32 R) by ring.
  split.
  - apply (enclosed_component 0); [apply encloses_exact, exactly_is, zero_is|lra|]. cbn [exactly64 hi]. change (value64 zero64) with 0.
  rewrite Rabs_R0. lra.
  - assert (BKR : / 1000 * / 10 <= value32 K * value32 R <= 1000 * 10000) by (split; apply Rmult_le_compat; lra).
    assert (EKR : encloses (3 * (0 + 0) + 3 * share101) (multiply (exactly64 (to64 K)) (exactly64 (to64 R))) (value32 K * value32 R)).
    { apply encloses_multiply; try lra; [apply encloses_exact, exactly_is;
      now apply to64_is_exact|apply encloses_exact, exactly_is; now apply
        to64_is_exact|]. right. right. rewrite Rabs_pos_eq; lra. }
    pose proof (first_size _ _ _ EKR ltac:(lra)) as S. rewrite (Rabs_pos_eq (value32 K * value32 R)) in S by lra.
    apply (enclosed_component _ _ _ EKR); lra.
Qed.

Theorem cylinder_second_stage_answers_right : forall R w K x y z answer, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  cylinder_second R w K (quantised x) (quantised z) = Some answer ->
  is_answer answer (distance_from_axis (value32 R) (value32 w) X Z < value32 R)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z) (cylinder_z (value32 R) (value32 w) (value32 K) X Z).
Proof.
  intros R w K x y z answer Hp Hv X Z H. destruct (quantised_x_is _ _ _ Hv) as [Vx Fx], (valid_coordinates _ _ _ Hv) as [Cx Cz].
  pose proof (cylinder_outcome_is R w K _ _ _ _ Hp Fx Vx Cx Cz) as O. cbv zeta in O. unfold cylinder_second, decide_outcome in H.
  destruct (cylinder_outcome R w K (quantised x) (quantised z)) as [[s fx] fz]. cbn [fst snd] in O.
  apply (decided_outcome_is_right s fx fz); [|exact H]. destruct s; try exact O.
  destruct O as (T & Ax & Az). split; [exact T|]. split; now apply component_is_acceptable.
Qed.

(* Every answer of the first two stages is right, for every input of the domain. *)
Theorem cylinder_two_stages_answer_right : forall is_fused R w K third x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  right_or_later (evaluate cylinder_window (cylinder_of cylinder R w K is_fused) (later_of (cylinder_second R w K) third) x y z)
    (third (quantised x) (quantised z)) (distance_from_axis (value32 R) (value32 w) X Z < value32 R)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z) (cylinder_z (value32 R) (value32 w) (value32 K) X Z).
Proof.
  intros is_fused R w K third x y z Hp Hv X Z. apply two_stages_are_right with (second := cylinder_second R w K).
  - now apply cylinder_first_stage_answers_right_for_all.
  - intros found H. now apply (cylinder_second_stage_answers_right R w K x y z found).
Qed.
