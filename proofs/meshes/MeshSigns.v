(* SPDX-License-Identifier: BSD-3-Clause *)
(* The constants that the compiler finds for the god-object's decisions (fast/meshes/decide.h) are above the errors of their polynomials
   (proofs/meshes/MeshConstants.v). *)
From Coq Require Import ZArith Reals Lia Lra Psatz Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations Nearness Vectors MeshConstants.
Open Scope R_scope.

(* ---- RoundingBound, as the compiler runs it in binary64. All components of a vector have one bound. ---- *)

Record code_bound := CodeBound { code_size : binary64; code_error : binary64 }.
Definition code_slack : binary64 := Operations.plus (two_to 0) (two_to (-40)).
Definition code_rounded (s propagated : binary64) : code_bound :=
  CodeBound (times code_slack s) (times code_slack (Operations.plus propagated (times (two_to (-53)) s))).
Definition code_add (a b : code_bound) : code_bound :=
  code_rounded (Operations.plus (code_size a) (code_size b)) (Operations.plus (code_error a) (code_error b)).
Definition code_multiply (a b : code_bound) : code_bound :=
  code_rounded (times (code_size a) (code_size b))
    (Operations.plus (Operations.plus (times (code_size a) (code_error b)) (times (code_size b) (code_error a)))
      (times (code_error a) (code_error b))).
Definition code_cross (a b : code_bound) : code_bound := code_add (code_multiply a b) (code_multiply a b).
Definition code_dot (a b : code_bound) : code_bound := code_add (code_add (code_multiply a b) (code_multiply a b)) (code_multiply a b).

Definition code_difference : code_bound := CodeBound (Operations.plus (two_to 0) (two_to (-52))) (two_to (-53)).  (* kDifference *)
Definition code_offset : code_bound := CodeBound (Operations.plus (two_to 0) (two_to (-51))) (two_to (-52)).      (* kOffset *)
Definition code_normal : code_bound := code_cross code_difference code_difference.
Definition code_across : code_bound := code_dot code_normal code_offset.
Definition code_inside : code_bound := code_dot (code_cross code_difference code_offset) code_normal.
Definition code_area : code_bound := code_dot code_normal code_normal.
Definition code_along : code_bound := code_dot code_offset code_difference.
Definition code_length : code_bound := code_dot code_difference code_difference.
Definition code_offset_length : code_bound := code_dot code_offset code_offset.
Definition code_passes : code_bound := code_dot (code_cross code_difference code_offset) code_difference.
Definition code_third : code_bound := code_add code_area (code_add code_inside code_inside).

(* ---- The same of the polynomials, in real numbers ---- *)

Definition bound_of_cross (a b : bound) : bound := bound_of_sum (bound_of_product a b) (bound_of_product a b).
Definition bound_of_dot (a b : bound) : bound :=
  bound_of_sum (bound_of_sum (bound_of_product a b) (bound_of_product a b)) (bound_of_product a b).
(* A difference of coordinates is rounded once; an offset is within 2^-52 of its largest component. *)
Definition difference_bound : bound := Bound 1 ((1 + 2 * unit53) * unit53).
Definition offset_bound : bound := Bound 1 (2 * unit53).
Definition normal_bound : bound := bound_of_cross difference_bound difference_bound.
Definition across_bound : bound := bound_of_dot normal_bound offset_bound.
Definition inside_bound : bound := bound_of_dot (bound_of_cross difference_bound offset_bound) normal_bound.
Definition area_bound : bound := bound_of_dot normal_bound normal_bound.
Definition along_bound : bound := bound_of_dot offset_bound difference_bound.
Definition length_bound : bound := bound_of_dot difference_bound difference_bound.
Definition offset_length_bound : bound := bound_of_dot offset_bound offset_bound.
Definition passes_bound : bound := bound_of_dot (bound_of_cross difference_bound offset_bound) difference_bound.
Definition third_bound : bound := bound_of_sum area_bound (bound_of_sum inside_bound inside_bound).

(* The constant is above the error, with room for the roundings of what is multiplied by it. *)
Definition is_above (code : code_bound) (b : bound) : Prop :=
  is_finite 53 1024 (code_error code) = true /\ 0 <= off b /\ (1 + 1024 * unit53) * off b <= value64 (code_error code).

Definition parts (v : binary64) : option (positive * Z) := match v with B754_finite _ _ false m e _ => Some (m, e) | _ => None end.
Lemma value_of_parts : forall v m e, parts v = Some (m, e) -> is_finite 53 1024 v = true /\ value64 v = IZR (Zpos m) * bpow radix2 e.
Proof. intros [s|s|s p q|[] n f q] m e H; try discriminate H. injection H as <- <-. now split. Qed.

Ltac above m e :=
  unfold is_above;
  match goal with |- is_finite _ _ ?v = true /\ _ =>
    let H := fresh in assert (H : parts v = Some (m, e)) by (vm_compute; reflexivity);
    destruct (value_of_parts v m e H) as [-> ->] end;
  split; [reflexivity|];
  cbv [across_bound inside_bound area_bound along_bound length_bound offset_length_bound passes_bound third_bound normal_bound
    difference_bound offset_bound bound_of_dot bound_of_cross bound_of_sum bound_of_product once_rounded size off unit53 bpow radix_val
    radix2 Z.pow_pos Pos.iter Z.mul Pos.mul]; split; lra.

(* kNormal, kAcross, kInside, kArea, kAlong, kLength, kOffsetLength, kPasses and kThird. *)
Theorem constants_are_above :
  is_above code_normal normal_bound /\ is_above code_across across_bound /\ is_above code_inside inside_bound /\
  is_above code_area area_bound /\ is_above code_along along_bound /\ is_above code_length length_bound /\
  is_above code_offset_length offset_length_bound /\ is_above code_passes passes_bound /\ is_above code_third third_bound.
Proof.
  split; [|split; [|split; [|split; [|split; [|split; [|split; [|split]]]]]]].
  - above 4503599627378690%positive (-102)%Z.
  - above 7318349394508295%positive (-100)%Z.
  - above 4925812092466438%positive (-98)%Z.
  - above 4503599627397893%positive (-98)%Z.
  - above 4785074604092930%positive (-101)%Z.
  - above 7881299347917827%positive (-102)%Z.
  - above 5629499534226948%positive (-101)%Z.
  - above 7318349394508295%positive (-100)%Z.
  - above 8233143068849481%positive (-97)%Z.
Qed.
