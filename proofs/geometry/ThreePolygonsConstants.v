(* SPDX-License-Identifier: BSD-3-Clause *)
(* What the laws bump-3p and bump-3p-shaded hold of their geometry, as double-double computes it from t = sin(alpha / 3):
   three_polygons of fast/laws/bump_geometry.h, three_polygon_gap of fast/laws/polygon_gap.h and the constructor of
   fast/laws/bump_3p.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Shaded Gap Polygons.
From Forceshade Require Import DoubleDouble Depth Split DoubleDoubleNear DoubleDoubleHolds TwoPolygonsConstants.
From Forceshade Require Import ThreePolygons ThreePolygonsFace.
Open Scope R_scope.

Definition one64 : binary64 := two_to 0.
Definition twice (a : double_double) : double_double := multiply (exactly64 (two_to 1)) a.
Definition half_top_3p (R : binary32) (t : double_double) : double_double := multiply (exactly64 (to64 R)) t.
Definition sine_3p_of (t : double_double) : double_double :=
  multiply (twice t) (root_of (multiply (add (exactly64 one64) (negated t)) (add (exactly64 one64) t))).
Definition cosine_3p_of (t : double_double) : double_double := add (exactly64 one64) (negated (multiply (twice t) t)).
Definition tangent_3p (t : double_double) : double_double := divide (sine_3p_of t) (cosine_3p_of t).
Definition top_height_3p (R : binary32) (t : double_double) : double_double := multiply (twice (half_top_3p R t)) (sine_3p_of t).
Definition side_height_3p (w : binary32) (t : double_double) : double_double := multiply (tangent_3p t) (exactly64 (half_width w)).

(* How good t has to be. *)
Definition is_third_sine (R w : binary32) (t : double_double) : Prop := holds 70 (/ 10000) t (third_sine (value32 R) (value32 w)).

Lemma one_is : is64 one64 1.
Proof. change 1 with (bpow radix2 0). apply two_to_is. lia. Qed.

Lemma twice_holds : forall n s t x, holds n s t x -> 0 <= n <= 400 -> 0 <= s <= / 10 -> / 100000000 <= x <= 50000 ->
  holds (n + 8) (3 * s + / 1000000) (twice t) (2 * x).
Proof.
  intros n s t x H Hn Hs Hx. pose proof (two_to_is 1 ltac:(lia)) as I. change (bpow radix2 1) with 2 in I.
  pose proof (holds_multiply _ _ _ _ _ _ _ _ (holds_exactly _ _ I ltac:(lra)) H ltac:(lra) Hn ltac:(lra) Hs ltac:(lra) ltac:(lra)
    ltac:(lra)) as M.
  apply (holds_more _ _ _ _ _ _ M); lra.
Qed.

Lemma face_3p_holds : forall t x, holds 70 (/ 10000) t x -> / 60000000 <= x <= / 2 ->
  holds 180 (/ 50) (sine_3p_of t) (side_sine x) /\ holds 170 (/ 100) (cosine_3p_of t) (side_cosine x) /\
  173 / 100 * x <= side_sine x <= 867 / 1000 /\ / 2 <= side_cosine x <= 1.
Proof.
  intros t x Ht Hx. pose proof (twice_holds _ _ _ _ Ht ltac:(lra) ltac:(lra) ltac:(lra)) as H2.
  pose proof (holds_add _ _ _ _ _ _ one_is Ht ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as Hp.
  pose proof (holds_subtract _ _ _ _ _ _ one_is Ht ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as Hm.
  assert (Hxx : 0 <= x * x <= / 4).
  { split; [apply Rle_0_sqr|]. replace (/ 4) with (/ 2 * / 2) by field. apply Rmult_le_compat; lra. }
  assert (Hq : 75 / 100 <= (1 - x) * (1 + x) <= 1) by (replace ((1 - x) * (1 + x)) with (1 - x * x) by ring; lra).
  pose proof (holds_multiply _ _ _ _ _ _ _ _ Hm Hp ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as
    Hq2.
  pose proof (holds_root _ _ _ _ Hq2 ltac:(lra) ltac:(lra) ltac:(lra)) as Hr.
  set (q := (1 - x) * (1 + x)) in *. set (r := sqrt q) in *. assert (Hr2 : r * r = q) by (apply sqrt_sqrt; lra).
  assert (Hr0 : 0 <= r) by apply sqrt_pos. assert (Br : 866 / 1000 <= r <= 1) by (clear -Hr2 Hq Hr0; split; nra).
  assert (Bs : 173 / 100 * x <= side_sine x <= 867 / 1000).
  { unfold side_sine. fold q r. replace (2 * x * r) with (2 * (x * r)) by ring.
    assert (Hxr : (x * r) * (x * r) <= 1876 / 10000).
    { replace ((x * r) * (x * r)) with (x * x * (r * r)) by ring. rewrite Hr2. replace q with (1 - x * x) by (unfold q; ring).
      clear -Hxx. nra. }
    assert (H0 : x * (865 / 1000) <= x * r) by (apply Rmult_le_compat_l; lra).
    split; [lra|]. set (v := x * r) in *. clear -Hxr H0 Hx. nra. }
  assert (Bc : / 2 <= side_cosine x <= 1) by (unfold side_cosine; replace (2 * x * x) with (2 * (x * x)) by ring; lra).
  split; [|split; [|split; assumption]].
  - unfold side_sine in *. fold q r in Bs |- *.
    apply (holds_more _ _ _ _ _ _ (holds_multiply _ _ _ _ _ _ _ _ H2 Hr ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)
      ltac:(lra) ltac:(lra))); lra.
  - unfold side_cosine in *. set (p := 2 * x * x) in *.
    assert (Hp0 : 0 < p <= / 2) by (split; [unfold p; apply Rmult_lt_0_compat; lra|lra]).
    pose proof (holds_multiply _ _ _ _ _ _ _ _ H2 Ht ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(fold p;
      lra)) as HH.
    fold p in HH. apply (holds_more _ _ _ _ _ _ (holds_subtract _ _ _ _ _ _ one_is HH ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)));
      lra.
Qed.

(* The two terms of a height, as linear requires them. *)
Lemma height_of : forall n s a H, holds n s a H -> 0 <= n <= 400 -> / 130000000000 <= H <= 17900 ->
  is_finite 53 1024 (hi a) = true /\ is_finite 53 1024 (lo a) = true /\ / 137438953472 <= value64 (hi a) <= 18000 /\
  Rabs (value64 (lo a)) <= unit53 * value64 (hi a) /\ Rabs (H - (value64 (hi a) + value64 (lo a))) <= height_share * value64 (hi a).
Proof.
  intros n s a H Ha Hn HH. destruct (holds_close _ _ _ _ Ha Hn ltac:(lra)) as (y & z & _ & [-> F1] & [-> F2] & _ & _ & Bz & C & R).
  split; [exact F1|]. split; [exact F2|]. split; [lra|]. split; [exact Bz|]. rewrite Rabs_minus_sym. apply Rle_trans with (1 := C).
  apply Rle_trans with (404 * (unit53 * unit53) * H).
  - apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_r; [unfold unit53; lra|lra].
  - unfold height_share, unit53 in *. lra.
Qed.

Lemma slope_of : forall n s a S, holds n s a S -> 0 <= n <= 400 -> / 100000000 <= S <= 2 ->
  is_finite 53 1024 (split_head a) = true /\ is_finite 53 1024 (split_tail a) = true /\
  generic_format radix2 (FLT_exp (-149) 29) (value64 (split_head a)) /\ 0 <= value64 (split_head a) <= 10001 /\
  Rabs (value64 (split_tail a)) <= tail_share * value64 (split_head a) /\
  Rabs (S - (value64 (split_head a) + value64 (split_tail a))) <= slope_share * value64 (split_head a).
Proof.
  intros n s a S Ha Hn HS. destruct (holds_close _ _ _ _ Ha Hn ltac:(lra)) as (y & z & _ & Y & Z & _ & _ & Bz & C & R).
  destruct (split_is _ y z Y Z (low_part _ _ Bz ltac:(lra)) ltac:(lra) ltac:(right; lra)) as (p & q & [-> Fp] & [-> Fq] & Gp & Cp & Tq
    & Cq).
  assert (C' : Rabs (y + z - S) <= 404 * (unit53 * unit53) * S).
  { apply Rle_trans with (1 := C). apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_r; [unfold unit53; lra|lra]. }
  clear C. split; [exact Fp|]. split; [exact Fq|]. split; [exact Gp|]. absolute_values.
  split; [lra|]. split; apply Rabs_le; unfold slope_share, unit53 in *; lra.
Qed.

(* half_top as the comparisons of binary32 numbers need it. *)
Definition decides_top (R w : binary32) (half_top : binary64) : Prop :=
  is_finite 53 1024 half_top = true /\
  forall a, in_binary32 a -> (a <= value64 half_top <-> a <= top_width (value32 R) (value32 w) / 2).

(* It is so where the polynomial of fast/laws/top_edge.h is not negative at half_top, but at the next binary32 number. *)
Theorem top_is_decided : forall R w K half_top, parameters R w K -> is_finite 53 1024 half_top = true ->
  let h := value64 half_top in let next := succ radix2 fexp32 h in
  in_binary32 h -> 0 <= h -> is_on_top (value32 R) (value32 w) h -> ~ is_on_top (value32 R) (value32 w) next -> decides_top R w
    half_top.
Proof.
  intros R w K half_top (_ & HR & Hw & _) Fin h next Gh Hh Hon Hnot. split; [exact Fin|]. fold h.
  destruct (third_sine_is (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (_ & _ & E & _). rewrite E.
  assert (Hn : h <= next) by (apply succ_ge_id; auto with typeclass_instances).
  rewrite is_on_top_is_right in Hon by lra. rewrite is_on_top_is_right in Hnot by lra.
  intros a Ga. split; intro Ha; [lra|]. destruct (Rle_or_lt a h) as [H|H]; [exact H|exfalso].
  apply Hnot. apply Rle_trans with a; [|exact Ha]. apply succ_le_lt; auto with typeclass_instances.
Qed.

Lemma third_sine_range : forall R w K, parameters R w K -> / 60000000 <= third_sine (value32 R) (value32 w) <= / 2.
Proof.
  intros R w K (_ & HR & Hw & _). destruct (third_sine_is (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as ((H1 & H2) & _).
  split; [|exact H2]. apply Rle_trans with (2 := H1). apply Rmult_le_reg_r with (6 * value32 R); [lra|].
  replace (value32 w / (6 * value32 R) * (6 * value32 R)) with (value32 w) by (field; lra). lra.
Qed.

Theorem shape_3p_is_right : forall R w K t half_top, parameters R w K -> is_third_sine R w t -> decides_top R w half_top ->
  shape_3p R w (hi (top_height_3p R t)) (lo (top_height_3p R t)) (hi (side_height_3p w t)) (lo (side_height_3p w t))
    (split_head (tangent_3p t)) (split_tail (tangent_3p t)) half_top.
Proof.
  intros R w K t half_top Hp Ht [Fin Dec]. pose proof (third_sine_range _ _ _ Hp) as Hx. pose proof (half_holds _ _ _ Hp) as Hh.
  destruct (face_3p_holds _ _ Ht Hx) as (Hs & Hc & Bs & Bc). destruct Hp as ((FR & _ & _) & HR & Hw & _).
  pose proof (to64_is_exact R FR) as IR.
  destruct (third_sine_is (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as ((Hlow & _) & _ & _ & E1 & E2 & _ & _).
  unfold is_third_sine in Ht. set (x := third_sine _ _) in *. set (ss := side_sine x) in *. set (cc := side_cosine x) in *.
  assert (HRx : value32 w / 6 <= value32 R * x).
  { apply Rmult_le_reg_r with (/ value32 R); [apply Rinv_0_lt_compat; lra|].
    replace (value32 R * x * / value32 R) with x by (field; lra).
    replace (value32 w / 6 * / value32 R) with (value32 w / (6 * value32 R)) by (field; lra). exact Hlow. }
  set (W := value32 w) in *. set (r := value32 R) in *.
  assert (HRx2 : r * x <= r * / 2) by (apply Rmult_le_compat_l; lra).
  (* the top *)
  pose proof (holds_multiply _ _ _ _ _ _ _ _ (holds_exactly _ _ IR ltac:(fold r; lra)) Ht ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)
    ltac:(fold r; lra) ltac:(lra) ltac:(fold r; lra)) as M1. fold r in M1.
  pose proof (twice_holds _ _ _ _ M1 ltac:(lra) ltac:(lra) ltac:(lra)) as M2.
  set (b := r * x) in *.
  assert (Hbs : b * (173 / 100 * x) <= b * ss <= b * 1) by (split; apply Rmult_le_compat_l; lra).
  assert (Hbx : W / 6 * / 60000000 <= b * x) by (apply Rmult_le_compat; lra).
  pose proof (holds_multiply _ _ _ _ _ _ _ _ M2 Hs ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as M3.
  destruct (height_of _ _ _ _ M3 ltac:(lra) ltac:(lra)) as (F1 & F2 & T1 & T2 & T3).
  (* the sides *)
  assert (Hq : ss <= ss / cc <= 2 * ss).
  { split; apply Rmult_le_reg_r with cc; try lra; replace (ss / cc * cc) with ss by (field; lra).
    - rewrite <- (Rmult_1_r ss) at 2. apply Rmult_le_compat_l; lra.
    - apply Rle_trans with (2 * ss * / 2); [lra|]. apply Rmult_le_compat_l; lra. }
  pose proof (holds_divide _ _ _ _ _ _ _ _ Hs Hc ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as M4.
  set (T := ss / cc) in *.
  destruct (slope_of _ _ _ _ M4 ltac:(lra) ltac:(lra)) as (G1 & G2 & G3 & G4 & G5 & G6).
  assert (HTW : / 40000000 * (W / 2) <= T * (W / 2) <= 1734 / 1000 * (W / 2)) by (split; apply Rmult_le_compat_r; lra).
  assert (HTl : / 40000000 * / 2000 <= T * (W / 2)) by (apply Rmult_le_compat; lra).
  pose proof (holds_multiply _ _ _ _ _ _ _ _ M4 Hh ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as M5.
  destruct (height_of _ _ _ _ M5 ltac:(lra) ltac:(lra)) as (F3 & F4 & T4 & T5 & T6).
  split; [| |exact Fin|exact Dec].
  - fold r W. rewrite E1. split; try assumption.
    + repeat split; assumption || reflexivity.
    + apply generic_format_0.
    + simpl. lra.
    + simpl. rewrite Rabs_R0. lra.
    + simpl. replace (0 - (0 + 0)) with 0 by ring. rewrite Rabs_R0. lra.
  - fold r W. rewrite E2. split; try assumption. repeat split; assumption.
Qed.

Theorem factors_3p_are_right : forall R w K t, parameters R w K -> is_third_sine R w t ->
  factors_3p R w K (K_times K (sine_3p_of t)) (K_times K (cosine_3p_of t)).
Proof.
  intros R w K t Hp Ht. pose proof (third_sine_range _ _ _ Hp) as Hx. destruct (face_3p_holds _ _ Ht Hx) as (Hs & Hc & Bs & Bc).
  pose proof Hp as (_ & HR & Hw & _).
  destruct (third_sine_is (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (_ & _ & _ & _ & _ & E1 & E2).
  split; [rewrite E1|rewrite E2].
  - apply (K_times_is R w K 180 (/ 50)); assumption || lra.
  - apply (K_times_is R w K 170 (/ 100)); assumption || lra.
Qed.

(* ---- The first stages ---- *)

Definition bump_3p_of (R w K : binary32) (t : double_double) (half_top : binary64) (is_fused : bool) :
  binary64 -> binary64 -> FirstStage :=
  bump_3p is_fused (hi (top_height_3p R t)) (lo (top_height_3p R t)) (hi (side_height_3p w t)) (lo (side_height_3p w t))
    (split_head (tangent_3p t)) (split_tail (tangent_3p t)) (to64 K) (K_times K (sine_3p_of t)) (K_times K (cosine_3p_of t))
    (half_width w) half_top.

Definition bump_3p_shaded_of (R w K : binary32) (t : double_double) (half_top : binary64) (is_fused : bool) :
  binary64 -> binary64 -> FirstStage :=
  bump_3p_shaded is_fused (hi (top_height_3p R t)) (lo (top_height_3p R t)) (hi (side_height_3p w t)) (lo (side_height_3p w t))
    (split_head (tangent_3p t)) (split_tail (tangent_3p t)) (to64 R) (K_over_R K R) (half_width w) half_top.

(* Every answer of the first stage of bump-3p is right, for every input of the domain, given t and half_top alone. *)
Theorem bump_3p_first_stage_answers_right_given_t : forall is_fused R w K t half_top later x y z,
  parameters R w K -> is_third_sine R w t -> decides_top R w half_top -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_3p (value32 R) (value32 w) X Z in
  let S := slope_at (value32 R) (value32 w) X in
  right_or_later (evaluate bump_3p_window (bump_3p_of R w K t half_top is_fused) later x y z)
    (later (quantised x) (quantised z)) (0 < M)
    (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros is_fused R w K t half_top later x y z Hp Ht Hh Hv. apply bump_3p_first_stage_answers_right; try assumption.
  - now apply shape_3p_is_right with K.
  - now apply factors_3p_are_right.
Qed.

Theorem bump_3p_shaded_first_stage_answers_right_given_t : forall is_fused R w K t half_top later x y z,
  parameters R w K -> is_third_sine R w t -> decides_top R w half_top -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_3p (value32 R) (value32 w) X Z in
  right_or_later (evaluate bump_3p_shaded_window (bump_3p_shaded_of R w K t half_top is_fused) later x y z)
    (later (quantised x) (quantised z)) (0 < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros is_fused R w K t half_top later x y z Hp Ht Hh Hv. apply bump_3p_shaded_first_stage_answers_right; try assumption.
  now apply shape_3p_is_right with K.
Qed.
