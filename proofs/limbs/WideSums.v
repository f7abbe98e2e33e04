(* SPDX-License-Identifier: BSD-3-Clause *)
(* Sums and products on limbs and 64-bit exponents give the limbs of those of integers, as proofs/limbs/WideRefined.v says. *)
From Coq Require Import ZArith Reals Lia List Bool.
From Flocq Require Import Core.
From Forceshade Require Import BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients.
From Forceshade Require Import Limbs LimbShifts LimbNumbers LimbsAreDigits WideNumbers WideRefined.
Import ListNotations.
Open Scope Z_scope.

Lemma lowest_limb_is : forall l, l <> [] -> (lowest_limb l < length l)%nat /\ l = repeat 0 (lowest_limb l) ++ skipn (lowest_limb l) l.
Proof.
  induction l as [|a l IH]; intro H; [congruence|]. destruct l as [|b l]; [split; [cbn; lia|reflexivity]|].
  change (lowest_limb (a :: b :: l)) with (if a =? 0 then S (lowest_limb (b :: l)) else O).
  destruct (Z.eqb_spec a 0) as [->|N]; [|split; [cbn; lia|reflexivity]]. destruct IH as [L E]; [discriminate|].
  split; [cbn [length] in *; lia|]. cbn [repeat app skipn]. f_equal. exact E.
Qed.

(* The loops of the product leave out limbs at the bottom that are 0. *)
Lemma product_of_limbs_is : forall l m, l <> [] -> length l = length m -> Forall is_limb l -> Forall is_limb m ->
  product_of_limbs l m = multiply_limbs l m (repeat 0 (length m)).
Proof.
  intros l m Hl L Fl Fm. assert (Hm : m <> []) by (destruct l, m; cbn in L; congruence). unfold product_of_limbs.
  destruct (lowest_limb_is l Hl) as [Li Ei]. destruct (lowest_limb_is m Hm) as [Lj Ej].
  set (i := lowest_limb l) in *. set (j := lowest_limb m) in *.
  assert (Wl : whole l = base ^ Z.of_nat i * whole (skipn i l)).
  { rewrite Ei at 1. rewrite whole_app, whole_zeros, (size_of_length _ i) by apply repeat_length. ring. }
  assert (Wm : whole m = base ^ Z.of_nat j * whole (skipn j m)).
  { rewrite Ej at 1. rewrite whole_app, whole_zeros, (size_of_length _ j) by apply repeat_length. ring. }
  assert (Hs : skipn j m <> []) by (intro H; apply (f_equal (@length Z)) in H; rewrite skipn_length in H; cbn in H; lia).
  destruct (limbs_multiply (skipn j m) (skipn i l) (repeat 0 (length m - j)) ltac:(now rewrite repeat_length, skipn_length) Hs
    (Forall_skipn i l Fl) (Forall_skipn j m Fm) (zeros_are_limbs _)) as (F1 & L1 & W1).
  destruct (limbs_multiply m l (repeat 0 (length m)) ltac:(now rewrite repeat_length) Hm Fl Fm (zeros_are_limbs _)) as (F2 & L2 & W2).
  rewrite !skipn_length in L1. apply whole_is_injective; [|apply Forall_app; split; [apply zeros_are_limbs|exact F1]|exact F2|].
  - rewrite app_length, repeat_length, L1, L2. lia.
  - rewrite whole_app, whole_zeros, (size_of_length _ (i + j)) by apply repeat_length. rewrite W1, W2, !whole_zeros, Wl, Wm.
    rewrite Nat2Z.inj_add, Z.pow_add_r by lia. ring.
Qed.

Section Refined.
Context (outside : Z -> Z) (count : nat) (enough : (2 <= count <= 64)%nat).
Local Notation width := (64 * Z.of_nat count).
Local Notation limbs_hold := (limbs_hold count).

(* ---- Sums ---- *)

Lemma is_larger_holds : forall k l a j m b, limbs_hold k l a -> limbs_hold j m b -> wide_is_larger l m = is_larger a b.
Proof.
  intros k l a j m b Ha Hb. unfold wide_is_larger.
  rewrite (is_larger_in_limbs width a b _ _ (holds_limbs count enough k l a Ha) (holds_limbs count enough j m b Hb)).
  destruct (parts count enough k l a Ha) as (_ & -> & _). now destruct (parts count enough j m b Hb) as (_ & -> & _).
Qed.

Lemma normalised_keeps : forall below l, is_limb below -> Forall is_limb l ->
  Forall is_limb (fst (normalised_limbs below l)) /\ length (fst (normalised_limbs below l)) = length l.
Proof.
  intros below l B F. destruct (Z.eq_dec (whole l) 0) as [Z|Z].
  - unfold normalised_limbs. rewrite (proj2 (top_of_zero l F) Z). now split.
  - pose proof (limbs_normalised below l B F Z) as S. destruct (normalised_limbs below l) as [r up]. cbn [fst]. tauto.
Qed.

(* What is added has the exponent of the larger one. *)
Lemma add_limbs_holds : forall k l a m, k <= range -> limbs_hold k l a -> length m = count -> Forall is_limb m ->
  let r := wide_add_limbs outside count l m in
  integer_of r = add_limbs width a (whole m) /\ length (limbs r) = count /\ Forall is_limb (limbs r).
Proof.
  intros k l a m K H Lm Fm r. pose proof (holds_limbs count enough k l a H) as HL. pose proof H as ((_ & L & F) & _ & E & _).
  pose proof (add_in_limbs width a (limbs l) m HL ltac:(lia) Fm) as S. destruct HL as (Hne & _).
  pose proof (limbs_added (limbs l) m Hne ltac:(lia) F Fm) as D. cbv zeta in S, D. unfold r, wide_add_limbs. cbv zeta.
  destruct (parts count enough k l a H) as (-> & -> & -> & _). destruct (added_limbs (limbs l) m) as [[s carried] dropped].
  destruct D as (Fs & Ls & _). rewrite S. unfold integer_of, bits_of_all. cbn [limbs is_negative binary_exponent error_exponent].
  split; [|split; [lia|exact Fs]]. destruct carried, dropped; exact64; reflexivity.
Qed.

Lemma subtract_limbs_holds : forall k l a m, k <= range -> limbs_hold k l a -> length m = count -> Forall is_limb m -> whole m <=
  digits a ->
  let r := wide_subtract_limbs outside l m in
  integer_of r = subtract_limbs width a (whole m) /\ length (limbs r) = count /\ Forall is_limb (limbs r).
Proof.
  intros k l a m K H Lm Fm B r. pose proof (holds_limbs count enough k l a H) as HL. pose proof H as ((_ & L & F) & _ & E & _).
  pose proof (parts count enough k l a H) as (P1 & P2 & P3 & P4). rewrite <- P4 in B.
  pose proof (subtract_in_limbs width a (limbs l) m HL ltac:(lia) Fm B) as S. cbv zeta in S. rewrite S.
  destruct (limbs_subtract_smaller (limbs l) m ltac:(lia) F Fm B) as [Fd _].
  assert (Ld : length (fst (subtract_with (limbs l) m 0)) = count).
  { pose proof (limbs_subtract (limbs l) m 0 ltac:(lia) F Fm ltac:(lia)) as T. destruct (subtract_with (limbs l) m 0).
    cbn [fst]. destruct T as (_ & T & _). lia. }
  unfold r, wide_subtract_limbs, wide_normalised. cbn [limbs is_negative binary_exponent error_exponent]. rewrite P1, P2, P3.
  set (d := fst (subtract_with (limbs l) m 0)) in *. pose proof (top_of_zero d Fd) as T.
  pose proof (normalised_keeps 0 d ltac:(unfold is_limb; rewrite base_is; lia) Fd) as [Fn Ln].
  destruct (top d) as [|j] eqn:Et.
  - assert (W : whole d = 0) by now apply T. rewrite W. change (0 =? 0) with true. cbv iota. unfold integer_of.
    cbn [limbs is_negative binary_exponent error_exponent]. rewrite W. now split.
  - assert (W : whole d <> 0) by (intro W; apply T in W; discriminate). rewrite (proj2 (Z.eqb_neq _ _) W).
    pose proof (limbs_normalised 0 d ltac:(unfold is_limb; rewrite base_is; lia) Fd W) as Q.
    assert (B2 : bits_of d = width) by (unfold bits_of; now rewrite Ld). pose proof (Z.log2_nonneg (whole d)).
    destruct (normalised_limbs 0 d) as [moved up]. cbn [fst] in Fn, Ln. destruct Q as (_ & _ & U0 & U1 & _). rewrite B2 in U1.
    unfold integer_of. cbn [limbs is_negative binary_exponent error_exponent]. exact64.
    split; [reflexivity|]. split; [lia|exact Fn].
Qed.

Lemma add_smaller_holds : forall k l a m b, k <= range -> limbs_hold k l a -> limbs_hold k m b -> is_zero a = false -> is_zero b = false ->
  is_larger a b = true -> let r := wide_add_smaller outside count l m in
  integer_of r = add_smaller width a b /\ length (limbs r) = count /\ Forall is_limb (limbs r).
Proof.
  intros k l a m b K Ha Hb Za Zb Hl r. pose proof Ha as (_ & Na & Ea & Ra). pose proof Hb as (_ & Nb & Eb & Rb).
  destruct (top_of_normal _ _ Na Za) as [La Ua]. destruct (top_of_normal _ _ Nb Zb) as [Lb Ub].
  pose proof (double_power width ltac:(lia)) as D. pose proof (power_pos (width - 1) ltac:(lia)) as P.
  assert (E : exponent b <= exponent a) by (unfold is_larger in Hl; destruct (Z.eqb_spec (exponent a) (exponent b)); lia).
  destruct (shifted_is width (exponent a) b ltac:(lia) Nb E) as (Q0 & Q1 & _).
  pose proof (shift_in_limbs width b (limbs m) (exponent a - exponent b) (holds_limbs count enough k m b Hb) ltac:(lia) ltac:(lia)) as S.
  unfold r, wide_add_smaller, add_smaller.
  destruct (parts count enough k l a Ha) as (P1 & P2 & P3 & P4). destruct (parts count enough k m b Hb) as (M1 & M2 & M3 & M4).
  rewrite P1, P2, M1, M2, M3.
  rewrite (int64_is outside (exponent a - exponent b)) by (numbers64; lia).
  destruct (shift_right_limbs (exponent a - exponent b) (limbs m)) as [shifted lost]. destruct S as ((Hs & Fs & Ws & Ds) & ->).
  cbn [digits] in Ds. assert (Ls : length shifted = count) by (unfold bits_of in Ws; lia). rewrite Ds in *.
  set (lost := negb (digits b mod 2 ^ (exponent a - exponent b) =? 0)). clearbody lost.
  assert (R : let r := if eqb (negative a) (negative b) then wide_add_limbs outside count l shifted else wide_subtract_limbs outside l
    shifted in
    integer_of r = (if eqb (negative a) (negative b) then add_limbs width a (whole shifted) else subtract_limbs width a (whole shifted)) /\
    length (limbs r) = count /\ Forall is_limb (limbs r)).
  { destruct (eqb (negative a) (negative b)); [now apply (add_limbs_holds k)|]. apply (subtract_limbs_holds k); try assumption.
    unfold is_larger in Hl. destruct (Z.eqb_spec (exponent a) (exponent b)) as [Q|Q]; [apply Z.leb_le in Hl|apply Z.ltb_lt in Hl]; lia. }
  cbv zeta in R. destruct R as (I & L & F). revert I L F.
  set (wr := if eqb (negative a) (negative b) then wide_add_limbs outside count l shifted else wide_subtract_limbs outside l shifted).
  set (ir := if eqb (negative a) (negative b) then add_limbs width a (whole shifted) else subtract_limbs width a (whole shifted)).
  assert (Re : clamped (error ir) \/ error ir = Z.max (error a) (exponent a + 1 - width)).
  { unfold ir. destruct (eqb _ _).
    - destruct (add_limbs_is width a (whole shifted) ltac:(lia) Na Za ltac:(lia) ltac:(numbers64; lia)) as (_ & _ & _ & [-> | ->] & _);
      auto.
    - left. unfold subtract_limbs, normalised, is_zero. cbn [digits negative exponent error].
      now destruct (digits a - whole shifted =? 0). }
  clearbody wr ir. intros <- L F. split; [|now split]. unfold with_error, with_wide_error, integer_of in *.
  cbn [limbs is_negative binary_exponent error_exponent negative digits exponent error] in *. f_equal. f_equal.
  unfold bits_of_all. destruct lost; exact64; reflexivity.
Qed.

(* A sum's digits and exponent do not depend on errors. *)
Lemma midpoint_of_sum : forall a b, midpoint (add width a b) = midpoint (add width (midpoint a) (midpoint b)).
Proof.
  intros a b. unfold add. change (is_zero (midpoint a)) with (is_zero a). change (is_zero (midpoint b)) with (is_zero b).
  change (is_larger (midpoint a) (midpoint b)) with (is_larger a b). destruct (is_zero a); [reflexivity|].
  destruct (is_zero b); [reflexivity|].
  assert (S : forall c d, midpoint (add_smaller width c d) = midpoint (add_smaller width (midpoint c) (midpoint d))).
  { intros c d. unfold add_smaller. cbn [negative exponent digits error midpoint].
    destruct (eqb (negative c) (negative d)).
    - unfold add_limbs. cbn [negative exponent digits error midpoint]. now destruct (_ <? _).
    - unfold subtract_limbs, normalised, is_zero. cbn [negative exponent digits error midpoint]. now destruct (_ =? 0). }
  destruct (is_larger a b); apply S.
Qed.

Lemma same_midpoint : forall a b, midpoint a = midpoint b -> normal width b -> normal width a /\ exponent a = exponent b.
Proof. intros a b H N. injection H as _ D E. split; [unfold normal in *; now rewrite D|exact E]. Qed.

Lemma exponent_fits : forall k a, - k <= exponent a <= k -> fits k (midpoint a).
Proof. intros k a E. split; [exact E|now left]. Qed.

Lemma sum_is_clamped : forall a b, clamped (error a) -> clamped (error b) -> clamped (error (add width a b)).
Proof.
  intros a b A B. unfold add, add_smaller. destruct (is_zero a); [apply clamped_clamp|]. destruct (is_zero b); [apply clamped_clamp|].
  destruct (is_larger a b); apply clamped_clamp.
Qed.

Lemma add_holds : forall k j l a m b, limbs_hold k l a -> limbs_hold j m b -> Z.max k j + 5000 <= range ->
  limbs_hold (Z.max k j + width + 3) (wide_add outside count l m) (add width a b).
Proof.
  intros k j l a m b Ha Hb J. set (i := Z.max k j) in *. apply (held_more count enough k i) in Ha; [|unfold i; lia].
  apply (held_more count enough j i) in Hb; [|unfold i; lia]. clearbody i. clear k j. pose proof Ha as ((_ & La & Fa) & Na & Ea & Ra).
  pose proof Hb as ((_ & Lb & Fb) & Nb & Eb & Rb).
  destruct (big_sum_contains width i (midpoint a) (midpoint b) ltac:(lia) ltac:(lia) Na Nb (exponent_fits i a Ea) (exponent_fits i b Eb))
    as (N & (E & _) & _).
  destruct (same_midpoint _ _ (midpoint_of_sum a b) N) as [N2 E2]. rewrite <- E2 in E.
  split; [|split; [exact N2|split; [lia|now apply sum_is_clamped]]].
  clear N E N2 E2. unfold wide_add, add. rewrite (wide_zero_is count enough i l a Ha), (wide_zero_is count enough i m b Hb),
    (is_larger_holds i l
    a i m b Ha Hb).
  destruct (parts count enough i l a Ha) as (_ & _ & Pa & _). destruct (parts count enough i m b Hb) as (_ & _ & Pb & _). rewrite Pa, Pb.
  destruct (is_zero a) eqn:Za; [exact64; exact (proj1 (with_error_holds count i m b _ Hb))|].
  destruct (is_zero b) eqn:Zb; [exact64; exact (proj1 (with_error_holds count i l a _ Ha))|].
  assert (J2 : i <= range) by lia. destruct (is_larger a b) eqn:G; apply (add_smaller_holds i); try assumption. now apply is_larger_total.
Qed.

Lemma subtract_holds : forall k j l a m b, limbs_hold k l a -> limbs_hold j m b -> Z.max k j + 5000 <= range ->
  limbs_hold (Z.max k j + width + 3) (wide_subtract outside count l m) (subtract width a b).
Proof. intros k j l a m b Ha Hb J. apply add_holds; [exact Ha|now apply (negated_holds count enough)|exact J]. Qed.

(* ---- Products ---- *)

Lemma multiply_digits_hold : forall i l a m b, 2 * i + 5000 <= range -> limbs_hold i l a -> limbs_hold i m b -> is_zero a = false ->
  is_zero b = false ->
  let r := wide_multiply outside count l m in
  integer_of r = multiply width a b /\ length (limbs r) = count /\ Forall is_limb (limbs r).
Proof.
  intros i l a m b J Ha Hb Za Zb r. pose proof Ha as ((_ & La & Fa) & Na & Ea & Ra). pose proof Hb as ((_ & Lb & Fb) & Nb & Eb & Rb).
  pose proof (holds_limbs count enough i l a Ha) as HLa. pose proof (holds_limbs count enough i m b Hb) as HLb.
  pose proof (multiply_in_limbs width a b _ _ HLa HLb Na Nb Za Zb) as M. cbv zeta in M. destruct HLa as (Hne & _).
  destruct (top_of_normal _ _ Na Za) as [Ga _]. destruct (top_of_normal _ _ Nb Zb) as [Gb _].
  destruct (parts count enough i l a Ha) as (P1 & P2 & P3 & P4). destruct (parts count enough i m b Hb) as (M1 & M2 & M3 & M4).
  assert (Wl : bits_of (limbs l) = width) by (unfold bits_of; now rewrite La).
  pose proof (limbs_of_product (limbs l) (limbs m) Hne ltac:(lia) Fa Fb) as Q. cbv zeta in Q. rewrite Wl, P4, M4 in Q. specialize (Q Ga Gb).
  unfold r, wide_multiply. rewrite (wide_zero_is count enough i l a Ha), (wide_zero_is count enough i m b Hb), Za, Zb. cbn [orb].
  rewrite (product_of_limbs_is (limbs l) (limbs m) Hne ltac:(lia) Fa Fb). rewrite P1, P2, P3, M1, M2, M3. rewrite La in M, Q.
  set (P := multiply_limbs (limbs l) (limbs m) (repeat 0 (length (limbs m)))) in *.
  assert (HP : Forall is_limb P /\ length P = (count + count)%nat).
  { destruct (limbs_multiply (limbs m) (limbs l) (repeat 0 (length (limbs m)))) as (F & L & _); try assumption; try apply zeros_are_limbs.
    - now rewrite repeat_length.
    - destruct (limbs m); [cbn in Lb; lia|discriminate].
    - split; [exact F|unfold P; lia]. }
  destruct HP as [FP LP]. unfold wide_normalised. cbn [limbs is_negative binary_exponent error_exponent].
  set (below := nth (count - 1) P 0) in *. set (upper := skipn count P) in *.
  assert (Hbelow : is_limb below) by (apply Forall_forall with (1 := FP); apply nth_In; lia).
  pose proof (normalised_keeps below upper Hbelow (Forall_skipn count P FP)) as [Fn Ln].
  assert (Lu : length upper = count) by (unfold upper; rewrite skipn_length; lia).
  pose proof (top_of_zero upper (Forall_skipn count P FP)) as T.
  assert (Ht : exists t, top upper = S t).
  { destruct (top upper) as [|t] eqn:Et; [exfalso|now exists t]. unfold normalised_limbs in Q. rewrite Et in Q.
    destruct Q as (_ & _ & Wr & U). rewrite (proj1 T eq_refl) in Wr. symmetry in Wr.
    pose proof (double_power width ltac:(lia)) as D. pose proof (Z.pow_le_mono_r 2 1 (width - 1) ltac:(lia) ltac:(lia)) as PW.
    rewrite Z.sub_0_r in Wr. apply Z.div_small_iff in Wr; [|apply Z.pow_nonzero; lia]. clear - D PW Ga Gb Wr. nia. }
  destruct Ht as [t Et]. rewrite Et. destruct (normalised_limbs below upper) as [moved up]. cbn [fst] in Fn, Ln.
  destruct Q as (_ & _ & _ & U). assert (Hup : 0 <= up <= 1) by (rewrite U; destruct (_ <? _); lia). rewrite M.
  unfold with_wide_error, integer_of, with_error, bits_of_all. cbn [limbs is_negative binary_exponent error_exponent].
  cbn [negative digits exponent error]. exact64.
  replace (exponent a + exponent b - (exponent a + exponent b - up)) with up by ring.
  split; [|split; [lia|exact Fn]]. f_equal. f_equal. unfold propagated_by_product. destruct (product_lost count P up); exact64; reflexivity.
Qed.

Lemma midpoint_of_product : forall a b, midpoint (multiply width a b) = midpoint (multiply width (midpoint a) (midpoint b)).
Proof.
  intros a b. unfold multiply. change (is_zero (midpoint a)) with (is_zero a). change (is_zero (midpoint b)) with (is_zero b).
  now destruct (is_zero a || is_zero b).
Qed.

Lemma multiply_holds : forall k j l a m b, limbs_hold k l a -> limbs_hold j m b -> 2 * Z.max k j + 5000 <= range ->
  limbs_hold (k + j + 1) (wide_multiply outside count l m) (multiply width a b).
Proof.
  intros k j l a m b Ha Hb J. pose proof (holds_positive count enough _ _ _ Ha) as K0.
  pose proof (holds_positive count enough _ _ _ Hb) as J0.
  pose proof Ha as ((_ & La & Fa) & Na & Ea & Ra). pose proof Hb as ((_ & Lb & Fb) & Nb & Eb & Rb). set (i := Z.max k j) in *.
  assert (Ha' : limbs_hold i l a) by (apply (held_more count enough k); [exact Ha|lia]).
  assert (Hb' : limbs_hold i m b) by (apply (held_more count enough j); [exact Hb|lia]).
  destruct (big_product_contains width i (midpoint a) (midpoint b) ltac:(lia) ltac:(lia) Na Nb (exponent_fits i a ltac:(lia))
    (exponent_fits i b ltac:(lia))) as (N & _ & _).
  destruct (same_midpoint _ _ (midpoint_of_product a b) N) as [N2 _]. split; [|split; [exact N2|split]].
  - destruct (is_zero a) eqn:Za; [|destruct (is_zero b) eqn:Zb; [|now apply (multiply_digits_hold i)]].
    1, 2: unfold wide_multiply, multiply; rewrite (wide_zero_is count enough i l a Ha'), (wide_zero_is count enough i m b Hb'),
      (wide_exact_zero_is
      count enough i l a Ha'), (wide_exact_zero_is count enough i m b Hb'), Za;
      try rewrite Zb; cbn [orb]; destruct (parts count enough i l a Ha') as (_ & -> & -> & _);
        destruct (parts count enough i m b Hb') as (_ & -> & -> & _);
      unfold propagated_by_product; destruct (is_exact_zero a || is_exact_zero b); exact64; apply (zero_holds count enough _).
  - unfold multiply. destruct (is_zero a || is_zero b); [cbn [exponent with_error zero]; lia|]. cbn [exponent with_error].
    destruct (_ <? _); lia.
  - unfold multiply. destruct (is_zero a || is_zero b); apply clamped_clamp.
Qed.
End Refined.
