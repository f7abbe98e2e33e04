(* SPDX-License-Identifier: BSD-3-Clause *)
(* The separation of bump-3p-shaded: docs/proofs.md, "The last stage". *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Shaded Polygons ThreePolygons.
From Forceshade Require Import DoubleDoubleTerms Separation SeparationOfCylinder SeparationOfCubic SeparationOfBump3p.
Open Scope R_scope.

(* (F - m) D = G + (A + B eta) s, with polynomials G, A and B of omega. *)
Lemma shaded_component_is_separated : forall Rad w om eta r2 r3 s S G A B F m D, multiple 27 Rad -> multiple 33 w ->
  three Rad w om eta r2 r3 -> multiple 106 S -> s * s = S -> S <= Rad * Rad -> let p := 3 * (Rad * Rad) in let q := - (w * (Rad * Rad)) in
  integral p q 235 G -> integral p q 182 A -> integral p q 153 B -> 0 < Rad <= 10000 ->
  (forall r y t, Rabs r <= 20000 -> Rabs (r * y) <= 200000000 -> Rabs (2 * (Rad * Rad) - r * r) <= 200000000 -> Rabs t <= 10000 ->
    Rabs (G r + (A r + B r * y) * t) <= 140000000000000000000) ->
  G om + (A om + B om * eta) * s = (F - m) * D -> 0 < D <= 2000000000000 -> F <> m -> bpow radix2 (-3598) <= Rabs (F - m).
Proof.
  intros Rad w om eta r2 r3 s S G A B F m D MR Mw H MS Hs HS p q HG HA HB HR Size E HD Hne.
  apply (separation_of_quotient F m D (G om + (A om + B om * eta) * s) 41 3598 E); [simpl; lra|].
  apply (separation_of_degree_12 (2 * Rad) p q om r2 r3 eta s S 235 67 G A B); try assumption.
  - now apply (cubic_of_three Rad w om eta r2 r3).
  - lia.
  - intros r y t Hr Ht. destruct (sizes_of_conjugates Rad r y HR Hr) as (B1 & B2 & B3).
    assert (Bt : Rabs t <= 10000).
    { apply Rle_trans with Rad; [|lra]. rewrite <- (Rabs_pos_eq Rad) by lra. apply Rsqr_le_abs_0. unfold Rsqr. lra. }
    apply Rle_trans with (1 := Size r y t B1 B2 B3 Bt). simpl. lra.
  - now destruct H.
  - rewrite E. apply Rmult_integral_contrapositive_currified; lra.
Qed.

(* The law on the top and on a side, where s is x or sqrt(R^2 - x^2). *)
Lemma shaded_components_are_separated : forall Rad w om eta r2 r3 s K Z h m, multiple 27 Rad -> multiple 33 w ->
  three Rad w om eta r2 r3 -> multiple 106 (s * s) -> s * s <= Rad * Rad -> multiple 33 K -> multiple 53 Z -> multiple 53 h ->
  multiple 150 m -> / 10 <= Rad <= 10000 -> 0 <= K <= 1000 -> Rabs Z <= 10000 -> Rabs h <= 10000 -> Rabs m <= 30000001 ->
  let top := K * (top_height Rad w - Z) * (s / Rad) in let side := K * (slope_3p Rad w * h - Z) * (s / Rad) in
  (top <> m -> bpow radix2 (-3598) <= Rabs (top - m)) /\ (side <> m -> bpow radix2 (-3598) <= Rabs (side - m)).
Proof.
  intros Rad w om eta r2 r3 s K Z h m MR Mw H MS HS MK MZ Mh Mm HR HK HZ Hh Hm top side. unfold top, side. clear top side.
  pose proof (shaded_component_is_separated Rad w om eta r2 r3 s (s * s)) as component.
  pose proof H as [_ _ Heta Hom -> -> _ _]. specialize (fun G A B F m D => component G A B F m D MR Mw H MS eq_refl HS).
  assert (Mp : multiple 58 (3 * (Rad * Rad))) by multiple. assert (Mq : multiple 87 (- (w * (Rad * Rad)))) by multiple.
  assert (PR : 0 < Rad * Rad) by (apply Rmult_lt_0_compat; lra).
  assert (HRR : Rad * Rad <= 100000000) by (apply Rle_trans with (10000 * 10000); [apply Rmult_le_compat; lra|lra]).
  assert (Ho : 0 < om * om <= Rad * Rad) by (split; [apply Rmult_lt_0_compat|apply Rmult_le_compat]; lra).
  assert (BK : Rabs K <= 1000) by (rewrite Rabs_pos_eq; lra). assert (BR : Rabs Rad <= 10000) by (rewrite Rabs_pos_eq; lra).
  assert (BRR : Rabs (2 * (Rad * Rad)) <= 200000000) by (rewrite Rabs_pos_eq; lra).
  split; intro Hne.
  - apply (component (fun _ => - (2 * (Rad * Rad) * Rad * m)) (fun _ => - (2 * (Rad * Rad) * (K * Z))) (fun r => K * r * r) _ m
      (Rad * (2 * (Rad * Rad)))); try assumption; try lra.
    + integral.
    + integral.
    + integral.
    + intros r y t Br Bry _ Bt. replace (- (2 * (Rad * Rad) * Rad * m) + (- (2 * (Rad * Rad) * (K * Z)) + K * r * r * y) * t) with
        ((K * r * (r * y) - 2 * (Rad * Rad) * (K * Z)) * t - 2 * (Rad * Rad) * Rad * m) by ring. sizes.
    + field. lra.
    + split; [apply Rmult_lt_0_compat; lra|]. apply Rle_trans with (10000 * 200000000); [apply Rmult_le_compat; lra|lra].
  - apply (component (fun r => - (m * Rad * (2 * (Rad * Rad) - r * r))) (fun r => - (K * Z * (2 * (Rad * Rad) - r * r)))
      (fun r => K * h * r) _ m (Rad * (2 * (Rad * Rad) - om * om))); try assumption; try lra.
    + integral.
    + integral.
    + integral.
    + intros r y t _ Bry Bd Bt.
      replace (- (m * Rad * (2 * (Rad * Rad) - r * r)) + (- (K * Z * (2 * (Rad * Rad) - r * r)) + K * h * r * y) * t) with
        ((K * h * (r * y) - K * Z * (2 * (Rad * Rad) - r * r)) * t - m * Rad * (2 * (Rad * Rad) - r * r)) by ring. sizes.
    + field. lra.
    + split; [apply Rmult_lt_0_compat; lra|]. apply Rle_trans with (10000 * 200000000); [apply Rmult_le_compat; lra|lra].
Qed.

Theorem bump_3p_shaded_is_separated : forall R w K x y z m, parameters R w K -> valid x y z = true -> is_tie m ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_3p (value32 R) (value32 w) X Z in
  let Fx := shaded_x (value32 R) (value32 w) (value32 K) X M in let Fz := shaded_z (value32 R) (value32 w) (value32 K) X M in
  (Fx <> m -> bpow radix2 (-3598) <= Rabs (Fx - m)) /\ (Fz <> m -> bpow radix2 (-3598) <= Rabs (Fz - m)).
Proof.
  intros R w K x y z m Hp Hv Hm X Z M Fx Fz. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  multiples_of_inputs Hp Cx Cz. pose proof (multiple_of_width _ _ _ Hp) as Mw. pose proof (multiple_of_tie m Hm) as Mm.
  destruct Hp as (_ & HR & Hw & HK). pose proof (coordinate_range _ _ Cz) as BZ.
  destruct (three_are (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (eta & r2 & r3 & Three).
  unfold Fx, Fz, shaded_x, shaded_z, M, penetration_3p. clear Fx Fz M.
  set (om := top_width (value32 R) (value32 w)) in *. set (Rad := value32 R) in *. set (k := value32 K) in *. set (W := value32 w) in *.
  clearbody Rad k W.
  case (Rle_bool_spec (Rabs X) (W / 2)); intro Hin.
  2: { assert (plain : forall F, multiple 150 (F - m) -> F <> m -> bpow radix2 (-3598) <= Rabs (F - m)).
    { intros F N Hne. apply Rle_trans with (bpow radix2 (- (150))); [apply bpow_le; lia|]. apply (multiple_not_0 _ _ N). lra. }
    assert (M0 : multiple 0 0) by apply (multiple_whole 0). assert (M1 : multiple 0 1) by apply (multiple_whole 1).
    split; apply plain; multiple. }
  assert (MabsX : multiple 53 (Rabs X)) by (unfold Rabs; destruct (Rcase_abs X); [now apply multiple_opp|exact MX]).
  pose proof (Rabs_pos X) as PX. set (h := W / 2 - Rabs X). assert (Hh : Rabs h <= 10000) by (unfold h; rewrite Rabs_pos_eq; lra).
  assert (Mh : multiple 53 h) by (unfold h; multiple).
  destruct (three_penetrations_size Rad W om eta r2 r3 h Z Three ltac:(lra) Hh BZ) as [Btop Bside].
  replace (top_height Rad W * h / (W / 2 - om / 2)) with (slope_3p Rad W * h) by (unfold slope_3p; fold om; unfold Rdiv; ring).
  set (M := (if Rle_bool (Rabs X) (om / 2) then top_height Rad W else slope_3p Rad W * h) - Z).
  assert (BM : Rabs M <= 30000) by (unfold M; destruct (Rle_bool (Rabs X) (om / 2)); assumption).
  assert (HX : X * X <= Rad * Rad).
  { apply (Rsqr_le_abs_1 X Rad). rewrite (Rabs_pos_eq Rad) by lra. lra. }
  assert (component : forall s, multiple 106 (s * s) -> s * s <= Rad * Rad -> k * M * (s / Rad) <> m ->
    bpow radix2 (-3598) <= Rabs (k * M * (s / Rad) - m)).
  { intros s Ms Hs. assert (BF : Rabs (k * M * (s / Rad)) <= 30000000).
    { replace 30000000 with (1000 * 30000 * 1) by ring. apply product_size.
      - apply product_size; [rewrite Rabs_pos_eq; lra|exact BM].
      - apply quotient_size; rewrite (Rabs_pos_eq Rad) by lra; [lra|]. rewrite Rmult_1_l, <- (Rabs_pos_eq Rad) by lra.
        now apply Rsqr_le_abs_0. }
    apply (small_middles_suffice 30000000 _ m _ BF); [change 1 with (bpow radix2 0); apply bpow_le; lia|]. intro Bm.
    destruct (shaded_components_are_separated Rad W om eta r2 r3 s k Z h m) as [T S]; try assumption; try lra.
    unfold M. destruct (Rle_bool (Rabs X) (om / 2)); assumption. }
  split; apply component; try assumption; [multiple| |]; rewrite sqrt_sqrt by (unfold Rsqr; lra); unfold Rsqr; [multiple|].
  pose proof (Rle_0_sqr X) as P. unfold Rsqr in P. lra.
Qed.
