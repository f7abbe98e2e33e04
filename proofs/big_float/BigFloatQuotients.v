(* SPDX-License-Identifier: BSD-3-Clause *)
(* Quotients and roots of numbers of the third stage: fast/numbers/big_float_ball.h. Their bounds come from the remainder, so they hold
   for whatever Newton's method gave; of a root, only that what it gave for the root is positive. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core.
From Forceshade Require Import BigFloat BigFloatValues Intervals.
From Forceshade Require Import BigFloatSums BigFloatProducts.
Open Scope R_scope.

Lemma fits_le : forall k j a, (k <= j <= range)%Z -> fits k a -> fits j a.
Proof. intros k j a K [E F]. split; [lia|]. numbers. lia. Qed.

Lemma midpoint_fits : forall k a, fits k a -> fits k (midpoint a).
Proof. intros k a [E F]. split; [exact E|now left]. Qed.

Lemma scaled_fits : forall k j a, (k + Z.abs j <= range)%Z -> fits k a -> fits (k + Z.abs j) (scaled a j).
Proof. intros k j a Hr [E F]. split; [cbn [exponent scaled with_error]; lia|]. apply clamp_fits; numbers; lia. Qed.

Lemma magnitude_is : forall width k a x, (0 < width)%Z -> (k <= range)%Z -> normal width a -> fits k a -> contains width a x ->
  within (magnitude a) (Rabs x).
Proof.
  intros width k a x W K N [E F] H. unfold magnitude. set (m := Z.max (if is_zero a then none else exponent a) (error a)).
  destruct H as [H|H]; [left; lia|right]. pose proof (size_double m). pose proof (size_le (error a) m ltac:(numbers; lia)).
  assert (Rabs (value width a) <= size m).
  { destruct (is_zero a) eqn:Z; [rewrite (value_of_zero _ _ Z), Rabs_R0; apply size_pos|].
    apply Rle_trans with (1 := value_at_most width a W N). rewrite <- (size_some (exponent a)) by (numbers; lia). apply size_le. lia. }
  pose proof (Rabs_triang (x - value width a) (value width a)) as T. replace (x - value width a + value width a) with x in T by ring. lra.
Qed.

Lemma times_power : forall e d b k, d <= size e -> b <= bpow radix2 k -> 0 <= d -> 0 <= b -> (e < least \/ least <= e + k)%Z ->
  d * b <= size (e + k).
Proof.
  intros e d b k D B D0 B0 H. apply Rle_trans with (2 := size_times e k H). apply Rmult_le_compat; assumption.
Qed.

Lemma inverse_at_most : forall x e, bpow radix2 e <= x -> 0 < / x <= bpow radix2 (- e).
Proof.
  intros x e H. pose proof (bpow_gt_0 radix2 e) as P. split; [apply Rinv_0_lt_compat; lra|]. rewrite bpow_opp. now apply Rinv_le_contravar.
Qed.

Lemma quotient_propagated : forall width k a b x y, (0 < width)%Z -> (5 * k + 10 <= range)%Z -> normal width a -> normal width b ->
  fits k a -> fits k b -> may_be_zero b = false -> contains width a x -> contains width b y ->
  let e := (Z.max (error a - exponent b) (exponent a + error b - 2 * exponent b) + 4)%Z in
  (boundless <= e)%Z \/ Rabs (x / y - value width a / value width b) <= size e.
Proof.
  intros width k a b x y W Hr Na Nb Fa Fb Zb Hx Hy e. destruct (surely_not_zero width k b y W ltac:(numbers; lia) Nb Fb Hy Zb) as (Z & A &
      _ & _).
  pose proof (value_at_most _ _ W Na) as Ba. destruct Fa as [Ea Fa], Fb as [Eb Fb]. apply orb_false_iff in Zb. destruct Zb as [_ Zb].
  apply Z.ltb_ge in Zb. destruct Hx as [Hx|Hx]; [left; unfold e; numbers; lia|]. destruct Hy as [Hy|Hy]; [numbers; lia|].
  destruct (Z.le_gt_cases boundless (error a)) as [I|I]; [left; unfold e; numbers; lia|right].
  set (A0 := value width a) in *. set (B0 := value width b) in *.
  assert (S : size (error b) <= bpow radix2 (exponent b - 2)) by (rewrite <- (size_some (exponent b - 2)) by (numbers; lia); now apply
      size_le).
  pose proof (bpow_double (exponent b - 2)) as P. replace (exponent b - 2 + 1)%Z with (exponent b - 1)%Z in P by ring.
  pose proof (bpow_gt_0 radix2 (exponent b - 2)) as G. pose proof (size_pos (error a)) as Pa. pose proof (size_pos (error b)) as Pb.
  apply Rle_trans with (1 := quotient_is_off_by _ _ _ _ _ _ Hx Hy ltac:(lra)).
  destruct (inverse_at_most (Rabs B0 - size (error b)) (exponent b - 2) ltac:(lra)) as [I1 I2].
  destruct (inverse_at_most (Rabs B0) (exponent b - 1) ltac:(lra)) as [J1 J2].
  unfold Rdiv. rewrite Rabs_mult, Rabs_inv, Rmult_plus_distr_r. set (m := Z.max (error a - exponent b) (exponent a + error b - 2 * exponent
      b)).
  assert (size (error a) * / (Rabs B0 - size (error b)) <= size (m + 3)).
  { apply Rle_trans with (size (error a + - (exponent b - 2))); [|apply size_le; lia].
    apply times_power; try lra. numbers. lia. }
  assert (Rabs A0 * / Rabs B0 * size (error b) * / (Rabs B0 - size (error b)) <= size (m + 3)).
  { apply Rle_trans with (size (error b + (exponent a + - (exponent b - 1) + - (exponent b - 2)))); [|apply size_le; lia].
    replace (Rabs A0 * / Rabs B0 * size (error b) * / (Rabs B0 - size (error b))) with
      (size (error b) * (Rabs A0 * / Rabs B0 * / (Rabs B0 - size (error b)))) by ring.
    pose proof (Rabs_pos A0) as P0. pose proof (Rmult_le_pos _ _ P0 (Rlt_le _ _ J1)) as P1. apply times_power; try lra.
    - rewrite !bpow_plus. apply Rmult_le_compat; try lra. apply Rmult_le_compat; lra.
    - apply Rmult_le_pos; lra.
    - numbers. lia. }
  unfold e. pose proof (size_double (m + 3)) as D. replace (m + 3 + 1)%Z with (m + 4)%Z in D by ring. fold m. lra.
Qed.

(* What the remainder says of an approximate quotient, which need not be near. *)
Lemma quotient_remainder : forall width k a b q r, (0 < width)%Z -> (2 * k + 10 <= range)%Z -> normal width b -> fits k b ->
  is_zero b = false -> normal width r -> fits k r -> contains width r (value width a - value width q * value width b) ->
  within (magnitude r - exponent b + 2) (Rabs (value width a / value width b - value width q)).
Proof.
  intros width k a b q r W Hr Nb [Eb _] Zb Nr Fr Hc. pose proof (value_above width b W Nb Zb) as A.
  destruct (inverse_at_most _ _ A) as [I1 I2]. pose proof (bpow_gt_0 radix2 (exponent b - 1)) as G.
  destruct (magnitude_is width k r _ W ltac:(numbers; lia) Nr Fr Hc) as [M|M].
  { left. unfold magnitude in *. destruct Fr as [Er Fr]. destruct (is_zero r); numbers; lia. }
  destruct (Z.le_gt_cases boundless (magnitude r - exponent b + 2)) as [L|L]; [now left|right].
  assert (B : value width b <> 0) by (intro B; rewrite B, Rabs_R0 in A; lra).
  replace (value width a / value width b - value width q) with ((value width a - value width q * value width b) / value width b) by
    now field.
  unfold Rdiv. rewrite Rabs_mult, Rabs_inv. apply Rle_trans with (size (magnitude r + - (exponent b - 1))); [|apply size_le; lia].
  apply times_power; try lra; [apply Rabs_pos|]. unfold magnitude in *. destruct Fr as [Er Fr]. destruct (is_zero r); numbers; lia.
Qed.

Theorem big_quotient_contains : forall width k a b inverse, (0 < width)%Z -> (50 * (k + width + 10) <= range)%Z ->
  normal width a -> normal width b -> normal width inverse -> fits k a -> fits k b -> fits k inverse ->
  let r := divide width a b inverse in
  normal width r /\ fits (50 * (k + width + 10)) r /\ forall x y, contains width a x -> contains width b y -> contains width r (x / y).
Proof.
  intros width k a b inverse W Hr Na Nb Ni Fa Fb Fi r. assert (K : (0 <= k)%Z) by (destruct Fa; lia). unfold r, divide.
  destruct (may_be_zero b) eqn:Zb.
  { split; [now left|]. split; [|intros; left; cbn; numbers; lia].
    split; [cbn [exponent with_error zero]; lia|]. apply clamp_fits; numbers; lia. }
  destruct (is_zero a) eqn:Za.
  { split; [now left|]. split.
    - split; [cbn [exponent with_error zero]; lia|]. destruct Fa as [Ea Fa], Fb as [Eb Fb]. apply clamp_fits; [lia|].
      destruct (is_exact_zero a); numbers; lia.
    - intros x y Hx Hy. apply zero_contains. destruct (is_exact_zero a) eqn:X.
      + right. rewrite (exact_zero_is width k a x Fa ltac:(numbers; lia) X Hx). unfold Rdiv. rewrite Rmult_0_l, Rabs_R0. apply size_pos.
      + destruct (surely_not_zero width k b y W ltac:(numbers; lia) Nb Fb Hy Zb) as (_ & A & D & _). destruct Fa as [Ea Fa], Fb as [Eb Fb].
        unfold contains in Hx. rewrite (value_of_zero width a Za), Rminus_0_r in Hx.
        destruct (Z.le_gt_cases boundless (error a)) as [I|I]; [left; numbers; lia|right]. destruct Hx as [Hx|Hx]; [lia|].
        pose proof (bpow_double (exponent b - 2)) as P. replace (exponent b - 2 + 1)%Z with (exponent b - 1)%Z in P by ring.
        assert (Y : bpow radix2 (exponent b - 2) <= Rabs y).
        { pose proof (Rabs_triang_inv (value width b) (value width b - y)) as T. rewrite (Rabs_minus_sym (value width b) y) in T.
          replace (value width b - (value width b - y)) with y in T by ring. lra. }
        destruct (inverse_at_most _ _ Y) as [I1 I2]. unfold Rdiv. rewrite Rabs_mult, Rabs_inv.
        apply Rle_trans with (size (error a + - (exponent b - 2))); [|apply size_le; lia].
        apply times_power; try lra; [apply Rabs_pos|]. numbers. lia. }
  set (divisor := midpoint b). set (dividend := midpoint a). set (first := midpoint (multiply width dividend inverse)).
  assert (Fd : fits k divisor) by now apply midpoint_fits. assert (Fn : fits k dividend) by now apply midpoint_fits.
  destruct (big_product_contains width k dividend inverse W ltac:(numbers; lia) Na Ni Fn Fi) as (N1 & F1 & _).
  apply midpoint_fits in F1. fold first in F1. change (normal width first) in N1.
  destruct (big_product_contains width (2 * k + width + 4) first divisor W ltac:(numbers; lia) N1 Nb F1) as (N2 & F2 & _);
    [apply fits_le with k; [lia|exact Fd]|].
  destruct (big_difference_contains width (4 * k + 3 * width + 12) dividend (multiply width first divisor) W ltac:(numbers; lia) Na N2) as
      (N3 & F3 & _);
    [apply fits_le with k; [lia|exact Fn]|apply fits_le with (2 := F2); lia|].
  destruct (big_product_contains width (4 * k + 4 * width + 15) _ inverse W ltac:(numbers; lia) N3 Ni) as (N4 & F4 & _);
    [apply fits_le with (2 := F3); lia|apply fits_le with k; [lia|exact Fi]|].
  destruct (big_sum_contains width (8 * k + 9 * width + 34) first _ W ltac:(numbers; lia) N1 N4) as (N5 & F5 & _);
    [apply fits_le with (2 := F1); lia|apply fits_le with (2 := F4); lia|].
  apply midpoint_fits in F5. set (quotient := midpoint (add width first _)) in *. change (normal width quotient) in N5.
  destruct (big_product_contains width (8 * k + 10 * width + 37) quotient divisor W ltac:(numbers; lia) N5 Nb) as (N6 & F6 & C6);
    [apply fits_le with (2 := F5); lia|apply fits_le with k; [lia|exact Fd]|].
  destruct (big_difference_contains width (16 * k + 21 * width + 78) dividend (multiply width quotient divisor) W ltac:(numbers; lia) Na
      N6) as (N7 & F7 & C7);
    [apply fits_le with k; [lia|exact Fn]|apply fits_le with (2 := F6); lia|].
  set (rest := subtract width dividend (multiply width quotient divisor)) in *.
  assert (C : contains width rest (value width a - value width quotient * value width b)).
  { apply C7; [apply big_midpoint_contains|]. apply C6; [|apply big_midpoint_contains].
    change (contains width (midpoint quotient) (value width quotient)). apply big_midpoint_contains. }
  clear N1 N2 N3 N4 N6 F1 F2 F3 F4 F6 C6 C7. set (k' := (16 * k + 22 * width + 81)%Z).
  assert (F8 : fits k' rest) by (apply fits_le with (2 := F7); unfold k'; lia).
  split; [exact N5|]. split.
  - split; [destruct F5 as [E5 _]; cbn [exponent with_error]; lia|]. apply clamp_fits; [lia|].
    destruct Fa as [Ea Fa], Fb as [Eb Fb], F8 as [E8 F8]. unfold magnitude. subst k'. clear - Ea Fa Eb Fb E8 F8 Hr W K.
    destruct (is_zero rest); numbers; lia.
  - intros x y Hx Hy. apply contains_with_error. destruct (surely_not_zero width k b y W ltac:(numbers; lia) Nb Fb Hy Zb) as (Zb0 & _).
    set (e1 := (magnitude rest - exponent b + 2)%Z).
    set (e2 := (Z.max (error a - exponent b) (exponent a + error b - 2 * exponent b) + 4)%Z).
    destruct (quotient_propagated width k a b x y W ltac:(numbers; lia) Na Nb Fa Fb Zb Hx Hy) as [P|P]; cbv zeta in P; fold e2 in P; [left;
        lia|].
    destruct (quotient_remainder width k' a b quotient rest W ltac:(unfold k'; numbers; lia) Nb (fits_le k k' b ltac:(unfold k'; numbers;
        lia) Fb) Zb0 N7 F8 C)
      as [Q|Q]; fold e1 in Q; [left; lia|right].
    pose proof (size_double (Z.max e1 e2)). pose proof (size_le e1 (Z.max e1 e2) ltac:(numbers; lia)). pose proof (size_le e2 (Z.max e1 e2)
        ltac:(numbers; lia)).
    replace (x / y - value width quotient) with ((x / y - value width a / value width b) + (value width a / value width b -
      value width quotient)) by ring.
    pose proof (Rabs_triang (x / y - value width a / value width b) (value width a / value width b - value width quotient)). lra.
Qed.

(* ---- Roots ---- *)

Lemma root_of_small : forall x m g, Rabs x <= 2 * bpow radix2 m -> (m + 1 <= 2 * g)%Z -> Rabs (sqrt x) <= bpow radix2 g.
Proof.
  intros x m g H G. rewrite <- sqrt_bpow, Rabs_pos_eq by apply sqrt_pos. apply sqrt_le_1_alt. apply Rle_trans with (1 := Rle_abs x).
  apply Rle_trans with (1 := H). rewrite <- bpow_double. now apply bpow_le.
Qed.

Lemma half_is : forall m, (m + 1 <= 2 * (Z.quot (m + 4) 2 + 1) /\ - Z.abs m <= Z.quot (m + 4) 2 + 1 <= Z.abs m + 3)%Z.
Proof.
  intro m. pose proof (Z.quot_rem' (m + 4) 2) as E. pose proof (Z.rem_bound_abs (m + 4) 2 ltac:(lia)). lia.
Qed.

(* Of a number of which nothing is known, nothing is said here. *)
Theorem big_root_contains : forall width k a inverse, (0 < width)%Z -> (60 * (k + width + 10) <= range)%Z -> normal width a ->
  normal width inverse -> fits k a -> fits k inverse -> (error a < boundless)%Z ->
  (may_be_zero a = false -> negative a = false ->
    is_zero (root_of_midpoint width (midpoint a) inverse) = false /\ negative (root_of_midpoint width (midpoint a) inverse) = false) ->
  let r := square_root width a inverse in
  normal width r /\ fits (60 * (k + width + 10)) r /\ forall x, contains width a x -> contains width r (sqrt x).
Proof.
  intros width k a inverse W Hr Na Ni Fa Fi Hb Hp r. assert (K : (0 <= k)%Z) by (destruct Fa; lia). unfold r, square_root. clear r.
  destruct (is_exact_zero a) eqn:X.
  { split; [exact Na|]. split; [apply fits_le with (2 := Fa); lia|]. intros x Hx.
    pose proof (exact_zero_is width k a x Fa ltac:(numbers; lia) X Hx) as ->. now rewrite sqrt_0. }
  destruct (may_be_zero a || negative a) eqn:Z.
  { destruct (half_is (Z.max (exponent a) (error a))) as [H1 H2]. set (m := Z.max (exponent a) (error a)) in *.
    set (g := (Z.quot (m + 4) 2 + 1)%Z) in *. assert (Bm : (- k <= m <= k)%Z) by (destruct Fa as [Ea Fa]; numbers; lia).
    split; [now left|]. split; [split; [cbn [exponent with_error zero]; lia|apply clamp_fits; numbers; lia]|].
    intros x Hx. apply zero_contains. right. rewrite (size_some g) by (numbers; lia). destruct (may_be_zero a) eqn:M.
    - apply root_of_small with (2 := H1). destruct Hx as [Hx|Hx]; [lia|]. pose proof (size_le (error a) m ltac:(lia)) as S.
      rewrite (size_some m) in S by (numbers; lia). pose proof (value_at_most width a W Na) as V.
      pose proof (bpow_le radix2 (exponent a) m ltac:(lia)).
      pose proof (Rabs_triang (x - value width a) (value width a)) as T. replace (x - value width a + value width a) with x in T by ring.
          lra.
    - cbn [orb] in Z. destruct (surely_not_zero width k a x W ltac:(numbers; lia) Na Fa Hx M) as (_ & _ & _ & S). rewrite Z in S.
      cbn [is_sign] in S. rewrite sqrt_neg by lra. rewrite Rabs_R0. apply bpow_ge_0. }
  apply orb_false_iff in Z. destruct Z as [Zm Zn]. specialize (Hp Zm Zn). destruct Hp as [Rz Rn].
  set (square := midpoint a) in *. unfold root_of_midpoint in Rz, Rn. unfold root_of_midpoint. set (first := midpoint (multiply width
      square inverse)) in *.
  assert (Fs : fits k square) by now apply midpoint_fits.
  destruct (big_product_contains width k square inverse W ltac:(lia) Na Ni Fs Fi) as (N1 & F1 & _).
  apply midpoint_fits in F1. fold first in F1. change (normal width first) in N1.
  destruct (big_product_contains width (2 * k + width + 4) first first W ltac:(lia) N1 N1 F1 F1) as (N2 & F2 & _).
  destruct (big_difference_contains width (4 * k + 3 * width + 12) square (multiply width first first) W ltac:(lia) Na N2) as (N3 & F3 & _);
    [apply fits_le with k; [lia|exact Fs]|apply fits_le with (2 := F2); lia|].
  destruct (big_product_contains width (4 * k + 4 * width + 15) _ inverse W ltac:(lia) N3 Ni) as (N4 & F4 & _);
    [apply fits_le with (2 := F3); lia|apply fits_le with k; [lia|exact Fi]|].
  apply (scaled_fits _ (-1)) in F4; [|lia].
  change (normal width (scaled (multiply width (subtract width square (multiply width first first)) inverse) (-1))) in N4.
  destruct (big_sum_contains width (8 * k + 9 * width + 35) first _ W ltac:(lia) N1 N4) as (N5 & F5 & _);
    [apply fits_le with (2 := F1); lia|apply fits_le with (2 := F4); lia|].
  apply midpoint_fits in F5.
  set (root := midpoint (add width first _)) in *. change (normal width root) in N5.
  destruct (big_product_contains width (8 * k + 10 * width + 38) root root W ltac:(lia) N5 N5) as (N6 & F6 & C6);
    [apply fits_le with (2 := F5); lia|apply fits_le with (2 := F5); lia|].
  destruct (big_difference_contains width (16 * k + 21 * width + 80) square (multiply width root root) W ltac:(lia) Na N6) as (N7 & F7 &
      C7);
    [apply fits_le with k; [lia|exact Fs]|apply fits_le with (2 := F6); lia|].
  set (rest := subtract width square (multiply width root root)) in *.
  assert (C : contains width rest (value width a - value width root * value width root)).
  { apply C7; [apply big_midpoint_contains|]. change (contains width (midpoint root) (value width root)) with
      (contains width root (value width root)) in *. pose proof (big_midpoint_contains width root) as Cr. now apply C6. }
  clear N1 N2 N3 N4 N6 F1 F2 F3 F4 F6 C6 C7. destruct F5 as [E5 _]. destruct F7 as [E7 F7].
  assert (Fm : let m := magnitude rest in m = (none + 1)%Z \/ (- (16 * k + 22 * width + 83) <= m <= 16 * k + 22 * width + 84)%Z \/
    (infinite - (16 * k + 22 * width + 83) <= m)%Z) by (unfold magnitude; destruct (is_zero rest); numbers; lia).
  cbv zeta in Fm. pose proof (magnitude_is width (16 * k + 21 * width + 80 + width + 3) rest _ W ltac:(numbers; lia) N7 (conj E7 F7) C) as
      M.
  set (big_m := magnitude rest) in *. clearbody big_m.
  split; [exact N5|]. split.
  - split; [cbn [exponent with_error]; lia|]. apply clamp_fits; [lia|]. destruct Fa as [Ea Fa]. clear - Ea Fa E5 Fm Hr W K.
    destruct Fm as [-> | Fm]; numbers; lia.
  - intros x Hx. apply contains_with_error. change (value width (with_error ?a ?e)) with (value width a).
    destruct (surely_not_zero width k a x W ltac:(numbers; lia) Na Fa Hx Zm) as (_ & _ & _ & Sx). rewrite Zn in Sx. cbn [is_sign] in Sx.
    destruct Hx as [Hx|Hx]; [lia|].
    set (e1 := (big_m - exponent root + 1)%Z). set (e2 := (error a - exponent root + 2)%Z).
    destruct M as [M|M]; [left; unfold e1; numbers; lia|].
    destruct (Z.le_gt_cases boundless e1) as [L|L]; [left; lia|right].
    pose proof (value_above width root W N5 Rz) as A. rewrite (Rabs_pos_eq (value width root)) in A.
    2: { unfold value, signed. rewrite Rn. apply Rmult_le_pos; [|apply bpow_ge_0]. apply IZR_le. now apply (normal_digits width root W N5).
        }
    pose proof (bpow_gt_0 radix2 (exponent root - 1)) as G.
    apply Rle_trans with (1 := root_is_off_by x (value width a) (size (error a)) (value width root) ltac:(lra) ltac:(lra) Hx).
    destruct (inverse_at_most _ _ A) as [I1 I2]. unfold Rdiv. rewrite Rmult_plus_distr_r.
    assert (Rabs (value width a - value width root * value width root) * / value width root <= size e1).
    { apply Rle_trans with (size (big_m + - (exponent root - 1))); [|apply size_le; unfold e1; lia].
      apply times_power; try lra; [apply Rabs_pos|]. numbers. lia. }
    assert (size (error a) * / value width root <= size e2).
    { apply Rle_trans with (size (error a + - (exponent root - 1))); [|apply size_le; unfold e2; lia].
      apply times_power; try lra; [apply size_pos|]. destruct Fa as [Ea Fa]. numbers. lia. }
    pose proof (size_double (Z.max e1 e2)). pose proof (size_le e1 (Z.max e1 e2) ltac:(lia)). pose proof (size_le e2 (Z.max e1 e2)
        ltac:(lia)). lra.
Qed.
