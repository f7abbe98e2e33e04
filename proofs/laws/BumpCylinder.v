(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second and the third stage of bump-cylinder: exact() of fast/laws/bump_cylinder.h in double-double and with numbers of 2048 bits.
   An answer that the second gives is right; the third's is right, also where the two forces oppose and cancel, and so is every answer
   of the law. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import CylinderFirst CylinderAnswers CylinderConstants DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds.
From Forceshade Require Import DoubleDoubleTerms Enclosures EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondStage.
From Forceshade Require Import SecondAlong Contained CylinderSecondParts CylinderSecondBorder CylinderSecondForce CylinderSecond.
Open Scope R_scope.

(* ---- The second stage ---- *)

(* on_plane(K, z) *)
Definition plane_outcome (K z : binary32) : outcome :=
  let gap := exactly64 (opp (to64 z)) in
  let magnitude := multiply (exactly64 (to64 K)) gap in
  (sign_of gap, multiply magnitude (exactly64 zero64), multiply magnitude (exactly64 (two_to 0))).

Definition bump_cylinder_outcome (R w K x z : binary32) : outcome :=
  let cylinder := cylinder_outcome R w K x z in
  match fst (fst cylinder) with
  | is_unknown => cylinder
  | contact_sign =>
    if negb (is_less32 z zero32) then cylinder
    else
      match contact_sign with
      | is_positive => (is_positive, snd (fst cylinder), add (snd cylinder) (snd (plane_outcome K z)))
      | _ => plane_outcome K z
      end
  end.
Definition bump_cylinder_second (R w K x z : binary32) : option evaluation := decide_outcome (bump_cylinder_outcome R w K x z).

Lemma plane_is_along : forall K z, decide_outcome (plane_outcome K z) =
  decide_along K (exactly64 (opp (to64 z))) (exactly64 zero64) (exactly64 (two_to 0)).
Proof. intros. unfold decide_outcome, plane_outcome, decide_along. reflexivity. Qed.

Lemma plane_along_z : forall K z, snd (plane_outcome K z) =
  multiply (multiply (exactly64 (to64 K)) (exactly64 (opp (to64 z)))) (exactly64 (two_to 0)).
Proof. intros. unfold plane_outcome. reflexivity. Qed.

Lemma plane_enclosed : forall R w K zv Z, parameters R w K -> coordinate zv Z -> Z < 0 ->
  encloses (13 * share101) (multiply (multiply (exactly64 (to64 K)) (exactly64 (opp zv))) (exactly64 (two_to 0))) (value32 K * - Z) /\
  / 2000000000000 <= value32 K * - Z <= 10000000.
Proof.
  intros R w K zv Z ((_ & _ & FK) & _ & _ & HK) Cz HZ. pose proof share_is_small as Hsh.
  assert (LZ : / 2000000000 <= - Z <= 10000).
  { pose proof (coordinate_range _ _ Cz) as BZ. rewrite Rabs_left in BZ by exact HZ.
    destruct (coordinate_not_tiny _ _ Cz) as [L|L]; [lra|]. rewrite Rabs_left in L by exact HZ. simpl in L. lra. }
  pose proof (encloses_exact _ _ (exactly_is _ _ (opp_is _ _ (coordinate_is _ _ Cz)))) as Eg.
  pose proof (encloses_exact _ _ (exactly_is _ _ (to64_is_exact K FK))) as EK.
  pose proof (encloses_exact _ _ (exactly_is _ _ (two_to_is 0 ltac:(lia)))) as E1. change (bpow radix2 0) with 1 in E1.
  assert (B : / 1000 * / 2000000000 <= value32 K * - Z <= 1000 * 10000) by (split; apply Rmult_le_compat; lra).
  split; [|lra]. rewrite <- (Rmult_1_r (value32 K * - Z)).
  apply encloses_more with (3 * ((3 * (0 + 0) + 3 * share101) + 0) + 3 * share101); [|lra].
  apply encloses_multiply; try lra; [apply encloses_multiply; trivial; try lra|exact E1|]; right; right; rewrite Rabs_pos_eq; lra.
Qed.

(* The cylinder's component along z with the plane's. *)
Lemma component_with_plane : forall R w K zv Z value F, parameters R w K -> coordinate zv Z -> Z < 0 -> component value F ->
  acceptable (add value (multiply (multiply (exactly64 (to64 K)) (exactly64 (opp zv))) (exactly64 (two_to 0)))) (F + value32 K * - Z).
Proof.
  intros R w K zv Z value F Hp Cz HZ (C & E & B). pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  destruct (plane_enclosed R w K zv Z Hp Cz HZ) as [Ep Bp]. set (plane := multiply _ (exactly64 (two_to 0))) in *.
  set (W := value32 K * - Z) in *. pose proof (first_size _ _ _ Ep ltac:(lra)) as Sp. rewrite (Rabs_pos_eq W) in Sp by lra.
  destruct (enclosed_is_bounded _ _ _ 10100000 Ep ltac:(lra) ltac:(lra) ltac:(lra)) as [Cp Dp].
  assert (D : contains (add value plane) (F + W)) by (apply sum_of_contained; trivial; try lra; right; right; lra).
  pose proof (sum_error _ _ _ _ _ C Cp D ltac:(lra) ltac:(lra)) as Er. cbv zeta in Er.
  split; [exact D|]. destruct (contained_size _ _ D) as (_ & _ & _ & Bh).
  assert (Sh : share101 * Rabs (value64 (hi (add value plane))) <= 1 * 1000000000000).
  { apply Rmult_le_compat; try lra; apply Rabs_pos. }
  split; [lra|]. unfold fits. destruct C as (h & l & e & H & L & _ & Bl & _), Cp as (c & k & f & H' & L' & _ & Bk & _).
  rewrite (proj1 H) in B. rewrite (proj1 H') in Sp. pose proof (unit_times _ (Rabs_pos h)). pose proof (unit_times _ (Rabs_pos c)).
  destruct (sum_of_is_off _ _ _ _ h l c k (Rabs h + Rabs c) (Rabs l + Rabs k) H L H' L' ltac:(lra) ltac:(lra) (Rabs_triang h c)
    ltac:(lra) ltac:(lra)) as (p & q & P & _ & _ & Bpq & _).
  change (hi (add value plane)) with (fst (sum_of (hi value) (lo value) (hi plane) (lo plane))). rewrite (proj1 P). lra.
Qed.

Lemma bump_cylinder_second_is_right : forall R w K x X z Z answer, parameters R w K -> is_finite 24 128 x = true -> value32 x = X ->
  is_finite 24 128 z = true -> value32 z = Z -> coordinate (to64 x) X -> coordinate (to64 z) Z ->
  bump_cylinder_second R w K x z = Some answer ->
  is_answer answer (distance_from_axis (value32 R) (value32 w) X Z < value32 R \/ Z < 0)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z)
    (cylinder_z (value32 R) (value32 w) (value32 K) X Z + Rmax (- value32 K * Z) 0).
Proof.
  intros R w K x X z Z answer Hp Fx Vx Fz Vz Cx Cz H. pose proof (cylinder_outcome_is R w K _ _ _ _ Hp Fx Vx Cx Cz) as O. cbv zeta in O.
  pose proof Hp as (_ & _ & _ & HK). unfold bump_cylinder_second, bump_cylinder_outcome in H. cbv zeta in H.
  rewrite (less32_is z zero32 Fz eq_refl), Vz in H. change (value32 zero32) with 0 in H.
  destruct (cylinder_outcome R w K x z) as [[s fx] fz]. cbn [fst snd] in O, H.
  destruct (Rlt_le_dec Z 0) as [HZ|HZ].
  - rewrite Rlt_bool_true in H by exact HZ. cbn [negb] in H.
    assert (EW : Rmax (- value32 K * Z) 0 = value32 K * - Z).
    { replace (- value32 K * Z) with (value32 K * - Z) by ring. apply Rmax_left. apply Rmult_le_pos; lra. }
    rewrite EW. set (rho := distance_from_axis (value32 R) (value32 w) X Z) in *.
    assert (beside : ~ rho < value32 R -> decide_outcome (plane_outcome K z) = Some answer -> is_answer answer (rho < value32 R \/ Z < 0)
      (cylinder_x (value32 R) (value32 w) (value32 K) X Z) (cylinder_z (value32 R) (value32 w) (value32 K) X Z + value32 K * - Z)).
    { intros Hout D. unfold cylinder_x, cylinder_z. cbv zeta. fold rho. rewrite !Rlt_bool_false by lra. rewrite Rplus_0_l.
      apply is_answer_same with (Z < 0); [tauto|]. rewrite plane_is_along in D. exact (on_plane_is_right R w K _ Z answer Hp Cz D). }
    destruct s; [now apply beside|now apply beside| |discriminate].
    destruct O as (T & Ax & Az). unfold decide_outcome in H. rewrite plane_along_z in H.
    refine (decided_outcome_is_right is_positive _ _ _ _ _ answer _ H).
    split; [now left|]. split; [now apply component_is_acceptable|].
    exact (component_with_plane R w K _ Z fz _ Hp Cz HZ Az).
  - rewrite Rlt_bool_false in H by exact HZ. cbn [negb] in H.
    assert (EW : Rmax (- value32 K * Z) 0 = 0).
    { apply Rmax_right. replace (- value32 K * Z) with (- (value32 K * Z)) by ring.
        assert (0 <= value32 K * Z) by (apply Rmult_le_pos; lra). lra. }
    rewrite EW, Rplus_0_r. assert (D : decide s fx fz = Some answer) by (unfold decide_outcome in H; destruct s; exact H). clear H.
    refine (decided_outcome_is_right s fx fz _ _ _ answer _ D). destruct s; [| | |exact Logic.I].
    + intros [G|G]; [now apply O|lra].
    + intros [G|G]; [now apply O|lra].
    + destruct O as (T & Ax & Az). split; [now left|]. split; now apply component_is_acceptable.
Qed.

Theorem bump_cylinder_second_stage_answers_right : forall R w K x y z answer, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  bump_cylinder_second R w K (quantised x) (quantised z) = Some answer ->
  is_answer answer (distance_from_axis (value32 R) (value32 w) X Z < value32 R \/ Z < 0)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z)
    (cylinder_z (value32 R) (value32 w) (value32 K) X Z + Rmax (- value32 K * Z) 0).
Proof.
  intros R w K x y z answer Hp Hv.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx], (valid_coordinates _ _ _ Hv) as [Cx Cz].
  assert (Hz : value32 (quantised z) = read (value32 z) /\ is_finite 24 128 (quantised z) = true).
  { unfold valid in Hv. destruct (andb_prop _ _ Hv) as [_ Hz]. apply in_domain_is_right in Hz. apply quantised_is_right, Hz. }
  exact (bump_cylinder_second_is_right R w K _ _ _ _ answer Hp Fx Vx (proj2 Hz) (proj1 Hz) Cx Cz).
Qed.

(* Every answer of the first two stages is right, for every input of the domain. *)
Theorem bump_cylinder_two_stages_answer_right : forall is_fused R w K third x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  right_or_later
    (evaluate bump_cylinder_window (cylinder_of bump_cylinder R w K is_fused) (later_of (bump_cylinder_second R w K) third) x y z)
    (third (quantised x) (quantised z)) (distance_from_axis (value32 R) (value32 w) X Z < value32 R \/ Z < 0)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z)
    (cylinder_z (value32 R) (value32 w) (value32 K) X Z + Rmax (- value32 K * Z) 0).
Proof.
  intros is_fused R w K third x y z Hp Hv X Z. apply two_stages_are_right with (second := bump_cylinder_second R w K).
  - now apply bump_cylinder_first_stage_answers_right_for_all.
  - intros found H. now apply (bump_cylinder_second_stage_answers_right R w K x y z found).
Qed.

(* ---- The third stage ---- *)

From Forceshade Require Import Separation SeparationOfCylinder BigFloat BigFloatValues BigFloatProducts BigFloatDecide TwoPolygonsThird.
From Forceshade Require Import BigFloatBounded Cylinder.

(* on_plane(K, z) *)
Definition plane_outcome_third (K z : binary32) : outcome_third :=
  let gap := number (opp (to64 z)) in
  let magnitude := multiply 2048 (number (to64 K)) gap in
  (sign_of_big gap, multiply 2048 magnitude (number zero64), multiply 2048 magnitude (number (two_to 0))).

Definition bump_cylinder_outcome_third (R w K x z : binary32) : outcome_third :=
  let cylinder := cylinder_outcome_third R w K x z in
  if negb (is_less32 z zero32) then cylinder
  else
    match fst (fst cylinder) with
    | Gt => (Gt, snd (fst cylinder), add 2048 (snd cylinder) (snd (plane_outcome_third K z)))
    | _ => plane_outcome_third K z
    end.
Definition bump_cylinder_third (R w K x z : binary32) : evaluation := decide_third (bump_cylinder_outcome_third R w K x z).

Lemma plane_third_is : forall R w K z Z, parameters R w K -> coordinate (to64 z) Z -> Z < 0 ->
  let o := plane_outcome_third K z in
  fst (fst o) = Gt /\ component_third (snd (fst o)) 0 /\ component_third (snd o) (value32 K * - Z).
Proof.
  intros R w K z Z ((_ & _ & FK) & _ & _ & HK) Cz HZ o. pose proof (opp_is _ _ (coordinate_is _ _ Cz)) as Ig.
  pose proof (coordinate_range _ _ Cz) as BZ. rewrite Rabs_left in BZ by exact HZ.
  pose proof (input_bounded _ _ Ig ltac:(rewrite Rabs_pos_eq; lra)) as Bg.
  pose proof (input_bounded _ _ (to64_is_exact K FK) ltac:(rewrite Rabs_pos_eq; lra)) as BK.
  pose proof (input_bounded _ _ zero_is ltac:(rewrite Rabs_R0; lra)) as B0.
  pose proof (two_to_is 0 ltac:(lia)) as I1. change (bpow radix2 0) with 1 in I1.
  pose proof (input_bounded _ _ I1 ltac:(rewrite Rabs_R1; lra)) as B1.
  unfold o, plane_outcome_third. clear o. cbv zeta. cbn [fst snd].
  set (g := number (opp (to64 z))) in *. set (kn := number (to64 K)) in *. set (n0 := number zero64) in *.
    set (n1 := number (two_to 0)) in *.
  assert (Bg' : bounded 2048 1074 (-1974) 17 g (- Z)) by (apply bounded_more with (1 := Bg); numbers; lia).
  assert (BK' : bounded 2048 1074 (-1974) 17 kn (value32 K)) by (apply bounded_more with (1 := BK); numbers; lia).
  pose proof (bounded_multiply 2048 1074 (-1974) 17 (-1974) 17 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia)
    ltac:(lia) BK' Bg') as Bm. set (m := multiply 2048 kn g) in *.
  assert (Bm' : bounded 2048 100000 (-1940) 40 m (value32 K * - Z)) by (apply bounded_more with (1 := Bm); numbers; lia).
  assert (times : forall n N, bounded 2048 1074 none 15 n N -> bounded 2048 50000000000 (-1500) 170 (multiply 2048 m n)
    (value32 K * - Z * N)).
  { intros n N B. assert (B' : bounded 2048 100000 (-1974) 17 n N) by (apply bounded_more with (1 := B); numbers; lia).
    pose proof (bounded_multiply 2048 100000 (-1940) 40 (-1974) 17 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia)
      ltac:(lia) Bm' B') as P. apply bounded_more with (1 := P); numbers; lia. }
  assert (S : is_sign (sign_of_big g) (- Z)).
  { apply (sign_of_bounded 2048 1074 (-1974) 17 30); try assumption; try lia; try (numbers; lia). intros _.
    destruct (coordinate_not_tiny _ _ Cz) as [H|H]; [lra|]. now rewrite Rabs_Ropp. }
  split; [destruct (sign_of_big g); cbn [is_sign] in S; [lra|lra|reflexivity]|].
  assert (BKZ : 0 <= value32 K * - Z <= 1000 * 10000) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]). split; split.
  - replace 0 with (value32 K * - Z * 0) by ring. now apply times.
  - rewrite Rabs_R0. lra.
  - rewrite <- (Rmult_1_r (value32 K * - Z)). now apply times.
  - rewrite Rabs_pos_eq; lra.
Qed.

Theorem bump_cylinder_third_stage_answers_right : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  is_answer (bump_cylinder_third R w K (quantised x) (quantised z)) (distance_from_axis (value32 R) (value32 w) X Z < value32 R \/ Z < 0)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z)
    (cylinder_z (value32 R) (value32 w) (value32 K) X Z + Rmax (- value32 K * Z) 0).
Proof.
  intros R w K x y z Hp Hv X Z. pose proof (cylinder_outcome_third_is R w K x y z Hp Hv) as O. cbv zeta in O. fold X Z in O.
  pose proof (fun m H => bump_cylinder_is_separated R w K x y z m Hp Hv H) as Sep. cbv zeta in Sep. fold X Z in Sep.
  destruct (valid_coordinates _ _ _ Hv) as [_ Cz]. fold Z in Cz. pose proof Hp as (_ & _ & _ & HK).
  assert (Hz : value32 (quantised z) = Z /\ is_finite 24 128 (quantised z) = true).
  { unfold valid in Hv. destruct (andb_prop _ _ Hv) as [_ Hz]. apply in_domain_is_right in Hz. apply quantised_is_right, Hz. }
  destruct Hz as [Vz Fz]. set (qz := quantised z) in *. set (rho := distance_from_axis (value32 R) (value32 w) X Z) in *.
  assert (B25 : 20000000 <= bpow radix2 25) by (simpl; lra).
  assert (one : forall a F, component_third a F -> fine 2048 60000000000 (949 - 1) a F /\ Rabs F <= bpow radix2 25).
  { intros a F [B S]. split; [apply (bounded_is_fine (-1500) 170); [exact B|lia]|lra]. }
  unfold bump_cylinder_third, decide_third, bump_cylinder_outcome_third. cbv zeta.
  rewrite (less32_is qz zero32 Fz eq_refl), Vz. change (value32 zero32) with 0.
  destruct (cylinder_outcome_third R w K (quantised x) qz) as [[s fx] fz]. cbn [fst snd] in O |- *.
  destruct (Rlt_le_dec Z 0) as [HZ|HZ].
  - rewrite Rlt_bool_true by exact HZ. cbn [negb].
    assert (EW : Rmax (- value32 K * Z) 0 = value32 K * - Z).
    { replace (- value32 K * Z) with (value32 K * - Z) by ring. apply Rmax_left. apply Rmult_le_pos; lra. }
    rewrite EW in Sep |- *. destruct (plane_third_is R w K qz Z Hp Cz HZ) as (Sp & Px & Pz). fold qz in Sp, Px, Pz.
    destruct (plane_outcome_third K qz) as [[sp px] pz]. cbn [fst snd] in Sp, Px, Pz |- *. subst sp.
    assert (beside : ~ rho < value32 R -> is_answer (decide_big 2048 Gt px pz) (rho < value32 R \/ Z < 0)
      (cylinder_x (value32 R) (value32 w) (value32 K) X Z) (cylinder_z (value32 R) (value32 w) (value32 K) X Z + value32 K * - Z)).
    { intro Hout. assert (Ex : cylinder_x (value32 R) (value32 w) (value32 K) X Z = 0).
      { unfold cylinder_x. cbv zeta. fold rho. now rewrite Rlt_bool_false by lra. }
      assert (Ez : cylinder_z (value32 R) (value32 w) (value32 K) X Z + value32 K * - Z = value32 K * - Z).
      { unfold cylinder_z. cbv zeta. fold rho. rewrite Rlt_bool_false by lra. ring. }
      rewrite Ex, Ez in Sep |- *. apply (decided_fine_is_right 2048 60000000000 949); try lia; try (numbers; lia); [|exact Sep].
      destruct (one _ _ Px) as [A1 A2], (one _ _ Pz) as [A3 A4]. split; [now right|]. exact (conj A1 (conj A2 (conj A3 A4))). }
    destruct s; [now apply beside|now apply beside|]. clear beside. destruct O as (T & Ox & Oz).
    apply (decided_fine_is_right 2048 60000000000 949); try lia; try (numbers; lia); [|exact Sep].
    destruct (one _ _ Ox) as [Fx Sx]. split; [now left|]. split; [exact Fx|]. split; [exact Sx|].
    destruct Oz as [Bz Sz], Pz as [Bp Sp].
    pose proof (bounded_add 2048 50000000000 (-1500) 170 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia) Bz Bp)
      as (N & F & C & E & _). split.
    + split; [exact N|]. split; [apply BigFloatQuotients.fits_le with (2 := F); numbers; lia|]. split; [exact C|lia].
    + apply Rle_trans with (1 := Rabs_triang _ _). lra.
  - rewrite Rlt_bool_false by exact HZ. cbn [negb].
    assert (EW : Rmax (- value32 K * Z) 0 = 0).
    { apply Rmax_right. replace (- value32 K * Z) with (- (value32 K * Z)) by ring.
      assert (0 <= value32 K * Z) by (apply Rmult_le_pos; lra). lra. }
    rewrite EW, Rplus_0_r in Sep |- *. apply (decided_fine_is_right 2048 60000000000 949); try lia; try (numbers; lia); [|exact Sep].
    destruct s; [intros [G|G]; [now apply O|lra]|intros [G|G]; [now apply O|lra]|].
    destruct O as (T & Ox & Oz). destruct (one _ _ Ox) as [A1 A2], (one _ _ Oz) as [A3 A4]. split; [now left|].
    exact (conj A1 (conj A2 (conj A3 A4))).
Qed.

(* Every answer is right, for every input of the domain. *)
Theorem bump_cylinder_answers_right : forall is_fused R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  is_answer
    (evaluate bump_cylinder_window (cylinder_of bump_cylinder R w K is_fused)
      (later_of (bump_cylinder_second R w K) (bump_cylinder_third R w K)) x y z)
    (distance_from_axis (value32 R) (value32 w) X Z < value32 R \/ Z < 0)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z)
    (cylinder_z (value32 R) (value32 w) (value32 K) X Z + Rmax (- value32 K * Z) 0).
Proof.
  intros is_fused R w K x y z Hp Hv X Z. apply three_stages_are_right with (bump_cylinder_third R w K (quantised x) (quantised z)).
  - now apply bump_cylinder_two_stages_answer_right.
  - now apply (bump_cylinder_third_stage_answers_right R w K x y z).
Qed.
