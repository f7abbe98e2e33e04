(* SPDX-License-Identifier: BSD-3-Clause *)
(* What the laws bump-2p and bump-2p-shaded hold of their geometry, as double-double computes it: two_polygon_face of
   fast/laws/bump_geometry.h, two_polygon_gap of fast/laws/polygon_gap.h and the constructor of fast/laws/bump_2p.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Shaded Gap Polygons.
From Forceshade Require Import CylinderForce CylinderFirst DoubleDouble Depth Split DoubleDoubleNear DoubleDoubleHolds.
Open Scope R_scope.

Definition sum_2p (R w : binary32) : double_double := add (exactly64 (to64 R)) (computed_depth R w).
Definition tangent_2p (R w : binary32) : double_double := divide (exactly64 (half_width w)) (sum_2p R w).
Definition height_2p (R w : binary32) : double_double := multiply (tangent_2p R w) (exactly64 (half_width w)).
Definition diameter (R : binary32) : double_double := add (exactly64 (to64 R)) (exactly64 (to64 R)).
Definition face_cosine_2p (R w : binary32) : double_double := root_of (divide (sum_2p R w) (diameter R)).
Definition face_sine_2p (R w : binary32) : double_double :=
  divide (exactly64 (half_width w)) (multiply (diameter R) (face_cosine_2p R w)).
(* K_sine and K_cosine of the headers, of a face's sine or cosine. *)
Definition K_times (K : binary32) (a : double_double) : binary64 := hi (multiply (exactly64 (to64 K)) a).

(* ---- The face in real numbers ---- *)

Lemma face_2p : forall Rad w, 0 < Rad -> 0 < w <= 2 * Rad -> let c := w / 2 in let S := Rad + axis_depth Rad w in
  Rad <= S <= 2 * Rad /\ c <= S /\ slope_2p Rad w = c / S /\ bump_height Rad w = c / S * c /\
  cosine_of (slope_2p Rad w) = sqrt (S / (2 * Rad)) /\ sine_of (slope_2p Rad w) = c / (2 * Rad * sqrt (S / (2 * Rad))).
Proof.
  intros Rad w HR Hw c S. destruct (depth_squared Rad w ltac:(lra) ltac:(lra)) as [Hd0 Hd2]. fold c in Hd2.
  unfold S, slope_2p, bump_height. set (d := axis_depth Rad w) in *. clearbody d. clear S. set (S := Rad + d).
  assert (Hc : 0 < c <= Rad) by (unfold c; lra).
  assert (Hdx : d <= Rad) by (clear -Hd0 Hd2 Hc; assert (0 <= c * c) by apply Rle_0_sqr; nra).
  assert (HS : Rad <= S <= 2 * Rad /\ c <= S) by (unfold S; lra). destruct HS as [HS1 HS2].
  assert (EH : Rad - d = c / S * c).
  { apply Rmult_eq_reg_r with S; [|lra]. replace (c / S * c * S) with (c * c) by (field; lra).
    unfold S. replace ((Rad - d) * (Rad + d)) with (Rad * Rad - d * d) by ring. lra. }
  assert (ES : 2 * (Rad - d) / w = c / S).
  { rewrite EH. replace w with (2 * c) by (unfold c; field). field. lra. }
  rewrite ES. split; [exact HS1|]. split; [exact HS2|]. split; [reflexivity|]. split; [exact EH|].
  set (q := S / (2 * Rad)). assert (Hq : 0 < q) by (unfold q; apply Rdiv_lt_0_compat; lra).
  assert (Hr : 0 < sqrt q) by now apply sqrt_lt_R0. assert (Hr2 : sqrt q * sqrt q = q) by (apply sqrt_sqrt; lra).
  assert (E1 : 1 + Rsqr (c / S) = / q).
  { unfold q, Rsqr. apply Rmult_eq_reg_r with (S * S); [|apply Rgt_not_eq; apply Rmult_lt_0_compat; lra].
    replace ((1 + c / S * (c / S)) * (S * S)) with (S * S + c * c) by (field; lra).
    replace (/ (S / (2 * Rad)) * (S * S)) with (2 * Rad * S) by (field; lra). unfold S. lra. }
  assert (E2 : 1 / sqrt (1 + Rsqr (c / S)) = sqrt q) by (rewrite E1, sqrt_inv by assumption; field; lra).
  split; [exact E2|]. unfold sine_of. set (t := sqrt (1 + Rsqr (c / S))) in *.
  replace (c / S / t) with (c / S * (1 / t)) by (unfold Rdiv; ring).
  rewrite E2. set (r := sqrt q) in *. replace (2 * Rad) with (S / (r * r)) by (rewrite Hr2; unfold q; field; lra). field. lra.
Qed.

(* ---- What is computed ---- *)

(* R + d, and its bound of the error, which is small. *)
Lemma sum_2p_is : forall R w K, parameters R w K -> let S := value32 R + axis_depth (value32 R) (value32 w) in
  exists y z e, is64 (hi (sum_2p R w)) y /\ is64 (lo (sum_2p R w)) z /\ is64 (error (sum_2p R w)) e /\ 0 <= e <= / 40000 * y /\
    Rabs z <= unit53 * y /\ Rabs (y + z - S) <= 13 * (unit53 * unit53) * S /\ / 20 <= y <= 30000.
Proof.
  intros R w K Hp S. destruct (computed_depth_is R w K Hp) as (h & l & e & H & L & E & Be & Bl & Bd & Hh & _).
  destruct Hp as ((FR & _ & _) & HR & Hw & _). unfold S. set (d := axis_depth _ _) in *. clearbody d.
  assert (IR : is64 (to64 R) (value32 R)) by now apply to64_is_exact.
  unfold sum_2p. set (D := computed_depth R w) in *. clearbody D. destruct D as [dh dl de]. cbn [hi lo error] in *.
  set (x := value32 R) in *. clearbody x. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  pose proof (sum_of_is_near (to64 R) zero64 dh dl x h l IR zero_is H L ltac:(lra) ltac:(lra)
    ltac:(rewrite (Rabs_pos_eq h) by lra; exact Bl)) as (y & z & Y1 & Y2 & Bz & By).
  unfold add, rounded, exactly64. cbn [hi lo error].
  apply Rabs_le_inv in Bd. apply Rabs_le_inv in By. apply Rabs_le_inv in Bl. pose proof (Rabs_le_inv _ _ Bz) as Bz2.
  assert (Uy : unit53 * y <= / 1000 * Rabs y).
  { apply Rle_trans with (unit53 * Rabs y); [apply Rmult_le_compat_l; [lra|apply Rle_abs]|].
    apply Rmult_le_compat_r; [apply Rabs_pos|lra]. }
  assert (Hy0 : 0 <= y) by (pose proof (Rabs_pos z); apply Rmult_le_reg_l with unit53; lra).
  rewrite (Rabs_pos_eq y) in Uy by assumption.
  assert (Hy : / 20 <= y <= 30000) by (unfold unit53 in *; lra).
  set (sum := sum_of (to64 R) zero64 dh dl) in *. clearbody sum.
  assert (Ie : is64 (plus zero64 de) e).
  { apply plus_exact with 0 e; try assumption; [apply zero_is|ring|now apply format_of in E|]. apply big_enough, Rabs_le. lra. }
  destruct (error_of_is _ _ _ e e Y1 Ie ltac:(lra) ltac:(lra) ltac:(rewrite Rabs_pos_eq; lra)) as (f & F1 & F2 & _).
  rewrite (Rabs_pos_eq y) in F2 by lra.
  exists y, z, f. split; [exact Y1|]. split; [exact Y2|]. split; [exact F1|]. split; [unfold share101, unit53 in *; lra|].
  split; [exact Bz|]. split; [apply Rabs_le; unfold unit53 in *; lra|exact Hy].
Qed.

Lemma sum_2p_holds : forall R w K, parameters R w K ->
  holds 14 (/ 40000) (sum_2p R w) (value32 R + axis_depth (value32 R) (value32 w)).
Proof.
  intros R w K Hp. destruct (sum_2p_is R w K Hp) as (y & z & e & Y & Z & E & Be & Bz & By & Hy).
  exists y, z, e. repeat split; try apply Y; try apply Z; try apply E; try assumption; try lra.
  destruct Hp as (_ & HR & Hw & _). destruct (face_2p (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (HS & _).
  set (S := value32 R + axis_depth _ _) in *. pose proof unit_is_small as Hu.
  apply near_more with (13 * (unit53 * unit53) * (1 + / 1000) / unit53).
  - apply close_is_near; [|unfold unit53; lra]. now rewrite (Rabs_pos_eq S) by lra.
  - replace (13 * (unit53 * unit53) * (1 + / 1000) / unit53) with (13 * (1 + / 1000) * unit53) by (field; lra). lra.
Qed.

Lemma half_holds : forall R w K, parameters R w K -> holds 0 0 (exactly64 (half_width w)) (value32 w / 2).
Proof. intros R w K Hp. apply holds_exactly; [now apply half_width_is with R K|destruct Hp as (_ & _ & Hw & _); lra]. Qed.

Lemma tangent_2p_holds : forall R w K, parameters R w K -> let T := value32 w / 2 / (value32 R + axis_depth (value32 R) (value32 w)) in
  holds 28 (/ 1000) (tangent_2p R w) T /\ / 40000000 <= T <= 2.
Proof.
  intros R w K Hp T. pose proof (half_holds _ _ _ Hp) as Hh. pose proof (sum_2p_holds _ _ _ Hp) as Hs.
  destruct Hp as (_ & HR & Hw & _).
  destruct (face_2p (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (HS & HcS & _). unfold T, tangent_2p.
  set (c := value32 w / 2) in *. assert (Hc : / 2000 <= c <= 10000) by (unfold c; lra). set (S := value32 R + _) in *.
  assert (HT : / 40000000 <= c / S <= 2) by (split; apply Rmult_le_reg_r with S; try lra; replace (c / S * S) with c by (field; lra);
    lra).
  split; [|exact HT]. apply (holds_more _ _ _ _ _ _ (holds_divide _ _ _ _ _ _ _ _ Hh Hs ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)
    ltac:(lra) ltac:(lra) ltac:(lra))); lra.
Qed.

(* What bump-2p and bump-2p-shaded hold of their height and slope is what the theorems on their first stages assume. *)
Theorem linear_2p_is_right : forall R w K, parameters R w K ->
  linear (hi (height_2p R w)) (lo (height_2p R w)) (split_head (tangent_2p R w)) (split_tail (tangent_2p R w))
    (bump_height (value32 R) (value32 w)) (slope_2p (value32 R) (value32 w)).
Proof.
  intros R w K Hp. destruct (tangent_2p_holds _ _ _ Hp) as [Ht HT]. pose proof (half_holds _ _ _ Hp) as Hh.
  destruct Hp as (_ & HR & Hw & _). destruct (face_2p (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (_ & HcS & -> & -> & _).
  set (c := value32 w / 2) in *. assert (Hc : / 2000 <= c <= 10000) by (unfold c; lra). set (S := value32 R + _) in *.
  set (T := c / S) in *.
  assert (HH : / 80000000000 <= T * c <= 10000).
  { split; [replace (/ 80000000000) with (/ 40000000 * / 2000) by field; apply Rmult_le_compat; lra|].
    replace (T * c) with (c * c / S) by (unfold T, Rdiv; ring). apply Rle_trans with c; [|lra].
    apply Rmult_le_reg_r with S; [lra|]. replace (c * c / S * S) with (c * c) by (field; lra). apply Rmult_le_compat_l; lra. }
  pose proof (holds_multiply _ _ _ _ _ _ _ _ Ht Hh ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as Hm.
  destruct (holds_close _ _ _ _ Hm ltac:(lra) ltac:(lra)) as (g & m & _ & [V1 F1] & [V2 F2] & _ & _ & Bm & Cm & Rg).
  destruct (holds_close _ _ _ _ Ht ltac:(lra) ltac:(lra)) as (y & z & _ & Y & Z & _ & _ & Bz & Cy & Ry).
  destruct (split_is _ y z Y Z (low_part _ _ Bz ltac:(lra)) ltac:(lra) ltac:(right; lra)) as (p & q & [Vp Fp] & [Vq Fq] & Gp & Cp & Tq
    & Cq).
  unfold height_2p. absolute_values.
  split; try rewrite Vp; try rewrite Vq; try rewrite V1; try rewrite V2; try assumption.
  - repeat split; assumption.
  - lra.
  - apply Rabs_le. lra.
  - apply Rabs_le. unfold height_share, unit53 in *. lra.
  - lra.
  - apply Rabs_le. lra.
  - apply Rabs_le. unfold slope_share, unit53 in *. lra.
Qed.

Lemma diameter_holds : forall R w K, parameters R w K -> holds 0 (/ 1000000) (diameter R) (2 * value32 R).
Proof.
  intros R w K ((FR & _ & _) & HR & _). assert (IR : is64 (to64 R) (value32 R)) by now apply to64_is_exact.
  pose proof (generic_format_B2R 24 128 R) as GR. set (x := value32 R) in *. pose proof tiny_is_tiny as Htiny.
  pose proof unit_is_small as Hu.
  assert (G2 : in_binary64 (x + x)).
  { replace (x + x) with (bpow radix2 1 * x) by (change (bpow radix2 1) with 2; ring). apply product_is_binary64; [|assumption].
    apply generic_format_bpow. unfold FLT_exp. lia. }
  destruct (add_is _ _ _ _ (exactly_is _ _ IR) (exactly_is _ _ IR) G2 ltac:(rewrite Rabs_pos_eq; lra) ltac:(rewrite Rabs_pos_eq; lra))
    as (e & A1 & A2 & A3 & A4 & _).
  replace (x + x) with (2 * x) in * by ring. rewrite (Rabs_pos_eq (2 * x)) in A4 by lra.
  exists (2 * x), 0, e. split; [exact A1|]. split; [exact A2|]. split; [exact A3|]. split; [unfold share101 in *; lra|].
  split; [rewrite Rabs_R0; apply Rmult_le_pos; lra|]. rewrite Rplus_0_r, Rmult_0_l. apply near_exactly.
Qed.

Lemma face_cosine_2p_holds : forall R w K, parameters R w K -> let x := cosine_of (slope_2p (value32 R) (value32 w)) in
  holds 24 (/ 1000) (face_cosine_2p R w) x /\ / 2 <= x <= 1.
Proof.
  intros R w K Hp. cbv zeta. pose proof (sum_2p_holds _ _ _ Hp) as Hs. pose proof (diameter_holds _ _ _ Hp) as Hd.
  destruct Hp as (_ & HR & Hw & _).
  destruct (face_2p (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (HS & _ & _ & _ & -> & _). set (S := value32 R + _) in *.
  set (x := value32 R) in *.
  assert (Hq : / 2 <= S / (2 * x) <= 1).
  { split; apply Rmult_le_reg_r with (2 * x); try lra; replace (S / (2 * x) * (2 * x)) with S by (field; lra); lra. }
  pose proof (holds_divide _ _ _ _ _ _ _ _ Hs Hd ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as Hc.
  split.
  - apply (holds_more _ _ _ _ _ _ (holds_root _ _ _ _ Hc ltac:(lra) ltac:(lra) ltac:(lra))); lra.
  - set (q := S / (2 * x)) in *. assert (sqrt q * sqrt q = q) by (apply sqrt_sqrt; lra). pose proof (sqrt_pos q). nra.
Qed.

Lemma face_sine_2p_holds : forall R w K, parameters R w K -> let x := sine_of (slope_2p (value32 R) (value32 w)) in
  holds 46 (/ 100) (face_sine_2p R w) x /\ / 40000000 <= x <= 1.
Proof.
  intros R w K Hp. cbv zeta. pose proof (half_holds _ _ _ Hp) as Hh. pose proof (diameter_holds _ _ _ Hp) as Hd.
  destruct (face_cosine_2p_holds _ _ _ Hp) as [Hc HC]. destruct Hp as (_ & HR & Hw & _).
  destruct (face_2p (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (_ & _ & _ & _ & E & ->). rewrite <- E.
  set (x := value32 R) in *. set (c := value32 w / 2) in *. assert (Hcx : / 2000 <= c <= x) by (unfold c; lra).
  set (k := cosine_of _) in *. clearbody c x k.
  assert (Hk : / 2 * (2 * x) <= 2 * x * k <= 1 * (2 * x)) by (rewrite (Rmult_comm (2 * x) k); split; apply Rmult_le_compat_r; lra).
  pose proof (holds_multiply _ _ _ _ _ _ _ _ Hd Hc ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)) as Hm.
  set (b := 2 * x * k) in *.
  assert (HT : / 40000000 <= c / b <= 1) by (split; apply Rmult_le_reg_r with b; try lra; replace (c / b * b) with c by (field; lra);
    lra).
  split; [|exact HT]. apply (holds_more _ _ _ _ _ _ (holds_divide _ _ _ _ _ _ _ _ Hh Hm ltac:(lra) ltac:(lra) ltac:(lra) ltac:(lra)
    ltac:(lra) ltac:(lra) ltac:(lra))); lra.
Qed.

Lemma K_times_is : forall R w K n s a x, parameters R w K -> holds n s a x -> 0 <= n <= 390 -> 0 <= s <= / 10 -> / 60000000 <= x <= 1
  ->
  factor (K_times K a) (value32 K * x).
Proof.
  intros R w K n s a x ((_ & _ & FK) & _ & _ & HK) H Hn Hs Hx. pose proof (holds_exactly _ _ (to64_is_exact K FK) ltac:(lra)) as Hk.
  set (k := value32 K) in *. assert (B : / 1000 * / 60000000 <= k * x <= 1000 * 1) by (split; apply Rmult_le_compat; lra).
  apply (holds_factor (0 + n + 8) (3 * (0 + s) + / 1000000)); [apply holds_multiply; assumption || lra|lra|lra].
Qed.

(* What bump-2p holds is what the theorem on its first stage assumes. *)
Theorem constants_2p_are_right : forall R w K, parameters R w K ->
  constants_2p R w K (hi (height_2p R w)) (lo (height_2p R w)) (split_head (tangent_2p R w)) (split_tail (tangent_2p R w))
    (K_times K (face_sine_2p R w)) (K_times K (face_cosine_2p R w)).
Proof.
  intros R w K Hp. pose proof (linear_2p_is_right _ _ _ Hp) as HL. destruct (face_cosine_2p_holds _ _ _ Hp) as [Hc HC].
  destruct (face_sine_2p_holds _ _ _ Hp) as [Hs HS]. split; [exact HL| |].
  - apply (K_times_is R w K 46 (/ 100)); assumption || lra.
  - apply (K_times_is R w K 24 (/ 1000)); assumption || lra.
Qed.

(* ---- The first stages ---- *)

Definition bump_2p_of (R w K : binary32) (is_fused : bool) : binary64 -> binary64 -> FirstStage :=
  bump_2p is_fused (hi (height_2p R w)) (lo (height_2p R w)) (split_head (tangent_2p R w)) (split_tail (tangent_2p R w))
    (to64 K) (K_times K (face_sine_2p R w)) (K_times K (face_cosine_2p R w)) (half_width w).

(* Every answer of the first stage of bump-2p is right, for every input of the domain. *)
Theorem bump_2p_first_stage_answers_right_for_all : forall is_fused R w K later x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_2p (value32 R) (value32 w) X Z in
  let S := slope_2p (value32 R) (value32 w) in
  right_or_later (evaluate bump_2p_window (bump_2p_of R w K is_fused) later x y z) (later (quantised x) (quantised z)) (0 < M)
    (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros is_fused R w K later x y z Hp Hv. apply bump_2p_first_stage_answers_right; try assumption. now apply constants_2p_are_right.
Qed.

Definition bump_2p_shaded_of (R w K : binary32) (is_fused : bool) : binary64 -> binary64 -> FirstStage :=
  bump_2p_shaded is_fused (hi (height_2p R w)) (lo (height_2p R w)) (split_head (tangent_2p R w)) (split_tail (tangent_2p R w))
    (to64 R) (K_over_R K R) (half_width w).

(* Every answer of the first stage of bump-2p-shaded is right, for every input of the domain. *)
Theorem bump_2p_shaded_first_stage_answers_right_for_all : forall is_fused R w K later x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_2p (value32 R) (value32 w) X Z in
  right_or_later (evaluate bump_2p_shaded_window (bump_2p_shaded_of R w K is_fused) later x y z) (later (quantised x) (quantised z)) (0
    < M)
    (shaded_x (value32 R) (value32 w) (value32 K) X M) (shaded_z (value32 R) (value32 w) (value32 K) X M).
Proof.
  intros is_fused R w K later x y z Hp Hv. apply bump_2p_shaded_first_stage_answers_right; try assumption.
  now apply linear_2p_is_right with K.
Qed.
