(* SPDX-License-Identifier: BSD-3-Clause *)
(* The members of the nine laws, exact() for both later stages and evaluate() are what a program wrote down from the headers
   (proofs/recorded/RecordedStages.v). So what proofs/Main.v says of an answer, it says of recorded terms, but for the arithmetic of limbs,
   which was written by hand. *)
From Coq Require Import ZArith List Bool Lia.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded RoundingTest Evaluate Inputs Depth Split DoubleDoubleHolds
  NewtonRounded NewtonThird ExactSign TopEdge Acceptance BesideTie SecondStage SecondAlong ShadedAlong Shaded.
From Forceshade Require Import CylinderConstants TwoPolygonsConstants TwoPolygonsGap ThreePolygonsConstants ThreePolygonsGap.
From Forceshade Require Import ThreePolygonsRight CylinderSecondParts CylinderSecondBorder CylinderSecondForce CylinderSecond.
From Forceshade Require Import BumpCylinder Bump1pShaded Bump2p Bump2pShaded Bump3p Bump3pShaded.
From Forceshade Require Import BigFloatSearch ThirdStages Code Balls RecordedStages.
From Forceshade Require Import RecordedParts.
Import ListNotations.

(* ---- exact() of each law ---- *)

Lemma nonzero_is : forall x, is_nonzero x = negb (is_equal32 x zero32).
Proof. intro x. unfold is_nonzero, is_equal32. now destruct (Bcompare 24 128 x zero32) as [[| |]|]. Qed.
Lemma at_least_zero : forall z, is_finite 24 128 z = true -> is_at_most32 zero32 z = negb (is_less32 z zero32).
Proof.
  intros z F. unfold is_at_most32, is_less32. rewrite (Bcompare_correct 24 128 z zero32 F eq_refl),
    (Bcompare_correct 24 128 zero32 z eq_refl F), (Rcompare_sym (B2R 24 128 zero32)).
  now destruct (Rcompare (B2R 24 128 z) (B2R 24 128 zero32)).
Qed.
Lemma beside_is : forall w x, is_less32 w (b32_mult mode_NE two32 (b32_abs x)) = is_beside w x.
Proof. reflexivity. Qed.
Lemma foot_is : forall w x, is_equal32 (b32_mult mode_NE two32 (b32_abs x)) w = is_at_foot w x.
Proof. reflexivity. Qed.

(* Signs of which nothing but the outcome depends. *)
Lemma any_sign : forall (number : Type) s (x z : number), match s with is_negative => (is_negative, x, z) | is_zero => (is_zero, x, z)
  | is_positive => (is_positive, x, z) | is_unknown => (is_unknown, x, z) end = (s, x, z).
Proof. now intros number [] x z. Qed.

Definition edge (R w : binary32) : binary32 := largest_on_top R w (half_top_3p R (NewtonThird.sine_of_third R w)).

Section Exact.
Context {number : Type} (N : ball number).
Local Notation "a + b" := (sum_in N a b). Local Notation "a * b" := (product_in N a b). Local Notation "a / b" := (quotient_in N a b).
Local Notation "a - b" := (sum_in N a (minus_in N b)). Local Notation of64 := (exactly_in N). Local Notation of32 a := (of64 (to64 a)).

Definition along_in (K : binary32) (gap normal_x normal_z : number) : Sign * number * number :=
  let magnitude := of32 K * gap in (sign_in N gap, magnitude * normal_x, magnitude * normal_z).
Definition plane_in (K z : binary32) := along_in K (of64 (opp (to64 z))) (of64 zero64) (of64 (two_to 0)).
Definition shaded_in (K R x : binary32) (gap : number) :=
  along_in K (gap / of32 R) (of32 x) (root_in N ((of32 R - of32 x) * (of32 R + of32 x))).
Definition depth_in (R w : binary32) : number :=
  root_in N ((of32 R - of64 (half_width w)) * (of32 R + of64 (half_width w))).
Definition side_in (tangent : number) (w x z : binary32) : number := tangent * (of64 (half_width w) - of32 (b32_abs x)) - of32 z.
Definition tangent_2p_in (R w : binary32) : number := of64 (half_width w) / (of32 R + depth_in R w).
Definition cosine_2p_in (R w : binary32) : number := root_in N ((of32 R + depth_in R w) / (of32 R + of32 R)).
Definition sine_2p_in (R w : binary32) : number := of64 (half_width w) / ((of32 R + of32 R) * cosine_2p_in R w).
Definition sine_3p_in (t : number) : number := of64 (two_to 1) * t * root_in N ((of64 (two_to 0) - t) * (of64 (two_to 0) + t)).
Definition cosine_3p_in (t : number) : number := of64 (two_to 0) - of64 (two_to 1) * t * t.
Definition top_in (R : binary32) (t : number) : number := of64 (two_to 1) * (of32 R * t) * sine_3p_in t.

Lemma along_is_recorded : forall t h R w K x z,
  wall_exact N t h R w K x z = plane_in K z /\ bump_1p_exact N t h R w K x z = plane_in K z /\
  bump_2p_exact N t h R w K x z = (if is_beside w x then plane_in K z
    else along_in K (side_in (tangent_2p_in R w) w x z) (if is_less32 x zero32 then minus_in N (sine_2p_in R w) else sine_2p_in R w)
      (cosine_2p_in R w)) /\
  bump_3p_exact N t h R w K x z = (if is_beside w x then plane_in K z
    else if is_at_most32 (b32_abs x) h then along_in K (top_in R t - of32 z) (of64 zero64) (of64 (two_to 0))
    else along_in K (side_in (sine_3p_in t / cosine_3p_in t) w x z)
      (if is_less32 x zero32 then minus_in N (sine_3p_in t) else sine_3p_in t) (cosine_3p_in t)).
Proof.
  intros t h R w K x z. unfold wall_exact, bump_1p_exact, bump_2p_exact, bump_3p_exact. rewrite !any_sign, !beside_is, ?two_is.
  repeat split; destruct (is_beside w x); try reflexivity.
  - destruct (is_less32 x zero32); reflexivity.
  - destruct (is_at_most32 (b32_abs x) h); [reflexivity|]. destruct (is_less32 x zero32); reflexivity.
Qed.

Lemma shaded_is_recorded : forall t h R w K x z,
  bump_1p_shaded_exact N t h R w K x z = (if is_beside w x then plane_in K z else shaded_in K R x (of64 (opp (to64 z)))) /\
  bump_2p_shaded_exact N t h R w K x z = (if is_beside w x then plane_in K z
    else shaded_in K R x (if is_at_foot w x then of64 (opp (to64 z)) else side_in (tangent_2p_in R w) w x z)) /\
  bump_3p_shaded_exact N t h R w K x z = (if is_beside w x then plane_in K z
    else shaded_in K R x (if is_at_foot w x then of64 (opp (to64 z)) else
      if is_at_most32 (b32_abs x) h then top_in R t - of32 z else side_in (sine_3p_in t / cosine_3p_in t) w x z)).
Proof.
  intros t h R w K x z. unfold bump_1p_shaded_exact, bump_2p_shaded_exact, bump_3p_shaded_exact.
  rewrite !any_sign, !beside_is, ?foot_is, ?two_is.
  repeat split; destruct (is_beside w x); try reflexivity; destruct (is_at_foot w x); try reflexivity.
  destruct (is_at_most32 (b32_abs x) h); reflexivity.
Qed.

Definition cylinder_in (R w K x z : binary32) : Sign * number * number :=
  let half := of64 (half_width w) in let l := of32 z + depth_in R w in
  match (if negb (is_equal32 x zero32) then is_positive else sign_in N l) with
  | is_unknown => (is_unknown, of32 R, of32 R)
  | is_zero => (is_positive, of64 zero64, of32 K * of32 R)
  | _ =>
    let v := (half - of32 x) * (half + of32 x) - of32 z * (l + depth_in R w) in
    let rho := root_in N (of32 x * of32 x + l * l) in
    let scale := of32 K * v / ((of32 R + rho) * rho) in (sign_in N v, scale * of32 x, scale * l)
  end.
Definition bump_cylinder_in (R w K x z : binary32) : Sign * number * number :=
  let cylinder := cylinder_in R w K x z in
  match fst (fst cylinder) with
  | is_unknown => cylinder
  | contact_sign =>
    if is_at_most32 zero32 z then cylinder
    else
      match contact_sign with
      | is_positive => (is_positive, snd (fst cylinder), snd cylinder + snd (plane_in K z))
      | _ => plane_in K z
      end
  end.

Lemma cylinder_is_recorded : forall t h R w K x z, cylinder_exact N t h R w K x z = cylinder_in R w K x z.
Proof.
  intros t h R w K x z. unfold cylinder_exact. rewrite !any_sign. unfold cylinder_in. destruct (negb (is_equal32 x zero32));
    [reflexivity|].
  change (root_in N ((of64 (to64 R) - of64 (times (two_to (-1)) (to64 w))) * (of64 (to64 R) + of64 (times (two_to (-1)) (to64 w)))))
    with (depth_in R w).
  cbv zeta. destruct (sign_in N (of32 z + depth_in R w)); reflexivity.
Qed.

Lemma bump_cylinder_is_recorded : forall t h R w K x z, bump_cylinder_exact N t h R w K x z = bump_cylinder_in R w K x z.
Proof.
  intros t h R w K x z. unfold bump_cylinder_exact. rewrite !any_sign. unfold bump_cylinder_in, cylinder_in.
  change (root_in N ((of64 (to64 R) - of64 (times (two_to (-1)) (to64 w))) * (of64 (to64 R) + of64 (times (two_to (-1)) (to64 w)))))
    with (depth_in R w).
  change (times (two_to (-1)) (to64 w)) with (half_width w). cbv zeta.
  set (l := of32 z + depth_in R w). set (v := _ - of32 z * (l + depth_in R w)).
  destruct (negb (is_equal32 x zero32)); [|destruct (sign_in N l)]; cbn [fst snd]; try reflexivity;
    destruct (sign_in N v), (is_at_most32 zero32 z); reflexivity.
Qed.
End Exact.

(* ---- The second stage ---- *)

Ltac second_terms := unfold ShadedAlong.along_shaded, plane_in, shaded_in, decide_along, decide_outcome, along_in, side_gap_2p,
  side_gap_3p, top_gap_3p, side_gap, side_in, tangent_2p, tangent_2p_in, face_sine_2p, face_cosine_2p, sine_2p_in, cosine_2p_in, sum_2p,
  diameter, computed_depth, depth_square, depth_in, top_height_3p, half_top_3p, top_in, tangent_3p, sine_3p_of, sine_3p_in, cosine_3p_of,
  cosine_3p_in, twice, one64;
  cbn [two_terms exactly_in minus_in sum_in product_in quotient_in root_in sign_in]; cbv zeta; reflexivity.

Lemma second_stages_are_recorded : forall R w K x z, let exact law := decide_outcome (law R w K x z) in
  let t := NewtonThird.sine_of_third R w in let h := edge R w in
  cylinder_second R w K x z = exact (cylinder_exact two_terms t h) /\
  (is_finite 24 128 z = true -> bump_cylinder_second R w K x z = exact (bump_cylinder_exact two_terms t h)) /\
  bump_2p_second R w K x z = exact (bump_2p_exact two_terms t h) /\
  bump_3p_second R w K x z = exact (bump_3p_exact two_terms t h) /\
  bump_1p_shaded_second R w K x z = exact (bump_1p_shaded_exact two_terms t h) /\
  bump_2p_shaded_second R w K x z = exact (bump_2p_shaded_exact two_terms t h) /\
  bump_3p_shaded_second R w K x z = exact (bump_3p_shaded_exact two_terms t h).
Proof.
  intros R w K x z exact t h. unfold exact.
  pose proof (along_is_recorded two_terms t h R w K x z) as (_ & _ & E2 & E3). pose proof (shaded_is_recorded two_terms t h R w K x z) as
    (S1 & S2 & S3).
  assert (C : cylinder_outcome R w K x z = cylinder_in two_terms R w K x z).
  { unfold cylinder_outcome, cylinder_in. rewrite nonzero_is.
    unfold second_scale, second_v, second_rho, second_squares, second_m, second_l, computed_depth, depth_square, depth_in. cbv zeta.
    cbn [two_terms exactly_in minus_in sum_in product_in quotient_in root_in sign_in]. destruct (negb (is_equal32 x zero32));
      [reflexivity|].
    match goal with |- match BesideTie.sign_of ?l with is_negative => _ | is_zero => _ | is_positive => _ | is_unknown => _ end = _ =>
      destruct (BesideTie.sign_of l) end; reflexivity. }
  rewrite cylinder_is_recorded, bump_cylinder_is_recorded, E2, E3, S1, S2, S3.
  repeat match goal with |- _ /\ _ => split end.
  - unfold cylinder_second. now rewrite C.
  - intro F. unfold bump_cylinder_second, bump_cylinder_outcome, bump_cylinder_in. rewrite C, (at_least_zero z F). reflexivity.
  - unfold bump_2p_second. destruct (is_beside w x); [|destruct (is_less32 x zero32)]; second_terms.
  - unfold bump_3p_second. fold t. change (is_on_flat R w x) with (is_at_most32 (b32_abs x) h).
    destruct (is_beside w x); [|destruct (is_at_most32 (b32_abs x) h); [|destruct (is_less32 x zero32)]]; second_terms.
  - unfold bump_1p_shaded_second. destruct (is_beside w x); second_terms.
  - unfold bump_2p_shaded_second. destruct (is_beside w x); [|destruct (is_at_foot w x)]; second_terms.
  - unfold bump_3p_shaded_second. change (is_on_flat R w x) with (is_at_most32 (b32_abs x) h).
    destruct (is_beside w x); [|destruct (is_at_foot w x); [|destruct (is_at_most32 (b32_abs x) h)]]; second_terms.
Qed.

(* ---- The third stage ---- *)

Definition with_sign {number} (found : comparison * number * number) : Sign * number * number :=
  (as_sign (fst (fst found)), snd (fst found), snd found).

Lemma third_stages_are_recorded : forall {number} (A : arithmetic number) R w K x z, let N := of_arithmetic A in
  let t := Third.sine_of_third A R w in let h := edge R w in
  with_sign (Third.cylinder A R w K x z) = cylinder_exact N t h R w K x z /\
  (is_finite 24 128 z = true -> with_sign (Third.bump_cylinder A R w K x z) = bump_cylinder_exact N t h R w K x z) /\
  with_sign (Third.bump_2p A R w K x z) = bump_2p_exact N t h R w K x z /\
  with_sign (Third.bump_3p A R w K x z) = bump_3p_exact N t h R w K x z /\
  with_sign (Third.bump_1p_shaded A R w K x z) = bump_1p_shaded_exact N t h R w K x z /\
  with_sign (Third.bump_2p_shaded A R w K x z) = bump_2p_shaded_exact N t h R w K x z /\
  with_sign (Third.bump_3p_shaded A R w K x z) = bump_3p_shaded_exact N t h R w K x z.
Proof.
  intros number A R w K x z N t h.
  pose proof (along_is_recorded N t h R w K x z) as (_ & _ & E2 & E3). pose proof (shaded_is_recorded N t h R w K x z) as (S1 & S2 & S3).
  assert (C : with_sign (Third.cylinder A R w K x z) = cylinder_in N R w K x z).
  { unfold Third.cylinder, cylinder_in. rewrite nonzero_is. cbv zeta. destruct (negb (is_equal32 x zero32)); [reflexivity|].
    change (sign_in N (sum_in N (exactly_in N (to64 z)) (depth_in N R w))) with
      (as_sign (ThirdStages.sign_of A (sum A (from_binary64 A (to64 z)) (Third.depth A R w)))).
    destruct (ThirdStages.sign_of A _); reflexivity. }
  rewrite cylinder_is_recorded, bump_cylinder_is_recorded, E2, E3, S1, S2, S3.
  repeat match goal with |- _ /\ _ => split end.
  - exact C.
  - intro F. unfold Third.bump_cylinder, bump_cylinder_in. rewrite <- C, (at_least_zero z F). cbv zeta.
    destruct (Third.cylinder A R w K x z) as [[[| |] fx] fz]; destruct (is_less32 z zero32); reflexivity.
  - unfold Third.bump_2p. destruct (is_beside w x); reflexivity.
  - unfold Third.bump_3p. destruct (is_beside w x); [reflexivity|]. fold t. cbv zeta. change (is_on_flat R w x) with (is_at_most32
    (b32_abs x) h).
    destruct (is_at_most32 (b32_abs x) h); reflexivity.
  - unfold Third.bump_1p_shaded. destruct (is_beside w x); reflexivity.
  - unfold Third.bump_2p_shaded. destruct (is_beside w x); [reflexivity|]. destruct (is_at_foot w x); reflexivity.
  - unfold Third.bump_3p_shaded, Third.gap_3p. destruct (is_beside w x); [reflexivity|]. destruct (is_at_foot w x); [reflexivity|].
    change (is_on_flat R w x) with (is_at_most32 (b32_abs x) h). destruct (is_at_most32 (b32_abs x) h); reflexivity.
Qed.

(* ---- What laws hold ---- *)

Lemma splitter_is : whole 16777217 = constant (2 ^ 24 + 1) 0.
Proof. reflexivity. Qed.
Lemma members_are_recorded : forall {number} (arithmetic_of : nat -> arithmetic number) is_fused R w K,
  let t := NewtonThird.sine_of_third R w in
  members (code_of_wall is_fused R w K) = wall_members R w K t /\
  members (code_of_bump_1p is_fused R w K) = bump_1p_members R w K t /\
  members (code_of_cylinder arithmetic_of is_fused R w K) = cylinder_members R w K t /\
  members (code_of_bump_cylinder arithmetic_of is_fused R w K) = bump_cylinder_members R w K t /\
  members (code_of_bump_2p arithmetic_of is_fused R w K) = bump_2p_members R w K t /\
  members (code_of_bump_3p arithmetic_of is_fused R w K) = bump_3p_members R w K t /\
  members (code_of_bump_1p_shaded arithmetic_of is_fused R w K) = bump_1p_shaded_members R w K t /\
  members (code_of_bump_2p_shaded arithmetic_of is_fused R w K) = bump_2p_shaded_members R w K t /\
  members (code_of_bump_3p_shaded arithmetic_of is_fused R w K) = bump_3p_shaded_members R w K t.
Proof.
  intros number arithmetic_of is_fused R w K t. repeat match goal with |- _ /\ _ => split end;
  [reflexivity|reflexivity| | | | | | | ];
  cbn [members code_of_cylinder code_of_bump_cylinder code_of_bump_2p code_of_bump_3p code_of_bump_1p_shaded code_of_bump_2p_shaded
    code_of_bump_3p_shaded curved members_of_cylinder members_of_two members_of_three members_of_gap members_of_sides members_of_shading
      app];
  unfold members_of_cylinder, members_of_two, members_of_three, members_of_gap, members_of_sides, members_of_shading; cbn [app];
  unfold cylinder_members, bump_cylinder_members, bump_2p_members, bump_3p_members, bump_1p_shaded_members, bump_2p_shaded_members,
    bump_3p_shaded_members;
  cbn [two_terms exactly_in minus_in sum_in product_in quotient_in root_in sign_in];
  unfold anchor_of, anchor_terms, axis_of, split_tail, split_head, half_width, fast_two_sum, computed_depth, depth_square, K_over_R,
    K_times, height_2p, tangent_2p, face_sine_2p, face_cosine_2p, sum_2p, diameter, top_height_3p, side_height_3p, tangent_3p,
      sine_3p_of, cosine_3p_of,
    half_top_3p, top_of, twice, one64, computed_depth, depth_square, half_width; fold t; cbn [fst snd];
  rewrite ?two_is, ?eight_is, ?splitter_is; cbv zeta; try reflexivity.
Qed.

(* ---- evaluate() ---- *)

Definition recorded_answer {number} (A : arithmetic number) (window : Z) (first : binary64 -> binary64 -> FirstStage)
    (second : binary32 -> binary32 -> Sign * double_double * double_double) (third : binary32 -> binary32 -> Sign * number * number)
    (x y z : binary32) : evaluation :=
  snd (evaluate_recorded two_terms (of_arithmetic A) window first tt tt (fun _ => second) (fun _ => third) x y z).

Lemma quantised_is_finite : forall z, in_domain z = true -> is_finite 24 128 (quantised z) = true.
Proof. intros z H. apply in_domain_is_right in H. unfold quantised. now destruct (is_at_most32 quantum (b32_abs z)), H. Qed.

Lemma evaluate_is_recorded : forall {number} (A : arithmetic number) window first second third found_second found_third x y z,
  (forall x z, is_finite 24 128 z = true -> second x z = decide_outcome (found_second x z)) ->
  (forall x z, is_finite 24 128 z = true -> with_sign (third x z) = found_third x z) ->
  evaluate window first (later_of second (fun x z => Third.decide A (third x z))) x y z =
  recorded_answer A window first found_second found_third x y z.
Proof.
  intros number A window first second third found_second found_third x y z H2 H3. unfold recorded_answer, evaluate_recorded, evaluate,
    valid.
  destruct (in_domain x); [|reflexivity]. destruct (in_domain y); [|reflexivity]. destruct (in_domain z) eqn:Hz; [|reflexivity].
  pose proof (quantised_is_finite z Hz) as F. cbn [andb negb].
  assert (L : later_of second (fun x z => Third.decide A (third x z)) (quantised x) (quantised z) =
    snd (match fst (fst (found_second (quantised x) (quantised z))) with
      | is_negative | is_zero => (1%Z, no_force free)
      | is_positive => if negb (is_given (rounded_to_binary32 (snd (fst (found_second (quantised x) (quantised z)))))) ||
          negb (is_given (rounded_to_binary32 (snd (found_second (quantised x) (quantised z)))))
        then (2%Z, Third.decide A (third (quantised x) (quantised z)))
        else (1%Z, (contact, (given (rounded_to_binary32 (snd (fst (found_second (quantised x) (quantised z))))), zero32,
          given (rounded_to_binary32 (snd (found_second (quantised x) (quantised z)))))))
      | is_unknown => (2%Z, Third.decide A (third (quantised x) (quantised z)))
      end)).
  { unfold later_of. rewrite (H2 _ _ F). destruct (found_second _ _) as [[[| | |] fx] fz]; cbn [decide_outcome decide fst snd]; try
    reflexivity.
    destruct (rounded_to_binary32 fx), (rounded_to_binary32 fz); reflexivity. }
  assert (T : snd (match fst (fst (found_third (quantised x) (quantised z))) with
      | is_negative | is_zero => (2%Z, no_force free)
      | is_positive => if negb (is_given (Third.rounded A (snd (fst (found_third (quantised x) (quantised z)))))) ||
          negb (is_given (Third.rounded A (snd (found_third (quantised x) (quantised z)))))
        then (2%Z, no_force invalid)
        else (2%Z, (contact, (given (Third.rounded A (snd (fst (found_third (quantised x) (quantised z))))), zero32,
          given (Third.rounded A (snd (found_third (quantised x) (quantised z)))))))
      | is_unknown => (2%Z, no_force invalid)
      end) = Third.decide A (third (quantised x) (quantised z))).
  { rewrite <- (H3 _ _ F). destruct (third _ _) as [[[| |] fx] fz]; cbn [Third.decide with_sign as_sign fst snd]; try reflexivity.
    destruct (Third.rounded A fx), (Third.rounded A fz); reflexivity. }
  rewrite L. clear L. rewrite <- T. clear T H2 H3 F. cbn [two_terms of_arithmetic nearest_in].
  generalize (first (to64 (quantised x)) (to64 (quantised z))). intro f.
  destruct (first_doubt f), (first_contact f), (in_doubt window (bits_of_b64 (first_x f))), (in_doubt window (bits_of_b64 (first_z f)));
    cbn [negb andb]; try reflexivity;
    (destruct (found_second (quantised x) (quantised z)) as [[[| | |] fx] fz]; cbn [fst snd]; try reflexivity;
    destruct (found_third (quantised x) (quantised z)) as [[[| | |] gx] gz]; cbn [fst snd];
    repeat match goal with |- context [is_given ?a] => destruct (is_given a); cbn [negb orb snd fst] end; reflexivity).
Qed.

(* ---- The laws: what proofs/Main.v says of an answer, it says of recorded terms ---- *)

Definition nothing (x z : binary64) : FirstStage := {| first_x := x; first_z := z; first_contact := false; first_doubt := true |}.
(* The first stage with the members that the constructor computes. *)
Definition first_of_3 first (l : list binary64) := match l with [a; b; c] => first a b c | _ => nothing end.
Definition first_of_7 first (l : list binary64) := match l with [a; b; c; d; e; f; g] => first a b c d e f g | _ => nothing end.
Definition first_of_8 first (l : list binary64) := match l with [a; b; c; d; e; f; g; h] => first a b c d e f g h | _ => nothing end.
Definition first_of_10 first (l : list binary64) :=
  match l with [a; b; c; d; e; f; g; h; i; j] => first a b c d e f g h i j | _ => nothing end.
Definition first_of_11 first (l : list binary64) :=
  match l with [a; b; c; d; e; f; g; h; i; j; k] => first a b c d e f g h i j k | _ => nothing end.
(* exact() in any ball. *)
Definition exact_term : Type := forall number : Type, ball number ->
  number -> binary32 -> binary32 -> binary32 -> binary32 -> binary32 -> binary32 -> Sign * number * number.

(* A law as it is recorded. *)
Definition recorded_law {number} (arithmetic_of : nat -> arithmetic number) (limbs : nat) (window : Z)
    (first : list binary64 -> binary64 -> binary64 -> FirstStage) (members : binary32 -> binary32 -> binary32 -> double_double -> list
      binary64)
    (exact : exact_term) (R w K : binary32) : binary32 -> binary32 -> binary32 -> evaluation :=
  let t := sine_of_third_by_1 two_terms R w in
  let half_top := largest_on_top_recorded R w (half_top_3p R t) in
  recorded_answer (arithmetic_of limbs) window (first (members R w K t))
    (exact _ two_terms t half_top R w K)
    (exact _ (of_arithmetic (arithmetic_of limbs)) (sine_of_third_by_7 (of_arithmetic (arithmetic_of limbs)) R w) half_top R w K).

Theorem laws_are_recorded : forall {number} (arithmetic_of : nat -> arithmetic number) is_fused R w K x y z,
  let recorded := recorded_law arithmetic_of in
  answer (code_of_cylinder arithmetic_of is_fused R w K) x y z =
    recorded cylinder_limbs cylinder_window (first_of_8 (cylinder is_fused)) cylinder_members (@cylinder_exact) R w K x y z /\
  answer (code_of_bump_cylinder arithmetic_of is_fused R w K) x y z =
    recorded bump_cylinder_limbs bump_cylinder_window (first_of_8 (bump_cylinder is_fused)) bump_cylinder_members (@bump_cylinder_exact)
      R w K x y z /\
  answer (code_of_bump_2p arithmetic_of is_fused R w K) x y z =
    recorded bump_2p_limbs bump_2p_window (first_of_8 (bump_2p is_fused)) bump_2p_members (@bump_2p_exact) R w K x y z /\
  answer (code_of_bump_3p arithmetic_of is_fused R w K) x y z =
    recorded bump_3p_limbs bump_3p_window (first_of_11 (bump_3p is_fused)) bump_3p_members (@bump_3p_exact) R w K x y z /\
  answer (code_of_bump_1p_shaded arithmetic_of is_fused R w K) x y z =
    recorded bump_1p_shaded_limbs bump_1p_shaded_window (first_of_3 (bump_1p_shaded is_fused)) bump_1p_shaded_members
      (@bump_1p_shaded_exact) R w K x y z /\
  answer (code_of_bump_2p_shaded arithmetic_of is_fused R w K) x y z =
    recorded bump_2p_shaded_limbs bump_2p_shaded_window (first_of_7 (bump_2p_shaded is_fused)) bump_2p_shaded_members
      (@bump_2p_shaded_exact) R w K x y z /\
  answer (code_of_bump_3p_shaded arithmetic_of is_fused R w K) x y z =
    recorded bump_3p_shaded_limbs bump_3p_shaded_window (first_of_10 (bump_3p_shaded is_fused)) bump_3p_shaded_members
      (@bump_3p_shaded_exact) R w K x y z.
Proof.
  intros number arithmetic_of is_fused R w K x y z recorded. unfold recorded, recorded_law.
  rewrite second_sine_is_recorded, largest_on_top_is_recorded, !third_sine_is_recorded. fold (edge R w).
  destruct (members_are_recorded arithmetic_of is_fused R w K) as (_ & _ & M1 & M2 & M3 & M4 & M5 & M6 & M7).
  rewrite <- M1, <- M2, <- M3, <- M4, <- M5, <- M6, <- M7. clear M1 M2 M3 M4 M5 M6 M7.
  cbv beta iota delta [code_of_cylinder code_of_bump_cylinder code_of_bump_2p code_of_bump_3p code_of_bump_1p_shaded
    code_of_bump_2p_shaded
    code_of_bump_3p_shaded curved members answer later window first_stage later_stages third_stage members_of_cylinder members_of_two
    members_of_three members_of_gap members_of_sides members_of_shading app first_of_3 first_of_7 first_of_8 first_of_10 first_of_11
    cylinder_of bump_2p_of bump_3p_of bump_1p_shaded_of bump_2p_shaded_of bump_3p_shaded_of].
  pose proof (second_stages_are_recorded R w K) as H2. pose proof (fun A => third_stages_are_recorded A R w K (number := number)) as H3.
  cbv beta zeta in H2, H3.
  repeat match goal with |- _ /\ _ => split end; cbv beta iota zeta.
  - refine (evaluate_is_recorded (arithmetic_of 32%nat) _ _ _ (Third.cylinder _ R w K) _ _ x y z _ _); intros a b F;
      [destruct (H2 a b) as (A1 & A2 & A3 & A4 & A5 & A6 & A7)|destruct (H3 (arithmetic_of 32%nat) a b) as (A1 & A2 & A3 & A4 & A5 & A6 &
        A7)];
      exact A1.
  - refine (evaluate_is_recorded (arithmetic_of 32%nat) _ _ _ (Third.bump_cylinder _ R w K) _ _ x y z _ _); intros a b F;
      [destruct (H2 a b) as (A1 & A2 & A3 & A4 & A5 & A6 & A7)|destruct (H3 (arithmetic_of 32%nat) a b) as (A1 & A2 & A3 & A4 & A5 & A6 &
        A7)];
      exact (A2 F).
  - refine (evaluate_is_recorded (arithmetic_of 32%nat) _ _ _ (Third.bump_2p _ R w K) _ _ x y z _ _); intros a b F;
      [destruct (H2 a b) as (A1 & A2 & A3 & A4 & A5 & A6 & A7)|destruct (H3 (arithmetic_of 32%nat) a b) as (A1 & A2 & A3 & A4 & A5 & A6 &
        A7)];
      exact A3.
  - refine (evaluate_is_recorded (arithmetic_of 64%nat) _ _ _ (Third.bump_3p _ R w K) _ _ x y z _ _); intros a b F;
      [destruct (H2 a b) as (A1 & A2 & A3 & A4 & A5 & A6 & A7)|destruct (H3 (arithmetic_of 64%nat) a b) as (A1 & A2 & A3 & A4 & A5 & A6 &
        A7)];
      exact A4.
  - refine (evaluate_is_recorded (arithmetic_of 12%nat) _ _ _ (Third.bump_1p_shaded _ R w K) _ _ x y z _ _); intros a b F;
      [destruct (H2 a b) as (A1 & A2 & A3 & A4 & A5 & A6 & A7)|destruct (H3 (arithmetic_of 12%nat) a b) as (A1 & A2 & A3 & A4 & A5 & A6 &
        A7)];
      exact A5.
  - refine (evaluate_is_recorded (arithmetic_of 32%nat) _ _ _ (Third.bump_2p_shaded _ R w K) _ _ x y z _ _); intros a b F;
      [destruct (H2 a b) as (A1 & A2 & A3 & A4 & A5 & A6 & A7)|destruct (H3 (arithmetic_of 32%nat) a b) as (A1 & A2 & A3 & A4 & A5 & A6 &
        A7)];
      exact A6.
  - refine (evaluate_is_recorded (arithmetic_of 64%nat) _ _ _ (Third.bump_3p_shaded _ R w K) _ _ x y z _ _); intros a b F;
      [destruct (H2 a b) as (A1 & A2 & A3 & A4 & A5 & A6 & A7)|destruct (H3 (arithmetic_of 64%nat) a b) as (A1 & A2 & A3 & A4 & A5 & A6 &
        A7)];
      exact A7.
Qed.

(* A plane is never in doubt, and so has no later stage: whatever stands in its place. *)
Theorem planes_are_recorded : forall {number} (A : arithmetic number) is_fused R w K x y z second third,
  answer (code_of_wall is_fused R w K) x y z = recorded_answer A wall_window (wall is_fused (to64 K)) second third x y z /\
  answer (code_of_bump_1p is_fused R w K) x y z = recorded_answer A bump_1p_window (bump_1p is_fused (to64 K)) second third x y z.
Proof.
  intros number A is_fused R w K x y z second third. unfold recorded_answer, evaluate_recorded, answer, evaluate, valid.
  cbn [code_of_wall code_of_bump_1p plane window first_stage]. unfold wall, bump_1p, wall_window, bump_1p_window.
  split; (destruct (in_domain x), (in_domain y), (in_domain z); try reflexivity; cbn [first_doubt first_contact first_x first_z negb
    andb];
    cbv zeta; change (in_doubt 0) with (fun _ : Z => false); destruct (is_less _ _); reflexivity).
Qed.
