(* SPDX-License-Identifier: BSD-3-Clause *)
(* Operations in double-double on numbers of which no more is known than that they contain the exact number: their bounds, and when
   these are a share of the number again. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts.
From Forceshade Require Import EnclosedQuotients BesideTie SumOfTwo EnclosedSums SecondAlong.
Open Scope R_scope.

Lemma contained_size : forall a x, contains a x -> let h := Rabs (value64 (hi a)) in let e := value64 (error a) in
  0 <= e /\ h <= 1001 / 1000 * (Rabs x + e) /\ Rabs x <= h + unit53 * h + e /\ h <= 1000000000000.
Proof.
  intros a x (h & l & e & H & L & E & Bl & He & B & Bh). cbv zeta. rewrite (proj1 H), (proj1 E).
  pose proof (unit_times _ (Rabs_pos h)) as U. pose proof (size_by (h + l) x) as S1. pose proof (size_by h (h + l)) as S2.
  replace (h - (h + l)) with (- l) in S2 by ring. rewrite Rabs_Ropp in S2. pose proof (size_by x (h + l)) as S3.
  rewrite (Rabs_minus_sym x) in S3. pose proof (Rabs_triang h l) as T. lra.
Qed.

Lemma contained_is_enclosed : forall a x g, contains a x -> x <> 0 -> value64 (error a) <= g -> g <= / 2000 * Rabs x ->
  encloses (102 / 100 * (g / Rabs x)) a x.
Proof.
  intros a x g C Hx Hg Hgx. destruct (contained_size a x C) as (He & _ & S & _). pose proof (Rabs_pos_lt _ Hx) as Px.
  destruct C as (h & l & e & H & L & E & Bl & _ & B & Bh). rewrite (proj1 H), (proj1 E) in *. pose proof (unit_times _ (Rabs_pos h)) as U.
  exists h, l, e. repeat (split; [assumption|]). split; [|exact B]. split; [exact He|].
  apply Rle_trans with (1 := Hg). replace g with (g / Rabs x * Rabs x) at 1 by (field; lra).
  replace (102 / 100 * (g / Rabs x) * Rabs h) with (g / Rabs x * (102 / 100 * Rabs h)) by ring.
  apply Rmult_le_compat_l; [apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]|lra].
Qed.

Lemma sum_error : forall a b x y z, contains a x -> contains b y -> contains (add a b) z ->
  value64 (error a) <= 1000000000000000000000000000000000000000 -> value64 (error b) <= 1000000000000000000000000000000000000000 ->
  let E := value64 (error a) + value64 (error b) in
  E <= value64 (error (add a b)) <= 21 / 10 * E + 21 / 10 * (share101 * Rabs (value64 (hi (add a b)))) + 10 * tiny.
Proof.
  intros a b x y z (h & l & e & H & L & E & _ & He & _) (c & k & f & H' & L' & E' & _ & Hf & _)
    (p & q & g & P & Q & G & _ & Hg & _ & Bp) Be Bf.
  rewrite (proj1 E) in Be. rewrite (proj1 E') in Bf. cbv zeta. rewrite (proj1 E), (proj1 E'), (proj1 P), (proj1 G).
  pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  destruct (error_of_two (hi (add a b)) p (error a) (error b) e f P ltac:(lra) E E' ltac:(lra) ltac:(lra)) as (g1 & G1 & B1).
  destruct (plus_close _ _ _ _ E E' ltac:(rewrite !Rabs_pos_eq; lra)) as [I C]. rewrite (Rabs_pos_eq (e + f)) in C by lra.
  pose proof (unit_times (e + f) ltac:(lra)) as Uef. pose proof (proj1 (rounded_up (e + f) (e + f) ltac:(lra))) as N1.
  set (r := nearest64 (e + f)) in *. apply Rabs_le_inv in C.
  destruct (error_of_is (hi (add a b)) p _ r (1001 / 1000 * (e + f)) P I ltac:(lra) ltac:(lra) ltac:(lra)) as (g2 & G2 & B2 & _).
  change (error_of (hi (add a b)) (plus (error a) (error b))) with (error (add a b)) in G1, G2.
  rewrite (is64_same _ _ _ G1 G) in B1. rewrite (is64_same _ _ _ G2 G) in B2.
  assert (0 <= share101 * Rabs p) by (apply Rmult_le_pos; [unfold share101; lra|apply Rabs_pos]). lra.
Qed.

(* ---- Nothing but an error ---- *)

Definition nothing (a : double_double) : Prop := is64 (hi a) 0 /\ is64 (lo a) 0 /\ exists f, is64 (error a) f /\ 0 <= f.

Lemma nothing_contains : forall a, nothing a -> contains a 0.
Proof.
  intros a (H & L & f & F & Hf). exists 0, 0, f. repeat (split; [assumption|]). rewrite Rabs_R0. split; [lra|]. split; [exact Hf|].
  rewrite nothing_off by ring. lra.
Qed.

Lemma multiply_nothing : forall a b h l e, is64 (hi a) h -> is64 (lo a) l -> is64 (error a) e ->
  Rabs h <= 1000000000000000000000000000000 -> 0 <= e <= 1000000000000000000000000000000 -> nothing b -> value64 (error b) <= 1 ->
  nothing (multiply a b) /\ value64 (error (multiply a b)) <= 3 * ((Rabs h + e) * value64 (error b)) + 100 * tiny.
Proof.
  intros a b h l e H L E Bh Be (H' & L' & f & E' & Hf) Bf. rewrite (proj1 E') in Bf. rewrite (proj1 E'). pose proof unit_is_small as Hu.
  pose proof tiny_is_tinier as Htiny.
  destruct (product_with_zero _ _ _ _ _ _ _ _ H L H' L' ltac:(now right)) as [P Q]. pose proof (Rabs_pos h) as Ph.
  set (P1 := Rabs h * f). set (P3 := e * f).
  assert (B1 : 0 <= P1 <= Rabs h * 1) by (unfold P1; split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_l; lra]).
  assert (B3 : 0 <= P3 <= e * 1) by (unfold P3; split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_l; lra]).
  pose proof (times_is _ _ _ _ (absolute_is _ _ H) E' ltac:(apply big_enough; fold P1; rewrite Rabs_pos_eq; lra)) as J1.
  pose proof (absolute_is _ _ H') as A0. rewrite Rabs_R0 in A0.
  assert (J2 : is64 (times (absolute (hi b)) (error a)) 0) by (apply (times_exact _ _ 0 e); trivial; [ring|apply generic_format_0|apply
    zero_is_not_too_large]).
  pose proof (times_is _ _ _ _ E E' ltac:(apply big_enough; fold P3; rewrite Rabs_pos_eq; lra)) as J3. fold P1 in J1. fold P3 in J3.
  pose proof (rounded_near P1 (proj1 B1)) as R1. pose proof (rounded_near P3 (proj1 B3)) as R3.
  pose proof (proj1 (rounded_up P1 P1 ltac:(lra))) as N1. pose proof (proj1 (rounded_up P3 P3 ltac:(lra))) as N3.
  pose proof (unit_times P1 (proj1 B1)) as U1. pose proof (unit_times P3 (proj1 B3)) as U3.
  set (v1 := nearest64 P1) in *. set (v3 := nearest64 P3) in *.
  assert (J4 : is64 (plus (times (absolute (hi a)) (error b)) (times (absolute (hi b)) (error a))) v1).
  { apply (plus_exact _ _ v1 0); trivial; [ring|exact (format_of _ _ J1)|apply big_enough; rewrite Rabs_pos_eq; lra]. }
  pose proof (plus_is _ _ _ _ J4 J3 ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J5.
  pose proof (rounded_near (v1 + v3) ltac:(lra)) as R5. pose proof (proj1 (rounded_up (v1 + v3) (v1 + v3) ltac:(lra))) as N5.
  pose proof (unit_times (v1 + v3) ltac:(lra)) as U5. set (v := nearest64 (v1 + v3)) in *.
  destruct (error_of_is _ 0 _ v v P J5 ltac:(lra) ltac:(lra) ltac:(rewrite Rabs_R0; lra)) as (g & G & Bg & _).
  rewrite Rabs_R0, Rmult_0_r in Bg. unfold multiply, nothing, rounded. cbn [hi lo error]. split.
  - split; [exact P|]. split; [exact Q|]. exists g. split; [exact G|lra].
  - rewrite (proj1 G). replace ((Rabs h + e) * f) with (P1 + P3) by (unfold P1, P3; ring). lra.
Qed.

(* A share of the first term bounds the error. *)
Lemma enclosed_error : forall s a x, encloses s a x -> value64 (error a) <= s * Rabs (value64 (hi a)).
Proof. intros s a x (h & l & e & H & _ & E & _ & Be & _). rewrite (proj1 H), (proj1 E). exact (proj2 Be). Qed.
