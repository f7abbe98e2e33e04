(* SPDX-License-Identifier: BSD-3-Clause *)
(* Quotients and roots in double-double enclose those of the numbers that their operands enclose. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts.
Open Scope R_scope.

(* ---- Quotients ---- *)

Lemma quotient_of_parts : forall a a_lo b b_lo h l c k, let Q := Rabs (h / c) in is64 a h -> is64 a_lo l -> is64 b c -> is64 b_lo k ->
  Rabs l <= 101 / 100 * (unit53 * Rabs h) -> Rabs k <= 101 / 100 * (unit53 * Rabs c) ->
      / 100000000000000000000000000000000000 <= Rabs c <= 10000000000 ->
  / 10000000000000000000000000000000000000000000000000000000000000000000000 <= Q <= 1000000000000000000000000000000000000000000 ->
  / 1000000000000000000000000000000000000000000000000000000000000 <= Rabs h <= 1000000000000 ->
  exists p q, is64 (fst (quotient_of a a_lo b b_lo)) p /\ is64 (snd (quotient_of a a_lo b b_lo)) q /\
    Rabs (p + q - (h + l) / (c + k)) <= 16 * (unit53 * (unit53 * Q)) /\ 99 / 100 * Q <= Rabs p <= 101 / 100 * Q /\ Rabs q <= unit53 * Rabs
      p.
Proof.
  intros a a_lo b b_lo h l c k Q Ha Hl Hb Hk Bl Bk Bc BQ Bh. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  pose proof (format_of _ _ Ha) as Gh. pose proof (format_of _ _ Hb) as Gc.
  assert (Hc0 : c <> 0) by (intro E; rewrite E, Rabs_R0 in Bc; lra). set (C := Rabs c) in *.
  assert (HQC : Q * C = Rabs h) by (unfold Q, C; rewrite <- Rabs_mult; f_equal; field; exact Hc0).
  set (uQ := unit53 * Q). pose proof (unit_times Q ltac:(lra)) as UQ. fold uQ in UQ. pose proof (unit_times uQ (proj1 UQ)) as UUQ.
  set (W := unit53 * Rabs h). assert (EW : uQ * C = W) by (unfold W, uQ; rewrite <- HQC; ring).
  assert (EW2 : unit53 * uQ * C = unit53 * W) by (rewrite <- EW; ring).
  pose proof (unit_times (Rabs h) ltac:(lra)) as UW. fold W in UW. pose proof (unit_times W (proj1 UW)) as UUW.
  assert (TQ : tiny <= / 1000000 * (unit53 * uQ)) by (unfold uQ, unit53; lra).
  assert (TW : tiny <= / 1000000 * (unit53 * W)) by (unfold W, unit53; lra).
  assert (TC : 0 <= tiny * C <= / 1000 * W).
  { split; [apply Rmult_le_pos; lra|]. rewrite <- EW. replace (/ 1000 * (uQ * C)) with (/ 1000 * uQ * C) by ring. apply Rmult_le_compat_r;
    lra. }
  unfold quotient_of. cbv zeta. cbn [fst snd].
  destruct (over_close _ _ _ _ Ha Hb Hc0 ltac:(fold Q; lra)) as [I1 C1]. fold Q uQ in C1. set (t1 := over a b) in *. set (q0 := nearest64
    (h / c)) in *.
  pose proof (size_by q0 (h / c)) as S1. fold Q in S1. pose proof (size_by (h / c) q0) as S1'. rewrite (Rabs_minus_sym (h / c)) in S1'.
    fold Q in S1'.
  assert (C1' : Rabs (q0 * c - h) <= 1001 / 1000 * W).
  { replace (q0 * c - h) with ((q0 - h / c) * c) by (field; exact Hc0). rewrite Rabs_mult. fold C.
    apply Rle_trans with ((uQ + tiny) * C); [apply Rmult_le_compat_r; lra|lra]. }
  set (m := q0 * c) in *. pose proof (size_by m h) as Sm. pose proof (size_by h m) as Sm'. rewrite (Rabs_minus_sym h) in Sm'.
  destruct (times_close _ _ _ _ I1 Hb ltac:(fold m; lra)) as [I2 C2]. fold m in I2, C2. set (t2 := times t1 b) in *. set (p0 := nearest64
    m) in *.
  assert (U2 : unit53 * Rabs m <= unit53 * (1001 / 1000 * Rabs h)) by (apply unit_times_compat; lra).
  assert (C2' : Rabs (p0 - m) <= 1002 / 1000 * W) by (unfold W in *; lra).
  assert (Ge : in_binary64 (m - p0)).
  { pose proof (two_product_is_exact q0 c (format_of _ _ I1) Gc) as E. cbv zeta in E. fold m p0 in E.
    assert (Hs : m = 0 \/ bpow radix2 (-1074 + 2 * 53 - 1) <= Rabs m).
    { right. apply Rle_trans with (bpow radix2 (-250)); [apply bpow_le; lia|]. apply Rle_trans with (/ 2 * Rabs h); [simpl; lra|lra]. }
    replace (m - p0) with (nearest64 (m - p0)) by (specialize (E Hs); lra). apply generic_format_round; auto with typeclass_instances. }
  pose proof (size_by p0 m) as Sp.
  destruct (minus_close _ _ _ _ Ha I2 ltac:(lra)) as [I3 C3]. set (t3 := minus a t2) in *. set (d := nearest64 (h - p0)) in *.
  assert (Bd : Rabs (h - p0) <= 2004 / 1000 * W).
  { replace (h - p0) with (- (m - h) - (p0 - m)) by ring. apply Rle_trans with (1 := minus_size _ _). rewrite Rabs_Ropp. lra. }
  pose proof (unit_times_compat _ _ Bd) as U3. pose proof (size_by d (h - p0)) as S3.
  pose proof (opp_is _ _ I2) as I4. set (t4 := opp t2) in *.
  assert (I5 : is64 (fused t1 b t4) (m - p0)).
  { apply (fused_exact _ _ _ q0 c (- p0)); try assumption; [unfold m; ring|apply big_enough; rewrite Rabs_minus_sym; lra]. }
  set (t5 := fused t1 b t4) in *. rewrite Rabs_minus_sym in C2'.
  destruct (minus_close _ _ _ _ I3 I5 ltac:(lra)) as [I6 C6]. set (t6 := minus t3 t5) in *. set (r1 := nearest64 (d - (m - p0))) in *.
  assert (B6 : Rabs (d - (m - p0)) <= 1002 / 1000 * W).
  { replace (d - (m - p0)) with ((d - (h - p0)) - (m - h)) by ring. apply Rle_trans with (1 := minus_size _ _). lra. }
  pose proof (unit_times_compat _ _ B6) as U6. pose proof (size_by r1 (d - (m - p0))) as S6.
  assert (D6 : Rabs (r1 - (h - m)) <= 31 / 10 * (unit53 * W)).
  { replace (r1 - (h - m)) with ((r1 - (d - (m - p0))) + (d - (h - p0))) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra. }
  pose proof (opp_is _ _ I1) as I7. set (t7 := opp t1) in *.
  assert (B7 : Rabs (- q0 * k) <= 102 / 100 * W).
  { rewrite Rabs_mult, Rabs_Ropp. apply Rle_trans with (1001 / 1000 * Q * (101 / 100 * (unit53 * C))).
    - apply Rmult_le_compat; try apply Rabs_pos; lra.
    - unfold W. rewrite <- HQC. assert (0 <= unit53 * (Q * C)) by (rewrite HQC; exact (proj1 UW)). lra. }
  pose proof (Rabs_triang (- q0 * k) l) as T8. fold W in Bl.
  destruct (fused_close _ _ _ _ _ _ I7 Hk Hl ltac:(lra)) as [I8 C8]. set (t8 := fused t7 b_lo a_lo) in *. set (r2 := nearest64 (- q0 * k +
    l)) in *.
  assert (U8 : unit53 * Rabs (- q0 * k + l) <= unit53 * (204 / 100 * W)) by (apply unit_times_compat; lra).
  pose proof (size_by r2 (- q0 * k + l)) as S8. pose proof (Rabs_triang r1 r2) as T9.
  destruct (plus_close _ _ _ _ I6 I8 ltac:(lra)) as [I9 C9]. set (t9 := plus t6 t8) in *. set (r := nearest64 (r1 + r2)) in *.
  assert (U9 : unit53 * Rabs (r1 + r2) <= unit53 * (308 / 100 * W)) by (apply unit_times_compat; lra).
  pose proof (size_by r (r1 + r2)) as S9.
  set (rho := h - m + (l - q0 * k)).
  assert (D9 : Rabs (r - rho) <= 84 / 10 * (unit53 * W)).
  { replace (r - rho) with ((r - (r1 + r2)) + (r1 - (h - m)) + (r2 - (- q0 * k + l))) by (unfold rho; ring).
    pose proof (Rabs_triang (r - (r1 + r2) + (r1 - (h - m))) (r2 - (- q0 * k + l))). pose proof (Rabs_triang (r - (r1 + r2)) (r1 - (h -
      m))). lra. }
  pose proof (size_by r rho) as Sr. pose proof (size_by rho r) as Srho. rewrite (Rabs_minus_sym rho) in Srho.
  assert (Br : Rabs r <= 31 / 10 * W) by lra.
  assert (BZ : Rabs (r / c) <= 31 / 10 * uQ) by (apply quotient_size; fold C; lra).
  destruct (over_close _ _ _ _ I9 Hb Hc0 ltac:(lra)) as [I10 C10]. set (t10 := over t9 b) in *. set (y := nearest64 (r / c)) in *.
  pose proof (unit_times_compat _ _ BZ) as U10. pose proof (size_by y (r / c)) as S10.
  destruct (fast_two_sum_terms t1 t10 q0 y I1 I10 ltac:(lra) ltac:(lra)) as (p & q & I11 & I13 & Ep & Cp & _ & [[_ D]|[D _]]); [|exfalso;
    lra].
  exists p, q. split; [exact I11|]. split; [exact I13|].
  pose proof (size_by (q0 + y) p) as S11. rewrite (Rabs_minus_sym _ p) in S11. pose proof (size_by q0 (q0 + y)) as S12.
  replace (q0 - (q0 + y)) with (- y) in S12 by ring. rewrite Rabs_Ropp in S12. pose proof (Rabs_triang q0 y) as S13. pose proof (size_by p
    (q0 + y)) as S14.
  assert (U11 : unit53 * Rabs (q0 + y) <= unit53 * (11 / 10 * Q)) by (apply unit_times_compat; lra). fold uQ in U11.
  replace (unit53 * (11 / 10 * Q)) with (11 / 10 * uQ) in U11 by (unfold uQ; ring).
  assert (Uk : unit53 * C <= / 1000000000000 * C) by (apply Rmult_le_compat_r; lra).
  pose proof (size_by c (c + k)) as Sck. fold C in Sck. replace (c - (c + k)) with (- k) in Sck by ring. rewrite Rabs_Ropp in Sck.
  assert (Hck : c + k <> 0) by (intro E; rewrite E, Rabs_R0 in Sck; lra).
  split; [|split; [lra|]].
  - replace (p + q - (h + l) / (c + k)) with ((y - r / c) + (r - rho) / c + rho * (k / c) / (c + k)).
    2: { rewrite D. unfold rho, m. field. split; assumption. }
    pose proof (Rabs_triang (y - r / c + (r - rho) / c) (rho * (k / c) / (c + k))) as A1. pose proof (Rabs_triang (y - r / c) ((r - rho) /
      c)) as A2.
    assert (A3 : Rabs ((r - rho) / c) <= 84 / 10 * (unit53 * uQ)) by (apply quotient_size; fold C; lra).
    assert (A4 : Rabs (k / c) <= 101 / 100 * unit53) by (apply quotient_size; fold C; lra).
    assert (A5 : Rabs (rho * (k / c) / (c + k)) <= 4 * (unit53 * uQ)).
    { apply quotient_size; [lra|]. apply Rle_trans with (32 / 10 * W * (101 / 100 * unit53)); [apply product_size; [lra|exact A4]|].
      apply Rle_trans with (4 * (unit53 * uQ) * (99 / 100 * C)); [|apply Rmult_le_compat_l; lra].
      replace (4 * (unit53 * uQ) * (99 / 100 * C)) with (396 / 100 * (unit53 * uQ * C)) by field. rewrite EW2. lra. }
    lra.
  - replace q with (q0 + y - p) by lra. rewrite Ep. apply rounding_rest. rewrite <- Ep. lra.
Qed.

Lemma over_zero : forall v w c, is64 v 0 -> is64 w c -> c <> 0 -> is64 (over v w) 0.
Proof.
  intros v w c Hv Hw Hc. assert (E : 0 / c = 0) by (unfold Rdiv; ring).
  pose proof (over_is v w 0 c Hv Hw Hc ltac:(rewrite E, Rabs_R0; apply bpow_ge_0)) as I. rewrite E, round_0 in I; [exact I|auto with
    typeclass_instances].
Qed.

Lemma quotient_of_zero : forall a a_lo b b_lo c k, is64 a 0 -> is64 a_lo 0 -> is64 b c -> is64 b_lo k -> c <> 0 ->
  is64 (fst (quotient_of a a_lo b b_lo)) 0 /\ is64 (snd (quotient_of a a_lo b b_lo)) 0.
Proof.
  intros a a_lo b b_lo c k Ha Hl Hb Hk Hc. unfold quotient_of. cbv zeta. cbn [fst snd].
  pose proof (over_zero _ _ _ Ha Hb Hc) as I1. set (t1 := over a b) in *.
  assert (I2 : is64 (times t1 b) 0) by exact_step times_exact. set (t2 := times t1 b) in *.
  assert (I3 : is64 (minus a t2) 0) by exact_step minus_exact. set (t3 := minus a t2) in *.
  assert (I4 : is64 (opp t2) 0) by (rewrite <- Ropp_0; now apply opp_is). set (t4 := opp t2) in *.
  assert (I5 : is64 (fused t1 b t4) 0) by (apply (fused_exact _ _ _ 0 c 0); trivial; [ring|apply generic_format_0|apply
    zero_is_not_too_large]).
  set (t5 := fused t1 b t4) in *.
  assert (I6 : is64 (minus t3 t5) 0) by exact_step minus_exact. set (t6 := minus t3 t5) in *.
  assert (I7 : is64 (opp t1) 0) by (rewrite <- Ropp_0; now apply opp_is). set (t7 := opp t1) in *.
  assert (I8 : is64 (fused t7 b_lo a_lo) 0) by (apply (fused_exact _ _ _ 0 k 0); trivial; [ring|apply generic_format_0|apply
    zero_is_not_too_large]).
  set (t8 := fused t7 b_lo a_lo) in *.
  assert (I9 : is64 (plus t6 t8) 0) by exact_step plus_exact. set (t9 := plus t6 t8) in *.
  pose proof (over_zero _ _ _ I9 Hb Hc) as I10. set (t10 := over t9 b) in *.
  assert (I11 : is64 (plus t1 t10) 0) by exact_step plus_exact. set (t11 := plus t1 t10) in *.
  assert (I12 : is64 (minus t11 t1) 0) by exact_step minus_exact. set (t12 := minus t11 t1) in *.
  split; [exact I11|]. exact_step minus_exact.
Qed.

Lemma almost_one_is : is64 almost_one (1 - 8 * unit53).
Proof.
  pose proof (constant_is (2 ^ 50 - 1) (-50) ltac:(lia) ltac:(lia)) as I. fold almost_one in I.
  replace (1 - 8 * unit53) with (IZR (2 ^ 50 - 1) * bpow radix2 (-50)) by (unfold unit53; simpl; lra). exact I.
Qed.

(* The divisor's size, less its error. *)
Lemma size_is : forall b c f, is64 b c -> forall g, is64 g f -> / 100000000000000000000000000000000000 <= Rabs c <= 10000000000 ->
  0 <= f <= / 1000 * Rabs c ->
  exists z, is64 (minus (times (absolute b) almost_one) g) z /\ 99 / 100 * Rabs c <= z <= Rabs c - unit53 * Rabs c - f.
Proof.
  intros b c f H g F Bc Bf. pose proof tiny_is_tinier as Htiny. pose proof unit_is_small as Hu. set (C := Rabs c) in *.
  pose proof (unit_times C ltac:(lra)) as UC. assert (E : C * (1 - 8 * unit53) = C - 8 * (unit53 * C)) by ring.
  assert (Htu : tiny <= / 100 * (unit53 * C)) by (unfold unit53; lra).
  pose proof (times_is _ _ _ _ (absolute_is _ _ H) almost_one_is ltac:(apply big_enough; fold C; rewrite E, Rabs_pos_eq; lra)) as I1.
  fold C in I1. rewrite E in I1. pose proof (rounded_near (C - 8 * (unit53 * C)) ltac:(lra)) as R1.
  assert (U1 : 0 <= unit53 * (C - 8 * (unit53 * C)) <= unit53 * C).
  { split; [apply Rmult_le_pos; lra|apply unit_times_compat; lra]. }
  set (z1 := nearest64 _) in *. pose proof (minus_is _ _ _ _ I1 F ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as I2.
  pose proof (rounded_near (z1 - f) ltac:(lra)) as R2. exists (nearest64 (z1 - f)). split; [exact I2|].
  assert (U2 : 0 <= unit53 * (z1 - f) <= unit53 * C) by (split; [apply Rmult_le_pos; lra|apply unit_times_compat; lra]). lra.
Qed.

(* Sizes are those of the first terms. The dividend may have cancelled so far that its error is as large as it is, and larger. *)
Theorem divide_encloses : forall s t a b x y, let h := Rabs (value64 (hi a)) in let c := Rabs (value64 (hi b)) in let Q := h / c in
  encloses s a x -> encloses t b y -> 0 <= s <= 10 -> 0 <= t <= / 1000 ->
  / 1000000000000000000000000000000000000000000000000000000000000 <= h <= 1000000000000 ->
      / 100000000000000000000000000000000000 <= c <= 10000000000 ->
      / 10000000000000000000000000000000000000000000000000000000000000000000000 <= Q <= 1000000000000000000000000000000000000000000 ->
  encloses (3 * (s + t) + 3 * share101) (divide a b) (x / y) /\ 99 / 100 * Q <= Rabs (value64 (hi (divide a b))) <= 101 / 100 * Q.
Proof.
  intros s t a b x y h0 c0 Q (h & l & e & H & L & E & Bl & Be & B) (c & k & f & H' & L' & E' & Bk & Bf & B') Hs Ht Bh Bc BQ.
  pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny. pose proof share_is as Eshare.
  assert (EQ : Q = Rabs (h / c)).
  { unfold Q, h0, c0. rewrite (proj1 H), (proj1 H'). unfold Rdiv. now rewrite Rabs_mult, Rabs_inv. }
  unfold h0, c0 in Bh, Bc. rewrite (proj1 H) in Bh. rewrite (proj1 H') in Bc. clearbody Q. subst Q. clear h0 c0.
  assert (tC : t * Rabs c <= / 1000 * Rabs c) by (apply Rmult_le_compat_r; lra).
  assert (Hc0 : c <> 0) by (intro Z; rewrite Z, Rabs_R0 in Bc; lra).
  destruct (size_is _ c f H' _ E' Bc ltac:(lra)) as (z & Z & Bz).
  unfold divide. cbv zeta. rewrite (less_is _ _ _ _ zero_is Z), Rlt_bool_true by lra. cbn [negb].
  set (C := Rabs c) in *. set (Q := Rabs (h / c)) in *.
  assert (HQC : Q * C = Rabs h) by (unfold Q, C; rewrite <- Rabs_mult; f_equal; field; exact Hc0).
  pose proof (unit_times (Rabs h) ltac:(lra)) as Uh. pose proof (unit_times C ltac:(lra)) as UC.
  destruct (quotient_of_parts _ _ _ _ h l c k H L H' L' ltac:(lra) ltac:(fold C; lra) Bc BQ Bh) as (p & q & P & Qt & Off & Bp & Bq).
  fold Q in Off, Bp. pose proof (unit_times Q ltac:(lra)) as UQ. set (uQ := unit53 * Q) in *. pose proof (unit_times uQ (proj1 UQ)) as UUQ.
  (* the bound of the error *)
  pose proof (Rabs_pos p) as Pp. set (F := Rabs p * f). set (N := e + F).
  assert (tQ : 0 <= t * Q <= / 1000 * Q) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (sQ : 0 <= s * Q <= 10 * Q) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  assert (BF : 0 <= F <= 101 / 100 * (t * Q * C)).
  { unfold F. split; [apply Rmult_le_pos; lra|]. replace (101 / 100 * (t * Q * C)) with (101 / 100 * Q * (t * C)) by ring.
    apply Rmult_le_compat; lra. }
  assert (Bes : e <= s * Q * C) by (replace (s * Q * C) with (s * (Q * C)) by ring; rewrite HQC; exact (proj2 Be)).
  assert (QCb : Q * C <= 1000000000000) by (rewrite HQC; lra).
  assert (tQC : t * Q * C <= / 1000 * (Q * C)).
  { replace (/ 1000 * (Q * C)) with (/ 1000 * Q * C) by ring. apply Rmult_le_compat_r; lra. }
  assert (sQC : s * Q * C <= 10 * (Q * C)) by (replace (10 * (Q * C)) with (10 * Q * C) by ring; apply Rmult_le_compat_r; lra).
  pose proof (times_is _ _ _ _ (absolute_is _ _ P) E' ltac:(apply big_enough; fold F; rewrite Rabs_pos_eq; lra)) as J1. fold F in J1.
  pose proof (rounded_near F (proj1 BF)) as R1. pose proof (proj1 (rounded_up F F ltac:(lra))) as N1.
  pose proof (unit_times F (proj1 BF)) as U1.
  set (v1 := nearest64 F) in *. pose proof (unit_times e (proj1 Be)) as Ue. pose proof (unit_times tiny (proj1 Htiny)) as Utiny.
  pose proof (plus_is _ _ _ _ E J1 ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J2.
  pose proof (rounded_near (e + v1) ltac:(lra)) as R2. pose proof (proj1 (rounded_up (e + v1) (e + v1) ltac:(lra))) as N2.
  assert (U2 : unit53 * (e + v1) <= unit53 * (2 * N + tiny)) by (apply unit_times_compat; unfold N; lra).
  set (num := nearest64 (e + v1)) in *. pose proof (unit_times N ltac:(unfold N; lra)) as UN.
  assert (EN : unit53 * N = unit53 * e + unit53 * F) by (unfold N; ring).
  assert (Nlow : N - 4 * (unit53 * N) - 3 * tiny <= num) by (unfold N in *; lra).
  assert (Nhigh : num <= 101 / 100 * N + 3 * tiny) by (unfold N in *; lra).
  assert (Bz2 : 0 < z) by lra. assert (Tz : tiny / z <= 2 * (100000000000000000000000000000000000 * tiny)).
  { apply Rmult_le_reg_r with z; [exact Bz2|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
    assert (tiny * 1 <= tiny * (2 * (100000000000000000000000000000000000 * z))) by (apply Rmult_le_compat_l; lra). lra. }
  assert (Tz0 : 0 <= tiny / z) by (apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]).
  set (r0 := N / z). assert (Hr0 : 0 <= r0 <= 102 / 100 * (s * Q + 101 / 100 * (t * Q))).
  { unfold r0. split; [apply Rmult_le_pos; [unfold N; lra|apply Rlt_le, Rinv_0_lt_compat; lra]|].
    apply Rmult_le_reg_r with z; [exact Bz2|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra.
    apply Rle_trans with (102 / 100 * (s * Q + 101 / 100 * (t * Q)) * (99 / 100 * C)); [|apply Rmult_le_compat_l; lra].
    replace (102 / 100 * (s * Q + 101 / 100 * (t * Q)) * (99 / 100 * C)) with
      (10098 / 10000 * (s * Q * C + 101 / 100 * (t * Q * C))) by field.
    unfold N. lra. }
  pose proof (unit_times r0 (proj1 Hr0)) as Ur0. pose proof (unit_times _ (proj1 Ur0)) as UUr0.
  assert (Low : r0 - 4 * (unit53 * r0) - 3 * (tiny / z) <= num / z <= 101 / 100 * r0 + 3 * (tiny / z)).
  { unfold r0. split.
    - replace (N / z - 4 * (unit53 * (N / z)) - 3 * (tiny / z)) with ((N - 4 * (unit53 * N) - 3 * tiny) / z) by (field; lra).
      apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra|lra].
    - replace (101 / 100 * (N / z) + 3 * (tiny / z)) with ((101 / 100 * N + 3 * tiny) / z) by (field; lra).
      apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra|lra]. }
  assert (Bratio : 0 <= num / z) by (apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]).
  pose proof (over_is _ _ _ _ J2 Z ltac:(lra) ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J3.
  pose proof (rounded_near _ Bratio) as R3. pose proof (proj1 (rounded_up (num / z) (num / z) ltac:(lra))) as N3.
  pose proof (unit_times _ Bratio) as U3. set (v := nearest64 (num / z)) in *.
  destruct (error_covers _ p _ v (103 / 100 * r0 + 10 * (100000000000000000000000000000000000 * tiny)) P J3 ltac:(lra) ltac:(lra)
      ltac:(lra)) as (g & G & Bg).
  assert (Hshare_p : 31 * (unit53 * uQ) <= 98 / 100 * (share101 * Rabs p)).
  { rewrite share_is. replace (98 / 100 * (32 * (unit53 * unit53) * Rabs p)) with (unit53 * (unit53 * (98 / 100 * 32 * Rabs p))) by ring.
    replace (31 * (unit53 * uQ)) with (unit53 * (unit53 * (31 * Q))) by (unfold uQ; ring).
      apply unit_times_compat, unit_times_compat. lra. }
  assert (TQ : 100000000000000000000000000000000000 * tiny <= / 10000000 * (unit53 * uQ)).
  { apply Rle_trans with (/ 10000000 * (unit53 * (unit53 * / 10000000000000000000000000000000000000000000000000000000000000000000000)));
      [unfold unit53; lra|]. apply Rmult_le_compat_l; [lra|].
    apply unit_times_compat, unit_times_compat. lra. }
  assert (TQ0 : 0 <= 100000000000000000000000000000000000 * tiny) by lra.
  split; [|unfold rounded; cbn [hi]; rewrite (proj1 P); exact Bp].
  exists p, q, g. unfold rounded. cbn [hi lo error]. split; [exact P|]. split; [exact Qt|]. split; [exact G|]. split; [exact Bq|].
  assert (Hsp : s * Q <= s * (102 / 100 * Rabs p)) by (apply Rmult_le_compat_l; lra).
  assert (Htp : t * Q <= t * (102 / 100 * Rabs p)) by (apply Rmult_le_compat_l; lra).
  assert (0 <= s * Rabs p) by (apply Rmult_le_pos; lra). assert (0 <= t * Rabs p) by (apply Rmult_le_pos; lra).
  pose proof (unit_times v N3) as Uv0. assert (0 <= share101 * Rabs p) by (unfold share101; lra).
  split; [split; lra|].
  (* what is held, and what is meant *)
  pose proof (size_by c (c + k)) as Sck. replace (c - (c + k)) with (- k) in Sck by ring. rewrite Rabs_Ropp in Sck. fold C in Sck, Bk.
  pose proof (size_by (c + k) y) as Sy. assert (HDz : z <= Rabs y) by lra.
  assert (Hck : c + k <> 0) by (intro X; rewrite X, Rabs_R0 in Sck; lra).
  assert (Hy0 : y <> 0) by (intro X; rewrite X, Rabs_R0 in HDz; lra).
  set (w := Rabs ((h + l) / (c + k))). assert (Pw : 0 <= w) by apply Rabs_pos. assert (Pf : 0 <= f) by lra.
  assert (Off2 : Rabs ((h + l) / (c + k) - x / y) <= (e + w * f) / z).
  { replace ((h + l) / (c + k) - x / y) with (((h + l - x) - (h + l) / (c + k) * (c + k - y)) / y) by (field; split; assumption).
    apply quotient_size; [lra|]. apply Rle_trans with (e + w * f).
    - apply Rle_trans with (1 := minus_size _ _). pose proof (product_size _ _ _ _ (Rle_refl (Rabs ((h + l) / (c + k)))) B') as T.
      fold w in T. lra.
    - assert (0 <= w * f) by (apply Rmult_le_pos; lra).
      assert (I : 0 <= (e + w * f) / z) by (apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]).
      apply Rle_trans with ((e + w * f) / z * z); [right; field; lra|apply Rmult_le_compat_l; lra]. }
  pose proof (unit_times _ Pp) as Up.
  assert (UQp : uQ <= 102 / 100 * (unit53 * Rabs p)).
  { unfold uQ. replace (102 / 100 * (unit53 * Rabs p)) with (unit53 * (102 / 100 * Rabs p)) by ring. apply unit_times_compat. lra. }
  assert (Hw : w <= Rabs p + 2 * (unit53 * Rabs p)).
  { pose proof (size_by ((h + l) / (c + k)) (p + q)) as S2. rewrite (Rabs_minus_sym _ (p + q)) in S2. fold w in S2.
    pose proof (Rabs_triang p q) as S3. lra. }
  assert (Off3 : (e + w * f) / z <= r0 + 2 * (unit53 * r0)).
  { unfold r0. replace (N / z + 2 * (unit53 * (N / z))) with ((N + 2 * (unit53 * N)) / z) by (field; lra).
    apply Rmult_le_compat_r; [apply Rlt_le, Rinv_0_lt_compat; lra|].
    assert (w * f <= (Rabs p + 2 * (unit53 * Rabs p)) * f) by (apply Rmult_le_compat_r; lra).
    replace ((Rabs p + 2 * (unit53 * Rabs p)) * f) with (F + 2 * (unit53 * F)) in * by (unfold F; ring). unfold N in *. lra. }
  assert (Vlow : r0 - 6 * (unit53 * r0) - 10 * (100000000000000000000000000000000000 * tiny) <= v).
  { assert (U4 : unit53 * (num / z) <= unit53 * (101 / 100 * r0 + 3 * (tiny / z))) by (apply unit_times_compat; lra).
    pose proof (unit_times _ Tz0) as UTz. lra. }
  assert (Uv : unit53 * (r0 - 6 * (unit53 * r0) - 10 * (100000000000000000000000000000000000 * tiny)) <= unit53 * v) by (apply
      unit_times_compat; exact Vlow).
  pose proof (unit_times _ TQ0) as UTQ0.
  replace (p + q - x / y) with ((p + q - (h + l) / (c + k)) + ((h + l) / (c + k) - x / y)) by ring.
  apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

(* The same where both operands are good, in terms of the exact numbers. *)
Theorem encloses_divide : forall s t a b x y, encloses s a x -> encloses t b y -> 0 <= s <= / 1000 -> 0 <= t <= / 1000 ->
  x = 0 \/ / 1000000000000000000000000000000 <= Rabs x <= 1000000000 -> / 100 <= Rabs y <= 100000 -> Rabs (x / y) <= 100000000 ->
  encloses (3 * (s + t) + 3 * share101) (divide a b) (x / y).
Proof.
  intros s t a b x y Ea Eb Hs Ht Hx Hy Hxy. assert (Hshare : 0 < share101) by (unfold share101; lra).
  pose proof unit_is_small as Hu. pose proof (first_size _ _ _ Eb Ht) as Sc. pose proof (first_size _ _ _ Ea Hs) as Sh.
  destruct Hx as [-> | Hx].
  { destruct (enclosed_zero _ _ Ea Hs) as (H & L & E). replace (0 / y) with 0 by (unfold Rdiv; ring).
    destruct Eb as (c & k & f & H' & L' & E' & Bk & Bf & B'). rewrite (proj1 H') in Sc.
    assert (Hc0 : c <> 0) by (intro X; rewrite X, Rabs_R0 in Sc; lra).
    assert (tC : t * Rabs c <= / 1000 * Rabs c) by (apply Rmult_le_compat_r; lra).
    destruct (size_is _ c f H' _ E' ltac:(lra) ltac:(lra)) as (z & Z & Bz).
    unfold divide. cbv zeta. rewrite (less_is _ _ _ _ zero_is Z), Rlt_bool_true by lra. cbn [negb].
    destruct (quotient_of_zero _ _ _ _ _ _ H L H' L' Hc0) as [P Q].
    apply encloses_more with 0; [|lra]. apply encloses_exact. split; [exact P|]. split; [exact Q|]. apply error_of_nothing; [exact P|].
    apply (over_zero _ _ z); [|exact Z|lra].
    assert (I : is64 (times (absolute (fst (quotient_of (hi a) (lo a) (hi b) (lo b)))) (error b)) 0).
    { apply (times_exact _ _ (Rabs 0) f); trivial; [now apply absolute_is|rewrite Rabs_R0; ring|apply generic_format_0|apply
      zero_is_not_too_large]. }
    exact_step plus_exact. }
  apply divide_encloses; trivial; try lra. set (h := Rabs (value64 (hi a))) in *. set (c := Rabs (value64 (hi b))) in *.
  assert (Hy0 : y <> 0) by (intro E; rewrite E, Rabs_R0 in Hy; lra).
  assert (Exy : Rabs x = Rabs (x / y) * Rabs y) by (rewrite <- Rabs_mult; f_equal; field; exact Hy0).
  assert (Rabs (x / y) * Rabs y <= 100000000 * Rabs y) by (apply Rmult_le_compat_r; lra).
  split; apply Rmult_le_reg_r with c; try lra; unfold Rdiv; rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra; lra.
Qed.

(* ---- Roots ---- *)

Theorem encloses_root : forall s a x, encloses s a x -> 0 <= s <= / 1000 ->
  x = 0 \/ / 100000000000000000000000000000000000000000000000000000000000 <= x <= 100000000000 ->
  encloses (3 * s + 3 * share101) (root_of a) (sqrt x).
Proof.
  intros s a x Ea Hs Hx. assert (Hshare : 0 < share101) by (unfold share101; lra). pose proof unit_is_small as Hu.
  pose proof tiny_is_tinier as Htiny. unfold root_of. destruct Hx as [-> | Hx].
  { destruct (enclosed_zero _ _ Ea ltac:(lra)) as (H & L & E). rewrite (equal_is _ _ _ _ H zero_is), (equal_is _ _ _ _ E zero_is).
    rewrite !Req_bool_true by reflexivity. cbn [andb]. rewrite sqrt_0. apply encloses_more with 0; [|lra]. apply encloses_exact. exact
      (conj H (conj L E)). }
  destruct Ea as (h & l & e & H & L & E & Bl & Be & B). pose proof (enclosed_size _ _ _ _ _ Bl Be B ltac:(lra)) as Sh.
  rewrite (Rabs_pos_eq x) in Sh by lra. pose proof (unit_times (Rabs h) ltac:(lra)) as Uh.
  assert (sh : s * Rabs h <= / 1000 * Rabs h) by (apply Rmult_le_compat_r; lra).
  assert (Hh : 0 < h).
  { destruct (Rle_lt_dec h 0) as [Hn|]; [exfalso|assumption]. rewrite (Rabs_left1 h Hn) in *. absolute_values. lra. }
  rewrite (Rabs_pos_eq h) in * by lra.
  rewrite (equal_is _ _ _ _ H zero_is), (Req_bool_false h 0) by lra. cbn [andb].
  assert (Ehk : h * (1 - 8 * unit53) = h - 8 * (unit53 * h)) by ring.
  pose proof (times_is _ _ _ _ H almost_one_is ltac:(apply big_enough; rewrite Ehk, Rabs_pos_eq; lra)) as Ihk. rewrite Ehk in Ihk.
  pose proof (rounded_near (h - 8 * (unit53 * h)) ltac:(lra)) as Rhk.
  assert (Uhk : unit53 * (h - 8 * (unit53 * h)) <= unit53 * h) by (apply unit_times_compat; lra).
  rewrite (less_is _ _ _ _ E Ihk), Rlt_bool_true by lra. cbn [negb]. cbv zeta.
  destruct (root_of_both _ _ h l H L) as (y & q & Y & Q & Ey & Cy & _ & Off).
  { change (bpow radix2 (-200)) with (/ 1606938044258990275541962092341162602522202993782792835301376).
    change (bpow radix2 40) with 1099511627776. lra. } { lra. }
  set (r := sqrt h) in *. assert (Hr2 : r * r = h) by (apply sqrt_sqrt; lra). assert (Hr0 : 0 < r) by (now apply sqrt_lt_R0).
  assert (Hr : / 1000000000000000000000000000000 <= r <= 1000000).
  { split.
    - replace (/ 1000000000000000000000000000000) with (sqrt (/ 1000000000000000000000000000000 * / 1000000000000000000000000000000))
        by (apply sqrt_square; lra).
      apply sqrt_le_1_alt. lra.
    - replace 1000000 with (sqrt (1000000 * 1000000)) by (apply sqrt_square; lra). apply sqrt_le_1_alt. lra. }
  absolute_values. assert (Hy : 0 < y) by lra.
  assert (Bq : Rabs q <= unit53 * y).
  { pose proof (rounding_rest (y + q)) as T. rewrite <- Ey, (Rabs_pos_eq y) in T by lra. replace (y + q - y) with q in T by ring.
    apply T. lra. }
  assert (Hey : 0 <= e / y <= 11 / 10 * (s * y)).
  { split; [apply Rmult_le_pos; [lra|apply Rlt_le, Rinv_0_lt_compat; lra]|]. apply Rmult_le_reg_r with y; [lra|].
    unfold Rdiv at 1. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. apply Rle_trans with (1 := proj2 Be). rewrite <- Hr2.
    replace (11 / 10 * (s * y) * y) with (s * (11 / 10 * (y * y))) by ring. apply Rmult_le_compat_l; [lra|].
    apply Rle_trans with (11 / 10 * ((99 / 100 * r) * (99 / 100 * r))); [pose proof (Rle_0_sqr r) as S; unfold Rsqr in S; lra|].
    apply Rmult_le_compat_l; [lra|apply Rmult_le_compat; lra]. }
  assert (sy : 0 <= s * y <= / 1000 * y) by (split; [apply Rmult_le_pos; lra|apply Rmult_le_compat_r; lra]).
  pose proof (over_is _ _ _ _ E Y ltac:(lra) ltac:(apply big_enough; rewrite Rabs_pos_eq; lra)) as J.
  pose proof (rounded_near _ (proj1 Hey)) as R1. pose proof (proj1 (rounded_up (e / y) (e / y) ltac:(lra))) as N1.
  pose proof (unit_times _ (proj1 Hey)) as U1. set (v := nearest64 (e / y)) in *.
  destruct (error_covers _ y _ v (12 / 10 * (s * y) + tiny) Y J ltac:(lra) ltac:(lra) ltac:(rewrite Rabs_pos_eq; lra)) as (g & G & Bg).
  rewrite (Rabs_pos_eq y) in Bg by lra. pose proof (unit_times v N1) as Uv. pose proof (unit_times y ltac:(lra)) as Uy. pose proof
    (unit_times _ (proj1 Uy)) as UUy.
  assert (Esy : share101 * y = 32 * (unit53 * (unit53 * y))) by (rewrite share_is; ring).
  assert (Hty : tiny <= / 1000 * (unit53 * (unit53 * y))) by (unfold unit53; lra).
  exists y, q, g. unfold rounded. cbn [hi lo error]. rewrite (Rabs_pos_eq y) by lra. split; [exact Y|]. split; [exact Q|]. split; [exact
    G|].
  split; [exact Bq|]. split; [lra|].
  (* what is held, and what is meant *)
  set (A := sqrt (h + l)) in *. set (X := sqrt x). assert (HA : A * A = h + l) by (apply sqrt_sqrt; lra). assert (HX : X * X = x) by (apply
    sqrt_sqrt; lra).
  assert (PX : 0 <= X) by apply sqrt_pos. assert (PA : 0 <= A) by apply sqrt_pos.
  assert (LA : 9 / 10 * r <= A).
  { replace (9 / 10 * r) with (sqrt ((9 / 10 * r) * (9 / 10 * r))) by (apply sqrt_square; lra). apply sqrt_le_1_alt.
    replace (9 / 10 * r * (9 / 10 * r)) with (81 / 100 * h) by (rewrite <- Hr2; field). lra. }
  assert (LX : 9 / 10 * r <= X).
  { replace (9 / 10 * r) with (sqrt ((9 / 10 * r) * (9 / 10 * r))) by (apply sqrt_square; lra). apply sqrt_le_1_alt.
    replace (9 / 10 * r * (9 / 10 * r)) with (81 / 100 * h) by (rewrite <- Hr2; field). lra. }
  assert (Off2 : Rabs (A - X) <= 7 / 10 * (e / y)).
  { apply Rmult_le_reg_r with (A + X); [lra|]. rewrite <- (Rabs_pos_eq (A + X)) at 1 by lra. rewrite <- Rabs_mult.
    replace ((A - X) * (A + X)) with (h + l - x) by (rewrite <- HA, <- HX; ring).
    apply Rle_trans with (7 / 10 * (e / y) * (3 / 2 * y)); [|apply Rmult_le_compat_l; lra].
    replace (7 / 10 * (e / y) * (3 / 2 * y)) with (21 / 20 * e) by (field; lra). apply Rabs_le. lra. }
  replace (y + q - X) with (- (A - (y + q)) + (A - X)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp.
  assert (Rabs (A - (y + q)) <= 9 * (unit53 * (unit53 * y))) by (apply Rabs_le; lra). lra.
Qed.
