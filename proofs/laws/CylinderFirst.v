(* SPDX-License-Identifier: BSD-3-Clause *)
(* v = R^2 - rho^2 and l = z + d of the first stage of cylinder, fast/laws/cylinder.h, where the force acts. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Sterbenz.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import CylinderForce.
Open Scope R_scope.

(* What the law holds of R, w and the depth d of its axis. axis is the binary32 number nearest to -d: every other one that a z may be
   is this far off. *)
Record depth (R w : binary32) (anchor anchored rest d_head d_tail axis : binary64) : Prop := {
  depth_finite : is_finite 53 1024 anchored = true /\ is_finite 53 1024 rest = true /\ is_finite 53 1024 d_head = true /\
    is_finite 53 1024 d_tail = true /\ is_finite 53 1024 axis = true;
  depth_anchor : is64 anchor (8 * (value32 R * value32 R));
  depth_anchored : value64 anchored + value64 rest = 8 * (value32 R * value32 R) + value32 w / 2 * (value32 w / 2);
  depth_rest : Rabs (value64 rest) <= unit53 * value64 anchored;
  depth_bits : generic_format radix2 (FLT_exp (-149) 29) (value64 d_head);
  depth_head : 0 <= value64 d_head <= 10001;
  depth_tail : Rabs (value64 d_tail) <= tail_share * value64 d_head;
  depth_error : Rabs (axis_depth (value32 R) (value32 w) - (value64 d_head + value64 d_tail)) <= slope_share * value64 d_head;
  depth_axis : forall Z, in_binary32 Z -> Z = 0 \/ bpow radix2 (-30) <= Rabs Z -> Z <> value64 axis ->
    / 134217728 * value64 d_head <= Rabs (Z + axis_depth (value32 R) (value32 w)) /\
    bpow radix2 (-60) <= Rabs (Z + axis_depth (value32 R) (value32 w)) /\
    (value64 axis < Z -> 0 < Z + axis_depth (value32 R) (value32 w))
}.

Lemma product_scaled : forall k a b, (-500 <= k)%Z -> generic_format radix2 (FLT_exp (-149) 29) a -> in_binary32 b ->
  in_binary64 (bpow radix2 k * (a * b)).
Proof.
  intros k a b Hk Ha Hb. apply FLT_format_generic in Ha; [|reflexivity]. apply FLT_format_generic in Hb; [|reflexivity].
  destruct Ha as [[m e] H1 H2 H3], Hb as [[n g] G1 G2 G3]. rewrite H1, G1, <- Operations.F2R_mult.
  replace (bpow radix2 k) with (F2R (Float radix2 1 k)) by (unfold F2R; cbn [Fnum Fexp]; apply Rmult_1_l).
  rewrite <- Operations.F2R_mult.
  cbn [Fnum Fexp] in *. apply generic_format_FLT. exists (Float radix2 (1 * (m * n)) (k + (e + g))); [reflexivity| |].
  - cbn [Fnum]. rewrite Z.mul_1_l, Z.abs_mul. change (Zpower radix2 29) with 536870912%Z in *.
    change (Zpower radix2 24) with 16777216%Z in *.
    change (Zpower radix2 53) with 9007199254740992%Z. nia.
  - cbn [Fexp]. lia.
Qed.

Lemma one_is_binary32 : in_binary32 1.
Proof. change 1 with (bpow radix2 0). apply generic_format_bpow. unfold FLT_exp. lia. Qed.

Lemma scaled_is : forall k v a, (-500 <= k <= 10)%Z -> is64 v a -> in_binary64 (bpow radix2 k * a) ->
  Rabs (bpow radix2 k * a) <= bpow radix2 1000 ->
  is64 (times (two_to k) v) (bpow radix2 k * a).
Proof.
  intros k v a Hk Hv Hf Hb. rewrite <- (round_generic radix2 fexp64 ZnearestE (bpow radix2 k * a)) by assumption.
  apply times_is; [apply two_to_is; lia|assumption|assumption].
Qed.

Lemma depth_squared : forall Rad w, 0 < w -> w <= 2 * Rad -> 0 <= axis_depth Rad w /\
  axis_depth Rad w * axis_depth Rad w = Rad * Rad - w / 2 * (w / 2).
Proof. intros Rad w Hw HR. unfold axis_depth. split; [apply sqrt_pos|]. rewrite sqrt_sqrt; unfold Rsqr; nra. Qed.

(* Inside of the cylinder x^2 + z^2 is no more than 4 R^2 and a little less. *)
Lemma inside_is_near : forall Rad c d X Z, 0 < c -> 0 <= d -> d * d = Rad * Rad - c * c ->
  0 < Rad * Rad - (X * X + (Z + d) * (Z + d)) -> 0 <= Rad -> X * X + Z * Z <= 4 * (Rad * Rad) - 2 * (c * c).
Proof.
  intros Rad c d X Z Hc Hd Hd2 HV HR. set (Q := Rad * Rad) in *. set (C := c * c) in *. set (L := Z + d) in *.
  assert (HdR : d <= Rad) by (unfold Q, C in *; nra). assert (HL2 : L * L <= Q) by nra.
  assert (HLR : - Rad <= L <= Rad) by (unfold Q in HL2; split; nra).
  assert (E : X * X + Z * Z = Q - (Q - (X * X + L * L)) - d * d - 2 * Z * d) by (unfold L; ring).
  assert (- Z * d <= (Rad + d) * d) by (apply Rmult_le_compat_r; [assumption|unfold L in HLR; lra]).
  assert (0 <= (Rad - d) * (Rad - d)) by (apply Rle_0_sqr). unfold Q in *. nra.
Qed.

(* l, but at the one z next to -d. *)
Theorem cylinder_l_is_near : forall R w K anchor anchored rest d_head d_tail axis zv Z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> coordinate zv Z -> Z <> value64 axis ->
  let L := Z + axis_depth (value32 R) (value32 w) in
  computes (cylinder_l d_head d_tail zv) (201 / 100) L (-60) 15.
Proof.
  intros R w K anchor anchored rest d_head d_tail axis zv Z Hp D Hz Hne L.
  destruct D as [(_ & _ & Fh & Ft & _) _ _ _ Bits Rh Rt Re Ax]. pose proof (coordinate_not_tiny _ _ Hz) as Tz.
  destruct Hz as [Hz Fz Rz _]. destruct (Ax Z Fz Tz Hne) as (Ax1 & Ax2 & _). fold L in Ax1, Ax2.
  destruct Hp as (_ & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  set (d := axis_depth _ _) in *. set (dh := value64 d_head) in *. set (dt := value64 d_tail) in *.
  assert (Hd : d <= value32 R) by nra.
  assert (Ih : is64 d_head dh) by now split. assert (It : is64 d_tail dt) by now split.
  pose proof (format_of _ _ Hz) as Gz. pose proof (format_of _ _ Ih) as Gh. pose proof unit_is_small as Hu.
  assert (big : forall a, Rabs a <= 1000000 -> Rabs a <= bpow radix2 1000).
  { intros a Ha. apply Rle_trans with (bpow radix2 20); [simpl; lra|apply bpow_le; lia]. }
  set (l1 := nearest64 (Z + dh)). pose proof (sum_is_close Z dh Gz Gh) as E1. fold l1 in E1.
  assert (Rzh : Rabs (Z + dh) <= 20001) by (apply Rabs_le; apply Rabs_le_inv in Rz; lra).
  assert (I1 : is64 (plus zv d_head) l1) by (apply plus_is; try assumption; apply big; lra).
  assert (R1 : Rabs l1 <= 20002) by (pose proof (Rabs_triang_inv l1 (Z + dh)); unfold unit53 in *; lra).
  assert (Rdt : Rabs dt <= 1) by (apply Rle_trans with (1 := Rt); unfold tail_share; lra).
  exists (nearest64 (l1 + dt)). split; [|split].
  - apply plus_is; try assumption. apply big. apply Rle_trans with (1 := Rabs_triang _ _). lra.
  - apply near_more with (one + 1003 / 1000 * unit53 * (1 + / 1000) / unit53); [|unfold one, unit53; lra].
    apply near_then with (l1 + dt); [apply sum_is_near; [now apply format_of in I1|now apply format_of in It]|].
    apply close_is_near; [|unfold unit53; lra].
    assert (EL : l1 + dt - L = (l1 - (Z + dh)) - (d - (dh + dt))) by (unfold L; ring). rewrite EL.
    apply Rle_trans with (Rabs (l1 - (Z + dh)) + Rabs (d - (dh + dt))).
    { unfold Rminus at 1. apply Rle_trans with (1 := Rabs_triang _ _). now rewrite Rabs_Ropp; apply Rle_refl. }
    destruct (Rle_or_lt (Rabs (Z + dh)) (dh / 2)) as [Hc|Hc].
    + apply Rabs_le_inv in Hc. assert (Eq : l1 = Z + dh).
      { apply round_generic; auto with typeclass_instances. replace (Z + dh) with (dh - - Z) by ring.
        apply sterbenz; auto with typeclass_instances; [now apply generic_format_opp|lra]. }
      rewrite Eq, Rminus_diag_eq, Rabs_R0 by reflexivity. unfold slope_share, unit53 in *. lra.
    + assert (HL : Rabs (Z + dh) <= 10001 / 10000 * Rabs L).
      { pose proof (Rabs_triang_inv (Z + dh) L) as T. replace (Z + dh - L) with (- (d - (dh + dt)) - dt) in T by (unfold L; ring).
        pose proof (Rabs_triang (- (d - (dh + dt))) (- dt)) as T2. rewrite !Rabs_Ropp in T2. unfold Rminus at 3 in T.
        unfold tail_share, slope_share, Rminus in *. lra. }
      pose proof (Rabs_pos L). unfold slope_share, unit53 in *. lra.
  - split; [assumption|]. apply Rle_trans with 20001; [|simpl; lra]. unfold L. apply Rabs_le. apply Rabs_le_inv in Rz. lra.
Qed.

(* v where x^2 + z^2 <= 8 R^2 and the first stage does not doubt it: the sum s that is rounded to it is large, and near V. *)
Lemma cylinder_v_is_computed : forall is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> coordinate xv X -> coordinate zv Z ->
  let L := Z + axis_depth (value32 R) (value32 w) in
  let V := value32 R * value32 R - (X * X + L * L) in
  let v := cylinder_v is_fused anchor anchored rest d_head d_tail xv zv in
  let least := multiply_add is_fused (absolute zv) (times (two_to (-25)) d_head) (times (two_to (-50)) anchor) in
  X * X + Z * Z <= 8 * (value32 R * value32 R) -> is_less (absolute v) least = false ->
  exists s, is64 v (nearest64 s) /\ Rabs (nearest64 s - s) <= unit53 * Rabs s /\
    / 140737488355328 * (value32 R * value32 R) <= 1002 / 1000 * Rabs s /\ Rabs (s - V) <= Rabs s / 4 /\
    (0 < V -> Rabs (s - V) <= 2335 / 1000 * unit53 * Rabs s).
Proof.
  intros is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z Hp Dp Hx Hz L V v least HS Hclear.
  destruct Dp as [(Fa & Fr & Fh & Ft & _) Ianchor Eanchored Rr Bits Rh Rt Re _].
  destruct Hp as ((FR & _ & _) & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  set (Rad := value32 R) in *. set (d := axis_depth Rad _) in *. set (c := value32 w / 2) in *.
  set (A := value64 anchored) in *. set (r := value64 rest) in *. set (dh := value64 d_head) in *. set (dt := value64 d_tail) in *.
  assert (IA : is64 anchored A) by now split. assert (Ir : is64 rest r) by now split.
  assert (Ih : is64 d_head dh) by now split. assert (It : is64 d_tail dt) by now split.
  destruct Hx as [Hx Fx Rx _]. destruct Hz as [Hz Fz Rz _]. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  assert (big : forall a, Rabs a <= 10000000000 -> Rabs a <= bpow radix2 1000).
  { intros a Ha. apply Rle_trans with (bpow radix2 40); [simpl; lra|apply bpow_le; lia]. }
  (* Sizes: Q is R^2, C is (w/2)^2. *)
  set (Q := Rad * Rad) in *. set (C := c * c) in *. set (XX := X * X). set (ZZ := Z * Z).
  assert (HQ : / 100 <= Q <= 100000000) by (unfold Q; nra).
  assert (HC : / 4000000 <= C) by (unfold C, c; nra).
  assert (HCQ : 25 / 10000000000000000 * Q <= C) by lra.
  assert (HdR : d <= Rad) by (unfold Q in *; nra).
  assert (HXX : 0 <= XX <= 8 * Q) by (unfold XX; split; nra).
  assert (HCQ2 : C <= Q) by nra.
  assert (HZZ : 0 <= ZZ <= 8 * Q - XX) by (unfold ZZ, XX; split; nra).
  assert (HA8 : 8 * Q + 3 / 2000000000000000 * Q <= A) by (apply Rabs_le_inv in Rr; unfold unit53 in *; lra).
  assert (HA : 8 * Q * (1 - / 1000000000000) <= A <= 9 * Q * (1 + / 1000000000000)).
  { apply Rabs_le_inv in Rr. unfold unit53 in *. lra. }
  pose proof (format_of _ _ IA) as GA. pose proof (format_of _ _ Hz) as Gz.
  assert (Gxx : in_binary64 XX) by now apply product_is_binary64. assert (Gzz : in_binary64 ZZ) by now apply product_is_binary64.
  (* a *)
  set (a := nearest64 (A - XX)). pose proof (difference_is_close A XX GA Gxx) as Ea. fold a in Ea.
  rewrite (Rabs_pos_eq (A - XX)) in Ea by lra.
  assert (Ra : ZZ <= a <= 9001 / 1000 * Q) by (apply Rabs_le_inv in Ea; unfold unit53 in *; lra).
  assert (Ia : is64 (multiply_subtract is_fused xv xv anchored) a).
  { apply multiply_subtract_is; try assumption; apply big; fold XX; rewrite Rabs_pos_eq; lra. }
  pose proof (format_of _ _ Ia) as Ga.
  set (e1 := A - XX - a). assert (Re1 : Rabs e1 <= 9001 / 1000 * unit53 * Q).
  { unfold e1. rewrite Rabs_minus_sym. apply Rle_trans with (1 := Ea). unfold unit53. lra. }
  assert (X1 : nearest64 (nearest64 (A - a) - XX) = e1) by (apply error_of_difference; try assumption; lra).
  assert (Iback : is64 (minus anchored (multiply_subtract is_fused xv xv anchored)) (nearest64 (A - a))).
  { apply minus_is; try assumption. apply big. apply Rabs_le. lra. }
  assert (Rback : Rabs (nearest64 (A - a)) <= 2000000000).
  { pose proof (difference_is_close A a GA Ga) as T. assert (Rabs (A - a) <= 1800000000) by (apply Rabs_le; lra).
    pose proof (Rabs_triang_inv (nearest64 (A - a)) (A - a)). unfold unit53 in *. lra. }
  assert (I1 : is64 (multiply_subtract is_fused xv xv (minus anchored (multiply_subtract is_fused xv xv anchored))) e1).
  { rewrite <- X1. apply multiply_subtract_is; try assumption; apply big; fold XX; [rewrite Rabs_pos_eq; lra|].
    apply Rabs_le_inv in Rback. apply Rabs_le. lra. }
  (* b *)
  set (b := nearest64 (a - ZZ)). pose proof (difference_is_close a ZZ Ga Gzz) as Eb. fold b in Eb.
  rewrite (Rabs_pos_eq (a - ZZ)) in Eb by lra.
  assert (Ib : is64 (multiply_subtract is_fused zv zv (multiply_subtract is_fused xv xv anchored)) b).
  { apply multiply_subtract_is; try assumption; apply big; fold ZZ; rewrite Rabs_pos_eq; lra. }
  pose proof (format_of _ _ Ib) as Gb.
  set (e2 := a - ZZ - b). assert (Re2 : Rabs e2 <= 9001 / 1000 * unit53 * Q).
  { unfold e2. rewrite Rabs_minus_sym. apply Rle_trans with (1 := Eb). unfold unit53. lra. }
  assert (Rb : 0 <= b <= 9002 / 1000 * Q) by (apply Rabs_le_inv in Eb; unfold unit53 in *; lra).
  assert (X2 : nearest64 (nearest64 (a - b) - ZZ) = e2) by (apply error_of_difference; try assumption; lra).
  assert (Iback2 : is64 (minus (multiply_subtract is_fused xv xv anchored)
                           (multiply_subtract is_fused zv zv (multiply_subtract is_fused xv xv anchored))) (nearest64 (a - b))).
  { apply minus_is; try assumption. apply big. apply Rabs_le. lra. }
  assert (Rback2 : Rabs (nearest64 (a - b)) <= 2000000000).
  { pose proof (difference_is_close a b Ga Gb) as T. assert (Rabs (a - b) <= 1800000000) by (apply Rabs_le; lra).
    pose proof (Rabs_triang_inv (nearest64 (a - b)) (a - b)). unfold unit53 in *. lra. }
  assert (I2 : is64 (multiply_subtract is_fused zv zv (minus (multiply_subtract is_fused xv xv anchored)
                       (multiply_subtract is_fused zv zv (multiply_subtract is_fused xv xv anchored)))) e2).
  { rewrite <- X2. apply multiply_subtract_is; try assumption; apply big; fold ZZ; [rewrite Rabs_pos_eq; lra|].
    apply Rabs_le_inv in Rback2. apply Rabs_le. lra. }
  (* g = b - anchor is exact where the force acts *)
  pose proof (format_of _ _ Ianchor) as Ganchor.
  set (g := nearest64 (b - 8 * Q)). pose proof (difference_is_close b (8 * Q) Gb Ganchor) as Eg. fold g in Eg.
  assert (Bg : Rabs (b - 8 * Q) <= 8 * Q) by (apply Rabs_le; lra).
  assert (Hg : 0 < V -> g = b - 8 * Q).
  { intro HV. apply round_generic; auto with typeclass_instances. apply sterbenz; auto with typeclass_instances.
    pose proof (inside_is_near Rad c d X Z ltac:(unfold c; lra) Hd0 Hd2 HV ltac:(lra)) as Hsum. fold XX ZZ Q C in Hsum.
    apply Rabs_le_inv in Ea. apply Rabs_le_inv in Eb. apply Rabs_le_inv in Rr. unfold unit53 in *. lra. }
  assert (Ig : is64 (minus (multiply_subtract is_fused zv zv (multiply_subtract is_fused xv xv anchored)) anchor) g).
  { apply minus_is; try assumption. apply big. lra. }
  pose proof (format_of _ _ Ig) as Gg. assert (Rg : Rabs g <= 850000000).
  { pose proof (Rabs_triang_inv g (b - 8 * Q)). unfold unit53 in *. lra. }
  (* 2 z d_head and 2 z d_tail; Y is |z| d_head *)
  set (Y := Rabs Z * dh). assert (HY : 0 <= Y <= 200000000) by (unfold Y; pose proof (Rabs_pos Z); split; nra).
  assert (Gdh2 : in_binary64 (bpow radix2 1 * dh)).
  { rewrite <- (Rmult_1_r dh). apply product_scaled; [lia|assumption|apply one_is_binary32]. }
  assert (Idh2 : is64 (times (two_to 1) d_head) (2 * dh)).
  { change 2 with (bpow radix2 1). apply scaled_is; try assumption; try lia. apply big. change (bpow radix2 1) with 2.
    rewrite Rabs_pos_eq; lra. }
  assert (Gzd : in_binary64 (Z * (2 * dh))).
  { replace (Z * (2 * dh)) with (bpow radix2 1 * (dh * Z)) by (change (bpow radix2 1) with 2; ring).
    apply product_scaled; [lia|assumption|assumption]. }
  assert (Azd : Rabs (Z * (2 * dh)) = 2 * Y) by (unfold Y; rewrite Rabs_mult, (Rabs_pos_eq (2 * dh)) by lra; ring).
  set (p := nearest64 (g - Z * (2 * dh))). pose proof (difference_is_close _ _ Gg Gzd) as Ep. fold p in Ep.
  set (P := g - Z * (2 * dh)) in *.
  assert (RP : Rabs P <= 1500000000).
  { unfold P, Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp, Azd. lra. }
  assert (Ip : is64 (multiply_subtract is_fused zv (times (two_to 1) d_head)
                       (minus (multiply_subtract is_fused zv zv (multiply_subtract is_fused xv xv anchored)) anchor)) p).
  { apply multiply_subtract_is; try assumption; apply big; [rewrite Azd; lra|fold P; lra]. }
  assert (Gdt2 : in_binary64 (2 * dt)).
  { replace (2 * dt) with (dt * bpow radix2 1) by (change (bpow radix2 1) with 2; ring).
    apply Mult_error.mult_bpow_pos_exact_FLT; [now apply format_of in It|lia]. }
  assert (Rdt2 : Rabs (2 * dt) <= 1).
  { rewrite Rabs_mult, (Rabs_pos_eq 2) by lra. unfold tail_share in Rt. lra. }
  assert (Idt2 : is64 (times (two_to 1) d_tail) (2 * dt)).
  { change 2 with (bpow radix2 1). apply scaled_is; try assumption; try lia. apply big. change (bpow radix2 1) with 2. lra. }
  set (T := Z * (2 * dt)). assert (BT : Rabs T <= 2 * tail_share * Y).
  { unfold T, Y. rewrite !Rabs_mult, (Rabs_pos_eq 2) by lra. pose proof (Rabs_pos Z).
    replace (Rabs Z * (2 * Rabs dt)) with (2 * (Rabs Z * Rabs dt)) by ring.
    replace (2 * tail_share * (Rabs Z * dh)) with (2 * (Rabs Z * (tail_share * dh))) by ring.
    apply Rmult_le_compat_l; [lra|]. now apply Rmult_le_compat_l. }
  set (t := nearest64 T). pose proof (product_is_close T) as Et. fold t in Et.
  assert (IT : is64 (times zv (times (two_to 1) d_tail)) t).
  { apply times_is; try assumption. fold T. apply big. apply Rle_trans with (1 := BT). unfold tail_share. lra. }
  pose proof (format_of _ _ IT) as Gt. pose proof (format_of _ _ Ir) as Gr. pose proof (format_of _ _ I1) as G1.
  pose proof (format_of _ _ I2) as G2.
  (* E: what v is at least. *)
  set (E := / 33554432 * Y + / 140737488355328 * Q).
  assert (HE : 0 < E) by (unfold E; lra).
  assert (Br : Rabs r <= 9001 / 1000 * unit53 * Q) by (apply Rle_trans with (1 := Rr); unfold unit53; lra).
  set (e := nearest64 (e1 + e2)). pose proof (sum_is_close e1 e2 G1 G2) as Ee. fold e in Ee.
  assert (Be0 : Rabs (e1 + e2) <= 18003 / 1000 * unit53 * Q) by (apply Rle_trans with (1 := Rabs_triang _ _); unfold unit53 in *; lra).
  assert (Be : Rabs e <= 18004 / 1000 * unit53 * Q) by (pose proof (Rabs_triang_inv e (e1 + e2)); unfold unit53 in *; lra).
  assert (Dt : Rabs (t - T) <= 13 / 100 * unit53 * (/ 33554432 * Y) + tiny) by (apply Rle_trans with (1 := Et);
    unfold tail_share, unit53 in *; lra).
  assert (Bt : Rabs t <= 127 / 1000 * (/ 33554432 * Y) + / 1000 * unit53 * Q).
  { pose proof (Rabs_triang_inv t T). unfold tail_share, unit53 in *. lra. }
  set (f := nearest64 (r - t)). pose proof (difference_is_close r t Gr Gt) as Ef. fold f in Ef.
  assert (Bf0 : Rabs (r - t) <= 127 / 1000 * (/ 33554432 * Y) + 9003 / 1000 * unit53 * Q).
  { unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. unfold unit53 in *. lra. }
  assert (Bf : Rabs f <= 1275 / 10000 * (/ 33554432 * Y) + 9004 / 1000 * unit53 * Q) by (pose proof (Rabs_triang_inv f (r - t));
    unfold unit53 in *; lra).
  assert (If : is64 (minus rest (times zv (times (two_to 1) d_tail))) f) by (apply minus_is; try assumption; apply big;
    unfold unit53 in *; lra).
  assert (Ie : is64 (plus (multiply_subtract is_fused xv xv (minus anchored (multiply_subtract is_fused xv xv anchored)))
       (multiply_subtract is_fused zv zv (minus (multiply_subtract is_fused xv xv anchored)
                       (multiply_subtract is_fused zv zv (multiply_subtract is_fused xv xv anchored))))) e)
    by (apply plus_is; try assumption; apply big; unfold unit53 in *; lra).
  set (low := nearest64 (e + f)). pose proof (sum_is_close e f (format_of _ _ Ie) (format_of _ _ If)) as El. fold low in El.
  assert (Bl0 : Rabs (e + f) <= 1275 / 10000 * (/ 33554432 * Y) + 27010 / 1000 * unit53 * Q).
  { apply Rle_trans with (1 := Rabs_triang _ _). unfold unit53 in *. lra. }
  assert (Bl0E : Rabs (e + f) <= 4222 / 10000 * E) by (unfold E, unit53 in *; lra).
  assert (BlE : Rabs low <= 4223 / 10000 * E) by (pose proof (Rabs_triang_inv low (e + f)); unfold unit53 in *; lra).
  assert (HEmax : E <= 1000) by (unfold E; lra).
  assert (Il : is64 (plus (plus (multiply_subtract is_fused xv xv (minus anchored (multiply_subtract is_fused xv xv anchored)))
       (multiply_subtract is_fused zv zv (minus (multiply_subtract is_fused xv xv anchored)
                       (multiply_subtract is_fused zv zv (multiply_subtract is_fused xv xv anchored)))))
       (minus rest (times zv (times (two_to 1) d_tail)))) low) by (apply plus_is; try assumption; apply big; lra).
  assert (Rp : Rabs p <= 1600000000) by (pose proof (Rabs_triang_inv p P); unfold unit53 in *; lra).
  set (y := nearest64 (p + low)). pose proof (sum_is_close p low (format_of _ _ Ip) (format_of _ _ Il)) as Ey. fold y in Ey.
  assert (Iv : is64 v y).
  { unfold v, cylinder_v. cbv zeta. apply plus_is; try assumption. apply big. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  (* The test of doubt. *)
  assert (Ileast : is64 least (nearest64 (Rabs Z * (bpow radix2 (-25) * dh) + bpow radix2 (-50) * (8 * Q)))).
  { change (bpow radix2 (-25)) with (/ 33554432) in *. unfold least.
    assert (Gq : in_binary64 (bpow radix2 (-50) * (8 * Q))).
    { replace (bpow radix2 (-50) * (8 * Q)) with (bpow radix2 (-47) * (Rad * Rad)) by (unfold Q; simpl; lra).
      pose proof (generic_format_B2R 24 128 R) as GR. apply product_scaled; [lia| |exact GR].
      apply generic_inclusion_mag with fexp32; [intros _; unfold FLT_exp; lia|exact GR]. }
    assert (I25 : is64 (times (two_to (-25)) d_head) (/ 33554432 * dh)).
    { change (/ 33554432) with (bpow radix2 (-25)). apply scaled_is; try assumption; try lia.
      - rewrite <- (Rmult_1_r dh). apply product_scaled; [lia|assumption|apply one_is_binary32].
      - apply big. change (bpow radix2 (-25)) with (/ 33554432). rewrite Rabs_pos_eq; lra. }
    assert (I50 : is64 (times (two_to (-50)) anchor) (bpow radix2 (-50) * (8 * Q))).
    { apply scaled_is; try assumption; try lia. apply big. simpl. rewrite Rabs_pos_eq; lra. }
    assert (Hprod : Rabs Z * (/ 33554432 * dh) = / 33554432 * Y) by (unfold Y; ring).
    apply multiply_add_is; try assumption.
    - now apply absolute_is.
    - replace (Rabs Z * (/ 33554432 * dh)) with (bpow radix2 (-25) * (dh * Rabs Z)) by (change (bpow radix2 (-25)) with (/ 33554432);
      ring).
      apply product_scaled; [lia|assumption|now apply generic_format_abs].
    - rewrite Hprod. apply big. rewrite Rabs_pos_eq; lra.
    - rewrite Hprod. apply big. simpl. rewrite Rabs_pos_eq; lra. }
  assert (Hleast : 999 / 1000 * E <= Rabs y).
  { rewrite (less_is _ _ _ _ (absolute_is _ _ Iv) Ileast) in Hclear. revert Hclear. case Rlt_bool_spec; [discriminate|]. intros Hge _.
    replace (Rabs Z * (bpow radix2 (-25) * dh) + bpow radix2 (-50) * (8 * Q)) with E in Hge by (unfold E, Y; simpl; lra).
    pose proof (product_is_close E) as T0. rewrite (Rabs_pos_eq E) in T0 by lra. apply Rabs_le_inv in T0.
    assert (tiny <= / 10000 * E) by (unfold E; lra). unfold unit53 in *. lra. }
  (* Together. *)
  set (B := Rabs (p + low)) in *. assert (HB : 0 <= B) by apply Rabs_pos.
  assert (HEB : E <= 1002 / 1000 * B) by (pose proof (Rabs_triang_inv y (p + low)) as T0; fold B in T0; unfold unit53 in *; lra).
  assert (BP : Rabs P <= 14235 / 10000 * B).
  { pose proof (Rabs_triang_inv P p) as T0. rewrite (Rabs_minus_sym P p) in T0.
    pose proof (Rabs_triang (p + low) (- low)) as T1. replace (p + low + - low) with p in T1 by ring. rewrite Rabs_Ropp in T1.
    fold B in T1.
    pose proof (Rabs_pos P). unfold unit53 in *. lra. }
  set (F := Z * (2 * (d - (dh + dt)))). assert (BF : Rabs F <= 2 * slope_share * Y).
  { unfold F, Y. rewrite !Rabs_mult, (Rabs_pos_eq 2) by lra. pose proof (Rabs_pos Z).
    replace (Rabs Z * (2 * Rabs (d - (dh + dt)))) with (2 * (Rabs Z * Rabs (d - (dh + dt)))) by ring.
    replace (2 * slope_share * (Rabs Z * dh)) with (2 * (Rabs Z * (slope_share * dh))) by ring.
    apply Rmult_le_compat_l; [lra|]. now apply Rmult_le_compat_l. }
  set (G := g - (b - 8 * Q)) in *.
  assert (HG : p + low - V = (p - P) + (low - (e + f)) + (e - (e1 + e2)) + (f - (r - t)) - (t - T) + F + G).
  { unfold V, F, T, P, G, e2, e1. fold XX. replace (L * L) with (ZZ + 2 * Z * d + d * d) by (unfold L, ZZ; ring). rewrite Hd2. lra. }
  assert (BG : Rabs (p + low - V) <= 2335 / 1000 * unit53 * B + Rabs G).
  { assert (B1 : Rabs (p - P) <= 14236 / 10000 * unit53 * B) by (apply Rle_trans with (1 := Ep); unfold unit53 in *; lra).
    assert (B2 : Rabs (low - (e + f)) + Rabs (e - (e1 + e2)) + Rabs (f - (r - t)) + Rabs (t - T) + Rabs F <= 86 / 100 * unit53 * E).
    { assert (tiny <= / 1000000 * unit53 * Q * unit53) by (unfold unit53; lra). unfold E, slope_share, unit53 in *. lra. }
    rewrite HG. apply Rle_trans with
      (Rabs (p - P) + (Rabs (low - (e + f)) + Rabs (e - (e1 + e2)) + Rabs (f - (r - t)) + Rabs (t - T) + Rabs F) + Rabs G).
    - clear. apply Rabs_le. split_Rabs; lra.
    - unfold unit53 in *. lra. }
  exists (p + low). fold B y. split; [exact Iv|]. split; [exact Ey|]. split; [unfold E in HEB; lra|]. split.
  - apply Rle_trans with (1 := BG). unfold E, unit53 in *. lra.
  - intro HV. apply Rle_trans with (1 := BG). unfold G. rewrite (Hg HV), Rminus_diag_eq, Rabs_R0 by reflexivity. lra.
Qed.

Lemma squares_inside : forall R w K X Z, parameters R w K -> let d := axis_depth (value32 R) (value32 w) in
  0 < value32 R * value32 R - (X * X + (Z + d) * (Z + d)) -> X * X + Z * Z <= 8 * (value32 R * value32 R).
Proof.
  intros R w K X Z (_ & HR & Hw & _) d HV. destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  fold d in Hd0, Hd2. pose proof (inside_is_near (value32 R) (value32 w / 2) d X Z ltac:(lra) Hd0 Hd2 HV ltac:(lra)). nra.
Qed.

(* v where the force acts, V > 0, and where the first stage does not doubt it. *)
Theorem cylinder_v_is_near : forall is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> coordinate xv X -> coordinate zv Z ->
  let L := Z + axis_depth (value32 R) (value32 w) in
  let V := value32 R * value32 R - (X * X + L * L) in
  let v := cylinder_v is_fused anchor anchored rest d_head d_tail xv zv in
  let least := multiply_add is_fused (absolute zv) (times (two_to (-25)) d_head) (times (two_to (-50)) anchor) in
  0 < V -> is_less (absolute v) least = false ->
  computes v (17 / 5) V (-60) 28 /\ bpow radix2 (-49) * (value32 R * value32 R) <= V.
Proof.
  intros is_fused R w K anchor anchored rest d_head d_tail axis xv X zv Z Hp Dp Hx Hz L V v least HV Hclear.
  destruct (cylinder_v_is_computed is_fused R w K _ _ _ _ _ _ xv X zv Z Hp Dp Hx Hz (squares_inside R w K X Z Hp HV) Hclear)
    as (s & Iv & Ey & HEB & _ & BG).
  specialize (BG HV). fold L V in BG. destruct Hp as (_ & HR & _).
  set (Q := value32 R * value32 R) in *. assert (HQ : / 100 <= Q <= 100000000) by (unfold Q; nra). set (B := Rabs s) in *.
  assert (HBV : B <= 1001 / 1000 * V).
  { pose proof (Rabs_triang_inv s V) as T0. fold B in T0. rewrite (Rabs_pos_eq V) in T0 by lra. unfold unit53 in *. lra. }
  split.
  - exists (nearest64 s). split; [exact Iv|]. split.
    + apply near_more with (one + 2335 / 1000 * (1001 / 1000) * unit53 * (1 + / 1000) / unit53); [|unfold one, unit53; lra].
      apply near_then with s; [now apply close_by_a_unit|]. apply close_is_near; [|unfold unit53; lra].
      rewrite (Rabs_pos_eq V) by lra. apply Rle_trans with (1 := BG). unfold unit53 in *. lra.
    + apply size_of; [|unfold V; simpl; assert (0 <= X * X + L * L) by nra; lra]. simpl. lra.
  - simpl. lra.
Qed.
