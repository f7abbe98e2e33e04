(* SPDX-License-Identifier: BSD-3-Clause *)
(* The code of the nine laws, as proofs/Main.v has it: the numbers that a law holds, its rounding window, and its three stages. The first
   stages and the operations of double-double are recorded from fast/ (proofs/recorded/Recorded.v); the rest was written by hand, and
   proofs/code/RecordedLaws.v has it equal to what is recorded, but for the loops over limbs. tests/proofs/model runs these definitions
   (proofs/code/Model.v) and compares their bits with the code's. *)
From Coq Require Import ZArith List.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded RoundingTest Evaluate Inputs Shaded.
From Forceshade Require Import Depth Split CylinderConstants TwoPolygonsConstants.
From Forceshade Require Import ThreePolygonsConstants ThreePolygonsRight NewtonThird SecondStage.
From Forceshade Require Import CylinderSecond BumpCylinder Bump1pShaded Bump2p Bump2pShaded Bump3p.
From Forceshade Require Import Bump3pShaded ThirdStages.
Import ListNotations.

Record code := {
  members : list binary64; (* the numbers that the first stage takes, in its order *)
  window : Z;
  first_stage : binary64 -> binary64 -> FirstStage;
  later_stages : option ((binary32 -> binary32 -> option evaluation) * (binary32 -> binary32 -> evaluation))
}.

(* The second stage where it decides, else the third. A plane has neither, and never asks. *)
Definition later (law : code) : binary32 -> binary32 -> evaluation :=
  match later_stages law with
  | Some (second, third) => later_of second third
  | None => fun _ _ => no_force invalid
  end.

(* evaluate() of a law at any three numbers of binary32. *)
Definition answer (law : code) (x y z : binary32) : evaluation := evaluate (window law) (first_stage law) (later law) x y z.

(* ---- The nine laws, with fused multiplication and addition or without ---- *)

Definition plane (is_fused : bool) (K : binary32) (window : Z) : code :=
  {| members := [to64 K]; window := window; first_stage := wall is_fused (to64 K); later_stages := None |}.
Definition curved members window first second third : code :=
  {| members := members; window := window; first_stage := first; later_stages := Some (second, third) |}.

Definition members_of_cylinder (R w K : binary32) : list binary64 :=
  let d := computed_depth R w in
  [to64 K; to64 R; anchor_of R; fst (anchor_terms R w); snd (anchor_terms R w); split_head d; split_tail d; axis_of R w].
Definition members_of_gap (height slope : double_double) : list binary64 := [hi height; lo height; split_head slope; split_tail slope].
Definition members_of_two (R w : binary32) : list binary64 := members_of_gap (height_2p R w) (tangent_2p R w).
Definition members_of_three (w : binary32) (top : double_double) (t : double_double) : list binary64 :=
  hi top :: lo top :: members_of_gap (side_height_3p w t) (tangent_3p t).
Definition members_of_sides (K : binary32) (sine cosine : double_double) : list binary64 := [to64 K; K_times K sine; K_times K cosine].
Definition members_of_shading (R K : binary32) : list binary64 := [to64 R; K_over_R K R].

Definition code_of_wall (is_fused : bool) (R w K : binary32) : code := plane is_fused K wall_window.
Definition code_of_bump_1p (is_fused : bool) (R w K : binary32) : code := plane is_fused K bump_1p_window.

(* Third stages compute with numbers of so many limbs, in the arithmetic of limbs or of integers (proofs/code/ThirdStages.v). *)
Section Curved.
Context {number : Type} (arithmetic_of : nat -> arithmetic number).
Local Notation third count := (third_stage (arithmetic_of count)).

Definition code_of_cylinder (is_fused : bool) (R w K : binary32) : code :=
  curved (members_of_cylinder R w K) cylinder_window (cylinder_of cylinder R w K is_fused)
    (cylinder_second R w K) (third 32 Third.cylinder R w K).
Definition code_of_bump_cylinder (is_fused : bool) (R w K : binary32) : code :=
  curved (members_of_cylinder R w K) bump_cylinder_window (cylinder_of bump_cylinder R w K is_fused)
    (bump_cylinder_second R w K) (third 32 Third.bump_cylinder R w K).
Definition code_of_bump_2p (is_fused : bool) (R w K : binary32) : code :=
  curved (members_of_two R w ++ members_of_sides K (face_sine_2p R w) (face_cosine_2p R w) ++ [half_width w])
    bump_2p_window (bump_2p_of R w K is_fused) (bump_2p_second R w K) (third 32 Third.bump_2p R w K).
Definition code_of_bump_3p (is_fused : bool) (R w K : binary32) : code :=
  let t := sine_of_third R w in
  curved (members_of_three w (top_height_3p R t) t ++ members_of_sides K (sine_3p_of t) (cosine_3p_of t) ++ [half_width w; top_of R w])
    bump_3p_window (bump_3p_of R w K t (top_of R w) is_fused) (bump_3p_second R w K) (third 64 Third.bump_3p R w K).
Definition code_of_bump_1p_shaded (is_fused : bool) (R w K : binary32) : code :=
  curved (members_of_shading R K ++ [half_width w])
    bump_1p_shaded_window (bump_1p_shaded_of R w K is_fused) (bump_1p_shaded_second R w K)
    (third 12 Third.bump_1p_shaded R w K).
Definition code_of_bump_2p_shaded (is_fused : bool) (R w K : binary32) : code :=
  curved (members_of_two R w ++ members_of_shading R K ++ [half_width w])
    bump_2p_shaded_window (bump_2p_shaded_of R w K is_fused) (bump_2p_shaded_second R w K)
    (third 32 Third.bump_2p_shaded R w K).
Definition code_of_bump_3p_shaded (is_fused : bool) (R w K : binary32) : code :=
  let t := sine_of_third R w in
  curved (members_of_three w (top_height_3p R t) t ++ members_of_shading R K ++ [half_width w; top_of R w])
    bump_3p_shaded_window (bump_3p_shaded_of R w K t (top_of R w) is_fused) (bump_3p_shaded_second R w K)
    (third 64 Third.bump_3p_shaded R w K).
End Curved.
