(* SPDX-License-Identifier: BSD-3-Clause *)
(* The first stages of cylinder and bump-cylinder, fast/laws/cylinder.h and bump_cylinder.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Wall ErrorFree Gap Polygons.
From Forceshade Require Import CylinderForce CylinderFirst CylinderOutside.
Open Scope R_scope.

Lemma distance_squared : forall Rad w X Z, let L := Z + axis_depth Rad w in let rho := distance_from_axis Rad w X Z in
  0 <= rho /\ rho * rho = X * X + L * L.
Proof. intros Rad w X Z L rho. split; [apply sqrt_pos|]. apply sqrt_sqrt. nra. Qed.

(* Inside, but at the one z next to -d. *)
Lemma cylinder_inside : forall is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> coordinate xv X -> coordinate zv Z ->
  let first := cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis xv zv in
  let v := cylinder_v is_fused anchor anchored rest d_head d_tail xv zv in
  let least := multiply_add is_fused (absolute zv) (times (two_to (-25)) d_head) (times (two_to (-50)) anchor) in
  distance_from_axis (value32 R) (value32 w) X Z < value32 R -> is_less (absolute v) least = false ->
  first_contact first = true /\ (Z <> value64 axis ->
    good 18 (first_x first) (cylinder_x (value32 R) (value32 w) (value32 K) X Z) /\
    computes (first_z first) (33 / 2) (cylinder_z (value32 R) (value32 w) (value32 K) X Z) (-122) 117).
Proof.
  intros is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z Hp Hd Hx Hz first v least Hin Hclear.
  destruct (distance_squared (value32 R) (value32 w) X Z) as [Hrho0 Hrho2]. unfold cylinder_x, cylinder_z. cbv zeta.
  rewrite !Rlt_bool_true by assumption. set (rho := distance_from_axis _ _ X Z) in *.
  set (L := Z + axis_depth (value32 R) (value32 w)) in *.
  assert (HV : 0 < value32 R * value32 R - (X * X + L * L)) by nra.
  destruct (cylinder_v_is_near is_fused R w K _ _ _ _ _ _ _ X _ Z Hp Hd Hx Hz HV Hclear) as [Nv Bv]. fold L in Nv, Bv. split.
  - change (first_contact first) with (is_less zero64 v). unfold v. destruct Nv as (y & Iv & Ny & _).
    rewrite (less_is _ _ _ _ zero_is Iv).
    apply Rlt_bool_true. now apply (near_sign _ _ _ Ny).
  - intro Hne. pose proof (cylinder_l_is_near R w K _ _ _ _ _ _ _ Z Hp Hd Hz Hne) as Nl. cbv zeta in Nl. fold L in Nl.
    assert (HL : L <> 0) by (destruct Nl as (y & _ & _ & S); now apply (size_not_0 _ _ _ S)).
    rewrite Req_bool_false by nra. rewrite <- Hrho2 in Nv, Bv.
    assert (Erho : sqrt (X * X + L * L) = rho) by reflexivity.
    pose proof (cylinder_force_is_near is_fused R w K anchor anchored rest d_head d_tail axis _ X zv L Hp Hx) as F.
    cbv zeta in F. rewrite Erho in F. exact (proj2 (F Nv Bv Nl)).
Qed.

(* Every answer of the first stage of cylinder is right, for every input of the domain, given what the law holds of its depth. *)
Theorem cylinder_first_stage_answers_right :
  forall is_fused R w K anchor anchored rest d_head d_tail axis later x y z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  right_or_later
    (evaluate cylinder_window (cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis) later x y z)
    (later (quantised x) (quantised z)) (distance_from_axis (value32 R) (value32 w) X Z < value32 R)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z) (cylinder_z (value32 R) (value32 w) (value32 K) X Z).
Proof.
  intros is_fused R w K anchor anchored rest d_head d_tail axis later x y z Hp Hd Hv X Z.
  destruct (valid_coordinates _ _ _ Hv) as [Hx Hz]. fold X in Hx. fold Z in Hz.
  apply (right_first_stage_gives_right_answers 18); [lia|assumption|]. unfold is_right. intro Hclear.
  unfold cylinder in Hclear. cbv zeta in Hclear. cbn [first_doubt] in Hclear. apply orb_false_elim in Hclear.
  destruct Hclear as [C1 C2].
  destruct (Rlt_or_le (distance_from_axis (value32 R) (value32 w) X Z) (value32 R)) as [Hin|Hout].
  - assert (Hne : Z <> value64 axis).
    { destruct Hd as [(_ & _ & _ & _ & Fa) _ _ _ _ _ _ _ _]. rewrite (equal_is _ _ _ _ (coordinate_is _ _ Hz) (conj eq_refl Fa)) in C2.
      revert C2. case Req_bool_spec; [discriminate|trivial]. }
    destruct (cylinder_inside is_fused R w K _ _ _ _ _ _ _ X _ Z Hp Hd Hx Hz Hin C1) as [T1 T2]. destruct (T2 Hne) as [Fx Fz].
    split; [split; [trivial|intros _; exact T1]|]. intros _. split; [exact Fx|].
    refine (computed_is_good 18 _ _ _ _ _ Fz _ _ _ _); try lra; lia.
  - destruct (distance_squared (value32 R) (value32 w) X Z) as [Hrho0 Hrho2]. pose proof Hp as (_ & HR & _).
    destruct (cylinder_v_is_not_positive is_fused R w K _ _ _ _ _ _ _ X _ Z Hp Hd Hx Hz ltac:(clear -Hout Hrho0 Hrho2 HR;
      nra) C1) as (v & Iv & Hneg & _).
    split; [|intro; lra]. set (xv := to64 (quantised x)) in *. set (zv := to64 (quantised z)) in *.
    change (first_contact (cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis xv zv)) with
      (is_less zero64 (cylinder_v is_fused anchor anchored rest d_head d_tail xv zv)).
    rewrite (less_is _ _ _ _ zero_is Iv), Rlt_bool_false by assumption. split; [discriminate|lra].
Qed.

(* ---- bump-cylinder: the wall's force added ---- *)

Lemma size_rounded : forall l h a, size l h a -> (-1000 <= l)%Z -> (-1000 <= h)%Z -> size l h (nearest64 a).
Proof.
  intros l h a [H1 H2] Hl Hh. split.
  - apply abs_round_ge_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia.
  - apply abs_round_le_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia.
Qed.

Lemma zero_times : forall u v b, is64 u 0 -> is64 v b -> is64 (times u v) 0.
Proof.
  intros u v b Hu Hv. rewrite <- (round_0 radix2 fexp64 ZnearestE). rewrite <- (Rmult_0_l b) at 1. apply times_is; try assumption.
  rewrite Rmult_0_l, Rabs_R0. apply bpow_ge_0.
Qed.

Lemma square_within : forall a b, - b <= a <= b -> 0 <= a * a <= b * b.
Proof. intros a b H. split; nra. Qed.

Lemma product_within : forall u v a b, - a <= u <= a -> - b <= v <= b -> - (a * b) <= u * v <= a * b.
Proof.
  intros u v a b Hu Hv. apply Rabs_le_inv. rewrite Rabs_mult. apply Rabs_le in Hu. apply Rabs_le in Hv.
  apply Rmult_le_compat; try assumption; apply Rabs_pos.
Qed.

(* Outside of the cylinder its part of the force is 0. *)
Lemma no_cylinder_force : forall is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> coordinate xv X -> coordinate zv Z ->
  let first := cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis xv zv in
  let L := Z + axis_depth (value32 R) (value32 w) in
  value32 R * value32 R <= X * X + L * L ->
  (exists v, is64 (cylinder_v is_fused anchor anchored rest d_head d_tail xv zv) v /\ v <= 0 /\ Rabs v <= bpow radix2 40) ->
  is64 (first_x first) 0 /\ is64 (first_z first) 0.
Proof.
  intros is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z Hp Hd Hx Hz first L Hout (v & Iv & Hneg & Rv).
  destruct Hp as ((FR & _ & FK) & HR & Hw & HK). destruct Hd as [(_ & _ & Fh & Ft & _) _ _ _ _ Rh Rt Re _].
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  set (Rad := value32 R) in *. set (d := axis_depth Rad _) in *. set (dh := value64 d_head) in *. set (dt := value64 d_tail) in *.
  assert (Ih : is64 d_head dh) by now split. assert (It : is64 d_tail dt) by now split.
  destruct Hx as [Hx Fx Rx _]. destruct Hz as [Hz _ Rz _]. pose proof tiny_is_tiny as Htiny.
  assert (big : forall a e, Rabs a <= bpow radix2 e -> (e <= 1000)%Z -> Rabs a <= bpow radix2 1000).
  { intros a e Ha He. apply Rle_trans with (1 := Ha). now apply bpow_le. }
  assert (big2 : forall a, Rabs a <= 10000000000 -> Rabs a <= bpow radix2 1000).
  { intros a Ha. apply (big a 40%Z); [simpl; lra|lia]. }
  (* l *)
  assert (HdR : d <= Rad) by (clear -Hd0 Hd2 HR; nra). apply Rabs_le_inv in Rz. apply Rabs_le_inv in Rt. apply Rabs_le_inv in Re.
  assert (Rdt : -1 <= dt <= 1) by (unfold tail_share in Rt; lra).
  assert (Rl1 : Rabs (Z + dh) <= 20001) by (apply Rabs_le; lra).
  set (l1 := nearest64 (Z + dh)). pose proof (rounded_within _ _ Rl1) as E1. fold l1 in E1. apply Rabs_le_inv in E1.
  pose proof (plus_is _ _ _ _ Hz Ih ltac:(apply big2; lra)) as I1. fold l1 in I1. apply Rabs_le_inv in Rl1.
  assert (Rl : Rabs (l1 + dt) <= 20003) by (apply Rabs_le; unfold unit53 in *; lra).
  set (l := nearest64 (l1 + dt)). pose proof (rounded_within _ _ Rl) as E2. fold l in E2. apply Rabs_le_inv in E2.
  pose proof (plus_is _ _ _ _ I1 It ltac:(apply big2; lra)) as Il. fold l in Il.
  assert (HL : - / 1000000000 <= l - L <= / 1000000000) by (unfold L, slope_share, unit53 in *; lra).
  assert (BL : -20001 <= L <= 20001) by (unfold L; lra).
  assert (HQ : / 100 <= Rad * Rad <= 100000000) by (clear -HR; nra).
  pose proof (square_within X 10000 (Rabs_le_inv _ _ Rx)) as HXX.
  assert (Hll : L * L - / 1000 <= l * l <= 500000000).
  { assert (E : l * l = L * L + (l - L) * (l + L)) by ring. assert (Hsum : -40003 <= l + L <= 40003) by lra.
    pose proof (product_within _ _ (/ 1000000000) 40003 HL Hsum). pose proof (square_within L 20001 BL). rewrite E. lra. }
  (* rho *)
  set (ll := nearest64 (l * l)).
  assert (Ell : Rabs (ll - l * l) <= / 1000000).
  { apply Rle_trans with (unit53 * 500000000 + tiny); [|unfold unit53; lra]. apply rounded_within.
    rewrite Rabs_pos_eq by (apply Rle_0_sqr). lra. }
  apply Rabs_le_inv in Ell. pose proof (times_is _ _ _ _ Il Il ltac:(apply big2; rewrite Rabs_pos_eq by (apply Rle_0_sqr);
    lra)) as Ill. fold ll in Ill.
  assert (Gxx : in_binary64 (X * X)) by now apply product_is_binary64.
  assert (Ss : size (2 * -4) (2 * 15) (X * X + ll)) by (apply size_of; simpl; lra).
  pose proof (multiply_add_is is_fused _ _ _ _ _ _ Hx Hx Ill Gxx ltac:(apply big2; rewrite Rabs_pos_eq; lra)
                ltac:(apply (big _ _ (proj2 Ss)); lia)) as Is.
  pose proof (size_rounded _ _ _ Ss ltac:(lia) ltac:(lia)) as Ss2.
  assert (Hpos : 0 <= nearest64 (X * X + ll)).
  { rewrite <- (round_0 radix2 fexp64 ZnearestE). apply round_le; auto with typeclass_instances. lra. }
  pose proof (square_root_is _ _ Is Hpos) as Ir.
  pose proof (size_rounded _ _ _ (size_root _ _ _ Ss2 Hpos) ltac:(lia) ltac:(lia)) as Sr.
  set (r := nearest64 (sqrt _)) in *.
  assert (Hr : 0 <= r).
  { rewrite <- (round_0 radix2 fexp64 ZnearestE). apply round_le; auto with typeclass_instances. apply sqrt_pos. }
  assert (Srr : size (-4) 16 (Rad + r)).
  { destruct Sr as [S1 S2]. change (bpow radix2 (-4)) with (/ 16) in *. change (bpow radix2 15) with 32768 in *.
    rewrite Rabs_pos_eq in S1, S2 by assumption.
    apply size_of; change (bpow radix2 (-4)) with (/ 16); change (bpow radix2 16) with 65536; lra. }
  assert (IR : is64 (to64 R) Rad) by now apply to64_is_exact.
  pose proof (plus_is _ _ _ _ IR Ir ltac:(apply (big _ _ (proj2 Srr)); lia)) as Irr.
  pose proof (size_times _ _ _ _ _ _ (size_rounded _ _ _ Srr ltac:(lia) ltac:(lia)) Sr) as Sd.
  pose proof (times_is _ _ _ _ Irr Ir ltac:(apply (big _ _ (proj2 Sd)); lia)) as Id.
  pose proof (size_not_0 _ _ _ (size_rounded _ _ _ Sd ltac:(lia) ltac:(lia))) as Dne.
  (* K v, and what it is divided by *)
  assert (IK : is64 (to64 K) (value32 K)) by now apply to64_is_exact.
  assert (Bkv : Rabs (value32 K * v) <= bpow radix2 (10 + 40)).
  { rewrite Rabs_mult, bpow_plus. apply Rmult_le_compat; try apply Rabs_pos; [|assumption]. rewrite Rabs_pos_eq by lra. simpl. lra. }
  pose proof (larger_is _ _ _ _ (times_is _ _ _ _ IK Iv ltac:(apply (big _ _ Bkv); lia)) zero_is) as Iu.
  rewrite Rmax_right in Iu.
  2: { rewrite <- (round_0 radix2 fexp64 ZnearestE). apply round_le; auto with typeclass_instances. clear -HK Hneg. nra. }
  pose proof (over_is _ _ _ _ Iu Id Dne ltac:(unfold Rdiv; rewrite Rmult_0_l, Rabs_R0; apply bpow_ge_0)) as Is0.
  unfold Rdiv in Is0. rewrite Rmult_0_l, round_0 in Is0 by auto with typeclass_instances.
  split; [exact (zero_times _ _ _ Is0 Hx)|exact (zero_times _ _ _ Is0 Il)].
Qed.

(* Every answer of the first stage of bump-cylinder is right, for every input of the domain, given the same. *)
Theorem bump_cylinder_first_stage_answers_right :
  forall is_fused R w K anchor anchored rest d_head d_tail axis later x y z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  right_or_later
    (evaluate bump_cylinder_window (bump_cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis) later x y z)
    (later (quantised x) (quantised z)) (distance_from_axis (value32 R) (value32 w) X Z < value32 R \/ Z < 0)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z)
    (cylinder_z (value32 R) (value32 w) (value32 K) X Z + Rmax (- value32 K * Z) 0).
Proof.
  intros is_fused R w K anchor anchored rest d_head d_tail axis later x y z Hp Hd Hv X Z.
  destruct (valid_coordinates _ _ _ Hv) as [Hx Hz]. fold X in Hx. fold Z in Hz. pose proof Hp as ((_ & _ & FK) & HR & Hw & HK).
  apply (right_first_stage_gives_right_answers 18); [lia|assumption|]. unfold is_right. intro Hclear.
  set (xv := to64 (quantised x)) in *. set (zv := to64 (quantised z)) in *.
  set (first := cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis xv zv).
  set (wall := larger (times (opp (to64 K)) zv) zero64).
  assert (Iw : is64 wall (Rmax (- value32 K * Z) 0)) by now apply wall_force_is.
  set (W := Rmax (- value32 K * Z) 0) in *. assert (HW : 0 <= W) by apply Rmax_r.
  assert (BW : W <= 10000000).
  { apply Rmax_lub; [|lra]. pose proof (coordinate_range _ _ Hz) as Rz. apply Rabs_le_inv in Rz. clear -Rz HK. nra. }
  change (first_x (bump_cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis xv zv)) with (first_x first).
  change (first_z (bump_cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis xv zv)) with
    (plus (first_z first) wall).
  change (first_contact (bump_cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis xv zv)) with
    (orb (first_contact first) (is_less zv zero64)).
  change (first_doubt (bump_cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis xv zv)) with
    (orb (is_less (absolute (cylinder_v is_fused anchor anchored rest d_head d_tail xv zv))
       (multiply_add is_fused (absolute zv) (times (two_to (-25)) d_head) (times (two_to (-50)) anchor)))
       (andb (first_contact first) (is_at_most zv axis))) in Hclear.
  apply orb_false_elim in Hclear. destruct Hclear as [C1 C2].
  rewrite (less_is _ _ _ _ (coordinate_is _ _ Hz) zero_is).
  destruct (Rlt_or_le (distance_from_axis (value32 R) (value32 w) X Z) (value32 R)) as [Hin|Hout].
  - destruct (cylinder_inside is_fused R w K _ _ _ _ _ _ _ X _ Z Hp Hd Hx Hz Hin C1) as [T1 T2]. fold first in T1, T2.
    rewrite T1 in *. cbn [andb orb] in C2 |- *.
    assert (Habove : value64 axis < Z).
    { destruct Hd as [(_ & _ & _ & _ & Fa) _ _ _ _ _ _ _ _].
      rewrite (at_most_is _ _ _ _ (coordinate_is _ _ Hz) (conj eq_refl Fa)) in C2.
      revert C2. case Rle_bool_spec; [discriminate|trivial]. }
    destruct (T2 ltac:(lra)) as [Fx (f & If & Nf & Sf)]. split; [split; [now left|reflexivity]|]. intros _. split; [exact Fx|].
    set (F := cylinder_z _ _ _ X Z) in *.
    assert (HF : 0 < F).
    { assert (0 <= F); [|destruct (Req_dec F 0) as [E|]; [now apply (size_not_0 _ _ _ Sf) in E|lra]].
      destruct (depth_axis _ _ _ _ _ _ _ _ Hd Z (coordinate_format _ _ Hz) (coordinate_not_tiny _ _ Hz) ltac:(lra)) as (_ & _ & HL).
      specialize (HL Habove).
      destruct (distance_squared (value32 R) (value32 w) X Z) as [Hrho0 _].
      unfold F, cylinder_z. cbv zeta. rewrite Rlt_bool_true by assumption. set (rho := distance_from_axis _ _ X Z) in *.
      apply Rmult_le_pos; [apply Rmult_le_pos; lra|]. case Req_bool_spec; intro H0; [lra|]. unfold Rdiv.
      apply Rmult_le_pos; [lra|]. apply Rlt_le, Rinv_0_lt_compat. lra. }
    pose proof (near_sum_with_positive _ W _ _ Nf ltac:(lra) HW HF) as N. rewrite (Rplus_comm W f), (Rplus_comm W F) in N.
    assert (S : size (-122) 118 (F + W)).
    { destruct Sf as [S1 S2]. rewrite Rabs_pos_eq in S1, S2 by lra. apply size_of; [lra|].
      replace (bpow radix2 118) with (bpow radix2 117 + bpow radix2 117).
      - apply Rplus_le_compat; [assumption|]. apply Rle_trans with (bpow radix2 30); [simpl; lra|apply bpow_le; lia].
      - change 118%Z with (1 + 117)%Z. rewrite bpow_plus. change (bpow radix2 1) with 2. ring. }
    assert (C : computes (plus (first_z first) wall) (one + 33 / 2 * (101 / 100)) (F + W) (-122) 118).
    { exists (nearest64 (f + W)). split; [|split; [|exact S]].
      - apply plus_is; try assumption. pose proof (size_near _ _ _ _ _ S N ltac:(lra)) as S2.
        apply Rle_trans with (1 := proj2 S2). apply bpow_le. lia.
      - apply near_then with (f + W); [|exact N]. apply sum_is_near; [now apply format_of in If|now apply format_of in Iw]. }
    refine (computed_is_good 18 _ _ _ _ _ C _ _ _ _); unfold one; try lra; lia.
  - destruct (distance_squared (value32 R) (value32 w) X Z) as [Hrho0 Hrho2].
    destruct (cylinder_v_is_not_positive is_fused R w K _ _ _ _ _ _ _ X _ Z Hp Hd Hx Hz ltac:(clear -Hout Hrho0 Hrho2 HR;
      nra) C1) as (v & Iv & Hneg & Rv).
    assert (T1 : first_contact first = false).
    { change (first_contact first) with (is_less zero64 (cylinder_v is_fused anchor anchored rest d_head d_tail xv zv)).
      rewrite (less_is _ _ _ _ zero_is Iv). now apply Rlt_bool_false. }
    rewrite T1. cbn [orb]. unfold cylinder_x, cylinder_z. cbv zeta. rewrite (Rlt_bool_false _ _ Hout). split.
    { case Rlt_bool_spec; intro H; split; intro G; try reflexivity; try discriminate; [now right|]. destruct G; lra. }
    intros [G|G]; [lra|].
    destruct (no_cylinder_force is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z Hp Hd Hx Hz
      ltac:(clear -Hout Hrho0 Hrho2 HR; nra)) as [I1 I2].
    { now exists v. }
    split; [now apply zero_is_good|]. rewrite Rplus_0_l. apply exact_is_good; [lia| | |].
    + rewrite <- (round_generic radix2 fexp64 ZnearestE W) by now apply format_of in Iw. rewrite <- (Rplus_0_l W).
      apply plus_is; try assumption. rewrite Rplus_0_l, Rabs_pos_eq by assumption.
      apply Rle_trans with (bpow radix2 30); [simpl; lra|apply bpow_le; lia].
    + right. unfold W. rewrite Rmax_left by (clear -G HK; nra). destruct Hz as [_ _ _ [->|[Sz _]]]; [lra|].
      rewrite Rabs_mult, Rabs_Ropp, (Rabs_pos_eq (value32 K)) by lra.
      apply Rle_trans with (bpow radix2 (-10 + -30)); [apply bpow_le; lia|].
      rewrite bpow_plus. apply Rmult_le_compat; try apply bpow_ge_0; [simpl; lra|assumption].
    + rewrite Rabs_pos_eq by assumption. apply Rle_lt_trans with (bpow radix2 30); [simpl; lra|now apply bpow_lt].
Qed.
