(* SPDX-License-Identifier: BSD-3-Clause *)
(* A step of Newton's method in double-double for t = sin(alpha / 3): newton_root of fast/laws/bump_geometry.h, where s is at most 1/2. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms DoubleDoubleOff ThreePolygonsFace.
From Forceshade Require Import NewtonStart NewtonRounded.
Open Scope R_scope.

Definition whole_dd (n : Z) : double_double := exactly64 (whole n).
Definition minus_dd (a b : double_double) : double_double := add a (negated b).
Definition midpoint (a : double_double) : double_double := {| hi := hi a; lo := lo a; error := zero64 |}.
Definition widened (a : double_double) : double_double :=
  {| hi := hi a; lo := lo a; error := times (two_to (-40)) (absolute (hi a)) |}.

(* newton_root, with one step before the last. *)
Definition newton_root (value slope : double_double -> double_double) (start : binary64) : double_double :=
  let x := midpoint (minus_dd (exactly64 start) (divide (value (exactly64 start)) (slope (exactly64 start)))) in
  minus_dd x (divide (value x) (slope (widened x))).

Definition third_value (s y : double_double) : double_double :=
  add (multiply (minus_dd (multiply (multiply (whole_dd 4) y) y) (whole_dd 3)) y) s.
Definition third_slope (y : double_double) : double_double := minus_dd (multiply (multiply (whole_dd 12) y) y) (whole_dd 3).
Definition rest_value (r y : double_double) : double_double :=
  minus_dd (multiply (multiply (minus_dd (whole_dd 6) (multiply (whole_dd 4) y)) y) y) r.
Definition rest_slope (y : double_double) : double_double := multiply (multiply (whole_dd 12) y) (minus_dd (whole_dd 1) y).

Definition sine_of_third (R w : binary32) : double_double :=
  if is_at_most (half_over_radius R w) (two_to (-1)) then
    newton_root (third_value (divide (exactly64 (half_width w)) (exactly64 (to64 R)))) third_slope (third_start R w)
  else if is_equal (half_width w) (to64 R) then exactly64 (two_to (-1))
  else minus_dd (exactly64 (two_to (-1)))
    (newton_root (rest_value (divide (exactly64 (minus (to64 R) (half_width w))) (exactly64 (to64 R)))) rest_slope (rest_start R w)).

(* A quotient of two numbers of binary64. *)
Lemma exact_quotient : forall a b x y, is64 a x -> is64 b y -> / 1000000000000 <= x <= 10000 -> / 10 <= y <= 10000 -> x <= y ->
  is_off (divide (exactly64 a) (exactly64 b)) (x / y) (13 * (unit53 * (unit53 * (x / y)))) (101 / 100 * (x / y))
    (101 / 100 * (unit53 * (x / y))) (/ 10000000000 * (x / y)).
Proof.
  intros a b x y Ha Hb Hx Hy Hxy. pose proof unit_is_small as Hu.
  set (X := x / y). assert (HX : X * y = x) by (unfold X; field; lra).
  assert (BX : / 100000000000000000 <= X <= 1).
  { split; apply Rmult_le_reg_r with y; lra. }
  destruct (quotient_of_is_near a zero64 b zero64 x 0 y 0 Ha zero_is Hb zero_is) as (p & q & P & Q & Bq & E).
  { lra. } { lra. } { rewrite Rabs_R0. apply Rmult_le_pos; lra. } { rewrite Rabs_R0. apply Rmult_le_pos; lra. }
  rewrite !Rplus_0_r in E. fold X in E.
  assert (Bp : 0 <= p <= 1001 / 1000 * X).
  { assert (0 <= p) by (apply Rmult_le_reg_l with unit53; [lra|rewrite Rmult_0_r; pose proof (Rabs_pos q); lra]). split; [assumption|].
    pose proof (unit_times p ltac:(lra)). pose proof (unit_times X ltac:(lra)). pose proof (unit_times (unit53 * X) ltac:(lra)).
    absolute_values. lra. }
  (* the divisor is not 0, and no error comes from numerator or divisor *)
  pose proof (constant_is (2 ^ 50 - 1) (-50) ltac:(lia) ltac:(lia)) as Ik. fold almost_one in Ik. set (j := IZR _ * _) in Ik.
  assert (Hj : 999 / 1000 <= j <= 1) by (unfold j; simpl; lra). clearbody j. pose proof tiny_is_tiny as Htiny.
  pose proof (absolute_is _ _ Hb) as Ah. rewrite (Rabs_pos_eq y) in Ah by lra.
  assert (Hyj : 999 / 1000 * y <= y * j <= y).
  { split; [rewrite (Rmult_comm y j); apply Rmult_le_compat_r; lra|]. rewrite <- (Rmult_1_r y) at 2. apply Rmult_le_compat_l; lra. }
  destruct (times_close _ _ _ _ Ah Ik ltac:(rewrite Rabs_pos_eq; lra)) as [I1 C1]. rewrite (Rabs_pos_eq (y * j)) in C1 by lra.
  pose proof (unit_times (y * j) ltac:(lra)) as U1. pose proof (size_by (nearest64 (y * j)) (y * j)) as S1.
    set (z := nearest64 (y * j)) in *.
  assert (Bz : 99 / 100 * y <= z <= 2 * y) by (absolute_values; lra).
  assert (I2 : is64 (minus (times (absolute b) almost_one) zero64) z).
  { apply (minus_exact _ _ _ _ _ I1 zero_is); [ring|now apply format_of in I1|]. apply big_enough. rewrite Rabs_pos_eq; lra. }
  assert (I3 : is64 (times (absolute (fst (quotient_of a zero64 b zero64))) zero64) 0).
  { apply (times_exact _ _ _ _ _ (absolute_is _ _ P) zero_is); [ring|apply generic_format_0|apply zero_is_not_too_large]. }
  assert (I4 : is64 (plus zero64 (times (absolute (fst (quotient_of a zero64 b zero64))) zero64)) 0).
  { apply (plus_exact _ _ _ _ _ zero_is I3); [ring|apply generic_format_0|apply zero_is_not_too_large]. }
  pose proof (over_is _ _ _ _ I4 I2 ltac:(lra) ltac:(unfold Rdiv; rewrite Rmult_0_l; apply zero_is_not_too_large)) as I5.
  unfold Rdiv in I5. rewrite Rmult_0_l, round_0 in I5 by auto with typeclass_instances.
  destruct (error_of_is _ _ _ 0 0 P I5 ltac:(lra) ltac:(lra) ltac:(rewrite Rabs_pos_eq; lra)) as (k & K & Bk & _).
  rewrite (Rabs_pos_eq p) in Bk by lra.
  unfold divide, exactly64. cbn [hi lo error]. cbv zeta. rewrite (less_is _ _ _ _ zero_is I2), Rlt_bool_true by lra. cbn [negb].
  unfold rounded. cbn [hi lo error]. exists p, q, k. split; [exact P|]. split; [exact Q|]. split; [exact K|].
  split; [lra|]. split; [rewrite Rabs_pos_eq; lra|]. split; [|unfold share101 in Bk; lra].
  apply Rle_trans with (1 := Bq). replace (101 / 100 * (unit53 * X)) with (unit53 * (101 / 100 * X)) by ring.
  apply unit_times_compat. lra.
Qed.

(* y as double-double holds it, its bound of the error dropped or widened. *)
Definition argument (a : double_double) (y t : R) : Prop :=
  is_off a y 0 (1001 / 1000 * t) (101 / 100 * (unit53 * (1001 / 1000 * t))) (/ 100000000000 * t).

Lemma is_off_whole : forall n, (Z.abs n < 1000)%Z -> is_off (whole_dd n) (IZR n) 0 (Rabs (IZR n)) 0 0.
Proof. intros n H. apply is_off_exactly; [apply whole_is; lia|lra]. Qed.

Lemma third_value_is : forall s a y t sigma phi, argument a y t -> 999 / 1000 * t <= y <= 10001 / 10000 * t ->
  / 60000000 <= t <= 1737 / 10000 ->
  is_off s sigma (13 * (unit53 * (unit53 * sigma))) (101 / 100 * sigma) (101 / 100 * (unit53 * sigma)) (/ 10000000000 * sigma) ->
  0 < sigma <= 3 * t -> Rabs ((4 * y * y - 3) * y + sigma) <= phi -> phi <= 28 * (unit53 * t) ->
  is_off (third_value s a) ((4 * y * y - 3) * y + sigma) (84 * (unit53 * (unit53 * t))) (phi + 160 * (unit53 * (unit53 * t)))
    (72 * (unit53 * (unit53 * t))) (/ 100000000 * t).
Proof.
  intros s a y t sigma phi Ha By Bt Hs Bs Hf Hphi. unfold argument in Ha. pose proof unit_is_small as Hu.
  set (u := unit53) in *. set (Z := u * u). set (U := u * t). set (W := u * U).
  assert (EU : u * t = U) by reflexivity. assert (EW : u * U = W) by reflexivity. assert (EWW : u * (u * t) = W) by reflexivity.
  assert (EWt : u * (u * (t * t)) = t * W) by (unfold W, U; ring).
  assert (EZ : u * u = Z) by reflexivity.
  assert (EZt : Z * t = W) by (unfold Z, W, U; ring).
  assert (BU : 0 < U <= 1737 / 10000 * u).
  { unfold U. split; [apply Rmult_lt_0_compat; lra|]. rewrite (Rmult_comm (1737 / 10000)). apply Rmult_le_compat_l; lra. }
  assert (BZ : 0 < Z <= / 1000000000000 * u) by (unfold Z; split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (BW : 0 < W <= 1737 / 10000 * Z).
  { unfold W, Z. split; [apply Rmult_lt_0_compat; lra|]. replace (1737 / 10000 * (u * u)) with (u * (1737 / 10000 * u)) by ring.
    apply Rmult_le_compat_l; lra. }
  assert (BWU : W <= / 1000000000000 * U) by (unfold W; apply Rmult_le_compat_r; lra).
  assert (BUt : U <= / 1000000000000 * t) by (unfold U; apply Rmult_le_compat_r; lra).
  assert (BuuU : u * (u * U) <= / 1000000000000 * W) by (change (u * W <= / 1000000000000 * W); apply Rmult_le_compat_r; lra).
  assert (Btl : / 10000000000000000 <= t * t).
  { apply Rle_trans with (/ 60000000 * / 60000000); [lra|apply Rmult_le_compat; lra]. }
  assert (Btt : 0 < t * t <= 1737 / 10000 * t) by (split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (Byt : 999 / 1000 * (t * t) <= t * y <= 10001 / 10000 * (t * t)).
  { replace (999 / 1000 * (t * t)) with (t * (999 / 1000 * t)) by ring. replace (10001 / 10000 * (t * t)) with (t * (10001 / 10000 * t))
      by ring. split; apply Rmult_le_compat_l; lra. }
  assert (Byy : 0 < y * y <= 30207 / 1000000).
  { split; [apply Rmult_lt_0_compat; lra|]. apply Rle_trans with (1738 / 10000 * (1738 / 10000)); [apply Rmult_le_compat; lra|lra]. }
  assert (Btt2 : t * t <= 30172 / 1000000) by (apply Rle_trans with (1737 / 10000 * (1737 / 10000)); [apply Rmult_le_compat; lra|lra]).
  assert (Byyy : 0 < y * y * y <= 31 / 1000 * y) by (split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (Bus : u * sigma <= 3 * U) by (unfold U; replace (3 * (u * t)) with (u * (3 * t)) by ring; apply Rmult_le_compat_l; lra).
  assert (Buus : u * (u * sigma) <= 3 * W).
  { unfold W. replace (3 * (u * U)) with (u * (3 * U)) by ring. apply Rmult_le_compat_l; lra. }
  assert (Utt : u * (t * t) <= 30172 / 1000000 * u) by (rewrite (Rmult_comm (30172 / 1000000)); apply Rmult_le_compat_l; lra).
  assert (Uutt : u * (u * (t * t)) <= 30172 / 1000000 * Z).
  { unfold Z. replace (30172 / 1000000 * (u * u)) with (u * (30172 / 1000000 * u)) by ring. apply Rmult_le_compat_l; lra. }
  assert (tW : 0 <= t * W <= 30172 / 1000000 * Z).
  { replace (t * W) with (u * (u * (t * t))) by (unfold W, U; ring). split; [|exact Uutt]. repeat apply Rmult_le_pos; lra. }
  assert (R4 : Rabs 4 = 4) by (apply Rabs_pos_eq; lra). assert (R3 : Rabs 3 = 3) by (apply Rabs_pos_eq; lra).
  assert (Ry : Rabs y = y) by (apply Rabs_pos_eq; lra).
  pose proof (is_off_whole 4 ltac:(lia)) as W4. pose proof (is_off_whole 3 ltac:(lia)) as W3. rewrite R4 in W4. rewrite R3 in W3.
  (* 4 y *)
  pose proof (is_off_multiply _ _ _ _ _ _ _ _ _ _ _ _ (4 * (1001 / 1000 * t)) (4 * (/ 100000000000 * t)) W4 Ha ltac:(fold u; lra)
    ltac:(fold u; lra) eq_refl ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A1.
  apply (is_off_more _ _ _ _ _ _ (281 / 10 * W) (405 / 100 * t) (405 / 100 * U) (/ 5000000000 * t)) in A1;
    [|rewrite R4; fold u; lra|lra|fold u; lra|lra].
  (* 4 y y *)
  assert (R1 : Rabs (4 * y) = 4 * y) by (apply Rabs_pos_eq; lra).
  pose proof (is_off_multiply _ _ _ _ _ _ _ _ _ _ _ _ (405 / 100 * t * (1001 / 1000 * t)) (/ 100000000000) A1 Ha ltac:(fold u; lra)
    ltac:(fold u; lra) eq_refl ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A2.
  apply (is_off_more _ _ _ _ _ _ (172 / 100 * Z) (124 / 1000) (124 / 1000 * u) (/ 10000000000)) in A2;
    [|rewrite R1; fold u; lra|lra|fold u; lra|lra].
  (* 4 y y - 3 *)
  assert (R2 : Rabs (4 * y * y + - (3)) = 3 - 4 * y * y) by (rewrite Rabs_left; lra).
  destruct (is_off_add _ _ _ _ _ _ _ _ _ _ _ _ (3001 / 1000) (124 / 1000 * u) (3302 / 1000) A2 (is_off_negated _ _ _ _ _ _ W3) ltac:(lra)
    ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as [A3 _].
  apply (is_off_more _ _ _ _ _ _ (829 / 100 * Z) (3302 / 1000) (331 / 100 * u) (/ 2000000000)) in A3;
    [|fold u; lra|lra|fold u; lra|lra].
  change (4 * y * y + - (3)) with (4 * y * y - 3) in A3, R2.
  (* (4 y y - 3) y *)
  pose proof (is_off_multiply _ _ _ _ _ _ _ _ _ _ _ _ (3302 / 1000 * (1001 / 1000 * t)) (/ 1700000000 * t) A3 Ha ltac:(fold u; lra)
    ltac:(fold u; lra) eq_refl ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A4.
  apply (is_off_more _ _ _ _ _ _ (3153 / 100 * W) (334 / 100 * t) (334 / 100 * U) (/ 500000000 * t)) in A4;
    [|rewrite R2; fold u; lra|lra|fold u; lra|lra].
  (* + s *)
  destruct (is_off_add _ _ _ _ _ _ _ _ _ _ _ _ (36 * U) (637 / 100 * U) (50 * U) A4 Hs ltac:(lra) ltac:(lra) ltac:(lra) ltac:(fold u; lra)
    ltac:(fold u; lra) ltac:(lra) ltac:(lra) ltac:(split; [unfold U, u, unit53; lra|lra])) as [A5 _].
  apply (is_off_smaller _ _ _ _ _ _ phi) in A5; [|exact Hf].
  apply (is_off_more _ _ _ _ _ _ (84 * W) (phi + 160 * W) (72 * W) (/ 100000000 * t)) in A5;
    [|fold u; lra|fold u; lra|fold u; lra|lra].
  exact A5.
Qed.

Lemma third_slope_is : forall a y t, argument a y t -> 999 / 1000 * t <= y <= 10001 / 10000 * t -> / 60000000 <= t <= 1737 / 10000 ->
  is_off (third_slope a) (12 * y * y - 3) (20 * (unit53 * unit53)) (3302 / 1000) (331 / 100 * unit53) (/ 1900000000).
Proof.
  intros a y t Ha By Bt. unfold argument in Ha. pose proof unit_is_small as Hu.
  set (u := unit53) in *. set (Z := u * u). set (U := u * t). set (W := u * U).
  assert (EU : u * t = U) by reflexivity. assert (EW : u * U = W) by reflexivity. assert (EWW : u * (u * t) = W) by reflexivity.
  assert (EWt : u * (u * (t * t)) = t * W) by (unfold W, U; ring).
  assert (EZ : u * u = Z) by reflexivity.
  assert (BU : 0 < U <= 1737 / 10000 * u).
  { unfold U. split; [apply Rmult_lt_0_compat; lra|]. rewrite (Rmult_comm (1737 / 10000)). apply Rmult_le_compat_l; lra. }
  assert (BZ : 0 < Z <= / 1000000000000 * u) by (unfold Z; split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (BW : 0 < W <= 1737 / 10000 * Z).
  { unfold W, Z. split; [apply Rmult_lt_0_compat; lra|]. replace (1737 / 10000 * (u * u)) with (u * (1737 / 10000 * u)) by ring.
    apply Rmult_le_compat_l; lra. }
  assert (BWU : W <= / 1000000000000 * U) by (unfold W; apply Rmult_le_compat_r; lra).
  assert (BUt : U <= / 1000000000000 * t) by (unfold U; apply Rmult_le_compat_r; lra).
  assert (BuuU : u * (u * U) <= / 1000000000000 * W) by (change (u * W <= / 1000000000000 * W); apply Rmult_le_compat_r; lra).
  assert (Btl : / 10000000000000000 <= t * t).
  { apply Rle_trans with (/ 60000000 * / 60000000); [lra|apply Rmult_le_compat; lra]. }
  assert (Btt : 0 < t * t <= 1737 / 10000 * t) by (split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (Byt : 999 / 1000 * (t * t) <= t * y <= 10001 / 10000 * (t * t)).
  { replace (999 / 1000 * (t * t)) with (t * (999 / 1000 * t)) by ring. replace (10001 / 10000 * (t * t)) with (t * (10001 / 10000 * t))
      by ring. split; apply Rmult_le_compat_l; lra. }
  assert (Byy : 998 / 1000 * (t * t) <= y * y <= 30207 / 1000000).
  { split; [apply Rle_trans with (999 / 1000 * t * (999 / 1000 * t)); [lra|apply Rmult_le_compat; lra]|].
    apply Rle_trans with (1738 / 10000 * (1738 / 10000)); [apply Rmult_le_compat; lra|lra]. }
  assert (Btt2 : t * t <= 30172 / 1000000) by (apply Rle_trans with (1737 / 10000 * (1737 / 10000)); [apply Rmult_le_compat; lra|lra]).
  assert (Utt : u * (t * t) <= 30172 / 1000000 * u) by (rewrite (Rmult_comm (30172 / 1000000)); apply Rmult_le_compat_l; lra).
  assert (Uutt : u * (u * (t * t)) <= 30172 / 1000000 * Z).
  { unfold Z. replace (30172 / 1000000 * (u * u)) with (u * (30172 / 1000000 * u)) by ring. apply Rmult_le_compat_l; lra. }
  assert (tW : 0 <= t * W <= 30172 / 1000000 * Z).
  { replace (t * W) with (u * (u * (t * t))) by (unfold W, U; ring). split; [|exact Uutt]. repeat apply Rmult_le_pos; lra. }
  assert (R12 : Rabs 12 = 12) by (apply Rabs_pos_eq; lra). assert (R3 : Rabs 3 = 3) by (apply Rabs_pos_eq; lra).
  assert (Ry : Rabs y = y) by (apply Rabs_pos_eq; lra).
  pose proof (is_off_whole 12 ltac:(lia)) as W12. pose proof (is_off_whole 3 ltac:(lia)) as W3. rewrite R12 in W12. rewrite R3 in W3.
  pose proof (is_off_multiply _ _ _ _ _ _ _ _ _ _ _ _ (12 * (1001 / 1000 * t)) (12 * (/ 100000000000 * t)) W12 Ha ltac:(fold u; lra)
    ltac:(fold u; lra) eq_refl ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A1.
  apply (is_off_more _ _ _ _ _ _ (85 * W) (1214 / 100 * t) (1214 / 100 * U) (/ 2000000000 * t)) in A1;
    [|rewrite R12; fold u; lra|lra|fold u; lra|lra].
  assert (R1 : Rabs (12 * y) = 12 * y) by (apply Rabs_pos_eq; lra).
  pose proof (is_off_multiply _ _ _ _ _ _ _ _ _ _ _ _ (1214 / 100 * t * (1001 / 1000 * t)) (/ 20000000000) A1 Ha ltac:(fold u; lra)
    ltac:(fold u; lra) eq_refl ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A2.
  apply (is_off_more _ _ _ _ _ _ (6 * Z) (38 / 100) (38 / 100 * u) (/ 6000000000)) in A2;
    [|rewrite R1; fold u; lra|lra|fold u; lra|lra].
  assert (R2 : Rabs (12 * y * y + - (3)) = 3 - 12 * y * y) by (rewrite Rabs_left; lra).
  destruct (is_off_add _ _ _ _ _ _ _ _ _ _ _ _ (3001 / 1000) (38 / 100 * u) (3302 / 1000) A2 (is_off_negated _ _ _ _ _ _ W3) ltac:(lra)
    ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as [A3 _].
  apply (is_off_more _ _ _ _ _ _ (20 * Z) (3302 / 1000) (331 / 100 * u) (/ 1900000000)) in A3;
    [|fold u; lra|lra|fold u; lra|lra].
  change (12 * y * y + - (3)) with (12 * y * y - 3) in A3. exact A3.
Qed.

Lemma third_quotient_is : forall v s F D t phi, is_off v F (84 * (unit53 * (unit53 * t))) (phi + 160 * (unit53 * (unit53 * t)))
    (72 * (unit53 * (unit53 * t))) (/ 100000000 * t) ->
  is_off s D (20 * (unit53 * unit53)) (3302 / 1000) (331 / 100 * unit53) (/ 1900000000) -> / 60000000 <= t <= 1737 / 10000 ->
  Rabs F <= phi -> phi <= 28 * (unit53 * t) -> 2604 / 1000 <= Rabs D ->
  is_off (divide v s) (F / D) (33 * (unit53 * (unit53 * t)) + 8 * (unit53 * phi)) (50 * (unit53 * t)) (80 * (unit53 * (unit53 * t)))
    (/ 10000000 * t).
Proof.
  intros v s F D t phi Hv Hs Bt HF Hphi HD. pose proof unit_is_small as Hu. pose proof (Rabs_pos F) as PF.
  set (u := unit53) in *. set (Z := u * u) in *. set (U := u * t) in *. set (W := u * U) in *.
  assert (EU : u * t = U) by reflexivity. assert (EW : u * U = W) by reflexivity. assert (EWW : u * (u * t) = W) by reflexivity.
  assert (EWt : u * (u * (t * t)) = t * W) by (unfold W, U; ring).
  assert (EZ : u * u = Z) by reflexivity.
  assert (BU : 0 < U <= 1737 / 10000 * u).
  { unfold U. split; [apply Rmult_lt_0_compat; lra|]. rewrite (Rmult_comm (1737 / 10000)). apply Rmult_le_compat_l; lra. }
  assert (BZ : 0 < Z <= / 1000000000000 * u) by (unfold Z; split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (BW : 0 < W <= / 1000000000000 * U) by (unfold W; split; [apply Rmult_lt_0_compat; lra|apply Rmult_le_compat_r; lra]).
  assert (BUt : U <= / 1000000000000 * t) by (unfold U; apply Rmult_le_compat_r; lra).
  assert (BuuU : u * (u * U) <= / 1000000000000 * W) by (change (u * W <= / 1000000000000 * W); apply Rmult_le_compat_r; lra).
  assert (Ulow : / 1000000000000000000000000000 <= U).
  { apply Rle_trans with (u * / 60000000); [unfold u, unit53; lra|unfold U; apply Rmult_le_compat_l; lra]. }
  assert (Pu : 0 <= u * phi <= 28 * W).
  { split; [apply Rmult_le_pos; lra|]. unfold W. replace (28 * (u * U)) with (u * (28 * U)) by ring. apply Rmult_le_compat_l; lra. }
  set (Q := 10 / 26 * (phi + / 1000 * U)). assert (BQ : 0 < Q <= 11 * U) by (unfold Q; lra).
  assert (QZ : 0 <= Q * Z <= / 1000000000 * W).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (11 * U * Z); [apply Rmult_le_compat_r; lra|].
    replace (11 * U * Z) with (11 * u * W) by (unfold W, Z; ring). apply Rmult_le_compat_r; lra. }
  assert (HQ : Rabs (F / D) <= Q).
  { apply quotient_size; [lra|]. apply Rle_trans with (Q * (26 / 10)); [unfold Q; lra|]. apply Rmult_le_compat_l; lra. }
  assert (Qd : Q * (26 / 10) = phi + / 1000 * U) by (unfold Q; field).
  assert (uQ : u * Q = 10 / 26 * (u * phi + / 1000 * W)) by (unfold Q; rewrite <- EW; field).
  pose proof (is_off_divide _ _ _ _ _ _ _ _ _ _ _ _ (26 / 10) Q (/ 200000000 * t) Hv Hs ltac:(lra) ltac:(lra) ltac:(lra) ltac:(fold u; lra)
    ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) HQ ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as A.
  apply (is_off_more _ _ _ _ _ _ (33 * W + 8 * (u * phi)) (50 * U) (80 * W) (/ 10000000 * t)) in A;
    [exact A|fold u; lra|lra|fold u; lra|lra].
Qed.

Lemma third_step_in_double_double : forall s sigma t, 4 * (t * t * t) - 3 * t + sigma = 0 -> / 60000000 <= t <= / 2 ->
  sigma <= 5001 / 10000 -> 0 < sigma ->
  is_off s sigma (13 * (unit53 * (unit53 * sigma))) (101 / 100 * sigma) (101 / 100 * (unit53 * sigma)) (/ 10000000000 * sigma) ->
  forall a b y rho, argument a y t -> argument b y t -> 0 <= rho <= 9 * unit53 -> Rabs (y - t) <= rho * t ->
    let q := ((4 * y * y - 3) * y + sigma) / (12 * y * y - 3) in
    is_off (divide (third_value s a) (third_slope b)) q (33 * (unit53 * (unit53 * t)) + 24 * (unit53 * (rho * t)))
      (50 * (unit53 * t)) (80 * (unit53 * (unit53 * t))) (/ 10000000 * t) /\
    Rabs (y - q - t) <= 56 / 100 * (rho * rho) * t.
Proof.
  intros s sigma t E Ht Hs Hs0 S a b y rho Ha Hb Hrho Hy q. pose proof unit_is_small as Hu.
  pose proof (third_is_small sigma t Hs ltac:(lra) E) as Hsmall.
  assert (Hrt : 0 <= rho * t <= 9 * (unit53 * t)).
  { split; [apply Rmult_le_pos; lra|]. replace (9 * (unit53 * t)) with (9 * unit53 * t) by ring. apply Rmult_le_compat_r; lra. }
  pose proof (unit_times t ltac:(lra)) as Ut. pose proof (Rabs_le_inv _ _ Hy) as Hy2.
  assert (By : 999 / 1000 * t <= y <= 10001 / 10000 * t) by lra.
  assert (Byy : 0 <= y * y <= 302 / 1000 * (302 / 1000)) by (split; [apply Rle_0_sqr|apply Rmult_le_compat; lra]).
  assert (Hst : sigma <= 3 * t).
  { assert (0 <= t * t * t) by (apply Rmult_le_pos; [apply Rle_0_sqr|lra]). lra. }
  assert (Hf : Rabs ((4 * y * y - 3) * y + sigma) <= 3 * (rho * t)).
  { replace ((4 * y * y - 3) * y + sigma) with ((y - t) * (4 * (y * y + y * t + t * t) - 3)) by lra. rewrite Rabs_mult.
    assert (0 <= y * t <= 302 / 1000 * (302 / 1000)) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
    assert (0 <= t * t <= 302 / 1000 * (302 / 1000)) by (split; [apply Rle_0_sqr|apply Rmult_le_compat; lra]).
    rewrite (Rmult_comm 3). apply Rmult_le_compat; try apply Rabs_pos; [exact Hy|apply Rabs_le; lra]. }
  assert (Byy2 : y * y <= 1738 / 10000 * (1738 / 10000)) by (apply Rmult_le_compat; lra).
  split.
  - pose proof (third_value_is s a y t sigma (3 * (rho * t)) Ha By ltac:(lra) S ltac:(lra) Hf ltac:(lra)) as V.
    pose proof (third_slope_is b y t Hb By ltac:(lra)) as D.
    replace (24 * (unit53 * (rho * t))) with (8 * (unit53 * (3 * (rho * t)))) by ring.
    apply third_quotient_is; try assumption; try lra. rewrite Rabs_left; lra.
  - pose proof (newton_for_third_converges sigma t y rho Hs ltac:(lra) E ltac:(lra) Hy) as N. unfold q.
    replace (4 * (y * y * y) - 3 * y + sigma) with ((4 * y * y - 3) * y + sigma) in N by ring.
    replace (12 * (y * y)) with (12 * y * y) in N by ring. apply Rle_trans with (1 := N).
    apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_r; [apply Rle_0_sqr|lra].
Qed.
