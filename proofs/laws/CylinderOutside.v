(* SPDX-License-Identifier: BSD-3-Clause *)
(* v of the first stage of cylinder where no force acts, rho >= R: it is not positive where the first stage does not doubt it. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import CylinderForce CylinderFirst.
Open Scope R_scope.

(* A rounding moves a number by no more than this, in terms of a bound of the number. *)
Lemma rounded_within : forall a m, Rabs a <= m -> Rabs (nearest64 a - a) <= unit53 * m + tiny.
Proof.
  intros a m H. pose proof (product_is_close a). pose proof unit_is_small. apply Rle_trans with (1 := H0). nra.
Qed.

(* Far out, x^2 + z^2 > 8 R^2, v is so negative that no rounding matters. *)
Lemma cylinder_v_is_negative_far : forall is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> coordinate xv X -> coordinate zv Z ->
  8 * (value32 R * value32 R) < X * X + Z * Z ->
  exists y, is64 (cylinder_v is_fused anchor anchored rest d_head d_tail xv zv) y /\ y <= 0 /\ Rabs y <= bpow radix2 40.
Proof.
  intros is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z Hp Dp Hx Hz HS.
  destruct Dp as [(Fa & Fr & Fh & Ft & _) Ianchor Eanchored Rr Bits Rh Rt Re _].
  destruct Hp as ((FR & _ & _) & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  set (Rad := value32 R) in *. set (d := axis_depth Rad _) in *. set (c := value32 w / 2) in *.
  set (A := value64 anchored) in *. set (r := value64 rest) in *. set (dh := value64 d_head) in *. set (dt := value64 d_tail) in *.
  assert (IA : is64 anchored A) by now split. assert (Ir : is64 rest r) by now split.
  assert (Ih : is64 d_head dh) by now split. assert (It : is64 d_tail dt) by now split.
  destruct Hx as [Hx Fx Rx _]. destruct Hz as [Hz Fz Rz _]. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  assert (big : forall a, Rabs a <= 10000000000 -> Rabs a <= bpow radix2 1000).
  { intros a Ha. apply Rle_trans with (bpow radix2 40); [simpl; lra|apply bpow_le; lia]. }
  set (Q := Rad * Rad) in *. set (C := c * c) in *. set (XX := X * X) in *. set (ZZ := Z * Z) in *. set (S := XX + ZZ) in *.
  assert (HSE : XX + ZZ = S) by reflexivity. clearbody S.
  assert (HQ : / 100 <= Q <= 100000000) by (unfold Q; nra). assert (HCQ : 0 <= C <= Q) by (unfold C, Q, c; split; nra).
  assert (HdR : d <= Rad) by (unfold Q in *; nra). assert (HXX : 0 <= XX) by (unfold XX; nra).
  assert (HZZ : 0 <= ZZ) by (unfold ZZ; nra).
  assert (square : forall a, Rabs a <= 10000 -> a * a <= 100000000).
  { intros a Ha. apply Rabs_le_inv in Ha. nra. }
  pose proof (square X Rx) as RXX. pose proof (square Z Rz) as RZZ. fold XX in RXX. fold ZZ in RZZ. clear square.
  assert (RS : S <= 200000000) by lra.
  assert (HA : 0 <= A <= 1126 / 1000 * S) by (apply Rabs_le_inv in Rr; unfold unit53 in *; lra).
  assert (Gxx : in_binary64 XX) by now apply product_is_binary64. assert (Gzz : in_binary64 ZZ) by now apply product_is_binary64.
  (* 2 z d_head and 2 z d_tail; Y is |z| d_head *)
  assert (Hdh : dh <= 10001 / 10000 * d) by (apply Rabs_le_inv in Rt; apply Rabs_le_inv in Re; unfold tail_share, slope_share in *;
    lra).
  set (Y := Rabs Z * dh).
  assert (HY : 0 <= Y /\ 2 * Y <= 708 / 1000 * S).
  { pose proof (Rabs_pos Z) as HZ. split; [unfold Y; nra|].
    assert (EZ : Rabs Z * Rabs Z = ZZ) by (rewrite <- Rabs_mult; now apply Rabs_pos_eq).
    assert (0 <=
      (595 / 1000 * Rabs Z - 1681 / 1000 * Rad) *
      (595 / 1000 * Rabs Z - 1681 / 1000 * Rad)) by apply Rle_0_sqr.
    assert (Y <= Rabs Z * (10001 / 10000 * Rad)) by (apply Rmult_le_compat_l; lra).
    assert (0 <= Rabs Z * Rad) by (apply Rmult_le_pos; lra).
    assert (2 * (Rabs Z * Rad) <= 354025 / 1000000 * ZZ + 2825761 / 1000000 * Q) by (unfold Q; lra).
    assert (ZZ <= S) by lra. lra. }
  assert (Idh2 : is64 (times (two_to 1) d_head) (2 * dh)).
  { change 2 with (bpow radix2 1). apply scaled_is; try assumption; try lia.
    - rewrite <- (Rmult_1_r dh). apply product_scaled; [lia|assumption|apply one_is_binary32].
    - apply big. change (bpow radix2 1) with 2. rewrite Rabs_pos_eq; lra. }
  assert (Gzd : in_binary64 (Z * (2 * dh))).
  { replace (Z * (2 * dh)) with (bpow radix2 1 * (dh * Z)) by (change (bpow radix2 1) with 2; ring).
    apply product_scaled; [lia|assumption|assumption]. }
  assert (Azd : Rabs (Z * (2 * dh)) = 2 * Y) by (unfold Y; rewrite Rabs_mult, (Rabs_pos_eq (2 * dh)) by lra; ring).
  assert (Rdt2 : Rabs (2 * dt) <= 1) by (rewrite Rabs_mult, (Rabs_pos_eq 2) by lra; unfold tail_share in Rt; lra).
  assert (Idt2 : is64 (times (two_to 1) d_tail) (2 * dt)).
  { change 2 with (bpow radix2 1). apply scaled_is; try assumption; try lia; [|apply big; change (bpow radix2 1) with 2; lra].
    rewrite Rmult_comm. apply Mult_error.mult_bpow_pos_exact_FLT; [now apply format_of in It|lia]. }
  set (T := Z * (2 * dt)). assert (BT : Rabs T <= / 100000000 * S).
  { apply Rle_trans with (2 * tail_share * Y); [|unfold tail_share; lra].
    unfold T, Y. rewrite !Rabs_mult, (Rabs_pos_eq 2) by lra. pose proof (Rabs_pos Z).
    replace (2 * tail_share * (Rabs Z * dh)) with (Rabs Z * (2 * (tail_share * dh))) by ring. apply Rmult_le_compat_l; lra. }
  (* Every operation, with its rounding *)
  assert (ES : unit53 * S <= / 1000000000 * S) by (apply Rmult_le_compat_r; lra).
  assert (Et : tiny <= / 1000000000 * S) by lra.
  assert (off : forall a m, Rabs a <= m -> 0 <= m <= 10 * S -> Rabs (nearest64 a - a) <= / 10000000 * S).
  { intros a m Ha Hm. apply Rle_trans with (1 := rounded_within a m Ha). assert (unit53 * m <= / 1000000000 * m) by nra. lra. }
  set (a := nearest64 (A - XX)). assert (Ba : Rabs (A - XX) <= 2 * S) by (apply Rabs_le; lra).
  pose proof (off _ _ Ba ltac:(lra)) as Ea. fold a in Ea. apply Rabs_le_inv in Ea.
  assert (Ia : is64 (multiply_subtract is_fused xv xv anchored) a).
  { apply multiply_subtract_is; try assumption; apply big; fold XX; [rewrite Rabs_pos_eq; lra|lra]. }
  set (a_back := nearest64 (A - a)). assert (Bab : Rabs (A - a) <= 2 * S) by (apply Rabs_le; lra).
  pose proof (off _ _ Bab ltac:(lra)) as Eab. fold a_back in Eab. apply Rabs_le_inv in Eab.
  assert (Iab : is64 (minus anchored (multiply_subtract is_fused xv xv anchored)) a_back) by (apply minus_is; try assumption;
    apply big; lra).
  set (e1 := nearest64 (a_back - XX)). assert (Be1 : Rabs (a_back - XX) <= S) by (apply Rabs_le; lra).
  pose proof (off _ _ Be1 ltac:(lra)) as Ee1. fold e1 in Ee1. apply Rabs_le_inv in Ee1.
  assert (Ie1 : is64 (multiply_subtract is_fused xv xv (minus anchored (multiply_subtract is_fused xv xv anchored))) e1).
  { apply multiply_subtract_is; try assumption; apply big; fold XX; [rewrite Rabs_pos_eq; lra|lra]. }
  set (b := nearest64 (a - ZZ)). assert (Bb : Rabs (a - ZZ) <= 2 * S) by (apply Rabs_le; lra).
  pose proof (off _ _ Bb ltac:(lra)) as Eb. fold b in Eb. apply Rabs_le_inv in Eb.
  assert (Ib : is64 (multiply_subtract is_fused zv zv (multiply_subtract is_fused xv xv anchored)) b).
  { apply multiply_subtract_is; try assumption; apply big; fold ZZ; [rewrite Rabs_pos_eq; lra|lra]. }
  set (b_back := nearest64 (a - b)). assert (Bbb : Rabs (a - b) <= 2 * S) by (apply Rabs_le; lra).
  pose proof (off _ _ Bbb ltac:(lra)) as Ebb. fold b_back in Ebb. apply Rabs_le_inv in Ebb.
  pose proof (minus_is _ _ _ _ Ia Ib ltac:(apply big; lra)) as Ibb. fold b_back in Ibb.
  set (e2 := nearest64 (b_back - ZZ)). assert (Be2 : Rabs (b_back - ZZ) <= S) by (apply Rabs_le; lra).
  pose proof (off _ _ Be2 ltac:(lra)) as Ee2. fold e2 in Ee2. apply Rabs_le_inv in Ee2.
  assert (Ie2 : is64 (multiply_subtract is_fused zv zv (minus (multiply_subtract is_fused xv xv anchored)
                        (multiply_subtract is_fused zv zv (multiply_subtract is_fused xv xv anchored)))) e2).
  { apply multiply_subtract_is; try assumption; apply big; fold ZZ; [rewrite Rabs_pos_eq; lra|lra]. }
  set (e := nearest64 (e1 + e2)). assert (Be : Rabs (e1 + e2) <= S) by (apply Rabs_le; lra).
  pose proof (off _ _ Be ltac:(lra)) as Ee. fold e in Ee. apply Rabs_le_inv in Ee.
  pose proof (plus_is _ _ _ _ Ie1 Ie2 ltac:(apply big; lra)) as Ie. fold e in Ie.
  set (t := nearest64 T). pose proof (off _ _ BT ltac:(lra)) as Ett. fold t in Ett. apply Rabs_le_inv in Ett.
  pose proof (times_is _ _ _ _ Hz Idt2 ltac:(apply big; fold T; lra)) as Itt. fold T t in Itt.
  apply Rabs_le_inv in BT. apply Rabs_le_inv in Rr.
  set (f := nearest64 (r - t)). assert (Bf : Rabs (r - t) <= S) by (apply Rabs_le; unfold unit53 in *; lra).
  pose proof (off _ _ Bf ltac:(lra)) as Ef. fold f in Ef. apply Rabs_le_inv in Ef.
  pose proof (minus_is _ _ _ _ Ir Itt ltac:(apply big; lra)) as If. fold f in If.
  set (low := nearest64 (e + f)). assert (Bl : Rabs (e + f) <= S) by (apply Rabs_le; unfold unit53 in *; lra).
  pose proof (off _ _ Bl ltac:(lra)) as El. fold low in El. apply Rabs_le_inv in El.
  pose proof (plus_is _ _ _ _ Ie If ltac:(apply big; lra)) as Il. fold low in Il.
  set (g := nearest64 (b - 8 * Q)). assert (Bg : Rabs (b - 8 * Q) <= 3 * S) by (apply Rabs_le; lra).
  pose proof (off _ _ Bg ltac:(lra)) as Eg. fold g in Eg. apply Rabs_le_inv in Eg.
  pose proof (minus_is _ _ _ _ Ib Ianchor ltac:(apply big; lra)) as Ig. fold Q g in Ig.
  set (p := nearest64 (g - Z * (2 * dh))). pose proof (Rabs_le_inv _ _ (Req_le _ _ Azd)) as Bzd.
  assert (Bp : Rabs (g - Z * (2 * dh)) <= 5 * S) by (apply Rabs_le; lra).
  pose proof (off _ _ Bp ltac:(lra)) as Ep. fold p in Ep. apply Rabs_le_inv in Ep.
  assert (Ip : is64 (multiply_subtract is_fused zv (times (two_to 1) d_head)
                       (minus (multiply_subtract is_fused zv zv (multiply_subtract is_fused xv xv anchored)) anchor)) p).
  { apply multiply_subtract_is; try assumption; apply big; [rewrite Azd|]; lra. }
  assert (Hneg : - 10 * S <= p + low <= 0) by (unfold unit53 in *; lra).
  exists (nearest64 (p + low)). split; [|split].
  - unfold cylinder_v. cbv zeta. apply plus_is; try assumption. apply big. apply Rabs_le. lra.
  - rewrite <- (round_0 radix2 fexp64 ZnearestE). apply round_le; auto with typeclass_instances. lra.
  - apply abs_round_le_generic; auto with typeclass_instances; [apply generic_format_bpow; unfold FLT_exp; lia|].
    apply Rabs_le. change (bpow radix2 40) with 1099511627776. lra.
Qed.

(* No contact where rho >= R. *)
Theorem cylinder_v_is_not_positive : forall is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> coordinate xv X -> coordinate zv Z ->
  let L := Z + axis_depth (value32 R) (value32 w) in
  let v := cylinder_v is_fused anchor anchored rest d_head d_tail xv zv in
  let least := multiply_add is_fused (absolute zv) (times (two_to (-25)) d_head) (times (two_to (-50)) anchor) in
  value32 R * value32 R <= X * X + L * L -> is_less (absolute v) least = false ->
  exists y, is64 v y /\ y <= 0 /\ Rabs y <= bpow radix2 40.
Proof.
  intros is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z Hp Dp Hx Hz L v least HV Hclear.
  destruct (Rle_or_lt (X * X + Z * Z) (8 * (value32 R * value32 R))) as [HS|HS].
  - destruct (cylinder_v_is_computed is_fused R w K _ _ _ _ _ _ xv X zv Z Hp Dp Hx Hz HS Hclear) as (s & Iv & Es & _ & Bs & _).
    exists (nearest64 s). split; [exact Iv|]. fold L in Bs. pose proof unit_is_small. apply Rabs_le_inv in Bs. apply Rabs_le_inv in Es.
    pose proof (Rabs_pos s). destruct (Rle_or_lt s 0) as [Hs|Hs]; [|rewrite (Rabs_pos_eq s) in * by lra; lra].
    rewrite (Rabs_left1 s) in * by assumption. split; [nra|].
    destruct Hp as (_ & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
    assert (RL : -20000 <= L <= 20000).
    { pose proof (coordinate_range _ _ Hz) as Rz. apply Rabs_le_inv in Rz.
      assert (axis_depth (value32 R) (value32 w) <= value32 R) by nra.
      unfold L. lra. }
    assert (RX : -10000 <= X <= 10000) by (apply Rabs_le_inv, Hx).
    assert (L * L <= 400000000) by nra. assert (X * X <= 100000000) by nra. assert (0 <= value32 R * value32 R) by nra.
    assert (unit53 * - s <= - s) by nra. change (bpow radix2 40) with 1099511627776. apply Rabs_le. lra.
  - apply (cylinder_v_is_negative_far is_fused R w K _ _ _ _ _ axis xv X zv Z); assumption.
Qed.
