(* SPDX-License-Identifier: BSD-3-Clause *)
(* rho and the force that the second stage of cylinder computes in double-double where v is found positive: exact() of
   fast/laws/cylinder.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import CylinderFirst.
From Forceshade Require Import CylinderAnswers DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures.
From Forceshade Require Import EnclosedProducts EnclosedQuotients BesideTie EnclosedSums SecondStage SecondAlong TwoPolygonsGap Contained.
From Forceshade Require Import CylinderSecondParts CylinderSecondBorder.
Open Scope R_scope.

Definition second_rho (R w : binary32) (xv zv : binary64) : double_double :=
  root_of (add (multiply (exactly64 xv) (exactly64 xv)) (multiply (second_l R w zv) (second_l R w zv))).
Definition second_scale (R w K : binary32) (xv zv : binary64) : double_double :=
  divide (multiply (exactly64 (to64 K)) (second_v R w xv zv))
    (multiply (add (exactly64 (to64 R)) (second_rho R w xv zv)) (second_rho R w xv zv)).

(* ---- l ---- *)

(* l is 0 and both terms are, or its bound is a small share of it. *)
Lemma l_is : forall R w K zv Z, parameters R w K -> coordinate zv Z -> let L := Z + axis_depth (value32 R) (value32 w) in
  let l := second_l R w zv in Rabs L <= 20000 /\
  (L = 0 /\ nothing l /\ value64 (error l) <= / 100000000000000000000000 \/
   / 20000000000000000000000000000 <= Rabs L /\ exists t, 0 <= t <= 12 / 10000000 /\ encloses t l L).
Proof.
  intros R w K zv Z Hp Cz L l. pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  destruct (l_is_near R w K zv Z Hp Cz) as [[C E N A] BL]. set (d := axis_depth (value32 R) (value32 w)) in *. fold L in C, E, N, A, BL.
  destruct (depth_enclosed R w K Hp) as [_ Bd]. fold d in Bd. assert (Bd2 : 0 <= d <= 10000) by lra. clear Bd.
  split; [exact BL|]. fold l in C, E, N.
  assert (Bsd : 0 <= share101 * d <= / 1000000000000000000000000000000 * 10000) by (split;
    [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
  pose proof (Rabs_pos L) as PL.
  destruct (Req_dec L 0) as [L0|L0].
  - left. split; [exact L0|]. split; [now apply N|]. rewrite L0, Rabs_R0, Rmult_0_r in E. lra.
  - right. destruct A as [A|[A1 A2]]; [contradiction|]. split; [exact A2|].
    assert (BsL : share101 * Rabs L <= / 1000000000 * Rabs L) by (apply Rmult_le_compat_r; lra).
    set (g := 141 * (share101 * d + tiny) + 3 * (share101 * Rabs L)) in *.
    assert (Hg : 0 <= g <= 106 / 100000000 * Rabs L).
    { assert (0 <= share101 * Rabs L) by (apply Rmult_le_pos; lra). unfold g. split; lra. }
    exists (102 / 100 * (g / Rabs L)). split; [|apply contained_is_enclosed; trivial; lra].
    assert (0 <= g / Rabs L <= 106 / 100000000); [|lra]. split; [apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]|].
    apply Rmult_le_reg_r with (Rabs L); [lra|]. unfold Rdiv at 1. rewrite Rmult_assoc, Rinv_l, Rmult_1_r; lra.
Qed.

(* ---- rho ---- *)

Lemma squares_of_distance : forall R w K xv X zv Z, parameters R w K -> coordinate xv X -> coordinate zv Z ->
  let L := Z + axis_depth (value32 R) (value32 w) in X <> 0 \/ L <> 0 ->
  encloses (25 / 1000000) (add (multiply (exactly64 xv) (exactly64 xv)) (multiply (second_l R w zv) (second_l R w zv))) (X * X + L * L).
Proof.
  intros R w K xv X zv Z Hp Cx Cz L Hne. pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  destruct (l_is R w K zv Z Hp Cz) as [BL Hl]. fold L in BL, Hl. set (l := second_l R w zv) in *.
  pose proof (coordinate_range _ _ Cx) as BX. pose proof (coordinate_is _ _ Cx) as Ix.
  assert (LX : X = 0 \/ / 2000000000000000000 <= X * X).
  { destruct (coordinate_not_tiny _ _ Cx) as [H|H]; [now left|right]. simpl in H.
    rewrite <- (Rabs_pos_eq (X * X)), Rabs_mult by apply Rle_0_sqr.
    apply Rle_trans with (/ 1073741824 * / 1073741824); [lra|apply Rmult_le_compat; lra]. }
  assert (BXX : 0 <= X * X <= 100000000).
  { split; [apply Rle_0_sqr|]. rewrite <- (Rabs_pos_eq (X * X)), Rabs_mult by apply Rle_0_sqr.
    replace 100000000 with (10000 * 10000) by ring.
    apply Rmult_le_compat; try apply Rabs_pos; lra. }
  assert (Ex : encloses 0 (exactly64 xv) X) by now apply encloses_exact, exactly_is.
  assert (Exx : encloses (3 * share101) (multiply (exactly64 xv) (exactly64 xv)) (X * X)).
  { apply encloses_more with (3 * (0 + 0) + 3 * share101); [|lra]. apply encloses_multiply; trivial; try lra.
    destruct LX as [LX|LX]; [now left|right; right]. rewrite Rabs_pos_eq; lra. }
  destruct Hl as [(L0 & Nl & El)|(LL & t & Ht & Et)].
  - destruct Hne as [HX|HL]; [|contradiction]. destruct LX as [LX|LX]; [contradiction|].
    assert (Nl2 := Nl). destruct Nl2 as (H & Lo & f & F & Hf). rewrite (proj1 F) in El.
    destruct (multiply_nothing l l 0 0 f H Lo F ltac:(rewrite Rabs_R0; lra) ltac:(lra) Nl ltac:(rewrite (proj1 F); lra)) as [Nll Ell].
    rewrite (proj1 F), Rabs_R0, Rplus_0_l in Ell.
    assert (Bff : 0 <= f * f <= / 100000000000000000000000 * / 100000000000000000000000) by (split; [apply Rmult_le_pos;
        lra|apply Rmult_le_compat; lra]).
    pose proof (nothing_contains _ Nll) as Cll. destruct Nll as ([Hll _] & _).
    assert (Cxx : contains (multiply (exactly64 xv) (exactly64 xv)) (X * X)).
    { apply (enclosed_is_contained _ _ _ Exx); [lra|rewrite Rabs_pos_eq; lra]. }
    pose proof (first_size _ _ _ Exx ltac:(lra)) as Sxx. pose proof (enclosed_error _ _ _ Exx) as Dxx.
    rewrite (Rabs_pos_eq (X * X)) in Sxx by lra.
    set (xx := multiply (exactly64 xv) (exactly64 xv)) in *. set (ll := multiply l l) in *.
    set (p := Rabs (value64 (hi xx))) in *.
    assert (Bsp : 3 * share101 * p <= / 10000000000000 * (X * X)).
    { apply Rle_trans with (3 * share101 * (101 / 100 * (X * X))); [apply Rmult_le_compat_l; lra|].
      replace (3 * share101 * (101 / 100 * (X * X))) with (303 / 100 * share101 * (X * X)) by field. apply Rmult_le_compat_r; lra. }
    assert (C : contains (add xx ll) (X * X + 0)).
    { apply sum_of_contained; trivial; try lra; [fold p; lra|rewrite Hll, Rabs_R0; lra|right; left; fold p; lra]. }
    pose proof (sum_error _ _ _ _ _ Cxx Cll C ltac:(lra) ltac:(lra)) as Er. cbv zeta in Er.
    destruct (contained_size _ _ C) as (Pe & Sh & _ & _). rewrite Rplus_0_r in C, Sh. rewrite (Rabs_pos_eq (X * X)) in Sh by lra.
    set (h := Rabs (value64 (hi (add xx ll)))) in *. set (e := value64 (error (add xx ll))) in *.
    assert (share101 * h <= / 10000000000000 * (X * X) + / 10000000000000 * e).
    { apply Rle_trans with (share101 * (1001 / 1000 * (X * X + e))); [apply Rmult_le_compat_l; lra|].
      assert (share101 * (X * X) <= / 1000000000000000 * (X * X)) by (apply Rmult_le_compat_r; lra).
      assert (share101 * e <= / 1000000000000000 * e) by (apply Rmult_le_compat_r; lra). lra. }
    rewrite L0, Rmult_0_r, Rplus_0_r.
    assert (HXX : X * X <> 0) by lra.
    pose proof (contained_is_enclosed _ _ (/ 1000000000000 * (X * X)) C HXX) as Ee. rewrite (Rabs_pos_eq (X * X)) in Ee by lra.
    apply encloses_more with (1 := Ee ltac:(fold e; lra) ltac:(lra)).
    replace (/ 1000000000000 * (X * X) / (X * X)) with (/ 1000000000000) by (field; lra). lra.
  - pose proof (first_size _ _ _ Et ltac:(lra)) as Sl. set (h := Rabs (value64 (hi l))) in *. pose proof (Rabs_pos L) as PL.
    assert (ELL : L * L = Rabs L * Rabs L) by (rewrite <- Rabs_mult; symmetry; apply Rabs_pos_eq, Rle_0_sqr).
    assert (BLL : / 20000000000000000000000000000 * / 20000000000000000000000000000 <= Rabs L * Rabs L <= 20000 * 20000).
    { split; apply Rmult_le_compat; lra. }
    assert (Hh : 98 / 100 * (Rabs L * Rabs L) <= h * h <= 103 / 100 * (Rabs L * Rabs L)).
    { split.
      - apply Rle_trans with ((99 / 100 * Rabs L) * (99 / 100 * Rabs L)); [lra|apply Rmult_le_compat; lra].
      - apply Rle_trans with ((101 / 100 * Rabs L) * (101 / 100 * Rabs L)); [apply Rmult_le_compat; lra|lra]. }
    assert (Htt : t * t <= / 1000 * (t + t)).
    { apply Rle_trans with (t * / 1000); [apply Rmult_le_compat_l; lra|lra]. }
    destruct (multiply_encloses t t _ _ _ _ Et Et ltac:(lra) ltac:(lra) Htt) as (Ell & _ & _).
    { fold h. right. lra. }
    rewrite <- ELL in BLL.
    apply encloses_more with (3 * (3 * share101 + (3 * (t + t) + 3 * share101)) + 3 * share101); [|lra].
    apply encloses_add; trivial; try lra. destruct LX as [->|LX]; [left; ring|right; lra].
Qed.

Lemma rho_enclosed : forall R w K xv X zv Z, parameters R w K -> coordinate xv X -> coordinate zv Z ->
  let L := Z + axis_depth (value32 R) (value32 w) in let rho := distance_from_axis (value32 R) (value32 w) X Z in X <> 0 \/ L <> 0 ->
  encloses (76 / 1000000) (second_rho R w xv zv) rho /\ Rabs X <= rho /\ Rabs L <= rho /\
  / 20000000000000000000000000000 <= rho <= 30000.
Proof.
  intros R w K xv X zv Z Hp Cx Cz L rho Hne. pose proof share_is_small as Hsh.
  pose proof (squares_of_distance R w K xv X zv Z Hp Cx Cz Hne) as Es. fold L in Es.
  destruct (l_is R w K zv Z Hp Cz) as [BL Hl]. fold L in BL, Hl. pose proof (coordinate_range _ _ Cx) as BX.
  assert (size : forall Y Y', Rabs Y <= sqrt (Y * Y + Y' * Y')).
  { intros Y Y'. rewrite <- (sqrt_Rsqr_abs Y). apply sqrt_le_1_alt. unfold Rsqr. pose proof (Rle_0_sqr Y') as S. unfold Rsqr in S. lra. }
  assert (SX : Rabs X <= rho) by apply size. assert (SL : Rabs L <= rho).
  { unfold rho, distance_from_axis. fold L. rewrite Rplus_comm. apply size. }
  assert (Low : / 20000000000000000000000000000 <= rho).
  { destruct Hl as [(L0 & _)|(LL & _)]; [|lra]. destruct (coordinate_not_tiny _ _ Cx) as [H|H]; [tauto|]. simpl in H. lra. }
  destruct (distance_squared (value32 R) (value32 w) X Z) as [P Q]. fold rho in P, Q. fold L in Q.
  assert (square : forall a b, Rabs a <= b -> a * a <= b * b).
  { intros a b H. rewrite <- (Rabs_pos_eq (a * a)), Rabs_mult by apply Rle_0_sqr. apply Rmult_le_compat; try apply Rabs_pos; exact H. }
  pose proof (square X 10000 BX) as BXX. pose proof (square L 20000 BL) as BLL.
  assert (Lrr : / 20000000000000000000000000000 * / 20000000000000000000000000000 <= rho * rho) by (apply Rmult_le_compat; lra).
  split; [|split; [exact SX|split; [exact SL|split; [exact Low|]]]].
  - apply encloses_more with (3 * (25 / 1000000) + 3 * share101); [|lra]. apply encloses_root; [exact Es|lra|right; fold L; lra].
  - apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. lra.
Qed.

(* ---- The force over |(x, l)| ---- *)

(* v inside of the cylinder. *)
Lemma inside_v : forall R w K xv X zv Z, parameters R w K -> coordinate xv X -> coordinate zv Z ->
  let rho := distance_from_axis (value32 R) (value32 w) X Z in let v := second_v R w xv zv in
  rho < value32 R -> sign_of v = is_positive ->
  encloses 1 v (value32 R * value32 R - rho * rho) /\
  / 100000000000000000000000000000000000000000000000000 <= value64 (hi v) <= 1003 / 1000 * (value32 R * value32 R).
Proof.
  intros R w K xv X zv Z Hp Cx Cz rho v Hin Pos. pose proof share_is_small as Hsh. pose proof tiny_is_tinier as Htiny.
  destruct (second_v_is R w K xv X zv Z Hp Cx Cz) as (C & E & Low). fold v in C, E, Low. specialize (Low Pos).
  destruct (distance_squared (value32 R) (value32 w) X Z) as [P Q]. fold rho in P, Q.
  pose proof Hp as (_ & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2].
  set (d := axis_depth (value32 R) (value32 w)) in *. set (c := value32 w / 2) in *. set (Rad := value32 R) in *.
  assert (EV : (c - X) * (c + X) - Z * (Z + d + d) = Rad * Rad - rho * rho).
  { rewrite Q. replace (Rad * Rad) with (d * d + c * c) by lra. ring. }
  rewrite EV in C. pose proof (positive_encloses _ _ C Pos) as [E1 _]. split; [exact E1|]. split; [exact Low|].
  set (RR := Rad * Rad) in *. assert (BRR : / 100 <= RR) by (unfold RR; replace (/ 100) with (/ 10 * / 10) by field;
    apply Rmult_le_compat; lra).
  assert (Brr : 0 <= rho * rho <= RR) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
  assert (small : forall Y Y', Y * Y + Y' * Y' = rho * rho -> Rabs Y <= Rad).
  { intros Y Y' H. rewrite <- (Rabs_pos_eq Rad) by lra. apply Rsqr_le_abs_0. unfold Rsqr. fold RR.
    pose proof (Rle_0_sqr Y') as S. unfold Rsqr in S. lra. }
  pose proof (small X (Z + d) (eq_sym Q)) as BX. pose proof (small (Z + d) X ltac:(lra)) as BL.
  assert (BdR : d <= Rad).
  { apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. fold RR. rewrite Hd2. pose proof (Rle_0_sqr c) as S. unfold Rsqr in S. lra. }
  pose proof (Rabs_triang (Z + d) (- d)) as TZ. replace (Z + d + - d) with Z in TZ by ring. rewrite Rabs_Ropp in TZ.
  pose proof (Rabs_triang (Z + d) d) as TM. rewrite (Rabs_pos_eq d) in TZ, TM by lra.
  assert (Hc : 0 <= c <= Rad) by (unfold c; lra).
  assert (BA : Rabs ((c - X) * (c + X)) <= 4 * RR).
  { pose proof (minus_size c X). pose proof (Rabs_triang c X). rewrite (Rabs_pos_eq c) in * by lra.
    rewrite Rabs_mult. replace (4 * RR) with (2 * Rad * (2 * Rad)) by (unfold RR; ring). apply Rmult_le_compat; try apply Rabs_pos; lra. }
  assert (BZ : Rabs Z * (d + Rabs (Z + d + d)) <= 6 * RR).
  { replace (6 * RR) with (2 * Rad * (3 * Rad)) by (unfold RR; ring). pose proof (Rabs_pos (Z + d + d)).
    apply Rmult_le_compat; [apply Rabs_pos|lra|lra|lra]. }
  assert (S1 : share101 * Rabs ((c - X) * (c + X)) <= / 1000000000000 * RR).
  { apply Rle_trans with (share101 * (4 * RR)); [apply Rmult_le_compat_l; lra|].
    replace (share101 * (4 * RR)) with (4 * share101 * RR) by ring. apply Rmult_le_compat_r; lra. }
  assert (S2 : share101 * (Rabs Z * (d + Rabs (Z + d + d))) <= / 1000000000000 * RR).
  { apply Rle_trans with (share101 * (6 * RR)); [apply Rmult_le_compat_l; lra|].
    replace (share101 * (6 * RR)) with (6 * share101 * RR) by ring. apply Rmult_le_compat_r; lra. }
  destruct (contained_size _ _ C) as (_ & S & _ & _). rewrite (Rabs_pos_eq (RR - rho * rho)) in S by lra.
  pose proof (Rle_abs (value64 (hi v))). lra.
Qed.

Theorem scale_enclosed : forall R w K xv X zv Z, parameters R w K -> coordinate xv X -> coordinate zv Z ->
  let L := Z + axis_depth (value32 R) (value32 w) in let rho := distance_from_axis (value32 R) (value32 w) X Z in
  let scale := second_scale R w K xv zv in X <> 0 \/ L <> 0 -> rho < value32 R -> sign_of (second_v R w xv zv) = is_positive ->
  encloses (19 / 2) scale (value32 K * (value32 R - rho) / rho) /\
  / 100000000000000000000000000000000000000000000000000000000000000 <= Rabs (value64 (hi scale)) /\
  Rabs (value64 (hi scale)) * rho <= 11000000.
Proof.
  intros R w K xv X zv Z Hp Cx Cz L rho scale Hne Hin Pos. pose proof share_is_small as Hsh. unfold second_scale in scale.
  destruct (inside_v R w K xv X zv Z Hp Cx Cz Hin Pos) as [Ev Bv]. fold rho in Ev.
  destruct (rho_enclosed R w K xv X zv Z Hp Cx Cz Hne) as (Er & _ & _ & Br). fold rho in Er, Br.
  destruct Hp as ((FR & _ & FK) & HR & Hw & HK). set (v := second_v R w xv zv) in *. set (r := second_rho R w xv zv) in *.
  assert (IR : encloses 0 (exactly64 (to64 R)) (value32 R)) by (apply encloses_exact, exactly_is; now apply to64_is_exact).
  pose proof (to64_is_exact K FK) as VK.
  assert (IK : encloses 0 (exactly64 (to64 K)) (value32 K)) by now apply encloses_exact, exactly_is.
  set (Rad := value32 R) in *. set (k := value32 K) in *. set (RR := Rad * Rad) in *.
  assert (BRR : / 100 <= RR <= 100000000).
  { unfold RR. split; [replace (/ 100) with (/ 10 * / 10) by field|replace 100000000 with (10000 * 10000) by ring];
    apply Rmult_le_compat; lra. }
  assert (E1 : encloses (229 / 1000000) (add (exactly64 (to64 R)) r) (Rad + rho)).
  { apply encloses_more with (3 * (0 + 76 / 1000000) + 3 * share101); [|lra]. apply encloses_add; trivial; try lra; right; lra. }
  pose proof (first_size _ _ _ E1 ltac:(lra)) as S1. pose proof (first_size _ _ _ Er ltac:(lra)) as S2.
  rewrite (Rabs_pos_eq (Rad + rho)) in S1 by lra. rewrite (Rabs_pos_eq rho) in S2 by lra.
  set (a := Rabs (value64 (hi (add (exactly64 (to64 R)) r)))) in *. set (b := Rabs (value64 (hi r))) in *.
  assert (Brr : / 10 * / 20000000000000000000000000000 <= (Rad + rho) * rho <= 20000 * 10000) by (split; apply Rmult_le_compat; lra).
  assert (Bab : 98 / 100 * ((Rad + rho) * rho) <= a * b <= 103 / 100 * ((Rad + rho) * rho)).
  { split.
    - apply Rle_trans with ((99 / 100 * (Rad + rho)) * (99 / 100 * rho)); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with ((101 / 100 * (Rad + rho)) * (101 / 100 * rho)); [apply Rmult_le_compat; lra|lra]. }
  destruct (multiply_encloses (229 / 1000000) (76 / 1000000) _ _ _ _ E1 Er ltac:(lra) ltac:(lra) ltac:(lra)) as (E2 & _ & S3).
  { fold a b. right. lra. }
  fold a b in S3. set (D := multiply (add (exactly64 (to64 R)) r) r) in *. set (dd := Rabs (value64 (hi D))) in *.
  assert (Ekv : Rabs (value64 (hi (exactly64 (to64 K)))) * Rabs (value64 (hi v)) = k * value64 (hi v)).
  { cbn [exactly64 hi]. rewrite (proj1 VK). fold k. rewrite !Rabs_pos_eq by lra. reflexivity. }
  assert (Bkv : / 1000 * / 100000000000000000000000000000000000000000000000000 <= k * value64 (hi v) <= 1003 / 1000 * (k * RR)).
  { split; [apply Rmult_le_compat; lra|]. replace (1003 / 1000 * (k * RR)) with (k * (1003 / 1000 * RR)) by ring.
    apply Rmult_le_compat_l; lra. }
  assert (BkRR : 0 <= k * RR <= 1000 * 100000000) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
  destruct (multiply_encloses 0 1 _ _ _ _ IK Ev ltac:(lra) ltac:(lra) ltac:(lra)) as (E3 & _ & S4).
  { rewrite Ekv. right. lra. }
  rewrite Ekv in S4. set (N := multiply (exactly64 (to64 K)) v) in *. set (n := Rabs (value64 (hi N))) in *.
  assert (Bdd : 970 / 1000 * ((Rad + rho) * rho) <= dd <= 105 / 100 * ((Rad + rho) * rho)) by lra.
  assert (Idd : 0 < dd) by lra. assert (Bnd : n / dd * dd = n) by (field; lra).
  assert (Bq : / 1000000000000000000000000000000000000000000000000000000000000 * / 50 <= n / dd <=
    1000000000000000000000000000000000000000000).
  { split; apply Rmult_le_reg_r with dd; lra. }
  destruct (divide_encloses (3 * (0 + 1) + 3 * share101) (3 * (229 / 1000000 + 76 / 1000000) + 3 * share101) N D _ _ E3 E2) as [E4 S5];
    [lra|lra|fold n; lra|fold dd; lra|fold n dd; lra|].
  fold n dd in S5. fold scale in E4, S5. set (q := n / dd) in *.
  assert (E5 : k * (RR - rho * rho) / ((Rad + rho) * rho) = k * (Rad - rho) / rho) by (unfold RR; field; lra).
  rewrite E5 in E4. split; [apply encloses_more with (1 := E4); lra|]. split; [lra|].
  apply Rle_trans with (101 / 100 * q * rho); [apply Rmult_le_compat_r; lra|].
  (* n / dd * rho, where dd is not much below Rad rho *)
  apply Rmult_le_reg_r with Rad; [lra|].
  assert (Bqd : q * (97 / 100 * (Rad * rho)) <= n).
  { rewrite <- Bnd. assert (0 <= rho * rho) by (apply Rmult_le_pos; lra). apply Rmult_le_compat_l; lra. }
  assert (BkR : k * RR <= 10000000 * Rad).
  { unfold RR. replace (k * (Rad * Rad)) with (k * Rad * Rad) by ring. apply Rmult_le_compat_r; [lra|].
    replace 10000000 with (1000 * 10000) by ring. apply Rmult_le_compat; lra. }
  replace (101 / 100 * q * rho * Rad) with (101 / 97 * (q * (97 / 100 * (Rad * rho)))) by field. lra.
Qed.
