(* SPDX-License-Identifier: BSD-3-Clause *)
(* t = sin(alpha / 3) in double-double with its bound of the error encloses the exact one: sine_of_third of fast/laws/bump_geometry.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms DoubleDoubleOff ThreePolygonsFace.
From Forceshade Require Import ThreePolygonsConstants NewtonStart NewtonRounded NewtonThird NewtonRest SineOfThird.
From Forceshade Require Import Enclosures EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondAlong.
From Forceshade Require Import ThreePolygonsEnclosed NewtonEnclosed.
Open Scope R_scope.

(* ---- s at most 1/2 ---- *)

Lemma third_derivative : forall sigma c, derivable_pt_lim (fun y => (4 * y * y - 3) * y + sigma) c (12 * c * c - 3).
Proof.
  intros sigma c.
  change (fun y => (4 * y * y - 3) * y + sigma) with
    (plus_fct (mult_fct (minus_fct (mult_fct (mult_fct (fct_cte 4) id) id) (fct_cte 3)) id) (fct_cte sigma)).
  replace (12 * c * c - 3) with ((((0 * id c + fct_cte 4 c * 1) * id c + mult_fct (fct_cte 4) id c * 1 - 0) * id c +
    minus_fct (mult_fct (mult_fct (fct_cte 4) id) id) (fct_cte 3) c * 1) + 0) by (unfold minus_fct, mult_fct, fct_cte, id; ring).
  apply derivable_pt_lim_plus; [|apply derivable_pt_lim_const]. apply derivable_pt_lim_mult; [|apply derivable_pt_lim_id].
  apply derivable_pt_lim_minus; [|apply derivable_pt_lim_const]. apply derivable_pt_lim_mult; [|apply derivable_pt_lim_id].
  apply derivable_pt_lim_mult; [apply derivable_pt_lim_const|apply derivable_pt_lim_id].
Qed.

Lemma third_value_within : forall s a m sigma t, encloses (3 * share101) s sigma -> encloses 0 a m -> / 60000000 <= t <= 1737 / 10000 ->
  4 * (t * t * t) - 3 * t + sigma = 0 -> 27 / 10 * t <= sigma <= 3 * t -> Rabs (m - t) <= 400 * (unit53 * (unit53 * t)) ->
  exists e, within e (third_value s a) ((4 * m * m - 3) * m + sigma) /\ Rabs ((4 * m * m - 3) * m + sigma) <= 38 * e /\
    / 1000000000000000000000000000000000000000000000000000000000 <= e <= 2500 * (share101 * t).
Proof.
  intros s a m sigma t Es Ea Bt Et Bs Bm. pose proof unit_is_small as Hu. pose proof share_is_small as Hsh.
    pose proof tiny_is_tinier as Htiny.
  pose proof (unit_times t ltac:(lra)) as Ut. pose proof (unit_times _ (proj1 Ut)) as UUt. pose proof (Rabs_le_inv _ _ Bm) as Bm2.
  assert (EW : share101 * t = 32 * (unit53 * (unit53 * t))) by (rewrite share_is; ring). set (W := unit53 * (unit53 * t)) in *.
  assert (By : 9999 / 10000 * t <= m <= 10001 / 10000 * t) by lra.
  assert (Byy : / 10000000000000000 <= m * m <= 302 / 10000).
  { split; [apply Rle_trans with (/ 70000000 * / 70000000); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (17372 / 100000 * (17372 / 100000)); [apply Rmult_le_compat; lra|lra]. }
  assert (Bty : 0 <= m * t <= 302 / 10000).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (17372 / 100000 * (1737 / 10000)); [apply Rmult_le_compat; lra|lra]. }
  assert (Btt : 0 <= t * t <= 302 / 10000).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (1737 / 10000 * (1737 / 10000)); [apply Rmult_le_compat; lra|lra]. }
  pose proof (whole_enclosed 4 ltac:(lia)) as E4. pose proof (whole_enclosed 3 ltac:(lia)) as E3.
  assert (A1 : encloses (3 * share101) (multiply (whole_dd 4) a) (4 * m)).
  { apply encloses_more with (3 * (0 + 0) + 3 * share101); [|lra]. apply encloses_multiply; trivial; try lra. right. right.
    rewrite Rabs_pos_eq; lra. }
  assert (R2 : Rabs (4 * m * m) = 4 * (m * m)) by (rewrite Rabs_pos_eq; lra).
  assert (A2 : encloses (12 * share101) (multiply (multiply (whole_dd 4) a) a) (4 * m * m)).
  { apply encloses_more with (3 * (3 * share101 + 0) + 3 * share101); [|lra]. apply encloses_multiply; trivial; lra. }
  assert (R3 : Rabs (4 * m * m - 3) = 3 - 4 * (m * m)) by (rewrite Rabs_left; lra).
  assert (A3 : encloses (87 * share101) (minus_dd (multiply (multiply (whole_dd 4) a) a) (whole_dd 3)) (4 * m * m - 3)).
  { apply encloses_more with (7 * (12 * share101 + 0) + 3 * share101); [|lra]. apply encloses_subtract; trivial; rewrite ?R3; lra. }
  pose proof (first_size _ _ _ A3 ltac:(lra)) as S3. rewrite R3 in S3. pose proof (first_size _ _ _ Ea ltac:(lra)) as Sa.
  rewrite (Rabs_pos_eq m) in Sa by lra. set (b := minus_dd _ (whole_dd 3)) in *.
  set (v := Rabs (value64 (hi b))) in *. set (w := Rabs (value64 (hi a))) in *.
  destruct (multiply_encloses (87 * share101) 0 b a _ _ A3 Ea ltac:(lra) ltac:(lra) ltac:(lra)) as (A4 & Ca & _).
  { right. fold v w. split; [apply Rle_trans with (2 * / 1000000000); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (4 * 1); [apply Rmult_le_compat; lra|lra]. }
  set (A := (4 * m * m - 3) * m) in *.
  assert (RA : Rabs A = (3 - 4 * (m * m)) * m) by (unfold A; rewrite Rabs_mult, R3, (Rabs_pos_eq m); lra).
  assert (BA : 2877 / 1000 * t <= Rabs A <= 301 / 100 * t).
  { rewrite RA. split.
    - apply Rle_trans with (2878 / 1000 * (9999 / 10000 * t)); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with (3 * (10001 / 10000 * t)); [apply Rmult_le_compat; lra|lra]. }
  assert (Bphi : Rabs (A + sigma) <= 1200 * W).
  { replace (A + sigma) with ((m - t) * (4 * (m * m + m * t + t * t) - 3)) by (unfold A; lra).
    replace (1200 * W) with (400 * W * 3) by ring. apply product_size; [exact Bm|]. apply Rabs_le. lra. }
  destruct (sum_within _ _ _ _ A sigma (1200 * W) A4 Es ltac:(lra) ltac:(lra) Ca ltac:(lra) ltac:(rewrite Rabs_pos_eq; lra) Bphi ltac:(lra))
    as (e & We & Low & Up).
  rewrite (Rabs_pos_eq sigma) in Up by lra.
  assert (L1 : 2877 / 1000 * (share101 * t) <= share101 * Rabs A).
  { replace (2877 / 1000 * (share101 * t)) with (share101 * (2877 / 1000 * t)) by ring. apply Rmult_le_compat_l; lra. }
  assert (L2 : share101 * Rabs A <= 301 / 100 * (share101 * t)).
  { replace (301 / 100 * (share101 * t)) with (share101 * (301 / 100 * t)) by ring. apply Rmult_le_compat_l; lra. }
  assert (L3 : share101 * sigma <= 3 * (share101 * t)).
  { replace (3 * (share101 * t)) with (share101 * (3 * t)) by ring. apply Rmult_le_compat_l; lra. }
  assert (L4 : share101 * (1200 * W) <= / 1000 * W).
  { replace (share101 * (1200 * W)) with (1200 * share101 * W) by ring. apply Rmult_le_compat_r; lra. }
  assert (LW : / 10000000000000000000000000000000000000000 <= W).
  { unfold W. apply Rle_trans with (unit53 * (unit53 * / 60000000)); [unfold unit53; lra|].
    apply unit_times_compat, unit_times_compat. lra. }
  exists e. split; [exact We|]. split; [|split]; lra.
Qed.

Lemma third_slope_within : forall a y t, encloses (/ 1000000000000) a y -> 999 / 1000 * t <= y <= 10001 / 10000 * t ->
  / 60000000 <= t <= 1737 / 10000 ->
  exists g, within g (third_slope a) (12 * y * y - 3) /\ g <= / 2000 * Rabs (12 * y * y - 3) /\ 26 / 10 <= Rabs (12 * y * y - 3) <= 3.
Proof.
  intros a y t Ea By Bt. pose proof share_is_small as Hsh.
  assert (Byy : / 10000000000000000 <= y * y <= 303 / 10000).
  { split; [apply Rle_trans with (/ 70000000 * / 70000000); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (17372 / 100000 * (17372 / 100000)); [apply Rmult_le_compat; lra|lra]. }
  pose proof (whole_enclosed 12 ltac:(lia)) as E12. pose proof (whole_enclosed 3 ltac:(lia)) as E3.
  assert (A1 : encloses (/ 100000000000) (multiply (whole_dd 12) a) (12 * y)).
  { apply encloses_more with (3 * (0 + / 1000000000000) + 3 * share101); [|lra]. apply encloses_multiply; trivial; try lra. right. right.
    rewrite Rabs_pos_eq; lra. }
  assert (A2 : encloses (/ 10000000000) (multiply (multiply (whole_dd 12) a) a) (12 * y * y)).
  { apply encloses_more with (3 * (/ 100000000000 + / 1000000000000) + 3 * share101); [|lra]. apply encloses_multiply; trivial; try lra.
    right. right. rewrite Rabs_pos_eq; lra. }
  assert (R3 : Rabs (12 * y * y - 3) = 3 - 12 * (y * y)) by (rewrite Rabs_left; lra).
  assert (A3 : encloses (/ 1000000000) (third_slope a) (12 * y * y - 3)).
  { apply encloses_more with (7 * (/ 10000000000 + 0) + 3 * share101); [|lra]. apply encloses_subtract; trivial; rewrite ?R3; lra. }
  destruct (enclosed_within _ _ _ A3 ltac:(lra)) as (g & Wg & Bg). exists g. split; [exact Wg|]. rewrite R3 in *. split; lra.
Qed.

Lemma third_root_encloses : forall s sigma t start y0, is64 start y0 -> Rabs (y0 - t) <= 8 * (unit53 * t) -> / 60000000 <= t <= / 2 ->
  4 * (t * t * t) - 3 * t + sigma = 0 -> sigma <= 5001 / 10000 ->
  is_off s sigma (13 * (unit53 * (unit53 * sigma))) (101 / 100 * sigma) (101 / 100 * (unit53 * sigma)) (/ 10000000000 * sigma) ->
  encloses (3 * share101) s sigma -> encloses (10000 * share101) (newton_root (third_value s) third_slope start) t.
Proof.
  intros s sigma t start y0 Hs H0 Bt E Bs O Es. pose proof unit_is_small as Hu. pose proof share_is_small as Hsh.
  pose proof (third_is_small sigma t Bs ltac:(lra) E) as Hsmall.
  assert (Bst : 27 / 10 * t <= sigma <= 3 * t).
  { assert (0 <= t * t * t) by (repeat apply Rmult_le_pos; lra).
    assert (t * t * t <= 302 / 10000 * t).
    { apply Rmult_le_compat_r; [lra|]. apply Rle_trans with (1737 / 10000 * (1737 / 10000)); [apply Rmult_le_compat; lra|lra]. }
    lra. }
  pose proof (unit_times t ltac:(lra)) as Ut. pose proof (unit_times _ (proj1 Ut)) as UUt.
  assert (St : 0 <= share101 * t) by (apply Rmult_le_pos; lra).
  apply (newton_root_encloses _ _ _ _ y0 t 33 24 (fun y => (4 * y * y - 3) * y + sigma) (fun y => 12 * y * y - 3) (2500 * (share101 * t)) Hs
    ltac:(lra) H0 ltac:(lra) ltac:(lra) (third_step_in_double_double s sigma t E Bt Bs ltac:(lra) O)).
  - exact (third_derivative sigma).
  - cbv beta. lra.
  - intros a m Ea Bm. apply (third_value_within s a m sigma t); trivial; lra.
  - intros a y Ea By. cbv beta. apply Rabs_le_inv in By.
    destruct (third_slope_within a y t Ea ltac:(lra) ltac:(lra)) as (g & Wg & Bg & BD). exists g. split; [exact Wg|]. split; [exact Bg|].
    split; [lra|]. apply Rle_trans with (1000 * (share101 * t) * (26 / 10)); [lra|apply Rmult_le_compat_l; lra].
Qed.

(* ---- s above 1/2: the rest to 1/2 ---- *)

Lemma rest_derivative : forall sigma c, derivable_pt_lim (fun y => (6 - 4 * y) * y * y - sigma) c (12 * c * (1 - c)).
Proof.
  intros sigma c.
  change (fun y => (6 - 4 * y) * y * y - sigma) with
    (minus_fct (mult_fct (mult_fct (minus_fct (fct_cte 6) (mult_fct (fct_cte 4) id)) id) id) (fct_cte sigma)).
  replace (12 * c * (1 - c)) with ((((0 - (0 * id c + fct_cte 4 c * 1)) * id c + minus_fct (fct_cte 6) (mult_fct (fct_cte 4) id) c
    * 1) * id c +
    mult_fct (minus_fct (fct_cte 6) (mult_fct (fct_cte 4) id)) id c * 1) - 0) by (unfold minus_fct, mult_fct, fct_cte, id; ring).
  apply derivable_pt_lim_minus; [|apply derivable_pt_lim_const]. apply derivable_pt_lim_mult; [|apply derivable_pt_lim_id].
  apply derivable_pt_lim_mult; [|apply derivable_pt_lim_id]. apply derivable_pt_lim_minus; [apply derivable_pt_lim_const|].
  apply derivable_pt_lim_mult; [apply derivable_pt_lim_const|apply derivable_pt_lim_id].
Qed.

Lemma rest_value_within : forall r a m sigma t, encloses (3 * share101) r sigma -> encloses 0 a m -> / 100000000 <= t <= 3265 / 10000 ->
  6 * (t * t) - 4 * (t * t * t) = sigma -> Rabs (m - t) <= 400 * (unit53 * (unit53 * t)) ->
  exists e, within e (rest_value r a) ((6 - 4 * m) * m * m - sigma) /\ Rabs ((6 - 4 * m) * m * m - sigma) <= 38 * e /\
    / 1000000000000000000000000000000000000000000000000000000000 <= e <= 4500 * (share101 * (t * t)).
Proof.
  intros r a m sigma t Er Ea Bt Et Bm. pose proof unit_is_small as Hu. pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  pose proof (unit_times t ltac:(lra)) as Ut. pose proof (unit_times _ (proj1 Ut)) as UUt. pose proof (Rabs_le_inv _ _ Bm) as Bm2.
  set (T := t * t) in *. set (V := unit53 * (unit53 * T)).
  assert (EV : share101 * T = 32 * V) by (unfold V; rewrite share_is; ring).
  assert (EWt : unit53 * (unit53 * t) * t = V) by (unfold V, T; ring). set (W := unit53 * (unit53 * t)) in *.
  assert (BT : / 10000000000000000 <= T <= 3265 / 10000 * t).
  { split; [apply Rle_trans with (/ 100000000 * / 100000000); [lra|apply Rmult_le_compat; lra]|apply Rmult_le_compat_r; lra]. }
  assert (BTt : 0 <= t * t * t <= 3265 / 10000 * T).
  { fold T. split; [apply Rmult_le_pos; lra|]. rewrite (Rmult_comm (3265 / 10000)). apply Rmult_le_compat_l; lra. }
  fold T in BTt, Et.
  assert (LV : / 1000000000000000000000000000000000000000000000000000 <= V).
  { unfold V. apply Rle_trans with (unit53 * (unit53 * / 10000000000000000)); [unfold unit53; lra|].
    apply unit_times_compat, unit_times_compat. lra. }
  pose proof (unit_times T ltac:(lra)) as UT. pose proof (unit_times _ (proj1 UT)) as UUT. fold V in UUT.
  assert (By : 9999 / 10000 * t <= m <= 10001 / 10000 * t) by lra.
  assert (Byy : 9997 / 10000 * T <= m * m <= 10003 / 10000 * T).
  { split; [apply Rle_trans with (9999 / 10000 * t * (9999 / 10000 * t)); [unfold T in *; lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (10001 / 10000 * t * (10001 / 10000 * t)); [apply Rmult_le_compat; lra|unfold T in *; lra]. }
  assert (Byt : 0 <= m * t <= 10003 / 10000 * T).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (10001 / 10000 * t * t); [apply Rmult_le_compat_r; lra|unfold T in *; lra]. }
  pose proof (whole_enclosed 4 ltac:(lia)) as E4. pose proof (whole_enclosed 6 ltac:(lia)) as E6.
  assert (A1 : encloses (3 * share101) (multiply (whole_dd 4) a) (4 * m)).
  { apply encloses_more with (3 * (0 + 0) + 3 * share101); [|lra]. apply encloses_multiply; trivial; try lra. right. right.
    rewrite Rabs_pos_eq; lra. }
  set (y := 6 - 4 * m) in *. assert (BY : 469 / 100 <= y <= 6) by (unfold y; lra).
  assert (A2 : encloses (24 * share101) (minus_dd (whole_dd 6) (multiply (whole_dd 4) a)) y).
  { apply encloses_more with (7 * (0 + 3 * share101) + 3 * share101); [|lra].
    apply encloses_subtract; trivial; fold y; rewrite ?(Rabs_pos_eq y); unfold y in *; lra. }
  assert (BYm : 468 / 100 * t <= y * m <= 601 / 100 * t).
  { split; [apply Rle_trans with (469 / 100 * (9999 / 10000 * t)); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (6 * (10001 / 10000 * t)); [apply Rmult_le_compat; lra|lra]. }
  assert (A3 : encloses (75 * share101) (multiply (minus_dd (whole_dd 6) (multiply (whole_dd 4) a)) a) (y * m)).
  { apply encloses_more with (3 * (24 * share101 + 0) + 3 * share101); [|lra]. apply encloses_multiply; trivial; try lra. right. right.
    rewrite Rabs_pos_eq; lra. }
  pose proof (first_size _ _ _ A3 ltac:(lra)) as S3. rewrite (Rabs_pos_eq (y * m)) in S3 by lra.
  pose proof (first_size _ _ _ Ea ltac:(lra)) as Sa.
  rewrite (Rabs_pos_eq m) in Sa by lra. set (b := multiply (minus_dd _ _) a) in *.
  set (v := Rabs (value64 (hi b))) in *. set (w := Rabs (value64 (hi a))) in *.
  destruct (multiply_encloses (75 * share101) 0 b a _ _ A3 Ea ltac:(lra) ltac:(lra) ltac:(lra)) as (A4 & Ca & _).
  { right. fold v w. split; [apply Rle_trans with (/ 1000000000 * / 1000000000); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (4 * 1); [apply Rmult_le_compat; lra|lra]. }
  set (A := y * m * m) in *.
  assert (BA : 468 / 100 * T <= A <= 601 / 100 * T).
  { unfold A. replace (y * m * m) with (y * (m * m)) by ring. split.
    - apply Rle_trans with (469 / 100 * (9997 / 10000 * T)); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with (6 * (10003 / 10000 * T)); [apply Rmult_le_compat; lra|lra]. }
  assert (Bphi : Rabs (A + - sigma) <= 4810 * V).
  { replace (A + - sigma) with ((m - t) * (6 * (m + t) - 4 * (m * m + m * t + T))) by (unfold A, y; rewrite <- Et; unfold T; ring).
    replace (4810 * V) with (400 * W * (12025 / 1000 * t)) by (rewrite <- EWt; field). apply product_size; [exact Bm|].
    apply Rabs_le. lra. }
  assert (RS : Rabs (- sigma) = sigma) by (rewrite Rabs_Ropp, Rabs_pos_eq; lra).
  destruct (sum_within _ _ _ _ A (- sigma) (4810 * V) A4 (encloses_negated _ _ _ Er) ltac:(lra) ltac:(lra) Ca
    ltac:(rewrite Rabs_pos_eq; lra)
    ltac:(rewrite RS; lra) Bphi ltac:(lra)) as (e & We & Low & Up).
  rewrite RS in Up. rewrite (Rabs_pos_eq A) in Low, Up by lra.
  assert (L1 : 468 / 100 * (share101 * T) <= share101 * A).
  { replace (468 / 100 * (share101 * T)) with (share101 * (468 / 100 * T)) by ring. apply Rmult_le_compat_l; lra. }
  assert (L2 : share101 * A <= 601 / 100 * (share101 * T)).
  { replace (601 / 100 * (share101 * T)) with (share101 * (601 / 100 * T)) by ring. apply Rmult_le_compat_l; lra. }
  assert (L3 : share101 * sigma <= 6 * (share101 * T)).
  { replace (6 * (share101 * T)) with (share101 * (6 * T)) by ring. apply Rmult_le_compat_l; lra. }
  assert (L4 : share101 * (4810 * V) <= / 1000 * V).
  { replace (share101 * (4810 * V)) with (4810 * share101 * V) by ring. apply Rmult_le_compat_r; lra. }
  change (A - sigma) with (A + - sigma). exists e. split; [exact We|]. split; [|split]; lra.
Qed.

Lemma rest_slope_within : forall a y t, encloses (/ 1000000000000) a y -> 999 / 1000 * t <= y <= 10001 / 10000 * t ->
  / 100000000 <= t <= 3265 / 10000 ->
  exists g, within g (rest_slope a) (12 * y * (1 - y)) /\ g <= / 2000 * Rabs (12 * y * (1 - y)) /\ 8 * t <= Rabs (12 * y * (1 - y)) <= 900.
Proof.
  intros a y t Ea By Bt. pose proof share_is_small as Hsh.
  pose proof (whole_enclosed 12 ltac:(lia)) as E12. pose proof (whole_enclosed 1 ltac:(lia)) as E1.
  assert (A1 : encloses (/ 100000000000) (multiply (whole_dd 12) a) (12 * y)).
  { apply encloses_more with (3 * (0 + / 1000000000000) + 3 * share101); [|lra]. apply encloses_multiply; trivial; try lra. right. right.
    rewrite Rabs_pos_eq; lra. }
  assert (A2 : encloses (/ 100000000000) (minus_dd (whole_dd 1) a) (1 - y)).
  { apply encloses_more with (7 * (0 + / 1000000000000) + 3 * share101); [|lra]. apply encloses_subtract; trivial;
      rewrite ?(Rabs_pos_eq (1 - y)); lra. }
  assert (BD : 8 * t <= 12 * y * (1 - y) <= 12).
  { split; [apply Rle_trans with (12 * (999 / 1000 * t) * (673 / 1000)); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (12 * 1); [apply Rmult_le_compat; lra|lra]. }
  assert (A3 : encloses (/ 1000000000) (rest_slope a) (12 * y * (1 - y))).
  { apply encloses_more with (3 * (/ 100000000000 + / 100000000000) + 3 * share101); [|lra]. apply encloses_multiply; trivial; try lra.
    right. right. rewrite Rabs_pos_eq; lra. }
  destruct (enclosed_within _ _ _ A3 ltac:(lra)) as (g & Wg & Bg). exists g. split; [exact Wg|].
  rewrite (Rabs_pos_eq (12 * y * (1 - y))) in * by lra. split; lra.
Qed.

Lemma rest_root_encloses : forall r sigma t start y0, is64 start y0 -> Rabs (y0 - t) <= 8 * (unit53 * t) -> / 100000000 <= t <= / 2 ->
  6 * (t * t) - 4 * (t * t * t) = sigma -> sigma <= 5001 / 10000 -> 0 < sigma ->
  is_off r sigma (13 * (unit53 * (unit53 * sigma))) (101 / 100 * sigma) (101 / 100 * (unit53 * sigma)) (/ 10000000000 * sigma) ->
  encloses (3 * share101) r sigma -> encloses (10000 * share101) (newton_root (rest_value r) rest_slope start) t.
Proof.
  intros r sigma t start y0 Hs H0 Bt E Bs Ps O Er. pose proof unit_is_small as Hu. pose proof share_is_small as Hsh.
  pose proof (rest_is_small sigma t Bs ltac:(lra) E) as Hsmall.
  pose proof (unit_times t ltac:(lra)) as Ut. pose proof (unit_times _ (proj1 Ut)) as UUt.
  assert (St : 0 <= share101 * t) by (apply Rmult_le_pos; lra).
  apply (newton_root_encloses _ _ _ _ y0 t (287 / 10) 31 (fun y => (6 - 4 * y) * y * y - sigma) (fun y => 12 * y * (1 - y))
    (4500 * (share101 * (t * t))) Hs ltac:(lra) H0 ltac:(lra) ltac:(lra) (rest_step_in_double_double r sigma t E Bt Bs Ps O)).
  - exact (rest_derivative sigma).
  - cbv beta. lra.
  - intros a m Ea Bm. apply (rest_value_within r a m sigma t); trivial; lra.
  - intros a y Ea By. cbv beta. apply Rabs_le_inv in By.
    destruct (rest_slope_within a y t Ea ltac:(lra) ltac:(lra)) as (g & Wg & Bg & BD). exists g. split; [exact Wg|]. split; [exact Bg|].
    split; [lra|]. apply Rle_trans with (1000 * (share101 * t) * (8 * t)); [|apply Rmult_le_compat_l; lra].
    assert (0 <= share101 * t * t) by (apply Rmult_le_pos; lra). lra.
Qed.

(* ---- sine_of_third ---- *)

Theorem sine_of_third_encloses : forall R w K, parameters R w K ->
  encloses (80000 * share101) (sine_of_third R w) (third_sine (value32 R) (value32 w)).
Proof.
  intros R w K Hp. pose proof unit_is_small as Hu. pose proof share_is_small as Hsh.
    destruct (third_sine_of_half R w K Hp) as (Ht & E & Bs).
  pose proof (half_width_is R w K Hp) as Ih. pose proof Hp as ((FR & _) & HR & Hw & _).
  pose proof (to64_is_exact R FR) as IR. pose proof (two_to_is (-1) ltac:(lia)) as I2. change (bpow radix2 (-1)) with (/ 2) in I2.
  set (t := third_sine _ _) in *. set (s := value32 w / 2 / value32 R) in *. pose proof (unit_times t ltac:(lra)) as Ut.
  assert (quotient : forall v x, is64 v x -> / 1000000000000 <= x <= value32 R ->
    encloses (3 * share101) (divide (exactly64 v) (exactly64 (to64 R))) (x / value32 R)).
  { intros v x I Bx. apply encloses_more with (3 * (0 + 0) + 3 * share101); [|lra].
    pose proof (Rabs_pos_eq x ltac:(lra)) as Rx. pose proof (Rabs_pos_eq (value32 R) ltac:(lra)) as RR.
    apply encloses_divide; try (now apply encloses_exact, exactly_is); try lra.
    apply Rle_trans with 1; [|lra]. apply quotient_size; lra. }
  apply (sine_of_third_cases _ (fun a => encloses (80000 * share101) a t) _ _ _ R w K Hp); fold t; fold s.
  - intros Hs2 (y & Iy & Cy).
    apply encloses_more with (10000 * share101); [|lra].
    apply (third_root_encloses _ s t _ y Iy ltac:(lra) Ht E Hs2 (exact_quotient _ _ _ _ Ih IR ltac:(lra) ltac:(lra) ltac:(lra))).
    apply quotient; [exact Ih|lra].
  - intros ->. apply encloses_more with 0; [|lra]. now apply encloses_exact, exactly_is.
  - set (v := / 2 - t). set (r := (value32 R - value32 w / 2) / value32 R). intros Hv Ev [Br Hr] Bm Im (y & Iy & Cy).
    pose proof (rest_is_small r v Hr ltac:(lra) Ev) as Hsmall.
    pose proof (unit_times v ltac:(lra)) as Uv.
    pose proof (rest_root_encloses _ r v _ y Iy ltac:(lra) Hv Ev Hr ltac:(lra)
      (exact_quotient _ _ _ _ Im IR ltac:(lra) ltac:(lra) ltac:(lra))
      (quotient _ _ Im ltac:(lra))) as Ev2.
    replace t with (/ 2 - v) by (unfold v; ring).
    apply encloses_more with (7 * (0 + 10000 * share101) + 3 * share101); [|lra].
    apply encloses_subtract; trivial; try lra; [now apply encloses_exact, exactly_is|..]; rewrite Rabs_pos_eq; lra.
Qed.
