(* SPDX-License-Identifier: BSD-3-Clause *)
(* Relative errors, counted in units of 2^-53 as differences of logarithms, so that those of products and quotients add. *)
From Coq Require Import ZArith Reals Lia Lra.
From Flocq Require Import Core Relative Plus_error.
From Forceshade Require Import Formats.
Open Scope R_scope.

Definition unit53 : R := / 9007199254740992.

(* a is exact times some e^r, |r| <= n units. *)
Definition near (n a exact : R) : Prop := exists r, a = exact * exp r /\ Rabs r <= n * unit53.

Lemma unit_is_small : 0 < unit53 <= / 1000000000000.
Proof. unfold unit53. lra. Qed.

Lemma near_exactly : forall a, near 0 a a.
Proof. intro a. exists 0. rewrite exp_0, Rabs_R0. lra. Qed.

Lemma near_more : forall n m a A, near n a A -> n <= m -> near m a A.
Proof.
  intros n m a A (r & Ha & Hr) Hm. exists r. split; [assumption|]. pose proof unit_is_small. apply Rle_trans with (1 := Hr).
  apply Rmult_le_compat_r; lra.
Qed.

Lemma near_times : forall n m a A b B, near n a A -> near m b B -> near (n + m) (a * b) (A * B).
Proof.
  intros n m a A b B (r & -> & Hr) (s & -> & Hs). exists (r + s). rewrite exp_plus. split; [ring|].
  apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

Lemma near_over : forall n m a A b B, near n a A -> near m b B -> B <> 0 -> near (n + m) (a / b) (A / B).
Proof.
  intros n m a A b B (r & -> & Hr) (s & -> & Hs) HB. exists (r - s). pose proof (exp_pos s). split.
  - unfold Rminus. rewrite exp_plus, exp_Ropp. field. lra.
  - apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra.
Qed.

Lemma near_root : forall n a A, near n a A -> 0 <= A -> near (n / 2) (sqrt a) (sqrt A).
Proof.
  intros n a A (r & -> & Hr) HA. exists (r / 2). split.
  - rewrite sqrt_mult_alt by assumption. f_equal. replace r with (r / 2 + r / 2) at 1 by field. rewrite exp_plus.
    apply sqrt_square. apply Rlt_le, exp_pos.
  - unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ 2)) by lra. lra.
Qed.

Lemma near_opp : forall n a A, near n a A -> near n (- a) (- A).
Proof. intros n a A (r & -> & Hr). exists r. split; [ring|assumption]. Qed.

(* ---- To relative errors and back ---- *)

Lemma exp_is_close : forall r, Rabs r <= / 1000000 -> Rabs (exp r - 1) <= Rabs r * (1 + / 1000).
Proof.
  intros r Hr. pose proof (exp_ineq1_le r) as Hlow. pose proof (exp_ineq1_le (- r)) as Hhigh. rewrite exp_Ropp in Hhigh.
  pose proof (exp_pos r) as Hp. apply Rabs_le_inv in Hr.
  assert (Hinv : exp r * (1 - r) <= 1).
  { apply Rle_trans with (exp r * / exp r); [apply Rmult_le_compat_l; lra|right; field; lra]. }
  destruct (Rle_lt_dec 0 r).
  - rewrite !Rabs_pos_eq by lra. nra.
  - rewrite (Rabs_left r) by lra. apply Rabs_le. nra.
Qed.

Lemma near_is_close : forall n a A, near n a A -> 0 <= n <= 100 -> Rabs (a - A) <= n * (1 + / 1000) * unit53 * Rabs A.
Proof.
  intros n a A (r & -> & Hr) Hn. replace (A * exp r - A) with ((exp r - 1) * A) by ring. rewrite Rabs_mult.
  apply Rmult_le_compat_r; [apply Rabs_pos|]. pose proof unit_is_small. assert (n * unit53 <= / 10000000000) by nra.
  apply Rle_trans with (Rabs r * (1 + / 1000)); [apply exp_is_close; lra|]. nra.
Qed.

Lemma close_is_near : forall e a A, Rabs (a - A) <= e * Rabs A -> 0 <= e <= / 1000000 -> near (e * (1 + / 1000) / unit53) a A.
Proof.
  intros e a A H He. destruct (Req_dec A 0) as [->|HA].
  { rewrite Rabs_R0, Rmult_0_r in H. exists 0. rewrite Rabs_R0. pose proof unit_is_small. split.
    - pose proof (Rabs_pos (a - 0)). destruct (Req_dec (a - 0) 0) as [|Hne]; [lra|apply Rabs_pos_lt in Hne; lra].
    - unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. nra. }
  assert (Hq : Rabs (a / A - 1) <= e).
  { replace (a / A - 1) with ((a - A) / A) by (field; assumption). unfold Rdiv. rewrite Rabs_mult, Rabs_inv.
    pose proof (Rabs_pos_lt A HA). apply Rmult_le_reg_r with (Rabs A); [assumption|]. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  apply Rabs_le_inv in Hq. assert (Hpos : 0 < a / A) by lra. exists (ln (a / A)). split.
  - rewrite exp_ln by assumption. field. assumption.
  - pose proof unit_is_small. unfold Rdiv at 2. rewrite Rmult_assoc, Rinv_l by lra. rewrite Rmult_1_r.
    set (q := a / A) in *. pose proof (exp_ineq1_le (ln q)) as Hhigh. rewrite exp_ln in Hhigh by assumption.
    pose proof (exp_ineq1_le (- ln q)) as Hlow. rewrite exp_Ropp, exp_ln in Hlow by assumption.
    assert (/ q * q = 1) by (field; lra). apply Rabs_le. split; [|nra].
    assert (/ q <= 1 + e * (1 + / 1000)); [|lra]. apply Rmult_le_reg_r with q; [assumption|]. nra.
Qed.

(* ---- Operations ---- *)

Definition one : R := 1001 / 1000.  (* of a rounding, in units *)

Lemma close_by_a_unit : forall a A, Rabs (a - A) <= unit53 * Rabs A -> near one a A.
Proof.
  intros a A H. pose proof unit_is_small. apply near_more with (unit53 * (1 + / 1000) / unit53).
  - apply close_is_near; [assumption|lra].
  - right. unfold one. field. lra.
Qed.

Lemma rounding_is_near : forall a, a = 0 \/ bpow radix2 (-1022) <= Rabs a -> near one (nearest64 a) a.
Proof.
  intros a [->|Ha].
  - rewrite round_0 by auto with typeclass_instances. apply near_more with 0; [apply near_exactly|unfold one; lra].
  - apply close_by_a_unit.
    pose proof (relative_error_N_FLT radix2 (-1074) 53 (eq_refl _) (fun n => negb (Z.even n)) a Ha) as H.
    replace unit53 with (/ 2 * bpow radix2 (-53 + 1)); [exact H|]. unfold unit53. simpl. lra.
Qed.

(* A sum is never rounded below the normal numbers. *)
Lemma sum_is_close : forall a b, generic_format radix2 fexp64 a -> generic_format radix2 fexp64 b ->
  Rabs (nearest64 (a + b) - (a + b)) <= unit53 * Rabs (a + b).
Proof.
  intros a b Ha Hb. destruct (Rle_or_lt (Rabs (a + b)) (bpow radix2 (53 + -1074))) as [H|H].
  - rewrite round_generic; auto with typeclass_instances.
    + rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. pose proof unit_is_small. pose proof (Rabs_pos (a + b)). nra.
    + apply FLT_format_plus_small; auto with typeclass_instances.
  - pose proof (relative_error_N_FLT radix2 (-1074) 53 (eq_refl _) (fun n => negb (Z.even n)) (a + b)) as G.
    replace unit53 with (/ 2 * bpow radix2 (-53 + 1)).
    + apply G. apply Rlt_le. apply Rle_lt_trans with (2 := H). apply bpow_le. lia.
    + unfold unit53. simpl. lra.
Qed.

Lemma sum_is_near : forall a b, generic_format radix2 fexp64 a -> generic_format radix2 fexp64 b -> near one (nearest64 (a + b)) (a + b).
Proof. intros a b Ha Hb. apply close_by_a_unit. now apply sum_is_close. Qed.

Lemma near_then : forall n m a b A, near n a b -> near m b A -> near (n + m) a A.
Proof.
  intros n m a b A (r & -> & Hr) (s & -> & Hs). exists (s + r). rewrite exp_plus. split; [ring|].
  apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

(* The size of what is near. *)
Lemma near_size : forall n a A, near n a A -> 0 <= n <= 100 -> Rabs A / 2 <= Rabs a <= 2 * Rabs A.
Proof.
  intros n a A H Hn. pose proof (near_is_close n a A H Hn) as C. pose proof unit_is_small. pose proof (Rabs_pos A).
  pose proof (Rabs_triang_inv a A) as T1. pose proof (Rabs_triang_inv A a) as T2. rewrite Rabs_minus_sym in T2.
  assert (n * (1 + / 1000) * unit53 <= / 1000) by nra. nra.
Qed.

Lemma near_sign : forall n a A, near n a A -> (0 < A -> 0 < a) /\ (A < 0 -> a < 0) /\ (A = 0 -> a = 0).
Proof. intros n a A (r & -> & _). pose proof (exp_pos r). repeat split; intros; nra. Qed.
