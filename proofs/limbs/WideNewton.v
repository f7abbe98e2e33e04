(* SPDX-License-Identifier: BSD-3-Clause *)
(* Quotients and roots on limbs and 64-bit exponents, with every step of Newton's method, give the limbs of what they give on integers. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Operations BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients BigFloatNewton.
From Forceshade Require Import BigFloatNarrowRoot BigFloatNewtonStart BigFloatNewtonLoop BigFloatRight WideNumbers WideRefined WideSums.
Open Scope Z_scope.

Section Refined.
Context (outside : Z -> Z) (count : nat) (enough : (2 <= count <= 64)%nat).
Local Notation width := (64 * Z.of_nat count).
Local Notation limbs_hold := (limbs_hold count).

Lemma holds_tight : forall k j l a, limbs_hold k l a -> - j <= exponent a <= j -> limbs_hold j l a.
Proof. intros k j l a (S & N & _ & R) E. now split. Qed.

Ltac bounded_by H j := apply (held_more count enough _ j) in H; [|lia].

Lemma one_holds : limbs_hold 1074 (wide_one count) (one_of width).
Proof. apply exactly_holds; exact enough. Qed.

(* ---- Newton's method ---- *)

Lemma newton_holds : forall (good : Z -> big -> Prop) k j wide_step step, j <= range ->
  (forall bits l i, 49 <= bits < width -> good bits i -> limbs_hold k l i -> limbs_hold j (wide_step l) (step i)) ->
  (forall bits i, 49 <= bits < width -> good bits i -> good (2 * bits) (truncated width (step i) (2 * bits))) ->
  (forall bits i, 49 <= bits -> good bits i -> - k <= exponent i <= k) ->
  forall fuel bits l i, 49 <= bits <= 8192 -> good bits i -> limbs_hold k l i ->
  limbs_hold k (wide_newton outside count fuel wide_step bits l) (newton_loop fuel step width bits i).
Proof.
  intros good k j wide_step step J S G X. induction fuel as [|fuel IH]; intros bits l i B Gi H; [exact H|].
  cbn [wide_newton newton_loop]. unfold bits_of_all. destruct (Z.ltb_spec bits width) as [L|L]; [|exact H]. exact64.
  pose proof (G bits i ltac:(lia) Gi) as G2. apply IH; [lia|exact G2|].
  apply (holds_tight j); [|apply (X (2 * bits)); [lia|exact G2]].
  apply truncated_holds; [exact enough|now apply (S bits)|numbers64; lia].
Qed.

Lemma inverse_step_holds : forall k l b m i, 8 * k + 40000 <= range -> limbs_hold k l b -> limbs_hold (k + 3) m i ->
  limbs_hold (4 * k + 20000) (wide_inverse_step outside count (wide_midpoint l) m) (inverse_step width b i).
Proof.
  intros k l b m i K Hb Hi. pose proof (holds_positive count enough _ _ _ Hb) as K0.
  pose proof (multiply_holds outside count enough _ _ _ _ _ _ (midpoint_holds count k l b Hb) Hi ltac:(lia)) as H1.
  pose proof (subtract_holds outside count enough _ _ _ _ _ _ one_holds H1 ltac:(lia)) as H2.
  pose proof (multiply_holds outside count enough _ _ _ _ _ _ Hi H2 ltac:(lia)) as H3.
  pose proof (add_holds outside count enough _ _ _ _ _ _ Hi H3 ltac:(lia)) as H4.
  apply (held_more count enough) with (1 := H4). lia.
Qed.

Lemma inverse_holds : forall k l b, 60 * (k + 6000) <= range -> limbs_hold k l b -> is_zero b = false ->
  limbs_hold (k + 3) (wide_inverse outside count l) (newton_inverse width b).
Proof.
  intros k l b K Hb Zb. pose proof (holds_positive count enough _ _ _ Hb) as K0. pose proof Hb as (_ & Nb & Eb & _).
  assert (Fb : fits k (midpoint b)) by (split; [exact Eb|now left]).
  assert (X : forall bits i, 49 <= bits -> good_inverse width b bits i -> - (k + 3) <= exponent i <= k + 3).
  { intros bits i B (Ni & Ei & H). destruct (right_bits_are width bits ltac:(lia) B) as (_ & N & _).
    destruct (inverse_fits width k (midpoint b) i ltac:(lia) ltac:(lia) Nb Zb Fb Ni Ei) as [E _]; [|exact E].
    change (value width (midpoint b)) with (value width b). apply Rle_trans with (1 := H). apply N. }
  destruct (inverse_start_is_good width b ltac:(lia) Nb Zb ltac:(lia)) as (Ns & Es & Hs).
  assert (Gs : good_inverse width b 50 (inverse_start width b)).
  { split; [exact Ns|]. split; [exact Es|]. apply Rle_trans with (1 := Hs). apply bpow_le. unfold right_bits. lia. }
  unfold wide_inverse, newton_inverse, bits_of_all. apply (newton_holds (good_inverse width b) _ (4 * k + 20000)).
  - lia.
  - intros bits m i B G H. apply inverse_step_holds; [lia|exact Hb|exact H].
  - intros bits i B G. exact (inverse_keeps_good width k (midpoint b) bits i ltac:(lia) ltac:(lia) Nb Zb Fb B G).
  - exact X.
  - lia.
  - exact Gs.
  - apply (holds_tight (1074 + Z.abs (- exponent b))); [|apply (X 50); [lia|exact Gs]].
    unfold inverse_start. rewrite (fraction_holds count enough k l b Hb). destruct (parts count enough k l b Hb) as (-> & -> & _). exact64.
    apply scaled_holds; [exact enough|apply exactly_holds; exact enough|lia].
Qed.

Lemma half_exponent_holds : forall k l a, k + 2 <= range -> limbs_hold k l a -> wide_half_exponent outside l = half_exponent a.
Proof.
  intros k l a K H. unfold wide_half_exponent, half_exponent. destruct (parts count enough k l a H) as (_ & -> & _).
  pose proof (holds_positive count enough _ _ _ H). destruct H as (_ & _ & E & _). destruct (Z.leb_spec 0 (exponent a)); [reflexivity|].
  exact64. rewrite Z.quot_div_nonneg by lia. pose proof (Z.div_mod (1 - exponent a) 2 ltac:(lia)).
  pose proof (Z.mod_pos_bound (1 - exponent a) 2 ltac:(lia)). exact64. reflexivity.
Qed.

Lemma inverse_root_step_holds : forall k l a m i, 16 * k + 40000 <= range -> limbs_hold k l a -> limbs_hold (k + 3) m i ->
  limbs_hold (5 * k + 20000) (wide_inverse_root_step outside count (wide_midpoint l) m) (inverse_root_step width a i).
Proof.
  intros k l a m i K Ha Hi. pose proof (holds_positive count enough _ _ _ Ha) as K0.
  pose proof (multiply_holds outside count enough _ _ _ _ _ _ Hi Hi ltac:(lia)) as H0.
  pose proof (multiply_holds outside count enough _ _ _ _ _ _ (midpoint_holds count k l a Ha) H0 ltac:(lia)) as H1.
  pose proof (subtract_holds outside count enough _ _ _ _ _ _ one_holds H1 ltac:(lia)) as H2.
  pose proof (multiply_holds outside count enough _ _ _ _ _ _ Hi H2 ltac:(lia)) as H3.
  pose proof (scaled_holds outside count enough _ _ _ (-1) H3 ltac:(lia)) as H4.
  pose proof (add_holds outside count enough _ _ _ _ _ _ Hi H4 ltac:(lia)) as H5.
  apply (held_more count enough) with (1 := H5). lia.
Qed.

Lemma inverse_root_holds : forall k l a, 60 * (k + 6000) <= range -> limbs_hold k l a -> is_zero a = false -> negative a = false ->
  limbs_hold (k + 3) (wide_inverse_root outside count l) (newton_inverse_root width a).
Proof.
  intros k l a K Ha Za Sa. pose proof (holds_positive count enough _ _ _ Ha) as K0. pose proof Ha as (_ & Na & Ea & _).
  assert (Fa : fits k (midpoint a)) by (split; [exact Ea|now left]).
  pose proof (value_of_positive width a ltac:(lia) Na Za Sa) as PA. pose proof (bpow_gt_0 radix2 (exponent a - 1)) as G0.
  assert (X : forall bits i, 49 <= bits -> good_inverse_root width a bits i -> - (k + 3) <= exponent i <= k + 3).
  { intros bits i B (Ni & Ei & _ & H). destruct (right_bits_are width bits ltac:(lia) B) as (_ & N & _).
    destruct (inverse_root_fits width k (midpoint a) i ltac:(lia) ltac:(lia) Na Za Fa Ni Ei) as [E _]; [|exact E].
    change (value width (midpoint a)) with (value width a). apply Rle_trans with (1 := H). apply N. }
  destruct (inverse_root_start_is_good width a ltac:(lia) Na Za Sa ltac:(lia)) as (Ns & Es & Ps & Hs).
  assert (Gs : good_inverse_root width a 49 (inverse_root_start width a)).
  { split; [exact Ns|]. split; [exact Es|]. split; [exact Ps|]. apply Rle_trans with (1 := Hs). apply bpow_le. unfold right_bits. lia. }
  unfold wide_inverse_root, newton_inverse_root, bits_of_all. cbv zeta. apply (newton_holds (good_inverse_root width a) _ (5 * k + 20000)).
  - lia.
  - intros bits m i B G H. apply inverse_root_step_holds; [lia|exact Ha|exact H].
  - intros bits i B G. refine (inverse_root_keeps_good width k (midpoint a) bits i _ _ Na Za _ Fa B G); [lia|lia|].
    change (value width (midpoint a)) with (value width a). lra.
  - exact X.
  - lia.
  - exact Gs.
  - rewrite (half_exponent_holds k l a ltac:(lia) Ha). pose proof (half_exponent_is a) as Hh.
    assert (Hj : Z.abs (half_exponent a) <= k + 1) by lia.
    apply (holds_tight (1074 + Z.abs (- half_exponent a))); [|apply (X 49); [lia|exact Gs]].
    unfold inverse_root_start. rewrite (fraction_holds count enough k l a Ha). destruct (parts count enough k l a Ha) as (_ & -> & _).
    exact64.
    rewrite int32_is by lia. cbv zeta. apply scaled_holds; [exact enough|apply exactly_holds; exact enough|lia].
Qed.

(* ---- Quotients ---- *)

Lemma divide_holds : forall k j l a m b, limbs_hold k l a -> limbs_hold j m b -> 60 * (Z.max k j + 6000) <= range ->
  limbs_hold (k + j + 3) (wide_divide outside count l m) (divide_newton width a b).
Proof.
  intros k j l a m b Ha Hb J. pose proof (holds_positive count enough _ _ _ Ha) as K0.
  pose proof (holds_positive count enough _ _ _ Hb) as J0.
  set (i := Z.max k j) in *. assert (Ha' : limbs_hold i l a) by (apply (held_more count enough k); [exact Ha|lia]).
  assert (Hb' : limbs_hold i m b) by (apply (held_more count enough j); [exact Hb|lia]).
  unfold wide_divide, divide_newton, divide. cbv zeta. rewrite (wide_may_be_zero_is outside count enough i m b ltac:(lia) Hb').
  rewrite (wide_zero_is count enough i l a Ha'), (wide_exact_zero_is count enough i l a Ha').
  pose proof (parts count enough i l a Ha') as (_ & P2 & P3 & _). pose proof (parts count enough i m b Hb') as (_ & M2 & M3 & _).
  rewrite P2, P3, M2, M3.
  pose proof Ha' as (_ & Na & Ei & Ra). pose proof Hb' as (_ & Nb & Fi & Rb).
  destruct (may_be_zero b) eqn:Mb; [apply (held_more count enough 0); [apply (zero_holds count enough)|lia]|].
  destruct (is_zero a) eqn:Za; [exact64; apply (held_more count enough 0); [apply (zero_holds count enough)|lia]|].
  assert (Zb : is_zero b = false) by now apply orb_false_iff in Mb.
  pose proof (inverse_holds i m b ltac:(lia) Hb' Zb) as Hi. pose proof (midpoint_holds count _ _ _ Ha') as Hd.
  pose proof (midpoint_holds count _ _ _ Hb') as Hv.
  pose proof (midpoint_holds count _ _ _ (multiply_holds outside count enough _ _ _ _ _ _ Hd Hi ltac:(lia))) as H1.
  pose proof (multiply_holds outside count enough _ _ _ _ _ _ H1 Hv ltac:(lia)) as H2.
  pose proof (subtract_holds outside count enough _ _ _ _ _ _ Hd H2 ltac:(lia)) as H3. bounded_by H3 (3 * i + 4105).
  pose proof (multiply_holds outside count enough _ _ _ _ _ _ H3 Hi ltac:(lia)) as H4.
  pose proof (midpoint_holds count _ _ _ (add_holds outside count enough _ _ _ _ _ _ H1 H4 ltac:(lia))) as Hq. bounded_by Hq (4 * i + 8300).
  pose proof (multiply_holds outside count enough _ _ _ _ _ _ Hq Hv ltac:(lia)) as H5.
  pose proof (subtract_holds outside count enough _ _ _ _ _ _ Hd H5 ltac:(lia)) as Hr. bounded_by Hr (5 * i + 12500).
  rewrite (fun K => wide_magnitude_is outside count enough _ _ _ K Hr) by lia.
  destruct (big_quotient_is_right width i (midpoint a) (midpoint b) ltac:(lia) ltac:(lia) Na Nb (conj Ei (or_introl eq_refl))
    (conj Fi (or_introl eq_refl))) as (_ & _ & _ & B).
  assert (Mm : may_be_zero (midpoint b) = false).
  { unfold may_be_zero. change (is_zero (midpoint b)) with (is_zero b). rewrite Zb. cbn [orb error exponent midpoint]. apply Z.ltb_ge.
    numbers64. lia. }
  destruct (B Za Mm) as (_ & X & _). destruct (value_of_quotient width a b (newton_inverse width b) Za Mb Mm) as (_ & V & _).
  change (divide_newton width (midpoint a) (midpoint b)) with (divide width (midpoint a) (midpoint b) (newton_inverse width b)) in X.
  rewrite <- V in X. cbn [exponent midpoint] in X. revert X. unfold divide. rewrite Mb, Za. cbv zeta.
  clear B H1 H2 H3 H4 H5. revert Hr Hq.
  set (rest := subtract width (midpoint a) (multiply width _ (midpoint b))).
  set (wide_rest := wide_subtract outside count (wide_midpoint l) (wide_multiply outside count _ (wide_midpoint m))).
  set (q := midpoint (add width _ _)). set (wide_q := wide_midpoint (wide_add outside count _ _)). intros Hr Hq X.
  assert (R : - range <= magnitude rest - 1 <= range \/ clamped (magnitude rest - 1)).
  { destruct Hr as (_ & _ & E & C). clear - E C J K0 J0. unfold magnitude. destruct (is_zero rest); numbers64; lia. }
  destruct Ha as (_ & _ & Ek & _), Hb as (_ & _ & Ej & _). clearbody rest wide_rest q wide_q. clear Hr Ha' Hb' Hi Hd Hv Na Nb.
  exact64. apply (holds_tight (5 * i + 20000)); [apply with_error_holds; apply (held_more count enough) with (1 := Hq); lia|].
  cbn [exponent with_error] in *. lia.
Qed.

(* ---- Roots ---- *)

Lemma root_holds : forall k l a, limbs_hold k l a -> 60 * (k + 6000) <= range ->
  limbs_hold (k + 2) (wide_square_root outside count l) (square_root_newton width a).
Proof.
  intros k l a Ha K. pose proof (holds_positive count enough _ _ _ Ha) as K0. unfold wide_square_root, square_root_newton, square_root.
  cbv zeta.
  rewrite (wide_may_be_zero_is outside count enough k l a ltac:(lia) Ha), (wide_exact_zero_is count enough k l a Ha).
  pose proof (parts count enough k l a Ha) as (P1 & P2 & P3 & _). rewrite P1, P2, P3. pose proof Ha as (_ & Na & Ea & Ra).
  destruct (is_exact_zero a) eqn:Xa; [apply (held_more count enough k); [exact Ha|lia]|].
  destruct (may_be_zero a || negative a) eqn:Ma.
  { assert (Q : - 2 ^ 62 <= Z.quot (Z.max (exponent a) (error a) + 4) 2 <= 2 ^ 62).
    { destruct (half_is (Z.max (exponent a) (error a))) as [_ Q]. numbers64. lia. }
    exact64. apply (held_more count enough 0); [apply (zero_holds count enough)|lia]. }
  apply orb_false_iff in Ma. destruct Ma as [Ma Sa]. assert (Za : is_zero a = false) by now apply orb_false_iff in Ma.
  pose proof (inverse_root_holds k l a ltac:(lia) Ha Za Sa) as Hi. pose proof (midpoint_holds count _ _ _ Ha) as Hs.
  pose proof (midpoint_holds count _ _ _ (multiply_holds outside count enough _ _ _ _ _ _ Hs Hi ltac:(lia))) as H1.
  pose proof (multiply_holds outside count enough _ _ _ _ _ _ H1 H1 ltac:(lia)) as H2.
  pose proof (subtract_holds outside count enough _ _ _ _ _ _ Hs H2 ltac:(lia)) as H3. bounded_by H3 (5 * k + 4300).
  pose proof (multiply_holds outside count enough _ _ _ _ _ _ H3 Hi ltac:(lia)) as H4.
  pose proof (scaled_holds outside count enough _ _ _ (-1) H4 ltac:(lia)) as H5.
  pose proof (midpoint_holds count _ _ _ (add_holds outside count enough _ _ _ _ _ _ H1 H5 ltac:(lia))) as Hq. bounded_by Hq (6 * k + 8600).
  pose proof (multiply_holds outside count enough _ _ _ _ _ _ Hq Hq ltac:(lia)) as H6.
  pose proof (subtract_holds outside count enough _ _ _ _ _ _ Hs H6 ltac:(lia)) as Hr. bounded_by Hr (12 * k + 22000).
  rewrite (fun K => wide_magnitude_is outside count enough _ _ _ K Hr) by lia.
  destruct (big_root_is_right width k (midpoint a) ltac:(lia) ltac:(lia) Na (conj Ea (or_introl eq_refl))) as (_ & _ & _ & B).
  { cbn [error midpoint]. numbers. unfold boundless. lia. }
  assert (Mm : may_be_zero (midpoint a) = false).
  { unfold may_be_zero. change (is_zero (midpoint a)) with (is_zero a). rewrite Za. cbn [orb error exponent midpoint]. apply Z.ltb_ge.
    numbers64. lia. }
  destruct (B Mm Sa) as (_ & X & _). clear B. revert X. unfold square_root_newton, square_root. rewrite Mm.
  unfold is_exact_zero. change (is_zero (midpoint a)) with (is_zero a). rewrite Za. change (negative (midpoint a)) with (negative a).
  rewrite Sa. cbn [andb orb]. cbv zeta. change (newton_inverse_root width (midpoint a)) with (newton_inverse_root width a).
  change (midpoint (midpoint a)) with (midpoint a). cbn [exponent with_error midpoint]. clear H1 H2 H3 H4 H5 H6 Hi Hs. revert Hr Hq.
  unfold root_of_midpoint. cbv zeta.
  set (rest := subtract width (midpoint a) _).
  set (wide_rest := wide_subtract outside count (wide_midpoint l) _).
  set (q := midpoint (add width _ _)). set (wide_q := wide_midpoint (wide_add outside count _ _)). intros Hr Hq X.
  pose proof (parts count enough _ _ _ Hq) as (_ & -> & _).
  assert (R : - range <= magnitude rest - 1 <= range \/ clamped (magnitude rest - 1)).
  { destruct Hr as (_ & _ & E & C). clear - E C K K0. unfold magnitude. destruct (is_zero rest); numbers64; lia. }
  clearbody rest wide_rest q wide_q. clear Hr Ha Na.
  assert (Eq : - (k + 2) <= exponent q <= k + 2) by lia.
  exact64. apply (holds_tight (6 * k + 20000)); [apply with_error_holds; apply (held_more count enough) with (1 := Hq); lia|exact Eq].
Qed.
End Refined.
