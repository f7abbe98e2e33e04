(* SPDX-License-Identifier: BSD-3-Clause *)
(* The sum of two double-doubles of either sign, whatever cancels: its running bound of the error is one. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts
  EnclosedQuotients.
From Forceshade Require Import BesideTie Separation.
Open Scope R_scope.

(* ---- Multiples of a power of two, and binary64 ---- *)

Lemma multiple_of_format : forall a, in_binary64 a -> multiple (- cexp radix2 fexp64 a) a.
Proof.
  intros a Ha. exists (Ztrunc (scaled_mantissa radix2 fexp64 a)). rewrite Z.opp_involutive. exact Ha.
Qed.

Lemma cexp_at_least : forall a, (-1074 <= cexp radix2 fexp64 a)%Z.
Proof. intro a. unfold cexp, FLT_exp. lia. Qed.

Lemma below_its_exponent : forall a, Rabs a < bpow radix2 (53 + cexp radix2 fexp64 a).
Proof.
  intro a. apply Rlt_le_trans with (1 := bpow_mag_gt radix2 a). apply bpow_le. unfold cexp, FLT_exp. lia.
Qed.

Lemma format_of_multiple : forall E a, (-1074 <= E)%Z -> multiple (- E) a -> Rabs a <= bpow radix2 (53 + E) -> in_binary64 a.
Proof.
  intros E a HE [n ->] B. rewrite Z.opp_involutive in *. pose proof (bpow_gt_0 radix2 E) as P.
  destruct (Z_lt_le_dec (Z.abs n) (2 ^ 53)) as [Hn|Hn].
  - apply generic_format_FLT. exists (Float radix2 n E); [reflexivity|exact Hn|exact HE].
  - assert (Hn2 : (Z.abs n <= 2 ^ 53)%Z).
    { apply le_IZR. apply Rmult_le_reg_r with (1 := P). rewrite abs_IZR. rewrite <- (Rabs_pos_eq (bpow radix2 E)) at 1 by lra.
      rewrite <- Rabs_mult. change (IZR (2 ^ 53)) with (bpow radix2 53). rewrite <- bpow_plus. exact B. }
    assert (G : in_binary64 (IZR (2 ^ 53) * bpow radix2 E)).
    { change (IZR (2 ^ 53)) with (bpow radix2 53). rewrite <- bpow_plus. apply generic_format_bpow. unfold FLT_exp. lia. }
    destruct (Z.abs_eq_or_opp n) as [H|H].
    + replace n with (2 ^ 53)%Z by lia. exact G.
    + replace n with (- 2 ^ 53)%Z by lia. rewrite opp_IZR, Ropp_mult_distr_l_reverse. now apply generic_format_opp.
Qed.

Lemma one_step_below : forall E a, multiple (- E) a -> Rabs a < bpow radix2 (53 + E) -> Rabs a + bpow radix2 E <= bpow radix2 (53 + E).
Proof.
  intros E a [n ->] B. rewrite Z.opp_involutive in *. pose proof (bpow_gt_0 radix2 E) as P. rewrite bpow_plus in *.
  rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 E)), <- abs_IZR in * by lra. apply Rmult_lt_reg_r in B; [|exact P].
  change (bpow radix2 53) with (IZR (2 ^ 53)) in *. apply lt_IZR in B.
  replace (IZR (Z.abs n) * bpow radix2 E + bpow radix2 E) with (IZR (Z.abs n + 1) * bpow radix2 E) by (rewrite plus_IZR; ring).
  apply Rmult_le_compat_r; [lra|]. apply IZR_le. lia.
Qed.

(* fast_two_sum is exact where the larger number's last bit divides the smaller one. *)
Lemma fast_two_sum_of_multiples : forall G r q x y, is64 r x -> is64 q y -> Rabs x <= 1000000000000 -> Rabs y <= 1000000000000 ->
  (-1074 <= G)%Z -> multiple (- G) x -> multiple (- G) y -> Rabs y < bpow radix2 (53 + G) ->
  let s := nearest64 (x + y) in is64 (plus r q) s /\ is64 (minus q (minus (plus r q) r)) (x + y - s).
Proof.
  intros G r q x y Hr Hq Bx By HG Mx My BG s. pose proof unit_is_small as Hu. pose proof (Rabs_triang x y) as T.
  destruct (Rle_lt_dec (Rabs y) (Rabs x)) as [L|L].
  { destruct (fast_two_sum_terms r q x y Hr Hq ltac:(lra) ltac:(lra)) as (v & z & Iv & Iz & Ev & _ & _ & [[_ D]|[D _]]); [|lra].
    fold s in Ev. rewrite Ev in *. split; [exact Iv|]. now replace (x + y - s) with z by lra. }
  destruct (plus_close _ _ _ _ Hr Hq ltac:(lra)) as [Is Cs]. fold s in Is, Cs.
  pose proof (unit_times _ (Rabs_pos (x + y))) as U. pose proof (size_by s (x + y)) as Ss.
  pose proof (multiple_plus _ _ _ _ Mx My) as Mxy. rewrite Z.max_id in Mxy. pose proof (bpow_gt_0 radix2 G) as PG.
  assert (Half : Rabs (s - (x + y)) <= bpow radix2 G /\ multiple (- G) s).
  { destruct (Rle_lt_dec (Rabs (x + y)) (bpow radix2 (53 + G))) as [H|H].
    - assert (E : s = x + y) by (apply round_generic; auto with typeclass_instances; now apply (format_of_multiple G)).
      rewrite E, nothing_off by reflexivity. split; [lra|exact Mxy].
    - assert (H54 : Rabs (x + y) < bpow radix2 (54 + G)).
      { replace (54 + G)%Z with (1 + (53 + G))%Z by ring. rewrite bpow_plus. change (bpow radix2 1) with 2. lra. }
      split.
      + pose proof (error_le_half_ulp radix2 fexp64 (fun n => negb (Z.even n)) (x + y)) as E. fold s in E.
        apply Rle_trans with (1 := E). assert (Hulp : ulp radix2 fexp64 (x + y) <= bpow radix2 (1 + G)).
        { pose proof (bpow_gt_0 radix2 (53 + G)). rewrite ulp_neq_0 by (intro Hz; rewrite Hz, Rabs_R0 in H; lra). apply bpow_le.
          assert (mag radix2 (x + y) <= 54 + G)%Z.
          { apply mag_le_bpow; [|exact H54]. intro Hz. rewrite Hz, Rabs_R0 in H. lra. }
          unfold cexp, FLT_exp. lia. }
        rewrite bpow_plus in Hulp. change (bpow radix2 1) with 2 in Hulp. lra.
      + apply (multiple_finer (- cexp radix2 fexp64 s)); [apply multiple_of_format; now apply format_of in Is|].
        assert (Hs : bpow radix2 (53 + G) <= Rabs s).
        { unfold s. apply abs_round_ge_generic; auto with typeclass_instances; [apply generic_format_bpow; unfold FLT_exp; lia|lra]. }
        pose proof (mag_ge_bpow radix2 s (54 + G)) as M. replace (54 + G - 1)%Z with (53 + G)%Z in M by ring. specialize (M Hs).
        unfold cexp, FLT_exp. lia. }
  destruct Half as [Half Ms].
  assert (F1 : in_binary64 (s - x)).
  { apply (format_of_multiple G); [exact HG| |].
    - pose proof (multiple_minus _ _ _ _ Ms Mx) as M. now rewrite Z.max_id in M.
    - apply Rle_trans with (2 := one_step_below G y My BG). replace (s - x) with (y + (s - (x + y))) by ring.
      apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  assert (F2 : in_binary64 (x + y - s)).
  { apply (format_of_multiple G); [exact HG| |].
    - pose proof (multiple_minus _ _ _ _ Mxy Ms) as M. now rewrite Z.max_id in M.
    - rewrite Rabs_minus_sym. apply Rle_trans with (1 := Half). apply bpow_le. lia. }
  split; [exact Is|]. pose proof (minus_size s x) as Sx. rewrite Rabs_minus_sym in Half.
  assert (I1 : is64 (minus (plus r q) r) (s - x)) by (apply (minus_exact _ _ s x); trivial; apply big_enough; lra).
  apply (minus_exact _ _ y (s - x)); trivial; [ring|]. apply big_enough. rewrite Rabs_minus_sym. lra.
Qed.

(* ---- Where the first terms cancel ---- *)

Lemma sum_of_cancelling : forall a a_lo b b_lo h l c k, is64 a h -> is64 a_lo l -> is64 b c -> is64 b_lo k ->
  Rabs l <= unit53 * Rabs h -> Rabs k <= unit53 * Rabs c -> Rabs h <= 10000000000 -> Rabs c <= 10000000000 ->
  Rabs (h + c) <= Rabs h -> Rabs (h + c) <= Rabs c -> Rabs h <= 2 * Rabs c -> Rabs c <= 2 * Rabs h ->
  / 10000000000000000000000000000000000000000 <= Rabs h -> / 10000000000000000000000000000000000000000 <= Rabs c ->
  exists p q, is64 (fst (sum_of a a_lo b b_lo)) p /\ is64 (snd (sum_of a a_lo b b_lo)) q /\ Rabs q <= unit53 * Rabs p /\
    Rabs p <= 100000000000 /\
    (p + q = h + l + (c + k) \/ / 10000000000000000000000000000000000000000000000000000000000 <= Rabs p /\
      Rabs (p + q - (h + l + (c + k))) <= 3 * (unit53 * (unit53 * Rabs p))).
Proof.
  intros a a_lo b b_lo h l c k Ha Hal Hb Hbl Bl Bk Bh Bc H1 H2 H3 H4 Lh Lc. pose proof unit_is_small as Hu.
  set (E := Z.min (cexp radix2 fexp64 h) (cexp radix2 fexp64 c)).
  assert (HE : (-1074 <= E)%Z) by (pose proof (cexp_at_least h); pose proof (cexp_at_least c); unfold E; lia).
  pose proof (bpow_gt_0 radix2 E) as PE.
  assert (B53 : bpow radix2 (53 + E) = 9007199254740992 * bpow radix2 E) by (rewrite bpow_plus; f_equal; simpl; lra).
  assert (Least : Rabs h < bpow radix2 (53 + E) \/ Rabs c < bpow radix2 (53 + E)).
  { unfold E. destruct (Z.min_dec (cexp radix2 fexp64 h) (cexp radix2 fexp64 c)) as [-> | ->]; [left|right]; apply below_its_exponent. }
  assert (Mh : multiple (- E) h).
  { apply (multiple_finer (- cexp radix2 fexp64 h)); [apply multiple_of_format; now apply format_of in Ha|unfold E; lia]. }
  assert (Mc : multiple (- E) c).
  { apply (multiple_finer (- cexp radix2 fexp64 c)); [apply multiple_of_format; now apply format_of in Hb|unfold E; lia]. }
  clearbody E. set (s := h + c) in *. assert (Ms : multiple (- E) s) by (pose proof (multiple_plus _ _ _ _ Mh Mc) as M;
    now rewrite Z.max_id in M).
  assert (Fs : in_binary64 s) by (apply (format_of_multiple E); trivial; lra).
  assert (Blk : Rabs (l + k) <= bpow radix2 (2 + E)).
  { apply Rle_trans with (1 := Rabs_triang _ _). rewrite bpow_plus. change (bpow radix2 2) with 4.
    apply Rle_trans with (unit53 * (Rabs h + Rabs c)); [lra|].
    apply Rle_trans with (unit53 * (3 * (9007199254740992 * bpow radix2 E))); [apply Rmult_le_compat_l; lra|unfold unit53; lra]. }
  assert (LE : / 100000000000000000000000000000000000000000000000000000000 <= bpow radix2 E) by lra.
  pose proof (unit_times _ (Rabs_pos h)) as Uh. pose proof (unit_times _ (Rabs_pos c)) as Uc. unfold sum_of. cbv zeta. cbn [fst snd].
  destruct (two_sum_terms _ _ _ _ Ha Hb ltac:(lra) ltac:(lra)) as (s' & I1 & I6 & _). cbv zeta in I6.
  destruct (two_sum_terms _ _ _ _ Hal Hbl ltac:(lra) ltac:(lra)) as (t & I7 & I14 & C2). cbv zeta in I14.
  set (t1 := plus a b) in *. set (t6 := plus (minus a _) (minus b _)) in *. set (t7 := plus a_lo b_lo) in *.
  set (t14 := plus (minus a_lo _) (minus b_lo _)) in *.
  assert (s' = s) as ->.
  { apply (is64_same t1); [exact I1|]. apply (plus_exact _ _ h c); trivial. apply big_enough. lra. }
  replace (h + c - s) with 0 in I6 by (unfold s; ring). pose proof (Rabs_triang l k) as Tlk.
  assert (Et : t = nearest64 (l + k)).
  { apply (is64_same t7); [exact I7|]. apply plus_is; trivial. apply big_enough. lra. }
  set (tl := l + k - t) in *. pose proof (unit_times _ (Rabs_pos (l + k))) as Ulk.
  assert (Bt : Rabs t <= 1000).
  { replace t with (l + k - tl) by (unfold tl; ring). apply Rle_trans with (1 := minus_size _ _). lra. }
  assert (HG : exists G, (-1074 <= G)%Z /\ multiple (- G) s /\ multiple (- G) t /\ Rabs t < bpow radix2 (53 + G) /\
    2 * Rabs tl <= bpow radix2 G).
  { destruct (Req_dec t 0) as [H0|H0].
    - exists E. split; [exact HE|]. split; [exact Ms|]. rewrite H0. split; [exists 0%Z; ring|]. rewrite Rabs_R0.
      split; [apply bpow_gt_0|]. unfold tl in *. rewrite H0, Rminus_0_r in *. lra.
    - exists (cexp radix2 fexp64 t). split; [apply cexp_at_least|]. split; [|split; [|split]].
      + apply (multiple_finer (- E) _ _ Ms). assert (M : (mag radix2 t <= 3 + E)%Z).
        { apply mag_le_bpow; [exact H0|]. apply Rle_lt_trans with (bpow radix2 (2 + E)); [|apply bpow_lt; lia].
          rewrite Et. apply abs_round_le_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia. }
        unfold cexp, FLT_exp. lia.
      + apply multiple_of_format. now apply format_of in I7.
      + apply below_its_exponent.
      + pose proof (error_le_half_ulp_round radix2 fexp64 (fun n => negb (Z.even n)) (l + k)) as Half.
        change (Znearest (fun n => negb (Z.even n))) with ZnearestE in Half. rewrite <- Et, ulp_neq_0, Rabs_minus_sym in Half by exact H0.
        fold tl in Half. lra. }
  destruct HG as (G & HG & Gs & Gt & BG & Half). pose proof (bpow_gt_0 radix2 G) as PG.
  assert (I8 : is64 (plus t6 t7) t).
  { apply (plus_exact _ _ 0 t); trivial; [ring|now apply format_of in I7|apply big_enough; lra]. }
  set (t8 := plus t6 t7) in *.
  destruct (fast_two_sum_of_multiples G t1 t8 s t I1 I8 ltac:(lra) ltac:(lra) HG Gs Gt BG) as [I9 I16].
  pose proof (sum_is_close s t Fs (format_of _ _ I7)) as C9.
  set (t9 := plus t1 t8) in *. set (t16 := minus t8 (minus t9 t1)) in *. set (v := nearest64 (s + t)) in *.
  set (vl := s + t - v) in *. pose proof (Rabs_triang s t) as Tst. pose proof (unit_times _ (Rabs_pos (s + t))) as Ust.
  assert (Bv : Rabs v <= 21000000000) by (pose proof (size_by v (s + t)); lra).
  assert (B900 : 1000000000000 <= bpow radix2 900) by (apply Rle_trans with (bpow radix2 40); [simpl; lra|apply bpow_le; lia]).
  assert (tail : forall w, in_binary64 v -> in_binary64 w -> Rabs w <= 1000000 -> let p := nearest64 (v + w) in
    Rabs (v + w - p) <= unit53 * Rabs p /\ Rabs p <= 100000000000 /\ 99 / 100 * Rabs (v + w) <= Rabs p).
  { intros w Fv Fw Bw p. split; [now apply sum_rest|]. pose proof (sum_is_close v w Fv Fw) as C. fold p in C.
    pose proof (unit_times _ (Rabs_pos (v + w))) as U. pose proof (size_by (v + w) p) as S1. pose proof (size_by p (v + w)) as S2.
    rewrite (Rabs_minus_sym (v + w)) in *. pose proof (Rabs_triang v w) as T. lra. }
  pose proof (format_of _ _ I9) as Fv.
  destruct (Rle_lt_dec (Rabs (s + t)) (bpow radix2 (53 + G))) as [Hst|Hst].
  - assert (Mst : multiple (- G) (s + t)) by (pose proof (multiple_plus _ _ _ _ Gs Gt) as M; now rewrite Z.max_id in M).
    assert (Ev : v = s + t) by (apply round_generic; auto with typeclass_instances; now apply (format_of_multiple G)).
    replace vl with 0 in I16 by (unfold vl; rewrite Ev; ring). pose proof (format_of _ _ I14) as Ftl.
    assert (I17 : is64 (plus t14 t16) tl).
    { apply (plus_exact _ _ tl 0); trivial; [ring|]. apply big_enough. lra. }
    set (t17 := plus t14 t16) in *.
    assert (Last : is64 (plus t9 t17) (nearest64 (v + tl)) /\ is64 (minus t17 (minus (plus t9 t17) t9)) (v + tl - nearest64 (v + tl))).
    { destruct (Req_dec v 0) as [H0|H0].
      - apply (fast_two_sum_of_multiples (cexp radix2 fexp64 tl)); trivial; try lra; [apply cexp_at_least| | |].
        + rewrite H0. exists 0%Z. ring.
        + now apply multiple_of_format.
        + apply below_its_exponent.
      - apply two_terms; trivial; [|lra]. rewrite Ev in H0 |- *. pose proof (multiple_not_0 _ _ Mst H0) as M.
        rewrite Z.opp_involutive in M. pose proof (Rabs_pos tl). lra. }
    destruct Last as [I18 I20]. destruct (tail tl Fv Ftl ltac:(lra)) as (T1 & T2 & _).
    exists (nearest64 (v + tl)), (v + tl - nearest64 (v + tl)). split; [exact I18|]. split; [exact I20|]. split; [exact T1|].
    split; [exact T2|]. left. rewrite Ev. unfold tl, s. ring.
  - set (A := Rabs (s + t)) in *. assert (Bvl : Rabs vl <= unit53 * A) by (unfold vl; rewrite Rabs_minus_sym; exact C9).
    assert (Btl : Rabs tl <= 1001 / 1000 * (unit53 * A)).
    { pose proof (size_by (l + k) t) as S. fold tl in S.
      assert (unit53 * Rabs (l + k) <= unit53 * (1001 / 1000 * A)) by (apply unit_times_compat; lra). lra. }
    pose proof (Rabs_triang tl vl) as Tw.
    destruct (plus_close _ _ _ _ I14 I16 ltac:(lra)) as [I17 C17]. set (t17 := plus t14 t16) in *. set (w := nearest64 (tl + vl)) in *.
    assert (C17' : Rabs (w - (tl + vl)) <= unit53 * (2001 / 1000 * (unit53 * A))) by (apply Rle_trans with (1 := C17);
      apply unit_times_compat; lra).
    pose proof (unit_times _ (proj1 Ust)) as UUst. pose proof (size_by w (tl + vl)) as Sw.
    pose proof (size_by (s + t) v) as Sv. fold vl in Sv. fold A in Sv.
    destruct (two_terms t9 t17 v w I9 I17 ltac:(lra) ltac:(lra)) as [I18 I20].
    destruct (tail w Fv (format_of _ _ I17) ltac:(lra)) as (T1 & T2 & T3). pose proof (size_by v (v + w)) as Svw.
    replace (v - (v + w)) with (- w) in Svw by ring. rewrite Rabs_Ropp in Svw.
    assert (Hp : 98 / 100 * A <= Rabs (nearest64 (v + w))) by lra.
    exists (nearest64 (v + w)), (v + w - nearest64 (v + w)). split; [exact I18|]. split; [exact I20|]. split; [exact T1|].
    split; [exact T2|]. right. split.
    + assert (Hs : s <> 0) by (intro H0; unfold A in Hst; rewrite H0, Rplus_0_l in Hst; lra).
      pose proof (multiple_not_0 _ _ Ms Hs) as M. rewrite Z.opp_involutive in M. pose proof (size_by s (s + t)) as Ss. fold A in Ss.
      replace (s - (s + t)) with (- t) in Ss by ring. rewrite Rabs_Ropp in Ss. lra.
    + replace (nearest64 (v + w) + (v + w - nearest64 (v + w)) - (h + l + (c + k))) with (w - (tl + vl)) by (unfold vl, tl, s; ring).
      apply Rle_trans with (1 := C17'). replace (3 * (unit53 * (unit53 * Rabs (nearest64 (v + w))))) with
        (unit53 * (unit53 * (3 * Rabs (nearest64 (v + w))))) by ring.
      replace (unit53 * (2001 / 1000 * (unit53 * A))) with (unit53 * (unit53 * (2001 / 1000 * A))) by ring.
      apply unit_times_compat, unit_times_compat. lra.
Qed.
