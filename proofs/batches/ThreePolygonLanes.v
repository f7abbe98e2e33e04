(* SPDX-License-Identifier: BSD-3-Clause *)
(* The forms of a batch of bump-3p and bump-3p-shaded: what the watch lets pass is right, for all inputs of the domain. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Mult_error BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Shaded Gap Polygons ErrorFree.
From Forceshade Require Import ThreePolygons DoubleDouble Depth Split DoubleDoubleHolds CylinderConstants SecondAlong.
From Forceshade Require Import TwoPolygonsConstants ThreePolygonsFace ThreePolygonsConstants TopEdge NewtonThird SineOfThird.
From Forceshade Require Import ThreePolygonsRight CylinderFirst.
From Forceshade Require Import Lanes RecordedForms LaneAnswers BumpLanes Batch PolygonLanes.
Import ListNotations.
Open Scope R_scope.

(* It is unfolded before numbers of binary32 are. *)
Local Strategy -10 [top_of].

(* The last binary32 on the top, T, is next to w'/2, which is at most half of w/2. *)
Lemma top_is_near : forall R w K, parameters R w K -> let t := top_width (value32 R) (value32 w) / 2 in
  exists T32 T, top_of R w = to64 T32 /\ is32 T32 T /\ is64 (top_of R w) T /\ T <= t <= T + / 8388608 * T /\
    / 8192 <= T /\ value32 w / 6 <= t <= value32 w / 2 / 2 /\ (forall a, in_binary32 a -> (a <= T <-> a <= t)).
Proof.
  intros R w K Hp t. destruct (top_is_right R w K Hp) as [Fin Dec]. fold t in Dec. unfold top_of in *.
  set (T32 := largest_on_top _ _ _) in *. clearbody T32.
  assert (F32 : is_finite 24 128 T32 = true) by (destruct T32; try discriminate Fin; reflexivity).
  destruct (to64_is_exact T32 F32) as [V F]. rewrite V in Dec. set (T := value32 T32) in *.
  pose proof Hp as (_ & HR & Hw & _). destruct (third_sine_is (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as ((L & U) & Root & E & _).
  fold t in E. set (s := third_sine _ _) in *. clearbody s.
  assert (Lt : value32 w / 6 <= t).
  { rewrite E. apply Rle_trans with (value32 R * (value32 w / (6 * value32 R))); [right; field; lra|apply Rmult_le_compat_l; lra]. }
  assert (s0 : 0 < s) by (apply Rlt_le_trans with (2 := L); apply Rdiv_lt_0_compat; lra).
  assert (Ut : t <= value32 w / 2 / 2).
  { assert (Ew : value32 w = 2 * value32 R * (3 * s - 4 * (s * s * s))).
    { replace (3 * s - 4 * (s * s * s)) with (value32 w / (2 * value32 R)) by lra. field. lra. }
    assert (S3 : s * s * s <= / 4 * s).
    { apply Rmult_le_compat_r; [lra|]. replace (/ 4) with (/ 2 * / 2) by field. apply Rmult_le_compat; lra. }
    rewrite E. replace (value32 w / 2 / 2) with (value32 R * ((3 * s - 4 * (s * s * s)) / 2)) by (rewrite Ew; field).
    apply Rmult_le_compat_l; lra. }
  assert (G : in_binary32 T) by apply (generic_format_B2R 24 128).
  assert (HT : T <= t) by (apply Dec; [exact G|apply Rle_refl]).
  assert (LT : / 8192 <= T).
  { change (/ 8192) with (bpow radix2 (-13)). apply Dec; [apply generic_format_bpow; unfold FLT_exp; lia|]. simpl. lra. }
  assert (UT : t < succ radix2 fexp32 T).
  { apply Rnot_le_lt. intro H. apply Dec in H; [|now apply generic_format_succ; auto with typeclass_instances].
    pose proof (succ_gt_id radix2 fexp32 T ltac:(lra)). lra. }
  rewrite succ_eq_pos in UT by lra.
  assert (Ulp : ulp radix2 fexp32 T <= / 8388608 * T).
  { pose proof (ulp_FLT_le radix2 (-149) 24 T) as Q. rewrite (Rabs_pos_eq T) in Q by lra.
    rewrite Rmult_comm. change (/ 8388608) with (bpow radix2 (1 - 24)). apply Q. apply Rle_trans with (2 := LT). simpl. lra. }
  exists T32, T. split; [reflexivity|]. split; [now split|]. split; [now split|]. split; [lra|]. split; [exact LT|]. split; [lra|exact Dec].
Qed.

Notation top_tail_form side_slope top_height top_height_tail distance :=
  (over (plus (fused (opp side_slope) distance top_height) top_height_tail) distance) (only parsing).

(* On the top the form takes slope (w/2 - T), and h' less that from the tail. *)
Lemma top_height_at : forall top_h top_ht h ht s st H S C c t T half distance, linear top_h top_ht zero64 zero64 H 0 ->
  linear h ht s st C S -> C = S * c -> H = S * (c - t) -> is64 half c -> / 2000 <= c <= 10000 -> 0 < T -> T <= t <= T + / 8388608 * T ->
  t <= c / 2 -> is64 distance (c - T) -> height_at s (top_tail_form s top_h top_ht distance) distance (value64 h) H.
Proof.
  intros top_h top_ht h ht s st H S C c t T half distance [(Fth & Ftt & _) _ Rth Rtt Rte _ _ _]
    [(Fh & Fht & Fs & Fst) Bits Rh Rht Rhe Rs Rst Rse] EC EH Ic Hc HT Ht Htc Id.
  set (x := value64 s) in *. set (y := value64 top_h) in *. set (z := value64 top_ht) in *. set (hv := value64 h) in *. set (D := c - T)
    in *.
  assert (HD : c / 2 <= D <= c) by (unfold D; lra). pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Hti.
  assert (scaled : forall b q l, Rabs b <= l * x -> 0 <= q -> Rabs (b * q) <= l * (x * q)).
  { intros b q l Hb Hq. rewrite Rabs_mult, (Rabs_pos_eq q) by exact Hq. rewrite <- Rmult_assoc. now apply Rmult_le_compat_r. }
  set (e := S - (x + value64 st)) in *.
  pose proof (scaled _ c _ Rst ltac:(lra)) as Tc. pose proof (scaled _ D _ Rst ltac:(lra)) as Td.
  pose proof (scaled _ c _ Rse ltac:(lra)) as Ec. pose proof (scaled _ D _ Rse ltac:(lra)) as Ed. fold e in Ec, Ed.
  assert (Pc : 0 <= x * c) by (apply Rmult_le_pos; lra). assert (Pd : 0 <= x * D) by (apply Rmult_le_pos; lra).
  assert (Pcd : x * D <= x * c) by (apply Rmult_le_compat_l; lra).
  assert (E1 : C = x * c + value64 st * c + e * c) by (rewrite EC; unfold e; ring).
  assert (HS : 0 <= S).
  { apply Rabs_le_inv in Rst. apply Rabs_le_inv in Rse. unfold e, tail_share, slope_share in *. lra. }
  assert (ST : Rabs (S * (T - t)) <= / 16777216 * C).
  { rewrite Rabs_mult, (Rabs_pos_eq S), (Rabs_left1 (T - t)) by lra. rewrite EC.
    replace (/ 16777216 * (S * c)) with (S * (/ 16777216 * c)) by ring. apply Rmult_le_compat_l; [exact HS|]. lra. }
  assert (E2 : H - x * D = value64 st * D + e * D + S * (T - t)) by (rewrite EH; unfold e, D; ring).
  apply Rabs_le_inv in Rht. apply Rabs_le_inv in Rhe. pose proof (Rabs_le_inv _ _ Tc) as Tc'. pose proof (Rabs_le_inv _ _ Ec) as Ec'.
  pose proof (Rabs_le_inv _ _ Td) as Td'. pose proof (Rabs_le_inv _ _ Ed) as Ed'. pose proof (Rabs_le_inv _ _ ST) as ST'.
  assert (Bp : x * c <= 1000001 / 1000000 * hv) by (unfold tail_share, slope_share, height_share, unit53 in *; lra).
  assert (BC : 0 <= C <= 1000001 / 1000000 * hv) by (unfold tail_share, slope_share, height_share, unit53 in *; lra).
  set (E := H - x * D) in *. assert (BE : Rabs E <= 104 / 100 / 16777216 * hv).
  { apply Rabs_le. unfold tail_share, slope_share in *. lra. }
  assert (HC : 0 <= H <= C).
  { rewrite EH, EC. split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_l; lra]. }
  apply Rabs_le_inv in Rtt. apply Rabs_le_inv in Rte.
  assert (By : y <= 1001 / 1000 * hv) by (unfold unit53, height_share in *; lra).
  assert (big : forall a, Rabs a <= 100000000 -> Rabs a <= bpow radix2 1000).
  { intros a Ha. apply Rle_trans with (bpow radix2 30); [simpl; lra|apply bpow_le; lia]. }
  assert (Is : is64 s x) by now split. assert (Iy : is64 top_h y) by now split. assert (Iz : is64 top_ht z) by now split.
  (* the fused difference *)
  pose proof (Rabs_le_inv _ _ BE) as BE'.
  set (F0 := y - x * D). assert (B0 : Rabs F0 <= 105 / 100 / 16777216 * hv).
  { replace F0 with (E - (H - y)) by (unfold F0, E; ring). apply Rabs_le. unfold unit53, height_share in *. lra. }
  assert (If : is64 (fused (opp s) distance top_h) (nearest64 F0)).
  { replace F0 with (- x * D + y) by (unfold F0; ring). apply fused_is; [now apply opp_is|exact Id|exact Iy|]. apply big.
    replace (- x * D + y) with F0 by (unfold F0; ring). lra. }
  pose proof (product_is_close F0) as E0. set (f := nearest64 F0) in *.
  (* with the tail of h' *)
  assert (Bf : Rabs f <= 106 / 100 / 16777216 * hv).
  { pose proof (Rabs_triang_inv f F0) as Q. unfold unit53 in *. lra. }
  set (A0 := f + z). assert (BA : Rabs A0 <= 107 / 100 / 16777216 * hv).
  { apply Rabs_le_inv in Bf. unfold A0. apply Rabs_le. unfold unit53 in *. lra. }
  assert (Ia : is64 (plus (fused (opp s) distance top_h) top_ht) (nearest64 A0)).
  { apply plus_is; try assumption. apply big. fold A0. lra. }
  pose proof (product_is_close A0) as Ea. set (a := nearest64 A0) in *.
  assert (Ba : Rabs a <= 108 / 100 / 16777216 * hv).
  { pose proof (Rabs_triang_inv a A0) as Q. unfold unit53 in *. lra. }
  (* the quotient *)
  assert (Bq : Rabs (a / D) <= 4000 * Rabs a).
  { unfold Rdiv. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq D), Rmult_comm by lra. apply Rmult_le_compat_r; [apply Rabs_pos|].
    replace 4000 with (/ (/ 4000)) by field. apply Rinv_le; lra. }
  assert (Ig : is64 (top_tail_form s top_h top_ht distance) (nearest64 (a / D))).
  { apply over_is; try assumption; [lra|]. apply big. lra. }
  pose proof (product_is_close (a / D)) as Eg. set (g := nearest64 (a / D)) in *.
  assert (GD : Rabs (g * D - a) <= unit53 * Rabs a + 10000 * tiny).
  { replace (g * D - a) with ((g - a / D) * D) by (field; lra). rewrite Rabs_mult, (Rabs_pos_eq D) by lra.
    apply Rle_trans with ((unit53 * Rabs (a / D) + tiny) * D); [apply Rmult_le_compat_r; lra|].
    rewrite Rmult_plus_distr_r. apply Rplus_le_compat; [|rewrite Rmult_comm; apply Rmult_le_compat_r; lra].
    rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|]. rewrite <- (Rabs_pos_eq D) at 2 by lra. rewrite <- Rabs_mult.
    right. f_equal. field. lra. }
  exists x, g, D. split; [exact Is|]. split; [exact Ig|]. split; [exact Id|]. split; [exact Rh|]. split; [lra|]. split; [lra|].
  assert (Err : Rabs (g * D - E) <= / 2097152 * unit53 * hv).
  { replace (g * D - E) with ((g * D - a) + (a - A0) + (f - F0) + (y + z - H)) by (unfold A0, F0, E; ring).
    pose proof (Rabs_le_inv _ _ GD) as Q1. pose proof (Rabs_le_inv _ _ Ea) as Q2. pose proof (Rabs_le_inv _ _ E0) as Q3.
    apply Rabs_le. unfold unit53, height_share in *. lra. }
  split.
  - pose proof (Rabs_le_inv _ _ Err) as Q. apply Rabs_le. unfold unit53 in *. lra.
  - replace (H - (x * D + g * D)) with (- (g * D - E)) by (unfold E; ring). now rewrite Rabs_Ropp.
Qed.

Lemma larger32_is : forall a b x y, is32 a x -> is32 b y -> is32 (larger32 a b) (Rmax x y).
Proof.
  intros a b x y [<- Fa] [<- Fb]. unfold larger32. rewrite less32_is by assumption. unfold Rmax.
  case Rlt_bool_spec; intro H; destruct (Rle_dec (value32 a) (value32 b)); try lra; split; try reflexivity; try assumption.
Qed.

(* The depth below the bump over its face, as the forms compute it. *)
Lemma depth_of_3p : forall R w K x z, parameters R w K -> in_range x ->
  coordinate (to64 x) (value32 x) -> coordinate (to64 z) (value32 z) -> Rabs (value32 x) <= value32 w / 2 ->
  Rabs (value32 x) = 0 \/ (bpow radix2 (-30) <= Rabs (value32 x) /\ bpow radix2 (-28) * (value32 w / 2) <= Rabs (value32 x)) ->
  let t := sine_of_third R w in let s := split_head (tangent_3p t) in let half := half_width w in let top := top_of R w in
  let ax := absolute32 x in let on_top := is_at_most (to64 ax) top in
  let tail := if on_top then top_tail_form s (hi (top_height_3p R t)) (lo (top_height_3p R t)) (minus half top)
              else split_tail (tangent_3p t) in
  let gap := gap_form s tail (minus half (to64 (larger32 ax (to32 top)))) (to64 z) in
  let on := Rle_bool (Rabs (value32 x)) (top_width (value32 R) (value32 w) / 2) in
  on_top = on /\ is_less32 (to32 top) ax = negb on /\
  (is_near (times (two_to (-20)) (hi (side_height_3p w t))) gap = false ->
   depth_is (7 / 2) (larger gap zero64)
    ((if on then top_height (value32 R) (value32 w)
      else top_height (value32 R) (value32 w) * (value32 w / 2 - Rabs (value32 x)) / (value32 w / 2 - top_width (value32 R) (value32 w) /
        2))
     - value32 z)).
Proof.
  intros R w K x z Hp Hx Cx Cz Hin Tx t s half top ax on_top tail gap on.
  pose proof (shape_3p_is_right R w K t top Hp (sine_of_third_is R w K Hp) (top_is_right R w K Hp)) as [Lt Ls _ _].
  destruct (top_is_near R w K Hp) as (T32 & T & ET & I32 & IT & HT & LT & Htc & Dec). fold top in ET, IT.
  pose proof (half_width_is _ _ _ Hp) as Ic. destruct (half_is _ _ _ Hp) as [Gc _]. fold half in Ic.
  pose proof (size_coordinate x Hx Cx) as Cs. destruct (absolute32_is x _ (conj eq_refl (proj1 Hx))) as [Va Fa]. fold ax in Cs, Va, Fa.
  pose proof Hp as (_ & HR & Hw & _). set (c := value32 w / 2) in *. set (tt := top_width (value32 R) (value32 w) / 2) in *.
  set (X := Rabs (value32 x)) in *. assert (Hc : / 2000 <= c <= 10000) by (unfold c; lra). assert (X0 : 0 <= X) by apply Rabs_pos.
  assert (GT : in_binary32 T) by (destruct I32 as [<- _]; apply (generic_format_B2R 24 128)).
  assert (Eon : Rle_bool X T = on).
  { unfold on. pose proof (Dec X (coordinate_format _ _ Cs)) as D. case Rle_bool_spec; case Rle_bool_spec; intros H1 H2; try reflexivity;
      exfalso; apply D in H2 || apply D in H1; lra. }
  assert (IT2 : is32 (to32 top) T).
  { apply to32_exact; [exact IT|exact GT|]. rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 14);
      [simpl; lra|apply bpow_le; lia]. }
  assert (E1 : on_top = on) by (unfold on_top; rewrite (at_most_is _ _ _ _ (coordinate_is _ _ Cs) IT); exact Eon).
  split; [exact E1|]. split.
  { rewrite (less32_is _ _ (proj2 IT2) Fa), (proj1 IT2), Va. fold X. rewrite <- Eon. unfold Rlt_bool, Rle_bool.
    rewrite (Rcompare_sym X T). now destruct (Rcompare T X). }
  intro W. pose proof (linear_height _ _ _ _ _ _ Ls) as Rh.
  assert (Ih : is64 (hi (side_height_3p w t)) (value64 (hi (side_height_3p w t)))) by (split; [reflexivity|apply Ls]).
  pose proof (larger32_is ax (to32 top) X T (conj Va Fa) IT2) as Im.
  destruct (to64_is_exact _ (proj2 Im)) as [Vm Fm]. rewrite (proj1 Im) in Vm. set (m := to64 (larger32 ax (to32 top))) in *.
  assert (Edist : forall a, is64 m a -> in_binary32 a -> 0 <= a <= c ->
    a = 0 \/ (bpow radix2 (-30) <= a /\ bpow radix2 (-28) * c <= a) -> is64 (minus half m) (c - a)).
  { intros a Ha Ga Ra Sa. apply distance_is; try assumption. lra. }
  assert (EH : top_height (value32 R) (value32 w) = slope_3p (value32 R) (value32 w) * (c - tt)).
  { unfold slope_3p. fold c tt. field. lra. }
  assert (HA : height_at s tail (minus half m) (value64 (hi (side_height_3p w t)))
    (if on then top_height (value32 R) (value32 w) else top_height (value32 R) (value32 w) * (c - X) / (c - tt))).
  { unfold tail. rewrite E1. destruct (Rle_bool_spec X T) as [H|H]; rewrite <- Eon in *; clear Eon.
    - assert (Vm2 : is64 m T) by (split; [rewrite Vm; now apply Rmax_right|exact Fm]).
      assert (D1 : is64 (minus half m) (c - T)).
      { apply Edist; try assumption; [lra|right]. simpl. lra. }
      assert (D2 : is64 (minus half top) (c - T)).
      { apply distance_is; try assumption; [lra|lra|right]. simpl. lra. }
      destruct (top_height_at _ _ _ _ _ _ _ _ _ c tt T half (minus half top) Lt Ls eq_refl EH Ic Hc ltac:(lra) HT ltac:(lra) D2)
        as (a & b & d & A1 & A2 & A3 & A4).
      exists a, b, d. split; [exact A1|]. split; [exact A2|]. split; [|exact A4].
      assert (d = c - T) by (rewrite <- (proj1 A3); apply D2). subst d. exact D1.
    - assert (Vm2 : is64 m X) by (split; [rewrite Vm; apply Rmax_left; lra|exact Fm]).
      replace (top_height (value32 R) (value32 w) * (c - X) / (c - tt)) with
        (slope_3p (value32 R) (value32 w) * c - slope_3p (value32 R) (value32 w) * X) by (rewrite EH; field; lra).
      apply side_height_at with (lo (side_height_3p w t)) c; try assumption; try reflexivity; [apply Cs|lra|lra]. }
  exact (depth_form_is s tail (minus half m) _ _ _ (to64 z) (value32 z) HA Ih Cz W).
Qed.

Lemma factor_is_positive : forall v K e, factor v (K * e) -> 0 <= e -> 0 < e.
Proof.
  intros v K e (_ & _ & [S _]) He. destruct He as [He|He]; [exact He|]. rewrite <- He, Rmult_0_r, Rabs_R0 in S.
  pose proof (bpow_gt_0 radix2 (-50)). lra.
Qed.

Lemma normal_is_not_negative : forall S, 0 <= S -> 0 <= sine_of S /\ 0 <= cosine_of S.
Proof.
  intros S H. assert (0 < sqrt (1 + Rsqr S)) by (apply sqrt_lt_R0; pose proof (Rle_0_sqr S); lra).
  unfold sine_of, cosine_of. split; (apply Rmult_le_pos; [lra|apply Rlt_le; now apply Rinv_0_lt_compat]).
Qed.

Theorem bump_3p_lane_is_right : forall set R w K x z, parameters R w K ->
  right_where_free set (form_of_bump_3p R w K x z) (exact_bump_3p (value32 R) (value32 w) (value32 K)) x z.
Proof.
  intros set R w K x z Hp H. destruct (factors_3p_are_right R w K (sine_of_third R w) Hp (sine_of_third_is R w K Hp)) as [Hs Hc].
  pose proof (shape_3p_is_right R w K _ _ Hp (sine_of_third_is R w K Hp) (top_is_right R w K Hp)) as [_ L _ _].
  destruct (free_lane _ _ H) as (A & B & C & _ & E). clear H.
  unfold form_of_bump_3p, with_gaps, with_gap, bump_3p_form in *. cbv zeta in *. revert A B C E. lane_fields. intros A B C E.
  destruct (watched_coordinates set R w K x z Hp A B) as (Hx & Hz & Cx & Cz & Ex & Ez & Tz & Tx).
  split; [exact Hx|]. split; [exact Hz|]. rewrite Ex, Ez.
  cbv zeta. unfold exact_bump_3p. cbn [force in_contact exact_x exact_z]. change (to32 zero64) with zero32.
  pose proof Hp as (_ & HR & Hw & HK).
  pose proof (E _ (or_introl eq_refl)) as E1. pose proof (E _ (or_intror (or_introl eq_refl))) as E2.
  pose proof (C _ (or_introl eq_refl)) as C1. clear A B C E.
  pose proof (depth_of_3p R w K x z Hp Hx Cx Cz) as D. cbv zeta in D.
  assert (HS : 0 <= slope_3p (value32 R) (value32 w)).
  { destruct L as [_ _ _ _ _ Rs Rst Rse]. apply Rabs_le_inv in Rst. apply Rabs_le_inv in Rse. unfold tail_share, slope_share in *. lra. }
  destruct (normal_is_not_negative _ HS) as [S0 C0]. pose proof (factor_is_positive _ _ _ Hs S0) as S1.
  pose proof (factor_is_positive _ _ _ Hc C0) as Co1. unfold penetration_3p, slope_at.
  set (on := Rle_bool (Rabs (value32 x)) (top_width (value32 R) (value32 w) / 2)) in *.
  assert (Hon : is_at_most (to64 (absolute32 x)) (top_of R w) = on /\ is_less32 (to32 (top_of R w)) (absolute32 x) = negb on).
  { destruct (top_is_near R w K Hp) as (T32 & T & _ & _ & IT & _ & LT & Htc & Dec). pose proof (size_coordinate x Hx Cx) as Cs.
    assert (IT2 : is32 (to32 (top_of R w)) T).
    { assert (GT : in_binary32 T).
      { destruct (top_is_near R w K Hp) as (T32' & T' & _ & I32 & IT' & _). assert (T = T') by (rewrite <- (proj1 IT); apply IT'). subst T'.
        destruct I32 as [<- _]. apply (generic_format_B2R 24 128). }
      apply to32_exact; [exact IT|exact GT|]. assert (T <= top_width (value32 R) (value32 w) / 2) by (apply Dec; [exact GT|apply Rle_refl]).
      rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 14); [simpl; lra|apply bpow_le; lia]. }
    assert (Eon : Rle_bool (Rabs (value32 x)) T = on).
    { unfold on. pose proof (Dec _ (coordinate_format _ _ Cs)) as Q. case Rle_bool_spec; case Rle_bool_spec; intros H1 H2; try reflexivity;
        exfalso; apply Q in H2 || apply Q in H1; lra. }
    destruct (absolute32_is x _ (conj eq_refl (proj1 Hx))) as [Va Fa]. split.
    - rewrite (at_most_is _ _ _ _ (coordinate_is _ _ Cs) IT). exact Eon.
    - rewrite (less32_is _ _ (proj2 IT2) Fa), (proj1 IT2), Va, <- Eon. unfold Rlt_bool, Rle_bool.
      rewrite (Rcompare_sym (Rabs (value32 x)) T). now destruct (Rcompare T _). }
  destruct Hon as [On Off]. rewrite On, Off in *.
  assert (Flat : sine_of 0 = 0 /\ cosine_of 0 = 1) by exact flat.
  apply sides_lane with (R := R) (M := (if on then top_height (value32 R) (value32 w)
      else top_height (value32 R) (value32 w) * (value32 w / 2 - Rabs (value32 x)) / (value32 w / 2 - top_width (value32 R) (value32 w) /
        2))
     - value32 z) (n := 101 / 100) (leans := negb on); try assumption; try reflexivity; try lra.
  - intro Hin. destruct (D Hin Tx) as (_ & _ & D3). exact (D3 C1).
  - destruct on.
    + rewrite (proj2 Flat), Rmult_1_r. apply computes_more with 0 (-50)%Z 10%Z; try lia; [now apply stiffness_computes with R w|lra].
    + now apply factor_computes.
  - destruct on; [rewrite (proj2 Flat); lra|exact Co1].
  - exists (value32 K * sine_of (slope_3p (value32 R) (value32 w))). split; [exact Hs|]. split; [apply Rmult_lt_0_compat; lra|].
    destruct on; [discriminate|reflexivity].
  - destruct on; [right; apply Flat|now left].
Qed.

Theorem bump_3p_shaded_lane_is_right : forall set R w K x z, parameters R w K ->
  right_where_free set (form_of_bump_3p_shaded R w K x z) (exact_bump_3p_shaded (value32 R) (value32 w) (value32 K)) x z.
Proof.
  intros set R w K x z Hp H. destruct (free_lane _ _ H) as (A & B & C & _ & E). clear H.
  unfold form_of_bump_3p_shaded, with_gaps, with_gap, bump_3p_shaded_form in *. cbv zeta in *. revert A B C E. lane_fields. intros A B C E.
  destruct (watched_coordinates set R w K x z Hp A B) as (Hx & Hz & Cx & Cz & Ex & Ez & Tz & Tx).
  split; [exact Hx|]. split; [exact Hz|]. rewrite Ex, Ez.
  cbv zeta. unfold exact_bump_3p_shaded. cbn [force in_contact exact_x exact_z]. change (to32 zero64) with zero32.
  pose proof Hp as (_ & HR & Hw & HK). assert (H1 : 1 <= one <= 1001 / 1000) by (unfold one; lra).
  pose proof (E _ (or_introl eq_refl)) as E1. pose proof (E _ (or_intror (or_introl eq_refl))) as E2.
  pose proof (C _ (or_introl eq_refl)) as C1. clear A B C E.
  pose proof (depth_of_3p R w K x z Hp Hx Cx Cz) as D. cbv zeta in D.
  refine (shaded_lane 12 (7 / 2) R w K x z _ _ (penetration_3p (value32 R) (value32 w) (value32 x) (value32 z)) Hp ltac:(lia) Hx Hz Cx Tz
    ltac:(lra) ltac:(lra) E1 E2 _ eq_refl).
  intro Hin. destruct (D Hin Tx) as (_ & _ & D3). exact (D3 C1).
Qed.
