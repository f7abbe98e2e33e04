(* SPDX-License-Identifier: BSD-3-Clause *)
(* The separations of cylinder and bump-cylinder: docs/proofs.md, "The last stage". *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness Computed Evaluate Inputs Gap Polygons.
From Forceshade Require Import CylinderForce CylinderFirst CylinderAnswers DoubleDoubleTerms Separation.
Open Scope R_scope.

Lemma sum_size : forall a b A B, Rabs a <= A -> Rabs b <= B -> Rabs (a + b) <= A + B.
Proof. intros a b A B Ha Hb. apply Rle_trans with (1 := Rabs_triang _ _). lra. Qed.

(* K (R - rho) Y/rho less M, where Y is x or z + d. *)
Lemma cylinder_component_is_separated : forall K Rad c d X Z y0 n M rho B j, let Y := y0 + IZR n * d in
  multiple 33 K -> multiple 27 Rad -> multiple 34 c -> multiple 53 X -> multiple 53 Z -> multiple 53 y0 -> multiple 150 M ->
  d * d = Rad * Rad - c * c -> rho * rho = X * X + (Z + d) * (Z + d) ->
  0 <= K <= 1000 -> 0 < rho <= Rad -> Rad <= 10000 -> 0 <= d <= Rad -> Rabs Z <= 10000 -> Rabs Y <= rho -> Rabs (y0 - IZR n * d) <= 20000 ->
  Rabs M <= B -> (40 <= j <= 50)%Z -> 200000000000 + B * 10000 <= bpow radix2 j ->
  40000000000000000000000 + (20000000 + B) * (20000000 + B) * 500000000 <= bpow radix2 j * bpow radix2 j ->
  let F := K * (Rad - rho) * (Y / rho) in F <> M -> bpow radix2 (- (826 + 3 * j)) <= Rabs (F - M).
Proof.
  intros K Rad c d X Z y0 n M rho B j Y MK MR Mc MX MZ My MM Hd2 Hrho2 HK Hrho HR Hd HZ HY HY' HM Hj HC1 HC3 F Hne.
  set (y1 := IZR n) in *. assert (My1 : multiple 0 y1) by apply multiple_whole. clearbody y1.
  set (e := Rad * Rad - c * c) in *. assert (Me : multiple 68 e) by (unfold e; multiple). clearbody e.
  set (b0 := K * y0 + M). set (b1 := K * y1). set (G := X * X + Z * Z + e). set (g := 2 * b0 * b1 * G + 2 * Z * (b0 * b0 + b1 * b1 * e)).
  assert (Mb0 : multiple 150 b0) by (unfold b0; multiple). assert (Mb1 : multiple 33 b1) by (unfold b1; multiple).
  assert (MG : multiple 106 G) by (unfold G; multiple). assert (Mg : multiple 353 g) by (unfold g; multiple).
  set (a := K * Rad * y0). set (u := K * Rad * y1 * d). set (p := (b0 * b0 + b1 * b1 * e) * G + 4 * b0 * b1 * Z * e). set (v := g * d).
  set (t := - ((K * Y + M) * rho)).
  assert (E : a + u + t = (F - M) * rho) by (unfold a, u, t, F, Y; field; lra).
  assert (Ma : multiple 203 a) by (unfold a; multiple).
  assert (Mu : multiple (2 * 203) (u * u)).
  { replace (u * u) with (K * K * (Rad * Rad) * (y1 * y1) * e) by (rewrite <- Hd2; unfold u; ring). multiple. }
  assert (Mp : multiple (2 * 203) p) by (unfold p; multiple).
  assert (Muv : multiple (3 * 203) (u * v)).
  { replace (u * v) with (K * Rad * y1 * g * e) by (rewrite <- Hd2; unfold u, v; ring). multiple. }
  assert (Mv : multiple (4 * 203) (v * v)).
  { replace (v * v) with (g * g * e) by (rewrite <- Hd2; unfold v; ring). multiple. }
  assert (Ht : t * t = p + v).
  { replace (t * t) with ((K * Y + M) * (K * Y + M) * (rho * rho)) by (unfold t; ring). rewrite Hrho2.
    unfold p, v, g, G. rewrite <- Hd2. unfold b0, b1, Y. ring. }
  assert (Hpv : p - v = (K * (y0 - y1 * d) + M) * (K * (y0 - y1 * d) + M) * (X * X + (Z - d) * (Z - d))).
  { unfold p, v, g, G. rewrite <- Hd2. unfold b0, b1. ring. }
  clearbody p v.
  assert (Hne2 : a + u + t <> 0) by (rewrite E; apply Rmult_integral_contrapositive_currified; lra).
  assert (HC : bpow radix2 (-203) <= bpow radix2 j) by (apply bpow_le; lia).
  assert (BK : Rabs K <= 1000) by (rewrite Rabs_pos_eq; lra). assert (BR : Rabs Rad <= 10000) by (rewrite Rabs_pos_eq; lra).
  assert (Brho : Rabs rho <= 10000) by (rewrite Rabs_pos_eq; lra). assert (BY : Rabs Y <= 10000) by lra.
  assert (Bx : Rabs X <= 10000).
  { apply Rle_trans with (2 := Brho). apply Rsqr_le_abs_0. unfold Rsqr. rewrite Hrho2. pose proof (Rle_0_sqr (Z + d)) as S. unfold Rsqr in
    S. lra. }
  assert (Bl : Rabs (Z - d) <= 20000) by (pose proof (minus_size Z d) as S; rewrite (Rabs_pos_eq d) in S; lra).
  assert (C1 : Rabs (a + u - t) <= bpow radix2 j).
  { apply Rle_trans with (2 := HC1). replace (a + u - t) with (K * Rad * Y + (K * Y + M) * rho) by (unfold a, u, t, Y; ring).
    eapply Rle_trans; [apply sum_size; [apply product_size; [apply product_size; [exact BK|exact BR]|exact BY]|
      apply product_size; [apply sum_size; [apply product_size; [exact BK|exact BY]|exact HM]|exact Brho]]|]. lra. }
  assert (Ba : Rabs (a - u) <= 1000 * 10000 * 20000).
  { replace (a - u) with (K * Rad * (y0 - y1 * d)) by (unfold a, u; ring). apply product_size; [now apply product_size|exact HY']. }
  assert (PB : 0 <= B) by (pose proof (Rabs_pos M); lra).
  assert (C2 : Rabs (a - u) <= bpow radix2 j) by lra.
  assert (C3 : Rabs ((a - u) * (a - u) - (p - v)) <= bpow radix2 j * bpow radix2 j).
  { apply Rle_trans with (2 := HC3). rewrite Hpv. apply Rle_trans with (1 := minus_size _ _).
    assert (S1 : Rabs (K * (y0 - y1 * d) + M) <= 1000 * 20000 + B) by (apply sum_size; [now apply product_size|exact HM]).
    assert (S2 : Rabs (X * X + (Z - d) * (Z - d)) <= 10000 * 10000 + 20000 * 20000) by (apply sum_size; now apply product_size).
    eapply Rle_trans; [apply Rplus_le_compat; [apply product_size; [exact Ba|exact Ba]|
      apply product_size; [apply product_size; [exact S1|exact S1]|exact S2]]|]. lra. }
  pose proof (separation_of_degree_4 203 a u p v t _ Ma Mu Mp Muv Mv Ht Hne2 HC C1 C2 C3) as H.
  apply (separation_of_quotient_4 F M rho (a + u + t) 14 203 j E); [simpl; lra|exact H].
Qed.

(* The same, of the law's component with the plane's force W added. *)
Lemma cylinder_component_with_plane : forall K Rad c d X Z y0 n W m rho B Bw j, let Y := y0 + IZR n * d in
  multiple 33 K -> multiple 27 Rad -> multiple 34 c -> multiple 53 X -> multiple 53 Z -> multiple 53 y0 -> multiple 86 W -> multiple 150 m
    ->
  d * d = Rad * Rad - c * c -> rho * rho = X * X + (Z + d) * (Z + d) ->
  0 <= K <= 1000 -> 0 < rho <= Rad -> Rad <= 10000 -> 0 <= d <= Rad -> Rabs Z <= 10000 -> Rabs Y <= rho -> Rabs (y0 - IZR n * d) <= 20000 ->
  0 <= W <= Bw -> B = 10000001 + 2 * Bw -> (40 <= j <= 50)%Z -> 200000000000 + B * 10000 <= bpow radix2 j ->
  40000000000000000000000 + (20000000 + B) * (20000000 + B) * 500000000 <= bpow radix2 j * bpow radix2 j ->
  let F := K * (Rad - rho) * (Y / rho) + W in F <> m -> bpow radix2 (- (826 + 3 * j)) <= Rabs (F - m).
Proof.
  intros K Rad c d X Z y0 n W m rho B Bw j Y MK MR Mc MX MZ My MW Mm Hd2 Hrho2 HK Hrho HR Hd HZ HY HY' HW HB Hj HC1 HC3 F Hne.
  set (P := K * (Rad - rho) * (Y / rho)) in *.
  assert (BP : Rabs P <= 10000000).
  { unfold P. rewrite !Rabs_mult, (Rabs_pos_eq K), (Rabs_pos_eq (Rad - rho)) by lra. replace 10000000 with (1000 * 10000 * 1) by ring.
    apply Rmult_le_compat; try apply Rabs_pos; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra|].
    apply quotient_size; rewrite (Rabs_pos_eq rho) by lra; unfold Y in *; lra. }
  apply (small_middles_suffice (10000000 + Bw) F m); [|change 1 with (bpow radix2 0); apply bpow_le; lia| |exact Hne].
  { unfold F. apply sum_size; [exact BP|]. rewrite Rabs_pos_eq; lra. }
  intros Bm _. replace (F - m) with (P - (m - W)) by (unfold F; ring).
  apply (cylinder_component_is_separated K Rad c d X Z y0 n (m - W) rho B j); try assumption; [multiple| |unfold F in Hne; fold Y P; lra].
  apply Rle_trans with (1 := minus_size _ _). rewrite (Rabs_pos_eq W) by lra. lra.
Qed.

(* Both components of a law, where W is the plane's force along z, or 0. *)
Lemma cylinder_is_separated_with_plane : forall R w K xv X zv Z W Bw j m, parameters R w K -> coordinate xv X -> coordinate zv Z -> is_tie
  m ->
  multiple 86 W -> 0 <= W <= Bw -> (40 <= j <= 50)%Z ->
  200000000000 + (10000001 + 2 * Bw) * 10000 <= bpow radix2 j ->
  40000000000000000000000 + (30000001 + 2 * Bw) * (30000001 + 2 * Bw) * 500000000 <= bpow radix2 j * bpow radix2 j ->
  let Fx := cylinder_x (value32 R) (value32 w) (value32 K) X Z in let Fz := cylinder_z (value32 R) (value32 w) (value32 K) X Z + W in
  (Fx <> m -> bpow radix2 (- (826 + 3 * j)) <= Rabs (Fx - m)) /\ (Fz <> m -> bpow radix2 (- (826 + 3 * j)) <= Rabs (Fz - m)).
Proof.
  intros R w K xv X zv Z W Bw j m Hp Cx Cz Hm MW HW Hj HC1 HC3 Fx Fz.
  multiples_of_inputs Hp Cx Cz. pose proof (multiple_of_tie m Hm) as Mm.
  destruct Hp as (_ & HR & Hw & HK). pose proof (coordinate_range _ _ Cz) as BZ. pose proof (coordinate_range _ _ Cx) as BX.
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2]. unfold Fx, Fz, cylinder_x, cylinder_z in *.
  destruct (distance_squared (value32 R) (value32 w) X Z) as [Hrho0 Hrho2]. clear Fx Fz. cbv zeta.
  set (rho := distance_from_axis _ _ X Z) in *. clearbody rho.
  set (d := axis_depth (value32 R) (value32 w)) in *. clearbody d. set (c := value32 w / 2) in *. set (Rad := value32 R) in *. set (k :=
    value32 K) in *.
  assert (HdR : d <= Rad).
  { apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite Hd2. pose proof (Rle_0_sqr c) as S. unfold Rsqr in S. lra. }
  assert (plain : forall F i, multiple i (F - m) -> (i <= 150)%Z -> F <> m -> bpow radix2 (- (826 + 3 * j)) <= Rabs (F - m)).
  { intros F i M Hi Hne. apply Rle_trans with (bpow radix2 (- i)); [apply bpow_le; lia|]. apply (multiple_not_0 _ _ M). lra. }
  assert (M0 : multiple 0 0) by apply (multiple_whole 0). assert (M1 : multiple 0 1) by apply (multiple_whole 1).
  case Rlt_bool_spec; intro Hin.
  2: { split; apply (plain _ 150%Z); try lia; multiple. }
  case Req_bool_spec; intro Haxis.
  { rewrite Haxis. split; apply (plain _ 150%Z); try lia; multiple. }
  assert (size : forall Y Y', rho * rho = Y * Y + Y' * Y' -> Rabs Y <= rho).
  { intros Y Y' H. rewrite <- (Rabs_pos_eq rho) by lra. apply Rsqr_le_abs_0. unfold Rsqr. rewrite H. pose proof (Rle_0_sqr Y') as S. unfold
    Rsqr in S. lra. }
  split.
  - replace (k * (Rad - rho) * (X / rho)) with (k * (Rad - rho) * ((X + 0 * d) / rho) + 0) by (unfold Rdiv; ring).
    apply (cylinder_component_with_plane k Rad c d X Z X 0 0 m rho (10000001 + 2 * Bw) Bw j); try assumption; try lra; try ring.
    + multiple.
    + rewrite Rmult_0_l, Rplus_0_r. now apply (size X (Z + d)).
    + rewrite Rmult_0_l, Rminus_0_r. lra.
  - replace (Z + d) with (Z + 1 * d) by ring.
    apply (cylinder_component_with_plane k Rad c d X Z Z 1 W m rho (10000001 + 2 * Bw) Bw j); try assumption; try lra; try ring.
    + rewrite Rmult_1_l. apply (size (Z + d) X). rewrite Hrho2. ring.
    + rewrite Rmult_1_l. pose proof (minus_size Z d) as S. rewrite (Rabs_pos_eq d) in S by lra. lra.
Qed.

Theorem cylinder_is_separated : forall R w K x y z m, parameters R w K -> valid x y z = true -> is_tie m ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let Fx := cylinder_x (value32 R) (value32 w) (value32 K) X Z in let Fz := cylinder_z (value32 R) (value32 w) (value32 K) X Z in
  (Fx <> m -> bpow radix2 (-946) <= Rabs (Fx - m)) /\ (Fz <> m -> bpow radix2 (-946) <= Rabs (Fz - m)).
Proof.
  intros R w K x y z m Hp Hv Hm X Z Fx Fz. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  pose proof (cylinder_is_separated_with_plane R w K _ X _ Z 0 0 40 m Hp Cx Cz Hm) as H. rewrite Rplus_0_r in H.
  apply H; try lia; try (simpl; lra). exists 0%Z. simpl. ring.
Qed.

Theorem bump_cylinder_is_separated : forall R w K x y z m, parameters R w K -> valid x y z = true -> is_tie m ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let Fx := cylinder_x (value32 R) (value32 w) (value32 K) X Z in
  let Fz := cylinder_z (value32 R) (value32 w) (value32 K) X Z + Rmax (- value32 K * Z) 0 in
  (Fx <> m -> bpow radix2 (-949) <= Rabs (Fx - m)) /\ (Fz <> m -> bpow radix2 (-949) <= Rabs (Fz - m)).
Proof.
  intros R w K x y z m Hp Hv Hm X Z Fx Fz. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  apply (cylinder_is_separated_with_plane R w K _ X _ Z _ 10000000 41 m Hp Cx Cz Hm); try lia; try (simpl; lra).
  - pose proof (multiple_of_stiffness _ _ _ Hp) as MK. pose proof (multiple_of_coordinate _ _ Cz) as MZ.
    unfold Rmax. destruct (Rle_dec _ _); [exists 0%Z; simpl; ring|multiple].
  - destruct Hp as (_ & _ & _ & HK). pose proof (coordinate_range _ _ Cz) as BZ. apply Rabs_le_inv in BZ. split; [apply Rmax_r|].
    apply Rmax_lub; [|lra]. apply Rle_trans with (value32 K * 10000); [|lra].
    replace (- value32 K * Z) with (value32 K * - Z) by ring. apply Rmult_le_compat_l; lra.
Qed.
