(* SPDX-License-Identifier: BSD-3-Clause *)
(* How near the border of contact a position can be without being on it: docs/proofs.md, "The last stage". *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Polygons CylinderFirst ThreePolygons.
From Forceshade Require Import DoubleDoubleTerms Separation SeparationOfCylinder SeparationOfBump2pShaded SeparationOfCubic.
From Forceshade Require Import SeparationOfBump3p.
Open Scope R_scope.

(* v = R^2 - rho^2, as the cylinder's law has it, and z + d, which is 0 on the axis where x is 0. *)
Theorem cylinder_contact_is_separated : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let d := axis_depth (value32 R) (value32 w) in
  let v := (value32 w / 2 - X) * (value32 w / 2 + X) - Z * (Z + d + d) in
  v = value32 R * value32 R - (X * X + (Z + d) * (Z + d)) /\
  (v <> 0 -> bpow radix2 (-241) <= Rabs v) /\ (Z + d <> 0 -> bpow radix2 (-121) <= Rabs (Z + d)).
Proof.
  intros R w K x y z Hp Hv X Z d v. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  multiples_of_inputs Hp Cx Cz.
  destruct Hp as (_ & HR & Hw & _). pose proof (coordinate_range _ _ Cx) as BX. pose proof (coordinate_range _ _ Cz) as BZ.
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2]. fold d in Hd0, Hd2. clearbody d X Z.
  unfold v. clear v. set (c := value32 w / 2) in *. assert (Hc : 0 < c) by (unfold c; lra). set (Rad := value32 R) in *. clearbody c Rad.
  assert (HdR : d <= Rad).
  { apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite Hd2. pose proof (Rle_0_sqr c) as P. unfold Rsqr in P. lra. }
  assert (square : forall a B, Rabs a <= B -> 0 <= a * a <= B * B).
  { intros a B Ha. split; [exact (Rle_0_sqr a)|]. apply Rle_trans with (1 := Rle_abs _). now apply product_size. }
  assert (BR : 0 <= Rad * Rad <= 10000 * 10000) by (apply square; rewrite Rabs_pos_eq; lra).
  assert (Bl : Rabs (Z - d) <= 20000) by (apply Rle_trans with (1 := minus_size _ _); rewrite (Rabs_pos_eq d); lra).
  split; [|split]; intros.
  - replace ((c - X) * (c + X) - Z * (Z + d + d)) with (c * c + d * d - (X * X + (Z + d) * (Z + d))) by ring. lra.
  - set (a := c * c - X * X - Z * Z). set (t := - (2 * Z * d)).
    replace ((c - X) * (c + X) - Z * (Z + d + d)) with (a + t) in * by (unfold a, t; ring).
    assert (Ma : multiple 106 a) by (unfold a; multiple).
    assert (Mt : multiple (2 * 106) (t * t)).
    { replace (t * t) with (4 * (Z * Z) * (Rad * Rad - c * c)) by (rewrite <- Hd2; unfold t; ring). multiple. }
    assert (Hconj : Rabs (a - t) <= bpow radix2 29).
    { replace (a - t) with (Rad * Rad - (X * X + (Z - d) * (Z - d))) by
        (replace (Rad * Rad) with (d * d + c * c) by lra; unfold a, t; ring).
      pose proof (square _ _ BX). pose proof (square _ _ Bl). apply Rabs_le. simpl. lra. }
    pose proof (separation_of_degree_2 106 a t (bpow radix2 29) Ma Mt H ltac:(apply bpow_le; lia) Hconj) as L.
    apply Rmult_le_reg_r with (bpow radix2 29); [apply bpow_gt_0|]. rewrite <- bpow_plus. exact L.
  - assert (Mt : multiple (2 * 53) (d * d)) by (rewrite Hd2; multiple).
    assert (Hconj : Rabs (Z - d) <= bpow radix2 15) by (apply Rle_trans with (1 := Bl); simpl; lra).
    pose proof (separation_of_degree_2 53 Z d (bpow radix2 15) MZ Mt H ltac:(apply bpow_le; lia) Hconj) as L.
    apply Rmult_le_reg_r with (bpow radix2 15); [apply bpow_gt_0|]. rewrite <- bpow_plus. exact L.
Qed.

Theorem bump_2p_contact_is_separated : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_2p (value32 R) (value32 w) X Z in
  M <> 0 -> bpow radix2 (-218) <= Rabs M.
Proof.
  intros R w K x y z Hp Hv X Z M Hne. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  multiples_of_inputs Hp Cx Cz.
  destruct Hp as (_ & HR & Hw & _). pose proof (coordinate_range _ _ Cz) as BZ.
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  unfold M, penetration_2p, bump_height in *. clear M. set (d := axis_depth (value32 R) (value32 w)) in *. clearbody d X Z.
  set (c := value32 w / 2) in *. assert (Hwc : value32 w = 2 * c) by (unfold c; field). rewrite Hwc in *. set (Rad := value32 R) in *.
  clearbody c Rad. revert Hne. case Rle_bool_spec; intros Hin Hne.
  2: { apply Rle_trans with (bpow radix2 (- (53))); [apply bpow_le; lia|]. apply multiple_not_0; [now apply multiple_opp|exact Hne]. }
  rewrite gap_2p_is in * by lra. set (A := c * (c - Rabs X) - Z * Rad) in *. set (F := (A - Z * d) / (Rad + d)) in *.
  assert (HdR : d <= Rad).
  { apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite Hd2. pose proof (Rle_0_sqr c) as P. unfold Rsqr in P. lra. }
  assert (MabsX : multiple 53 (Rabs X)) by (unfold Rabs; destruct (Rcase_abs X); [now apply multiple_opp|exact MX]).
  assert (MA : multiple 87 A) by (unfold A; multiple). pose proof (Rabs_pos X) as PX.
  assert (BR : Rabs Rad <= 10000) by (rewrite Rabs_pos_eq; lra). assert (Bd : Rabs d <= 10000) by (rewrite Rabs_pos_eq; lra).
  assert (Bc : Rabs c <= 10000) by (rewrite Rabs_pos_eq; lra). assert (Bh : Rabs (c - Rabs X) <= 10000) by (rewrite Rabs_pos_eq; lra).
  assert (E : A + - (Z * d) = (F - 0) * (Rad + d)) by (unfold F; field; lra).
  assert (Mt : multiple (2 * 87) (- (Z * d) * - (Z * d))).
  { replace (- (Z * d) * - (Z * d)) with (Z * Z * (d * d)) by ring. rewrite Hd2. multiple. }
  assert (H0 : A + - (Z * d) <> 0) by (rewrite E; apply Rmult_integral_contrapositive_currified; lra).
  assert (Hconj : Rabs (A - - (Z * d)) <= bpow radix2 29).
  { unfold A. replace (c * (c - Rabs X) - Z * Rad - - (Z * d)) with (c * (c - Rabs X) - Z * Rad + Z * d) by ring.
    apply Rle_trans with (10000 * 10000 + 10000 * 10000 + 10000 * 10000); [size_of_parts|simpl; lra]. }
  pose proof (separation_of_degree_2 87 A (- (Z * d)) (bpow radix2 29) MA Mt H0 ltac:(apply bpow_le; lia) Hconj) as L.
  rewrite <- (Rminus_0_r F). apply (separation_of_quotient F 0 (Rad + d) (A + - (Z * d)) 15 218 E); [simpl; lra|].
  apply Rmult_le_reg_r with (bpow radix2 29); [apply bpow_gt_0|]. rewrite <- bpow_plus. exact L.
Qed.

(* A penetration of a bump of three polygons, times its denominator. *)
Lemma three_penetration_is_separated : forall Rad w om eta r2 r3 A B F D, multiple 27 Rad -> multiple 33 w ->
  three Rad w om eta r2 r3 -> let p := 3 * (Rad * Rad) in let q := - (w * (Rad * Rad)) in
  integral p q 111 A -> integral p q 82 B -> 0 < Rad <= 10000 ->
  (forall r y, Rabs r <= 20000 -> Rabs (r * y) <= 200000000 -> Rabs (2 * (Rad * Rad) - r * r) <= 200000000 ->
    Rabs (A r + B r * y) <= 6000000000000) ->
  A om + B om * eta = (F - 0) * D -> 0 < D <= 200000000 -> F <> 0 -> bpow radix2 (-909) <= Rabs F.
Proof.
  intros Rad w om eta r2 r3 A B F D MR Mw H p q HA HB HR Size E HD Hne. rewrite <- (Rminus_0_r F).
  apply (separation_of_quotient F 0 D (A om + B om * eta) 28 909 E); [simpl; lra|].
  apply (separation_of_degree_6 (2 * Rad) p q om r2 r3 eta 111 43 A B); try assumption.
  - now apply (cubic_of_three Rad w om eta r2 r3).
  - lia.
  - intros r y Hr. destruct (sizes_of_conjugates Rad r y HR Hr) as (B1 & B2 & B3).
    apply Rle_trans with (1 := Size r y B1 B2 B3). simpl. lra.
  - now destruct H.
  - rewrite E. apply Rmult_integral_contrapositive_currified; lra.
Qed.

Theorem bump_3p_contact_is_separated : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_3p (value32 R) (value32 w) X Z in
  M <> 0 -> bpow radix2 (-909) <= Rabs M.
Proof.
  intros R w K x y z Hp Hv X Z M Hne. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  multiples_of_inputs Hp Cx Cz. pose proof (multiple_of_width _ _ _ Hp) as Mw.
  destruct Hp as (_ & HR & Hw & _). pose proof (coordinate_range _ _ Cz) as BZ.
  destruct (three_are (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (eta & r2 & r3 & Three).
  unfold M, penetration_3p in *. clear M. set (om := top_width (value32 R) (value32 w)) in *. clearbody X Z.
  set (Rad := value32 R) in *. set (W := value32 w) in *. clearbody Rad W.
  assert (Mp : multiple 58 (3 * (Rad * Rad))) by multiple. assert (Mq : multiple 87 (- (W * (Rad * Rad)))) by multiple.
  revert Hne. case Rle_bool_spec; intros Hin Hne.
  2: { apply Rle_trans with (bpow radix2 (- (53))); [apply bpow_le; lia|]. apply multiple_not_0; [now apply multiple_opp|exact Hne]. }
  assert (MabsX : multiple 53 (Rabs X)) by (unfold Rabs; destruct (Rcase_abs X); [now apply multiple_opp|exact MX]).
  pose proof (Rabs_pos X) as PX. set (h := W / 2 - Rabs X) in *. assert (Hh : Rabs h <= 10000) by (unfold h; rewrite Rabs_pos_eq; lra).
  assert (Mh : multiple 53 h) by (unfold h; multiple).
  replace (top_height Rad W * h / (W / 2 - om / 2)) with (slope_3p Rad W * h) in * by (unfold slope_3p; fold om; unfold Rdiv; ring).
  pose proof (three_penetration_is_separated Rad W om eta r2 r3) as separated.
  pose proof Three as [_ _ _ Hom Eh Es _ _]. rewrite Eh, Es in *. specialize (fun A B F D => separated A B F D MR Mw Three).
  assert (PR : 0 < Rad * Rad) by (apply Rmult_lt_0_compat; lra).
  assert (HRR : Rad * Rad <= 100000000) by (apply Rle_trans with (10000 * 10000); [apply Rmult_le_compat; lra|lra]).
  assert (Ho : 0 < om * om <= Rad * Rad) by (split; [apply Rmult_lt_0_compat|apply Rmult_le_compat]; lra).
  assert (BRR : Rabs (2 * (Rad * Rad)) <= 200000000) by (rewrite Rabs_pos_eq; lra).
  revert Hne. case Rle_bool_spec; intros Htop Hne.
  - apply (separated (fun _ => - (2 * (Rad * Rad) * Z)) (fun r => r * r) _ (2 * (Rad * Rad))); try assumption; try lra.
    + integral.
    + integral.
    + intros r e Br Bry _. replace (- (2 * (Rad * Rad) * Z) + r * r * e) with (r * (r * e) - 2 * (Rad * Rad) * Z) by ring. sizes.
    + field. lra.
  - apply (separated (fun r => - (Z * (2 * (Rad * Rad) - r * r))) (fun r => h * r) _ (2 * (Rad * Rad) - om * om)); try assumption; try lra.
    + integral.
    + integral.
    + intros r e _ Bry Bd.
      replace (- (Z * (2 * (Rad * Rad) - r * r)) + h * r * e) with (h * (r * e) - Z * (2 * (Rad * Rad) - r * r)) by ring.
      sizes.
    + field. lra.
Qed.
