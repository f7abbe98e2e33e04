(* SPDX-License-Identifier: BSD-3-Clause *)
(* The depth below a polygon, height - slope |x| - z, in binary64: LinearGap of fast/laws/polygon_gap.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Relative Sterbenz.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs ErrorFree.
Open Scope R_scope.

(* LinearGap::gap, as it stands in each recorded first stage. *)
Definition gap_value (is_fused : bool) (height height_tail slope slope_tail ax z : binary64) : binary64 :=
  let surface := multiply_subtract is_fused slope ax height in
  let error := multiply_subtract is_fused slope ax (minus height surface) in
  plus (minus surface z) (plus error (minus height_tail (times slope_tail ax))).

Definition tail_share : R := 129 / 128 / 536870912.                       (* a little above 2^-29 *)
Definition slope_share : R := 129 / 128 / 4835703278458516698824704.       (* a little above 2^-82 *)
Definition height_share : R := / 19807040628566084398385987584.            (* 2^-94 *)

(* The two terms of the height h' and of the slope of a polygon, H and S exactly, as the geometry in double-double gives them. *)
Record linear (height height_tail slope slope_tail : binary64) (H S : R) : Prop := {
  linear_finite : is_finite 53 1024 height = true /\ is_finite 53 1024 height_tail = true /\ is_finite 53 1024 slope = true /\
    is_finite 53 1024 slope_tail = true;
  linear_slope_bits : generic_format radix2 (FLT_exp (-149) 29) (value64 slope);
  linear_height : / 137438953472 <= value64 height <= 18000;  (* 2^-37 *)
  linear_height_tail : Rabs (value64 height_tail) <= unit53 * value64 height;
  linear_height_error : Rabs (H - (value64 height + value64 height_tail)) <= height_share * value64 height;
  linear_slope : 0 <= value64 slope <= 10001;
  linear_slope_tail : Rabs (value64 slope_tail) <= tail_share * value64 slope;
  linear_slope_error : Rabs (S - (value64 slope + value64 slope_tail)) <= slope_share * value64 slope
}.

Lemma product_of_29_bits : forall a b, generic_format radix2 (FLT_exp (-149) 29) a -> in_binary32 b -> in_binary64 (a * b).
Proof.
  intros a b Ha Hb. apply FLT_format_generic in Ha; [|reflexivity]. apply FLT_format_generic in Hb; [|reflexivity].
  destruct Ha as [[m e] H1 H2 H3], Hb as [[n g] G1 G2 G3]. rewrite H1, G1, <- Operations.F2R_mult.
  cbn [Fnum Fexp] in *. apply generic_format_FLT. exists (Float radix2 (m * n) (e + g)); [reflexivity| |].
  - cbn [Fnum]. rewrite Z.abs_mul. change (Zpower radix2 29) with 536870912%Z in *. change (Zpower radix2 24) with 16777216%Z in *.
    change (Zpower radix2 53) with 9007199254740992%Z. nia.
  - cbn [Fexp]. lia.
Qed.

(* What the code finds of the rounding error of h - p is all of it. *)
Lemma error_of_difference : forall h p, in_binary64 h -> in_binary64 p -> 0 <= p <= 2 * h ->
  nearest64 (nearest64 (h - nearest64 (h - p)) - p) = h - p - nearest64 (h - p).
Proof.
  intros h p Fh Fp Hp. destruct (Rle_or_lt p h) as [Hle|Hlt].
  - pose proof (fast_two_sum_is_exact h (- p) Fh (generic_format_opp _ _ _ Fp)) as D. cbv zeta in D.
    replace (h + - p) with (h - p) in D by ring.
    replace (nearest64 (h - nearest64 (h - p)) - p) with (- p - nearest64 (nearest64 (h - p) - h)).
    + assert (Hsize : Rabs (- p) <= Rabs h \/ h = 0) by (left; rewrite Rabs_Ropp, !Rabs_pos_eq by lra; lra). specialize (D Hsize). lra.
    + replace (nearest64 (h - p) - h) with (- (h - nearest64 (h - p))) by ring. rewrite round_NE_opp. ring.
  - assert (E : nearest64 (h - p) = h - p).
    { apply round_generic; auto with typeclass_instances. apply sterbenz; auto with typeclass_instances. lra. }
    rewrite E. replace (h - (h - p)) with p by ring. rewrite (round_generic radix2 fexp64 ZnearestE p) by assumption.
    rewrite !Rminus_diag_eq by reflexivity. apply round_0. auto with typeclass_instances.
Qed.

Lemma difference_is_close : forall a b, in_binary64 a -> in_binary64 b -> Rabs (nearest64 (a - b) - (a - b)) <= unit53 * Rabs (a - b).
Proof. intros a b Ha Hb. exact (sum_is_close a (- b) Ha (generic_format_opp radix2 fexp64 b Hb)). Qed.

Definition tiny : R := bpow radix2 (-1000).
Lemma product_is_close : forall a, Rabs (nearest64 a - a) <= unit53 * Rabs a + tiny.
Proof.
  intro a. destruct (error_N_FLT radix2 (-1074) 53 (eq_refl _) (fun n => negb (Z.even n)) a) as (e & f & He & Hf & _ & E). rewrite E.
  replace (a * (1 + e) + f - a) with (a * e + f) by ring. apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat.
  - rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos|]. apply Rle_trans with (1 := He). unfold unit53. simpl. lra.
  - apply Rle_trans with (1 := Hf). unfold tiny. apply Rle_trans with (1 * bpow radix2 (-1074)).
    + apply Rmult_le_compat_r; [apply bpow_ge_0|lra].
    + rewrite Rmult_1_l. apply bpow_le. lia.
Qed.
Lemma tiny_is_tiny : 0 <= tiny <= / 1000000000000000000000000000000000000000000000000000000000000.
Proof.
  unfold tiny. split; [apply bpow_ge_0|]. apply Rle_trans with (bpow radix2 (-200)); [apply bpow_le; lia|]. simpl. lra.
Qed.

Lemma tiny_is_tinier : 0 <= tiny <=
  / 100000000000000000000000000000000000000000000000000000000000000000000000000000000 *
  / 100000000000000000000000000000000000000000000000000000000000000000000000000000000.
Proof.
  unfold tiny. split; [apply bpow_ge_0|]. apply Rle_trans with (bpow radix2 (-600)); [apply bpow_le; lia|]. simpl. lra.
Qed.

(* |a - b| in terms of the two, for linear arithmetic. *)
Ltac absolute_values := repeat match goal with
  | H : Rabs _ <= _ |- _ => apply Rabs_le_inv in H
  end.

Theorem gap_is_near : forall is_fused height height_tail slope slope_tail axv AX zv Z H S,
  linear height height_tail slope slope_tail H S -> is64 axv AX -> in_binary32 AX -> 0 <= AX <= 10000 -> S * AX <= H -> coordinate zv Z ->
  let value := gap_value is_fused height height_tail slope slope_tail axv zv in
  exists v, is64 value v /\
    (/ 134217729 * value64 height <= Rabs v -> near (7 / 2) v (H - S * AX - Z) /\ Rabs v / 2 <= Rabs (H - S * AX - Z)).
Proof.
  intros is_fused height height_tail slope slope_tail axv AX zv Z H S L Hax Fax RAX HS Hz value.
  destruct L as [(Fh & Fht & Fs & Fst) Bits Rh Rht Rhe Rs Rst Rse]. destruct Hz as [Hz _ Rz _].
  set (h := value64 height) in *. set (ht := value64 height_tail) in *. set (s := value64 slope) in *. set (st := value64 slope_tail) in *.
  assert (Ih : is64 height h) by now split. assert (Iht : is64 height_tail ht) by now split.
  assert (Is : is64 slope s) by now split. assert (Ist : is64 slope_tail st) by now split.
  set (p := s * AX). set (tx := st * AX).
  assert (Hp0 : 0 <= p) by (apply Rmult_le_pos; lra).
  assert (Htx : Rabs tx <= tail_share * p).
  { unfold tx, p. rewrite Rabs_mult, (Rabs_pos_eq AX) by lra. rewrite <- Rmult_assoc. apply Rmult_le_compat_r; lra. }
  set (D := (S - (s + st)) * AX).
  assert (HD : Rabs D <= slope_share * p).
  { unfold D, p. rewrite Rabs_mult, (Rabs_pos_eq AX) by lra. rewrite <- Rmult_assoc. apply Rmult_le_compat_r; lra. }
  assert (HSp : S * AX = p + tx + D) by (unfold p, tx, D; ring).
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  assert (Hp : p <= 1000001 / 1000000 * h).
  { pose proof Rht as A1. pose proof Rhe as A2. absolute_values. unfold tail_share, slope_share, height_share, unit53 in *. lra. }
  assert (Gp : in_binary64 p) by now apply product_of_29_bits.
  pose proof (format_of _ _ Ih) as Gh. pose proof (format_of _ _ Iht) as Ght. pose proof (format_of _ _ Hz) as Gz.
  assert (big : forall a, Rabs a <= 1000000 -> Rabs a <= bpow radix2 1000).
  { intros a Ha. apply Rle_trans with (bpow radix2 20); [simpl; lra|apply bpow_le; lia]. }
  (* surface and its error *)
  set (a := nearest64 (h - p)).
  pose proof (difference_is_close h p Gh Gp) as Ea. fold a in Ea. rewrite (Rabs_minus_sym a) in Ea.
  set (e := h - p - a) in *.
  assert (Ie : nearest64 (nearest64 (h - a) - p) = e) by (apply error_of_difference; try assumption; lra).
  assert (Hhp : Rabs (h - p) <= h) by (apply Rabs_le; lra).
  assert (He : Rabs e <= unit53 * h) by (apply Rle_trans with (1 := Ea); apply Rmult_le_compat_l; lra).
  assert (Ra : Rabs a <= 18002).
  { replace a with (h - p - e) by (unfold e; ring). apply Rabs_le. pose proof He as A. absolute_values. unfold unit53 in *. lra. }
  assert (Ia : is64 (multiply_subtract is_fused slope axv height) a).
  { apply multiply_subtract_is; try assumption; apply big; [fold p; rewrite Rabs_pos_eq by assumption; lra|fold p; lra]. }
  assert (Ga : in_binary64 a) by now apply format_of in Ia.
  assert (Hha : Rabs (h - a) <= 36003) by (apply Rabs_le; pose proof Ra as A; absolute_values; lra).
  assert (Ib : is64 (minus height (multiply_subtract is_fused slope axv height)) (nearest64 (h - a))) by (apply minus_is; try assumption;
    apply big; lra).
  assert (Rb : Rabs (nearest64 (h - a)) <= 36004).
  { pose proof (difference_is_close h a Gh Ga) as A. pose proof (Rabs_triang_inv (nearest64 (h - a)) (h - a)) as T.
    unfold unit53 in *. lra. }
  assert (Ierr : is64 (multiply_subtract is_fused slope axv (minus height (multiply_subtract is_fused slope axv height))) e).
  { rewrite <- Ie. apply multiply_subtract_is; try assumption; apply big; fold p; [rewrite Rabs_pos_eq by assumption; lra|].
    apply Rabs_le. absolute_values. lra. }
  (* the tails *)
  set (m := nearest64 tx). pose proof (product_is_close tx) as Em. fold m in Em.
  assert (Rtx : Rabs tx <= 1) by (apply Rle_trans with (1 := Htx); unfold tail_share; lra).
  assert (Im : is64 (times slope_tail axv) m) by (apply times_is; try assumption; fold tx; apply big; lra).
  assert (Btx : Rabs tx <= 1009 / 1000 / 536870912 * h) by (apply Rle_trans with (1 := Htx); unfold tail_share; lra).
  assert (Bdm : Rabs (m - tx) <= 101 / 100 * unit53 / 536870912 * h) by (apply Rle_trans with (1 := Em); unfold unit53 in *; lra).
  assert (Bm : Rabs m <= 101 / 100 / 536870912 * h).
  { replace m with (m - tx + tx) by ring. apply Rle_trans with (1 := Rabs_triang _ _). unfold unit53 in *. lra. }
  set (n := nearest64 (ht - m)). pose proof (difference_is_close ht m Ght (format_of _ _ Im)) as En. fold n in En.
  assert (Bhtm : Rabs (ht - m) <= 102 / 100 / 536870912 * h).
  { unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. unfold unit53 in *. lra. }
  assert (In : is64 (minus height_tail (times slope_tail axv)) n) by (apply minus_is; try assumption; apply big; lra).
  assert (Bdn : Rabs (n - (ht - m)) <= 102 / 100 * unit53 / 536870912 * h) by (apply Rle_trans with (1 := En); unfold unit53 in *; lra).
  assert (Bn : Rabs n <= 103 / 100 / 536870912 * h).
  { replace n with (n - (ht - m) + (ht - m)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). unfold unit53 in *. lra. }
  set (t := nearest64 (e + n)). pose proof (sum_is_close e n (format_of _ _ Ierr) (format_of _ _ In)) as Et. fold t in Et.
  assert (Ben : Rabs (e + n) <= 104 / 100 / 536870912 * h) by (apply Rle_trans with (1 := Rabs_triang _ _); unfold unit53 in *; lra).
  assert (It : is64 (plus (multiply_subtract is_fused slope axv (minus height (multiply_subtract is_fused slope axv height)))
                       (minus height_tail (times slope_tail axv))) t) by (apply plus_is; try assumption; apply big; lra).
  assert (Bdt : Rabs (t - (e + n)) <= 104 / 100 * unit53 / 536870912 * h) by (apply Rle_trans with (1 := Et); unfold unit53 in *; lra).
  assert (Bt : Rabs t <= 105 / 100 / 536870912 * h).
  { replace t with (t - (e + n) + (e + n)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). unfold unit53 in *. lra. }
  (* the sum *)
  assert (Raz : Rabs (a - Z) <= 36003) by (apply Rabs_le; pose proof Ra as A; absolute_values; lra).
  set (q := nearest64 (a - Z)). pose proof (difference_is_close a Z Ga Gz) as Eq. fold q in Eq.
  assert (Iq : is64 (minus (multiply_subtract is_fused slope axv height) zv) q) by (apply minus_is; try assumption; apply big; lra).
  assert (Baz : Rabs (a - Z) <= 1001 / 1000 * Rabs q).
  { pose proof (Rabs_pos q). pose proof (Rabs_triang_inv (a - Z) q) as T. rewrite (Rabs_minus_sym _ q) in T. unfold unit53 in *. lra. }
  assert (Rq : Rabs q <= 36004).
  { pose proof (Rabs_triang_inv q (a - Z)) as T. unfold unit53 in *. lra. }
  set (v := nearest64 (q + t)). pose proof (sum_is_close q t (format_of _ _ Iq) (format_of _ _ It)) as Ev. fold v in Ev.
  assert (Rqt : Rabs (q + t) <= 36010) by (apply Rle_trans with (1 := Rabs_triang _ _); lra).
  exists v. split; [apply plus_is; try assumption; apply big; lra|]. intro Hlarge.
  set (B := Rabs (q + t)) in *.
  assert (HB0 : 0 <= B) by apply Rabs_pos.
  assert (HhB : h <= 134217728 * (1001 / 1000) * B).
  { pose proof (Rabs_triang_inv v (q + t)) as T. fold B in T. unfold unit53 in *. lra. }
  assert (Bq : Rabs q <= 128 / 100 * B).
  { pose proof (Rabs_triang (q + t) (- t)) as T. replace (q + t + - t) with q in T by ring. rewrite Rabs_Ropp in T. fold B in T. lra. }
  assert (Bdq : Rabs (q - (a - Z)) <= 129 / 100 * unit53 * B) by (apply Rle_trans with (1 := Eq); unfold unit53 in *; lra).
  set (G := H - S * AX - Z).
  assert (HG : q + t - G = (q - (a - Z)) + (t - (e + n)) + (n - (ht - m)) - (m - tx) + (h + ht - H) + D).
  { unfold G. rewrite HSp. unfold e. ring. }
  assert (BG : Rabs (q + t - G) <= 12 / 5 * unit53 * B).
  { assert (B1 : Rabs (h + ht - H) <= / 1000 * unit53 * B) by (rewrite Rabs_minus_sym; unfold height_share, unit53 in *; lra).
    assert (B2 : Rabs D <= 26 / 100 * unit53 * B) by (unfold slope_share, unit53 in *; lra).
    assert (B3 : Rabs (t - (e + n)) <= 27 / 100 * unit53 * B) by (unfold unit53 in *; lra).
    assert (B4 : Rabs (n - (ht - m)) <= 27 / 100 * unit53 * B) by (unfold unit53 in *; lra).
    assert (B5 : Rabs (m - tx) <= 27 / 100 * unit53 * B) by (unfold unit53 in *; lra).
    rewrite HG. clear - Bdq B1 B2 B3 B4 B5 HB0 Hu. apply Rabs_le. absolute_values. nra. }
  assert (GB : B <= 1001 / 1000 * Rabs G).
  { pose proof (Rabs_triang_inv (q + t) G) as T. fold B in T. unfold unit53 in *. lra. }
  split.
  - apply near_more with (one + 12 / 5 * (1001 / 1000) * unit53 * (1 + / 1000) / unit53); [|unfold one; unfold unit53; lra].
    apply near_then with (q + t); [now apply close_by_a_unit|]. apply close_is_near; [|unfold unit53; lra].
    apply Rle_trans with (1 := BG). unfold unit53 in *. lra.
  - pose proof (Rabs_triang_inv v (q + t)) as T. fold B in T. unfold unit53 in *. lra.
Qed.
