(* SPDX-License-Identifier: BSD-3-Clause *)
(* The third stage's number, over the integers: fast/numbers/big_float_ball.h. `width` is kBits. Written otherwise than there: the
   limbs are one whole number, a shift is a quotient by a power of two, and a bit is lost where the remainder is not 0. No exponent
   leaves the range of its 64 bits in the theorems, which ask for exponents below 2^50; so integers of any size stand for them. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core.
Open Scope R_scope.

(* The value is +-0.digits times 2^exponent. *)
Record big := Big { negative : bool; digits : Z; exponent : Z; error : Z }.

(* The exponent of the error of what is exact; below half of it, all is exact. From `boundless` on, nothing is known of the number:
   the code's infinite error is twice that, so that it remains so if an exponent is taken from it. *)
Definition none : Z := - 2 ^ 60.
Definition least : Z := - 2 ^ 59.
Definition infinite : Z := 2 ^ 58.
Definition boundless : Z := 2 ^ 57.

Definition signed (a : big) : Z := if negative a then - digits a else digits a.
Definition value (width : Z) (a : big) : R := IZR (signed a) * bpow radix2 (exponent a - width).

(* The size that an exponent of an error stands for. *)
Definition size (e : Z) : R := if (e <? least)%Z then 0 else bpow radix2 e.
Definition within (e : Z) (d : R) : Prop := (boundless <= e)%Z \/ d <= size e.
Definition contains (width : Z) (a : big) (x : R) : Prop := within (error a) (Rabs (x - value width a)).

(* The top bit is 1, or all bits are 0. *)
Definition normal (width : Z) (a : big) : Prop := digits a = 0%Z \/ (2 ^ (width - 1) <= digits a < 2 ^ width)%Z.

(* Neither exponent is larger than k; but the error may be none, or infinite. *)
Definition error_fits (k e : Z) : Prop := e = none \/ (- k <= e <= k)%Z \/ (infinite - k <= e <= infinite + k)%Z.
Definition fits (k : Z) (a : big) : Prop := (- k <= exponent a <= k)%Z /\ error_fits k (error a).
Definition range : Z := 2 ^ 50.

Definition is_zero (a : big) : bool := (digits a =? 0)%Z.
Definition is_exact (a : big) : bool := (error a <? least)%Z.
Definition is_exact_zero (a : big) : bool := is_zero a && is_exact a.
Definition may_be_zero (a : big) : bool := is_zero a || (exponent a - 2 <? error a)%Z.
Definition clamp (e : Z) : Z := if (e <? least)%Z then none else if (infinite <? e)%Z then infinite else e.
Definition with_error (a : big) (e : Z) : big := Big (negative a) (digits a) (exponent a) (clamp e).
Definition zero : big := Big false 0 0 none.
Definition midpoint (a : big) : big := Big (negative a) (digits a) (exponent a) none.
Definition negated (a : big) : big := Big (negb (negative a)) (digits a) (exponent a) (error a).
Definition widened (a : big) (k : Z) : big := with_error a (exponent a + k).
Definition scaled (a : big) (k : Z) : big := with_error (Big (negative a) (digits a) (exponent a + k) (error a)) (error a + k).
(* The smallest e known with |true value| < 2^e. *)
Definition magnitude (a : big) : Z := (Z.max (if is_zero a then none else exponent a) (error a) + 1)%Z.

(* The same number in more or fewer bits. *)
Definition converted (width other : Z) (a : big) : big :=
  let kept := (if other <=? width then digits a * 2 ^ (width - other) else digits a / 2 ^ (other - width))%Z in
  let lost := negb (other <=? width)%Z && negb (digits a mod 2 ^ (other - width) =? 0)%Z in
  Big (negative a) kept (exponent a) (if lost then Z.max (error a) (exponent a - width + 1) + 1 else error a).

(* The leading one moved to the top bit. *)
Definition normalised (width : Z) (a : big) : big :=
  if is_zero a then Big false 0 0 (error a)
  else let part := (width - 1 - Z.log2 (digits a))%Z in Big (negative a) (digits a * 2 ^ part) (exponent a - part) (error a).

Definition add_limbs (width : Z) (a : big) (other : Z) : big :=
  let sum := (digits a + other)%Z in
  if (sum <? 2 ^ width)%Z then Big (negative a) sum (exponent a) (error a)
  else Big (negative a) (sum / 2) (exponent a + 1) (if (sum mod 2 =? 0)%Z then error a else Z.max (error a) (exponent a + 1 - width)).
Definition subtract_limbs (width : Z) (a : big) (other : Z) : big :=
  normalised width (Big (negative a) (digits a - other) (exponent a) (error a)).

(* Neither is 0. *)
Definition add_smaller (width : Z) (large small : big) : big :=
  let shift := (2 ^ (exponent large - exponent small))%Z in
  let shifted := (digits small / shift)%Z in
  let lost := negb (digits small mod shift =? 0)%Z in
  let result := if eqb (negative large) (negative small) then add_limbs width large shifted else subtract_limbs width large shifted in
  let rounding := if lost then (exponent large - width + 1)%Z else none in
  with_error result (Z.max (Z.max (error result) (error small)) rounding + 2).

(* compare_magnitudes(a, b) >= 0 *)
Definition is_larger (a b : big) : bool :=
  if (exponent a =? exponent b)%Z then (digits b <=? digits a)%Z else (exponent b <? exponent a)%Z.

Definition add (width : Z) (a b : big) : big :=
  if is_zero a then with_error b (Z.max (error a) (error b) + 1)
  else if is_zero b then with_error a (Z.max (error a) (error b) + 1)
  else if is_larger a b then add_smaller width a b else add_smaller width b a.
Definition subtract (width : Z) (a b : big) : big := add width a (negated b).

Definition propagated_by_product (a b : big) : Z :=
  Z.max (Z.max (exponent a + error b) (exponent b + error a)) (error a + error b).

(* The digits of the product are moved up by 1 where its top bit is 0. *)
Definition multiply (width : Z) (a b : big) : big :=
  let propagated := propagated_by_product a b in
  if is_zero a || is_zero b then with_error zero (if is_exact_zero a || is_exact_zero b then none else propagated + 2)
  else
    let product := (digits a * digits b)%Z in
    let part := (if product <? 2 ^ (2 * width - 1) then 1 else 0)%Z in
    let rest := (2 ^ (width - part))%Z in
    let e := (exponent a + exponent b - part)%Z in
    let lost := negb (product mod rest =? 0)%Z in
    with_error (Big (xorb (negative a) (negative b)) (product / rest) e none)
      (Z.max propagated (if lost then e - width + 2 else none) + 2).

(* What follows Newton's method, whatever it gave for 1/b. *)
Definition divide (width : Z) (a b inverse : big) : big :=
  if may_be_zero b then with_error zero infinite
  else if is_zero a then with_error zero (if is_exact_zero a then none else error a - exponent b + 3)
  else
    let divisor := midpoint b in
    let dividend := midpoint a in
    let first := midpoint (multiply width dividend inverse) in
    let quotient := midpoint (add width first (multiply width (subtract width dividend (multiply width first divisor)) inverse)) in
    let remainder := (magnitude (subtract width dividend (multiply width quotient divisor)) - exponent b + 2)%Z in
    let propagated := (Z.max (error a - exponent b) (exponent a + error b - 2 * exponent b) + 4)%Z in
    with_error quotient (Z.max remainder propagated + 1).

(* The root before its bound; inverse: what Newton's method gave for the inverse of the root. *)
Definition root_of_midpoint (width : Z) (square inverse : big) : big :=
  let first := midpoint (multiply width square inverse) in
  midpoint (add width first (scaled (multiply width (subtract width square (multiply width first first)) inverse) (-1))).
Definition square_root (width : Z) (a inverse : big) : big :=
  if is_exact_zero a then a
  else if may_be_zero a || negative a then with_error zero (Z.quot (Z.max (exponent a) (error a) + 4) 2 + 1)
  else
    let square := midpoint a in
    let root := root_of_midpoint width square inverse in
    let remainder := (magnitude (subtract width square (multiply width root root)) - exponent root + 1)%Z in
    with_error root (Z.max remainder (error a - exponent root + 2) + 1).

(* ---- Sizes of errors ---- *)

Ltac numbers := unfold error_fits, none, least, infinite, boundless, range in *.

Lemma size_pos : forall e, 0 <= size e.
Proof. intro e. unfold size. destruct (e <? least)%Z; [lra|apply bpow_ge_0]. Qed.

Lemma size_le : forall e f, (e <= f)%Z -> size e <= size f.
Proof.
  intros e f H. unfold size. destruct (Z.ltb_spec e least), (Z.ltb_spec f least); try lra; try lia; [apply bpow_ge_0|now apply bpow_le].
Qed.

Lemma size_none : forall e, (e < least)%Z -> size e = 0.
Proof. intros e H. unfold size. now rewrite (proj2 (Z.ltb_lt _ _) H). Qed.

Lemma size_some : forall e, (least <= e)%Z -> size e = bpow radix2 e.
Proof. intros e H. unfold size. now rewrite (proj2 (Z.ltb_ge _ _) H). Qed.

Lemma bpow_double : forall e, bpow radix2 (e + 1) = 2 * bpow radix2 e.
Proof. intro e. rewrite bpow_plus. change (bpow radix2 1) with 2. ring. Qed.

Lemma size_double : forall e, 2 * size e <= size (e + 1).
Proof.
  intro e. destruct (Z.ltb_spec e least) as [H|H]; [rewrite (size_none _ H); pose proof (size_pos (e + 1)); lra|].
  rewrite !size_some, bpow_double by lia. lra.
Qed.

Lemma size_four : forall e, 4 * size e <= size (e + 2).
Proof. intro e. pose proof (size_double e) as D. pose proof (size_double (e + 1)) as S. replace (e + 1 + 1)%Z with (e + 2)%Z in S by ring.
    lra. Qed.

Lemma size_times : forall e k, (e < least \/ least <= e + k)%Z -> size e * bpow radix2 k <= size (e + k).
Proof.
  intros e k H. destruct (Z.ltb_spec e least) as [L|L].
  - rewrite (size_none _ L), Rmult_0_l. apply size_pos.
  - rewrite !size_some, bpow_plus by lia. lra.
Qed.

Lemma size_product : forall e f, (e < least \/ f < least \/ least <= e + f)%Z -> size e * size f <= size (e + f).
Proof.
  intros e f H. destruct (Z.ltb_spec f least) as [L|L].
  - rewrite (size_none f L), Rmult_0_r. apply size_pos.
  - rewrite (size_some f L). apply size_times. lia.
Qed.

Lemma within_le : forall e f d g, within e d -> (e <= f)%Z -> g <= d -> within f g.
Proof. intros e f d g [H|H] E D; [left; lia|right]. pose proof (size_le _ _ E). lra. Qed.

Lemma within_clamp : forall e d, within e d -> within (clamp e) d.
Proof.
  intros e d H. unfold clamp. destruct (Z.ltb_spec e least) as [L|L].
  - right. destruct H as [H|H]; [numbers; lia|]. rewrite (size_none _ L) in H. apply Rle_trans with (1 := H), size_pos.
  - destruct (Z.ltb_spec infinite e) as [B|B]; [left; numbers; lia|exact H].
Qed.

Lemma value_with_error : forall width a e, value width (with_error a e) = value width a.
Proof. reflexivity. Qed.

Lemma contains_with_error : forall width a e x, within e (Rabs (x - value width a)) -> contains width (with_error a e) x.
Proof. intros width a e x H. apply within_clamp, H. Qed.

Lemma clamp_fits : forall k e, (0 <= k <= range)%Z -> error_fits k e \/ (e < least)%Z \/ (infinite - k <= e)%Z ->
  error_fits k (clamp e).
Proof. intros k e K H. unfold clamp. destruct (Z.ltb_spec e least), (Z.ltb_spec infinite e); numbers; lia. Qed.
