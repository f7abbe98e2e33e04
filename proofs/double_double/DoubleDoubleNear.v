(* SPDX-License-Identifier: BSD-3-Clause *)
(* How far double-double's products and quotients of positive numbers are off, and sums x + (h + l) with -h at most half of x. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Relative Sterbenz.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap DoubleDouble.
Open Scope R_scope.

Lemma big_enough : forall b, Rabs b <= 100000000000000000000000000000000000000000000000000000000000000000000000000000000 -> not_too_large b.
Proof. intros b Hb. apply Rle_trans with (bpow radix2 300); [simpl; lra|apply bpow_le; lia]. Qed.
Lemma big_enough_900 : forall b, Rabs b <= 100000000000000000000000000000000000000000000000000000000000000000000000000000000 ->
  Rabs b <= bpow radix2 900.
Proof. intros b Hb. apply Rle_trans with (bpow radix2 300); [simpl; lra|apply bpow_le; lia]. Qed.

(* What two terms hold: y + z is near the exact value, and z is what y lacks. *)
Definition two_near (t : binary64 * binary64) (exact error : R) : Prop :=
  exists y z, is64 (fst t) y /\ is64 (snd t) z /\ Rabs z <= unit53 * y /\ Rabs (y + z - exact) <= error.

Lemma two_terms_near : forall r q x y exact error, is64 r x -> is64 q y -> / 100000000000000000000 <= x <= 100000000000000000000 ->
  Rabs y <= / 1000000 * x -> Rabs (x + y - exact) <= error -> two_near (plus r q, minus q (minus (plus r q) r)) exact error.
Proof.
  intros r q x y exact error Hr Hq Hx Hy He. pose proof unit_is_small as Hu.
  destruct (two_terms r q x y Hr Hq) as [T1 T2].
  { rewrite (Rabs_pos_eq x) by lra. lra. } { apply big_enough_900. rewrite Rabs_pos_eq; lra. }
  exists (nearest64 (x + y)), (x + y - nearest64 (x + y)). split; [exact T1|]. split; [exact T2|]. split.
  - apply rounding_tail. pose proof (sum_is_close x y (format_of _ _ Hr) (format_of _ _ Hq)) as C.
    apply Rabs_le_inv in Hy. rewrite (Rabs_pos_eq (x + y)) in C by lra. apply Rabs_le_inv in C.
    assert (unit53 * (x + y) <= / 1000 * (x + y)) by (apply Rmult_le_compat_r; lra). lra.
  - replace (nearest64 (x + y) + (x + y - nearest64 (x + y))) with (x + y) by ring. exact He.
Qed.

(* x + (h + l) *)
Lemma sum_of_is_near : forall a a_lo b b_lo x h l, is64 a x -> is64 a_lo 0 -> is64 b h -> is64 b_lo l ->
  / 1000000 <= x <= 1000000 -> - (51 / 100) * x <= h <= 1000000 -> Rabs l <= 101 / 100 * unit53 * Rabs h ->
  two_near (sum_of a a_lo b b_lo) (x + (h + l)) (3 * (unit53 * unit53) * (x + h)).
Proof.
  intros a a_lo b b_lo x h l Ha Hal Hb Hl Hx Hh Bl. pose proof unit_is_small as Hu.
  pose proof (format_of _ _ Ha) as Gx. pose proof (format_of _ _ Hb) as Gh. pose proof (format_of _ _ Hl) as Gl.
  set (s := x + h). set (us := unit53 * s). assert (Hs : / 3000000 <= s <= 2000000) by (unfold s; lra).
  assert (Hhs : Rabs h <= 105 / 100 * s) by (apply Rabs_le; unfold s; lra). pose proof (Rabs_le_inv _ _ Hhs) as Hhs2.
  assert (Hus : 0 <= us <= / 1000000000000 * s) by (unfold us; split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Bl' : Rabs l <= 107 / 100 * us).
  { apply Rle_trans with (1 := Bl). apply Rle_trans with (101 / 100 * unit53 * (105 / 100 * s)); [|unfold us in *; lra].
    apply Rmult_le_compat_l; lra. }
  pose proof (Rabs_le_inv _ _ Bl') as Bl2.
  pose proof (two_sum_is_exact x h Gx Gh) as T. cbv zeta in T. fold s in T.
  set (y1 := nearest64 s) in *. pose proof (sum_is_close x h Gx Gh) as C1. fold s y1 in C1. rewrite (Rabs_pos_eq s) in C1 by lra.
  fold us in C1.
  apply Rabs_le_inv in C1.
  unfold sum_of. cbv zeta.
  assert (close : forall u, Rabs u <= 10000000 -> not_too_large u /\ Rabs (nearest64 u) <= 10000001
    /\ Rabs (nearest64 u - u) <= / 10000).
  { intros u Bu. split; [apply big_enough; lra|]. pose proof (product_is_close u) as C. pose proof tiny_is_tiny as Ht.
    pose proof (Rabs_pos u).
    pose proof (Rabs_triang_inv (nearest64 u) u).
    assert (unit53 * Rabs u <= / 1000000000000 * Rabs u) by (apply Rmult_le_compat_r; lra). lra. }
  assert (I1 : is64 (plus a b) y1) by (apply plus_is; try assumption; apply close, Rabs_le; fold s; lra). set (t1 := plus a b) in *.
  destruct (close (y1 - x)) as (M2 & N2 & D2); [apply Rabs_le; lra|]. pose proof (minus_is _ _ _ _ I1 Ha M2) as I2.
  set (t2 := minus t1 a) in *.
  set (y2 := nearest64 (y1 - x)) in *. apply Rabs_le_inv in D2.
  destruct (close (y1 - y2)) as (M3 & N3 & D3); [apply Rabs_le; unfold s in *; lra|]. pose proof (minus_is _ _ _ _ I1 I2 M3) as I3.
  set (t3 := minus t1 t2) in *.
  set (y3 := nearest64 (y1 - y2)) in *. apply Rabs_le_inv in D3.
  destruct (close (x - y3)) as (M4 & N4 & D4); [apply Rabs_le; unfold s in *; lra|]. pose proof (minus_is _ _ _ _ Ha I3 M4) as I4.
  set (t4 := minus a t3) in *.
  set (y4 := nearest64 (x - y3)) in *. apply Rabs_le_inv in D4.
  destruct (close (h - y2)) as (M5 & N5 & D5); [apply Rabs_le; unfold s in *; lra|]. pose proof (minus_is _ _ _ _ Hb I2 M5) as I5.
  set (t5 := minus b t2) in *.
  set (y5 := nearest64 (h - y2)) in *. apply Rabs_le_inv in D5.
  destruct (close (y4 + y5)) as (M6 & N6 & D6); [apply Rabs_le; unfold s in *; lra|]. pose proof (plus_is _ _ _ _ I4 I5 M6) as I6.
  set (t6 := plus t4 t5) in *.
  set (y6 := nearest64 (y4 + y5)) in *.
  assert (T6 : y6 = s - y1) by lra.
  assert (I7 : is64 (plus a_lo b_lo) l) by (apply plus_exact with 0 l; try assumption; [ring|apply big_enough; lra]).
  set (t7 := plus a_lo b_lo) in *.
  assert (B8 : Rabs (y6 + l) <= 208 / 100 * us) by (rewrite T6; apply Rabs_le; lra).
  pose proof (plus_is _ _ _ _ I6 I7 ltac:(apply big_enough; lra)) as I8. set (t8 := plus t6 t7) in *.
  pose proof (sum_is_close y6 l (format_of _ _ I6) Gl) as C8. set (y8 := nearest64 (y6 + l)) in *.
  assert (C8' : Rabs (y8 - (y6 + l)) <= unit53 * (208 / 100 * us)) by (apply Rle_trans with (1 := C8); apply Rmult_le_compat_l; lra).
  assert (Uus : 0 <= unit53 * us <= / 1000000000000 * us) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  apply Rabs_le_inv in C8'. apply Rabs_le_inv in B8.
  destruct (two_terms t1 t8 y1 y8 I1 I8) as [V1 V2].
  { rewrite (Rabs_pos_eq y1) by lra. apply Rabs_le. lra. } { apply big_enough_900. rewrite Rabs_pos_eq; lra. }
  set (t9 := plus t1 t8) in *. set (y9 := nearest64 (y1 + y8)) in *.
  assert (I10 : is64 (minus t7 a_lo) l) by (apply minus_exact with l 0; try assumption; [ring|apply big_enough; lra]).
  set (t10 := minus t7 a_lo) in *.
  assert (I11 : is64 (minus t7 t10) 0) by exact_step minus_exact. set (t11 := minus t7 t10) in *.
  assert (I12 : is64 (minus a_lo t11) 0) by exact_step minus_exact. set (t12 := minus a_lo t11) in *.
  assert (I13 : is64 (minus b_lo t10) 0) by exact_step minus_exact. set (t13 := minus b_lo t10) in *.
  assert (I14 : is64 (plus t12 t13) 0) by exact_step plus_exact. set (t14 := plus t12 t13) in *.
  set (t16 := minus t8 (minus t9 t1)) in *.
  assert (C9 : Rabs (y9 - (y1 + y8)) <= unit53 * (2 * s)).
  { pose proof (sum_is_close y1 y8 (format_of _ _ I1) (format_of _ _ I8)) as C. fold y9 in C. apply Rle_trans with (1 := C).
    apply Rmult_le_compat_l; [lra|apply Rabs_le; lra]. }
  apply Rabs_le_inv in C9. fold us in C9. assert (C9' : - (2 * us) <= y9 - (y1 + y8) <= 2 * us) by (unfold us; lra).
  assert (I17 : is64 (plus t14 t16) (y1 + y8 - y9)).
  { apply plus_exact with 0 (y1 + y8 - y9); try assumption; [ring|now apply format_of in V2|apply big_enough, Rabs_le; lra]. }
  set (t17 := plus t14 t16) in *.
  apply (two_terms_near t9 t17 y9 (y1 + y8 - y9)); try assumption; [lra|apply Rabs_le; lra|].
  replace (y9 + (y1 + y8 - y9) - (x + (h + l))) with (y8 - (y6 + l)) by (rewrite T6; unfold s; ring).
  replace (3 * (unit53 * unit53) * s) with (3 * (unit53 * us)) by (unfold us; ring). apply Rabs_le. lra.
Qed.

(* (h + l) (c + k) *)
Lemma product_of_is_near : forall a a_lo b b_lo h l c k, is64 a h -> is64 a_lo l -> is64 b c -> is64 b_lo k ->
  / 1000000000 <= h <= 1000000 -> / 1000000000 <= c <= 1000000 ->
  Rabs l <= 101 / 100 * unit53 * h -> Rabs k <= 101 / 100 * unit53 * c ->
  two_near (product_of a a_lo b b_lo) ((h + l) * (c + k)) (7 * (unit53 * unit53) * (h * c)).
Proof.
  intros a a_lo b b_lo h l c k Ha Hl Hb Hk Hh Hc Bl Bk. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  pose proof (format_of _ _ Ha) as Gh. pose proof (format_of _ _ Hb) as Gc.
  assert (Hlow : / 1000000000000000000 <= h * c).
  { replace (/ 1000000000000000000) with (/ 1000000000 * / 1000000000) by field. apply Rmult_le_compat; lra. }
  assert (Hhigh : h * c <= 1000000000000) by (replace 1000000000000 with (1000000 * 1000000) by ring; apply Rmult_le_compat; lra).
  set (m := h * c) in *. set (um := unit53 * m).
  assert (Hum : 0 <= um <= / 1000000000000 * m) by (unfold um; split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Uum : 0 <= unit53 * um <= / 1000000000000 * um) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Htum : tiny <= / 1000 * (unit53 * um)) by (unfold um, unit53; lra).
  pose proof (product_is_close m) as C1. rewrite (Rabs_pos_eq m) in C1 by lra. fold um in C1.
  set (p := nearest64 m) in *.
  assert (Ge : in_binary64 (m - p)).
  { pose proof (two_product_is_exact h c Gh Gc) as E. cbv zeta in E. fold m p in E.
    assert (Hs : m = 0 \/ bpow radix2 (-1074 + 2 * 53 - 1) <= Rabs m).
    { right. rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 (-60)); [apply bpow_le; lia|simpl; lra]. }
    replace (m - p) with (nearest64 (m - p)) by (specialize (E Hs); lra). apply generic_format_round; auto with typeclass_instances. }
  assert (C1' : Rabs (m - p) <= 1001 / 1000 * um) by (rewrite Rabs_minus_sym; lra). pose proof (Rabs_le_inv _ _ C1') as C1''.
  (* the products with low parts *)
  assert (Blc : Rabs (l * c) <= 101 / 100 * um).
  { rewrite Rabs_mult, (Rabs_pos_eq c) by lra.
    apply Rle_trans with (101 / 100 * unit53 * h * c); [apply Rmult_le_compat_r; lra|unfold um, m; lra]. }
  assert (Bhk : Rabs (h * k) <= 101 / 100 * um).
  { rewrite Rabs_mult, (Rabs_pos_eq h) by lra.
    apply Rle_trans with (h * (101 / 100 * unit53 * c)); [apply Rmult_le_compat_l; lra|unfold um, m; lra]. }
  assert (Blk : Rabs (l * k) <= 103 / 100 * (unit53 * um)).
  { rewrite Rabs_mult. apply Rle_trans with (101 / 100 * unit53 * h * (101 / 100 * unit53 * c)).
    - apply Rmult_le_compat; try assumption; apply Rabs_pos.
    - unfold um, m in *. lra. }
  unfold product_of. cbv zeta.
  assert (I1 : is64 (times a b) p) by (apply times_is; try assumption; apply big_enough; fold m; rewrite Rabs_pos_eq; lra).
  set (t1 := times a b) in *.
  pose proof (opp_is _ _ I1) as I2. set (t2 := opp t1) in *.
  assert (I3 : is64 (fused a b t2) (m - p)).
  { apply (fused_exact _ _ _ h c (- p)); try assumption; [unfold m; ring|apply big_enough; lra]. }
  set (t3 := fused a b t2) in *.
  pose proof (times_is _ _ _ _ Hl Hk ltac:(apply big_enough; lra)) as I4. set (t4 := times a_lo b_lo) in *.
  pose proof (product_is_close (l * k)) as C4. set (v4 := nearest64 (l * k)) in *.
  assert (C4' : Rabs (v4 - l * k) <= / 100 * (unit53 * um)).
  { assert (unit53 * Rabs (l * k) <= / 1000000000000 * (103 / 100 * (unit53 * um))).
    { apply Rmult_le_compat; try apply Rabs_pos; lra. }
    lra. }
  absolute_values. assert (B5 : Rabs (l * c + v4) <= 102 / 100 * um) by (apply Rabs_le; lra).
  pose proof (fused_is _ _ _ _ _ _ Hl Hb I4 ltac:(apply big_enough; lra)) as I5. set (t5 := fused a_lo b t4) in *.
  pose proof (product_is_close (l * c + v4)) as C5. set (v5 := nearest64 (l * c + v4)) in *.
  assert (C5' : Rabs (v5 - (l * c + v4)) <= 103 / 100 * (unit53 * um)).
  { assert (unit53 * Rabs (l * c + v4) <= unit53 * (102 / 100 * um)) by (apply Rmult_le_compat_l; lra). lra. }
  absolute_values. assert (B6 : Rabs (h * k + v5) <= 204 / 100 * um) by (apply Rabs_le; lra).
  pose proof (fused_is _ _ _ _ _ _ Ha Hk I5 ltac:(apply big_enough; lra)) as I6. set (t6 := fused a b_lo t5) in *.
  pose proof (product_is_close (h * k + v5)) as C6. set (v6 := nearest64 (h * k + v5)) in *.
  assert (C6' : Rabs (v6 - (h * k + v5)) <= 205 / 100 * (unit53 * um)).
  { assert (unit53 * Rabs (h * k + v5) <= unit53 * (204 / 100 * um)) by (apply Rmult_le_compat_l; lra). lra. }
  absolute_values. assert (B7 : Rabs (m - p + v6) <= 306 / 100 * um) by (apply Rabs_le; lra).
  pose proof (plus_is _ _ _ _ I3 I6 ltac:(apply big_enough; lra)) as I7. set (t7 := plus t3 t6) in *.
  pose proof (sum_is_close _ _ Ge (format_of _ _ I6)) as C7. set (w := nearest64 (m - p + v6)) in *.
  assert (C7' : Rabs (w - (m - p + v6)) <= unit53 * (306 / 100 * um)) by (apply Rle_trans with (1 := C7); apply Rmult_le_compat_l;
    lra).
  absolute_values.
  apply (two_terms_near t1 t7 p w); try assumption; [lra|apply Rabs_le; lra|].
  replace (p + w - (h + l) * (c + k)) with
    ((w - (m - p + v6)) + (v6 - (h * k + v5)) + (v5 - (l * c + v4)) + (v4 - l * k)) by (unfold m; ring).
  replace (7 * (unit53 * unit53) * m) with (7 * (unit53 * um)) by (unfold um; ring). apply Rabs_le. lra.
Qed.

(* (c + k) / (h + l) *)
Lemma quotient_of_is_near : forall a a_lo b b_lo c k h l, is64 a c -> is64 a_lo k -> is64 b h -> is64 b_lo l ->
  / 1000000000000 <= c <= 1000000 -> / 1000 <= h <= 1000000 -> Rabs k <= 101 / 100 * unit53 * c ->
  Rabs l <= 101 / 100 * unit53 * h ->
  two_near (quotient_of a a_lo b b_lo) ((c + k) / (h + l)) (13 * (unit53 * unit53) * ((c + k) / (h + l))).
Proof.
  intros a a_lo b b_lo c k h l Ha Hal Hb Hl Hc Hh Bk Bl. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  pose proof (format_of _ _ Ha) as Gc. pose proof (format_of _ _ Hb) as Gh.
  assert (Uh : unit53 * h <= / 1000000000000 * h) by (apply Rmult_le_compat_r; lra). pose proof (Rabs_le_inv _ _ Bl) as Bl2.
  set (T0 := c / h). assert (HT0 : T0 * h = c) by (unfold T0; field; lra).
  assert (HT : / 1000000000000000000 <= T0 <= 1000000000).
  { split; apply Rmult_le_reg_r with h; try lra; rewrite HT0; nra. }
  set (uc := unit53 * c). assert (Bk2 : Rabs k <= 101 / 100 * uc) by (unfold uc; lra).
  assert (Huc : 0 <= uc <= / 1000000000000 * c) by (unfold uc; split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Uuc : 0 <= unit53 * uc <= / 1000000000000 * uc) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Htuc : tiny <= / 1000 * (unit53 * uc)) by (unfold uc, unit53; lra).
  unfold quotient_of. cbv zeta.
  pose proof (over_is _ _ _ _ Ha Hb ltac:(lra) ltac:(apply big_enough; fold T0; rewrite Rabs_pos_eq; lra)) as I1. fold T0 in I1.
  set (t1 := over a b) in *. pose proof (product_is_close T0) as C1. rewrite (Rabs_pos_eq T0) in C1 by lra.
  set (q := nearest64 T0) in *.
  assert (UT : unit53 * T0 <= / 1000000000000 * T0) by (apply Rmult_le_compat_r; lra).
  assert (Htt : tiny <= / 1000 * (unit53 * T0)) by (unfold unit53; lra).
  apply Rabs_le_inv in C1.
  assert (C1' : Rabs (q * h - c) <= 1001 / 1000 * uc).
  { replace (q * h - c) with ((q - T0) * h) by (rewrite <- HT0; ring). rewrite Rabs_mult, (Rabs_pos_eq h) by lra.
    replace (1001 / 1000 * uc) with (1001 / 1000 * (unit53 * T0) * h) by (unfold uc; rewrite <- HT0; ring).
    apply Rmult_le_compat_r; [lra|]. apply Rabs_le. lra. }
  set (m := q * h) in *. apply Rabs_le_inv in C1'.
  pose proof (product_is_close m) as C2. rewrite (Rabs_pos_eq m) in C2 by lra.
  assert (I2 : is64 (times t1 b) (nearest64 m)) by (apply times_is; try assumption; apply big_enough; fold m; rewrite Rabs_pos_eq;
    lra).
  set (t2 := times t1 b) in *. set (p := nearest64 m) in *.
  assert (C2' : Rabs (m - p) <= 1002 / 1000 * uc).
  { rewrite Rabs_minus_sym. apply Rle_trans with (1 := C2).
    assert (unit53 * m <= unit53 * (1000001 / 1000000 * c)) by (apply Rmult_le_compat_l; lra). unfold uc in *. lra. }
  apply Rabs_le_inv in C2'.
  assert (I3 : is64 (minus a t2) (c - p)).
  { apply minus_exact with c p; try assumption; [reflexivity| |apply big_enough, Rabs_le; lra].
    apply sterbenz; auto with typeclass_instances; [now apply format_of in I2|lra]. }
  set (t3 := minus a t2) in *. pose proof (opp_is _ _ I2) as I4. set (t4 := opp t2) in *.
  assert (Ge : in_binary64 (m - p)).
  { pose proof (two_product_is_exact q h (format_of _ _ I1) Gh) as E. cbv zeta in E. fold m p in E.
    assert (Hs : m = 0 \/ bpow radix2 (-1074 + 2 * 53 - 1) <= Rabs m).
    { right. rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 (-60)); [apply bpow_le; lia|simpl; lra]. }
    replace (m - p) with (nearest64 (m - p)) by (specialize (E Hs); lra). apply generic_format_round; auto with typeclass_instances. }
  assert (I5 : is64 (fused t1 b t4) (m - p)).
  { apply (fused_exact _ _ _ q h (- p)); try assumption; [unfold m; ring|apply big_enough, Rabs_le; lra]. }
  set (t5 := fused t1 b t4) in *.
  assert (B6 : Rabs (c - p - (m - p)) <= 1001 / 1000 * uc) by (apply Rabs_le; lra).
  pose proof (minus_is _ _ _ _ I3 I5 ltac:(apply big_enough; lra)) as I6. set (t6 := minus t3 t5) in *.
  pose proof (product_is_close (c - p - (m - p))) as C6. set (y6 := nearest64 (c - p - (m - p))) in *.
  assert (C6' : Rabs (y6 - (c - m)) <= 1002 / 1000 * (unit53 * uc)).
  { replace (c - m) with (c - p - (m - p)) by ring.
    assert (unit53 * Rabs (c - p - (m - p)) <= unit53 * (1001 / 1000 * uc)) by (apply Rmult_le_compat_l; lra). lra. }
  pose proof (opp_is _ _ I1) as I7. set (t7 := opp t1) in *.
  assert (B8' : Rabs (- q * l) <= 102 / 100 * uc).
  { rewrite Rabs_mult, Rabs_Ropp, (Rabs_pos_eq q) by lra.
    apply Rle_trans with (q * (101 / 100 * unit53 * h)); [apply Rmult_le_compat_l; lra|].
    replace (q * (101 / 100 * unit53 * h)) with (101 / 100 * unit53 * m) by (unfold m; ring).
    assert (unit53 * m <= unit53 * (1000001 / 1000000 * c)) by (apply Rmult_le_compat_l; lra). unfold uc in *. lra. }
  assert (B8 : Rabs (- q * l + k) <= 203 / 100 * uc) by (apply Rle_trans with (1 := Rabs_triang _ _); lra).
  pose proof (fused_is _ _ _ _ _ _ I7 Hl Hal ltac:(apply big_enough; lra)) as I8. set (t8 := fused t7 b_lo a_lo) in *.
  pose proof (product_is_close (- q * l + k)) as C8. set (y8 := nearest64 (- q * l + k)) in *.
  assert (C8' : Rabs (y8 - (- q * l + k)) <= 204 / 100 * (unit53 * uc)).
  { assert (unit53 * Rabs (- q * l + k) <= unit53 * (203 / 100 * uc)) by (apply Rmult_le_compat_l; lra). lra. }
  apply Rabs_le_inv in C6'. apply Rabs_le_inv in C8'. apply Rabs_le_inv in B8. apply Rabs_le_inv in B6.
  assert (B9 : Rabs (y6 + y8) <= 305 / 100 * uc) by (apply Rabs_le; lra).
  pose proof (plus_is _ _ _ _ I6 I8 ltac:(apply big_enough; lra)) as I9. set (t9 := plus t6 t8) in *.
  pose proof (sum_is_close _ _ (format_of _ _ I6) (format_of _ _ I8)) as C9. set (y9 := nearest64 (y6 + y8)) in *.
  assert (C9' : Rabs (y9 - (y6 + y8)) <= 305 / 100 * (unit53 * uc)).
  { assert (unit53 * Rabs (y6 + y8) <= unit53 * (305 / 100 * uc)) by (apply Rmult_le_compat_l; lra). lra. }
  apply Rabs_le_inv in C9'. apply Rabs_le_inv in B9.
  assert (B9' : Rabs y9 <= 306 / 100 * uc) by (apply Rabs_le; lra).
  assert (Ex : c / h <= 100000000000) by (fold T0; lra).
  assert (B10 : Rabs (y9 / h) <= 306 / 100 * (unit53 * T0)).
  { unfold Rdiv. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq h) by lra. apply Rmult_le_reg_r with h; [lra|].
    rewrite Rmult_assoc, Rinv_l by lra. rewrite Rmult_1_r. apply Rle_trans with (1 := B9'). right. unfold uc. rewrite <- HT0. field. }
  pose proof (over_is _ _ _ _ I9 Hb ltac:(lra) ltac:(apply big_enough; lra)) as I10. set (t10 := over t9 b) in *.
  pose proof (product_is_close (y9 / h)) as C10. set (y10 := nearest64 (y9 / h)) in *.
  assert (UUT : 0 <= unit53 * (unit53 * T0) <= / 1000000000000 * (unit53 * T0)).
  { split; [apply Rmult_le_pos; [lra|apply Rmult_le_pos; lra]|apply Rmult_le_compat_r; [apply Rmult_le_pos; lra|lra]]. }
  assert (Htut : tiny <= / 1000 * (unit53 * (unit53 * T0))) by (unfold unit53; lra).
  assert (C10' : Rabs (y10 - y9 / h) <= 307 / 100 * (unit53 * (unit53 * T0))).
  { assert (unit53 * Rabs (y9 / h) <= unit53 * (306 / 100 * (unit53 * T0))) by (apply Rmult_le_compat_l; lra). lra. }
  apply Rabs_le_inv in C10'. apply Rabs_le_inv in B10.
  set (E := (c + k) / (h + l)). assert (HE : E * (h + l) = c + k) by (unfold E; field; lra). apply Rabs_le_inv in Bk2.
  assert (HET : 999999 / 1000000 * T0 <= E <= 1000001 / 1000000 * T0).
  { split; apply Rmult_le_reg_r with (h + l); try lra; rewrite HE.
    - apply Rle_trans with (T0 * (9999999 / 10000000 * h)); [|rewrite <- HT0 in *; lra].
      replace (999999 / 1000000 * T0 * (h + l)) with (T0 * (999999 / 1000000 * (h + l))) by ring. apply Rmult_le_compat_l; lra.
    - apply Rle_trans with (T0 * (10000001 / 10000000 * h)); [rewrite <- HT0 in *; lra|].
      replace (1000001 / 1000000 * T0 * (h + l)) with (T0 * (1000001 / 1000000 * (h + l))) by ring. apply Rmult_le_compat_l; lra. }
  apply (two_terms_near t1 t10 q y10); try assumption; [lra|apply Rabs_le; lra|].
  assert (K : Rabs (q + y9 / h - E) <= 94 / 10 * (unit53 * (unit53 * T0))).
  { apply Rmult_le_reg_r with h; [lra|]. rewrite <- (Rabs_pos_eq h) at 2 by lra. rewrite <- Rabs_mult.
    replace ((q + y9 / h - E) * h) with
      ((y9 - (y6 + y8)) + (y6 - (c - m)) + (y8 - (- q * l + k)) + (c + k - E * (h + l)) + (E - q) * l)
      by (unfold m; field; lra).
    rewrite HE. replace (94 / 10 * (unit53 * (unit53 * T0)) * h) with (94 / 10 * (unit53 * uc)) by (unfold uc; rewrite <- HT0; ring).
    assert (Bq : Rabs ((E - q) * l) <= 32 / 10 * (unit53 * uc)).
    { assert (HEq : Rabs (E - q) <= 31 / 10 * (unit53 * T0)).
      { apply Rmult_le_reg_r with h; [lra|]. rewrite <- (Rabs_pos_eq h) at 1 by lra. rewrite <- Rabs_mult.
        replace ((E - q) * h) with ((c - m) + k - E * l) by (unfold m; rewrite Rmult_minus_distr_r; lra).
        assert (Rabs (E * l) <= 102 / 100 * uc).
        { rewrite Rabs_mult, (Rabs_pos_eq E) by lra.
          apply Rle_trans with (1000001 / 1000000 * T0 * (101 / 100 * unit53 * h)); [apply Rmult_le_compat; try lra; apply Rabs_pos|].
          unfold uc. rewrite <- HT0. assert (0 <= unit53 * (T0 * h)) by (apply Rmult_le_pos; [lra|apply Rmult_le_pos; lra]). lra. }
        apply Rabs_le_inv in H. replace (31 / 10 * (unit53 * T0) * h) with (31 / 10 * uc) by (unfold uc; rewrite <- HT0; ring).
        apply Rabs_le. lra. }
      rewrite Rabs_mult. apply Rle_trans with (31 / 10 * (unit53 * T0) * (101 / 100 * unit53 * h)).
      - apply Rmult_le_compat; try assumption; apply Rabs_pos.
      - replace (31 / 10 * (unit53 * T0) * (101 / 100 * unit53 * h)) with (3131 / 1000 * (unit53 * uc)) by (unfold uc; rewrite <- HT0;
        field). lra. }
    apply Rabs_le_inv in Bq. apply Rabs_le. lra. }
  apply Rabs_le_inv in K. replace (13 * (unit53 * unit53) * E) with (13 * (unit53 * (unit53 * E))) by ring.
  assert (unit53 * (unit53 * (999999 / 1000000 * T0)) <= unit53 * (unit53 * E)) by (apply Rmult_le_compat_l;
    [lra|apply Rmult_le_compat_l; lra]).
  apply Rabs_le. lra.
Qed.
