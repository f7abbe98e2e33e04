(* SPDX-License-Identifier: BSD-3-Clause *)
(* v = R^2 - rho^2 of a batch, where the watch lets it pass, is within 4 units inside of the cylinder, and has the right sign outside. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core Mult_error Sterbenz BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Gap Polygons ErrorFree.
From Forceshade Require Import DoubleDouble Depth Split DoubleDoubleHolds CylinderForce CylinderFirst CylinderAnswers CylinderConstants.
From Forceshade Require Import SecondAlong.
From Forceshade Require Import Lanes RecordedForms LaneAnswers BumpLanes Batch PolygonLanes CylinderLaneSums.
Import ListNotations.
Open Scope R_scope.

(* The least coordinate that is answered is no smaller than the bits of w/2 and of 2d allow. *)
Lemma greatest_is : forall a b x y, is64 a x -> is64 b y -> is64 (greatest a b) (Rmax x y).
Proof.
  intros a b x y Ha Hb. unfold greatest. rewrite (less_is _ _ _ _ Ha Hb). unfold Rmax.
  case Rlt_bool_spec; intro H; destruct (Rle_dec x y); try assumption; [lra|]. replace y with x by lra. assumption.
Qed.

Lemma least_of_depth : forall half d_head c dh, is64 half c -> is64 d_head dh -> 0 <= c <= 10000 -> 0 <= dh <= 10001 ->
  exists l, is32 (greatest32 quantum (to32 (times (two_to (-27)) (greatest half d_head)))) l /\ bpow radix2 (-30) <= l /\
    (forall k, (-60 <= k <= 60)%Z -> bpow radix2 k <= c \/ bpow radix2 k <= dh -> bpow radix2 (k - 27) <= l).
Proof.
  intros half d_head c dh Ic Id Hc Hd. pose proof (greatest_is _ _ _ _ Ic Id) as Ig. set (m := Rmax c dh) in *.
  assert (Hm : 0 <= m <= 10001) by (unfold m; split; [apply Rle_trans with c; [lra|apply Rmax_l]|apply Rmax_lub; lra]).
  pose proof (two_to_is (-27) ltac:(lia)) as I2.
  assert (Hb : 0 <= bpow radix2 (-27) * m <= 1) by (simpl; lra).
  pose proof (times_is _ _ _ _ I2 Ig ltac:(rewrite Rabs_pos_eq by lra; apply Rle_trans with (bpow radix2 0); [simpl; lra|apply bpow_le;
    lia])) as It.
  set (p := nearest64 (bpow radix2 (-27) * m)) in *.
  assert (Hp : 0 <= p <= 1).
  { split; [apply round_ge_generic|apply round_le_generic]; auto with typeclass_instances; try lra; [apply generic_format_0|].
    change 1 with (bpow radix2 0). apply generic_format_bpow. unfold FLT_exp. lia. }
  assert (L : Rabs (nearest32 (value64 (times (two_to (-27)) (greatest half d_head)))) < bpow radix2 128).
  { rewrite (proj1 It). apply Rle_lt_trans with (bpow radix2 0); [|now apply bpow_lt]. apply abs_round_le_generic; auto with
    typeclass_instances.
    - apply generic_format_bpow. unfold FLT_exp. lia.
    - rewrite Rabs_pos_eq by lra. simpl. lra. }
  destruct (to32_rounds_once _ (proj2 It) L) as [V F]. rewrite (proj1 It) in V.
  exists (Rmax (bpow radix2 (-30)) (nearest32 p)). split; [|split; [apply Rmax_l|]].
  - apply greatest32_is; [exact quantum_is|now split].
  - intros k Hk H. apply Rle_trans with (2 := Rmax_r _ _). apply round_ge_generic; auto with typeclass_instances.
    { apply generic_format_bpow. unfold FLT_exp. lia. }
    apply round_ge_generic; auto with typeclass_instances.
    { apply generic_format_bpow. unfold FLT_exp. lia. }
    replace (k - 27)%Z with (-27 + k)%Z by ring. rewrite bpow_plus. apply Rmult_le_compat_l; [apply bpow_ge_0|].
    destruct H as [H|H]; apply Rle_trans with (1 := H); [apply Rmax_l|apply Rmax_r].
Qed.

Lemma power_below : forall a, 0 < a -> exists k, bpow radix2 k <= a < bpow radix2 (k + 1).
Proof.
  intros a Ha. exists (mag radix2 a - 1)%Z. pose proof (bpow_mag_le radix2 a ltac:(lra)) as L. pose proof (bpow_mag_gt radix2 a) as U.
  rewrite Rabs_pos_eq in L, U by lra. split; [exact L|]. now replace (mag radix2 a - 1 + 1)%Z with (mag radix2 a : Z) by ring.
Qed.

(* The depth is 0 or not far below R. *)
Lemma depth_is_not_small : forall R w K, parameters R w K -> let d := axis_depth (value32 R) (value32 w) in
  d = 0 \/ value32 R / 8200 <= d.
Proof.
  intros R w K Hp d. destruct (half_is _ _ _ Hp) as [Gc _]. destruct Hp as (_ & HR & Hw & _).
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2]. fold d in Hd0, Hd2.
  set (c := value32 w / 2) in *. set (Rad := value32 R) in *. assert (Hc : 0 < c <= Rad) by (unfold c; lra).
  assert (GR : in_binary32 Rad) by apply (generic_format_B2R 24 128).
  destruct (Req_dec c Rad) as [E|Hne].
  - left. rewrite E in Hd2. assert (d * d = 0) by lra. now apply Rsqr_0_uniq.
  - right. assert (nearest32 Rad = Rad) as ER by (apply round_generic; auto with typeclass_instances).
    destruct (far_from_others Rad c ltac:(lra) ltac:(simpl; lra) Gc ltac:(now rewrite ER)) as [L _]. rewrite Rabs_pos_eq in L by lra.
    assert (D2 : / 67108872 * Rad * Rad <= d * d).
    { rewrite Hd2. replace (Rad * Rad - c * c) with ((Rad - c) * (Rad + c)) by ring. apply Rmult_le_compat; lra. }
    destruct (Rle_or_lt (Rad / 8200) d) as [H|H]; [exact H|exfalso].
    assert (d * d <= Rad / 8200 * (Rad / 8200)) by (apply Rmult_le_compat; lra). assert (0 < Rad * Rad) by (apply Rmult_lt_0_compat; lra).
    lra.
Qed.

(* The two coordinates, when the watch lets them pass. *)
Definition watched (c dh X : R) : Prop := X = 0 \/ forall k, (-60 <= k <= 60)%Z -> bpow radix2 k <= c \/ bpow radix2 k <= dh ->
  bpow radix2 (k - 27) <= Rabs X.

Theorem v_form_is_near : forall R w K anchor anchored rest d_head d_tail axis xv X zv Z, parameters R w K ->
  depth R w anchor anchored rest d_head d_tail axis -> coordinate xv X -> coordinate zv Z ->
  watched (value32 w / 2) (value64 d_head) X -> watched (value32 w / 2) (value64 d_head) Z ->
  let half := square_root (plus (minus anchored anchor) rest) in
  let Q := value32 R * value32 R in let L := Z + axis_depth (value32 R) (value32 w) in let V := Q - (X * X + L * L) in
  exists v, is64 (v_form half d_head d_tail xv zv) v /\
    (/ 16777300 * Q < Rabs v -> Rabs (v - V) <= 128 * unit53 * Rabs V /\ (0 < V -> Rabs (v - V) <= 4 * unit53 * Rabs V)).
Proof.
  intros R w K anchor anchored rest d_head d_tail axis xv X zv Z Hp Dp Cx Cz Wx Wz half Q L V.
  pose proof (half_from_depth R w K _ _ _ _ _ _ Hp Dp) as Ic. fold half in Ic. clearbody half.
  destruct (half_is _ _ _ Hp) as [Gc _]. pose proof (depth_is_not_small R w K Hp) as Ds. cbv zeta in Ds.
  destruct Dp as [(_ & _ & Fh & Ft & _) _ _ _ Bits Rh Rt Re _]. pose proof Hp as (_ & HR & Hw & _).
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  set (d := axis_depth _ _) in *. set (c := value32 w / 2) in *. set (dh := value64 d_head) in *. set (dt := value64 d_tail) in *.
  set (Rad := value32 R) in *. assert (Hc : / 2000 <= c <= Rad) by (unfold c; lra). fold Q in Hd2.
  assert (Ih : is64 d_head dh) by now split. assert (It : is64 d_tail dt) by now split.
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Hti.
  assert (HQ : / 100 <= Q <= 100000000) by (unfold Q; clear -HR; nra).
  pose proof (coordinate_range _ _ Cx) as Rx. pose proof (coordinate_range _ _ Cz) as Rz. pose proof (coordinate_format _ _ Cx) as Gx.
  pose proof (coordinate_format _ _ Cz) as Gz. pose proof (coordinate_is _ _ Cx) as Ix. pose proof (coordinate_is _ _ Cz) as Iz.
  assert (big : forall a, Rabs a <= 1000000 -> Rabs a <= bpow radix2 1000).
  { intros a Ha. apply Rle_trans with (bpow radix2 20); [simpl; lra|apply bpow_le; lia]. }
  (* sums with w/2 *)
  destruct (power_below c ltac:(lra)) as [k [Lk Uk]].
  assert (Kk : (-12 < k < 14)%Z).
  { split; [assert (-11 < k + 1)%Z; [|lia]|]; apply (lt_bpow radix2); [apply Rlt_trans with (2 := Uk)|apply Rle_lt_trans with (1 := Lk)];
    simpl; lra. }
  assert (sum_c : forall a, in_binary32 a -> Rabs a = Rabs X -> in_binary64 (c + a)).
  { intros a Ga Ea. apply (exact_sum 24 k); try assumption; try lia; [right; rewrite Rabs_pos_eq by lra; split; assumption| |right].
    - rewrite Ea. destruct Wx as [Wx|Wx]; [left; rewrite Wx, Rabs_R0 in Ea; destruct (Req_dec a 0) as [|N]; [assumption|apply Rabs_pos_lt
      in N; lra]|].
      right. apply Rle_trans with (bpow radix2 (k - 27)); [apply bpow_le; lia|]. apply Wx; [lia|now left].
    - rewrite Ea. apply Rle_lt_trans with (1 := Rx). apply Rlt_le_trans with (bpow radix2 14); [simpl; lra|apply bpow_le; lia]. }
  assert (Im : is64 (minus half xv) (c - X)).
  { apply minus_exact with c X; try assumption; [reflexivity| |apply big; apply Rabs_le; apply Rabs_le_inv in Rx; lra].
    unfold Rminus. apply sum_c; [now apply generic_format_opp|apply Rabs_Ropp]. }
  assert (Ip : is64 (plus half xv) (c + X)).
  { apply plus_exact with c X; try assumption; [reflexivity|now apply sum_c|apply big; apply Rabs_le; apply Rabs_le_inv in Rx; lra]. }
  (* 2d *)
  assert (G2 : generic_format radix2 (FLT_exp (-149) 29) (2 * dh)).
  { replace (2 * dh) with (dh * bpow radix2 1) by (change (bpow radix2 1) with 2; ring). destruct (Req_dec dh 0) as [->|N];
      [rewrite Rmult_0_l; apply generic_format_0|]. apply mult_bpow_pos_exact_FLT; auto with typeclass_instances; try assumption; lia. }
  assert (G64 : in_binary64 (2 * dh)) by (apply generic_inclusion_mag with (FLT_exp (-149) 29); [intros _; unfold FLT_exp; lia|exact G2]).
  assert (I2h : is64 (times (two_to 1) d_head) (2 * dh)).
  { apply times_exact with 2 dh; try assumption; [apply (two_to_is 1); lia|reflexivity|apply big; rewrite Rabs_pos_eq; lra]. }
  assert (Bdt : Rabs dt <= 1) by (apply Rle_trans with (1 := Rt); unfold tail_share; lra).
  assert (I2t : is64 (times (two_to 1) d_tail) (2 * dt)).
  { apply times_exact with 2 dt; try assumption; [apply (two_to_is 1); lia|reflexivity| |].
    - replace (2 * dt) with (dt * bpow radix2 1) by (change (bpow radix2 1) with 2; ring).
      apply mult_bpow_pos_exact_FLT; auto with typeclass_instances; [now apply format_of in It|lia].
    - apply big. rewrite Rabs_mult, (Rabs_pos_eq 2) by lra. lra. }
  assert (HdR : d <= Rad) by (clear -Hd0 Hd2 Hc HR; unfold Q in Hd2; nra).
  pose proof (Rabs_le_inv _ _ Rt) as Rt'. pose proof (Rabs_le_inv _ _ Re) as Re'.
  assert (Hdh : dh <= 100001 / 100000 * d /\ d <= 100001 / 100000 * dh) by (unfold tail_share, slope_share in *; lra).
  assert (Hdh2 : dh * dh <= 10003 / 10000 * Q).
  { apply Rle_trans with (100001 / 100000 * Rad * (100001 / 100000 * Rad)); [apply Rmult_le_compat; lra|].
    replace (100001 / 100000 * Rad * (100001 / 100000 * Rad)) with (100001 / 100000 * (100001 / 100000) * Q) by (unfold Q; ring). lra. }
  set (az := Rabs Z) in *. assert (Az : 0 <= az) by apply Rabs_pos. assert (Ez : az * az = Z * Z) by (unfold az; rewrite <- Rabs_mult;
    apply Rabs_pos_eq, Rle_0_sqr).
  set (y := az * dh). assert (Hy : 0 <= y) by (apply Rmult_le_pos; lra).
  assert (By : 2 * y <= Z * Z / 3 + 3 * (dh * dh)).
  { pose proof (Rle_0_sqr (az - 3 * dh)) as S. unfold Rsqr in S. unfold y. rewrite <- Ez. lra. }
  assert (XX : 0 <= X * X) by apply Rle_0_sqr. assert (ZZ : 0 <= Z * Z) by apply Rle_0_sqr.
  assert (Bt : Rabs (Z * (2 * dt)) <= tail_share * (2 * y)).
  { rewrite Rabs_mult, Rabs_mult, (Rabs_pos_eq 2) by lra. fold az. unfold y. replace (tail_share * (2 * (az * dh))) with (az * (2 *
    (tail_share * dh))) by ring.
    apply Rmult_le_compat_l; lra. }
  assert (Be : Rabs (2 * Z * (d - (dh + dt))) <= slope_share * (2 * y)).
  { rewrite Rabs_mult, Rabs_mult, (Rabs_pos_eq 2) by lra. fold az. unfold y. replace (slope_share * (2 * (az * dh))) with (2 * az *
    (slope_share * dh)) by ring.
    apply Rmult_le_compat_l; lra. }
  assert (Bzf : Rabs (Z * (Z + 2 * dh)) <= Z * Z + 2 * y).
  { rewrite Rmult_plus_distr_l. apply Rle_trans with (1 := Rabs_triang _ _). rewrite (Rabs_pos_eq (Z * Z)) by lra.
    rewrite Rabs_mult, (Rabs_pos_eq (2 * dh)) by lra. fold az. unfold y. lra. }
  assert (Bm : Rabs ((c - X) * (c + X)) <= Rmax Q (X * X)).
  { replace ((c - X) * (c + X)) with (c * c - X * X) by ring. assert (0 <= c * c <= Q) by (split; [apply Rle_0_sqr|unfold Q; apply
    Rmult_le_compat; lra]).
    pose proof (Rmax_l Q (X * X)). pose proof (Rmax_r Q (X * X)). apply Rabs_le. lra. }
  set (N := X * X + Z * Z). assert (HN : 0 <= N <= 200000000).
  { unfold N. pose proof (Rabs_le_inv _ _ Rx). pose proof (Rabs_le_inv _ _ Rz). split; [lra|]. clear - H H0. nra. }
  pose proof (plus_is _ _ _ _ Iz I2h ltac:(apply big; apply Rabs_le; apply Rabs_le_inv in Rz; lra)) as If.
  pose proof (sum_is_close Z (2 * dh) (format_of _ _ Iz) G64) as Ef.
  set (f := nearest64 (Z + 2 * dh)) in *.
  destruct (Rle_or_lt N (8 * Q)) as [Near|Far].
  - assert (Ef0 : f = Z + 2 * dh).
    { apply round_generic; auto with typeclass_instances. rewrite Rplus_comm. destruct (Req_dec dh 0) as [D0|D0].
      - rewrite D0. replace (2 * 0 + Z) with Z by ring. now apply binary32_in_64.
      - assert (Dd : Rad / 8200 <= d) by (destruct Ds as [Ds|Ds]; [lra|exact Ds]).
        destruct (power_below (2 * dh) ltac:(lra)) as [j [Lj Uj]].
        assert (Kj : (-18 < j < 16)%Z).
        { split; [assert (-17 < j + 1)%Z; [|lia]|]; apply (lt_bpow radix2); [apply Rlt_trans with (2 := Uj)|apply Rle_lt_trans with (1 :=
          Lj)]; simpl; lra. }
        apply (exact_sum 29 j); try assumption; try lia; [right; rewrite Rabs_pos_eq by lra; split; assumption| |right].
        + destruct Wz as [Wz|Wz]; [now left|right]. replace (j - 28)%Z with (j - 1 - 27)%Z by ring. apply Wz; [lia|right].
          replace (j - 1)%Z with (j + - (1))%Z by ring. rewrite bpow_plus. change (bpow radix2 (- (1))) with (/ 2). lra.
        + replace (j + 53 - 29)%Z with (j + 1 + 23)%Z by ring. rewrite bpow_plus.
          apply Rlt_le_trans with (2 * dh * bpow radix2 23); [|apply Rmult_le_compat_r; [apply bpow_ge_0|lra]].
          assert (az <= 3 * Rad).
          { destruct (Rle_or_lt az (3 * Rad)) as [H|H]; [exact H|exfalso]. assert (3 * Rad * (3 * Rad) <= az * az) by (apply
            Rmult_le_compat; lra).
            unfold N in Near. assert (9 * Q <= az * az) by (unfold Q; lra). lra. }
          fold az. change (bpow radix2 23) with 8388608. lra. }
    destruct (v_form_is half d_head d_tail xv X zv Z c dh dt d Q f (14 * Q) (/ 80000000 * Q) Im Ip Ih It Iz If I2t ltac:(lra))
      as (v & Iv & _ & B); try lra.
    { apply Rle_trans with (1 := Bm). apply Rmax_lub; unfold N in Near; lra. }
    { rewrite Ef0. unfold N in Near. lra. }
    { apply Rle_trans with (1 := Bt). unfold N in Near. unfold tail_share. lra. }
    exists v. split; [exact Iv|]. intro Hl. replace (f - (Z + 2 * dh)) with 0 in B by lra. rewrite Rmult_0_r, Rabs_R0 in B. fold L V in B.
    assert (BV : Rabs (v - V) <= 3 * unit53 * Rabs v).
    { apply Rle_trans with (1 := B). unfold N in Near. pose proof (Rabs_pos v). unfold slope_share, unit53 in *. lra. }
    assert (Bv : Rabs v <= 1001 / 1000 * Rabs V).
    { pose proof (Rabs_triang_inv v V). pose proof (Rabs_pos v). unfold unit53 in *. lra. }
    pose proof (Rabs_pos V). split; [|intros _]; unfold unit53 in *; lra.
  - assert (Zf : Rabs (Z * (Z + 2 * dh)) <= 172 / 100 * N) by (apply Rle_trans with (1 := Bzf); unfold N in *; lra).
    assert (Zef : Rabs (Z * (f - (Z + 2 * dh))) <= unit53 * (172 / 100 * N)).
    { rewrite Rabs_mult. apply Rle_trans with (Rabs Z * (unit53 * Rabs (Z + 2 * dh))); [apply Rmult_le_compat_l; [apply Rabs_pos|exact
      Ef]|].
      replace (Rabs Z * (unit53 * Rabs (Z + 2 * dh))) with (unit53 * Rabs (Z * (Z + 2 * dh))) by (rewrite Rabs_mult; ring).
      apply Rmult_le_compat_l; lra. }
    destruct (v_form_is half d_head d_tail xv X zv Z c dh dt d Q f (2 * N) (/ 80000000 * N) Im Ip Ih It Iz If I2t ltac:(lra))
      as (v & Iv & Bv & B); try lra.
    { apply Rle_trans with (1 := Bm). apply Rmax_lub; unfold N in *; lra. }
    { replace (Z * f) with (Z * (Z + 2 * dh) + Z * (f - (Z + 2 * dh))) by ring. apply Rle_trans with (1 := Rabs_triang _ _). unfold unit53
      in *. lra. }
    { apply Rle_trans with (1 := Bt). unfold tail_share. unfold N in *. lra. }
    exists v. split; [exact Iv|]. intros _. fold L V in B.
    assert (HV : - V >= 28 / 100 * N).
    { unfold V, L, N in *. pose proof (Rle_0_sqr (Z + 3 * d)) as S. unfold Rsqr in S. assert (0 <= d * d) by (apply Rle_0_sqr).
      assert (0 <= c * c) by apply Rle_0_sqr. lra. }
    rewrite (Rabs_left V) by lra. split; [|intro; lra]. apply Rle_trans with (1 := B). unfold N in *. pose proof (Rabs_pos v).
    unfold slope_share, unit53 in *. lra.
Qed.
