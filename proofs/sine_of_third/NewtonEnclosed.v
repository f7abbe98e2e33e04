(* SPDX-License-Identifier: BSD-3-Clause *)
(* The last step of Newton's method in double-double with its bound of the error: newton_root of fast/laws/bump_geometry.h. The root is
   in m - f(m) / f'(X), where m is the midpoint of an interval X that has the root in it. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms DoubleDoubleOff Enclosures.
From Forceshade Require Import EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondAlong NewtonThird
  NewtonRounded SineOfThird.
Open Scope R_scope.

Lemma mean_value : forall f f' a b, (forall c, derivable_pt_lim f c (f' c)) ->
  exists c, f a - f b = f' c * (a - b) /\ Rabs (a - c) <= Rabs (a - b).
Proof.
  intros f f' a b D. destruct (Rtotal_order a b) as [H|[<-|H]].
  - destruct (MVT_cor2 f f' a b H (fun c _ => D c)) as (c & E & Hc). exists c. split; [lra|]. rewrite !Rabs_left; lra.
  - exists a. split; [ring|]. apply Rle_refl.
  - destruct (MVT_cor2 f f' b a H (fun c _ => D c)) as (c & E & Hc). exists c. split; [lra|]. rewrite !Rabs_pos_eq; lra.
Qed.

(* Of the number that is enclosed, the bound is e. *)
Definition within (e : R) (a : double_double) (x : R) : Prop :=
  exists h l, is64 (hi a) h /\ is64 (lo a) l /\ is64 (error a) e /\ Rabs l <= unit53 * Rabs h /\ 0 <= e /\ Rabs (h + l - x) <= e.

Lemma enclosed_within : forall s a x, encloses s a x -> 0 <= s <= / 1000 -> exists e, within e a x /\ e <= s * (101 / 100 * Rabs x).
Proof.
  intros s a x Ea Hs. pose proof (first_size _ _ _ Ea Hs) as S. destruct Ea as (h & l & e & H & L & E & Bl & Be & B).
  rewrite (proj1 H) in S. exists e. split; [exists h, l; repeat (split; [assumption|]); split; [lra|exact B]|].
  apply Rle_trans with (1 := proj2 Be). apply Rmult_le_compat_l; lra.
Qed.

(* A sum of which almost everything cancels: its bound is that of the terms. *)
Lemma sum_within : forall s t a b A B phi, encloses s a A -> encloses t b B -> 0 <= s <= / 1000 -> 0 <= t <= / 1000 -> charged a ->
  / 100000000000000000 <= Rabs A <= 1000 -> / 100000000000000000 <= Rabs B <= 1000 -> Rabs (A + B) <= phi -> phi <= 1000 ->
  exists e, within e (add a b) (A + B) /\
    97 / 100 * (share101 * Rabs A) <= e <= 3 * (s * Rabs A + t * Rabs B) + 3 * (share101 * phi) + 11 * tiny.
Proof.
  intros s t a b A B phi Ea Eb Hs Ht Ca BA BB Bphi Hphi. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  pose proof share_is_small as Hsh.
  pose proof (sum_contains s t a b A B Ea Eb Hs Ht ltac:(right; lra) ltac:(right; lra)) as (h & l & g & H & L & G & Bl & Hg & Bg & Bh).
  pose proof (first_size _ _ _ Ea Hs) as Sa. pose proof (first_size _ _ _ Eb Ht) as Sb.
  destruct Ea as (h1 & l1 & e & H1 & L1 & E1 & Bl1 & Be & B1), Eb as (c & k & f & H2 & L2 & E2 & Bk & Bf & B2).
  unfold charged in Ca. rewrite (proj1 H1), (proj1 E1) in Ca. rewrite (proj1 H1) in Sa. rewrite (proj1 H2) in Sb.
  assert (Be2 : e <= s * (101 / 100 * Rabs A)) by (apply Rle_trans with (1 := proj2 Be); apply Rmult_le_compat_l; lra).
  assert (Bf2 : f <= t * (101 / 100 * Rabs B)) by (apply Rle_trans with (1 := proj2 Bf); apply Rmult_le_compat_l; lra).
  assert (BsA : 0 <= s * Rabs A <= / 1000 * Rabs A) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (BtB : 0 <= t * Rabs B <= / 1000 * Rabs B) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  exists g. split; [exists h, l; now repeat (split; [assumption|])|].
  destruct (error_of_two (hi (add a b)) h (error a) (error b) e f H ltac:(lra) E1 E2 ltac:(lra) ltac:(lra)) as (g1 & G1 & Lg).
  change (error_of (hi (add a b)) (plus (error a) (error b))) with (error (add a b)) in G1. rewrite (is64_same _ _ _ G1 G) in Lg.
    clear g1 G1.
  destruct (plus_close _ _ _ _ E1 E2 ltac:(rewrite !Rabs_pos_eq; lra)) as [I C]. rewrite (Rabs_pos_eq (e + f)) in C by lra.
  pose proof (unit_times (e + f) ltac:(lra)) as Uef. pose proof (proj1 (rounded_up (e + f) (e + f) ltac:(lra))) as N1.
  set (r := nearest64 (e + f)) in *. apply Rabs_le_inv in C.
  destruct (error_of_is (hi (add a b)) h _ r (1001 / 1000 * (e + f)) H I ltac:(lra) ltac:(lra) ltac:(lra)) as (g1 & G1 & Ug & _).
  change (error_of (hi (add a b)) (plus (error a) (error b))) with (error (add a b)) in G1. rewrite (is64_same _ _ _ G1 G) in Ug.
    clear g1 G1.
  assert (PA : 0 <= share101 * Rabs A) by (apply Rmult_le_pos; lra).
  assert (Low : 99 / 100 * (share101 * Rabs A) <= share101 * Rabs h1).
  { replace (99 / 100 * (share101 * Rabs A)) with (share101 * (99 / 100 * Rabs A)) by ring. apply Rmult_le_compat_l; lra. }
  split; [lra|].
  pose proof (unit_times _ (Rabs_pos h)) as Uh. pose proof (size_by (h + l) (A + B)) as S1. pose proof (size_by h (h + l)) as S2.
  replace (h - (h + l)) with (- l) in S2 by ring. rewrite Rabs_Ropp in S2.
  assert (Sh : share101 * Rabs h <= share101 * (101 / 100 * (phi + g))) by (apply Rmult_le_compat_l; lra).
  assert (Sg : share101 * g <= / 1000000 * g) by (apply Rmult_le_compat_r; lra).
  assert (Sp : 0 <= share101 * phi) by (apply Rmult_le_pos; [lra|pose proof (Rabs_pos (A + B)); lra]). lra.
Qed.

(* ---- The quotient ---- *)

Lemma divide_within : forall a b F D e f, within e a F -> within f b D -> Rabs F <= 38 * e -> f <= / 2000 * Rabs D ->
  / 1000000000 <= Rabs D <= 900 -> / 1000000000000000000000000000000000000000000000000000000000 <= e <= / 1000 * Rabs D ->
  exists p q g, is64 (hi (divide a b)) p /\ is64 (lo (divide a b)) q /\ is64 (error (divide a b)) g /\ Rabs (p + q - F / D) <= g /\
    Rabs p <= 130 * (e / Rabs D) /\ Rabs q <= 210 * (unit53 * (e / Rabs D)) /\ 0 <= g <= 3 * (e / Rabs D).
Proof.
  intros a b F D e f (h & l & H & L & E & Bl & _ & B) (c & k & H' & L' & E' & Bk & Bf0 & B') BF Bf BD Be.
  pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny. pose proof share_is_small as Hsh.
  pose proof (unit_times _ (Rabs_pos h)) as Uh. pose proof (unit_times _ (Rabs_pos c)) as Uc.
  assert (Bh : Rabs h <= 40 * e).
  { pose proof (size_by (h + l) F) as S1. pose proof (size_by h (h + l)) as S2. replace (h - (h + l)) with (- l) in S2 by ring.
    rewrite Rabs_Ropp in S2. lra. }
  set (v := c + k) in *. pose proof (size_by D v) as S1. rewrite (Rabs_minus_sym D) in S1. pose proof (size_by v D) as S2.
  pose proof (size_by c v) as S3. pose proof (size_by v c) as S4. replace (c - v) with (- k) in S3 by (unfold v; ring).
  replace (v - c) with k in S4 by (unfold v; ring). rewrite Rabs_Ropp in S3. set (C := Rabs c) in *. set (d := Rabs D) in *.
  assert (BC : 999 / 1000 * d <= C <= 1001 / 1000 * d) by lra.
  set (X := e / C). assert (XC : X * C = e) by (unfold X; field; lra). assert (BX : 0 < X) by (apply Rdiv_lt_0_compat; lra).
  set (Y := e / d). assert (YD : Y * d = e) by (unfold Y; field; lra).
  assert (BXY : X <= 1002 / 1000 * Y).
  { apply Rmult_le_reg_r with C; [lra|]. rewrite XC, <- YD. assert (0 < Y) by (apply Rdiv_lt_0_compat; lra).
    replace (1002 / 1000 * Y * C) with (Y * (1002 / 1000 * C)) by ring. apply Rmult_le_compat_l; lra. }
  assert (BX1 : X <= / 10) by (apply Rmult_le_reg_r with C; [lra|]; rewrite XC; lra).
  set (Q := 40 * X). assert (QC : Q * C = 40 * e) by (unfold Q; rewrite <- XC; ring).
  destruct (quotient_of_is_off (hi a) (lo a) (hi b) (lo b) h l c k Q H L H' L' ltac:(fold C; lra) ltac:(fold C; lra) ltac:(fold C; lra)
    ltac:(fold C; lra) ltac:(fold C; lra) ltac:(unfold Q; lra)) as (p & q & P & Qt & Off & Bp & Bq). fold v in Off.
  destruct (size_is _ c f H' _ E' ltac:(fold C; lra) ltac:(fold C; lra)) as (z & Z & Bz). fold C in Bz.
  unfold divide. cbv zeta. rewrite (less_is _ _ _ _ zero_is Z), Rlt_bool_true by lra. cbn [negb]. unfold rounded. cbn [hi lo error].
  (* the bound of the error *)
  pose proof (Rabs_pos p) as Pp. set (M := Rabs p * f). set (N := e + M).
  assert (uX : 0 < unit53 * X <= / 1000000000000 * X) by (split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (uQ : unit53 * Q = 40 * (unit53 * X)) by (unfold Q; ring). rewrite uQ in *.
  assert (BM : 0 <= M <= 7 / 100 * e).
  { unfold M. split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (3 * Q * (/ 1900 * C)); [apply Rmult_le_compat; lra|].
    replace (3 * Q * (/ 1900 * C)) with (3 / 1900 * (Q * C)) by field. rewrite QC. lra. }
  pose proof (times_is _ _ _ _ (absolute_is _ _ P) E' ltac:(apply big_enough; fold M; rewrite Rabs_pos_eq; lra)) as J1. fold M in J1.
  pose proof (rounded_near M (proj1 BM)) as R1. pose proof (proj1 (rounded_up M M ltac:(lra))) as N1.
    pose proof (unit_times M (proj1 BM)) as U1.
  set (v1 := nearest64 M) in *. pose proof (unit_times e ltac:(lra)) as Ue.
  assert (Te : tiny <= / 1000 * (unit53 * e)) by (unfold unit53; lra).
  pose proof (plus_is _ _ _ _ E J1 ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J2.
  pose proof (rounded_near (e + v1) ltac:(lra)) as R2.
  assert (U2 : unit53 * (e + v1) <= unit53 * (101 / 100 * N)) by (apply unit_times_compat; unfold N; lra).
  set (num := nearest64 (e + v1)) in *. pose proof (unit_times N ltac:(unfold N; lra)) as UN.
  assert (EN : unit53 * N = unit53 * e + unit53 * M) by (unfold N; ring).
  assert (Nnum : N - 4 * (unit53 * N) <= num <= N + 4 * (unit53 * N)) by (unfold N in *; lra).
  set (r := N / z). assert (rz : r * z = N) by (unfold r; field; lra).
  assert (Br : X <= r <= 109 / 100 * X).
  { assert (BN : e <= N <= 107 / 100 * e) by (unfold N; lra). split; apply Rmult_le_reg_r with z; try lra; rewrite rz.
    - apply Rle_trans with (X * C); [apply Rmult_le_compat_l; lra|lra].
    - apply Rle_trans with (109 / 100 * X * (99 / 100 * C)); [|apply Rmult_le_compat_l; lra].
      replace (109 / 100 * X * (99 / 100 * C)) with (10791 / 10000 * (X * C)) by field. rewrite XC. lra. }
  pose proof (unit_times r ltac:(lra)) as Ur. pose proof (unit_times _ (proj1 Ur)) as UUr.
  assert (uXr : unit53 * X <= unit53 * r) by (apply unit_times_compat; lra).
  assert (Tr : tiny <= / 1000 * (unit53 * r)).
  { apply Rle_trans with (/ 1000 * (unit53 * (/ 1000 * e))); [unfold unit53; lra|]. apply Rmult_le_compat_l; [lra|].
    apply unit_times_compat. apply Rle_trans with X; [|lra]. apply Rmult_le_reg_r with C; [lra|]. rewrite XC.
    replace (/ 1000 * e * C) with (e * (/ 1000 * C)) by ring. apply Rle_trans with (e * 1); [apply Rmult_le_compat_l; lra|lra]. }
  assert (Bratio : r - 4 * (unit53 * r) <= num / z <= r + 4 * (unit53 * r)).
  { split; apply Rmult_le_reg_r with z; try lra; unfold Rdiv; rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
    - replace ((r - 4 * (unit53 * r)) * z) with (r * z - 4 * (unit53 * (r * z))) by ring. rewrite rz. lra.
    - replace ((r + 4 * (unit53 * r)) * z) with (r * z + 4 * (unit53 * (r * z))) by ring. rewrite rz. lra. }
  pose proof (over_is _ _ _ _ J2 Z ltac:(lra) ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J3.
  pose proof (rounded_near (num / z) ltac:(lra)) as R3.
  assert (U3 : unit53 * (num / z) <= unit53 * (101 / 100 * r)) by (apply unit_times_compat; lra).
  set (w := nearest64 (num / z)) in *.
  assert (Bw : r - 6 * (unit53 * r) <= w <= r + 6 * (unit53 * r)) by lra.
  assert (Uw : unit53 * (99 / 100 * r) <= unit53 * w) by (apply unit_times_compat; lra).
  destruct (error_is_at_least _ p _ w P J3 ltac:(lra) ltac:(unfold Q in Bp; lra)) as (g & G & _ & Lg).
  destruct (error_of_is _ p _ w (101 / 100 * r) P J3 ltac:(lra) ltac:(lra) ltac:(unfold Q in Bp; lra)) as (g' & G' & Ug & _).
  rewrite (is64_same _ _ _ G' G) in Ug. clear g' G'.
  assert (Sp : share101 * Rabs p <= / 1000000 * Rabs p) by (apply Rmult_le_compat_r; lra).
  exists p, q, g. split; [exact P|]. split; [exact Qt|]. split; [exact G|].
  split; [|unfold Q in Bp; split; [lra|split; [|lra]]].
  2: { apply Rle_trans with (1 := Bq). assert (unit53 * X <= unit53 * (1002 / 1000 * Y)) by (apply unit_times_compat; lra). lra. }
  (* what is held, and what is meant *)
  assert (Hd : D <> 0) by (intro Z0; unfold d in BD; rewrite Z0, Rabs_R0 in BD; lra).
  assert (Hv : v <> 0) by (intro Z0; rewrite Z0, Rabs_R0 in S3; lra).
  set (T := (h + l) / v) in *. assert (Tv : T * v = h + l) by (unfold T; field; exact Hv).
  assert (BT : Rabs T * f <= M + unit53 * e).
  { assert (S5 : Rabs T <= Rabs p + 1000 * (unit53 * X)).
    { pose proof (size_by T (p + q)) as S6. rewrite (Rabs_minus_sym T) in S6. pose proof (Rabs_triang p q). lra. }
    apply Rle_trans with ((Rabs p + 1000 * (unit53 * X)) * f); [apply Rmult_le_compat_r; lra|]. fold M.
    replace ((Rabs p + 1000 * (unit53 * X)) * f) with (M + unit53 * (X * (1000 * f))) by (unfold M; ring).
    apply Rplus_le_compat_l, unit_times_compat. rewrite <- XC. apply Rmult_le_compat_l; lra. }
  assert (Off2 : Rabs (T - F / D) <= r + unit53 * r).
  { replace (T - F / D) with ((h + l - F - T * (v - D)) / D) by (rewrite <- Tv; field; exact Hd).
    apply quotient_size; [fold d; lra|]. fold d. apply Rle_trans with (1 := minus_size _ _).
    pose proof (product_size T (v - D) _ _ (Rle_refl _) B') as S6.
    apply Rle_trans with ((r + unit53 * r) * z); [|apply Rmult_le_compat_l; lra].
    replace ((r + unit53 * r) * z) with (r * z + unit53 * (r * z)) by ring. rewrite rz. unfold N in *. lra. }
  replace (p + q - F / D) with ((p + q - T) + (T - F / D)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

(* ---- The step ---- *)

Lemma step_encloses : forall s a b t h l p q g, is64 (hi a) h -> is64 (lo a) l -> is64 (error a) 0 -> Rabs l <= unit53 * h ->
  is64 (hi b) p -> is64 (lo b) q -> is64 (error b) g -> Rabs (p + q - (h + l - t)) <= g -> / 1000000000 <= t <= 1 ->
  99 / 100 * t <= h <= 101 / 100 * t -> Rabs p <= / 1000 * t -> Rabs q <= unit53 * (/ 1000 * t) -> 0 <= g <= s * t -> s <= / 1000 ->
  encloses (3 * s + 3 * share101) (minus_dd a b) t.
Proof.
  intros s a b t h l p q g H L E Bl P Q G B Bt Bh Bp Bq Bg Hs. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  pose proof share_is_small as Hsh. apply Rabs_le_inv in Bp as Bp'. pose proof (unit_times t ltac:(lra)) as Ut.
  assert (Uh : unit53 * h <= unit53 * (101 / 100 * t)) by (apply unit_times_compat; lra).
  assert (st : s * t <= / 1000 * t) by (apply Rmult_le_compat_r; lra).
  destruct (sum_of_is_off (hi a) (lo a) (opp (hi b)) (opp (lo b)) h l (- p) (- q) (102 / 100 * t) (102 / 100 * (unit53 * t)) H L
    (opp_is _ _ P)
    (opp_is _ _ Q) ltac:(rewrite Rabs_pos_eq; lra) ltac:(rewrite Rabs_Ropp; lra) ltac:(rewrite Rabs_pos_eq; lra)
      ltac:(rewrite Rabs_Ropp; lra)
    ltac:(lra)) as (x & y & X & Y & Off & Bx & _ & _ & Two).
  specialize (Two ltac:(lra) ltac:(lra)). pose proof (unit_times _ (proj1 Ut)) as UUt.
  replace (21 / 10 * unit53 * (unit53 * (102 / 100 * t) + 102 / 100 * (unit53 * t)))
    with (4284 / 1000 * (unit53 * (unit53 * t))) in Off by field.
  assert (Bx2 : 97 / 100 * t <= x <= 12 / 10 * t).
  { assert (Px : 0 <= x).
    { destruct (Rle_lt_dec 0 x) as [|Hn]; [assumption|exfalso]. pose proof (Rabs_pos y).
      assert (unit53 * x < 0) by (replace 0 with (unit53 * 0) by ring; apply Rmult_lt_compat_l; lra). lra. }
    rewrite (Rabs_pos_eq x) in Bx by exact Px. pose proof (unit_times x Px) as Ux. absolute_values. lra. }
  assert (Ie : is64 (plus (error a) (error (negated b))) g).
  { apply (plus_exact _ _ 0 g); [exact E|exact G|ring|exact (format_of _ _ G)|apply big_enough; rewrite Rabs_pos_eq; lra]. }
  destruct (error_covers _ x _ g g X Ie ltac:(lra) ltac:(lra) ltac:(rewrite Rabs_pos_eq; lra)) as (f & F & Bf).
  rewrite (Rabs_pos_eq x) in Bf by lra. pose proof (unit_times g (proj1 Bg)) as Ug.
  assert (Hshare : 31 * (unit53 * (unit53 * t)) <= share101 * x).
  { rewrite share_is. replace (32 * (unit53 * unit53) * x) with (unit53 * (unit53 * (32 * x))) by ring.
    replace (31 * (unit53 * (unit53 * t))) with (unit53 * (unit53 * (31 * t))) by ring. apply unit_times_compat, unit_times_compat. lra. }
  unfold minus_dd, add, rounded. exists x, y, f. cbn [hi lo error negated]. rewrite (Rabs_pos_eq x) by lra.
  split; [exact X|]. split; [exact Y|]. split; [exact F|]. split; [exact Two|]. split.
  - split; [lra|]. assert (s * t <= s * (104 / 100 * x)); [|lra]. apply Rmult_le_compat_l; [|lra].
    apply Rmult_le_reg_r with t; [lra|]. lra.
  - replace (x + y - t) with ((x + y - (h + l + (- p + - q))) - (p + q - (h + l - t))) by ring.
    apply Rle_trans with (1 := minus_size _ _). lra.
Qed.

(* ---- The root ---- *)

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
  (forall a m, encloses 0 a m -> Rabs (m - t) <= 400 * (unit53 * (unit53 * t)) -> exists e, within e (value a) (f m) /\
    Rabs (f m) <= 38 * e /\
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
  assert (St : 0 <= share101 * t <= / 1000000000000000000000000000000 * t) by (split;
    [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
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
  - apply Rle_trans with (1 := Br). replace (210 * (unit53 * (e / d))) with (unit53 * (210 * (e / d))) by ring.
    apply unit_times_compat. lra.
Qed.
