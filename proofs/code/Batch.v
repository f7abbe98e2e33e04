(* SPDX-License-Identifier: BSD-3-Clause *)
(* The forms in which a batch evaluates the nine laws, with the numbers that a law holds. *)
From Coq Require Import ZArith List.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Inputs Shaded DoubleDouble Depth Split CylinderConstants TwoPolygonsConstants.
From Forceshade Require Import ThreePolygonsConstants ThreePolygonsRight NewtonThird Lanes RecordedForms.

Definition form : Type := binary32 -> binary32 -> Lane.

Definition form_of_wall (R w K : binary32) : form := wall_form (to64 K).
Definition form_of_bump_1p (R w K : binary32) : form := bump_1p_form (to64 K).

Definition with_gap {A : Type} (height slope : double_double) (next : binary64 -> binary64 -> binary64 -> binary64 -> A) : A :=
  next (hi height) (lo height) (split_head slope) (split_tail slope).
Definition with_gaps {A : Type} (R w : binary32) (next : binary64 -> binary64 -> binary64 -> binary64 -> binary64 -> binary64 -> A) : A :=
  let t := sine_of_third R w in
  with_gap (side_height_3p w t) (tangent_3p t) (next (hi (top_height_3p R t)) (lo (top_height_3p R t))).
Definition with_depth (R w K : binary32)
    (next : binary64 -> binary64 -> binary64 -> binary64 -> binary64 -> binary64 -> binary64 -> binary64 -> form) : form :=
  next (to64 K) (to64 R) (anchor_of R) (fst (anchor_terms R w)) (snd (anchor_terms R w)) (split_head (computed_depth R w))
    (split_tail (computed_depth R w)) (axis_of R w).

Definition form_of_cylinder (R w K : binary32) : form := with_depth R w K cylinder_form.
Definition form_of_bump_cylinder (R w K : binary32) : form := with_depth R w K bump_cylinder_form.
Definition form_of_bump_2p (R w K : binary32) : form :=
  with_gap (height_2p R w) (tangent_2p R w) bump_2p_form (to64 K) (K_times K (face_sine_2p R w)) (K_times K (face_cosine_2p R w))
    (half_width w).
Definition form_of_bump_3p (R w K : binary32) : form :=
  let t := sine_of_third R w in
  with_gaps R w bump_3p_form (to64 K) (K_times K (sine_3p_of t)) (K_times K (cosine_3p_of t)) (half_width w) (top_of R w).
Definition form_of_bump_1p_shaded (R w K : binary32) : form := bump_1p_shaded_form (to64 R) (K_over_R K R) (half_width w).
Definition form_of_bump_2p_shaded (R w K : binary32) : form :=
  with_gap (height_2p R w) (tangent_2p R w) bump_2p_shaded_form (to64 R) (K_over_R K R) (half_width w).
Definition form_of_bump_3p_shaded (R w K : binary32) : form :=
  with_gaps R w bump_3p_shaded_form (to64 R) (K_over_R K R) (half_width w) (top_of R w).
