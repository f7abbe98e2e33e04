(* SPDX-License-Identifier: BSD-3-Clause *)
(* The face of three polygons with its bounds of the error, from t = sin(alpha / 3) with its own: three_polygons of
   fast/laws/bump_geometry.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms ThreePolygonsFace
  ThreePolygonsConstants.
From Forceshade Require Import Enclosures EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondAlong.
Open Scope R_scope.

(* A difference of which at least a third remains. *)
Theorem encloses_subtract : forall s t a b x y, encloses s a x -> encloses t b y -> 0 <= s <= / 1000 -> 0 <= t <= / 1000 ->
  / 10000000000000000000000000 <= x <= 10000 -> / 10000000000000000000000000 <= y <= 10000 -> / 1000 <= Rabs (x - y) ->
  x <= 3 * Rabs (x - y) -> y <= 3 * Rabs (x - y) -> encloses (7 * (s + t) + 3 * share101) (add a (negated b)) (x - y).
Proof.
  intros s t a b x y Ea Eb Hs Ht Hx Hy Low Bx By. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  pose proof share_is_small as Hsh.
  pose proof (difference_of_two_contains s t a b x y Ea Eb Hs Ht ltac:(right; rewrite Rabs_pos_eq; lra) ltac:(right;
    rewrite Rabs_pos_eq; lra))
    as (h & l & g & H & L & G & Bl & Hg & B & Bh).
  destruct Ea as (h1 & l1 & e & H1 & L1 & E1 & Bl1 & Be & B1), Eb as (c & k & f & H2 & L2 & E2 & Bk & Bf & B2).
  pose proof (first_is_positive _ _ _ _ _ Bl1 Be B1 Hs ltac:(lra)) as S1.
    pose proof (first_is_positive _ _ _ _ _ Bk Bf B2 Ht ltac:(lra)) as S2.
  rewrite (Rabs_pos_eq h1) in Be by lra. rewrite (Rabs_pos_eq c) in Bf by lra.
  pose proof (size_by (x - y) (h + l)) as SD. rewrite (Rabs_minus_sym (x - y)) in SD.
  pose proof (minus_size x y) as BD. rewrite (Rabs_pos_eq x), (Rabs_pos_eq y) in BD by lra. set (D := Rabs (x - y)) in *.
  assert (Be2 : e <= s * (303 / 100 * D)) by (apply Rle_trans with (1 := proj2 Be); apply Rmult_le_compat_l; lra).
  assert (Bf2 : f <= t * (303 / 100 * D)) by (apply Rle_trans with (1 := proj2 Bf); apply Rmult_le_compat_l; lra).
  assert (BsD : 0 <= s * D <= / 1000 * D) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (BtD : 0 <= t * D <= / 1000 * D) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  destruct (plus_close _ _ _ _ E1 E2 ltac:(rewrite !Rabs_pos_eq; lra)) as [I C]. rewrite (Rabs_pos_eq (e + f)) in C by lra.
  pose proof (unit_times (e + f) ltac:(lra)) as Uef. pose proof (proj1 (rounded_up (e + f) (e + f) ltac:(lra))) as N1.
  set (r := nearest64 (e + f)) in *. apply Rabs_le_inv in C.
  destruct (error_of_is (hi (add a (negated b))) h _ r (1001 / 1000 * (e + f)) H I ltac:(lra) ltac:(lra) ltac:(lra)) as (g' & G' & Bg & _).
  change (error_of (hi (add a (negated b))) (plus (error a) (error b))) with (error (add a (negated b))) in G'.
  rewrite (is64_same _ _ _ G' G) in Bg. clear g' G'.
  pose proof (unit_times _ (Rabs_pos h)) as Uh. pose proof (Rabs_triang h l) as T.
  assert (Bsh : 0 <= share101 * Rabs h <= / 1000000 * Rabs h).
  { split; [apply Rmult_le_pos; [lra|apply Rabs_pos]|apply Rmult_le_compat_r; [apply Rabs_pos|lra]]. }
  assert (Low2 : 98 / 100 * D <= Rabs h) by lra.
  assert (sh : s * (98 / 100 * D) <= s * Rabs h) by (apply Rmult_le_compat_l; lra).
  assert (th : t * (98 / 100 * D) <= t * Rabs h) by (apply Rmult_le_compat_l; lra).
  assert (Htn : tiny <= / 100 * (share101 * Rabs h)).
  { apply Rle_trans with (/ 100 * (share101 * / 10000)); [unfold share101; lra|].
    apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat_l; lra. }
  exists h, l, g. repeat (split; [assumption|]). split; [|exact B]. split; [exact Hg|]. lra.
Qed.

Lemma side_sine_range : forall x, / 60000000 <= x <= / 2 -> 15 / 10 * x <= side_sine x <= 1 /\ / 2 <= side_cosine x <= 1.
Proof.
  intros x Hx. assert (Hxx : 0 <= x * x <= / 4).
  { split; [apply Rle_0_sqr|]. replace (/ 4) with (/ 2 * / 2) by field. apply Rmult_le_compat; lra. }
  split; [|unfold side_cosine; replace (2 * x * x) with (2 * (x * x)) by ring; lra].
  unfold side_sine. assert (Hq : 75 / 100 <= (1 - x) * (1 + x) <= 1) by (replace ((1 - x) * (1 + x)) with (1 - x * x) by ring; lra).
  set (q := (1 - x) * (1 + x)) in *. assert (Br : 75 / 100 <= sqrt q <= 1).
  { split; [|rewrite <- sqrt_1; apply sqrt_le_1_alt; lra].
    replace (75 / 100) with (sqrt (75 / 100 * (75 / 100))) by (apply sqrt_square; lra). apply sqrt_le_1_alt. lra. }
  set (r := sqrt q) in *. assert (2 * x * (75 / 100) <= 2 * x * r) by (apply Rmult_le_compat_l; lra).
  assert (2 * x * r <= 2 * x * 1) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(* Sine, cosine and slope of a side, from t. *)
Theorem face_3p_enclosed : forall s t x, encloses s t x -> 0 <= s <= / 1000000000000000000000 -> / 60000000 <= x <= / 2 ->
  encloses (300 * s + 300 * share101) (sine_3p_of t) (side_sine x) /\
  encloses (100 * s + 100 * share101) (cosine_3p_of t) (side_cosine x) /\
  encloses (1300 * s + 1300 * share101) (tangent_3p t) (side_sine x / side_cosine x).
Proof.
  intros s t x Et Hs Hx. pose proof share_is_small as Hsh. pose proof (encloses_exact _ _ (exactly_is _ _ one_is)) as E1.
  pose proof (encloses_exact _ _ (exactly_is _ _ (two_to_is 1 ltac:(lia)))) as E2. change (bpow radix2 1) with 2 in E2.
  assert (Ett : encloses (3 * (0 + s) + 3 * share101) (twice t) (2 * x)).
  { apply encloses_multiply; trivial; try lra. right. right. rewrite Rabs_pos_eq; lra. }
  assert (Em : encloses (7 * (0 + s) + 3 * share101) (add (exactly64 one64) (negated t)) (1 - x)).
  { apply encloses_subtract; trivial; rewrite ?Rabs_pos_eq; lra. }
  assert (Ep : encloses (3 * (0 + s) + 3 * share101) (add (exactly64 one64) t) (1 + x)) by (apply encloses_add; trivial; lra).
  assert (Hxx : 0 <= x * x <= / 4).
  { split; [apply Rle_0_sqr|]. replace (/ 4) with (/ 2 * / 2) by field. apply Rmult_le_compat; lra. }
  assert (Lxx : / 60000000 * / 60000000 <= x * x) by (apply Rmult_le_compat; lra).
  assert (Hq : 75 / 100 <= (1 - x) * (1 + x) <= 1) by (replace ((1 - x) * (1 + x)) with (1 - x * x) by ring; lra).
  pose proof (encloses_multiply _ _ _ _ _ _ Em Ep ltac:(lra) ltac:(lra) ltac:(right; right; rewrite Rabs_pos_eq; lra)) as Eq.
  pose proof (encloses_root _ _ _ Eq ltac:(lra) ltac:(lra)) as Er. set (q := (1 - x) * (1 + x)) in *.
  destruct (side_sine_range x Hx) as [Bs Bc].
  assert (Es : encloses (300 * s + 300 * share101) (sine_3p_of t) (side_sine x)).
  { eapply encloses_more; [apply (encloses_multiply _ _ _ _ _ _ Ett Er); [lra|lra|]|lra].
    right. right. fold (side_sine x). unfold side_sine in Bs. fold q in Bs. rewrite Rabs_pos_eq; lra. }
  assert (Ex2 : encloses (3 * ((3 * (0 + s) + 3 * share101) + s) + 3 * share101) (multiply (twice t) t) (2 * x * x)).
  { apply encloses_multiply; trivial; try lra. right. right. replace (2 * x * x) with (2 * (x * x)) by ring. rewrite Rabs_pos_eq; lra. }
  assert (Ec : encloses (100 * s + 100 * share101) (cosine_3p_of t) (side_cosine x)).
  { eapply encloses_more; [apply (encloses_subtract _ _ _ _ _ _ E1 Ex2); try lra; replace (2 * x * x) with (2 * (x * x)) by ring;
      rewrite ?Rabs_pos_eq; lra|lra]. }
  split; [exact Es|]. split; [exact Ec|]. eapply encloses_more; [apply (encloses_divide _ _ _ _ _ _ Es Ec); try lra|lra].
  - right. rewrite Rabs_pos_eq; lra.
  - rewrite Rabs_pos_eq; lra.
  - assert (Q : 0 <= side_sine x / side_cosine x <= 2).
    { split; [apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]|]. apply Rmult_le_reg_r with (side_cosine x); [lra|].
      unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. lra. }
    rewrite Rabs_pos_eq; lra.
Qed.
