(* SPDX-License-Identifier: BSD-3-Clause *)
(* The separation of bump-3p: docs/proofs.md, "The last stage". *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Polygons ThreePolygons ThreePolygonsFace.
From Forceshade Require Import DoubleDoubleTerms Separation SeparationOfCylinder SeparationOfCubic.
Open Scope R_scope.

(* ---- omega = w', eta, and the other two roots of omega's cubic ---- *)

Record three (Rad w om eta r2 r3 : R) : Prop := {
  three_cubic : om + r2 + r3 = 0 /\ om * r2 + om * r3 + r2 * r3 = - (3 * (Rad * Rad)) /\ om * r2 * r3 = - (w * (Rad * Rad));
  three_sizes : Rabs om <= 2 * Rad /\ Rabs r2 <= 2 * Rad /\ Rabs r3 <= 2 * Rad;
  three_eta : om * om + eta * eta = 2 * Rad * (2 * Rad);
  three_omega : 0 < om <= Rad;
  three_height : top_height Rad w = om * om * eta / (2 * (Rad * Rad));
  three_slope : slope_3p Rad w = om * eta / (2 * (Rad * Rad) - om * om);
  three_sine : sine_of (slope_3p Rad w) = om * eta / (2 * (Rad * Rad));
  three_cosine : cosine_of (slope_3p Rad w) = (2 * (Rad * Rad) - om * om) / (2 * (Rad * Rad))
}.

Lemma three_are : forall Rad w, 0 < Rad -> 0 < w <= 2 * Rad -> exists eta r2 r3, three Rad w (top_width Rad w) eta r2 r3.
Proof.
  intros Rad w HR Hw. destruct (third_sine_is Rad w HR Hw) as ((Ht1 & Ht2) & Hcubic & Htop & Hheight & Hslope & Hsine & Hcosine).
  set (t := third_sine Rad w) in *. clearbody t.
  assert (Ht : 0 < t) by (apply Rlt_le_trans with (2 := Ht1); apply Rdiv_lt_0_compat; lra).
  set (om := top_width Rad w) in *. assert (Eom : om = 2 * (Rad * t)) by lra. clearbody om.
  set (n := sqrt ((1 - t) * (1 + t))) in *. assert (Hn : n * n = (1 - t) * (1 + t)) by (apply sqrt_sqrt, Rmult_le_pos; lra).
  unfold side_sine, side_cosine in *. fold n in Hheight, Hslope, Hsine. clearbody n.
  set (s := sqrt 3). assert (Hs : s * s = 3) by (apply sqrt_sqrt; lra). clearbody s.
  set (eta := 2 * (Rad * n)). assert (Eeta : om * om + eta * eta = 2 * Rad * (2 * Rad)).
  { rewrite Eom. unfold eta. replace (2 * (Rad * t) * (2 * (Rad * t)) + 2 * (Rad * n) * (2 * (Rad * n))) with
      (4 * (Rad * Rad) * (t * t + n * n)) by ring. rewrite Hn. ring. }
  assert (Hom : 0 < om <= Rad).
  { rewrite Eom. assert (0 < Rad * t) by now apply Rmult_lt_0_compat.
    assert (Rad * t <= Rad * / 2) by (apply Rmult_le_compat_l; lra). lra. }
  assert (size : forall a b, a * a + b * b = 2 * Rad * (2 * Rad) -> Rabs a <= 2 * Rad).
  { intros a b H. rewrite <- (Rabs_pos_eq (2 * Rad)) by lra. apply Rsqr_le_abs_0. pose proof (Rle_0_sqr b). unfold Rsqr in *. lra. }
  assert (Hw2 : w = 2 * Rad * (3 * t - 4 * (t * t * t))).
  { replace (3 * t - 4 * (t * t * t)) with (w / (2 * Rad)) by lra. field. lra. }
  exists eta, ((- om + s * eta) / 2), ((- om - s * eta) / 2). split.
  - split; [field|]. split.
    + replace (om * ((- om + s * eta) / 2) + om * ((- om - s * eta) / 2) + (- om + s * eta) / 2 * ((- om - s * eta) / 2)) with
        (- (3 * (om * om) + s * s * (eta * eta)) / 4) by field. rewrite Hs. lra.
    + replace (om * ((- om + s * eta) / 2) * ((- om - s * eta) / 2)) with (om * (om * om - s * s * (eta * eta)) / 4) by field.
      rewrite Hs. replace (eta * eta) with (2 * Rad * (2 * Rad) - om * om) by lra. rewrite Hw2, Eom. field.
  - split; [now apply size with eta|]. split; [apply size with ((s * om + eta) / 2)|apply size with ((s * om - eta) / 2)]; rewrite <- Eeta.
    + replace ((- om + s * eta) / 2 * ((- om + s * eta) / 2) + (s * om + eta) / 2 * ((s * om + eta) / 2)) with
        ((1 + s * s) / 4 * (om * om + eta * eta)) by field. rewrite Hs. field.
    + replace ((- om - s * eta) / 2 * ((- om - s * eta) / 2) + (s * om - eta) / 2 * ((s * om - eta) / 2)) with
        ((1 + s * s) / 4 * (om * om + eta * eta)) by field. rewrite Hs. field.
  - exact Eeta.
  - exact Hom.
  - rewrite Hheight, Eom. unfold eta. field. lra.
  - assert (HR2 : 0 < Rad * Rad) by now apply Rmult_lt_0_compat.
    assert (Htt : t * t <= / 2 * / 2) by (apply Rmult_le_compat; lra).
    rewrite Hslope, Eom. unfold eta. field. split; [|lra].
    replace (2 * (Rad * Rad) - 2 * (Rad * t) * (2 * (Rad * t))) with (2 * (Rad * Rad) * (1 - 2 * (t * t))) by ring.
    apply Rmult_integral_contrapositive_currified; lra.
  - rewrite Hsine, Eom. unfold eta. field. lra.
  - rewrite Hcosine, Eom. field. lra.
Qed.

Lemma cubic_of_three : forall Rad w om eta r2 r3, multiple 27 Rad -> multiple 33 w -> three Rad w om eta r2 r3 ->
  cubic (2 * Rad) (3 * (Rad * Rad)) (- (w * (Rad * Rad))) om r2 r3.
Proof. intros Rad w om eta r2 r3 MR Mw [(S1 & S2 & S3) B _ _ _ _ _ _]. split; try assumption; multiple. Qed.

Lemma multiple_of_width : forall R w K, parameters R w K -> multiple 33 (value32 w).
Proof.
  intros R w K H. pose proof (multiple_of_half_width R w K H) as [n Hn]. exists n.
  replace (value32 w) with (2 * (value32 w / 2)) by field. rewrite Hn. change (- (33))%Z with (1 + - (34))%Z. rewrite bpow_plus.
  change (bpow radix2 1) with 2. ring.
Qed.

(* Sizes where r and y are omega and eta, or conjugates of these. *)
Lemma sizes_of_conjugates : forall Rad r y, 0 < Rad <= 10000 -> r * r + y * y = 2 * Rad * (2 * Rad) ->
  Rabs r <= 20000 /\ Rabs (r * y) <= 200000000 /\ Rabs (2 * (Rad * Rad) - r * r) <= 200000000.
Proof.
  intros Rad r y HR H. assert (HRR : Rad * Rad <= 10000 * 10000) by (apply Rmult_le_compat; lra).
  assert (PR : 0 < Rad * Rad) by (apply Rmult_lt_0_compat; lra).
  pose proof (Rle_0_sqr r) as Pr. pose proof (Rle_0_sqr y) as Py.
  pose proof (Rle_0_sqr (r - y)) as P1. pose proof (Rle_0_sqr (r + y)) as P2.
  unfold Rsqr in *. split; [|split; apply Rabs_le; lra].
  rewrite <- (Rabs_pos_eq 20000) by lra. apply Rsqr_le_abs_0. unfold Rsqr. lra.
Qed.

Lemma difference_size : forall a b A B, Rabs a <= A -> Rabs b <= B -> Rabs (a - b) <= A + B.
Proof. intros a b A B Ha Hb. apply Rle_trans with (1 := minus_size _ _). lra. Qed.

(* The size of an expression follows from those of its parts, which are hypotheses. *)
Ltac size_of_parts :=
  first [eassumption|eapply product_size; size_of_parts|eapply difference_size; size_of_parts|eapply sum_size; size_of_parts].
Ltac sizes := eapply Rle_trans; [size_of_parts|lra].

(* ---- Components ---- *)

(* (F - m) D = A + B eta, with polynomials A and B of omega. *)
Lemma three_component_is_separated : forall Rad w om eta r2 r3 A B F m D, multiple 27 Rad -> multiple 33 w ->
  three Rad w om eta r2 r3 -> let p := 3 * (Rad * Rad) in let q := - (w * (Rad * Rad)) in
  integral p q 262 A -> integral p q 233 B -> 0 < Rad <= 10000 ->
  (forall r y, Rabs r <= 20000 -> Rabs (r * y) <= 200000000 -> Rabs (2 * (Rad * Rad) - r * r) <= 200000000 ->
    r * r + y * y = 2 * Rad * (2 * Rad) -> Rabs (A r + B r * y) <= 2400000000000000000000000) ->
  A om + B om * eta = (F - m) * D -> 0 < D <= 40000000000000000 -> F <> m -> bpow radix2 (-2033) <= Rabs (F - m).
Proof.
  intros Rad w om eta r2 r3 A B F m D MR Mw H p q HA HB HR Size E HD Hne.
  apply (separation_of_quotient F m D (A om + B om * eta) 56 2033 E); [simpl; lra|].
  apply (separation_of_degree_6 (2 * Rad) p q om r2 r3 eta 262 81 A B); try assumption.
  - now apply (cubic_of_three Rad w om eta r2 r3).
  - lia.
  - intros r y Hr. destruct (sizes_of_conjugates Rad r y HR Hr) as (B1 & B2 & B3).
    apply Rle_trans with (1 := Size r y B1 B2 B3 Hr). simpl. lra.
  - now destruct H.
  - rewrite E. apply Rmult_integral_contrapositive_currified; lra.
Qed.

(* The law on the top, and on a side along z and along x. *)
Lemma three_components_are_separated : forall Rad w om eta r2 r3 K Z h m, multiple 27 Rad -> multiple 33 w ->
  three Rad w om eta r2 r3 -> multiple 33 K -> multiple 53 Z -> multiple 53 h -> multiple 150 m -> 0 < Rad <= 10000 ->
  0 <= K <= 1000 -> Rabs Z <= 10000 -> Rabs h <= 10000 -> Rabs m <= 30000001 -> let side := slope_3p Rad w * h - Z in
  (K * (top_height Rad w - Z) <> m -> bpow radix2 (-2033) <= Rabs (K * (top_height Rad w - Z) - m)) /\
  (K * side * cosine_of (slope_3p Rad w) <> m -> bpow radix2 (-2033) <= Rabs (K * side * cosine_of (slope_3p Rad w) - m)) /\
  (K * side * sine_of (slope_3p Rad w) <> m -> bpow radix2 (-2033) <= Rabs (K * side * sine_of (slope_3p Rad w) - m)).
Proof.
  intros Rad w om eta r2 r3 K Z h m MR Mw H MK MZ Mh Mm HR HK HZ Hh Hm side. unfold side. clear side.
  pose proof (three_component_is_separated Rad w om eta r2 r3) as component.
  pose proof H as [_ _ Heta Hom -> -> -> ->]. specialize (fun A B F m D => component A B F m D MR Mw H).
  assert (Mp : multiple 58 (3 * (Rad * Rad))) by multiple. assert (Mq : multiple 87 (- (w * (Rad * Rad)))) by multiple.
  assert (PR : 0 < Rad * Rad) by (apply Rmult_lt_0_compat; lra).
  assert (HRR : Rad * Rad <= 100000000) by (apply Rle_trans with (10000 * 10000); [apply Rmult_le_compat; lra|lra]).
  assert (Ho : 0 < om * om <= Rad * Rad) by (split; [apply Rmult_lt_0_compat|apply Rmult_le_compat]; lra).
  assert (BK : Rabs K <= 1000) by (rewrite Rabs_pos_eq; lra).
  assert (BRR : Rabs (2 * (Rad * Rad)) <= 200000000) by (rewrite Rabs_pos_eq; lra).
  split; [|split]; intro Hne.
  - apply (component (fun r => - (2 * (Rad * Rad) * (K * Z + m))) (fun r => K * r * r) _ m (2 * (Rad * Rad))); try assumption; try lra.
    + integral.
    + integral.
    + intros r y Br Bry _ _. replace (- (2 * (Rad * Rad) * (K * Z + m)) + K * r * r * y) with
        (K * r * (r * y) - 2 * (Rad * Rad) * (K * Z + m)) by ring.
      sizes.
    + field. lra.
  - apply (component (fun r => - (K * Z * (2 * (Rad * Rad) - r * r)) - 2 * (m * (Rad * Rad))) (fun r => K * h * r) _ m
      (2 * (Rad * Rad))); try assumption; try lra.
    + integral.
    + integral.
    + intros r y _ Bry Bd _. replace (- (K * Z * (2 * (Rad * Rad) - r * r)) - 2 * (m * (Rad * Rad)) + K * h * r * y) with
        (K * h * (r * y) - K * Z * (2 * (Rad * Rad) - r * r) - 2 * (Rad * Rad) * m) by ring.
      sizes.
    + field. lra.
  - apply (component (fun r => K * h * (r * r) * (2 * Rad * (2 * Rad) - r * r) - 2 * (m * (Rad * Rad)) * (2 * (Rad * Rad) - r * r))
      (fun r => - (K * Z * r * (2 * (Rad * Rad) - r * r))) _ m (2 * (Rad * Rad) * (2 * (Rad * Rad) - om * om))); try assumption.
    + integral.
    + integral.
    + intros r y _ Bry Bd E. replace (2 * Rad * (2 * Rad) - r * r) with (y * y) by lra.
      replace (K * h * (r * r) * (y * y) - 2 * (m * (Rad * Rad)) * (2 * (Rad * Rad) - r * r) +
        - (K * Z * r * (2 * (Rad * Rad) - r * r)) * y) with
        (K * h * (r * y * (r * y)) - K * Z * (r * y * (2 * (Rad * Rad) - r * r)) - 2 * (Rad * Rad) * m * (2 * (Rad * Rad) - r * r))
        by ring.
      sizes.
    + replace (2 * Rad * (2 * Rad) - om * om) with (eta * eta) by lra. field. lra.
    + split; [apply Rmult_lt_0_compat; lra|]. apply Rle_trans with (200000000 * 200000000); [apply Rmult_le_compat; lra|lra].
Qed.

(* Neither penetration exceeds three times the largest radius. *)
Lemma three_penetrations_size : forall Rad w om eta r2 r3 h Z, three Rad w om eta r2 r3 -> 0 < Rad <= 10000 -> Rabs h <= 10000 ->
  Rabs Z <= 10000 -> Rabs (top_height Rad w - Z) <= 30000 /\ Rabs (slope_3p Rad w * h - Z) <= 30000.
Proof.
  intros Rad w om eta r2 r3 h Z [_ _ Heta Hom Hheight -> _ _] HR Hh HZ. rewrite Hheight.
  assert (PR : 0 < Rad * Rad) by (apply Rmult_lt_0_compat; lra).
  assert (Ho : 0 < om * om <= Rad * Rad) by (split; [apply Rmult_lt_0_compat|apply Rmult_le_compat]; lra).
  pose proof (Rle_0_sqr (om - eta)) as P1. pose proof (Rle_0_sqr (om + eta)) as P2. unfold Rsqr in *.
  assert (Boe : Rabs (om * eta) <= 2 * (Rad * Rad)) by (apply Rabs_le; lra).
  split; apply Rle_trans with (1 := minus_size _ _).
  - assert (Rabs (om * om * eta / (2 * (Rad * Rad))) <= 10000 * 1); [|lra].
    replace (om * om * eta / (2 * (Rad * Rad))) with (om * (om * eta / (2 * (Rad * Rad)))) by (field; lra).
    apply product_size; [rewrite Rabs_pos_eq; lra|]. apply quotient_size; rewrite (Rabs_pos_eq (2 * (Rad * Rad))); lra.
  - assert (Rabs (om * eta / (2 * (Rad * Rad) - om * om) * h) <= 2 * 10000); [|lra].
    apply product_size; [|exact Hh]. apply quotient_size; rewrite (Rabs_pos_eq (2 * (Rad * Rad) - om * om)); lra.
Qed.

Theorem bump_3p_is_separated : forall R w K x y z m, parameters R w K -> valid x y z = true -> is_tie m ->
  let X := read (value32 x) in let Z := read (value32 z) in let M := penetration_3p (value32 R) (value32 w) X Z in
  let S := slope_at (value32 R) (value32 w) X in
  let Fx := side_x (value32 w) (value32 K) S X M in let Fz := side_z (value32 w) (value32 K) S X M in
  (Fx <> m -> bpow radix2 (-2033) <= Rabs (Fx - m)) /\ (Fz <> m -> bpow radix2 (-2033) <= Rabs (Fz - m)).
Proof.
  intros R w K x y z m Hp Hv Hm X Z M S Fx Fz. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  multiples_of_inputs Hp Cx Cz. pose proof (multiple_of_width _ _ _ Hp) as Mw. pose proof (multiple_of_tie m Hm) as Mm.
  destruct Hp as (_ & HR & Hw & HK). pose proof (coordinate_range _ _ Cz) as BZ.
  destruct (three_are (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (eta & r2 & r3 & Three).
  unfold Fx, Fz, side_x, side_z, M, S, penetration_3p, slope_at. clear Fx Fz M S.
  set (om := top_width (value32 R) (value32 w)) in *. set (Rad := value32 R) in *. set (k := value32 K) in *. set (W := value32 w) in *.
  clearbody Rad k W.
  assert (plain : forall F i, multiple i (F - m) -> (i <= 150)%Z -> F <> m -> bpow radix2 (-2033) <= Rabs (F - m)).
  { intros F i N Hi Hne. apply Rle_trans with (bpow radix2 (- i)); [apply bpow_le; lia|]. apply (multiple_not_0 _ _ N). lra. }
  assert (M0 : multiple 0 0) by apply (multiple_whole 0). assert (M1 : multiple 0 1) by apply (multiple_whole 1).
  case (Rle_bool_spec (Rabs X) (W / 2)); intro Hin.
  2: { split; apply (plain _ 150%Z); try lia; multiple. }
  assert (MabsX : multiple 53 (Rabs X)) by (unfold Rabs; destruct (Rcase_abs X); [now apply multiple_opp|exact MX]).
  pose proof (Rabs_pos X) as PX. set (h := W / 2 - Rabs X) in *. assert (Hh : Rabs h <= 10000) by (unfold h; rewrite Rabs_pos_eq; lra).
  assert (Mh : multiple 53 h) by (unfold h; multiple).
  destruct (three_penetrations_size Rad W om eta r2 r3 h Z Three ltac:(lra) Hh BZ) as [Btop Bside].
  assert (Bk : Rabs k <= 1000) by (rewrite Rabs_pos_eq; lra).
  assert (near : forall F n, Rabs F <= 30000000 -> (Rabs n <= 30000001 -> F <> n -> bpow radix2 (-2033) <= Rabs (F - n)) -> F <> n ->
    bpow radix2 (-2033) <= Rabs (F - n)).
  { intros F n BF H. apply (small_middles_suffice 30000000 F n); [exact BF|change 1 with (bpow radix2 0); apply bpow_le; lia|].
    intro Bn. apply H. lra. }
  pose proof (three_components_are_separated Rad W om eta r2 r3 k Z h) as separated.
  specialize (fun n Mn => separated n MR Mw Three MK MZ Mh Mn ltac:(lra) ltac:(lra) BZ Hh). cbv zeta in separated.
  case (Rle_bool_spec (Rabs X) (om / 2)); intro Htop.
  - destruct flat as [E0 E1]. rewrite E0, E1, Rmult_1_r. split.
    + apply (plain _ 150%Z); [|lia]. replace (k * (top_height Rad W - Z) * (if Rlt_bool X 0 then - 0 else 0) - m) with (- m)
        by (destruct (Rlt_bool X 0); ring). multiple.
    + apply near; [|intro Bn; now apply separated]. replace 30000000 with (1000 * 30000) by ring. now apply product_size.
  - replace (top_height Rad W * h / (W / 2 - om / 2)) with (slope_3p Rad W * h) by (unfold slope_3p; fold om; unfold Rdiv; ring).
    set (side := slope_3p Rad W * h - Z) in *.
    assert (Bsine : Rabs (sine_of (slope_3p Rad W)) <= 1 /\ Rabs (cosine_of (slope_3p Rad W)) <= 1).
    { destruct Three as [_ _ Heta Hom _ _ -> ->]. assert (PR : 0 < Rad * Rad) by (apply Rmult_lt_0_compat; lra).
      pose proof (Rle_0_sqr (om - eta)) as P1. pose proof (Rle_0_sqr (om + eta)) as P2. pose proof (Rle_0_sqr om) as P3.
      pose proof (Rle_0_sqr eta) as P4. unfold Rsqr in *.
      split; apply quotient_size; rewrite (Rabs_pos_eq (2 * (Rad * Rad))) by lra; try lra; apply Rabs_le; lra. }
    destruct Bsine as [Bs Bc]. assert (B30 : 30000000 = 1000 * 30000 * 1) by ring.
    split; [|apply near; [rewrite B30; apply product_size; [now apply product_size|exact Bc]|intro Bn; now apply separated]].
    assert (right : forall n, multiple 150 n -> k * side * sine_of (slope_3p Rad W) <> n ->
      bpow radix2 (-2033) <= Rabs (k * side * sine_of (slope_3p Rad W) - n)).
    { intros n Mn. apply near; [rewrite B30; apply product_size; [now apply product_size|exact Bs]|intro Bn; now apply separated]. }
    destruct (Rlt_bool X 0); [|now apply right]. intro Hne.
    replace (k * side * - sine_of (slope_3p Rad W) - m) with (- (k * side * sine_of (slope_3p Rad W) - - m)) by ring. rewrite Rabs_Ropp.
    apply right; [now apply multiple_opp|]. intro E. apply Hne. rewrite Ropp_mult_distr_r_reverse, E. ring.
Qed.
