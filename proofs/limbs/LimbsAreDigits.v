(* SPDX-License-Identifier: BSD-3-Clause *)
(* The operations of proofs/big_float/BigFloat.v on whole numbers are those of fast/numbers/big_float_ball.h on limbs. *)
From Coq Require Import ZArith Lia List Bool.
From Forceshade Require Import BigFloat BigFloatValues Limbs LimbShifts LimbNumbers.
Import ListNotations.
Open Scope Z_scope.

(* The digits of a number of kLimbs limbs. *)
Definition has_limbs (width : Z) (a : big) (l : list Z) : Prop :=
  l <> [] /\ Forall is_limb l /\ bits_of l = width /\ digits a = whole l.

Lemma same_length : forall width a b l m, has_limbs width a l -> has_limbs width b m -> length l = length m.
Proof. intros width a b l m (_ & _ & L & _) (_ & _ & M & _). unfold bits_of in *. lia. Qed.

(* limbs_[kLimbs - 1] == 0 *)
Theorem is_zero_in_limbs : forall width a l, has_limbs width a l -> normal width a -> is_zero a = (last l 0 =? 0).
Proof.
  intros width a l (Hne & F & W & D) N. rewrite (highest_limb l Hne F), W. unfold is_zero. rewrite D. unfold normal in N. rewrite D in N.
  assert (P : 64 <= width). { rewrite <- W. unfold bits_of. destruct l; [congruence|cbn [length]; lia]. }
  destruct N as [->|[L U]]; [now rewrite Z.div_0_l by (apply Z.pow_nonzero; lia)|].
  assert (E : 2 ^ (width - 1) = 2 ^ (width - 64) * 2 ^ 63) by (rewrite <- Z.pow_add_r by lia; f_equal; lia).
  pose proof (power_pos (width - 64) ltac:(lia)) as P2.
  assert (Q : 2 ^ 63 <= whole l / 2 ^ (width - 64)) by (apply Z.div_le_lower_bound; lia). change (2 ^ 63) with 9223372036854775808 in *.
  destruct (Z.eqb_spec (whole l) 0), (Z.eqb_spec (whole l / 2 ^ (width - 64)) 0); try reflexivity; nia.
Qed.

(* compare_magnitudes(a, b) >= 0 *)
Theorem is_larger_in_limbs : forall width a b l m, has_limbs width a l -> has_limbs width b m ->
  is_larger a b = (if exponent a =? exponent b then match compare_limbs l m with Lt => false | _ => true end else exponent b <? exponent a).
Proof.
  intros width a b l m A B. pose proof (same_length _ _ _ _ _ A B) as L. destruct A as (_ & Fl & _ & Da), B as (_ & Fm & _ & Db).
  unfold is_larger. rewrite (limbs_compare l m L Fl Fm), Da, Db. destruct (exponent a =? exponent b); [|reflexivity].
  unfold Z.leb. rewrite (Z.compare_antisym (whole l)). now destruct (whole l ?= whole m).
Qed.

(* small.shift_right(count) *)
Theorem shift_in_limbs : forall width a l count, has_limbs width a l -> 0 <= count -> digits a <> 0 ->
  let (r, lost) := shift_right_limbs count l in
  has_limbs width (Big (negative a) (digits a / 2 ^ count) (exponent a) (error a)) r /\ lost = negb (digits a mod 2 ^ count =? 0).
Proof.
  intros width a l count (Hne & F & W & D) C N. rewrite D in *. pose proof (limbs_shift_right count l F C ltac:(now left)) as S.
  destruct (shift_right_limbs count l) as [r lost]. destruct S as (Fr & Lr & Wr & Lost). split; [|exact Lost].
  split; [|split; [exact Fr|split; [unfold bits_of in *; lia|now rewrite Wr]]]. destruct r; [|congruence].
    destruct l; [congruence|discriminate].
Qed.

Theorem add_in_limbs : forall width a l m, has_limbs width a l -> length l = length m -> Forall is_limb m ->
  let '(r, carried, dropped) := added_limbs l m in let e := if carried then exponent a + 1 else exponent a in
  add_limbs width a (whole m) = Big (negative a) (whole r) e (if dropped then Z.max (error a) (e - width) else error a).
Proof.
  intros width a l m (Hne & F & W & D) L Fm. pose proof (limbs_added l m Hne L F Fm) as A. cbv zeta in A. rewrite W in A.
  destruct (added_limbs l m) as [[r carried] dropped]. destruct A as (_ & _ & -> & Wr & ->). unfold add_limbs. rewrite D, Wr.
  destruct (whole l + whole m <? 2 ^ width); cbn [negb andb]; [reflexivity|]. now destruct ((whole l + whole m) mod 2 =? 0).
Qed.

Theorem subtract_in_limbs : forall width a l m, has_limbs width a l -> length l = length m -> Forall is_limb m -> whole m <= whole l ->
  let difference := fst (subtract_with l m 0) in
  subtract_limbs width a (whole m) =
    if whole difference =? 0 then Big false 0 0 (error a)
    else let (r, up) := normalised_limbs 0 difference in Big (negative a) (whole r) (exponent a - up) (error a).
Proof.
  intros width a l m (Hne & F & W & D) L Fm B difference. destruct (limbs_subtract_smaller l m L F Fm B) as [Fd Wd].
    fold difference in Fd, Wd.
  assert (Ld : length difference = length l).
  { pose proof (limbs_subtract l m 0 L F Fm ltac:(lia)) as S. unfold difference. destruct (subtract_with l m 0).
    now destruct S as (_ & S & _). }
  unfold subtract_limbs, normalised, is_zero. cbn [digits negative exponent error]. rewrite D, Wd.
  destruct (Z.eqb_spec (whole l - whole m) 0) as [Z|N]; [reflexivity|].
  pose proof (limbs_normalised 0 difference ltac:(unfold is_limb; rewrite base_is; lia) Fd ltac:(lia)) as S.
  destruct (normalised_limbs 0 difference) as [r up]. destruct S as (_ & _ & Hu & Eu & Wr). rewrite Wd in *.
  assert (Eb : bits_of difference = width) by (unfold bits_of in *; lia). rewrite Eb in Eu. rewrite <- Eu, Wr, Z.add_0_l.
  rewrite <- Z.mul_assoc, (Z.mul_comm base), Z.div_mul by (rewrite base_is; lia). reflexivity.
Qed.

(* lost |= (below << taken) != 0, and any limb below that. *)
Definition product_lost (n : nat) (product : list Z) (taken : Z) : bool :=
  negb (word (nth (n - 1) product 0 * 2 ^ taken) =? 0) || existsb (fun a => negb (a =? 0)) (firstn (n - 1) product).

Theorem multiply_in_limbs : forall width a b l m, has_limbs width a l -> has_limbs width b m -> normal width a -> normal width b ->
  is_zero a = false -> is_zero b = false ->
  let product := multiply_limbs l m (repeat 0 (length m)) in let n := length l in
  let (r, up) := normalised_limbs (nth (n - 1) product 0) (skipn n product) in
  let e := exponent a + exponent b - up in
  multiply width a b = with_error (Big (xorb (negative a) (negative b)) (whole r) e none)
    (Z.max (propagated_by_product a b) (if product_lost n product up then e - width + 2 else none) + 2).
Proof.
  intros width a b l m A B Na Nb Za Zb product n. pose proof (same_length _ _ _ _ _ A B) as L.
  destruct A as (Hne & Fl & W & Da), B as (_ & Fm & _ & Db).
  assert (Ba : 2 ^ (width - 1) <= whole l) by (destruct Na as [Na|Na]; [unfold is_zero in Za; rewrite Na in Za; discriminate|lia]).
  assert (Bb : 2 ^ (width - 1) <= whole m) by (destruct Nb as [Nb|Nb]; [unfold is_zero in Zb; rewrite Nb in Zb; discriminate|lia]).
  pose proof (limbs_of_product l m Hne L Fl Fm) as P. cbv zeta in P. rewrite W in P. specialize (P Ba Bb). fold product n in P.
  destruct (limbs_multiply m l (repeat 0 (length m)) ltac:(now rewrite repeat_length) ltac:(destruct m, l; cbn in L; congruence) Fl Fm
    (zeros_are_limbs _)) as (F & Len & S). fold product in F, Len, S. rewrite whole_zeros, Z.add_0_r in S.
  destruct (normalised_limbs (nth (n - 1) product 0) (skipn n product)) as [r up]. destruct P as (_ & _ & Wr & Eu).
  assert (Hn : (0 < n)%nat) by (unfold n; destruct l; [congruence|cbn [length]; lia]).
  assert (Hw : width = 64 * Z.of_nat n) by (rewrite <- W; reflexivity).
  assert (Lost : product_lost n product up = negb (whole l * whole m mod 2 ^ (width - up) =? 0)).
  { assert (Hu : 0 <= up <= 1) by (rewrite Eu; destruct (_ <? _); lia). unfold product_lost.
    rewrite (all_zero _ (Forall_firstn _ _ F)). pose proof (whole_split (n - 1) product ltac:(lia)) as V.
    rewrite S, base_power, whole_skipn in V by lia. set (below := nth (n - 1) product 0) in *.
      set (f := whole (firstn (n - 1) product)) in *.
    pose proof (whole_bounds _ (Forall_firstn (n - 1) product F)) as Bf. fold f in Bf.
    rewrite (size_of_length _ (n - 1)) in Bf by (apply firstn_length_le; lia). rewrite base_power in Bf by lia.
    set (U := whole (skipn (Datatypes.S (n - 1)) product)) in *. set (D := 2 ^ (64 * Z.of_nat (n - 1))) in *.
    assert (PD : 0 < D) by (apply power_pos; lia). set (q := 2 ^ (64 - up)).
    assert (Pq : 0 < q) by (apply power_pos; lia). assert (P1 : 0 < 2 ^ up) by (apply power_pos; lia).
    assert (E : 2 ^ (width - up) = D * q) by (unfold D, q; rewrite <- Z.pow_add_r by lia; f_equal; lia).
    pose proof (word_shifted below (64 - up) ltac:(lia)) as Ws. replace (64 - (64 - up)) with up in Ws by ring. fold q in Ws. rewrite Ws.
    assert (Bb' : base = 2 ^ up * q) by (apply base_split; lia).
    assert (M : whole l * whole m mod (D * q) = f + D * (below mod q)).
    { rewrite Z.rem_mul_r by lia. rewrite V, (Z.mul_comm D), Z.mod_add, (Z.mod_small f), Z.div_add, (Z.div_small f), Z.add_0_l by lia.
      rewrite Bb'. replace (below + 2 ^ up * q * U) with (below + 2 ^ up * U * q) by ring. rewrite Z.mod_add by lia. reflexivity. }
    rewrite E, M. pose proof (Z.mod_pos_bound below q Pq).
    destruct (Z.eqb_spec (below mod q * 2 ^ up) 0), (Z.eqb_spec f 0), (Z.eqb_spec (f + D * (below mod q)) 0); try reflexivity;
      exfalso; nia. }
  unfold multiply. rewrite Za, Zb. cbn [orb]. rewrite Da, Db, <- Eu, Wr, Lost. reflexivity.
Qed.
