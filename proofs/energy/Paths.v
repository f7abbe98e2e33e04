(* SPDX-License-Identifier: BSD-3-Clause *)
(* Paths with the work that a law gives along them exist: smooth ways, straight ones, and one after another. *)
From Coq Require Import Reals Lra Classical List.
From Forceshade Require Import Laws Work.
Import ListNotations.
Open Scope R_scope.

(* Function that is f, and from b on g, moved so that they meet. *)
Definition then_from (b : R) (f g : R -> R) (t : R) : R := f (Rmin t b) + g (Rmax t b) - g b.

Lemma continuity_of_min : forall b, continuity (fun t => Rmin t b).
Proof.
  intros b t e He. exists e. split; [exact He|]. intros u [_ H]. simpl in *. unfold R_dist in *. apply Rle_lt_trans with (2 := H).
  unfold Rmin, Rabs. repeat match goal with |- context [if ?c then _ else _] => destruct c end; lra.
Qed.

Lemma continuity_of_max : forall b, continuity (fun t => Rmax t b).
Proof.
  intros b t e He. exists e. split; [exact He|]. intros u [_ H]. simpl in *. unfold R_dist in *. apply Rle_lt_trans with (2 := H).
  unfold Rmax, Rabs. repeat match goal with |- context [if ?c then _ else _] => destruct c end; lra.
Qed.

Lemma continuity_of_then : forall b f g, continuity f -> continuity g -> continuity (then_from b f g).
Proof.
  intros b f g F G. apply (continuity_minus (fun t => f (Rmin t b) + g (Rmax t b)) (fun _ => g b)).
  - apply (continuity_plus (fun t => f (Rmin t b)) (fun t => g (Rmax t b))).
    + apply (continuity_comp (fun t => Rmin t b) f); [apply continuity_of_min | exact F].
    + apply (continuity_comp (fun t => Rmax t b) g); [apply continuity_of_max | exact G].
  - apply continuity_const. intros u v. reflexivity.
Qed.

Lemma slope_before : forall b f g t d, t < b -> derivable_pt_lim f t d -> derivable_pt_lim (then_from b f g) t d.
Proof.
  intros b f g t d L D. apply (derivable_pt_lim_locally_ext f (then_from b f g) t (t - 1) b); [lra | | exact D].
  intros u U. unfold then_from. rewrite Rmin_left, Rmax_right by lra. ring.
Qed.

Lemma slope_after : forall b f g t d, b < t -> derivable_pt_lim g t d -> derivable_pt_lim (then_from b f g) t d.
Proof.
  intros b f g t d L D. apply (derivable_pt_lim_locally_ext (fun u => g u + (f b - g b)) (then_from b f g) t b (t + 1)); [lra | |].
  - intros u U. unfold then_from. rewrite Rmin_right, Rmax_left by lra. ring.
  - replace d with (d + 0) by ring. apply (derivable_pt_lim_plus g (fun _ => f b - g b)); [exact D | apply derivable_pt_lim_const].
Qed.

Lemma some_force_acts : forall law, exists Fx Fz, acts law Fx Fz.
Proof.
  intros law. destruct (classic (in_contact law)) as [C|C].
  - exists (exact_x law), (exact_z law). left. auto.
  - exists 0, 0. right. auto.
Qed.

(* ---- Ways at one place ---- *)

Definition way (V : R -> R -> R) (x z : R -> R) : path := {| at_x := x; at_z := z; work := fun t => - V (x t) (z t) |}.

Lemma way_follows : forall law place V x z dx dz a b, has_slope law place V -> a <= b ->
  (forall t, derivable_pt_lim x t (dx t)) -> (forall t, derivable_pt_lim z t (dz t)) ->
  (forall t, a < t < b -> place (x t) (z t)) -> follows law place (way V x z) a b.
Proof.
  intros law place V x z dx dz a b [C S] L Dx Dz P.
  pose proof (continuity_of_slope _ _ Dx) as Cx. pose proof (continuity_of_slope _ _ Dz) as Cz.
  split; [exact L | split; [split; [exact Cx | split; [exact Cz|]]|]].
  - apply (continuity_opp (fun t => V (x t) (z t))). exact (C (way V x z) Cx Cz).
  - exists []. intros t T _. split; [exact (P t T)|]. exists (dx t), (dz t). split; [apply Dx | split; [apply Dz|]].
    destruct (some_force_acts (law (x t) (z t))) as [Fx [Fz A]]. exists Fx, Fz. split; [exact A|].
    rewrite <- (Ropp_involutive (Fx * _ + _)). apply (derivable_pt_lim_opp (fun t => V (x t) (z t))).
    exact (S (way V x z) t _ _ _ _ (Dx t) (Dz t) (P t T) A).
Qed.

(* Straight way from (X0, Z0) at the time a to (X1, Z1) at a + 1. *)
Definition line (V : R -> R -> R) (a X0 Z0 X1 Z1 : R) : path :=
  way V (fun t => X0 + (t - a) * (X1 - X0)) (fun t => Z0 + (t - a) * (Z1 - Z0)).

Lemma line_follows : forall law place V a X0 Z0 X1 Z1, has_slope law place V ->
  (forall s, 0 < s < 1 -> place (X0 + s * (X1 - X0)) (Z0 + s * (Z1 - Z0))) -> follows law place (line V a X0 Z0 X1 Z1) a (a + 1).
Proof.
  intros law place V a X0 Z0 X1 Z1 S P.
  assert (D : forall u d t, derivable_pt_lim (fun t => u + (t - a) * d) t (0 + ((1 - 0) * d + (t - a) * 0))).
  { intros u d t. apply (derivable_pt_lim_plus (fun _ => u) (fun t => (t - a) * d)); [apply derivable_pt_lim_const|].
    apply (derivable_pt_lim_mult (fun t => t - a) (fun _ => d)); [|apply derivable_pt_lim_const].
    apply (derivable_pt_lim_minus (fun t => t) (fun _ => a)); [apply derivable_pt_lim_id | apply derivable_pt_lim_const]. }
  apply (way_follows _ _ V _ _ _ _ a (a + 1) S ltac:(lra) (D X0 (X1 - X0)) (D Z0 (Z1 - Z0))).
  intros t T. apply P. lra.
Qed.

(* ---- One path after another ---- *)

Definition joined (b : R) (p q : path) : path :=
  {| at_x := then_from b (at_x p) (at_x q); at_z := then_from b (at_z p) (at_z q); work := then_from b (work p) (work q) |}.
Definition meet (b : R) (p q : path) : Prop := at_x p b = at_x q b /\ at_z p b = at_z q b.

Lemma then_before : forall b f g t, t <= b -> then_from b f g t = f t.
Proof. intros b f g t L. unfold then_from. rewrite Rmin_left, Rmax_right by lra. ring. Qed.
Lemma then_after : forall b f g t, b <= t -> f b = g b -> then_from b f g t = g t.
Proof. intros b f g t L E. unfold then_from. rewrite Rmin_right, Rmax_left by lra. lra. Qed.

Lemma then_same : forall b f t, then_from b f f t = f t.
Proof. intros b f t. destruct (Rle_dec t b); [apply then_before | apply then_after]; trivial; lra. Qed.

Lemma continuous_joined : forall b p q, continuous p -> continuous q -> continuous (joined b p q).
Proof. intros b p q (A & B & C) (E & F & G). repeat split; apply continuity_of_then; assumption. Qed.

Lemma joined_before : forall law place b p q a c, c <= b -> continuous q -> follows law place p a c ->
  follows law place (joined b p q) a c.
Proof.
  intros law place b p q a c L Q (O & P & moments & M). split; [exact O | split; [apply continuous_joined; assumption|]].
  exists moments. intros t T N. destruct (M t T N) as (I & dx & dz & Dx & Dz & Fx & Fz & A & Dw). cbn [at_x at_z joined].
  rewrite !then_before by lra. split; [exact I|]. exists dx, dz. unfold goes. cbn [at_x at_z work joined]. rewrite !then_before by lra.
  split; [apply slope_before; [lra | exact Dx] | split; [apply slope_before; [lra | exact Dz]|]].
  exists Fx, Fz. split; [exact A | apply slope_before; [lra | exact Dw]].
Qed.

Lemma joined_after : forall law place b p q a c, b <= a -> continuous p -> meet b p q -> follows law place q a c ->
  follows law place (joined b p q) a c.
Proof.
  intros law place b p q a c L P [X Z] (O & Q & moments & M). split; [exact O | split; [apply continuous_joined; assumption|]].
  exists moments. intros t T N. destruct (M t T N) as (I & dx & dz & Dx & Dz & Fx & Fz & A & Dw). cbn [at_x at_z joined].
  rewrite !then_after by (trivial; lra). split; [exact I|]. exists dx, dz. unfold goes. cbn [at_x at_z work joined].
  rewrite !then_after by (trivial; lra).
  split; [apply slope_after; [lra | exact Dx] | split; [apply slope_after; [lra | exact Dz]|]].
  exists Fx, Fz. split; [exact A | apply slope_after; [lra | exact Dw]].
Qed.
