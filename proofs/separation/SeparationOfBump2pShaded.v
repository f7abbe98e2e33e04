(* SPDX-License-Identifier: BSD-3-Clause *)
(* The separation of bump-2p-shaded: docs/proofs.md, "The last stage". *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Shaded Gap Polygons CylinderFirst.
From Forceshade Require Import DoubleDoubleTerms Separation SeparationOfCylinder.
Open Scope R_scope.

(* K (A - z d)/(R + d) times x/R or sqrt(R^2 - x^2)/R, where A - z d is the gap times R + d. *)
Lemma polygon_component_is_separated : forall K Rad c d X Z A S m,
  multiple 33 K -> multiple 27 Rad -> multiple 34 c -> multiple 53 X -> multiple 53 Z -> multiple 87 A -> multiple 150 m ->
  d * d = Rad * Rad - c * c -> 0 <= K <= 1000 -> / 10 <= Rad <= 10000 -> 0 <= d <= Rad -> Rabs Z <= 10000 -> Rabs A <= 200000000 ->
  Rabs m <= 20000001 -> S = X \/ S * S = Rad * Rad - X * X -> Rabs S <= 10000 ->
  let F := K * ((A - Z * d) / (Rad + d)) * (S / Rad) in F <> m -> bpow radix2 (-1031) <= Rabs (F - m).
Proof.
  intros K Rad c d X Z A S m MK MR Mc MX MZ MA Mm Hd2 HK HR Hd HZ HA Hm HS BS F Hne.
  set (e := Rad * Rad - c * c) in *. assert (Me : multiple 68 e) by (unfold e; multiple). clearbody e.
  set (a := - (m * (Rad * Rad))). set (u := - (m * Rad) * d). set (t := K * (A - Z * d) * S).
  assert (E : a + u + t = (F - m) * (Rad * (Rad + d))) by (unfold a, u, t, F; field; lra).
  assert (Hne2 : a + u + t <> 0).
  { rewrite E. apply Rmult_integral_contrapositive_currified; [lra|]. apply Rmult_integral_contrapositive_currified; lra. }
  assert (BK : Rabs K <= 1000) by (rewrite Rabs_pos_eq; lra). assert (BR : Rabs Rad <= 10000) by (rewrite Rabs_pos_eq; lra).
  assert (Bd : Rabs d <= 10000) by (rewrite Rabs_pos_eq; lra).
  assert (BZd : Rabs (Z * d) <= 10000 * 10000) by now apply product_size.
  assert (B1 : Rabs (A - Z * d) <= 300000000) by (apply Rle_trans with (1 := minus_size _ _); lra).
  assert (B2 : Rabs (A + Z * d) <= 300000000) by (apply Rle_trans with (1 := Rabs_triang _ _); lra).
  assert (BRR : Rabs (Rad * Rad) <= 10000 * 10000) by now apply product_size.
  assert (Ba : Rabs a <= 2000000100000000).
  { unfold a. rewrite Rabs_Ropp. replace 2000000100000000 with (20000001 * (10000 * 10000)) by ring. now apply product_size. }
  assert (Bu : Rabs u <= 2000000100000000).
  { unfold u. replace 2000000100000000 with (20000001 * 10000 * 10000) by ring. apply product_size; [rewrite Rabs_Ropp; now apply
    product_size|exact Bd]. }
  assert (Bt : Rabs t <= 3000000000000000).
  { unfold t. replace 3000000000000000 with (1000 * 300000000 * 10000) by ring. apply product_size; [now apply product_size|exact BS]. }
  assert (C53 : bpow radix2 53 = 9007199254740992) by (simpl; lra).
  assert (HC : bpow radix2 (-211) <= bpow radix2 53) by (apply bpow_le; lia).
  assert (Low : bpow radix2 (- (4 * 211)) <= Rabs (a + u + t) * (bpow radix2 53 * bpow radix2 53 * bpow radix2 53)).
  { destruct HS as [-> | HS2].
    - (* along x: of degree 2 *)
      set (b := K * A * X - m * (Rad * Rad)). set (v := - (K * Z * X + m * Rad) * d).
      assert (Ev : a + u + t = b + v) by (unfold a, u, t, b, v; ring). rewrite Ev in *.
      assert (Mb : multiple 211 b) by (unfold b; multiple).
      assert (Mv : multiple (2 * 211) (v * v)).
      { replace (v * v) with ((K * Z * X + m * Rad) * (K * Z * X + m * Rad) * e) by (rewrite <- Hd2; unfold v; ring). multiple. }
      assert (Hconj : Rabs (b - v) <= bpow radix2 53).
      { replace (b - v) with (a - u + K * (A + Z * d) * X) by (unfold a, u, b, v; ring). rewrite C53.
        assert (Rabs (K * (A + Z * d) * X) <= 1000 * 300000000 * 10000) by (apply product_size; [now apply product_size|exact BS]).
        apply Rle_trans with (1 := Rabs_triang _ _). pose proof (minus_size a u). lra. }
      pose proof (separation_of_degree_2 211 b v _ Mb Mv Hne2 HC Hconj) as H.
      apply Rle_trans with (bpow radix2 (- (2 * 211))); [apply bpow_le; lia|]. apply Rle_trans with (1 := H).
      apply Rmult_le_compat_l; [apply Rabs_pos|]. rewrite <- !bpow_plus. apply bpow_le. lia.
    - set (S2 := Rad * Rad - X * X) in *. assert (MS : multiple 106 S2) by (unfold S2; multiple).
      set (p := K * K * (A * A + Z * Z * e) * S2). set (g := - (2 * K * K * A * Z * S2)). set (v := g * d).
      assert (Mg : multiple 312 g) by (unfold g; multiple).
      assert (Ma : multiple 211 a) by (unfold a; multiple).
      assert (Mu : multiple (2 * 211) (u * u)).
      { replace (u * u) with (m * Rad * (m * Rad) * e) by (rewrite <- Hd2; unfold u; ring). multiple. }
      assert (Mp : multiple (2 * 211) p) by (unfold p; multiple).
      assert (Muv : multiple (3 * 211) (u * v)).
      { replace (u * v) with (- (m * Rad) * g * e) by (rewrite <- Hd2; unfold u, v; ring). multiple. }
      assert (Mv : multiple (4 * 211) (v * v)).
      { replace (v * v) with (g * g * e) by (rewrite <- Hd2; unfold v; ring). multiple. }
      assert (Ht : t * t = p + v).
      { replace (t * t) with (K * K * ((A - Z * d) * (A - Z * d)) * (S * S)) by (unfold t; ring). rewrite HS2. unfold p, v, g. rewrite <-
        Hd2. ring. }
      assert (Hpv : p - v = K * (A + Z * d) * S * (K * (A + Z * d) * S)).
      { replace (K * (A + Z * d) * S * (K * (A + Z * d) * S)) with (K * K * ((A + Z * d) * (A + Z * d)) * (S * S)) by ring.
        rewrite HS2. unfold p, v, g. rewrite <- Hd2. ring. }
      clearbody p v. apply (separation_of_degree_4 211 a u p v t); try assumption.
      + rewrite C53. apply Rle_trans with (1 := minus_size _ _). pose proof (Rabs_triang a u). lra.
      + rewrite C53. apply Rle_trans with (1 := minus_size _ _). lra.
      + rewrite C53, Hpv. apply Rle_trans with (1 := minus_size _ _).
        assert (D1 : Rabs (a - u) <= 4000000200000000) by (apply Rle_trans with (1 := minus_size _ _); lra).
        assert (D2 : Rabs (K * (A + Z * d) * S) <= 1000 * 300000000 * 10000) by (apply product_size; [now apply product_size|exact BS]).
        pose proof (product_size _ _ _ _ D1 D1). pose proof (product_size _ _ _ _ D2 D2). lra. }
  apply (separation_of_quotient_4 F m (Rad * (Rad + d)) (a + u + t) 28 211 53 E); [|exact Low].
  split; [apply Rmult_lt_0_compat; lra|]. apply Rle_trans with (10000 * 20000); [apply Rmult_le_compat; lra|simpl; lra].
Qed.

Lemma gap_2p_is : forall Rad c d X Z, 0 < Rad -> 0 < c -> 0 <= d -> d * d = Rad * Rad - c * c ->
  (Rad - d) * (1 - 2 * Rabs X / (2 * c)) - Z = (c * (c - Rabs X) - Z * Rad - Z * d) / (Rad + d).
Proof.
  intros Rad c d X Z HR Hc Hd Hd2.
  assert (Hcd : (Rad - d) * (Rad + d) = c * c) by (replace ((Rad - d) * (Rad + d)) with (Rad * Rad - d * d) by ring; lra).
  apply Rmult_eq_reg_r with (Rad + d); [|lra]. unfold Rdiv at 2. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
  replace (((Rad - d) * (1 - 2 * Rabs X / (2 * c)) - Z) * (Rad + d)) with ((Rad - d) * (Rad + d) * (1 - Rabs X / c) - Z * (Rad + d)) by
    (field; lra).
  rewrite Hcd. field. lra.
Qed.

Theorem bump_2p_shaded_is_separated : forall R w K x y z m, parameters R w K -> valid x y z = true -> is_tie m ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_2p (value32 R) (value32 w) X Z in
  let Fx := shaded_x (value32 R) (value32 w) (value32 K) X M in let Fz := shaded_z (value32 R) (value32 w) (value32 K) X M in
  (Fx <> m -> bpow radix2 (-1031) <= Rabs (Fx - m)) /\ (Fz <> m -> bpow radix2 (-1031) <= Rabs (Fz - m)).
Proof.
  intros R w K x y z m Hp Hv Hm X Z M Fx Fz. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  multiples_of_inputs Hp Cx Cz. pose proof (multiple_of_tie m Hm) as Mm.
  destruct Hp as (_ & HR & Hw & HK). pose proof (coordinate_range _ _ Cz) as BZ.
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  unfold Fx, Fz, shaded_x, shaded_z, M, penetration_2p, bump_height in *. clear Fx Fz M.
  set (d := axis_depth (value32 R) (value32 w)) in *. clearbody d. set (Rad := value32 R) in *. set (k := value32 K) in *.
  set (c := value32 w / 2) in *. assert (Hwc : value32 w = 2 * c) by (unfold c; field).
  assert (Hc : / 2000 <= c <= Rad) by (unfold c; lra). rewrite Hwc in *. clearbody c Rad k.
  assert (HdR : d <= Rad).
  { apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite Hd2. pose proof (Rle_0_sqr c) as S. unfold Rsqr in S. lra. }
  assert (plain : forall F i, multiple i (F - m) -> (i <= 150)%Z -> F <> m -> bpow radix2 (-1031) <= Rabs (F - m)).
  { intros F i M Hi Hne. apply Rle_trans with (bpow radix2 (- i)); [apply bpow_le; lia|]. apply (multiple_not_0 _ _ M). lra. }
  assert (M0 : multiple 0 0) by apply (multiple_whole 0). assert (M1 : multiple 0 1) by apply (multiple_whole 1).
  case Rle_bool_spec; intro Hin.
  2: { split; apply (plain _ 150%Z); try lia; multiple. }
  set (A := c * (c - Rabs X) - Z * Rad).
  assert (MabsX : multiple 53 (Rabs X)) by (unfold Rabs; destruct (Rcase_abs X); [now apply multiple_opp|exact MX]).
  assert (MA : multiple 87 A) by (unfold A; multiple).
  assert (Hgap : (Rad - d) * (1 - 2 * Rabs X / (2 * c)) - Z = (A - Z * d) / (Rad + d)) by (apply gap_2p_is; lra).
  rewrite Hgap.
  pose proof (Rabs_pos X) as PX. assert (BcX : 0 <= c * (c - Rabs X) <= 10000 * 10000).
  { split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]. }
  assert (BA : Rabs A <= 200000000).
  { unfold A. apply Rle_trans with (1 := minus_size _ _). rewrite (Rabs_pos_eq (c * _)) by lra.
    assert (Rabs (Z * Rad) <= 10000 * 10000) by (apply product_size; [exact BZ|rewrite Rabs_pos_eq; lra]). lra. }
  assert (BG : Rabs ((A - Z * d) / (Rad + d)) <= 20000).
  { rewrite <- Hgap. apply Rle_trans with (1 := minus_size _ _). assert (Rabs ((Rad - d) * (1 - 2 * Rabs X / (2 * c))) <= 10000 * 1);
    [|lra].
    apply product_size; [rewrite Rabs_pos_eq; lra|]. replace (1 - 2 * Rabs X / (2 * c)) with ((c - Rabs X) / c) by (field; lra).
    apply quotient_size; rewrite (Rabs_pos_eq c) by lra; [lra|]. rewrite Rabs_pos_eq; lra. }
  assert (component : forall S, S = X \/ S * S = Rad * Rad - X * X -> Rabs S <= Rad -> k * ((A - Z * d) / (Rad + d)) * (S / Rad) <> m ->
    bpow radix2 (-1031) <= Rabs (k * ((A - Z * d) / (Rad + d)) * (S / Rad) - m)).
  { intros S HS BS Hne. assert (BF : Rabs (k * ((A - Z * d) / (Rad + d)) * (S / Rad)) <= 20000000).
    { replace 20000000 with (1000 * 20000 * 1) by ring. apply product_size; [apply product_size; [rewrite Rabs_pos_eq; lra|exact BG]|].
      apply quotient_size; rewrite (Rabs_pos_eq Rad) by lra; lra. }
    apply (small_middles_suffice 20000000 _ m); [exact BF|change 1 with (bpow radix2 0); apply bpow_le; lia| |exact Hne]. intros Bm _.
    apply (polygon_component_is_separated k Rad c d X Z A S m); try assumption; lra. }
  assert (HXR : Rabs X <= Rad) by lra. split; [now apply component; [left|]|].
  assert (Hroot : 0 <= Rsqr Rad - Rsqr X) by (pose proof (Rsqr_le_abs_1 X Rad ltac:(rewrite (Rabs_pos_eq Rad); lra)); lra).
  apply component; [right; now apply sqrt_sqrt|]. rewrite Rabs_pos_eq by apply sqrt_pos. rewrite <- (sqrt_Rsqr Rad) at 2 by lra.
  apply sqrt_le_1_alt. pose proof (Rle_0_sqr X). lra.
Qed.
