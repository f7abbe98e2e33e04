(* SPDX-License-Identifier: BSD-3-Clause *)
(* Double-double's bound of its error is one: the exact number is no further from the two terms than the bound says. Products,
   quotients and roots of numbers of either sign, and sums of two numbers of binary64: fast/numbers/double_double.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms.
Open Scope R_scope.

(* s: the bound is no more than this share of the first term. *)
Definition encloses (s : R) (a : double_double) (x : R) : Prop :=
  exists h l e, is64 (hi a) h /\ is64 (lo a) l /\ is64 (error a) e /\ Rabs l <= unit53 * Rabs h /\ 0 <= e <= s * Rabs h /\
    Rabs (h + l - x) <= e.

Lemma encloses_exact : forall a x, is_exactly a x -> encloses 0 a x.
Proof.
  intros a x (H & L & E). pose proof unit_is_small. exists x, 0, 0. split; [exact H|]. split; [exact L|]. split; [exact E|].
  rewrite Rabs_R0. pose proof (Rabs_pos x). split; [apply Rmult_le_pos; lra|]. split; [lra|]. rewrite nothing_off; lra.
Qed.

Lemma encloses_more : forall s t a x, encloses s a x -> s <= t -> encloses t a x.
Proof.
  intros s t a x (h & l & e & H & L & E & Bl & Be & B) Hs. exists h, l, e. repeat (split; [assumption|]). split; [|exact B].
  split; [lra|]. apply Rle_trans with (1 := proj2 Be). apply Rmult_le_compat_r; [apply Rabs_pos|exact Hs].
Qed.

Lemma enclosed_size : forall s h l e x, Rabs l <= unit53 * Rabs h -> 0 <= e <= s * Rabs h -> Rabs (h + l - x) <= e -> 0 <= s <= / 1000 ->
  99 / 100 * Rabs x <= Rabs h <= 101 / 100 * Rabs x.
Proof.
  intros s h l e x Bl Be B Hs. pose proof (Rabs_pos h) as P. pose proof (unit_times _ P) as U.
  assert (S : s * Rabs h <= / 1000 * Rabs h) by (apply Rmult_le_compat_r; lra).
  assert (D : Rabs (h - x) <= / 500 * Rabs h).
  { replace (h - x) with ((h + l - x) - l) by ring. apply Rle_trans with (1 := minus_size _ _). lra. }
  pose proof (size_by h x) as S1. pose proof (size_by x h) as S2. rewrite (Rabs_minus_sym x h) in S2. lra.
Qed.

Lemma first_size : forall s a x, encloses s a x -> 0 <= s <= / 1000 -> 99 / 100 * Rabs x <= Rabs (value64 (hi a)) <= 101 / 100 * Rabs x.
Proof.
  intros s a x (h & l & e & [<- _] & _ & _ & Bl & Be & B) Hs. exact (enclosed_size _ _ _ _ _ Bl Be B Hs).
Qed.

Lemma no_size : forall a, Rabs a <= 0 -> a = 0.
Proof. intros a H. destruct (Req_dec a 0) as [|Hne]; [assumption|]. pose proof (Rabs_pos_lt a Hne). lra. Qed.

Lemma enclosed_zero : forall s a, encloses s a 0 -> 0 <= s <= / 1000 -> is_exactly a 0.
Proof.
  intros s a (h & l & e & H & L & E & Bl & Be & B) Hs. pose proof (enclosed_size _ _ _ _ _ Bl Be B Hs) as S. rewrite Rabs_R0 in S.
  assert (H0 : Rabs h = 0) by lra. rewrite H0, Rmult_0_r in Bl, Be.
  rewrite (no_size h ltac:(lra)) in H. rewrite (no_size l Bl) in L. replace e with 0 in E by lra. split; [exact H|now split].
Qed.

Lemma is64_same : forall v a b, is64 v a -> is64 v b -> a = b.
Proof. intros v a b [<- _] [<- _]. reflexivity. Qed.

(* ---- The bound covers what it is charged for ---- *)

Lemma error_covers : forall v x propagated p b, is64 v x -> is64 propagated p -> 0 <= p <= b ->
  b <= 1000000000000000000000000000000000000000000000 ->
  / 100000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000 <= Rabs x <=
      1000000000000000000000000000000000000000000000 ->
  exists e, is64 (error_of v propagated) e /\ p + 2000 * (unit53 * p) + 98 / 100 * (share101 * Rabs x) <= e <= 201 / 100 * (b + share101 *
    Rabs x).
Proof.
  intros v x propagated p b Hv Hp Hpb Hb Hx. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  destruct (error_of_is v x propagated p b Hv Hp Hpb ltac:(lra) ltac:(lra)) as (e & E & Be & _). exists e. split; [exact E|].
  assert (Ht : tiny <= / 10000 * (share101 * Rabs x)) by (unfold share101; lra). split; [|lra].
  assert (K : bpow radix2 (-101) = share101) by (unfold share101; simpl; lra).
  pose proof (two_to_is (-101) ltac:(lia)) as I1. rewrite K in I1. set (sx := share101 * Rabs x) in *.
  assert (Hsx : 0 <= sx <= 1000000000000000) by (unfold sx, share101; lra).
  pose proof (times_is _ _ _ _ I1 (absolute_is _ _ Hv) ltac:(apply big_enough; fold sx; rewrite Rabs_pos_eq; lra)) as I2. fold sx in I2.
  pose proof (product_is_close sx) as C1. rewrite (Rabs_pos_eq sx) in C1 by lra. set (t := nearest64 sx) in *.
  pose proof (unit_times sx ltac:(lra)) as U1. apply Rabs_le_inv in C1.
  pose proof (plus_is _ _ _ _ Hp I2 ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as I3.
  pose proof (sum_is_close p t (format_of _ _ Hp) (format_of _ _ I2)) as C2. set (m := p + t) in *. set (s := nearest64 m) in *.
  assert (Hm : 0 <= m) by (unfold m; lra). pose proof (unit_times m Hm) as U2. rewrite (Rabs_pos_eq m) in C2 by lra. apply Rabs_le_inv in
    C2.
  pose proof (constant_is (2 ^ 40 + 1) (-40) ltac:(lia) ltac:(lia)) as I4. fold slack in I4.
  assert (Ek : IZR (2 ^ 40 + 1) * bpow radix2 (-40) = 1 + 8192 * unit53) by (unfold unit53; simpl; lra). rewrite Ek in I4.
  assert (Eks : (1 + 8192 * unit53) * s = s + 8192 * (unit53 * s)) by ring. pose proof (unit_times s ltac:(lra)) as U3.
  pose proof (times_is _ _ _ _ I4 I3 ltac:(apply big_enough; rewrite Eks, Rabs_pos_eq; unfold m in *; lra)) as I5.
  change (times slack (plus propagated (times (two_to (-101)) (absolute v)))) with (error_of v propagated) in I5.
  rewrite (is64_same _ _ _ E I5). pose proof (product_is_close ((1 + 8192 * unit53) * s)) as C3. rewrite Eks in C3 |- *.
  rewrite (Rabs_pos_eq (s + _)) in C3 by lra. apply Rabs_le_inv in C3.
  assert (U4 : unit53 * (s + 8192 * (unit53 * s)) <= unit53 * (2 * s)) by (apply unit_times_compat; lra).
  assert (U5 : unit53 * (99 / 100 * m) <= unit53 * s) by (apply unit_times_compat; lra).
  assert (U6 : unit53 * (p + 99 / 100 * sx - / 10000 * sx) <= unit53 * m) by (apply unit_times_compat; unfold m; lra). unfold m in *. lra.
Qed.

(* It is never smaller than what is propagated, and larger by the slack where that is not tiny. *)
Lemma error_is_at_least : forall v x propagated p, is64 v x -> is64 propagated p ->
  0 <= p <= 1000000000000000000000000000000000000000000000 -> Rabs x <= 1000000000000000000000000000000000000000000000 ->
  exists e, is64 (error_of v propagated) e /\ p <= e /\ p + 8000 * (unit53 * p) - tiny <= e.
Proof.
  intros v x propagated p Hv Hp Hpb Hx. pose proof unit_is_small as Hu.
  pose proof (Rabs_pos x) as Px. assert (K : bpow radix2 (-101) = share101) by (unfold share101; simpl; lra).
  pose proof (two_to_is (-101) ltac:(lia)) as I1. rewrite K in I1. set (sx := share101 * Rabs x).
  assert (Hsx : 0 <= sx <= 1000000000000000) by (unfold sx, share101; lra).
  assert (nonneg : forall a b, 0 <= a <= b -> 0 <= nearest64 a <= b * (1 + unit53) + tiny) by exact rounded_up.
  pose proof tiny_is_tiny as Htiny.
  pose proof (times_is _ _ _ _ I1 (absolute_is _ _ Hv) ltac:(apply big_enough; fold sx; rewrite Rabs_pos_eq; lra)) as I2. fold sx in I2.
  pose proof (nonneg sx 1000000000000000 Hsx) as B1. set (t := nearest64 sx) in *.
  pose proof (plus_is _ _ _ _ Hp I2 ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as I3.
  pose proof (nonneg (p + t) 10000000000000000000000000000000000000000000000 ltac:(lra)) as B2.
  assert (L1 : p <= nearest64 (p + t)).
  { rewrite <- (round_generic radix2 fexp64 ZnearestE p) at 1 by (now apply format_of in Hp). apply round_le; auto with
    typeclass_instances. lra. }
  set (s := nearest64 (p + t)) in *.
  pose proof (constant_is (2 ^ 40 + 1) (-40) ltac:(lia) ltac:(lia)) as I4. fold slack in I4. set (k := IZR _ * _) in I4.
  assert (Hk : 1 + 8192 * unit53 <= k <= 2) by (unfold k, unit53; simpl; lra). clearbody k.
  assert (Hks : (1 + 8192 * unit53) * s <= k * s <= 2 * s) by (split; apply Rmult_le_compat_r; lra).
  pose proof (unit_times s ltac:(lra)) as Us. pose proof (unit_times p ltac:(lra)) as Up. pose proof (unit_times_compat _ _ L1) as Ups.
  pose proof (times_is _ _ _ _ I4 I3 ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as I5.
  exists (nearest64 (k * s)). split; [exact I5|]. split.
  - apply Rle_trans with s; [exact L1|].
    rewrite <- (round_generic radix2 fexp64 ZnearestE s) at 1 by (now apply format_of in I3). apply round_le; auto with typeclass_instances.
    lra.
  - apply Rle_trans with (nearest64 ((1 + 8192 * unit53) * s)); [|apply round_le; auto with typeclass_instances; lra].
    pose proof (product_is_close ((1 + 8192 * unit53) * s)) as C. rewrite (Rabs_pos_eq ((1 + 8192 * unit53) * s)) in C by lra.
    apply Rabs_le_inv in C. replace (unit53 * ((1 + 8192 * unit53) * s)) with (unit53 * s + 8192 * (unit53 * (unit53 * s))) in C by ring.
    pose proof (unit_times (unit53 * s) ltac:(lra)) as UUs. replace ((1 + 8192 * unit53) * s) with (s + 8192 * (unit53 * s)) in *
      by ring. lra.
Qed.

Lemma error_of_nothing : forall v propagated, is64 v 0 -> is64 propagated 0 -> is64 (error_of v propagated) 0.
Proof.
  intros v propagated Hv Hp. destruct (error_of_is v 0 propagated 0 0 Hv Hp ltac:(lra) ltac:(lra) ltac:(rewrite Rabs_R0; lra)) as (e & E &
    _ & Z).
  now rewrite (Z eq_refl eq_refl) in E.
Qed.

(* Rounding up or down a number that is not negative. *)
Lemma rounded_near : forall a, 0 <= a -> a - unit53 * a - tiny <= nearest64 a <= a + unit53 * a + tiny.
Proof. intros a Ha. pose proof (product_is_close a) as C. rewrite (Rabs_pos_eq a) in C by exact Ha. apply Rabs_le_inv in C. lra. Qed.

(* ---- The sum of two numbers of binary64 ---- *)

Theorem encloses_sum_of_either_sign : forall a b x y, is_exactly a x -> is_exactly b y -> Rabs x <= 100000000 -> Rabs y <= 100000000 ->
  x + y = 0 \/ / 100000000000000000000 <= Rabs (x + y) -> encloses (3 * share101) (add a b) (x + y).
Proof.
  intros a b x y (H & L & E) (H' & L' & E') Bx By Hxy. pose proof unit_is_small as Hu.
  assert (B0 : Rabs 0 + Rabs 0 <= 0) by (rewrite Rabs_R0; lra).
  destruct (sum_of_cancels _ _ _ _ x 0 y 0 0 H L H' L' ltac:(lra) ltac:(lra) B0 ltac:(lra)) as (p & q & P & Q & Off & Bp & Bq & T & _).
  replace (x + 0 + (y + 0)) with (x + y) in Off by ring. rewrite !Rplus_0_r in *. rewrite Rmult_0_r, Rplus_0_r in Bq.
  assert (Ie : is64 (plus (error a) (error b)) 0) by exact_step plus_exact. unfold add, rounded.
  set (S := Rabs (x + y)) in *. assert (PS : 0 <= S) by apply Rabs_pos. destruct (Req_dec S 0) as [HS|HS].
  - rewrite HS, !Rmult_0_r in *. assert (p = 0) as -> by (apply no_size; lra).
    assert (q = 0) as -> by (apply no_size; lra). rewrite (no_size (x + y) ltac:(fold S; lra)).
    apply encloses_more with 0; [|unfold share101; lra]. apply encloses_exact. split; [exact P|]. split; [exact Q|]. cbn [error].
    now apply error_of_nothing.
  - assert (LS : / 100000000000000000000 <= S).
    { destruct Hxy as [Hxy|Hxy]; [|exact Hxy]. exfalso. apply HS. unfold S. rewrite Hxy. apply Rabs_R0. }
    specialize (T ltac:(lra)). pose proof (Rabs_triang x y) as Tr. fold S in Tr.
    pose proof (unit_times S PS) as U. pose proof (unit_times _ (proj1 U)) as UU.
    assert (Off2 : Rabs (p + q - (x + y)) <= 21 / 10 * (unit53 * (unit53 * S))) by lra.
    assert (Hp : 99 / 100 * S <= Rabs p).
    { pose proof (size_by (x + y) (p + q)) as D. rewrite (Rabs_minus_sym (x + y)) in D. fold S in D. pose proof (Rabs_triang p q).
      pose proof (unit_times _ (Rabs_pos p)). lra. }
    destruct (error_covers _ p _ 0 0 P Ie ltac:(lra) ltac:(lra) ltac:(lra)) as (e & Ee & Be).
    exists p, q, e. cbn [hi lo error]. split; [exact P|]. split; [exact Q|]. split; [exact Ee|]. split; [exact T|].
    assert (share101 = 32 * (unit53 * unit53)) as Es by (unfold share101, unit53; lra).
    assert (31 * (unit53 * (unit53 * S)) <= 98 / 100 * (share101 * Rabs p)).
    { rewrite Es. replace (98 / 100 * (32 * (unit53 * unit53) * Rabs p)) with (unit53 * (unit53 * (98 / 100 * (32 * Rabs p)))) by ring.
      replace (31 * (unit53 * (unit53 * S))) with (unit53 * (unit53 * (31 * S))) by ring. apply unit_times_compat, unit_times_compat. lra. }
    split; [unfold share101 in *; lra|lra].
Qed.

Theorem encloses_sum : forall a b x y, is_exactly a x -> is_exactly b y -> Rabs x <= 100000000 -> Rabs y <= 100000000 ->
  x + y = 0 \/ / 100000000000000000000 <= x + y -> encloses (3 * share101) (add a b) (x + y).
Proof.
  intros a b x y Ia Ib Bx By Hxy. apply encloses_sum_of_either_sign; trivial.
  destruct Hxy as [Hxy|Hxy]; [now left|right; rewrite Rabs_pos_eq; lra].
Qed.
