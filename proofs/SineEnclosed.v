(* SPDX-License-Identifier: BSD-3-Clause *)
(* t = sin(alpha / 3) in double-double with its bound of the error encloses the exact one: sine_of_third of fast/laws/bump_geometry.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms DoubleDoubleOff ThreePolygonsFace.
From Forceshade Require Import ThreePolygonsConstants NewtonStart NewtonRounded NewtonThird NewtonRest SineOfThird.
From Forceshade Require Import Enclosures EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondAlong ThreePolygonsEnclosed NewtonEnclosed.
Open Scope R_scope.

Lemma whole_enclosed : forall n, (Z.abs n < 1000)%Z -> encloses 0 (whole_dd n) (IZR n).
Proof. intros n H. apply encloses_exact, exactly_is, whole_is. lia. Qed.

(* The midpoint is exact, and its interval has whatever is near it. *)
Lemma midpoint_enclosed : forall x h l, is64 (hi x) h -> is64 (lo x) l -> Rabs l <= unit53 * h -> 0 <= h -> encloses 0 (midpoint x) (h + l).
Proof.
  intros x h l H L Bl Bh. exists h, l, 0. unfold midpoint. cbn [hi lo error]. split; [exact H|]. split; [exact L|]. split; [apply zero_is|].
  rewrite nothing_off by reflexivity. rewrite (Rabs_pos_eq h) by exact Bh. split; [exact Bl|]. lra.
Qed.

Lemma widened_enclosed : forall x h l y, is64 (hi x) h -> is64 (lo x) l -> Rabs l <= unit53 * h -> / 1000000000 <= h <= 1 ->
  Rabs (h + l - y) <= / 10000000000000 * h -> encloses (/ 1000000000000) (widened (midpoint x)) y.
Proof.
  intros x h l y H L Bl Bh B. pose proof tiny_is_tinier as Htiny. pose proof (unit_times h ltac:(lra)) as Uh.
  assert (K : bpow radix2 (-40) = / 1099511627776) by reflexivity. pose proof (two_to_is (-40) ltac:(lia)) as I. rewrite K in I.
  pose proof (absolute_is _ _ H) as Ah. rewrite (Rabs_pos_eq h) in Ah by lra.
  pose proof (times_is _ _ _ _ I Ah ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J.
  pose proof (rounded_near (/ 1099511627776 * h) ltac:(lra)) as V. pose proof (unit_times (/ 1099511627776 * h) ltac:(lra)) as UV.
  exists h, l, (nearest64 (/ 1099511627776 * h)). unfold widened, midpoint. cbn [hi lo error]. rewrite (Rabs_pos_eq h) by lra.
  split; [exact H|]. split; [exact L|]. split; [exact J|]. split; [exact Bl|]. split; lra.
Qed.

(* Where a step is good, the root is enclosed: f(m) over the slope anywhere near m. *)
Lemma newton_root_encloses : forall value slope start q y0 t n kappa f f' E, is64 start y0 -> / 100000000 <= t <= 33 / 100 ->
  Rabs (y0 - t) <= 8 * (unit53 * t) -> 0 <= n <= 40 -> 0 <= kappa <= 40 -> step_is_good value slope q t n kappa ->
  (forall c, derivable_pt_lim f c (f' c)) -> f t = 0 ->
  (forall a m, encloses 0 a m -> Rabs (m - t) <= 400 * (unit53 * (unit53 * t)) -> exists e, within e (value a) (f m) /\ Rabs (f m) <= 38 * e /\
    / 1000000000000000000000000000000000000000000000000000000000 <= e <= E) ->
  (forall a y, encloses (/ 1000000000000) a y -> Rabs (y - t) <= 800 * (unit53 * (unit53 * t)) -> exists g, within g (slope a) (f' y) /\
    g <= / 2000 * Rabs (f' y) /\ / 1000000000 <= Rabs (f' y) <= 900 /\ E <= 1000 * (share101 * t) * Rabs (f' y)) ->
  encloses (10000 * share101) (newton_root value slope start) t.
Proof.
  intros value slope start q y0 t n kappa f f' E Hs Bt H0 Hn Hk step Df Ft Hv Hd. pose proof unit_is_small as Hu.
  pose proof share_is_small as Hsh.
  destruct (first_step_is value slope start q y0 t n kappa Hs Bt H0 Hn Hk step) as (h & l & H & L & E1 & Bl & Bh).
  pose proof (unit_times t ltac:(lra)) as Ut. pose proof (unit_times _ (proj1 Ut)) as UUt.
  unfold newton_root. cbv zeta. set (x := minus_dd (exactly64 start) _) in *. clearbody x. set (m := h + l) in *.
  destruct (Hv (midpoint x) m ltac:(apply midpoint_enclosed; trivial; lra) E1) as (e & We & Bf & Be).
  destruct (mean_value f f' m t Df) as (c & Ec & Bc). rewrite Ft, Rminus_0_r in Ec.
  assert (Bct : Rabs (c - t) <= 800 * (unit53 * (unit53 * t))).
  { replace (c - t) with ((m - t) - (m - c)) by ring. apply Rle_trans with (1 := minus_size _ _). lra. }
  destruct (Hd (widened (midpoint x)) c ltac:(apply (widened_enclosed x h l); trivial; fold m; lra) Bct) as (g & Wg & Bg & BD & BE).
  assert (Bet : e <= 1000 * (share101 * t) * Rabs (f' c)) by lra. set (D := f' c) in *. set (d := Rabs D) in *.
  assert (Hd0 : D <> 0) by (intro Z; unfold d in BD; rewrite Z, Rabs_R0 in BD; lra).
  assert (St : 0 <= share101 * t <= / 1000000000000000000000000000000 * t) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Std : 1000 * (share101 * t) * d <= / 1000000 * d) by (apply Rmult_le_compat_r; lra).
  destruct (divide_within _ _ (f m) D e g We Wg Bf ltac:(fold d; lra) ltac:(fold d; lra) ltac:(fold d; lra))
    as (p & r & k & P & R & K & Off & Bp & Br & Bk). fold d in Bp, Br, Bk.
  replace (f m / D) with (m - t) in Off by (rewrite Ec; field; exact Hd0).
  assert (Bed : 0 <= e / d <= 1000 * (share101 * t)).
  { split; [apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]|]. apply Rmult_le_reg_r with d; [lra|].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. exact Bet. }
  apply encloses_more with (3 * (3000 * share101) + 3 * share101); [|lra].
  apply (step_encloses (3000 * share101) _ _ t h l p r k); trivial; try lra.
  - apply zero_is.
  - apply Rle_trans with (1 := Br). replace (210 * (unit53 * (e / d))) with (unit53 * (210 * (e / d))) by ring. apply unit_times_compat. lra.
Qed.

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
  intros s a m sigma t Es Ea Bt Et Bs Bm. pose proof unit_is_small as Hu. pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
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
  { apply encloses_more with (3 * (0 + 0) + 3 * share101); [|lra]. apply encloses_multiply; trivial; try lra. right. right. rewrite Rabs_pos_eq; lra. }
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
  assert (L4 : share101 * (1200 * W) <= / 1000 * W) by (replace (share101 * (1200 * W)) with (1200 * share101 * W) by ring; apply Rmult_le_compat_r; lra).
  assert (LW : / 10000000000000000000000000000000000000000 <= W).
  { unfold W. apply Rle_trans with (unit53 * (unit53 * / 60000000)); [unfold unit53; lra|]. apply unit_times_compat, unit_times_compat. lra. }
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
