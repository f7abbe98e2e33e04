(* SPDX-License-Identifier: BSD-3-Clause *)
(* The forms of a batch of the bumps of polygons, shaded and not: what the watch lets pass is right. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Mult_error BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Shaded Gap Polygons ErrorFree.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleHolds CylinderConstants SecondAlong TwoPolygonsConstants CylinderFirst.
From Forceshade Require Import Lanes RecordedForms LaneAnswers.
Import ListNotations.
Open Scope R_scope.

(* A lane that the watch lets pass is in the domain, and its force is right. *)
Definition right_where_free (set : instruction_set) (lane : Lane) (law : R -> R -> exact_force) (x z : binary32) : Prop :=
  is_free set lane = true -> in_range x /\ in_range z /\
  let exact := law (read (value32 x)) (read (value32 z)) in
  right_lane (force_x lane) (force_z lane) (in_contact exact) (exact_x exact) (exact_z exact).

(* ---- Coordinates that the watch lets pass ---- *)

Lemma watched_coordinate : forall set least l x, is32 least l -> bpow radix2 (-30) <= l -> is_large (absolute32 x) = false ->
  is_tiny set least (absolute32 x) = false ->
  in_range x /\ coordinate (to64 x) (value32 x) /\ read (value32 x) = value32 x /\ (value32 x = 0 \/ l <= Rabs (value32 x)).
Proof.
  intros set least l x [Vl Fl] Hl L T. pose proof (not_large x L) as [Fx Rx].
  pose proof (not_tiny_is set least x l Fx Vl Fl Hl T) as S. split; [now split|]. pose proof (to64_is_exact x Fx) as I. split; [|split].
  - split; [exact I|apply (generic_format_B2R 24 128)|exact Rx|]. destruct S as [S|S]; [now left|right]. split; [lra|].
    apply Rle_trans with (1 := Rx). simpl. lra.
  - unfold read. destruct S as [->|S]; [now destruct (Rle_bool _ _)|]. rewrite Rle_bool_true; [reflexivity|lra].
  - exact S.
Qed.

Lemma quantum_is : is32 quantum (bpow radix2 (-30)).
Proof. split; [exact value_of_quantum|reflexivity]. Qed.

Lemma to32_exact : forall v a, is64 v a -> in_binary32 a -> Rabs a <= bpow radix2 100 -> is32 (rounded v) a.
Proof.
  intros v a [V F] G B. assert (E : nearest32 (value64 v) = a) by (rewrite V; apply round_generic; auto with typeclass_instances).
  assert (L : Rabs (nearest32 (value64 v)) < bpow radix2 128) by (rewrite E; apply Rle_lt_trans with (1 := B); now apply bpow_lt).
  destruct (to32_rounds_once v F L) as [V2 F2]. rewrite E in V2. now split.
Qed.

Lemma scaled_binary32 : forall a k, in_binary32 a -> (-100 <= k)%Z -> a = 0 \/ bpow radix2 (-20) <= Rabs a -> in_binary32 (bpow radix2 k *
  a).
Proof.
  intros a k G Hk S. rewrite Rmult_comm. destruct S as [->|S]; [rewrite Rmult_0_l; apply generic_format_0|].
  apply mult_bpow_exact_FLT; auto with typeclass_instances.
  assert (-19 <= mag radix2 a)%Z by (apply mag_ge_bpow; exact S). lia.
Qed.

Lemma half_is : forall R w K, parameters R w K -> in_binary32 (value32 w / 2) /\ is32 (rounded (half_width w)) (value32 w / 2).
Proof.
  intros R w K Hp. pose proof (half_width_is _ _ _ Hp) as I. destruct Hp as (_ & HR & Hw & _).
  assert (G : in_binary32 (value32 w / 2)).
  { replace (value32 w / 2) with (bpow radix2 (-1) * value32 w) by (change (bpow radix2 (-1)) with (/ 2); field).
    apply scaled_binary32; [apply (generic_format_B2R 24 128)|lia|right]. rewrite Rabs_pos_eq by lra. simpl. lra. }
  split; [exact G|]. apply to32_exact; [exact I|exact G|]. rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 14);
    [simpl; lra|apply bpow_le; lia].
Qed.

Lemma greatest32_is : forall a b x y, is32 a x -> is32 b y -> is32 (greatest32 a b) (Rmax x y).
Proof.
  intros a b x y [<- Fa] [<- Fb]. unfold greatest32. rewrite less32_is by assumption. unfold Rmax.
  case Rlt_bool_spec; intro H; destruct (Rle_dec (value32 a) (value32 b)); try lra; split; try reflexivity; try assumption.
  lra.
Qed.

Lemma least_of_width : forall R w K, parameters R w K ->
  exists l, is32 (greatest32 quantum (rounded (times (two_to (-28)) (half_width w)))) l /\ bpow radix2 (-30) <= l /\
    bpow radix2 (-28) * (value32 w / 2) <= l.
Proof.
  intros R w K Hp. destruct (half_is _ _ _ Hp) as [G _]. pose proof (half_width_is _ _ _ Hp) as I. destruct Hp as (_ & HR & Hw & _).
  set (c := value32 w / 2) in *. assert (Hc : / 2000 <= c <= 10000) by (unfold c; lra).
  assert (G2 : in_binary32 (bpow radix2 (-28) * c)).
  { apply scaled_binary32; [exact G|lia|right]. rewrite Rabs_pos_eq by lra. simpl. lra. }
  assert (B : 0 <= bpow radix2 (-28) * c <= 10000) by (simpl; lra).
  exists (Rmax (bpow radix2 (-30)) (bpow radix2 (-28) * c)). split; [|split; [apply Rmax_l|apply Rmax_r]].
  apply greatest32_is; [exact quantum_is|]. apply to32_exact; [|exact G2|].
  - apply scaled_is; [lia|exact I| |].
    + apply generic_inclusion_mag with fexp32; [intros _; unfold FLT_exp; lia|exact G2].
    + rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 14); [simpl; lra|apply bpow_le; lia].
  - rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 14); [simpl; lra|apply bpow_le; lia].
Qed.

Lemma absolute32_is : forall x a, is32 x a -> is32 (absolute32 x) (Rabs a).
Proof. intros x a [<- F]. unfold absolute32, b32_abs. split; [apply B2R_Babs|now rewrite is_finite_Babs]. Qed.

Lemma size_coordinate : forall x, in_range x -> coordinate (to64 x) (value32 x) -> coordinate (widened (absolute32 x)) (Rabs (value32 x)).
Proof.
  intros x [F Rx] [I G _ S]. destruct (absolute32_is x _ (conj eq_refl F)) as [V Fa]. split.
  - rewrite <- V. now apply to64_is_exact.
  - now apply generic_format_abs.
  - now rewrite Rabs_Rabsolu.
  - destruct S as [->|S]; [left; apply Rabs_R0|right]. unfold size in *. now rewrite Rabs_Rabsolu.
Qed.

(* ---- w/2 - |x| is exact ---- *)

Lemma multiple_is_binary64 : forall n e, (-1074 <= e)%Z -> Rabs (IZR n * bpow radix2 e) < bpow radix2 (53 + e) ->
  in_binary64 (IZR n * bpow radix2 e).
Proof.
  intros n e He B. apply generic_format_FLT. exists (Float radix2 n e); [reflexivity| |exact He]. cbn [Fnum].
  rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 e)), bpow_plus in B by apply bpow_ge_0. apply Rmult_lt_reg_r in B; [|apply bpow_gt_0].
  rewrite <- abs_IZR in B. apply lt_IZR. exact B.
Qed.

Lemma exact_difference : forall a b, in_binary32 a -> in_binary32 b -> 0 <= b <= a -> b = 0 \/ bpow radix2 (-100) <= b ->
  bpow radix2 (-28) * a <= b \/ b = 0 -> in_binary64 (a - b).
Proof.
  intros a b Ga Gb Hab Hb Hs. assert (Ga64 : in_binary64 a) by (apply generic_inclusion_mag with fexp32; [intros _; unfold FLT_exp;
    lia|exact Ga]).
  destruct (Req_dec b 0) as [->|Hne]; [now rewrite Rminus_0_r|]. assert (Hb1 : 0 < b) by lra. destruct Hb as [Hb|Hb]; [contradiction|].
  destruct Hs as [Hs|Hs]; [|contradiction].
  set (k := (mag radix2 b - 1)%Z).
  assert (Hk1 : bpow radix2 k <= b) by (pose proof (bpow_mag_le radix2 b ltac:(lra)) as Q; rewrite Rabs_pos_eq in Q by lra; exact Q).
  assert (Hk2 : b < bpow radix2 (k + 1)).
  { unfold k. replace (mag radix2 b - 1 + 1)%Z with (mag radix2 b : Z) by ring. pose proof (bpow_mag_gt radix2 b) as Q.
    now rewrite Rabs_pos_eq in Q by lra. }
  assert (Hk : (-101 < k)%Z). { assert (-100 < k + 1)%Z; [|lia]. apply (lt_bpow radix2). lra. }
  destruct (multiple_of k a ltac:(lia) Ga ltac:(rewrite Rabs_pos_eq; lra)) as [m Hm].
  destruct (multiple_of k b ltac:(lia) Gb ltac:(rewrite Rabs_pos_eq; lra)) as [n Hn].
  assert (E : a - b = IZR (m - n) * bpow radix2 (k - 23)) by (rewrite minus_IZR, Rmult_minus_distr_r, <- Hm, <- Hn; reflexivity).
  rewrite E. apply multiple_is_binary64; [lia|]. rewrite <- E, Rabs_pos_eq by lra.
  apply Rle_lt_trans with a; [lra|]. replace (53 + (k - 23))%Z with (28 + (k + 1) + 1)%Z by ring. rewrite !(bpow_plus radix2 (28 + (k +
    1))).
  rewrite (bpow_plus radix2 28). change (bpow radix2 (-28)) with (/ 268435456) in Hs. change (bpow radix2 28) with 268435456.
  change (bpow radix2 1) with 2. lra.
Qed.

(* ---- The gap by two fused operations ---- *)

Notation gap_form slope tail distance z := (fused tail distance (fused slope distance (opp z))) (only parsing).

(* slope and tail times the distance are H, the height of the surface, next to h. *)
Definition height_at (slope tail distance : binary64) (h H : R) : Prop := exists s t d,
  is64 slope s /\ is64 tail t /\ is64 distance d /\ / 137438953472 <= h <= 18000 /\ 0 <= H <= 1001 / 1000 * h /\
  0 <= s * d <= 1001 / 1000 * h /\ Rabs (t * d) <= 101 / 100 / 4194304 * h /\ Rabs (H - (s * d + t * d)) <= / 2097152 * unit53 * h.

Lemma gap_form_is_near : forall slope tail distance h H zv Z, height_at slope tail distance h H -> coordinate zv Z ->
  exists v, is64 (gap_form slope tail distance zv) v /\
    (/ 1048577 * h < Rabs v -> near (7 / 2) v (H - Z) /\ Rabs v / 2 <= Rabs (H - Z)).
Proof.
  intros slope tail distance h H zv Z (s & t & d & Is & It & Id & Rh & RH & Rsd & Rtd & E) Hz. pose proof (coordinate_range _ _ Hz) as Rz.
  destruct Hz as [Hz _ _ _]. apply Rabs_le_inv in Rz. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Ht.
  assert (big : forall a, Rabs a <= 1000000 -> Rabs a <= bpow radix2 1000).
  { intros a Ha. apply Rle_trans with (bpow radix2 20); [simpl; lra|apply bpow_le; lia]. }
  set (Q := s * d - Z). assert (RQ : Rabs Q <= 100000) by (unfold Q; apply Rabs_le; lra).
  assert (Iq : is64 (fused slope distance (opp zv)) (nearest64 Q)).
  { unfold Q. replace (s * d - Z) with (s * d + - Z) by ring. apply fused_is; try assumption; [now apply opp_is|]. apply big.
    replace (s * d + - Z) with Q by (unfold Q; ring). lra. }
  set (q := nearest64 Q) in *. pose proof (product_is_close Q) as Eq. fold q in Eq.
  assert (Rq : Rabs q <= 100001).
  { pose proof (Rabs_triang_inv q Q) as T. unfold unit53 in *. lra. }
  set (w := t * d + q). assert (Rw : Rabs w <= 200000).
  { unfold w. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  exists (nearest64 w). split; [apply fused_is; try assumption; apply big; fold w; lra|].
  pose proof (product_is_close w) as Ew. set (v := nearest64 w) in *. intro Hlarge.
  set (a := Rabs v) in *. assert (Ha : 0 <= a) by apply Rabs_pos.
  assert (Bw : Rabs w <= 1001 / 1000 * a).
  { pose proof (Rabs_triang_inv w v) as T. rewrite (Rabs_minus_sym w v) in T. fold a in T. unfold unit53 in *. lra. }
  assert (Bt : Rabs (t * d) <= 26 / 100 * a) by lra.
  assert (Bq : Rabs q <= 1265 / 1000 * a).
  { pose proof (Rabs_triang w (- (t * d))) as T. replace (w + - (t * d)) with q in T by (unfold w; ring). rewrite Rabs_Ropp in T. lra. }
  assert (BQ : Rabs Q <= 127 / 100 * a).
  { pose proof (Rabs_triang_inv Q q) as T. rewrite (Rabs_minus_sym Q q) in T. unfold unit53 in *. lra. }
  assert (B : Rabs (v - (H - Z)) <= 31 / 10 * unit53 * a).
  { replace (v - (H - Z)) with ((v - w) + (q - Q) - (H - (s * d + t * d))) by (unfold w, Q; ring).
    apply Rle_trans with (Rabs (v - w) + Rabs (q - Q) + Rabs (H - (s * d + t * d))).
    { unfold Rminus at 1. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. apply Rplus_le_compat_r. apply Rabs_triang. }
    unfold unit53 in *. lra. }
  assert (Bg : a <= 1001 / 1000 * Rabs (H - Z)).
  { pose proof (Rabs_triang_inv v (H - Z)) as T. fold a in T. unfold unit53 in *. lra. }
  split; [|lra].
  apply near_more with (31 / 10 * (1001 / 1000) * unit53 * (1 + / 1000) / unit53); [|unfold unit53; lra].
  apply close_is_near; [|unfold unit53; lra]. apply Rle_trans with (1 := B). unfold unit53 in *. lra.
Qed.

Definition depth_is (n : R) (depth : binary64) (M : R) : Prop :=
  (0 < M -> computes depth n M (-66) 15) /\ (~ 0 < M -> depth = zero64) /\ not_negative depth.

Lemma depth_form_is : forall slope tail distance h height H zv Z, height_at slope tail distance h H -> is64 height h -> coordinate zv Z ->
  is_near (times (two_to (-20)) height) (gap_form slope tail distance zv) = false ->
  depth_is (7 / 2) (larger (gap_form slope tail distance zv) zero64) (H - Z).
Proof.
  intros slope tail distance h height H zv Z HA Ih Hz W. destruct (gap_form_is_near _ _ _ _ _ _ _ HA Hz) as (v & Iv & Near).
  destruct HA as (s & t & d & _ & _ & _ & Rh & RH & _).
  pose proof (two_to_is (-20) ltac:(lia)) as I2. change (bpow radix2 (-20)) with (/ 1048576) in I2.
  assert (Il : is64 (times (two_to (-20)) height) (nearest64 (/ 1048576 * h))).
  { apply times_is; try assumption. rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 14); [simpl; lra|apply bpow_le; lia]. }
  pose proof (product_is_close (/ 1048576 * h)) as C. rewrite (Rabs_pos_eq (/ 1048576 * h)) in C by lra. pose proof tiny_is_tiny as Ht.
  apply Rabs_le_inv in C. pose proof unit_is_small as Hu.
  assert (L : / 1048577 * h < nearest64 (/ 1048576 * h)) by (unfold unit53 in *; lra).
  pose proof (not_near_is _ _ _ (proj2 Iv) Il ltac:(lra) W) as Large. rewrite (proj1 Iv) in Large.
  destruct (Near ltac:(lra)) as [N B]. destruct (near_sign _ _ _ N) as (S1 & S2 & S3).
  split; [|split; [|now apply larger_not_negative with v]].
  - intro HM. exists v. split; [|split; [exact N|]].
    + pose proof (larger_is _ _ _ _ Iv zero_is) as I. rewrite Rmax_left in I; [exact I|]. specialize (S1 HM). lra.
    + rewrite (Rabs_pos_eq (H - Z)) in B by lra. pose proof (coordinate_range _ _ Hz) as Rz. apply Rabs_le_inv in Rz.
      apply size_of; simpl; lra.
  - intro HM. apply larger_is_zero with v; [exact Iv|]. destruct (Rtotal_order (H - Z) 0) as [T|[T|T]]; [specialize (S2 T)|specialize (S3
    T)|]; lra.
Qed.

(* ---- A lane of a bump ---- *)

Lemma bump_lane : forall k x z half c minus_K K cx cz (sideways leans : bool) Ex Ez M, (0 < k <= 2 ^ 20)%Z ->
  in_range x -> in_range z -> value32 z = 0 \/ bpow radix2 (-30) <= Rabs (value32 z) -> is32 half c ->
  is32 minus_K (- K) -> / 1000 <= K <= 1000 -> is_beside_tie (k + 1) cx = false -> is_beside_tie (k + 1) cz = false ->
  let inside := is_at_most32 (absolute32 x) half in
  sideways = inside && leans ->
  (Rabs (value32 x) <= c -> (0 < M -> good k cx Ex /\ good k cz Ez /\ not_negative cz) /\ (~ 0 < M -> cx = zero64 /\ cz = zero64)) ->
  right_lane (plus32 (where32 sideways (times_sign32 (rounded cx) (plus32 x zero32))) zero32)
    (choice32 inside (rounded cz) (wall_lane minus_K z))
    (0 < (if Rle_bool (Rabs (value32 x)) c then M else - value32 z))
    (if Rle_bool (Rabs (value32 x)) c then (if leans then if Rlt_bool (value32 x) 0 then - Ex else Ex else 0) else 0)
    (if Rle_bool (Rabs (value32 x)) c then Ez else K * - value32 z).
Proof.
  intros k x z half c mK K cx cz sideways leans Ex Ez M Hk [Fx Rx] Hz Tz Hh HmK HK Tx Tc inside Es Hin.
  destruct (absolute32_is x _ (conj eq_refl Fx)) as [Va Fa].
  assert (Ei : inside = Rle_bool (Rabs (value32 x)) c).
  { unfold inside. rewrite is_at_most32_is_right; [|exact Fa|apply Hh]. now rewrite Va, (proj1 Hh). }
  rewrite Ei in *. subst sideways. destruct (Rle_bool_spec (Rabs (value32 x)) c) as [H|H]; cbn [andb choice32].
  - destruct (Hin H) as [H1 H2]. now apply lane_inside with k.
  - now apply lane_beside.
Qed.

(* ---- Forces without shading ---- *)

Lemma unshaded_components : forall depth M v n E, depth_is (7 / 2) depth M -> computes v n E (-50) 10 -> 0 <= n <= 2 -> 0 < E ->
  (0 < M -> good 8 (times depth v) (M * E) /\ not_negative (times depth v)) /\ (~ 0 < M -> times depth v = zero64).
Proof.
  intros depth M v n E (D1 & D2 & D3) Hv Hn HE. assert (Nv : not_negative v).
  { destruct Hv as (y & Iy & Ny & _). apply positive_is_not_negative with y; [exact Iy|]. now apply (near_sign _ _ _ Ny). }
  split; intro HM.
  - pose proof (unshaded_force _ _ _ _ _ (D1 HM) Hv Hn) as G. split; [exact G|]. apply times_not_negative; try assumption. apply G.
  - rewrite (D2 HM). now apply zero_times_is.
Qed.

(* ---- With shading ---- *)

Notation shading_form R size_of_x := (square_root (fused (opp size_of_x) size_of_x (times (to64 R) (to64 R)))) (only parsing).

Lemma shading_form_is : forall R w K xv X, parameters R w K -> coordinate xv X -> 0 <= X <= value32 R ->
  let exact := (value32 R - X) * (value32 R + X) in
  0 <= exact /\ (exact = 0 -> shading_form R xv = zero64) /\ (exact <> 0 -> computes (shading_form R xv) (3 / 2 * one) (sqrt exact) (-29)
    15).
Proof.
  intros R w K xv X ((FR & _) & HR & _) Hx HX exact. pose proof (to64_is_exact R FR) as HRv.
  pose proof (coordinate_not_tiny _ _ Hx) as TX. destruct Hx as [Hx Fx Rx _]. pose proof (generic_format_B2R 24 128 R) as GR.
  assert (Hpos : 0 <= exact) by (unfold exact; apply Rmult_le_pos; lra). split; [exact Hpos|].
  set (Q := value32 R * value32 R). assert (HQ : / 100 <= Q <= 100000000) by (unfold Q; clear - HR; nra).
  assert (Ee : exact = - X * X + Q) by (unfold exact, Q; ring).
  assert (Iq : is64 (times (to64 R) (to64 R)) Q).
  { apply times_exact with (value32 R) (value32 R); try assumption; [reflexivity|now apply product_is_binary64|].
    rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 40); [simpl; lra|apply bpow_le; lia]. }
  assert (He : exact <= 100000000) by (rewrite Ee; assert (0 <= X * X) by apply Rle_0_sqr; lra).
  assert (If : is64 (fused (opp xv) xv (times (to64 R) (to64 R))) (nearest64 exact)).
  { rewrite Ee. apply fused_is; [now apply opp_is|exact Hx|exact Iq|]. rewrite <- Ee, Rabs_pos_eq by lra.
    apply Rle_trans with (bpow radix2 40); [simpl; lra|apply bpow_le; lia]. }
  split.
  - intro H0. 
    assert (E : fused (opp xv) xv (times (to64 R) (to64 R)) = zero64).
    { assert (Nq : not_negative (times (to64 R) (to64 R))) by (apply positive_is_not_negative with Q; [exact Iq|lra]).
      set (q := times (to64 R) (to64 R)) in *. clearbody q. pose proof (opp_is _ _ Hx) as Ho. set (o := opp xv) in *. clearbody o.
      unfold fused, b64_fma in *.
      match goal with |- context [Bfma _ _ ?p ?q' ?nan _ _ _ _] =>
        pose proof (Bfma_correct 53 1024 p q' nan mode_NE o xv q (proj2 Ho) (proj2 Hx) (proj2 Iq)) as C;
        set (m := Bfma 53 1024 p q' nan mode_NE o xv q) in * end.
      cbv zeta in C. rewrite (proj1 Ho), (proj1 Hx), (proj1 Iq), <- Ee, H0, round_0, Rabs_R0 in C by auto with typeclass_instances.
      rewrite Rlt_bool_true in C by (apply bpow_gt_0). destruct C as (C1 & C2 & C3). rewrite Rcompare_Eq in C3 by reflexivity.
      assert (S : Bsign 53 1024 m = false).
      { rewrite C3. destruct Nq as [Fq Sq]. unfold Bfma_szero, BinarySingleNaN.Bfma_szero. cbv zeta.
        replace (BinarySingleNaN.Bsign (B2BSN 53 1024 q)) with false by (rewrite <- Sq; destruct q; reflexivity || discriminate Fq).
        now destruct (xorb _ _). }
      destruct m as [s|s|s pl Hpl|s k e Hk]; try discriminate; [cbn [Bsign] in S; now subst s|].
      exfalso. simpl in C1. apply eq_0_F2R in C1. now destruct s. }
    rewrite E. reflexivity.
  - intro Hne. assert (HR30 : value32 R = 0 \/ bpow radix2 (-30) <= Rabs (value32 R)) by (right; rewrite Rabs_pos_eq by lra; simpl; lra).
    assert (D : bpow radix2 (-53) <= value32 R - X).
    { rewrite <- (Rabs_pos_eq (value32 R - X)) by lra. apply difference_is_not_tiny; try assumption. intro H0. apply Hne.
      unfold exact. rewrite H0. ring. }
    assert (Le : bpow radix2 (2 * -29) <= exact).
    { replace (2 * -29)%Z with (-53 + -5)%Z by reflexivity. rewrite bpow_plus. unfold exact.
      apply Rmult_le_compat; try apply bpow_ge_0; [exact D|simpl; lra]. }
    replace (3 / 2 * one) with (one / 2 + one) by field. apply computes_root; [|pose proof (bpow_gt_0 radix2 (2 * -29)); lra|unfold one;
      lra|lia].
    exists (nearest64 exact). split; [exact If|]. split.
    + apply rounding_is_near. right. rewrite Rabs_pos_eq by lra. apply Rle_trans with (2 := Le). apply bpow_le. lia.
    + apply size_of; [exact Le|]. apply Rle_trans with (1 := He). simpl. lra.
Qed.

Lemma shaded_components : forall k n R w K xv X depth M, parameters R w K -> coordinate xv X -> 0 <= X <= value32 R -> depth_is n depth M
  -> 0 <= n <= 7 / 2 ->
  (n + 9 / 2 * one) * (1001 / 1000) <= IZR k ->
  let scale := times depth (K_over_R K R) in let cx := times scale xv in let cz := times scale (shading_form R xv) in
  (0 < M -> good k cx (M * (value32 K / value32 R) * X) /\
    good k cz (M * (value32 K / value32 R) * sqrt ((value32 R - X) * (value32 R + X))) /\ not_negative cz) /\
  (~ 0 < M -> not_negative xv -> cx = zero64 /\ cz = zero64).
Proof.
  intros k n R w K xv X depth M Hp Hx HX (D1 & D2 & D3) Hn Hk scale cx cz.
  destruct (shading_form_is R w K xv X Hp Hx HX) as (Hpos & Hzero & Hroot). destruct Hx as [Hx _ Rx Sx].
  destruct Hp as ((FR & _ & FK) & HR & _ & HK).
  assert (H1 : 1 <= one <= 11 / 10) by (unfold one; lra).
  assert (CK : computes (to64 K) 0 (value32 K) (-10) 10) by (apply exactly; [now apply to64_is_exact|now apply size_of_stiffness]).
  assert (CR : computes (to64 R) 0 (value32 R) (-4) 14) by (apply exactly; [now apply to64_is_exact|now apply size_of_radius]).
  pose proof (computes_over _ _ _ _ _ _ _ _ _ _ CK CR ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as CKR. fold (K_over_R K R) in CKR.
  assert (Nk : not_negative (K_over_R K R)).
  { destruct CKR as (y & Iy & Ny & _). apply positive_is_not_negative with y; [exact Iy|]. apply (near_sign _ _ _ Ny).
    apply Rdiv_lt_0_compat; lra. }
  assert (Nr : not_negative (shading_form R xv)).
  { destruct (Req_dec ((value32 R - X) * (value32 R + X)) 0) as [H0|Hne]; [rewrite (Hzero H0); now split|].
    destruct (Hroot Hne) as (y & Iy & Ny & _). apply positive_is_not_negative with y; [exact Iy|]. apply (near_sign _ _ _ Ny).
    apply sqrt_lt_R0. lra. }
  split; intro HM.
  - pose proof (computes_times _ _ _ _ _ _ _ _ _ _ (D1 HM) CKR ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as CS. fold scale in CS.
    assert (Hnull : forall v, is64 v 0 -> is64 (times scale v) 0).
    { intros v Hv. destruct CS as (s & Hs & _). replace 0 with (nearest64 (s * 0)) by (rewrite Rmult_0_r; apply round_0;
      auto with typeclass_instances).
      apply times_is; try assumption. rewrite Rmult_0_r, Rabs_R0. apply bpow_ge_0. }
    assert (Ns : not_negative scale).
    { apply times_not_negative; try assumption. destruct CS as (s & Hs & _). apply Hs. }
    assert (Gz : good k cz (M * (value32 K / value32 R) * sqrt ((value32 R - X) * (value32 R + X)))).
    { destruct (Req_dec ((value32 R - X) * (value32 R + X)) 0) as [H0|Hne].
      - rewrite H0, sqrt_0, Rmult_0_r. apply zero_is_good, Hnull. rewrite (Hzero H0). apply zero_is.
      - pose proof (computes_times _ _ _ _ _ _ _ _ _ _ CS (Hroot Hne) ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as C.
        apply (computed_is_good k _ _ _ _ _ C); try lra; lia. }
    split; [|split; [exact Gz|apply times_not_negative; try assumption; apply Gz]].
    destruct Sx as [->|Sx].
    + rewrite Rmult_0_r. now apply zero_is_good, Hnull.
    + pose proof (computes_times _ _ _ _ _ _ _ _ _ _ CS (exactly _ _ _ _ Hx Sx) ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as C.
      apply (computed_is_good k _ _ _ _ _ C); try lra; lia.
  - intro Nx. unfold cx, cz, scale. rewrite (D2 HM), !(zero_times_is (K_over_R K R)) by exact Nk. split; now apply zero_times_is.
Qed.
