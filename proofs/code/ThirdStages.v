(* SPDX-License-Identifier: BSD-3-Clause *)
(* The third stages of the laws in any arithmetic, as the headers of fast/laws/ are templates: exact() of each law, decide() of
   fast/evaluate.h and round_to_binary32() of fast/numbers/ball.h. There are two arithmetics, of limbs and of integers. *)
From Coq Require Import ZArith Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Evaluate Inputs.
From Forceshade Require Import TwoPolygonsGap ThreePolygonsConstants ThreePolygonsGap NewtonRounded NewtonThird NewtonRest SineOfThird.
From Forceshade Require Import SecondAlong CylinderSecond.
From Forceshade Require Import BigFloat BigFloatValues BigFloatProducts BigFloatNewton BigFloatRight BigFloatSearch BigFloatDecide.
From Forceshade Require Import WideNumbers.

(* What a law's exact() asks of a number (fast/numbers/ball.h). *)
Record arithmetic (number : Type) := {
  from_binary64 : binary64 -> number;
  opposite : number -> number;
  sum : number -> number -> number;
  product : number -> number -> number;
  quotient : number -> number -> number;
  root : number -> number;
  cut : number -> Z -> number;      (* truncated *)
  blurred : number -> Z -> number;  (* widened *)
  sign_of : number -> comparison;
  approximation : number -> binary64
}.
Arguments from_binary64 {number}. Arguments opposite {number}. Arguments sum {number}. Arguments product {number}.
Arguments quotient {number}. Arguments root {number}. Arguments cut {number}. Arguments blurred {number}. Arguments sign_of {number}.
Arguments approximation {number}.

(* Of `count` limbs, by the loops of the code, and of one integer in their place. *)
Definition of_limbs (outside : Z -> Z) (count : nat) : arithmetic wide := {|
  from_binary64 := wide_exactly count;
  opposite := wide_negated;
  sum := wide_add outside count;
  product := wide_multiply outside count;
  quotient := wide_divide outside count;
  root := wide_square_root outside count;
  cut := wide_truncated outside count;
  blurred := wide_widened outside;
  sign_of := wide_sign outside;
  approximation := wide_approximately outside
|}.
Definition of_integers (count : nat) : arithmetic big := let width := (64 * Z.of_nat count)%Z in {|
  from_binary64 := exactly width;
  opposite := negated;
  sum := add width;
  product := multiply width;
  quotient := divide_newton width;
  root := square_root_newton width;
  cut := truncated width;
  blurred := widened;
  sign_of := sign_of_big;
  approximation := approximately width
|}.

Module Third.
Section AnyArithmetic.
Context {number : Type} (A : arithmetic number).
Declare Scope number_scope.
Delimit Scope number_scope with number.
Local Notation "a + b" := (sum A a%number b%number) : number_scope.
Local Notation "a - b" := (sum A a%number (opposite A b%number)) : number_scope.
Local Notation "a * b" := (product A a%number b%number) : number_scope.
Local Notation "a / b" := (quotient A a%number b%number) : number_scope.
Local Notation of64 := (from_binary64 A).
Local Notation of32 a := (from_binary64 A (to64 a)).
Open Scope number_scope.

(* ---- Answers ---- *)

Definition rounded (value : number) : option binary32 :=
  search (fun tie => sign_of A (value - of64 tie)) 3 (to32 (approximation A value)).

(* The sign of the contact and the components along x and z. *)
Definition outcome : Type := comparison * number * number.
Definition decide (found : outcome) : evaluation :=
  let '(contact_sign, fx, fz) := found in
  match contact_sign with
  | Gt =>
    match rounded fx, rounded fz with
    | Some x, Some z => (contact, (x, zero32, z))
    | _, _ => no_force invalid
    end
  | _ => no_force free
  end.

Definition along (K : binary32) (gap normal_x normal_z : number) : outcome :=
  let magnitude := of32 K * gap in (sign_of A gap, magnitude * normal_x, magnitude * normal_z).
Definition on_plane (K z : binary32) : outcome := along K (of64 (opp (to64 z))) (of64 zero64) (of64 (two_to 0)).
Definition along_shaded (K R x : binary32) (gap : number) : outcome :=
  let radius := of32 R in let X := of32 x in along K (gap / radius) X (root A ((radius - X) * (radius + X))).

(* ---- Geometry ---- *)

Definition depth (R w : binary32) : number :=
  let radius := of32 R in let half := of64 (half_width w) in root A ((radius - half) * (radius + half)).
Definition side_gap (tangent : number) (w x z : binary32) : number :=
  tangent * (of64 (half_width w) - of32 (b32_abs x)) - of32 z.

(* Sine, cosine and slope of a side face of two polygons. *)
Definition sum_2p (R w : binary32) : number := of32 R + depth R w.
Definition cosine_2p (R w : binary32) : number := root A (sum_2p R w / (of32 R + of32 R)).
Definition sine_2p (R w : binary32) : number := of64 (half_width w) / ((of32 R + of32 R) * cosine_2p R w).
Definition tangent_2p (R w : binary32) : number := of64 (half_width w) / sum_2p R w.

(* Newton's method for a root, and its interval form. *)
Definition corrected (value_of slope_of : number -> number) (x y : number) : number := x - value_of x / slope_of y.
Fixpoint newton_steps (value_of slope_of : number -> number) (steps : nat) (bits : Z) (x : number) : number :=
  match steps with
  | O => x
  | S rest => newton_steps value_of slope_of rest (2 * bits)%Z (cut A (corrected value_of slope_of x x) (2 * bits)%Z)
  end.
Definition newton_root (value_of slope_of : number -> number) (start : binary64) : number :=
  let x := newton_steps value_of slope_of 7 50 (of64 start) in corrected value_of slope_of x (blurred A x (-40)).

Local Notation number_of n := (of64 (whole n)).
Definition third_value (s y : number) : number := (number_of 4 * y * y - number_of 3) * y + s.
Definition third_slope (y : number) : number := number_of 12 * y * y - number_of 3.
Definition rest_value (r y : number) : number := (number_of 6 - number_of 4 * y) * y * y - r.
Definition rest_slope (y : number) : number := number_of 12 * y * (number_of 1 - y).

Definition sine_of_third (R w : binary32) : number :=
  if is_at_most (half_over_radius R w) (two_to (-1)) then
    newton_root (third_value (of64 (half_width w) / of32 R)) third_slope (third_start R w)
  else if is_equal (half_width w) (to64 R) then of64 (two_to (-1))
  else of64 (two_to (-1)) -
    newton_root (rest_value (of64 (minus (to64 R) (half_width w)) / of32 R)) rest_slope (rest_start R w).

(* Of three polygons, by the sine t of a third of the angle. *)
Definition twice (a : number) : number := of64 (two_to 1) * a.
Definition sine_3p (t : number) : number := twice t * root A ((of64 (two_to 0) - t) * (of64 (two_to 0) + t)).
Definition cosine_3p (t : number) : number := of64 (two_to 0) - twice t * t.
Definition tangent_3p (t : number) : number := sine_3p t / cosine_3p t.
Definition top_height (R : binary32) (t : number) : number := twice (of32 R * t) * sine_3p t.
Definition gap_3p (R w x z : binary32) : number :=
  let t := sine_of_third R w in if is_on_flat R w x then top_height R t - of32 z else side_gap (tangent_3p t) w x z.

(* ---- The laws ---- *)

Definition cylinder (R w K x z : binary32) : outcome :=
  let X := of32 x in let Z := of32 z in let half := of64 (half_width w) in let d := depth R w in
  let l := Z + d in
  match (if is_nonzero x then Gt else sign_of A l) with
  | Eq => (Gt, of64 zero64, of32 K * of32 R)
  | _ =>
    let v := (half - X) * (half + X) - Z * (l + d) in
    let rho := root A (X * X + l * l) in
    let scale := of32 K * v / ((of32 R + rho) * rho) in
    (sign_of A v, scale * X, scale * l)
  end.

Definition bump_cylinder (R w K x z : binary32) : outcome :=
  let force := cylinder R w K x z in
  if negb (is_less32 z zero32) then force
  else
    match fst (fst force) with
    | Gt => (Gt, snd (fst force), snd force + snd (on_plane K z))
    | _ => on_plane K z
    end.

Definition bump_2p (R w K x z : binary32) : outcome :=
  if is_beside w x then on_plane K z
  else
    let sine := sine_2p R w in
    along K (side_gap (tangent_2p R w) w x z) (if is_less32 x zero32 then opposite A sine else sine) (cosine_2p R w).

Definition bump_3p (R w K x z : binary32) : outcome :=
  if is_beside w x then on_plane K z
  else
    let t := sine_of_third R w in
    if is_on_flat R w x then along K (top_height R t - of32 z) (of64 zero64) (of64 (two_to 0))
    else along K (side_gap (tangent_3p t) w x z) (if is_less32 x zero32 then opposite A (sine_3p t) else sine_3p t) (cosine_3p t).

Definition bump_1p_shaded (R w K x z : binary32) : outcome :=
  if is_beside w x then on_plane K z else along_shaded K R x (of64 (opp (to64 z))).

Definition bump_2p_shaded (R w K x z : binary32) : outcome :=
  if is_beside w x then on_plane K z
  else along_shaded K R x (if is_at_foot w x then of64 (opp (to64 z)) else side_gap (tangent_2p R w) w x z).

Definition bump_3p_shaded (R w K x z : binary32) : outcome :=
  if is_beside w x then on_plane K z
  else along_shaded K R x (if is_at_foot w x then of64 (opp (to64 z)) else gap_3p R w x z).
End AnyArithmetic.
End Third.

(* The third stage of a law, by its exact(). *)
Definition third_stage {number} (A : arithmetic number)
    (exact : arithmetic number -> binary32 -> binary32 -> binary32 -> binary32 -> binary32 -> Third.outcome)
    (R w K x z : binary32) : evaluation := Third.decide A (exact A R w K x z).
