(* SPDX-License-Identifier: BSD-3-Clause *)
(* What a double-double holds: a positive number, how far off in units of 2^-106, and how large its own bound of the error is.
   Products, quotients and roots may follow each other. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap Polygons.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear.
Open Scope R_scope.

(* The quotient of fast/numbers/double_double.h. *)
Definition divide (a b : double_double) : double_double :=
  let size := minus (times (absolute (hi b)) almost_one) (error b) in
  if negb (is_less zero64 size) then {| hi := zero64; lo := zero64; error := B754_infinity 53 1024 false |}
  else
    let q := quotient_of (hi a) (lo a) (hi b) (lo b) in
    rounded q (over (plus (error a) (times (absolute (fst q)) (error b))) size).

(* n units of 2^-106 off x at most; the bound of the error is no more than this share of the number. *)
Definition holds (n share : R) (a : double_double) (x : R) : Prop :=
  exists y z e, is64 (hi a) y /\ is64 (lo a) z /\ is64 (error a) e /\ 0 <= e <= share * y /\ Rabs z <= unit53 * y /\
    near (n * unit53) (y + z) x.

Lemma near_parts : forall n y z x, near (n * unit53) (y + z) x -> 0 <= n <= 1000 -> Rabs z <= unit53 * y -> 0 < x ->
  999999 / 1000000 * x <= y <= 1000001 / 1000000 * x.
Proof.
  intros n y z x H Hn Hz Hx. pose proof unit_is_small as Hu.
  assert (Hnu : 0 <= n * unit53 <= / 1000000000).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (1000 * unit53); [apply Rmult_le_compat_r; lra|lra]. }
  pose proof (near_is_close _ _ _ H ltac:(lra)) as C. rewrite (Rabs_pos_eq x) in C by lra.
  assert (n * unit53 * (1 + / 1000) * unit53 * x <= / 1000000000 * x).
  { apply Rmult_le_compat_r; [lra|]. apply Rle_trans with (1 * unit53); [apply Rmult_le_compat_r; lra|lra]. }
  absolute_values. unfold unit53 in *. lra.
Qed.

Lemma holds_exactly : forall v x, is64 v x -> 0 < x -> holds 0 0 (exactly64 v) x.
Proof.
  intros v x H Hx. pose proof unit_is_small as Hu. exists x, 0, 0. split; [exact H|]. split; [apply zero_is|]. split; [apply zero_is|].
  split; [lra|]. split; [rewrite Rabs_R0; apply Rmult_le_pos; lra|]. rewrite Rplus_0_r, Rmult_0_l. apply near_exactly.
Qed.

Lemma holds_more : forall n m s t a x, holds n s a x -> n <= m -> s <= t -> holds m t a x.
Proof.
  intros n m s t a x (y & z & e & Y & Z & E & Be & Bz & N) Hn Hs. pose proof unit_is_small as Hu. exists y, z, e.
  assert (Hy : 0 <= y) by (apply Rmult_le_reg_l with unit53; [lra|pose proof (Rabs_pos z); lra]).
  split; [exact Y|]. split; [exact Z|]. split; [exact E|]. split; [|split; [exact Bz|]].
  - split; [lra|]. apply Rle_trans with (1 := proj2 Be). now apply Rmult_le_compat_r.
  - apply (near_more _ _ _ _ N). apply Rmult_le_compat_r; lra.
Qed.

(* The same in absolute errors. *)
Lemma holds_close : forall n s a x, holds n s a x -> 0 <= n <= 400 -> 0 < x ->
  exists y z e, is64 (hi a) y /\ is64 (lo a) z /\ is64 (error a) e /\ 0 <= e <= s * y /\ Rabs z <= unit53 * y /\
    Rabs (y + z - x) <= n * (101 / 100) * (unit53 * unit53) * x /\ 999999 / 1000000 * x <= y <= 1000001 / 1000000 * x.
Proof.
  intros n s a x (y & z & e & Y & Z & E & Be & Bz & N) Hn Hx. pose proof unit_is_small as Hu. exists y, z, e.
  split; [exact Y|]. split; [exact Z|]. split; [exact E|]. split; [exact Be|]. split; [exact Bz|].
  split; [|apply (near_parts n _ z); lra || assumption].
  assert (Hnu : 0 <= n * unit53 <= 400 * unit53) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  pose proof (near_is_close _ _ _ N ltac:(lra)) as C. rewrite (Rabs_pos_eq x) in C by lra. apply Rle_trans with (1 := C).
  apply Rmult_le_compat_r; [lra|]. replace (n * (101 / 100) * (unit53 * unit53)) with (n * unit53 * (101 / 100) * unit53) by ring.
  apply Rmult_le_compat_r; lra.
Qed.

(* The first of the two terms is off by little more than a rounding. *)
Lemma holds_factor : forall n s a x, holds n s a x -> 0 <= n <= 400 -> / 1000000000000 <= x <= 1000 -> factor (hi a) x.
Proof.
  intros n s a x H Hn Hx. destruct (holds_close _ _ _ _ H Hn ltac:(lra)) as (y & z & _ & [V F] & _ & _ & _ & Bz & C & _).
  split; [exact F|]. rewrite V, (Rabs_pos_eq x) by lra. split.
  - assert (C' : Rabs (y + z - x) <= 404 * (unit53 * unit53) * x).
    { apply Rle_trans with (1 := C). apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_r; [unfold unit53; lra|lra]. }
    clear C. absolute_values. apply Rabs_le. unfold unit53 in *. lra.
  - apply size_of.
    + apply Rle_trans with (bpow radix2 (-40)); [apply bpow_le; lia|change (bpow radix2 (-40)) with (/ 1099511627776); lra].
    + change (bpow radix2 10) with 1024. lra.
Qed.

(* What is near in two terms, of what is near in turn. *)
Lemma two_near_is : forall t X M k n x, two_near t X (k * (unit53 * unit53) * M) -> 0 <= k <= 100 -> 0 < X ->
  0 <= M <= 1001 / 1000 * X -> near (n * unit53) X x ->
  exists y z, is64 (fst t) y /\ is64 (snd t) z /\ Rabs z <= unit53 * y /\ near ((n + k * (101 / 100)) * unit53) (y + z) x.
Proof.
  intros t X M k n x (y & z & Y & Z & Bz & B) Hk HX HM HN. pose proof unit_is_small as Hu. exists y, z.
  split; [exact Y|]. split; [exact Z|]. split; [exact Bz|].
  assert (Huu : 0 <= unit53 * unit53 <= / 1000000000000) by (unfold unit53; lra).
  assert (Hkuu : 0 <= k * (unit53 * unit53) <= / 10000000000).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (100 * (unit53 * unit53)); [apply Rmult_le_compat_r; lra|lra]. }
  replace ((n + k * (101 / 100)) * unit53) with (k * (101 / 100) * unit53 + n * unit53) by ring.
  apply near_then with X; [|exact HN].
  apply near_more with (k * (unit53 * unit53) * (1001 / 1000) * (1 + / 1000) / unit53).
  - apply close_is_near; [|lra]. rewrite (Rabs_pos_eq X) by lra. apply Rle_trans with (1 := B).
    rewrite (Rmult_assoc (k * (unit53 * unit53))). apply Rmult_le_compat_l; lra.
  - replace (k * (unit53 * unit53) * (1001 / 1000) * (1 + / 1000) / unit53) with (k * unit53 * (1001 / 1000 * (1 + / 1000)))
      by (field; lra).
    replace (k * (101 / 100) * unit53) with (k * unit53 * (101 / 100)) by ring.
    apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|lra].
Qed.

Lemma low_part : forall y z, Rabs z <= unit53 * y -> 0 < y -> Rabs z <= 101 / 100 * unit53 * y.
Proof. intros y z H Hy. apply Rle_trans with (1 := H). apply Rmult_le_compat_r; [lra|unfold unit53; lra]. Qed.

Theorem holds_multiply : forall n m s t a b x x', holds n s a x -> holds m t b x' -> 0 <= n <= 400 -> 0 <= m <= 400 ->
  0 <= s <= / 10 -> 0 <= t <= / 10 -> / 100000000 <= x <= 100000 -> / 100000000 <= x' <= 100000 -> x * x' <= 100000 ->
  holds (n + m + 8) (3 * (s + t) + / 1000000) (multiply a b) (x * x').
Proof.
  intros n m s t [ha la ea] [hb lb eb] x x' (h & l & e & H & L & E & Be & Bl & N) (c & k & f & H' & L' & F & Bf & Bk & N') Hn Hm Hs
    Ht Hx Hx' Hp. cbn [hi lo error] in *.
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  pose proof (near_parts _ _ _ _ N ltac:(lra) Bl ltac:(lra)) as Rh. pose proof (near_parts _ _ _ _ N' ltac:(lra) Bk ltac:(lra)) as Rc.
  assert (Xlow : / 10000000000000000 <= x * x').
  { replace (/ 10000000000000000) with (/ 100000000 * / 100000000) by field. apply Rmult_le_compat; lra. }
  assert (Hhc : 9999 / 10000 * (x * x') <= h * c <= 10001 / 10000 * (x * x')).
  { split.
    - apply Rle_trans with ((999999 / 1000000 * x) * (999999 / 1000000 * x')); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with ((1000001 / 1000000 * x) * (1000001 / 1000000 * x')); [apply Rmult_le_compat; lra|lra]. }
  pose proof (product_of_is_near ha la hb lb h l c k H L H' L' ltac:(lra) ltac:(lra) (low_part _ _ Bl ltac:(lra))
    (low_part _ _ Bk ltac:(lra))) as T.
  pose proof (near_times _ _ _ _ _ _ N N') as NN. replace (n * unit53 + m * unit53) with ((n + m) * unit53) in NN by ring.
  assert (Hhc2 : 9999 / 10000 * (h * c) <= (h + l) * (c + k)).
  { apply Rle_trans with ((99999 / 100000 * h) * (99999 / 100000 * c)); [assert (0 <= h * c) by lra; lra|].
    pose proof Bl as A1. pose proof Bk as A2. absolute_values. unfold unit53 in *. apply Rmult_le_compat; lra. }
  destruct (two_near_is _ _ _ _ _ _ T ltac:(lra) ltac:(lra) ltac:(lra) NN) as (y & z & Y & Z & Bz & Ny).
  assert (Ny8 : near ((n + m + 8) * unit53) (y + z) (x * x')) by (apply (near_more _ _ _ _ Ny); apply Rmult_le_compat_r; lra).
  pose proof (near_parts _ _ _ _ Ny8 ltac:(lra) Bz ltac:(lra)) as Ry.
  (* the bound of the error *)
  set (p := h * c) in *. set (q := x * x') in *.
  assert (Sp : 0 <= s * p <= / 10 * p) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Tp : 0 <= t * p <= / 10 * p) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Q1 : 0 <= h * f <= t * p).
  { split; [apply Rmult_le_pos; lra|]. replace (t * p) with (h * (t * c)) by (unfold p; ring). apply Rmult_le_compat_l; lra. }
  assert (Q2 : 0 <= c * e <= s * p).
  { split; [apply Rmult_le_pos; lra|]. replace (s * p) with (c * (s * h)) by (unfold p; ring). apply Rmult_le_compat_l; lra. }
  assert (Q3 : 0 <= e * f <= / 10 * (s * p)).
  { split; [apply Rmult_le_pos; lra|]. replace (/ 10 * (s * p)) with (s * h * (/ 10 * c)) by (unfold p; ring).
    assert (t * c <= / 10 * c) by (apply Rmult_le_compat_r; lra). apply Rmult_le_compat; lra. }
  assert (one_more : forall a b, 0 <= a <= b -> b <= 1000000 -> 0 <= nearest64 a <= 1001 / 1000 * b + tiny /\ not_too_large a).
  { intros a b Ha Hb. split; [|apply not_large; rewrite Rabs_pos_eq; lra]. pose proof (rounded_up a b Ha).
    assert (unit53 * b <= / 1000000000000 * b) by (apply Rmult_le_compat_r; lra). lra. }
  pose proof (absolute_is _ _ H) as AA. pose proof (absolute_is _ _ H') as AB.
  rewrite (Rabs_pos_eq h) in AA by lra. rewrite (Rabs_pos_eq c) in AB by lra.
  destruct (one_more _ _ Q1 ltac:(lra)) as [N1 M1]. pose proof (times_is _ _ _ _ AA F M1) as J1.
  destruct (one_more _ _ Q2 ltac:(lra)) as [N2 M2]. pose proof (times_is _ _ _ _ AB E M2) as J2.
  destruct (one_more _ _ Q3 ltac:(lra)) as [N3 M3]. pose proof (times_is _ _ _ _ E F M3) as J3.
  destruct (one_more (nearest64 (h * f) + nearest64 (c * e)) (1001 / 1000 * (s * p + t * p) + 2 * tiny) ltac:(lra) ltac:(lra))
    as [N4 M4].
  pose proof (plus_is _ _ _ _ J1 J2 M4) as J4.
  destruct (one_more (nearest64 (nearest64 (h * f) + nearest64 (c * e)) + nearest64 (e * f)) (12 / 10 * (s * p + t * p) + 9 * tiny)
    ltac:(lra) ltac:(lra)) as [N5 M5].
  pose proof (plus_is _ _ _ _ J4 J3 M5) as J5. set (u := nearest64 (nearest64 _ + nearest64 (e * f))) in *.
  unfold multiply, rounded. cbn [hi lo error].
  destruct (error_of_is _ _ _ u (1202 / 1000 * (s * p + t * p) + 11 * tiny) Y J5 ltac:(lra) ltac:(lra)
    ltac:(rewrite Rabs_pos_eq by lra; lra)) as (g & G1 & G2 & _).
  rewrite (Rabs_pos_eq y) in G2 by lra.
  exists y, z, g. split; [exact Y|]. split; [exact Z|]. split; [exact G1|]. split; [|split; [exact Bz|exact Ny8]].
  split; [lra|]. assert (s * p <= s * (1001 / 1000 * y)) by (apply Rmult_le_compat_l; lra).
  assert (t * p <= t * (1001 / 1000 * y)) by (apply Rmult_le_compat_l; lra).
  assert (0 <= s * y) by (apply Rmult_le_pos; lra). assert (0 <= t * y) by (apply Rmult_le_pos; lra).
  assert (share101 * y <= / 1000000000 * y) by (apply Rmult_le_compat_r; [lra|unfold share101; lra]).
  assert (30 * tiny <= / 1000000000 * y) by lra. lra.
Qed.

Theorem holds_divide : forall n m s t a b x x', holds n s a x -> holds m t b x' -> 0 <= n <= 400 -> 0 <= m <= 400 ->
  0 <= s <= / 10 -> 0 <= t <= / 10 -> / 100000000 <= x <= 100000 -> / 100 <= x' <= 100000 -> x / x' <= 100000 ->
  holds (n + m + 14) (3 * (s + t) + / 1000000) (divide a b) (x / x').
Proof.
  intros n m s t [ha la ea] [hb lb eb] x x' (c & k & e & H & L & E & Be & Bk & N) (h & l & f & H' & L' & F & Bf & Bl & N') Hn Hm Hs
    Ht Hx Hx' Hp. cbn [hi lo error] in *.
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  pose proof (near_parts _ _ _ _ N ltac:(lra) Bk ltac:(lra)) as Rc. pose proof (near_parts _ _ _ _ N' ltac:(lra) Bl ltac:(lra)) as Rh.
  set (Q := x / x') in *. assert (HQ : Q * x' = x) by (unfold Q; field; lra).
  assert (Qlow : / 10000000000000 <= Q) by (apply Rmult_le_reg_r with x'; lra).
  pose proof (quotient_of_is_near ha la hb lb c k h l H L H' L' ltac:(lra) ltac:(lra) (low_part _ _ Bk ltac:(lra))
    (low_part _ _ Bl ltac:(lra))) as T.
  pose proof (near_over _ _ _ _ _ _ N N' ltac:(lra)) as NN. replace (n * unit53 + m * unit53) with ((n + m) * unit53) in NN by ring.
  fold Q in NN. set (X := (c + k) / (h + l)) in *. pose proof Bl as A1. pose proof Bk as A2. absolute_values.
  assert (HX : 0 < X) by (unfold X, Rdiv; apply Rmult_lt_0_compat; [unfold unit53 in *; lra|apply Rinv_0_lt_compat; unfold unit53 in *;
    lra]).
  destruct (two_near_is _ _ _ _ _ _ T ltac:(lra) HX ltac:(lra) NN) as (y & z & Y & Z & Bz & Ny).
  assert (Ny14 : near ((n + m + 14) * unit53) (y + z) Q) by (apply (near_more _ _ _ _ Ny); apply Rmult_le_compat_r; lra).
  pose proof (near_parts _ _ _ _ Ny14 ltac:(lra) Bz ltac:(lra)) as Ry.
  (* the divisor is not 0 *)
  pose proof (constant_is (2 ^ 50 - 1) (-50) ltac:(lia) ltac:(lia)) as Ik. fold almost_one in Ik. set (j := IZR _ * _) in Ik.
  assert (Hj : 999 / 1000 <= j <= 1) by (unfold j; simpl; lra). clearbody j.
  pose proof (absolute_is _ _ H') as Ah. rewrite (Rabs_pos_eq h) in Ah by lra.
  assert (Hhj : 999 / 1000 * h <= h * j <= h).
  { split; [rewrite (Rmult_comm h j); apply Rmult_le_compat_r; lra|]. rewrite <- (Rmult_1_r h) at 2. apply Rmult_le_compat_l; lra. }
  pose proof (times_is _ _ _ _ Ah Ik ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as I1.
  assert (close : forall b, 0 <= b <= 1000000 -> 999 / 1000 * b - tiny <= nearest64 b <= 1001 / 1000 * b + tiny).
  { intros b Hb. pose proof (product_is_close b) as C. rewrite (Rabs_pos_eq b) in C by lra. apply Rabs_le_inv in C.
    assert (unit53 * b <= / 1000 * b) by (apply Rmult_le_compat_r; lra). lra. }
  pose proof (close (h * j) ltac:(lra)) as C1.
  assert (Th : t * h <= / 10 * h) by (apply Rmult_le_compat_r; lra).
  pose proof (minus_is _ _ _ _ I1 F ltac:(apply big_enough, Rabs_le; lra)) as I2.
  pose proof (close (nearest64 (h * j) - f) ltac:(lra)) as C2. set (size := nearest64 (nearest64 (h * j) - f)) in *.
  assert (Hsize : 89 / 100 * h <= size <= 2 * h) by lra.
  unfold divide. cbn [hi lo error]. cbv zeta.
  rewrite (less_is _ _ _ _ zero_is I2), Rlt_bool_true by lra. cbn [negb]. unfold rounded. cbn [hi lo].
  (* the bound of the error *)
  assert (Hyh : 999 / 1000 * c <= y * h <= 1001 / 1000 * c).
  { split.
    - apply Rle_trans with ((999999 / 1000000 * Q) * (999999 / 1000000 * x')); [lra|apply Rmult_le_compat; lra].
    - apply Rle_trans with ((1000001 / 1000000 * Q) * (1000001 / 1000000 * x')); [apply Rmult_le_compat; lra|lra]. }
  assert (Sc : 0 <= s * c <= / 10 * c) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Tc : 0 <= t * c <= / 10 * c) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (Q1 : 0 <= y * f <= 1001 / 1000 * (t * c)).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (y * (t * h)); [apply Rmult_le_compat_l; lra|].
    replace (y * (t * h)) with (t * (y * h)) by ring. replace (1001 / 1000 * (t * c)) with (t * (1001 / 1000 * c)) by ring.
    apply Rmult_le_compat_l; lra. }
  pose proof (absolute_is _ _ Y) as Ay. rewrite (Rabs_pos_eq y) in Ay by lra.
  pose proof (times_is _ _ _ _ Ay F ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J1.
  pose proof (close (y * f) ltac:(lra)) as D1.
  assert (P1 : 0 <= nearest64 (y * f)) by (apply (rounded_up _ _ (conj (proj1 Q1) (Rle_refl _)))).
  pose proof (plus_is _ _ _ _ E J1 ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J2.
  pose proof (close (e + nearest64 (y * f)) ltac:(lra)) as D2.
  assert (P2 : 0 <= nearest64 (e + nearest64 (y * f))).
  { apply (rounded_up _ (e + nearest64 (y * f))). lra. }
  set (num := nearest64 (e + nearest64 (y * f))) in *.
  assert (Hnum : num <= 1004 / 1000 * (s * c + t * c) + 3 * tiny) by lra.
  set (g := (12 / 10 * (s + t) + / 10000000) * y).
  assert (Hg : num <= g * (89 / 100 * h)).
  { unfold g. replace ((12 / 10 * (s + t) + / 10000000) * y * (89 / 100 * h)) with
      (89 / 100 * (12 / 10 * (s * (y * h) + t * (y * h)) + / 10000000 * (y * h))) by ring.
    assert (s * (999 / 1000 * c) <= s * (y * h)) by (apply Rmult_le_compat_l; lra).
    assert (t * (999 / 1000 * c) <= t * (y * h)) by (apply Rmult_le_compat_l; lra). lra. }
  assert (Hg0 : 0 <= g <= 3 / 10 * y).
  { unfold g. split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]. }
  assert (Hq : 0 <= num / size <= g).
  { split; [apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]|]. apply Rmult_le_reg_r with size; [lra|].
    unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. apply Rle_trans with (1 := Hg). apply Rmult_le_compat_l; lra. }
  pose proof (over_is _ _ _ _ J2 I2 ltac:(lra) ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J3.
  assert (D3 : 0 <= nearest64 (num / size) <= 1001 / 1000 * g + tiny).
  { pose proof (rounded_up _ _ Hq). assert (unit53 * g <= / 1000 * g) by (apply Rmult_le_compat_r; lra). lra. }
  destruct (error_of_is _ _ _ _ _ Y J3 D3 ltac:(lra) ltac:(rewrite Rabs_pos_eq by lra; lra)) as (r & G1 & G2 & _).
  rewrite (Rabs_pos_eq y) in G2 by lra.
  exists y, z, r. split; [exact Y|]. split; [exact Z|]. split; [exact G1|]. split; [|split; [exact Bz|exact Ny14]].
  split; [lra|]. unfold g in *. assert (0 <= s * y) by (apply Rmult_le_pos; lra). assert (0 <= t * y) by (apply Rmult_le_pos; lra).
  assert (share101 * y <= / 1000000000 * y) by (apply Rmult_le_compat_r; [lra|unfold share101; lra]).
  assert (30 * tiny <= / 1000000000 * y) by lra. lra.
Qed.

Theorem holds_root : forall n s a x, holds n s a x -> 0 <= n <= 400 -> 0 <= s <= / 10 -> / 1000000 <= x <= 1000000 ->
  holds (n / 2 + 10) (3 * s + / 1000000) (root_of a) (sqrt x).
Proof.
  intros n s a x (h & l & e & H & L & E & Be & Bl & N) Hn Hs Hx. pose proof unit_is_small as Hu.
  pose proof (near_parts _ _ _ _ N ltac:(lra) Bl ltac:(lra)) as Rh.
  destruct (root_of_is a h l e s H L E) as (y & z & f & Y & Z & F & Bf & Cy & Bz & Cr); try assumption.
  { change (bpow radix2 (-40)) with (/ 1099511627776). change (bpow radix2 40) with 1099511627776. lra. }
  { apply low_part; lra. }
  exists y, z, f. split; [exact Y|]. split; [exact Z|]. split; [exact F|]. split; [exact Bf|]. split; [exact Bz|].
  pose proof Bl as A1. pose proof Bz as A2. absolute_values.
  replace ((n / 2 + 10) * unit53) with (10 * unit53 + n * unit53 / 2) by field.
  apply near_then with (sqrt (h + l)); [|apply near_root; [exact N|lra]].
  assert (Hr : 0 < sqrt (h + l)) by (apply sqrt_lt_R0; unfold unit53 in *; lra).
  assert (Hy0 : 0 < sqrt h) by (apply sqrt_lt_R0; lra).
  apply near_more with (9 * (unit53 * unit53) * (1001 / 1000) * (1 + / 1000) / unit53).
  - apply close_is_near; [|unfold unit53; lra]. rewrite (Rabs_pos_eq (sqrt (h + l))) by lra. apply Rabs_le. unfold unit53 in *. lra.
  - replace (9 * (unit53 * unit53) * (1001 / 1000) * (1 + / 1000) / unit53) with (9 * (1001 / 1000) * (1 + / 1000) * unit53)
      by (field; lra).
    lra.
Qed.

(* x + y, where x is a binary64 and y, if negative, is at most half as large. *)
Theorem holds_sum : forall n s v x b y h l e, is64 v x -> is64 (hi b) h -> is64 (lo b) l -> is64 (error b) e -> 0 <= n <= 400 ->
  0 <= s <= / 10 -> 0 <= e <= s * Rabs h -> Rabs l <= unit53 * Rabs h -> / 1000000 <= x <= 100000 -> - (x / 2) <= y <= 100000 ->
  Rabs (h + l - y) <= n * (101 / 100) * (unit53 * unit53) * Rabs y -> holds (102 / 100 * n + 4) (3 * s + / 1000000) (add (exactly64 v)
    b) (x + y).
Proof.
  intros n s v x [hb lb eb] y h l e V H L E Hn Hs He Hl Hx Hy C. cbn [hi lo error] in *.
  pose proof unit_is_small as Hu. pose proof tiny_is_tiny as Htiny.
  assert (Hyx : Rabs y <= x + y) by (apply Rabs_le; lra).
  set (uu := unit53 * unit53) in *. assert (Huu : 0 < uu <= / 1000000000000 * unit53) by (unfold uu, unit53; lra).
  assert (Hnu : 0 <= n * (101 / 100) * uu <= 404 * uu) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (C2 : Rabs (h + l - y) <= n * (101 / 100) * uu * (x + y)) by (apply Rle_trans with (1 := C); apply Rmult_le_compat_l; lra).
  assert (C3 : Rabs (h + l - y) <= / 1000000000 * (x + y)).
  { apply Rle_trans with (1 := C2). apply Rmult_le_compat_r; lra. }
  assert (Hh1 : Rabs h <= Rabs y + / 1000000 * (x + y)).
  { assert (Rabs h <= Rabs (h + l - y) + Rabs y + Rabs l).
    { replace h with ((h + l - y) + y + - l) at 1 by ring. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp.
      pose proof (Rabs_triang (h + l - y) y). lra. }
    assert (unit53 * Rabs h <= / 1000000000000 * Rabs h) by (apply Rmult_le_compat_r; [apply Rabs_pos|lra]).
    pose proof (Rabs_pos h). lra. }
  assert (Hl2 : Rabs l <= / 100000000000 * (x + y)).
  { apply Rle_trans with (1 := Hl). apply Rle_trans with (/ 1000000000000 * Rabs h); [apply Rmult_le_compat_r;
    [apply Rabs_pos|lra]|lra]. }
  pose proof (Rabs_le_inv _ _ C3) as C4. pose proof (Rabs_le_inv _ _ Hl2) as Hl3.
  assert (Bl : Rabs l <= 101 / 100 * unit53 * Rabs h).
  { apply Rle_trans with (1 := Hl). apply Rmult_le_compat_r; [apply Rabs_pos|lra]. }
  destruct (sum_of_is_near v zero64 hb lb x h l V zero_is H L ltac:(lra) ltac:(lra) Bl) as (p & q & P & Q & Bq & B).
  fold uu in B. unfold add, rounded, exactly64. cbn [hi lo error].
  assert (Hs0 : 0 <= s * Rabs h <= 11 / 10 * (s * (x + y))).
  { split; [apply Rmult_le_pos; [lra|apply Rabs_pos]|]. replace (11 / 10 * (s * (x + y))) with (s * (11 / 10 * (x + y))) by ring.
    apply Rmult_le_compat_l; lra. }
  assert (Hsy : s * (x + y) <= / 10 * (x + y)) by (apply Rmult_le_compat_r; lra).
  assert (B2 : Rabs (p + q - (x + y)) <= (n * (101 / 100) + 301 / 100) * uu * (x + y)).
  { replace (p + q - (x + y)) with ((p + q - (x + (h + l))) + (h + l - y)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    assert (3 * uu * (x + h) <= 301 / 100 * uu * (x + y)).
    { replace (3 * uu * (x + h)) with (uu * (3 * (x + h))) by ring.
      replace (301 / 100 * uu * (x + y)) with (uu * (301 / 100 * (x + y))) by ring.
      apply Rmult_le_compat_l; lra. }
    lra. }
  assert (Hk : 0 <= (n * (101 / 100) + 301 / 100) * uu <= / 1000000000).
  { split; [apply Rmult_le_pos; lra|]. apply Rle_trans with (408 * uu); [apply Rmult_le_compat_r; lra|lra]. }
  assert (N : near ((102 / 100 * n + 4) * unit53) (p + q) (x + y)).
  { apply near_more with ((n * (101 / 100) + 301 / 100) * uu * (1 + / 1000) / unit53).
    - apply close_is_near; [now rewrite (Rabs_pos_eq (x + y)) by lra|lra].
    - replace ((n * (101 / 100) + 301 / 100) * uu * (1 + / 1000) / unit53) with ((n * (101 / 100) + 301 / 100) * (1 + / 1000) * unit53)
        by (unfold uu; field; lra).
      apply Rmult_le_compat_r; lra. }
  pose proof (near_parts _ _ _ _ N ltac:(lra) Bq ltac:(lra)) as Rp.
  assert (Ie : is64 (plus zero64 eb) e).
  { apply plus_exact with 0 e; try assumption; [apply zero_is|ring|now apply format_of in E|]. apply big_enough, Rabs_le. lra. }
  destruct (error_of_is _ _ _ e (11 / 10 * (s * (x + y))) P Ie ltac:(lra) ltac:(lra) ltac:(rewrite Rabs_pos_eq by lra; lra))
    as (f & F1 & F2 & _).
  rewrite (Rabs_pos_eq p) in F2 by lra.
  exists p, q, f. split; [exact P|]. split; [exact Q|]. split; [exact F1|]. split; [|split; [exact Bq|exact N]].
  split; [lra|]. assert (s * (x + y) <= s * (101 / 100 * p)) by (apply Rmult_le_compat_l; lra).
  assert (0 <= s * p) by (apply Rmult_le_pos; lra).
  assert (share101 * p <= / 1000000000 * p) by (apply Rmult_le_compat_r; [lra|unfold share101; lra]). lra.
Qed.

Theorem holds_add : forall n s v x b y, is64 v x -> holds n s b y -> 0 <= n <= 400 -> 0 <= s <= / 10 -> / 1000000 <= x <= 100000 ->
  0 < y <= 100000 -> holds (102 / 100 * n + 4) (3 * s + / 1000000) (add (exactly64 v) b) (x + y).
Proof.
  intros n s v x b y V H Hn Hs Hx Hy. destruct (holds_close _ _ _ _ H Hn ltac:(lra)) as (h & l & e & B1 & B2 & B3 & He & Hl & C & Rh).
  apply (holds_sum n s v x b y h l e); try assumption; try lra.
  - now rewrite (Rabs_pos_eq h) by lra.
  - now rewrite (Rabs_pos_eq h) by lra.
  - now rewrite (Rabs_pos_eq y) by lra.
Qed.

(* x - y, y at most half of x. *)
Theorem holds_subtract : forall n s v x b y, is64 v x -> holds n s b y -> 0 <= n <= 400 -> 0 <= s <= / 10 -> / 1000000 <= x <= 100000
  ->
  0 < y <= x / 2 -> holds (102 / 100 * n + 4) (3 * s + / 1000000) (add (exactly64 v) (negated b)) (x - y).
Proof.
  intros n s v x b y V H Hn Hs Hx Hy. destruct (holds_close _ _ _ _ H Hn ltac:(lra)) as (h & l & e & B1 & B2 & B3 & He & Hl & C & Rh).
  apply (holds_sum n s v x (negated b) (- y) (- h) (- l) e); try assumption; try lra.
  - now apply opp_is.
  - now apply opp_is.
  - now rewrite Rabs_Ropp, (Rabs_pos_eq h) by lra.
  - rewrite !Rabs_Ropp, (Rabs_pos_eq h) by lra. assumption.
  - replace (- h + - l - - y) with (- (h + l - y)) by ring. rewrite !Rabs_Ropp, (Rabs_pos_eq y) by lra. assumption.
Qed.
