(* SPDX-License-Identifier: BSD-3-Clause *)
(* How long the integers are of a landing among sheets, of a sub-goal and of a slip that friction shortens: rows of the tables of bits in
   docs/proofs.md, "Bounds", and docs/friction.md, "Arithmetic", in the form of those in MeshBounds.v. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List.
From Forceshade Require Import Vectors MeshBounds.
Import ListNotations.
Open Scope R_scope.

(* ---- Vectors in units, and sums with weights ---- *)

Definition all_fit (u bits : Z) (a : vector) := fits u bits (x_of a) /\ fits u bits (y_of a) /\ fits u bits (z_of a).
Definition no_larger (most : R) (a : vector) := Rabs (x_of a) <= most /\ Rabs (y_of a) <= most /\ Rabs (z_of a) <= most.

Lemma they_fit : forall u bits size a, multiples u a -> no_larger (IZR size) a -> (size * 2 ^ u < 2 ^ bits)%Z -> (0 <= u)%Z ->
  all_fit u bits a.
Proof. intros u bits size a (M1 & M2 & M3) (L1 & L2 & L3) B U. repeat split; now apply it_fits with size. Qed.

Lemma multiples_plus : forall u a b, multiples u a -> multiples u b -> multiples u (plus a b).
Proof. intros u a b (A1 & A2 & A3) (B1 & B2 & B3). repeat split; now apply multiple_plus. Qed.

Lemma multiples_scaled : forall u v t a, (0 <= u)%Z -> (0 <= v)%Z -> multiple u t -> multiples v a -> multiples (u + v) (scaled t a).
Proof. intros u v t a U V T (A1 & A2 & A3). repeat split; now apply multiple_mult. Qed.

Lemma scaled_no_larger : forall p q t a, Rabs t <= p -> no_larger q a -> no_larger (p * q) (scaled t a).
Proof.
  intros p q t a T (A1 & A2 & A3). repeat split; cbn [scaled x_of y_of z_of]; rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos.
Qed.

Lemma plus_no_larger : forall p q a b, no_larger p a -> no_larger q b -> no_larger (p + q) (plus a b).
Proof.
  intros p q a b (A1 & A2 & A3) (B1 & B2 & B3).
  repeat split; cbn [plus x_of y_of z_of]; (apply Rle_trans with (1 := Rabs_triang _ _); now apply Rplus_le_compat).
Qed.

Lemma no_larger_than : forall p q a, p <= q -> no_larger p a -> no_larger q a.
Proof. intros p q a H (A1 & A2 & A3). repeat split; now apply Rle_trans with p. Qed.

(* No component is longer than the vector. *)
Lemma components_no_larger : forall a size, (0 <= size)%Z -> square a <= IZR (size * size) -> no_larger (IZR size) a.
Proof. intros a size S H. repeat split; apply size_from_square; auto; apply Rle_trans with (2 := H); components; nra. Qed.

Lemma square_no_larger : forall a size, no_larger (IZR size) a -> square a <= IZR (3 * (size * size)).
Proof.
  intros a size (A1 & A2 & A3). pose proof (product_size _ _ _ _ A1 A1) as X. pose proof (product_size _ _ _ _ A2 A2) as Y.
  pose proof (product_size _ _ _ _ A3 A3) as Z. rewrite mult_IZR. unfold square, dot.
  pose proof (Rle_abs (x_of a * x_of a)). pose proof (Rle_abs (y_of a * y_of a)). pose proof (Rle_abs (z_of a * z_of a)). lra.
Qed.

(* The sum of the weights of corners, and of what `of` is at each, times its weight. *)
Fixpoint all_weights {T} (corners : list (R * T)) : R :=
  match corners with [] => 0 | (weight, _) :: others => weight + all_weights others end.
Fixpoint weighted_sum {T} (of : T -> vector) (corners : list (R * T)) : vector :=
  match corners with [] => zero | (weight, corner) :: others => plus (scaled weight (of corner)) (weighted_sum of others) end.

Lemma multiples_zero : forall u, multiples u zero.
Proof. intro u. repeat split; exists 0%Z; cbn [zero x_of y_of z_of]; ring. Qed.

Lemma weighted_unit : forall T (of : T -> vector) corners u v, (0 <= u)%Z -> (0 <= v)%Z ->
  (forall weight corner, In (weight, corner) corners -> multiple u weight /\ multiples v (of corner)) ->
  multiples (u + v) (weighted_sum of corners).
Proof.
  intros T of corners u v U V. induction corners as [|[weight corner] others I]; intro H; [apply multiples_zero|].
  cbn [weighted_sum]. destruct (H weight corner (or_introl eq_refl)).
  apply multiples_plus; [now apply multiples_scaled|]. apply I. intros ? ? N. apply H. now right.
Qed.

Lemma weighted_size : forall T (of : T -> vector) corners most,
  (forall weight corner, In (weight, corner) corners -> 0 <= weight /\ no_larger most (of corner)) ->
  no_larger (all_weights corners * most) (weighted_sum of corners).
Proof.
  intros T of corners most. induction corners as [|[weight corner] others I]; intro H.
  - cbn [weighted_sum all_weights]. rewrite Rmult_0_l. repeat split; cbn [zero x_of y_of z_of]; rewrite Rabs_R0; lra.
  - cbn [weighted_sum all_weights]. destruct (H weight corner (or_introl eq_refl)) as [W L].
    rewrite Rmult_plus_distr_r. apply plus_no_larger; [|apply I; intros ? ? N; apply H; now right].
    apply scaled_no_larger; [rewrite Rabs_pos_eq; lra|exact L].
Qed.

(* ---- A landing among sheets, on an edge of a triangle in whose plane the flight lies (Flight::remaining(), Sheets::is_apart()). e is
   the edge, n the triangle's normal, g the flight's start and p its end. At the landing x, m/d of the flight is left, and d x is
   d p - m (p - g). The way from x to a point of the grid is tested against the edge (s, t) of another triangle
   (Segment::opposite()). Where d < 0, the code takes -m and -d, which changes none of these products. ---- *)

Definition under_landing (a b c g p : vector) := dot (cross (minus b a) (minus p g)) (normal a b c).  (* d *)
Definition over_landing (a b c p : vector) := dot (cross (minus b a) (minus p a)) (normal a b c).  (* m *)
Definition landing (a b c g p : vector) :=  (* d x *)
  minus (scaled (under_landing a b c g p) p) (scaled (over_landing a b c p) (minus p g)).

Lemma under_landing_unit : forall a b c g p, given a -> given b -> given c -> gridded g -> given p -> multiple 236 (under_landing a b c g p).
Proof. intros. apply (multiple_dot 130 106); units. apply (multiples_cross 53 77); units. Qed.

Lemma over_landing_unit : forall a b c p, given a -> given b -> given c -> given p -> multiple 212 (over_landing a b c p).
Proof. intros. apply (multiple_dot 106 106); units; apply (multiples_cross 53 53); units. Qed.

Lemma landing_unit : forall a b c g p, given a -> given b -> given c -> gridded g -> given p -> multiples 289 (landing a b c g p).
Proof.
  intros a b c g p A B C G P. apply multiples_minus.
  - apply (multiples_scaled 236 53); [lia|lia|now apply under_landing_unit|apply P].
  - apply (multiples_scaled 212 77); [lia|lia|now apply over_landing_unit|units].
Qed.

Notation most_under := (52 * (2000 * S3))%Z.  (* 5.2 S⁴, where √27 S⁴ would be enough *)

Lemma under_landing_size : forall a b c g p, given a -> given b -> given c -> gridded g -> given p ->
  Rabs (under_landing a b c g p) <= IZR most_under.
Proof.
  intros. apply dot_size with (3 * S2 * (3 * S2))%Z (3 * S4)%Z; [|sizes|discriminate|discriminate].
  apply cross_size; sizes.
Qed.

(* The determinant of the way from the landing and the edge (s, t), times d². *)
Lemma passes_from_landing : forall d x g s t,
  dot (cross (minus (scaled d x) (scaled d s)) (minus (scaled d g) (scaled d x))) (minus t s) = d * d * dot (normal s x g) (minus t s).
Proof. intros. components. ring. Qed.

Lemma landing_in_cube : forall p g part, in_cube p -> in_cube g -> 0 <= part <= 1 -> in_cube (minus p (scaled part (minus p g))).
Proof.
  intros p g part (P1 & P2 & P3) (G1 & G2 & G3) H.
  assert (One : forall x y, near x -> near y -> near (x - part * (x - y))).
  { intros x y X Y. unfold near, end_of_domain in *. split; nra. }
  repeat split; cbn [minus scaled x_of y_of z_of]; now apply One.
Qed.

(* | from a landing to the grid: d² det(…), d = (e × (p − g))·n | 2^-679 | 842 | *)
Theorem from_landing_fits : forall a b c g p s t h, given a -> given b -> given c -> gridded g -> given p -> given s -> given t ->
  gridded h ->
  (0 < over_landing a b c p < under_landing a b c g p \/ under_landing a b c g p < over_landing a b c p < 0) ->
  fits 679 842 (dot (cross (minus (landing a b c g p) (scaled (under_landing a b c g p) s))
    (minus (scaled (under_landing a b c g p) h) (landing a b c g p))) (minus t s)).
Proof.
  intros a b c g p s t h A B C G P S T H On. of size (most_under * most_under * (2 * S3))%Z.
  - apply multiple_of_less with 655%Z; [lia|]. apply (multiple_dot 602 53); units. apply (multiples_cross 289 313); units.
    + apply multiples_minus; [now apply landing_unit|].
      apply (multiples_scaled 236 53); [lia|lia|now apply under_landing_unit|apply S].
    + apply multiples_minus; [|apply multiples_of_less with 289%Z; [lia|now apply landing_unit]].
      apply (multiples_scaled 236 77); [lia|lia|now apply under_landing_unit|apply H].
  - pose proof (under_landing_size a b c g p A B C G P) as L. unfold landing.
    set (d := under_landing a b c g p) in *. set (m := over_landing a b c p) in *. clearbody d m.
    set (x := minus p (scaled (m / d) (minus p g))).
    assert (X : minus (scaled d p) (scaled m (minus p g)) = scaled d x).
    { unfold x. apply same_components; components; field; lra. }
    rewrite X, passes_from_landing. apply product_size; [now apply product_size|].
    apply volume_in_cube; [apply S| |apply H|apply T]. apply landing_in_cube; [apply P|apply G|].
    assert (D : m = m / d * d) by (field; lra). set (part := m / d) in *. clearbody part. split; destruct On; nra.
Qed.
