(* SPDX-License-Identifier: BSD-3-Clause *)
(* The intervals (c - r, c + r) of integers that decide normals in doubt (rendering/meshes/interval.h; docs/proofs.md, "Normals in
   doubt"): what a product, a quotient and a root of two of their numbers is off at most. *)
From Coq Require Import Reals Lra Psatz.
Open Scope R_scope.

Theorem product_is_off_by : forall x y c d r s, Rabs (x - c) <= r -> Rabs (y - d) <= s ->
  Rabs (x * y - c * d) <= Rabs c * s + (Rabs d + s) * r.
Proof.
  intros x y c d r s X Y. replace (x * y - c * d) with (c * (y - d) + (d + (y - d)) * (x - c)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult. apply Rplus_le_compat.
  - apply Rmult_le_compat_l; [apply Rabs_pos|exact Y].
  - apply Rmult_le_compat; try apply Rabs_pos; [|exact X]. apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

Theorem quotient_is_off_by : forall x y c d r s, Rabs (x - c) <= r -> Rabs (y - d) <= s -> s < Rabs d ->
  Rabs (x / y - c / d) <= (r + Rabs (c / d) * s) / (Rabs d - s).
Proof.
  intros x y c d r s X Y S. assert (D : d <> 0) by (intros ->; rewrite Rabs_R0 in S; pose proof (Rabs_pos (y - 0)); lra).
  assert (L : Rabs d - s <= Rabs y) by (pose proof (Rabs_triang_inv d (d - y)) as T; rewrite (Rabs_minus_sym d y) in T;
    replace (d - (d - y)) with y in T by ring; lra).
  assert (P : 0 < Rabs y) by lra. assert (N : y <> 0) by (intros ->; rewrite Rabs_R0 in P; lra).
  replace (x / y - c / d) with (((x - c) - c / d * (y - d)) / y) by (field; now split).
  unfold Rdiv at 1. rewrite Rabs_mult, Rabs_inv. unfold Rdiv at 2.
  apply Rmult_le_compat; [apply Rabs_pos|apply Rlt_le, Rinv_0_lt_compat, P| |apply Rinv_le_contravar; lra].
  apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp, Rabs_mult. apply Rplus_le_compat; [exact X|].
  apply Rmult_le_compat_l; [apply Rabs_pos|exact Y].
Qed.

(* q need not be the root of c: nothing of Newton's method, which finds it, is used. *)
Theorem root_is_off_by : forall x c r q, 0 <= x -> 0 < q -> Rabs (x - c) <= r -> Rabs (sqrt x - q) <= (Rabs (c - q * q) + r) / q.
Proof.
  intros x c r q X Q H. pose proof (sqrt_pos x) as P. pose proof (sqrt_sqrt x X) as SS.
  assert (N : Rabs (x - q * q) <= Rabs (c - q * q) + r).
  { replace (x - q * q) with ((c - q * q) + (x - c)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  assert (E : Rabs (sqrt x - q) * (sqrt x + q) = Rabs (x - q * q)).
  { rewrite <- (Rabs_pos_eq (sqrt x + q)) at 1 by lra. rewrite <- Rabs_mult. f_equal. rewrite <- SS at 3. ring. }
  apply Rmult_le_reg_r with q; [exact Q|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
  apply Rle_trans with (2 := N). rewrite <- E. apply Rmult_le_compat_l; [apply Rabs_pos|lra].
Qed.
