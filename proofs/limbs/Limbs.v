(* SPDX-License-Identifier: BSD-3-Clause *)
(* The limbs of the third stage's number: what the loops of fast/numbers/big_float_ball.h do with arrays of 64-bit numbers is what
   proofs/big_float/BigFloat.v has as operations on one whole number. An array is a list here, the least significant limb first; a type of
   64 or 128 bits keeps a result modulo 2^64 or 2^128. *)
From Coq Require Import ZArith Lia List Bool.
Import ListNotations.
Open Scope Z_scope.

Definition base : Z := 2 ^ 64.
Definition word (t : Z) : Z := t mod base.              (* static_cast<std::uint64_t> *)
Definition double_word (t : Z) : Z := t mod 2 ^ 128.    (* Product *)

Fixpoint whole (limbs : list Z) : Z := match limbs with [] => 0 | a :: rest => a + base * whole rest end.
Definition is_limb (a : Z) : Prop := 0 <= a < base.
Definition size (limbs : list Z) : Z := base ^ Z.of_nat (length limbs).

Lemma base_is : base = 18446744073709551616. Proof. reflexivity. Qed.
Lemma base_square : 2 ^ 128 = base * base. Proof. reflexivity. Qed.
Ltac bounds := pose proof base_is; unfold is_limb in *.

Lemma size_cons : forall a l, size (a :: l) = base * size l.
Proof. intros a l. unfold size. cbn [length]. rewrite Nat2Z.inj_succ, Z.pow_succ_r by lia. reflexivity. Qed.

Lemma size_pos : forall l, 0 < size l.
Proof. intro l. unfold size. apply Z.pow_pos_nonneg; [reflexivity|lia]. Qed.

Lemma whole_bounds : forall l, Forall is_limb l -> 0 <= whole l < size l.
Proof.
  induction l as [|a l IH]; intro H; [cbn; lia|]. inversion_clear H as [|? ? Ha Hl]. specialize (IH Hl). rewrite size_cons.
  cbn [whole]. bounds. nia.
Qed.

Lemma word_limb : forall t, is_limb (word t).
Proof. intro t. apply Z.mod_pos_bound. reflexivity. Qed.

Lemma word_and_carry : forall t, 0 <= t -> t = word t + base * (t / base).
Proof. intros t H. unfold word. pose proof (Z.div_mod t base). bounds. lia. Qed.

(* ---- add_limbs ---- *)

(* t = Product{limbs_[i]} + other.limbs_[i] + carry *)
Fixpoint add_with (a b : list Z) (carry : Z) : list Z * Z :=
  match a, b with
  | x :: a', y :: b' =>
      let t := double_word (x + y + carry) in let (rest, last) := add_with a' b' (word (t / base)) in (word t :: rest, last)
  | _, _ => ([], carry)
  end.

Theorem limbs_add : forall a b carry, length a = length b -> Forall is_limb a -> Forall is_limb b -> 0 <= carry <= 1 ->
  let (sum, last) := add_with a b carry in
  Forall is_limb sum /\ length sum = length a /\ 0 <= last <= 1 /\ whole a + whole b + carry = whole sum + size a * last.
Proof.
  induction a as [|x a IH]; intros [|y b] carry L Ha Hb Hc; try discriminate.
  { change (size []) with 1. cbn [add_with whole length]. split; [apply Forall_nil|lia]. }
  inversion_clear Ha as [|? ? Hx Ha']. inversion_clear Hb as [|? ? Hy Hb']. injection L as L. cbn [add_with].
  assert (E : double_word (x + y + carry) = x + y + carry) by (apply Z.mod_small; rewrite base_square; bounds; nia). rewrite E.
  set (t := x + y + carry) in *. assert (T : 0 <= t < 2 * base) by (bounds; lia). assert (Q : 0 <= t / base <= 1).
  { split; [apply Z.div_pos; lia|]. apply Z.lt_succ_r. apply Z.div_lt_upper_bound; lia. }
  assert (W : word (t / base) = t / base) by (apply Z.mod_small; bounds; lia). rewrite W.
  specialize (IH b (t / base) L Ha' Hb' Q). destruct (add_with a b (t / base)) as [rest last]. destruct IH as (F & Len & Hl & S).
  split; [constructor; [apply word_limb|exact F]|]. split; [cbn [length]; now rewrite Len|]. split; [exact Hl|].
  pose proof (word_and_carry t ltac:(lia)) as D. rewrite size_cons. cbn [whole]. unfold t in *. nia.
Qed.

(* ---- subtract_limbs ---- *)

(* t = Product{limbs_[i]} - other.limbs_[i] - borrow; borrow = static_cast<std::uint64_t>(t >> 64) & 1 *)
Fixpoint subtract_with (a b : list Z) (borrow : Z) : list Z * Z :=
  match a, b with
  | x :: a', y :: b' =>
      let t := double_word (x - y - borrow) in
      let (rest, last) := subtract_with a' b' (Z.land (word (t / base)) 1) in (word t :: rest, last)
  | _, _ => ([], borrow)
  end.

Lemma difference_of_limbs : forall x y borrow, is_limb x -> is_limb y -> 0 <= borrow <= 1 ->
  let t := double_word (x - y - borrow) in let next := Z.land (word (t / base)) 1 in
  0 <= next <= 1 /\ x - y - borrow = word t - base * next.
Proof.
  intros x y borrow Hx Hy Hb t next. change 1 with (Z.ones 1) in next. unfold next. rewrite Z.land_ones by lia.
  change (2 ^ 1) with 2. set (d := x - y - borrow) in *. assert (D : - base <= d < base) by (bounds; lia).
  split; [pose proof (Z.mod_pos_bound (word (t / base)) 2); lia|]. destruct (Z_lt_le_dec d 0) as [N|N].
  - assert (T : t = d + base * base).
    { unfold t, double_word. rewrite base_square. symmetry. apply (Z.mod_unique _ _ (-1)); [left; bounds; nia|ring]. }
    assert (Q : t / base = base - 1) by (symmetry; apply (Z.div_unique _ _ _ (d + base)); [left; lia|rewrite T; ring]).
    assert (R : word t = d + base) by (unfold word; symmetry; apply (Z.mod_unique _ _ (base - 1)); [left; lia|rewrite T; ring]).
    rewrite Q, R. unfold word. rewrite (Z.mod_small (base - 1) base) by (bounds; lia). change ((base - 1) mod 2) with 1. lia.
  - assert (T : t = d) by (unfold t, double_word; apply Z.mod_small; rewrite base_square; bounds; nia).
    rewrite T. rewrite Z.div_small by lia. unfold word. rewrite (Z.mod_small d) by lia. change (0 mod base mod 2) with 0. lia.
Qed.

Theorem limbs_subtract : forall a b borrow, length a = length b -> Forall is_limb a -> Forall is_limb b -> 0 <= borrow <= 1 ->
  let (difference, last) := subtract_with a b borrow in
  Forall is_limb difference /\ length difference = length a /\ 0 <= last <= 1 /\
  whole a - whole b - borrow = whole difference - size a * last.
Proof.
  induction a as [|x a IH]; intros [|y b] borrow L Ha Hb Hc; try discriminate.
  { change (size []) with 1. cbn [subtract_with whole length]. split; [apply Forall_nil|lia]. }
  inversion_clear Ha as [|? ? Hx Ha']. inversion_clear Hb as [|? ? Hy Hb']. injection L as L. cbn [subtract_with].
  destruct (difference_of_limbs x y borrow Hx Hy Hc) as [N D]. set (t := double_word (x - y - borrow)) in *.
  set (next := Z.land (word (t / base)) 1) in *. specialize (IH b next L Ha' Hb' N). destruct (subtract_with a b next) as [rest last].
  destruct IH as (F & Len & Hl & S). split; [constructor; [apply word_limb|exact F]|]. split; [cbn [length]; now rewrite Len|].
  split; [exact Hl|]. rewrite size_cons. cbn [whole]. nia.
Qed.

(* Where the other is not larger, nothing is left to borrow. *)
Corollary limbs_subtract_smaller : forall a b, length a = length b -> Forall is_limb a -> Forall is_limb b -> whole b <= whole a ->
  Forall is_limb (fst (subtract_with a b 0)) /\ whole (fst (subtract_with a b 0)) = whole a - whole b.
Proof.
  intros a b L Ha Hb H. pose proof (limbs_subtract a b 0 L Ha Hb ltac:(lia)) as S. destruct (subtract_with a b 0) as [d last].
  destruct S as (F & Len & Hl & S). cbn [fst]. split; [exact F|]. pose proof (whole_bounds d F) as B. pose proof (size_pos a) as P.
  assert (size d = size a) by (unfold size; now rewrite Len). assert (last = 0) by nia. lia.
Qed.

(* ---- The product ---- *)

(* The inner loop: t = Product{a.limbs_[i]} * b.limbs_[j] + product[i + j] + carry. *)
Fixpoint multiply_row (x : Z) (b row : list Z) (carry : Z) : list Z * Z :=
  match b, row with
  | y :: b', p :: row' =>
      let t := double_word (x * y + p + carry) in
      let (rest, last) := multiply_row x b' row' (word (t / base)) in (word t :: rest, last)
  | _, _ => ([], carry)
  end.

(* The outer loop: `row` is what product[i], product[i + 1], … hold before limb i of a is used; product[i + kLimbs] = carry. *)
Fixpoint multiply_limbs (a b row : list Z) : list Z :=
  match a with
  | [] => row
  | x :: a' => let (low, carry) := multiply_row x b row 0 in
      match low ++ [carry] with lowest :: next => lowest :: multiply_limbs a' b next | [] => [] end
  end.

Lemma limbs_row : forall x b row carry, length b = length row -> is_limb x -> Forall is_limb b -> Forall is_limb row -> is_limb carry ->
  let (low, last) := multiply_row x b row carry in
  Forall is_limb low /\ length low = length b /\ is_limb last /\ x * whole b + whole row + carry = whole low + size b * last.
Proof.
  intros x. induction b as [|y b IH]; intros [|p row] carry L Hx Hb Hr Hc; try discriminate;
    [change (size []) with 1; cbn [multiply_row whole length]; split; [apply Forall_nil|split; [reflexivity|split; [exact Hc|lia]]]|].
  inversion_clear Hb as [|? ? Hy Hb']. inversion_clear Hr as [|? ? Hp Hr']. injection L as L. cbn [multiply_row].
  assert (T : 0 <= x * y + p + carry < base * base) by (unfold is_limb in *; nia).
  assert (E : double_word (x * y + p + carry) = x * y + p + carry) by (apply Z.mod_small; rewrite base_square; lia). rewrite E.
  set (t := x * y + p + carry) in *. assert (Q : is_limb (t / base)).
  { split; [apply Z.div_pos; [lia|reflexivity]|apply Z.div_lt_upper_bound; [reflexivity|lia]]. }
  assert (W : word (t / base) = t / base) by (apply Z.mod_small; exact Q). rewrite W.
  specialize (IH row (t / base) L Hx Hb' Hr' Q). destruct (multiply_row x b row (t / base)) as [rest last].
  destruct IH as (F & Len & Hl & S). split; [constructor; [apply word_limb|exact F]|]. split; [cbn [length]; now rewrite Len|].
  split; [exact Hl|]. pose proof (word_and_carry t ltac:(lia)) as D. rewrite size_cons. cbn [whole]. unfold t in *. nia.
Qed.

Lemma whole_app : forall a b, whole (a ++ b) = whole a + size a * whole b.
Proof.
  induction a as [|x a IH]; intro b; [cbn [app whole]; change (size []) with 1; ring|]. cbn [app whole]. rewrite IH, size_cons. ring.
Qed.

Theorem limbs_multiply : forall b a row, length b = length row -> b <> [] -> Forall is_limb a -> Forall is_limb b -> Forall is_limb row ->
  Forall is_limb (multiply_limbs a b row) /\ length (multiply_limbs a b row) = (length a + length b)%nat /\
  whole (multiply_limbs a b row) = whole a * whole b + whole row.
Proof.
  intro b. induction a as [|x a IH]; intros row L Hne Ha Hb Hr; [cbn; auto|]. inversion_clear Ha as [|? ? Hx Ha'].
  cbn [multiply_limbs]. pose proof (limbs_row x b row 0 L Hx Hb Hr ltac:(unfold is_limb; cbn; lia)) as R.
  destruct (multiply_row x b row 0) as [low carry]. destruct R as (F & Len & Hl & S).
  destruct low as [|lowest next]; [destruct b; [congruence|discriminate]|]. cbn [app]. inversion_clear F as [|? ? Hlow Fn].
  assert (Fa : Forall is_limb (next ++ [carry])) by (apply Forall_app; split; [exact Fn|constructor; [exact Hl|constructor]]).
  assert (La : length b = length (next ++ [carry])) by (rewrite app_length; cbn [length] in *; lia).
  destruct (IH (next ++ [carry]) La Hne Ha' Hb Fa) as (F2 & L2 & S2). split; [constructor; assumption|].
  split; [cbn [length]; lia|]. cbn [whole]. rewrite S2, whole_app. cbn [whole]. cbn [whole] in S.
  assert (Sz : size b = base * size next) by (unfold size; rewrite <- Len; cbn [length]; rewrite Nat2Z.inj_succ, Z.pow_succ_r by lia;
    reflexivity). rewrite Sz in S. nia.
Qed.

(* The loops leave out the limbs at the bottom that are 0: these change nothing. *)
Lemma row_of_zero : forall b row, length b = length row -> Forall is_limb row -> multiply_row 0 b row 0 = (row, 0).
Proof.
  induction b as [|y b IH]; intros [|p row] L H; try discriminate; [reflexivity|]. inversion_clear H as [|? ? Hp Hr]. injection L as L.
  cbn [multiply_row]. rewrite Z.mul_0_l, Z.add_0_l, Z.add_0_r. assert (D : double_word p = p).
  { unfold is_limb in Hp. apply Z.mod_small. rewrite base_square. nia. }
  rewrite D, Z.div_small by exact Hp. change (word 0) with 0. rewrite (IH row L Hr). unfold word. now rewrite Z.mod_small by exact Hp.
Qed.

Lemma row_over_zero : forall x b row p, is_limb p ->
  multiply_row x (0 :: b) (p :: row) 0 = let (rest, last) := multiply_row x b row 0 in (p :: rest, last).
Proof.
  intros x b row p Hp. cbn [multiply_row]. rewrite Z.mul_0_r, Z.add_0_l, Z.add_0_r. assert (D : double_word p = p).
  { unfold is_limb in Hp. apply Z.mod_small. rewrite base_square. nia. }
  rewrite D, Z.div_small by exact Hp. change (word 0) with 0. unfold word. now rewrite Z.mod_small by exact Hp.
Qed.
