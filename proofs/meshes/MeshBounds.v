(* SPDX-License-Identifier: BSD-3-Clause *)
(* How long the integers are that a god-object's decisions are made of (fast/meshes/bits.md): each quantity
   is a whole multiple of its unit, and less than 2 to its number of bits. Lengths are in mm. *)
From Coq Require Import ZArith Reals Lra Lia Psatz.
From Forceshade Require Import Vectors.
Open Scope R_scope.

(* ---- Whole multiples of 2^-u, and integers of so many bits ---- *)

Definition multiple (u : Z) (x : R) := exists k : Z, x * IZR (2 ^ u) = IZR k.
Definition fits (u bits : Z) (x : R) := exists k : Z, x * IZR (2 ^ u) = IZR k /\ (Z.abs k < 2 ^ bits)%Z.

Lemma multiple_plus : forall u x y, multiple u x -> multiple u y -> multiple u (x + y).
Proof. intros u x y [k K] [l L]. exists (k + l)%Z. rewrite plus_IZR, <- K, <- L. ring. Qed.

Lemma multiple_minus : forall u x y, multiple u x -> multiple u y -> multiple u (x - y).
Proof. intros u x y [k K] [l L]. exists (k - l)%Z. rewrite minus_IZR, <- K, <- L. ring. Qed.

Lemma multiple_mult : forall u v x y, (0 <= u)%Z -> (0 <= v)%Z -> multiple u x -> multiple v y -> multiple (u + v) (x * y).
Proof.
  intros u v x y Hu Hv [k K] [l L]. exists (k * l)%Z. rewrite Z.pow_add_r, !mult_IZR, <- K, <- L by assumption. ring.
Qed.

Lemma multiple_of_less : forall u v x, (0 <= u <= v)%Z -> multiple u x -> multiple v x.
Proof.
  intros u v x H [k K]. exists (k * 2 ^ (v - u))%Z. rewrite mult_IZR, <- K.
  replace v with (u + (v - u))%Z at 1 by lia. rewrite Z.pow_add_r, mult_IZR by lia. ring.
Qed.

Lemma multiple_of_integer : forall k : Z, multiple 0 (IZR k).
Proof. intro k. exists k. change (2 ^ 0)%Z with 1%Z. ring. Qed.

Lemma it_fits : forall u bits size x, multiple u x -> Rabs x <= IZR size -> (size * 2 ^ u < 2 ^ bits)%Z -> (0 <= u)%Z -> fits u bits x.
Proof.
  intros u bits size x [k K] H B Hu. exists k. split; [exact K|]. apply lt_IZR. rewrite abs_IZR, <- K, Rabs_mult.
  assert (P : 0 < IZR (2 ^ u)) by (apply IZR_lt; lia). rewrite (Rabs_pos_eq (IZR (2 ^ u))) by lra.
  apply Rle_lt_trans with (IZR size * IZR (2 ^ u)); [apply Rmult_le_compat_r; lra|]. rewrite <- mult_IZR. now apply IZR_lt.
Qed.

Definition multiples (u : Z) (a : vector) := multiple u (x_of a) /\ multiple u (y_of a) /\ multiple u (z_of a).

Lemma multiples_minus : forall u a b, multiples u a -> multiples u b -> multiples u (minus a b).
Proof. intros u a b (A1 & A2 & A3) (B1 & B2 & B3). repeat split; now apply multiple_minus. Qed.

Lemma multiples_of_less : forall u v a, (0 <= u <= v)%Z -> multiples u a -> multiples v a.
Proof. intros u v a H (A1 & A2 & A3). repeat split; now apply multiple_of_less with u. Qed.

Lemma multiple_dot : forall u v a b, (0 <= u)%Z -> (0 <= v)%Z -> multiples u a -> multiples v b -> multiple (u + v) (dot a b).
Proof. intros u v a b Hu Hv (A1 & A2 & A3) (B1 & B2 & B3). repeat apply multiple_plus; now apply multiple_mult. Qed.

Lemma multiples_cross : forall u v a b, (0 <= u)%Z -> (0 <= v)%Z -> multiples u a -> multiples v b -> multiples (u + v) (cross a b).
Proof.
  intros u v a b Hu Hv (A1 & A2 & A3) (B1 & B2 & B3).
  repeat split; apply multiple_minus; now apply multiple_mult.
Qed.

(* ---- The cube that all points are in ---- *)

Definition end_of_domain := 10000%Z.
Definition side := (2 * end_of_domain)%Z.
Definition near (x : R) := - IZR end_of_domain <= x <= IZR end_of_domain.
Definition in_cube (a : vector) := near (x_of a) /\ near (y_of a) /\ near (z_of a).

(* A vertex or a position as it was read, and a point of the grid of a triangle or of an edge. *)
Definition given (a : vector) := in_cube a /\ multiples 53 a.
Definition gridded (g : vector) := in_cube g /\ multiples 77 g.

Lemma given_is_gridded : forall a, given a -> gridded a.
Proof. intros a [C M]. split; [exact C|]. apply multiples_of_less with 53%Z; [lia|exact M]. Qed.

Lemma grid_of_triangle_is_gridded : forall a b c (k l : Z), given a -> given b -> given c -> (0 <= k)%Z -> (0 <= l)%Z -> (k + l <=
  2 ^ 24)%Z ->
  gridded (plus a (plus (scaled (IZR k / IZR (2 ^ 24)) (minus b a)) (scaled (IZR l / IZR (2 ^ 24)) (minus c a)))).
Proof.
  intros a b c k l ([Ax [Ay Az]] & M1 & M2 & M3) ([Bx [By Bz]] & N1 & N2 & N3) ([Cx [Cy Cz]] & O1 & O2 & O3) Hk Hl H.
  apply IZR_le in Hk, Hl, H. rewrite plus_IZR in H. split.
  - assert (One : forall p q r, near p -> near q -> near r ->
        near (p + (IZR k / IZR (2 ^ 24) * (q - p) + IZR l / IZR (2 ^ 24) * (r - p)))).
    { intros p q r Hp Hq Hr. change (IZR (2 ^ 24)) with 16777216 in *.
      set (f := IZR k / 16777216). set (h := IZR l / 16777216).
      assert (0 <= f) by (unfold f; lra). assert (0 <= h) by (unfold h; lra). assert (f + h <= 1) by (unfold f, h; lra).
      clearbody f h. unfold near, end_of_domain in *. split; nra. }
    repeat split; cbn; now apply One.
  - assert (One : forall p q r, multiple 53 p -> multiple 53 q -> multiple 53 r ->
        multiple 77 (p + (IZR k / IZR (2 ^ 24) * (q - p) + IZR l / IZR (2 ^ 24) * (r - p)))).
    { intros p q r [i I] [j J] [m M]. exists (i * 2 ^ 24 + (k * (j - i) + l * (m - i)))%Z.
      change (2 ^ 77)%Z with (2 ^ 53 * 2 ^ 24)%Z.
      rewrite !plus_IZR, !mult_IZR, !minus_IZR, <- I, <- J, <- M. field. apply not_0_IZR. discriminate. }
    repeat split; cbn; now apply One.
Qed.

(* ---- Sizes in the cube ---- *)

Notation S2 := (side * side)%Z.
Notation S3 := (side * side * side)%Z.
Notation S4 := (side * side * side * side)%Z.

Lemma size_from_square : forall x size, (0 <= size)%Z -> x * x <= IZR (size * size) -> Rabs x <= IZR size.
Proof. intros x size Hsize H. apply IZR_le in Hsize. rewrite mult_IZR in H. apply Rabs_le. nra. Qed.

Lemma product_size : forall x y p q, Rabs x <= IZR p -> Rabs y <= IZR q -> Rabs (x * y) <= IZR (p * q).
Proof.
  intros x y p q X Y. rewrite Rabs_mult, mult_IZR. apply Rmult_le_compat; auto; apply Rabs_pos.
Qed.

Lemma dot_size : forall a b p q r, square a <= IZR p -> square b <= IZR q -> (0 <= r)%Z -> (p * q <= r * r)%Z -> Rabs (dot a b) <= IZR r.
Proof.
  intros a b p q r A B Hr H. apply size_from_square; [exact Hr|]. apply Rle_trans with (1 := cauchy_schwarz a b).
  apply Rle_trans with (IZR (p * q)); [|now apply IZR_le]. rewrite mult_IZR.
  apply Rmult_le_compat; auto; apply square_is_not_negative.
Qed.

Lemma cross_size : forall a b p q, square a <= IZR p -> square b <= IZR q -> square (cross a b) <= IZR (p * q).
Proof.
  intros a b p q A B. apply Rle_trans with (1 := cross_is_no_longer a b). rewrite mult_IZR.
  apply Rmult_le_compat; auto; apply square_is_not_negative.
Qed.

Lemma square_size : forall a p, square a <= IZR p -> Rabs (square a) <= IZR p.
Proof. intros a p H. now rewrite Rabs_pos_eq by apply square_is_not_negative. Qed.

(* The square of a distance. *)
Lemma distance_in_cube : forall a b, in_cube a -> in_cube b -> square (minus b a) <= IZR (3 * S2).
Proof.
  intros a b ([? ?] & [? ?] & [? ?]) ([? ?] & [? ?] & [? ?]). change (IZR (3 * S2)) with 1200000000.
  unfold end_of_domain in *. components. nra.
Qed.

(* Twice the area of a triangle in a square is at most the square's. *)
Lemma area_in_square : forall ax ay bx by_ cx cy, near ax -> near ay -> near bx -> near by_ -> near cx -> near cy ->
  - IZR S2 <= (bx - ax) * (cy - ay) - (by_ - ay) * (cx - ax) <= IZR S2.
Proof.
  unfold near, end_of_domain. intros. change (IZR S2) with 400000000.
  set (u := bx - ax). set (v := cx - ax). set (s := by_ - ay). set (t := cy - ay).
  assert (-20000 <= u <= 20000) by (unfold u; lra). assert (-20000 <= v <= 20000) by (unfold v; lra).
  assert (-20000 <= s <= 20000) by (unfold s; lra). assert (-20000 <= t <= 20000) by (unfold t; lra).
  assert (-20000 <= u - v <= 20000) by (unfold u, v; lra). assert (-20000 <= s - t <= 20000) by (unfold s, t; lra).
  clearbody u v s t.
  destruct (Rle_or_lt 0 u), (Rle_or_lt 0 v), (Rle_or_lt 0 s), (Rle_or_lt 0 t); split; nra.
Qed.

(* The square of the size of (b - a) x (c - a). *)
Lemma area_in_cube : forall a b c, in_cube a -> in_cube b -> in_cube c -> square (normal a b c) <= IZR (3 * S4).
Proof.
  intros [ax ay az] [bx by_ bz] [cx cy cz] (? & ? & ?) (? & ? & ?) (? & ? & ?). cbn [x_of y_of z_of] in *.
  pose proof (area_in_square ay az by_ bz cy cz) as X. pose proof (area_in_square az ax bz bx cz cx) as Y.
  pose proof (area_in_square ax ay bx by_ cx cy) as Z. components.
  replace (IZR (3 * S4)) with (3 * (IZR S2 * IZR S2)) by (rewrite <- !mult_IZR; f_equal).
  assert (One : forall x, - IZR S2 <= x <= IZR S2 -> x * x <= IZR S2 * IZR S2) by (intros; nra).
  apply One in X, Y, Z; try assumption. lra.
Qed.

(* A cross product of two diagonals. *)
Lemma diagonals_in_square : forall ax ay bx by_ cx cy dx dy, near ax -> near ay -> near bx -> near by_ -> near cx -> near cy -> near dx ->
  near dy -> - (2 * IZR S2) <= (bx - ax) * (dy - cy) - (by_ - ay) * (dx - cx) <= 2 * IZR S2.
Proof.
  unfold near, end_of_domain. intros. change (IZR S2) with 400000000.
  set (u := bx - ax). set (t := dy - cy). set (s := by_ - ay). set (v := dx - cx).
  assert (-20000 <= u <= 20000) by (unfold u; lra). assert (-20000 <= v <= 20000) by (unfold v; lra).
  assert (-20000 <= s <= 20000) by (unfold s; lra). assert (-20000 <= t <= 20000) by (unfold t; lra).
  clearbody u v s t. split; nra.
Qed.

Ltac in_domain H := repeat match type of H with near _ -> _ => specialize (H ltac:(assumption)) end.

(* Six times the volume of a tetrahedron: its four heights along x, each times twice the area of the other three corners as seen along
   x. These areas have the sum 0, so that those above 0 have half the sum of all sizes. *)
Lemma volume_in_cube : forall a b c d, in_cube a -> in_cube b -> in_cube c -> in_cube d -> Rabs (dot (normal a b c) (minus d a)) <=
  IZR (2 * S3).
Proof.
  intros [ax ay az] [bx by_ bz] [cx cy cz] [dx dy dz] (? & ? & ?) (? & ? & ?) (? & ? & ?) (? & ? & ?). cbn [x_of y_of z_of] in *.
  set (A := (by_ - dy) * (cz - dz) - (bz - dz) * (cy - dy)). set (B := (cy - dy) * (az - dz) - (cz - dz) * (ay - dy)).
  set (C := (ay - dy) * (bz - dz) - (az - dz) * (by_ - dy)). set (D := (by_ - ay) * (cz - az) - (bz - az) * (cy - ay)).
  pose proof (area_in_square dy dz by_ bz cy cz) as HA. pose proof (area_in_square dy dz cy cz ay az) as HB.
  pose proof (area_in_square dy dz ay az by_ bz) as HC. pose proof (area_in_square ay az by_ bz cy cz) as HD.
  pose proof (diagonals_in_square dy dz cy cz by_ bz ay az) as HAB. pose proof (diagonals_in_square dy dz by_ bz ay az cy cz) as HAC.
  pose proof (diagonals_in_square dy dz ay az cy cz by_ bz) as HBC.
  assert (E : dot (normal (Vector ax ay az) (Vector bx by_ bz) (Vector cx cy cz)) (minus (Vector dx dy dz) (Vector ax ay az)) =
    dx * D - (ax * A + bx * B + cx * C)) by (unfold A, B, C, D; components; ring).
  rewrite E. clear E.
  assert (Sum : D = A + B + C) by (unfold A, B, C, D; ring).
  in_domain HA. in_domain HB. in_domain HC. in_domain HD. in_domain HAB. in_domain HAC. in_domain HBC.
  fold A in HA. fold B in HB. fold C in HC. fold D in HD.
  replace ((cy - dy) * (az - bz) - (cz - dz) * (ay - by_)) with (A + B) in HAB by (unfold A, B; ring).
  replace ((by_ - dy) * (cz - az) - (bz - dz) * (cy - ay)) with (A + C) in HAC by (unfold A, C; ring).
  replace ((ay - dy) * (bz - cz) - (az - dz) * (by_ - cy)) with (B + C) in HBC by (unfold B, C; ring).
  clearbody A B C D. unfold near, end_of_domain in *. change (IZR S2) with 400000000 in *. change (IZR (2 * S3)) with 16000000000000.
  assert (Term : forall x Q, -10000 <= x <= 10000 -> - (10000 * Rabs Q) <= x * Q <= 10000 * Rabs Q).
  { intros x Q Hx. unfold Rabs. destruct (Rcase_abs Q); split; nra. }
  pose proof (Term ax A ltac:(assumption)) as TA. pose proof (Term bx B ltac:(assumption)) as TB.
  pose proof (Term cx C ltac:(assumption)) as TC. pose proof (Term dx D ltac:(assumption)) as TD. clear Term.
  apply Rabs_le. revert TA TB TC TD.
  unfold Rabs. destruct (Rcase_abs A), (Rcase_abs B), (Rcase_abs C), (Rcase_abs D); intros; split; lra.
Qed.


(* ---- The table. Above each theorem are the lines of fast/meshes/bits.md that it proves. ---- *)

Lemma edge_unit : forall a b, given a -> given b -> multiples 53 (minus b a).
Proof. intros a b [_ A] [_ B]. now apply multiples_minus. Qed.

Lemma way_unit : forall g p, gridded g -> gridded p -> multiples 77 (minus p g).
Proof. intros g p [_ G] [_ P]. now apply multiples_minus. Qed.

Lemma normal_unit : forall a b c, given a -> given b -> given c -> multiples 106 (normal a b c).
Proof. intros. apply (multiples_cross 53 53); (lia || now apply edge_unit). Qed.

Lemma edge_size : forall a b, given a -> given b -> square (minus b a) <= IZR (3 * S2).
Proof. intros a b [A _] [B _]. now apply distance_in_cube. Qed.

Lemma way_size : forall g p, gridded g -> gridded p -> square (minus p g) <= IZR (3 * S2).
Proof. intros g p [G _] [P _]. now apply distance_in_cube. Qed.

Lemma normal_size : forall a b c, given a -> given b -> given c -> square (normal a b c) <= IZR (3 * S4).
Proof. intros a b c [A _] [B _] [C _]. now apply area_in_cube. Qed.

Ltac sizes := eauto using given_is_gridded, edge_size, way_size, normal_size, square_size, cross_size.
Ltac units := try lia; eauto using edge_unit, way_unit, normal_unit, given_is_gridded.

(* A size of a product of sizes, and the number of its bits. *)
Tactic Notation "of" "size" constr(size) := apply it_fits with size; [| |reflexivity|lia].

Lemma across_size : forall a b c x, given a -> given b -> given c -> gridded x -> Rabs (dot (normal a b c) (minus x a)) <= IZR (2 * S3).
Proof. intros a b c x [A _] [B _] [C _] [X _]. now apply volume_in_cube. Qed.

Lemma along_size : forall a b g p, given a -> given b -> gridded g -> gridded p -> Rabs (dot (minus b a) (minus p g)) <= IZR (3 * S2).
Proof. intros. apply dot_size with (3 * S2)%Z (3 * S2)%Z; sizes; discriminate. Qed.

(* | n·(p − a), a corner of the triangle | 2^-159 | 203 | *)
Theorem side_of_plane_fits : forall a b c p, given a -> given b -> given c -> given p -> fits 159 203 (dot (normal a b c) (minus p a)).
Proof.
  intros. of size (2 * S3)%Z; [apply (multiple_dot 106 53); units|]. apply across_size; auto using given_is_gridded.
Qed.

(* | e·(p − a), a a vertex | 2^-106 | 137 | *)
Theorem along_edge_fits : forall a b p, given a -> given b -> given p -> fits 106 137 (dot (minus b a) (minus p a)).
Proof.
  intros. of size (3 * S2)%Z; [apply (multiple_dot 53 53); units|]. apply along_size; auto using given_is_gridded.
Qed.

(* | e·(p − g), g of the grid | 2^-130 | 161 | *)
Theorem along_edge_from_grid_fits : forall a b g p, given a -> given b -> gridded g -> given p ->
  fits 130 161 (dot (minus b a) (minus p g)).
Proof.
  intros. of size (3 * S2)%Z; [apply (multiple_dot 53 77); units|]. apply along_size; auto using given_is_gridded.
Qed.

(* | n·((b − a) × (p − a)) | 2^-212 | 271 | *)
Theorem inside_fits : forall a b c p, given a -> given b -> given c -> given p ->
  fits 212 271 (dot (normal a b c) (cross (minus b a) (minus p a))).
Proof.
  intros. of size (3 * S4)%Z; [apply (multiple_dot 106 106); units|].
  apply dot_size with (3 * S4)%Z (3 * S4)%Z; sizes; try discriminate.
Qed.

(* | n·((g − w) × (p − w)), g of the grid | 2^-236 | 295 | *)
Theorem inside_from_grid_fits : forall a b c g w p, given a -> given b -> given c -> gridded g -> given w -> given p ->
  fits 236 295 (dot (normal a b c) (cross (minus g w) (minus p w))).
Proof.
  intros a b c g w p A B C G W P. of size (3 * S4)%Z.
  - apply (multiple_dot 106 130); units; apply (multiples_cross 77 53); units.
  - apply dot_size with (3 * S4)%Z (3 * S4)%Z; sizes; try discriminate.
    apply (area_in_cube w g p); [apply W|apply G|apply P].
Qed.

(* | two edges at a vertex: (e₁·u)² e₂² | 2^-318 | 409 | *)
Theorem two_edges_fit : forall a b c p, given a -> given b -> given c -> given p ->
  fits 318 409 (dot (minus b a) (minus p a) * dot (minus b a) (minus p a) * square (minus c a)).
Proof.
  intros. of size (3 * S2 * (3 * S2) * (3 * S2))%Z.
  - apply (multiple_mult 212 106); [lia|lia|apply (multiple_mult 106 106)|]; units; apply (multiple_dot 53 53); units.
  - repeat apply product_size; try solve [apply along_size; auto using given_is_gridded]; sizes.
Qed.

(* | an edge and a triangle: (e·u)² n² | 2^-424 | 544 | *)
Theorem edge_and_triangle_fit : forall a b c d e p, given a -> given b -> given c -> given d -> given e -> given p ->
  fits 424 544 (dot (minus b a) (minus p a) * dot (minus b a) (minus p a) * square (normal c d e)).
Proof.
  intros. of size (3 * S2 * (3 * S2) * (3 * S4))%Z.
  - apply (multiple_mult 212 212); [lia|lia|apply (multiple_mult 106 106)|apply (multiple_dot 106 106)]; units;
    apply (multiple_dot 53 53); units.
  - repeat apply product_size; try solve [apply along_size; auto using given_is_gridded]; sizes.
Qed.

(* | two triangles: (n₁·u)² n₂² | 2^-530 | 677 | *)
Theorem two_triangles_fit : forall a b c d e f p, given a -> given b -> given c -> given d -> given e -> given f -> given p ->
  fits 530 677 (dot (normal a b c) (minus p a) * dot (normal a b c) (minus p a) * square (normal d e f)).
Proof.
  intros. of size (2 * S3 * (2 * S3) * (3 * S4))%Z.
  - apply (multiple_mult 318 212); [lia|lia|apply (multiple_mult 159 159)|apply (multiple_dot 106 106)]; units;
    apply (multiple_dot 106 53); units.
  - repeat apply product_size; try solve [apply across_size; auto using given_is_gridded]; sizes.
Qed.

(* | u on an edge: (e·u)² and e² u² | 2^-212 | 273 | *)
Theorem on_edge_fits : forall a b p, given a -> given b -> given p ->
  fits 212 273 (dot (minus b a) (minus p a) * dot (minus b a) (minus p a)) /\ fits 212 273 (square (minus b a) * square (minus p a)).
Proof.
  intros. split; of size (3 * S2 * (3 * S2))%Z; try (apply (multiple_mult 106 106); units; apply (multiple_dot 53 53); units);
    apply product_size; try solve [apply along_size; auto using given_is_gridded]; sizes.
Qed.

(* | n·(a − g), and the weights of a triangle's corners | 2^-183 | 227 | *)
Theorem plane_from_grid_fits : forall a b c g, given a -> given b -> given c -> gridded g ->
  fits 183 227 (dot (normal a b c) (minus a g)).
Proof.
  intros a b c g A B C G. of size (2 * S3)%Z; [apply (multiple_dot 106 77); units|].
  replace (dot (normal a b c) (minus a g)) with (- dot (normal a b c) (minus g a)) by (components; ring).
  rewrite Rabs_Ropp. now apply across_size.
Qed.

Lemma across_way_size : forall a b c g p, given a -> given b -> given c -> gridded g -> given p ->
  Rabs (dot (normal a b c) (minus p g)) <= IZR (3 * S3).
Proof. intros. apply dot_size with (3 * S4)%Z (3 * S2)%Z; sizes; discriminate. Qed.

(* | n·(p − g), g anywhere on the grid | 2^-183 | 228 | *)
Theorem way_across_plane_fits : forall a b c g p, given a -> given b -> given c -> gridded g -> given p ->
  fits 183 228 (dot (normal a b c) (minus p g)).
Proof. intros. of size (3 * S3)%Z; [apply (multiple_dot 106 77); units|]. now apply across_way_size. Qed.

(* The way counts its 24 bits once: from g to a vertex, or from g to p. *)
Lemma passes_edge : forall a b g p, dot (minus a g) (cross (minus p g) (minus b a)) = dot (minus a g) (cross (minus p a) (minus b a)).
Proof. intros. components. ring. Qed.

Lemma passes_unit : forall a b g p, given a -> given b -> gridded g -> given p ->
  multiple 183 (dot (minus a g) (cross (minus p g) (minus b a))).
Proof. intros. rewrite passes_edge. apply (multiple_dot 77 106); units; apply (multiples_cross 53 53); units. Qed.

Lemma passes_size : forall a b g p, given a -> given b -> gridded g -> given p ->
  Rabs (dot (minus a g) (cross (minus p g) (minus b a))) <= IZR (2 * S3).
Proof.
  intros a b g p A B G P.
  replace (dot (minus a g) (cross (minus p g) (minus b a))) with (dot (normal a b p) (minus g a)) by (components; ring).
  now apply across_size.
Qed.

(* | (a − g)·((p − g) × e) | 2^-183 | 227 | *)
Theorem passes_edge_fits : forall a b g p, given a -> given b -> gridded g -> given p ->
  fits 183 227 (dot (minus a g) (cross (minus p g) (minus b a))).
Proof. intros. of size (2 * S3)%Z; [now apply passes_unit|now apply passes_size]. Qed.

(* | two crossings of triangles: n₁·(a₁ − g) n₂·(p − g) | 2^-366 | 455 | *)
Theorem two_crossings_fit : forall a b c d e f g p, given a -> given b -> given c -> given d -> given e -> given f -> gridded g ->
  given p ->
  fits 366 455 (dot (normal a b c) (minus a g) * dot (normal d e f) (minus p g)).
Proof.
  intros a b c d e f g p A B C D E F G P. of size (2 * S3 * (3 * S3))%Z.
  - apply (multiple_mult 183 183); units; apply (multiple_dot 106 77); units.
  - apply product_size; [|now apply across_way_size].
    replace (dot (normal a b c) (minus a g)) with (- dot (normal a b c) (minus g a)) by (components; ring).
    rewrite Rabs_Ropp. now apply across_size.
Qed.

(* | t of an edge that is crossed, times 2²⁴ | 2^-284 | 345 | *)
Theorem crossed_edge_fits : forall a b g p, given a -> given b -> gridded g -> given p ->
  fits 284 345 (dot (cross (minus a g) (minus p g)) (cross (minus p g) (minus b a))) /\ fits 284 345 (square (cross (minus p g)
    (minus b a))).
Proof.
  intros a b g p A B G P.
  assert (U : multiples 130 (cross (minus p g) (minus b a))) by (apply (multiples_cross 77 53); units).
  assert (L : square (cross (minus p g) (minus b a)) <= IZR (3 * S2 * (3 * S2))) by (apply cross_size; sizes; apply way_size;
    auto using given_is_gridded).
  split.
  - of size (9 * S4)%Z.
    + apply multiple_of_less with 260%Z; [lia|]. apply (multiple_dot 130 130); units.
      replace (cross (minus a g) (minus p g)) with (cross (minus a g) (minus p a)) by (components; f_equal; ring).
      apply (multiples_cross 77 53); units.
    + apply dot_size with (3 * S4)%Z (3 * S2 * (3 * S2))%Z; try discriminate; [|exact L].
      apply (area_in_cube g a p); [apply G|apply A|apply P].
  - of size (3 * S2 * (3 * S2))%Z; [|now apply square_size].
    apply multiple_of_less with 260%Z; [lia|]. apply (multiple_dot 130 130); units.
Qed.

(* | β of a triangle that is crossed, times 2²⁴ | 2^-207 | 251 | *)
Theorem crossed_triangle_fits : forall a b g p, given a -> given b -> gridded g -> given p ->
  fits 207 251 (dot (minus a g) (cross (minus p g) (minus b a))).
Proof.
  intros. of size (2 * S3)%Z; [|now apply passes_size]. apply multiple_of_less with 183%Z; [lia|now apply passes_unit].
Qed.

(* | ‖x − p‖², x of the grid | 2^-154 | 185 | *)
Theorem distance_fits : forall g p, gridded g -> given p -> fits 154 185 (square (minus p g)).
Proof.
  intros. of size (3 * S2)%Z; [apply (multiple_dot 77 77); units|]. apply square_size, way_size; auto using given_is_gridded.
Qed.

(* | t of a foot, times 2²⁵ | 2^-131 | 162 | *)
Theorem foot_on_edge_fits : forall a b p, given a -> given b -> given p ->
  fits 131 162 (dot (minus b a) (minus p a)) /\ fits 131 162 (square (minus b a)).
Proof.
  intros. split; of size (3 * S2)%Z; try (apply multiple_of_less with 106%Z; [lia|]; apply (multiple_dot 53 53); units);
    [apply along_size; auto using given_is_gridded|sizes].
Qed.

(* | β of a foot, times 2²⁵ | 2^-237 | 296 | *)
Theorem foot_in_triangle_fits : forall a b c p, given a -> given b -> given c -> given p ->
  fits 237 296 (dot (normal a b c) (cross (minus b a) (minus p a))) /\ fits 237 296 (square (normal a b c)).
Proof.
  intros. split; of size (3 * S4)%Z; try (apply multiple_of_less with 212%Z; [lia|]; apply (multiple_dot 106 106); units).
  - apply dot_size with (3 * S4)%Z (3 * S4)%Z; sizes; try discriminate.
  - sizes.
Qed.

(* | where a way beside a sheet ends, times 2²⁴: (n₁ × n₂)² | 2^-448 | 566 | *)
Theorem beside_a_sheet_fits : forall a b c d e f, given a -> given b -> given c -> given d -> given e -> given f ->
  fits 448 566 (square (cross (normal a b c) (normal d e f))).
Proof.
  intros. of size (3 * S4 * (3 * S4))%Z; [|sizes].
  apply multiple_of_less with 424%Z; [lia|]. apply (multiple_dot 212 212); units; apply (multiples_cross 106 106); units.
Qed.

(* | p's foot on another sheet: n₁·(p − a₁) n₂² | 2^-371 | 474 | *)
Theorem foot_on_a_sheet_fits : forall a b c d e f p, given a -> given b -> given c -> given d -> given e -> given f -> given p ->
  fits 371 474 (dot (normal a b c) (minus p a) * square (normal d e f)).
Proof.
  intros. of size (2 * S3 * (3 * S4))%Z.
  - apply (multiple_mult 159 212); units; [apply (multiple_dot 106 53)|apply (multiple_dot 106 106)]; units.
  - apply product_size; [apply across_size; auto using given_is_gridded|sizes].
Qed.

(* | two crossings in a plane, from grid to grid | 2^-520 | 641 | *)
Theorem two_crossings_in_a_plane_fit : forall a b c d g h, given a -> given b -> given c -> given d -> gridded g -> gridded h ->
  fits 520 641 (dot (cross (minus a g) (minus b a)) (cross (minus h g) (minus b a)) * square (cross (minus h g) (minus d c))).
Proof.
  intros a b c d g h A B C D G K.
  assert (U : forall x y, given x -> given y -> multiples 130 (cross (minus h g) (minus y x))) by (intros;
    apply (multiples_cross 77 53); units).
  assert (L : forall x y, given x -> given y -> square (cross (minus h g) (minus y x)) <= IZR (3 * S2 * (3 * S2))) by (intros;
    apply cross_size; sizes).
  of size (9 * S4 * (3 * S2 * (3 * S2)))%Z.
  - apply (multiple_mult 260 260); units; apply (multiple_dot 130 130); units; apply (multiples_cross 77 53); units.
  - apply product_size; [|now apply square_size, L].
    apply dot_size with (3 * S4)%Z (3 * S2 * (3 * S2))%Z; try discriminate; [|now apply L].
    replace (cross (minus a g) (minus b a)) with (normal g a b) by (components; f_equal; ring).
    apply area_in_cube; [apply G|apply A|apply B].
Qed.

Lemma size_of_integer : forall k most : Z, (0 <= k <= most)%Z -> Rabs (IZR k) <= IZR most.
Proof. intros k most [H K]. apply IZR_le in H, K. rewrite Rabs_pos_eq; lra. Qed.

(* | the square of a way's length, from grid to grid, times m² | 2^-154 | 233 | *)
Theorem part_of_a_way_fits : forall g h (m : Z), gridded g -> gridded h -> (0 <= m < 2 ^ 24)%Z ->
  fits 154 233 (square (minus h g) * (IZR m * IZR m)).
Proof.
  intros g h m G K M. of size (3 * S2 * ((2 ^ 24) * (2 ^ 24)))%Z.
  - apply (multiple_mult 154 0); units; [apply (multiple_dot 77 77); units|apply (multiple_mult 0 0); try lia; apply multiple_of_integer].
  - repeat apply product_size; [now apply square_size, way_size| |]; apply size_of_integer; lia.
Qed.

(* ---- Friction ---- *)

Definition coefficient (mu : R) := multiple 33 mu /\ 0 <= mu <= IZR (2 ^ 10).

(* k + μ². *)
Lemma with_coefficient : forall mu (k : Z), coefficient mu -> (0 <= k)%Z ->
  multiple 66 (IZR k + mu * mu) /\ Rabs (IZR k + mu * mu) <= IZR (k + 2 ^ 20).
Proof.
  intros mu k [M [L H]] K. split.
  - apply multiple_plus; [apply multiple_of_less with 0%Z; [lia|apply multiple_of_integer]|now apply (multiple_mult 33 33)].
  - apply IZR_le in K. rewrite plus_IZR. change (IZR (2 ^ 10)) with 1024 in H. change (IZR (2 ^ 20)) with 1048576. rewrite
    Rabs_pos_eq; nra.
Qed.

Lemma pull_unit : forall a b c g p, given a -> given b -> given c -> gridded g -> given p ->
  multiple 366 (square (minus p g) * square (normal a b c)).
Proof. intros. apply (multiple_mult 154 212); units; [apply (multiple_dot 77 77)|apply (multiple_dot 106 106)]; units. Qed.

Lemma pull_size : forall a b c g p, given a -> given b -> given c -> gridded g -> given p ->
  Rabs (square (minus p g) * square (normal a b c)) <= IZR (3 * S2 * (3 * S4)).
Proof. intros. apply product_size; sizes. Qed.

Lemma pressure_unit : forall a b c p, given a -> given b -> given c -> given p ->
  multiple 318 (dot (normal a b c) (minus p a) * dot (normal a b c) (minus p a)).
Proof. intros. apply (multiple_mult 159 159); units; apply (multiple_dot 106 53); units. Qed.

Lemma pressure_size : forall a b c p, given a -> given b -> given c -> given p ->
  Rabs (dot (normal a b c) (minus p a) * dot (normal a b c) (minus p a)) <= IZR (2 * S3 * (2 * S3)).
Proof. intros. apply product_size; apply across_size; auto using given_is_gridded. Qed.

(* | it sticks, in a triangle: u²n² ≤ (1 + μ²)(n·w)² | 2^-384 | 492 | *)
Theorem sticking_in_a_triangle_fits : forall a b c g p mu, given a -> given b -> given c -> gridded g -> given p -> coefficient mu ->
  fits 384 492 (square (minus p g) * square (normal a b c)) /\
  fits 384 492 ((1 + mu * mu) * (dot (normal a b c) (minus p a) * dot (normal a b c) (minus p a))).
Proof.
  intros a b c g p mu A B C G P M. destruct (with_coefficient mu 1 M ltac:(lia)) as [U L]. split.
  - of size (3 * S2 * (3 * S4))%Z; [|now apply pull_size]. apply multiple_of_less with 366%Z; [lia|now apply pull_unit].
  - of size ((1 + 2 ^ 20) * (2 * S3 * (2 * S3)))%Z.
    + apply (multiple_mult 66 318); units; now apply pressure_unit.
    + apply product_size; [exact L|now apply pressure_size].
Qed.

Lemma along_square_unit : forall a b g p, given a -> given b -> gridded g -> given p ->
  multiple 260 (dot (minus b a) (minus p g) * dot (minus b a) (minus p g)) /\ multiple 260 (square (minus p g) * square (minus b a)).
Proof.
  intros. split; [apply (multiple_mult 130 130); units; apply (multiple_dot 53 77); units|].
  apply (multiple_mult 154 106); units; [apply (multiple_dot 77 77)|apply (multiple_dot 53 53)]; units.
Qed.

Lemma along_square_size : forall a b g p, given a -> given b -> gridded g -> given p ->
  Rabs (dot (minus b a) (minus p g) * dot (minus b a) (minus p g)) <= IZR (3 * S2 * (3 * S2)) /\
  Rabs (square (minus p g) * square (minus b a)) <= IZR (3 * S2 * (3 * S2)).
Proof.
  intros. split; apply product_size; try solve [apply along_size; auto using given_is_gridded]; apply square_size, way_size;
    auto using given_is_gridded.
Qed.

(* | it sticks, along an edge: (1 + μ²)(e·u)² ≤ μ²u²e² | 2^-326 | 407 | *)
Theorem sticking_along_an_edge_fits : forall a b g p mu, given a -> given b -> gridded g -> given p -> coefficient mu ->
  fits 326 407 ((1 + mu * mu) * (dot (minus b a) (minus p g) * dot (minus b a) (minus p g))) /\
  fits 326 407 ((0 + mu * mu) * (square (minus p g) * square (minus b a))).
Proof.
  intros a b g p mu A B G P M. destruct (along_square_unit a b g p A B G P), (along_square_size a b g p A B G P).
  split; [destruct (with_coefficient mu 1 M ltac:(lia)); of size ((1 + 2 ^ 20) * (3 * S2 * (3 * S2)))%Z
         |destruct (with_coefficient mu 0 M ltac:(lia)); of size ((0 + 2 ^ 20) * (3 * S2 * (3 * S2)))%Z];
    (now apply (multiple_mult 66 260)) || now apply product_size.
Qed.

Lemma difference_size : forall x y size, 0 <= x -> 0 <= y -> Rabs x <= IZR size -> Rabs y <= IZR size -> Rabs (x - y) <= IZR size.
Proof. intros x y size X Y HX HY. rewrite Rabs_pos_eq in HX, HY by assumption. apply Rabs_le. lra. Qed.

(* | i, in a triangle: i²(u²n² − (n·w)²) ≤ 2⁴⁸μd²(n·w)² | 2^-384 | 540 | *)
Theorem share_in_a_triangle_fits : forall a b c g p mu (i : Z), given a -> given b -> given c -> gridded g -> given p -> coefficient mu ->
  (0 <= i < 2 ^ 24)%Z ->
  fits 384 540 (IZR i * IZR i * (square (minus p g) * square (normal a b c) - dot (normal a b c) (minus p a) *
    dot (normal a b c) (minus p a))) /\
  fits 384 540 (IZR (2 ^ 48) * (0 + mu * mu) * (dot (normal a b c) (minus p a) * dot (normal a b c) (minus p a))).
Proof.
  intros a b c g p mu i A B C G P M I. destruct (with_coefficient mu 0 M ltac:(lia)) as [U L]. split.
  - of size (2 ^ 24 * 2 ^ 24 * (3 * S2 * (3 * S4)))%Z.
    + apply multiple_of_less with 366%Z; [lia|]. apply (multiple_mult 0 366); units.
      * apply (multiple_mult 0 0); try lia; apply multiple_of_integer.
      * apply multiple_minus; [now apply pull_unit|]. apply multiple_of_less with 318%Z; [lia|now apply pressure_unit].
    + repeat apply product_size; try (apply size_of_integer; lia). apply difference_size.
      * apply Rmult_le_pos; apply square_is_not_negative.
      * apply Rle_0_sqr.
      * now apply pull_size.
      * apply Rle_trans with (1 := pressure_size a b c p A B C P). now apply IZR_le.
  - of size (2 ^ 48 * (0 + 2 ^ 20) * (2 * S3 * (2 * S3)))%Z.
    + apply (multiple_mult 66 318); units; [|now apply pressure_unit]. apply (multiple_mult 0 66); units. apply multiple_of_integer.
    + apply product_size; [apply product_size; [now apply size_of_integer|exact L]|now apply pressure_size].
Qed.

(* | i, along an edge: i²(e·u)² ≤ 2⁴⁸μd²(u²e² − (e·u)²) | 2^-326 | 455 | *)
Theorem share_along_an_edge_fits : forall a b g p mu (i : Z), given a -> given b -> gridded g -> given p -> coefficient mu -> (0 <=
  i < 2 ^ 24)%Z ->
  fits 326 455 (IZR i * IZR i * (dot (minus b a) (minus p g) * dot (minus b a) (minus p g))) /\
  fits 326 455 (IZR (2 ^ 48) * (0 + mu * mu) * (square (minus p g) * square (minus b a) - dot (minus b a) (minus p g) *
    dot (minus b a) (minus p g))).
Proof.
  intros a b g p mu i A B G P M I. destruct (with_coefficient mu 0 M ltac:(lia)) as [U L].
  destruct (along_square_unit a b g p A B G P) as [U1 U2], (along_square_size a b g p A B G P) as [L1 L2]. split.
  - of size (2 ^ 24 * 2 ^ 24 * (3 * S2 * (3 * S2)))%Z.
    + apply multiple_of_less with 260%Z; [lia|]. apply (multiple_mult 0 260); units; apply (multiple_mult 0 0); try lia;
      apply multiple_of_integer.
    + apply product_size; [|exact L1]. apply product_size; apply size_of_integer; lia.
  - of size (2 ^ 48 * (0 + 2 ^ 20) * (3 * S2 * (3 * S2)))%Z.
    + apply (multiple_mult 66 260); units; [apply (multiple_mult 0 66); units; apply multiple_of_integer|now apply multiple_minus].
    + apply product_size; [apply product_size; [now apply size_of_integer|exact L]|]. apply difference_size; auto.
      * apply Rmult_le_pos; apply square_is_not_negative.
      * apply Rle_0_sqr.
Qed.

(* | the bit, in a triangle: 4u²n² > (4 + μd²)(n·w)² | 2^-384 | 492 | *)
Theorem keeping_the_bit_fits : forall a b c g p mu, given a -> given b -> given c -> gridded g -> given p -> coefficient mu ->
  fits 384 492 (4 * (square (minus p g) * square (normal a b c))) /\
  fits 384 492 ((4 + mu * mu) * (dot (normal a b c) (minus p a) * dot (normal a b c) (minus p a))).
Proof.
  intros a b c g p mu A B C G P M. destruct (with_coefficient mu 4 M ltac:(lia)) as [U L]. split.
  - of size (4 * (3 * S2 * (3 * S4)))%Z.
    + apply multiple_of_less with 366%Z; [lia|]. apply (multiple_mult 0 366); units; [apply multiple_of_integer|now apply pull_unit].
    + apply product_size; [now apply size_of_integer|now apply pull_size].
  - of size ((4 + 2 ^ 20) * (2 * S3 * (2 * S3)))%Z.
    + apply (multiple_mult 66 318); units; now apply pressure_unit.
    + apply product_size; [exact L|now apply pressure_size].
Qed.
