(* SPDX-License-Identifier: BSD-3-Clause *)
(* How long the integers of a force are that a texture turns: the last three rows of the table of bits in fast/meshes/bits.md, in the
   form of those in MeshBounds.v. *)
From Coq Require Import ZArith Reals Lra Lia Psatz List.
From Flocq Require Import Core.
From Forceshade Require Import Formats Vectors MeshBounds MeshBoundsMoves.
Import ListNotations.
Open Scope R_scope.

(* ---- Numbers of binary32 as whole multiples ---- *)

Lemma scaled_float_is_multiple : forall m e u, (0 <= u)%Z -> (- u <= e)%Z -> multiple u (F2R (Float radix2 m e)).
Proof.
  intros m e u U E. exists (m * 2 ^ (e + u))%Z. rewrite mult_IZR. unfold F2R. cbn [Fnum Fexp].
  change (2 ^ u)%Z with (Zpower radix2 u). change (2 ^ (e + u))%Z with (Zpower radix2 (e + u)).
  rewrite !IZR_Zpower by lia. rewrite Rmult_assoc, <- bpow_plus. reflexivity.
Qed.

(* A number of binary32 that is 0 or at least 2^least in size. So is a slope, a component of a gradient (2^-30) and a stiffness (2^-10). *)
Theorem binary32_is_multiple : forall x least, generic_format radix2 fexp32 x -> (-126 <= least <= 23)%Z ->
  (x = 0 \/ bpow radix2 least <= Rabs x) -> multiple (23 - least) x.
Proof.
  intros x least F B [->|L]; [exists 0%Z; ring|].
  rewrite F. apply scaled_float_is_multiple; [lia|].
  assert (M : (least + 1 <= mag radix2 x)%Z) by (apply mag_ge_bpow; replace (least + 1 - 1)%Z with least by ring; exact L).
  unfold cexp, FLT_exp. lia.
Qed.

Lemma nearest_is_multiple : forall x, multiple 149 (nearest32 x).
Proof.
  intro x. assert (F : generic_format radix2 fexp32 (nearest32 x)) by (apply generic_format_round; auto with typeclass_instances).
  rewrite F. apply scaled_float_is_multiple; [lia|]. unfold cexp, FLT_exp. lia.
Qed.

Lemma nearest_of_size : forall x k, (-149 <= k)%Z -> 0 <= x <= bpow radix2 k -> Rabs (nearest32 x) <= bpow radix2 k.
Proof.
  intros x k K [L H]. apply abs_round_le_generic; auto with typeclass_instances.
  - apply generic_format_bpow. unfold FLT_exp. lia.
  - now rewrite Rabs_pos_eq.
Qed.

Lemma root_size : forall x most, 0 <= most -> x <= most * most -> sqrt x <= most.
Proof. intros x most M H. rewrite <- (sqrt_square most) by exact M. now apply sqrt_le_1_alt. Qed.

(* ---- N′ = N - ℓ (U_x G_x + U_y G_y) between corners, times the sum of their weights (TextureScheme::interpolated()) ---- *)

Record texture := Texture { normal_of : vector; gradient_x_of : vector; gradient_y_of : vector }.
Definition a_gradient (G : vector) := multiples 53 G /\ no_larger 1000 G.
Definition a_texture (t : texture) := a_normal (normal_of t) /\ a_gradient (gradient_x_of t) /\ a_gradient (gradient_y_of t).
Definition a_slope (U : R) := multiple 53 U /\ Rabs U <= IZR (2 ^ 30).

Definition length_of (corners : list (R * texture)) :=  (* ℓ *)
  nearest32 (sqrt (square (weighted_sum normal_of corners)) / all_weights corners).
Definition textured_normal (Ux Uy : R) (corners : list (R * texture)) :=
  minus (weighted_sum normal_of corners)
    (plus (scaled (length_of corners * Ux) (weighted_sum gradient_x_of corners))
      (scaled (length_of corners * Uy) (weighted_sum gradient_y_of corners))).

Definition have_weights (u : Z) (corners : list (R * texture)) :=
  forall weight corner, In (weight, corner) corners -> multiple u weight /\ 0 <= weight /\ a_texture corner.

Lemma weights_not_negative : forall u corners, have_weights u corners -> 0 <= all_weights corners.
Proof.
  intros u corners. induction corners as [|[weight corner] others I]; intro H; cbn [all_weights]; [lra|].
  destruct (H weight corner (or_introl eq_refl)) as (_ & W & _). assert (0 <= all_weights others); [|lra].
  apply I. intros ? ? N. apply H. now right.
Qed.

Lemma normals_size : forall u corners, have_weights u corners ->
  no_larger (all_weights corners * 2) (weighted_sum normal_of corners).
Proof. intros u corners H. apply weighted_size. intros weight corner N. destruct (H weight corner N) as (_ & W & (_ & A) & _).
  now split. Qed.

Lemma length_size : forall u corners, have_weights u corners -> Rabs (length_of corners) <= IZR 4.
Proof.
  intros u corners H. pose proof (weights_not_negative u corners H) as W. pose proof (normals_size u corners H) as L.
  unfold length_of. set (all := all_weights corners) in *. set (N := weighted_sum normal_of corners) in *. clearbody all N.
  assert (S : sqrt (square N) <= 4 * all).
  { apply root_size; [lra|]. destruct L as (X & Y & Z).
    assert (One : forall x, Rabs x <= all * 2 -> x * x <= 4 * (all * all)).
    { intros x A. apply Rabs_le_inv in A. nra. }
    apply One in X, Y, Z. components. assert (0 <= all * all) by nra. lra. }
  change (IZR 4) with (bpow radix2 2). apply nearest_of_size; [lia|]. change (bpow radix2 2) with 4.
  pose proof (sqrt_pos (square N)) as P. destruct (Rle_lt_or_eq_dec 0 all W) as [A|A].
  - split.
    + apply Rmult_le_pos; [exact P|]. now apply Rlt_le, Rinv_0_lt_compat.
    + apply Rmult_le_reg_r with all; [exact A|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
  - replace (sqrt (square N)) with 0 by lra. unfold Rdiv. rewrite Rmult_0_l. lra.
Qed.

Lemma minus_no_larger : forall p q a b, no_larger p a -> no_larger q b -> no_larger (p + q) (minus a b).
Proof.
  intros p q a b (A1 & A2 & A3) (B1 & B2 & B3).
  repeat split; cbn [minus x_of y_of z_of]; unfold Rminus; (apply Rle_trans with (1 := Rabs_triang _ _)); rewrite Rabs_Ropp;
    now apply Rplus_le_compat.
Qed.

Lemma textured_normal_is : forall u Ux Uy corners, (0 <= u)%Z -> a_slope Ux -> a_slope Uy -> have_weights u corners ->
  multiples (u + 255) (textured_normal Ux Uy corners) /\ no_larger (all_weights corners * IZR (2 ^ 44)) (textured_normal Ux Uy corners).
Proof.
  intros u Ux Uy corners U [XU XL] [YU YL] H. unfold textured_normal. split.
  - assert (Part : forall slope of, multiple 53 slope -> (forall t, a_texture t -> multiples 53 (of t)) ->
      multiples (u + 255) (scaled (length_of corners * slope) (weighted_sum of corners))).
    { intros slope of M A. replace (u + 255)%Z with (202 + (u + 53))%Z by ring. apply multiples_scaled; [lia|lia| |].
      - apply (multiple_mult 149 53); [lia|lia|apply nearest_is_multiple|exact M].
      - apply weighted_unit; [exact U|lia|]. intros weight corner N. destruct (H weight corner N) as (W & _ & T). auto. }
    apply multiples_minus; [apply multiples_of_less with (u + 149)%Z; [lia|]|apply multiples_plus; apply Part; auto].
    + apply weighted_unit; [exact U|lia|]. intros weight corner N. destruct (H weight corner N) as (W & _ & (A & _) & _). auto.
    + now intros t (_ & (A & _) & _).
    + now intros t (_ & _ & (A & _)).
  - pose proof (weights_not_negative u corners H) as W. pose proof (length_size u corners H) as L.
    assert (Part : forall slope of, Rabs slope <= IZR (2 ^ 30) -> (forall t, a_texture t -> no_larger 1000 (of t)) ->
      no_larger (IZR (4 * 2 ^ 30) * (all_weights corners * 1000)) (scaled (length_of corners * slope) (weighted_sum of corners))).
    { intros slope of M A. apply scaled_no_larger; [now apply product_size|]. apply weighted_size.
      intros weight corner N. destruct (H weight corner N) as (_ & P & T). auto. }
    apply no_larger_than with (all_weights corners * 2 + (IZR (4 * 2 ^ 30) * (all_weights corners * 1000) +
      IZR (4 * 2 ^ 30) * (all_weights corners * 1000))).
    + change (4 * 2 ^ 30)%Z with 4294967296%Z. change (2 ^ 44)%Z with 17592186044416%Z. lra.
    + apply minus_no_larger; [now apply normals_size with u|]. apply plus_no_larger; apply Part; auto.
      * now intros t (_ & (_ & A) & _).
      * now intros t (_ & _ & (_ & A)).
Qed.

(* ---- At a rest at p's foot in a triangle: weights times n² (RestNumbers::weights_in_triangle()) ---- *)

Definition weights_at_foot (a b c p : vector) :=
  let second := dot (cross (minus p a) (minus c a)) (normal a b c) in
  let third := dot (cross (minus b a) (minus p a)) (normal a b c) in (square (normal a b c) - (second + third), second, third).
Definition not_negative (weights : R * R * R) := let '(u, v, w) := weights in 0 <= u /\ 0 <= v /\ 0 <= w.

Lemma weights_at_foot_are : forall a b c p t1 t2 t3, given a -> given b -> given c -> given p -> a_texture t1 -> a_texture t2 ->
  a_texture t3 -> not_negative (weights_at_foot a b c p) ->
  have_weights 212 (in_three (weights_at_foot a b c p) t1 t2 t3) /\
  all_weights (in_three (weights_at_foot a b c p) t1 t2 t3) = square (normal a b c).
Proof.
  intros a b c p t1 t2 t3 A B C P T1 T2 T3 (U & V & W). split.
  - pose proof (height_unit a b c b c p A B C B C P) as H1. pose proof (height_unit a b c c a p A B C C A P) as H2.
    pose proof (height_unit a b c a b p A B C A B P) as H3. destruct (heights_are_weights a b c p) as (E2 & E3 & E1).
    rewrite <- E1 in H1. rewrite <- E2 in H2. rewrite <- E3 in H3.
    intros weight corner H. destruct H as [E|[E|[E|[]]]]; injection E as <- <-; auto.
  - cbn [all_weights in_three weights_at_foot]. ring.
Qed.

(* | a component of N′ with a texture, times n² | 2^-467 | 570 | *)
Theorem textured_normal_fits : forall a b c p t1 t2 t3 Ux Uy, given a -> given b -> given c -> given p -> a_texture t1 ->
  a_texture t2 -> a_texture t3 -> a_slope Ux -> a_slope Uy -> not_negative (weights_at_foot a b c p) ->
  all_fit 467 570 (textured_normal Ux Uy (in_three (weights_at_foot a b c p) t1 t2 t3)).
Proof.
  intros a b c p t1 t2 t3 Ux Uy A B C P T1 T2 T3 X Y N.
  destruct (weights_at_foot_are a b c p t1 t2 t3 A B C P T1 T2 T3 N) as [W S].
  destruct (textured_normal_is 212 Ux Uy _ ltac:(lia) X Y W) as [U L]. rewrite S in L.
  apply they_fit with (3 * S4 * 2 ^ 44)%Z; [exact U| |reflexivity|lia].
  apply no_larger_than with (2 := L). rewrite mult_IZR. apply Rmult_le_compat_r; [apply IZR_le; discriminate|].
  now apply normal_size.
Qed.

(* ---- At a rest at p's foot on a crease, whose triangles have other textures at its ends: α q₁ N₁′ + β q₂ N₂′
   (SharedCorners::outward()). e is the edge from a to b, n₁ and n₂ are the normals of its triangles, e² D = e × (e × (p - a)), and the
   weights are times e². Where the god-object went for a sub-goal, D is at a right angle to e here,
     so that p's foot is the sub-goal's. ---- *)

Definition way_to_edge (a b p : vector) := cross (minus b a) (cross (minus b a) (minus p a)).  (* e² D *)
Definition weights_on_edge (a b p : vector) := (square (minus b a) - dot (minus p a) (minus b a), dot (minus p a) (minus b a)).
Definition in_two {T} (weights : R * R) (first second : T) : list (R * T) := let '(u, v) := weights in [(u, first); (v, second)].
Definition both_not_negative (weights : R * R) := let '(u, v) := weights in 0 <= u /\ 0 <= v.

Definition alpha (way n1 n2 : vector) := dot (cross way n2) (cross n1 n2).
Definition beta (way n1 n2 : vector) := dot (cross n1 way) (cross n1 n2).
Definition nearest_length (n : vector) := nearest32 (sqrt (square n)).  (* q *)
Definition on_crease (way n1 n2 N1 N2 : vector) :=
  plus (scaled (alpha way n1 n2 * nearest_length n1) N1) (scaled (beta way n1 n2 * nearest_length n2) N2).

Lemma weights_on_edge_are : forall a b p t1 t2, given a -> given b -> given p -> a_texture t1 -> a_texture t2 ->
  both_not_negative (weights_on_edge a b p) ->
  have_weights 106 (in_two (weights_on_edge a b p) t1 t2) /\ all_weights (in_two (weights_on_edge a b p) t1 t2) = square (minus b a).
Proof.
  intros a b p t1 t2 A B P T1 T2 (U & V). split.
  - assert (S : multiple 106 (square (minus b a))) by (apply (multiple_dot 53 53); units).
    assert (D : multiple 106 (dot (minus p a) (minus b a))) by (apply (multiple_dot 53 53); units).
    intros weight corner H. destruct H as [E|[E|[]]]; injection E as <- <-; auto using multiple_minus.
  - cbn [all_weights in_two weights_on_edge]. ring.
Qed.

Lemma way_to_edge_unit : forall a b p, given a -> given b -> given p -> multiples 159 (way_to_edge a b p).
Proof. intros. apply (multiples_cross 53 106); units; apply (multiples_cross 53 53); units. Qed.

Lemma way_to_edge_size : forall a b p, given a -> given b -> given p -> square (way_to_edge a b p) <= IZR (3 * S2 * (3 * S2 * (3 * S2))).
Proof. intros. apply cross_size; [sizes|]. apply cross_size; sizes. Qed.

Notation S9 := (S3 * S3 * S3)%Z.

Lemma crease_part_size : forall way n m k, square way <= IZR (3 * S2 * (3 * S2 * (3 * S2))) -> square n <= IZR (3 * S4) ->
  square m <= IZR (3 * S4) -> square k <= IZR (3 * S4) ->
  Rabs (dot (cross way n) (cross m k)) <= IZR (27 * S9) /\ Rabs (dot (cross n way) (cross m k)) <= IZR (27 * S9).
Proof.
  intros way n m k W N M K. pose proof (cross_size _ _ _ _ M K) as L. split.
  - apply dot_size with (1 := cross_size _ _ _ _ W N) (2 := L); vm_compute; discriminate.
  - apply dot_size with (1 := cross_size _ _ _ _ N W) (2 := L); vm_compute; discriminate.
Qed.

Lemma nearest_length_size : forall n, square n <= IZR (3 * S4) -> Rabs (nearest_length n) <= IZR (2 ^ 30).
Proof.
  intros n H. change (IZR (2 ^ 30)) with (bpow radix2 30). apply nearest_of_size; [lia|]. split; [apply sqrt_pos|].
  apply root_size; [apply bpow_ge_0|]. apply Rle_trans with (1 := H). change (bpow radix2 30) with (IZR (2 ^ 30)).
  rewrite <- mult_IZR. apply IZR_le. discriminate.
Qed.

Notation most_on_crease := (27 * S9 * 2 ^ 30 * (3 * S2 * 2 ^ 44) + 27 * S9 * 2 ^ 30 * (3 * S2 * 2 ^ 44))%Z.

Lemma on_crease_is : forall way n1 n2 N1 N2, multiples 159 way -> multiples 106 n1 -> multiples 106 n2 -> multiples 361 N1 ->
  multiples 361 N2 -> square way <= IZR (3 * S2 * (3 * S2 * (3 * S2))) -> square n1 <= IZR (3 * S4) -> square n2 <= IZR (3 * S4) ->
  no_larger (IZR (3 * S2 * 2 ^ 44)) N1 -> no_larger (IZR (3 * S2 * 2 ^ 44)) N2 ->
  multiples 987 (on_crease way n1 n2 N1 N2) /\ no_larger (IZR most_on_crease) (on_crease way n1 n2 N1 N2).
Proof.
  intros way n1 n2 N1 N2 W U1 U2 V1 V2 L L1 L2 M1 M2.
  assert (Axis : multiples 212 (cross n1 n2)) by (now apply (multiples_cross 106 106)). split.
  - assert (Part : forall x n N, multiple 477 x -> multiples 361 N -> multiples 987 (scaled (x * nearest_length n) N)).
    { intros x n N X V. apply (multiples_scaled 626 361); [lia|lia| |exact V].
      apply (multiple_mult 477 149); [lia|lia|exact X|apply nearest_is_multiple]. }
    apply multiples_plus; apply Part; try assumption.
    + apply (multiple_dot 265 212); [lia|lia|now apply (multiples_cross 159 106)|exact Axis].
    + apply (multiple_dot 265 212); [lia|lia|now apply (multiples_cross 106 159)|exact Axis].
  - rewrite plus_IZR. apply plus_no_larger; rewrite mult_IZR; (apply scaled_no_larger; [|assumption]); apply product_size.
    + now destruct (crease_part_size way n2 n1 n2 L L2 L1 L2).
    + now apply nearest_length_size.
    + now destruct (crease_part_size way n1 n1 n2 L L1 L1 L2).
    + now apply nearest_length_size.
Qed.

(* The direction at that rest. s₁ and s₂ are the textures at the ends on the first side, t₁ and t₂ on the other. *)
Definition textured_on_crease (a b p n1 n2 : vector) (s1 s2 t1 t2 : texture) (Ux Uy Vx Vy : R) :=
  on_crease (way_to_edge a b p) n1 n2 (textured_normal Ux Uy (in_two (weights_on_edge a b p) s1 s2))
    (textured_normal Vx Vy (in_two (weights_on_edge a b p) t1 t2)).

Definition a_normal_of_triangle (n : vector) := exists a b c, given a /\ given b /\ given c /\ n = normal a b c.

Lemma textured_on_crease_is : forall a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy, given a -> given b -> given p -> a_normal_of_triangle n1 ->
  a_normal_of_triangle n2 -> a_texture s1 -> a_texture s2 -> a_texture t1 -> a_texture t2 -> a_slope Ux -> a_slope Uy -> a_slope Vx ->
  a_slope Vy -> both_not_negative (weights_on_edge a b p) ->
  multiples 987 (textured_on_crease a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy) /\
  no_larger (IZR most_on_crease) (textured_on_crease a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy).
Proof.
  intros a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy A B P (a1 & b1 & c1 & A1 & B1 & C1 & ->) (a2 & b2 & c2 & A2 & B2 & C2 & ->) S1 S2' T1 T2
    X1 Y1 X2 Y2 N.
  assert (One : forall r1 r2 Wx Wy, a_texture r1 -> a_texture r2 -> a_slope Wx -> a_slope Wy ->
    multiples 361 (textured_normal Wx Wy (in_two (weights_on_edge a b p) r1 r2)) /\
    no_larger (IZR (3 * S2 * 2 ^ 44)) (textured_normal Wx Wy (in_two (weights_on_edge a b p) r1 r2))).
  { intros r1 r2 Wx Wy R1 R2 X Y. destruct (weights_on_edge_are a b p r1 r2 A B P R1 R2 N) as [W S].
    destruct (textured_normal_is 106 Wx Wy _ ltac:(lia) X Y W) as [U L]. rewrite S in L. split; [exact U|].
    apply no_larger_than with (2 := L). rewrite mult_IZR. apply Rmult_le_compat_r; [apply IZR_le; discriminate|]. now apply edge_size. }
  destruct (One s1 s2 Ux Uy S1 S2' X1 Y1) as [U1 L1], (One t1 t2 Vx Vy T1 T2 X2 Y2) as [U2 L2].
  apply on_crease_is; auto using way_to_edge_unit, way_to_edge_size, normal_unit, normal_size.
Qed.

(* | a component of αq₁N₁′ + βq₂N₂′ with a texture | 2^-987 | 1226 | *)
Theorem textured_on_crease_fits : forall a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy, given a -> given b -> given p ->
  a_normal_of_triangle n1 -> a_normal_of_triangle n2 -> a_texture s1 -> a_texture s2 -> a_texture t1 -> a_texture t2 -> a_slope Ux ->
  a_slope Uy -> a_slope Vx -> a_slope Vy -> both_not_negative (weights_on_edge a b p) ->
  all_fit 987 1226 (textured_on_crease a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy).
Proof.
  intros a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy A B P N1 N2 S1 S2' T1 T2 X1 Y1 X2 Y2 N.
  destruct (textured_on_crease_is a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy A B P N1 N2 S1 S2' T1 T2 X1 Y1 X2 Y2 N) as [U L].
  apply they_fit with (1 := U) (2 := L); [reflexivity|lia].
Qed.

(* ---- What is compared with the square of a tie (along() of fast/meshes/rounded.h): K² N_i² (e² D)² ---- *)

Definition a_stiffness (K : R) := multiple 33 K /\ Rabs K <= IZR (2 ^ 10).
Definition square_of_size (K : R) (way : vector) (one : R) := K * one * (K * one) * square way.

Lemma square_of_size_fits : forall K way one, a_stiffness K -> multiples 159 way ->
  square way <= IZR (3 * S2 * (3 * S2 * (3 * S2))) -> multiple 987 one -> Rabs one <= IZR most_on_crease ->
  fits 2358 2946 (square_of_size K way one).
Proof.
  intros K way one [KU KL] W L U B.
  of size (2 ^ 10 * most_on_crease * (2 ^ 10 * most_on_crease) * (3 * S2 * (3 * S2 * (3 * S2))))%Z.
  - assert (S : multiple 1020 (K * one)) by (apply (multiple_mult 33 987); (lia || assumption)).
    apply (multiple_mult 2040 318); [lia|lia|apply (multiple_mult 1020 1020); (lia || assumption)|].
    apply (multiple_dot 159 159); (lia || assumption).
  - apply product_size; [apply product_size; now apply product_size|now apply square_size].
Qed.

(* | its square, times those of K and of e² D | 2^-2358 | 2946 | *)
Theorem square_of_textured_force_fits : forall K a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy, a_stiffness K -> given a -> given b -> given p ->
  a_normal_of_triangle n1 -> a_normal_of_triangle n2 -> a_texture s1 -> a_texture s2 -> a_texture t1 -> a_texture t2 -> a_slope Ux ->
  a_slope Uy -> a_slope Vx -> a_slope Vy -> both_not_negative (weights_on_edge a b p) ->
  let N := textured_on_crease a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy in let way := way_to_edge a b p in
  fits 2358 2946 (square_of_size K way (x_of N)) /\ fits 2358 2946 (square_of_size K way (y_of N)) /\
  fits 2358 2946 (square_of_size K way (z_of N)).
Proof.
  intros K a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy HK A B P N1 N2 S1 S2' T1 T2 X1 Y1 X2 Y2 N.
  destruct (textured_on_crease_is a b p n1 n2 s1 s2 t1 t2 Ux Uy Vx Vy A B P N1 N2 S1 S2' T1 T2 X1 Y1 X2 Y2 N) as
    [(U1 & U2 & U3) (L1 & L2 & L3)].
  pose proof (way_to_edge_unit a b p A B P). pose proof (way_to_edge_size a b p A B P).
  cbv zeta. repeat split; now apply square_of_size_fits.
Qed.
