(* SPDX-License-Identifier: BSD-3-Clause *)
(* The limbs of the third stage's number, continued: shifts, comparisons and single limbs. fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Lia List Bool.
From Forceshade Require Import BigFloatValues Limbs.
Import ListNotations.
Open Scope Z_scope.

(* ---- Bits ---- *)

Lemma or_is_sum : forall x y k, 0 <= k -> 0 <= x < 2 ^ k -> Z.lor x (y * 2 ^ k) = x + y * 2 ^ k.
Proof.
  intros x y k K X. assert (N : Z.land x (y * 2 ^ k) = 0).
  { apply Z.bits_inj'. intros n Hn. rewrite Z.land_spec, Z.bits_0. destruct (Z_lt_le_dec n k) as [L|L].
    - rewrite Z.mul_pow2_bits_low by lia. apply andb_false_r.
    - destruct (Z.eq_dec x 0) as [->|X0]; [now rewrite Z.bits_0|]. rewrite (Z.bits_above_log2 x n); [reflexivity|lia|].
      apply Z.log2_lt_pow2; [lia|]. apply Z.lt_le_trans with (1 := proj2 X). apply Z.pow_le_mono_r; lia. }
  rewrite <- Z.lxor_lor by exact N. symmetry. now apply Z.add_nocarry_lxor.
Qed.

Lemma base_split : forall part, 0 <= part <= 64 -> base = 2 ^ part * 2 ^ (64 - part).
Proof. intros part H. rewrite <- Z.pow_add_r by lia. replace (part + (64 - part)) with 64 by ring. reflexivity. Qed.

(* The upper bits that a shift to the left keeps. *)
Lemma word_shifted : forall a part, 0 <= part <= 64 -> word (a * 2 ^ (64 - part)) = a mod 2 ^ part * 2 ^ (64 - part).
Proof. intros a part H. unfold word. rewrite (base_split part H). apply Z.mul_mod_distr_r; apply Z.pow_nonzero; lia. Qed.

Lemma size_of_length : forall (l : list Z) n, length l = n -> size l = base ^ Z.of_nat n.
Proof. intros l n <-. reflexivity. Qed.

Lemma base_power : forall n, 0 <= n -> base ^ n = 2 ^ (64 * n).
Proof. intros n H. unfold base. now rewrite <- Z.pow_mul_r by lia. Qed.

Lemma whole_zeros : forall n, whole (repeat 0 n) = 0.
Proof. induction n as [|n IH]; [reflexivity|]. cbn [repeat whole]. rewrite IH. ring. Qed.

Lemma zeros_are_limbs : forall n, Forall is_limb (repeat 0 n).
Proof. induction n; constructor; trivial. unfold is_limb. rewrite base_is. lia. Qed.

Lemma whole_split : forall n l, (n <= length l)%nat -> whole l = whole (firstn n l) + base ^ Z.of_nat n * whole (skipn n l).
Proof.
  intros n l H. rewrite <- (firstn_skipn n l) at 1. rewrite whole_app. f_equal. f_equal. apply size_of_length. now apply firstn_length_le.
Qed.

Lemma Forall_firstn : forall n l, Forall is_limb l -> Forall is_limb (firstn n l).
Proof. intros n l H. rewrite <- (firstn_skipn n l) in H. now apply Forall_app in H. Qed.

Lemma Forall_skipn : forall n l, Forall is_limb l -> Forall is_limb (skipn n l).
Proof. intros n l H. rewrite <- (firstn_skipn n l) in H. now apply Forall_app in H. Qed.

(* ---- shift_right ---- *)

(* part == 0 ? low : (low >> part) | (high << (64 - part)) *)
Definition limb_between (part low high : Z) : Z :=
  if part =? 0 then low else Z.lor (low / 2 ^ part) (word (high * 2 ^ (64 - part))).
Fixpoint shift_part (part : Z) (l : list Z) : list Z :=
  match l with [] => [] | a :: rest => limb_between part a (hd 0 rest) :: shift_part part rest end.

(* The limbs after the shift, and whether a bit was lost. *)
Definition shift_right_limbs (count : Z) (l : list Z) : list Z * bool :=
  if (64 * Z.of_nat (length l) <=? count) then (repeat 0 (length l), true)
  else
    let n := Z.to_nat (count / 64) in let part := count mod 64 in
    (shift_part part (skipn n l) ++ repeat 0 n,
     existsb (fun a => negb (a =? 0)) (firstn n l) || (negb (part =? 0) && negb (word (nth n l 0 * 2 ^ (64 - part)) =? 0))).

Lemma limb_between_is : forall part low high, 0 <= part < 64 -> is_limb low ->
  is_limb (limb_between part low high) /\ limb_between part low high = low / 2 ^ part + high mod 2 ^ part * 2 ^ (64 - part).
Proof.
  intros part low high P L. unfold limb_between. destruct (Z.eqb_spec part 0) as [->|N].
  - split; [exact L|]. change (2 ^ 0) with 1. rewrite Z.div_1_r, Z.mod_1_r. ring.
  - pose proof (base_split part ltac:(lia)) as B. pose proof (power_pos part ltac:(lia)).
    pose proof (power_pos (64 - part) ltac:(lia)).
    assert (D : 0 <= low / 2 ^ part < 2 ^ (64 - part)).
    { unfold is_limb in L. split; [apply Z.div_pos; lia|apply Z.div_lt_upper_bound; lia]. }
    rewrite word_shifted by lia. rewrite or_is_sum by lia. split; [|reflexivity]. pose proof (Z.mod_pos_bound high (2 ^ part) ltac:(lia)).
    unfold is_limb. nia.
Qed.

Lemma low_limb : forall rest, Forall is_limb rest -> forall part, 0 <= part <= 64 -> hd 0 rest mod 2 ^ part = whole rest mod 2 ^ part.
Proof.
  intros [|a rest] H part P; [reflexivity|]. cbn [hd whole].
  replace (a + base * whole rest) with (a + 2 ^ (64 - part) * whole rest * 2 ^ part) by (rewrite (base_split part P); ring).
  symmetry. apply Z.mod_add. apply Z.pow_nonzero; lia.
Qed.

Lemma shift_part_is : forall part l, 0 <= part < 64 -> Forall is_limb l ->
  Forall is_limb (shift_part part l) /\ length (shift_part part l) = length l /\ whole (shift_part part l) = whole l / 2 ^ part.
Proof.
  intros part l P. induction l as [|a rest IH]; intro H; [cbn [shift_part whole]; repeat split; constructor|].
  inversion_clear H as [|? ? Ha Hr]. destruct (IH Hr) as (F & Len & S). destruct (limb_between_is part a (hd 0 rest) P Ha) as [L E].
  cbn [shift_part]. split; [now constructor|]. split; [cbn [length]; now rewrite Len|]. cbn [whole].
    rewrite E, S, (low_limb rest Hr) by lia.
  pose proof (power_pos part ltac:(lia)) as P2. pose proof (Z.div_mod (whole rest) (2 ^ part) ltac:(lia)) as D.
  pose proof (base_split part ltac:(lia)) as B. set (k := 2 ^ (64 - part)) in *. set (W := whole rest) in *.
  assert (X : (a + base * W) / 2 ^ part = a / 2 ^ part + k * W).
  { rewrite B. replace (a + 2 ^ part * k * W) with (a + k * W * 2 ^ part) by ring. apply Z.div_add. lia. }
  rewrite X. rewrite B. set (q := W / 2 ^ part) in *. set (r := W mod 2 ^ part) in *. set (p := 2 ^ part) in *. nia.
Qed.

Lemma all_zero : forall l, Forall is_limb l -> existsb (fun a => negb (a =? 0)) l = negb (whole l =? 0).
Proof.
  induction l as [|a l IH]; intro H; [reflexivity|]. inversion_clear H as [|? ? Ha Hl]. cbn [existsb whole]. rewrite (IH Hl).
  pose proof (whole_bounds l Hl) as B. pose proof base_is. unfold is_limb in Ha.
  destruct (Z.eqb_spec a 0), (Z.eqb_spec (whole l) 0), (Z.eqb_spec (a + base * whole l) 0); try reflexivity; exfalso; nia.
Qed.

Theorem limbs_shift_right : forall count l, Forall is_limb l -> 0 <= count -> whole l <> 0 \/ count < 64 * Z.of_nat (length l) ->
  let (r, lost) := shift_right_limbs count l in
  Forall is_limb r /\ length r = length l /\ whole r = whole l / 2 ^ count /\ lost = negb (whole l mod 2 ^ count =? 0).
Proof.
  intros count l H C Hne. unfold shift_right_limbs. pose proof (whole_bounds l H) as B.
  destruct (Z.leb_spec (64 * Z.of_nat (length l)) count) as [L|L].
  - assert (S : whole l < 2 ^ count).
    { apply Z.lt_le_trans with (1 := proj2 B). unfold size. rewrite base_power by lia. apply Z.pow_le_mono_r; lia. }
    split; [apply zeros_are_limbs|]. split; [apply repeat_length|]. rewrite whole_zeros, Z.div_small, Z.mod_small by lia.
    split; [reflexivity|]. destruct (Z.eqb_spec (whole l) 0); [lia|reflexivity].
  - pose proof (Z.div_mod count 64 ltac:(lia)) as D. pose proof (Z.mod_pos_bound count 64 ltac:(lia)) as M.
    pose proof (Z.div_pos count 64 ltac:(lia) ltac:(lia)) as Q. set (q := count / 64) in *. set (part := count mod 64) in *.
    set (n := Z.to_nat q). assert (N : Z.of_nat n = q) by (unfold n; lia). assert (Ln : (n < length l)%nat) by lia.
    destruct (shift_part_is part (skipn n l) M (Forall_skipn n l H)) as (F & Len & S).
    pose proof (whole_split n l ltac:(lia)) as W. rewrite N, base_power in W by lia.
    pose proof (whole_bounds (firstn n l) (Forall_firstn n l H)) as Bf.
    rewrite (size_of_length _ n) in Bf by (apply firstn_length_le; lia). rewrite N, base_power in Bf by lia.
    assert (P : 2 ^ count = 2 ^ (64 * q) * 2 ^ part) by (rewrite <- Z.pow_add_r by lia; f_equal; lia).
    pose proof (power_pos (64 * q) ltac:(lia)) as P1. pose proof (power_pos part ltac:(lia)) as P2.
    split; [apply Forall_app; split; [exact F|apply zeros_are_limbs]|].
    split; [rewrite app_length, Len, skipn_length, repeat_length; lia|]. split.
    + rewrite whole_app, whole_zeros, S, P, <- Z.div_div by lia. rewrite W. rewrite (Z.add_comm (whole (firstn n l))).
      rewrite (Z.mul_comm (2 ^ (64 * q))), Z.div_add_l, (Z.div_small (whole (firstn n l))) by lia. rewrite Z.add_0_r. ring.
    + rewrite (all_zero _ (Forall_firstn n l H)).
      assert (Hd : nth n l 0 = hd 0 (skipn n l)).
      { rewrite <- (firstn_skipn n l) at 1. rewrite app_nth2; rewrite firstn_length_le by lia; [|lia]. rewrite Nat.sub_diag.
        now destruct (skipn n l). }
      rewrite Hd, word_shifted by lia. rewrite (low_limb _ (Forall_skipn n l H)) by lia.
      set (low := whole (firstn n l)) in *. set (high := whole (skipn n l)) in *.
      assert (Mo : whole l mod 2 ^ count = low + 2 ^ (64 * q) * (high mod 2 ^ part)).
      { rewrite P, Z.rem_mul_r by lia. rewrite W at 1. rewrite (Z.mul_comm (2 ^ (64 * q)) high), Z.mod_add, (Z.mod_small low) by lia.
        f_equal. f_equal. rewrite W. rewrite (Z.mul_comm (2 ^ (64 * q)) high), Z.div_add, (Z.div_small low) by lia. reflexivity. }
      rewrite Mo. pose proof (Z.mod_pos_bound high (2 ^ part) ltac:(lia)) as Bm. pose proof (power_pos (64 - part) ltac:(lia)) as P3.
      destruct (Z.eqb_spec part 0) as [E|E].
      * rewrite E in *. change (2 ^ 0) with 1 in *. rewrite Z.mod_1_r, Z.mul_0_r, Z.add_0_r. cbn [negb andb]. apply orb_false_r.
      * destruct (Z.eqb_spec low 0), (Z.eqb_spec (high mod 2 ^ part * 2 ^ (64 - part)) 0),
          (Z.eqb_spec (low + 2 ^ (64 * q) * (high mod 2 ^ part)) 0); try reflexivity; exfalso; nia.
Qed.
