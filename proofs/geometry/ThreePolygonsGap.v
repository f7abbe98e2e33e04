(* SPDX-License-Identifier: BSD-3-Clause *)
(* The face and the top of three polygons and the gaps beside them, as the second stage computes them in double-double: three_polygons of
   fast/laws/bump_geometry.h and exact() of fast/laws/bump_3p.h. The gaps may cancel, however far. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs Shaded ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants DoubleDoubleTerms Enclosures.
From Forceshade Require Import EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondStage SecondAlong TwoPolygonsGap.
From Forceshade Require Import ThreePolygons ThreePolygonsFace ThreePolygonsConstants NewtonThird TopEdge ThreePolygonsRight.
From Forceshade Require Import ThreePolygonsEnclosed SineEnclosed.
Open Scope R_scope.

(* ---- The shape ---- *)

(* The height of the top, from t. *)
Lemma top_height_enclosed : forall s R t x, encloses s t x -> 0 <= s <= / 1000000000000000000000 -> / 60000000 <= x <= / 2 ->
  is_finite 24 128 R = true -> / 10 <= value32 R <= 10000 -> / 10000 <= value32 R * x ->
  encloses (1000 * s + 1000 * share101) (top_height_3p R t) (2 * (value32 R * x) * side_sine x) /\ charged (top_height_3p R t).
Proof.
  intros s R t x Et Hs Bx FR BR BRx. pose proof share_is_small as Hsh. destruct (face_3p_enclosed s t x Et Hs Bx) as (Es & _).
  destruct (side_sine_range x Bx) as [Bs _].
  pose proof (encloses_exact _ _ (exactly_is _ _ (to64_is_exact R FR))) as ER.
  pose proof (encloses_exact _ _ (exactly_is _ _ (two_to_is 1 ltac:(lia)))) as E2. change (bpow radix2 1) with 2 in E2.
  assert (Brx : value32 R * x <= 5000) by (apply Rle_trans with (10000 * / 2); [apply Rmult_le_compat; lra|lra]).
  assert (E1 : encloses (3 * (0 + s) + 3 * share101) (half_top_3p R t) (value32 R * x)).
  { apply encloses_multiply; trivial; try lra. right. right. rewrite Rabs_pos_eq; lra. }
  set (h := value32 R * x) in *.
  assert (E3 : encloses (3 * (0 + (3 * (0 + s) + 3 * share101)) + 3 * share101) (twice (half_top_3p R t)) (2 * h)).
  { apply encloses_multiply; trivial; try lra. right. right. rewrite Rabs_pos_eq; lra. }
  pose proof (first_size _ _ _ E3 ltac:(lra)) as S1. pose proof (first_size _ _ _ Es ltac:(lra)) as S2.
  rewrite (Rabs_pos_eq (2 * h)) in S1 by lra. rewrite (Rabs_pos_eq (side_sine x)) in S2 by lra.
  set (b := 3 * (0 + (3 * (0 + s) + 3 * share101)) + 3 * share101) in *. assert (Bb : 0 <= b <= / 1000) by (unfold b; lra).
  set (c := 300 * s + 300 * share101) in *. assert (Bc : 0 <= c <= / 1000) by (unfold c; lra).
  destruct (multiply_encloses b c _ _ _ _ E3 Es ltac:(lra) ltac:(lra)) as (E4 & Ca & _).
  { apply Rle_trans with (b * / 1000); [apply Rmult_le_compat_l; lra|lra]. }
  { right. set (v := Rabs (value64 (hi (twice _)))) in *. set (y := Rabs (value64 (hi (sine_3p_of t)))) in *. split.
    - apply Rle_trans with (/ 100000 * / 1000000000); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with (20000 * 2); [apply Rmult_le_compat; lra|lra]. }
  split; [|exact Ca]. apply encloses_more with (1 := E4). unfold b, c. lra.
Qed.

(* Face and top with their bounds of the error. *)
Lemma shape_enclosed : forall R w K, parameters R w K -> let slope := slope_3p (value32 R) (value32 w) in let t := sine_of_third R w in
  (encloses (/ 1000000000000) (tangent_3p t) slope /\ / 40000000 <= slope <= 2) /\
  (encloses (/ 1000000000000) (sine_3p_of t) (sine_of slope) /\ / 40000000 <= sine_of slope <= 1) /\
  (encloses (/ 1000000000000) (cosine_3p_of t) (cosine_of slope) /\ / 2 <= cosine_of slope <= 1) /\
  (encloses (/ 1000000000000) (top_height_3p R t) (top_height (value32 R) (value32 w)) /\ charged (top_height_3p R t) /\
    / 1000000000000 <= top_height (value32 R) (value32 w) <= 10000).
Proof.
  intros R w K Hp slope t. pose proof share_is_small as Hsh. pose proof (sine_of_third_encloses R w K Hp) as Et. fold t in Et.
  pose proof (third_sine_range R w K Hp) as Bx. destruct Hp as ((FR & _) & HR & Hw & _).
  destruct (third_sine_is (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as ((Hlow & _) & _ & _ & EH & ET & ES & EC).
    fold slope in ET, ES, EC.
  set (x := third_sine (value32 R) (value32 w)) in *. destruct (side_sine_range x Bx) as [Bs Bc].
  assert (BRx : / 10000 <= value32 R * x).
  { apply Rle_trans with (value32 R * (value32 w / (6 * value32 R))); [|apply Rmult_le_compat_l; lra].
    replace (value32 R * (value32 w / (6 * value32 R))) with (value32 w / 6) by (field; lra). lra. }
  assert (Brx : value32 R * x <= 5000) by (apply Rle_trans with (10000 * / 2); [apply Rmult_le_compat; lra|lra]).
  destruct (face_3p_enclosed _ t x Et ltac:(lra) Bx) as (E1 & E2 & E3).
  destruct (top_height_enclosed _ R t x Et ltac:(lra) Bx FR HR BRx) as (E4 & C4).
  rewrite ES, EC, ET, EH. set (h := value32 R * x) in *.
  assert (Bq : side_sine x <= side_sine x / side_cosine x <= 2).
  { split; apply Rmult_le_reg_r with (side_cosine x); try lra; unfold Rdiv; rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra; [|lra].
    rewrite <- (Rmult_1_r (side_sine x)) at 2. apply Rmult_le_compat_l; lra. }
  assert (Bh : / 10000 * / 40000000 <= 2 * h * side_sine x <= 10000).
  { split; [apply Rmult_le_compat; lra|]. apply Rle_trans with (10000 * 1); [apply Rmult_le_compat; lra|lra]. }
  split; [split; [eapply encloses_more; [exact E3|]; lra|lra]|]. split; [split; [eapply encloses_more; [exact E1|]; lra|lra]|].
  split; [split; [eapply encloses_more; [exact E2|]; lra|lra]|]. split; [eapply encloses_more; [exact E4|]; lra|]. split; [exact C4|lra].
Qed.

(* ---- The gaps ---- *)

(* height - z *)
Definition top_gap_3p (R w z : binary32) : double_double := add (top_height_3p R (sine_of_third R w)) (negated (exactly64 (to64 z))).
Definition side_gap_3p (R w x z : binary32) : double_double := side_gap (tangent_3p (sine_of_third R w)) w x z.
(* |x| <= half_top *)
Definition is_on_flat (R w x : binary32) : bool := is_at_most32 (b32_abs x) (largest_on_top R w (half_top_3p R (sine_of_third R w))).

Lemma to64_of_finite : forall c, is_finite 53 1024 (to64 c) = true -> is_finite 24 128 c = true.
Proof. intros [s|s|s pl H|s m e H] F; trivial; discriminate F. Qed.

Lemma at_most_is_decided : forall c x T, is_finite 53 1024 (to64 c) = true ->
  (forall a, in_binary32 a -> (a <= value64 (to64 c) <-> a <= T)) ->
  is_finite 24 128 x = true -> is_at_most32 (b32_abs x) c = Rle_bool (Rabs (value32 x)) T.
Proof.
  intros c x T F64 Dec Fx. pose proof (to64_of_finite c F64) as Fc. destruct (to64_is_exact c Fc) as [Vc _].
  assert (Fa : is_finite 24 128 (b32_abs x) = true) by (unfold b32_abs; now rewrite is_finite_Babs).
  assert (Va : value32 (b32_abs x) = Rabs (value32 x)) by apply B2R_Babs. rewrite (is_at_most32_is_right _ _ Fa Fc), Va.
  assert (Ga : in_binary32 (Rabs (value32 x))) by (apply generic_format_abs, (generic_format_B2R 24 128)).
  specialize (Dec _ Ga). rewrite Vc in Dec. destruct Dec as [D1 D2]. clear - D1 D2. set (a := Rabs (value32 x)) in *.
    set (b := value32 c) in *.
  clearbody a b. destruct (Rle_bool_spec a b) as [H|H]; destruct (Rle_bool_spec a T) as [H'|H']; trivial; exfalso.
  - specialize (D1 H). lra.
  - specialize (D2 H'). lra.
Qed.

(* Coq unfolds these first, and so has nothing to compute where the same number is on both sides. *)
Strategy -10 [top_of is_on_flat].

Lemma is_on_flat_is : forall R w K x, parameters R w K -> is_finite 24 128 x = true ->
  is_on_flat R w x = Rle_bool (Rabs (value32 x)) (top_width (value32 R) (value32 w) / 2).
Proof.
  intros R w K x Hp Fx. destruct (top_is_right R w K Hp) as [F64 Dec]. unfold is_on_flat. unfold top_of in F64, Dec.
  exact (at_most_is_decided (largest_on_top R w (half_top_3p R (sine_of_third R w))) x _ F64 Dec Fx).
Qed.

Lemma top_gap_is_settled : forall R w K z Z, parameters R w K -> coordinate (to64 z) Z ->
  settled (top_gap_3p R w z) (top_height (value32 R) (value32 w) - Z).
Proof.
  intros R w K z Z Hp Cz. destruct (shape_enclosed R w K Hp) as (_ & _ & _ & Eh & Ch & Bh). pose proof (coordinate_range _ _ Cz) as RZ.
  assert (BZ : Z = 0 \/ / 10000000000 <= Rabs Z <= 10000).
  { destruct (coordinate_not_tiny _ _ Cz) as [L|L]; [now left|right]. simpl in L. lra. }
  apply (difference_is_settled _ _ _ _ _ Eh ltac:(lra) Ch (exactly_is _ _ (coordinate_is _ _ Cz)) ltac:(right; lra) BZ). lra.
Qed.

Lemma side_gap_3p_is_settled : forall R w K x X z Z, parameters R w K -> is_finite 24 128 x = true -> value32 x = X ->
  coordinate (to64 x) X -> coordinate (to64 z) Z -> Rabs X <= value32 w / 2 -> top_width (value32 R) (value32 w) / 2 < Rabs X ->
  settled (side_gap_3p R w x z)
    (top_height (value32 R) (value32 w) * (value32 w / 2 - Rabs X) / (value32 w / 2 - top_width (value32 R) (value32 w) / 2) - Z).
Proof.
  intros R w K x X z Z Hp Fx Vx Cx Cz Hin Hside. destruct (shape_enclosed R w K Hp) as ([Et Bt] & _ & _ & _ & _ & Bh).
  set (h := top_height _ _) in *. set (b := value32 w / 2 - top_width _ _ / 2). assert (Hb : 0 < b) by (unfold b; lra).
  assert (ES : slope_3p (value32 R) (value32 w) = h / b) by reflexivity. set (S := slope_3p _ _) in *.
  assert (Sb : S * b = h) by (rewrite ES; field; lra).
  replace (h * (value32 w / 2 - Rabs X) / b) with (S * (value32 w / 2 - Rabs X)) by (rewrite ES; field; lra).
  apply (side_gap_is_settled R w K (/ 1000000000000)); trivial; [lra|]. apply Rle_trans with h; [|lra]. rewrite <- Sb.
  apply Rmult_le_compat_l; [lra|]. unfold b. lra.
Qed.

(* On the bump, on its top and beside it. *)
Theorem gap_3p_is_settled : forall R w K x X z Z, parameters R w K -> is_finite 24 128 x = true -> value32 x = X ->
  coordinate (to64 x) X -> coordinate (to64 z) Z -> Rabs X <= value32 w / 2 ->
  settled (if is_on_flat R w x then top_gap_3p R w z else side_gap_3p R w x z) (penetration_3p (value32 R) (value32 w) X Z).
Proof.
  intros R w K x X z Z Hp Fx Vx Cx Cz Hin. rewrite (is_on_flat_is R w K x Hp Fx), Vx. unfold penetration_3p.
  rewrite (Rle_bool_true (Rabs X) (value32 w / 2)) by exact Hin. case Rle_bool_spec; intro Htop.
  - now apply (top_gap_is_settled R w K).
  - now apply (side_gap_3p_is_settled R w K).
Qed.
