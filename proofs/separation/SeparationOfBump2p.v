(* SPDX-License-Identifier: BSD-3-Clause *)
(* The separation of bump-2p: docs/proofs.md, "The last stage". *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Gap Polygons CylinderFirst.
From Forceshade Require Import DoubleDoubleTerms TwoPolygonsConstants Separation SeparationOfCylinder.
Open Scope R_scope.

(* K (A + B d)/psi, where psi^2 = 2 R (R + d): both components are so, once R + d is divided out. *)
Lemma side_component_is_separated : forall K Rad c d psi A B m,
  multiple 33 K -> multiple 27 Rad -> multiple 34 c -> multiple 87 A -> multiple 53 B -> multiple 150 m ->
  d * d = Rad * Rad - c * c -> psi * psi = 2 * Rad * (Rad + d) -> 0 < psi <= 20000 -> 0 <= K <= 1000 -> 0 < Rad <= 10000 -> 0 <= d <= Rad ->
  Rabs A <= 200000000 -> Rabs B <= 10000 -> Rabs m <= 20000001 ->
  let F := K * (A + B * d) / psi in F <> m -> bpow radix2 (-859) <= Rabs (F - m).
Proof.
  intros K Rad c d psi A B m MK MR Mc MA MB Mm Hd2 Hpsi2 Hpsi HK HR Hd BA BB Hm F Hne.
  set (e := Rad * Rad - c * c) in *. assert (Me : multiple 68 e) by (unfold e; multiple). clearbody e.
  set (a := K * A). set (u := K * B * d). set (t := - (m * psi)).
  set (p := 2 * (m * Rad * (m * Rad))). set (g := 2 * (m * m * Rad)). set (v := g * d).
  assert (E : a + u + t = (F - m) * psi) by (unfold a, u, t, F; field; lra).
  assert (Hne2 : a + u + t <> 0) by (rewrite E; apply Rmult_integral_contrapositive_currified; lra).
  assert (Ma : multiple 181 a) by (unfold a; multiple).
  assert (Mu : multiple (2 * 181) (u * u)).
  { replace (u * u) with (K * B * (K * B) * e) by (rewrite <- Hd2; unfold u; ring). multiple. }
  assert (Mp : multiple (2 * 181) p) by (unfold p; multiple).
  assert (Mg : multiple 327 g) by (unfold g; multiple).
  assert (Muv : multiple (3 * 181) (u * v)).
  { replace (u * v) with (K * B * g * e) by (rewrite <- Hd2; unfold u, v; ring). multiple. }
  assert (Mv : multiple (4 * 181) (v * v)).
  { replace (v * v) with (g * g * e) by (rewrite <- Hd2; unfold v; ring). multiple. }
  assert (Ht : t * t = p + v).
  { replace (t * t) with (m * m * (psi * psi)) by (unfold t; ring). rewrite Hpsi2. unfold p, v, g. ring. }
  assert (Hpv : p - v = m * m * (2 * Rad * (Rad - d))) by (unfold p, v, g; ring).
  clearbody p v.
  assert (C40 : bpow radix2 40 = 1099511627776) by (simpl; lra).
  assert (HC : bpow radix2 (-181) <= bpow radix2 40) by (apply bpow_le; lia).
  assert (BK : Rabs K <= 1000) by (rewrite Rabs_pos_eq; lra). assert (Bd : Rabs d <= 10000) by (rewrite Rabs_pos_eq; lra).
  assert (Ba : Rabs a <= 1000 * 200000000) by (unfold a; now apply product_size).
  assert (Bu : Rabs u <= 1000 * 10000 * 10000) by (unfold u; apply product_size; [now apply product_size|exact Bd]).
  assert (Bt : Rabs t <= 20000001 * 20000).
  { unfold t. rewrite Rabs_Ropp. apply product_size; [exact Hm|]. rewrite Rabs_pos_eq; lra. }
  assert (Bau : Rabs (a - u) <= 300000000000) by (apply Rle_trans with (1 := minus_size _ _); lra).
  assert (C1 : Rabs (a + u - t) <= bpow radix2 40).
  { rewrite C40. apply Rle_trans with (1 := minus_size _ _). pose proof (Rabs_triang a u). lra. }
  assert (C2 : Rabs (a - u) <= bpow radix2 40) by (rewrite C40; lra).
  assert (C3 : Rabs ((a - u) * (a - u) - (p - v)) <= bpow radix2 40 * bpow radix2 40).
  { rewrite C40, Hpv. apply Rle_trans with (1 := minus_size _ _). pose proof (product_size _ _ _ _ Bau Bau) as S1.
    assert (S2 : Rabs (m * m * (2 * Rad * (Rad - d))) <= 20000001 * 20000001 * (20000 * 10000)).
    { apply product_size; [now apply product_size|]. apply product_size; rewrite Rabs_pos_eq; lra. }
    lra. }
  pose proof (separation_of_degree_4 181 a u p v t _ Ma Mu Mp Muv Mv Ht Hne2 HC C1 C2 C3) as H.
  apply (separation_of_quotient_4 F m psi (a + u + t) 15 181 40 E); [simpl; lra|exact H].
Qed.

Theorem bump_2p_is_separated : forall R w K x y z m, parameters R w K -> valid x y z = true -> is_tie m ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_2p (value32 R) (value32 w) X Z in
  let S := slope_2p (value32 R) (value32 w) in
  let Fx := side_x (value32 w) (value32 K) S X M in let Fz := side_z (value32 w) (value32 K) S X M in
  (Fx <> m -> bpow radix2 (-859) <= Rabs (Fx - m)) /\ (Fz <> m -> bpow radix2 (-859) <= Rabs (Fz - m)).
Proof.
  intros R w K x y z m Hp Hv Hm X Z M S Fx Fz. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  multiples_of_inputs Hp Cx Cz. pose proof (multiple_of_tie m Hm) as Mm.
  destruct Hp as (_ & HR & Hw & HK). pose proof (coordinate_range _ _ Cz) as BZ.
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  destruct (face_2p (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (HS & HcS & _ & EH & Ecos & Esin).
  unfold Fx, Fz, side_x, side_z, M, penetration_2p in *. rewrite EH. clear Fx Fz M.
  fold S in Ecos, Esin. rewrite Ecos, Esin. clear Ecos Esin EH. clearbody S. clear S.
  set (d := axis_depth (value32 R) (value32 w)) in *. clearbody d. set (Rad := value32 R) in *. set (k := value32 K) in *.
  set (c := value32 w / 2) in *. assert (Hwc : value32 w = 2 * c) by (unfold c; field).
  assert (Hc : / 2000 <= c <= Rad) by (unfold c; lra). rewrite Hwc in *. clearbody c Rad k.
  assert (plain : forall F i, multiple i (F - m) -> (i <= 150)%Z -> F <> m -> bpow radix2 (-859) <= Rabs (F - m)).
  { intros F i N Hi Hne. apply Rle_trans with (bpow radix2 (- i)); [apply bpow_le; lia|]. apply (multiple_not_0 _ _ N). lra. }
  assert (M0 : multiple 0 0) by apply (multiple_whole 0). assert (M1 : multiple 0 1) by apply (multiple_whole 1).
  case Rle_bool_spec; intro Hin.
  2: { split; apply (plain _ 150%Z); try lia; multiple. }
  assert (MabsX : multiple 53 (Rabs X)) by (unfold Rabs; destruct (Rcase_abs X); [now apply multiple_opp|exact MX]).
  pose proof (Rabs_pos X) as PX. set (h := c - Rabs X) in *. assert (Hh : 0 <= h <= 10000) by (unfold h; lra).
  assert (Mh : multiple 53 h) by (unfold h; multiple).
  set (q := sqrt ((Rad + d) / (2 * Rad))). set (psi := 2 * Rad * q).
  assert (Hq2 : q * q = (Rad + d) / (2 * Rad)).
  { apply sqrt_sqrt. apply Rlt_le, Rdiv_lt_0_compat; lra. }
  assert (Hq : 0 < q) by (apply sqrt_lt_R0, Rdiv_lt_0_compat; lra).
  assert (Hpsi0 : 0 < psi) by (unfold psi; apply Rmult_lt_0_compat; lra).
  assert (Hpsi2 : psi * psi = 2 * Rad * (Rad + d)).
  { unfold psi. replace (2 * Rad * q * (2 * Rad * q)) with (2 * Rad * (2 * Rad) * (q * q)) by ring. rewrite Hq2. field. lra. }
  assert (Hpsi : psi <= 20000).
  { apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite Hpsi2. apply Rmult_le_compat; lra. }
  assert (Eh : 1 - 2 * Rabs X / (2 * c) = h / c) by (unfold h; field; lra). rewrite Eh.
  assert (Hcd : (Rad - d) * (Rad + d) = c * c) by (replace ((Rad - d) * (Rad + d)) with (Rad * Rad - d * d) by ring; lra).
  set (A := c * h - Z * Rad).
  assert (Fz_is : k * (c / (Rad + d) * c * (h / c) - Z) * q = k * (A + - Z * d) / psi).
  { assert (Eq : q = (Rad + d) / psi).
    { apply Rmult_eq_reg_r with psi; [|lra]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. unfold psi.
      replace (q * (2 * Rad * q)) with (2 * Rad * (q * q)) by ring. rewrite Hq2. field. lra. }
    rewrite Eq. unfold A. field. lra. }
  assert (Fx_is : k * (c / (Rad + d) * c * (h / c) - Z) * (c / psi) = k * (Rad * h - Z * c + - h * d) / psi).
  { replace (Rad * h - Z * c + - h * d) with ((c / (Rad + d) * c * (h / c) - Z) * c); [field; lra|].
    replace (Rad * h - Z * c + - h * d) with ((Rad - d) * h - Z * c) by ring. apply Rmult_eq_reg_r with (Rad + d); [|lra].
    replace (((Rad - d) * h - Z * c) * (Rad + d)) with ((Rad - d) * (Rad + d) * h - Z * c * (Rad + d)) by ring. rewrite Hcd. field. lra. }
  fold q. fold psi. rewrite Fz_is.
  assert (BRh : Rabs (Rad * h) <= 10000 * 10000) by (apply product_size; rewrite Rabs_pos_eq; lra).
  assert (BZc : Rabs (Z * c) <= 10000 * 10000) by (apply product_size; [exact BZ|rewrite Rabs_pos_eq; lra]).
  assert (Bch : Rabs (c * h) <= 10000 * 10000) by (apply product_size; rewrite Rabs_pos_eq; lra).
  assert (BZR : Rabs (Z * Rad) <= 10000 * 10000) by (apply product_size; [exact BZ|rewrite Rabs_pos_eq; lra]).
  assert (Bh : Rabs (- h) <= 10000) by (rewrite Rabs_Ropp, Rabs_pos_eq; lra).
  assert (BA : Rabs A <= 200000000) by (unfold A; apply Rle_trans with (1 := minus_size _ _); lra).
  assert (Bx : Rabs (Rad * h - Z * c) <= 200000000) by (apply Rle_trans with (1 := minus_size _ _); lra).
  assert (MA : multiple 87 A) by (unfold A; multiple). assert (Mx : multiple 87 (Rad * h - Z * c)) by multiple.
  assert (BM : Rabs (c / (Rad + d) * c * (h / c) - Z) <= 20000).
  { apply Rle_trans with (1 := minus_size _ _). assert (Rabs (c / (Rad + d) * c * (h / c)) <= 1 * 10000); [|lra].
    replace (c / (Rad + d) * c * (h / c)) with (c / (Rad + d) * h) by (field; lra). apply product_size; [|rewrite Rabs_pos_eq; lra].
    apply quotient_size; rewrite (Rabs_pos_eq (Rad + d)) by lra; [lra|]. rewrite Rabs_pos_eq; lra. }
  assert (Bk : Rabs k <= 1000) by (rewrite Rabs_pos_eq; lra).
  assert (Bq : Rabs q <= 1).
  { rewrite Rabs_pos_eq by lra. apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite Hq2. apply Rmult_le_reg_r with (2 * Rad); [lra|].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  assert (Bs : Rabs (c / psi) <= 1).
  { apply quotient_size; rewrite (Rabs_pos_eq psi), ?(Rabs_pos_eq c) by lra; [lra|]. apply Rsqr_incr_0_var; [|lra]. unfold Rsqr.
    rewrite Rmult_1_l, Hpsi2. apply Rmult_le_compat; lra. }
  assert (component : forall A B, multiple 87 A -> multiple 53 B -> Rabs A <= 200000000 -> Rabs B <= 10000 ->
    Rabs (k * (A + B * d) / psi) <= 20000000 -> k * (A + B * d) / psi <> m -> bpow radix2 (-859) <= Rabs (k * (A + B * d) / psi - m)).
  { intros A' B' MA' MB' BA' BB' BF Hne.
    apply (small_middles_suffice 20000000 _ m); [exact BF|change 1 with (bpow radix2 0); apply bpow_le; lia| |exact Hne]. intros Bm _.
    apply (side_component_is_separated k Rad c d psi A' B' m); try assumption; lra. }
  assert (B20 : 20000000 = 1000 * 20000 * 1) by ring.
  assert (right : Rabs (k * (Rad * h - Z * c + - h * d) / psi) <= 20000000).
  { rewrite <- Fx_is, B20. now repeat apply product_size. }
  assert (Mmh : multiple 53 (- h)) by now apply multiple_opp. assert (MmZ : multiple 53 (- Z)) by now apply multiple_opp.
  split.
  - destruct (Rlt_bool X 0).
    + replace (k * (c / (Rad + d) * c * (h / c) - Z) * - (c / psi)) with (k * (- (Rad * h - Z * c) + h * d) / psi).
      * apply component; try assumption; [now apply multiple_opp|now rewrite Rabs_Ropp|rewrite <- (Rabs_Ropp h); exact Bh|].
        replace (k * (- (Rad * h - Z * c) + h * d) / psi) with (- (k * (Rad * h - Z * c + - h * d) / psi)) by (field; lra).
        now rewrite Rabs_Ropp.
      * replace (k * (c / (Rad + d) * c * (h / c) - Z) * - (c / psi)) with (- (k * (c / (Rad + d) * c * (h / c) - Z) * (c / psi))) by ring.
        rewrite Fx_is. field. lra.
    + rewrite Fx_is. now apply component.
  - apply component; try assumption; [now rewrite Rabs_Ropp|]. rewrite <- Fz_is, B20. now repeat apply product_size.
Qed.
