(* SPDX-License-Identifier: BSD-3-Clause *)
(* Products, quotients and roots in double-double enclose those of the numbers that their operands enclose. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures.
Open Scope R_scope.

Lemma share_is : share101 = 32 * (unit53 * unit53).
Proof. unfold share101, unit53. lra. Qed.

(* ---- Products ---- *)

Lemma product_with_zero : forall a a_lo b b_lo h l c k, is64 a h -> is64 a_lo l -> is64 b c -> is64 b_lo k ->
  h = 0 /\ l = 0 \/ c = 0 /\ k = 0 -> is64 (fst (product_of a a_lo b b_lo)) 0 /\ is64 (snd (product_of a a_lo b b_lo)) 0.
Proof.
  intros a a_lo b b_lo h l c k Ha Hl Hb Hk Hz.
  assert (Z1 : 0 = h * c) by (destruct Hz as [[-> ->]|[-> ->]]; ring). assert (Z2 : 0 = l * k) by (destruct Hz as [[-> ->]|[-> ->]]; ring).
  assert (Z3 : 0 = l * c + 0) by (destruct Hz as [[-> ->]|[-> ->]]; ring). assert (Z4 : 0 = h * k + 0) by (destruct Hz as [[-> ->]|[->
    ->]]; ring).
  unfold product_of. cbv zeta. cbn [fst snd].
  assert (I1 : is64 (times a b) 0) by (apply (times_exact _ _ h c); trivial; [apply generic_format_0|apply zero_is_not_too_large]).
  set (t1 := times a b) in *. assert (I2 : is64 (opp t1) 0) by (rewrite <- Ropp_0; now apply opp_is). set (t2 := opp t1) in *.
  assert (I3 : is64 (fused a b t2) 0).
  { apply (fused_exact _ _ _ h c 0); trivial; [lra|apply generic_format_0|apply zero_is_not_too_large]. }
  set (t3 := fused a b t2) in *.
  assert (I4 : is64 (times a_lo b_lo) 0) by (apply (times_exact _ _ l k); trivial; [apply generic_format_0|apply zero_is_not_too_large]).
  set (t4 := times a_lo b_lo) in *.
  assert (I5 : is64 (fused a_lo b t4) 0) by (apply (fused_exact _ _ _ l c 0); trivial; [apply generic_format_0|apply
    zero_is_not_too_large]).
  set (t5 := fused a_lo b t4) in *.
  assert (I6 : is64 (fused a b_lo t5) 0) by (apply (fused_exact _ _ _ h k 0); trivial; [apply generic_format_0|apply
    zero_is_not_too_large]).
  set (t6 := fused a b_lo t5) in *.
  assert (I7 : is64 (plus t3 t6) 0) by exact_step plus_exact. set (t7 := plus t3 t6) in *.
  assert (I8 : is64 (plus t1 t7) 0) by exact_step plus_exact. set (t8 := plus t1 t7) in *.
  assert (I9 : is64 (minus t8 t1) 0) by exact_step minus_exact. set (t9 := minus t8 t1) in *.
  split; [assumption|]. exact_step minus_exact.
Qed.

(* Nothing is assumed of the size of a number's error where its first term is 0. *)
Lemma nothing_enclosed : forall s a x, encloses s a x -> value64 (hi a) = 0 -> is_exactly a 0 /\ x = 0.
Proof.
  intros s a x (h & l & e & H & L & E & Bl & Be & B) Hz. rewrite (proj1 H) in Hz. subst h. rewrite Rabs_R0, !Rmult_0_r in *.
  pose proof (no_size l Bl). subst l. assert (e = 0) by lra. subst e. pose proof (no_size _ B).
  split; [exact (conj H (conj L E))|lra].
Qed.

Lemma multiply_with_zero : forall s t a b x y, encloses s a x -> encloses t b y -> value64 (hi a) = 0 \/ value64 (hi b) = 0 ->
  is_exactly (multiply a b) 0.
Proof.
  intros s t a b x y Ea Eb Hxy. unfold multiply, rounded.
  assert (Z0 : forall v w, is64 v 0 -> is64 w 0 -> is64 (plus v w) 0) by (intros v w Hv Hw; exact_step plus_exact).
  assert (zero : forall h l e c k f, is64 (hi a) h -> is64 (lo a) l -> is64 (error a) e -> is64 (hi b) c -> is64 (lo b) k -> is64 (error b)
    f ->
    (h = 0 /\ l = 0) /\ e = 0 \/ (c = 0 /\ k = 0) /\ f = 0 -> is_exactly (multiply a b) 0).
  { intros h l e c k f H L E H' L' E' Hz. unfold multiply, rounded, is_exactly. cbn [hi lo error].
    destruct (product_with_zero _ _ _ _ _ _ _ _ H L H' L' ltac:(tauto)) as [P Q]. split; [exact P|]. split; [exact Q|].
    apply error_of_nothing; [exact P|]. apply Z0; [apply Z0|].
    - apply (times_exact _ _ (Rabs h) f); trivial; [now apply absolute_is|destruct Hz as [[[-> _] _]|[_ ->]]; rewrite ?Rabs_R0; ring|
        apply generic_format_0|apply zero_is_not_too_large].
    - apply (times_exact _ _ (Rabs c) e); trivial; [now apply absolute_is|destruct Hz as [[_ ->]|[[-> _] _]]; rewrite ?Rabs_R0; ring|
        apply generic_format_0|apply zero_is_not_too_large].
    - apply (times_exact _ _ e f); trivial; [destruct Hz as [[_ ->]|[_ ->]]; ring|apply generic_format_0|apply zero_is_not_too_large]. }
  destruct Hxy as [Hz|Hz].
  - destruct (nothing_enclosed _ _ _ Ea Hz) as ((H & L & E) & _). destruct Eb as (c & k & f & H' & L' & E' & _).
    apply (zero 0 0 0 c k f); try assumption. left. now repeat split.
  - destruct (nothing_enclosed _ _ _ Eb Hz) as ((H' & L' & E') & _). destruct Ea as (h & l & e & H & L & E & _).
    apply (zero h l e 0 0 0); try assumption. right. now repeat split.
Qed.

(* The bound is at least what the operation itself is charged. *)
Definition charged (a : double_double) : Prop := 98 / 100 * (share101 * Rabs (value64 (hi a))) <= value64 (error a).

(* Sizes are those of the first terms: an operand may have cancelled so far that its error is as large as it is. *)
Theorem multiply_encloses : forall s t a b x y, let M := Rabs (value64 (hi a)) * Rabs (value64 (hi b)) in
  encloses s a x -> encloses t b y -> 0 <= s <= 100 -> 0 <= t <= 100 -> s * t <= / 1000 * (s + t) ->
  M = 0 \/ / 10000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000 <= M <= 1000000000000 ->
  encloses (3 * (s + t) + 3 * share101) (multiply a b) (x * y) /\ charged (multiply a b) /\
    99 / 100 * M <= Rabs (value64 (hi (multiply a b))) <= 101 / 100 * M.
Proof.
  intros s t a b x y M Ea Eb Hs Ht Hst HM. assert (Hshare : 0 < share101) by (unfold share101; lra).
  destruct (Req_dec M 0) as [H0|Hne].
  { assert (Hz : value64 (hi a) = 0 \/ value64 (hi b) = 0).
    { unfold M in H0. rewrite <- Rabs_mult in H0. destruct (Req_dec (value64 (hi a) * value64 (hi b)) 0) as [E|E];
      [now apply Rmult_integral|].
      pose proof (Rabs_pos_lt _ E). lra. }
    pose proof (multiply_with_zero s t a b x y Ea Eb Hz) as I.
    assert (Exy : x * y = 0).
    { destruct Hz as [Hz|Hz]; [destruct (nothing_enclosed _ _ _ Ea Hz) as [_ ->]|destruct (nothing_enclosed _ _ _ Eb Hz) as [_ ->]]; ring. }
    rewrite Exy. split; [apply encloses_more with 0; [now apply encloses_exact|lra]|]. destruct I as ([V _] & _ & [V' _]).
    unfold charged. rewrite V, V', H0, Rabs_R0. lra. }
  assert (Hsize : / 10000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000 <= M <=
      1000000000000) by (destruct HM; [contradiction|assumption]). clear HM Hne.
  destruct Ea as (h & l & e & H & L & E & Bl & Be & B), Eb as (c & k & f & H' & L' & E' & Bk & Bf & B').
  assert (EM : M = Rabs h * Rabs c) by (unfold M; now rewrite (proj1 H), (proj1 H')). clearbody M. subst M.
  pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  pose proof (Rabs_pos h) as Ph. pose proof (Rabs_pos c) as Pc. set (M := Rabs h * Rabs c) in *.
  pose proof (unit_times tiny (proj1 Htiny)) as Utiny.
  set (uM := unit53 * M). pose proof (unit_times M ltac:(lra)) as UM. fold uM in UM. pose proof (unit_times uM (proj1 UM)) as UUM.
  pose proof (unit_times _ Ph) as Uh. pose proof (unit_times _ Pc) as Uc.
  assert (Htum : tiny <= / 10000 * (unit53 * uM)) by (unfold uM, unit53; lra).
  destruct (product_of_parts _ _ _ _ h l c k (Rabs h) (Rabs c) H L H' L' (Rle_refl _) (Rle_refl _) ltac:(lra) ltac:(lra) ltac:(fold M; lra)
    ltac:(rewrite Rabs_mult; fold M; lra)) as (p & q & P & Q & Off & Bp & _ & Bq).
  fold M uM in Off, Bp.
  assert (T1 : Rabs (l * c) <= uM) by (apply Rle_trans with (1 := product_size _ _ _ _ Bl (Rle_refl (Rabs c))); unfold uM, M; lra).
  assert (T2 : Rabs (h * k) <= uM) by (apply Rle_trans with (1 := product_size _ _ _ _ (Rle_refl (Rabs h)) Bk); unfold uM, M; lra).
  assert (T3 : Rabs (l * k) <= unit53 * uM).
  { apply Rle_trans with (1 := product_size _ _ _ _ Bl Bk). right. unfold uM, M. ring. }
  assert (Hp : 99 / 100 * M <= Rabs p).
  { assert (G : Rabs (h * c) <= Rabs p + Rabs q + Rabs (p + q - (h + l) * (c + k)) + Rabs (h * k) + Rabs (l * c) + Rabs (l * k)).
    { replace (h * c) with (p + q - (p + q - (h + l) * (c + k)) - h * k - l * c - l * k) by ring.
      repeat (eapply Rle_trans; [apply minus_size|apply Rplus_le_compat_r]). apply Rabs_triang. }
    rewrite Rabs_mult in G. fold M in G. pose proof (unit_times _ (Rabs_pos p)) as Up. lra. }
  (* the bound of the error *)
  set (P1 := Rabs h * f). set (P2 := Rabs c * e). set (P3 := e * f). set (PP := P1 + P2 + P3).
  assert (B1 : 0 <= P1 <= t * M).
  { unfold P1. split; [apply Rmult_le_pos; lra|]. replace (t * M) with (Rabs h * (t * Rabs c)) by (unfold M; ring). apply
    Rmult_le_compat_l; lra. }
  assert (B2 : 0 <= P2 <= s * M).
  { unfold P2. split; [apply Rmult_le_pos; lra|]. replace (s * M) with (Rabs c * (s * Rabs h)) by (unfold M; ring). apply
    Rmult_le_compat_l; lra. }
  assert (B3 : 0 <= P3 <= / 1000 * (s * M + t * M)).
  { unfold P3. split; [apply Rmult_le_pos; lra|]. apply Rle_trans with ((s * Rabs h) * (t * Rabs c)); [apply Rmult_le_compat; lra|].
    replace ((s * Rabs h) * (t * Rabs c)) with (s * t * M) by (unfold M; ring).
    replace (/ 1000 * (s * M + t * M)) with (/ 1000 * (s + t) * M) by ring. apply Rmult_le_compat_r; lra. }
  assert (BsM : 0 <= s * M <= 100 * M) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (BtM : 0 <= t * M <= 100 * M) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  pose proof (times_is _ _ _ _ (absolute_is _ _ H) E' ltac:(apply big_enough; fold P1; rewrite Rabs_pos_eq; lra)) as J1.
  pose proof (times_is _ _ _ _ (absolute_is _ _ H') E ltac:(apply big_enough; fold P2; rewrite Rabs_pos_eq; lra)) as J2.
  pose proof (times_is _ _ _ _ E E' ltac:(apply big_enough; fold P3; rewrite Rabs_pos_eq; lra)) as J3.
  fold P1 in J1. fold P2 in J2. fold P3 in J3.
  pose proof (rounded_near P1 (proj1 B1)) as R1. pose proof (rounded_near P2 (proj1 B2)) as R2. pose proof (rounded_near P3 (proj1 B3)) as
    R3.
  pose proof (proj1 (rounded_up _ _ (conj (proj1 B1) (Rle_refl P1)))) as N1. pose proof (proj1 (rounded_up _ _ (conj (proj1 B2) (Rle_refl
    P2)))) as N2.
  pose proof (proj1 (rounded_up _ _ (conj (proj1 B3) (Rle_refl P3)))) as N3.
  pose proof (unit_times P1 (proj1 B1)) as U1. pose proof (unit_times P2 (proj1 B2)) as U2. pose proof (unit_times P3 (proj1 B3)) as U3.
  set (v1 := nearest64 P1) in *. set (v2 := nearest64 P2) in *. set (v3 := nearest64 P3) in *.
  pose proof (plus_is _ _ _ _ J1 J2 ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J4.
  pose proof (rounded_near (v1 + v2) ltac:(lra)) as R4. pose proof (proj1 (rounded_up (v1 + v2) (v1 + v2) ltac:(lra))) as N4.
  assert (U4 : unit53 * (v1 + v2) <= unit53 * (2 * (P1 + P2) + 2 * tiny)) by (apply unit_times_compat; lra).
  set (v4 := nearest64 (v1 + v2)) in *.
  pose proof (plus_is _ _ _ _ J4 J3 ltac:(apply big_enough; rewrite Rabs_pos_eq; unfold PP in *; lra)) as J5.
  pose proof (rounded_near (v4 + v3) ltac:(lra)) as R5. pose proof (proj1 (rounded_up (v4 + v3) (v4 + v3) ltac:(lra))) as N5.
  assert (U5 : unit53 * (v4 + v3) <= unit53 * (2 * PP + 6 * tiny)) by (apply unit_times_compat; unfold PP; lra).
  set (v := nearest64 (v4 + v3)) in *. pose proof (unit_times PP ltac:(unfold PP; lra)) as UPP.
  assert (EPP : unit53 * PP = unit53 * P1 + unit53 * P2 + unit53 * P3) by (unfold PP; ring).
  assert (Vlow : PP - 7 * (unit53 * PP) - 6 * tiny <= v) by (unfold PP in *; lra).
  assert (Vhigh : v <= 101 / 100 * PP + 8 * tiny) by (unfold PP in *; lra).
  assert (Uv : unit53 * (PP - 7 * (unit53 * PP) - 6 * tiny) <= unit53 * v) by (apply unit_times_compat; exact Vlow).
  pose proof (unit_times _ (proj1 UPP)) as UUPP.
  destruct (error_covers _ p _ v (101 / 100 * PP + 8 * tiny) P J5 ltac:(lra) ltac:(unfold PP in *; lra) ltac:(lra)) as (g & G & Bg).
  assert (Hshare_p : 99 / 100 * (32 * (unit53 * uM)) <= share101 * Rabs p).
  { rewrite share_is. replace (32 * (unit53 * unit53) * Rabs p) with (unit53 * (unit53 * (32 * Rabs p))) by ring.
    replace (99 / 100 * (32 * (unit53 * uM))) with (unit53 * (unit53 * (32 * (99 / 100 * M)))) by (unfold uM; ring).
    apply unit_times_compat, unit_times_compat. lra. }
  assert (Hcharged : charged (multiply a b)).
  { unfold charged, multiply, rounded. cbn [hi lo error]. rewrite (proj1 P), (proj1 G). pose proof (unit_times v N5). lra. }
  split; [|split; [exact Hcharged|unfold multiply, rounded; cbn [hi]; rewrite (proj1 P); lra]].
  exists p, q, g. unfold multiply, rounded. cbn [hi lo error].
  split; [exact P|]. split; [exact Q|]. split; [exact G|]. split; [exact Bq|]. split.
  - assert (s * M <= s * (102 / 100 * Rabs p)) by (apply Rmult_le_compat_l; lra).
    assert (t * M <= t * (102 / 100 * Rabs p)) by (apply Rmult_le_compat_l; lra).
    assert (0 <= s * Rabs p) by (apply Rmult_le_pos; [lra|apply Rabs_pos]). assert (0 <= t * Rabs p) by (apply Rmult_le_pos; [lra|apply
      Rabs_pos]).
    unfold PP in *. lra.
  - replace (p + q - x * y) with ((p + q - (h + l) * (c + k)) + ((h + l) * (c + k - y) + (h + l - x) * (c + k) - (h + l - x) * (c + k -
    y))) by ring.
    apply Rle_trans with (1 := Rabs_triang _ _).
    pose proof (minus_size ((h + l) * (c + k - y) + (h + l - x) * (c + k)) ((h + l - x) * (c + k - y))) as D1.
    pose proof (Rabs_triang ((h + l) * (c + k - y)) ((h + l - x) * (c + k))) as D2.
    assert (D3 : Rabs ((h + l) * (c + k - y)) <= P1 + unit53 * P1).
    { replace (P1 + unit53 * P1) with ((Rabs h + unit53 * Rabs h) * f) by (unfold P1; ring). apply product_size; [|exact B'].
      apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    assert (D4 : Rabs ((h + l - x) * (c + k)) <= P2 + unit53 * P2).
    { replace (P2 + unit53 * P2) with (e * (Rabs c + unit53 * Rabs c)) by (unfold P2; ring). apply product_size; [exact B|].
      apply Rle_trans with (1 := Rabs_triang _ _). lra. }
    assert (D5 : Rabs ((h + l - x) * (c + k - y)) <= P3) by (now apply product_size).
    assert (unit53 * (6 * tiny) <= tiny) by lra. unfold PP in *. lra.
Qed.

(* The same where the operands are good, in terms of the exact numbers. *)
Theorem encloses_multiply : forall s t a b x y, encloses s a x -> encloses t b y -> 0 <= s <= / 1000 -> 0 <= t <= / 1000 ->
  x = 0 \/ y = 0 \/ / 1000000000000000000000000000000 <= Rabs (x * y) <= 100000000 -> encloses (3 * (s + t) + 3 * share101) (multiply a b)
    (x * y).
Proof.
  intros s t a b x y Ea Eb Hs Ht Hxy. pose proof (first_size _ _ _ Ea Hs) as Sa. pose proof (first_size _ _ _ Eb Ht) as Sb.
  pose proof (Rabs_pos x) as Px. pose proof (Rabs_pos y) as Py. rewrite Rabs_mult in Hxy.
  apply multiply_encloses; trivial; [lra|lra|assert (s * t <= s * / 1000) by (apply Rmult_le_compat_l; lra); lra|].
    set (h := Rabs (value64 (hi a))) in *. set (c := Rabs (value64 (hi b))) in *.
  destruct Hxy as [->|[->|Hxy]]; [left; rewrite Rabs_R0 in Sa; replace h with 0 by lra; ring|
    left; rewrite Rabs_R0 in Sb; replace c with 0 by lra; ring|right]. split.
  - apply Rle_trans with ((99 / 100 * Rabs x) * (99 / 100 * Rabs y)); [lra|apply Rmult_le_compat; lra].
  - apply Rle_trans with ((101 / 100 * Rabs x) * (101 / 100 * Rabs y)); [apply Rmult_le_compat; lra|lra].
Qed.
