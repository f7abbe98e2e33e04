(* SPDX-License-Identifier: BSD-3-Clause *)
(* The content of a lane of a batch: forces that are rounded once, and never -0. *)
From Coq Require Import ZArith Reals Lia Lra List Bool.
From Flocq Require Import Core BinarySingleNaN Binary Bits.
From Forceshade Require Import Formats Comparisons Operations Nearness RoundingTest Computed Evaluate Inputs SecondAlong ErrorFree.
From Forceshade Require Import CylinderConstants Lanes.
Import ListNotations.
Open Scope R_scope.

(* The force of a lane: the exact one rounded once in contact, else none. *)
Definition right_lane (fx fz : binary32) (touches : Prop) (Fx Fz : R) : Prop :=
  (touches -> is_nearest32 fx Fx /\ is_nearest32 fz Fz) /\ (~ touches -> fx = zero32 /\ fz = zero32).

Definition is32 (v : binary32) (a : R) : Prop := value32 v = a /\ is_finite 24 128 v = true.
Definition not_negative (v : binary64) : Prop := is_finite 53 1024 v = true /\ Bsign 53 1024 v = false.

(* ---- Signs ---- *)

Lemma zero_times_is : forall v, not_negative v -> times zero64 v = zero64.
Proof. intros v [F S]. destruct v as [s|s|s pl H|s m e H]; try discriminate; cbn [Bsign] in S; subst s; reflexivity. Qed.

Lemma times_not_negative : forall v w, not_negative v -> not_negative w -> is_finite 53 1024 (times v w) = true ->
  not_negative (times v w).
Proof.
  intros v w [Fv Sv] [Fw Sw] F. split; [exact F|]. unfold times, b64_mult in *.
  match goal with |- context [Bmult _ _ ?p ?q ?nan _ _ _] => pose proof (Bmult_correct 53 1024 p q nan mode_NE v w) as C;
    set (m := Bmult 53 1024 p q nan mode_NE v w) in * end.
  cbv zeta in C. destruct (Rlt_bool _ _).
  - destruct C as (_ & _ & C3). rewrite C3, Sv, Sw; [reflexivity|]. now destruct m.
  - exfalso. destruct m; try discriminate F; discriminate C.
Qed.

Lemma root_not_negative : forall v, not_negative v -> not_negative (square_root v).
Proof.
  intros v [Fv Sv]. unfold square_root, b64_sqrt.
  match goal with |- context [Bsqrt _ _ ?p ?q ?nan _ _] => pose proof (Bsqrt_correct 53 1024 p q nan mode_NE v) as C;
    set (m := Bsqrt 53 1024 p q nan mode_NE v) in * end.
  destruct C as (_ & C2 & C3).
  assert (F : is_finite 53 1024 m = true).
  { rewrite C2. destruct v as [s|s|s pl H|s k e H]; try discriminate; [reflexivity|]. cbn [Bsign] in Sv. now subst s. }
  split; [exact F|]. rewrite C3; [exact Sv|]. now destruct m.
Qed.

Lemma positive_is_not_negative : forall v a, is64 v a -> 0 < a -> not_negative v.
Proof.
  intros v a [<- F] Ha. split; [exact F|]. destruct v as [s|s|s pl H|s m e H]; try discriminate; [simpl in Ha; lra|].
  destruct s; [|reflexivity]. exfalso. assert (value64 (B754_finite 53 1024 true m e H) < 0) by now apply F2R_lt_0. lra.
Qed.

Lemma larger_not_negative : forall v a, is64 v a -> not_negative (larger v zero64).
Proof.
  intros v a H. unfold larger. rewrite (less_is _ _ _ _ zero_is H). case Rlt_bool_spec; intro L; [|now split].
  now apply positive_is_not_negative with a.
Qed.

Lemma larger_is_zero : forall v a, is64 v a -> a <= 0 -> larger v zero64 = zero64.
Proof. intros v a H Ha. unfold larger. rewrite (less_is _ _ _ _ zero_is H). now rewrite Rlt_bool_false. Qed.

Lemma fused_with_zero : forall u v a b, is64 u a -> is64 v b -> a * b = 0 -> fused u v zero64 = zero64.
Proof.
  intros u v a b [<- Fu] [<- Fv] H. unfold fused, b64_fma.
  match goal with |- context [Bfma _ _ ?p ?q ?nan _ _ _ _] =>
    pose proof (Bfma_correct 53 1024 p q nan mode_NE u v zero64 Fu Fv eq_refl) as C; set (m := Bfma 53 1024 p q nan mode_NE u v zero64) in
      * end.
  cbv zeta in C. change (value64 zero64) with 0 in C. rewrite H, Rplus_0_r, round_0, Rabs_R0 in C by auto with typeclass_instances.
  rewrite Rlt_bool_true in C by (apply bpow_gt_0). destruct C as (C1 & C2 & C3). rewrite Rcompare_Eq in C3 by reflexivity.
  assert (S : Bsign 53 1024 m = false).
  { rewrite C3. unfold Bfma_szero, BinarySingleNaN.Bfma_szero. cbv zeta. cbn [B2BSN BinarySingleNaN.Bsign]. now destruct (xorb _ _). }
  destruct m as [s|s|s pl Hpl|s k e He]; try discriminate.
  - cbn [Bsign] in S. now subst s.
  - exfalso. simpl in C1. apply eq_0_F2R in C1. now destruct s.
Qed.

(* ---- Rounded to binary32 ---- *)

Lemma rounded_sign : forall v, not_negative v -> Rabs (value64 v) < bpow radix2 127 -> Bsign 24 128 (rounded v) = false.
Proof.
  intros v [F S] B.
  assert (Hbelow : Rabs (nearest32 (value64 v)) < bpow radix2 128).
  { apply Rle_lt_trans with (bpow radix2 127); [|now apply bpow_lt]. apply abs_round_le_generic; auto with typeclass_instances; [|lra].
    apply generic_format_bpow. unfold FLT_exp. lia. }
  destruct v as [s|s|s pl H|s m e H]; try discriminate; cbn [Bsign] in S; subst s; [reflexivity|]. unfold to32, cast.
  pose proof (binary_normalize_correct 24 128 (eq_refl _) (eq_refl _) mode_NE (SpecFloat.cond_Zopp false (Zpos m)) e false) as C.
  rewrite Rlt_bool_true in C by exact Hbelow. destruct C as (_ & _ & C3). rewrite C3. rewrite Rcompare_Gt; [reflexivity|]. now apply
    F2R_gt_0.
Qed.

Lemma rounded_component : forall k v exact, (0 < k <= 2 ^ 20)%Z -> good k v exact -> is_beside_tie (k + 1) v = false ->
  is32 (rounded v) (nearest32 exact).
Proof.
  intros k v exact Hk (F & E & Rng & B) T. apply not_beside_tie in T.
  assert (Hk1 : 1 <= IZR k <= 1048576) by (split; apply IZR_le; lia).
  rewrite <- (rounding_test_is_sound (k + 1) (IZR k * bpow radix2 (-53)) v); try assumption; try lia.
  - apply to32_rounds_once; [exact F|]. apply Rle_lt_trans with (bpow radix2 127); [|now apply bpow_lt].
    apply abs_round_le_generic; auto with typeclass_instances; [|lra]. apply generic_format_bpow. unfold FLT_exp. lia.
  - simpl. lra.
  - rewrite plus_IZR. rewrite (Rmult_assoc (IZR k)), <- bpow_plus. simpl. nra.
Qed.

Lemma nearest_of_unsigned : forall a E, is32 a (nearest32 E) -> Bsign 24 128 a = false -> is_nearest32 a E.
Proof.
  intros a E [V F] S. split; [exact V|]. split; [exact F|]. intro H0. rewrite H0 in V. destruct a as [s|s|s pl H|s m e H]; try discriminate.
  - cbn [Bsign] in S. now subst s.
  - exfalso. simpl in V. apply eq_0_F2R in V. now destruct s.
Qed.

(* + 0 turns -0 into +0. *)
Lemma nearest_plus_zero : forall a E, is32 a (nearest32 E) -> is_nearest32 (plus32 a zero32) E.
Proof.
  intros a E [V F]. pose proof (abs_B2R_lt_emax 24 128 a) as B. rewrite V in B. unfold is_nearest32, plus32, b32_plus.
  match goal with |- context [Bplus _ _ ?p ?q ?nan _ _ _] =>
    pose proof (Bplus_correct 24 128 p q nan mode_NE a zero32 F eq_refl) as C; set (sum := Bplus 24 128 p q nan mode_NE a zero32) in * end.
  cbv zeta in C. change (value32 zero32) with 0 in C. rewrite Rplus_0_r, V in C.
  change (round radix2 (SpecFloat.fexp 24 128) (round_mode mode_NE)) with nearest32 in C.
  rewrite (round_generic radix2 fexp32 ZnearestE (nearest32 _)) in C by (apply generic_format_round; auto with typeclass_instances).
  rewrite Rlt_bool_true in C by exact B. destruct C as (C1 & C2 & C3). split; [exact C1|]. split; [exact C2|]. intro H0.
  rewrite H0 in C1, C3. rewrite Rcompare_Eq in C3 by reflexivity. cbn [Bsign] in C3. rewrite andb_false_r in C3.
  destruct sum as [s|s|s pl Hpl|s m ex H]; try discriminate.
  - cbn [Bsign] in C3. now subst s.
  - exfalso. simpl in C1. apply eq_0_F2R in C1. now destruct s.
Qed.

Lemma sign_of_sum : forall x, is_finite 24 128 x = true -> Bsign 24 128 (plus32 x zero32) = Rlt_bool (value32 x) 0.
Proof.
  intros x F. pose proof (abs_B2R_lt_emax 24 128 x) as B. unfold plus32, b32_plus.
  match goal with |- context [Bplus _ _ ?p ?q ?nan _ _ _] =>
    pose proof (Bplus_correct 24 128 p q nan mode_NE x zero32 F eq_refl) as C; set (sum := Bplus 24 128 p q nan mode_NE x zero32) in * end.
  cbv zeta in C. change (value32 zero32) with 0 in C. rewrite Rplus_0_r in C.
  change (round radix2 (SpecFloat.fexp 24 128) (round_mode mode_NE)) with nearest32 in C.
  rewrite (round_generic radix2 fexp32 ZnearestE (value32 x)) in C by (try apply (generic_format_B2R 24 128); auto with
    typeclass_instances).
  rewrite Rlt_bool_true in C by exact B. destruct C as (_ & _ & C3). rewrite C3. unfold Rlt_bool.
  destruct (Rcompare (value32 x) 0); try reflexivity. cbn [Bsign]. now rewrite andb_false_r.
Qed.

(* A component along x of the force at |x|, with the sign of x. *)
Lemma nearest_sideways : forall a x E, is32 a (nearest32 E) -> is_finite 24 128 x = true ->
  is_nearest32 (plus32 (times_sign32 a (plus32 x zero32)) zero32) (if Rlt_bool (value32 x) 0 then - E else E).
Proof.
  intros a x E [V F] Fx. apply nearest_plus_zero. unfold times_sign32. rewrite sign_of_sum by exact Fx. destruct (Rlt_bool _ _).
  - unfold b32_opp. split; [now rewrite B2R_Bopp, V, round_NE_opp|now rewrite is_finite_Bopp].
  - now split.
Qed.

Lemma zero_is_nearest : forall a, a = zero32 -> is_nearest32 a 0.
Proof. intros a ->. split; [symmetry; apply round_0; auto with typeclass_instances|now split]. Qed.

(* Over the bump. *)
Lemma lane_inside : forall k cx cz x (leans : bool) Ex Ez (touches : Prop), (0 < k <= 2 ^ 20)%Z -> is_finite 24 128 x = true ->
  is_beside_tie (k + 1) cx = false -> is_beside_tie (k + 1) cz = false ->
  (touches -> good k cx Ex /\ good k cz Ez /\ not_negative cz) -> (~ touches -> cx = zero64 /\ cz = zero64) ->
  right_lane (plus32 (where32 leans (times_sign32 (rounded cx) (plus32 x zero32))) zero32) (rounded cz) touches
    (if leans then if Rlt_bool (value32 x) 0 then - Ex else Ex else 0) Ez.
Proof.
  intros k cx cz x leans Ex Ez touches Hk Fx Tx Tz Hin Hout. split.
  - intro T. destruct (Hin T) as (Gx & Gz & S). split.
    + destruct leans; cbn [where32]; [|now apply zero_is_nearest]. apply nearest_sideways; [|exact Fx]. now apply rounded_component with k.
    + apply nearest_of_unsigned; [now apply rounded_component with k|]. apply rounded_sign; [exact S|apply Gz].
  - intro T. destruct (Hout T) as [-> ->]. split; [|reflexivity]. destruct leans; [|reflexivity].
    unfold where32, times_sign32. destruct (Bsign _ _ _); reflexivity.
Qed.

(* ---- The wall ---- *)

Lemma times32_is : forall v w a b, is32 v a -> is32 w b -> Rabs (a * b) <= bpow radix2 100 -> is32 (times32 v w) (nearest32 (a * b)).
Proof.
  intros v w a b [<- Fv] [<- Fw] H. unfold times32, b32_mult.
  match goal with |- context [Bmult _ _ ?p ?q ?nan _ _ _] => pose proof (Bmult_correct 24 128 p q nan mode_NE v w) as C end.
  cbv zeta in C. change (round radix2 (SpecFloat.fexp 24 128) (round_mode mode_NE)) with nearest32 in C.
  rewrite Rlt_bool_true in C; [destruct C as (C1 & C2 & _); rewrite Fv, Fw in C2; now split|].
  apply Rle_lt_trans with (bpow radix2 100); [|now apply bpow_lt]. apply abs_round_le_generic; auto with typeclass_instances.
  apply generic_format_bpow. unfold FLT_exp. lia.
Qed.

Notation wall_lane minus_K z := (larger32 (times32 minus_K z) zero32) (only parsing).

Lemma wall_lane_is : forall minus_K z K, is32 minus_K (- K) -> / 1000 <= K <= 1000 -> in_range z ->
  value32 z = 0 \/ bpow radix2 (-30) <= Rabs (value32 z) ->
  right_lane zero32 (wall_lane minus_K z) (value32 z < 0) 0 (- K * value32 z).
Proof.
  intros m z K Hm HK [Fz Rz] Tz. set (Z := value32 z) in *. apply Rabs_le_inv in Rz.
  assert (B : Rabs (- K * Z) <= bpow radix2 100).
  { rewrite Rabs_mult, Rabs_Ropp, (Rabs_pos_eq K) by lra. apply Rle_trans with (1000 * 10000).
    - apply Rmult_le_compat; try lra; [apply Rabs_pos|now apply Rabs_le].
    - apply Rle_trans with (bpow radix2 24); [simpl; lra|apply bpow_le; lia]. }
  pose proof (times32_is _ _ _ _ Hm (conj eq_refl Fz) B) as P. fold Z in P. unfold larger32.
  rewrite (less32_is zero32 _ eq_refl (proj2 P)). rewrite (proj1 P). change (value32 zero32) with 0. split; intro S.
  - split; [now apply zero_is_nearest|]. destruct Tz as [Tz|Tz]; [lra|]. rewrite Rabs_left in Tz by exact S.
    assert (L : bpow radix2 (-40) <= - K * Z).
    { replace (- K * Z) with (K * - Z) by ring. replace (-40)%Z with (-10 + -30)%Z by reflexivity. rewrite bpow_plus.
      apply Rmult_le_compat; try apply bpow_ge_0; [simpl; lra|exact Tz]. }
    assert (L32 : 0 < nearest32 (- K * Z)).
    { apply Rlt_le_trans with (bpow radix2 (-40)); [apply bpow_gt_0|]. apply round_ge_generic; auto with typeclass_instances.
      apply generic_format_bpow. unfold FLT_exp. lia. }
    rewrite Rlt_bool_true by exact L32. split; [apply P|]. split; [apply P|]. intro H0. lra.
  - split; [reflexivity|]. rewrite Rlt_bool_false; [reflexivity|]. rewrite <- (round_0 radix2 fexp32 ZnearestE).
    apply round_le; auto with typeclass_instances. assert (0 <= K * Z) by (apply Rmult_le_pos; lra). lra.
Qed.

(* -K, as forms compute it of a number that is K, once it is rounded. *)
Lemma minus_K_is : forall v K a, / 1000 <= value32 K <= 1000 -> is64 v a -> Rabs (a - value32 K) <= / 1000000000000 * value32 K ->
  is32 (rounded (opp v)) (- value32 K).
Proof.
  intros v K a HK Hv Ha. pose proof (opp_is _ _ Hv) as Ho. apply Rabs_le_inv in Ha.
  assert (E : nearest32 a = value32 K).
  { destruct (Req_dec (value32 K) (nearest32 a)) as [E|Hne]; [now symmetry|exfalso].
    destruct (far_from_others a (value32 K) ltac:(lra) ltac:(simpl; lra) ltac:(apply (generic_format_B2R 24 128)) Hne) as [C _].
    pose proof (Rabs_le (a - value32 K) (/ 1000000000000 * value32 K) ltac:(lra)). lra. }
  assert (E2 : nearest32 (- a) = - value32 K) by (rewrite round_NE_opp; now f_equal).
  destruct (to32_rounds_once (opp v) (proj2 Ho)) as [V F]; rewrite (proj1 Ho) in *; [|split; [now rewrite <- E2|exact F]].
  rewrite E2, Rabs_Ropp, Rabs_pos_eq by lra. apply Rle_lt_trans with (bpow radix2 10); [simpl; lra|now apply bpow_lt].
Qed.

(* Beside the bump. *)
Lemma lane_beside : forall minus_K a z K, is32 minus_K (- K) -> / 1000 <= K <= 1000 -> in_range z ->
  value32 z = 0 \/ bpow radix2 (-30) <= Rabs (value32 z) ->
  right_lane (plus32 (where32 false a) zero32) (wall_lane minus_K z) (0 < - value32 z) 0 (K * - value32 z).
Proof.
  intros m a z K Hm HK Hz Tz. destruct (wall_lane_is m z K Hm HK Hz Tz) as [In Out]. split; intro T.
  - replace (K * - value32 z) with (- K * value32 z) by ring. apply In. lra.
  - apply Out. lra.
Qed.
