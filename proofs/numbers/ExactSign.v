(* SPDX-License-Identifier: BSD-3-Clause *)
(* exact_sign of fast/laws/top_edge.h: the sign of a sum of binary64 numbers, exactly (Shewchuk's expansions). *)
From Coq Require Import ZArith Reals List Lia Lra Bool.
From Flocq Require Import Core Plus_error BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations ErrorFree.
Import ListNotations.
Open Scope R_scope.

(* two_sum *)
Definition sum_low (a b : binary64) : binary64 :=
  let s := plus a b in let t := minus s a in plus (minus a (minus s t)) (minus b t).

(* A number more in an expansion, whose smallest term comes first; and the sign of its last term that is not 0. *)
Fixpoint grow (carry : binary64) (terms : list binary64) : list binary64 :=
  match terms with [] => [carry] | x :: rest => sum_low carry x :: grow (plus carry x) rest end.
Definition expansion (terms : list binary64) : list binary64 := fold_left (fun e t => grow t e) terms [].
Fixpoint first_sign (terms : list binary64) : Z :=
  match terms with [] => 0 | x :: rest => if is_equal x zero64 then first_sign rest else if is_less zero64 x then 1 else -1 end.
Definition exact_sign (terms : list binary64) : Z := first_sign (rev (expansion terms)).

(* ---- In real numbers ---- *)

Definition multiple (k : Z) (x : R) : Prop := exists n : Z, x = IZR n * bpow radix2 k.
Definition below (k : Z) (l : list R) : Prop := Forall (fun x => Rabs x < bpow radix2 k) l.
Definition sum (l : list R) : R := fold_right Rplus 0 l.

(* Each term is a multiple of a power of two that is larger than all those before it. low: those before the list. *)
Fixpoint apart (low l : list R) : Prop :=
  match l with [] => True | x :: rest => (exists k, multiple k x /\ below k low) /\ apart (x :: low) rest end.
Fixpoint apart_down (l : list R) : Prop :=
  match l with [] => True | x :: rest => (exists k, multiple k x /\ below k rest) /\ apart_down rest end.

Lemma apart_reversed : forall l low, apart low l -> apart_down low -> apart_down (rev l ++ low).
Proof.
  induction l as [|x l IH]; intros low H D; [exact D|]. destruct H as [H1 H2]. simpl. rewrite <- app_assoc. apply IH; [exact H2|].
  now split.
Qed.

Lemma multiple_less : forall k j x, multiple k x -> (j <= k)%Z -> multiple j x.
Proof.
  intros k j x [n ->] H. exists (n * 2 ^ (k - j))%Z. rewrite mult_IZR. change (2 ^ (k - j))%Z with (Zpower radix2 (k - j)).
  rewrite IZR_Zpower by lia. rewrite Rmult_assoc, <- bpow_plus. do 2 f_equal. ring.
Qed.

Lemma multiple_plus : forall k x y, multiple k x -> multiple k y -> multiple k (x + y).
Proof. intros k x y [n ->] [m ->]. exists (n + m)%Z. rewrite plus_IZR. ring. Qed.

Lemma multiple_opp : forall k x, multiple k x -> multiple k (- x).
Proof. intros k x [n ->]. exists (- n)%Z. rewrite opp_IZR. ring. Qed.

Lemma multiple_rounded : forall k x, multiple k x -> multiple k (nearest64 x).
Proof.
  intros k x [n ->]. destruct (round_repr_same_exp radix2 fexp64 ZnearestE n k) as [m Hm]. exists m. exact Hm.
Qed.

Lemma multiple_of_own : forall x, in_binary64 x -> multiple (cexp radix2 fexp64 x) x.
Proof. intros x H. exists (Ztrunc (scaled_mantissa radix2 fexp64 x)). exact H. Qed.

(* A multiple of 2^j below 2^k leaves room for 2^j. *)
Lemma room : forall j k x, multiple j x -> x <> 0 -> Rabs x < bpow radix2 k -> Rabs x + bpow radix2 j <= bpow radix2 k.
Proof.
  intros j k x [n ->] Hx H. rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 j)) in * by apply bpow_ge_0. rewrite <- abs_IZR in *.
  assert (Hn : (1 <= Z.abs n)%Z).
  { assert (n <> 0)%Z; [|lia]. intros ->. apply Hx. ring. }
  pose proof (bpow_gt_0 radix2 j) as P.
  assert (Hjk : (j < k)%Z).
  { apply (lt_bpow radix2). apply Rle_lt_trans with (2 := H). rewrite <- (Rmult_1_l (bpow radix2 j)) at 1.
    apply Rmult_le_compat_r; [lra|]. now apply IZR_le. }
  assert (E : bpow radix2 k = IZR (2 ^ (k - j)) * bpow radix2 j).
  { change (2 ^ (k - j))%Z with (Zpower radix2 (k - j)). rewrite IZR_Zpower by lia. rewrite <- bpow_plus. f_equal. ring. }
  rewrite E in H |- *. apply Rmult_lt_reg_r in H; [|exact P]. apply lt_IZR in H.
  replace (IZR (Z.abs n) * bpow radix2 j + bpow radix2 j) with (IZR (Z.abs n + 1) * bpow radix2 j) by (rewrite plus_IZR; ring).
  apply Rmult_le_compat_r; [lra|]. apply IZR_le. lia.
Qed.

Lemma sum_is_below : forall l k, apart_down l -> below k l -> Rabs (sum l) < bpow radix2 k.
Proof.
  induction l as [|x l IH]; intros k D B; [simpl; rewrite Rabs_R0; apply bpow_gt_0|]. destruct D as [(j & M & Bj) D].
  inversion B as [|x' l' Bx Bl]; subst x' l'. simpl. destruct (Req_dec x 0) as [->|Hx].
  - rewrite Rplus_0_l. now apply IH.
  - apply Rle_lt_trans with (1 := Rabs_triang _ _). pose proof (IH j D Bj). pose proof (room j k x M Hx Bx). lra.
Qed.

Definition sign_of (x : R) : Z := if Req_bool x 0 then 0 else if Rlt_bool 0 x then 1 else -1.

Fixpoint real_sign (l : list R) : Z :=
  match l with [] => 0 | x :: rest => if Req_bool x 0 then real_sign rest else if Rlt_bool 0 x then 1 else -1 end.

Lemma real_sign_is : forall l, apart_down l -> real_sign l = sign_of (sum l).
Proof.
  induction l as [|x l IH]; intro D; simpl.
  { unfold sign_of. now rewrite Req_bool_true. }
  destruct D as [(j & M & B) D]. case Req_bool_spec; intro Hx.
  - rewrite IH by assumption. f_equal. rewrite Hx. ring.
  - pose proof (sum_is_below l j D B) as S. apply Rabs_lt_inv in S.
    assert (L : bpow radix2 j <= Rabs x).
    { destruct M as [n ->]. rewrite Rabs_mult, (Rabs_pos_eq (bpow radix2 j)) by apply bpow_ge_0. rewrite <- abs_IZR.
      rewrite <- (Rmult_1_l (bpow radix2 j)) at 1. apply Rmult_le_compat_r; [apply bpow_ge_0|]. apply IZR_le.
      assert (n <> 0)%Z; [|lia]. intros ->. apply Hx. ring. }
    unfold sign_of. destruct (Rle_or_lt x 0) as [N|P].
    + rewrite Rabs_left1 in L by exact N. rewrite Rlt_bool_false by exact N.
      rewrite Req_bool_false by lra. now rewrite Rlt_bool_false by lra.
    + rewrite Rabs_pos_eq in L by lra. rewrite Rlt_bool_true by exact P.
      rewrite Req_bool_false by lra. now rewrite Rlt_bool_true by lra.
Qed.

(* ---- Growing ---- *)

Lemma bounded_rounding : forall k x, (-1000 <= k)%Z -> Rabs x <= bpow radix2 k -> Rabs (nearest64 x) <= bpow radix2 k.
Proof.
  intros k x Hk H. apply abs_round_le_generic; auto with typeclass_instances. apply generic_format_bpow. unfold FLT_exp. lia.
Qed.

Lemma twice_power : forall k, bpow radix2 (k + 1) = 2 * bpow radix2 k.
Proof. intro k. rewrite bpow_plus. change (bpow radix2 1) with 2. ring. Qed.

Lemma two_below : forall k x y, Rabs x <= bpow radix2 k -> Rabs y <= bpow radix2 k -> Rabs (x + y) <= bpow radix2 (k + 1) /\
  Rabs (x - y) <= bpow radix2 (k + 1).
Proof.
  intros k x y Hx Hy. rewrite twice_power. apply Rabs_le_inv in Hx. apply Rabs_le_inv in Hy. split; apply Rabs_le; lra.
Qed.

Lemma below_more : forall k m x, Rabs x <= bpow radix2 k -> (k <= m)%Z -> Rabs x <= bpow radix2 m.
Proof. intros k m x H Hk. apply Rle_trans with (1 := H). now apply bpow_le. Qed.

(* two_sum gives both terms, without overflow. *)
Lemma two_sum_gives : forall a b x y k, is64 a x -> is64 b y -> (-900 <= k <= 900)%Z -> Rabs x <= bpow radix2 k ->
  Rabs y <= bpow radix2 k ->
  is64 (plus a b) (nearest64 (x + y)) /\ is64 (sum_low a b) (x + y - nearest64 (x + y)).
Proof.
  intros a b x y k Ha Hb Hk Bx By. pose proof (two_sum_is_exact x y (format_of _ _ Ha) (format_of _ _ Hb)) as E. cbv zeta in E.
  assert (large : forall m z, (m <= 1000)%Z -> Rabs z <= bpow radix2 m -> Rabs z <= bpow radix2 1000) by (intros m z Hm Hz;
    now apply below_more with m).
  destruct (two_below k x y Bx By) as [B1 _]. pose proof (plus_is _ _ _ _ Ha Hb (large (k + 1)%Z _ ltac:(lia) B1)) as I1.
  apply bounded_rounding in B1; [|lia]. set (s := nearest64 (x + y)) in *. split; [exact I1|]. unfold sum_low. cbv zeta.
  destruct (two_below (k + 1) s x B1 (below_more k (k + 1) _ Bx ltac:(lia))) as [_ B2].
  pose proof (minus_is _ _ _ _ I1 Ha (large (k + 1 + 1)%Z _ ltac:(lia) B2)) as I2. apply bounded_rounding in B2; [|lia].
  set (t := nearest64 (s - x)) in *.
  destruct (two_below (k + 1 + 1) s t (below_more (k + 1) (k + 1 + 1) _ B1 ltac:(lia)) B2) as [_ B3].
  pose proof (minus_is _ _ _ _ I1 I2 (large (k + 1 + 1 + 1)%Z _ ltac:(lia) B3)) as I3. apply bounded_rounding in B3; [|lia].
  set (p := nearest64 (s - t)) in *.
  destruct (two_below (k + 1 + 1 + 1) x p (below_more k (k + 1 + 1 + 1) _ Bx ltac:(lia)) B3) as [_ B4].
  pose proof (minus_is _ _ _ _ Ha I3 (large (k + 1 + 1 + 1 + 1)%Z _ ltac:(lia) B4)) as I4. apply bounded_rounding in B4; [|lia].
  destruct (two_below (k + 1 + 1) y t (below_more k (k + 1 + 1) _ By ltac:(lia)) B2) as [_ B5].
  pose proof (minus_is _ _ _ _ Hb I2 (large (k + 1 + 1 + 1)%Z _ ltac:(lia) B5)) as I5. apply bounded_rounding in B5; [|lia].
  set (q := nearest64 (x - p)) in *. set (r := nearest64 (y - t)) in *.
  destruct (two_below (k + 1 + 1 + 1 + 1) q r B4 (below_more (k + 1 + 1 + 1) (k + 1 + 1 + 1 + 1) _ B5 ltac:(lia))) as [B6 _].
  replace (x + y - s) with (nearest64 (q + r)) by lra. apply plus_is; try assumption.
    apply (large (k + 1 + 1 + 1 + 1 + 1)%Z); [lia|exact B6].
Qed.

(* The low term is no larger than either, and lies below the last bit of the high one. *)
Lemma low_is_small : forall x y, in_binary64 x -> Rabs (x + y - nearest64 (x + y)) <= Rabs y.
Proof.
  intros x y Hx. destruct (round_N_pt radix2 fexp64 (fun n => negb (Z.even n)) (x + y)) as [_ N]. specialize (N x Hx).
  change (Znearest (fun n => negb (Z.even n))) with ZnearestE in N. rewrite (Rabs_minus_sym (x + y)). apply Rle_trans with (1 := N).
  replace (x - (x + y)) with (- y) by ring. rewrite Rabs_Ropp. lra.
Qed.

Lemma high_is_apart : forall v, nearest64 v <> 0 -> Rabs (v - nearest64 v) < bpow radix2 (cexp radix2 fexp64 (nearest64 v)).
Proof.
  intros v Hv. pose proof (error_le_half_ulp_round radix2 fexp64 (fun n => negb (Z.even n)) v) as U.
  change (Znearest (fun n => negb (Z.even n))) with ZnearestE in U. rewrite ulp_neq_0 in U by exact Hv. rewrite Rabs_minus_sym.
  pose proof (bpow_gt_0 radix2 (cexp radix2 fexp64 (nearest64 v))). lra.
Qed.

Lemma grow_is : forall terms l, Forall2 is64 terms l -> forall carry c low grown k, is64 carry c -> apart low l ->
  (exists q, multiple q c /\ below q grown) -> (forall m, below m low -> below m grown) ->
  (-900 <= k)%Z -> (k + Z.of_nat (length l) <= 900)%Z -> Rabs c <= bpow radix2 k -> Forall (fun x => Rabs x <= bpow radix2 k) l ->
  exists r, Forall2 is64 (grow carry terms) r /\ sum r = c + sum l /\ apart grown r /\ length r = S (length l) /\
    Forall (fun x => Rabs x <= bpow radix2 (k + Z.of_nat (length l))) r.
Proof.
  induction 1 as [|a x terms l Ha Hl IH]; intros carry c low grown k Hc Hlow Hq Hsmall Hk Hk2 Bc Bl.
  - exists [c]. split; [constructor; [exact Hc|constructor]|]. split; [simpl; ring|]. split; [now split|]. split; [reflexivity|].
    constructor; [|constructor]. rewrite Z.add_0_r. exact Bc.
  - inversion Bl as [|x' l' Bx Bl']; subst x' l'. destruct Hlow as [(s & Ms & Bs) Hlow]. destruct Hq as (q & Mq & Bq).
    cbn [length] in Hk2. rewrite Nat2Z.inj_succ in Hk2.
    destruct (two_sum_gives carry a c x k Hc Ha ltac:(lia) Bc Bx) as [I1 I2]. set (h := c + x - nearest64 (c + x)) in *.
    pose proof (low_is_small c x (format_of _ _ Hc)) as Hh. fold h in Hh.
    set (m := Z.min q s). assert (Mc : multiple m c) by (apply multiple_less with q; [exact Mq|lia]).
    assert (Mx : multiple m x) by (apply multiple_less with s; [exact Ms|lia]). pose proof (multiple_plus _ _ _ Mc Mx) as Mcx.
    pose proof (multiple_rounded _ _ Mcx) as Mn.
    assert (Mh : multiple m h) by (unfold h, Rminus; apply multiple_plus; [exact Mcx|now apply multiple_opp]).
    assert (Bm : below m grown).
    { unfold m. destruct (Z.min_spec q s) as [[_ ->]|[_ ->]]; [exact Bq|now apply Hsmall]. }
    assert (Hq' : exists q', multiple q' (nearest64 (c + x)) /\ below q' (h :: grown)).
    { destruct (Req_dec (nearest64 (c + x)) 0) as [Z0|Z0].
      - exists m. split; [exact Mn|]. constructor; [|exact Bm].
        assert (h = 0).
        { unfold h. rewrite Z0. destruct (Req_dec (c + x) 0) as [Z1|Z1]; [lra|exfalso].
          revert Z0. apply round_plus_neq_0; auto with typeclass_instances; [exact (format_of _ _ Hc)|exact (format_of _ _ Ha)]. }
        rewrite H, Rabs_R0. apply bpow_gt_0.
      - set (e := cexp radix2 fexp64 (nearest64 (c + x))). exists (Z.max m e). split.
        + destruct (Z.max_spec m e) as [[_ ->]|[_ ->]]; [|exact Mn]. apply multiple_of_own.
          apply generic_format_round; auto with typeclass_instances.
        + constructor.
          * apply Rlt_le_trans with (1 := high_is_apart _ Z0). apply bpow_le. unfold e. lia.
          * revert Bm. apply Forall_impl. intros y Hy. apply Rlt_le_trans with (1 := Hy). apply bpow_le. lia. }
    assert (Hsmall' : forall j, below j (x :: low) -> below j (h :: grown)).
    { intros j B. inversion B; subst. constructor; [lra|now apply Hsmall]. }
    destruct (two_below k c x Bc Bx) as [B1 _]. apply bounded_rounding in B1; [|lia].
    destruct (IH (plus carry a) (nearest64 (c + x)) (x :: low) (h :: grown) (k + 1)%Z I1 Hlow Hq' Hsmall' ltac:(lia) ltac:(lia) B1)
      as (r & R1 & R2 & R3 & R4 & R5).
    { revert Bl'. apply Forall_impl. intros y Hy. apply (below_more _ _ _ Hy). lia. }
    exists (h :: r). split; [now constructor|]. split; [simpl; rewrite R2; unfold h; ring|].
    split; [split; [now exists m|exact R3]|]. split; [simpl; now rewrite R4|]. cbn [length]. rewrite Nat2Z.inj_succ.
    constructor.
    + apply below_more with k; [lra|lia].
    + revert R5. apply Forall_impl. intros y Hy. apply (below_more _ _ _ Hy). lia.
Qed.

Lemma expansion_grows : forall terms l, Forall2 is64 terms l -> forall e d k, Forall2 is64 e d -> apart [] d -> (-900 <= k)%Z ->
  (k + Z.of_nat (length l) * (Z.of_nat (length d) + Z.of_nat (length l)) <= 900)%Z -> Forall (fun x => Rabs x <= bpow radix2 k) l ->
  Forall (fun x => Rabs x <= bpow radix2 k) d ->
  exists r, Forall2 is64 (fold_left (fun e t => grow t e) terms e) r /\ sum r = sum d + sum l /\ apart [] r.
Proof.
  induction 1 as [|a x terms l Ha Hl IH]; intros e d k He Hd Hk Hk2 Bl Bd.
  - exists d. split; [exact He|]. split; [simpl; ring|exact Hd].
  - inversion Bl as [|x' l' Bx Bl']; subst x' l'. cbn [length] in Hk2. rewrite Nat2Z.inj_succ in Hk2.
    destruct (grow_is _ _ He a x [] [] k Ha Hd) as (r & R1 & R2 & R3 & R4 & R5); try assumption.
    { exists (cexp radix2 fexp64 x). split; [apply multiple_of_own; exact (format_of _ _ Ha)|constructor]. }
    { intros m _. constructor. }
    { nia. }
    cbn [fold_left]. destruct (IH (grow a e) r (k + Z.of_nat (length d))%Z R1 R3) as (v & V1 & V2 & V3).
    { lia. } { rewrite R4, Nat2Z.inj_succ. nia. }
    { revert Bl'. apply Forall_impl. intros y Hy. apply (below_more _ _ _ Hy). lia. }
    { exact R5. }
    exists v. split; [exact V1|]. split; [rewrite V2, R2; simpl; ring|exact V3].
Qed.

Lemma first_sign_is : forall e l, Forall2 is64 e l -> first_sign e = real_sign l.
Proof.
  induction 1 as [|a x e l Ha _ IH]; [reflexivity|]. simpl. rewrite (equal_is _ _ _ _ Ha zero_is), (less_is _ _ _ _ zero_is Ha), IH.
    reflexivity.
Qed.

(* Eight numbers are not the most. *)
Theorem exact_sign_is : forall terms l, Forall2 is64 terms l -> (length l <= 20)%nat -> Forall (fun x => Rabs x <= bpow radix2 400) l ->
  exact_sign terms = sign_of (sum l).
Proof.
  intros terms l H Hl Bl. destruct (expansion_grows _ _ H [] [] 400 ltac:(constructor) I ltac:(lia)) as (r & R1 & R2 & R3).
  { cbn [length]. nia. } { exact Bl. } { constructor. }
  unfold exact_sign, expansion. rewrite (first_sign_is _ (rev r)).
  - rewrite real_sign_is.
    + f_equal. transitivity (sum r); [|rewrite R2; simpl; ring]. clear. induction r as [|x r IH]; [reflexivity|]. simpl.
      assert (S : forall a b, sum (a ++ b) = sum a + sum b).
      { induction a as [|y a IHa]; intro b; simpl; [ring|]. rewrite IHa. ring. }
      rewrite S, IH. simpl. ring.
    + pose proof (apart_reversed r [] R3 I) as A. now rewrite app_nil_r in A.
  - clear -R1. induction R1 as [|a x e l Ha _ IH]; [constructor|]. simpl. apply Forall2_app; [exact IH|].
    constructor; [exact Ha|constructor].
Qed.
