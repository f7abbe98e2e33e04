(* SPDX-License-Identifier: BSD-3-Clause *)
(* What a law's third stage decides from its components is right, if their bounds are finer than the separation of the exact components
   from ties: fast/numbers/ball.h and fast/evaluate.h with numbers of fast/numbers/big_float_ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations Nearness Evaluate Inputs SecondStage Separation.
From Forceshade Require Import BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients BigFloatNarrow
  BigFloatNarrowQuotient.
From Forceshade Require Import BigFloatNewton BigFloatNewtonStart BigFloatTight BigFloatSearch.
Open Scope R_scope.

(* sign_of_difference(value, tie) and approximately(value). *)
Definition sign_beside_big (width : Z) (value : big) (tie : binary64) : comparison :=
  sign_of_big (subtract width value (exactly width tie)).
Definition approximately (width : Z) (a : big) : binary64 :=
  if is_zero a then zero64
  else let v := ldexp (fraction width a) (Z.max (exponent a) (-1070)) in if negative a then opp v else v.

(* round_to_binary32(value) and decide(outcome). *)
Definition rounded_big (width : Z) (value : big) : option binary32 :=
  search (sign_beside_big width value) 3 (to32 (approximately width value)).
Definition decide_big (width : Z) (contact_sign : comparison) (fx fz : big) : evaluation :=
  match contact_sign with
  | Gt =>
    match rounded_big width fx, rounded_big width fz with
    | Some x, Some z => (contact, (x, zero32, z))
    | _, _ => no_force invalid
    end
  | _ => no_force free
  end.

(* ---- The signs beside ties ---- *)

Lemma error_of_sum : forall width a b, let r := add width a b in error r = none \/
  (error r <= Z.max (Z.max (error a) (error b)) (if is_zero a || is_zero b then none else
    Z.max none (Z.max (exponent a) (exponent b) - width + 1)) + 2)%Z.
Proof.
  intros width a b r. unfold r. destruct (is_zero a || is_zero b) eqn:Z.
  - unfold add. apply orb_prop in Z. destruct (is_zero a); [|destruct Z as [Z|Z]; [discriminate|rewrite Z]];
      cbn [error with_error]; apply clamp_at_most; lia.
  - apply orb_false_iff in Z. destruct Z as [Za Zb]. exact (big_sum_is_narrow width a b Za Zb).
Qed.

Lemma exactly_exponent : forall width v m e, (53 <= width)%Z -> is64 v m -> Rabs m <= bpow radix2 e -> is_zero (exactly width v) = false ->
  (exponent (exactly width v) <= e + 1)%Z.
Proof.
  intros width v m e W [<- _] B Z. destruct (big_exactly_contains width v W) as (_ & N & _).
  apply (exponent_below width); try assumption; [lia|].
  now rewrite exactly_is.
Qed.

(* The number holds x, and its bound is at most a thirty-second of 2^-s. *)
Definition fine (width k s : Z) (a : big) (x : R) : Prop :=
  normal width a /\ fits k a /\ contains width a x /\ (error a <= - s - 5)%Z.

Lemma fine_is_near : forall width k s a x, fine width k s a x -> (- range <= - s - 5 <= range)%Z ->
  Rabs (x - value width a) <= bpow radix2 (- s - 5).
Proof.
  intros width k s a x (_ & _ & C & E) Hs. destruct C as [C|C]; [numbers; lia|]. apply Rle_trans with (1 := C).
  rewrite <- (size_some (- s - 5)) by (numbers; lia). now apply size_le.
Qed.

(* x is at most 2^g: the smaller it is, the larger its bound may be beside it. *)
Lemma tight_is_fine : forall width k t g s a x, (0 < width)%Z -> (k <= range)%Z -> tight width k t a x -> Rabs x <= bpow radix2 g ->
  (0 <= s <= range)%Z -> (t + g + s + 6 <= 0)%Z -> (width <= range)%Z -> fine width k (s - 1) a x.
Proof.
  intros width k t g s a x W K T Bx S0 S1 Hw. pose proof T as (N & F & C & _). split; [exact N|]. split; [exact F|]. split; [exact C|].
  destruct (tight_cases width k t a x W K T) as [[X _]|(_ & _ & _ & _ & Ea & P & _)].
  - destruct (exact_zero_parts k a K F X) as [_ ->]. numbers. lia.
  - assert (Xa : (exponent a - 2 <= g)%Z) by (apply (le_bpow radix2); lra). lia.
Qed.

Lemma signs_beside_fine : forall width k s a x, (128 <= width)%Z -> (1074 <= k)%Z -> (k + width + 3 <= range)%Z ->
  fine width k (s - 1) a x ->
  Rabs x <= bpow radix2 25 -> (forall m, is_tie m -> x <> m -> bpow radix2 (- s) <= Rabs (x - m)) ->
  (0 <= s)%Z -> (s + 36 <= width)%Z -> signs_are_right (sign_beside_big width a) x.
Proof.
  intros width k s a x W K Hr T Bx Sep S0 S2 v m Hv Hm Bm. unfold sign_beside_big, subtract.
  pose proof (fine_is_near width k (s - 1) a x T ltac:(numbers; lia)) as D. destruct T as (N & F & C & Ea).
  destruct (big_exactly_contains width v ltac:(lia)) as (Cv & Nv & Fv). rewrite (proj1 Hv) in Cv.
  assert (Fv' : fits k (exactly width v)) by (apply fits_le with (2 := Fv); lia).
  destruct (big_difference_contains width k a (exactly width v) ltac:(lia) Hr N Nv F Fv') as (Nr & Fr & Cr).
  specialize (Cr _ _ C Cv). unfold subtract in *.
  assert (E : (error (add width a (negated (exactly width v))) < - s - 1)%Z).
  { destruct (error_of_sum width a (negated (exactly width v))) as [E|E]; [rewrite E; numbers; lia|].
    change (is_zero (negated (exactly width v))) with (is_zero (exactly width v)) in E.
    change (exponent (negated (exactly width v))) with (exponent (exactly width v)) in E.
    assert (Ev : error (negated (exactly width v)) = none) by (destruct v; reflexivity). rewrite Ev in E.
    apply Z.le_lt_trans with (1 := E). clear E Ev. pose proof (exactly_exponent width v m 29 ltac:(lia) Hv Bm) as Xv.
    assert (Xa : is_zero a = false -> (exponent a <= 27)%Z).
    { intro Za. apply (exponent_below width a 26); try assumption; [lia|].
      pose proof (Rabs_triang_inv (value width a) x) as T. rewrite Rabs_minus_sym in T.
      assert (P : bpow radix2 (- (s - 1) - 5) <= bpow radix2 25) by (apply bpow_le; lia). pose proof (bpow_double 25) as P2.
      change (25 + 1)%Z with 26%Z in P2. lra. }
    destruct (is_zero a); [cbn [orb]; numbers; lia|]. specialize (Xa eq_refl). cbn [orb].
    destruct (is_zero (exactly width v)); [|specialize (Xv eq_refl)]; numbers; lia. }
  apply (big_sign_is_right width (k + width + 3) _ (x - m) s); try assumption; try (numbers; lia).
  destruct (Req_dec x m) as [->|Hne]; [left; ring|right; now apply Sep].
Qed.

Lemma signs_beside_are_right : forall width k t g s a x, (128 <= width)%Z -> (1074 <= k)%Z -> (k + width + 3 <= range)%Z ->
  tight width k t a x -> (g <= 25)%Z -> Rabs x <= bpow radix2 g -> (forall m, is_tie m -> x <> m -> bpow radix2 (- s) <= Rabs (x - m)) ->
  (0 <= s)%Z -> (t + g + s + 6 <= 0)%Z -> (s + 36 <= width)%Z -> signs_are_right (sign_beside_big width a) x.
Proof.
  intros width k t g s a x W K Hr T Hg Bx Sep S0 S1 S2. apply (signs_beside_fine width k s); try assumption.
  - apply (tight_is_fine width k t g s); try assumption; lia.
  - apply Rle_trans with (1 := Bx). now apply bpow_le.
Qed.

(* ---- Where the search starts ---- *)

(* The number's sign, and its highest limb as a fraction times a power of two. *)
Lemma approximately_near : forall width a x, (128 <= width)%Z -> normal width a -> is_zero a = false ->
  bpow radix2 (-990) <= Rabs x <= bpow radix2 25 -> Rabs (x - value width a) <= / 1000000000000000 * Rabs x ->
  exists v, is64 (approximately width a) v /\ Rabs v <= bpow radix2 26 /\ Rabs (x - v) <= bpow radix2 (-40) * Rabs v.
Proof.
  intros width a x W N Z Bx D. unfold approximately. rewrite Z. destruct (fraction_is width a ltac:(lia) N Z) as (f & Hf & Nf).
  assert (D' := D). apply Rabs_le_inv in D'.
  pose proof (Rabs_triang_inv x (value width a)) as T1. pose proof (Rabs_triang_inv (value width a) x) as T2. rewrite Rabs_minus_sym in T2.
  assert (X90 : bpow radix2 (-990) = 2 * bpow radix2 (-991)) by (apply (bpow_double (-991))).
  pose proof (bpow_gt_0 radix2 (-991)) as G91.
  assert (E : (-991 < exponent a)%Z).
  { apply (lt_bpow radix2). pose proof (value_below width a ltac:(lia) N). lra. }
  rewrite Z.max_l by lia. pose proof (value_is_share width a) as V. set (g := if negative a then -1 else 1) in *.
  assert (G : Rabs g = 1) by (unfold g; destruct (negative a); [rewrite Rabs_left|rewrite Rabs_pos_eq]; lra).
  set (q := f * bpow radix2 (exponent a)).
  assert (Nv : near (11 / 10) (g * q) (value width a)).
  { rewrite V. unfold q. rewrite <- Rmult_assoc. replace (11 / 10) with (0 + 11 / 10 + 0) by ring.
    apply near_times; [apply near_times; [apply near_exactly|exact Nf]|apply near_exactly]. }
  pose proof (near_is_close _ _ _ Nv ltac:(lra)) as Cl. set (v := g * q) in *.
  assert (Cl2 : Rabs (v - value width a) <= / 1000000000000000 * Rabs (value width a)).
  { apply Rle_trans with (1 := Cl). apply Rmult_le_compat_r; [apply Rabs_pos|]. unfold unit53. lra. }
  pose proof (Rabs_triang_inv v (value width a)) as T3. pose proof (Rabs_triang_inv (value width a) v) as T4. rewrite Rabs_minus_sym in T4.
  assert (Sv : Rabs q = Rabs v) by (unfold v; rewrite Rabs_mult, G; ring).
  assert (B25 : bpow radix2 26 = 2 * bpow radix2 25) by (apply (bpow_double 25)).
  assert (Vb : bpow radix2 (-991) <= Rabs v <= bpow radix2 26) by lra.
  assert (I : is64 (ldexp (fraction width a) (exponent a)) q).
  { apply ldexp_is; [exact Hf|]. fold q. rewrite Sv. split; [apply Rle_trans with (2 := proj1 Vb)|apply Rle_trans with (1 := proj2 Vb)];
      apply bpow_le; lia. }
  exists v. split.
  - unfold v, g. destruct (negative a); [replace (-1 * q) with (- q) by ring; now apply opp_is|now rewrite Rmult_1_l].
  - split; [lra|].
    replace (x - v) with ((x - value width a) - (v - value width a)) by ring. apply Rle_trans with (1 := minus_triangle _ _).
    change (bpow radix2 (-40)) with (/ 1099511627776). lra.
Qed.

Lemma approximately_is : forall width k t a x, (128 <= width)%Z -> (k <= range)%Z -> tight width k t a x -> (t <= -60)%Z ->
  x = 0 \/ bpow radix2 (-990) <= Rabs x <= bpow radix2 25 ->
  exists v, is64 (approximately width a) v /\
    (v = x /\ x = 0 \/ Rabs v <= bpow radix2 26 /\ Rabs (x - v) <= bpow radix2 (-40) * Rabs v).
Proof.
  intros width k t a x W K T Ht Bx. pose proof T as (N & F & C & Bt & _).
  destruct (tight_cases width k t a x ltac:(lia) ltac:(lia) T) as [[X ->]|(_ & Z & M & X0 & Ea & P & _)].
  { destruct (exact_zero_parts k a K F X) as [Z _]. unfold approximately. rewrite Z. exists 0. split; [exact zero_is|left; now split]. }
  destruct Bx as [Bx|Bx]; [easy|]. destruct (approximately_near width a x W N Z Bx) as (v & V & Hv);
    [|exists v; split; [exact V|now right]].
  destruct C as [C|C]; [destruct F; numbers; lia|]. apply Rle_trans with (1 := C).
  apply Rle_trans with (bpow radix2 (-50 + (exponent a - 2))).
  - rewrite <- (size_some (-50 + (exponent a - 2))) by (destruct F; numbers; lia). apply size_le. lia.
  - rewrite bpow_plus. apply Rmult_le_compat; try apply bpow_ge_0; [|exact P]. change (bpow radix2 (-50)) with (/ 1125899906842624). lra.
Qed.

(* ---- The answer ---- *)

Theorem rounded_big_is_nearest : forall width k t g s a x, (128 <= width)%Z -> (1074 <= k)%Z -> (k + width + 3 <= range)%Z ->
  tight width k t a x -> (t <= -60)%Z -> (g <= 25)%Z -> x = 0 \/ bpow radix2 (-990) <= Rabs x <= bpow radix2 g ->
  (forall m, is_tie m -> x <> m -> bpow radix2 (- s) <= Rabs (x - m)) -> (29 <= s)%Z -> (t + g + s + 6 <= 0)%Z -> (s + 36 <= width)%Z ->
  exists f, rounded_big width a = Some f /\ is_nearest32 f x.
Proof.
  intros width k t g s a x W K Hr T Ht Hg Bx Sep S0 S1 S2. assert (Bx0 : x = 0 \/ bpow radix2 (-990) <= Rabs x <= bpow radix2 25).
  { destruct Bx as [Bx|Bx]; [now left|right]. split; [apply Bx|]. apply Rle_trans with (1 := proj2 Bx). now apply bpow_le. }
  destruct (approximately_is width k t a x W ltac:(lia) T Ht Bx0) as (v & [Vv Fv] & Hv).
  assert (Bx2 : Rabs x <= bpow radix2 g) by (destruct Bx as [->|[_ B]]; [rewrite Rabs_R0; apply bpow_ge_0|exact B]).
  assert (Bv : Rabs v <= bpow radix2 26) by (destruct Hv as [[-> ->]|[B _]]; [rewrite Rabs_R0; apply bpow_ge_0|exact B]).
  assert (Bn : Rabs (nearest32 v) < bpow radix2 128).
  { apply Rle_lt_trans with (bpow radix2 26); [|apply bpow_lt; lia]. apply abs_round_le_generic; auto with typeclass_instances.
    apply generic_format_bpow. unfold FLT_exp. lia. }
  rewrite <- Vv in Bn. destruct (to32_rounds_once _ Fv Bn) as [V32 F32]. rewrite Vv in V32.
  apply (search_ends _ x v); [|exact F32|exact V32|exact Hv]. now apply (signs_beside_are_right width k t g s a x); try lia.
Qed.

(* A law's third stage: the sign of the gap G and both components are right, so the answer is. *)
Theorem decided_big_is_right : forall width k t g s c G fx fz Fx Fz touches, (128 <= width)%Z -> (1074 <= k)%Z ->
  (k + width + 3 <= range)%Z ->
  is_sign c G -> (0 < G <-> touches) -> (t <= -60)%Z -> (g <= 25)%Z ->
  (touches -> tight width k t fx Fx /\ tight width k t fz Fz) ->
  (touches -> (Fx = 0 \/ bpow radix2 (-990) <= Rabs Fx <= bpow radix2 g) /\ (Fz = 0 \/ bpow radix2 (-990) <= Rabs Fz <= bpow radix2 g)) ->
  (forall m, is_tie m -> (Fx <> m -> bpow radix2 (- s) <= Rabs (Fx - m)) /\ (Fz <> m -> bpow radix2 (- s) <= Rabs (Fz - m))) ->
  (29 <= s)%Z -> (t + g + s + 6 <= 0)%Z -> (s + 36 <= width)%Z -> is_answer (decide_big width c fx fz) touches Fx Fz.
Proof.
  intros width k t g s c G fx fz Fx Fz touches W K Hr Hc Ht Ht60 Hg HT HB Sep S0 S1 S2. unfold decide_big. destruct c; cbn [is_sign] in Hc.
  - left. split; [intro H; apply Ht in H; lra|reflexivity].
  - left. split; [intro H; apply Ht in H; lra|reflexivity].
  - right. apply Ht in Hc. split; [exact Hc|]. destruct (HT Hc) as [Tx Tz]. destruct (HB Hc) as [Bx Bz].
    destruct (rounded_big_is_nearest width k t g s fx Fx W K Hr Tx Ht60 Hg Bx) as (f & -> & Nf); try lia; [intros m Hm; now apply Sep|].
    destruct (rounded_big_is_nearest width k t g s fz Fz W K Hr Tz Ht60 Hg Bz) as (h & -> & Nh); try lia; [intros m Hm; now apply Sep|].
    exists f, h. now split.
Qed.

(* ---- Bounds that are small, however small the components are ---- *)

(* Far below the least tie it is not the relative error that counts. *)
Lemma approximately_tiny : forall width a, (128 <= width)%Z -> normal width a -> Rabs (value width a) < bpow radix2 (-190) ->
  exists v, is64 (approximately width a) v /\ Rabs v <= bpow radix2 (-188).
Proof.
  intros width a W N B. unfold approximately. destruct (is_zero a) eqn:Z.
  { exists 0. split; [exact zero_is|]. rewrite Rabs_R0. apply bpow_ge_0. }
  destruct (fraction_is width a ltac:(lia) N Z) as (f & Hf & Nf). pose proof (share_is width a ltac:(lia) N Z) as S.
  pose proof (near_is_close _ _ _ Nf ltac:(lra)) as Cl. rewrite (Rabs_pos_eq (share_of_one width a)) in Cl by lra.
  assert (Cl2 : Rabs (f - share_of_one width a) <= 1).
  { apply Rle_trans with (1 := Cl). apply Rle_trans with (1 * 1); [|lra]. apply Rmult_le_compat; unfold unit53; lra. }
  apply Rabs_le_inv in Cl2. assert (Bf : Rabs f <= bpow radix2 1) by (change (bpow radix2 1) with 2; apply Rabs_le; lra).
  pose proof (value_above width a ltac:(lia) N Z) as A. assert (E : (exponent a - 1 < -190)%Z) by (apply (lt_bpow radix2); lra).
  set (k := Z.max (exponent a) (-1070)). assert (Hk : (k <= -189)%Z) by (unfold k; lia). clearbody k.
  assert (Bv : Rabs (f * bpow radix2 k) <= bpow radix2 (-188)).
  { rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 k)) by apply bpow_ge_0. apply Rle_trans with (bpow radix2 1 * bpow radix2 k).
    - apply Rmult_le_compat_r; [apply bpow_ge_0|exact Bf].
    - rewrite <- bpow_plus. apply bpow_le. lia. }
  assert (I : is64 (ldexp (fraction width a) k) (nearest64 (f * bpow radix2 k))).
  { destruct Hf as [<- Fv]. unfold ldexp.
    pose proof (Bldexp_correct 53 1024 (eq_refl _) (eq_refl _) mode_NE (fraction width a) k) as C.
    assert (Hsize : Rabs (value64 (fraction width a) * bpow radix2 k) <= bpow radix2 1000).
    { apply Rle_trans with (1 := Bv). apply bpow_le. lia. }
    operation C. destruct C as (C1 & C2 & _). split; [exact C1|now rewrite C2]. }
  assert (Bn : Rabs (nearest64 (f * bpow radix2 k)) <= bpow radix2 (-188)).
  { apply abs_round_le_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia. }
  destruct (negative a); [exists (- nearest64 (f * bpow radix2 k))|exists (nearest64 (f * bpow radix2 k))].
  - split; [now apply opp_is|now rewrite Rabs_Ropp].
  - now split.
Qed.

Lemma nearest_of_tiny : forall x, Rabs x <= bpow radix2 (-188) -> nearest32 x = 0.
Proof.
  intros x B. destruct (Req_dec x 0) as [->|X]; [apply round_0; auto with typeclass_instances|].
  assert (M : (mag radix2 x <= -187)%Z) by (apply mag_le_bpow; [exact X|apply Rle_lt_trans with (1 := B); apply bpow_lt; lia]).
  apply (round_N_small radix2 fexp32 _ x (mag radix2 x)).
  - split; [now apply bpow_mag_le|apply bpow_mag_gt].
  - unfold FLT_exp. lia.
Qed.

(* Whatever the number's size is. *)
Theorem rounded_fine_is_nearest : forall width k s a x, (128 <= width)%Z -> (1074 <= k)%Z -> (k + width + 3 <= range)%Z ->
  fine width k (s - 1) a x -> Rabs x <= bpow radix2 25 -> (forall m, is_tie m -> x <> m -> bpow radix2 (- s) <= Rabs (x - m)) ->
  (300 <= s)%Z -> (s + 36 <= width)%Z -> exists f, rounded_big width a = Some f /\ is_nearest32 f x.
Proof.
  intros width k s a x W K Hr T Bx Sep S0 S2. pose proof (signs_beside_fine width k s a x W K Hr T Bx Sep ltac:(lia) S2) as Signs.
  pose proof (fine_is_near width k (s - 1) a x T ltac:(numbers; lia)) as D. destruct T as (N & _).
  assert (D3 : bpow radix2 (- (s - 1) - 5) <= bpow radix2 (-300)) by (apply bpow_le; lia).
  pose proof (bpow_gt_0 radix2 (-300)) as P3. pose proof (Rabs_triang_inv (value width a) x) as T1. rewrite Rabs_minus_sym in T1.
  assert (finite : forall v, is64 (approximately width a) v -> Rabs v <= bpow radix2 26 ->
    value32 (to32 (approximately width a)) = nearest32 v /\ is_finite 24 128 (to32 (approximately width a)) = true).
  { intros v [Vv Fv] Bv. assert (Bn : Rabs (nearest32 v) < bpow radix2 128).
    { apply Rle_lt_trans with (bpow radix2 26); [|apply bpow_lt; lia]. apply abs_round_le_generic; auto with typeclass_instances.
      apply generic_format_bpow. unfold FLT_exp. lia. }
    rewrite <- Vv in Bn |- *. exact (to32_rounds_once _ Fv Bn). }
  destruct (Rle_lt_dec (bpow radix2 (-200)) (Rabs x)) as [L|L].
  - assert (E : bpow radix2 (-300) <= / 1000000000000000 * bpow radix2 (-200)).
    { change (-300)%Z with (-100 + -200)%Z. rewrite bpow_plus. apply Rmult_le_compat_r; [apply bpow_ge_0|simpl; lra]. }
    pose proof (bpow_gt_0 radix2 (-200)) as P2.
    assert (Z : is_zero a = false).
    { apply (nonzero_value width). intro V. rewrite V, Rminus_0_r in D. lra. }
    destruct (approximately_near width a x W N Z) as (v & V & Bv & Hv).
    + split; [|exact Bx]. apply Rle_trans with (2 := L). apply bpow_le. lia.
    + apply Rle_trans with (1 := D). lra.
    + destruct (finite v V Bv) as [V32 F32]. unfold rounded_big. apply (search_ends _ x v); try assumption. now right.
  - assert (E : bpow radix2 (-190) = 1024 * bpow radix2 (-200)) by (change (-190)%Z with (10 + -200)%Z; rewrite bpow_plus; reflexivity).
    assert (E2 : bpow radix2 (-300) <= bpow radix2 (-200)) by (apply bpow_le; lia).
    destruct (approximately_tiny width a W N ltac:(lra)) as (v & V & Bv).
    destruct (finite v V) as [V32 F32]; [apply Rle_trans with (1 := Bv); apply bpow_le; lia|].
    rewrite nearest_of_tiny in V32 by exact Bv. unfold rounded_big. set (c := to32 (approximately width a)) in *.
    assert (Nx : nearest32 x = value32 c) by (rewrite V32; apply nearest_of_tiny, Rlt_le, Rlt_le_trans with (1 := L); apply bpow_le; lia).
    exists (b32_plus mode_NE c zero32). split; [|now apply plus_zero_is_nearest].
    apply (search_at_nearest _ x c 2 Signs F32); [rewrite V32, Rabs_R0; apply bpow_gt_0|exact Nx].
Qed.

(* The same decision from components with bounds that are below their separation, however far they have cancelled. *)
Theorem decided_fine_is_right : forall width k s c fx fz Fx Fz touches, (128 <= width)%Z -> (1074 <= k)%Z -> (k + width + 3 <= range)%Z ->
  match c with
  | Gt => touches /\ fine width k (s - 1) fx Fx /\ Rabs Fx <= bpow radix2 25 /\ fine width k (s - 1) fz Fz /\ Rabs Fz <= bpow radix2 25
  | _ => ~ touches
  end ->
  (forall m, is_tie m -> (Fx <> m -> bpow radix2 (- s) <= Rabs (Fx - m)) /\ (Fz <> m -> bpow radix2 (- s) <= Rabs (Fz - m))) ->
  (300 <= s)%Z -> (s + 36 <= width)%Z -> is_answer (decide_big width c fx fz) touches Fx Fz.
Proof.
  intros width k s c fx fz Fx Fz touches W K Hr Hc Sep S0 S2. unfold decide_big. destruct c; [left; now split|left; now split|right].
  destruct Hc as (T & Cx & Bx & Cz & Bz). split; [exact T|].
  destruct (rounded_fine_is_nearest width k s fx Fx W K Hr Cx Bx) as (f & -> & Nf); [intros m Hm; now apply Sep|exact S0|exact S2|].
  destruct (rounded_fine_is_nearest width k s fz Fz W K Hr Cz Bz) as (g & -> & Ng); [intros m Hm; now apply Sep|exact S0|exact S2|].
  exists f, g. now split.
Qed.
