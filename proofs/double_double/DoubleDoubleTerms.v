(* SPDX-License-Identifier: BSD-3-Clause *)
(* Double-double where terms cancel: sums, products and quotients of either sign, how far they are off in absolute numbers. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Plus_error Relative.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds.
Open Scope R_scope.

Lemma unit_times : forall a, 0 <= a -> 0 <= unit53 * a <= / 1000000000000 * a.
Proof. intros a Ha. pose proof unit_is_small. split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]. Qed.

Lemma unit_times_compat : forall a b, a <= b -> unit53 * a <= unit53 * b.
Proof. intros a b H. pose proof unit_is_small. apply Rmult_le_compat_l; lra. Qed.

(* One operation more: how large its result is, and how far off. *)
Lemma plus_close : forall v w a b, is64 v a -> is64 w b -> Rabs a + Rabs b <=
  10000000000000000000000000000000000000000000000000000000000000000000000 ->
  is64 (plus v w) (nearest64 (a + b)) /\ Rabs (nearest64 (a + b) - (a + b)) <= unit53 * Rabs (a + b).
Proof.
  intros v w a b Hv Hw H. split; [|apply sum_is_close; eapply format_of; eassumption]. apply plus_is; try assumption.
  apply big_enough. apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

Lemma minus_close : forall v w a b, is64 v a -> is64 w b -> Rabs a + Rabs b <=
  10000000000000000000000000000000000000000000000000000000000000000000000 ->
  is64 (minus v w) (nearest64 (a - b)) /\ Rabs (nearest64 (a - b) - (a - b)) <= unit53 * Rabs (a - b).
Proof.
  intros v w a b Hv Hw H. split; [|apply difference_is_close; eapply format_of; eassumption]. apply minus_is; try assumption.
  apply big_enough. unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra.
Qed.

(* |a| <= |b| + |a - b| *)
Lemma size_by : forall a b, Rabs a <= Rabs b + Rabs (a - b).
Proof. intros a b. replace a with (b + (a - b)) at 1 by ring. apply Rabs_triang. Qed.

Lemma minus_size : forall a b, Rabs (a - b) <= Rabs a + Rabs b.
Proof. intros a b. unfold Rminus. rewrite <- (Rabs_Ropp b). apply Rabs_triang. Qed.

Lemma nothing_off : forall a b, a = b -> Rabs (a - b) = 0.
Proof. intros a b ->. now rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. Qed.

(* fast_two_sum, also where the second number is the larger. *)
Lemma fast_two_sum_terms : forall r q x y, is64 r x -> is64 q y ->
  Rabs x <= 1000000000000000000000000000000000000000000000000000000000000 ->
  Rabs y <= 1000000000000000000000000000000000000000000000000000000000000 ->
  exists s z, is64 (plus r q) s /\ is64 (minus q (minus (plus r q) r)) z /\ s = nearest64 (x + y) /\
    Rabs (s - (x + y)) <= unit53 * Rabs (x + y) /\ Rabs z <= unit53 * Rabs (x + y) + 11 / 10 * (unit53 * Rabs y) /\
    ((Rabs y <= Rabs x /\ s + z = x + y) \/ (Rabs x < Rabs y /\ Rabs (s + z - (x + y)) <= 101 / 100 * (unit53 * Rabs y))).
Proof.
  intros r q x y Hr Hq Bx By. pose proof unit_is_small as Hu. pose proof (Rabs_triang x y) as T. pose proof (Rabs_pos (x + y)) as P.
  pose proof (Rabs_pos y) as Py.
  destruct (plus_close _ _ _ _ Hr Hq ltac:(lra)) as [Is Cs]. set (s := nearest64 (x + y)) in *.
  pose proof (unit_times _ P) as UA. pose proof (unit_times _ Py) as UW. pose proof (size_by s (x + y)) as Ss.
  destruct (minus_close _ _ _ _ Is Hr ltac:(lra)) as [Id Cd]. set (d := nearest64 (s - x)) in *.
  assert (Sx : Rabs (s - x) <= Rabs y + unit53 * Rabs (x + y)).
  { replace (s - x) with (y + (s - (x + y))) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  pose proof (unit_times_compat _ _ Sx) as USx. pose proof (unit_times _ (Rabs_pos (s - x))) as USx2.
  pose proof (size_by d (s - x)) as Sd.
  destruct (minus_close _ _ _ _ Hq Id ltac:(lra)) as [Iz Cz]. set (z := nearest64 (y - d)) in *.
  exists s, z. split; [exact Is|]. split; [exact Iz|]. split; [reflexivity|]. split; [exact Cs|].
  destruct (Rle_or_lt (Rabs y) (Rabs x)) as [L|L].
  - pose proof (fast_two_sum_is_exact x y (format_of _ _ Hr) (format_of _ _ Hq) (or_introl L)) as E. cbv zeta in E. fold s d z in E.
    split; [|left; now split]. replace z with (- (s - (x + y))) by lra. rewrite Rabs_Ropp. lra.
  - assert (Sy : Rabs (y - d) <= unit53 * Rabs (x + y) + unit53 * (Rabs y + unit53 * Rabs (x + y))).
    { replace (y - d) with (- (s - (x + y)) - (d - (s - x))) by ring. apply Rle_trans with (1 := minus_size _ _). rewrite Rabs_Ropp. lra. }
    pose proof (unit_times _ (Rabs_pos (y - d))) as USy. pose proof (size_by z (y - d)) as Sz.
    assert (UA2 : unit53 * Rabs (x + y) <= unit53 * (2 * Rabs y)) by (apply unit_times_compat; lra).
    pose proof (unit_times _ (proj1 UA)) as UUA. split; [lra|right]. split; [exact L|].
    replace (s + z - (x + y)) with ((z - (y - d)) - (d - (s - x))) by ring. apply Rle_trans with (1 := minus_size _ _).
    assert (Rabs (z - (y - d)) <= / 1000 * (unit53 * Rabs y)); [|lra].
    apply Rle_trans with (1 := Cz). apply Rle_trans with (1 := unit_times_compat _ _ Sy).
    pose proof (unit_times _ (proj1 UW)) as UUW. pose proof (unit_times _ (proj1 UUA)) as UUUA.
    assert (unit53 * (unit53 * Rabs (x + y)) <= unit53 * (unit53 * (2 * Rabs y))) by (apply unit_times_compat, unit_times_compat; lra).
    lra.
Qed.

(* two_sum *)
Lemma two_sum_terms : forall a b x y, is64 a x -> is64 b y -> Rabs x <= 100000000000000000000000000000000000000000000000000 ->
  Rabs y <= 100000000000000000000000000000000000000000000000000 ->
  let t1 := plus a b in let t2 := minus t1 a in let t3 := minus t1 t2 in
  exists s, is64 t1 s /\ is64 (plus (minus a t3) (minus b t2)) (x + y - s) /\ Rabs (x + y - s) <= unit53 * Rabs (x + y).
Proof.
  intros a b x y Ha Hb Bx By t1 t2 t3. pose proof (two_sum_is_exact x y (format_of _ _ Ha) (format_of _ _ Hb)) as E. cbv zeta in E.
  pose proof (Rabs_triang x y) as T.
  destruct (plus_close _ _ _ _ Ha Hb ltac:(lra)) as [I1 C1]. fold t1 in I1. set (s := nearest64 (x + y)) in *.
  pose proof (unit_times _ (Rabs_pos (x + y))) as U1. pose proof (size_by s (x + y)) as S1.
  destruct (minus_close _ _ _ _ I1 Ha ltac:(lra)) as [I2 C2]. fold t2 in I2. set (t := nearest64 (s - x)) in *.
  pose proof (unit_times _ (Rabs_pos (s - x))) as U2. pose proof (size_by t (s - x)) as S2. pose proof (minus_size s x) as M2.
  destruct (minus_close _ _ _ _ I1 I2 ltac:(lra)) as [I3 C3]. fold t3 in I3. set (p := nearest64 (s - t)) in *.
  pose proof (unit_times _ (Rabs_pos (s - t))) as U3. pose proof (size_by p (s - t)) as S3. pose proof (minus_size s t) as M3.
  destruct (minus_close _ _ _ _ Ha I3 ltac:(lra)) as [I4 C4]. set (q := nearest64 (x - p)) in *.
  pose proof (unit_times _ (Rabs_pos (x - p))) as U4. pose proof (size_by q (x - p)) as S4. pose proof (minus_size x p) as M4.
  destruct (minus_close _ _ _ _ Hb I2 ltac:(lra)) as [I5 C5]. set (r := nearest64 (y - t)) in *.
  pose proof (unit_times _ (Rabs_pos (y - t))) as U5. pose proof (size_by r (y - t)) as S5. pose proof (minus_size y t) as M5.
  destruct (plus_close _ _ _ _ I4 I5 ltac:(lra)) as [I6 _].
  exists s. split; [exact I1|]. split; [|rewrite Rabs_minus_sym; exact C1].
  replace (x + y - s) with (nearest64 (q + r)) by lra. exact I6.
Qed.

(* What rounding a sum takes, as a share of the result, however small that is. *)
Lemma sum_rest : forall v w, in_binary64 v -> in_binary64 w -> Rabs (v + w - nearest64 (v + w)) <= unit53 * Rabs (nearest64 (v + w)).
Proof.
  intros v w Gv Gw. destruct (FLT_plus_error_N_round_ex radix2 (-1074) 53 (fun n => negb (Z.even n)) v w Gv Gw) as (eps & He & E).
  change (round radix2 (FLT_exp (-1074) 53) (Znearest (fun n => negb (Z.even n))) (v + w)) with (nearest64 (v + w)) in E.
  rewrite E at 1. replace (nearest64 (v + w) * (1 + eps) - nearest64 (v + w)) with (nearest64 (v + w) * eps) by ring.
  rewrite Rabs_mult, (Rmult_comm unit53). apply Rmult_le_compat_l; [apply Rabs_pos|].
  replace unit53 with (u_ro radix2 53) by (unfold u_ro, unit53; simpl; lra). exact He.
Qed.

(* x + l and h + k, of which x and h may cancel; together the small terms are no larger than L. *)
Lemma sum_of_cancels : forall a a_lo b b_lo x l h k L, let S := Rabs (x + h) in is64 a x -> is64 a_lo l -> is64 b h -> is64 b_lo k ->
  Rabs x <= 10000000000 -> Rabs h <= 10000000000 -> Rabs l + Rabs k <= L -> L <= 1000 ->
  exists p q, is64 (fst (sum_of a a_lo b b_lo)) p /\ is64 (snd (sum_of a a_lo b b_lo)) q /\
    Rabs (p + q - (x + l + (h + k))) <= 21 / 10 * unit53 * (unit53 * S + L) /\ Rabs p <= 11 / 10 * (S + L) /\
    Rabs q <= unit53 * (11 / 10 * S + 5 * L) /\
    (L <= / 1000000 * S -> Rabs q <= unit53 * Rabs p) /\
    (/ 100000000000000000000 <= x + h -> L <= / 1000000 * (x + h) -> Rabs q <= unit53 * p).
Proof.
  intros a a_lo b b_lo x l h k L S Ha Hal Hb Hbl Bx Bh HL HL2. pose proof unit_is_small as Hu. pose proof (Rabs_triang x h) as HS2.
  pose proof (Rabs_pos l) as Pl. pose proof (Rabs_pos k) as Pk. pose proof (Rabs_pos (x + h)) as Ps. pose proof (Rabs_triang l k) as Tlk.
  fold S in HS2, Ps.
  unfold sum_of. cbv zeta. cbn [fst snd].
  destruct (two_sum_terms _ _ _ _ Ha Hb ltac:(lra) ltac:(lra)) as (s & I1 & I6 & C1). cbv zeta in I6.
  destruct (two_sum_terms _ _ _ _ Hal Hbl ltac:(lra) ltac:(lra)) as (t & I7 & I14 & C2). cbv zeta in I14.
  set (t1 := plus a b) in *. set (t6 := plus (minus a _) (minus b _)) in *. set (t7 := plus a_lo b_lo) in *.
  set (t14 := plus (minus a_lo _) (minus b_lo _)) in *. set (sl := x + h - s) in *. set (tl := l + k - t) in *.
  set (US := unit53 * S). set (UL := unit53 * L).
  pose proof (unit_times S ltac:(lra)) as BS. pose proof (unit_times L ltac:(lra)) as BL. fold US in BS. fold UL in BL.
  assert (EUS : unit53 * S = US) by reflexivity. assert (EUL : unit53 * L = UL) by reflexivity.
  pose proof (unit_times _ (proj1 BS)) as BUS. pose proof (unit_times _ (proj1 BL)) as BUL.
  assert (Csl : Rabs sl <= US) by exact C1.
  assert (Ctl : Rabs tl <= UL) by (apply Rle_trans with (1 := C2); apply unit_times_compat; lra).
  assert (Bt : Rabs t <= L + UL).
  { replace t with (l + k - tl) by (unfold tl; ring). apply Rle_trans with (1 := minus_size _ _). lra. }
  assert (Bs : Rabs s <= S + US).
  { replace s with (x + h - sl) by (unfold sl; ring). apply Rle_trans with (1 := minus_size _ _). fold S. lra. }
  pose proof (Rabs_triang sl t) as Tc.
  destruct (plus_close _ _ _ _ I6 I7 ltac:(lra)) as [I8 C8]. set (t8 := plus t6 t7) in *. set (c := nearest64 (sl + t)) in *.
  assert (C8' : Rabs (c - (sl + t)) <= unit53 * (US + L + UL)) by (apply Rle_trans with (1 := C8); apply unit_times_compat; lra).
  pose proof (size_by c (sl + t)) as Sc.
  assert (Bc : Rabs c <= 1001 / 1000 * (US + L)) by lra.
  pose proof (unit_times_compat _ _ Bc) as UBc.
  destruct (fast_two_sum_terms t1 t8 s c I1 I8 ltac:(lra) ltac:(lra)) as (v & vl & I9 & I16 & Ev & Cv & Bvl & Dv).
  pose proof (Rabs_triang s c) as Tsc.
  set (t9 := plus t1 t8) in *. set (t16 := minus t8 (minus t9 t1)) in *.
  assert (Usc : unit53 * Rabs (s + c) <= unit53 * (S + US + Rabs c)) by (apply unit_times_compat; lra).
  assert (Bvl2 : Rabs vl <= 1001 / 1000 * US + 22 / 10 * UL) by (unfold US, UL in *; lra).
  pose proof (Rabs_triang tl vl) as Tw.
  destruct (plus_close _ _ _ _ I14 I16 ltac:(lra)) as [I17 C17]. set (t17 := plus t14 t16) in *. set (w := nearest64 (tl + vl)) in *.
  assert (C17' : Rabs (w - (tl + vl)) <= unit53 * (1001 / 1000 * US + 32 / 10 * UL)) by (apply Rle_trans with (1 := C17);
    apply unit_times_compat; lra).
  pose proof (size_by w (tl + vl)) as Sw. assert (Bw : Rabs w <= 1002 / 1000 * US + 33 / 10 * UL) by lra.
  pose proof (unit_times_compat _ _ Bw) as UBw. pose proof (size_by v (s + c)) as Sv.
  assert (Bv : Rabs v <= 1001 / 1000 * (S + L)) by lra.
  destruct (fast_two_sum_terms t9 t17 v w I9 I17 ltac:(lra) ltac:(lra)) as (p & q & I18 & I20 & Ep & Cp & Bq & Dp).
  exists p, q. split; [exact I18|]. split; [exact I20|].
  pose proof (Rabs_triang v w) as Tvw. pose proof (size_by p (v + w)) as Sp.
  assert (Uvw : unit53 * Rabs (v + w) <= unit53 * (1001 / 1000 * (S + L) + (1002 / 1000 * US + 33 / 10 * UL))) by
    (apply unit_times_compat; lra).
  pose proof (unit_times _ (Rabs_pos (v + w))) as Uvw2.
  split; [|split; [lra|split; [unfold US, UL in *; lra|split]]].
  - replace (p + q - (x + l + (h + k))) with ((p + q - (v + w)) + (w - (tl + vl)) + (v + vl - (s + c)) + (c - (sl + t)))
      by (unfold sl, tl; ring).
    assert (Fin : Rabs (p + q - (v + w)) + Rabs (v + vl - (s + c)) <= 103 / 100 * UL).
    { destruct Dv as [[Hcs Hv]|[Hcs Hv]].
      - rewrite (nothing_off _ _ Hv), Rplus_0_r.
        destruct Dp as [[_ Hp]|[Hvw Hp]]; [rewrite (nothing_off _ _ Hp); lra|].
        assert (Rabs vl <= unit53 * Rabs (s + c)) by (replace vl with (- (v - (s + c))) by lra; now rewrite Rabs_Ropp).
        pose proof (size_by (s + c) v) as Z. rewrite (Rabs_minus_sym (s + c)) in Z.
        pose proof (unit_times _ (Rabs_pos (s + c))) as Z2. pose proof (unit_times _ (Rabs_pos (tl + vl))) as Z3.
        assert (Rabs w <= 11 / 10 * UL) by lra. pose proof (unit_times _ (Rabs_pos w)) as Z4. lra.
      - assert (HS : S <= 11 / 10 * L).
        { assert (S <= Rabs s + US); [|lra]. unfold S. replace (x + h) with (s + sl) by (unfold sl; ring).
          apply Rle_trans with (1 := Rabs_triang _ _). lra. }
        assert (US <= 11 / 10 * UL) by (unfold US, UL; pose proof (unit_times_compat _ _ HS); lra).
        assert (Rabs (p + q - (v + w)) <= / 1000 * UL).
        { destruct Dp as [[_ Hp]|[Hvw Hp]]; [rewrite (nothing_off _ _ Hp); lra|lra]. }
        assert (unit53 * (1001 / 1000 * (US + L)) <= 10011 / 10000 * UL).
        { unfold UL. replace (10011 / 10000 * (unit53 * L)) with (unit53 * (10011 / 10000 * L)) by ring. apply unit_times_compat. lra. }
        lra. }
    apply Rle_trans with (1 := Rabs_triang _ _). pose proof (Rabs_triang (p + q - (v + w) + (w - (tl + vl))) (v + vl - (s + c))) as R1.
    pose proof (Rabs_triang (p + q - (v + w)) (w - (tl + vl))) as R2. unfold US, UL in *. lra.
  - intro HLlow. assert (Hs : S <= Rabs s + US).
    { unfold S at 1. replace (x + h) with (s + sl) by (unfold sl; ring). apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    pose proof (size_by s (s + c)) as S1. replace (s - (s + c)) with (- c) in S1 by ring. rewrite Rabs_Ropp in S1.
    pose proof (size_by (s + c) v) as S2. rewrite (Rabs_minus_sym (s + c)) in S2. pose proof (unit_times _ (Rabs_pos (s + c))) as S3.
    destruct Dp as [[_ Hp]|[Hvw _]]; [|exfalso; lra].
    replace q with (v + w - p) by lra. rewrite Ep. apply sum_rest; [now apply format_of in I9|now apply format_of in I17].
  - intros Hlow HLlow. assert (HSx : S = x + h) by (apply Rabs_pos_eq; lra). rewrite <- HSx in *.
    assert (Hs : 999 / 1000 * S <= Rabs s).
    { assert (S <= Rabs s + US); [|lra]. unfold S at 1. replace (x + h) with (s + sl) by (unfold sl; ring).
      apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    assert (Hsx : s = x + h - sl) by (unfold sl; ring). rewrite <- HSx in Hsx. absolute_values.
    assert (Hv : 99 / 100 * S <= v) by (apply Rle_trans with (s + c - / 1000 * S); [lra|lra]).
    destruct Dp as [[_ Hp]|[Hvw _]]; [|exfalso; rewrite (Rabs_pos_eq v) in Hvw by lra; revert Hvw; apply Rle_not_lt, Rabs_le; lra].
    replace q with (v + w - p) by lra. rewrite Ep. apply rounding_tail. rewrite <- Ep. lra.
Qed.

Lemma sum_of_is_off : forall a a_lo b b_lo x l h k S L, is64 a x -> is64 a_lo l -> is64 b h -> is64 b_lo k ->
  Rabs x <= 10000000000 -> Rabs h <= 10000000000 -> Rabs (x + h) <= S -> Rabs l + Rabs k <= L -> L <= 1000 ->
  exists p q, is64 (fst (sum_of a a_lo b b_lo)) p /\ is64 (snd (sum_of a a_lo b b_lo)) q /\
    Rabs (p + q - (x + l + (h + k))) <= 21 / 10 * unit53 * (unit53 * S + L) /\ Rabs p <= 11 / 10 * (S + L) /\
    Rabs q <= unit53 * (11 / 10 * S + 5 * L) /\
    (L <= / 1000000 * Rabs (x + h) -> Rabs q <= unit53 * Rabs p) /\
    (/ 100000000000000000000 <= x + h -> L <= / 1000000 * (x + h) -> Rabs q <= unit53 * p).
Proof.
  intros a a_lo b b_lo x l h k S L Ha Hal Hb Hbl Bx Bh HS HL HL2. pose proof unit_is_small as Hu.
  destruct (sum_of_cancels a a_lo b b_lo x l h k L Ha Hal Hb Hbl Bx Bh HL HL2) as (p & q & Ip & Iq & E & Bp & Bq & T).
  pose proof (unit_times_compat _ _ HS) as U. pose proof (unit_times_compat _ _ U) as UU.
  exists p, q. repeat (split; [assumption|]). split; [lra|]. split; [lra|]. split; [|exact T].
  lra.
Qed.

(* ---- Products ---- *)

Lemma times_close : forall v w a b, is64 v a -> is64 w b -> Rabs (a * b) <=
  10000000000000000000000000000000000000000000000000000000000000000000000 ->
  is64 (times v w) (nearest64 (a * b)) /\ Rabs (nearest64 (a * b) - a * b) <= unit53 * Rabs (a * b) + tiny.
Proof. intros v w a b Hv Hw H. split; [|apply product_is_close]. apply times_is; try assumption. apply big_enough. lra. Qed.

Lemma fused_close : forall t v w a b c, is64 t a -> is64 v b -> is64 w c ->
  Rabs (a * b + c) <= 10000000000000000000000000000000000000000000000000000000000000000000000 ->
  is64 (fused t v w) (nearest64 (a * b + c)) /\ Rabs (nearest64 (a * b + c) - (a * b + c)) <= unit53 * Rabs (a * b + c) + tiny.
Proof. intros t v w a b c Ht Hv Hw H. split; [|apply product_is_close]. apply fused_is; try assumption. apply big_enough. lra. Qed.

Lemma product_size : forall a b A B, Rabs a <= A -> Rabs b <= B -> Rabs (a * b) <= A * B.
Proof. intros a b A B Ha Hb. rewrite Rabs_mult. apply Rmult_le_compat; try apply Rabs_pos; assumption. Qed.

(* What rounding takes, as a share of the result. *)
Lemma rounding_rest : forall x, /
  100000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000 <= Rabs (nearest64 x) ->
  Rabs (x - nearest64 x) <= unit53 * Rabs (nearest64 x).
Proof.
  intros x Hx. rewrite Rabs_minus_sym. pose proof (error_le_half_ulp_round radix2 fexp64 (fun n => negb (Z.even n)) x) as U.
  pose proof (ulp_FLT_le radix2 (-1074) 53 (nearest64 x)) as V. change (bpow radix2 (1 - 53)) with (/ 4503599627370496) in V.
  assert (bpow radix2 (-1074 + 53 - 1) <= Rabs (nearest64 x)).
  { apply Rle_trans with (bpow radix2 (-500)); [apply bpow_le; lia|]. apply Rle_trans with (2 := Hx). simpl. lra. }
  specialize (V H). change (Znearest (fun n => negb (Z.even n))) with ZnearestE in U. unfold unit53. lra.
Qed.

Lemma product_of_parts : forall a a_lo b b_lo h l c k H K, let M := H * K in is64 a h -> is64 a_lo l -> is64 b c -> is64 b_lo k ->
  Rabs h <= H -> Rabs c <= K -> Rabs l <= 101 / 100 * (unit53 * H) -> Rabs k <= 101 / 100 * (unit53 * K) ->
  / 10000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000 <= M <= 1000000000000 ->
      / 1000 * M <= Rabs (h * c) ->
  exists p q, is64 (fst (product_of a a_lo b b_lo)) p /\ is64 (snd (product_of a a_lo b b_lo)) q /\
    Rabs (p + q - (h + l) * (c + k)) <= 7 * (unit53 * (unit53 * M)) /\ Rabs p <= 101 / 100 * M /\ Rabs q <= 101 / 100 * (unit53 * M) /\
    Rabs q <= unit53 * Rabs p.
Proof.
  intros a a_lo b b_lo h l c k H K M Ha Hl Hb Hk Bh Bc Bl Bk HM Hlow. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  pose proof (format_of _ _ Ha) as Gh. pose proof (format_of _ _ Hb) as Gc.
  set (m := h * c) in *. set (um := unit53 * M). assert (Eum : unit53 * M = um) by reflexivity.
  pose proof (unit_times M ltac:(lra)) as Hum. fold um in Hum. pose proof (unit_times um ltac:(lra)) as Uum.
  assert (Htum : tiny <= / 1000 * (unit53 * um)) by (unfold um, unit53; lra).
  pose proof (product_size _ _ _ _ Bh Bc) as Bm. fold m M in Bm.
  destruct (times_close _ _ _ _ Ha Hb ltac:(fold m; lra)) as [I1 C1]. fold m in I1, C1. set (p0 := nearest64 m) in *.
  pose proof (unit_times_compat _ _ Bm) as UBm.
  assert (Ge : in_binary64 (m - p0)).
  { pose proof (two_product_is_exact h c Gh Gc) as E. cbv zeta in E. fold m p0 in E.
    assert (Hs : m = 0 \/ bpow radix2 (-1074 + 2 * 53 - 1) <= Rabs m).
    { right. apply Rle_trans with (bpow radix2 (-500)); [apply bpow_le; lia|]. apply Rle_trans with (2 := Hlow). simpl. lra. }
    replace (m - p0) with (nearest64 (m - p0)) by (specialize (E Hs); lra). apply generic_format_round; auto with typeclass_instances. }
  assert (C1' : Rabs (m - p0) <= 1001 / 1000 * um) by (rewrite Rabs_minus_sym; lra).
  assert (Blc : Rabs (l * c) <= 101 / 100 * um).
  { apply Rle_trans with (1 := product_size _ _ _ _ Bl Bc). unfold um, M. lra. }
  assert (Bhk : Rabs (h * k) <= 101 / 100 * um).
  { apply Rle_trans with (1 := product_size _ _ _ _ Bh Bk). unfold um, M. lra. }
  assert (Blk : Rabs (l * k) <= 103 / 100 * (unit53 * um)).
  { apply Rle_trans with (1 := product_size _ _ _ _ Bl Bk).
    replace (101 / 100 * (unit53 * H) * (101 / 100 * (unit53 * K))) with (10201 / 10000 * (unit53 * um)) by (unfold um, M; field). lra. }
  unfold product_of. cbv zeta. cbn [fst snd]. set (t1 := times a b) in *.
  pose proof (opp_is _ _ I1) as I2. set (t2 := opp t1) in *.
  assert (I3 : is64 (fused a b t2) (m - p0)).
  { apply (fused_exact _ _ _ h c (- p0)); try assumption; [unfold m; ring|apply big_enough; lra]. }
  set (t3 := fused a b t2) in *.
  destruct (times_close _ _ _ _ Hl Hk ltac:(lra)) as [I4 C4]. set (t4 := times a_lo b_lo) in *. set (v4 := nearest64 (l * k)) in *.
  pose proof (unit_times _ (Rabs_pos (l * k))) as U4.
  assert (C4' : Rabs (v4 - l * k) <= / 100 * (unit53 * um)) by lra. pose proof (size_by v4 (l * k)) as S4.
  pose proof (Rabs_triang (l * c) v4) as T5.
  destruct (fused_close _ _ _ _ _ _ Hl Hb I4 ltac:(lra)) as [I5 C5]. set (t5 := fused a_lo b t4) in *.
  set (v5 := nearest64 (l * c + v4)) in *.
  assert (U5 : unit53 * Rabs (l * c + v4) <= unit53 * (102 / 100 * um)) by (apply unit_times_compat; lra).
  assert (C5' : Rabs (v5 - (l * c + v4)) <= 103 / 100 * (unit53 * um)) by lra. pose proof (size_by v5 (l * c + v4)) as S5.
  pose proof (Rabs_triang (h * k) v5) as T6.
  destruct (fused_close _ _ _ _ _ _ Ha Hk I5 ltac:(lra)) as [I6 C6]. set (t6 := fused a b_lo t5) in *.
  set (v6 := nearest64 (h * k + v5)) in *.
  assert (U6 : unit53 * Rabs (h * k + v5) <= unit53 * (204 / 100 * um)) by (apply unit_times_compat; lra).
  assert (C6' : Rabs (v6 - (h * k + v5)) <= 205 / 100 * (unit53 * um)) by lra. pose proof (size_by v6 (h * k + v5)) as S6.
  pose proof (Rabs_triang (m - p0) v6) as T7.
  destruct (plus_close _ _ _ _ I3 I6 ltac:(lra)) as [I7 C7]. set (t7 := plus t3 t6) in *. set (w := nearest64 (m - p0 + v6)) in *.
  assert (C7' : Rabs (w - (m - p0 + v6)) <= unit53 * (306 / 100 * um)) by (apply Rle_trans with (1 := C7); apply unit_times_compat; lra).
  pose proof (size_by w (m - p0 + v6)) as S7. assert (Bw : Rabs w <= 307 / 100 * um) by lra.
  pose proof (size_by p0 m) as Sp. pose proof (size_by m p0) as Sm. rewrite (Rabs_minus_sym m) in Sm.
  destruct (fast_two_sum_terms t1 t7 p0 w I1 I7 ltac:(lra) ltac:(lra)) as (p & q & I8 & I10 & Ep & Cp & Bq & [[_ D]|[D _]]);
    [|exfalso; lra].
  exists p, q. split; [exact I8|]. split; [exact I10|]. pose proof (Rabs_triang p0 w) as Tpw. pose proof (size_by p (p0 + w)) as Sp2.
  assert (U8 : unit53 * Rabs (p0 + w) <= unit53 * (10001 / 10000 * M)) by (apply unit_times_compat; lra).
  assert (U9 : unit53 * Rabs w <= unit53 * (307 / 100 * um)) by (apply unit_times_compat; lra).
  split; [|split; [lra|split; [lra|]]].
  2: { replace q with (p0 + w - p) by lra. rewrite Ep. apply rounding_rest. rewrite <- Ep. pose proof (size_by (p0 + w) p) as S8.
    rewrite (Rabs_minus_sym _ p) in S8. pose proof (size_by p0 (p0 + w)) as S9. replace (p0 - (p0 + w)) with (- w) in S9 by ring.
    rewrite Rabs_Ropp in S9. lra. }
  replace (p + q - (h + l) * (c + k)) with
    ((w - (m - p0 + v6)) + (v6 - (h * k + v5)) + (v5 - (l * c + v4)) + (v4 - l * k)) by (rewrite D; unfold m; ring).
  absolute_values. apply Rabs_le. lra.
Qed.

Lemma product_of_is_off : forall a a_lo b b_lo h l c k H K, let M := H * K in is64 a h -> is64 a_lo l -> is64 b c -> is64 b_lo k ->
  Rabs h <= H -> Rabs c <= K -> Rabs l <= 101 / 100 * (unit53 * H) -> Rabs k <= 101 / 100 * (unit53 * K) ->
  / 1000000000000000000000000 <= M <= 1000000 -> / 1000 * M <= Rabs (h * c) ->
  exists p q, is64 (fst (product_of a a_lo b b_lo)) p /\ is64 (snd (product_of a a_lo b b_lo)) q /\
    Rabs (p + q - (h + l) * (c + k)) <= 7 * (unit53 * (unit53 * M)) /\ Rabs p <= 101 / 100 * M /\ Rabs q <= 101 / 100 * (unit53 * M).
Proof.
  intros a a_lo b b_lo h l c k H K M Ha Hl Hb Hk Bh Bc Bl Bk HM Hlow.
  destruct (product_of_parts a a_lo b b_lo h l c k H K Ha Hl Hb Hk Bh Bc Bl Bk) as (p & q & P & Q & E & Bp & Bq & _);
    [fold M; lra|exact Hlow|].
  exists p, q. split; [exact P|]. split; [exact Q|]. split; [exact E|]. split; [exact Bp|exact Bq].
Qed.

(* ---- Quotients ---- *)

Lemma over_close : forall v w a b, is64 v a -> is64 w b -> b <> 0 ->
  Rabs (a / b) <= 10000000000000000000000000000000000000000000000000000000000000000000000 ->
  is64 (over v w) (nearest64 (a / b)) /\ Rabs (nearest64 (a / b) - a / b) <= unit53 * Rabs (a / b) + tiny.
Proof. intros v w a b Hv Hw Hb H. split; [|apply product_is_close]. apply over_is; try assumption. apply big_enough. lra. Qed.

Lemma quotient_size : forall a b Q, 0 < Rabs b -> Rabs a <= Q * Rabs b -> Rabs (a / b) <= Q.
Proof.
  intros a b Q Hb H. unfold Rdiv. rewrite Rabs_mult, Rabs_inv. apply Rmult_le_reg_r with (Rabs b); [exact Hb|].
  rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. exact H.
Qed.

(* (h + l) / (c + k), where h / c is no larger than Q and l / c no larger than Q either: few units off, but no more. *)
