(* SPDX-License-Identifier: BSD-3-Clause *)
(* The third stage of cylinder: exact() of fast/laws/cylinder.h with numbers of 2048 bits. Its answer is right, and so is every answer
   of the law. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Evaluate Inputs Polygons Cylinder CylinderAnswers CylinderConstants.
From Forceshade Require Import SecondStage TwoPolygonsGap Separation SeparationOfCylinder SeparationOfContact CylinderSecond.
From Forceshade Require Import BigFloat BigFloatValues BigFloatSums BigFloatProducts BigFloatQuotients BigFloatRight BigFloatTight.
From Forceshade Require Import BigFloatDecide ThirdAlong TwoPolygonsThird BigFloatBounded.
Open Scope R_scope.

Definition l_third (R w z : binary32) : big := add 2048 (number (to64 z)) (depth_third R w).
Definition v_third (R w x z : binary32) : big :=
  subtract 2048
    (multiply 2048 (subtract 2048 (number (half_width w)) (number (to64 x))) (add 2048 (number (half_width w)) (number (to64 x))))
    (multiply 2048 (number (to64 z)) (add 2048 (l_third R w z) (depth_third R w))).
Definition rho_third (R w x z : binary32) : big :=
  square_root_newton 2048
    (add 2048 (multiply 2048 (number (to64 x)) (number (to64 x))) (multiply 2048 (l_third R w z) (l_third R w z))).
Definition scale_third (R w K x z : binary32) : big :=
  divide_newton 2048 (multiply 2048 (number (to64 K)) (v_third R w x z))
    (multiply 2048 (add 2048 (number (to64 R)) (rho_third R w x z)) (rho_third R w x z)).

(* The sign of the contact and the components along x and z. *)
Definition outcome_third : Type := comparison * big * big.
Definition cylinder_outcome_third (R w K x z : binary32) : outcome_third :=
  let l := l_third R w z in
  match (if is_nonzero x then Gt else sign_of_big l) with
  | Eq => (Gt, number zero64, multiply 2048 (number (to64 K)) (number (to64 R)))
  | _ =>
    let scale := scale_third R w K x z in
    (sign_of_big (v_third R w x z), multiply 2048 scale (number (to64 x)), multiply 2048 scale l)
  end.
Definition decide_third (o : outcome_third) : evaluation := let '(contact_sign, fx, fz) := o in decide_big 2048 contact_sign fx fz.
Definition cylinder_third (R w K x z : binary32) : evaluation := decide_third (cylinder_outcome_third R w K x z).

(* ---- Sums and products ---- *)

Lemma input_bounded : forall v a, is64 v a -> Rabs a <= 10000 -> bounded 2048 1074 none 15 (number v) a.
Proof. intros v a I B. apply (bounded_exactly 2048 v a 14); try assumption; try lia. apply Rle_trans with (1 := B). simpl. lra. Qed.

Lemma depth_bounded : forall R w K, parameters R w K ->
  bounded 2048 700000 (-1976) 16 (depth_third R w) (axis_depth (value32 R) (value32 w)).
Proof.
  intros R w K Hp. pose proof (half_width_coordinate _ _ _ Hp) as Hc. pose proof (half_width_is _ _ _ Hp) as Ic.
  pose proof Hp as ((FR & _) & HR & Hw & _).
  pose proof (shading_root_tight 2048 R w K _ _ ltac:(lia) ltac:(numbers; lia) Hp Hc ltac:(rewrite Rabs_pos_eq; lra)) as T. cbv zeta in T.
  replace ((value32 R - value32 w / 2) * (value32 R + value32 w / 2)) with (Rsqr (value32 R) - Rsqr (value32 w / 2)) in T
    by (unfold Rsqr; ring).
  change (sqrt (Rsqr (value32 R) - Rsqr (value32 w / 2))) with (axis_depth (value32 R) (value32 w)) in T. fold (depth_third R w) in T.
  destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2]. set (d := axis_depth (value32 R) (value32 w)) in *.
  assert (HdR : d <= value32 R).
  { apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite Hd2. pose proof (Rle_0_sqr (value32 w / 2)) as P. unfold Rsqr in P. lra. }
  apply bounded_more with (60 * (3268 + 4 * 2048))%Z (14 + 2 + (56 - 2048))%Z (14 + 2)%Z; [|numbers; lia|lia|lia].
  apply tight_is_bounded; [lia|numbers; lia|exact T|rewrite Rabs_pos_eq by lra; simpl; lra| |numbers; lia].
  destruct (Req_dec d 0) as [D0|D0]; [right|now left]. pose proof (to64_is_exact R FR) as IR.
  assert (Ec : value32 R = value32 w / 2).
  { assert (Rsqr (value32 R) = Rsqr (value32 w / 2)) by (unfold Rsqr; rewrite D0 in Hd2; lra). apply Rsqr_inj; lra. }
  assert (Ev : half_width w = to64 R).
  { apply B2R_inj; [| |rewrite (proj1 IR), (proj1 Ic); lra]; apply strictly_finite; [rewrite (proj1 Ic)|rewrite (proj1 IR)]; lra. }
  pose proof (exact_third _ _ IR) as TR. destruct (tight_cases 2048 1074 (-2048) _ _ ltac:(lia) ltac:(numbers; lia) TR) as [[_ R0]|(_ & Z & _)];
    [lra|].
  assert (X : is_exact_zero (subtract 2048 (number (to64 R)) (number (half_width w))) = true).
  { rewrite Ev. unfold subtract. apply less_itself; [exact Z|]. destruct (to64 R); reflexivity. }
  unfold depth_third. set (p := subtract 2048 _ _) in *.
  assert (E : multiply 2048 p (add 2048 (number (to64 R)) (number (half_width w))) = with_error zero none).
  { unfold multiply. rewrite X. apply andb_prop in X. destruct X as [X _]. now rewrite X. }
  rewrite E. unfold square_root_newton, square_root. cbn [is_exact_zero is_zero is_exact with_error zero digits exponent].
  change (exponent (with_error zero none) <= 14 + 2)%Z. cbn [exponent with_error zero]. lia.
Qed.

Lemma depth_range : forall R w K, parameters R w K -> 0 <= axis_depth (value32 R) (value32 w) <= 10000.
Proof.
  intros R w K (_ & HR & Hw & _). destruct (depth_squared (value32 R) (value32 w) ltac:(lra) ltac:(lra)) as [Hd0 Hd2]. split; [exact Hd0|].
  apply Rle_trans with (value32 R); [|lra].
  apply Rsqr_incr_0_var; [|lra]. unfold Rsqr. rewrite Hd2. pose proof (Rle_0_sqr (value32 w / 2)) as P. unfold Rsqr in P. lra.
Qed.

Lemma l_bounded : forall R w K z Z, parameters R w K -> coordinate (to64 z) Z ->
  bounded 2048 710000 (-1974) 17 (l_third R w z) (Z + axis_depth (value32 R) (value32 w)).
Proof.
  intros R w K z Z Hp Cz. pose proof (depth_bounded R w K Hp) as Bd.
  pose proof (input_bounded _ _ (coordinate_is _ _ Cz) (coordinate_range _ _ Cz)) as Bz.
  assert (Bz' : bounded 2048 700000 (-1976) 16 (number (to64 z)) Z) by (apply bounded_more with (1 := Bz); numbers; lia).
  pose proof (bounded_add 2048 700000 (-1976) 16 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia) Bz' Bd) as B.
  apply bounded_more with (1 := B); numbers; lia.
Qed.

Lemma v_bounded : forall R w K x X z Z, parameters R w K -> coordinate (to64 x) X -> coordinate (to64 z) Z ->
  let d := axis_depth (value32 R) (value32 w) in
  bounded 2048 1600000 (-1950) 37 (v_third R w x z) ((value32 w / 2 - X) * (value32 w / 2 + X) - Z * (Z + d + d)).
Proof.
  intros R w K x X z Z Hp Cx Cz d. pose proof (depth_bounded R w K Hp) as Bd. pose proof (l_bounded R w K z Z Hp Cz) as Bl. fold d in Bd, Bl.
  pose proof (half_width_coordinate _ _ _ Hp) as Cc.
  pose proof (input_bounded _ _ (half_width_is _ _ _ Hp) (coordinate_range _ _ Cc)) as Bc.
  pose proof (input_bounded _ _ (coordinate_is _ _ Cx) (coordinate_range _ _ Cx)) as Bx.
  pose proof (input_bounded _ _ (coordinate_is _ _ Cz) (coordinate_range _ _ Cz)) as Bz. unfold v_third.
  set (c := value32 w / 2) in *. set (hn := number (half_width w)) in *. set (xn := number (to64 x)) in *. set (zn := number (to64 z)) in *.
  assert (Bc' : bounded 2048 1074 (-1974) 15 hn c) by (apply bounded_more with (1 := Bc); numbers; lia).
  assert (Bx' : bounded 2048 1074 (-1974) 15 xn X) by (apply bounded_more with (1 := Bx); numbers; lia).
  pose proof (bounded_subtract 2048 1074 (-1974) 15 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia) Bc' Bx') as B1.
  pose proof (bounded_add 2048 1074 (-1974) 15 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia) Bc' Bx') as B2.
  assert (Bd' : bounded 2048 710000 (-1974) 17 (depth_third R w) d) by (apply bounded_more with (1 := Bd); numbers; lia).
  pose proof (bounded_add 2048 710000 (-1974) 17 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia) Bl Bd') as B3.
  set (m := add 2048 (l_third R w z) (depth_third R w)) in *. set (p1 := subtract 2048 hn xn) in *. set (p2 := add 2048 hn xn) in *.
  assert (B3' : bounded 2048 720000 (-1972) 18 m (Z + d + d)) by (apply bounded_more with (1 := B3); numbers; lia).
  assert (Bz' : bounded 2048 720000 (-1972) 18 zn Z) by (apply bounded_more with (1 := Bz); numbers; lia).
  assert (B1' : bounded 2048 720000 (-1972) 18 p1 (c - X)) by (apply bounded_more with (1 := B1); numbers; lia).
  assert (B2' : bounded 2048 720000 (-1972) 18 p2 (c + X)) by (apply bounded_more with (1 := B2); numbers; lia).
  pose proof (bounded_multiply 2048 720000 (-1972) 18 (-1972) 18 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia)
    ltac:(lia) B1' B2') as B4.
  pose proof (bounded_multiply 2048 720000 (-1972) 18 (-1972) 18 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia)
    ltac:(lia) Bz' B3') as B5.
  set (q1 := multiply 2048 p1 p2) in *. set (q2 := multiply 2048 zn m) in *.
  assert (B4' : bounded 2048 1500000 (-1952) 36 q1 ((c - X) * (c + X))) by (apply bounded_more with (1 := B4); numbers; lia).
  assert (B5' : bounded 2048 1500000 (-1952) 36 q2 (Z * (Z + d + d))) by (apply bounded_more with (1 := B5); numbers; lia).
  pose proof (bounded_subtract 2048 1500000 (-1952) 36 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia) B4' B5') as B6.
  apply bounded_more with (1 := B6); numbers; lia.
Qed.

Lemma squares_bounded : forall R w K x X z Z, parameters R w K -> coordinate (to64 x) X -> coordinate (to64 z) Z ->
  let L := Z + axis_depth (value32 R) (value32 w) in
  bounded 2048 1600000 (-1953) 35
    (add 2048 (multiply 2048 (number (to64 x)) (number (to64 x))) (multiply 2048 (l_third R w z) (l_third R w z))) (X * X + L * L).
Proof.
  intros R w K x X z Z Hp Cx Cz L. pose proof (l_bounded R w K z Z Hp Cz) as Bl. fold L in Bl.
  pose proof (input_bounded _ _ (coordinate_is _ _ Cx) (coordinate_range _ _ Cx)) as Bx.
  set (xn := number (to64 x)) in *. set (l := l_third R w z) in *.
  assert (Bx' : bounded 2048 710000 (-1974) 17 xn X) by (apply bounded_more with (1 := Bx); numbers; lia).
  pose proof (bounded_multiply 2048 710000 (-1974) 17 (-1974) 17 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia)
    ltac:(lia) Bx' Bx') as B1.
  pose proof (bounded_multiply 2048 710000 (-1974) 17 (-1974) 17 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia)
    ltac:(lia) Bl Bl) as B2.
  set (xx := multiply 2048 xn xn) in *. set (ll := multiply 2048 l l) in *.
  assert (B1' : bounded 2048 1500000 (-1955) 34 xx (X * X)) by (apply bounded_more with (1 := B1); numbers; lia).
  assert (B2' : bounded 2048 1500000 (-1955) 34 ll (L * L)) by (apply bounded_more with (1 := B2); numbers; lia).
  pose proof (bounded_add 2048 1500000 (-1955) 34 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia) B1' B2') as B3.
  apply bounded_more with (1 := B3); numbers; lia.
Qed.
