(* SPDX-License-Identifier: BSD-3-Clause *)
(* The numbers that the laws cylinder and bump-cylinder hold, as their constructor computes them: they are what the theorems on the
   first stage assume. So these theorems hold for every input of the domain, and nothing is assumed. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Relative.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth Split CylinderForce CylinderFirst CylinderOutside CylinderAnswers.
Open Scope R_scope.

(* ---- The constructor of Cylinder ---- *)

Definition anchor_of (R : binary32) : binary64 := times (times (two_to 3) (to64 R)) (to64 R).
Definition anchor_terms (R w : binary32) : binary64 * binary64 := fast_two_sum (anchor_of R) (times (half_width w) (half_width w)).
Definition axis_of (R w : binary32) : binary64 := opp (to64 (to32 (hi (computed_depth R w)))).

Definition cylinder_of (first_stage : bool -> binary64 -> binary64 -> binary64 -> binary64 -> binary64 -> binary64 -> binary64 ->
  binary64 ->
    binary64 -> binary64 -> FirstStage) (R w K : binary32) (is_fused : bool) : binary64 -> binary64 -> FirstStage :=
  first_stage is_fused (to64 K) (to64 R) (anchor_of R) (fst (anchor_terms R w)) (snd (anchor_terms R w)) (split_head (computed_depth R
    w))
    (split_tail (computed_depth R w)) (axis_of R w).

Lemma binary32_is_29_bits : forall a, in_binary32 a -> generic_format radix2 (FLT_exp (-149) 29) a.
Proof. intros a Ha. apply generic_inclusion_mag with fexp32; [intros _; unfold FLT_exp; lia|exact Ha]. Qed.

Lemma anchor_is : forall R w K, parameters R w K -> let A := value64 (fst (anchor_terms R w)) in let r := value64 (snd (anchor_terms R
  w)) in
  is64 (anchor_of R) (8 * (value32 R * value32 R)) /\
  is_finite 53 1024 (fst (anchor_terms R w)) = true /\ is_finite 53 1024 (snd (anchor_terms R w)) = true /\
  A + r = 8 * (value32 R * value32 R) + value32 w / 2 * (value32 w / 2) /\ Rabs r <= unit53 * A.
Proof.
  intros R w K Hp A r. pose proof (half_width_is _ _ _ Hp) as Ic. destruct Hp as ((FR & _ & _) & HR & Hw & _).
  pose proof (generic_format_B2R 24 128 R) as GR. pose proof (generic_format_B2R 24 128 w) as Gw.
  assert (IR : is64 (to64 R) (value32 R)) by now apply to64_is_exact.
  set (q := value32 R) in *. set (c := value32 w / 2) in *.
  assert (big : forall a, 0 <= a <= 10000000000 -> not_too_large a).
  { intros a Ha. rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 40); [simpl; lra|apply bpow_le; lia]. }
  assert (Hc : / 2000 <= c <= q) by (unfold c; lra).
  assert (Hq2 : / 100 <= q * q <= 100000000) by (clear -HR; nra).
  assert (Hc2 : / 4000000 <= c * c <= q * q) by (clear -Hc; nra).
  assert (E3 : bpow radix2 3 = 8) by reflexivity.
  assert (I8 : is64 (times (two_to 3) (to64 R)) (8 * q)).
  { rewrite <- E3. apply scaled_is; [lia|assumption| |rewrite E3; apply big; lra].
    rewrite <- (Rmult_1_r q). apply product_scaled; [lia|now apply binary32_is_29_bits|apply one_is_binary32]. }
  assert (G8 : in_binary64 (8 * (q * q))).
  { rewrite <- E3. apply product_scaled; [lia|now apply binary32_is_29_bits|assumption]. }
  assert (Ia : is64 (anchor_of R) (8 * (q * q))).
  { apply times_exact with (8 * q) q; try assumption; [ring|apply big; lra]. }
  split; [exact Ia|].
  assert (Gc : in_binary64 (c * c)).
  { replace (c * c) with (bpow radix2 (-2) * (value32 w * value32 w)) by (change (bpow radix2 (-2)) with (/ 4); unfold c; field).
    apply product_scaled; [lia|now apply binary32_is_29_bits|assumption]. }
  assert (Icc : is64 (times (half_width w) (half_width w)) (c * c)) by (apply times_exact with c c; try assumption;
    [reflexivity|apply big; lra]).
  destruct (two_terms _ _ _ _ Ia Icc) as [[T1 F1] [T2 F2]].
  { rewrite !Rabs_pos_eq by lra. lra. }
  { rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 40); [simpl; lra|apply bpow_le; lia]. }
  unfold A, r, anchor_terms, fast_two_sum. cbv zeta. cbn [fst snd]. rewrite T1, T2.
  split; [exact F1|]. split; [exact F2|]. split; [ring|].
  set (x := 8 * (q * q) + c * c). apply rounding_tail.
  pose proof (sum_is_close _ _ G8 Gc) as C. fold x in C. rewrite (Rabs_pos_eq x) in C by (unfold x; lra). apply Rabs_le_inv in C.
  unfold x, unit53 in *. lra.
Qed.

(* A binary32 number other than the nearest to h is far from h, on its side. *)
Lemma far_from_others : forall h t, 0 <= h -> bpow radix2 (-21) <= h -> in_binary32 t -> t <> nearest32 h ->
  / 67108872 * h <= Rabs (h - t) /\ (t < nearest32 h -> / 67108872 * h <= h - t).
Proof.
  intros h t Hh Hsize Ht Hne. set (n := nearest32 h) in *.
  assert (Gn : in_binary32 n) by (apply generic_format_round; auto with typeclass_instances).
  assert (Cn : Rabs (n - h) <= / 16777216 * h).
  { pose proof (relative_error_N_FLT radix2 (-149) 24 (eq_refl _) (fun n => negb (Z.even n)) h) as E.
    rewrite (Rabs_pos_eq h) in E by assumption.
    replace (/ 16777216) with (/ 2 * bpow radix2 (-24 + 1)) by (simpl; lra). apply E.
    apply Rle_trans with (2 := Hsize). apply bpow_le. lia. }
  apply Rabs_le_inv in Cn. change (bpow radix2 (-21)) with (/ 2097152) in Hsize.
  assert (Hn : 0 < n) by lra.
  assert (gap : / 33554432 * n <= Rabs (t - n)).
  { destruct (Rlt_or_le t (n / 2)) as [Hsmall|Hlarge].
    - rewrite Rabs_left by lra. lra.
    - set (k := (mag radix2 n - 1)%Z).
      assert (Hk1 : bpow radix2 k <= n) by (pose proof (bpow_mag_le radix2 n ltac:(lra)) as Q; rewrite Rabs_pos_eq in Q by lra;
        exact Q).
      assert (Hk2 : n < bpow radix2 (k + 1)).
      { unfold k. replace (mag radix2 n - 1 + 1)%Z with (mag radix2 n : Z) by ring. 
        pose proof (bpow_mag_gt radix2 n) as Q. rewrite Rabs_pos_eq in Q by lra. exact Q. }
      assert (Hk : (-22 <= k)%Z).
      { assert (-22 < k + 1)%Z; [|lia]. apply (lt_bpow radix2). apply Rle_lt_trans with (2 := Hk2). simpl. lra. }
      assert (Hk3 : bpow radix2 (k - 1) <= n / 2).
      { unfold Z.sub. rewrite bpow_plus. change (bpow radix2 (- (1))) with (/ 2). lra. }
      destruct (multiple_of (k - 1) t ltac:(lia) Ht) as [a Ha]; [rewrite Rabs_pos_eq; lra|].
      destruct (multiple_of (k - 1) n ltac:(lia) Gn) as [b Hb]; [rewrite Rabs_pos_eq; lra|].
      set (u := bpow radix2 (k - 1 - 23)) in *. assert (Hu : 0 < u) by apply bpow_gt_0.
      assert (Hun : n < 33554432 * u).
      { apply Rlt_le_trans with (1 := Hk2). right. unfold u. change 33554432 with (bpow radix2 25). rewrite <- bpow_plus. f_equal.
        ring. }
      assert (E : t - n = IZR (a - b) * u) by (rewrite minus_IZR, Ha, Hb; ring). rewrite E, Rabs_mult, (Rabs_pos_eq u) by lra.
      assert (1 <= Rabs (IZR (a - b))).
      { rewrite <- abs_IZR. apply IZR_le. assert (a - b <> 0)%Z; [|lia]. intro H0. apply Hne. rewrite H0 in E. lra. }
      assert (1 * u <= Rabs (IZR (a - b)) * u) by (apply Rmult_le_compat_r; lra). lra. }
  pose proof (proj2 (round_N_pt radix2 fexp32 (fun n => negb (Z.even n)) h) t Ht) as N.
  change (Znearest (fun n => negb (Z.even n))) with ZnearestE in N. fold n in N. clearbody n.
  split.
  - rewrite Rabs_minus_sym. pose proof (Rabs_triang (t - h) (h - n)) as T. replace (t - h + (h - n)) with (t - n) in T by ring.
    rewrite (Rabs_minus_sym h n) in T. lra.
  - intro Hlt. rewrite (Rabs_left (t - n)) in gap by lra. destruct (Rle_or_lt t h) as [H|H].
    + rewrite (Rabs_left1 (t - h)) in N by lra. pose proof (Rle_abs (n - h)). lra.
    + exfalso. rewrite (Rabs_pos_eq (t - h)) in N by lra. pose proof (Rle_abs (n - h)). lra.
Qed.

Theorem cylinder_constants_are_right : forall R w K, parameters R w K ->
  depth R w (anchor_of R) (fst (anchor_terms R w)) (snd (anchor_terms R w)) (split_head (computed_depth R w))
    (split_tail (computed_depth R w)) (axis_of R w).
Proof.
  intros R w K Hp. destruct (anchor_is _ _ _ Hp) as (A1 & A2 & A3 & A4 & A5).
  destruct (computed_depth_is _ _ _ Hp) as (h & l & _ & H & L & _ & _ & Bl & Bd & Hh & Hsize). cbv zeta in Bd.
  unfold axis_of. set (a := computed_depth R w) in *. set (d := axis_depth _ _) in *. clearbody a.
  assert (big : forall b, Rabs b <= 1000000 -> not_too_large b).
  { intros b Hb. apply Rle_trans with (bpow radix2 20); [simpl; lra|apply bpow_le; lia]. }
  assert (Hsize' : h = 0 \/ / 1000000000000 <= h).
  { destruct Hsize as [H0|Hs]; [now left|right]. change (bpow radix2 (-21)) with (/ 2097152) in Hs. lra. }
  destruct (split_is a h l H L Bl Hh Hsize') as (t & s & Ih & It & Gt & Ct & Ts & Cs).
  pose proof (Rabs_le_inv _ _ Ct) as Ct2. pose proof (Rabs_le_inv _ _ Bl) as Bl2. pose proof (Rabs_le_inv _ _ Bd) as Bd2.
  pose proof (Rabs_le_inv _ _ Cs) as Cs2.
  (* axis *)
  assert (Hbelow : Rabs (nearest32 (value64 (hi a))) < bpow radix2 128).
  { rewrite (proj1 H). apply Rle_lt_trans with (bpow radix2 20); [|now apply bpow_lt].
    apply abs_round_le_generic; auto with typeclass_instances.
    - apply generic_format_bpow. unfold FLT_exp. lia.
    - rewrite Rabs_pos_eq; simpl; lra. }
  destruct (to32_rounds_once (hi a) (proj2 H) Hbelow) as [V32 F32]. rewrite (proj1 H) in V32.
  destruct (opp_is _ _ (to64_is_exact _ F32)) as [Vx Fx]. rewrite V32 in Vx.
  destruct Ih as [Vh Fh]. destruct It as [Vt Ft].
  split; try rewrite Vh; try rewrite Vt; try assumption.
  - repeat split; assumption.
  - lra.
  - fold d. apply Rabs_le. unfold slope_share, unit53 in *. lra.
  - fold d. intros Z GZ TZ Hne. rewrite Vx in Hne |- *. destruct Hsize as [H0|Hs].
    + assert (d = 0) as -> by (rewrite H0 in *; unfold unit53 in *; lra). rewrite Rplus_0_r.
      assert (nearest32 h = 0) as E0 by (rewrite H0; apply round_0; auto with typeclass_instances).
      rewrite E0, Ropp_0 in *. assert (t = 0) as -> by (rewrite H0 in *; lra). destruct TZ as [TZ|TZ]; [contradiction|].
      pose proof (Rabs_pos Z). split; [lra|]. split; [|trivial]. apply Rle_trans with (2 := TZ). apply bpow_le. lia.
    + destruct (far_from_others h (- Z) ltac:(lra) Hs ltac:(now apply generic_format_opp)) as [F1 F2].
      { intro E. apply Hne. rewrite <- E. ring. }
      replace (h - - Z) with (Z + h) in F1, F2 by ring. change (bpow radix2 (-21)) with (/ 2097152) in Hs.
      assert (Bdh : Rabs (d - h) <= / 1000000000000 * h) by (apply Rabs_le; unfold unit53 in *; lra).
      pose proof (Rabs_triang (Z + d) (h - d)) as T. replace (Z + d + (h - d)) with (Z + h) in T by ring.
      rewrite (Rabs_minus_sym h d) in T. split; [lra|]. split; [|intro Hlt; specialize (F2 ltac:(lra)); apply Rabs_le_inv in Bdh; lra].
      apply Rle_trans with (/ 68000000 * h); [|lra]. apply Rle_trans with (bpow radix2 (-50)); [apply bpow_le; lia|simpl; lra].
Qed.

(* Every answer of the first stages of cylinder and bump-cylinder is right, for every input of the domain. *)
Theorem cylinder_first_stage_answers_right_for_all : forall is_fused R w K later x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  right_or_later (evaluate cylinder_window (cylinder_of cylinder R w K is_fused) later x y z) (later (quantised x) (quantised z))
    (distance_from_axis (value32 R) (value32 w) X Z < value32 R)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z) (cylinder_z (value32 R) (value32 w) (value32 K) X Z).
Proof.
  intros is_fused R w K later x y z Hp Hv. apply cylinder_first_stage_answers_right; try assumption.
  now apply cylinder_constants_are_right with K.
Qed.

Theorem bump_cylinder_first_stage_answers_right_for_all : forall is_fused R w K later x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  right_or_later (evaluate bump_cylinder_window (cylinder_of bump_cylinder R w K is_fused) later x y z) (later (quantised x) (quantised
    z))
    (distance_from_axis (value32 R) (value32 w) X Z < value32 R \/ Z < 0)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z)
    (cylinder_z (value32 R) (value32 w) (value32 K) X Z + Rmax (- value32 K * Z) 0).
Proof.
  intros is_fused R w K later x y z Hp Hv. apply bump_cylinder_first_stage_answers_right; try assumption.
  now apply cylinder_constants_are_right with K.
Qed.
