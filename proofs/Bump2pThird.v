(* SPDX-License-Identifier: BSD-3-Clause *)
(* The third stage of bump-2p: exact() of fast/laws/bump_2p.h with numbers of 2048 bits. Its answer is right, and so is every answer of
   the law. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Evaluate Inputs Polygons TwoPolygonsConstants TwoPolygonsGap.
From Forceshade Require Import SecondStage SecondAlong Separation SeparationOfSides SeparationOfContact.
From Forceshade Require Import Bump2pSecond.
From Forceshade Require Import BigFloat BigFloatValues BigFloatRight BigFloatTight ThirdAlong TwoPolygonsThird.
Open Scope R_scope.

Definition bump_2p_third (R w K x z : binary32) : evaluation :=
  if is_beside w x then along_big 2048 K (number (opp (to64 z))) (number zero64) (number (two_to 0))
  else along_big 2048 K (side_gap_third R w x z) (if is_less32 x zero32 then negated (sine_third R w) else sine_third R w)
    (cosine_third R w).

Lemma large_component : forall K g n, / 1000 <= K <= 1000 -> bpow radix2 (-300) <= g -> n = 0 \/ bpow radix2 (-40) <= Rabs n ->
  g * Rabs n <= 20000 -> K * g * n = 0 \/ bpow radix2 (-990) <= Rabs (K * g * n) <= bpow radix2 25.
Proof.
  intros K g n HK Lg Hn U. apply (component_is_large K g n 15); try assumption.
  - apply Rle_trans with (2 := Lg). apply bpow_le. lia.
  - apply Rle_trans with (1 := U). simpl. lra.
Qed.

(* The plane beside a bump. *)
Lemma plane_third : forall width s R w K z Z, (2048 <= width <= 4096)%Z -> (29 <= s <= width - 100)%Z -> parameters R w K ->
  coordinate (to64 z) Z ->
  (forall m, is_tie m -> (0 <> m -> bpow radix2 (- s) <= Rabs (0 - m)) /\
    (value32 K * - Z <> m -> bpow radix2 (- s) <= Rabs (value32 K * - Z - m))) ->
  is_answer (along_big width K (exactly width (opp (to64 z))) (exactly width zero64) (exactly width (two_to 0))) (0 < - Z) 0
    (value32 K * - Z).
Proof.
  intros width s R w K z Z W Hs Hp Cz Sep. assert (exact : forall v a, is64 v a -> tight width 1074 (- width) (exactly width v) a).
  { intros v a H. apply tight_exactly; [lia|numbers; lia|exact H]. }
  pose proof (exact _ _ (opp_is _ _ (coordinate_is _ _ Cz))) as Tg. pose proof (exact _ _ zero_is) as T0.
  pose proof (exact _ _ (two_to_is 0 ltac:(lia))) as T1. change (bpow radix2 0) with 1 in T1. pose proof (coordinate_range _ _ Cz) as BZ.
  apply Rabs_le_inv in BZ. pose proof Hp as (_ & _ & _ & HK).
  assert (E0 : value32 K * - Z * 0 = 0) by ring. assert (E1 : value32 K * - Z * 1 = value32 K * - Z) by ring.
  enough (A : is_answer (along_big width K (exactly width (opp (to64 z))) (exactly width zero64) (exactly width (two_to 0))) (0 < - Z)
    (value32 K * - Z * 0) (value32 K * - Z * 1)) by (rewrite E0, E1 in A; exact A).
  apply (along_big_is_right width 1074 (- width) 25 s R w); try assumption; try lia; try (numbers; lia); try reflexivity.
  - now apply tight_is_seen.
  - intro T. assert (LZ : bpow radix2 (-300) <= - Z).
    { destruct (coordinate_not_tiny _ _ Cz) as [L|L]; [lra|]. rewrite Rabs_left in L by lra. apply Rle_trans with (2 := L).
      apply bpow_le. lia. }
    split; apply large_component; rewrite ?Rabs_R0, ?Rabs_R1; try lra. right. apply (bpow_le radix2 (-40) 0). lia.
  - intros m Hm. rewrite E0, E1. now apply Sep.
Qed.

(* ---- bump-2p ---- *)

Theorem bump_2p_third_stage_answers_right : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_2p (value32 R) (value32 w) X Z in let S := slope_2p (value32 R) (value32 w) in
  is_answer (bump_2p_third R w K (quantised x) (quantised z)) (0 < M) (side_x (value32 w) (value32 K) S X M) (side_z (value32 w)
    (value32 K) S X M).
Proof.
  intros R w K x y z Hp Hv X Z M S. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx]. fold X in Vx. pose proof Hp as ((FR & Fw & _) & HR & Hw & HK).
  pose proof (coordinate_range _ _ Cx) as BX.
  pose proof (fun m H => bump_2p_is_separated R w K x y z m Hp Hv H) as Sep. cbv zeta in Sep. fold X Z M S in Sep.
  pose proof (bump_2p_contact_is_separated R w K x y z Hp Hv) as Sepc. cbv zeta in Sepc. fold X Z M in Sepc.
  unfold bump_2p_third. rewrite is_beside_is by (rewrite ?Vx; assumption). rewrite (less32_is _ zero32 Fx eq_refl), Vx.
  change (value32 zero32) with 0. unfold side_x, side_z in *. destruct (Rle_lt_dec (Rabs X) (value32 w / 2)) as [Hin|Hin].
  2: { rewrite Rle_bool_false in Sep |- * by exact Hin. cbn [negb].
    assert (EM : M = - Z) by (unfold M, penetration_2p; now rewrite Rle_bool_false by exact Hin). rewrite EM, Rmult_1_r in Sep |- *.
    apply (plane_third 2048 859 R w); try assumption; lia. }
  rewrite Rle_bool_true in Sep |- * by exact Hin. cbn [negb].
  destruct (side_gap_third_is R w K _ X _ Z Hp Fx Vx Cx Cz Hin Sepc) as [Sg UM]. fold M in Sg, UM.
  destruct (face_third R w K Hp) as (_ & Ts & Tc). destruct (face_enclosed R w K Hp) as (_ & [_ Bs] & [_ Bc]). fold S in Ts, Tc, Bs, Bc.
  assert (Sg' : seen 2048 2000000000000 (-1723) (side_gap_third R w (quantised x) (quantised z)) M) by (apply seen_more with
    (1 := Sg); [numbers; lia|lia]).
  assert (Tn : tight 2048 2000000000000 (-1723) (if Rlt_bool X 0 then negated (sine_third R w) else sine_third R w)
    (if Rlt_bool X 0 then - sine_of S else sine_of S)).
  { destruct (Rlt_bool X 0); [apply tight_negated|]; apply tight_more with (1 := Ts); try (numbers; lia); lia. }
  assert (Tc' : tight 2048 2000000000000 (-1723) (cosine_third R w) (cosine_of S)) by (apply tight_more with (1 := Tc); [numbers; lia|lia]).
  set (n := if Rlt_bool X 0 then - sine_of S else sine_of S) in *.
  assert (Bn : Rabs n = sine_of S) by (unfold n; destruct (Rlt_bool X 0); rewrite ?Rabs_Ropp; apply Rabs_pos_eq; lra).
  apply (along_big_is_right 2048 2000000000000 (-1723) 25 859 R w); try assumption; try lia; try (numbers; lia); try reflexivity.
  intro T. specialize (Sepc ltac:(lra)). rewrite Rabs_pos_eq in Sepc by lra.
  assert (LM : bpow radix2 (-300) <= M) by (apply Rle_trans with (2 := Sepc); apply bpow_le; lia).
  assert (L40 : bpow radix2 (-40) <= / 40000000) by (simpl; lra).
  assert (along : forall c, 0 <= c <= 1 -> M * c <= 20000).
  { intros c Hc. apply Rle_trans with (20000 * 1); [apply Rmult_le_compat; lra|lra]. }
  split; apply large_component; try assumption; rewrite ?Bn, ?(Rabs_pos_eq (cosine_of S)) by lra; try (right; lra); apply along; lra.
Qed.

(* Every answer is right, for every input of the domain. *)
Theorem bump_2p_answers_right : forall is_fused R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let M := penetration_2p (value32 R) (value32 w) X Z in let S := slope_2p (value32 R) (value32 w) in
  is_answer (evaluate bump_2p_window (bump_2p_of R w K is_fused) (later_of (bump_2p_second R w K) (bump_2p_third R w K)) x y z) (0 < M)
    (side_x (value32 w) (value32 K) S X M) (side_z (value32 w) (value32 K) S X M).
Proof.
  intros is_fused R w K x y z Hp Hv X Z M S. apply three_stages_are_right with (bump_2p_third R w K (quantised x) (quantised z)).
  - now apply bump_2p_two_stages_answer_right.
  - now apply (bump_2p_third_stage_answers_right R w K x y z).
Qed.
