(* SPDX-License-Identifier: BSD-3-Clause *)
(* Work along a path in the force of a law: what it is, and that it is a difference of potentials where the force is the slope of one. No
   integrals are needed: the energy given is a function of time whose derivative is the power. *)
From Coq Require Import Reals Lra Psatz List.
From Forceshade Require Import Laws.
Import ListNotations.
Open Scope R_scope.

(* Force of a law at a position, none where there is no contact. *)
Definition acts (law : exact_force) (Fx Fz : R) : Prop :=
  in_contact law /\ Fx = exact_x law /\ Fz = exact_z law \/ ~ in_contact law /\ Fx = 0 /\ Fz = 0.

(* Way of the hand, y aside, and the energy that the law has given to it, each by the time. *)
Record path := { at_x : R -> R; at_z : R -> R; work : R -> R }.

(* Movement with the velocity (dx, dz) at a moment, at which the energy grows by the power of the force. *)
Definition goes (law : R -> R -> exact_force) (p : path) (t : R) (dx dz : R) : Prop :=
  derivable_pt_lim (at_x p) t dx /\ derivable_pt_lim (at_z p) t dz /\
  exists Fx Fz, acts (law (at_x p t) (at_z p t)) Fx Fz /\ derivable_pt_lim (work p) t (Fx * dx + Fz * dz).

Definition continuous (p : path) : Prop := continuity (at_x p) /\ continuity (at_z p) /\ continuity (work p).

(* Path from a to b that is at the place, and moves under the law, at all but finitely many moments. At these its velocity may jump. *)
Definition follows (law : R -> R -> exact_force) (place : R -> R -> Prop) (p : path) (a b : R) : Prop :=
  a <= b /\ continuous p /\ exists moments : list R, forall t, a < t < b -> ~ In t moments ->
    place (at_x p t) (at_z p t) /\ exists dx dz, goes law p t dx dz.

(* Energy given by any such path: the potential V at its beginning less that at its end. *)
Definition has_potential (law : R -> R -> exact_force) (place : R -> R -> Prop) (V : R -> R -> R) : Prop :=
  forall p a b, follows law place p a b ->
    work p b - work p a = V (at_x p a) (at_z p a) - V (at_x p b) (at_z p b).

Theorem closed_path_gives_nothing : forall law place V p a b, has_potential law place V -> follows law place p a b ->
  at_x p a = at_x p b -> at_z p a = at_z p b -> work p a = work p b.
Proof. intros law place V p a b P F X Z. apply P in F. rewrite X, Z in F. lra. Qed.

(* ---- Proof that a function is a potential ---- *)

Lemma constant_but_at_moments : forall f moments a b, continuity f -> a <= b ->
  (forall t, a < t < b -> ~ In t moments -> derivable_pt_lim f t 0) -> f a = f b.
Proof.
  intros f moments. induction moments as [|c rest IH]; intros a b C L D.
  - assert (pr : forall t, a < t < b -> derivable_pt f t) by (intros t Ht; exists 0; apply D; auto).
    symmetry. apply (null_derivative_loc f a b pr); [intros; apply C | | lra].
    intros t Ht. apply derive_pt_eq_0. apply D; auto.
  - assert (apart : forall t, t <> c -> ~ In t rest -> ~ In t (c :: rest)) by (intros t N I [E|E]; [congruence | auto]).
    destruct (Rlt_dec a c) as [A|A]; [destruct (Rlt_dec c b) as [B|B]|].
    + transitivity (f c); apply IH; try lra; try exact C; intros t Ht N; apply D; try apply apart; lra || exact N.
    + apply IH; trivial. intros t Ht N. apply D; [lra | apply apart; lra || exact N].
    + apply IH; trivial. intros t Ht N. apply D; [lra | apply apart; lra || exact N].
Qed.

(* Potential of which the force is the slope, along every path. *)
Definition has_slope (law : R -> R -> exact_force) (place : R -> R -> Prop) (V : R -> R -> R) : Prop :=
  (forall p, continuity (at_x p) -> continuity (at_z p) -> continuity (fun t => V (at_x p t) (at_z p t))) /\
  (forall p t dx dz Fx Fz, derivable_pt_lim (at_x p) t dx -> derivable_pt_lim (at_z p) t dz -> place (at_x p t) (at_z p t) ->
    acts (law (at_x p t) (at_z p t)) Fx Fz ->
    derivable_pt_lim (fun t => V (at_x p t) (at_z p t)) t (- (Fx * dx + Fz * dz))).

Lemma is_potential : forall law place V, has_slope law place V -> has_potential law place V.
Proof.
  intros law place V [C S] p a b [L [[Cx [Cz Cw]] [moments M]]].
  assert (E : work p a + V (at_x p a) (at_z p a) = work p b + V (at_x p b) (at_z p b)).
  { apply (constant_but_at_moments (fun t => work p t + V (at_x p t) (at_z p t)) moments); [|exact L|].
    - apply (continuity_plus (work p) (fun t => V (at_x p t) (at_z p t))); [exact Cw | apply C; assumption].
    - intros t Ht N. destruct (M t Ht N) as [P [dx [dz [Dx [Dz [Fx [Fz [A Dw]]]]]]]].
      replace 0 with ((Fx * dx + Fz * dz) + - (Fx * dx + Fz * dz)) by ring.
      apply (derivable_pt_lim_plus (work p) (fun t => V (at_x p t) (at_z p t))); [exact Dw | apply S; assumption]. }
  lra.
Qed.

Definition half_square (u : R) : R := Rsqr (Rmax u 0) / 2.

Lemma slope_of_half_square : forall u, derivable_pt_lim half_square u (Rmax u 0).
Proof.
  intros u e He. exists (mkposreal e He). intros h N H. simpl in H.
  assert (B : Rabs (half_square (u + h) - half_square u - Rmax u 0 * h) <= h * h / 2).
  { unfold half_square, Rsqr. apply Rabs_le.
    unfold Rmax. destruct (Rle_dec u 0); destruct (Rle_dec (u + h) 0); split; nra. }
  replace ((half_square (u + h) - half_square u) / h - Rmax u 0) with ((half_square (u + h) - half_square u - Rmax u 0 * h) / h)
    by (field; exact N).
  unfold Rdiv. rewrite Rabs_mult, Rabs_inv.
  apply Rabs_pos_lt in N as P. apply Rmult_lt_reg_r with (Rabs h); [exact P|].
  rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
  assert (h * h = Rabs h * Rabs h) by (rewrite <- Rabs_mult; symmetry; apply Rabs_pos_eq; nra). nra.
Qed.

Lemma continuity_of_slope : forall f g : R -> R, (forall u, derivable_pt_lim f u (g u)) -> continuity f.
Proof. intros f g D u. apply derivable_continuous_pt. exists (g u). apply D. Qed.

Lemma slope_of_scaled : forall K g t d,
  derivable_pt_lim g t d -> derivable_pt_lim (fun t => K * half_square (g t)) t (K * (Rmax (g t) 0 * d)).
Proof.
  intros K g t d D. apply (derivable_pt_lim_scal (fun t => half_square (g t))).
  apply (derivable_pt_lim_comp g half_square); [exact D | apply slope_of_half_square].
Qed.

Lemma continuity_of_scaled : forall K g, continuity g -> continuity (fun t => K * half_square (g t)).
Proof.
  intros K g C. apply (continuity_scal (fun t => half_square (g t))). apply (continuity_comp g half_square); [exact C|].
  apply (continuity_of_slope _ _ slope_of_half_square).
Qed.

(* Energy of a plane of the height H, as a spring. *)
Definition plane_energy (K H X Z : R) : R := K * half_square (H - Z).

Lemma slope_of_plane : forall K H z t dz,
  derivable_pt_lim z t dz -> derivable_pt_lim (fun t => plane_energy K H 0 (z t)) t (- (K * Rmax (H - z t) 0 * dz)).
Proof.
  intros K H z t dz D. replace (- (K * Rmax (H - z t) 0 * dz)) with (K * (Rmax (H - z t) 0 * (0 - dz))) by ring.
  apply (slope_of_scaled K (fun t => H - z t)). apply (derivable_pt_lim_minus (fun _ => H) z); [apply derivable_pt_lim_const | exact D].
Qed.

Lemma continuity_of_plane : forall K H z, continuity z -> continuity (fun t => plane_energy K H 0 (z t)).
Proof.
  intros K H z C. apply (continuity_of_scaled K (fun t => H - z t)). apply (continuity_minus (fun _ => H) z); [|exact C].
  apply continuity_const. intros u v. reflexivity.
Qed.

Lemma plane_has_slope : forall law (place : R -> R -> Prop) K H,
  (forall X Z Fx Fz, place X Z -> acts (law X Z) Fx Fz -> Fx = 0 /\ Fz = K * Rmax (H - Z) 0) ->
  has_slope law place (plane_energy K H).
Proof.
  intros law place K H L. split.
  - intros p _ Cz. apply (continuity_of_plane K H (at_z p)). exact Cz.
  - intros p t dx dz Fx Fz _ Dz P A. destruct (L _ _ _ _ P A) as [-> ->].
    replace (- (0 * dx + K * Rmax (H - at_z p t) 0 * dz)) with (- (K * Rmax (H - at_z p t) 0 * dz)) by ring.
    apply (slope_of_plane K H (at_z p)). exact Dz.
Qed.

Lemma no_contact_gives_nothing : forall law, has_slope law (fun X Z => ~ in_contact (law X Z)) (fun _ _ => 0).
Proof.
  intros law. split.
  - intros p _ _. apply continuity_const. intros u v. reflexivity.
  - intros p t dx dz Fx Fz _ _ N [[C _]|[_ [-> ->]]]; [contradiction|].
    replace (- (0 * dx + 0 * dz)) with 0 by ring. apply derivable_pt_lim_const.
Qed.

(* Cases of what a law does at a position: contact, or none. *)
Ltac acting A := destruct A as [[C [-> ->]]|[C [-> ->]]]; simpl in C |- *.
