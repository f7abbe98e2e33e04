(* SPDX-License-Identifier: BSD-3-Clause *)
(* The third stage of cylinder: exact() of fast/laws/cylinder.h with numbers of 2048 bits. Its answer is right, and so is every answer
   of the law. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Evaluate Inputs Polygons CylinderFirst CylinderAnswers.
From Forceshade Require Import CylinderConstants.
From Forceshade Require Import SecondStage SecondAlong TwoPolygonsGap Separation SeparationOfCylinder SeparationOfContact CylinderSecond.
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
  pose proof (exact_third _ _ IR) as TR. destruct (tight_cases 2048 1074 (-2048) _ _ ltac:(lia) ltac:(numbers; lia) TR) as
    [[_ R0]|(_ & Z & _)];
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
  intros R w K x X z Z Hp Cx Cz d. pose proof (depth_bounded R w K Hp) as Bd. pose proof (l_bounded R w K z Z Hp Cz) as Bl.
    fold d in Bd, Bl.
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

(* ---- The force ---- *)

(* A component that another may be added to before it is rounded. *)
Definition component_third (a : big) (x : R) : Prop := bounded 2048 50000000000 (-1500) 170 a x /\ Rabs x <= 10000000.

Lemma square_at_least : forall y n, bpow radix2 n <= Rabs y -> bpow radix2 (n + n) <= y * y.
Proof.
  intros y n H. rewrite bpow_plus, <- (Rabs_pos_eq (y * y)) by apply Rle_0_sqr. rewrite Rabs_mult.
  apply Rmult_le_compat; try apply bpow_ge_0; exact H.
Qed.

Lemma rho_tight : forall R w K x X z Z, parameters R w K -> coordinate (to64 x) X -> coordinate (to64 z) Z ->
  let L := Z + axis_depth (value32 R) (value32 w) in let rho := distance_from_axis (value32 R) (value32 w) X Z in
  (L <> 0 -> bpow radix2 (-121) <= Rabs L) -> X <> 0 \/ L <> 0 ->
  tight 2048 100000000 (-1707) (rho_third R w x z) rho /\ bpow radix2 (-121) <= rho.
Proof.
  intros R w K x X z Z Hp Cx Cz L rho Sep Hne. pose proof (squares_bounded R w K x X z Z Hp Cx Cz) as B. cbv zeta in B. fold L in B.
  destruct (distance_squared (value32 R) (value32 w) X Z) as [P Q]. fold L rho in P, Q.
  pose proof (Rle_0_sqr X) as SX. pose proof (Rle_0_sqr L) as SL. unfold Rsqr in SX, SL.
  assert (Hm : bpow radix2 (-242) <= X * X + L * L).
  { destruct Hne as [H|H].
    - destruct (coordinate_not_tiny _ _ Cx) as [X0|LX]; [contradiction|]. pose proof (square_at_least _ _ LX) as S.
      assert (bpow radix2 (-242) <= bpow radix2 (-30 + -30)) by (apply bpow_le; lia). lra.
    - pose proof (square_at_least _ _ (Sep H)) as S. change (-121 + -121)%Z with (-242)%Z in S. lra. }
  split.
  - pose proof (bounded_is_tight 2048 1600000 (-1953) 35 (-242) _ _ ltac:(lia) ltac:(numbers; lia) B
      ltac:(rewrite Rabs_pos_eq by lra; exact Hm) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(numbers; lia)) as T.
    change (-1953 - -242)%Z with (-1711)%Z in T.
    pose proof (tight_root 2048 1600000 (-1711) _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) T ltac:(lra)) as T2.
    apply tight_more with (1 := T2); [numbers; lia|lia].
  - apply Rsqr_incr_0_var; [|exact P]. unfold Rsqr. rewrite Q, <- bpow_plus. exact Hm.
Qed.

(* Where the force acts, its share of the distance is not 0. *)
Lemma scale_tight : forall R w K x X z Z, parameters R w K -> coordinate (to64 x) X -> coordinate (to64 z) Z ->
  let L := Z + axis_depth (value32 R) (value32 w) in let rho := distance_from_axis (value32 R) (value32 w) X Z in
  let V := value32 R * value32 R - rho * rho in
  (L <> 0 -> bpow radix2 (-121) <= Rabs L) -> X <> 0 \/ L <> 0 -> rho < value32 R -> bpow radix2 (-241) <= V ->
  bounded 2048 1600000 (-1950) 37 (v_third R w x z) V ->
  bounded 2048 20000000000 (-1529) 147 (scale_third R w K x z) (value32 K * (value32 R - rho) / rho).
Proof.
  intros R w K x X z Z Hp Cx Cz L rho V Sep Hne Hin HV Bv. destruct (rho_tight R w K x X z Z Hp Cx Cz Sep Hne) as [Tr Lr].
  fold rho in Tr, Lr. pose proof Hp as ((FR & _ & FK) & HR & Hw & HK). pose proof (bpow_gt_0 radix2 (-121)) as P121.
  pose proof (bpow_gt_0 radix2 (-241)) as P241.
  pose proof (input_bounded _ _ (to64_is_exact R FR) ltac:(rewrite Rabs_pos_eq; lra)) as BR.
  set (Rad := value32 R) in *. set (k := value32 K) in *. set (rn := rho_third R w x z) in *.
  pose proof (tight_is_bounded 2048 100000000 (-1707) 14 rn rho ltac:(lia) ltac:(numbers; lia) Tr
    ltac:(rewrite Rabs_pos_eq by lra; simpl; lra) ltac:(left; lra) ltac:(numbers; lia)) as Br.
  change (14 + 2 + -1707)%Z with (-1691)%Z in Br. change (14 + 2)%Z with 16%Z in Br.
  assert (BR' : bounded 2048 100000000 (-1691) 16 (number (to64 R)) Rad) by (apply bounded_more with (1 := BR); numbers; lia).
  pose proof (bounded_add 2048 100000000 (-1691) 16 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia) BR' Br) as B1.
  set (sum := add 2048 (number (to64 R)) rn) in *.
  assert (B1' : bounded 2048 110000000 (-1689) 17 sum (Rad + rho)) by (apply bounded_more with (1 := B1); numbers; lia).
  pose proof (bounded_is_tight 2048 110000000 (-1689) 17 (-4) _ _ ltac:(lia) ltac:(numbers; lia) B1'
      ltac:(rewrite Rabs_pos_eq by lra; simpl; lra) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(numbers; lia)) as T1.
  change (-1689 - -4)%Z with (-1685)%Z in T1.
  assert (Tr' : tight 2048 110000000 (-1707) rn rho) by (apply tight_more with (1 := Tr); [numbers; lia|lia]).
  pose proof (tight_multiply 2048 110000000 (-1685) (-1707) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) T1 Tr') as T2.
  set (product := multiply 2048 sum rn) in *.
  assert (T2' : tight 2048 300000000 (-1682) product ((Rad + rho) * rho)) by (apply tight_more with (1 := T2); [numbers; lia|lia]).
  pose proof (bounded_is_tight 2048 1600000 (-1950) 37 (-241) _ _ ltac:(lia) ltac:(numbers; lia) Bv
      ltac:(rewrite Rabs_pos_eq by lra; exact HV) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(numbers; lia)) as Tv.
  change (-1950 - -241)%Z with (-1709)%Z in Tv.
  assert (TK : tight 2048 1600000 (-2048) (number (to64 K)) k).
  { apply tight_more with (1 := exact_third _ _ (to64_is_exact K FK)); [numbers; lia|lia]. }
  pose proof (tight_multiply 2048 1600000 (-2048) (-1709) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) TK Tv) as T3.
  set (force := multiply 2048 (number (to64 K)) (v_third R w x z)) in *.
  assert (T3' : tight 2048 300000000 (-1682) force (k * V)) by (apply tight_more with (1 := T3); [numbers; lia|lia]).
  pose proof (tight_divide 2048 300000000 (-1682) (-1682) _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(lia) ltac:(lia) T3' T2'
    ltac:(apply Rgt_not_eq, Rmult_lt_0_compat; lra)) as T4.
  assert (E : k * V / ((Rad + rho) * rho) = k * (Rad - rho) / rho) by (unfold V; field; lra). rewrite E in T4.
  change (divide_newton 2048 force product) with (scale_third R w K x z) in T4.
  assert (T4' : tight 2048 20000000000 (-1676) (scale_third R w K x z) (k * (Rad - rho) / rho)).
  { apply tight_more with (1 := T4); [numbers; lia|lia]. }
  assert (Hs : 0 < k * (Rad - rho) / rho <= bpow radix2 145).
  { split; [apply Rdiv_lt_0_compat; [apply Rmult_lt_0_compat; lra|lra]|]. unfold Rdiv. change 145%Z with (24 + 121)%Z. rewrite bpow_plus.
    apply Rmult_le_compat; [apply Rmult_le_pos; lra|apply Rlt_le, Rinv_0_lt_compat; lra| |].
    - apply Rle_trans with (1000 * 10000); [apply Rmult_le_compat; lra|simpl; lra].
    - change 121%Z with (- - (121))%Z. rewrite bpow_opp. apply Rinv_le; [exact P121|exact Lr]. }
  pose proof (tight_is_bounded 2048 20000000000 (-1676) 145 _ _ ltac:(lia) ltac:(numbers; lia) T4'
    ltac:(rewrite Rabs_pos_eq by lra; apply Hs) ltac:(left; lra) ltac:(numbers; lia)) as B5.
  exact B5.
Qed.

Lemma times_scale : forall s S a Y, bounded 2048 20000000000 (-1529) 147 s S -> bounded 2048 710000 (-1974) 17 a Y ->
  bounded 2048 50000000000 (-1500) 170 (multiply 2048 s a) (S * Y).
Proof.
  intros s S a Y Bs Ba. assert (Ba' : bounded 2048 20000000000 (-1974) 17 a Y) by (apply bounded_more with (1 := Ba); numbers; lia).
  pose proof (bounded_multiply 2048 20000000000 (-1529) 147 (-1974) 17 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia)
    ltac:(lia) Bs Ba') as B. apply bounded_more with (1 := B); numbers; lia.
Qed.

Lemma force_third : forall R w K x X z Z, parameters R w K -> coordinate (to64 x) X -> coordinate (to64 z) Z ->
  let L := Z + axis_depth (value32 R) (value32 w) in let rho := distance_from_axis (value32 R) (value32 w) X Z in
  let V := value32 R * value32 R - rho * rho in
  (L <> 0 -> bpow radix2 (-121) <= Rabs L) -> X <> 0 \/ L <> 0 -> rho < value32 R -> bpow radix2 (-241) <= V ->
  bounded 2048 1600000 (-1950) 37 (v_third R w x z) V -> let scale := scale_third R w K x z in
  component_third (multiply 2048 scale (number (to64 x))) (cylinder_x (value32 R) (value32 w) (value32 K) X Z) /\
  component_third (multiply 2048 scale (l_third R w z)) (cylinder_z (value32 R) (value32 w) (value32 K) X Z).
Proof.
  intros R w K x X z Z Hp Cx Cz L rho V Sep Hne Hin HV Bv scale.
  pose proof (scale_tight R w K x X z Z Hp Cx Cz Sep Hne Hin HV Bv) as Bs. cbv zeta in Bs. fold rho scale in Bs.
  destruct (rho_tight R w K x X z Z Hp Cx Cz Sep Hne) as [_ Lr]. fold rho in Lr. pose proof (bpow_gt_0 radix2 (-121)) as P121.
  destruct (distance_squared (value32 R) (value32 w) X Z) as [P Q]. fold L rho in P, Q.
  pose proof (l_bounded R w K z Z Hp Cz) as Bl. fold L in Bl.
  pose proof (input_bounded _ _ (coordinate_is _ _ Cx) (coordinate_range _ _ Cx)) as Bx. pose proof Hp as (_ & HR & Hw & HK).
  assert (Bx' : bounded 2048 710000 (-1974) 17 (number (to64 x)) X) by (apply bounded_more with (1 := Bx); numbers; lia).
  unfold cylinder_x, cylinder_z. cbv zeta. fold rho L. rewrite !Rlt_bool_true by exact Hin. rewrite !Req_bool_false by lra.
  set (s := value32 K * (value32 R - rho) / rho) in *.
  assert (size : forall Y Y', rho * rho = Y * Y + Y' * Y' -> Rabs (s * Y) <= 10000000).
  { intros Y Y' H. assert (BY : Rabs Y <= rho).
    { rewrite <- (Rabs_pos_eq rho) by lra. apply Rsqr_le_abs_0. unfold Rsqr. rewrite H. pose proof (Rle_0_sqr Y') as S.
      unfold Rsqr in S. lra. }
    assert (Hs : 0 <= s) by (unfold s; apply Rmult_le_pos; [apply Rmult_le_pos; lra|apply Rlt_le, Rinv_0_lt_compat; lra]).
    rewrite Rabs_mult, (Rabs_pos_eq s) by exact Hs. apply Rle_trans with (s * rho); [now apply Rmult_le_compat_l|].
    replace (s * rho) with (value32 K * (value32 R - rho)) by (unfold s; field; lra).
    apply Rle_trans with (1000 * 10000); [apply Rmult_le_compat; lra|lra]. }
  assert (E : forall Y, value32 K * (value32 R - rho) * (Y / rho) = s * Y) by (intro Y; unfold s; field; lra). rewrite !E.
  split; (split; [now apply times_scale|]).
  - now apply (size X L).
  - apply (size L X). rewrite Q. ring.
Qed.

(* ---- The answer ---- *)

Theorem cylinder_outcome_third_is : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  let touches := distance_from_axis (value32 R) (value32 w) X Z < value32 R in
  let o := cylinder_outcome_third R w K (quantised x) (quantised z) in
  match fst (fst o) with
  | Gt => touches /\ component_third (snd (fst o)) (cylinder_x (value32 R) (value32 w) (value32 K) X Z) /\
    component_third (snd o) (cylinder_z (value32 R) (value32 w) (value32 K) X Z)
  | _ => ~ touches
  end.
Proof.
  intros R w K x y z Hp Hv X Z touches o. destruct (valid_coordinates _ _ _ Hv) as [Cx Cz]. fold X in Cx. fold Z in Cz.
  destruct (quantised_x_is _ _ _ Hv) as [Vx Fx]. fold X in Vx. set (qx := quantised x) in *. set (qz := quantised z) in *.
  pose proof (cylinder_contact_is_separated R w K x y z Hp Hv) as Sep. cbv zeta in Sep. fold X Z in Sep. destruct Sep as (EV & SV & SL).
  destruct (distance_squared (value32 R) (value32 w) X Z) as [P Q].
  pose proof (l_bounded R w K qz Z Hp Cz) as Bl. pose proof (v_bounded R w K qx X qz Z Hp Cx Cz) as Bv. cbv zeta in Bv.
  pose proof (force_third R w K qx X qz Z Hp Cx Cz SL) as F. cbv zeta in F.
  set (rho := distance_from_axis (value32 R) (value32 w) X Z) in *. set (L := Z + axis_depth (value32 R) (value32 w)) in *.
  rewrite <- Q in EV. rewrite EV in SV, Bv. clear EV. pose proof Hp as ((FR & _ & FK) & HR & Hw & HK).
  assert (Sl : is_sign (sign_of_big (l_third R w qz)) L).
  { apply (sign_of_bounded 2048 710000 (-1974) 17 121); try assumption; try lia; try (numbers; lia). }
  set (computed := (sign_of_big (v_third R w qx qz), multiply 2048 (scale_third R w K qx qz) (number (to64 qx)),
    multiply 2048 (scale_third R w K qx qz) (l_third R w qz))).
  assert (off_axis : X <> 0 \/ L <> 0 -> match fst (fst computed) with
  | Gt => touches /\ component_third (snd (fst computed)) (cylinder_x (value32 R) (value32 w) (value32 K) X Z) /\
    component_third (snd computed) (cylinder_z (value32 R) (value32 w) (value32 K) X Z)
  | _ => ~ touches
  end).
  { intro Hne. unfold computed, touches. cbn [fst snd].
    assert (S : is_sign (sign_of_big (v_third R w qx qz)) (value32 R * value32 R - rho * rho)).
    { apply (sign_of_bounded 2048 1600000 (-1950) 37 241); try assumption; try lia; try (numbers; lia). }
    assert (outside : value32 R * value32 R - rho * rho <= 0 -> ~ rho < value32 R).
    { intros H T. assert (rho * rho < value32 R * value32 R) by (apply Rmult_le_0_lt_compat; lra). lra. }
    destruct (sign_of_big (v_third R w qx qz)); cbn [is_sign] in S; [apply outside; lra|apply outside; lra|].
    assert (Hin : rho < value32 R).
    { destruct (Rlt_le_dec rho (value32 R)) as [|H]; [assumption|]. exfalso.
      assert (value32 R * value32 R <= rho * rho) by (apply Rmult_le_compat; lra). lra. }
    specialize (SV ltac:(lra)). rewrite Rabs_pos_eq in SV by lra. split; [exact Hin|]. exact (F Hne Hin SV Bv). }
  unfold o, cylinder_outcome_third. clear o. cbv zeta. rewrite (is_nonzero_is qx Fx), Vx. fold computed. clearbody computed.
  case Req_bool_spec; intro X0; cbn [negb]; [|exact (off_axis (or_introl X0))].
  destruct (sign_of_big (l_third R w qz)); cbn [is_sign] in Sl; [|apply off_axis; right; lra|apply off_axis; right; lra].
  (* on the axis *)
  clear off_axis F. cbn [fst snd]. unfold touches, cylinder_x, cylinder_z. cbv zeta. fold rho L.
  assert (R0 : rho = 0).
  { rewrite X0, Sl in Q. apply Rsqr_0_uniq. unfold Rsqr. lra. }
  rewrite R0. rewrite !Rlt_bool_true by lra. rewrite !Req_bool_true by reflexivity.
  split; [lra|]. replace (value32 K * (value32 R - 0) * 0) with 0 by ring.
  replace (value32 K * (value32 R - 0) * 1) with (value32 K * value32 R) by ring.
  split; split.
  - apply bounded_more with (1 := input_bounded _ _ zero_is ltac:(rewrite Rabs_R0; lra)); numbers; lia.
  - rewrite Rabs_R0. lra.
  - pose proof (input_bounded _ _ (to64_is_exact R FR) ltac:(rewrite Rabs_pos_eq; lra)) as BR.
    pose proof (input_bounded _ _ (to64_is_exact K FK) ltac:(rewrite Rabs_pos_eq; lra)) as BK.
    assert (BR' : bounded 2048 1074 (-1974) 17 (number (to64 R)) (value32 R)) by (apply bounded_more with (1 := BR); numbers; lia).
    assert (BK' : bounded 2048 1074 (-1974) 17 (number (to64 K)) (value32 K)) by (apply bounded_more with (1 := BK); numbers; lia).
    pose proof (bounded_multiply 2048 1074 (-1974) 17 (-1974) 17 _ _ _ _ ltac:(lia) ltac:(numbers; lia) ltac:(numbers; lia) ltac:(lia)
      ltac:(lia) BK' BR') as B. apply bounded_more with (1 := B); numbers; lia.
  - assert (0 <= value32 K * value32 R <= 1000 * 10000) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat; lra]).
    rewrite Rabs_pos_eq; lra.
Qed.

(* A component is fine beside a separation down to 2^-1490. *)
Lemma bounded_is_fine : forall e b s a x, bounded 2048 50000000000 e b a x -> (e <= - s - 4)%Z -> fine 2048 60000000000 (s - 1) a x.
Proof.
  intros e b s a x (N & F & C & E & _) H. split; [exact N|]. split; [apply fits_le with (2 := F); numbers; lia|]. split; [exact C|lia].
Qed.

Theorem cylinder_third_stage_answers_right : forall R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  is_answer (cylinder_third R w K (quantised x) (quantised z)) (distance_from_axis (value32 R) (value32 w) X Z < value32 R)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z) (cylinder_z (value32 R) (value32 w) (value32 K) X Z).
Proof.
  intros R w K x y z Hp Hv X Z. pose proof (cylinder_outcome_third_is R w K x y z Hp Hv) as O. cbv zeta in O. fold X Z in O.
  pose proof (fun m H => cylinder_is_separated R w K x y z m Hp Hv H) as Sep. cbv zeta in Sep. fold X Z in Sep.
  unfold cylinder_third, decide_third. destruct (cylinder_outcome_third R w K (quantised x) (quantised z)) as [[s fx] fz].
  cbn [fst snd] in O. apply (decided_fine_is_right 2048 60000000000 946); try lia; try (numbers; lia); [|exact Sep].
  destruct s; try exact O. destruct O as (T & [Bx Sx] & [Bz Sz]).
  assert (B25 : 10000000 <= bpow radix2 25) by (simpl; lra). split; [exact T|].
  split; [apply (bounded_is_fine (-1500) 170); [exact Bx|lia]|]. split; [lra|].
  split; [apply (bounded_is_fine (-1500) 170); [exact Bz|lia]|lra].
Qed.

(* Every answer is right, for every input of the domain. *)
Theorem cylinder_answers_right : forall is_fused R w K x y z, parameters R w K -> valid x y z = true ->
  let X := read (value32 x) in let Z := read (value32 z) in
  is_answer (evaluate cylinder_window (cylinder_of cylinder R w K is_fused) (later_of (cylinder_second R w K) (cylinder_third R w K)) x y z)
    (distance_from_axis (value32 R) (value32 w) X Z < value32 R)
    (cylinder_x (value32 R) (value32 w) (value32 K) X Z) (cylinder_z (value32 R) (value32 w) (value32 K) X Z).
Proof.
  intros is_fused R w K x y z Hp Hv X Z. apply three_stages_are_right with (cylinder_third R w K (quantised x) (quantised z)).
  - now apply cylinder_two_stages_answer_right.
  - now apply (cylinder_third_stage_answers_right R w K x y z).
Qed.
