(* SPDX-License-Identifier: BSD-3-Clause *)
(* The numbers with which binary64 decides signs on any set of triangles: Ball of fast/soups/numbers.h, with the products of
   fast/meshes/bounded_vector3.h. Here is what they compute, and that each bound has room for its own roundings. *)
From Coq Require Import ZArith Reals Lia Lra Psatz Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Relative.
From Forceshade Require Import Formats Operations Nearness.
Open Scope R_scope.

Notation finite64 := (is_finite 53 1024) (only parsing).

Record ball := Ball { middle : binary64; error : binary64 }.

Definition unit_of_ball : binary64 := two_to (-53).                     (* kUnit *)
Definition slack : binary64 := plus (two_to 0) (two_to (-48)).          (* kSlackOfSum *)
Definition least : binary64 := two_to (-1040).                          (* kLeast *)

(* Ball::exactly, Ball::rounded, is_sure and the operators. *)
Definition exactly (v : binary64) : ball := Ball v zero64.
Definition rounded (v propagated : binary64) : ball :=
  Ball v (plus (times slack (plus propagated (times unit_of_ball (absolute v)))) least).
Definition is_sure (a : ball) : bool := is_less (error a) (absolute (middle a)).
Definition negated (a : ball) : ball := Ball (opp (middle a)) (error a).
Definition add (a b : ball) : ball := rounded (plus (middle a) (middle b)) (plus (error a) (error b)).
Definition subtract (a b : ball) : ball := rounded (minus (middle a) (middle b)) (plus (error a) (error b)).
(* |a| e_b + (|b| + e_b) e_a, as operator* and handed_on() write it. *)
Definition handed_on (a b : ball) : binary64 :=
  plus (times (absolute (middle a)) (error b)) (times (plus (absolute (middle b)) (error b)) (error a)).
Definition multiply (a b : ball) : ball := rounded (times (middle a) (middle b)) (handed_on a b).

(* bound_of_sum(), difference_of_products() and dot(); `units` is 2 kUnit and 3 kUnit. *)
Definition bound_of_sum (charged propagated : binary64) : binary64 := plus (times slack (plus charged propagated)) least.
Definition units (n : Z) : binary64 := binary_normalize 53 1024 (eq_refl _) (eq_refl _) mode_NE n (-53) false.
Definition difference_of_products (a b c d : ball) : ball :=
  let first := times (middle a) (middle b) in let second := times (middle c) (middle d) in
  Ball (minus first second)
    (bound_of_sum (times (units 2) (plus (absolute first) (absolute second))) (plus (handed_on a b) (handed_on c d))).
Definition dot_of (a b c d e f : ball) : ball :=
  let x := times (middle a) (middle b) in let y := times (middle c) (middle d) in let z := times (middle e) (middle f) in
  Ball (plus (plus x y) z)
    (bound_of_sum (times (units 3) (plus (plus (absolute x) (absolute y)) (absolute z)))
      (plus (plus (handed_on a b) (handed_on c d)) (handed_on e f))).

(* The bound is infinite or no number: nothing is known, and is_sure is false. *)
Definition decides_nothing (e : binary64) : bool :=
  match e with B754_infinity _ _ s => negb s | B754_nan _ _ _ _ _ => true | _ => false end.
Definition contains (a : ball) (x : R) : Prop :=
  decides_nothing (error a) = true \/
  (finite64 (middle a) = true /\ finite64 (error a) = true /\ 0 <= value64 (error a) /\
    Rabs (x - value64 (middle a)) <= value64 (error a)).

(* ---- One operation, whatever it gives. eta: half of what is lost below the normal numbers. ---- *)

Definition eta : R := bpow radix2 (-1074).
Lemma eta_is_positive : 0 < eta.
Proof. apply bpow_gt_0. Qed.

Lemma product_is_off : forall a, Rabs (nearest64 a - a) <= unit53 * Rabs a + eta.
Proof.
  intro a. destruct (error_N_FLT radix2 (-1074) 53 (eq_refl _) (fun n => negb (Z.even n)) a) as (e & f & He & Hf & _ & E). rewrite E.
  replace (a * (1 + e) + f - a) with (a * e + f) by ring. apply Rle_trans with (1 := Rabs_triang _ _). apply Rplus_le_compat.
  - rewrite Rabs_mult, Rmult_comm. apply Rmult_le_compat_r; [apply Rabs_pos|]. apply Rle_trans with (1 := He). unfold unit53. simpl. lra.
  - apply Rle_trans with (1 := Hf). unfold eta. pose proof (bpow_gt_0 radix2 (-1074)). lra.
Qed.

(* A number that is not below 0 has the sign of -0 only where it is 0. *)
Lemma sign_of_finite : forall v, finite64 v = true -> 0 <= value64 v -> Bsign 53 1024 v = true -> value64 v = 0.
Proof.
  intros [s|s|s p q|s m x q] F P E; try discriminate; [reflexivity|]. cbn in E. subst s. exfalso. revert P. apply Rlt_not_le.
  now apply F2R_lt_0.
Qed.

(* A sum of two numbers is rounded once, or infinite; so is a product. *)
Lemma plus_gives : forall v w, finite64 v = true -> finite64 w = true ->
  (finite64 (plus v w) = true /\ value64 (plus v w) = nearest64 (value64 v + value64 w)) \/
  (exists s, plus v w = B754_infinity 53 1024 s /\ (0 <= value64 v -> 0 <= value64 w -> s = false)).
Proof.
  intros v w Fv Fw. unfold plus, b64_plus.
  match goal with |- context [Bplus _ _ ?p ?q ?nan _ _ _] => pose proof (Bplus_correct 53 1024 p q nan mode_NE v w Fv Fw) as C;
    set (sum := Bplus 53 1024 p q nan mode_NE v w) in * end.
  cbv zeta in C. destruct (Rlt_bool_spec (Rabs (round radix2 (SpecFloat.fexp 53 1024) (round_mode mode_NE) (value64 v + value64 w)))
    (bpow radix2 1024)) as [L|L].
  - left. destruct C as (C1 & C2 & _). now split.
  - right. exists (Bsign 53 1024 v). destruct C as [C1 C2]. split.
    { unfold binary_overflow in C1. cbn [overflow_to_inf] in C1. now destruct sum; inversion C1. }
    intros Pv Pw. destruct (Bsign 53 1024 v) eqn:E; [|reflexivity]. exfalso. apply Rle_not_lt in L. apply L.
    rewrite (sign_of_finite v), (sign_of_finite w) by auto. rewrite Rplus_0_l, round_0, Rabs_R0 by auto with typeclass_instances.
    apply bpow_gt_0.
Qed.

Lemma times_gives : forall v w, finite64 v = true -> finite64 w = true ->
  (finite64 (times v w) = true /\ value64 (times v w) = nearest64 (value64 v * value64 w)) \/
  (exists s, times v w = B754_infinity 53 1024 s /\ (0 <= value64 v -> 0 <= value64 w -> s = false)).
Proof.
  intros v w Fv Fw. unfold times, b64_mult.
  match goal with |- context [Bmult _ _ ?p ?q ?nan _ _ _] => pose proof (Bmult_correct 53 1024 p q nan mode_NE v w) as C;
    set (product := Bmult 53 1024 p q nan mode_NE v w) in * end.
  cbv zeta in C. destruct (Rlt_bool_spec (Rabs (round radix2 (SpecFloat.fexp 53 1024) (round_mode mode_NE) (value64 v * value64 w)))
    (bpow radix2 1024)) as [L|L].
  - left. destruct C as (C1 & C2 & _). rewrite Fv, Fw in C2. now split.
  - right. exists (xorb (Bsign 53 1024 v) (Bsign 53 1024 w)). split.
    { unfold binary_overflow in C. cbn [overflow_to_inf] in C. now destruct product; inversion C. }
    intros Pv Pw. pose proof (sign_of_finite v Fv Pv) as Sv. pose proof (sign_of_finite w Fw Pw) as Sw.
    destruct (Bsign 53 1024 v) eqn:Ev, (Bsign 53 1024 w) eqn:Ew; try reflexivity; exfalso; apply Rle_not_lt in L; apply L;
      [rewrite (Sv eq_refl), Rmult_0_l | rewrite (Sw eq_refl), Rmult_0_r];
      rewrite round_0, Rabs_R0 by auto with typeclass_instances; apply bpow_gt_0.
Qed.

(* ---- Bounds. A bound decides nothing; or it is no smaller than t but for k roundings and n times eta, and P holds. ---- *)

Definition covers (P : Prop) (k n : R) (e : binary64) (t : R) : Prop :=
  decides_nothing e = true \/ (P /\ finite64 e = true /\ 0 <= value64 e /\ (1 - k * unit53) * t - n * eta <= value64 e).

Lemma nothing_plus : forall e v, decides_nothing e = true -> decides_nothing v = true \/ finite64 v = true ->
  decides_nothing (plus e v) = true /\ decides_nothing (plus v e) = true.
Proof. intros [s|[]|s p q|s m x q] [s'|[]|s' p' q'|s' m' x' q'] E [H|H]; try discriminate; split; reflexivity. Qed.

Lemma nothing_times : forall e v, decides_nothing e = true -> decides_nothing v = true \/ (finite64 v = true /\ 0 <= value64 v) ->
  decides_nothing (times e v) = true /\ decides_nothing (times v e) = true.
Proof.
  intros [s|[]|s p q|s m x q] [s'|[]|s' p' q'|s' m' x' q'] E [H|[H P]]; try discriminate; try (split; reflexivity).
  destruct s'; [|split; reflexivity]. exfalso. revert P. apply Rlt_not_le. now apply F2R_lt_0.
Qed.

Lemma covers_absolute : forall v, covers (finite64 v = true) 0 0 (absolute v) (Rabs (value64 v)).
Proof.
  intro v. unfold covers. destruct (finite64 v) eqn:F.
  - right. destruct (absolute_is v (value64 v) (conj eq_refl F)) as [A B]. rewrite A, B. pose proof (Rabs_pos (value64 v)).
    repeat split; lra.
  - left. now destruct v; try discriminate F.
Qed.

Lemma covers_sum : forall P Q k l m n p q e f s t, covers P k m e s -> covers Q l n f t -> 0 <= s -> 0 <= t ->
  0 <= k <= p -> 0 <= l <= p -> p <= 100 -> 0 <= m -> 0 <= n -> q = m + n -> covers (P /\ Q) (p + 1) q (plus e f) (s + t).
Proof.
  intros P Q k l m n p q e f s t [E|(HP & Fe & Pe & E)] [F|(HQ & Ff & Pf & F)] S T K L B M N ->;
    try (left; apply (nothing_plus e f E); now (left + right)); [left; apply (nothing_plus f e F); now right|].
  destruct (plus_gives e f Fe Ff) as [[G V]|(b & -> & Hb)]; [|left; now rewrite (Hb Pe Pf)].
  right. split; [now split|]. split; [exact G|]. rewrite V.
  pose proof (sum_is_close _ _ (generic_format_B2R 53 1024 e) (generic_format_B2R 53 1024 f)) as C.
  rewrite (Rabs_pos_eq (value64 e + value64 f)) in C by lra. apply Rabs_le_inv in C.
  pose proof unit_is_small as U. pose proof eta_is_positive as H.
  assert (R : (1 - unit53) * ((1 - p * unit53) * (s + t) - (m + n) * eta) <= (1 - unit53) * (value64 e + value64 f)).
  { apply Rmult_le_compat_l; [lra|]. assert (k * unit53 * s <= p * unit53 * s) by (repeat apply Rmult_le_compat_r; lra).
    assert (l * unit53 * t <= p * unit53 * t) by (repeat apply Rmult_le_compat_r; lra). lra. }
  split; [nra|]. assert (0 <= p * unit53 * unit53 * (s + t)) by (repeat apply Rmult_le_pos; lra).
  assert (0 <= unit53 * (m + n) * eta) by (repeat apply Rmult_le_pos; lra). lra.
Qed.

Lemma covers_product : forall P Q k l p e f s t, covers P k 0 e s -> covers Q l 0 f t -> 0 <= s -> 0 <= t ->
  0 <= k -> 0 <= l -> p = k + l -> p <= 100 -> covers (P /\ Q) (p + 1) 1 (times e f) (s * t).
Proof.
  intros P Q k l p e f s t [E|(HP & Fe & Pe & E)] [F|(HQ & Ff & Pf & F)] S T K L -> B;
    try (left; apply (nothing_times e f E); now (left + right)); [left; apply (nothing_times f e F); now right|].
  destruct (times_gives e f Fe Ff) as [[G V]|(b & -> & Hb)]; [|left; now rewrite (Hb Pe Pf)].
  right. split; [now split|]. split; [exact G|]. rewrite V. pose proof unit_is_small as U. pose proof eta_is_positive as H.
  assert (Pos : 0 <= value64 e * value64 f) by now apply Rmult_le_pos.
  split; [apply round_ge_generic; auto with typeclass_instances; apply generic_format_0|].
  pose proof (product_is_off (value64 e * value64 f)) as C. rewrite (Rabs_pos_eq (value64 e * value64 f)) in C by lra.
  apply Rabs_le_inv in C. rewrite Rmult_0_l, Rminus_0_r in E, F.
  assert (Ku : 0 <= 1 - k * unit53) by nra. assert (Lu : 0 <= 1 - l * unit53) by nra.
  assert (M : (1 - k * unit53) * s * ((1 - l * unit53) * t) <= value64 e * value64 f) by (apply Rmult_le_compat; nra).
  assert (ST : 0 <= s * t) by now apply Rmult_le_pos.
  assert (D : (1 - (k + l) * unit53) * (s * t) <= (1 - k * unit53) * s * ((1 - l * unit53) * t)).
  { assert (0 <= k * unit53 * (l * unit53) * (s * t)) by (repeat apply Rmult_le_pos; lra). lra. }
  assert (D2 : (1 - unit53) * ((1 - (k + l) * unit53) * (s * t)) <= (1 - unit53) * (value64 e * value64 f))
    by (apply Rmult_le_compat_l; lra).
  assert (0 <= (k + l) * unit53 * unit53 * (s * t)) by (repeat apply Rmult_le_pos; lra). lra.
Qed.

Lemma covers_exactly : forall e s, is64 e s -> 0 <= s -> covers True 0 0 e s.
Proof. intros e s [V F] S. right. rewrite V, F. repeat split; lra. Qed.

Lemma slack_is : is64 slack (1 + bpow radix2 (-48)).
Proof.
  unfold slack. replace (1 + bpow radix2 (-48)) with (nearest64 (bpow radix2 0 + bpow radix2 (-48))).
  - apply plus_is; try (apply two_to_is; lia). rewrite Rabs_pos_eq by (pose proof (bpow_gt_0 radix2 (-48)); simpl in *; lra).
    apply Rle_trans with (bpow radix2 1); [simpl; lra|apply bpow_le; lia].
  - apply round_generic; auto with typeclass_instances. apply generic_format_FLT.
    exists (Float radix2 (2 ^ 48 + 1) (-48)); [unfold F2R; simpl; lra|simpl; lia|simpl; lia].
Qed.

(* The last two steps of each bound: it has room for its own roundings, and for what is lost below the normal numbers. *)
Lemma covers_bound : forall P k n e t, covers P k n e t -> 0 <= t -> 0 <= k <= 20 -> 0 <= n <= 100 ->
  decides_nothing (plus (times slack e) least) = true \/
  (P /\ finite64 (plus (times slack e) least) = true /\ 0 <= value64 (plus (times slack e) least) /\
    (1 + 8 * unit53) * t + 1000 * eta <= value64 (plus (times slack e) least)).
Proof.
  intros P k n e t C T K N. pose proof slack_is as [Vs Fs]. pose proof (two_to_is (-1040) ltac:(lia)) as [Vl Fl]. fold least in Vl, Fl.
  assert (S32 : bpow radix2 (-48) = 32 * unit53) by (unfold unit53; simpl; lra).
  assert (L : bpow radix2 (-1040) = 17179869184 * eta).
  { unfold eta. change (-1040)%Z with (34 + -1074)%Z. now rewrite bpow_plus. }
  pose proof unit_is_small as U. pose proof eta_is_positive as H.
  assert (Slack1 : 0 <= value64 slack) by (rewrite Vs; lra).
  destruct C as [C|(HP & Fe & Pe & C)].
  { left. apply (nothing_plus (times slack e) least); [|now right]. apply (nothing_times e slack C). now right. }
  destruct (times_gives slack e Fs Fe) as [[G V]|(b & -> & Hb)].
  2: { left. rewrite (Hb Slack1 Pe). now apply (nothing_plus (B754_infinity 53 1024 false) least); [|right]. }
  pose proof (product_is_off (value64 slack * value64 e)) as O.
  rewrite Rabs_pos_eq with (x := value64 slack * value64 e) in O by now apply Rmult_le_pos.
  rewrite <- V in O. apply Rabs_le_inv in O.
  assert (Pp : 0 <= value64 (times slack e)).
  { rewrite V. apply round_ge_generic; auto with typeclass_instances; [apply generic_format_0|now apply Rmult_le_pos]. }
  destruct (plus_gives (times slack e) least G Fl) as [[G2 V2]|(b & -> & Hb)].
  2: { left. rewrite (Hb Pp); [reflexivity|]. rewrite Vl. lra. }
  right. split; [exact HP|]. split; [exact G2|]. rewrite V2.
  pose proof (sum_is_close _ _ (generic_format_B2R 53 1024 (times slack e)) (generic_format_B2R 53 1024 least)) as D.
  rewrite Vl in *. rewrite (Rabs_pos_eq (value64 (times slack e) + _)) in D by lra. apply Rabs_le_inv in D. rewrite Vs in *.
  set (x := value64 e) in *. set (y := value64 (times slack e)) in *. rewrite S32 in *. rewrite L in *.
  assert (Y : (1 + 31 * unit53 - 32 * (unit53 * unit53)) * x - eta <= y) by lra.
  assert (X : (1 + 31 * unit53 - 32 * (unit53 * unit53)) * ((1 - 20 * unit53) * t - n * eta) <=
    (1 + 31 * unit53 - 32 * (unit53 * unit53)) * x).
  { apply Rmult_le_compat_l; [nra|]. assert (k * unit53 * t <= 20 * unit53 * t) by (repeat apply Rmult_le_compat_r; lra). lra. }
  assert (Z : (1 + 10 * unit53) * t - 201 * eta <= y).
  { assert (Nn : 0 <= n * eta) by (apply Rmult_le_pos; lra). assert (n * eta <= 100 * eta) by (apply Rmult_le_compat_r; lra).
    assert (A1 : (1 + 31 * unit53 - 32 * (unit53 * unit53)) * (n * eta) <= 2 * (n * eta)) by (apply Rmult_le_compat_r; nra).
    assert (A2 : (1 + 10 * unit53) * t <= (1 + 31 * unit53 - 32 * (unit53 * unit53)) * (1 - 20 * unit53) * t)
      by (apply Rmult_le_compat_r; nra).
    lra. }
  assert (W : (1 - unit53) * ((1 + 10 * unit53) * t + 17179868983 * eta) <= (1 - unit53) * (y + 17179869184 * eta))
    by (apply Rmult_le_compat_l; lra).
  assert (A3 : (1 + 8 * unit53) * t <= (1 - unit53) * (1 + 10 * unit53) * t) by (apply Rmult_le_compat_r; nra).
  assert (0 <= unit53 * eta <= / 1000000000000 * eta) by (split; [apply Rmult_le_pos|apply Rmult_le_compat_r]; lra).
  split; [|lra]. assert (0 <= (1 - unit53) * (y + 17179869184 * eta)) by (apply Rmult_le_pos; lra). lra.
Qed.
