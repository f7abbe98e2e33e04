(* SPDX-License-Identifier: BSD-3-Clause *)
(* The scale K t of a batch, after the step: 2492 units off at most inside of the cylinder, and 0 outside. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Relative BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Gap DoubleDouble ErrorFree.
From Forceshade Require Import SecondAlong CylinderFirst CylinderConstants.
From Forceshade Require Import Lanes LaneAnswers BumpLanes CylinderLaneRough CylinderLaneRoughForm CylinderLaneStep.
Import ListNotations.
Open Scope R_scope.

Notation slope_form K R := (over (times (two_to (-1)) (to64 K)) (times (to64 R) (to64 R))) (only parsing).
Notation scale_form K R v t :=
  (fused (fused (opp (times t (minus (times (to64 R) (to64 R)) v))) (plus t (two_to 1)) v) (fused t (slope_form K R) (slope_form K R))
     (times t (to64 K))) (only parsing).

Lemma scale_form_is : forall R w K v vv V P rho t32 t, parameters R w K -> let Q := value32 R * value32 R in
  is64 v vv -> Rabs (vv - V) <= 128 * unit53 * Rabs V -> (0 < V -> Rabs (vv - V) <= 4 * unit53 * Rabs V) -> / 16777300 * Q < Rabs vv ->
  P = Q - V -> 0 < rho -> rho * rho = P -> P <= 510000000 -> let r := value32 R / rho in r <= 25002 / 10000 ->
  is32 t32 t -> Rabs (t - (r - 1)) <= rough * Rabs (r - 1) ->
  let T := r - 1 in let S := larger (scale_form K R v (to64 t32)) zero64 in
  (0 < V -> 0 < T /\ exists s, is64 S s /\ Rabs (s - value32 K * T) <= 2492 * unit53 * (value32 K * T)) /\ (V < 0 -> S = zero64).
Proof.
  intros R w K v vv V P rho t32 t ((FR & _ & FK) & HR & _ & HK) Q Iv Ev Ev4 Lv EP Hrho Erho UP r Hr2 It32 Et T S.
  pose proof (to64_is_exact R FR) as IR. pose proof (to64_is_exact K FK) as IK. set (Rad := value32 R) in *. set (k := value32 K) in *.
  destruct (to64_is_exact t32 (proj2 It32)) as [Vt Ft]. rewrite (proj1 It32) in Vt. assert (It : is64 (to64 t32) t) by now split.
  set (t64 := to64 t32) in *. clearbody t64. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Hti. fold T in Et.
  assert (HQ : / 100 <= Q <= 100000000) by (unfold Q; clear -HR; nra).
  assert (big : forall a, Rabs a <= 1000000000000000000000000000000 -> Rabs a <= bpow radix2 1000).
  { intros a Ha. apply Rle_trans with (bpow radix2 100); [simpl; lra|apply bpow_le; lia]. }
  assert (small : bpow radix2 (-1000) <= / 1000000000000000000000000000000).
  { apply Rle_trans with (bpow radix2 (-100)); [apply bpow_le; lia|simpl; lra]. }
  assert (GR : in_binary32 Rad) by apply (generic_format_B2R 24 128).
  assert (IQ : is64 (times (to64 R) (to64 R)) Q).
  { apply times_exact with Rad Rad; try assumption; [reflexivity|now apply product_is_binary64|apply big; rewrite Rabs_pos_eq; lra]. }
  set (sq := times (to64 R) (to64 R)) in *. clearbody sq.
  assert (Ihk : is64 (times (two_to (-1)) (to64 K)) (k / 2)).
  { replace (k / 2) with (bpow radix2 (-1) * k) by (change (bpow radix2 (-1)) with (/ 2); field). apply scaled_is; [lia|exact IK| |].
    - apply product_is_binary64; [apply generic_format_bpow; unfold FLT_exp; lia|apply (generic_format_B2R 24 128)].
    - apply big. change (bpow radix2 (-1)) with (/ 2). rewrite Rabs_pos_eq; lra. }
  set (hk := times (two_to (-1)) (to64 K)) in *. clearbody hk. set (K64 := to64 K) in *. clearbody K64.
  (* sizes *)
  assert (P0 : 0 < P) by (rewrite <- Erho; now apply Rmult_lt_0_compat).
  assert (ER : Rad = r * rho) by (unfold r; field; lra). assert (EQ : Q = r * r * P) by (unfold Q; rewrite ER, <- Erho; ring).
  assert (rhoU : rho <= 22600).
  { destruct (Rle_or_lt rho 22600) as [H|H]; [exact H|exfalso]. assert (22600 * 22600 <= rho * rho) by (apply Rmult_le_compat; lra). lra. }
  assert (rL : 44 / 10000000 <= r).
  { unfold r. apply Rmult_le_reg_r with rho; [exact Hrho|]. replace (Rad / rho * rho) with Rad by (field; lra). lra. }
  assert (Er : r = 1 + T) by (unfold T; ring).
  assert (EV : V = P * T * (2 + T)).
  { replace V with (Q - P) by lra. rewrite EQ, Er. ring. }
  assert (V0 : 0 < Rabs V) by (unfold unit53 in *; pose proof (Rabs_triang_inv vv V); pose proof (Rabs_pos V); lra).
  assert (Vne : V <> 0) by (intro H; rewrite H, Rabs_R0 in V0; lra).
  assert (Tne : T <> 0) by (intro H; apply Vne; rewrite EV, H; ring). pose proof (Rabs_pos_lt T Tne) as T0.
  assert (HT2 : 1 < 2 + T <= 35002 / 10000) by lra.
  assert (EaV : Rabs V = P * (2 + T) * Rabs T).
  { rewrite EV. replace (P * T * (2 + T)) with (P * (2 + T) * T) by ring. rewrite Rabs_mult, Rabs_pos_eq; [reflexivity|apply Rmult_le_pos;
    lra]. }
  assert (LV : / 16777400 * Q <= Rabs V) by (pose proof (Rabs_triang_inv vv V); unfold unit53 in *; lra).
  assert (LT : / 10000000000000000000 <= Rabs T).
  { rewrite EaV, EQ in LV. apply Rmult_le_reg_l with (P * (35002 / 10000)); [lra|].
    assert (44 / 10000000 * (44 / 10000000) * P <= r * r * P) by (apply Rmult_le_compat_r; [lra|apply Rmult_le_compat; lra]).
    assert (P * (2 + T) * Rabs T <= P * (35002 / 10000) * Rabs T) by (apply Rmult_le_compat_r; [lra|apply Rmult_le_compat_l; lra]). lra. }
  assert (UT : Rabs T <= 2) by (apply Rabs_le; lra).
  assert (LP : / 1000 <= P).
  { assert (r * r * P <= 6252 / 1000 * P) by (apply Rmult_le_compat_r; [lra|apply Rle_trans with (25002 / 10000 * (25002 / 10000)); [apply
    Rmult_le_compat; lra|lra]]).
    rewrite EQ in HQ. lra. }
  (* the factors *)
  destruct (factor_of t T rough Tne Et) as (delta & Edelta & Hdelta).
  destruct (factor_of vv V (128 * unit53) Vne Ev) as (ev & Eev & Hev).
  assert (Hd6 : Rabs delta <= / 1000000) by (apply Rle_trans with (1 := Hdelta); unfold rough, unit24; lra).
  pose proof (Rabs_le_inv _ _ Hd6) as Hd6'.
  assert (Bt : Rabs t <= 21 / 10 /\ / 20000000000000000000 <= Rabs t).
  { rewrite Edelta, Rabs_mult, (Rabs_pos_eq (1 + delta)) by lra. split.
    - apply Rle_trans with (2 * (21 / 20)); [apply Rmult_le_compat; lra|lra].
    - apply Rle_trans with (/ 10000000000000000000 * / 2); [lra|apply Rmult_le_compat; lra]. }
  set (m5 := 2 + T) in *.
  assert (mV : forall E, Rabs (vv - V) <= E * unit53 * Rabs V -> 0 <= E <= 128 -> Rabs (V * ev) <= E * unit53 * Rabs V).
  { intros E HE _. replace (V * ev) with (vv - V) by (rewrite Eev; ring). exact HE. }
  (* R^2 - v *)
  assert (BaV : Rabs V <= 6 * P).
  { rewrite EaV. replace (6 * P) with (P * (35002 / 10000) * (6 / (35002 / 10000))) by field.
    apply Rmult_le_compat; try lra; [apply Rmult_le_pos; lra|apply Rmult_le_compat_l; lra|].
    apply Rabs_le. lra. }
  assert (Bvv : Rabs vv <= 7 * P) by (pose proof (Rabs_triang_inv vv V); unfold unit53 in *; lra).
  set (w0 := Q - vv). assert (Ew0 : w0 - P = - (V * ev)) by (unfold w0; rewrite Eev, EP; ring).
  assert (Bw0 : Rabs (w0 - P) <= 1000 * unit53 * P).
  { rewrite Ew0, Rabs_Ropp. apply Rle_trans with (1 := mV 128 Ev ltac:(lra)). unfold unit53 in *. lra. }
  pose proof (Rabs_le_inv _ _ Bw0) as Bw0'. assert (w0B : 999 / 1000 * P <= w0 <= 1001 / 1000 * P) by (unfold unit53 in *; lra).
  destruct (rounding_factor w0) as (d1 & Ed1 & Hd1); [rewrite Rabs_pos_eq by lra; lra|].
  assert (Iw : is64 (minus sq v) (w0 * (1 + d1))).
  { rewrite <- Ed1. apply minus_is; try assumption. apply big. fold w0. rewrite Rabs_pos_eq; lra. }
  assert (Pne : P <> 0) by lra. pose proof (Rabs_le_inv _ _ Hd1) as Hd1'.
  set (w1 := w0 * (1 + d1)) in *. assert (w1B : 998 / 1000 * P <= w1 <= 1002 / 1000 * P).
  { unfold w1. rewrite Rmult_plus_distr_l, Rmult_1_r.
    assert (Rabs (w0 * d1) <= 1001 / 1000 * P * unit53) by (apply bound_product; [rewrite Rabs_pos_eq; lra|exact Hd1]).
    apply Rabs_le_inv in H. unfold unit53 in *. lra. }
  assert (Ew1 : forall E, Rabs (V * ev) <= E * P -> 0 <= E <= 1000 * unit53 -> exists es, w1 = P * (1 + es) /\ Rabs es <= E + 1002 / 1000
    * unit53).
  { intros E HE BE. destruct (factor_of w1 P (E + 1002 / 1000 * unit53) Pne) as (es & X1 & X2); [|now exists es].
    rewrite (Rabs_pos_eq P) by lra. replace (w1 - P) with ((w0 - P) + w0 * d1) by (unfold w1; ring). rewrite Rmult_plus_distr_r.
    apply bound_sum; [rewrite Ew0, Rabs_Ropp; exact HE|].
    apply Rle_trans with (1001 / 1000 * P * unit53); [apply bound_product; [rewrite Rabs_pos_eq; lra|exact Hd1]|].
    assert (0 <= unit53 * P) by (apply Rmult_le_pos; lra). lra. }
  (* the product, the sum, the fused difference *)
  assert (gB : / 1000000000000000000000000 <= Rabs (t * w1) <= 2000000000).
  { rewrite Rabs_mult, (Rabs_pos_eq w1) by lra. split.
    - apply Rle_trans with (/ 20000000000000000000 * (998 / 1000 * / 1000)); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with (21 / 10 * (1002 / 1000 * 510000000)); [apply Rmult_le_compat; try lra; apply Rabs_pos|lra]. }
  destruct (rounding_factor (t * w1)) as (e1 & Ee1 & He1); [lra|].
  assert (Ig : is64 (times t64 (minus sq v)) (t * w1 * (1 + e1))) by (rewrite <- Ee1; apply times_is; try assumption; apply big; lra).
  set (g := t * w1 * (1 + e1)) in *. pose proof (Rabs_le_inv _ _ He1) as He1'.
  assert (Bg : Rabs g <= 3000000000).
  { unfold g. apply Rle_trans with (2000000000 * (3 / 2)); [apply bound_product; [lra|apply Rabs_le; lra]|lra]. }
  pose proof (two_to_is 1 ltac:(lia)) as I2. change (bpow radix2 1) with 2 in I2.
  assert (tT : Rabs (t - T) <= / 1000000 * 2).
  { replace (t - T) with (T * delta) by (rewrite Edelta; ring). rewrite Rmult_comm. now apply bound_product. }
  pose proof (Rabs_le_inv _ _ tT) as tT'.
  assert (hB : 99 / 100 <= t + 2 <= 5) by (unfold m5 in *; lra).
  destruct (rounding_factor (t + 2)) as (e2 & Ee2 & He2); [rewrite Rabs_pos_eq by lra; lra|].
  assert (Ih : is64 (plus t64 (two_to 1)) ((t + 2) * (1 + e2))) by (rewrite <- Ee2; apply plus_is; try assumption; apply big; rewrite
    Rabs_pos_eq; lra).
  set (h := (t + 2) * (1 + e2)) in *. pose proof (Rabs_le_inv _ _ He2) as He2'.
  assert (Bh : Rabs h <= 10) by (unfold h; apply Rle_trans with (5 * 2); [apply bound_product; apply Rabs_le; lra|lra]).
  set (y := vv - g * h). assert (By : Rabs y <= 40000000000).
  { unfold y, Rminus. apply Rle_trans with (7 * P + 3000000000 * 10); [|lra]. apply bound_sum; [exact Bvv|]. rewrite Rabs_Ropp. now apply
    bound_product. }
  set (m := nearest64 y). pose proof (product_is_close y) as Em. fold m in Em.
  assert (Im : is64 (fused (opp (times t64 (minus sq v))) (plus t64 (two_to 1)) v) m).
  { unfold m, y. replace (vv - g * h) with (- g * h + vv) by ring. apply fused_is; try assumption; [now apply opp_is|]. apply big.
    replace (- g * h + vv) with y by (unfold y; ring). lra. }
  assert (Bm : Rabs m <= 50000000000) by (pose proof (Rabs_triang_inv m y); unfold unit53 in *; lra).
  (* the derivative *)
  assert (iQ : / 100000000 <= / Q <= 100).
  { split; [apply Rinv_le; lra|]. replace 100 with (/ / 100) by field. apply Rinv_le; lra. }
  assert (kB : / 200000000000 <= k / 2 / Q <= 50000).
  { unfold Rdiv at 1. split; [apply Rle_trans with (/ 1000 / 2 * / 100000000); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (1000 / 2 * 100); [apply Rmult_le_compat; lra|lra]. }
  destruct (rounding_factor (k / 2 / Q)) as (ec & Eec & Hec); [rewrite Rabs_pos_eq by lra; lra|].
  assert (Ikd : is64 (over hk sq) (k / 2 / Q * (1 + ec))) by (rewrite <- Eec; apply over_is; try assumption; [lra|apply big; rewrite
    Rabs_pos_eq; lra]).
  set (kd := k / 2 / Q * (1 + ec)) in *. pose proof (Rabs_le_inv _ _ Hec) as Hec'.
  assert (kdB : / 400000000000 <= kd <= 100000).
  { unfold kd. split; [apply Rle_trans with (/ 200000000000 * / 2); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (50000 * 2); [apply Rmult_le_compat; lra|lra]. }
  assert (t1 : / 1000000 <= 1 + t <= 4) by (unfold m5, T in *; lra).
  assert (DB : / 1000000000000000000 <= kd * (1 + t) <= 400000).
  { split; [apply Rle_trans with (/ 400000000000 * / 1000000); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (100000 * 4); [apply Rmult_le_compat; lra|lra]. }
  destruct (rounding_factor (kd * (1 + t))) as (e6 & Ee6 & He6); [rewrite Rabs_pos_eq by lra; lra|]. pose proof (Rabs_le_inv _ _ He6) as
    He6'.
  assert (ID : is64 (fused t64 (over hk sq) (over hk sq)) (kd * (1 + t) * (1 + e6))).
  { rewrite <- Ee6. replace (kd * (1 + t)) with (t * kd + kd) by ring. apply fused_is; try assumption. apply big.
    replace (t * kd + kd) with (kd * (1 + t)) by ring. rewrite Rabs_pos_eq; lra. }
  set (D := kd * (1 + t) * (1 + e6)) in *.
  assert (BD : Rabs D <= 800000) by (unfold D; apply Rle_trans with (400000 * 2); [apply bound_product; apply Rabs_le; lra|lra]).
  (* t K, and the last sum *)
  assert (tk : / 100000000000000000000000 <= Rabs (t * k) <= 2100).
  { rewrite Rabs_mult, (Rabs_pos_eq k) by lra. split; [apply Rle_trans with (/ 20000000000000000000 * / 1000); [lra|apply Rmult_le_compat;
    lra]|].
    apply Rle_trans with (21 / 10 * 1000); [apply Rmult_le_compat; try lra; apply Rabs_pos|lra]. }
  destruct (rounding_factor (t * k)) as (e4 & Ee4 & He4); [lra|]. pose proof (Rabs_le_inv _ _ He4) as He4'.
  assert (Ik : is64 (times t64 K64) (t * k * (1 + e4))) by (rewrite <- Ee4; apply times_is; try assumption; apply big; lra).
  set (s0 := m * D + t * k * (1 + e4)).
  assert (Bs0 : Rabs s0 <= 1000000000000000000000).
  { unfold s0. apply Rle_trans with (50000000000 * 800000 + 2100 * 2); [|lra]. apply bound_sum; apply bound_product; try assumption; try
    lra. apply Rabs_le. lra. }
  assert (Is0 : is64 (fused (fused (opp (times t64 (minus sq v))) (plus t64 (two_to 1)) v) (fused t64 (over hk sq) (over hk sq)) (times
    t64 K64)) (nearest64 s0))
    by (apply fused_is; try assumption; apply big; fold s0; lra).
  (* the step *)
  assert (t32B : tiny * Rabs D <= unit53 * Rabs (k * T)).
  { rewrite Rabs_mult, (Rabs_pos_eq k) by lra. apply Rle_trans with (/ 1000000000000000000000000000000000000000000000000000000000000 *
    800000).
    - apply Rmult_le_compat; try lra. apply Rabs_pos.
    - apply Rle_trans with (unit53 * (/ 1000 * / 10000000000000000000)); [unfold unit53; lra|]. apply Rmult_le_compat_l; [lra|].
      apply Rmult_le_compat; lra. }
  assert (Hg3 : Rabs ((1 + ec) * (1 + e6) - 1) <= 3 * unit53).
  { replace ((1 + ec) * (1 + e6) - 1) with (ec + e6 + ec * e6) by ring.
    apply Rle_trans with (unit53 + unit53 + unit53 * unit53); [|unfold unit53; lra]. apply bound_sum; [now apply bound_sum|now apply
      bound_product]. }
  assert (step : forall E M N, Rabs (V * ev) <= E * P -> 0 <= E <= 1000 * unit53 -> Rabs ev <= E -> Rabs (T / (2 * r)) <= M -> Rabs (1 - T
    / (2 * r)) <= N ->
    M * rough <= / 12 -> M <= 131072 ->
    Rabs (s0 - k * T) <= (N * E + M * (rough * rough) + (E + 4 * unit53) * (N + / 1000) +
      (N * E + M * (rough * rough) + (E + 4 * unit53) * (N + / 1000) + rough) * (2 * (M * rough) + 6 * unit53) + 3 * unit53) * Rabs (k *
        T)).
  { intros E M N HE BE Hev' HM HN M1 M2. destruct (Ew1 E HE BE) as (es & Ees & Hes).
    assert (Hq : Rabs ((1 + es) * (1 + e1) * (1 + e2) - 1) <= E + 4 * unit53).
    { replace ((1 + es) * (1 + e1) * (1 + e2) - 1) with (es + (e1 + e2 + e1 * e2) * (1 + es)) by ring.
      apply Rle_trans with (E + 1002 / 1000 * unit53 + 21 / 10 * unit53 * (11 / 10)); [|unfold unit53; lra].
      apply bound_sum; [exact Hes|]. apply bound_product.
      - apply Rle_trans with (unit53 + unit53 + unit53 * unit53); [|unfold unit53; lra]. apply bound_sum; [now apply bound_sum|now apply
        bound_product].
      - apply Rle_trans with (1 + / 10); [|lra]. apply bound_sum; [rewrite Rabs_R1; lra|]. unfold unit53 in *. lra. }
    pose proof (step_is T r P k delta ev ((1 + es) * (1 + e1) * (1 + e2) - 1) ((1 + ec) * (1 + e6) - 1) m y D e4 M N E (E + 4 * unit53)
      Er ltac:(lra) P0 ltac:(lra) HM HN Hdelta Hev' Hq M1 M2 Hg3 He4) as St. cbv zeta in St.
    replace (m * D + k * (T * (1 + delta)) * (1 + e4) - k * T) with (s0 - k * T) in St by (unfold s0; rewrite Edelta; ring).
    apply St; [| |exact Em|exact t32B].
    - unfold y, g, h. rewrite Ees, Eev, EV, Edelta. unfold m5. ring.
    - unfold D, kd. rewrite Edelta, EQ. field. lra. }
  assert (ratio : T / (2 * r) = / 2 - / (2 * r)) by (rewrite Er; field; lra).
  assert (ir : 0 < / (2 * r)) by (apply Rinv_0_lt_compat; lra).
  assert (Rh : rough = 912 / 100 * / 16777216) by reflexivity.
  pose proof (product_is_close s0) as Es. set (s := nearest64 s0) in *.
  assert (kT : / 1000 * / 10000000000000000000 <= k * Rabs T) by (apply Rmult_le_compat; lra).
  split; intro HV.
  - assert (HT : 0 < T).
    { destruct (Rtotal_order T 0) as [H|[H|H]]; [exfalso|now contradiction|exact H]. assert (P * (2 + T) * T < 0); [|rewrite EV in HV;
      fold m5 in HV; unfold m5 in HV; lra].
      assert (0 < P * (2 + T)) by (apply Rmult_lt_0_compat; lra). apply Rmult_lt_reg_l with (/ (P * (2 + T))); [now apply
        Rinv_0_lt_compat|].
      rewrite <- Rmult_assoc, Rinv_l, Rmult_0_r by lra. lra. }
    split; [exact HT|]. rewrite (Rabs_pos_eq T) in kT by lra.
    pose proof (mV 4 (Ev4 HV) ltac:(lra)) as B4.
    assert (Vev : Rabs (V * ev) <= 24 * unit53 * P).
    { apply Rle_trans with (1 := B4). replace (24 * unit53 * P) with (4 * unit53 * (6 * P)) by ring. apply Rmult_le_compat_l; [lra|exact
      BaV]. }
    assert (Hev4 : Rabs ev <= 24 * unit53).
    { destruct (factor_of vv V (4 * unit53) Vne (Ev4 HV)) as (ev' & Eev' & Hev').
      assert (ev = ev') by (apply Rmult_eq_reg_l with V; [lra|exact Vne]). subst ev'. lra. }
    assert (tauB : 0 <= T / (2 * r) <= 30004 / 100000).
    { rewrite ratio. assert (/ (2 * (25002 / 10000)) <= / (2 * r) <= / 2) by (split; apply Rinv_le; lra). lra. }
    pose proof (step (24 * unit53) (30004 / 100000) 1 Vev ltac:(lra) Hev4 ltac:(rewrite Rabs_pos_eq; lra) ltac:(rewrite Rabs_pos_eq; lra)
      ltac:(rewrite Rh; lra) ltac:(lra)) as St.
    rewrite (Rabs_pos_eq (k * T)) in St by (apply Rmult_le_pos; lra).
    assert (kT0 : 0 < k * T) by lra.
    assert (St2 : Rabs (s0 - k * T) <= 2490 * unit53 * (k * T)).
    { apply Rle_trans with (1 := St). apply Rmult_le_compat_r; [lra|]. rewrite Rh. unfold unit53. lra. }
    exists s. assert (Fin : Rabs (s - k * T) <= 2492 * unit53 * (k * T)).
    { replace (s - k * T) with ((s - s0) + (s0 - k * T)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
      pose proof (Rabs_triang_inv s0 (k * T)) as Ti. rewrite (Rabs_pos_eq (k * T)) in Ti by lra. unfold unit53 in *. lra. }
    split; [|exact Fin]. unfold S. pose proof (larger_is _ _ _ _ Is0 zero_is) as Il. rewrite Rmax_left in Il; [exact Il|].
    apply Rabs_le_inv in Fin. unfold unit53 in *. lra.
  - assert (HT : T < 0).
    { destruct (Rtotal_order T 0) as [H|[H|H]]; [exact H|now contradiction|exfalso]. assert (0 < P * T * m5) by (repeat apply
      Rmult_lt_0_compat; unfold m5; lra). lra. }
    assert (Vev : Rabs (V * ev) <= 128 * unit53 * P).
    { apply Rle_trans with (1 := mV 128 Ev ltac:(lra)). apply Rmult_le_compat_l; [lra|]. apply Rabs_le. lra. }
    assert (irU : / (2 * r) <= 131000).
    { replace 131000 with (/ / 131000) by field. apply Rinv_le; lra. }
    pose proof (step (128 * unit53) 131072 131073 Vev ltac:(lra) Hev ltac:(rewrite ratio; apply Rabs_le; lra) ltac:(rewrite ratio; apply
      Rabs_le; lra)
      ltac:(rewrite Rh; lra) ltac:(lra)) as St.
    assert (St2 : Rabs (s0 - k * T) <= / 2 * Rabs (k * T)).
    { apply Rle_trans with (1 := St). apply Rmult_le_compat_r; [apply Rabs_pos|]. rewrite Rh. unfold unit53. lra. }
    assert (kT0 : k * T < 0) by (rewrite <- (Rmult_0_r k); apply Rmult_lt_compat_l; lra).
    rewrite (Rabs_left (k * T)) in St2 by exact kT0. apply Rabs_le_inv in St2.
    apply larger_is_zero with s; [exact Is0|]. rewrite <- (round_0 radix2 fexp64 ZnearestE). apply round_le; auto with
      typeclass_instances. lra.
Qed.
