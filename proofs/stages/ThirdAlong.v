(* SPDX-License-Identifier: BSD-3-Clause *)
(* K times a gap along a direction, in the third stage: along() and along_shaded() of fast/laws/outcome.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations Evaluate Inputs SecondStage Separation ShadingRoot.
From Forceshade Require Import BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients BigFloatNarrow BigFloatNewtonStart.
From Forceshade Require Import BigFloatRight BigFloatTight BigFloatDecide.
Open Scope R_scope.

Definition along_big (width : Z) (K : binary32) (gap normal_x normal_z : big) : evaluation :=
  let magnitude := multiply width (exactly width (to64 K)) gap in
  decide_big width (sign_of_big gap) (multiply width magnitude normal_x) (multiply width magnitude normal_z).

(* gap: what is divided by the radius. *)
Definition along_shaded_big (width : Z) (K R x : binary32) (gap : big) : evaluation :=
  let radius := exactly width (to64 R) in
  let X := exactly width (to64 x) in
  along_big width K (divide_newton width gap radius) X
    (square_root_newton width (multiply width (subtract width radius X) (add width radius X))).

(* A gap that may cancel: it is 0, whatever its bound is, or it is tight. *)
Definition seen (width k t : Z) (a : big) (x : R) : Prop :=
  normal width a /\ fits k a /\ contains width a x /\ (x <> 0 -> tight width k t a x).

Lemma tight_is_seen : forall width k t a x, tight width k t a x -> seen width k t a x.
Proof. intros width k t a x T. pose proof T as (N & F & C & _). exact (conj N (conj F (conj C (fun _ => T)))). Qed.

Lemma seen_more : forall width k t a x j u, seen width k t a x -> (k <= j <= range)%Z -> (t <= u <= -3)%Z -> seen width j u a x.
Proof.
  intros width k t a x j u (N & F & C & T) J U. split; [exact N|]. split; [now apply fits_le with k|]. split; [exact C|].
  intro X. apply tight_more with (1 := T X); lia.
Qed.

(* What is 0 is never found to have a sign. *)
Lemma sign_of_seen : forall width k t a x, (0 < width)%Z -> (k <= range)%Z -> seen width k t a x -> is_sign (sign_of_big a) x.
Proof.
  intros width k t a x W K (N & F & C & T). unfold sign_of_big. destruct (may_be_zero a) eqn:M.
  - destruct (Req_dec x 0) as [X|X]; [exact X|].
    destruct (tight_cases width k t a x W K (T X)) as [[_ X0]|(_ & _ & M' & _)]; [easy|congruence].
  - apply (surely_not_zero width k a x W K N F C M).
Qed.

Lemma seen_divide : forall width k t u a b x y, (128 <= width)%Z -> (60 * (k + width + 1110) <= range)%Z -> (t <= -10)%Z -> (u <= -10)%Z ->
  seen width k t a x -> tight width k u b y -> y <> 0 ->
  seen width (60 * (k + width + 1110)) (Z.max (Z.max t u + 6) (14 - width)) (divide_newton width a b) (x / y).
Proof.
  intros width k t u a b x y W Hr Ht Hu (N & F & C & T) Tb Y. pose proof Tb as (Nb & Fb & Cb & _).
  destruct (big_quotient_is_right width k a b W Hr N Nb F Fb) as (Nq & Fq & Cq & _).
  split; [exact Nq|]. split; [exact Fq|]. split; [now apply Cq|]. intro Q. apply tight_divide; try assumption. apply T.
  intro X. apply Q. rewrite X. unfold Rdiv. ring.
Qed.

(* A sum of two numbers that may be 0: where it is not 0, it is not m bits below 2^e. *)
Lemma seen_sum : forall width k t u e m a b x y, (64 <= width)%Z -> (k + width + 3 <= range)%Z ->
  tight width k t a x -> tight width k u b y -> (0 <= m)%Z -> (Z.max (Z.max t u) (1 - width) + m + 3 <= -3)%Z ->
  Rabs x <= bpow radix2 (e - 2) -> Rabs y <= bpow radix2 (e - 2) -> (x + y <> 0 -> bpow radix2 (e - m) <= Rabs (x + y)) ->
  seen width (k + width + 3) (Z.max (Z.max t u) (1 - width) + m + 3) (add width a b) (x + y).
Proof.
  intros width k t u e m a b x y W Hr Ta Tb M T Bx By S. pose proof Ta as (Na & Fa & Ca & Bt & _). pose proof Tb as (Nb & Fb & Cb & Bu & _).
  assert (K : (0 <= k)%Z) by (destruct Fa; lia).
  destruct (big_sum_contains width k a b ltac:(lia) Hr Na Nb Fa Fb) as (N & F & C).
  split; [exact N|]. split; [exact F|]. split; [now apply C|]. intro Hne. specialize (S Hne). specialize (C x y Ca Cb).
  destruct (tight_cases width k t a x ltac:(lia) ltac:(lia) Ta) as [[Xa X0]|(Xa & Za & _ & _ & Ea & Pa & _)].
  { destruct (exact_zero_parts k a ltac:(lia) Fa Xa) as [Z E].
    destruct (tight_cases width k u b y ltac:(lia) ltac:(lia) Tb) as [[_ Y0]|(_ & Zb & _ & _ & Eb & _)]; [lra|].
    split; [exact N|]. split; [exact F|]. split; [exact C|]. split; [numbers; lia|]. right. unfold add. rewrite Z, E. split; [exact Zb|].
    cbn [error exponent with_error]. destruct (clamp_at_most (Z.max none (error b) + 1) (exponent b + u + 1)) as [B|B];
      [destruct Fb; numbers; lia|now left|right; lia]. }
  destruct (tight_cases width k u b y ltac:(lia) ltac:(lia) Tb) as [[Xb Y0]|(Xb & Zb & _ & _ & Eb & Pb & _)].
  { destruct (exact_zero_parts k b ltac:(lia) Fb Xb) as [Z E].
    split; [exact N|]. split; [exact F|]. split; [exact C|]. split; [numbers; lia|]. right. unfold add. rewrite Za, Z, E.
      split; [exact Za|].
    cbn [error exponent with_error]. destruct (clamp_at_most (Z.max (error a) none + 1) (exponent a + t + 1)) as [B|B];
      [destruct Fa; numbers; lia|now left|right; lia]. }
  apply tight_sum; try assumption. apply Rle_trans with (2 := S). apply bpow_le.
  assert (exponent a - 2 <= e - 2)%Z by (apply (le_bpow radix2); lra).
    assert (exponent b - 2 <= e - 2)%Z by (apply (le_bpow radix2); lra). lia.
Qed.

(* A component of a force is not too small to be approximated. *)
Lemma component_is_large : forall K g n u, / 1000 <= K <= 1000 -> bpow radix2 (-930) <= g -> n = 0 \/ bpow radix2 (-40) <= Rabs n ->
  g * Rabs n <= bpow radix2 u -> K * g * n = 0 \/ bpow radix2 (-990) <= Rabs (K * g * n) <= bpow radix2 (u + 10).
Proof.
  intros K g n u HK Lg Hn U. destruct Hn as [->|Hn]; [left; ring|right]. pose proof (bpow_gt_0 radix2 (-930)) as P3.
  pose proof (bpow_gt_0 radix2 (-40)) as P4. rewrite Rmult_assoc, Rabs_mult, (Rabs_pos_eq K) by lra.
  rewrite Rabs_mult, (Rabs_pos_eq g) by lra. split.
  - apply Rle_trans with (bpow radix2 (-10) * (bpow radix2 (-930) * bpow radix2 (-40))).
    + rewrite <- !bpow_plus. apply bpow_le. lia.
    + apply Rmult_le_compat; try apply bpow_ge_0; [apply Rmult_le_pos; lra|simpl; lra|]. apply Rmult_le_compat; lra.
  - rewrite Z.add_comm, bpow_plus. change (bpow radix2 10) with 1024. apply Rmult_le_compat; try lra. apply Rmult_le_pos; lra.
Qed.

(* Both components are at most 2^g. *)
Theorem along_big_is_right : forall width k t g s R w K gap G nx NX nz NZ touches, (128 <= width)%Z -> (1074 <= k)%Z ->
  (4 * k + 4 * width + 15 <= range)%Z -> parameters R w K -> seen width k t gap G -> tight width k t nx NX -> tight width k t nz NZ ->
  (0 < G <-> touches) -> (g <= 25)%Z ->
  (touches -> (value32 K * G * NX = 0 \/ bpow radix2 (-990) <= Rabs (value32 K * G * NX) <= bpow radix2 g) /\
    (value32 K * G * NZ = 0 \/ bpow radix2 (-990) <= Rabs (value32 K * G * NZ) <= bpow radix2 g)) ->
  (forall m, is_tie m -> (value32 K * G * NX <> m -> bpow radix2 (- s) <= Rabs (value32 K * G * NX - m)) /\
    (value32 K * G * NZ <> m -> bpow radix2 (- s) <= Rabs (value32 K * G * NZ - m))) ->
  (29 <= s)%Z -> (t <= -66)%Z -> (t + g + s + 12 <= 0)%Z -> (g + s + 13 <= width)%Z -> (s + 36 <= width)%Z ->
  is_answer (along_big width K gap nx nz) touches (value32 K * G * NX) (value32 K * G * NZ).
Proof.
  intros width k t g s R w K gap G nx NX nz NZ touches W Hk Hr Hp Sg Tx Tz Hc Hg HB Sep S0 S1 S2 S3 S4. destruct Hp as ((_ & _ & FK) & _).
  pose proof Tx as (_ & _ & _ & T & _).
  pose proof (tight_exactly width (Z.max t (1 - width)) _ _ ltac:(lia) ltac:(numbers; lia) (to64_is_exact K FK)) as TK.
  assert (TK' : tight width k (Z.max t (1 - width)) (exactly width (to64 K)) (value32 K)) by (apply tight_more with (1 := TK); lia).
  unfold along_big. set (magnitude := multiply width (exactly width (to64 K)) gap).
  assert (one : forall n N, touches -> tight width k t n N ->
    tight width (4 * k + 3 * width + 12) (Z.max t (1 - width) + 6) (multiply width magnitude n) (value32 K * G * N)).
  { intros n N Hits Tn. apply Hc in Hits. destruct Sg as (_ & _ & _ & Tg). specialize (Tg ltac:(lra)).
    pose proof (tight_multiply width k (Z.max t (1 - width)) t _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lia) TK' Tg) as TM.
    assert (Tn' : tight width (2 * k + width + 4) t n N) by (apply tight_more with (1 := Tn); lia).
    pose proof (tight_multiply width (2 * k + width + 4) (Z.max (Z.max (Z.max t (1 - width)) t) (1 - width) + 3) t _ _ _ _
      ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lia) TM Tn') as P.
    apply tight_more with (1 := P); lia. }
  apply (decided_big_is_right width (4 * k + 3 * width + 12) (Z.max t (1 - width) + 6) g s _ G); try assumption; try lia.
  - apply (sign_of_seen width k t); [lia|lia|exact Sg].
  - intro Hits. split; now apply one.
Qed.

(* ---- Force shading ---- *)

(* A number less itself is 0 exactly. *)
Lemma less_itself : forall width a, is_zero a = false -> error a = none -> is_exact_zero (add width a (negated a)) = true.
Proof.
  intros width a Z E. unfold add. change (is_zero (negated a)) with (is_zero a). rewrite Z. unfold is_larger.
  change (exponent (negated a)) with (exponent a). change (digits (negated a)) with (digits a). rewrite Z.eqb_refl, Z.leb_refl.
  unfold add_smaller. change (exponent (negated a)) with (exponent a). change (digits (negated a)) with (digits a).
  change (error (negated a)) with (error a). change (negative (negated a)) with (negb (negative a)). rewrite Z.sub_diag.
  change (2 ^ 0)%Z with 1%Z. rewrite Z.div_1_r, Z.mod_1_r. rewrite eqb_negb2. cbn [negb Z.eqb]. unfold subtract_limbs. rewrite Z.sub_diag.
  unfold normalised. cbn [is_zero digits Z.eqb]. unfold is_exact_zero, is_zero, is_exact. cbn [with_error digits error Z.eqb andb].
  rewrite E. reflexivity.
Qed.

Lemma strictly_finite : forall v : binary64, value64 v <> 0 -> is_finite_strict 53 1024 v = true.
Proof. intros [s|s|s p q|s m e H] V; try reflexivity; now destruct V. Qed.

(* b: the coordinate, or the number less it. *)
Lemma radius_and : forall width R w K v Y b, (128 <= width)%Z -> (1077 + width <= range)%Z -> parameters R w K -> coordinate v Y ->
  Rabs Y <= value32 R -> tight width 1074 (- width) b Y ->
  (is_exact_zero b = true /\ Y = 0 \/ b = exactly width v) ->
  tight width (1077 + width) (49 - width) (add width (exactly width (to64 R)) b) (value32 R + Y).
Proof.
  intros width R w K v Y b W Hr Hp Hv HY Tb Hb. pose proof (inside_of_circle R w K (opp v) (- Y) Hp (coordinate_opp _ _ Hv)
    ltac:(now rewrite Rabs_Ropp)) as L. replace (value32 R - - Y) with (value32 R + Y) in L by ring.
  destruct Hp as ((FR & _) & HR & _). pose proof (to64_is_exact R FR) as IR.
  pose proof (tight_exactly width (- width) _ _ ltac:(lia) ltac:(numbers; lia) IR) as TR. set (radius := exactly width (to64 R)) in *.
  assert (XR : is_exact_zero radius = false).
  { destruct (tight_cases width 1074 (- width) radius _ ltac:(lia) ltac:(numbers; lia) TR) as [[_ R0]|[X _]]; [lra|exact X]. }
  assert (ER : error radius = none) by (unfold radius; destruct (to64 R); reflexivity).
  pose proof TR as (NR & FR' & CR & _). pose proof Tb as (Nb & Fb & Cb & _).
  destruct (big_sum_contains width 1074 radius b ltac:(lia) ltac:(lia) NR Nb FR' Fb) as (N & F & C). specialize (C _ _ CR Cb).
  replace (1074 + width + 3)%Z with (1077 + width)%Z in F by ring.
  destruct (tight_cases width 1074 (- width) radius _ ltac:(lia) ltac:(numbers; lia) TR) as [[X _]|(_ & ZR & _)]; [congruence|].
  destruct (tight_cases width 1074 (- width) b Y ltac:(lia) ltac:(numbers; lia) Tb) as [[Xb Y0]|(Xb & Zb & _ & Y0 & _)].
  { destruct (exact_zero_parts 1074 b ltac:(numbers; lia) Fb Xb) as [Z Eb].
    assert (S : add width radius b = with_error radius (none + 1)) by (unfold add; now rewrite ZR, Z, ER, Eb).
    split; [exact N|]. split; [exact F|]. split; [exact C|]. split; [numbers; lia|]. right. rewrite S. split; [exact ZR|]. left.
      reflexivity. }
  destruct Hb as [[Hb _]|Hb]; [congruence|]. destruct L as [L|L].
  - split; [exact N|]. split; [exact F|]. split; [exact C|]. split; [numbers; lia|]. left.
    assert (Eb : b = negated radius); [|rewrite Eb; now apply less_itself]. rewrite Hb. destruct Hv as [[Vv Fv] _ _ _].
    assert (E : v = opp (to64 R)).
    { destruct (opp_is _ _ IR) as [Vo Fo]. apply B2R_inj; [| |rewrite Vo, Vv; lra]; apply strictly_finite; [rewrite Vv|rewrite Vo]; lra. }
    rewrite E. unfold radius.
    destruct (to64 R) as [s|s|s p q|s m e H]; try reflexivity; exfalso; destruct IR as [V0 F0]; simpl in V0, F0;
      try discriminate; lra.
  - assert (EXR : (exponent radius <= 15)%Z) by (apply (exactly_exponent width (to64 R) (value32 R) 14); [lia|exact IR| |exact ZR];
      rewrite Rabs_pos_eq by lra; simpl; lra).
    assert (EXb : (exponent b <= 15)%Z).
    { rewrite Hb in Zb |- *. apply (exactly_exponent width v Y 14); [lia|exact (coordinate_is _ _ Hv)| |exact Zb].
      apply Rle_trans with (1 := HY). simpl. lra. }
    assert (T : tight width (1074 + width + 3) (Z.max (Z.max (- width) (- width)) (1 - width) + 45 + 3) (add width radius b)
      (value32 R + Y)).
    { apply tight_sum; try assumption; try lia.
      apply Rle_trans with (bpow radix2 (-30)); [apply bpow_le; lia|]. rewrite Rabs_pos_eq by lra. simpl. lra. }
    replace (1077 + width)%Z with (1074 + width + 3)%Z by ring. apply tight_more with (1 := T); lia.
Qed.

Lemma shading_root_tight : forall width R w K v X, (128 <= width)%Z -> (60 * (3268 + 4 * width) <= range)%Z -> parameters R w K ->
  coordinate v X -> Rabs X <= value32 R -> let radius := exactly width (to64 R) in let x := exactly width v in
  tight width (60 * (3268 + 4 * width)) (56 - width)
    (square_root_newton width (multiply width (subtract width radius x) (add width radius x))) (sqrt ((value32 R - X) * (value32 R + X))).
Proof.
  intros width R w K v X W Hr Hp Hv HX radius x.
  pose proof (tight_exactly width (- width) _ _ ltac:(lia) ltac:(numbers; lia) (coordinate_is _ _ Hv)) as Tx. fold x in Tx.
  pose proof (radius_and width R w K v X x W ltac:(lia) Hp Hv HX Tx (or_intror eq_refl)) as T2.
  assert (T1 : tight width (1077 + width) (49 - width) (add width radius (negated x)) (value32 R + - X)).
  { apply (radius_and width R w K (opp v) (- X)); try assumption; try lia.
    - now apply coordinate_opp.
    - now rewrite Rabs_Ropp.
    - now apply tight_negated.
    - unfold x. destruct Hv as [[Vv Fv] _ _ _]. destruct v as [s|s|s p q|s m e H]; try discriminate Fv; [left|right; reflexivity].
      split; [reflexivity|]. rewrite <- Vv. simpl. ring. }
  fold radius in T2. unfold subtract.
  pose proof (tight_multiply width (1077 + width) (49 - width) (49 - width) _ _ _ _ ltac:(lia) ltac:(lia) ltac:(lia) ltac:(lia)
    T1 T2) as T3.
  pose proof (Rabs_le_inv _ _ HX) as HX2. replace (value32 R + - X) with (value32 R - X) in T3 by ring.
  assert (T4 : tight width (2158 + 3 * width) (52 - width) (multiply width (add width radius (negated x)) (add width radius x))
    ((value32 R - X) * (value32 R + X))) by (apply tight_more with (1 := T3); lia).
  pose proof (tight_root width (2158 + 3 * width) (52 - width) _ _ W ltac:(lia) ltac:(lia) T4 ltac:(apply Rmult_le_pos; lra)) as T5.
  apply tight_more with (1 := T5); lia.
Qed.
