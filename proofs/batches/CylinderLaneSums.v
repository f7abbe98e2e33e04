(* SPDX-License-Identifier: BSD-3-Clause *)
(* The form of a batch of the cylinders: sums that are exact, and how far v = R^2 - rho^2 by fused operations may be off. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Mult_error Sterbenz BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Gap Polygons ErrorFree.
From Forceshade Require Import DoubleDouble Depth Split DoubleDoubleHolds CylinderForce CylinderFirst CylinderAnswers CylinderConstants.
From Forceshade Require Import SecondAlong.
From Forceshade Require Import Lanes RecordedForms LaneAnswers BumpLanes Batch PolygonLanes.
Import ListNotations.
Open Scope R_scope.

(* ---- w/2, and sums that are exact ---- *)

Lemma half_from_depth : forall R w K anchor anchored rest d_head d_tail axis, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis ->
  is64 (square_root (plus (minus anchored anchor) rest)) (value32 w / 2).
Proof.
  intros R w K anchor anchored rest d_head d_tail axis Hp D. destruct D as [(Fa & Fr & _) Ia Ea Rr _ _ _ _ _].
  destruct (half_is _ _ _ Hp) as [Gc _]. destruct Hp as (_ & HR & Hw & _). set (c := value32 w / 2) in *. set (A := value64 anchored) in *.
  set (r := value64 rest) in *. set (Q := value32 R * value32 R) in *.
  assert (HQ : / 100 <= Q <= 100000000) by (unfold Q; clear -HR; nra). assert (Hc : / 2000 <= c <= value32 R) by (unfold c; lra).
  assert (HcQ : c * c <= Q) by (unfold Q; apply Rmult_le_compat; lra). assert (Hc0 : 0 <= c * c) by (apply Rmult_le_pos; lra).
  assert (IA : is64 anchored A) by now split. assert (Ir : is64 rest r) by now split.
  apply Rabs_le_inv in Rr. pose proof unit_is_small as Hu.
  assert (big : forall a, 0 <= a <= 1000000000 -> Rabs a <= bpow radix2 1000).
  { intros a Ha. rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 40); [simpl; lra|apply bpow_le; lia]. }
  assert (BA : 8 * Q - / 1000 * Q <= A <= 9 * Q + / 1000 * Q) by (unfold unit53 in *; lra).
  assert (I1 : is64 (minus anchored anchor) (A - 8 * Q)).
  { apply minus_exact with A (8 * Q); try assumption; [reflexivity| |].
    - apply sterbenz; auto with typeclass_instances; [now apply format_of in IA|now apply format_of in Ia|lra].
    - apply Rle_trans with (bpow radix2 40); [apply Rabs_le; simpl; lra|apply bpow_le; lia]. }
  assert (I2 : is64 (plus (minus anchored anchor) rest) (c * c)).
  { apply plus_exact with (A - 8 * Q) r; try assumption; [lra|now apply product_is_binary64|apply big; lra]. }
  pose proof (square_root_is _ _ I2 Hc0) as I. rewrite sqrt_square in I by lra. rewrite round_generic in I by auto using binary32_in_64
    with typeclass_instances.
  exact I.
Qed.

Lemma sum_of_multiples : forall m n e, (-1074 <= e)%Z ->
  Rabs (IZR m * bpow radix2 e + IZR n * bpow radix2 e) < bpow radix2 (53 + e) -> in_binary64 (IZR m * bpow radix2 e + IZR n * bpow radix2
    e).
Proof.
  intros m n e He B. rewrite <- Rmult_plus_distr_r, <- plus_IZR in *. now apply multiple_is_binary64.
Qed.

(* Multiples of the last bit of a number that is in this format and not below 2^k. *)
Lemma multiple_in : forall prec k a, (0 < prec)%Z -> (-120 <= k)%Z -> (prec <= 29)%Z -> generic_format radix2 (FLT_exp (-149) prec) a ->
  a = 0 \/ bpow radix2 k <= Rabs a -> exists n, a = IZR n * bpow radix2 (k + 1 - prec).
Proof.
  intros prec k a Hp Hk H29 Ha [->|Hs]; [exists 0%Z; ring|].
  assert (Hmag : (k + 1 <= mag radix2 a)%Z) by (apply mag_ge_bpow; now replace (k + 1 - 1)%Z with k by ring).
  unfold generic_format, scaled_mantissa in Ha. set (m := Ztrunc _) in Ha. set (e := cexp radix2 (FLT_exp (-149) prec) a) in Ha.
  assert (He : (k + 1 - prec <= e)%Z) by (unfold e, cexp, FLT_exp; lia).
  exists (m * 2 ^ (e - (k + 1 - prec)))%Z. rewrite Ha at 1. unfold F2R. cbn [Fnum Fexp]. rewrite mult_IZR.
  change (2 ^ (e - (k + 1 - prec)))%Z with (Zpower radix2 (e - (k + 1 - prec))). rewrite IZR_Zpower by lia. rewrite Rmult_assoc, <-
    bpow_plus.
  do 2 f_equal. ring.
Qed.

(* a is of prec bits, b of 24. *)
Lemma exact_sum : forall prec k a b, (24 <= prec <= 29)%Z -> (-60 <= k <= 60)%Z -> generic_format radix2 (FLT_exp (-149) prec) a ->
  in_binary32 b ->
  a = 0 \/ bpow radix2 k <= Rabs a < bpow radix2 (k + 1) ->
  b = 0 \/ bpow radix2 (k - 28) <= Rabs b -> (a = 0 \/ Rabs b < bpow radix2 (k + 53 - prec)) -> in_binary64 (a + b).
Proof.
  intros prec k a b Hp Hk Ga Gb Ha Hb Hr. destruct Ha as [->|[La Ua]].
  { rewrite Rplus_0_l. now apply binary32_in_64. }
  assert (A0 : a <> 0) by (intro E; rewrite E, Rabs_R0 in La; pose proof (bpow_gt_0 radix2 k); lra).
  destruct Hr as [Hr|Hr]; [contradiction|].
  destruct Hb as [->|Lb].
  { rewrite Rplus_0_r. apply generic_inclusion_mag with (FLT_exp (-149) prec); [intros _; unfold FLT_exp; lia|exact Ga]. }
  destruct (Rle_or_lt (Rabs a) (Rabs b)) as [H|H].
  - (* the larger is b *)
    set (e := (k + 1 - prec)%Z). destruct (multiple_in prec k a ltac:(lia) ltac:(lia) ltac:(lia) Ga (or_intror La)) as [m ->].
    destruct (multiple_in 24 k b ltac:(lia) ltac:(lia) ltac:(lia) Gb ltac:(right; lra)) as [n Hn].
    assert (En : b = IZR (n * 2 ^ (prec - 24)) * bpow radix2 e).
    { rewrite Hn at 1. rewrite mult_IZR. change (2 ^ (prec - 24))%Z with (Zpower radix2 (prec - 24)). rewrite IZR_Zpower by lia.
      rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. unfold e. ring. }
    fold e in Ua, La, H, A0 |- *. rewrite En in H, Hr |- *. apply sum_of_multiples; [unfold e; lia|].
    apply Rle_lt_trans with (1 := Rabs_triang _ _). replace (53 + e)%Z with (k + 53 - prec + 1)%Z by (unfold e; ring). rewrite bpow_plus.
    change (bpow radix2 1) with 2. lra.
  - set (e := (k - 28 + 1 - 24)%Z). destruct (multiple_in 24 (k - 28) b ltac:(lia) ltac:(lia) ltac:(lia) Gb (or_intror Lb)) as [n Hn].
    destruct (multiple_in prec k a ltac:(lia) ltac:(lia) ltac:(lia) Ga (or_intror La)) as [m Hm].
    assert (Em : a = IZR (m * 2 ^ (k + 1 - prec - e)) * bpow radix2 e).
    { rewrite Hm at 1. rewrite mult_IZR. change (2 ^ (k + 1 - prec - e))%Z with (Zpower radix2 (k + 1 - prec - e)).
      rewrite IZR_Zpower by (unfold e; lia). rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. ring. }
    fold e in Hn. rewrite Em, Hn in *. apply sum_of_multiples; [unfold e; lia|].
    apply Rle_lt_trans with (1 := Rabs_triang _ _). replace (53 + e)%Z with (k + 1 + 1)%Z by (unfold e; ring). rewrite (bpow_plus radix2
      (k + 1) 1).
    change (bpow radix2 1) with 2. lra.
Qed.

(* ---- v ---- *)

Notation factor_form d_head z := (plus z (times (two_to 1) d_head)) (only parsing).
Notation v_form half d_head d_tail x z :=
  (minus (fused (minus half x) (plus half x) (opp (times z (factor_form d_head z))))
     (fused z (times (two_to 1) d_tail) (fused z (factor_form d_head z) (opp (times z (factor_form d_head z)))))) (only parsing).

Lemma v_form_is : forall half d_head d_tail xv X zv Z c dh dt d Q f S T, is64 (minus half xv) (c - X) -> is64 (plus half xv) (c + X) ->
  is64 d_head dh -> is64 d_tail dt -> is64 zv Z -> is64 (factor_form d_head zv) f -> is64 (times (two_to 1) d_tail) (2 * dt) ->
  d * d = Q - c * c -> let V := Q - (X * X + (Z + d) * (Z + d)) in
  Rabs ((c - X) * (c + X)) <= S -> Rabs (Z * f) <= S -> Rabs (Z * (2 * dt)) <= T -> T <= S -> / 1000000 <= S <= 100000000000 ->
  exists v, is64 (v_form half d_head d_tail xv zv) v /\ Rabs v <= 4 * S /\
    Rabs (v - V) <= unit53 * (1001 / 1000 * Rabs v + 1001 / 1000 * (Rabs v + 1001 / 1000 * T + 3 * unit53 * S) + 1001 / 1000 * T + 3 *
      unit53 * S)
      + Rabs (Z * (f - (Z + 2 * dh))) + Rabs (2 * Z * (d - (dh + dt))) + 10 * tiny.
Proof.
  intros half d_head d_tail xv X zv Z c dh dt d Q f S T Im Ip Ih It Iz If It2 Ed V BM BF BT TS HS. pose proof unit_is_small as Hu. pose
    proof tiny_is_tiny as Ht.
  assert (big : forall a, Rabs a <= 10 * S -> Rabs a <= bpow radix2 1000).
  { intros a Ha. apply Rle_trans with (bpow radix2 50); [simpl; lra|apply bpow_le; lia]. }
  assert (T0 : 0 <= T) by (apply Rle_trans with (2 := BT); apply Rabs_pos).
  set (P := Z * f) in *. set (p := nearest64 P). pose proof (product_is_close P) as Ep. fold p in Ep.
  assert (I1 : is64 (times zv (factor_form d_head zv)) p) by (apply times_is; try assumption; fold P; apply big; lra).
  set (e := P - p). assert (Be : Rabs e <= unit53 * S + tiny).
  { unfold e. rewrite Rabs_minus_sym. apply Rle_trans with (1 := Ep). apply Rplus_le_compat_r. apply Rmult_le_compat_l; lra. }
  set (g := nearest64 e). pose proof (product_is_close e) as Eg. fold g in Eg.
  assert (I2 : is64 (fused zv (factor_form d_head zv) (opp (times zv (factor_form d_head zv)))) g).
  { unfold g, e, P. replace (Z * f - p) with (Z * f + - p) by ring. apply fused_is; try assumption; [now apply opp_is|]. apply big.
    replace (Z * f + - p) with e by (unfold e, P; ring). unfold unit53 in *. lra. }
  assert (Bg : Rabs g <= 1001 / 1000 * unit53 * S + 3 * tiny).
  { pose proof (Rabs_triang_inv g e) as Q1. unfold unit53 in *. lra. }
  set (t := Z * (2 * dt)) in *. set (w := t + g). assert (Bw : Rabs w <= T + 1001 / 1000 * unit53 * S + 3 * tiny).
  { unfold w. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  set (s := nearest64 w). pose proof (product_is_close w) as Es. fold s in Es.
  assert (I3 : is64 (fused zv (times (two_to 1) d_tail) (fused zv (factor_form d_head zv) (opp (times zv (factor_form d_head zv))))) s).
  { apply fused_is; try assumption. apply big. fold t w. unfold unit53 in *. lra. }
  set (M := (c - X) * (c + X)) in *. set (A0 := M - p).
  assert (Bp : Rabs p <= 1001 / 1000 * S) by (pose proof (Rabs_triang_inv p P) as Q1; unfold unit53 in *; lra).
  assert (BA0 : Rabs A0 <= 2002 / 1000 * S).
  { unfold A0, Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra. }
  set (a := nearest64 A0). pose proof (product_is_close A0) as Ea. fold a in Ea.
  assert (I4 : is64 (fused (minus half xv) (plus half xv) (opp (times zv (factor_form d_head zv)))) a).
  { unfold a, A0, M. replace ((c - X) * (c + X) - p) with ((c - X) * (c + X) + - p) by ring. apply fused_is; try assumption; [now apply
    opp_is|].
    apply big. replace ((c - X) * (c + X) + - p) with A0 by (unfold A0, M; ring). lra. }
  assert (Ba : Rabs a <= 2003 / 1000 * S) by (pose proof (Rabs_triang_inv a A0) as Q1; unfold unit53 in *; lra).
  assert (Bs : Rabs s <= 1001 / 1000 * T + 1002 / 1000 * unit53 * S + 4 * tiny) by (pose proof (Rabs_triang_inv s w) as Q1; unfold unit53
    in *; lra).
  set (y := a - s). assert (By : Rabs y <= 3010 / 1000 * S).
  { unfold y, Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. unfold unit53 in *. lra. }
  set (v := nearest64 y). pose proof (product_is_close y) as Ev. fold v in Ev.
  assert (Bv : Rabs v <= 4 * S) by (pose proof (Rabs_triang_inv v y) as Q1; unfold unit53 in *; lra).
  exists v. split; [apply minus_is; try assumption; apply big; fold y; lra|]. split; [exact Bv|].
  assert (Yv : Rabs y <= 1001 / 1000 * Rabs v + 2 * tiny).
  { pose proof (Rabs_triang_inv y v) as Q1. rewrite (Rabs_minus_sym y v) in Q1. pose proof (Rabs_pos y). unfold unit53 in *. lra. }
  assert (AV : Rabs A0 <= 1001 / 1000 * (Rabs v + 1001 / 1000 * T + 2 * unit53 * S) + 10 * tiny).
  { pose proof (Rabs_triang y s) as Q1. replace (y + s) with a in Q1 by (unfold y; ring).
    pose proof (Rabs_triang_inv A0 a) as Q2. rewrite (Rabs_minus_sym A0 a) in Q2. pose proof (Rabs_pos A0).
    assert (Ey : Rabs y <= Rabs v + (unit53 * Rabs y + tiny)).
    { pose proof (Rabs_triang_inv y v) as Q3. rewrite (Rabs_minus_sym y v) in Q3. lra. }
    pose proof (Rabs_pos v). unfold unit53 in *. lra. }
  assert (E : v - V = (v - y) + (a - A0) - (s - w) - (g - e) - Z * (f - (Z + 2 * dh)) + 2 * Z * (d - (dh + dt))).
  { unfold y, A0, w, e, V, M, P, t.
    replace (Q - (X * X + (Z + d) * (Z + d))) with (c * c + d * d - (X * X + (Z + d) * (Z + d))) by (rewrite Ed; ring). ring. }
  rewrite E. set (h1 := Z * (f - (Z + 2 * dh))). set (h2 := 2 * Z * (d - (dh + dt))).
  assert (Bt : Rabs ((v - y) + (a - A0) - (s - w) - (g - e) - h1 + h2) <=
    Rabs (v - y) + Rabs (a - A0) + Rabs (s - w) + Rabs (g - e) + Rabs h1 + Rabs h2).
  { unfold Rminus. repeat (eapply Rle_trans; [apply Rabs_triang|]; apply Rplus_le_compat; [|try rewrite Rabs_Ropp; apply Rle_refl]).
    apply Rle_refl. }
  apply Rle_trans with (1 := Bt).
  assert (U1 : unit53 * Rabs y <= unit53 * (1001 / 1000 * Rabs v) + tiny).
  { apply Rle_trans with (unit53 * (1001 / 1000 * Rabs v + 2 * tiny)); [apply Rmult_le_compat_l; lra|].
    rewrite Rmult_plus_distr_l. unfold unit53. lra. }
  assert (U2 : unit53 * Rabs A0 <= unit53 * (1001 / 1000 * (Rabs v + 1001 / 1000 * T + 2 * unit53 * S)) + tiny).
  { apply Rle_trans with (unit53 * (1001 / 1000 * (Rabs v + 1001 / 1000 * T + 2 * unit53 * S) + 10 * tiny)); [apply Rmult_le_compat_l;
    lra|].
    rewrite Rmult_plus_distr_l. unfold unit53. lra. }
  assert (U3 : unit53 * Rabs w <= unit53 * (T + 1001 / 1000 * unit53 * S) + tiny).
  { apply Rle_trans with (unit53 * (T + 1001 / 1000 * unit53 * S + 3 * tiny)); [apply Rmult_le_compat_l; lra|].
    rewrite Rmult_plus_distr_l. unfold unit53. lra. }
  assert (U4 : unit53 * Rabs e <= unit53 * (unit53 * S) + tiny).
  { apply Rle_trans with (unit53 * (unit53 * S + tiny)); [apply Rmult_le_compat_l; lra|]. rewrite Rmult_plus_distr_l. unfold unit53. lra. }
  pose proof (Rabs_pos v). unfold unit53 in *. lra.
Qed.
