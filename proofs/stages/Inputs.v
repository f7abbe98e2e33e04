(* SPDX-License-Identifier: BSD-3-Clause *)
(* The parameters and positions that a law is given, as numbers of binary64, within the domain of docs/laws.md. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core Operations BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate.
Open Scope R_scope.

Notation in_binary32 := (generic_format radix2 fexp32).

Lemma product_is_binary64 : forall a b, in_binary32 a -> in_binary32 b -> generic_format radix2 fexp64 (a * b).
Proof.
  assert (parts : forall a, in_binary32 a -> exists m e : Z, a = F2R (Float radix2 m e) /\ (Z.abs m < 2 ^ 24)%Z /\ (-149 <= e)%Z).
  { intros a G. apply FLT_format_generic in G; [|reflexivity]. destruct G as [[m e] H1 H2 H3]. now exists m, e. }
  intros a b Ha Hb. destruct (parts a Ha) as (m & e & -> & Hm & He), (parts b Hb) as (n & g & -> & Hn & Hg). rewrite <- F2R_mult.
  apply generic_format_FLT. exists (Float radix2 (m * n) (e + g)); [reflexivity| |].
  - cbn [Fnum]. rewrite Z.abs_mul. change (2 ^ 24)%Z with 16777216%Z in *. change (Zpower radix2 53) with 9007199254740992%Z. nia.
  - cbn [Fexp]. lia.
Qed.

Theorem product_is_exact : forall a b : binary32, generic_format radix2 fexp64 (value32 a * value32 b).
Proof. intros a b. apply product_is_binary64; apply (generic_format_B2R 24 128). Qed.

(* ---- The numbers that a law is built from ---- *)

Lemma size_of : forall l h a, bpow radix2 l <= a -> a <= bpow radix2 h -> size l h a.
Proof. intros l h a Hl Hh. unfold size. pose proof (bpow_gt_0 radix2 l). rewrite Rabs_pos_eq by lra. now split. Qed.

Lemma size_of_radius : forall R, / 10 <= R <= 10000 -> size (-4) 14 R.
Proof. intros R H. apply size_of; simpl; lra. Qed.
Lemma size_of_stiffness : forall K, / 1000 <= K <= 1000 -> size (-10) 10 K.
Proof. intros K H. apply size_of; simpl; lra. Qed.

(* half_width of the laws: 0.5 times the width. *)
Definition half_width (w : binary32) : binary64 := times (two_to (-1)) (to64 w).

Lemma half_width_is : forall R w K, parameters R w K -> is64 (half_width w) (value32 w / 2).
Proof.
  intros R w K ((_ & Fw & _) & HR & Hw & _). pose proof (two_to_is (-1) ltac:(lia)) as H2. pose proof (to64_is_exact w Fw) as H.
  assert (E : value32 w / 2 = nearest64 (bpow radix2 (-1) * value32 w)).
  { rewrite round_generic; auto with typeclass_instances.
    - change (bpow radix2 (-1)) with (/ 2). field.
    - apply product_is_binary64; [|apply (generic_format_B2R 24 128)]. apply generic_format_bpow. unfold FLT_exp. lia. }
  rewrite E. apply times_is; try assumption. change (bpow radix2 (-1)) with (/ 2). rewrite Rabs_pos_eq by lra.
  apply Rle_trans with (bpow radix2 14); [simpl; lra|apply bpow_le; lia].
Qed.

(* ---- Positions ---- *)

Record coordinate (v : binary64) (X : R) : Prop := {
  coordinate_is : is64 v X;
  coordinate_format : in_binary32 X;
  coordinate_range : Rabs X <= 10000;
  coordinate_size : X = 0 \/ size (-30) 14 X
}.

Lemma coordinate_not_tiny : forall v X, coordinate v X -> X = 0 \/ bpow radix2 (-30) <= Rabs X.
Proof. intros v X [_ _ _ [H|[H _]]]; [now left|now right]. Qed.

Lemma coordinates : forall x, in_domain x = true -> coordinate (to64 (quantised x)) (read (value32 x)).
Proof.
  intros x Hx. apply in_domain_is_right in Hx. destruct Hx as [Fx Rx]. destruct (quantised_is_right x Fx) as [Q1 Q2].
  pose proof (size_of_read (value32 x)) as Hs. split.
  - rewrite <- Q1. now apply to64_is_exact.
  - rewrite <- Q1. apply (generic_format_B2R 24 128).
  - lra.
  - unfold read in *. case Rle_bool_spec; intro H; [right|now left]. split; [assumption|]. apply Rle_trans with 10000; [lra|simpl; lra].
Qed.

Lemma valid_coordinates : forall x y z, valid x y z = true ->
  coordinate (to64 (quantised x)) (read (value32 x)) /\ coordinate (to64 (quantised z)) (read (value32 z)).
Proof.
  intros x y z H. unfold valid in H. destruct (andb_prop _ _ H) as [Hxy Hz]. destruct (andb_prop _ _ Hxy) as [Hx _].
  split; now apply coordinates.
Qed.

(* Coordinates and radii are multiples of 2^-53, and so are their differences. *)
Lemma multiple_of_2_53 : forall a, in_binary32 a -> a = 0 \/ bpow radix2 (-30) <= Rabs a -> exists n, a = IZR n * bpow radix2 (-53).
Proof.
  intros a Ha [->|Hs]; [exists 0%Z; ring|].
  assert (Hmag : (-29 <= mag radix2 a)%Z) by (apply mag_ge_bpow; exact Hs).
  unfold generic_format, scaled_mantissa in Ha. set (m := Ztrunc _) in Ha. set (e := cexp radix2 fexp32 a) in Ha.
  assert (He : (-53 <= e)%Z) by (unfold e, cexp, FLT_exp; lia).
  exists (m * 2 ^ (e + 53))%Z. rewrite Ha at 1. unfold F2R. cbn [Fnum Fexp]. rewrite mult_IZR.
  change (2 ^ (e + 53))%Z with (Zpower radix2 (e + 53)). rewrite IZR_Zpower by lia. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. ring.
Qed.

Lemma difference_is_not_tiny : forall a b, in_binary32 a -> in_binary32 b -> a = 0 \/ bpow radix2 (-30) <= Rabs a ->
  b = 0 \/ bpow radix2 (-30) <= Rabs b -> a - b <> 0 -> bpow radix2 (-53) <= Rabs (a - b).
Proof.
  intros a b Fa Fb Ha Hb Hne. destruct (multiple_of_2_53 a Fa Ha) as [m Hm], (multiple_of_2_53 b Fb Hb) as [n Hn].
  assert (E : a - b = IZR (m - n) * bpow radix2 (-53)) by (rewrite minus_IZR, Hm, Hn; ring). rewrite E, Rabs_mult.
  rewrite (Rabs_pos_eq (bpow radix2 (-53))) by apply bpow_ge_0. pose proof (bpow_gt_0 radix2 (-53)).
  assert (1 <= Rabs (IZR (m - n))); [|nra]. rewrite <- abs_IZR. apply IZR_le.
  assert (m - n <> 0)%Z; [|lia]. intro H0. apply Hne. rewrite E, H0. ring.
Qed.
