(* SPDX-License-Identifier: BSD-3-Clause *)
(* A double-double as head and tail, the head so short that its product with a binary32 is exact: split of
   fast/numbers/first_stage.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Relative Sterbenz Pff2Flocq.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth.
Open Scope R_scope.

Definition split_head (a : double_double) : binary64 :=
  let c := times (constant (2 ^ 24 + 1) 0) (hi a) in minus c (minus c (hi a)).
Definition split_tail (a : double_double) : binary64 := plus (minus (hi a) (split_head a)) (lo a).

Global Instance prec29 : Prec_gt_0 29 := eq_refl _.
Notation nearest29 := (round radix2 (FLT_exp (-1074) 29) ZnearestE).

(* Veltkamp: the head is rounded to 29 bits. *)
Lemma split_head_is : forall a h, is64 (hi a) h -> Rabs h <= 1000000 -> is64 (split_head a) (nearest29 h).
Proof.
  intros [h0 l0 e0] h H Bh. cbn [hi] in *. unfold split_head. cbn [hi]. pose proof (format_of _ _ H) as Gh.
  pose proof (constant_is (2 ^ 24 + 1) 0 ltac:(lia) ltac:(lia)) as Ik. set (k := IZR _ * bpow radix2 0) in Ik.
  assert (Hk : k = 16777217) by (unfold k; simpl; lra).
  pose proof (Veltkamp_Even radix2 (-1074) 53 (fun z => negb (Z.even z)) 24 ltac:(lia) ltac:(lia) ltac:(lia)
    ltac:(lia) h Gh eq_refl) as V.
  cbv zeta in V. change (53 - 24)%Z with 29%Z in V. change (bpow radix2 24) with 16777216 in V.
  replace (16777216 + 1) with k in V by lra.
  rewrite (Rmult_comm h k) in V.
  assert (one_more : forall a b, Rabs a <= b -> b <= 1000000000000000000 -> not_too_large a /\ Rabs (nearest64 a) <= 2 * b + 1).
  { intros a b Ha Hb. split; [apply Rle_trans with (bpow radix2 100); [simpl; lra|apply bpow_le; lia]|].
    pose proof (product_is_close a) as C. pose proof (Rabs_triang_inv (nearest64 a) a) as T. pose proof tiny_is_tiny.
    pose proof unit_is_small.
    pose proof (Rabs_pos a). assert (unit53 * Rabs a <= Rabs a) by (rewrite <- (Rmult_1_l (Rabs a)) at 2; apply Rmult_le_compat_r;
      lra). lra. }
  destruct (one_more (k * h) 17000000000000) as [M1 N1]; [|lra|].
  { rewrite Rabs_mult, Hk, (Rabs_pos_eq 16777217) by lra. lra. }
  pose proof (times_is _ _ _ _ Ik H M1) as I1. set (c := nearest64 (k * h)) in *.
  destruct (one_more (c - h) 40000000000000) as [M2 N2]; [|lra|].
  { unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra. }
  pose proof (minus_is _ _ _ _ I1 H M2) as I2.
  assert (E : nearest64 (h - c) + c = c - nearest64 (c - h)).
  { replace (h - c) with (- (c - h)) by ring. rewrite round_NE_opp. ring. }
  change (round radix2 (FLT_exp (-1074) 53) (Znearest (fun z => negb (Z.even z)))) with nearest64 in V. rewrite E in V.
  change (Znearest (fun z => negb (Z.even z))) with ZnearestE in V. rewrite <- V.
  apply minus_is; try assumption. apply (one_more _ 130000000000000); [|lra]. set (n := nearest64 (c - h)) in *.
  unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra.
Qed.

(* The head has 29 bits, and both together are off by no more than the tail's rounding. *)
Theorem split_is : forall a h l, is64 (hi a) h -> is64 (lo a) l -> Rabs l <= 101 / 100 * unit53 * h -> 0 <= h <= 100002 / 10 ->
  h = 0 \/ / 1000000000000 <= h ->
  exists t s, is64 (split_head a) t /\ is64 (split_tail a) s /\ generic_format radix2 (FLT_exp (-149) 29) t /\
    Rabs (t - h) <= / 536870912 * h /\ Rabs s <= tail_share * t /\
    Rabs (h + l - (t + s)) <= unit53 * (/ 536870912 * (1 + / 1000000) * h).
Proof.
  intros a h l H L Bl Hh Hsize.
  assert (big : forall b, Rabs b <= 1000000 -> not_too_large b).
  { intros b Hb. apply Rle_trans with (bpow radix2 20); [simpl; lra|apply bpow_le; lia]. }
  pose proof (split_head_is a h H ltac:(rewrite Rabs_pos_eq; lra)) as Ih. set (t := nearest29 h) in *.
  assert (Gt : generic_format radix2 (FLT_exp (-149) 29) t /\ Rabs (t - h) <= / 536870912 * h /\ 0 <= t).
  { destruct Hsize as [H0|Hs].
    - assert (t = 0) as -> by (unfold t; rewrite H0; apply round_0; auto with typeclass_instances).
      rewrite H0. replace (0 - 0) with 0 by ring. rewrite Rabs_R0. split; [apply generic_format_0|lra].
    - pose proof (relative_error_N_FLT radix2 (-1074) 29 (eq_refl _) (fun n => negb (Z.even n)) h) as E.
      rewrite (Rabs_pos_eq h) in E by lra.
      change (Znearest (fun n => negb (Z.even n))) with ZnearestE in E. fold t in E.
      replace (/ 2 * bpow radix2 (- (29) + 1)) with (/ 536870912) in E by (simpl; lra).
      assert (Hs2 : bpow radix2 (-42) <= h) by (simpl; lra).
      assert (E2 : Rabs (t - h) <= / 536870912 * h) by (apply E; apply Rle_trans with (2 := Hs2); apply bpow_le; lia).
      pose proof (Rabs_le_inv _ _ E2) as E3. split; [|split; [exact E2|lra]].
      apply generic_inclusion_mag with (FLT_exp (-1074) 29); [|apply generic_format_round; auto with typeclass_instances].
      intro Hne. assert (Hm : (-45 <= mag radix2 t)%Z); [|unfold FLT_exp; lia].
      apply mag_ge_bpow. rewrite Rabs_pos_eq by lra. simpl. lra. }
  destruct Gt as (Gt & Ct & Ht). pose proof (Rabs_le_inv _ _ Ct) as Ct2. pose proof (Rabs_le_inv _ _ Bl) as Bl2.
  pose proof (format_of _ _ H) as Gh. pose proof (format_of _ _ Ih) as Gt64.
  assert (Gd : in_binary64 (h - t)) by (apply sterbenz; auto with typeclass_instances; lra).
  assert (Id : is64 (minus (hi a) (split_head a)) (h - t)).
  { apply minus_exact with h t; try assumption; [reflexivity|apply big; apply Rabs_le; lra]. }
  assert (Bs : Rabs (h - t + l) <= / 536870912 * (1 + / 1000000) * h) by (apply Rabs_le; unfold unit53 in *; lra).
  assert (It : is64 (split_tail a) (nearest64 (h - t + l))) by (apply plus_is; try assumption; apply big; lra).
  pose proof (sum_is_close _ _ Gd (format_of _ _ L)) as Cs. set (s := nearest64 (h - t + l)) in *.
  assert (Cs2 : Rabs (s - (h - t + l)) <= unit53 * (/ 536870912 * (1 + / 1000000) * h)).
  { apply Rle_trans with (1 := Cs). apply Rmult_le_compat_l; [unfold unit53; lra|assumption]. }
  pose proof (Rabs_le_inv _ _ Cs2) as Cs3. pose proof (Rabs_le_inv _ _ Bs) as Bs3.
  exists t, s. split; [exact Ih|]. split; [exact It|]. split; [exact Gt|]. split; [exact Ct|]. split.
  - apply Rabs_le. unfold tail_share, unit53 in *. lra.
  - rewrite Rabs_minus_sym. replace (t + s - (h + l)) with (s - (h - t + l)) by ring. exact Cs2.
Qed.
