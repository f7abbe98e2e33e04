(* SPDX-License-Identifier: BSD-3-Clause *)
(* Vectors of three real numbers, for the proofs about meshes. *)
From Coq Require Import Reals Lra Psatz.
Open Scope R_scope.

Record vector := Vector { x_of : R; y_of : R; z_of : R }.
Definition plus (a b : vector) := Vector (x_of a + x_of b) (y_of a + y_of b) (z_of a + z_of b).
Definition minus (a b : vector) := Vector (x_of a - x_of b) (y_of a - y_of b) (z_of a - z_of b).
Definition scaled (t : R) (a : vector) := Vector (t * x_of a) (t * y_of a) (t * z_of a).
Definition dot (a b : vector) := x_of a * x_of b + y_of a * y_of b + z_of a * z_of b.
Definition square (a : vector) := dot a a.
Definition cross (a b : vector) :=
  Vector (y_of a * z_of b - z_of a * y_of b) (z_of a * x_of b - x_of a * z_of b) (x_of a * y_of b - y_of a * x_of b).
Definition zero := Vector 0 0 0.
(* (b - a) x (c - a), the normal of a triangle. *)
Definition normal (a b c : vector) := cross (minus b a) (minus c a).

(* What an expression of vectors is in its components. *)
Ltac components := unfold normal, square, dot, cross, scaled, plus, minus, zero in *; cbn [x_of y_of z_of] in *.

Lemma same_components : forall a b, x_of a = x_of b -> y_of a = y_of b -> z_of a = z_of b -> a = b.
Proof. intros [] []. cbn. intros -> -> ->. reflexivity. Qed.

Lemma square_is_not_negative : forall a, 0 <= square a.
Proof. intros a. components. nra. Qed.

Lemma square_is_zero : forall a, square a = 0 -> a = zero.
Proof. intros a. components. intro H. apply same_components; cbn; nra. Qed.

Lemma square_is_positive : forall a, a <> zero -> 0 < square a.
Proof.
  intros a H. destruct (Rle_lt_or_eq_dec 0 (square a) (square_is_not_negative a)) as [L|E]; [exact L|].
  now destruct H; apply square_is_zero.
Qed.

(* Lagrange's identity. *)
Lemma square_of_cross : forall a b, square (cross a b) = square a * square b - dot a b * dot a b.
Proof. intros a b. components. ring. Qed.

Lemma cauchy_schwarz : forall a b, dot a b * dot a b <= square a * square b.
Proof. intros a b. pose proof (square_is_not_negative (cross a b)) as H. rewrite square_of_cross in H. lra. Qed.

Lemma cross_is_no_longer : forall a b, square (cross a b) <= square a * square b.
Proof. intros a b. rewrite square_of_cross. pose proof (Rle_0_sqr (dot a b)) as H. unfold Rsqr in H. lra. Qed.
