(* SPDX-License-Identifier: BSD-3-Clause *)
(* What the second stage accepts is right: the search for the nearest binary32 of fast/numbers/ball.h, and decide() of
   fast/evaluate.h, in double-double and for any law whose components are enclosed. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures BesideTie TopEdge
  Acceptance.
Open Scope R_scope.

(* ---- The middles ---- *)

(* 0.5 times the sum of two numbers of binary32. *)
Definition tie_of (c d : binary32) : binary64 := times (two_to (-1)) (plus (to64 c) (to64 d)).

(* A middle has few bits, and so has twice it. *)
Lemma middle_above : forall c, in_binary32 c -> exists N k, c + succ radix2 fexp32 c = IZR N * bpow radix2 k /\ (0 < Z.abs N < 2 ^ 26)%Z /\
  (-149 <= k)%Z.
Proof.
  assert (up : forall c, in_binary32 c -> 0 <= c -> exists N k, c + succ radix2 fexp32 c = IZR N * bpow radix2 k /\
    (0 < Z.abs N < 2 ^ 26)%Z /\
    (-149 <= k)%Z).
  { intros c Gc Hc. rewrite succ_eq_pos by exact Hc. destruct (Req_dec c 0) as [->|Hne].
    { exists 1%Z, (-149)%Z. rewrite ulp_FLT_0 by (auto with typeclass_instances). split; [ring|lia]. }
    rewrite ulp_neq_0 by exact Hne. set (k := cexp radix2 fexp32 c). set (n := Ztrunc (scaled_mantissa radix2 fexp32 c)).
    assert (Ec : c = IZR n * bpow radix2 k) by exact Gc.
    exists (2 * n + 1)%Z, k. split; [rewrite plus_IZR, mult_IZR; rewrite Ec at 1 2; ring|]. split; [|unfold k, cexp, FLT_exp; lia].
    assert (Hn : (Z.abs n < 2 ^ 24)%Z); [|lia].
    pose proof (bpow_gt_0 radix2 k) as Pk. apply lt_IZR. apply Rmult_lt_reg_r with (1 := Pk).
    rewrite abs_IZR, <- (Rabs_pos_eq (bpow radix2 k)) at 1 by lra. rewrite <- Rabs_mult, <- Ec. change (IZR (2 ^ 24)) with (bpow radix2 24).
    rewrite <- bpow_plus. apply Rlt_le_trans with (1 := bpow_mag_gt radix2 c). apply bpow_le. unfold k, cexp, FLT_exp. lia. }
  intros c Gc. destruct (Rle_lt_dec 0 c) as [Hc|Hc]; [now apply up|].
  assert (G2 : in_binary32 (- c)) by now apply generic_format_opp.
  assert (G3 : in_binary32 (pred radix2 fexp32 (- c))) by (apply generic_format_pred; auto with typeclass_instances).
  destruct (up (pred radix2 fexp32 (- c)) G3) as (N & k & E & HN & Hk); [apply pred_ge_0; auto with typeclass_instances; lra|].
  rewrite succ_pred in E by (auto with typeclass_instances). rewrite pred_opp in E.
  exists (- N)%Z, k. rewrite opp_IZR. split; [lra|]. split; [lia|exact Hk].
Qed.

Lemma middle_below : forall c, in_binary32 c -> exists N k, c + pred radix2 fexp32 c = IZR N * bpow radix2 k /\ (0 < Z.abs N < 2 ^ 26)%Z /\
  (-149 <= k)%Z.
Proof.
  intros c Gc. destruct (middle_above (pred radix2 fexp32 c)) as (N & k & E & H); [apply generic_format_pred; auto with
    typeclass_instances|].
  rewrite succ_pred in E by (auto with typeclass_instances). exists N, k. split; [lra|exact H].
Qed.

Lemma few_bits : forall N k, (Z.abs N < 2 ^ 26)%Z -> (-1074 <= k)%Z -> in_binary64 (IZR N * bpow radix2 k).
Proof.
  intros N k HN Hk. apply generic_format_FLT. exists (Float radix2 N k); [reflexivity| |exact Hk]. cbn [Fnum]. apply Z.lt_trans with (1 :=
    HN). reflexivity.
Qed.

Lemma tie_is : forall c d N k, is_finite 24 128 c = true -> is_finite 24 128 d = true -> value32 c + value32 d = IZR N * bpow radix2 k ->
  (Z.abs N < 2 ^ 26)%Z -> (-149 <= k)%Z -> Rabs (value32 c + value32 d) <= 1000000000 ->
  is64 (tie_of c d) ((value32 c + value32 d) / 2) /\ (value32 c + value32 d) / 2 = IZR N * bpow radix2 (k - 1).
Proof.
  intros c d N k Fc Fd E HN Hk Hs.
  assert (E2 : (value32 c + value32 d) / 2 = IZR N * bpow radix2 (k - 1)).
  { rewrite E. unfold Z.sub. rewrite bpow_plus. change (bpow radix2 (-(1))) with (/ 2). field. }
  split; [|exact E2]. unfold tie_of.
  assert (I : is64 (plus (to64 c) (to64 d)) (value32 c + value32 d)).
  { apply (plus_exact _ _ (value32 c) (value32 d)); [now apply to64_is_exact|now apply to64_is_exact|reflexivity| |apply big_enough; lra].
    rewrite E. apply few_bits; [exact HN|lia]. }
  apply (times_exact _ _ (bpow radix2 (-1)) (value32 c + value32 d)); [apply two_to_is; lia|exact I|change (bpow radix2 (-1)) with (/ 2);
    field| |].
  - rewrite E2. apply few_bits; [exact HN|lia].
  - apply big_enough. unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ 2)) by lra. lra.
Qed.

(* Both neighbours of a number that is not too large. *)
Lemma neighbours : forall c b, is_finite 24 128 c = true -> in_binary32 b -> Rabs (value32 c) < b -> b <= bpow radix2 100 ->
  (value32 (next_above c) = succ radix2 fexp32 (value32 c) /\ is_finite 24 128 (next_above c) = true /\ Rabs (value32 (next_above c)) <= b)
    /\
  (value32 (next_below c) = pred radix2 fexp32 (value32 c) /\ is_finite 24 128 (next_below c) = true /\ Rabs (value32 (next_below c)) <= b).
Proof.
  intros c b Fc Gb Hc Hb. apply Rabs_def2 in Hc. pose proof (generic_format_B2R 24 128 c) as Gc. change (SpecFloat.fexp 24 128) with fexp32
    in Gc.
  assert (Hs : value32 c < succ radix2 fexp32 (value32 c) \/ value32 c = 0 /\ 0 <= succ radix2 fexp32 (value32 c)).
  { destruct (Req_dec (value32 c) 0) as [E|E]; [right|left; now apply succ_gt_id]. split; [exact E|]. rewrite <- E at 1. apply succ_ge_id. }
  assert (Hp : pred radix2 fexp32 (value32 c) <= value32 c) by apply pred_le_id.
  assert (Hs2 : succ radix2 fexp32 (value32 c) <= b) by (apply succ_le_lt; auto with typeclass_instances; lra).
  assert (Hp2 : - b <= pred radix2 fexp32 (value32 c)).
  { apply pred_ge_gt; auto with typeclass_instances; [now apply generic_format_opp|lra]. }
  assert (Hbig : bpow radix2 100 < bpow radix2 128) by (apply bpow_lt; lia). pose proof (bpow_gt_0 radix2 128) as P128.
  split.
  - pose proof (Bsucc_correct 24 128 eq_refl eq_refl c Fc) as C. change (SpecFloat.fexp 24 128) with fexp32 in C. rewrite Rlt_bool_true in
    C by lra.
    destruct C as (C1 & C2 & _). split; [exact C1|]. split; [exact C2|]. unfold next_above. rewrite C1. apply Rabs_le. lra.
  - pose proof (Bpred_correct 24 128 eq_refl eq_refl c Fc) as C. change (SpecFloat.fexp 24 128) with fexp32 in C. rewrite Rlt_bool_true in
    C by lra.
    destruct C as (C1 & C2 & _). split; [exact C1|]. split; [exact C2|]. unfold next_below. rewrite C1. apply Rabs_le. lra.
Qed.

(* ---- The search ---- *)

Definition is_same (a b : Sign) : bool :=
  match a, b with
  | is_negative, is_negative | is_zero, is_zero | is_positive, is_positive | is_unknown, is_unknown => true
  | _, _ => false
  end.

(* sign_of_difference(value, tie) *)
Definition sign_beside (value : double_double) (tie : binary64) : Sign := sign_of (add value (negated (exactly64 tie))).

(* round_to_binary32: steps is 3 at first, and the candidate the first term in binary32. *)
Fixpoint rounded_from (steps : nat) (value : double_double) (c : binary32) : option binary32 :=
  match steps with
  | O => None
  | S rest =>
    let up := sign_beside value (tie_of c (next_above c)) in
    let down := sign_beside value (tie_of c (next_below c)) in
    if is_same up is_unknown || is_same down is_unknown then None
    else if is_same up is_positive || is_same up is_zero && negb (is_even c) then rounded_from rest value (next_above c)
    else if is_same down is_negative || is_same down is_zero && negb (is_even c) then rounded_from rest value (next_below c)
    else Some (b32_plus mode_NE c zero32)
  end.
Lemma one_step : forall rest value c, rounded_from (S rest) value c =
  let up := sign_beside value (tie_of c (next_above c)) in
  let down := sign_beside value (tie_of c (next_below c)) in
  if is_same up is_unknown || is_same down is_unknown then None
  else if is_same up is_positive || is_same up is_zero && negb (is_even c) then rounded_from rest value (next_above c)
  else if is_same down is_negative || is_same down is_zero && negb (is_even c) then rounded_from rest value (next_below c)
  else Some (b32_plus mode_NE c zero32).
Proof. reflexivity. Qed.

Definition rounded_to_binary32 (value : double_double) : option binary32 := rounded_from 3 value (to32 (hi value)).

(* candidate + 0.0F *)
Lemma plus_zero_is_nearest : forall c x, is_finite 24 128 c = true -> nearest32 x = value32 c -> is_nearest32 (b32_plus mode_NE c zero32) x.
Proof.
  intros c x Hto Hvalue. unfold is_nearest32, b32_plus. pose proof (abs_B2R_lt_emax 24 128 c) as Hbelow. rewrite Hvalue.
  match goal with |- context [Bplus _ _ ?p ?q ?nan _ _ _] =>
    pose proof (Bplus_correct 24 128 p q nan mode_NE c zero32 Hto eq_refl) as C; set (sum := Bplus 24 128 p q nan mode_NE c zero32) in *
      end.
  cbv zeta in C. change (value32 zero32) with 0 in C. rewrite Rplus_0_r in C.
  change (round radix2 (SpecFloat.fexp 24 128) (round_mode mode_NE)) with nearest32 in C.
  rewrite (round_generic radix2 fexp32 ZnearestE (value32 c)) in C by (auto with typeclass_instances; apply (generic_format_B2R 24 128)).
  rewrite Rlt_bool_true in C by exact Hbelow. destruct C as (C1 & C2 & C3). split; [exact C1|]. split; [exact C2|]. intro H0.
  rewrite H0 in C1, C3. rewrite Rcompare_Eq in C3 by reflexivity. simpl in C3. rewrite andb_false_r in C3.
  destruct sum as [s|s|s pl Hpl|s m ex H]; try discriminate.
  - simpl in C3. now rewrite C3.
  - exfalso. simpl in C1. apply eq_0_F2R in C1. now destruct s.
Qed.

(* First terms that a component may have. *)
Definition fits (value : double_double) : Prop := Rabs (value64 (hi value)) <= 26214400.

Lemma rounded_from_is_nearest : forall value x, contains value x ->
  value64 (error value) <= 10000000000000000000000000000000000000000 -> fits value ->
  forall n c j f, (0 <= j)%Z -> (j + Z.of_nat n <= 30)%Z -> is_finite 24 128 c = true -> Rabs (value32 c) <= IZR j * 1048576 ->
  rounded_from n value c = Some f -> is_nearest32 f x.
Proof.
  intros value x Hvalue Hs Hx. induction n as [|n IH]; intros c j f Hj Hn Fc Bc H; [discriminate|]. rewrite one_step in H. cbv zeta in H.
  assert (Hj1 : IZR (j + 1) <= 30) by (apply IZR_le; lia). pose proof (IZR_le _ _ Hj) as Hj0. rewrite plus_IZR in Hj1.
  assert (Gj : in_binary32 (IZR (j + 1) * 1048576)).
  { apply generic_format_FLT. exists (Float radix2 (j + 1) 20); [reflexivity| |cbn [Fexp]; lia]. cbn [Fnum]. change (Zpower radix2 24) with
    16777216%Z. lia. }
  assert (Bj1 : IZR (j + 1) * 1048576 <= 40000000) by (rewrite plus_IZR; lra).
  destruct (neighbours c (IZR (j + 1) * 1048576) Fc Gj) as [(Ea & Fa & Ba) (Eb & Fb & Bb)]; [rewrite plus_IZR; lra|simpl; lra|].
  pose proof (generic_format_B2R 24 128 c) as Gc. change (SpecFloat.fexp 24 128) with fexp32 in Gc.
  assert (beside : forall d N k, is_finite 24 128 d = true -> Rabs (value32 d) <= IZR (j + 1) * 1048576 -> value32 c + value32 d = IZR N *
    bpow radix2 k ->
    (0 < Z.abs N < 2 ^ 26)%Z -> (-149 <= k)%Z -> let t := (value32 c + value32 d) / 2 in
    match sign_beside value (tie_of c d) with is_negative => x < t | is_zero => x = t | is_positive => t < x | is_unknown => True end).
  { intros d N k Fd Bd E HN Hk t. pose proof (Rabs_triang (value32 c) (value32 d)) as T.
    destruct (tie_is c d N k Fc Fd E (proj2 HN) Hk ltac:(lra)) as [It Et]. fold t in It, Et.
    assert (Bt : Rabs t <= 100000000) by (unfold t, Rdiv; rewrite Rabs_mult, (Rabs_pos_eq (/ 2)) by lra; lra).
    pose proof (sign_is_right _ _ (difference_from_contained value x _ t N (k - 1) Hvalue Hs It Et ltac:(lia) (proj2 HN) ltac:(lia) Bt
        ltac:(unfold fits in Hx; lra))) as S.
    unfold sign_beside. destruct (sign_of _); try exact Logic.I; lra. }
  destruct (middle_above _ Gc) as (N & k & E & HN & Hk). rewrite <- Ea in E. pose proof (beside _ N k Fa Ba E HN Hk) as Sup. cbv zeta in
    Sup.
  destruct (middle_below _ Gc) as (N' & k' & E' & HN' & Hk'). rewrite <- Eb in E'. pose proof (beside _ N' k' Fb Bb E' HN' Hk') as Sdown.
    cbv zeta in Sdown.
  rewrite Ea in Sup. rewrite Eb in Sdown. clear beside.
  assert (accepted : (x < (value32 c + succ radix2 fexp32 (value32 c)) / 2 \/ x = (value32 c + succ radix2 fexp32 (value32 c)) / 2 /\
    is_even c = true) ->
    ((value32 c + pred radix2 fexp32 (value32 c)) / 2 < x \/ x = (value32 c + pred radix2 fexp32 (value32 c)) / 2 /\ is_even c = true) ->
    Some (b32_plus mode_NE c zero32) = Some f -> is_nearest32 f x).
  { intros Hup Hdown Hf. injection Hf as <-. apply plus_zero_is_nearest; [exact Fc|]. now apply accepted_candidate_is_nearest. }
  assert (above : rounded_from n value (next_above c) = Some f -> is_nearest32 f x) by (apply (IH _ (j + 1)%Z); try lia; assumption).
  assert (below : rounded_from n value (next_below c) = Some f -> is_nearest32 f x) by (apply (IH _ (j + 1)%Z); try lia; assumption).
  destruct (sign_beside value (tie_of c (next_above c))), (sign_beside value (tie_of c (next_below c))), (is_even c);
    cbn [is_same orb andb negb] in H;
    first [discriminate H|exact (above H)|exact (below H)|
      refine (accepted _ _ H); first [left; exact Sup|left; exact Sdown|right; exact (conj Sup eq_refl)|right; exact (conj Sdown eq_refl)]].
Qed.

(* The bound may be larger than the value: what is accepted is right. *)
Theorem rounded_from_contained_is_nearest : forall value x f, contains value x ->
  value64 (error value) <= 10000000000000000000000000000000000000000 -> fits value ->
  rounded_to_binary32 value = Some f -> is_nearest32 f x.
Proof.
  intros value x f Hvalue Hs Hx H. pose proof Hvalue as (h & l & e & [Vh Fh] & _ & _ & Bl & Be & B).
  assert (Bn : Rabs (nearest32 h) <= 26214400).
  { apply abs_round_le_generic; auto with typeclass_instances; [|unfold fits in Hx; rewrite Vh in Hx; exact Hx].
    apply generic_format_FLT. exists (Float radix2 25 20); [unfold F2R; simpl; lra|reflexivity|cbn [Fexp]; lia]. }
  destruct (to32_rounds_once (hi value) Fh) as [V F]; [rewrite Vh; apply Rle_lt_trans with (1 := Bn); apply Rlt_le_trans with (bpow radix2
    25); [simpl; lra|apply bpow_le; lia]|].
  rewrite Vh in V. unfold rounded_to_binary32 in H.
  refine (rounded_from_is_nearest value x Hvalue Hs Hx 3 (to32 (hi value)) 25 f _ _ F _ H); [lia|cbn; lia|].
  rewrite V. apply Rle_trans with (1 := Bn). lra.
Qed.

Lemma enclosed_fits : forall s value x, encloses s value x -> 0 <= s <= 100 -> fits value ->
  contains value x /\ value64 (error value) <= 10000000000000000000000000000000000000000.
Proof.
  intros s value x E Hs Hf. destruct (enclosed_is_bounded s value x _ E Hs Hf ltac:(lra)) as [C B]. split; [exact C|].
  assert (s * 26214400 <= 100 * 26214400) by (apply Rmult_le_compat_r; lra). lra.
Qed.

Theorem rounded_to_binary32_is_nearest : forall s value x f, encloses s value x -> 0 <= s <= 100 -> fits value ->
  rounded_to_binary32 value = Some f -> is_nearest32 f x.
Proof.
  intros s value x f E Hs Hf H. destruct (enclosed_fits s value x E Hs Hf) as [C B]. now apply (rounded_from_contained_is_nearest value).
Qed.

(* ---- decide() ---- *)

Definition decide (contact_sign : Sign) (fx fz : double_double) : option evaluation :=
  match contact_sign with
  | is_unknown => None
  | is_positive =>
    match rounded_to_binary32 fx, rounded_to_binary32 fz with
    | Some x, Some z => Some (contact, (x, zero32, z))
    | _, _ => None
    end
  | _ => Some (no_force free)
  end.

(* What a component has to be where the force acts. *)
Definition acceptable (value : double_double) (x : R) : Prop := contains value x /\
  value64 (error value) <= 10000000000000000000000000000000000000000 /\ fits value.

(* What a law's exact() finds of the contact, and the components where there is one. *)
Theorem decided_outcome_is_right : forall contact_sign fx fz Fx Fz touches answer,
  match contact_sign with
  | is_unknown => True
  | is_positive => touches /\ acceptable fx Fx /\ acceptable fz Fz
  | _ => ~ touches
  end -> decide contact_sign fx fz = Some answer -> is_answer answer touches Fx Fz.
Proof.
  intros contact_sign fx fz Fx Fz touches answer S H. unfold decide in H.
  destruct contact_sign; [left; now injection H as <-|left; now injection H as <-| |discriminate].
  right. destruct S as (T & (Ex & Bx & Cx) & (Ez & Bz & Cz)). split; [exact T|].
  destruct (rounded_to_binary32 fx) as [f|] eqn:Hx; [|discriminate]. destruct (rounded_to_binary32 fz) as [g|] eqn:Hz; [|discriminate].
  injection H as <-. exists f, g. split; [reflexivity|].
  split; [now apply (rounded_from_contained_is_nearest fx)|now apply (rounded_from_contained_is_nearest fz)].
Qed.

Lemma enclosed_is_acceptable : forall s value x, encloses s value x -> 0 <= s <= 100 -> fits value -> acceptable value x.
Proof. intros s value x E Hs Hf. destruct (enclosed_fits s value x E Hs Hf) as [C B]. now split. Qed.

Theorem decided_is_right : forall gap G fx fz s Fx Fz touches answer, contains gap G -> (0 < G <-> touches) -> 0 <= s <= 100 ->
  (sign_of gap = is_positive -> touches -> (encloses s fx Fx /\ fits fx) /\ (encloses s fz Fz /\ fits fz)) ->
  decide (sign_of gap) fx fz = Some answer -> is_answer answer touches Fx Fz.
Proof.
  intros gap G fx fz s Fx Fz touches answer Hgap Ht Hs Hforce. apply decided_outcome_is_right. pose proof (sign_is_right gap G Hgap) as S.
  destruct (sign_of gap); [intro T; apply Ht in T; lra|intro T; apply Ht in T; lra| |exact Logic.I].
  apply Ht in S. destruct (Hforce eq_refl S) as [[Ex Cx] [Ez Cz]]. split; [exact S|]. split; now apply (enclosed_is_acceptable s).
Qed.

(* The second stage between a first and a third one. *)
Definition later_of (second : binary32 -> binary32 -> option evaluation) (third : binary32 -> binary32 -> evaluation) (x z : binary32) :
  evaluation :=
  match second x z with Some answer => answer | None => third x z end.

Lemma two_stages_are_right : forall answer second third x z touches Fx Fz,
  right_or_later answer (later_of second third x z) touches Fx Fz ->
  (forall found, second x z = Some found -> is_answer found touches Fx Fz) -> right_or_later answer (third x z) touches Fx Fz.
Proof.
  intros answer second third x z touches Fx Fz [E|[H|H]] Hsecond; [|right; now left|right; now right]. unfold later_of in E.
  destruct (second x z) as [found|] eqn:Hf; [|now left]. right. rewrite E. destruct (Hsecond found eq_refl) as [H|H]; [now left|now right].
Qed.

(* An answer of the first two stages, or a right one of the third. *)
Lemma three_stages_are_right : forall answer third touches Fx Fz,
  right_or_later answer third touches Fx Fz -> is_answer third touches Fx Fz -> is_answer answer touches Fx Fz.
Proof. intros answer third touches Fx Fz [->|[H|H]] Hthird; [exact Hthird|now left|now right]. Qed.
