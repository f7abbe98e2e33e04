(* SPDX-License-Identifier: BSD-3-Clause *)
(* The same step for u = 1/2 - t, where s is above 1/2. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms DoubleDoubleOff ThreePolygonsFace.
From Forceshade Require Import NewtonStart NewtonRounded.
From Forceshade Require Import NewtonThird.
Open Scope R_scope.

Lemma rest_value_is : forall s a y t sigma phi, argument a y t -> 999 / 1000 * t <= y <= 10001 / 10000 * t ->
  / 100000000 <= t <= 3265 / 10000 ->
  is_off s sigma (13 * (unit53 * (unit53 * sigma))) (101 / 100 * sigma) (101 / 100 * (unit53 * sigma)) (/ 10000000000 * sigma) ->
  0 < sigma <= 6 * (t * t) -> Rabs ((6 - 4 * y) * y * y - sigma) <= phi * t -> 0 <= phi <= 113 * (unit53 * t) ->
  is_off (rest_value s a) ((6 - 4 * y) * y * y - sigma) (225 * (unit53 * (unit53 * t) * t)) (phi * t + 450 * (unit53 * (unit53 * t) * t))
    (220 * (unit53 * (unit53 * t) * t)) (/ 60000000 * (t * t)).
Proof.
  intros s a y t sigma phi Ha By Bt Hs Bs Hf Hphi. unfold argument in Ha. pose proof unit_is_small as Hu.
  set (u := unit53) in *. set (Z := u * u). set (U := u * t). set (W := u * U). set (V := W * t). set (T := t * t). set (X := u * T).
  assert (EU : u * t = U) by reflexivity. assert (EW : u * U = W) by reflexivity. assert (EWW : u * (u * t) = W) by reflexivity.
  assert (EZ : u * u = Z) by reflexivity. assert (ET : t * t = T) by reflexivity. assert (EV : W * t = V) by reflexivity.
  assert (EVV : u * (u * t) * t = V) by reflexivity. assert (EX : u * T = X) by reflexivity.
  assert (EX2 : u * (t * t) = X) by reflexivity. assert (EUt : U * t = X) by (unfold X, U, T; ring).
  assert (EuX : u * X = V) by (unfold X, V, W, U, T; ring). assert (EuX2 : u * (u * (t * t)) = V) by (unfold V, W, U; ring).
  assert (BU : 0 < U <= 3265 / 10000 * u).
  { unfold U. split; [apply Rmult_lt_0_compat; lra|]. rewrite (Rmult_comm (3265 / 10000)). apply Rmult_le_compat_l; lra. }
  assert (BZ : 0 < Z <= / 1000000000000 * u) by (unfold Z; split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (BW : 0 < W <= 3265 / 10000 * Z).
  { unfold W, Z. split; [apply Rmult_lt_0_compat; lra|]. replace (3265 / 10000 * (u * u)) with (u * (3265 / 10000 * u)) by ring.
    apply Rmult_le_compat_l; lra. }
  assert (BWU : W <= / 1000000000000 * U) by (unfold W; apply Rmult_le_compat_r; lra).
  assert (BUt : U <= / 1000000000000 * t) by (unfold U; apply Rmult_le_compat_r; lra).
  assert (Btl : / 10000000000000000 <= T).
  { apply Rle_trans with (/ 100000000 * / 100000000); [lra|apply Rmult_le_compat; lra]. }
  assert (BT : T <= 3265 / 10000 * t) by (unfold T; apply Rmult_le_compat_r; lra).
  assert (BX : 0 < X <= / 1000000000000 * T) by (unfold X; split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (BV : 0 < V <= / 1000000000000 * X).
  { rewrite <- EuX. split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]. }
  assert (BuV : u * V <= / 1000000000000 * V) by (apply Rmult_le_compat_r; lra).
  assert (BuuX : u * (u * X) <= / 1000000000000 * V) by (rewrite EuX; exact BuV).
  assert (BtZ : W = Z * t) by (unfold Z, W, U; ring).
  assert (Byt : 999 / 1000 * T <= t * y <= 10001 / 10000 * T).
  { replace (999 / 1000 * T) with (t * (999 / 1000 * t)) by (unfold T; ring). replace (10001 / 10000 * T) with (t * (10001 / 10000 * t))
      by (unfold T; ring). split; apply Rmult_le_compat_l; lra. }
  assert (Byy : 998 / 1000 * T <= y * y <= 10003 / 10000 * T).
  { split.
    - apply Rle_trans with (999 / 1000 * t * (999 / 1000 * t)); [unfold T in *; lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with (10001 / 10000 * t * (10001 / 10000 * t)); [apply Rmult_le_compat; lra|unfold T in *; lra]. }
  assert (Byyy : 0 <= y * y * y <= 3267 / 10000 * (y * y)).
  { split; [apply Rmult_le_pos; lra|]. rewrite (Rmult_comm (3267 / 10000)). apply Rmult_le_compat_l; lra. }
  assert (Bus : u * sigma <= 6 * X) by (unfold X; replace (6 * (u * T)) with (u * (6 * T)) by ring; apply Rmult_le_compat_l; lra).
  assert (Buus : u * (u * sigma) <= 6 * V).
  { rewrite <- EuX. replace (6 * (u * X)) with (u * (6 * X)) by ring. apply Rmult_le_compat_l; lra. }
  assert (Hphi2 : phi * t <= 113 * X).
  { rewrite <- EUt. replace (113 * (U * t)) with (113 * U * t) by ring. apply Rmult_le_compat_r; lra. }
  assert (R4 : Rabs 4 = 4) by (apply Rabs_pos_eq; lra). assert (R6 : Rabs 6 = 6) by (apply Rabs_pos_eq; lra).
  assert (Ry : Rabs y = y) by (apply Rabs_pos_eq; lra).
  pose proof (is_off_whole 4 ltac:(lia)) as W4. pose proof (is_off_whole 6 ltac:(lia)) as W6. rewrite R4 in W4. rewrite R6 in W6.
  (* 4 y *)
  pose proof (is_off_multiply _ _ _ _ _ _ _ _ _ _ _ _ (4 * (1001 / 1000 * t)) (4 * (/ 100000000000 * t)) W4 Ha ltac:(fold u; lra)
    ltac:(fold u; lra) eq_refl ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A1.
  apply (is_off_more _ _ _ _ _ _ (281 / 10 * W) (405 / 100 * t) (405 / 100 * U) (/ 5000000000 * t)) in A1;
    [|rewrite R4; fold u; lra|lra|fold u; lra|lra].
  (* 6 - 4 y *)
  assert (R1 : Rabs (6 + - (4 * y)) = 6 - 4 * y) by (rewrite Rabs_pos_eq; lra).
  destruct (is_off_add _ _ _ _ _ _ _ _ _ _ _ _ (6001 / 1000) (405 / 100 * U) (6602 / 1000) W6 (is_off_negated _ _ _ _ _ _ A1) ltac:(lra)
    ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as [A2 _].
  apply (is_off_more _ _ _ _ _ _ (246 / 10 * Z) (6602 / 1000) (661 / 100 * u) (/ 4000000000)) in A2;
    [|fold u; lra|lra|fold u; lra|lra].
  change (6 + - (4 * y)) with (6 - 4 * y) in A2, R1.
  (* (6 - 4 y) y *)
  pose proof (is_off_multiply _ _ _ _ _ _ _ _ _ _ _ _ (6602 / 1000 * (1001 / 1000 * t)) (/ 3000000000 * t) A2 Ha ltac:(fold u; lra)
    ltac:(fold u; lra) eq_refl ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A3.
  apply (is_off_more _ _ _ _ _ _ (712 / 10 * W) (668 / 100 * t) (668 / 100 * U) (/ 900000000 * t)) in A3;
    [|rewrite R1; fold u; lra|lra|fold u; lra|lra].
  (* (6 - 4 y) y y *)
  assert (R2 : Rabs ((6 - 4 * y) * y) = (6 - 4 * y) * y) by (apply Rabs_pos_eq; lra).
  pose proof (is_off_multiply _ _ _ _ _ _ _ _ _ _ _ _ (668 / 100 * t * (1001 / 1000 * t)) (/ 800000000 * T) A3 Ha ltac:(fold u; lra)
    ltac:(fold u; lra) eq_refl ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A4.
  apply (is_off_more _ _ _ _ _ _ (119 * V) (676 / 100 * T) (676 / 100 * X) (/ 250000000 * T)) in A4;
    [|rewrite R2; fold u; lra|lra|fold u; lra|lra].
  (* less the rest *)
  assert (Hf2 : Rabs ((6 - 4 * y) * y * y + - sigma) <= phi * t) by exact Hf.
  destruct (is_off_add _ _ _ _ _ _ _ _ _ _ _ _ (127 * X) (1283 / 100 * X) (160 * X) A4 (is_off_negated _ _ _ _ _ _ Hs) ltac:(lra)
    ltac:(lra) ltac:(lra) ltac:(fold u; lra) ltac:(fold u; lra) ltac:(lra) ltac:(lra) ltac:(split;
      [unfold X, u, unit53; lra|lra])) as [A5 _].
  apply (is_off_smaller _ _ _ _ _ _ (phi * t)) in A5; [|exact Hf].
  apply (is_off_more _ _ _ _ _ _ (225 * V) (phi * t + 450 * V) (220 * V) (/ 60000000 * T)) in A5;
    [|fold u; lra|fold u; lra|fold u; lra|lra].
  exact A5.
Qed.

Lemma rest_slope_is : forall a y t, argument a y t -> 999 / 1000 * t <= y <= 10001 / 10000 * t -> / 100000000 <= t <= 3265 / 10000 ->
  is_off (rest_slope a) (12 * y * (1 - y)) (230 * (unit53 * (unit53 * t))) (135 / 10 * t) (135 / 10 * (unit53 * t)) (/ 400000000 * t).
Proof.
  intros a y t Ha By Bt. unfold argument in Ha. pose proof unit_is_small as Hu.
  set (u := unit53) in *. set (Z := u * u). set (U := u * t). set (W := u * U).
  assert (EU : u * t = U) by reflexivity. assert (EW : u * U = W) by reflexivity. assert (EWW : u * (u * t) = W) by reflexivity.
  assert (EZ : u * u = Z) by reflexivity. assert (EZt : Z * t = W) by (unfold Z, W, U; ring).
  assert (BU : 0 < U <= 3265 / 10000 * u).
  { unfold U. split; [apply Rmult_lt_0_compat; lra|]. rewrite (Rmult_comm (3265 / 10000)). apply Rmult_le_compat_l; lra. }
  assert (BZ : 0 < Z <= / 1000000000000 * u) by (unfold Z; split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (BW : 0 < W <= 3265 / 10000 * Z).
  { unfold W, Z. split; [apply Rmult_lt_0_compat; lra|]. replace (3265 / 10000 * (u * u)) with (u * (3265 / 10000 * u)) by ring.
    apply Rmult_le_compat_l; lra. }
  assert (BUt : U <= / 1000000000000 * t) by (unfold U; apply Rmult_le_compat_r; lra).
  assert (ByZ : y * Z <= 10001 / 10000 * W).
  { rewrite <- EZt. replace (10001 / 10000 * (Z * t)) with (10001 / 10000 * t * Z) by ring. apply Rmult_le_compat_r; lra. }
  assert (R12 : Rabs 12 = 12) by (apply Rabs_pos_eq; lra). assert (R1 : Rabs 1 = 1) by (apply Rabs_pos_eq; lra).
  assert (Ry : Rabs y = y) by (apply Rabs_pos_eq; lra).
  pose proof (is_off_whole 12 ltac:(lia)) as W12. pose proof (is_off_whole 1 ltac:(lia)) as W1. rewrite R12 in W12. rewrite R1 in W1.
  pose proof (is_off_multiply _ _ _ _ _ _ _ _ _ _ _ _ (12 * (1001 / 1000 * t)) (12 * (/ 100000000000 * t)) W12 Ha ltac:(fold u; lra)
    ltac:(fold u; lra) eq_refl ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A1.
  apply (is_off_more _ _ _ _ _ _ (85 * W) (1214 / 100 * t) (1214 / 100 * U) (/ 2000000000 * t)) in A1;
    [|rewrite R12; fold u; lra|lra|fold u; lra|lra].
  assert (R2 : Rabs (1 + - y) = 1 - y) by (rewrite Rabs_pos_eq; lra).
  destruct (is_off_add _ _ _ _ _ _ _ _ _ _ _ _ (10001 / 10000) (102 / 100 * U) (1101 / 1000) W1 (is_off_negated _ _ _ _ _ _ Ha) ltac:(lra)
    ltac:(lra) ltac:(lra) ltac:(lra) ltac:(fold u; lra) ltac:(lra) ltac:(lra) ltac:(lra)) as [A2 _].
  apply (is_off_more _ _ _ _ _ _ (29 / 10 * Z) (1101 / 1000) (1102 / 1000 * u) (/ 80000000000)) in A2;
    [|fold u; lra|lra|fold u; lra|lra].
  change (1 + - y) with (1 - y) in A2, R2. assert (R3 : Rabs (12 * y) = 12 * y) by (apply Rabs_pos_eq; lra).
  pose proof (is_off_multiply _ _ _ _ _ _ _ _ _ _ _ _ (1214 / 100 * t * (1101 / 1000)) (/ 1400000000 * t) A1 A2 ltac:(fold u; lra)
    ltac:(fold u; lra) eq_refl ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A3.
  apply (is_off_more _ _ _ _ _ _ (230 * W) (135 / 10 * t) (135 / 10 * U) (/ 400000000 * t)) in A3;
    [exact A3|rewrite R3; fold u; lra|lra|fold u; lra|lra].
Qed.

Lemma rest_quotient_is : forall v s F D t phi, is_off v F (225 * (unit53 * (unit53 * t) * t)) (phi * t + 450 * (unit53 * (unit53 * t) * t))
    (220 * (unit53 * (unit53 * t) * t)) (/ 60000000 * (t * t)) ->
  is_off s D (230 * (unit53 * (unit53 * t))) (135 / 10 * t) (135 / 10 * (unit53 * t)) (/ 400000000 * t) ->
    / 100000000 <= t <= 3265 / 10000 ->
  Rabs F <= phi * t -> 0 <= phi <= 113 * (unit53 * t) -> 805 / 100 * t <= Rabs D ->
  is_off (divide v s) (F / D) (287 / 10 * (unit53 * (unit53 * t)) + 25 / 10 * (unit53 * phi)) (50 * (unit53 * t))
    (80 * (unit53 * (unit53 * t))) (/ 10000000 * t).
Proof.
  intros v s F D t phi Hv Hs Bt HF Hphi HD. pose proof unit_is_small as Hu. pose proof (Rabs_pos F) as PF.
  set (u := unit53) in *. set (U := u * t) in *. set (W := u * U) in *. set (V := W * t) in *. set (T := t * t) in *. set (X := U * t).
  assert (EU : u * t = U) by reflexivity. assert (EW : u * U = W) by reflexivity. assert (EX : U * t = X) by reflexivity.
  assert (EuX : u * X = V) by (unfold X, V, W, U; ring).
  assert (BU : 0 < U <= / 1000000000000 * t) by (unfold U; split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (BW : 0 < W <= / 1000000000000 * U) by (unfold W; split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (BX : 0 < X <= / 1000000000000 * T).
  { unfold X, T. split; [apply Rmult_lt_0_compat; lra|]. rewrite <- Rmult_assoc. apply Rmult_le_compat_r; lra. }
  assert (BV : 0 < V <= / 1000000000000 * X).
  { rewrite <- EuX. split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]. }
  assert (Btl : / 10000000000000000 <= T).
  { apply Rle_trans with (/ 100000000 * / 100000000); [lra|apply Rmult_le_compat; lra]. }
  assert (Xlow : / 100000000000000000000000000000000 <= X).
  { replace X with (u * T) by (unfold X, U, T; ring). apply Rle_trans with (u * / 10000000000000000); [unfold u, unit53; lra|].
    apply Rmult_le_compat_l; lra. }
  assert (Pu : 0 <= u * phi <= 113 * W).
  { split; [apply Rmult_le_pos; lra|]. unfold W. replace (113 * (u * U)) with (u * (113 * U)) by ring. apply Rmult_le_compat_l; lra. }
  set (Q := / 8 * (phi + / 1000 * U)). assert (BQ : 0 < Q <= 15 * U) by (unfold Q; lra).
  assert (QW : 0 <= Q * W <= / 1000000 * V).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (15 * U * W); [apply Rmult_le_compat_r; lra|].
    replace (15 * U * W) with (15 * u * V) by (unfold V, U; ring). apply Rmult_le_compat_r; lra. }
  assert (Qd : Q * (8 * t) = phi * t + / 1000 * X) by (unfold Q, X; field).
  assert (HQ : Rabs (F / D) <= Q).
  { apply quotient_size; [lra|]. apply Rle_trans with (Q * (8 * t)); [lra|]. apply Rmult_le_compat_l; lra. }
  assert (Qt : 0 <= Q * t <= 15 * X).
  { split; [apply Rmult_le_pos; lra|]. unfold X. rewrite <- Rmult_assoc. apply Rmult_le_compat_r; lra. }
  assert (uQ : u * Q = / 8 * (u * phi + / 1000 * W)) by (unfold Q; rewrite <- EW; field).
  assert (Et : / 300000000 * t * (8 * t) = 8 / 300000000 * T) by (unfold T; field).
  pose proof (is_off_divide _ _ _ _ _ _ _ _ _ _ _ _ (8 * t) Q (/ 300000000 * t) Hv Hs ltac:(lra) ltac:(lra) ltac:(lra) ltac:(fold u;
    lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) HQ ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A.
  assert (Ee : 102 / 100 * (225 * V + Q * (230 * W)) / (8 * t) <= 28696 / 1000 * W).
  { apply Rmult_le_reg_r with (8 * t); [lra|]. unfold Rdiv at 1. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
    replace (28696 / 1000 * W * (8 * t)) with (229568 / 1000 * V) by (unfold V; field). lra. }
  apply (is_off_more _ _ _ _ _ _ (287 / 10 * W + 25 / 10 * (u * phi)) (50 * U) (80 * W) (/ 10000000 * t)) in A;
    [exact A|fold u; lra|lra|fold u; lra|lra].
Qed.

Lemma rest_step_in_double_double : forall s sigma t, 6 * (t * t) - 4 * (t * t * t) = sigma -> / 100000000 <= t <= / 2 ->
  sigma <= 5001 / 10000 -> 0 < sigma ->
  is_off s sigma (13 * (unit53 * (unit53 * sigma))) (101 / 100 * sigma) (101 / 100 * (unit53 * sigma)) (/ 10000000000 * sigma) ->
  forall a b y rho, argument a y t -> argument b y t -> 0 <= rho <= 9 * unit53 -> Rabs (y - t) <= rho * t ->
    let q := ((6 - 4 * y) * y * y - sigma) / (12 * y * (1 - y)) in
    is_off (divide (rest_value s a) (rest_slope b)) q (287 / 10 * (unit53 * (unit53 * t)) + 31 * (unit53 * (rho * t)))
      (50 * (unit53 * t)) (80 * (unit53 * (unit53 * t))) (/ 10000000 * t) /\
    Rabs (y - q - t) <= 56 / 100 * (rho * rho) * t.
Proof.
  intros s sigma t E Ht Hs Hs0 S a b y rho Ha Hb Hrho Hy q. pose proof unit_is_small as Hu.
  pose proof (rest_is_small sigma t Hs ltac:(lra) E) as Hsmall.
  assert (Hrt : 0 <= rho * t <= 9 * (unit53 * t)).
  { split; [apply Rmult_le_pos; lra|]. replace (9 * (unit53 * t)) with (9 * unit53 * t) by ring. apply Rmult_le_compat_r; lra. }
  pose proof (unit_times t ltac:(lra)) as Ut. pose proof (Rabs_le_inv _ _ Hy) as Hy2.
  assert (By : 999 / 1000 * t <= y <= 10001 / 10000 * t) by lra.
  assert (Htt : 0 < t * t) by (apply Rmult_lt_0_compat; lra).
  assert (Hst : sigma <= 6 * (t * t)).
  { assert (0 <= t * t * t) by (apply Rmult_le_pos; lra). lra. }
  assert (Hyt : 0 <= y * t <= 10001 / 10000 * (t * t)).
  { split; [apply Rmult_le_pos; lra|]. replace (10001 / 10000 * (t * t)) with (10001 / 10000 * t * t) by ring.
    apply Rmult_le_compat_r; lra. }
  assert (Hyy : 0 <= y * y <= 10003 / 10000 * (t * t)).
  { split; [apply Rle_0_sqr|]. apply Rle_trans with (10001 / 10000 * t * (10001 / 10000 * t)); [apply Rmult_le_compat; lra|lra]. }
  assert (Htt2 : t * t <= 3265 / 10000 * t) by (apply Rmult_le_compat_r; lra).
  assert (Hf : Rabs ((6 - 4 * y) * y * y - sigma) <= 121 / 10 * (rho * t) * t).
  { replace ((6 - 4 * y) * y * y - sigma) with ((y - t) * (6 * (y + t) - 4 * (y * y + y * t + t * t))) by (rewrite <- E; ring).
    rewrite Rabs_mult. replace (121 / 10 * (rho * t) * t) with (rho * t * (121 / 10 * t)) by ring.
    apply Rmult_le_compat; try apply Rabs_pos; [exact Hy|apply Rabs_le; lra]. }
  split.
  - pose proof (rest_value_is s a y t sigma (121 / 10 * (rho * t)) Ha By ltac:(lra) S ltac:(lra) Hf ltac:(lra)) as V.
    pose proof (rest_slope_is b y t Hb By ltac:(lra)) as D.
    assert (Hut : 0 <= unit53 * (rho * t)) by (apply Rmult_le_pos; lra).
    apply (is_off_more _ _ (287 / 10 * (unit53 * (unit53 * t)) + 25 / 10 * (unit53 * (121 / 10 * (rho * t)))) (50 * (unit53 * t))
      (80 * (unit53 * (unit53 * t))) (/ 10000000 * t)); try lra.
    apply rest_quotient_is; try assumption; try lra. rewrite Rabs_pos_eq.
    + apply Rle_trans with (12 * (999 / 1000 * t) * (673 / 1000)); [lra|apply Rmult_le_compat; lra].
    + apply Rmult_le_pos; lra.
  - pose proof (newton_for_rest_converges sigma t y rho Hs ltac:(lra) E ltac:(lra) Hy) as N. unfold q.
    replace (6 * (y * y) - 4 * (y * y * y) - sigma) with ((6 - 4 * y) * y * y - sigma) in N by ring. exact N.
Qed.
