(* SPDX-License-Identifier: BSD-3-Clause *)
(* Operations of binary32, and t = (R - rho) / rho by them: 9.12 units of 2^-24 off at most, as real numbers. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Relative BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Gap.
From Forceshade Require Import SecondAlong.
From Forceshade Require Import Lanes LaneAnswers BumpLanes.
Import ListNotations.
Open Scope R_scope.

(* ---- Operations of binary32 ---- *)

Definition unit24 : R := / 16777216.
Definition tiny32 : R := bpow radix2 (-140).

Lemma tiny32_is_tiny : 0 <= tiny32 <= / 1000000000000000000000000000000000000000000.
Proof. unfold tiny32. split; [apply bpow_ge_0|]. apply Rle_trans with (bpow radix2 (-140)); [lra|]. simpl. lra. Qed.

Lemma rounds32 : forall a, Rabs a <= bpow radix2 100 -> Rlt_bool (Rabs (nearest32 a)) (bpow radix2 128) = true.
Proof.
  intros a Ha. apply Rlt_bool_true. apply Rle_lt_trans with (bpow radix2 100); [|now apply bpow_lt].
  apply abs_round_le_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia.
Qed.

Lemma close32 : forall a, Rabs (nearest32 a - a) <= unit24 * Rabs a + tiny32.
Proof.
  intro a. destruct (error_N_FLT radix2 (-149) 24 (eq_refl _) (fun n => negb (Z.even n)) a) as (e & f & He & Hf & _ & E). rewrite E.
  replace (a * (1 + e) + f - a) with (a * e + f) by ring. apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat.
  - rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos|]. apply Rle_trans with (1 := He). unfold unit24. simpl. lra.
  - apply Rle_trans with (1 := Hf). unfold tiny32. apply Rle_trans with (1 * bpow radix2 (-149)).
    + apply Rmult_le_compat_r; [apply bpow_ge_0|lra].
    + rewrite Rmult_1_l. apply bpow_le. lia.
Qed.

Ltac operation32 H := cbv zeta in H;
  change (round radix2 (SpecFloat.fexp 24 128) (round_mode mode_NE)) with nearest32 in H; rewrite rounds32 in H by assumption.

Lemma plus32_is : forall v w a b, is32 v a -> is32 w b -> Rabs (a + b) <= bpow radix2 100 -> is32 (plus32 v w) (nearest32 (a + b)).
Proof.
  intros v w a b [<- Fv] [<- Fw] H. unfold plus32, b32_plus.
  match goal with |- context [Bplus _ _ ?p ?q ?nan _ _ _] => pose proof (Bplus_correct 24 128 p q nan mode_NE v w Fv Fw) as C end.
  operation32 C. now destruct C as (C1 & C2 & _).
Qed.

Lemma minus32_is : forall v w a b, is32 v a -> is32 w b -> Rabs (a - b) <= bpow radix2 100 -> is32 (minus32 v w) (nearest32 (a - b)).
Proof.
  intros v w a b [<- Fv] [<- Fw] H. unfold minus32, b32_minus.
  match goal with |- context [Bminus _ _ ?p ?q ?nan _ _ _] => pose proof (Bminus_correct 24 128 p q nan mode_NE v w Fv Fw) as C end.
  operation32 C. now destruct C as (C1 & C2 & _).
Qed.

Lemma over32_is : forall v w a b, is32 v a -> is32 w b -> b <> 0 -> Rabs (a / b) <= bpow radix2 100 -> is32 (over32 v w) (nearest32 (a /
  b)).
Proof.
  intros v w a b [<- Fv] [<- Fw] Hb H. unfold over32, b32_div.
  match goal with |- context [Bdiv _ _ ?p ?q ?nan _ _ _] => pose proof (Bdiv_correct 24 128 p q nan mode_NE v w Hb) as C end.
  operation32 C. destruct C as (C1 & C2 & _). rewrite Fv in C2. now split.
Qed.

Lemma square_root32_is : forall v a, is32 v a -> 0 <= a -> is32 (square_root32 v) (nearest32 (sqrt a)).
Proof.
  intros v a [<- Fv] Ha. unfold square_root32, b32_sqrt.
  match goal with |- context [Bsqrt _ _ ?p ?q ?nan _ _] => pose proof (Bsqrt_correct 24 128 p q nan mode_NE v) as C end.
  destruct C as (C1 & C2 & _). split; [exact C1|]. rewrite C2. destruct v as [s|s|s pl H|s m e H]; try discriminate; [reflexivity|].
  destruct s; [|reflexivity]. exfalso. revert Ha. apply Rlt_not_le. now apply F2R_lt_0.
Qed.

Lemma to32_is : forall v a, is64 v a -> Rabs a <= bpow radix2 100 -> is32 (to32 v) (nearest32 a).
Proof.
  intros v a [<- F] H. pose proof (rounds32 _ H) as L. destruct (to32_rounds_once v F) as [V2 F2]; [|now split].
  destruct (Rlt_bool_spec (Rabs (nearest32 (value64 v))) (bpow radix2 128)) as [L2|L2]; [exact L2|discriminate].
Qed.

(* ---- t in binary32 ---- *)

Definition rough : R := 912 / 100 * unit24.  (* how far t is off, relative *)

(* Real numbers: rho = 1, by which all are divided; r is R, and t is to be r - 1. *)
Lemma rough_t_is : forall r v s2 root prod sum t, 0 < r <= 25002 / 10000 ->
  Rabs (v - (r * r - 1)) <= 10001 / 10000 * unit24 * Rabs (r * r - 1) ->
  Rabs (s2 - 1) <= unit24 * (10001 / 10000 * Rabs (r * r - 1) + 20001 / 10000) ->
  Rabs (root - sqrt s2) <= 10001 / 10000 * unit24 * sqrt s2 -> Rabs (prod - r * root) <= 10001 / 10000 * unit24 * (r * root) ->
  Rabs (sum - (prod + s2)) <= 10001 / 10000 * unit24 * (prod + s2) ->
  Rabs (t - v / sum) <= 10001 / 10000 * unit24 * Rabs (v / sum) -> Rabs (t - (r - 1)) <= rough * Rabs (r - 1).
Proof.
  intros r v s2 root prod sum t Hr Hv Hs Hroot Hprod Hsum Ht. set (e := unit24) in *. assert (He : 0 < e <= / 10000000) by (unfold e,
    unit24; lra).
  set (m := Rabs (r * r - 1)) in *.
  assert (Rm : (m = r * r - 1 /\ 1 <= r) \/ (m <= 1 /\ r <= 1)).
  { destruct (Rle_or_lt 1 r) as [H|H]; [left|right].
    - split; [|exact H]. unfold m. apply Rabs_pos_eq. assert (1 * 1 <= r * r) by (apply Rmult_le_compat; lra). lra.
    - split; [|lra]. unfold m. assert (0 <= r * r <= 1) by (split; [apply Rmult_le_pos; lra|rewrite <- (Rmult_1_l 1); apply
      Rmult_le_compat; lra]).
      apply Rabs_le. lra. }
  assert (Hrr : 0 <= r * r <= 62511 / 10000).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (25002 / 10000 * (25002 / 10000)); [apply Rmult_le_compat; lra|lra]. }
  assert (Bm : 0 <= m <= 52511 / 10000) by (split; [apply Rabs_pos|destruct Rm as [[-> _]|[Rm _]]; lra]).
  (* s2 = 1 + a, its root 1 + b *)
  set (a := s2 - 1) in *. assert (Ba : Rabs a <= e * (10001 / 10000 * m + 20001 / 10000)) by exact Hs.
  assert (Ba2 : Rabs a <= / 1000000).
  { apply Rle_trans with (1 := Ba). apply Rle_trans with (e * 10); [apply Rmult_le_compat_l; lra|lra]. }
  pose proof (Rabs_le_inv _ _ Ba2) as Ba3. set (q := sqrt s2) in *.
  assert (S2 : q * q = s2) by (apply sqrt_sqrt; unfold a in Ba3; lra). assert (Q0 : 0 <= q) by apply sqrt_pos.
  assert (Qb : Rabs (q - 1) <= 50001 / 100000 * Rabs a).
  { assert (Q1 : 99999 / 100000 <= q) by (destruct (Rle_or_lt (99999 / 100000) q) as [H|H]; [exact H|exfalso;
      assert (q * q <= 99999 / 100000 * (99999 / 100000)) by (apply Rmult_le_compat; lra); unfold a in Ba3; lra]).
    assert (E : (q - 1) * (q + 1) = a) by (unfold a; rewrite <- S2; ring). rewrite <- E, Rabs_mult, (Rabs_pos_eq (q + 1)) by lra.
    pose proof (Rabs_pos (q - 1)). assert (Rabs (q - 1) * (199999 / 100000) <= Rabs (q - 1) * (q + 1)) by (apply Rmult_le_compat_l; lra).
      lra. }
  assert (Q1 : 999999 / 1000000 <= q <= 1000001 / 1000000) by (pose proof (Rabs_le_inv _ _ Qb); lra).
  assert (Bb : Rabs (root - 1) <= 50001 / 100000 * Rabs a + 10002 / 10000 * e).
  { replace (root - 1) with ((root - q) + (q - 1)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    assert (10001 / 10000 * e * q <= 10001 / 10000 * e * (1000001 / 1000000)) by (apply Rmult_le_compat_l; lra). lra. }
  assert (B1 : Rabs (root - 1) <= / 1000000) by lra. pose proof (Rabs_le_inv _ _ B1) as B2.
  set (b := root - 1) in *. assert (Er : root = 1 + b) by (unfold b; ring). rewrite Er in *.
  (* prod = r (1 + c) *)
  assert (Bc : Rabs (prod - r) <= r * (Rabs b + 10002 / 10000 * e)).
  { replace (prod - r) with ((prod - r * (1 + b)) + r * b) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    rewrite Rabs_mult, (Rabs_pos_eq r) by lra.
    assert (10001 / 10000 * e * (r * (1 + b)) <= r * (10002 / 10000 * e)).
    { replace (10001 / 10000 * e * (r * (1 + b))) with (r * (10001 / 10000 * e * (1 + b))) by ring. apply Rmult_le_compat_l; [lra|].
      assert (10001 / 10000 * e * (1 + b) <= 10001 / 10000 * e * (1000001 / 1000000)) by (apply Rmult_le_compat_l; lra). lra. }
    lra. }
  (* the sum, next to r + 1 *)
  set (W := r + 1) in *. assert (HW : 1 < W) by (unfold W; lra).
  set (A := e * (10001 / 10000 * m + 20001 / 10000)) in *.
  assert (Bd : Rabs (prod + s2 - W) <= r * (50001 / 100000 * A + 20004 / 10000 * e) + A).
  { replace (prod + s2 - W) with ((prod - r) + a) by (unfold W, a; ring). apply Rle_trans with (1 := Rabs_triang _ _).
    apply Rplus_le_compat; [|exact Ba]. apply Rle_trans with (1 := Bc). apply Rmult_le_compat_l; lra. }
  assert (Bd2 : r * (50001 / 100000 * A + 20004 / 10000 * e) + A <= 6097 / 1000 * e * W).
  { unfold A, W. destruct Rm as [[-> H]|[Rm H]].
    - apply Rle_trans with (e * (r * (50001 / 100000 * (10001 / 10000 * (r * r - 1) + 20001 / 10000) + 20004 / 10000) + (10001 / 10000 *
      (r * r - 1) + 20001 / 10000)));
        [right; ring|]. replace (6097 / 1000 * e * (r + 1)) with (e * (6097 / 1000 * (r + 1))) by ring. apply Rmult_le_compat_l; [lra|].
      set (z := r * r) in *. assert (Z1 : r * z <= 62511 / 10000 * r) by (rewrite Rmult_comm; apply Rmult_le_compat_r; lra).
      assert (Z2 : z <= 35002 / 10000 * r - 250 / 100).
      { unfold z. assert ((r - 1) * (r - 25002 / 10000) <= 0).
        { replace ((r - 1) * (r - 25002 / 10000)) with (- ((r - 1) * (25002 / 10000 - r))) by ring.
          assert (0 <= (r - 1) * (25002 / 10000 - r)) by (apply Rmult_le_pos; lra). lra. } lra. }
      replace (r * (50001 / 100000 * (10001 / 10000 * (z - 1) + 20001 / 10000) + 20004 / 10000)) with
        (50001 / 100000 * (10001 / 10000 * (r * z - r) + 20001 / 10000 * r) + 20004 / 10000 * r) by ring. lra.
    - apply Rle_trans with (e * (r * (50001 / 100000 * (10001 / 10000 + 20001 / 10000) + 20004 / 10000) + (10001 / 10000 + 20001 / 10000))).
      + replace (e * (r * (50001 / 100000 * (10001 / 10000 + 20001 / 10000) + 20004 / 10000) + (10001 / 10000 + 20001 / 10000))) with
          (r * (50001 / 100000 * (e * (10001 / 10000 + 20001 / 10000)) + 20004 / 10000 * e) + e * (10001 / 10000 + 20001 / 10000)) by ring.
        assert (e * (10001 / 10000 * m + 20001 / 10000) <= e * (10001 / 10000 + 20001 / 10000)) by (apply Rmult_le_compat_l; lra).
        apply Rplus_le_compat; [apply Rmult_le_compat_l; lra|lra].
      + replace (6097 / 1000 * e * (r + 1)) with (e * (6097 / 1000 * (r + 1))) by ring. apply Rmult_le_compat_l; lra. }
  assert (Bs : Rabs (prod + s2 - W) <= 6097 / 1000 * e * W) by lra. pose proof (Rabs_le_inv _ _ Bs) as Bs2.
  assert (eW : 0 < e * W) by (apply Rmult_lt_0_compat; lra). assert (eW2 : e * W <= / 10000000 * W) by (apply Rmult_le_compat_r; lra).
  assert (Bsum : Rabs (sum - W) <= 7098 / 1000 * e * W).
  { replace (sum - W) with ((sum - (prod + s2)) + (prod + s2 - W)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    assert (10001 / 10000 * e * (prod + s2) <= 10001 / 10000 * e * (100001 / 100000 * W)) by (apply Rmult_le_compat_l; lra). lra. }
  pose proof (Rabs_le_inv _ _ Bsum) as Bsum2. assert (Hsum1 : 99999 / 100000 * W <= sum) by lra. assert (Hsum0 : 0 < sum) by lra.
  (* the quotient *)
  set (V := r * r - 1) in *. assert (EV : V = (r - 1) * W) by (unfold V, W; ring). fold m in Hv. set (T := r - 1) in *.
  assert (Em : m = Rabs T * W) by (unfold m; rewrite EV, Rabs_mult, (Rabs_pos_eq W) by lra; reflexivity).
  assert (Bq : Rabs (v / sum - T) <= 81 / 10 * e * Rabs T).
  { replace (v / sum - T) with ((v - V + T * (W - sum)) / sum) by (rewrite EV; field; lra).
    unfold Rdiv. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq sum) by lra. apply Rmult_le_reg_r with sum; [exact Hsum0|].
    rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_mult, (Rabs_minus_sym W sum).
    assert (Rabs T * Rabs (sum - W) <= Rabs T * (7098 / 1000 * e * W)) by (apply Rmult_le_compat_l; [apply Rabs_pos|exact Bsum]).
    rewrite Em in Hv. assert (P0 : 0 <= e * Rabs T) by (apply Rmult_le_pos; [lra|apply Rabs_pos]).
    assert (e * Rabs T * (99999 / 100000 * W) <= e * Rabs T * sum) by (apply Rmult_le_compat_l; [exact P0|exact Hsum1]).
    assert (0 <= e * Rabs T * W) by (apply Rmult_le_pos; lra). lra. }
  assert (P0 : 0 <= e * Rabs T) by (apply Rmult_le_pos; [lra|apply Rabs_pos]).
  assert (Rabs (v / sum) <= 1000002 / 1000000 * Rabs T).
  { pose proof (Rabs_triang_inv (v / sum) T). assert (e * Rabs T <= / 10000000 * Rabs T) by (apply Rmult_le_compat_r; [apply
    Rabs_pos|lra]). lra. }
  replace (t - T) with ((t - v / sum) + (v / sum - T)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
  assert (10001 / 10000 * e * Rabs (v / sum) <= 10001 / 10000 * e * (1000002 / 1000000 * Rabs T)) by (apply Rmult_le_compat_l; lra).
  unfold rough. fold e. lra.
Qed.
