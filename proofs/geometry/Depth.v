(* SPDX-License-Identifier: BSD-3-Clause *)
(* The depth d of the cylinder's axis in double-double, axis_depth of fast/laws/bump_geometry.h: what is computed, and how far off. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble.
Open Scope R_scope.

(* ---- DoubleDouble of fast/numbers/double_double.h ---- *)

Record double_double := { hi : binary64; lo : binary64; error : binary64 }.

(* m 2^k *)
Definition constant (m k : Z) : binary64 := binary_normalize 53 1024 (eq_refl _) (eq_refl _) mode_NE m k false.
Definition slack : binary64 := constant (2 ^ 40 + 1) (-40).
Definition almost_one : binary64 := constant (2 ^ 50 - 1) (-50).

Definition exactly64 (v : binary64) : double_double := {| hi := v; lo := zero64; error := zero64 |}.
Definition error_of (value : binary64) (propagated : binary64) : binary64 :=
  times slack (plus propagated (times (two_to (-101)) (absolute value))).
Definition rounded (value : binary64 * binary64) (propagated : binary64) : double_double :=
  {| hi := fst value; lo := snd value; error := error_of (fst value) propagated |}.
Definition negated (a : double_double) : double_double := {| hi := opp (hi a); lo := opp (lo a); error := error a |}.
Definition add (a b : double_double) : double_double := rounded (sum_of (hi a) (lo a) (hi b) (lo b)) (plus (error a) (error b)).
Definition multiply (a b : double_double) : double_double :=
  rounded (product_of (hi a) (lo a) (hi b) (lo b))
    (plus (plus (times (absolute (hi a)) (error b)) (times (absolute (hi b)) (error a))) (times (error a) (error b))).
Definition root_of (a : double_double) : double_double :=
  if is_equal (hi a) zero64 && is_equal (error a) zero64 then a
  else if negb (is_less (error a) (times (hi a) almost_one)) then
    {| hi := zero64; lo := zero64; error := times slack (square_root (plus (absolute (hi a)) (error a))) |}
  else let root := square_root_of (hi a) (lo a) in rounded root (over (error a) (fst root)).

(* axis_depth<DoubleDouble>(R, w) *)
Definition depth_square (R w : binary32) : double_double :=
  multiply (add (exactly64 (to64 R)) (negated (exactly64 (half_width w)))) (add (exactly64 (to64 R)) (exactly64 (half_width w))).
Definition computed_depth (R w : binary32) : double_double := root_of (depth_square R w).

Lemma constant_is : forall m k, (Z.abs m < 2 ^ 53)%Z -> (-1000 <= k <= 100)%Z -> is64 (constant m k) (IZR m * bpow radix2 k).
Proof.
  intros m k Hm Hk. unfold constant. change (IZR m * bpow radix2 k) with (F2R (Float radix2 m k)).
  assert (G : in_binary64 (F2R (Float radix2 m k))).
  { apply generic_format_FLT. exists (Float radix2 m k); [reflexivity|exact Hm|cbn [Fexp]; lia]. }
  assert (Hsize : Rabs (F2R (Float radix2 m k)) <= bpow radix2 1000).
  { rewrite <- F2R_Zabs. unfold F2R. cbn [Fnum Fexp]. apply Rle_trans with (bpow radix2 53 * bpow radix2 k).
    - apply Rmult_le_compat_r; [apply bpow_ge_0|]. change (bpow radix2 53) with (IZR (2 ^ 53)). apply IZR_le. lia.
    - rewrite <- bpow_plus. apply bpow_le. lia. }
  pose proof (binary_normalize_correct 53 1024 (eq_refl _) (eq_refl _) mode_NE m k false) as C.
  operation C. destruct C as (C1 & C2 & _). split; [|exact C2]. rewrite C1. apply round_generic; auto with typeclass_instances.
Qed.

(* ---- The running bound ---- *)

Definition share101 : R := / 2535301200456458802993406410752.  (* 2^-101 *)

Lemma rounded_up : forall a b, 0 <= a <= b -> 0 <= nearest64 a <= b * (1 + unit53) + tiny.
Proof.
  intros a b H. split.
  - rewrite <- (round_0 radix2 fexp64 ZnearestE). apply round_le; auto with typeclass_instances. lra.
  - pose proof (product_is_close a) as C. rewrite (Rabs_pos_eq a) in C by lra. apply Rabs_le_inv in C. pose proof unit_is_small.
    assert (unit53 * a <= unit53 * b) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Lemma error_of_is : forall v x propagated p b, is64 v x -> is64 propagated p -> 0 <= p <= b ->
  b <= 100000000000000000000000000000000000000000000000000 ->
  Rabs x <= 100000000000000000000000000000000000000000000000000 ->
  exists e, is64 (error_of v propagated) e /\ 0 <= e <= 2 * (b + share101 * Rabs x) + 5 * tiny /\ (p = 0 -> x = 0 -> e = 0).
Proof.
  intros v x propagated p b Hv Hp Hpb Hb Hx. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  pose proof (Rabs_pos x) as Px.
  assert (big : forall a, Rabs a <= 1000000000000000000000000000000000000000000000000000000000000 -> not_too_large a).
  { intros a Ha. apply Rle_trans with (bpow radix2 300); [simpl; lra|apply bpow_le; lia]. }
  assert (K : bpow radix2 (-101) = share101) by (unfold share101; simpl; lra).
  pose proof (two_to_is (-101) ltac:(lia)) as I1. rewrite K in I1.
  assert (Hsx : 0 <= share101 * Rabs x <= 100000000000000000000) by (unfold share101; lra).
  pose proof (times_is _ _ _ _ I1 (absolute_is _ _ Hv) ltac:(apply big; rewrite Rabs_pos_eq; lra)) as I2.
  set (t := nearest64 _) in I2.
  assert (Ht : 0 <= t <= share101 * Rabs x * (1 + unit53) + tiny) by (apply rounded_up; lra).
  assert (Ht2 : 0 <= t <= 1001 / 1000 * (share101 * Rabs x) + tiny) by nra.
  pose proof (plus_is _ _ _ _ Hp I2 ltac:(apply big; rewrite Rabs_pos_eq; lra)) as I3. set (s := nearest64 _) in I3.
  assert (Hs : 0 <= s <= (b + (1001 / 1000 * (share101 * Rabs x) + tiny)) * (1 + unit53) + tiny) by (apply rounded_up; lra).
  assert (Hs2 : 0 <= s <= 1001 / 1000 * (b + 1001 / 1000 * (share101 * Rabs x) + tiny) + tiny) by nra.
  pose proof (constant_is (2 ^ 40 + 1) (-40) ltac:(lia) ltac:(lia)) as I4. fold slack in I4. set (k := IZR _ * _) in I4.
  assert (Hk : 1 <= k <= 1001 / 1000) by (unfold k; simpl; lra).
  assert (Hks : 0 <= k * s <= 1001 / 1000 * s) by nra.
  pose proof (times_is _ _ _ _ I4 I3 ltac:(apply big; rewrite Rabs_pos_eq; lra)) as I5. set (e := nearest64 _) in I5.
  assert (He : 0 <= e <= 1001 / 1000 * s * (1 + unit53) + tiny) by (now apply rounded_up).
  assert (He2 : 0 <= e <= 1003 / 1000 * s + tiny) by nra.
  exists e. split; [exact I5|]. split; [lra|]. intros H0 Hx0. unfold e, s, t. rewrite H0, Hx0, Rabs_R0.
  rewrite !Rmult_0_r, round_0, Rplus_0_r, round_0, Rmult_0_r, round_0 by auto with typeclass_instances. reflexivity.
Qed.

(* ---- R - w/2 and R + w/2 are numbers of binary64 ---- *)

Lemma multiple_of : forall k a, (-125 <= k)%Z -> in_binary32 a -> bpow radix2 k <= Rabs a ->
  exists n, a = IZR n * bpow radix2 (k - 23).
Proof.
  intros k a Hk Ha Hs. assert (Hmag : (k + 1 <= mag radix2 a)%Z).
  { apply mag_ge_bpow. now replace (k + 1 - 1)%Z with k by ring. }
  unfold generic_format, scaled_mantissa in Ha. set (m := Ztrunc _) in Ha. set (e := cexp radix2 fexp32 a) in Ha.
  assert (He : (k - 23 <= e)%Z) by (unfold e, cexp, FLT_exp; lia).
  exists (m * 2 ^ (e - (k - 23)))%Z. rewrite Ha at 1. unfold F2R. cbn [Fnum Fexp]. rewrite mult_IZR.
  change (2 ^ (e - (k - 23)))%Z with (Zpower radix2 (e - (k - 23))). rewrite IZR_Zpower by lia. rewrite Rmult_assoc, <- bpow_plus.
  do 2 f_equal. ring.
Qed.

Lemma whole_multiple : forall n a, a = IZR n * bpow radix2 (-34) -> Rabs a <= 32768 -> in_binary64 a.
Proof.
  intros n a -> Ha. apply generic_format_FLT. exists (Float radix2 n (-34)); [reflexivity| |cbn [Fexp]; lia]. cbn [Fnum].
  change (Zpower radix2 53) with 9007199254740992%Z. apply lt_IZR. rewrite abs_IZR.
  rewrite Rabs_mult, (Rabs_pos_eq (bpow _ _)) in Ha by apply bpow_ge_0.
  change (bpow radix2 (-34)) with (/ 17179869184) in Ha. lra.
Qed.

Lemma half_chord_is_binary64 : forall R w K, parameters R w K ->
  let r := value32 R in let c := value32 w / 2 in
  in_binary64 (r - c) /\ in_binary64 (r + c) /\ (r - c = 0 \/ bpow radix2 (-34) <= r - c).
Proof.
  intros R w K (_ & HR & Hw & _) r c.
  destruct (multiple_of (-11) r ltac:(lia) (generic_format_B2R 24 128 R)) as [m Hm].
  { unfold r. rewrite Rabs_pos_eq by lra. simpl. lra. }
  destruct (multiple_of (-10) (value32 w) ltac:(lia) (generic_format_B2R 24 128 w)) as [n Hn].
  { rewrite Rabs_pos_eq by lra. simpl. lra. }
  change (-11 - 23)%Z with (-34)%Z in Hm. change (-10 - 23)%Z with (-33)%Z in Hn.
  assert (Hc : c = IZR n * bpow radix2 (-34)).
  { unfold c. rewrite Hn. replace (bpow radix2 (-33)) with (2 * bpow radix2 (-34)) by (simpl; lra). field. }
  assert (E1 : r - c = IZR (m - n) * bpow radix2 (-34)) by (rewrite minus_IZR, Hc, Hm; ring).
  assert (E2 : r + c = IZR (m + n) * bpow radix2 (-34)) by (rewrite plus_IZR, Hc, Hm; ring).
  split; [|split].
  - apply (whole_multiple _ _ E1). unfold r, c. apply Rabs_le. lra.
  - apply (whole_multiple _ _ E2). unfold r, c. apply Rabs_le. lra.
  - assert (H0 : 0 <= r - c) by (unfold r, c; lra). pose proof (bpow_gt_0 radix2 (-34)) as P.
    destruct (Z.eq_dec (m - n) 0) as [E|E]; [left; rewrite E1, E; ring|right]. rewrite E1 in H0 |- *.
    assert (1 <= IZR (m - n)); [|nra]. apply IZR_le. assert (0 <= m - n)%Z; [|lia].
    apply le_IZR. apply Rmult_le_reg_r with (1 := P). lra.
Qed.

(* ---- The three operations, as d needs them ---- *)

Lemma not_large : forall a, Rabs a <= 10000000000 -> not_too_large a.
Proof. intros a Ha. apply Rle_trans with (bpow radix2 40); [simpl; lra|apply bpow_le; lia]. Qed.

Definition is_exactly (a : double_double) (x : R) : Prop := is64 (hi a) x /\ is64 (lo a) 0 /\ is64 (error a) 0.

Lemma exactly_is : forall v x, is64 v x -> is_exactly (exactly64 v) x.
Proof. intros v x H. split; [exact H|]. split; apply zero_is. Qed.

Lemma negated_is : forall a x, is_exactly a x -> is_exactly (negated a) (- x).
Proof.
  intros [h l e] x (H & L & E). cbn [hi lo error] in *. unfold negated. split; [now apply opp_is|]. split; [|exact E].
  rewrite <- Ropp_0. now apply opp_is.
Qed.

Lemma add_is : forall a b x y, is_exactly a x -> is_exactly b y -> in_binary64 (x + y) -> Rabs x <= 1000000 -> Rabs y <= 1000000 ->
  exists e, is64 (hi (add a b)) (x + y) /\ is64 (lo (add a b)) 0 /\ is64 (error (add a b)) e /\
    0 <= e <= 2 * (share101 * Rabs (x + y)) + 5 * tiny /\ (x + y = 0 -> e = 0).
Proof.
  intros [h l e] [h' l' e'] x y (H & L & E) (H' & L' & E') Hf Hx Hy. cbn [hi lo error] in *. unfold add, rounded. cbn [hi lo error].
  pose proof (Rabs_triang x y) as T.
  destruct (sum_of_exact h l h' l' x y H L H' L' Hf ltac:(apply not_large; lra) ltac:(apply not_large; lra) ltac:(apply not_large;
    lra)) as [S1 S2].
  set (sum := sum_of h l h' l') in *. clearbody sum.
  assert (I0 : is64 (plus e e') 0) by (exact_step plus_exact).
  destruct (error_of_is _ _ _ 0 0 S1 I0 ltac:(lra) ltac:(lra) ltac:(lra)) as (f & F1 & F2 & F3).
  exists f. rewrite Rplus_0_l in F2. split; [exact S1|]. split; [exact S2|]. split; [exact F1|].
  split; [lra|]. intro H0. now apply F3.
Qed.

(* The error of a product is far below it, and 0 where the first factor and its error are. *)
Lemma multiply_is : forall a b x y e f, is64 (hi a) x -> is64 (lo a) 0 -> is64 (error a) e -> is64 (hi b) y -> is64 (lo b) 0 ->
  is64 (error b) f ->
  0 <= x <= 20000 -> 0 < y <= 20000 -> 0 <= e <= 3 * share101 * x -> 0 <= f <= 3 * share101 * y ->
    x * y = 0 \/ / 274877906944 <= x * y ->
  (x = 0 -> e = 0) ->
  exists g, is64 (hi (multiply a b)) (nearest64 (x * y)) /\ is64 (lo (multiply a b)) (x * y - nearest64 (x * y)) /\
    is64 (error (multiply a b)) g /\ 0 <= g <= / 10000000 * (x * y) /\ (x = 0 -> g = 0).
Proof.
  intros [h l ev] [h' l' fv] x y e f H L E H' L' E' Hx Hy He Hf Hlow Hzero. pose proof (proj1 Hy) as Hy0. cbn [hi lo error] in *.
  unfold multiply, rounded. cbn [hi lo error].
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  assert (Hxy : 0 <= x * y) by (apply Rmult_le_pos; lra).
  assert (Hxy2 : x * y <= 400000000) by (replace 400000000 with (20000 * 20000) by ring; apply Rmult_le_compat; lra).
  destruct (product_of_exact h l h' l' x y H L H' L') as [C1 C2].
  { destruct Hlow as [H0|H0]; [now left|right]. rewrite Rabs_pos_eq by assumption. apply Rle_trans with (2 := H0).
    apply Rle_trans with (bpow radix2 (-38)); [apply bpow_le; lia|simpl; lra]. }
  { rewrite Rabs_pos_eq by assumption. apply Rle_trans with (bpow radix2 40); [simpl; lra|apply bpow_le; lia]. }
  set (product := product_of h l h' l') in *. clearbody product.
  assert (Hp : 0 <= nearest64 (x * y) <= x * y * (1 + unit53) + tiny) by (apply rounded_up; lra).
  assert (Hp0 : x * y = 0 -> nearest64 (x * y) = 0) by (intros ->; apply round_0; auto with typeclass_instances).
  set (p := nearest64 (x * y)) in *. clearbody p.
  assert (Ie : e <= 1) by (unfold share101 in He; lra). assert (If : f <= 1) by (unfold share101 in Hf; lra).
  set (s := share101 * (x * y)). assert (Hs : 0 <= s <= / 1000000000000 * (x * y)) by (unfold s, share101; lra).
  assert (Q1 : 0 <= x * f <= 3 * s).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (x * (3 * share101 * y)); [apply Rmult_le_compat_l; lra|unfold s; lra]. }
  assert (Q2 : 0 <= y * e <= 3 * s).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (y * (3 * share101 * x)); [apply Rmult_le_compat_l; lra|unfold s; lra]. }
  assert (Q3 : 0 <= e * f <= s).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with ((3 * share101 * x) * (3 * share101 * y)); [apply Rmult_le_compat; lra|].
    unfold s, share101 in *. lra. }
  assert (one_more : forall a b, 0 <= a <= b -> b <= 100000 -> 0 <= nearest64 a <= 1001 / 1000 * b + tiny /\ not_too_large a).
  { intros a b Ha Hb. split; [|apply not_large; rewrite Rabs_pos_eq; lra]. pose proof (rounded_up a b Ha).
    assert (unit53 * b <= / 1000000000000 * b) by (apply Rmult_le_compat_r; lra). lra. }
  pose proof (absolute_is _ _ H) as AA. pose proof (absolute_is _ _ H') as AB.
  rewrite (Rabs_pos_eq x) in AA by lra. rewrite (Rabs_pos_eq y) in AB by lra.
  destruct (one_more _ _ Q1 ltac:(lra)) as [N1 M1]. pose proof (times_is _ _ _ _ AA E' M1) as J1.
  destruct (one_more _ _ Q2 ltac:(lra)) as [N2 M2]. pose proof (times_is _ _ _ _ AB E M2) as J2.
  destruct (one_more _ _ Q3 ltac:(lra)) as [N3 M3]. pose proof (times_is _ _ _ _ E E' M3) as J3.
  destruct (one_more (nearest64 (x * f) + nearest64 (y * e)) (7 * s + 3 * tiny) ltac:(lra) ltac:(lra)) as [N4 M4].
  pose proof (plus_is _ _ _ _ J1 J2 M4) as J4.
  destruct (one_more (nearest64 (nearest64 (x * f) + nearest64 (y * e)) + nearest64 (e * f)) (9 * s + 7 * tiny) ltac:(lra)
    ltac:(lra)) as [N5 M5].
  pose proof (plus_is _ _ _ _ J4 J3 M5) as J5. set (n := nearest64 (nearest64 _ + nearest64 (e * f))) in *.
  destruct (error_of_is _ _ _ n n C1 J5 ltac:(lra) ltac:(lra) ltac:(rewrite Rabs_pos_eq by lra; unfold unit53 in *;
    lra)) as (g & G1 & G2 & G3).
  assert (Hn : x = 0 -> n = 0).
  { intro H0. unfold n. rewrite H0, (Hzero H0).
    repeat first [rewrite Rmult_0_l|rewrite Rmult_0_r|rewrite Rplus_0_r|rewrite round_0 by auto with typeclass_instances].
    reflexivity. }
  exists g. split; [exact C1|]. split; [exact C2|]. split; [exact G1|].
  assert (G0 : x = 0 -> g = 0) by (intro H0; apply G3; [now apply Hn|apply Hp0; rewrite H0; ring]). split; [|exact G0].
  split; [lra|]. destruct Hlow as [H0|Hlow].
  - rewrite H0, Rmult_0_r. apply Rmult_integral in H0. destruct H0 as [H0|H0]; [rewrite (G0 H0); lra|].
    exfalso. revert H0. apply Rgt_not_eq. exact Hy0.
  - rewrite (Rabs_pos_eq p) in G2 by lra. unfold s, share101, unit53 in *. lra.
Qed.

(* A root of a double-double whose error is far below it. *)
Lemma root_of_is : forall a h l e share, is64 (hi a) h -> is64 (lo a) l -> is64 (error a) e ->
  bpow radix2 (-40) <= h <= bpow radix2 40 ->
  Rabs l <= 101 / 100 * unit53 * h -> 0 <= e <= share * h -> 0 <= share <= / 10 ->
  exists y z f, is64 (hi (root_of a)) y /\ is64 (lo (root_of a)) z /\ is64 (error (root_of a)) f /\
    0 <= f <= (3 * share + / 1000000) * y /\
    Rabs (y - sqrt h) <= / 1000000000000 * sqrt h /\ Rabs z <= unit53 * y /\
    Rabs (sqrt (h + l) - (y + z)) <= 9 * (unit53 * unit53) * y.
Proof.
  intros [ha la ea] h l e share H L E Hh Hl He Hshare. cbn [hi lo error] in *. unfold root_of. cbn [hi lo error].
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny. pose proof (bpow_gt_0 radix2 (-40)) as P40.
  rewrite (equal_is _ _ _ _ H zero_is), (Req_bool_false h 0) by lra. cbn [andb].
  pose proof (constant_is (2 ^ 50 - 1) (-50) ltac:(lia) ltac:(lia)) as Ik. fold almost_one in Ik. set (k := IZR _ * _) in Ik.
  assert (Hk : 999 / 1000 <= k <= 1) by (unfold k; simpl; lra). clearbody k.
  assert (Hhk : 999 / 1000 * h <= h * k <= h).
  { split; [rewrite (Rmult_comm h k); apply Rmult_le_compat_r; lra|]. rewrite <- (Rmult_1_r h) at 2. apply Rmult_le_compat_l; lra. }
  assert (Hh2 : / 1099511627776 <= h <= 1099511627776).
  { change (bpow radix2 (-40)) with (/ 1099511627776) in Hh. change (bpow radix2 40) with 1099511627776 in Hh. exact Hh. }
  assert (Bhk : not_too_large (h * k)).
  { rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 40); [lra|apply bpow_le; lia]. }
  pose proof (times_is _ _ _ _ H Ik Bhk) as Ihk.
  assert (Hless : e < nearest64 (h * k)).
  { assert (share * h <= / 10 * h) by (apply Rmult_le_compat_r; lra). pose proof (product_is_close (h * k)) as Chk.
    rewrite (Rabs_pos_eq (h * k)) in Chk by lra. apply Rabs_le_inv in Chk.
    assert (unit53 * (h * k) <= / 1000000000000 * (h * k)) by (apply Rmult_le_compat_r; lra). lra. }
  rewrite (less_is _ _ _ _ E Ihk), Rlt_bool_true by assumption. cbn [negb]. cbv zeta. unfold rounded. cbn [hi lo error].
  assert (Hh3 : bpow radix2 (-200) <= h <= bpow radix2 40).
  { change (bpow radix2 40) with 1099511627776. split; [|lra]. apply Rle_trans with (bpow radix2 (-40)); [apply bpow_le; lia|].
    change (bpow radix2 (-40)) with (/ 1099511627776). lra. }
  destruct (root_of_both _ _ h l H L Hh3 Hl) as (y & z & R1 & R2 & R3 & R4 & _ & R6).
  pose proof (Rabs_le_inv _ _ R4) as R4'. set (s := sqrt h) in *. assert (Hs2 : s * s = h) by (apply sqrt_sqrt; lra).
  assert (Hs : / 1048576 <= s <= 1048576).
  { assert (S : size (-20) 20 s) by (apply size_root; [now apply size_of|lra]). destruct S as [S1 S2].
    rewrite Rabs_pos_eq in S1, S2 by apply sqrt_pos. split; [exact S1|exact S2]. }
  assert (R5 : Rabs z <= unit53 * y).
  { pose proof (rounding_tail (y + z)) as T. rewrite <- R3 in T. replace (y + z - y) with z in T by ring. apply T. lra. }
  assert (Hy2 : 0 <= share * y) by (apply Rmult_le_pos; lra).
  assert (Hey : 0 <= e / y <= 101 / 100 * share * y).
  { assert (Hy : 0 < y) by lra. split; apply Rmult_le_reg_r with y; try assumption; replace (e / y * y) with e by (field; lra); [lra|].
    apply Rle_trans with (share * (s * s)); [rewrite Hs2; lra|].
    replace (101 / 100 * share * y * y) with (share * (101 / 100 * y * y)) by ring.
    apply Rmult_le_compat_l; [lra|]. apply Rle_trans with (1004 / 1000 * y * (1004 / 1000 * y)); [apply Rmult_le_compat; lra|].
    assert (0 <= y * y) by apply Rle_0_sqr. lra. }
  assert (Hsy : share * y <= / 10 * y) by (apply Rmult_le_compat_r; lra).
  pose proof (over_is _ _ _ _ E R1 ltac:(lra) ltac:(apply not_large; rewrite Rabs_pos_eq; lra)) as Iq.
  assert (Hq : 0 <= nearest64 (e / y) <= 102 / 100 * share * y + / 100000000 * y).
  { pose proof (rounded_up _ _ Hey) as Q.
    assert (unit53 * (101 / 100 * share * y) <= / 1000 * (101 / 100 * share * y)) by (apply Rmult_le_compat_r; lra). lra. }
  destruct (error_of_is _ _ _ _ _ R1 Iq Hq ltac:(lra) ltac:(rewrite Rabs_pos_eq; lra)) as (f & F1 & F2 & _).
  rewrite (Rabs_pos_eq y) in F2 by lra. exists y, z, f. split; [exact R1|]. split; [exact R2|]. split; [exact F1|].
  split; [unfold share101 in F2; lra|]. now split.
Qed.

(* ---- d ---- *)

Theorem computed_depth_is : forall R w K, parameters R w K -> let d := axis_depth (value32 R) (value32 w) in
  exists h l e, is64 (hi (computed_depth R w)) h /\ is64 (lo (computed_depth R w)) l /\
    is64 (error (computed_depth R w)) e /\ 0 <= e <= / 100000 * h /\ Rabs l <= 101 / 100 * unit53 * h /\
    Rabs (d - (h + l)) <= 9 * (unit53 * unit53) * h /\ 0 <= h <= 100002 / 10 /\ (h = 0 \/ bpow radix2 (-21) <= h).
Proof.
  intros R w K Hp d. pose proof (half_width_is _ _ _ Hp) as Ic. pose proof (half_chord_is_binary64 _ _ _ Hp) as F. cbv zeta in F.
  destruct F as (Gm & Gp & Hm). destruct Hp as ((FR & _ & _) & HR & Hw & _).
  assert (IR : is64 (to64 R) (value32 R)) by now apply to64_is_exact.
  set (r := value32 R) in *. set (c := value32 w / 2) in *. pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  assert (Hc : / 2000 <= c <= r) by (unfold c; lra). clearbody r.
  assert (Br : Rabs r <= 1000000) by (rewrite Rabs_pos_eq; lra). assert (Bc : Rabs c <= 1000000) by (rewrite Rabs_pos_eq; lra).
  destruct (add_is _ _ _ _ (exactly_is _ _ IR) (negated_is _ _ (exactly_is _ _ Ic)) Gm Br ltac:(now rewrite Rabs_Ropp))
    as (e & A1 & A2 & A3 & A4 & A5).
  destruct (add_is _ _ _ _ (exactly_is _ _ IR) (exactly_is _ _ Ic) Gp Br Bc) as (f & B1 & B2 & B3 & B4 & _).
  change (r + - c) with (r - c) in *. unfold computed_depth, depth_square.
  set (low := add _ (negated _)) in *. set (high := add _ (exactly64 (half_width w))) in *. clearbody low high.
  assert (ED : d = sqrt ((r - c) * (r + c))) by (unfold d, axis_depth, Rsqr; f_equal; unfold c; ring). clearbody d c.
  set (M := r - c) in *. set (P := r + c) in *. assert (RP : / 10 <= P <= 20000) by (unfold P; lra).
  assert (RM : 0 <= M <= 10000) by (unfold M; lra).
  assert (HMP : M * P <= 100000000).
  { replace (M * P) with (r * r - c * c) by (unfold M, P; ring). assert (0 <= c * c) by apply Rle_0_sqr.
    assert (r * r <= 10000 * 10000) by (apply Rmult_le_compat; lra). lra. }
  clearbody M P. rewrite (Rabs_pos_eq M) in A4 by lra. rewrite (Rabs_pos_eq P) in B4 by lra.
  change (bpow radix2 (-34)) with (/ 17179869184) in Hm.
  assert (Hlow : M * P = 0 \/ / 274877906944 <= M * P).
  { destruct Hm as [Hm|Hm]; [left; rewrite Hm; ring|right]. replace (/ 274877906944) with (/ 17179869184 * / 16) by field.
    apply Rmult_le_compat; lra. }
  assert (A6 : 0 <= e <= 3 * share101 * M).
  { split; [lra|]. destruct Hm as [Hm|Hm]; [rewrite (A5 Hm), Hm; lra|unfold share101 in *; lra]. }
  assert (B6 : 0 <= f <= 3 * share101 * P) by (unfold share101 in *; lra).
  destruct (multiply_is low high M P e f A1 A2 A3 B1 B2 B3 ltac:(lra) ltac:(lra) A6 B6 Hlow A5) as (g & C1 & C2 & C3 & C4 & C5).
  set (square := multiply low high) in *. clearbody square. set (h := nearest64 (M * P)) in *.
  destruct Hlow as [H0|Hlow].
  - (* d = 0 *)
    assert (HM0 : M = 0) by (apply Rmult_integral in H0; destruct H0; [assumption|lra]).
    assert (Hh0 : h = 0) by (unfold h; rewrite H0; apply round_0; auto with typeclass_instances).
    unfold root_of. rewrite (equal_is _ _ _ _ C1 zero_is), (equal_is _ _ _ _ C3 zero_is), (Req_bool_true _ _ Hh0), (Req_bool_true _ _
      (C5 HM0)).
    cbn [andb]. exists h, (M * P - h), g. split; [assumption|]. split; [assumption|]. split; [assumption|].
    rewrite (C5 HM0), ED, H0, Hh0, sqrt_0, !Rmult_0_r.
    replace (0 - 0) with 0 by ring. replace (0 - (0 + 0)) with 0 by ring. rewrite Rabs_R0. repeat split; (lra || now left).
  - pose proof (product_is_close (M * P)) as Ch. fold h in Ch. rewrite (Rabs_pos_eq (M * P)) in Ch by lra. clearbody h.
    assert (Ch2 : Rabs (h - M * P) <= 1001 / 1000 * unit53 * (M * P)) by (unfold unit53 in *; lra). pose proof Ch2 as Ch3.
    apply Rabs_le_inv in Ch3.
    assert (Hh : / 300000000000 <= h <= 100000001) by (unfold unit53 in *; lra).
    destruct (root_of_is square h (M * P - h) g (/ 1000000) C1 C2 C3) as (y & z & f' & R1 & R2 & R3 & R3' & R4 & R5 & R6).
    { change (bpow radix2 (-40)) with (/ 1099511627776). change (bpow radix2 40) with 1099511627776. lra. }
    { rewrite Rabs_minus_sym. apply Rle_trans with (1 := Ch2). unfold unit53 in *. lra. }
    { unfold unit53 in *. lra. } { lra. }
    replace (h + (M * P - h)) with (M * P) in R6 by ring. rewrite <- ED in R6. apply Rabs_le_inv in R4.
    assert (Hs1 : / 1000000 <= sqrt h).
    { replace (/ 1000000) with (sqrt (/ 1000000 * / 1000000)) by (apply sqrt_square; lra). apply sqrt_le_1_alt. lra. }
    assert (Hs2 : sqrt h <= 100001 / 10).
    { replace (100001 / 10) with (sqrt (100001 / 10 * (100001 / 10))) by (apply sqrt_square; lra). apply sqrt_le_1_alt. lra. }
    exists y, z, f'. split; [assumption|]. split; [assumption|]. split; [assumption|]. split; [lra|]. split.
    { apply Rle_trans with (1 := R5). apply Rmult_le_compat_r; lra. }
    split; [assumption|]. split; [lra|].
    right. change (bpow radix2 (-21)) with (/ 2097152). lra.
Qed.
