(* SPDX-License-Identifier: BSD-3-Clause *)
(* How long the integers of a shaded force are where friction takes a part of it: rows seven and eight of the table of bits in
   docs/friction.md, "Arithmetic", in the form of those in MeshBounds.v. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List.
From Forceshade Require Import Vectors MeshBounds MeshBoundsMoves MeshBoundsShaded.
Import ListNotations.
Open Scope R_scope.

(* A corner's normal of any finite numbers of binary32, and N of such with whole weights, 2^24 in all: shading_normal_is, and
   normals_between_two. *)
Definition any_normal : vector -> Prop := normal_within (2 ^ 128).
Definition between_normals : vector -> Prop := normal_within (2 ^ 24 * 2 ^ 128).

(* The middle of two neighbours in binary32, one of which a component of the force may be. *)
Definition a_tie (m : R) := multiple 150 m /\ Rabs m <= IZR (2 ^ 26).

(* along_and() of fast/meshes/rounded.h. `way` is q - p times `all`, and by_ is a component of r - q times 2^24 all
   (RestNumbers::way_of_pull()). of_root over 2^48 is square_of_size; this is what it is compared with, over 2^48. *)
Definition rest_squared (m K all by_ : R) (N : vector) :=
  (m * all - K * (by_ / IZR (2 ^ 24))) * (m * all - K * (by_ / IZR (2 ^ 24))) * square N.

Lemma over_grid_unit : forall u x, (0 <= u)%Z -> multiple u x -> multiple (u + 24) (x / IZR (2 ^ 24)).
Proof.
  intros u x U [k K]. exists k. rewrite <- K, Z.pow_add_r, mult_IZR by lia. field. apply not_0_IZR. discriminate.
Qed.

Lemma over_grid_size : forall x size, Rabs x <= IZR (size * 2 ^ 24) -> Rabs (x / IZR (2 ^ 24)) <= IZR size.
Proof.
  intros x size H. rewrite mult_IZR in H. assert (P : 0 < IZR (2 ^ 24)) by (apply IZR_lt; reflexivity).
  unfold Rdiv. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq (IZR (2 ^ 24))) by lra.
  apply Rmult_le_reg_r with (IZR (2 ^ 24)); [exact P|]. rewrite Rmult_assoc, Rinv_l by lra. lra.
Qed.

Notation most_between := (2 ^ 24 * 2 ^ 128)%Z.
Notation most_rest := (2 ^ 26 + 2 ^ 10 * 34642)%Z.  (* 34642 mm: the longest way in the cube, √3 S *)

(* all: a multiple of 2^-u of this size. *)
Lemma rest_is : forall u v size m K all by_ N, (0 <= u)%Z -> (0 <= v)%Z -> (v + 57 <= u + 150)%Z -> a_tie m -> a_stiffness K ->
  between_normals N -> multiple u all -> Rabs all <= IZR size -> multiple v by_ -> Rabs by_ <= IZR (size * 34642 * 2 ^ 24) ->
  multiple (2 * (u + 150) + 298) (rest_squared m K all by_ N) /\
  Rabs (rest_squared m K all by_ N) <= IZR (size * most_rest * (size * most_rest) * (3 * (most_between * most_between))).
Proof.
  intros u v size m K all by_ N U V B [MU ML] [KU KL] [NU NL] AU AL PU PL. unfold rest_squared.
  set (rest := m * all - K * (by_ / IZR (2 ^ 24))).
  assert (RU : multiple (u + 150) rest).
  { apply multiple_minus.
    - rewrite Z.add_comm. apply multiple_mult; (lia || assumption).
    - apply multiple_of_less with (33 + (v + 24))%Z; [lia|]. apply multiple_mult; [lia|lia|exact KU|now apply over_grid_unit]. }
  assert (RL : Rabs rest <= IZR (size * most_rest)).
  { unfold rest, Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp.
    pose proof (product_size _ _ _ _ ML AL) as X. pose proof (product_size _ _ _ _ KL (over_grid_size _ _ PL)) as Y.
    replace (size * most_rest)%Z with (2 ^ 26 * size + 2 ^ 10 * (size * 34642))%Z by ring. rewrite plus_IZR. lra. }
  clearbody rest. split.
  - replace (2 * (u + 150) + 298)%Z with (u + 150 + (u + 150) + 298)%Z by ring.
    apply multiple_mult; [lia|lia|apply multiple_mult; (lia || assumption)|]. apply (multiple_dot 149 149); (lia || assumption).
  - apply product_size; [now apply product_size|]. apply square_size. now apply square_no_larger.
Qed.

Lemma root_is : forall K way one most, a_stiffness K -> multiple 149 one -> Rabs one <= IZR most_between -> square way <= IZR most ->
  Rabs (square_of_size K way one) <= IZR (2 ^ 10 * most_between * (2 ^ 10 * most_between) * most).
Proof. intros K way one most [KU KL] U L W. apply product_size; [apply product_size; now apply product_size|now apply square_size]. Qed.

Lemma root_unit : forall K way one u, (0 <= u)%Z -> a_stiffness K -> multiple 149 one -> multiples u way ->
  multiple (364 + (u + u)) (square_of_size K way one).
Proof.
  intros K way one u U [KU KL] O W. assert (P : multiple 182 (K * one)) by (apply (multiple_mult 33 149); (lia || assumption)).
  apply multiple_mult; [lia|lia|apply (multiple_mult 182 182); (lia || assumption)|apply multiple_dot; assumption].
Qed.

(* ---- v in a triangle ---- *)

Definition pressed_on_triangle (a b c p : vector) := scaled (- dot (normal a b c) (minus p a)) (normal a b c).
Definition pulled_in_triangle (k l m : Z) (a b c p : vector) :=
  minus (scaled (square (normal a b c)) (way_to_grid k l m a b c p)) (scaled (IZR (2 ^ 24)) (pressed_on_triangle a b c p)).

(* It is the part along the plane. *)
Lemma pulled_in_triangle_is : forall k l m a b c p, of_the_grid k l m ->
  pulled_in_triangle k l m a b c p = minus (scaled (square (normal a b c)) (way_to_grid k l m a b c p))
    (scaled (dot (way_to_grid k l m a b c p) (normal a b c)) (normal a b c)).
Proof.
  intros k l m a b c p (_ & _ & _ & S).
  assert (D : dot (way_to_grid k l m a b c p) (normal a b c) = - IZR (2 ^ 24) * dot (normal a b c) (minus p a)).
  { unfold way_to_grid. cbn [weighted_sum in_three whole]. rewrite <- S, !plus_IZR. components. ring. }
  rewrite D. unfold pulled_in_triangle, pressed_on_triangle. set (n := normal a b c). set (w := dot n (minus p a)).
  set (g := IZR (2 ^ 24)). apply same_components; cbn [minus scaled x_of y_of z_of]; ring.
Qed.

Lemma pulled_in_triangle_unit : forall k l m a b c p, given a -> given b -> given c -> given p -> of_the_grid k l m ->
  multiples 265 (pulled_in_triangle k l m a b c p).
Proof.
  intros k l m a b c p A B C P G. destruct (way_to_grid_is k l m a b c p A B C P G) as [U _].
  pose proof (normal_unit a b c A B C) as N. rewrite pulled_in_triangle_is by exact G. apply multiples_minus.
  - apply (multiples_scaled 212 53); [lia|lia|apply (multiple_dot 106 106); (lia || assumption)|exact U].
  - apply (multiples_scaled 159 106); [lia|lia|apply (multiple_dot 53 106); (lia || assumption)|exact N].
Qed.

Lemma pulled_in_triangle_size : forall k l m a b c p, given a -> given b -> given c -> given p -> of_the_grid k l m ->
  no_larger (IZR (3 * S4 * 34642 * 2 ^ 24)) (pulled_in_triangle k l m a b c p).
Proof.
  intros k l m a b c p A B C P G. destruct (way_to_grid_is k l m a b c p A B C P G) as [_ L].
  rewrite pulled_in_triangle_is by exact G. apply components_no_larger; [discriminate|].
  apply Rle_trans with (1 := along_plane_size _ _ _ _ (normal_size a b c A B C) (square_no_larger _ _ L)).
  apply IZR_le. vm_compute. discriminate.
Qed.

(* | a component of a shaded force, v in a triangle: K²(n·w)²n²N_i² and (m n² + Kτ)²N² | 2^-1022 | 1499 | *)
Theorem pulled_force_in_triangle_fits : forall k l j a b c p N m K, given a -> given b -> given c -> given p -> of_the_grid k l j ->
  between_normals N -> a_tie m -> a_stiffness K ->
  let one_fits (component : vector -> R) :=
    fits 1022 1499 (square_of_size K (pressed_on_triangle a b c p) (component N)) /\
    fits 1022 1499 (rest_squared m K (square (normal a b c)) (component (pulled_in_triangle k l j a b c p)) N) in
  one_fits x_of /\ one_fits y_of /\ one_fits z_of.
Proof.
  intros k l j a b c p N m K A B C P G HN M HK one_fits.
  destruct (pulled_in_triangle_unit k l j a b c p A B C P G) as (U1 & U2 & U3).
  destruct (pulled_in_triangle_size k l j a b c p A B C P G) as (L1 & L2 & L3).
  assert (One : forall component : vector -> R, multiple 149 (component N) -> Rabs (component N) <= IZR most_between ->
    multiple 265 (component (pulled_in_triangle k l j a b c p)) ->
    Rabs (component (pulled_in_triangle k l j a b c p)) <= IZR (3 * S4 * 34642 * 2 ^ 24) -> one_fits component).
  { intros component NU NL U L. unfold one_fits. split.
    - of size (2 ^ 10 * most_between * (2 ^ 10 * most_between) * (2 * S3 * (2 * S3) * (3 * S4)))%Z.
      + apply multiple_of_less with 894%Z; [lia|]. apply (root_unit _ _ _ 265); [lia|exact HK|exact NU|].
        apply (multiples_scaled 159 106); [lia|lia| |units]. replace (- dot (normal a b c) (minus p a)) with
          (0 - dot (normal a b c) (minus p a)) by ring. apply multiple_minus; [exists 0%Z; ring|]. apply (multiple_dot 106 53); units.
      + apply root_is; [exact HK|exact NU|exact NL|]. unfold pressed_on_triangle.
        set (d := dot (normal a b c) (minus p a)). replace (square (scaled (- d) (normal a b c))) with
          (d * d * square (normal a b c)) by (unfold d; components; ring).
        apply Rle_trans with (1 := Rle_abs _). apply product_size; [now apply pressure_size|]. apply square_size. now apply normal_size.
    - destruct (rest_is 212 265 (3 * S4) m K (square (normal a b c)) (component (pulled_in_triangle k l j a b c p)) N) as [RU RL];
        try assumption; try lia.
      + apply (multiple_dot 106 106); units.
      + apply square_size. now apply normal_size.
      + of size (3 * S4 * most_rest * (3 * S4 * most_rest) * (3 * (most_between * most_between)))%Z; [exact RU|exact RL]. }
  destruct HN as [(N1 & N2 & N3) (M1 & M2 & M3)]. repeat split; apply One; (assumption || (split; (repeat split; assumption))).
Qed.

(* ---- v along an edge, with one pair of normals at its ends: weights 2^24 - k and k ---- *)

Definition along_the_grid (k : Z) := (0 <= k <= 2 ^ 24)%Z.
Definition whole_of_two (k : Z) := (IZR (2 ^ 24 - k), IZR k).
Definition way_to_grid_on_edge (k : Z) (a b p : vector) :=  (* 2^24 (g - p) *)
  weighted_sum (fun corner => minus corner p) (in_two (whole_of_two k) a b).
Definition pulled_along_edge (k : Z) (a b p : vector) :=
  minus (scaled (square (minus b a)) (way_to_grid_on_edge k a b p)) (scaled (IZR (2 ^ 24)) (way_to_edge a b p)).

Lemma weights_of_two : forall T k (first second : T), along_the_grid k ->
  all_weights (in_two (whole_of_two k) first second) = IZR (2 ^ 24) /\
  (forall weight corner, In (weight, corner) (in_two (whole_of_two k) first second) ->
    multiple 0 weight /\ 0 <= weight /\ (corner = first \/ corner = second)).
Proof.
  intros T k first second [L H]. split.
  - cbn [all_weights in_two whole_of_two]. rewrite minus_IZR. ring.
  - assert (A : 0 <= IZR (2 ^ 24 - k)) by (apply IZR_le; lia). assert (B : 0 <= IZR k) by (apply IZR_le; lia).
    unfold whole_of_two. set (j := (2 ^ 24 - k)%Z) in *. clearbody j. intros weight corner I.
    destruct I as [E|[E|[]]]; injection E as <- <-; (split; [apply multiple_of_integer|split; [assumption|tauto]]).
Qed.

Lemma normals_between_two : forall k N1 N2, any_normal N1 -> any_normal N2 -> along_the_grid k ->
  between_normals (weighted_sum (fun N => N) (in_two (whole_of_two k) N1 N2)).
Proof.
  intros k N1 N2 [U1 L1] [U2 L2] G. destruct (weights_of_two _ k N1 N2 G) as [S W]. split.
  - apply (weighted_unit _ _ _ 0 149); [lia|lia|]. intros weight corner H. destruct (W weight corner H) as (U & _ & E).
    split; [exact U|]. destruct E as [->| ->]; assumption.
  - rewrite mult_IZR, <- S. apply weighted_size. intros weight corner H. destruct (W weight corner H) as (_ & U & E).
    split; [exact U|]. destruct E as [->| ->]; assumption.
Qed.

Lemma way_to_grid_on_edge_is : forall k a b p, given a -> given b -> given p -> along_the_grid k ->
  multiples 53 (way_to_grid_on_edge k a b p) /\ no_larger (IZR (2 ^ 24 * side)) (way_to_grid_on_edge k a b p).
Proof.
  intros k a b p A B P G. destruct (weights_of_two _ k a b G) as [S W]. split.
  - apply (weighted_unit _ _ _ 0 53); [lia|lia|]. intros weight corner H. destruct (W weight corner H) as (U & _ & E).
    split; [exact U|]. destruct E as [->| ->]; now apply edge_unit.
  - rewrite mult_IZR, <- S. apply weighted_size. intros weight corner H. destruct (W weight corner H) as (_ & U & E).
    split; [exact U|]. destruct E as [->| ->]; (apply difference_no_larger; [apply P|]); [apply A|apply B].
Qed.

(* It is along the edge. *)
Lemma pulled_along_edge_is : forall k a b p,
  pulled_along_edge k a b p = scaled (dot (minus b a) (way_to_grid_on_edge k a b p)) (minus b a).
Proof.
  intros k a b p. unfold pulled_along_edge, way_to_grid_on_edge, way_to_edge. cbn [weighted_sum in_two whole_of_two].
  rewrite minus_IZR. set (g := IZR (2 ^ 24)). set (l := IZR k). clearbody g l. apply same_components; components; ring.
Qed.

Lemma pulled_along_edge_unit : forall k a b p, given a -> given b -> given p -> along_the_grid k ->
  multiples 159 (pulled_along_edge k a b p).
Proof.
  intros k a b p A B P G. destruct (way_to_grid_on_edge_is k a b p A B P G) as [U _]. rewrite pulled_along_edge_is.
  apply (multiples_scaled 106 53); [lia|lia|apply (multiple_dot 53 53); units|units].
Qed.

Lemma pulled_along_edge_size : forall k a b p, given a -> given b -> given p -> along_the_grid k ->
  no_larger (IZR (3 * S2 * 34642 * 2 ^ 24)) (pulled_along_edge k a b p).
Proof.
  intros k a b p A B P G. destruct (way_to_grid_on_edge_is k a b p A B P G) as [_ L]. rewrite pulled_along_edge_is.
  pose proof (square_no_larger _ _ L) as W. pose proof (edge_size a b A B) as E.
  set (e := minus b a) in *. set (w := way_to_grid_on_edge k a b p) in *. clearbody e w.
  apply components_no_larger; [discriminate|].
  replace (square (scaled (dot e w) e)) with (dot e w * dot e w * square e) by (components; ring).
  apply Rle_trans with (IZR (3 * S2 * (3 * (2 ^ 24 * side * (2 ^ 24 * side))) * (3 * S2))); [|apply IZR_le; vm_compute; discriminate].
  rewrite mult_IZR. apply Rmult_le_compat; [apply Rle_0_sqr|apply square_is_not_negative| |exact E].
  apply Rle_trans with (1 := cauchy_schwarz e w). rewrite mult_IZR. apply Rmult_le_compat; auto; apply square_is_not_negative.
Qed.

(* | the same, v along an edge, one pair of normals: K²(e × w)²e²N_i² and (m e² + Kτ)²N² | 2^-810 | 1230 | *)
Theorem pulled_force_along_edge_fits : forall k a b p N m K, given a -> given b -> given p -> along_the_grid k -> between_normals N ->
  a_tie m -> a_stiffness K ->
  let one_fits (component : vector -> R) :=
    fits 810 1230 (square_of_size K (way_to_edge a b p) (component N)) /\
    fits 810 1230 (rest_squared m K (square (minus b a)) (component (pulled_along_edge k a b p)) N) in
  one_fits x_of /\ one_fits y_of /\ one_fits z_of.
Proof.
  intros k a b p N m K A B P G HN M HK one_fits.
  destruct (pulled_along_edge_unit k a b p A B P G) as (U1 & U2 & U3).
  destruct (pulled_along_edge_size k a b p A B P G) as (L1 & L2 & L3).
  assert (One : forall component : vector -> R, multiple 149 (component N) -> Rabs (component N) <= IZR most_between ->
    multiple 159 (component (pulled_along_edge k a b p)) ->
    Rabs (component (pulled_along_edge k a b p)) <= IZR (3 * S2 * 34642 * 2 ^ 24) -> one_fits component).
  { intros component NU NL U L. unfold one_fits. split.
    - of size (2 ^ 10 * most_between * (2 ^ 10 * most_between) * (3 * S2 * (3 * S2 * (3 * S2))))%Z.
      + apply multiple_of_less with 682%Z; [lia|]. apply (root_unit _ _ _ 159); [lia|exact HK|exact NU|now apply way_to_edge_unit].
      + apply root_is; [exact HK|exact NU|exact NL|now apply way_to_edge_size].
    - destruct (rest_is 106 159 (3 * S2) m K (square (minus b a)) (component (pulled_along_edge k a b p)) N) as [RU RL];
        try assumption; try lia.
      + apply (multiple_dot 53 53); units.
      + apply square_size. now apply edge_size.
      + of size (3 * S2 * most_rest * (3 * S2 * most_rest) * (3 * (most_between * most_between)))%Z; [exact RU|exact RL]. }
  destruct HN as [(N1 & N2 & N3) (M1 & M2 & M3)]. repeat split; apply One; (assumption || (split; (repeat split; assumption))).
Qed.
