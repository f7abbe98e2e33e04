(* SPDX-License-Identifier: BSD-3-Clause *)
(* The height and slope that the laws bump-2p and bump-2p-shaded hold, as double-double computes them: two_polygon_face of
   fast/laws/bump_geometry.h and two_polygon_gap of fast/laws/polygon_gap.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Shaded Gap Polygons.
From Forceshade Require Import CylinderForce Cylinder DoubleDouble Depth Split DoubleDoubleNear.
Open Scope R_scope.

Definition divide (a b : double_double) : double_double :=
  let size := minus (times (absolute (hi b)) almost_one) (error b) in
  if negb (is_less zero64 size) then {| hi := zero64; lo := zero64; error := B754_infinity 53 1024 false |}
  else
    let q := quotient_of (hi a) (lo a) (hi b) (lo b) in
    rounded q (over (plus (error a) (times (absolute (fst q)) (error b))) size).

Definition sum_2p (R w : binary32) : double_double := add (exactly64 (to64 R)) (computed_depth R w).
Definition tangent_2p (R w : binary32) : double_double := divide (exactly64 (half_width w)) (sum_2p R w).
Definition height_2p (R w : binary32) : double_double := multiply (tangent_2p R w) (exactly64 (half_width w)).

(* R + d, and its bound of the error, which is small. *)
Lemma sum_2p_is : forall R w K, parameters R w K -> let S := value32 R + axis_depth (value32 R) (value32 w) in
  exists y z e, is64 (hi (sum_2p R w)) y /\ is64 (lo (sum_2p R w)) z /\ is64 (error (sum_2p R w)) e /\ 0 <= e <= / 100 * y /\
    Rabs z <= unit53 * y /\ Rabs (y + z - S) <= 13 * (unit53 * unit53) * S /\ / 20 <= y <= 30000.
Proof.
  intros R w K Hp S. destruct (computed_depth_is R w K Hp) as (h & l & e & H & L & E & Be & Bl & Bd & Hh & _).
  destruct Hp as ((FR & _ & _) & HR & Hw & _). unfold S. set (d := axis_depth _ _) in *. clearbody d.
  assert (IR : is64 (to64 R) (value32 R)) by now apply to64_is_exact.
  unfold sum_2p. set (D := computed_depth R w) in *. clearbody D. destruct D as [dh dl de]. cbn [hi lo error] in *.
  set (x := value32 R) in *. clearbody x. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  pose proof (sum_of_is_near (to64 R) zero64 dh dl x h l IR zero_is H L ltac:(lra) ltac:(lra) Bl) as (y & z & Y1 & Y2 & Bz & By).
  unfold add, rounded, exactly64. cbn [hi lo error].
  apply Rabs_le_inv in Bd. apply Rabs_le_inv in By. apply Rabs_le_inv in Bl. pose proof (Rabs_le_inv _ _ Bz) as Bz2.
  assert (Uy : unit53 * y <= / 1000 * Rabs y).
  { apply Rle_trans with (unit53 * Rabs y); [apply Rmult_le_compat_l; [lra|apply Rle_abs]|].
    apply Rmult_le_compat_r; [apply Rabs_pos|lra]. }
  assert (Hy0 : 0 <= y) by (pose proof (Rabs_pos z); apply Rmult_le_reg_l with unit53; lra).
  rewrite (Rabs_pos_eq y) in Uy by assumption.
  assert (Hy : / 20 <= y <= 30000) by (unfold unit53 in *; lra).
  set (sum := sum_of (to64 R) zero64 dh dl) in *. clearbody sum.
  assert (Ie : is64 (plus zero64 de) e).
  { apply plus_exact with 0 e; try assumption; [apply zero_is|ring|now apply format_of in E|]. apply big_enough, Rabs_le. lra. }
  destruct (error_of_is _ _ _ e e Y1 Ie ltac:(lra) ltac:(lra) ltac:(rewrite Rabs_pos_eq; lra)) as (f & F1 & F2 & _).
  rewrite (Rabs_pos_eq y) in F2 by lra.
  exists y, z, f. split; [exact Y1|]. split; [exact Y2|]. split; [exact F1|]. split; [unfold share101, unit53 in *; lra|].
  split; [exact Bz|]. split; [apply Rabs_le; unfold unit53 in *; lra|exact Hy].
Qed.

Lemma tangent_2p_is : forall R w K, parameters R w K -> let T := value32 w / 2 / (value32 R + axis_depth (value32 R) (value32 w)) in
  exists y z, is64 (hi (tangent_2p R w)) y /\ is64 (lo (tangent_2p R w)) z /\ Rabs z <= unit53 * y /\
    Rabs (y + z - T) <= 25 * (unit53 * unit53) * T /\ / 40000000 <= T <= 2.
Proof.
  intros R w K Hp. cbv zeta. destruct (sum_2p_is R w K Hp) as (y1 & z1 & e & Y & Z & E & Be & Bz & By & Hy).
  pose proof (half_width_is _ _ _ Hp) as Ic. destruct Hp as (_ & HR & Hw & _).
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  set (d := axis_depth _ _) in *. clearbody d. set (x := value32 R) in *. clearbody x. set (c := value32 w / 2) in *.
  assert (Hc : / 2000 <= c <= x) by (unfold c; lra). clearbody c.
  assert (Hdx : d <= x) by (clear -Hd0 Hd2 Hc; assert (0 <= c * c) by apply Rle_0_sqr; nra).
  set (S := x + d) in *. assert (HS : / 10 <= S <= 20000 /\ c <= S) by (unfold S; lra). clearbody S.
  unfold tangent_2p. set (s := sum_2p R w) in *. clearbody s. destruct s as [sh sl se]. cbn [hi lo error] in *.
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  (* the divisor is not 0 *)
  pose proof (constant_is (2 ^ 50 - 1) (-50) ltac:(lia) ltac:(lia)) as Ik. fold almost_one in Ik. set (k := IZR _ * _) in Ik.
  assert (Hk : 999 / 1000 <= k <= 1) by (unfold k; simpl; lra). clearbody k.
  pose proof (absolute_is _ _ Y) as Ay. rewrite (Rabs_pos_eq y1) in Ay by lra.
  assert (Hyk : 999 / 1000 * y1 <= y1 * k <= y1).
  { split; [rewrite (Rmult_comm y1 k); apply Rmult_le_compat_r; lra|]. rewrite <- (Rmult_1_r y1) at 2. apply Rmult_le_compat_l; lra. }
  pose proof (times_is _ _ _ _ Ay Ik ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as I1.
  assert (close : forall b, 0 <= b <= 40000 -> 999 / 1000 * b - tiny <= nearest64 b <= 1001 / 1000 * b + tiny).
  { intros b Hb. pose proof (product_is_close b) as C. rewrite (Rabs_pos_eq b) in C by lra. apply Rabs_le_inv in C.
    assert (unit53 * b <= / 1000 * b) by (apply Rmult_le_compat_r; lra). lra. }
  pose proof (close (y1 * k) ltac:(lra)) as C1.
  pose proof (minus_is _ _ _ _ I1 E ltac:(apply big_enough, Rabs_le; lra)) as I2.
  assert (Hpos : 0 < nearest64 (nearest64 (y1 * k) - e)) by (pose proof (close (nearest64 (y1 * k) - e) ltac:(lra)); lra).
  unfold divide, exactly64. cbn [hi lo error]. cbv zeta.
  rewrite (less_is _ _ _ _ zero_is I2), Rlt_bool_true by assumption. cbn [negb]. unfold rounded. cbn [hi lo].
  assert (Bz' : Rabs z1 <= 101 / 100 * unit53 * y1) by (apply Rle_trans with (1 := Bz); apply Rmult_le_compat_r; lra).
  destruct (quotient_of_is_near (half_width w) zero64 sh sl c y1 z1 Ic zero_is Y Z ltac:(lra) ltac:(lra) Bz')
    as (y & z & Q1 & Q2 & Q3 & Q4).
  set (T := c / S). exists y, z. split; [exact Q1|]. split; [exact Q2|]. split; [exact Q3|].
  assert (HTS : T * S = c) by (unfold T; field; lra). set (S' := y1 + z1) in *. set (T' := c / S') in *.
  apply Rabs_le_inv in By. assert (HS' : 999999 / 1000000 * S <= S' <= 1000001 / 1000000 * S) by (unfold unit53 in *; lra).
  assert (HTS' : T' * S' = c) by (unfold T'; field; lra).
  assert (HT : / 40000000 <= T <= 2).
  { split; apply Rmult_le_reg_r with S; try lra; rewrite HTS; lra. }
  assert (KT : Rabs (T' - T) <= 132 / 10 * (unit53 * unit53) * T).
  { apply Rmult_le_reg_r with S'; [lra|]. rewrite <- (Rabs_pos_eq S') at 1 by lra. rewrite <- Rabs_mult.
    replace ((T' - T) * S') with (T * (S - S')) by (rewrite Rmult_minus_distr_r, HTS', <- HTS; ring).
    rewrite Rabs_mult, (Rabs_pos_eq T) by lra.
    replace (132 / 10 * (unit53 * unit53) * T * S') with (T * (132 / 10 * (unit53 * unit53) * S')) by ring.
    apply Rmult_le_compat_l; [lra|]. rewrite Rabs_minus_sym. apply Rabs_le. unfold unit53 in *. lra. }
  apply Rabs_le_inv in KT. apply Rabs_le_inv in Q4. split; [|exact HT]. apply Rabs_le. unfold unit53 in *. lra.
Qed.

(* What bump-2p and bump-2p-shaded hold of their height and slope is what the theorems on their first stages assume. *)
Theorem linear_2p_is_right : forall R w K, parameters R w K ->
  linear (hi (height_2p R w)) (lo (height_2p R w)) (split_head (tangent_2p R w)) (split_tail (tangent_2p R w))
    (bump_height (value32 R) (value32 w)) (slope_2p (value32 R) (value32 w)).
Proof.
  intros R w K Hp. destruct (tangent_2p_is R w K Hp) as (y & z & Y & Z & Bz & By & HT). pose proof (half_width_is _ _ _ Hp) as Ic.
  destruct Hp as (_ & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  unfold slope_2p, bump_height. set (d := axis_depth _ _) in *. clearbody d. set (x := value32 R) in *. clearbody x.
  assert (Ew : value32 w = 2 * (value32 w / 2)) by field. rewrite Ew. clear Ew.
  replace (2 * (value32 w / 2) / 2) with (value32 w / 2) by field.
  set (c := value32 w / 2) in *. assert (Hc : / 2000 <= c <= x) by (unfold c; lra). clearbody c.
  set (T := c / (x + d)) in *. assert (HTS : T * (x + d) = c) by (unfold T; field; lra). clearbody T.
  assert (EH : x - d = T * c).
  { apply Rmult_eq_reg_r with (x + d); [|lra]. replace (T * c * (x + d)) with (T * (x + d) * c) by ring. rewrite HTS.
    replace ((x - d) * (x + d)) with (x * x - d * d) by ring. lra. }
  assert (ES : 2 * (x - d) / (2 * c) = T) by (rewrite EH; field; lra). rewrite ES, EH.
  assert (HH : / 80000000000 <= T * c <= 10000).
  { split; [replace (/ 80000000000) with (/ 40000000 * / 2000) by field; apply Rmult_le_compat; lra|]. lra. }
  unfold height_2p. set (t := tangent_2p R w) in *. clearbody t.
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  apply Rabs_le_inv in By. pose proof (Rabs_le_inv _ _ Bz) as Bz2.
  assert (Hy : 999999 / 1000000 * T <= y <= 1000001 / 1000000 * T) by (unfold unit53 in *; lra).
  assert (Bz' : Rabs z <= 101 / 100 * unit53 * y) by (apply Rle_trans with (1 := Bz); apply Rmult_le_compat_r; lra).
  destruct (split_is t y z Y Z Bz' ltac:(lra) ltac:(right; lra)) as (p & q & Ip & Iq & Gp & Cp & Tq & Cq).
  destruct t as [th tl te]. cbn [hi lo error] in Y, Z. unfold multiply, exactly64, rounded. cbn [hi lo error].
  destruct (product_of_is_near th tl (half_width w) zero64 y z c Y Z Ic zero_is ltac:(lra) ltac:(lra) Bz')
    as (g & m & G1 & G2 & G3 & G4).
  apply Rabs_le_inv in Cp. apply Rabs_le_inv in Cq. destruct Ip as [Vp Fp]. destruct Iq as [Vq Fq]. destruct G1 as [V1 F1].
  destruct G2 as [V2 F2].
  apply Rabs_le_inv in G4. pose proof (Rabs_le_inv _ _ G3) as G3'.
  assert (Hyc : y * c <= 1000001 / 1000000 * (T * c)) by (rewrite <- Rmult_assoc; apply Rmult_le_compat_r; lra).
  assert (Hyz : - (25 * (unit53 * unit53) * (T * c)) <= (y + z) * c - T * c <= 25 * (unit53 * unit53) * (T * c)).
  { replace ((y + z) * c - T * c) with ((y + z - T) * c) by ring.
    replace (25 * (unit53 * unit53) * (T * c)) with (25 * (unit53 * unit53) * T * c) by ring.
    split; [replace (- (25 * (unit53 * unit53) * T * c)) with (- (25 * (unit53 * unit53) * T) * c) by ring|]; apply Rmult_le_compat_r;
      lra. }
  set (H := T * c) in *. set (yc := y * c) in *.
  split; try rewrite Vp; try rewrite Vq; try rewrite V1; try rewrite V2; try assumption.
  - repeat split; assumption.
  - unfold unit53 in *. lra.
  - apply Rabs_le. unfold height_share, unit53 in *. lra.
  - lra.
  - apply Rabs_le. unfold slope_share, unit53 in *. lra.
Qed.

Definition bump_2p_shaded_of (R w K : binary32) (is_fused : bool) : binary64 -> binary64 -> FirstStage :=
  bump_2p_shaded is_fused (hi (height_2p R w)) (lo (height_2p R w)) (split_head (tangent_2p R w)) (split_tail (tangent_2p R w))
    (to64 R) (K_over_R K R) (half_width w).

(* Every answer of the first stage of bump-2p-shaded is right, for every input of the domain. *)
Theorem bump_2p_shaded_first_stage_answers_right_for_all : forall is_fused R w K later x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_2p (value32 R) (value32 w) X Z in
  right_or_later (evaluate bump_2p_shaded_window (bump_2p_shaded_of R w K is_fused) later x y z) (later (quantised x) (quantised z)) (0
    < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros is_fused R w K later x y z Hp Hv. apply bump_2p_shaded_first_stage_answers_right; try assumption.
  now apply linear_2p_is_right with K.
Qed.
