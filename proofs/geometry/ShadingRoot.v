(* SPDX-License-Identifier: BSD-3-Clause *)
(* The root of (R - x)(R + x), the z-component of a shaded normal times R, in double-double: fast/laws/outcome.h. It may be 0. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts
  EnclosedQuotients.
From Forceshade Require Import BesideTie SecondStage SecondAlong Separation.
Open Scope R_scope.

(* x is on the circle, or a little off it. *)
Lemma inside_of_circle : forall R w K xv X, parameters R w K -> coordinate xv X -> Rabs X <= value32 R ->
  value32 R - X = 0 \/ / 1000000000 <= value32 R - X.
Proof.
  intros R w K xv X Hp Hx HX. pose proof (multiple_of_radius _ _ _ Hp) as MR. destruct Hp as (_ & HR & _). apply Rabs_le_inv in HX.
  destruct (Rle_lt_dec X (value32 R / 2)) as [H|H]; [right; lra|]. destruct (Req_dec (value32 R - X) 0) as [|Hne]; [now left|right].
  assert (MX : multiple 28 X).
  { apply (multiple_of_binary32 (-5)); [lia|exact (coordinate_format _ _ Hx)|]. rewrite Rabs_pos_eq by lra. simpl. lra. }
  assert (M : multiple 28 (value32 R - X)) by multiple. pose proof (multiple_not_0 _ _ M Hne) as D. rewrite Rabs_pos_eq in D by lra.
  simpl in D. lra.
Qed.

Lemma coordinate_opp : forall xv X, coordinate xv X -> coordinate (opp xv) (- X).
Proof.
  intros xv X [H F B S]. split; [now apply opp_is|now apply generic_format_opp|now rewrite Rabs_Ropp|].
  destruct S as [->|S]; [left; ring|right]. unfold size in *. now rewrite Rabs_Ropp.
Qed.

Lemma shading_root_enclosed : forall R w K xv X, parameters R w K -> coordinate xv X -> Rabs X <= value32 R ->
  let radius := exactly64 (to64 R) in let P := (value32 R - X) * (value32 R + X) in
  encloses (66 * share101) (root_of (multiply (add radius (negated (exactly64 xv))) (add radius (exactly64 xv)))) (sqrt P) /\
  (sqrt P = 0 \/ / 1000000 <= sqrt P <= 10000).
Proof.
  intros R w K xv X Hp Hx HX radius P. pose proof share_is_small as Hsh.
  pose proof (inside_of_circle R w K _ X Hp Hx HX) as Low. pose proof (inside_of_circle R w K _ (- X) Hp (coordinate_opp _ _ Hx) ltac:(now
    rewrite Rabs_Ropp)) as High.
  replace (value32 R - - X) with (value32 R + X) in High by ring.
  destruct Hp as ((FR & _) & HR & _). destruct Hx as [Ix _ Bx _]. pose proof (Rabs_le_inv _ _ HX) as HX2.
  assert (IR : is_exactly radius (value32 R)) by (apply exactly_is; now apply to64_is_exact).
  assert (IX : is_exactly (exactly64 xv) X) by now apply exactly_is.
  pose proof (encloses_sum _ _ _ _ IR (negated_is _ _ IX) ltac:(rewrite Rabs_pos_eq; lra) ltac:(rewrite Rabs_Ropp; lra) ltac:(lra)) as E1.
  pose proof (encloses_sum _ _ _ _ IR IX ltac:(rewrite Rabs_pos_eq; lra) ltac:(lra) ltac:(lra)) as E2.
  change (value32 R + - X) with (value32 R - X) in E1.
  assert (BP : P = 0 \/ / 100000000000 <= P <= 100000000).
  { destruct Low as [Low|Low]; [left; unfold P; rewrite Low; ring|]. destruct High as [High|High]; [left; unfold P; rewrite High;
    ring|right].
    split.
    - unfold P. destruct (Rle_lt_dec 0 X).
      + apply Rle_trans with (/ 1000000000 * / 10); [lra|apply Rmult_le_compat; lra].
      + apply Rle_trans with (/ 10 * / 1000000000); [lra|apply Rmult_le_compat; lra].
    - replace P with (value32 R * value32 R - X * X) by (unfold P; ring). pose proof (Rle_0_sqr X) as S. unfold Rsqr in S.
      assert (value32 R * value32 R <= 10000 * 10000) by (apply Rmult_le_compat; lra). lra. }
  pose proof (encloses_multiply _ _ _ _ _ _ E1 E2 ltac:(lra) ltac:(lra)) as E3. fold P in E3.
  assert (E3' : encloses (3 * (3 * share101 + 3 * share101) + 3 * share101) (multiply (add radius (negated (exactly64 xv))) (add radius
    (exactly64 xv))) P).
  { apply E3. destruct BP as [BP|BP]; [|right; right; rewrite Rabs_pos_eq; lra]. unfold P in BP. apply Rmult_integral in BP. tauto. }
  split.
  - apply encloses_more with (3 * (3 * (3 * share101 + 3 * share101) + 3 * share101) + 3 * share101); [|lra].
    apply encloses_root; [exact E3'|lra|]. destruct BP as [BP|BP]; [now left|right; lra].
  - destruct BP as [->|BP]; [left; apply sqrt_0|right]. split.
    + replace (/ 1000000) with (sqrt (/ 1000000 * / 1000000)) by (apply sqrt_square; lra). apply sqrt_le_1_alt. lra.
    + replace 10000 with (sqrt (10000 * 10000)) by (apply sqrt_square; lra). apply sqrt_le_1_alt. lra.
Qed.
