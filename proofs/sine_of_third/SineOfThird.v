(* SPDX-License-Identifier: BSD-3-Clause *)
(* t = sin(alpha / 3) as double-double computes it: newton_root and sine_of_third of fast/laws/bump_geometry.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms DoubleDoubleOff ThreePolygonsFace.
From Forceshade Require Import NewtonStart NewtonRounded.
From Forceshade Require Import NewtonThird NewtonRest.
Open Scope R_scope.

(* What is required of a step: it is few units off, and it comes nearer. *)
Definition step_is_good (value slope : double_double -> double_double) (q : R -> R) (t n kappa : R) : Prop :=
  forall a b y rho, argument a y t -> argument b y t -> 0 <= rho <= 9 * unit53 -> Rabs (y - t) <= rho * t ->
    is_off (divide (value a) (slope b)) (q y) (n * (unit53 * (unit53 * t)) + kappa * (unit53 * (rho * t))) (50 * (unit53 * t))
      (80 * (unit53 * (unit53 * t))) (/ 10000000 * t) /\
    Rabs (y - q y - t) <= 56 / 100 * (rho * rho) * t.

(* u, ut and u(ut), of which errors are multiples, and how small they are. *)
Ltac errors_in_units t n kappa :=
  set (u := unit53) in *;
  set (U := u * t) in *;
  set (W := u * U) in *;
  assert (EU : u * t = U) by reflexivity;
  assert (EW : u * U = W) by reflexivity;
  assert (EWW : u * (u * t) = W) by reflexivity;
  assert (EWt : u * (u * (t * t)) = t * W) by (unfold W, U; ring);
  assert (BU : 0 < U <= / 1000000000000 * t) by (unfold U; split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]);
  assert (BW : 0 < W <= / 1000000000000 * U) by (unfold W; split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]);
  assert (nW : 0 <= n * W <= 40 * W) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]);
  assert (kW : 0 <= kappa * W <= 40 * W) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]);
  assert (uuW : u * W <= / 1000000000000 * W) by (apply Rmult_le_compat_r; lra).

(* Where a step is good, so is the midpoint after the first one. *)
Lemma first_step_is : forall value slope start q y0 t n kappa, is64 start y0 -> / 100000000 <= t <= 33 / 100 ->
  Rabs (y0 - t) <= 8 * (unit53 * t) -> 0 <= n <= 40 -> 0 <= kappa <= 40 -> step_is_good value slope q t n kappa ->
  let x := minus_dd (exactly64 start) (divide (value (exactly64 start)) (slope (exactly64 start))) in
  exists h l, is64 (hi x) h /\ is64 (lo x) l /\ Rabs (h + l - t) <= 400 * (unit53 * (unit53 * t)) /\ Rabs l <= unit53 * h /\
    9999 / 10000 * t <= h <= 1001 / 1000 * t.
Proof.
  intros value slope start q y0 t n kappa Hs Bt H0 Hn Hk step. unfold step_is_good in step. pose proof unit_is_small as Hu.
  errors_in_units t n kappa.
  pose proof (Rabs_le_inv _ _ H0) as B0.
  assert (A0 : argument (exactly64 start) y0 t).
  { unfold argument. fold u. apply (is_off_more _ _ 0 (1001 / 1000 * t) 0 0); try lra. apply is_off_exactly; [exact Hs|].
    rewrite Rabs_pos_eq; lra. }
  destruct (step _ _ _ (8 * u) A0 A0 ltac:(lra) ltac:(fold U in H0 |- *; replace (8 * u * t) with (8 * U) by (unfold U; ring); exact H0))
    as [Q0 N0].
  replace (kappa * (u * (8 * u * t))) with (8 * (kappa * W)) in Q0 by (unfold W, U; ring).
  replace (56 / 100 * (8 * u * (8 * u)) * t) with (3584 / 100 * W) in N0 by (unfold W, U; field).
  pose proof (Rabs_le_inv _ _ N0) as N0'.
  pose proof (is_off_exactly start y0 (1001 / 1000 * t) Hs ltac:(rewrite Rabs_pos_eq; lra)) as X0.
  assert (S0 : Rabs (y0 + - q y0) + 0 + (n * W + 8 * (kappa * W)) + 80 * W <= 10001 / 10000 * t).
  { assert (Rabs (y0 + - q y0) <= t + 36 * W); [apply Rabs_le|]; lra. }
  destruct (is_off_add _ _ _ _ _ _ _ _ _ _ _ _ (10001 / 10000 * t) (80 * W) (12 / 10 * t) X0 (is_off_negated _ _ _ _ _ _ Q0) ltac:(lra)
    ltac:(lra) ltac:(lra) S0 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as [(h & l & k & Hh & Hl & Hk1 & E & Bh & _ & Bk) Two].
  destruct (Two ltac:(lra) ltac:(lra)) as (p & r & P & R & Br). clear Two.
  assert (Ep : p = h) by exact (eq_trans (eq_sym (proj1 P)) (proj1 Hh)).
  assert (Er : r = l) by exact (eq_trans (eq_sym (proj1 R)) (proj1 Hl)).
  subst p r. fold u in E.
  assert (E1 : Rabs (h + l - t) <= 400 * W).
  { replace (h + l - t) with ((h + l - (y0 + - q y0)) + (y0 - q y0 - t)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  pose proof (Rabs_le_inv _ _ E1) as E1'. pose proof (Rabs_le_inv _ _ Br) as Br'. fold u in Br, Br'.
  assert (Ph : 0 <= h).
  { destruct (Rle_or_lt 0 h) as [G|G]; [exact G|exfalso]. assert (u * h < 0) by (replace 0 with (u * 0) by ring;
    now apply Rmult_lt_compat_l).
    lra. }
  assert (Uh : 0 <= u * h <= / 1000000000000 * h) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Bh2 : 9999 / 10000 * t <= h <= 1001 / 1000 * t) by lra.
  exists h, l. split; [exact Hh|]. split; [exact Hl|]. split; [exact E1|]. split; [exact Br|lra].
Qed.

(* So is the root that double-double finds. *)
Lemma newton_root_is : forall value slope start q y0 t n kappa, is64 start y0 -> / 100000000 <= t <= 33 / 100 ->
  Rabs (y0 - t) <= 8 * (unit53 * t) -> 0 <= n <= 40 -> 0 <= kappa <= 40 -> step_is_good value slope q t n kappa ->
  exists h l k, is64 (hi (newton_root value slope start)) h /\ is64 (lo (newton_root value slope start)) l /\
    is64 (error (newton_root value slope start)) k /\ Rabs (h + l - t) <= (n + 9 / 2) * (unit53 * (unit53 * t)) /\
    Rabs l <= unit53 * h /\ 0 <= k <= / 1000000 * t.
Proof.
  intros value slope start q y0 t n kappa Hs Bt H0 Hn Hk step. unfold step_is_good in step. pose proof unit_is_small as Hu.
  destruct (first_step_is value slope start q y0 t n kappa Hs Bt H0 Hn Hk step) as (h & l & Hh & Hl & E1 & Br & Bh2).
  errors_in_units t n kappa.
  unfold newton_root. cbv zeta. set (x := minus_dd (exactly64 start) _) in *. clearbody x. unfold minus_dd.
  pose proof (Rabs_le_inv _ _ E1) as E1'. pose proof (Rabs_le_inv _ _ Br) as Br'.
  assert (Uh : 0 <= u * h <= / 1000000000000 * h) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Uh2 : u * h <= u * (1001 / 1000 * t)) by (apply Rmult_le_compat_l; lra).
  assert (A1 : argument (midpoint x) (h + l) t).
  { unfold argument, is_off, midpoint. cbn [hi lo error]. exists h, l, 0.
    split; [exact Hh|]. split; [exact Hl|]. split; [apply zero_is|].
    rewrite Rminus_diag_eq, Rabs_R0 by reflexivity.
    split; [lra|]. split; [rewrite Rabs_pos_eq; lra|]. split; [fold u; lra|lra]. }
  assert (A2 : argument (widened (midpoint x)) (h + l) t).
  { assert (K : bpow radix2 (-40) = / 1099511627776) by reflexivity. pose proof (two_to_is (-40) ltac:(lia)) as I. rewrite K in I.
    pose proof (absolute_is _ _ Hh) as Ah. rewrite (Rabs_pos_eq h) in Ah by lra.
    pose proof (times_is _ _ _ _ I Ah ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J.
    pose proof (rounded_up (/ 1099511627776 * h) (/ 1099511627776 * h) ltac:(lra)) as V. fold u in V. pose proof tiny_is_tiny as Htiny.
    unfold argument, is_off, widened, midpoint. cbn [hi lo error].
    exists h, l, (nearest64 (/ 1099511627776 * h)). split; [exact Hh|]. split; [exact Hl|]. split; [exact J|].
    rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. split; [lra|]. split; [rewrite Rabs_pos_eq; lra|]. split; [fold u; lra|lra]. }
  (* the second step *)
  assert (Z400 : 400 * (u * u) <= 9 * u) by (assert (u * u <= / 1000000000000 * u) by (apply Rmult_le_compat_r; lra); lra).
  destruct (step _ _ _ (400 * (u * u)) A1 A2 ltac:(split; [apply Rmult_le_pos; [lra|apply Rmult_le_pos; lra]|exact Z400])
    ltac:(replace (400 * (u * u) * t) with (400 * W) by (unfold W, U; ring); exact E1)) as [Q1 N1].
  replace (kappa * (u * (400 * (u * u) * t))) with (400 * (kappa * (u * W))) in Q1 by (unfold W, U; ring).
  replace (56 / 100 * (400 * (u * u) * (400 * (u * u))) * t) with (89600 * (u * (u * W))) in N1 by (unfold W, U; field).
  assert (uW : 0 <= u * W) by (apply Rmult_le_pos; lra).
  assert (kuW : 0 <= kappa * (u * W) <= 40 * (u * W)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (uuW2 : u * (u * W) <= / 1000000000000 * (u * W)) by (apply Rmult_le_compat_r; lra).
  pose proof (Rabs_le_inv _ _ N1) as N1'. unfold argument in A1.
  assert (S1 : Rabs (h + l + - q (h + l)) + 0 + (n * W + 400 * (kappa * (u * W))) + 102 / 100 * U <= 10001 / 10000 * t).
  { assert (Rabs (h + l + - q (h + l)) <= t + W); [apply Rabs_le|]; lra. }
  assert (A3 : is_off (midpoint x) (h + l) 0 (1001 / 1000 * t) (101 / 100 * (u * (1001 / 1000 * t))) 0).
  { unfold is_off, midpoint. cbn [hi lo error]. exists h, l, 0.
    split; [exact Hh|]. split; [exact Hl|]. split; [apply zero_is|].
    rewrite Rminus_diag_eq, Rabs_R0 by reflexivity.
    split; [lra|]. split; [rewrite Rabs_pos_eq; lra|]. split; [fold u; lra|lra]. }
  destruct (is_off_add _ _ _ _ _ _ _ _ _ _ _ _ (10001 / 10000 * t) (102 / 100 * U) (12 / 10 * t) A3
    (is_off_negated _ _ _ _ _ _ Q1) ltac:(lra)
    ltac:(lra) ltac:(lra) S1 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as [(h' & l' & k' & Hh' & Hl' & Hk' & E' & _ & _ & Bk') Two].
  destruct (Two ltac:(lra) ltac:(lra)) as (p & r & P2 & R2 & Br2). clear Two.
  assert (Ep2 : p = h') by exact (eq_trans (eq_sym (proj1 P2)) (proj1 Hh')).
  assert (Er2 : r = l') by exact (eq_trans (eq_sym (proj1 R2)) (proj1 Hl')).
  subst p r. exists h', l', k'. split; [exact Hh'|]. split; [exact Hl'|]. split; [exact Hk'|]. split; [|split; [exact Br2|lra]].
  replace (h' + l' - t) with ((h' + l' - (h + l + - q (h + l))) + (h + l - q (h + l) - t)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). fold u in E'. lra.
Qed.

(* ---- sine_of_third ---- *)

Lemma holds_by : forall a x n, / 60000000 <= x <= / 2 -> 0 <= n <= 69 ->
  (exists h l k, is64 (hi a) h /\ is64 (lo a) l /\ is64 (error a) k /\ Rabs (h + l - x) <= n * (unit53 * (unit53 * x)) /\
    Rabs l <= unit53 * h /\ 0 <= k <= / 20000 * x) -> holds 70 (/ 10000) a x.
Proof.
  intros a x n Hx Hn (h & l & k & H & L & K & E & Bl & Bk). pose proof unit_is_small as Hu. exists h, l, k.
  split; [exact H|]. split; [exact L|]. split; [exact K|].
  assert (C : Rabs (h + l - x) <= 69 * (unit53 * unit53) * Rabs x).
  { rewrite (Rabs_pos_eq x) by lra. apply Rle_trans with (1 := E). replace (69 * (unit53 * unit53) * x) with (69 * (unit53 * (unit53 * x)))
      by ring. apply Rmult_le_compat_r; [repeat apply Rmult_le_pos; lra|lra]. }
  assert (UU : 69 * (unit53 * unit53) <= / 1000000) by (assert (unit53 * unit53 <= / 1000000000000 * unit53) by (apply Rmult_le_compat_r;
    lra); lra).
  assert (UU0 : 0 <= unit53 * unit53) by (apply Rmult_le_pos; lra).
  assert (N : near (70 * unit53) (h + l) x).
  { apply near_more with (69 * (unit53 * unit53) * (1 + / 1000) / unit53); [apply close_is_near; [exact C|lra]|].
    replace (69 * (unit53 * unit53) * (1 + / 1000) / unit53) with (69 * (1 + / 1000) * unit53) by (field; lra).
    apply Rmult_le_compat_r; lra. }
  pose proof (near_parts _ _ _ _ N ltac:(lra) Bl ltac:(lra)) as P. split; [lra|]. split; [exact Bl|exact N].
Qed.

(* sine_of_third() by its cases, in any numbers: the start of Newton's method is near, or w = 2R, or the start for the rest is near. *)
Lemma sine_of_third_cases : forall (T : Type) (P : T -> Prop) third half rest R w K, parameters R w K ->
  let t := third_sine (value32 R) (value32 w) in let s := value32 w / 2 / value32 R in
  let v := / 2 - t in let m := value32 R - value32 w / 2 in let r := m / value32 R in
  (s <= 5001 / 10000 -> (exists y, is64 (third_start R w) y /\ Rabs (y - t) <= 6 * unit53 * t) -> P third) ->
  (t = / 2 -> P half) ->
  (/ 100000000 <= v <= / 2 -> 6 * (v * v) - 4 * (v * v * v) = r -> / 281474976710656 <= r <= 5001 / 10000 ->
    / 17179869184 <= m -> is64 (minus (to64 R) (half_width w)) m ->
    (exists y, is64 (rest_start R w) y /\ Rabs (y - v) <= 8 * unit53 * v) -> P rest) ->
  P (if is_at_most (half_over_radius R w) (two_to (-1)) then third else if is_equal (half_width w) (to64 R) then half else rest).
Proof.
  intros T P third half rest R w K Hp t s v m r Third Half Rest. pose proof unit_is_small as Hu.
  destruct (third_sine_of_half R w K Hp) as (Ht & E & Bs). destruct (half_over_radius_is R w K Hp) as [Is Cs].
  pose proof (half_width_is R w K Hp) as Ih. pose proof (third_start_is R w K Hp) as T0. pose proof (rest_start_is R w K Hp) as R0.
  pose proof (rest_of_third R w K Hp) as Rt. destruct (half_chord_is_binary64 R w K Hp) as (Gm & _ & Hm).
  destruct Hp as ((FR & _) & HR & Hw & _).
  pose proof (to64_is_exact R FR) as IR. pose proof (two_to_is (-1) ltac:(lia)) as I2. change (bpow radix2 (-1)) with (/ 2) in I2.
  cbv zeta in T0, R0, Rt. fold t in Ht, E, T0, R0, Rt. fold s in E, Bs, Is, Cs, T0, R0, Rt. fold v in R0, Rt. fold m in Gm, Hm, Rt.
    fold r in Rt.
  pose proof (unit_times s ltac:(lra)) as Us. apply Rabs_le_inv in Cs. rewrite (at_most_is _ _ _ _ Is I2).
  case Rle_bool_spec; intro Hs; [assert (Hs2 : s <= 5001 / 10000) by lra; exact (Third Hs2 (T0 Hs2))|].
  rewrite (equal_is _ _ _ _ Ih IR). case Req_bool_spec; intro Heq.
  - apply Half. assert (Es : s = 1) by (unfold s; rewrite Heq; field; lra). rewrite Es in E.
    assert (Q : (2 * t - 1) * (2 * t - 1) * (t + 1) = 0) by lra. apply Rmult_integral in Q. destruct Q as [Q|Q]; [|lra].
    apply Rmult_integral in Q. lra.
  - destruct (Rt Heq) as (Hv & Ev & Br & Er). change (bpow radix2 (-48)) with (/ 281474976710656) in Br.
    assert (Bm : / 17179869184 <= m).
    { change (/ 17179869184) with (bpow radix2 (-34)). destruct Hm as [H|H]; [unfold m in H; lra|exact H]. }
    apply Rest; trivial; [lra| |now apply R0; [|lra]].
    apply (minus_exact _ _ _ _ _ IR Ih); [reflexivity|exact Gm|]. apply big_enough. rewrite Rabs_pos_eq; unfold m in *; lra.
Qed.

Theorem sine_of_third_is : forall R w K, parameters R w K -> holds 70 (/ 10000) (sine_of_third R w) (third_sine (value32 R) (value32 w)).
Proof.
  intros R w K Hp. pose proof unit_is_small as Hu. destruct (third_sine_of_half R w K Hp) as (Ht & E & Bs).
  pose proof (half_width_is R w K Hp) as Ih. pose proof Hp as ((FR & _) & HR & Hw & _).
  pose proof (to64_is_exact R FR) as IR. pose proof (two_to_is (-1) ltac:(lia)) as I2. change (bpow radix2 (-1)) with (/ 2) in I2.
  set (t := third_sine _ _) in *. set (s := value32 w / 2 / value32 R) in *.
  apply (sine_of_third_cases _ (fun a => holds 70 (/ 10000) a t) _ _ _ R w K Hp); fold t; fold s.
  - intros Hs2 (y & Iy & Cy).
    pose proof (exact_quotient _ _ _ _ Ih IR ltac:(lra) ltac:(lra) ltac:(lra)) as S. fold s in S.
    apply (holds_by _ _ (33 + 9 / 2) Ht ltac:(lra)).
    pose proof (third_is_small s t Hs2 ltac:(lra) E) as Hsmall. pose proof (unit_times t ltac:(lra)) as Ut.
    destruct (newton_root_is _ _ _ _ y t 33 24 Iy ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)
      (third_step_in_double_double _ s t E Ht Hs2 ltac:(lra) S)) as (h & l & k & H & L & Kk & B1 & B2 & B3).
    exists h, l, k. repeat (split; [assumption|]). lra.
  - intros ->. apply (holds_more 0 _ 0); [apply holds_exactly; [exact I2|lra]|lra|lra].
  - set (v := / 2 - t). set (r := (value32 R - value32 w / 2) / value32 R). intros Hv Ev [Br Hr] Bm Im (y & Iy & Cy).
    pose proof (exact_quotient _ _ _ _ Im IR ltac:(lra) ltac:(lra) ltac:(lra)) as S. fold r in S.
    pose proof (rest_is_small r v Hr ltac:(lra) Ev) as Hsmall.
    pose proof (unit_times v ltac:(lra)) as Uv.
    destruct (newton_root_is _ _ _ _ y v (287 / 10) 31 Iy ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)
      (rest_step_in_double_double _ r v Ev Hv Hr ltac:(lra) S)) as (h & l & k & H & L & Kk & B1 & B2 & B3).
    clear S. set (n := newton_root _ _ _) in *.
    assert (Htv : t = / 2 - v) by (unfold v; ring). apply (holds_by _ _ 69 Ht ltac:(lra)).
    set (W := unit53 * (unit53 * v)) in *. pose proof (unit_times (unit53 * v) ltac:(lra)) as UW. fold W in UW.
    assert (Bh : 0 <= h <= 33 / 100).
    { absolute_values. assert (0 <= h) by (apply Rmult_le_reg_l with unit53; lra). pose proof (unit_times h ltac:(lra)). lra. }
    assert (Bl : Rabs l <= 10001 / 10000 * (unit53 * v)).
    { apply Rle_trans with (1 := B2). replace (10001 / 10000 * (unit53 * v)) with (unit53 * (10001 / 10000 * v)) by ring.
      apply unit_times_compat. pose proof (unit_times h ltac:(lra)). absolute_values. lra. }
    assert (N : is_off n v (332 / 10 * W) (33 / 100) (10001 / 10000 * (unit53 * v)) (/ 1000000 * v)).
    { exists h, l, k. split; [exact H|]. split; [exact L|]. split; [exact Kk|]. split; [apply Rle_trans with (1 := B1); lra|].
      split; [rewrite Rabs_pos_eq; lra|]. split; [exact Bl|exact B3]. }
    pose proof (is_off_exactly (two_to (-1)) (/ 2) (/ 2) I2 ltac:(rewrite Rabs_pos_eq; lra)) as O.
    assert (Rt : Rabs (/ 2 + - v) = t) by (rewrite Rabs_pos_eq; lra). assert (Ht2 : 1735 / 10000 <= t) by lra.
    destruct (is_off_add _ _ _ _ _ _ _ _ _ _ _ _ (1001 / 1000 * t) (10001 / 10000 * (unit53 * v)) (12 / 10 * t) O
      (is_off_negated _ _ _ _ _ _ N) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra))
      as [(h' & l' & k' & Hh' & Hl' & Hk' & E' & _ & _ & Bk') Two].
    destruct (Two ltac:(lra) ltac:(lra)) as (p & q & P & Q & B4). clear Two.
    assert (Ep : p = h') by exact (eq_trans (eq_sym (proj1 P)) (proj1 Hh')).
    assert (Eq : q = l') by exact (eq_trans (eq_sym (proj1 Q)) (proj1 Hl')). subst p q.
    exists h', l', k'. split; [exact Hh'|]. split; [exact Hl'|]. split; [exact Hk'|]. split; [|split; [exact B4|lra]].
    replace (/ 2 + - v) with t in E' by lra. apply Rle_trans with (1 := E').
    assert (Ev1 : unit53 * v <= 18819 / 10000 * (unit53 * t)).
    { replace (18819 / 10000 * (unit53 * t)) with (unit53 * (18819 / 10000 * t)) by ring. apply unit_times_compat. lra. }
    assert (Ev2 : W <= 18819 / 10000 * (unit53 * (unit53 * t))).
    { replace (18819 / 10000 * (unit53 * (unit53 * t))) with (unit53 * (18819 / 10000 * (unit53 * t))) by ring.
      now apply unit_times_compat. }
    assert (Ew : unit53 * (unit53 * v) = W) by reflexivity. lra.
Qed.
