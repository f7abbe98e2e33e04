(* SPDX-License-Identifier: BSD-3-Clause *)
(* The second stage compares a double-double with the middle of two neighbours in binary32: the difference, its bound of the error, and
   its sign. fast/numbers/ball.h and double_double.h. *)
From Coq Require Import ZArith Reals Lia Lra Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits Relative.
From Forceshade Require Import Formats Comparisons Operations Recorded Nearness Computed Evaluate Inputs ErrorFree Gap.
From Forceshade Require Import DoubleDouble Depth DoubleDoubleNear DoubleDoubleHolds DoubleDoubleTerms Enclosures EnclosedProducts
  EnclosedQuotients.
From Forceshade Require Import TopEdge.
Open Scope R_scope.

(* ---- Signs ---- *)

Inductive Sign := is_negative | is_zero | is_positive | is_unknown.

Definition sign_of (a : double_double) : Sign :=
  if is_equal (hi a) zero64 && is_equal (error a) zero64 then is_zero
  else if negb (is_less (error a) (times (absolute (hi a)) almost_one)) then is_unknown
  else if is_less zero64 (hi a) then is_positive else is_negative.

(* What a sign needs. The bound may be larger than the first term. *)
Definition contains (a : double_double) (x : R) : Prop :=
  exists h l e, is64 (hi a) h /\ is64 (lo a) l /\ is64 (error a) e /\ Rabs l <= unit53 * Rabs h /\ 0 <= e /\
    Rabs (h + l - x) <= e /\ Rabs h <= 1000000000000.

Lemma enclosed_is_contained : forall s a x, encloses s a x -> 0 <= s <= / 1000 -> Rabs x <= 100000000000 -> contains a x.
Proof.
  intros s a x (h & l & e & H & L & E & Bl & Be & B) Hs Hx. pose proof (enclosed_size _ _ _ _ _ Bl Be B Hs) as S.
  pose proof (unit_times _ (Rabs_pos h)) as U. exists h, l, e. repeat (split; [assumption|]). split; [lra|]. split; [exact
    B|lra].
Qed.

Lemma least_number : forall l, in_binary64 l -> Rabs l < bpow radix2 (-1074) -> l = 0.
Proof.
  intros l Hl Hsmall. apply FLT_format_generic in Hl; [|reflexivity]. destruct Hl as [[m k] -> _ Hk]. cbn [Fexp] in Hk.
  destruct (Z.eq_dec m 0) as [->|Hm]; [apply F2R_0|]. exfalso. revert Hsmall. apply Rle_not_lt. rewrite <- F2R_Zabs. unfold F2R. cbn [Fnum
    Fexp].
  apply Rle_trans with (bpow radix2 k); [now apply bpow_le|]. rewrite <- (Rmult_1_l (bpow radix2 k)) at 1.
  apply Rmult_le_compat_r; [apply bpow_ge_0|]. apply IZR_le. lia.
Qed.

(* A bound below the size that the code computes leaves the sign to the first term. *)
Lemma bound_below_size : forall h l e, in_binary64 h -> in_binary64 l -> Rabs l <= unit53 * Rabs h -> 0 <= e ->
  e < nearest64 (Rabs h * (1 - 8 * unit53)) -> e + Rabs l < Rabs h.
Proof.
  intros h l e Gh Gl Bl He Hless. pose proof unit_is_small as Hu. pose proof (Rabs_pos h) as Ph. pose proof (unit_times _ Ph) as Uh.
  set (a := Rabs h * (1 - 8 * unit53)) in *. assert (Ea : a = Rabs h - 8 * (unit53 * Rabs h)) by (unfold a; ring).
  pose proof (bpow_gt_0 radix2 (-1022)) as P22.
  destruct (Rle_lt_dec (5 / 4 * bpow radix2 (-1022)) (Rabs h)) as [Hlarge|Hsmall].
  - pose proof (relative_error_N_FLT radix2 (-1074) 53 (eq_refl _) (fun n => negb (Z.even n)) a) as R0.
    change (-1074 + 53 - 1)%Z with (-1022)%Z in R0. rewrite (Rabs_pos_eq a) in R0 by lra. specialize (R0 ltac:(lra)).
    change (round radix2 (FLT_exp (-1074) 53) (Znearest (fun n => negb (Z.even n))) a) with (nearest64 a) in R0.
    change (- (53) + 1)%Z with (-52)%Z in R0.
    replace (/ 2 * bpow radix2 (-52)) with unit53 in R0 by (unfold unit53; simpl; lra). apply Rabs_le_inv in R0.
    assert (unit53 * a <= unit53 * Rabs h) by (apply unit_times_compat; lra). lra.
  - assert (l = 0) as ->.
    { apply least_number; [exact Gl|]. apply Rle_lt_trans with (1 := Bl). change (-1074)%Z with (-52 + -1022)%Z. rewrite bpow_plus.
      replace (bpow radix2 (-52)) with (2 * unit53) by (unfold unit53; simpl; lra). unfold unit53 in *. lra. }
    rewrite Rabs_R0, Rplus_0_r. apply Rlt_le_trans with (1 := Hless).
    apply Rle_trans with (nearest64 (Rabs h)); [apply round_le; auto with typeclass_instances; lra|].
    right. apply round_generic; auto with typeclass_instances. now apply generic_format_abs.
Qed.

Theorem sign_is_right : forall a x, contains a x ->
  match sign_of a with is_negative => x < 0 | is_zero => x = 0 | is_positive => 0 < x | is_unknown => True end.
Proof.
  intros a x (h & l & e & H & L & E & Bl & He & B & Bh). pose proof unit_is_small as Hu. unfold sign_of.
  rewrite (equal_is _ _ _ _ H zero_is), (equal_is _ _ _ _ E zero_is).
  destruct (Req_bool h 0 && Req_bool e 0) eqn:Hz.
  { destruct (andb_prop _ _ Hz) as [H0 E0]. revert H0. case Req_bool_spec; [intros H0 _|discriminate].
    revert E0. case Req_bool_spec; [intros E0 _|discriminate]. rewrite H0, E0, Rabs_R0 in *. rewrite (no_size l) in B by lra.
    pose proof (no_size _ B). lra. }
  pose proof (unit_times _ (Rabs_pos h)) as Uh. assert (Ea : Rabs h * (1 - 8 * unit53) = Rabs h - 8 * (unit53 * Rabs h)) by ring.
  pose proof (times_is _ _ _ _ (absolute_is _ _ H) almost_one_is ltac:(apply big_enough; rewrite Ea, Rabs_pos_eq; pose proof (Rabs_pos h);
    lra)) as I.
  rewrite (less_is _ _ _ _ E I). case Rlt_bool_spec; intro Hless; cbn [negb]; [|exact Logic.I].
  pose proof (bound_below_size h l e (format_of _ _ H) (format_of _ _ L) Bl He Hless) as D. rewrite (less_is _ _ _ _ zero_is H).
  case Rlt_bool_spec; intro Hh.
  - rewrite (Rabs_pos_eq h) in D by lra. pose proof (Rabs_pos l). pose proof (Rle_abs l). pose proof (Rle_abs (- l)) as A. rewrite
    Rabs_Ropp in A.
    apply Rabs_le_inv in B. lra.
  - rewrite (Rabs_left1 h) in D by lra. pose proof (Rle_abs l). apply Rabs_le_inv in B. lra.
Qed.

(* ---- The difference from a number of few bits ---- *)

Lemma near_difference : forall h t N k, in_binary64 h -> t = IZR N * bpow radix2 k -> (Z.abs N < 2 ^ 26)%Z -> (-1074 <= k)%Z ->
  Rabs (h - t) <= / 2 * Rabs h -> in_binary64 (h - t) /\ (h - t = 0 \/ unit53 * Rabs h <= Rabs (h - t)).
Proof.
  intros h t N k Gh Et HN Hk Hnear. destruct (Req_dec h 0) as [H0|H0].
  { rewrite H0, Rabs_R0, Rmult_0_r in *. rewrite (no_size _ Hnear). split; [apply generic_format_0|now left]. }
  pose proof (bpow_mag_le radix2 h H0) as M1. pose proof (bpow_mag_gt radix2 h) as M2. set (g := mag radix2 h : Z) in *.
  set (ex := cexp radix2 fexp64 h). assert (Eex : ex = Z.max (g - 53) (-1074)) by reflexivity.
  assert (Hexk : (ex <= k)%Z).
  { assert (g - 2 < 26 + k)%Z; [|lia]. apply (lt_bpow radix2). apply Rle_lt_trans with (/ 2 * Rabs h).
    - replace (g - 2)%Z with (-1 + (g - 1))%Z by ring. rewrite bpow_plus. change (bpow radix2 (-1)) with (/ 2). lra.
    - apply Rle_lt_trans with (Rabs t); [pose proof (size_by h t); lra|]. rewrite Et, Rabs_mult, (Rabs_pos_eq (bpow _ _)), bpow_plus by
      apply bpow_ge_0.
      apply Rmult_lt_compat_r; [apply bpow_gt_0|]. rewrite <- abs_IZR. change (bpow radix2 26) with (IZR (2 ^ 26)). now apply IZR_lt. }
  set (i := (Ztrunc (scaled_mantissa radix2 fexp64 h) - N * 2 ^ (k - ex))%Z).
  assert (Ed : h - t = IZR i * bpow radix2 ex).
  { unfold i. rewrite minus_IZR, mult_IZR. change (2 ^ (k - ex))%Z with (Zpower radix2 (k - ex)). rewrite IZR_Zpower by lia.
    rewrite Et. rewrite Gh at 1. unfold F2R. cbn [Fnum Fexp]. fold ex. rewrite Rmult_minus_distr_r, Rmult_assoc, <- bpow_plus. do 3
      f_equal. ring. }
  pose proof (bpow_gt_0 radix2 ex) as Pe.
  assert (Hi : (Z.abs i < 2 ^ 53)%Z).
  { apply lt_IZR. apply Rmult_lt_reg_r with (1 := Pe). rewrite abs_IZR, <- (Rabs_pos_eq (bpow radix2 ex)) at 1 by lra. rewrite <-
    Rabs_mult, <- Ed.
    change (IZR (2 ^ 53)) with (bpow radix2 53). rewrite <- bpow_plus. apply Rle_lt_trans with (1 := Hnear).
    apply Rlt_le_trans with (bpow radix2 g); [pose proof (Rabs_pos h); lra|apply bpow_le; lia]. }
  split.
  - rewrite Ed. apply generic_format_FLT. exists (Float radix2 i ex); [reflexivity|exact Hi|cbn [Fexp]; lia].
  - destruct (Z.eq_dec i 0) as [E0|E0]; [left; rewrite Ed, E0; ring|right]. rewrite Ed, Rabs_mult, (Rabs_pos_eq (bpow radix2 ex)) by lra.
    apply Rle_trans with (1 * bpow radix2 ex).
    + rewrite Rmult_1_l. apply Rle_trans with (bpow radix2 (g - 53)); [|apply bpow_le; lia]. unfold Z.sub. rewrite bpow_plus.
      replace (bpow radix2 (- (53))) with unit53 by (unfold unit53; simpl; lra). pose proof unit_is_small.
      rewrite (Rmult_comm (bpow radix2 g)). apply Rmult_le_compat_l; lra.
    + apply Rmult_le_compat_r; [lra|]. rewrite <- abs_IZR. apply IZR_le. lia.
Qed.

(* Where the first terms are near each other, nothing is rounded. *)
Lemma sum_of_near : forall a a_lo b b_lo h l t, is64 a h -> is64 a_lo l -> is64 b (- t) -> is64 b_lo 0 -> in_binary64 (h - t) ->
  h - t = 0 \/ Rabs l <= Rabs (h - t) -> Rabs h <= 1000000000 -> Rabs t <= 10000000000 -> Rabs l <= 1000 ->
  exists p q, is64 (fst (sum_of a a_lo b b_lo)) p /\ is64 (snd (sum_of a a_lo b b_lo)) q /\ p + q = h + l - t /\ Rabs q <= unit53 *
    Rabs p /\
    Rabs p <= 100000000000.
Proof.
  intros a a_lo b b_lo h l t Ha Hl Hb Hbl Gd Hor Bh Bt Blow. pose proof unit_is_small as Hu. set (d := h - t) in *.
  pose proof (format_of _ _ Ha) as Gh. pose proof (format_of _ _ Hl) as Gl. pose proof (format_of _ _ Hb) as Gt. pose proof (minus_size h
    t) as Bd. fold d in Bd.
  assert (small : forall r, Rabs r <= 1000000000000 -> not_too_large r) by (intros r Hr; apply big_enough; lra).
  unfold sum_of. cbv zeta. cbn [fst snd].
  assert (I1 : is64 (plus a b) d) by (apply (plus_exact _ _ h (- t)); try assumption; [unfold d; ring|apply small; lra]). set (t1 := plus a
    b) in *.
  assert (I2 : is64 (minus t1 a) (- t)) by (apply (minus_exact _ _ d h); try assumption; [unfold d; ring|apply small; rewrite Rabs_Ropp;
    lra]).
  set (t2 := minus t1 a) in *.
  assert (I3 : is64 (minus t1 t2) h) by (apply (minus_exact _ _ d (- t)); try assumption; [unfold d; ring|apply small; lra]). set (t3 :=
    minus t1 t2) in *.
  assert (I4 : is64 (minus a t3) 0) by exact_step minus_exact. set (t4 := minus a t3) in *.
  assert (I5 : is64 (minus b t2) 0) by exact_step minus_exact. set (t5 := minus b t2) in *.
  assert (I6 : is64 (plus t4 t5) 0) by exact_step plus_exact. set (t6 := plus t4 t5) in *.
  assert (I7 : is64 (plus a_lo b_lo) l) by (apply (plus_exact _ _ l 0); try assumption; [ring|apply small; lra]). set (t7 := plus a_lo
    b_lo) in *.
  assert (I8 : is64 (plus t6 t7) l) by (apply (plus_exact _ _ 0 l); try assumption; [ring|apply small; lra]). set (t8 := plus t6 t7) in *.
  assert (I10 : is64 (minus t7 a_lo) 0) by exact_step minus_exact. set (t10 := minus t7 a_lo) in *.
  assert (I11 : is64 (minus t7 t10) l) by (apply (minus_exact _ _ l 0); try assumption; [ring|apply small; lra]). set (t11 := minus t7 t10)
    in *.
  assert (I12 : is64 (minus a_lo t11) 0) by exact_step minus_exact. set (t12 := minus a_lo t11) in *.
  assert (I13 : is64 (minus b_lo t10) 0) by exact_step minus_exact. set (t13 := minus b_lo t10) in *.
  assert (I14 : is64 (plus t12 t13) 0) by exact_step plus_exact. set (t14 := plus t12 t13) in *.
  pose proof (Rabs_triang d l) as Tdl.
  assert (I9 : is64 (plus t1 t8) (nearest64 (d + l))) by (apply plus_is; try assumption; apply small; lra).
  pose proof (sum_is_close d l Gd Gl) as C9. set (v := nearest64 (d + l)) in *. pose proof (size_by v (d + l)) as Sv.
  pose proof (unit_times _ (Rabs_pos (d + l))) as Udl. set (t9 := plus t1 t8) in *.
  assert (Hor2 : Rabs l <= Rabs d \/ d = 0) by tauto.
  pose proof (fast_two_sum_is_exact d l Gd Gl Hor2) as E9. cbv zeta in E9. fold v in E9.
  pose proof (minus_size v d) as Bvd.
  pose proof (minus_is _ _ _ _ I9 I1 ltac:(apply small; lra)) as I15. set (t15 := minus t9 t1) in *.
  assert (I16 : is64 (minus t8 t15) (d + l - v)).
  { replace (d + l - v) with (nearest64 (l - nearest64 (v - d))) by lra. apply minus_is; try assumption. apply small.
    pose proof (difference_is_close v d (format_of _ _ I9) Gd) as C. pose proof (unit_times _ (Rabs_pos (v - d))). pose proof (size_by
      (nearest64 (v - d)) (v - d)).
    apply Rle_trans with (1 := minus_size _ _). lra. }
  set (t16 := minus t8 t15) in *. set (vl := d + l - v) in *. assert (Bvl : Rabs vl <= unit53 * Rabs (d + l)) by (unfold vl; rewrite
    Rabs_minus_sym; exact C9).
  assert (I17 : is64 (plus t14 t16) vl) by (apply (plus_exact _ _ 0 vl); try assumption; [ring|now apply format_of in I16|apply small;
    lra]).
  set (t17 := plus t14 t16) in *.
  assert (I18 : is64 (plus t9 t17) v).
  { assert (Ev : nearest64 (v + vl) = v) by (replace (v + vl) with (d + l) by (unfold vl; ring); reflexivity). rewrite <- Ev.
    apply plus_is; try assumption. replace (v + vl) with (d + l) by (unfold vl; ring). apply small. lra. }
  set (t18 := plus t9 t17) in *.
  assert (I19 : is64 (minus t18 t9) 0) by exact_step minus_exact. set (t19 := minus t18 t9) in *. pose proof (format_of _ _ I17) as Gvl.
  exists v, vl. split; [exact I18|]. split.
  { apply (minus_exact _ _ vl 0); [exact I17|exact I19|ring|exact Gvl|apply small; lra]. }
  split; [unfold vl, d; ring|]. split; [|lra].
  apply sum_rest; [exact Gd|exact Gl].
Qed.

(* The difference contains that of the exact number, however large its bound is. *)
Theorem difference_from_contained : forall a x tv t N k, contains a x ->
  value64 (error a) <= 10000000000000000000000000000000000000000 -> is64 tv t ->
  t = IZR N * bpow radix2 k -> N <> 0%Z -> (Z.abs N < 2 ^ 26)%Z -> (-150 <= k)%Z -> Rabs t <= 100000000 ->
  Rabs (value64 (hi a)) <= 100000000 -> contains (add a (negated (exactly64 tv))) (x - t).
Proof.
  intros a x tv t N k (h & l & e & H & L & E & Bl & Be & B & _) He Ht Et HN0 HN Hk Bt Bh. pose proof unit_is_small as Hu.
  rewrite (proj1 H) in Bh. rewrite (proj1 E) in He. pose proof (Rabs_pos h) as Ph. pose proof (unit_times _ Ph) as Uh.
  pose proof (opp_is _ _ Ht) as Hneg. assert (Hz : is64 (opp zero64) 0) by (rewrite <- Ropp_0 at 1; apply opp_is, zero_is).
  assert (Ie : is64 (plus (error a) zero64) e).
  { apply (plus_exact _ _ e 0); try assumption; [ring|now apply format_of in E|apply big_enough; rewrite Rabs_pos_eq; lra]. }
  unfold contains, add, negated, exactly64, rounded. cbn [hi lo error].
  destruct (Rle_lt_dec (Rabs (h - t)) (/ 2 * Rabs h)) as [Hnear|Hfar].
  - destruct (near_difference h t N k (format_of _ _ H) Et HN ltac:(lia) Hnear) as [Gd Hd].
    destruct (sum_of_near _ _ _ _ h l t H L Hneg Hz Gd) as (p & q & P & Q & Epq & Bq & Bp); try lra.
    destruct (error_is_at_least _ p _ e P Ie ltac:(lra) ltac:(lra)) as (g & G & Bg & _).
    exists p, q, g. split; [exact P|]. split; [exact Q|]. split; [exact G|]. split; [exact Bq|]. split; [lra|]. split; [|lra].
    replace (p + q - (x - t)) with (h + l - x) by lra. lra.
  - set (S := Rabs (h - t)) in *. pose proof (minus_size h t) as BS. fold S in BS.
    assert (HSlow : / 1000000000000000000000000000000000000000000000000 <= S).
    { assert (Lt : bpow radix2 (-150) <= Rabs t).
      { rewrite Et, Rabs_mult, (Rabs_pos_eq (bpow _ _)) by apply bpow_ge_0. apply Rle_trans with (1 * bpow radix2 (-150)); [lra|].
        apply Rmult_le_compat; [lra|apply bpow_ge_0| |now apply bpow_le]. rewrite <- abs_IZR. apply IZR_le. lia. }
      pose proof (size_by t h) as St. rewrite Rabs_minus_sym in St. fold S in St.
      apply Rle_trans with (/ 3 * bpow radix2 (-150)); [simpl; lra|lra]. }
    pose proof (unit_times S ltac:(lra)) as US. pose proof (unit_times _ (proj1 US)) as UUS.
    assert (Bl2 : Rabs l + Rabs 0 <= 2 * (unit53 * S)).
    { rewrite Rabs_R0, Rplus_0_r. apply Rle_trans with (1 := Bl). replace (2 * (unit53 * S)) with (unit53 * (2 * S)) by ring. apply
      unit_times_compat. lra. }
    destruct (sum_of_is_off _ _ _ _ h l (- t) 0 S (2 * (unit53 * S)) H L Hneg Hz ltac:(lra) ltac:(rewrite Rabs_Ropp; lra) ltac:(unfold S;
      right; f_equal; ring)
      Bl2 ltac:(lra)) as (p & q & P & Q & Off & Bp & Bq0 & Bq & _).
    assert (Off2 : Rabs (p + q - (h + l - t)) <= 64 / 10 * (unit53 * (unit53 * S))) by (replace (h + l - t) with (h + l + (- t + 0)) by
      ring; lra).
    assert (Hp : 99 / 100 * S <= Rabs p).
    { assert (Gs : S <= Rabs p + Rabs q + Rabs (p + q - (h + l - t)) + Rabs l).
      { unfold S. replace (h - t) with (p + q - (p + q - (h + l - t)) - l) by ring.
        eapply Rle_trans; [apply minus_size|apply Rplus_le_compat_r]. eapply Rle_trans; [apply minus_size|apply Rplus_le_compat_r]. apply
          Rabs_triang. }
      pose proof (unit_times _ (proj1 UUS)). rewrite Rabs_R0 in Bl2. lra. }
    assert (Bq2 : Rabs q <= unit53 * Rabs p).
    { apply Bq. replace (h + - t) with (h - t) by ring. fold S. lra. }
    destruct (error_covers _ p _ e e P Ie ltac:(lra) ltac:(lra) ltac:(lra)) as (g & G & Bg).
    pose proof (unit_times e ltac:(lra)) as Ue.
    assert (Hshare_p : 31 * (unit53 * (unit53 * S)) <= 98 / 100 * (share101 * Rabs p)).
    { rewrite share_is. replace (98 / 100 * (32 * (unit53 * unit53) * Rabs p)) with (unit53 * (unit53 * (98 / 100 * 32 * Rabs p))) by ring.
      replace (31 * (unit53 * (unit53 * S))) with (unit53 * (unit53 * (31 * S))) by ring. apply unit_times_compat, unit_times_compat. lra. }
    exists p, q, g. split; [exact P|]. split; [exact Q|]. split; [exact G|]. split; [exact Bq2|]. split; [lra|]. split; [|lra].
    replace (p + q - (x - t)) with ((p + q - (h + l - t)) + (h + l - x)) by ring. apply Rle_trans with (1 := Rabs_triang _ _). lra.
Qed.

Lemma enclosed_is_bounded : forall s a x b, encloses s a x -> 0 <= s <= 100 -> Rabs (value64 (hi a)) <= b -> b <= 1000000000000 ->
  contains a x /\ 0 <= value64 (error a) <= s * b.
Proof.
  intros s a x b (h & l & e & H & L & E & Bl & Be & B) Hs Bh Hb. rewrite (proj1 H) in Bh. rewrite (proj1 E).
  assert (s * Rabs h <= s * b) by (apply Rmult_le_compat_l; lra). split; [|lra]. exists h, l, e. repeat (split; [assumption|]).
  split; [lra|]. split; [exact B|lra].
Qed.

Theorem difference_contains : forall s a x tv t N k, encloses s a x -> 0 <= s <= 100 -> is64 tv t -> t = IZR N * bpow radix2 k ->
  N <> 0%Z -> (Z.abs N < 2 ^ 26)%Z -> (-150 <= k)%Z -> Rabs t <= 100000000 -> Rabs (value64 (hi a)) <= 100000000 ->
  contains (add a (negated (exactly64 tv))) (x - t).
Proof.
  intros s a x tv t N k Ea Hs Ht Et HN0 HN Hk Bt Bh. destruct (enclosed_is_bounded s a x _ Ea Hs Bh ltac:(lra)) as [Ca Ee].
  assert (s * 100000000 <= 100 * 100000000) by (apply Rmult_le_compat_r; lra). apply (difference_from_contained a x tv t N k); trivial. lra.
Qed.
