(* SPDX-License-Identifier: BSD-3-Clause *)
(* Force shading in binary64, fast/laws/shading.h, and the first stage of bump-1p-shaded. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs.
Open Scope R_scope.

(* Shading::K_over_R. *)
Definition K_over_R (K R : binary32) : binary64 := over (to64 K) (to64 R).

(* What the root is taken of may be 0, at the edge of a half cylinder. *)
Lemma shading_root : forall R w K xv X, parameters R w K -> coordinate xv X -> Rabs X <= value32 R ->
  let root := square_root (times (minus (to64 R) xv) (plus (to64 R) xv)) in
  let exact := (value32 R - X) * (value32 R + X) in
  0 <= exact /\ (exact = 0 -> is64 root 0) /\ (exact <> 0 -> computes root (5 / 2 * one) (sqrt exact) (-29) 15).
Proof.
  intros R w K xv X ((FR & _) & HR & _) Hx HX root exact. destruct (to64_is_exact R FR) as [RV RF].
    pose proof (conj RV RF : is64 _ _) as HRv.
  destruct Hx as [Hx Fx Rx Sx]. apply Rabs_le_inv in HX. assert (Hpos : 0 <= exact) by (unfold exact; apply Rmult_le_pos; lra).
  split; [assumption|]. pose proof (format_of _ _ Hx) as Gx. pose proof (format_of _ _ HRv) as GR.
  assert (Hbig : Rabs (bpow radix2 15) <= bpow radix2 1000) by (rewrite Rabs_pos_eq by apply bpow_ge_0; apply bpow_le; lia).
  rewrite Rabs_pos_eq in Hbig by apply bpow_ge_0. change (bpow radix2 15) with 32768 in Hbig.
  assert (Hminus : is64 (minus (to64 R) xv) (nearest64 (value32 R - X))) by (apply minus_is; try assumption; apply Rabs_le; lra).
  assert (Hplus : is64 (plus (to64 R) xv) (nearest64 (value32 R + X))) by (apply plus_is; try assumption; apply Rabs_le; lra).
  assert (Nminus : near one (nearest64 (value32 R - X)) (value32 R - X)) by (apply sum_is_near; [assumption|now apply generic_format_opp]).
  assert (Nplus : near one (nearest64 (value32 R + X)) (value32 R + X)) by now apply sum_is_near.
  split.
  - intro H0. unfold root. replace 0 with (nearest64 (sqrt 0)) by (rewrite sqrt_0; apply round_0; auto with typeclass_instances).
    apply square_root_is; [|apply Rle_refl].
    assert (Hp : nearest64 (value32 R - X) * nearest64 (value32 R + X) = 0).
    { apply Rmult_integral in H0. destruct (near_sign _ _ _ Nminus) as (_ & _ & Z1), (near_sign _ _ _ Nplus) as (_ & _ & Z2).
      destruct H0 as [H0|H0]; [rewrite (Z1 H0)|rewrite (Z2 H0)]; ring. }
    replace 0 with (nearest64 (nearest64 (value32 R - X) * nearest64 (value32 R + X)))
      by (rewrite Hp; apply round_0; auto with typeclass_instances).
    apply times_is; try assumption. rewrite Hp, Rabs_R0. apply bpow_ge_0.
  - intro Hne. assert (HR30 : value32 R = 0 \/ bpow radix2 (-30) <= Rabs (value32 R)).
    { right. rewrite Rabs_pos_eq by lra. simpl. lra. }
    assert (HX30 : X = 0 \/ bpow radix2 (-30) <= Rabs X) by (destruct Sx as [|[S _]]; [now left|now right]).
    assert (Dminus : bpow radix2 (-53) <= value32 R - X).
    { rewrite <- (Rabs_pos_eq (value32 R - X)) by lra. apply difference_is_not_tiny; try assumption; [apply (generic_format_B2R 24 128)|].
      intro H0. apply Hne. unfold exact. rewrite H0. ring. }
    assert (Dplus : bpow radix2 (-53) <= value32 R + X).
    { rewrite <- (Rabs_pos_eq (value32 R + X)) by lra. replace (value32 R + X) with (value32 R - - X) by ring.
      apply difference_is_not_tiny; try assumption; [apply (generic_format_B2R 24 128)|now apply generic_format_opp| |].
      - destruct HX30 as [->|H]; [left; ring|right; now rewrite Rabs_Ropp].
      - intro H0. apply Hne. unfold exact. replace (value32 R + X) with (value32 R - - X) by ring. rewrite H0. ring. }
    assert (C1 : computes (minus (to64 R) xv) one (value32 R - X) (-53) 15).
    { exists (nearest64 (value32 R - X)). split; [assumption|]. split; [assumption|]. apply size_of; [assumption|]. simpl. lra. }
    assert (C2 : computes (plus (to64 R) xv) one (value32 R + X) (-53) 15).
    { exists (nearest64 (value32 R + X)). split; [assumption|]. split; [assumption|]. apply size_of; [assumption|]. simpl. lra. }
    assert (H1 : 0 <= one <= 2) by (unfold one; lra).
    destruct (computes_times _ _ _ _ _ _ _ _ _ _ C1 C2 ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as (p & P1 & P2 & _).
    apply computes_more with ((one + one + one) / 2 + one) (-29)%Z 15%Z; try lia; [|lra].
    apply computes_root; [|unfold exact in *; lra|lra|lia].
    exists p. split; [assumption|]. split; [assumption|]. fold exact. apply size_of.
    + assert (Hmul : forall a b, bpow radix2 (-53) <= a -> bpow radix2 (-5) <= b -> bpow radix2 (2 * -29) <= a * b).
      { intros a b Ha Hb. replace (2 * -29)%Z with (-53 + -5)%Z by reflexivity. rewrite bpow_plus.
        apply Rmult_le_compat; try apply bpow_ge_0; assumption. }
      unfold exact. destruct (Rle_lt_dec 0 X).
      * apply Hmul; [assumption|]. simpl. lra.
      * rewrite Rmult_comm. apply Hmul; [assumption|]. simpl. lra.
    + replace (2 * 15)%Z with (15 + 15)%Z by reflexivity. rewrite bpow_plus.
      unfold exact. apply Rmult_le_compat; try lra; simpl; lra.
Qed.

(* gap n units off; F_x = gap (K/R) x, F_z = gap (K/R) sqrt((R - x)(R + x)). *)
Lemma shaded_force : forall k R w K xv X gap n G, parameters R w K -> coordinate xv X -> Rabs X <= value32 R ->
  computes gap n G (-66) 15 -> 0 <= n <= 10 -> (n + 11 / 2 * one) * (1001 / 1000) <= IZR k ->
  let scale := times gap (K_over_R K R) in
  good k (times scale xv) (G * (value32 K / value32 R) * X) /\
  good k (times scale (square_root (times (minus (to64 R) xv) (plus (to64 R) xv))))
    (G * (value32 K / value32 R) * sqrt ((value32 R - X) * (value32 R + X))).
Proof.
  intros k R w K xv X gap n G Hp Hx HX Hgap Hn Hk scale.
  destruct (shading_root R w K xv X Hp Hx HX) as (Hpos & Hzero & Hroot). cbv zeta in Hpos, Hzero, Hroot.
  destruct Hp as ((FR & _ & FK) & HR & _ & HK). destruct Hx as [Hx _ Rx Sx].
  assert (H1 : 1 <= one <= 11 / 10) by (unfold one; lra).
  assert (CK : computes (to64 K) 0 (value32 K) (-10) 10) by (apply exactly; [now apply to64_is_exact|now apply size_of_stiffness]).
  assert (CR : computes (to64 R) 0 (value32 R) (-4) 14) by (apply exactly; [now apply to64_is_exact|now apply size_of_radius]).
  pose proof (computes_over _ _ _ _ _ _ _ _ _ _ CK CR ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as CKR. fold (K_over_R K R) in CKR.
  pose proof (computes_times _ _ _ _ _ _ _ _ _ _ Hgap CKR ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as CS. fold scale in CS.
  assert (Hnull : forall v, is64 v 0 -> is64 (times scale v) 0).
  { intros v Hv. destruct CS as (s & Hs & _). replace 0 with (nearest64 (s * 0)) by (rewrite Rmult_0_r; apply round_0;
    auto with typeclass_instances).
    apply times_is; try assumption. rewrite Rmult_0_r, Rabs_R0. apply bpow_ge_0. }
  split.
  - destruct Sx as [->|Sx].
    + rewrite Rmult_0_r. now apply zero_is_good, Hnull.
    + pose proof (computes_times _ _ _ _ _ _ _ _ _ _ CS (exactly _ _ _ _ Hx Sx) ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as C.
      apply (computed_is_good k _ _ _ _ _ C); try lra; lia.
  - destruct (Req_dec ((value32 R - X) * (value32 R + X)) 0) as [H0|Hne].
    + rewrite H0, sqrt_0, Rmult_0_r. now apply zero_is_good, Hnull, Hzero.
    + pose proof (computes_times _ _ _ _ _ _ _ _ _ _ CS (Hroot Hne) ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as C.
      apply (computed_is_good k _ _ _ _ _ C); try lra; lia.
Qed.

Lemma shaded_force_is : forall Rad w K X M, 0 < Rad -> w <= 2 * Rad ->
  let s := if Rle_bool (Rabs X) (w / 2) then X else 0 in
  M * (K / Rad) * s = shaded_x Rad w K X M /\ M * (K / Rad) * sqrt ((Rad - s) * (Rad + s)) = shaded_z Rad w K X M.
Proof.
  intros Rad w K X M HR Hw s. unfold shaded_x, shaded_z, s. destruct (Rle_bool (Rabs X) (w / 2)); split; try (field; lra).
  - replace ((Rad - X) * (Rad + X)) with (Rsqr Rad - Rsqr X) by (unfold Rsqr; ring). field. lra.
  - replace ((Rad - 0) * (Rad + 0)) with (Rad * Rad) by ring. rewrite sqrt_square by lra. field. lra.
Qed.

(* shaded_x of first_stage: x over the bump, else 0. *)
Lemma shaded_coordinate : forall R w K xv X, parameters R w K -> coordinate xv X ->
  let inside := is_at_most (absolute xv) (half_width w) in
  let S := if Rle_bool (Rabs X) (value32 w / 2) then X else 0 in
  inside = Rle_bool (Rabs X) (value32 w / 2) /\ coordinate (if inside then xv else zero64) S /\ Rabs S <= value32 R.
Proof.
  intros R w K xv X Hp Hx inside S. pose proof (half_width_is _ _ _ Hp) as Hw. destruct Hp as (_ & HR & Hw2 & _).
  assert (E : inside = Rle_bool (Rabs X) (value32 w / 2)).
  { apply at_most_is; [|assumption]. apply absolute_is, Hx. }
  split; [assumption|]. rewrite E. unfold S. case Rle_bool_spec; intro H.
  - split; [assumption|lra].
  - split; [|rewrite Rabs_R0; lra]. split; [apply zero_is|apply generic_format_0|rewrite Rabs_R0; lra|now left].
Qed.

Definition bump_1p_shaded_of (R w K : binary32) (is_fused : bool) : binary64 -> binary64 -> FirstStage :=
  bump_1p_shaded is_fused (to64 R) (K_over_R K R) (half_width w).

Lemma bump_1p_shaded_is_right : forall is_fused R w K xv X zv Z, parameters R w K -> coordinate xv X -> coordinate zv Z ->
  is_right 8 (bump_1p_shaded_of R w K is_fused xv zv) (Z < 0)
    (shaded_x (value32 R) (value32 w) (value32 K) X (- Z)) (shaded_z (value32 R) (value32 w) (value32 K) X (- Z)).
Proof.
  intros is_fused R w K xv X zv Z Hp Hx Hz _. unfold bump_1p_shaded_of, bump_1p_shaded. cbv zeta. cbn [first_x first_z first_contact].
  destruct (shaded_coordinate _ _ _ _ _ Hp Hx) as (_ & Hs & HS). cbv zeta in Hs, HS.
  destruct Hz as [Hz _ Rz Sz]. rewrite (less_is _ _ _ _ Hz zero_is). split.
  { case Rlt_bool_spec; intro H; split; intro G; try reflexivity; try discriminate; lra. }
  intro Hneg. pose proof Hp as (_ & HR & Hw & _).
  destruct (shaded_force_is (value32 R) (value32 w) (value32 K) X (- Z) ltac:(lra) ltac:(lra)) as [<- <-].
  refine (shaded_force 8 R w K _ _ _ 0 (- Z) Hp Hs HS _ ltac:(lra) _); [|unfold one; lra].
  destruct Sz as [->|Sz]; [lra|]. apply computes_more with 0 (-30)%Z 14%Z; try lia; [|lra].
  apply exactly.
  - rewrite <- (Rmax_left (- Z) 0) by lra. apply larger_is; [now apply opp_is|apply zero_is].
  - unfold size in *. now rewrite Rabs_Ropp.
Qed.

(* Every answer of the first stage of bump-1p-shaded is right, for every input of the domain. *)
Theorem bump_1p_shaded_first_stage_answers_right : forall is_fused R w K later x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  right_or_later (evaluate bump_1p_shaded_window (bump_1p_shaded_of R w K is_fused) later x y z) (later (quantised x) (quantised z))
    (Z < 0) (shaded_x (value32 R) (value32 w) (value32 K) X (- Z)) (shaded_z (value32 R) (value32 w) (value32 K) X (- Z)).
Proof.
  intros is_fused R w K later x y z Hp Hv X Z. destruct (valid_coordinates _ _ _ Hv) as [Hx Hz].
  apply (right_first_stage_gives_right_answers 8); [lia|assumption|]. now apply bump_1p_shaded_is_right.
Qed.
