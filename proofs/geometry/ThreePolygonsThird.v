(* SPDX-License-Identifier: BSD-3-Clause *)
(* The face and the top of three polygons and the gaps beside them in the third stage, with numbers of 4096 bits: three_polygons() of
   fast/laws/bump_geometry.h and exact() of fast/laws/bump_3p.h. The gaps may cancel, by as much as the separation of contact leaves. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Evaluate Inputs Polygons TwoPolygonsConstants TwoPolygonsGap ThreePolygons.
From Forceshade Require Import ThreePolygonsFace ThreePolygonsConstants ThreePolygonsEnclosed ThreePolygonsGap.
From Forceshade Require Import BigFloat BigFloatValues BigFloatSums BigFloatQuotients BigFloatNewton BigFloatRight BigFloatTight ThirdAlong.
From Forceshade Require Import TwoPolygonsThird NewtonThirdStage SineThirdStage.
Open Scope R_scope.

Definition twice_big (width : Z) (a : big) : big := multiply width (exactly width (two_to 1)) a.
Definition half_top_big (width : Z) (R : binary32) (t : big) : big := multiply width (exactly width (to64 R)) t.
Definition sine_big (width : Z) (t : big) : big :=
  multiply width (twice_big width t) (square_root_newton width (multiply width (subtract width (one_of width) t)
    (add width (one_of width) t))).
Definition cosine_big (width : Z) (t : big) : big := subtract width (one_of width) (multiply width (twice_big width t) t).
Definition tangent_big (width : Z) (t : big) : big := divide_newton width (sine_big width t) (cosine_big width t).
Definition top_height_big (width : Z) (R : binary32) (t : big) : big :=
  multiply width (twice_big width (half_top_big width R t)) (sine_big width t).

(* ---- The shape ---- *)

Lemma twice_tight : forall k t a x, (1074 <= k <= 100000000000000)%Z -> (-4096 <= t <= -100)%Z -> tight 4096 k t a x ->
  tight 4096 (4 * k + 4100) (Z.max t (-4095) + 3) (twice_big 4096 a) (2 * x).
Proof.
  intros k t a x Hk Ht T. pose proof (two_to_is 1 ltac:(lia)) as I2. change (bpow radix2 1) with 2 in I2.
  pose proof (tight_exactly 4096 t _ _ ltac:(lia) ltac:(numbers; lia) I2) as T2.
  assert (T2' : tight 4096 k t (exactly 4096 (two_to 1)) 2) by (apply tight_more with (1 := T2); [numbers; lia|lia]).
  pose proof (tight_multiply 4096 k t t _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) T2' T) as P.
  apply tight_more with (1 := P); [numbers; lia|lia].
Qed.

(* Sine, cosine and slope of a side, from t. *)
Lemma face_of_sine : forall t x, tight 4096 50000000 (-4036) t x -> / 60000000 <= x <= / 2 ->
  tight 4096 15000000000 (-4015) (sine_big 4096 t) (side_sine x) /\
  tight 4096 15000000000 (-4015) (cosine_big 4096 t) (side_cosine x) /\
  tight 4096 910000000000 (-4009) (tangent_big 4096 t) (side_sine x / side_cosine x).
Proof.
  intros t x T Hx. pose proof (two_to_is 0 ltac:(lia)) as I1. change (bpow radix2 0) with 1 in I1.
  pose proof (tight_exactly 4096 (-4036) _ _ ltac:(lia) ltac:(numbers; lia) I1) as T1. fold (one_of 4096) in T1.
  assert (T1' : tight 4096 50000000 (-4036) (one_of 4096) 1) by (apply tight_more with (1 := T1); [numbers; lia|lia]).
  pose proof (twice_tight 50000000 (-4036) t x ltac:(lia) ltac:(lia) T) as T2.
  destruct (seen_sum 4096 50000000 (-4036) (-4036) 2 3 _ _ _ _ ltac:(lia) ltac:(numbers; lia) T1' (tight_negated _ _ _ _ _ T))
    as (_ & _ & _ & Tm); try lia; try intros _; try (change (bpow radix2 (2 - 2)) with 1; apply Rabs_le; lra).
  { change (bpow radix2 (2 - 3)) with (/ 2). rewrite Rabs_pos_eq; lra. }
  destruct (seen_sum 4096 50000000 (-4036) (-4036) 2 3 _ _ _ _ ltac:(lia) ltac:(numbers; lia) T1' T)
    as (_ & _ & _ & Ts); try lia; try intros _; try (change (bpow radix2 (2 - 2)) with 1; apply Rabs_le; lra).
  { change (bpow radix2 (2 - 3)) with (/ 2). rewrite Rabs_pos_eq; lra. }
  specialize (Tm ltac:(lra)). specialize (Ts ltac:(lra)). change (1 + - x) with (1 - x) in Tm.
  assert (Tm' : tight 4096 51000000 (-4030) (add 4096 (one_of 4096) (negated t)) (1 - x))
    by (apply tight_more with (1 := Tm); [numbers; lia|lia]).
  assert (Ts' : tight 4096 51000000 (-4030) (add 4096 (one_of 4096) t) (1 + x)) by (apply tight_more with (1 := Ts); [numbers; lia|lia]).
  pose proof (tight_multiply 4096 51000000 (-4030) (-4030) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) Tm' Ts') as Tq.
  fold (subtract 4096 (one_of 4096) t) in Tq. set (q := multiply 4096 (subtract 4096 (one_of 4096) t) (add 4096 (one_of 4096) t)) in *.
  assert (Tq' : tight 4096 110000000 (-4027) q ((1 - x) * (1 + x))) by (apply tight_more with (1 := Tq); [numbers; lia|lia]).
  assert (Hq : 0 <= (1 - x) * (1 + x)) by (apply Rmult_le_pos; lra).
  pose proof (tight_root 4096 110000000 (-4027) _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) Tq' Hq) as Tr.
  assert (Tr' : tight 4096 7000000000 (-4023) (square_root_newton 4096 q) (sqrt ((1 - x) * (1 + x))))
    by (apply tight_more with (1 := Tr); [numbers; lia|lia]).
  assert (T2' : tight 4096 7000000000 (-4033) (twice_big 4096 t) (2 * x)) by (apply tight_more with (1 := T2); [numbers; lia|lia]).
  pose proof (tight_multiply 4096 7000000000 (-4033) (-4023) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) T2' Tr') as Es.
  assert (T2'' : tight 4096 3000000000 (-4033) (twice_big 4096 t) (2 * x)) by (apply tight_more with (1 := T2); [numbers; lia|lia]).
  assert (T' : tight 4096 3000000000 (-4036) t x) by (apply tight_more with (1 := T); [numbers; lia|lia]).
  pose proof (tight_multiply 4096 3000000000 (-4033) (-4036) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) T2'' T') as Tx.
  assert (Tx' : tight 4096 10000000000 (-4030) (negated (multiply 4096 (twice_big 4096 t) t)) (- (2 * x * x)))
    by (apply tight_negated; apply tight_more with (1 := Tx); [numbers; lia|lia]).
  assert (T1'' : tight 4096 10000000000 (-4036) (one_of 4096) 1) by (apply tight_more with (1 := T1); [numbers; lia|lia]).
  assert (Hxx : 0 <= x * x <= / 4).
  { split; [apply Rle_0_sqr|]. replace (/ 4) with (/ 2 * / 2) by field. apply Rmult_le_compat; lra. }
  assert (E2 : 2 * x * x = 2 * (x * x)) by ring.
  destruct (seen_sum 4096 10000000000 (-4036) (-4030) 2 3 _ _ _ _ ltac:(lia) ltac:(numbers; lia) T1'' Tx')
    as (_ & _ & _ & Ec); try lia; try intros _; try (change (bpow radix2 (2 - 2)) with 1; apply Rabs_le; lra).
  { change (bpow radix2 (2 - 3)) with (/ 2). rewrite Rabs_pos_eq; lra. }
  specialize (Ec ltac:(lra)).
  assert (As : tight 4096 15000000000 (-4015) (sine_big 4096 t) (side_sine x)) by (apply tight_more with (1 := Es); [numbers; lia|lia]).
  assert (Ac : tight 4096 15000000000 (-4015) (cosine_big 4096 t) (side_cosine x)) by (apply tight_more with (1 := Ec); [numbers; lia|lia]).
  split; [exact As|]. split; [exact Ac|]. destruct (side_sine_range x Hx) as [_ Bc].
  pose proof (tight_divide 4096 15000000000 (-4015) (-4015) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) As Ac
    ltac:(lra)) as Et.
  apply tight_more with (1 := Et); [numbers; lia|lia].
Qed.

Lemma shape_third : forall R w K, parameters R w K -> let t := sine_of_third_big 4096 R w in let slope :=
  slope_3p (value32 R) (value32 w) in
  tight 4096 910000000000 (-4009) (tangent_big 4096 t) slope /\ tight 4096 15000000000 (-4015) (sine_big 4096 t) (sine_of slope) /\
  tight 4096 15000000000 (-4015) (cosine_big 4096 t) (cosine_of slope) /\
  tight 4096 910000000000 (-4009) (top_height_big 4096 R t) (top_height (value32 R) (value32 w)).
Proof.
  intros R w K Hp t slope. pose proof (sine_of_third_is_tight 4096 R w K ltac:(lia) Hp) as T. fold t in T.
  change (60 - 4096)%Z with (-4036)%Z in T.
  pose proof (third_sine_range R w K Hp) as Bx. destruct Hp as ((FR & _) & HR & Hw & _).
  destruct (third_sine_is (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (_ & _ & _ & EH & ET & ES & EC). fold slope in ET, ES, EC.
  set (x := third_sine (value32 R) (value32 w)) in *. destruct (face_of_sine t x T Bx) as (A1 & A2 & A3). rewrite ES, EC, ET, EH.
  split; [exact A3|]. split; [exact A1|]. split; [exact A2|].
  pose proof (tight_exactly 4096 (-4036) _ _ ltac:(lia) ltac:(numbers; lia) (to64_is_exact R FR)) as TR.
  assert (TR' : tight 4096 50000000 (-4036) (exactly 4096 (to64 R)) (value32 R)) by (apply tight_more with (1 := TR); [numbers; lia|lia]).
  pose proof (tight_multiply 4096 50000000 (-4036) (-4036) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) TR' T) as Th.
  assert (Th' : tight 4096 110000000 (-4033) (half_top_big 4096 R t) (value32 R * x)) by (apply tight_more with (1 := Th);
    [numbers; lia|lia]).
  pose proof (twice_tight 110000000 (-4033) _ _ ltac:(lia) ltac:(lia) Th') as T2.
  assert (T2' : tight 4096 15000000000 (-4030) (twice_big 4096 (half_top_big 4096 R t)) (2 * (value32 R * x)))
    by (apply tight_more with (1 := T2); [numbers; lia|lia]).
  pose proof (tight_multiply 4096 15000000000 (-4030) (-4015) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) T2' A1) as Tt.
  apply tight_more with (1 := Tt); [numbers; lia|lia].
Qed.

(* ---- The gaps ---- *)

Definition top_gap_third (R w z : binary32) : big :=
  subtract 4096 (top_height_big 4096 R (sine_of_third_big 4096 R w)) (exactly 4096 (to64 z)).
Definition gap_3p_third (R w x z : binary32) : big :=
  if is_on_flat R w x then top_gap_third R w z else side_gap_big 4096 (tangent_big 4096 (sine_of_third_big 4096 R w)) w x z.

(* m: how many bits the gap is below 2^16, by which the bound grows. *)
Lemma cancelled_bits : forall M, Rabs M <= 20000 -> (M <> 0 -> bpow radix2 (-909) <= Rabs M) ->
  exists m, (2 <= m <= 926)%Z /\ Rabs M <= bpow radix2 (17 - m) /\ (M <> 0 -> bpow radix2 (16 - m) <= Rabs M).
Proof.
  intros M B Sep. destruct (Req_dec M 0) as [->|Hne].
  - exists 2%Z. split; [lia|]. split; [rewrite Rabs_R0; apply bpow_ge_0|]. intro H. now destruct H.
  - specialize (Sep Hne). exists (17 - mag radix2 M)%Z. destruct (mag radix2 M) as [e H]. cbn [mag_val]. specialize (H Hne).
    assert (-909 < e)%Z by (apply (lt_bpow radix2); lra).
    assert (e - 1 < 15)%Z by (apply (lt_bpow radix2); change (bpow radix2 15) with 32768; lra).
    split; [lia|]. replace (17 - (17 - e))%Z with e by ring. replace (16 - (17 - e))%Z with (e - 1)%Z by ring. split; [lra|]. intros _. lra.
Qed.

Theorem gap_3p_third_is : forall R w K x X z Z, parameters R w K -> is_finite 24 128 x = true -> value32 x = X -> coordinate (to64 x) X ->
  coordinate (to64 z) Z -> Rabs X <= value32 w / 2 -> let M := penetration_3p (value32 R) (value32 w) X Z in
  (M <> 0 -> bpow radix2 (-909) <= Rabs M) ->
  exists m, (2 <= m <= 926)%Z /\ Rabs M <= bpow radix2 (17 - m) /\ seen 4096 2800000000000 (m - 4003) (gap_3p_third R w x z) M.
Proof.
  intros R w K x X z Z Hp Fx Vx Cx Cz Hin M Sep. pose proof (coordinate_range _ _ Cz) as BZ. pose proof (Rabs_le_inv _ _ BZ) as BZ2.
  destruct (shape_third R w K Hp) as (Tt & _ & _ & Th). destruct (shape_enclosed R w K Hp) as ([_ BT] & _ & _ & _ & _ & Bh).
  pose proof (Rabs_pos X) as PX. unfold gap_3p_third. rewrite (is_on_flat_is R w K x Hp Fx), Vx.
  unfold M, penetration_3p in *. clear M. rewrite (Rle_bool_true (Rabs X) (value32 w / 2)) in * by exact Hin.
  set (h := top_height (value32 R) (value32 w)) in *. revert Sep. case Rle_bool_spec; intros Htop Sep.
  - destruct (cancelled_bits (h - Z)) as (m & Bm & BM & SepM); [apply Rabs_le; lra|exact Sep|]. exists m. split; [exact Bm|].
    split; [exact BM|].
    pose proof (tight_exactly 4096 (-4009) _ _ ltac:(lia) ltac:(numbers; lia) (coordinate_is _ _ Cz)) as Tz.
    assert (Tz' : tight 4096 910000000000 (-4009) (negated (exactly 4096 (to64 z))) (- Z))
      by (apply tight_negated; apply tight_more with (1 := Tz); [numbers; lia|lia]).
    apply seen_more with (910000000000 + 4096 + 3)%Z (Z.max (Z.max (-4009) (-4009)) (1 - 4096) + m + 3)%Z; [|numbers; lia|lia].
    apply (seen_sum 4096 910000000000 (-4009) (-4009) 16 m); try assumption; try lia; try (numbers; lia);
      change (bpow radix2 (16 - 2)) with 16384; [apply Rabs_le; lra|rewrite Rabs_Ropp; lra].
  - set (b := value32 w / 2 - top_width _ _ / 2) in *. assert (Hb : 0 < b) by (unfold b; lra).
    assert (ES : slope_3p (value32 R) (value32 w) = h / b) by reflexivity. set (S := slope_3p _ _) in *.
    assert (Sb : S * b = h) by (rewrite ES; field; lra).
    replace (h * (value32 w / 2 - Rabs X) / b) with (S * (value32 w / 2 - Rabs X)) in * by (rewrite ES; field; lra).
    assert (BA : 0 <= S * (value32 w / 2 - Rabs X) <= 10000).
    { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with h; [|lra]. rewrite <- Sb. apply Rmult_le_compat_l; [lra|]. unfold b. lra. }
    destruct (cancelled_bits (S * (value32 w / 2 - Rabs X) - Z)) as (m & Bm & BM & SepM); [apply Rabs_le; lra|exact Sep|].
    exists m. split; [exact Bm|]. split; [exact BM|].
    apply seen_more with (3 * 910000000000)%Z (-4009 + m + 6)%Z; [|numbers; lia|lia].
    apply (side_gap_seen 4096 910000000000 (-4009) 16 m R w K); try assumption; try lia; try lra.
    change (bpow radix2 (16 - 2)) with 16384. lra.
Qed.
