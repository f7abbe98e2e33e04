(* SPDX-License-Identifier: BSD-3-Clause *)
(* What double-double's operations of proofs/recorded/Recorded.v give: sums of two numbers that binary64 holds, products of two, and roots.
   *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Relative.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
Open Scope R_scope.

Notation not_too_large a := (Rabs a <= bpow radix2 1000) (only parsing).

Lemma plus_exact : forall v w a b c, is64 v a -> is64 w b -> c = a + b -> in_binary64 c -> not_too_large c -> is64 (plus v w) c.
Proof.
  intros v w a b c Hv Hw E Hc H. rewrite <- (round_generic radix2 fexp64 ZnearestE c) by assumption. subst c. now apply plus_is.
Qed.

Lemma minus_exact : forall v w a b c, is64 v a -> is64 w b -> c = a - b -> in_binary64 c -> not_too_large c -> is64 (minus v w) c.
Proof.
  intros v w a b c Hv Hw E Hc H. rewrite <- (round_generic radix2 fexp64 ZnearestE c) by assumption. subst c. now apply minus_is.
Qed.

Lemma times_exact : forall v w a b c, is64 v a -> is64 w b -> c = a * b -> in_binary64 c -> not_too_large c -> is64 (times v w) c.
Proof.
  intros v w a b c Hv Hw E Hc H. rewrite <- (round_generic radix2 fexp64 ZnearestE c) by assumption. subst c. now apply times_is.
Qed.

Lemma fused_exact : forall u v w a b c d, is64 u a -> is64 v b -> is64 w c -> d = a * b + c -> in_binary64 d -> not_too_large d ->
  is64 (fused u v w) d.
Proof.
  intros u v w a b c d Hu Hv Hw E Hd H. rewrite <- (round_generic radix2 fexp64 ZnearestE d) by assumption. subst d.
  now apply fused_is.
Qed.

Lemma zero_is_not_too_large : not_too_large 0.
Proof. rewrite Rabs_R0. apply bpow_ge_0. Qed.

Ltac exact_step lemma := eapply lemma; [eassumption|eassumption|..]; try eassumption; try apply generic_format_0;
  try apply zero_is_not_too_large; try ring.

(* a + b, which binary64 holds. *)
Lemma sum_of_exact : forall a a_lo b b_lo x y, is64 a x -> is64 a_lo 0 -> is64 b y -> is64 b_lo 0 -> in_binary64 (x + y) ->
  not_too_large x -> not_too_large y -> not_too_large (x + y) ->
  is64 (fst (sum_of a a_lo b b_lo)) (x + y) /\ is64 (snd (sum_of a a_lo b b_lo)) 0.
Proof.
  intros a a_lo b b_lo x y Ha Hal Hb Hbl Hf Bx By Bs. pose proof (format_of _ _ Ha) as Gx. pose proof (format_of _ _ Hb) as Gy.
  unfold sum_of. cbv zeta. cbn [fst snd].
  assert (I1 : is64 (plus a b) (x + y)) by exact_step plus_exact. set (t1 := plus a b) in *.
  assert (I2 : is64 (minus t1 a) y) by exact_step minus_exact. set (t2 := minus t1 a) in *.
  assert (I3 : is64 (minus t1 t2) x) by exact_step minus_exact. set (t3 := minus t1 t2) in *.
  assert (I4 : is64 (minus a t3) 0) by exact_step minus_exact. set (t4 := minus a t3) in *.
  assert (I5 : is64 (minus b t2) 0) by exact_step minus_exact. set (t5 := minus b t2) in *.
  assert (I6 : is64 (plus t4 t5) 0) by exact_step plus_exact. set (t6 := plus t4 t5) in *.
  assert (I7 : is64 (plus a_lo b_lo) 0) by exact_step plus_exact. set (t7 := plus a_lo b_lo) in *.
  assert (I8 : is64 (plus t6 t7) 0) by exact_step plus_exact. set (t8 := plus t6 t7) in *.
  assert (I9 : is64 (plus t1 t8) (x + y)) by exact_step plus_exact. set (t9 := plus t1 t8) in *.
  assert (I10 : is64 (minus t7 a_lo) 0) by exact_step minus_exact. set (t10 := minus t7 a_lo) in *.
  assert (I11 : is64 (minus t7 t10) 0) by exact_step minus_exact. set (t11 := minus t7 t10) in *.
  assert (I12 : is64 (minus a_lo t11) 0) by exact_step minus_exact. set (t12 := minus a_lo t11) in *.
  assert (I13 : is64 (minus b_lo t10) 0) by exact_step minus_exact. set (t13 := minus b_lo t10) in *.
  assert (I14 : is64 (plus t12 t13) 0) by exact_step plus_exact. set (t14 := plus t12 t13) in *.
  assert (I15 : is64 (minus t9 t1) 0) by exact_step minus_exact. set (t15 := minus t9 t1) in *.
  assert (I16 : is64 (minus t8 t15) 0) by exact_step minus_exact. set (t16 := minus t8 t15) in *.
  assert (I17 : is64 (plus t14 t16) 0) by exact_step plus_exact. set (t17 := plus t14 t16) in *.
  assert (I18 : is64 (plus t9 t17) (x + y)) by exact_step plus_exact. set (t18 := plus t9 t17) in *.
  assert (I19 : is64 (minus t18 t9) 0) by exact_step minus_exact. set (t19 := minus t18 t9) in *.
  split; [assumption|]. exact_step minus_exact.
Qed.

(* a b, in two terms. *)
Lemma product_of_exact : forall a a_lo b b_lo x y, is64 a x -> is64 a_lo 0 -> is64 b y -> is64 b_lo 0 ->
  x * y = 0 \/ bpow radix2 (-900) <= Rabs (x * y) -> Rabs (x * y) <= bpow radix2 900 ->
  is64 (fst (product_of a a_lo b b_lo)) (nearest64 (x * y)) /\ is64 (snd (product_of a a_lo b b_lo)) (x * y - nearest64 (x * y)).
Proof.
  intros a a_lo b b_lo x y Ha Hal Hb Hbl Hsmall Hlarge. pose proof (format_of _ _ Ha) as Gx. pose proof (format_of _ _ Hb) as Gy.
  set (p := nearest64 (x * y)). assert (Gp : in_binary64 p) by (apply generic_format_round; auto with typeclass_instances).
  assert (Bp : Rabs p <= bpow radix2 900).
  { apply abs_round_le_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia. }
  assert (Ge : in_binary64 (x * y - p)).
  { pose proof (two_product_is_exact x y Gx Gy) as E. cbv zeta in E. fold p in E.
    assert (Hs : x * y = 0 \/ bpow radix2 (-1074 + 2 * 53 - 1) <= Rabs (x * y)).
    { destruct Hsmall as [H|H]; [now left|right]. apply Rle_trans with (2 := H). apply bpow_le. lia. }
    replace (x * y - p) with (nearest64 (x * y - p)) by (specialize (E Hs); lra).
    apply generic_format_round; auto with typeclass_instances. }
  assert (B900 : bpow radix2 900 + bpow radix2 900 <= bpow radix2 1000).
  { replace (bpow radix2 900 + bpow radix2 900) with (bpow radix2 (1 + 900)); [apply bpow_le; lia|].
    rewrite bpow_plus. change (bpow radix2 1) with 2. ring. }
  pose proof (bpow_gt_0 radix2 900) as P900.
  assert (Be : not_too_large (x * y - p)).
  { unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra. }
  assert (Bp2 : not_too_large p) by lra.
  unfold product_of. cbv zeta. cbn [fst snd].
  assert (I1 : is64 (times a b) p) by (apply times_is; try assumption; lra). set (t1 := times a b) in *.
  pose proof (opp_is _ _ I1) as I2. set (t2 := opp t1) in *.
  assert (I3 : is64 (fused a b t2) (x * y - p)) by (apply (fused_exact _ _ _ x y (- p)); try assumption; ring).
  set (t3 := fused a b t2) in *.
  assert (I4 : is64 (times a_lo b_lo) 0) by exact_step times_exact. set (t4 := times a_lo b_lo) in *.
  assert (I5 : is64 (fused a_lo b t4) 0).
  { apply (fused_exact _ _ _ 0 y 0); try assumption; [ring|apply generic_format_0|apply zero_is_not_too_large]. }
  set (t5 := fused a_lo b t4) in *.
  assert (I6 : is64 (fused a b_lo t5) 0).
  { apply (fused_exact _ _ _ x 0 0); try assumption; [ring|apply generic_format_0|apply zero_is_not_too_large]. }
  set (t6 := fused a b_lo t5) in *.
  assert (I7 : is64 (plus t3 t6) (x * y - p)) by exact_step plus_exact. set (t7 := plus t3 t6) in *.
  assert (I8 : is64 (plus t1 t7) p).
  { unfold p at 1. replace (x * y) with (p + (x * y - p)) by ring. apply plus_is; try assumption.
    replace (p + (x * y - p)) with (x * y) by ring. lra. }
  set (t8 := plus t1 t7) in *.
  assert (I9 : is64 (minus t8 t1) 0) by exact_step minus_exact. set (t9 := minus t8 t1) in *.
  split; [assumption|]. exact_step minus_exact.
Qed.

(* A sum of a large and a small number in two terms. *)
Lemma two_terms : forall r q x y, is64 r x -> is64 q y -> Rabs y <= Rabs x -> Rabs x <= bpow radix2 900 ->
  is64 (plus r q) (nearest64 (x + y)) /\
  is64 (minus q (minus (plus r q) r)) (x + y - nearest64 (x + y)).
Proof.
  intros r q x y Hr Hq Hsize Hx. pose proof (format_of _ _ Hr) as Gx. pose proof (format_of _ _ Hq) as Gy.
  pose proof (fast_two_sum_is_exact x y Gx Gy (or_introl Hsize)) as E. cbv zeta in E.
  pose proof (bpow_gt_0 radix2 900) as P. pose proof unit_is_small as Hu.
  assert (B : 16 * bpow radix2 900 <= bpow radix2 1000).
  { change 16 with (bpow radix2 4). rewrite <- bpow_plus. apply bpow_le. lia. }
  assert (Bs : Rabs (x + y) <= 2 * bpow radix2 900) by (apply Rle_trans with (1 := Rabs_triang _ _); lra).
  pose proof (plus_is _ _ _ _ Hr Hq ltac:(lra)) as Is. set (s := nearest64 (x + y)) in *.
  pose proof (sum_is_close x y Gx Gy) as C. fold s in C.
  assert (Rs : Rabs s <= 3 * bpow radix2 900).
  { pose proof (Rabs_triang_inv s (x + y)). pose proof (Rabs_pos (x + y)). nra. }
  assert (Bd : Rabs (s - x) <= 4 * bpow radix2 900).
  { unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra. }
  pose proof (minus_is _ _ _ _ Is Hr ltac:(lra)) as Id. split; [assumption|].
  replace (x + y - s) with (nearest64 (y - nearest64 (s - x))) by lra. apply minus_is; try assumption.
  pose proof (difference_is_close s x (format_of _ _ Is) Gx) as C2. set (e := nearest64 (s - x)) in *.
  assert (Rabs e <= 5 * bpow radix2 900).
  { pose proof (Rabs_triang_inv e (s - x)). pose proof (Rabs_pos (s - x)). nra. }
  unfold Rminus. apply Rle_trans with (1 := Rabs_triang _ _). rewrite Rabs_Ropp. lra.
Qed.

(* The correction of a root, in real numbers: s is the root of the first term, d that of both, and r + q what is computed. *)
Lemma corrected_root : forall s r l d remainder q, 0 < s -> Rabs (r - s) <= unit53 * s -> Rabs l <= 101 / 100 * unit53 * (s * s) ->
  0 <= d -> d * d = s * s + l -> Rabs (remainder - (s * s - r * r + l)) <= 6 * (unit53 * unit53) * (s * s) ->
  Rabs (2 * r * q - remainder) <= 4 * (unit53 * unit53) * (s * s) -> Rabs (d - (r + q)) <= 8 * (unit53 * unit53) * s.
Proof.
  intros s r l d remainder q Hs Hr Hl Hd Hd2 Hrem Hq. pose proof unit_is_small as Hu. apply Rabs_le_inv in Hr.
  assert (Ds : Rabs (d - s) <= 101 / 100 * unit53 * s).
  { apply Rmult_le_reg_r with s; [assumption|]. rewrite <- (Rabs_pos_eq s) at 2 by lra. rewrite <- Rabs_mult.
    apply Rle_trans with (Rabs l); [|lra]. replace l with ((d - s) * (d + s)) by (replace ((d - s) * (d + s)) with (d * d - s * s)
      by ring; lra).
    rewrite !Rabs_mult. apply Rmult_le_compat_l; [apply Rabs_pos|]. rewrite !Rabs_pos_eq by lra. lra. }
  assert (Dr : Rabs (d - r) <= 202 / 100 * unit53 * s).
  { replace (d - r) with ((d - s) + (s - r)) by ring. apply Rle_trans with (1 := Rabs_triang _ _).
    assert (Rabs (s - r) <= unit53 * s) by (apply Rabs_le; lra). lra. }
  assert (Dr2 : (d - r) * (d - r) <= 41 / 10 * (unit53 * unit53) * (s * s)).
  { assert (E : (d - r) * (d - r) = Rabs (d - r) * Rabs (d - r)) by (rewrite <- Rabs_mult; symmetry; apply Rabs_pos_eq, Rle_0_sqr).
    rewrite E. apply Rle_trans with ((202 / 100 * unit53 * s) * (202 / 100 * unit53 * s)).
    - apply Rmult_le_compat; try assumption; apply Rabs_pos.
    - assert (0 <= unit53 * unit53 * (s * s)) by (apply Rmult_le_pos; apply Rle_0_sqr). lra. }
  assert (Us : unit53 * s <= / 1000000000000 * s) by (apply Rmult_le_compat_r; lra).
  apply Rmult_le_reg_l with (2 * r); [lra|]. rewrite <- (Rabs_pos_eq (2 * r)) at 1 by lra. rewrite <- Rabs_mult.
  replace (2 * r * (d - (r + q))) with
    (- (2 * r * q - remainder) - (remainder - (s * s - r * r + l)) - (d - r) * (d - r)) by lra.
  apply Rabs_le_inv in Hrem. apply Rabs_le_inv in Hq. pose proof (Rle_0_sqr (d - r)) as P. unfold Rsqr in P.
  apply Rle_trans with (15 * (unit53 * unit53) * (s * s)).
  - apply Rabs_le. assert (0 <= unit53 * unit53 * (s * s)) by (apply Rmult_le_pos; apply Rle_0_sqr). split; lra.
  - replace (2 * r * (8 * (unit53 * unit53) * s)) with (16 * (unit53 * unit53) * s * r) by ring.
    replace (15 * (unit53 * unit53) * (s * s)) with (16 * (unit53 * unit53) * s * (15 / 16 * s)) by field.
    apply Rmult_le_compat_l; [|lra]. assert (0 <= unit53 * unit53 * s) by (apply Rmult_le_pos; [apply Rle_0_sqr|lra]). lra.
Qed.

Lemma root_of_both : forall a a_lo h l, is64 a h -> is64 a_lo l -> bpow radix2 (-200) <= h <= bpow radix2 40 ->
  Rabs l <= 101 / 100 * unit53 * h ->
  exists hi lo, is64 (fst (square_root_of a a_lo)) hi /\ is64 (snd (square_root_of a a_lo)) lo /\
    hi = nearest64 (hi + lo) /\ Rabs (hi - sqrt h) <= / 1000000000000 * sqrt h /\ Rabs lo <= 101 / 100 * unit53 * hi /\
    Rabs (sqrt (h + l) - (hi + lo)) <= 9 * (unit53 * unit53) * hi.
Proof.
  intros a a_lo h l Ha Hl [Hh1 Hh2] Bl. pose proof unit_is_small as Hu. pose proof tiny_is_tinier as Htiny.
  set (s := sqrt h). assert (Hh : 0 < h) by (apply Rlt_le_trans with (2 := Hh1); apply bpow_gt_0).
  assert (Hs2 : s * s = h) by (apply sqrt_sqrt; lra). assert (Hs : 0 < s) by now apply sqrt_lt_R0.
  assert (Ss : size (-100) 20 s) by (apply size_root; [now apply size_of|lra]).
  destruct Ss as [S1 S2]. rewrite Rabs_pos_eq in S1, S2 by lra. change (bpow radix2 (-100)) with (/ 1267650600228229401496703205376) in S1.
  change (bpow radix2 20) with 1048576 in S2.
  assert (big : forall b, Rabs b <= 1000000000000000000000000000000 -> Rabs b <= bpow radix2 900).
  { intros b Hb. apply Rle_trans with (bpow radix2 100); [simpl; lra|apply bpow_le; lia]. }
  assert (big2 : forall b, Rabs b <= 1000000000000000000000000000000 -> not_too_large b).
  { intros b Hb. apply Rle_trans with (1 := big b Hb). apply bpow_le. lia. }
  assert (Hhs : h <= 1048576 * s) by (rewrite <- Hs2; apply Rmult_le_compat_r; lra).
  change (bpow radix2 (-200)) with (/ 1606938044258990275541962092341162602522202993782792835301376) in Hh1.
  assert (Htu : tiny <= unit53 * unit53 * (/ 1000000000000 * h)) by (unfold unit53; lra).
  assert (Hh30 : h <= 1500000000000) by lra.
  set (uh := unit53 * h). assert (Huh : 0 <= uh <= / 1000000000000 * h) by (unfold uh; split; nra).
  unfold square_root_of. cbv zeta. cbn [fst snd].
  pose proof (square_root_is _ _ Ha ltac:(lra)) as I1. fold s in I1. set (t1 := square_root a) in *.
  set (r := nearest64 s) in *.
  assert (Er : Rabs (r - s) <= unit53 * s).
  { pose proof (relative_error_N_FLT radix2 (-1074) 53 (eq_refl _) (fun n => negb (Z.even n)) s) as E.
    replace unit53 with (/ 2 * bpow radix2 (-53 + 1)) by (unfold unit53; simpl; lra). rewrite <- (Rabs_pos_eq s) at 2 by lra. apply E.
    rewrite Rabs_pos_eq by lra. apply Rle_trans with (bpow radix2 (-100)); [apply bpow_le; lia|simpl; lra]. }
  apply Rabs_le_inv in Er. assert (Us : unit53 * s <= / 1000000000000 * s) by (apply Rmult_le_compat_r; lra).
  pose proof (opp_is _ _ I1) as I2. set (t2 := opp t1) in *.
  assert (Ee : Rabs (- r * r + h) <= 201 / 100 * uh).
  { replace (- r * r + h) with ((s - r) * (s + r)) by (rewrite <- Hs2; ring). rewrite Rabs_mult.
    apply Rle_trans with (unit53 * s * (201 / 100 * s)); [|unfold uh; rewrite <- Hs2; lra].
    apply Rmult_le_compat; try apply Rabs_pos; apply Rabs_le; lra. }
  pose proof (fused_is _ _ _ _ _ _ I2 I1 Ha ltac:(apply big2; lra)) as I3. set (t3 := fused t2 t1 a) in *.
  pose proof (product_is_close (- r * r + h)) as C3. set (e := nearest64 (- r * r + h)) in *.
  assert (Huu : unit53 * uh <= / 1000000000000 * uh) by (apply Rmult_le_compat_r; lra).
  assert (Htuh : tiny <= / 100 * (unit53 * uh)) by (unfold uh; lra).
  assert (Ce : Rabs (e - (- r * r + h)) <= 203 / 100 * (unit53 * uh)).
  { assert (unit53 * Rabs (- r * r + h) <= unit53 * (201 / 100 * uh)) by (apply Rmult_le_compat_l; lra). lra. }
  assert (Bl' : Rabs l <= 101 / 100 * uh) by (unfold uh; lra).
  apply Rabs_le_inv in Ee. apply Rabs_le_inv in Ce. apply Rabs_le_inv in Bl'.
  assert (Bel : Rabs (e + l) <= 303 / 100 * uh) by (apply Rabs_le; lra).
  pose proof (plus_is _ _ _ _ I3 Hl ltac:(apply big2; lra)) as I4. set (t4 := plus t3 a_lo) in *.
  pose proof (sum_is_close e l (format_of _ _ I3) (format_of _ _ Hl)) as C4. set (rem := nearest64 (e + l)) in *.
  assert (C4' : Rabs (rem - (e + l)) <= 303 / 100 * (unit53 * uh)).
  { assert (unit53 * Rabs (e + l) <= unit53 * (303 / 100 * uh)) by (apply Rmult_le_compat_l; lra). lra. }
  apply Rabs_le_inv in C4'. apply Rabs_le_inv in Bel.
  assert (Brem : Rabs rem <= 304 / 100 * uh) by (apply Rabs_le; lra).
  (* r + r is exact *)
  assert (I5 : is64 (plus t1 t1) (2 * r)).
  { apply plus_exact with r r; try assumption; [ring| |apply big2; apply Rabs_le; lra].
    replace (2 * r) with (r * bpow radix2 1) by (change (bpow radix2 1) with 2; ring).
    apply Mult_error.mult_bpow_pos_exact_FLT; [now apply format_of in I1|lia]. }
  set (t5 := plus t1 t1) in *.
  assert (Hrpos : 0 < 2 * r) by lra.
  assert (Bq0 : Rabs (rem / (2 * r)) <= 153 / 100 * (unit53 * s)).
  { unfold Rdiv. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq (2 * r)) by lra. apply Rmult_le_reg_r with (2 * r); [assumption|].
    rewrite Rmult_assoc, Rinv_l by lra. rewrite Rmult_1_r. apply Rle_trans with (1 := Brem). unfold uh. rewrite <- Hs2.
    apply Rle_trans with (unit53 * s * (304 / 100 * s)); [right; field|].
    apply Rle_trans with (unit53 * s * (306 / 100 * r)); [apply Rmult_le_compat_l; [apply Rmult_le_pos; lra|lra]|right; field]. }
  assert (Pus : 0 <= unit53 * s) by (apply Rmult_le_pos; lra).
  pose proof (over_is _ _ _ _ I4 I5 ltac:(lra) ltac:(apply big2; lra)) as I6. set (t6 := over t4 t5) in *.
  pose proof (product_is_close (rem / (2 * r))) as C6. set (q := nearest64 (rem / (2 * r))) in *.
  assert (Htq : tiny <= / 100 * (unit53 * s)) by (unfold unit53; lra).
  assert (Uq : unit53 * Rabs (rem / (2 * r)) <= / 1000000000000 * (153 / 100 * (unit53 * s))).
  { apply Rmult_le_compat; try apply Rabs_pos; lra. }
  assert (Bq : Rabs q <= 155 / 100 * (unit53 * s)) by (pose proof (Rabs_triang_inv q (rem / (2 * r))); lra).
  assert (Bqr : Rabs q <= Rabs r) by (rewrite (Rabs_pos_eq r) by lra; lra).
  destruct (two_terms _ _ _ _ I1 I6 Bqr ltac:(apply big; apply Rabs_le; lra)) as [T1 T2].
  pose proof (sum_is_close r q (format_of _ _ I1) (format_of _ _ I6)) as C7. set (hi := nearest64 (r + q)) in *.
  exists hi, (r + q - hi). split; [assumption|]. split; [assumption|]. apply Rabs_le_inv in Bq.
  assert (Brq : Rabs (r + q) <= 1000001 / 1000000 * s) by (apply Rabs_le; lra).
  assert (C7' : Rabs (hi - (r + q)) <= 1000001 / 1000000 * (unit53 * s)).
  { assert (unit53 * Rabs (r + q) <= unit53 * (1000001 / 1000000 * s)) by (apply Rmult_le_compat_l; lra). lra. }
  pose proof C7' as C8. apply Rabs_le_inv in C8.
  assert (Hhi : 999999 / 1000000 * s <= hi) by lra.
  assert (Hus : unit53 * s <= 1000002 / 1000000 * (unit53 * hi)).
  { replace (1000002 / 1000000 * (unit53 * hi)) with (unit53 * (1000002 / 1000000 * hi)) by ring. apply Rmult_le_compat_l; lra. }
  split; [unfold hi; f_equal; ring|]. split; [|split].
  - unfold unit53 in *. apply Rabs_le. lra.
  - rewrite Rabs_minus_sym. lra.
  - replace (hi + (r + q - hi)) with (r + q) by ring.
    assert (Ps : 0 <= h + l) by lra.
    assert (K : Rabs (sqrt (h + l) - (r + q)) <= 8 * (unit53 * unit53) * s).
    { apply corrected_root with l rem; try assumption.
      - now apply Rabs_le.
      - rewrite Hs2. fold uh. lra.
      - apply sqrt_pos.
      - rewrite Hs2. now apply sqrt_sqrt.
      - rewrite Hs2. replace (6 * (unit53 * unit53) * h) with (6 * (unit53 * uh)) by (unfold uh; ring). apply Rabs_le. lra.
      - replace (2 * r * q - rem) with (2 * r * (q - rem / (2 * r))) by (field; lra). rewrite Rabs_mult, (Rabs_pos_eq (2 * r)) by lra.
        apply Rle_trans with (2 * r * (unit53 * Rabs (rem / (2 * r)) + tiny)); [apply Rmult_le_compat_l; lra|].
        rewrite Hs2. replace (4 * (unit53 * unit53) * h) with (4 * (unit53 * uh)) by (unfold uh; ring).
        replace (2 * r * (unit53 * Rabs (rem / (2 * r)) + tiny)) with (unit53 * Rabs rem + 2 * r * tiny).
        + assert (unit53 * Rabs rem <= unit53 * (304 / 100 * uh)) by (apply Rmult_le_compat_l; lra).
          assert (2 * r * tiny <= 3 * s * tiny) by (apply Rmult_le_compat_r; lra).
          assert (3 * s * tiny <= / 100 * (unit53 * uh)); [|lra].
          apply Rle_trans with (4000000000 * tiny); [apply Rmult_le_compat_r; lra|]. unfold uh, unit53. lra.
        + unfold Rdiv. rewrite Rabs_mult, Rabs_inv, (Rabs_pos_eq (2 * r)) by lra. field. lra. }
    apply Rle_trans with (1 := K). replace (8 * (unit53 * unit53) * s) with (8 * unit53 * (unit53 * s)) by ring.
    apply Rle_trans with (8 * unit53 * (1000002 / 1000000 * (unit53 * hi))); [apply Rmult_le_compat_l; lra|].
    assert (0 <= unit53 * (unit53 * hi)) by (apply Rmult_le_pos; [lra|apply Rmult_le_pos; lra]). lra.
Qed.

(* What rounding takes, as a share of the result: the low part of a double-double. *)
Lemma rounding_tail : forall x, / 1000000000000000000000000000000 <= nearest64 x -> Rabs (x - nearest64 x) <= unit53 * nearest64 x.
Proof.
  intros x Hx. rewrite Rabs_minus_sym. pose proof (error_le_half_ulp_round radix2 fexp64 (fun n => negb (Z.even n)) x) as U.
  pose proof (ulp_FLT_le radix2 (-1074) 53 (nearest64 x)) as V. rewrite (Rabs_pos_eq (nearest64 x)) in V by lra.
  change (bpow radix2 (1 - 53)) with (/ 4503599627370496) in V.
  assert (bpow radix2 (-1074 + 53 - 1) <= nearest64 x).
  { apply Rle_trans with (bpow radix2 (-100)); [apply bpow_le; lia|simpl; lra]. }
  specialize (V H). change (Znearest (fun n => negb (Z.even n))) with ZnearestE in U. unfold unit53. lra.
Qed.
