(* SPDX-License-Identifier: BSD-3-Clause *)
(* The third stage of bump-cylinder: exact() of fast/laws/bump_cylinder.h with numbers of 2048 bits. Its answer is right, also where
   the two forces oppose and cancel, and so is every answer of the law. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Evaluate Inputs Polygons Cylinder CylinderAnswers CylinderConstants.
From Forceshade Require Import SecondStage SecondAlong Separation SeparationOfCylinder Bump2pSecond CylinderSecond BumpCylinderSecond.
From Forceshade Require Import BigFloat BigFloatValues BigFloatProducts BigFloatDecide TwoPolygonsThird BigFloatBounded CylinderThird.
Open Scope R_scope.

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
