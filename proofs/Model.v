(* SPDX-License-Identifier: BSD-3-Clause *)
(* The definitions that the theorems of the laws speak of, as a program: model.ml, over the integers of OCaml's Zarith. Each law has
   its answer and each of its stages by itself, from bits to bits. tests/proofs/model compares it with the code. *)
From Coq Require Import ZArith Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded RoundingTest Evaluate Inputs Shaded.
From Forceshade Require Import Depth Split CylinderConstants TwoPolygonsConstants.
From Forceshade Require Import ThreePolygonsConstants ThreePolygonsRight NewtonThird SecondStage.
From Forceshade Require Import CylinderSecond BumpCylinderSecond Bump1pShadedSecond Bump2pSecond Bump2pShadedSecond Bump3pSecond.
From Forceshade Require Import Bump3pShadedSecond CylinderThird BumpCylinderThird Bump1pShadedThird Bump2pThird Bump2pShadedThird.
From Forceshade Require Import Bump3pThird Bump3pShadedThird.
From Coq Require Import Extraction ExtrOcamlBasic ExtrOcamlZBigInt ExtrOcamlNatInt ExtrOcamlNativeString.
From Coq Require Import String List.
Import ListNotations.

Record law := {
  members : list binary64; (* the numbers that the first stage takes, in its order *)
  window : Z;
  first_stage : binary64 -> binary64 -> FirstStage;
  later_stages : option ((binary32 -> binary32 -> option evaluation) * (binary32 -> binary32 -> evaluation))
}.

Definition members_of_cylinder (R w K : binary32) : list binary64 :=
  let d := computed_depth R w in
  [to64 K; to64 R; anchor_of R; fst (anchor_terms R w); snd (anchor_terms R w); split_head d; split_tail d; axis_of R w].
Definition members_of_gap (height slope : double_double) : list binary64 := [hi height; lo height; split_head slope; split_tail slope].
Definition members_of_sides (K : binary32) (sine cosine : double_double) : list binary64 := [to64 K; K_times K sine; K_times K cosine].
Definition members_of_shading (R K : binary32) : list binary64 := [to64 R; K_over_R K R].

Definition law_of (name : string) (R w K : binary32) : option law :=
  let fused := false in
  let plane window := Some {| members := [to64 K]; window := window; first_stage := wall fused (to64 K); later_stages := None |} in
  let curved members window first second third :=
    Some {| members := members; window := window; first_stage := first; later_stages := Some (second, third) |} in
  let t := sine_of_third R w in
  let two := members_of_gap (height_2p R w) (tangent_2p R w) in
  let three := (hi (top_height_3p R t) :: lo (top_height_3p R t) :: members_of_gap (side_height_3p w t) (tangent_3p t))%list in
  if (name =? "wall")%string then plane wall_window else
  if (name =? "bump-1p")%string then plane bump_1p_window else
  if (name =? "cylinder")%string then
    curved (members_of_cylinder R w K) cylinder_window (cylinder_of cylinder R w K fused) (cylinder_second R w K)
      (cylinder_third R w K) else
  if (name =? "bump-cylinder")%string then
    curved (members_of_cylinder R w K) bump_cylinder_window (cylinder_of bump_cylinder R w K fused) (bump_cylinder_second R w K)
      (bump_cylinder_third R w K) else
  if (name =? "bump-2p")%string then
    curved (two ++ members_of_sides K (face_sine_2p R w) (face_cosine_2p R w) ++ [half_width w])%list bump_2p_window
      (bump_2p_of R w K fused) (bump_2p_second R w K) (bump_2p_third R w K) else
  if (name =? "bump-3p")%string then
    curved (three ++ members_of_sides K (sine_3p_of t) (cosine_3p_of t) ++ [half_width w; top_of R w])%list bump_3p_window
      (bump_3p_of R w K t (top_of R w) fused) (bump_3p_second R w K) (bump_3p_third R w K) else
  if (name =? "bump-1p-shaded")%string then
    curved (members_of_shading R K ++ [half_width w])%list bump_1p_shaded_window (bump_1p_shaded_of R w K fused)
      (bump_1p_shaded_second R w K) (bump_1p_shaded_third R w K) else
  if (name =? "bump-2p-shaded")%string then
    curved (two ++ members_of_shading R K ++ [half_width w])%list bump_2p_shaded_window (bump_2p_shaded_of R w K fused)
      (bump_2p_shaded_second R w K) (bump_2p_shaded_third R w K) else
  if (name =? "bump-3p-shaded")%string then
    curved (three ++ members_of_shading R K ++ [half_width w; top_of R w])%list bump_3p_shaded_window
      (bump_3p_shaded_of R w K t (top_of R w) fused) (bump_3p_shaded_second R w K) (bump_3p_shaded_third R w K) else
  None.

Definition later (l : law) : binary32 -> binary32 -> evaluation :=
  match later_stages l with
  | Some (second, third) => later_of second third
  | None => fun _ _ => no_force invalid
  end.

(* ---- From bits to bits ---- *)

Definition number (bits : Z) : binary32 := b32_of_bits bits.
Definition quantised64 (bits : Z) : binary64 := to64 (quantised (number bits)).

Definition law_of_bits (name : string) (R w K : Z) : option law := law_of name (number R) (number w) (number K).

Definition members_bits (l : law) : list Z := map bits_of_b64 (members l).

Definition answer_bits (answer : evaluation) : Status * (Z * Z * Z) :=
  let '(status, (x, y, z)) := answer in (status, (bits_of_b32 x, bits_of_b32 y, bits_of_b32 z)).

Definition answer_of (l : law) (x y z : Z) : Status * (Z * Z * Z) :=
  answer_bits (evaluate (window l) (first_stage l) (later l) (number x) (number y) (number z)).

(* Components, contact and doubt. *)
Definition first_of (l : law) (x z : Z) : Z * Z * bool * bool :=
  let first := first_stage l (quantised64 x) (quantised64 z) in
  (bits_of_b64 (first_x first), bits_of_b64 (first_z first), first_contact first, first_doubt first).

(* The second stage, where it decides, and the third. *)
Definition later_of_bits (l : law) (x z : Z) : option (option (Status * (Z * Z * Z)) * (Status * (Z * Z * Z))) :=
  match later_stages l with
  | Some (second, third) =>
      let X := quantised (number x) in let Z := quantised (number z) in
      Some (option_map answer_bits (second X Z), answer_bits (third X Z))
  | None => None
  end.

(* Operations of Zarith that ExtrOcamlZBigInt leaves to what Coq defines, which takes a thousand times as long. *)
Extract Constant Z.log2 => "(fun x -> if Zarith.sign x <= 0 then Zarith.zero else Zarith.of_int (Zarith.numbits x - 1))".
Extract Constant Z.log2_up => "(fun x -> if Zarith.leq x Zarith.one then Zarith.zero else Zarith.of_int (Zarith.numbits (Zarith.pred x)))".
Extract Constant Z.pow => "(fun x y -> if Zarith.sign y < 0 then Zarith.zero else Zarith.pow x (Zarith.to_int y))".
Extract Constant Z.pow_pos => "(fun x y -> Zarith.pow x (Zarith.to_int y))".
Extract Constant Z.eqb => "Zarith.equal".
Extract Constant Z.leb => "Zarith.leq".
Extract Constant Z.ltb => "Zarith.lt".
Extract Constant Z.even => "Zarith.is_even".
Extract Constant Z.land => "Zarith.logand".
Extract Constant Z.lor => "Zarith.logor".
Extract Constant Z.quot => "(fun x y -> if Zarith.sign y = 0 then Zarith.zero else Zarith.div x y)".
Extract Constant Z.sqrtrem => "(fun x -> if Zarith.sign x <= 0 then (Zarith.zero, Zarith.zero) else Zarith.sqrt_rem x)".
Extract Constant Zpower.shift_pos => "(fun n z -> Zarith.shift_left z (Zarith.to_int n))".
Extract Constant SpecFloat.digits2_pos => "(fun x -> Zarith.of_int (Zarith.numbits x))".
Extraction "model.ml" law_of_bits members_bits answer_of first_of later_of_bits.
