(* SPDX-License-Identifier: BSD-3-Clause *)
(* A decision on any set of triangles has the sign of the exact number: sign_of() of fast/soups/numbers.h, for every text of sums and
   products, in binary64 and, where that leaves it open, in integers that count units of each point and each direction. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations Vectors SoupNumbers SoupProducts.
Open Scope R_scope.

(* A text that is run on Ball and on Whole: what it reads, as a ball, as the exact number and as an integer; and its operations. *)
Inductive text :=
| number (about : ball) (exact : R) (whole : Z)
| opposite (a : text)
| sum (a b : text)
| difference (a b : text)
| product (a b : text)
| two_products (a b c d : text)          (* a b - c d, a component of cross() *)
| three_products (a b c d e f : text).   (* a b + c d + e f, dot() *)

Fixpoint in_balls (t : text) : ball :=
  match t with
  | number about _ _ => about
  | opposite a => negated (in_balls a)
  | sum a b => add (in_balls a) (in_balls b)
  | difference a b => subtract (in_balls a) (in_balls b)
  | product a b => multiply (in_balls a) (in_balls b)
  | two_products a b c d => difference_of_products (in_balls a) (in_balls b) (in_balls c) (in_balls d)
  | three_products a b c d e f => dot_of (in_balls a) (in_balls b) (in_balls c) (in_balls d) (in_balls e) (in_balls f)
  end.
Fixpoint in_reals (t : text) : R :=
  match t with
  | number _ exact _ => exact
  | opposite a => - in_reals a
  | sum a b => in_reals a + in_reals b
  | difference a b => in_reals a - in_reals b
  | product a b => in_reals a * in_reals b
  | two_products a b c d => in_reals a * in_reals b - in_reals c * in_reals d
  | three_products a b c d e f => in_reals a * in_reals b + in_reals c * in_reals d + in_reals e * in_reals f
  end.
Fixpoint in_integers (t : text) : Z :=
  match t with
  | number _ _ whole => whole
  | opposite a => - in_integers a
  | sum a b => in_integers a + in_integers b
  | difference a b => in_integers a - in_integers b
  | product a b => in_integers a * in_integers b
  | two_products a b c d => in_integers a * in_integers b - in_integers c * in_integers d
  | three_products a b c d e f => in_integers a * in_integers b + in_integers c * in_integers d + in_integers e * in_integers f
  end%Z.

(* sign_of() *)
Definition sign_of (t : text) : Z :=
  let about := in_balls t in
  if is_sure about then if is_less zero64 (middle about) then 1%Z else (-1)%Z else Z.sgn (in_integers t).

(* What is asked of what a text reads: the ball has the exact number in it; the integer is the exact number in units of 1/s, and only
   what has the same units is added. *)
Fixpoint is_read (t : text) : Prop :=
  match t with
  | number about exact _ => contains about exact
  | opposite a => is_read a
  | sum a b | difference a b | product a b => is_read a /\ is_read b
  | two_products a b c d => is_read a /\ is_read b /\ is_read c /\ is_read d
  | three_products a b c d e f => is_read a /\ is_read b /\ is_read c /\ is_read d /\ is_read e /\ is_read f
  end.
Inductive in_units : R -> text -> Prop :=
| in_units_number : forall s about exact whole, IZR whole = s * exact -> in_units s (number about exact whole)
| in_units_opposite : forall s a, in_units s a -> in_units s (opposite a)
| in_units_sum : forall s a b, in_units s a -> in_units s b -> in_units s (sum a b)
| in_units_difference : forall s a b, in_units s a -> in_units s b -> in_units s (difference a b)
| in_units_product : forall s t a b, in_units s a -> in_units t b -> in_units (s * t) (product a b)
| in_units_two : forall s t a b c d, in_units s a -> in_units t b -> in_units s c -> in_units t d ->
    in_units (s * t) (two_products a b c d)
| in_units_three : forall s t a b c d e f, in_units s a -> in_units t b -> in_units s c -> in_units t d -> in_units s e ->
    in_units t f -> in_units (s * t) (three_products a b c d e f).

Definition sign (x : R) : Z := match Rcompare x 0 with Lt => (-1)%Z | Eq => 0%Z | Gt => 1%Z end.

Theorem balls_contain : forall t, is_read t -> contains (in_balls t) (in_reals t).
Proof.
  induction t; cbn [is_read in_balls in_reals]; intuition auto using negated_contains, add_contains, subtract_contains, multiply_contains,
    difference_of_products_contains, dot_contains.
Qed.

Theorem integers_are_units : forall s t, in_units s t -> IZR (in_integers t) = s * in_reals t.
Proof.
  induction 1; cbn [in_integers in_reals]; rewrite ?plus_IZR, ?minus_IZR, ?opp_IZR, ?mult_IZR;
    rewrite ?IHin_units, ?IHin_units1, ?IHin_units2, ?IHin_units3, ?IHin_units4, ?IHin_units5, ?IHin_units6; try ring; assumption.
Qed.

(* Binary64 is right where it is sure. *)
Theorem sure_is_right : forall a x, contains a x -> is_sure a = true ->
  sign x = if is_less zero64 (middle a) then 1%Z else (-1)%Z.
Proof.
  intros a x [E|(F & G & P & D)] S; unfold is_sure in S.
  { exfalso. destruct (error a) as [s|[]|s p q|s m e q]; try discriminate E; unfold absolute, is_less in S;
      destruct (middle a) as [s'|s'|s' p' q'|s' m' e' q']; discriminate S. }
  destruct (absolute_is (middle a) _ (conj eq_refl F)) as [V W].
  rewrite (less_is _ _ _ _ (conj eq_refl G) (conj V W)) in S.
  rewrite (less_is _ _ _ _ zero_is (conj eq_refl F)). apply Rabs_le_inv in D. unfold sign.
  set (m := value64 (middle a)) in *. set (e := value64 (error a)) in *.
  destruct (Rlt_bool_spec e (Rabs m)) as [L|L]; [|discriminate S].
  case Rlt_bool_spec; intro M.
  - rewrite Rabs_pos_eq in L by lra. rewrite Rcompare_Gt; [reflexivity|lra].
  - rewrite Rabs_left1 in L by lra. rewrite Rcompare_Lt; [reflexivity|lra].
Qed.

Theorem sign_of_is_right : forall t s, is_read t -> in_units s t -> 0 < s -> sign_of t = sign (in_reals t).
Proof.
  intros t s Read Units S. unfold sign_of. cbv zeta. destruct (is_sure (in_balls t)) eqn:E.
  - symmetry. apply sure_is_right; [now apply balls_contain|exact E].
  - pose proof (integers_are_units s t Units) as I. unfold sign.
    assert (C : Rcompare (in_reals t) 0 = Z.compare (in_integers t) 0).
    { rewrite <- Rcompare_IZR, I, <- (Rmult_0_r s). now rewrite Rcompare_mult_l, Rmult_0_r. }
    rewrite C. now destruct (in_integers t).
Qed.

(* ---- Vectors ---- *)

Record texts := Texts { x_text : text; y_text : text; z_text : text }.
Definition texts_minus (a b : texts) : texts :=
  Texts (difference (x_text a) (x_text b)) (difference (y_text a) (y_text b)) (difference (z_text a) (z_text b)).
Definition texts_cross (a b : texts) : texts :=
  Texts (two_products (y_text a) (z_text b) (z_text a) (y_text b)) (two_products (z_text a) (x_text b) (x_text a) (z_text b))
    (two_products (x_text a) (y_text b) (y_text a) (x_text b)).
Definition texts_dot (a b : texts) : text := three_products (x_text a) (x_text b) (y_text a) (y_text b) (z_text a) (z_text b).
Definition exact_vector (a : texts) : vector := Vector (in_reals (x_text a)) (in_reals (y_text a)) (in_reals (z_text a)).
Definition all_read (a : texts) : Prop := is_read (x_text a) /\ is_read (y_text a) /\ is_read (z_text a).
Definition all_in_units (s : R) (a : texts) : Prop := in_units s (x_text a) /\ in_units s (y_text a) /\ in_units s (z_text a).

(* determinant() of fast/soups/numbers.h: on which side of two directions a third one is, which is what a star asks most. *)
Theorem sign_of_determinant_is_right : forall a b c s t u, all_read a -> all_read b -> all_read c ->
  all_in_units s a -> all_in_units t b -> all_in_units u c -> 0 < s -> 0 < t -> 0 < u ->
  sign_of (texts_dot (texts_cross a b) c) = sign (dot (cross (exact_vector a) (exact_vector b)) (exact_vector c)).
Proof.
  intros a b c s t u (A1 & A2 & A3) (B1 & B2 & B3) (C1 & C2 & C3) (D1 & D2 & D3) (E1 & E2 & E3) (F1 & F2 & F3) S T U.
  rewrite (sign_of_is_right _ (s * t * u)); [reflexivity| | |].
  - cbn. repeat split; assumption.
  - repeat constructor; assumption.
  - repeat apply Rmult_lt_0_compat; assumption.
Qed.

(* A corner of a triangle: coordinate() of fast/soups/numbers.h takes each coordinate as it is, and counts units of 2^-53 mm. *)
Record corner := Corner { x_place : binary32; y_place : binary32; z_place : binary32; x_units : Z; y_units : Z; z_units : Z }.
Definition is_coordinate (c : binary32) (units : Z) : Prop := is_finite 24 128 c = true /\ IZR units = bpow radix2 53 * value32 c.
Definition is_corner (a : corner) : Prop :=
  is_coordinate (x_place a) (x_units a) /\ is_coordinate (y_place a) (y_units a) /\ is_coordinate (z_place a) (z_units a).
(* The corner, its integers times w. *)
Definition corner_text (w : Z) (a : corner) : texts :=
  let coordinate c units := number (exactly (to64 c)) (value32 c) (w * units) in
  Texts (coordinate (x_place a) (x_units a)) (coordinate (y_place a) (y_units a)) (coordinate (z_place a) (z_units a)).
Definition normal_text (a b c : corner) : texts :=
  texts_cross (texts_minus (corner_text 1 b) (corner_text 1 a)) (texts_minus (corner_text 1 c) (corner_text 1 a)).
Definition place (a : corner) : vector := Vector (value32 (x_place a)) (value32 (y_place a)) (value32 (z_place a)).

Lemma corner_is_read : forall w a, is_corner a -> all_read (corner_text w a).
Proof.
  intros w a ((F & _) & (G & _) & (H & _)). repeat split; cbn [corner_text x_text y_text z_text is_read];
    [destruct (to64_is_exact _ F) as [<- ?]|destruct (to64_is_exact _ G) as [<- ?]|destruct (to64_is_exact _ H) as [<- ?]];
    now apply exactly_contains.
Qed.
Lemma corner_in_units : forall w a, is_corner a -> all_in_units (IZR w * bpow radix2 53) (corner_text w a).
Proof.
  intros w a ((_ & F) & (_ & G) & (_ & H)).
  repeat split; constructor; rewrite mult_IZR, ?F, ?G, ?H; ring.
Qed.
Lemma minus_is_read : forall a b, all_read a -> all_read b -> all_read (texts_minus a b).
Proof. intros a b (A & B & C) (D & E & F). repeat split; assumption. Qed.
Lemma minus_in_units : forall s a b, all_in_units s a -> all_in_units s b -> all_in_units s (texts_minus a b).
Proof. intros s a b (A & B & C) (D & E & F). repeat split; constructor; assumption. Qed.

(* side_of_plane() of fast/soups/points.h: the side of the plane of the triangle (a, b, c) that the point x is on, which is known as balls,
   and exactly as integers in units of 2^-53/w mm. *)
Theorem side_of_plane_is_right : forall a b c x w, is_corner a -> is_corner b -> is_corner c -> (0 < w)%Z -> all_read x ->
  all_in_units (IZR w * bpow radix2 53) x ->
  sign_of (texts_dot (normal_text a b c) (texts_minus x (corner_text w a))) =
    sign (dot (normal (place a) (place b) (place c)) (minus (exact_vector x) (place a))).
Proof.
  intros a b c x w A B C W Rx Ux. pose proof (IZR_lt 0 w W) as W'. pose proof (bpow_gt_0 radix2 53) as P.
  pose proof (corner_is_read 1 a A) as RA. pose proof (corner_is_read 1 b B) as RB. pose proof (corner_is_read 1 c C) as RC.
  pose proof (corner_in_units 1 a A) as UA. pose proof (corner_in_units 1 b B) as UB. pose proof (corner_in_units 1 c C) as UC.
  rewrite Rmult_1_l in UA, UB, UC. unfold normal_text.
  rewrite (sign_of_determinant_is_right _ _ _ (bpow radix2 53) (bpow radix2 53) (IZR w * bpow radix2 53));
    auto using minus_is_read, minus_in_units, corner_is_read, corner_in_units.
  apply Rmult_lt_0_compat; assumption.
Qed.
