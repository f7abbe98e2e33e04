(* SPDX-License-Identifier: BSD-3-Clause *)
(* K times a gap along the cylinder's normal, in double-double: along_shaded() of fast/laws/outcome.h. The gap may have cancelled,
   however far, before it is divided by R. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts.
From Forceshade Require Import EnclosedQuotients BesideTie SecondStage SecondAlong ShadingRoot TwoPolygonsGap.
Open Scope R_scope.

(* ---- A quotient of almost nothing ---- *)

Lemma rounded_below : forall k a, Rabs a <= bpow radix2 k -> (-1000 <= k)%Z -> Rabs (nearest64 a) <= bpow radix2 k.
Proof.
  intros k a H Hk. apply abs_round_le_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia.
Qed.

Lemma double_of : forall k j a b, Rabs a <= bpow radix2 k -> Rabs b <= bpow radix2 k -> (k + 1 = j)%Z -> Rabs (a + b) <= bpow radix2 j /\
  Rabs (a - b) <= bpow radix2 j.
Proof.
  intros k j a b Ha Hb <-. rewrite Z.add_comm, bpow_plus. change (bpow radix2 1) with 2. split.
  - apply Rle_trans with (1 := Rabs_triang _ _). lra.
  - apply Rle_trans with (1 := minus_size _ _). lra.
Qed.

Lemma fits_power : forall k a, (k <= 1000)%Z -> Rabs a <= bpow radix2 k -> Rabs a <= bpow radix2 1000.
Proof. intros k a Hk H. apply Rle_trans with (1 := H). now apply bpow_le. Qed.

Lemma quotient_of_little : forall a a_lo b b_lo h l c, is64 a h -> is64 a_lo l -> is64 b c -> is64 b_lo 0 -> / 10 <= c <= 10000 ->
  Rabs h <= bpow radix2 (-182) -> Rabs l <= bpow radix2 (-182) ->
  exists p, is64 (fst (quotient_of a a_lo b b_lo)) p /\ Rabs p <= bpow radix2 (-156).
Proof.
  intros a a_lo b b_lo h l c Ha Hl Hb Hz Bc Bh Bl.
  assert (c16 : Rabs c <= bpow radix2 14) by (rewrite Rabs_pos_eq by lra; simpl; lra).
  assert (over_c : forall v x k j, (k + 4 = j)%Z -> (-1000 <= k)%Z -> (j <= 0)%Z -> is64 v x -> Rabs x <= bpow radix2 k ->
    exists y, is64 (over v b) y /\ Rabs y <= bpow radix2 j).
  { intros v x k j Ej Hk Hj Hv Hx. assert (B : Rabs (x / c) <= bpow radix2 j).
    { apply quotient_size; rewrite (Rabs_pos_eq c) by lra; [lra|]. apply Rle_trans with (1 := Hx). subst j. rewrite bpow_plus.
      pose proof (bpow_gt_0 radix2 k). apply Rle_trans with (bpow radix2 k * 1); [lra|]. rewrite Rmult_assoc.
        apply Rmult_le_compat_l; [lra|].
      change (bpow radix2 4) with 16. lra. }
    exists (nearest64 (x / c)). split; [|apply rounded_below; [exact B|lia]].
    apply over_is; trivial; [apply Rgt_not_eq; lra|apply (fits_power j); [lia|exact B]]. }
  unfold quotient_of. cbv zeta. cbn [fst snd].
  destruct (over_c a h (-182)%Z (-178)%Z eq_refl ltac:(lia) ltac:(lia) Ha Bh) as (q0 & I1 & B1). set (t1 := over a b) in *.
  assert (Bm : Rabs (q0 * c) <= bpow radix2 (-164)).
  { replace (-164)%Z with (-178 + 14)%Z by reflexivity. rewrite bpow_plus. now apply product_size. }
  pose proof (times_is _ _ _ _ I1 Hb (fits_power (-164) _ ltac:(lia) Bm)) as I2. pose proof (rounded_below _ _ Bm ltac:(lia)) as B2.
  set (t2 := times t1 b) in *. set (p0 := nearest64 (q0 * c)) in *.
  assert (Bh2 : Rabs h <= bpow radix2 (-164)) by (apply Rle_trans with (1 := Bh); apply bpow_le; lia).
  destruct (double_of _ (-163) _ _ Bh2 B2 eq_refl) as [_ D3].
  pose proof (minus_is _ _ _ _ Ha I2 (fits_power (-163) _ ltac:(lia) D3)) as I3. pose proof (rounded_below _ _ D3 ltac:(lia)) as B3.
  set (t3 := minus a t2) in *. pose proof (opp_is _ _ I2) as I4. set (t4 := opp t2) in *.
  destruct (double_of _ (-163) (q0 * c) (- p0) Bm ltac:(rewrite Rabs_Ropp; exact B2) eq_refl) as [D5 _].
  pose proof (fused_is _ _ _ _ _ _ I1 Hb I4 (fits_power (-163) _ ltac:(lia) D5)) as I5. pose proof (rounded_below _ _ D5 ltac:(lia)) as B5.
  set (t5 := fused t1 b t4) in *. destruct (double_of _ (-162) _ _ B3 B5 eq_refl) as [_ D6].
  pose proof (minus_is _ _ _ _ I3 I5 (fits_power (-162) _ ltac:(lia) D6)) as I6. pose proof (rounded_below _ _ D6 ltac:(lia)) as B6.
  set (t6 := minus t3 t5) in *. pose proof (opp_is _ _ I1) as I7. set (t7 := opp t1) in *.
  assert (D8 : Rabs (- q0 * 0 + l) <= bpow radix2 (-162)).
  { replace (- q0 * 0 + l) with l by ring. apply Rle_trans with (1 := Bl). apply bpow_le. lia. }
  pose proof (fused_is _ _ _ _ _ _ I7 Hz Hl (fits_power (-162) _ ltac:(lia) D8)) as I8. pose proof (rounded_below _ _ D8 ltac:(lia)) as B8.
  set (t8 := fused t7 b_lo a_lo) in *. destruct (double_of _ (-161) _ _ B6 B8 eq_refl) as [D9 _].
  pose proof (plus_is _ _ _ _ I6 I8 (fits_power (-161) _ ltac:(lia) D9)) as I9. pose proof (rounded_below _ _ D9 ltac:(lia)) as B9.
  set (t9 := plus t6 t8) in *. destruct (over_c t9 _ (-161)%Z (-157)%Z eq_refl ltac:(lia) ltac:(lia) I9 B9) as (y & I10 & B10).
  set (t10 := over t9 b) in *.
  assert (B1' : Rabs q0 <= bpow radix2 (-157)) by (apply Rle_trans with (1 := B1); apply bpow_le; lia).
  destruct (double_of _ (-156) _ _ B1' B10 eq_refl) as [D11 _].
  pose proof (plus_is _ _ _ _ I1 I10 (fits_power (-156) _ ltac:(lia) D11)) as I11. exists (nearest64 (q0 + y)).
  split; [exact I11|]. apply rounded_below; [exact D11|lia].
Qed.

(* A number whose bound is larger than it is has no sign. *)
Lemma sign_unknown : forall a h e, is64 (hi a) h -> is64 (error a) e -> 0 < e -> Rabs h <= e -> e <= 1000000 -> sign_of a = is_unknown.
Proof.
  intros a h e H E He Bh Be. pose proof unit_is_small as Hu. unfold sign_of.
    rewrite (equal_is _ _ _ _ H zero_is), (equal_is _ _ _ _ E zero_is).
  rewrite (Req_bool_false e 0) by lra. rewrite andb_false_r.
  pose proof (Rabs_pos h) as Ph. pose proof (unit_times _ Ph) as Uh. assert
    (Ea : Rabs h * (1 - 8 * unit53) = Rabs h - 8 * (unit53 * Rabs h)) by ring.
  pose proof (times_is _ _ _ _ (absolute_is _ _ H) almost_one_is ltac:(apply big_enough; rewrite Ea, Rabs_pos_eq; lra)) as I.
  rewrite (less_is _ _ _ _ E I), Rlt_bool_false; [reflexivity|]. apply Rle_trans with (2 := Bh).
  rewrite <- (round_generic radix2 fexp64 ZnearestE (Rabs h)) at 2 by (apply generic_format_abs; exact (format_of _ _ H)).
  apply round_le; auto with typeclass_instances. rewrite Ea. lra.
Qed.

(* ---- A gap over R ---- *)

(* What the quotient's bound is made from, where the divisor is exact. *)
Lemma divide_by_exact : forall a b c e p, let q := quotient_of (hi a) (lo a) (hi b) (lo b) in is_exactly b c -> / 10 <= c <= 10000 ->
  is64 (error a) e -> 0 <= e <= 1000 -> is64 (fst q) p -> Rabs p <= 1000000000 ->
  exists w v, divide a b = rounded q w /\ is64 w v /\ e / c - unit53 * (e / c) - tiny <= v <= 103 / 100 * (e / c) + tiny /\ 0 <= v.
Proof.
  intros a b c e p q (H & L & F) Bc E Be P Bp. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  assert (Ec : Rabs c = c) by (apply Rabs_pos_eq; lra).
  destruct (size_is _ c 0 H _ F ltac:(rewrite Ec; lra) ltac:(rewrite Ec; lra)) as (z & Z & Bz). rewrite Ec in Bz.
  unfold divide. cbv zeta. rewrite (less_is _ _ _ _ zero_is Z), Rlt_bool_true by lra. cbn [negb]. fold q.
  assert (I1 : is64 (times (absolute (fst q)) (error b)) 0).
  { apply (times_exact _ _ (Rabs p) 0); trivial; [now apply absolute_is|ring|apply generic_format_0|apply zero_is_not_too_large]. }
  assert (I2 : is64 (plus (error a) (times (absolute (fst q)) (error b))) e).
  { apply (plus_exact _ _ e 0); trivial; [ring|exact (format_of _ _ E)|apply big_enough; rewrite Rabs_pos_eq; lra]. }
  assert (Iz : / c <= / z <= 102 / 100 * / c).
  { pose proof (unit_times c ltac:(lra)) as Uc. split; [apply Rinv_le; lra|].
    replace (102 / 100 * / c) with (/ (100 / 102 * c)) by (field; lra). apply Rinv_le; lra. }
  assert (Ic : 0 < / c <= 10) by (split; [apply Rinv_0_lt_compat; lra|replace 10 with (/ (/ 10)) by field; apply Rinv_le; lra]).
  assert (Bez : e / c <= e / z <= 102 / 100 * (e / c)).
  { unfold Rdiv. split; [apply Rmult_le_compat_l; lra|]. replace (102 * / 100 * (e * / c)) with (e * (102 * / 100 * / c)) by ring. apply
    Rmult_le_compat_l; lra. }
  assert (Bec : 0 <= e / c <= 10000).
  { unfold Rdiv. split; [apply Rmult_le_pos; lra|]. replace 10000 with (1000 * 10) by ring. apply Rmult_le_compat; lra. }
  pose proof (over_is _ _ _ _ I2 Z ltac:(apply Rgt_not_eq; lra) ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as I3.
  pose proof (rounded_near (e / z) ltac:(lra)) as R3. pose proof (proj1 (rounded_up (e / z) (e / z) ltac:(lra))) as N3.
  pose proof (unit_times (e / z) ltac:(lra)) as U3. pose proof (unit_times (e / z - e / c) ltac:(lra)) as U4.
  exists (over (plus (error a) (times (absolute (fst q)) (error b))) (minus (times (absolute (hi b)) almost_one) (error b))),
    (nearest64 (e / z)).
  split; [reflexivity|]. split; [exact I3|]. split; [split; lra|exact N3].
Qed.

Lemma quotient_is_contained : forall gap M b c h e, contains gap M -> is_exactly b c -> / 10 <= c <= 10000 -> is64 (hi gap) h ->
  is64 (error gap) e -> e <= 1000 -> / 10000000000000000000000000000000000000000000000000000000 <= Rabs h <= 22400 ->
  exists p g, is64 (hi (divide gap b)) p /\ is64 (error (divide gap b)) g /\ contains (divide gap b) (M / c) /\
    99 / 100 * (Rabs h / c) <= Rabs p <= 101 / 100 * (Rabs h / c) /\ 99 / 100 * (e / c) - tiny <= g.
Proof.
  intros gap M b c h e C Ib Bc H E Be Bh. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  destruct C as (h' & l & e' & H1 & L & E1 & Bl & He & B & _). rewrite (is64_same _ _ _ H1 H) in *. rewrite (is64_same _ _ _ E1 E) in *.
  clear h' e' H1 E1. assert (Hc0 : c <> 0) by (apply Rgt_not_eq; lra). assert (Ec : Rabs c = c) by (apply Rabs_pos_eq; lra).
  assert (EQ : Rabs (h / c) = Rabs h / c) by (unfold Rdiv; rewrite Rabs_mult, Rabs_inv, Ec; reflexivity).
  set (Q := Rabs h / c) in *. assert (QC : Q * c = Rabs h) by (unfold Q; field; lra).
  assert (BQ : / 1000000000000000000000000000000000000000000000000000000000000 <= Q <= 224000).
  { split; apply Rmult_le_reg_r with c; lra. }
  pose proof (unit_times _ (Rabs_pos h)) as Uh. pose proof Ib as (H' & L' & E').
  destruct (quotient_of_parts (hi gap) (lo gap) (hi b) (lo b) h l c 0 H L H' L' ltac:(lra)
    ltac:(rewrite Rabs_R0, Ec; apply Rmult_le_pos; [lra|apply Rmult_le_pos; lra]) ltac:(rewrite Ec; lra) ltac:(rewrite EQ; lra) ltac:(lra))
    as (p & q & P & Qt & Off & Bp & Bq).
  rewrite Rplus_0_r, EQ in *.
  destruct (divide_by_exact gap b c e p Ib Bc E ltac:(lra) P ltac:(lra)) as (w & v & D & W & Bv & Nv). rewrite D. unfold rounded.
    cbn [hi lo error].
  assert (Bec : 0 <= e / c <= 10000).
  { unfold Rdiv. split; [apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]|]. apply Rmult_le_reg_r with c; [lra|].
    rewrite Rmult_assoc, Rinv_l, Rmult_1_r by exact Hc0. lra. }
  pose proof (unit_times _ (proj1 Bec)) as Uec. pose proof (unit_times v Nv) as Uv.
  destruct (error_covers _ p _ v 20000 P W ltac:(lra) ltac:(lra) ltac:(lra)) as (g & G & Bg).
  exists p, g. split; [exact P|]. split; [exact G|]. pose proof (unit_times Q ltac:(lra)) as UQ.
    pose proof (unit_times _ (proj1 UQ)) as UUQ.
  assert (Hsp : 31 * (unit53 * (unit53 * Q)) <= 98 / 100 * (share101 * Rabs p)).
  { rewrite share_is. replace (98 / 100 * (32 * (unit53 * unit53) * Rabs p)) with (unit53 * (unit53 * (98 / 100 * 32 * Rabs p))) by ring.
    replace (31 * (unit53 * (unit53 * Q))) with (unit53 * (unit53 * (31 * Q))) by ring. apply unit_times_compat, unit_times_compat. lra. }
  assert (Htq : tiny <= unit53 * (unit53 * Q)).
  { assert (unit53 * (unit53 * / 1000000000000000000000000000000000000000000000000000000000000) <= unit53 * (unit53 * Q))
      by (apply unit_times_compat, unit_times_compat; lra). unfold unit53 in *. lra. }
  split; [|split; [lra|lra]]. exists p, q, g. cbn [hi lo error]. split; [exact P|]. split; [exact Qt|]. split; [exact G|].
    split; [exact Bq|].
  split; [lra|]. split; [|lra].
  replace (p + q - M / c) with ((p + q - (h + l) / c) + (h + l - M) / c) by (field; lra). apply Rle_trans with (1 := Rabs_triang _ _).
  assert (Be2 : Rabs ((h + l - M) / c) <= e / c).
  { apply quotient_size; rewrite Ec; [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by exact Hc0. exact B. }
  assert (Uv2 : unit53 * (99 / 100 * (e / c) - tiny) <= unit53 * v) by (apply unit_times_compat; lra).
  assert (Ut : 0 <= unit53 * tiny <= / 1000000000000 * tiny) by (apply unit_times; lra). lra.
Qed.

Lemma little_has_no_sign : forall gap M b c h e, contains gap M -> is_exactly b c -> / 10 <= c <= 10000 -> is64 (hi gap) h ->
  is64 (error gap) e -> / 1000000000000000000000000000000000000000000 <= e <= 1000 ->
  Rabs h <= / 10000000000000000000000000000000000000000000000000000000 -> sign_of (divide gap b) = is_unknown.
Proof.
  intros gap M b c h e C Ib Bc H E Be Bh. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  destruct C as (h' & l & e' & H1 & L & _ & Bl & _). rewrite (is64_same _ _ _ H1 H) in *. clear h' H1 e'.
  pose proof (unit_times _ (Rabs_pos h)) as Uh. pose proof Ib as (H' & L' & E').
  assert (B182 : / 10000000000000000000000000000000000000000000000000000000 <= bpow radix2 (-182)) by (simpl; lra).
  destruct (quotient_of_little (hi gap) (lo gap) (hi b) (lo b) h l c H L H' L' Bc ltac:(lra) ltac:(lra)) as (p & P & Bp).
  assert (B156 : bpow radix2 (-156) <= / 50000000000000000000000000000000000000000000000) by (simpl; lra).
  destruct (divide_by_exact gap b c e p Ib Bc E ltac:(lra) P ltac:(lra)) as (w & v & D & W & Bv & Nv). rewrite D.
  assert (Bec : / 10000000000000000000000000000000000000000000000 <= e / c <= 10000).
  { split; apply Rmult_le_reg_r with c; try lra; unfold Rdiv; rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra; lra. }
  pose proof (unit_times (e / c) ltac:(lra)) as Uec.
  destruct (error_of_is _ p _ v v P W ltac:(lra) ltac:(lra) ltac:(lra)) as (g & G & Bg & _).
  destruct (error_is_at_least _ p _ v P W ltac:(lra) ltac:(lra)) as (g' & G' & Bg' & _). rewrite (is64_same _ _ _ G' G) in Bg'.
  pose proof share_is_small as Hsh. pose proof (Rabs_pos p) as Pp. assert (share101 * Rabs p <= 1 * Rabs p) by
    (apply Rmult_le_compat_r; lra).
  apply (sign_unknown _ p g); unfold rounded; cbn [hi error]; trivial; lra.
Qed.

Theorem quotient_of_settled : forall gap M b c, settled gap M -> is_exactly b c -> / 10 <= c <= 10000 ->
  sign_of (divide gap b) = is_unknown \/
  contains (divide gap b) (M / c) /\ Rabs (value64 (hi (divide gap b))) * c <= 22700 /\
    (sign_of (divide gap b) = is_positive -> / 1000000000000000000000000000000000000000000000000 <= value64 (hi (divide gap b))).
Proof.
  intros gap M b c (C & Bh & Be & D) Ib Bc. pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  pose proof C as (h & l & e & H & L & E & Bl & He & B & _). rewrite (proj1 H) in Bh, D. rewrite (proj1 E) in Be, D.
  destruct D as [I0|D].
  - right. assert (M0 : M = 0).
    { destruct I0 as (H0 & L0 & E0). rewrite (is64_same _ _ _ H H0), (is64_same _ _ _ L L0), (is64_same _ _ _ E E0) in B.
      pose proof (no_size _ B). lra. }
    rewrite M0. assert (Ed : encloses (3 * (0 + 0) + 3 * share101) (divide gap b) (0 / c)).
    { refine (encloses_divide 0 0 _ _ 0 c (encloses_exact _ _ I0) (encloses_exact _ _ Ib) _ _ _ _ _); [lra|lra|now left| |].
      - rewrite (Rabs_pos_eq c); lra.
      - unfold Rdiv. rewrite Rmult_0_l, Rabs_R0. lra. }
    pose proof (first_size _ _ _ Ed ltac:(lra)) as Sd. replace (0 / c) with 0 in * by (unfold Rdiv; ring). rewrite Rabs_R0 in Sd.
    assert (Cd : contains (divide gap b) 0) by (apply (enclosed_is_contained _ _ _ Ed); [lra|rewrite Rabs_R0; lra]).
    split; [exact Cd|]. pose proof (Rabs_pos (value64 (hi (divide gap b)))) as P0.
    assert (Z0 : Rabs (value64 (hi (divide gap b))) = 0) by lra. rewrite Z0. split; [lra|].
    intro Pos. pose proof (sign_is_right _ _ Cd) as S. rewrite Pos in S. lra.
  - destruct (Rle_lt_dec (Rabs h) (/ 10000000000000000000000000000000000000000000000000000000)) as [Small|Large].
    { left. destruct D as [D|D]; [lra|]. apply (little_has_no_sign gap M b c h e); trivial. lra. }
    right. destruct (quotient_is_contained gap M b c h e C Ib Bc H E Be ltac:(lra)) as (p & g & P & G & Cd & Bp & Bg).
    split; [exact Cd|]. rewrite (proj1 P). assert (QC : Rabs h / c * c = Rabs h) by (field; lra). split.
    + apply Rle_trans with (101 / 100 * (Rabs h / c) * c); [apply Rmult_le_compat_r; lra|lra].
    + intro Pos. destruct (positive_is _ _ Cd Pos) as (p' & m & g' & P' & _ & G' & _ & Hg & Dm & _).
      rewrite (is64_same _ _ _ G' G) in Hg, Dm. rewrite (is64_same _ _ _ P' P) in Dm. pose proof (Rabs_pos m) as Pm.
      destruct D as [D|D].
      * assert (/ 1000000000000000000000000000000000 <= Rabs h / c); [|rewrite (Rabs_pos_eq p) in Bp by lra; lra].
        apply Rmult_le_reg_r with c; lra.
      * assert (/ 10000000000000000000000000000000000000000000000 <= e / c); [|lra].
        apply Rmult_le_reg_r with c; [lra|]. replace (e / c * c) with e by (field; lra). lra.
Qed.

(* ---- Along the normal ---- *)

Definition along_shaded (R K x : binary32) (gap : double_double) : option evaluation :=
  let radius := exactly64 (to64 R) in
  let X := exactly64 (to64 x) in
  decide_along K (divide gap radius) X (root_of (multiply (add radius (negated X)) (add radius X))).

Lemma directed_by : forall a s n N c, 0 < c -> Rabs (value64 (hi a)) * c <= 22700 ->
  / 1000000000000000000000000000000000000000000000000 <= value64 (hi a) -> / 10 <= c -> encloses s n N -> 0 <= s <= / 1000 ->
  N = 0 \/ / 10000000000 <= Rabs N -> Rabs N <= c -> c <= 10000 -> directed a n.
Proof.
  intros a s n N c Hc Ba Pa Bc En Hs LN BN Bc2. pose proof (first_size _ _ _ En Hs) as Sn. set (h := value64 (hi a)) in *.
  rewrite (Rabs_pos_eq h) in Ba by lra. set (y := Rabs (value64 (hi n))) in *.
  assert (Bh : h <= 1000000) by (apply Rmult_le_reg_r with c; [lra|]; lra).
  unfold directed. cbv zeta. fold h y. split; [lra|]. destruct LN as [->|LN]; [left; rewrite Rabs_R0 in Sn; lra|right]. split; [lra|].
  apply Rle_trans with (h * (101 / 100 * c)); [apply Rmult_le_compat_l; lra|lra].
Qed.

Theorem along_shaded_is_right : forall R w K x X gap M answer, parameters R w K -> coordinate (to64 x) X -> Rabs X <= value32 w / 2 ->
  settled gap M -> along_shaded R K x gap = Some answer ->
  is_answer answer (0 < M) (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros R w K x X gap M answer Hp Cx Hin Sg H. pose proof share_is_small as Hsh. pose proof Hp as ((FR & _) & HR & Hw & _).
  assert (HXR : Rabs X <= value32 R) by lra. destruct (shading_root_enclosed R w K _ X Hp Cx HXR) as [Er Lr].
  set (P := (value32 R - X) * (value32 R + X)) in *.
  unfold shaded_x, shaded_z. rewrite Rle_bool_true by exact Hin. replace (Rsqr (value32 R) - Rsqr X) with P by (unfold P, Rsqr; ring).
  assert (EX : value32 K * (M / value32 R) * X = value32 K * M * (X / value32 R)) by (field; lra).
  assert (EZ : value32 K * (M / value32 R) * sqrt P = value32 K * M * (sqrt P / value32 R)) by (field; lra).
  rewrite <- EX, <- EZ. clear EX EZ.
  pose proof (exactly_is _ _ (to64_is_exact R FR)) as IR. pose proof (encloses_exact _ _ (exactly_is _ _ (coordinate_is _ _ Cx))) as Ex.
  assert (LX : X = 0 \/ / 10000000000 <= Rabs X).
  { destruct (coordinate_not_tiny _ _ Cx) as [L|L]; [now left|right]. simpl in L. lra. }
  assert (BP : Rabs (sqrt P) <= value32 R).
  { rewrite Rabs_pos_eq by apply sqrt_pos. rewrite <- (sqrt_square (value32 R)) by lra. apply sqrt_le_1_alt. unfold P.
    pose proof (Rle_0_sqr X) as S. unfold Rsqr in S. lra. }
  assert (LP : sqrt P = 0 \/ / 10000000000 <= Rabs (sqrt P)).
  { destruct Lr as [L|L]; [now left|right]. rewrite Rabs_pos_eq; lra. }
  assert (Htouch : 0 < M / value32 R <-> 0 < M).
  { assert (HRinv : 0 < / value32 R) by (apply Rinv_0_lt_compat; lra). unfold Rdiv. split; intro T.
    - apply Rmult_lt_reg_r with (/ value32 R); [exact HRinv|]. lra.
    - apply Rmult_lt_0_compat; assumption. }
  unfold along_shaded in H. cbv zeta in H. set (radius := exactly64 (to64 R)) in *. set (N := exactly64 (to64 x)) in *.
  destruct (quotient_of_settled gap M radius _ Sg IR ltac:(lra)) as [U|(Cq & Bq & Pq)].
  { unfold decide_along in H. cbv zeta in H. rewrite U in H. discriminate H. }
  refine (along_is_right R w K _ (M / value32 R) N X 0 _ (sqrt P) (66 * share101) (0 < M) answer Hp Cq Htouch Ex _ Er _ _ H); [lra|lra|].
  intros Pos _. specialize (Pq Pos). split.
  - apply (directed_by _ 0 _ X (value32 R)); trivial; lra.
  - apply (directed_by _ (66 * share101) _ (sqrt P) (value32 R)); trivial; lra.
Qed.

(* A gap that is exact: -z, beside a bump and at its foot. *)
Lemma depth_is_settled : forall zv Z, coordinate zv Z -> settled (exactly64 (opp zv)) (- Z).
Proof.
  intros zv Z Cz. pose proof (exactly_is _ _ (opp_is _ _ (coordinate_is _ _ Cz))) as I. pose proof (coordinate_range _ _ Cz) as BZ.
  pose proof I as ((H & _) & _ & (E & _)). split; [apply (enclosed_is_contained 0); [now apply encloses_exact|lra|rewrite Rabs_Ropp; lra]|].
  rewrite H, E, Rabs_Ropp. split; [lra|]. split; [lra|]. destruct (coordinate_not_tiny _ _ Cz) as [L|L].
  - left. rewrite L, Ropp_0 in I. exact I.
  - right. left. simpl in L. lra.
Qed.

(* The gap of a bump, which at its foot is that of the plane. *)
Lemma gap_or_foot_is : forall R w K x X z Z gap M, parameters R w K -> is_finite 24 128 x = true -> value32 x = X ->
  Rabs X <= 10000 -> coordinate (to64 z) Z -> settled gap M -> (Rabs X = value32 w / 2 -> M = - Z) ->
  settled (if is_at_foot w x then exactly64 (opp (to64 z)) else gap) M.
Proof.
  intros R w K x X z Z gap M Hp Fx Vx BX Cz Sg Foot. pose proof Hp as ((_ & Fw & _) & _).
  rewrite (is_at_foot_is w x Fw Fx), Vx by (rewrite Vx; exact BX). case Req_bool_spec; intro E; [|exact Sg].
  rewrite (Foot E). now apply depth_is_settled.
Qed.

(* A shaded bump of any shape: M is its penetration, and that of the plane beside it. *)
Lemma shaded_second_is_right : forall R w K x X z Z gap M answer, parameters R w K -> is_finite 24 128 x = true -> value32 x = X ->
  coordinate (to64 x) X -> coordinate (to64 z) Z ->
  (Rabs X <= value32 w / 2 -> settled gap M) -> (value32 w / 2 < Rabs X -> M = - Z) ->
  (if is_beside w x then decide_along K (exactly64 (opp (to64 z))) (exactly64 zero64) (exactly64 (two_to 0)) else along_shaded R K x gap) =
    Some answer ->
  is_answer answer (0 < M) (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros R w K x X z Z gap M answer Hp Fx Vx Cx Cz Sg Beside H. pose proof (coordinate_range _ _ Cx) as BX.
    pose proof Hp as ((_ & Fw & _) & _).
  rewrite is_beside_is in H by (rewrite ?Vx; assumption). rewrite Vx in H.
  destruct (Rle_lt_dec (Rabs X) (value32 w / 2)) as [Hin|Hin].
  - rewrite Rle_bool_true in H by exact Hin. exact (along_shaded_is_right R w K x X gap M answer Hp Cx Hin (Sg Hin) H).
  - rewrite Rle_bool_false in H by exact Hin. cbn [negb] in H. rewrite (Beside Hin). unfold shaded_x, shaded_z.
    rewrite Rle_bool_false by exact Hin. rewrite Rmult_1_r. apply is_answer_same with (Z < 0); [split; lra|].
    exact (on_plane_is_right R w K _ Z answer Hp Cz H).
Qed.
