(* SPDX-License-Identifier: BSD-3-Clause *)
(* The third stage's number as the code has it: fast/numbers/big_float_ball.h, its limbs a list of `count` 64-bit numbers, the least
   significant first, its exponents numbers of 64 bits. `outside` is what a machine makes of a result that does not fit them: theorems
   are for any, so they say that there is none. Loops over limbs are in proofs/limbs/Limbs.v, LimbShifts.v and LimbNumbers.v. *)
From Coq Require Import ZArith List Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations BigFloat BigFloatValues BigFloatNewton Limbs LimbShifts LimbNumbers LimbsAreDigits.
Import ListNotations.
Open Scope Z_scope.

(* The value is +-0.limbs times 2^exponent. *)
Record wide := Wide { is_negative : bool; limbs : list Z; binary_exponent : Z; error_exponent : Z }.

Section Machine.
Context (outside : Z -> Z) (count : nat).

Definition int64 (t : Z) : Z := if (- 2 ^ 63 <=? t) && (t <? 2 ^ 63) then t else outside t.
Definition int32 (t : Z) : Z := if (- 2 ^ 31 <=? t) && (t <? 2 ^ 31) then t else outside t.
Local Notation "a +! b" := (int64 (a + b)) (at level 50, left associativity).
Local Notation "a -! b" := (int64 (a - b)) (at level 50, left associativity).
Local Notation "-! a" := (int64 (- a)) (at level 35, right associativity).

Definition bits_of_all : Z := 64 * Z.of_nat count.
Definition wide_zero : wide := Wide false (repeat 0 count) 0 none.

(* frexp and ldexp: the significand is moved up to the top bit of the highest limb. *)
Definition wide_exactly (v : binary64) : wide :=
  match v with
  | B754_finite _ _ s m e _ =>
      let bits := Z.log2 (Zpos m) + 1 in Wide s (repeat 0 (count - 1) ++ [Zpos m * 2 ^ (64 - bits)]) (e + bits) none
  | _ => wide_zero
  end.

Definition with_wide_error (a : wide) (e : Z) : wide := Wide (is_negative a) (limbs a) (binary_exponent a) (clamp e).
Definition wide_midpoint (a : wide) : wide := Wide (is_negative a) (limbs a) (binary_exponent a) none.
Definition wide_negated (a : wide) : wide := Wide (negb (is_negative a)) (limbs a) (binary_exponent a) (error_exponent a).
Definition wide_is_zero (a : wide) : bool := last (limbs a) 0 =? 0.
Definition wide_is_exact_zero (a : wide) : bool := wide_is_zero a && (error_exponent a <? least).
Definition wide_may_be_zero (a : wide) : bool := wide_is_zero a || (binary_exponent a -! 2 <? error_exponent a).
Definition wide_magnitude (a : wide) : Z := Z.max (if wide_is_zero a then none else binary_exponent a) (error_exponent a) +! 1.
Definition wide_scaled (a : wide) (k : Z) : wide :=
  with_wide_error (Wide (is_negative a) (limbs a) (binary_exponent a +! k) (error_exponent a)) (error_exponent a +! k).
Definition wide_widened (a : wide) (k : Z) : wide := with_wide_error a (binary_exponent a +! k).
Definition wide_truncated (a : wide) (bits : Z) : wide :=
  let dropped := Z.to_nat (Z.of_nat count -! (bits / 64 +! 2)) in
  Wide (is_negative a) (repeat 0 dropped ++ skipn dropped (limbs a)) (binary_exponent a) none.
Definition wide_sign (a : wide) : comparison := if wide_may_be_zero a then Eq else if is_negative a then Lt else Gt.

(* The highest limb in binary64. *)
Definition wide_fraction (a : wide) : binary64 := ldexp (double_of (last (limbs a) 0)) (-64).
Definition wide_approximately (a : wide) : binary64 :=
  if wide_is_zero a then zero64
  else let v := ldexp (wide_fraction a) (int32 (Z.max (binary_exponent a) (-1070))) in if is_negative a then opp v else v.

(* ---- Sums ---- *)

(* compare_magnitudes(a, b) >= 0 *)
Definition wide_is_larger (a b : wide) : bool :=
  if binary_exponent a =? binary_exponent b then match compare_limbs (limbs a) (limbs b) with Lt => false | _ => true end
  else binary_exponent b <? binary_exponent a.

Definition wide_normalised (below : Z) (a : wide) : wide :=
  match top (limbs a) with
  | O => Wide false (limbs a) 0 (error_exponent a)
  | S _ => let (moved, up) := normalised_limbs below (limbs a) in Wide (is_negative a) moved (binary_exponent a -! up) (error_exponent a)
  end.

Definition wide_add_limbs (a : wide) (other : list Z) : wide :=
  let '(sum, carried, dropped) := added_limbs (limbs a) other in
  let e := if carried then binary_exponent a +! 1 else binary_exponent a in
  Wide (is_negative a) sum e (if dropped then Z.max (error_exponent a) (e -! bits_of_all) else error_exponent a).
Definition wide_subtract_limbs (a : wide) (other : list Z) : wide :=
  wide_normalised 0 (Wide (is_negative a) (fst (subtract_with (limbs a) other 0)) (binary_exponent a) (error_exponent a)).

Definition wide_add_smaller (large small : wide) : wide :=
  let (shifted, lost) := shift_right_limbs (binary_exponent large -! binary_exponent small) (limbs small) in
  let result := if eqb (is_negative large) (is_negative small) then wide_add_limbs large shifted else wide_subtract_limbs large shifted in
  let rounding := if lost then binary_exponent large -! bits_of_all +! 1 else none in
  with_wide_error result (Z.max (Z.max (error_exponent result) (error_exponent small)) rounding +! 2).

Definition wide_add (a b : wide) : wide :=
  if wide_is_zero a then with_wide_error b (Z.max (error_exponent a) (error_exponent b) +! 1)
  else if wide_is_zero b then with_wide_error a (Z.max (error_exponent a) (error_exponent b) +! 1)
  else if wide_is_larger a b then wide_add_smaller a b else wide_add_smaller b a.
Definition wide_subtract (a b : wide) : wide := wide_add a (wide_negated b).

(* ---- Products ---- *)

(* The loop ends at the highest limb. *)
Fixpoint lowest_limb (l : list Z) : nat :=
  match l with a :: (_ :: _) as rest => if a =? 0 then S (lowest_limb rest) else O | _ => O end.

(* Both loops begin at the lowest limb that is not 0. *)
Definition product_of_limbs (l m : list Z) : list Z :=
  let i := lowest_limb l in let j := lowest_limb m in
  repeat 0 (i + j) ++ multiply_limbs (skipn i l) (skipn j m) (repeat 0 (length m - j)).

Definition wide_multiply (a b : wide) : wide :=
  let propagated := Z.max (Z.max (binary_exponent a +! error_exponent b) (binary_exponent b +! error_exponent a))
    (error_exponent a +! error_exponent b) in
  if wide_is_zero a || wide_is_zero b then
    with_wide_error wide_zero (if wide_is_exact_zero a || wide_is_exact_zero b then none else propagated +! 2)
  else
    let product := product_of_limbs (limbs a) (limbs b) in
    let e := binary_exponent a +! binary_exponent b in
    let result := wide_normalised (nth (count - 1) product 0)
      (Wide (xorb (is_negative a) (is_negative b)) (skipn count product) e none) in
    let taken := e -! binary_exponent result in
    let rounding := if product_lost count product taken then binary_exponent result -! bits_of_all +! 2 else none in
    with_wide_error result (Z.max propagated rounding +! 2).

(* ---- Quotients and roots ---- *)

Definition wide_one : wide := wide_exactly (two_to 0).

(* `fuel` is no less than the number of steps. *)
Fixpoint wide_newton (fuel : nat) (step : wide -> wide) (bits : Z) (inverse : wide) : wide :=
  match fuel with
  | O => inverse
  | S rest =>
      if bits <? bits_of_all then wide_newton rest step (int64 (2 * bits)) (wide_truncated (step inverse) (int64 (2 * bits))) else inverse
  end.

Definition wide_inverse_step (divisor inverse : wide) : wide :=
  wide_add inverse (wide_multiply inverse (wide_subtract wide_one (wide_multiply divisor inverse))).
Definition wide_inverse (b : wide) : wide :=
  wide_newton (newton_fuel bits_of_all) (wide_inverse_step (wide_midpoint b)) 50
    (wide_scaled (wide_exactly (over (if is_negative b then opp (two_to 0) else two_to 0) (wide_fraction b))) (-! binary_exponent b)).

Definition wide_divide (a b : wide) : wide :=
  if wide_may_be_zero b then with_wide_error wide_zero infinite
  else if wide_is_zero a then
    with_wide_error wide_zero (if wide_is_exact_zero a then none else error_exponent a -! binary_exponent b +! 3)
  else
    let divisor := wide_midpoint b in
    let inverse := wide_inverse b in
    let dividend := wide_midpoint a in
    let first := wide_midpoint (wide_multiply dividend inverse) in
    let quotient := wide_midpoint (wide_add first (wide_multiply (wide_subtract dividend (wide_multiply first divisor)) inverse)) in
    let remainder := wide_magnitude (wide_subtract dividend (wide_multiply quotient divisor)) -! binary_exponent b +! 2 in
    let propagated := Z.max (error_exponent a -! binary_exponent b)
      (binary_exponent a +! error_exponent b -! int64 (2 * binary_exponent b)) +! 4 in
    with_wide_error quotient (Z.max remainder propagated +! 1).

Definition wide_half_exponent (a : wide) : Z :=
  if 0 <=? binary_exponent a then Z.quot (binary_exponent a) 2 else -! Z.quot (1 -! binary_exponent a) 2.
Definition wide_inverse_root_step (square inverse : wide) : wide :=
  wide_add inverse (wide_scaled (wide_multiply inverse (wide_subtract wide_one (wide_multiply square (wide_multiply inverse inverse))))
    (-1)).
Definition wide_inverse_root (a : wide) : wide :=
  let half := wide_half_exponent a in
  let reduced := ldexp (wide_fraction a) (int32 (binary_exponent a -! int64 (2 * half))) in
  wide_newton (newton_fuel bits_of_all) (wide_inverse_root_step (wide_midpoint a)) 49
    (wide_scaled (wide_exactly (over (two_to 0) (Operations.square_root reduced))) (-! half)).

Definition wide_square_root (a : wide) : wide :=
  if wide_is_exact_zero a then a
  else if wide_may_be_zero a || is_negative a then
    with_wide_error wide_zero (Z.quot (Z.max (binary_exponent a) (error_exponent a) +! 4) 2 +! 1)
  else
    let square := wide_midpoint a in
    let inverse := wide_inverse_root a in
    let first := wide_midpoint (wide_multiply square inverse) in
    let root := wide_midpoint (wide_add first
      (wide_scaled (wide_multiply (wide_subtract square (wide_multiply first first)) inverse) (-1))) in
    let remainder := wide_magnitude (wide_subtract square (wide_multiply root root)) -! binary_exponent root +! 1 in
    with_wide_error root (Z.max remainder (error_exponent a -! binary_exponent root +! 2) +! 1).
End Machine.
