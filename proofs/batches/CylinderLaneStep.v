(* SPDX-License-Identifier: BSD-3-Clause *)
(* One step of Newton for t = (R - rho) / rho, of real numbers: what it leaves of the error. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Relative BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Gap DoubleDouble ErrorFree.
From Forceshade Require Import SecondAlong CylinderFirst.
From Forceshade Require Import Lanes LaneAnswers BumpLanes CylinderLaneRough CylinderLaneRoughForm.
Import ListNotations.
Open Scope R_scope.

Lemma bound_product : forall a b A B, Rabs a <= A -> Rabs b <= B -> Rabs (a * b) <= A * B.
Proof. intros a b A B Ha Hb. rewrite Rabs_mult. apply Rmult_le_compat; try assumption; apply Rabs_pos. Qed.

Lemma bound_sum : forall a b A B, Rabs a <= A -> Rabs b <= B -> Rabs (a + b) <= A + B.
Proof. intros a b A B Ha Hb. apply Rle_trans with (1 := Rabs_triang _ _). lra. Qed.

(* A rounding as a factor. *)
Lemma rounding_factor : forall a, bpow radix2 (-1000) <= Rabs a -> exists d, nearest64 a = a * (1 + d) /\ Rabs d <= unit53.
Proof.
  intros a Ha. destruct (relative_error_N_FLT_ex radix2 (-1074) 53 (eq_refl _) (fun n => negb (Z.even n)) a) as (d & Hd & E).
  - apply Rle_trans with (2 := Ha). apply bpow_le. lia.
  - exists d. split; [exact E|]. apply Rle_trans with (1 := Hd). unfold unit53. simpl. lra.
Qed.

Lemma factor_of : forall a b k, b <> 0 -> Rabs (a - b) <= k * Rabs b -> exists d, a = b * (1 + d) /\ Rabs d <= k.
Proof.
  intros a b k Hb H. exists ((a - b) / b). split; [field; exact Hb|]. unfold Rdiv. rewrite Rabs_mult, Rabs_inv.
  pose proof (Rabs_pos_lt b Hb). apply Rmult_le_reg_r with (Rabs b); [assumption|]. rewrite Rmult_assoc, Rinv_l by lra. lra.
Qed.

(* One step of Newton, of real numbers: m is v - t (2 + t) rho^2 and D is K (1 + t) / (2 R^2). tau is T / (2 r), r = 1 + T. *)
Lemma step_is : forall T r P K delta ev q1 g m y D e4 M N E q, r = 1 + T -> 0 < r -> 0 < P -> 0 < K ->
  let tau := T / (2 * r) in let dm := rough in
  Rabs tau <= M -> Rabs (1 - tau) <= N -> Rabs delta <= dm -> Rabs ev <= E -> Rabs q1 <= q -> M * dm <= / 12 -> M <= 131072 ->
  Rabs g <= 3 * unit53 -> Rabs e4 <= unit53 ->
  y = P * T * (2 + T) * (1 + ev) - T * (1 + delta) * P * (2 + T + delta * T) * (1 + q1) ->
  D = K / (2 * (r * r * P)) * (1 + T + delta * T) * (1 + g) ->
  Rabs (m - y) <= unit53 * Rabs y + tiny -> tiny * Rabs D <= unit53 * Rabs (K * T) ->
  let b0 := N * E + M * (dm * dm) + q * (N + / 1000) in
  Rabs (m * D + K * (T * (1 + delta)) * (1 + e4) - K * T) <= (b0 + (b0 + dm) * (2 * (M * dm) + 6 * unit53) + 3 * unit53) * Rabs (K * T).
Proof.
  intros T r P K delta ev q1 g m y D e4 M N E q Er Hr HP HK tau dm Htau HN Hdelta Hev Hq1 HM M17 Hg He4 Ey ED Hm Htiny b0.
  pose proof unit_is_small as Hu. assert (Hdm : 0 <= dm <= / 1000000) by (unfold dm, rough, unit24; lra).
  assert (M0 : 0 <= M) by (apply Rle_trans with (2 := Htau); apply Rabs_pos). assert (N0 : 0 <= N) by (apply Rle_trans with (2 := HN);
    apply Rabs_pos).
  assert (q0 : 0 <= q) by (apply Rle_trans with (2 := Hq1); apply Rabs_pos). assert (E0 : 0 <= E) by (apply Rle_trans with (2 := Hev);
    apply Rabs_pos).
  assert (ET : T = 2 * r * tau) by (unfold tau; field; lra). assert (E2 : 2 + T = 2 * r * (1 - tau)) by (unfold tau; rewrite Er; field;
    lra).
  set (beta := (1 - tau) * ev - tau * (delta * delta) - q1 * (1 - tau + (delta + tau * (delta * delta)))).
  set (B := beta - delta). set (G := (1 + 2 * (tau * delta)) * (1 + g)).
  assert (dd : Rabs (delta * delta) <= dm * dm) by now apply bound_product.
  assert (tdd : Rabs (tau * (delta * delta)) <= M * (dm * dm)) by now apply bound_product.
  assert (Mdd : M * (dm * dm) <= / 12 * / 1000000).
  { rewrite <- Rmult_assoc. apply Rmult_le_compat; try lra. apply Rmult_le_pos; lra. }
  assert (Bbeta : Rabs beta <= b0).
  { unfold beta, b0. unfold Rminus at 1 2. apply bound_sum; [apply bound_sum|].
    - now apply bound_product.
    - now rewrite Rabs_Ropp.
    - rewrite Rabs_Ropp. apply bound_product; [exact Hq1|]. apply bound_sum; [exact HN|].
      apply Rle_trans with (dm + M * (dm * dm)); [now apply bound_sum|lra]. }
  assert (BB : Rabs B <= b0 + dm) by (unfold B, Rminus; apply bound_sum; [exact Bbeta|now rewrite Rabs_Ropp]).
  assert (td : Rabs (tau * delta) <= M * dm) by now apply bound_product.
  assert (BG : Rabs (G - 1) <= 2 * (M * dm) + 4 * unit53).
  { replace (G - 1) with (2 * (tau * delta) + (1 + 2 * (tau * delta)) * g) by (unfold G; ring).
    apply bound_sum; [rewrite Rabs_mult, (Rabs_pos_eq 2) by lra; lra|].
    apply Rle_trans with (7 / 6 * (3 * unit53)); [|unfold unit53; lra]. apply bound_product; [|exact Hg].
    apply Rle_trans with (1 + 2 * (M * dm)); [|lra]. apply bound_sum; [rewrite Rabs_R1; lra|]. rewrite Rabs_mult, (Rabs_pos_eq 2) by lra.
      lra. }
  assert (b00 : 0 <= b0) by (apply Rle_trans with (2 := Bbeta); apply Rabs_pos).
  assert (Ey2 : y = P * T * (2 * r) * B).
  { rewrite Ey. replace (2 + T + delta * T) with (2 * r * (1 - tau) + delta * (2 * r * tau)) by (rewrite <- E2, <- ET; ring). rewrite E2.
    unfold B, beta. ring. }
  assert (EyD : y * D = K * T * (B * G)).
  { assert (E3 : 1 + T + delta * T = r * (1 + 2 * (tau * delta))).
    { replace (delta * T) with (delta * (2 * r * tau)) by (now rewrite <- ET). rewrite Er. ring. }
    rewrite Ey2, ED, E3. unfold G. clearbody B tau. field. lra. }
  set (F := K * T) in *.
  assert (E1 : m * D + K * (T * (1 + delta)) * (1 + e4) - F = F * (beta + B * (G - 1) + (1 + delta) * e4) + (m - y) * D).
  { replace (m * D) with (y * D + (m - y) * D) by ring. rewrite EyD. unfold F, B. ring. }
  rewrite E1. apply Rle_trans with (1 := Rabs_triang _ _).
  assert (BGG : Rabs (B * (G - 1)) <= (b0 + dm) * (2 * (M * dm) + 4 * unit53)) by (apply bound_product; assumption).
  assert (Be4 : Rabs ((1 + delta) * e4) <= 1001 / 1000 * unit53).
  { apply bound_product; [|exact He4]. apply Rle_trans with (1 + dm); [|lra]. apply bound_sum; [rewrite Rabs_R1; lra|exact Hdelta]. }
  assert (Bmid : Rabs (beta + B * (G - 1) + (1 + delta) * e4) <= b0 + (b0 + dm) * (2 * (M * dm) + 4 * unit53) + 1001 / 1000 * unit53).
  { apply bound_sum; [apply bound_sum|]; assumption. }
  assert (BmD : Rabs ((m - y) * D) <= (b0 + dm) * (2 * unit53) * Rabs F + unit53 * Rabs F).
  { rewrite Rabs_mult. apply Rle_trans with ((unit53 * Rabs y + tiny) * Rabs D); [apply Rmult_le_compat_r; [apply Rabs_pos|exact Hm]|].
    rewrite Rmult_plus_distr_r. apply Rplus_le_compat; [|exact Htiny].
    rewrite Rmult_assoc, <- Rabs_mult, EyD, Rabs_mult.
    assert (Rabs (B * G) <= (b0 + dm) * 2).
    { apply bound_product; [exact BB|]. replace G with (1 + (G - 1)) by ring. apply Rle_trans with (1 + (2 * (M * dm) + 4 * unit53)).
      - apply bound_sum; [rewrite Rabs_R1; lra|exact BG].
      - lra. }
    replace ((b0 + dm) * (2 * unit53) * Rabs F) with (unit53 * (Rabs F * ((b0 + dm) * 2))) by ring.
    apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; [apply Rabs_pos|assumption]. }
  rewrite Rabs_mult. assert (F0 : 0 <= Rabs F) by apply Rabs_pos.
  apply Rle_trans with (Rabs F * (b0 + (b0 + dm) * (2 * (M * dm) + 4 * unit53) + 1001 / 1000 * unit53) + ((b0 + dm) * (2 * unit53) * Rabs
    F + unit53 * Rabs F)).
  - apply Rplus_le_compat; [apply Rmult_le_compat_l; assumption|exact BmD].
  - replace ((b0 + (b0 + dm) * (2 * (M * dm) + 6 * unit53) + 3 * unit53) * Rabs F) with
      (Rabs F * (b0 + (b0 + dm) * (2 * (M * dm) + 4 * unit53) + 1001 / 1000 * unit53) + ((b0 + dm) * (2 * unit53) * Rabs F + unit53 * Rabs
        F)
       + 999 / 1000 * unit53 * Rabs F) by field.
    assert (0 <= 999 / 1000 * unit53 * Rabs F) by (apply Rmult_le_pos; lra). lra.
Qed.
