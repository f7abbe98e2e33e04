(* SPDX-License-Identifier: BSD-3-Clause *)
(* Each operation on limbs and 64-bit exponents (proofs/limbs/WideNumbers.v) gives the limbs of what the operation on integers gives
   (proofs/big_float/BigFloat.v), and none of its exponents leaves 64 bits: what takes one number. *)
From Coq Require Import ZArith Reals Lia List Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations BigFloat BigFloatValues BigFloatProducts BigFloatNewton.
From Forceshade Require Import BigFloatNewtonLoop Limbs LimbShifts LimbNumbers LimbsAreDigits WideNumbers.
Import ListNotations.
Open Scope Z_scope.

Definition integer_of (l : wide) : big := Big (is_negative l) (whole (limbs l)) (binary_exponent l) (error_exponent l).

(* What the code keeps the exponent of an error in. *)
Definition clamped (e : Z) : Prop := e = none \/ least <= e <= infinite.

(* The limbs and exponents of `l` are those of `a`, which is normal, and its exponent is at most k in size. *)
Definition limbs_hold (count : nat) (k : Z) (l : wide) (a : big) : Prop :=
  (integer_of l = a /\ length (limbs l) = count /\ Forall is_limb (limbs l)) /\
  normal (64 * Z.of_nat count) a /\ - k <= exponent a <= k /\ clamped (error a).

Ltac numbers64 := unfold clamped, none, least, infinite, range in *.

Lemma clamped_clamp : forall e, clamped (clamp e).
Proof. intro e. unfold clamp. destruct (Z.ltb_spec e least); [now left|]. destruct (Z.ltb_spec infinite e); right; numbers64; lia. Qed.

Lemma int64_is : forall outside t, - 2 ^ 63 <= t < 2 ^ 63 -> int64 outside t = t.
Proof. intros outside t H. unfold int64. now rewrite (proj2 (Z.leb_le _ _)), (proj2 (Z.ltb_lt _ _)) by lia. Qed.

Lemma int32_is : forall outside t, - 2 ^ 31 <= t < 2 ^ 31 -> int32 outside t = t.
Proof. intros outside t H. unfold int32. now rewrite (proj2 (Z.leb_le _ _)), (proj2 (Z.ltb_lt _ _)) by lia. Qed.

(* No exponent leaves 64 bits, the innermost first. *)
Ltac exact64 :=
  repeat match goal with
  | |- context [int64 ?o ?t] => lazymatch t with context [int64] => fail | _ => rewrite (int64_is o t) by (numbers64; lia) end
  end.

(* ---- Lists ---- *)

Lemma whole_is_injective : forall l m, length l = length m -> Forall is_limb l -> Forall is_limb m -> whole l = whole m -> l = m.
Proof.
  induction l as [|x l IH]; intros [|y m] L Fl Fm W; try discriminate; [reflexivity|]. inversion_clear Fl as [|? ? Hx Fl'].
  inversion_clear Fm as [|? ? Hy Fm']. cbn [whole] in W. pose proof base_is. unfold is_limb in *.
  assert (whole l = whole m) by nia. assert (x = y) by nia. subst. f_equal. apply IH; try assumption. now injection L.
Qed.

Lemma top_of_zero : forall l, Forall is_limb l -> top l = O <-> whole l = 0.
Proof.
  intros l F. destruct (top_is l) as [T0 T]. split; intro H; [rewrite (T0 H); apply whole_zeros|].
  destruct (top l) as [|k]; [reflexivity|]. exfalso. destruct (T k eq_refl) as (low & t & E & _ & N). rewrite E in F, H.
  apply Forall_app in F. destruct F as [Fl Ft]. inversion_clear Ft as [|? ? Ht _]. rewrite whole_app in H. cbn [whole] in H.
  rewrite whole_zeros in H. pose proof (whole_bounds low Fl) as [B _]. pose proof (size_pos low). unfold is_limb in Ht. nia.
Qed.

Section Refined.
Context (outside : Z -> Z) (count : nat) (enough : (2 <= count <= 64)%nat).
Local Notation width := (64 * Z.of_nat count).
Local Notation limbs_hold := (limbs_hold count).

Lemma width_is : 128 <= width <= 4096. Proof. lia. Qed.

Lemma held_more : forall k j l a, limbs_hold k l a -> k <= j -> limbs_hold j l a.
Proof. intros k j l a (S & N & E & R) J. split; [exact S|]. split; [exact N|]. split; [lia|exact R]. Qed.

Lemma holds_positive : forall k l a, limbs_hold k l a -> 0 <= k.
Proof. intros k l a (_ & _ & E & _). lia. Qed.

Lemma holds_limbs : forall k l a, limbs_hold k l a -> has_limbs width a (limbs l).
Proof.
  intros k l a ((<- & L & F) & _). split; [destruct (limbs l); [cbn in L; lia|discriminate]|]. split; [exact F|].
  split; [unfold bits_of; now rewrite L|reflexivity].
Qed.

Lemma parts : forall k l a, limbs_hold k l a ->
  is_negative l = negative a /\ binary_exponent l = exponent a /\ error_exponent l = error a /\ whole (limbs l) = digits a.
Proof. intros k l a ((<- & _) & _). now cbn. Qed.

Lemma wide_zero_is : forall k l a, limbs_hold k l a -> wide_is_zero l = is_zero a.
Proof. intros k l a H. unfold wide_is_zero. symmetry. apply (is_zero_in_limbs width); [now apply (holds_limbs k)|apply H]. Qed.

Lemma wide_exact_zero_is : forall k l a, limbs_hold k l a -> wide_is_exact_zero l = is_exact_zero a.
Proof.
  intros k l a H. unfold wide_is_exact_zero, is_exact_zero, is_exact. rewrite (wide_zero_is k l a H).
  now destruct (parts k l a H) as (_ & _ & -> & _).
Qed.

Lemma wide_may_be_zero_is : forall k l a, k <= range -> limbs_hold k l a -> wide_may_be_zero outside l = may_be_zero a.
Proof.
  intros k l a K H. unfold wide_may_be_zero, may_be_zero. rewrite (wide_zero_is k l a H). destruct (parts k l a H) as (_ & -> & -> & _).
  destruct H as (_ & _ & E & _). exact64. reflexivity.
Qed.

Lemma wide_magnitude_is : forall k l a, k <= range -> limbs_hold k l a -> wide_magnitude outside l = magnitude a.
Proof.
  intros k l a K H. unfold wide_magnitude, magnitude. rewrite (wide_zero_is k l a H). destruct (parts k l a H) as (_ & -> & -> & _).
  destruct H as (_ & _ & E & R). apply int64_is. destruct (is_zero a); numbers64; lia.
Qed.

Lemma wide_sign_is : forall k l a, k <= range -> limbs_hold k l a -> wide_sign outside l = sign_of_big a.
Proof.
  intros k l a K H. unfold wide_sign, sign_of_big. rewrite (wide_may_be_zero_is k l a K H). now destruct (parts k l a H) as (-> & _).
Qed.

(* Another error. *)
Lemma with_error_holds : forall k l a e, limbs_hold k l a -> limbs_hold k (with_wide_error l e) (with_error a e).
Proof.
  intros k l a e ((<- & L & F) & N & E & _). split; [split; [reflexivity|now split]|]. split; [exact N|]. split; [exact E|].
  apply clamped_clamp.
Qed.

Lemma zero_holds : forall e, limbs_hold 0 (with_wide_error (wide_zero count) e) (with_error zero e).
Proof.
  intro e. split; [split; [|split; [apply repeat_length|apply zeros_are_limbs]]|].
  - unfold integer_of. cbn [limbs with_wide_error wide_zero]. rewrite whole_zeros. reflexivity.
  - split; [now left|]. split; [cbn [exponent with_error zero]; lia|apply clamped_clamp].
Qed.

Lemma exactly_holds : forall v, limbs_hold 1074 (wide_exactly count v) (exactly width v).
Proof.
  intro v. destruct (big_exactly_contains width v ltac:(lia)) as (_ & N & E & _). split; [|split; [exact N|split; [exact E|]]].
  2: { left. destruct v; reflexivity. }
  destruct v as [s|s|s p q|s m e H];
    try (split; [unfold integer_of; cbn [wide_exactly limbs wide_zero]; now rewrite whole_zeros|
      split; [apply repeat_length|apply zeros_are_limbs]]).
  cbn [wide_exactly exactly limbs]. destruct (significand_bits m e H) as [B _]. pose proof (Z.log2_nonneg (Zpos m)).
  destruct (Z.log2_spec (Zpos m)) as [_ U]; [lia|]. split; [|split].
  - unfold integer_of. cbn [limbs is_negative binary_exponent error_exponent]. rewrite one_limb by lia. reflexivity.
  - rewrite app_length, repeat_length. cbn [length]. lia.
  - apply Forall_app. split; [apply zeros_are_limbs|]. constructor; [|constructor]. unfold is_limb.
    set (b := Z.log2 (Zpos m) + 1) in *. replace (Z.succ (Z.log2 (Zpos m))) with b in U by (unfold b; lia).
    rewrite (base_split b) by lia. pose proof (power_pos (64 - b) ltac:(lia)). nia.
Qed.

Lemma negated_holds : forall k l a, limbs_hold k l a -> limbs_hold k (wide_negated l) (negated a).
Proof. intros k l a ((<- & L & F) & N & E & R). split; [split; [reflexivity|now split]|]. now split. Qed.

Lemma midpoint_holds : forall k l a, limbs_hold k l a -> limbs_hold k (wide_midpoint l) (midpoint a).
Proof. intros k l a ((<- & L & F) & N & E & R). split; [split; [reflexivity|now split]|]. split; [exact N|]. split; [exact E|now left]. Qed.

Lemma scaled_holds : forall k l a j, limbs_hold k l a -> k + Z.abs j <= range -> limbs_hold (k + Z.abs j) (wide_scaled outside l j)
  (scaled a j).
Proof.
  intros k l a j H J. pose proof (holds_positive _ _ _ H). destruct H as ((<- & L & F) & N & E & R). unfold wide_scaled, scaled.
  cbn [integer_of exponent error negative digits] in *. exact64. apply with_error_holds.
  split; [split; [reflexivity|now split]|]. split; [exact N|]. split; [cbn [exponent]; lia|exact R].
Qed.

Lemma widened_holds : forall k l a j, limbs_hold k l a -> k + Z.abs j <= range -> limbs_hold k (wide_widened outside l j) (widened a j).
Proof.
  intros k l a j H J. unfold wide_widened, widened. destruct (parts k l a H) as (_ & -> & _). pose proof H as (_ & _ & E & _).
  exact64. now apply with_error_holds.
Qed.

Lemma truncated_holds : forall k l a bits, limbs_hold k l a -> 0 <= bits <= range ->
  limbs_hold k (wide_truncated outside count l bits) (truncated width a bits).
Proof.
  intros k l a bits ((<- & L & F) & N & E & R) B. destruct (truncated_is width (integer_of l) bits ltac:(lia) ltac:(lia) N) as [Nt _].
  pose proof (Z.div_pos bits 64 ltac:(lia) ltac:(lia)) as B0. pose proof (Z.div_le_upper_bound bits 64 range ltac:(lia)
    ltac:(numbers64; lia)) as B1.
  split; [|split; [exact Nt|split; [exact E|now left]]]. unfold wide_truncated, truncated, integer_of in *.
  cbn [limbs is_negative binary_exponent
    error_exponent negative digits exponent error] in *. exact64. set (d := Z.to_nat (Z.of_nat count - (bits / 64 + 2))).
  assert (D : Z.max 0 (width / 64 - (bits / 64 + 2)) = Z.of_nat d).
  { rewrite Z.mul_comm, Z.div_mul by lia. unfold d. lia. }
  rewrite D. assert (Ld : (d <= length (limbs l))%nat) by lia. split; [|split].
  - now rewrite limbs_cut by assumption.
  - rewrite app_length, repeat_length, skipn_length. lia.
  - apply Forall_app. split; [apply zeros_are_limbs|now apply Forall_skipn].
Qed.

Lemma fraction_holds : forall k l a, limbs_hold k l a -> wide_fraction l = fraction width a.
Proof.
  intros k l a H. unfold wide_fraction, fraction. destruct (holds_limbs k l a H) as (Hne & F & W & D).
  rewrite (highest_limb _ Hne F), W, D. reflexivity.
Qed.

End Refined.
