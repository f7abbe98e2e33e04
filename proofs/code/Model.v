(* SPDX-License-Identifier: BSD-3-Clause *)
(* The definitions that proofs/Main.v speaks of, as a program: model.ml, over the integers of OCaml's Zarith. Each law has
   its answer and each of its stages by itself, from bits to bits. tests/proofs/model compares it with the code. Its third stages compute
   with integers, which takes less time; what they answer is what limbs do (proofs/code/ThirdStagesRefined.v). *)
From Coq Require Import ZArith Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Evaluate ThirdStages Code.
From Coq Require Import Extraction ExtrOcamlBasic ExtrOcamlZBigInt ExtrOcamlNatInt ExtrOcamlNativeString.
From Coq Require Import String List.
Import ListNotations.

Definition codes : list (string * (bool -> binary32 -> binary32 -> binary32 -> code)) := [
  ("wall", code_of_wall); ("cylinder", code_of_cylinder of_integers); ("bump-cylinder", code_of_bump_cylinder of_integers);
  ("bump-1p", code_of_bump_1p); ("bump-2p", code_of_bump_2p of_integers); ("bump-3p", code_of_bump_3p of_integers);
  ("bump-1p-shaded", code_of_bump_1p_shaded of_integers); ("bump-2p-shaded", code_of_bump_2p_shaded of_integers);
  ("bump-3p-shaded", code_of_bump_3p_shaded of_integers)]%string.

Definition law_of (name : string) (R w K : binary32) : option code :=
  option_map (fun found => snd found false R w K) (find (fun each => (name =? fst each)%string) codes).

(* ---- From bits to bits ---- *)

Definition number (bits : Z) : binary32 := b32_of_bits bits.
Definition quantised64 (bits : Z) : binary64 := to64 (quantised (number bits)).

Definition law_of_bits (name : string) (R w K : Z) : option code := law_of name (number R) (number w) (number K).

Definition members_bits (law : code) : list Z := map bits_of_b64 (members law).

Definition answer_bits (answer : evaluation) : Status * (Z * Z * Z) :=
  let '(status, (x, y, z)) := answer in (status, (bits_of_b32 x, bits_of_b32 y, bits_of_b32 z)).

Definition answer_of (law : code) (x y z : Z) : Status * (Z * Z * Z) :=
  answer_bits (answer law (number x) (number y) (number z)).

(* Components, contact and doubt. *)
Definition first_of (law : code) (x z : Z) : Z * Z * bool * bool :=
  let first := first_stage law (quantised64 x) (quantised64 z) in
  (bits_of_b64 (first_x first), bits_of_b64 (first_z first), first_contact first, first_doubt first).

(* The second stage, where it decides, and the third. *)
Definition later_of_bits (law : code) (x z : Z) : option (option (Status * (Z * Z * Z)) * (Status * (Z * Z * Z))) :=
  match later_stages law with
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
