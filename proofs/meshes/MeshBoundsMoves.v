(* SPDX-License-Identifier: BSD-3-Clause *)
(* How long the integers are of a landing among sheets, of a sub-goal and of a slip that friction shortens: rows of the tables of bits in
   fast/meshes/bits.md, in the form of those in MeshBounds.v. *)
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

(* ---- A landing among sheets, on an edge of a triangle in whose plane the flight lies (Flight::remaining(); the rest is of a former
   rule). e is the edge, n the triangle's normal, g the flight's start and p its end. At the landing x, m/d of the flight is left, and
   d x is d p - m (p - g). The way from x to a point of the grid is tested against the edge (s, t) of another triangle.
   Where d < 0, the code takes -m and -d, which changes none of these products. ---- *)

Definition under_landing (a b c g p : vector) := dot (cross (minus b a) (minus p g)) (normal a b c).  (* d *)
Definition over_landing (a b c p : vector) := dot (cross (minus b a) (minus p a)) (normal a b c).  (* m *)
Definition landing (a b c g p : vector) :=  (* d x *)
  minus (scaled (under_landing a b c g p) p) (scaled (over_landing a b c p) (minus p g)).

Lemma under_landing_unit : forall a b c g p, given a -> given b -> given c -> gridded g -> given p ->
  multiple 236 (under_landing a b c g p).
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

(* Where that way lies in the plane of the other triangle (Segment::meet_flat()): t of a side (s, t) that it crosses, over its den. *)
Definition from_landing (a b c g p h : vector) := minus (scaled (under_landing a b c g p) h) (landing a b c g p).  (* d u *)

Lemma from_landing_unit : forall a b c g p h, given a -> given b -> given c -> gridded g -> given p -> gridded h ->
  multiples 313 (from_landing a b c g p h).
Proof.
  intros a b c g p h A B C G P H. apply multiples_minus; [|apply multiples_of_less with 289%Z; [lia|now apply landing_unit]].
  apply (multiples_scaled 236 77); [lia|lia|now apply under_landing_unit|apply H].
Qed.

Lemma flat_products : forall d x v h s t,
  dot (cross (minus (scaled d v) (scaled d x)) (minus (scaled d h) (scaled d x))) (cross (minus (scaled d h) (scaled d x)) (minus t s)) =
    d * d * d * dot (normal x v h) (cross (minus h x) (minus t s)) /\
  square (cross (minus (scaled d h) (scaled d x)) (minus t s)) * d = d * d * d * square (cross (minus h x) (minus t s)).
Proof. intros. split; components; ring. Qed.

(* | the same in the plane of another triangle: d³ (u × e)², u the way from the landing | 2^-992 | 1231 | *)
Theorem from_landing_in_a_plane_fits : forall a b c g p s t v h, given a -> given b -> given c -> gridded g -> given p -> given s ->
  given t -> given v -> gridded h ->
  (0 < over_landing a b c p < under_landing a b c g p \/ under_landing a b c g p < over_landing a b c p < 0) ->
  fits 992 1231 (square (cross (from_landing a b c g p h) (minus t s)) * under_landing a b c g p) /\
  fits 992 1231 (dot (cross (from_landing a b c g p v) (from_landing a b c g p h)) (cross (from_landing a b c g p h) (minus t s))).
Proof.
  intros a b c g p s t v h A B C G P S T V H On.
  pose proof (from_landing_unit a b c g p h A B C G P H) as U.
  pose proof (from_landing_unit a b c g p v A B C G P (given_is_gridded v V)) as W.
  pose proof (under_landing_unit a b c g p A B C G P) as D. pose proof (under_landing_size a b c g p A B C G P) as L.
  assert (E : multiples 366 (cross (from_landing a b c g p h) (minus t s))).
  { apply (multiples_cross 313 53); [lia|lia|exact U|now apply edge_unit]. }
  assert (Sizes : Rabs (square (cross (from_landing a b c g p h) (minus t s)) * under_landing a b c g p) <=
      IZR (most_under * most_under * most_under * (3 * S2 * (3 * S2))) /\
    Rabs (dot (cross (from_landing a b c g p v) (from_landing a b c g p h)) (cross (from_landing a b c g p h) (minus t s))) <=
      IZR (most_under * most_under * most_under * most_under)).
  { clear U W D E. unfold from_landing, landing.
    set (d := under_landing a b c g p) in *. set (m := over_landing a b c p) in *. clearbody d m.
    set (x := minus p (scaled (m / d) (minus p g))).
    assert (X : minus (scaled d p) (scaled m (minus p g)) = scaled d x).
    { unfold x. apply same_components; components; field; lra. }
    assert (In_ : in_cube x).
    { apply landing_in_cube; [apply P|apply G|]. assert (D : m = m / d * d) by (field; lra).
      set (part := m / d) in *. clearbody part. split; destruct On; nra. }
    clearbody x. rewrite X. destruct (flat_products d x v h s t) as [-> ->].
    assert (Way : square (cross (minus h x) (minus t s)) <= IZR (3 * S2 * (3 * S2))).
    { apply cross_size; [apply distance_in_cube; [exact In_|apply H]|now apply edge_size]. }
    assert (Cube : Rabs (d * d * d) <= IZR (most_under * most_under * most_under)) by (repeat apply product_size; exact L).
    split; (apply product_size; [exact Cube|]).
    - now apply square_size.
    - apply dot_size with (3 * S4)%Z (3 * S2 * (3 * S2))%Z; [|exact Way|discriminate|discriminate].
      apply area_in_cube; [exact In_|apply V|apply H]. }
  destruct Sizes as [L1 L2]. split.
  - of size (most_under * most_under * most_under * (3 * S2 * (3 * S2)))%Z; [|exact L1].
    apply multiple_of_less with 968%Z; [lia|].
    apply (multiple_mult 732 236); [lia|lia|apply (multiple_dot 366 366); (lia || assumption)|exact D].
  - of size (most_under * most_under * most_under * most_under)%Z; [|exact L2].
    apply (multiple_dot 626 366); [lia|lia| |exact E]. apply (multiples_cross 313 313); (lia || assumption).
Qed.

(* ---- A sub-goal (SubGoal::goal_in()): g is the god-object's point in the triangle (a, b, c), with the corners' whole weights, and N
   the corners' normals with these weights. ---- *)

Definition normal_within (most : Z) (N : vector) := multiples 149 N /\ no_larger (IZR most) N.
Definition a_normal : vector -> Prop := normal_within 2.

(* What is interpolated in a triangle has the weights of its three corners. *)
Definition in_three {T} (weights : R * R * R) (first second third : T) : list (R * T) :=
  let '(u, v, w) := weights in [(u, first); (v, second); (w, third)].
Definition whole (k l m : Z) := (IZR k, IZR l, IZR m).
Definition of_the_grid (k l m : Z) := (0 <= k /\ 0 <= l /\ 0 <= m /\ k + l + m = 2 ^ 24)%Z.

Definition way_to_grid (k l m : Z) (a b c p : vector) :=  (* 2^24 (g - p) *)
  weighted_sum (fun corner => minus corner p) (in_three (whole k l m) a b c).
Definition shading_normal (k l m : Z) (N1 N2 N3 : vector) := weighted_sum (fun N => N) (in_three (whole k l m) N1 N2 N3).
Definition under_sub_goal (n N : vector) := IZR (2 ^ 24) * (square N * square n).
(* p + ((g - p)·N/N²) (N - (N·n/n²) n), times that. *)
Definition over_sub_goal (n N way p : vector) :=
  plus (scaled (under_sub_goal n N) p) (scaled (dot way N) (minus (scaled (square n) N) (scaled (dot N n) n))).

Lemma weights_of_the_grid : forall T k l m (first second third : T), of_the_grid k l m ->
  all_weights (in_three (whole k l m) first second third) = IZR (2 ^ 24) /\
  (forall weight corner, In (weight, corner) (in_three (whole k l m) first second third) ->
    multiple 0 weight /\ 0 <= weight /\ (corner = first \/ corner = second \/ corner = third)).
Proof.
  intros T k l m first second third (K & L & M & S). split.
  - cbn [all_weights in_three whole]. rewrite <- S, !plus_IZR. ring.
  - intros weight corner H. apply IZR_le in K, L, M.
    destruct H as [E|[E|[E|[]]]]; injection E as <- <-; (split; [apply multiple_of_integer|split; [assumption|tauto]]).
Qed.

Lemma difference_no_larger : forall a b, in_cube a -> in_cube b -> no_larger (IZR side) (minus b a).
Proof.
  intros a b ([? ?] & [? ?] & [? ?]) ([? ?] & [? ?] & [? ?]). change (IZR side) with 20000. unfold end_of_domain in *.
  repeat split; cbn [minus x_of y_of z_of]; apply Rabs_le; lra.
Qed.

Lemma way_to_grid_is : forall k l m a b c p, given a -> given b -> given c -> given p -> of_the_grid k l m ->
  multiples 53 (way_to_grid k l m a b c p) /\ no_larger (IZR (2 ^ 24 * side)) (way_to_grid k l m a b c p).
Proof.
  intros k l m a b c p A B C P G. destruct (weights_of_the_grid _ k l m a b c G) as [S W]. split.
  - apply (weighted_unit _ _ _ 0 53); [lia|lia|]. intros weight corner H. destruct (W weight corner H) as (U & _ & E).
    split; [exact U|]. destruct E as [->|[->| ->]]; now apply edge_unit.
  - rewrite mult_IZR, <- S. apply weighted_size. intros weight corner H. destruct (W weight corner H) as (_ & U & E).
    split; [exact U|]. destruct E as [->|[->| ->]]; (apply difference_no_larger; [apply P|]); [apply A|apply B|apply C].
Qed.

Lemma shading_normal_is : forall most k l m N1 N2 N3, normal_within most N1 -> normal_within most N2 -> normal_within most N3 ->
  of_the_grid k l m -> normal_within (2 ^ 24 * most) (shading_normal k l m N1 N2 N3).
Proof.
  intros most k l m N1 N2 N3 [U1 L1] [U2 L2] [U3 L3] G. destruct (weights_of_the_grid _ k l m N1 N2 N3 G) as [S W]. split.
  - apply (weighted_unit _ _ _ 0 149); [lia|lia|]. intros weight corner H. destruct (W weight corner H) as (U & _ & E).
    split; [exact U|]. destruct E as [->|[->| ->]]; assumption.
  - rewrite mult_IZR, <- S. apply weighted_size. intros weight corner H. destruct (W weight corner H) as (_ & U & E).
    split; [exact U|]. destruct E as [->|[->| ->]]; assumption.
Qed.

(* What of n² N is along the plane. *)
Lemma along_plane_size : forall n N p q, square n <= IZR p -> square N <= IZR q ->
  square (minus (scaled (square n) N) (scaled (dot N n) n)) <= IZR (p * p * q).
Proof.
  intros n N p q P Q. rewrite !mult_IZR. pose proof (square_is_not_negative n) as P0. pose proof (square_is_not_negative N) as Q0.
  replace (square (minus (scaled (square n) N) (scaled (dot N n) n))) with
    (square n * (square n * square N - dot N n * dot N n)) by (components; ring).
  assert (L : square n * square N - dot N n * dot N n <= square n * square N) by (pose proof (Rle_0_sqr (dot N n)); unfold Rsqr in *; lra).
  apply Rle_trans with (square n * (square n * square N)); [now apply Rmult_le_compat_l|].
  rewrite <- Rmult_assoc. apply Rmult_le_compat; auto; [now apply Rmult_le_pos|]. now apply Rmult_le_compat.
Qed.

Notation most_normal := (2 ^ 24 * 2)%Z.
Notation most_under_goal := (2 ^ 24 * (3 * (most_normal * most_normal) * (3 * S4)))%Z.

Lemma position_no_larger : forall p, given p -> no_larger (IZR end_of_domain) p.
Proof. intros p (([? ?] & [? ?] & [? ?]) & _). repeat split; apply Rabs_le; lra. Qed.

(* | a coordinate of a sub-goal, times 2²⁴ N² n² | 2^-563 | 714 | *)
Theorem sub_goal_fits : forall a b c p N1 N2 N3 (k l m : Z), given a -> given b -> given c -> given p -> a_normal N1 -> a_normal N2 ->
  a_normal N3 -> of_the_grid k l m ->
  all_fit 563 714 (over_sub_goal (normal a b c) (shading_normal k l m N1 N2 N3) (way_to_grid k l m a b c p) p).
Proof.
  intros a b c p N1 N2 N3 k l m A B C P A1 A2 A3 G.
  destruct (way_to_grid_is k l m a b c p A B C P G) as [WU WL].
  destruct (shading_normal_is 2 k l m N1 N2 N3 A1 A2 A3 G) as [NU NL].
  pose proof (normal_unit a b c A B C) as U. pose proof (normal_size a b c A B C) as L.
  set (N := shading_normal k l m N1 N2 N3) in *. set (w := way_to_grid k l m a b c p) in *. set (n := normal a b c) in *.
  clearbody N w n. pose proof (square_no_larger _ _ WL) as WS. pose proof (square_no_larger _ _ NL) as NS.
  apply they_fit with (most_under_goal * end_of_domain + 6 * (2 ^ 24 * (2 ^ 24 * side)) * (21 * 2 ^ 23 * S4))%Z.
  - apply multiples_plus.
    + apply (multiples_scaled 510 53); [lia|lia| |apply P].
      apply (multiple_mult 0 510); [lia|lia|apply multiple_of_integer|].
      apply (multiple_mult 298 212); [lia|lia|apply (multiple_dot 149 149)|apply (multiple_dot 106 106)]; (lia || assumption).
    + apply (multiples_scaled 202 361); [lia|lia|apply (multiple_dot 53 149); (lia || assumption)|].
      apply multiples_minus.
      * apply (multiples_scaled 212 149); [lia|lia|apply (multiple_dot 106 106); (lia || assumption)|assumption].
      * apply (multiples_scaled 255 106); [lia|lia|apply (multiple_dot 149 106); (lia || assumption)|assumption].
  - rewrite plus_IZR. apply plus_no_larger.
    + rewrite mult_IZR. apply scaled_no_larger; [|now apply position_no_larger].
      apply product_size; [apply size_of_integer; lia|]. apply product_size; now apply square_size.
    + rewrite mult_IZR. apply scaled_no_larger.
      * apply dot_size with (2 := NS) (1 := WS); [discriminate|vm_compute; discriminate].
      * apply components_no_larger; [discriminate|].
        apply Rle_trans with (1 := along_plane_size n N _ _ L NS). apply IZR_le. vm_compute. discriminate.
  - reflexivity.
  - lia.
Qed.

(* ---- A slip that friction shortens by i/2^24 (exact_weight_after()): whether it ends before it comes to the border. h(x), the height of x
   over a side (s, t) of the triangle, is n times twice the area of s, t and x, and n² times the weight of the opposite corner. ---- *)

Definition height_over (a b c s t x : vector) := dot (cross (minus t s) (minus x s)) (normal a b c).

(* The weights that the code computes are these heights, and so is 2^-24 G n² for a point of the grid where that corner's weight is G. *)
Lemma heights_are_weights : forall a b c p,
  dot (cross (minus p a) (minus c a)) (normal a b c) = height_over a b c c a p /\
  dot (cross (minus b a) (minus p a)) (normal a b c) = height_over a b c a b p /\
  square (normal a b c) - (dot (cross (minus p a) (minus c a)) (normal a b c) + dot (cross (minus b a) (minus p a)) (normal a b c)) =
    height_over a b c b c p.
Proof. intros. unfold height_over. repeat split; components; ring. Qed.

Lemma heights_of_the_grid : forall a b c g u v w, u + v + w = 1 -> g = plus (scaled u a) (plus (scaled v b) (scaled w c)) ->
  height_over a b c b c g = u * square (normal a b c) /\ height_over a b c c a g = v * square (normal a b c) /\
  height_over a b c a b g = w * square (normal a b c).
Proof.
  intros a b c g u v w S ->. replace u with (1 - v - w) by lra. unfold height_over. repeat split; components; ring.
Qed.

Lemma height_unit : forall a b c s t p, given a -> given b -> given c -> given s -> given t -> given p ->
  multiple 212 (height_over a b c s t p).
Proof. intros. apply (multiple_dot 106 106); units; apply (multiples_cross 53 53); units. Qed.

Lemma height_size : forall a b c s t p, given a -> given b -> given c -> given s -> given t -> given p ->
  Rabs (height_over a b c s t p) <= IZR (3 * S4).
Proof. intros. apply dot_size with (3 * S4)%Z (3 * S4)%Z; try discriminate; now apply normal_size. Qed.

(* i 2^24 h(g) + (2^24 - i) 2^24 h(q), with 2^24 h(g) = G n². *)
Definition weight_after (i G : Z) (all q : R) := all * (IZR i * IZR G) + q * IZR (2 ^ 24 - i) * IZR (2 ^ 24).

(* | the share or the border first: i·h(g) + (2²⁴ − i)·h(q), h the height over a side, times 2²⁴ | 2^-212 | 319 | *)
Theorem share_or_border_fits : forall a b c s t p (i G : Z), given a -> given b -> given c -> given s -> given t -> given p ->
  (0 <= i < 2 ^ 24)%Z -> (0 <= G <= 2 ^ 24)%Z ->
  fits 212 319 (weight_after i G (square (normal a b c)) (height_over a b c s t p)).
Proof.
  intros a b c s t p i G A B C S T P I K. of size (2 ^ 48 * (3 * S4))%Z.
  - apply multiple_plus.
    + apply (multiple_mult 212 0); [lia|lia|apply (multiple_dot 106 106); units|].
      apply (multiple_mult 0 0); try lia; apply multiple_of_integer.
    + apply (multiple_mult 212 0); [lia|lia| |apply multiple_of_integer].
      apply (multiple_mult 212 0); [lia|lia|now apply height_unit|apply multiple_of_integer].
  - pose proof (height_size a b c s t p A B C S T P) as H. pose proof (square_size _ _ (normal_size a b c A B C)) as N.
    unfold weight_after. set (h := height_over a b c s t p) in *. set (n := square (normal a b c)) in *. clearbody h n.
    apply Rle_trans with (1 := Rabs_triang _ _).
    assert (X : Rabs (n * (IZR i * IZR G)) <= IZR (3 * S4 * (i * 2 ^ 24))).
    { apply product_size; [exact N|]. apply product_size; apply size_of_integer; lia. }
    assert (Y : Rabs (h * IZR (2 ^ 24 - i) * IZR (2 ^ 24)) <= IZR (3 * S4 * (2 ^ 24 - i) * 2 ^ 24)).
    { apply product_size; [apply product_size; [exact H|]|]; apply size_of_integer; lia. }
    replace (2 ^ 48 * (3 * S4))%Z with (3 * S4 * (i * 2 ^ 24) + 3 * S4 * (2 ^ 24 - i) * 2 ^ 24)%Z.
    + rewrite plus_IZR. lra.
    + change (2 ^ 48)%Z with (2 ^ 24 * 2 ^ 24)%Z. ring.
Qed.
