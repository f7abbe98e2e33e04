(* SPDX-License-Identifier: BSD-3-Clause *)
(* The specification, without any proof: the domain, the exact forces of the nine laws, and right answers, as docs/laws.md defines them.
   It is made of real numbers and of Flocq's binary32 alone. proofs/Main.v says of the code that its answers are these. *)
From Coq Require Import ZArith Reals.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
Open Scope R_scope.

(* ---- Numbers ---- *)

(* The rational number that a finite binary32 is. Flocq gives 0 for infinities and NaNs. *)
Notation value32 := (B2R 24 128).
(* The binary32 nearest to a real number, ties to even: 24 bits, multiples of 2^-149. *)
Notation fexp32 := (FLT_exp (-149) 24).
Notation nearest32 := (round radix2 fexp32 ZnearestE).
(* +0, beside B754_zero 24 128 true, which is -0. *)
Notation zero32 := (B754_zero 24 128 false).

(* ---- The domain of parameters and positions ---- *)

Definition stiffness (K : binary32) : Prop := is_finite 24 128 K = true /\ / 1000 <= value32 K <= 1000.
Definition parameters (R w K : binary32) : Prop :=
  (is_finite 24 128 R = true /\ is_finite 24 128 w = true /\ is_finite 24 128 K = true) /\
  / 10 <= value32 R <= 10000 /\ / 1000 <= value32 w <= 2 * value32 R /\ / 1000 <= value32 K <= 1000.

(* Not infinite, not a NaN, and at most 10^4 mm in size. *)
Definition in_range (x : binary32) : Prop := is_finite 24 128 x = true /\ Rabs (value32 x) <= 10000.

(* The position quantum: a coordinate smaller than 2^-30 mm in size is read as 0. *)
Definition read (x : R) : R := if Rle_bool (bpow radix2 (-30)) (Rabs x) then x else 0.

(* ---- Answers ---- *)

(* A status and the three components of the force. *)
Inductive Status := free | contact | invalid.
Definition evaluation : Type := Status * (binary32 * binary32 * binary32).
Definition no_force (status : Status) : evaluation := (status, (zero32, zero32, zero32)).

(* A component is the exact one rounded once, neither infinite nor a NaN, and not -0. *)
Definition is_nearest32 (answer : binary32) (exact : R) : Prop :=
  value32 answer = nearest32 exact /\ is_finite 24 128 answer = true /\ (nearest32 exact = 0 -> answer = zero32).

(* Free and no force, or contact and the force (Fx, 0, Fz). *)
Definition is_answer (answer : evaluation) (touches : Prop) (Fx Fz : R) : Prop :=
  ~ touches /\ answer = no_force free \/
  touches /\ exists fx fz, answer = (contact, (fx, zero32, fz)) /\ is_nearest32 fx Fx /\ is_nearest32 fz Fz.

(* What a law says of a position: whether there is contact, and the force that there is then. *)
Record exact_force := { in_contact : Prop; exact_x : R; exact_z : R }.

(* The answer to the position (x, y, z) is right by a law, which is a function of the two coordinates that are read. *)
Definition right_answer (answer : evaluation) (law : R -> R -> exact_force) (x y z : binary32) : Prop :=
  let exact := law (read (value32 x)) (read (value32 z)) in
  (in_range x /\ in_range y /\ in_range z -> is_answer answer (in_contact exact) (exact_x exact) (exact_z exact)) /\
  (~ (in_range x /\ in_range y /\ in_range z) -> answer = no_force invalid).

(* ---- Geometry of a bump, of radius Rad and width w ---- *)

(* d and h, and the slope of a side face of two polygons. *)
Definition axis_depth (Rad w : R) : R := sqrt (Rsqr Rad - Rsqr (w / 2)).
Definition bump_height (Rad w : R) : R := Rad - axis_depth Rad w.
Definition slope_2p (Rad w : R) : R := 2 * bump_height Rad w / w.

(* theta, w' and h', and the slope of a side face of three polygons. *)
Definition theta (Rad w : R) : R := 2 / 3 * asin (w / (2 * Rad)).
Definition top_width (Rad w : R) : R := 2 * (w / 2 * cos (theta Rad w) - axis_depth Rad w * sin (theta Rad w)).
Definition top_height (Rad w : R) : R := w / 2 * sin (theta Rad w) + axis_depth Rad w * cos (theta Rad w) - axis_depth Rad w.
Definition slope_3p (Rad w : R) : R := top_height Rad w / (w / 2 - top_width Rad w / 2).
(* The slope at X, 0 on the top, which has its edge. *)
Definition slope_at (Rad w X : R) : R := if Rle_bool (Rabs X) (top_width Rad w / 2) then 0 else slope_3p Rad w.

(* H - z, the depth below the nominal surface; |x| = w/2 belongs to the bump. *)
Definition penetration_2p (Rad w X Z : R) : R :=
  if Rle_bool (Rabs X) (w / 2) then bump_height Rad w * (1 - 2 * Rabs X / w) - Z else - Z.
Definition penetration_3p (Rad w X Z : R) : R :=
  if Rle_bool (Rabs X) (w / 2)
  then (if Rle_bool (Rabs X) (top_width Rad w / 2) then top_height Rad w
        else top_height Rad w * (w / 2 - Rabs X) / (w / 2 - top_width Rad w / 2)) - Z
  else - Z.

(* ---- Forces at the penetration M ---- *)

(* Along the normal of a face of this slope; x = 0 belongs to the face on the right. *)
Definition cosine_of (slope : R) : R := 1 / sqrt (1 + Rsqr slope).
Definition sine_of (slope : R) : R := slope / sqrt (1 + Rsqr slope).
Definition side_x (w K slope X M : R) : R :=
  if Rle_bool (Rabs X) (w / 2) then K * M * (if Rlt_bool X 0 then - sine_of slope else sine_of slope) else 0.
Definition side_z (w K slope X M : R) : R := K * M * (if Rle_bool (Rabs X) (w / 2) then cosine_of slope else 1).

(* Along (x, sqrt(R^2 - x^2)) / R, the shaded normal, over the bump, and along (0, 1) beside it. *)
Definition shaded_x (Rad w K X M : R) : R := if Rle_bool (Rabs X) (w / 2) then K * M * (X / Rad) else 0.
Definition shaded_z (Rad w K X M : R) : R := K * M * (if Rle_bool (Rabs X) (w / 2) then sqrt (Rsqr Rad - Rsqr X) / Rad else 1).

(* K (R - rho) along (x, z + d) / rho where rho < R, and K R along z on the axis. *)
Definition distance_from_axis (Rad w X Z : R) : R := sqrt (X * X + (Z + axis_depth Rad w) * (Z + axis_depth Rad w)).
Definition cylinder_x (Rad w K X Z : R) : R :=
  let rho := distance_from_axis Rad w X Z in
  if Rlt_bool rho Rad then K * (Rad - rho) * (if Req_bool rho 0 then 0 else X / rho) else 0.
Definition cylinder_z (Rad w K X Z : R) : R :=
  let rho := distance_from_axis Rad w X Z in
  if Rlt_bool rho Rad then K * (Rad - rho) * (if Req_bool rho 0 then 1 else (Z + axis_depth Rad w) / rho) else 0.

(* ---- The nine laws ---- *)

Definition force (touches : Prop) (Fx Fz : R) : exact_force := {| in_contact := touches; exact_x := Fx; exact_z := Fz |}.

Definition exact_wall (K X Z : R) := force (Z < 0) 0 (- K * Z).
Definition exact_cylinder (Rad w K X Z : R) :=
  force (distance_from_axis Rad w X Z < Rad) (cylinder_x Rad w K X Z) (cylinder_z Rad w K X Z).
Definition exact_bump_cylinder (Rad w K X Z : R) :=
  force (distance_from_axis Rad w X Z < Rad \/ Z < 0) (cylinder_x Rad w K X Z) (cylinder_z Rad w K X Z + Rmax (- K * Z) 0).
Definition exact_bump_1p (Rad w K X Z : R) := force (Z < 0) 0 (- K * Z).
Definition exact_bump_2p (Rad w K X Z : R) :=
  let M := penetration_2p Rad w X Z in
  force (0 < M) (side_x w K (slope_2p Rad w) X M) (side_z w K (slope_2p Rad w) X M).
Definition exact_bump_3p (Rad w K X Z : R) :=
  let M := penetration_3p Rad w X Z in
  force (0 < M) (side_x w K (slope_at Rad w X) X M) (side_z w K (slope_at Rad w X) X M).
Definition exact_bump_1p_shaded (Rad w K X Z : R) := force (Z < 0) (shaded_x Rad w K X (- Z)) (shaded_z Rad w K X (- Z)).
Definition exact_bump_2p_shaded (Rad w K X Z : R) :=
  let M := penetration_2p Rad w X Z in force (0 < M) (shaded_x Rad w K X M) (shaded_z Rad w K X M).
Definition exact_bump_3p_shaded (Rad w K X Z : R) :=
  let M := penetration_3p Rad w X Z in force (0 < M) (shaded_x Rad w K X M) (shaded_z Rad w K X M).
