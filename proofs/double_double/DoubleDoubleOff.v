(* SPDX-License-Identifier: BSD-3-Clause *)
(* Double-double with its bound of the error, where terms cancel: how far off in absolute numbers, one operation after another. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds.
From Forceshade Require Import DoubleDoubleTerms.
Open Scope R_scope.

Lemma quotient_of_is_off : forall a a_lo b b_lo h l c k Q, is64 a h -> is64 a_lo l -> is64 b c -> is64 b_lo k ->
  Rabs h <= Q * Rabs c -> Rabs l <= Q * Rabs c -> Rabs k <= 2 * (unit53 * Rabs c) -> 0 < Rabs c <= 1000 ->
  / 1000000000000000000000000000000000000000000000000000000000000 <= Q * Rabs c -> Q <= 1000 ->
  exists p q, is64 (fst (quotient_of a a_lo b b_lo)) p /\ is64 (snd (quotient_of a a_lo b b_lo)) q /\
    Rabs (p + q - (h + l) / (c + k)) <= 20 * (unit53 * Q) /\ Rabs p <= 3 * Q /\ Rabs q <= 5 * (unit53 * Q).
Proof.
  intros a a_lo b b_lo h l c k Q Ha Hl Hb Hk Bh Bl Bk Bc HQc HQ. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  set (C := Rabs c) in *. assert (Hc0 : c <> 0) by (intro E; unfold C in Bc; rewrite E, Rabs_R0 in Bc; lra).
  assert (HQ0 : 0 < Q) by (apply Rmult_lt_reg_r with C; lra).
  set (uQ := unit53 * Q). assert (EuQ : unit53 * Q = uQ) by reflexivity. pose proof (unit_times Q ltac:(lra)) as BuQ. fold uQ in BuQ.
  assert (QC1 : Q * C <= Q * 1000) by (apply Rmult_le_compat_l; lra).
  set (W := uQ * C). assert (EW : unit53 * (Q * C) = W) by (unfold W, uQ; ring).
  assert (EW2 : uQ * C = W) by reflexivity.
  assert (BW : 0 <= W <= / 1000000000000 * (Q * C)) by (rewrite <- EW; apply unit_times; lra).
  assert (TW : tiny <= / 1000 * W) by (rewrite <- EW; unfold unit53; lra).
  assert (WQ : W <= 1000 * uQ) by (unfold W; rewrite (Rmult_comm 1000); apply Rmult_le_compat_l; lra).
  assert (TQ : tiny <= / 1000 * uQ).
  { unfold uQ, unit53. assert (/ 1000000000000000000000000000000000000000000000000000000000000000 <= Q) by lra. lra. }
  assert (TC : tiny * C <= / 1000 * W).
  { apply Rle_trans with (tiny * 1000); [apply Rmult_le_compat_l; lra|]. rewrite <- EW. unfold unit53. lra. }
  unfold quotient_of. cbv zeta. cbn [fst snd].
  pose proof (quotient_size h c Q ltac:(fold C; lra) Bh) as BX. pose proof (quotient_size l c Q ltac:(fold C; lra) Bl) as BY.
  destruct (over_close _ _ _ _ Ha Hb Hc0 ltac:(lra)) as [I1 C1]. set (t1 := over a b) in *. set (q0 := nearest64 (h / c)) in *.
  pose proof (unit_times_compat _ _ BX) as U1. pose proof (size_by q0 (h / c)) as S1.
  assert (C1' : Rabs (q0 * c - h) <= 1001 / 1000 * W + tiny * C).
  { replace (q0 * c - h) with ((q0 - h / c) * c) by (field; exact Hc0). rewrite Rabs_mult. fold C.
    apply Rle_trans with ((uQ + tiny) * C); [apply Rmult_le_compat_r; lra|lra]. }
  set (m := q0 * c) in *. pose proof (size_by m h) as Sm.
  destruct (times_close _ _ _ _ I1 Hb ltac:(fold m; lra)) as [I2 C2]. fold m in I2, C2. set (t2 := times t1 b) in *.
  set (p0 := nearest64 m) in *.
  assert (U2 : unit53 * Rabs m <= unit53 * (1001 / 1000 * (Q * C))) by (apply unit_times_compat; lra).
  assert (C2' : Rabs (p0 - m) <= 1003 / 1000 * W) by lra. pose proof (size_by p0 m) as Sp.
  destruct (minus_close _ _ _ _ Ha I2 ltac:(lra)) as [I3 C3]. set (t3 := minus a t2) in *. set (d := nearest64 (h - p0)) in *.
  assert (Bd : Rabs (h - p0) <= 201 / 100 * W).
  { replace (h - p0) with (- (m - h) - (p0 - m)) by ring. apply Rle_trans with (1 := minus_size _ _). rewrite Rabs_Ropp. lra. }
  pose proof (unit_times _ (Rabs_pos (h - p0))) as U3. pose proof (size_by d (h - p0)) as S3.
  pose proof (opp_is _ _ I2) as I4. set (t4 := opp t2) in *.
  assert (E5 : q0 * c + - p0 = - (p0 - m)) by (unfold m; ring).
  assert (B5 : Rabs (q0 * c + - p0) <= 1003 / 1000 * W) by (rewrite E5, Rabs_Ropp; exact C2').
  destruct (fused_close _ _ _ _ _ _ I1 Hb I4 ltac:(lra)) as [I5 C5]. set (t5 := fused t1 b t4) in *.
  set (e := nearest64 (q0 * c + - p0)) in *.
  pose proof (unit_times _ (Rabs_pos (q0 * c + - p0))) as U5. pose proof (size_by e (q0 * c + - p0)) as S5.
  destruct (minus_close _ _ _ _ I3 I5 ltac:(lra)) as [I6 C6]. set (t6 := minus t3 t5) in *. set (r1 := nearest64 (d - e)) in *.
  pose proof (minus_size d e) as M6. pose proof (unit_times _ (Rabs_pos (d - e))) as U6. pose proof (size_by r1 (d - e)) as S6.
  assert (B6 : Rabs r1 <= 303 / 100 * W) by lra.
  pose proof (opp_is _ _ I1) as I7. set (t7 := opp t1) in *.
  assert (B7 : Rabs (- q0 * k) <= 203 / 100 * W).
  { rewrite Rabs_mult, Rabs_Ropp. apply Rle_trans with (1001 / 1000 * Q * (2 * (unit53 * C))).
    - apply Rmult_le_compat; try apply Rabs_pos; lra.
    - replace (1001 / 1000 * Q * (2 * (unit53 * C))) with (2002 / 1000 * W) by (rewrite <- EW; field). lra. }
  pose proof (Rabs_triang (- q0 * k) l) as T8.
  destruct (fused_close _ _ _ _ _ _ I7 Hk Hl ltac:(lra)) as [I8 C8]. set (t8 := fused t7 b_lo a_lo) in *.
  set (r2 := nearest64 (- q0 * k + l)) in *.
  assert (U8 : unit53 * Rabs (- q0 * k + l) <= unit53 * (1001 / 1000 * (Q * C))) by (apply unit_times_compat; lra).
  assert (B8 : Rabs (r2 - l) <= 304 / 100 * W).
  { replace (r2 - l) with ((r2 - (- q0 * k + l)) + - q0 * k) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  pose proof (size_by r2 l) as S8. pose proof (Rabs_triang r1 r2) as T9.
  destruct (plus_close _ _ _ _ I6 I8 ltac:(lra)) as [I9 C9]. set (t9 := plus t6 t8) in *. set (r := nearest64 (r1 + r2)) in *.
  assert (U9 : unit53 * Rabs (r1 + r2) <= unit53 * (1001 / 1000 * (Q * C))) by (apply unit_times_compat; lra).
  assert (B9 : Rabs (r - l) <= 709 / 100 * W).
  { replace (r - l) with ((r - (r1 + r2)) + r1 + (r2 - l)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    pose proof (Rabs_triang (r - (r1 + r2)) r1). lra. }
  pose proof (size_by r l) as S9.
  pose proof (quotient_size r c (1001 / 1000 * Q) ltac:(fold C; lra) ltac:(fold C; lra)) as BZ.
  destruct (over_close _ _ _ _ I9 Hb Hc0 ltac:(lra)) as [I10 C10]. set (t10 := over t9 b) in *. set (y := nearest64 (r / c)) in *.
  pose proof (unit_times_compat _ _ BZ) as U10.
  assert (B10 : Rabs (y - l / c) <= 82 / 10 * uQ).
  { replace (y - l / c) with ((y - r / c) + (r - l) / c) by (field; exact Hc0). apply Rle_trans with (1 := Rabs_triang _ _).
    assert (Rabs ((r - l) / c) <= 709 / 100 * uQ) by (apply quotient_size; fold C; lra). lra. }
  pose proof (size_by y (l / c)) as S10.
  destruct (fast_two_sum_terms t1 t10 q0 y I1 I10 ltac:(lra) ltac:(lra)) as (p & q & I11 & I13 & Ep & Cp & Bq & D).
  exists p, q. split; [exact I11|]. split; [exact I13|].
  pose proof (Rabs_triang q0 y) as T11. pose proof (size_by p (q0 + y)) as S11.
  assert (U11 : unit53 * Rabs (q0 + y) <= unit53 * (21 / 10 * Q)) by (apply unit_times_compat; lra).
  assert (U12 : unit53 * Rabs y <= unit53 * (1001 / 1000 * Q)) by (apply unit_times_compat; lra).
  split; [|split; lra].
  assert (Z1 : Rabs (p + q - (q0 + y)) <= 102 / 100 * uQ) by (destruct D as [[_ D]|[_ D]]; [rewrite (nothing_off _ _ D)|]; lra).
  assert (Z2 : Rabs ((h + l) / c - (h + l) / (c + k)) <= 43 / 10 * uQ).
  { assert (Bkc : Rabs k <= / 1000 * C) by (pose proof (unit_times C ltac:(lra)); lra).
    pose proof (size_by c (c + k)) as Sck. fold C in Sck. replace (c - (c + k)) with (- k) in Sck by ring. rewrite Rabs_Ropp in Sck.
    assert (Hck : c + k <> 0) by (intro E; rewrite E, Rabs_R0 in Sck; lra).
    replace ((h + l) / c - (h + l) / (c + k)) with ((h / c + l / c) * k / (c + k)) by (field; split; assumption).
    apply quotient_size; [lra|]. apply Rle_trans with (2 * Q * (2 * (unit53 * C))).
    - apply product_size; [apply Rle_trans with (1 := Rabs_triang _ _); lra|exact Bk].
    - replace (2 * Q * (2 * (unit53 * C))) with (uQ * (4 * C)) by (unfold uQ; ring).
      replace (43 / 10 * uQ * Rabs (c + k)) with (uQ * (43 / 10 * Rabs (c + k))) by ring. apply Rmult_le_compat_l; lra. }
  replace (p + q - (h + l) / (c + k)) with
    ((p + q - (q0 + y)) + (q0 - h / c) + (y - l / c) + ((h + l) / c - (h + l) / (c + k))) by (unfold Rdiv; ring).
  absolute_values. apply Rabs_le. lra.
Qed.

(* a is at most e off x; its terms are no larger than b and c, its bound of the error no larger than g. *)
Definition is_off (a : double_double) (x e b c g : R) : Prop :=
  exists h l k, is64 (hi a) h /\ is64 (lo a) l /\ is64 (error a) k /\ Rabs (h + l - x) <= e /\ Rabs h <= b /\ Rabs l <= c /\ 0 <= k <= g.

Lemma is_off_exactly : forall v x b, is64 v x -> Rabs x <= b -> is_off (exactly64 v) x 0 b 0 0.
Proof.
  intros v x b H Hb. exists x, 0, 0. split; [exact H|]. split; [apply zero_is|]. split; [apply zero_is|].
  split; [rewrite Rplus_0_r, Rminus_diag_eq, Rabs_R0 by reflexivity; lra|]. split; [exact Hb|]. split; [rewrite Rabs_R0; lra|lra].
Qed.

Lemma is_off_negated : forall a x e b c g, is_off a x e b c g -> is_off (negated a) (- x) e b c g.
Proof.
  intros a x e b c g (h & l & k & H & L & K & E & Bh & Bl & Bk). exists (- h), (- l), k. split; [now apply opp_is|].
  split; [now apply opp_is|]. split; [exact K|]. rewrite !Rabs_Ropp. split; [|now split].
  replace (- h + - l - - x) with (- (h + l - x)) by ring. now rewrite Rabs_Ropp.
Qed.

Lemma is_off_more : forall a x e b c g e' b' c' g', is_off a x e b c g -> e <= e' -> b <= b' -> c <= c' -> g <= g' ->
  is_off a x e' b' c' g'.
Proof.
  intros a x e b c g e' b' c' g' (h & l & k & H & L & K & E & Bh & Bl & Bk) He Hb Hc Hg. exists h, l, k. repeat (split; [assumption|]).
  repeat split; lra.
Qed.

(* A smaller bound of the first term, where the number itself is smaller. *)
Lemma is_off_smaller : forall a x e b c g m, is_off a x e b c g -> Rabs x <= m -> is_off a x e (m + e + c) c g.
Proof.
  intros a x e b c g m (h & l & k & H & L & K & E & Bh & Bl & Bk) Hm. exists h, l, k. repeat (split; [assumption|]).
  split; [|split; assumption]. pose proof (size_by (h + l) x) as S. pose proof (size_by h (h + l)) as T.
  replace (h - (h + l)) with (- l) in T by ring. rewrite Rabs_Ropp in T. lra.
Qed.

Lemma error_is_small : forall v x propagated p g b, is64 v x -> is64 propagated p -> 0 <= p <= 1001 / 1000 * g + 9 * tiny -> g <= 1000 ->
  Rabs x <= b -> / 10000000000000000000000000000000000000000 <= b <= 1000000 ->
  exists k, is64 (error_of v propagated) k /\ 0 <= k <= 3 * g + / 1000000000000 * b.
Proof.
  intros v x propagated p g b Hv Hp Bp Hg Hx Hb. pose proof tiny_is_tiny as Htiny. pose proof (Rabs_pos x) as Px.
  destruct (error_of_is v x propagated p (1001 / 1000 * g + 9 * tiny) Hv Hp Bp ltac:(lra) ltac:(lra)) as (k & K & Bk & _).
  exists k. split; [exact K|]. unfold share101 in *. lra.
Qed.

Lemma rounded_sum_of_errors : forall e f g, 0 <= e -> 0 <= f -> e + f <= g -> g <= 1000 ->
  0 <= nearest64 (e + f) <= 1001 / 1000 * g + tiny.
Proof.
  intros e f g He Hf Hg Hg2. pose proof (rounded_up (e + f) g ltac:(lra)) as R. pose proof (unit_times g ltac:(lra)). lra.
Qed.

(* A sum: the first terms together are no larger than S, the second no larger than L. *)
Lemma is_off_add : forall a b x e m c g x' e' m' c' g' S L B, is_off a x e m c g -> is_off b x' e' m' c' g' -> m <= 1000 -> m' <= 1000 ->
  g + g' <= 100 ->
  Rabs (x + x') + e + e' + L <= S -> c + c' <= L -> L <= 100 -> 11 / 10 * (S + L) <= B ->
  / 10000000000000000000000000000000000000000 <= B <= 10000 ->
  is_off (add a b) (x + x') (e + e' + 21 / 10 * unit53 * (unit53 * S + L)) B (unit53 * (11 / 10 * S + 5 * L))
    (3 * (g + g') + / 1000000000000 * B) /\
  (/ 10000000000000000000 <= x + x' -> L + e + e' <= / 100000000 * (x + x') ->
    exists p q, is64 (hi (add a b)) p /\ is64 (lo (add a b)) q /\ Rabs q <= unit53 * p).
Proof.
  intros a b x e m c g x' e' m' c' g' S L B (h & l & k & H & L1 & K & E & Bh & Bl & Bk) (h' & l' & k' & H' & L' & K' & E' & Bh' & Bl' & Bk')
    Hm Hm' Hg HS HL HL2 HB HB2. pose proof tiny_is_tiny as Htiny. pose proof (Rabs_pos l) as P1. pose proof (Rabs_pos l') as P2.
  assert (Hhh : Rabs (h + h') <= S).
  { replace (h + h') with ((x + x') + (h + l - x) + (h' + l' - x') - (l + l')) by ring. apply Rle_trans with (1 := minus_size _ _).
    pose proof (Rabs_triang (x + x' + (h + l - x)) (h' + l' - x')). pose proof (Rabs_triang (x + x') (h + l - x)).
    pose proof (Rabs_triang l l'). lra. }
  destruct (sum_of_is_off _ _ _ _ h l h' l' S L H L1 H' L' ltac:(lra) ltac:(lra) Hhh ltac:(lra) ltac:(lra)) as
    (p & q & P & Q & Epq & Bp & Bq & _ & T).
  assert (I : is64 (plus (error a) (error b)) (nearest64 (k + k'))).
  { apply plus_is; try assumption. apply big_enough. rewrite Rabs_pos_eq; lra. }
  pose proof (rounded_sum_of_errors k k' (g + g') ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as R.
  destruct (error_is_small _ p _ _ (g + g') B P I ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as (r & I2 & Br).
  unfold add, rounded. cbn [hi lo error]. split.
  - exists p, q, r. split; [exact P|]. split; [exact Q|]. split; [exact I2|]. split; [|split; [lra|split; [exact Bq|exact Br]]].
    replace (p + q - (x + x')) with ((p + q - (h + l + (h' + l'))) + (h + l - x) + (h' + l' - x')) by ring.
    absolute_values. apply Rabs_le. lra.
  - intros Hx HLx. exists p, q. split; [exact P|]. split; [exact Q|]. absolute_values. apply T; [lra|].
    replace (h + h') with ((x + x') + (h + l - x) + (h' + l' - x') - (l + l')) by ring. lra.
Qed.

(* A product: its first terms have the product M at most. *)
Lemma is_off_multiply : forall a b x e m c g x' e' m' c' g' M G, is_off a x e m c g -> is_off b x' e' m' c' g' ->
  c <= 101 / 100 * (unit53 * m) -> c' <= 101 / 100 * (unit53 * m') -> M = m * m' ->
  / 1000000000000000000000000 <= M <= 1000 -> m <= 1000 -> m' <= 1000 -> / 10 * m <= Rabs x -> / 10 * m' <= Rabs x' ->
  e <= / 1000 * Rabs x -> e' <= / 1000 * Rabs x' -> m * g' + m' * g + g * g' <= G -> G <= 100 ->
  is_off (multiply a b) (x * x') (101 / 100 * (m' * e) + Rabs x * e' + 7 * (unit53 * (unit53 * M))) (101 / 100 * M)
    (101 / 100 * (unit53 * M)) (3 * G + / 500000000000 * M).
Proof.
  intros a b x e m c g x' e' m' c' g' M G (h & l & k & H & L1 & K & E & Bh & Bl & Bk) (h' & l' & k' & H' & L' & K' & E' & Bh' & Bl' & Bk')
    Hc Hc' HM HM2 Hm Hm' Hx Hx' He He' HG HG2. pose proof tiny_is_tiny as Htiny. pose proof unit_is_small as Hu.
  pose proof (Rabs_pos x) as Px. pose proof (Rabs_pos x') as Px'. pose proof (Rabs_pos h) as Ph. pose proof (Rabs_pos h') as Ph'.
  pose proof (unit_times m ltac:(lra)) as Um. pose proof (unit_times m' ltac:(lra)) as Um'.
  pose proof (size_by x (h + l)) as S1. rewrite (Rabs_minus_sym x) in S1. pose proof (Rabs_triang h l) as S2.
  pose proof (size_by x' (h' + l')) as S1'. rewrite (Rabs_minus_sym x') in S1'. pose proof (Rabs_triang h' l') as S2'.
  subst M. set (M := m * m') in *.
  assert (Low : / 1000 * M <= Rabs (h * h')).
  { rewrite Rabs_mult. unfold M in *. apply Rle_trans with (/ 15 * m * (/ 15 * m')); [lra|]. apply Rmult_le_compat; lra. }
  destruct (product_of_is_off _ _ _ _ h l h' l' m m' H L1 H' L' Bh Bh' ltac:(lra) ltac:(lra) ltac:(fold M; lra) Low) as
    (p & q & P & Q & Epq & Bp & Bq).
  fold M in Epq, Bp, Bq.
  assert (one : forall a A, 0 <= a <= A -> A <= 1000 -> 0 <= nearest64 a <= 100001 / 100000 * A + tiny /\ not_too_large a).
  { intros a0 A Ha HA. split; [pose proof (rounded_up a0 A Ha); pose proof (unit_times A ltac:(lra)); lra|].
    apply big_enough. rewrite Rabs_pos_eq; lra. }
  assert (Q1 : 0 <= Rabs h * k' <= m * g') by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
  assert (Q2 : 0 <= Rabs h' * k <= m' * g) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
  assert (Q3 : 0 <= k * k' <= g * g') by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
  destruct (one _ _ Q1 ltac:(lra)) as [N1 M1]. destruct (one _ _ Q2 ltac:(lra)) as [N2 M2]. destruct (one _ _ Q3 ltac:(lra)) as [N3 M3].
  pose proof (times_is _ _ _ _ (absolute_is _ _ H) K' M1) as J1. pose proof (times_is _ _ _ _ (absolute_is _ _ H') K M2) as J2.
  pose proof (times_is _ _ _ _ K K' M3) as J3.
  assert (B4 : 0 <= nearest64 (Rabs h * k') + nearest64 (Rabs h' * k) <= 100001 / 100000 * (m * g' + m' * g) + 2 * tiny) by lra.
  destruct (one _ _ B4 ltac:(lra)) as [N4 M4].
  pose proof (plus_is _ _ _ _ J1 J2 M4) as J4.
  set (v4 := nearest64 (nearest64 _ + nearest64 _)) in *.
  assert (B5 : 0 <= v4 + nearest64 (k * k') <= 10001 / 10000 * G + 6 * tiny) by lra.
  destruct (one _ _ B5 ltac:(lra)) as [N5 M5].
  pose proof (plus_is _ _ _ _ J4 J3 M5) as J5.
  destruct (error_is_small _ p _ _ G (101 / 100 * M) P J5 ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as (r & I & Br).
  unfold multiply, rounded. cbn [hi lo error]. exists p, q, r. split; [exact P|]. split; [exact Q|]. split; [exact I|].
  split; [|split; [lra|split; [exact Bq|lra]]].
  replace (p + q - x * x') with ((p + q - (h + l) * (h' + l')) + ((h + l - x) * (h' + l') + x * (h' + l' - x'))) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _).
  pose proof (Rabs_triang ((h + l - x) * (h' + l')) (x * (h' + l' - x'))) as T.
  assert (T1 : Rabs ((h + l - x) * (h' + l')) <= e * (101 / 100 * m')) by (apply product_size; lra).
  assert (T2 : Rabs (x * (h' + l' - x')) <= Rabs x * e') by (apply product_size; lra). lra.
Qed.

(* A quotient: numerator and divisor have terms that are Q times as large at most, and the divisor's error is small. *)
Lemma is_off_divide : forall a b x e m c g x' e' m' c' g' d Q E, is_off a x e m c g -> is_off b x' e' m' c' g' ->
  / 10000000000 <= d -> d <= Rabs x' - e' - c' -> m' <= 1000 -> c' <= 2 * (unit53 * d) -> g' <= / 2 * d ->
  m <= Q * d -> c <= Q * d -> / 1000000000000000000000000000000000000 <= Q * d -> Q <= 1000 ->
  Rabs (x / x') <= Q -> g + 3 * Q * g' <= E * d -> E <= 10 -> / 100000000000000000000 <= E -> d <= 1000 ->
  is_off (divide a b) (x / x') (102 / 100 * (e + Q * e') / d + 20 * (unit53 * Q)) (3 * Q) (5 * (unit53 * Q))
    (10 * E + 4 / 1000000000000 * Q).
Proof.
  intros a b x e m c g x' e' m' c' g' d Q E (h & l & k & H & L1 & K & Eh & Bh & Bl & Bk)
    (h' & l' & k' & H' & L' & K' & Eh' & Bh' & Bl' & Bk')
    Hd Hdx Hm' Hc' Hg' Hm Hc HQd HQ HxQ HE HE2 HE3 Hd2. pose proof tiny_is_tiny as Htiny. pose proof unit_is_small as Hu.
  pose proof (size_by x' (h' + l')) as S1. rewrite (Rabs_minus_sym x') in S1. pose proof (Rabs_triang h' l') as S2.
  assert (Hdh : d <= Rabs h') by lra. assert (HQ0 : 0 < Q) by (apply Rmult_lt_reg_r with d; lra).
  assert (HQh : Q * d <= Q * Rabs h') by (apply Rmult_le_compat_l; lra).
  assert (Uh : unit53 * d <= unit53 * Rabs h') by (apply unit_times_compat; lra).
  destruct (quotient_of_is_off (hi a) (lo a) (hi b) (lo b) h l h' l' Q H L1 H' L' ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) HQ)
    as (p & q & P & Qt & Epq & Bp & Bq).
  (* the divisor is not 0 *)
  pose proof (constant_is (2 ^ 50 - 1) (-50) ltac:(lia) ltac:(lia)) as Ik. fold almost_one in Ik. set (j := IZR _ * _) in Ik.
  assert (Hj : 999 / 1000 <= j <= 1) by (unfold j; simpl; lra). clearbody j.
  pose proof (absolute_is _ _ H') as Ah. set (ah := Rabs h') in *.
  assert (Hhj : 999 / 1000 * ah <= ah * j <= ah).
  { split; [rewrite (Rmult_comm ah j); apply Rmult_le_compat_r; lra|]. rewrite <- (Rmult_1_r ah) at 2. apply Rmult_le_compat_l; lra. }
  pose proof (times_is _ _ _ _ Ah Ik ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as I1.
  assert (close : forall b0, 0 <= b0 <= 1000000 -> 999 / 1000 * b0 - tiny <= nearest64 b0 <= 1001 / 1000 * b0 + tiny).
  { intros b0 Hb. pose proof (product_is_close b0) as C. rewrite (Rabs_pos_eq b0) in C by lra. apply Rabs_le_inv in C.
    assert (unit53 * b0 <= / 1000 * b0) by (apply Rmult_le_compat_r; lra). lra. }
  assert (Td : tiny <= / 1000 * d).
  { assert (Q * d <= 1000 * d) by (apply Rmult_le_compat_r; lra). lra. }
  pose proof (close (ah * j) ltac:(lra)) as C1.
  pose proof (minus_is _ _ _ _ I1 K' ltac:(apply big_enough, Rabs_le; lra)) as I2.
  pose proof (close (nearest64 (ah * j) - k') ltac:(lra)) as C2. set (size := nearest64 (nearest64 (ah * j) - k')) in *.
  assert (Hsize : 48 / 100 * d <= size <= 2 * ah) by lra.
  unfold divide. cbn [hi lo error]. cbv zeta.
  rewrite (less_is _ _ _ _ zero_is I2), Rlt_bool_true by lra. cbn [negb]. unfold rounded. cbn [hi lo].
  (* the bound of the error *)
  pose proof (Rabs_pos p) as Pp.
  assert (Q1 : 0 <= Rabs p * k' <= 3 * Q * g') by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
  assert (Ed : E * d <= 10 * 1000) by (apply Rmult_le_compat; lra).
  pose proof (times_is _ _ _ _ (absolute_is _ _ P) K' ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J1.
  pose proof (close (Rabs p * k') ltac:(lra)) as D1.
  assert (P1 : 0 <= nearest64 (Rabs p * k')) by (apply (rounded_up _ _ (conj (proj1 Q1) (Rle_refl _)))).
  pose proof (plus_is _ _ _ _ K J1 ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J2.
  pose proof (close (k + nearest64 (Rabs p * k')) ltac:(lra)) as D2.
  assert (P2 : 0 <= nearest64 (k + nearest64 (Rabs p * k'))).
  { apply (rounded_up _ (k + nearest64 (Rabs p * k'))). lra. }
  set (num := nearest64 (k + nearest64 (Rabs p * k'))) in *.
  assert (TEd : tiny <= / 1000 * (E * d)).
  { assert (/ 100000000000000000000 * / 10000000000 <= E * d) by (apply Rmult_le_compat; lra). lra. }
  assert (Hnum : num <= 101 / 100 * (E * d)) by lra.
  assert (Hq : 0 <= num / size <= 3 * E).
  { split; [apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]|]. apply Rmult_le_reg_r with size; [lra|].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. apply Rle_trans with (1 := Hnum).
    apply Rle_trans with (3 * E * (48 / 100 * d)); [assert (0 <= E * d) by (apply Rmult_le_pos; lra); lra|apply Rmult_le_compat_l; lra]. }
  pose proof (over_is _ _ _ _ J2 I2 ltac:(lra) ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J3.
  assert (D3 : 0 <= nearest64 (num / size) <= 1001 / 1000 * (3 * E) + 9 * tiny).
  { pose proof (rounded_up _ _ Hq). pose proof (unit_times (3 * E) ltac:(lra)). lra. }
  assert (Qlow : / 1000000000000000000000000000000000000000 <= Q).
  { assert (Q * d <= Q * 1000) by (apply Rmult_le_compat_l; lra). lra. }
  destruct (error_is_small _ p _ _ (3 * E) (3 * Q) P J3 D3 ltac:(lra) Bp ltac:(lra)) as (r & G1 & G2).
  exists p, q, r. split; [exact P|]. split; [exact Qt|]. split; [exact G1|]. split; [|split; [exact Bp|split; [exact Bq|lra]]].
  (* the quotient of what is held, and of what is meant *)
  pose proof (Rabs_pos (h' + l' - x')) as Pe. pose proof (Rabs_pos l') as Pl'.
  assert (Hx0 : x' <> 0) by (intro X; assert (Rabs x' = 0) by (now rewrite X, Rabs_R0); lra).
  pose proof (size_by h' (h' + l')) as S3. replace (h' - (h' + l')) with (- l') in S3 by ring. rewrite Rabs_Ropp in S3. fold ah in S3.
  set (v := h' + l') in *. assert (Hv : 99 / 100 * d <= Rabs v) by (pose proof (unit_times d ltac:(lra)); lra).
  assert (Hv0 : v <> 0) by (intro X; rewrite X, Rabs_R0 in Hv; lra).
  assert (Z : Rabs ((h + l) / v - x / x') <= 102 / 100 * (e + Q * e') / d).
  { replace ((h + l) / v - x / x') with (((h + l - x) - x / x' * (v - x')) / v) by (field; split; assumption).
    apply quotient_size; [lra|]. apply Rle_trans with (1 := minus_size _ _).
    pose proof (product_size _ _ _ _ HxQ Eh') as T.
    assert (0 <= e + Q * e').
    { pose proof (Rabs_pos (h + l - x)). pose proof (Rabs_pos (v - x')). pose proof (Rmult_le_pos Q e' ltac:(lra) ltac:(lra)). lra. }
    apply Rle_trans with (e + Q * e'); [lra|]. apply Rle_trans with (102 / 100 * (e + Q * e') / d * (99 / 100 * d)).
    - replace (102 / 100 * (e + Q * e') / d * (99 / 100 * d)) with (10098 / 10000 * (e + Q * e')) by (field; lra). lra.
    - apply Rmult_le_compat_l; [|lra]. apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]. }
  replace (p + q - x / x') with ((p + q - (h + l) / v) + ((h + l) / v - x / x')) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.
