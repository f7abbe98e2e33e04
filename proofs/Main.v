(* SPDX-License-Identifier: BSD-3-Clause *)
(* The theorem of each law: the code answers every position as the specification says. spec/Laws.v is the specification, 122 lines
   without a proof. code/Code.v is the code: what programs recorded from it (code/RecordedLaws.v), and its loops over limbs as people wrote
   them down. For all parameters of the domain and all bits of x, y and z, NaNs too:
   - where a coordinate is not in range, the answer is invalid and no force;
   - else the status is free or contact as the exact force is, and each component is the exact one rounded once to binary32,
     at the coordinates as they are read: one below 2^-30 mm in size is 0.
   is_fused says whether a first stage fuses the multiplications and additions that its code names for it; it is right in both ways.
   Third stages compute with lists of 64-bit limbs and 64-bit exponents (limbs/WideNumbers.v). `outside` is what a machine makes of a
   number that does not fit an exponent: the theorems hold for any, since none arises.
   proofs/code.txt has a digest of this file, of Laws.v and of Code.v, so that a statement that is weakened is seen without Coq. *)
From Coq Require Import ZArith.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Laws Evaluate Code Wall Cylinder BumpCylinder Bump2p Bump3p.
From Forceshade Require Import Bump1pShaded Bump2pShaded Bump3pShaded ThirdStages ThirdStagesRefined.
From Forceshade Require Import Batch Walk WalkRight PolygonLanes ThreePolygonLanes CylinderLanes.

Theorem wall_is_correctly_rounded : forall (is_fused : bool) (R w K x y z : binary32), stiffness K ->
  right_answer (answer (code_of_wall is_fused R w K) x y z) (exact_wall (value32 K)) x y z.
Proof. exact (fun is_fused R w K x y z H => right_everywhere (wall_answers_right is_fused _ K x y z H)). Qed.

Theorem cylinder_is_correctly_rounded : forall (outside : Z -> Z) (is_fused : bool) (R w K x y z : binary32), parameters R w K ->
  right_answer (answer (code_of_cylinder (of_limbs outside) is_fused R w K) x y z)
    (exact_cylinder (value32 R) (value32 w) (value32 K)) x y z.
Proof.
  exact (fun outside is_fused R w K x y z H =>
    over_limbs (cylinder_in_limbs outside R w K) (right_everywhere (cylinder_answers_right is_fused R w K x y z H))).
Qed.

Theorem bump_cylinder_is_correctly_rounded : forall (outside : Z -> Z) (is_fused : bool) (R w K x y z : binary32), parameters R w K ->
  right_answer (answer (code_of_bump_cylinder (of_limbs outside) is_fused R w K) x y z)
    (exact_bump_cylinder (value32 R) (value32 w) (value32 K)) x y z.
Proof.
  exact (fun outside is_fused R w K x y z H =>
    over_limbs (bump_cylinder_in_limbs outside R w K) (right_everywhere (bump_cylinder_answers_right is_fused R w K x y z H))).
Qed.

Theorem bump_1p_is_correctly_rounded : forall (is_fused : bool) (R w K x y z : binary32), stiffness K ->
  right_answer (answer (code_of_bump_1p is_fused R w K) x y z) (exact_bump_1p (value32 R) (value32 w) (value32 K)) x y z.
Proof. exact (fun is_fused R w K x y z H => right_everywhere (wall_answers_right is_fused _ K x y z H)). Qed.

Theorem bump_2p_is_correctly_rounded : forall (outside : Z -> Z) (is_fused : bool) (R w K x y z : binary32), parameters R w K ->
  right_answer (answer (code_of_bump_2p (of_limbs outside) is_fused R w K) x y z)
    (exact_bump_2p (value32 R) (value32 w) (value32 K)) x y z.
Proof.
  exact (fun outside is_fused R w K x y z H =>
    over_limbs (bump_2p_in_limbs outside R w K) (right_everywhere (bump_2p_answers_right is_fused R w K x y z H))).
Qed.

Theorem bump_3p_is_correctly_rounded : forall (outside : Z -> Z) (is_fused : bool) (R w K x y z : binary32), parameters R w K ->
  right_answer (answer (code_of_bump_3p (of_limbs outside) is_fused R w K) x y z)
    (exact_bump_3p (value32 R) (value32 w) (value32 K)) x y z.
Proof.
  exact (fun outside is_fused R w K x y z H =>
    over_limbs (bump_3p_in_limbs outside R w K H) (right_everywhere (bump_3p_answers_right is_fused R w K x y z H))).
Qed.

Theorem bump_1p_shaded_is_correctly_rounded : forall (outside : Z -> Z) (is_fused : bool) (R w K x y z : binary32), parameters R w K ->
  right_answer (answer (code_of_bump_1p_shaded (of_limbs outside) is_fused R w K) x y z)
    (exact_bump_1p_shaded (value32 R) (value32 w) (value32 K)) x y z.
Proof.
  exact (fun outside is_fused R w K x y z H =>
    over_limbs (bump_1p_shaded_in_limbs outside R w K) (right_everywhere (bump_1p_shaded_answers_right is_fused R w K x y z H))).
Qed.

Theorem bump_2p_shaded_is_correctly_rounded : forall (outside : Z -> Z) (is_fused : bool) (R w K x y z : binary32), parameters R w K ->
  right_answer (answer (code_of_bump_2p_shaded (of_limbs outside) is_fused R w K) x y z)
    (exact_bump_2p_shaded (value32 R) (value32 w) (value32 K)) x y z.
Proof.
  exact (fun outside is_fused R w K x y z H =>
    over_limbs (bump_2p_shaded_in_limbs outside R w K) (right_everywhere (bump_2p_shaded_answers_right is_fused R w K x y z H))).
Qed.

Theorem bump_3p_shaded_is_correctly_rounded : forall (outside : Z -> Z) (is_fused : bool) (R w K x y z : binary32), parameters R w K ->
  right_answer (answer (code_of_bump_3p_shaded (of_limbs outside) is_fused R w K) x y z)
    (exact_bump_3p_shaded (value32 R) (value32 w) (value32 K)) x y z.
Proof.
  exact (fun outside is_fused R w K x y z H =>
    over_limbs (bump_3p_shaded_in_limbs outside R w K H) (right_everywhere (bump_3p_shaded_answers_right is_fused R w K x y z H))).
Qed.

Definition nine_laws := (wall_is_correctly_rounded, cylinder_is_correctly_rounded, bump_cylinder_is_correctly_rounded,
  bump_1p_is_correctly_rounded, bump_2p_is_correctly_rounded, bump_3p_is_correctly_rounded,
  bump_1p_shaded_is_correctly_rounded, bump_2p_shaded_is_correctly_rounded, bump_3p_shaded_is_correctly_rounded).

(* ---- Batches ---- *)

(* A batch of each law, in columns (y is 0) or in rows, in place or in other arrays, of any length, with AVX2, with AVX-512 or with
   neither: every force is that of the call of one position, invalid positions are counted, and nothing else is written. Walk.v is how
   arrays are walked, Batch.v the forms that packs evaluate, as a program recorded them, and Lanes.v the watch that leaves a position to
   the call above. *)

Theorem wall_batches_agree : forall (is_fused : bool) (R w K : binary32), stiffness K ->
  batches_agree (form_of_wall R w K) (answer (code_of_wall is_fused R w K)).
Proof.
  exact (fun is_fused R w K H => batches_are_right (fun set x z => wall_lane_is_right set R w K x z H)
    (fun x y z => wall_is_correctly_rounded is_fused R w K x y z H)).
Qed.

Theorem cylinder_batches_agree : forall (outside : Z -> Z) (is_fused : bool) (R w K : binary32), parameters R w K ->
  batches_agree (form_of_cylinder R w K) (answer (code_of_cylinder (of_limbs outside) is_fused R w K)).
Proof.
  exact (fun outside is_fused R w K H => batches_are_right (fun set x z => cylinder_lane_is_right set R w K x z H)
    (fun x y z => cylinder_is_correctly_rounded outside is_fused R w K x y z H)).
Qed.

Theorem bump_cylinder_batches_agree : forall (outside : Z -> Z) (is_fused : bool) (R w K : binary32), parameters R w K ->
  batches_agree (form_of_bump_cylinder R w K) (answer (code_of_bump_cylinder (of_limbs outside) is_fused R w K)).
Proof.
  exact (fun outside is_fused R w K H => batches_are_right (fun set x z => bump_cylinder_lane_is_right set R w K x z H)
    (fun x y z => bump_cylinder_is_correctly_rounded outside is_fused R w K x y z H)).
Qed.

Theorem bump_1p_batches_agree : forall (is_fused : bool) (R w K : binary32), stiffness K ->
  batches_agree (form_of_bump_1p R w K) (answer (code_of_bump_1p is_fused R w K)).
Proof.
  exact (fun is_fused R w K H => batches_are_right (fun set x z => bump_1p_lane_is_right set R w K x z H)
    (fun x y z => bump_1p_is_correctly_rounded is_fused R w K x y z H)).
Qed.

Theorem bump_2p_batches_agree : forall (outside : Z -> Z) (is_fused : bool) (R w K : binary32), parameters R w K ->
  batches_agree (form_of_bump_2p R w K) (answer (code_of_bump_2p (of_limbs outside) is_fused R w K)).
Proof.
  exact (fun outside is_fused R w K H => batches_are_right (fun set x z => bump_2p_lane_is_right set R w K x z H)
    (fun x y z => bump_2p_is_correctly_rounded outside is_fused R w K x y z H)).
Qed.

Theorem bump_3p_batches_agree : forall (outside : Z -> Z) (is_fused : bool) (R w K : binary32), parameters R w K ->
  batches_agree (form_of_bump_3p R w K) (answer (code_of_bump_3p (of_limbs outside) is_fused R w K)).
Proof.
  exact (fun outside is_fused R w K H => batches_are_right (fun set x z => bump_3p_lane_is_right set R w K x z H)
    (fun x y z => bump_3p_is_correctly_rounded outside is_fused R w K x y z H)).
Qed.

Theorem bump_1p_shaded_batches_agree : forall (outside : Z -> Z) (is_fused : bool) (R w K : binary32), parameters R w K ->
  batches_agree (form_of_bump_1p_shaded R w K) (answer (code_of_bump_1p_shaded (of_limbs outside) is_fused R w K)).
Proof.
  exact (fun outside is_fused R w K H => batches_are_right (fun set x z => bump_1p_shaded_lane_is_right set R w K x z H)
    (fun x y z => bump_1p_shaded_is_correctly_rounded outside is_fused R w K x y z H)).
Qed.

Theorem bump_2p_shaded_batches_agree : forall (outside : Z -> Z) (is_fused : bool) (R w K : binary32), parameters R w K ->
  batches_agree (form_of_bump_2p_shaded R w K) (answer (code_of_bump_2p_shaded (of_limbs outside) is_fused R w K)).
Proof.
  exact (fun outside is_fused R w K H => batches_are_right (fun set x z => bump_2p_shaded_lane_is_right set R w K x z H)
    (fun x y z => bump_2p_shaded_is_correctly_rounded outside is_fused R w K x y z H)).
Qed.

Theorem bump_3p_shaded_batches_agree : forall (outside : Z -> Z) (is_fused : bool) (R w K : binary32), parameters R w K ->
  batches_agree (form_of_bump_3p_shaded R w K) (answer (code_of_bump_3p_shaded (of_limbs outside) is_fused R w K)).
Proof.
  exact (fun outside is_fused R w K H => batches_are_right (fun set x z => bump_3p_shaded_lane_is_right set R w K x z H)
    (fun x y z => bump_3p_shaded_is_correctly_rounded outside is_fused R w K x y z H)).
Qed.

Definition their_batches := (wall_batches_agree, cylinder_batches_agree, bump_cylinder_batches_agree, bump_1p_batches_agree,
  bump_2p_batches_agree, bump_3p_batches_agree, bump_1p_shaded_batches_agree, bump_2p_shaded_batches_agree, bump_3p_shaded_batches_agree).

Definition all := (nine_laws, their_batches).
Print Assumptions all.
