(* SPDX-License-Identifier: BSD-3-Clause *)
(* The two formats, and how a number goes from one to the other. Every file has proofs/spec/Laws.v by this one. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Export Laws.
Open Scope R_scope.

Notation value64 := (B2R 53 1024).
Notation fexp64 := (FLT_exp (-1074) 53).
Notation nearest64 := (round radix2 fexp64 ZnearestE).
Notation zero64 := (B754_zero 53 1024 false).

Global Instance prec24 : Prec_gt_0 24 := eq_refl _.
Global Instance prec53 : Prec_gt_0 53 := eq_refl _.

(* static_cast from one format to the other. nan: what a NaN becomes. *)
Definition cast {prec emax} prec' emax' (Hprec : Prec_gt_0 prec') (Hmax : (prec' < emax')%Z) (nan : binary_float prec' emax')
    (x : binary_float prec emax) : binary_float prec' emax' :=
  match x with
  | B754_zero _ _ s => B754_zero prec' emax' s
  | B754_infinity _ _ s => B754_infinity prec' emax' s
  | B754_nan _ _ _ _ _ => nan
  | B754_finite _ _ s m e _ => binary_normalize prec' emax' Hprec Hmax mode_NE (SpecFloat.cond_Zopp s (Zpos m)) e s
  end.

(* ---- static_cast<double>(float) ---- *)

Definition to64 : binary32 -> binary64 := cast 53 1024 (eq_refl _) (eq_refl _) (proj1_sig default_nan_pl64).

Lemma to64_is_exact : forall x : binary32, is_finite 24 128 x = true -> value64 (to64 x) = value32 x /\ is_finite 53 1024 (to64 x) = true.
Proof.
  intros x Hfinite. pose proof (abs_B2R_lt_emax 24 128 x) as Hbelow.
  assert (G : generic_format radix2 fexp64 (value32 x)).
  { apply generic_inclusion_mag with fexp32; [intros _; unfold FLT_exp; lia|apply (generic_format_B2R 24 128)]. }
  destruct x as [s|s|s pl Hpl|s m e H]; try discriminate; [now split|]. unfold to64, cast.
  pose proof (binary_normalize_correct 53 1024 (eq_refl _) (eq_refl _) mode_NE (SpecFloat.cond_Zopp s (Zpos m)) e s) as C.
  change (round radix2 (SpecFloat.fexp 53 1024) (round_mode mode_NE) (F2R (Float radix2 (SpecFloat.cond_Zopp s (Zpos m)) e)))
    with (nearest64 (value32 (B754_finite 24 128 s m e H))) in C.
  rewrite round_generic in C by auto with typeclass_instances.
  rewrite Rlt_bool_true in C; [now destruct C as [C1 [C2 _]]|]. apply Rlt_trans with (1 := Hbelow). now apply bpow_lt.
Qed.

(* ---- static_cast<float>(double) + 0.0F ---- *)

Definition to32 : binary64 -> binary32 := cast 24 128 (eq_refl _) (eq_refl _) (proj1_sig default_nan_pl32).
Definition returned (v : binary64) : binary32 := b32_plus mode_NE (to32 v) zero32.

Lemma to32_rounds_once : forall v : binary64, is_finite 53 1024 v = true -> Rabs (nearest32 (value64 v)) < bpow radix2 128 ->
  value32 (to32 v) = nearest32 (value64 v) /\ is_finite 24 128 (to32 v) = true.
Proof.
  intros v Hfinite Hbelow. destruct v as [s|s|s pl Hpl|s m ex H]; try discriminate.
  - simpl. now rewrite round_0 by auto with typeclass_instances.
  - unfold to32, cast.
    pose proof (binary_normalize_correct 24 128 (eq_refl _) (eq_refl _) mode_NE (SpecFloat.cond_Zopp s (Zpos m)) ex s) as C.
    rewrite Rlt_bool_true in C by exact Hbelow. now destruct C as [C1 [C2 _]].
Qed.

Lemma returned_is_nearest : forall v : binary64, is_finite 53 1024 v = true -> Rabs (value64 v) < bpow radix2 127 ->
  is_nearest32 (returned v) (value64 v).
Proof.
  intros v Hfinite Hsize.
  assert (Hbelow : Rabs (nearest32 (value64 v)) < bpow radix2 128).
  { apply Rle_lt_trans with (bpow radix2 127); [|now apply bpow_lt]. apply abs_round_le_generic; auto with typeclass_instances.
    - apply generic_format_bpow. unfold FLT_exp. lia.
    - lra. }
  destruct (to32_rounds_once v Hfinite Hbelow) as [Hvalue Hto]. unfold is_nearest32, returned, b32_plus.
  match goal with |- context [Bplus _ _ ?p ?q ?nan _ _ _] =>
    pose proof (Bplus_correct 24 128 p q nan mode_NE (to32 v) zero32 Hto eq_refl) as C;
    set (sum := Bplus 24 128 p q nan mode_NE (to32 v) zero32) in * end.
  cbv zeta in C. change (value32 zero32) with 0 in C. rewrite Rplus_0_r, Hvalue in C.
  change (round radix2 (SpecFloat.fexp 24 128) (round_mode mode_NE)) with nearest32 in C.
  rewrite (round_generic radix2 fexp32 ZnearestE (nearest32 _)) in C by (apply generic_format_round; auto with typeclass_instances).
  rewrite Rlt_bool_true in C by exact Hbelow. destruct C as (C1 & C2 & C3). split; [exact C1|]. split; [exact C2|]. intro H0.
  rewrite H0 in C1, C3. rewrite Rcompare_Eq in C3 by reflexivity. simpl in C3. rewrite andb_false_r in C3.
  destruct sum as [s|s|s pl Hpl|s m ex H]; try discriminate.
  - simpl in C3. now rewrite C3.
  - exfalso. simpl in C1. apply eq_0_F2R in C1. now destruct s.
Qed.

(* ---- The parts of a normal number ---- *)

(* One that is not below the normal numbers of binary32 has a significand of 53 bits. *)
Lemma normal_parts : forall v : binary64, is_finite 53 1024 v = true -> bpow radix2 (-126) <= Rabs (value64 v) ->
  exists s m ex H, v = B754_finite 53 1024 s m ex H /\ (-178 <= ex)%Z /\ (2 ^ 52 <= Zpos m < 2 ^ 53)%Z.
Proof.
  intros v Hfinite Hv. destruct v as [s|s|s pl Hpl|s m ex H]; try discriminate.
  { simpl in Hv. rewrite Rabs_R0 in Hv. pose proof (bpow_gt_0 radix2 (-126)). lra. }
  exists s, m, ex, H. split; [reflexivity|]. simpl in Hv. set (f := F2R (Float radix2 (Zpos m) ex)).
  assert (Hf : Rabs (F2R (Float radix2 (SpecFloat.cond_Zopp s (Zpos m)) ex)) = f) by (rewrite <- F2R_Zabs; now destruct s).
  rewrite Hf in Hv. assert (Hp : 0 < f) by now apply F2R_gt_0.
  assert (Hc : ex = cexp radix2 fexp64 f).
  { destruct (andb_prop _ _ H) as [Hc _]. now apply (canonical_canonical_mantissa 53 1024 false) in Hc. }
  assert (Hmag : (-125 <= mag radix2 f)%Z).
  { apply mag_ge_bpow. change (-125 - 1)%Z with (-126)%Z. now rewrite Rabs_pos_eq by lra. }
  unfold cexp, FLT_exp in Hc. assert (Hex : ex = (mag radix2 f - 53)%Z) by lia. split; [lia|].
  assert (Hg : bpow radix2 (52 + ex) <= f < bpow radix2 (53 + ex)).
  { replace (52 + ex)%Z with (mag radix2 f - 1)%Z by lia. replace (53 + ex)%Z with (mag radix2 f : Z) by lia.
    pose proof (bpow_mag_le radix2 f ltac:(lra)) as Hlow. pose proof (bpow_mag_gt radix2 f) as Hhigh.
    rewrite Rabs_pos_eq in Hlow, Hhigh by lra. now split. }
  unfold f, F2R in Hg. cbn [Fnum Fexp] in Hg.
  rewrite !bpow_plus in Hg. pose proof (bpow_gt_0 radix2 ex) as Hs.
  change (bpow radix2 52) with (IZR (2 ^ 52)) in Hg. change (bpow radix2 53) with (IZR (2 ^ 53)) in Hg.
  split; [apply le_IZR|apply lt_IZR]; [apply Rmult_le_reg_r with (1 := Hs)|apply Rmult_lt_reg_r with (1 := Hs)]; apply Hg.
Qed.
