(* SPDX-License-Identifier: BSD-3-Clause *)
(* Balls, numbers with a bound of their error (fast/numbers/ball.h), as the recorded terms of proofs/recorded/RecordedStages.v ask for
   them: the second stage's, and those of any arithmetic of the third. *)
From Coq Require Import ZArith.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Depth DoubleDoubleHolds BesideTie SecondStage NewtonThird ThirdStages.

Record ball (number : Type) := {
  exactly_in : binary64 -> number;
  minus_in : number -> number;
  sum_in : number -> number -> number;
  product_in : number -> number -> number;
  quotient_in : number -> number -> number;
  root_in : number -> number;
  truncated_in : number -> Z -> number;
  widened_in : number -> Z -> number;
  sign_in : number -> Sign;
  approximation_in : number -> binary64;
  nearest_in : number -> option binary32  (* round_to_binary32 *)
}.
Arguments exactly_in {number}. Arguments minus_in {number}. Arguments sum_in {number}. Arguments product_in {number}.
Arguments quotient_in {number}. Arguments root_in {number}. Arguments truncated_in {number}. Arguments widened_in {number}.
Arguments sign_in {number}. Arguments approximation_in {number}. Arguments nearest_in {number}.

Definition two_terms : ball double_double := {|
  exactly_in := exactly64;
  minus_in := negated;
  sum_in := add;
  product_in := multiply;
  quotient_in := divide;
  root_in := root_of;
  truncated_in a _ := midpoint a;
  widened_in a k := {| hi := hi a; lo := lo a; error := times (two_to k) (absolute (hi a)) |};
  sign_in := BesideTie.sign_of;
  approximation_in := hi;
  nearest_in := rounded_to_binary32
|}.

Definition as_sign (s : comparison) : Sign := match s with Lt => is_negative | Eq => is_zero | Gt => is_positive end.

Definition of_arithmetic {number} (A : arithmetic number) : ball number := {|
  exactly_in := from_binary64 A;
  minus_in := opposite A;
  sum_in := sum A;
  product_in := product A;
  quotient_in := quotient A;
  root_in := root A;
  truncated_in := cut A;
  widened_in := blurred A;
  sign_in a := as_sign (ThirdStages.sign_of A a);
  approximation_in := approximation A;
  nearest_in := Third.rounded A
|}.

(* a == b of binary32. *)
Definition is_equal32 (a b : binary32) : bool := match Bcompare 24 128 a b with Some Eq => true | _ => false end.

(* has_value() and operator* of std::optional. *)
Definition is_given (found : option binary32) : bool := match found with Some _ => true | None => false end.
Definition given (found : option binary32) : binary32 := match found with Some value => value | None => zero32 end.
