(* SPDX-License-Identifier: BSD-3-Clause *)
(* The placement of a surface in a device's workspace by quarter turns and a shift: include/forceshade/placement.h. It rotates, a force
   that was the nearest binary32 stays the nearest, and it gives or takes no power. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Laws.
Open Scope R_scope.

Inductive axis := axis_x | axis_y | axis_z.
Definition is_same (a b : axis) : bool :=
  match a, b with axis_x, axis_x | axis_y, axis_y | axis_z, axis_z => true | _, _ => false end.
(* (a + 1) % 3 *)
Definition following (a : axis) : axis := match a with axis_x => axis_y | axis_y => axis_z | axis_z => axis_x end.

(* Three numbers, or three directions: one for each axis of the subject. *)
Definition triple (A : Type) : Type := A * A * A.
Definition at_axis {A} (v : triple A) (a : axis) : A :=
  let '(x, y, z) := v in match a with axis_x => x | axis_y => y | axis_z => z end.
Definition put {A} (v : triple A) (a : axis) (new : A) : triple A :=
  let '(x, y, z) := v in match a with axis_x => (new, y, z) | axis_y => (x, new, z) | axis_z => (x, y, new) end.
Definition each {A B} (f : A -> B) (v : triple A) : triple B := let '(x, y, z) := v in (f x, f y, f z).

(* An axis of the device, and whether against it. *)
Definition direction : Type := axis * bool.
Definition own_axes : triple direction := ((axis_x, false), (axis_y, false), (axis_z, false)).

(* turned(about, 1) *)
Definition turned (about : axis) : triple direction -> triple direction :=
  let from := following about in let to := following from in
  each (fun d => if is_same (fst d) from then (to, snd d) else if is_same (fst d) to then (from, negb (snd d)) else d).
(* The axes that any turns give. *)
Inductive placed : triple direction -> Prop :=
| unturned : placed own_axes
| turned_more : forall about axes, placed axes -> placed (turned about axes).

Section Numbers.
Context {A : Type} (opposite : A -> A).

(* along() *)
Definition along_direction (v : triple A) (d : direction) : A := if snd d then opposite (at_axis v (fst d)) else at_axis v (fst d).
Definition turned_to_subject (axes : triple direction) (v : triple A) : triple A := each (along_direction v) axes.
(* The loop writes into `before`, which holds anything. *)
Definition turned_to_device (axes : triple direction) (before v : triple A) : triple A :=
  let '(d, e, f) := axes in let '(x, y, z) := v in
  let signed (d : direction) (a : A) := if snd d then opposite a else a in
  put (put (put before (fst d) (signed d x)) (fst e) (signed e y)) (fst f) (signed f z).
End Numbers.

(* 0 - x, and the difference from the origin. *)
Definition minus32 (a b : binary32) : binary32 := b32_minus mode_NE a b.
Definition opposite32 (a : binary32) : binary32 := minus32 zero32 a.
Definition to_subject (axes : triple direction) (origin position : triple binary32) : triple binary32 :=
  let '(x, y, z) := position in let '(a, b, c) := origin in
  turned_to_subject opposite32 axes (minus32 x a, minus32 y b, minus32 z c).

(* ---- Turns ---- *)

(* Three different axes, and the third is the cross product of the others: no mirror image. *)
Definition is_rotation (axes : triple direction) : bool :=
  let '(d, e, f) := axes in
  negb (is_same (fst d) (fst e)) && negb (is_same (fst e) (fst f)) && negb (is_same (fst f) (fst d)) &&
  eqb (xorb (xorb (snd d) (snd e)) (snd f)) (negb (is_same (following (fst d)) (fst e))).

Lemma turn_rotates : forall about axes, is_rotation axes = true -> is_rotation (turned about axes) = true.
Proof. intros about [[[[] []] [[] []]] [[] []]] H; try discriminate H; now destruct about. Qed.

Theorem placed_is_rotation : forall axes, placed axes -> is_rotation axes = true.
Proof. intros axes H. induction H; [reflexivity|now apply turn_rotates]. Qed.

(* Each axis of the device is written, from one of the subject. *)
Lemma device_of_related : forall {A B} (P : A -> B -> Prop) f g axes before after v w, is_rotation axes = true ->
  (forall x y, P x y -> P (f x) (g y)) -> (forall a, P (at_axis v a) (at_axis w a)) ->
  forall a, P (at_axis (turned_to_device f axes before v) a) (at_axis (turned_to_device g axes after w) a).
Proof.
  intros A B P f g axes [[b0 b1] b2] [[c0 c1] c2] [[x y] z] [[x' y'] z'] R F H a.
  pose proof (H axis_x) as Hx. pose proof (H axis_y) as Hy. pose proof (H axis_z) as Hz. clear H. cbn in Hx, Hy, Hz.
  destruct axes as [[[[] []] [[] []]] [[] []]]; try discriminate R; destruct a; cbn; auto.
Qed.

(* The power of a force is the same in both frames, for any velocity of the device. *)
Definition dot3 (v w : triple R) : R := at_axis v axis_x * at_axis w axis_x + at_axis v axis_y * at_axis w axis_y +
  at_axis v axis_z * at_axis w axis_z.
Theorem placement_keeps_power : forall axes before F v, placed axes ->
  dot3 (turned_to_device Ropp axes before F) v = dot3 F (turned_to_subject Ropp axes v).
Proof.
  intros axes [[b0 b1] b2] [[x y] z] [[x' y'] z'] H. apply placed_is_rotation in H. unfold dot3.
  destruct axes as [[[[] []] [[] []]] [[] []]]; try discriminate H; cbn; ring.
Qed.

(* What is turned to the device is turned back. *)
Theorem turned_back : forall axes before F, placed axes -> turned_to_subject Ropp axes (turned_to_device Ropp axes before F) = F.
Proof.
  intros axes [[b0 b1] b2] [[x y] z] H. apply placed_is_rotation in H.
  destruct axes as [[[[] []] [[] []]] [[] []]]; try discriminate H; cbn; rewrite ?Ropp_involutive; reflexivity.
Qed.

(* ---- Roundings ---- *)

Lemma minus32_is : forall a b, is_finite 24 128 a = true -> is_finite 24 128 b = true -> Rabs (value32 a - value32 b) <= bpow radix2 127 ->
  value32 (minus32 a b) = nearest32 (value32 a - value32 b) /\ is_finite 24 128 (minus32 a b) = true.
Proof.
  intros a b Fa Fb B. unfold minus32, b32_minus. pose proof (Bminus_correct 24 128 eq_refl eq_refl binop_nan_pl32 mode_NE a b Fa Fb) as C.
  rewrite Rlt_bool_true in C; [now destruct C as (V & F & _)|].
  apply Rle_lt_trans with (bpow radix2 127); [|apply bpow_lt; lia]. apply abs_round_le_generic; try typeclasses eauto; [|exact B].
  apply generic_format_bpow. unfold FLT_exp, SpecFloat.fexp, SpecFloat.emin. lia.
Qed.

(* 0 - x is exact, and never -0. *)
Lemma opposite32_is : forall f, is_finite 24 128 f = true ->
  value32 (opposite32 f) = - value32 f /\ is_finite 24 128 (opposite32 f) = true /\ (value32 f = 0 -> opposite32 f = zero32).
Proof.
  intros f Fin. unfold opposite32, minus32, b32_minus.
  match goal with |- context [Bminus _ _ ?p ?q ?nan _ _ _] =>
    pose proof (Bminus_correct 24 128 p q nan mode_NE zero32 f eq_refl Fin) as C;
    set (difference := Bminus 24 128 p q nan mode_NE zero32 f) in *
  end.
  cbv zeta in C. change (value32 zero32) with 0 in C. rewrite Rminus_0_l in C.
  change (round radix2 (SpecFloat.fexp 24 128) (round_mode mode_NE)) with nearest32 in C.
  rewrite (round_generic radix2 fexp32 ZnearestE (- value32 f)) in C
    by (auto with typeclass_instances; apply generic_format_opp, (generic_format_B2R 24 128)).
  rewrite Rlt_bool_true in C by (rewrite Rabs_Ropp; apply abs_B2R_lt_emax). destruct C as (C1 & C2 & C3).
  split; [exact C1|]. split; [exact C2|]. intro Z. rewrite Z, Ropp_0 in C1, C3. rewrite Rcompare_Eq in C3 by reflexivity. simpl in C3.
  destruct difference as [s|s|s pl Hpl|s m e H]; try discriminate.
  - simpl in C3. now rewrite C3.
  - exfalso. simpl in C1. apply eq_0_F2R in C1. now destruct s.
Qed.

Lemma opposite_is_nearest : forall f F, is_nearest32 f F -> is_nearest32 (opposite32 f) (- F).
Proof.
  intros f F (V & Fin & Z). destruct (opposite32_is f Fin) as (W & G & O). unfold is_nearest32. rewrite round_NE_opp.
  split; [now rewrite W, V|]. split; [exact G|]. intro H. apply O. rewrite V. lra.
Qed.

(* Each component of the device's force is the nearest binary32 to that of the exact force, if the subject's was, and not -0. *)
Theorem placed_force_is_nearest : forall axes before anything force exact, placed axes ->
  (forall a, is_nearest32 (at_axis force a) (at_axis exact a)) ->
  forall a,
    is_nearest32 (at_axis (turned_to_device opposite32 axes before force) a) (at_axis (turned_to_device Ropp axes anything exact) a).
Proof.
  intros axes before anything force exact H N. apply device_of_related; [now apply placed_is_rotation|exact opposite_is_nearest|exact N].
Qed.

(* A position is the device's, less the origin, rounded once and turned exactly. *)
Definition differences (position origin : triple binary32) : triple R :=
  let '(x, y, z) := position in let '(a, b, c) := origin in
  (nearest32 (value32 x - value32 a), nearest32 (value32 y - value32 b), nearest32 (value32 z - value32 c)).
Theorem position_is_rounded_once : forall axes origin position,
  (forall a, is_finite 24 128 (at_axis origin a) = true /\ is_finite 24 128 (at_axis position a) = true /\
    Rabs (value32 (at_axis position a) - value32 (at_axis origin a)) <= bpow radix2 127) ->
  each value32 (to_subject axes origin position) = turned_to_subject Ropp axes (differences position origin).
Proof.
  intros axes [[a b] c] [[x y] z] H. destruct (H axis_x) as (Fa & Fx & Bx). destruct (H axis_y) as (Fb & Fy & By).
  destruct (H axis_z) as (Fc & Fz & Bz). clear H. cbn [at_axis] in *.
  destruct (minus32_is x a Fx Fa Bx) as [Vx Gx]. destruct (minus32_is y b Fy Fb By) as [Vy Gy].
  destruct (minus32_is z c Fz Fc Bz) as [Vz Gz].
  unfold to_subject, differences. set (v := (minus32 x a, minus32 y b, minus32 z c)). rewrite <- Vx, <- Vy, <- Vz.
  set (w := (value32 (minus32 x a), value32 (minus32 y b), value32 (minus32 z c))).
  assert (S : forall d, value32 (along_direction opposite32 v d) = along_direction Ropp w d).
  { intros [e s]. unfold along_direction. cbn [fst snd]. destruct s, e; cbn [at_axis v w]; try reflexivity; now apply opposite32_is. }
  destruct axes as [[d e] f]. unfold turned_to_subject. cbn [each]. now rewrite !S.
Qed.

Theorem unshifted_position_is_exact : forall position, differences position (zero32, zero32, zero32) = each value32 position.
Proof.
  intros [[x y] z]. unfold differences. change (value32 zero32) with 0. rewrite !Rminus_0_r. cbn [each].
  now rewrite !(round_generic radix2 fexp32 ZnearestE) by apply (generic_format_B2R 24 128).
Qed.
