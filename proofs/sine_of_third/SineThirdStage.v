(* SPDX-License-Identifier: BSD-3-Clause *)
(* t = sin(alpha / 3) in the third stage: sine_of_third of fast/laws/bump_geometry.h with numbers of fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Inputs ErrorFree TwoPolygonsConstants DoubleDoubleNear.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleTerms ThreePolygonsFace ThreePolygonsConstants NewtonStart NewtonRounded.
From Forceshade Require Import SineOfThird SineEnclosed BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients
  BigFloatRight.
From Forceshade Require Import BigFloatTight BigFloatDecide ThirdAlong NewtonThirdStage.
Open Scope R_scope.

Definition whole_big (width n : Z) : big := exactly width (whole n).
Definition third_value_big (width : Z) (s y : big) : big :=
  add width (multiply width (subtract width (multiply width (multiply width (whole_big width 4) y) y) (whole_big width 3)) y) s.
Definition third_slope_big (width : Z) (y : big) : big :=
  subtract width (multiply width (multiply width (whole_big width 12) y) y) (whole_big width 3).
Definition rest_value_big (width : Z) (r y : big) : big :=
  subtract width (multiply width (multiply width (subtract width (whole_big width 6) (multiply width (whole_big width 4) y)) y) y) r.
Definition rest_slope_big (width : Z) (y : big) : big :=
  multiply width (multiply width (whole_big width 12) y) (subtract width (whole_big width 1) y).

Definition sine_of_third_big (width : Z) (R w : binary32) : big :=
  if is_at_most (half_over_radius R w) (two_to (-1)) then
    newton_root_big width (third_value_big width (divide_newton width (exactly width (half_width w)) (exactly width (to64 R))))
      (third_slope_big width) (third_start R w)
  else if is_equal (half_width w) (to64 R) then exactly width (two_to (-1))
  else subtract width (exactly width (two_to (-1)))
    (newton_root_big width (rest_value_big width (divide_newton width (exactly width (minus (to64 R) (half_width w)))
      (exactly width (to64 R))))
      (rest_slope_big width) (rest_start R w)).

Lemma whole_tight : forall width n u, (128 <= width <= 4096)%Z -> (Z.abs n < 1000)%Z -> (- range <= u <= -3)%Z ->
  tight width 1074 u (whole_big width n) (IZR n).
Proof. intros width n u W N U. apply tight_exactly; [lia|exact U|]. apply whole_is. lia. Qed.

(* A sum that may cancel wholly. *)
Lemma sum_error : forall width k t u g a b x y, (128 <= width)%Z -> (k + width + 3 <= range)%Z -> tight width k t a x ->
  tight width k u b y ->
  (t <= 20 - width)%Z -> (u <= 20 - width)%Z -> Rabs x <= bpow radix2 g -> Rabs y <= bpow radix2 g -> (-10000 <= g)%Z ->
  (width <= 4096)%Z -> let r := add width a b in
  normal width r /\ fits (k + width + 3) r /\ contains width r (x + y) /\ (error r = none \/ (error r <= g + 24 - width)%Z).
Proof.
  intros width k t u g a b x y W Hr Ta Tb Ht Hu Bx By G W2 r. pose proof Ta as (Na & Fa & Ca & _). pose proof Tb as (Nb & Fb & Cb & _).
  destruct (big_sum_contains width k a b ltac:(lia) Hr Na Nb Fa Fb) as (N & F & C).
  split; [exact N|]. split; [exact F|]. split; [now apply C|]. destruct (error_of_sum width a b) as [E|E]; [now left|right].
  apply Z.le_trans with (1 := E). clear E.
  assert (one : forall v c z, (v <= 20 - width)%Z -> tight width k v c z -> Rabs z <= bpow radix2 g ->
    (error c = none \/ error c <= g + 22 - width)%Z /\ (is_zero c = true \/ exponent c <= g + 2)%Z).
  { intros v c z V T B. pose proof T as (_ & Fc & _).
    destruct (tight_cases width k v c z ltac:(lia) ltac:(lia) T) as [[X _]|(_ & _ & _ & _ & Ec & P & _)].
    - destruct (exact_zero_parts k c ltac:(lia) Fc X) as [Z ->]. split; now left.
    - assert (exponent c - 2 <= g)%Z by (apply (le_bpow radix2); lra). split; right; lia. }
  destruct (one t a x Ht Ta Bx) as [Ea Xa]. destruct (one u b y Hu Tb By) as [Eb Xb].
  destruct (is_zero a), (is_zero b); cbn [orb]; destruct Xa as [Xa|Xa], Xb as [Xb|Xb]; try discriminate;
    destruct Ea as [-> | Ea], Eb as [-> | Eb]; numbers; lia.
Qed.

(* ---- s at most 1/2 ---- *)

Lemma size_of_root : forall t, / 100000000 <= t <= 33 / 100 -> exists e, (-40 <= e <= 0)%Z /\ bpow radix2 (e - 1) <= t < bpow radix2 e.
Proof.
  intros t Ht. exists (mag radix2 t). destruct (mag radix2 t) as [e H]. cbn [mag_val]. specialize (H ltac:(lra)).
  rewrite (Rabs_pos_eq t) in H by lra. split; [|exact H]. assert (-40 < e)%Z; [|assert (e - 1 < 0)%Z; [|lia]]; apply (lt_bpow radix2).
  - apply Rle_lt_trans with (/ 100000000); [simpl; lra|lra].
  - change (bpow radix2 0) with 1. lra.
Qed.

Lemma third_is_fine : forall width s sigma t e, (128 <= width <= 4096)%Z -> tight width 400000 (14 - width) s sigma ->
  / 60000000 <= t <= / 2 -> 4 * (t * t * t) - 3 * t + sigma = 0 -> sigma <= 5001 / 10000 -> 0 < sigma ->
  (-40 <= e <= 0)%Z -> bpow radix2 (e - 1) <= t < bpow radix2 e ->
  newton_is_fine width (third_value_big width s) (third_slope_big width) (fun y => (4 * y * y - 3) * y + sigma) (fun y => 12 * y * y - 3) t
    e (e + 2) 1.
Proof.
  intros width s sigma t e W Ts Bt E Bs Ps He Bte. pose proof (third_is_small sigma t Bs ltac:(lra) E) as Hsmall.
  assert (P20 : bpow radix2 (-20) = / 1048576) by reflexivity.
  assert (Btt : 0 <= t * t <= 302 / 10000).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (1737 / 10000 * (1737 / 10000)); [apply Rmult_le_compat; lra|lra]. }
  assert (Bst : sigma <= 3 * t) by (assert (0 <= t * t * t) by (apply Rmult_le_pos; lra); lra).
  assert (arg : forall y, Rabs (y - t) <= bpow radix2 (-20) * t -> 99999 / 100000 * t <= y <= 100001 / 100000 * t /\
    0 <= y * y <= 303 / 10000 /\
    0 <= y * t <= 303 / 10000).
  { intros y H. rewrite P20 in H. apply Rabs_le_inv in H. assert (B : 99999 / 100000 * t <= y <= 100001 / 100000 * t) by lra.
    split; [exact B|].
    split; (split; [apply Rmult_le_pos; lra|]).
    - apply Rle_trans with (17372 / 100000 * (17372 / 100000)); [apply Rmult_le_compat; lra|lra].
    - apply Rle_trans with (17372 / 100000 * (1737 / 10000)); [apply Rmult_le_compat; lra|lra]. }
  split.
  - lra.
  - exact (third_derivative sigma).
  - now split.
  - lia.
  - intros y rho Hr Hy. pose proof (newton_for_third_converges sigma t y rho Bs ltac:(lra) E ltac:(lra) Hy) as N.
    replace (y - (4 * (y * y * y) - 3 * y + sigma) / (12 * (y * y) - 3) - t) with (y - ((4 * y * y - 3) * y + sigma) / (12 * y * y - 3) - t)
      in N by (do 2 f_equal; f_equal; ring).
    apply Rle_trans with (1 := N). apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_r; [apply Rmult_le_pos; lra|lra].
  - intros y r Hr H. assert (H20 : Rabs (y - t) <= bpow radix2 (-20) * t).
    { apply Rle_trans with (1 := H). apply Rmult_le_compat_r; [lra|]. now apply bpow_le. }
    destruct (arg y H20) as (B1 & B2 & B3).
    replace ((4 * y * y - 3) * y + sigma) with ((y - t) * (4 * (y * y + y * t + t * t) - 3)) by lra.
    replace (r + (e + 2))%Z with (r + e + 2)%Z by ring. rewrite !bpow_plus. change (bpow radix2 2) with 4. rewrite Rabs_mult.
    apply Rmult_le_compat; try apply Rabs_pos; [|apply Rabs_le; lra].
    apply Rle_trans with (1 := H). apply Rmult_le_compat_l; [apply bpow_ge_0|lra].
  - intros x y Tx H. destruct (arg y H) as (B1 & B2 & B3). unfold third_value_big, subtract.
    pose proof (whole_tight width 4 (1 - width) W ltac:(lia) ltac:(numbers; lia)) as T4.
    pose proof (whole_tight width 3 (1 - width) W ltac:(lia) ltac:(numbers; lia)) as T3.
    pose proof (tight_multiply width 1074 (1 - width) (1 - width) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) T4 Tx) as A1.
    assert (A1' : tight width 10000 (4 - width) (multiply width (whole_big width 4) x) (4 * y))
      by (apply tight_more with (1 := A1); [numbers; lia|lia]).
    assert (Tx1 : tight width 10000 (1 - width) x y) by (apply tight_more with (1 := Tx); [numbers; lia|lia]).
    pose proof (tight_multiply width 10000 (4 - width) (1 - width) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia)
      A1' Tx1) as A2.
    set (b := multiply width (multiply width (whole_big width 4) x) x) in *.
    assert (A2' : tight width 30000 (7 - width) b (4 * y * y)) by (apply tight_more with (1 := A2); [numbers; lia|lia]).
    assert (T3' : tight width 30000 (1 - width) (negated (whole_big width 3)) (- (3)))
      by (apply tight_negated; apply tight_more with (1 := T3); [numbers; lia|lia]).
    destruct (seen_sum width 30000 (7 - width) (1 - width) 4 3 _ _ _ _ ltac:(lia) ltac:(numbers; lia) A2' T3') as (_ & _ & _ & A3);
      try lia; try intros _; try (change (bpow radix2 (4 - 2)) with 4; apply Rabs_le; lra).
    { change (bpow radix2 (4 - 3)) with 2. rewrite Rabs_left; lra. }
    specialize (A3 ltac:(lra)).
    assert (A3' : tight width 50000 (13 - width) (add width b (negated (whole_big width 3))) (4 * y * y + - (3)))
      by (apply tight_more with (1 := A3); [numbers; lia|lia]).
    assert (Tx2 : tight width 50000 (1 - width) x y) by (apply tight_more with (1 := Tx); [numbers; lia|lia]).
    pose proof (tight_multiply width 50000 (13 - width) (1 - width) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia)
      A3' Tx2) as A4.
    assert (A4' : tight width 400000 (16 - width) (multiply width (add width b (negated (whole_big width 3))) x) ((4 * y * y + - (3)) * y))
      by (apply tight_more with (1 := A4); [numbers; lia|lia]).
    assert (E4 : bpow radix2 (e + 2) = bpow radix2 e * 4) by (rewrite bpow_plus; reflexivity).
    destruct (sum_error width 400000 (16 - width) (14 - width) (e + 2) _ _ _ _ ltac:(lia) ltac:(numbers; lia) A4' Ts ltac:(lia) ltac:(lia))
      as (N & F & C & X); try lia.
    + rewrite Rabs_mult, (Rabs_left (4 * y * y + - (3))) by lra. rewrite (Rabs_pos_eq y) by lra.
      apply Rle_trans with (3 * (100001 / 100000 * t)); [apply Rmult_le_compat; lra|lra].
    + rewrite Rabs_pos_eq; lra.
    + split; [exact N|]. split; [apply fits_le with (2 := F); numbers; lia|]. split; [exact C|]. destruct X as [X|X]; [now left|right; lia].
  - intros x y u Tx Hu H. destruct (arg y H) as (B1 & B2 & B3). unfold third_slope_big, subtract.
    pose proof (whole_tight width 12 u W ltac:(lia) ltac:(numbers; lia)) as T12.
    pose proof (whole_tight width 3 u W ltac:(lia) ltac:(numbers; lia)) as T3.
    pose proof (tight_multiply width 1074 u u _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) T12 Tx) as A1.
    assert (A1' : tight width 10000 (u + 3) (multiply width (whole_big width 12) x) (12 * y))
      by (apply tight_more with (1 := A1); [numbers; lia|lia]).
    assert (Tx1 : tight width 10000 u x y) by (apply tight_more with (1 := Tx); [numbers; lia|lia]).
    pose proof (tight_multiply width 10000 (u + 3) u _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) A1' Tx1) as A2.
    set (b := multiply width (multiply width (whole_big width 12) x) x) in *.
    assert (A2' : tight width 30000 (u + 6) b (12 * y * y)) by (apply tight_more with (1 := A2); [numbers; lia|lia]).
    assert (T3' : tight width 30000 u (negated (whole_big width 3)) (- (3)))
      by (apply tight_negated; apply tight_more with (1 := T3); [numbers; lia|lia]).
    destruct (seen_sum width 30000 (u + 6) u 4 3 _ _ _ _ ltac:(lia) ltac:(numbers; lia) A2' T3') as (_ & _ & _ & A3);
      try lia; try intros _; try (change (bpow radix2 (4 - 2)) with 4; apply Rabs_le; lra).
    { change (bpow radix2 (4 - 3)) with 2. rewrite Rabs_left; lra. }
    specialize (A3 ltac:(lra)). split.
    + apply tight_more with (1 := A3); [numbers; lia|lia].
    + change (bpow radix2 1) with 2. rewrite Rabs_left; lra.
Qed.

(* ---- s above 1/2: the rest to 1/2 ---- *)

Lemma rest_is_fine : forall width s sigma t e, (128 <= width <= 4096)%Z -> tight width 400000 (14 - width) s sigma ->
  / 100000000 <= t <= / 2 -> 6 * (t * t) - 4 * (t * t * t) = sigma -> sigma <= 5001 / 10000 ->
  (-40 <= e <= 0)%Z -> bpow radix2 (e - 1) <= t < bpow radix2 e ->
  newton_is_fine width (rest_value_big width s) (rest_slope_big width) (fun y => (6 - 4 * y) * y * y - sigma) (fun y => 12 * y * (1 - y)) t
    e (2 * e + 4) (e + 2).
Proof.
  intros width s sigma t e W Ts Bt E Bs He Bte. pose proof (rest_is_small sigma t Bs ltac:(lra) E) as Hsmall.
  assert (P20 : bpow radix2 (-20) = / 1048576) by reflexivity.
  assert (Btt : 0 < t * t) by (apply Rmult_lt_0_compat; lra).
  assert (Bttt : 0 <= t * t * t <= 3265 / 10000 * (t * t)).
  { split; [apply Rmult_le_pos; lra|]. rewrite (Rmult_comm (3265 / 10000)). apply Rmult_le_compat_l; lra. }
  assert (arg : forall y, Rabs (y - t) <= bpow radix2 (-20) * t -> 99999 / 100000 * t <= y <= 100001 / 100000 * t /\
    0 <= y * y <= 10003 / 10000 * (t * t) /\ 0 <= y * t <= 10003 / 10000 * (t * t)).
  { intros y H. rewrite P20 in H. apply Rabs_le_inv in H. assert (B : 99999 / 100000 * t <= y <= 100001 / 100000 * t) by lra.
    split; [exact B|].
    split; (split; [apply Rmult_le_pos; lra|]).
    - apply Rle_trans with (100001 / 100000 * t * (100001 / 100000 * t)); [apply Rmult_le_compat; lra|lra].
    - apply Rle_trans with (100001 / 100000 * t * t); [apply Rmult_le_compat_r; lra|lra]. }
  assert (E2 : t * t <= bpow radix2 (2 * e)).
  { replace (2 * e)%Z with (e + e)%Z by ring. rewrite bpow_plus. apply Rmult_le_compat; lra. }
  split.
  - lra.
  - exact (rest_derivative sigma).
  - now split.
  - lia.
  - intros y rho Hr Hy. pose proof (newton_for_rest_converges sigma t y rho Bs ltac:(lra) E ltac:(lra) Hy) as N.
    replace (6 * (y * y) - 4 * (y * y * y) - sigma) with ((6 - 4 * y) * y * y - sigma) in N by ring. exact N.
  - intros y r Hr H. assert (H20 : Rabs (y - t) <= bpow radix2 (-20) * t).
    { apply Rle_trans with (1 := H). apply Rmult_le_compat_r; [lra|]. now apply bpow_le. }
    destruct (arg y H20) as (B1 & B2 & B3).
    replace ((6 - 4 * y) * y * y - sigma) with ((y - t) * (6 * (y + t) - 4 * (y * y + y * t + t * t))) by (rewrite <- E; ring).
    replace (r + (2 * e + 4))%Z with (r + (2 * e) + 4)%Z by ring. rewrite (bpow_plus radix2 (r + 2 * e)), (bpow_plus radix2 r).
    change (bpow radix2 4) with 16. rewrite Rabs_mult.
    assert (Bd : Rabs (6 * (y + t) - 4 * (y * y + y * t + t * t)) <= 13 * t).
    { assert (t * t <= 3265 / 10000 * t) by (apply Rmult_le_compat_r; lra). apply Rabs_le. lra. }
    apply Rle_trans with (bpow radix2 r * t * (13 * t)); [apply Rmult_le_compat; try apply Rabs_pos; assumption|].
    replace (bpow radix2 r * t * (13 * t)) with (bpow radix2 r * (t * t) * 13) by ring.
    apply Rmult_le_compat; try lra; [apply Rmult_le_pos; [apply bpow_ge_0|lra]|]. apply Rmult_le_compat_l; [apply bpow_ge_0|exact E2].
  - intros x y Tx H. destruct (arg y H) as (B1 & B2 & B3). unfold rest_value_big, subtract.
    pose proof (whole_tight width 4 (1 - width) W ltac:(lia) ltac:(numbers; lia)) as T4.
    pose proof (whole_tight width 6 (1 - width) W ltac:(lia) ltac:(numbers; lia)) as T6.
    pose proof (tight_multiply width 1074 (1 - width) (1 - width) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) T4 Tx) as A1.
    assert (A1' : tight width 10000 (4 - width) (negated (multiply width (whole_big width 4) x)) (- (4 * y)))
      by (apply tight_negated; apply tight_more with (1 := A1); [numbers; lia|lia]).
    assert (T6' : tight width 10000 (1 - width) (whole_big width 6) 6) by (apply tight_more with (1 := T6); [numbers; lia|lia]).
    destruct (seen_sum width 10000 (1 - width) (4 - width) 5 3 _ _ _ _ ltac:(lia) ltac:(numbers; lia) T6' A1') as (_ & _ & _ & A2);
      try lia; try intros _; try (change (bpow radix2 (5 - 2)) with 8; apply Rabs_le; lra).
    { change (bpow radix2 (5 - 3)) with 4. rewrite Rabs_pos_eq; lra. }
    specialize (A2 ltac:(lra)). set (b := add width (whole_big width 6) (negated (multiply width (whole_big width 4) x))) in *.
    assert (A2' : tight width 30000 (10 - width) b (6 + - (4 * y))) by (apply tight_more with (1 := A2); [numbers; lia|lia]).
    assert (Tx1 : tight width 30000 (1 - width) x y) by (apply tight_more with (1 := Tx); [numbers; lia|lia]).
    pose proof (tight_multiply width 30000 (10 - width) (1 - width) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia)
      A2' Tx1) as A3.
    assert (A3' : tight width 80000 (13 - width) (multiply width b x) ((6 + - (4 * y)) * y))
      by (apply tight_more with (1 := A3); [numbers; lia|lia]).
    assert (Tx2 : tight width 80000 (1 - width) x y) by (apply tight_more with (1 := Tx); [numbers; lia|lia]).
    pose proof (tight_multiply width 80000 (13 - width) (1 - width) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia)
      A3' Tx2) as A4.
    assert (A4' : tight width 400000 (16 - width) (multiply width (multiply width b x) x) ((6 + - (4 * y)) * y * y))
      by (apply tight_more with (1 := A4); [numbers; lia|lia]).
    assert (E3 : bpow radix2 (2 * e + 3) = bpow radix2 (2 * e) * 8) by (rewrite bpow_plus; reflexivity).
    destruct (sum_error width 400000 (16 - width) (14 - width) (2 * e + 3) _ _ _ _ ltac:(lia) ltac:(numbers; lia) A4'
      (tight_negated _ _ _ _ _ Ts) ltac:(lia) ltac:(lia)) as (N & F & C & X); try lia.
    + replace ((6 + - (4 * y)) * y * y) with ((6 - 4 * y) * (y * y)) by ring. rewrite Rabs_pos_eq by (apply Rmult_le_pos; lra).
      apply Rle_trans with (6 * (10003 / 10000 * (t * t))); [apply Rmult_le_compat; lra|lra].
    + rewrite Rabs_Ropp, Rabs_pos_eq; lra.
    + split; [exact N|]. split; [apply fits_le with (2 := F); numbers; lia|]. split; [exact C|]. destruct X as [X|X]; [now left|right; lia].
  - intros x y u Tx Hu H. destruct (arg y H) as (B1 & B2 & B3). unfold rest_slope_big, subtract.
    pose proof (whole_tight width 12 u W ltac:(lia) ltac:(numbers; lia)) as T12.
    pose proof (whole_tight width 1 u W ltac:(lia) ltac:(numbers; lia)) as T1.
    pose proof (tight_multiply width 1074 u u _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) T12 Tx) as A1.
    destruct (seen_sum width 1074 u u 2 3 _ _ _ _ ltac:(lia) ltac:(numbers; lia) T1 (tight_negated _ _ _ _ _ Tx)) as (_ & _ & _ & A2);
      try lia; try intros _; try (change (bpow radix2 (2 - 2)) with 1; apply Rabs_le; lra).
    { change (bpow radix2 (2 - 3)) with (/ 2). rewrite Rabs_pos_eq; lra. }
    specialize (A2 ltac:(lra)).
    assert (A1' : tight width 10000 (u + 6) (multiply width (whole_big width 12) x) (12 * y))
      by (apply tight_more with (1 := A1); [numbers; lia|lia]).
    assert (A2' : tight width 10000 (u + 6) (add width (whole_big width 1) (negated x)) (1 + - y))
      by (apply tight_more with (1 := A2); [numbers; lia|lia]).
    pose proof (tight_multiply width 10000 (u + 6) (u + 6) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) A1' A2')
      as A3. split.
    + apply tight_more with (1 := A3); [numbers; lia|lia].
    + assert (E8 : bpow radix2 (e + 2) = bpow radix2 (e - 1) * 8).
      { replace (e + 2)%Z with (e - 1 + 3)%Z by ring. rewrite bpow_plus. reflexivity. }
      assert (B : 8 * t <= 12 * y * (1 - y)).
      { apply Rle_trans with (12 * (999 / 1000 * t) * (673 / 1000)); [lra|apply Rmult_le_compat; lra]. }
      rewrite Rabs_pos_eq; lra.
Qed.

(* ---- sine_of_third ---- *)

Theorem sine_of_third_is_tight : forall width R w K, (128 <= width <= 4096)%Z -> parameters R w K ->
  tight width 50000000 (60 - width) (sine_of_third_big width R w) (third_sine (value32 R) (value32 w)).
Proof.
  intros width R w K W Hp. pose proof unit_is_small as Hu. destruct (third_sine_of_half R w K Hp) as (Ht & E & Bs).
  pose proof (half_width_is R w K Hp) as Ih. pose proof Hp as ((FR & _) & HR & Hw & _).
  pose proof (to64_is_exact R FR) as IR. pose proof (two_to_is (-1) ltac:(lia)) as I2. change (bpow radix2 (-1)) with (/ 2) in I2.
  set (t := third_sine _ _) in *. set (s := value32 w / 2 / value32 R) in *.
  assert (U50 : bpow radix2 (-50) = 8 * unit53) by (unfold unit53; simpl; lra).
  assert (quotient : forall v x, is64 v x ->
    tight width 400000 (14 - width) (divide_newton width (exactly width v) (exactly width (to64 R))) (x / value32 R)).
  { intros v x I. pose proof (tight_exactly width (- width) _ _ ltac:(lia) ltac:(numbers; lia) I) as Tv.
    pose proof (tight_exactly width (- width) _ _ ltac:(lia) ltac:(numbers; lia) IR) as TR.
    pose proof (tight_divide width 1074 (- width) (- width) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) Tv TR
      ltac:(lra)) as T.
    apply tight_more with (1 := T); [numbers; lia|lia]. }
  apply (sine_of_third_cases _ (fun a => tight width 50000000 (60 - width) a t) _ _ _ R w K Hp); fold t; fold s.
  - intros Hs2 (y & Iy & Cy).
    pose proof (third_is_small s t Hs2 ltac:(lra) E) as Hsmall. destruct (size_of_root t ltac:(lra)) as (e & He & Bte).
    pose proof (third_is_fine width _ s t e W (quotient _ _ Ih) Ht E Hs2 ltac:(lra) He Bte) as Fine.
    assert (Cy2 : Rabs (y - t) <= bpow radix2 (-50) * t).
    { apply Rle_trans with (1 := Cy). apply Rmult_le_compat_r; lra. }
    apply tight_more with (1 := newton_root_is_tight width _ _ _ _ t e _ _ _ y W Fine Iy Cy2); [numbers; lia|lia].
  - intros ->. apply tight_more with (1 := tight_exactly width (- width) _ _ ltac:(lia) ltac:(numbers; lia) I2); [numbers; lia|lia].
  - set (v := / 2 - t). set (r := (value32 R - value32 w / 2) / value32 R). intros Hv Ev [Br Hr] Bm Im (y & Iy & Cy).
    pose proof (rest_is_small r v Hr ltac:(lra) Ev) as Hsmall.
    destruct (size_of_root v ltac:(lra)) as (e & He & Bte).
    pose proof (rest_is_fine width _ r v e W (quotient _ _ Im) Hv Ev Hr He Bte) as Fine.
    assert (Cy2 : Rabs (y - v) <= bpow radix2 (-50) * v).
    { apply Rle_trans with (1 := Cy). apply Rmult_le_compat_r; lra. }
    pose proof (newton_root_is_tight width _ _ _ _ v e _ _ _ y W Fine Iy Cy2) as Tv.
    assert (T2 : tight width 40000000 (50 - width) (exactly width (two_to (-1))) (/ 2)).
    { apply tight_more with (1 := tight_exactly width (- width) _ _ ltac:(lia) ltac:(numbers; lia) I2); [numbers; lia|lia]. }
    destruct (seen_sum width 40000000 (50 - width) (50 - width) 1 4 _ _ _ _ ltac:(lia) ltac:(numbers; lia) T2 (tight_negated _ _ _ _ _ Tv))
      as (_ & _ & _ & A); try lia; try intros _; try (change (bpow radix2 (1 - 2)) with (/ 2); apply Rabs_le; lra).
    { change (bpow radix2 (1 - 4)) with (/ 8). rewrite Rabs_pos_eq; lra. }
    specialize (A ltac:(lra)). replace t with (/ 2 + - v) by (unfold v; ring). unfold subtract.
    apply tight_more with (1 := A); [numbers; lia|lia].
Qed.
