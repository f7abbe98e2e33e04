(* SPDX-License-Identifier: BSD-3-Clause *)
(* The specification a second time, in other words than those of proofs/spec/Laws.v, and that Laws.v says no less. weakened_test.py requires
   that Coq refuses this file, or Main.v, for each weaker specification that it makes. *)
From Coq Require Import ZArith Reals Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Laws.
Open Scope R_scope.

(* ---- The domain ---- *)

Lemma every_parameter : forall R w K : binary32, is_finite 24 128 R = true -> is_finite 24 128 w = true -> is_finite 24 128 K = true ->
  1 / 10 <= B2R 24 128 R -> B2R 24 128 R <= 100 * 100 -> 1 / 1000 <= B2R 24 128 w -> B2R 24 128 w / 2 <= B2R 24 128 R ->
  1 / 1000 <= B2R 24 128 K -> B2R 24 128 K <= 1000 -> parameters R w K /\ stiffness K.
Proof. intros. unfold parameters, stiffness. repeat split; trivial; lra. Qed.

(* ---- Right answers ---- *)

Definition size (x : binary32) : R := Rabs (B2R 24 128 x).
Definition as_read (x : binary32) : R := if Rlt_dec (size x) (/ 1073741824) then 0 else B2R 24 128 x.
Definition is_in_domain (x : binary32) : Prop := is_finite 24 128 x = true /\ size x <= 100 * 100.

(* No number of the format with 24 bits is nearer, of two that are as near it is the even one, and there is no -0. *)
Definition is_rounded (answer : binary32) (exact : R) : Prop :=
  Rnd_NE_pt radix2 (FLT_exp (-149) 24) exact (B2R 24 128 answer) /\ is_finite 24 128 answer = true /\ answer <> B754_zero 24 128 true.

Lemma nearest_is_rounded : forall answer exact, is_nearest32 answer exact -> is_rounded answer exact.
Proof.
  intros answer exact (V & F & Z). split; [|split; [exact F|]].
  - rewrite V. apply round_NE_pt; [now apply FLT_exp_valid|now apply exists_NE_FLT; right].
  - intros ->. cbn in V. specialize (Z (eq_sym V)). discriminate.
Qed.

(* Every part of a right answer, for any law. *)
Lemma answered : forall (law : R -> R -> exact_force) answer x y z, right_answer answer law x y z ->
  is_in_domain x -> is_in_domain y -> is_in_domain z ->
  let exact := law (as_read x) (as_read z) in
  (in_contact exact -> exists fx fz, answer = (contact, (fx, B754_zero 24 128 false, fz)) /\
    is_rounded fx (exact_x exact) /\ is_rounded fz (exact_z exact)) /\
  (~ in_contact exact -> answer = (free, (B754_zero 24 128 false, B754_zero 24 128 false, B754_zero 24 128 false))).
Proof.
  assert (E : forall x, read (B2R 24 128 x) = as_read x).
  { intro x. unfold read, as_read, size. change (bpow radix2 (-30)) with (/ 1073741824).
    destruct (Rlt_dec _ _) as [L|L]; [now rewrite Rle_bool_false|rewrite Rle_bool_true by lra; reflexivity]. }
  assert (D : forall x, is_in_domain x -> in_range x).
  { intros x [F S]. split; [exact F|]. unfold size in S. lra. }
  intros law answer x y z [H _] Dx Dy Dz exact. rewrite !E in H. fold exact in H.
  specialize (H (conj (D _ Dx) (conj (D _ Dy) (D _ Dz)))). split; intro T.
  - destruct H as [[N _]|[_ (fx & fz & A & Nx & Nz)]]; [now elim N|]. exists fx, fz. split; [exact A|].
    split; now apply nearest_is_rounded.
  - destruct H as [[_ A]|[C _]]; [exact A|now elim T].
Qed.

Lemma not_in_domain : forall (law : R -> R -> exact_force) answer x y z, right_answer answer law x y z ->
  is_finite 24 128 x = false \/ is_finite 24 128 y = false \/ is_finite 24 128 z = false \/
    100 * 100 < size x \/ 100 * 100 < size y \/ 100 * 100 < size z ->
  answer = (invalid, (B754_zero 24 128 false, B754_zero 24 128 false, B754_zero 24 128 false)).
Proof.
  intros law answer x y z [_ H] B. apply H. unfold in_range, size in *. intros ((Fx & Sx) & (Fy & Sy) & (Fz & Sz)).
  destruct B as [B|[B|[B|[B|[B|B]]]]]; (congruence || lra).
Qed.

(* ---- The nine laws: contact, and the force at a penetration or inside of a cylinder ---- *)

Section Laws.
  Variables Rad w K X Z : R.
  Let d := sqrt (Rad * Rad - w / 2 * (w / 2)).
  Let h := Rad - d.
  Let alpha := asin (w / (2 * Rad)).
  Let top := w / 2 * cos (2 / 3 * alpha) - d * sin (2 / 3 * alpha).                (* w'/2 *)
  Let top_at := w / 2 * sin (2 / 3 * alpha) + d * cos (2 / 3 * alpha) - d.          (* h' *)
  Let rho := sqrt (X * X + (Z + d) * (Z + d)).
  Let H_2p := if Rle_dec (Rabs X) (w / 2) then h * (1 - 2 * Rabs X / w) else 0.
  Let H_3p := if Rle_dec (Rabs X) (w / 2) then if Rle_dec (Rabs X) top then top_at else top_at * (w / 2 - Rabs X) / (w / 2 - top) else 0.
  Let sign := if Rlt_dec X 0 then -1 else 1.

  (* F_x, F_z: M along (a, 1) / sqrt(1 + a^2). *)
  Let along (a M : R) := (K * M * (a / sqrt (1 + a * a)), K * M * (1 / sqrt (1 + a * a))).
  Let shaded (M : R) := if Rle_dec (Rabs X) (w / 2) then (K * M * (X / Rad), K * M * (sqrt (Rad * Rad - X * X) / Rad)) else (0, K * M).
  Let faced (a M : R) := if Rle_dec (Rabs X) (w / 2) then along (sign * a) M else (0, K * M).
  Let slope_of_three := if Rle_dec (Rabs X) top then 0 else top_at / (w / 2 - top).
  Let in_cylinder :=
    if Rlt_dec rho Rad
    then if Req_EM_T rho 0 then (0, K * Rad) else (K * (Rad - rho) * (X / rho), K * (Rad - rho) * ((Z + d) / rho)) else (0, 0).

  Let is (exact : exact_force) (touches : Prop) (F : R * R) : Prop := (in_contact exact <-> touches) /\ (exact_x exact, exact_z exact) = F.

  Let le_bool : forall a b, Rle_bool a b = if Rle_dec a b then true else false.
  Proof. intros a b. destruct (Rle_dec a b) as [H|H]; [now apply Rle_bool_true|apply Rle_bool_false; lra]. Qed.
  Let lt_bool : forall a b, Rlt_bool a b = if Rlt_dec a b then true else false.
  Proof. intros a b. destruct (Rlt_dec a b) as [H|H]; [now apply Rlt_bool_true|apply Rlt_bool_false; lra]. Qed.
  Let eq_bool : forall a b, Req_bool a b = if Req_EM_T a b then true else false.
  Proof. intros a b. destruct (Req_EM_T a b) as [H|H]; [now apply Req_bool_true|now apply Req_bool_false]. Qed.

  Let same (a b c e : R) : a = c -> b = e -> (a, b) = (c, e).
  Proof. now intros -> ->. Qed.

  Let depth_is : axis_depth Rad w = d.
  Proof. reflexivity. Qed.
  Let theta_is : theta Rad w = 2 / 3 * alpha.
  Proof. reflexivity. Qed.
  Let half_top_is : top_width Rad w / 2 = top.
  Proof. unfold top_width. rewrite theta_is, depth_is. unfold top. field. Qed.
  Let top_height_is : top_height Rad w = top_at.
  Proof. unfold top_height. now rewrite theta_is, depth_is. Qed.
  Let two_is : penetration_2p Rad w X Z = H_2p - Z.
  Proof.
    unfold penetration_2p, bump_height, H_2p. rewrite depth_is, le_bool. fold h. destruct (Rle_dec (Rabs X) (w / 2)); [reflexivity|ring].
  Qed.
  Let three_is : penetration_3p Rad w X Z = H_3p - Z.
  Proof.
    unfold penetration_3p, H_3p. rewrite half_top_is, top_height_is, !le_bool. destruct (Rle_dec (Rabs X) (w / 2)); [|ring].
    now destruct (Rle_dec (Rabs X) top).
  Qed.
  Let shaded_is : forall M, (shaded_x Rad w K X M, shaded_z Rad w K X M) = shaded M.
  Proof.
    intro M. unfold shaded_x, shaded_z, shaded. rewrite le_bool. destruct (Rle_dec (Rabs X) (w / 2)); [reflexivity|].
    apply same; ring.
  Qed.
  Let faced_is : forall a M, (side_x w K a X M, side_z w K a X M) = faced a M.
  Proof.
    intros a M. unfold side_x, side_z, faced, along, sine_of, cosine_of, sign, Rsqr. rewrite le_bool, lt_bool.
    destruct (Rle_dec (Rabs X) (w / 2)); [|apply same; ring].
    destruct (Rlt_dec X 0); apply same; try (replace (-1 * a * (-1 * a)) with (a * a) by ring; try unfold Rdiv; ring);
      replace (1 * a * (1 * a)) with (a * a) by ring; unfold Rdiv; ring.
  Qed.
  Let cylinder_is : (cylinder_x Rad w K X Z, cylinder_z Rad w K X Z) = in_cylinder.
  Proof.
    unfold cylinder_x, cylinder_z, distance_from_axis, in_cylinder. rewrite depth_is. fold rho. rewrite lt_bool, eq_bool.
    destruct (Rlt_dec rho Rad); [|reflexivity]. destruct (Req_EM_T rho 0) as [E|E]; [apply same; rewrite ?E; ring|reflexivity].
  Qed.
  Let positive : forall H : R, 0 < H - Z <-> Z < H.
  Proof. intro H. split; intro; lra. Qed.

  Lemma wall_again : is (exact_wall K X Z) (Z < 0) (0, K * - Z).
  Proof. split; [reflexivity|apply same; [reflexivity|cbn; ring]]. Qed.
  Lemma bump_1p_again : is (exact_bump_1p Rad w K X Z) (Z < 0) (0, K * - Z).
  Proof. split; [reflexivity|apply same; [reflexivity|cbn; ring]]. Qed.
  Lemma cylinder_again : is (exact_cylinder Rad w K X Z) (rho < Rad) in_cylinder.
  Proof. split; [reflexivity|exact cylinder_is]. Qed.
  Lemma bump_cylinder_again : is (exact_bump_cylinder Rad w K X Z) (rho < Rad \/ Z < 0)
    (fst in_cylinder, snd in_cylinder + (if Rlt_dec (- K * Z) 0 then 0 else - K * Z)).
  Proof.
    split; [reflexivity|]. rewrite <- cylinder_is. apply same; [reflexivity|]. cbn [exact_z exact_bump_cylinder force snd]. f_equal.
    destruct (Rlt_dec (- K * Z) 0); [apply Rmax_right|apply Rmax_left]; lra.
  Qed.
  Lemma bump_2p_again : is (exact_bump_2p Rad w K X Z) (Z < H_2p) (faced (2 * h / w) (H_2p - Z)).
  Proof. unfold exact_bump_2p. cbv zeta. rewrite two_is. split; [apply positive|apply faced_is]. Qed.
  Lemma bump_3p_again : is (exact_bump_3p Rad w K X Z) (Z < H_3p) (faced slope_of_three (H_3p - Z)).
  Proof.
    unfold exact_bump_3p. cbv zeta. rewrite three_is. replace (slope_at Rad w X) with slope_of_three.
    { split; [apply positive|apply faced_is]. }
    unfold slope_at, slope_3p, slope_of_three. rewrite half_top_is, top_height_is, le_bool. now destruct (Rle_dec (Rabs X) top).
  Qed.
  Lemma bump_1p_shaded_again : is (exact_bump_1p_shaded Rad w K X Z) (Z < 0) (shaded (- Z)).
  Proof. split; [reflexivity|apply shaded_is]. Qed.
  Lemma bump_2p_shaded_again : is (exact_bump_2p_shaded Rad w K X Z) (Z < H_2p) (shaded (H_2p - Z)).
  Proof. unfold exact_bump_2p_shaded. cbv zeta. rewrite two_is. split; [apply positive|apply shaded_is]. Qed.
  Lemma bump_3p_shaded_again : is (exact_bump_3p_shaded Rad w K X Z) (Z < H_3p) (shaded (H_3p - Z)).
  Proof. unfold exact_bump_3p_shaded. cbv zeta. rewrite three_is. split; [apply positive|apply shaded_is]. Qed.
End Laws.
