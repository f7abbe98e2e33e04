(* SPDX-License-Identifier: BSD-3-Clause *)
(* The search for the nearest binary32 of fast/numbers/ball.h ends with it where the signs beside the ties are right and the candidate
   is no more than one number off. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Relative.
From Forceshade Require Import Formats Operations Inputs TopEdge Acceptance SecondStage Separation BigFloatProducts.
Open Scope R_scope.

Definition is_above (s : comparison) : bool := match s with Gt => true | _ => false end.
Definition is_below (s : comparison) : bool := match s with Lt => true | _ => false end.
Definition is_on (s : comparison) : bool := match s with Eq => true | _ => false end.

(* round_to_binary32, for signs that are never unknown. *)
Fixpoint search (beside : binary64 -> comparison) (steps : nat) (c : binary32) : option binary32 :=
  match steps with
  | O => None
  | S rest =>
    let up := beside (tie_of c (next_above c)) in
    let down := beside (tie_of c (next_below c)) in
    if is_above up || is_on up && negb (is_even c) then search beside rest (next_above c)
    else if is_below down || is_on down && negb (is_even c) then search beside rest (next_below c)
    else Some (b32_plus mode_NE c zero32)
  end.

Lemma search_step : forall beside rest c, search beside (S rest) c =
  let up := beside (tie_of c (next_above c)) in
  let down := beside (tie_of c (next_below c)) in
  if is_above up || is_on up && negb (is_even c) then search beside rest (next_above c)
  else if is_below down || is_on down && negb (is_even c) then search beside rest (next_below c)
  else Some (b32_plus mode_NE c zero32).
Proof. reflexivity. Qed.

(* ---- Ties go to the even one ---- *)

Lemma odd_significand : forall (c : binary32) (g : float radix2), is_finite 24 128 c = true -> is_even c = false ->
  value32 c = F2R g -> canonical radix2 fexp32 g -> Z.even (Fnum g) = false.
Proof.
  intros c g Hc Hodd Hv Hg. destruct c as [s|s|s pl H|s m e H]; try discriminate.
  - exfalso. destruct s; discriminate.
  - assert (Hm : canonical radix2 fexp32 (Float radix2 (SpecFloat.cond_Zopp s (Zpos m)) e)).
    { apply (canonical_canonical_mantissa 24 128 s). now destruct (andb_prop _ _ H). }
    rewrite <- (canonical_unique radix2 fexp32 _ _ Hm Hg Hv). cbn [Fnum].
    replace (Z.even (SpecFloat.cond_Zopp s (Zpos m))) with (Z.even (Zpos m)) by now destruct s.
    unfold is_even, bits_of_b32, bits_of_binary_float, join_bits in Hodd.
    destruct (0 <=? Zpos m - 2 ^ 23)%Z; rewrite Z.shiftl_mul_pow2 in Hodd by lia; rewrite Z.even_add, Z.even_mul in Hodd;
      change (Z.even (2 ^ 23)) with true in Hodd; rewrite orb_true_r in Hodd.
    + rewrite Z.even_sub in Hodd. change (Z.even (2 ^ 23)) with true in Hodd. now destruct (Z.even (Zpos m)).
    + now destruct (Z.even (Zpos m)).
Qed.

Lemma nearest_of_tie_is_even : forall (c : binary32) d, is_finite 24 128 c = true -> in_binary32 d -> value32 c <> d ->
  nearest32 ((value32 c + d) / 2) = value32 c -> is_even c = true.
Proof.
  intros c d Fc Gd Hne H. destruct (is_even c) eqn:Heven; [reflexivity|exfalso]. set (x := (value32 c + d) / 2) in *.
  assert (Hround : Rnd_NE_pt radix2 fexp32 x (nearest32 x)) by (apply round_NE_pt; auto with typeclass_instances).
  rewrite H in Hround. destruct Hround as [[_ Hn] [(g & G1 & G2 & G3)|Hu]].
  - rewrite (odd_significand c g Fc Heven G1 G2) in G3. discriminate.
  - apply Hne. symmetry. apply Hu. split; [exact Gd|]. intros f Hf. apply Rle_trans with (2 := Hn f Hf).
    right. replace (d - x) with (- (value32 c - x)) by (unfold x; field). apply Rabs_Ropp.
Qed.

(* ---- The distance of neighbours ---- *)

Lemma gap_above : forall c, in_binary32 c -> bpow radix2 (-25) * Rabs c <= succ radix2 fexp32 c - c.
Proof.
  assert (share : forall c, 0 <= c -> bpow radix2 (-24) * c <= ulp radix2 fexp32 c).
  { intros c Hc. destruct (Req_dec c 0) as [->|Hne]; [rewrite Rmult_0_r; apply ulp_ge_0|]. rewrite ulp_neq_0 by exact Hne.
    apply Rle_trans with (bpow radix2 (-24 + mag radix2 c)); [|apply bpow_le; unfold cexp, FLT_exp; lia].
    rewrite bpow_plus. apply Rmult_le_compat_l; [apply bpow_ge_0|]. apply Rlt_le. rewrite <- (Rabs_pos_eq c) at 1 by exact Hc.
    apply bpow_mag_gt. }
  change (bpow radix2 (-24)) with (/ 16777216) in share. change (bpow radix2 (-25)) with (/ 33554432).
  intros c Gc. destruct (Rle_lt_dec 0 c) as [Hc|Hc].
  - rewrite succ_eq_pos, Rabs_pos_eq by exact Hc. pose proof (share c Hc). lra.
  - set (p := pred radix2 fexp32 (- c)). assert (G2 : in_binary32 (- c)) by now apply generic_format_opp.
    assert (Hp : 0 <= p) by (apply pred_ge_0; auto with typeclass_instances; lra).
    assert (Es : succ radix2 fexp32 p = - c) by (apply succ_pred; auto with typeclass_instances).
    assert (Ep : succ radix2 fexp32 c = - p) by (unfold p; rewrite pred_opp; ring).
    rewrite succ_eq_pos in Es by exact Hp. pose proof (share p Hp). rewrite Ep, Rabs_left by exact Hc. lra.
Qed.

Lemma gap_below : forall c, in_binary32 c -> bpow radix2 (-25) * Rabs c <= c - pred radix2 fexp32 c.
Proof.
  intros c Gc. pose proof (gap_above (- c) ltac:(now apply generic_format_opp)) as H. rewrite Rabs_Ropp in H. unfold pred. lra.
Qed.

Lemma gap_is_not_tiny : forall c, in_binary32 c -> bpow radix2 (-149) <= succ radix2 fexp32 c - c.
Proof.
  assert (least : forall c, bpow radix2 (-149) <= ulp radix2 fexp32 c).
  { intro c. destruct (Req_dec c 0) as [->|Hne]; [rewrite ulp_FLT_0 by (auto with typeclass_instances); apply Rle_refl|].
    rewrite ulp_neq_0 by exact Hne. apply bpow_le. unfold cexp, FLT_exp. lia. }
  intros c Gc. destruct (Rle_lt_dec 0 c) as [Hc|Hc].
  - rewrite succ_eq_pos by exact Hc. pose proof (least c). lra.
  - set (p := pred radix2 fexp32 (- c)). assert (G2 : in_binary32 (- c)) by now apply generic_format_opp.
    assert (Hp : 0 <= p) by (apply pred_ge_0; auto with typeclass_instances; lra).
    assert (Es : succ radix2 fexp32 p = - c) by (apply succ_pred; auto with typeclass_instances).
    assert (Ep : succ radix2 fexp32 c = - p) by (unfold p; rewrite pred_opp; ring).
    rewrite succ_eq_pos in Es by exact Hp. pose proof (least p). lra.
Qed.

Lemma above_is_other : forall c, in_binary32 c -> c < succ radix2 fexp32 c.
Proof.
  intros c Gc. destruct (Req_dec c 0) as [->|Hne]; [|now apply succ_gt_id]. rewrite succ_0.
    rewrite ulp_FLT_0 by (auto with typeclass_instances).
  apply bpow_gt_0.
Qed.

Lemma below_is_other : forall c, in_binary32 c -> pred radix2 fexp32 c < c.
Proof. intros c Gc. pose proof (above_is_other (- c) ltac:(now apply generic_format_opp)) as H. unfold pred. lra. Qed.

(* ---- The steps ---- *)

(* Beside a tie the sign is that of what is rounded. *)
Definition signs_are_right (beside : binary64 -> comparison) (x : R) : Prop :=
  forall t m, is64 t m -> is_tie m -> Rabs m <= bpow radix2 29 -> is_sign (beside t) (x - m).

Lemma signs_of_step : forall beside x c, signs_are_right beside x -> is_finite 24 128 c = true -> Rabs (value32 c) < bpow radix2 28 ->
  (value32 (next_above c) = succ radix2 fexp32 (value32 c) /\ is_finite 24 128 (next_above c) = true) /\
  (value32 (next_below c) = pred radix2 fexp32 (value32 c) /\ is_finite 24 128 (next_below c) = true) /\
  is_sign (beside (tie_of c (next_above c))) (x - (value32 c + succ radix2 fexp32 (value32 c)) / 2) /\
  is_sign (beside (tie_of c (next_below c))) (x - (value32 c + pred radix2 fexp32 (value32 c)) / 2).
Proof.
  intros beside x c H Fc Bc. assert (Gb : in_binary32 (bpow radix2 28)) by (apply generic_format_bpow; unfold FLT_exp; lia).
  destruct (neighbours c (bpow radix2 28) Fc Gb Bc ltac:(apply bpow_le; lia)) as [(Ea & Fa & Ba) (Eb & Fb & Bb)].
  pose proof (generic_format_B2R 24 128 c) as Gc. change (SpecFloat.fexp 24 128) with fexp32 in Gc.
  change (bpow radix2 28) with 268435456 in *.
  assert (one : forall d N k, is_finite 24 128 d = true -> Rabs (value32 d) <= 268435456 -> value32 c + value32 d = IZR N * bpow radix2 k ->
    (0 < Z.abs N < 2 ^ 26)%Z -> (-149 <= k)%Z -> is_tie ((value32 c + value32 d) / 2) ->
    is_sign (beside (tie_of c d)) (x - (value32 c + value32 d) / 2)).
  { intros d N k Fd Bd E HN Hk T. pose proof (Rabs_triang (value32 c) (value32 d)) as R.
    destruct (tie_is c d N k Fc Fd E (proj2 HN) Hk ltac:(lra)) as [It _]. apply (H _ _ It T).
    unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ 2)) by lra. change (bpow radix2 29) with 536870912. lra. }
  split; [now split|]. split; [now split|]. destruct (middle_above _ Gc) as (N & k & E & HN & Hk).
  destruct (middle_below _ Gc) as (N' & k' & E' & HN' & Hk').
  rewrite <- Ea in E. rewrite <- Eb in E'. split.
  - rewrite <- Ea. apply (one _ N k); try assumption. exists (value32 c). split; [exact Gc|left]. now rewrite Ea.
  - rewrite <- Eb. apply (one _ N' k'); try assumption. exists (value32 c). split; [exact Gc|right]. now rewrite Eb.
Qed.

(* Below the middle above c the nearest is not above c, and above the middle below it not below. *)
Lemma nearest_not_above : forall c x, in_binary32 c -> x < (c + succ radix2 fexp32 c) / 2 -> nearest32 x <= c.
Proof. intros c x G H. exact (round_N_le_midp radix2 fexp32 (fun n => negb (Z.even n)) c x G H). Qed.
Lemma nearest_not_below : forall c x, in_binary32 c -> (c + pred radix2 fexp32 c) / 2 < x -> c <= nearest32 x.
Proof. intros c x G H. apply (round_N_ge_midp radix2 fexp32 (fun n => negb (Z.even n)) c x G). lra. Qed.

Lemma search_at_nearest : forall beside x c rest, signs_are_right beside x -> is_finite 24 128 c = true ->
  Rabs (value32 c) < bpow radix2 28 ->
  nearest32 x = value32 c -> search beside (S rest) c = Some (b32_plus mode_NE c zero32).
Proof.
  intros beside x c rest H Fc Bc Hn. destruct (signs_of_step beside x c H Fc Bc) as (_ & _ & Su & Sd). rewrite search_step. cbv zeta.
  pose proof (generic_format_B2R 24 128 c) as Gc. change (SpecFloat.fexp 24 128) with fexp32 in Gc.
  pose proof (above_is_other _ Gc) as A. pose proof (below_is_other _ Gc) as B.
  assert (Ga : in_binary32 (succ radix2 fexp32 (value32 c))) by (apply generic_format_succ; auto with typeclass_instances).
  assert (Gd : in_binary32 (pred radix2 fexp32 (value32 c))) by (apply generic_format_pred; auto with typeclass_instances).
  assert (U : is_above (beside (tie_of c (next_above c))) || is_on (beside (tie_of c (next_above c))) && negb (is_even c) = false).
  { destruct (beside (tie_of c (next_above c))); cbn [is_sign is_above is_on orb andb] in *; [|reflexivity|].
    - rewrite (nearest_of_tie_is_even c (succ radix2 fexp32 (value32 c))); [reflexivity|exact Fc|exact Ga|lra|].
      replace ((value32 c + succ radix2 fexp32 (value32 c)) / 2) with x by lra. exact Hn.
    - exfalso. pose proof (nearest_not_below (succ radix2 fexp32 (value32 c)) x Ga) as R.
      rewrite pred_succ in R by (auto with typeclass_instances). specialize (R ltac:(lra)). lra. }
  assert (D : is_below (beside (tie_of c (next_below c))) || is_on (beside (tie_of c (next_below c))) && negb (is_even c) = false).
  { destruct (beside (tie_of c (next_below c))); cbn [is_sign is_below is_on orb andb] in *; [| |reflexivity].
    - rewrite (nearest_of_tie_is_even c (pred radix2 fexp32 (value32 c))); [reflexivity|exact Fc|exact Gd|lra|].
      replace ((value32 c + pred radix2 fexp32 (value32 c)) / 2) with x by lra. exact Hn.
    - exfalso. pose proof (nearest_not_above (pred radix2 fexp32 (value32 c)) x Gd) as R.
      rewrite succ_pred in R by (auto with typeclass_instances). specialize (R ltac:(lra)). lra. }
  now rewrite U, D.
Qed.

Lemma search_goes_up : forall beside x c rest, signs_are_right beside x -> is_finite 24 128 c = true -> Rabs (value32 c) < bpow radix2 28 ->
  nearest32 x = succ radix2 fexp32 (value32 c) -> search beside (S rest) c = search beside rest (next_above c).
Proof.
  intros beside x c rest H Fc Bc Hn. destruct (signs_of_step beside x c H Fc Bc) as (_ & _ & Su & _). rewrite search_step. cbv zeta.
  pose proof (generic_format_B2R 24 128 c) as Gc. change (SpecFloat.fexp 24 128) with fexp32 in Gc.
  pose proof (above_is_other _ Gc) as A. pose proof (below_is_other _ Gc) as B.
  destruct (beside (tie_of c (next_above c))); cbn [is_sign is_above is_on orb andb] in *; [| |reflexivity].
  - destruct (is_even c) eqn:E; [exfalso|reflexivity]. pose proof (accepted_candidate_is_nearest c x Fc) as R. cbv zeta in R.
    rewrite R in Hn; [lra|right; split; [lra|exact E]|left; lra].
  - exfalso. pose proof (nearest_not_above (value32 c) x Gc ltac:(lra)). lra.
Qed.

Lemma search_goes_down : forall beside x c rest, signs_are_right beside x -> is_finite 24 128 c = true ->
  Rabs (value32 c) < bpow radix2 28 ->
  nearest32 x = pred radix2 fexp32 (value32 c) -> search beside (S rest) c = search beside rest (next_below c).
Proof.
  intros beside x c rest H Fc Bc Hn. destruct (signs_of_step beside x c H Fc Bc) as (_ & _ & Su & Sd). rewrite search_step. cbv zeta.
  pose proof (generic_format_B2R 24 128 c) as Gc. change (SpecFloat.fexp 24 128) with fexp32 in Gc.
  pose proof (above_is_other _ Gc) as A. pose proof (below_is_other _ Gc) as B.
  assert (L : x <= (value32 c + pred radix2 fexp32 (value32 c)) / 2).
  { destruct (Rle_lt_dec x ((value32 c + pred radix2 fexp32 (value32 c)) / 2)) as [L|L]; [exact L|exfalso].
    pose proof (nearest_not_below (value32 c) x Gc ltac:(lra)). lra. }
  destruct (beside (tie_of c (next_above c))); cbn [is_sign is_above is_on orb andb] in *; [lra| |lra].
  destruct (beside (tie_of c (next_below c))); cbn [is_sign is_below is_on orb andb] in *; [|reflexivity|lra].
  destruct (is_even c) eqn:E; [exfalso|reflexivity]. pose proof (accepted_candidate_is_nearest c x Fc) as R. cbv zeta in R.
  rewrite R in Hn; [lra|left; lra|right; split; [lra|exact E]].
Qed.

(* v: where the search starts. *)
Theorem search_ends : forall beside x v c, signs_are_right beside x -> is_finite 24 128 c = true -> value32 c = nearest32 v ->
  v = x /\ x = 0 \/ Rabs v <= bpow radix2 26 /\ Rabs (x - v) <= bpow radix2 (-40) * Rabs v ->
  exists f, search beside 3 c = Some f /\ is_nearest32 f x.
Proof.
  intros beside x v c H Fc Ec Hv. pose proof (generic_format_B2R 24 128 c) as Gc. change (SpecFloat.fexp 24 128) with fexp32 in Gc.
  assert (here : forall d rest, is_finite 24 128 d = true -> Rabs (value32 d) < bpow radix2 28 -> nearest32 x = value32 d ->
    exists f, search beside (S rest) d = Some f /\ is_nearest32 f x).
  { intros d rest Fd Bd Hd. exists (b32_plus mode_NE d zero32). split;
    [now apply (search_at_nearest beside x)|now apply plus_zero_is_nearest]. }
  change (bpow radix2 28) with 268435456 in *. destruct Hv as [[-> ->]|[V2 D]].
  { apply here; [exact Fc| |now rewrite Ec]. rewrite Ec, round_0, Rabs_R0 by auto with typeclass_instances. lra. }
  change (bpow radix2 26) with 67108864 in V2. change (bpow radix2 (-40)) with (/ 1099511627776) in D.
  pose proof (gap_above _ Gc) as Ga. pose proof (gap_below _ Gc) as Gb. change (bpow radix2 (-25)) with (/ 33554432) in Ga, Gb.
  assert (near : Rabs (value32 c) <= 70000000 /\ Rabs (x - v) <= (succ radix2 fexp32 (value32 c) - value32 c) / 2 /\
    Rabs (x - v) <= (value32 c - pred radix2 fexp32 (value32 c)) / 2).
  { destruct (Rle_lt_dec (bpow radix2 (-126)) (Rabs v)) as [V1|V1].
    - assert (C1 : Rabs (value32 c - v) <= / 1000 * Rabs v).
      { rewrite Ec. pose proof (relative_error_N_FLT radix2 (-149) 24 (eq_refl _) (fun n => negb (Z.even n)) v) as R.
        change (-149 + 24 - 1)%Z with (-126)%Z in R. specialize (R V1). apply Rle_trans with (1 := R).
        apply Rmult_le_compat_r; [apply Rabs_pos|]. change (bpow radix2 (- (24) + 1)) with (/ 8388608). lra. }
      pose proof (Rabs_triang_inv v (value32 c)) as T1. rewrite Rabs_minus_sym in T1. pose proof (Rabs_triang_inv (value32 c) v) as T2.
      lra.
    - assert (C1 : Rabs (value32 c) <= 1).
      { rewrite Ec. apply abs_round_le_generic; auto with typeclass_instances.
        - apply (generic_format_bpow radix2 fexp32 0). unfold FLT_exp. lia.
        - apply Rlt_le, Rlt_le_trans with (1 := V1). apply (bpow_le radix2 (-126) 0). lia. }
      pose proof (gap_is_not_tiny _ Gc) as A. pose proof (gap_is_not_tiny (- value32 c) ltac:(now apply generic_format_opp)) as B.
      assert (E : bpow radix2 (-126) = 8388608 * bpow radix2 (-149)).
      { change (-126)%Z with (23 + -149)%Z. rewrite bpow_plus. reflexivity. }
      pose proof (bpow_gt_0 radix2 (-149)) as P. set (b := bpow radix2 (-149)) in *. unfold pred. lra. }
  destruct near as (Bc0 & Da & Db). assert (Bc : Rabs (value32 c) < 268435456) by lra.
  destruct (signs_of_step beside x c H Fc Bc) as ((Ea & Fa) & (Eb & Fb) & _).
  assert (Fua : in_binary32 (succ radix2 fexp32 (value32 c))) by (apply generic_format_succ; auto with typeclass_instances).
  assert (Fub : in_binary32 (pred radix2 fexp32 (value32 c))) by (apply generic_format_pred; auto with typeclass_instances).
  assert (Gx : in_binary32 (nearest32 x)) by (apply generic_format_round; auto with typeclass_instances).
  assert (U : v <= (value32 c + succ radix2 fexp32 (value32 c)) / 2).
  { destruct (Rle_lt_dec v ((value32 c + succ radix2 fexp32 (value32 c)) / 2)) as [L|L]; [exact L|exfalso].
    pose proof (nearest_not_below (succ radix2 fexp32 (value32 c)) v Fua) as R.
    rewrite pred_succ in R by (auto with typeclass_instances). specialize (R ltac:(lra)). pose proof (above_is_other _ Gc).
     lra. }
  assert (L : (value32 c + pred radix2 fexp32 (value32 c)) / 2 <= v).
  { destruct (Rle_lt_dec ((value32 c + pred radix2 fexp32 (value32 c)) / 2) v) as [L|L]; [exact L|exfalso].
    pose proof (nearest_not_above (pred radix2 fexp32 (value32 c)) v Fub) as R.
    rewrite succ_pred in R by (auto with typeclass_instances). specialize (R ltac:(lra)). pose proof (below_is_other _ Gc).
     lra. }
  apply Rabs_le_inv in Da, Db.
  assert (N1 : nearest32 x <= succ radix2 fexp32 (value32 c)) by (apply round_le_generic; auto with typeclass_instances; lra).
  assert (N2 : pred radix2 fexp32 (value32 c) <= nearest32 x) by (apply round_ge_generic; auto with typeclass_instances; lra).
  pose proof (Rabs_def2 _ _ Bc) as Bc2.
  assert (Gb28 : in_binary32 268435456) by (change 268435456 with (bpow radix2 28); apply generic_format_bpow; unfold FLT_exp; lia).
  assert (room : Rabs (value32 c) < 134217728) by lra.
  assert (G27 : in_binary32 134217728) by (change 134217728 with (bpow radix2 27); apply generic_format_bpow; unfold FLT_exp; lia).
  destruct (neighbours c 134217728 Fc G27 room ltac:(change 134217728 with (bpow radix2 27); apply bpow_le; lia)) as
    [(_ & _ & Ba) (_ & _ & Bb)].
  destruct (Rtotal_order (nearest32 x) (value32 c)) as [Hlt|[Heq|Hgt]].
  - assert (E : nearest32 x = value32 (next_below c))
      by (rewrite Eb; apply Rle_antisym; [apply pred_ge_gt; auto with typeclass_instances|exact N2]).
    rewrite (search_goes_down beside x c 2 H Fc Bc) by (now rewrite <- Eb). apply here; [exact Fb|lra|exact E].
  - now apply here.
  - assert (E : nearest32 x = value32 (next_above c))
      by (rewrite Ea; apply Rle_antisym; [exact N1|apply succ_le_lt; auto with typeclass_instances]).
    rewrite (search_goes_up beside x c 2 H Fc Bc) by (now rewrite <- Ea). apply here; [exact Fa|lra|exact E].
Qed.
