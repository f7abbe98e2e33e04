(* SPDX-License-Identifier: BSD-3-Clause *)
(* The force of the first stage of cylinder, off_axis of fast/laws/cylinder.h, from its v = R^2 - rho^2 and its l = z + d. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs.
Open Scope R_scope.

(* v and l, as they stand in the recorded first stage. *)
Definition cylinder_v (is_fused : bool) (anchor anchored rest d_head d_tail x z : binary64) : binary64 :=
  let a := multiply_subtract is_fused x x anchored in
  let a_error := multiply_subtract is_fused x x (minus anchored a) in
  let b := multiply_subtract is_fused z z a in
  let b_error := multiply_subtract is_fused z z (minus a b) in
  let low := plus (plus a_error b_error) (minus rest (times z (times (two_to (1)) d_tail))) in
  plus (multiply_subtract is_fused z (times (two_to (1)) d_head) (minus b anchor)) low.
Definition cylinder_l (d_head d_tail z : binary64) : binary64 := plus (plus z d_head) d_tail.

Lemma computes_sized : forall v n A l h m k, computes v n A l h -> size m k A -> computes v n A m k.
Proof. intros v n A l h m k (a & Hv & Hn & _) Hs. now exists a. Qed.

(* Where one of two terms is exact, and not the smaller, half of the other's error counts. *)
Lemma near_sum_with_larger : forall n R b B, near n b B -> 0 <= n <= 30 -> 0 < B <= R -> near (n / 2 * (101 / 100)) (R + b) (R + B).
Proof.
  intros n R' b B Hb Hn HB. pose proof (near_is_close n b B Hb ltac:(lra)) as C. rewrite (Rabs_pos_eq B) in C by lra.
  apply near_more with (n / 2 * (1 + / 1000) * unit53 * (1 + / 1000) / unit53).
  - apply close_is_near; [|unfold unit53; lra]. replace (R' + b - (R' + B)) with (b - B) by ring. rewrite (Rabs_pos_eq (R' + B)) by lra.
    apply Rle_trans with (1 := C). assert (0 <= n * (1 + / 1000) * unit53) by (unfold unit53; lra). nra.
  - replace (n / 2 * (1 + / 1000) * unit53 * (1 + / 1000) / unit53) with (n / 2 * ((1 + / 1000) * (1 + / 1000))) by (unfold unit53; field).
    apply Rmult_le_compat_l; lra.
Qed.

Lemma near_sum_with_positive : forall n a b B, near n b B -> 0 <= n <= 30 -> 0 <= a -> 0 < B -> near (n * (101 / 100)) (a + b) (a + B).
Proof.
  intros n a b B Hb Hn Ha HB. pose proof (near_is_close n b B Hb ltac:(lra)) as C. rewrite (Rabs_pos_eq B) in C by lra.
  apply near_more with (n * (1 + / 1000) * unit53 * (1 + / 1000) / unit53).
  - apply close_is_near; [|unfold unit53; lra]. replace (a + b - (a + B)) with (b - B) by ring. rewrite (Rabs_pos_eq (a + B)) by lra.
    apply Rle_trans with (1 := C). assert (0 <= n * (1 + / 1000) * unit53) by (unfold unit53; lra). nra.
  - replace (n * (1 + / 1000) * unit53 * (1 + / 1000) / unit53) with (n * ((1 + / 1000) * (1 + / 1000))) by (unfold unit53; field).
    apply Rmult_le_compat_l; lra.
Qed.

(* v is 17/5 units off V at most, and l 201/100 units off L: then F_x is 18 units off at most, and F_z 33/2. *)
Theorem cylinder_force_is_near : forall is_fused R w K anchor anchored rest d_head d_tail axis xv X zv L, parameters R w K ->
  coordinate xv X ->
  let v := cylinder_v is_fused anchor anchored rest d_head d_tail xv zv in
  let first := cylinder is_fused (to64 K) (to64 R) anchor anchored rest d_head d_tail axis xv zv in
  let rho := sqrt (X * X + L * L) in
  let V := value32 R * value32 R - rho * rho in
  computes v (17 / 5) V (-60) 28 -> bpow radix2 (-49) * (value32 R * value32 R) <= V ->
  computes (cylinder_l d_head d_tail zv) (201 / 100) L (-60) 15 ->
  first_contact first = true /\
  good 18 (first_x first) (value32 K * (value32 R - rho) * (X / rho)) /\
  computes (first_z first) (33 / 2) (value32 K * (value32 R - rho) * (L / rho)) (-122) 117.
Proof.
  intros is_fused R w K anchor anchored rest d_head d_tail axis xv X zv L Hp Hx v first rho V Hv HV Hl.
  unfold first, cylinder. cbv zeta. cbn [first_x first_z first_contact].
  fold (cylinder_l d_head d_tail zv). set (l := cylinder_l d_head d_tail zv) in *.
  destruct Hp as ((FR & _ & FK) & HR & _ & HK). destruct Hx as [Hx Fx Rx Sx].
  set (Rad := value32 R) in *. set (k := value32 K) in *.
  assert (IR : is64 (to64 R) Rad) by now apply to64_is_exact.
  assert (CK : computes (to64 K) 0 k (-10) 10) by (apply exactly; [now apply to64_is_exact|now apply size_of_stiffness]).
  assert (H1 : 1 <= one <= 1001 / 1000) by (unfold one; lra).
  assert (HV0 : 0 < V).
  { apply Rlt_le_trans with (2 := HV). apply Rmult_lt_0_compat; [apply bpow_gt_0|apply Rmult_lt_0_compat; lra]. }
  assert (HL0 : L <> 0) by (destruct Hl as (y & _ & _ & S); now apply (size_not_0 _ _ _ S)).
  assert (HLL : 0 < L * L) by nra. assert (HXX : 0 <= X * X) by nra.
  assert (Hrho0 : 0 < rho) by (apply sqrt_lt_R0; lra).
  assert (Hrho2 : rho * rho = X * X + L * L) by (apply sqrt_sqrt; lra).
  assert (HrhoR : rho <= Rad) by (unfold V in HV0; nra).
  (* rho *)
  pose proof (computes_times _ _ _ _ _ _ _ _ _ _ Hl Hl ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as CLL.
  destruct CLL as (ll & Ill & Nll & Sll).
  pose proof (near_sum_with_positive _ (X * X) _ _ Nll ltac:(lra) HXX HLL) as Nsum.
  assert (HXX2 : X * X <= 100000000).
  { replace (X * X) with (Rabs X * Rabs X) by (rewrite <- Rabs_mult; apply Rabs_pos_eq; assumption).
    replace 100000000 with (10000 * 10000) by ring. apply Rmult_le_compat; try assumption; apply Rabs_pos. }
  assert (Hsumsize : size (-120) 28 (X * X + L * L)).
  { apply size_of; [destruct Sll as [S _]; rewrite Rabs_pos_eq in S by lra; change (-60 + -60)%Z with (-120)%Z in S; lra|].
    apply Rle_trans with (Rad * Rad); [rewrite <- Hrho2; nra|]. apply Rle_trans with (10000 * 10000); [nra|simpl; lra]. }
  assert (Csum : computes (multiply_add is_fused xv xv (times l l)) ((201 / 100 + 201 / 100 + one) * (101 / 100) + one) (X * X + L * L)
    (2 * -60) (2 * 14)).
  { exists (nearest64 (X * X + ll)). assert (Ssum : size (-121) 29 (X * X + ll)) by (apply (size_near _ _ _ _ _ Hsumsize Nsum); lra).
    assert (big : forall e, (e <= 1000)%Z -> forall a, Rabs a <= bpow radix2 e -> Rabs a <= bpow radix2 1000).
    { intros e He a Ha. apply Rle_trans with (1 := Ha). now apply bpow_le. }
    assert (Gxx : generic_format radix2 fexp64 (X * X)) by now apply product_is_binary64.
    split; [|split; [|exact Hsumsize]].
    - apply multiply_add_is; try assumption.
      + apply big with 27%Z; [lia|]. rewrite Rabs_pos_eq by assumption. simpl. lra.
      + apply big with 29%Z; [lia|apply Ssum].
    - replace ((201 / 100 + 201 / 100 + one) * (101 / 100) + one) with (one + (201 / 100 + 201 / 100 + one) * (101 / 100)) by ring.
      apply near_then with (X * X + ll); [|assumption]. apply sum_is_near; [assumption|now apply format_of in Ill]. }
  pose proof (computes_root _ _ _ (-60) 14 Csum ltac:(lra) ltac:(lra) ltac:(lia)) as Crho. fold rho in Crho.
  set (n := ((201 / 100 + 201 / 100 + one) * (101 / 100) + one) / 2 + one) in *.
  assert (Hn : 4 <= n <= 404 / 100) by (unfold n; lra).
  (* R + rho *)
  assert (Csum2 : computes (plus (to64 R) (square_root (multiply_add is_fused xv xv (times l l)))) (n / 2 * (101 / 100) + one)
    (Rad + rho) (-4) 15).
  { destruct Crho as (r & Ir & Nr & Sr). exists (nearest64 (Rad + r)).
    pose proof (near_sum_with_larger n Rad r rho Nr ltac:(lra) ltac:(lra)) as N.
    assert (S : size (-4) 15 (Rad + rho)) by (apply size_of; simpl; lra).
    assert (S2 : size (-5) 16 (Rad + r)) by (apply (size_near _ _ _ _ _ S N); lra).
    split; [|split; [|exact S]].
    - apply plus_is; try assumption. apply Rle_trans with (1 := proj2 S2). apply bpow_le. lia.
    - replace (n / 2 * (101 / 100) + one) with (one + n / 2 * (101 / 100)) by ring. apply near_then with (Rad + r); [|assumption].
      apply sum_is_near; [now apply format_of in IR|now apply format_of in Ir]. }
  pose proof (computes_times _ _ _ _ _ _ _ _ _ _ Csum2 Crho ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as Cdown.
  pose proof (computes_times _ _ _ _ _ _ _ _ _ _ CK Hv ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as Cup0.
  assert (Hsign : is_less zero64 v = true).
  { destruct Hv as (v' & Iv & Nv & _). rewrite (less_is _ _ _ _ zero_is Iv). apply Rlt_bool_true. now apply (near_sign _ _ _ Nv). }
  assert (Cup : computes (larger (times (to64 K) v) zero64) (0 + 17 / 5 + one) (k * V) (-10 + -60) (10 + 28)).
  { destruct Cup0 as (u & Iu & Nu & Su). exists u. split; [|split; assumption].
    rewrite <- (Rmax_left u 0); [now apply larger_is; [|apply zero_is]|]. apply Rlt_le, (near_sign _ _ _ Nu).
      apply Rmult_lt_0_compat; lra. }
  pose proof (computes_over _ _ _ _ _ _ _ _ _ _ Cup Cdown ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as Cscale.
  set (scale := over (larger (times (to64 K) v) zero64) _) in Cscale.
  assert (Hscale : k * V / ((Rad + rho) * rho) = k * (Rad - rho) / rho) by (unfold V; field; lra).
  assert (Hlow : bpow radix2 (-62) <= k * V / ((Rad + rho) * rho)).
  { apply Rle_trans with (/ 1000 * (bpow radix2 (-49) * (Rad * Rad)) / (2 * Rad * Rad)).
    - replace (/ 1000 * (bpow radix2 (-49) * (Rad * Rad)) / (2 * Rad * Rad)) with (/ 2000 * bpow radix2 (-49)) by (field; lra). simpl. lra.
    - unfold Rdiv. apply Rmult_le_compat.
      + apply Rmult_le_pos; [lra|]. apply Rmult_le_pos; [apply bpow_ge_0|nra].
      + apply Rlt_le, Rinv_0_lt_compat. nra.
      + apply Rmult_le_compat; try lra. apply Rmult_le_pos; [apply bpow_ge_0|nra].
      + apply Rinv_le; nra. }
  assert (Sscale : size (-62) 102 (k * V / ((Rad + rho) * rho))).
  { split; [|destruct Cscale as (sc & _ & _ & [_ S]); apply Rle_trans with (1 := S); apply bpow_le; lia].
    rewrite Rabs_pos_eq; [exact Hlow|]. apply Rle_trans with (2 := Hlow). apply bpow_ge_0. }
  apply computes_sized with (2 := Sscale) in Cscale.
  split; [exact Hsign|]. split.
  - replace (k * (Rad - rho) * (X / rho)) with (k * V / ((Rad + rho) * rho) * X) by (rewrite Hscale; field; lra).
    destruct Sx as [->|Sx].
    + rewrite Rmult_0_r. apply zero_is_good. destruct Cscale as (sc & Isc & _).
      replace 0 with (nearest64 (sc * 0)) by (rewrite Rmult_0_r; apply round_0; auto with typeclass_instances).
      refine (times_is scale xv sc 0 Isc Hx _). rewrite Rmult_0_r, Rabs_R0. apply bpow_ge_0.
    + pose proof (computes_times _ _ _ _ _ _ _ _ _ _ Cscale (exactly _ _ _ _ Hx Sx) ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as C.
      refine (computed_is_good 18 _ _ _ _ _ C _ _ _ _); try lra; lia.
  - replace (k * (Rad - rho) * (L / rho)) with (k * V / ((Rad + rho) * rho) * L) by (rewrite Hscale; field; lra).
    pose proof (computes_times _ _ _ _ _ _ _ _ _ _ Cscale Hl ltac:(lra) ltac:(lra) ltac:(lia) ltac:(lia)) as C.
    apply (computes_more _ _ _ _ _ _ _ _ C); [lra|lia|lia].
Qed.
