(* SPDX-License-Identifier: BSD-3-Clause *)
(* A number of binary32 beside the root of a difference of two squares, as the depth of the cylinder's axis is and twice that depth: it
   is the root, or it is far from it as a share of the root. So where z + d or z + 2d has cancelled in double-double, few bits are lost. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs.
From Forceshade Require Import Depth DoubleDoubleTerms Separation.
Open Scope R_scope.


(* The difference of the squares, where the root and the number are near each other. *)
Lemma squares_are_apart : forall A C Y k, in_binary32 A -> in_binary32 C -> in_binary32 Y -> (-22 <= k <= 14)%Z ->
  bpow radix2 k <= Y < bpow radix2 (k + 1) -> bpow radix2 (k - 1) <= A -> / 2000 <= C -> A * A - C * C - Y * Y <> 0 ->
  bpow radix2 (2 * k - 70) <= Rabs (A * A - C * C - Y * Y).
Proof.
  intros A C Y k GA GC GY Hk HY HA HC Hne. pose proof (bpow_gt_0 radix2 k) as Pk. pose proof (bpow_gt_0 radix2 (k - 1)) as Pk1.
  assert (MY : multiple (23 - k) Y) by (apply (multiple_of_binary32 k); [lia|exact GY|rewrite Rabs_pos_eq; lra]).
  assert (MA : multiple (24 - k) A).
  { replace (24 - k)%Z with (23 - (k - 1))%Z by ring. apply (multiple_of_binary32 (k - 1)); [lia|exact GA|rewrite Rabs_pos_eq; lra]. }
  destruct (Rle_lt_dec (bpow radix2 (k - 12)) C) as [Hlarge|Hsmall].
  - assert (MC : multiple (35 - k) C).
    { replace (35 - k)%Z with (23 - (k - 12))%Z by ring. apply (multiple_of_binary32 (k - 12)); [lia|exact GC|rewrite Rabs_pos_eq; lra]. }
    assert (M : multiple (70 - 2 * k) (A * A - C * C - Y * Y)).
    { apply (multiple_finer (Z.max (Z.max (24 - k + (24 - k)) (35 - k + (35 - k))) (23 - k + (23 - k)))); [|lia].
      repeat first [apply multiple_minus|apply multiple_times]; assumption. }
    pose proof (multiple_not_0 _ _ M Hne) as D. now replace (2 * k - 70)%Z with (- (70 - 2 * k))%Z by ring.
  - assert (HCC : C * C <= bpow radix2 (2 * k - 24)).
    { replace (2 * k - 24)%Z with ((k - 12) + (k - 12))%Z by ring. rewrite bpow_plus. apply Rmult_le_compat; lra. }
    assert (LCC : / 4000000 <= C * C) by (replace (/ 4000000) with (/ 2000 * / 2000) by field; apply Rmult_le_compat; lra).
    assert (Hlow : bpow radix2 (2 * k - 70) <= / 4000000).
    { apply Rle_trans with (bpow radix2 (-42)); [apply bpow_le; lia|simpl; lra]. }
    destruct (Req_dec A Y) as [E|E].
    + rewrite E. replace (Y * Y - C * C - Y * Y) with (- (C * C)) by ring. rewrite Rabs_Ropp, Rabs_pos_eq; lra.
    + assert (MAY : multiple (24 - k) (A - Y)).
      { apply (multiple_finer (Z.max (24 - k) (23 - k))); [|lia]. now apply multiple_minus. }
      pose proof (multiple_not_0 _ _ MAY ltac:(lra)) as D. replace (- (24 - k))%Z with (k - 24)%Z in D by ring.
      assert (D2 : 3 / 2 * bpow radix2 (2 * k - 24) <= Rabs (A * A - Y * Y)).
      { replace (A * A - Y * Y) with ((A - Y) * (A + Y)) by ring. rewrite Rabs_mult, (Rabs_pos_eq (A + Y)) by lra.
        replace (2 * k - 24)%Z with ((k - 24) + k)%Z by ring. rewrite bpow_plus.
        replace (3 / 2 * (bpow radix2 (k - 24) * bpow radix2 k)) with (bpow radix2 (k - 24) * (3 / 2 * bpow radix2 k)) by ring.
        apply Rmult_le_compat; try lra; [apply bpow_ge_0|].
        assert (bpow radix2 (k - 1) = / 2 * bpow radix2 k) by (unfold Z.sub; rewrite bpow_plus;
          change (bpow radix2 (- (1))) with (/ 2); ring).
        lra. }
      pose proof (size_by (A * A - Y * Y) (A * A - C * C - Y * Y)) as S.
      replace (A * A - Y * Y - (A * A - C * C - Y * Y)) with (C * C) in S by ring. rewrite (Rabs_pos_eq (C * C)) in S by lra.
      apply Rle_trans with (/ 2 * bpow radix2 (2 * k - 24)); [|lra].
      change (/ 2) with (bpow radix2 (-1)). rewrite <- bpow_plus. apply bpow_le. lia.
Qed.

Theorem beside_a_root : forall A C D Y, in_binary32 A -> in_binary32 C -> in_binary32 Y -> / 2000 <= C -> 0 <= A ->
  / 1000000 <= D <= 20000 -> D * D = A * A - C * C -> D <> Y -> bpow radix2 (-74) * D <= Rabs (D - Y).
Proof.
  intros A C D Y GA GC GY HC HA HD HD2 Hne.
  destruct (Rle_lt_dec (/ 1000 * D) (Rabs (D - Y))) as [Far|Near].
  { apply Rle_trans with (2 := Far). apply Rmult_le_compat_r; [lra|]. simpl. lra. }
  apply Rabs_def2 in Near. set (k := (mag radix2 Y - 1)%Z).
  assert (HY : bpow radix2 k <= Y < bpow radix2 (k + 1)).
  { unfold k. split; [pose proof (bpow_mag_le radix2 Y ltac:(lra)) as H|replace (mag radix2 Y - 1 + 1)%Z with (mag radix2 Y : Z) by ring;
      pose proof (bpow_mag_gt radix2 Y) as H]; rewrite Rabs_pos_eq in H by lra; exact H. }
  assert (Hk : (-22 <= k <= 14)%Z).
  { split.
    - assert (-22 < k + 1)%Z; [|lia]. apply (lt_bpow radix2). apply Rle_lt_trans with (2 := proj2 HY). simpl. lra.
    - assert (k < 15)%Z; [|lia]. apply (lt_bpow radix2). apply Rle_lt_trans with (1 := proj1 HY). simpl. lra. }
  clearbody k. assert (HAD : D <= A).
  { apply Rsqr_incr_0_var; [|exact HA]. unfold Rsqr. pose proof (Rle_0_sqr C) as P. unfold Rsqr in P. lra. }
  pose proof (bpow_gt_0 radix2 k) as Pk.
  assert (E1 : bpow radix2 (k - 1) = / 2 * bpow radix2 k) by (unfold Z.sub; rewrite bpow_plus;
    change (bpow radix2 (- (1))) with (/ 2); ring).
  assert (EN : A * A - C * C - Y * Y = (D - Y) * (D + Y)) by (rewrite <- HD2; ring).
  assert (Hne2 : A * A - C * C - Y * Y <> 0) by (rewrite EN; apply Rmult_integral_contrapositive_currified; lra).
  pose proof (squares_are_apart A C Y k GA GC GY Hk HY ltac:(lra) HC Hne2) as N. rewrite EN, Rabs_mult, (Rabs_pos_eq (D + Y)) in N by lra.
  assert (E2 : bpow radix2 (k + 1) = 2 * bpow radix2 k) by (rewrite bpow_plus; change (bpow radix2 1) with 2; ring).
  pose proof (Rabs_pos (D - Y)) as P.
  apply Rmult_le_reg_r with (5 * bpow radix2 k); [lra|].
  apply Rle_trans with (bpow radix2 (2 * k - 70)).
  - replace (2 * k - 70)%Z with (-70 + (k + k))%Z by ring. rewrite !bpow_plus.
    replace (bpow radix2 (-74)) with (bpow radix2 (-70) * / 16) by (change (/ 16) with (bpow radix2 (-4)); rewrite <- bpow_plus;
      reflexivity).
    pose proof (bpow_gt_0 radix2 (-70)).
    replace (bpow radix2 (-70) * / 16 * D * (5 * bpow radix2 k)) with (bpow radix2 (-70) * (/ 16 * D * (5 * bpow radix2 k))) by ring.
    apply Rmult_le_compat_l; [lra|]. replace (/ 16 * D * (5 * bpow radix2 k)) with (5 / 16 * D * bpow radix2 k) by field.
    apply Rmult_le_compat_r; lra.
  - apply Rle_trans with (1 := N). apply Rmult_le_compat_l; lra.
Qed.
