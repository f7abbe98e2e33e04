(* SPDX-License-Identifier: BSD-3-Clause *)
(* Gappa hands the rewritings of a script to Coq as hypotheses. Each is an identity of real numbers under the conditions that the
   script gives in braces; the tactic "rewriting" proves it (tests/fast/coq_test.sh). *)
From Coq Require Export Reals Lra.
From Flocq Require Import Core.
From Gappa Require Import Gappa_library.
Open Scope R_scope.

(* Constants as numbers; a rounded number may be any number. *)
Ltac numbers :=
  cbv [float2R F2R Defs.Fnum Defs.Fexp Gappa_definitions.Fnum Gappa_definitions.Fexp Float1 bpow] in *;
  repeat match goal with
  | |- context [Z.pow_pos (radix_val radix2) ?e] =>
    let power := eval vm_compute in (Z.pow_pos 2 e) in change (Z.pow_pos (radix_val radix2) e) with power in *
  end.
Ltac forget_roundings :=
  repeat match goal with |- context [rounding_float ?mode ?precision ?least ?exact] =>
    let any := fresh "rounded" in set (any := rounding_float mode precision least exact) in *; clearbody any
  end.

(* A root of a number a, or a + b, that is not negative by the conditions gives that number: it is the square of the root. Of another
   root nothing is used. *)
Ltac know_roots :=
  repeat match goal with not_negative : ?a >= 0 |- context [sqrt ?a] =>
    let square := fresh "square" in pose proof (sqrt_sqrt a ltac:(lra)) as square; clear not_negative
  end;
  repeat match goal with |- context [sqrt ?a] => let root := fresh "root" in set (root := sqrt a) in *; clearbody root end;
  repeat match goal with
  | square : ?root * ?root = ?a + ?b |- _ => assert (b = root * root - a) by lra; clear square; subst b
  | square : ?root * ?root = ?a |- _ => subst a
  end.

(* What field leaves: that numbers are not 0 each of which is a constant times one or two that are not 0 by the conditions. *)
Ltac not_zero :=
  repeat match goal with |- _ /\ _ => split end;
  first [assumption | lra |
  match goal with
  | condition : ?q <> 0 |- ?p <> 0 => let is_zero := fresh in intro is_zero; apply condition; lra
  | first : ?q <> 0, second : ?r <> 0 |- ?p <> 0 =>
    let is_zero := fresh in
    intro is_zero; apply (Rmult_integral_contrapositive_currified _ _ first second); lra
  end].

Ltac rewriting := intros; numbers; forget_roundings; know_roots; solve [ring | field; not_zero].
