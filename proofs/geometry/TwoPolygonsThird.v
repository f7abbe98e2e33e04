(* SPDX-License-Identifier: BSD-3-Clause *)
(* The face of two polygons and the gap beside it in the third stage, with numbers of 2048 bits: two_polygon_face() of
   fast/laws/bump_geometry.h and side_gap() of fast/laws/polygon_gap.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Evaluate Inputs Polygons TwoPolygonsConstants TwoPolygonsGap.
From Forceshade Require Import SecondStage SecondAlong Separation.
From Forceshade Require Import BigFloat BigFloatValues BigFloatSums BigFloatQuotients BigFloatRight BigFloatTight ThirdAlong.
Open Scope R_scope.

Notation number := (exactly 2048).
Definition depth_third (R w : binary32) : big :=
  square_root_newton 2048 (multiply 2048 (subtract 2048 (number (to64 R)) (number (half_width w)))
    (add 2048 (number (to64 R)) (number (half_width w)))).
Definition sum_third (R w : binary32) : big := add 2048 (number (to64 R)) (depth_third R w).
Definition diameter_third (R : binary32) : big := add 2048 (number (to64 R)) (number (to64 R)).
Definition cosine_third (R w : binary32) : big := square_root_newton 2048 (divide_newton 2048 (sum_third R w) (diameter_third R)).
Definition sine_third (R w : binary32) : big :=
  divide_newton 2048 (number (half_width w)) (multiply 2048 (diameter_third R) (cosine_third R w)).
Definition tangent_third (R w : binary32) : big := divide_newton 2048 (number (half_width w)) (sum_third R w).
Definition side_gap_big (width : Z) (tangent : big) (w x z : binary32) : big :=
  let from_edge := subtract width (exactly width (half_width w)) (exactly width (to64 (b32_abs x))) in
  subtract width (multiply width tangent from_edge) (exactly width (to64 z)).
Definition side_gap_third (R w x z : binary32) : big := side_gap_big 2048 (tangent_third R w) w x z.

Lemma exact_third : forall v a, is64 v a -> tight 2048 1074 (-2048) (number v) a.
Proof. intros v a H. apply tight_exactly; [lia|numbers; lia|exact H]. Qed.

Lemma sum_third_is : forall R w K, parameters R w K ->
  tight 2048 1000000 (-1969) (sum_third R w) (value32 R + axis_depth (value32 R) (value32 w)).
Proof.
  intros R w K Hp. pose proof (half_width_coordinate _ _ _ Hp) as Hc. pose proof Hp as ((FR & _) & HR & Hw & _).
  pose proof (shading_root_tight 2048 R w K _ _ ltac:(lia) ltac:(numbers; lia) Hp Hc ltac:(rewrite Rabs_pos_eq; lra)) as T. cbv zeta in T.
  replace ((value32 R - value32 w / 2) * (value32 R + value32 w / 2)) with (Rsqr (value32 R) - Rsqr (value32 w / 2)) in T
    by (unfold Rsqr; ring).
  change (sqrt (Rsqr (value32 R) - Rsqr (value32 w / 2))) with (axis_depth (value32 R) (value32 w)) in T. fold (depth_third R w) in T.
  destruct (face_2p (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (HS & _).
  set (d := axis_depth (value32 R) (value32 w)) in *. assert (d0 : 0 <= d) by (unfold d, axis_depth; apply sqrt_pos).
  assert (TR : tight 2048 (60 * (3268 + 4 * 2048)) (-2048) (number (to64 R)) (value32 R)).
  { apply tight_more with (1 := exact_third _ _ (to64_is_exact R FR)); [numbers; lia|lia]. }
  destruct (seen_sum 2048 (60 * (3268 + 4 * 2048)) (-2048) (56 - 2048) 16 20 _ _ _ _ ltac:(lia) ltac:(numbers; lia) TR T) as
    (_ & _ & _ & Ts);
    try lia; try intros _; try (rewrite Rabs_pos_eq by lra; simpl; lra).
  apply tight_more with (1 := Ts ltac:(lra)); [numbers; lia|lia].
Qed.

Lemma diameter_third_is : forall R w K, parameters R w K -> tight 2048 1000000 (-2024) (diameter_third R) (2 * value32 R).
Proof.
  intros R w K ((FR & _) & HR & _). pose proof (exact_third _ _ (to64_is_exact R FR)) as TR.
  replace (2 * value32 R) with (value32 R + value32 R) by ring.
  destruct (seen_sum 2048 1074 (-2048) (-2048) 16 20 _ _ _ _ ltac:(lia) ltac:(numbers; lia) TR TR) as (_ & _ & _ & Ts);
    try lia; try intros _; try (rewrite Rabs_pos_eq by lra; simpl; lra).
  apply tight_more with (1 := Ts ltac:(lra)); [numbers; lia|lia].
Qed.

Lemma face_third : forall R w K, parameters R w K -> let slope := slope_2p (value32 R) (value32 w) in
  tight 2048 100000000 (-1963) (tangent_third R w) slope /\ tight 2048 2000000000000 (-1950) (sine_third R w) (sine_of slope) /\
  tight 2048 2000000000000 (-1950) (cosine_third R w) (cosine_of slope).
Proof.
  intros R w K Hp slope. pose proof (sum_third_is R w K Hp) as Ts. pose proof (diameter_third_is R w K Hp) as Td.
  pose proof (exact_third _ _ (half_width_is _ _ _ Hp)) as Th0. destruct Hp as ((FR & _) & HR & Hw & _).
  destruct (face_2p (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (HS & HcS & ET & _ & EC & ES). fold slope in ET, EC, ES.
  rewrite EC, ES, ET. set (S := value32 R + axis_depth (value32 R) (value32 w)) in *. set (c := value32 w / 2) in *.
    set (Rad := value32 R) in *.
  assert (Th : tight 2048 1000000 (-2048) (number (half_width w)) c) by (apply tight_more with (1 := Th0); [numbers; lia|lia]).
  assert (HQ : 0 < S / (2 * Rad)) by (apply Rdiv_lt_0_compat; lra). assert (Hq : 0 < sqrt (S / (2 * Rad))) by now apply sqrt_lt_R0.
  pose proof (tight_divide 2048 1000000 (-2048) (-1969) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) Th Ts
    ltac:(lra)) as T1.
  pose proof (tight_divide 2048 1000000 (-1969) (-2024) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) Ts Td
    ltac:(lra)) as T2.
  assert (T2' : tight 2048 100000000 (-1963) (divide_newton 2048 (sum_third R w) (diameter_third R)) (S / (2 * Rad)))
    by (apply tight_more with (1 := T2); [numbers; lia|lia]).
  pose proof (tight_root 2048 100000000 (-1963) _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) T2' ltac:(lra)) as T3.
  fold (cosine_third R w) in T3.
  assert (T3' : tight 2048 10000000000 (-1959) (cosine_third R w) (sqrt (S / (2 * Rad))))
    by (apply tight_more with (1 := T3); [numbers; lia|lia]).
  assert (Td' : tight 2048 10000000000 (-2024) (diameter_third R) (2 * Rad)) by (apply tight_more with (1 := Td); [numbers; lia|lia]).
  pose proof (tight_multiply 2048 10000000000 (-2024) (-1959) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) Td' T3') as T4.
  assert (T4' : tight 2048 30000000000 (-1956) (multiply 2048 (diameter_third R) (cosine_third R w)) (2 * Rad * sqrt (S / (2 * Rad))))
    by (apply tight_more with (1 := T4); [numbers; lia|lia]).
  assert (Th' : tight 2048 30000000000 (-2048) (number (half_width w)) c) by (apply tight_more with (1 := Th); [numbers; lia|lia]).
  assert (HD : 2 * Rad * sqrt (S / (2 * Rad)) <> 0) by (apply Rgt_not_eq, Rmult_lt_0_compat; lra).
  pose proof (tight_divide 2048 30000000000 (-2048) (-1956) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) Th' T4' HD) as T5.
  split; [apply tight_more with (1 := T1); [numbers; lia|lia]|]. split.
  - apply tight_more with (1 := T5); [numbers; lia|lia].
  - apply tight_more with (1 := T3'); [numbers; lia|lia].
Qed.

(* ---- The gap ---- *)

(* The distance from the edge, which may be 0 and is 0 exactly then. *)
Lemma from_edge_tight : forall width R w K x X, (2048 <= width <= 4096)%Z -> parameters R w K -> is_finite 24 128 x = true ->
  value32 x = X ->
  coordinate (to64 x) X -> Rabs X <= value32 w / 2 ->
  tight width 100000000 (73 - width) (subtract width (exactly width (half_width w)) (exactly width (to64 (b32_abs x))))
    (value32 w / 2 - Rabs X).
Proof.
  intros width R w K x X W Hp Fx Vx Cx Hin. pose proof (half_width_coordinate _ _ _ Hp) as Cc. pose proof (half_width_is _ _ _ Hp) as Ic.
  destruct Hp as (_ & HR & Hw & _). assert (Ix : is64 (to64 (b32_abs x)) (Rabs X)).
  { assert (Fa : is_finite 24 128 (b32_abs x) = true) by (unfold b32_abs; now rewrite is_finite_Babs).
    destruct (to64_is_exact _ Fa) as [V F].
    split; [|exact F]. rewrite V, <- Vx. apply B2R_Babs. }
  pose proof (Rabs_pos X) as PX. set (c := value32 w / 2) in *. assert (Hc : / 2000 <= c <= 10000) by (unfold c; lra).
  pose proof (tight_exactly width (- width) _ _ ltac:(lia) ltac:(numbers; lia) Ic) as Tc.
  pose proof (tight_negated _ _ _ _ _ (tight_exactly width (- width) _ _ ltac:(lia) ltac:(numbers; lia) Ix)) as Tx.
  assert (S : seen width (1074 + width + 3) (73 - width) (subtract width (exactly width (half_width w)) (exactly width (to64 (b32_abs x))))
    (c + - Rabs X)).
  { apply seen_more with (1074 + width + 3)%Z (Z.max (Z.max (- width) (- width)) (1 - width) + 69 + 3)%Z; [|numbers; lia|lia].
    apply (seen_sum width 1074 (- width) (- width) 16 69); try assumption; try lia; try (numbers; lia).
    - rewrite Rabs_pos_eq by lra. simpl. lra.
    - rewrite Rabs_Ropp, Rabs_Rabsolu. apply Rle_trans with 10000; [|simpl; lra]. lra.
    - intro Hne. apply (difference_is_not_tiny c (Rabs X)); [exact (coordinate_format _ _ Cc)|apply generic_format_abs; exact
        (coordinate_format _ _ Cx)| | |exact Hne].
      + right. rewrite Rabs_pos_eq by lra. simpl. lra.
      + rewrite Rabs_Rabsolu. destruct (coordinate_not_tiny _ _ Cx) as [->|L]; [left; apply Rabs_R0|now right]. }
  change (c - Rabs X) with (c + - Rabs X). destruct (Req_dec (c + - Rabs X) 0) as [E|Hne].
  - assert (Ev : to64 (b32_abs x) = half_width w).
    { apply B2R_inj; [| |rewrite (proj1 Ix), (proj1 Ic); lra]; apply strictly_finite; [rewrite (proj1 Ix)|rewrite (proj1 Ic)]; lra. }
    destruct S as (N & F & C & _). split; [exact N|]. split; [apply fits_le with (2 := F); numbers; lia|]. split; [exact C|].
    split; [numbers; lia|]. left. rewrite Ev. unfold subtract. apply less_itself; [|destruct (half_width w); reflexivity].
    destruct (tight_cases width 1074 (- width) _ _ ltac:(lia) ltac:(numbers; lia) Tc) as [[_ C0]|(_ & Z & _)]; [lra|exact Z].
  - destruct S as (_ & _ & _ & T). apply tight_more with (1 := T Hne); [numbers; lia|lia].
Qed.

(* Beside a face of slope T the gap is 0, or it is not m bits below 2^e. *)
Lemma side_gap_seen : forall width k t e m R w K tangent T x X z Z, (2048 <= width <= 4096)%Z -> (100000000 <= k <= 1000000000000)%Z ->
  parameters R w K -> is_finite 24 128 x = true -> value32 x = X -> coordinate (to64 x) X -> coordinate (to64 z) Z ->
  Rabs X <= value32 w / 2 -> tight width k t tangent T -> (73 - width <= t)%Z -> (0 <= m)%Z -> (t + m + 6 <= -3)%Z ->
    (16 <= e)%Z -> 0 <= T ->
  T * (value32 w / 2 - Rabs X) <= bpow radix2 (e - 2) ->
  (T * (value32 w / 2 - Rabs X) + - Z <> 0 -> bpow radix2 (e - m) <= Rabs (T * (value32 w / 2 - Rabs X) + - Z)) ->
  seen width (3 * k) (t + m + 6) (side_gap_big width tangent w x z) (T * (value32 w / 2 - Rabs X) + - Z).
Proof.
  intros width k t e m R w K tangent T x X z Z W Hk Hp Fx Vx Cx Cz Hin Tt Ht Hm Htm He BT BA Sep.
  pose proof (from_edge_tight width R w K x X W Hp Fx Vx Cx Hin) as Te. pose proof (coordinate_range _ _ Cz) as BZ.
  set (h := value32 w / 2 - Rabs X) in *.
  unfold side_gap_big. cbv zeta. set (edge := subtract width (exactly width (half_width w)) (exactly width (to64 (b32_abs x)))) in *.
  assert (Te' : tight width k (73 - width) edge h) by (apply tight_more with (1 := Te); numbers; lia).
  pose proof (tight_multiply width k t (73 - width) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) Tt Te') as Tp.
  assert (Tp' : tight width (2 * k + width + 4) (t + 3) (multiply width tangent edge) (T * h))
    by (apply tight_more with (1 := Tp); numbers; lia).
  assert (Tz : tight width (2 * k + width + 4) (- width) (negated (exactly width (to64 z))) (- Z)).
  { pose proof (tight_exactly width (- width) _ _ ltac:(lia) ltac:(numbers; lia) (coordinate_is _ _ Cz)) as T0.
    apply tight_more with (1 := tight_negated _ _ _ _ _ T0); numbers; lia. }
  apply seen_more with (2 * k + width + 4 + width + 3)%Z (Z.max (Z.max (t + 3) (- width)) (1 - width) + m + 3)%Z; [|numbers; lia|lia].
  assert (B14 : bpow radix2 14 <= bpow radix2 (e - 2)) by (apply bpow_le; lia). change (bpow radix2 14) with 16384 in B14.
  apply (seen_sum width (2 * k + width + 4) (t + 3) (- width) e m); try assumption; try lia; try (numbers; lia).
  - rewrite Rabs_pos_eq; [exact BA|]. apply Rmult_le_pos; [exact BT|unfold h; lra].
  - rewrite Rabs_Ropp. lra.
Qed.

Lemma side_gap_third_is : forall R w K x X z Z, parameters R w K -> is_finite 24 128 x = true -> value32 x = X -> coordinate (to64 x) X ->
  coordinate (to64 z) Z -> Rabs X <= value32 w / 2 -> let M := penetration_2p (value32 R) (value32 w) X Z in
  (M <> 0 -> bpow radix2 (-218) <= Rabs M) -> seen 2048 400000000 (-1723) (side_gap_third R w x z) M /\ M <= 20000.
Proof.
  intros R w K x X z Z Hp Fx Vx Cx Cz Hin M Sep. destruct (face_third R w K Hp) as (Tt & _).
    destruct (face_enclosed _ _ _ Hp) as ([_ BT] & _).
  pose proof (coordinate_range _ _ Cz) as BZ. pose proof Hp as (_ & HR & Hw & _).
  destruct (face_2p (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as (_ & _ & ET & EH & _).
  set (T := slope_2p (value32 R) (value32 w)) in *. pose proof (Rabs_pos X) as PX. set (c := value32 w / 2) in *.
  assert (EM : M = T * (c - Rabs X) + - Z).
  { unfold M, penetration_2p. rewrite Rle_bool_true by exact Hin. rewrite EH, <- ET. unfold c. field. lra. }
  assert (Hc : 0 <= c <= 10000) by (unfold c; lra).
  assert (BA : T * (c - Rabs X) <= 10000) by (apply Rle_trans with (1 * 10000); [apply Rmult_le_compat; lra|lra]).
  split; [|apply Rabs_le_inv in BZ; lra]. rewrite EM in Sep |- *.
  apply seen_more with 300000000%Z (-1723)%Z; [|numbers; lia|lia].
  apply (side_gap_seen 2048 100000000 (-1963) 16 234 R w K); try assumption; try lia; try lra.
  change (bpow radix2 (16 - 2)) with 16384. fold c. lra.
Qed.

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
