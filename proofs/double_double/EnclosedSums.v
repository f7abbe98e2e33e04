(* SPDX-License-Identifier: BSD-3-Clause *)
(* Sums and differences in double-double enclose those of the numbers that their operands enclose. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Relative.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts
  EnclosedQuotients.
From Forceshade Require Import BesideTie Separation SumOfTwo.
Open Scope R_scope.

(* ---- The bound covers those of both operands, also where it is so small that its last bits are lost ---- *)

Lemma small_sums_are_exact : forall e f, in_binary64 e -> in_binary64 f -> Rabs (e + f) <= bpow radix2 (-1021) -> nearest64 (e + f) = e + f.
Proof.
  intros e f He Hf B. apply round_generic; auto with typeclass_instances. apply (format_of_multiple (-1074)); [lia| |exact B].
  change (- -1074)%Z with (Z.max 1074 1074).
  apply multiple_plus; (eapply multiple_finer; [apply multiple_of_format; assumption|]);
    [pose proof (cexp_at_least e)|pose proof (cexp_at_least f)];
    lia.
Qed.

Lemma error_of_two : forall v x a b e f, is64 v x -> Rabs x <= 1000000000000 -> is64 a e -> is64 b f ->
  0 <= e <= 10000000000000000000000000000000000000000 -> 0 <= f <= 10000000000000000000000000000000000000000 ->
  exists g, is64 (error_of v (plus a b)) g /\ e + f <= g.
Proof.
  intros v x a b e f Hv Hx Ha Hb He Hf. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  assert (nonneg : forall a b, 0 <= a <= b -> 0 <= nearest64 a <= b * (1 + unit53) + tiny) by exact rounded_up.
  assert (Ip : is64 (plus a b) (nearest64 (e + f))) by (apply plus_is; try assumption; apply big_enough; rewrite Rabs_pos_eq; lra).
  pose proof (sum_is_close e f (format_of _ _ Ha) (format_of _ _ Hb)) as C. rewrite (Rabs_pos_eq (e + f)) in C by lra.
  pose proof (unit_times (e + f) ltac:(lra)) as Uef. pose proof (small_sums_are_exact e f (format_of _ _ Ha) (format_of _ _ Hb)) as Exact.
  rewrite (Rabs_pos_eq (e + f)) in Exact by lra.
  pose proof (nonneg (e + f) (e + f) ltac:(lra)) as Np. set (p := nearest64 (e + f)) in *. apply Rabs_le_inv in C.
  pose proof (Rabs_pos x) as Px. assert (K : bpow radix2 (-101) = share101) by (unfold share101; simpl; lra).
  pose proof (two_to_is (-101) ltac:(lia)) as I1. rewrite K in I1. set (sx := share101 * Rabs x).
  assert (Hsx : 0 <= sx <= 1) by (unfold sx, share101; lra).
  pose proof (times_is _ _ _ _ I1 (absolute_is _ _ Hv) ltac:(apply big_enough; fold sx; rewrite Rabs_pos_eq; lra)) as I2. fold sx in I2.
  pose proof (nonneg sx 1 Hsx) as B1. set (r := nearest64 sx) in *.
  pose proof (plus_is _ _ _ _ Ip I2 ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as I3.
  pose proof (nonneg (p + r) 100000000000000000000000000000000000000000 ltac:(lra)) as B2.
  assert (L1 : p <= nearest64 (p + r)).
  { rewrite <- (round_generic radix2 fexp64 ZnearestE p) at 1 by (now apply format_of in Ip). apply round_le; auto with
    typeclass_instances. lra. }
  set (s := nearest64 (p + r)) in *.
  pose proof (constant_is (2 ^ 40 + 1) (-40) ltac:(lia) ltac:(lia)) as I4. fold slack in I4.
  assert (Ek : IZR (2 ^ 40 + 1) * bpow radix2 (-40) = 1 + 8192 * unit53) by (unfold unit53; simpl; lra). rewrite Ek in I4.
  assert (Eks : (1 + 8192 * unit53) * s = s + 8192 * (unit53 * s)) by ring. pose proof (unit_times s ltac:(lra)) as U3.
  pose proof (times_is _ _ _ _ I4 I3 ltac:(apply big_enough; rewrite Eks, Rabs_pos_eq; lra)) as I5. rewrite Eks in I5.
  exists (nearest64 (s + 8192 * (unit53 * s))). split; [exact I5|].
  assert (L2 : s <= nearest64 (s + 8192 * (unit53 * s))).
  { rewrite <- (round_generic radix2 fexp64 ZnearestE s) at 1 by (now apply format_of in I3). apply round_le; auto with
    typeclass_instances. lra. }
  destruct (Rle_lt_dec (e + f) (bpow radix2 (-1021))) as [H|H]; [specialize (Exact H); lra|].
  set (d := s + 8192 * (unit53 * s)) in *.
  assert (Large : bpow radix2 (-1022) <= d).
  { change (-1021)%Z with (1 + -1022)%Z in H. rewrite bpow_plus in H. change (bpow radix2 1) with 2 in H.
    pose proof (bpow_gt_0 radix2 (-1022)). unfold d. lra. }
  pose proof (relative_error_N_FLT radix2 (-1074) 53 (eq_refl _) (fun n => negb (Z.even n)) d) as R.
  change (-1074 + 53 - 1)%Z with (-1022)%Z in R. rewrite (Rabs_pos_eq d) in R by (unfold d; lra). specialize (R Large).
  change (round radix2 (FLT_exp (-1074) 53) (Znearest (fun n => negb (Z.even n))) d) with (nearest64 d) in R.
  change (- (53) + 1)%Z with (-52)%Z in R. replace (/ 2 * bpow radix2 (-52)) with unit53 in R by (unfold unit53; simpl; lra).
  apply Rabs_le_inv in R. unfold d in *.
  assert (unit53 * (99 / 100 * (e + f)) <= unit53 * s) by (apply unit_times_compat; lra).
  assert (unit53 * (s + 8192 * (unit53 * s)) <= unit53 * (2 * s)) by (apply unit_times_compat; lra). lra.
Qed.

(* ---- Any two numbers of either sign ---- *)

(* The first terms are not both tiny. The bounds may be larger than they. *)
Theorem sum_of_contained : forall a b x y, contains a x -> contains b y ->
  value64 (error a) <= 1000000000000000000000000000000000000000 -> value64 (error b) <= 1000000000000000000000000000000000000000 ->
  Rabs (value64 (hi a)) <= 6000000000 -> Rabs (value64 (hi b)) <= 6000000000 ->
  value64 (hi a) = 0 /\ value64 (hi b) = 0 \/ / 1000000000000000000000000000000000000000 <= Rabs (value64 (hi a)) \/ /
      1000000000000000000000000000000000000000 <= Rabs (value64 (hi b)) ->
  contains (add a b) (x + y).
Proof.
  intros a b x y (h & l & e & H & L & E & Bl & Be & B & _) (c & k & f & H' & L' & E' & Bk & Bf & B' & _) Be2 Bf2 Bh Bc Low.
  rewrite (proj1 H) in Bh, Low. rewrite (proj1 H') in Bc, Low. rewrite (proj1 E) in Be2. rewrite (proj1 E') in Bf2.
  pose proof unit_is_small as Hu. unfold contains, add, rounded. cbn [hi lo error].
  pose proof (unit_times _ (Rabs_pos h)) as Uh. pose proof (unit_times _ (Rabs_pos c)) as Uc.
  set (S := Rabs (h + c)). pose proof (size_by h (h + c)) as S1. pose proof (size_by c (h + c)) as S2. fold S in S1, S2.
  replace (h - (h + c)) with (- c) in S1 by ring. replace (c - (h + c)) with (- h) in S2 by ring. rewrite Rabs_Ropp in S1, S2.
  pose proof (Rabs_triang h c) as S3. fold S in S3. pose proof (Rabs_pos (h + c)) as PS. fold S in PS.
  assert (close : forall p q g, Rabs (p + q - (h + l + (c + k))) <= g -> e + f + g <= g + (e + f) -> Rabs (p + q - (x + y)) <= e + f + g).
  { intros p q g Hg _. replace (p + q - (x + y)) with ((p + q - (h + l + (c + k))) + (h + l - x) + (c + k - y)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). pose proof (Rabs_triang (p + q - (h + l + (c + k))) (h + l - x)). lra. }
  assert (inexact : forall p q, is64 (fst (sum_of (hi a) (lo a) (hi b) (lo b))) p -> is64 (snd (sum_of (hi a) (lo a) (hi b) (lo b))) q ->
    Rabs q <= unit53 * Rabs p -> / 1000000000000000000000000000000000000000000000000000000000000 <= Rabs p <= 100000000000 ->
    Rabs (p + q - (h + l + (c + k))) <= 30 * (unit53 * (unit53 * Rabs p)) -> exists h l e0,
    is64 (fst (sum_of (hi a) (lo a) (hi b) (lo b))) h /\ is64 (snd (sum_of (hi a) (lo a) (hi b) (lo b))) l /\
    is64 (error_of (fst (sum_of (hi a) (lo a) (hi b) (lo b))) (plus (error a) (error b))) e0 /\
    Rabs l <= unit53 * Rabs h /\ 0 <= e0 /\ Rabs (h + l - (x + y)) <= e0 /\ Rabs h <= 1000000000000).
  { intros p q P Q Bq Bp Off. destruct (plus_close _ _ _ _ E E' ltac:(rewrite !Rabs_pos_eq; lra)) as [I C].
    rewrite (Rabs_pos_eq (e + f)) in C by lra. apply Rabs_le_inv in C. pose proof (unit_times (e + f) ltac:(lra)) as U.
    set (r := nearest64 (e + f)) in *. assert (Ur : unit53 * (99 / 100 * (e + f)) <= unit53 * r) by (apply unit_times_compat; lra).
    destruct (error_covers _ p _ r 10000000000000000000000000000000000000000 P I ltac:(lra) ltac:(lra) ltac:(lra)) as (g & G & Bg).
    assert (30 * (unit53 * (unit53 * Rabs p)) <= 98 / 100 * (share101 * Rabs p)).
    { rewrite share_is. replace (98 / 100 * (32 * (unit53 * unit53) * Rabs p)) with (unit53 * (unit53 * (98 / 100 * 32 * Rabs p))) by ring.
      replace (30 * (unit53 * (unit53 * Rabs p))) with (unit53 * (unit53 * (30 * Rabs p))) by ring.
        apply unit_times_compat, unit_times_compat. lra. }
    pose proof (close p q _ Off ltac:(lra)) as D. exists p, q, g. repeat (split; [assumption|]).
      split; [pose proof (Rabs_pos (p + q - (x + y))); lra|].
    split; lra. }
  assert (exactly : forall p q, is64 (fst (sum_of (hi a) (lo a) (hi b) (lo b))) p -> is64 (snd (sum_of (hi a) (lo a) (hi b) (lo b))) q ->
    Rabs q <= unit53 * Rabs p -> Rabs p <= 100000000000 -> p + q = h + l + (c + k) -> exists h l e0,
    is64 (fst (sum_of (hi a) (lo a) (hi b) (lo b))) h /\ is64 (snd (sum_of (hi a) (lo a) (hi b) (lo b))) l /\
    is64 (error_of (fst (sum_of (hi a) (lo a) (hi b) (lo b))) (plus (error a) (error b))) e0 /\
    Rabs l <= unit53 * Rabs h /\ 0 <= e0 /\ Rabs (h + l - (x + y)) <= e0 /\ Rabs h <= 1000000000000).
  { intros p q P Q Bq Bp Eq. destruct (error_of_two _ p _ _ e f P ltac:(lra) E E' ltac:(lra) ltac:(lra)) as (g & G & Bg).
    pose proof (close p q 0 ltac:(rewrite nothing_off by exact Eq; lra) ltac:(lra)) as D.
    exists p, q, g. repeat (split; [assumption|]). split; [lra|]. split; lra. }
  destruct (Rle_lt_dec (Rabs h) (4 * S)) as [F1|F1]; [destruct (Rle_lt_dec (Rabs c) (4 * S)) as [F2|F2]|].
  - (* at most three quarters cancel *)
    pose proof (unit_times S PS) as US. pose proof (unit_times _ (proj1 US)) as UUS.
    assert (HL : Rabs l + Rabs k <= 8 * (unit53 * S)).
    { assert (unit53 * Rabs h <= unit53 * (4 * S)) by (apply unit_times_compat; lra).
      assert (unit53 * Rabs c <= unit53 * (4 * S)) by (apply unit_times_compat; lra). lra. }
    destruct (sum_of_is_off _ _ _ _ h l c k S (8 * (unit53 * S)) H L H' L' ltac:(lra) ltac:(lra) (Rle_refl _) HL ltac:(lra))
      as (p & q & P & Q & Off & Bp & Bq0 & Bq & _).
    assert (Off2 : Rabs (p + q - (h + l + (c + k))) <= 19 * (unit53 * (unit53 * S))) by lra.
    assert (Hp : 99 / 100 * S <= Rabs p).
    { assert (Gs : S <= Rabs p + Rabs q + Rabs (p + q - (h + l + (c + k))) + Rabs l + Rabs k).
      { unfold S. replace (h + c) with (p + q - (p + q - (h + l + (c + k))) - l - k) by ring.
        repeat (eapply Rle_trans; [apply minus_size|apply Rplus_le_compat_r]). apply Rabs_triang. }
      pose proof (unit_times _ (proj1 UUS)). lra. }
    assert (Up : unit53 * (99 / 100 * S) <= unit53 * Rabs p) by (apply unit_times_compat; lra).
    assert (Bq2 : Rabs q <= unit53 * Rabs p) by (apply Bq; fold S; lra).
    assert (UUp : unit53 * (unit53 * (99 / 100 * S)) <= unit53 * (unit53 * Rabs p)) by (apply unit_times_compat; exact Up).
    destruct (Req_dec S 0) as [H0|H0].
    + apply (exactly p q); trivial; [lra|]. rewrite H0, !Rmult_0_r in Off2. pose proof (no_size _ Off2). lra.
    + apply (inexact p q); trivial; [|lra]. split; [|lra]. assert (/ 10000000000000000000000000000000000000000 <= S); [|lra].
      destruct Low as [[Zh Zc]|Low]; [|lra]. exfalso. apply H0. unfold S. rewrite Zh, Zc, Rplus_0_l. apply Rabs_R0.
  - assert (LL : / 10000000000000000000000000000000000000000 <= Rabs h /\
      / 10000000000000000000000000000000000000000 <= Rabs c) by (destruct Low as [[_ Z]|Low]; [rewrite Z, Rabs_R0 in F2|]; lra).
    destruct (sum_of_cancelling _ _ _ _ h l c k H L H' L' Bl Bk ltac:(lra) ltac:(lra) ltac:(fold S; lra) ltac:(fold S; lra)
      ltac:(lra) ltac:(lra)
      ltac:(lra) ltac:(lra)) as (p & q & P & Q & Bq & Bp & [Eq|[Lp Off]]); [now apply (exactly p q)|apply (inexact p q); trivial; [lra|]].
    apply Rle_trans with (1 := Off). pose proof (unit_times _ (Rabs_pos p)) as Up. pose proof (unit_times _ (proj1 Up)). lra.
  - assert (LL : / 10000000000000000000000000000000000000000 <= Rabs h /\
      / 10000000000000000000000000000000000000000 <= Rabs c) by (destruct Low as [[Z _]|Low]; [rewrite Z, Rabs_R0 in F1|]; lra).
    destruct (sum_of_cancelling _ _ _ _ h l c k H L H' L' Bl Bk ltac:(lra) ltac:(lra) ltac:(fold S; lra) ltac:(fold S; lra)
      ltac:(lra) ltac:(lra)
      ltac:(lra) ltac:(lra)) as (p & q & P & Q & Bq & Bp & [Eq|[Lp Off]]); [now apply (exactly p q)|apply (inexact p q); trivial; [lra|]].
    apply Rle_trans with (1 := Off). pose proof (unit_times _ (Rabs_pos p)) as Up. pose proof (unit_times _ (proj1 Up)). lra.
Qed.

Theorem sum_contains : forall s t a b x y, encloses s a x -> encloses t b y -> 0 <= s <= / 1000 -> 0 <= t <= / 1000 ->
  x = 0 \/ / 100000000000000000000000000000000000000 <= Rabs x <= 5000000000 ->
      y = 0 \/ / 100000000000000000000000000000000000000 <= Rabs y <= 5000000000 -> contains (add a b) (x + y).
Proof.
  intros s t a b x y Ea Eb Hs Ht Hx Hy. pose proof (first_size _ _ _ Ea Hs) as Sa. pose proof (first_size _ _ _ Eb Ht) as Sb.
  assert (Bh : Rabs (value64 (hi a)) <= 6000000000) by (destruct Hx as [-> |Hx]; [rewrite Rabs_R0 in Sa|]; lra).
  assert (Bc : Rabs (value64 (hi b)) <= 6000000000) by (destruct Hy as [-> |Hy]; [rewrite Rabs_R0 in Sb|]; lra).
  destruct (enclosed_is_bounded s a x _ Ea ltac:(lra) Bh ltac:(lra)) as [Ca Be].
  destruct (enclosed_is_bounded t b y _ Eb ltac:(lra) Bc ltac:(lra)) as [Cb Bf].
  apply sum_of_contained; trivial; try lra. destruct Hx as [-> |Hx]; [|right; left; lra].
  destruct Hy as [-> |Hy]; [|right; right; lra]. rewrite Rabs_R0 in Sa, Sb. pose proof (Rabs_pos (value64 (hi a))).
  pose proof (Rabs_pos (value64 (hi b))). left. split; apply no_size; lra.
Qed.

Lemma encloses_negated : forall s a x, encloses s a x -> encloses s (negated a) (- x).
Proof.
  intros s a x (h & l & e & H & L & E & Bl & Be & B). exists (- h), (- l), e. split; [now apply opp_is|]. split; [now apply opp_is|].
  split; [exact E|]. rewrite !Rabs_Ropp. split; [exact Bl|]. split; [exact Be|].
  replace (- h + - l - - x) with (- (h + l - x)) by ring. now rewrite Rabs_Ropp.
Qed.

Theorem difference_of_two_contains : forall s t a b x y, encloses s a x -> encloses t b y -> 0 <= s <= / 1000 -> 0 <= t <= / 1000 ->
  x = 0 \/ / 100000000000000000000000000000000000000 <= Rabs x <= 5000000000 ->
      y = 0 \/ / 100000000000000000000000000000000000000 <= Rabs y <= 5000000000 ->
  contains (add a (negated b)) (x - y).
Proof.
  intros s t a b x y Ea Eb Hs Ht Hx Hy. apply (sum_contains s t); trivial; [now apply encloses_negated|].
  destruct Hy as [-> |Hy]; [left; ring|right; now rewrite Rabs_Ropp].
Qed.

(* ---- Where nothing cancels, the bound remains a share of the sum ---- *)

Lemma first_is_positive : forall s h l e x, Rabs l <= unit53 * Rabs h -> 0 <= e <= s * Rabs h -> Rabs (h + l - x) <= e ->
  0 <= s <= / 1000 ->
  0 <= x -> 99 / 100 * x <= h <= 101 / 100 * x.
Proof.
  intros s h l e x Bl Be B Hs Hx. pose proof (enclosed_size _ _ _ _ _ Bl Be B Hs) as S. rewrite (Rabs_pos_eq x) in S by exact Hx.
  pose proof (Rabs_pos h) as P. pose proof (unit_times _ P) as U. assert (s * Rabs h <= / 1000 * Rabs h) by (apply Rmult_le_compat_r; lra).
  apply Rabs_le_inv in B. apply Rabs_le_inv in Bl. destruct (Rle_lt_dec 0 h) as [Hh|Hh];
    [rewrite (Rabs_pos_eq h) in S by exact Hh; exact S|].
  rewrite (Rabs_left h) in * by exact Hh. lra.
Qed.

Theorem encloses_add : forall s t a b x y, encloses s a x -> encloses t b y -> 0 <= s <= / 1000 -> 0 <= t <= / 1000 ->
  x = 0 \/ / 1000000000000000000000000000000000000000000000000000000000000 <= x <= 1000000000 ->
  y = 0 \/ / 1000000000000000000000000000000000000000000000000000000000000 <= y <= 1000000000 ->
  encloses (3 * (s + t) + 3 * share101) (add a b) (x + y).
Proof.
  intros s t a b x y (h & l & e & H & L & E & Bl & Be & B) (c & k & f & H' & L' & E' & Bk & Bf & B') Hs Ht Hx Hy.
  pose proof unit_is_small as Hu. pose proof (first_is_positive _ _ _ _ _ Bl Be B Hs ltac:(lra)) as Rh.
  pose proof (first_is_positive _ _ _ _ _ Bk Bf B' Ht ltac:(lra)) as Rc. rewrite (Rabs_pos_eq h) in * by lra.
    rewrite (Rabs_pos_eq c) in * by lra.
  assert (Es : s * h <= / 1000 * h) by (apply Rmult_le_compat_r; lra). assert (Et : t * c <= / 1000 * c) by (apply Rmult_le_compat_r; lra).
  set (S := h + c). assert (ES : Rabs (h + c) = S) by (apply Rabs_pos_eq; unfold S; lra).
  pose proof (unit_times S ltac:(unfold S; lra)) as US. pose proof (unit_times _ (proj1 US)) as UUS.
  assert (HL : Rabs l + Rabs k <= unit53 * S) by (unfold S; lra).
  destruct (sum_of_is_off _ _ _ _ h l c k S (unit53 * S) H L H' L' ltac:(rewrite Rabs_pos_eq; lra) ltac:(rewrite Rabs_pos_eq; lra)
    ltac:(lra) HL ltac:(unfold S in *; lra)) as (p & q & P & Q & Off & Bp & Bq & T & _).
  assert (Off2 : Rabs (p + q - (h + l + (c + k))) <= 5 * (unit53 * (unit53 * S))) by lra.
  destruct (plus_close _ _ _ _ E E' ltac:(rewrite !Rabs_pos_eq; lra)) as [I C]. rewrite (Rabs_pos_eq (e + f)) in C by lra.
  apply Rabs_le_inv in C. pose proof (unit_times (e + f) ltac:(lra)) as U. unfold add, rounded. set (r := nearest64 (e + f)) in *.
  assert (D : Rabs (p + q - (x + y)) <= 5 * (unit53 * (unit53 * S)) + e + f).
  { replace (p + q - (x + y)) with ((p + q - (h + l + (c + k))) + (h + l - x) + (c + k - y)) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _). pose proof (Rabs_triang (p + q - (h + l + (c + k))) (h + l - x)). lra. }
  destruct (Req_dec S 0) as [H0|H0].
  - assert (h = 0 /\ c = 0) as [Zh Zc] by (unfold S in H0; lra). assert (x = 0 /\ y = 0) as [-> ->] by lra.
    rewrite H0, !Rmult_0_r, Rplus_0_r in *. rewrite Zh, Rmult_0_r in Be. rewrite Zc, Rmult_0_r in Bf.
    assert (e = 0) as -> by lra. assert (f = 0) as -> by lra. assert (p = 0) as -> by (apply no_size; lra).
    assert (q = 0) as -> by (apply no_size; lra). apply encloses_more with 0; [|unfold share101; lra]. apply encloses_exact.
    split; [exact P|]. split; [exact Q|]. cbn [error]. apply error_of_nothing; [exact P|].
    replace 0 with r; [exact I|]. unfold r. rewrite Rplus_0_r. apply round_0. auto with typeclass_instances.
  - assert (LS : / 10000000000000000000000000000000000000000000000000000000000000 <= S <= 10200000000) by (unfold S in *; lra).
    specialize (T ltac:(fold S; rewrite (Rabs_pos_eq S); lra)).
    assert (Bp2 : 99 / 100 * S <= p).
    { pose proof T as Hq.
      pose proof (unit_times _ (Rabs_pos p)) as Up. apply Rabs_le_inv in Off2.
      pose proof (Rabs_triang l k) as Tlk. pose proof (Rle_abs (l + k)) as A1. pose proof (Rle_abs (- (l + k))) as A2.
        rewrite Rabs_Ropp in A2.
      pose proof (Rle_abs q) as A3. unfold S in *. lra. }
    rewrite (Rabs_pos_eq p) in Bp, T by lra.
    assert (Ur : unit53 * (99 / 100 * (e + f)) <= unit53 * r) by (apply unit_times_compat; lra).
    destruct (error_covers _ p _ r (101 / 100 * (e + f)) P I ltac:(lra) ltac:(lra) ltac:(rewrite Rabs_pos_eq; lra)) as (g & G & Bg).
    rewrite (Rabs_pos_eq p) in Bg by lra.
    assert (6 * (unit53 * (unit53 * S)) <= 98 / 100 * (share101 * p)).
    { rewrite share_is. replace (98 / 100 * (32 * (unit53 * unit53) * p)) with (unit53 * (unit53 * (98 / 100 * 32 * p))) by ring.
      replace (6 * (unit53 * (unit53 * S))) with (unit53 * (unit53 * (6 * S))) by ring. apply unit_times_compat, unit_times_compat. lra. }
    exists p, q, g. cbn [hi lo error]. rewrite (Rabs_pos_eq p) by lra. repeat (split; [assumption|]). split; [|lra]. split; [lra|].
    assert (s * h <= s * S) by (apply Rmult_le_compat_l; unfold S; lra).
      assert (t * c <= t * S) by (apply Rmult_le_compat_l; unfold S; lra).
    assert (s * (99 / 100 * S) <= s * p) by (apply Rmult_le_compat_l; lra).
      assert (t * (99 / 100 * S) <= t * p) by (apply Rmult_le_compat_l; lra).
    assert (0 <= share101 * p) by (unfold share101; lra). lra.
Qed.
