(* SPDX-License-Identifier: BSD-3-Clause *)
(* What a number of binary64 was computed for: its exact value, how many units it is off that, and between which powers of two it is,
   so that nothing overflows and nothing is rounded below the normal numbers. *)
From Coq Require Import ZArith Reals Lia Lra.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations Nearness.
Open Scope R_scope.

Definition size (l h : Z) (a : R) : Prop := bpow radix2 l <= Rabs a <= bpow radix2 h.

Lemma size_times : forall l h m k a b, size l h a -> size m k b -> size (l + m) (h + k) (a * b).
Proof.
  intros l h m k a b Ha Hb. unfold size in *. rewrite Rabs_mult, !bpow_plus. pose proof (bpow_gt_0 radix2 l).
    pose proof (bpow_gt_0 radix2 m).
  split; apply Rmult_le_compat; try apply Rabs_pos; lra.
Qed.

Lemma size_over : forall l h m k a b, size l h a -> size m k b -> size (l - k) (h - m) (a / b).
Proof.
  intros l h m k a b Ha Hb. unfold Rdiv, Z.sub. apply size_times; [assumption|]. unfold size in *. rewrite Rabs_inv, !bpow_opp.
  pose proof (bpow_gt_0 radix2 m). split; apply Rinv_le; lra.
Qed.

Lemma size_root : forall l h a, size (2 * l) (2 * h) a -> 0 <= a -> size l h (sqrt a).
Proof.
  intros l h a Ha Hpos. unfold size in *. rewrite Rabs_pos_eq in Ha by assumption. rewrite Rabs_pos_eq by apply sqrt_pos.
  assert (E : forall e, sqrt (bpow radix2 (2 * e)) = bpow radix2 e).
  { intro e. replace (2 * e)%Z with (e + e)%Z by ring. rewrite bpow_plus. apply sqrt_square, bpow_ge_0. }
  rewrite <- (E l), <- (E h). split; apply sqrt_le_1_alt; lra.
Qed.

Lemma size_near : forall n l h a A, size l h A -> near n a A -> 0 <= n <= 100 -> size (l - 1) (h + 1) a.
Proof.
  intros n l h a A H Hnear Hn. unfold size in *. pose proof (near_size n a A Hnear Hn) as S. unfold Z.sub. rewrite !bpow_plus.
  change (bpow radix2 1) with 2. change (bpow radix2 (- (1))) with (/ 2). lra.
Qed.

Lemma size_more : forall l h m k a, size l h a -> (m <= l)%Z -> (h <= k)%Z -> size m k a.
Proof.
  intros l h m k a [Hl Hh] Hm Hk. split; [apply Rle_trans with (2 := Hl)|apply Rle_trans with (1 := Hh)]; now apply bpow_le.
Qed.

Lemma size_not_0 : forall l h a, size l h a -> a <> 0.
Proof. intros l h a [H _] ->. rewrite Rabs_R0 in H. pose proof (bpow_gt_0 radix2 l). lra. Qed.

Definition computes (v : binary64) (n : R) (A : R) (l h : Z) : Prop := exists a, is64 v a /\ near n a A /\ size l h A.

Lemma computes_more : forall v n m A l h l' h', computes v n A l h -> n <= m -> (l' <= l)%Z -> (h <= h')%Z -> computes v m A l' h'.
Proof.
  intros v n m A l h l' h' (a & Hv & Hn & Hs) Hm Hl Hh. exists a. split; [assumption|]. split.
  - now apply near_more with n.
  - now apply size_more with l h.
Qed.

Lemma exactly : forall v a l h, is64 v a -> size l h a -> computes v 0 a l h.
Proof. intros v a l h Hv Hs. exists a. split; [assumption|]. split; [apply near_exactly|assumption]. Qed.

Lemma computes_times : forall v w n m A B l h l' h', computes v n A l h -> computes w m B l' h' -> 0 <= n <= 30 -> 0 <= m <= 30 ->
  (-900 <= l + l')%Z -> (h + h' <= 900)%Z -> computes (times v w) (n + m + one) (A * B) (l + l') (h + h').
Proof.
  intros v w n m A B l h l' h' (a & Hv & Ha & Sa) (b & Hw & Hb & Sb) Hn Hm Hl Hh. exists (nearest64 (a * b)).
  assert (Sx : size (l + l') (h + h') (A * B)) by now apply size_times.
  assert (Hab : near (n + m) (a * b) (A * B)) by now apply near_times.
  assert (Sab : size (l + l' - 1) (h + h' + 1) (a * b)) by (apply size_near with (n + m) (A * B); try assumption; lra).
  split; [|split; [|assumption]].
  - apply times_is; try assumption. apply Rle_trans with (1 := proj2 Sab). apply bpow_le. lia.
  - replace (n + m + one) with (one + (n + m)) by ring. apply near_then with (a * b); [|assumption]. apply rounding_is_near. right.
    apply Rle_trans with (2 := proj1 Sab). apply bpow_le. lia.
Qed.

Lemma computes_over : forall v w n m A B l h l' h', computes v n A l h -> computes w m B l' h' -> 0 <= n <= 30 -> 0 <= m <= 30 ->
  (-900 <= l - h')%Z -> (h - l' <= 900)%Z -> computes (over v w) (n + m + one) (A / B) (l - h') (h - l').
Proof.
  intros v w n m A B l h l' h' (a & Hv & Ha & Sa) (b & Hw & Hb & Sb) Hn Hm Hl Hh. exists (nearest64 (a / b)).
  pose proof (size_not_0 _ _ _ Sb) as HB.
  assert (Sx : size (l - h') (h - l') (A / B)) by now apply size_over.
  assert (Hab : near (n + m) (a / b) (A / B)) by now apply near_over.
  assert (Sab : size (l - h' - 1) (h - l' + 1) (a / b)) by (apply size_near with (n + m) (A / B); try assumption; lra).
  split; [|split; [|assumption]].
  - apply over_is; try assumption.
    + apply (size_not_0 (l' - 1) (h' + 1)). apply size_near with m B; try assumption; lra.
    + apply Rle_trans with (1 := proj2 Sab). apply bpow_le. lia.
  - replace (n + m + one) with (one + (n + m)) by ring. apply near_then with (a / b); [|assumption]. apply rounding_is_near. right.
    apply Rle_trans with (2 := proj1 Sab). apply bpow_le. lia.
Qed.

Lemma computes_root : forall v n A l h, computes v n A (2 * l) (2 * h) -> 0 < A -> 0 <= n <= 30 -> (-400 <= l)%Z ->
  computes (square_root v) (n / 2 + one) (sqrt A) l h.
Proof.
  intros v n A l h (a & Hv & Ha & Sa) HA Hn Hl. exists (nearest64 (sqrt a)).
  assert (0 < a) by now apply (near_sign n a A).
  assert (Hr : near (n / 2) (sqrt a) (sqrt A)) by (apply near_root; [assumption|lra]).
  assert (Sx : size l h (sqrt A)) by (apply size_root; [assumption|lra]).
  assert (Sr : size (l - 1) (h + 1) (sqrt a)) by (apply size_near with (n / 2) (sqrt A); try assumption; lra).
  split; [|split; [|assumption]].
  - apply square_root_is; [assumption|lra].
  - replace (n / 2 + one) with (one + n / 2) by ring. apply near_then with (sqrt a); [|assumption]. apply rounding_is_near. right.
    apply Rle_trans with (2 := proj1 Sr). apply bpow_le. lia.
Qed.

(* ---- What a first stage may give for a component ---- *)

(* k units off at most, and 0 or of a size that the rounding test is right for. *)
Definition good (k : Z) (v : binary64) (exact : R) : Prop :=
  is_finite 53 1024 v = true /\ Rabs (value64 v - exact) <= IZR k * bpow radix2 (-53) * Rabs exact /\
  (value64 v = 0 \/ bpow radix2 (-126) <= Rabs (value64 v)) /\ Rabs (value64 v) < bpow radix2 127.

Lemma computed_is_good : forall k v n A l h, computes v n A l h -> 0 <= n <= 100 -> n * (1001 / 1000) <= IZR k ->
  (-125 <= l)%Z -> (h <= 125)%Z -> good k v A.
Proof.
  intros k v n A l h (a & [<- Fv] & Hnear & Hs) Hn Hk Hl Hh. pose proof (size_near n l h _ A Hs Hnear Hn) as S.
  split; [assumption|]. split; [|split].
  - apply Rle_trans with (1 := near_is_close n _ A Hnear Hn). apply Rmult_le_compat_r; [apply Rabs_pos|].
    replace (bpow radix2 (-53)) with unit53 by (unfold unit53; simpl; lra). pose proof unit_is_small.
    apply Rmult_le_compat_r; lra.
  - right. apply Rle_trans with (2 := proj1 S). apply bpow_le. lia.
  - apply Rle_lt_trans with (1 := proj2 S). apply bpow_lt. lia.
Qed.

Lemma zero_is_good : forall k v, is64 v 0 -> good k v 0.
Proof.
  intros k v [Hv Fv]. split; [assumption|]. rewrite Hv, Rminus_0_r, Rabs_R0. split; [right; ring|]. split; [now left|apply bpow_gt_0].
Qed.

Lemma exact_is_good : forall k v a, (0 <= k)%Z -> is64 v a -> (a = 0 \/ bpow radix2 (-126) <= Rabs a) ->
  Rabs a < bpow radix2 127 -> good k v a.
Proof.
  intros k v a Hk [<- Fv] H1 H2. split; [assumption|]. rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. split; [|now split].
  apply Rmult_le_pos; [|apply Rabs_pos]. apply Rmult_le_pos; [now apply IZR_le|apply bpow_ge_0].
Qed.
