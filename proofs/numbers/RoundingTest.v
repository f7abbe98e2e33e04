(* SPDX-License-Identifier: BSD-3-Clause *)
(* The test that decides whether the binary64 number of a first stage may be rounded to binary32: fast/numbers/first_stage.h. *)
From Coq Require Import ZArith Znumtheory Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats.
Open Scope R_scope.

(* ---- Near a number of the grid ---- *)

(* t is a number in units of 2^ex, of which the grid of binary32 has every 2^k there. *)
Lemma nearest_on_grid : forall t ex k n, (0 <= k)%Z -> cexp radix2 fexp32 (t * bpow radix2 ex) = (ex + k)%Z ->
  Rabs (t - IZR n * bpow radix2 k) < bpow radix2 k / 2 -> nearest32 (t * bpow radix2 ex) = IZR n * bpow radix2 (ex + k).
Proof.
  intros t ex k n Hk Hc Ht. unfold round, scaled_mantissa. rewrite Hc. unfold F2R. simpl. f_equal. f_equal.
  apply Znearest_imp. pose proof (bpow_gt_0 radix2 k) as Hp.
  rewrite Rmult_assoc, <- bpow_plus. replace (ex + - (ex + k))%Z with (- k)%Z by ring.
  replace (t * bpow radix2 (- k) - IZR n) with ((t - IZR n * bpow radix2 k) * bpow radix2 (- k)).
  2: { rewrite Rmult_minus_distr_r, Rmult_assoc, <- bpow_plus, Z.add_opp_diag_r. simpl. ring. }
  rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 (- k))) by apply bpow_ge_0.
  replace (/ 2) with (bpow radix2 k / 2 * bpow radix2 (- k)).
  - apply Rmult_lt_compat_r; [apply bpow_gt_0|assumption].
  - unfold Rdiv. rewrite Rmult_assoc, (Rmult_comm (/ 2)), <- Rmult_assoc, <- bpow_plus, Z.add_opp_diag_r. simpl. ring.
Qed.

Lemma exponent_of : forall t ex g, bpow radix2 (g - 1) <= t < bpow radix2 g ->
  cexp radix2 fexp32 (t * bpow radix2 ex) = Z.max (g + ex - 24) (-149).
Proof.
  intros t ex g Ht. unfold cexp, FLT_exp. rewrite mag_mult_bpow.
  - now rewrite (mag_unique_pos radix2 t g Ht).
  - apply Rgt_not_eq. apply Rlt_le_trans with (2 := proj1 Ht). apply bpow_gt_0.
Qed.

(* m: a significand of 53 bits, and n what 24 bits of it leave. W units about m, nothing is half way between two of binary32. *)
Lemma rounds_to_the_same : forall W m n ex t,
  (0 <= W < 2 ^ 27)%Z -> (-178 <= ex)%Z -> (2 ^ 52 <= m < 2 ^ 53)%Z -> (Z.abs (m - n * 2 ^ 29) + W < 2 ^ 28)%Z ->
  Rabs (t - IZR m) <= IZR W -> nearest32 (t * bpow radix2 ex) = IZR n * bpow radix2 (ex + 29).
Proof.
  intros W m n ex t HW Hex Hm Hn Ht.
  assert (Hn24 : (2 ^ 23 <= n <= 2 ^ 24)%Z) by lia.
  assert (HW1 : IZR W <= 134217727) by (apply IZR_le; lia).
  assert (Hclose : Rabs (t - IZR n * 536870912) < 268435456).
  { replace (t - IZR n * 536870912) with (t - IZR m + IZR (m - n * 536870912)) by (rewrite minus_IZR, mult_IZR; ring).
    apply Rle_lt_trans with (1 := Rabs_triang _ _). apply Rle_lt_trans with (IZR W + IZR (Z.abs (m - n * 536870912))).
    - rewrite abs_IZR. lra.
    - rewrite <- plus_IZR. apply IZR_lt. lia. }
  apply Rabs_def2 in Hclose. apply Rabs_le_inv in Ht.
  assert (Hm0 : 4503599627370496 <= IZR m) by (apply IZR_le; lia).
  destruct (Rlt_or_le t 4503599627370496) as [Hlow|Hlow].
  - (* Below a power of two the grid is twice as fine, where it is not that of the subnormals. *)
    assert (n = 2 ^ 23)%Z.
    { cut (n < 2 ^ 23 + 1)%Z; [lia|]. apply lt_IZR. change (IZR (2 ^ 23 + 1)) with 8388609. lra. }
    subst n. pose proof (exponent_of t ex 52 ltac:(simpl; lra)) as Hexp.
    destruct (Z.eq_dec ex (-178)) as [->|Hne].
    + apply nearest_on_grid; [lia|rewrite Hexp; reflexivity|]. apply Rabs_def1; simpl; lra.
    + replace (IZR (2 ^ 23) * bpow radix2 (ex + 29)) with (IZR (2 ^ 24) * bpow radix2 (ex + 28)).
      * apply nearest_on_grid; [lia|rewrite Hexp; lia|]. apply Rabs_def1; simpl; lra.
      * replace (ex + 29)%Z with (1 + (ex + 28))%Z by ring. rewrite (bpow_plus radix2 1). change (bpow radix2 1) with 2.
        change (IZR (2 ^ 23)) with 8388608. change (IZR (2 ^ 24)) with 16777216. ring.
  - destruct (Rlt_or_le t 9007199254740992) as [Hhigh|Hhigh].
    + apply nearest_on_grid; [lia| |].
      * rewrite (exponent_of t ex 53); [lia|simpl; lra].
      * apply Rabs_def1; simpl; lra.
    + (* Up to 2^53 and beyond it, where the grid is twice as coarse. *)
      assert (n = 2 ^ 24)%Z.
      { cut (2 ^ 24 - 1 < n)%Z; [lia|]. apply lt_IZR. change (IZR (2 ^ 24 - 1)) with 16777215. lra. }
      subst n. replace (IZR (2 ^ 24) * bpow radix2 (ex + 29)) with (IZR (2 ^ 23) * bpow radix2 (ex + 30)).
      * apply nearest_on_grid; [lia| |].
        { rewrite (exponent_of t ex 54); [lia|simpl; lra]. }
        apply Rabs_def1; simpl; lra.
      * replace (ex + 30)%Z with (1 + (ex + 29))%Z by ring. rewrite (bpow_plus radix2 1). change (bpow radix2 1) with 2.
        change (IZR (2 ^ 23)) with 8388608. change (IZR (2 ^ 24)) with 16777216. ring.
Qed.

(* ---- The bits ---- *)

(* rounding_is_in_doubt<W>, on the 64 bits of the number: the sum is that of unsigned numbers of 64 bits. *)
Definition in_doubt (W bits : Z) : bool :=
  if (W =? 0)%Z then false
  else (2 ^ 29 - 1 - 2 * W <=? Z.land ((bits + ((2 ^ 29 - 1) / 2 - W)) mod 2 ^ 64) (2 ^ 29 - 1))%Z.

Lemma not_in_doubt : forall W bits, (0 < W < 2 ^ 27)%Z -> in_doubt W bits = false ->
  let d := (bits mod 2 ^ 29)%Z in (d + W < 2 ^ 28 \/ 2 ^ 28 + W < d)%Z.
Proof.
  intros W bits HW Hd. unfold in_doubt in Hd. rewrite (proj2 (Z.eqb_neq W 0)) in Hd by lia. apply Z.leb_gt in Hd.
  assert (Hland : forall a, Z.land a (2 ^ 29 - 1) = (a mod 2 ^ 29)%Z).
  { intro a. change (2 ^ 29 - 1)%Z with (Z.ones 29). rewrite Z.land_ones; [reflexivity|lia]. }
  rewrite Hland in Hd.
  rewrite <- (Zmod_div_mod (2 ^ 29) (2 ^ 64)) in Hd; [|reflexivity|reflexivity|now exists (2 ^ 35)%Z].
  change ((2 ^ 29 - 1) / 2)%Z with (2 ^ 28 - 1)%Z in Hd. rewrite <- Zplus_mod_idemp_l in Hd.
  pose proof (Z.mod_pos_bound bits (2 ^ 29) ltac:(lia)) as Hb. cbv zeta. set (d := (bits mod 2 ^ 29)%Z) in *.
  destruct (Z_lt_ge_dec (d + (2 ^ 28 - 1 - W)) (2 ^ 29)) as [H|H].
  - rewrite Z.mod_small in Hd by lia. lia.
  - lia.
Qed.

Lemma last_bits : forall s m ex H, (2 ^ 52 <= Zpos m)%Z ->
  (bits_of_b64 (B754_finite 53 1024 s m ex H) mod 2 ^ 29 = Zpos m mod 2 ^ 29)%Z.
Proof.
  intros s m ex H Hm. unfold bits_of_b64, bits_of_binary_float, join_bits.
  rewrite (proj2 (Z.leb_le 0 (Zpos m - 2 ^ 52))) by lia. rewrite Z.shiftl_mul_pow2 by lia.
  match goal with |- ((?x * 2 ^ 52 + _) mod _ = _)%Z => generalize x; intro high end.
  replace (high * 2 ^ 52 + (Zpos m - 2 ^ 52))%Z with (Zpos m + ((high - 1) * 2 ^ 23) * 2 ^ 29)%Z by ring.
  apply Z_mod_plus_full.
Qed.

(* ---- The test ---- *)

(* e: the law's kErrorBound, relative to the exact number; v: what the first stage computed. W: doubt_window(e), which
   window_covers() requires to be so large. *)
Theorem rounding_test_is_sound : forall W e (v : binary64) exact,
  (0 <= W < 2 ^ 27)%Z -> 0 <= e <= 1 / 2 -> e * bpow radix2 53 * (1 + 2 * e) <= IZR W ->
  is_finite 53 1024 v = true -> Rabs (value64 v - exact) <= e * Rabs exact ->
  value64 v = 0 \/ bpow radix2 (-126) <= Rabs (value64 v) ->
  in_doubt W (bits_of_b64 v) = false -> nearest32 (value64 v) = nearest32 exact.
Proof.
  intros W e v exact HW He Hcovers Hfinite Herror Hrange Htest.
  pose proof (Rabs_pos exact) as Hexact.
  assert (Hlarge : Rabs exact * (1 - e) <= Rabs (value64 v)).
  { pose proof (Rabs_triang_inv exact (exact - value64 v)) as T.
    replace (exact - (exact - value64 v)) with (value64 v) in T by ring. rewrite (Rabs_minus_sym exact) in T. lra. }
  destruct Hrange as [Hzero|Hnormal].
  { f_equal. rewrite Hzero, Rabs_R0 in Hlarge. assert (Rabs exact = 0) as H0 by nra.
    rewrite Hzero. symmetry. destruct (Req_dec exact 0) as [|Hne]; [assumption|now apply Rabs_no_R0 in Hne]. }
  destruct (Z.eq_dec W 0) as [->|HW0].
  { f_equal. assert (e = 0) as -> by (simpl in Hcovers; nra). rewrite Rmult_0_l in Herror.
    apply Rminus_diag_uniq. destruct (Req_dec (value64 v - exact) 0) as [|Hne]; [assumption|].
    pose proof (Rabs_pos_lt _ Hne). lra. }
  destruct (normal_parts v Hfinite Hnormal) as (s & m & ex & H & -> & Hex & Hm).
  apply not_in_doubt in Htest; [|lia]. rewrite last_bits in Htest by lia. cbv zeta in Htest.
  pose proof (Z.div_mod (Zpos m) (2 ^ 29) ltac:(lia)) as Hdiv. pose proof (Z.mod_pos_bound (Zpos m) (2 ^ 29) ltac:(lia)) as Hd.
  set (d := (Zpos m mod 2 ^ 29)%Z) in *. set (q := (Zpos m / 2 ^ 29)%Z) in *.
  assert (exists n, (Z.abs (Zpos m - n * 2 ^ 29) + W < 2 ^ 28)%Z) as [n Hn].
  { destruct Htest; [exists q|exists (q + 1)%Z]; lia. }
  (* In units of 2^ex, and with the sign of v. *)
  set (sign := if s then -1 else 1).
  assert (Hv : value64 (B754_finite 53 1024 s m ex H) = sign * (IZR (Zpos m) * bpow radix2 ex)).
  { unfold sign. destruct s; simpl; unfold F2R; simpl; [change (Z.neg m) with (- Zpos m)%Z; rewrite opp_IZR|]; ring. }
  pose proof (bpow_gt_0 radix2 ex) as Hs. set (t := sign * exact / bpow radix2 ex).
  assert (Ht : exact = sign * (t * bpow radix2 ex)).
  { unfold t, sign. destruct s; field; now apply Rgt_not_eq. }
  assert (Hsigned : forall x, nearest32 (sign * x) = sign * nearest32 x).
  { intro x. unfold sign. destruct s; [|now rewrite !Rmult_1_l].
    replace (-1 * x) with (- x) by ring. rewrite round_NE_opp. ring. }
  assert (Hsize : forall x, Rabs (sign * x) = Rabs x).
  { intro x. unfold sign. destruct s; [replace (-1 * x) with (- x) by ring; apply Rabs_Ropp|now rewrite Rmult_1_l]. }
  assert (Hm53 : IZR (Zpos m) <= bpow radix2 53) by (rewrite <- (IZR_Zpower radix2 53) by lia; apply IZR_le; simpl; lia).
  assert (Hunits : Rabs (t - IZR (Zpos m)) <= IZR W).
  { apply Rmult_le_reg_r with (1 := Hs). rewrite <- (Rabs_pos_eq (bpow radix2 ex)) at 1 by lra. rewrite <- Rabs_mult.
    rewrite <- (Hsize (_ * bpow radix2 ex)).
    replace (sign * ((t - IZR (Zpos m)) * bpow radix2 ex)) with (exact - value64 (B754_finite 53 1024 s m ex H)) by (rewrite Hv, Ht; ring).
    rewrite Rabs_minus_sym. apply Rle_trans with (1 := Herror).
    rewrite Hv, Hsize, (Rabs_pos_eq (_ * _)) in Hlarge by (apply Rmult_le_pos; [apply IZR_le; lia|lra]).
    apply Rle_trans with (e * bpow radix2 53 * (1 + 2 * e) * bpow radix2 ex); [|now apply Rmult_le_compat_r; [lra|]].
    assert (Rabs exact <= (1 + 2 * e) * (bpow radix2 53 * bpow radix2 ex)).
    { apply Rle_trans with ((1 + 2 * e) * (Rabs exact * (1 - e))).
      - replace ((1 + 2 * e) * (Rabs exact * (1 - e))) with (Rabs exact + Rabs exact * (e * (1 - 2 * e))) by ring.
        assert (0 <= Rabs exact * (e * (1 - 2 * e))) by (repeat apply Rmult_le_pos; lra). lra.
      - apply Rmult_le_compat_l; [lra|]. apply Rle_trans with (1 := Hlarge). apply Rmult_le_compat_r; lra. }
    replace (e * bpow radix2 53 * (1 + 2 * e) * bpow radix2 ex) with (e * ((1 + 2 * e) * (bpow radix2 53 * bpow radix2 ex))) by ring.
    apply Rmult_le_compat_l; [lra|assumption]. }
  rewrite Hv, Ht, !Hsigned. f_equal.
  rewrite (rounds_to_the_same W (Zpos m) n ex (IZR (Zpos m))); try assumption; try lia.
  2: { rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. apply IZR_le. lia. }
  now rewrite (rounds_to_the_same W (Zpos m) n ex t) by (assumption || lia).
Qed.

(* What a law returns from its first stage: kErrorBound is k 2^-53, and the window k + 1. *)
Theorem first_stage_returns_the_nearest : forall k (v : binary64) exact, (0 < k <= 2 ^ 20)%Z ->
  is_finite 53 1024 v = true -> Rabs (value64 v - exact) <= IZR k * bpow radix2 (-53) * Rabs exact ->
  value64 v = 0 \/ bpow radix2 (-126) <= Rabs (value64 v) -> Rabs (value64 v) < bpow radix2 127 ->
  in_doubt (k + 1) (bits_of_b64 v) = false -> is_nearest32 (returned v) exact.
Proof.
  intros k v exact Hk Hfinite Herror Hrange Hbelow Htest.
  assert (Hk1 : 1 <= IZR k <= 1048576) by (split; apply IZR_le; lia).
  assert (Heq : nearest32 (value64 v) = nearest32 exact).
  { apply (rounding_test_is_sound (k + 1) (IZR k * bpow radix2 (-53))); try assumption; try lia; [simpl; lra|].
    rewrite plus_IZR. rewrite (Rmult_assoc (IZR k)), <- bpow_plus. simpl. nra. }
  unfold is_nearest32. rewrite <- Heq. now apply returned_is_nearest.
Qed.
