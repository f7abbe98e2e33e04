(* SPDX-License-Identifier: BSD-3-Clause *)
(* The limbs of the third stage's number, continued: sums with their last carry, numbers moved up to their leading one, comparisons, and
   what takes some of the limbs, as proofs/big_float/BigFloat.v has them. fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Lia List Bool.
From Forceshade Require Import BigFloatValues Limbs LimbShifts.
Import ListNotations.
Open Scope Z_scope.

Definition bits_of (l : list Z) : Z := 64 * Z.of_nat (length l).

Lemma size_is_power : forall l, size l = 2 ^ bits_of l.
Proof. intro l. unfold size, bits_of. rewrite base_power by lia. reflexivity. Qed.

(* ---- add_limbs ---- *)

(* limbs_[kLimbs - 1] |= std::uint64_t{1} << 63 *)
Definition with_top_bit (l : list Z) : list Z := removelast l ++ [Z.lor (last l 0) (2 ^ 63)].

Lemma top_bit_is : forall l, l <> [] -> Forall is_limb l -> whole l < 2 ^ (bits_of l - 1) ->
  Forall is_limb (with_top_bit l) /\ length (with_top_bit l) = length l /\ whole (with_top_bit l) = whole l + 2 ^ (bits_of l - 1).
Proof.
  intros l Hne H B. unfold with_top_bit. destruct (exists_last Hne) as (low & t & ->). rewrite removelast_last, last_last.
  apply Forall_app in H. destruct H as [Hl Ht]. inversion_clear Ht as [|? ? Ht' _]. rewrite whole_app in *. cbn [whole] in *.
  rewrite Z.mul_0_r, Z.add_0_r in *. pose proof (whole_bounds low Hl) as Bl. rewrite (size_is_power low) in *.
  assert (E : bits_of (low ++ [t]) - 1 = bits_of low + 63) by (unfold bits_of; rewrite app_length; cbn [length]; lia). rewrite E in *.
  rewrite Z.pow_add_r in * by (unfold bits_of; lia). pose proof (power_pos (bits_of low) ltac:(unfold bits_of; lia)) as P.
  assert (T : 0 <= t < 2 ^ 63) by (unfold is_limb in Ht'; nia).
  pose proof (or_is_sum t 1 63 ltac:(lia) T) as O. rewrite Z.mul_1_l in O. rewrite O.
  split.
  { apply Forall_app. split; [exact Hl|]. constructor; [|constructor]. unfold is_limb. rewrite base_is.
    change (2 ^ 63) with 9223372036854775808 in *. lia. }
  split; [rewrite !app_length; reflexivity|]. rewrite whole_app. cbn [whole]. rewrite size_is_power. ring.
Qed.

(* The limbs, whether there was a carry, and whether the shift dropped a bit. *)
Definition added_limbs (a b : list Z) : list Z * bool * bool :=
  let (sum, carry) := add_with a b 0 in
  if carry =? 0 then (sum, false, false)
  else let (half, dropped) := shift_right_limbs 1 sum in (with_top_bit half, true, dropped).

Theorem limbs_added : forall a b, a <> [] -> length a = length b -> Forall is_limb a -> Forall is_limb b ->
  let sum := whole a + whole b in let width := bits_of a in
  let '(r, carried, dropped) := added_limbs a b in
  Forall is_limb r /\ length r = length a /\ carried = negb (sum <? 2 ^ width) /\
  whole r = (if sum <? 2 ^ width then sum else sum / 2) /\ dropped = carried && negb (sum mod 2 =? 0).
Proof.
  intros a b Hne L Ha Hb sum width. unfold added_limbs. pose proof (limbs_add a b 0 L Ha Hb ltac:(lia)) as S.
  destruct (add_with a b 0) as [s carry]. destruct S as (F & Len & Hc & S). rewrite size_is_power in S. fold width in S.
    rewrite Z.add_0_r in S.
  fold sum in S. pose proof (whole_bounds s F) as B. rewrite size_is_power in B.
  assert (W : bits_of s = width) by (unfold bits_of, width; now rewrite Len). rewrite W in B.
  pose proof (power_pos width ltac:(unfold width, bits_of; lia)) as P. destruct (Z.eqb_spec carry 0) as [C|C].
  - rewrite (proj2 (Z.ltb_lt sum (2 ^ width))) by nia. cbn [negb andb].
    split; [exact F|]. split; [exact Len|]. split; [reflexivity|]. split; [nia|reflexivity].
  - assert (C1 : carry = 1) by lia. rewrite C1 in S. rewrite (proj2 (Z.ltb_ge sum (2 ^ width))) by lia. cbn [negb andb].
    assert (Ns : (0 < length s)%nat) by (rewrite Len; destruct a; [congruence|cbn; lia]).
    pose proof (limbs_shift_right 1 s F ltac:(lia) ltac:(right; lia)) as R. destruct (shift_right_limbs 1 s) as [half dropped].
    destruct R as (Fh & Lh & Wh & D). change (2 ^ 1) with 2 in Wh, D.
    assert (E : 2 ^ width = 2 * 2 ^ (width - 1)).
    { rewrite <- Z.pow_succ_r by (unfold width, bits_of; lia). f_equal. lia. }
    assert (Bh : bits_of half = width) by (unfold bits_of, width; now rewrite Lh, Len).
    destruct (top_bit_is half) as (Ft & Lt & Wt); [destruct half; [cbn in Lh; lia|congruence]|exact Fh| |].
    { rewrite Bh, Wh. apply Z.div_lt_upper_bound; lia. }
    split; [exact Ft|]. split; [lia|]. split; [reflexivity|]. rewrite Wt, Bh, Wh. split.
    + rewrite S, E. replace (whole s + 2 * 2 ^ (width - 1) * 1) with (whole s + 2 ^ (width - 1) * 2) by ring. rewrite Z.div_add by lia. lia.
    + rewrite D, S, E. replace (whole s + 2 * 2 ^ (width - 1) * 1) with (whole s + 2 ^ (width - 1) * 2) by ring.
      now rewrite Z.mod_add by lia.
Qed.

(* ---- normalise ---- *)

(* How many limbs there are up to the highest that is not 0. *)
Fixpoint top (l : list Z) : nat :=
  match l with [] => O | a :: rest => match top rest with O => if a =? 0 then O else 1%nat | S k => S (S k) end end.

Lemma top_is : forall l, (top l = O -> l = repeat 0 (length l)) /\ forall k, top l = S k ->
  exists low t, l = low ++ t :: repeat 0 (length l - S k) /\ length low = k /\ t <> 0.
Proof.
  induction l as [|a l [IH0 IH]]; [split; [reflexivity|discriminate]|]. cbn [top]. destruct (top l) as [|j].
  - specialize (IH0 eq_refl). destruct (Z.eqb_spec a 0) as [->|N]; (split; [|]).
    + intros _. cbn [length repeat]. now rewrite <- IH0.
    + discriminate.
    + discriminate.
    + intros k [= <-]. exists [], a. cbn [app length]. split; [|split; [reflexivity|exact N]]. f_equal. rewrite Nat.sub_succ, Nat.sub_0_r.
      exact IH0.
  - split; [discriminate|]. intros k [= <-]. destruct (IH j eq_refl) as (low & t & E & L & N). exists (a :: low), t.
    split; [|split; [cbn [length]; now rewrite L|exact N]]. cbn [app length]. rewrite Nat.sub_succ. now rewrite <- E.
Qed.

(* part == 0 ? source(i) : (source(i) << part) | (lower >> (64 - part)); lower is the limb below. *)
Definition limb_moved_up (part lower a : Z) : Z := if part =? 0 then a else Z.lor (word (a * 2 ^ part)) (lower / 2 ^ (64 - part)).
Fixpoint move_up (part lower : Z) (l : list Z) : list Z :=
  match l with [] => [] | a :: rest => limb_moved_up part lower a :: move_up part a rest end.

Lemma limb_moved_up_is : forall part lower a, 0 <= part < 64 -> is_limb lower -> is_limb a -> is_limb (limb_moved_up part lower a) /\
  limb_moved_up part lower a = a mod 2 ^ (64 - part) * 2 ^ part + lower / 2 ^ (64 - part).
Proof.
  intros part lower a P L A. unfold limb_moved_up. destruct (Z.eqb_spec part 0) as [->|N].
  - split; [exact A|]. change (2 ^ (64 - 0)) with base. change (2 ^ 0) with 1. unfold is_limb in *.
    rewrite Z.mod_small, Z.div_small by lia. ring.
  - pose proof (word_shifted a (64 - part) ltac:(lia)) as W. replace (64 - (64 - part)) with part in W by ring. rewrite W.
    pose proof (base_split part ltac:(lia)) as B. pose proof (power_pos part ltac:(lia)).
    pose proof (power_pos (64 - part) ltac:(lia)). unfold is_limb in *.
    assert (D : 0 <= lower / 2 ^ (64 - part) < 2 ^ part) by (split; [apply Z.div_pos; lia|apply Z.div_lt_upper_bound; lia]).
    rewrite Z.lor_comm, or_is_sum by lia. pose proof (Z.mod_pos_bound a (2 ^ (64 - part)) ltac:(lia)). split; [nia|ring].
Qed.

Lemma last_cons : forall (a b : Z) l, last (a :: b :: l) 0 = last (b :: l) 0.
Proof. reflexivity. Qed.

Lemma move_up_is : forall part l lower, 0 <= part < 64 -> is_limb lower -> Forall is_limb l ->
  Forall is_limb (move_up part lower l) /\ length (move_up part lower l) = length l /\
  whole (move_up part lower l) + size l * (last (lower :: l) 0 / 2 ^ (64 - part)) = whole l * 2 ^ part + lower / 2 ^ (64 - part).
Proof.
  intros part. induction l as [|a l IH]; intros lower P L H.
  - cbn [move_up whole length last]. change (size []) with 1. split; [apply Forall_nil|]. split; [reflexivity|ring].
  - inversion_clear H as [|? ? Ha Hl]. destruct (IH a P Ha Hl) as (F & Len & S). destruct (limb_moved_up_is part lower a P L Ha) as [M E].
    cbn [move_up]. split; [now constructor|]. split; [cbn [length]; now rewrite Len|]. rewrite last_cons, size_cons. cbn [whole]. rewrite E.
    pose proof (base_split part ltac:(lia)) as B. pose proof (power_pos (64 - part) ltac:(lia)) as P2.
    pose proof (Z.div_mod a (2 ^ (64 - part)) ltac:(lia)) as D. rewrite B in *. set (k := 2 ^ (64 - part)) in *.
      set (p := 2 ^ part) in *. nia.
Qed.

(* The number with `below` behind its lowest limb, moved up until its leading one is the top bit, and by how much; of 0, nothing. *)
Definition normalised_limbs (below : Z) (l : list Z) : list Z * Z :=
  match top l with
  | O => (l, 0)
  | S k =>
    let n := (length l - S k)%nat in let part := 63 - Z.log2 (nth k l 0) in
    (match n with O => move_up part below l | S m => move_up part 0 (repeat 0 m ++ below :: firstn (S k) l) end, 64 * Z.of_nat n + part)
  end.

Lemma log2_of_limb : forall t, is_limb t -> t <> 0 -> 0 <= 63 - Z.log2 t < 64 /\ t / 2 ^ (64 - (63 - Z.log2 t)) = 0.
Proof.
  intros t T N. unfold is_limb in T. assert (L : Z.log2 t < 64) by (apply Z.log2_lt_pow2; [lia|exact (proj2 T)]).
  pose proof (Z.log2_nonneg t). split; [lia|]. apply Z.div_small. split; [lia|].
    replace (64 - (63 - Z.log2 t)) with (Z.succ (Z.log2 t)) by lia.
  apply Z.log2_spec. lia.
Qed.

Theorem limbs_normalised : forall below l, is_limb below -> Forall is_limb l -> whole l <> 0 ->
  let (r, up) := normalised_limbs below l in
  Forall is_limb r /\ length r = length l /\ 0 <= up /\ up = bits_of l - 1 - Z.log2 (whole l) /\
  whole r = (below + base * whole l) * 2 ^ up / base.
Proof.
  intros below l Hb H Hne. unfold normalised_limbs. destruct (top_is l) as [T0 T]. destruct (top l) as [|k].
  { exfalso. apply Hne. rewrite T0 by reflexivity. apply whole_zeros. }
  destruct (T k eq_refl) as (low & t & E & Lk & Nt). set (n := (length l - S k)%nat) in *.
  assert (Hlt : Forall is_limb low /\ is_limb t).
  { rewrite E in H. apply Forall_app in H. destruct H as [H1 H2]. inversion_clear H2. now split. }
  destruct Hlt as [Hl Ht]. assert (Et : nth k l 0 = t) by (rewrite E, app_nth2, Lk, Nat.sub_diag by lia; reflexivity). rewrite Et.
  destruct (log2_of_limb t Ht Nt) as [P D]. set (part := 63 - Z.log2 t) in *.
  assert (W : whole l = whole low + size low * t).
  { rewrite E, whole_app. cbn [whole]. rewrite whole_zeros. ring. }
  assert (Ln : length l = (S k + n)%nat) by (rewrite E, app_length; cbn [length]; rewrite repeat_length; lia).
  assert (G : Z.log2 (whole l) = bits_of low + Z.log2 t).
  { pose proof (whole_bounds low Hl) as Bl. rewrite (size_is_power low) in *. unfold is_limb in Ht.
    pose proof (Z.log2_spec t ltac:(lia)) as S. pose proof (Z.log2_nonneg t). assert (0 <= bits_of low) by (unfold bits_of; lia).
    apply Z.log2_unique; [lia|]. rewrite W. replace (Z.succ (bits_of low + Z.log2 t)) with (bits_of low + Z.succ (Z.log2 t)) by lia.
    rewrite !Z.pow_add_r by lia. nia. }
  assert (U : 64 * Z.of_nat n + part = bits_of l - 1 - Z.log2 (whole l)) by (rewrite G; unfold part, bits_of; rewrite Ln, Lk; lia).
  pose proof (base_split part ltac:(lia)) as B. pose proof (power_pos part ltac:(lia)) as P1.
  pose proof (power_pos (64 - part) ltac:(lia)) as P2. destruct n as [|m].
  - cbn [repeat] in E. destruct (move_up_is part l below P Hb H) as (F & Len & S).
    assert (Lt : last (below :: l) 0 = t) by (rewrite E, app_comm_cons; apply last_last). rewrite Lt, D, Z.mul_0_r, Z.add_0_r in S.
    split; [exact F|]. split; [exact Len|]. split; [lia|]. split; [exact U|]. rewrite S. cbn [Z.of_nat]. rewrite Z.mul_0_r, Z.add_0_l.
    rewrite B at 2. replace ((below + base * whole l) * 2 ^ part) with (2 ^ part * (below + base * whole l)) by ring.
    rewrite Z.div_mul_cancel_l by lia. rewrite B. replace (below + 2 ^ part * 2 ^ (64 - part) * whole l) with
      (below + whole l * 2 ^ part * 2 ^ (64 - part)) by ring. rewrite Z.div_add by lia. ring.
  - set (f := firstn (S k) l). assert (Ef : f = low ++ [t]).
    { unfold f. rewrite E, firstn_app, Lk. replace (S k - k)%nat with 1%nat by lia. rewrite firstn_all2 by lia. reflexivity. }
    assert (Wf : whole f = whole l) by (rewrite Ef, whole_app, W; cbn [whole]; ring).
    assert (Lf : length f = S k) by (rewrite Ef, app_length, Lk; cbn [length]; lia).
    assert (Fs : Forall is_limb (repeat 0 m ++ below :: f)).
    { apply Forall_app. split; [apply zeros_are_limbs|constructor; [exact Hb|now apply Forall_firstn]]. }
    destruct (move_up_is part (repeat 0 m ++ below :: f) 0 P ltac:(unfold is_limb; rewrite base_is; lia) Fs) as (F & Len & S).
    assert (Lt : last (0 :: repeat 0 m ++ below :: f) 0 = t).
    { rewrite Ef. replace (0 :: repeat 0 m ++ below :: low ++ [t]) with ((0 :: repeat 0 m ++ below :: low) ++ [t])
        by (cbn [app]; now rewrite <- app_assoc). apply last_last. }
    rewrite Lt, D, Z.mul_0_r, Z.add_0_r, Z.div_0_l, Z.add_0_r in S by lia. split; [exact F|].
    split; [rewrite Len, app_length, repeat_length; cbn [length]; lia|]. split; [lia|]. split; [exact U|].
      rewrite S, whole_app, whole_zeros.
    cbn [whole]. rewrite Wf, Z.add_0_l, Z.pow_add_r by lia. rewrite <- base_power by lia. rewrite Nat2Z.inj_succ, Z.pow_succ_r by lia.
    rewrite (size_of_length _ m) by apply repeat_length. set (e := below + base * whole l).
    replace (e * (base * base ^ Z.of_nat m * 2 ^ part)) with (base ^ Z.of_nat m * e * 2 ^ part * base) by ring.
    rewrite Z.div_mul by (rewrite base_is; lia). reflexivity.
Qed.

(* ---- compare_magnitudes ---- *)

(* From the highest limb down. *)
Fixpoint compare_limbs (a b : list Z) : comparison :=
  match a, b with x :: a', y :: b' => match compare_limbs a' b' with Eq => x ?= y | other => other end | _, _ => Eq end.

Theorem limbs_compare : forall a b, length a = length b -> Forall is_limb a -> Forall is_limb b ->
  compare_limbs a b = (whole a ?= whole b).
Proof.
  induction a as [|x a IH]; intros [|y b] L Ha Hb; try discriminate; [reflexivity|]. inversion_clear Ha as [|? ? Hx Ha'].
  inversion_clear Hb as [|? ? Hy Hb']. injection L as L. cbn [compare_limbs whole]. rewrite (IH b L Ha' Hb').
  pose proof base_is. unfold is_limb in *. destruct (Z.compare_spec (whole a) (whole b)) as [E|E|E].
  - rewrite E. destruct (Z.compare_spec x y); symmetry; [apply Z.compare_eq_iff|apply Z.compare_lt_iff|apply Z.compare_gt_iff]; lia.
  - symmetry. apply Z.compare_lt_iff. nia.
  - symmetry. apply Z.compare_gt_iff. nia.
Qed.

(* ---- Some of the limbs ---- *)

(* limbs_[kLimbs - 1] *)
Theorem highest_limb : forall l, l <> [] -> Forall is_limb l -> last l 0 = whole l / 2 ^ (bits_of l - 64).
Proof.
  intros l Hne H. destruct (exists_last Hne) as (low & t & ->). rewrite last_last. apply Forall_app in H. destruct H as [Hl _].
  pose proof (whole_bounds low Hl) as B. rewrite size_is_power in B. rewrite whole_app, size_is_power. cbn [whole].
  replace (bits_of (low ++ [t]) - 64) with (bits_of low) by (unfold bits_of; rewrite app_length; cbn [length]; lia).
  rewrite Z.mul_0_r, Z.add_0_r, Z.mul_comm, Z.div_add, Z.div_small by lia. lia.
Qed.

(* A number of binary64 with `bits` bits, in the highest limb. *)
Theorem one_limb : forall n m bits, (0 < n)%nat -> 0 <= bits <= 64 ->
  whole (repeat 0 (n - 1) ++ [m * 2 ^ (64 - bits)]) = m * 2 ^ (64 * Z.of_nat n - bits).
Proof.
  intros n m bits N B. rewrite whole_app, whole_zeros, (size_of_length _ (n - 1)) by apply repeat_length. rewrite base_power by lia.
    cbn [whole].
  replace (64 * Z.of_nat n - bits) with (64 * Z.of_nat (n - 1) + (64 - bits)) by lia. rewrite Z.pow_add_r by lia. ring.
Qed.

(* More limbs, or fewer, and whether a bit is lost then. *)
Theorem more_limbs : forall n l, whole (repeat 0 n ++ l) = whole l * 2 ^ (64 * Z.of_nat n).
Proof. intros n l. rewrite whole_app, whole_zeros, (size_of_length _ n), base_power by (apply repeat_length || lia). ring. Qed.

Theorem fewer_limbs : forall n l, (n <= length l)%nat -> Forall is_limb l -> whole (skipn n l) = whole l / 2 ^ (64 * Z.of_nat n) /\
  existsb (fun a => negb (a =? 0)) (firstn n l) = negb (whole l mod 2 ^ (64 * Z.of_nat n) =? 0).
Proof.
  intros n l L H. rewrite (all_zero _ (Forall_firstn n l H)). pose proof (whole_split n l L) as W. rewrite base_power in W by lia.
  pose proof (whole_bounds _ (Forall_firstn n l H)) as B. rewrite (size_of_length _ n) in B by now apply firstn_length_le.
  rewrite base_power in B by lia. rewrite W, Z.mul_comm.
  rewrite Z.div_add, Z.mod_add, (Z.div_small (whole (firstn n l))), (Z.mod_small (whole (firstn n l))) by lia. split; [ring|reflexivity].
Qed.

(* The lowest limbs set to 0. *)
Theorem limbs_cut : forall n l, (n <= length l)%nat -> Forall is_limb l ->
  whole (repeat 0 n ++ skipn n l) = whole l / 2 ^ (64 * Z.of_nat n) * 2 ^ (64 * Z.of_nat n).
Proof. intros n l L H. now rewrite more_limbs, (proj1 (fewer_limbs n l L H)). Qed.

(* ---- The product's limbs ---- *)

Lemma whole_skipn : forall k l, (k < length l)%nat -> whole (skipn k l) = nth k l 0 + base * whole (skipn (S k) l).
Proof.
  induction k as [|k IH]; intros [|a l] H; cbn [length] in H; try lia; [reflexivity|]. cbn [skipn nth]. apply IH. lia.
Qed.

(* The upper half of the product, moved up, with what is below it. *)
Theorem limbs_of_product : forall a b, a <> [] -> length a = length b -> Forall is_limb a -> Forall is_limb b ->
  let width := bits_of a in 2 ^ (width - 1) <= whole a -> 2 ^ (width - 1) <= whole b ->
  let product := multiply_limbs a b (repeat 0 (length b)) in let n := length a in
  let (r, up) := normalised_limbs (nth (n - 1) product 0) (skipn n product) in
  Forall is_limb r /\ length r = length a /\ whole r = whole a * whole b / 2 ^ (width - up) /\
  up = if whole a * whole b <? 2 ^ (2 * width - 1) then 1 else 0.
Proof.
  intros a b Hne L Ha Hb width Ba Bb product n. pose proof (whole_bounds a Ha) as Ua. pose proof (whole_bounds b Hb) as Ub.
  rewrite size_is_power in Ua, Ub. assert (Wb : bits_of b = width) by (unfold width, bits_of; now rewrite L). rewrite Wb in Ub.
  fold width in Ua.
  assert (Hn : (0 < n)%nat) by (unfold n; destruct a; [congruence|cbn [length]; lia]).
  assert (Hw : width = 64 * Z.of_nat n) by reflexivity.
  assert (Hb0 : b <> []) by (destruct b; [cbn [length] in L; lia|congruence]).
  destruct (limbs_multiply b a (repeat 0 (length b)) ltac:(now rewrite repeat_length) Hb0 Ha Hb (zeros_are_limbs _)) as (F & Len & SP).
  fold product in F, Len, SP. rewrite whole_zeros, Z.add_0_r in SP. set (P := whole a * whole b) in *.
  assert (E2 : 2 ^ width = 2 * 2 ^ (width - 1)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
  assert (E4 : 2 ^ (2 * width - 1) = 2 ^ width * 2 ^ (width - 1)) by (rewrite <- Z.pow_add_r by lia; f_equal; lia).
  assert (E5 : 2 ^ (width - 1) = 2 * 2 ^ (width - 2)) by (rewrite <- Z.pow_succ_r by lia; f_equal; lia).
  pose proof (power_pos (width - 2) ltac:(lia)) as P2. set (h := 2 ^ (width - 2)) in *. set (hh := 2 ^ (width - 1)) in *.
  assert (BP : hh * hh <= P < 2 ^ width * 2 ^ width) by (unfold P; nia).
  assert (Lu : length (skipn n product) = n) by (rewrite skipn_length, Len, <- L; lia).
  pose proof (whole_split n product ltac:(lia)) as W. rewrite SP, base_power, <- Hw in W by lia.
  pose proof (whole_bounds _ (Forall_firstn n product F)) as Bf.
  rewrite (size_of_length _ n) in Bf by (apply firstn_length_le; lia).
  rewrite base_power, <- Hw in Bf by lia. set (U := whole (skipn n product)) in *.
  assert (LU : h <= U < 2 ^ width) by nia.
  set (below := nth (n - 1) product 0).
  assert (Hbelow : is_limb below) by (apply Forall_forall with (1 := F); apply nth_In; lia).
  assert (EP : below + base * U = P / 2 ^ (64 * Z.of_nat (n - 1))).
  { pose proof (whole_split (n - 1) product ltac:(lia)) as V. rewrite SP, base_power in V by lia.
    pose proof (whole_bounds _ (Forall_firstn (n - 1) product F)) as Bg.
    rewrite (size_of_length _ (n - 1)) in Bg by (apply firstn_length_le; lia).
    rewrite base_power in Bg by lia.
    assert (K : whole (skipn (n - 1) product) = below + base * U).
    { rewrite whole_skipn by lia. unfold U, below. replace (S (n - 1)) with n by lia. reflexivity. }
    rewrite K in V. rewrite V, (Z.mul_comm (2 ^ (64 * Z.of_nat (n - 1)))), Z.div_add, Z.div_small by lia. ring. }
  pose proof (limbs_normalised below (skipn n product) Hbelow (Forall_skipn n product F) ltac:(fold U; lia)) as R.
  destruct (normalised_limbs below (skipn n product)) as [r up]. fold U in R. destruct R as (Fr & Lr & Hu & Eu & Wr).
  assert (Bu : bits_of (skipn n product) = width) by (unfold bits_of; rewrite Lu; symmetry; exact Hw). rewrite Bu in Eu.
  assert (up = if P <? 2 ^ (2 * width - 1) then 1 else 0).
  { rewrite Eu, E4. destruct (Z.ltb_spec P (2 ^ width * hh)) as [Lt|Ge].
    - assert (Z.log2 U = width - 2); [|lia]. apply Z.log2_unique; [lia|]. fold h. replace (Z.succ (width - 2)) with (width - 1) by ring.
      fold hh. nia.
    - assert (Z.log2 U = width - 1); [|lia]. apply Z.log2_unique; [lia|]. replace (Z.succ (width - 1)) with width by ring.
      fold hh. nia. }
  split; [exact Fr|]. split; [rewrite Lr; exact Lu|]. split; [|assumption]. rewrite Wr, EP.
  assert (Hup : 0 <= up <= 1) by (rewrite H; destruct (_ <? _); lia).
  assert (B : base = 2 ^ up * 2 ^ (64 - up)) by (apply base_split; lia). rewrite B at 1.
  pose proof (power_pos up ltac:(lia)). pose proof (power_pos (64 - up) ltac:(lia)).
  pose proof (power_pos (64 * Z.of_nat (n - 1)) ltac:(lia)).
  rewrite (Z.mul_comm _ (2 ^ up)), Z.div_mul_cancel_l by lia. rewrite Z.div_div by lia. f_equal.
  rewrite <- Z.pow_add_r by lia. f_equal. lia.
Qed.
