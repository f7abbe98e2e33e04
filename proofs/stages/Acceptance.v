(* SPDX-License-Identifier: BSD-3-Clause *)
(* When the later stages may return their candidate: round_to_binary32 of fast/numbers/ball.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats.
Open Scope R_scope.

Global Instance ties_in_fexp32 : Exists_NE radix2 fexp32 := exists_NE_FLT radix2 (-149) 24 (or_intror (eq_refl _)).

(* The last of the 32 bits is 0. *)
Definition is_even (c : binary32) : bool := Z.even (bits_of_b32 c).

Lemma even_significand : forall c : binary32, is_finite 24 128 c = true -> is_even c = true ->
  exists g : float radix2, value32 c = F2R g /\ canonical radix2 fexp32 g /\ Z.even (Fnum g) = true.
Proof.
  intros c Hc Heven. destruct c as [s|s|s pl H|s m e H]; try discriminate.
  - exists (Float radix2 0 (fexp32 (mag radix2 0))). split; [symmetry; apply F2R_0|]. split; [apply canonical_0|reflexivity].
  - exists (Float radix2 (SpecFloat.cond_Zopp s (Zpos m)) e). split; [reflexivity|]. split.
    + apply (canonical_canonical_mantissa 24 128 s). now destruct (andb_prop _ _ H).
    + cbn [Fnum]. replace (Z.even (SpecFloat.cond_Zopp s (Zpos m))) with (Z.even (Zpos m)) by now destruct s.
      unfold is_even, bits_of_b32, bits_of_binary_float, join_bits in Heven.
      destruct (0 <=? Zpos m - 2 ^ 23)%Z; rewrite Z.shiftl_mul_pow2 in Heven by lia; rewrite Z.even_add, Z.even_mul in Heven;
        change (Z.even (2 ^ 23)) with true in Heven; rewrite orb_true_r in Heven.
      * rewrite Z.even_sub in Heven. change (Z.even (2 ^ 23)) with true in Heven. now destruct (Z.even (Zpos m)).
      * now destruct (Z.even (Zpos m)).
Qed.

(* What the code finds with the two signs: the exact number is below the tie with the number above, and above the tie with the one
   below; or on one of these, where the candidate is even. *)
Theorem accepted_candidate_is_nearest : forall (c : binary32) exact, is_finite 24 128 c = true ->
  let up := (value32 c + succ radix2 fexp32 (value32 c)) / 2 in
  let down := (value32 c + pred radix2 fexp32 (value32 c)) / 2 in
  exact < up \/ exact = up /\ is_even c = true -> down < exact \/ exact = down /\ is_even c = true ->
  nearest32 exact = value32 c.
Proof.
  intros c exact Hc up down Hup Hdown. pose proof (generic_format_B2R 24 128 c) as Hformat.
  destruct (is_even c) eqn:Heven.
  2: { destruct Hup as [Hup|[_ Hno]]; [|discriminate]. destruct Hdown as [Hdown|[_ Hno]]; [|discriminate]. apply Rle_antisym.
       - apply round_N_le_midp; auto with typeclass_instances.
       - apply round_N_ge_midp; auto with typeclass_instances. }
  assert (Hhigh : exact <= up) by lra. assert (Hlow : down <= exact) by lra.
  assert (Hnearest : Rnd_N_pt (generic_format radix2 fexp32) exact (value32 c)).
  { split; [exact Hformat|]. intros other Hother. unfold up, down in *.
    destruct (Rtotal_order (value32 c) other) as [Habove|[->|Hbelow]]; [|apply Rle_refl|].
    - pose proof (succ_le_lt radix2 fexp32 _ _ Hformat Hother Habove) as Hsucc.
      pose proof (Rle_abs (other - exact)). apply Rabs_le. lra.
    - pose proof (pred_ge_gt radix2 fexp32 _ _ Hother Hformat Hbelow) as Hpred.
      pose proof (Rle_abs (- (other - exact))) as Hsize. rewrite Rabs_Ropp in Hsize. apply Rabs_le. lra. }
  assert (Hties : Rnd_NE_pt radix2 fexp32 exact (value32 c)) by (split; [exact Hnearest|left; now apply even_significand]).
  assert (Hround : Rnd_NE_pt radix2 fexp32 exact (nearest32 exact)) by (apply round_NE_pt; auto with typeclass_instances).
  apply Rle_antisym; apply (Rnd_NE_pt_monotone radix2 fexp32 exact exact); try assumption; apply Rle_refl.
Qed.
