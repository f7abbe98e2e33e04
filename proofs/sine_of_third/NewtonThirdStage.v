(* SPDX-License-Identifier: BSD-3-Clause *)
(* Newton's method for a root in the third stage: newton_root of fast/laws/bump_geometry.h with numbers of
   fast/numbers/big_float_ball.h. A step squares the error but for rounding, and the last one encloses the root. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations NewtonEnclosed BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients.
From Forceshade Require Import BigFloatNarrow BigFloatNewton BigFloatNewtonLoop BigFloatRight BigFloatTight BigFloatDecide.
Open Scope R_scope.

(* x - f(x) / f'(y) *)
Definition corrected (width : Z) (value_of slope_of : big -> big) (x y : big) : big :=
  subtract width x (divide_newton width (value_of x) (slope_of y)).
Fixpoint newton_steps (width : Z) (value_of slope_of : big -> big) (steps : nat) (bits : Z) (x : big) : big :=
  match steps with
  | O => x
  | S rest => newton_steps width value_of slope_of rest (2 * bits) (truncated width (corrected width value_of slope_of x x) (2 * bits))
  end.
Definition newton_root_big (width : Z) (value_of slope_of : big -> big) (start : binary64) : big :=
  let x := newton_steps width value_of slope_of 7 50 (exactly width start) in corrected width value_of slope_of x (widened x (-40)).

(* What Newton's method requires of f and its slope: the value's bound is 30 bits above the last place of 2^p, and the slope is 2^d. *)
Record newton_is_fine (width : Z) (value_of slope_of : big -> big) (f slope : R -> R) (t : R) (e p d : Z) : Prop := {
  fine_root : f t = 0;
  fine_derivative : forall c, derivable_pt_lim f c (slope c);
  fine_size : (-40 <= e <= 0)%Z /\ bpow radix2 (e - 1) <= t < bpow radix2 e;
  fine_scale : (p - d <= e + 2)%Z /\ (-200 <= p <= 200)%Z /\ (-200 <= d <= 200)%Z;
  fine_step : forall y rho, 0 <= rho <= / 1000 -> Rabs (y - t) <= rho * t -> Rabs (y - f y / slope y - t) <= 56 / 100 * (rho * rho) * t;
  fine_nearness : forall y r, (r <= -20)%Z -> Rabs (y - t) <= bpow radix2 r * t -> Rabs (f y) <= bpow radix2 (r + p);
  fine_value : forall x y, tight width 1074 (1 - width) x y -> Rabs (y - t) <= bpow radix2 (-20) * t ->
    normal width (value_of x) /\ fits 500000 (value_of x) /\ contains width (value_of x) (f y) /\
    (error (value_of x) = none \/ (error (value_of x) <= p + 30 - width)%Z);
  fine_slope : forall x y u, tight width 1074 u x y -> (1 - width <= u <= -40)%Z -> Rabs (y - t) <= bpow radix2 (-20) * t ->
    tight width 500000 (u + 15) (slope_of x) (slope y) /\ bpow radix2 d <= Rabs (slope y)
}.

(* A quotient of which the dividend may be anything, 0 too. *)
Lemma correction_is : forall width k e g t l q a b x y, (128 <= width)%Z -> (60 * (k + width + 1110) <= range)%Z ->
  normal width a -> fits k a ->
  contains width a x -> error a = none \/ (error a <= e)%Z -> (e <= g)%Z -> (- range <= e <= range)%Z -> Rabs x <= bpow radix2 g ->
  tight width k t b y -> (t <= -10)%Z -> bpow radix2 l <= Rabs y ->
  (e - l + 8 <= q)%Z -> (g - l + 10 + t <= q)%Z -> (g - l + 18 - width <= q)%Z -> let r := divide_newton width a b in
  normal width r /\ fits (60 * (k + width + 1110)) r /\ contains width r (x / y) /\ (error r = none \/ (error r <= q)%Z) /\
  (is_zero r = true \/ (exponent r <= g - l + 4)%Z).
Proof.
  intros width k e g t l q a b x y W Hr Na Fa Ca Ea Heg He Bx Tb Ht By Q1 Q2 Q3 r. pose proof Tb as (Nb & Fb & Cb & _).
  assert (K : (0 <= k)%Z) by (destruct Fa; lia). pose proof (bpow_gt_0 radix2 l) as Gl.
  destruct (tight_cases width k t b y ltac:(lia) ltac:(lia) Tb) as [[_ Y0]|(_ & Zb & Mb & _ & Eb & _)]; [rewrite Y0, Rabs_R0 in By; lra|].
  destruct (big_quotient_is_right width k a b W Hr Na Nb Fa Fb) as (N & F & C & S). fold r in N, F, C, S.
  split; [exact N|]. split; [exact F|]. split; [now apply C|].
  (* the divisor is not below 2^l *)
  assert (L : (l <= exponent b)%Z).
  { assert (D : Rabs (y - value width b) <= bpow radix2 (exponent b)).
    { destruct Cb as [Cb|Cb]; [destruct Fb; numbers; lia|]. apply Rle_trans with (1 := Cb).
      rewrite <- (size_some (exponent b)) by (destruct Fb; numbers; lia). apply size_le. lia. }
    pose proof (value_below width b ltac:(lia) Nb) as V. pose proof (Rabs_triang (y - value width b) (value width b)) as T.
    replace (y - value width b + value width b) with y in T by ring. pose proof (bpow_double (exponent b)) as B.
    assert (l < exponent b + 1)%Z by (apply (lt_bpow radix2); lra). lia. }
  destruct (is_zero a) eqn:Za.
  - assert (R : r = with_error zero (if is_exact_zero a then none else error a - exponent b + 3)).
    { unfold r, divide_newton, divide. now rewrite Mb, Za. }
    rewrite R. split; [|now left]. cbn [error with_error]. unfold is_exact_zero, is_exact. rewrite Za. cbn [andb].
    destruct (Z.ltb_spec (error a) least) as [X|X]; [now left|]. destruct Ea as [Ea|Ea]; [numbers; lia|].
    apply clamp_at_most. lia.
  - destruct (S eq_refl Mb) as (Zr & X & B).
    assert (A : (exponent a <= g + 2)%Z).
    { assert (D : Rabs (x - value width a) <= bpow radix2 g).
      { destruct Ca as [Ca|Ca].
        - exfalso. destruct Ea as [Ea|Ea]; numbers; lia.
        - apply Rle_trans with (1 := Ca). destruct (Z.lt_ge_cases (error a) least) as [H|H];
          [rewrite size_none by exact H; apply bpow_ge_0|].
          rewrite size_some by exact H. apply bpow_le. destruct Ea as [Ea|Ea]; [numbers; lia|lia]. }
      pose proof (value_above width a ltac:(lia) Na Za) as V. pose proof (Rabs_triang_inv (value width a) x) as T.
      rewrite Rabs_minus_sym in T. pose proof (bpow_double g) as B2.
      assert (exponent a - 1 <= g + 1)%Z by (apply (le_bpow radix2); lra). lia. }
    split; [|right; lia]. destruct B as [B|B]; [now left|right]. destruct Fa as [Fa _], Fb as [Fb _]. destruct Ea as [Ea|Ea]; [|lia].
    rewrite Ea in B. clear - B Ea He Heg Q1 Q2 Q3 X A L Fa Fb Eb K Hr W. numbers. lia.
Qed.

(* ---- The numbers that Newton's method goes through ---- *)

Lemma near_root_is : forall width t e r x, (128 <= width)%Z -> (-40 <= e <= 0)%Z -> bpow radix2 (e - 1) <= t < bpow radix2 e ->
  (r <= -20)%Z ->
  normal width x -> error x = none -> Rabs (value width x - t) <= bpow radix2 r * t ->
  is_zero x = false /\ (e - 1 <= exponent x <= e + 1)%Z /\ 0 < value width x.
Proof.
  intros width t e r x W He Bt Hr N Ex H. pose proof (bpow_gt_0 radix2 (e - 1)) as G.
  assert (R : bpow radix2 r <= / 1000000) by (apply Rle_trans with (bpow radix2 (-20)); [now apply bpow_le|simpl; lra]).
  assert (H2 : bpow radix2 r * t <= / 1000000 * t) by (apply Rmult_le_compat_r; lra).
  assert (B : 999 / 1000 * t <= value width x <= 1001 / 1000 * t) by (apply Rabs_le_inv in H; lra).
  assert (Z : is_zero x = false) by (apply (nonzero_value width); lra). split; [exact Z|]. split; [|lra].
  pose proof (value_below width x ltac:(lia) N) as V1. pose proof (value_above width x ltac:(lia) N Z) as V2.
  rewrite Rabs_pos_eq in V1, V2 by lra.
  pose proof (bpow_double e) as D1. pose proof (bpow_double (e - 2)) as D2. replace (e - 2 + 1)%Z with (e - 1)%Z in D2 by ring.
  assert (e - 2 < exponent x)%Z by (apply (lt_bpow radix2); lra). assert (exponent x - 1 < e + 1)%Z by (apply (lt_bpow radix2); lra). lia.
Qed.

Lemma exact_is_tight : forall width x u, (128 <= width <= 4096)%Z -> normal width x -> error x = none -> is_zero x = false ->
  (-1074 <= exponent x <= 1074)%Z -> (1 - width <= u <= -3)%Z -> tight width 1074 u x (value width x).
Proof.
  intros width x u W N E Z X U. split; [exact N|]. split; [split; [exact X|now left]|]. split.
  - right. rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. apply size_pos.
  - split; [numbers; lia|]. right. split; [exact Z|now left].
Qed.

Lemma widened_is_tight : forall width x y, (128 <= width <= 4096)%Z -> normal width x -> error x = none -> is_zero x = false ->
  (-1000 <= exponent x <= 1000)%Z -> Rabs (y - value width x) <= bpow radix2 (-40) * Rabs (value width x) ->
  tight width 1074 (-40) (widened x (-40)) y.
Proof.
  intros width x y W N E Z X H. assert (Er : error (widened x (-40)) = (exponent x - 40)%Z).
  { unfold widened. cbn [error with_error]. unfold clamp. destruct (Z.ltb_spec (exponent x + -40) least); [numbers; lia|].
    destruct (Z.ltb_spec infinite (exponent x + -40)); [numbers; lia|ring]. }
  assert (Ex : exponent (widened x (-40)) = exponent x) by reflexivity.
  split; [exact N|]. split; [split; [rewrite Ex; lia|right; left; rewrite Er; lia]|]. split.
  - apply (big_widened_contains width 1074); try assumption; try lia; [|numbers; lia]. split; [lia|now left].
  - split; [numbers; lia|]. right. split; [exact Z|right]. rewrite Er, Ex. lia.
Qed.

(* m: the value of x. *)
Lemma corrected_is : forall width value_of slope_of f slope t e p d r u x y c, (128 <= width <= 4096)%Z ->
  newton_is_fine width value_of slope_of f slope t e p d -> normal width x -> error x = none -> let m := value width x in
  Rabs (m - t) <= bpow radix2 r * t -> (50 - width <= r <= -49)%Z -> tight width 1074 u y c -> (1 - width <= u <= -40)%Z ->
  (r + u + width <= 13)%Z -> Rabs (c - t) <= bpow radix2 (-20) * t -> let z := corrected width value_of slope_of x y in
  normal width z /\ fits 40000000 z /\ contains width z (m - f m / slope c) /\ (error z = none \/ (error z <= e + 42 - width)%Z).
Proof.
  intros width value_of slope_of f slope t e p d r u x y c W Fine N E m Hm Hr Ty Hu Hru Hc z.
  destruct Fine as [_ _ [He Bt] (Hs & Hp & Hd) _ Hnear Hvalue Hslope].
  destruct (near_root_is width t e r x ltac:(lia) He Bt ltac:(lia) N E Hm) as (Z & X & _). fold m in Hm.
  assert (P : 0 < t) by (pose proof (bpow_gt_0 radix2 (e - 1)); lra).
  assert (H20 : Rabs (m - t) <= bpow radix2 (-20) * t).
  { apply Rle_trans with (1 := Hm). apply Rmult_le_compat_r; [lra|]. apply bpow_le. lia. }
  destruct (Hvalue x m (exact_is_tight width x (1 - width) W N E Z ltac:(lia) ltac:(lia)) H20) as (Nv & Fv & Cv & Ev).
  destruct (Hslope y c u Ty ltac:(lia) Hc) as (Ts & Bs).
  assert (Bf : Rabs (f m) <= bpow radix2 (r + p)) by (apply Hnear; [lia|exact Hm]).
  destruct (correction_is width 500000 (p + 30 - width) (r + p) (u + 15) d (e + 40 - width) _ _ (f m) (slope c) ltac:(lia)
    ltac:(numbers; lia) Nv Fv Cv Ev ltac:(lia) ltac:(numbers; lia) Bf Ts ltac:(lia) Bs ltac:(lia) ltac:(lia) ltac:(lia))
    as (Nq & Fq & Cq & Eq & Xq).
  unfold z, corrected. clear z. set (q := divide_newton width (value_of x) (slope_of y)) in *. clearbody q.
  assert (Fx : fits 31000000 x) by (split; [lia|now left]).
  assert (Fq' : fits 31000000 q) by (apply fits_le with (2 := Fq); numbers; lia).
  destruct (big_difference_contains width 31000000 x q ltac:(lia) ltac:(numbers; lia) N Nq Fx Fq') as (Nz & Fz & Cz).
  split; [exact Nz|]. split; [apply fits_le with (2 := Fz); numbers; lia|]. split.
  - apply Cz; [|exact Cq]. right. unfold m. rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. apply size_pos.
  - unfold subtract. destruct (error_of_sum width x (negated q)) as [B|B]; [now left|right].
    change (is_zero (negated q)) with (is_zero q) in B. change (error (negated q)) with (error q) in B.
    change (exponent (negated q)) with (exponent q) in B. apply Z.le_trans with (1 := B). rewrite E, Z. cbn [orb].
    destruct (is_zero q); [|destruct Xq as [Xq|Xq]; [discriminate|]]; destruct Eq as [Eq|Eq]; rewrite ?Eq; numbers; lia.
Qed.

(* ---- The steps ---- *)

Definition good_root (width : Z) (t : R) (bits : Z) (x : big) : Prop :=
  normal width x /\ error x = none /\ Rabs (value width x - t) <= bpow radix2 (- Z.min bits (width - 50)) * t.

Lemma step_in_reals : forall rho M a b t q z w, 0 <= rho -> rho * rho <= M -> M <= / 1000 -> 0 <= a <= M / 16 ->
  0 <= b <= M / 16 -> 0 < t ->
  Rabs (q - t) <= 56 / 100 * (rho * rho) * t -> Rabs (q - z) <= a * t -> Rabs (w - z) <= b * Rabs z -> Rabs (w - t) <= M * t.
Proof.
  intros rho M a b t q z w Hr HM HM2 Ha Hb Ht Hq Hz Hw. assert (A : a * t <= M / 16 * t) by (apply Rmult_le_compat_r; lra).
  assert (MM : M * t <= / 1000 * t) by (apply Rmult_le_compat_r; lra). pose proof (Rmult_le_pos rho rho Hr Hr) as R0.
  assert (R2 : 56 / 100 * (rho * rho) * t <= 56 / 100 * M * t) by (apply Rmult_le_compat_r; lra).
  apply Rabs_le_inv in Hq, Hz. assert (Bz : 0 <= z <= 11 / 10 * t) by lra. rewrite (Rabs_pos_eq z) in Hw by lra.
  assert (B : b * z <= M / 16 * (11 / 10 * t)) by (apply Rmult_le_compat; lra). apply Rabs_le_inv in Hw. apply Rabs_le. lra.
Qed.

(* What a bound of its error says of a number's value. *)
Lemma value_within : forall width z x g, contains width z x -> error z = none \/ (error z <= g)%Z -> (- range <= g <= range)%Z ->
  Rabs (x - value width z) <= bpow radix2 g.
Proof.
  intros width z x g C E G. destruct C as [C|C]; [exfalso; destruct E as [E|E]; numbers; lia|]. apply Rle_trans with (1 := C).
  rewrite <- (size_some g) by (numbers; lia). apply size_le. destruct E as [E|E]; [rewrite E; numbers; lia|exact E].
Qed.

Lemma step_keeps_good : forall width value_of slope_of f slope t e p d bits x, (128 <= width <= 4096)%Z ->
  newton_is_fine width value_of slope_of f slope t e p d -> (50 <= bits)%Z -> good_root width t bits x ->
  good_root width t (2 * bits) (truncated width (corrected width value_of slope_of x x) (2 * bits)).
Proof.
  intros width value_of slope_of f slope t e p d bits x W Fine B (N & E & H). pose proof Fine as [_ _ [He Bt] _ Hstep _ _ _].
  set (r := (- Z.min bits (width - 50))%Z) in *. assert (Hr : (50 - width <= r <= -49)%Z) by (unfold r; lia).
  destruct (near_root_is width t e r x ltac:(lia) He Bt ltac:(lia) N E H) as (Z & X & _).
  assert (P : 0 < t) by (pose proof (bpow_gt_0 radix2 (e - 1)); lra).
  assert (H20 : Rabs (value width x - t) <= bpow radix2 (-20) * t).
  { apply Rle_trans with (1 := H). apply Rmult_le_compat_r; [lra|]. apply bpow_le. lia. }
  destruct (corrected_is width value_of slope_of f slope t e p d r (1 - width) x x (value width x) W Fine N E H Hr
    (exact_is_tight width x (1 - width) W N E Z ltac:(lia) ltac:(lia)) ltac:(lia) ltac:(lia) H20) as (Nz & _ & Cz & Ez).
  set (z := corrected width value_of slope_of x x) in *. clearbody z.
  destruct (truncated_is width z (2 * bits) ltac:(lia) ltac:(lia) Nz) as (Nt & Ht). split; [exact Nt|]. split; [reflexivity|].
  pose proof (value_within width z _ _ Cz Ez ltac:(numbers; lia)) as D. set (w := value width (truncated width z (2 * bits))) in *.
  set (M := bpow radix2 (- Z.min (2 * bits) (width - 50))).
  assert (part : forall g, (g <= - Z.min (2 * bits) (width - 50) - 4)%Z -> bpow radix2 g <= M / 16).
  { intros g G. unfold M, Rdiv. change (/ 16) with (bpow radix2 (-4)). rewrite <- bpow_plus. apply bpow_le. lia. }
  apply (step_in_reals (bpow radix2 r) M (bpow radix2 (43 - width)) (bpow radix2 (- (2 * bits + 64))) t
    (value width x - f (value width x) / slope (value width x)) (value width z) w); try assumption.
  - apply bpow_ge_0.
  - unfold M. rewrite <- bpow_plus. apply bpow_le. unfold r. lia.
  - apply Rle_trans with (bpow radix2 (-10)); [apply bpow_le; lia|simpl; lra].
  - split; [apply bpow_ge_0|]. apply part. lia.
  - split; [apply bpow_ge_0|]. apply part. lia.
  - apply Hstep; [|exact H]. split; [apply bpow_ge_0|]. apply Rle_trans with (bpow radix2 (-10)); [apply bpow_le; lia|simpl; lra].
  - apply Rle_trans with (1 := D). replace (e + 42 - width)%Z with (43 - width + (e - 1))%Z by ring. rewrite bpow_plus.
    apply Rmult_le_compat_l; [apply bpow_ge_0|lra].
Qed.

Lemma steps_keep_good : forall width value_of slope_of f slope t e p d steps bits x, (128 <= width <= 4096)%Z ->
  newton_is_fine width value_of slope_of f slope t e p d -> (50 <= bits)%Z -> good_root width t bits x ->
  good_root width t (bits * 2 ^ Z.of_nat steps) (newton_steps width value_of slope_of steps bits x).
Proof.
  intros width value_of slope_of f slope t e p d steps. induction steps as [|steps IH]; intros bits x W Fine B G.
  - change (2 ^ Z.of_nat 0)%Z with 1%Z. now rewrite Z.mul_1_r.
  - cbn [newton_steps]. rewrite Nat2Z.inj_succ, Z.pow_succ_r by lia. replace (bits * (2 * 2 ^ Z.of_nat steps))%Z with
      (2 * bits * 2 ^ Z.of_nat steps)%Z by ring. apply IH; try assumption; [lia|]. now apply (step_keeps_good width _ _ f slope t e p d).
Qed.

(* ---- The root ---- *)

(* The root is enclosed, and the bound is some units of the last place. *)
Theorem newton_root_is_tight : forall width value_of slope_of f slope t e p d start y0, (128 <= width <= 4096)%Z ->
  newton_is_fine width value_of slope_of f slope t e p d -> is64 start y0 -> Rabs (y0 - t) <= bpow radix2 (-50) * t ->
  tight width 40000000 (50 - width) (newton_root_big width value_of slope_of start) t.
Proof.
  intros width value_of slope_of f slope t e p d start y0 W Fine Is H0. pose proof Fine as [Root Df [He Bt] _ _ _ _ _].
  assert (P : 0 < t) by (pose proof (bpow_gt_0 radix2 (e - 1)); lra).
  assert (G0 : good_root width t 50 (exactly width start)).
  { destruct (big_exactly_contains width start ltac:(lia)) as (_ & N & _). split; [exact N|]. split; [destruct start; reflexivity|].
    rewrite exactly_is by lia. rewrite (proj1 Is). apply Rle_trans with (1 := H0). apply Rmult_le_compat_r; [lra|]. apply bpow_le. lia. }
  pose proof (steps_keep_good width _ _ f slope t e p d 7 50 _ W Fine ltac:(lia) G0) as (N & E & H).
  unfold newton_root_big. cbv zeta. set (x := newton_steps width value_of slope_of 7 50 (exactly width start)) in *. clearbody x.
  replace (Z.min (50 * 2 ^ Z.of_nat 7) (width - 50)) with (width - 50)%Z in H by (change (2 ^ Z.of_nat 7)%Z with 128%Z; lia).
  set (r := (- (width - 50))%Z) in *. assert (Hr : (r <= -49)%Z) by (unfold r; lia).
  destruct (near_root_is width t e r x ltac:(lia) He Bt ltac:(lia) N E H) as (Z & X & Px). set (m := value width x) in *.
  destruct (mean_value f slope m t Df) as (c & Ec & Bc). rewrite Root, Rminus_0_r in Ec.
  assert (R50 : bpow radix2 r <= bpow radix2 (-49)) by (apply bpow_le; lia).
    assert (P50 : bpow radix2 (-49) = / 562949953421312) by reflexivity.
  assert (Rt : bpow radix2 r * t <= / 562949953421312 * t) by (apply Rmult_le_compat_r; lra).
  assert (P20 : bpow radix2 (-20) = / 1048576) by reflexivity. assert (P40 : bpow radix2 (-40) = / 1099511627776) by reflexivity.
  pose proof (Rabs_le_inv _ _ H) as H2.
  assert (Hc : Rabs (c - t) <= bpow radix2 (-20) * t).
  { replace (c - t) with ((m - t) - (m - c)) by ring. rewrite P20. apply Rabs_le_inv in Bc; apply Rabs_le. lra. }
  assert (Tw : tight width 1074 (-40) (widened x (-40)) c).
  { apply widened_is_tight; try assumption; [lia|]. fold m. rewrite Rabs_minus_sym. apply Rle_trans with (1 := Bc).
    rewrite P40, (Rabs_pos_eq m) by lra. lra. }
  destruct (corrected_is width value_of slope_of f slope t e p d r (-40) x _ c W Fine N E H ltac:(lia) Tw ltac:(lia)
    ltac:(unfold r; lia) Hc)
    as (Nz & Fz & Cz & Ez).
  set (z := corrected width value_of slope_of x (widened x (-40))) in *. clearbody z. fold m in Cz.
  assert (S0 : slope c <> 0).
  { destruct Fine as [_ _ _ _ _ _ _ Hslope]. destruct (Hslope _ _ (-40)%Z Tw ltac:(lia) Hc) as [_ S]. pose proof (bpow_gt_0 radix2 d).
    intro S0. rewrite S0, Rabs_R0 in S. lra. }
  replace (m - f m / slope c) with t in Cz by (rewrite Ec; field; exact S0).
  pose proof (value_within width z t _ Cz Ez ltac:(numbers; lia)) as D.
  assert (D2 : Rabs (t - value width z) <= bpow radix2 (e - 2)) by (apply Rle_trans with (1 := D); apply bpow_le; lia).
  pose proof (bpow_double (e - 2)) as D1. replace (e - 2 + 1)%Z with (e - 1)%Z in D1 by ring. pose proof (bpow_gt_0 radix2 (e - 2)) as G.
  apply Rabs_le_inv in D2. assert (V : bpow radix2 (e - 2) <= value width z) by lra.
  assert (Zz : is_zero z = false) by (apply (nonzero_value width); lra).
  pose proof (value_below width z ltac:(lia) Nz) as V2. rewrite Rabs_pos_eq in V2 by lra.
  assert (Xz : (e - 2 < exponent z)%Z) by (apply (lt_bpow radix2); lra).
  split; [exact Nz|]. split; [exact Fz|]. split; [exact Cz|]. split; [numbers; lia|]. right. split; [exact Zz|].
  destruct Ez as [Ez|Ez]; [now left|right; lia].
Qed.
