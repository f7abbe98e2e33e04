(* SPDX-License-Identifier: BSD-3-Clause *)
(* The operations of binary64 that a first stage is written with (proofs/recorded/Recorded.v), and what each gives in real numbers. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats.
Open Scope R_scope.

(* FirstStage of fast/numbers/first_stage.h. *)
Record FirstStage := { first_x : binary64; first_z : binary64; first_contact : bool; first_doubt : bool }.

Definition plus : binary64 -> binary64 -> binary64 := b64_plus mode_NE.
Definition minus : binary64 -> binary64 -> binary64 := b64_minus mode_NE.
Definition times : binary64 -> binary64 -> binary64 := b64_mult mode_NE.
Definition over : binary64 -> binary64 -> binary64 := b64_div mode_NE.
Definition square_root : binary64 -> binary64 := b64_sqrt mode_NE.
Definition opp : binary64 -> binary64 := b64_opp.
Definition absolute : binary64 -> binary64 := b64_abs.

(* a < b, a <= b and a == b of C++, which are false where one of the two is a NaN. *)
Definition is_less (a b : binary64) : bool := match Bcompare 53 1024 a b with Some Lt => true | _ => false end.
Definition is_at_most (a b : binary64) : bool := match Bcompare 53 1024 a b with Some Lt | Some Eq => true | _ => false end.
Definition is_equal (a b : binary64) : bool := match Bcompare 53 1024 a b with Some Eq => true | _ => false end.
Definition larger (a b : binary64) : binary64 := if is_less b a then a else b.

(* a b + c and c - a b: in one operation, as packs of numbers have it, or in two. *)
Definition multiply_add (is_fused : bool) (a b c : binary64) : binary64 :=
  if is_fused then b64_fma mode_NE a b c else plus (times a b) c.
Definition multiply_subtract (is_fused : bool) (a b c : binary64) : binary64 :=
  if is_fused then b64_fma mode_NE (opp a) b c else minus c (times a b).

(* std::fma. *)
Definition fused : binary64 -> binary64 -> binary64 -> binary64 := b64_fma mode_NE.

(* 2^k, as C++ writes it 0x1pk. *)
Definition two_to (k : Z) : binary64 := binary_normalize 53 1024 (eq_refl _) (eq_refl _) mode_NE 1 k false.

(* v is a number and not infinite, and its value is a. *)
Definition is64 (v : binary64) (a : R) : Prop := value64 v = a /\ is_finite 53 1024 v = true.

Lemma format_of : forall v a, is64 v a -> generic_format radix2 fexp64 a.
Proof. intros v a [<- _]. apply (generic_format_B2R 53 1024). Qed.

(* Sizes up to 2^1000 do not overflow. *)
Lemma does_not_overflow : forall a, Rabs a <= bpow radix2 1000 -> Rlt_bool (Rabs (nearest64 a)) (bpow radix2 1024) = true.
Proof.
  intros a Ha. apply Rlt_bool_true. apply Rle_lt_trans with (bpow radix2 1000); [|now apply bpow_lt].
  apply abs_round_le_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia.
Qed.

Ltac operation H := cbv zeta in H;
  change (round radix2 (SpecFloat.fexp 53 1024) (round_mode mode_NE)) with nearest64 in H; rewrite does_not_overflow in H by assumption.

Lemma plus_is : forall v w a b, is64 v a -> is64 w b -> Rabs (a + b) <= bpow radix2 1000 -> is64 (plus v w) (nearest64 (a + b)).
Proof.
  intros v w a b [<- Fv] [<- Fw] H. unfold plus, b64_plus.
  match goal with |- context [Bplus _ _ ?p ?q ?nan _ _ _] => pose proof (Bplus_correct 53 1024 p q nan mode_NE v w Fv Fw) as C end.
  operation C. now destruct C as (C1 & C2 & _).
Qed.

Lemma minus_is : forall v w a b, is64 v a -> is64 w b -> Rabs (a - b) <= bpow radix2 1000 -> is64 (minus v w) (nearest64 (a - b)).
Proof.
  intros v w a b [<- Fv] [<- Fw] H. unfold minus, b64_minus.
  match goal with |- context [Bminus _ _ ?p ?q ?nan _ _ _] => pose proof (Bminus_correct 53 1024 p q nan mode_NE v w Fv Fw) as C end.
  operation C. now destruct C as (C1 & C2 & _).
Qed.

Lemma times_is : forall v w a b, is64 v a -> is64 w b -> Rabs (a * b) <= bpow radix2 1000 -> is64 (times v w) (nearest64 (a * b)).
Proof.
  intros v w a b [<- Fv] [<- Fw] H. unfold times, b64_mult.
  match goal with |- context [Bmult _ _ ?p ?q ?nan _ _ _] => pose proof (Bmult_correct 53 1024 p q nan mode_NE v w) as C end.
  operation C. destruct C as (C1 & C2 & _). rewrite Fv, Fw in C2. now split.
Qed.

Lemma over_is : forall v w a b, is64 v a -> is64 w b -> b <> 0 -> Rabs (a / b) <= bpow radix2 1000 ->
  is64 (over v w) (nearest64 (a / b)).
Proof.
  intros v w a b [<- Fv] [<- Fw] Hb H. unfold over, b64_div.
  match goal with |- context [Bdiv _ _ ?p ?q ?nan _ _ _] => pose proof (Bdiv_correct 53 1024 p q nan mode_NE v w Hb) as C end.
  operation C. destruct C as (C1 & C2 & _). rewrite Fv in C2. now split.
Qed.

Lemma square_root_is : forall v a, is64 v a -> 0 <= a -> is64 (square_root v) (nearest64 (sqrt a)).
Proof.
  intros v a [<- Fv] Ha. unfold square_root, b64_sqrt.
  match goal with |- context [Bsqrt _ _ ?p ?q ?nan _ _] => pose proof (Bsqrt_correct 53 1024 p q nan mode_NE v) as C end.
  destruct C as (C1 & C2 & _). split; [exact C1|]. rewrite C2. destruct v as [s|s|s pl H|s m e H]; try discriminate; [reflexivity|].
  destruct s; [|reflexivity]. exfalso. revert Ha. apply Rlt_not_le. now apply F2R_lt_0.
Qed.

Lemma opp_is : forall v a, is64 v a -> is64 (opp v) (- a).
Proof. intros v a [<- Fv]. unfold opp, b64_opp. split; [apply B2R_Bopp|now rewrite is_finite_Bopp]. Qed.

Lemma absolute_is : forall v a, is64 v a -> is64 (absolute v) (Rabs a).
Proof. intros v a [<- Fv]. unfold absolute, b64_abs. split; [apply B2R_Babs|now rewrite is_finite_Babs]. Qed.

Lemma zero_is : is64 zero64 0.
Proof. now split. Qed.

Lemma less_is : forall v w a b, is64 v a -> is64 w b -> is_less v w = Rlt_bool a b.
Proof.
  intros v w a b [<- Fv] [<- Fw]. unfold is_less. rewrite Bcompare_correct by assumption. unfold Rlt_bool.
  destruct (Rcompare _ _); reflexivity.
Qed.

Lemma at_most_is : forall v w a b, is64 v a -> is64 w b -> is_at_most v w = Rle_bool a b.
Proof.
  intros v w a b [<- Fv] [<- Fw]. unfold is_at_most. rewrite Bcompare_correct by assumption. unfold Rle_bool.
  destruct (Rcompare _ _); reflexivity.
Qed.

Lemma equal_is : forall v w a b, is64 v a -> is64 w b -> is_equal v w = Req_bool a b.
Proof.
  intros v w a b [<- Fv] [<- Fw]. unfold is_equal. rewrite Bcompare_correct by assumption. unfold Req_bool.
  destruct (Rcompare _ _); reflexivity.
Qed.

Lemma larger_is : forall v w a b, is64 v a -> is64 w b -> is64 (larger v w) (Rmax a b).
Proof.
  intros v w a b Hv Hw. unfold larger. rewrite (less_is w v b a) by assumption. unfold Rmax.
  case Rlt_bool_spec; intro H; destruct (Rle_dec a b); try assumption; [lra|]. replace a with b by lra. assumption.
Qed.

Lemma select_is : forall (condition : bool) v w a b, is64 v a -> is64 w b ->
  is64 (if condition then v else w) (if condition then a else b).
Proof. intros [|] v w a b Hv Hw; assumption. Qed.

Lemma two_to_is : forall k, (-1074 <= k <= 1000)%Z -> is64 (two_to k) (bpow radix2 k).
Proof.
  intros k Hk. unfold two_to.
  pose proof (binary_normalize_correct 53 1024 (eq_refl _) (eq_refl _) mode_NE 1 k false) as C.
  replace (F2R (Float radix2 1 k)) with (bpow radix2 k) in C by (unfold F2R; cbn [Fnum Fexp]; now rewrite Rmult_1_l).
  assert (Hsize : Rabs (bpow radix2 k) <= bpow radix2 1000) by (rewrite Rabs_pos_eq by apply bpow_ge_0; apply bpow_le; lia).
  operation C. destruct C as (C1 & C2 & _). split; [|exact C2]. rewrite C1. apply round_generic; auto with typeclass_instances.
  apply generic_format_bpow. unfold FLT_exp. lia.
Qed.

Lemma fused_is : forall u v w a b c, is64 u a -> is64 v b -> is64 w c -> Rabs (a * b + c) <= bpow radix2 1000 ->
  is64 (fused u v w) (nearest64 (a * b + c)).
Proof.
  intros u v w a b c [<- Fu] [<- Fv] [<- Fw] H. unfold fused, b64_fma.
  match goal with |- context [Bfma _ _ ?p ?q ?nan _ _ _ _] =>
    pose proof (Bfma_correct 53 1024 p q nan mode_NE u v w Fu Fv Fw) as C end.
  operation C. now destruct C as (C1 & C2 & _).
Qed.

(* Fused or not, where the product is a number of binary64. *)
Lemma multiply_add_is : forall is_fused u v w a b c, is64 u a -> is64 v b -> is64 w c -> generic_format radix2 fexp64 (a * b) ->
  Rabs (a * b) <= bpow radix2 1000 -> Rabs (a * b + c) <= bpow radix2 1000 ->
  is64 (multiply_add is_fused u v w) (nearest64 (a * b + c)).
Proof.
  intros [|] u v w a b c Hu Hv Hw Hformat Hproduct H; unfold multiply_add.
  - now apply fused_is.
  - apply plus_is; try assumption. rewrite <- (round_generic radix2 fexp64 ZnearestE (a * b)) by assumption. now apply times_is.
Qed.

Lemma multiply_subtract_is : forall is_fused u v w a b c, is64 u a -> is64 v b -> is64 w c -> generic_format radix2 fexp64 (a * b) ->
  Rabs (a * b) <= bpow radix2 1000 -> Rabs (c - a * b) <= bpow radix2 1000 ->
  is64 (multiply_subtract is_fused u v w) (nearest64 (c - a * b)).
Proof.
  intros [|] u v w a b c Hu Hv Hw Hformat Hproduct H; unfold multiply_subtract.
  - replace (c - a * b) with (- a * b + c) in * by ring.
    apply (multiply_add_is true); try assumption; [now apply opp_is| |].
    + replace (- a * b) with (- (a * b)) by ring. now apply generic_format_opp.
    + replace (- a * b) with (- (a * b)) by ring. now rewrite Rabs_Ropp.
  - apply minus_is; try assumption. rewrite <- (round_generic radix2 fexp64 ZnearestE (a * b)) by assumption. now apply times_is.
Qed.
